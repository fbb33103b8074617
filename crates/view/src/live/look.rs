//! The swarm at one instant: what is copied on the run's thread.

use crate::wire::Columns;
use simbeeotic_model::View;
use simbeeotic_model::kernel::ModelId;
use std::sync::Arc;

/// Frames that may be in use at a time: one that is made, one that is shown, and what slow pages hold.
const KEPT: usize = 4;

/// Everybody at one instant, and the numbers that pages want them coloured by.
#[derive(Debug, Default)]
pub(super) struct Look {
    pub(super) columns: Columns,
    /// By the names of the series.
    pub(super) colours: Vec<(String, Arc<[f32]>)>,
}

/// Makes looks, in memory that is used again.
#[derive(Default)]
pub(super) struct Looks(Vec<Arc<Look>>);

impl Looks {
    /// Copies positions, velocities and attitudes of these bodies.
    pub(super) fn take(
        &mut self,
        view: &View<'_>,
        bodies: &[ModelId],
        colours: Vec<(String, Arc<[f32]>)>,
    ) -> Arc<Look> {
        let free = self.0.iter().position(|look| Arc::strong_count(look) == 1);
        let mut look = match free {
            Some(at) => self.0.swap_remove(at),
            None => Arc::default(),
        };
        match Arc::get_mut(&mut look) {
            Some(free) => fill(free, view, bodies, colours),
            None => {
                let mut made = Look::default();
                fill(&mut made, view, bodies, colours);
                look = Arc::new(made);
            }
        }
        if self.0.len() < KEPT {
            self.0.push(Arc::clone(&look));
        }
        look
    }
}

/// One sweep: each body is looked up and evaluated once.
fn fill(look: &mut Look, view: &View<'_>, bodies: &[ModelId], colours: Vec<(String, Arc<[f32]>)>) {
    let columns = &mut look.columns;
    columns.clear();
    columns.time_s = view.now().as_secs_f64();
    columns.positions.reserve(bodies.len());
    columns.velocities.reserve(bodies.len());
    columns.attitudes.reserve(bodies.len());
    for id in bodies {
        let (position, velocity, attitude) = match view.state(*id) {
            Some(state) => {
                let q = state.world_from_body;
                (
                    state.p_enu.as_vec3().to_array(),
                    state.v_enu.as_vec3().to_array(),
                    [q.w, q.x, q.y, q.z],
                )
            }
            None => ([0.0; 3], [0.0; 3], [1.0, 0.0, 0.0, 0.0]),
        };
        columns.positions.push(position);
        columns.velocities.push(velocity);
        columns.attitudes.push(Columns::attitude(attitude));
    }
    look.colours = colours;
}

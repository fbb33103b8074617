//! What there is to be seen at one instant, for cameras and pictures: many rays, and how things look.

use crate::message::Thing;
use crate::sees::SeesWhat;
use crate::swarm::Swarm;
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyError, BodyId, Fan, Hit, Kind, Sees};
use simbeeotic_units::glam::DVec3;
use simbeeotic_world::{Color, World};

/// How the body of an object of the world looks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    pub(crate) color: Color,
    /// Which of its kind.
    pub(crate) number: u32,
}

/// What there is to be seen at one instant.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    pub(crate) now: SimTime,
    pub(crate) swarm: &'a Swarm,
    /// Who looks: it does not see itself.
    pub(crate) but: Option<BodyId>,
}

/// How many things of one kind have a [label](Scene::label_of) of their own.
pub const LABELS_OF_A_KIND: u32 = 1 << 24;

/// The colour of a vehicle.
const VEHICLE: Color = Color::rgb(240, 178, 30);
/// The colour of a station.
const STATION: Color = Color::rgb(158, 98, 48);
/// The colour of a ghost.
const GHOST: Color = Color::rgb(150, 100, 190);

/// The colour of a body of the swarm.
pub(crate) const fn color_of(kind: Kind) -> Color {
    match kind {
        Kind::Station => STATION,
        Kind::Ghost => GHOST,
        _ => VEHICLE,
    }
}

impl Scene<'_> {
    /// What each ray of a fan meets first of `what`, as the instant began, row by row.
    ///
    /// # Errors
    /// A ray that is none: a number that is not finite, no direction, no range; no columns.
    pub fn cast_fan(
        &self,
        fan: &Fan<'_>,
        what: SeesWhat,
        hits: &mut Vec<Option<Hit>>,
    ) -> Result<(), BodyError> {
        self.swarm
            .physics
            .cast_fan(fan, self.now, &self.sees(what), hits)
    }

    /// The same for rays from anywhere.
    ///
    /// # Errors
    /// As [`cast_fan`](Self::cast_fan).
    pub fn cast_rays(
        &self,
        rays: &[simbeeotic_physics::Ray],
        what: SeesWhat,
        hits: &mut Vec<Option<Hit>>,
    ) -> Result<(), BodyError> {
        self.swarm
            .physics
            .cast_rays(rays, self.now, &self.sees(what), hits)
    }

    fn sees(&self, what: SeesWhat) -> Sees {
        Sees {
            kinds: what.kinds(),
            but: self.but,
        }
    }

    /// What a ray has met.
    pub fn thing_of(&self, hit: &Hit) -> Thing {
        hit.body
            .map_or(Thing::Ground, |body| self.swarm.owners[body.index()])
    }

    /// What it counts as.
    pub fn kind_of(&self, hit: &Hit) -> Kind {
        hit.body
            .map_or(Kind::Ground, |body| self.swarm.physics.kind(body))
    }

    /// A number for each thing, never 0, and the same in every run of a scenario: its kind (1 for
    /// [`Kind::Ground`], in the order of [`Kind::ALL`]) times [`LABELS_OF_A_KIND`], and which of its kind
    /// it is: of an object, its place in the world file, from 0 (flowers are counted through all
    /// patches); of a model, its [`ModelId`](simbeeotic_kernel::ModelId).
    pub fn label_of(&self, hit: &Hit) -> u32 {
        let kind = self.kind_of(hit) as u32 + 1;
        let number = match (self.thing_of(hit), self.look_of(hit)) {
            (Thing::Model(id), _) => id.0,
            (_, Some(look)) => look.number,
            _ => 0,
        };
        kind * LABELS_OF_A_KIND + number % LABELS_OF_A_KIND
    }

    /// Its colour: of an object, what the world file says; of the swarm, one for each kind.
    pub fn color_of(&self, hit: &Hit) -> Color {
        match (self.look_of(hit), self.kind_of(hit)) {
            (Some(look), _) => look.color,
            (None, Kind::Ground) => self.world().ground.color,
            (None, kind) => color_of(kind),
        }
    }

    fn look_of(&self, hit: &Hit) -> Option<Look> {
        let first = self.swarm.owners.len() - self.swarm.looks.len();
        let at = hit.body?.index().checked_sub(first)?;
        self.swarm.looks.get(at).copied()
    }

    /// What stands in the world.
    pub fn world(&self) -> &World {
        &self.swarm.world
    }

    /// A box along the axes that holds all bodies that end somewhere: its lowest and its highest corner, ENU,
    /// m. `None` if there is none.
    pub fn bounds(&self) -> Option<[DVec3; 2]> {
        let physics = &self.swarm.physics;
        let bodies = (0..physics.len() as u32).map(|id| physics.bounds(BodyId(id), self.now));
        let ends = bodies.filter(|[low, high]| low.is_finite() && high.is_finite());
        ends.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
    }
}

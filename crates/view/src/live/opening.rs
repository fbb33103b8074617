//! The first message: what it is made of is taken on the run's thread, and it is made on another one.

use super::page::{LivePage, command};
use super::shared::Shared;
use super::viewer::Cast;
use crate::server::{Bell, Page, Picture, Screen, Source, pictures};
use crate::wire::{Asked, Facts, Hello, Mode};
use simbeeotic_model::View;
use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::world::World;
use simbeeotic_record::stage::{Stage, textures};
use simbeeotic_record::{Vehicle, vehicles_of};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::thread::JoinHandle;

/// What pages are told first.
pub(super) struct Opening {
    facts: Facts,
    vehicles: Vec<Vehicle>,
    world: Arc<World>,
    seed: u64,
}

impl Opening {
    pub(super) fn of(view: &View<'_>, cast: &Cast) -> Self {
        let origin = view.origin();
        Self {
            facts: Facts {
                name: origin.name.clone(),
                seed: origin.seed.cast_signed().to_string(),
                version: origin.version.clone(),
                end_s: view.end().map(SimTime::as_secs_f64),
                truncated: false,
            },
            vehicles: vehicles_of(view, &cast.bodies),
            world: view.shared_world(),
            seed: origin.seed,
        }
    }

    /// Makes the message and lets pages in, on a thread of its own; on this one if there is none to be had.
    pub(super) fn show(self, shared: &Arc<Shared>, screen: Screen) -> Option<JoinHandle<()>> {
        let opening = Arc::new(self);
        let make = {
            let (opening, shared) = (Arc::clone(&opening), Arc::clone(shared));
            let screen = screen.clone();
            move || opening.make(shared, &screen)
        };
        let builder = std::thread::Builder::new().name("view-hello".to_owned());
        match builder.spawn(make) {
            Ok(thread) => Some(thread),
            Err(_) => {
                opening.make(Arc::clone(shared), &screen);
                None
            }
        }
    }

    fn make(&self, shared: Arc<Shared>, screen: &Screen) {
        let hello = Hello {
            mode: Mode::Live,
            facts: &self.facts,
            vehicles: &self.vehicles,
            stage: &Stage::of(&self.world, self.seed),
            replay: None,
        };
        let _ = shared.hello.set(hello.message());
        screen.show(Arc::new(Run {
            textures: pictures(textures(&self.world).0),
            shared,
        }));
    }
}

/// What the server shows.
struct Run {
    shared: Arc<Shared>,
    textures: BTreeMap<String, Picture>,
}

impl Source for Run {
    fn open(&self, bell: Arc<Bell>) -> Box<dyn Page> {
        let number = self.shared.enter(bell);
        Box::new(LivePage::new(Arc::clone(&self.shared), number))
    }

    fn command(&self, asked: &Asked) -> Result<bool, String> {
        command(&self.shared, asked)
    }

    fn texture(&self, name: &str) -> Option<Picture> {
        self.textures.get(name).cloned()
    }
}

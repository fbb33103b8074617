//! The shared state of a run: bodies, air, weather, population; and what happens to it.
//!
//! [`Swarm`] is the kernel's domain. In one round of an instant (`round`):
//!
//! 1. *open*: bodies that touch now are resolved, frames that are due go through the medium;
//!    whoever was touched or may hear something is woken too;
//! 2. *run*: models run in parallel and see the swarm as it is after 1;
//! 3. *commit*: what they did (`effect`) is applied in the order of their ids;
//! 4. *close*: contacts of the bodies that changed are predicted anew.

mod accounts;
mod effect;
mod round;

pub use effect::{Effect, Mark, Own};

use crate::component::Component;
use crate::energy::{Drawn, Onboard};
use crate::instance::GearPlan;
use crate::message::{Message, Thing, Touch};
use crate::metrics::Metrics;
use crate::model::Model;
use crate::packets::PacketWatch;
use crate::population::Population;
use crate::scene::Look;
use simbeeotic_kernel::{ModelId, SimTime, Stream, Timers};
use simbeeotic_physics::{BodyId, Contact, Physics};
use simbeeotic_radio::{Medium, RadioId};
use simbeeotic_units::{Acceleration, Attitude, Length, Pose, Position, Rate, Twist, Velocity};
use simbeeotic_world::{Gases, Weather, World};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::AtomicU64;

/// Tags of wake-ups that are not timers.
pub(crate) mod wake {
    /// The model's start.
    pub(crate) const START: u32 = 1;
    /// A message; the argument is its place in the mail room.
    pub(crate) const TELL: u32 = 2;
    /// The model's end.
    pub(crate) const FINISH: u32 = 3;
}

/// One model and what belongs to it alone.
#[repr(C, align(64))]
pub struct Agent {
    pub(crate) model: Box<dyn Model>,
    pub(crate) core: Core,
}

/// What every model has, whatever it is. What a timer's wake-up needs comes first: it lies in the
/// first two of the [`Agent`]'s three cache lines.
#[repr(C)]
pub(crate) struct Core {
    pub(crate) id: ModelId,
    pub(crate) body: Option<BodyId>,
    /// Messages sent so far.
    pub(crate) told: u32,
    pub(crate) rng: Stream,
    /// Each timer's label is the [`Call`](crate::Call) it makes.
    pub(crate) timers: Timers,
    pub(crate) drawn: Drawn,
    pub(crate) radios: Box<[RadioId]>,
    /// Batteries and the like; most models have none.
    pub(crate) onboard: Option<Box<Onboard>>,
}

const _: () = assert!(size_of::<Agent>() == 192);

/// The shared state of a run.
pub struct Swarm {
    pub(crate) physics: Physics,
    pub(crate) gravity: Acceleration,
    pub(crate) medium: Option<Box<dyn Medium>>,
    pub(crate) weather: Arc<dyn Weather>,
    /// The world's gases in this weather.
    pub(crate) gases: Gases,
    pub(crate) world: Arc<World>,
    pub(crate) population: Population,
    /// Identity of each model in traces and draws.
    pub(crate) keys: Vec<u64>,
    /// Each model's body.
    pub(crate) bodies: Vec<Option<BodyId>>,
    /// What each body is: first those of models, then the objects of the world.
    pub(crate) owners: Vec<Thing>,
    /// How the bodies of the world's objects look: the last of all bodies, in their order.
    pub(crate) looks: Vec<Look>,
    /// Messages under way.
    pub(crate) mail: MailRoom,
    /// Contacts resolved in this round.
    pub(crate) contacts: Vec<Contact>,
    /// The same as each touched model sees them, by model.
    pub(crate) touches: Vec<(ModelId, Touch)>,
    /// Who may hear something in this round.
    pub(crate) listeners: Vec<ModelId>,
    pub(crate) touch_count: u64,
    /// How often a body was put elsewhere.
    pub(crate) jumps: u64,
    pub(crate) marks: Vec<Mark>,
    /// Whether anybody looks at the marks.
    pub(crate) keep_marks: bool,
    /// Of each model, the sensors whose measurements somebody looks at, a bit each; empty if nobody
    /// looks at any. The last bit stands for all sensors from the 64th on.
    pub(crate) watched: Vec<u64>,
    /// The radios whose frames somebody looks at, if there are any.
    pub(crate) packet_watch: Option<Box<PacketWatch>>,
    /// What models have published, summed up.
    pub(crate) metrics: Metrics,
    /// The names of each model's sensors: those of one section share them.
    pub(crate) gear: Vec<Arc<GearPlan>>,
    /// Wall-clock time of collecting packets, which runs inside the models' parallel phase.
    pub(crate) radio_nanos: AtomicU64,
    pub(crate) medium_nanos: u64,
    pub(crate) contact_nanos: u64,
}

/// Messages under way, by sender and the sender's own count: names that do not depend on what other
/// models send.
#[derive(Default)]
pub(crate) struct MailRoom(BTreeMap<(ModelId, u32), Message>);

impl Swarm {
    /// The model's body, if it has one.
    #[inline]
    pub(crate) fn body_of(&self, id: ModelId) -> Option<BodyId> {
        self.bodies.get(id.index()).copied().flatten()
    }

    pub(crate) fn pose_of(&self, id: ModelId, now: SimTime) -> Option<Pose> {
        let motion = self.physics.motion(self.body_of(id)?);
        Some(Pose {
            position: Position::from_si(motion.position(now)),
            attitude: Attitude::from_unit_quat(motion.attitude(now)),
        })
    }

    pub(crate) fn twist_of(&self, id: ModelId, now: SimTime) -> Option<Twist> {
        let motion = self.physics.motion(self.body_of(id)?);
        Some(Twist {
            linear: Velocity::from_si(motion.velocity(now)),
            angular: Rate::from_si(motion.rate(now)),
        })
    }

    pub(crate) fn radius_of(&self, id: ModelId) -> Option<Length> {
        Some(Length::si(
            self.physics.motion(self.body_of(id)?).radius_m(),
        ))
    }

    pub(crate) fn gravity(&self) -> Acceleration {
        self.gravity
    }

    /// Models with a body whose centre is within `radius` of `at`, but for `but`, by id.
    pub(crate) fn neighbors(
        &self,
        at: Position,
        radius: Length,
        now: SimTime,
        but: ModelId,
    ) -> Vec<ModelId> {
        let mut bodies = Vec::new();
        self.physics.near(at.si(), radius.get(), now, &mut bodies);
        let owners = bodies
            .iter()
            .filter_map(|body| self.owners[body.index()].model());
        let mut models: Vec<_> = owners.filter(|id| *id != but).collect();
        models.sort_unstable();
        models
    }

    /// Frames sent, and receptions handed out by the medium.
    pub(crate) fn packets(&self) -> (u64, u64) {
        let totals = self.medium.as_ref().map(|m| m.totals()).unwrap_or_default();
        (totals.sent, totals.received)
    }

    /// Notes which sensors' measurements are kept: those that one of the components wants.
    pub(crate) fn choose_readings(&mut self, components: &[&dyn Component]) {
        let wants = |sensor: &str| components.iter().any(|c| c.wants_reading(sensor));
        let watched = self.gear.iter().enumerate().map(|(model, gear)| {
            let path = self.population.path(ModelId(model as u32));
            let sensors = gear.sensors.iter().enumerate();
            let wanted = sensors.filter(|(_, s)| wants(&format!("{path}/{}", s.name)));
            wanted.fold(0, |bits, (at, _)| bits | 1 << at.min(63))
        });
        let watched: Vec<u64> = match components {
            [] => Vec::new(),
            _ => watched.collect(),
        };
        let any = watched.iter().any(|bits| *bits != 0);
        self.watched = if any { watched } else { Vec::new() };
    }

    /// Whether somebody looks at what a sensor measures.
    pub(crate) fn watches(&self, model: ModelId, sensor: u16) -> bool {
        let bits = self.watched.get(model.index()).copied().unwrap_or(0);
        bits >> sensor.min(63) & 1 != 0
    }
}

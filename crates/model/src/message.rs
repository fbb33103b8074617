//! What reaches a model besides its timers: messages and touches.

use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::{Enu, ImpulseVec, Position, Velocity};
use simbeeotic_world::ObjectId;
use std::any::Any;
use std::fmt;

/// A message from one model to another, delivered as an event.
///
/// Vehicles talk by radio; messages are for what is not physical: a referee, a planner that shares
/// a computer with the hive, a tool.
pub struct Message {
    /// Who sent it.
    pub sender: ModelId,
    /// What it says.
    pub(crate) payload: Box<dyn Any + Send + Sync>,
}

impl Message {
    /// What it says, if it is a `T`.
    pub fn get<T: 'static>(&self) -> Option<&T> {
        self.payload.downcast_ref()
    }
}

impl fmt::Debug for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Message from {}", self.sender)
    }
}

/// What a body can touch and a ray can meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Thing {
    /// The plane at up = 0.
    Ground,
    /// The body of a model.
    Model(ModelId),
    /// An object of the world. [`World::label_of`](simbeeotic_world::World::label_of) and
    /// [`World::meta_of`](simbeeotic_world::World::meta_of) say what is written on it.
    Object(ObjectId),
}

impl Thing {
    /// The model, if it is one.
    pub const fn model(self) -> Option<ModelId> {
        match self {
            Self::Model(id) => Some(id),
            _ => None,
        }
    }

    /// The object of the world, if it is one.
    pub const fn object(self) -> Option<ObjectId> {
        match self {
            Self::Object(id) => Some(id),
            _ => None,
        }
    }
}

/// The body of a model touched something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// The instant of impact.
    pub time: SimTime,
    /// What it touched.
    pub other: Thing,
    /// Where, world frame.
    pub point: Position,
    /// Unit normal, world frame, pointing away from the own body.
    pub normal: [f64; 3],
    /// Velocity of the own body against the other before the impact, world frame.
    pub relative_velocity: Velocity<Enu>,
    /// The impulse on the own body, world frame.
    pub impulse: ImpulseVec<Enu>,
}

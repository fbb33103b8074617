//! What a behaviour is built from, and why building may fail.

use crate::behavior::{Declared, Handler, SentHandler};
use crate::config::{Fault, fault::list};
use crate::host::{Flying, Host};
use crate::instance::{GearPlan, Instance};
use crate::timer::Call;
use simbeeotic_kernel::ModelId;
use simbeeotic_physics::BodyError;
use simbeeotic_radio::{RadioError, RadioId};
use simbeeotic_units::Time;
use simbeeotic_world::generate::GenerateError;
use std::sync::Arc;

/// The box of parts a behaviour is built from.
pub struct Kit<B, H: Host = Flying> {
    pub(crate) gear: Arc<GearPlan>,
    pub(crate) id: ModelId,
    pub(crate) path: Arc<str>,
    pub(crate) seed: u64,
    pub(crate) handlers: Vec<Handler<B, H>>,
    pub(crate) declared: Vec<Declared>,
    /// Sensors whose samples are waited for.
    pub(crate) listeners: Vec<(String, u16, Call)>,
    /// What is called with what became of a request.
    pub(crate) sent: Option<SentHandler<B, H>>,
    /// The platform's radios in the medium, in the order of `gear`; none if there is no channel.
    pub(crate) radios: Vec<RadioId>,
    pub(crate) fault: Option<BuildError>,
}

impl<B, H: Host> Kit<B, H> {
    pub(crate) fn new(instance: &Instance<'_>) -> Self {
        Self {
            gear: Arc::clone(&instance.gear),
            id: instance.id,
            path: Arc::clone(&instance.path),
            seed: instance.seed,
            radios: instance.radios.clone(),
            sent: None,
            handlers: Vec::new(),
            declared: Vec::new(),
            listeners: Vec::new(),
            fault: None,
        }
    }

    /// The radio that stands at this place of the scenario.
    pub(crate) fn radio_at(&self, index: usize) -> RadioHandle {
        RadioHandle {
            index: index as u8,
            id: self.radios.get(index).copied().unwrap_or(OFF_THE_AIR),
        }
    }

    /// Timers cannot fail where they are declared; the first that makes no sense fails the build.
    pub(crate) fn check_time(&mut self, what: &str, time: Time, zero_allowed: bool) {
        let ok = time.is_finite() && (time > Time::ZERO || zero_allowed && time == Time::ZERO);
        if !ok && self.fault.is_none() {
            let least = if zero_allowed {
                "zero or more"
            } else {
                "more than zero"
            };
            let message = format!("a timer's {what} of {time}: it must be {least}");
            self.fault = Some(BuildError::other(message));
        }
    }
}

/// A checked way to one radio of one's own platform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RadioHandle {
    pub(crate) index: u8,
    pub(crate) id: RadioId,
}

/// What stands for the id of a radio where there is no channel.
const OFF_THE_AIR: RadioId = RadioId(u32::MAX);

impl RadioHandle {
    /// Its id in the medium: what [`Packet::radio`](simbeeotic_radio::Packet::radio) and
    /// [`Inbox::radio`](simbeeotic_radio::Inbox::radio) say of packets that it heard. Where there is
    /// no channel it is nobody's.
    #[must_use]
    pub const fn id(self) -> RadioId {
        self.id
    }
}

/// Why a part could not be built from what the scenario says.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// No sensor has this name.
    #[error("no sensor is called `{name}`; on board: {}", on_board(.known))]
    NoSensor {
        /// Asked for.
        name: String,
        /// What the scenario attached.
        known: Vec<String>,
    },
    /// A sensor gives other readings than the behaviour wants.
    #[error("sensor `{name}` gives readings of type {gives}, and {wanted} is wanted")]
    WrongReading {
        /// Asked for.
        name: String,
        /// The reading type wanted.
        wanted: &'static str,
        /// The reading type it has.
        gives: &'static str,
    },
    /// The platform carries no radio.
    #[error("a radio is wanted and there is none on board; add a [model.radio]")]
    NoRadio,
    /// No radio has this name.
    #[error("no radio is called `{name}`; on board: {}", on_board(.known))]
    NoSuchRadio {
        /// Asked for.
        name: String,
        /// What the scenario attached.
        known: Vec<String>,
    },
    /// A parameter is out of its range.
    #[error("`{key}` {message}")]
    Parameter {
        /// The key in the scenario.
        key: &'static str,
        /// What is wrong with it, and what is allowed.
        message: String,
    },
    /// A fault that already knows its place in the scenario.
    #[error("{0}")]
    Placed(Fault),
    /// The body makes no sense to physics.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// A radio's numbers make no sense.
    #[error(transparent)]
    Radio(#[from] RadioError),
    /// Anything else.
    #[error("{0}")]
    Other(String),
}

fn on_board(names: &[String]) -> String {
    if names.is_empty() {
        "nothing".to_owned()
    } else {
        list(names)
    }
}

impl From<GenerateError> for BuildError {
    fn from(error: GenerateError) -> Self {
        Self::parameter(error.key, error.message)
    }
}

impl BuildError {
    /// Parameter `key` is out of range; `message` continues the sentence: "must be positive".
    pub fn parameter(key: &'static str, message: impl Into<String>) -> Self {
        Self::Parameter {
            key,
            message: message.into(),
        }
    }

    /// Any other reason.
    pub fn other(message: impl Into<String>) -> Self {
        Self::Other(message.into())
    }
}

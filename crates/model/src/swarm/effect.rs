//! What models do to others, and what of it is noted for those who look on.

use crate::message::{Message, Thing};
use crate::packets::{OnAir, Reception};
use crate::sensor::Taken;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_physics::Motion;
use simbeeotic_radio::{Command, RadioId, Request};

/// A body's motion as its model has changed it in one call.
#[derive(Clone, Copy)]
pub struct Own {
    pub(crate) motion: Motion,
    /// Whether it was put elsewhere, and did not only get there by moving.
    pub(crate) jumped: bool,
}

/// What a model does to others. Nearly all effects are motions: a box each would cost more.
pub enum Effect {
    /// Its own body moves differently from now on.
    Motion(Motion),
    /// Its own body was put elsewhere, and did not only get there by moving.
    Jump,
    /// A packet goes on the air.
    Transmit(Request),
    /// A radio sleeps, wakes, tunes.
    Command(RadioId, Command),
    /// A message to another model.
    Tell {
        /// To whom.
        receiver: ModelId,
        /// When it arrives.
        at: SimTime,
        /// How many messages the sender had sent before.
        number: u32,
        /// What.
        message: Message,
    },
    /// A line for the log.
    Log(String),
    /// A number for the record.
    Metric {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it is counted in.
        unit: &'static str,
    },
    /// A sensor has measured; noted for recorders only.
    Sensed(u16, Box<Taken>),
    /// Packets were received; noted for recorders only.
    Heard(Box<[Reception]>),
    /// A message has been read: whose, and which.
    Read(ModelId, u32),
}

// In an aligned round all effects of a swarm wait in line: 20 MB of them at 100,000.
const _: () = assert!(size_of::<Effect>() == size_of::<Motion>());

/// Something that happened, for recorders and viewers.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Mark {
    /// A body touched something.
    Touch {
        /// When.
        time: SimTime,
        /// Who.
        a: ModelId,
        /// What.
        b: Thing,
    },
    /// A model wrote a line.
    Log {
        /// When.
        time: SimTime,
        /// Who.
        model: ModelId,
        /// What.
        text: String,
    },
    /// A sensor measured.
    Sensed {
        /// When.
        time: SimTime,
        /// Who carries it.
        model: ModelId,
        /// Which of its sensors, in the scenario's order.
        sensor: u16,
        /// What it read, and what was true.
        taken: Box<Taken>,
    },
    /// Frames began to be sent.
    OnAir {
        /// When.
        time: SimTime,
        /// Which, and who could listen.
        air: Box<OnAir>,
    },
    /// A radio handed packets to its owner.
    Heard {
        /// When.
        time: SimTime,
        /// Which, and how well.
        receptions: Box<[Reception]>,
    },
    /// A model published a number.
    Metric {
        /// When.
        time: SimTime,
        /// Who.
        model: ModelId,
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it is counted in.
        unit: &'static str,
    },
}

//! Who drew how much charge, and what it was drawn from.
//!
//! Every platform has [`Accounts`]: charge by [`Consumer`]. Loads are currents that hold until they are
//! changed ([`Platform::set_load`](crate::Platform::set_load)): nothing happens while they hold, and whoever
//! asks gets current times time up to that instant. Radios keep books of their own, by state.
//!
//! With a `[model.battery]` there is a limit. The battery is settled whenever its platform is woken for any
//! reason (a step of the control law, say), and a timer wakes it when the present load would bring it to the
//! next threshold: [`BatteryEvent`]s come on the nanosecond if the load is constant from the last
//! wake-up on; frames sent or heard meanwhile, which wake nobody, make them late by less than the time in
//! which the load draws what these drew.
//!
//! The equations stand in `cell.rs`, the curve in [`Curve`]. Sums are exact: what consumers drew is what the
//! battery lost, plus what came from chargers; what they got in energy, and the heat in the battery's
//! resistance, is what the battery's charge carried.

mod battery;
mod cell;
mod charging;
mod curve;
mod drawn;
mod original;
mod power;

pub use battery::{Accounting, Battery, BatteryParams, BatteryPreset, OnEmpty, Supply};
pub use charging::{Plug, Plugged};
pub use curve::Curve;
pub use power::{BatteryEvent, BatteryState, Books, Condition, Effort};

pub(crate) use drawn::Drawn;
pub(crate) use original::Original;
pub(crate) use power::{Onboard, Power};

use simbeeotic_units::Charge;

/// What draws charge from a platform's battery.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Consumer {
    /// Keeping the vehicle in the air.
    Hover,
    /// Accelerating it.
    Actuation,
    /// Sending.
    RadioTx,
    /// Receiving.
    RadioRx,
    /// A radio that is on and does neither.
    RadioIdle,
    /// A radio that is asleep.
    RadioSleep,
    /// Sensors.
    Sensors,
    /// Everything else on board.
    Avionics,
}

impl Consumer {
    /// All consumers, in the order of the summary.
    pub const ALL: [Self; 8] = [
        Self::Hover,
        Self::Actuation,
        Self::RadioTx,
        Self::RadioRx,
        Self::RadioIdle,
        Self::RadioSleep,
        Self::Sensors,
        Self::Avionics,
    ];

    /// Its name in summaries and recordings.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hover => "hover",
            Self::Actuation => "actuation",
            Self::RadioTx => "radio-tx",
            Self::RadioRx => "radio-rx",
            Self::RadioIdle => "radio-idle",
            Self::RadioSleep => "radio-sleep",
            Self::Sensors => "sensors",
            Self::Avionics => "avionics",
        }
    }
}

/// Charge drawn, by consumer. Charge is not energy: that hangs on the battery's voltage, see [`Books`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Accounts([f64; Consumer::ALL.len()]);

impl Accounts {
    /// Books `charge` on `consumer`.
    #[inline]
    pub fn draw(&mut self, consumer: Consumer, charge: Charge) {
        self.0[consumer as usize] += charge.get();
    }

    /// What `consumer` has drawn.
    pub fn drawn(&self, consumer: Consumer) -> Charge {
        Charge::si(self.0[consumer as usize])
    }

    /// What all consumers have drawn together.
    pub fn total(&self) -> Charge {
        Charge::si(self.0.iter().sum())
    }

    /// What has been drawn since `before`, by consumer in the order of [`Consumer::ALL`], C.
    pub(crate) fn since(&self, before: &Self) -> [f64; Consumer::ALL.len()] {
        std::array::from_fn(|at| self.0[at] - before.0[at])
    }

    /// Takes another set of accounts away from this one.
    pub(crate) fn subtract(&mut self, other: &Self) {
        for (mine, theirs) in self.0.iter_mut().zip(other.0) {
            *mine -= theirs;
        }
    }

    /// Adds another set of accounts to this one.
    pub fn add(&mut self, other: &Self) {
        for (mine, theirs) in self.0.iter_mut().zip(other.0) {
            *mine += theirs;
        }
    }
}

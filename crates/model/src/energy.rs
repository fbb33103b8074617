//! Who drew how much charge.

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
    /// Sensors.
    Sensors,
    /// Everything else on board.
    Avionics,
}

impl Consumer {
    /// All consumers, in the order of the summary.
    pub const ALL: [Self; 7] = [
        Self::Hover,
        Self::Actuation,
        Self::RadioTx,
        Self::RadioRx,
        Self::RadioIdle,
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
            Self::Sensors => "sensors",
            Self::Avionics => "avionics",
        }
    }
}

/// Charge drawn, by consumer. Charge is not energy: multiply by the battery's voltage for that.
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

    /// Its last word, for having the cache line fetched early that holds most of it; what the word is
    /// does not matter.
    pub(crate) fn touch(&self) -> u64 {
        let [.., last] = self.0;
        last.to_bits()
    }

    /// What all consumers have drawn together.
    pub fn total(&self) -> Charge {
        Charge::si(self.0.iter().sum())
    }

    /// Adds another set of accounts to this one.
    pub fn add(&mut self, other: &Self) {
        for (mine, theirs) in self.0.iter_mut().zip(other.0) {
            *mine += theirs;
        }
    }
}

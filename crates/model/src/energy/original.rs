//! The original's accounting, so that its figures can be compared.
//!
//! ```text
//! motors   at each step of the control law, the step's current times its period, ahead
//! tx, rx   at each frame, payload bytes / 125 / (kbit/s) seconds times the current
//! idle     every 100 ms from the start on: 100 ms less what was sent and heard since, times the current
//! ```
//! So after 2 s at 10 Hz 21 steps are booked, not 20; frames heard at once add up; overhead bytes take no
//! time. Source: the original's `SimpleBee`, `AbstractRadio`.

use super::{Accounts, Consumer};
use simbeeotic_kernel::SimTime;
use simbeeotic_radio::RadioSpec;
use simbeeotic_units::{Charge, Current, Time};

/// Nanoseconds between two looks at an idle radio.
const LOOK_NS: u64 = 100_000_000;

/// The books of one platform.
#[derive(Clone, Debug, Default)]
pub(crate) struct Original {
    /// Period of the control law, if there is one.
    pub(crate) step: Option<Time>,
    radios: Vec<Books>,
}

/// Seconds of one radio.
#[derive(Clone, Copy, Debug, Default)]
struct Books {
    tx_s: f64,
    rx_s: f64,
    /// The same since the last look, and up to it.
    busy_s: f64,
    busy_before_s: f64,
    looks: u64,
}

impl Books {
    fn look(&mut self, now: SimTime) {
        let looks = now.nanos() / LOOK_NS + 1;
        if looks > self.looks {
            self.looks = looks;
            self.busy_before_s += std::mem::take(&mut self.busy_s);
        }
    }
}

impl Original {
    pub(crate) fn new(radios: usize) -> Self {
        Self {
            step: None,
            radios: vec![Books::default(); radios],
        }
    }

    /// What a load of `current` draws until the next step of the control law.
    pub(crate) fn ahead(&self, current: Current) -> Charge {
        self.step.map_or(Charge::ZERO, |step| current * step)
    }

    /// Books frames of these many bytes together, sent or heard.
    pub(crate) fn frames(
        &mut self,
        radio: usize,
        spec: &RadioSpec,
        sent: bool,
        payload_bytes: usize,
        now: SimTime,
    ) {
        let Some(books) = self.radios.get_mut(radio) else {
            return;
        };
        books.look(now);
        let kbit_s = spec.data_rate.get() * 1e-3;
        let airtime_s = payload_bytes as f64 / 125.0 / kbit_s;
        books.busy_s += airtime_s;
        if sent {
            books.tx_s += airtime_s;
        } else {
            books.rx_s += airtime_s;
        }
    }

    /// Adds what radio `radio` has drawn.
    pub(crate) fn add(&self, radio: usize, spec: &RadioSpec, now: SimTime, to: &mut Accounts) {
        let Some(mut books) = self.radios.get(radio).copied() else {
            return;
        };
        books.look(now);
        let idle_s = (books.looks * LOOK_NS) as f64 * 1e-9 - books.busy_before_s;
        let spent = [
            (Consumer::RadioTx, books.tx_s, spec.currents.tx),
            (Consumer::RadioRx, books.rx_s, spec.currents.rx),
            (Consumer::RadioIdle, idle_s, spec.currents.idle),
        ];
        for (consumer, seconds, current) in spent {
            to.draw(consumer, current * Time::si(seconds));
        }
    }
}

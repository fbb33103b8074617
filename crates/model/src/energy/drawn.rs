//! Loads that hold until they change, settled when somebody asks.

use super::{Accounts, Consumer};
use simbeeotic_kernel::SimTime;
use simbeeotic_units::{Charge, Current};

/// What one consumer has drawn, and draws.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
struct Flow {
    charge_c: f64,
    current_a: f64,
}

/// The loads of one model. What every flyer has lies here, the rest behind a pointer: most have none.
#[derive(Clone, Debug, Default)]
#[repr(C)]
pub(crate) struct Drawn {
    /// Hovering and actuation.
    motors: [Flow; 2],
    /// Up to when all flows are settled.
    since: SimTime,
    more: Option<Box<[Flow; Consumer::ALL.len()]>>,
}

const _: () = assert!(size_of::<Drawn>() == 48);

impl Drawn {
    /// Books `charge` at once.
    #[inline]
    pub(crate) fn draw(&mut self, consumer: Consumer, charge: Charge) {
        self.flow(consumer).charge_c += charge.get();
    }

    /// `consumer` draws `current` from `now` on.
    #[inline]
    pub(crate) fn load(&mut self, consumer: Consumer, current: Current, now: SimTime) {
        self.settle(now);
        self.flow(consumer).current_a = current.get();
    }

    #[inline]
    fn flow(&mut self, consumer: Consumer) -> &mut Flow {
        match consumer {
            Consumer::Hover => &mut self.motors[0],
            Consumer::Actuation => &mut self.motors[1],
            other => &mut self.more.get_or_insert_default()[other as usize],
        }
    }

    #[inline]
    fn settle(&mut self, now: SimTime) {
        let span_s = seconds(self.since, now);
        self.since = now;
        if span_s > 0.0 {
            let more = self.more.iter_mut().flat_map(|more| more.iter_mut());
            for flow in self.motors.iter_mut().chain(more) {
                flow.charge_c += flow.current_a * span_s;
            }
        }
    }

    /// What has been drawn up to `now`.
    pub(crate) fn at(&self, now: SimTime) -> Accounts {
        let span_s = seconds(self.since, now);
        let mut accounts = Accounts::default();
        let mut book = |consumer, flow: &Flow| {
            let charge_c = flow.charge_c + flow.current_a * span_s;
            accounts.draw(consumer, Charge::si(charge_c));
        };
        book(Consumer::Hover, &self.motors[0]);
        book(Consumer::Actuation, &self.motors[1]);
        if let Some(more) = &self.more {
            for (consumer, flow) in Consumer::ALL.into_iter().zip(more.iter()) {
                book(consumer, flow);
            }
        }
        accounts
    }

    /// What all draw now, A.
    pub(crate) fn current_a(&self) -> f64 {
        let more = self.more.iter().flat_map(|more| more.iter());
        self.motors.iter().chain(more).map(|f| f.current_a).sum()
    }

    /// Nobody draws anything from `now` on.
    pub(crate) fn cut(&mut self, now: SimTime) {
        self.settle(now);
        let more = self.more.iter_mut().flat_map(|more| more.iter_mut());
        for flow in self.motors.iter_mut().chain(more) {
            flow.current_a = 0.0;
        }
    }

    /// A word of it, for having its memory fetched early; what it is does not matter.
    pub(crate) fn touch(&self) -> u64 {
        self.since.nanos()
    }
}

/// From one instant to another that does not lie before it.
pub(super) fn seconds(from: SimTime, to: SimTime) -> f64 {
    to.nanos().saturating_sub(from.nanos()) as f64 * 1e-9
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loads_hold_until_they_change_and_cost_nothing_meanwhile() {
        let mut drawn = Drawn::default();
        let at = SimTime::from_millis;
        drawn.load(Consumer::Hover, Current::si(0.5), at(1000));
        drawn.load(Consumer::Sensors, Current::si(0.01), at(2000));
        drawn.draw(Consumer::Avionics, Charge::si(0.25));
        drawn.load(Consumer::Hover, Current::ZERO, at(5000));
        let accounts = drawn.at(at(12_000));
        assert_eq!(accounts.drawn(Consumer::Hover), Charge::si(2.0));
        assert!((accounts.drawn(Consumer::Sensors).get() - 0.1).abs() < 1e-15);
        assert_eq!(accounts.drawn(Consumer::Avionics), Charge::si(0.25));
        assert_eq!(drawn.current_a(), 0.01);
        drawn.cut(at(12_000));
        assert_eq!(drawn.at(at(50_000)), accounts);
    }
}

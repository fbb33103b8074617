//! Time and charge by state, in closed form: an idle radio costs no events.
//!
//! Sending and receiving are booked as spans when they happen. What is neither, nor sleep, was idle:
//! nobody has to look in from time to time, as the original did ten times a second for each radio.
//!
//! Where a medium lets a radio take in several frames at once (the simple one), the spans overlap;
//! time is booked once, since a receiver draws its current however many frames arrive.

use crate::radio::{Currents, RadioState};
use simbeeotic_kernel::SimTime;
use simbeeotic_units::{Charge, Current, Time};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// How long a radio was in each state, and what that drew.
///
/// While a radio both sends and receives (possible in the simple medium only), that time counts for
/// both states.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Usage {
    time: [Time; RadioState::ALL.len()],
    charge: [Charge; RadioState::ALL.len()],
}

impl Usage {
    /// Time spent in a state.
    #[must_use]
    pub fn time(&self, state: RadioState) -> Time {
        self.time[state as usize]
    }

    /// Charge drawn in a state.
    #[must_use]
    pub fn charge(&self, state: RadioState) -> Charge {
        self.charge[state as usize]
    }

    /// Charge drawn in all states.
    #[must_use]
    pub fn total(&self) -> Charge {
        RadioState::ALL
            .iter()
            .fold(Charge::ZERO, |sum, &state| sum + self.charge(state))
    }
}

/// A number that is written by one thread at a time, through a shared reference.
///
/// Only the thread that runs a platform books on its radios, so plain loads and stores will do; they
/// are atomic because the type system cannot know.
#[derive(Debug, Default)]
pub(crate) struct Tally(AtomicU64);

impl Tally {
    pub(crate) fn get(&self) -> u64 {
        self.0.load(Relaxed)
    }

    pub(crate) fn set(&self, value: u64) {
        self.0.store(value, Relaxed);
    }

    pub(crate) fn add(&self, more: u64) {
        self.set(self.get() + more);
    }
}

/// The union of time spans that are booked in the order of their beginnings.
#[derive(Debug, Default)]
struct Spans {
    /// Length of the union, ns.
    total: Tally,
    /// End of the last span, ns.
    until: Tally,
}

impl Spans {
    fn book(&self, from: u64, to: u64) {
        let until = self.until.get();
        if to > until {
            self.total.add(to - from.max(until));
            self.until.set(to);
        }
    }

    /// Length of the part before `at`, for an `at` not before the last span's beginning.
    fn before(&self, at: u64) -> u64 {
        self.total.get() - self.until.get().saturating_sub(at).min(self.total.get())
    }

    fn covers(&self, at: u64) -> bool {
        at < self.until.get()
    }
}

/// The books of one radio. What a reception touches comes first.
#[derive(Debug, Default)]
#[repr(C)]
pub(crate) struct Ledger {
    rx: Spans,
    /// Union of sending and receiving.
    busy: Spans,
    tx: Spans,
    /// Sleep that is over, ns.
    slept_ns: u64,
    asleep_since_ns: Option<u64>,
    /// Charge and time of sending up to the last change of the power level.
    tx_settled: Charge,
    tx_settled_ns: u64,
}

impl Ledger {
    /// Books a transmission of `airtime_ns` from `now` on.
    pub(crate) fn transmit(&self, now: SimTime, airtime_ns: u64) {
        let (from, to) = (now.nanos(), now.nanos().saturating_add(airtime_ns));
        self.tx.book(from, to);
        self.busy.book(from, to);
    }

    /// Books a reception of `airtime_ns` from `now` on.
    pub(crate) fn receive(&self, now: SimTime, airtime_ns: u64) {
        let (from, to) = (now.nanos(), now.nanos().saturating_add(airtime_ns));
        self.rx.book(from, to);
        self.busy.book(from, to);
    }

    /// Falls asleep at `now`, or when it is done with what it is doing.
    pub(crate) fn sleep(&mut self, now: SimTime) {
        if self.asleep_since_ns.is_none() {
            self.asleep_since_ns = Some(now.nanos().max(self.busy.until.get()));
        }
    }

    /// Wakes at `now`.
    pub(crate) fn wake(&mut self, now: SimTime) {
        if let Some(since) = self.asleep_since_ns.take() {
            self.slept_ns += now.nanos().saturating_sub(since);
        }
    }

    pub(crate) fn asleep(&self) -> bool {
        self.asleep_since_ns.is_some()
    }

    /// Sending draws another current from now on: closes the account of the old one.
    pub(crate) fn settle(&mut self, old: Current) {
        self.tx_settled = self.tx_charge(old, self.tx.total.get());
        self.tx_settled_ns = self.tx.total.get();
    }

    fn tx_charge(&self, current: Current, tx_ns: u64) -> Charge {
        // A span under way at the change was settled as a whole: until it ends, its rest is negative.
        self.tx_settled + current * (span(tx_ns) - span(self.tx_settled_ns))
    }

    pub(crate) fn state(&self, now: SimTime) -> RadioState {
        let at = now.nanos();
        if self.tx.covers(at) {
            RadioState::Transmit
        } else if self.rx.covers(at) {
            RadioState::Receive
        } else if self.asleep() {
            RadioState::Sleep
        } else {
            RadioState::Idle
        }
    }

    pub(crate) fn usage(&self, currents: &Currents, until: SimTime) -> Usage {
        let at = until.nanos();
        let [tx, rx, busy] = [&self.tx, &self.rx, &self.busy].map(|spans| spans.before(at));
        let sleeping = self
            .asleep_since_ns
            .map_or(0, |since| at.saturating_sub(since));
        let sleep = self.slept_ns + sleeping;
        let idle = at.saturating_sub(busy + sleep);
        self.account(currents, [sleep, idle, 0, rx, tx])
    }

    /// The same for a radio whose receiver runs whenever it is awake and does not send, where
    /// `rx_ns` of this time went into frames.
    pub(crate) fn usage_listening(&self, currents: &Currents, until: SimTime, rx_ns: u64) -> Usage {
        let at = until.nanos();
        let tx = self.tx.before(at);
        let sleeping = self
            .asleep_since_ns
            .map_or(0, |since| at.saturating_sub(since));
        let sleep = self.slept_ns + sleeping;
        let listen = at.saturating_sub(tx + sleep + rx_ns);
        self.account(currents, [sleep, 0, listen, rx_ns, tx])
    }

    /// Times in the order of `RadioState::ALL`, and what they drew.
    fn account(&self, currents: &Currents, nanos: [u64; RadioState::ALL.len()]) -> Usage {
        let time = nanos.map(span);
        Usage {
            time,
            charge: [
                currents.sleep * time[0],
                currents.idle * time[1],
                currents.rx * time[2],
                currents.rx * time[3],
                self.tx_charge(currents.tx, nanos[4]),
            ],
        }
    }
}

fn span(nanos: u64) -> Time {
    Time::si(nanos as f64 * 1e-9)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CURRENTS: Currents = Currents {
        tx: Current::si(0.020),
        rx: Current::si(0.010),
        idle: Current::si(0.001),
        sleep: Current::si(0.0),
    };

    fn ms(millis: u64) -> SimTime {
        SimTime::from_millis(millis)
    }

    fn times_ms(ledger: &Ledger, until: u64) -> [f64; RadioState::ALL.len()] {
        let usage = ledger.usage(&CURRENTS, ms(until));
        RadioState::ALL.map(|state| (usage.time(state).secs() * 1e9).round() / 1e6)
    }

    #[test]
    fn what_is_not_booked_was_idle() {
        let ledger = Ledger::default();
        ledger.transmit(ms(10), 2_000_000);
        ledger.receive(ms(20), 5_000_000);
        assert_eq!(times_ms(&ledger, 100), [0.0, 93.0, 0.0, 5.0, 2.0]);
        let usage = ledger.usage(&CURRENTS, ms(100));
        let expected = 93e-3 * 0.001 + 5e-3 * 0.010 + 2e-3 * 0.020;
        assert!((usage.total().coulombs() - expected).abs() < 1e-12);
    }

    #[test]
    fn frames_at_the_same_time_take_their_time_once() {
        let ledger = Ledger::default();
        for _ in 0..1000 {
            ledger.receive(ms(10), 2_000_000);
        }
        ledger.receive(ms(11), 3_000_000);
        ledger.transmit(ms(13), 2_000_000);
        assert_eq!(times_ms(&ledger, 20), [0.0, 15.0, 0.0, 4.0, 2.0]);
    }

    #[test]
    fn a_span_under_way_counts_up_to_now() {
        let ledger = Ledger::default();
        ledger.transmit(ms(10), 4_000_000);
        assert_eq!(times_ms(&ledger, 11), [0.0, 10.0, 0.0, 0.0, 1.0]);
        assert_eq!(ledger.state(ms(11)), RadioState::Transmit);
        assert_eq!(ledger.state(ms(14)), RadioState::Idle);
    }

    #[test]
    fn sleep_is_neither_idle_nor_busy() {
        let mut ledger = Ledger::default();
        ledger.transmit(ms(10), 2_000_000);
        ledger.sleep(ms(11));
        assert_eq!(times_ms(&ledger, 20), [8.0, 10.0, 0.0, 0.0, 2.0]);
        ledger.wake(ms(30));
        assert_eq!(times_ms(&ledger, 40), [18.0, 20.0, 0.0, 0.0, 2.0]);
    }

    #[test]
    fn a_new_power_level_leaves_the_past_alone() {
        let mut ledger = Ledger::default();
        ledger.transmit(ms(0), 10_000_000);
        ledger.settle(CURRENTS.tx);
        let weak = Currents {
            tx: Current::si(0.005),
            ..CURRENTS
        };
        ledger.transmit(ms(50), 10_000_000);
        let drawn = ledger.usage(&weak, ms(100)).charge(RadioState::Transmit);
        assert!((drawn.coulombs() - (10e-3 * 0.020 + 10e-3 * 0.005)).abs() < 1e-12);
    }
}

//! Timers: many wake-ups of one agent, each of which can be moved or called off at any time.
//!
//! Events cannot be taken out of the pending set; a timer outlives them instead. Each arming has a
//! number, the *generation*, which travels in the [`Wake`]. When the event comes, it counts only if the
//! timer is still of that generation. Moving or cancelling a timer is one increment, and the event
//! left behind is let pass ([`Timers::fired`] says `None`).

use crate::{SimTime, Wake};

/// The timers of one agent, 24 bytes each. The first two lie in the table itself, next to what else
/// the agent keeps: with 100,000 agents the way to memory of their own costs more than all the rest of
/// a wake-up.
///
/// They do not schedule anything: what is armed comes back as a [`Wake`] for the caller to schedule.
/// A wake-up is handled in three steps:
///
/// ```
/// use simbeeotic_kernel::{SimTime, Timers, Wake};
///
/// let mut timers = Timers::new();
/// let blink = timers.add(7); // 7 is ours: which handler, say
/// let period = 100_000_000; // ns
/// let wake: Wake = timers.arm(blink, SimTime::ZERO, Some(period)); // schedule it at 0 s
///
/// // ... the event comes:
/// let fired = timers.fired(wake).expect("nobody moved it");
/// assert_eq!(fired.timer, blink);
/// assert_eq!(timers.label(blink), 7);
/// // ... the handler runs; it may arm, move or cancel any timer, this one too ...
/// let (at, _wake) = timers.rearm(fired).expect("the handler left it alone");
/// assert_eq!(at, SimTime::from_millis(100)); // schedule it there
/// ```
///
/// Methods panic if `timer` is not one of this table.
#[derive(Clone, Debug, Default)]
#[repr(C)]
pub struct Timers {
    first: [Slot; NEAR],
    /// A boxed slice is 8 bytes smaller than a vector, and timers are added once, at the start.
    more: Box<[Slot]>,
}

// One cache line: with a number of timers beside them, all that a model keeps took 64 bytes more.
const _: () = assert!(size_of::<Timers>() == 64);

/// Timers that lie in the table itself.
const NEAR: usize = 2;

/// A firing under way: between [`Timers::fired`] and [`Timers::rearm`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fired {
    /// Which timer.
    pub timer: u32,
    generation: u32,
}

#[derive(Clone, Copy, Debug, Default)]
struct Slot {
    /// What it is depends on the state.
    time: SimTime,
    /// ns; 0 if it fires once.
    period: u64,
    /// Number of the latest arming or cancelling, 31 bits.
    generation: u32,
    /// The caller's.
    label: u16,
    state: State,
}

const _: () = assert!(size_of::<Slot>() == 24);

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
enum State {
    /// There is no timer here.
    #[default]
    Vacant,
    /// Not armed, and has not fired since it was.
    Idle,
    /// Fires next at `time`, for the first time since it was armed.
    Armed,
    /// Fires next at `time`, a period after the last time.
    Again,
    /// Its handler is running; fired at `time`.
    Firing,
    /// Not armed; fired last at `time`.
    Done,
}

impl Timers {
    /// No timers.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a timer that is not armed, and returns its number: 0, 1, 2, ... The label is a word of the
    /// caller's own that stays with the timer.
    ///
    /// Timers stay for good. Arm one again instead of adding one for each wake-up.
    pub fn add(&mut self, label: u16) -> u32 {
        let timer = self.len();
        let slot = Slot {
            label,
            state: State::Idle,
            ..Slot::default()
        };
        match self.first.get_mut(timer) {
            Some(place) => *place = slot,
            None => {
                let mut more = std::mem::take(&mut self.more).into_vec();
                more.push(slot);
                self.more = more.into_boxed_slice();
            }
        }
        timer as u32
    }

    /// How many timers there are.
    #[must_use]
    pub fn len(&self) -> usize {
        let taken = |slot: &&Slot| slot.state != State::Vacant;
        self.first.iter().filter(taken).count() + self.more.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A word of the first timer, for having the memory of the table fetched early; what it is does not
    /// matter.
    #[inline]
    #[must_use]
    pub fn touch(&self) -> u64 {
        self.first[0].period
    }

    /// The label that a timer was added with.
    #[inline]
    #[must_use]
    pub fn label(&self, timer: u32) -> u16 {
        self.slot(timer).label
    }

    /// Arms a timer for `at`, and from then on every `period_ns` if given (0 counts as none). Returns
    /// the wake-up to be scheduled at `at`. What the timer was armed for before is forgotten, also from
    /// within its own handler.
    #[must_use = "the wake-up has to be scheduled"]
    pub fn arm(&mut self, timer: u32, at: SimTime, period_ns: Option<u64>) -> Wake {
        let slot = self.slot_mut(timer);
        slot.time = at;
        slot.period = period_ns.unwrap_or(0);
        slot.state = State::Armed;
        slot.wake(timer)
    }

    /// Keeps a timer from firing until it is armed again; also from within its own handler.
    pub fn cancel(&mut self, timer: u32) {
        let slot = self.slot_mut(timer);
        (slot.state, slot.time) = match slot.last() {
            Some(last) => (State::Done, last),
            None => (State::Idle, SimTime::ZERO),
        };
        slot.bump();
    }

    /// Which timer a wake-up fires; `None` if it was moved or cancelled since, or is no timer's.
    #[inline]
    #[must_use]
    pub fn fired(&mut self, wake: Wake) -> Option<Fired> {
        let slot = self.get_mut(wake.arg)?;
        let current = wake.tag == Wake::TIMER | slot.generation;
        if !(current && matches!(slot.state, State::Armed | State::Again)) {
            return None;
        }
        slot.state = State::Firing;
        Some(Fired {
            timer: wake.arg,
            generation: slot.generation,
        })
    }

    /// Arms a periodic timer for its next period, after its handler has run. Returns when, and the
    /// wake-up to be scheduled then; `None` if it fires only once, or if the handler did something else
    /// with it.
    #[inline]
    pub fn rearm(&mut self, fired: Fired) -> Option<(SimTime, Wake)> {
        let slot = self.get_mut(fired.timer)?;
        if slot.generation != fired.generation || slot.state != State::Firing {
            return None;
        }
        match slot.time.checked_add_nanos(slot.period) {
            Some(next) if slot.period > 0 => {
                slot.time = next;
                slot.state = State::Again;
                Some((next, slot.wake(fired.timer)))
            }
            _ => {
                slot.state = State::Done;
                None
            }
        }
    }

    /// When a timer fires next; `None` if it is not armed. Within the handler of a periodic timer, the
    /// time a period from now.
    #[must_use]
    pub fn next_firing(&self, timer: u32) -> Option<SimTime> {
        let slot = self.slot(timer);
        match slot.state {
            State::Armed | State::Again => Some(slot.time),
            State::Firing if slot.period > 0 => slot.time.checked_add_nanos(slot.period),
            State::Firing | State::Vacant | State::Idle | State::Done => None,
        }
    }

    /// When a timer last fired since it was armed; within its handler, now.
    #[must_use]
    pub fn last_fired(&self, timer: u32) -> Option<SimTime> {
        self.slot(timer).last()
    }

    /// The period of a timer, ns, if it has one.
    #[must_use]
    pub fn period_ns(&self, timer: u32) -> Option<u64> {
        Some(self.slot(timer).period).filter(|period| *period > 0)
    }

    #[inline]
    fn get_mut(&mut self, timer: u32) -> Option<&mut Slot> {
        let slot = match self.first.get_mut(timer as usize) {
            Some(slot) => slot,
            None => self.more.get_mut(timer as usize - NEAR)?,
        };
        (slot.state != State::Vacant).then_some(slot)
    }

    #[inline]
    fn slot(&self, timer: u32) -> &Slot {
        let far = || self.more.get(timer as usize - NEAR);
        let slot = self.first.get(timer as usize).or_else(far);
        match slot.filter(|slot| slot.state != State::Vacant) {
            Some(slot) => slot,
            None => panic!("there is no timer {timer}"),
        }
    }

    fn slot_mut(&mut self, timer: u32) -> &mut Slot {
        match self.get_mut(timer) {
            Some(slot) => slot,
            None => panic!("there is no timer {timer}"),
        }
    }
}

impl Slot {
    fn bump(&mut self) {
        self.generation = (self.generation + 1) & !Wake::TIMER;
    }

    /// A wake-up of a new generation.
    fn wake(&mut self, timer: u32) -> Wake {
        self.bump();
        Wake {
            tag: Wake::TIMER | self.generation,
            arg: timer,
        }
    }

    fn last(&self) -> Option<SimTime> {
        match self.state {
            State::Vacant | State::Idle | State::Armed => None,
            State::Again => Some(SimTime::from_nanos(self.time.nanos() - self.period)),
            State::Firing | State::Done => Some(self.time),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: Option<u64> = Some(10);

    fn ns(nanos: u64) -> SimTime {
        SimTime::from_nanos(nanos)
    }

    #[test]
    fn a_periodic_timer_fires_every_period_without_drift() {
        let mut timers = Timers::new();
        let t = timers.add(0);
        let mut wake = timers.arm(t, ns(3), PERIOD);
        assert_eq!(
            (timers.next_firing(t), timers.last_fired(t)),
            (Some(ns(3)), None)
        );
        for k in 0..5 {
            let fired = timers.fired(wake).unwrap();
            assert_eq!(timers.last_fired(t), Some(ns(3 + 10 * k)));
            assert_eq!(timers.next_firing(t), Some(ns(13 + 10 * k)));
            let at;
            (at, wake) = timers.rearm(fired).unwrap();
            assert_eq!(at, ns(13 + 10 * k));
            assert_eq!(timers.last_fired(t), Some(ns(3 + 10 * k)));
        }
    }

    #[test]
    fn a_one_shot_fires_once() {
        let mut timers = Timers::new();
        let t = timers.add(0);
        let wake = timers.arm(t, ns(3), None);
        let fired = timers.fired(wake).unwrap();
        assert_eq!(timers.next_firing(t), None);
        assert_eq!(timers.rearm(fired), None);
        assert_eq!(timers.fired(wake), None);
        assert_eq!(
            (timers.next_firing(t), timers.last_fired(t)),
            (None, Some(ns(3)))
        );
    }

    #[test]
    fn a_cancelled_or_moved_timer_lets_its_event_pass() {
        let mut timers = Timers::new();
        let (a, b) = (timers.add(0), timers.add(0));
        let stale = timers.arm(a, ns(3), PERIOD);
        let other = timers.arm(b, ns(3), PERIOD);
        timers.cancel(a);
        assert_eq!((timers.fired(stale), timers.next_firing(a)), (None, None));
        let moved = timers.arm(a, ns(3), None);
        assert_eq!(timers.fired(stale), None);
        assert!(timers.fired(moved).is_some());
        assert!(timers.fired(other).is_some());
    }

    #[test]
    fn what_a_handler_does_to_its_own_timer_wins() {
        let mut timers = Timers::new();
        let t = timers.add(0);

        let wake = timers.arm(t, ns(3), PERIOD);
        let fired = timers.fired(wake).unwrap();
        timers.cancel(t);
        assert_eq!(timers.rearm(fired), None);
        assert_eq!(
            (timers.next_firing(t), timers.last_fired(t)),
            (None, Some(ns(3)))
        );

        let wake = timers.arm(t, ns(5), PERIOD);
        let fired = timers.fired(wake).unwrap();
        let reset = timers.arm(t, ns(7), Some(100));
        assert_eq!(timers.rearm(fired), None);
        let fired = timers.fired(reset).unwrap();
        assert_eq!(timers.rearm(fired).unwrap().0, ns(107));

        // Also if it is armed for this very instant.
        let wake = timers.arm(t, ns(200), PERIOD);
        let fired = timers.fired(wake).unwrap();
        let now = timers.arm(t, ns(200), PERIOD);
        assert_eq!(timers.rearm(fired), None);
        assert!(timers.fired(now).is_some());
    }

    #[test]
    fn wake_ups_of_others_fire_nothing() {
        let mut timers = Timers::new();
        let t = timers.add(0);
        let wake = timers.arm(t, ns(3), None);
        assert_eq!(
            timers.fired(Wake::new(wake.tag & !Wake::TIMER, wake.arg)),
            None
        );
        assert_eq!(timers.fired(Wake::new(wake.tag, 9)), None);
        assert!(timers.fired(wake).is_some());
    }

    #[test]
    fn the_end_of_time_ends_a_period() {
        let mut timers = Timers::new();
        let t = timers.add(0);
        let wake = timers.arm(t, ns(u64::MAX - 3), PERIOD);
        let fired = timers.fired(wake).unwrap();
        assert_eq!(timers.next_firing(t), None);
        assert_eq!(timers.rearm(fired), None);
    }

    #[test]
    fn timers_within_the_table_and_beyond_are_alike() {
        let mut timers = Timers::new();
        let all: Vec<u32> = (0..5).map(|label| timers.add(100 + label)).collect();
        assert_eq!((&all[..], timers.len()), (&[0, 1, 2, 3, 4][..], 5));
        for &timer in &all {
            assert_eq!(timers.label(timer), 100 + timer as u16);
            let wake = timers.arm(timer, ns(u64::from(timer)), PERIOD);
            let fired = timers.fired(wake).unwrap();
            assert_eq!(timers.rearm(fired).unwrap().0, ns(u64::from(timer) + 10));
        }
    }
}

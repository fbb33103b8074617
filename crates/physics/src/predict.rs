//! When two segments meet: a function of the two segments, and of nothing else.
//!
//! A search over a span that depends on when it was asked for would depend, in its last bits, on when
//! neighbour lists happen to be made. So the search begins at places that only the segments and the
//! calendar know: time is cut into windows of 2^27 ns (134 ms), and within each window the search
//! begins at the later of the window's begin and the later segment's begin. Whoever asks, at whatever
//! time before the meeting, gets the same nanosecond.

use crate::motion::{Motion, seconds_between};
use crate::root::Quartic;
use simbeeotic_kernel::SimTime;

/// Length of a window, as a power of two of nanoseconds.
const WINDOW_LOG2: u32 = 27;

/// Which way the distance passes zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Passage {
    /// From apart to touching; or, if they overlap already, from parting to approaching.
    In,
    /// From touching to apart.
    Out,
}

/// Squared distance of two balls' centres less that at touch, with time counted from `from`.
fn pair_distance(a: &Motion, b: &Motion, from: SimTime) -> Quartic {
    let (pa, va, aa) = a.kinematics(from);
    let (pb, vb, ab) = b.kinematics(from);
    let (p, v, a_rel) = (pb - pa, vb - va, ab - aa);
    let touch = a.radius_m() + b.radius_m();
    Quartic([
        p.length_squared() - touch * touch,
        2.0 * p.dot(v),
        v.length_squared() + p.dot(a_rel),
        v.dot(a_rel),
        0.25 * a_rel.length_squared(),
    ])
}

/// Height of a ball's lowest point above the ground, with time counted from `from`.
fn ground_distance(body: &Motion, from: SimTime) -> Quartic {
    let (p, v, a) = body.kinematics(from);
    Quartic([p.z - body.radius_m(), v.z, 0.5 * a.z, 0.0, 0.0])
}

/// The first passage of two balls from `origin` on, if it comes by `horizon` or little later.
///
/// `origin` is when both segments hold and the pair is known to be on its side of the passage; `now`
/// lies between it and the passage, if there is one.
#[inline]
pub(crate) fn pair_passage(
    a: &Motion,
    b: &Motion,
    passage: Passage,
    origin: SimTime,
    now: SimTime,
    horizon: SimTime,
) -> Option<SimTime> {
    let distance = |from| match passage {
        Passage::In => pair_distance(a, b, from),
        Passage::Out => pair_distance(a, b, from).negated(),
    };
    let mut window = origin.max(now).nanos() >> WINDOW_LOG2;
    let mut from = origin.max(SimTime::from_nanos(window << WINDOW_LOG2));
    // A pair may be held beyond the horizon.
    if from > horizon {
        return None;
    }
    let mut quartic = distance(from);
    if !quartic.may_fall(seconds_between(from, horizon)) {
        return None;
    }
    loop {
        let to = SimTime::from_nanos((window + 1).saturating_mul(1 << WINDOW_LOG2));
        if let Some(s) = quartic.first_fall(seconds_between(from, to)) {
            return Some(after(from, s).max(now));
        }
        if to > horizon {
            return None;
        }
        (window, from) = (window + 1, to);
        quartic = distance(from);
    }
}

/// The first passage of a ball through the ground from `origin` on, if it comes by `horizon`.
#[inline]
pub(crate) fn ground_passage(
    body: &Motion,
    passage: Passage,
    origin: SimTime,
    now: SimTime,
    horizon: SimTime,
) -> Option<SimTime> {
    if origin > horizon {
        return None;
    }
    let height = ground_distance(body, origin);
    let height = if passage == Passage::In {
        height
    } else {
        height.negated()
    };
    let to = seconds_between(origin, horizon);
    if !height.may_fall(to) {
        return None;
    }
    height.first_fall(to).map(|s| after(origin, s).max(now))
}

/// Whether two balls are apart at `t`.
pub(crate) fn pair_apart(a: &Motion, b: &Motion, t: SimTime) -> bool {
    pair_distance(a, b, t).0[0] > 0.0
}

/// Whether a ball is above the ground at `t`.
pub(crate) fn ground_apart(body: &Motion, t: SimTime) -> bool {
    ground_distance(body, t).0[0] > 0.0
}

/// `s` seconds after `from`, to the nearest nanosecond.
fn after(from: SimTime, s: f64) -> SimTime {
    from.saturating_add_nanos((s * 1e9).round() as u64)
}

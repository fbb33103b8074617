//! When two segments meet: a function of the two segments, and of nothing else.
//!
//! A search over a span that depends on when it was asked for would depend, in its last bits, on when
//! neighbour lists happen to be made. So the search begins at places that only the segments and the
//! calendar know: time is cut into windows, of 2^27 ns (134 ms) for balls and 2^24 ns (17 ms) for what
//! costs more, and within each window the search begins at the later of the window's begin and the later
//! segment's begin. Whoever asks, at whatever time before the meeting, gets the same nanosecond.
//!
//! Balls meet balls and the ground at roots of polynomials (`root`), whatever else meets is searched for
//! (`approach`). When two that only detect each other part again is reported to nobody; for what is not
//! balls it is looked at every 2^23 ns (8 ms).

use crate::approach::{self, Side};
use crate::body::Mobility;
use crate::motion::{Motion, Spin, seconds_between};
use crate::root::Quartic;
use glam::DVec3;
use simbeeotic_kernel::SimTime;

/// Length of a window for balls, as a power of two of nanoseconds.
const WINDOW_LOG2: u32 = 27;
/// The same for other shapes. In a short window fewer of those nearby come near enough to be looked at.
const WINDOW_OF_FORMS_LOG2: u32 = 24;
/// More than the rounding of a bound within a kilometre of the origin, m.
const ROUNDING_M: f64 = 1e-6;
/// How often it is looked at whether two have parted, likewise.
const LOOK_LOG2: u32 = 23;

/// Which way the distance passes zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Passage {
    /// From apart to touching; or, if they overlap already, from parting to approaching.
    In,
    /// From touching to apart.
    Out,
}

/// The span of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Search {
    pub(crate) passage: Passage,
    /// When both segments hold and the pair is known to be on its side of the passage.
    pub(crate) origin: SimTime,
    /// Lies between the origin and the passage, if there is one.
    pub(crate) now: SimTime,
    /// What comes later may be missed.
    pub(crate) horizon: SimTime,
    /// When one of the two begins a new segment anyway, being stepped; after the horizon if none is.
    pub(crate) until: SimTime,
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

/// The first passage of two bodies, if it comes by the horizon or little later.
#[inline]
pub(crate) fn pair_passage(a: Side<'_>, b: Side<'_>, search: &Search) -> Option<SimTime> {
    if a.form.ball().is_some() && b.form.ball().is_some() {
        balls_passage(a.motion, b.motion, search)
    } else {
        forms_passage(a, Some(b), search)
    }
}

/// The first passage of a body through the ground, if it comes by the horizon.
#[inline]
pub(crate) fn ground_passage(a: Side<'_>, search: &Search) -> Option<SimTime> {
    if a.form.ball().is_some() {
        ball_ground_passage(a.motion, search)
    } else {
        forms_passage(a, None, search)
    }
}

/// The windows of a search: where each begins and ends.
fn windows(search: &Search, log2: u32) -> impl Iterator<Item = (SimTime, SimTime)> {
    let Search {
        origin,
        now,
        horizon,
        ..
    } = *search;
    let first = origin.max(now).nanos() >> log2;
    (first..)
        .map(move |window| {
            let begin = SimTime::from_nanos(window << log2);
            let end = SimTime::from_nanos((window + 1).saturating_mul(1 << log2));
            (origin.max(begin), end)
        })
        // A pair may be held beyond the horizon.
        .take_while(move |(from, _)| *from <= horizon)
}

fn balls_passage(a: &Motion, b: &Motion, search: &Search) -> Option<SimTime> {
    let mut first = true;
    for (from, to) in windows(search, WINDOW_LOG2) {
        let quartic = pair_distance(a, b, from);
        let quartic = match search.passage {
            Passage::In => quartic,
            Passage::Out => quartic.negated(),
        };
        if std::mem::take(&mut first) && !quartic.may_fall(seconds_between(from, search.horizon)) {
            return None;
        }
        if let Some(s) = quartic.first_fall(seconds_between(from, to)) {
            return Some(after(from, s).max(search.now));
        }
    }
    None
}

fn ball_ground_passage(body: &Motion, search: &Search) -> Option<SimTime> {
    let Search {
        origin, horizon, ..
    } = *search;
    if origin > horizon {
        return None;
    }
    let height = ground_distance(body, origin);
    let height = match search.passage {
        Passage::In => height,
        Passage::Out => height.negated(),
    };
    let to = seconds_between(origin, horizon);
    if !height.may_fall(to) {
        return None;
    }
    let fall = height.first_fall(to);
    fall.map(|s| after(origin, s).max(search.now))
}

fn forms_passage(a: Side<'_>, b: Option<Side<'_>>, search: &Search) -> Option<SimTime> {
    match search.passage {
        Passage::In => windows(search, WINDOW_OF_FORMS_LOG2)
            .map(|(from, to)| (from, to.min(search.until)))
            .filter(|(from, to)| may_meet(a, b, *from, *to))
            .find_map(|(from, to)| approach::meets(a, b, from, to))
            .map(|t| t.max(search.now)),
        Passage::Out => {
            let first = (search.origin.max(search.now).nanos() >> LOOK_LOG2) + 1;
            (first..)
                .map(|look| SimTime::from_nanos(look << LOOK_LOG2))
                .take_while(|t| *t <= search.horizon)
                .find(|t| apart(a, b, *t))
        }
    }
}

/// Whether two may touch within a span, as far as boxes about their ways tell. In a heap most of those
/// nearby do not, and to find that out by their shapes costs thirty times as much.
fn may_meet(a: Side<'_>, b: Option<Side<'_>>, from: SimTime, to: SimTime) -> bool {
    if let Some(b) = b
        && !balls_may_meet(a.motion, b.motion, from, to)
    {
        return false;
    }
    let [low, high] = way(a, from, to);
    let Some(b) = b else {
        return low.z <= ROUNDING_M;
    };
    let [other_low, other_high] = way(b, from, to);
    low.cmple(other_high + ROUNDING_M).all() && other_low.cmple(high + ROUNDING_M).all()
}

/// Whether the balls about two bodies may touch within a span.
fn balls_may_meet(a: &Motion, b: &Motion, from: SimTime, to: SimTime) -> bool {
    let reach = a.radius_m() + b.radius_m();
    if !reach.is_finite() {
        return true;
    }
    let s = seconds_between(from, to);
    let (pa, va, aa) = a.kinematics(from);
    let (pb, vb, ab) = b.kinematics(from);
    let way = (vb - va).length() * s + (ab - aa).length() * (0.5 * s * s);
    let reach = reach + way + ROUNDING_M;
    pa.distance_squared(pb) <= reach * reach
}

/// A box that holds a body from `from` to `to`.
fn way(side: Side<'_>, from: SimTime, to: SimTime) -> [DVec3; 2] {
    let Side { motion, form } = side;
    let [low, high] = form.bounds(motion.place(from));
    if motion.mobility() == Mobility::Fixed {
        return [low, high];
    }
    let s = seconds_between(from, to);
    let (_, v, a) = motion.kinematics(from);
    let (straight, bent) = (v * s, a * (0.5 * s * s));
    let turn = match motion.spin {
        Spin::Steady => motion.w.length() * s,
        Spin::Axis => (motion.rate(from).length() + motion.spin_up().length() * s) * s,
        Spin::Tumbling => f64::INFINITY,
    };
    let swing = motion.radius_m() * turn.min(2.0);
    [
        low + straight.min(DVec3::ZERO) + bent.min(DVec3::ZERO) - swing,
        high + straight.max(DVec3::ZERO) + bent.max(DVec3::ZERO) + swing,
    ]
}

/// Whether two are apart at `t`; `None` is the ground.
pub(crate) fn apart(a: Side<'_>, b: Option<Side<'_>>, t: SimTime) -> bool {
    match b {
        Some(b) if a.form.ball().is_some() && b.form.ball().is_some() => {
            pair_distance(a.motion, b.motion, t).0[0] > 0.0
        }
        None if a.form.ball().is_some() => ground_distance(a.motion, t).0[0] > 0.0,
        Some(b) => {
            let (here, there) = (a.motion.place(t), b.motion.place(t));
            a.form.gap(here, b.form, there).distance > 0.0
        }
        None => a.form.gap_to_ground(a.motion.place(t)).distance > 0.0,
    }
}

/// `s` seconds after `from`, to the nearest nanosecond.
fn after(from: SimTime, s: f64) -> SimTime {
    from.saturating_add_nanos((s * 1e9).round() as u64)
}

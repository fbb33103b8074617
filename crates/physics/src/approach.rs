//! When two forms first touch: conservative advancement along closed forms.
//!
//! At an instant two convex pieces are apart by `d` along a direction `n` (`shape/separation`). From then
//! on, along that direction alone, their distance is at least
//!
//! ```text
//! f(h) = d + n.v h + n.a h^2 / 2 - (r h + e h^2 / 2)                                      (1)
//! ```
//!
//! with `v` and `a` their relative velocity and acceleration, constant in `a`, and the bracket what their
//! turning can add: a body that turns with the world rate `w` moves its farthest point along `n` as if
//! `n` turned the other way, so with `m = n x w` and `g` its support function
//!
//! ```text
//! r = (g(n + h m) - g(n)) / h        e = (|w|^2 + |w'|) R                                 (2)
//! ```
//!
//! (`g` is convex, so the chord to the end of a step lies above it.) Or simply `r = |m| R`, `e = 0`. The
//! search goes to the first root of `f`, from below, with either bound, and again from there: it never
//! steps over a touch, and near one the chord becomes the true rate, so it converges faster than
//! linearly. Very near it, the true rate alone gives the instant.

use crate::motion::{Motion, Spin, seconds_between};
use crate::root::{self, Quartic};
use crate::rotation::{turn_by, unit};
use crate::shape::form::{Form, Gap, Place, Solid};
use crate::shape::piece::Piece;
use crate::shape::soup::turned;
use glam::{DQuat, DVec3};
use simbeeotic_kernel::SimTime;

/// One of the two in a search.
#[derive(Clone, Copy)]
pub(crate) struct Side<'a> {
    pub(crate) motion: &'a Motion,
    pub(crate) form: &'a Form,
}

/// Separation over the size of two pieces at which they touch as far as numbers can say.
const TOUCH: f64 = 1e-10;
/// The same, at which the true rate gives the instant if nothing else changes until then.
const NEAR: f64 = 1e-7;
/// Evaluations after which the least step doubles with each one.
const STEPS_EXACT: u32 = 300;
/// Most evaluations of one search.
const STEPS_MAX: u32 = 350;
/// The least step, s.
const STEP_S_MIN: f64 = 0.5e-9;

/// How one body turns, with time counted from the start of the search.
#[derive(Clone, Copy)]
enum Turn<'a> {
    Still(DQuat),
    Steady(DQuat, DVec3),
    Axis(DQuat, DVec3, DVec3),
    Tumbling(&'a Motion, SimTime),
}

/// What a turn can do, at most, during a search.
#[derive(Clone, Copy)]
struct Swing {
    rate: f64,
    /// `|w|^2 + |w'|`.
    bend: f64,
}

impl<'a> Turn<'a> {
    fn new(motion: &'a Motion, from: SimTime) -> Self {
        match motion.spin {
            Spin::Tumbling => Self::Tumbling(motion, from),
            spin => {
                let (q, w) = motion.rotation(from);
                if spin == Spin::Axis {
                    Self::Axis(q, w, motion.spin_up())
                } else if w == DVec3::ZERO {
                    Self::Still(q)
                } else {
                    Self::Steady(q, w)
                }
            }
        }
    }

    /// Attitude, and rate in the world's axes, after `s`.
    fn at(&self, s: f64) -> (DQuat, DVec3) {
        match self {
            Self::Still(q) => (*q, DVec3::ZERO),
            Self::Steady(q, w) => (unit(*q * turn_by(*w * s)), *q * *w),
            Self::Axis(q, w, up) => {
                let rate = *w + *up * s;
                (unit(*q * turn_by(*w * s + *up * (0.5 * s * s))), *q * rate)
            }
            Self::Tumbling(motion, from) => {
                let nanos = (s * 1e9) as u64;
                let (q, w) = motion.rotation(from.saturating_add_nanos(nanos));
                let rest = s - nanos as f64 / 1e9;
                (unit(q * turn_by(w * rest)), q * w)
            }
        }
    }

    /// The greatest rate, and bend, from the start until `s`.
    fn swing(&self, s: f64) -> Swing {
        match self {
            Self::Still(_) => Swing {
                rate: 0.0,
                bend: 0.0,
            },
            Self::Steady(_, w) => Swing {
                rate: w.length(),
                bend: w.length_squared(),
            },
            Self::Axis(_, w, up) => {
                let rate = w.length().max((*w + *up * s).length());
                Swing {
                    rate,
                    bend: rate * rate + up.length(),
                }
            }
            Self::Tumbling(motion, from) => {
                // The energy of the turn grows by no more than the torque times the rate.
                let inertia = motion.inertia_kg_m2();
                let least = inertia.min_element();
                let w = motion.rotation(*from).1;
                let momentum =
                    (w * w).dot(inertia).sqrt() + motion.torque().length() * s / least.sqrt();
                let rate = (momentum / least.sqrt()).min(crate::limits::RATE_RAD_S_MAX);
                let ratio = inertia.max_element() / least - 1.0;
                Swing {
                    rate,
                    bend: rate * rate * (1.0 + ratio) + motion.spin_up().length(),
                }
            }
        }
    }
}

/// The relative motion of two bodies: the second's path as seen from the first, and how both turn.
struct Course<'a> {
    p: DVec3,
    v: DVec3,
    a: DVec3,
    turns: [Turn<'a>; 2],
    /// For the whole of the search.
    swings: [Swing; 2],
    span: f64,
}

/// Two pieces at one instant of their course.
struct Probe {
    gap: Gap,
    /// Velocity of the second relative to the first.
    v: DVec3,
    /// Attitudes, and rates in the world's axes.
    turns: [(DQuat, DVec3); 2],
}

/// What the second piece is.
#[derive(Clone, Copy)]
enum Partner<'a> {
    Piece(&'a Piece),
    /// All below a plane through the second body's origin; it does not turn.
    Plane(DVec3),
}

/// When a distance of such a course comes to zero: never is infinitely late.
fn first_root(value: f64, slope: f64, m: f64) -> f64 {
    root::first_root(value, slope, m).unwrap_or(f64::INFINITY)
}

impl Course<'_> {
    fn offset(&self, s: f64) -> DVec3 {
        self.p + self.v * s + self.a * (0.5 * s * s)
    }

    fn probe(&self, here: &Piece, there: Partner<'_>, s: f64) -> Probe {
        let turns = [self.turns[0].at(s), self.turns[1].at(s)];
        let at = Place {
            p: DVec3::ZERO,
            q: turns[0].0,
        };
        let other_at = Place {
            p: self.offset(s),
            q: turns[1].0,
        };
        Probe {
            gap: match there {
                Partner::Piece(there) => here.gap(at, there, other_at),
                Partner::Plane(up) => here.gap_to_plane(at, other_at.p, up),
            },
            v: self.v + self.a * s,
            turns,
        }
    }

    /// How fast the gap changes at its nearest points.
    fn rate(&self, probe: &Probe, s: f64) -> f64 {
        let gap = &probe.gap;
        let [here, there] = [gap.here, gap.there - self.offset(s)];
        let swing = probe.turns[1].1.cross(there) - probe.turns[0].1.cross(here);
        gap.normal.dot(probe.v + swing)
    }

    /// A step that leads to no touch, by equation (1), and whether it ends where `f` is zero; none if
    /// nothing touches within `rest`.
    fn step(
        &self,
        here: &Piece,
        there: Partner<'_>,
        probe: &Probe,
        rate: f64,
        rest: f64,
    ) -> Option<f64> {
        let normal = probe.gap.normal;
        let distance = probe.gap.distance;
        let closing = normal.dot(probe.v);
        let m = normal.dot(self.a);
        let pieces = [
            Some(here),
            if let Partner::Piece(there) = there {
                Some(there)
            } else {
                None
            },
        ];
        let turning =
            |k: usize| pieces[k].filter(|piece| self.swings[k].rate > 0.0 && piece.reach() > 0.0);
        let mut simple = 0.0;
        for k in 0..2 {
            if let Some(piece) = turning(k) {
                // The axis of a steady turn stands still in the world.
                let lever = match self.turns[k] {
                    Turn::Tumbling(..) => 1.0,
                    Turn::Steady(..) | Turn::Axis(..) | Turn::Still(_) => {
                        let axis = probe.turns[k].1.normalize_or_zero();
                        if axis == DVec3::ZERO {
                            1.0
                        } else {
                            normal.cross(axis).length()
                        }
                    }
                };
                simple += lever * self.swings[k].rate * piece.reach();
            }
        }
        let sure = first_root(distance, closing - simple, m);
        if sure > rest {
            return None;
        }
        if simple == 0.0 {
            return Some(sure);
        }
        // The chord over a step that ends where the true rate would have them touch, or a little beyond
        // the sure one.
        let hoped = first_root(distance, rate, m);
        let trial = hoped.max(2.0 * sure).min(8.0 * sure).min(rest);
        let (mut chord, mut bend) = (0.0, 0.0);
        for (k, n) in [(0, normal), (1, -normal)] {
            if let Some(piece) = turning(k) {
                let (q, w) = probe.turns[k];
                let ahead = n + n.cross(w) * trial;
                let now = n.dot(piece.support(q, n));
                chord += (ahead.dot(piece.support(q, ahead)) - now) / trial;
                bend += self.swings[k].bend * piece.reach();
            }
        }
        let better = first_root(distance, closing - chord, m - bend).min(trial);
        Some(better.max(sure))
    }

    /// When two pieces first touch, counted from the start; none if not within the span `to`.
    fn meets(&self, here: &Piece, there: Partner<'_>, to: f64) -> Option<f64> {
        let reach = |piece: &Piece| piece.reach() + piece.margin();
        let (reach, size, plane) = match there {
            Partner::Piece(there) => (
                reach(here) + reach(there),
                here.extent().min(there.extent()),
                None,
            ),
            Partner::Plane(up) => (reach(here), here.extent(), Some(up)),
        };
        let mut s = self.cull(reach, plane, to)?;
        let mut apart: Option<f64> = None;
        let mut count = 0;
        while count < STEPS_MAX {
            let probe = self.probe(here, there, s);
            let distance = probe.gap.distance;
            let rate = self.rate(&probe, s);
            let m = probe.gap.normal.dot(self.a);
            count += 1;
            let least = STEP_S_MIN * (1_u64 << count.saturating_sub(STEPS_EXACT)) as f64;
            if distance <= TOUCH * size {
                if rate < 0.0 || rate == 0.0 && m < 0.0 {
                    return Some(match apart {
                        Some(before) if s - before > STEP_S_MIN => {
                            self.bisect(here, there, before, s, TOUCH * size)
                        }
                        _ => s,
                    });
                }
                // In touch and parting: on to where they are apart, or turn back.
                let out = (TOUCH * size - distance) / rate.max(1e-12);
                apart = None;
                s += (2.0 * out).clamp(1e-6, 1e-3).max(least);
            } else {
                if distance <= NEAR * size {
                    let left = first_root(distance, rate, m);
                    if self.is_straight(&probe, rate, left, size) {
                        return (s + left <= to).then_some(s + left);
                    }
                }
                apart = Some(s);
                s += self.step(here, there, &probe, rate, to - s)?.max(least);
            }
            if s > to {
                return None;
            }
        }
        None
    }

    /// Whether the gap closes at its present rate for the little time that is left: whether what slides
    /// or turns meanwhile is too little to matter.
    fn is_straight(&self, probe: &Probe, rate: f64, left: f64, size: f64) -> bool {
        let slide = (probe.v + probe.gap.normal * -probe.v.dot(probe.gap.normal)).length();
        let swing: f64 = self.swings.iter().map(|swing| swing.rate).sum();
        let way = (slide + swing * size) * left;
        // A surface of radius `size / 8` would bend away by this; over the rate, it is a time.
        rate < 0.0 && 4.0 * way * way / size <= -rate * 1e-9
    }

    /// The first touch between an instant at which the pieces are apart and one at which they are not.
    fn bisect(
        &self,
        here: &Piece,
        there: Partner<'_>,
        mut apart: f64,
        mut touch: f64,
        least: f64,
    ) -> f64 {
        while touch - apart > STEP_S_MIN {
            let middle = 0.5 * (apart + touch);
            if self.probe(here, there, middle).gap.distance > least {
                apart = middle;
            } else {
                touch = middle;
            }
        }
        touch
    }

    /// When two bodies' bounding balls, which together reach as far as this, first touch: nothing can
    /// happen before. Of a plane, its upward normal.
    fn cull(&self, reach: f64, plane: Option<DVec3>, to: f64) -> Option<f64> {
        let reach = reach * (1.0 + 1e-6);
        let distance = match plane {
            None => Quartic([
                self.p.length_squared() - reach * reach,
                2.0 * self.p.dot(self.v),
                self.v.length_squared() + self.p.dot(self.a),
                self.v.dot(self.a),
                0.25 * self.a.length_squared(),
            ]),
            Some(up) => Quartic([
                -self.p.dot(up) - reach,
                -self.v.dot(up),
                -0.5 * self.a.dot(up),
                0.0,
                0.0,
            ]),
        };
        if distance.0[0] <= 0.0 {
            return Some(0.0);
        }
        if !distance.may_fall(to) {
            return None;
        }
        distance.first_fall(to)
    }
}

/// The span of a parabola `p + v s + a s^2 / 2` along each axis, for `s` from 0 to `to`.
fn sweep(p: DVec3, v: DVec3, a: DVec3, to: f64) -> [DVec3; 2] {
    let at = |s: f64| p + v * s + a * (0.5 * s * s);
    let (first, last) = (p, at(to));
    let mut bounds = [first.min(last), first.max(last)];
    for k in 0..3 {
        let turn = -v[k] / a[k];
        if turn > 0.0 && turn < to {
            let there = at(turn)[k];
            bounds[0][k] = bounds[0][k].min(there);
            bounds[1][k] = bounds[1][k].max(there);
        }
    }
    bounds
}

impl<'a> Course<'a> {
    fn new(a: Side<'a>, b: Option<Side<'a>>, from: SimTime, to: SimTime) -> Self {
        let (p, v, acceleration) = a.motion.kinematics(from);
        let span = seconds_between(from, to);
        let here = Turn::new(a.motion, from);
        let (other, there) = match b {
            Some(b) => (b.motion.kinematics(from), Turn::new(b.motion, from)),
            None => (
                (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO),
                Turn::Still(DQuat::IDENTITY),
            ),
        };
        Self {
            p: other.0 - p,
            v: other.1 - v,
            a: other.2 - acceleration,
            swings: [here.swing(span), there.swing(span)],
            turns: [here, there],
            span,
        }
    }

    /// The same, seen from the second body.
    fn flipped(&self) -> Self {
        let [here, there] = self.turns;
        let [swing, other_swing] = self.swings;
        Self {
            p: -self.p,
            v: -self.v,
            a: -self.a,
            turns: [there, here],
            swings: [other_swing, swing],
            span: self.span,
        }
    }

    /// When two forms first touch within the span.
    fn first(&self, a: &Form, b: Option<&Form>) -> Option<f64> {
        let Some(b) = b else {
            return self.first_of_plane(a, DVec3::Z);
        };
        let up = |turn: &Turn<'_>| turn.at(0.0).0 * DVec3::Z;
        match (a.solid(), b.solid()) {
            (Solid::One(here), Solid::One(there)) => {
                self.meets(here, Partner::Piece(there), self.span)
            }
            (_, Solid::Plane) => self.first_of_plane(a, up(&self.turns[1])),
            (Solid::Plane, _) => self.flipped().first_of_plane(b, up(&self.turns[0])),
            (Solid::One(here), Solid::Many(_)) => self.first_near(here, b, self.span),
            (Solid::Many(_), Solid::One(there)) => self.flipped().first_near(there, a, self.span),
            (Solid::Many(soup), Solid::Many(_)) => {
                let reach = a.radius() + b.radius();
                let mut best = None;
                let mut to = self.span;
                if self.cull(reach, None, to).is_some() {
                    soup.each(&mut |here| {
                        if let Some(s) = self.first_near(here, b, to) {
                            (best, to) = (Some(s), s);
                        }
                    });
                }
                best
            }
        }
    }

    fn first_of_plane(&self, form: &Form, up: DVec3) -> Option<f64> {
        match form.solid() {
            Solid::Plane => None,
            Solid::One(piece) => self.meets(piece, Partner::Plane(up), self.span),
            Solid::Many(soup) => {
                let mut best = None;
                let mut to = self.span;
                soup.each(&mut |piece| {
                    if let Some(s) = self.meets(piece, Partner::Plane(up), to) {
                        (best, to) = (Some(s), s);
                    }
                });
                best
            }
        }
    }

    /// When a piece of the first body first touches the second, which consists of many.
    fn first_near(&self, here: &Piece, other: &Form, to: f64) -> Option<f64> {
        let Solid::Many(soup) = other.solid() else {
            return None;
        };
        let (mut best, mut to) = (None, to);
        let mut see = |there: &Piece| {
            if let Some(s) = self.meets(here, Partner::Piece(there), to) {
                (best, to) = (Some(s), s);
            }
        };
        if let Turn::Still(q) = self.turns[1] {
            let [least, most] = sweep(-self.p, -self.v, -self.a, self.span);
            let reach = DVec3::splat((here.reach() + here.margin()) * (1.0 + 1e-6));
            let back = Place {
                p: DVec3::ZERO,
                q: q.conjugate(),
            };
            soup.near(turned(back, [least - reach, most + reach]), &mut see);
        } else {
            soup.each(&mut see);
        }
        best
    }
}

/// When two forms first touch between `from` and `to`; `None` for `b` is the ground, the plane at
/// up = 0. Both segments hold all the while. The answer is rounded down, so the two do not overlap then.
///
/// Two that touch or overlap at `from` meet there if they close in, and if they part not before they
/// have been apart, or close in again.
pub(crate) fn meets(
    a: Side<'_>,
    b: Option<Side<'_>>,
    from: SimTime,
    to: SimTime,
) -> Option<SimTime> {
    let course = Course::new(a, b, from, to);
    let s = course.first(a.form, b.map(|b| b.form))?;
    Some(from.saturating_add_nanos((s * 1e9) as u64))
}

/// How far `b`, which stands at `b_at`, can be moved along a unit direction before it touches `a`, if it
/// does so within `max_m`.
pub(crate) fn reaches(
    a: &Form,
    a_at: Place,
    b: &Form,
    b_at: Place,
    direction: DVec3,
    max_m: f64,
) -> Option<f64> {
    let still = Swing {
        rate: 0.0,
        bend: 0.0,
    };
    let course = Course {
        p: b_at.p - a_at.p,
        v: direction,
        a: DVec3::ZERO,
        turns: [Turn::Still(a_at.q), Turn::Still(b_at.q)],
        swings: [still; 2],
        span: max_m,
    };
    course.first(a, Some(b))
}

#[cfg(test)]
mod tests;

//! A recording as a movement: where everybody is between two ticks.

use simbeeotic_record::{ReadError, Recording, Sample, Tick, Ticks};
use simbeeotic_units::glam::{DQuat, DVec3};
use std::collections::VecDeque;

/// Everybody at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Instant {
    /// Virtual time, s.
    pub(super) time_s: f64,
    /// Where they are (ENU), m. NaN where that is not known.
    pub(super) places_m: Vec<DVec3>,
    /// How they are turned: `world_from_body`.
    pub(super) turns: Vec<DQuat>,
    /// Their speeds, m/s.
    pub(super) speeds_m_s: Vec<f64>,
}

/// The places of everybody at a past tick, for trails.
#[derive(Clone, Debug)]
pub(super) struct Past {
    pub(super) time_s: f64,
    pub(super) places_m: Vec<DVec3>,
}

/// Plays a recording forwards.
pub(super) struct Reel<'a> {
    ticks: Ticks<'a>,
    before: Tick,
    after: Option<Tick>,
    /// Past ticks, the oldest first, as far back as `trail_s`.
    pub(super) past: VecDeque<Past>,
    trail_s: f64,
}

/// Parts into which a trail divides the way between two ticks.
const PARTS: usize = 4;
/// Points that a trail has at most, about.
const TRAIL_POINTS: f64 = 160.0;

impl<'a> Reel<'a> {
    /// Puts the recording on, so that it can be played from `from_ns` on, with trails of `trail_s` behind
    /// everybody. `None` if it has no ticks at all up to then.
    pub(super) fn open(
        recording: &'a Recording,
        from_ns: u64,
        trail_s: f64,
    ) -> Result<Option<Self>, ReadError> {
        let trail_ns = (trail_s.min(1e9) * 1e9) as u64;
        // Ticks may be far apart: look back until there is one.
        let mut lead_ns = 2_000_000_000_u64;
        loop {
            let start_ns = from_ns.saturating_sub(lead_ns.saturating_add(trail_ns));
            let mut ticks = recording.ticks_in(start_ns..=u64::MAX);
            match ticks.next().transpose()? {
                Some(first) if first.time_ns <= from_ns => {
                    let mut reel = Self {
                        ticks,
                        before: first,
                        after: None,
                        past: VecDeque::new(),
                        trail_s,
                    };
                    reel.after = reel.ticks.next().transpose()?;
                    return Ok(Some(reel));
                }
                _ if start_ns == 0 => return Ok(None),
                _ => lead_ns = lead_ns.saturating_mul(8),
            }
        }
    }

    /// Virtual time of the tick it stands at, ns.
    pub(super) fn now_ns(&self) -> u64 {
        self.before.time_ns
    }

    /// Everybody at a time that is not before the last one asked for; beyond the last tick, as they were
    /// then.
    pub(super) fn at(&mut self, time_ns: u64) -> Result<Instant, ReadError> {
        while let Some(after) = &self.after
            && after.time_ns <= time_ns
        {
            if self.trail_s > 0.0 {
                self.remember();
            }
            let next = self.ticks.next().transpose()?;
            if let Some(after) = std::mem::replace(&mut self.after, next) {
                self.before = after;
            }
        }
        let time_s = seconds(time_ns);
        while self
            .past
            .get(1)
            .is_some_and(|past| past.time_s < time_s - self.trail_s)
        {
            self.past.pop_front();
        }
        Ok(between(&self.before, self.after.as_ref(), time_ns))
    }

    /// Keeps the way up to the next tick.
    fn remember(&mut self) {
        let Some(after) = &self.after else { return };
        let step_s = seconds(after.time_ns) - seconds(self.before.time_ns);
        let newest = self
            .past
            .back()
            .map_or(f64::NEG_INFINITY, |past| past.time_s);
        let apart_s = self.trail_s / TRAIL_POINTS;
        let parts = ((step_s / apart_s) as usize).clamp(1, PARTS);
        for part in 0..parts {
            let share = part as f64 / parts as f64;
            let time_s = seconds(self.before.time_ns) + share * step_s;
            if time_s - newest >= apart_s * 0.999 || part > 0 {
                let time_ns = self.before.time_ns
                    + (share * (after.time_ns - self.before.time_ns) as f64) as u64;
                let places_m = between(&self.before, Some(after), time_ns).places_m;
                self.past.push_back(Past { time_s, places_m });
            }
        }
    }

    /// What of the present way between two ticks lies behind a time, for the last part of a trail.
    pub(super) fn present(&self, time_ns: u64) -> Vec<Past> {
        let Some(after) = &self.after else {
            return vec![past(&self.before)];
        };
        let span_ns = after.time_ns - self.before.time_ns;
        let parts =
            (0..PARTS).map(|part| self.before.time_ns + span_ns * part as u64 / PARTS as u64);
        parts
            .take_while(|t| *t < time_ns || *t == self.before.time_ns)
            .map(|t| Past {
                time_s: seconds(t),
                places_m: between(&self.before, Some(after), t).places_m,
            })
            .collect()
    }
}

fn past(tick: &Tick) -> Past {
    Past {
        time_s: seconds(tick.time_ns),
        places_m: tick
            .samples
            .iter()
            .map(|s| DVec3::from(s.position_m))
            .collect(),
    }
}

pub(super) fn seconds(time_ns: u64) -> f64 {
    time_ns as f64 / 1e9
}

/// Everybody between two ticks.
pub(super) fn between(before: &Tick, after: Option<&Tick>, time_ns: u64) -> Instant {
    let start_ns = before.time_ns;
    let (after, step_s) = match after {
        Some(after) if after.time_ns > start_ns && time_ns > start_ns => {
            (after, seconds(after.time_ns - start_ns))
        }
        _ => (before, 1.0),
    };
    let share = match after.time_ns - start_ns {
        0 => 0.0,
        span => ((time_ns - start_ns) as f64 / span as f64).min(1.0),
    };
    let count = before.samples.len();
    let mut instant = Instant {
        time_s: seconds(time_ns),
        places_m: Vec::with_capacity(count),
        turns: Vec::with_capacity(count),
        speeds_m_s: Vec::with_capacity(count),
    };
    for (a, b) in before.samples.iter().zip(&after.samples) {
        let (place, velocity) = way(a, b, share, step_s);
        instant.places_m.push(place);
        instant.turns.push(turn(a, b, share));
        instant.speeds_m_s.push(velocity.length());
    }
    instant
}

/// Place and velocity at a share of the way: the cubic with the recorded places and velocities at its ends,
/// or a straight line where there are no velocities.
fn way(a: &Sample, b: &Sample, share: f64, step_s: f64) -> (DVec3, DVec3) {
    let (from, to) = (DVec3::from(a.position_m), DVec3::from(b.position_m));
    let (v, w) = (DVec3::from(a.velocity_m_s), DVec3::from(b.velocity_m_s));
    let s = share;
    if s == 0.0 {
        let velocity = if v.is_finite() || step_s <= 0.0 {
            v
        } else {
            (to - from) / step_s
        };
        return (from, velocity);
    }
    let line = (from + s * (to - from), (to - from) / step_s);
    if !(v.is_finite() && w.is_finite()) {
        return line;
    }
    // Something was put elsewhere, or was pushed hard in between: the cubic would swing out.
    let off = (to - from - 0.5 * step_s * (v + w)).length();
    if off > step_s * (v.length() + w.length()) + 1e-9 {
        return line;
    }
    let (s2, s3) = (s * s, s * s * s);
    let place = (2.0 * s3 - 3.0 * s2 + 1.0) * from
        + (s3 - 2.0 * s2 + s) * step_s * v
        + (3.0 * s2 - 2.0 * s3) * to
        + (s3 - s2) * step_s * w;
    let velocity = (6.0 * s2 - 6.0 * s) / step_s * (from - to)
        + (3.0 * s2 - 4.0 * s + 1.0) * v
        + (3.0 * s2 - 2.0 * s) * w;
    (place, velocity)
}

/// The attitude at a share of the way, the shorter way round.
fn turn(a: &Sample, b: &Sample, share: f64) -> DQuat {
    let [a, b] = [a, b].map(|sample| {
        let [w, x, y, z] = sample.world_from_body;
        let turn = DQuat::from_xyzw(x, y, z, w);
        if turn.is_finite() && turn.length_squared() > 1e-12 {
            turn.normalize()
        } else {
            DQuat::IDENTITY
        }
    });
    let b = if a.dot(b) < 0.0 { -b } else { b };
    let mixed = a * (1.0 - share) + b * share;
    if mixed.length_squared() > 1e-12 {
        mixed.normalize()
    } else {
        a
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tick(time_ns: u64, position: DVec3, velocity: DVec3, yaw: f64) -> Tick {
        let (sin, cos) = simbeeotic_units::math::sin_cos(0.5 * yaw);
        let sample = Sample {
            position_m: position.to_array(),
            velocity_m_s: velocity.to_array(),
            world_from_body: [cos, 0.0, 0.0, sin],
            ..Sample::default()
        };
        Tick {
            time_ns,
            samples: vec![sample],
        }
    }

    #[test]
    fn a_throw_is_a_parabola_between_two_ticks() {
        let throw = |t: f64| {
            (
                DVec3::new(3.0 * t, -2.0 * t, 10.0 * t - 4.9 * t * t),
                DVec3::new(3.0, -2.0, 10.0 - 9.8 * t),
            )
        };
        let ((p, v), (q, w)) = (throw(0.0), throw(2.0));
        let (a, b) = (tick(0, p, v, 0.0), tick(2_000_000_000, q, w, 0.0));
        for k in 0..=20 {
            let t = 0.1 * f64::from(k);
            let instant = between(&a, Some(&b), (t * 1e9).round() as u64);
            let (place, velocity) = throw(t);
            assert!((instant.places_m[0] - place).length() < 1e-8, "{t}");
            assert!(
                (instant.speeds_m_s[0] - velocity.length()).abs() < 1e-7,
                "{t}"
            );
        }
    }

    #[test]
    fn without_velocities_it_is_a_line() {
        let nan = DVec3::NAN;
        let a = tick(0, DVec3::ZERO, nan, 0.0);
        let b = tick(1_000_000_000, DVec3::new(4.0, 0.0, 0.0), nan, 0.0);
        let instant = between(&a, Some(&b), 250_000_000);
        assert_eq!(instant.places_m[0], DVec3::X);
        assert_eq!(instant.speeds_m_s[0], 4.0);
    }

    #[test]
    fn who_was_put_elsewhere_does_not_swing_out() {
        let a = tick(0, DVec3::ZERO, DVec3::X, 0.0);
        let b = tick(1_000_000_000, DVec3::new(0.0, 100.0, 0.0), DVec3::X, 0.0);
        let instant = between(&a, Some(&b), 500_000_000);
        assert_eq!(instant.places_m[0], DVec3::new(0.0, 50.0, 0.0));
    }

    #[test]
    fn turning_takes_the_shorter_way() {
        let a = tick(0, DVec3::ZERO, DVec3::ZERO, 3.0);
        let b = tick(1_000_000_000, DVec3::ZERO, DVec3::ZERO, -3.0);
        let turn = between(&a, Some(&b), 500_000_000).turns[0];
        // Through west, not through east.
        assert!((turn * DVec3::X - DVec3::NEG_X).length() < 1e-9);
    }
}

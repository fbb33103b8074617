//! Puffs: gas that the wind carries, piece by piece.
//!
//! Every `interval` a source gives off a puff of mass `m = Q interval`, a Gaussian cloud whose centre
//! moves with the wind and whose size grows with its way `s`, as a plume's does with the distance:
//!
//! ```text
//! C = m / ((2 pi)^3/2 sy^2 sz) exp(-dh^2 / 2 sy^2) [exp(-(z - zc)^2 / 2 sz^2) + exp(-(z + zc)^2 / 2 sz^2)]   (1)
//! ds/dt = max(|u|, 0.5 m/s)                                                                        (2)
//! ```
//! so wind that turns bends the plume, and a calm lets the puffs grow where they are. The centres are
//! followed by the midpoint rule in steps of `interval`, counted from the source's start; in between
//! they move in a straight line. Nothing of this hangs on who asks when. A puff comes up within its
//! first interval and fades within its last.
//!
//! Where puffs overlap (`|u| interval` below about two radii of the source, or far enough away for
//! them to have grown) the sum is the plume of a steady wind; nearer, single puffs pass by.

use crate::plume::{CALM_M_S, Source};
use crate::weather::Weather;
use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_kernel::SimTime;
use simbeeotic_units::{Position, Time, math};
use std::collections::VecDeque;
use std::f64::consts::TAU;

/// How a source's gas is followed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Puffs {
    /// Time between two puffs, above 0.
    pub interval: Time,
    /// How long a puff is followed: at least two intervals, at most 5000.
    pub life: Time,
    /// Whether turbulence and gusts carry the puffs too: the plume meanders. Otherwise the mean wind
    /// does. (What turbulence does to the width of a plume is in its spread already.)
    pub meander: bool,
}

impl Default for Puffs {
    fn default() -> Self {
        Self {
            interval: Time::si(0.5),
            life: Time::si(120.0),
            meander: false,
        }
    }
}

/// Most puffs of one source.
const PUFFS_MAX: f64 = 5_000.0;

impl Puffs {
    /// What cannot be: key and reason.
    pub(crate) fn faults(&self) -> Vec<(&'static str, String)> {
        let (interval, life) = (self.interval, self.life);
        if !(interval >= Time::si(1e-3) && interval.is_finite()) {
            let message = format!("`interval` must be 0.001 s or more, not {interval}");
            return vec![("puffs.interval", message)];
        }
        if !(2.0..=PUFFS_MAX).contains(&(life / interval)) {
            let message = format!(
                "`life` must be 2 to {PUFFS_MAX} times `interval`: {} to {}, not {life}",
                interval * 2.0,
                interval * PUFFS_MAX
            );
            return vec![("puffs.life", message)];
        }
        Vec::new()
    }

    fn wind(&self, weather: &dyn Weather, at: DVec3, t_s: f64) -> DVec3 {
        let time = SimTime::from_time(Time::si(t_s.max(0.0))).unwrap_or(SimTime::ZERO);
        let at = Position::from_si(at);
        let wind = if self.meander {
            weather.wind(at, time)
        } else {
            weather.mean_wind(at, time)
        };
        wind.si()
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Puff {
    center: DVec3,
    way: f64,
    mass: f64,
}

/// The puffs of one source between two steps, oldest first.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Drift {
    /// The number of the step: its time is `start + (step + 1/2) interval`.
    step: i64,
    now: VecDeque<Puff>,
    next: VecDeque<Puff>,
}

/// The step that a time lies in; below zero before the first puff.
pub(crate) fn step_of(source: &Source, puffs: &Puffs, time: SimTime) -> i64 {
    let since = time.as_secs_f64() - source.start.get();
    (since / puffs.interval.get() - 0.5).floor() as i64
}

fn time_of(source: &Source, puffs: &Puffs, step: i64) -> f64 {
    source.start.get() + (step as f64 + 0.5) * puffs.interval.get()
}

/// How many puffs of one source there are at most.
fn count(puffs: &Puffs) -> i64 {
    (puffs.life / puffs.interval).ceil() as i64
}

/// The puff that is released at a step.
fn released(source: &Source, puffs: &Puffs, step: i64) -> Puff {
    let interval = puffs.interval.get();
    let begin = source.start.get() + step as f64 * interval;
    let until = source.end.map_or(f64::INFINITY, Time::get);
    let gives = (until - begin).clamp(0.0, interval);
    Puff {
        center: source.position.si(),
        way: 0.0,
        mass: if step < 0 {
            0.0
        } else {
            source.rate.get() * gives
        },
    }
}

/// A puff one step on.
fn moved(puff: &Puff, puffs: &Puffs, weather: &dyn Weather, t_s: f64) -> Puff {
    let h = puffs.interval.get();
    let first = puffs.wind(weather, puff.center, t_s);
    let middle = puffs.wind(weather, puff.center + first * (0.5 * h), t_s + 0.5 * h);
    let mut center = puff.center + middle * h;
    center.z = center.z.abs(); // the ground throws it back
    let level = (middle.x * middle.x + middle.y * middle.y).sqrt();
    Puff {
        center,
        way: puff.way + level.max(CALM_M_S) * h,
        mass: puff.mass,
    }
}

impl Drift {
    /// The puffs at a time, each followed from its release.
    pub(crate) fn followed(
        source: &Source,
        puffs: &Puffs,
        time: SimTime,
        weather: &dyn Weather,
    ) -> Self {
        let step = step_of(source, puffs, time);
        let first = (step - count(puffs) + 1).max(0);
        let mut drift = Self {
            step: first - 1,
            now: VecDeque::new(),
            next: VecDeque::from([released(source, puffs, first)]),
        };
        while drift.step < step {
            drift.advance(source, puffs, weather);
        }
        drift
    }

    /// The same, one step on.
    pub(crate) fn advance(&mut self, source: &Source, puffs: &Puffs, weather: &dyn Weather) {
        self.step += 1;
        std::mem::swap(&mut self.now, &mut self.next);
        if self.now.len() as i64 > count(puffs) {
            self.now.pop_front();
        }
        let t_s = time_of(source, puffs, self.step);
        self.next.clear();
        let moved = self.now.iter().map(|puff| moved(puff, puffs, weather, t_s));
        self.next.extend(moved);
        self.next.push_back(released(source, puffs, self.step + 1));
    }

    pub(crate) fn step(&self) -> i64 {
        self.step
    }

    /// Concentration and gradient: the sum of equation 1.
    pub(crate) fn sample(&self, source: &Source, at: DVec3, time: SimTime) -> (f64, DVec3) {
        let mut sum = (0.0, DVec3::ZERO);
        let Some(puffs) = &source.puffs else {
            return sum;
        };
        let (interval, life) = (puffs.interval.get(), puffs.life.get());
        let since = time.as_secs_f64() - time_of(source, puffs, self.step);
        let share = (since / interval).clamp(0.0, 1.0);
        let youngest = self.now.len();
        for (i, (a, b)) in self.now.iter().zip(&self.next).enumerate() {
            let age = (youngest - 1 - i) as f64 * interval + since;
            let fade = (age / interval)
                .min((life - age) / interval)
                .clamp(0.0, 1.0);
            if a.mass * fade == 0.0 {
                continue;
            }
            let center = a.center + (b.center - a.center) * share;
            let way = a.way + (b.way - a.way) * share;
            let s = source.stability.spread(way, source.radius.get());
            let away = at - center;
            let level2 = away.x * away.x + away.y * away.y;
            if level2 > 80.0 * s.across || away.z * away.z > 80.0 * s.up && away.z > 0.0 {
                continue; // less than 1e-17 of the middle
            }
            let (d1, d2) = (away.z, at.z + center.z);
            let (e1, e2) = (
                math::exp(-0.5 * d1 * d1 / s.up),
                math::exp(-0.5 * d2 * d2 / s.up),
            );
            let value = a.mass * fade / (TAU * TAU.sqrt() * s.across * s.up.sqrt())
                * math::exp(-0.5 * level2 / s.across);
            sum.0 += value * (e1 + e2);
            sum.1 -= DVec3::new(away.x, away.y, 0.0) * (value * (e1 + e2) / s.across);
            sum.1.z -= value * (d1 * e1 + d2 * e2) / s.up;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::tests::assert_gradient;
    use crate::plume::Stability;
    use crate::plume::tests::{Breeze, source};
    use simbeeotic_units::{Enu, Velocity};

    fn puffing(interval_s: f64, life_s: f64) -> Source {
        Source {
            puffs: Some(Puffs {
                interval: Time::si(interval_s),
                life: Time::si(life_s),
                meander: false,
            }),
            ..source(1.0, Stability::D)
        }
    }

    /// Wind from the west, and from the south after 30 s.
    #[derive(Debug)]
    struct Turning;

    impl Weather for Turning {
        fn wind(&self, _: Position, time: SimTime) -> Velocity<Enu> {
            if time < SimTime::from_secs(30) {
                Velocity::from_xyz(2.0, 0.0, 0.0)
            } else {
                Velocity::from_xyz(0.0, 2.0, 0.0)
            }
        }
    }

    #[test]
    fn in_a_steady_wind_puffs_are_the_plume() {
        let wind = Breeze(DVec3::new(2.0, 1.0, 0.0));
        let (puffs, plume) = (puffing(0.1, 60.0), source(1.0, Stability::D));
        let time = SimTime::from_millis(70_030);
        for at in [
            DVec3::new(20.0, 10.0, 1.0),
            DVec3::new(39.0, 22.0, 0.0),
            DVec3::new(60.0, 29.0, 3.0),
        ] {
            let found = puffs.sample(at, time, &wind, None).0;
            let wanted = plume.sample(at, time, &wind, None).0;
            // A puff is as long as it is wide: over its length the spread changes by 8 %.
            assert!(
                (found / wanted - 1.0).abs() < 0.03,
                "{at}: {found}, {wanted}"
            );
        }
    }

    #[test]
    fn wind_that_turns_bends_the_plume() {
        let source = puffing(0.5, 60.0);
        let at = |x: f64, y: f64| {
            source
                .sample(
                    DVec3::new(x, y, 1.0),
                    SimTime::from_secs(45),
                    &Turning,
                    None,
                )
                .0
        };
        // What was released at 15 s went 30 m east, then 30 m north.
        let (corner, bent) = (at(30.0, 0.0), at(30.0, 30.0));
        assert!(bent > 1e-4, "{bent}");
        assert!(corner < 1e-3 * bent, "{corner}, {bent}");
        // The straight plume knows only the wind of now.
        let straight = Source {
            puffs: None,
            ..source.clone()
        };
        let (value, _) = straight.sample(
            DVec3::new(30.0, 30.0, 1.0),
            SimTime::from_secs(45),
            &Turning,
            None,
        );
        assert!(value < 1e-6 * bent);
    }

    #[test]
    fn all_that_was_given_off_is_there() {
        let source = Source {
            end: Some(Time::si(10.3)),
            ..puffing(0.5, 60.0)
        };
        let (wind, time) = (Breeze(DVec3::new(1.0, 0.0, 0.0)), SimTime::from_secs(30));
        let (cells, h) = (60, 1.0);
        let mut mass = 0.0;
        for i in 0..cells {
            for j in -15..15 {
                for k in 0..15 {
                    let at = DVec3::new(f64::from(i), f64::from(j) + 0.5, f64::from(k) + 0.5) * h;
                    mass += source.sample(at, time, &wind, None).0 * h * h * h;
                }
            }
        }
        assert!(
            (mass / (2.0 * 10.3) - 1.0).abs() < 0.01,
            "{mass} kg of 20.6 kg"
        );
    }

    #[test]
    fn the_gradient_is_that_of_the_value() {
        let source = puffing(0.5, 60.0);
        let time = SimTime::from_millis(45_200);
        for at in [
            DVec3::new(28.0, 29.0, 1.5),
            DVec3::new(0.1, 0.3, 0.9),
            DVec3::new(0.2, 11.0, 0.1),
        ] {
            let drift = Drift::followed(&source, &source.puffs.unwrap(), time, &Turning);
            assert_gradient(|p| drift.sample(&source, p, time), at, 1e-5);
        }
    }

    #[test]
    fn a_calm_is_finite_and_the_same_whoever_asks_when() {
        let source = puffing(0.5, 20.0);
        let puffs = source.puffs.unwrap();
        let still = Breeze(DVec3::ZERO);
        let time = SimTime::from_secs(50);
        let (value, _) = source.sample(DVec3::new(0.0, 0.0, 1.0), time, &still, None);
        assert!(value.is_finite() && value > 0.0);
        let mut drift = Drift::followed(&source, &puffs, SimTime::from_secs(3), &Turning);
        while drift.step() < step_of(&source, &puffs, time) {
            drift.advance(&source, &puffs, &Turning);
        }
        assert_eq!(drift, Drift::followed(&source, &puffs, time, &Turning));
        // Before the first puff there is none.
        let early = Source {
            start: Time::si(5.0),
            ..source
        };
        assert_eq!(
            early
                .sample(DVec3::Z, SimTime::from_secs(5), &still, None)
                .0,
            0.0
        );
    }

    #[test]
    fn nonsense_is_named() {
        let keys = |interval: f64, life: f64| {
            let source = puffing(interval, life);
            source
                .faults()
                .into_iter()
                .map(|(key, _)| key)
                .collect::<Vec<_>>()
        };
        assert_eq!(keys(0.0, 10.0), ["puffs.interval"]);
        assert_eq!(keys(f64::NAN, 10.0), ["puffs.interval"]);
        assert_eq!(keys(1.0, 1.0), ["puffs.life"]);
        assert_eq!(keys(0.01, 1e4), ["puffs.life"]);
        assert!(keys(0.5, 120.0).is_empty());
    }
}

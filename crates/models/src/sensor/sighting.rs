//! What detectors have in common: they tell which things of one kind they see in a cone.
//!
//! A part of a thing is seen if its centre lies within the cone and the range, and the first thing on the
//! straight line to it is the thing itself. A detector then errs:
//!
//! ```text
//! e = (d + b (n1 u + n2 v)) / |...|       bearing: two independent angles of sigma b      (1)
//! r = x + s n3                            distance, sigma s                               (2)
//! seen with probability p; false alarms: Poisson, evenly over the volume of the cone      (3)
//! ```
//! with `d` the true direction, `u` and `v` across it, `x` the true distance.

use super::bounds::{at_least_zero, positive};
use super::echo::cone;
use glam::DVec3;
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::physics::Kind;
use simbeeotic_model::units::{Angle, Length, Offset, math};
use simbeeotic_model::{Beams, BuildError, Column, Reading, SeesWhat, Thing, Truth};
use std::f64::consts::{FRAC_PI_8, PI, TAU};

/// Farther than any detector looks, m.
const RANGE_M_MAX: f64 = 1e4;

/// Something that a detector has found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting {
    /// What it is; the [`World`](simbeeotic_model::world::World) knows its label and what is attached to
    /// it. `None` is a false alarm: nothing is there. Real detectors do not know; a behaviour that is to
    /// fly on one should not look.
    pub thing: Option<Thing>,
    /// Where it is, in the sensor's own frame.
    pub position: Offset,
    /// How many there are: 1, but for the flowers of an approximate patch.
    pub count: f64,
}

impl Sighting {
    /// How far it is.
    pub fn distance(&self) -> Length {
        self.position.length()
    }

    /// Counter-clockwise from the sensor's forward axis, seen from above.
    pub fn azimuth(&self) -> Angle {
        let p = self.position.si();
        Angle::si(math::atan2(p.y, p.x))
    }

    /// Above the sensor's horizontal plane.
    pub fn elevation(&self) -> Angle {
        let p = self.position.si();
        Angle::si(math::atan2(p.z, math::hypot(p.x, p.y)))
    }
}

/// A false alarm is NaN in `kind`, `index` and `item`; see [`Thing`] as a reading.
impl Reading for Sighting {
    const COLUMNS: &'static [Column] = &[
        Column::new("kind", "1"),
        Column::new("index", "1"),
        Column::new("item", "1"),
        Column::new("x", "m"),
        Column::new("y", "m"),
        Column::new("z", "m"),
        Column::new("count", "1"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        self.thing.numbers(to);
        to.extend(self.position.si().to_array());
        to.push(self.count);
    }
}

/// The original's greatest range and half angle.
pub(super) const USUAL_CONE: (Length, Angle) = (Length::si(1.0), Angle::si(FRAC_PI_8));

/// What a detector's reading keeps and how it errs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Detector {
    pub(super) max_range: Length,
    pub(super) half_angle: Angle,
    pub(super) bearing_sigma: Angle,
    pub(super) range_sigma: Length,
    pub(super) detection: f64,
    pub(super) false_alarms: f64,
    pub(super) hidden_by: SeesWhat,
}

/// A part of a thing that is in sight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) thing: Thing,
    /// Its centre, in the sensor's frame, m.
    pub(super) at: DVec3,
}

/// These kinds, and `kind`.
pub(super) fn and(kinds: SeesWhat, kind: Kind) -> SeesWhat {
    let kinds: Vec<Kind> = kinds.kinds().with(kind).iter().collect();
    SeesWhat::only(&kinds)
}

/// Most false alarms of one reading, on average.
const ALARMS_MAX: f64 = 1e4;

impl Detector {
    /// # Errors
    /// Numbers out of range.
    pub(super) fn checked(self) -> Result<Self, BuildError> {
        positive("max_range", self.max_range)?;
        let farthest = Length::si(RANGE_M_MAX);
        in_range("max_range", self.max_range, Length::ZERO..=farthest)?;
        positive("half_angle", self.half_angle)?;
        in_range("half_angle", self.half_angle, Angle::ZERO..=Angle::si(PI))?;
        at_least_zero("bearing_sigma", self.bearing_sigma)?;
        at_least_zero("range_sigma", self.range_sigma)?;
        in_range("detection", self.detection, 0.0..=1.0)?;
        in_range("false_alarms", self.false_alarms, 0.0..=ALARMS_MAX)?;
        Ok(self)
    }

    /// Its cone.
    pub(super) fn beams(&self) -> Beams {
        Beams::cone(self.half_angle, self.max_range)
    }

    fn holds(&self, at: DVec3) -> bool {
        let (r, half) = (at.length(), self.half_angle.get());
        r <= self.max_range.get() && at.x >= r * math::cos(half)
    }

    /// The bodies of `kind` about the sensor, `margin` farther than it looks, in its own frame.
    pub(super) fn around(&self, truth: &Truth<'_>, kind: Kind, margin: Length) -> Vec<Part> {
        let pose = truth.sensor_pose();
        let nearby = truth.nearby(self.max_range + margin, SeesWhat::only(&[kind]));
        let local = nearby.into_iter().map(|body| Part {
            thing: body.thing,
            at: pose.to_body(body.position).si(),
        });
        local.collect()
    }

    /// Drops the parts that are outside of the cone, or hidden by something.
    pub(super) fn keep_seen(&self, truth: &Truth<'_>, parts: &mut Vec<Part>) {
        parts.retain(|part| self.holds(part.at) && part.at != DVec3::ZERO);
        if parts.is_empty() {
            return;
        }
        let mut seen = vec![false; parts.len()];
        let directions = parts.iter().map(|part| part.at.normalize());
        truth.look(directions, self.max_range, self.hidden_by, |at, echo| {
            let part = &parts[at];
            seen[at] = echo.is_none_or(|echo| {
                echo.thing == part.thing || echo.distance.get() >= part.at.length()
            });
        });
        let mut seen = seen.into_iter();
        parts.retain(|_| seen.next() == Some(true));
    }

    /// Equations 1 to 3. The nearest comes first.
    pub(super) fn measure(&self, ideal: Vec<Sighting>, rng: &mut Stream) -> Vec<Sighting> {
        let mut found = Vec::with_capacity(ideal.len());
        for mut sighting in ideal {
            if self.detection < 1.0 && !rng.bernoulli(self.detection) {
                continue;
            }
            sighting.position = Offset::from_si(self.blur(sighting.position.si(), rng));
            found.push(sighting);
        }
        if self.false_alarms > 0.0 {
            for _ in 0..poisson(self.false_alarms, rng) {
                let (share, phi) = (rng.uniform(), TAU * rng.uniform());
                let r = self.max_range.get() * math::pow(rng.uniform(), 1.0 / 3.0);
                found.push(Sighting {
                    thing: None,
                    position: Offset::from_si(cone(self.half_angle.get(), share, phi) * r),
                    count: 1.0,
                });
            }
        }
        sort(&mut found);
        found
    }

    fn blur(&self, at: DVec3, rng: &mut Stream) -> DVec3 {
        let (bearing, range) = (self.bearing_sigma.get(), self.range_sigma.get());
        let r = at.length();
        if r == 0.0 || bearing == 0.0 && range == 0.0 {
            return at;
        }
        let ahead = at / r;
        let (u, v) = ahead.any_orthonormal_pair();
        let direction = ahead + bearing * (rng.normal() * u + rng.normal() * v);
        direction.normalize() * (r + range * rng.normal()).max(0.0)
    }
}

/// The nearest first; of several as near, in their order.
pub(super) fn sort(found: &mut [Sighting]) {
    found.sort_by(|a, b| a.distance().total_cmp(&b.distance()));
}

/// A draw from the Poisson distribution of this mean; above 1,000 by its normal limit.
pub(super) fn poisson(mean: f64, rng: &mut Stream) -> u64 {
    if mean > 1e3 {
        return (mean + mean.sqrt() * rng.normal()).round().max(0.0) as u64;
    }
    let (mut count, mut sum) = (0, rng.exponential());
    while sum < mean {
        sum += rng.exponential();
        count += 1;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::assert_normal;

    const EXACT: Detector = Detector {
        max_range: Length::si(10.0),
        half_angle: Angle::si(0.5),
        bearing_sigma: Angle::ZERO,
        range_sigma: Length::ZERO,
        detection: 1.0,
        false_alarms: 0.0,
        hidden_by: SeesWhat::EVERYTHING,
    };

    fn one() -> Vec<Sighting> {
        vec![Sighting {
            thing: Some(Thing::Ground),
            position: Offset::from_xyz(3.0, -1.0, 2.0),
            count: 1.0,
        }]
    }

    fn rng() -> Stream {
        Stream::new(5, "bee/person", "noise")
    }

    #[test]
    fn a_recorded_sighting_says_of_what_it_is() {
        use simbeeotic_model::world::{ObjectId, ObjectKind};
        let mut sighting = Sighting {
            thing: Some(Thing::Object(ObjectId::new(ObjectKind::Person, 2))),
            position: Offset::from_xyz(1.0, 2.0, 3.0),
            count: 1.0,
        };
        assert_eq!(Sighting::COLUMNS[..3], *<Thing as Reading>::COLUMNS);
        let mut row = Vec::new();
        sighting.numbers(&mut row);
        assert_eq!(row, [5.0, 2.0, 0.0, 1.0, 2.0, 3.0, 1.0]);
        sighting.thing = None;
        row.clear();
        sighting.numbers(&mut row);
        assert!(row.len() == 7 && row[..3].iter().all(|n| n.is_nan()));
        const { assert!(!<Vec<Sighting> as Reading>::PAIRED) };
    }

    #[test]
    fn bearing_and_distance_err_by_their_sigmas() {
        let detector = Detector {
            bearing_sigma: Angle::si(0.01),
            range_sigma: Length::si(0.2),
            ..EXACT
        };
        let (mut rng, truth) = (rng(), one()[0].position.si());
        let found: Vec<DVec3> = (0..100_000)
            .map(|_| detector.measure(one(), &mut rng)[0].position.si())
            .collect();
        let lengths: Vec<f64> = found.iter().map(|p| p.length()).collect();
        assert_normal(&lengths, truth.length(), 0.2);
        let (u, v) = truth.normalize().any_orthonormal_pair();
        for across in [u, v] {
            let angles: Vec<f64> = found
                .iter()
                .map(|p| math::asin(p.normalize().dot(across)))
                .collect();
            assert_normal(&angles, 0.0, 0.01);
        }
    }

    #[test]
    fn it_misses_as_many_as_it_says() {
        let detector = Detector {
            detection: 0.7,
            ..EXACT
        };
        let mut rng = rng();
        let seen: usize = (0..100_000)
            .map(|_| detector.measure(one(), &mut rng).len())
            .sum();
        let error = 4.0 * (1e5_f64 * 0.21).sqrt();
        assert!((seen as f64 - 7e4).abs() < error, "{seen}");
    }

    #[test]
    fn false_alarms_are_as_many_as_it_says_and_fill_the_cone_evenly() {
        let detector = Detector {
            false_alarms: 2.0,
            ..EXACT
        };
        let mut rng = rng();
        let mut all = Vec::new();
        let counts: Vec<f64> = (0..50_000)
            .map(|_| {
                let found = detector.measure(Vec::new(), &mut rng);
                assert!(found.is_sorted_by(|a, b| a.distance() <= b.distance()));
                all.extend(found.iter().map(|f| f.position.si()));
                found.len() as f64
            })
            .collect();
        assert_normal(&counts, 2.0, 2.0_f64.sqrt());
        assert!(all.iter().all(|p| detector.holds(*p)));
        let n = all.len() as f64;
        let near = all.iter().filter(|p| p.length() < 5.0).count() as f64;
        assert!((near / n - 0.125).abs() < 0.005, "{near} of {n}");
        let middle = 0.5 * (1.0 + math::cos(0.5));
        let inner = all.iter().filter(|p| p.x > middle * p.length()).count() as f64;
        assert!((inner / n - 0.5).abs() < 0.01, "{inner} of {n}");
    }

    #[test]
    fn poisson_draws_have_their_mean_as_variance() {
        for mean in [0.3, 30.0, 5000.0] {
            let mut rng = rng();
            let n = if mean < 1.0 { 100_000 } else { 20_000 };
            let draws: Vec<f64> = (0..n).map(|_| poisson(mean, &mut rng) as f64).collect();
            let found = draws.iter().sum::<f64>() / f64::from(n);
            assert!(
                (found - mean).abs() < 4.0 * (mean / f64::from(n)).sqrt(),
                "{found}"
            );
            let variance =
                draws.iter().map(|d| (d - found) * (d - found)).sum::<f64>() / f64::from(n);
            assert!((variance / mean - 1.0).abs() < 0.06, "{variance} of {mean}");
        }
    }
}

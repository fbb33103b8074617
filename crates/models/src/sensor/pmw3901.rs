//! PixArt PMW3901: a camera that counts how far its picture has moved.

use super::bounds::{at_least_zero, positive, reach};
use super::flow::flow;
use super::optical_flow::look;
use simbeeotic_model::kernel::{SimTime, Stream};
use simbeeotic_model::units::{AngularRate, Illuminance, Length, Time};
use simbeeotic_model::{
    Beams, BuildError, Column, Reading, SeesWhat, Sensor, Truth, params, sensor,
};

/// Counts by how much the picture ahead has moved since it was last read, as a PixArt PMW3901 does.
///
/// The flow is that of `optical-flow` in the middle of the picture, taken to change evenly between two
/// readings, times `scale`; whole counts are read, and what is left of one is kept. For a flow deck point
/// the mount down, `pointing = [0.0, 0.0, -1.0]`: then flying forward at `v` at the height `h` counts
/// `y = scale v / h` a second. Nearer than 80 mm, or with nothing in sight, nothing is counted; faster than
/// 7.4 rad/s it counts as at 7.4 rad/s.
///
/// Sources: PMW3901MB-TXQT product data sheet, R1.00: 42 degrees of view, 35 x 35 pixels, 80 mm to
/// infinity, 7.4 rad/s, 60 lx, registers of 16 bits (not at hand, as papers quote it). The scale is that of
/// the Crazyflie's estimator (crazyflie-firmware, `mm_flow.c`): ten counts a pixel, and 35 pixels to
/// `2 sin(21 deg) = 0.71674`; its older 30 pixels to 4.2 degrees are 409 counts a radian. The noise is the
/// 0.25 pixels that its deck driver gave with each reading.
#[sensor("pmw3901")]
pub struct Pmw3901 {
    params: Pmw3901Params,
    last: Option<Last>,
    /// What is less than a count, of both axes.
    rest: [f64; 2],
}

#[derive(Clone, Copy)]
struct Last {
    time: SimTime,
    flow: Option<[f64; 2]>,
}

/// What a [`Pmw3901`] reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowCount {
    /// How far the picture has moved to the right, in counts.
    pub x: f64,
    /// How far it has moved down, in counts.
    pub y: f64,
    /// Since when: the time from the last reading to this one. 0 the first time.
    pub time: Time,
    /// Whether there was something to see.
    pub seen: bool,
}

impl FlowCount {
    /// The mean flow to the right and down, if so many counts are a radian; `None` if nothing was seen, or
    /// no time has passed.
    pub fn flow(&self, counts_per_radian: f64) -> Option<[AngularRate; 2]> {
        let rate = |counts: f64| AngularRate::si(counts / counts_per_radian / self.time.get());
        (self.seen && self.time > Time::ZERO).then(|| [rate(self.x), rate(self.y)])
    }
}

impl Reading for FlowCount {
    const COLUMNS: &'static [Column] = &[
        Column::new("x", "1"),
        Column::new("y", "1"),
        Column::new("time", "s"),
        Column::new("seen", "1"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.extend([self.x, self.y, self.time.get()]);
        self.seen.numbers(to);
    }
}

/// Parameters of [`Pmw3901`].
#[params]
pub struct Pmw3901Params {
    /// Counts for a radian of motion. Above 0.
    pub scale: f64,
    /// Standard deviation of each count. 0 or more.
    pub sigma: f64,
    /// What is nearer is not seen. 0 or more.
    pub min_range: Length,
    /// What is farther is not seen. Above 0.
    pub max_range: Length,
    /// The fastest flow that is followed. Above 0.
    pub max_rate: AngularRate,
    /// In less light nothing is seen; the data sheet asks for 60 lx. 0 or more: of a world without light
    /// this says nothing unless it is set.
    pub min_light: Illuminance,
    /// What has a picture; the rest is looked through.
    pub sees: SeesWhat,
}

impl Default for Pmw3901Params {
    fn default() -> Self {
        Self {
            scale: Self::COUNTS_PER_RADIAN,
            sigma: 2.5,
            min_range: Length::from_millimetres(80.0),
            max_range: Length::si(1000.0),
            max_rate: AngularRate::si(7.4),
            min_light: Illuminance::ZERO,
            sees: SeesWhat::EVERYTHING,
        }
    }
}

impl Pmw3901Params {
    /// Ten counts for each of 35 pixels, which see 0.71674 rad.
    pub const COUNTS_PER_RADIAN: f64 = 10.0 * 35.0 / 0.71674;
}

impl Pmw3901 {
    fn flow_now(&self, truth: &Truth<'_>) -> Option<[f64; 2]> {
        let (p, pose) = (&self.params, truth.sensor_pose());
        let dark = p.min_light > Illuminance::ZERO
            && truth.weather().light(pose.position, truth.now()) < p.min_light;
        let middle = [0.0; 2];
        let seen = look(truth, pose, &[middle], p.max_range, p.sees);
        let (sight, distance) = seen.into_iter().next().flatten()?;
        (!dark && distance >= p.min_range)
            .then(|| flow(middle, sight.depth, sight.velocity, truth.sensor_rate()).sum())
    }
}

impl Sensor for Pmw3901 {
    type Params = Pmw3901Params;
    type Reading = FlowCount;

    fn build(params: Pmw3901Params) -> Result<Self, BuildError> {
        positive("scale", params.scale)?;
        at_least_zero("sigma", params.sigma)?;
        at_least_zero("min_range", params.min_range)?;
        reach("max_range", params.max_range)?;
        if params.min_range >= params.max_range {
            let message = format!("must be less than `max_range`, and is {}", params.min_range);
            return Err(BuildError::parameter("min_range", message));
        }
        positive("max_rate", params.max_rate)?;
        at_least_zero("min_light", params.min_light)?;
        Ok(Self {
            params,
            last: None,
            rest: [0.0; 2],
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> FlowCount {
        let (time, flow) = (truth.now(), self.flow_now(truth));
        let last = self.last.replace(Last { time, flow });
        let last = last.unwrap_or(Last { time, flow });
        let passed = (time.nanos() - last.time.nanos()) as f64 * 1e-9;
        let way = match (last.flow, flow) {
            (Some([a, b]), Some([c, d])) => Some([0.5 * (a + c), 0.5 * (b + d)]),
            _ => None,
        };
        let [x, y] = way.unwrap_or_default();
        FlowCount {
            x: self.params.scale * x * passed,
            y: self.params.scale * y * passed,
            time: Time::si(passed),
            seen: way.is_some(),
        }
    }

    fn measure(&mut self, ideal: FlowCount, _: &Truth<'_>, rng: &mut Stream) -> FlowCount {
        let p = &self.params;
        let most = p.scale * (p.max_rate * ideal.time).get();
        let mut counts = [ideal.x, ideal.y];
        for (count, rest) in counts.iter_mut().zip(&mut self.rest) {
            if !ideal.seen {
                *count = 0.0;
                continue;
            }
            let whole = count.clamp(-most, most) + *rest;
            let noise = if p.sigma > 0.0 {
                p.sigma * rng.normal()
            } else {
                0.0
            };
            // The registers have 16 bits.
            let read = (whole + noise).round().clamp(-32768.0, 32767.0);
            *rest = (whole - (whole + noise).round() + noise).clamp(-0.5, 0.5);
            *count = read;
        }
        let [x, y] = counts;
        FlowCount { x, y, ..ideal }
    }

    fn beams(&self) -> Option<Beams> {
        Some(Beams::ahead(self.params.max_range))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::optical_flow::downwards;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Angle, Attitude, Mount, Offset, Position, Rate, Velocity, Yaw};

    type Reader = Handle<FlowCount>;

    const SCALE: f64 = Pmw3901Params::COUNTS_PER_RADIAN;

    fn trial(params: &[(&'static str, &str)]) -> Trial {
        let mut trial = Trial::of("pmw3901", params);
        trial.mount = Mount::new(Offset::ZERO, downwards());
        (trial.every, trial.seconds) = (Time::from_millis(10.0), 3);
        trial
    }

    #[test]
    fn its_counts_add_up_to_the_way_over_the_height() {
        for yaw in [0.0, 130.0] {
            let (mut sum, mut readings) = ([0.0; 2], 0);
            trial(&[("sigma", "0")]).run(move |bee, sensor: Reader| {
                if readings == 0 {
                    bee.set_attitude(Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw))));
                    bee.set_velocity_flu(Velocity::from_xyz(3.0, 0.7, 0.0));
                }
                let read = bee.read(sensor);
                sum = [sum[0] + read.x, sum[1] + read.y];
                let (seconds, height) = (f64::from(readings) * 0.01, bee.position().up().get());
                let want = [0.7, 3.0].map(|speed| SCALE * speed / height * seconds);
                assert!((sum[0] - want[0]).abs() < 0.51, "{sum:?} for {want:?}");
                assert!((sum[1] - want[1]).abs() < 0.51, "{sum:?} for {want:?}");
                readings += 1;
            });
        }
    }

    #[test]
    fn a_turn_counts_as_well_until_the_gyroscope_takes_it_away() {
        let mut first = true;
        trial(&[("sigma", "0")]).run(move |bee, sensor: Reader| {
            // Level in each reading: it turns about its own left, and is set back.
            bee.set_attitude(Attitude::IDENTITY);
            bee.set_rate(Rate::from_xyz(0.0, 1.0, 0.0));
            let read = bee.read(sensor);
            if !first {
                // Nose down by 1 rad/s for 10 ms: the picture goes up.
                assert!((read.y + SCALE * 0.01).abs() < 1.01, "{read:?}");
                assert_eq!(read.x, 0.0);
                let [_, down] = read.flow(SCALE).expect("seen");
                assert!((down.get() + 1.0).abs() < 0.25, "{down}");
            }
            first = false;
        });
    }

    #[test]
    fn it_counts_no_faster_than_it_can_follow_and_nothing_too_near() {
        let mut readings = 0;
        trial(&[("sigma", "0")]).run(move |bee, sensor: Reader| {
            let (height, seen) = if readings < 100 {
                (0.2, true)
            } else {
                (0.075, false)
            };
            bee.set_position(Position::from_xyz(0.0, 0.0, height));
            bee.set_velocity(Velocity::from_xyz(3.0, 0.0, 0.0));
            let read = bee.read(sensor);
            if readings % 100 > 1 {
                assert_eq!(read.seen, seen, "{read:?}");
                // 3 / 0.2 = 15 rad/s is beyond 7.4 rad/s.
                let want = if seen { SCALE * 0.074 } else { 0.0 };
                assert!((read.y - want).abs() < 1.01, "{read:?}");
            }
            readings += 1;
        });
    }

    #[test]
    fn in_the_dark_it_sees_nothing_if_it_asks_for_light() {
        trial(&[("sigma", "0"), ("min_light", "60 lx")]).run(|bee, sensor: Reader| {
            bee.set_velocity(Velocity::from_xyz(3.0, 0.0, 0.0));
            let read = bee.read(sensor);
            assert!(!read.seen && read.x == 0.0 && read.y == 0.0);
            assert_eq!(read.flow(SCALE), None);
        });
    }

    #[test]
    fn the_noise_is_as_large_as_it_says() {
        let mut read = Vec::new();
        let mut trial = trial(&[("sigma", "40")]);
        (trial.every, trial.seconds) = (Time::from_millis(1.0), 101);
        trial.run(move |bee, sensor: Reader| {
            read.push(bee.read(sensor).x);
            if read.len() == 100_000 {
                // Whole counts add 1/12 to a variance of 1600.
                assert_normal(&read, 0.0, 40.0);
            }
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, text) in [
            ("scale", "0"),
            ("sigma", "-1"),
            ("min_range", "-1 m"),
            ("max_range", "0 m"),
            ("max_rate", "0 rad/s"),
            ("min_light", "-1 lx"),
        ] {
            let refusal = refusal("pmw3901", &[(key, text)]).expect("it is refused");
            assert!(refusal.contains(key), "{refusal}");
        }
    }
}

//! Satellite navigation.

use super::bounds::{at_least_zero, positive, reach};
use super::noise::{Channel, Drift, Errors};
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::{SimTime, Stream};
use simbeeotic_model::units::glam::DVec3;
use simbeeotic_model::units::{Angle, Enu, Length, Position, Speed, Time, Velocity, math};
use simbeeotic_model::{
    BuildError, Column, Ray, Reading, SeesWhat, Sensor, Truth, choice, params, sensor,
};

/// Measures its own position and velocity in the world, as a satellite receiver does: with an error that
/// stays for a while, now and then without a fix.
///
/// The error of the position is, along each axis, a Gauss-Markov process (`noise`, equation 5) and white
/// noise; across and up have sigmas of their own. There is no fix while an outage lasts, and while less than
/// `min_sky` of the sky is open: of seventeen rays, to the zenith, to eight sides at 60 and to eight at 30
/// degrees above the horizon, as many must pass. Such a receiver has a `rate` of 1 to 10 Hz and a `delay` of
/// about 100 ms; those are keys of every sensor.
#[sensor("gnss")]
pub struct Gnss {
    params: GnssParams,
    figures: Figures,
    slow: [Channel; 3],
    /// Whether an outage lasts, and since when that is known.
    outage: Option<(bool, SimTime)>,
}

/// What a [`Gnss`] reads, while it has a fix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fix {
    /// Where it is.
    pub position: Position,
    /// How it moves.
    pub velocity: Velocity<Enu>,
}

impl Reading for Fix {
    const COLUMNS: &'static [Column] = &[
        Column::new("x", "m"),
        Column::new("y", "m"),
        Column::new("z", "m"),
        Column::new("vx", "m/s"),
        Column::new("vy", "m/s"),
        Column::new("vz", "m/s"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        self.position.numbers(to);
        self.velocity.numbers(to);
    }
}

/// A receiver whose data sheet gives the errors that a scenario does not.
///
/// The circular error probable (CEP), within which half of the fixes are, is 1.1774 sigma. The data sheets
/// give neither the vertical error nor how long it stays: 1.5 times the horizontal one (as dilution of
/// precision is under an open sky) and 60 s are assumptions.
#[choice]
pub enum GnssDevice {
    /// No errors.
    Ideal,
    /// u-blox NEO-M8N: 2.5 m CEP, 0.05 m/s (UBX-15031086, section 1.3; not at hand).
    NeoM8n,
    /// u-blox NEO-M9N: 2.0 m CEP, 0.05 m/s (UBX-19014285, section 1.3; not at hand).
    NeoM9n,
}

#[derive(Clone, Copy)]
struct Figures {
    horizontal: Length,
    vertical: Length,
    white: Length,
    velocity: Speed,
}

impl GnssDevice {
    fn figures(self) -> Figures {
        let of = |cep_m: f64| {
            let horizontal = Length::si(cep_m / CEP_SIGMAS);
            Figures {
                horizontal,
                vertical: 1.5 * horizontal,
                white: Length::from_centimetres(10.0),
                velocity: Speed::si(0.05),
            }
        };
        match self {
            Self::Ideal => Figures {
                horizontal: Length::ZERO,
                vertical: Length::ZERO,
                white: Length::ZERO,
                velocity: Speed::ZERO,
            },
            Self::NeoM8n => of(2.5),
            Self::NeoM9n => of(2.0),
        }
    }
}

/// `sqrt(2 ln 2)`: the radius that holds half of a circular normal distribution.
const CEP_SIGMAS: f64 = 1.177_410_022_515_474_7;

/// Parameters of [`Gnss`].
#[params]
pub struct GnssParams {
    /// The receiver whose data sheet says what is not said here: `ideal`, `neo-m8n`, `neo-m9n`.
    pub preset: GnssDevice,
    /// Standard deviation of the slow error, to the east and to the north each. 0 or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub horizontal_sigma: Option<Length>,
    /// Standard deviation of the slow error upwards. 0 or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vertical_sigma: Option<Length>,
    /// How long the slow error stays: its correlation time. Above 0.
    pub correlation_time: Time,
    /// Standard deviation of the error of each single fix, on each axis. 0 or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub white_sigma: Option<Length>,
    /// Standard deviation of the velocity, on each axis. 0 or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity_sigma: Option<Speed>,
    /// Mean length of an outage; 0: there are none.
    pub outage_time: Time,
    /// Mean time between the end of an outage and the next. Above 0.
    pub fix_time: Time,
    /// The part of the sky that must be open for a fix, 0 to 1; 0: all are let through, and no ray is cast.
    pub min_sky: f64,
    /// What is farther does not cover the sky. Above 0.
    pub sky_range: Length,
    /// What covers the sky.
    pub sees: SeesWhat,
}

impl Default for GnssParams {
    fn default() -> Self {
        Self {
            preset: GnssDevice::NeoM9n,
            horizontal_sigma: None,
            vertical_sigma: None,
            correlation_time: Time::from_secs(60.0),
            white_sigma: None,
            velocity_sigma: None,
            outage_time: Time::ZERO,
            fix_time: Time::from_minutes(10.0),
            min_sky: 0.0,
            sky_range: Length::si(500.0),
            sees: SeesWhat::EVERYTHING,
        }
    }
}

impl Sensor for Gnss {
    type Params = GnssParams;
    type Reading = Option<Fix>;

    fn build(params: GnssParams) -> Result<Self, BuildError> {
        let sheet = params.preset.figures();
        let figures = Figures {
            horizontal: params.horizontal_sigma.unwrap_or(sheet.horizontal),
            vertical: params.vertical_sigma.unwrap_or(sheet.vertical),
            white: params.white_sigma.unwrap_or(sheet.white),
            velocity: params.velocity_sigma.unwrap_or(sheet.velocity),
        };
        at_least_zero("horizontal_sigma", figures.horizontal)?;
        at_least_zero("vertical_sigma", figures.vertical)?;
        at_least_zero("white_sigma", figures.white)?;
        at_least_zero("velocity_sigma", figures.velocity)?;
        positive("correlation_time", params.correlation_time)?;
        at_least_zero("outage_time", params.outage_time)?;
        positive("fix_time", params.fix_time)?;
        in_range("min_sky", params.min_sky, 0.0..=1.0)?;
        reach("sky_range", params.sky_range)?;
        let slow = |sigma: Length| {
            let (sigma, time_s) = (sigma.get(), params.correlation_time.get());
            Channel::new(Errors {
                drift: Drift::Markov { sigma, time_s },
                ..Errors::default()
            })
        };
        let (across, up) = (slow(figures.horizontal), slow(figures.vertical));
        Ok(Self {
            params,
            figures,
            slow: [across.clone(), across, up],
            outage: None,
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Option<Fix> {
        Some(Fix {
            position: truth.sensor_pose().position,
            velocity: truth.sensor_velocity(),
        })
    }

    fn measure(&mut self, ideal: Option<Fix>, truth: &Truth<'_>, rng: &mut Stream) -> Option<Fix> {
        let now = truth.now();
        // The error goes on while there is no fix.
        let slow: [f64; 3] = std::array::from_fn(|axis| self.slow[axis].read(0.0, now, rng));
        let mut white = |sigma: f64| DVec3::new(rng.normal(), rng.normal(), rng.normal()) * sigma;
        let position = white(self.figures.white.get()) + DVec3::from_array(slow);
        let velocity = white(self.figures.velocity.get());
        let fix = ideal.map(|ideal| Fix {
            position: ideal.position + Position::from_si(position),
            velocity: ideal.velocity + Velocity::from_si(velocity),
        });
        let out = self.is_out(now, rng) || !self.has_sky(truth);
        fix.filter(|_| !out)
    }
}

impl Gnss {
    /// Outages and fixes follow each other, each of exponential length: a Markov process of two states,
    /// `P(out at t + dt) = p + (out - p) exp(-dt (1 / outage_time + 1 / fix_time))`, with `p` the part of
    /// all time that is out.
    fn is_out(&mut self, now: SimTime, rng: &mut Stream) -> bool {
        let (out_s, fix_s) = (self.params.outage_time.get(), self.params.fix_time.get());
        if out_s <= 0.0 {
            return false;
        }
        let usual = out_s / (out_s + fix_s);
        let likely = match self.outage {
            None => usual,
            Some((was, since)) => {
                let dt = (now.nanos() - since.nanos()) as f64 * 1e-9;
                let was = f64::from(u8::from(was));
                usual + (was - usual) * math::exp(-dt * (1.0 / out_s + 1.0 / fix_s))
            }
        };
        let out = rng.uniform() < likely;
        self.outage = Some((out, now));
        out
    }

    fn has_sky(&self, truth: &Truth<'_>) -> bool {
        if self.params.min_sky <= 0.0 {
            return true;
        }
        let origin = truth.sensor_pose().position;
        let rays = sky().map(|direction| Ray {
            origin,
            direction,
            range: self.params.sky_range,
        });
        let Ok(hits) = truth.cast_rays(&rays, self.params.sees) else {
            return false;
        };
        let open = hits.iter().filter(|hit| hit.is_none()).count();
        open as f64 >= self.params.min_sky * rays.len() as f64
    }
}

/// The zenith, and eight directions at 60 and at 30 degrees above the horizon.
fn sky() -> [[f64; 3]; 17] {
    std::array::from_fn(|at| {
        let Some(at) = at.checked_sub(1) else {
            return [0.0, 0.0, 1.0];
        };
        let height = Angle::from_degrees(if at < 8 { 60.0 } else { 30.0 });
        let (up, level) = height.sin_cos();
        let (y, x) = Angle::from_degrees(45.0 * (at % 8) as f64).sin_cos();
        [level * x, level * y, up]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::scene::block;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Attitude, Mount, Offset, Rate, Yaw};
    use simbeeotic_model::world::World;

    type Reader = Handle<Option<Fix>>;

    #[test]
    fn its_slow_error_has_the_allan_deviation_of_its_process() {
        let params = GnssParams {
            horizontal_sigma: Some(Length::si(2.0)),
            correlation_time: Time::si(10.0),
            ..GnssParams::default()
        };
        let mut gnss = Gnss::build(params).expect("good");
        let mut rng = Stream::new(2, "bee/gnss", "noise");
        let read: Vec<f64> = (0..200_000)
            .map(|second| gnss.slow[0].read(0.0, SimTime::from_millis(second * 500), &mut rng))
            .collect();
        for n in [4, 20, 40, 100] {
            // Of the mean over tau: 2 D^2 x (1 - x / 2 (3 - 4 exp(-1 / x) + exp(-2 / x))), x = T / tau.
            let x: f64 = 10.0 / (n as f64 * 0.5);
            let ends = 3.0 - 4.0 * math::exp(-1.0 / x) + math::exp(-2.0 / x);
            let want = 2.0 * (2.0 * x * (1.0 - 0.5 * x * ends)).sqrt();
            let found = crate::trial::allan_deviation(&read, n);
            assert!((found / want - 1.0).abs() < 0.1, "{n}: {found} for {want}");
        }
    }

    #[test]
    fn without_errors_it_reads_the_place_and_motion_of_its_antenna() {
        let mut trial = Trial::of("gnss", &[("preset", "ideal")]);
        trial.mount = Mount::new(Offset::from_xyz(0.2, 0.0, 0.0), Attitude::IDENTITY);
        trial.run(|bee, sensor: Reader| {
            for yaw in [0.0, 140.0] {
                let attitude = Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw)));
                bee.set_attitude(attitude);
                bee.set_velocity(Velocity::from_xyz(1.0, 2.0, 3.0));
                bee.set_rate(Rate::from_xyz(0.0, 0.0, 5.0));
                let fix = bee.read(sensor).expect("a fix");
                let place = bee.position().si() + attitude.forward() * 0.2;
                assert!((fix.position.si() - place).length() < 1e-12);
                let velocity = bee.velocity().si() + attitude.left();
                assert!((fix.velocity.si() - velocity).length() < 1e-12);
            }
        });
    }

    #[test]
    fn half_of_the_fixes_of_a_neo_m9n_are_within_two_metres() {
        // Far apart, so that the slow error is new each time.
        let mut trial = Trial::of(
            "gnss",
            &[("white_sigma", "0 m"), ("correlation_time", "1 ms")],
        );
        (trial.every, trial.seconds) = (Time::from_millis(10.0), 1001);
        let (mut within, mut up, mut east) = (0, Vec::new(), Vec::new());
        trial.run(move |bee, sensor: Reader| {
            let fix = bee.read(sensor).expect("a fix");
            let off = fix.position - bee.position();
            within += u32::from(off.horizontal().length() < Length::si(2.0));
            up.push(off.up().get());
            east.push(fix.velocity.east().get());
            if up.len() == 100_000 {
                let share = f64::from(within) / 1e5;
                assert!(
                    (share - 0.5).abs() < 4.0 * (0.25_f64 / 1e5).sqrt(),
                    "{share}"
                );
                assert_normal(&up, 0.0, 1.5 * 2.0 / 1.1774);
                assert_normal(&east, 0.0, 0.05);
            }
        });
    }

    #[test]
    fn its_error_stays_for_a_while() {
        let params = [
            ("horizontal_sigma", "3 m"),
            ("white_sigma", "0 m"),
            ("correlation_time", "10 s"),
        ];
        let mut trial = Trial::of("gnss", &params);
        (trial.every, trial.seconds) = (Time::from_secs(1.0), 100_001);
        let mut errors = Vec::new();
        trial.run(move |bee, sensor: Reader| {
            let fix = bee.read(sensor).expect("a fix");
            errors.push((fix.position - bee.position()).east().get());
            if errors.len() == 100_000 {
                let n = errors.len() - 10;
                let product = |lag: usize| {
                    let pairs = errors.iter().zip(&errors[lag..]).take(n);
                    pairs.map(|(a, b)| a * b).sum::<f64>() / n as f64
                };
                // 10,000 times its memory: 4 sigma are about 4 x 9 sqrt(2 / 10,000).
                assert!((product(0) - 9.0).abs() < 0.5, "{}", product(0));
                let want = 9.0 * math::exp(-1.0);
                assert!((product(10) - want).abs() < 0.5, "{}", product(10));
            }
        });
    }

    #[test]
    fn outages_are_as_long_and_as_frequent_as_it_says() {
        let params = [("outage_time", "20 s"), ("fix_time", "80 s")];
        let mut trial = Trial::of("gnss", &params);
        (trial.every, trial.seconds) = (Time::from_secs(1.0), 200_001);
        let (mut out, mut starts, mut was, mut n) = (0, 0, false, 0);
        trial.run(move |bee, sensor: Reader| {
            let is = bee.read(sensor).is_none();
            out += u32::from(is);
            starts += u32::from(is && !was);
            was = is;
            n += 1;
            if n == 200_000 {
                let share = f64::from(out) / 2e5;
                assert!((share - 0.2).abs() < 0.02, "{share}");
                // Those that begin and end between two readings are not seen.
                let length = f64::from(out) / f64::from(starts);
                assert!((length - 20.6).abs() < 2.0, "{length} s");
            }
        });
    }

    #[test]
    fn under_a_roof_there_is_no_fix() {
        let mut trial = Trial::of("gnss", &[("min_sky", "0.5")]);
        trial.world = World {
            obstacles: vec![block([0.0, 0.0, 15.0], [60.0, 60.0, 1.0])],
            ..World::default()
        };
        trial.run(|bee, sensor: Reader| {
            assert_eq!(bee.read(sensor), None);
            bee.set_position(Position::from_xyz(0.0, 0.0, 20.0));
            assert!(bee.read(sensor).is_some());
            // Beside the roof a quarter of the sky and a little more is covered.
            bee.set_position(Position::from_xyz(34.0, 0.0, 10.0));
            assert!(bee.read(sensor).is_some());
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, text) in [
            ("horizontal_sigma", "-1 m"),
            ("vertical_sigma", "-1 m"),
            ("correlation_time", "0 s"),
            ("white_sigma", "-1 m"),
            ("velocity_sigma", "-1 m/s"),
            ("outage_time", "-1 s"),
            ("fix_time", "0 s"),
            ("min_sky", "1.1"),
            ("sky_range", "0 m"),
        ] {
            let refusal = refusal("gnss", &[(key, text)]).expect("it is refused");
            assert!(refusal.contains(key), "{refusal}");
        }
    }
}

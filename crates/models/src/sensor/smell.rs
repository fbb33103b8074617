//! A gas sensor.

use super::bounds::{at_least_zero, positive, step};
use super::noise::{Channel, Errors};
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::{SimTime, Stream};
use simbeeotic_model::units::text::did_you_mean;
use simbeeotic_model::units::{Concentration, Time, math};
use simbeeotic_model::world::ScalarField;
use simbeeotic_model::world::World;
use simbeeotic_model::{BuildError, Sensor, Truth, params, sensor};
use std::collections::BTreeSet;

/// Measures the concentration of one gas of the world where it sits.
///
/// ```text
/// dy/dt = (c - y) / T                                                              (1)
/// r     = (1 + s) y + q y n + sigma n'                                             (2)
/// ```
/// `c` is the concentration: real sensors follow it with a time constant `T` (seconds for metal oxide).
/// Between readings `c` counts as what it is at the later one. `s` is drawn once; `n` and `n'` are
/// N(0, 1) anew. Readings are 0 or more. Of a gas that nothing gives off it reads nothing.
#[sensor("smell")]
pub struct Smell {
    params: SmellParams,
    channel: Channel,
    /// What it has followed to, and when.
    follows: Option<(f64, SimTime)>,
}

/// Parameters of [`Smell`].
#[params]
pub struct SmellParams {
    /// The gas: the name of a `[[source]]` of the world. It must be there, unless the world has no source.
    pub gas: String,
    /// Time constant with which it follows, 0 or more.
    pub response_time: Time,
    /// Standard deviation of the white noise of each reading.
    pub sigma: Concentration,
    /// Standard deviation of the noise as a fraction of the reading, 0 to 1.
    pub relative_sigma: f64,
    /// Standard deviation of the scale factor's error, a fraction, drawn once for each sensor.
    pub scale_sigma: f64,
    /// Less than this reads as none.
    pub threshold: Concentration,
    /// The most that it reads. Above 0.
    pub range: Concentration,
    /// Readings are multiples of this; 0 kg/m^3: they are not.
    pub resolution: Concentration,
}

impl Default for SmellParams {
    fn default() -> Self {
        Self {
            gas: "gas".to_owned(),
            response_time: Time::ZERO,
            sigma: Concentration::ZERO,
            relative_sigma: 0.05,
            scale_sigma: 0.0,
            threshold: Concentration::ZERO,
            range: Concentration::si(1.0),
            resolution: Concentration::ZERO,
        }
    }
}

impl Sensor for Smell {
    type Params = SmellParams;
    type Reading = Concentration;

    fn build(params: SmellParams) -> Result<Self, BuildError> {
        if params.gas.trim().is_empty() {
            return Err(BuildError::parameter("gas", "must be the name of a gas"));
        }
        at_least_zero("response_time", params.response_time)?;
        at_least_zero("sigma", params.sigma)?;
        in_range("relative_sigma", params.relative_sigma, 0.0..=1.0)?;
        in_range("scale_sigma", params.scale_sigma, 0.0..=1.0)?;
        at_least_zero("threshold", params.threshold)?;
        positive("range", params.range)?;
        step("resolution", params.resolution)?;
        let channel = Channel::new(Errors {
            sigma: params.sigma.get(),
            scale_sigma: params.scale_sigma,
            limit: params.range.get(),
            step: params.resolution.get(),
            ..Errors::default()
        });
        Ok(Self {
            params,
            channel,
            follows: None,
        })
    }

    fn look_up(&mut self, world: &World) -> Result<(), BuildError> {
        let gas = &*self.params.gas;
        let known: BTreeSet<&str> = world.sources.iter().map(|source| &*source.gas).collect();
        if known.is_empty() || known.contains(gas) {
            return Ok(());
        }
        let guess = did_you_mean(gas, known.iter().copied());
        let guess = guess.map(|guess| format!("; did you mean `{guess}`?"));
        let known: Vec<&str> = known.into_iter().collect();
        let (known, guess) = (known.join(", "), guess.unwrap_or_default());
        let message = format!("is `{gas}`, which no source of the world gives off: {known}{guess}");
        Err(BuildError::parameter("gas", message))
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Concentration {
        let at = truth.sensor_pose().position;
        truth.gas(&self.params.gas).value(at, truth.now())
    }

    fn measure(
        &mut self,
        ideal: Concentration,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Concentration {
        let (now, wanted) = (truth.now(), ideal.get());
        let lag = self.params.response_time.get();
        let reached = match self.follows {
            Some((last, when)) if lag > 0.0 => {
                let dt = now.nanos().saturating_sub(when.nanos()) as f64 * 1e-9;
                last + (wanted - last) * -math::exp_m1(-dt / lag)
            }
            // It was in clean air before, if it lags at all.
            None if lag > 0.0 => wanted * -math::exp_m1(-now.as_secs_f64() / lag),
            _ => wanted,
        };
        self.follows = Some((reached, now));
        let mut noisy = reached;
        if self.params.relative_sigma > 0.0 {
            noisy *= 1.0 + self.params.relative_sigma * rng.normal();
        }
        let read = Concentration::si(self.channel.read(noisy, now, rng).max(0.0));
        if read < self.params.threshold {
            Concentration::ZERO
        } else {
            read
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use crate::weather::constant::{ConstantWeather, ConstantWeatherParams};
    use simbeeotic_model::units::{
        Angle, Attitude, MassRate, Mount, Offset, Position, Velocity, Yaw,
    };
    use simbeeotic_model::world::{Puffs, Source};
    use simbeeotic_model::{FromParams, Handle};
    use std::sync::Arc;

    type Reader = Handle<Concentration>;

    /// 10 m west of the bee and as high, in a wind of 2 m/s from there.
    fn trial(params: &[(&'static str, &str)], puffs: Option<Puffs>) -> Trial {
        let mut trial = Trial::of("smell", params);
        trial.world.sources = vec![Source {
            gas: "ethanol".into(),
            position: Position::from_xyz(-10.0, 0.0, 10.05),
            rate: MassRate::from_grams_per_second(1.0),
            puffs,
            ..Source::default()
        }];
        let wind = Velocity::from_xyz(2.0, 0.0, 0.0);
        let weather = ConstantWeather::from_params(ConstantWeatherParams { wind });
        trial.weather = Arc::new(weather.expect("good numbers"));
        trial.first = Time::from_secs(30.0);
        trial.seconds = 31;
        trial
    }

    /// `Q / (2 pi u sy sz) exp(-y^2 / 2 sy^2)`; the ground is ten metres below.
    fn plume(x: f64, y: f64) -> f64 {
        let sy2 = 0.01 + 0.0064 * x * x / (1.0 + 1e-4 * x);
        let sz2 = 0.01 + 0.0036 * x * x / (1.0 + 1.5e-3 * x);
        1e-3 / (std::f64::consts::TAU * 2.0 * (sy2 * sz2).sqrt()) * math::exp(-0.5 * y * y / sy2)
    }

    #[test]
    fn a_gas_that_no_source_gives_off_is_refused_if_there_are_sources() {
        let of = |gas: &str| {
            Smell::build(SmellParams {
                gas: gas.into(),
                ..SmellParams::default()
            })
        };
        let world = trial(&[("gas", "ethanol")], None).world;
        let look = |gas: &str, world: &World| of(gas).expect("a name").look_up(world);
        assert!(look("ethanol", &world).is_ok());
        assert!(look("ethanoll", &World::default()).is_ok());
        let fault = look("ethanoll", &world).expect_err("mistyped").to_string();
        assert!(fault.contains("did you mean `ethanol`"), "{fault}");
        assert!(look("methane", &world).is_err());
    }

    #[test]
    fn it_reads_the_plume_where_it_sits_in_any_attitude_and_in_motion() {
        let params = [("gas", "ethanol"), ("relative_sigma", "0")];
        let mut trial = trial(&params, None);
        trial.mount = Mount::new(Offset::from_xyz(0.5, 0.0, 0.0), Attitude::IDENTITY);
        trial.run(|bee, sensor: Reader| {
            bee.set_velocity(Velocity::from_xyz(0.7, 0.2, 0.0));
            let (e, n) = (bee.position().east().get(), bee.position().north().get());
            for (degrees, x, y) in [(0.0, 0.5, 0.0), (90.0, 0.0, 0.5), (180.0, -0.5, 0.0)] {
                bee.set_attitude(Attitude::from_yaw(Yaw::new(Angle::from_degrees(degrees))));
                let found = bee.read(sensor).get();
                let wanted = plume(10.0 + e + x, n + y);
                assert!(
                    (found / wanted - 1.0).abs() < 1e-9,
                    "{degrees}: {found}, {wanted}"
                );
            }
        });
    }

    #[test]
    fn puffs_come_by_as_the_plume_they_are() {
        let params = [("gas", "ethanol"), ("relative_sigma", "0")];
        let puffs = Puffs {
            interval: Time::si(0.05),
            life: Time::si(20.0),
            meander: false,
        };
        trial(&params, Some(puffs)).run(|bee, sensor: Reader| {
            let found = bee.read(sensor).get();
            assert!((found / plume(10.0, 0.0) - 1.0).abs() < 0.05, "{found}");
        });
    }

    #[test]
    fn it_follows_with_its_time_constant() {
        let params = [
            ("gas", "ethanol"),
            ("relative_sigma", "0"),
            ("response_time", "2 s"),
        ];
        let mut trial = trial(&params, None);
        (trial.first, trial.seconds) = (Time::from_secs(4.0), 8);
        trial.run(|bee, sensor: Reader| {
            let since = bee.now().as_secs_f64() - 4.0;
            let found = bee.read(sensor).get() / plume(10.0, 0.0);
            // From 5 s on: 1 - exp(-t / T), the plume counting from the reading before.
            let wanted = if since < 1.0 {
                0.0
            } else {
                1.0 - math::exp(-since / 2.0)
            };
            assert!(
                (found - wanted).abs() < 1e-9,
                "{since} s: {found}, {wanted}"
            );
        });
    }

    #[test]
    fn its_noise_grows_with_the_reading_and_its_range_ends() {
        let params = [
            ("gas", "ethanol"),
            ("sigma", "2 mg/m^3"),
            ("relative_sigma", "0.1"),
        ];
        trial(&params, None).run(|bee, sensor: Reader| {
            let truth = plume(10.0, 0.0);
            let readings: Vec<f64> = (0..100_000).map(|_| bee.read(sensor).get()).collect();
            let sigma = ((0.1 * truth) * (0.1 * truth) + 4e-12).sqrt();
            assert_normal(&readings, truth, sigma);
        });
        let params = [
            ("gas", "ethanol"),
            ("relative_sigma", "0"),
            ("range", "20 mg/m^3"),
            ("threshold", "5 mg/m^3"),
            ("resolution", "3 mg/m^3"),
        ];
        trial(&params, None).run(|bee, sensor: Reader| {
            let mut read = |x: f64, y: f64| {
                bee.set_position(Position::from_xyz(x - 10.0, y, 10.05));
                bee.read(sensor).milligrams_per_cubic_metre()
            };
            assert!(
                (read(1.0, 0.0) - 18.0).abs() < 1e-9,
                "the last step of 3 within 20 mg/m^3"
            );
            assert_eq!(read(10.0, 2.6), 0.0);
        });
        // Another gas is not there: its source is down the wind.
        let mut smoke = trial(&[("gas", "smoke")], None);
        smoke.world.sources.push(Source {
            gas: "smoke".into(),
            position: Position::from_xyz(100.0, 0.0, 10.05),
            ..smoke.world.sources[0].clone()
        });
        smoke.run(|bee, sensor: Reader| {
            assert_eq!(bee.read(sensor), Concentration::ZERO);
        });
    }

    #[test]
    fn nonsense_is_refused() {
        for (key, value) in [
            ("gas", " "),
            ("response_time", "-1 s"),
            ("sigma", "-1 mg/m^3"),
            ("relative_sigma", "1.5"),
            ("scale_sigma", "-0.5"),
            ("threshold", "-1 kg/m^3"),
            ("range", "0 kg/m^3"),
            ("resolution", "-1 kg/m^3"),
        ] {
            let said = refusal("smell", &[(key, value)]).expect("it is refused");
            assert!(said.contains(key), "{said}");
        }
    }
}

//! A barometer.

use super::bounds::{at_least_zero, positive};
use super::noise::{Channel, Drift, Errors};
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Current, Length, Pressure};
use simbeeotic_model::world::weather::isa;
use simbeeotic_model::{BuildError, Column, Reading, Sensor, Truth, choice, params, sensor};

/// Measures the pressure of the air where it sits, and the altitude that follows from it.
///
/// ```text
/// p = p_air + k rho |w - v|^2 / 2 + b + d(t) + sigma n                             (1)
/// h = 44330.8 m (1 - (p / qnh)^0.190263)                                           (2)
/// ```
/// `w - v` is the air's velocity past the sensor: wind makes pressure at a badly placed opening. `b` is
/// drawn once, `d` walks, `n` is N(0, 1) anew (see `noise`). Readings lie between 300 hPa and
/// 1250 hPa. Equation 2 is the standard atmosphere's; it is as wrong as the day is not standard.
#[sensor("barometer")]
pub struct Barometer {
    channel: Channel,
    qnh: Pressure,
    wind_coefficient: f64,
    current: Current,
}

/// Parameters of [`Barometer`].
#[params]
pub struct BarometerParams {
    /// The device whose data sheet says what is not said here: `bmp581`, `ideal`.
    pub preset: BarometerDevice,
    /// Of the BMP581: how many samples are averaged for a reading: 1, 2, 4, ... 128.
    pub oversampling: u16,
    /// Standard deviation of the white noise of each reading.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sigma: Option<Pressure>,
    /// Standard deviation of the offset that each sensor has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub offset_sigma: Option<Pressure>,
    /// How far the offset walks in a day, one standard deviation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub walk_per_day: Option<Pressure>,
    /// Readings are multiples of this; 0 Pa: they are not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<Pressure>,
    /// How much of the pressure of the air that flows past is added: `k` of equation 1, -2 to 2.
    pub wind_coefficient: f64,
    /// Pressure at sea level that altitudes are reckoned from, 850 to 1100 hPa.
    pub qnh: Pressure,
}

impl Default for BarometerParams {
    fn default() -> Self {
        Self {
            preset: BarometerDevice::Bmp581,
            oversampling: 16,
            sigma: None,
            offset_sigma: None,
            walk_per_day: None,
            resolution: None,
            wind_coefficient: 0.0,
            qnh: isa::PRESSURE,
        }
    }
}

/// A barometer that has a data sheet.
#[choice]
pub enum BarometerDevice {
    /// Without errors.
    Ideal,
    /// Bosch BMP581 (BST-BMP581-DS004): typical absolute accuracy 30 Pa, long term drift 10 Pa a year,
    /// steps of 1/64 Pa, 260 uA at 50 Hz; noise by oversampling from table 9. The sheet was not at
    /// hand; the numbers are those quoted from it. Its offset over temperature (0.5 Pa/K) and its
    /// filter are not modelled.
    Bmp581,
}

/// Noise of the BMP581 by oversampling 1, 2, 4, ... 128, Pa.
const BMP581_SIGMA_PA: [f64; 8] = [0.78, 0.58, 0.41, 0.30, 0.21, 0.15, 0.11, 0.08];
/// What a pressure sensor of this kind can measure, Pa.
const RANGE_PA: (f64, f64) = (30_000.0, 125_000.0);
const DAY_S: f64 = 86_400.0;

/// What a barometer says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AirPressure {
    /// The pressure.
    pub pressure: Pressure,
    /// The altitude above sea level that follows from it.
    pub altitude: Length,
}

impl Reading for AirPressure {
    const COLUMNS: &'static [Column] =
        &[Column::new("pressure", "Pa"), Column::new("altitude", "m")];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.extend([self.pressure.get(), self.altitude.get()]);
    }
}

impl Barometer {
    fn reading(&self, pressure: Pressure) -> AirPressure {
        AirPressure {
            pressure,
            altitude: isa::altitude(pressure, self.qnh),
        }
    }
}

impl Sensor for Barometer {
    type Params = BarometerParams;
    type Reading = AirPressure;

    fn build(params: BarometerParams) -> Result<Self, BuildError> {
        let samples = params.oversampling;
        if !(samples.is_power_of_two() && samples <= 128) {
            let message = format!("must be 1, 2, 4, 8, 16, 32, 64 or 128, and is {samples}");
            return Err(BuildError::parameter("oversampling", message));
        }
        let white = BMP581_SIGMA_PA[samples.trailing_zeros() as usize];
        let (sigma, offset, walk, step, current) = match params.preset {
            BarometerDevice::Ideal => (0.0, 0.0, 0.0, 0.0, 0.0),
            BarometerDevice::Bmp581 => (white, 30.0, 10.0 / 365.25_f64.sqrt(), 1.0 / 64.0, 260e-6),
        };
        let given = |key, value: Option<Pressure>, usual: f64| {
            let value = value.unwrap_or(Pressure::si(usual));
            match key {
                "resolution" => super::bounds::step(key, value)?,
                _ => at_least_zero(key, value)?,
            }
            Ok::<f64, BuildError>(value.get())
        };
        let errors = Errors {
            sigma: given("sigma", params.sigma, sigma)?,
            bias_sigma: given("offset_sigma", params.offset_sigma, offset)?,
            drift: Drift::Walk(given("walk_per_day", params.walk_per_day, walk)? / DAY_S.sqrt()),
            step: given("resolution", params.resolution, step)?,
            ..Errors::default()
        };
        in_range("wind_coefficient", params.wind_coefficient, -2.0..=2.0)?;
        positive("qnh", params.qnh)?;
        let (low, high) = (Pressure::si(85_000.0), Pressure::si(110_000.0));
        in_range("qnh", params.qnh, low..=high)?;
        Ok(Self {
            channel: Channel::new(errors),
            qnh: params.qnh,
            wind_coefficient: params.wind_coefficient,
            current: Current::si(current),
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> AirPressure {
        let at = truth.sensor_pose().position;
        self.reading(truth.weather().pressure(at, truth.now()))
    }

    fn measure(&mut self, ideal: AirPressure, truth: &Truth<'_>, rng: &mut Stream) -> AirPressure {
        let mut pressure = ideal.pressure.get();
        if self.wind_coefficient != 0.0 {
            let (at, now) = (truth.sensor_pose().position, truth.now());
            let past = truth.weather().wind(at, now) - truth.sensor_velocity();
            let speed2 = past.si().length_squared();
            let density = truth.weather().density(at, now).get();
            pressure += 0.5 * self.wind_coefficient * density * speed2;
        }
        let read = self.channel.read(pressure, truth.now(), rng);
        self.reading(Pressure::si(read.clamp(RANGE_PA.0, RANGE_PA.1)))
    }

    fn current(&self) -> Current {
        self.current
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, allan_deviation, assert_normal, refusal};
    use crate::weather::atmosphere::{Atmosphere, AtmosphereParams};
    use simbeeotic_model::units::{Angle, Attitude, Mount, Offset, Velocity, Yaw};
    use simbeeotic_model::world::Weather;
    use simbeeotic_model::{FromParams, Handle};
    use std::sync::Arc;

    type Reader = Handle<AirPressure>;

    /// ISO 2533: 101325 Pa at 0 m, 89874.6 Pa at 1000 m; and back.
    #[test]
    fn it_reads_the_air_where_it_sits_in_any_attitude_and_in_motion() {
        let mut trial = Trial::of("barometer", &[("preset", "ideal")]);
        trial.at = [0.0, 0.0, 999.95];
        trial.mount = Mount::new(Offset::from_xyz(20.0, 0.0, 0.0), Attitude::IDENTITY);
        trial.seconds = 3;
        trial.run(|bee, sensor: Reader| {
            // Its arm of 20 m level, and then straight up. It climbs all the while.
            let up = Attitude::from_rpy(Angle::ZERO, Angle::from_degrees(-90.0), Yaw::EAST);
            for (attitude, higher) in [(Attitude::IDENTITY, 0.0), (up, 20.0)] {
                bee.set_attitude(attitude);
                bee.set_velocity(Velocity::from_xyz(3.0, 0.0, 40.0));
                let height = bee.position().up().get() + higher;
                let read = bee.read(sensor);
                let (_, pressure) = isa::air(Length::si(height), isa::TEMPERATURE, isa::PRESSURE);
                assert!((read.pressure - pressure).get().abs() < 1e-9);
                assert!(
                    (read.altitude.get() - height).abs() < 1e-6,
                    "{}",
                    read.altitude
                );
            }
        });
        let mut trial = Trial::of("barometer", &[("preset", "ideal")]);
        trial.at = [0.0, 0.0, 999.95];
        trial.run(|bee, sensor: Reader| {
            let pressure = bee.read(sensor).pressure.get();
            assert!((pressure - 89_874.6).abs() < 0.5, "{pressure}");
        });
    }

    #[test]
    fn its_noise_is_that_of_the_data_sheet() {
        for (oversampling, sigma) in [("1", 0.78), ("16", 0.21), ("128", 0.08)] {
            let params = [
                ("oversampling", oversampling),
                ("offset_sigma", "0 Pa"),
                ("resolution", "0 Pa"),
            ];
            Trial::of("barometer", &params).run(move |bee, sensor: Reader| {
                let truth = isa::air(bee.position().up(), isa::TEMPERATURE, isa::PRESSURE).1;
                let readings: Vec<f64> = (0..100_000)
                    .map(|_| (bee.read(sensor).pressure - truth).get())
                    .collect();
                assert_normal(&readings, 0.0, sigma);
                let ten = allan_deviation(&readings, 10);
                assert!((ten * 10.0_f64.sqrt() / sigma - 1.0).abs() < 0.05, "{ten}");
            });
        }
        // 0.21 Pa are 1.75 cm near the ground, and steps are 1/64 Pa.
        Trial::of("barometer", &[("offset_sigma", "0 Pa")]).run(|bee, sensor: Reader| {
            let readings: Vec<AirPressure> = (0..100_000).map(|_| bee.read(sensor)).collect();
            let heights: Vec<f64> = readings.iter().map(|r| r.altitude.get()).collect();
            let mean = heights.iter().sum::<f64>() / 1e5;
            let variance = heights.iter().map(|h| (h - mean) * (h - mean)).sum::<f64>() / 1e5;
            assert!(
                (variance.sqrt() - 0.0175).abs() < 3e-4,
                "{}",
                variance.sqrt()
            );
            assert!(
                readings
                    .iter()
                    .all(|r| (r.pressure.get() * 64.0).fract() == 0.0)
            );
        });
    }

    #[test]
    fn wind_past_it_makes_pressure() {
        let params = [("preset", "ideal"), ("wind_coefficient", "-0.5")];
        let mut trial = Trial::of("barometer", &params);
        let wind = AtmosphereParams {
            wind: Some(Velocity::from_xyz(6.0, 0.0, 0.0)),
            ..AtmosphereParams::default()
        };
        let weather = Arc::new(Atmosphere::from_params(wind).expect("good numbers"));
        trial.weather = weather.clone();
        trial.run(move |bee, sensor: Reader| {
            let (at, now) = (bee.position(), bee.now());
            let (still, density) = (weather.pressure(at, now), weather.density(at, now).get());
            for (v, past) in [(0.0, 6.0), (6.0, 0.0), (-4.0, 10.0)] {
                bee.set_velocity(Velocity::from_xyz(v, 0.0, 0.0));
                let found = (bee.read(sensor).pressure - still).get();
                let wanted = -0.25 * density * past * past;
                assert!((found - wanted).abs() < 1e-9, "{v} m/s: {found} Pa");
            }
        });
    }

    #[test]
    fn nonsense_is_refused() {
        for (key, value) in [
            ("sigma", "-1 Pa"),
            ("offset_sigma", "-1 Pa"),
            ("walk_per_day", "-1 Pa"),
            ("resolution", "-1 Pa"),
            ("oversampling", "3"),
            ("oversampling", "0"),
            ("oversampling", "256"),
            ("wind_coefficient", "3.5"),
            ("qnh", "1 Pa"),
            ("preset", "aneroid"),
        ] {
            let said = refusal("barometer", &[(key, value)]).expect("it is refused");
            assert!(said.contains(key) || said.contains(value), "{said}");
        }
    }
}

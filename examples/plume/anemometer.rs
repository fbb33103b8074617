//! A sensor of this example: what the wind is on board.

use simbeeotic::prelude::*;

/// Measures the velocity of the air past its own place, along its own axes: `R^-1 (w - v)` and white noise.
///
/// In still air a vehicle that flies ahead reads a head wind, below zero along its forward axis. The
/// default noise is of the size that makers of small ultrasonic anemometers promise, a few per cent of a
/// few metres per second; it is no particular make's.
#[sensor("anemometer")]
pub struct Anemometer {
    sigma: Speed,
}

/// Parameters of [`Anemometer`].
#[params]
pub struct AnemometerParams {
    /// Standard deviation of the noise on each axis. 0 or more.
    pub sigma: Speed,
}

impl Default for AnemometerParams {
    fn default() -> Self {
        Self {
            sigma: Speed::si(0.1),
        }
    }
}

impl Sensor for Anemometer {
    type Params = AnemometerParams;
    type Reading = Velocity<Flu>;

    fn build(params: AnemometerParams) -> Result<Self, BuildError> {
        at_least_zero("sigma", params.sigma)?;
        Ok(Self {
            sigma: params.sigma,
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Velocity<Flu> {
        let past = truth.wind() - truth.sensor_velocity();
        truth.sensor_pose().attitude.unrotate(past)
    }

    fn measure(
        &mut self,
        ideal: Velocity<Flu>,
        _truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Velocity<Flu> {
        let mut noise = || self.sigma * rng.normal();
        ideal + Velocity::new(noise(), noise(), noise())
    }
}

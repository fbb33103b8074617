//! Scalar fields: a number at each place and time, and which way it grows.
//!
//! [`LightField`] and [`GasField`] are those of a [`World`] in some [`Weather`]. Both are sums over
//! their sources. They are what a perfect sensor reads, and what a search for a source climbs.

use crate::gas::Gases;
use crate::weather::Weather;
use crate::world::World;
use glam::DVec3;
use simbeeotic_kernel::SimTime;
use simbeeotic_units::{Concentration, Illuminance, Position, Quantity};

/// A number at each place and time. Pure: the same place and time give the same number.
pub trait ScalarField {
    /// What the number is.
    type Value: Quantity;

    /// Value and gradient at once. The gradient is in the value's SI unit per metre: east, north, up.
    fn sample(&self, at: Position, time: SimTime) -> (Self::Value, DVec3);

    /// The value.
    fn value(&self, at: Position, time: SimTime) -> Self::Value {
        self.sample(at, time).0
    }

    /// Which way the value grows, and how fast.
    fn gradient(&self, at: Position, time: SimTime) -> DVec3 {
        self.sample(at, time).1
    }
}

/// All light at a place: that of the lamps on a surface that faces each of them, and the daylight on
/// level ground. Nothing throws a shadow.
#[derive(Clone, Copy, Debug)]
pub struct LightField<'a> {
    /// Where the lamps are.
    pub world: &'a World,
    /// Where the daylight comes from. It is even: the gradient is that of the lamps.
    pub weather: &'a dyn Weather,
}

impl ScalarField for LightField<'_> {
    type Value = Illuminance;

    fn sample(&self, at: Position, time: SimTime) -> (Illuminance, DVec3) {
        let mut sum = (self.weather.light(at, time).get(), DVec3::ZERO);
        for lamp in &self.world.lights {
            let (value, slope) = lamp.sample(at.si());
            sum.0 += value;
            sum.1 += slope;
        }
        (Illuminance::si(sum.0), sum.1)
    }
}

/// One gas of a world, from all its sources.
#[derive(Clone, Copy, Debug)]
pub struct GasField<'a> {
    pub(crate) gases: &'a Gases,
    pub(crate) name: &'a str,
}

impl ScalarField for GasField<'_> {
    type Value = Concentration;

    fn sample(&self, at: Position, time: SimTime) -> (Concentration, DVec3) {
        let (value, slope) = self.gases.sample(self.name, at.si(), time);
        (Concentration::si(value), slope)
    }
}

impl World {
    /// All light at a place: see [`LightField`].
    pub fn light_at(&self, at: Position, time: SimTime, weather: &dyn Weather) -> Illuminance {
        let field = LightField {
            world: self,
            weather,
        };
        field.value(at, time)
    }

    /// The concentration of a gas; zero of one that nothing gives off. Puffs are followed from their
    /// release each time: who asks often makes [`Gases`] once.
    pub fn gas_at(
        &self,
        name: &str,
        at: Position,
        time: SimTime,
        weather: &dyn Weather,
    ) -> Concentration {
        let named = self.sources.iter().filter(|source| source.gas == name);
        Concentration::si(
            named
                .map(|source| source.sample(at.si(), time, weather, None).0)
                .sum(),
        )
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Holds a gradient against central differences of the value over a distance `h`.
    pub(crate) fn assert_gradient(f: impl Fn(DVec3) -> (f64, DVec3), at: DVec3, h: f64) {
        let (value, gradient) = f(at);
        for axis in 0..3 {
            let step = DVec3::AXES[axis] * h;
            let slope = (f(at + step).0 - f(at - step).0) / (2.0 * h);
            let size = gradient.length().max(value.abs() * 1e-3);
            assert!(
                (slope - gradient[axis]).abs() <= 1e-6 * size,
                "along axis {axis} at {at}: {} and by differences {slope}",
                gradient[axis]
            );
        }
    }
}

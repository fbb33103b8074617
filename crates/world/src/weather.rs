//! The air: wind, temperature, pressure, density, humidity, light and rain, everywhere and at any
//! time.
//!
//! Without weather the air is that of the standard atmosphere ([`isa`]), at rest, dry and dark.

pub mod isa;
pub mod rain;

use glam::DVec3;
use simbeeotic_kernel::SimTime;
use simbeeotic_units::{
    Density, Enu, Illuminance, Position, Pressure, RainRate, Temperature, Velocity,
};
use std::fmt::Debug;

/// The air as a field over space and time. Pure: the same place and time give the same air.
pub trait Weather: Debug + Send + Sync {
    /// The velocity of the air.
    fn wind(&self, at: Position, time: SimTime) -> Velocity<Enu>;

    /// The wind without turbulence, gusts and vortices: what a plume drifts with. The wind itself
    /// unless the weather says otherwise.
    fn mean_wind(&self, at: Position, time: SimTime) -> Velocity<Enu> {
        self.wind(at, time)
    }

    /// Whether there is no wind, anywhere and ever. `false` promises nothing.
    fn is_calm(&self) -> bool {
        false
    }

    /// The temperature of the air; that of the standard atmosphere unless the weather says
    /// otherwise.
    fn temperature(&self, at: Position, _time: SimTime) -> Temperature {
        isa::air(at.up(), isa::TEMPERATURE, isa::PRESSURE).0
    }

    /// The pressure of the air; that of the standard atmosphere unless the weather says
    /// otherwise.
    fn pressure(&self, at: Position, _time: SimTime) -> Pressure {
        isa::air(at.up(), isa::TEMPERATURE, isa::PRESSURE).1
    }

    /// The density of the air; that of dry air with this weather's temperature and pressure.
    fn density(&self, at: Position, time: SimTime) -> Density {
        isa::density(self.temperature(at, time), self.pressure(at, time))
    }

    /// Relative humidity of the air, 0 to 1; dry unless the weather says otherwise.
    fn humidity(&self, _at: Position, _time: SimTime) -> f64 {
        0.0
    }

    /// Daylight on level ground, from the sun and from all the sky; dark unless the weather says
    /// otherwise.
    fn light(&self, _at: Position, _time: SimTime) -> Illuminance {
        Illuminance::ZERO
    }

    /// What of the daylight comes straight from the sun; none unless the weather says otherwise.
    fn sun(&self, _at: Position, _time: SimTime) -> Option<Sun> {
        None
    }

    /// Rain; dry unless the weather says otherwise. What it does to sensors is in [`rain`].
    fn rain(&self, _at: Position, _time: SimTime) -> RainRate {
        RainRate::ZERO
    }
}

/// Sunlight at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Where it comes from: a unit vector, east, north, up.
    pub toward: DVec3,
    /// What falls on a surface that faces the sun.
    pub illuminance: Illuminance,
}

/// No wind, standard atmosphere.
#[derive(Clone, Copy, Debug, Default)]
pub struct Calm;

impl Weather for Calm {
    fn wind(&self, _at: Position, _time: SimTime) -> Velocity<Enu> {
        Velocity::ZERO
    }

    fn is_calm(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_units::Length;

    /// Rows of ISO 2533, table 1: height, temperature, pressure, density.
    #[test]
    fn the_standard_atmosphere_is_that_of_the_tables() {
        let rows = [
            (0.0, 288.15, 101_325.0, 1.225),
            (1_000.0, 281.65, 89_874.6, 1.111_64),
            (5_000.0, 255.65, 54_019.9, 0.736_116),
            (11_000.0, 216.65, 22_632.1, 0.363_918),
            (15_000.0, 216.65, 12_044.6, 0.193_674),
        ];
        for (h, kelvin, pascal, density) in rows {
            let at = Position::new(Length::ZERO, Length::ZERO, Length::si(h));
            let time = SimTime::ZERO;
            assert!(
                (Calm.temperature(at, time).get() - kelvin).abs() < 1e-9,
                "{h}"
            );
            assert!(
                (Calm.pressure(at, time).get() / pascal - 1.0).abs() < 1e-5,
                "{h}"
            );
            assert!(
                (Calm.density(at, time).get() / density - 1.0).abs() < 1e-5,
                "{h}"
            );
        }
    }
}

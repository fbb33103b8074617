//! Constants of nature and of convention.

use crate::{Acceleration, Density, Pressure, Speed, Temperature};

/// The speed of light in vacuum, exact by definition of the metre (BIPM, SI brochure, 9th ed.).
pub const SPEED_OF_LIGHT: Speed = Speed::si(299_792_458.0);

/// Standard acceleration of free fall, 9.80665 m/s² (3rd CGPM, 1901), downwards.
///
/// The original Simbeeotic falls with 9.81 m/s²: its worlds are read with that number.
pub const STANDARD_GRAVITY: Acceleration = Acceleration::si(9.80665);

/// Air density at sea level in the standard atmosphere (ISO 2533:1975).
pub const AIR_DENSITY: Density = Density::si(1.225);

/// Air pressure at sea level in the standard atmosphere (ISO 2533:1975).
pub const AIR_PRESSURE: Pressure = Pressure::si(101_325.0);

/// Air temperature at sea level in the standard atmosphere, 15 °C (ISO 2533:1975).
pub const AIR_TEMPERATURE: Temperature = Temperature::si(288.15);

/// The Boltzmann constant in joules per kelvin, exact by definition of the kelvin.
pub const BOLTZMANN_J_PER_K: f64 = 1.380_649e-23;

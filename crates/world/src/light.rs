//! Lamps.
//!
//! ```text
//! E = I b / (d^2 + a^2)                                                            (1)
//! b = 1,  or of a beam  cos(theta)^m,  m = -ln 2 / ln cos(theta_half)              (2)
//! ```
//! on a surface that faces the lamp at the distance `d`: the inverse square of a lamp of the radius
//! `a`, as on the axis of an even disc of this radius, which is finite at the lamp itself. A beam is a
//! generalised Lambertian emitter, whose intensity has fallen to one half at `theta_half` from its axis
//! (what datasheets of LEDs call half the viewing angle): J. Kahn and J. Barry, *Wireless Infrared
//! Communications*, Proc. IEEE 85(2), 265 (1997), eq. 10. 60 degrees is Lambert's cosine. Nothing goes
//! backwards.

use crate::look::Color;
use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_units::{Angle, Illuminance, Length, LuminousIntensity, Position, math};

/// A lamp.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Light {
    /// Where it is.
    pub position: Position,
    /// Its luminous intensity, in the middle of the beam if it has one: 0 or more. A lamp of 1250
    /// lumens that shines to all sides has 100 cd.
    pub intensity: LuminousIntensity,
    /// Its radius, above 0; 5 cm unless said.
    pub radius: Length,
    /// Its beam. Without one it shines to all sides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beam: Option<Beam>,
    /// Its colour, for pictures.
    pub color: Color,
    /// What it is called; empty for nothing.
    pub label: String,
}

/// Where a lamp shines.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Beam {
    /// The beam's axis: east, north, up, of any length but 0.
    pub direction: [f64; 3],
    /// The angle from the axis at which half of the intensity is left: 0.1 to 60 degrees.
    pub half_angle: Angle,
}

impl Default for Light {
    fn default() -> Self {
        Self {
            position: Position::ZERO,
            intensity: LuminousIntensity::si(100.0),
            radius: Length::si(0.05),
            beam: None,
            color: Color::rgb(255, 244, 214),
            label: String::new(),
        }
    }
}

/// A narrower beam has no exponent that numbers hold.
const NARROWEST_DEG: f64 = 0.1;

impl Light {
    /// What falls on a surface at a place that faces the lamp.
    pub fn illuminance(&self, at: Position) -> Illuminance {
        Illuminance::si(self.sample(at.si()).0)
    }

    /// Equation 1 in lux, and its gradient in lux per metre.
    pub(crate) fn sample(&self, at: DVec3) -> (f64, DVec3) {
        let r = at - self.position.si();
        let (d2, a) = (r.length_squared(), self.radius.get());
        let per = 1.0 / (d2 + a * a);
        let full = self.intensity.get() * per;
        let fall = r * (-2.0 * full * per);
        let Some(beam) = &self.beam else {
            return (full, fall);
        };
        let axis = DVec3::from_array(beam.direction).normalize_or_zero();
        let d = d2.sqrt();
        if d == 0.0 {
            return (full, DVec3::ZERO);
        }
        let cos = axis.dot(r) / d;
        if cos <= 0.0 {
            return (0.0, DVec3::ZERO);
        }
        let m = -std::f64::consts::LN_2 / math::ln(beam.half_angle.cos());
        let share = math::pow(cos, m);
        let turn = (axis - r * (cos / d)) * (m * share / (cos * d));
        (full * share, fall * share + turn * full)
    }

    /// What cannot be: key and reason.
    pub(crate) fn faults(&self) -> Vec<(&'static str, String)> {
        let mut faults = Vec::new();
        let intensity = self.intensity;
        if !(intensity >= LuminousIntensity::ZERO && intensity.is_finite()) {
            let message = format!("`intensity` must be 0 cd or more, not {intensity}");
            faults.push(("intensity", message));
        }
        if let Some(beam) = &self.beam {
            let direction = DVec3::from_array(beam.direction);
            if !(direction.is_finite() && direction.length() > 0.0) {
                let message = format!("{:?} has no direction", beam.direction);
                faults.push(("beam.direction", message));
            }
            let degrees = beam.half_angle.degrees();
            // A little more than 60 is what 60 degrees may be in radians.
            if !(NARROWEST_DEG..=60.0 + 1e-9).contains(&degrees) {
                let message = format!(
                    "a half angle lies between {NARROWEST_DEG} deg and 60 deg, not at {degrees:.4} deg"
                );
                faults.push(("beam.half_angle", message));
            }
        }
        faults
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::tests::assert_gradient;
    use crate::weather::{Calm, Weather};
    use crate::{LightField, ScalarField, World};
    use simbeeotic_kernel::SimTime;
    use simbeeotic_units::{Enu, Velocity};

    fn lamp(beam: Option<Beam>) -> Light {
        Light {
            position: Position::from_xyz(1.0, 2.0, 3.0),
            intensity: LuminousIntensity::si(80.0),
            beam,
            ..Light::default()
        }
    }

    #[test]
    fn light_falls_with_the_square_of_the_distance_and_is_finite_at_the_lamp() {
        let lux = |d: f64| {
            lamp(None)
                .illuminance(Position::from_xyz(1.0, 2.0, 3.0 - d))
                .get()
        };
        assert!((lux(2.0) - 80.0 / 4.002_5).abs() < 1e-12);
        assert!((lux(20.0) / lux(40.0) - 4.0).abs() < 1e-4);
        assert!((lux(0.0) - 80.0 / 0.002_5).abs() < 1e-9);
    }

    #[test]
    fn half_of_the_intensity_is_left_at_the_half_angle_and_none_behind() {
        for half in [5.0, 30.0, 60.0] {
            let beam = Beam {
                direction: [0.0, 0.0, -3.0],
                half_angle: Angle::from_degrees(half),
            };
            let lamp = lamp(Some(beam));
            let at = |degrees: f64| {
                let (s, c) = Angle::from_degrees(degrees).sin_cos();
                let place = Position::from_xyz(1.0 + 4.0 * s, 2.0, 3.0 - 4.0 * c);
                lamp.illuminance(place).get()
            };
            assert!((at(half) / at(0.0) - 0.5).abs() < 1e-12, "{half}");
            assert_eq!((at(90.1), at(180.0)), (0.0, 0.0));
        }
        // Lambert: at 60 degrees, the cosine.
        let beam = Beam {
            direction: [1.0, 0.0, 0.0],
            half_angle: Angle::from_degrees(60.0),
        };
        let straight = lamp(Some(beam)).illuminance(Position::from_xyz(6.0, 2.0, 3.0));
        let aside = lamp(Some(beam)).illuminance(Position::from_xyz(5.0, 5.0, 3.0));
        assert!((aside / straight - 0.8).abs() < 1e-12);
    }

    #[test]
    fn the_gradient_is_that_of_the_value() {
        let beam = Beam {
            direction: [1.0, -1.0, -0.5],
            half_angle: Angle::from_degrees(25.0),
        };
        for lamp in [lamp(None), lamp(Some(beam))] {
            for at in [
                DVec3::new(2.0, 1.5, 2.0),
                DVec3::new(4.0, -1.5, 2.5),
                DVec3::new(1.02, 1.98, 2.99),
            ] {
                assert_gradient(|p| lamp.sample(p), at, 1e-5);
            }
        }
    }

    #[test]
    fn lamps_add_up_to_each_other_and_to_the_daylight() {
        #[derive(Debug)]
        struct Dusk;
        impl Weather for Dusk {
            fn wind(&self, _: Position, _: SimTime) -> Velocity<Enu> {
                Velocity::ZERO
            }
            fn light(&self, _: Position, _: SimTime) -> Illuminance {
                Illuminance::si(7.0)
            }
        }
        let other = Light {
            position: Position::from_xyz(-5.0, 0.0, 1.0),
            ..lamp(None)
        };
        let world = World {
            lights: vec![lamp(None), other.clone()],
            ..World::default()
        };
        let at = Position::from_xyz(0.0, 0.0, 0.5);
        let lamps = lamp(None).illuminance(at) + other.illuminance(at);
        assert_eq!(world.light_at(at, SimTime::ZERO, &Calm), lamps);
        let dusk = world.light_at(at, SimTime::ZERO, &Dusk);
        assert!((dusk - lamps).get() - 7.0 < 1e-12);
        let field = LightField {
            world: &world,
            weather: &Dusk,
        };
        assert_gradient(
            |p| {
                let (value, slope) = field.sample(Position::from_si(p), SimTime::ZERO);
                (value.get(), slope)
            },
            at.si(),
            1e-5,
        );
    }

    #[test]
    fn nonsense_is_named() {
        let beam = |direction, degrees| Beam {
            direction,
            half_angle: Angle::from_degrees(degrees),
        };
        let up = [0.0, 0.0, 1.0];
        let bad = |intensity, beam| Light {
            intensity: LuminousIntensity::si(intensity),
            beam,
            ..Light::default()
        };
        let keys = |light: Light| {
            light
                .faults()
                .into_iter()
                .map(|(key, _)| key)
                .collect::<Vec<_>>()
        };
        assert_eq!(keys(bad(-1.0, None)), ["intensity"]);
        assert_eq!(
            keys(bad(f64::NAN, Some(beam([0.0; 3], 0.0)))),
            ["intensity", "beam.direction", "beam.half_angle"]
        );
        assert_eq!(keys(bad(1.0, Some(beam(up, 61.0)))), ["beam.half_angle"]);
        assert_eq!(keys(bad(1.0, Some(beam(up, 1e-7)))), ["beam.half_angle"]);
        assert!(keys(bad(0.0, Some(beam(up, 60.0)))).is_empty());
    }
}

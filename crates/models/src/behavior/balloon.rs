//! A balloon that drifts with the wind.

use crate::aerodynamics::{Drag, gravity};
use simbeeotic_model::check::{in_range, positive};
use simbeeotic_model::host::{Platform, Station};
use simbeeotic_model::physics::{BodySpec, Shape, limits};
use simbeeotic_model::units::glam::DVec3;
use simbeeotic_model::units::{Accel, ForceVec, Length, Mass, Time};
use simbeeotic_model::{Behavior, BuildError, Kit, behavior, params};

/// A ball that the air carries: it drifts with the wind, rises where it is lighter than the air it
/// displaces, and falls where it is heavier. It can carry sensors and radios.
///
/// Each `period` it sets drag (see [`crate::aerodynamics`]) and buoyancy, `rho V g`, for the air where it
/// is then. The air that it must push aside to speed up (added mass) is not counted: a real balloon
/// follows gusts more slowly.
#[behavior("balloon", host = Station)]
pub struct Balloon {
    params: BalloonParams,
    drag: Drag,
}

/// Parameters of [`Balloon`].
#[params]
pub struct BalloonParams {
    /// Across.
    pub diameter: Length,
    /// Mass of everything, the gas inside too. A ball of 30 cm floats at sea level with 17.3 g.
    pub mass: Mass,
    /// Drag coefficient; 0.47 is a smooth sphere's.
    pub drag_coefficient: f64,
    /// Whether the air carries it up, by the air's weight in its place.
    pub buoyant: bool,
    /// Time between two looks at the wind.
    pub period: Time,
}

impl Default for BalloonParams {
    fn default() -> Self {
        Self {
            diameter: Length::si(0.3),
            mass: Mass::from_grams(17.3),
            drag_coefficient: 0.47,
            buoyant: true,
            period: Time::from_millis(100.0),
        }
    }
}

impl Behavior<Station> for Balloon {
    type Params = BalloonParams;

    fn build(params: BalloonParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        positive("diameter", params.diameter)?;
        let longest = Length::si(2.0 * limits::EXTENT_M_MAX);
        in_range("diameter", params.diameter, Length::ZERO..=longest)?;
        let (lightest, heaviest) = limits::MASS_KG_RANGE;
        in_range("mass", params.mass, Mass::si(lightest)..=Mass::si(heaviest))?;
        positive("period", params.period)?;
        let drag = Drag::of_disc(params.drag_coefficient, params.diameter);
        drag.check()?;
        kit.every(params.period, Self::drift);
        Ok(Self { params, drag })
    }

    fn body(params: &BalloonParams) -> Option<BodySpec> {
        let radius_m = 0.5 * params.diameter.get();
        Some(BodySpec {
            p_enu: DVec3::new(0.0, 0.0, radius_m),
            ..BodySpec::new(Shape::Sphere { radius_m }, params.mass.get())
        })
    }
}

impl Balloon {
    fn drift(&mut self, balloon: &mut Platform<'_>) {
        let BalloonParams { mass, period, .. } = self.params;
        let mut lift = DVec3::ZERO;
        if self.params.buoyant {
            let d = self.params.diameter.get();
            let volume = std::f64::consts::PI / 6.0 * d * d * d;
            lift.z = balloon.air_density().get() * volume * balloon.gravity().get();
        }
        let other = Accel::from_si(gravity(balloon).si() + lift / mass.get());
        let drag = self.drag.on(balloon, mass, other, period);
        balloon.set_force(drag + ForceVec::from_si(lift));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{bee, setup};
    use crate::weather::atmosphere::{Atmosphere, AtmosphereParams};
    use simbeeotic_model::kernel::SimTime;
    use simbeeotic_model::units::Velocity;
    use simbeeotic_model::{FromParams, Setup, Simulation};
    use std::sync::Arc;

    fn drift(params: &[(&str, &str)], up: f64, wind: DVec3, seconds: u64) -> DVec3 {
        let weather = Atmosphere::from_params(AtmosphereParams {
            wind: Some(Velocity::from_si(wind)),
            ..AtmosphereParams::default()
        });
        let setup = Setup {
            weather: Arc::new(weather.expect("good numbers")),
            ..setup(
                vec![bee("balloon", "balloon", params, [0.0, 0.0, up])],
                seconds,
            )
        };
        let mut run = Simulation::new(setup).expect("it can be put together");
        run.run_until(SimTime::from_secs(seconds)).expect("it runs");
        run.twist("balloon").expect("a body").linear.si()
    }

    /// `v = w (1 - 1 / (1 + k w t))`, `k = rho C_d A / 2 m`.
    #[test]
    fn it_takes_up_the_wind_by_the_closed_form() {
        for seconds in [1_u64, 2, 5] {
            let v = drift(&[], 10.0, DVec3::new(4.0, 3.0, 0.0), seconds);
            let area = std::f64::consts::PI * 0.15 * 0.15;
            let k = 0.5 * 1.2237 * 0.47 * area / 0.0173;
            let wanted = 5.0 * (1.0 - 1.0 / (1.0 + k * 5.0 * seconds as f64));
            let level = (v.x * v.x + v.y * v.y).sqrt();
            // It rises or sinks a little: what floats exactly is one height.
            assert!(
                (level / wanted - 1.0).abs() < 0.01,
                "{seconds} s: {v}, {wanted}"
            );
            assert!((v.y / v.x - 0.75).abs() < 1e-9 && v.z.abs() < 0.3, "{v}");
        }
    }

    #[test]
    fn a_heavy_one_falls_and_a_light_one_rises_at_terminal_speed() {
        let area = std::f64::consts::PI * 0.15 * 0.15;
        let volume = std::f64::consts::PI / 6.0 * 0.027;
        for (mass, kilograms) in [("60 g", 0.06), ("5 g", 0.005)] {
            let v = drift(&[("mass", mass)], 500.0, DVec3::ZERO, 6);
            let density = 1.166; // at about 500 m
            let weight = 9.81 * (kilograms - density * volume);
            let terminal = (2.0 * weight.abs() / (density * 0.47 * area)).sqrt();
            assert!(
                (v.z.abs() / terminal - 1.0).abs() < 0.02,
                "{mass}: {v}, {terminal}"
            );
            assert_eq!(v.z < 0.0, weight > 0.0);
        }
    }
}

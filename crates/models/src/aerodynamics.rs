//! Drag: the force of the air on what moves through it.
//!
//! ```text
//! F = rho C_d A |u| u / 2,    u = w - v                                            (1)
//! ```
//! `w` is the wind, `v` the body's velocity: still air brakes, wind pushes, and a body that drifts with the
//! wind feels nothing. `A` is the area that the air meets, `rho` the density of the air at the body's
//! height.
//!
//! A force holds until it is set again. Between two steps `dt` apart equation 1 changes; a body much
//! lighter than the air it meets would be thrown back and forth. So a step takes the mean force over
//! it, to second order:
//!
//! ```text
//! du = (a + F / m) dt / (1 + k |u| dt),   k = rho C_d A / 2 m                      (2)
//! F_mean = m (du / dt - a)
//! ```
//! `a` is what else pulls, per mass; across the flow `k` counts half. With nothing else along a steady
//! wind this is the closed form itself at each step, `u(t) = u0 / (1 + k u0 t)`; at terminal speed, where
//! nothing changes, it is equation 1. Any step is stable.

use glam::DVec3;
use simbeeotic_model::BuildError;
use simbeeotic_model::check::{at_least_zero, in_range};
use simbeeotic_model::host::Entity;
use simbeeotic_model::units::{Accel, Area, Density, Enu, ForceVec, Length, Mass, Time, Velocity};

/// How a body meets the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// The drag coefficient, 0 or more. A smooth sphere at Reynolds numbers of 1e4 has 0.47 (S.
    /// Hoerner, *Fluid-Dynamic Drag*, 1965, ch. 3).
    pub coefficient: f64,
    /// The area that the air meets, 0 or more.
    pub area: Area,
}

impl Drag {
    /// The drag of a body as wide as a disc of this diameter.
    pub fn of_disc(coefficient: f64, diameter: Length) -> Self {
        let radius = 0.5 * diameter.get();
        Self {
            coefficient,
            area: Area::si(std::f64::consts::PI * radius * radius),
        }
    }

    /// Refuses what cannot be: a coefficient that is not 0 to 100, an area below 0.
    ///
    /// # Errors
    /// Either; the error points at `drag_coefficient` or `area`.
    pub fn check(&self) -> Result<(), BuildError> {
        in_range("drag_coefficient", self.coefficient, 0.0..=100.0)?;
        at_least_zero("area", self.area)
    }

    /// The force now: equation 1. `past` is the velocity of the air past the body, `w - v`.
    pub fn force(&self, past: Velocity<Enu>, density: Density) -> ForceVec<Enu> {
        let u = past.si();
        let area = self.area.get();
        ForceVec::from_si(u * (0.5 * density.get() * self.coefficient * area * u.length()))
    }

    /// The mean force over a step: equation 2. `other` is what else pulls the body, per mass: gravity,
    /// thrust. A step of zero gives the force now.
    pub fn mean_force(
        &self,
        past: Velocity<Enu>,
        density: Density,
        mass: Mass,
        other: Accel<Enu>,
        step: Time,
    ) -> ForceVec<Enu> {
        let now = self.force(past, density);
        let (m, dt, a) = (mass.get(), step.get(), other.si());
        let speed = past.si().length();
        if !(speed > 0.0 && dt > 0.0 && m > 0.0) {
            return now;
        }
        let along = past.si() / speed;
        let k = 0.5 * density.get() * self.coefficient * self.area.get() / m;
        // What the air does to the relative velocity, F / m, and what else does.
        let whole = a + now.si() / m;
        let straight = along * whole.dot(along);
        let across = whole - straight;
        let kept = k * speed * dt;
        let change = straight / (1.0 + kept) + across / (1.0 + 0.5 * kept);
        ForceVec::from_si((change - a) * m)
    }

    /// The mean force of the weather on a body over the next step: equation 2 with the wind and the air
    /// where it is.
    pub fn on(
        &self,
        body: &Entity<'_>,
        mass: Mass,
        other: Accel<Enu>,
        step: Time,
    ) -> ForceVec<Enu> {
        let past = body.wind() - body.velocity();
        self.mean_force(past, body.air_density(), mass, other, step)
    }
}

/// The weight of a body as an acceleration.
pub fn gravity(body: &Entity<'_>) -> Accel<Enu> {
    Accel::from_si(DVec3::new(0.0, 0.0, -body.gravity().get()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_model::units::math;

    const RHO: Density = Density::si(1.2);

    fn ball() -> Drag {
        Drag::of_disc(0.47, Length::si(0.2))
    }

    fn k(mass: f64) -> f64 {
        0.5 * 1.2 * 0.47 * std::f64::consts::PI * 0.01 / mass
    }

    /// Steps a body of one velocity in a wind, and gives the velocity.
    fn fly(v0: DVec3, wind: DVec3, mass: f64, a: DVec3, dt: f64, steps: u32) -> DVec3 {
        (0..steps).fold(v0, |v, _| {
            let past = Velocity::from_si(wind - v);
            let step = Time::si(dt);
            let force = ball().mean_force(past, RHO, Mass::si(mass), Accel::from_si(a), step);
            v + (force.si() / mass + a) * dt
        })
    }

    #[test]
    fn the_force_is_the_textbook_formula_and_needs_relative_wind() {
        let past = Velocity::from_xyz(3.0, 0.0, -4.0);
        let force = ball().force(past, RHO).si();
        // 0.5 x 1.2 x 0.47 x 0.0314159 x 25 = 0.221482 N.
        assert!((force.length() - 0.221_482).abs() < 1e-6, "{force}");
        assert!((force.normalize() - DVec3::new(0.6, 0.0, -0.8)).length() < 1e-12);
        assert_eq!(ball().force(Velocity::ZERO, RHO), ForceVec::ZERO);
    }

    #[test]
    fn a_body_released_in_a_wind_takes_it_up_by_the_closed_form_at_any_step() {
        let wind = DVec3::new(8.0, 0.0, 0.0);
        for (mass, dt, steps) in [
            (0.1, 0.1, 50),
            (0.1, 1.0, 5),
            (0.001, 0.5, 10),
            (0.02, 5.0, 1),
        ] {
            let v = fly(DVec3::ZERO, wind, mass, DVec3::ZERO, dt, steps);
            let t = dt * f64::from(steps);
            let wanted = 8.0 * (1.0 - 1.0 / (1.0 + k(mass) * 8.0 * t));
            assert!(
                (v.x - wanted).abs() < 1e-12,
                "{mass} kg, {dt} s: {}, {wanted}",
                v.x
            );
        }
    }

    #[test]
    fn a_falling_body_ends_at_its_terminal_speed_at_any_step() {
        for (mass, dt) in [(0.05, 0.01), (0.05, 0.1), (0.05, 1.0), (0.002, 0.5)] {
            let a = DVec3::new(0.0, 0.0, -9.81);
            let v = fly(DVec3::ZERO, DVec3::ZERO, mass, a, dt, 2_000);
            let terminal = (9.81 / k(mass)).sqrt();
            assert!(
                (v.z + terminal).abs() < 1e-9,
                "{mass} kg: {}, {terminal}",
                v.z
            );
        }
    }

    /// `v = v_t tanh(g t / v_t)`: errors fall with the square of the step.
    #[test]
    fn on_the_way_there_its_error_falls_with_the_square_of_the_step() {
        let (mass, t) = (0.05, 1.0);
        let terminal = (9.81 / k(mass)).sqrt();
        let wanted = terminal * math::tanh(9.81 * t / terminal);
        let error = |steps: u32| {
            let a = DVec3::new(0.0, 0.0, -9.81);
            (fly(
                DVec3::ZERO,
                DVec3::ZERO,
                mass,
                a,
                t / f64::from(steps),
                steps,
            )
            .z + wanted)
                .abs()
        };
        let ratio = error(20) / error(40);
        assert!((ratio - 4.0).abs() < 0.4, "{ratio}");
        assert!(error(20) < 5e-3, "{}", error(20));
    }

    #[test]
    fn nonsense_is_refused() {
        for coefficient in [-1.0, f64::NAN, 1e3] {
            assert!(
                Drag {
                    coefficient,
                    ..ball()
                }
                .check()
                .is_err()
            );
        }
        assert!(
            Drag {
                area: Area::si(-1.0),
                ..ball()
            }
            .check()
            .is_err()
        );
        assert!(ball().check().is_ok());
    }
}

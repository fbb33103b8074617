//! The flocking law: from what is believed of neighbours to a velocity. The essay is in `mod.rs`.

use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec3;

/// Numbers of the flocking law; symbols and source in the module's essay.
#[params]
pub struct Law {
    /// `v_flock`: how fast it flies with nobody around. Above 0.
    pub speed: Speed,
    /// `v_max`: no faster than this. Above 0.
    pub max_speed: Speed,
    /// `r0_rep`: nearer ones repel. 0 or more.
    pub repulsion_range: Length,
    /// `p_rep`: speed of repulsion by each metre that they are too near. 0 or more.
    pub repulsion_gain: Frequency,
    /// `r0_frict`: up to here neighbours have to fly alike. 0 or more.
    pub friction_range: Length,
    /// `C_frict`: which part of a difference in velocity is taken back at once, for each neighbour. 0 to 1.
    pub friction: f64,
    /// `v_frict`: a difference in velocity that does not matter. 0 or more.
    pub friction_slack: Speed,
    /// `a_frict` of the braking curve of friction. Above 0.
    pub friction_acceleration: Acceleration,
    /// `p_frict` of the braking curve of friction. Above 0.
    pub friction_gain: Frequency,
    /// `v_shill`: how fast walls fly away from themselves. 0 or more.
    pub wall_speed: Speed,
    /// `r0_shill`: this far before a wall a vehicle stops. 0 or more.
    pub wall_range: Length,
    /// `a_shill` of the braking curve of walls. Above 0.
    pub wall_acceleration: Acceleration,
    /// `p_shill` of the braking curve of walls. Above 0.
    pub wall_gain: Frequency,
}

impl Default for Law {
    fn default() -> Self {
        Self {
            speed: Speed::si(3.0),
            max_speed: Speed::si(5.0),
            repulsion_range: Length::si(9.0),
            repulsion_gain: Frequency::si(0.3),
            friction_range: Length::si(40.0),
            friction: 0.05,
            friction_slack: Speed::si(0.3),
            friction_acceleration: Acceleration::si(2.0),
            friction_gain: Frequency::si(1.5),
            wall_speed: Speed::si(6.0),
            wall_range: Length::si(5.0),
            wall_acceleration: Acceleration::si(2.0),
            wall_gain: Frequency::si(1.0),
        }
    }
}

impl Law {
    /// Refuses numbers that make no sense.
    pub(super) fn check(&self) -> Result<(), BuildError> {
        positive("speed", self.speed)?;
        positive("max_speed", self.max_speed)?;
        at_least_zero("repulsion_range", self.repulsion_range)?;
        at_least_zero("repulsion_gain", self.repulsion_gain)?;
        at_least_zero("friction_range", self.friction_range)?;
        in_range("friction", self.friction, 0.0..=1.0)?;
        at_least_zero("friction_slack", self.friction_slack)?;
        positive("friction_acceleration", self.friction_acceleration)?;
        positive("friction_gain", self.friction_gain)?;
        at_least_zero("wall_speed", self.wall_speed)?;
        at_least_zero("wall_range", self.wall_range)?;
        positive("wall_acceleration", self.wall_acceleration)?;
        positive("wall_gain", self.wall_gain)
    }

    /// The velocity wanted in the plane, m/s: for a vehicle at `p_enu`, m, that moves with `v_enu`, m/s, and
    /// flies `ahead` (of unit length) on its own; among `others`, positions and velocities; in a square
    /// about the origin with sides of `arena_m`. Heights do not count.
    pub(super) fn velocity(
        &self,
        p_enu: DVec3,
        v_enu: DVec3,
        ahead: DVec3,
        others: impl Iterator<Item = (DVec3, DVec3)>,
        arena_m: f64,
    ) -> DVec3 {
        let mut wanted = ahead * self.speed.get();
        for (q_enu, w_enu) in others {
            let to_me = flat(p_enu - q_enu);
            let distance_m = to_me.length();
            let short_m = self.repulsion_range.get() - distance_m;
            if short_m > 0.0 {
                wanted += to_me.normalize_or_zero() * (self.repulsion_gain.get() * short_m);
            }
            let allowed_m_s = braking(
                distance_m - self.friction_range.get(),
                self.friction_acceleration,
                self.friction_gain,
            );
            let allowed_m_s = allowed_m_s.max(self.friction_slack.get());
            wanted += beyond(flat(w_enu - v_enu), allowed_m_s) * self.friction;
        }
        for inward in [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y] {
            let distance_m = arena_m / 2.0 + p_enu.dot(inward);
            let allowed_m_s = braking(
                distance_m - self.wall_range.get(),
                self.wall_acceleration,
                self.wall_gain,
            );
            let wall = inward * self.wall_speed.get();
            wanted += beyond(wall - flat(v_enu), allowed_m_s);
        }
        wanted.clamp_length_max(self.max_speed.get())
    }
}

/// The fastest, m/s, that still stops within `distance_m`: `D(r, a, p)`.
fn braking(distance_m: f64, acceleration: Acceleration, gain: Frequency) -> f64 {
    let (a, p) = (acceleration.get(), gain.get());
    if distance_m <= 0.0 {
        0.0
    } else if distance_m * p < a / p {
        distance_m * p
    } else {
        (2.0 * a * distance_m - a * a / (p * p)).sqrt()
    }
}

/// A vector without its first `allowed` of length.
fn beyond(vector: DVec3, allowed: f64) -> DVec3 {
    let length = vector.length();
    if length > allowed {
        vector * (1.0 - allowed / length)
    } else {
        DVec3::ZERO
    }
}

fn flat(vector: DVec3) -> DVec3 {
    vector.with_z(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wanted(p: DVec3, v: DVec3, others: &[(DVec3, DVec3)]) -> DVec3 {
        let ahead = v.normalize_or(DVec3::X);
        Law::default().velocity(p, v, ahead, others.iter().copied(), 1000.0)
    }

    #[test]
    fn alone_it_flies_on() {
        assert_eq!(wanted(DVec3::ZERO, DVec3::Y, &[]), DVec3::Y * 3.0);
    }

    #[test]
    fn neighbours_that_fly_alike_repel_only_when_near() {
        let v = DVec3::X * 3.0;
        assert_eq!(wanted(DVec3::ZERO, v, &[(DVec3::Y * 9.5, v)]), v);
        let near = wanted(DVec3::ZERO, v, &[(DVec3::Y * 5.0, v)]);
        assert!((near - DVec3::new(3.0, -1.2, 0.0)).length() < 1e-12);
    }

    #[test]
    fn friction_turns_towards_those_who_fly_another_way_the_more_the_nearer() {
        let v = DVec3::X * 3.0;
        let turn = |distance_m| {
            let other = (DVec3::X * distance_m, DVec3::Y * 3.0);
            wanted(DVec3::ZERO, v, &[other]).y
        };
        assert!(turn(20.0) > 0.1 && turn(20.0) > turn(41.0) && turn(100.0) == 0.0);
    }

    #[test]
    fn walls_are_left_alone_until_it_is_time_to_brake_and_then_turn_it_around() {
        let v = DVec3::X * 3.0;
        assert_eq!(wanted(DVec3::X * 440.0, v, &[]), v);
        assert!(wanted(DVec3::X * 494.0, v, &[]).x < 0.0);
    }

    #[test]
    fn the_braking_curve_is_continuous() {
        let curve = |r| braking(r, Acceleration::si(2.0), Frequency::si(1.0));
        assert_eq!(curve(-1.0), 0.0);
        assert!((curve(2.0 - 1e-9) - curve(2.0 + 1e-9)).abs() < 1e-6);
    }
}

//! What an impact does: an impulse along the normal, and friction across it.
//!
//! With `u` the speed at which two bodies meet, `e` the restitution and `m` the masses, the impulse along
//! the normal is `(u + w) / (1/ma + 1/mb)`, where `w` is the speed at which they part: `e u`, but at least
//! a documented minimum (see [`limits`](crate::limits)). Friction acts against the sliding of the two
//! surfaces over one another, spin included, with at most `mu` times that impulse, and at most what stops
//! the sliding (Coulomb). Impulses act at the point of contact, so balls spin.
//!
//! A time of impact is a whole nanosecond, and a body in a pile is knocked into the ground between two
//! of them. So that such remainders do not add up, a body that meets the ground, lands, or is knocked
//! and keeps standing, and is found below its place on it, is *set upon it*: its centre is raised to its
//! radius, in the same instant, with no change of its velocity. This is a correction, not a law of
//! motion: it adds the weight times the rise to the body's energy, for rises of micrometres.

use crate::body::Material;
use crate::limits::{
    GROUND_SNAP_M, PARTING_SPEED_M_S, PARTING_SPEED_M_S_MIN, REST_SPEED_M_S, STANDING_SPEED_M_S,
};
use crate::motion::{Motion, State};
use crate::support::Support;
use glam::DVec3;
use simbeeotic_kernel::SimTime;

/// What an impact looked like.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Impact {
    pub(crate) point: DVec3,
    /// From the first body to the second.
    pub(crate) normal: DVec3,
    /// Of the first body as seen from the second, at the point.
    pub(crate) relative_velocity: DVec3,
    /// On the first body.
    pub(crate) impulse: DVec3,
}

/// One body at the instant of an impact.
struct Side {
    state: State,
    /// From the centre of mass to the point of contact.
    arm: DVec3,
    inverse_mass: f64,
    inverse_inertia: DVec3,
}

impl Side {
    fn new(motion: &Motion, state: State, toward: DVec3) -> Self {
        Self {
            state,
            arm: toward * motion.radius_m(),
            inverse_mass: motion.inverse_mass,
            inverse_inertia: motion.inverse_inertia(),
        }
    }

    /// Velocity of the material at the point of contact.
    fn velocity(&self) -> DVec3 {
        let w_enu = self.state.world_from_body * self.state.w_flu;
        self.state.v_enu + w_enu.cross(self.arm)
    }

    /// Change of the body rate (FLU) by an impulse at the point of contact.
    fn spin(&self, impulse: DVec3) -> DVec3 {
        let angular = self.state.world_from_body.conjugate() * self.arm.cross(impulse);
        angular * self.inverse_inertia
    }

    /// How much the point of contact moves along `direction` by a unit impulse along it.
    fn yields(&self, direction: DVec3) -> f64 {
        let spin = self.state.world_from_body * self.spin(direction);
        self.inverse_mass + spin.cross(self.arm).dot(direction)
    }

    fn push(&self, motion: &mut Motion, impulse: DVec3) {
        if self.inverse_mass > 0.0 {
            motion.v += impulse * self.inverse_mass;
            motion.w += self.spin(impulse);
            motion.respin();
        }
    }
}

/// The impulse that ends sliding at `slip`, but no more than `most`; along `slip`.
fn friction(slip: DVec3, most: f64, yields: impl Fn(DVec3) -> f64) -> DVec3 {
    let speed = slip.length();
    if speed == 0.0 || most <= 0.0 {
        return DVec3::ZERO;
    }
    let direction = slip / speed;
    direction * most.min(speed / yields(direction))
}

/// The unit vector from `a` to `b`; up if they coincide.
fn normal(a: &State, b: &State) -> DVec3 {
    (b.p_enu - a.p_enu).try_normalize().unwrap_or(DVec3::Z)
}

/// What is seen of an impact of two balls that pass through one another.
pub(crate) fn observe_pair(a: &Motion, b: &Motion, t: SimTime) -> Impact {
    let (state_a, state_b) = (a.at(t), b.at(t));
    let normal = normal(&state_a, &state_b);
    let (side_a, side_b) = (
        Side::new(a, state_a, normal),
        Side::new(b, state_b, -normal),
    );
    Impact {
        point: state_a.p_enu + side_a.arm,
        normal,
        relative_velocity: side_a.velocity() - side_b.velocity(),
        impulse: DVec3::ZERO,
    }
}

/// What is seen of a ball that passes through the ground.
pub(crate) fn observe_ground(a: &Motion, t: SimTime) -> Impact {
    let state = a.at(t);
    let side = Side::new(a, state, DVec3::NEG_Z);
    Impact {
        point: state.p_enu.with_z(0.0),
        normal: DVec3::NEG_Z,
        relative_velocity: side.velocity(),
        impulse: DVec3::ZERO,
    }
}

impl Impact {
    /// The speed at which the two met, along the normal, m/s.
    pub(crate) fn closing_speed(&self) -> f64 {
        self.relative_velocity.dot(self.normal)
    }
}

/// Two balls meet at `t`, at least one of which can be pushed. Both begin new segments if so.
pub(crate) fn collide_pair(
    a: &mut Motion,
    b: &mut Motion,
    material: Material,
    t: SimTime,
) -> Impact {
    let mut impact = observe_pair(a, b, t);
    let (state_a, state_b) = (a.at(t), b.at(t));
    let normal = impact.normal;
    let (side_a, side_b) = (
        Side::new(a, state_a, normal),
        Side::new(b, state_b, -normal),
    );

    let closing = impact.relative_velocity.dot(normal);
    let least = if pressed(&state_a, &state_b, normal) {
        PARTING_SPEED_M_S
    } else {
        PARTING_SPEED_M_S_MIN
    };
    let parting = (material.restitution * closing.max(0.0)).max(least);
    let along = (closing + parting).max(0.0) / (side_a.inverse_mass + side_b.inverse_mass);
    let slip = impact.relative_velocity - normal * closing;
    let across = friction(slip, material.friction * along, |d| {
        side_a.yields(d) + side_b.yields(d)
    });
    impact.impulse = -(normal * along + across);

    for (motion, side, impulse) in [(a, side_a, impact.impulse), (b, side_b, -impact.impulse)] {
        if side.inverse_mass > 0.0 {
            motion.carry(t);
            side.push(motion, impulse);
            knock(motion);
        }
    }
    impact
}

/// Whether net forces drive the two towards one another, once they move at equal speed along the normal.
fn pressed(a: &State, b: &State, normal: DVec3) -> bool {
    let between = b.p_enu - a.p_enu;
    let v = b.v_enu - a.v_enu;
    let across = v - normal * v.dot(normal);
    let distance = between.length();
    let centrifugal = if distance > 0.0 {
        across.length_squared() / distance
    } else {
        0.0
    };
    (b.a_enu - a.a_enu).dot(normal) + centrifugal < 0.0
}

/// A body on the ground was hit: pressed down, it meets the ground anew; else it slides or takes off.
fn knock(motion: &mut Motion) {
    if motion.support != Support::None && motion.v.z < -STANDING_SPEED_M_S {
        motion.support = Support::None;
    } else {
        motion.stand();
        if motion.support != Support::None {
            motion.p.z = motion.p.z.max(motion.radius_m());
        }
    }
}

/// A ball meets the ground at `t`: it bounces, or comes to be carried.
pub(crate) fn collide_ground(a: &mut Motion, material: Material, t: SimTime) -> Impact {
    let mut impact = observe_ground(a, t);
    a.carry(t);
    if a.p.z - a.radius_m() <= GROUND_SNAP_M {
        a.p.z = a.radius_m();
    }
    let side = Side::new(a, a.at(t), DVec3::NEG_Z);

    let closing = (-a.v.z).max(0.0);
    let rebound = material.restitution * closing;
    let lands = rebound < REST_SPEED_M_S && a.a.z <= 0.0;
    let parting = if lands { 0.0 } else { rebound };
    let along = (closing + parting) / side.inverse_mass;
    let slip = DVec3::new(impact.relative_velocity.x, impact.relative_velocity.y, 0.0);
    let across = friction(slip, material.friction * along, |d| side.yields(d));
    impact.impulse = DVec3::new(0.0, 0.0, along) - across;

    side.push(a, impact.impulse);
    a.v.z = parting;
    if lands {
        a.land();
    }
    impact
}

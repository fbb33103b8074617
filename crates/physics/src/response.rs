//! What an impact does: an impulse along the normal, and friction across it.
//!
//! With `u` the speed at which two surfaces meet at the point of contact and `e` the restitution, they
//! part with `w = e u`, but with at least a documented minimum (see [`limits`](crate::limits)). The
//! impulse `J` on the first body is the one that makes them do so, under Coulomb's law: it pushes, its
//! tangential part is at most `mu` times its normal part, and stops the sliding if it can,
//!
//! ```text
//! v' = v + K J      K = sum over both of (1/m + r x I^-1 (. x r))                          (1)
//! ```
//!
//! with `v` the velocity of the first body's surface as seen from the second, and `r` from the centre of
//! mass to the point. For balls the two parts do not know of each other and one pass solves (1); what is
//! struck off centre takes a few. If friction would add energy, as it can with Newton's restitution, it
//! is left out.
//!
//! A time of impact is a whole nanosecond, and a body in a pile is knocked into the ground between two
//! of them. So that such remainders do not add up, a ball that meets the ground, lands, or is knocked
//! and keeps standing, and is found below its place on it, is *set upon it*: its centre is raised to its
//! radius, in the same instant, with no change of its velocity. This is a correction, not a law of
//! motion: it adds the weight times the rise to the body's energy, for rises of micrometres.

use crate::approach::Side;
use crate::body::Material;
use crate::limits::{
    GROUND_SNAP_M, PARTING_SPEED_M_S, PARTING_SPEED_M_S_MIN, REST_SPEED_M_S, STANDING_SPEED_M_S,
};
use crate::motion::{Motion, State};
use crate::support::Support;
use glam::DVec3;
use simbeeotic_kernel::SimTime;

/// Passes over normal and friction for what is not two balls.
const PASSES: u32 = 12;

/// Where two touch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) point: DVec3,
    /// From the first body to the second.
    pub(crate) normal: DVec3,
    /// Whether a push along the normal turns neither: it runs through the centres of mass of all that
    /// can be pushed.
    pub(crate) central: bool,
    /// Whether both are balls.
    pub(crate) balls: bool,
}

impl Spot {
    /// Where two touch at `t`, or come nearest.
    pub(crate) fn between(a: Side<'_>, b: Side<'_>, t: SimTime) -> Self {
        let (place_a, place_b) = (a.motion.place(t), b.motion.place(t));
        if let (Some(_), Some(_)) = (a.form.ball(), b.form.ball()) {
            let normal = (place_b.p - place_a.p).try_normalize().unwrap_or(DVec3::Z);
            return Self {
                point: place_a.p + normal * a.motion.radius_m(),
                normal,
                central: true,
                balls: true,
            };
        }
        let gap = a.form.gap(place_a, b.form, place_b);
        let through =
            |side: Side<'_>| side.form.ball().is_some() || side.motion.inverse_mass == 0.0;
        Self {
            point: (gap.here + gap.there) * 0.5,
            normal: gap.normal,
            central: through(a) && through(b),
            balls: false,
        }
    }

    /// The same, seen from the second.
    pub(crate) fn flipped(self) -> Self {
        Self {
            normal: -self.normal,
            ..self
        }
    }

    /// Where a body touches the ground at `t`, or comes nearest to it.
    pub(crate) fn on_ground(a: Side<'_>, t: SimTime) -> Self {
        let ball = a.form.ball().is_some();
        let place = a.motion.place(t);
        let point = if ball {
            place.p
        } else {
            a.form.gap_to_ground(place).here
        };
        Self {
            point: point.with_z(0.0),
            normal: DVec3::NEG_Z,
            central: ball,
            balls: false,
        }
    }
}

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
    /// Whether it ended with the two hardly parting while forces may press them together.
    pub(crate) lasts: bool,
    /// Whether nothing came of it: the two move on as before.
    pub(crate) in_vain: bool,
}

impl Impact {
    /// The speed at which the two met, along the normal, m/s.
    pub(crate) fn closing_speed(&self) -> f64 {
        self.relative_velocity.dot(self.normal)
    }
}

/// One body at the instant of an impact.
struct Struck {
    state: State,
    /// From the centre of mass to the point of contact.
    arm: DVec3,
    inverse_mass: f64,
    inverse_inertia: DVec3,
}

impl Struck {
    fn new(motion: &Motion, t: SimTime, point: DVec3) -> Self {
        let state = motion.at(t);
        Self {
            state,
            arm: point - state.p_enu,
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

    /// Change of the velocity of the point of contact by an impulse there.
    fn yields(&self, impulse: DVec3) -> DVec3 {
        if self.inverse_mass == 0.0 {
            return DVec3::ZERO;
        }
        let spin = self.state.world_from_body * self.spin(impulse);
        impulse * self.inverse_mass + spin.cross(self.arm)
    }

    fn push(&self, motion: &mut Motion, impulse: DVec3) {
        if self.inverse_mass > 0.0 {
            motion.v += impulse * self.inverse_mass;
            motion.w += self.spin(impulse);
            motion.respin();
        }
    }
}

/// Two surfaces at their point of contact: equation (1).
struct Contact<'a> {
    sides: [&'a Struck; 2],
    normal: DVec3,
    central: bool,
}

impl Contact<'_> {
    fn yields(&self, impulse: DVec3) -> DVec3 {
        self.sides[0].yields(impulse) + self.sides[1].yields(impulse)
    }

    /// How much the normal speed changes by a unit impulse along the normal.
    fn yields_along(&self) -> f64 {
        if self.central {
            self.sides[0].inverse_mass + self.sides[1].inverse_mass
        } else {
            self.yields(self.normal).dot(self.normal)
        }
    }

    /// The impulse on the first body that lets surfaces which meet at `velocity` part at `parting`.
    fn solve(&self, velocity: DVec3, parting: f64, friction: f64) -> DVec3 {
        let yields_along = self.yields_along();
        let mut along = ((velocity.dot(self.normal) + parting) / yields_along).max(0.0);
        let frictionless = self.normal * -along;
        let mut across = DVec3::ZERO;
        let passes = if self.central { 1 } else { PASSES };
        for pass in 0..passes {
            if pass > 0 {
                let now = velocity + self.yields(across - self.normal * along);
                along = (along + (now.dot(self.normal) + parting) / yields_along).max(0.0);
            }
            let now = velocity + self.yields(across - self.normal * along);
            across = self.hold(now, across, friction * along);
        }
        let impulse = across - self.normal * along;
        // The passes need not have come to an end: on a long lever friction can take back all that the
        // normal push gives, and two that close in would be left to meet again in the same instant.
        let taken_back = along == 0.0 && frictionless != DVec3::ZERO;
        // What the impulse does to the energy: its scalar product with the mean velocity.
        let work = |j: DVec3| j.dot(velocity + self.yields(j) * 0.5);
        if self.central || !taken_back && work(impulse) <= work(frictionless).max(0.0) {
            impulse
        } else {
            frictionless
        }
    }

    /// The friction `across` changed so that it stops the sliding at `velocity`, or does its `most`.
    fn hold(&self, velocity: DVec3, across: DVec3, most: f64) -> DVec3 {
        let slip = velocity - self.normal * velocity.dot(self.normal);
        let speed = slip.length();
        if most <= 0.0 {
            return DVec3::ZERO;
        }
        if speed == 0.0 {
            return across.clamp_length_max(most);
        }
        let direction = slip / speed;
        let stop = speed / self.yields(direction).dot(direction);
        (across - direction * stop).clamp_length_max(most)
    }
}

/// What is seen of two that pass through one another.
pub(crate) fn observe(a: &Motion, b: Option<&Motion>, spot: &Spot, t: SimTime) -> Impact {
    let velocity = |motion: &Motion| Struck::new(motion, t, spot.point).velocity();
    Impact {
        point: spot.point,
        normal: spot.normal,
        relative_velocity: velocity(a) - b.map_or(DVec3::ZERO, velocity),
        impulse: DVec3::ZERO,
        lasts: false,
        in_vain: false,
    }
}

/// Two bodies meet at `t`, at least one of which can be pushed. Both begin new segments if so.
pub(crate) fn collide(
    a: &mut Motion,
    b: &mut Motion,
    spot: &Spot,
    material: Material,
    t: SimTime,
) -> Impact {
    let (side_a, side_b) = (Struck::new(a, t, spot.point), Struck::new(b, t, spot.point));
    let velocity = side_a.velocity() - side_b.velocity();
    let closing = velocity.dot(spot.normal);
    let pressed = pressed(&side_a.state, &side_b.state, spot);
    // What presses a body in an island does not show in its segment.
    let stepped = [a.support, b.support].contains(&Support::Island);
    let least = if pressed {
        PARTING_SPEED_M_S
    } else {
        PARTING_SPEED_M_S_MIN
    };
    let parting = (material.restitution * closing.max(0.0)).max(least);
    let contact = Contact {
        sides: [&side_a, &side_b],
        normal: spot.normal,
        central: spot.central,
    };
    let impulse = contact.solve(velocity, parting, material.friction);
    for (motion, side, impulse) in [(a, &side_a, impulse), (b, &side_b, -impulse)] {
        if side.inverse_mass > 0.0 {
            motion.carry(t);
            side.push(motion, impulse);
            knock(motion);
        }
    }
    Impact {
        point: spot.point,
        normal: spot.normal,
        relative_velocity: velocity,
        impulse,
        lasts: (pressed || stepped || !spot.central) && parting <= PARTING_SPEED_M_S,
        in_vain: impulse == DVec3::ZERO,
    }
}

/// Whether net forces drive the two towards one another, once they move at equal speed along the normal.
fn pressed(a: &State, b: &State, spot: &Spot) -> bool {
    let normal = spot.normal;
    let toward = (b.a_enu - a.a_enu).dot(normal);
    if !spot.balls {
        return toward < 0.0;
    }
    let between = b.p_enu - a.p_enu;
    let v = b.v_enu - a.v_enu;
    let across = v - normal * v.dot(normal);
    let distance = between.length();
    let centrifugal = if distance > 0.0 {
        across.length_squared() / distance
    } else {
        0.0
    };
    toward + centrifugal < 0.0
}

/// A body on the ground was hit: pressed down, it meets the ground anew; else it slides or takes off. One
/// in an island follows its next step.
fn knock(motion: &mut Motion) {
    if motion.support == Support::Island {
        return;
    }
    if motion.support != Support::None && motion.v.z < -STANDING_SPEED_M_S {
        motion.support = Support::None;
    } else {
        motion.stand();
        if motion.support != Support::None {
            motion.p.z = motion.p.z.max(motion.radius_m());
        }
    }
}

/// A body meets the ground at `t`: it bounces, or, if it `stands` on what it lands on, comes to be
/// carried.
pub(crate) fn collide_ground(
    a: &mut Motion,
    spot: &Spot,
    material: Material,
    stands: bool,
    t: SimTime,
) -> Impact {
    let seen = observe(a, None, spot, t);
    a.carry(t);
    if spot.central && a.p.z - a.radius_m() <= GROUND_SNAP_M {
        a.p.z = a.radius_m();
    }
    let side = Struck::new(a, t, spot.point);
    let nobody = Struck {
        inverse_mass: 0.0,
        ..Struck::new(a, t, spot.point)
    };

    let closing = seen.closing_speed().max(0.0);
    let rebound = material.restitution * closing;
    let slow = rebound < REST_SPEED_M_S && a.acceleration().z <= 0.0;
    let parting = match (slow, stands) {
        (true, true) => 0.0,
        (true, false) => rebound.max(PARTING_SPEED_M_S),
        (false, _) => rebound.max(PARTING_SPEED_M_S_MIN),
    };
    let contact = Contact {
        sides: [&side, &nobody],
        normal: spot.normal,
        central: spot.central,
    };
    let impulse = contact.solve(seen.relative_velocity, parting, material.friction);
    side.push(a, impulse);
    if spot.central {
        a.v.z = parting;
    }
    if slow && stands {
        a.land();
    }
    Impact {
        impulse,
        lasts: slow && !stands,
        in_vain: impulse == DVec3::ZERO && !(slow && stands),
        ..seen
    }
}

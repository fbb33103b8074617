//! What holds an island at rest, and whether it bears other forces.
//!
//! An island that rests keeps the points at which its members press upon one another and upon what does not
//! move. When the force on a member changes (a gust, a motor that turns slower), these points are asked
//! first: if they can bear it, nothing moves, and the island sleeps on.
//!
//! They can if there are forces at the points that leave no body with an acceleration,
//!
//! ```text
//! m a = f + sum F_k = 0      I w' = tau + sum r_k x F_k = 0                                (1)
//! F_k = -n_k N_k + T_k       N_k >= 0       |T_k| <= mu_k N_k                              (2)
//! ```
//!
//! with `f` and `tau` what acts on the body, `r_k` from its centre of mass to the point, and `n_k` the normal
//! out of it. Forces that obey (2) are sought by going over the points again and again, from the forces
//! found last; each takes up what is left of the acceleration at its place (projected Gauss-Seidel with
//! over-relaxation). If (1)
//! holds in the end the answer is proved, whatever the way to it. If it does not within [`SWEEPS`], the
//! answer is no, and the island is stepped. Friction is used up to [`SHARE`] only, so that it is the
//! steps that decide where it may give way.

use glam::{DMat3, DQuat, DVec3};

/// How often all points are gone over.
const SWEEPS: usize = 200;
/// The share of friction that is counted on.
const SHARE: f64 = 0.95;
/// What is left of an acceleration, over the greatest that acts, counts as none.
const LEFT: f64 = 1e-3;
/// Bodies of which so much less is left are passed over: a gust on one of a heap does not reach far.
const DONE: f64 = 0.01;
/// What is left at a point is taken up so many times: more than once, and the end is reached in half the
/// sweeps.
const RELAXATION: f64 = 1.3;

/// A member as it rests, and what acts on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rester {
    /// 0 if contact cannot move it.
    pub(crate) inverse_mass: f64,
    /// About the body axes; 0 if contact cannot turn it.
    pub(crate) inverse_inertia: DVec3,
    pub(crate) attitude: DQuat,
    /// Radius of its bounding ball, m.
    pub(crate) radius: f64,
    /// What it would do if nothing held it: ENU, m/s^2,
    pub(crate) linear: DVec3,
    /// and FLU, N m.
    pub(crate) torque: DVec3,
}

/// A point at which two press upon one another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearing {
    /// Places of the two among the members; `None` is what never moves.
    pub(crate) sides: [Option<usize>; 2],
    /// From the centres of mass to the point, ENU, m.
    pub(crate) arms: [DVec3; 2],
    /// From the first to the second, unit.
    pub(crate) normal: DVec3,
    pub(crate) friction: f64,
    /// The force along the normal, N.
    pub(crate) along: f64,
    /// The friction on the first, N.
    pub(crate) across: DVec3,
}

/// A member under its wrench and the forces at its points.
struct Loaded {
    inverse_mass: f64,
    inverse_inertia: DMat3,
    radius: f64,
    /// m/s^2
    linear: DVec3,
    /// rad/s^2
    angular: DVec3,
}

impl Loaded {
    fn new(rester: &Rester) -> Self {
        let turn = DMat3::from_quat(rester.attitude);
        let inverse_inertia =
            turn * DMat3::from_diagonal(rester.inverse_inertia) * turn.transpose();
        let movable = rester.inverse_mass > 0.0;
        Self {
            inverse_mass: rester.inverse_mass,
            inverse_inertia,
            radius: rester.radius,
            linear: if movable { rester.linear } else { DVec3::ZERO },
            angular: inverse_inertia * (rester.attitude * rester.torque),
        }
    }

    fn pull(&mut self, arm: DVec3, force: DVec3) {
        self.linear += force * self.inverse_mass;
        self.angular += self.inverse_inertia * arm.cross(force);
    }

    /// The acceleration of the point at `arm`.
    fn at(&self, arm: DVec3) -> DVec3 {
        self.linear + self.angular.cross(arm)
    }

    /// The change of that acceleration along `direction` by a unit force along it.
    fn yields(&self, arm: DVec3, direction: DVec3) -> f64 {
        let lever = arm.cross(direction);
        self.inverse_mass + lever.dot(self.inverse_inertia * lever)
    }

    /// The greatest acceleration of any of its points, at most.
    fn most(&self) -> f64 {
        self.linear.length() + self.angular.length() * self.radius
    }
}

impl Bearing {
    fn each(&self) -> impl Iterator<Item = (usize, DVec3, f64)> + use<> {
        let [a, b] = self.sides;
        let [arm_a, arm_b] = self.arms;
        let first = a.map(|place| (place, arm_a, 1.0));
        let second = b.map(|place| (place, arm_b, -1.0));
        first.into_iter().chain(second)
    }

    /// Acceleration of the first at the point as seen from the second.
    fn closing(&self, loaded: &[Loaded]) -> DVec3 {
        self.each()
            .map(|(place, arm, sign)| loaded[place].at(arm) * sign)
            .sum()
    }

    fn yields(&self, loaded: &[Loaded], direction: DVec3) -> f64 {
        self.each()
            .map(|(place, arm, _)| loaded[place].yields(arm, direction))
            .sum()
    }

    /// Lets `force` act on the first, and its opposite on the second.
    fn push(&self, loaded: &mut [Loaded], force: DVec3) {
        for (place, arm, sign) in self.each() {
            loaded[place].pull(arm, force * sign);
        }
    }

    /// Takes up what is left at this point.
    fn take_up(&mut self, loaded: &mut [Loaded]) {
        let yields = self.yields(loaded, self.normal);
        if yields == 0.0 {
            return;
        }
        let closing = self.closing(loaded).dot(self.normal);
        let along = (self.along + RELAXATION * closing / yields).max(0.0);
        self.push(loaded, self.normal * (self.along - along));
        self.along = along;

        let closing = self.closing(loaded);
        let slip = closing - self.normal * closing.dot(self.normal);
        let size = slip.length();
        let wanted = if size > 0.0 {
            let yields = self.yields(loaded, slip / size);
            self.across - slip * (RELAXATION / yields)
        } else {
            self.across
        };
        let across = wanted.clamp_length_max(SHARE * self.friction * along);
        self.push(loaded, across - self.across);
        self.across = across;
    }
}

/// Whether the points bear what acts on the members: then they keep the forces that do, to start from the
/// next time.
pub(crate) fn bears(points: &mut [Bearing], members: &[Rester]) -> bool {
    let mut loaded: Vec<Loaded> = members.iter().map(Loaded::new).collect();
    let most = loaded.iter().map(Loaded::most).fold(0.0, f64::max);
    let little = LEFT * most;
    for point in &mut *points {
        // The normal and the place are those of the last step: friction may be more than it can be.
        point.across -= point.normal * point.across.dot(point.normal);
        let most = SHARE * point.friction * point.along;
        point.across = point.across.clamp_length_max(most);
        point.push(&mut loaded, point.across - point.normal * point.along);
    }
    for _ in 0..SWEEPS {
        if loaded.iter().all(|body| body.most() <= little) {
            return true;
        }
        for point in &mut *points {
            if point
                .each()
                .any(|(place, ..)| loaded[place].most() > DONE * little)
            {
                point.take_up(&mut loaded);
            }
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::{Bearing, Rester, bears};
    use glam::{DQuat, DVec3};

    const G: f64 = 9.8;

    /// A box of 1 kg, 0.2 m wide and 0.2 m high, on its four lower corners, under `force` and `torque`.
    fn stands(force: DVec3, torque: DVec3, friction: f64) -> bool {
        let corner = |x: f64, y: f64| Bearing {
            sides: [Some(0), None],
            arms: [DVec3::new(x, y, -0.1), DVec3::ZERO],
            normal: DVec3::NEG_Z,
            friction,
            along: G / 4.0,
            across: DVec3::ZERO,
        };
        let mut points = [
            corner(-0.1, -0.1),
            corner(-0.1, 0.1),
            corner(0.1, -0.1),
            corner(0.1, 0.1),
        ];
        let body = Rester {
            inverse_mass: 1.0,
            inverse_inertia: DVec3::splat(1.0 / 0.0067),
            attitude: DQuat::IDENTITY,
            radius: 0.1732,
            linear: force - DVec3::Z * G,
            torque,
        };
        bears(&mut points, &[body])
    }

    #[test]
    fn friction_holds_up_to_its_share_and_no_farther() {
        for friction in [0.1, 0.5] {
            let most = friction * G;
            for direction in [DVec3::X, DVec3::new(0.6, -0.8, 0.0)] {
                assert!(stands(direction * (0.94 * most), DVec3::ZERO, friction));
                assert!(!stands(direction * (0.97 * most), DVec3::ZERO, friction));
            }
        }
    }

    #[test]
    fn a_box_tips_where_its_weight_leaves_the_support() {
        // Force times height is weight times half the breadth.
        assert!(stands(DVec3::X * (0.98 * G), DVec3::ZERO, 2.0));
        assert!(!stands(DVec3::X * (1.02 * G), DVec3::ZERO, 2.0));
        let tips = 0.1 * G;
        assert!(stands(DVec3::ZERO, DVec3::Y * (0.98 * tips), 0.5));
        assert!(!stands(DVec3::ZERO, DVec3::Y * (1.02 * tips), 0.5));
    }

    #[test]
    fn a_box_twists_where_friction_at_its_corners_gives_way() {
        // Each corner at a distance of 0.1 sqrt(2) m from the middle.
        let most = 0.5 * G * 0.141_42;
        assert!(stands(DVec3::ZERO, DVec3::Z * (0.94 * most), 0.5));
        assert!(!stands(DVec3::ZERO, DVec3::Z * (0.97 * most), 0.5));
    }

    #[test]
    fn what_is_lifted_does_not_stay() {
        assert!(stands(DVec3::Z * (0.999 * G), DVec3::ZERO, 0.5));
        assert!(!stands(DVec3::Z * (1.001 * G), DVec3::ZERO, 0.5));
        assert!(!stands(DVec3::new(1.0, 0.0, 0.9 * G), DVec3::ZERO, 0.5));
    }

    #[test]
    fn a_stack_of_boxes_bears_a_gust() {
        let mut points = Vec::new();
        for (x, y) in [(-0.1, -0.1), (-0.1, 0.1), (0.1, -0.1), (0.1, 0.1)] {
            let point = |sides, upper: f64, load: f64| Bearing {
                sides,
                arms: [DVec3::new(x, y, -0.1), DVec3::new(x, y, upper)],
                normal: DVec3::NEG_Z,
                friction: 0.5,
                along: load * G / 4.0,
                across: DVec3::ZERO,
            };
            points.push(point([Some(1), Some(0)], 0.1, 1.0));
            points.push(point([Some(0), None], 0.0, 2.0));
        }
        let body = |gust: DVec3| Rester {
            inverse_mass: 1.0,
            inverse_inertia: DVec3::splat(1.0 / 0.0067),
            attitude: DQuat::IDENTITY,
            radius: 0.1732,
            linear: gust - DVec3::Z * G,
            torque: DVec3::ZERO,
        };
        for (gusts, holds) in [
            ([DVec3::X * 1.5, DVec3::Y * 1.5], true),
            ([DVec3::NEG_X * 1.5, DVec3::new(1.0, -1.0, 1.0)], true),
            ([DVec3::ZERO, DVec3::X * 3.0], true),
            ([DVec3::ZERO, DVec3::X * 5.5], false),
        ] {
            assert_eq!(bears(&mut points, &gusts.map(body)), holds, "{gusts:?}");
        }
    }

    #[test]
    fn a_stack_bears_what_its_least_rough_joint_bears() {
        for (push, holds) in [(0.9, true), (1.0, false)] {
            let joint = |sides: [Option<usize>; 2], down: f64, load: f64| Bearing {
                sides,
                arms: [DVec3::Z * -down, DVec3::Z * down],
                normal: DVec3::NEG_Z,
                friction: 0.5,
                along: load * G,
                across: DVec3::ZERO,
            };
            // Balls that do not turn: each of 1 kg, the upper one pushed.
            let body = |push: f64| Rester {
                inverse_mass: 1.0,
                inverse_inertia: DVec3::ZERO,
                attitude: DQuat::IDENTITY,
                radius: 0.1,
                linear: DVec3::new(push, 0.0, -G),
                torque: DVec3::ZERO,
            };
            let mut points = [
                joint([Some(1), Some(0)], 0.1, 1.0),
                joint([Some(0), None], 0.1, 2.0),
            ];
            let bodies = [body(0.0), body(push * 0.5 * G)];
            assert_eq!(bears(&mut points, &bodies), holds, "{push}");
        }
    }
}

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
//! holds in the end the answer is proved, whatever the way to it: (2) exactly, and (1) up to an acceleration
//! of 2 mm/s^2 and of 0.02 rad/s^2 of each member by itself ([`LEFT`] and [`LEFT_TURN`]). Whoever speeds up
//! no more than that from rest is still for as long as the steps ask of one that comes to rest, so they
//! would not move it either: a ball that can roll stands under a lesser push for ever. If (1) does not hold
//! within [`SWEEPS`], the answer is no, and the island is stepped. Friction is used up to [`SHARE`] only, so
//! that it is the steps that decide where it may give way.

use crate::island::LoadedPoint;
use crate::islands::Island;
use crate::stepping::{STILL_RATE_RAD_S, STILL_S, STILL_SPEED_M_S};
use glam::{DMat3, DQuat, DVec3};

/// How often all points are gone over.
const SWEEPS: usize = 200;
/// The share of friction that is counted on.
const SHARE: f64 = 0.95;
/// What is left of an acceleration counts as none up to here, m/s^2: what the steps take for still,
const LEFT: f64 = STILL_SPEED_M_S / STILL_S;
/// and of one of turning, rad/s^2.
const LEFT_TURN: f64 = STILL_RATE_RAD_S / STILL_S;
/// Bodies of which only this share of that is left are passed over: a gust on one of a heap does not reach
/// far.
const DONE: f64 = 0.05;
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

    /// Whether no more is left than this share of what counts as none.
    fn still(&self, share: f64) -> bool {
        self.linear.length() <= share * LEFT && self.angular.length() <= share * LEFT_TURN
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

/// The points that the members at `places` (ascending) rest on, of all that bore a load.
pub(crate) fn bearings(island: &Island, points: &[LoadedPoint], places: &[usize]) -> Vec<Bearing> {
    let bearing = |point: &LoadedPoint| {
        let (a, b) = point.pair;
        let place = |id: u32| {
            let place = island.position(id)?;
            let at = places.binary_search(&place).ok()?;
            Some((at, point.point - island.members[place].at.p))
        };
        let (a, b) = (place(a), place(b));
        (a.is_some() || b.is_some()).then(|| Bearing {
            sides: [a, b].map(|side| side.map(|(at, _)| at)),
            arms: [a, b].map(|side| side.map_or(DVec3::ZERO, |(_, arm)| arm)),
            normal: point.normal,
            friction: point.friction,
            along: point.along,
            across: DVec3::ZERO,
        })
    };
    points.iter().filter_map(bearing).collect()
}

/// Whether the points bear what acts on the members: then they keep the forces that do, to start from the
/// next time.
pub(crate) fn bears(points: &mut [Bearing], members: &[Rester]) -> bool {
    let mut loaded: Vec<Loaded> = members.iter().map(Loaded::new).collect();
    for point in &mut *points {
        // The normal and the place are those of the last step: friction may be more than it can be.
        point.across -= point.normal * point.across.dot(point.normal);
        let most = SHARE * point.friction * point.along;
        point.across = point.across.clamp_length_max(most);
        point.push(&mut loaded, point.across - point.normal * point.along);
    }
    for _ in 0..SWEEPS {
        if loaded.iter().all(|body| body.still(1.0)) {
            return true;
        }
        for point in &mut *points {
            if point.each().any(|(place, ..)| !loaded[place].still(DONE)) {
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

    /// A ball of 1 kg on a point, as it turns or does not, under `push`.
    fn ball_stands(inverse_inertia: f64, friction: f64, push: f64) -> bool {
        let mut points = [under(0, friction)];
        bears(&mut points, &[ball(inverse_inertia, push, 0.0)])
    }

    fn under(place: usize, friction: f64) -> Bearing {
        Bearing {
            sides: [Some(place), None],
            arms: [DVec3::Z * -0.1, DVec3::ZERO],
            normal: DVec3::NEG_Z,
            friction,
            along: G,
            across: DVec3::ZERO,
        }
    }

    fn ball(inverse_inertia: f64, push: f64, pressed: f64) -> Rester {
        Rester {
            inverse_mass: 1.0,
            inverse_inertia: DVec3::splat(inverse_inertia),
            attitude: DQuat::IDENTITY,
            linear: DVec3::new(push, 0.0, -G - pressed),
            torque: DVec3::ZERO,
        }
    }

    /// That of 1 kg and 0.1 m, 1/(kg m^2).
    const ROLLS: f64 = 250.0;

    #[test]
    fn a_ball_that_can_roll_or_slide_bears_no_push_that_the_steps_would_see() {
        for push in [0.005, 0.05, 1.0] {
            assert!(!ball_stands(ROLLS, 0.5, push), "{push}");
            assert!(!ball_stands(0.0, 0.0, push), "{push}");
            assert!(ball_stands(0.0, 0.5, push), "{push}");
        }
        assert!(ball_stands(ROLLS, 0.5, 0.0));
    }

    #[test]
    fn who_is_pressed_hard_does_not_hold_another() {
        for pressed in [0.0, 50.0, 1e4] {
            let stand = |push: f64| {
                let mut points = [under(0, 0.5), under(1, 0.5)];
                let bodies = [ball(ROLLS, 0.0, pressed), ball(ROLLS, push, 0.0)];
                bears(&mut points, &bodies)
            };
            assert!(stand(0.0), "{pressed}");
            assert!(!stand(0.005), "{pressed}");
        }
    }

    #[test]
    fn a_small_body_turns_under_a_torque_that_hardly_moves_its_surface() {
        // A ball of 1 cm: 0.1 rad/s^2 is 1 mm/s^2 at its surface.
        let stand = |turning: f64| {
            let body = Rester {
                inverse_inertia: DVec3::splat(25_000.0),
                torque: DVec3::Z * (turning / 25_000.0),
                ..ball(0.0, 0.0, 0.0)
            };
            bears(&mut [under(0, 0.0)], &[body])
        };
        assert!(stand(0.01));
        assert!(!stand(0.1));
    }
}

//! What is near a point: objects whose middle lies in a ball.
//!
//! The middle is that of the whole: of a wall with a door, half way along it. A single flower's middle
//! is its foot. A patch that is approximated (`approximate_patches`) has no single flowers; whether
//! there is one in a ball is drawn, with the chance that the original took: the density times the area
//! that the patch and the ball's circle share, 1 at most. The same question has the same answer: the
//! draw hangs on the seed, the patch, and the bits of the ball.

use crate::flower::{Flower, Patch};
use crate::obstacle::Obstacle;
use crate::person::Person;
use crate::solid::{ObjectId, ObjectKind};
use crate::structure::Structure;
use crate::terrain::Terrain;
use crate::world::World;
use simbeeotic_kernel::rng::Stream;
use simbeeotic_units::{Length, Position, math};
use std::f64::consts::PI;

impl World {
    /// The obstacles whose middle is at most `radius` away from `center`, in the order of the file.
    pub fn obstacles_within(
        &self,
        center: Position,
        radius: Length,
    ) -> impl Iterator<Item = (ObjectId, &Obstacle)> {
        let all = self.obstacles.iter();
        near(ObjectKind::Obstacle, all, Obstacle::middle, center, radius)
    }

    /// The structures whose middle is at most `radius` away from `center`, in the order of the file.
    pub fn structures_within(
        &self,
        center: Position,
        radius: Length,
    ) -> impl Iterator<Item = (ObjectId, &Structure)> {
        let all = self.structures.iter();
        near(
            ObjectKind::Structure,
            all,
            Structure::middle,
            center,
            radius,
        )
    }

    /// The people whose middle is at most `radius` away from `center`, in the order of the file.
    pub fn people_within(
        &self,
        center: Position,
        radius: Length,
    ) -> impl Iterator<Item = (ObjectId, &Person)> {
        let all = self.people.iter();
        near(ObjectKind::Person, all, Person::middle, center, radius)
    }

    /// The terrain, if its middle is at most `radius` away from `center`.
    pub fn terrain_within(
        &self,
        center: Position,
        radius: Length,
    ) -> impl Iterator<Item = (ObjectId, &Terrain)> {
        let middle = |terrain: &Terrain| terrain.position;
        near(
            ObjectKind::Terrain,
            self.terrain.iter(),
            middle,
            center,
            radius,
        )
    }

    /// The flowers at most `radius` away from `center`, patch by patch. `seed` is that of
    /// [`World::flowers`]. All flowers are drawn for each question: who asks often keeps them.
    ///
    /// Of an approximated patch: one flower, at the patch's middle, if the draw of
    /// [the module](self) says so.
    pub fn flowers_within(&self, center: Position, radius: Length, seed: u64) -> Vec<Flower> {
        if !self.approximate_patches {
            let mut flowers = self.flowers(seed);
            flowers.retain(|flower| center.distance(flower.foot) <= radius);
            return flowers;
        }
        let [x, y, z] = center.si().to_array().map(f64::to_bits);
        let question = format!(
            "flowers-within {x:x} {y:x} {z:x} {:x}",
            radius.get().to_bits()
        );
        let drawn = |(patch, at): (usize, &Patch)| {
            let mut stream = Stream::new(seed, &self.patch_path(patch), &question);
            let foot = at.center;
            let item = 0;
            (stream.uniform() < at.chance_within(center, radius)).then_some(Flower {
                patch,
                item,
                foot,
            })
        };
        self.patches.iter().enumerate().filter_map(drawn).collect()
    }
}

impl Patch {
    /// The chance that the original gave a ball to hold a flower of an approximated patch: the density
    /// times the area that the patch shares with the circle in which the ball cuts its plane, 1 at
    /// most.
    pub fn chance_within(&self, center: Position, radius: Length) -> f64 {
        let between = center.si() - self.center.si();
        let square = radius.get() * radius.get() - between.z * between.z;
        if square <= 0.0 || radius.get() < 0.0 {
            return 0.0;
        }
        let apart_m = math::hypot(between.x, between.y);
        let area_m2 = lens_m2(self.radius.get(), square.sqrt(), apart_m);
        (self.flowers_per_m2 * area_m2).clamp(0.0, 1.0)
    }
}

/// The area that two circles share, in square metres; `apart_m` is the distance of their middles.
///
/// Each circle gives its sector less the triangle of the chord:
/// `r^2 (alpha - sin(alpha) cos(alpha))` with `cos(alpha) = (d^2 + r^2 - R^2) / (2 d r)`.
fn lens_m2(first_m: f64, second_m: f64, apart_m: f64) -> f64 {
    let (small, large) = (first_m.min(second_m), first_m.max(second_m));
    if apart_m >= small + large {
        return 0.0;
    }
    if apart_m <= large - small {
        return PI * small * small;
    }
    let segment = |own: f64, other: f64| {
        let cos = (apart_m * apart_m + own * own - other * other) / (2.0 * apart_m * own);
        let alpha = math::acos(cos.clamp(-1.0, 1.0));
        let (sin, cos) = math::sin_cos(alpha);
        own * own * (alpha - sin * cos)
    };
    segment(small, large) + segment(large, small)
}

fn near<'w, T: 'w>(
    kind: ObjectKind,
    all: impl Iterator<Item = &'w T>,
    middle: impl Fn(&T) -> Position,
    center: Position,
    radius: Length,
) -> impl Iterator<Item = (ObjectId, &'w T)> {
    all.enumerate()
        .filter(move |(_, one)| center.distance(middle(one)) <= radius)
        .map(move |(index, one)| (ObjectId::new(kind, index as u32), one))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ObstacleShape;

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    fn patch() -> Patch {
        Patch {
            center: Position::from_xyz(3.0, 4.0, 1.0),
            radius: m(2.0),
            flowers_per_m2: 0.01,
            ..Patch::default()
        }
    }

    #[test]
    fn objects_are_found_by_their_middle() {
        let obstacle = Obstacle {
            position: Position::from_xyz(5.0, 0.0, 0.0),
            shape: ObstacleShape::Sphere { radius: m(1.0) },
            ..Obstacle::default()
        };
        let world = World {
            obstacles: vec![Obstacle::default(), obstacle],
            structures: vec![Structure::default()],
            people: vec![Person::default()],
            ..World::default()
        };
        let around = Position::from_xyz(5.0, 0.0, 1.0);
        let found: Vec<_> = world.obstacles_within(around, m(0.1)).collect();
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].0, ObjectId::new(ObjectKind::Obstacle, 1));
        let middle = Position::from_xyz(0.5, 0.5, 0.5);
        assert_eq!(world.structures_within(middle, m(0.0)).count(), 1);
        assert_eq!(world.structures_within(around, m(1.0)).count(), 0);
        // The original's own query for people did not work.
        let crown = Position::from_xyz(0.0, 0.0, 1.0);
        assert_eq!(world.people_within(crown, m(0.5)).count(), 1);
        assert_eq!(world.people_within(crown, m(0.4)).count(), 0);
        assert_eq!(world.terrain_within(crown, m(1e6)).count(), 0);
    }

    #[test]
    fn single_flowers_are_found_by_their_feet() {
        let world = World {
            patches: vec![Patch {
                flowers_per_m2: 10.0,
                ..patch()
            }],
            ..World::default()
        };
        let center = world.patches[0].center;
        let all = world.flowers_within(center, m(2.0), 7);
        assert_eq!(all, world.flowers(7));
        let inner = world.flowers_within(center, m(1.0), 7);
        assert!(inner.len() < all.len() / 2 && !inner.is_empty());
        assert!(inner.iter().all(|f| center.distance(f.foot) <= m(1.0)));
    }

    #[test]
    fn two_circles_share_what_the_closed_forms_say() {
        assert_eq!(lens_m2(1.0, 2.0, 3.0), 0.0);
        assert_eq!(lens_m2(1.0, 2.0, 0.5), PI);
        // Two unit circles through each other's middle: 2 pi / 3 - sqrt(3) / 2.
        let want = 2.0 * PI / 3.0 - 3.0_f64.sqrt() / 2.0;
        assert!((lens_m2(1.0, 1.0, 1.0) - want).abs() < 1e-12);
        assert!((lens_m2(2.0, 1.0, 1.0 + 1e-12) - PI).abs() < 1e-5);
    }

    #[test]
    fn the_chance_of_an_approximated_patch_is_density_times_shared_area() {
        let at = patch();
        let whole = at.chance_within(at.center, m(50.0));
        assert!((whole - 0.01 * PI * 4.0).abs() < 1e-12);
        // A ball 0.6 m above the patch with radius 1 m cuts a circle of 0.8 m.
        let above = at.center + Position::from_xyz(0.0, 0.0, 0.6);
        assert!((at.chance_within(above, m(1.0)) - 0.01 * PI * 0.64).abs() < 1e-12);
        assert_eq!(at.chance_within(above, m(0.5)), 0.0);
        let dense = Patch {
            flowers_per_m2: 9.0,
            ..at
        };
        assert_eq!(dense.chance_within(dense.center, m(50.0)), 1.0);
    }

    #[test]
    fn the_same_question_has_the_same_answer_and_many_questions_have_the_right_share() {
        let world = World {
            approximate_patches: true,
            patches: vec![Patch {
                flowers_per_m2: 0.1,
                ..patch()
            }],
            ..World::default()
        };
        let ask = |i: i32, seed| {
            let aside = Position::from_xyz(1e-6 * f64::from(i), 0.0, 0.0);
            world.flowers_within(world.patches[0].center + aside, m(1.0), seed)
        };
        assert!((0..100).all(|i| ask(i, 7) == ask(i, 7)));
        let found = (0..10_000).filter(|i| !ask(*i, 7).is_empty()).count();
        let share = found as f64 / 1e4;
        assert!((share - 0.1 * PI).abs() < 0.015, "{share}");
    }
}

//! The primitives that every object is made of.

use crate::look::{Color, Meta, Texture};
use simbeeotic_units::{Angle, Attitude, Length, Pose, Position, Yaw, math};

/// One primitive, standing somewhere. All rotations are about `z`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// What it is.
    pub shape: SolidShape,
    /// Where its middle is. For a cone: half way between base and tip.
    pub center: Position,
    /// How far it is turned about `z`, counter-clockwise from east.
    pub yaw: Yaw,
}

/// The shape of a [`Solid`], in its own frame: `z` up, the middle at the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SolidShape {
    /// A box: half its size along `x`, `y` and `z`.
    Box {
        /// Half the size along `x`.
        half_length: Length,
        /// Half the size along `y`.
        half_width: Length,
        /// Half the size along `z`.
        half_height: Length,
    },
    /// An upright cylinder.
    Cylinder {
        /// Its radius.
        radius: Length,
        /// Half its height.
        half_height: Length,
    },
    /// A sphere.
    Sphere {
        /// Its radius.
        radius: Length,
    },
    /// An upright cone, tip up.
    Cone {
        /// The radius of its base.
        radius: Length,
        /// Half its height.
        half_height: Length,
    },
}

impl Solid {
    /// Its pose: where its own frame stands in the world.
    pub fn pose(&self) -> Pose {
        Pose {
            position: self.center,
            attitude: Attitude::from_yaw(self.yaw),
        }
    }

    /// A box that is turned about a vertical axis through `pivot`; `low` and `high` are two
    /// opposite corners before the turn, relative to the pivot, in metres.
    pub(crate) fn turned_box(
        pivot: Position,
        turn_rad: f64,
        low_m: [f64; 3],
        high_m: [f64; 3],
    ) -> Self {
        let middle = |i: usize| 0.5 * (low_m[i] + high_m[i]);
        let half = |i: usize| Length::si(0.5 * (high_m[i] - low_m[i]));
        let (sin, cos) = math::sin_cos(turn_rad);
        let (x, y) = (middle(0), middle(1));
        let offset = Position::new(
            Length::si(cos * x - sin * y),
            Length::si(sin * x + cos * y),
            Length::si(middle(2)),
        );
        let shape = SolidShape::Box {
            half_length: half(0),
            half_width: half(1),
            half_height: half(2),
        };
        Self {
            shape,
            center: pivot + offset,
            yaw: Yaw::new(Angle::si(turn_rad)),
        }
    }
}

/// What an [`Object`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum ObjectKind {
    /// Something in the way.
    Obstacle,
    /// A wall or a slab.
    Structure,
    /// A flower, or a patch of them.
    Flower,
    /// A person.
    Person,
}

/// One object of the world as primitives, with what is known about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Object<'w> {
    /// What it is.
    pub kind: ObjectKind,
    /// Which one of its kind, from 0; for a flower, the index of its patch.
    pub index: usize,
    /// What it is called; empty if nothing.
    pub label: &'w str,
    /// Its colour.
    pub color: Color,
    /// Its texture, if it has one.
    pub texture: Option<&'w Texture>,
    /// What is attached to it.
    pub meta: &'w Meta,
    /// What it is made of.
    pub solids: Vec<Solid>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_turns_about_its_pivot_and_not_about_its_middle() {
        let pivot = Position::new(Length::si(10.0), Length::si(20.0), Length::ZERO);
        let quarter = 0.5 * std::f64::consts::PI;
        let solid = Solid::turned_box(pivot, quarter, [0.0, 0.0, 0.0], [4.0, 2.0, 3.0]);
        let center = solid.center.si();
        assert!(
            (center - glam::DVec3::new(9.0, 22.0, 1.5)).length() < 1e-12,
            "{center}"
        );
    }
}

//! Stages, looks and what is known about models, as messages and back.
//!
//! A stage is one `foxglove.SceneUpdate`: the ground, then an entity for each run of props that differ in nothing but
//! where they stand, since viewers draw one entity of ten thousand flowers faster than ten thousand of one. Its
//! metadata begins with `kind`, `label`, `color`, `texture` and `pieces`; what is written on the props follows.
//! `pieces` says of how many props the entity is, and of what each is made: the lists of the entity hold the first
//! prop's, then the second's, and so on.
//!
//! There are no capsules in a scene: each is a cylinder and two spheres, behind the others of its prop.

mod about;
mod cloud;
mod pack;
mod solids;
mod unpack;

pub(crate) use about::{pack_about, unpack_about};
pub(crate) use cloud::{cloud_of, cloud_of_vehicles, move_cloud};
pub(crate) use pack::{look_of, scene_of};
pub(crate) use solids::{STRING, STRING_FIELDS, solids_of};
pub(crate) use unpack::{pieces_of_look, stage_of};

use crate::stage::{Form, Piece};

/// How many primitives of each list a prop has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Layout {
    cubes: usize,
    spheres: usize,
    cylinders: usize,
    capsules: usize,
    triangles: usize,
}

impl Layout {
    fn of(pieces: &[Piece]) -> Self {
        let mut layout = Self::default();
        for piece in pieces {
            *match piece.form {
                Form::Box { .. } => &mut layout.cubes,
                Form::Sphere { .. } => &mut layout.spheres,
                Form::Cylinder { .. } => &mut layout.cylinders,
                Form::Capsule { .. } => &mut layout.capsules,
                Form::Mesh { .. } => &mut layout.triangles,
            } += 1;
        }
        layout
    }

    fn write(&self, props: usize) -> String {
        let Self {
            cubes,
            spheres,
            cylinders,
            capsules,
            triangles,
        } = self;
        format!(
            "props={props} cubes={cubes} spheres={spheres} cylinders={cylinders} capsules={capsules} \
             triangles={triangles}"
        )
    }

    /// The number of props and what each has; `None` if the text says something else.
    fn read(text: &str) -> Option<(usize, Self)> {
        let mut words = text.split(' ');
        let mut number = |name: &str| {
            let word = words.next()?.strip_prefix(name)?;
            word.strip_prefix('=')?.parse().ok()
        };
        let props = number("props")?;
        let layout = Self {
            cubes: number("cubes")?,
            spheres: number("spheres")?,
            cylinders: number("cylinders")?,
            capsules: number("capsules")?,
            triangles: number("triangles")?,
        };
        words.next().is_none().then_some((props, layout))
    }
}

#[cfg(test)]
mod tests;

//! The world as a whole.

use crate::flower::{FlowerShape, Patch};
use crate::look::{Color, Texture};
use crate::obstacle::Obstacle;
use crate::person::Person;
use crate::solid::{Object, ObjectKind};
use crate::structure::Structure;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_units::Length;

/// Everything that stands in the world, as a world file says it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct World {
    /// How far the world reaches from the origin. It bounds views, not flight. Above 0; 10 km.
    pub radius: Length,
    /// Whether a patch of flowers is one flat disc instead of single flowers.
    pub approximate_patches: bool,
    /// The plane `z = 0`.
    pub ground: Ground,
    /// The size of every single flower.
    pub flower: FlowerShape,
    /// Things in the way.
    #[serde(rename = "obstacle")]
    pub obstacles: Vec<Obstacle>,
    /// Walls and slabs.
    #[serde(rename = "structure")]
    pub structures: Vec<Structure>,
    /// Patches of flowers.
    #[serde(rename = "patch")]
    pub patches: Vec<Patch>,
    /// People.
    #[serde(rename = "person")]
    pub people: Vec<Person>,
}

impl Default for World {
    fn default() -> Self {
        Self {
            radius: Length::si(10_000.0),
            approximate_patches: false,
            ground: Ground::default(),
            flower: FlowerShape::default(),
            obstacles: Vec::new(),
            structures: Vec::new(),
            patches: Vec::new(),
            people: Vec::new(),
        }
    }
}

impl World {
    /// All objects but the ground, as primitives: obstacles, structures, flowers, people, each in
    /// the order of the file.
    ///
    /// `seed` decides where the flowers of a patch stand (see [`World::flowers`]).
    pub fn objects(&self, seed: u64) -> Vec<Object<'_>> {
        let mut all = Vec::new();
        all.extend(self.obstacles.iter().enumerate().map(|(index, o)| Object {
            kind: ObjectKind::Obstacle,
            index,
            label: &o.label,
            color: o.color,
            texture: o.texture.as_ref(),
            meta: &o.meta,
            solids: vec![o.solid()],
        }));
        all.extend(self.structures.iter().enumerate().map(|(index, s)| Object {
            kind: ObjectKind::Structure,
            index,
            label: &s.label,
            color: s.color,
            texture: s.texture.as_ref(),
            meta: &s.meta,
            solids: s.solids(),
        }));
        all.extend(self.flower_objects(seed));
        all.extend(self.people.iter().enumerate().map(|(index, p)| Object {
            kind: ObjectKind::Person,
            index,
            label: &p.label,
            color: p.color,
            texture: None,
            meta: &p.meta,
            solids: p.solids(),
        }));
        all
    }
}

/// How the ground looks. It is the plane `z = 0`, without end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Ground {
    /// Its colour.
    pub color: Color,
    /// Its texture, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub texture: Option<Texture>,
}

impl Default for Ground {
    fn default() -> Self {
        Self {
            color: Color::rgb(20, 70, 30),
            texture: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Obstacle, ObstacleShape, Person, Structure};

    #[test]
    fn the_default_world_is_an_empty_plane_of_ten_kilometres() {
        let world = World::default();
        assert_eq!(world.radius, Length::si(10_000.0));
        assert!(world.objects(1).is_empty());
        assert!(world.check().is_empty());
    }

    #[test]
    fn objects_come_by_kind_in_the_order_of_the_file() {
        let world = World {
            people: vec![Person::default()],
            structures: vec![Structure::default()],
            obstacles: vec![
                Obstacle::default(),
                Obstacle {
                    shape: ObstacleShape::Sphere {
                        radius: Length::si(2.0),
                    },
                    ..Obstacle::default()
                },
            ],
            ..World::default()
        };
        let kinds: Vec<_> = world.objects(0).iter().map(|o| (o.kind, o.index)).collect();
        assert_eq!(
            kinds,
            [
                (ObjectKind::Obstacle, 0),
                (ObjectKind::Obstacle, 1),
                (ObjectKind::Structure, 0),
                (ObjectKind::Person, 0)
            ]
        );
    }
}

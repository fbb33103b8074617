//! The world as a whole.

use crate::flower::{FlowerShape, Patch};
use crate::light::Light;
use crate::look::{Color, Meta, Texture};
use crate::material::{BUILT_IN, Material};
use crate::obstacle::Obstacle;
use crate::person::Person;
use crate::plume::Source;
use crate::solid::{Object, ObjectId, ObjectKind};
use crate::spawn::{Place, Spawn};
use crate::structure::Structure;
use crate::surface::Surface;
use crate::terrain::{Terrain, green};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_units::Length;
use std::path::PathBuf;

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
    /// Uneven ground, if there is any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub terrain: Option<Terrain>,
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
    /// Lamps.
    #[serde(rename = "light", skip_serializing_if = "Vec::is_empty")]
    pub lights: Vec<Light>,
    /// Sources of smell or gas.
    #[serde(rename = "source", skip_serializing_if = "Vec::is_empty")]
    pub sources: Vec<Source>,
    /// What things are made of, besides what is built in.
    #[serde(rename = "material", skip_serializing_if = "Vec::is_empty")]
    pub materials: Vec<Material>,
    /// Areas where vehicles may start.
    #[serde(rename = "spawn", skip_serializing_if = "Vec::is_empty")]
    pub spawns: Vec<Spawn>,
    /// Places with a name.
    #[serde(rename = "place", skip_serializing_if = "Vec::is_empty")]
    pub places: Vec<Place>,
    /// The folder from which the names of texture files count: that of the world file. No part of the file;
    /// `None` if there is no such texture.
    #[serde(skip)]
    pub folder: Option<PathBuf>,
}

impl Default for World {
    fn default() -> Self {
        Self {
            radius: Length::si(10_000.0),
            approximate_patches: false,
            ground: Ground::default(),
            terrain: None,
            flower: FlowerShape::default(),
            obstacles: Vec::new(),
            structures: Vec::new(),
            patches: Vec::new(),
            people: Vec::new(),
            lights: Vec::new(),
            sources: Vec::new(),
            materials: Vec::new(),
            spawns: Vec::new(),
            places: Vec::new(),
            folder: None,
        }
    }
}

impl World {
    /// All objects but the plane of the ground, as primitives: obstacles, structures, flowers,
    /// people, each in the order of the file, and the terrain.
    ///
    /// `seed` decides where the flowers of a patch stand (see [`World::flowers`]).
    pub fn objects(&self, seed: u64) -> Vec<Object<'_>> {
        let mut all = Vec::new();
        all.extend(self.obstacles.iter().enumerate().map(|(index, o)| {
            let material = self.known_material(o.material.as_deref());
            Object {
                id: ObjectId::new(ObjectKind::Obstacle, index as u32),
                label: &o.label,
                color: Self::color(o.color, material, Obstacle::COLOR),
                texture: o.texture.as_ref(),
                meta: &o.meta,
                surface: Self::surface(o.friction, o.restitution, material),
                material,
                solids: o.solids(),
            }
        }));
        all.extend(self.structures.iter().enumerate().map(|(index, s)| {
            let material = self.known_material(s.material.as_deref());
            Object {
                id: ObjectId::new(ObjectKind::Structure, index as u32),
                label: &s.label,
                color: Self::color(s.color, material, Structure::COLOR),
                texture: s.texture.as_ref(),
                meta: &s.meta,
                surface: Self::surface(s.friction, s.restitution, material),
                material,
                solids: s.solids(),
            }
        }));
        all.extend(self.flower_objects(seed));
        all.extend(self.people.iter().enumerate().map(|(index, p)| {
            let material = self.known_material(p.material.as_deref());
            Object {
                id: ObjectId::new(ObjectKind::Person, index as u32),
                label: &p.label,
                color: Self::color(p.color, material, Person::COLOR),
                texture: None,
                meta: &p.meta,
                surface: Self::surface(p.friction, p.restitution, material),
                material,
                solids: p.solids(),
            }
        }));
        all.extend(self.terrain.iter().enumerate().map(|(index, t)| {
            let material = self.known_material(t.material.as_deref());
            Object {
                id: ObjectId::new(ObjectKind::Terrain, index as u32),
                label: &t.label,
                color: Self::color(t.color, material, Terrain::COLOR),
                texture: t.texture.as_ref(),
                meta: &t.meta,
                surface: Self::surface(t.friction, t.restitution, material),
                material,
                solids: vec![t.solid()],
            }
        }));
        all
    }

    /// The colour of an object: its own, its material's, or that of its kind.
    pub(crate) fn color(own: Option<Color>, material: Option<&Material>, usual: Color) -> Color {
        own.or(material.and_then(|m| m.color)).unwrap_or(usual)
    }

    /// How an object feels: what it says itself, what its material says, or what is usual.
    pub(crate) fn surface(
        friction: Option<f64>,
        restitution: Option<f64>,
        material: Option<&Material>,
    ) -> Surface {
        let usual = Surface::USUAL;
        let material = material.map(|m| (m.friction, m.restitution));
        let (m_friction, m_restitution) = material.unwrap_or_default();
        Surface {
            friction: friction.or(m_friction).unwrap_or(usual.friction),
            restitution: restitution.or(m_restitution).unwrap_or(usual.restitution),
        }
    }

    /// The material of this name: one of this world, or one that is built in.
    pub fn material(&self, name: &str) -> Option<&Material> {
        let own = self.materials.iter().find(|m| m.name == name);
        own.or_else(|| BUILT_IN.iter().find(|m| m.name == name))
    }

    pub(crate) fn known_material(&self, name: Option<&str>) -> Option<&Material> {
        self.material(name?)
    }

    /// What an object (of a flower: its patch) is made of, if that is known.
    pub fn material_of(&self, object: ObjectId) -> Option<&Material> {
        let at = object.index as usize;
        let name = match object.kind {
            ObjectKind::Obstacle => self.obstacles.get(at)?.material.as_deref(),
            ObjectKind::Structure => self.structures.get(at)?.material.as_deref(),
            ObjectKind::Flower => self.patches.get(at)?.material.as_deref(),
            ObjectKind::Person => self.people.get(at)?.material.as_deref(),
            ObjectKind::Terrain => self.terrain.as_ref()?.material.as_deref(),
        };
        self.known_material(name)
    }

    /// The place of this name.
    pub fn place(&self, name: &str) -> Option<&Place> {
        self.places.iter().find(|place| place.name == name)
    }

    /// The area of this name where vehicles may start.
    pub fn spawn(&self, name: &str) -> Option<&Spawn> {
        self.spawns.iter().find(|spawn| spawn.name == name)
    }

    /// What an object is called (of a flower: its patch); empty if nothing, or if there is no such
    /// object.
    pub fn label_of(&self, object: ObjectId) -> &str {
        self.words_of(object).map_or("", |(label, _)| label)
    }

    /// What is attached to an object (of a flower: to its patch). `None` if there is no such object.
    pub fn meta_of(&self, object: ObjectId) -> Option<&Meta> {
        self.words_of(object).map(|(_, meta)| meta)
    }

    fn words_of(&self, object: ObjectId) -> Option<(&str, &Meta)> {
        let at = object.index as usize;
        Some(match object.kind {
            ObjectKind::Obstacle => self.obstacles.get(at).map(|o| (&*o.label, &o.meta))?,
            ObjectKind::Structure => self.structures.get(at).map(|s| (&*s.label, &s.meta))?,
            ObjectKind::Flower => self.patches.get(at).map(|p| (&*p.label, &p.meta))?,
            ObjectKind::Person => self.people.get(at).map(|p| (&*p.label, &p.meta))?,
            ObjectKind::Terrain => self.terrain.as_ref().map(|t| (&*t.label, &t.meta))?,
        })
    }
}

/// How the ground looks and feels. It is the plane `z = 0`, without end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Ground {
    /// Its Coulomb friction, 0 to 1000, unless the scenario says another. 0.5 if neither does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Its restitution, 0 to 1, unless the scenario says another. 0 if neither does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Its colour.
    pub color: Color,
    /// Its texture, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub texture: Option<Texture>,
}

impl Default for Ground {
    fn default() -> Self {
        Self {
            friction: None,
            restitution: None,
            color: green(),
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
    fn labels_and_metadata_are_found_by_object() {
        let tower = Obstacle {
            label: "tower".into(),
            meta: Meta::from([("height".into(), "12".into())]),
            ..Obstacle::default()
        };
        let world = World {
            obstacles: vec![Obstacle::default(), tower],
            ..World::default()
        };
        let tower = ObjectId::new(ObjectKind::Obstacle, 1);
        assert_eq!(world.label_of(tower), "tower");
        assert_eq!(world.meta_of(tower).expect("it is there")["height"], "12");
        let nobody = ObjectId::new(ObjectKind::Person, 1);
        assert_eq!((world.label_of(nobody), world.meta_of(nobody)), ("", None));
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
        let kinds: Vec<_> = world
            .objects(0)
            .iter()
            .map(|o| (o.id.kind, o.id.index))
            .collect();
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

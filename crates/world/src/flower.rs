//! Flowers, in patches.
//!
//! A patch says how many flowers stand on a square metre; where each of them stands is drawn from
//! the scenario's seed, uniformly over the disc: `r = R sqrt(u)`, `phi = 2 pi v`.

use crate::look::{Color, Meta};
use crate::solid::{Object, ObjectId, ObjectKind, Solid, SolidShape};
use crate::world::World;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_kernel::rng::Stream;
use simbeeotic_units::{Attitude, Length, Position, math};
use std::f64::consts::{PI, TAU};

/// A disc with flowers on it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Patch {
    /// The middle of the disc; its height is that of the flowers' feet.
    pub center: Position,
    /// The radius of the disc. Above 0.
    pub radius: Length,
    /// How many flowers stand on one square metre. Not negative.
    pub flowers_per_m2: f64,
    /// What its flowers are made of: a material of this world or one that is built in.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Coulomb friction of its flowers, 0 to 1000. Their material's, or 0.5, if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Restitution of its flowers: how much of a speed is left after a bounce, 0 to 1. Their
    /// material's, or 0, if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// The colour of the flowers. Their material's, or `#ff6697`, if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// What it is called. A patch with a label keeps its flowers where they are when other patches
    /// come and go.
    #[serde(default)]
    pub label: String,
    /// Names and values that contacts and sensors can read.
    #[serde(default)]
    pub meta: Meta,
}

impl Default for Patch {
    fn default() -> Self {
        Self {
            center: Position::ZERO,
            radius: Length::si(1.0),
            flowers_per_m2: 1.0,
            material: None,
            friction: None,
            restitution: None,
            color: None,
            label: String::new(),
            meta: Meta::new(),
        }
    }
}

impl Patch {
    /// The colour of flowers that have neither one of their own nor a material with one.
    pub const COLOR: Color = Color::rgb(255, 102, 151);

    /// How many flowers it has: the area times the density, cut to a whole number.
    pub fn count(&self) -> usize {
        let radius_m = self.radius.get();
        (PI * radius_m * radius_m * self.flowers_per_m2).max(0.0) as usize
    }
}

/// The size of one flower: a stem, and a flat head on it. All sizes are above 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FlowerShape {
    /// From the ground to the head.
    pub stem_height: Length,
    /// How thick the stem is.
    pub stem_radius: Length,
    /// How thick the head is.
    pub head_height: Length,
    /// How wide the head is.
    pub head_radius: Length,
}

impl Default for FlowerShape {
    fn default() -> Self {
        Self {
            stem_height: Length::si(0.2),
            stem_radius: Length::si(0.01),
            head_height: Length::si(0.02),
            head_radius: Length::si(0.1),
        }
    }
}

/// One flower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flower {
    /// Its patch, by index.
    pub patch: usize,
    /// Which of its patch it is, from 0.
    pub item: u32,
    /// Where its stem leaves the ground.
    pub foot: Position,
}

impl Flower {
    /// Which object of the world it is.
    pub const fn id(&self) -> ObjectId {
        ObjectId {
            item: self.item,
            ..ObjectId::new(ObjectKind::Flower, self.patch as u32)
        }
    }
}

/// Half the thickness of a patch that is drawn as one disc, in metres.
const DISC_HALF_HEIGHT_M: f64 = 0.01;
/// The opacity of such a disc.
const DISC_ALPHA: u8 = 128;

impl World {
    /// Every single flower, patch by patch, whether or not patches are approximated.
    ///
    /// The same `seed` gives the same flowers; a patch's draws depend on its label, or on its
    /// index if it has none, and on no other patch.
    pub fn flowers(&self, seed: u64) -> Vec<Flower> {
        let mut all = Vec::new();
        for (patch, at) in self.patches.iter().enumerate() {
            let mut stream = Stream::new(seed, &self.patch_path(patch), "flowers");
            all.extend((0..at.count()).map(|item| {
                let radius_m = at.radius.get() * stream.uniform().sqrt();
                let (sin, cos) = math::sin_cos(TAU * stream.uniform());
                let offset = Position::new(
                    Length::si(radius_m * cos),
                    Length::si(radius_m * sin),
                    Length::ZERO,
                );
                Flower {
                    patch,
                    item: item as u32,
                    foot: at.center + offset,
                }
            }));
        }
        all
    }

    /// What a patch's draws hang on.
    pub(crate) fn patch_path(&self, patch: usize) -> String {
        match self.patches[patch].label.as_str() {
            "" => format!("world/patch-{patch}"),
            label => format!("world/{label}"),
        }
    }

    pub(crate) fn flower_objects(&self, seed: u64) -> Vec<Object<'_>> {
        let object = |id: ObjectId, alpha: Option<u8>, solids| {
            let patch = &self.patches[id.index as usize];
            let material = self.known_material(patch.material.as_deref());
            let color = Self::color(patch.color, material, Patch::COLOR);
            Object {
                id,
                label: &patch.label,
                color: Color {
                    alpha: alpha.unwrap_or(color.alpha),
                    ..color
                },
                texture: None,
                meta: &patch.meta,
                surface: Self::surface(patch.friction, patch.restitution, material),
                material,
                solids,
            }
        };
        if self.approximate_patches {
            let patches = self.patches.iter().enumerate().map(|(at, patch)| {
                let id = ObjectId::new(ObjectKind::Flower, at as u32);
                object(id, Some(DISC_ALPHA), vec![disc(patch)])
            });
            return patches.collect();
        }
        let flowers = self.flowers(seed).into_iter();
        flowers
            .map(|flower| object(flower.id(), None, self.flower.solids(flower.foot)))
            .collect()
    }
}

fn disc(patch: &Patch) -> Solid {
    let half_height = Length::si(DISC_HALF_HEIGHT_M);
    upright(
        patch.center,
        half_height,
        SolidShape::Cylinder {
            radius: patch.radius,
            half_height,
        },
    )
}

fn upright(foot: Position, middle: Length, shape: SolidShape) -> Solid {
    let up = Position::new(Length::ZERO, Length::ZERO, middle);
    Solid {
        shape,
        center: foot + up,
        attitude: Attitude::IDENTITY,
    }
}

impl FlowerShape {
    /// Stem and head of a flower at `foot`.
    pub fn solids(&self, foot: Position) -> Vec<Solid> {
        let stem = SolidShape::Cylinder {
            radius: self.stem_radius,
            half_height: self.stem_height * 0.5,
        };
        let head = SolidShape::Cylinder {
            radius: self.head_radius,
            half_height: self.head_height * 0.5,
        };
        vec![
            upright(foot, self.stem_height * 0.5, stem),
            upright(foot, self.stem_height + self.head_height * 0.5, head),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn meadow() -> World {
        let patch = Patch {
            center: Position::new(Length::si(3.0), Length::si(-2.0), Length::si(1.0)),
            radius: Length::si(12.0),
            flowers_per_m2: 0.5,
            ..Patch::default()
        };
        World {
            patches: vec![
                patch.clone(),
                Patch {
                    label: "b".into(),
                    ..patch
                },
            ],
            ..World::default()
        }
    }

    #[test]
    fn every_flower_stands_inside_its_circle_and_on_its_height() {
        let world = meadow();
        let flowers = world.flowers(7);
        assert_eq!(flowers.len(), 2 * 226, "int(pi 12^2 0.5) each");
        for flower in &flowers {
            let d = flower.foot.si() - world.patches[flower.patch].center.si();
            assert!(d.length() <= 12.0 && d.z == 0.0, "{d}");
        }
    }

    #[test]
    fn flowers_fill_the_disc_evenly() {
        let mut world = meadow();
        world.patches[0].flowers_per_m2 = 50.0;
        let middle = world.patches[0].center.si();
        let flowers = world.flowers(3);
        let first: Vec<_> = flowers.iter().filter(|f| f.patch == 0).collect();
        let inner = first
            .iter()
            .filter(|f| (f.foot.si() - middle).length() < 6.0)
            .count();
        let share = inner as f64 / first.len() as f64;
        assert!(
            (share - 0.25).abs() < 0.01,
            "a quarter of the area holds {share}"
        );
    }

    #[test]
    fn the_seed_places_them_and_a_label_keeps_them() {
        let world = meadow();
        assert_eq!(world.flowers(7), world.flowers(7));
        assert_ne!(world.flowers(7), world.flowers(8));
        let feet = |w: &World, patch| -> Vec<_> {
            w.flowers(7)
                .into_iter()
                .filter(|f| f.patch == patch)
                .map(|f| f.foot)
                .collect()
        };
        let mut fewer = world.clone();
        fewer.patches.remove(0);
        assert_eq!(feet(&fewer, 0), feet(&world, 1), "patch b did not move");
    }

    #[test]
    fn an_approximate_patch_is_one_disc() {
        let world = World {
            approximate_patches: true,
            ..meadow()
        };
        let objects = world.objects(1);
        assert_eq!(objects.len(), 2);
        assert_eq!(objects[0].color.alpha, 128);
    }
}

//! A world as one number.

use crate::look::Meta;
use crate::solid::{Object, Solid, SolidShape};
use crate::spawn::SpawnShape;
use crate::world::World;
use glam::DVec3;
use simbeeotic_kernel::rng::mix;
use simbeeotic_units::Length;

/// 64 bits that stand for all objects, places and areas of a world: equal worlds have equal ones, and two that differ
/// anywhere (a place, a colour, a word of metadata) differ here, up to chance.
///
/// It folds the bits of numbers, not their text; flowers are those of seed 0.
pub fn fingerprint(world: &World) -> u64 {
    let mut fold = Fold(0);
    fold.number(world.radius.get());
    for object in world.objects(0) {
        fold.object(&object);
    }
    for place in &world.places {
        fold.text(&place.name);
        fold.points(std::iter::once(place.position.si()));
        fold.lengths(0, &[place.radius]);
        fold.meta(&place.meta);
    }
    for spawn in &world.spawns {
        fold.text(&spawn.name);
        fold.meta(&spawn.meta);
        if let SpawnShape::Box { from, size } = &spawn.shape {
            fold.points([from.si(), size.si()].into_iter());
        }
    }
    fold.0
}

struct Fold(u64);

impl Fold {
    fn word(&mut self, word: u64) {
        self.0 = mix(self.0 ^ word).wrapping_add(word);
    }

    fn number(&mut self, number: f64) {
        self.word(number.to_bits());
    }

    fn text(&mut self, text: &str) {
        self.word(text.len() as u64);
        for byte in text.bytes() {
            self.word(u64::from(byte));
        }
    }

    fn lengths(&mut self, kind: u64, lengths: &[Length]) {
        self.word(kind);
        for length in lengths {
            self.number(length.get());
        }
    }

    fn points(&mut self, points: impl Iterator<Item = DVec3>) {
        for point in points {
            for x in point.to_array() {
                self.number(x);
            }
        }
    }

    fn meta(&mut self, meta: &Meta) {
        self.word(meta.len() as u64);
        for (key, value) in meta {
            self.text(key);
            self.text(value);
        }
    }

    fn object(&mut self, object: &Object<'_>) {
        self.word(object.id.key());
        self.text(object.label);
        let c = object.color;
        self.word(u64::from(u32::from_be_bytes([
            c.red, c.green, c.blue, c.alpha,
        ])));
        self.text(object.material.map_or("", |m| &m.name));
        self.meta(object.meta);
        self.number(object.surface.friction);
        self.number(object.surface.restitution);
        for solid in &object.solids {
            self.solid(solid);
        }
    }

    fn solid(&mut self, solid: &Solid) {
        self.points(std::iter::once(solid.center.si()));
        for x in solid.attitude.quat().to_array() {
            self.number(x);
        }
        match &solid.shape {
            SolidShape::Box {
                half_length,
                half_width,
                half_height,
            } => self.lengths(1, &[*half_length, *half_width, *half_height]),
            SolidShape::Cylinder {
                radius,
                half_height,
            } => self.lengths(2, &[*radius, *half_height]),
            SolidShape::Sphere { radius } => self.lengths(3, &[*radius]),
            SolidShape::Cone {
                radius,
                half_height,
            } => self.lengths(4, &[*radius, *half_height]),
            SolidShape::Capsule {
                radius,
                half_height,
            } => self.lengths(5, &[*radius, *half_height]),
            SolidShape::Hull { points } => {
                self.word(6);
                self.points(points.iter().map(|p| p.si()));
            }
            SolidShape::Mesh { points, triangles } => {
                self.word(7);
                self.points(points.iter().map(|p| p.si()));
                for corner in triangles.iter().flatten() {
                    self.word(u64::from(*corner));
                }
            }
            SolidShape::HeightField {
                length,
                width,
                columns,
                heights,
            } => {
                self.lengths(8, &[*length, *width]);
                self.word(*columns as u64);
                self.lengths(8, heights);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Obstacle, Structure};

    #[test]
    fn whatever_changes_in_a_world_changes_its_fingerprint() {
        let world = World {
            obstacles: vec![Obstacle::default()],
            structures: vec![Structure::default()],
            ..World::default()
        };
        let mut all = vec![fingerprint(&world)];
        let changes: [fn(&mut World); 8] = [
            |w| w.radius = Length::si(1.0),
            |w| w.obstacles[0].label = "x".into(),
            |w| w.obstacles[0].color = Some(crate::Color::rgb(1, 2, 3)),
            |w| w.obstacles[0].friction = Some(0.75),
            |w| w.structures[0].position = simbeeotic_units::Position::from_xyz(0.0, 1e-9, 0.0),
            |w| drop(w.structures[0].meta.insert("a".into(), "b".into())),
            |w| w.structures.push(Structure::default()),
            |w| w.obstacles[0].material = Some("ceiling-board".into()),
        ];
        for change in changes {
            let mut other = world.clone();
            change(&mut other);
            all.push(fingerprint(&other));
        }
        let count = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), count);
    }
}

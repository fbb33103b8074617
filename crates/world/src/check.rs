//! What a world cannot be: sizes that are not above zero, doors wider than their wall.

use crate::flower::Patch;
use crate::obstacle::{Obstacle, ObstacleShape};
use crate::person::{Person, PersonShape};
use crate::structure::{Structure, StructureShape};
use crate::world::World;
use simbeeotic_units::Length;

/// Something in a world that cannot be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{path}: {message}")]
pub struct WorldError {
    /// Where in the world file: keys and indices with dots, `obstacle.3.shape.box.height`.
    pub path: String,
    /// What is wrong.
    pub message: String,
}

/// More single flowers than this are refused: they would not fit into memory as bodies.
const FLOWERS_MAX: usize = 10_000_000;

impl World {
    /// Everything that is wrong with the numbers of this world; empty if it can be.
    pub fn check(&self) -> Vec<WorldError> {
        let mut faults = Faults {
            path: String::new(),
            found: Vec::new(),
        };
        faults.positive("radius", self.radius);
        faults.within("flower", |f| {
            f.positive("stem_height", self.flower.stem_height);
            f.positive("stem_radius", self.flower.stem_radius);
            f.positive("head_height", self.flower.head_height);
            f.positive("head_radius", self.flower.head_radius);
        });
        for (i, obstacle) in self.obstacles.iter().enumerate() {
            faults.within(&format!("obstacle.{i}"), |f| f.obstacle(obstacle));
        }
        for (i, structure) in self.structures.iter().enumerate() {
            faults.within(&format!("structure.{i}"), |f| f.structure(structure));
        }
        for (i, patch) in self.patches.iter().enumerate() {
            faults.within(&format!("patch.{i}"), |f| f.patch(patch));
        }
        for (i, person) in self.people.iter().enumerate() {
            faults.within(&format!("person.{i}"), |f| f.person(person));
        }
        faults.found
    }
}

struct Faults {
    path: String,
    found: Vec<WorldError>,
}

impl Faults {
    fn within(&mut self, key: &str, look: impl FnOnce(&mut Self)) {
        let outside = self.path.len();
        if !self.path.is_empty() {
            self.path.push('.');
        }
        self.path.push_str(key);
        look(self);
        self.path.truncate(outside);
    }

    fn fault(&mut self, key: &str, message: String) {
        let mut path = String::new();
        self.within(key, |f| path.clone_from(&f.path));
        self.found.push(WorldError { path, message });
    }

    fn positive(&mut self, key: &str, size: Length) {
        if !(size.get() > 0.0 && size.is_finite()) {
            self.fault(key, format!("`{key}` must be more than 0 m, not {size}"));
        }
    }

    fn at_least_zero(&mut self, key: &str, size: Length) {
        if !(size.get() >= 0.0 && size.is_finite()) {
            self.fault(key, format!("`{key}` must not be negative, as {size} is"));
        }
    }

    fn fits(&mut self, key: &str, what: &str, from: Length, size: Length, room: Length) {
        // A hair of slack, for sums of decimal fractions: 0.1 + 0.2 fits into 0.3.
        if (from + size).get() > room.get() + 1e-9 {
            let end = from + size;
            self.fault(
                key,
                format!("the {what} ends at {end}, past the end of the whole at {room}"),
            );
        }
    }

    fn obstacle(&mut self, obstacle: &Obstacle) {
        self.within("shape", |f| match obstacle.shape {
            ObstacleShape::Box {
                length,
                width,
                height,
                ..
            } => {
                f.within("box", |f| f.sizes(length, width, height));
            }
            ObstacleShape::Cylinder { diameter, height } => f.within("cylinder", |f| {
                f.positive("diameter", diameter);
                f.positive("height", height);
            }),
            ObstacleShape::Sphere { radius } => {
                f.within("sphere", |f| f.positive("radius", radius))
            }
            ObstacleShape::Cone { radius, height } => f.within("cone", |f| {
                f.positive("radius", radius);
                f.positive("height", height);
            }),
        });
    }

    fn structure(&mut self, structure: &Structure) {
        self.within("shape", |f| match structure.shape {
            StructureShape::Wall {
                length,
                width,
                height,
                door,
                ..
            } => f.within("wall", |f| {
                f.sizes(length, width, height);
                let Some(door) = door else { return };
                f.within("door", |f| {
                    f.at_least_zero("position", door.position);
                    f.positive("width", door.width);
                    f.positive("height", door.height);
                    f.fits("width", "door", door.position, door.width, length);
                    f.fits("height", "door", Length::ZERO, door.height, height);
                });
            }),
            StructureShape::Surface {
                length,
                width,
                height,
                trap,
                ..
            } => {
                f.within("surface", |f| {
                    f.sizes(length, width, height);
                    let Some(trap) = trap else { return };
                    f.within("trap", |f| {
                        f.at_least_zero("x", trap.x);
                        f.at_least_zero("y", trap.y);
                        f.positive("length", trap.length);
                        f.positive("width", trap.width);
                        f.fits("length", "trap", trap.x, trap.length, length);
                        f.fits("width", "trap", trap.y, trap.width, width);
                    });
                });
            }
        });
    }

    fn patch(&mut self, patch: &Patch) {
        self.positive("radius", patch.radius);
        if !(patch.flowers_per_m2 >= 0.0 && patch.flowers_per_m2.is_finite()) {
            let density = patch.flowers_per_m2;
            self.fault(
                "flowers_per_m2",
                format!("a density must not be negative, as {density} is"),
            );
        } else if patch.count() > FLOWERS_MAX {
            let count = patch.count();
            let message = format!("{count} flowers in one patch are more than {FLOWERS_MAX}");
            self.fault("flowers_per_m2", message);
        }
    }

    fn person(&mut self, person: &Person) {
        let PersonShape::Man { width, height } = person.shape;
        self.within("shape.man", |f| {
            f.positive("width", width);
            f.positive("height", height);
        });
    }

    fn sizes(&mut self, length: Length, width: Length, height: Length) {
        self.positive("length", length);
        self.positive("width", width);
        self.positive("height", height);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::{Door, Trap};
    use simbeeotic_units::Angle;

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    #[test]
    fn all_that_cannot_be_is_found_with_its_place() {
        let world = World {
            radius: m(0.0),
            obstacles: vec![
                Obstacle::default(),
                Obstacle {
                    shape: ObstacleShape::Sphere { radius: m(-1.0) },
                    ..Obstacle::default()
                },
            ],
            structures: vec![
                Structure {
                    shape: StructureShape::Wall {
                        length: m(2.0),
                        width: m(0.1),
                        height: m(2.0),
                        rotation: Angle::ZERO,
                        door: Some(Door {
                            position: m(1.5),
                            width: m(1.0),
                            height: m(3.0),
                        }),
                    },
                    ..Structure::default()
                },
                Structure {
                    shape: StructureShape::Surface {
                        length: m(0.3),
                        width: m(2.0),
                        height: m(2.0),
                        rotation: Angle::ZERO,
                        trap: Some(Trap {
                            x: m(0.1),
                            y: m(-1.0),
                            length: m(0.2),
                            width: m(1.0),
                        }),
                    },
                    ..Structure::default()
                },
            ],
            patches: vec![
                Patch {
                    flowers_per_m2: -1.0,
                    ..Patch::default()
                },
                Patch {
                    flowers_per_m2: 1e300,
                    ..Patch::default()
                },
            ],
            people: vec![Person {
                shape: PersonShape::Man {
                    width: m(0.0),
                    height: m(1.0),
                },
                ..Person::default()
            }],
            ..World::default()
        };
        let paths: Vec<_> = world.check().into_iter().map(|e| e.path).collect();
        assert_eq!(
            paths,
            [
                "radius",
                "obstacle.1.shape.sphere.radius",
                "structure.0.shape.wall.door.width",
                "structure.0.shape.wall.door.height",
                "structure.1.shape.surface.trap.y",
                "patch.0.flowers_per_m2",
                "patch.1.flowers_per_m2",
                "person.0.shape.man.width",
            ]
        );
    }
}

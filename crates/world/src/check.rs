//! What a world cannot be: sizes that are not above zero, doors wider than their wall.

use crate::flower::Patch;
use crate::obstacle::{Obstacle, ObstaclePart, ObstacleShape};
use crate::person::{Person, PersonShape};
use crate::structure::{Structure, StructureShape};
use crate::surface::FRICTION_MAX;
use crate::terrain::Terrain;
use crate::world::World;
use simbeeotic_units::{Length, Offset};

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
/// No thing is larger than this, in metres.
const SIZE_M_MAX: f64 = 1e5;
/// No thing stands farther from the origin than this along an axis, in metres.
const PLACE_M_MAX: f64 = 1e7;

impl World {
    /// Everything that is wrong with the numbers of this world; empty if it can be.
    ///
    /// Sizes are above zero and at most 100 km, places at most 10,000 km from the origin along each
    /// axis. Whether the points of a hull or a mesh make a body, physics says.
    pub fn check(&self) -> Vec<WorldError> {
        let mut faults = Faults {
            path: String::new(),
            found: Vec::new(),
        };
        faults.positive("radius", self.radius);
        faults.within("ground", |f| {
            f.friction(self.ground.friction.unwrap_or(0.0));
            f.restitution(self.ground.restitution.unwrap_or(0.0));
        });
        faults.within("flower", |f| {
            f.size("stem_height", self.flower.stem_height);
            f.size("stem_radius", self.flower.stem_radius);
            f.size("head_height", self.flower.head_height);
            f.size("head_radius", self.flower.head_radius);
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
        if let Some(terrain) = &self.terrain {
            faults.within("terrain", |f| f.terrain(terrain));
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

    /// The size of a thing: above zero, and no mistake in a unit.
    fn size(&mut self, key: &str, size: Length) {
        self.positive(key, size);
        if size.get() > SIZE_M_MAX {
            let most = Length::si(SIZE_M_MAX);
            self.fault(
                key,
                format!("`{key}` is {size}; at most {most} are possible"),
            );
        }
    }

    fn at_least_zero(&mut self, key: &str, size: Length) {
        if !(size.get() >= 0.0 && size.is_finite()) {
            self.fault(key, format!("`{key}` must not be negative, as {size} is"));
        }
    }

    fn place(&mut self, key: &str, place: glam::DVec3, most_m: f64) {
        // False for what is no number, too.
        let near = |x: f64| x.abs() <= most_m;
        if !place.to_array().into_iter().all(near) {
            let most = Length::si(most_m);
            self.fault(
                key,
                format!("this is farther than {most} away along an axis"),
            );
        }
    }

    fn friction(&mut self, friction: f64) {
        if !(0.0..=FRICTION_MAX).contains(&friction) {
            let message =
                format!("a friction lies between 0 and {FRICTION_MAX}, not at {friction}");
            self.fault("friction", message);
        }
    }

    fn restitution(&mut self, restitution: f64) {
        if !(0.0..=1.0).contains(&restitution) {
            let message = format!("a restitution lies between 0 and 1, not at {restitution}");
            self.fault("restitution", message);
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
        self.place("position", obstacle.position.si(), PLACE_M_MAX);
        self.friction(obstacle.friction);
        self.restitution(obstacle.restitution);
        self.within("shape", |f| match &obstacle.shape {
            ObstacleShape::Parts(parts) => f.parts(parts),
            shape => f.shape(shape),
        });
    }

    fn parts(&mut self, parts: &[ObstaclePart]) {
        if parts.is_empty() {
            self.fault("parts", "an obstacle of no parts is none".into());
        }
        for (i, part) in parts.iter().enumerate() {
            self.within(&format!("parts.{i}"), |f| {
                f.place("position", part.position.si(), SIZE_M_MAX);
                f.within("shape", |f| f.shape(&part.shape));
            });
        }
    }

    /// A shape without parts.
    fn shape(&mut self, shape: &ObstacleShape) {
        match shape {
            &ObstacleShape::Box {
                length,
                width,
                height,
                ..
            } => self.within("box", |f| f.sizes(length, width, height)),
            &ObstacleShape::Cylinder { diameter, height } => self.within("cylinder", |f| {
                f.size("diameter", diameter);
                f.size("height", height);
            }),
            &ObstacleShape::Sphere { radius } => {
                self.within("sphere", |f| f.size("radius", radius));
            }
            &ObstacleShape::Cone { radius, height } => self.within("cone", |f| {
                f.size("radius", radius);
                f.size("height", height);
            }),
            &ObstacleShape::Capsule { radius, height } => self.within("capsule", |f| {
                f.size("radius", radius);
                f.size("height", height);
                if height <= radius * 2.0 {
                    let ends = radius * 2.0;
                    let message = format!(
                        "a capsule with ends of {radius} is higher than {ends}, not {height}: at {ends} it is a sphere"
                    );
                    f.fault("height", message);
                }
            }),
            ObstacleShape::Hull { points } => self.within("hull", |f| {
                f.points(points, 4, "a hull");
            }),
            ObstacleShape::Mesh { points, triangles } => self.within("mesh", |f| {
                f.points(points, 3, "a mesh");
                f.triangles(triangles, points.len());
            }),
            ObstacleShape::Parts(_) => {
                self.fault("parts", "a part has no parts of its own".into());
            }
        }
    }

    fn points(&mut self, points: &[Offset], least: usize, what: &str) {
        if points.len() < least {
            let message = format!("{what} has {least} points or more, not {}", points.len());
            self.fault("points", message);
        }
        self.within("points", |f| {
            for (i, point) in points.iter().enumerate() {
                f.place(&i.to_string(), point.si(), SIZE_M_MAX);
            }
        });
    }

    fn triangles(&mut self, triangles: &[[u32; 3]], points: usize) {
        if triangles.is_empty() {
            self.fault("triangles", "a mesh has one triangle or more".into());
        }
        self.within("triangles", |f| {
            for (i, corners) in triangles.iter().enumerate() {
                if let Some(corner) = corners.iter().find(|c| **c as usize >= points) {
                    let message =
                        format!("there is no point {corner}: there are {points}, counted from 0");
                    f.fault(&i.to_string(), message);
                } else if corners[0] == corners[1]
                    || corners[1] == corners[2]
                    || corners[2] == corners[0]
                {
                    f.fault(&i.to_string(), "a triangle has three corners".into());
                }
            }
        });
    }

    fn terrain(&mut self, terrain: &Terrain) {
        self.place("position", terrain.position.si(), PLACE_M_MAX);
        self.friction(terrain.friction);
        self.restitution(terrain.restitution);
        let field = &terrain.height_field;
        self.within("height_field", |f| {
            f.size("length", field.length);
            f.size("width", field.width);
            if field.heights.len() < 2 {
                let message = format!("a grid has two rows or more, not {}", field.heights.len());
                f.fault("heights", message);
            }
            let columns = field.heights.first().map_or(0, Vec::len);
            f.within("heights", |f| {
                for (i, row) in field.heights.iter().enumerate() {
                    f.row(&i.to_string(), row, columns);
                }
            });
        });
    }

    fn row(&mut self, key: &str, row: &[Length], columns: usize) {
        if row.len() < 2 {
            let message = format!("a row of a grid has two heights or more, not {}", row.len());
            self.fault(key, message);
        } else if row.len() != columns {
            let message = format!("this row has {} heights, the first {columns}", row.len());
            self.fault(key, message);
        }
        self.within(key, |f| {
            for (i, height) in row.iter().enumerate() {
                f.place(&i.to_string(), glam::DVec3::splat(height.get()), SIZE_M_MAX);
            }
        });
    }

    fn structure(&mut self, structure: &Structure) {
        self.place("position", structure.position.si(), PLACE_M_MAX);
        self.friction(structure.friction);
        self.restitution(structure.restitution);
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
        self.place("center", patch.center.si(), PLACE_M_MAX);
        self.size("radius", patch.radius);
        self.friction(patch.friction);
        self.restitution(patch.restitution);
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
        self.place("position", person.position.si(), PLACE_M_MAX);
        self.friction(person.friction);
        self.restitution(person.restitution);
        let PersonShape::Man { width, height } = person.shape;
        self.within("shape.man", |f| {
            f.size("width", width);
            f.size("height", height);
        });
    }

    fn sizes(&mut self, length: Length, width: Length, height: Length) {
        self.size("length", length);
        self.size("width", width);
        self.size("height", height);
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
    fn paths(world: &World) -> Vec<String> {
        world.check().into_iter().map(|e| e.path).collect()
    }

    fn obstacle(shape: ObstacleShape) -> Obstacle {
        Obstacle {
            shape,
            ..Obstacle::default()
        }
    }

    #[test]
    fn shapes_of_points_are_checked_point_by_point() {
        let corner = |x: f64| Offset::from_xyz(x, 0.0, 0.0);
        let part = |shape| ObstaclePart {
            position: Offset::ZERO,
            attitude: simbeeotic_units::Attitude::IDENTITY,
            shape,
        };
        let world = World {
            obstacles: vec![
                obstacle(ObstacleShape::Capsule {
                    radius: m(1.0),
                    height: m(2.0),
                }),
                obstacle(ObstacleShape::Hull {
                    points: vec![corner(0.0), corner(1.0), corner(1e6)],
                }),
                obstacle(ObstacleShape::Mesh {
                    points: vec![corner(0.0), corner(1.0), corner(2.0)],
                    triangles: vec![[0, 1, 2], [0, 1, 3], [0, 1, 1]],
                }),
                obstacle(ObstacleShape::Parts(Vec::new())),
                obstacle(ObstacleShape::Parts(vec![
                    part(ObstacleShape::Sphere { radius: m(0.0) }),
                    part(ObstacleShape::Parts(Vec::new())),
                ])),
            ],
            ..World::default()
        };
        assert_eq!(
            paths(&world),
            [
                "obstacle.0.shape.capsule.height",
                "obstacle.1.shape.hull.points",
                "obstacle.1.shape.hull.points.2",
                "obstacle.2.shape.mesh.triangles.1",
                "obstacle.2.shape.mesh.triangles.2",
                "obstacle.3.shape.parts",
                "obstacle.4.shape.parts.0.shape.sphere.radius",
                "obstacle.4.shape.parts.1.shape.parts",
            ]
        );
    }

    #[test]
    fn a_grid_has_equal_rows_and_surfaces_have_their_ranges() {
        let mut terrain = Terrain::new(crate::HeightField {
            length: m(10.0),
            width: m(0.0),
            heights: vec![vec![m(0.0); 3], vec![m(0.0), m(1e9)], vec![m(0.0)]],
        });
        terrain.friction = -1.0;
        let world = World {
            ground: crate::Ground {
                restitution: Some(1.5),
                ..crate::Ground::default()
            },
            obstacles: vec![Obstacle {
                position: simbeeotic_units::Position::from_xyz(0.0, 0.0, 1e8),
                friction: f64::NAN,
                ..Obstacle::default()
            }],
            terrain: Some(terrain),
            ..World::default()
        };
        assert_eq!(
            paths(&world),
            [
                "ground.restitution",
                "obstacle.0.position",
                "obstacle.0.friction",
                "terrain.friction",
                "terrain.height_field.width",
                "terrain.height_field.heights.1",
                "terrain.height_field.heights.1.1",
                "terrain.height_field.heights.2",
            ]
        );
    }
}

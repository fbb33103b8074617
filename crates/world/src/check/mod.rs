//! What a world cannot be: sizes that are not above zero, doors wider than their wall.

mod named;
mod shape;

use crate::flower::Patch;
use crate::person::{Person, PersonShape};
use crate::surface::FRICTION_MAX;
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
    /// What is allowed, or what was probably meant, if there is something to say.
    pub help: Option<String>,
}

/// More single flowers than this are refused: they would not fit into memory as bodies.
const FLOWERS_MAX: usize = 10_000_000;
/// No thing is larger than this, in metres.
const SIZE_M_MAX: f64 = 1e5;
/// No thing is smaller than this, in metres: physics wants half extents of 1 nm.
const SIZE_M_MIN: f64 = 2e-9;
/// No person is smaller than this, in metres: the neck is one cell of thirteen.
const MAN_M_MIN: f64 = 14.0 * SIZE_M_MIN;
/// No thing stands farther from the origin than this along an axis, in metres.
const PLACE_M_MAX: f64 = 1e7;

impl World {
    /// Everything that is wrong with the numbers of this world; empty if it can be.
    ///
    /// Sizes are at least 2 nm and at most 100 km, places at most 10,000 km from the origin along each
    /// axis. Whether the points of a hull or a mesh make a body, physics says.
    pub fn check(&self) -> Vec<WorldError> {
        let mut faults = Faults {
            world: self,
            path: String::new(),
            found: Vec::new(),
        };
        faults.positive("radius", self.radius);
        faults.within("ground", |f| {
            f.feel(self.ground.friction, self.ground.restitution);
            f.texture(self.ground.texture.as_ref());
        });
        faults.within("flower", |f| {
            f.size("stem_height", self.flower.stem_height);
            f.size("stem_radius", self.flower.stem_radius);
            f.size("head_height", self.flower.head_height);
            f.size("head_radius", self.flower.head_radius);
        });
        for (i, obstacle) in self.obstacles.iter().enumerate() {
            faults.within(&format!("obstacle.{i}"), |f| {
                f.obstacle(obstacle);
                f.made_of(obstacle.material.as_deref());
            });
        }
        for (i, structure) in self.structures.iter().enumerate() {
            faults.within(&format!("structure.{i}"), |f| {
                f.structure(structure);
                f.made_of(structure.material.as_deref());
            });
        }
        for (i, patch) in self.patches.iter().enumerate() {
            faults.within(&format!("patch.{i}"), |f| {
                f.patch(patch);
                f.made_of(patch.material.as_deref());
            });
        }
        for (i, person) in self.people.iter().enumerate() {
            faults.within(&format!("person.{i}"), |f| {
                f.person(person);
                f.made_of(person.material.as_deref());
            });
        }
        for (i, light) in self.lights.iter().enumerate() {
            faults.within(&format!("light.{i}"), |f| {
                f.place("position", light.position.si(), PLACE_M_MAX);
                f.size("radius", light.radius);
                f.all(light.faults());
            });
        }
        for (i, source) in self.sources.iter().enumerate() {
            faults.within(&format!("source.{i}"), |f| {
                f.place("position", source.position.si(), PLACE_M_MAX);
                f.size("radius", source.radius);
                f.all(source.faults());
            });
        }
        if let Some(terrain) = &self.terrain {
            faults.within("terrain", |f| {
                f.terrain(terrain);
                f.made_of(terrain.material.as_deref());
            });
        }
        for (i, material) in self.materials.iter().enumerate() {
            faults.within(&format!("material.{i}"), |f| f.material(material));
        }
        for (i, spawn) in self.spawns.iter().enumerate() {
            faults.within(&format!("spawn.{i}"), |f| f.spawn(spawn));
        }
        for (i, place) in self.places.iter().enumerate() {
            faults.within(&format!("place.{i}"), |f| f.named_place(place));
        }
        faults.names(self);
        faults.found
    }
}

struct Faults<'w> {
    world: &'w World,
    path: String,
    found: Vec<WorldError>,
}

impl Faults<'_> {
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
        self.found.push(WorldError {
            path,
            message,
            help: None,
        });
    }

    /// A fault of what is looked at itself.
    fn fault_here(&mut self, message: String) {
        self.found.push(WorldError {
            path: self.path.clone(),
            message,
            help: None,
        });
    }

    fn fault_with_help(&mut self, key: &str, message: String, help: String) {
        self.fault(key, message);
        if let Some(last) = self.found.last_mut() {
            last.help = Some(help);
        }
    }

    fn above_zero(&mut self, key: &str, number: f64) {
        if !(number > 0.0 && number.is_finite()) {
            self.fault(key, format!("`{key}` must be more than 0, not {number}"));
        }
    }

    fn all(&mut self, faults: Vec<(&'static str, String)>) {
        for (key, message) in faults {
            self.fault(key, message);
        }
    }

    fn positive(&mut self, key: &str, size: Length) {
        if !(size.get() > 0.0 && size.is_finite()) {
            self.fault(key, format!("`{key}` must be more than 0 m, not {size}"));
        }
    }

    /// The size of a thing: above zero, and no mistake in a unit.
    fn size(&mut self, key: &str, size: Length) {
        self.size_from(key, size, SIZE_M_MIN);
    }

    /// The same of a thing whose smallest part is as large as physics wants it at `least_m`.
    fn size_from(&mut self, key: &str, size: Length, least_m: f64) {
        self.positive(key, size);
        if size.get() > 0.0 && size.get() < least_m {
            let least_nm = least_m * 1e9;
            let size_m = size.get();
            self.fault(
                key,
                format!("`{key}` is {size_m:e} m; at least {least_nm} nm are possible"),
            );
        }
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

    /// Friction and restitution, where they are said.
    fn feel(&mut self, friction: Option<f64>, restitution: Option<f64>) {
        self.friction(friction.unwrap_or(0.0));
        self.restitution(restitution.unwrap_or(0.0));
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

    fn patch(&mut self, patch: &Patch) {
        self.place("center", patch.center.si(), PLACE_M_MAX);
        self.size("radius", patch.radius);
        self.feel(patch.friction, patch.restitution);
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
        self.feel(person.friction, person.restitution);
        let PersonShape::Man { width, height } = person.shape;
        self.within("shape.man", |f| {
            f.size_from("width", width, MAN_M_MIN);
            f.size_from("height", height, MAN_M_MIN);
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
    use crate::obstacle::{Obstacle, ObstaclePart, ObstacleShape};
    use crate::structure::{Door, Slab, Structure, StructureShape, Trap, Wall, Window};
    use crate::terrain::Terrain;
    use simbeeotic_units::Offset;

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
                    shape: StructureShape::Wall(Wall {
                        length: m(2.0),
                        width: m(0.1),
                        height: m(2.0),
                        doors: vec![Door {
                            position: m(1.5),
                            width: m(1.0),
                            height: m(3.0),
                        }],
                        windows: vec![
                            Window {
                                position: m(0.5),
                                sill: m(1.5),
                                width: m(0.5),
                                height: m(1.0),
                            },
                            Window {
                                position: m(0.5),
                                sill: m(1.0),
                                width: m(0.5),
                                height: m(0.6),
                            },
                        ],
                        ..Wall::default()
                    }),
                    ..Structure::default()
                },
                Structure {
                    shape: StructureShape::Surface(Slab {
                        length: m(0.3),
                        width: m(2.0),
                        height: m(2.0),
                        traps: vec![Trap {
                            x: m(0.1),
                            y: m(-1.0),
                            length: m(0.2),
                            width: m(1.0),
                        }],
                        ..Slab::default()
                    }),
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
                "structure.0.shape.wall.doors.0.width",
                "structure.0.shape.wall.doors.0.height",
                "structure.0.shape.wall.windows.0.height",
                "structure.0.shape.wall.windows.1",
                "structure.1.shape.surface.traps.0.y",
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
    fn what_is_too_small_for_physics_is_too_small_here() {
        let tiny = |size: f64| {
            [
                ObstacleShape::Sphere { radius: m(size) },
                ObstacleShape::Box {
                    length: m(1.0),
                    width: m(1.0),
                    height: m(size),
                    rotation: simbeeotic_units::Angle::ZERO,
                },
            ]
        };
        for size in [1e-300, 1.9e-9] {
            let world = World {
                obstacles: tiny(size).map(obstacle).to_vec(),
                ..World::default()
            };
            let wanted = [
                "obstacle.0.shape.sphere.radius",
                "obstacle.1.shape.box.height",
            ];
            assert_eq!(paths(&world), wanted);
        }
        let world = World {
            obstacles: tiny(2e-9).map(obstacle).to_vec(),
            ..World::default()
        };
        assert!(world.check().is_empty());
        let man = |height: f64| World {
            people: vec![Person {
                shape: PersonShape::Man {
                    width: m(1.0),
                    height: m(height),
                },
                ..Person::default()
            }],
            ..World::default()
        };
        assert_eq!(paths(&man(2e-8)), ["person.0.shape.man.height"]);
        assert!(man(3e-8).check().is_empty());
        let capsule = |height: f64| World {
            obstacles: vec![obstacle(ObstacleShape::Capsule {
                radius: m(1.0),
                height: m(height),
            })],
            ..World::default()
        };
        let almost_a_sphere = paths(&capsule(2.0 + 1e-9));
        assert_eq!(almost_a_sphere, ["obstacle.0.shape.capsule.height"]);
        assert!(capsule(2.0 + 1e-8).check().is_empty());
        let sphere = ObstacleShape::Sphere { radius: m(1e-300) };
        let world = World {
            obstacles: vec![obstacle(sphere)],
            ..World::default()
        };
        assert_eq!(
            world.check()[0].message,
            "`radius` is 1e-300 m; at least 2 nm are possible"
        );
    }

    #[test]
    fn a_mesh_without_area_is_refused() {
        let with = |scale: f64, corners: [[f64; 3]; 3]| World {
            obstacles: vec![obstacle(ObstacleShape::Mesh(crate::Mesh {
                points: corners
                    .map(|c| c.map(|x| scale * x))
                    .map(|[x, y, z]| Offset::from_xyz(x, y, z))
                    .into(),
                triangles: [[0, 1, 2]].into(),
                ..crate::Mesh::default()
            }))],
            ..World::default()
        };
        let corner = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let line = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]];
        let flat = ["obstacle.0.shape.mesh.triangles"];
        assert_eq!(paths(&with(1e-300, corner)), flat);
        assert_eq!(paths(&with(0.0, corner)), flat);
        assert_eq!(paths(&with(1.0, line)), flat);
        assert!(with(1e-3, corner).check().is_empty());
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
                obstacle(ObstacleShape::Hull(crate::Hull {
                    points: [corner(0.0), corner(1.0), corner(1e6)].into(),
                    ..crate::Hull::default()
                })),
                obstacle(ObstacleShape::Mesh(crate::Mesh {
                    points: [corner(0.0), corner(1.0), corner(2.0)].into(),
                    triangles: [[0, 1, 2], [0, 1, 3], [0, 1, 1]].into(),
                    ..crate::Mesh::default()
                })),
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
            ..crate::HeightField::default()
        });
        terrain.friction = Some(-1.0);
        let world = World {
            ground: crate::Ground {
                restitution: Some(1.5),
                ..crate::Ground::default()
            },
            obstacles: vec![Obstacle {
                position: simbeeotic_units::Position::from_xyz(0.0, 0.0, 1e8),
                friction: Some(f64::NAN),
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

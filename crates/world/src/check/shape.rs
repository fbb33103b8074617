//! What shapes cannot be.

use super::{Faults, PLACE_M_MAX, SIZE_M_MAX, SIZE_M_MIN};
use crate::cut::Rectangle;
use crate::obstacle::{Obstacle, ObstaclePart, ObstacleShape};
use crate::structure::{Slab, Structure, StructureShape, Wall};
use crate::terrain::Terrain;
use simbeeotic_units::{Length, Offset};

impl Faults<'_> {
    pub(super) fn obstacle(&mut self, obstacle: &Obstacle) {
        self.place("position", obstacle.position.si(), PLACE_M_MAX);
        self.feel(obstacle.friction, obstacle.restitution);
        self.texture(obstacle.texture.as_ref());
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
                // The straight part has a size of its own.
                if height <= radius * 2.0 || (height - radius * 2.0).get() < SIZE_M_MIN {
                    let ends = radius * 2.0;
                    let message = format!(
                        "a capsule with ends of {radius} is higher than {ends}, not {height}: at {ends} it is a sphere"
                    );
                    f.fault("height", message);
                }
            }),
            ObstacleShape::Hull(hull) => self.within("hull", |f| {
                f.above_zero("scale", hull.scale);
                if hull.file.is_none() {
                    f.points(&hull.points, 4, "a hull");
                }
            }),
            ObstacleShape::Mesh(mesh) => self.within("mesh", |f| {
                f.above_zero("scale", mesh.scale);
                if mesh.file.is_none() {
                    f.points(&mesh.points, 3, "a mesh");
                    f.triangles(&mesh.triangles, &mesh.points);
                }
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

    fn triangles(&mut self, triangles: &[[u32; 3]], corners: &[Offset]) {
        let (before, points) = (self.found.len(), corners.len());
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
        let wide = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|i| corners[i as usize].si());
            (b - a).cross(c - a).length() > SIZE_M_MIN * SIZE_M_MIN
        };
        if self.found.len() == before && !triangles.iter().any(wide) {
            let message = "no triangle of this mesh has an area: is its scale right?";
            self.fault("triangles", message.into());
        }
    }

    pub(super) fn terrain(&mut self, terrain: &Terrain) {
        self.place("position", terrain.position.si(), PLACE_M_MAX);
        self.feel(terrain.friction, terrain.restitution);
        self.texture(terrain.texture.as_ref());
        let field = &terrain.height_field;
        if field.file.is_some() {
            return;
        }
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

    pub(super) fn structure(&mut self, structure: &Structure) {
        self.place("position", structure.position.si(), PLACE_M_MAX);
        self.feel(structure.friction, structure.restitution);
        self.texture(structure.texture.as_ref());
        self.within("shape", |f| match &structure.shape {
            StructureShape::Wall(wall) => f.within("wall", |f| f.wall(wall)),
            StructureShape::Surface(slab) => f.within("surface", |f| f.slab(slab)),
        });
    }

    fn wall(&mut self, wall: &Wall) {
        self.sizes(wall.length, wall.width, wall.height);
        let mut before = Vec::new();
        for (i, door) in wall.doors.iter().enumerate() {
            self.within(&format!("doors.{i}"), |f| {
                f.at_least_zero("position", door.position);
                f.positive("width", door.width);
                f.positive("height", door.height);
                f.fits("width", "door", door.position, door.width, wall.length);
                f.fits("height", "door", Length::ZERO, door.height, wall.height);
                f.apart(&mut before, door.opening(), "door");
            });
        }
        for (i, window) in wall.windows.iter().enumerate() {
            self.within(&format!("windows.{i}"), |f| {
                f.at_least_zero("position", window.position);
                f.at_least_zero("sill", window.sill);
                f.positive("width", window.width);
                f.positive("height", window.height);
                f.fits(
                    "width",
                    "window",
                    window.position,
                    window.width,
                    wall.length,
                );
                f.fits("height", "window", window.sill, window.height, wall.height);
                f.apart(&mut before, window.opening(), "window");
            });
        }
    }

    fn slab(&mut self, slab: &Slab) {
        self.sizes(slab.length, slab.width, slab.height);
        let mut before = Vec::new();
        for (i, trap) in slab.traps.iter().enumerate() {
            self.within(&format!("traps.{i}"), |f| {
                f.at_least_zero("x", trap.x);
                f.at_least_zero("y", trap.y);
                f.positive("length", trap.length);
                f.positive("width", trap.width);
                f.fits("length", "trap", trap.x, trap.length, slab.length);
                f.fits("width", "trap", trap.y, trap.width, slab.width);
                f.apart(&mut before, trap.opening(), "trap");
            });
        }
    }

    /// Two openings that overlap are a mistake: they would be one of another shape.
    fn apart(&mut self, before: &mut Vec<Rectangle>, opening: Rectangle, what: &str) {
        if before.iter().any(|other| other.overlaps(&opening)) {
            self.fault_here(format!("this {what} overlaps an opening before it"));
        }
        before.push(opening);
    }
}

//! A world being put together: walls with openings along lines, slabs with holes, furniture.
//!
//! Numbers are metres.

use crate::look::{Color, Meta};
use crate::obstacle::{Obstacle, ObstaclePart, ObstacleShape};
use crate::person::{Person, PersonShape};
use crate::spawn::{Place, Spawn, SpawnShape};
use crate::structure::{Door, Slab, Structure, StructureShape, Trap, Wall, Window};
use crate::world::World;
use glam::{DVec2, DVec3};
use simbeeotic_units::{Angle, Attitude, Length, Offset, Position, math};

/// How a thing looks, and what is written on it.
#[derive(Clone, Debug, Default)]
pub(super) struct Finish {
    /// That of the material if there is none.
    pub(super) color: Option<Color>,
    pub(super) material: Option<&'static str>,
    pub(super) label: String,
    pub(super) meta: Meta,
}

impl Finish {
    pub(super) fn new(material: &'static str, color: Color, label: impl Into<String>) -> Self {
        Self {
            color: Some(color),
            ..Self::of(material, label)
        }
    }

    /// Of a material, in its colour.
    pub(super) fn of(material: &'static str, label: impl Into<String>) -> Self {
        Self {
            color: None,
            material: Some(material),
            label: label.into(),
            meta: Meta::new(),
        }
    }

    pub(super) fn with(mut self, key: &str, value: impl ToString) -> Self {
        self.meta.insert(key.to_owned(), value.to_string());
        self
    }
}

/// Where a wall stands: a line on the plan, from foot to top, and how far it goes to each side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) from: DVec2,
    pub(super) to: DVec2,
    pub(super) foot: f64,
    pub(super) height: f64,
    /// Seen in the direction of the line.
    pub(super) right: f64,
    pub(super) left: f64,
}

/// A way through a wall: a door if `sill` is 0, else a window.
#[derive(Clone, Copy, Debug)]
pub(super) struct Opening {
    /// From the wall's beginning to the opening's.
    pub(super) at: f64,
    pub(super) width: f64,
    pub(super) sill: f64,
    pub(super) height: f64,
}

/// A rectangle on the plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rect {
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

impl Rect {
    pub(super) fn new(x: [f64; 2], y: [f64; 2]) -> Self {
        Self {
            low: DVec2::new(x[0], y[0]),
            high: DVec2::new(x[1], y[1]),
        }
    }

    pub(super) fn size(self) -> DVec2 {
        self.high - self.low
    }

    pub(super) fn middle(self) -> DVec2 {
        0.5 * (self.low + self.high)
    }
}

/// Walls that are shorter than this are left out.
const SHORTEST: f64 = 1e-6;

/// A world, and how things are put into it.
#[derive(Default)]
pub(super) struct Draft {
    pub(super) world: World,
}

impl Draft {
    /// A place with a name, so large.
    pub(super) fn place(&mut self, name: impl Into<String>, at: DVec3, radius: f64, meta: Meta) {
        self.world.places.push(Place {
            name: name.into(),
            position: Position::from_si(tidy(at)),
            radius: metres(radius),
            meta,
        });
    }

    /// An area to start in, by two opposite corners.
    pub(super) fn spawn(&mut self, name: &str, low: DVec3, high: DVec3) {
        self.world.spawns.push(Spawn {
            name: name.to_owned(),
            shape: SpawnShape::Box {
                from: Position::from_si(tidy(low)),
                size: Position::from_si(tidy(high - low)),
            },
            meta: Meta::new(),
        });
    }

    pub(super) fn person(&mut self, foot: DVec3, yaw: f64, size: [f64; 2], finish: &Finish) {
        self.world.people.push(Person {
            position: Position::from_si(tidy(foot)),
            shape: PersonShape::Man {
                width: metres(size[0]),
                height: metres(size[1]),
            },
            rotation: Angle::si(yaw),
            material: finish.material.map(str::to_owned),
            color: finish.color,
            label: finish.label.clone(),
            meta: finish.meta.clone(),
            ..Person::default()
        });
    }

    /// A wall along a line; the openings lie apart from each other.
    pub(super) fn wall(&mut self, line: Line, openings: &[Opening], finish: &Finish) {
        let way = line.to - line.from;
        let (length, width) = (way.length(), line.right + line.left);
        if length < SHORTEST || line.height < SHORTEST {
            return;
        }
        let along = match (way.x != 0.0, way.y != 0.0) {
            (true, true) => way / length,
            _ => way.signum() * way.abs().normalize_or_zero().round(),
        };
        let side = DVec2::new(-along.y, along.x);
        let low = line.from - side * line.right;
        let plain = openings.is_empty();
        // Along an axis and without openings it needs no turn: its corners are exact then.
        let (corner, length, width, rotation) = if along.x == 1.0 {
            (low, length, width, Angle::ZERO)
        } else if plain && along.y == 1.0 {
            (low - DVec2::X * width, width, length, Angle::ZERO)
        } else if plain && along.y == -1.0 {
            (low - DVec2::Y * length, width, length, Angle::ZERO)
        } else if plain && along.x == -1.0 {
            (low - DVec2::new(length, width), length, width, Angle::ZERO)
        } else {
            let turn = Angle::si(math::atan2(along.y, along.x));
            (low, length, width, turn)
        };
        let doors = openings.iter().filter(|o| o.sill <= 0.0);
        let windows = openings.iter().filter(|o| o.sill > 0.0);
        let shape = StructureShape::Wall(Wall {
            length: metres(length),
            width: metres(width),
            height: metres(line.height),
            rotation,
            doors: doors
                .map(|door| Door {
                    position: metres(door.at),
                    width: metres(door.width),
                    height: metres(door.height),
                })
                .collect(),
            windows: windows
                .map(|window| Window {
                    position: metres(window.at),
                    sill: metres(window.sill),
                    width: metres(window.width),
                    height: metres(window.height),
                })
                .collect(),
        });
        self.structure(corner.extend(line.foot), shape, finish);
    }

    /// A slab of a rectangle between two heights; holes lie apart from each other within it.
    pub(super) fn slab(&mut self, rect: Rect, z: [f64; 2], holes: &[Rect], finish: &Finish) {
        let size = rect.size();
        if size.min_element() < SHORTEST {
            return;
        }
        let shape = StructureShape::Surface(Slab {
            length: metres(size.x),
            width: metres(size.y),
            height: metres(z[1] - z[0]),
            rotation: Angle::ZERO,
            traps: holes
                .iter()
                .map(|hole| Trap {
                    x: metres(hole.low.x - rect.low.x),
                    y: metres(hole.low.y - rect.low.y),
                    length: metres(hole.size().x),
                    width: metres(hole.size().y),
                })
                .collect(),
        });
        self.structure(rect.low.extend(z[0]), shape, finish);
    }

    pub(super) fn structure(&mut self, corner: DVec3, shape: StructureShape, finish: &Finish) {
        self.world.structures.push(Structure {
            position: Position::from_si(tidy(corner)),
            shape,
            material: finish.material.map(str::to_owned),
            color: finish.color,
            label: finish.label.clone(),
            meta: finish.meta.clone(),
            ..Structure::default()
        });
    }

    /// An obstacle that stands at `foot`, turned by `yaw` (radians).
    pub(super) fn obstacle(
        &mut self,
        foot: DVec3,
        yaw: f64,
        shape: ObstacleShape,
        finish: &Finish,
    ) {
        self.world.obstacles.push(Obstacle {
            position: Position::from_si(tidy(foot)),
            attitude: turned(yaw),
            shape,
            material: finish.material.map(str::to_owned),
            color: finish.color,
            label: finish.label.clone(),
            meta: finish.meta.clone(),
            ..Obstacle::default()
        });
    }
}

fn turned(yaw: f64) -> Attitude {
    if yaw == 0.0 {
        Attitude::IDENTITY
    } else {
        Attitude::from_yaw(simbeeotic_units::Yaw::si(yaw))
    }
}

/// Sizes and places are whole micrometres, so that files are short and easy to read.
const PER_METRE: f64 = 1e6;

fn tidy(place: DVec3) -> DVec3 {
    // Plus zero: a place is 0 m, never -0 m.
    (place * PER_METRE).round() / PER_METRE + DVec3::ZERO
}

/// A size, a whole number of micrometres.
pub(super) fn metres(size: f64) -> Length {
    Length::si((size * PER_METRE).round() / PER_METRE)
}

/// A box as a shape of an obstacle.
pub(super) fn boxed(size: DVec3) -> ObstacleShape {
    ObstacleShape::Box {
        length: metres(size.x),
        width: metres(size.y),
        height: metres(size.z),
        rotation: Angle::ZERO,
    }
}

/// An upright cylinder as a shape of an obstacle.
pub(super) fn cylinder(diameter: f64, height: f64) -> ObstacleShape {
    ObstacleShape::Cylinder {
        diameter: metres(diameter),
        height: metres(height),
    }
}

/// One shape of an obstacle of parts, by its middle.
pub(super) fn part(middle: DVec3, shape: ObstacleShape) -> ObstaclePart {
    ObstaclePart {
        position: Offset::from_si(tidy(middle)),
        attitude: Attitude::IDENTITY,
        shape,
    }
}

/// A box of an obstacle of parts, by two opposite corners.
pub(super) fn block(low: [f64; 3], high: [f64; 3]) -> ObstaclePart {
    let (low, high) = (DVec3::from_array(low), DVec3::from_array(high));
    part(0.5 * (low + high), boxed(high - low))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::SolidShape;

    fn volume(world: &World) -> f64 {
        let solids = world.objects(0).into_iter().flat_map(|o| o.solids);
        solids
            .map(|s| match s.shape {
                SolidShape::Box {
                    half_length,
                    half_width,
                    half_height,
                } => 8.0 * half_length.get() * half_width.get() * half_height.get(),
                _ => 0.0,
            })
            .sum()
    }

    fn line(from: [f64; 2], to: [f64; 2]) -> Line {
        Line {
            from: from.into(),
            to: to.into(),
            foot: 1.0,
            height: 3.0,
            right: 0.1,
            left: 0.2,
        }
    }

    #[test]
    fn a_wall_lacks_its_openings_in_any_direction() {
        let openings = [
            (0.5, 0.9, 0.0, 2.0),
            (2.0, 0.9, 0.0, 2.0),
            (3.5, 1.0, 0.9, 1.2),
            (5.0, 0.8, 0.0, 2.1),
        ]
        .map(|(at, width, sill, height)| Opening {
            at,
            width,
            sill,
            height,
        });
        let open: f64 = openings.iter().map(|o| o.width * o.height).sum();
        for to in [
            [10.0, 0.0],
            [0.0, 10.0],
            [-10.0, 0.0],
            [0.0, -10.0],
            [6.0, 8.0],
        ] {
            let mut draft = Draft::default();
            draft.wall(line([0.0; 2], to), &openings, &Finish::default());
            let want = 0.3 * (30.0 - open);
            assert!((volume(&draft.world) - want).abs() < 1e-9, "{to:?}");
            assert!(draft.world.check().is_empty(), "{:?}", draft.world.check());
        }
    }

    #[test]
    fn a_wall_stands_on_the_side_it_was_told() {
        // Right of a line to the north is east.
        for (to, low, high) in [
            ([0.0, 4.0], [-0.2, 0.0], [0.1, 4.0]),
            ([4.0, 0.0], [0.0, -0.1], [4.0, 0.2]),
            ([-4.0, 0.0], [-4.0, -0.2], [0.0, 0.1]),
            ([0.0, -4.0], [-0.1, -4.0], [0.2, 0.0]),
        ] {
            let door = Opening {
                at: 0.0,
                width: 1.0,
                sill: 0.0,
                height: 3.0,
            };
            for openings in [&[][..], &[door][..]] {
                let mut draft = Draft::default();
                draft.wall(line([0.0; 2], to), openings, &Finish::default());
                let solids = draft.world.structures[0].solids();
                let [mut least, mut most] = [DVec3::INFINITY, DVec3::NEG_INFINITY];
                for solid in &solids {
                    let SolidShape::Box {
                        half_length,
                        half_width,
                        half_height,
                    } = solid.shape
                    else {
                        panic!("a wall is made of boxes");
                    };
                    let half = DVec3::new(half_length.get(), half_width.get(), half_height.get());
                    let half = (solid.attitude.matrix() * half).abs();
                    least = least.min(solid.center.si() - half);
                    most = most.max(solid.center.si() + half);
                }
                let (low, high) = (DVec2::from_array(low), DVec2::from_array(high));
                if openings.is_empty() {
                    assert!(least.truncate().abs_diff_eq(low, 1e-12), "{to:?} {least}");
                    assert!(most.truncate().abs_diff_eq(high, 1e-12), "{to:?} {most}");
                } else {
                    assert!(least.truncate().cmpge(low - 1e-12).all(), "{to:?}");
                    assert!(most.truncate().cmple(high + 1e-12).all(), "{to:?}");
                }
            }
        }
    }

    #[test]
    fn a_slab_lacks_all_its_holes() {
        let hole = |x: f64, y: f64| Rect::new([x, x + 1.0], [y, y + 0.5]);
        let holes = [
            hole(1.0, 1.0),
            hole(1.5, 3.0),
            hole(4.0, 1.2),
            hole(6.0, 0.0),
            hole(6.0, 0.5),
        ];
        for n in 0..=holes.len() {
            let mut draft = Draft::default();
            let rect = Rect::new([0.0, 8.0], [0.0, 5.0]);
            draft.slab(rect, [2.0, 2.2], &holes[..n], &Finish::default());
            let want = 0.2 * (40.0 - 0.5 * n as f64);
            assert!((volume(&draft.world) - want).abs() < 1e-9, "{n} holes");
            assert!(draft.world.check().is_empty());
        }
    }
}

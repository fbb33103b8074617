//! What stands in the rooms of an office: desks, chairs, tables, shelves, plants, each of a few
//! boxes, cylinders and balls.

use super::OfficeParams;
use super::room::Room;
use crate::generate::draft::{Draft, Finish, block, cylinder, part};
use crate::look::Color;
use crate::obstacle::{ObstaclePart, ObstacleShape};
use glam::{DVec2, DVec3};
use simbeeotic_kernel::rng::Stream;
use simbeeotic_units::Length;
use std::f64::consts::PI;

const DESK: Color = Color::rgb(206, 178, 132);
const CHAIRS: [Color; 3] = [
    Color::rgb(46, 62, 92),
    Color::rgb(112, 44, 44),
    Color::rgb(56, 56, 58),
];
const SHELF: Color = Color::rgb(156, 120, 84);
const POT: Color = Color::rgb(150, 84, 60);
const LEAVES: Color = Color::rgb(52, 122, 58);

/// A desk takes so much of the wall it stands at, and so far into the room with its chair.
const DESK_M: [f64; 2] = [1.8, 1.5];
const SHELF_M: [f64; 2] = [1.0, 0.36];

/// A room seen from its door: `u` along the wall of the corridor, `v` from the wall opposite
/// towards the corridor. Both begin at a wall's face.
struct View<'r> {
    room: &'r Room,
    size: DVec2,
    wall: f64,
}

impl View<'_> {
    /// A point of the room, and how what stands there is turned, if it looks to the corridor.
    fn place(&self, u: f64, v: f64) -> (DVec3, f64) {
        let (low, high) = (self.room.rect.low, self.room.rect.high);
        let half = 0.5 * self.wall;
        let (x, y, yaw) = if self.room.corridor_north {
            (low.x + half + u, low.y + half + v, 0.0)
        } else {
            (high.x - half - u, high.y - half - v, PI)
        };
        (DVec3::new(x, y, self.room.foot), yaw)
    }

    /// Where the door lies along `u`.
    fn door(&self, width: f64) -> [f64; 2] {
        let from = if self.room.corridor_north {
            self.room.door - self.room.rect.low.x - 0.5 * self.wall
        } else {
            self.room.rect.high.x - 0.5 * self.wall - self.room.door - width
        };
        [from, from + width]
    }

    /// Whether the walls at the beginning and at the end of `u` are free of doors.
    fn free_sides(&self) -> [bool; 2] {
        let (west, east) = (!self.room.west_door, !self.room.east_door);
        if self.room.corridor_north {
            [west, east]
        } else {
            [east, west]
        }
    }
}

/// Puts furniture into a room.
pub(super) fn furnish(draft: &mut Draft, p: &OfficeParams, room: &Room) {
    let wall = p.wall_thickness.get();
    let view = View {
        room,
        size: room.rect.size() - DVec2::splat(wall),
        wall,
    };
    let mut kind = room.chance(p.seed, "kind");
    let mut chance = room.chance(p.seed, "furniture");
    let large = view.size.min_element() >= 3.0;
    match kind.uniform() {
        u if u < 0.15 && large => meeting(draft, &view, &mut chance, p.furniture),
        u if u < 0.3 => storage(draft, &view, &mut chance, p.furniture),
        _ => desks(draft, &view, &mut chance, p.furniture),
    }
    plant(draft, p, &view, &mut chance);
}

fn put(draft: &mut Draft, view: &View<'_>, at: [f64; 2], turn: f64, thing: Thing) {
    let (foot, yaw) = view.place(at[0], at[1]);
    let finish = Finish {
        meta: view.room.meta(),
        ..Finish::new(thing.material, thing.color, thing.label)
    };
    draft.obstacle(foot, yaw + turn, ObstacleShape::Parts(thing.parts), &finish);
}

struct Thing {
    label: &'static str,
    material: &'static str,
    color: Color,
    parts: Vec<ObstaclePart>,
}

/// A desk as wide as this, its back at v = -0.35.
fn desk() -> Thing {
    Thing {
        label: "desk",
        material: "chipboard",
        color: DESK,
        parts: vec![
            block([-0.7, -0.35, 0.71], [0.7, 0.35, 0.75]),
            block([-0.68, -0.33, 0.0], [-0.64, 0.33, 0.71]),
            block([0.64, -0.33, 0.0], [0.68, 0.33, 0.71]),
            block([-0.3, -0.28, 0.75], [0.3, -0.22, 1.15]),
        ],
    }
}

fn chair(chance: &mut Stream) -> Thing {
    let color = CHAIRS[chance.below(CHAIRS.len() as u64) as usize];
    Thing {
        label: "chair",
        material: "wood",
        color,
        parts: vec![
            part(DVec3::new(0.0, 0.0, 0.02), cylinder(0.5, 0.04)),
            part(DVec3::new(0.0, 0.0, 0.23), cylinder(0.06, 0.4)),
            block([-0.22, -0.22, 0.43], [0.22, 0.22, 0.48]),
            block([-0.2, 0.18, 0.48], [0.2, 0.22, 0.92]),
        ],
    }
}

/// A shelf with its back at v = 0.
fn shelf() -> Thing {
    let [width, deep] = SHELF_M;
    let half = 0.5 * width;
    let mut parts = vec![
        block([-half, 0.0, 0.0], [half, 0.02, 1.8]),
        block([-half, 0.02, 0.0], [-half + 0.02, deep, 1.8]),
        block([half - 0.02, 0.02, 0.0], [half, deep, 1.8]),
    ];
    for board in 0..5 {
        let z = 0.1 + 0.42 * f64::from(board);
        parts.push(block(
            [-half + 0.02, 0.02, z],
            [half - 0.02, deep, z + 0.02],
        ));
    }
    Thing {
        label: "shelf",
        material: "chipboard",
        color: SHELF,
        parts,
    }
}

/// Desks along the wall opposite the door, each with a chair.
fn desks(draft: &mut Draft, view: &View<'_>, chance: &mut Stream, share: f64) {
    let [wide, deep] = DESK_M;
    if view.size.y < deep + 0.6 {
        return;
    }
    let count = (view.size.x / wide).floor();
    let pitch = view.size.x / count.max(1.0);
    for at in 0..count as u32 {
        // Drawn whether or not the desk is there: the next one's chair does not hang on it.
        let (there, turn) = (chance.bernoulli(share), 0.6 * (chance.uniform() - 0.5));
        let seat = chair(chance);
        if there {
            let u = pitch * (f64::from(at) + 0.5);
            put(draft, view, [u, 0.4], 0.0, desk());
            put(draft, view, [u, 1.1], turn, seat);
        }
    }
    let there = chance.bernoulli(share);
    let [_, free] = view.free_sides();
    // At the side, past the desks.
    let v = deep + 0.5 * SHELF_M[0] + 0.2;
    if there && free && v + 0.5 * SHELF_M[0] < view.size.y - 0.2 {
        put(draft, view, [view.size.x - 0.01, v], 0.5 * PI, shelf());
    }
}

/// A table with chairs around it.
fn meeting(draft: &mut Draft, view: &View<'_>, chance: &mut Stream, share: f64) {
    let half = 0.5 * (view.size.x - 1.8).min(2.8);
    let (u, v) = (0.5 * view.size.x, 0.5 * view.size.y);
    if chance.bernoulli(share) {
        let table = Thing {
            label: "table",
            material: "wood",
            color: DESK,
            parts: vec![
                block([-half, -0.5, 0.7], [half, 0.5, 0.75]),
                block([-half + 0.2, -0.2, 0.0], [-half + 0.3, 0.2, 0.7]),
                block([half - 0.3, -0.2, 0.0], [half - 0.2, 0.2, 0.7]),
            ],
        };
        put(draft, view, [u, v], 0.0, table);
    }
    let seats = ((2.0 * half) / 0.7).floor();
    for at in 0..seats as u32 {
        let along = u + 2.0 * half * ((f64::from(at) + 0.5) / seats - 0.5);
        for (side, turn) in [(0.75, 0.0), (-0.75, PI)] {
            let there = chance.bernoulli(share);
            let seat = chair(chance);
            if there {
                put(draft, view, [along, v + side], turn, seat);
            }
        }
    }
}

/// Shelves along the wall opposite the door, and along a side without doors.
fn storage(draft: &mut Draft, view: &View<'_>, chance: &mut Stream, share: f64) {
    let [wide, deep] = SHELF_M;
    let pitch = wide + 0.05;
    for at in 0..(view.size.x / pitch).floor() as u32 {
        if chance.bernoulli(share) {
            let u = pitch * (f64::from(at) + 0.5);
            put(draft, view, [u, 0.01], 0.0, shelf());
        }
    }
    let [_, free] = view.free_sides();
    let length = view.size.y - deep - 0.6;
    for at in 0..(length / pitch).floor().max(0.0) as u32 {
        if chance.bernoulli(share) && free {
            let v = deep + 0.3 + pitch * (f64::from(at) + 0.5);
            put(draft, view, [view.size.x - 0.01, v], 0.5 * PI, shelf());
        }
    }
}

/// A plant in the corner beside the corridor, away from the door.
fn plant(draft: &mut Draft, p: &OfficeParams, view: &View<'_>, chance: &mut Stream) {
    let there = chance.bernoulli(0.6 * p.furniture);
    let size = 0.28 + 0.14 * chance.uniform();
    let [from, to] = view.door(p.door_width.get());
    let at_end = view.size.x - to > from;
    let (u, room) = match at_end {
        true => (view.size.x - 0.45, view.size.x - to),
        false => (0.45, from),
    };
    let [begin, end] = view.free_sides();
    let free = if at_end { end } else { begin };
    if !(there && free) || room < 1.1 || view.size.y < 2.6 {
        return;
    }
    let (foot, _) = view.place(u, view.size.y - 0.45);
    let finish = |material, color| Finish {
        meta: view.room.meta(),
        ..Finish::new(material, color, "plant")
    };
    draft.obstacle(foot, 0.0, cylinder(0.34, 0.36), &finish("brick", POT));
    let leaves = ObstacleShape::Sphere {
        radius: Length::si((size * 1e3).round() / 1e3),
    };
    let above = foot + DVec3::Z * 0.4;
    draft.obstacle(above, 0.0, leaves, &finish("foliage", LEAVES));
    draft.obstacle(
        foot + DVec3::Z * 0.36,
        0.0,
        cylinder(0.05, 0.1),
        &finish("wood", SHELF),
    );
}

//! Where the rooms of an office lie, how wide each is, and where its doors are.

use super::{HEAD_M, JAMB_M, OfficeParams};
use crate::generate::draft::{Finish, Rect};
use crate::look::{Color, Meta};
use glam::DVec3;
use simbeeotic_kernel::rng::Stream;

/// One room.
pub(super) struct Room {
    pub(super) floor: usize,
    /// Its number: `2.14` is room 14 of floor 2.
    pub(super) number: String,
    /// From the middle of its walls to the middle of its walls.
    pub(super) rect: Rect,
    pub(super) foot: f64,
    /// Whether the corridor is in its north.
    pub(super) corridor_north: bool,
    /// Where its door is: from this x on.
    pub(super) door: f64,
    /// Whether it has a door to the room west of it.
    pub(super) west_door: bool,
    /// Whether the room east of it has a door to it.
    pub(super) east_door: bool,
    /// Whether its wall opposite the corridor is an outer one.
    pub(super) outer: bool,
}

impl Room {
    pub(super) fn meta(&self) -> Meta {
        Meta::from([
            ("floor".to_owned(), self.floor.to_string()),
            ("room".to_owned(), self.number.clone()),
        ])
    }

    /// The stream of this room for a purpose.
    pub(super) fn chance(&self, seed: i64, purpose: &str) -> Stream {
        let path = format!("office/{}", self.number);
        Stream::new(seed.cast_unsigned(), &path, purpose)
    }

    pub(super) fn finish(&self, material: &'static str, color: Color) -> Finish {
        Finish {
            meta: self.meta(),
            ..Finish::new(material, color, "")
        }
    }

    /// At the height that a vehicle is told to go to.
    pub(super) fn place(&self, p: &OfficeParams) -> DVec3 {
        let clear = 0.5 * (HEAD_M + p.storey_height.get());
        self.rect.middle().extend(self.foot + clear)
    }
}

/// The rooms on one side of one corridor.
pub(super) fn row(
    p: &OfficeParams,
    rect: Rect,
    [floor, wing]: [usize; 2],
    north: bool,
    all: &mut Vec<Room>,
) {
    let side = if north { "north" } else { "south" };
    let path = format!("office/floor-{floor}/corridor-{wing}-{side}");
    let mut chance = Stream::new(p.seed.cast_unsigned(), &path, "widths");
    let mut share = || 1.0 + p.room_variation * (2.0 * chance.uniform() - 1.0);
    let shares: Vec<f64> = (0..p.rooms).map(|_| share()).collect();
    let unit = f64::from(p.rooms) * p.room_width.get() / shares.iter().sum::<f64>();
    let wing_width = rect.size().y / f64::from(p.corridors);
    let south = rect.low.y + wing as f64 * wing_width;
    let depth = p.room_depth.get() + 0.5 * p.wall_thickness.get();
    let last_wing = wing + 1 == p.corridors as usize;
    let y = match (north, last_wing) {
        (false, _) => [south, south + depth],
        (true, true) => [south + wing_width - depth, rect.high.y],
        (true, false) => [south + wing_width - depth, south + wing_width],
    };
    let lobby = rect.low.x + p.lobby_width.get();
    let before = 2 * p.rooms as usize * wing + if north { p.rooms as usize } else { 0 };
    let per_floor = 2 * p.rooms as usize * p.corridors as usize;
    let digits = per_floor.to_string().len().max(2);
    let start = all.len();
    let mut x = lobby;
    for (at, share) in shares.iter().enumerate() {
        let last = at + 1 == shares.len();
        let end = if last { rect.high.x } else { x + unit * share };
        let mut room = Room {
            floor,
            number: format!("{floor}.{:0digits$}", before + at + 1),
            rect: Rect::new([x, end], y),
            foot: floor as f64 * (p.storey_height + p.slab_thickness).get(),
            corridor_north: !north,
            door: 0.0,
            west_door: false,
            east_door: false,
            outer: if north { last_wing } else { wing == 0 },
        };
        let margin = 0.5 * p.wall_thickness.get() + JAMB_M;
        let room_for_door = end - x - 2.0 * margin - p.door_width.get();
        let mut chance = room.chance(p.seed, "door");
        room.door = x + margin + room_for_door.max(0.0) * chance.uniform();
        let mut chance = room.chance(p.seed, "extra door");
        room.west_door = at > 0 && chance.bernoulli(p.extra_doors);
        if room.west_door
            && let Some(west) = all[start..].last_mut()
        {
            west.east_door = true;
        }
        all.push(room);
        x = end;
    }
}

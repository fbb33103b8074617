//! Offices that vehicles reach every room of, and what is refused.

use super::*;
use crate::generate::{Search, fingerprint};
use crate::structure::StructureShape;
use simbeeotic_units::Position;

fn m(metres: f64) -> Length {
    Length::si(metres)
}

fn small(seed: i64) -> OfficeParams {
    OfficeParams {
        seed,
        rooms: 2,
        room_width: m(3.0),
        room_depth: m(3.5),
        clearance: m(0.8),
        roof: true,
        ..OfficeParams::default()
    }
}

/// Names of rooms and lobbies that a vehicle does not reach from before the entrance.
fn missed(params: &OfficeParams, world: &World) -> Vec<String> {
    let cell = 0.125 * params.clearance.get();
    let search = Search {
        vehicle_radius: m(0.5 * params.clearance.get() - 1.4 * cell),
        cell: m(cell),
        within: None,
        seed: 0,
    };
    let rect = Building::new(params).around();
    let start = Position::from_xyz(rect.low.x - 0.6, rect.middle().y, 1.0);
    let reach = search.run(world, start).expect("it starts outside");
    let places = world.places.iter();
    let missed = places.filter(|place| !reach.contains(place.position));
    missed.map(|place| place.name.clone()).collect()
}

#[test]
fn every_room_of_every_floor_is_reached_from_the_street() {
    let none: [&str; 0] = [];
    for seed in 0..4 {
        let params = small(seed);
        let world = office(&params).expect("it can be");
        assert!(world.check().is_empty(), "{:?}", world.check());
        assert_eq!(missed(&params, &world), none, "seed {seed}");
    }
    let two_corridors = OfficeParams {
        corridors: 2,
        floors: 1,
        rooms: 3,
        ..small(9)
    };
    let world = office(&two_corridors).expect("it can be");
    assert_eq!(world.places.len(), 12 + 1 + 1);
    assert_eq!(missed(&two_corridors, &world), none);
    let narrow = OfficeParams {
        floors: 3,
        rooms: 1,
        room_variation: 0.0,
        shaft: m(0.8),
        door_width: m(0.8),
        ..small(2)
    };
    assert_eq!(missed(&narrow, &office(&narrow).expect("it can be")), none);
}

/// Negative control: one closed door is found.
#[test]
fn a_room_whose_doors_are_closed_is_missed_and_no_other() {
    let params = OfficeParams {
        extra_doors: 0.0,
        ..small(1)
    };
    let mut world = office(&params).expect("it can be");
    let closed = world.structures.iter_mut().find_map(|s| {
        let of_room = s.meta.get("room").is_some_and(|room| room == "1.03");
        match &mut s.shape {
            StructureShape::Wall(wall) if of_room && !wall.doors.is_empty() => {
                wall.doors.clear();
                Some(())
            }
            _ => None,
        }
    });
    assert!(closed.is_some());
    assert_eq!(missed(&params, &world), ["room 1.03"]);
}

#[test]
fn every_room_has_a_door_and_each_outer_one_a_window_with_a_pane() {
    let world = office(&OfficeParams::default()).expect("it can be");
    let rooms: Vec<&str> = world
        .places
        .iter()
        .filter_map(|place| place.name.strip_prefix("room "))
        .collect();
    assert_eq!(rooms.len(), 20);
    assert_eq!((rooms[0], rooms[19]), ("0.01", "1.10"));
    for room in rooms {
        let of_room = world
            .structures
            .iter()
            .filter(|s| s.meta.get("room").is_some_and(|r| r == room));
        let doors = of_room
            .clone()
            .filter(|s| matches!(&s.shape, StructureShape::Wall(wall) if !wall.doors.is_empty()));
        assert!(doors.count() >= 1, "{room}");
        assert_eq!(of_room.filter(|s| s.label == "pane").count(), 1, "{room}");
    }
}

#[test]
fn windows_do_not_move_the_furniture_and_floors_not_each_other() {
    let world = |change: fn(&mut OfficeParams)| {
        let mut params = OfficeParams::default();
        change(&mut params);
        office(&params).expect("it can be")
    };
    let usual = world(|_| ());
    assert!(usual.obstacles.len() > 40, "{}", usual.obstacles.len());
    assert_eq!(world(|p| p.windows = false).obstacles, usual.obstacles);
    let three = world(|p| p.floors = 3);
    assert_eq!(three.obstacles[..usual.obstacles.len()], usual.obstacles);
    assert_ne!(world(|p| p.seed = 2).obstacles, usual.obstacles);
    assert!(world(|p| p.furniture = 0.0).obstacles.is_empty());
}

#[test]
fn an_office_stays_what_it_is() {
    let other = OfficeParams {
        seed: 4,
        corridors: 2,
        glass: false,
        ..OfficeParams::default()
    };
    let found =
        [OfficeParams::default(), other].map(|p| fingerprint(&office(&p).expect("it can be")));
    assert_eq!(found, GOLDEN, "{found:#018x?}");
}
const GOLDEN: [u64; 2] = [0x514f_812d_12ae_972c, 0x42c3_4229_a550_4f3c];

#[test]
fn nonsense_is_refused_with_what_is_allowed() {
    let with = |change: fn(&mut OfficeParams)| {
        let mut params = OfficeParams::default();
        change(&mut params);
        office(&params).expect_err("nonsense").to_string()
    };
    for (message, words) in [
        (
            with(|p| p.floors = 0),
            "`floors` must lie between 1 and 100",
        ),
        (
            with(|p| p.corridors = 51),
            "`corridors` must lie between 1 and 50",
        ),
        (with(|p| p.rooms = 0), "`rooms` must lie between 1 and 200"),
        (
            with(|p| (p.floors, p.corridors, p.rooms) = (100, 50, 200)),
            "at most 1000000",
        ),
        (
            with(|p| p.room_width = m(1.0)),
            "`room_width` must lie between",
        ),
        (
            with(|p| p.room_width = m(1.6)),
            "the narrowest room has to have its door",
        ),
        (
            with(|p| p.room_depth = m(f64::NAN)),
            "`room_depth` must lie between",
        ),
        (with(|p| p.room_variation = 0.6), "between 0 and 0.5"),
        (
            with(|p| p.corridor_width = m(0.5)),
            "a vehicle of 0.6 m has to pass",
        ),
        (
            with(|p| p.lobby_width = m(2.5)),
            "the opening between floors",
        ),
        (with(|p| p.storey_height = m(2.3)), "over the furniture"),
        (
            with(|p| p.door_height = m(3.5)),
            "doors end below the ceiling",
        ),
        (
            with(|p| p.door_width = m(0.5)),
            "`door_width` must be at least 0.600 m",
        ),
        (
            with(|p| p.extra_doors = -0.1),
            "`extra_doors` must lie between 0 and 1",
        ),
        (
            with(|p| p.furniture = 2.0),
            "`furniture` must lie between 0 and 1",
        ),
        (with(|p| p.shaft = m(0.5)), "`shaft` must be at least"),
        (
            with(|p| p.clearance = m(0.0)),
            "`clearance` must lie between",
        ),
        (
            with(|p| p.wall_thickness = m(0.0)),
            "`wall_thickness` must lie between",
        ),
        (
            with(|p| p.slab_thickness = m(9.0)),
            "`slab_thickness` must lie between",
        ),
    ] {
        assert!(message.contains(words), "{message}");
    }
}

//! Mines that are reached from the shaft alone, and what is refused.

use super::*;
use crate::generate::{Reach, Search, fingerprint};
use simbeeotic_units::Position;

fn m(metres: f64) -> Length {
    Length::si(metres)
}

fn small(seed: i64) -> MineParams {
    MineParams {
        seed,
        levels: 2,
        columns: 13,
        rows: 11,
        tunnel_width: m(2.2),
        people: 0.2,
        frames: 0.5,
        ..MineParams::default()
    }
}

#[test]
fn a_mine_stays_what_it_is() {
    let found =
        [MineParams::default(), small(7)].map(|p| fingerprint(&mine(&p).expect("it can be")));
    assert_eq!(found, GOLDEN, "{found:#018x?}");
}
const GOLDEN: [u64; 2] = [0xded5_3cf7_60b1_fdcd, 0xba41_46a0_cec1_41bf];

/// Where a vehicle of the clearance gets from the top of the shaft.
fn search(params: &MineParams, world: &World) -> Reach {
    let plan = Plan::new(params);
    let (columns, rows) = (params.columns as i32, params.rows as i32);
    let top = plan.foot(0) + params.tunnel_height.get();
    let search = Search {
        vehicle_radius: m((0.5 - 0.14) * params.clearance.get()),
        cell: m(0.1 * params.clearance.get()),
        within: Some([
            Position::from_si(plan.corner(0, 0).extend(0.0)),
            Position::from_si(plan.corner(columns, rows).extend(top)),
        ]),
        seed: 0,
    };
    let shaft = world.places.iter().find(|place| place.name == "shaft");
    let from = shaft.expect("it has a shaft").position;
    search.run(world, from).expect("it starts in the shaft")
}

/// The middle of each open cell of each level.
fn cells(params: &MineParams) -> Vec<Position> {
    let plan = Plan::new(params);
    let mut cells = Vec::new();
    for (at, level) in plan.levels.iter().enumerate() {
        for y in 0..level.rows {
            for x in 0..level.columns {
                if level.is_open([x, y]) {
                    let height = plan.foot(at) + 0.5 * params.clearance.get();
                    cells.push(Position::from_si(plan.middle([x, y]).extend(height)));
                }
            }
        }
    }
    cells
}

#[test]
fn every_cell_of_every_tunnel_is_reached_from_the_shaft() {
    for seed in 0..6 {
        let params = small(seed);
        let world = mine(&params).expect("it can be");
        assert!(world.check().is_empty(), "{:?}", world.check());
        let (reach, cells) = (search(&params, &world), cells(&params));
        assert!(cells.len() > 20, "{}", cells.len());
        let missed = cells.iter().filter(|at| !reach.contains(**at)).count();
        assert_eq!(missed, 0, "of {} with seed {seed}", cells.len());
    }
}

/// A mine is closed: nothing leaves it but up the shaft.
#[test]
fn no_way_leads_out_through_the_rock() {
    let params = small(3);
    let world = mine(&params).expect("it can be");
    let reach = search(&params, &world);
    let plan = Plan::new(&params);
    for (at, level) in plan.levels.iter().enumerate() {
        for y in 0..level.rows {
            for x in 0..level.columns {
                if !level.is_open([x, y]) {
                    let height = plan.foot(at) + 0.5 * params.clearance.get();
                    let at = Position::from_si(plan.middle([x, y]).extend(height));
                    assert!(!reach.contains(at), "{x} {y}");
                }
            }
        }
    }
}

/// Negative control: a shaft that is closed leads nowhere.
#[test]
fn a_level_behind_a_closed_shaft_is_not_reached() {
    let params = small(1);
    let mut draft = Draft {
        world: mine(&params).expect("it can be"),
    };
    let plan = Plan::new(&params);
    let [x, y] = plan.shaft;
    let rect = Rect {
        low: plan.corner(x, y),
        high: plan.corner(x + plan.across, y + plan.across),
    };
    draft.slab(rect, [4.0, 4.5], &[], &Finish::of("concrete", "lid"));
    let reach = search(&params, &draft.world);
    let (above, below): (Vec<_>, Vec<_>) =
        cells(&params).into_iter().partition(|at| at.up() > m(4.5));
    assert!(above.iter().all(|at| reach.contains(*at)));
    assert!(!below.is_empty() && below.iter().all(|at| !reach.contains(*at)));
}

#[test]
fn tunnels_keep_rock_between_them_where_there_is_no_chamber() {
    let params = MineParams {
        chambers: 0.0,
        branches: 0.4,
        ..MineParams::default()
    };
    for level in &Plan::new(&params).levels {
        for y in 0..level.rows - 1 {
            for x in 0..level.columns - 1 {
                let square = [[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]];
                let shaft = square.iter().any(|c| Plan::new(&params).in_shaft(*c));
                let open = square.iter().filter(|c| level.is_open(**c)).count();
                assert!(open < 4 || shaft, "{x} {y}");
            }
        }
    }
}

#[test]
fn people_stand_in_tunnels_each_with_a_number_of_its_own() {
    let params = MineParams {
        people: 0.5,
        ..MineParams::default()
    };
    let world = mine(&params).expect("it can be");
    let open: usize = Plan::new(&params)
        .levels
        .iter()
        .map(|level| level.open.iter().filter(|open| **open).count())
        .sum();
    let share = world.people.len() as f64 / open as f64;
    assert!((0.35..0.6).contains(&share), "{share}");
    for (at, person) in world.people.iter().enumerate() {
        assert_eq!(person.meta["person-id"], at.to_string());
    }
}

#[test]
fn a_further_level_leaves_those_above_as_they_are() {
    let open = |levels| {
        let params = MineParams { levels, ..small(5) };
        Plan::new(&params).levels[0].open.clone()
    };
    assert_eq!(open(1), open(4));
}

#[test]
fn nonsense_is_refused_with_what_is_allowed() {
    let with = |change: fn(&mut MineParams)| {
        let mut params = MineParams::default();
        change(&mut params);
        mine(&params).expect_err("nonsense").to_string()
    };
    for (message, words) in [
        (with(|p| p.levels = 0), "`levels` must lie between 1 and 50"),
        (
            with(|p| p.columns = 2),
            "`columns` must lie between 3 and 500",
        ),
        (with(|p| p.level_height = m(3.0)), "a ceiling and a floor"),
        (with(|p| p.tunnel_width = m(1.5)), "has to pass people"),
        (with(|p| p.tunnel_height = m(1.5)), "stand upright"),
        (
            with(|p| p.shaft = m(50.0)),
            "`shaft` must lie between 0.5 m and",
        ),
        (
            with(|p| p.advance = 1.0),
            "`advance` must lie between 0 and 0.99",
        ),
        (
            with(|p| p.people = f64::NAN),
            "`people` must lie between 0 and 1",
        ),
        (
            with(|p| (p.columns, p.rows, p.levels) = (500, 500, 50)),
            "cells on all levels",
        ),
    ] {
        assert!(message.contains(words), "{message}");
    }
}

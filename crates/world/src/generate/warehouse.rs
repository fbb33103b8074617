//! Warehouses: racks with boxes between aisles, in a hall with gates.
//!
//! Racks stand in rows from west to east, single or back to back, with an aisle on each open side.
//! Cross aisles cut the rows, and run along both ends of the hall. A rack is made of bays: four
//! posts, shelves, and boxes on some of them.
//!
//! ```text
//! +--------------------------------------+
//! |  ############  ###########   racks   |
//! |  aisle 1       |  cross aisle        |
//! |  ############  ###########           |
//! |  ############  ###########           |
//! |  aisle 0                             |
//! |  ############  ###########           |
//! |  dock                                |
//! +----[ ]------------[ ]----------------+  gates
//! ```

use super::check::{GenerateError, at_least, error, metres, not_too_many, share, within};
use super::draft::{Draft, Finish, Line, Opening, Rect, block, boxed};
use crate::look::{Color, Meta};
use crate::obstacle::ObstacleShape;
use crate::world::World;
use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_kernel::rng::Stream;
use simbeeotic_units::Length;

/// Parameters of [`warehouse`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct WarehouseParams {
    /// The seed: another seed, other boxes.
    pub seed: i64,
    /// Aisles between racks, 1 to 200. Each has racks on both sides; those of neighbouring aisles
    /// stand back to back.
    pub aisles: u32,
    /// Bays along an aisle, 1 to 500.
    pub bays: u32,
    /// Shelves of a rack, one above the other, 1 to 20. The lowest lies on the ground.
    pub levels: u32,
    /// Cross aisles through the racks, besides those at both ends, 0 to 50; fewer than bays.
    pub cross_aisles: u32,
    /// How wide an aisle is, 0.3 m to 50 m.
    pub aisle: Length,
    /// How wide a cross aisle is, 0.3 m to 50 m.
    pub cross_aisle: Length,
    /// How wide the dock is: the free space inside the gates, 0.3 m to 100 m.
    pub dock: Length,
    /// How long a bay is, 0.5 m to 10 m.
    pub bay_length: Length,
    /// How deep a rack is, 0.3 m to 5 m.
    pub rack_depth: Length,
    /// From one shelf to the next, 0.3 m to 10 m.
    pub level_height: Length,
    /// Between the top of the racks and the roof, 0 m to 50 m.
    pub headroom: Length,
    /// The chance of each place on a shelf (two in a bay) to hold a box, 0 to 1.
    pub fill: f64,
    /// Gates in the southern wall, 0 to 50.
    pub gates: u32,
    /// How wide a gate is, 0.3 m to 20 m.
    pub gate_width: Length,
    /// How high a gate is, 0.3 m to 20 m.
    pub gate_height: Length,
    /// Whether a roof closes the hall. Without it one looks in, and vehicles fly over the walls.
    pub roof: bool,
    /// Every aisle and gate is at least as wide and as high as this: a vehicle of this diameter
    /// gets everywhere. Above 0.
    pub clearance: Length,
}

impl Default for WarehouseParams {
    /// Four aisles of twelve bays with pallets: 960 places in a hall of 45 m by 31 m.
    fn default() -> Self {
        Self {
            seed: 1,
            aisles: 4,
            bays: 12,
            levels: 5,
            cross_aisles: 1,
            aisle: Length::si(3.0),
            cross_aisle: Length::si(3.5),
            dock: Length::si(7.0),
            bay_length: Length::si(2.7),
            rack_depth: Length::si(1.1),
            level_height: Length::si(1.6),
            headroom: Length::si(1.5),
            fill: 0.7,
            gates: 3,
            gate_width: Length::si(3.5),
            gate_height: Length::si(4.0),
            roof: false,
            clearance: Length::si(1.0),
        }
    }
}

impl WarehouseParams {
    fn check(&self) -> Result<(), GenerateError> {
        within("aisles", self.aisles, 1..=200)?;
        within("bays", self.bays, 1..=500)?;
        within("levels", self.levels, 1..=20)?;
        within("cross_aisles", self.cross_aisles, 0..=50)?;
        if self.cross_aisles >= self.bays {
            let message = format!(
                "must be fewer than the {} bays that they part, and is {}",
                self.bays, self.cross_aisles
            );
            return error("cross_aisles", message);
        }
        metres("aisle", self.aisle, 0.3..=50.0)?;
        metres("cross_aisle", self.cross_aisle, 0.3..=50.0)?;
        metres("dock", self.dock, 0.3..=100.0)?;
        metres("bay_length", self.bay_length, 0.5..=10.0)?;
        metres("rack_depth", self.rack_depth, 0.3..=5.0)?;
        metres("level_height", self.level_height, 0.3..=10.0)?;
        metres("headroom", self.headroom, 0.0..=50.0)?;
        share("fill", self.fill)?;
        within("gates", self.gates, 0..=50)?;
        metres("gate_width", self.gate_width, 0.3..=20.0)?;
        metres("gate_height", self.gate_height, 0.3..=20.0)?;
        metres("clearance", self.clearance, 1e-3..=50.0)?;
        let why = format!("a vehicle of {} has to pass", self.clearance);
        for (key, width) in [
            ("aisle", self.aisle),
            ("cross_aisle", self.cross_aisle),
            ("dock", self.dock),
            ("gate_width", self.gate_width),
            ("gate_height", self.gate_height),
        ] {
            at_least(key, width, self.clearance, &why)?;
        }
        let plan = Plan::new(self);
        let height = Length::si(plan.height);
        let rise = Length::si(plan.height - plan.top);
        at_least(
            "headroom",
            self.headroom,
            self.headroom + self.clearance - height,
            &format!("a vehicle of {} has to fit under the roof", self.clearance),
        )?;
        let hall = format!(
            "a gate of {} does not fit a wall of {height}",
            self.gate_height
        );
        at_least("headroom", rise, rise + self.gate_height - height, &hall)?;
        let gates = f64::from(self.gates) * (self.gate_width.get() + GATE_POST_M) + GATE_POST_M;
        let length = plan.size.x;
        if gates > length {
            let message = format!(
                "makes {} gates of {} in a wall of {length:.1} m, where there is no room for them",
                self.gates, self.gate_width
            );
            return error("gates", message);
        }
        let bays = 2.0 * f64::from(self.aisles) * f64::from(self.bays);
        not_too_many("bays", "places", 2.0 * bays * f64::from(self.levels))
    }
}

const WALL_M: f64 = 0.3;
const ROOF_M: f64 = 0.2;
/// Between two gates, at least.
const GATE_POST_M: f64 = 0.5;
const POST_M: f64 = 0.1;
const SHELF_M: f64 = 0.06;
/// Between a box and what is around it.
const AIR_M: f64 = 0.1;

const WALL: Color = Color::rgb(196, 200, 204);
const RACK: Color = Color::rgb(44, 88, 160);
const BOXES: [Color; 3] = [
    Color::rgb(190, 150, 104),
    Color::rgb(172, 130, 88),
    Color::rgb(206, 172, 128),
];

/// A warehouse around the origin.
///
/// Racks are labelled `rack` and boxes `box`, with `aisle`, `side` (`south` or `north` of it), `bay`
/// and, of boxes, `level` as metadata, all from 0. Places `aisle 0`, ... stand in the middle of the
/// aisles, `dock` in the middle of the dock; vehicles start in the area `dock`.
///
/// # Errors
/// A parameter out of its range.
pub fn warehouse(params: &WarehouseParams) -> Result<World, GenerateError> {
    params.check()?;
    let plan = Plan::new(params);
    let mut draft = Draft::default();
    plan.hall(&mut draft);
    for aisle in 0..params.aisles {
        for bay in 0..params.bays {
            for north in [false, true] {
                plan.bay(&mut draft, aisle, bay, north);
            }
        }
    }
    plan.places(&mut draft);
    draft.world.radius = Length::si(plan.size.length().ceil());
    Ok(draft.world)
}

/// The measures of a warehouse, in metres.
struct Plan<'p> {
    params: &'p WarehouseParams,
    /// Of the hall, inside.
    size: DVec2,
    /// From the ground to the top of the racks, and to the roof.
    top: f64,
    height: f64,
}

impl<'p> Plan<'p> {
    fn new(p: &'p WarehouseParams) -> Self {
        let cross = f64::from(p.cross_aisles + 2) * p.cross_aisle.get();
        let length = f64::from(p.bays) * p.bay_length.get() + cross;
        let aisle = p.aisle.get() + 2.0 * p.rack_depth.get();
        let width = f64::from(p.aisles) * aisle + p.dock.get();
        let top = f64::from(p.levels) * p.level_height.get();
        Self {
            params: p,
            size: DVec2::new(length, width),
            top,
            height: top + p.headroom.get(),
        }
    }

    /// The south-western corner inside.
    fn corner(&self) -> DVec2 {
        -0.5 * self.size
    }

    /// Where a bay begins, from the western wall: cross aisles lie between equal parts of the row.
    fn start(&self, bay: u32) -> f64 {
        let p = self.params;
        let parts = u64::from(p.cross_aisles) + 1;
        let crossed = u64::from(bay) * parts / u64::from(p.bays);
        (crossed + 1) as f64 * p.cross_aisle.get() + f64::from(bay) * p.bay_length.get()
    }

    /// The southern side of an aisle's southern rack.
    fn side(&self, aisle: u32) -> f64 {
        let p = self.params;
        self.corner().y
            + p.dock.get()
            + f64::from(aisle) * (p.aisle.get() + 2.0 * p.rack_depth.get())
    }

    fn middle(&self, aisle: u32) -> DVec2 {
        let p = self.params;
        DVec2::new(
            0.0,
            self.side(aisle) + p.rack_depth.get() + 0.5 * p.aisle.get(),
        )
    }

    fn hall(&self, draft: &mut Draft) {
        let (low, high) = (self.corner(), -self.corner());
        let p = self.params;
        let finish = Finish::new("concrete", WALL, "wall");
        // Counter-clockwise: outside is on the right.
        let corners = [
            low,
            DVec2::new(high.x, low.y),
            high,
            DVec2::new(low.x, high.y),
        ];
        let ends = [WALL_M, 0.0, WALL_M, 0.0];
        for side in 0..4 {
            let (from, to) = (corners[side], corners[(side + 1) % 4]);
            let along = (to - from).normalize() * ends[side];
            let line = Line {
                from: from - along,
                to: to + along,
                foot: 0.0,
                height: self.height,
                right: WALL_M,
                left: 0.0,
            };
            let pitch = self.size.x / f64::from(p.gates.max(1));
            let gate = |at: u32| Opening {
                at: WALL_M + (f64::from(at) + 0.5) * pitch - 0.5 * p.gate_width.get(),
                width: p.gate_width.get(),
                sill: 0.0,
                height: p.gate_height.get(),
            };
            let gates: Vec<_> = (0..p.gates).filter(|_| side == 0).map(gate).collect();
            draft.wall(line, &gates, &finish);
        }
        if p.roof {
            let rect = Rect {
                low: low - DVec2::splat(WALL_M),
                high: high + DVec2::splat(WALL_M),
            };
            let z = [self.height, self.height + ROOF_M];
            draft.slab(rect, z, &[], &Finish::of("metal", "roof"));
        }
    }

    fn bay(&self, draft: &mut Draft, aisle: u32, bay: u32, north: bool) {
        let p = self.params;
        let side = if north { "north" } else { "south" };
        let south = self.side(aisle) + f64::from(u8::from(north)) * (p.rack_depth + p.aisle).get();
        let foot = DVec3::new(self.corner().x + self.start(bay), south, 0.0);
        let (x, y) = (p.bay_length.get(), p.rack_depth.get());
        let mut parts = Vec::new();
        for [px, py] in [
            [0.0, 0.0],
            [x - POST_M, 0.0],
            [0.0, y - POST_M],
            [x - POST_M, y - POST_M],
        ] {
            parts.push(block([px, py, 0.0], [px + POST_M, py + POST_M, self.top]));
        }
        for level in 1..p.levels {
            let z = f64::from(level) * p.level_height.get();
            parts.push(block([0.0, 0.0, z - SHELF_M], [x, y, z]));
        }
        let finish = |finish: Finish| {
            let finish = finish.with("aisle", aisle).with("side", side);
            finish.with("bay", bay)
        };
        let rack = finish(Finish::new("metal", RACK, "rack"));
        draft.obstacle(foot, 0.0, ObstacleShape::Parts(parts), &rack);
        let path = format!("warehouse/aisle-{aisle}/{side}/bay-{bay}");
        let stream = |purpose| Stream::new(p.seed.cast_unsigned(), &path, purpose);
        let (mut filled, mut sizes) = (stream("filled"), stream("sizes"));
        let place = 0.5 * (x - 2.0 * POST_M);
        for level in 0..p.levels {
            for half in 0..2 {
                // Each place has its draws: a fuller warehouse keeps the boxes it had.
                let fraction = [(); 3].map(|()| 0.65 + 0.35 * sizes.uniform());
                let color = BOXES[sizes.below(BOXES.len() as u64) as usize];
                if filled.uniform() >= p.fill {
                    continue;
                }
                let room = DVec3::new(place, y, p.level_height.get() - SHELF_M);
                let size = (room - DVec3::splat(AIR_M)) * DVec3::from_array(fraction);
                let at = DVec3::new(
                    POST_M + (f64::from(half) + 0.5) * place,
                    0.5 * y,
                    f64::from(level) * p.level_height.get(),
                );
                let finish = finish(Finish::new("chipboard", color, "box")).with("level", level);
                draft.obstacle(foot + at, 0.0, boxed(size), &finish);
            }
        }
    }

    fn places(&self, draft: &mut Draft) {
        let p = self.params;
        let height = 0.5 * self.height.min(3.0);
        for aisle in 0..p.aisles {
            let at = self.middle(aisle).extend(height);
            draft.place(
                format!("aisle {aisle}"),
                at,
                0.5 * p.aisle.get(),
                Meta::new(),
            );
        }
        let middle = DVec2::new(0.0, self.corner().y + 0.5 * p.dock.get());
        draft.place(
            "dock",
            middle.extend(height),
            0.5 * p.dock.get(),
            Meta::new(),
        );
        let room = DVec3::new(0.4 * self.size.x, 0.3 * p.dock.get(), 0.25 * height);
        let middle = middle.extend(height);
        draft.spawn("dock", middle - room, middle + room);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Reach, Search, fingerprint};
    use simbeeotic_units::Position;

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    fn small(seed: i64) -> WarehouseParams {
        WarehouseParams {
            seed,
            aisles: 2,
            bays: 4,
            levels: 2,
            aisle: m(1.2),
            cross_aisle: m(1.3),
            roof: true,
            ..WarehouseParams::default()
        }
    }

    #[test]
    fn a_warehouse_stays_what_it_is() {
        let found = [WarehouseParams::default(), small(7)]
            .map(|p| fingerprint(&warehouse(&p).expect("it can be")));
        assert_eq!(found, GOLDEN, "{found:#018x?}");
    }
    const GOLDEN: [u64; 2] = [0xc64f_8ce2_0baf_ded1, 0xb663_5344_4e27_6951];

    /// Where a vehicle of the clearance gets from outside the gates, below the racks' tops.
    fn search(params: &WarehouseParams, world: &World) -> Reach {
        let plan = Plan::new(params);
        let half = 0.5 * plan.size + DVec2::splat(3.0);
        let search = Search {
            vehicle_radius: m((0.5 - 0.14) * params.clearance.get()),
            cell: m(0.1 * params.clearance.get()),
            within: Some([
                Position::from_si((-half).extend(0.0)),
                Position::from_si(half.extend(1.4 * params.clearance.get())),
            ]),
            seed: 0,
        };
        let outside = DVec2::new(0.0, plan.corner().y - 2.0);
        let height = 0.7 * params.clearance.get();
        let from = Position::from_si(outside.extend(height));
        search.run(world, from).expect("it starts outside")
    }

    /// The ends of each cross aisle and the middle of each bay in every aisle.
    fn points(params: &WarehouseParams) -> Vec<Position> {
        let plan = Plan::new(params);
        let height = 0.7 * params.clearance.get();
        let mut points = Vec::new();
        for aisle in 0..params.aisles {
            let y = plan.middle(aisle).y;
            let mut put = |x: f64| {
                let at = DVec3::new(plan.corner().x + x, y, height);
                points.push(Position::from_si(at));
            };
            for bay in 0..params.bays {
                put(plan.start(bay) + 0.5 * params.bay_length.get());
            }
            put(0.5 * params.cross_aisle.get());
            put(plan.size.x - 0.5 * params.cross_aisle.get());
        }
        points
    }

    #[test]
    fn every_aisle_is_reached_through_the_gates() {
        for seed in 0..3 {
            let params = small(seed);
            let world = warehouse(&params).expect("it can be");
            assert!(world.check().is_empty(), "{:?}", world.check());
            let reach = search(&params, &world);
            assert!(
                points(&params).iter().all(|at| reach.contains(*at)),
                "{seed}"
            );
        }
    }

    /// Negative control: a hall without gates is not entered.
    #[test]
    fn a_hall_without_gates_is_not_reached() {
        let params = WarehouseParams {
            gates: 0,
            ..small(1)
        };
        let world = warehouse(&params).expect("it can be");
        let reach = search(&params, &world);
        assert!(points(&params).iter().all(|at| !reach.contains(*at)));
    }

    #[test]
    fn racks_and_boxes_keep_out_of_the_aisles_and_of_each_other() {
        let params = WarehouseParams {
            fill: 1.0,
            ..WarehouseParams::default()
        };
        let plan = Plan::new(&params);
        let world = warehouse(&params).expect("it can be");
        let boxes = world.obstacles.iter().filter(|o| o.label == "box").count();
        assert_eq!(boxes, 4 * 2 * 12 * 5 * 2);
        for object in world
            .objects(0)
            .iter()
            .filter(|o| ["box", "rack"].contains(&o.label))
        {
            let aisle: u32 = object.meta["aisle"].parse().expect("a number");
            let north = object.meta["side"] == "north";
            let (depth, gap) = (params.rack_depth.get(), params.aisle.get());
            let south = plan.side(aisle) + if north { depth + gap } else { 0.0 };
            for solid in &object.solids {
                let crate::SolidShape::Box { half_width, .. } = solid.shape else {
                    panic!("racks and boxes are boxes");
                };
                let y = solid.center.si().y;
                assert!(y - half_width.get() >= south - 1e-5, "{}", object.label);
                assert!(
                    y + half_width.get() <= south + depth + 1e-5,
                    "{}",
                    object.label
                );
            }
        }
    }

    #[test]
    fn the_share_of_full_places_is_that_asked_for_and_more_keeps_what_was() {
        let boxes = |fill| {
            let params = WarehouseParams {
                fill,
                aisles: 20,
                ..WarehouseParams::default()
            };
            let world = warehouse(&params).expect("it can be");
            world
                .obstacles
                .into_iter()
                .filter(|o| o.label == "box")
                .collect::<Vec<_>>()
        };
        let (half, most) = (boxes(0.5), boxes(0.9));
        let places = 20.0 * 2.0 * 12.0 * 5.0 * 2.0;
        let share = half.len() as f64 / places;
        assert!(
            (share - 0.5).abs() < 4.0 * (0.25_f64 / places).sqrt(),
            "{share}"
        );
        let mut rest = most.iter();
        assert!(half.iter().all(|one| rest.any(|other| other == one)));
    }

    #[test]
    fn cross_aisles_part_the_rows_evenly() {
        let params = WarehouseParams {
            bays: 7,
            cross_aisles: 2,
            ..WarehouseParams::default()
        };
        let plan = Plan::new(&params);
        let steps: Vec<f64> = (1..7)
            .map(|bay| plan.start(bay) - plan.start(bay - 1))
            .collect();
        let wide = steps.iter().filter(|step| **step > 2.7 + 3.4).count();
        assert_eq!(wide, 2);
        let end = plan.start(6) + 2.7 + 3.5;
        assert!((end - plan.size.x).abs() < 1e-9, "{end}");
    }

    #[test]
    fn nonsense_is_refused_with_what_is_allowed() {
        let with = |change: fn(&mut WarehouseParams)| {
            let mut params = WarehouseParams::default();
            change(&mut params);
            warehouse(&params).expect_err("nonsense").to_string()
        };
        for (message, words) in [
            (
                with(|p| p.aisles = 0),
                "`aisles` must lie between 1 and 200",
            ),
            (with(|p| p.cross_aisles = 12), "fewer than the 12 bays"),
            (with(|p| p.aisle = m(0.9)), "a vehicle of 1 m has to pass"),
            (
                with(|p| p.fill = f64::NAN),
                "`fill` must lie between 0 and 1",
            ),
            (with(|p| p.gates = 50), "no room for them"),
            (with(|p| p.gate_height = m(15.0)), "does not fit"),
            (
                with(|p| (p.aisles, p.bays, p.levels) = (200, 500, 20)),
                "places",
            ),
        ] {
            assert!(message.contains(words), "{message}");
        }
    }
}

//! Cities: blocks between streets, houses on plots, parks.
//!
//! Streets form a grid; a block is what they leave between them. It is a park, or it is cut into
//! plots, always across the longer side, until they are small enough; each plot has a house, of a
//! height that is log-normal, as those of real cities are. Houses and trees keep within their
//! blocks, and lamps stand at the kerb, so every street is free from end to end.

use super::check::{GenerateError, at_least, metres, not_too_many, share, within};
use super::draft::{Draft, Finish, Rect, block, boxed, cylinder, part};
use crate::look::{Color, Meta};
use crate::obstacle::ObstacleShape;
use crate::world::World;
use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_kernel::rng::Stream;
use simbeeotic_units::{Length, math};

/// Parameters of [`city`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CityParams {
    /// The seed: another seed, another city.
    pub seed: i64,
    /// Blocks from west to east, 1 to 500.
    pub columns: u32,
    /// Blocks from south to north, 1 to 500.
    pub rows: u32,
    /// How long a block is from west to east, 10 m to 1 km.
    pub block_length: Length,
    /// How long a block is from south to north, 10 m to 1 km.
    pub block_width: Length,
    /// From kerb to kerb, 2 m to 200 m. Streets run around all blocks.
    pub street: Length,
    /// Between the kerb and the houses, 0 m to 20 m.
    pub pavement: Length,
    /// Plots are cut until their longer side is at most this, 8 m to 1 km.
    pub plot: Length,
    /// Between two houses, 0 m to 50 m.
    pub gap: Length,
    /// The height that half of the houses have, 2 m to 500 m.
    pub height: Length,
    /// The standard deviation of the logarithm of the height, 0 to 2: with 0.5 one house in six is
    /// 1.6 times the median height or more.
    pub height_spread: f64,
    /// No house is higher, 2 m to 1 km.
    pub height_max: Length,
    /// The share of blocks that are parks, 0 to 1.
    pub parks: f64,
    /// Between two trees of a park, 3 m to 100 m.
    pub tree_spacing: Length,
    /// Between two lamps of a street, 5 m to 1 km; they stand on both sides by turns.
    pub lamp_spacing: Length,
    /// Every street is at least as wide as this: a vehicle of this diameter gets along all of them.
    /// Above 0.
    pub clearance: Length,
}

impl Default for CityParams {
    /// Thirty-six blocks of a European town, 400 m across.
    fn default() -> Self {
        Self {
            seed: 1,
            columns: 6,
            rows: 6,
            block_length: Length::si(60.0),
            block_width: Length::si(44.0),
            street: Length::si(12.0),
            pavement: Length::si(2.5),
            plot: Length::si(24.0),
            gap: Length::si(1.0),
            height: Length::si(14.0),
            height_spread: 0.45,
            height_max: Length::si(80.0),
            parks: 0.12,
            tree_spacing: Length::si(9.0),
            lamp_spacing: Length::si(30.0),
            clearance: Length::si(2.0),
        }
    }
}

impl CityParams {
    fn check(&self) -> Result<(), GenerateError> {
        within("columns", self.columns, 1..=500)?;
        within("rows", self.rows, 1..=500)?;
        metres("block_length", self.block_length, 10.0..=1e3)?;
        metres("block_width", self.block_width, 10.0..=1e3)?;
        metres("street", self.street, 2.0..=200.0)?;
        metres("pavement", self.pavement, 0.0..=20.0)?;
        metres("plot", self.plot, 8.0..=1e3)?;
        metres("gap", self.gap, 0.0..=50.0)?;
        metres("height", self.height, 2.0..=500.0)?;
        within("height_spread", self.height_spread, 0.0..=2.0)?;
        metres("height_max", self.height_max, 2.0..=1e3)?;
        share("parks", self.parks)?;
        metres("tree_spacing", self.tree_spacing, 3.0..=100.0)?;
        metres("lamp_spacing", self.lamp_spacing, 5.0..=1e3)?;
        metres("clearance", self.clearance, 1e-3..=100.0)?;
        let smallest = self.block_length.min(self.block_width);
        let least = self.pavement * 2.0 + self.gap + Length::si(HOUSE_MIN_M);
        let why = "a house of 3 m has to stand between its pavements";
        at_least("block_width", smallest, least, why)?;
        let why = format!(
            "a vehicle of {} has to pass between the lamps of both sides",
            self.clearance
        );
        let lamps = Length::si(2.0 * (LAMP_INSET_M + LAMP_REACH_M));
        at_least("street", self.street, self.clearance + lamps, &why)?;
        let blocks = f64::from(self.columns) * f64::from(self.rows);
        let area = (self.block_length.get() * self.block_width.get()) * blocks;
        // A plot is cut while its longer side is too long: its sides are a third of that at least.
        let plots = area / (self.plot.get() * self.plot.get() / 9.0);
        not_too_many("plot", "plots", plots)?;
        let trees = self.parks * area / (self.tree_spacing.get() * self.tree_spacing.get());
        not_too_many("tree_spacing", "trees", trees)?;
        let span = self.block_length + self.block_width;
        not_too_many(
            "lamp_spacing",
            "lamps",
            2.0 * blocks * (span / self.lamp_spacing + 2.0),
        )
    }
}

/// A house is at least this long and wide; where there is less room there is none.
const HOUSE_MIN_M: f64 = 3.0;
/// A lamp's post stands so far from the kerb, in the street, and reaches so far.
const LAMP_INSET_M: f64 = 0.3;
const LAMP_REACH_M: f64 = 0.1;
const LAMP_HEIGHT_M: f64 = 6.0;
/// Houses above this are stepped: a narrower tower on a base.
const STEPPED_M: f64 = 24.0;

const HOUSES: [(&str, Color); 5] = [
    ("brick", Color::rgb(168, 94, 72)),
    ("brick", Color::rgb(190, 140, 104)),
    ("concrete", Color::rgb(186, 182, 170)),
    ("concrete", Color::rgb(206, 196, 168)),
    ("concrete", Color::rgb(160, 166, 172)),
];
const TOWER: (&str, Color) = ("glass", Color::rgb(120, 152, 178));
const LAWN: Color = Color::rgb(104, 150, 82);
const TRUNK: Color = Color::rgb(110, 82, 58);
const CROWN: Color = Color::rgb(62, 116, 60);
const POST: Color = Color::rgb(70, 74, 80);

/// A city around the origin.
///
/// Houses are labelled `house`, towers `tower`, lawns `park`, trees `tree`, lamps `lamp`, with the
/// `block` they stand in as metadata (column and row: `3/0`). Places `crossing 0/0`, ... stand in
/// the middle of each crossing, from the south-west; vehicles start in the area `crossing`, over the
/// one nearest to the origin.
///
/// # Errors
/// A parameter out of its range.
pub fn city(params: &CityParams) -> Result<World, GenerateError> {
    params.check()?;
    let plan = Plan::new(params);
    let mut draft = Draft::default();
    for row in 0..params.rows {
        for column in 0..params.columns {
            plan.block(&mut draft, column, row);
        }
    }
    plan.lamps(&mut draft);
    plan.crossings(&mut draft);
    draft.world.radius = Length::si((0.5 * plan.size.length()).ceil());
    Ok(draft.world)
}

struct Plan<'p> {
    params: &'p CityParams,
    /// A block and the street beside it.
    pitch: DVec2,
    /// The whole city, its outer streets included.
    size: DVec2,
}

impl<'p> Plan<'p> {
    fn new(params: &'p CityParams) -> Self {
        let street = DVec2::splat(params.street.get());
        let block = DVec2::new(params.block_length.get(), params.block_width.get());
        let count = DVec2::new(f64::from(params.columns), f64::from(params.rows));
        let pitch = block + street;
        Self {
            params,
            pitch,
            size: count * pitch + street,
        }
    }

    /// From kerb to kerb.
    fn rect(&self, column: u32, row: u32) -> Rect {
        let at = DVec2::new(f64::from(column), f64::from(row));
        let street = DVec2::splat(self.params.street.get());
        let low = at * self.pitch + street - 0.5 * self.size;
        Rect {
            low,
            high: low + self.pitch - street,
        }
    }

    fn crossing(&self, column: u32, row: u32) -> DVec2 {
        let at = DVec2::new(f64::from(column), f64::from(row));
        at * self.pitch + DVec2::splat(0.5 * self.params.street.get()) - 0.5 * self.size
    }

    fn block(&self, draft: &mut Draft, column: u32, row: u32) {
        let name = format!("{column}/{row}");
        let path = format!("city/block-{column}-{row}");
        let stream = |purpose| Stream::new(self.params.seed.cast_unsigned(), &path, purpose);
        let inside = inset(self.rect(column, row), self.params.pavement.get());
        if stream("park").uniform() < self.params.parks {
            self.park(draft, inside, &name, &mut stream("trees"));
            return;
        }
        let mut plots = Vec::new();
        cut(
            inside,
            self.params.plot.get(),
            &mut stream("plots"),
            &mut plots,
        );
        let (mut heights, mut looks) = (stream("heights"), stream("looks"));
        for plot in plots {
            // Each plot has its draws, whether a house fits on it or not.
            let height = self.height(heights.normal());
            let look = HOUSES[looks.below(HOUSES.len() as u64) as usize];
            let house = inset(plot, 0.5 * self.params.gap.get());
            if house.size().min_element() >= HOUSE_MIN_M {
                self.house(draft, house, height, look, &name);
            }
        }
    }

    fn height(&self, normal: f64) -> f64 {
        let height = self.params.height.get() * math::exp(self.params.height_spread * normal);
        height.clamp(HOUSE_MIN_M, self.params.height_max.get().max(HOUSE_MIN_M))
    }

    fn house(
        &self,
        draft: &mut Draft,
        rect: Rect,
        height: f64,
        (material, color): (&'static str, Color),
        name: &str,
    ) {
        let (foot, size) = (rect.middle().extend(0.0), rect.size());
        if height <= STEPPED_M || size.min_element() < 3.0 * HOUSE_MIN_M {
            let finish = Finish::new(material, color, "house").with("block", name);
            draft.obstacle(foot, 0.0, boxed(size.extend(height)), &finish);
            return;
        }
        let (base, tower) = (0.5 * size, 0.36 * size);
        let step = 0.35 * height;
        let parts = vec![
            block([-base.x, -base.y, 0.0], [base.x, base.y, step]),
            block([-tower.x, -tower.y, step], [tower.x, tower.y, height]),
        ];
        let (material, color) = TOWER;
        let finish = Finish::new(material, color, "tower").with("block", name);
        draft.obstacle(foot, 0.0, ObstacleShape::Parts(parts), &finish);
    }

    fn park(&self, draft: &mut Draft, rect: Rect, name: &str, chance: &mut Stream) {
        let lawn = Finish::new("wood", LAWN, "park").with("block", name);
        let (foot, size) = (rect.middle().extend(0.0), rect.size());
        draft.obstacle(foot, 0.0, boxed(size.extend(0.05)), &lawn);
        let spacing = self.params.tree_spacing.get();
        let count = (size / spacing).floor().max(DVec2::ONE);
        let cell = size / count;
        for row in 0..count.y as u32 {
            for column in 0..count.x as u32 {
                let at = DVec2::new(f64::from(column), f64::from(row)) + DVec2::splat(0.5);
                let draw = |chance: &mut Stream| 2.0 * chance.uniform() - 1.0;
                let shift = DVec2::new(draw(chance), draw(chance)) * (0.2 * spacing);
                let crown = 1.4 + 1.2 * chance.uniform();
                let trunk = 2.0 + 1.5 * chance.uniform();
                let middle = rect.low + at * cell + shift;
                tree(draft, middle, trunk, crown, name);
            }
        }
    }

    fn lamps(&self, draft: &mut Draft) {
        let finish = Finish::new("metal", POST, "lamp");
        let half = 0.5 * self.params.street.get() - LAMP_INSET_M;
        let spacing = self.params.lamp_spacing.get();
        let mut put = |along_x: bool, street: u32, way: f64, side: f64| {
            let corner = self.crossing(0, 0);
            let at = if along_x {
                let y = corner.y + f64::from(street) * self.pitch.y + side * half;
                DVec2::new(corner.x + way, y)
            } else {
                let x = corner.x + f64::from(street) * self.pitch.x + side * half;
                DVec2::new(x, corner.y + way)
            };
            let post = cylinder(2.0 * LAMP_REACH_M, LAMP_HEIGHT_M);
            draft.obstacle(at.extend(0.0), 0.0, post, &finish);
        };
        let Self { params, pitch, .. } = self;
        let streets = [
            (true, params.rows, params.columns, pitch.x),
            (false, params.columns, params.rows, pitch.y),
        ];
        for (along_x, streets, blocks, pitch) in streets {
            for street in 0..=streets {
                for block in 0..blocks {
                    // None on a crossing.
                    let room = pitch - self.params.street.get();
                    let count = (room / spacing).floor().max(1.0) as u32;
                    for lamp in 0..count {
                        let part = (f64::from(lamp) + 0.5) / f64::from(count);
                        let start = f64::from(block) * pitch + 0.5 * self.params.street.get();
                        let side = if lamp % 2 == 0 { 1.0 } else { -1.0 };
                        put(along_x, street, start + part * room, side);
                    }
                }
            }
        }
    }

    fn crossings(&self, draft: &mut Draft) {
        let CityParams { columns, rows, .. } = *self.params;
        let radius = 0.5 * self.params.street.get();
        for row in 0..=rows {
            for column in 0..=columns {
                let at = self.crossing(column, row).extend(2.0);
                draft.place(format!("crossing {column}/{row}"), at, radius, Meta::new());
            }
        }
        let middle = self.crossing(columns.div_ceil(2), rows.div_ceil(2));
        let room = DVec3::new(0.5 * radius, 0.5 * radius, 0.0);
        let low = middle.extend(1.0) - room;
        draft.spawn("crossing", low, low + 2.0 * room + DVec3::Z * 4.0);
    }
}

fn tree(draft: &mut Draft, at: DVec2, trunk: f64, crown: f64, name: &str) {
    let foot = at.extend(0.05);
    let finish = |material, color| Finish::new(material, color, "tree").with("block", name);
    draft.obstacle(foot, 0.0, cylinder(0.35, trunk), &finish("wood", TRUNK));
    let ball = ObstacleShape::Parts(vec![part(
        DVec3::Z * crown,
        ObstacleShape::Sphere {
            radius: super::draft::metres(crown),
        },
    )]);
    let foot = foot + DVec3::Z * (trunk - 0.2);
    draft.obstacle(foot, 0.0, ball, &finish("foliage", CROWN));
}

fn inset(rect: Rect, by: f64) -> Rect {
    Rect {
        low: rect.low + DVec2::splat(by),
        high: rect.high - DVec2::splat(by),
    }
}

/// Cuts a plot across its longer side, somewhere in its middle third, until the sides are at most
/// `longest`.
fn cut(plot: Rect, longest: f64, chance: &mut Stream, plots: &mut Vec<Rect>) {
    let size = plot.size();
    if size.max_element() <= longest {
        plots.push(plot);
        return;
    }
    let share = (1.0 + chance.uniform()) / 3.0;
    let (mut first, mut second) = (plot, plot);
    if size.x >= size.y {
        let at = plot.low.x + share * size.x;
        (first.high.x, second.low.x) = (at, at);
    } else {
        let at = plot.low.y + share * size.y;
        (first.high.y, second.low.y) = (at, at);
    }
    cut(first, longest, chance, plots);
    cut(second, longest, chance, plots);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Search, fingerprint};
    use simbeeotic_units::Position;

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    fn small(seed: i64) -> CityParams {
        CityParams {
            seed,
            columns: 3,
            rows: 2,
            street: m(8.0),
            clearance: m(3.0),
            ..CityParams::default()
        }
    }

    #[test]
    fn a_city_stays_what_it_is() {
        let found =
            [CityParams::default(), small(7)].map(|p| fingerprint(&city(&p).expect("it can be")));
        assert_eq!(found, GOLDEN, "{found:#018x?}");
    }
    const GOLDEN: [u64; 2] = [0x12a2_bcb0_ab7e_9e76, 0xd538_e5b0_4f86_a44a];

    /// How many crossings of a city are reached from its first, below the roofs.
    fn crossings_reached(params: &CityParams, world: &World) -> usize {
        let plan = Plan::new(params);
        let half = 0.5 * plan.size;
        let search = Search {
            vehicle_radius: m((0.5 - 0.14) * params.clearance.get()),
            cell: m(0.1 * params.clearance.get()),
            within: Some([
                Position::from_si((-half).extend(0.0)),
                Position::from_si(half.extend(1.5 * params.clearance.get())),
            ]),
            seed: 0,
        };
        let at = |column, row| {
            let middle = plan.crossing(column, row);
            Position::from_si(middle.extend(0.7 * params.clearance.get()))
        };
        let reach = search
            .run(world, at(0, 0))
            .expect("it starts on a crossing");
        let all = (0..=params.rows).flat_map(|r| (0..=params.columns).map(move |c| (c, r)));
        all.filter(|(c, r)| reach.contains(at(*c, *r))).count()
    }

    #[test]
    fn every_crossing_is_reached_along_the_streets() {
        for seed in 0..4 {
            let params = small(seed);
            let world = city(&params).expect("it can be");
            assert!(world.check().is_empty(), "{:?}", world.check());
            assert_eq!(crossings_reached(&params, &world), 12, "{seed}");
        }
    }

    /// Negative control: a street closed by a wall is found.
    #[test]
    fn a_crossing_behind_walls_is_not_reached() {
        let params = CityParams {
            columns: 1,
            rows: 1,
            ..small(1)
        };
        let mut world = city(&params).expect("it can be");
        let corner = Plan::new(&params).crossing(1, 1);
        let mut draft = Draft {
            world: std::mem::take(&mut world),
        };
        let finish = Finish::of("concrete", "");
        let high = |x, y| boxed(DVec3::new(x, y, 9.0));
        draft.obstacle(
            (corner - DVec2::X * 6.0).extend(0.0),
            0.0,
            high(0.5, 60.0),
            &finish,
        );
        draft.obstacle(
            (corner - DVec2::Y * 6.0).extend(0.0),
            0.0,
            high(60.0, 0.5),
            &finish,
        );
        assert_eq!(crossings_reached(&params, &draft.world), 3);
    }

    #[test]
    fn houses_keep_to_their_blocks_and_their_heights_are_log_normal() {
        let params = CityParams {
            columns: 30,
            rows: 30,
            parks: 0.0,
            height_max: m(1000.0),
            ..CityParams::default()
        };
        let plan = Plan::new(&params);
        let world = city(&params).expect("it can be");
        let mut logs = Vec::new();
        for object in world
            .objects(0)
            .iter()
            .filter(|o| o.meta.contains_key("block"))
        {
            let (column, row) = object.meta["block"].split_once('/').expect("two numbers");
            let number = |text: &str| text.parse().expect("a number");
            let rect = plan.rect(number(column), number(row));
            let mut top = 0.0_f64;
            for solid in &object.solids {
                let crate::SolidShape::Box {
                    half_length,
                    half_width,
                    half_height,
                } = solid.shape
                else {
                    panic!("houses are boxes");
                };
                let (center, half) = (
                    solid.center.si(),
                    [half_length, half_width].map(Length::get),
                );
                let half = DVec2::from_array(half);
                let (low, high) = (center.truncate() - half, center.truncate() + half);
                assert!((low - rect.low).min_element() >= 2.5 - 1e-5);
                assert!((rect.high - high).min_element() >= 2.5 - 1e-5);
                top = top.max(center.z + half_height.get());
            }
            logs.push(math::ln(top / 14.0));
        }
        let n = logs.len() as f64;
        assert!(n > 5_000.0, "{n}");
        let mean = logs.iter().sum::<f64>() / n;
        let spread = (logs.iter().map(|l| (l - mean) * (l - mean)).sum::<f64>() / n).sqrt();
        assert!(mean.abs() < 4.0 * 0.45 / n.sqrt(), "{mean}");
        assert!(
            (spread / 0.45 - 1.0).abs() < 4.0 / (2.0 * n).sqrt(),
            "{spread}"
        );
    }

    #[test]
    fn more_parks_leave_the_other_blocks_as_they_are() {
        let houses = |parks| {
            let world = city(&CityParams { parks, ..small(3) }).expect("it can be");
            let houses = world.obstacles.into_iter().filter(|o| o.label != "lamp");
            houses
                .filter(|o| !["park", "tree"].contains(&o.label.as_str()))
                .collect::<Vec<_>>()
        };
        let (none, some) = (houses(0.0), houses(0.5));
        assert!(some.len() < none.len() && !some.is_empty());
        assert!(some.iter().all(|house| none.contains(house)));
        assert!(houses(1.0).is_empty());
    }

    #[test]
    fn nonsense_is_refused_with_what_is_allowed() {
        let with = |change: fn(&mut CityParams)| {
            let mut params = CityParams::default();
            change(&mut params);
            city(&params).expect_err("nonsense").to_string()
        };
        for (message, words) in [
            (
                with(|p| p.columns = 0),
                "`columns` must lie between 1 and 500",
            ),
            (
                with(|p| p.street = m(f64::NAN)),
                "`street` must lie between",
            ),
            (with(|p| p.clearance = m(11.5)), "between the lamps"),
            (with(|p| p.parks = 1.5), "`parks` must lie between 0 and 1"),
            (with(|p| p.height_spread = -0.1), "`height_spread`"),
            (
                with(|p| {
                    (p.columns, p.rows, p.plot) = (500, 500, m(8.0));
                }),
                "plots",
            ),
        ] {
            assert!(message.contains(words), "{message}");
        }
    }
}

//! Forests: trees that keep their distance, bushes, stones, a clearing.
//!
//! Trees stand evenly by chance, none closer to another than `spacing`, as many as `density` says
//! for the area outside the clearing. A spruce is a trunk and a cone, a beech a trunk and a ball, a
//! birch a trunk and a capsule, a snag a trunk alone. Crowns are solid and of the material
//! `foliage`, of which radio waves lose some; below them one flies.

use super::check::{GenerateError, at_least, error, metres, not_too_many, within};
use super::draft::{Draft, Finish, Rect, cylinder, metres as size};
use super::scatter::{COVER_MAX, scatter};
use crate::look::{Color, Meta};
use crate::mesh::Hull;
use crate::obstacle::ObstacleShape;
use crate::world::World;
use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_kernel::rng::Stream;
use simbeeotic_units::{Length, Offset, math};
use std::f64::consts::PI;

/// Parameters of [`forest`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ForestParams {
    /// The seed: another seed, another forest.
    pub seed: i64,
    /// From west to east, 5 m to 20 km.
    pub length: Length,
    /// From south to north, 5 m to 20 km.
    pub width: Length,
    /// Trees on a hectare (10,000 square metres) outside the clearing, 0 to 20,000.
    pub trees_per_hectare: f64,
    /// From the middle of a trunk to that of the next, at least; 0.3 m to 100 m. Trees cover at most
    /// 42 % of the area with discs of this diameter.
    pub spacing: Length,
    /// How high trees are, in the median; 3 m to 60 m.
    pub height: Length,
    /// How much heights differ: the standard deviation of their logarithm, 0 to 0.5. None is below half or above
    /// 1.7 of the median.
    pub height_spread: f64,
    /// Parts of spruces among the trees: shares are these numbers over their sum. Not negative.
    pub spruces: f64,
    /// Parts of beeches.
    pub beeches: f64,
    /// Parts of birches.
    pub birches: f64,
    /// Parts of snags: trunks without a crown.
    pub snags: f64,
    /// Bushes on a hectare, 0 to 20,000.
    pub bushes_per_hectare: f64,
    /// Stones on a hectare, 0 to 20,000.
    pub stones_per_hectare: f64,
    /// The radius of the clearing in the middle, 0 m (none) to 1 km.
    pub clearing: Length,
    /// Between any two trunks there is at least so much room: a vehicle of this diameter gets
    /// through, over the bushes and below the crowns. 1 cm to 20 m.
    pub clearance: Length,
}

impl Default for ForestParams {
    fn default() -> Self {
        Self {
            seed: 1,
            length: Length::si(100.0),
            width: Length::si(100.0),
            trees_per_hectare: 400.0,
            spacing: Length::si(2.0),
            height: Length::si(14.0),
            height_spread: 0.25,
            spruces: 4.0,
            beeches: 4.0,
            birches: 1.5,
            snags: 0.5,
            bushes_per_hectare: 200.0,
            stones_per_hectare: 40.0,
            clearing: Length::si(10.0),
            clearance: Length::si(0.5),
        }
    }
}

/// Heights, as shares of the median.
const HEIGHTS: [f64; 2] = [0.5, 1.7];
/// A trunk's diameter, as a share of its height.
const TRUNK: f64 = 0.02;
/// Bushes and stones are lower than this.
const LOW_M: f64 = 1.2;
/// Crowns begin at this share of the height, but not below two metres and the clearance.
const CROWN: f64 = 0.25;
const HECTARE_M2: f64 = 1e4;

const BARK: Color = Color::rgb(98, 74, 54);
const BIRCH_BARK: Color = Color::rgb(214, 210, 200);
const DEAD: Color = Color::rgb(140, 130, 118);
const STONE: Color = Color::rgb(128, 126, 122);
const SOIL: Color = Color::rgb(88, 92, 52);

#[derive(Clone, Copy, PartialEq)]
enum Species {
    Spruce,
    Beech,
    Birch,
    Snag,
}

impl Species {
    fn name(self) -> &'static str {
        match self {
            Self::Spruce => "spruce",
            Self::Beech => "beech",
            Self::Birch => "birch",
            Self::Snag => "snag",
        }
    }

    fn leaves(self) -> Color {
        match self {
            Self::Spruce => Color::rgb(34, 74, 46),
            Self::Beech => Color::rgb(70, 122, 46),
            Self::Birch | Self::Snag => Color::rgb(132, 160, 66),
        }
    }
}

impl ForestParams {
    fn check(&self) -> Result<(), GenerateError> {
        metres("length", self.length, 5.0..=20_000.0)?;
        metres("width", self.width, 5.0..=20_000.0)?;
        for (key, density) in [
            ("trees_per_hectare", self.trees_per_hectare),
            ("bushes_per_hectare", self.bushes_per_hectare),
            ("stones_per_hectare", self.stones_per_hectare),
        ] {
            within(key, density, 0.0..=20_000.0)?;
            // A tree has two parts.
            not_too_many(key, "things", 2.0 * density * self.area() / HECTARE_M2)?;
        }
        metres("spacing", self.spacing, 0.3..=100.0)?;
        metres("height", self.height, 3.0..=60.0)?;
        within("height_spread", self.height_spread, 0.0..=0.5)?;
        for (key, parts) in [
            ("spruces", self.spruces),
            ("beeches", self.beeches),
            ("birches", self.birches),
            ("snags", self.snags),
        ] {
            within(key, parts, 0.0..=1e6)?;
        }
        if self.parts().iter().sum::<f64>() <= 0.0 && self.trees_per_hectare > 0.0 {
            let message = "is 0, as are `beeches`, `birches` and `snags`: of what are the trees?";
            return error("spruces", message.into());
        }
        metres("clearing", self.clearing, 0.0..=1_000.0)?;
        metres("clearance", self.clearance, 0.01..=20.0)?;
        let thickest = self.height * (TRUNK * HEIGHTS[1]);
        let why = format!(
            "between two trunks of up to {thickest:.2}, a vehicle of {} has to pass",
            self.clearance
        );
        at_least("spacing", self.spacing, thickest + self.clearance, &why)?;
        let lowest = self.height * HEIGHTS[0];
        let why = "the crown of the smallest tree begins above a vehicle over the bushes";
        at_least(
            "height",
            lowest,
            Length::si(self.crown_foot(0.0) + 0.5),
            why,
        )?;
        let disc = 0.25 * PI * self.spacing.get() * self.spacing.get();
        let most = COVER_MAX / disc * HECTARE_M2;
        if self.trees_per_hectare > most {
            let message = format!(
                "is {}; at most {most:.0} trees keep {} from each other",
                self.trees_per_hectare, self.spacing
            );
            return error("trees_per_hectare", message);
        }
        let hole = 2.0 * self.clearing.get();
        if hole >= self.length.min(self.width).get() && hole > 0.0 {
            let message = format!("is {}: nothing is left around it", self.clearing);
            return error("clearing", message);
        }
        Ok(())
    }

    fn parts(&self) -> [f64; 4] {
        [self.spruces, self.beeches, self.birches, self.snags]
    }

    /// Of the whole, in square metres.
    fn area(&self) -> f64 {
        self.length.get() * self.width.get()
    }

    /// Things of this density outside the clearing.
    fn count(&self, per_hectare: f64) -> usize {
        let radius = self.clearing.get();
        let area = self.area() - PI * radius * radius;
        (per_hectare * area / HECTARE_M2).round() as usize
    }

    /// Where the crown of a tree of this height begins.
    fn crown_foot(&self, height: f64) -> f64 {
        (CROWN * height)
            .max(LOW_M + self.clearance.get() + 0.3)
            .max(2.0)
    }

    fn species(&self, draw: f64) -> Species {
        let all = [
            Species::Spruce,
            Species::Beech,
            Species::Birch,
            Species::Snag,
        ];
        let parts = self.parts();
        let mut left = draw * parts.iter().sum::<f64>();
        for (species, part) in all.into_iter().zip(parts) {
            if left < part {
                return species;
            }
            left -= part;
        }
        Species::Snag
    }
}

/// A forest around the origin, on the ground.
///
/// Trunk and crown of a tree are two objects, both labelled with its species and with the metadata
/// `tree`, its number. The clearing is the place `clearing`, and the area to start in (a metre above
/// the ground); without one that is the middle of the forest, above the trees.
///
/// # Errors
/// A parameter out of its range.
pub fn forest(params: &ForestParams) -> Result<World, GenerateError> {
    params.check()?;
    Ok(build(params).world)
}

fn build(p: &ForestParams) -> Draft {
    let mut draft = Draft::default();
    draft.world.ground.color = SOIL;
    let half = 0.5 * DVec2::new(p.length.get(), p.width.get());
    let rect = Rect {
        low: -half,
        high: half,
    };
    let clearing = p.clearing.get();
    let outside = |point: DVec2| point.length() >= clearing;
    let stream = |purpose| Stream::new(p.seed.cast_unsigned(), "forest", purpose);
    let places = scatter(
        rect,
        p.count(p.trees_per_hectare),
        p.spacing.get(),
        &mut stream("trees"),
        outside,
    );
    for (at, place) in places.iter().enumerate() {
        let path = format!("forest/tree-{at}");
        tree(
            &mut draft,
            p,
            *place,
            at,
            &mut Stream::new(p.seed.cast_unsigned(), &path, "tree"),
        );
    }
    let mut chance = stream("bushes");
    let count = p.count(p.bushes_per_hectare);
    for place in scatter(rect, count, 0.0, &mut stream("places of bushes"), outside) {
        let radius = size(0.25 + (0.5 * LOW_M - 0.25) * chance.uniform());
        let finish = Finish::new("foliage", Color::rgb(84, 112, 48), "bush");
        draft.obstacle(
            place.extend(0.0),
            0.0,
            ObstacleShape::Sphere { radius },
            &finish,
        );
    }
    let mut chance = stream("stones");
    let count = p.count(p.stones_per_hectare);
    for place in scatter(rect, count, 0.0, &mut stream("places of stones"), outside) {
        let stone = stone(&mut chance);
        let finish = Finish::new("concrete", STONE, "stone");
        draft.obstacle(place.extend(0.0), 0.0, stone, &finish);
    }
    let top = HEIGHTS[1] * p.height.get() + 2.0;
    let (reach, low) = if clearing > 0.0 {
        (0.5 * clearing, 1.0)
    } else {
        (2.0, top)
    };
    let corner = DVec3::new(reach, reach, 0.0);
    draft.spawn(
        "clearing",
        DVec3::Z * low - corner,
        DVec3::Z * (low + 1.0) + corner,
    );
    draft.place("clearing", DVec3::Z * (low + 0.5), clearing, Meta::new());
    draft.world.radius = Length::si(half.length().ceil());
    draft
}

fn tree(draft: &mut Draft, p: &ForestParams, place: DVec2, at: usize, chance: &mut Stream) {
    let species = p.species(chance.uniform());
    let factor = math::exp(p.height_spread * chance.normal()).clamp(HEIGHTS[0], HEIGHTS[1]);
    // Whole centimetres read better.
    let height = (p.height.get() * factor * 100.0).round() / 100.0;
    let shade = chance.uniform();
    let crown = p.crown_foot(height).min(height - 0.5);
    let length = height - crown;
    let finish = |material, color| Finish::new(material, color, species.name()).with("tree", at);
    let bark = match species {
        Species::Birch => BIRCH_BARK,
        Species::Snag => DEAD,
        _ => BARK,
    };
    let trunk = match species {
        Species::Snag => 0.6 * height,
        _ => crown + 0.3 * length,
    };
    let foot = place.extend(0.0);
    let thick = (TRUNK * height * 1e3).floor() / 1e3;
    draft.obstacle(foot, 0.0, cylinder(thick, trunk), &finish("wood", bark));
    let shape = match species {
        Species::Spruce => ObstacleShape::Cone {
            radius: size(0.28 * length),
            height: size(length),
        },
        Species::Beech => ObstacleShape::Sphere {
            radius: size((0.5 * length).min(0.26 * height)),
        },
        Species::Birch => ObstacleShape::Capsule {
            radius: size(0.17 * length),
            height: size(length),
        },
        Species::Snag => return,
    };
    let c = species.leaves();
    let tint = |x: u8| (f64::from(x) * (0.85 + 0.3 * shade)).min(255.0) as u8;
    let color = Color::rgb(tint(c.red), tint(c.green), tint(c.blue));
    draft.obstacle(
        foot + DVec3::Z * crown,
        0.0,
        shape,
        &finish("foliage", color),
    );
}

/// A stone: the hull of points around a squeezed ball, half in the ground.
fn stone(chance: &mut Stream) -> ObstacleShape {
    let radius = 0.2 + 0.5 * chance.uniform();
    let squeeze = DVec3::new(
        1.0,
        0.6 + 0.4 * chance.uniform(),
        0.5 + 0.5 * chance.uniform(),
    );
    // The corners of a cube are among them: whatever chance says, it has a volume.
    let corners = (0..8).map(|at| {
        let sign = |bit: i32| if at & bit == 0 { -0.5 } else { 0.5 };
        DVec3::new(sign(1), sign(2), sign(4))
    });
    let around: Vec<DVec3> = (0..10).map(|_| chance.unit_vector()).collect();
    let point = |p: DVec3| {
        let p = p * squeeze * radius;
        Offset::from_si((p * 1e3).round() / 1e3 + DVec3::ZERO)
    };
    ObstacleShape::Hull(Hull {
        points: corners.chain(around).map(point).collect(),
        ..Hull::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Search, fingerprint};
    use crate::obstacle::Obstacle;
    use simbeeotic_units::Position;

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    fn trunks(world: &World) -> Vec<&Obstacle> {
        let tree = |o: &&Obstacle| o.material.as_deref() == Some("wood");
        world.obstacles.iter().filter(tree).collect()
    }

    #[test]
    fn as_many_trees_stand_on_a_hectare_as_were_asked_for() {
        for (density, clearing, want) in [(400.0, 0.0, 800), (1_000.0, 20.0, 1_874), (0.0, 5.0, 0)]
        {
            let params = ForestParams {
                length: m(200.0),
                trees_per_hectare: density,
                clearing: m(clearing),
                ..ForestParams::default()
            };
            let world = forest(&params).expect("it can be");
            assert!(world.check().is_empty(), "{:?}", world.check());
            let trunks = trunks(&world);
            assert_eq!(trunks.len(), want);
            let east = trunks.iter().filter(|t| t.position.si().x > 0.0).count() as f64;
            assert!((east - 0.5 * want as f64).abs() <= 0.06 * want as f64);
            for (i, a) in trunks.iter().enumerate() {
                let a = a.position.si();
                assert!(a.length() >= clearing - 1e-6);
                let near = |b: &&Obstacle| b.position.si().distance(a) < 2.0 - 1e-5;
                assert!(!trunks[..i].iter().any(near));
            }
        }
    }

    #[test]
    fn the_densest_forest_that_is_allowed_can_be_made() {
        let params = ForestParams {
            trees_per_hectare: 1_336.0,
            ..ForestParams::default()
        };
        let world = forest(&params).expect("it can be");
        assert_eq!(trunks(&world).len(), params.count(1_336.0));
    }

    #[test]
    fn species_and_heights_are_spread_as_asked_for() {
        let params = ForestParams {
            length: m(500.0),
            bushes_per_hectare: 0.0,
            stones_per_hectare: 0.0,
            ..ForestParams::default()
        };
        let world = forest(&params).expect("it can be");
        let trunks = trunks(&world);
        let share = |name: &str| {
            let of = trunks.iter().filter(|t| t.label == name).count();
            of as f64 / trunks.len() as f64
        };
        for (name, want) in [
            ("spruce", 0.4),
            ("beech", 0.4),
            ("birch", 0.15),
            ("snag", 0.05),
        ] {
            assert!(
                (share(name) - want).abs() < 0.035,
                "{name}: {}",
                share(name)
            );
        }
        let snag = |o: &&Obstacle| o.label == "snag";
        let mut heights: Vec<f64> = world
            .obstacles
            .iter()
            .filter(snag)
            .filter_map(|o| match o.shape {
                ObstacleShape::Cylinder { height, .. } => Some(height.get() / 0.6),
                _ => None,
            })
            .collect();
        heights.sort_by(f64::total_cmp);
        let median = heights[heights.len() / 2];
        assert!((median - 14.0).abs() < 1.3, "{median}");
        assert!(heights[0] >= 7.0 - 0.02 && heights[heights.len() - 1] <= 23.8 + 0.02);
    }

    #[test]
    fn a_vehicle_gets_from_the_clearing_between_the_trees_to_every_side() {
        let params = ForestParams {
            length: m(30.0),
            width: m(30.0),
            trees_per_hectare: 1_000.0,
            bushes_per_hectare: 1_000.0,
            clearing: m(4.0),
            clearance: m(0.8),
            ..ForestParams::default()
        };
        let world = forest(&params).expect("it can be");
        let search = Search {
            vehicle_radius: m(0.25),
            cell: m(0.1),
            // Below the crowns.
            within: Some([
                Position::from_xyz(-16.0, -16.0, 0.0),
                Position::from_xyz(16.0, 16.0, params.crown_foot(0.0)),
            ]),
            seed: 0,
        };
        let start = Position::from_xyz(0.0, 0.0, 1.5);
        let reach = search
            .run(&world, start)
            .expect("it starts in the clearing");
        for (x, y) in [(15.5, 0.0), (-15.5, 0.0), (0.0, 15.5), (0.0, -15.5)] {
            assert!(reach.contains(Position::from_xyz(x, y, 1.6)), "{x} {y}");
        }
        let trunk = trunks(&world)[0].position.si();
        let inside = Position::from_si(trunk.with_z(1.5));
        assert!(!reach.contains(inside), "trunks are solid");
    }

    #[test]
    fn bushes_do_not_move_the_trees() {
        let world = |change: fn(&mut ForestParams)| {
            let mut params = ForestParams::default();
            change(&mut params);
            forest(&params).expect("it can be").obstacles
        };
        let usual = world(|_| ());
        let bare = world(|p| (p.bushes_per_hectare, p.stones_per_hectare) = (0.0, 0.0));
        assert_eq!(usual[..bare.len()], bare[..]);
        assert_ne!(world(|p| p.seed = 2)[0], usual[0]);
    }

    #[test]
    fn a_forest_stays_what_it_is() {
        let found = fingerprint(&forest(&ForestParams::default()).expect("it can be"));
        assert_eq!(found, GOLDEN, "{found:#018x?}");
    }
    const GOLDEN: u64 = 0x25e1_2c20_0241_101c;

    #[test]
    fn nonsense_is_refused_with_what_is_allowed() {
        let with = |change: fn(&mut ForestParams)| {
            let mut params = ForestParams::default();
            change(&mut params);
            forest(&params).expect_err("nonsense").to_string()
        };
        for (message, words) in [
            (
                with(|p| p.length = m(1.0)),
                "`length` must lie between 5 m and 20000 m",
            ),
            (with(|p| p.width = m(f64::NAN)), "`width` must lie between"),
            (
                with(|p| p.trees_per_hectare = -1.0),
                "`trees_per_hectare` must lie between",
            ),
            (
                with(|p| p.trees_per_hectare = 2_000.0),
                "at most 1337 trees keep 2 m",
            ),
            (
                with(|p| (p.length, p.width) = (m(2e4), m(2e4))),
                "at most 1000000",
            ),
            (
                with(|p| p.spacing = m(0.5)),
                "between two trunks of up to 0.48 m",
            ),
            (with(|p| p.height = m(100.0)), "`height` must lie between"),
            (
                with(|p| p.height = m(4.0)),
                "the crown of the smallest tree",
            ),
            (
                with(|p| p.height_spread = 0.6),
                "`height_spread` must lie between",
            ),
            (with(|p| p.birches = -1.0), "`birches` must lie between"),
            (
                with(|p| (p.spruces, p.beeches, p.birches, p.snags) = (0.0, 0.0, 0.0, 0.0)),
                "of what",
            ),
            (
                with(|p| p.bushes_per_hectare = 1e9),
                "`bushes_per_hectare` must lie between",
            ),
            (with(|p| p.clearing = m(50.0)), "nothing is left around it"),
            (
                with(|p| p.clearance = m(0.0)),
                "`clearance` must lie between",
            ),
        ] {
            assert!(message.contains(words), "{message}");
        }
    }
}

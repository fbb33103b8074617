//! Where models start: a point, or a place drawn or counted off for each of them.
//!
//! | text | each model starts |
//! |---|---|
//! | `["1 m", "2 m", "0 m"]` | there |
//! | `{ point = [...] }` | there, with a heading, say |
//! | `{ box = [...], from = [...] }` | anywhere in the box from one corner on |
//! | `{ ball = "20 m", center = [...] }` | anywhere in the ball that is above the ground |
//! | `{ grid = [4, 3, 2], spacing = "2 m", from = [...] }` | at its own point of the grid, `x` first |
//! | `{ list = [[...], [...]] }` | at its own point of the list |
//! | `{ file = "positions.csv" }` | at its own line: `x, y, z` in metres |
//! | `{ area = "roof" }` | in the `[[spawn]]` of that name in the world |
//!
//! With each of them `yaw = "90 deg"` or `heading = "0 deg"` turns the model; `"random"` turns each
//! one its own way. Draws hang on the seed and the model's path: nobody else moves when a model is
//! added.

use super::Context;
use super::section::{Section, read};
use crate::limit::{MODELS_MAX, START_M_MAX};
use simbeeotic_model::config::{Fault, Node, Span, Value};
use simbeeotic_model::kernel::Stream;
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::{Attitude, Heading, Length, Pose, Position, Yaw, math};
use simbeeotic_world::Spawn;
use std::f64::consts::TAU;

/// Where the models of one entry start.
#[derive(Clone, Debug)]
pub(super) struct Start {
    placing: Placing,
    turn: Turn,
}

#[derive(Clone, Debug)]
enum Placing {
    Point(DVec3),
    Box {
        from: DVec3,
        size: DVec3,
    },
    Ball {
        center: DVec3,
        radius_m: f64,
    },
    Grid {
        from: DVec3,
        spacing: DVec3,
        cells: [u64; 3],
    },
    List(Vec<DVec3>),
    Area(Spawn),
}

#[derive(Clone, Copy, Debug)]
enum Turn {
    Fixed(Attitude),
    Random,
}

/// The forms of a start, by their key.
const FORMS: [&str; 7] = ["point", "box", "ball", "grid", "list", "file", "area"];
/// Less of a ball above the ground than this part of it is refused.
const LEAST_ABOVE_GROUND: f64 = 1e-3;
/// Draws until a point of a ball lies above the ground, at most.
const DRAWS_MAX: usize = 100_000;
/// Longest list of starts.
const LIST_MAX: usize = MODELS_MAX as usize;

impl Default for Start {
    fn default() -> Self {
        Self {
            placing: Placing::Point(DVec3::ZERO),
            turn: Turn::Fixed(Attitude::IDENTITY),
        }
    }
}

impl Start {
    /// How many models it has places for; `None`: for any number.
    pub(super) fn places(&self) -> Option<u64> {
        match &self.placing {
            Placing::Grid { cells, .. } => Some(cells.iter().product()),
            Placing::List(list) => Some(list.len() as u64),
            Placing::Area(area) => area.places(),
            _ => None,
        }
    }

    /// Where model number `index` starts, which is at `path`.
    pub(super) fn pose(&self, seed: u64, path: &str, index: u64) -> Pose {
        let mut stream = Stream::new(seed, path, "start");
        let mut looks = None;
        let position = match &self.placing {
            Placing::Point(point) => *point,
            Placing::Box { from, size } => {
                let share = [stream.uniform(), stream.uniform(), stream.uniform()];
                *from + *size * DVec3::from_array(share)
            }
            Placing::Ball { center, radius_m } => above_ground(&mut stream, *center, *radius_m),
            Placing::Grid {
                from,
                spacing,
                cells: [nx, ny, _],
            } => {
                let (nx, ny) = ((*nx).max(1), (*ny).max(1));
                let (x, y, z) = (index % nx, index / nx % ny, index / nx / ny);
                *from + *spacing * DVec3::new(x as f64, y as f64, z as f64)
            }
            Placing::List(list) => usize::try_from(index)
                .ok()
                .and_then(|i| list.get(i))
                .copied()
                .unwrap_or_default(),
            Placing::Area(area) => {
                let pose = area.place(index, &mut stream);
                looks = pose.yaw;
                pose.position.si()
            }
        };
        let attitude = match (looks, self.turn) {
            (Some(yaw), _) => Attitude::from_yaw(yaw),
            (None, Turn::Fixed(attitude)) => attitude,
            (None, Turn::Random) => {
                let angle = simbeeotic_units::Angle::si(stream.uniform() * TAU);
                Attitude::from_yaw(Yaw::new(angle))
            }
        };
        Pose::new(Position::from_si(position), attitude)
    }

    /// Reads a start.
    pub(super) fn read(node: &Node, cx: &mut Context<'_>) -> Option<Self> {
        if node.as_array().is_some() {
            let point = place(node, &mut cx.faults)?;
            return Some(Self {
                placing: Placing::Point(point),
                ..Self::default()
            });
        }
        let mut section = Section::open(node, "a start", &mut cx.faults)?;
        let given: Vec<&'static str> = FORMS
            .into_iter()
            .filter(|form| section.get(form).is_some())
            .collect();
        let form = match given.as_slice() {
            [one] => *one,
            [] => {
                section.known_turns();
                section.finish(&mut cx.faults);
                let message = "this start says nowhere";
                let fault = Fault::error(node.span, message);
                cx.faults.push(
                    fault.help("one of `point`, `box`, `ball`, `grid`, `list`, `file`, `area`"),
                );
                return None;
            }
            [_, second, ..] => {
                let span = section.entry(second).map_or(node.span, |(key, _)| key.span);
                let message = format!("`{}` and `{second}` say two different places", given[0]);
                cx.faults.push(Fault::error(span, message));
                return None;
            }
        };
        let value = section.get(form)?;
        let placing = cx.placing(form, value, &mut section);
        let turn = turn(&mut section, &mut cx.faults);
        section.finish(&mut cx.faults);
        Some(Self {
            placing: placing?,
            turn: turn?,
        })
    }
}

impl Section<'_> {
    /// Makes the keys of a turn known, for guesses.
    fn known_turns(&mut self) {
        for key in ["yaw", "heading", "from", "center", "spacing"] {
            self.get(key);
        }
    }
}

impl Context<'_> {
    fn placing(&mut self, form: &str, value: &Node, section: &mut Section<'_>) -> Option<Placing> {
        let faults = &mut self.faults;
        match form {
            "point" => Some(Placing::Point(place(value, faults)?)),
            "box" => {
                let from = corner(section, "from", faults);
                let size = place(value, faults)?;
                if size.min_element() < 0.0 {
                    faults.push(Fault::error(
                        value.span,
                        "the size of a box is not negative",
                    ));
                    return None;
                }
                let from = from?;
                Some(Placing::Box { from, size })
            }
            "ball" => {
                let center = corner(section, "center", faults);
                let radius_m = extent(value, faults)?;
                let center = center?;
                if radius_m < 0.0 {
                    faults.push(Fault::error(
                        value.span,
                        "the radius of a ball is not negative",
                    ));
                    return None;
                }
                if share_above_ground(center.z, radius_m) < LEAST_ABOVE_GROUND {
                    let message = "this ball is all, or almost all, under the ground";
                    faults.push(Fault::error(value.span, message));
                    return None;
                }
                Some(Placing::Ball { center, radius_m })
            }
            "grid" => {
                let from = corner(section, "from", faults);
                let spacing = section.required("spacing", "spacing = \"2 m\"", faults);
                let cells: Option<[u64; 3]> = read(value, faults);
                let spacing = spacing.and_then(|node| match node.value {
                    Value::Array(_) => place(node, faults),
                    _ => extent(node, faults).map(DVec3::splat),
                });
                let cells = cells?;
                let product = cells.iter().try_fold(1_u64, |all, n| all.checked_mul(*n));
                if !product.is_some_and(|n| (1..=MODELS_MAX).contains(&n)) {
                    let message = format!("a grid has from 1 to {MODELS_MAX} points");
                    faults.push(Fault::error(value.span, message));
                    return None;
                }
                let (from, spacing) = (from?, spacing?);
                let last = from + spacing * DVec3::from(cells.map(|n| (n - 1) as f64));
                if !last.to_array().into_iter().all(near) {
                    let message = "the last point of this grid is too far from the origin";
                    faults.push(Fault::error(value.span, message).help(far_help()));
                    return None;
                }
                Some(Placing::Grid {
                    from,
                    spacing,
                    cells,
                })
            }
            "list" => {
                let list: Vec<Position> = read(value, faults)?;
                if list.is_empty() {
                    faults.push(Fault::error(value.span, "this list of starts is empty"));
                    return None;
                }
                let nodes = value.as_array().unwrap_or_default();
                let places = nodes.iter().map(|node| place(node, faults));
                // All of them are looked at, so that all faults are found.
                let places: Vec<Option<DVec3>> = places.collect();
                places.into_iter().collect::<Option<_>>().map(Placing::List)
            }
            "area" => {
                let name: String = read(value, faults)?;
                // Of a world that cannot be read enough has been said.
                let areas = self.areas.as_ref()?;
                if let Some(area) = areas.iter().find(|area| area.name == name) {
                    return Some(Placing::Area(area.clone()));
                }
                let known = areas.iter().map(|area| area.name.as_str());
                let fault = Fault::unknown(value.span, "area to start in", &name, known);
                self.faults.push(match areas.is_empty() {
                    true => fault.help("the world has none: a `[[spawn]]` there makes one"),
                    false => fault,
                });
                None
            }
            _ => {
                let name: String = read(value, faults)?;
                let list = self.positions(&name, value.span)?;
                Some(Placing::List(list))
            }
        }
    }

    /// The positions in a file of lines `x, y, z`, in metres. A first line of words, none of which
    /// begins like a number, is a heading; empty lines and lines that begin with `#` do not count.
    fn positions(&mut self, name: &str, asked: Span) -> Option<Vec<DVec3>> {
        let (source, text) = self.read_file(name, Some(asked))?;
        let mut list = Vec::new();
        let mut from = text.len() - text.trim_start_matches('\u{feff}').len();
        let mut first = true;
        let faults_before = self.faults.len();
        for line in text.trim_start_matches('\u{feff}').split('\n') {
            let span = Span::new(source, from, from + line.trim_end().len());
            from += line.len() + 1;
            let bare = line.trim();
            if bare.is_empty() || bare.starts_with('#') {
                continue;
            }
            let heading = std::mem::take(&mut first) && bare.split(',').all(is_word);
            let numbers: Vec<Option<f64>> = bare
                .split(',')
                .map(|n| n.trim().parse().ok().filter(|n: &f64| n.is_finite()))
                .collect();
            match numbers.as_slice() {
                [Some(x), Some(y), Some(z)] if [*x, *y, *z].into_iter().all(near) => {
                    list.push(DVec3::new(*x, *y, *z));
                }
                [Some(_), Some(_), Some(_)] => self.faults.push(far(span)),
                _ if heading => {}
                _ => {
                    let fault = Fault::error(span, "this line is no position");
                    self.faults
                        .push(fault.help("three numbers in metres: 1.0, 2.0, 0.0"));
                }
            }
            if list.len() > LIST_MAX {
                self.faults.push(Fault::error(
                    span,
                    format!("more than {LIST_MAX} positions"),
                ));
                return None;
            }
        }
        if self.faults.len() > faults_before {
            return None;
        }
        if list.is_empty() {
            self.faults
                .push(Fault::error(asked, "there are no positions in this file"));
            return None;
        }
        Some(list)
    }
}

/// Whether a cell of a heading is one: it does not begin as a number does.
fn is_word(cell: &str) -> bool {
    let cell = cell.trim().trim_start_matches(['"', '\'']);
    !cell.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'))
}

/// Whether a coordinate, or a length, is small enough to start from.
fn near(metres: f64) -> bool {
    metres.abs() <= START_M_MAX
}

fn far(span: Span) -> Fault {
    Fault::error(span, "this is too far from the origin").help(far_help())
}

fn far_help() -> String {
    format!(
        "starts lie within {:.0} km along each axis",
        START_M_MAX / 1e3
    )
}

/// A position, or an extent along the axes, that is not too large.
fn place(node: &Node, faults: &mut Vec<Fault>) -> Option<DVec3> {
    let place = read::<Position>(node, faults)?.si();
    let wrong = place.to_array().into_iter().position(|x| !near(x));
    let Some(axis) = wrong else {
        return Some(place);
    };
    let component = node.as_array().and_then(|all| all.get(axis));
    faults.push(far(component.unwrap_or(node).span));
    None
}

/// A length that is not too large.
fn extent(node: &Node, faults: &mut Vec<Fault>) -> Option<f64> {
    let length = read::<Length>(node, faults)?.get();
    if near(length) {
        return Some(length);
    }
    faults.push(Fault::error(node.span, "this is too long").help(far_help()));
    None
}

/// The position that a key of a start gives; the origin if it is not there.
fn corner(section: &mut Section<'_>, key: &'static str, faults: &mut Vec<Fault>) -> Option<DVec3> {
    section
        .get(key)
        .map_or(Some(DVec3::ZERO), |node| place(node, faults))
}

/// How a start is turned: by `yaw` or by `heading`, or not.
fn turn(section: &mut Section<'_>, faults: &mut Vec<Fault>) -> Option<Turn> {
    let (yaw, heading) = (section.entry("yaw"), section.entry("heading"));
    let random = |node: &Node| node.as_str() == Some("random");
    match (yaw, heading) {
        (Some((_, _)), Some((key, _))) => {
            faults.push(Fault::error(
                key.span,
                "`yaw` and `heading` say the same: one will do",
            ));
            None
        }
        (Some((_, node)), None) | (None, Some((_, node))) if random(node) => Some(Turn::Random),
        (Some((_, node)), None) => read(node, faults).map(Attitude::from_yaw).map(Turn::Fixed),
        (None, Some((_, node))) => read::<Heading>(node, faults)
            .map(Attitude::from_heading)
            .map(Turn::Fixed),
        (None, None) => Some(Turn::Fixed(Attitude::IDENTITY)),
    }
}

/// A point of a ball, uniform over what of it is above the ground.
fn above_ground(stream: &mut Stream, center: DVec3, radius_m: f64) -> DVec3 {
    for _ in 0..DRAWS_MAX {
        let point = center + stream.in_ball(radius_m);
        if point.z >= 0.0 {
            return point;
        }
    }
    DVec3::new(center.x, center.y, (center.z + radius_m).max(0.0))
}

/// Which part of a ball's volume lies above the plane `z = 0`: that of the spherical cap of height
/// `h`, `pi h^2 (3 r - h) / 3`, over that of the ball.
fn share_above_ground(center_z_m: f64, radius_m: f64) -> f64 {
    if radius_m == 0.0 {
        return if center_z_m >= 0.0 { 1.0 } else { 0.0 };
    }
    let h = (center_z_m + radius_m).clamp(0.0, 2.0 * radius_m) / radius_m;
    math::pow(h, 2.0) * (3.0 - h) / 4.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::testing::with_context;

    fn start(text: &str) -> Result<Start, Vec<Fault>> {
        with_context(&format!("s = {text}"), |root, cx| {
            let node = root
                .as_table()
                .and_then(|t| t.get("s"))
                .expect("it is there");
            Start::read(node, cx)
        })
    }

    fn places(text: &str, n: u64) -> Vec<DVec3> {
        let start = start(text).expect("a good start");
        (0..n)
            .map(|i| start.pose(7, &format!("bee-{i}"), i).position.si())
            .collect()
    }

    #[test]
    fn a_point_is_a_point() {
        assert_eq!(
            places(r#"["1 m", "2 m", "3 cm"]"#, 1),
            [DVec3::new(1.0, 2.0, 0.03)]
        );
        assert_eq!(
            places(r#"{ point = ["1 m", "2 m", "3 m"] }"#, 1),
            [DVec3::new(1.0, 2.0, 3.0)]
        );
    }

    #[test]
    fn a_box_is_filled_from_its_corner_on() {
        let all = places(
            r#"{ box = ["2 m", "4 m", "8 m"], from = ["-1 m", "0 m", "1 m"] }"#,
            4000,
        );
        let mean = all.iter().sum::<DVec3>() / 4000.0;
        assert!(
            (mean - DVec3::new(0.0, 2.0, 5.0)).abs().max_element() < 0.2,
            "{mean}"
        );
        let inside = |p: &DVec3| {
            (-1.0..1.0).contains(&p.x) && (0.0..4.0).contains(&p.y) && (1.0..9.0).contains(&p.z)
        };
        assert!(all.iter().all(inside));
    }

    #[test]
    fn a_ball_is_filled_above_the_ground() {
        let all = places(r#"{ ball = "20 m" }"#, 4000);
        assert!(all.iter().all(|p| p.length() <= 20.0 && p.z >= 0.0));
        // The mean height of a half ball is 3 r / 8.
        let mean = all.iter().sum::<DVec3>() / 4000.0;
        assert!(
            (mean - DVec3::new(0.0, 0.0, 7.5)).abs().max_element() < 0.7,
            "{mean}"
        );
    }

    #[test]
    fn a_grid_counts_x_first() {
        let all = places(
            r#"{ grid = [2, 2, 2], spacing = "2 m", from = ["1 m", "0 m", "0 m"] }"#,
            8,
        );
        assert_eq!(all[1], DVec3::new(3.0, 0.0, 0.0));
        assert_eq!(all[2], DVec3::new(1.0, 2.0, 0.0));
        assert_eq!(all[7], DVec3::new(3.0, 2.0, 2.0));
        assert_eq!(
            start("{ grid = [2, 3, 4], spacing = \"1 m\" }")
                .expect("good")
                .places(),
            Some(24)
        );
    }

    #[test]
    fn a_model_starts_where_its_path_says_whoever_else_there_is() {
        let start = start(r#"{ ball = "20 m", heading = "random" }"#).expect("good");
        let one = start.pose(7, "bee-3", 3);
        assert_eq!(start.pose(7, "bee-3", 99), one);
        assert_ne!(start.pose(8, "bee-3", 3), one);
        assert_ne!(start.pose(7, "bee-4", 3).attitude, one.attitude);
    }

    #[test]
    fn heading_is_clockwise_from_north_and_yaw_counter_clockwise_from_east() {
        let north = start(r#"{ point = ["0 m", "0 m", "0 m"], heading = "0 deg" }"#).expect("good");
        let forward = north.pose(1, "a", 0).attitude.forward();
        assert!((forward - DVec3::Y).length() < 1e-12);
        let east = start(r#"{ point = ["0 m", "0 m", "0 m"], yaw = "0 deg" }"#).expect("good");
        assert!((east.pose(1, "a", 0).attitude.forward() - DVec3::X).length() < 1e-12);
    }

    #[test]
    fn what_is_too_far_is_shown_where_it_stands() {
        for (text, wrong) in [
            (r#"["1 m", "2 m", "1e300 m"]"#, r#""1e300 m""#),
            (r#"{ ball = "1e5 km" }"#, r#""1e5 km""#),
            (
                r#"{ list = [["0 m", "0 m", "0 m"], ["-1e8 m", "2 m", "0 m"]] }"#,
                r#""-1e8 m""#,
            ),
            (r#"{ grid = [1, 1, 1], spacing = "1e8 m" }"#, r#""1e8 m""#),
        ] {
            let faults = start(text).expect_err("too far");
            let span = faults[0].span.expect("a place");
            assert_eq!(&format!("s = {text}")[span.start..span.end], wrong);
        }
    }

    #[test]
    fn nonsense_is_refused() {
        for text in [
            "12",
            "{}",
            r#"["1 m", "2 m"]"#,
            r#"["1 m", "2 m", "3"]"#,
            r#"["1 m", "2 m", "3 s"]"#,
            r#"{ bal = "20 m" }"#,
            r#"{ ball = "-20 m" }"#,
            r#"{ ball = "20 m", center = ["0 m", "0 m", "-20 m"] }"#,
            r#"{ ball = "20 m", from = ["0 m", "0 m", "0 m"] }"#,
            r#"{ ball = "20 m", box = ["1 m", "1 m", "1 m"] }"#,
            r#"{ box = ["1 m", "-1 m", "1 m"] }"#,
            r#"{ grid = [2, 2], spacing = "1 m" }"#,
            r#"{ grid = [2, 2, 2] }"#,
            r#"{ grid = [0, 2, 2], spacing = "1 m" }"#,
            r#"{ grid = [-1, 2, 2], spacing = "1 m" }"#,
            r#"{ grid = [100000, 100000, 100000], spacing = "1 m" }"#,
            r#"{ list = [] }"#,
            "[]",
            r#"{ ball = "1e300 m" }"#,
            r#"{ ball = "1 m", center = ["0 m", "1e8 m", "0 m"] }"#,
            r#"{ box = ["1 m", "1e8 m", "1 m"] }"#,
            r#"{ box = ["1 m", "1 m", "1 m"], from = ["0 m", "0 m", "-1e8 m"] }"#,
            r#"{ grid = [2, 2, 2], spacing = "1e8 m" }"#,
            r#"{ grid = [1000000, 1, 1], spacing = "11 m" }"#,
            r#"{ list = [["1 m", "2 m", "1e300 m"]] }"#,
            r#"{ point = ["1 m", "2 m", "1e300 m"] }"#,
            r#"{ list = [["1 m", "2 m"]] }"#,
            r#"{ file = "no-such-file.csv" }"#,
            r#"{ point = ["0 m", "0 m", "0 m"], yaw = "0 deg", heading = "0 deg" }"#,
            r#"{ point = ["0 m", "0 m", "0 m"], yaw = "north" }"#,
        ] {
            let faults = start(text).err().unwrap_or_default();
            assert!(!faults.is_empty(), "{text}");
            assert!(
                faults.iter().all(|f| f.span.is_some()),
                "{text}: {faults:?}"
            );
        }
    }
}

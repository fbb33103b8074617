//! The world from above: footprints of what stands in it, the relief of its terrain, marks of what is small.

use super::axes::Panel;
use super::lines::{clipped, clipped_area, hull};
use super::map::pixels_each_m;
use super::sheet::{Ink, Sheet, TEXT, WHITE};
use simbeeotic_record::Stage;
use simbeeotic_record::stage::{Form, Piece, Prop};
use simbeeotic_units::math;

const BLACK: Ink = Ink::new([0; 3]);
/// Corners of a round footprint.
const ROUND: usize = 32;
/// The side of a cell of the relief, pixels.
const RELIEF_PIXELS: f64 = 2.0;

/// One thing as seen from above.
#[derive(Clone, Debug, PartialEq)]
struct Footprint {
    ring: Vec<[f64; 2]>,
    /// From which height to which it reaches, m.
    heights_m: [f64; 2],
    ink: Ink,
}

/// A thing that is too small for its outline to say what it is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mark {
    /// East and north, m.
    pub(super) place_m: [f64; 2],
    pub(super) kind: MarkKind,
    pub(super) ink: Ink,
    pub(super) label: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MarkKind {
    Flower,
    Person,
    Light,
    Source,
}

/// Triangles of terrain.
#[derive(Clone, Debug)]
struct Relief {
    triangles_m: Vec<[[f64; 3]; 3]>,
    ink: Ink,
}

/// All of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Ground {
    plane: Option<Ink>,
    relief: Vec<Relief>,
    /// The lowest tops first.
    footprints: Vec<Footprint>,
    pub(super) marks: Vec<Mark>,
}

impl Ground {
    /// What a stage looks like from above, without what is hidden by its label or kind.
    pub(super) fn of(stage: &Stage, hide: &[String]) -> Self {
        let ink = |[red, green, blue, _]: [u8; 4]| Ink::new([red, green, blue]);
        let mut ground = Self {
            plane: stage.plane.then(|| ink(stage.ground)),
            ..Self::default()
        };
        let hidden = |prop: &&Prop| hide.iter().any(|h| *h == prop.label || *h == prop.kind);
        for prop in stage.props.iter().filter(|prop| !hidden(prop)) {
            let ink = ink(prop.color);
            let kind = match prop.kind.as_str() {
                "flower" => Some(MarkKind::Flower),
                "person" => Some(MarkKind::Person),
                "light" => Some(MarkKind::Light),
                "source" => Some(MarkKind::Source),
                "terrain" => {
                    let triangles_m = prop.pieces.iter().flat_map(triangles).collect();
                    ground.relief.push(Relief { triangles_m, ink });
                    continue;
                }
                _ => None,
            };
            match kind {
                None => {
                    let footprints = prop.pieces.iter().map(|piece| footprint(piece, ink));
                    ground.footprints.extend(footprints);
                }
                Some(kind) => ground.marks.extend(place(prop).map(|place_m| Mark {
                    place_m,
                    kind,
                    ink,
                    label: prop.label.clone(),
                })),
            }
        }
        ground.footprints.retain(|print| print.ring.len() >= 3);
        let top = |print: &Footprint| print.heights_m[1];
        (ground.footprints).sort_by(|a, b| top(a).total_cmp(&top(b)));
        ground
    }

    /// West, south, east, north of what stands on it, m; `None` if nothing does.
    pub(super) fn bounds(&self) -> Option<[f64; 4]> {
        let corners = self.footprints.iter().flat_map(|print| print.ring.iter());
        let relief = self.relief.iter().flat_map(|relief| &relief.triangles_m);
        let relief = relief.flatten().map(|[x, y, _]| [*x, *y]);
        let marks = self.marks.iter().map(|mark| mark.place_m);
        let mut bounds = None;
        for [x, y] in corners.copied().chain(relief).chain(marks) {
            let [west, south, east, north] = bounds.get_or_insert([x, y, x, y]);
            (*west, *east) = (west.min(x), east.max(x));
            (*south, *north) = (south.min(y), north.max(y));
        }
        bounds
    }

    /// Colours the plane, below the grid.
    pub(super) fn plane(&self, sheet: &mut Sheet, panel: &Panel) {
        let [left, top, right, bottom] = panel.edges;
        if let Some(ink) = self.plane {
            sheet.rectangle([left, top], [right, bottom], ink.mixed(WHITE, 0.92));
        }
    }

    /// Draws what stands on it. What begins above `level_m` is an outline only.
    pub(super) fn draw(&self, sheet: &mut Sheet, panel: &Panel, level_m: f64) {
        for relief in &self.relief {
            relief.draw(sheet, panel);
        }
        let seen = |print: &&Footprint| print.heights_m[0] <= level_m;
        for print in self.footprints.iter().filter(seen) {
            let area = clipped_area(&print.pixels(panel), panel.edges);
            // What is below the flights is ground to them.
            let pale = if print.heights_m[1] < level_m {
                0.6
            } else {
                0.3
            };
            if area.len() >= 3 {
                sheet.area(area, print.ink.mixed(WHITE, pale).thin(0.95));
            }
            print.outline(sheet, panel, print.ink.mixed(BLACK, 0.35), None);
        }
        for print in self.footprints.iter().filter(|print| !seen(print)) {
            let ink = print.ink.mixed(BLACK, 0.45).thin(0.55);
            print.outline(sheet, panel, ink, Some([5.0, 4.0]));
        }
        for mark in self.marks.iter().filter(|m| m.kind == MarkKind::Flower) {
            self.mark(sheet, panel, mark);
        }
    }

    /// Outlines alone, below other things.
    pub(super) fn outlines(&self, sheet: &mut Sheet, panel: &Panel) {
        for print in &self.footprints {
            let area = clipped_area(&print.pixels(panel), panel.edges);
            if area.len() >= 3 {
                sheet.area(area, print.ink.mixed(WHITE, 0.75).thin(0.6));
            }
            print.outline(sheet, panel, print.ink.mixed(BLACK, 0.2).thin(0.6), None);
        }
    }

    /// Outlines alone, above other things.
    pub(super) fn rims(&self, sheet: &mut Sheet, panel: &Panel) {
        for print in &self.footprints {
            print.outline(sheet, panel, TEXT.thin(0.55), None);
        }
    }

    /// Marks that lie above the flights: who and what has a name or a meaning.
    pub(super) fn marks(&self, sheet: &mut Sheet, panel: &Panel) {
        for mark in self.marks.iter().filter(|m| m.kind != MarkKind::Flower) {
            self.mark(sheet, panel, mark);
        }
    }

    fn mark(&self, sheet: &mut Sheet, panel: &Panel, mark: &Mark) {
        let at = panel.place(mark.place_m[0], mark.place_m[1]);
        let [left, top, right, bottom] = panel.edges;
        if (left..=right).contains(&at[0]) && (top..=bottom).contains(&at[1]) {
            let pixels = pixels_each_m(panel);
            draw_mark(sheet, at, mark.kind, mark.ink, pixels);
        }
    }
}

/// A mark; `pixels` is how many a metre has.
pub(super) fn draw_mark(
    sheet: &mut Sheet,
    [x, y]: [f64; 2],
    kind: MarkKind,
    ink: Ink,
    pixels: f64,
) {
    match kind {
        MarkKind::Flower => sheet.disc([x, y], (0.12 * pixels).clamp(1.2, 4.0), ink, 0.0),
        MarkKind::Person => {
            let ink = ink.mixed(BLACK, 0.2);
            let body: Vec<[f64; 2]> = [
                [-5.5, 8.0],
                [-4.5, 1.0],
                [-2.0, -1.5],
                [2.0, -1.5],
                [4.5, 1.0],
                [5.5, 8.0],
            ]
            .map(|[dx, dy]| [x + dx, y + dy])
            .to_vec();
            let mut rim = body.clone();
            rim.push(body[0]);
            sheet.line(rim, WHITE, 2.5);
            sheet.area(body, ink);
            sheet.disc([x, y - 5.0], 3.6, ink, 1.2);
        }
        MarkKind::Light => {
            for k in 0..8 {
                let (sin, cos) = math::sin_cos(f64::from(k) * std::f64::consts::FRAC_PI_4);
                let ray = [5.5, 8.0].map(|r| [x + r * cos, y + r * sin]);
                sheet.line(ray.to_vec(), TEXT.thin(0.7), 1.1);
            }
            sheet.disc([x, y], 4.5, Ink::new([0xf4, 0xc4, 0x30]), 1.0);
        }
        MarkKind::Source => {
            let diamond = |r: f64| vec![[x, y - r], [x + r, y], [x, y + r], [x - r, y]];
            sheet.area(diamond(8.5), WHITE);
            sheet.area(diamond(7.0), Ink::new([0xc0, 0x20, 0x50]));
            sheet.disc([x, y], 1.8, WHITE, 0.0);
        }
    }
}

impl Footprint {
    fn pixels(&self, panel: &Panel) -> Vec<[f64; 2]> {
        self.ring.iter().map(|[x, y]| panel.place(*x, *y)).collect()
    }

    fn outline(&self, sheet: &mut Sheet, panel: &Panel, ink: Ink, dash: Option<[f64; 2]>) {
        let mut ring = self.pixels(panel);
        ring.extend(ring.first().copied());
        for piece in clipped(&ring, panel.edges) {
            match dash {
                None => sheet.line(piece, ink, 0.9),
                Some(dash) => sheet.dashed(piece, ink, 0.9, dash),
            }
        }
    }
}

impl Relief {
    /// Shaded as if the sun stood in the north-west, the higher the lighter.
    fn draw(&self, sheet: &mut Sheet, panel: &Panel) {
        let [left, top, right, bottom] = panel.edges;
        let columns = ((right - left) / RELIEF_PIXELS).ceil() as usize;
        let rows = ((bottom - top) / RELIEF_PIXELS).ceil() as usize;
        let mut heights = vec![f64::NAN; columns * rows];
        for triangle in &self.triangles_m {
            let corners = triangle.map(|[x, y, z]| {
                let [px, py] = panel.place(x, y);
                [
                    (px - left) / (right - left) * columns as f64 - 0.5,
                    (py - top) / (bottom - top) * rows as f64 - 0.5,
                    z,
                ]
            });
            raise(&mut heights, [columns, rows], corners);
        }
        let known = || heights.iter().copied().filter(|z| z.is_finite());
        let low = known().fold(f64::INFINITY, f64::min);
        let high = known().fold(f64::NEG_INFINITY, f64::max);
        if low > high {
            return;
        }
        let cell_m = (panel.x.high - panel.x.low) / columns as f64;
        let at = |column: usize, row: usize| heights[row * columns + column];
        let mut inks = Vec::with_capacity(heights.len());
        for row in 0..rows {
            for column in 0..columns {
                let z = at(column, row);
                let or = |other: f64| if other.is_finite() { other } else { z };
                let slope = |a: f64, b: f64| (or(b) - or(a)) / (2.0 * cell_m);
                let east = slope(
                    at(column.saturating_sub(1), row),
                    at((column + 1).min(columns - 1), row),
                );
                let south = slope(
                    at(column, row.saturating_sub(1)),
                    at(column, (row + 1).min(rows - 1)),
                );
                if !z.is_finite() {
                    inks.push(WHITE.thin(0.0));
                    continue;
                }
                // The upward normal is (-dz/dx, -dz/dy, 1); y is north.
                let long = (east * east + south * south + 1.0).sqrt();
                let light = (0.5 * east + 0.5 * south + 0.707) / long;
                let light = ((light - 0.2) / 0.8).clamp(0.0, 1.0);
                let share = (z - low) / (high - low).max(1e-9);
                let ink = self.ink.mixed(WHITE, 0.42 + 0.3 * share);
                inks.push(if light < 0.62 {
                    ink.mixed(BLACK, 0.45 * (0.62 - light) / 0.62)
                } else {
                    ink.mixed(WHITE, 0.6 * (light - 0.62) / 0.38)
                });
            }
        }
        sheet.cells(panel.edges, columns as u32, inks);
    }
}

/// Raises cells to a triangle whose corners are in cells, where it is higher than what is known.
fn raise(heights: &mut [f64], [columns, rows]: [usize; 2], [a, b, c]: [[f64; 3]; 3]) {
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if !area.is_finite() || area.abs() < 1e-12 {
        return;
    }
    let range = |k: usize, count: usize| {
        let low = a[k].min(b[k]).min(c[k]).ceil().max(0.0) as usize;
        let high = a[k].max(b[k]).max(c[k]).floor().min(count as f64 - 1.0);
        low..(high + 1.0).max(0.0) as usize
    };
    for row in range(1, rows) {
        for column in range(0, columns) {
            let (x, y) = (column as f64, row as f64);
            let share_b = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area;
            let share_c = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area;
            if share_b < -1e-9 || share_c < -1e-9 || share_b + share_c > 1.0 + 1e-9 {
                continue;
            }
            let z = a[2] + share_b * (b[2] - a[2]) + share_c * (c[2] - a[2]);
            let cell = &mut heights[row * columns + column];
            *cell = if cell.is_nan() { z } else { cell.max(z) };
        }
    }
}

/// A vector turned by the unit quaternion `w, x, y, z`.
pub(super) fn turned([w, x, y, z]: [f64; 4], v: [f64; 3]) -> [f64; 3] {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let axis = [x, y, z];
    let t = cross(axis, v).map(|c| 2.0 * c);
    let u = cross(axis, t);
    [0, 1, 2].map(|k| v[k] + w * t[k] + u[k])
}

/// A point of a piece in the world, m.
pub(super) fn placed(piece: &Piece, point: [f64; 3]) -> [f64; 3] {
    let turned = turned(piece.attitude, point);
    [0, 1, 2].map(|k| piece.position_m[k] + turned[k])
}

/// The triangles of a mesh in the world, m.
pub(super) fn triangles(piece: &Piece) -> Vec<[[f64; 3]; 3]> {
    let Form::Mesh {
        points_m,
        triangles,
    } = &piece.form
    else {
        return Vec::new();
    };
    let corner = |at: u32| {
        let point = points_m.get(at as usize)?;
        Some(placed(piece, point.map(f64::from)))
    };
    let corners = triangles.iter().map(|[a, b, c]| {
        let [a, b, c] = [corner(*a)?, corner(*b)?, corner(*c)?];
        Some([a, b, c])
    });
    corners.flatten().collect()
}

/// Points on the outline of a piece, in the world, whose hull is its footprint, and what to add around each, m.
fn outline(piece: &Piece) -> (Vec<[f64; 3]>, f64) {
    let ring = |radius: f64, z: f64| {
        (0..ROUND).map(move |k| {
            let (sin, cos) = math::sin_cos(k as f64 * std::f64::consts::TAU / ROUND as f64);
            [radius * cos, radius * sin, z]
        })
    };
    let (points, around): (Vec<[f64; 3]>, f64) = match &piece.form {
        Form::Box { half_m: [x, y, z] } => {
            let signs =
                (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2].map(|bit| f64::from(2 * bit - 1)));
            (signs.map(|[a, b, c]| [a * x, b * y, c * z]).collect(), 0.0)
        }
        Form::Sphere { radius_m } => (vec![[0.0; 3]], *radius_m),
        Form::Cylinder {
            radius_m,
            top_m,
            half_height_m: half,
        } => (
            ring(*radius_m, -half).chain(ring(*top_m, *half)).collect(),
            0.0,
        ),
        Form::Capsule {
            radius_m,
            half_height_m: half,
        } => (vec![[0.0, 0.0, -half], [0.0, 0.0, *half]], *radius_m),
        Form::Mesh { points_m, .. } => (
            points_m.iter().map(|point| point.map(f64::from)).collect(),
            0.0,
        ),
    };
    let points = points.into_iter().map(|point| placed(piece, point));
    (points.collect(), around)
}

fn footprint(piece: &Piece, ink: Ink) -> Footprint {
    let (points, around) = outline(piece);
    let heights = || points.iter().map(|point| point[2]);
    let heights_m = [
        heights().fold(f64::INFINITY, f64::min) - around,
        heights().fold(f64::NEG_INFINITY, f64::max) + around,
    ];
    let flat = points.iter().flat_map(|[x, y, _]| {
        let count = if around > 0.0 { ROUND } else { 1 };
        (0..count).map(move |k| {
            let (sin, cos) = math::sin_cos(k as f64 * std::f64::consts::TAU / ROUND as f64);
            [x + around * cos, y + around * sin]
        })
    });
    Footprint {
        ring: hull(flat.collect()),
        heights_m,
        ink,
    }
}

/// The middle of a thing's pieces, east and north, m.
fn place(prop: &Prop) -> Option<[f64; 2]> {
    let count = prop.pieces.len() as f64;
    let sum = |k: usize| prop.pieces.iter().map(|p| p.position_m[k]).sum::<f64>();
    (count > 0.0).then(|| [sum(0) / count, sum(1) / count])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn prop(kind: &str, piece: Piece) -> Prop {
        Prop {
            kind: kind.to_owned(),
            color: [200, 100, 50, 255],
            pieces: vec![piece],
            ..Prop::default()
        }
    }

    #[test]
    fn the_footprint_of_a_turned_box_is_turned() {
        // A quarter turn about the vertical: two metres long becomes two metres wide.
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let piece = Piece {
            form: Form::Box {
                half_m: [2.0, 1.0, 0.5],
            },
            position_m: [10.0, 5.0, 0.5],
            attitude: [half, 0.0, 0.0, half],
        };
        let print = footprint(&piece, BLACK);
        assert_eq!(print.ring.len(), 4);
        for [x, y] in &print.ring {
            assert!(((x - 10.0).abs() - 1.0).abs() < 1e-9 && ((y - 5.0).abs() - 2.0).abs() < 1e-9);
        }
        let [low, high] = print.heights_m;
        assert!(low.abs() < 1e-9 && (high - 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_footprint_of_a_lying_capsule_is_as_long_as_it_is() {
        // Tipped over to the east: an axis of 4 m, round ends of 1 m.
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let piece = Piece {
            form: Form::Capsule {
                radius_m: 1.0,
                half_height_m: 2.0,
            },
            position_m: [0.0; 3],
            attitude: [half, 0.0, half, 0.0],
        };
        let print = footprint(&piece, BLACK);
        let reach = |k: usize| print.ring.iter().map(|p| p[k]).fold(0.0, f64::max);
        assert!((reach(0) - 3.0).abs() < 1e-9, "{}", reach(0));
        assert!((reach(1) - 1.0).abs() < 1e-9, "{}", reach(1));
        assert_eq!(print.heights_m.map(|z| (z * 1e9).round()), [-1e9, 1e9]);
    }

    #[test]
    fn flowers_are_marks_and_hidden_things_are_gone() {
        let ball = Piece::at_origin(Form::Sphere { radius_m: 1.0 });
        let mut roof = prop("structure", ball.clone());
        roof.label = "roof".to_owned();
        let stage = Stage {
            props: vec![prop("flower", ball.clone()), prop("obstacle", ball), roof],
            ..Stage::default()
        };
        let ground = Ground::of(&stage, &["roof".to_owned()]);
        assert_eq!((ground.marks.len(), ground.footprints.len()), (1, 1));
        let bounds = ground.bounds().expect("something stands there");
        assert!((bounds[2] - 1.0).abs() < 1e-9 && (bounds[0] + 1.0).abs() < 1e-9);
        assert!(Ground::default().bounds().is_none());
    }

    #[test]
    fn a_triangle_raises_the_cells_in_it() {
        let mut heights = vec![f64::NAN; 16];
        // z = x + y.
        raise(
            &mut heights,
            [4, 4],
            [[0.0, 0.0, 0.0], [3.0, 0.0, 3.0], [0.0, 3.0, 3.0]],
        );
        for row in 0..4 {
            for column in 0..4 {
                let z = heights[row * 4 + column];
                match row + column <= 3 {
                    true => assert!((z - (row + column) as f64).abs() < 1e-9),
                    false => assert!(z.is_nan()),
                }
            }
        }
    }
}

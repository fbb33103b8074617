//! Traces in 3-D: seen from the side and above, without perspective, so that lengths can be compared.

use super::super::Failure;
use super::arguments::TraceOptions;
use super::axes::{nice, number};
use super::faces::{dot, faces, middle, normal};
use super::lines::simplified;
use super::map::Column;
use super::sheet::{Anchor, FAINT, GRID, HEAD, Ink, NORMAL, SMALL, Sheet, TEXT, WHITE};
use super::traces::{Paints, Scene, parts, pen, station};
use simbeeotic_units::{Angle, math};
use simbeeotic_view::render::words;

const BLACK: Ink = Ink::new([0; 3]);
/// Of more faces than these the rest is left out, and it is said.
const FACES_MAX: usize = 40_000;
/// Vehicles with a line down to the ground.
const DROPS_MAX: usize = 40;
/// A picture that is cropped has room for its words at least, pixels.
const HEIGHT_LEAST: u32 = 300;
/// Links of a trace that are drawn in the order of their depth.
const LINKS: usize = 24;

/// From where it is seen, and where that is on the picture.
struct Eye {
    /// Unit vectors to the right, upwards on the picture, and towards the eye.
    axes: [[f64; 3]; 3],
    pixels_each_m: f64,
    /// Where the origin is, pixels.
    origin: [f64; 2],
}

/// Something with a depth.
struct Thing {
    depth: f64,
    what: What,
}

enum What {
    Face(Vec<[f64; 2]>, Ink),
    Link(Vec<[f64; 2]>, Ink, f64),
    Drop([f64; 2], [f64; 2], Ink),
    Ring([f64; 2], Ink),
    Dot([f64; 2], f64, Ink),
    Station([f64; 2]),
}

/// Draws a scene.
pub(super) fn draw(
    sheet: &mut Sheet,
    scene: &Scene,
    paints: &Paints,
    options: &TraceOptions,
) -> Result<(), Failure> {
    let angle = |option: &str, text: &str| {
        text.parse::<Angle>()
            .map_err(|error| Failure::input(format!("{option}: {error}")))
    };
    let azimuth = angle("--azimuth", &options.azimuth)?.radians();
    let elevation = angle("--elevation", &options.elevation)?.radians();
    if !(0.05..=std::f64::consts::FRAC_PI_2).contains(&elevation) || !azimuth.is_finite() {
        return Err(Failure::input(format!(
            "--elevation {}: it must lie between 3 deg and 90 deg",
            options.elevation
        )));
    }
    let room = Room::around(scene);
    // Unless it is said how high the picture is, it is no higher than what it shows.
    let crop = options.plot.height.is_none();
    let eye = Eye::fitting(sheet, &room, [azimuth, elevation], crop);
    floor(sheet, &eye, &room);
    let mut things = Vec::new();
    let left_out = world(&mut things, &eye, scene, options, &room);
    flights(&mut things, &eye, scene, paints, &room);
    things.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    for thing in things {
        thing.what.draw(sheet);
    }
    height(sheet, &eye, &room);
    let mut column = Column::at(
        f64::from(sheet.width),
        HEAD + 20.0,
        f64::from(sheet.height) - 20.0,
    );
    paints.legend(sheet, &mut column, std::slice::from_ref(scene));
    column.note(sheet, &["Grey: the traces'", "shadows at noon."]);
    if left_out {
        column.note(sheet, &["Meshes that are too", "fine are left out."]);
    }
    Ok(())
}

/// The block of space that is drawn: west to east, south to north, from its floor to its top, m.
struct Room {
    ends: [[f64; 2]; 3],
    /// Between two lines of the grid, m.
    step: f64,
}

impl Room {
    fn around(scene: &Scene) -> Self {
        let [x, y, z] = scene.spans_m;
        let long = (x[1] - x[0]).max(y[1] - y[0]).max(z[1] - z[0]).max(1.0);
        let step = nice(long / 8.0);
        let whole = |[low, high]: [f64; 2]| {
            let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
            [low, high.max(low + step)]
        };
        let plane = scene.stage.as_ref().is_none_or(|stage| stage.plane);
        let foot = if plane && z[0] > 0.0 && z[0] < 2.0 * long {
            0.0
        } else {
            z[0]
        };
        let [_, top] = whole([foot, z[1]]);
        let foot = if foot == 0.0 {
            0.0
        } else {
            whole([foot, z[1]])[0]
        };
        Self {
            ends: [whole(x), whole(y), [foot, top]],
            step,
        }
    }

    fn corners(&self) -> [[f64; 3]; 8] {
        std::array::from_fn(|k| [k & 1, k >> 1 & 1, k >> 2].map(|bit| bit))
            .map(|bits: [usize; 3]| [0, 1, 2].map(|axis| self.ends[axis][bits[axis]]))
    }

    /// Whether a point is within the floor, and not far above.
    fn holds(&self, [x, y, _]: [f64; 3]) -> bool {
        let [[west, east], [south, north], _] = self.ends;
        (west..=east).contains(&x) && (south..=north).contains(&y)
    }
}

impl Eye {
    fn fitting(sheet: &mut Sheet, room: &Room, [azimuth, elevation]: [f64; 2], crop: bool) -> Self {
        let (sin_a, cos_a) = math::sin_cos(azimuth);
        let (sin_e, cos_e) = math::sin_cos(elevation);
        // Towards the eye: an azimuth is clockwise from north.
        let towards = [sin_a * cos_e, cos_a * cos_e, sin_e];
        let right = [-cos_a, sin_a, 0.0];
        let up = [-sin_a * sin_e, -cos_a * sin_e, cos_e];
        let mut eye = Self {
            axes: [right, up, towards],
            pixels_each_m: 1.0,
            origin: [0.0; 2],
        };
        let corners = room.corners().map(|corner| eye.pixel(corner));
        let ends = |k: usize| {
            let along = || corners.iter().map(|corner| corner[k]);
            let low = along().fold(f64::INFINITY, f64::min);
            [low, along().fold(f64::NEG_INFINITY, f64::max)]
        };
        let [[left, right], [top, bottom]] = [ends(0), ends(1)];
        let mut frame = [
            100.0,
            HEAD + 34.0,
            f64::from(sheet.width) - sheet.key_room() - 60.0,
            f64::from(sheet.height) - 80.0,
        ];
        if crop {
            let needed = (frame[2] - frame[0]) * (bottom - top) / (right - left);
            let spare = (frame[3] - frame[1] - needed).max(0.0);
            sheet.height -= (spare.floor() as u32).min(sheet.height.saturating_sub(HEIGHT_LEAST));
            frame[3] = f64::from(sheet.height) - 80.0;
        }
        let scale =
            ((frame[2] - frame[0]) / (right - left)).min((frame[3] - frame[1]) / (bottom - top));
        eye.pixels_each_m = scale;
        eye.origin = [
            0.5 * (frame[0] + frame[2]) - 0.5 * scale * (left + right),
            0.5 * (frame[1] + frame[3]) - 0.5 * scale * (top + bottom),
        ];
        eye
    }

    fn pixel(&self, point: [f64; 3]) -> [f64; 2] {
        let [right, up, _] = self.axes;
        [
            self.origin[0] + self.pixels_each_m * dot(right, point),
            self.origin[1] - self.pixels_each_m * dot(up, point),
        ]
    }

    /// A direction of the world as a unit vector on the picture.
    fn direction(&self, along: [f64; 3]) -> [f64; 2] {
        let [a, b] = [self.pixel([0.0; 3]), self.pixel(along)];
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let long = (dx * dx + dy * dy).sqrt().max(1e-9);
        [dx / long, dy / long]
    }

    /// The greater, the nearer.
    fn depth(&self, point: [f64; 3]) -> f64 {
        dot(self.axes[2], point)
    }
}

impl What {
    fn draw(self, sheet: &mut Sheet) {
        match self {
            Self::Face(ring, ink) => {
                let mut rim = ring.clone();
                rim.extend(ring.first().copied());
                sheet.area(ring, ink);
                sheet.line(rim, ink.mixed(BLACK, 0.4).thin(0.6), 0.6);
            }
            Self::Link(points, ink, width) => sheet.line(points, ink, width),
            Self::Drop(from, to, ink) => {
                sheet.dashed(vec![from, to], ink, 0.9, [3.0, 3.0]);
                sheet.disc(to, 1.8, ink, 0.0);
            }
            Self::Ring(at, ink) => {
                sheet.disc(at, 3.8, ink, 0.0);
                sheet.disc(at, 2.5, WHITE, 0.0);
            }
            Self::Dot(at, radius, ink) => sheet.disc(at, radius, ink, 1.0),
            Self::Station(at) => station(sheet, at, 1),
        }
    }
}

/// The floor with its grid, and its two nearer edges with numbers.
fn floor(sheet: &mut Sheet, eye: &Eye, room: &Room) {
    let [[west, east], [south, north], [foot, _]] = room.ends;
    let corner = |x: f64, y: f64| eye.pixel([x, y, foot]);
    sheet.area(
        vec![
            corner(west, south),
            corner(east, south),
            corner(east, north),
            corner(west, north),
        ],
        Ink::new([0xf6, 0xf7, 0xf9]),
    );
    let ticks = |[low, high]: [f64; 2]| {
        let count = ((high - low) / room.step).round() as usize;
        (0..=count).map(move |k| low + k as f64 * room.step)
    };
    let grid = GRID.mixed(BLACK, 0.08);
    for x in ticks([west, east]) {
        sheet.line(vec![corner(x, south), corner(x, north)], grid, 0.9);
    }
    for y in ticks([south, north]) {
        sheet.line(vec![corner(west, y), corner(east, y)], grid, 0.9);
    }
    // The edges that are nearer to the eye.
    let [towards_east, towards_north, _] = eye.axes[2];
    let near_x = if towards_east > 0.0 { east } else { west };
    let near_y = if towards_north > 0.0 { north } else { south };
    let side = |x: f64| if x > 0.0 { 1.0 } else { -1.0 };
    // Where both axes meet, one number is enough.
    let norths = ticks([south, north]).filter(|y| (y - near_y).abs() > 0.5 * room.step);
    Edge {
        name: "east, m",
        ticks: (ticks([west, east]).map(|x| (corner(x, near_y), x))).collect(),
        middle: corner(0.5 * (west + east), near_y),
        out: eye.direction([0.0, side(towards_north), 0.0]),
    }
    .draw(sheet, room.step);
    Edge {
        name: "north, m",
        ticks: norths.map(|y| (corner(near_x, y), y)).collect(),
        middle: corner(near_x, 0.5 * (south + north)),
        out: eye.direction([side(towards_east), 0.0, 0.0]),
    }
    .draw(sheet, room.step);
}

/// An edge of the floor with numbers, and its name beside them.
struct Edge {
    name: &'static str,
    /// Where they are, and what they are, m.
    ticks: Vec<([f64; 2], f64)>,
    middle: [f64; 2],
    /// Away from the floor: a unit vector on the picture.
    out: [f64; 2],
}

impl Edge {
    fn draw(self, sheet: &mut Sheet, step: f64) {
        let numbers: Vec<String> = self
            .ticks
            .iter()
            .map(|(_, value)| number(*value, step))
            .collect();
        let widest = numbers.iter().map(|text| self.reach(text, SMALL));
        let widest = widest.fold(0.0, f64::max);
        for ((from, _), text) in self.ticks.iter().zip(numbers) {
            let end = self.beyond(*from, 5.0);
            sheet.line(vec![*from, end], TEXT, 1.0);
            let [x, y] = self.beyond(*from, 8.0 + widest);
            sheet.words([x, y + 5.0], text, SMALL, Anchor::Middle, TEXT);
        }
        let far = 8.0 + 2.0 * widest + 6.0 + self.reach(self.name, NORMAL);
        let [x, y] = self.beyond(self.middle, far);
        sheet.words([x, y + 5.0], self.name, NORMAL, Anchor::Middle, TEXT);
    }

    fn beyond(&self, [x, y]: [f64; 2], far: f64) -> [f64; 2] {
        [x + self.out[0] * far, y + self.out[1] * far]
    }

    /// How far words around a place reach outwards, pixels.
    fn reach(&self, text: &str, size: f64) -> f64 {
        let [dx, dy] = self.out.map(f64::abs);
        0.5 * (dx * words::width(text, size) + dy * size)
    }
}

/// The axis of heights, at the corner that is farthest to the left.
fn height(sheet: &mut Sheet, eye: &Eye, room: &Room) {
    let [_, _, [foot, top]] = room.ends;
    let feet = room.corners();
    let feet = feet.iter().filter(|corner| corner[2] == foot);
    let left = feet.min_by(|a, b| eye.pixel(**a)[0].total_cmp(&eye.pixel(**b)[0]));
    let Some([x, y, _]) = left.copied() else {
        return;
    };
    let at = |z: f64| eye.pixel([x, y, z]);
    sheet.line(vec![at(foot), at(top)], FAINT, 1.2);
    let count = ((top - foot) / room.step).round() as usize;
    let each = nice((26.0 / eye.pixels_each_m).max(room.step) / room.step).ceil() as usize;
    // The foot has numbers of other axes beside it.
    for k in (0..=count).step_by(each.max(1)).skip(1) {
        let z = foot + k as f64 * room.step;
        let [px, py] = at(z);
        sheet.line(vec![[px - 5.0, py], [px, py]], TEXT, 1.0);
        let text = number(z, room.step);
        sheet.words([px - 9.0, py + 5.0], text, SMALL, Anchor::End, TEXT);
    }
    let [px, py] = at(top);
    sheet.words([px, py - 14.0], "height, m", NORMAL, Anchor::Middle, TEXT);
}

/// What stands in the room, as faces that let the traces through.
fn world(
    things: &mut Vec<Thing>,
    eye: &Eye,
    scene: &Scene,
    options: &TraceOptions,
    room: &Room,
) -> bool {
    let Some(stage) = &scene.stage else {
        return false;
    };
    let mut left_out = false;
    let mut count = 0;
    for prop in &stage.props {
        if options
            .hide
            .iter()
            .any(|h| *h == prop.label || *h == prop.kind)
        {
            continue;
        }
        let [red, green, blue, _] = prop.color;
        let ink = Ink::new([red, green, blue]);
        let terrain = prop.kind == "terrain";
        for piece in &prop.pieces {
            let faces = faces(piece);
            if count + faces.len() > FACES_MAX {
                left_out = true;
                continue;
            }
            count += faces.len();
            for face in faces {
                let middle = middle(&face);
                let normal = normal(&face);
                let facing = dot(normal, eye.axes[2]);
                if facing <= 0.0 || !(room.holds(middle) || options.whole) {
                    continue;
                }
                // The sun stands in the south-west, above.
                let light = dot(normal, [-0.35, -0.45, 0.82]).clamp(-0.4, 1.0);
                let ink = match light > 0.5 {
                    true => ink.mixed(WHITE, 0.35 * (light - 0.5) + 0.2),
                    false => ink.mixed(BLACK, 0.35 * (0.5 - light)).mixed(WHITE, 0.2),
                };
                things.push(Thing {
                    depth: eye.depth(middle),
                    what: What::Face(
                        face.iter().map(|point| eye.pixel(*point)).collect(),
                        ink.thin(if terrain { 0.9 } else { 0.45 }),
                    ),
                });
            }
        }
    }
    left_out
}

/// The flights in links, their shadows, their ends, and lines down from where they end.
fn flights(things: &mut Vec<Thing>, eye: &Eye, scene: &Scene, paints: &Paints, room: &Room) {
    let (width, alpha) = pen(scene.moving.len());
    let foot = room.ends[2][0];
    let many = scene.moving.len();
    for (place, flight) in scene.moving.iter().enumerate() {
        let points: Vec<_> = flight.known().collect();
        let Some((first, last)) = points.first().zip(points.last()) else {
            continue;
        };
        let shadow: Vec<_> = (points.iter())
            .map(|(_, [x, y, _])| eye.pixel([*x, *y, foot]))
            .collect();
        things.push(Thing {
            depth: f64::NEG_INFINITY,
            what: What::Link(
                simplified(&shadow, 0.4),
                FAINT.thin((alpha * 0.4).max(0.06)),
                width * 0.8,
            ),
        });
        for (middle, range) in parts(paints, &points, many) {
            let (at, point) = points[middle];
            let ink = paints.ink(place, flight, at, point[2]);
            let part = &points[range];
            let count = if paints.changes() { 1 } else { LINKS };
            let long = (part.len() - 1).div_ceil(count).max(1);
            for from in (0..part.len() - 1).step_by(long) {
                let link = &part[from..=(from + long).min(part.len() - 1)];
                let pixels: Vec<_> = link.iter().map(|(_, p)| eye.pixel(*p)).collect();
                things.push(Thing {
                    depth: eye.depth(link[link.len() / 2].1),
                    what: What::Link(simplified(&pixels, 0.3), ink.thin(alpha), width),
                });
            }
        }
        let ink = |(at, p): &(usize, [f64; 3])| paints.ink(place, flight, *at, p[2]);
        let (low, high) = (eye.pixel([last.1[0], last.1[1], foot]), eye.pixel(last.1));
        if many <= DROPS_MAX {
            things.push(Thing {
                depth: eye.depth(last.1) - 1e-6,
                what: What::Drop(high, low, ink(last).thin(0.6)),
            });
            things.push(Thing {
                depth: eye.depth(first.1),
                what: What::Ring(eye.pixel(first.1), ink(first)),
            });
        }
        things.push(Thing {
            depth: eye.depth(last.1),
            what: What::Dot(high, if many <= DROPS_MAX { 4.2 } else { 2.0 }, ink(last)),
        });
    }
    for flight in &scene.still {
        if let Some((_, point)) = flight.known().next() {
            things.push(Thing {
                depth: eye.depth(point),
                what: What::Station(eye.pixel(point)),
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn eye(azimuth: f64, elevation: f64) -> Eye {
        let room = Room {
            ends: [[-1.0, 1.0]; 3],
            step: 1.0,
        };
        let mut sheet = Sheet::titled(1000, 700, "", "");
        let angles = [azimuth.to_radians(), elevation.to_radians()];
        Eye::fitting(&mut sheet, &room, angles, false)
    }

    #[test]
    fn from_the_south_east_is_at_the_right_and_up_is_up() {
        let eye = eye(180.0, 30.0);
        let at = |point| eye.pixel(point);
        assert!(at([1.0, 0.0, 0.0])[0] > at([0.0; 3])[0] + 10.0);
        assert!(at([0.0, 0.0, 1.0])[1] < at([0.0; 3])[1] - 10.0);
        // What is farther north is farther away, and higher on the picture.
        assert!(eye.depth([0.0, 1.0, 0.0]) < eye.depth([0.0; 3]));
        assert!(at([0.0, 1.0, 0.0])[1] < at([0.0; 3])[1]);
    }

    #[test]
    fn from_straight_above_heights_do_not_matter() {
        let eye = eye(180.0, 90.0);
        let [a, b] = [eye.pixel([0.3, 0.2, 0.0]), eye.pixel([0.3, 0.2, 1.0])];
        assert!((a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9);
    }
}

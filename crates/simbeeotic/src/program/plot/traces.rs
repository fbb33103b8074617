//! Traces: who flew where, from above, over the map of the world.

use super::super::{Failure, remark};
use super::arguments::{ColorBy, TraceOptions};
use super::axes::Panel;
use super::flights::{Flight, Flights};
use super::ground::{Ground, MarkKind, draw_mark};
use super::lines::{clipped, simplified};
use super::map::{Column, Names, map, north, scale_bar};
use super::palette::{ramp, series};
use super::sheet::{FAINT, Ink, SMALL, Sheet, WHITE};
use super::solid;
use super::source::Source;
use simbeeotic_record::Stage;
use simbeeotic_units::Length;

/// Beyond so many, colours are not told apart.
pub(super) const COLOURS: usize = 7;
/// More names hide what is below.
const NAMES_MAX: usize = 40;
/// What the pen cannot show, pixels.
const TOLERANCE: f64 = 0.3;
/// More points than these make a file large, and no picture better.
const POINTS_MAX: usize = 40_000;
/// Parts of a trace that changes its colour: of one, and of all together.
const PARTS: usize = 48;
const PARTS_ALL: usize = 800;
/// A world that would leave less than this share of the map to the flights is not drawn whole.
const SHARE_LEAST: f64 = 0.4;
/// Who stays where it is, and has no colour of its own.
const STATION: Ink = Ink::new([0x26, 0x2b, 0x33]);

/// What is drawn of a recording.
pub(super) struct Scene {
    /// Who flies.
    pub(super) moving: Vec<Flight>,
    /// Who stays where it is.
    pub(super) still: Vec<Flight>,
    pub(super) times_s: Vec<f64>,
    pub(super) stage: Option<Stage>,
    /// Of all, those who stay among them.
    pub(super) spans_m: [[f64; 2]; 3],
}

/// The picture.
pub(super) fn traces(source: &Source, options: &TraceOptions) -> Result<Sheet, Failure> {
    let flights = Flights::read(source, &options.models)?;
    let [first, last] = flights.times_ns();
    let spans = [0, 1, 2].map(|k| flights.span(k));
    let [Some(x), Some(y), Some(z)] = spans else {
        return Err(source.nothing(false, "positions", "all that is recorded of them is NaN"));
    };
    let stage = source.stage()?;
    if stage.is_none() {
        remark(format!(
            "note: {} has no world recorded in it; the flights are drawn without",
            source.file()
        ));
    }
    let Flights {
        times_s, flights, ..
    } = flights;
    let (still, moving): (Vec<_>, Vec<_>) = flights.into_iter().partition(Flight::is_still);
    let scene = Scene {
        moving,
        still,
        times_s,
        stage,
        spans_m: [x, y, z],
    };
    let count = |n: usize, what: &str| match n {
        0 => String::new(),
        n => format!(", {n} {what}"),
    };
    let what = format!(
        "{} {}{}",
        scene.moving.len(),
        match scene.moving.len() {
            1 => "flight",
            _ => "flights",
        },
        count(scene.still.len(), "at rest")
    );
    let [width, height] = options.plot.size();
    let title = options.plot.title("Flights");
    let mut sheet = Sheet::titled(width, height, title, &source.caption(first, last, &what));
    match options.solid {
        true => solid::draw(&mut sheet, &scene, options)?,
        false => draw(&mut sheet, &scene, options)?,
    }
    Ok(sheet)
}

fn draw(sheet: &mut Sheet, scene: &Scene, options: &TraceOptions) -> Result<(), Failure> {
    let ground = (scene.stage.as_ref()).map(|stage| Ground::of(stage, &options.hide));
    let [[west, east], [south, north_end], [_, ceiling]] = scene.spans_m;
    let mut bounds = [west, south, east, north_end];
    if let Some(world) = ground.as_ref().and_then(Ground::bounds) {
        let whole = [
            bounds[0].min(world[0]),
            bounds[1].min(world[1]),
            bounds[2].max(world[2]),
            bounds[3].max(world[3]),
        ];
        let long = |b: [f64; 4]| (b[2] - b[0]).max(b[3] - b[1]);
        if options.whole || long(bounds) >= SHARE_LEAST * long(whole) {
            bounds = whole;
        }
    }
    let level_m = match &options.level {
        None => ceiling,
        Some(text) => text
            .parse::<Length>()
            .map_err(|error| Failure::input(format!("--level: {error}")))?
            .metres(),
    };
    let panel = map(sheet, bounds);
    if let Some(ground) = &ground {
        ground.plane(sheet, &panel);
    }
    panel.draw(sheet, true);
    if let Some(ground) = &ground {
        ground.draw(sheet, &panel, level_m);
    }
    let paints = Paints::of(scene, options.color);
    lines(sheet, &panel, scene, &paints);
    ends(sheet, &panel, scene, &paints);
    if let Some(ground) = &ground {
        ground.marks(sheet, &panel);
    }
    stations(sheet, &panel, scene);
    names(sheet, &panel, scene, ground.as_ref());
    north(sheet, &panel);
    scale_bar(sheet, &panel);
    let mut column = Column::beside(&panel);
    paints.legend(sheet, &mut column, scene);
    legend(sheet, &mut column, scene, ground.as_ref());
    Ok(())
}

/// What the colours of the traces say.
pub(super) enum Paints {
    /// One each.
    Vehicle,
    /// Names of the groups.
    Kind(Vec<String>),
    /// From the first to the last time, s.
    Time([f64; 2]),
    /// From the lowest to the highest, m.
    Altitude([f64; 2]),
}

impl Paints {
    pub(super) fn of(scene: &Scene, wanted: Option<ColorBy>) -> Self {
        let few = scene.moving.len() <= COLOURS;
        let by = wanted.unwrap_or(match few {
            true => ColorBy::Vehicle,
            false => ColorBy::Kind,
        });
        match by {
            ColorBy::Vehicle => Self::Vehicle,
            ColorBy::Kind => {
                let mut groups: Vec<String> = Vec::new();
                for flight in &scene.moving {
                    if !groups.iter().any(|group| group == flight.group()) {
                        groups.push(flight.group().to_owned());
                    }
                }
                Self::Kind(groups)
            }
            ColorBy::Time => {
                let ends = [scene.times_s.first(), scene.times_s.last()];
                Self::Time(ends.map(|time| time.copied().unwrap_or(0.0)))
            }
            ColorBy::Altitude => {
                let heights = || scene.moving.iter().flat_map(Flight::known).map(|p| p.1[2]);
                let low = heights().fold(f64::INFINITY, f64::min);
                let high = heights().fold(f64::NEG_INFINITY, f64::max);
                Self::Altitude(if low < high { [low, high] } else { [0.0, 1.0] })
            }
        }
    }

    /// The colour of a flight at a time and a height; of those that do not change, at any.
    pub(super) fn ink(&self, place: usize, flight: &Flight, time_s: f64, z: f64) -> Ink {
        let share = |[low, high]: [f64; 2], at: f64| ramp((at - low) / (high - low).max(1e-9));
        match self {
            Self::Vehicle => series(place % COLOURS),
            Self::Kind(groups) => {
                series(groups.iter().position(|g| g == flight.group()).unwrap_or(0))
            }
            Self::Time(ends) => share(*ends, time_s),
            Self::Altitude(ends) => share(*ends, z),
        }
    }

    /// Whether a flight has more than one colour.
    pub(super) fn changes(&self) -> bool {
        matches!(self, Self::Time(_) | Self::Altitude(_))
    }

    pub(super) fn legend(&self, sheet: &mut Sheet, column: &mut Column, scene: &Scene) {
        match self {
            Self::Vehicle if scene.moving.len() <= COLOURS => {
                for (at, flight) in scene.moving.iter().enumerate() {
                    column.line(sheet, series(at), 2.4, &flight.path);
                }
            }
            Self::Vehicle => {
                column.note(sheet, &["each flight has a", "colour; they repeat"]);
            }
            Self::Kind(groups) => {
                for (at, group) in groups.iter().enumerate() {
                    if at >= COLOURS {
                        column.line(sheet, series(at), 2.4, "others");
                        break;
                    }
                    let flights = || scene.moving.iter().filter(|f| f.group() == group);
                    let text = match flights().count() {
                        1 => group.clone(),
                        n => format!("{group} ({n})"),
                    };
                    column.line(sheet, series(at), 2.4, &text);
                }
            }
            Self::Time(ends) => column.colours(sheet, "time, s", *ends, ramp),
            Self::Altitude(ends) => column.colours(sheet, "height, m", *ends, ramp),
        }
        column.gap();
    }
}

/// How thick a trace is and how much it covers, when there are so many.
pub(super) fn pen(count: usize) -> (f64, f64) {
    match count {
        0..=7 => (1.8, 0.9),
        8..=30 => (1.3, 0.75),
        31..=150 => (1.0, 0.5),
        151..=1000 => (0.8, 0.3),
        _ => (0.7, 0.15),
    }
}

/// The parts of one of so many flights that have one colour each, and the place of a point in the middle of each.
pub(super) fn parts(
    paints: &Paints,
    points: &[(usize, [f64; 3])],
    flights: usize,
) -> Vec<(usize, std::ops::RangeInclusive<usize>)> {
    let Some(last) = points.len().checked_sub(1).filter(|last| *last > 0) else {
        return Vec::new();
    };
    let most = (PARTS_ALL / flights.max(1)).clamp(8, PARTS);
    let count = if paints.changes() { most.min(last) } else { 1 };
    (0..count)
        .map(|part| {
            let (from, to) = (part * last / count, (part + 1) * last / count);
            ((from + to) / 2, from..=to)
        })
        .collect()
}

/// The traces, as coarse as their number needs.
fn lines(sheet: &mut Sheet, panel: &Panel, scene: &Scene, paints: &Paints) {
    let (width, alpha) = pen(scene.moving.len());
    let mut tolerance = TOLERANCE;
    loop {
        let mut drawn: Vec<(Vec<[f64; 2]>, Ink)> = Vec::new();
        for (place, flight) in scene.moving.iter().enumerate() {
            let points: Vec<_> = flight.known().collect();
            for (middle, range) in parts(paints, &points, scene.moving.len()) {
                let (at, point) = points[middle];
                let ink = paints.ink(place, flight, scene.times_s[at], point[2]);
                let pixels: Vec<[f64; 2]> = (points[range].iter())
                    .map(|(_, [x, y, _])| panel.place(*x, *y))
                    .collect();
                let pieces = clipped(&simplified(&pixels, tolerance), panel.edges);
                drawn.extend(pieces.into_iter().map(|piece| (piece, ink)));
            }
        }
        let count: usize = drawn.iter().map(|(points, _)| points.len()).sum();
        if count > POINTS_MAX && tolerance < 4.0 {
            tolerance *= 1.6;
            continue;
        }
        for (points, ink) in drawn {
            sheet.line(points, ink.thin(alpha), width);
        }
        return;
    }
}

/// A ring where a flight starts, a dot where it ends.
fn ends(sheet: &mut Sheet, panel: &Panel, scene: &Scene, paints: &Paints) {
    let radius = match scene.moving.len() {
        0..=7 => 5.0,
        8..=30 => 4.0,
        31..=150 => 2.6,
        _ => 1.4,
    };
    for (place, flight) in scene.moving.iter().enumerate() {
        let mut known = flight.known();
        let Some(first) = known.next() else { continue };
        let last = known.last().unwrap_or(first);
        let ink = |(at, p): (usize, [f64; 3])| paints.ink(place, flight, scene.times_s[at], p[2]);
        let at = |(_, [x, y, _]): (usize, [f64; 3])| panel.place(x, y);
        if scene.moving.len() <= 150 {
            sheet.disc(at(first), radius, ink(first), 0.0);
            sheet.disc(at(first), radius - 1.3, WHITE, 0.0);
        }
        sheet.disc(
            at(last),
            radius,
            ink(last),
            if radius > 2.0 { 1.0 } else { 0.0 },
        );
    }
}

/// Squares for those that stay where they are.
fn stations(sheet: &mut Sheet, panel: &Panel, scene: &Scene) {
    for [x, y] in scene.still.iter().filter_map(rest) {
        station(sheet, panel.place(x, y), scene.still.len());
    }
}

/// The square of one that stays where it is.
pub(super) fn station(sheet: &mut Sheet, [x, y]: [f64; 2], count: usize) {
    let half = if count > 60 { 2.2 } else { 4.5 };
    let square = |half: f64| ([x - half, y - half], [x + half, y + half]);
    let (a, b) = square(half + 1.2);
    sheet.rectangle(a, b, WHITE);
    let (a, b) = square(half);
    sheet.rectangle(a, b, STATION);
}

fn rest(flight: &Flight) -> Option<[f64; 2]> {
    flight.known().next().map(|(_, [x, y, _])| [x, y])
}

fn names(sheet: &mut Sheet, panel: &Panel, scene: &Scene, ground: Option<&Ground>) {
    let still = scene.still.iter().filter_map(|flight| {
        let [x, y] = rest(flight)?;
        Some((panel.place(x, y), flight.path.clone()))
    });
    let mut named: Vec<([f64; 2], String)> = still.collect();
    if named.len() > NAMES_MAX {
        // Of many, those that are alone of their kind: the hive among the beacons.
        let group = |path: &str| {
            let of = scene.still.iter().find(|flight| flight.path == path);
            let group = of.map_or("", |flight| flight.group());
            scene.still.iter().filter(|f| f.group() == group).count()
        };
        named.retain(|(_, path)| group(path) == 1);
    }
    let marks = ground.map_or(&[][..], |ground| ground.marks.as_slice());
    let marks = marks.iter().filter(|mark| {
        mark.kind != MarkKind::Flower && mark.kind != MarkKind::Light && !mark.label.is_empty()
    });
    let marks: Vec<_> = marks.collect();
    if marks.len() + named.len() <= NAMES_MAX {
        for mark in marks {
            let [x, y] = mark.place_m;
            named.push((panel.place(x, y), mark.label.clone()));
        }
    }
    let [left, top, right, bottom] = panel.edges;
    named.retain(|([x, y], _)| (left..=right).contains(x) && (top..=bottom).contains(y));
    let mut names = Names::around(panel.edges, named.iter().map(|(at, _)| *at));
    for (at, text) in &named {
        names.write(sheet, *at, text, SMALL, |_, _| 0.0);
    }
}

/// What the marks say, below the colours.
fn legend(sheet: &mut Sheet, column: &mut Column, scene: &Scene, ground: Option<&Ground>) {
    if !scene.moving.is_empty() {
        if scene.moving.len() <= 150 {
            column.mark(sheet, "start", |sheet, at| {
                sheet.disc(at, 4.5, FAINT, 0.0);
                sheet.disc(at, 3.2, WHITE, 0.0);
            });
        }
        column.mark(sheet, "end", |sheet, at| sheet.disc(at, 4.5, FAINT, 0.0));
    } else {
        column.note(sheet, &["nobody moved"]);
    }
    if !scene.still.is_empty() {
        column.mark(sheet, "at rest", |sheet, at| station(sheet, at, 1));
    }
    let Some(ground) = ground else { return };
    for (kind, text) in [
        (MarkKind::Flower, "flower"),
        (MarkKind::Person, "person"),
        (MarkKind::Light, "light"),
        (MarkKind::Source, "source of gas"),
    ] {
        if let Some(mark) = ground.marks.iter().find(|mark| mark.kind == kind)
            && column.room() > 0
        {
            column.mark(sheet, text, |sheet, at| {
                draw_mark(sheet, at, kind, mark.ink, 25.0);
            });
        }
    }
}

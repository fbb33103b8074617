//! Traces: who flew where, from above, over the map of the world.

use super::super::{Failure, remark};
use super::arguments::{ColorBy, TraceOptions};
use super::axes::Panel;
use super::flights::{Flight, Flights};
use super::ground::{Ground, MarkKind, draw_mark};
use super::lines::{clipped, simplified};
use super::map::{Column, Names, axes, heading, maps, north, scale_bar};
use super::names;
use super::palette::{ramp, series};
use super::sheet::{FAINT, Ink, SMALL, Sheet, WHITE};
use super::solid;
use super::source::{Source, Sources};
use super::sweep::{Group, map_groups};
use simbeeotic_record::Stage;
use simbeeotic_units::Length;

/// Beyond so many, colours are not told apart.
pub(super) const COLOURS: usize = 7;
/// More names hide what is below.
const NAMES_MAX: usize = 40;
/// The same on each of several maps.
const NAMES_FEW: usize = 6;
/// Of more flights the places where they start are not marked.
const STARTS_MAX: usize = 150;
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

/// What is drawn on one map: a recording, or several, one over the other.
pub(super) struct Scene {
    /// What sets its runs apart from those of other maps; empty of the only one.
    name: String,
    /// Who flies.
    pub(super) moving: Vec<Flight>,
    /// Who stays where it is.
    pub(super) still: Vec<Flight>,
    pub(super) stage: Option<Stage>,
    /// Whether some things do not stand in all of its runs.
    differ: bool,
    /// Of all, those who stay among them.
    pub(super) spans_m: [[f64; 2]; 3],
    /// The first and the last time, ns.
    times_ns: [u64; 2],
}

/// The picture.
pub(super) fn traces(sources: &Sources, options: &TraceOptions) -> Result<Sheet, Failure> {
    let groups = map_groups(sources, options.by.as_deref())?;
    if options.solid && groups.len() > 1 {
        return Err(Failure::input(format!(
            "--3d draws one picture, and --by sets {} apart: leave one of them out",
            groups.len()
        )));
    }
    let mut runs = Vec::new();
    let scenes = groups
        .iter()
        .map(|group| Scene::of(group, options, &mut runs));
    let scenes: Vec<Scene> = scenes.collect::<Result<_, _>>()?;
    let stages: Vec<&Stage> = scenes.iter().filter_map(|s| s.stage.as_ref()).collect();
    // What does not stand in all runs is not drawn; hidden it may be, then.
    if !stages.is_empty() && !scenes.iter().any(|scene| scene.differ) {
        names::hidden(&stages, &options.hide)?;
    }
    let over = groups.iter().any(|group| group.runs.len() > 1);
    let color = options.color.or(over.then_some(ColorBy::Run));
    let paints = Paints::of(&scenes, color, runs);

    let sum = |count: fn(&Scene) -> usize| scenes.iter().map(count).sum::<usize>();
    let mut what = match sum(|scene| scene.moving.len()) {
        1 => "1 flight".to_owned(),
        n => format!("{n} flights"),
    };
    if let [scene] = scenes.as_slice()
        && !scene.still.is_empty()
    {
        what += &format!(", {} at rest", scene.still.len());
    }
    let first = scenes
        .iter()
        .map(|scene| scene.times_ns[0])
        .min()
        .unwrap_or(0);
    let last = scenes
        .iter()
        .map(|scene| scene.times_ns[1])
        .max()
        .unwrap_or(0);
    let [width, height] = options.plot.size();
    let title = options.plot.title("Flights");
    let mut sheet = Sheet::titled(width, height, title, &sources.caption(first, last, &what));
    match scenes.as_slice() {
        [scene] if options.solid => solid::draw(&mut sheet, scene, &paints, options)?,
        scenes => draw(&mut sheet, scenes, &paints, options)?,
    }
    Ok(sheet)
}

impl Scene {
    /// Reads the runs of a map; notes what each run is called.
    fn of(group: &Group, options: &TraceOptions, names: &mut Vec<String>) -> Result<Self, Failure> {
        let (stage, others) = Source::common_stage(&group.runs)?;
        if others > 0 {
            remark(format!(
                "note: the worlds of these runs differ: {others} things are not drawn, since they do not stand in \
                 all of them"
            ));
        } else if stage.is_none() {
            remark(format!(
                "note: {} has no world recorded in it; the flights are drawn without",
                group.runs[0].file()
            ));
        }
        let mut scene = Self {
            name: group.name.clone(),
            moving: Vec::new(),
            still: Vec::new(),
            stage,
            differ: others > 0,
            spans_m: [[f64::INFINITY, f64::NEG_INFINITY]; 3],
            times_ns: [u64::MAX, 0],
        };
        for (source, name) in group.runs.iter().zip(run_names(&group.runs)) {
            let known = names.iter().position(|other| *other == name);
            let run = known.unwrap_or_else(|| {
                names.push(name);
                names.len() - 1
            });
            let mut flights = Flights::read(source, &options.models)?;
            let [first, last] = flights.times_ns();
            let [begin, end] = scene.times_ns;
            scene.times_ns = [begin.min(first), end.max(last)];
            for (axis, whole) in scene.spans_m.iter_mut().enumerate() {
                let Some([low, high]) = flights.span(axis) else {
                    let all = "all that is recorded of them is NaN";
                    return Err(source.nothing(false, "positions", all));
                };
                *whole = [whole[0].min(low), whole[1].max(high)];
            }
            flights
                .flights
                .iter_mut()
                .for_each(|flight| flight.run = run);
            let (still, moving): (Vec<_>, Vec<_>) =
                flights.flights.into_iter().partition(Flight::is_still);
            scene.moving.extend(moving);
            // A hive stands where it stands in every run.
            for flight in still {
                let same =
                    |other: &Flight| other.path == flight.path && rest(other) == rest(&flight);
                if !scene.still.iter().any(same) {
                    scene.still.push(flight);
                }
            }
        }
        Ok(scene)
    }
}

/// What the runs of a map are called: by their seeds, if these differ, else by their files.
fn run_names(runs: &[&Source]) -> Vec<String> {
    let mut seeds: Vec<_> = runs.iter().map(|run| run.recording.seed()).collect();
    seeds.sort_unstable();
    seeds.dedup();
    let by_seed = seeds.len() == runs.len() && !seeds.contains(&None);
    let name = |run: &&Source| match run.recording.seed() {
        Some(seed) if by_seed => format!("seed {}", seed.cast_signed()),
        _ => run.stem(),
    };
    runs.iter().map(name).collect()
}

fn draw(
    sheet: &mut Sheet,
    scenes: &[Scene],
    paints: &Paints,
    options: &TraceOptions,
) -> Result<(), Failure> {
    let level_m = match &options.level {
        None => None,
        Some(text) => {
            let level = text.parse::<Length>();
            let level = level.map_err(|error| Failure::input(format!("--level: {error}")))?;
            Some(level.metres())
        }
    };
    let grounds: Vec<Option<Ground>> = (scenes.iter())
        .map(|scene| Some(Ground::of(scene.stage.as_ref()?, &options.hide)))
        .collect();
    let spans = scenes.iter().map(|scene| {
        let [[west, east], [south, north_end], _] = scene.spans_m;
        [west, south, east, north_end]
    });
    let flown = spans.reduce(around).unwrap_or_default();
    let worlds = grounds
        .iter()
        .filter_map(|ground| ground.as_ref()?.bounds());
    let whole = worlds.fold(flown, around);
    let long = |b: [f64; 4]| (b[2] - b[0]).max(b[3] - b[1]);
    let bounds = match options.whole || long(flown) >= SHARE_LEAST * long(whole) {
        true => whole,
        false => flown,
    };
    let panels = maps(sheet, bounds, scenes.len());
    for (at, (scene, ground)) in scenes.iter().zip(&grounds).enumerate() {
        let panel = &panels[at];
        if let Some(ground) = ground {
            ground.plane(sheet, panel);
        }
        axes(sheet, &panels, at);
        let [_, _, [_, ceiling]] = scene.spans_m;
        if let Some(ground) = ground {
            ground.draw(sheet, panel, level_m.unwrap_or(ceiling));
        }
        lines(sheet, panel, scene, paints);
        ends(sheet, panel, scene, paints);
        if let Some(ground) = ground {
            ground.marks(sheet, panel);
        }
        stations(sheet, panel, scene);
        let most = if scenes.len() > 1 {
            NAMES_FEW
        } else {
            NAMES_MAX
        };
        names(sheet, panel, scene, ground.as_ref(), most);
        if scenes.len() > 1 {
            heading(sheet, panel, &scene.name);
        }
    }
    north(sheet, &panels[0]);
    if let [panel] = panels.as_slice() {
        scale_bar(sheet, panel);
    }
    let [_, top, ..] = panels[0].edges;
    let mut column = Column::at(f64::from(sheet.width), top + 12.0, f64::from(sheet.height));
    paints.legend(sheet, &mut column, scenes);
    legend(sheet, &mut column, scenes, grounds.iter().flatten());
    Ok(())
}

/// The least bounds around two: west, south, east, north.
fn around(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [
        a[0].min(b[0]),
        a[1].min(b[1]),
        a[2].max(b[2]),
        a[3].max(b[3]),
    ]
}

/// What the colours of the traces say.
pub(super) enum Paints {
    /// One each.
    Vehicle,
    /// Names of the groups.
    Kind(Vec<String>),
    /// Names of the runs.
    Run(Vec<String>),
    /// From the first to the last time, s.
    Time([f64; 2]),
    /// From the lowest to the highest, m.
    Altitude([f64; 2]),
}

impl Paints {
    fn of(scenes: &[Scene], wanted: Option<ColorBy>, runs: Vec<String>) -> Self {
        let moving = || scenes.iter().flat_map(|scene| &scene.moving);
        let few = scenes.iter().all(|scene| scene.moving.len() <= COLOURS);
        let by = wanted.unwrap_or(match few {
            true => ColorBy::Vehicle,
            false => ColorBy::Kind,
        });
        match by {
            ColorBy::Vehicle => Self::Vehicle,
            ColorBy::Kind => {
                let mut groups: Vec<String> = Vec::new();
                for flight in moving() {
                    if !groups.iter().any(|group| group == flight.group()) {
                        groups.push(flight.group().to_owned());
                    }
                }
                Self::Kind(groups)
            }
            ColorBy::Run => Self::Run(runs),
            ColorBy::Time => {
                let first = scenes.iter().map(|scene| scene.times_ns[0]).min();
                let last = scenes.iter().map(|scene| scene.times_ns[1]).max();
                Self::Time([first, last].map(|time| time.unwrap_or(0) as f64 * 1e-9))
            }
            ColorBy::Altitude => {
                let heights = || moving().flat_map(Flight::known).map(|p| p.1[2]);
                let low = heights().fold(f64::INFINITY, f64::min);
                let high = heights().fold(f64::NEG_INFINITY, f64::max);
                Self::Altitude(if low < high { [low, high] } else { [0.0, 1.0] })
            }
        }
    }

    /// The colour of a flight at a time and a height; of those that do not change, at any.
    pub(super) fn ink(&self, place: usize, flight: &Flight, at: usize, z: f64) -> Ink {
        let share = |[low, high]: [f64; 2], at: f64| ramp((at - low) / (high - low).max(1e-9));
        match self {
            Self::Vehicle => series(place % COLOURS),
            Self::Kind(groups) => {
                series(groups.iter().position(|g| g == flight.group()).unwrap_or(0))
            }
            // More than are told apart are all alike.
            Self::Run(names) if names.len() > COLOURS => series(0),
            Self::Run(_) => series(flight.run),
            Self::Time(ends) => share(*ends, flight.times_s.get(at).copied().unwrap_or(0.0)),
            Self::Altitude(ends) => share(*ends, z),
        }
    }

    /// Whether a flight has more than one colour.
    pub(super) fn changes(&self) -> bool {
        matches!(self, Self::Time(_) | Self::Altitude(_))
    }

    pub(super) fn legend(&self, sheet: &mut Sheet, column: &mut Column, scenes: &[Scene]) {
        match self {
            Self::Vehicle if scenes.iter().all(|scene| scene.moving.len() <= COLOURS) => {
                let most = scenes.iter().max_by_key(|scene| scene.moving.len());
                for (at, flight) in most.iter().flat_map(|scene| &scene.moving).enumerate() {
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
                    let all = || scenes.iter().flat_map(|scene| &scene.moving);
                    let text = match all().filter(|f| f.group() == group).count() {
                        n if n > 1 && scenes.len() == 1 => format!("{group} ({n})"),
                        _ => group.clone(),
                    };
                    column.line(sheet, series(at), 2.4, &text);
                }
            }
            Self::Run(names) if names.len() > COLOURS => {
                column.line(sheet, series(0), 2.4, &format!("{} runs", names.len()));
            }
            Self::Run(names) => {
                for (at, name) in names.iter().enumerate() {
                    column.line(sheet, series(at), 2.4, name);
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
                let ink = paints.ink(place, flight, at, point[2]);
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
        let ink = |(at, p): (usize, [f64; 3])| paints.ink(place, flight, at, p[2]);
        let at = |(_, [x, y, _]): (usize, [f64; 3])| panel.place(x, y);
        if scene.moving.len() <= STARTS_MAX {
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

fn names(sheet: &mut Sheet, panel: &Panel, scene: &Scene, ground: Option<&Ground>, most: usize) {
    let still = scene.still.iter().filter_map(|flight| {
        let [x, y] = rest(flight)?;
        Some((panel.place(x, y), flight.path.clone()))
    });
    let mut named: Vec<([f64; 2], String)> = still.collect();
    if named.len() > most {
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
    if marks.len() + named.len() <= most {
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
fn legend<'g>(
    sheet: &mut Sheet,
    column: &mut Column,
    scenes: &[Scene],
    grounds: impl Iterator<Item = &'g Ground>,
) {
    if scenes.iter().any(|scene| !scene.moving.is_empty()) {
        if scenes.iter().any(|scene| scene.moving.len() <= STARTS_MAX) {
            column.mark(sheet, "start", |sheet, at| {
                sheet.disc(at, 4.5, FAINT, 0.0);
                sheet.disc(at, 3.2, WHITE, 0.0);
            });
        }
        column.mark(sheet, "end", |sheet, at| sheet.disc(at, 4.5, FAINT, 0.0));
    } else {
        column.note(sheet, &["nobody moved"]);
    }
    if scenes.iter().any(|scene| !scene.still.is_empty()) {
        column.mark(sheet, "at rest", |sheet, at| station(sheet, at, 1));
    }
    let marks: Vec<_> = grounds.flat_map(|ground| &ground.marks).collect();
    for (kind, text) in [
        (MarkKind::Flower, "flower"),
        (MarkKind::Person, "person"),
        (MarkKind::Light, "light"),
        (MarkKind::Source, "source of gas"),
    ] {
        if let Some(mark) = marks.iter().find(|mark| mark.kind == kind)
            && column.room() > 0
        {
            column.mark(sheet, text, |sheet, at| {
                draw_mark(sheet, at, kind, mark.ink, 25.0);
            });
        }
    }
}

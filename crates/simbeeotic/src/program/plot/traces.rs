//! Traces: who flew where, from above, over the map of the world.

mod marks;
mod paints;

pub(super) use marks::station;
pub(super) use paints::{Paints, parts, pen};

use super::super::{Failure, remark};
use super::arguments::{ColorBy, TraceOptions};
use super::axes::Panel;
use super::flights::{Flight, Flights};
use super::ground::Ground;
use super::lines::{clipped, simplified};
use super::map::{Column, axes, heading, maps, north, scale_bar};
use super::names;
use super::sheet::{Ink, Sheet};
use super::solid;
use super::source::{Source, Sources};
use super::sweep::{Group, map_groups};
use marks::{ends, legend, rest, stations};
use simbeeotic_record::Stage;
use simbeeotic_units::Length;

/// Beyond so many, colours are not told apart.
pub(super) const COLOURS: usize = 7;
/// More names hide what is below.
const NAMES_MAX: usize = 40;
/// The same on each of several maps.
const NAMES_FEW: usize = 6;
/// What the pen cannot show, pixels.
const TOLERANCE: f64 = 0.3;
/// More points than these make a file large, and no picture better.
const POINTS_MAX: usize = 40_000;
/// A world that would leave less than this share of the map to the flights is not drawn whole.
const SHARE_LEAST: f64 = 0.4;

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
        marks::names(sheet, panel, scene, ground.as_ref(), most);
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

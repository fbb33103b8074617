//! What the colours of traces say, and how traces of many flights are drawn.

use super::super::arguments::ColorBy;
use super::super::flights::Flight;
use super::super::map::Column;
use super::super::palette::{ramp, series};
use super::super::sheet::{Ink, Sheet};
use super::{COLOURS, Scene};

/// Parts of a trace that changes its colour: of one, and of all together.
const PARTS: usize = 48;
const PARTS_ALL: usize = 800;

/// What the colours of the traces say.
pub(in super::super) enum Paints {
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
    pub(super) fn of(scenes: &[Scene], wanted: Option<ColorBy>, runs: Vec<String>) -> Self {
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
    pub(in super::super) fn ink(&self, place: usize, flight: &Flight, at: usize, z: f64) -> Ink {
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
    pub(in super::super) fn changes(&self) -> bool {
        matches!(self, Self::Time(_) | Self::Altitude(_))
    }

    pub(in super::super) fn legend(
        &self,
        sheet: &mut Sheet,
        column: &mut Column,
        scenes: &[Scene],
    ) {
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
pub(in super::super) fn pen(count: usize) -> (f64, f64) {
    match count {
        0..=7 => (1.8, 0.9),
        8..=30 => (1.3, 0.75),
        31..=150 => (1.0, 0.5),
        151..=1000 => (0.8, 0.3),
        _ => (0.7, 0.15),
    }
}

/// The parts of one of so many flights that have one colour each, and the place of a point in the middle of each.
pub(in super::super) fn parts(
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

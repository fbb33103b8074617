//! The plots of an experiment: wall time for the paper's 100 virtual seconds over the size, as in the paper's
//! figures; the soft real-time limits as dashed lines, here and there. Once with the paper's axes, which begin at
//! zero and are even; once with logarithmic ones, where the small sizes, and the paper's, have as much room as ours.

use super::alone::Run;
use super::arguments::Clock;
use super::limit::{Limit, count};
use super::machine::Machine;
use super::measure::{Measured, Row};
use super::paper::{self, Paper};
use super::workload::Cost;
use crate::program::plot::axes::Axis;
use crate::program::plot::chart::{Across, Chart, Curve, Marker, Rule};
use crate::program::plot::palette::series;
use crate::program::plot::sheet::{FAINT, Ink, SMALL, Sheet, TEXT};
use simbeeotic_view::render::words;

/// What the plot of an experiment is made from.
pub(super) struct Figure<'a> {
    pub(super) title: &'a str,
    /// What was run, short.
    pub(super) setup: String,
    /// What is on the x axis.
    pub(super) x: &'a str,
    /// What sets the curves apart, in words.
    pub(super) lines: Vec<String>,
    /// Whether all curves show where their time goes, or only the first one.
    pub(super) all_shares: bool,
    pub(super) paper: Paper,
    pub(super) measured: &'a Measured,
    pub(super) machine: &'a Machine,
    pub(super) duration_s: f64,
    pub(super) clock: Clock,
}

/// How numbers lie on both axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axes {
    /// From zero, evenly: as the paper has them.
    Even,
    /// Equal ratios are equally wide.
    Log,
}

/// Where soft real time ends is drawn on even axes if so much of the time is at least this share of it: else all
/// curves would lie on the ground.
const LEVEL_SHARE: f64 = 0.2;

/// A run that took no more wall time than so many times its processor time was hardly disturbed.
const UNDISTURBED: f64 = 1.25;
/// One that took so much processor time has been disturbed in all of its parts alike, s.
const LONG_S: f64 = 2.0;

/// Width and height, pixels.
const SIZE: [u32; 2] = [1100, 740];

/// The parts of the time, in the order of the key, and their places in the palette.
const SHARES: [(&str, usize); 6] = [
    ("all", 0),
    ("events", 1),
    ("physics", 2),
    ("radio", 5),
    ("other", 4),
    ("start, once", 6),
];

/// What 100 virtual seconds take by a clock, s: the [`SHARES`].
fn shares(clock: Clock, cost: &Cost) -> [f64; SHARES.len()] {
    let (start, whole) = (clock.start_of(cost), clock.of(cost));
    // The parts are of wall time: by another clock, each has its share.
    let rest = (whole - start).max(0.0) / (cost.wall_s - cost.start_s).max(1e-9);
    let often = paper::DURATION_S / cost.virtual_s;
    let part = |part_s: f64| part_s * rest * often;
    [
        clock.stretched(cost),
        part(cost.events_s),
        part(cost.physics_s),
        part(cost.radio_s),
        part(cost.other_s),
        start,
    ]
}

/// The colour of what the paper says.
fn paper_ink() -> Ink {
    series(3)
}

const MARKERS: [Marker; 2] = [Marker::Disc, Marker::Square];

impl Figure<'_> {
    pub(super) fn draw(&self, axes: Axes) -> Sheet {
        let mut curves = Vec::new();
        for line in 0..self.lines.len() {
            curves.extend(self.curves(line));
        }
        curves.extend(self.probes());
        let known = self.paper.limit.map(|n| [f64::from(n), paper::DURATION_S]);
        curves.extend(known.map(|point| Curve {
            name: "paper: real time ends".to_owned(),
            ink: paper_ink(),
            marker: Marker::Diamond,
            points: vec![point],
            spread: Vec::new(),
            line: None,
        }));

        let points = || curves.iter().flat_map(|curve| &curve.points);
        let spreads = curves.iter().flat_map(|curve| &curve.spread);
        let upright = self.rules(true).into_iter();
        let upright = upright.filter_map(|rule| match rule.across {
            Across::X(x) => Some(x),
            Across::Y(_) => None,
        });
        let xs = ends(points().map(|[x, _]| *x).chain(upright));
        let ys: Vec<f64> = (points()
            .map(|[_, y]| *y)
            .chain(spreads.flatten().flatten().copied()))
        .collect();
        let highest = ys.iter().copied().fold(0.0, f64::max);
        let level = axes == Axes::Log || highest >= LEVEL_SHARE * paper::DURATION_S;
        let rules = self.rules(level);
        let ys = ends(ys.into_iter().chain(level.then_some(paper::DURATION_S)));
        let zero = points().any(|[x, _]| *x == 0.0);
        let up = format!("{} for 100 virtual seconds, s", self.clock.name());
        let (x, y) = match axes {
            Axes::Even => (
                Axis::stretched(self.x, 0.0, xs[1], 8.0),
                Axis::stretched(up, 0.0, ys[1], 8.0),
            ),
            Axes::Log => (Axis::log(self.x, xs, zero), Axis::log(up, ys, false)),
        };
        let mut notes = self.notes();
        if !level {
            notes.insert(
                0,
                "Soft real time ends at 100 s, far above: all that was run keeps it.".to_owned(),
            );
        }
        let chart = Chart {
            title: self.title.to_owned(),
            caption: self.setup.clone(),
            x,
            y,
            curves,
            rules,
            notes,
        };
        let [width, height] = SIZE;
        chart.draw(width, height)
    }

    /// Where the time of one curve goes.
    fn curves(&self, line: usize) -> Vec<Curve> {
        let own = |row: &&Row| row.case.line == line;
        let mut rows: Vec<&Row> = self.measured.rows.iter().filter(own).collect();
        rows.extend(
            self.measured
                .probes
                .iter()
                .filter(own)
                .filter(|row| self.beyond(row)),
        );
        rows.sort_by_key(|row| row.case.size);
        let shares_drawn = if line == 0 || self.all_shares {
            SHARES.len()
        } else {
            1
        };
        let mut curves = Vec::new();
        for (at, (name, colour)) in SHARES.iter().take(shares_drawn).enumerate() {
            let per = |cost: &Cost| shares(self.clock, cost)[at];
            // What takes no time at all has no place on a logarithmic axis.
            let is_seen = |run: &Run| per(&run.cost) > 1e-6 && per(&run.cost).is_finite();
            let whole = at == 0;
            // The start has a clock of its own.
            let is_timed = whole || at + 1 == SHARES.len();
            let rows = rows.iter().filter_map(|row| {
                let runs: Vec<&Run> = match is_timed {
                    true => row.runs.iter().collect(),
                    false => row
                        .runs
                        .iter()
                        .filter(|run| self.knows_parts(run))
                        .collect(),
                };
                let is_drawn = !runs.is_empty() && runs.iter().all(|run| is_seen(run));
                is_drawn.then_some((row, runs))
            });
            let (points, spread): (Vec<_>, Vec<_>) = rows
                .map(|(row, runs)| {
                    let all = || runs.iter().map(|run| per(&run.cost));
                    let low = all().fold(f64::INFINITY, f64::min);
                    let high = all().fold(0.0, f64::max);
                    ([f64::from(row.case.size), low], Some([low, high]))
                })
                .unzip();
            if points.is_empty() {
                continue;
            }
            curves.push(Curve {
                name: match self.lines.len() {
                    1 => (*name).to_owned(),
                    _ => format!("{name}, {}", self.lines[line]),
                },
                ink: match line {
                    0 => series(*colour),
                    _ => series(*colour).thin(0.55),
                },
                marker: MARKERS[line % MARKERS.len()],
                points,
                spread: if whole { spread } else { Vec::new() },
                line: Some(if whole { 2.6 } else { 1.6 }),
            });
        }
        curves
    }

    /// Whether the parts of a run say where its processor time went: they are measured as wall time, so what others did
    /// meanwhile is in one part or another, unless it is little or the run so long that each part has its share.
    fn knows_parts(&self, run: &Run) -> bool {
        let used_s = self.clock.of(&run.cost);
        self.clock == Clock::Wall || run.cost.wall_s <= UNDISTURBED * used_s || used_s >= LONG_S
    }

    /// Whether what was run to find a limit is larger than all rows: then it is the end of the curves.
    fn beyond(&self, probe: &Row) -> bool {
        let mut rows = self.measured.rows.iter();
        rows.all(|row| row.case.size < probe.case.size)
    }

    /// What was run between the rows to find the limits, as points.
    fn probes(&self) -> Option<Curve> {
        let probes = self.measured.probes.iter();
        let is_seen = |row: &&Row| row.ratio(self.clock).is_finite();
        let points: Vec<_> = (probes.filter(|probe| !self.beyond(probe)))
            .filter(is_seen)
            .map(|row| {
                let ratios = row.runs.iter().map(|run| run.ratio(self.clock));
                let least = ratios.fold(f64::INFINITY, f64::min);
                [f64::from(row.case.size), least * paper::DURATION_S]
            })
            .collect();
        (!points.is_empty()).then(|| Curve {
            name: "all, in the search".to_owned(),
            ink: series(0).thin(0.5),
            marker: Marker::Square,
            points,
            spread: Vec::new(),
            line: None,
        })
    }

    /// The dashed lines; `level`: also where soft real time ends.
    fn rules(&self, level: bool) -> Vec<Rule> {
        let mut rules = Vec::new();
        if level {
            rules.push(Rule {
                across: Across::Y(paper::DURATION_S),
                label: "soft real time ends".to_owned(),
                ink: FAINT,
            });
        }
        // Curves with the same limit have one line.
        let mut limits: Vec<(u32, String, Vec<&str>)> = Vec::new();
        for (limit, line) in self.measured.limits.iter().zip(&self.lines) {
            // What was never lost is lost somewhere to the right of the largest that was run.
            let (at, said) = match (limit.estimate, limit.low, limit.high) {
                (Some(n), ..) => (n, format!("{}{}", count(n), bracket(limit))),
                (None, Some(low), None) if low > 0 => {
                    (low, format!("above {} \u{2192}", count(low)))
                }
                _ => continue,
            };
            match limits
                .iter_mut()
                .find(|(n, text, _)| (*n, text) == (at, &said))
            {
                Some((.., lines)) => lines.push(line),
                None => limits.push((at, said, vec![line])),
            }
        }
        for (at, said, lines) in limits {
            let label = match self.lines.len() {
                1 => format!("here: {said}"),
                _ => format!("here, {}: {said}", lines.join(" and ")),
            };
            rules.push(Rule {
                across: Across::X(f64::from(at)),
                label,
                ink: series(0),
            });
        }
        if let Some(n) = self.paper.limit {
            rules.push(Rule {
                across: Across::X(f64::from(n)),
                label: format!("paper: {}", count(n)),
                ink: paper_ink(),
            });
        }
        if let Some(n) = self.paper.goal {
            rules.push(Rule {
                across: Across::X(f64::from(n)),
                label: format!("the paper's goal: {}", count(n)),
                ink: paper_ink().mixed(TEXT, 0.45),
            });
        }
        rules
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.measured.broken.is_some() {
            notes.push("Broken off before its end: this is what there was.".to_owned());
        }
        let limits = self.measured.limits.iter().zip(&self.lines);
        let limits: Vec<String> = limits
            .map(|(limit, line)| said(limit, line, self.lines.len()))
            .collect();
        if !limits.is_empty() {
            notes.push(format!(
                "Soft real-time limit here, of the median of runs: {}.",
                limits.join("; ")
            ));
        }
        let counts = || self.measured.rows.iter().map(|row| row.runs.len());
        let (least, most) = (counts().min().unwrap_or(0), counts().max().unwrap_or(0));
        let runs = match (least, most) {
            (_, 1) => "One run for each point.".to_owned(),
            (least, most) if least == most => {
                format!("Points: least of {most} runs; band: all of them.")
            }
            (least, most) => {
                format!("Points: least of {least} to {most} runs; band: all of them.")
            }
        };
        let clock = match self.clock {
            Clock::Wall => "",
            Clock::Processor => {
                " Processor time is that of the busiest thread; its parts are not drawn of short runs that others \
                 disturbed."
            }
        };
        let scaled = match self.duration_s == paper::DURATION_S {
            true => String::new(),
            false => format!(
                " Runs are of {} s: their start is drawn once, all else {} times.",
                self.duration_s,
                paper::DURATION_S / self.duration_s
            ),
        };
        notes.push(format!("{runs}{clock}{scaled}"));
        let load = self.load().map_or_else(String::new, |load| {
            format!("; load of the machine {load:.1} in the mean")
        });
        notes.push(format!("Here: {}{load}.", self.machine.line()));
        notes.push(format!(
            "Paper ({}), {}: {}. Its curves are in its pictures only, not in numbers: they are not drawn.",
            paper::SOURCE,
            paper::CPU,
            self.paper.says
        ));
        let room = f64::from(SIZE[0]) - 48.0;
        notes.iter().flat_map(|note| wrapped(note, room)).collect()
    }

    /// How many threads of the machine wanted a processor before the runs, in the mean.
    fn load(&self) -> Option<f64> {
        let rows = self.measured.rows.iter().chain(&self.measured.probes);
        let loads: Vec<f64> = rows
            .flat_map(|row| &row.runs)
            .filter_map(|run| run.load)
            .collect();
        let mean = loads.iter().sum::<f64>() / loads.len() as f64;
        (!loads.is_empty()).then_some(mean)
    }
}

/// A text in lines that are no wider than a room, pixels.
fn wrapped(text: &str, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if words::width(&format!("{line} {word}"), SMALL) <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The ends between which a limit is, if they are more than a tenth apart.
fn bracket(limit: &Limit) -> String {
    match (limit.low, limit.high) {
        (Some(low), Some(high)) if f64::from(high) > 1.1 * f64::from(low) => {
            format!(" ({} to {})", count(low), count(high))
        }
        _ => String::new(),
    }
}

/// A limit in words, and of which curve it is, if there are several.
pub(super) fn said(limit: &Limit, line: &str, lines: usize) -> String {
    match lines {
        1 => limit.text.clone(),
        _ => format!("{line}: {}", limit.text),
    }
}

/// The least and the greatest of some numbers above zero.
fn ends(of: impl Iterator<Item = f64>) -> [f64; 2] {
    let start = [f64::INFINITY, 0.0_f64];
    let [low, high] = of
        .filter(|x| *x > 0.0 && x.is_finite())
        .fold(start, |[low, high], x| [low.min(x), high.max(x)]);
    match low <= high {
        // A point on an axis's end is hard to see.
        true => [low / 1.14, high * 1.14],
        false => [1.0, 10.0],
    }
}

#[cfg(test)]
mod tests {
    use super::super::alone::Case;
    use super::super::unfinished::Unfinished;
    use super::super::workload::tests::cost;
    use super::*;
    use crate::program::plot::sheet::{Shape, Words};

    fn draw(estimate: Option<u32>, clock: Clock, axes: Axes) -> Sheet {
        let row = |size: u32| {
            let runs = [1.0, 2.0].map(|slow| Run::of(cost(slow * f64::from(size) / 4120.0, "a")));
            Row::new(Case { line: 0, size }, runs.to_vec()).expect("two runs")
        };
        let limit = Limit {
            low: Some(40_000),
            high: estimate.map(|_| 42_500),
            estimate,
            settled: true,
            text: "as the search says".to_owned(),
        };
        let measured = Measured {
            rows: vec![row(1_000), row(40_000)],
            probes: vec![row(39_000), row(42_500)],
            limits: vec![limit],
            broken: None,
            unfinished: Unfinished::none(),
        };
        let figure = Figure {
            title: "Figure 7",
            setup: String::new(),
            x: "bees",
            lines: vec!["1 thread".to_owned()],
            all_shares: false,
            paper: paper::FIG7,
            measured: &measured,
            machine: &Machine::this(),
            duration_s: 10.0,
            clock,
        };
        figure.draw(axes)
    }

    /// The words of a picture, and the upright dashed lines.
    fn seen(sheet: &Sheet) -> (Vec<&str>, usize) {
        let words = sheet.shapes.iter().filter_map(|shape| match shape {
            Shape::Words(Words { text, .. }) => Some(text.as_str()),
            _ => None,
        });
        let upright = |shape: &&Shape| match shape {
            Shape::Line { points, dash, .. } => dash.is_some() && points[0][0] == points[1][0],
            _ => false,
        };
        (words.collect(), sheet.shapes.iter().filter(upright).count())
    }

    #[test]
    fn a_limit_that_was_found_is_a_dashed_line_beside_the_papers() {
        let sheet = draw(Some(41_200), Clock::Wall, Axes::Even);
        let (words, dashed) = seen(&sheet);
        assert_eq!(dashed, 3);
        for expected in [
            "here: 41,200",
            "paper: 3,074",
            "the paper's goal: 1,000",
            "all, in the search",
        ] {
            assert!(words.contains(&expected), "{expected}: {words:?}");
        }
        assert!(words.iter().any(|text| text.contains("all else 10 times")));
        assert!(!words.contains(&"radio"), "what takes no time is not drawn");
    }

    #[test]
    fn a_limit_that_was_not_found_is_drawn_at_the_largest_that_was_run() {
        let sheet = draw(None, Clock::Processor, Axes::Log);
        let (words, dashed) = seen(&sheet);
        assert_eq!(dashed, 3);
        assert!(words.contains(&"here: above 40,000 \u{2192}"), "{words:?}");
        assert!(words.iter().any(|text| text.contains("as the search says")));
        assert!(words.contains(&"processor time for 100 virtual seconds, s"));
    }

    #[test]
    fn the_parts_are_all_of_the_time_and_the_start_is_drawn_once() {
        let mut run = cost(4.0, "a");
        (run.start_s, run.wall_s) = (1.0, 5.0);
        let [all, parts @ ..] = shares(Clock::Wall, &run);
        // 1 s, and 4 s of 10 virtual seconds.
        assert_eq!(all, 41.0);
        assert!((parts.iter().sum::<f64>() - all).abs() < 1e-9, "{parts:?}");
        (run.busiest_thread_s, run.start_busiest_s) = (Some(2.5), Some(0.5));
        let [all, parts @ ..] = shares(Clock::Processor, &run);
        assert_eq!((all, parts[4]), (20.5, 0.5));
        assert!((parts.iter().sum::<f64>() - all).abs() < 1e-9, "{parts:?}");
    }

    #[test]
    fn notes_are_wrapped_and_lose_no_word() {
        let text = "a note that is long enough for several lines of words";
        let lines = wrapped(text, 120.0);
        assert!(lines.len() > 2, "{lines:?}");
        assert!(lines.iter().all(|line| words::width(line, SMALL) <= 120.0));
        assert_eq!(lines.join(" "), text);
    }

    #[test]
    fn the_papers_axes_are_even_and_begin_at_zero() {
        let ticks = |axes| {
            let sheet = draw(Some(41_200), Clock::Wall, axes);
            let (words, _) = seen(&sheet);
            let numbers = words.iter().filter_map(|text| {
                let text = text.replace([',', '\u{2009}', '\u{202f}', ' '], "");
                text.parse::<f64>().ok()
            });
            numbers.collect::<Vec<f64>>()
        };
        let (even, log) = (ticks(Axes::Even), ticks(Axes::Log));
        assert_eq!(
            even.iter().filter(|tick| **tick == 0.0).count(),
            2,
            "{even:?}"
        );
        for step in [10_000.0, 20_000.0, 30_000.0, 40_000.0] {
            assert!(even.contains(&step), "{step}: {even:?}");
        }
        assert!(!log.contains(&0.0) && log.contains(&1_000.0), "{log:?}");
    }
}

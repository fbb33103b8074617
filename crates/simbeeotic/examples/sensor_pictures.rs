//! Draws what each sensor of a bee read beside what was true: the sensors' part of the book's gallery.
//!
//! ```text
//! cargo run --release -p simbeeotic --example sensor_pictures                        the gallery's
//! cargo run --release -p simbeeotic --example sensor_pictures -- SCENARIO.toml DIR   yours
//! ```
//! The scenario runs through the library, watched by a component that keeps what sensors measure. Each
//! becomes an SVG file `sensor-NAME.svg`: scans as seen from above, everything else over time, the truth
//! as a grey line under the readings.

use simbeeotic::model::{
    Column, Component, ComponentError, Mark, Note, Simulation, Summary, Taken, View,
};
use simbeeotic::scenario::{Request, load_file, render};
use simbeeotic::units::{Time, math};
use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

fn main() -> Result<(), Box<dyn Error>> {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut arguments = std::env::args().skip(1).map(PathBuf::from);
    let scenario = arguments.next();
    let scenario = scenario.unwrap_or_else(|| repository.join("scenarios/sensors.toml"));
    let folder = arguments.next();
    let folder = folder.unwrap_or_else(|| repository.join("docs/images/gallery"));
    for (sensor, readings) in readings(&scenario)? {
        let name = sensor.rsplit('/').next().unwrap_or_default();
        std::fs::write(
            folder.join(format!("sensor-{name}.svg")),
            draw(name, &readings),
        )?;
    }
    Ok(())
}

/// What one sensor measured, and when, in seconds.
type Readings = Vec<(f64, Taken)>;

/// Keeps what all sensors measure, by their paths.
#[derive(Clone, Default)]
struct Keeper(Arc<Mutex<BTreeMap<String, Readings>>>);

impl Keeper {
    fn keep(&self, view: &View<'_>) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        for mark in view.marks() {
            if let Mark::Sensed {
                time,
                model,
                sensor,
                taken,
            } = mark
            {
                let name = view
                    .sensors(*model)
                    .nth(usize::from(*sensor))
                    .unwrap_or_default();
                let path = format!("{}/{name}", view.population().path(*model));
                let reading = (time.as_secs_f64(), Taken::clone(taken));
                kept.entry(path).or_default().push(reading);
            }
        }
    }
}

impl Component for Keeper {
    fn period(&self) -> Option<Time> {
        Some(Time::from_secs(1.0))
    }

    fn wants_reading(&self, _sensor: &str) -> bool {
        true
    }

    fn start(&mut self, _view: &View<'_>) -> Result<(), ComponentError> {
        Ok(())
    }

    fn observe(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        self.keep(view);
        Ok(())
    }

    fn finish(&mut self, view: &View<'_>, _: &Summary) -> Result<Vec<Note>, ComponentError> {
        self.keep(view);
        Ok(Vec::new())
    }
}

/// Runs a scenario to its end; what its sensors measured.
fn readings(scenario: &Path) -> Result<BTreeMap<String, Readings>, Box<dyn Error>> {
    let loaded = load_file(scenario, &Request::default())
        .map_err(|wrong| render::faults(&wrong.faults, &wrong.sources, false))?;
    let mut setup = loaded
        .setup()
        .map_err(|faults| render::faults(&faults, loaded.sources(), false))?;
    let keeper = Keeper::default();
    setup.components = vec![("keeper".to_owned(), Box::new(keeper.clone()))];
    let outcome = Simulation::new(setup)?.run();
    if let Some(error) = outcome.error {
        return Err(error.to_string().into());
    }
    let kept = std::mem::take(&mut *keeper.0.lock().unwrap_or_else(PoisonError::into_inner));
    Ok(kept)
}

/// The size of a picture, and the room around what is drawn.
const SIZE: [f64; 2] = [450.0, 300.0];
const ROOM: [f64; 2] = [66.0, 44.0];
/// The colours of the first columns of a reading, which the colour-blind tell apart, and that of the truth.
const COLORS: [&str; 3] = ["#0072b2", "#d55e00", "#009e73"];
const TRUTH: &str = "#b0b0b0";
/// About so many numbers along an axis.
const TICKS: f64 = 4.0;

fn draw(name: &str, readings: &Readings) -> String {
    let [width, height] = SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{width}\" height=\"{height}\" \
         fill=\"white\"/>\n<text x=\"{}\" y=\"20\" font-size=\"14\">{name}</text>\n",
        ROOM[0]
    );
    let columns = readings.first().map_or(&[][..], |(_, taken)| taken.columns);
    match columns {
        [azimuth, _, distance] if azimuth.name == "azimuth" && distance.name == "distance" => {
            scan(&mut svg, readings);
        }
        _ => series(&mut svg, columns, readings),
    }
    svg.push_str("</svg>\n");
    svg
}

/// A frame of numbers, and where they lie in the picture.
struct Frame {
    low: [f64; 2],
    high: [f64; 2],
}

impl Frame {
    /// Around these points, with a little room.
    fn around(points: impl Iterator<Item = [f64; 2]>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        if low[0] > high[0] {
            (low, high) = ([0.0; 2], [1.0; 2]);
        }
        let span = high[1] - low[1];
        let room = if span > 0.0 { 0.06 * span } else { 1.0 };
        (low[1], high[1]) = (low[1] - room, high[1] + room);
        Self { low, high }
    }

    fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let share = |axis: usize| {
            let span = (self.high[axis] - self.low[axis]).max(f64::MIN_POSITIVE);
            (point[axis] - self.low[axis]) / span
        };
        let inner = [SIZE[0] - ROOM[0] - 20.0, SIZE[1] - 2.0 * ROOM[1] - 8.0];
        [
            ROOM[0] + share(0) * inner[0],
            ROOM[1] + (1.0 - share(1)) * inner[1],
        ]
    }

    /// The frame itself, with numbers along its axes.
    fn draw(&self, svg: &mut String, unit: &str) {
        let ([left, bottom], [right, top]) = (self.place(self.low), self.place(self.high));
        let (mut lines, mut words) = (String::new(), String::new());
        for (time_s, text) in ticks(self.low[0], self.high[0]) {
            let [x, _] = self.place([time_s, self.low[1]]);
            let _ = write!(lines, "M{x:.1} {top:.1}V{bottom:.1}");
            let _ = write!(
                words,
                "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{text}</text>",
                bottom + 16.0
            );
        }
        for (value, text) in ticks(self.low[1], self.high[1]) {
            let [_, y] = self.place([self.low[0], value]);
            let _ = write!(lines, "M{left:.1} {y:.1}H{right:.1}");
            let _ = write!(
                words,
                "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>",
                left - 6.0,
                y + 4.0
            );
        }
        let _ = write!(
            svg,
            "<path d=\"{lines}\" stroke=\"#e4e7eb\"/>\n<path d=\"M{left:.1} {top:.1}V{bottom:.1}H{right:.1}\" \
             fill=\"none\" stroke=\"#707070\"/>\n<g fill=\"#404040\">{words}\
             <text x=\"{right:.1}\" y=\"{:.1}\" text-anchor=\"end\">time, s</text>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{unit}</text></g>\n",
            bottom + 30.0,
            left - 6.0,
            top - 8.0,
        );
    }
}

/// Round numbers between two, with their texts.
fn ticks(low: f64, high: f64) -> Vec<(f64, String)> {
    let least = (high - low) / TICKS;
    if !(least > 0.0 && least.is_finite()) {
        return vec![(low, short(low))];
    }
    let mut power = 1.0;
    while power > least {
        power /= 10.0;
    }
    while power * 10.0 <= least {
        power *= 10.0;
    }
    let steps = [1.0, 2.0, 5.0, 10.0].map(|part| part * power);
    let step = steps.into_iter().find(|step| *step >= 0.999 * least);
    let step = step.unwrap_or(10.0 * power);
    let mut decimals = 0;
    let mut unit = step;
    while unit < 0.999 && decimals < 9 {
        unit *= 10.0;
        decimals += 1;
    }
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    (first..=last)
        .map(|at| {
            let value = at as f64 * step;
            (
                value,
                format!("{value:.decimals$}").replace('-', "\u{2212}"),
            )
        })
        .collect()
}

/// Four digits.
fn short(number: f64) -> String {
    match number.abs() {
        size if size >= 1e5 || size < 1e-3 && size > 0.0 => format!("{number:.1e}"),
        size if size >= 100.0 => format!("{number:.0}"),
        size if size >= 1.0 => format!("{number:.2}"),
        _ => format!("{number:.3}"),
    }
}

/// What the colours of columns are, at the right above the frame.
fn key(svg: &mut String, names: &[&str]) {
    let mut x = SIZE[0] - 20.0;
    for (name, color) in names.iter().zip(COLORS).rev() {
        let _ = write!(
            svg,
            "<text x=\"{x:.1}\" y=\"20\" text-anchor=\"end\" fill=\"#404040\">{name}</text>"
        );
        x -= 7.2 * name.chars().count() as f64 + 8.0;
        let _ = writeln!(
            svg,
            "<circle cx=\"{x:.1}\" cy=\"16\" r=\"3.5\" fill=\"{color}\"/>"
        );
        x -= 14.0;
    }
}

/// One column of a reading over time: NaN where there was nothing to read.
fn over_time(readings: &Readings, numbers: Numbers, width: usize, column: usize) -> Vec<[f64; 2]> {
    let rows = readings.iter().flat_map(|(time, taken)| {
        let rows = numbers(taken).chunks_exact(width);
        rows.map(|row| [*time, row[column]])
    });
    rows.collect()
}

/// The truth, or the readings.
type Numbers = fn(&Taken) -> &[f64];

/// The first columns of one unit over time.
fn series(svg: &mut String, columns: &[Column], readings: &Readings) {
    // A number of something says more than a count, if there is one.
    let measured = |column: &&Column| column.unit != "1" && column.name != "time";
    let Some(first) = columns.iter().find(measured).or_else(|| columns.first()) else {
        return;
    };
    let width = columns.len();
    let shown: Vec<usize> = (0..width)
        .filter(|at| columns[*at].unit == first.unit)
        .take(COLORS.len())
        .collect();
    let (ideal, read): (Numbers, Numbers) = (|taken| &taken.ideal, |taken| &taken.reading);
    let ends = [readings.first(), readings.last()];
    let seen = |point: &[f64; 2]| point[1].is_finite();
    let all = shown.iter().flat_map(|at| {
        let both = [ideal, read].map(|numbers| over_time(readings, numbers, width, *at));
        both.concat().into_iter().filter(seen)
    });
    let mut frame = Frame::around(all);
    for (side, end) in [&mut frame.low, &mut frame.high].into_iter().zip(ends) {
        side[0] = end.map_or(0.0, |(time, _)| *time);
    }
    frame.draw(svg, if first.unit == "1" { "" } else { first.unit });
    let names: Vec<&str> = shown.iter().map(|at| columns[*at].name).collect();
    if names.iter().all(|name| !name.is_empty()) {
        key(svg, &names);
    }
    let single = readings.iter().all(|(_, taken)| taken.ideal.len() == width);
    for (color, at) in COLORS.iter().zip(shown) {
        let truth = over_time(readings, ideal, width, at);
        if single {
            let (mut way, mut pen) = (String::new(), 'M');
            for point in truth {
                if seen(&point) {
                    let [x, y] = frame.place(point);
                    let _ = write!(way, "{pen}{x:.1} {y:.1}");
                    pen = 'L';
                } else {
                    pen = 'M';
                }
            }
            let _ = writeln!(
                svg,
                "<path d=\"{way}\" fill=\"none\" stroke=\"{TRUTH}\" stroke-width=\"3\" \
                 stroke-linecap=\"round\"/>"
            );
        } else {
            let truth = truth.into_iter().filter(seen);
            dots(svg, TRUTH, 2.6, truth.map(|point| frame.place(point)));
        }
        let read = over_time(readings, read, width, at)
            .into_iter()
            .filter(seen);
        dots(svg, color, 1.6, read.map(|point| frame.place(point)));
    }
}

/// One scan as seen from above: the last that met something. The sensor looks to the right.
fn scan(svg: &mut String, readings: &Readings) {
    let Some((time, taken)) = readings.last() else {
        return;
    };
    let hits = |numbers: &[f64]| -> Vec<[f64; 2]> {
        let rows = numbers.chunks_exact(3).filter(|row| row[2].is_finite());
        let level = rows.map(|row| {
            let ((sin, cos), (_, flat)) = (math::sin_cos(row[0]), math::sin_cos(row[1]));
            [row[2] * cos * flat, row[2] * sin * flat]
        });
        level.collect()
    };
    let (truth, read) = (hits(&taken.ideal), hits(&taken.reading));
    let reach = truth
        .iter()
        .chain(&read)
        .flatten()
        .fold(1.0_f64, |most, x| most.max(x.abs()));
    let middle = [0.5 * SIZE[0], 0.5 * SIZE[1] + 8.0];
    let scale = (0.5 * SIZE[1] - 30.0) / reach;
    let place = |[x, y]: [f64; 2]| [middle[0] + scale * x, middle[1] - scale * y];
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"20\" text-anchor=\"end\" fill=\"#404040\">from above, {} m across, at {time:.1} s</text>",
        SIZE[0] - 20.0,
        short(2.0 * reach),
    );
    let _ = writeln!(
        svg,
        "<path d=\"M{0:.1} {1:.1}l12 0m-5 -4l5 4l-5 4\" fill=\"none\" stroke=\"black\"/>",
        middle[0], middle[1]
    );
    // Of a scan of thousands every n-th.
    let nth = read.len().div_ceil(1500).max(1);
    dots(
        svg,
        TRUTH,
        2.6,
        truth.iter().step_by(nth).map(|hit| place(*hit)),
    );
    dots(
        svg,
        COLORS[0],
        1.5,
        read.iter().step_by(nth).map(|hit| place(*hit)),
    );
}

/// Round dots as one path.
fn dots(svg: &mut String, color: &str, radius: f64, points: impl Iterator<Item = [f64; 2]>) {
    let mut way = String::new();
    for [x, y] in points {
        let _ = write!(way, "M{x:.1} {y:.1}h0");
    }
    let _ = writeln!(
        svg,
        "<path d=\"{way}\" stroke=\"{color}\" stroke-width=\"{}\" stroke-linecap=\"round\"/>",
        2.0 * radius
    );
}

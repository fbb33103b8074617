//! Draws the flight of a swarm as seen from above: the picture of the README, as an SVG file.
//!
//! ```text
//! cargo run --release -p simbeeotic --example first_picture                           the README's
//! cargo run --release -p simbeeotic --example first_picture -- SCENARIO.toml OUT.svg  yours
//! ```
//! The scenario runs through the library, in steps of a quarter of a second; between two steps the
//! poses of all bodies are read. The rest of the file is the drawing.

use simbeeotic::kernel::SimTime;
use simbeeotic::model::Simulation;
use simbeeotic::scenario::{Request, load_file, render};
use simbeeotic::units::math;
use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut arguments = std::env::args().skip(1).map(PathBuf::from);
    let scenario = arguments.next();
    let scenario = scenario.unwrap_or_else(|| repository.join("scenarios/first-swarm.toml"));
    let picture = arguments.next();
    let picture = picture.unwrap_or_else(|| repository.join("docs/images/first-swarm.svg"));
    std::fs::write(picture, draw(&fly(&scenario)?))?;
    Ok(())
}

/// Where one model was, step by step, in metres: east, north, up.
struct Trace {
    model: String,
    points: Vec<[f64; 3]>,
}

impl Trace {
    fn stands(&self) -> bool {
        self.points.iter().all(|p| *p == self.points[0])
    }
}

struct Flight {
    traces: Vec<Trace>,
    seconds: f64,
}

/// Time between two points of a trace.
const STEP: SimTime = SimTime::from_millis(250);

/// Runs a scenario to its end and notes where everybody is.
fn fly(scenario: &Path) -> Result<Flight, Box<dyn Error>> {
    let loaded = load_file(scenario, &Request::default())
        .map_err(|wrong| render::faults(&wrong.faults, &wrong.sources, false))?;
    let setup = loaded
        .setup()
        .map_err(|faults| render::faults(&faults, loaded.sources(), false))?;
    let mut run = Simulation::new(setup)?;

    let models = run
        .population()
        .iter()
        .map(|(_, member)| member.path.to_owned());
    let mut traces: Vec<Trace> = models
        .map(|model| Trace {
            model,
            points: Vec::new(),
        })
        .collect();
    let end = run.end();
    for step in 0..=end.nanos() / STEP.nanos() {
        run.run_until(SimTime::from_nanos(step * STEP.nanos()))?;
        for trace in &mut traces {
            let pose = run.pose(&trace.model);
            trace
                .points
                .extend(pose.map(|pose| pose.position.si().to_array()));
        }
    }
    traces.retain(|trace| !trace.points.is_empty());
    Ok(Flight {
        traces,
        seconds: end.as_secs_f64(),
    })
}

/// Longer edge of what the flight is drawn in, and what is left free around it, in pixels.
const EDGE: f64 = 720.0;
const LEFT: f64 = 62.0;
const TOP: f64 = 24.0;
const RIGHT: f64 = 112.0;
const BOTTOM: f64 = 56.0;

/// Colours by height, from the lowest band to the highest.
const BANDS: [&str; 8] = [
    "#a9c26f", "#7fb788", "#57a58c", "#3f938e", "#2a7c8b", "#206484", "#254b7b", "#2c3172",
];

/// What is shown of the world: a rectangle on the ground, and bands of height above it.
struct Window {
    west: f64,
    north: f64,
    pixels_per_metre: f64,
    width: f64,
    height: f64,
    /// The bottom of the lowest band, and how high each band is.
    low: f64,
    band: f64,
    bands: usize,
}

impl Window {
    /// The smallest window of equal axes that shows all traces.
    fn around(traces: &[Trace]) -> Self {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for point in traces.iter().flat_map(|trace| &trace.points) {
            for axis in 0..3 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        let [east, north] = [0, 1].map(|axis| (high[axis] - low[axis]).max(1.0) * 1.06);
        let scale = EDGE / east.max(north);
        let band = round_step((high[2] - low[2]).max(0.5) / BANDS.len() as f64);
        let bottom = (low[2] / band).floor() * band;
        Self {
            west: 0.5 * (low[0] + high[0] - east),
            north: 0.5 * (low[1] + high[1] + north),
            pixels_per_metre: scale,
            width: east * scale,
            height: north * scale,
            low: bottom,
            band,
            bands: ((high[2] - bottom) / band) as usize + 1,
        }
    }

    fn x(&self, east: f64) -> f64 {
        LEFT + (east - self.west) * self.pixels_per_metre
    }

    fn y(&self, north: f64) -> f64 {
        TOP + (self.north - north) * self.pixels_per_metre
    }

    fn band(&self, up: f64) -> usize {
        (((up - self.low) / self.band) as usize).min(self.bands - 1)
    }

    /// The colour of a band: the outermost bands get the outermost colours.
    fn colour(&self, band: usize) -> &'static str {
        BANDS[(band * (BANDS.len() - 1) / (self.bands - 1).max(1)).min(BANDS.len() - 1)]
    }
}

/// The flight as the text of an SVG file.
fn draw(flight: &Flight) -> String {
    let window = Window::around(&flight.traces);
    let (width, height) = (LEFT + window.width + RIGHT, TOP + window.height + BOTTOM);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#444\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fdfdfb\"/>\n"
    );
    axes(&mut svg, &window);
    paths(&mut svg, &window, &flight.traces);
    marks(&mut svg, &window, &flight.traces);
    key(&mut svg, &window, flight);
    svg.push_str("</svg>\n");
    svg
}

/// Grid lines with their metres.
fn axes(svg: &mut String, window: &Window) {
    let (right, bottom) = (LEFT + window.width, TOP + window.height);
    let [width, height] = [window.width, window.height].map(|p| p / window.pixels_per_metre);
    let step = round_step(width.max(height) / 8.0);
    for east in multiples(step, window.west, window.west + width) {
        let x = window.x(east);
        line(svg, [x, TOP, x, bottom], east == 0.0);
        text(svg, [x, bottom + 20.0], "middle", &format!("{east}"));
    }
    for north in multiples(step, window.north - height, window.north) {
        let y = window.y(north);
        line(svg, [LEFT, y, right, y], north == 0.0);
        text(svg, [LEFT - 8.0, y + 4.5], "end", &format!("{north}"));
    }
    text(
        svg,
        [LEFT + 0.5 * window.width, bottom + 42.0],
        "middle",
        "east (m)",
    );
    let _ = writeln!(
        svg,
        "<text transform=\"translate(18 {:.1}) rotate(-90)\" text-anchor=\"middle\">north (m)</text>",
        TOP + 0.5 * window.height
    );
}

/// The multiples of `step` between two numbers.
fn multiples(step: f64, from: f64, to: f64) -> impl Iterator<Item = f64> {
    let (first, last) = ((from / step).ceil() as i64, (to / step).floor() as i64);
    (first..=last).map(move |n| n as f64 * step)
}

/// The next of 1, 2, 5, 10, 20, ... that is not below `least`.
fn round_step(least: f64) -> f64 {
    let ten = math::pow(10.0, math::log10(least).floor());
    [1.0, 2.0, 5.0, 10.0]
        .map(|n| n * ten)
        .into_iter()
        .find(|n| *n >= least)
        .unwrap_or(ten)
}

/// All traces, band by band, so that what is higher lies on top, as it does from above. Points are
/// tenths of a pixel, each relative to the one before.
fn paths(svg: &mut String, window: &Window, traces: &[Trace]) {
    let mut bands = vec![String::new(); window.bands];
    for trace in traces.iter().filter(|t| !t.stands()) {
        let tenths =
            |p: [f64; 3]| [window.x(p[0]), window.y(p[1])].map(|x| (10.0 * x).round() as i64);
        let mut open = None;
        for step in trace.points.windows(2) {
            let (from, to) = (tenths(step[0]), tenths(step[1]));
            let band = window.band(step[0][2]);
            if open.replace(band) != Some(band) {
                let _ = write!(bands[band], "M{} {}l", from[0], from[1]);
            }
            let _ = write!(bands[band], "{} {} ", to[0] - from[0], to[1] - from[1]);
        }
    }
    svg.push_str(
        "<g transform=\"scale(.1)\" fill=\"none\" stroke-width=\"12\" stroke-opacity=\".75\" \
         stroke-linejoin=\"round\">\n",
    );
    for (band, path) in bands.iter().enumerate() {
        let (path, colour) = (
            path.replace(" -", "-").replace(" M", "M"),
            window.colour(band),
        );
        let _ = writeln!(svg, "<path stroke=\"{colour}\" d=\"{}\"/>", path.trim_end());
    }
    svg.push_str("</g>\n");
}

/// A ring where each trace starts, a dot where it ends, a square where something stands.
fn marks(svg: &mut String, window: &Window, traces: &[Trace]) {
    let place = |point: [f64; 3]| (window.x(point[0]), window.y(point[1]));
    let (standing, moving): (Vec<&Trace>, Vec<&Trace>) = traces.iter().partition(|t| t.stands());
    for point in moving.iter().filter_map(|t| t.points.first()) {
        let (x, y) = place(*point);
        ring(svg, x, y);
    }
    for point in moving.iter().filter_map(|t| t.points.last()) {
        let (x, y) = place(*point);
        dot(svg, x, y, window.colour(window.band(point[2])));
    }
    for point in standing.iter().filter_map(|t| t.points.first()) {
        let (x, y) = place(*point);
        square(svg, x, y);
    }
}

/// The colours and their heights; below them, what the marks mean.
fn key(svg: &mut String, window: &Window, flight: &Flight) {
    let (x, size) = (LEFT + window.width + 24.0, 26.0);
    let bottom = TOP + window.bands as f64 * size + 24.0;
    text(svg, [x, TOP + 10.0], "start", "height (m)");
    for band in 0..window.bands {
        let (y, colour) = (bottom - (band + 1) as f64 * size, window.colour(band));
        let _ = writeln!(
            svg,
            "<rect x=\"{x}\" y=\"{y}\" width=\"14\" height=\"{size}\" fill=\"{colour}\"/>"
        );
    }
    for n in 0..=window.bands {
        let up = window.low + window.band * n as f64;
        text(
            svg,
            [x + 20.0, bottom - n as f64 * size + 4.5],
            "start",
            &format!("{up}"),
        );
    }

    let (x, y) = (x + 7.0, bottom + 40.0);
    ring(svg, x, y);
    text(svg, [x + 13.0, y + 4.5], "start", "start");
    dot(svg, x, y + 24.0, window.colour(window.bands / 2));
    text(
        svg,
        [x + 13.0, y + 28.5],
        "start",
        &format!("after {} s", flight.seconds),
    );
    if let Some(standing) = flight.traces.iter().find(|t| t.stands()) {
        square(svg, x, y + 48.0);
        text(svg, [x + 13.0, y + 52.5], "start", &standing.model);
    }
}

fn line(svg: &mut String, [x1, y1, x2, y2]: [f64; 4], strong: bool) {
    let colour = if strong { "#c9c9c4" } else { "#e9e9e4" };
    let _ = writeln!(
        svg,
        "<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" stroke=\"{colour}\"/>"
    );
}

fn text(svg: &mut String, [x, y]: [f64; 2], anchor: &str, words: &str) {
    let _ = writeln!(
        svg,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>"
    );
}

fn ring(svg: &mut String, x: f64, y: f64) {
    let _ = writeln!(
        svg,
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.4\" fill=\"#fdfdfb\" stroke=\"#8a8a85\"/>"
    );
}

fn dot(svg: &mut String, x: f64, y: f64, colour: &str) {
    let _ = writeln!(
        svg,
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{colour}\" stroke=\"#fdfdfb\"/>"
    );
}

fn square(svg: &mut String, x: f64, y: f64) {
    let _ = writeln!(
        svg,
        "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"11\" height=\"11\" fill=\"#e0a100\" \
         stroke=\"#fdfdfb\" stroke-width=\"1.5\"/>",
        x - 5.5,
        y - 5.5
    );
}

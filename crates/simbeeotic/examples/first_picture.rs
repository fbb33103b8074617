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
    let setup = loaded.setup().map_err(|faults| render::faults(&faults, loaded.sources(), false))?;
    let mut run = Simulation::new(setup)?;

    let paths: Vec<String> = run.population().iter().map(|(_, m)| m.path.clone()).collect();
    let mut traces: Vec<Trace> = paths.iter().map(|_| Trace { points: Vec::new() }).collect();
    let end = run.end();
    for step in 0..=end.nanos() / STEP.nanos() {
        run.run_until(SimTime::from_nanos(step * STEP.nanos()))?;
        for (path, trace) in paths.iter().zip(&mut traces) {
            trace.points.extend(run.pose(path).map(|pose| pose.position.si().to_array()));
        }
    }
    traces.retain(|trace| !trace.points.is_empty());
    Ok(Flight { traces, seconds: end.as_secs_f64() })
}

/// Edge of the square that the flight is drawn in, and what is left free around it, in pixels.
const EDGE: f64 = 720.0;
const LEFT: f64 = 62.0;
const TOP: f64 = 24.0;
const RIGHT: f64 = 104.0;
const BOTTOM: f64 = 56.0;

/// Colours by height, from the lowest band to the highest.
const BANDS: [&str; 8] = [
    "#b3c98f", "#86bd90", "#5ea98f", "#3f938e", "#2a7c8b", "#206484", "#254b7b", "#2c3172",
];

/// What is shown of the world: a square on the ground, and a range of heights.
struct Window {
    west: f64,
    north: f64,
    metres: f64,
    low: f64,
    high: f64,
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
        let metres = (high[0] - low[0]).max(high[1] - low[1]).max(1.0) * 1.04;
        Self {
            west: 0.5 * (low[0] + high[0] - metres),
            north: 0.5 * (low[1] + high[1] + metres),
            metres,
            low: low[2],
            high: high[2].max(low[2] + 0.1),
        }
    }

    fn x(&self, east: f64) -> f64 {
        LEFT + (east - self.west) / self.metres * EDGE
    }

    fn y(&self, north: f64) -> f64 {
        TOP + (self.north - north) / self.metres * EDGE
    }

    fn band(&self, up: f64) -> usize {
        let share = (up - self.low) / (self.high - self.low);
        ((share * BANDS.len() as f64) as usize).min(BANDS.len() - 1)
    }
}

/// The flight as the text of an SVG file.
fn draw(flight: &Flight) -> String {
    let window = Window::around(&flight.traces);
    let (width, height) = (LEFT + EDGE + RIGHT, TOP + EDGE + BOTTOM);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#444\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fdfdfb\"/>\n"
    );
    axes(&mut svg, &window);
    paths(&mut svg, &window, &flight.traces);
    marks(&mut svg, &window, &flight.traces);
    scale(&mut svg, &window);
    legend(&mut svg, flight);
    svg.push_str("</svg>\n");
    svg
}

/// Grid lines with their metres.
fn axes(svg: &mut String, window: &Window) {
    let step = round_step(window.metres / 6.0);
    let (right, bottom) = (LEFT + EDGE, TOP + EDGE);
    for n in (window.west / step).ceil() as i64..=((window.west + window.metres) / step) as i64 {
        let (x, metres) = (window.x(n as f64 * step), n as f64 * step);
        line(svg, [x, TOP, x, bottom], n == 0);
        text(svg, [x, bottom + 20.0], "middle", &format!("{metres}"));
    }
    let south = window.north - window.metres;
    for n in (south / step).ceil() as i64..=(window.north / step).floor() as i64 {
        let (y, metres) = (window.y(n as f64 * step), n as f64 * step);
        line(svg, [LEFT, y, right, y], n == 0);
        text(svg, [LEFT - 8.0, y + 4.5], "end", &format!("{metres}"));
    }
    text(svg, [LEFT + 0.5 * EDGE, bottom + 42.0], "middle", "east (m)");
    let _ = writeln!(
        svg,
        "<text transform=\"translate(18 {:.1}) rotate(-90)\" text-anchor=\"middle\">north (m)</text>",
        TOP + 0.5 * EDGE
    );
}

/// The next of 1, 2, 5, 10, 20, ... that is not below `least`.
fn round_step(least: f64) -> f64 {
    let ten = 10_f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|n| n * ten).into_iter().find(|n| *n >= least).unwrap_or(ten)
}

/// All traces, band by band, so that what is higher lies on top, as it does from above. Points are
/// tenths of a pixel, each relative to the one before.
fn paths(svg: &mut String, window: &Window, traces: &[Trace]) {
    let mut bands = vec![String::new(); BANDS.len()];
    for trace in traces.iter().filter(|t| !t.stands()) {
        let mut from: Option<([i64; 2], usize)> = None;
        for point in &trace.points {
            let at = [window.x(point[0]), window.y(point[1])].map(|p| (10.0 * p).round() as i64);
            let band = window.band(point[2]);
            if let Some((last, path)) = from {
                let [dx, dy] = [at[0] - last[0], at[1] - last[1]];
                let _ = write!(bands[path], "{dx} {dy} ");
            }
            if from.is_none_or(|(_, before)| before != band) {
                let _ = write!(bands[band], "M{} {}l", at[0], at[1]);
            }
            from = Some((at, band));
        }
    }
    svg.push_str(
        "<g transform=\"scale(.1)\" fill=\"none\" stroke-width=\"12\" stroke-opacity=\".75\" \
         stroke-linejoin=\"round\">\n",
    );
    for (path, colour) in bands.iter().zip(BANDS) {
        let path = path.replace(" -", "-").replace(" M", "M");
        let _ = writeln!(svg, "<path stroke=\"{colour}\" d=\"{}\"/>", path.trim_end());
    }
    svg.push_str("</g>\n");
}

/// A ring where each trace starts, a dot where it ends, a square where something stands.
fn marks(svg: &mut String, window: &Window, traces: &[Trace]) {
    for trace in traces {
        let (Some(first), Some(last)) = (trace.points.first(), trace.points.last()) else { continue };
        let [x, y, u, v] =
            [window.x(first[0]), window.y(first[1]), window.x(last[0]), window.y(last[1])];
        if trace.stands() {
            square(svg, x, y);
        } else {
            ring(svg, x, y);
            dot(svg, u, v, BANDS[window.band(last[2])]);
        }
    }
}

/// The colours and their heights.
fn scale(svg: &mut String, window: &Window) {
    let (x, size) = (LEFT + EDGE + 26.0, 26.0);
    let bottom = TOP + 8.0 * size + 24.0;
    text(svg, [x, TOP + 10.0], "start", "height (m)");
    for (n, colour) in BANDS.iter().enumerate() {
        let y = bottom - (n + 1) as f64 * size;
        let _ = writeln!(
            svg,
            "<rect x=\"{x}\" y=\"{y}\" width=\"14\" height=\"{size}\" fill=\"{colour}\"/>"
        );
    }
    for n in (0..=BANDS.len()).step_by(2) {
        let up = window.low + (window.high - window.low) * n as f64 / BANDS.len() as f64;
        text(svg, [x + 20.0, bottom - n as f64 * size + 4.5], "start", &format!("{up:.0}"));
    }
}

/// What the marks mean.
fn legend(svg: &mut String, flight: &Flight) {
    let (x, y) = (LEFT + EDGE + 32.0, TOP + 280.0);
    ring(svg, x, y);
    text(svg, [x + 14.0, y + 4.5], "start", "start");
    dot(svg, x, y + 24.0, BANDS[4]);
    text(svg, [x + 14.0, y + 28.5], "start", &format!("{} s later", flight.seconds));
    if flight.traces.iter().any(Trace::stands) {
        square(svg, x, y + 48.0);
        text(svg, [x + 14.0, y + 52.5], "start", "hive");
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
    let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>");
}

fn ring(svg: &mut String, x: f64, y: f64) {
    let _ = writeln!(
        svg,
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.6\" fill=\"#fdfdfb\" stroke=\"#777\"/>"
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

//! Draws what models of propagation make of distance: the picture of the book's page on them, as an SVG file.
//!
//! ```text
//! cargo run --release -p simbeeotic --example propagation_picture
//! ```

use simbeeotic::kernel::{SimTime, rng::mix};
use simbeeotic::radio::{
    Composite, End, FreeSpace, Link, LogDistance, Propagation, Rician, Shadowing, TwoRay,
    TwoRayExact,
};
use simbeeotic::units::{Decibels, Frequency, Length, Position, math};
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

/// Size of a panel, and the room around it.
const PANEL: [f64; 2] = [420.0, 330.0];
const LEFT: f64 = 62.0;
const TOP: f64 = 40.0;
/// Losses at the upper and the lower edge.
const LOSS_DB: [f64; 2] = [30.0, 130.0];

fn main() -> Result<(), Box<dyn Error>> {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    std::fs::write(repository.join("docs/images/propagation.svg"), draw())?;
    Ok(())
}

/// A link from the origin to a place so far east, both 2 m up.
fn link(east_m: f64, frame: u64) -> Link {
    let end = |east_m, key| End {
        position: Position::from_xyz(east_m, 0.0, 2.0),
        key,
    };
    Link {
        tx: end(0.0, mix(1)),
        rx: end(east_m, mix(2)),
        distance_m: east_m,
        frequency: Frequency::from_megahertz(2405.0),
        frame: mix(frame),
        time: SimTime::ZERO,
    }
}

fn draw() -> String {
    let width = 2.0 * (LEFT + PANEL[0]) + 30.0;
    let height = TOP + PANEL[1] + 48.0;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#444\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fdfdfb\"/>\n"
    );
    paths(&mut svg);
    flight(&mut svg);
    svg.push_str("</svg>\n");
    svg
}

/// One panel: where it begins, and where a distance lies in it, from 0 to 1.
struct Panel<F: Fn(f64) -> f64> {
    left: f64,
    place: F,
}

impl<F: Fn(f64) -> f64> Panel<F> {
    fn point(&self, distance_m: f64, loss_db: f64) -> (f64, f64) {
        let share = (loss_db - LOSS_DB[0]) / (LOSS_DB[1] - LOSS_DB[0]);
        let x = self.left + PANEL[0] * (self.place)(distance_m);
        (x, TOP + PANEL[1] * share.clamp(0.0, 1.0))
    }

    fn axes(&self, svg: &mut String, title: &str, distances_m: &[f64]) {
        let (right, bottom) = (self.left + PANEL[0], TOP + PANEL[1]);
        let mut text = |x: f64, y: f64, anchor: &str, words: &str| {
            let _ = writeln!(
                svg,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>"
            );
        };
        text(self.left, TOP - 14.0, "start", title);
        text(right, bottom + 36.0, "end", "distance, m");
        let mut lines = String::new();
        for step in 0..=5 {
            let loss_db = LOSS_DB[0] + 20.0 * f64::from(step);
            let (_, y) = self.point(distances_m[0], loss_db);
            text(self.left - 8.0, y + 4.0, "end", &format!("{loss_db:.0} dB"));
            let _ = writeln!(
                lines,
                "<path d=\"M{:.1} {y:.1}H{right:.1}\" stroke=\"#e4e4de\"/>",
                self.left
            );
        }
        for &distance_m in distances_m {
            let (x, _) = self.point(distance_m, 0.0);
            text(x, bottom + 18.0, "middle", &format!("{distance_m:.0}"));
            let _ = writeln!(
                lines,
                "<path d=\"M{x:.1} {TOP:.1}V{bottom:.1}\" stroke=\"#e4e4de\"/>"
            );
        }
        svg.push_str(&lines);
    }

    fn curve(
        &self,
        svg: &mut String,
        colour: &str,
        width: f64,
        points: impl Iterator<Item = (f64, f64)>,
    ) {
        let mut path = String::new();
        for (i, (distance_m, loss_db)) in points.enumerate() {
            let (x, y) = self.point(distance_m, loss_db);
            let _ = write!(path, "{}{x:.1} {y:.1}", if i == 0 { "M" } else { "L" });
        }
        let _ = writeln!(
            svg,
            "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"/>"
        );
    }

    /// A line of the legend, from the lower left corner up.
    fn legend(&self, svg: &mut String, row: u32, colour: &str, words: &str) {
        let (x, y) = (
            self.left + 14.0,
            TOP + PANEL[1] - 16.0 - 18.0 * f64::from(row),
        );
        let _ = writeln!(
            svg,
            "<path d=\"M{x:.1} {:.1}h22\" stroke=\"{colour}\" stroke-width=\"2.5\"/>\n\
             <text x=\"{:.1}\" y=\"{y:.1}\">{words}</text>",
            y - 4.0,
            x + 29.0
        );
    }
}

/// Loss over distance, all models.
fn paths(svg: &mut String) {
    let panel = Panel {
        left: LEFT,
        place: |distance_m: f64| math::log10(distance_m) / 3.0,
    };
    panel.axes(
        svg,
        "Path loss at 2405 MHz, both antennas 2 m up",
        &[1.0, 10.0, 100.0, 1000.0],
    );
    let models: [(&str, &str, Box<dyn Propagation>); 4] = [
        (
            "two-ray-exact, medium-dry ground",
            "#b9c4cf",
            Box::new(TwoRayExact::default()),
        ),
        (
            "log-distance, exponent 3",
            "#c4572e",
            Box::new(LogDistance::default()),
        ),
        ("two-ray", "#3c7a4a", Box::new(TwoRay::default())),
        ("free-space", "#2b5d9b", Box::new(FreeSpace)),
    ];
    for (row, (name, colour, model)) in (0..).zip(&models) {
        let points = (0..=3000).map(|i| {
            let distance_m = math::pow(10.0, f64::from(i) * 1e-3);
            (distance_m, model.loss(&link(distance_m, 0)).db())
        });
        panel.curve(svg, colour, if row == 0 { 1.4 } else { 2.2 }, points);
        panel.legend(svg, row, colour, name);
    }
}

/// What one receiver that flies away meets.
fn flight(svg: &mut String) {
    let panel = Panel {
        left: 2.0 * LEFT + PANEL[0] + 14.0,
        place: |distance_m: f64| distance_m / 200.0,
    };
    panel.axes(
        svg,
        "One flight away from a sender, a frame each 20 cm",
        &[0.0, 50.0, 100.0, 150.0, 200.0],
    );
    let composite = |faded: bool| Composite {
        path: Arc::new(LogDistance::default()),
        shadowing: Some(Shadowing::field(
            4,
            Decibels::from_db(6.0),
            Length::from_metres(20.0),
        )),
        fading: faded.then(|| Arc::new(Rician::new(Decibels::from_db(6.0))) as _),
    };
    let models: [(&str, &str, Box<dyn Propagation>); 3] = [
        (
            "with Rician fading, K 6 dB, besides",
            "#c9c3b4",
            Box::new(composite(true)),
        ),
        (
            "with shadowing, 6 dB, 20 m",
            "#8c5a2b",
            Box::new(composite(false)),
        ),
        (
            "log-distance, exponent 3",
            "#c4572e",
            Box::new(LogDistance::default()),
        ),
    ];
    for (row, (name, colour, model)) in (0..).zip(&models) {
        let points = (5..=1000u32).map(|i| {
            let distance_m = f64::from(i) * 0.2;
            (distance_m, model.loss(&link(distance_m, i.into())).db())
        });
        panel.curve(svg, colour, if row == 0 { 1.0 } else { 2.2 }, points);
        panel.legend(svg, row, colour, name);
    }
}

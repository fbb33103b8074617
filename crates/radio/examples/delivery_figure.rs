//! Draws how many broadcasts get through when everybody in a swarm speaks once a second: by the medium
//! `simple`, by `ieee802154`, and by the real ns-3. A picture of the book, as an SVG file.
//!
//! ```text
//! cargo run --release -p simbeeotic-radio --example delivery_figure
//! ```
//! ns-3's share is read from the table that `compare/ns3` has made; ours is run anew, on other random
//! topologies of the same kind: nodes uniform in a ball of radius 20 m, 20 bytes each. The mediums are
//! driven by themselves, without vehicles.

use simbeeotic_kernel::rng::{Stream, path_key};
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{
    Ieee802154Config, Ieee802154Medium, LogDistance, Medium, RadioSpec, SimpleConfig, SimpleMedium,
    cc2420, drive,
};
use simbeeotic_units::{Length, Position, math};
use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

fn main() -> Result<(), Box<dyn Error>> {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let table = repository.join("crates/radio/tests/ns3/topologies/results.csv");
    let table = std::fs::read_to_string(table)?;
    let mut lines = Vec::new();
    for (synchronous, phases, colour) in [
        (false, "random phases", "#206484"),
        (true, "synchronous", "#c0532b"),
    ] {
        lines.push(Line {
            label: format!("ieee802154, {phases}"),
            colour,
            dashed: false,
            points: sweep(synchronous, || Box::new(ieee802154()))?,
            dots: ns3(&table, if synchronous { "synchronous" } else { "random" }),
        });
    }
    lines.push(Line {
        label: "simple, whatever the phases".to_owned(),
        colour: "#6f9a4d",
        dashed: true,
        points: sweep(true, || Box::new(simple()))?,
        dots: Vec::new(),
    });
    let picture = repository.join("docs/images/delivery.svg");
    std::fs::write(picture, draw(&lines))?;
    Ok(())
}

/// One medium: its curve by the number of nodes, and ns-3's points if it has any.
struct Line {
    label: String,
    colour: &'static str,
    dashed: bool,
    points: Vec<[f64; 2]>,
    dots: Vec<[f64; 2]>,
}

/// The medium with air time, with the radio and the loss that ns-3 has.
fn ieee802154() -> Ieee802154Medium {
    Ieee802154Medium::new(Ieee802154Config {
        propagation: Arc::new(LogDistance::ns3()),
        queue_frames: Some(usize::MAX),
        ..Ieee802154Config::ns3()
    })
    .expect("settings that make sense")
}

/// The paper's medium with the same loss, and all in reach.
fn simple() -> SimpleMedium {
    SimpleMedium::new(SimpleConfig {
        propagation: Arc::new(LogDistance::ns3()),
        range_limit: Length::from_metres(50.0),
        ..SimpleConfig::default()
    })
    .expect("settings that make sense")
}

/// Numbers of nodes, and for how many seconds each is run: the fewer, the longer.
const SIZES: [(u32, u64); 12] = [
    (2, 2_000),
    (5, 1_000),
    (10, 500),
    (20, 300),
    (35, 200),
    (50, 150),
    (100, 80),
    (200, 40),
    (350, 20),
    (500, 20),
    (1_000, 10),
    (2_000, 5),
];

fn sweep(
    synchronous: bool,
    mut medium: impl FnMut() -> Box<dyn Medium>,
) -> Result<Vec<[f64; 2]>, Box<dyn Error>> {
    let mut points = Vec::new();
    for (n, seconds) in SIZES {
        let mut sum = 0.0;
        for topology in 1..=3 {
            sum += delivered(medium().as_mut(), n, seconds, synchronous, topology)?;
        }
        points.push([f64::from(n), sum / 3.0]);
    }
    Ok(points)
}

/// Lets `n` nodes broadcast 20 bytes a second: receptions over transmissions and others.
fn delivered(
    medium: &mut dyn Medium,
    n: u32,
    seconds: u64,
    synchronous: bool,
    topology: u64,
) -> Result<f64, Box<dyn Error>> {
    let mut chance = Stream::new(topology, "delivery", "topology");
    let (mut places, mut phases_ns) = (Vec::new(), Vec::new());
    for node in 0..n {
        let key = path_key(&format!("topology-{topology}/node-{node}/radio"));
        let owner = ModelId(node);
        let spec = cc2420::spec(11, 31).ok_or("there is no channel 11")?;
        medium.add(RadioSpec { owner, key, ..spec })?;
        places.push(Position::from_si(chance.in_ball(20.0)));
        let phase_ns = (chance.uniform_in(0.0..1.0) * 1e9) as u64;
        phases_ns.push(if synchronous { 0 } else { phase_ns });
    }
    let requests = drive::each_second(&phases_ns, Arc::from([0; 20]), SimTime::from_secs(seconds));
    let received = drive::drive(medium, &drive::Still::at(places), requests);
    let sent = medium.totals().sent as f64;
    Ok(received as f64 / (sent * f64::from(n - 1)))
}

/// What ns-3 delivers of 20 bytes in balls: the mean of its runs by the number of nodes.
fn ns3(table: &str, phases: &str) -> Vec<[f64; 2]> {
    let mut sums = BTreeMap::<u32, [f64; 2]>::new();
    for line in table.lines().filter(|line| line.starts_with("ball-")) {
        let cells: Vec<&str> = line.split(',').collect();
        let [_, n, "20", of, _, _, _, _, _, _, _, ratio, _] = cells[..] else {
            continue;
        };
        if let (true, Ok(n), Ok(ratio)) = (of == phases, n.parse(), ratio.parse::<f64>()) {
            let sum = sums.entry(n).or_default();
            *sum = [sum[0] + ratio, sum[1] + 1.0];
        }
    }
    let means = sums.into_iter();
    means
        .map(|(n, [sum, runs])| [n.into(), sum / runs])
        .collect()
}

const LEFT: f64 = 66.0;
const TOP: f64 = 22.0;
const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 330.0;
const RIGHT: f64 = 24.0;
const BOTTOM: f64 = 128.0;

fn x(n: f64) -> f64 {
    LEFT + WIDTH * math::log10(n / 2.0) / 3.0
}

fn y(ratio: f64) -> f64 {
    TOP + HEIGHT * (1.0 - ratio)
}

/// The figure as the text of an SVG file.
fn draw(lines: &[Line]) -> String {
    let (width, height) = (LEFT + WIDTH + RIGHT, TOP + HEIGHT + BOTTOM);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#444\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fdfdfb\"/>\n"
    );
    axes(&mut svg);
    for line in lines {
        let place = |&[n, ratio]: &[f64; 2]| format!("{:.1} {:.1}", x(n), y(ratio));
        let path: Vec<String> = line.points.iter().map(place).collect();
        let dash = if line.dashed {
            " stroke-dasharray=\"7 4\""
        } else {
            ""
        };
        let _ = writeln!(
            svg,
            "<path fill=\"none\" stroke-width=\"2\" stroke=\"{}\"{dash} d=\"M{}\"/>",
            line.colour,
            path.join("L")
        );
    }
    for line in lines {
        line.dots
            .iter()
            .for_each(|&[n, ratio]| dot(&mut svg, [x(n), y(ratio)], line.colour));
    }
    key(&mut svg, lines);
    svg.push_str("</svg>\n");
    svg
}

fn axes(svg: &mut String) {
    let (right, bottom) = (LEFT + WIDTH, TOP + HEIGHT);
    for n in [2, 5, 10, 20, 50, 100, 200, 500, 1_000, 2_000] {
        let x = x(n.into());
        rule(svg, [x, TOP, x, bottom]);
        text(svg, [x, bottom + 20.0], "middle", &n.to_string());
    }
    for fifth in 0..=5 {
        let ratio = f64::from(fifth) / 5.0;
        rule(svg, [LEFT, y(ratio), right, y(ratio)]);
        text(
            svg,
            [LEFT - 8.0, y(ratio) + 4.5],
            "end",
            &format!("{ratio:.1}"),
        );
    }
    let middle = LEFT + 0.5 * WIDTH;
    text(
        svg,
        [middle, bottom + 42.0],
        "middle",
        "nodes that each broadcast 20 bytes a second, in a ball of 20 m",
    );
    let _ = writeln!(
        svg,
        "<text transform=\"translate(20 {:.1}) rotate(-90)\" text-anchor=\"middle\">share of receptions \
         that succeed</text>",
        TOP + 0.5 * HEIGHT
    );
}

fn key(svg: &mut String, lines: &[Line]) {
    let mut at = TOP + HEIGHT + 66.0;
    let (left, right) = (LEFT + 4.0, LEFT + 300.0);
    for line in lines {
        let dash = if line.dashed {
            " stroke-dasharray=\"7 4\""
        } else {
            ""
        };
        let _ = writeln!(
            svg,
            "<path stroke-width=\"2\" stroke=\"{}\"{dash} d=\"M{left} {at}h30\"/>",
            line.colour
        );
        text(svg, [left + 38.0, at + 4.5], "start", &line.label);
        if !line.dots.is_empty() {
            dot(svg, [right, at], line.colour);
            text(
                svg,
                [right + 14.0, at + 4.5],
                "start",
                "ns-3 3.37, the same",
            );
        }
        at += 22.0;
    }
}

fn rule(svg: &mut String, [x1, y1, x2, y2]: [f64; 4]) {
    let _ = writeln!(
        svg,
        "<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" stroke=\"#e4e4df\"/>"
    );
}

fn text(svg: &mut String, [x, y]: [f64; 2], anchor: &str, words: &str) {
    let _ = writeln!(
        svg,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>"
    );
}

fn dot(svg: &mut String, [x, y]: [f64; 2], colour: &str) {
    let _ = writeln!(
        svg,
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.2\" fill=\"{colour}\" stroke=\"#fdfdfb\"/>"
    );
}

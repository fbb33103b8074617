//! Draws the antennas' patterns: the picture of the book's page on radio hardware, as an SVG file.
//!
//! ```text
//! cargo run -p simbeeotic-radio --example antenna_pictures
//! ```
//! Each is drawn in its two planes: full line, from the left side (boresight to the right, z up); dashed, from
//! above (boresight to the right, left side up).

use glam::DVec3;
use simbeeotic_radio::{Antenna, Cosine, HalfWaveDipole, Patch, ShortDipole};
use simbeeotic_units::{Angle, Decibels, math};
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

/// Gains at the centre and at the outer ring, dBi.
const SHOWN_DBI: [f64; 2] = [-30.0, 10.0];
/// The outer ring, and what is around it, pixels.
const RADIUS: f64 = 105.0;
const CELL: [f64; 2] = [250.0, 292.0];
const INK: &str = "#2b2b2b";
const SIDE: &str = "#2a7c8b";
const ABOVE: &str = "#a04a2c";

fn main() -> Result<(), Box<dyn Error>> {
    let degrees = Angle::from_degrees;
    let antennas: [(&str, &str, Box<dyn Antenna>); 4] = [
        (
            "short-dipole",
            "1.76 dBi; a chip antenna, about",
            Box::new(ShortDipole::default()),
        ),
        (
            "half-wave-dipole",
            "2.15 dBi; a rod along z",
            Box::new(HalfWaveDipole::default()),
        ),
        (
            "patch",
            "90 by 80 deg, 15 dB to the back",
            Box::new(Patch::default()),
        ),
        (
            "cosine",
            "120 by 60 deg",
            Box::new(Cosine::new(degrees(120.0), degrees(60.0), Decibels::ZERO)?),
        ),
    ];
    let (width, height) = (CELL[0] * antennas.len() as f64, CELL[1] + 26.0);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fffdf8\"/>\n"
    );
    for (at, (name, words, antenna)) in antennas.iter().enumerate() {
        let centre = [CELL[0] * (at as f64 + 0.5), 20.0 + RADIUS];
        rings(&mut svg, centre)?;
        let side = |angle: f64| {
            let (sin, cos) = math::sin_cos(angle);
            DVec3::new(cos, 0.0, sin)
        };
        let above = |angle: f64| {
            let (sin, cos) = math::sin_cos(angle);
            DVec3::new(cos, sin, 0.0)
        };
        curve(&mut svg, centre, antenna.as_ref(), &above, ABOVE, "6 4")?;
        curve(&mut svg, centre, antenna.as_ref(), &side, SIDE, "none")?;
        let [x, y] = [centre[0], centre[1] + RADIUS + 26.0];
        writeln!(
            svg,
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\" font-size=\"14\" fill=\"{INK}\" \
             font-family=\"monospace\">{name}</text>\n\
             <text x=\"{x}\" y=\"{}\" text-anchor=\"middle\" fill=\"{INK}\">{words}</text>",
            y + 18.0
        )?;
    }
    legend(&mut svg, width, height)?;
    svg += "</svg>\n";
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    std::fs::write(repository.join("docs/images/antennas.svg"), svg)?;
    Ok(())
}

/// How far from the centre a gain is drawn.
fn radius(dbi: f64) -> f64 {
    let [least, most] = SHOWN_DBI;
    RADIUS * ((dbi - least) / (most - least)).clamp(0.0, 1.0)
}

/// Circles at every 10 dB, with their gains, and the axes.
fn rings(svg: &mut String, [x, y]: [f64; 2]) -> std::fmt::Result {
    for dbi in [-20.0, -10.0, 0.0, 10.0] {
        let r = radius(dbi);
        writeln!(
            svg,
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r:.1}\" fill=\"none\" stroke=\"#d8d2c4\"/>\n\
             <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"10\" fill=\"#8a8474\">{dbi}</text>",
            x + 0.71 * r + 2.0,
            y + 0.71 * r + 9.0,
        )?;
    }
    writeln!(
        svg,
        "<path d=\"M{} {y}H{}M{x} {}V{}\" stroke=\"#d8d2c4\"/>",
        x - RADIUS,
        x + RADIUS,
        y - RADIUS,
        y + RADIUS
    )
}

/// The gain all round one plane.
fn curve(
    svg: &mut String,
    [x, y]: [f64; 2],
    antenna: &dyn Antenna,
    direction: &dyn Fn(f64) -> DVec3,
    colour: &str,
    dashes: &str,
) -> std::fmt::Result {
    write!(svg, "<path d=\"")?;
    for degree in 0..360 {
        let angle = f64::from(degree).to_radians();
        let r = radius(antenna.gain(direction(angle)).db());
        let (sin, cos) = math::sin_cos(angle);
        let letter = if degree == 0 { 'M' } else { 'L' };
        write!(svg, "{letter}{:.1} {:.1}", x + r * cos, y - r * sin)?;
    }
    writeln!(
        svg,
        "Z\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\" stroke-dasharray=\"{dashes}\"/>"
    )
}

fn legend(svg: &mut String, width: f64, height: f64) -> std::fmt::Result {
    let y = height - 16.0;
    for (x, colour, dashes, words) in [
        (
            0.10 * width,
            SIDE,
            "none",
            "from the side: boresight to the right, z up",
        ),
        (
            0.52 * width,
            ABOVE,
            "6 4",
            "from above: boresight to the right; rings in dBi",
        ),
    ] {
        writeln!(
            svg,
            "<path d=\"M{x} {y}h34\" stroke=\"{colour}\" stroke-width=\"1.8\" stroke-dasharray=\"{dashes}\"/>\n\
             <text x=\"{}\" y=\"{}\" fill=\"{INK}\">{words}</text>",
            x + 42.0,
            y + 4.0
        )?;
    }
    Ok(())
}

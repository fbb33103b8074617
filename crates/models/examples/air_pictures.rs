//! Draws the pictures of the book's page on weather, as SVG files: a turbulent wind, and a plume.
//!
//! ```text
//! cargo run --release -p simbeeotic-models --example air_pictures -- docs/images
//! ```

use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::units::{Heading, Length, MassRate, Position, Speed, Time};
use simbeeotic_model::world::{Gases, Puffs, ScalarField, Source, Stability, Weather, World};
use simbeeotic_model::{FromParams, Site};
use simbeeotic_models::weather::atmosphere::{Atmosphere, AtmosphereParams};
use simbeeotic_models::weather::dryden::{TurbulenceParams, TurbulenceScale};
use simbeeotic_models::weather::grid::{GridParams, Outside};
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

fn main() -> Result<(), Box<dyn Error>> {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folder = std::env::args()
        .nth(1)
        .map_or_else(|| repository.join("docs/images"), Into::into);
    std::fs::write(folder.join("turbulence.svg"), turbulence()?)?;
    std::fs::write(folder.join("plume.svg"), plume(&repository)?)?;
    Ok(())
}

/// The size of a cell of the picture, in its units.
const CELL: f64 = 6.0;
/// Where the map begins: left and top.
const EDGE: (f64, f64) = (46.0, 40.0);

/// A map of cells with a scale beside it.
struct Map {
    svg: String,
    across: usize,
    down: usize,
}

impl Map {
    fn new(title: &str, across: usize, down: usize) -> Self {
        let (width, height) = (
            EDGE.0 + across as f64 * CELL + 96.0,
            EDGE.1 + down as f64 * CELL + 46.0,
        );
        let mut svg = String::new();
        let _ = write!(
            svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n\
             <text x=\"{}\" y=\"24\" font-size=\"14\">{title}</text>\n",
            EDGE.0
        );
        Self { svg, across, down }
    }

    /// Fills the cells by their level, 0 to 15; equal neighbours in a row become one rectangle.
    fn fill(&mut self, colors: &[String; 16], level: impl Fn(usize, usize) -> usize) {
        self.svg.push_str("<g shape-rendering=\"crispEdges\">\n");
        for row in 0..self.down {
            let mut begin = 0;
            while begin < self.across {
                let shade = level(begin, row);
                let mut end = begin + 1;
                while end < self.across && level(end, row) == shade {
                    end += 1;
                }
                let _ = writeln!(
                    self.svg,
                    "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{CELL}\" fill=\"{}\"/>",
                    EDGE.0 + begin as f64 * CELL,
                    EDGE.1 + row as f64 * CELL,
                    (end - begin) as f64 * CELL,
                    colors[shade]
                );
                begin = end;
            }
        }
        self.svg.push_str("</g>\n");
    }

    /// An arrow from a point of the map, in cells; `way` in units of the picture, up is up.
    fn arrow(&mut self, at: (f64, f64), way: (f64, f64)) {
        let (x, y) = (EDGE.0 + at.0 * CELL, EDGE.1 + at.1 * CELL);
        let (dx, dy) = (way.0, -way.1);
        let length = (dx * dx + dy * dy).sqrt().max(1e-9);
        let (ux, uy) = (dx / length, dy / length);
        let (tx, ty) = (x + dx, y + dy);
        let _ = writeln!(
            self.svg,
            "<path d=\"M{x:.1} {y:.1}L{tx:.1} {ty:.1}M{:.1} {:.1}L{tx:.1} {ty:.1}L{:.1} {:.1}\" \
             stroke=\"black\" fill=\"none\"/>",
            tx - 4.0 * ux - 2.5 * uy,
            ty - 4.0 * uy + 2.5 * ux,
            tx - 4.0 * ux + 2.5 * uy,
            ty - 4.0 * uy - 2.5 * ux,
        );
    }

    /// Marks along both axes: texts at cells.
    fn axes(&mut self, x: &[(f64, String)], y: &[(f64, String)], names: (&str, &str)) {
        let bottom = EDGE.1 + self.down as f64 * CELL;
        for (cell, text) in x {
            let at = EDGE.0 + cell * CELL;
            let _ = writeln!(
                self.svg,
                "<text x=\"{at}\" y=\"{}\" text-anchor=\"middle\">{text}</text>",
                bottom + 16.0
            );
        }
        for (cell, text) in y {
            let at = EDGE.1 + cell * CELL + 4.0;
            let _ = writeln!(
                self.svg,
                "<text x=\"{}\" y=\"{at}\" text-anchor=\"end\">{text}</text>",
                EDGE.0 - 6.0
            );
        }
        let _ = writeln!(
            self.svg,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n\
             <text x=\"6\" y=\"{}\">{}</text>",
            EDGE.0 + self.across as f64 * CELL * 0.5,
            bottom + 34.0,
            names.0,
            EDGE.1 - 4.0,
            names.1
        );
    }

    /// The scale: a colour for each level, and texts at shares of its height.
    fn scale(mut self, colors: &[String; 16], marks: &[(f64, String)], name: &str) -> String {
        let (x, height) = (
            EDGE.0 + self.across as f64 * CELL + 16.0,
            self.down as f64 * CELL,
        );
        for (i, color) in colors.iter().enumerate() {
            let y = EDGE.1 + height * (1.0 - (i + 1) as f64 / 16.0);
            let _ = writeln!(
                self.svg,
                "<rect x=\"{x}\" y=\"{y:.1}\" width=\"14\" height=\"{:.1}\" fill=\"{color}\"/>",
                height / 16.0 + 0.3
            );
        }
        for (share, text) in marks {
            let y = EDGE.1 + height * (1.0 - share) + 4.0;
            let _ = writeln!(
                self.svg,
                "<text x=\"{}\" y=\"{y:.1}\">{text}</text>",
                x + 20.0
            );
        }
        let _ = writeln!(
            self.svg,
            "<text x=\"{x}\" y=\"{}\">{name}</text>\n</svg>",
            EDGE.1 - 8.0
        );
        self.svg
    }
}

/// From one colour over white to another, or from white to one.
fn colors(low: [f64; 3], middle: [f64; 3], high: [f64; 3]) -> [String; 16] {
    std::array::from_fn(|i| {
        let share = i as f64 / 15.0 * 2.0;
        let mix = |k: usize| {
            if share < 1.0 {
                low[k] + (middle[k] - low[k]) * share
            } else {
                middle[k] + (high[k] - middle[k]) * (share - 1.0)
            }
        };
        format!(
            "#{:02x}{:02x}{:02x}",
            mix(0) as u8,
            mix(1) as u8,
            mix(2) as u8
        )
    })
}

/// Dryden turbulence by MIL-F-8785C: the vertical wind in colours, that along the picture as arrows.
fn turbulence() -> Result<String, Box<dyn Error>> {
    let weather = Atmosphere::from_params(AtmosphereParams {
        speed: Some(Speed::si(6.0)),
        from: Some(Heading::WEST),
        turbulence: Some(TurbulenceParams {
            scale: TurbulenceScale::LowAltitude {
                wind_at_20ft: Speed::si(7.7),
                height: None,
            },
            modes: 256,
            seed: Some(3),
        }),
        ..AtmosphereParams::default()
    })?;
    let (across, down, metre) = (120, 60, 1.0);
    let wind = |column: f64, row: f64| {
        let at = Position::from_xyz(column * metre, 0.0, (down as f64 - row) * metre);
        weather.wind(at, SimTime::ZERO).si()
    };
    let mut map = Map::new(
        "Turbulence of a light wind (15 knots at 20 ft), less the mean wind",
        across,
        down,
    );
    let colors = colors(
        [33.0, 102.0, 172.0],
        [247.0, 247.0, 247.0],
        [178.0, 24.0, 43.0],
    );
    map.fill(&colors, |column, row| {
        let up = wind(column as f64 + 0.5, row as f64 + 0.5).z;
        ((up / 2.0 * 8.0 + 8.0).clamp(0.0, 15.0)) as usize
    });
    for row in (3..down).step_by(6) {
        for column in (3..across).step_by(6) {
            let (x, y) = (column as f64, row as f64);
            let gust = wind(x, y);
            map.arrow((x, y), (5.0 * (gust.x - 6.0), 5.0 * gust.z));
        }
    }
    let x = [0, 20, 40, 60, 80, 100, 120].map(|m| (f64::from(m), format!("{m} m")));
    let y = [0, 20, 40].map(|m| (60.0 - f64::from(m), format!("{m} m")));
    map.axes(&x, &y, ("along the wind", "height"));
    let scale = [(0.0, "-2 m/s"), (0.5, "0"), (1.0, "2 m/s")].map(|(s, t)| (s, t.to_owned()));
    Ok(map.scale(&colors, &scale, "upwards"))
}

/// The leak of `scenarios/plume.toml` after 70 s: the wind has turned from west to south.
fn plume(repository: &Path) -> Result<String, Box<dyn Error>> {
    let folder = repository.join("scenarios");
    let site = Site {
        seed: 1,
        folder: &folder,
    };
    let params = AtmosphereParams {
        grid: Some(GridParams {
            file: "turning-wind.csv".into(),
            outside: Outside::Hold,
            repeat: false,
        }),
        ..AtmosphereParams::default()
    };
    let weather: Arc<dyn Weather> = Arc::new(Atmosphere::for_run(params, &site)?);
    let world = World {
        sources: vec![Source {
            gas: "methane".into(),
            position: Position::from_xyz(0.0, 0.0, 2.0),
            rate: MassRate::from_grams_per_second(1.0),
            stability: Stability::A,
            puffs: Some(Puffs {
                interval: Time::from_millis(250.0),
                life: Time::from_secs(60.0),
                meander: false,
            }),
            radius: Length::si(0.1),
            ..Source::default()
        }],
        ..World::default()
    };
    let gases = Gases::new(&world, weather);
    let (across, down, metre) = (120, 100, 0.5);
    let time = SimTime::from_secs(70);
    let field = gases.field("methane");
    let place = |column: f64, row: f64| {
        Position::from_xyz((column - 14.0) * metre, (92.0 - row) * metre, 2.0)
    };
    let mut map = Map::new(
        "Methane from a leak of 1 g/s after 70 s, 2 m up, seen from above",
        across,
        down,
    );
    let colors = colors(
        [255.0, 255.0, 255.0],
        [253.0, 174.0, 97.0],
        [128.0, 0.0, 38.0],
    );
    // Four decades, from 0.01 to 100 mg/m^3.
    map.fill(&colors, |column, row| {
        let value = field.value(place(column as f64 + 0.5, row as f64 + 0.5), time);
        let decades = simbeeotic_model::units::math::log10(value.get().max(1e-30) / 1e-8);
        (decades * 4.0).clamp(0.0, 15.0) as usize
    });
    // Which way a climber would go.
    for row in (4..down).step_by(8) {
        for column in (4..across).step_by(8) {
            let at = place(column as f64, row as f64);
            let (value, slope) = field.sample(at, time);
            if value.get() > 1e-8 {
                let way = slope.normalize_or_zero() * 16.0;
                map.arrow((column as f64, row as f64), (way.x, way.y));
            }
        }
    }
    let x = [0, 10, 20, 30, 40, 50].map(|m| (14.0 + f64::from(m) / metre, format!("{m} m")));
    let y = [0, 10, 20, 30, 40].map(|m| (92.0 - f64::from(m) / metre, format!("{m} m")));
    map.axes(&x, &y, ("east", "north"));
    let scale = [
        (0.0, "0.01"),
        (0.25, "0.1"),
        (0.5, "1"),
        (0.75, "10"),
        (1.0, "100"),
    ];
    Ok(map.scale(&colors, &scale.map(|(s, t)| (s, t.to_owned())), "mg/m^3"))
}

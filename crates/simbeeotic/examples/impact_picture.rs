//! Draws what `scenarios/impact.toml` does: the picture of the book's page on the world, as an SVG file.
//!
//! ```text
//! cargo run --release -p simbeeotic --example impact_picture
//! ```
//! The scenario runs through the library; bees are read twenty times a second, boxes at the end. The rest
//! of the file is the drawing: a parallel projection from the south-west, boxes from the back to the front.

use simbeeotic::kernel::SimTime;
use simbeeotic::model::Simulation;
use simbeeotic::scenario::{Request, load_file, render};
use simbeeotic::units::glam::{DQuat, DVec2, DVec3};
use simbeeotic::units::math;
use simbeeotic::world::SolidShape;
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

/// Time between two points of a trail.
const STEP_MS: u64 = 50;
/// Half the edge of the boxes that fall, m.
const HALF_M: f64 = 0.15;
/// What is shown: east, north and up, least and greatest, m.
const SHOWN: [[f64; 2]; 3] = [[-16.0, 14.0], [-13.0, 13.0], [0.0, 6.0]];
const PIXELS_PER_METRE: f64 = 32.0;

fn main() -> Result<(), Box<dyn Error>> {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let scene = fly(&repository.join("scenarios/impact.toml"))?;
    std::fs::write(repository.join("docs/images/impact.svg"), draw(&scene))?;
    Ok(())
}

/// A block, in the world frame.
struct Block {
    centre: DVec3,
    attitude: DQuat,
    half: DVec3,
    colour: [f64; 3],
}

struct Scene {
    blocks: Vec<Block>,
    /// The ways of the bees, each with the colour of its lane.
    trails: Vec<(&'static str, Vec<DVec3>)>,
}

fn fly(scenario: &Path) -> Result<Scene, Box<dyn Error>> {
    let loaded = load_file(scenario, &Request::default())
        .map_err(|wrong| render::faults(&wrong.faults, &wrong.sources, false))?;
    let setup = loaded
        .setup()
        .map_err(|faults| render::faults(&faults, loaded.sources(), false))?;
    let world = setup.world.clone();
    let mut run = Simulation::new(setup)?;
    let names: Vec<String> = run
        .population()
        .iter()
        .map(|(_, m)| m.path.to_owned())
        .collect();

    let mut trails: Vec<_> = names
        .iter()
        .filter_map(|name| colour_of(name).map(|colour| (name, colour, Vec::new())))
        .collect();
    let end_ms = run.end().nanos() / 1_000_000;
    for ms in (0..=end_ms).step_by(STEP_MS as usize) {
        run.run_until(SimTime::from_millis(ms))?;
        for (name, _, points) in &mut trails {
            points.extend(run.pose(name).map(|pose| pose.position.si()));
        }
    }

    let mut blocks = Vec::new();
    for object in world.objects(0) {
        for solid in &object.solids {
            if let SolidShape::Box {
                half_length,
                half_width,
                half_height,
            } = &solid.shape
            {
                let pose = solid.pose();
                blocks.push(Block {
                    centre: pose.position.si(),
                    attitude: pose.attitude.quat(),
                    half: DVec3::new(half_length.get(), half_width.get(), half_height.get()),
                    colour: [176.0, 172.0, 160.0],
                });
            }
        }
    }
    for pose in names
        .iter()
        .filter(|name| name.starts_with("box"))
        .filter_map(|name| run.pose(name))
    {
        blocks.push(Block {
            centre: pose.position.si(),
            attitude: pose.attitude.quat(),
            half: DVec3::splat(HALF_M),
            colour: [214.0, 160.0, 96.0],
        });
    }
    let trails = trails
        .into_iter()
        .map(|(_, colour, points)| (colour, points));
    Ok(Scene {
        blocks,
        trails: trails.collect(),
    })
}

/// The colour of a bee's trail; nothing for what is no bee.
fn colour_of(name: &str) -> Option<&'static str> {
    let colours = [("wall", "#2a7c8b"), ("heap", "#a04a2c"), ("net", "#4b4a9a")];
    let lane = colours.iter().find(|(lane, _)| name.starts_with(lane));
    lane.map(|(_, colour)| *colour)
}

/// The axes of the picture in the world: right, up, and toward the one who looks.
fn axes() -> [DVec3; 3] {
    let (turn, tilt) = (-0.42_f64, 0.62_f64);
    let ((sin, cos), (sin_tilt, cos_tilt)) = (math::sin_cos(turn), math::sin_cos(tilt));
    let right = DVec3::new(cos, sin, 0.0);
    let toward = DVec3::new(sin * cos_tilt, -cos * cos_tilt, sin_tilt);
    [right, toward.cross(right), toward]
}

/// Where a point of the world is in the picture, before it is moved into the frame.
fn project(p: DVec3) -> DVec2 {
    let [right, up, _] = axes();
    DVec2::new(p.dot(right), -p.dot(up)) * PIXELS_PER_METRE
}

fn draw(scene: &Scene) -> String {
    let corner = |k: usize| DVec3::new(SHOWN[0][k & 1], SHOWN[1][k >> 1 & 1], SHOWN[2][k >> 2]);
    let corners: Vec<DVec2> = (0..8).map(|k| project(corner(k))).collect();
    let least = corners
        .iter()
        .copied()
        .reduce(DVec2::min)
        .unwrap_or_default();
    let most = corners
        .iter()
        .copied()
        .reduce(DVec2::max)
        .unwrap_or_default();
    let size = most - least;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0} {:.0}\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fdfdfb\"/>\n\
         <g transform=\"translate({:.1} {:.1})\">\n",
        size.x, size.y, -least.x, -least.y
    );
    ground(&mut svg);
    let mut blocks: Vec<&Block> = scene.blocks.iter().collect();
    let nearness = |block: &Block| block.centre.dot(axes()[2]);
    blocks.sort_by(|a, b| nearness(a).total_cmp(&nearness(b)));
    for block in blocks {
        faces(&mut svg, block);
    }
    for (colour, points) in &scene.trails {
        trail(&mut svg, colour, points);
    }
    svg.push_str("</g>\n</svg>\n");
    svg
}

/// A grid of metres on the ground.
fn ground(svg: &mut String) {
    let [[west, east], [south, north], _] = SHOWN;
    let mut line = |a: DVec3, b: DVec3| {
        let (a, b) = (project(a), project(b));
        let _ = writeln!(
            svg,
            "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#e6e6e0\"/>",
            a.x, a.y, b.x, b.y
        );
    };
    for x in (west as i32..=east as i32).step_by(2).map(f64::from) {
        line(DVec3::new(x, south, 0.0), DVec3::new(x, north, 0.0));
    }
    for y in (south as i32..=north as i32).step_by(2).map(f64::from) {
        line(DVec3::new(west, y, 0.0), DVec3::new(east, y, 0.0));
    }
}

/// The faces of a block that are seen.
fn faces(svg: &mut String, block: &Block) {
    let light = DVec3::new(-0.4, -0.6, 0.7).normalize();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let mut normal = DVec3::ZERO;
            normal[axis] = side;
            let outward = block.attitude * normal;
            if outward.dot(axes()[2]) <= 0.0 {
                continue;
            }
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[a, b]| {
                let mut corner = normal;
                (corner[u], corner[v]) = (a, b);
                project(block.centre + block.attitude * (corner * block.half))
            });
            let shade = 0.72 + 0.28 * outward.dot(light).max(0.0);
            let [r, g, b] = block.colour.map(|c| (c * shade) as u8);
            let points = corners.map(|c| format!("{:.1},{:.1}", c.x, c.y)).join(" ");
            let _ = writeln!(
                svg,
                "<polygon points=\"{points}\" fill=\"rgb({r},{g},{b})\" stroke=\"#6e6a60\" stroke-width=\".5\"/>"
            );
        }
    }
}

/// The way of a bee, with a dot where it ends; what lies outside of the picture is left out.
fn trail(svg: &mut String, colour: &str, points: &[DVec3]) {
    let shown = |p: &&DVec3| (0..3).all(|k| (SHOWN[k][0]..=SHOWN[k][1]).contains(&p[k]));
    let mut path = String::new();
    for point in points.iter().filter(shown) {
        let place = project(*point);
        let command = if path.is_empty() { 'M' } else { 'L' };
        let _ = write!(path, "{command}{:.1} {:.1}", place.x, place.y);
    }
    let _ = writeln!(
        svg,
        "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1\" stroke-opacity=\".5\"/>"
    );
    if let Some(end) = points.last().filter(shown) {
        let place = project(*end);
        let _ = writeln!(
            svg,
            "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"3.2\" fill=\"{colour}\"/>",
            place.x, place.y
        );
    }
}

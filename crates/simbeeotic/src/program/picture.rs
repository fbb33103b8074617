//! `picture`: what a scenario or a world looks like, drawn by the camera of the shelf.

use super::arguments::{PictureOptions, ScenarioOptions};
use super::{Failure, input, remark};
use simbeeotic_kernel::{Limits, SimTime};
use simbeeotic_model::{Image, Origin, Pixels, Scene, SeesWhat, Setup, Simulation};
use simbeeotic_models::sensor::camera::{Channel, Lens, Light, Optics, Painter};
use simbeeotic_scenario::Checked;
use simbeeotic_units::glam::{DMat3, DQuat, DVec3};
use simbeeotic_units::{Angle, Attitude, Length, Pose, Position, math};
use simbeeotic_world::{Calm, World};
use std::path::Path;
use std::sync::Arc;

/// From the middle towards the camera, unless it is said: from the south-west, 35 degrees above.
const TOWARDS: DVec3 = DVec3::new(-0.52, -0.63, 0.575);
/// How much of the picture what there is may fill.
const FILL: f64 = 0.92;
/// Nothing is farther, m.
const FAR_M: f64 = 1e5;
/// The greatest number of rays of a picture.
const RAYS_MAX: u64 = 1 << 26;

/// Draws it.
pub(super) fn picture(options: &PictureOptions) -> Result<(), Failure> {
    let channel = channel(&options.kind)?;
    let [width, height] = size(&options.size)?;
    let view = angle(&options.field_of_view)?;
    let rays = u64::from(width * height) * u64::from(options.samples).pow(2);
    if !(1..=8).contains(&options.samples) || rays > RAYS_MAX {
        return Err(Failure::input(format!(
            "--samples {}: 1 to 8, and {RAYS_MAX} rays are the most that a picture has; this one has {rays}",
            options.samples
        )));
    }
    let simulation = simulation(options)?;
    let scene = simulation.scene();
    let (sin, cos) = math::sin_cos(0.5 * view.get());
    let optics = Optics::pinhole(width, height, options.samples, sin / cos);
    let pose = viewpoint(options, &scene, &optics)?;
    let lens = Lens::new(optics).ok_or_else(|| Failure::input("no such lens"))?;
    let painter = Painter {
        lens,
        near_m: 0.0,
        far_m: FAR_M,
        sees: SeesWhat::EVERYTHING,
        light: Light {
            shadows: !options.no_shadows,
            ..Light::default()
        },
        exposure: 1.0,
        chequer: chequer(&scene),
    };
    let images = painter.take(&scene, pose, &[channel]);
    let mut images = images.map_err(|error| Failure::input(format!("--from: {error}")))?;
    let image = match images.pop() {
        Some(image) if channel == Channel::Depth => shown_depth(&image),
        Some(image) => image,
        None => return Err(Failure::run("no picture was taken")),
    };
    let file = image.to_png().map_err(Failure::run)?;
    write(&options.output, &file)?;
    remark(format!("wrote {}", options.output.display()));
    Ok(())
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    std::fs::write(path, bytes)
        .map_err(|error| Failure::run(format!("cannot write {}: {error}", path.display())))
}

/// The scenario, or a run without models in the world, as it is at the time asked for.
fn simulation(options: &PictureOptions) -> Result<Simulation, Failure> {
    let until = match &options.time {
        None => SimTime::ZERO,
        Some(text) => SimTime::from_time(input::span("--time", text)?)
            .map_err(|error| Failure::input(format!("--time: {error}")))?,
    };
    let mut simulation = match input::check(&options.scenario)? {
        Checked::World { world, .. } => {
            let setup = alone(*world, &options.scenario);
            Simulation::new(hiding(setup, options)?).map_err(Failure::input)?
        }
        Checked::Scenario(loaded) => {
            let mut setup = input::setup(&loaded)?;
            // Nobody records a picture.
            setup.components.clear();
            setup.limits.end = setup.limits.end.max(until);
            let simulation = Simulation::new(hiding(setup, options)?);
            simulation.map_err(|error| input::setup_failure(&loaded, error))?
        }
    };
    if until > SimTime::ZERO {
        simulation.run_until(until).map_err(Failure::run)?;
    }
    Ok(simulation)
}

fn alone(world: World, options: &ScenarioOptions) -> Setup {
    Setup {
        origin: Origin {
            seed: options.seed.unwrap_or(1).cast_unsigned(),
            ..Origin::default()
        },
        limits: Limits::default(),
        threads: 1,
        pace: None,
        physics: simbeeotic_physics::Config::default(),
        medium: None,
        weather: Arc::new(Calm),
        world: Arc::new(world),
        models: Vec::new(),
        components: Vec::new(),
    }
}

/// The same without the objects that are not to be drawn.
fn hiding(mut setup: Setup, options: &PictureOptions) -> Result<Setup, Failure> {
    if options.hide.is_empty() {
        return Ok(setup);
    }
    let world = Arc::make_mut(&mut setup.world);
    let mut labels: Vec<String> = Vec::new();
    let mut stays = |label: &String| {
        labels.push(label.clone());
        !options.hide.contains(label)
    };
    world.obstacles.retain(|object| stays(&object.label));
    world.structures.retain(|object| stays(&object.label));
    world.patches.retain(|object| stays(&object.label));
    world.people.retain(|object| stays(&object.label));
    if world.terrain.as_ref().is_some_and(|t| !stays(&t.label)) {
        world.terrain = None;
    }
    match options.hide.iter().find(|label| !labels.contains(label)) {
        None => Ok(setup),
        Some(label) => {
            let mut known: Vec<&str> = labels.iter().map(String::as_str).collect();
            known.retain(|label| !label.is_empty());
            known.sort_unstable();
            known.dedup();
            let guess = simbeeotic_units::did_you_mean(label, known.iter().copied());
            let help = match guess {
                Some(guess) => format!("; did you mean `{guess}`?"),
                None => String::new(),
            };
            Err(Failure::input(format!(
                "--hide {label}: nothing has this label{help}"
            )))
        }
    }
}

fn channel(word: &str) -> Result<Channel, Failure> {
    let all = [
        Channel::Colour,
        Channel::Grey,
        Channel::Depth,
        Channel::Labels,
        Channel::Normals,
    ];
    let word = match word {
        "segmentation" => "labels",
        "color" => "colour",
        other => other,
    };
    all.into_iter().find(|c| c.name() == word).ok_or_else(|| {
        let names = all.map(Channel::name).join(", ");
        Failure::input(format!("--kind {word}: it is one of {names}"))
    })
}

fn size(text: &str) -> Result<[u32; 2], Failure> {
    let sides = text.split_once('x');
    let sides = sides.and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match sides {
        Some([width, height]) if (1..=4096).contains(&width) && (1..=4096).contains(&height) => {
            Ok([width, height])
        }
        _ => Err(Failure::input(format!(
            "--size {text}: width and height in pixels, 1 to 4096, such as 800x600"
        ))),
    }
}

fn angle(text: &str) -> Result<Angle, Failure> {
    let angle: Angle = text
        .parse()
        .map_err(|error| Failure::input(format!("--field-of-view: {error}")))?;
    if angle >= Angle::from_degrees(0.1) && angle <= Angle::from_degrees(170.0) {
        Ok(angle)
    } else {
        Err(Failure::input(format!(
            "--field-of-view {angle}: 0.1 deg to 170 deg"
        )))
    }
}

pub(super) fn place(option: &str, text: &str) -> Result<DVec3, Failure> {
    let parts: Vec<f64> = text
        .split(',')
        .filter_map(|part| part.trim().trim_end_matches('m').trim_end().parse().ok())
        .collect();
    match parts[..] {
        [x, y, z] if text.split(',').count() == 3 && [x, y, z].iter().all(|p| p.abs() <= 1e6) => {
            Ok(DVec3::new(x, y, z))
        }
        _ => Err(Failure::input(format!(
            "{option} {text}: three lengths in metres (east, north, up), such as -10,-10,8"
        ))),
    }
}

/// Where the camera stands and looks.
fn viewpoint(
    options: &PictureOptions,
    scene: &Scene<'_>,
    optics: &Optics,
) -> Result<Pose, Failure> {
    let [low, high] = scene
        .bounds()
        .unwrap_or([DVec3::splat(-5.0), DVec3::splat(5.0)]);
    let middle = 0.5 * (low + high);
    let at = match &options.at {
        Some(text) => place("--at", text)?,
        None => middle,
    };
    let from = match &options.from {
        Some(text) => place("--from", text)?,
        None => {
            let eye = framed([low - at, high - at], optics);
            return Ok(Pose::new(Position::from_si(at + eye), looking(-TOWARDS)));
        }
    };
    if (at - from).length() < 1e-6 {
        return Err(Failure::input(format!(
            "--from and --at are the same place, {at}: there is no direction between them"
        )));
    }
    Ok(Pose::new(Position::from_si(from), looking(at - from)))
}

/// Where a camera that looks against [`TOWARDS`] has to be to see all of a box, as large as can be and in
/// the middle of the picture.
fn framed(bounds: [DVec3; 2], optics: &Optics) -> DVec3 {
    let axes = DMat3::from_quat(looking(-TOWARDS).quat());
    let half = |pixels: u32| FILL * 0.5 * f64::from(pixels) / optics.focal_px;
    let (across, upright) = (half(optics.width), half(optics.height));
    let corners: Vec<DVec3> = (0..8_usize)
        .map(|k| DVec3::new(bounds[k & 1].x, bounds[k >> 1 & 1].y, bounds[k >> 2].z))
        .map(|corner| axes.transpose() * corner)
        .collect();
    // Forward, left and up of the box's middle.
    let mut eye = DVec3::ZERO;
    for _ in 0..20 {
        let need = |corner: &DVec3| {
            let seen = *corner - eye.with_x(0.0);
            (seen.y.abs() / across).max(seen.z.abs() / upright) - seen.x
        };
        eye.x = -corners.iter().map(need).fold(0.1, f64::max);
        let slopes = |part: fn(DVec3) -> f64| {
            let slopes = corners.iter().map(|c| part(*c - eye) / (c.x - eye.x));
            let ends = slopes.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], slope| {
                [low.min(slope), high.max(slope)]
            });
            0.5 * (ends[0] + ends[1])
        };
        let (left, up) = (slopes(|v| v.y), slopes(|v| v.z));
        eye += DVec3::new(0.0, left, up) * -eye.x;
    }
    let need = |corner: &DVec3| {
        let seen = *corner - eye.with_x(0.0);
        (seen.y.abs() / across).max(seen.z.abs() / upright) - seen.x
    };
    eye.x = -corners.iter().map(need).fold(0.1, f64::max);
    axes * eye
}

/// The attitude of a camera that looks along a direction, its left side level.
fn looking(direction: DVec3) -> Attitude {
    let forward = direction.normalize();
    let level = DVec3::Z.cross(forward);
    let left = if level.length() < 1e-9 {
        DVec3::NEG_X
    } else {
        level.normalize()
    };
    let axes = DMat3::from_cols(forward, left, forward.cross(left));
    Attitude::from_unit_quat(DQuat::from_mat3(&axes))
}

/// Squares of 1, 2 or 5 times a power of ten, of which about eight go across what there is.
fn chequer(scene: &Scene<'_>) -> Length {
    let Some([low, high]) = scene.bounds() else {
        return Length::si(1.0);
    };
    let wanted = (high - low).truncate().max_element() / 8.0;
    let powers = [0.1, 1.0, 10.0, 100.0, 1000.0];
    let edges = powers
        .into_iter()
        .flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * power));
    let mut edges = edges.skip_while(|edge| *edge < wanted);
    Length::si(edges.next().unwrap_or(1e4))
}

/// Depths as greys, by their inverse: the nearest is white, the farthest dark, what is not there black.
fn shown_depth(image: &Image) -> Image {
    let Pixels::Depth(metres) = &image.pixels else {
        return image.clone();
    };
    let seen = || metres.iter().copied().filter(|m| m.is_finite());
    let near = seen().fold(f32::INFINITY, f32::min);
    let far = seen().fold(0.0, f32::max);
    let grey = |m: &f32| {
        if m.is_finite() {
            // Disparities: what is near is told apart best.
            let share = (m.recip() - far.recip()) / (near.recip() - far.recip()).max(1e-9);
            (40.0 + 215.0 * share).round() as u8
        } else {
            0
        }
    };
    Image {
        pixels: Pixels::Grey(metres.iter().map(grey).collect()),
        ..image.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_that_stands_off_sees_all_of_a_box_and_not_much_more() {
        let optics = Optics::pinhole(800, 600, 1, 0.5);
        let bounds = [DVec3::new(-3.0, -8.0, 0.0), DVec3::new(4.0, 2.0, 3.0)];
        let axes = DMat3::from_quat(looking(-TOWARDS).quat());
        let eye = framed(bounds, &optics);
        let mut widest = 0.0_f64;
        for k in 0..8_usize {
            let corner = DVec3::new(bounds[k & 1].x, bounds[k >> 1 & 1].y, bounds[k >> 2].z);
            let seen = axes.transpose() * (corner - eye);
            assert!(seen.x > 0.0);
            let share = (seen.y.abs() / seen.x / 0.5).max(seen.z.abs() / seen.x / 0.375);
            widest = widest.max(share);
        }
        assert!((widest - FILL).abs() < 1e-9, "{widest}");
    }

    #[test]
    fn a_camera_looks_where_it_is_told_with_its_left_side_level() {
        for direction in [
            DVec3::new(1.0, 2.0, -0.5),
            DVec3::new(-3.0, 0.1, 0.2),
            DVec3::NEG_Z,
        ] {
            let attitude = looking(direction);
            assert!((attitude.forward() - direction.normalize()).length() < 1e-9);
            assert!(attitude.left().z.abs() < 1e-9);
        }
    }

    #[test]
    fn places_and_sizes_read_or_say_what_is_wrong() {
        assert_eq!(
            place("--at", "1, -2 m,3.5").ok(),
            Some(DVec3::new(1.0, -2.0, 3.5))
        );
        for text in ["", "1,2", "1,2,x", "1,2,3,4", "1,2,inf", "nan,1,1"] {
            assert!(place("--at", text).is_err(), "{text}");
        }
        assert_eq!(size("320x200").ok(), Some([320, 200]));
        for text in ["", "320", "0x5", "5x5000", "5xx5", "-1x5"] {
            assert!(size(text).is_err(), "{text}");
        }
        assert!(channel("segmentation").is_ok() && channel("smell").is_err());
    }
}

//! Pictures of known scenes against closed forms.

use super::*;
use crate::sensor::scene::block;
use crate::trial::{Trial, assert_normal, refusal, vehicle};
use glam::DVec3;
use simbeeotic_model::physics::Kind;
use simbeeotic_model::scene::LABELS_OF_A_KIND;
use simbeeotic_model::units::{Attitude, Position, Time, Velocity, Yaw};
use simbeeotic_model::world::{Obstacle, ObstacleShape, Person, World};
use simbeeotic_model::{Bee, Handle};

const SIZE: &[(&str, &str)] = &[("width", "60"), ("height", "40")];

/// A camera of the shelf with these parameters besides.
fn trial(params: &[(&'static str, &str)]) -> Trial {
    let mut all = SIZE.to_vec();
    all.retain(|(key, _)| params.iter().all(|(other, _)| key != other));
    let all: Vec<_> = all.iter().chain(params).copied().collect();
    Trial::of("camera", &all)
}

fn tan(degrees: f64) -> f64 {
    let (sin, cos) = math::sin_cos(degrees.to_radians());
    sin / cos
}

fn degrees(roll: f64, pitch: f64, yaw: f64) -> Attitude {
    let a = Angle::from_degrees;
    Attitude::from_rpy(a(roll), a(pitch), Yaw::new(a(yaw)))
}

/// The direction of a pixel in the world, its forward part being 1.
fn pixel(attitude: Attitude, at: usize, [width, height]: [usize; 2], focal_px: f64) -> DVec3 {
    let right = (at % width) as f64 + 0.5 - 0.5 * width as f64;
    let down = (at / width) as f64 + 0.5 - 0.5 * height as f64;
    attitude.quat() * DVec3::new(1.0, -right / focal_px, -down / focal_px)
}

fn close(found: f32, wanted: f64) -> bool {
    (f64::from(found) - wanted).abs() < 1e-6 * wanted.max(1.0)
}

fn ball(at: [f64; 3], diameter: f64) -> Obstacle {
    Obstacle {
        position: Position::from_xyz(at[0], at[1], at[2]),
        shape: ObstacleShape::Sphere {
            radius: Length::si(0.5 * diameter),
        },
        ..Obstacle::default()
    }
}

fn with(obstacles: Vec<Obstacle>) -> World {
    World {
        obstacles,
        ..World::default()
    }
}

#[test]
fn the_depth_of_a_ball_on_the_axis_is_that_of_the_closed_form() {
    let mut trial = trial(&[
        ("sees", "obstacles"),
        ("channels", "[depth, range]"),
        ("field_of_view", "60 deg"),
    ]);
    // The bee's centre is 5 cm above its start; the ball's 1 m above its foot, 6 m ahead.
    trial.at = [0.0, 0.0, 9.95];
    trial.world = with(vec![ball([6.0, 0.0, 9.0], 2.0)]);
    trial.run(|bee, sensor: Handle<Frame>| {
        let frame = bee.read(sensor);
        let focal = 30.0 / tan(30.0);
        let (mut seen, mut missed) = (0, 0);
        for (at, (z, range)) in frame.depth_m().iter().zip(frame.range_m()).enumerate() {
            let ray = pixel(Attitude::IDENTITY, at, [60, 40], focal);
            let (length, along) = (ray.length(), 6.0 / ray.length());
            let inside = 1.0 - (36.0 - along * along);
            if inside >= 0.0 {
                let distance = along - inside.sqrt();
                assert!(close(*range, distance), "{at}: {range}, not {distance}");
                assert!(close(*z, distance / length), "{at}: {z}");
                seen += 1;
            } else {
                assert_eq!((*z, *range), (f32::INFINITY, f32::INFINITY), "{at}");
                missed += 1;
            }
        }
        // A disc of about f / sqrt(35) pixels.
        let disc = std::f64::consts::PI * focal * focal / 35.0;
        assert!(
            (f64::from(seen) - disc).abs() < 0.05 * disc,
            "{seen} for {disc}"
        );
        assert!(missed > 2000);
        let nearest = frame.nearest().expect("it is seen").get();
        assert!((nearest - 5.0).abs() < 0.01, "half a pixel off: {nearest}");
    });
}

#[test]
fn the_depth_of_the_ground_is_that_of_a_plane_at_two_attitudes_and_in_motion() {
    let mut trial = trial(&[("field_of_view", "80 deg"), ("far", "60 m")]);
    trial.every = Time::from_secs(0.25);
    trial.seconds = 2;
    let mut height_before = 0.0;
    trial.run(move |bee: &mut Bee<'_>, sensor: Handle<Frame>| {
        let climbing = Velocity::from_xyz(3.0, -1.0, 2.0);
        bee.set_velocity(climbing);
        let height = bee.position().up().get();
        assert!(height > height_before, "it climbs between the frames");
        height_before = height;
        let focal = 30.0 / tan(40.0);
        for attitude in [degrees(0.0, 90.0, 30.0), degrees(25.0, 30.0, -70.0)] {
            bee.set_attitude(attitude);
            let frame = bee.read(sensor);
            let (mut near, mut far) = (0, 0);
            for (at, z) in frame.depth_m().iter().enumerate() {
                let ray = pixel(attitude, at, [60, 40], focal);
                // The forward part is 1: so many times the ray as it takes to sink to the ground.
                let depth = height / -ray.z;
                if depth > 0.0 && depth <= 60.0 {
                    assert!(close(*z, depth), "{at}: {z}, not {depth}");
                    near += 1;
                } else {
                    assert_eq!(*z, f32::INFINITY, "{at}: {depth}");
                    far += 1;
                }
            }
            assert!(near > 800, "{near} near, {far} far");
        }
    });
}

#[test]
fn the_depth_of_a_wall_that_leans_is_that_of_its_plane() {
    let mut trial = trial(&[("sees", "obstacles")]);
    let lean = degrees(10.0, 25.0, 35.0);
    let normal = -(lean.quat() * DVec3::X);
    // It is turned about the middle of its lowest side; its face goes through (8, 1, 9).
    let foot = DVec3::new(8.0, 1.0, 9.0) - normal * 0.25 - lean.quat() * DVec3::Z * 45.0;
    let mut wall = block(foot.to_array(), [0.5, 90.0, 90.0]);
    wall.attitude = lean;
    let face = DVec3::new(8.0, 1.0, 9.0);
    trial.world = with(vec![wall]);
    trial.run(move |bee, sensor: Handle<Frame>| {
        let eye = bee.position().si();
        let mut seen = 0;
        for (at, z) in bee.read(sensor).depth_m().iter().enumerate() {
            let ray = pixel(Attitude::IDENTITY, at, [60, 40], 30.0);
            let depth = (face - eye).dot(normal) / ray.dot(normal);
            if z.is_finite() {
                assert!(close(*z, depth), "{at}: {z}, not {depth}");
                seen += 1;
            }
        }
        assert!(seen > 1500, "{seen}");
    });
}

#[test]
fn labels_count_as_many_pixels_as_the_projection_is_large_and_say_who_it_is() {
    let mut trial = trial(&[
        ("width", "200"),
        ("height", "200"),
        ("channels", "[labels]"),
    ]);
    trial.at = [0.0, 0.0, 9.95];
    // A face of 2 m x 1 m, 5 m ahead, and one of 1 m x 1 m, 10 m ahead, above it; a person; a bee.
    trial.world = with(vec![
        block([5.5, 0.0, 9.5], [1.0, 2.0, 1.0]),
        block([10.5, 0.0, 12.5], [1.0, 1.0, 1.0]),
    ]);
    trial.world.people = vec![Person {
        position: Position::from_xyz(6.0, 4.0, 9.0),
        ..Person::default()
    }];
    let still = [("contacts", "none"), ("length", "1 m")];
    trial.others = vec![vehicle(
        "other",
        "inert-bee",
        &[("hover", "true")],
        &still,
        [5.0, -3.0, 9.5],
    )];
    trial.run(|bee, sensor: Handle<Frame>| {
        let frame = bee.read(sensor);
        let count = |kind: Kind, number: u32| {
            let label = (kind as u32 + 1) * LABELS_OF_A_KIND + number;
            frame.labels().iter().filter(|l| **l == label).count() as f64
        };
        for (number, across, up) in [(0, 40.0, 20.0), (1, 10.0, 10.0)] {
            let (found, area) = (count(Kind::Obstacle, number), across * up);
            // Half a pixel on each side.
            assert!(
                (found - area).abs() <= across + up,
                "{found} pixels for {area}"
            );
        }
        assert!(count(Kind::Person, 0) > 50.0);
        // A ball of 1 m: the host is model 0, this one model 1.
        let slant2 = 34.0_f64;
        let disc = std::f64::consts::PI * 2500.0 / slant2;
        assert!(
            count(Kind::Vehicle, 1) > 0.8 * disc,
            "{}",
            count(Kind::Vehicle, 1)
        );
        assert_eq!(count(Kind::Vehicle, 0), 0.0, "the host is not seen");
        let named = frame.labels().iter().filter(|l| **l >> 24 == 1).count();
        assert!(named > 1000, "the ground is seen");
        assert!(frame.labels().contains(&0), "and the sky");
    });
}

/// A wall that fills the picture, `ahead` of the camera.
fn walled(params: &[(&'static str, &str)], ahead: f64) -> Trial {
    let mut trial = trial(params);
    trial.at = [0.0, 0.0, 9.95];
    trial.world = with(vec![block([ahead + 0.5, 0.0, 0.0], [1.0, 99.0, 99.0])]);
    trial
}

#[test]
fn the_noise_of_depth_grows_with_its_square_as_it_says() {
    for (ahead, sigma) in [(2.0, 0.03), (5.0, 0.135)] {
        let size = [("width", "400"), ("height", "250")];
        let noise = [("depth_sigma", "1 cm"), ("depth_growth", "0.005")];
        let trial = walled(&[size, noise].concat(), ahead);
        trial.run(move |bee, sensor: Handle<Frame>| {
            let frame = bee.read(sensor);
            let read: Vec<f64> = frame.depth_m().iter().map(|z| f64::from(*z)).collect();
            assert_eq!(read.len(), 100_000);
            assert_normal(&read, ahead, sigma);
            assert_ne!(
                bee.read(sensor),
                frame,
                "the next picture has noise of its own"
            );
        });
    }
}

#[test]
fn a_share_of_the_pixels_drops_out_and_the_rest_comes_in_steps() {
    let size = [("width", "400"), ("height", "250")];
    let loss = [("depth_dropout", "0.2"), ("depth_step", "0.3 m")];
    walled(&[size, loss].concat(), 2.0).run(|bee, sensor: Handle<Frame>| {
        let frame = bee.read(sensor);
        let gone = frame.depth_m().iter().filter(|z| z.is_infinite()).count() as f64;
        // Four standard errors.
        assert!(
            (gone - 2e4).abs() < 4.0 * (1e5_f64 * 0.2 * 0.8).sqrt(),
            "{gone}"
        );
        let rest = frame.depth_m().iter().filter(|z| z.is_finite());
        assert!(rest.copied().all(|z| close(z, 2.1)));
    });
}

#[test]
fn depth_and_range_of_a_pixel_err_as_one() {
    let both = [
        ("channels", "[depth, range]"),
        ("depth_sigma", "0.1 m"),
        ("depth_dropout", "0.2"),
    ];
    walled(&both, 2.0).run(|bee, sensor: Handle<Frame>| {
        let frame = bee.read(sensor);
        let range = frame
            .images
            .iter()
            .find_map(|(channel, image)| match &image.pixels {
                Pixels::Depth(metres) if *channel == Channel::Range => Some(metres.clone()),
                _ => None,
            })
            .expect("it takes ranges");
        let (mut lost, mut middle) = (0, f32::INFINITY);
        for (z, r) in frame.depth_m().iter().zip(range.iter()) {
            assert_eq!(z.is_infinite(), r.is_infinite());
            if z.is_finite() && *z > 0.0 {
                // The secant of the pixel's angle, whatever the noise.
                assert!(r / z > 0.999 && r / z < 3.0, "{r} {z}");
                middle = middle.min(r / z);
            }
            lost += usize::from(z.is_infinite());
        }
        assert!((middle - 1.0).abs() < 0.01 && lost > 0, "{middle}, {lost}");
    });
}

#[test]
fn no_depth_lies_beyond_far() {
    let params = [("depth_sigma", "0.5 m"), ("far", "2.1 m")];
    walled(&params, 2.0).run(|bee, sensor: Handle<Frame>| {
        let frame = bee.read(sensor);
        assert!(frame.depth_m().contains(&2.1));
        assert!(frame.depth_m().iter().all(|z| *z <= 2.1 || z.is_infinite()));
    });
}

#[test]
fn a_device_has_the_noise_of_its_data_sheet() {
    // Intel quotes less than 2 % at 2 m for the D435; the formula gives 1.4 % at this resolution.
    walled(&[("preset", "realsense-d435")], 2.0).run(|bee, sensor: Handle<Frame>| {
        let read: Vec<f64> = (0..42)
            .flat_map(|_| bee.read(sensor).depth_m().to_vec())
            .map(f64::from)
            .collect();
        assert!(read.len() > 100_000);
        // f = 212 / tan(43.5 deg) = 223.4 pixels; steps of 1 mm add nothing worth a word.
        let sigma = 0.08 / (223.4 * 0.05) * 4.0;
        assert_normal(&read, 2.0, sigma);
        assert!(sigma / 2.0 < 0.02);
    });
    let zones = [("preset", "vl53l5cx"), ("width", "8"), ("height", "8")];
    walled(&zones, 3.9).run(|bee, sensor: Handle<Frame>| {
        let frame = bee.read(sensor);
        assert_eq!(frame.depth_m().len(), 64);
        assert!(frame.depth_m().iter().filter(|z| z.is_finite()).count() > 60);
    });
    walled(&zones, 4.1).run(|bee, sensor: Handle<Frame>| {
        assert_eq!(
            bee.read(sensor).nearest(),
            None,
            "it sees no farther than 4 m"
        );
    });
}

#[test]
fn a_surface_is_as_bright_as_lambert_says() {
    // Looking down on plain ground: the sun stands 30 degrees high.
    let params = [
        ("channels", "[colour, grey]"),
        ("chequer", "0 m"),
        ("light.sun", "0.6"),
        ("light.ambient", "0.2"),
        ("light.elevation", "30 deg"),
    ];
    let mut trial = trial(&params);
    trial.world.ground.color = simbeeotic_model::world::Color::rgb(255, 188, 0);
    trial.run(|bee, sensor: Handle<Frame>| {
        bee.set_attitude(degrees(0.0, 90.0, 0.0));
        let frame = bee.read(sensor);
        let Some(Pixels::Colour(bytes)) = frame.image(Channel::Colour).map(|i| &i.pixels) else {
            panic!("it takes colour")
        };
        // 0.2 + 0.6 / 2 = 0.5 of the albedo: 188 is 0.5029 linear, so white 0.5 and 0.2514, in sRGB.
        for rgb in bytes.chunks(3) {
            assert!(
                rgb[0].abs_diff(188) <= 1 && rgb[1].abs_diff(137) <= 1 && rgb[2] == 0,
                "{rgb:?}"
            );
        }
        let Some(Pixels::Grey(bytes)) = frame.image(Channel::Grey).map(|i| &i.pixels) else {
            panic!("it takes grey")
        };
        // 0.2126 * 0.5 + 0.7152 * 0.2514 = 0.2861 linear.
        assert!(bytes.iter().all(|b| b.abs_diff(146) <= 1), "{}", bytes[0]);
    });
}

#[test]
fn what_stands_in_the_sun_casts_a_shadow_if_it_is_asked_to() {
    for (shadows, dark) in [("true", true), ("false", false)] {
        let mut trial = trial(&[
            ("channels", "[grey, labels]"),
            ("chequer", "0 m"),
            ("light.shadows", shadows),
            ("light.heading", "90 deg"),
            ("light.elevation", "45 deg"),
        ]);
        // The sun stands in the east: the shadow of a post of 4 m lies 4 m to the west.
        trial.world = with(vec![block([2.0, 0.0, 0.0], [1.0, 2.0, 4.0])]);
        trial.run(move |bee, sensor: Handle<Frame>| {
            bee.set_attitude(degrees(0.0, 90.0, 0.0));
            let frame = bee.read(sensor);
            let Some(Pixels::Grey(bytes)) = frame.image(Channel::Grey).map(|i| &i.pixels) else {
                panic!("it takes grey")
            };
            // Straight below the camera, half a metre to the west of the post, and far away.
            let (below, corner) = (bytes[20 * 60 + 30], bytes[0]);
            assert_eq!(below < corner, dark, "{below} {corner}");
            assert_eq!(frame.labels()[20 * 60 + 30] >> 24, 1, "it is the ground");
        });
    }
}

#[test]
fn grain_has_the_sigma_it_says() {
    let params = [
        ("width", "400"),
        ("height", "250"),
        ("channels", "[grey]"),
        ("noise", "0.04"),
        ("chequer", "0 m"),
    ];
    let mut trial = trial(&params);
    trial.world.ground.color = simbeeotic_model::world::Color::rgb(128, 128, 128);
    trial.run(|bee, sensor: Handle<Frame>| {
        bee.set_attitude(degrees(0.0, 90.0, 0.0));
        let frame = bee.read(sensor);
        let Some(Pixels::Grey(bytes)) = frame.image(Channel::Grey).map(|i| &i.pixels) else {
            panic!("it takes grey")
        };
        let read: Vec<f64> = bytes.iter().map(|b| f64::from(*b)).collect();
        let mean = (read.iter().sum::<f64>() / 1e5).round();
        // Rounding adds 1/12 to the variance.
        let sigma = (10.2_f64 * 10.2 + 1.0 / 12.0).sqrt();
        assert_normal(
            &read.iter().map(|b| b - mean).collect::<Vec<_>>(),
            0.0,
            sigma,
        );
    });
}

#[test]
fn a_bent_lens_sees_each_place_where_the_formula_puts_it() {
    let distortion = Distortion {
        k1: -0.2,
        k2: 0.03,
        ..Distortion::default()
    };
    let trial = trial(&[("distortion.k1", "-0.2"), ("distortion.k2", "0.03")]);
    trial.run(move |bee, sensor: Handle<Frame>| {
        let height = bee.position().up().get();
        let attitude = degrees(0.0, 60.0, 0.0);
        bee.set_attitude(attitude);
        let optics = Optics {
            distortion,
            ..Optics::pinhole(60, 40, 1, 1.0)
        };
        for (at, z) in bee.read(sensor).depth_m().iter().enumerate() {
            let place = glam::DVec2::new((at % 60) as f64 + 0.5, (at / 60) as f64 + 0.5);
            let slopes = optics.slopes(place).expect("it does not fold");
            let ray = attitude.quat() * DVec3::new(1.0, -slopes.x, -slopes.y);
            let depth = height / -ray.z;
            assert!(
                !(0.0..=100.0).contains(&depth) || close(*z, depth),
                "{at}: {z} {depth}"
            );
        }
    });
}

#[test]
fn nonsense_is_refused() {
    for (key, value) in [
        ("width", "0"),
        ("width", "5000"),
        ("height", "0"),
        ("samples", "0"),
        ("samples", "9"),
        ("field_of_view", "0 deg"),
        ("field_of_view", "180 deg"),
        ("focal_length_px", "0"),
        ("principal_point_px", "[1e300, 0]"),
        ("principal_point_px", "[1]"),
        ("near", "-1 m"),
        ("far", "1 mm"),
        ("depth_sigma", "-1 m"),
        ("depth_growth", "-0.1"),
        ("depth_step", "-1 mm"),
        ("depth_dropout", "1.5"),
        ("noise", "-1"),
        ("exposure", "0"),
        ("chequer", "-1 m"),
        ("channels", "[]"),
        ("channels", "[depth, depth]"),
        ("channels", "[colour, smell]"),
        ("light.elevation", "-5 deg"),
        ("light.sun", "-1"),
        ("light.ambient", "-1"),
        ("distortion.k1", "-9"),
        ("sees", "everthing"),
        ("preset", "gopro"),
        ("colour", "1"),
    ] {
        assert!(
            refusal("camera", &[(key, value)]).is_some(),
            "{key} = {value}"
        );
    }
    let both = [("focal_length_px", "100"), ("field_of_view", "60 deg")];
    assert!(refusal("camera", &both).is_some());
    let large = [("width", "4096"), ("height", "4096"), ("samples", "2")];
    assert!(refusal("camera", &large).is_some());
    assert_eq!(refusal("camera", &[]), None);
}

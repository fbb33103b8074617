//! Pictures of a small recording: always the same, and of what was asked for.

use super::*;
use simbeeotic_record::stage::{Form, Piece, Prop};
use simbeeotic_record::{
    Header, Metric, Metrics, Recorder, Recording, Sample, Stage, Vehicle, Wind,
};
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::math;
use std::path::Path;

const TICK_NS: u64 = 100_000_000;
const BEES: usize = 300;

/// Bees on circles, each with its own; a tick each tenth of a second, for two seconds.
fn record(path: &Path, winds: &[Wind]) {
    let vehicle = |k: usize| Vehicle {
        path: format!("bee-{k}"),
        kind: ["instrument-bee", "random-walk-bee"][k % 2].to_owned(),
        radius_m: 0.05,
        color: [240, 170, 20, 255],
        ..Vehicle::default()
    };
    let header = Header {
        vehicles: (0..BEES).map(vehicle).collect(),
        ..Header::default()
    };
    let mut recorder = Recorder::create(path, header).expect("created");
    for tick in 0..=20_u64 {
        let samples = (0..BEES).map(|k| sample(k, tick as f64 * 0.1));
        recorder.tick(tick * TICK_NS, samples).expect("recorded");
        let values = (0..BEES).map(|k| Metric {
            name: format!("bee-{k}/pollen"),
            unit: "1".to_owned(),
            value: k as f64 * 0.1,
        });
        let metrics = Metrics {
            time_ns: tick * TICK_NS,
            values: values.collect(),
        };
        recorder.metrics(metrics).expect("recorded");
        let now = winds.iter().filter(|wind| wind.time_ns == tick * TICK_NS);
        now.for_each(|wind| recorder.wind(wind.clone()).expect("recorded"));
    }
    let summary = serde_json::json!({});
    recorder.finish(&summary).expect("finished");
}

fn sample(k: usize, time_s: f64) -> Sample {
    let (radius, height) = (1.0 + k as f64 * 0.03, 1.0 + (k % 17) as f64 * 0.2);
    let angle = k as f64 + time_s / radius;
    let (sin, cos) = math::sin_cos(angle);
    let (half_sin, half_cos) = math::sin_cos(0.5 * angle + std::f64::consts::FRAC_PI_4);
    Sample {
        position_m: [radius * cos, radius * sin, height],
        world_from_body: [half_cos, 0.0, 0.0, half_sin],
        velocity_m_s: [-sin, cos, 0.0],
        rate_rad_s: [0.0, 0.0, 1.0 / radius],
    }
}

/// A tower, a glass house and a ball.
fn stage() -> Stage {
    let prop = |form, position_m, color| Prop {
        kind: "obstacle".to_owned(),
        color,
        pieces: vec![Piece {
            position_m,
            ..Piece::at_origin(form)
        }],
        ..Prop::default()
    };
    let tower = Form::Cylinder {
        radius_m: 1.0,
        top_m: 0.5,
        half_height_m: 2.0,
    };
    let house = Form::Box {
        half_m: [2.0, 1.0, 1.0],
    };
    let ball = Form::Sphere { radius_m: 0.8 };
    Stage {
        ground: [125, 163, 106, 255],
        texture: String::new(),
        radius_m: 100.0,
        plane: true,
        props: vec![
            prop(tower, [3.0, 2.0, 2.0], [160, 110, 90, 255]),
            prop(house, [-4.0, -1.0, 1.0], [150, 190, 220, 120]),
            prop(ball, [1.0, -4.0, 0.8], [200, 80, 60, 255]),
        ],
    }
}

fn opened(test: impl FnOnce(&Recording)) {
    in_wind(&[], test);
}

fn in_wind(winds: &[Wind], test: impl FnOnce(&Recording)) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    record(&path, winds);
    test(&Recording::open(&path).expect("opens"));
}

fn orbit() -> Choices {
    Choices {
        size: [320, 180],
        view: View::Orbit {
            bearing_rad: 3.8,
            elevation_rad: Some(0.5),
            turn_rad_s: 0.0,
        },
        trail_s: 1.0,
        ..Choices::default()
    }
}

fn taken(recording: &Recording, choices: Choices, times_ns: &[u64]) -> Vec<Picture> {
    let range = times_ns[0]..=times_ns[times_ns.len() - 1];
    let mut film = Film::new(recording, &stage(), choices, range).expect("a film");
    times_ns
        .iter()
        .map(|time_ns| film.picture(*time_ns).expect("a picture"))
        .collect()
}

fn hash(pictures: &[Picture]) -> u64 {
    let bytes = pictures.iter().flat_map(|picture| &picture.rgb);
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

const TIMES: [u64; 3] = [1_000_000_000, 1_040_000_000, 1_530_000_000];

#[test]
fn a_picture_is_the_same_on_any_number_of_threads() {
    opened(|recording| {
        let drawn = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let pool = pool.expect("threads");
            pool.install(|| taken(recording, orbit(), &TIMES))
        };
        let one = drawn(1);
        for threads in [2, 3, 8] {
            assert_eq!(one, drawn(threads), "{threads} threads");
        }
        // And it is a picture: at other times it is another one.
        assert_ne!(one[0], one[2]);
    });
}

#[test]
fn pictures_are_those_that_were_looked_at() {
    opened(|recording| {
        let plain = |choices| Choices {
            captions: false,
            ..choices
        };
        let top = Choices {
            view: View::Side(Side::Top),
            colour_by: ColourBy::Speed,
            ..orbit()
        };
        let hashes = [orbit(), top].map(|choices| hash(&taken(recording, plain(choices), &TIMES)));
        assert_eq!(hashes.map(|hash| format!("{hash:016x}")), GOLDEN);
    });
}

/// To be changed when pictures are to look different, and they have been looked at.
const GOLDEN: [&str; 2] = ["83f8fef6dc5c31e2", "0fef3e17f1bcfc2c"];

#[test]
fn the_wind_that_was_recorded_is_drawn_until_there_is_another() {
    let wind = |time_ns, speed| Wind {
        time_ns,
        arrows: vec![
            [0.0, 0.0, 4.0, speed, 0.0, 0.0],
            [0.0, 5.0, 4.0, 0.0, -1.0, 0.0],
        ],
    };
    let both = [wind(0, 2.0), wind(1_000_000_000, 3.0)];
    in_wind(&both, |recording| {
        let mut winds = super::wind::Winds::open(recording, 500_000_000).expect("read");
        assert_eq!(winds.now(), Some(&both[0]));
        winds.advance(recording, 1_700_000_000).expect("read");
        assert_eq!(winds.now(), Some(&both[1]));
        assert_eq!(winds.said().as_deref(), Some("wind up to 3.0 m/s"));
        winds.advance(recording, 100_000_000).expect("read");
        assert_eq!(winds.now(), Some(&both[0]), "back again");
        let drawn = |wind| {
            let choices = Choices {
                wind,
                captions: false,
                ..orbit()
            };
            taken(recording, choices, &TIMES)
        };
        let (with, without) = (drawn(true), drawn(false));
        assert!(with.iter().zip(&without).all(|(a, b)| a != b));
    });
    opened(|recording| {
        let winds = super::wind::Winds::open(recording, 500_000_000).expect("read");
        assert!(winds.now().is_none() && winds.said().is_none());
    });
}

#[test]
fn a_picture_alone_is_that_of_the_film() {
    opened(|recording| {
        let choices = || Choices {
            trail_s: 0.0,
            ..orbit()
        };
        let mut film =
            Film::new(recording, &stage(), choices(), 0..=2_000_000_000).expect("a film");
        let first = film.picture(500_000_000).expect("a picture");
        film.picture(1_500_000_000).expect("a picture");
        // Back again, and in other steps.
        film.picture(220_000_000).expect("a picture");
        assert_eq!(film.picture(500_000_000).expect("a picture"), first);
    });
}

#[test]
fn the_followed_one_is_in_the_middle() {
    opened(|recording| {
        let choices = Choices {
            follow: Some("bee-123".to_owned()),
            view: View::Side(Side::Top),
            captions: false,
            trail_s: 0.0,
            zoom: 4.0,
            ..orbit()
        };
        let empty = Stage {
            plane: true,
            ..stage()
        };
        let empty = Stage {
            props: Vec::new(),
            ..empty
        };
        let mut film = Film::new(recording, &empty, choices, 0..=2_000_000_000).expect("a film");
        for time_ns in [0, 700_000_000, 1_930_000_000] {
            let picture = film.picture(time_ns).expect("a picture");
            let middle = 3 * (90 * 320 + 160);
            let [r, _, b] = [0, 1, 2].map(|k| picture.rgb[middle + k]);
            // A bee, and not the pale ground.
            assert!(
                r.abs_diff(b) > 30 || r < 90,
                "{:?}",
                &picture.rgb[middle..middle + 3]
            );
        }
    });
}

#[test]
fn only_the_models_asked_for_are_drawn_and_framed() {
    opened(|recording| {
        let drawn = |models: &[&str], grid| {
            let choices = Choices {
                models: models.iter().map(|&text| text.to_owned()).collect(),
                view: View::Side(Side::Top),
                captions: false,
                grid,
                ..orbit()
            };
            let empty = Stage {
                props: Vec::new(),
                ..stage()
            };
            let film = Film::new(recording, &empty, choices, 1_000_000_000..=1_000_000_000);
            film.map(|mut film| film.picture(1_000_000_000).expect("a picture"))
        };
        // Half of the bees are orange, the ground is green.
        let bees = |picture: &Picture| {
            let pixels = picture.rgb.as_chunks::<3>().0.iter();
            pixels.filter(|[r, _, b]| r.saturating_sub(*b) > 60).count()
        };
        let [all, one] = [&[][..], &["bee-8"]].map(|models| drawn(models, false).expect("drawn"));
        assert!(bees(&all) > 1000, "{}", bees(&all));
        // Alone it is seen from near, with its trail.
        assert!((30..1000).contains(&bees(&one)), "{}", bees(&one));
        let two = drawn(&["bee-8", "bee-11?"], false).expect("drawn");
        assert_ne!(two, one);
        assert_ne!(drawn(&["bee-8"], true).expect("drawn"), one, "with a grid");
        let said = drawn(&["bee-8", "wasp-*"], true)
            .expect_err("none")
            .to_string();
        assert!(said.contains("`wasp-*`") && said.contains("300"), "{said}");
    });
}

#[test]
fn a_wall_of_bricks_shows_its_bricks() {
    opened(|recording| {
        let wall = |texture: &str| {
            let mut stage = stage();
            for prop in &mut stage.props {
                prop.texture = texture.to_owned();
                prop.color = [170, 170, 170, 255];
            }
            let choices = Choices {
                view: View::From {
                    eye_m: DVec3::new(-4.0, -6.0, 1.0),
                    at_m: Some(DVec3::new(-4.0, 0.0, 1.0)),
                },
                models: vec!["bee-299".to_owned()],
                captions: false,
                ..orbit()
            };
            let mut film = Film::new(recording, &stage, choices, 0..=0).expect("a film");
            let picture = film.picture(0).expect("a picture");
            // In the middle of the wall.
            let row = &picture.rgb[3 * (90 * 320 + 100)..3 * (90 * 320 + 220)];
            row.as_chunks::<3>().0.to_vec()
        };
        let differ = |row: &[[u8; 3]]| {
            let steps = row
                .windows(2)
                .filter(|pair| pair[0][1].abs_diff(pair[1][1]) > 8);
            steps.count()
        };
        let [bricks, bare, missing] = ["brick", "", "pictures/gone.png"].map(wall);
        assert!(differ(&bricks) >= 4, "{bricks:?}");
        assert!(
            bricks.iter().any(|[r, _, b]| *r > b + 40),
            "red: {bricks:?}"
        );
        assert_eq!(differ(&bare), 0);
        assert_eq!(bare, missing);
    });
}

#[test]
fn the_ground_has_its_picture() {
    opened(|recording| {
        let drawn = |texture: &str| {
            let bare = Stage {
                texture: texture.to_owned(),
                props: Vec::new(),
                ..stage()
            };
            let choices = Choices {
                view: View::Side(Side::Top),
                models: vec!["bee-8".to_owned()],
                captions: false,
                ..orbit()
            };
            let mut film = Film::new(recording, &bare, choices, 0..=0).expect("a film");
            film.picture(0).expect("a picture")
        };
        let colours = |picture: &Picture| {
            let pixels = picture.rgb.as_chunks::<3>().0.iter().copied();
            pixels.collect::<std::collections::BTreeSet<_>>().len()
        };
        let [plain, stone] = ["", "stone"].map(drawn);
        assert!(colours(&stone) > 3 * colours(&plain), "{}", colours(&stone));
        assert_eq!(drawn("gone.png"), plain);
    });
}

#[test]
fn what_is_not_there_says_what_is() {
    opened(|recording| {
        let said = |choices: Choices, times: std::ops::RangeInclusive<u64>| {
            let film = Film::new(recording, &stage(), choices, times);
            film.err().expect("an error").to_string()
        };
        let follow = |path: &str| Choices {
            follow: Some(path.to_owned()),
            ..orbit()
        };
        let metric = |name: &str| Choices {
            colour_by: ColourBy::named(name),
            ..orbit()
        };
        for (text, parts) in [
            (
                said(orbit(), 0..=2_100_000_000),
                ["2.1 s", "from 0 s to 2 s"],
            ),
            (
                said(follow("bee_7"), 0..=0),
                ["`bee_7`", "did you mean `bee-7`?"],
            ),
            (said(follow("queen"), 0..=0), ["300", "`bee-299`"]),
            (
                said(follow("bee-*"), 0..=0),
                ["`bee-*`", "one vehicle, not a pattern"],
            ),
            (
                said(metric("polen"), 0..=0),
                ["`polen`", "did you mean `pollen`?"],
            ),
            (said(metric("battery"), 0..=0), ["`battery`", "pollen"]),
            (
                said(
                    Choices {
                        links: true,
                        ..orbit()
                    },
                    0..=0,
                ),
                ["links", "packets = "],
            ),
            (
                said(
                    Choices {
                        size: [8, 8],
                        ..orbit()
                    },
                    0..=0,
                ),
                ["8 x 8", "16 to 8192"],
            ),
            (
                said(
                    Choices {
                        size: [8192, 8192],
                        fineness: 2,
                        ..orbit()
                    },
                    0..=0,
                ),
                ["256 million", "64 million are the most"],
            ),
        ] {
            for part in parts {
                assert!(text.contains(part), "{part}: {text}");
            }
        }
        assert!(Film::new(recording, &stage(), metric("pollen"), 0..=0).is_ok());
    });
}

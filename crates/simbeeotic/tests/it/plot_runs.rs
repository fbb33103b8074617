//! Pictures of flights and numbers, from recordings whose contents are known.

use crate::program::Program;
use simbeeotic_record::stage::{Form, Piece, Prop};
use simbeeotic_record::{Header, Metric, Metrics, Recorder, Sample, Stage, Vehicle};

const SECOND: u64 = 1_000_000_000;

fn vehicle(path: &str) -> Vehicle {
    Vehicle {
        path: path.to_owned(),
        ..Vehicle::default()
    }
}

/// A box of 4 m by 2 m around (5, 3).
fn stage() -> Stage {
    let block = Piece {
        form: Form::Box {
            half_m: [2.0, 1.0, 1.0],
        },
        position_m: [5.0, 3.0, 1.0],
        attitude: [1.0, 0.0, 0.0, 0.0],
    };
    Stage {
        ground: [120, 150, 90, 255],
        texture: String::new(),
        radius_m: 100.0,
        plane: true,
        props: vec![Prop {
            kind: "obstacle".to_owned(),
            label: "block".to_owned(),
            color: [200, 0, 0, 255],
            pieces: vec![block],
            ..Prop::default()
        }],
    }
}

/// Two bees that fly east at one metre a second for `seconds`, one of them 4 m farther north, and a hive. Both
/// publish `load`: `gain` times the time, and one more for the second.
pub(crate) fn record(program: &Program, name: &str, seed: u64, seconds: u64, gain: f64) {
    let header = Header {
        seed,
        scenario: format!(
            "[run]\nseed = {seed}\n\n[[model]]\nname = \"bee\"\ncount = 2\nuse = \"x\"\n"
        ),
        vehicles: ["bee-0", "bee-1", "hive"].map(vehicle).to_vec(),
        stage: Some(stage()),
        ..Header::default()
    };
    let mut recorder = Recorder::create(program.path(name), header).expect("it can be written");
    for second in 0..=seconds {
        let at = |north: f64, speed: f64| Sample {
            position_m: [speed * second as f64, north, 2.0 * speed],
            velocity_m_s: [speed, 0.0, 0.0],
            ..Sample::default()
        };
        let samples = [at(0.0, 1.0), at(4.0, 1.0), at(2.0, 0.0)];
        recorder.tick(second * SECOND, samples).expect("a tick");
        let metric = |bee: u64| Metric {
            name: format!("bee-{bee}/load"),
            unit: "J".to_owned(),
            value: gain * second as f64 + bee as f64,
        };
        let values = vec![metric(0), metric(1)];
        let time_ns = second * SECOND;
        let metrics = Metrics { time_ns, values };
        recorder.metrics(metrics).expect("metrics");
    }
    recorder.finish(&serde_json::json!({})).expect("an end");
}

pub(crate) fn drawn(program: &Program, arguments: &[&str]) -> String {
    let call = program.call(&[&["plot"], arguments].concat());
    assert_eq!(call.code, Some(0), "{arguments:?}: {}", call.err);
    let output = arguments.iter().position(|word| *word == "-o").expect("-o");
    let svg = std::fs::read_to_string(program.path(arguments[output + 1])).expect("it is there");
    assert!(
        !svg.contains("NaN") && !svg.contains("inf"),
        "{arguments:?}"
    );
    crate::plot::words(&svg);
    svg
}

/// The lines with this colour: the points of each.
pub(crate) fn lines(svg: &str, colour: &str) -> Vec<Vec<[f64; 2]>> {
    let paths = svg
        .lines()
        .filter(|line| line.starts_with("<path") && line.contains(&format!("stroke=\"{colour}\"")));
    paths.map(points).collect()
}

/// The points of a path: a place, then steps.
fn points(path: &str) -> Vec<[f64; 2]> {
    let d = path.split('"').nth(1).expect("d");
    let mut last = [0.0; 2];
    d.trim_start_matches('M')
        .trim_end_matches('z')
        .split('l')
        .map(|pair| {
            let spaced = pair.replace('-', " -");
            let numbers: Vec<f64> = (spaced.split_whitespace())
                .map(|n| n.parse().expect("a number"))
                .collect();
            last = [last[0] + numbers[0], last[1] + numbers[1]];
            last
        })
        .collect()
}

const BLUE: &str = "#0072b2";
const ORANGE: &str = "#e69f00";

#[test]
fn a_straight_flight_is_a_straight_line_of_its_length() {
    let program = Program::new();
    record(&program, "a.mcap", 1, 10, 1.0);
    let svg = drawn(&program, &["traces", "a.mcap", "-o", "a.svg"]);
    let first = lines(&svg, BLUE);
    let second = lines(&svg, ORANGE);
    // The first line of a colour is the flight, the last its key.
    let ([a, b], [c, _]) = ([first[0][0], first[0][1]], [second[0][0], second[0][1]]);
    assert_eq!(
        first[0].len(),
        2,
        "eleven ticks on a straight line are two points"
    );
    assert_eq!(a[1], b[1], "it flies east");
    let metre = (b[0] - a[0]) / 10.0;
    assert!(metre > 20.0, "{metre} pixels a metre");
    assert!(
        (a[1] - c[1] - 4.0 * metre).abs() < 0.1,
        "north is up, at the same scale"
    );
    // The block is where it stands: from 3 m to 7 m east of where the bees start.
    let block = svg
        .lines()
        .find(|line| line.starts_with("<path") && line.contains("fill=\"#d94d4d\""));
    let block = points(block.expect("a footprint of red, paled"));
    let west = block.iter().map(|p| p[0]).fold(f64::INFINITY, f64::min);
    let east = block.iter().map(|p| p[0]).fold(0.0, f64::max);
    assert!((west - a[0] - 3.0 * metre).abs() < 0.1, "{west}");
    assert!((east - a[0] - 7.0 * metre).abs() < 0.1, "{east}");
    let words = crate::plot::words(&svg);
    for word in [
        "bee-0", "bee-1", "hive", "east, m", "north, m", "N", "start", "at rest",
    ] {
        assert!(
            words.iter().any(|w| w == word),
            "{word} is not in {words:?}"
        );
    }
    assert!(words[1].contains("2 flights, 1 at rest"), "{}", words[1]);
}

#[test]
fn every_kind_is_a_png_with_ink_in_it() {
    let program = Program::new();
    record(&program, "a.mcap", 1, 10, 1.0);
    for arguments in [
        &["traces"][..],
        &["traces", "--3d", "--color", "time"],
        &["series", "--metric", "speed"],
        &["histogram", "--metric", "altitude"],
        &["coverage", "--cell", "0.5 m"],
        &["coverage", "--over-time"],
    ] {
        let call = [
            &["plot"],
            arguments,
            &["a.mcap", "-o", "x.png", "--width", "720"],
        ]
        .concat();
        let call = program.call(&call);
        assert_eq!(call.code, Some(0), "{arguments:?}: {}", call.err);
        let bytes = std::fs::read(program.path("x.png")).expect("it is there");
        let picture = tiny_skia::Pixmap::decode_png(&bytes).expect("a PNG");
        assert_eq!(picture.width(), 720);
        // What is seen from the side needs less.
        let cropped = arguments.contains(&"--3d");
        assert_eq!(picture.height() < 700, cropped, "{arguments:?}");
        let white = |p: &&tiny_skia::PremultipliedColorU8| {
            (p.red(), p.green(), p.blue()) == (255, 255, 255)
        };
        let ink = picture.pixels().iter().filter(|p| !white(p)).count();
        assert!(ink > 3_000, "{arguments:?}: {ink} pixels");
        let blue = |p: &&tiny_skia::PremultipliedColorU8| p.blue() > p.red().saturating_add(60);
        let warm = |p: &&tiny_skia::PremultipliedColorU8| p.red() > p.blue().saturating_add(60);
        let coloured = picture
            .pixels()
            .iter()
            .filter(|p| blue(p) || warm(p))
            .count();
        assert!(
            coloured > 100,
            "{arguments:?}: {coloured} pixels with colour"
        );
    }
}

#[test]
fn a_mean_over_runs_has_students_band() {
    let program = Program::new();
    for seed in 1..=3 {
        let gain = seed as f64;
        record(&program, &format!("low-{seed}.mcap"), seed, 10, gain);
        record(&program, &format!("run-{seed}.mcap"), seed, 10, 10.0 + gain);
    }
    let runs = ["run-1.mcap", "run-2.mcap", "run-3.mcap"];
    let series_of = |runs: [&str; 3], more: &[&str]| {
        let arguments = [
            &["series"],
            &runs[..],
            &["-o", "x.svg", "--metric", "load"],
            more,
        ]
        .concat();
        drawn(&program, &arguments)
    };
    let series = |more: &[&str]| series_of(runs, more);
    // The band at 10 s, from 0 s to when the mean goes from 0.5 to `end`.
    let wide = |svg: &str, end: f64| {
        let line = lines(svg, BLUE).remove(0);
        assert_eq!(
            line.len(),
            2,
            "the mean of straight lines is straight: {line:?}"
        );
        let band = svg
            .lines()
            .find(|line| line.contains("fill-opacity=\"0.2\""));
        let band = points(band.expect("a band"));
        let at_end: Vec<f64> = (band.iter())
            .filter(|p| (p[0] - line[1][0]).abs() < 0.02)
            .map(|p| p[1])
            .collect();
        let wide = at_end.iter().fold(0.0, |m: f64, y| m.max(*y))
            - at_end.iter().fold(f64::INFINITY, |m: f64, y| m.min(*y));
        wide / ((line[0][1] - line[1][1]) / (end - 0.5))
    };
    // At 10 s the runs have 110.5, 120.5 and 130.5: mean 120.5, half a band of t(2) * 10 / sqrt(3).
    let half = 4.302_65 * 10.0 / 3.0_f64.sqrt();
    let svg = series(&[]);
    let found = wide(&svg, 120.5);
    assert!((found - 2.0 * half).abs() < 0.2, "{found} {half}");
    // 10.5, 20.5 and 30.5: the same, but what is never below zero has no band there.
    let low = series_of(["low-1.mcap", "low-2.mcap", "low-3.mcap"], &[]);
    let found = wide(&low, 20.5);
    assert!((found - (20.5 + half)).abs() < 0.05, "{found} {half}");
    let words = crate::plot::words(&svg);
    assert!(words[1].contains("3 runs, seeds 1 to 3"), "{}", words[1]);
    assert!(words[1].contains("95 % confidence"), "{}", words[1]);

    let words = crate::plot::words(&series(&["--by", "seed"]));
    for seed in 1..=3 {
        assert!(words.contains(&format!("seed {seed}")), "{words:?}");
    }
    let words = crate::plot::words(&series(&["--by", "model.bee.count"]));
    assert!(!words.iter().any(|w| w.contains("seed =")), "{words:?}");
    series(&["--by", "file", "--each"]);
}

#[test]
fn coverage_of_a_straight_flight_is_its_strip() {
    let program = Program::new();
    record(&program, "a.mcap", 1, 10, 1.0);
    let svg = drawn(
        &program,
        &[
            "coverage",
            "a.mcap",
            "-o",
            "x.svg",
            "--models",
            "bee-0",
            "--cell",
            "0.1 m",
            "--reach",
            "1 m",
            "--area=-5,-5,15,5",
        ],
    );
    // 2 * 1 * 10 + pi = 23.14 of 200 square metres.
    let words = crate::plot::words(&svg);
    assert!(words[1].contains("11.6 % of 200 m²"), "{}", words[1]);
    assert!(svg.contains("data:image/png;base64,"));
}

#[test]
fn a_histogram_says_which_share_has_which_value() {
    let program = Program::new();
    record(&program, "a.mcap", 1, 9, 1.0);
    let svg = drawn(
        &program,
        &[
            "histogram",
            "a.mcap",
            "-o",
            "x.svg",
            "--metric",
            "load",
            "--models",
            "bee-0",
            "--bin",
            "5",
        ],
    );
    let words = crate::plot::words(&svg);
    assert!(words[1].contains("10 values"), "{}", words[1]);
    assert!(words.iter().any(|w| w == "load, J"), "{words:?}");
    assert!(words.iter().any(|w| w == "mean 4.5"), "{words:?}");
    // 0 to 4 and 5 to 9: two bars of one height.
    let bars: Vec<_> = (svg.lines())
        .filter(|line| line.contains("fill=\"#0072b2\" fill-opacity=\"0.65\""))
        .map(points)
        .collect();
    assert_eq!(bars.len(), 2, "{svg}");
    assert_eq!(bars[0][2][1], bars[1][2][1]);
}

#[test]
fn numbers_that_are_not_there_are_named_with_those_that_are() {
    let program = Program::new();
    record(&program, "a.mcap", 1, 3, 1.0);
    record(&program, "b.mcap", 2, 3, 1.0);
    let refused = |arguments: &[&str], told: &str| {
        let call = program.call(&[&["plot"], arguments].concat());
        assert_eq!(call.code, Some(2), "{arguments:?}: {}", call.err);
        assert!(call.err.contains(told), "{told} is not in:\n{}", call.err);
        assert!(!call.err.contains("panicked"), "{}", call.err);
    };
    let series = |metric: &'static str| ["series", "a.mcap", "-o", "x.svg", "--metric", metric];
    refused(&series("sped"), "did you mean \"speed\"?");
    refused(&series("sped"), "metrics: bee-*/load");
    refused(&series("loda"), "did you mean \"load\"?");
    refused(&series("packets/snet"), "did you mean packets/sent?");
    refused(&series("packets/sent"), "no counters of radios");
    refused(&series("distance:hvie"), "did you mean distance:hive?");
    let models = ["traces", "a.mcap", "-o", "x.svg", "--models", "wasp-*"];
    refused(&models, "no path in a.mcap matches \"wasp-*\"");
    let late = ["traces", "a.mcap", "-o", "x.svg", "--from", "1 h"];
    refused(&late, "no positions between these times");
    let by = [
        "series",
        "a.mcap",
        "b.mcap",
        "-o",
        "x.svg",
        "--metric",
        "speed",
        "--by",
        "model.bee.cuont",
    ];
    refused(&by, "did you mean `count`?");
    let unit = [
        "histogram",
        "a.mcap",
        "-o",
        "x.svg",
        "--metric",
        "speed",
        "--metric",
        "z",
    ];
    refused(&unit, "different units");
    let at = [
        "histogram",
        "a.mcap",
        "-o",
        "x.svg",
        "--metric",
        "speed",
        "--at",
        "9 s",
    ];
    refused(&at, "nobody has a value of speed then");
    let cell = ["coverage", "a.mcap", "-o", "x.svg", "--cell", "1 um"];
    refused(&cell, "too many");
    let area = ["coverage", "a.mcap", "-o", "x.svg", "--area=1,2,0,3"];
    refused(&area, "west,south,east,north");
    assert!(!program.path("x.svg").exists());
}

#[test]
fn one_tick_is_a_picture_and_none_is_an_error() {
    let program = Program::new();
    record(&program, "one.mcap", 1, 0, 1.0);
    for arguments in [
        &["traces", "one.mcap", "-o", "x.svg"][..],
        &["traces", "one.mcap", "-o", "x.svg", "--3d"],
        &["series", "one.mcap", "-o", "x.svg", "--metric", "speed"],
        &["histogram", "one.mcap", "-o", "x.svg", "--metric", "speed"],
        &["coverage", "one.mcap", "-o", "x.svg"],
        &["coverage", "one.mcap", "-o", "x.svg", "--over-time"],
    ] {
        drawn(&program, arguments);
    }
    let header = Header {
        vehicles: vec![vehicle("bee")],
        ..Header::default()
    };
    let recorder = Recorder::create(program.path("none.mcap"), header).expect("a file");
    recorder.finish(&serde_json::json!({})).expect("an end");
    for kind in ["traces", "coverage"] {
        let call = program.call(&["plot", kind, "none.mcap", "-o", "y.svg"]);
        assert_eq!(call.code, Some(2), "{}", call.err);
        assert!(
            call.err.contains("none.mcap has no positions"),
            "{}",
            call.err
        );
    }
    let call = program.call(&[
        "plot",
        "series",
        "none.mcap",
        "-o",
        "y.svg",
        "--metric",
        "speed",
    ]);
    assert_eq!(call.code, Some(2), "{}", call.err);
    assert!(call.err.contains("no values of speed"), "{}", call.err);
}

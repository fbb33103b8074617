//! What a recording says of a run: the wind around the swarm, and the same of equal runs.

use crate::program::Program;
use simbeeotic::record::{Recording, Wind};

/// Bees in a wind from the west that grows with height, and the recorder looks every 400 ms.
const WINDY: &str = r#"
[run]
seed = 3
end_time = "2.5 s"

[weather]
use = "atmosphere"
wind = ["3 m/s", "-1 m/s", "0 m/s"]
profile = { power = { exponent = 0.2 } }

[[model]]
use = "broadcast-bee"
name = "bee"
count = 12
start = { ball = "3 m", center = ["20 m", "-40 m", "10 m"] }

[model.sensor.compass]
use = "compass"
rate = "5 Hz"

[model.radio]
use = "cc2420"

[channel]
medium = "ieee802154"

[[component]]
use = "recorder"
path = "run.mcap"
period = "400 ms"
readings = ["*"]
"#;

fn recorded(text: &str, more: &[&str]) -> Recording {
    let program = Program::new();
    program.write("run.toml", text);
    program.summary(&[&["run.toml"], more].concat());
    Recording::open(program.path("run.mcap")).expect("a recording")
}

fn winds(recording: &Recording) -> Vec<Wind> {
    let winds = recording.wind_in(0..=u64::MAX);
    winds.collect::<Result<_, _>>().expect("it is whole")
}

#[test]
fn the_wind_around_the_swarm_is_recorded_each_second() {
    let recording = recorded(WINDY, &[]);
    let winds = winds(&recording);
    let times: Vec<u64> = winds.iter().map(|wind| wind.time_ns / 1_000_000).collect();
    assert_eq!(times, [0, 1000, 2000]);
    let ticks: Vec<u64> = recording
        .ticks()
        .flatten()
        .map(|t| t.time_ns / 1_000_000)
        .collect();
    assert_eq!(
        ticks,
        [0, 400, 800, 1200, 1600, 2000, 2400],
        "they have a clock of their own"
    );
    for wind in &winds {
        assert_eq!(wind.arrows.len(), 192);
        for [x, y, z, east, north, up] in &wind.arrows {
            assert!((0.0..40.0).contains(x) && (-60.0..-20.0).contains(y) && *z >= 0.5);
            assert!((east / north + 3.0).abs() < 1e-4 && up.abs() < 1e-6);
        }
        // More of it above.
        let (low, high) = (wind.arrows[0], wind.arrows[191]);
        assert!(low[2] < high[2] && low[3] < high[3]);
    }
}

#[test]
fn there_is_no_wind_in_recordings_where_it_is_calm_or_not_wanted() {
    let calm = WINDY.replace("wind = [\"3 m/s\", \"-1 m/s\", \"0 m/s\"]\n", "");
    let calm = calm.replace("profile = { power = { exponent = 0.2 } }\n", "");
    assert!(winds(&recorded(&calm, &[])).is_empty());
    let off = ["--set", "component.recorder.wind_period=0 s"];
    assert!(winds(&recorded(WINDY, &off)).is_empty());
    let slow = ["--set", "component.recorder.wind_period=2 s"];
    assert_eq!(winds(&recorded(WINDY, &slow)).len(), 2);
}

#[test]
fn recordings_of_equal_runs_say_the_same() {
    let all = |recording: &Recording| {
        let all = 0..=u64::MAX;
        let text = [
            format!("{:?}", recording.vehicles()),
            format!("{:?}", recording.ticks().flatten().collect::<Vec<_>>()),
            format!("{:?}", recording.events().flatten().collect::<Vec<_>>()),
            format!("{:?}", recording.log().flatten().collect::<Vec<_>>()),
            format!("{:?}", recording.metrics().flatten().collect::<Vec<_>>()),
            format!("{:?}", recording.readings().flatten().collect::<Vec<_>>()),
            format!(
                "{:?}",
                recording
                    .packets_in(all.clone())
                    .flatten()
                    .collect::<Vec<_>>()
            ),
            format!(
                "{:?}",
                recording
                    .traffic_in(all.clone())
                    .flatten()
                    .collect::<Vec<_>>()
            ),
            format!(
                "{:?}",
                recording.links_in(all).flatten().collect::<Vec<_>>()
            ),
            format!("{:?}", winds(recording)),
        ];
        for (at, what) in [(1, "ticks"), (5, "readings"), (6, "packets"), (9, "wind")] {
            assert!(text[at].len() > 1000, "{what}: {}", text[at]);
        }
        text
    };
    let first = all(&recorded(WINDY, &["--threads", "1"]));
    let second = all(&recorded(WINDY, &["--threads", "3"]));
    let other = all(&recorded(WINDY, &["--seed", "4"]));
    assert_eq!(first, second);
    assert_ne!(first[1], other[1], "another seed flies otherwise");
    assert_ne!(first[6], other[6]);
}

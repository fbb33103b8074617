//! What a recording has of the air: packets, links and counters of a swarm that can be counted by hand.

use crate::program::{Program, shipped};

/// Three bees that hang in a row, 10 m apart, and speak at 0, 1 and 2 s; they hear each other up to 15 m.
const ROW: &str = r#"
[run]
seed = 3
end_time = "2.5 s"

[channel]
use = "free-space"
medium = "simple"
range_limit = "15 m"
noise_floor = { mean = "-100 dBm", sigma = "0 dB" }

[[model]]
use = "broadcast-bee"
name = "bee"
count = 3
start = { grid = [3, 1, 1], spacing = "10 m", from = ["0 m", "0 m", "5 m"] }
params = { drift_sigma = "0 m/s" }

[model.radio]
use = "cc2420"
channel = 15

[[component]]
use = "recorder"
path = "row.mcap"
period = "300 ms"
radios = ["bee-1"]
"#;

/// The rows of a table behind its header, by name of column.
fn table(csv: &str) -> Vec<Vec<(&str, &str)>> {
    let mut lines = csv.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    lines
        .map(|line| header.iter().copied().zip(line.split(',')).collect())
        .collect()
}

fn field<'a>(row: &[(&str, &'a str)], name: &str) -> &'a str {
    let mut fields = row.iter();
    fields
        .find(|(column, _)| *column == name)
        .unwrap_or_else(|| panic!("no column {name}"))
        .1
}

fn number(row: &[(&str, &str)], name: &str) -> f64 {
    field(row, name).parse().expect("a number")
}

/// Free space at 2.425 GHz, channel 15, from 0 dBm.
fn rssi_dbm(distance_m: f64) -> f64 {
    let wavelength_m = 299_792_458.0 / 2.425e9;
    20.0 * simbeeotic_units::math::log10(wavelength_m / (4.0 * std::f64::consts::PI * distance_m))
}

fn flown() -> Program {
    let program = Program::new();
    program.write("row.toml", ROW);
    program.summary(&["row.toml"]);
    program
}

fn exported(program: &Program, which: &str, more: &[&str]) -> String {
    let call = program.call(&[&["export", "row.mcap", which], more].concat());
    assert_eq!(call.code, Some(0), "{}", call.err);
    call.out
}

#[test]
fn each_packet_is_recorded_with_those_who_received_it() {
    let program = flown();
    let text = exported(&program, "--packets", &[]);
    let rows = table(&text);
    let told: Vec<_> = rows
        .iter()
        .map(|row| {
            (
                field(row, "time_s"),
                field(row, "sender"),
                field(row, "receiver"),
            )
        })
        .collect();
    let mut expected = Vec::new();
    for time in ["0", "1", "2"] {
        expected.extend([
            (time, "bee-0", "bee-1/radio"),
            (time, "bee-1", "bee-0/radio"),
            (time, "bee-1", "bee-2/radio"),
            (time, "bee-2", "bee-1/radio"),
        ]);
    }
    assert_eq!(told, expected);
    for row in &rows {
        assert_eq!(field(row, "channel"), "15");
        assert_eq!(field(row, "destination"), "", "for everybody");
        // "bee-0"
        assert_eq!(field(row, "payload_bytes"), "5");
        let (bytes, airtime_s) = (number(row, "bytes"), number(row, "airtime_s"));
        assert!((airtime_s - bytes * 32e-6).abs() < 1e-12, "250 kbit/s");
        assert!((number(row, "rssi_dbm") - rssi_dbm(10.0)).abs() < 1e-3);
        assert!((number(row, "snr_db") - (rssi_dbm(10.0) + 100.0)).abs() < 1e-3);
        let east = field(row, "sender")[4..].parse::<f64>().expect("a number") * 10.0;
        let place = ["x_m", "y_m", "z_m"].map(|axis| number(row, axis));
        // A grid is where bees stand: their centre is a radius of 5 cm higher.
        assert_eq!(place, [east, 0.0, 5.05]);
    }
}

#[test]
fn links_have_each_ordered_pair_that_could_have_heard() {
    let program = flown();
    let text = exported(&program, "--links", &[]);
    let rows = table(&text);
    let mut expected = Vec::new();
    // The packets of second 0 end within the first period, and so on.
    for time in ["1", "2", "2.5"] {
        for (from, to) in [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)] {
            expected.push((
                time.to_owned(),
                format!("bee-{from}/radio"),
                format!("bee-{to}/radio"),
            ));
        }
    }
    let pairs: Vec<_> = rows
        .iter()
        .map(|row| ["time_s", "from", "to"].map(|name| field(row, name).to_owned()))
        .map(|[time, from, to]| (time, from, to))
        .collect();
    assert_eq!(pairs, expected);
    for row in &rows {
        let ends = ["from", "to"].map(|end| field(row, end)[4..5].parse::<i32>().expect("a digit"));
        let distance = f64::from((ends[0] - ends[1]).abs()) * 10.0;
        assert_eq!(number(row, "distance_m"), distance);
        assert_eq!(field(row, "sent"), "1");
        if distance == 10.0 {
            assert_eq!(field(row, "received"), "1");
            assert!((number(row, "rssi_dbm") - rssi_dbm(10.0)).abs() < 1e-3);
        } else {
            assert_eq!(
                (field(row, "received"), field(row, "rssi_dbm")),
                ("0", "NaN")
            );
        }
    }
}

#[test]
fn counters_tell_what_became_of_each_frame_in_each_second() {
    let program = flown();
    let text = exported(&program, "--radio", &[]);
    let rows = table(&text);
    let told: Vec<_> = rows
        .iter()
        .map(|row| {
            [
                "time_s",
                "period_s",
                "radio",
                "sent",
                "received",
                "lost_out_of_range",
                "lost_noise",
            ]
            .map(|name| field(row, name))
        })
        .collect();
    let expected = [
        ["0", "0", "", "3", "4", "2", "0"],
        ["0", "0", "bee-1/radio", "1", "2", "0", "0"],
        ["1", "1", "", "3", "4", "2", "0"],
        ["1", "1", "bee-1/radio", "1", "2", "0", "0"],
        ["2", "1", "", "3", "4", "2", "0"],
        ["2", "1", "bee-1/radio", "1", "2", "0", "0"],
        ["2.5", "0.5", "", "0", "0", "0", "0"],
        ["2.5", "0.5", "bee-1/radio", "0", "0", "0", "0"],
    ];
    assert_eq!(told, expected);
}

#[test]
fn tables_of_the_air_are_selected_by_sender_and_time_and_may_be_parquet() {
    let program = flown();
    let some = ["--model", "bee-1", "--from", "1 s", "--to", "1.5 s"];
    let text = exported(&program, "--packets", &some);
    assert_eq!(table(&text).len(), 2, "{text}");
    for which in ["--packets", "--links", "--radio"] {
        exported(&program, which, &["table.parquet"]);
        let bytes = std::fs::read(program.path("table.parquet")).expect("it is there");
        assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
    }
    let call = program.call(&["export", "row.mcap", "--packets", "--model", "wasp"]);
    assert_eq!(call.code, Some(1));
    assert!(call.err.contains("\"bee-2/radio\""), "{}", call.err);
    let call = program.call(&["export", "row.mcap", "--links", "row.mcap"]);
    assert!(call.err.contains("the recording itself"), "{}", call.err);
}

#[test]
fn recording_the_air_changes_nothing() {
    let program = Program::new();
    program.write("row.toml", ROW);
    let bare = program.trace(&["row.toml", "--no-record"]);
    for set in [
        "component.recorder.packets=[]",
        "component.recorder.packets=[\"*\"]",
        "component.recorder.radio_period=\"70 ms\"",
        "component.recorder.radios=[\"*\"]",
    ] {
        assert_eq!(bare, program.trace(&["row.toml", "--set", set]), "{set}");
    }
}

#[test]
fn what_is_not_recorded_is_said_with_the_way_to_have_it() {
    let program = Program::new();
    program.write("row.toml", ROW);
    program.summary(&["row.toml", "--set", "component.recorder.packets=[]"]);
    for which in ["--packets", "--links"] {
        let call = program.call(&["export", "row.mcap", which]);
        assert_eq!(call.code, Some(1));
        assert!(call.err.contains("`packets = "), "{}", call.err);
    }
    let wrong = "component.recorder.packets=[\"wasp-*\"]";
    let call = program.call(&["run", "row.toml", "--set", wrong]);
    assert_eq!(call.code, Some(2));
    assert!(
        call.err
            .contains("there are 3, from \"bee-0/radio\" to \"bee-2/radio\""),
        "{}",
        call.err
    );
    let call = program.call(&[
        "run",
        "row.toml",
        "--set",
        "component.recorder.radio_period=0 s",
    ]);
    assert_eq!(call.code, Some(2), "{}", call.err);
}

#[test]
fn packets_links_and_counters_agree_with_the_summary_on_every_medium() {
    let program = Program::new();
    let scenario = shipped("scenarios/talk.toml");
    for medium in ["simple", "ieee802154"] {
        let set = format!("channel.medium={medium}");
        let run = [
            scenario.as_str(),
            "--end-time",
            "4.5 s",
            "--record",
            "row.mcap",
        ];
        let summary = program.summary(&[&run[..], &["--set", &set]].concat());
        let told = |key: &str| summary["packets"][key].as_f64().expect("a number");

        let text = exported(&program, "--packets", &[]);
        let rows = table(&text);
        let received = rows.iter().filter(|row| !field(row, "receiver").is_empty());
        assert_eq!(
            received.clone().count() as f64,
            told("received"),
            "{medium}"
        );
        let mut sent: Vec<_> = rows
            .iter()
            .map(|row| (field(row, "radio"), field(row, "time_ns")))
            .collect();
        sent.sort_unstable();
        sent.dedup();
        assert_eq!(sent.len() as f64, told("sent"), "{medium}");
        for row in received {
            let delay_s = number(row, "received_s") - number(row, "time_s");
            let airtime_s = match medium {
                "simple" => 0.0,
                _ => number(row, "airtime_s"),
            };
            assert!((delay_s - airtime_s).abs() < 1e-8, "{medium}: {delay_s}");
        }

        let text = exported(&program, "--links", &[]);
        let sum: f64 = table(&text).iter().map(|row| number(row, "received")).sum();
        assert_eq!(sum, told("received"), "{medium}");
        let text = exported(&program, "--radio", &[]);
        for key in ["sent", "received"] {
            let sum: f64 = table(&text).iter().map(|row| number(row, key)).sum();
            assert_eq!(sum, told(key), "{medium}");
        }
    }
}

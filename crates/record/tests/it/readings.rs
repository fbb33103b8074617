//! Readings and pictures: as recorded, so read; and as a table.

use simbeeotic_model::{Image, Pixels};
use simbeeotic_record::{
    Header, Picture, Reading, Recorder, Recording, Selection, export_readings, export_readings_file,
};
use std::path::Path;

fn reading(sensor: &str, step: u64) -> Reading {
    let value = step as f64;
    Reading {
        time_ns: step * 10_000_000,
        sensor: sensor.to_owned(),
        names: vec!["forward".into(), "left".into()],
        units: vec!["m/s^2".into(); 2],
        truth: vec![value, -value],
        reading: vec![value + 0.5, f64::NAN],
        ..Reading::default()
    }
}

fn picture(step: u64) -> Picture {
    Picture {
        time_ns: step * 10_000_000,
        path: "bee-0/camera/depth".into(),
        image: Image {
            width: 2,
            height: 1,
            pixels: Pixels::Depth([step as f32, f32::INFINITY].into()),
        },
    }
}

fn record(path: &Path) -> Recording {
    let mut recorder = Recorder::create(path, Header::default()).expect("it can be made");
    for step in 0..10 {
        recorder
            .reading(reading("bee-0/imu", step))
            .expect("written");
        recorder
            .reading(reading("bee-1/imu", step))
            .expect("written");
        recorder.picture(picture(step)).expect("written");
    }
    recorder.finish(&serde_json::Value::Null).expect("finished");
    Recording::open(path).expect("it opens")
}

#[test]
fn readings_and_pictures_come_back_as_they_were() {
    let folder = tempfile::tempdir().expect("a folder");
    let recording = record(&folder.path().join("run.mcap"));
    let readings: Vec<_> = recording.readings().map(|r| r.expect("whole")).collect();
    assert_eq!(readings.len(), 20);
    let third = &readings[6];
    let wanted = reading("bee-0/imu", 3);
    assert_eq!(
        (&third.sensor, &third.truth),
        (&wanted.sensor, &wanted.truth)
    );
    assert_eq!((&third.names, &third.units), (&wanted.names, &wanted.units));
    assert!(third.reading[0] == 3.5 && third.reading[1].is_nan());

    let pictures: Vec<_> = (recording.pictures_in(20_000_000..=40_000_000))
        .map(|p| p.expect("whole"))
        .collect();
    assert_eq!(pictures, [picture(2), picture(3), picture(4)]);
}

#[test]
fn the_table_has_a_row_for_each_number() {
    let folder = tempfile::tempdir().expect("a folder");
    let recording = record(&folder.path().join("run.mcap"));
    let selection = Selection {
        every: 5.try_into().expect("not zero"),
        models: vec!["bee-1".into()],
        ..Selection::default()
    };
    let mut text = Vec::new();
    let exported = export_readings(&recording, &selection, &mut text).expect("exported");
    assert_eq!((exported.rows, exported.ticks), (4, 2));
    let text = String::from_utf8(text).expect("text");
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(
        lines,
        [
            "time_s,time_ns,sensor,row,quantity,unit,truth,reading,lost",
            "0,0,bee-1/imu,0,forward,m/s^2,0,0.5,0",
            "0,0,bee-1/imu,0,left,m/s^2,-0,NaN,0",
            "0.05,50000000,bee-1/imu,0,forward,m/s^2,5,5.5,0",
            "0.05,50000000,bee-1/imu,0,left,m/s^2,-5,NaN,0",
        ]
    );

    let path = folder.path().join("readings.csv");
    let nobody = Selection {
        models: vec!["wasp".into()],
        ..Selection::default()
    };
    let error = export_readings_file(&recording, &nobody, &path).expect_err("no such sensor");
    assert!(error.to_string().contains("bee-0/imu"), "{error}");
    assert!(!path.exists(), "nothing is published");
}

/// The table of one reading.
fn table(reading: Reading) -> Vec<String> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let mut recorder = Recorder::create(&path, Header::default()).expect("it can be made");
    recorder.reading(reading).expect("written");
    recorder.finish(&serde_json::Value::Null).expect("finished");
    let recording = Recording::open(&path).expect("it opens");
    let mut text = Vec::new();
    export_readings(&recording, &Selection::default(), &mut text).expect("exported");
    let text = String::from_utf8(text).expect("text");
    text.lines().skip(1).map(str::to_owned).collect()
}

#[test]
fn what_was_found_stands_apart_from_what_was_there() {
    // Of anchors 0 and 1 the second answers: its distance must not stand beside that of the first.
    let rows = table(Reading {
        sensor: "bee/uwb".into(),
        names: vec!["anchor".into(), "distance".into()],
        units: vec!["1".into(), "m".into()],
        truth: vec![0.0, 4.0, 1.0, 9.0],
        reading: vec![1.0, 9.1],
        unpaired: true,
        ..Reading::default()
    });
    let expected = [
        "0,0,bee/uwb,0,anchor,1,0,,0",
        "0,0,bee/uwb,0,distance,m,4,,0",
        "0,0,bee/uwb,1,anchor,1,1,,0",
        "0,0,bee/uwb,1,distance,m,9,,0",
        "0,0,bee/uwb,0,anchor,1,,1,0",
        "0,0,bee/uwb,0,distance,m,,9.1,0",
    ];
    assert_eq!(rows, expected);
}

#[test]
fn a_lost_measurement_has_a_truth_and_no_reading() {
    let lost = Reading {
        reading: Vec::new(),
        lost: true,
        ..reading("bee/imu", 2)
    };
    let expected = [
        "0.02,20000000,bee/imu,0,forward,m/s^2,2,,1",
        "0.02,20000000,bee/imu,0,left,m/s^2,-2,,1",
    ];
    assert_eq!(table(lost), expected);
}

#[test]
fn a_table_of_nothing_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let recording = record(&folder.path().join("run.mcap"));
    let late = Selection {
        times_ns: 10_000_000_000..=u64::MAX,
        ..Selection::default()
    };
    let error = export_readings(&recording, &late, &mut Vec::new()).expect_err("nothing then");
    assert!(error.to_string().contains("between these times"), "{error}");

    let path = folder.path().join("empty.mcap");
    let recorder = Recorder::create(&path, Header::default()).expect("it can be made");
    recorder.finish(&serde_json::Value::Null).expect("finished");
    let recording = Recording::open(&path).expect("it opens");
    let error = export_readings(&recording, &Selection::default(), &mut Vec::new());
    let error = error.expect_err("it has none").to_string();
    assert!(error.contains("rate"), "{error}");
}

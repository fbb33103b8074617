//! What stands in the world, what vehicles look like, what models are: written once, read back; and files
//! of before they were.

use crate::swarm;
use prost::Message;
use simbeeotic_model::{About, AboutPart, AboutRadio, AboutSensor, Beams};
use simbeeotic_record::stage::{Form, Piece, Prop};
use simbeeotic_record::{Header, Recorder, Recording, Stage};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

fn ball(radius_m: f64, position_m: [f64; 3]) -> Piece {
    Piece {
        position_m,
        ..Piece::at_origin(Form::Sphere { radius_m })
    }
}

fn meadow(flowers: usize) -> Stage {
    let place = |k: usize| [(k % 317) as f64 / 7.0, (k / 317) as f64 / 3.0, 0.25];
    let tower = Prop {
        kind: "obstacle".into(),
        label: "tower".into(),
        color: [1, 2, 3, 4],
        texture: "brick".into(),
        pieces: vec![Piece::at_origin(
            Form::Sphere { radius_m: 1.0 }.triangles(9).into(),
        )],
        meta: vec![("height".into(), "12".into())],
    };
    let flower = |k| Prop {
        kind: "flower".into(),
        color: [255, 102, 151, 255],
        pieces: vec![
            ball(0.5, place(k)),
            Piece {
                position_m: place(k),
                ..Piece::at_origin(Form::Cylinder {
                    radius_m: 0.25,
                    top_m: 0.25,
                    half_height_m: 2.0,
                })
            },
        ],
        ..Prop::default()
    };
    Stage {
        ground: [20, 70, 30, 255],
        texture: "grass".to_owned(),
        radius_m: 123.25,
        plane: true,
        props: std::iter::once(tower)
            .chain((0..flowers).map(flower))
            .collect(),
    }
}

fn about() -> About {
    About {
        parts: vec![AboutPart {
            place: "model".into(),
            name: "instrument-bee".into(),
            parameters: vec![("use_radio".into(), "true".into())],
        }],
        sensors: vec![AboutSensor {
            name: "range".into(),
            beams: Some(Beams::Ball { range_m: 3.0 }),
            ..AboutSensor::default()
        }],
        radios: vec![AboutRadio {
            name: "radio".into(),
            id: None,
        }],
    }
}

/// A swarm in two looks, in a world, with something known about all but the last.
fn header(vehicles: usize, flowers: usize) -> Header {
    let mut header = swarm::header(vehicles);
    let looks: [Arc<[Piece]>; 2] = [
        [ball(0.5, [0.0; 3])].into(),
        [ball(0.25, [1.0, 0.0, 0.0]), ball(0.25, [-1.0, 0.0, 0.0])].into(),
    ];
    for (k, vehicle) in header.vehicles.iter_mut().enumerate() {
        vehicle.role = if k % 3 == 2 { "station" } else { "vehicle" }.into();
        vehicle.color = [k as u8, 200, 0, 255];
        vehicle.pieces = match k % 3 {
            2 => Arc::new([]),
            look => looks[look].clone(),
        };
    }
    let known = header.vehicles.iter().take(vehicles - 1);
    header.models = vec![(known.map(|v| v.path.clone()).collect(), about())];
    header.stage = Some(meadow(flowers));
    header
}

fn write(path: &Path, header: Header) -> u64 {
    let count = header.vehicles.len();
    let mut recorder = Recorder::create(path, header).expect("created");
    recorder
        .tick(0, swarm::samples(0, count))
        .expect("recorded");
    recorder
        .finish(&serde_json::Value::Null)
        .expect("finished")
        .bytes
}

#[test]
fn world_looks_and_models_are_read_back_as_they_were() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let header = header(7, 10);
    write(&path, header.clone());

    let recording = Recording::open(&path).expect("opens");
    assert_eq!(recording.vehicles(), header.vehicles);
    let [first, .., fourth] = &recording.vehicles()[..4] else {
        panic!("four vehicles");
    };
    assert!(
        Arc::ptr_eq(&first.pieces, &fourth.pieces),
        "looks are shared"
    );
    assert_eq!(recording.stage().expect("readable"), header.stage);
    let known = recording.about(0).expect("readable").expect("known");
    assert_eq!(*known, about());
    let other = recording.about(5).expect("readable").expect("known");
    assert!(Arc::ptr_eq(&known, &other), "equal ones are shared");
    assert_eq!(recording.about(6).expect("readable"), None);
    assert_eq!(recording.about(7).expect("readable"), None);
    assert_eq!(recording.ticks().count(), 1);
}

#[test]
fn a_meadow_of_a_hundred_thousand_flowers_takes_a_few_megabytes_and_a_chunk_of_its_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let header = header(3, 100_000);
    let bytes = write(&path, header.clone());
    assert!(bytes < 8_000_000, "{bytes} bytes");
    let recording = Recording::open(&path).expect("opens");
    let stage = recording.stage().expect("readable").expect("there");
    assert_eq!(stage.props.len(), 100_001);
    assert!(Some(stage) == header.stage, "as it was");
    let file = std::fs::read(&path).expect("there");
    let summary = mcap::Summary::read(&file)
        .expect("readable")
        .expect("there");
    assert!(summary.chunk_indexes.len() >= 2);
    let least = summary
        .chunk_indexes
        .iter()
        .map(|chunk| chunk.uncompressed_size)
        .min();
    assert!(
        least < Some(100_000),
        "vehicles are found without unpacking the world"
    );
}

#[test]
fn a_damaged_world_is_an_error_and_costs_nothing_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    write(&path, header(3, 20_000));
    let mut file = std::fs::read(&path).expect("there");
    let summary = mcap::Summary::read(&file)
        .expect("readable")
        .expect("there");
    let largest = (summary.chunk_indexes.iter())
        .max_by_key(|chunk| chunk.uncompressed_size)
        .expect("there are chunks");
    let middle = largest.chunk_start_offset + largest.chunk_length / 2;
    file[middle as usize] ^= 0x10;
    std::fs::write(&path, &file).expect("written");

    let recording = Recording::open(&path).expect("opens");
    assert_eq!(recording.vehicles().len(), 3);
    let error = recording.stage().expect_err("damaged").to_string();
    assert!(error.contains("is damaged at byte"), "{error}");
    assert!(recording.about(0).is_ok());
    assert_eq!(recording.ticks().filter(Result::is_ok).count(), 1);
}

/// `simbeeotic.Vehicles` as it was written before looks and roles were.
#[derive(Clone, PartialEq, Message)]
struct OldVehicles {
    #[prost(string, repeated, tag = "1")]
    paths: Vec<String>,
    #[prost(string, repeated, tag = "2")]
    kinds: Vec<String>,
    #[prost(double, repeated, tag = "3")]
    radius_m: Vec<f64>,
}

#[test]
fn a_recording_of_before_there_were_worlds_in_them_opens() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("old.mcap");
    let mut file = std::fs::File::create(&path).expect("created");
    let mut writer = mcap::Writer::new(&mut file).expect("a writer");
    let channel = writer
        .add_channel(0, "/vehicles", "protobuf", &BTreeMap::new())
        .expect("a channel");
    let list = OldVehicles {
        paths: vec!["bee-0".into(), "hive".into()],
        kinds: vec!["inert-bee".into(), "hive".into()],
        radius_m: vec![0.5, 2.0],
    };
    let header = mcap::records::MessageHeader {
        channel_id: channel,
        sequence: 0,
        log_time: 0,
        publish_time: 0,
    };
    writer
        .write_to_known_channel(&header, &list.encode_to_vec())
        .expect("written");
    writer.finish().expect("finished");
    drop(writer);

    let recording = Recording::open(&path).expect("opens");
    let [bee, hive] = recording.vehicles() else {
        panic!("two vehicles");
    };
    assert_eq!((bee.path.as_str(), bee.radius_m), ("bee-0", 0.5));
    assert_eq!((hive.kind.as_str(), hive.role.as_str()), ("hive", ""));
    assert_eq!((bee.color, bee.pieces.len()), ([0; 4], 0));
    assert_eq!(recording.stage().expect("readable"), None);
    assert_eq!(recording.about(0).expect("readable"), None);
}

#[test]
fn the_points_of_a_world_lie_in_a_cloud_that_viewers_know() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    write(&path, header(1, 100));
    let file = std::fs::read(&path).expect("there");
    let summary = mcap::Summary::read(&file)
        .expect("readable")
        .expect("there");
    let schema = |topic: &str| {
        let channel = summary
            .channels
            .values()
            .find(|c| c.topic == topic)
            .expect("there");
        channel.schema.as_ref().expect("there").name.clone()
    };
    assert_eq!(schema("/world"), "foxglove.SceneUpdate");
    assert_eq!(schema("/world/points"), "foxglove.PointCloud");
    assert_eq!(schema("/models"), "simbeeotic.About");
    assert_eq!(schema("/robot_description"), "std_msgs/msg/String");
    assert_eq!(schema("/poses/points"), "foxglove.PointCloud");
    let topics: Vec<String> = mcap::MessageStream::new(&file)
        .expect("a stream")
        .map(|message| message.expect("readable").channel.topic.clone())
        .collect();
    assert_eq!(
        topics[..5],
        [
            "/vehicles",
            "/world",
            "/world/points",
            "/robot_description",
            "/models"
        ]
    );
}

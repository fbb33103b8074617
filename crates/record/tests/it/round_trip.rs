//! What goes in comes out.

use crate::swarm::{self, TICK_NS};
use simbeeotic_record::{Header, Precision, ReadError, RecordError, Recorder, Recording, Tick};

#[test]
fn what_is_recorded_is_read_back_bit_by_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let stats = swarm::record(&path, swarm::header(37), 250);

    let recording = Recording::open(&path).expect("opens");
    assert!(!recording.truncated());
    assert_eq!(recording.vehicles(), swarm::vehicles(37));
    assert_eq!(recording.version(), Some("0.1.0"));
    assert_eq!(recording.seed(), Some(111_982));
    assert_eq!(recording.scenario(), Some("[run]\nseed = 111982\n"));
    assert_eq!(recording.metadata("run").expect("there")["host"], "wüste");
    assert_eq!(recording.summary().expect("there")["events"], 17);
    assert_eq!(recording.end_ns(), 249 * TICK_NS);
    assert_eq!(
        recording.attachments().expect("readable"),
        swarm::header(0).files
    );

    let ticks: Vec<Tick> = recording
        .ticks()
        .collect::<Result<_, _>>()
        .expect("readable");
    assert_eq!(ticks.len(), 250);
    for (number, tick) in (0..).zip(&ticks) {
        assert_eq!(tick.time_ns, number * TICK_NS);
        assert!(tick.samples.iter().copied().eq(swarm::samples(number, 37)));
    }

    let events: Vec<_> = recording
        .events()
        .collect::<Result<_, _>>()
        .expect("readable");
    let log: Vec<_> = recording.log().collect::<Result<_, _>>().expect("readable");
    let metrics: Vec<_> = recording
        .metrics()
        .collect::<Result<_, _>>()
        .expect("readable");
    let marked = || (0..250).filter(|tick| tick % 10 == 3);
    assert!(events.into_iter().eq(marked().map(swarm::event)));
    assert!(log.into_iter().eq(marked().map(swarm::log)));
    assert!(metrics.into_iter().eq(marked().map(swarm::metrics)));

    assert_eq!(stats.ticks, 250);
    assert_eq!(stats.messages, 1 + 3 * 250 + 3 * 25);
    assert_eq!(stats.safe_until_ns, Some(249 * TICK_NS));
    assert_eq!(stats.bytes, path.metadata().expect("there").len());
}

#[test]
fn a_part_of_the_time_is_found_in_a_recording_of_many_chunks() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    // 120 ticks of 93 kB: about twelve chunks.
    swarm::record(&path, swarm::header(1000), 120);

    let recording = Recording::open(&path).expect("opens");
    let times = |range| {
        let ticks = recording.ticks_in(range);
        ticks
            .map(|tick| tick.expect("readable").time_ns)
            .collect::<Vec<_>>()
    };
    assert_eq!(times(0..=0), [0]);
    assert_eq!(
        times(77 * TICK_NS - 1..=79 * TICK_NS),
        [77 * TICK_NS, 78 * TICK_NS, 79 * TICK_NS]
    );
    assert!(times(119 * TICK_NS + 1..=u64::MAX).is_empty());
}

#[test]
fn fine_precision_stays_within_a_micrometre_and_takes_less_space() {
    let folder = tempfile::tempdir().expect("a folder");
    let full = swarm::record(&folder.path().join("full.mcap"), swarm::header(100), 100);
    let path = folder.path().join("fine.mcap");
    let header = Header {
        precision: Precision::Fine,
        ..swarm::header(100)
    };
    let fine = swarm::record(&path, header, 100);
    assert!(fine.bytes < full.bytes, "{} {}", fine.bytes, full.bytes);

    let recording = Recording::open(&path).expect("opens");
    for (number, tick) in (0..).zip(recording.ticks()) {
        for (found, given) in tick
            .expect("readable")
            .samples
            .iter()
            .zip(swarm::samples(number, 100))
        {
            for axis in 0..3 {
                assert!((found.position_m[axis] - given.position_m[axis]).abs() < 0.5e-6);
                assert!((found.velocity_m_s[axis] - given.velocity_m_s[axis]).abs() < 0.5e-6);
            }
        }
    }
}

#[test]
fn poses_can_be_recorded_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let header = Header {
        twists: false,
        points: false,
        ..swarm::header(3)
    };
    let stats = swarm::record(&path, header, 20);
    // The vehicles, and poses; of events, log and metrics one each ten ticks.
    assert_eq!(stats.messages, 1 + 20 + 3 * 2);

    let recording = Recording::open(&path).expect("opens");
    assert!(!recording.has_twists());
    let ticks: Vec<Tick> = recording
        .ticks()
        .collect::<Result<_, _>>()
        .expect("readable");
    assert_eq!(ticks.len(), 20);
    assert_eq!(ticks[19].time_ns, 19 * TICK_NS);
    assert_eq!(
        ticks[19].samples[2].position_m,
        swarm::sample(19, 2).position_m
    );
    assert!(ticks[19].samples[2].velocity_m_s[0].is_nan());
}

#[test]
fn a_swarm_of_none_can_be_recorded() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    swarm::record(&path, swarm::header(0), 5);
    let recording = Recording::open(&path).expect("opens");
    assert_eq!(recording.ticks().count(), 5);
}

#[test]
fn a_recorder_that_is_dropped_leaves_a_whole_file_without_summary() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let mut recorder = Recorder::create(&path, swarm::header(2)).expect("created");
    recorder.tick(5, swarm::samples(0, 2)).expect("recorded");
    drop(recorder);

    let recording = Recording::open(&path).expect("opens");
    assert!(!recording.truncated());
    assert_eq!(recording.summary(), None);
    assert_eq!(recording.ticks().count(), 1);
}

#[test]
fn a_tick_must_have_a_sample_for_every_vehicle() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let mut recorder = Recorder::create(&path, swarm::header(2)).expect("created");

    let error = recorder
        .tick(5, swarm::samples(0, 3))
        .expect_err("one too many");
    assert!(matches!(
        error,
        RecordError::Samples {
            found: 3,
            expected: 2,
            ..
        }
    ));
    assert!(
        error
            .to_string()
            .ends_with("a tick at 5 ns has 3 samples for 2 vehicles")
    );

    recorder.tick(6, swarm::samples(1, 2)).expect("recorded");
    recorder.finish(&serde_json::Value::Null).expect("finished");
    let recording = Recording::open(&path).expect("opens");
    assert_eq!(recording.ticks().count(), 1);
}

#[test]
fn other_files_are_told_apart() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let open = |bytes: &[u8]| {
        std::fs::write(&path, bytes).expect("written");
        Recording::open(&path).expect_err("not ours")
    };
    assert!(matches!(open(b""), ReadError::NotMcap { .. }));
    assert!(matches!(
        open(b"time,x,y\n0,1,2\n"),
        ReadError::NotMcap { .. }
    ));

    let mut foreign = mcap_of_another_program();
    assert!(matches!(open(&foreign), ReadError::NotOurs { .. }));
    foreign.truncate(foreign.len() / 2);
    std::fs::write(&path, &foreign).expect("written");
    assert!(
        Recording::open(&path)
            .expect("cut off, so it may be ours")
            .truncated()
    );

    let missing = Recording::open(folder.path().join("none.mcap"));
    assert!(matches!(missing, Err(ReadError::Io { .. })));
}

fn mcap_of_another_program() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut writer = mcap::Writer::new(&mut bytes).expect("a writer");
    let channel = writer
        .add_channel(0, "/tf", "json", &std::collections::BTreeMap::new())
        .expect("a channel");
    for sequence in 0..1000 {
        let header = mcap::records::MessageHeader {
            channel_id: channel,
            sequence,
            log_time: 0,
            publish_time: 0,
        };
        writer
            .write_to_known_channel(&header, b"{}")
            .expect("written");
    }
    writer.finish().expect("finished");
    drop(writer);
    bytes.into_inner()
}

#[test]
fn the_mcap_library_reads_what_we_write() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let stats = swarm::record(&path, swarm::header(10), 50);
    let bytes = std::fs::read(&path).expect("there");

    let messages = mcap::MessageStream::new(&bytes).expect("a stream");
    let topics: Vec<_> = messages
        .map(|message| message.expect("readable").channel.topic.clone())
        .collect();
    assert_eq!(topics.len() as u64, stats.messages);
    let first = ["/vehicles", "/poses", "/poses/points", "/twists"];
    assert_eq!(topics[..4], first);

    let summary = mcap::Summary::read(&bytes)
        .expect("readable")
        .expect("there");
    let poses = summary
        .channels
        .values()
        .find(|c| c.topic == "/poses")
        .expect("there");
    let schema = poses.schema.as_ref().expect("there");
    assert_eq!(schema.name, "foxglove.PosesInFrame");
    assert_eq!(schema.encoding, "protobuf");
    assert_eq!(summary.attachment_indexes.len(), 1);
    assert_eq!(summary.metadata_indexes.len(), 2);
}

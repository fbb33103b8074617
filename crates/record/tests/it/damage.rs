//! Files that were cut, bent, or never were recordings: errors, not panics.

use crate::swarm::{self, TICK_NS};
use proptest::prelude::*;
use simbeeotic_model::{Image, Pixels};
use simbeeotic_record::{
    Attachment, Header, Picture, Recorder, Recording, Selection, Tick, Wind, export_csv,
};
use std::path::Path;
use std::sync::LazyLock;

const VEHICLES: usize = 300;
const TICKS: u64 = 200;

/// A recording of about six chunks with an attachment.
static WHOLE: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let mut header = swarm::header(VEHICLES);
    header.files.push(Attachment {
        name: "world.toml".into(),
        media_type: "application/toml".into(),
        bytes: vec![b'#'; 5000],
    });
    swarm::record(&path, header, TICKS);
    std::fs::read(&path).expect("there")
});

/// A small recording, so that a random place is often one that matters.
static SMALL: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let header = Header {
        scenario: String::new(),
        ..swarm::header(2)
    };
    swarm::record(&path, header, 20);
    std::fs::read(&path).expect("there")
});

fn open(bytes: &[u8]) -> Option<Recording> {
    let file = tempfile::NamedTempFile::new().expect("a file");
    std::fs::write(file.path(), bytes).expect("written");
    Recording::open(file.path()).ok()
}

/// Reads everything there is to read; returns the ticks.
fn read_all(recording: &Recording) -> Vec<Tick> {
    let _ = recording.attachments();
    let _ = recording.summary();
    let _ = recording.stage();
    let _ = recording.about(0);
    let _ = recording.events().filter(Result::is_ok).count();
    let _ = recording.log().filter(Result::is_ok).count();
    let _ = recording.metrics().filter(Result::is_ok).count();
    let _ = recording.ticks_in(3..=TICK_NS * 5).count();
    let _ = export_csv(recording, &Selection::default(), &mut std::io::sink());
    recording.ticks().filter_map(Result::ok).collect()
}

fn assert_as_recorded(tick: &Tick, vehicles: usize) {
    let number = tick.time_ns / TICK_NS;
    assert!(
        tick.samples
            .iter()
            .copied()
            .eq(swarm::samples(number, vehicles)),
        "tick {number}"
    );
}

#[test]
fn a_recording_cut_anywhere_opens_and_shows_what_is_left() {
    let whole = &*WHOLE;
    let mut before = 0;
    for part in 1..=50 {
        let cut = &whole[..whole.len() * part / 50];
        let recording = open(cut).unwrap_or_else(|| panic!("{part}/50 opens"));
        assert_eq!(recording.truncated(), part < 50);

        let ticks: Vec<_> = recording
            .ticks()
            .map(|tick| tick.expect("readable"))
            .collect();
        for (number, tick) in (0..).zip(&ticks) {
            assert_eq!(tick.time_ns, number * TICK_NS);
            assert_as_recorded(tick, VEHICLES);
        }
        assert!(ticks.len() >= before, "{part}/50");
        assert!(
            ticks
                .last()
                .is_none_or(|last| last.time_ns <= recording.end_ns())
        );
        before = ticks.len();
    }
    assert_eq!(before as u64, TICKS);
}

/// What the wind was at a tick: another at each.
fn wind(tick: u64) -> Wind {
    Wind {
        time_ns: tick * TICK_NS,
        arrows: vec![[1.0, 2.0, 3.0, tick as f32, 0.5, 0.0]; 4],
    }
}

/// A swarm in a wind that comes up late, and a camera that looks up then.
fn in_the_wind() -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let mut recorder = Recorder::create(&path, swarm::header(VEHICLES)).expect("created");
    for tick in 0..TICKS {
        let samples = swarm::samples(tick, VEHICLES);
        recorder.tick(tick * TICK_NS, samples).expect("recorded");
        recorder.metrics(swarm::metrics(tick)).expect("recorded");
        if tick >= UP {
            recorder.wind(wind(tick)).expect("recorded");
            recorder.picture(picture(tick)).expect("recorded");
        }
    }
    let stats = recorder.finish(&serde_json::json!({}));
    stats.expect("finished");
    std::fs::read(&path).expect("there")
}

/// When the wind comes up: some chunks are over by then.
const UP: u64 = TICKS / 3;

fn picture(tick: u64) -> Picture {
    Picture {
        time_ns: tick * TICK_NS,
        path: "bee-0/camera".into(),
        image: Image {
            width: 1,
            height: 1,
            pixels: Pixels::Grey([tick as u8].into()),
        },
    }
}

#[test]
fn a_recording_cut_anywhere_keeps_its_wind_and_pictures_up_to_the_cut() {
    let whole = in_the_wind();
    for part in (10..=50).rev() {
        let recording = open(&whole[..whole.len() * part / 50]).expect("it opens");
        let ticks = recording.ticks().count() as u64;
        let all: Vec<Wind> = recording
            .wind_in(0..=u64::MAX)
            .map(|wind| wind.expect("readable"))
            .collect();
        let expected = (UP..).map(wind);
        assert!(all.iter().cloned().eq(expected.take(all.len())), "{part}");
        // What stands aside comes behind its poses: the cut may be between them, and a chunk has 33 ticks.
        let least = ticks.saturating_sub(UP + 40) as usize;
        assert!(all.len() >= least, "{part}/50: {} of {ticks}", all.len());
        if let Some(last) = all.last() {
            let then = last.time_ns..=last.time_ns;
            let found = recording.wind_in(then).flatten().next();
            assert_eq!(found.as_ref(), Some(last), "{part}/50: by its time");
        }
        // A chunk may end between a tick and its picture.
        if ticks > UP + 1 {
            let then = (ticks - 2) * TICK_NS;
            let found = recording.pictures_in(then..=then).flatten().next();
            assert_eq!(found, Some(picture(ticks - 2)), "{part}/50: the picture");
        }
    }
}

#[test]
fn a_damaged_chunk_costs_only_its_own_ticks() {
    let mut bytes = WHOLE.clone();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 0x10;
    let recording = open(&bytes).expect("opens");

    let (good, bad): (Vec<_>, Vec<_>) = recording.ticks().partition(Result::is_ok);
    assert_eq!(bad.len(), 1);
    let message = bad[0].as_ref().expect_err("bad").to_string();
    assert!(message.contains("is damaged at byte"), "{message}");

    let good: Vec<Tick> = good.into_iter().map(|tick| tick.expect("good")).collect();
    good.iter()
        .for_each(|tick| assert_as_recorded(tick, VEHICLES));
    assert!(good.len() as u64 > TICKS / 2);
    assert_eq!(good.last().expect("one").time_ns, (TICKS - 1) * TICK_NS);
}

#[test]
fn a_damaged_index_is_not_needed() {
    let mut bytes = WHOLE.clone();
    let summary = bytes.len() - 100;
    bytes[summary] ^= 1;
    let recording = open(&bytes).expect("opens");
    assert_eq!(
        recording.ticks().filter(Result::is_ok).count() as u64,
        TICKS
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn flipped_bytes_never_panic_and_never_bend_a_tick(
        places in prop::collection::vec((any::<prop::sample::Index>(), 1..=255_u8), 1..6),
    ) {
        let mut bytes = SMALL.clone();
        for (place, flip) in places {
            *place.get_mut(&mut bytes) ^= flip;
        }
        if let Some(recording) = open(&bytes) {
            for tick in read_all(&recording) {
                assert_as_recorded(&tick, 2);
            }
        }
    }

    #[test]
    fn cut_and_doubled_parts_never_panic(
        from in any::<prop::sample::Index>(),
        length in 0..200_usize,
        double in any::<bool>(),
    ) {
        let mut bytes = SMALL.clone();
        let from = from.index(bytes.len());
        let to = (from + length).min(bytes.len());
        if double {
            let part = bytes[from..to].to_vec();
            bytes.splice(from..from, part);
        } else {
            bytes.drain(from..to);
        }
        if let Some(recording) = open(&bytes) {
            read_all(&recording);
        }
    }

    #[test]
    fn garbage_after_the_magic_never_panics(garbage in prop::collection::vec(any::<u8>(), 0..500)) {
        let bytes = [mcap::MAGIC, &garbage].concat();
        if let Some(recording) = open(&bytes) {
            read_all(&recording);
        }
    }

    #[test]
    fn records_of_the_right_form_with_random_contents_never_panic(
        records in prop::collection::vec(any_record(), 0..8),
        inside in prop::collection::vec(any_record(), 0..8),
        channel in 0..9_u16,
        messages in prop::collection::vec((0..9_u16, prop::collection::vec(any::<u8>(), 0..80)), 0..8),
        end in any::<bool>(),
    ) {
        let mut chunk = Vec::new();
        for (id, topic) in (channel..).zip(["/vehicles", "/poses", "/twists", "/metrics", "/log", "/world", "/models"]) {
            let mut body = [id.to_le_bytes(), [0, 0]].concat();
            push_text(&mut body, topic);
            push_text(&mut body, "protobuf");
            push_text(&mut body, "");
            push_record(&mut chunk, 4, &body);
        }
        for (id, message) in messages {
            let body = [&id.to_le_bytes()[..], &[0; 20], &message].concat();
            push_record(&mut chunk, 5, &body);
        }
        for (opcode, body) in inside {
            push_record(&mut chunk, opcode, &body);
        }

        let mut bytes = mcap::MAGIC.to_vec();
        push_record(&mut bytes, 6, &uncompressed(&chunk));
        for (opcode, body) in records {
            push_record(&mut bytes, opcode, &body);
        }
        if end {
            push_record(&mut bytes, 15, &[0; 4]);
            push_record(&mut bytes, 2, &[0; 20]);
            bytes.extend(mcap::MAGIC);
        }
        if let Some(recording) = open(&bytes) {
            read_all(&recording);
        }
    }
}

fn any_record() -> impl Strategy<Value = (u8, Vec<u8>)> {
    (
        0..18_u8,
        prop::collection::vec(prop_oneof![Just(0), 0..20_u8, any::<u8>()], 0..120),
    )
}

fn push_record(bytes: &mut Vec<u8>, opcode: u8, body: &[u8]) {
    bytes.push(opcode);
    bytes.extend((body.len() as u64).to_le_bytes());
    bytes.extend(body);
}

fn push_text(bytes: &mut Vec<u8>, text: &str) {
    bytes.extend((text.len() as u32).to_le_bytes());
    bytes.extend(text.as_bytes());
}

/// The body of a chunk without compression and without a checksum.
fn uncompressed(records: &[u8]) -> Vec<u8> {
    let mut body = vec![0; 16];
    let size = (records.len() as u64).to_le_bytes();
    body.extend(size);
    body.extend([0; 4]);
    push_text(&mut body, "");
    body.extend(size);
    body.extend(records);
    body
}

#[test]
fn a_chunk_that_claims_to_be_huge_takes_no_memory() {
    let bomb =
        zstd::encode_all(std::io::Read::take(std::io::repeat(0), 64 << 20), 1).expect("packed");
    for claimed in [u64::MAX, 8 << 30, 1000] {
        let mut body = vec![0; 16];
        body.extend(claimed.to_le_bytes());
        body.extend([0; 4]);
        push_text(&mut body, "zstd");
        body.extend((bomb.len() as u64).to_le_bytes());
        body.extend(&bomb);
        let mut bytes = mcap::MAGIC.to_vec();
        push_record(&mut bytes, 6, &body);
        assert!(open(&bytes).is_none(), "{claimed}");
    }
}

#[test]
fn a_folder_is_no_recording() {
    assert!(Recording::open(Path::new("/")).is_err());
}

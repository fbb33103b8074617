//! A recording again: the same page, with a time line.
//!
//! Opening reads what stands at the ends of the file, so that the page is there at once, however long the recording is.
//! What is small is read once, on a thread of its own (`past`: marks, statistics, series, wind), and told when it is there;
//! frames, packets and links are read from the file when a page asks for their times (`film`, `page`), and a few frames are
//! kept for whoever asks next.

mod details;
mod faults;
mod film;
mod page;
mod past;
mod rates;

use crate::server::{Bell, Page, Picture, Source, pictures};
use crate::wire::{Asked, Facts, Hello, Message, Mode, Replayed, seconds};
use film::Film;
use page::ReplayPage;
use past::Past;
use simbeeotic_record::stage::Stage;
use simbeeotic_record::{ReadError, Recording};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, OnceLock};

/// A recording, ready to be shown by a [`Server`](crate::server::Server).
pub struct Replay(Arc<Shown>);

/// Reads what is known of a whole recording.
type ReadPast = fn(&Recording, &BTreeMap<String, u32>) -> Past;

/// What all pages share.
struct Shown {
    recording: Recording,
    hello: Message,
    film: Film,
    /// Once it has been read.
    past: OnceLock<Past>,
    /// The place of each vehicle, by its path.
    places: BTreeMap<String, u32>,
    textures: BTreeMap<String, Picture>,
}

impl Shown {
    /// What is known of the whole recording; waits until it has been read.
    fn past(&self) -> &Past {
        self.past.wait()
    }

    /// The vehicle of this path, or the one that carries the sensor, radio or number of this path.
    fn vehicle(&self, path: &str) -> Option<u32> {
        vehicle_of(&self.places, path).map(|(vehicle, _)| vehicle)
    }
}

/// The vehicle that a path begins with, and the rest of the path.
fn vehicle_of<'a>(places: &BTreeMap<String, u32>, path: &'a str) -> Option<(u32, &'a str)> {
    let mut end = path.len();
    loop {
        if let Some(vehicle) = places.get(&path[..end]) {
            return Some((*vehicle, path[end..].trim_start_matches('/')));
        }
        end = path[..end].rfind('/')?;
    }
}

impl Replay {
    /// Opens a recording, and begins to read what is small.
    ///
    /// # Errors
    /// The file cannot be read, or is no recording. Damaged parts are left out.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        Self::reading(path, Past::read)
    }

    fn reading(path: impl AsRef<Path>, past: ReadPast) -> Result<Self, ReadError> {
        let recording = Recording::open(path)?;
        let places: BTreeMap<String, u32> = (recording.vehicles().iter())
            .zip(0..)
            .map(|(vehicle, place)| (vehicle.path.clone(), place))
            .collect();
        let film = Film::new(recording.indexed_tick_times()?);
        let stage = recording.stage().ok().flatten().unwrap_or_else(empty);
        let textures = pictures(recording.attachments().unwrap_or_default());
        let times = film.times_ns();
        let end_ns = recording.end_ns().max(times.last().copied().unwrap_or(0));
        let replayed = Replayed {
            from_s: seconds(times.first().copied().unwrap_or(0)),
            to_s: seconds(end_ns),
            period_s: film.period_s(),
            ticks_s: times.iter().map(|time| seconds(*time)).collect(),
        };
        let name = recording
            .metadata("run")
            .and_then(|run| run.get("name"))
            .cloned();
        let facts = Facts {
            name: name.unwrap_or_else(|| {
                let name = recording.path().file_name().unwrap_or_default();
                name.to_string_lossy().into_owned()
            }),
            // Seeds are signed in files.
            seed: recording
                .seed()
                .map_or_else(String::new, |seed| seed.cast_signed().to_string()),
            version: recording.version().unwrap_or_default().to_owned(),
            end_s: Some(replayed.to_s),
            truncated: recording.truncated(),
        };
        let hello = Hello {
            mode: Mode::Replay,
            facts: &facts,
            vehicles: recording.vehicles(),
            stage: &stage,
            replay: Some(&replayed),
        }
        .message();
        let shown = Arc::new(Shown {
            hello,
            film,
            past: OnceLock::new(),
            places,
            textures,
            recording,
        });
        let read = move |shown: &Shown| {
            let read = || Past::or_empty(&shown.places, || past(&shown.recording, &shown.places));
            shown.past.get_or_init(read);
        };
        let thread = std::thread::Builder::new().name("view-past".to_owned());
        let reader = Arc::clone(&shown);
        if thread.spawn(move || read(&reader)).is_err() {
            read(&shown);
        }
        Ok(Self(shown))
    }

    /// Whether the recording was cut off.
    pub fn truncated(&self) -> bool {
        self.0.recording.truncated()
    }

    /// How many ticks it has.
    pub fn ticks(&self) -> usize {
        self.0.film.times_ns().len()
    }

    /// Its last time, s.
    pub fn end_s(&self) -> f64 {
        seconds(self.0.recording.end_ns())
    }
}

impl Source for Replay {
    fn open(&self, _bell: Arc<Bell>) -> Box<dyn Page> {
        Box::new(ReplayPage::new(Arc::clone(&self.0)))
    }

    fn command(&self, asked: &Asked) -> Result<bool, String> {
        match asked {
            Asked::Pause {} | Asked::Resume {} | Asked::Step { .. } | Asked::Pace { .. } => {
                Err("this is a recording: the page itself plays it".to_owned())
            }
            _ => Ok(false),
        }
    }

    fn texture(&self, name: &str) -> Option<Picture> {
        self.0.textures.get(name).cloned()
    }
}

/// An empty plane, for recordings without a world.
fn empty() -> Stage {
    Stage {
        ground: [0x7d, 0xa3, 0x6a, 0xff],
        texture: String::new(),
        radius_m: 10_000.0,
        plane: true,
        props: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;
    use simbeeotic_record::{Header, Metric, Metrics, Packet, Received, Recorder, Sample, Vehicle};
    use simbeeotic_record::{Tallies, Traffic};

    const SECOND_NS: u64 = 1_000_000_000;

    /// A recording of two bees, ten seconds, with what `more` says in each.
    fn recorded(folder: &Path, mut more: impl FnMut(&mut Recorder, u64)) -> std::path::PathBuf {
        let path = folder.join("run.mcap");
        let vehicle = |name: &str| Vehicle {
            path: name.to_owned(),
            ..Vehicle::default()
        };
        let header = Header {
            vehicles: vec![vehicle("a"), vehicle("b")],
            ..Header::default()
        };
        let mut recorder = Recorder::create(&path, header).expect("created");
        for second in 0..10 {
            let samples = [Sample::default(); 2];
            recorder.tick(second * SECOND_NS, samples).expect("a tick");
            more(&mut recorder, second);
        }
        recorder.finish(&Value::Null).expect("finished");
        path
    }

    /// What a page is told after it has asked this.
    fn told(replay: &Replay, asked: Asked) -> Vec<Value> {
        let mut page = replay.open(Arc::new(Bell::default()));
        let mut out = Vec::new();
        page.hear(asked, &mut out);
        // The greeting, and then what has been read, which the question has waited for.
        page.speak(&mut out);
        page.speak(&mut out);
        let text = |message: &Message| match message {
            Message::Text(text) => Some(serde_json::from_str(text).expect("it is JSON")),
            Message::Binary(_) => None,
        };
        out.iter().filter_map(text).collect()
    }

    fn errors(told: &[Value]) -> Vec<&str> {
        let errors = told.iter().filter(|said| said["type"] == "error");
        errors.filter_map(|said| said["text"].as_str()).collect()
    }

    fn select(vehicle: u32, t: f64) -> Asked {
        Asked::Select {
            vehicle: Some(vehicle),
            t: Some(t),
        }
    }

    #[test]
    fn a_page_hears_that_the_recording_could_not_be_read_and_does_not_wait() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = recorded(folder.path(), |_, _| {});
        let replay = Replay::reading(path, |_, _| panic!("a fault")).expect("it opens");
        let told = told(&replay, select(0, 1.0));
        let [error] = errors(&told)[..] else {
            panic!("one error: {told:?}");
        };
        assert!(error.contains("a fault"), "{error}");
        assert!(told.iter().any(|said| said["type"] == "details"));
        assert!(told.iter().any(|said| said["type"] == "marks"));
    }

    #[test]
    fn a_page_hears_where_the_recording_is_damaged() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = recorded(folder.path(), |recorder, second| {
            let value = Metric {
                name: "pollen".to_owned(),
                unit: "g".to_owned(),
                value: second as f64,
            };
            let time_ns = second * SECOND_NS;
            let values = vec![value];
            (recorder.metrics(Metrics { time_ns, values })).expect("numbers");
        });
        let whole = Replay::open(&path).expect("it opens");
        assert_eq!(errors(&told(&whole, select(0, 1.0))), [""; 0]);
        // In the last chunk there are the numbers; its message index follows.
        let mut bytes = std::fs::read(&path).expect("there");
        let magic = [0x28, 0xb5, 0x2f, 0xfd];
        let last = bytes.windows(4).rposition(|four| four == magic);
        bytes[last.expect("zstd") + 12] ^= 0x55;
        std::fs::write(&path, bytes).expect("written");
        let damaged = Replay::open(&path).expect("it opens");
        let told = told(&damaged, select(0, 1.0));
        let [error] = errors(&told)[..] else {
            panic!("one error: {told:?}");
        };
        assert!(error.contains("is damaged at byte"), "{error}");
    }

    /// `a` sends once a second, and `b` receives it; of each second the counters of all are recorded, which say that
    /// so many more were sent.
    fn talk(folder: &Path, unheard: u64) -> Replay {
        let path = recorded(folder, |recorder, second| {
            let time_ns = second * SECOND_NS;
            let packet = Packet {
                time_ns: time_ns + 1,
                sender: "a".to_owned(),
                radio: "a/radio".to_owned(),
                receptions: vec![Received {
                    radio: "b/radio".to_owned(),
                    time_ns: time_ns + 1_000_000,
                    ..Received::default()
                }],
                ..Packet::default()
            };
            let total = Tallies {
                sent: second + unheard,
                ..Tallies::default()
            };
            let traffic = Traffic {
                time_ns,
                total,
                ..Traffic::default()
            };
            recorder.traffic(traffic).expect("counters");
            recorder.packet(packet).expect("a packet");
        });
        Replay::open(path).expect("it opens")
    }

    /// `sent` and `received` of each radio.
    fn counters(replay: &Replay, vehicle: u32, t: f64) -> Vec<[Option<u64>; 2]> {
        let told = told(replay, select(vehicle, t));
        let details = told.iter().find(|said| said["type"] == "details");
        let radios = details.and_then(|said| said["radios"].as_array());
        let radios = radios.expect("details").iter();
        radios
            .map(|radio| [radio["sent"].as_u64(), radio["received"].as_u64()])
            .collect()
    }

    #[test]
    fn what_radios_did_is_counted_from_packets_where_only_the_counters_of_all_were_recorded() {
        let folder = tempfile::tempdir().expect("a folder");
        let replay = talk(folder.path(), 0);
        assert_eq!(counters(&replay, 0, 4.5), [[Some(5), Some(0)]]);
        assert_eq!(counters(&replay, 1, 4.5), [[Some(0), Some(5)]]);
        assert_eq!(counters(&replay, 1, 4.0005), [[Some(0), Some(4)]]);
    }

    #[test]
    fn what_radios_did_is_not_counted_from_some_of_the_packets() {
        let folder = tempfile::tempdir().expect("a folder");
        let replay = talk(folder.path(), 3);
        // All of its own are there; what it did not receive of others is not known.
        assert_eq!(counters(&replay, 0, 4.5), [[Some(5), None]]);
        assert_eq!(counters(&replay, 1, 4.5), [[None, None]]);
    }

    #[test]
    fn a_number_belongs_to_the_vehicle_that_its_path_begins_with() {
        let places = [("hive", 0), ("hive/bee-1", 1), ("bee", 2)];
        let places = places.map(|(path, place)| (path.to_owned(), place)).into();
        let of = |path| vehicle_of(&places, path);
        assert_eq!(of("hive/bee-1/battery/soc"), Some((1, "battery/soc")));
        assert_eq!(
            of("hive/bee-10/battery/soc"),
            Some((0, "bee-10/battery/soc"))
        );
        assert_eq!(of("hive"), Some((0, "")));
        assert_eq!(of("weather/rain"), None);
    }
}

//! A recording again: the same page, with a time line.
//!
//! Opening reads what stands at the ends of the file, so that the page is there at once, however long the recording is.
//! What is small is read once, on a thread of its own (`past`: marks, statistics, series, wind), and told when it is there;
//! frames, packets and links are read from the file when a page asks for their times (`film`, `page`), and a few frames are
//! kept for whoever asks next.

mod details;
mod film;
mod page;
mod past;

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
        let read = |shown: &Shown| {
            let read = || Past::read(&shown.recording, &shown.places);
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

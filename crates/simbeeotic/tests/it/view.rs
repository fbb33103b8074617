//! Looking at a run changes nothing, whoever looks and however.

use simbeeotic::scenario::{Request, load_text};
use simbeeotic::view::live::{Viewer, ViewerParams};
use simbeeotic_model::units::Time;
use simbeeotic_model::{Component, ComponentError, FromParams, Note, Simulation, Summary, View};
use std::io::Read;
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

const SCENARIO: &str = r#"
[run]
seed = 7
end_time = "3 s"

[[model]]
use = "instrument-bee"
name = "bee"
count = 60
start = { ball = "2 m", center = ["0 m", "0 m", "4 m"] }

[model.vehicle]
use = "simple-bee"
bee_collisions = true

[model.battery]
preset = "1s-250mah"
capacity = "22 mAh"
avionics = "20 mA"

[model.sensor.compass]
use = "compass"

[model.radio]
use = "cc2420"

[channel]
medium = "ieee802154"
"#;

/// A page: takes its socket, does what it likes, and says what it saw.
type PageOf = fn(WebSocket<TcpStream>, Seat<'_>) -> usize;

/// How a page is doing.
#[derive(Default)]
struct Progress {
    connected: AtomicBool,
    frames: AtomicUsize,
    enough: AtomicBool,
}

/// A page's place among all of its run.
#[derive(Clone, Copy)]
struct Seat<'a> {
    all: &'a [Progress],
    number: usize,
}

impl Seat<'_> {
    fn own(&self) -> &Progress {
        &self.all[self.number]
    }

    /// It has seen what its test wants.
    fn enough(&self) {
        self.own().enough.store(true, Ordering::Relaxed);
    }

    /// It has seen another frame; how many that makes.
    fn frame(&self) -> usize {
        self.own().frames.fetch_add(1, Ordering::Relaxed) + 1
    }
}

/// Holds a run up until its pages have connected and have seen enough: how soon they do hangs on how busy the
/// machine is, and what they see must not.
struct Gate(Arc<[Progress]>);

impl Gate {
    fn wait(&self, at_most: Duration, done: fn(&Progress) -> &AtomicBool) {
        let mut left = at_most;
        let step = Duration::from_millis(5);
        while !left.is_zero() && !self.0.iter().all(|p| done(p).load(Ordering::Relaxed)) {
            std::thread::sleep(step);
            left = left.saturating_sub(step);
        }
    }
}

impl Component for Gate {
    fn period(&self) -> Option<Time> {
        Some(Time::from_secs(0.001))
    }

    fn start(&mut self, _: &View<'_>) -> Result<(), ComponentError> {
        self.wait(Duration::from_secs(60), |page| &page.connected);
        Ok(())
    }

    /// About as long as the viewer waits between two looks, so that it has as many to show as ever. A minute and
    /// three quarters in all.
    fn observe(&mut self, _: &View<'_>) -> Result<(), ComponentError> {
        self.wait(Duration::from_millis(35), |page| &page.enough);
        Ok(())
    }

    fn finish(&mut self, _: &View<'_>, _: &Summary) -> Result<Vec<Note>, ComponentError> {
        Ok(Vec::new())
    }
}

fn connect(place: &str) -> WebSocket<TcpStream> {
    let mut request = format!("ws://{place}/stream")
        .into_client_request()
        .expect("a request");
    let origin = format!("http://{place}").parse().expect("a header");
    request.headers_mut().insert("Origin", origin);
    let stream = TcpStream::connect(place).expect("the viewer listens");
    let timeout = Some(Duration::from_secs(60));
    stream.set_read_timeout(timeout).expect("a timeout");
    tungstenite::client(request, stream)
        .expect("our page is let in")
        .0
}

/// Runs the scenario with a viewer and these pages; the trace hash, and what the pages say.
fn watched(pages: &[PageOf], paused: bool) -> (String, Vec<usize>) {
    looked_at(pages, paused, false)
}

/// The same; `stay`: the viewer is there until the pages have seen enough.
fn looked_at(pages: &[PageOf], paused: bool, stay: bool) -> (String, Vec<usize>) {
    let loaded = load_text("view", SCENARIO, &Request::default()).expect("it is right");
    let mut setup = loaded.setup().expect("it is right");
    setup.pace = Some(3.0);
    let params = ViewerParams {
        port: Some(0),
        paused,
        ..ViewerParams::default()
    };
    let mut viewer = Viewer::from_params(params).expect("it is right");
    let url = viewer.bind().expect("a free port");
    setup
        .components
        .push(("viewer".to_owned(), Box::new(viewer)));
    let place = url
        .trim_start_matches("http://")
        .trim_end_matches('/')
        .to_owned();
    let progress: Arc<[Progress]> = pages.iter().map(|_| Progress::default()).collect();
    let gate = Box::new(Gate(Arc::clone(&progress)));
    setup.components.push(("gate".to_owned(), gate));
    let pages: Vec<JoinHandle<usize>> = (pages.iter().copied().enumerate())
        .map(|(number, page)| {
            let (place, all) = (place.clone(), Arc::clone(&progress));
            std::thread::spawn(move || {
                let socket = connect(&place);
                all[number].connected.store(true, Ordering::Relaxed);
                page(socket, Seat { all: &all, number })
            })
        })
        .collect();
    let mut simulation = Simulation::new(setup).expect("it can be built");
    let outcome = simulation.run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    let seen = |pages: Vec<JoinHandle<usize>>| {
        let pages = pages.into_iter();
        let seen = pages.map(|page| page.join().expect("the page did well"));
        seen.collect()
    };
    let hash = outcome.summary.trace_hash;
    if stay {
        // As the program does while a page is there.
        while !pages.iter().all(JoinHandle::is_finished) {
            simulation.show_held().expect("the viewer looks");
            std::thread::sleep(Duration::from_millis(20));
        }
        return (hash, seen(pages));
    }
    drop(simulation);
    (hash, seen(pages))
}

fn say(page: &mut WebSocket<TcpStream>, text: impl Into<String>) {
    let text: String = text.into();
    let _ = page.send(Message::text(text));
}

/// Frames that a page wants to see.
const ENOUGH: usize = 6;

/// Takes every frame until it is closed; does `at` with the number of each.
fn take_frames(
    page: &mut WebSocket<TcpStream>,
    seat: Seat<'_>,
    mut at: impl FnMut(&mut WebSocket<TcpStream>, usize),
) -> usize {
    let mut frames = 0;
    while let Ok(message) = page.read() {
        if let Message::Binary(bytes) = message
            && bytes.first() == Some(&1)
        {
            frames = seat.frame();
            let time = f64::from_le_bytes(bytes[8..16].try_into().expect("eight bytes"));
            say(page, format!("{{\"type\":\"got\",\"time_s\":{time}}}"));
            at(page, frames);
        }
    }
    frames
}

fn eager(mut page: WebSocket<TcpStream>, seat: Seat<'_>) -> usize {
    say(&mut page, r#"{"type":"select","vehicle":3}"#);
    take_frames(&mut page, seat, |_, frames| {
        if frames >= ENOUGH {
            seat.enough();
        }
    })
}

/// More frames than a page beside the slow one is to see.
const MORE: usize = 4;

/// Takes frames as they come until it has seen more than the slow page beside it, by a few; how many more.
fn faster(mut page: WebSocket<TcpStream>, seat: Seat<'_>) -> usize {
    let mut most = 0;
    take_frames(&mut page, seat, |_, frames| {
        let slow = seat.all[1].frames.load(Ordering::Relaxed);
        most = most.max(frames.saturating_sub(slow));
        if frames >= ENOUGH && most >= MORE {
            seat.enough();
        }
    });
    most
}

/// Takes frames, but no more than two a second; what it says is that of the last `state`: frames that it was not sent.
fn slow(mut page: WebSocket<TcpStream>, seat: Seat<'_>) -> usize {
    let mut skipped = 0;
    while let Ok(message) = page.read() {
        match message {
            Message::Binary(bytes) if bytes.first() == Some(&1) => {
                seat.frame();
                std::thread::sleep(Duration::from_millis(500));
                say(&mut page, r#"{"type":"got","time_s":1e9}"#);
            }
            Message::Text(text) => {
                let said: serde_json::Value = serde_json::from_str(&text).expect("JSON");
                if said["type"] == "state" {
                    skipped = said["skipped"].as_u64().expect("a number") as usize;
                    if skipped > 0 {
                        seat.enough();
                    }
                }
            }
            _ => {}
        }
    }
    skipped
}

/// Reads a byte now and then, and never says that it got a frame.
fn stuck(page: WebSocket<TcpStream>, seat: Seat<'_>) -> usize {
    let mut stream = page.into_inner();
    let mut byte = [0];
    let mut read = 0;
    while stream.read(&mut byte).is_ok_and(|n| n > 0) && read < 20 {
        read += 1;
        seat.enough();
        std::thread::sleep(Duration::from_millis(100));
    }
    read
}

/// Is gone after five frames, without a word.
fn killed(mut page: WebSocket<TcpStream>, seat: Seat<'_>) -> usize {
    let mut frames = 0;
    while frames < 5 {
        match page.read() {
            Ok(Message::Binary(bytes)) if bytes.first() == Some(&1) => {
                frames += 1;
                say(&mut page, r#"{"type":"got","time_s":1e9}"#);
            }
            Ok(_) => {}
            Err(_) => break,
        }
    }
    seat.enough();
    frames
}

/// Pauses, steps by instants and by time, selects, changes the pace, and goes on.
fn steering(mut page: WebSocket<TcpStream>, seat: Seat<'_>) -> usize {
    take_frames(&mut page, seat, |page, frame| match frame {
        3 => say(page, r#"{"type":"pause"}"#),
        4 => say(page, r#"{"type":"step","instants":5}"#),
        5 => say(page, r#"{"type":"step","seconds":0.05}"#),
        6 => {
            say(page, r#"{"type":"select","vehicle":1}"#);
            say(page, r#"{"type":"pace","factor":2.0}"#);
            say(page, r#"{"type":"resume"}"#);
        }
        7 => seat.enough(),
        _ => {}
    })
}

/// Looks on to the end, and only then chooses a colour and a vehicle; how many vehicles have a value of the last instant.
fn asking_afterwards(mut page: WebSocket<TcpStream>, seat: Seat<'_>) -> usize {
    seat.enough();
    let mut asked = false;
    let (mut told, mut coloured) = (None, None);
    while told.is_none() || coloured.is_none() {
        match page.read().expect("an answer after the end") {
            Message::Binary(bytes) if bytes.first() == Some(&1) => {
                say(&mut page, r#"{"type":"got","time_s":1e9}"#);
                if asked && bytes[1] & 2 != 0 {
                    let count = u32::from_le_bytes(bytes[4..8].try_into().expect("four")) as usize;
                    let from = 16 + 24 * count;
                    let values = bytes[from..from + 4 * count].chunks_exact(4);
                    let values = values.map(|x| f32::from_le_bytes(x.try_into().expect("four")));
                    coloured = Some(values.filter(|x| *x > 0.0 && *x < 1.0).count());
                }
            }
            Message::Text(text) => {
                let said: serde_json::Value = serde_json::from_str(&text).expect("JSON");
                assert_ne!(said["type"], "error", "{said}");
                if said["type"] == "state" && !said["ended"].is_null() && !asked {
                    asked = true;
                    say(&mut page, r#"{"type":"select","vehicle":3}"#);
                    say(&mut page, r#"{"type":"colour","by":"battery/soc"}"#);
                }
                if said["type"] == "details" {
                    told = Some(said);
                }
            }
            _ => {}
        }
    }
    let told = told.expect("it was told");
    assert_eq!((&told["vehicle"], &told["t"]), (&3.into(), &3.0.into()));
    assert!(!told["parts"].as_array().expect("a list").is_empty());
    assert!(told["battery"]["soc"].as_f64().expect("a number") < 1.0);
    coloured.expect("a frame came")
}

/// Selects at once, and says whether the last details are those of the end.
fn selecting_before(mut page: WebSocket<TcpStream>, seat: Seat<'_>) -> usize {
    say(&mut page, r#"{"type":"select","vehicle":3}"#);
    seat.enough();
    let (mut ended, mut t) = (false, 0.0);
    while !(ended && t == 3.0) {
        match page.read().expect("details of the end") {
            Message::Binary(bytes) if bytes.first() == Some(&1) => {
                say(&mut page, r#"{"type":"got","time_s":1e9}"#);
            }
            Message::Text(text) => {
                let said: serde_json::Value = serde_json::from_str(&text).expect("JSON");
                ended |= said["type"] == "state" && !said["ended"].is_null();
                if said["type"] == "details" {
                    t = said["t"].as_f64().expect("a time");
                }
            }
            _ => {}
        }
    }
    1
}

/// Lets a run go that waits for it.
fn starting(mut page: WebSocket<TcpStream>, seat: Seat<'_>) -> usize {
    say(&mut page, r#"{"type":"resume"}"#);
    take_frames(&mut page, seat, |_, frames| {
        if frames >= ENOUGH {
            seat.enough();
        }
    })
}

/// The trace hash of the scenario that nobody looks at.
fn unwatched(text: &str) -> String {
    let loaded = load_text("view", text, &Request::default()).expect("it is right");
    let setup = loaded.setup().expect("it is right");
    let mut simulation = Simulation::new(setup).expect("it can be built");
    simulation.run().summary.trace_hash
}

#[test]
fn the_hash_can_tell_another_run() {
    let plain = unwatched(SCENARIO);
    assert_eq!(unwatched(SCENARIO), plain);
    assert_ne!(unwatched(&SCENARIO.replace("seed = 7", "seed = 8")), plain);
    let longer = SCENARIO.replace("3 s", "3.1 s");
    assert_ne!(unwatched(&longer), plain);
}

#[test]
fn a_viewer_without_a_page_does_not_show_in_the_trace() {
    assert_eq!(watched(&[], false).0, unwatched(SCENARIO));
}

#[test]
fn one_page_does_not_show_in_the_trace() {
    let (hash, frames) = watched(&[eager], false);
    assert_eq!(hash, unwatched(SCENARIO));
    assert!(frames[0] >= ENOUGH, "{frames:?}");
}

#[test]
fn three_pages_do_not_show_in_the_trace() {
    let (hash, frames) = watched(&[eager, eager, eager], false);
    assert_eq!(hash, unwatched(SCENARIO));
    assert!(frames.iter().all(|frames| *frames >= ENOUGH), "{frames:?}");
}

#[test]
fn slow_pages_do_not_show_in_the_trace_and_are_sent_fewer_frames() {
    let (hash, seen) = watched(&[faster, slow, stuck], false);
    assert_eq!(hash, unwatched(SCENARIO));
    assert!(seen[0] >= MORE, "the others are not held up: {seen:?}");
    assert!(seen[1] > 0, "it was spared frames: {seen:?}");
    assert!(seen[2] > 0, "{seen:?}");
}

#[test]
fn a_page_that_is_killed_does_not_show_in_the_trace() {
    let (hash, frames) = watched(&[killed, eager], false);
    assert_eq!(hash, unwatched(SCENARIO));
    assert!(frames[0] == 5 && frames[1] >= ENOUGH, "{frames:?}");
}

#[test]
fn pauses_steps_and_paces_do_not_show_in_the_trace() {
    let plain = unwatched(SCENARIO);
    let (hash, frames) = watched(&[steering], false);
    assert_eq!(hash, plain, "one steers");
    assert!(frames[0] > 6, "{frames:?}");
    let (hash, frames) = watched(&[starting], true);
    assert_eq!(hash, plain, "one starts it");
    assert!(frames[0] >= ENOUGH, "{frames:?}");
}

#[test]
fn after_the_end_colours_and_details_are_those_of_the_end() {
    let (hash, seen) = looked_at(&[asking_afterwards, selecting_before], false, true);
    assert_eq!(hash, unwatched(SCENARIO));
    assert_eq!(seen, [60, 1], "every bee has a charge");
}

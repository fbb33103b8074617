//! One page that looks at a run: what it has been told, and what comes next.

use super::look::Look;
use super::marks::Event;
use super::shared::{MARKS_KEPT, Now, Shared};
use crate::server::Page;
use crate::wire::{Asked, Message, Packet, Said, frame, nanoseconds, values};
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

/// Frames on the way to a page.
const ON_THE_WAY: usize = 2;

/// Marks and packets that go with one frame.
const MARKS_MAX: usize = 200;
const PACKETS_MAX: usize = 500;

/// Wall time between two messages on how the run goes, and between two of values.
const STATE: Duration = Duration::from_millis(100);

/// Wall time over which the speed is measured.
const SPEED: Duration = Duration::from_secs(1);

/// A page of a live run.
pub(super) struct LivePage {
    shared: Arc<Shared>,
    number: u64,
    greeted: bool,
    /// The times of frames that are not drawn yet, s.
    on_the_way: VecDeque<f64>,
    vehicle: Option<u32>,
    colour: Option<String>,
    /// It has asked for another colour since its last frame.
    recolour: bool,
    /// What it has seen.
    look: u64,
    marks: u64,
    packets: u64,
    links: u64,
    wind: u64,
    details: u64,
    sample: u64,
    /// Statistics and columns that it was told of.
    known: (usize, usize),
    skipped: u64,
    said: Option<State>,
    said_at: Duration,
    begun: Instant,
    /// Wall and virtual times of the last second.
    past: VecDeque<(Duration, f64)>,
}

/// What is new besides positions, as it was copied: it is encoded when the lock is free again.
#[derive(Default)]
struct Beside {
    marks: (Vec<Event>, u64),
    packets: (Vec<Arc<Packet>>, u64),
    whole: Vec<Arc<Said>>,
}

impl Beside {
    fn say(self, out: &mut Vec<Message>) {
        let (list, dropped) = self.marks;
        if !list.is_empty() || dropped > 0 {
            let list = list.iter().map(Event::told).collect();
            out.push(Said::Marks { list, dropped }.message());
        }
        let (list, dropped) = self.packets;
        if !list.is_empty() || dropped > 0 {
            let list = list.iter().map(|packet| Packet::clone(packet)).collect();
            out.push(Said::Packets { list, dropped }.message());
        }
        out.extend(self.whole.iter().map(|said| said.message()));
    }
}

/// How the run goes, as far as pages are told.
#[derive(Clone, PartialEq)]
struct State {
    time_s: f64,
    paused: bool,
    factor: Option<f64>,
    speed: f64,
    ended: Option<String>,
    events: u64,
    viewers: usize,
    skipped: u64,
}

impl LivePage {
    #[allow(
        clippy::disallowed_methods,
        reason = "pages are told how fast the run is by the wall clock"
    )]
    pub(super) fn new(shared: Arc<Shared>, number: u64) -> Self {
        Self {
            shared,
            number,
            greeted: false,
            on_the_way: VecDeque::new(),
            vehicle: None,
            colour: None,
            recolour: false,
            look: 0,
            marks: 0,
            packets: 0,
            links: 0,
            wind: 0,
            details: 0,
            sample: 0,
            known: (0, 0),
            skipped: 0,
            said: None,
            said_at: Duration::ZERO,
            begun: Instant::now(),
            past: VecDeque::new(),
        }
    }

    fn error(out: &mut Vec<Message>, text: impl Into<String>) {
        let text = text.into();
        out.push(Said::Error { text }.message());
    }

    /// The first message, and all marks so far. Packets and the like are told from now on.
    fn greet(&mut self, out: &mut Vec<Message>) {
        out.extend(self.shared.hello.get().cloned());
        let (list, dropped, packets) = {
            let now = self.shared.now();
            let (list, dropped) = now.marks.since(0, MARKS_KEPT);
            self.marks = now.marks.end();
            // A run that goes on takes a new look at once; one that stands has nothing newer to show.
            let control = self.shared.control.get();
            if now.ended.is_none() && !control.is_some_and(|control| control.is_paused()) {
                self.look = now.number;
            }
            (list, dropped, now.packets.end())
        };
        self.packets = packets;
        if !list.is_empty() || dropped > 0 {
            let list = list.iter().map(Event::told).collect();
            out.push(Said::Marks { list, dropped }.message());
        }
        self.greeted = true;
    }

    /// Series that are new to it, each with its history.
    fn series(&mut self, out: &mut Vec<Message>) {
        let series = self.shared.series();
        let (statistics, columns) = series.counts();
        let mut list = series.statistics_from(self.known.0);
        if let Some(vehicle) = self.vehicle.filter(|_| columns > self.known.1) {
            list.extend(series.of_vehicle(vehicle));
        }
        let histories: Vec<_> = (list.iter())
            .filter_map(|info| Some((info.id, series.history(info.id)?.clone())))
            .filter(|(_, history)| !history.times_s.is_empty())
            .collect();
        drop(series);
        self.known = (statistics, columns);
        if !list.is_empty() {
            out.push(Said::Series { list }.message());
        }
        out.extend(histories.into_iter().map(|(id, history)| {
            let (times_s, values) = (history.times_s, history.values);
            Said::History {
                id,
                times_s,
                values,
            }
            .message()
        }));
    }

    /// All samples since its last; if there are more than are kept, the histories once more.
    fn samples(&mut self, number: u64, out: &mut Vec<Message>) {
        let seen = match self.sample {
            0 => number.saturating_sub(1),
            seen => seen,
        };
        let (number, list) = {
            let series = self.shared.series();
            let list = series.since(seen, self.vehicle);
            (series.number(), list)
        };
        self.sample = number;
        let list = list.unwrap_or_else(|| {
            self.known = (0, 0);
            self.series(out);
            vec![self.shared.series().values(self.vehicle)]
        });
        let said = list.into_iter().map(|(time_s, list)| values(time_s, &list));
        out.extend(said.map(Message::Binary));
    }

    fn state(&mut self, wall: Duration, now_s: f64, ended: Option<String>) -> State {
        let shared = &self.shared;
        let progress = shared.progress.get();
        let time_s = progress.map_or(0.0, |p| p.now().as_secs_f64()).max(now_s);
        self.past.push_back((wall, time_s));
        while self.past.len() > 2 && wall.saturating_sub(self.past[1].0) >= SPEED {
            self.past.pop_front();
        }
        let (from, from_s) = self.past[0];
        let passed_s = wall.saturating_sub(from).as_secs_f64();
        let control = shared.control.get();
        let paused = control.is_some_and(|control| control.is_paused());
        let still = passed_s <= 0.0 || ended.is_some();
        State {
            time_s,
            paused,
            factor: control.and_then(|control| control.factor()),
            speed: if still {
                0.0
            } else {
                (time_s - from_s) / passed_s
            },
            ended,
            events: progress.map_or(0, |progress| progress.events()),
            viewers: shared.pages.load(Ordering::Relaxed),
            skipped: self.skipped,
        }
    }

    /// Says how the run goes, if that has changed.
    fn say_state(&mut self, now_s: f64, ended: Option<String>, out: &mut Vec<Message>) {
        let wall = self.begun.elapsed();
        if self.said.is_some() && wall.saturating_sub(self.said_at) < STATE {
            return;
        }
        let state = self.state(wall, now_s, ended);
        if self.said.as_ref() == Some(&state) {
            return;
        }
        self.said_at = wall;
        self.said = Some(state.clone());
        let State {
            time_s,
            paused,
            factor,
            speed,
            ended,
            events,
            viewers,
            skipped,
        } = state;
        let said = Said::State {
            time_s,
            paused,
            factor,
            speed,
            ended,
            events,
            viewers,
            skipped,
        };
        out.push(said.message());
    }

    /// What goes with a frame.
    fn beside(&mut self, now: &Now) -> Beside {
        let marks = now.marks.since(self.marks, MARKS_MAX);
        self.marks = now.marks.end();
        let packets = now.packets.since(self.packets, PACKETS_MAX);
        self.packets = now.packets.end();
        let links = now.links.since(&mut self.links);
        let wind = now.wind.since(&mut self.wind);
        Beside {
            marks,
            packets,
            whole: links.into_iter().chain(wind).collect(),
        }
    }

    fn select(&mut self, vehicle: Option<u32>) {
        self.vehicle = vehicle;
        self.details = 0;
        self.known.1 = 0;
        // The newest values come once more, with those of this vehicle.
        self.sample = self.sample.saturating_sub(1);
        if let Some(vehicle) = vehicle {
            self.shared.series().follow(vehicle);
        }
        self.shared.want(self.number, |want| want.vehicle = vehicle);
    }
}

impl Page for LivePage {
    fn hear(&mut self, asked: Asked, out: &mut Vec<Message>) {
        match asked {
            Asked::Select { vehicle, .. } => {
                let count = self.shared.vehicles.get().copied().unwrap_or(0);
                match vehicle.filter(|vehicle| *vehicle >= count) {
                    Some(none) => Self::error(
                        out,
                        format!(
                            "there is no vehicle {none}: they are numbered from 0, and are {count}"
                        ),
                    ),
                    None => self.select(vehicle),
                }
            }
            Asked::Colour { by } => {
                let names = self.shared.series().names();
                match by.as_ref().filter(|by| !names.contains(by)) {
                    Some(none) => Self::error(
                        out,
                        format!(
                            "no vehicle has a number called {none:?}; there are: {}",
                            names.join(", ")
                        ),
                    ),
                    None => {
                        self.colour.clone_from(&by);
                        self.recolour = true;
                        self.shared.want(self.number, |want| want.colour = by);
                    }
                }
            }
            Asked::Got { time_s } => {
                while self.on_the_way.front().is_some_and(|sent| *sent <= time_s) {
                    self.on_the_way.pop_front();
                }
            }
            Asked::History { id } => {
                let history = self.shared.series().history(id).cloned();
                match history {
                    Some(history) => {
                        let (times_s, values) = (history.times_s, history.values);
                        let said = Said::History {
                            id,
                            times_s,
                            values,
                        };
                        out.push(said.message());
                    }
                    None => Self::error(
                        out,
                        format!("there is no series {id}, or nothing of it is kept"),
                    ),
                }
            }
            Asked::Fetch { .. } => {
                Self::error(
                    out,
                    "this is a live run: what was is not kept, but recordings are",
                );
            }
            // Done at once, whoever asks.
            _ => {}
        }
    }

    fn speak(&mut self, out: &mut Vec<Message>) -> Duration {
        if !self.greeted {
            self.greet(out);
        }
        let free = self.on_the_way.len() < ON_THE_WAY;
        let mut beside = Beside::default();
        let (look, time_s, ended): (Option<Arc<Look>>, f64, Option<String>) = {
            let shared = Arc::clone(&self.shared);
            let now = shared.now();
            let (time_s, ended) = (now.look.columns.time_s, now.ended.clone());
            // Nobody takes another look after the end, nor of a run that stands in colours that another page has
            // chosen: the last one is shown in them.
            let by = self.colour.as_ref();
            let has = by.is_none_or(|by| now.look.colours.iter().any(|(name, _)| name == by));
            let again = self.recolour && (has || ended.is_some());
            let new = now.number > self.look || again;
            let look = (new && free).then(|| Arc::clone(&now.look));
            if look.is_some() {
                let missed = now.number.saturating_sub(self.look + 1);
                self.skipped += missed * u64::from(self.look > 0);
                self.look = now.number;
                self.recolour = false;
                beside = self.beside(&now);
            }
            if let Some(vehicle) = self.vehicle {
                let details = now.details.get(&vehicle);
                let details = details.and_then(|details| details.since(&mut self.details));
                beside.whole.extend(details);
            }
            (look, time_s, ended)
        };
        beside.say(out);
        let over = ended.is_some();
        self.say_state(time_s, ended, out);
        let (number, counts) = {
            let series = self.shared.series();
            (series.number(), series.counts())
        };
        if counts.0 > self.known.0 || (self.vehicle.is_some() && counts.1 > self.known.1) {
            self.series(out);
        }
        if number > self.sample && (look.is_some() || out.len() <= 1) {
            self.samples(number, out);
        }
        if let Some(look) = look {
            let colour: Option<Arc<[f32]>> = self.colour.as_ref().and_then(|by| match over {
                true => self.shared.series().column(by).map(Arc::from),
                false => {
                    let mut colours = look.colours.iter();
                    let colour = colours.find(|(name, _)| name == by);
                    colour.map(|(_, values)| Arc::clone(values))
                }
            });
            out.push(Message::Binary(frame(&look.columns, colour.as_deref())));
            self.on_the_way.push_back(look.columns.time_s);
        }
        if self.on_the_way.len() < ON_THE_WAY {
            self.shared.hungry.store(true, Ordering::Release);
        }
        STATE
    }
}

impl Drop for LivePage {
    fn drop(&mut self) {
        self.shared.leave(self.number);
    }
}

/// The paces that a page may ask for: with less the run would seem dead.
const PACES: std::ops::RangeInclusive<f64> = 0.001..=1000.0;

/// The longest step that a page may ask for, s.
const STEP_MAX_S: f64 = 3600.0;

/// Does at once what a page asks of the run.
pub(super) fn command(shared: &Shared, asked: &Asked) -> Result<bool, String> {
    let Some(control) = shared.control.get() else {
        return Ok(false);
    };
    check(asked)?;
    match *asked {
        Asked::Pause {} => control.pause(),
        Asked::Resume {} => control.resume(),
        Asked::Pace { factor } => control.set_factor(factor).map_err(|e| e.to_string())?,
        Asked::Step {
            instants: Some(instants),
            seconds: None,
        } => control.step(instants),
        Asked::Step {
            instants: None,
            seconds: Some(seconds),
        } => control.step_by(nanoseconds(seconds).max(1)),
        Asked::Step { .. } => return Err("a step has instants, or seconds".to_owned()),
        _ => return Ok(false),
    }
    Ok(true)
}

/// Whether the numbers of a command are allowed.
fn check(asked: &Asked) -> Result<(), String> {
    match *asked {
        Asked::Pace { factor: Some(f) } if !PACES.contains(&f) => Err(format!(
            "a pace of {f}: it is {} to {}, or null for as fast as possible",
            PACES.start(),
            PACES.end()
        )),
        Asked::Step {
            seconds: Some(s), ..
        } if !(s > 0.0 && s <= STEP_MAX_S) => Err(format!(
            "a step of {s} s: it is above zero, and at most {STEP_MAX_S} s"
        )),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paces_and_steps_are_within_reason() {
        let pace = |factor| check(&Asked::Pace { factor }).is_ok();
        for factor in [None, Some(0.001), Some(1.0), Some(1000.0)] {
            assert!(pace(factor), "{factor:?}");
        }
        for factor in [1e-300, 0.0, -1.0, 1e300] {
            assert!(!pace(Some(factor)), "{factor}");
        }
        let step = |seconds| {
            let seconds = Some(seconds);
            let instants = None;
            check(&Asked::Step { instants, seconds }).is_ok()
        };
        assert!(step(0.1) && step(3600.0));
        assert!(!step(0.0) && !step(-1.0) && !step(1e300));
    }
}

//! One page that looks at a recording: it asks for spans of time, and gets what is in them.

use super::{Shown, details, past};
use crate::series::{History, Series};
use crate::server::Page;
use crate::wire::{
    Asked, Link, Message, Packet, Said, SeriesInfo, best, frame, nanoseconds, seconds, values,
};
use simbeeotic_record::Links;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

/// Packets that go with one frame.
const PACKETS_MAX: usize = 500;

/// How often it is looked whether the recording has been read.
const READING: Duration = Duration::from_millis(50);

/// How long a page that asks for nothing is left alone.
const IDLE: Duration = Duration::from_secs(10);

/// A page of a recording.
pub(super) struct ReplayPage {
    shown: Arc<Shown>,
    greeted: bool,
    /// Whether it was told what is known of the whole recording.
    told: bool,
    vehicle: Option<u32>,
    colour: Option<String>,
    /// What the selected vehicle published.
    numbers: BTreeMap<String, History>,
    /// What its radios did, if only packets tell.
    counted: BTreeMap<String, details::Counted>,
    fetch: Option<Fetch>,
}

/// A span of time that is being sent.
struct Fetch {
    id: u32,
    times_ns: Vec<u64>,
    next: usize,
    /// Up to where packets and links have been sent, ns; they begin behind it.
    told_ns: u64,
    to_ns: u64,
}

impl ReplayPage {
    pub(super) fn new(shown: Arc<Shown>) -> Self {
        Self {
            shown,
            greeted: false,
            told: false,
            vehicle: None,
            colour: None,
            numbers: BTreeMap::new(),
            counted: BTreeMap::new(),
            fetch: None,
        }
    }

    fn error(out: &mut Vec<Message>, text: impl Into<String>) {
        let text = text.into();
        out.push(Said::Error { text }.message());
    }

    /// Tells marks, series and wind, once they have been read.
    fn tell_past(&mut self, out: &mut Vec<Message>) {
        let Some(past) = self.shown.past.get() else {
            return;
        };
        self.told = true;
        past.faults.iter().for_each(|text| Self::error(out, text));
        out.push(
            Said::Marks {
                list: past.marks.clone(),
                dropped: past.marks_dropped,
            }
            .message(),
        );
        let list = past.series.statistics_from(0);
        let ids: Vec<u32> = list.iter().map(|info| info.id).collect();
        out.push(Said::Series { list }.message());
        for id in ids {
            if let Some(history) = past.series.history(id) {
                out.push(told(id, history.clone()));
            }
        }
        out.extend(past.wind.iter().map(|wind| {
            let t = seconds(wind.time_ns);
            let arrows = wind.arrows.clone();
            Said::Wind { t, arrows }.message()
        }));
    }

    fn select(&mut self, vehicle: u32, time_ns: u64, out: &mut Vec<Message>) {
        let path = &self.shown.recording.vehicles()[vehicle as usize].path;
        if self.vehicle != Some(vehicle) {
            self.vehicle = Some(vehicle);
            self.numbers = past::of_vehicle(&self.shown.recording, path);
            self.counted = details::count(&self.shown, vehicle);
            let list: Vec<SeriesInfo> = self.shown.past().series.of_vehicle(vehicle);
            let known = |info: &SeriesInfo| self.numbers.contains_key(&info.name);
            let list: Vec<SeriesInfo> = list.into_iter().filter(known).collect();
            if !list.is_empty() {
                out.push(Said::Series { list }.message());
            }
        }
        let details = details::tell(&self.shown, vehicle, time_ns, &self.numbers, &self.counted);
        out.push(Said::Details(details).message());
    }

    fn history(&self, id: u32) -> Option<History> {
        if let Some((column, vehicle)) = Series::parts_of(id) {
            let list = self.shown.past().series.of_vehicle(vehicle);
            let name = &list.get(column)?.name;
            if self.vehicle == Some(vehicle) {
                return self.numbers.get(name).cloned();
            }
            let path = &self.shown.recording.vehicles().get(vehicle as usize)?.path;
            return past::of_vehicle(&self.shown.recording, path).remove(name);
        }
        self.shown.past().series.history(id).cloned()
    }

    /// Sends one frame of a fetch, and what happened since the one before.
    fn go_on(&mut self, fetch: &mut Fetch, out: &mut Vec<Message>) {
        let shown = &self.shown;
        let left = &fetch.times_ns[fetch.next..];
        let Some(&time_ns) = left.first() else {
            self.tell_air(fetch.told_ns, fetch.to_ns, out);
            out.push(Said::Fetched { id: fetch.id }.message());
            return;
        };
        let time_s = seconds(time_ns);
        if fetch.next > 0 {
            self.tell_air(fetch.told_ns, time_ns, out);
        }
        fetch.told_ns = time_ns;
        fetch.next += 1;
        if let Some(past) = shown.past.get() {
            let values = values(time_s, &self.values(&past.series, time_s));
            out.push(Message::Binary(values));
        }
        if let Some(columns) = shown.film.frame(&shown.recording, left) {
            let colour = self.colour.as_ref();
            let colour = colour.and_then(|by| shown.past().column(by, time_s));
            out.push(Message::Binary(frame(&columns, colour.as_deref())));
        } else {
            Self::error(out, format!("the recording is damaged at {time_s} s"));
        }
    }

    fn values(&self, series: &Series, time_s: f64) -> Vec<(u32, f64)> {
        let run = series.statistics_from(0).into_iter();
        let run = run.filter_map(|info| Some((info.id, series.history(info.id)?.at(time_s))));
        let mut list: Vec<(u32, f64)> = run.collect();
        if let Some(vehicle) = self.vehicle {
            let own = series.of_vehicle(vehicle).into_iter();
            list.extend(own.filter_map(|info| {
                let history = self.numbers.get(&info.name)?;
                Some((info.id, history.at(time_s)))
            }));
        }
        list
    }

    /// Packets and links behind one time and up to another.
    fn tell_air(&self, from_ns: u64, to_ns: u64, out: &mut Vec<Message>) {
        if to_ns <= from_ns {
            return;
        }
        let times = from_ns + 1..=to_ns;
        let shown = &self.shown;
        let (mut list, mut dropped) = (Vec::new(), 0);
        for packet in shown.recording.packets_in(times.clone()).flatten() {
            if list.len() >= PACKETS_MAX {
                dropped += 1;
                continue;
            }
            let Some(from) = shown.vehicle(&packet.sender) else {
                continue;
            };
            let to = packet.receptions.iter();
            let to = to.filter_map(|one| Some((shown.vehicle(&one.radio)?, one.rssi_dbm)));
            list.push(Packet {
                t: seconds(packet.time_ns),
                from,
                bytes: packet.bytes,
                to: to.collect(),
            });
        }
        if !list.is_empty() {
            out.push(Said::Packets { list, dropped }.message());
        }
        if let Some(links) = shown.recording.links_in(times).flatten().last() {
            out.push(
                Said::Links {
                    t: seconds(links.time_ns),
                    period_s: links.period_s,
                    list: self.links(&links),
                }
                .message(),
            );
        }
    }

    fn links(&self, links: &Links) -> Vec<Link> {
        let radios: Vec<Option<u32>> = (links.radios.iter())
            .map(|radio| self.shown.vehicle(radio))
            .collect();
        let radio = |place: u32| radios.get(place as usize).copied().flatten();
        let heard = links.links.iter().filter(|link| link.received > 0);
        let list = heard.filter_map(|link| {
            Some((
                radio(link.from)?,
                radio(link.to)?,
                link.rssi_dbm,
                link.share(),
            ))
        });
        best(list.collect())
    }
}

fn told(id: u32, history: History) -> Message {
    let (times_s, values) = (history.times_s, history.values);
    Said::History {
        id,
        times_s,
        values,
    }
    .message()
}

impl Page for ReplayPage {
    fn hear(&mut self, asked: Asked, out: &mut Vec<Message>) {
        match asked {
            Asked::Select { vehicle: None, .. } => {
                self.vehicle = None;
                self.numbers.clear();
                self.counted.clear();
            }
            Asked::Select {
                vehicle: Some(vehicle),
                t,
            } => {
                let count = self.shown.recording.vehicles().len();
                let end_ns = self.shown.recording.end_ns();
                let time_ns = t.map_or(end_ns, nanoseconds);
                match (vehicle as usize) < count {
                    true => self.select(vehicle, time_ns, out),
                    false => Self::error(
                        out,
                        format!(
                            "there is no vehicle {vehicle}: they are numbered from 0, and are {count}"
                        ),
                    ),
                }
            }
            Asked::Colour { by } => {
                let names = self.shown.past().series.names();
                match by.as_ref().filter(|by| !names.contains(by)) {
                    Some(none) => Self::error(
                        out,
                        format!(
                            "no vehicle has a number called {none:?}; there are: {}",
                            names.join(", ")
                        ),
                    ),
                    None => self.colour = by,
                }
            }
            Asked::Fetch {
                id,
                from_s,
                to_s,
                step_s,
            } => {
                if step_s < 0.0 {
                    let text = format!("a fetch by {step_s} s is none: 0 is all ticks");
                    return Self::error(out, text);
                }
                // A span that ends before it begins is the one tick where it begins.
                let span_s = [from_s, to_s.max(from_s), step_s];
                let [from_ns, to_ns, step_ns] = span_s.map(nanoseconds);
                self.fetch = Some(Fetch {
                    id,
                    times_ns: self.shown.film.wanted(from_ns, to_ns, step_ns),
                    next: 0,
                    told_ns: from_ns,
                    to_ns,
                });
            }
            Asked::History { id } => match self.history(id) {
                Some(history) => out.push(told(id, history)),
                None => Self::error(out, format!("there is no series {id}")),
            },
            // Nothing waits for frames to be drawn: a page asks for what it wants.
            _ => {}
        }
    }

    fn speak(&mut self, out: &mut Vec<Message>) -> Duration {
        if !self.greeted {
            self.greeted = true;
            out.push(self.shown.hello.clone());
            // What is there at once goes first: the rest may take a while.
            return Duration::ZERO;
        }
        if !self.told {
            self.tell_past(out);
        }
        let Some(mut fetch) = self.fetch.take() else {
            return if self.told { IDLE } else { READING };
        };
        let over = fetch.next >= fetch.times_ns.len();
        self.go_on(&mut fetch, out);
        if !over {
            self.fetch = Some(fetch);
        }
        Duration::ZERO
    }
}

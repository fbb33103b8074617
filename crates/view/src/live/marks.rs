//! What happened since the last look: contacts, lines of the log, numbers that models published.
//!
//! It waits here until a lock is free: the run never waits for a page. Pages make words of it.

use super::shared::{MARKS_KEPT, Shared};
use super::viewer::Cast;
use crate::series::Series;
use crate::wire;
use simbeeotic_model::kernel::{ModelId, SimTime};
use simbeeotic_model::world::ObjectId;
use simbeeotic_model::{Mark, Thing, View};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// Marks of one look that pages are told: the newest.
const MARKS_MAX: usize = 200;

/// Published numbers that wait at most; then the run does wait, as none may be lost.
const PUBLISHED_MAX: usize = 100_000;

/// A contact, or a line of the log.
#[derive(Clone, Debug)]
pub(super) struct Event {
    time: SimTime,
    who: [Option<u32>; 2],
    what: What,
}

#[derive(Clone, Debug)]
enum What {
    /// With a body, or with what is named.
    Contact(Option<Arc<str>>),
    Log(Arc<str>),
}

impl Event {
    /// As pages are told.
    pub(super) fn told(&self) -> wire::Mark {
        let (kind, text) = match &self.what {
            What::Contact(name) => ("contact", name.as_deref().unwrap_or_default()),
            What::Log(text) => ("log", &**text),
        };
        wire::Mark {
            t: self.time.as_secs_f64(),
            kind: kind.into(),
            who: self.who.into_iter().flatten().collect(),
            text: text.to_owned(),
        }
    }
}

/// A number that a model published.
struct Published {
    model: ModelId,
    name: &'static str,
    unit: &'static str,
    value: f64,
}

/// What waits for pages, and what was counted.
#[derive(Default)]
pub(super) struct Happened {
    /// Contacts since the start.
    pub(super) touches: u64,
    waiting: VecDeque<Event>,
    left_out: u64,
    published: Vec<Published>,
    /// What was touched so far.
    names: BTreeMap<ObjectId, Arc<str>>,
    ground: Option<Arc<str>>,
}

impl Happened {
    /// Takes contacts, log lines and numbers from what is new.
    pub(super) fn take(&mut self, view: &View<'_>, cast: &Cast) {
        // The newest are told.
        let worth_telling = |mark: &&Mark| matches!(mark, Mark::Touch { .. } | Mark::Log { .. });
        let count = view.marks().iter().filter(worth_telling).count();
        let mut skip = count.saturating_sub(MARKS_MAX);
        self.left_out += skip as u64;
        for mark in view.marks() {
            let event = match mark {
                Mark::Touch { time, a, b } => {
                    self.touches += 1;
                    if skip > 0 {
                        skip -= 1;
                        continue;
                    }
                    Event {
                        time: *time,
                        who: [cast.vehicle(*a), b.model().and_then(|b| cast.vehicle(b))],
                        what: What::Contact(self.name(view, *b)),
                    }
                }
                Mark::Log { .. } if skip > 0 => {
                    skip -= 1;
                    continue;
                }
                Mark::Log { time, model, text } => Event {
                    time: *time,
                    who: [cast.vehicle(*model), None],
                    what: What::Log(text.as_str().into()),
                },
                Mark::Metric {
                    model,
                    name,
                    value,
                    unit,
                    ..
                } => {
                    self.published.push(Published {
                        model: *model,
                        name,
                        unit,
                        value: *value,
                    });
                    continue;
                }
                _ => continue,
            };
            self.waiting.push_back(event);
        }
        while self.waiting.len() > MARKS_KEPT {
            self.waiting.pop_front();
            self.left_out += 1;
        }
    }

    /// What a contact with a thing is called; `None`: the body of a model.
    fn name(&mut self, view: &View<'_>, thing: Thing) -> Option<Arc<str>> {
        match thing {
            Thing::Model(_) => None,
            Thing::Ground => Some(self.ground.get_or_insert_with(|| "ground".into()).clone()),
            Thing::Object(object) => {
                let name = self.names.entry(object);
                let name = name.or_insert_with(|| match view.world().label_of(object) {
                    "" => object.to_string().into(),
                    label => format!("{object} {label}").into(),
                });
                Some(Arc::clone(name))
            }
        }
    }

    /// Hands over what waits, as far as nobody else is at it.
    pub(super) fn hand_over(&mut self, view: &View<'_>, cast: &Cast, shared: &Shared) {
        if !self.published.is_empty() {
            let series = match self.published.len() < PUBLISHED_MAX {
                true => shared.try_series(),
                false => Some(shared.series()),
            };
            if let Some(mut series) = series {
                self.publish(view, cast, &mut series);
            }
        }
        if self.waits()
            && let Some(mut now) = shared.try_now()
        {
            now.marks.skip(std::mem::take(&mut self.left_out));
            self.waiting
                .drain(..)
                .for_each(|event| now.marks.push(event));
        }
    }

    /// Whether something could not be handed over yet.
    pub(super) fn waits(&self) -> bool {
        self.left_out > 0 || !self.waiting.is_empty()
    }

    /// Puts what was published among the series.
    pub(super) fn publish(&mut self, view: &View<'_>, cast: &Cast, series: &mut Series) {
        for number in self.published.drain(..) {
            let Published {
                model,
                name,
                unit,
                value,
            } = number;
            match cast.vehicle(model) {
                Some(vehicle) => series.publish(name, unit, vehicle, value),
                None => {
                    let path = view.population().path(model);
                    let at = series.statistic(&format!("{path}/{name}"), unit);
                    series.set(at, value);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_event_is_told_with_those_whom_it_happened_to() {
        let event = |what| Event {
            time: SimTime::from_nanos(1_500_000_000),
            who: [Some(3), None],
            what,
        };
        let contact = event(What::Contact(Some("ground".into()))).told();
        assert_eq!((contact.t, &*contact.kind), (1.5, "contact"));
        assert_eq!((contact.who, contact.text.as_str()), (vec![3], "ground"));
        let line = event(What::Log("found a flower".into())).told();
        assert_eq!((&*line.kind, line.text.as_str()), ("log", "found a flower"));
    }
}

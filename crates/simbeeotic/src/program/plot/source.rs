//! What is drawn: a part of a recording.

use super::super::arguments::PlotOptions;
use super::super::{Failure, input, remark};
use simbeeotic_kernel::SimTime;
use simbeeotic_record::{Links, Recording};
use std::ops::RangeInclusive;

/// A recording and the times that are wanted of it.
pub(super) struct Source {
    pub(super) recording: Recording,
    pub(super) times_ns: RangeInclusive<u64>,
}

impl Source {
    pub(super) fn open(options: &PlotOptions) -> Result<Self, Failure> {
        let recording = Recording::open(&options.recording).map_err(Failure::input)?;
        if recording.truncated() {
            remark(format!(
                "note: {} was cut off; it reads up to {}",
                options.recording.display(),
                SimTime::from_nanos(recording.end_ns())
            ));
        }
        let nanos = |option: &str, text: &Option<String>, or: u64| match text {
            None => Ok(or),
            Some(text) => SimTime::from_time(input::span(option, text)?)
                .map(SimTime::nanos)
                .map_err(|e| Failure::input(format!("{option}: {e}"))),
        };
        let (from, to) = (
            nanos("--from", &options.from, 0)?,
            nanos("--to", &options.to, u64::MAX)?,
        );
        if from > to {
            return Err(Failure::input(format!(
                "--from {} is after --to {}: there is nothing between them",
                SimTime::from_nanos(from),
                SimTime::from_nanos(to)
            )));
        }
        Ok(Self {
            recording,
            times_ns: from..=to,
        })
    }

    /// The links, period by period.
    pub(super) fn links(&self) -> Result<Vec<Links>, Failure> {
        let links = self.recording.links_in(self.times_ns.clone());
        let links = links.collect::<Result<Vec<_>, _>>().map_err(Failure::run)?;
        if links.is_empty() {
            return Err(self.nothing(
                self.recording.links_in(0..=u64::MAX).next().is_some(),
                "links",
                "run the scenario with the packets of 2 to 256 radios recorded: \
                 --set 'component.recorder.packets=[\"bee-1*\"]' for some of a large swarm, [\"*\"] for all \
                 of a small one",
            ));
        }
        Ok(links)
    }

    /// Says that there is nothing to draw, and how to have it.
    pub(super) fn nothing(&self, elsewhere: bool, what: &str, help: &str) -> Failure {
        let file = self.recording.path().display();
        Failure::input(match elsewhere {
            true => format!("{file} has no {what} between these times"),
            false => format!("{file} has no {what}: {help}"),
        })
    }

    /// The recorded scenario's name and the times that are drawn, for the line below the title.
    pub(super) fn caption(&self, first_ns: u64, last_ns: u64, more: &str) -> String {
        let name = self
            .recording
            .metadata("run")
            .and_then(|run| run.get("name"));
        let name = name.map_or("", String::as_str);
        let seed = self.recording.seed().map_or(0, u64::cast_signed);
        format!(
            "{name}, seed {seed}, {} to {}: {more}",
            said(first_ns),
            said(last_ns)
        )
    }
}

/// A time without digits that say nothing.
fn said(time_ns: u64) -> String {
    format!("{} s", (time_ns as f64 * 1e-6).round() * 1e-3)
}

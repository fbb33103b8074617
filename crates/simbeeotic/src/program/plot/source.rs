//! What is drawn: a part of a recording, or of several.

use super::super::{Failure, input, remark, same_file};
use super::arguments::PlotOptions;
use simbeeotic_kernel::SimTime;
use simbeeotic_record::{Links, Recording, Stage};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

/// A recording and the times that are wanted of it.
pub(super) struct Source {
    pub(super) recording: Recording,
    /// The trace hash, if the run came to its end.
    trace: Option<String>,
    pub(super) times_ns: RangeInclusive<u64>,
}

/// One recording or more.
pub(super) struct Sources(Vec<Source>);

impl Sources {
    pub(super) fn open(options: &PlotOptions) -> Result<Self, Failure> {
        let nanos = |option, text: &Option<String>| input::nanos(option, text.as_deref());
        let from = nanos("--from", &options.from)?.unwrap_or(0);
        let to = nanos("--to", &options.to)?.unwrap_or(u64::MAX);
        input::in_order(from, to, true)?;
        let recordings = listed(&options.recordings)?;
        let sources: Vec<Source> = (recordings.iter())
            .map(|path| Source::open(path, from..=to))
            .collect::<Result<_, _>>()?;
        for (at, path) in recordings.iter().enumerate() {
            if recordings[..at].iter().any(|other| same_file(other, path)) {
                return Err(Failure::input(format!(
                    "{} is given twice: one run would count as two",
                    path.display()
                )));
            }
            if same_file(path, &options.output) {
                return Err(Failure::input(format!(
                    "{} is the recording itself; choose another name for the picture",
                    options.output.display()
                )));
            }
        }
        for (at, source) in sources.iter().enumerate() {
            if let Some(other) = sources[..at].iter().find(|other| other.is_run_of(source)) {
                let seed = source.recording.seed().map_or(0, u64::cast_signed);
                return Err(Failure::input(format!(
                    "{} and {} are one and the same run (scenario {:?}, seed {seed}): it would count as two; \
                     leave one of them out",
                    other.file(),
                    source.file(),
                    source.name()
                )));
            }
        }
        Ok(Self(sources))
    }

    /// All of them; never empty.
    pub(super) fn all(&self) -> &[Source] {
        &self.0
    }

    /// The first, and whether it is the only one.
    pub(super) fn first(&self) -> &Source {
        &self.0[0]
    }

    /// What was run, and the times that are drawn, for the line below the title.
    pub(super) fn caption(&self, first_ns: u64, last_ns: u64, more: &str) -> String {
        if let [one] = self.0.as_slice() {
            return one.caption(first_ns, last_ns, more);
        }
        let seeds: Vec<u64> = self.0.iter().filter_map(|s| s.recording.seed()).collect();
        let seeds = match (seeds.iter().min(), seeds.iter().max()) {
            (Some(a), Some(b)) if a == b => format!(", seed {}", a.cast_signed()),
            (Some(a), Some(b)) => format!(", seeds {} to {}", a.cast_signed(), b.cast_signed()),
            _ => String::new(),
        };
        let name = self.first().name();
        let same = self.0.iter().all(|source| source.name() == name);
        let name = if same {
            name
        } else {
            "several scenarios".to_owned()
        };
        format!(
            "{name}, {} runs{seeds}, {} to {}: {more}",
            self.0.len(),
            said(first_ns),
            said(last_ns)
        )
    }
}

/// The recordings of arguments: a folder stands for all that are in it, in the order of their names.
fn listed(arguments: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut all = Vec::new();
    for argument in arguments {
        if !argument.is_dir() {
            all.push(argument.clone());
            continue;
        }
        let unread = |e| Failure::input(format!("cannot read {}: {e}", argument.display()));
        let mut inside = Vec::new();
        for entry in std::fs::read_dir(argument).map_err(unread)? {
            let path = entry.map_err(unread)?.path();
            if path.extension().is_some_and(|ending| ending == "mcap") {
                inside.push(path);
            }
        }
        if inside.is_empty() {
            return Err(Failure::input(format!(
                "{}: there is no recording in this folder: none of its files ends in .mcap",
                argument.display()
            )));
        }
        inside.sort();
        all.extend(inside);
    }
    Ok(all)
}

impl Source {
    fn open(path: &Path, times_ns: RangeInclusive<u64>) -> Result<Self, Failure> {
        let recording = Recording::open(path).map_err(Failure::input)?;
        if recording.truncated() {
            remark(format!(
                "note: {} was cut off; it reads up to {}",
                path.display(),
                SimTime::from_nanos(recording.end_ns())
            ));
        }
        let summary = recording.summary();
        let trace = summary
            .as_ref()
            .and_then(|summary| summary.get("trace_hash"));
        Ok(Self {
            trace: trace.and_then(|hash| hash.as_str()).map(str::to_owned),
            recording,
            times_ns,
        })
    }

    /// Whether both are of one run: its scenario, its seed and, if both came to their ends, its trace.
    fn is_run_of(&self, other: &Self) -> bool {
        let (a, b) = (&self.recording, &other.recording);
        let same = a.seed().is_some() && a.seed() == b.seed() && a.scenario() == b.scenario();
        same && match (&self.trace, &other.trace) {
            (Some(a), Some(b)) => a == b,
            // One was cut off, or they were not written by a run of ours.
            _ => a.truncated() || b.truncated() || a.end_ns() == b.end_ns(),
        }
    }

    /// Whether both have the same trace.
    pub(super) fn flew_as(&self, other: &Self) -> bool {
        self.trace.is_some() && self.trace == other.trace
    }

    /// The links, period by period.
    pub(super) fn links(&self) -> Result<Vec<Links>, Failure> {
        let links = self.recording.links_in(self.times_ns.clone());
        let links = links.collect::<Result<Vec<_>, _>>().map_err(Failure::run)?;
        if links.is_empty() && self.recording.traffic_in(0..=u64::MAX).next().is_none() {
            return Err(self.nothing(
                false,
                "links",
                "there are no radios in it, or it was recorded by an older version",
            ));
        }
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

    /// What stood in the worlds of all, if that was recorded, and how many more things one of them had.
    pub(super) fn common_stage(runs: &[&Self]) -> Result<(Option<Stage>, usize), Failure> {
        let mut common: Option<Stage> = None;
        let mut most = 0;
        for run in runs {
            let Some(own) = run.stage()? else {
                return Ok((None, 0));
            };
            let Some(stage) = &mut common else {
                most = own.props.len();
                common = Some(own);
                continue;
            };
            // Mostly each stands at the same place of both lists.
            let mut place = 0;
            stage.props.retain(|prop| {
                let same = own.props.get(place) == Some(prop) || own.props.contains(prop);
                place += 1;
                same
            });
            most = most.max(own.props.len());
            stage.plane &= own.plane;
        }
        let left = common.as_ref().map_or(0, |stage| stage.props.len());
        Ok((common, most - left))
    }

    /// What stood in its world, if that was recorded.
    pub(super) fn stage(&self) -> Result<Option<Stage>, Failure> {
        self.recording.stage().map_err(Failure::run)
    }

    /// Says that there is nothing to draw, and how to have it.
    pub(super) fn nothing(&self, elsewhere: bool, what: &str, help: &str) -> Failure {
        let file = self.recording.path().display();
        Failure::input(match elsewhere {
            true => format!("{file} has no {what} between these times"),
            false => format!("{file} has no {what}: {help}"),
        })
    }

    /// The file's name, for errors.
    pub(super) fn file(&self) -> String {
        self.recording.path().display().to_string()
    }

    /// The file's name without its folder and ending.
    pub(super) fn stem(&self) -> String {
        let stem = self.recording.path().file_stem();
        stem.map_or(String::new(), |stem| stem.to_string_lossy().into_owned())
    }

    /// The recorded scenario's name; of one that is called by its file, without folder and ending.
    pub(super) fn name(&self) -> String {
        let run = self.recording.metadata("run");
        let name = run.and_then(|run| run.get("name"));
        let name = name.map_or("", String::as_str);
        let path = Path::new(name);
        match (path.extension(), path.file_stem()) {
            (Some(ending), Some(stem)) if ending == "toml" || ending == "xml" => {
                stem.to_string_lossy().into_owned()
            }
            _ => name.to_owned(),
        }
    }

    /// The recorded scenario's name and the times that are drawn, for the line below the title.
    pub(super) fn caption(&self, first_ns: u64, last_ns: u64, more: &str) -> String {
        let name = self.name();
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

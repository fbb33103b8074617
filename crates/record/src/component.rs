//! The recorder as a component of a run: `[[component]] use = "recorder"`.

mod once;
mod run;
mod settings;

pub use settings::{PrecisionChoice, RecorderParams};

use crate::data::{
    Attachment, Event, LogEntry, LogLevel, Metric, Metrics, Picture, Reading, Sample,
};
use crate::radio::{self, Air};
use crate::recorder::{Header, Precision, RecordError, RecordStats, Recorder};
use crate::roster::vehicles_of;
use crate::selection::selects;
use crate::wind::Wind;
use run::RunMetrics;
use settings::Clocks;
use simbeeotic_model::kernel::{ModelId, SimTime};
use simbeeotic_model::units::Time;
use simbeeotic_model::{
    BuildError, Component, ComponentError, FromParams, Image, Mark, Note, Pixels, Summary, Taken,
    Thing, View, component,
};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Records the run: poses and twists of all bodies at regular times, touches, log lines, metrics.
///
/// The file is MCAP; Foxglove and Rerun open it, `simbeeotic export` turns it into a table. It is
/// complete up to at most a second before the end, whatever ends the program. Recording never
/// changes a run.
#[component("recorder")]
pub struct RecorderComponent {
    params: RecorderParams,
    bodies: Vec<ModelId>,
    recorder: Option<Recorder>,
    /// Sensors that have read nothing yet.
    silent: BTreeSet<String>,
    /// `None`: there are no radios.
    air: Option<Air>,
    clocks: Clocks,
    run: RunMetrics,
    /// The wind that was recorded last: it holds until another is.
    arrows: Vec<[f32; 6]>,
    /// What the user should know at the end.
    notes: Vec<String>,
}

impl FromParams for RecorderComponent {
    type Params = RecorderParams;

    fn from_params(params: RecorderParams) -> Result<Self, BuildError> {
        let clocks = Clocks::new(&params)?;
        if params.path.as_os_str().is_empty() {
            return Err(BuildError::parameter("path", "must name a file"));
        }
        Ok(Self {
            params,
            bodies: Vec::new(),
            recorder: None,
            silent: BTreeSet::new(),
            air: None,
            clocks,
            run: RunMetrics::default(),
            arrows: Vec::new(),
            notes: Vec::new(),
        })
    }
}

impl Component for RecorderComponent {
    fn period(&self) -> Option<Time> {
        Some(self.params.period)
    }

    fn wants_reading(&self, sensor: &str) -> bool {
        self.params
            .readings
            .iter()
            .any(|pattern| selects(pattern, sensor))
    }

    fn wants_packets(&self, radio: &str, among: usize) -> bool {
        radio::wants(self.params.packets.as_deref(), radio, among)
    }

    fn next_observation(&self, now: SimTime) -> Option<SimTime> {
        self.clocks.next(now, self.air.is_some())
    }

    fn start(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        self.bodies = view.bodies().collect();
        self.check_patterns(view)?;
        if view.is_calm() {
            self.clocks.wind_period_ns = None;
        }
        self.air = Air::start(view, self.params.packets.as_deref(), &self.params.radios)?;
        let origin = view.origin();
        let (stage, textures, notes) = once::world(view);
        let (models, note) = once::models(view);
        self.notes = notes.into_iter().chain(note).collect();
        let mut files = vec![Attachment {
            name: "scenario.toml".to_owned(),
            media_type: "application/toml".to_owned(),
            bytes: origin.scenario.clone().into_bytes(),
        }];
        files.extend(textures);
        let header = Header {
            version: origin.version.clone(),
            seed: origin.seed,
            scenario: origin.scenario.clone(),
            notes: [("name".to_owned(), origin.name.clone())].into(),
            files,
            vehicles: vehicles_of(view, &self.bodies),
            stage: Some(stage),
            models,
            twists: self.params.twists,
            points: self.params.points,
            precision: match self.params.precision {
                PrecisionChoice::Fine => Precision::Fine,
                PrecisionChoice::Full => Precision::Full,
            },
        };
        self.recorder = Some(Recorder::create(&self.params.path, header).map_err(failed)?);
        Ok(())
    }

    fn observe(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        let Some(recorder) = &mut self.recorder else {
            return Ok(());
        };
        record_marks(recorder, view, &self.params, &mut self.silent).map_err(failed)?;
        self.run.count(view.marks());
        let now_ns = view.now().nanos();
        if let Some(air) = &mut self.air {
            let whole = now_ns.is_multiple_of(self.clocks.radio_period_ns);
            record_air(recorder, view, air, whole, false).map_err(failed)?;
        }
        let wind = self.clocks.wind_period_ns;
        if wind.is_some_and(|period_ns| now_ns.is_multiple_of(period_ns)) {
            record_wind(recorder, view, &self.bodies, &mut self.arrows).map_err(failed)?;
        }
        if !now_ns.is_multiple_of(self.clocks.period_ns) {
            return Ok(());
        }
        if self.params.events {
            let energy_j = record_batteries(recorder, view, &self.bodies).map_err(failed)?;
            if let Some(metrics) = self.run.take(view, self.air.is_some(), energy_j) {
                recorder.metrics(metrics).map_err(failed)?;
            }
        }
        let samples = self.bodies.iter().map(|id| sample(view, *id));
        recorder.tick(now_ns, samples).map_err(failed)
    }

    fn finish(&mut self, view: &View<'_>, summary: &Summary) -> Result<Vec<Note>, ComponentError> {
        let Some(mut recorder) = self.recorder.take() else {
            return Ok(Vec::new());
        };
        record_marks(&mut recorder, view, &self.params, &mut self.silent).map_err(failed)?;
        if let Some(air) = &mut self.air {
            record_air(&mut recorder, view, air, true, true).map_err(failed)?;
        }
        let summary = serde_json::to_value(summary).unwrap_or_default();
        let stats = recorder.finish(&summary).map_err(failed)?;
        let mut notes = vec![Note {
            key: "recording".to_owned(),
            text: describe(&self.params.path, &stats),
        }];
        notes.extend(self.notes.drain(..).map(|text| Note {
            key: "recording".to_owned(),
            text,
        }));
        notes.extend(unread(&self.silent));
        let said = self.params.packets.is_some();
        let air = self.air.iter().flat_map(|air| air.notes(said));
        notes.extend(air.map(|text| Note {
            key: "radio".to_owned(),
            text,
        }));
        Ok(notes)
    }
}

impl RecorderComponent {
    /// A pattern that no sensor matches is a mistake.
    fn check_patterns(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        if self.params.readings.is_empty() {
            return Ok(());
        }
        let models = view.population().iter().map(|(id, _)| id);
        let sensors: Vec<String> = models
            .flat_map(|id| {
                let path = view.population().path(id);
                view.sensors(id).map(move |name| format!("{path}/{name}"))
            })
            .collect();
        self.silent = (sensors.iter())
            .filter(|sensor| self.wants_reading(sensor))
            .cloned()
            .collect();
        let useless = |pattern: &&String| !sensors.iter().any(|sensor| selects(pattern, sensor));
        match self.params.readings.iter().find(useless) {
            None => Ok(()),
            Some(pattern) => {
                let known = match sensors.as_slice() {
                    [] => "there are no sensors".to_owned(),
                    [only] => format!("there is one, {only:?}"),
                    [first, .., last] => {
                        format!("there are {}, from {first:?} to {last:?}", sensors.len())
                    }
                };
                Err(ComponentError::new(format!(
                    "no sensor matches {pattern:?} of the recorder's `readings`; {known}"
                )))
            }
        }
    }
}

/// Frames and receptions since the last time; at the end of a period its counters and links.
fn record_air(
    recorder: &mut Recorder,
    view: &View<'_>,
    air: &mut Air,
    period: bool,
    end: bool,
) -> Result<(), RecordError> {
    for mark in view.marks() {
        match mark {
            Mark::OnAir { air: begun, .. } => air.begun(view, begun),
            Mark::Heard { time, receptions } => air.heard(time.nanos(), receptions),
            _ => {}
        }
    }
    air.write_packets(recorder, view.now().nanos(), end)?;
    if period {
        air.write_period(recorder, view)?;
    }
    Ok(())
}

fn failed(error: RecordError) -> ComponentError {
    ComponentError::new(error.to_string())
}

/// Says that sensors were to be recorded and read nothing.
fn unread(silent: &BTreeSet<String>) -> Option<Note> {
    let first = silent.first()?;
    let more = match silent.len() - 1 {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    Some(Note {
        key: "not read".to_owned(),
        text: format!("{first}{more}: no behaviour reads it; give it a `rate` to have it recorded"),
    })
}

fn describe(path: &std::path::Path, stats: &RecordStats) -> String {
    let size = match stats.bytes {
        bytes if bytes < 1_000_000 => format!("{:.0} kB", bytes as f64 * 1e-3),
        bytes => format!("{:.1} MB", bytes as f64 * 1e-6),
    };
    let blocked = match stats.blocked.as_secs_f64() {
        s if s >= 0.01 => format!("; the run waited {s:.2} s for it"),
        _ => String::new(),
    };
    format!("{}, {size}, {} ticks{blocked}", path.display(), stats.ticks)
}

/// State of charge, voltage and current of each battery, as metrics. What all gave since the start, J, is
/// the answer; `None` if there are none.
fn record_batteries(
    recorder: &mut Recorder,
    view: &View<'_>,
    bodies: &[ModelId],
) -> Result<Option<f64>, RecordError> {
    let mut values = Vec::new();
    let mut energy_j = 0.0;
    for id in bodies {
        let Some((battery, books)) = view.battery_books(*id) else {
            continue;
        };
        energy_j += (books.start - books.stored + books.charged).get();
        let path = view.population().path(*id);
        for (what, unit, value) in [
            ("soc", "1", battery.soc),
            ("voltage", "V", battery.voltage.get()),
            ("current", "A", battery.current.get()),
        ] {
            values.push(Metric {
                name: format!("{path}/battery/{what}"),
                unit: unit.to_owned(),
                value,
            });
        }
    }
    if values.is_empty() {
        return Ok(None);
    }
    recorder.metrics(Metrics {
        time_ns: view.now().nanos(),
        values,
    })?;
    Ok(Some(energy_j))
}

/// The wind around the swarm, if it is another than the `last` that was recorded; none before the first.
fn record_wind(
    recorder: &mut Recorder,
    view: &View<'_>,
    bodies: &[ModelId],
    last: &mut Vec<[f32; 6]>,
) -> Result<(), RecordError> {
    let states = bodies.iter().filter_map(|id| view.state(*id));
    let wind = Wind::around(view, states.map(|state| state.p_enu.as_vec3().to_array()));
    if wind.arrows != *last {
        last.clone_from(&wind.arrows);
        recorder.wind(wind)?;
    }
    Ok(())
}

fn sample(view: &View<'_>, id: ModelId) -> Sample {
    let Some(state) = view.state(id) else {
        return Sample::default();
    };
    let q = state.world_from_body;
    Sample {
        position_m: state.p_enu.to_array(),
        world_from_body: [q.w, q.x, q.y, q.z],
        velocity_m_s: state.v_enu.to_array(),
        rate_rad_s: state.w_flu.to_array(),
    }
}

fn record_marks(
    recorder: &mut Recorder,
    view: &View<'_>,
    params: &RecorderParams,
    silent: &mut BTreeSet<String>,
) -> Result<(), RecordError> {
    let path = |id: ModelId| view.population().path(id).to_owned();
    for mark in view.marks() {
        match mark {
            Mark::Sensed {
                time,
                model,
                sensor,
                taken,
            } => {
                let name = view.sensors(*model).nth(usize::from(*sensor));
                let sensor = format!("{}/{}", path(*model), name.unwrap_or_default());
                // Another component may have asked for it.
                if params
                    .readings
                    .iter()
                    .any(|pattern| selects(pattern, &sensor))
                {
                    silent.remove(&sensor);
                    record_reading(recorder, time.nanos(), sensor, taken)?;
                }
            }
            _ if !params.events => {}
            Mark::Touch { time, a, b } => recorder.event(Event {
                time_ns: time.nanos(),
                kind: "contact".to_owned(),
                paths: std::iter::once(*a).chain(b.model()).map(path).collect(),
                text: match b {
                    Thing::Ground => "ground".to_owned(),
                    Thing::Model(_) => String::new(),
                    Thing::Object(object) => match view.world().label_of(*object) {
                        "" => object.to_string(),
                        label => format!("{object} {label}"),
                    },
                },
            })?,
            Mark::Log { time, model, text } => recorder.log(LogEntry {
                time_ns: time.nanos(),
                level: LogLevel::Info,
                path: path(*model),
                text: text.clone(),
            })?,
            Mark::Metric {
                time,
                model,
                name,
                value,
                unit,
            } => recorder.metrics(Metrics {
                time_ns: time.nanos(),
                values: vec![Metric {
                    name: format!("{}/{name}", path(*model)),
                    unit: (*unit).to_owned(),
                    value: *value,
                }],
            })?,
            _ => {}
        }
    }
    Ok(())
}

/// The pictures of a perfect sensor that differ from those of this one.
fn true_pictures(taken: &Taken) -> impl Iterator<Item = &(&'static str, Image)> {
    taken.ideal_images.iter().filter(|(name, truth)| {
        let mut images = taken.images.iter();
        let read = images.find(|(other, _)| other == name);
        read.is_none_or(|(_, image)| !same(image, truth))
    })
}

/// Pictures without noise share their pixels with the true ones: no pixel is looked at then.
fn same(a: &Image, b: &Image) -> bool {
    let shared = match (&a.pixels, &b.pixels) {
        (Pixels::Grey(a), Pixels::Grey(b)) | (Pixels::Colour(a), Pixels::Colour(b)) => {
            Arc::ptr_eq(a, b)
        }
        (Pixels::Depth(a), Pixels::Depth(b)) => Arc::ptr_eq(a, b),
        (Pixels::Labels(a), Pixels::Labels(b)) => Arc::ptr_eq(a, b),
        _ => false,
    };
    shared && (a.width, a.height) == (b.width, b.height) || a == b
}

fn record_reading(
    recorder: &mut Recorder,
    time_ns: u64,
    sensor: String,
    taken: &Taken,
) -> Result<(), RecordError> {
    let path = |name: &str| match name {
        "" => sensor.clone(),
        name => format!("{sensor}/{name}"),
    };
    for (name, image) in &taken.images {
        recorder.picture(Picture {
            time_ns,
            path: path(name),
            image: image.clone(),
        })?;
    }
    for (name, image) in true_pictures(taken) {
        recorder.picture(Picture {
            time_ns,
            path: format!("{}/truth", path(name)),
            image: image.clone(),
        })?;
    }
    if taken.columns.is_empty() {
        return Ok(());
    }
    let words = |word: fn(&simbeeotic_model::Column) -> &'static str| {
        taken
            .columns
            .iter()
            .map(|column| word(column).to_owned())
            .collect()
    };
    recorder.reading(Reading {
        time_ns,
        sensor,
        names: words(|column| column.name),
        units: words(|column| column.unit),
        truth: taken.ideal.clone(),
        reading: taken.reading.clone(),
        lost: taken.lost,
        unpaired: !taken.paired,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(grey: &[u8]) -> Image {
        Image {
            width: grey.len() as u32,
            height: 1,
            pixels: Pixels::Grey(grey.into()),
        }
    }

    fn taken(
        ideal_images: Vec<(&'static str, Image)>,
        images: Vec<(&'static str, Image)>,
    ) -> Taken {
        Taken {
            columns: &[],
            paired: true,
            ideal: Vec::new(),
            reading: Vec::new(),
            ideal_images,
            images,
            lost: false,
        }
    }

    fn names(taken: &Taken) -> Vec<&'static str> {
        true_pictures(taken).map(|(name, _)| *name).collect()
    }

    #[test]
    fn a_sensor_without_a_reading_is_named() {
        assert_eq!(unread(&BTreeSet::new()), None);
        let two = ["bee/c", "bee/d"].map(str::to_owned);
        let note = unread(&two.into()).expect("there are two");
        assert!(note.text.starts_with("bee/c and 1 more: "), "{}", note.text);
        assert!(note.text.contains("`rate`"), "{}", note.text);
    }

    #[test]
    fn a_true_picture_is_kept_where_it_differs() {
        let (clear, noisy) = (picture(&[1, 2, 3]), picture(&[1, 2, 4]));
        let both = vec![("grey", clear.clone()), ("labels", clear.clone())];
        let read = vec![("grey", noisy), ("labels", clear)];
        assert_eq!(names(&taken(both.clone(), read)), ["grey"]);
        // The same pixels elsewhere are the same picture.
        let copy = vec![
            ("grey", picture(&[1, 2, 3])),
            ("labels", picture(&[1, 2, 3])),
        ];
        assert_eq!(names(&taken(both.clone(), copy)), [""; 0]);
        // Nothing was handed over.
        assert_eq!(names(&taken(both, Vec::new())), ["grey", "labels"]);
    }
}

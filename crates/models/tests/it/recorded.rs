//! What a recording has of a sensor: what its behaviour gets, and the truth beside it.

use crate::swarm::{bee, mounted, setup, with_sensor};
use simbeeotic_model::kernel::{SimTime, Stream};
use simbeeotic_model::units::{Mount, Time};
use simbeeotic_model::{
    Bee, Behavior, BuildError, Component, ComponentError, Handle, Kit, Mark, Note, Sampling,
    Sensor, Simulation, Summary, Taken, Truth, View, behavior, params, sensor,
};
use std::sync::{Arc, Mutex};

/// None.
#[params]
#[derive(Default)]
struct NoParams {}

/// Reads the time, and half a second more: each reading is another one.
#[sensor("test-watch")]
struct Watch;

impl Sensor for Watch {
    type Params = NoParams;
    type Reading = f64;

    fn build(_: NoParams) -> Result<Self, BuildError> {
        Ok(Self)
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> f64 {
        truth.now().as_secs_f64()
    }

    fn measure(&mut self, ideal: f64, _: &Truth<'_>, _: &mut Stream) -> f64 {
        ideal + 0.5
    }
}

/// Reads its watch every 10 ms, and publishes what it gets.
#[behavior("test-reader")]
struct Reader {
    watch: Handle<f64>,
}

impl Behavior for Reader {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        kit.every(Time::from_millis(10.0), Self::look);
        let watch = kit.sensor("watch")?;
        Ok(Self { watch })
    }
}

impl Reader {
    fn look(&mut self, bee: &mut Bee<'_>) {
        let read = bee.read(self.watch);
        bee.metric("got", read, "s");
    }
}

/// What was recorded of each measurement, and what the behaviour got.
#[derive(Clone, Default)]
struct Record {
    taken: Arc<Mutex<Vec<(SimTime, Taken)>>>,
    got: Arc<Mutex<Vec<f64>>>,
}

impl Component for Record {
    fn period(&self) -> Option<Time> {
        Some(Time::from_secs(1.0))
    }

    fn wants_reading(&self, _: &str) -> bool {
        true
    }

    fn start(&mut self, _: &View<'_>) -> Result<(), ComponentError> {
        Ok(())
    }

    fn observe(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        for mark in view.marks() {
            match mark {
                Mark::Sensed { time, taken, .. } => {
                    let mut all = self.taken.lock().expect("one at a time");
                    all.push((*time, (**taken).clone()));
                }
                Mark::Metric { value, .. } => {
                    self.got.lock().expect("one at a time").push(*value);
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn finish(&mut self, view: &View<'_>, _: &Summary) -> Result<Vec<Note>, ComponentError> {
        self.observe(view)?;
        Ok(Vec::new())
    }
}

/// Four seconds of a watch that is sampled so.
fn recorded(sampling: Sampling) -> (Vec<(SimTime, Taken)>, Vec<f64>) {
    sampling.check().expect("good numbers");
    let plan = with_sensor(
        bee("bee", "test-reader", &[], [0.0; 3]),
        "watch",
        "test-watch",
    );
    let record = Record::default();
    let mut setup = setup(vec![mounted(plan, Mount::IDENTITY, sampling)], 4);
    setup
        .components
        .push(("record".to_owned(), Box::new(record.clone())));
    let outcome = Simulation::new(setup).expect("it is whole").run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    let taken = std::mem::take(&mut *record.taken.lock().expect("it is over"));
    let got = std::mem::take(&mut *record.got.lock().expect("it is over"));
    (taken, got)
}

#[test]
fn a_sample_that_is_lost_is_recorded_as_lost_and_the_others_as_the_behaviour_gets_them() {
    let (taken, mut got) = recorded(Sampling {
        period: Some(Time::from_millis(10.0)),
        delay: Time::from_millis(30.0),
        dropout: 0.4,
        ..Sampling::default()
    });
    let lost = taken.iter().filter(|(_, taken)| taken.lost).count();
    assert!((120..=200).contains(&lost), "{lost} of {}", taken.len());
    let mut kept = Vec::new();
    for (time, taken) in &taken {
        // The time is that of the measurement, and the truth is of that time, whatever becomes of it.
        assert_eq!(taken.ideal, [time.as_secs_f64()]);
        if taken.lost {
            assert!(taken.reading.is_empty());
        } else {
            assert_eq!(taken.reading, [time.as_secs_f64() + 0.5]);
            if time.nanos() <= 3_970_000_000 {
                kept.push(taken.reading[0]);
            }
        }
    }
    got.dedup();
    assert_eq!(got, kept, "what has arrived is what is recorded");
}

#[test]
fn on_demand_the_recording_has_what_was_handed_over() {
    let (taken, got) = recorded(Sampling {
        dropout: 0.4,
        ..Sampling::default()
    });
    let recorded: Vec<f64> = taken
        .iter()
        .flat_map(|(_, taken)| taken.reading.clone())
        .collect();
    assert_eq!(recorded, got);
    let lost = taken.iter().filter(|(_, taken)| taken.lost).count();
    assert!((120..=200).contains(&lost), "{lost} of {}", taken.len());
    for (time, taken) in &taken {
        assert_eq!(taken.ideal, [time.as_secs_f64()]);
        assert_eq!(taken.lost, taken.reading[0] != taken.ideal[0] + 0.5);
    }
}

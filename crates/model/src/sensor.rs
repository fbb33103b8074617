//! Sensors: what turns truth into readings.
//!
//! A sensor is chosen in the scenario and read by a behaviour through a [`Handle`] that is typed
//! by the reading, not by the maker: the scenario decides which compass it is. Names and types are
//! checked once, when the behaviour is built; after that a read cannot fail.
//!
//! ```text
//! [model.sensor.compass]        kit.sensor::<Heading>("compass")?      bee.read(self.compass)
//! use = "compass"          ->   Handle<Heading>                   ->   Heading
//! rate = "50 Hz"                kit.on_sample("compass", Self::turned)?
//! ```

use crate::about::Beams;
use crate::behavior::BuildError;
use crate::config::Params;
use crate::image::Image;
use crate::message::Touch;
use crate::reading::{Column, Reading};
use crate::sampling::{Sample, Sampler};
use crate::timer::Call;
use crate::view::Truth;
use simbeeotic_kernel::{SimTime, Stream};
use simbeeotic_radio::Inbox;
use simbeeotic_units::{Current, Mount, Time};
use simbeeotic_world::World;
use std::any::Any;
use std::fmt;
use std::marker::PhantomData;

/// A kind of sensor. Register it with `#[sensor("name")]`.
///
/// A reading is made in two steps: what a perfect sensor would read, and what this one makes of it.
/// So the truth is at hand beside each reading, for the recording and for tests.
pub trait Sensor: Sized + Send + 'static {
    /// What the scenario may set. The keys `use`, `mount`, `rate`, `phase`, `delay`, `dropout` and
    /// `current` are every sensor's.
    type Params: Params;
    /// What one reading is: a quantity or a struct of them.
    type Reading: Reading;

    /// Makes one.
    ///
    /// # Errors
    /// Parameters out of range, by [`BuildError::parameter`].
    fn build(params: Self::Params) -> Result<Self, BuildError>;

    /// Looks up what its parameters name in the world, a place, say. Called once, before it measures.
    ///
    /// # Errors
    /// The world has no such thing, by [`BuildError::parameter`].
    fn look_up(&mut self, _world: &World) -> Result<(), BuildError> {
        Ok(())
    }

    /// What a perfect sensor in this place would read.
    fn ideal(&mut self, truth: &Truth<'_>) -> Self::Reading;

    /// What this sensor reads instead: noise, bias, limits. `rng` is this sensor's own stream.
    fn measure(
        &mut self,
        ideal: Self::Reading,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Self::Reading;

    /// Called when its host's body touches something, before its behaviour hears of it.
    fn touched(&mut self, _touch: &Touch, _truth: &Truth<'_>) {}

    /// Called with everything that one radio of its host heard at this instant, before its behaviour
    /// hears of it; of sensors that [need](Self::needs) a radio only. `radio` is the radio's name.
    fn heard(&mut self, _radio: &str, _inbox: Inbox<'_>) {}

    /// The current it draws while it is on, unless the scenario says another.
    fn current(&self) -> Current {
        Current::ZERO
    }

    /// What must be on board besides itself.
    fn needs(&self) -> Needs {
        Needs::Nothing
    }

    /// Where it looks, for those who draw it; `None` if it looks nowhere. Asked of one that has just been
    /// built: it hangs on the parameters alone.
    fn beams(&self) -> Option<Beams> {
        None
    }
}

/// What a sensor of the platform's own state measures, and so needs on board.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Needs {
    /// Nothing.
    Nothing,
    /// A battery.
    Battery,
    /// A vehicle.
    Motors,
    /// A radio: the one of this name, or any.
    Radio(Option<String>),
}

/// A checked way to one sensor of one's own platform, with readings of type `R`.
pub struct Handle<R> {
    pub(crate) index: u16,
    pub(crate) reading: PhantomData<fn() -> R>,
}

impl<R> Clone for Handle<R> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R> Copy for Handle<R> {}

impl<R> fmt::Debug for Handle<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Handle({})", self.index)
    }
}

/// A [`Sensor`] on its platform, its type forgotten. Every sensor becomes one.
pub trait AnySensor: Send {
    /// Writes what a behaviour reads now into `out`, an `Option<Sample<Reading>>`.
    fn read_into(&mut self, truth: &mut Truth<'_>, out: &mut dyn Any);

    /// First sample and period, if it has a rate; and the delay, if a method waits for samples.
    fn timing(&self) -> Option<(Time, Time, Time)>;

    /// Takes the sample that is due now, if one is.
    fn sample(&mut self, truth: &mut Truth<'_>);

    /// The behaviour's method that hears of a sample that arrives just now, if there are both.
    fn arrived(&mut self, now: SimTime) -> Option<Call>;

    /// Has `call` made for each sample that arrives. Whether it has a rate.
    fn on_sample(&mut self, call: Call) -> bool;

    /// See [`Sensor::touched`].
    fn touched(&mut self, touch: &Touch, truth: &mut Truth<'_>);

    /// See [`Sensor::heard`].
    fn heard(&mut self, radio: &str, inbox: Inbox<'_>);

    /// See [`Sensor::current`].
    fn current(&self) -> Current;

    /// See [`Sensor::needs`].
    fn needs(&self) -> Needs;
}

/// A reading and the truth beside it, as numbers and pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Taken {
    /// What the numbers are, repeated as often as there are rows.
    pub columns: &'static [Column],
    /// Whether a row of the reading is about the same as this row of the truth; see
    /// [`Reading::PAIRED`].
    pub paired: bool,
    /// What a perfect sensor would have read.
    pub ideal: Vec<f64>,
    /// What this one read: what the behaviour gets. Empty if it gets nothing.
    pub reading: Vec<f64>,
    /// The pictures that a perfect sensor would have taken, by name.
    pub ideal_images: Vec<(&'static str, Image)>,
    /// The pictures in the reading, by name.
    pub images: Vec<(&'static str, Image)>,
    /// Whether this measurement is lost by drop-out. The reading is then empty; of a sensor that is
    /// read on demand it is the last one again.
    pub lost: bool,
}

impl Taken {
    fn new<R: Reading>(ideal: &R, reading: &R) -> Self {
        let mut taken = Self {
            columns: R::COLUMNS,
            paired: R::PAIRED,
            ideal: Vec::new(),
            reading: Vec::new(),
            ideal_images: pictures(ideal),
            images: Vec::new(),
            lost: false,
        };
        ideal.numbers(&mut taken.ideal);
        taken.hand_over(reading);
        taken
    }

    /// The behaviour gets nothing of it, or `instead`.
    fn lose<R: Reading>(&mut self, instead: Option<&R>) {
        self.lost = true;
        self.reading.clear();
        self.images.clear();
        if let Some(instead) = instead {
            self.hand_over(instead);
        }
    }

    fn hand_over<R: Reading>(&mut self, reading: &R) {
        reading.numbers(&mut self.reading);
        self.images = pictures(reading);
    }
}

fn pictures<R: Reading>(reading: &R) -> Vec<(&'static str, Image)> {
    let images = reading.images().into_iter();
    images.map(|(name, image)| (name, image.clone())).collect()
}

pub(crate) struct Mounted<S: Sensor> {
    pub(crate) sensor: S,
    /// `None`: at the body's origin, looking forward, as most are. A mount has 56 bytes.
    pub(crate) mount: Option<Box<Mount>>,
    pub(crate) stream: Stream,
    /// `None`: on demand, and nothing is lost.
    pub(crate) sampler: Option<Box<Sampler<S::Reading>>>,
}

impl<S: Sensor> Mounted<S> {
    fn aim(&self, truth: &mut Truth<'_>) {
        truth.mount = self.mount.as_deref().copied().unwrap_or_default();
    }
}

/// One measurement, noted if anybody records it.
fn measure<S: Sensor>(sensor: &mut S, truth: &mut Truth<'_>, rng: &mut Stream) -> S::Reading {
    let ideal = sensor.ideal(truth);
    if !truth.watched {
        return sensor.measure(ideal, truth, rng);
    }
    let reading = sensor.measure(ideal.clone(), truth, rng);
    truth.taken = Some(Box::new(Taken::new(&ideal, &reading)));
    reading
}

impl<S: Sensor> AnySensor for Mounted<S> {
    fn read_into(&mut self, truth: &mut Truth<'_>, out: &mut dyn Any) {
        self.sample(truth);
        let now = truth.now;
        let Self {
            sensor,
            sampler,
            stream,
            ..
        } = self;
        let sample = match sampler {
            Some(sampler) => {
                let (sample, lost) = sampler.read(now, stream, |rng| measure(sensor, truth, rng));
                if lost && let Some(noted) = &mut truth.taken {
                    noted.lose(Some(&sample.reading));
                }
                sample
            }
            None => Sample {
                taken: now,
                reading: measure(sensor, truth, stream),
            },
        };
        if let Some(out) = out.downcast_mut::<Option<Sample<S::Reading>>>() {
            *out = Some(sample);
        }
    }

    fn timing(&self) -> Option<(Time, Time, Time)> {
        let sampler = self.sampler.as_ref()?;
        let (first, period) = sampler.timing()?;
        let delay = sampler.call.map_or(Time::ZERO, |_| sampler.delay());
        Some((first, period, delay))
    }

    fn sample(&mut self, truth: &mut Truth<'_>) {
        self.aim(truth);
        let now = truth.now;
        let Self {
            sensor,
            sampler,
            stream,
            ..
        } = self;
        if let Some(sampler) = sampler
            && sampler.sample(now, stream, |rng| measure(sensor, truth, rng))
            && let Some(noted) = &mut truth.taken
        {
            noted.lose::<S::Reading>(None);
        }
    }

    fn arrived(&mut self, now: SimTime) -> Option<Call> {
        let sampler = self.sampler.as_mut()?;
        let call = sampler.call?;
        sampler.arrives(now).then_some(call)
    }

    fn on_sample(&mut self, call: Call) -> bool {
        let sampler = self.sampler.as_mut().filter(|s| s.timing().is_some());
        sampler.map(|sampler| sampler.call = Some(call)).is_some()
    }

    fn touched(&mut self, touch: &Touch, truth: &mut Truth<'_>) {
        self.aim(truth);
        self.sensor.touched(touch, truth);
    }

    fn heard(&mut self, radio: &str, inbox: Inbox<'_>) {
        self.sensor.heard(radio, inbox);
    }

    fn current(&self) -> Current {
        self.sensor.current()
    }

    fn needs(&self) -> Needs {
        self.sensor.needs()
    }
}

//! Sensors: what turns truth into readings.
//!
//! A sensor is chosen in the scenario and read by a behaviour through a [`Handle`] that is typed
//! by the reading, not by the maker: the scenario decides which compass it is. Names and types are
//! checked once, when the behaviour is built; after that a read cannot fail.
//!
//! ```text
//! [model.sensor.compass]        kit.sensor::<Heading>("compass")?      bee.read(self.compass)
//! use = "compass"          ->   Handle<Heading>                   ->   Heading
//! ```

use crate::behavior::BuildError;
use crate::config::Params;
use crate::view::Truth;
use simbeeotic_kernel::Stream;
use simbeeotic_units::Mount;
use std::any::Any;
use std::fmt;
use std::marker::PhantomData;

/// A kind of sensor. Register it with `#[sensor("name")]`.
pub trait Sensor: Sized + Send + 'static {
    /// What the scenario may set.
    type Params: Params;
    /// What one reading is: a quantity or a struct of them.
    type Reading: Send + 'static;

    /// Makes one.
    ///
    /// # Errors
    /// Parameters out of range, by [`BuildError::parameter`].
    fn build(params: Self::Params) -> Result<Self, BuildError>;

    /// Takes one reading of `truth`. `rng` is this sensor's own stream.
    fn read(&mut self, truth: &Truth<'_>, rng: &mut Stream) -> Self::Reading;
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
    /// Writes a reading into `out`, an `Option<Reading>`.
    fn read_into(&mut self, truth: &mut Truth<'_>, out: &mut dyn Any);
}

pub(crate) struct Mounted<S> {
    pub(crate) sensor: S,
    /// `None`: at the body's origin, looking forward, as most are. A mount has 56 bytes.
    pub(crate) mount: Option<Box<Mount>>,
    pub(crate) stream: Stream,
}

impl<S: Sensor> AnySensor for Mounted<S> {
    fn read_into(&mut self, truth: &mut Truth<'_>, out: &mut dyn Any) {
        truth.mount = self.mount.as_deref().copied().unwrap_or_default();
        if let Some(out) = out.downcast_mut::<Option<S::Reading>>() {
            *out = Some(self.sensor.read(truth, &mut self.stream));
        }
    }
}

//! Behaviours: the part of a model that its author writes.
//!
//! ```
//! use simbeeotic_model::prelude::*;
//!
//! /// A bee that looks around.
//! #[behavior("scout-bee")]
//! pub struct ScoutBee {
//!     compass: Handle<Heading>,
//! }
//!
//! /// Parameters of [`ScoutBee`].
//! #[params]
//! pub struct ScoutBeeParams {
//!     /// Time between two looks.
//!     pub look_period: Time,
//! }
//!
//! impl Default for ScoutBeeParams {
//!     fn default() -> Self {
//!         Self { look_period: Time::from_secs(1.0) }
//!     }
//! }
//!
//! impl Behavior for ScoutBee {
//!     type Params = ScoutBeeParams;
//!
//!     fn build(params: ScoutBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
//!         kit.every(params.look_period, Self::look);
//!         Ok(Self { compass: kit.sensor("compass")? })
//!     }
//! }
//!
//! impl ScoutBee {
//!     fn look(&mut self, bee: &mut Bee<'_>) {
//!         let heading = bee.read(self.compass);
//!         bee.log(format!("looking to {heading}"));
//!         bee.turn(Angle::from_degrees(30.0));
//!     }
//! }
//! ```
//! State lives in `self`; time passes only between calls; timers are methods, declared in `build`.

use crate::config::Params;
use crate::energy::BatteryEvent;
use crate::host::{Flying, Host};
use crate::message::{Message, Touch};
use crate::sensor::Handle;
use crate::timer::{Call, TimerHandle};
use simbeeotic_kernel::{ModelId, Stream};
use simbeeotic_physics::BodySpec;
use simbeeotic_radio::{Inbox, Outcome, Packet};
use simbeeotic_units::Time;

pub use crate::kit::{BuildError, Kit, RadioHandle};

/// The logic of one model, carried by a host `H`: a flying vehicle unless said otherwise.
pub trait Behavior<H: Host = Flying>: Sized + Send + 'static {
    /// What the scenario may set. Missing keys take their [`Default`].
    type Params: Params;

    /// Makes the behaviour: takes handles to gear, declares timers.
    ///
    /// # Errors
    /// What the scenario got wrong: a parameter out of range, gear that is not there.
    fn build(params: Self::Params, kit: &mut Kit<Self, H>) -> Result<Self, BuildError>;

    /// The body of a [`Station`](crate::host::Station). A flying host has its vehicle's.
    fn body(_params: &Self::Params) -> Option<BodySpec> {
        None
    }

    /// Called at each step of the vehicle's control law, just before it.
    fn on_control(&mut self, _host: &mut H::View<'_>) {}

    /// Called with everything that one radio heard at this instant: once for each radio that heard
    /// something. Unless overridden, hands the packets to [`Behavior::on_packet`] one by one.
    fn on_packets(&mut self, inbox: Inbox<'_>, host: &mut H::View<'_>) {
        for packet in inbox {
            self.on_packet(&packet, host);
        }
    }

    /// Called for each packet heard. Of several radios, [`Packet::radio`] tells which heard it.
    fn on_packet(&mut self, _packet: &Packet<'_>, _host: &mut H::View<'_>) {}

    /// Called when the body touches something.
    fn on_contact(&mut self, _touch: &Touch, _host: &mut H::View<'_>) {}

    /// Called when something happens to the battery, if there is one on board.
    fn on_battery(&mut self, _event: BatteryEvent, _host: &mut H::View<'_>) {}

    /// Called with a message of another model.
    fn on_message(&mut self, _message: &Message, _host: &mut H::View<'_>) {}

    /// Called once, after the last event of the run.
    fn on_finish(&mut self, _host: &mut H::View<'_>) {}
}

/// A method of a behaviour that a timer calls.
pub type Handler<B, H = Flying> = fn(&mut B, &mut <H as Host>::View<'_>);

/// A method of a behaviour that is called with what became of a packet, see [`Kit::on_sent`].
pub type SentHandler<B, H = Flying> = fn(&mut B, &Outcome, &mut <H as Host>::View<'_>);

/// A timer that is armed when the run starts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Declared {
    pub(crate) call: Call,
    /// First firing; `None`: not until it is armed.
    pub(crate) first: Option<Time>,
    pub(crate) period: Option<Time>,
}

impl<B: Behavior<H>, H: Host> Kit<B, H> {
    /// Calls `handler` when the run starts and every `period` after that.
    pub fn every(&mut self, period: Time, handler: Handler<B, H>) -> TimerHandle {
        self.every_from(Time::ZERO, period, handler)
    }

    /// Calls `handler` at `first` and every `period` after that.
    pub fn every_from(&mut self, first: Time, period: Time, handler: Handler<B, H>) -> TimerHandle {
        self.check_time("period", period, false);
        self.check_time("first firing", first, true);
        self.declare(handler, Some(first), Some(period))
    }

    /// Calls `handler` once, `delay` after the start of the run.
    pub fn once(&mut self, delay: Time, handler: Handler<B, H>) -> TimerHandle {
        self.check_time("delay", delay, true);
        self.declare(handler, Some(delay), None)
    }

    /// A timer that does nothing until it is armed
    /// ([`Cx::arm`](crate::host::Cx::arm), [`Cx::arm_every`](crate::host::Cx::arm_every)).
    pub fn timer(&mut self, handler: Handler<B, H>) -> TimerHandle {
        self.declare(handler, None, None)
    }

    /// A method that timers created later may call ([`Cx::after`](crate::host::Cx::after)).
    pub fn call(&mut self, handler: Handler<B, H>) -> Call {
        self.handlers.push(handler);
        Call(self.handlers.len() as u16 - 1)
    }

    fn declare(
        &mut self,
        handler: Handler<B, H>,
        first: Option<Time>,
        period: Option<Time>,
    ) -> TimerHandle {
        let call = self.call(handler);
        self.declared.push(Declared {
            call,
            first,
            period,
        });
        // Timer 0 is the host's control law.
        TimerHandle::new(self.declared.len() as u32)
    }

    /// A sensor that readings of type `R` can be taken from.
    ///
    /// # Errors
    /// No sensor has this name, or its readings are of another type.
    pub fn sensor<R: 'static>(&self, name: &str) -> Result<Handle<R>, BuildError> {
        self.gear.sensor(name)
    }

    /// The same, if the scenario gave one: `None` if no sensor has this name.
    ///
    /// # Errors
    /// The sensor's readings are of another type.
    pub fn optional_sensor<R: 'static>(&self, name: &str) -> Result<Option<Handle<R>>, BuildError> {
        if self.gear.has_sensor(name) {
            self.gear.sensor(name).map(Some)
        } else {
            Ok(None)
        }
    }

    /// Calls `handler` for each sample of a sensor with a rate, when it arrives; the handler reads
    /// it. The same handle as from [`sensor`](Self::sensor).
    ///
    /// # Errors
    /// No sensor has this name, or its readings are of another type. That it has no rate fails the
    /// build later.
    pub fn on_sample<R: 'static>(
        &mut self,
        name: &str,
        handler: Handler<B, H>,
    ) -> Result<Handle<R>, BuildError> {
        let handle = self.gear.sensor(name)?;
        let call = self.call(handler);
        self.listeners.push((name.to_owned(), handle.index, call));
        Ok(handle)
    }

    /// The platform's radio, the first if there are several.
    ///
    /// # Errors
    /// It carries none.
    pub fn radio(&self) -> Result<RadioHandle, BuildError> {
        self.optional_radio().ok_or(BuildError::NoRadio)
    }

    /// The platform's radio, if it carries one.
    pub fn optional_radio(&self) -> Option<RadioHandle> {
        (!self.gear.radios.is_empty()).then(|| self.radio_at(0))
    }

    /// The radio called `name`.
    ///
    /// # Errors
    /// No radio has this name.
    pub fn radio_named(&self, name: &str) -> Result<RadioHandle, BuildError> {
        Ok(self.radio_at(self.gear.radio_named(name)?))
    }

    /// Calls `handler` with what became of each packet that this model sends, whichever radio sends it:
    /// `Ok`, or why not. It comes when the medium is done with the packet, before what the
    /// same radio received at the same instant; its ticket is the one that sending it returned.
    ///
    /// Without a handler nobody is woken, and [`Platform::radio_counters`](crate::Platform::radio_counters)
    /// knows the sums. Whether `Ok` means sent or acknowledged is said by
    /// [`Outcome::result`](simbeeotic_radio::Outcome::result).
    pub fn on_sent(&mut self, handler: SentHandler<B, H>) {
        self.sent = Some(handler);
    }

    /// A random stream of this behaviour's own, for one `purpose`. The stream behind
    /// [`Cx::rng`](crate::host::Cx::rng) needs no asking.
    pub fn stream(&self, purpose: &str) -> Stream {
        Stream::new(self.seed, &self.path, purpose)
    }

    /// The id of this model, and its address for packets.
    pub fn id(&self) -> ModelId {
        self.id
    }

    /// The path of this model: `bee-17`.
    pub fn path(&self) -> &str {
        &self.path
    }
}

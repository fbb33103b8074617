//! What carries a behaviour, and what the behaviour sees of it.
//!
//! Each layer *holds* the one below and lends all of its methods (by `Deref`):
//!
//! ```text
//! Bee<'_>        turn, fly, hover                    a vehicle flown by simple set points
//!   Platform<'_>   read, send, draw                  sensors, radios, energy accounts
//!     Entity<'_>     pose, velocity, set_force       a body in the world
//!       Cx<'_>         now, uniform, arm, find       time, chance, timers, the population, the world
//! ```
//!
//! A host is chosen by the behaviour: [`Flying`] unless it says otherwise, [`Station`] for things
//! that have a body and gear but do not fly (a hive, a beacon), [`Bodiless`] for models without
//! physical presence (a planner, a referee).

/// What a layer says, lent to the layer above as methods of its own: so that arguments may ask the layer
/// itself, `bee.metric("time", bee.now().as_secs(), "s")`. Through `DerefMut` they may not, since it
/// borrows the whole layer before the arguments are known.
macro_rules! says {
    ($layer:ident, $below:ident) => {
        impl $layer<'_> {
            /// See [`Cx::metric`](crate::Cx::metric).
            pub fn metric(&mut self, name: &'static str, value: f64, unit: &'static str) {
                self.$below.metric(name, value, unit);
            }

            /// See [`Cx::log`](crate::Cx::log).
            pub fn log(&mut self, text: impl std::fmt::Display) {
                self.$below.log(text);
            }

            /// See [`Cx::tell`](crate::Cx::tell).
            pub fn tell(
                &mut self,
                receiver: simbeeotic_kernel::ModelId,
                payload: impl std::any::Any + Send + Sync,
            ) {
                self.$below.tell(receiver, payload);
            }
        }
    };
}
use says;

mod bee;
mod bodiless;
mod cx;
mod entity;
mod platform;
mod radio;
mod sight;
mod station;
pub(crate) mod supply;

pub use bee::{Bee, Flying};
pub use bodiless::Bodiless;
pub use cx::Cx;
pub use entity::Entity;
pub use platform::{Gear, Platform};
pub(crate) use radio::Unsent;
pub use sight::{Ray, Seen};
pub use station::Station;

use crate::behavior::BuildError;
use crate::instance::Instance;
use simbeeotic_physics::BodySpec;
use simbeeotic_units::Time;

/// Something that can carry a behaviour. The three of this crate suffice for most; a testbed adds
/// its own for real vehicles.
pub trait Host: Sized + Send + 'static {
    /// What the behaviour sees of its host during one call.
    type View<'a>;

    /// Whether it flies, and so takes a vehicle.
    const FLIES: bool = false;

    /// Puts the host together from what the scenario says about this instance.
    ///
    /// `body` is the behaviour's own wish for a body; a flying host asks its vehicle instead.
    ///
    /// # Errors
    /// What the scenario lacks or has too much of: no vehicle, sensors without a body, ...
    fn assemble(instance: &mut Instance<'_>, body: Option<BodySpec>) -> Result<Self, BuildError>;

    /// The view for one call.
    fn view<'a>(&'a mut self, cx: Cx<'a>) -> Self::View<'a>;

    /// Its sensors, if it carries any.
    #[doc(hidden)]
    fn gear(&mut self) -> Option<&mut Gear> {
        None
    }

    /// First run and period of the host's own control law, if it has one.
    fn control_timing(&mut self) -> Option<(Time, Time)> {
        None
    }

    /// One step of the host's own control law.
    fn control(&mut self, _cx: Cx<'_>) {}

    /// Reads a word or two of memory that the host keeps elsewhere, so that it is at hand when the
    /// host is needed. A hint: what it returns does not matter.
    fn touch(&self) -> u64 {
        0
    }

    /// Called once, after the last event of the run and the behaviour's own end.
    fn finish(&mut self, _cx: Cx<'_>) {}
}

//! Vehicles: what turns set points into wrenches on a body.
//!
//! A behaviour that flies a [`Bee`](crate::host::Bee) speaks in set points (a velocity, a turn);
//! which vehicle carries them out, and how faithfully, is the scenario's choice:
//!
//! ```toml
//! [model.vehicle]
//! use = "simple-bee"
//! max_acceleration = "1 m/s^2"
//! ```

use crate::behavior::BuildError;
use crate::config::Params;
use crate::host::Platform;
use simbeeotic_kernel::Stream;
use simbeeotic_physics::BodySpec;
use simbeeotic_units::{Angle, Attitude, Flu, Position, Time, Velocity, Yaw, math};
use std::sync::Arc;

/// What a behaviour asks of its vehicle; it holds until it is changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setpoint {
    /// The velocity to fly, in the body frame.
    pub velocity: Velocity<Flu>,
    /// Whether the vehicle carries its own weight. When not, it falls.
    pub hovering: bool,
}

impl Default for Setpoint {
    fn default() -> Self {
        Self {
            velocity: Velocity::ZERO,
            hovering: true,
        }
    }
}

/// A kind of vehicle that flies velocity set points. Register it with `#[vehicle("name")]`.
pub trait Vehicle: Sized + Send + 'static {
    /// What the scenario may set.
    type Params: Params;

    /// Makes one. The parameters are those of all vehicles of one section of the scenario: one that
    /// keeps the `Arc` instead of a copy is small, and 100,000 of them are woken faster.
    ///
    /// # Errors
    /// Parameters out of range, by [`BuildError::parameter`].
    fn build(params: Arc<Self::Params>, kit: &VehicleKit<'_>) -> Result<Self, BuildError>;

    /// The body it flies with; the pose is filled in from the scenario's start.
    fn body(&self) -> BodySpec;

    /// Time between two runs of [`Vehicle::control`]. `None`: the control law never runs.
    fn control_period(&self) -> Option<Time>;

    /// When [`Vehicle::control`] first runs. At zero unless the vehicle says otherwise.
    fn control_offset(&mut self) -> Time {
        Time::ZERO
    }

    /// One step of the control law: sets the wrench on the body for the time until the next step.
    fn control(&mut self, setpoint: &Setpoint, platform: &mut Platform<'_>);

    /// Turns about the body's up axis, counter-clockwise. Unless the vehicle says otherwise at once, and it is
    /// upright then.
    fn turn(&mut self, angle: Angle, platform: &mut Platform<'_>) {
        let yaw = platform.attitude().yaw() + angle;
        platform.set_attitude(Attitude::from_yaw(yaw));
    }

    /// Points the body's forward axis at a place. Unless the vehicle says otherwise at once, and it is upright
    /// then, whether the place lies higher or lower; for one straight above or below it does nothing.
    fn turn_toward(&mut self, point: Position, platform: &mut Platform<'_>) {
        let way = (point - platform.position()).si();
        if way.truncate().length_squared() > 0.0 {
            let yaw = Yaw::new(Angle::si(math::atan2(way.y, way.x)));
            platform.set_attitude(Attitude::from_yaw(yaw));
        }
    }

    /// Called once, after the last event of the run: settles what is still owed.
    fn finish(&mut self, _setpoint: &Setpoint, _platform: &mut Platform<'_>) {}
}

/// What a vehicle is built with.
#[derive(Debug)]
pub struct VehicleKit<'a> {
    pub(crate) seed: u64,
    pub(crate) path: &'a str,
}

impl VehicleKit<'_> {
    /// A random stream of this vehicle's own, for one `purpose`.
    pub fn stream(&self, purpose: &str) -> Stream {
        Stream::new(self.seed, self.path, purpose)
    }
}

/// A [`Vehicle`] with its type forgotten, on its host.
pub trait AnyVehicle: Send {
    /// See [`Vehicle::body`].
    fn body(&self) -> BodySpec;
    /// First run and period of the control law; `None` if it never runs.
    fn control_timing(&mut self) -> Option<(Time, Time)>;
    /// See [`Vehicle::control`].
    fn control(&mut self, setpoint: &Setpoint, platform: &mut Platform<'_>);
    /// See [`Vehicle::turn`].
    fn turn(&mut self, angle: Angle, platform: &mut Platform<'_>);
    /// See [`Vehicle::turn_toward`].
    fn turn_toward(&mut self, point: Position, platform: &mut Platform<'_>);
    /// Reads both ends of its memory, so that it is at hand soon. A hint: what it returns does not
    /// matter.
    fn touch(&self) -> u64;
    /// See [`Vehicle::finish`].
    fn finish(&mut self, setpoint: &Setpoint, platform: &mut Platform<'_>);
}

/// A vehicle between two words that say nothing: whoever reads them has the memory between them
/// fetched, without knowing what lies there.
#[repr(C)]
pub(crate) struct Carried<V> {
    front: u32,
    vehicle: V,
    back: u32,
}

impl<V> Carried<V> {
    pub(crate) const fn new(vehicle: V) -> Self {
        Self {
            front: 0,
            vehicle,
            back: 0,
        }
    }
}

impl<V: Vehicle> AnyVehicle for Carried<V> {
    fn body(&self) -> BodySpec {
        self.vehicle.body()
    }

    fn control_timing(&mut self) -> Option<(Time, Time)> {
        let period = self.vehicle.control_period()?;
        Some((self.vehicle.control_offset(), period))
    }

    fn control(&mut self, setpoint: &Setpoint, platform: &mut Platform<'_>) {
        self.vehicle.control(setpoint, platform);
    }

    fn turn(&mut self, angle: Angle, platform: &mut Platform<'_>) {
        self.vehicle.turn(angle, platform);
    }

    fn turn_toward(&mut self, point: Position, platform: &mut Platform<'_>) {
        self.vehicle.turn_toward(point, platform);
    }

    fn touch(&self) -> u64 {
        u64::from(self.front ^ self.back)
    }

    fn finish(&mut self, setpoint: &Setpoint, platform: &mut Platform<'_>) {
        self.vehicle.finish(setpoint, platform);
    }
}

//! The vehicle: it flies by airspeed, and knows nothing of the wind.

use simbeeotic::model::units::Accel;
use simbeeotic::model::{Setpoint, Vehicle, VehicleKit, params, vehicle};
use simbeeotic::models::aerodynamics::{Drag, gravity};
use simbeeotic::physics::{BodySpec, Shape};
use simbeeotic::prelude::*;
use std::sync::Arc;

/// A flyer in a ball-shaped cage, whose motors push as hard as the drag at the airspeed it is asked for would
/// be: equation 1 of this example.
///
/// Asked for nothing it carries its weight, and goes where the air goes.
#[vehicle("air-bee")]
pub struct AirBee {
    params: Arc<AirBeeParams>,
    drag: Drag,
}

/// Parameters of [`AirBee`].
#[params]
pub struct AirBeeParams {
    /// Across the cage.
    pub diameter: Length,
    /// Mass of everything.
    pub mass: Mass,
    /// Drag coefficient; 0.47 is a smooth sphere's.
    pub drag_coefficient: f64,
    /// The greatest airspeed that its motors hold.
    pub top_speed: Speed,
    /// Time between two steps of the control law.
    pub control_period: Time,
}

impl Default for AirBeeParams {
    fn default() -> Self {
        Self {
            diameter: Length::si(0.2),
            mass: Mass::from_grams(50.0),
            drag_coefficient: 0.47,
            top_speed: Speed::si(8.0),
            control_period: Time::si(0.1),
        }
    }
}

impl Vehicle for AirBee {
    type Params = AirBeeParams;

    fn build(params: Arc<AirBeeParams>, _kit: &VehicleKit<'_>) -> Result<Self, BuildError> {
        positive("diameter", params.diameter)?;
        positive("mass", params.mass)?;
        positive("top_speed", params.top_speed)?;
        positive("control_period", params.control_period)?;
        let drag = Drag::of_disc(params.drag_coefficient, params.diameter);
        drag.check()?;
        Ok(Self { params, drag })
    }

    fn body(&self) -> BodySpec {
        let radius_m = 0.5 * self.params.diameter.metres();
        BodySpec {
            p_enu: Position::from_xyz(0.0, 0.0, radius_m).si(),
            ..BodySpec::new(Shape::Sphere { radius_m }, self.params.mass.kilograms())
        }
    }

    fn control_period(&self) -> Option<Time> {
        Some(self.params.control_period)
    }

    fn control(&mut self, setpoint: &Setpoint, platform: &mut Platform<'_>) {
        let (mass, step) = (self.params.mass, self.params.control_period);
        let asked = setpoint.velocity.limit(self.params.top_speed);
        let airspeed = platform.attitude().rotate(asked);
        let mut motors = self.drag.force(airspeed, platform.air_density());
        if setpoint.hovering {
            motors -= gravity(platform) * mass;
        }
        let other: Accel<Enu> = motors / mass + gravity(platform);
        let drag = self.drag.on(platform, mass, other, step);
        platform.set_force(motors + drag);
    }
}

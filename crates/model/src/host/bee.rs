//! The easy layer: a vehicle flown by simple set points.

use super::{Cx, Gear, Host, Platform};
use crate::behavior::BuildError;
use crate::energy::Condition;
use crate::instance::Instance;
use crate::kit::RadioHandle;
use crate::vehicle::{AnyVehicle, Setpoint};
use simbeeotic_kernel::ModelId;
use simbeeotic_physics::BodySpec;
use simbeeotic_radio::Ticket;
use simbeeotic_units::{Angle, Enu, Flu, Position, Time, Velocity};
use std::ops::{Deref, DerefMut};

/// Carries a behaviour through the air: a vehicle of the scenario's choice. Its behaviour sees a
/// [`Bee`].
pub struct Flying {
    gear: Gear,
    vehicle: Box<dyn AnyVehicle>,
    setpoint: Setpoint,
}

impl Host for Flying {
    type View<'a> = Bee<'a>;
    const FLIES: bool = true;

    fn assemble(instance: &mut Instance<'_>, _body: Option<BodySpec>) -> Result<Self, BuildError> {
        let vehicle = instance.vehicle()?;
        instance.add_body(vehicle.body())?;
        Ok(Self {
            gear: Gear::assemble(instance)?,
            vehicle,
            setpoint: Setpoint::default(),
        })
    }

    fn view<'a>(&'a mut self, cx: Cx<'a>) -> Bee<'a> {
        Bee {
            platform: Platform::new(cx, &mut self.gear),
            vehicle: &mut *self.vehicle,
            setpoint: &mut self.setpoint,
        }
    }

    fn gear(&mut self) -> Option<&mut Gear> {
        Some(&mut self.gear)
    }

    fn control_timing(&mut self) -> Option<(Time, Time)> {
        self.vehicle.control_timing()
    }

    fn control(&mut self, cx: Cx<'_>) {
        let platform = &mut Platform::new(cx, &mut self.gear);
        match platform.condition() {
            Condition::Fit => self.vehicle.control(&self.setpoint, platform),
            condition => self.vehicle.control(&spent(condition, platform), platform),
        }
    }

    fn touch(&self) -> u64 {
        self.vehicle.touch()
    }

    fn finish(&mut self, cx: Cx<'_>) {
        self.vehicle
            .finish(&self.setpoint, &mut Platform::new(cx, &mut self.gear));
    }
}

/// What a vehicle does that is out of power, whatever its behaviour wants.
#[cold]
fn spent(condition: Condition, platform: &mut Platform<'_>) -> Setpoint {
    let down_m_s = match platform.power() {
        Some(power) if condition == Condition::Landing => power.battery().landing_m_s,
        _ => 0.0,
    };
    let down = Velocity::<Enu>::from_xyz(0.0, 0.0, -down_m_s);
    Setpoint {
        velocity: platform.attitude().unrotate(down),
        hovering: condition == Condition::Landing,
    }
}

/// A vehicle in flight, as its behaviour sees it during one call.
///
/// Set points hold until they are changed; the vehicle's control law follows them on its own
/// clock. Turns take effect at once, and show in this call's compass. While the vehicle is not
/// [`Fit`](Condition::Fit) for want of power, neither does anything; set points are kept until it is.
pub struct Bee<'a> {
    platform: Platform<'a>,
    vehicle: &'a mut dyn AnyVehicle,
    setpoint: &'a mut Setpoint,
}

impl Bee<'_> {
    /// Turns about the body's up axis, counter-clockwise seen from above.
    #[inline]
    pub fn turn(&mut self, angle: Angle) {
        if self.platform.condition() == Condition::Fit {
            self.vehicle.turn(angle, &mut self.platform);
        }
    }

    /// Points the body's forward axis at a place.
    pub fn turn_toward(&mut self, point: Position) {
        if self.platform.condition() == Condition::Fit {
            self.vehicle.turn_toward(point, &mut self.platform);
        }
    }

    /// Flies at `velocity`, in the body frame, from the next control step on.
    ///
    /// A velocity that is not finite ends the run with an error that names this model.
    #[inline]
    pub fn fly(&mut self, velocity: Velocity<Flu>) {
        if velocity.si().is_finite() {
            self.setpoint.velocity = velocity;
        } else {
            let message = format!("was told to fly at {:?} m/s", velocity.si().to_array());
            self.platform.fault(message);
        }
    }

    /// The velocity that was asked for last, in the body frame. What is really flown is
    /// [`Entity::velocity`](super::Entity::velocity).
    #[inline]
    pub fn velocity_setpoint(&self) -> Velocity<Flu> {
        self.setpoint.velocity
    }

    /// Whether the vehicle carries its own weight from the next control step on. It does, unless
    /// told otherwise.
    pub fn hover(&mut self, hovering: bool) {
        self.setpoint.hovering = hovering;
    }

    /// Whether the vehicle carries its own weight.
    pub fn is_hovering(&self) -> bool {
        self.setpoint.hovering
    }
}

super::says!(Bee, platform);

/// The same as those of [`Platform`], see [`Bee::metric`] for why.
impl Bee<'_> {
    /// See [`Platform::send`].
    pub fn send(&mut self, radio: RadioHandle, payload: &[u8]) -> Ticket {
        self.platform.send(radio, payload)
    }

    /// See [`Platform::send_to`].
    pub fn send_to(&mut self, radio: RadioHandle, receiver: ModelId, payload: &[u8]) -> Ticket {
        self.platform.send_to(radio, receiver, payload)
    }
}

impl<'a> Deref for Bee<'a> {
    type Target = Platform<'a>;
    fn deref(&self) -> &Platform<'a> {
        &self.platform
    }
}

impl DerefMut for Bee<'_> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.platform
    }
}

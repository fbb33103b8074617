//! One instance of a model while it is put together.

use crate::about::PlannedPart;
use crate::behavior::BuildError;
use crate::energy::{Onboard, Supply};
use crate::registry::{SensorFactory, SensorKit, VehicleFactory};
use crate::sampling::Sampling;
use crate::sensor::{AnySensor, Handle, Needs};
use crate::vehicle::{AnyVehicle, VehicleKit};
use simbeeotic_kernel::{ModelId, rng::path_key};
use simbeeotic_physics::{BodyId, BodySpec, Physics};
use simbeeotic_radio::{Antenna, Medium, RadioId, RadioSpec};
use simbeeotic_units::{Current, Mount, Pose, Time};
use simbeeotic_world::World;
use std::any::TypeId;
use std::marker::PhantomData;
use std::sync::Arc;

/// The gear that a scenario attaches to each instance of a model.
#[derive(Clone, Default)]
pub struct GearPlan {
    /// Sensors, in the scenario's order.
    pub sensors: Vec<SensorPlan>,
    /// Radios, in the scenario's order.
    pub radios: Vec<RadioPlan>,
    /// What it all runs on; `None`: nothing runs out.
    pub supply: Option<Arc<Supply>>,
    /// What the model and its gear are made of, for those who ask what it is.
    pub parts: Vec<PlannedPart>,
}

/// One sensor of a [`GearPlan`].
#[derive(Clone)]
pub struct SensorPlan {
    /// What the behaviour calls it.
    pub name: String,
    /// Makes it.
    pub factory: Arc<dyn SensorFactory>,
    /// Where it sits.
    pub mount: Mount,
    /// When it is read.
    pub sampling: Sampling,
    /// The current it draws while it is on; `None`: what its kind says.
    pub current: Option<Current>,
    /// How long it is on for each sample; `None`: always.
    pub on_time: Option<Time>,
}

/// One radio of a [`GearPlan`].
#[derive(Clone)]
pub struct RadioPlan {
    /// What the behaviour calls it.
    pub name: String,
    /// What it is; owner and key are filled in for each instance.
    pub spec: RadioSpec,
    /// Its antenna pattern.
    pub antenna: Arc<dyn Antenna>,
    /// Where its antenna sits, and how it points.
    pub mount: Mount,
}

impl SensorPlan {
    /// What it draws in the mean, if its kind draws `usual` while it is on.
    fn mean_current(&self, usual: Current) -> Current {
        let duty = match (self.on_time, self.sampling.period) {
            (Some(on), Some(period)) => (on / period).min(1.0),
            _ => 1.0,
        };
        self.current.unwrap_or(usual) * duty
    }
}

impl GearPlan {
    pub(crate) fn has_sensor(&self, name: &str) -> bool {
        self.sensors.iter().any(|s| s.name == name)
    }

    pub(crate) fn sensor<R: 'static>(&self, name: &str) -> Result<Handle<R>, BuildError> {
        let index = self.sensors.iter().position(|s| s.name == name);
        let index = index.ok_or_else(|| BuildError::NoSensor {
            name: name.to_owned(),
            known: self.sensors.iter().map(|s| s.name.clone()).collect(),
        })?;
        let (id, gives) = self.sensors[index].factory.reading();
        if id != TypeId::of::<R>() {
            let wanted = std::any::type_name::<R>();
            return Err(BuildError::WrongReading {
                name: name.to_owned(),
                wanted,
                gives,
            });
        }
        Ok(Handle {
            index: index as u16,
            reading: PhantomData,
        })
    }

    /// The place of a radio among those on board.
    pub(crate) fn radio_named(&self, name: &str) -> Result<usize, BuildError> {
        match self.radios.iter().position(|r| r.name == name) {
            Some(index) => Ok(index),
            None => Err(BuildError::NoSuchRadio {
                name: name.to_owned(),
                known: self.radios.iter().map(|r| r.name.clone()).collect(),
            }),
        }
    }
}

/// One instance of a model while it is put together: what the scenario says about it, and the
/// world that its body and radios join.
pub struct Instance<'a> {
    /// Its id.
    pub id: ModelId,
    /// Its path: `bee-17`.
    pub path: Arc<str>,
    /// The master seed.
    pub seed: u64,
    /// Where it starts.
    pub start: Pose,
    /// The gear on board.
    pub gear: Arc<GearPlan>,
    pub(crate) vehicle: Option<&'a dyn VehicleFactory>,
    pub(crate) world: &'a World,
    pub(crate) physics: &'a mut Physics,
    pub(crate) medium: Option<&'a mut Box<dyn Medium>>,
    pub(crate) body: Option<BodyId>,
    pub(crate) radios: Vec<RadioId>,
    pub(crate) onboard: Onboard,
}

impl Instance<'_> {
    /// Puts a body into the world, at this instance's start.
    ///
    /// # Errors
    /// Mass, size or pose make no sense to physics.
    pub fn add_body(&mut self, body: BodySpec) -> Result<BodyId, BuildError> {
        let start = self.start;
        let id = self.physics.add(BodySpec {
            p_enu: body.p_enu + start.position.si(),
            attitude: start.attitude,
            ..body
        })?;
        self.body = Some(id);
        Ok(id)
    }

    /// The vehicle that the scenario chose.
    pub(crate) fn vehicle(&self) -> Result<Box<dyn AnyVehicle>, BuildError> {
        let factory = self.vehicle.ok_or_else(|| {
            BuildError::other("it flies and has no vehicle; add a [model.vehicle]")
        })?;
        factory.build(&VehicleKit {
            seed: self.seed,
            path: &self.path,
        })
    }

    /// An error if the scenario gave a vehicle to something that cannot use one.
    pub(crate) fn refuse_vehicle(&self, what: &str) -> Result<(), BuildError> {
        match self.vehicle {
            Some(_) => Err(BuildError::other(format!(
                "{what} has no use for a vehicle"
            ))),
            None => Ok(()),
        }
    }

    /// An error if the scenario gave gear to something that cannot carry any.
    pub(crate) fn refuse_gear(&self, what: &str) -> Result<(), BuildError> {
        if self.gear.supply.is_some() {
            Err(BuildError::other(format!("{what} runs on no battery")))
        } else if self.gear.sensors.is_empty() && self.gear.radios.is_empty() {
            Ok(())
        } else {
            Err(BuildError::other(format!(
                "{what} carries no sensors or radios"
            )))
        }
    }

    pub(crate) fn sensors(&mut self) -> Result<Box<[Box<dyn AnySensor>]>, BuildError> {
        let gear = Arc::clone(&self.gear);
        let mut sensors = Vec::with_capacity(gear.sensors.len());
        let mut current = Current::ZERO;
        for plan in &gear.sensors {
            let path = format!("{}/{}", self.path, plan.name);
            let sensor = plan.factory.build(&SensorKit {
                mount: plan.mount,
                sampling: plan.sampling,
                seed: self.seed,
                path: &path,
                world: self.world,
            })?;
            self.give(&plan.name, &sensor.needs())?;
            current += plan.mean_current(sensor.current());
            sensors.push(sensor);
        }
        self.onboard.constant[0] = current;
        Ok(sensors.into())
    }

    /// Sees that a sensor finds on board what it measures.
    fn give(&mut self, sensor: &str, needs: &Needs) -> Result<(), BuildError> {
        let lacks = |what: &str| {
            let message = format!("sensor `{sensor}` measures {what}");
            Err(BuildError::other(message))
        };
        match needs {
            Needs::Nothing => {}
            Needs::Battery if self.onboard.power.is_none() => {
                return lacks("a battery, and there is none on board; add a [model.battery]");
            }
            Needs::Battery => {}
            Needs::Motors if self.vehicle.is_none() => {
                return lacks("motors, and a station has none");
            }
            Needs::Motors => self.onboard.watched = true,
            Needs::Radio(name) => {
                match name {
                    Some(name) => _ = self.gear.radio_named(name)?,
                    None if self.gear.radios.is_empty() => return Err(BuildError::NoRadio),
                    None => {}
                }
                self.onboard.ears = true;
            }
        }
        Ok(())
    }

    /// Puts the platform's radios on the air.
    pub(crate) fn add_radios(&mut self) -> Result<(), BuildError> {
        let Some(medium) = self.medium.as_deref_mut() else {
            return Ok(());
        };
        for plan in &self.gear.radios {
            let path = format!("{}/{}", self.path, plan.name);
            let spec = RadioSpec {
                owner: self.id,
                key: path_key(&path),
                antenna: Arc::clone(&plan.antenna),
                mount: plan.mount,
                ..plan.spec.clone()
            };
            self.radios.push(medium.add(spec)?);
        }
        Ok(())
    }
}

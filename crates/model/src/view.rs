//! What sensors and components see: truth, read only.

use crate::energy::{Battery, BatteryState, Books, Effort};
use crate::host::{Ray, Seen};
use crate::line::Line;
use crate::metrics::ModelMetric;
use crate::population::Population;
use crate::scene::{Scene, color_of};
use crate::sees::SeesWhat;
use crate::sensor::Taken;
use crate::swarm::{Agent, Core, Mark, Swarm};
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_physics::{BodyError, Kind, Motion, Shape, State, Support};
use simbeeotic_radio::{Channel, Counters, RadioId, RadioState};
use simbeeotic_units::{
    Accel, Acceleration, Enu, Flu, Length, Mount, Pose, Position, Rate, Twist, Velocity, glam,
};
use simbeeotic_world::{Color, GasField, World};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The truth about a platform and its surroundings, from which a sensor makes a reading.
pub struct Truth<'a> {
    pub(crate) now: SimTime,
    pub(crate) pose: Pose,
    pub(crate) twist: Twist,
    pub(crate) motion: &'a Motion,
    pub(crate) host: ModelId,
    pub(crate) mount: Mount,
    pub(crate) swarm: &'a Swarm,
    pub(crate) core: &'a Core,
    /// Whether somebody looks at what is measured, and what has been.
    pub(crate) watched: bool,
    pub(crate) taken: Option<Box<Taken>>,
}

impl Truth<'_> {
    /// The instant of the reading.
    pub fn now(&self) -> SimTime {
        self.now
    }

    /// The model that carries the sensor.
    pub fn host(&self) -> ModelId {
        self.host
    }

    /// The host's pose.
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// The host's twist.
    pub fn twist(&self) -> Twist {
        self.twist
    }

    /// The host's acceleration in the world frame, gravity included. In a heap, or against a wall, it is
    /// the mean over a step of the contact's own clock, 1/240 s unless told otherwise.
    pub fn acceleration(&self) -> Accel<Enu> {
        Accel::from_si(self.accelerations().0)
    }

    /// Of the path and of the body rate. In a heap the segment is straight; physics knows what it hides.
    fn accelerations(&self) -> (glam::DVec3, glam::DVec3) {
        let m = self.motion;
        match self.swarm.body_of(self.host) {
            Some(body) if m.support() == Support::Island => {
                self.swarm.physics.accelerations(body, self.now)
            }
            _ => (m.acceleration(), m.angular_acceleration(self.now)),
        }
    }

    /// How the host's body rate changes, body frame, rad/s².
    pub fn angular_acceleration(&self) -> [f64; 3] {
        self.accelerations().1.to_array()
    }

    /// The host's specific force in its body frame: what an accelerometer at the centre of mass
    /// feels. Zero in free fall, one g upwards at rest.
    pub fn specific_force(&self) -> Accel<Flu> {
        let lift = glam::DVec3::new(0.0, 0.0, self.swarm.gravity().get());
        self.pose
            .attitude
            .unrotate(Accel::from_si(self.acceleration().si() + lift))
    }

    /// The specific force where the sensor sits, in the sensor's own frame. Away from the centre of
    /// mass it is more than [`specific_force`](Self::specific_force) by `alpha x r + w x (w x r)`.
    pub fn sensor_specific_force(&self) -> Accel<Flu> {
        let (r, w) = (self.mount.position.si(), self.twist.angular.si());
        let alpha = glam::DVec3::from_array(self.angular_acceleration());
        let felt = self.specific_force().si() + alpha.cross(r) + w.cross(w.cross(r));
        self.mount.attitude.unrotate(Accel::from_si(felt))
    }

    /// The body rate in the sensor's own frame.
    pub fn sensor_rate(&self) -> Rate<Flu> {
        let in_body = Rate::<Enu>::from_si(self.twist.angular.si());
        self.mount.attitude.unrotate(in_body)
    }

    /// The velocity of the place where the sensor sits, world frame: `v + w x r`.
    pub fn sensor_velocity(&self) -> Velocity<Enu> {
        let (r, w) = (self.mount.position.si(), self.twist.angular.si());
        let round = self
            .pose
            .attitude
            .rotate(Velocity::<Flu>::from_si(w.cross(r)));
        self.twist.linear + round
    }

    /// Acceleration of free fall; positive is downwards.
    pub fn gravity(&self) -> Acceleration {
        self.swarm.gravity()
    }

    /// Where the sensor sits on its host.
    pub fn mount(&self) -> Mount {
        self.mount
    }

    /// The sensor's own pose in the world.
    pub fn sensor_pose(&self) -> Pose {
        self.pose * self.mount
    }

    /// The wind at the host.
    pub fn wind(&self) -> Velocity<Enu> {
        self.swarm.weather.wind(self.pose.position, self.now)
    }

    /// The host's battery; `None` if it has none.
    pub fn battery(&self) -> Option<BatteryState> {
        Some(self.swarm.battery(self.core, self.now)?.0)
    }

    /// What kind of battery it is; `None` if the host has none.
    pub fn battery_kind(&self) -> Option<&Battery> {
        let power = self.core.onboard.as_deref()?.power.as_ref()?;
        Some(power.battery())
    }

    /// What the host's motors were asked for last. Noted for sensors that
    /// [need](crate::Sensor::needs) motors only; else zero.
    pub fn effort(&self) -> Effort {
        let onboard = self.core.onboard.as_deref();
        onboard.map_or(Effort::default(), |onboard| onboard.effort)
    }

    /// The air and its weather.
    pub fn weather(&self) -> &dyn simbeeotic_world::Weather {
        &*self.swarm.weather
    }

    /// A gas of the world, carried by the weather; empty if nothing gives it off.
    pub fn gas<'a>(&'a self, name: &'a str) -> GasField<'a> {
        self.swarm.gases.field(name)
    }

    /// The names of the world's gases.
    pub fn gases(&self) -> Vec<&str> {
        self.swarm.gases.names()
    }

    /// The pose of another model's body, as the instant began.
    pub fn pose_of(&self, id: ModelId) -> Option<Pose> {
        self.swarm.pose_of(id, self.now)
    }

    /// The twist of another model's body, as the instant began.
    pub fn twist_of(&self, id: ModelId) -> Option<Twist> {
        self.swarm.twist_of(id, self.now)
    }

    /// What another model's body counts as, for those who look: a vehicle, say. `None` if it has none.
    pub fn kind_of(&self, id: ModelId) -> Option<Kind> {
        let body = self.swarm.body_of(id)?;
        Some(self.swarm.physics.kind(body))
    }

    /// The velocity of the place where the sensor sits, in the sensor's own frame.
    pub fn sensor_velocity_flu(&self) -> Velocity<Flu> {
        self.sensor_pose().attitude.unrotate(self.sensor_velocity())
    }

    /// All other models whose body's centre is within `radius` of the host, by id.
    pub fn neighbors(&self, radius: Length) -> Vec<ModelId> {
        self.swarm
            .neighbors(self.pose.position, radius, self.now, self.host)
    }

    /// What each ray meets first of `what`, as the instant began: rays pass through the host itself,
    /// and through all else. One answer for each ray, in their order.
    ///
    /// # Errors
    /// A ray that is none: a number that is not finite, no direction, no range.
    pub fn cast_rays(&self, rays: &[Ray], what: SeesWhat) -> Result<Vec<Option<Seen>>, BodyError> {
        let host = self.swarm.body_of(self.host);
        self.swarm.cast_rays(rays, self.now, what, host)
    }

    /// A look along a line from the host.
    pub(crate) fn line_of_sight(&self, target: Option<ModelId>, sees: SeesWhat) -> Line<'_> {
        Line {
            swarm: self.swarm,
            now: self.now,
            but: self.swarm.body_of(self.host),
            target,
            sees,
        }
    }

    /// What there is to be seen, for a camera: all but the host itself.
    pub fn scene(&self) -> Scene<'_> {
        Scene {
            now: self.now,
            swarm: self.swarm,
            but: self.swarm.body_of(self.host),
        }
    }

    /// The world's objects.
    pub fn world(&self) -> &World {
        &self.swarm.world
    }
}

/// The state of a run as components see it, between instants. Read only.
#[derive(Clone, Copy)]
pub struct View<'a> {
    pub(crate) now: SimTime,
    pub(crate) end: SimTime,
    pub(crate) swarm: &'a Swarm,
    pub(crate) agents: &'a [Agent],
    pub(crate) marks: &'a [Mark],
    /// Whether somebody has looked at them.
    pub(crate) shown: &'a AtomicBool,
    pub(crate) origin: &'a Origin,
}

/// Where a run comes from: enough to run it again.
#[derive(Clone, Debug, Default)]
pub struct Origin {
    /// The scenario's name, for people.
    pub name: String,
    /// The scenario's text, as TOML.
    pub scenario: String,
    /// The master seed.
    pub seed: u64,
    /// The version of the program.
    pub version: String,
}

impl<'a> View<'a> {
    /// The present.
    pub fn now(&self) -> SimTime {
        self.now
    }

    /// When the run ends by itself; `None`: never.
    pub fn end(&self) -> Option<SimTime> {
        (self.end < SimTime::MAX).then_some(self.end)
    }

    /// Where the run comes from.
    pub fn origin(&self) -> &'a Origin {
        self.origin
    }

    /// All models.
    pub fn population(&self) -> &'a Population {
        &self.swarm.population
    }

    /// The world's objects.
    pub fn world(&self) -> &'a World {
        &self.swarm.world
    }

    /// The world's objects, for another thread: they do not change.
    pub fn shared_world(&self) -> Arc<World> {
        Arc::clone(&self.swarm.world)
    }

    /// What there is to be seen, for a picture of it.
    pub fn scene(&self) -> Scene<'a> {
        Scene {
            now: self.now,
            swarm: self.swarm,
            but: None,
        }
    }

    /// The names of a model's sensors, in the scenario's order.
    pub fn sensors(&self, id: ModelId) -> impl Iterator<Item = &'a str> + 'a {
        let gear = self.swarm.gear.get(id.index());
        gear.into_iter()
            .flat_map(|g| g.sensors.iter())
            .map(|s| s.name.as_str())
    }

    /// The models that have a body, by id.
    pub fn bodies(&self) -> impl Iterator<Item = ModelId> + 'a {
        let swarm = self.swarm;
        swarm
            .population
            .iter()
            .map(|(id, _)| id)
            .filter(|id| swarm.body_of(*id).is_some())
    }

    /// The pose of a model's body now.
    pub fn pose(&self, id: ModelId) -> Option<Pose> {
        self.swarm.pose_of(id, self.now)
    }

    /// The twist of a model's body now.
    pub fn twist(&self, id: ModelId) -> Option<Twist> {
        self.swarm.twist_of(id, self.now)
    }

    /// The velocity of a model's body now.
    pub fn velocity(&self, id: ModelId) -> Option<Velocity<Enu>> {
        let motion = self.swarm.physics.motion(self.swarm.body_of(id)?);
        Some(Velocity::from_si(motion.velocity(self.now)))
    }

    /// Where a model's body is and how it moves, now: all of it at once, for those who ask for many bodies.
    /// Each is looked up and evaluated once, in closed form; `None`: it has no body.
    #[inline]
    pub fn state(&self, id: ModelId) -> Option<State> {
        let motion = self.swarm.physics.motion(self.swarm.body_of(id)?);
        Some(motion.at(self.now))
    }

    /// The radius of the sphere around a model's body.
    pub fn radius(&self, id: ModelId) -> Option<Length> {
        self.swarm.radius_of(id)
    }

    /// The shape of a model's body, in its body frame.
    pub fn shape(&self, id: ModelId) -> Option<&'a Shape> {
        Some(self.swarm.physics.shape(self.swarm.body_of(id)?))
    }

    /// What a model's body counts as: a vehicle, a station, a ghost.
    pub fn body_kind(&self, id: ModelId) -> Option<Kind> {
        Some(self.swarm.physics.kind(self.swarm.body_of(id)?))
    }

    /// The colour of a model's body, as cameras see it.
    pub fn color(&self, id: ModelId) -> Option<Color> {
        Some(color_of(self.body_kind(id)?))
    }

    /// The wind at a place now.
    pub fn wind(&self, position: Position) -> Velocity<Enu> {
        self.swarm.weather.wind(position, self.now)
    }

    /// Whether there is no wind, anywhere and ever; see [`Weather::is_calm`](simbeeotic_world::Weather::is_calm).
    pub fn is_calm(&self) -> bool {
        self.swarm.weather.is_calm()
    }

    /// A model's battery now; `None` if it has none.
    pub fn battery(&self, id: ModelId) -> Option<BatteryState> {
        let agent = self.agents.get(id.index())?;
        Some(self.swarm.battery(&agent.core, self.now)?.0)
    }

    /// A model's battery now, and what went in and out of it since the start; `None` if it has none.
    pub fn battery_books(&self, id: ModelId) -> Option<(BatteryState, Books)> {
        let agent = self.agents.get(id.index())?;
        self.swarm.battery(&agent.core, self.now)
    }

    /// What happened since the last observation of this component's clock: touches, log lines,
    /// metrics, in order. What a component looks at while the run is [held](crate::Component::held) is
    /// not shown to it again; what it does not look at then is there at its next observation.
    pub fn marks(&self) -> &'a [Mark] {
        self.shown.store(true, Ordering::Relaxed);
        self.marks
    }

    /// What each model has published so far, by name, then by model. Summed up anew at each call.
    pub fn metrics(&self) -> Vec<ModelMetric> {
        self.swarm.metrics.by_model()
    }

    /// The paths of all radios, by id: `bee-17/radio`. Made anew at each call.
    pub fn radios(&self) -> Vec<String> {
        crate::packets::radio_paths(self.swarm)
    }

    /// The model that carries a radio; `None` if there is no such radio.
    pub fn radio_owner(&self, radio: RadioId) -> Option<ModelId> {
        let medium = self.swarm.medium.as_ref()?;
        (radio.index() < medium.radios()).then(|| medium.spec(radio).owner)
    }

    /// What a radio does now, and the channel it is tuned to; `None` if there is no such radio.
    pub fn radio_state(&self, radio: RadioId) -> Option<(RadioState, Channel)> {
        let medium = self.swarm.medium.as_ref()?;
        let there = radio.index() < medium.radios();
        there.then(|| (medium.state(radio, self.now), medium.spec(radio).channel))
    }

    /// What became of all frames so far, or of those of one radio.
    pub fn radio_counters(&self, radio: Option<RadioId>) -> Counters {
        self.swarm.radio_counters(radio)
    }

    /// Packets sent and received so far.
    pub fn packets(&self) -> (u64, u64) {
        self.swarm.packets()
    }
}

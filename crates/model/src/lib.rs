//! What authors write against: behaviours, vehicles, sensors, radios, the registry, the run.
//!
//! A swarm is made of *models* that are woken by events. Authors rarely write one: they write a
//! [`Behavior`], a struct with state and methods, and say what carries it ([`host`]): a flying
//! vehicle, a station on the ground, or nothing. Timers are methods, declared once; sensors are
//! read through typed handles; packets come in batches. Everything that can be named in a scenario
//! is a *part* on the shelf ([`registry`]), whoever wrote it.
//!
//! ```text
//! scenario  --config-->  Setup  --assemble-->  Simulation  --run-->  Summary
//!                          |                       |
//!                     registry: parts         kernel: instants
//! ```
//!
//! Reading order: [`behavior`](mod@behavior) and [`host`] (what most people need), [`sensor`](mod@sensor) and [`vehicle`](mod@vehicle)
//! (to add a part), [`registry`] and [`config`] (how names become parts), [`swarm`] (what is shared
//! and in which order it changes), [`simulation`] (a run), [`component`](mod@component) (who watches).

// The attribute macros say `::simbeeotic_model`, in this crate too.
extern crate self as simbeeotic_model;

mod about;
pub mod air;
mod around;
pub mod behavior;
pub mod check;
pub mod component;
pub mod config;
pub mod energy;
mod fold;
pub mod host;
mod hosted;
mod image;
pub mod instance;
mod kit;
mod line;
pub mod message;
mod metrics;
pub mod model;
pub mod objects;
pub mod packets;
pub mod population;
mod reading;
pub mod registry;
mod sampling;
pub mod scene;
pub mod sees;
pub mod sensor;
pub mod shadowing;
pub mod simulation;
pub mod summary;
pub mod swarm;
mod timer;
pub mod vehicle;
pub mod view;
mod watch;

pub use about::{About, AboutPart, AboutRadio, AboutSensor, Beams, PlannedPart};
pub use air::{Air, Aside, Fidelity, MadeAir, NoiseFloor};
pub use around::{Echo, Nearby};
pub use behavior::{Behavior, BuildError, Handler, Kit, RadioHandle, SentHandler};
pub use component::{Component, ComponentError, Note};
pub use energy::{
    Accounts, BatteryEvent, BatteryState, Books, Condition, Consumer, Effort, Plug, Plugged, Supply,
};
pub use host::{Bee, Bodiless, Cx, Entity, Flying, Host, Platform, Ray, Seen, Station};
pub use image::{Image, Pixels};
pub use line::Crossing;
pub use message::{Message, Thing, Touch};
pub use metrics::{ModelMetric, Tally};
pub use model::{Model, Wake};
pub use packets::{Listener, OnAir, Reception, Transmission};
pub use population::{Member, Population};
pub use reading::{Column, Reading};
pub use registry::{FromParams, Generator, Radio, Site};
pub use sampling::{Sample, SamplePhase, Sampling, random_phase};
pub use scene::Scene;
pub use sees::SeesWhat;
pub use sensor::{Handle, Needs, Sensor, Taken};
pub use shadowing::{ShadowingKind, ShadowingParams};
pub use simulation::{ModelPlan, Outcome, Setup, SetupError, Simulation, SimulationError};
pub use summary::Summary;
pub use swarm::Mark;
pub use timer::{Call, TimerHandle};
pub use vehicle::{Setpoint, Vehicle, VehicleKit};
pub use view::{Origin, Truth, View};

pub use simbeeotic_macros::{
    antenna, behavior, choice, component, fading, generator, medium, params, propagation, radio,
    sensor, vehicle, weather,
};

pub use inventory;
pub use schemars;
pub use serde;
pub use simbeeotic_kernel as kernel;
pub use simbeeotic_physics as physics;
pub use simbeeotic_radio as radio;
pub use simbeeotic_units as units;
pub use simbeeotic_world as world;

/// What a file with a behaviour in it wants to see.
pub mod prelude {
    pub use crate::check::{at_least_zero, in_range, positive};
    pub use crate::host::{Bee, Bodiless, Cx, Entity, Flying, Platform, Ray, Seen, Station};
    pub use crate::kernel::{ModelId, SimTime, Stream};
    pub use crate::physics::{BodySpec, Contacts, Kind, Material, Mobility, Shape, group};
    pub use crate::radio::{Inbox, Loss, Outcome, Packet, RadioState, Ticket};
    pub use crate::units::{
        Acceleration, Angle, AngularRate, Attitude, Charge, Current, Decibels, Enu, Flu, Force,
        ForceVec, Frequency, Heading, ImpulseVec, Length, Mass, Offset, Pose, Position, PowerLevel,
        Rate, Speed, Time, Twist, Velocity, Yaw,
    };
    pub use crate::{
        BatteryEvent, BatteryState, Behavior, BuildError, Call, Column, Condition, Consumer,
        Handle, Image, Kit, Message, RadioHandle, Reading, Sample, SeesWhat, Sensor, Thing,
        TimerHandle, Touch, Truth,
    };
    pub use simbeeotic_macros::{behavior, choice, params, sensor};
}

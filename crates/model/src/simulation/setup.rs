//! What a run is made of.

use crate::component::Component;
use crate::config::Fault;
use crate::energy::{Consumer, Drawn, Onboard};
use crate::instance::{GearPlan, Instance};
use crate::message::Thing;
use crate::metrics::Metrics;
use crate::population::{Member, Population};
use crate::registry::{ModelFactory, VehicleFactory};
use crate::scene::Look;
use crate::swarm::{Agent, Core, MailRoom, Swarm};
use crate::view::Origin;
use simbeeotic_kernel::Stream;
use simbeeotic_kernel::rng::path_key;
use simbeeotic_kernel::{Limits, ModelId, SimTime, Timers};
use simbeeotic_physics::{BodyError, Config as PhysicsConfig, Physics};
use simbeeotic_radio::Medium;
use simbeeotic_units::{Current, Pose};
use simbeeotic_world::{Gases, ObjectId, ObjectKind, Weather, World};
use std::sync::Arc;
use std::sync::atomic::AtomicU64;

/// What a run is made of.
pub struct Setup {
    /// Name, scenario text, seed, version.
    pub origin: Origin,
    /// When it ends, and what else ends it.
    pub limits: Limits,
    /// Threads that run the models; the trace is the same for any number.
    pub threads: usize,
    /// How many times faster than the wall clock it may run; `None`: as fast as it can.
    pub pace: Option<f64>,
    /// Gravity, ground, contact lists.
    pub physics: PhysicsConfig,
    /// The air that radios share; `None`: no packet goes anywhere.
    pub medium: Option<Box<dyn Medium>>,
    /// The weather.
    pub weather: Arc<dyn Weather>,
    /// The world's objects. They are solid, and nothing moves them.
    pub world: Arc<World>,
    /// The models, in order; parents before their children.
    pub models: Vec<ModelPlan>,
    /// Who watches, each with the name of its part.
    pub components: Vec<(String, Box<dyn Component>)>,
}

/// One model of a [`Setup`].
pub struct ModelPlan {
    /// Its path: `bee-17`, `hive/bee-17`.
    pub path: String,
    /// The name of the part it is made from.
    pub kind: &'static str,
    /// Makes it.
    pub factory: Arc<dyn ModelFactory>,
    /// Makes its vehicle, if it flies.
    pub vehicle: Option<Arc<dyn VehicleFactory>>,
    /// Its sensors and radios.
    pub gear: Arc<GearPlan>,
    /// Where it starts.
    pub start: Pose,
    /// The model it is nested in: its place in [`Setup::models`].
    pub parent: Option<usize>,
}

/// A run cannot be put together.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SetupError {
    /// Models cannot be built: each fault once, with the path of the first model that has it.
    #[error("{}", .0.iter().map(|(path, fault)| format!("{path}: {fault}")).collect::<Vec<_>>().join("; "))]
    Models(Vec<(String, Fault)>),
    /// An object of the world cannot be a body.
    #[error("{object} of the world: {fault}")]
    Object {
        /// Which.
        object: ObjectId,
        /// What physics says.
        fault: BodyError,
    },
    /// Two models have one path.
    #[error("two models are called `{path}`")]
    DuplicatePath {
        /// The path.
        path: String,
    },
    /// Two paths have the same 64-bit key, which happens once in a billion swarms of 200,000.
    #[error("`{0}` and `{1}` cannot be told apart by their keys; rename one of them")]
    KeyCollision(String, String),
    /// A pace that is not a number above zero.
    #[error(transparent)]
    Pace(#[from] simbeeotic_kernel::pace::PaceError),
    /// The engine cannot be made.
    #[error(transparent)]
    Engine(#[from] simbeeotic_kernel::EngineError),
}

/// The swarm and its models, ready for the engine.
pub(super) fn assemble(setup: &mut Setup) -> Result<(Swarm, Vec<Agent>), SetupError> {
    let plans = std::mem::take(&mut setup.models);
    let count = plans.len();
    let seed = setup.origin.seed;
    let mut physics = Physics::new(setup.physics);
    physics.reserve(count);
    let mut medium = setup.medium.take();
    // Tables that grow hold half as much again while they move.
    let mut population = Population::with_capacity(count);
    let mut agents = Vec::with_capacity(count);
    let (mut bodies, mut owners) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let (mut keys, mut gears) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let mut faults: Vec<(String, Fault)> = Vec::new();
    for plan in plans {
        let key = path_key(&plan.path);
        let path: Arc<str> = plan.path.into();
        let member = Member {
            path: &path,
            kind: plan.kind,
            parent: plan.parent.map(|at| ModelId(at as u32)),
        };
        let id = population
            .add(member)
            .ok_or_else(|| SetupError::DuplicatePath {
                path: path.to_string(),
            })?;
        gears.push(Arc::clone(&plan.gear));
        let mut instance = Instance {
            id,
            path: Arc::clone(&path),
            seed,
            start: plan.start,
            gear: plan.gear,
            vehicle: plan.vehicle.as_deref(),
            world: &setup.world,
            physics: &mut physics,
            medium: medium.as_mut(),
            body: None,
            radios: Vec::new(),
            onboard: Onboard::default(),
        };
        let model = match plan.factory.build(&mut instance) {
            Ok(model) => model,
            Err(fault) => {
                // A thousand bees of one section have one fault.
                if !faults.iter().any(|(_, known)| *known == fault) {
                    faults.push((path.to_string(), fault));
                }
                continue;
            }
        };
        if instance.body.is_some() {
            owners.push(Thing::Model(id));
        }
        bodies.push(instance.body);
        keys.push(key);
        let mut drawn = Drawn::default();
        let onboard = instance.onboard;
        for (consumer, current) in [Consumer::Sensors, Consumer::Avionics]
            .into_iter()
            .zip(onboard.constant)
        {
            if current > Current::ZERO {
                drawn.load(consumer, current, SimTime::ZERO);
            }
        }
        let core = Core {
            id,
            body: instance.body,
            radios: instance.radios.into(),
            rng: Stream::keyed(seed, key, "behavior"),
            timers: Timers::new(),
            told: 0,
            drawn,
            onboard: (!onboard.is_empty()).then(|| Box::new(onboard)),
        };
        agents.push(Agent { model, core });
    }
    if !faults.is_empty() {
        return Err(SetupError::Models(faults));
    }
    check_keys(&keys, &population)?;
    let looks = add_objects(&setup.world, seed, &mut physics, &mut owners)?;
    let swarm = Swarm {
        physics,
        gravity: setup.physics.gravity,
        medium,
        weather: Arc::clone(&setup.weather),
        gases: Gases::new(&setup.world, Arc::clone(&setup.weather)),
        world: Arc::clone(&setup.world),
        population,
        keys,
        bodies,
        owners,
        looks,
        mail: MailRoom::default(),
        contacts: Vec::new(),
        touches: Vec::new(),
        listeners: Vec::new(),
        touch_count: 0,
        jumps: 0,
        marks: Vec::new(),
        keep_marks: false,
        watched: Vec::new(),
        packet_watch: None,
        metrics: Metrics::default(),
        gear: gears,
        radio_nanos: AtomicU64::new(0),
        medium_nanos: 0,
        contact_nanos: 0,
    };
    Ok((swarm, agents))
}

/// Puts the objects of the world in their places, after all models: those keep their ids. Tells how the
/// body of each looks.
fn add_objects(
    world: &World,
    seed: u64,
    physics: &mut Physics,
    owners: &mut Vec<Thing>,
) -> Result<Vec<Look>, SetupError> {
    let (mut looks, mut flowers) = (Vec::new(), 0);
    for object in world.objects(seed) {
        let id = object.id;
        let mut number = id.index;
        if id.kind == ObjectKind::Flower {
            (number, flowers) = (flowers, flowers + 1);
        }
        let color = object.color;
        for body in crate::objects::bodies(&object) {
            physics
                .add(body)
                .map_err(|fault| SetupError::Object { object: id, fault })?;
            owners.push(Thing::Object(id));
            looks.push(Look { color, number });
        }
    }
    Ok(looks)
}

/// Chance and traces hang on the keys of paths: no two may be the same.
fn check_keys(keys: &[u64], population: &Population) -> Result<(), SetupError> {
    let mut order: Vec<u32> = (0..keys.len() as u32).collect();
    order.sort_unstable_by_key(|i| keys[*i as usize]);
    match order
        .windows(2)
        .find(|pair| keys[pair[0] as usize] == keys[pair[1] as usize])
    {
        Some(pair) => {
            let path = |i: u32| population.path(ModelId(i)).to_owned();
            Err(SetupError::KeyCollision(path(pair[0]), path(pair[1])))
        }
        None => Ok(()),
    }
}

//! Runs put together by hand, for the tests beside this file.

use simbeeotic_model::config::{Node, Span, Table, Value};
use simbeeotic_model::instance::{RadioPlan, SensorPlan};
use simbeeotic_model::kernel::{Limits, SimTime};
use simbeeotic_model::radio::{Isotropic, Medium, SimpleConfig, SimpleMedium};
use simbeeotic_model::registry::{self, Kind, Make};
use simbeeotic_model::units::{Attitude, Mount, Pose, Position};
use simbeeotic_model::world::{Calm, Weather, World};
use simbeeotic_model::{ModelPlan, Origin, Sampling, Setup, Simulation, Supply};
// Brings the parts onto the shelf.
use simbeeotic_models as _;
use std::sync::Arc;

/// A section of a scenario. Text in brackets is a list: `[1 m, 2 m, 3 m]`; a key with a dot in it stands
/// in a table within.
pub(crate) fn section(entries: &[(&str, &str)]) -> Node {
    let mut table = Table::default();
    for (key, text) in entries {
        match key.split_once('.') {
            None => table.set(key, value(text)),
            Some((outer, _)) => {
                let within = entries.iter().filter_map(|(key, text)| {
                    let (other, inner) = key.split_once('.')?;
                    (other == outer).then_some((inner, *text))
                });
                table.set(outer, section(&within.collect::<Vec<_>>()));
            }
        }
    }
    Node::new(Span::default(), Value::Table(table))
}

fn value(text: &str) -> Node {
    let list = text.strip_prefix('[').and_then(|t| t.strip_suffix(']'));
    let value = match text {
        "true" => Value::Bool(true),
        "false" => Value::Bool(false),
        _ if list.is_some() => Value::Array(list.into_iter().flat_map(entries_of).collect()),
        number if number.parse::<f64>().is_ok() => match number.parse::<i64>() {
            Ok(whole) => Value::Integer(whole),
            Err(_) => Value::Float(number.parse().expect("a number")),
        },
        text => Value::String(text.to_owned()),
    };
    Node::new(Span::default(), value)
}

/// What stands between the commas of a list, but for those of lists within.
fn entries_of(list: &str) -> Vec<Node> {
    let (mut depth, mut entries) = (0, vec![String::new()]);
    for letter in list.chars() {
        match letter {
            '[' => depth += 1,
            ']' => depth -= 1,
            ',' if depth == 0 => {
                entries.push(String::new());
                continue;
            }
            _ => {}
        }
        entries.last_mut().expect("at least one").push(letter);
    }
    let entries = entries.iter().map(|entry| entry.trim());
    entries
        .filter(|entry| !entry.is_empty())
        .map(value)
        .collect()
}

/// A bee that flies `behavior` with these parameters, starting at a place.
pub(crate) fn bee(name: &str, behavior: &str, params: &[(&str, &str)], at: [f64; 3]) -> ModelPlan {
    vehicle(name, behavior, params, &[], at)
}

/// The same with parameters for its vehicle.
pub(crate) fn vehicle(
    name: &str,
    behavior: &str,
    params: &[(&str, &str)],
    vehicle: &[(&str, &str)],
    at: [f64; 3],
) -> ModelPlan {
    let part = registry::find(Kind::Model, behavior).expect("a behaviour of the shelf");
    let Make::Model(make) = part.make else {
        unreachable!("its kind is model")
    };
    let factory = make(&section(params)).expect("good parameters");
    let body = registry::find(Kind::Vehicle, "simple-bee").expect("the vehicle of the shelf");
    let Make::Vehicle(make) = body.make else {
        unreachable!("its kind is vehicle")
    };
    let vehicle = factory
        .flies()
        .then(|| make(&section(vehicle)).expect("good parameters"));
    ModelPlan {
        path: name.to_owned(),
        kind: part.label.name,
        factory,
        vehicle,
        gear: Arc::default(),
        start: Pose::new(Position::from_xyz(at[0], at[1], at[2]), Attitude::IDENTITY),
        parent: None,
    }
}

/// Puts a sensor of the shelf on board.
pub(crate) fn with_sensor(plan: ModelPlan, name: &str, kind: &str) -> ModelPlan {
    with_sensor_of(plan, name, kind, &[])
}

/// The same with parameters for the sensor.
pub(crate) fn with_sensor_of(
    mut plan: ModelPlan,
    name: &str,
    kind: &str,
    params: &[(&str, &str)],
) -> ModelPlan {
    let part = registry::find(Kind::Sensor, kind).expect("a sensor of the shelf");
    let Make::Sensor(make) = part.make else {
        unreachable!("its kind is sensor")
    };
    let factory = make(&section(params)).expect("good parameters");
    let sensor = SensorPlan {
        name: name.to_owned(),
        factory,
        mount: Mount::IDENTITY,
        sampling: Sampling::default(),
        current: None,
        on_time: None,
    };
    Arc::make_mut(&mut plan.gear).sensors.push(sensor);
    plan
}

/// Mounts the sensor that was put on board last, and says when it is read.
#[allow(dead_code, reason = "the trials within the crate use it")]
pub(crate) fn mounted(mut plan: ModelPlan, mount: Mount, sampling: Sampling) -> ModelPlan {
    let sensors = &mut Arc::make_mut(&mut plan.gear).sensors;
    let sensor = sensors.last_mut().expect("a sensor on board");
    (sensor.mount, sensor.sampling) = (mount, sampling);
    plan
}

/// Puts a battery on board: the keys of `[model.battery]`.
#[allow(
    dead_code,
    reason = "some of the crates that share this file fly without"
)]
pub(crate) fn with_battery(mut plan: ModelPlan, keys: &[(&str, &str)]) -> ModelPlan {
    let supply = Supply::read(&section(keys)).expect("good parameters");
    Arc::make_mut(&mut plan.gear).supply = Some(Arc::new(supply));
    plan
}

/// Puts a CC2420 on board.
pub(crate) fn with_radio(mut plan: ModelPlan) -> ModelPlan {
    let part = registry::find(Kind::Radio, "cc2420").expect("the radio of the shelf");
    let Make::Radio(make) = part.make else {
        unreachable!("its kind is radio")
    };
    let spec = make(&section(&[])).expect("good parameters");
    let antenna = Arc::new(Isotropic::default());
    let radio = RadioPlan {
        name: "radio".to_owned(),
        spec,
        antenna,
        mount: Mount::IDENTITY,
    };
    Arc::make_mut(&mut plan.gear).radios.push(radio);
    plan
}

/// A run of these models.
pub(crate) fn run(models: Vec<ModelPlan>, seconds: u64) -> Simulation {
    run_in(models, seconds, Arc::new(Calm), 1)
}

/// A run of these models in some weather, on some threads.
pub(crate) fn run_in(
    models: Vec<ModelPlan>,
    seconds: u64,
    weather: Arc<dyn Weather>,
    threads: usize,
) -> Simulation {
    let setup = Setup {
        weather,
        threads,
        ..setup(models, seconds)
    };
    Simulation::new(setup).expect("it can be put together")
}

/// A run of these models in a world.
pub(crate) fn run_among(world: World, models: Vec<ModelPlan>, seconds: u64) -> Simulation {
    let setup = Setup {
        world: Arc::new(world),
        ..setup(models, seconds)
    };
    Simulation::new(setup).expect("it can be put together")
}

/// A model without a body.
pub(crate) fn model(name: &str, behavior: &str) -> ModelPlan {
    bee(name, behavior, &[], [0.0; 3])
}

/// What a run of these models is made of.
pub(crate) fn setup(models: Vec<ModelPlan>, seconds: u64) -> Setup {
    let medium = SimpleMedium::new(SimpleConfig::default()).expect("good numbers");
    Setup {
        origin: Origin {
            seed: 7,
            ..Origin::default()
        },
        limits: Limits {
            end: SimTime::from_secs(seconds),
            ..Limits::default()
        },
        threads: 1,
        pace: None,
        physics: Default::default(),
        medium: Some(Box::new(medium) as Box<dyn Medium>),
        weather: Arc::new(Calm),
        world: Arc::new(World::default()),
        models,
        components: Vec::new(),
    }
}

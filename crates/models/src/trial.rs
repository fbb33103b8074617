//! What the tests of the shelf share.

#[path = "../tests/it/swarm.rs"]
#[allow(
    dead_code,
    unused_imports,
    reason = "the tests beside this crate use the rest"
)]
mod swarm;

pub(crate) use swarm::{
    bee, model, mounted, run, run_among, setup, vehicle, with_battery, with_radio, with_sensor_of,
};

use simbeeotic_model::config::to_node;
use simbeeotic_model::registry::{self, Kind, Label, Make, Part, SensorKit};
use simbeeotic_model::units::{Mount, Time};
use simbeeotic_model::world::{Calm, Weather, World};
use simbeeotic_model::{
    Bee, Behavior, BuildError, Flying, Handle, Kit, ModelPlan, Reading, Sampling, Setup,
    Simulation, params,
};
use std::any::Any;
use std::cell::RefCell;
use std::sync::Arc;

/// A test's behaviour has none.
#[params]
#[derive(Default)]
pub(crate) struct NoParams {}

/// Holds draws against a normal distribution: mean and variance within four standard errors.
pub(crate) fn assert_normal(draws: &[f64], mean: f64, sigma: f64) {
    let n = draws.len() as f64;
    let found = draws.iter().sum::<f64>() / n;
    let error = 4.0 * sigma / n.sqrt();
    assert!(
        (found - mean).abs() < error,
        "a mean of {found}, not {mean}"
    );

    let squares = draws.iter().map(|draw| (draw - found) * (draw - found));
    let variance = squares.sum::<f64>() / (n - 1.0) / (sigma * sigma);
    let error = 4.0 * (2.0 / n).sqrt();
    assert!(
        (variance - 1.0).abs() < error,
        "a variance of {variance} sigma^2, where sigma is {sigma}"
    );
}

/// The overlapping Allan deviation of equally spaced readings over `tau` of them (IEEE Std 952-1997,
/// annex C).
pub(crate) fn allan_deviation(readings: &[f64], tau: usize) -> f64 {
    let mut sums = vec![0.0];
    for reading in readings {
        sums.push(sums[sums.len() - 1] + reading);
    }
    let steps = sums.len() - 2 * tau;
    let squares = (0..steps).map(|at| {
        let change = sums[at + 2 * tau] - 2.0 * sums[at + tau] + sums[at];
        change * change
    });
    let mean = squares.sum::<f64>() / steps as f64;
    (mean / (2.0 * (tau * tau) as f64)).sqrt()
}

/// One sensor of the shelf on a bee, in a world of one's own, and what a test does with it.
///
/// ```text
/// Trial::of("position", &[("sigma", "0.2 m")]).run(|bee, sensor: Handle<Position>| {
///     let readings = (0..1000).map(|_| bee.read(sensor));
/// });
/// ```
pub(crate) struct Trial {
    pub(crate) kind: &'static str,
    pub(crate) params: Vec<(&'static str, String)>,
    pub(crate) vehicle: Vec<(&'static str, &'static str)>,
    pub(crate) mount: Mount,
    pub(crate) sampling: Sampling,
    /// Where the bee starts, m.
    pub(crate) at: [f64; 3],
    /// When the test acts first, and how often.
    pub(crate) first: Time,
    pub(crate) every: Time,
    pub(crate) seconds: u64,
    pub(crate) world: World,
    pub(crate) weather: Arc<dyn Weather>,
    /// Other models; the bee comes first, as `bee`.
    pub(crate) others: Vec<ModelPlan>,
    /// The keys of its battery; none if empty.
    pub(crate) battery: Vec<(&'static str, &'static str)>,
    /// Whether it carries a CC2420.
    pub(crate) radio: bool,
}

type Act<R> = Box<dyn FnMut(&mut Bee<'_>, Handle<R>) + Send>;

thread_local! {
    /// What the bee of the trial on this thread does: an `Act<R>`. A run of one thread stays on it.
    static ACT: RefCell<Option<Box<dyn Any>>> = const { RefCell::new(None) };
}

impl Trial {
    /// A sensor read on demand, once, after a second, on a bee that floats 10 m up: it keeps the
    /// velocity and rate that the test gives it. (It stands on its start: its centre is 5 cm higher.)
    pub(crate) fn of(kind: &'static str, params: &[(&'static str, &str)]) -> Self {
        Self {
            kind,
            params: params.iter().map(|(k, v)| (*k, (*v).to_owned())).collect(),
            vehicle: vec![("control_period", "1000 s")],
            mount: Mount::IDENTITY,
            sampling: Sampling::default(),
            at: [0.0, 0.0, 10.0],
            first: Time::from_secs(1.0),
            every: Time::from_secs(1.0),
            seconds: 1,
            world: World::default(),
            weather: Arc::new(Calm),
            others: Vec::new(),
            battery: Vec::new(),
            radio: false,
        }
    }

    /// Runs it. A test that asserts within `act` fails as usual.
    pub(crate) fn run<R: Reading>(self, act: impl FnMut(&mut Bee<'_>, Handle<R>) + Send + 'static) {
        ACT.set(Some(Box::new(Box::new(act) as Act<R>)));
        let label = Label {
            name: "trial",
            docs: "",
            module: "",
            java: &[],
        };
        let Make::Model(make) = Part::behavior::<Trier<R>, Flying>(label).make else {
            unreachable!("its kind is model")
        };
        let timing = TrialParams {
            first: self.first,
            every: self.every,
        };
        let mut plan = vehicle("bee", "inert-bee", &[], &self.vehicle, self.at);
        plan.factory = make(&to_node(&timing)).expect("good parameters");
        let params: Vec<_> = self.params.iter().map(|(k, v)| (*k, v.as_str())).collect();
        let plan = with_sensor_of(plan, "sensor", self.kind, &params);
        let mut plan = mounted(plan, self.mount, self.sampling);
        if !self.battery.is_empty() {
            plan = with_battery(plan, &self.battery);
        }
        if self.radio {
            plan = with_radio(plan);
        }
        let mut models = vec![plan];
        models.extend(self.others);
        let setup = Setup {
            world: Arc::new(self.world),
            weather: self.weather,
            ..setup(models, self.seconds)
        };
        let outcome = Simulation::new(setup)
            .expect("it can be put together")
            .run();
        ACT.set(None);
        assert!(outcome.error.is_none(), "{:?}", outcome.error);
    }
}

/// The behaviour of a trial's bee.
struct Trier<R> {
    sensor: Handle<R>,
    acted: bool,
}

/// Parameters of [`Trier`].
#[params]
struct TrialParams {
    first: Time,
    every: Time,
}

impl Default for TrialParams {
    fn default() -> Self {
        Self {
            first: Time::ZERO,
            every: Time::from_secs(1.0),
        }
    }
}

impl<R: Reading> Behavior for Trier<R> {
    type Params = TrialParams;

    fn build(params: TrialParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        kit.every_from(params.first, params.every, Self::act);
        Ok(Self {
            sensor: kit.sensor("sensor")?,
            acted: false,
        })
    }

    fn on_finish(&mut self, _bee: &mut Bee<'_>) {
        assert!(self.acted, "the trial never came to its point");
    }
}

impl<R: Reading> Trier<R> {
    fn act(&mut self, bee: &mut Bee<'_>) {
        self.acted = true;
        ACT.with_borrow_mut(|act| {
            let act = act.as_mut().and_then(|act| act.downcast_mut::<Act<R>>());
            act.expect("it was put there")(bee, self.sensor);
        });
    }
}

/// Whether a sensor of the shelf refuses these parameters, and what it says.
pub(crate) fn refusal(kind: &str, params: &[(&str, &str)]) -> Option<String> {
    let part = registry::find(Kind::Sensor, kind).expect("a sensor of the shelf");
    let Make::Sensor(make) = part.make else {
        unreachable!("its kind is sensor")
    };
    let factory = match make(&swarm::section(params)) {
        Ok(factory) => factory,
        Err(faults) => return Some(format!("{faults:?}")),
    };
    let kit = SensorKit {
        mount: Mount::IDENTITY,
        sampling: Sampling::default(),
        seed: 1,
        path: "bee/sensor",
        world: &World::default(),
    };
    factory.build(&kit).err().map(|fault| fault.to_string())
}

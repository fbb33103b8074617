//! The shelf: every part that a scenario may name.
//!
//! A part is a type with an attribute (`#[behavior("my-bee")]`, `#[sensor("compass")]`, ...) in any
//! crate that is linked into the program. Parts are sorted by name: link order never shows.
//!
//! A crate that is only listed in `Cargo.toml` registers nothing until the program refers to it
//! (`use my_parts as _;`).

use crate::about::Beams;
use crate::air::{AirMaker, Fidelity, MadeAir};
use crate::behavior::{Behavior, BuildError};
use crate::component::Component;
use crate::config::{Fault, Node, Params, read_params};
use crate::host::Host;
use crate::hosted::{Handlers, Hosted};
use crate::instance::Instance;
use crate::model::Model;
use crate::sampling::{Sampler, Sampling};
use crate::sensor::{AnySensor, Mounted, Sensor};
use crate::vehicle::{AnyVehicle, Carried, Vehicle, VehicleKit};
use schemars::Schema;
use simbeeotic_kernel::Stream;
use simbeeotic_radio::{Antenna, Fading, Propagation, RadioSpec};
use simbeeotic_units::Mount;
use simbeeotic_world::{Weather, World};
use std::any::TypeId;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// What a part is used as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Kind {
    /// `[[model]] use = "..."`
    Model,
    /// `[model.vehicle] use = "..."`
    Vehicle,
    /// `[model.sensor.NAME] use = "..."`
    Sensor,
    /// `[model.radio] use = "..."`
    Radio,
    /// `antenna = "..."` of a radio
    Antenna,
    /// `[channel] use = "..."`
    Propagation,
    /// `[channel] fading = "..."`
    Fading,
    /// `[channel] medium = "..."`
    Medium,
    /// `[weather] use = "..."`
    Weather,
    /// `[world] generate = { use = "..." }`
    Generator,
    /// `[[component]] use = "..."`
    Component,
}

impl Kind {
    /// All kinds, in the order of `simbeeotic list`.
    pub const ALL: [Self; 11] = [
        Self::Model,
        Self::Vehicle,
        Self::Sensor,
        Self::Radio,
        Self::Antenna,
        Self::Propagation,
        Self::Fading,
        Self::Medium,
        Self::Weather,
        Self::Generator,
        Self::Component,
    ];

    /// The word for it in messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Model => "model",
            Self::Vehicle => "vehicle",
            Self::Sensor => "sensor",
            Self::Radio => "radio",
            Self::Antenna => "antenna",
            Self::Propagation => "propagation",
            Self::Fading => "fading",
            Self::Medium => "medium",
            Self::Weather => "weather",
            Self::Generator => "generator",
            Self::Component => "component",
        }
    }
}

/// What a part's attribute says about it.
#[derive(Clone, Copy, Debug)]
pub struct Label {
    /// Its name in scenarios, kebab-case.
    pub name: &'static str,
    /// The doc comment of its type.
    pub docs: &'static str,
    /// The module it is written in.
    pub module: &'static str,
    /// The class names that the original knew it by.
    pub java: &'static [&'static str],
}

/// One part on the shelf.
pub struct Part {
    /// Name, docs, origin.
    pub label: Label,
    /// What it is used as.
    pub kind: Kind,
    /// JSON schema of its parameters.
    pub schema: fn() -> Schema,
    /// Its parameters with their defaults, as they would be written.
    pub defaults: fn() -> Node,
    /// All its parameters, as a section gives them and else by default; `None` if the section has faults.
    pub complete: fn(&Node) -> Option<Node>,
    /// Makes it from a section of a scenario.
    pub make: Make,
}

inventory::collect!(Part);

/// Checks a section and returns what makes instances; or all faults of the section.
pub type Maker<T> = fn(&Node) -> Result<T, Vec<Fault>>;

/// The same for a part that is made anew for each run, and knows where.
pub type SiteMaker<T> = fn(&Node, &Site<'_>) -> Result<T, Vec<Fault>>;

/// Where a part of a run is made: whose seed its chance hangs on, and where its files are.
#[derive(Clone, Copy, Debug)]
pub struct Site<'a> {
    /// The master seed of the run.
    pub seed: u64,
    /// The folder that file names of the scenario are relative to; empty: that which the program runs
    /// in.
    pub folder: &'a Path,
}

impl Default for Site<'_> {
    fn default() -> Self {
        Self {
            seed: 0,
            folder: Path::new(""),
        }
    }
}

impl Site<'_> {
    /// The stream of the part called `path` for one purpose.
    pub fn stream(&self, path: &str, purpose: &str) -> Stream {
        Stream::new(self.seed, path, purpose)
    }

    /// The path of a file that the scenario names.
    pub fn file(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }
}

/// How a part is made, by kind. The section has the part's own keys only.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub enum Make {
    /// A model.
    Model(Maker<Arc<dyn ModelFactory>>),
    /// A vehicle.
    Vehicle(Maker<Arc<dyn VehicleFactory>>),
    /// A sensor.
    Sensor(Maker<Arc<dyn SensorFactory>>),
    /// A radio, without owner and antenna.
    Radio(Maker<RadioSpec>),
    /// An antenna pattern.
    Antenna(SiteMaker<Arc<dyn Antenna>>),
    /// A propagation model.
    Propagation(SiteMaker<Arc<dyn Propagation>>),
    /// A fading model.
    Fading(Maker<Arc<dyn Fading>>),
    /// A medium; `None`: no packet goes anywhere.
    Medium(AirMaker),
    /// Weather.
    Weather(SiteMaker<Arc<dyn Weather>>),
    /// A world.
    Generator(Maker<World>),
    /// A component.
    Component(Maker<Box<dyn Component>>),
}

/// Makes instances of a model whose parameters are checked.
pub trait ModelFactory: Send + Sync {
    /// Whether its host flies, and so wants a vehicle.
    fn flies(&self) -> bool;

    /// Makes one.
    ///
    /// # Errors
    /// What this instance lacks; parameters out of range, at their place in the scenario.
    fn build(&self, instance: &mut Instance<'_>) -> Result<Box<dyn Model>, Fault>;
}

/// Makes vehicles.
pub trait VehicleFactory: Send + Sync {
    /// Makes one.
    ///
    /// # Errors
    /// Parameters out of range.
    fn build(&self, kit: &VehicleKit<'_>) -> Result<Box<dyn AnyVehicle>, BuildError>;
}

/// Makes sensors.
pub trait SensorFactory: Send + Sync {
    /// The type of their readings, and its name.
    fn reading(&self) -> (TypeId, &'static str);

    /// What one of them looks along, see [`Sensor::beams`].
    fn beams(&self) -> Option<Beams>;

    /// Makes one.
    ///
    /// # Errors
    /// Parameters out of range.
    fn build(&self, kit: &SensorKit<'_>) -> Result<Box<dyn AnySensor>, BuildError>;
}

/// What one sensor is built from, besides its parameters.
#[derive(Clone, Copy, Debug)]
pub struct SensorKit<'a> {
    /// Where it sits.
    pub mount: Mount,
    /// When it is read.
    pub sampling: Sampling,
    /// The master seed.
    pub seed: u64,
    /// Its path: `bee-17/compass`.
    pub path: &'a str,
    /// The world that it is in.
    pub world: &'a World,
}

/// A part that needs nothing but its parameters: antennas, propagation, fading, weather, components.
pub trait FromParams: Sized + Send + 'static {
    /// What the scenario may set.
    type Params: Params;

    /// Makes one.
    ///
    /// # Errors
    /// Parameters out of range, by [`BuildError::parameter`].
    fn from_params(params: Self::Params) -> Result<Self, BuildError>;

    /// Makes one for a run: for weather and propagation that draw chance, and whatever reads files. An
    /// antenna is made once for all models of an entry, with a seed of 0. Unless it says otherwise, as
    /// [`from_params`](Self::from_params) does.
    ///
    /// # Errors
    /// The same; a file that cannot be read.
    fn for_run(params: Self::Params, _site: &Site<'_>) -> Result<Self, BuildError> {
        Self::from_params(params)
    }
}

/// A kind of radio: a datasheet as a function from settings to a [`RadioSpec`]. Register it with
/// `#[radio("name")]`.
pub trait Radio: Sized + 'static {
    /// What the scenario may set: channel, power level, ...
    type Params: Params;

    /// The radio with these settings.
    ///
    /// # Errors
    /// Settings that the radio does not have, by [`BuildError::parameter`].
    fn spec(params: Self::Params) -> Result<RadioSpec, BuildError>;
}

/// A rule that makes worlds: a function from its parameters, a seed among them, to a [`World`].
/// Register it with `#[generator("name")]`.
///
/// The same parameters must give the same world. A parameter called `seed` is what `simbeeotic world
/// KIND --seed N` sets.
pub trait Generator: Sized + 'static {
    /// What the scenario may set.
    type Params: Params;

    /// The world of these parameters.
    ///
    /// # Errors
    /// Parameters out of range, by [`BuildError::parameter`].
    fn generate(params: &Self::Params) -> Result<World, BuildError>;
}

impl Part {
    const fn new<P: Params>(label: Label, kind: Kind, make: Make) -> Self {
        Self {
            label,
            kind,
            schema: schema::<P>,
            defaults: defaults::<P>,
            complete: complete::<P>,
            make,
        }
    }

    /// A behaviour on its host. Called by `#[behavior]`.
    pub const fn behavior<B: Behavior<H>, H: Host>(label: Label) -> Self {
        Self::new::<B::Params>(label, Kind::Model, Make::Model(make_model::<B, H>))
    }

    /// A vehicle. Called by `#[vehicle]`.
    pub const fn vehicle<V: Vehicle>(label: Label) -> Self {
        Self::new::<V::Params>(label, Kind::Vehicle, Make::Vehicle(make_vehicle::<V>))
    }

    /// A sensor. Called by `#[sensor]`.
    pub const fn sensor<S: Sensor>(label: Label) -> Self {
        Self::new::<S::Params>(label, Kind::Sensor, Make::Sensor(make_sensor::<S>))
    }

    /// A radio. Called by `#[radio]`.
    pub const fn radio<R: Radio>(label: Label) -> Self {
        Self::new::<R::Params>(label, Kind::Radio, Make::Radio(make_radio::<R>))
    }

    /// An antenna pattern. Called by `#[antenna]`.
    pub const fn antenna<A: FromParams + Antenna>(label: Label) -> Self {
        let make: SiteMaker<Arc<dyn Antenna>> =
            |node, site| Ok(Arc::new(make_for_run::<A>(node, site)?));
        Self::new::<A::Params>(label, Kind::Antenna, Make::Antenna(make))
    }

    /// A propagation model. Called by `#[propagation]`.
    pub const fn propagation<P: FromParams + Propagation>(label: Label) -> Self {
        let make: SiteMaker<Arc<dyn Propagation>> =
            |node, site| Ok(Arc::new(make_for_run::<P>(node, site)?));
        Self::new::<P::Params>(label, Kind::Propagation, Make::Propagation(make))
    }

    /// A fading model. Called by `#[fading]`.
    pub const fn fading<F: FromParams + Fading>(label: Label) -> Self {
        let make: Maker<Arc<dyn Fading>> = |node| Ok(Arc::new(make_plain::<F>(node)?));
        Self::new::<F::Params>(label, Kind::Fading, Make::Fading(make))
    }

    /// A level of fidelity of the air. Called by `#[medium]`.
    pub const fn medium<F: Fidelity>(label: Label) -> Self {
        let make: AirMaker = |node, air| {
            let recipe = Recipe::<F::Params>::read(node)?;
            let medium =
                F::medium(recipe.params.clone(), air).map_err(|e| vec![recipe.place(e)])?;
            let aside = F::leaves_aside(air);
            Ok(MadeAir { medium, aside })
        };
        Self::new::<F::Params>(label, Kind::Medium, Make::Medium(make))
    }

    /// Weather. Called by `#[weather]`.
    pub const fn weather<W: FromParams + Weather>(label: Label) -> Self {
        let make: SiteMaker<Arc<dyn Weather>> =
            |node, site| Ok(Arc::new(make_for_run::<W>(node, site)?));
        Self::new::<W::Params>(label, Kind::Weather, Make::Weather(make))
    }

    /// A rule that makes worlds. Called by `#[generator]`.
    pub const fn generator<G: Generator>(label: Label) -> Self {
        let make: Maker<World> = |node| {
            let recipe = Recipe::<G::Params>::read(node)?;
            G::generate(&recipe.params).map_err(|e| vec![recipe.place(e)])
        };
        Self::new::<G::Params>(label, Kind::Generator, Make::Generator(make))
    }

    /// A component. Called by `#[component]`.
    pub const fn component<C: FromParams + Component>(label: Label) -> Self {
        let make: Maker<Box<dyn Component>> = |node| Ok(Box::new(make_plain::<C>(node)?));
        Self::new::<C::Params>(label, Kind::Component, Make::Component(make))
    }

    /// The first sentence of its documentation.
    pub fn summary(&self) -> &'static str {
        self.label.docs.split("\n\n").next().unwrap_or("").trim()
    }
}

fn schema<P: Params>() -> Schema {
    schemars::schema_for!(P)
}

fn defaults<P: Params>() -> Node {
    crate::config::to_node(&P::default())
}

/// All parameters of a section, those that it leaves out by default.
pub(crate) fn complete<P: Params>(section: &Node) -> Option<Node> {
    Some(crate::config::to_node(&read_params::<P>(section).ok()?))
}

/// A part's checked parameters, and the section they came from.
struct Recipe<P> {
    params: P,
    node: Node,
}

impl<P: Params> Recipe<P> {
    fn read(node: &Node) -> Result<Self, Vec<Fault>> {
        Ok(Self {
            params: read_params(node)?,
            node: node.clone(),
        })
    }

    /// A fault of building, at the key that causes it.
    fn place(&self, error: BuildError) -> Fault {
        place(&self.node, error)
    }
}

/// A fault of building from `node`, at the key that causes it.
pub(crate) fn place(node: &Node, error: BuildError) -> Fault {
    match error {
        BuildError::Placed(fault) => fault,
        BuildError::Parameter { key, .. } => {
            let entry = node.as_table().and_then(|table| table.get(key));
            Fault::error(
                entry.map_or(node.span, |value| value.span),
                error.to_string(),
            )
        }
        _ => Fault::error(node.span, error.to_string()),
    }
}

fn make_plain<T: FromParams>(node: &Node) -> Result<T, Vec<Fault>> {
    let recipe = Recipe::<T::Params>::read(node)?;
    T::from_params(recipe.params.clone()).map_err(|e| vec![recipe.place(e)])
}

fn make_for_run<T: FromParams>(node: &Node, site: &Site<'_>) -> Result<T, Vec<Fault>> {
    let recipe = Recipe::<T::Params>::read(node)?;
    T::for_run(recipe.params.clone(), site).map_err(|e| vec![recipe.place(e)])
}

fn make_radio<R: Radio>(node: &Node) -> Result<RadioSpec, Vec<Fault>> {
    let recipe = Recipe::<R::Params>::read(node)?;
    R::spec(recipe.params.clone()).map_err(|e| vec![recipe.place(e)])
}

struct BehaviorFactory<B: Behavior<H>, H: Host> {
    recipe: Recipe<B::Params>,
    handlers: OnceLock<Handlers<B, H>>,
}

fn make_model<B: Behavior<H>, H: Host>(node: &Node) -> Result<Arc<dyn ModelFactory>, Vec<Fault>> {
    Ok(Arc::new(BehaviorFactory::<B, H> {
        recipe: Recipe::read(node)?,
        handlers: OnceLock::new(),
    }))
}

impl<B: Behavior<H>, H: Host> ModelFactory for BehaviorFactory<B, H> {
    fn flies(&self) -> bool {
        H::FLIES
    }

    fn build(&self, instance: &mut Instance<'_>) -> Result<Box<dyn Model>, Fault> {
        match Hosted::<B, H>::build(self.recipe.params.clone(), instance, &self.handlers) {
            Ok(model) => Ok(Box::new(model)),
            Err(error) => Err(self.recipe.place(error)),
        }
    }
}

struct MakeVehicle<V: Vehicle> {
    params: Arc<V::Params>,
    node: Node,
}

fn make_vehicle<V: Vehicle>(node: &Node) -> Result<Arc<dyn VehicleFactory>, Vec<Fault>> {
    let Recipe { params, node } = Recipe::read(node)?;
    Ok(Arc::new(MakeVehicle::<V> {
        params: Arc::new(params),
        node,
    }))
}

impl<V: Vehicle> VehicleFactory for MakeVehicle<V> {
    fn build(&self, kit: &VehicleKit<'_>) -> Result<Box<dyn AnyVehicle>, BuildError> {
        match V::build(Arc::clone(&self.params), kit) {
            Ok(vehicle) => Ok(Box::new(Carried::new(vehicle))),
            Err(error) => Err(BuildError::Placed(place(&self.node, error))),
        }
    }
}

struct MakeSensor<S: Sensor>(Recipe<S::Params>);

fn make_sensor<S: Sensor>(node: &Node) -> Result<Arc<dyn SensorFactory>, Vec<Fault>> {
    Ok(Arc::new(MakeSensor::<S>(Recipe::read(node)?)))
}

impl<S: Sensor> SensorFactory for MakeSensor<S> {
    fn reading(&self) -> (TypeId, &'static str) {
        (
            TypeId::of::<S::Reading>(),
            std::any::type_name::<S::Reading>(),
        )
    }

    fn beams(&self) -> Option<Beams> {
        S::build(self.0.params.clone()).ok()?.beams()
    }

    fn build(&self, kit: &SensorKit<'_>) -> Result<Box<dyn AnySensor>, BuildError> {
        let stream = |purpose| Stream::new(kit.seed, kit.path, purpose);
        let sampler = Sampler::new(&kit.sampling, || stream(Sampling::PURPOSE));
        let made = S::build(self.0.params.clone());
        let found = made.and_then(|mut sensor| sensor.look_up(kit.world).map(|()| sensor));
        match found {
            Ok(sensor) => Ok(Box::new(Mounted {
                sensor,
                mount: (kit.mount != Mount::IDENTITY).then(|| Box::new(kit.mount)),
                stream: stream("noise"),
                sampler: sampler.map(Box::new),
            })),
            Err(error) => Err(BuildError::Placed(self.0.place(error))),
        }
    }
}

/// All parts, by kind and name.
///
/// # Panics
/// Two linked parts of one kind have the same name, or know the same Java class: a mistake in the
/// program, not in its input.
pub fn parts() -> &'static [&'static Part] {
    static ALL: OnceLock<Vec<&'static Part>> = OnceLock::new();
    ALL.get_or_init(|| {
        let mut all: Vec<&Part> = inventory::iter::<Part>().collect();
        all.sort_by_key(|p| (p.kind, p.label.name));
        for pair in all.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            assert!(
                (a.kind, a.label.name) != (b.kind, b.label.name),
                "two {}s are called `{}`: in {} and in {}",
                a.kind.name(),
                a.label.name,
                a.label.module,
                b.label.module,
            );
        }
        all
    })
}

/// All parts of one kind, by name.
pub fn of_kind(kind: Kind) -> impl Iterator<Item = &'static Part> {
    parts().iter().copied().filter(move |p| p.kind == kind)
}

/// The part of one kind called `name`, by its own name or one the original knew it by.
pub fn find(kind: Kind, name: &str) -> Option<&'static Part> {
    of_kind(kind).find(|p| p.label.name == name || p.label.java.contains(&name))
}

/// Where a part may be that is not on this shelf.
const ELSEWHERE: &str = "Parts of another crate are on the shelf of that crate's own program: `cargo run -- run ...` there";

/// The part called by the text node `name`; a fault with a guess if there is none.
///
/// # Errors
/// No part of this kind has this name.
pub fn find_node(kind: Kind, node: &Node) -> Result<&'static Part, Fault> {
    let Some(name) = node.as_str() else {
        let message = format!(
            "{} where the name of a {} is wanted",
            node.value.kind(),
            kind.name()
        );
        return Err(Fault::error(node.span, message));
    };
    find(kind, name).ok_or_else(|| {
        let fault = Fault::unknown(
            node.span,
            kind.name(),
            name,
            of_kind(kind).map(|p| p.label.name),
        );
        let elsewhere: Vec<_> = parts()
            .iter()
            .filter(|p| p.label.name == name)
            .map(|p| p.kind.name())
            .collect();
        if !elsewhere.is_empty() {
            return fault.help(format!("`{name}` is a {}", elsewhere.join(", ")));
        }
        match fault.help.clone() {
            Some(help) if help.starts_with("known:") => fault.help(format!("{help}. {ELSEWHERE}")),
            _ => fault,
        }
    })
}

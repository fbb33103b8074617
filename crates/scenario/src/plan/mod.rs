//! A tree checked and made typed: every fault in it is found, every part in it is known.
//!
//! ```text
//! [run]        seed, end_time, wall_time, threads, real_time_factor, epoch, limits
//! [channel]    use, medium, noise_floor, range_limit, walls, shadowing, fading, the propagation's own parameters
//! [weather]    use, its own parameters
//! world        = "file", or [world] with the world itself
//! [variables]  what placeholders `${name}` stand for, here and in the world
//! [physics]    gravity, ground, how faithfully contacts are simulated
//! [record]     the recorder's parameters
//! [[model]]    use, like, name, count, start, params, vehicle, sensor, radio, model (nested)
//! [[component]] use, its own parameters
//! [sweep]      what varies; it is taken out before a plan is made
//! ```
//!
//! The makers of all parts are asked at once, so that wrong parameters of the tenth model are told
//! together with those of the first. What only shows when the models are put together (a behaviour
//! that misses a sensor) is told by the run's set-up.
//!
//! Reading order: `section` (how a table is read), `run`, `shared` (what is one for all), `physics`,
//! `start`, `gear` (sensors and radios), `group` (the models).

mod gear;
pub(crate) mod group;
mod physics;
mod run;
mod section;
mod shared;
mod start;

pub use group::Group;
pub use physics::PhysicsParams;
pub use run::{Pace, Run};
pub use shared::Channel;
pub(crate) use shared::choice;

use crate::variables::Variables;
use section::Section;
use simbeeotic_model::config::{Fault, Node, SourceId, Sources, Span};
use simbeeotic_model::physics::Config;
use simbeeotic_model::registry::{Part, Site, find};
use simbeeotic_world::{Spawn, World};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A scenario, checked.
pub struct Plan {
    /// What people call it; empty if it has no name.
    pub name: String,
    /// What it is for.
    pub description: String,
    /// Seed, end, threads.
    pub run: Run,
    /// The air that radios share.
    pub channel: Option<Channel>,
    /// The weather's part and its parameters.
    pub weather: Option<Choice>,
    /// What stands in the world.
    pub world: Arc<World>,
    /// Gravity and ground, and how faithfully contacts are simulated.
    pub physics: Config,
    /// The models, entry by entry.
    pub models: Vec<Group>,
    /// Who watches.
    pub components: Vec<Choice>,
    /// The folder that file names are relative to.
    pub folder: PathBuf,
}

/// A part that was chosen, and its parameters as they were written.
#[derive(Clone)]
pub struct Choice {
    /// The part.
    pub part: &'static Part,
    /// Its own parameters.
    pub params: Node,
}

/// What reading a plan needs besides the tree.
pub(crate) struct Context<'a> {
    pub(crate) faults: Vec<Fault>,
    pub(crate) sources: &'a mut Sources,
    /// Files are looked for from here.
    pub(crate) folder: PathBuf,
    /// A world file that replaces the scenario's.
    pub(crate) world: Option<PathBuf>,
    /// The world's areas to start in; `None` if the world cannot be read.
    pub(crate) areas: Option<Vec<Spawn>>,
    /// What placeholders of the world stand for.
    pub(crate) variables: Variables,
}

impl Context<'_> {
    /// The text of a file that a scenario names.
    pub(crate) fn read_file(
        &mut self,
        name: &str,
        asked: Option<Span>,
    ) -> Option<(SourceId, Arc<str>)> {
        let path = self.folder.join(name);
        crate::load::read_text(&path, asked, self.sources, &mut self.faults)
    }
}

/// Reads a whole scenario. `None` if there are errors among the faults.
pub(crate) fn plan(root: &Node, cx: &mut Context<'_>) -> Option<Plan> {
    let mut section = Section::open(root, "a scenario", &mut cx.faults)?;
    let name = section.read("name", &mut cx.faults).unwrap_or_default();
    let description = section
        .read("description", &mut cx.faults)
        .unwrap_or_default();
    let run = run::read(&mut section, &mut cx.faults);
    let channel = section
        .get("channel")
        .and_then(|node| shared::channel(node, cx));
    let weather = section
        .get("weather")
        .and_then(|node| shared::weather(node, cx));
    let world = shared::world(section.get("world"), cx);
    cx.areas = world.as_ref().map(|w| w.spawns.clone());
    let ground = world.as_ref().map(|w| w.ground.clone()).unwrap_or_default();
    let physics = physics::physics(section.get("physics"), &ground, &mut cx.faults);
    let components = shared::components(&mut section, &mut cx.faults);
    let models = section
        .entry("model")
        .map(|(_, node)| group::groups(node, cx));
    if let Some((key, _)) = section.entry("looping") {
        let fault = Fault::error(key.span, "`looping` is of XML scenarios");
        cx.faults
            .push(fault.help("what varies stands in `[sweep]` here"));
    }
    // Its values stand in the tree already.
    section.get(crate::variables::KEY);
    // Taken out before; a word for guesses.
    section.get(crate::sweep::KEY);
    section.finish(&mut cx.faults);
    let models = match models {
        Some(models) => models,
        None => {
            let message = "there is no `[[model]]`: nothing moves in this scenario";
            cx.faults.push(Fault::warning(root.span, message));
            Vec::new()
        }
    };
    // A section with a fault in it is there, too.
    let has_channel = section_node(root, "channel").is_some();
    group::check_all(&models, root, has_channel, cx);
    if cx.faults.iter().any(Fault::is_error) {
        return None;
    }
    if let (Some(channel), Some(node)) = (&channel, section_node(root, "channel")) {
        let mut radios = std::iter::once_with(|| group::radio_paths(&models)).flatten();
        // Names do not hang on chance.
        let site = Site {
            seed: 0,
            folder: &cx.folder,
        };
        let remarks = channel.remarks(node.span, &site, &mut radios);
        cx.faults.extend(remarks);
    }
    if cx.faults.iter().any(Fault::is_error) {
        return None;
    }
    Some(Plan {
        name,
        description,
        run: run?,
        channel,
        weather,
        world: Arc::new(world?),
        physics,
        models,
        components,
        folder: cx.folder.clone(),
    })
}

/// The node of a section, if it is there.
fn section_node<'n>(root: &'n Node, key: &str) -> Option<&'n Node> {
    root.as_table().and_then(|table| table.get(key))
}

/// The part that the key `use` of a section names.
fn part(
    section: &mut Section<'_>,
    kind: simbeeotic_model::registry::Kind,
    faults: &mut Vec<Fault>,
) -> Option<&'static Part> {
    let first = simbeeotic_model::registry::of_kind(kind)
        .next()
        .map_or("...", |p| p.label.name);
    let node = section.required("use", &format!("use = \"{first}\""), faults)?;
    named(node, kind, faults)
}

/// The part that a text names.
fn named(
    node: &Node,
    kind: simbeeotic_model::registry::Kind,
    faults: &mut Vec<Fault>,
) -> Option<&'static Part> {
    match simbeeotic_model::registry::find_node(kind, node) {
        Ok(part) => Some(part),
        Err(fault) => {
            faults.push(fault);
            None
        }
    }
}

/// The vehicle of whatever flies and names none.
pub(crate) const DEFAULT_VEHICLE: &str = "simple-bee";

fn default_vehicle() -> Option<&'static Part> {
    find(simbeeotic_model::registry::Kind::Vehicle, DEFAULT_VEHICLE)
}

/// The folder that a scenario's files are named from.
pub(crate) fn folder_of(path: &Path) -> PathBuf {
    path.parent().map(Path::to_path_buf).unwrap_or_default()
}

#[cfg(test)]
pub(super) mod testing {
    use super::*;

    /// Runs `read` on the tree of a text; all faults if there is an error among them.
    pub(super) fn with_context<T>(
        text: &str,
        read: impl FnOnce(&Node, &mut Context<'_>) -> Option<T>,
    ) -> Result<T, Vec<Fault>> {
        let mut sources = Sources::new();
        let id = sources.add("x.toml", text);
        let root = crate::toml::parse(text, id)?;
        let mut cx = Context {
            faults: Vec::new(),
            sources: &mut sources,
            folder: PathBuf::new(),
            world: None,
            areas: None,
            variables: Variables::default(),
        };
        let value = read(&root, &mut cx);
        match value {
            Some(value) if !cx.faults.iter().any(Fault::is_error) => Ok(value),
            _ => Err(cx.faults),
        }
    }
}

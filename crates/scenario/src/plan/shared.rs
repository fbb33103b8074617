//! What is one for all models: channel, weather, world, components.

use super::section::Section;
use super::{Choice, Context, named, part};
use serde::Deserialize;
use simbeeotic_model::config::{Fault, Node, Span, Table, Value};
use simbeeotic_model::radio::{Medium, Propagation, SimpleConfig, SimpleMedium};
use simbeeotic_model::registry::{Kind, Make, Site, find};
use simbeeotic_units::{Decibels, Length, PowerLevel};
use simbeeotic_world::World;
use std::sync::Arc;

/// The air that radios share.
#[derive(Clone)]
pub struct Channel {
    /// How faithfully it is simulated.
    pub medium: MediumKind,
    /// The settings of the `simple` medium, without the seed.
    pub simple: SimpleConfig,
}

/// How faithfully the air is simulated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MediumKind {
    /// The paper's: no air time, no interference, noise drawn for each reception.
    #[default]
    Simple,
    /// No packet goes anywhere.
    Off,
}

impl Channel {
    /// A medium for one run.
    ///
    /// # Errors
    /// Numbers that make no sense.
    pub(crate) fn medium(&self, seed: u64) -> Result<Option<Box<dyn Medium>>, String> {
        match self.medium {
            MediumKind::Off => Ok(None),
            MediumKind::Simple => {
                let config = SimpleConfig {
                    seed,
                    ..self.simple.clone()
                };
                let medium = SimpleMedium::new(config).map_err(|e| e.to_string())?;
                Ok(Some(Box::new(medium)))
            }
        }
    }
}

/// Mean and spread of the noise.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct NoiseFloor {
    mean: PowerLevel,
    sigma: Decibels,
}

impl Default for NoiseFloor {
    fn default() -> Self {
        let simple = SimpleConfig::default();
        Self {
            mean: simple.noise_floor,
            sigma: simple.noise_sigma,
        }
    }
}

pub(super) fn channel(node: &Node, faults: &mut Vec<Fault>) -> Option<Channel> {
    let mut section =
        Section::open_part(node, "`[channel]`", ("channel", Kind::Propagation), faults)?;
    let part = part(&mut section, Kind::Propagation, faults);
    let medium = section.read("medium", faults).unwrap_or_default();
    let noise: NoiseFloor = section.read("noise_floor", faults).unwrap_or_default();
    let range: Option<Length> = section.read("range_limit", faults);
    let range_span = section.get("range_limit").map_or(node.span, |n| n.span);
    let noise_span = section.get("noise_floor").map_or(node.span, |n| n.span);
    let part = part?;
    let rest = section.rest(part, faults);
    let propagation = made(part.make, &rest, faults)?;
    let mut simple = SimpleConfig {
        noise_floor: noise.mean,
        noise_sigma: noise.sigma,
        propagation,
        ..SimpleConfig::default()
    };
    if let Some(range) = range {
        simple.range_limit = range;
    }
    if let Err(error) = simple.check() {
        let text = error.to_string();
        let span = if text.contains("range") {
            range_span
        } else {
            noise_span
        };
        faults.push(Fault::error(span, text));
        return None;
    }
    Some(Channel { medium, simple })
}

fn made(make: Make, rest: &Node, faults: &mut Vec<Fault>) -> Option<Arc<dyn Propagation>> {
    let Make::Propagation(make) = make else {
        return None;
    };
    make(rest).map_err(|found| faults.extend(found)).ok()
}

pub(super) fn weather(node: &Node, cx: &mut Context<'_>) -> Option<Choice> {
    let faults = &mut cx.faults;
    let mut section = Section::open_part(node, "`[weather]`", ("weather", Kind::Weather), faults)?;
    let part = part(&mut section, Kind::Weather, faults)?;
    let params = section.rest(part, faults);
    if let Make::Weather(make) = part.make {
        // Whether it can be made does not hang on chance.
        let site = Site {
            seed: 0,
            folder: &cx.folder,
        };
        make(&params, &site)
            .map_err(|found| faults.extend(found))
            .ok()?;
    }
    Some(Choice { part, params })
}

/// `[[component]]`, and `[record]`, which is the recorder by a shorter name.
pub(super) fn components(root: &mut Section<'_>, faults: &mut Vec<Fault>) -> Vec<Choice> {
    let mut all = Vec::new();
    if let Some((key, node)) = root.entry("record")
        && let Some(section) = Section::open(node, "`[record]`", faults)
    {
        match find(Kind::Component, "recorder") {
            Some(part) => {
                let params = section.rest(part, faults);
                all.extend(component(Choice { part, params }, faults));
            }
            None => faults.push(Fault::error(key.span, "this program has no recorder")),
        }
    }
    let Some(list) = root.get("component") else {
        return all;
    };
    let Some(items) = list.as_array() else {
        let message = format!(
            "{} where `[[component]]` entries are wanted",
            list.value.kind()
        );
        faults.push(Fault::error(list.span, message));
        return all;
    };
    for node in items {
        let Some(mut section) = Section::open(node, "a component", faults) else {
            continue;
        };
        let Some(part) = part(&mut section, Kind::Component, faults) else {
            continue;
        };
        let params = section.rest(part, faults);
        all.extend(component(Choice { part, params }, faults));
    }
    all
}

fn component(choice: Choice, faults: &mut Vec<Fault>) -> Option<Choice> {
    if let Make::Component(make) = choice.part.make {
        make(&choice.params)
            .map_err(|found| faults.extend(found))
            .ok()?;
    }
    Some(choice)
}

/// The world: a file or a table; the file of the command line before either.
pub(super) fn world(node: Option<&Node>, cx: &mut Context<'_>) -> Option<World> {
    if let Some(path) = cx.world.clone() {
        return crate::world::load(&path, None, &cx.variables, cx.sources, &mut cx.faults);
    }
    match node {
        None => Some(World::default()),
        Some(Node {
            value: Value::String(name),
            span,
        }) => {
            let path = cx.folder.join(name);
            crate::world::load(
                &path,
                Some(*span),
                &cx.variables,
                cx.sources,
                &mut cx.faults,
            )
        }
        Some(node) if node.as_table().is_some() => {
            let folder = cx.folder.clone();
            crate::world::check(node, &folder, &mut cx.faults)
        }
        Some(node) => {
            let message = format!("{} where a world is wanted", node.value.kind());
            let help = "the name of a world file, or a table [world]";
            cx.faults.push(Fault::error(node.span, message).help(help));
            None
        }
    }
}

/// A part in the place of a value: its name, or a table with `use` and its parameters.
pub(crate) fn choice(node: &Node, kind: Kind, faults: &mut Vec<Fault>) -> Option<Choice> {
    match &node.value {
        Value::String(_) => {
            let part = named(node, kind, faults)?;
            Some(Choice {
                part,
                params: empty(node.span),
            })
        }
        _ => {
            let mut section = Section::open(node, &format!("a {}", kind.name()), faults)?;
            let part = part(&mut section, kind, faults)?;
            let params = section.rest(part, faults);
            Some(Choice { part, params })
        }
    }
}

/// A table without entries, for a part whose parameters nobody sets.
pub(super) fn empty(span: Span) -> Node {
    Node::new(span, Value::Table(Table::default()))
}

//! What is one for all models: channel, weather, world, components.

use super::section::Section;
use super::{Choice, Context, named, part};
use serde::Deserialize;
use simbeeotic_model::config::{Fault, Node, Span, Table, Value};
use simbeeotic_model::radio::{Composite, FreeSpace, Medium, Propagation, Remark};
use simbeeotic_model::registry::{Kind, Make, Site, find};
use simbeeotic_model::{Air, MadeAir, NoiseFloor, ShadowingParams};
use simbeeotic_units::{Decibels, Length, PowerLevel};
use simbeeotic_world::World;
use std::sync::Arc;

/// The air that radios share.
#[derive(Clone)]
pub struct Channel {
    /// How faithfully it is simulated.
    pub medium: Choice,
    /// What distance does; `None`: free space.
    pub propagation: Option<Choice>,
    /// What places do besides.
    pub shadowing: Option<ShadowingParams>,
    /// What echoes do besides.
    pub fading: Option<Choice>,
    /// Frames reach no further than this.
    pub range_limit: Option<Length>,
    /// The noise at every receiver.
    pub noise_floor: Option<NoiseFloor>,
    /// Whether walls and bodies in the line of sight take their share.
    pub walls: bool,
}

/// The level of fidelity of a channel that names none.
const DEFAULT_MEDIUM: &str = "simple";

impl Channel {
    /// A medium for one run; `None`: no packet goes anywhere.
    ///
    /// # Errors
    /// Settings that a part refuses.
    pub(crate) fn medium(&self, site: &Site<'_>) -> Result<Option<Box<dyn Medium>>, Vec<Fault>> {
        Ok(self.air(site)?.medium)
    }

    /// The same, with what it leaves aside.
    fn air(&self, site: &Site<'_>) -> Result<MadeAir, Vec<Fault>> {
        let propagation = self.propagation(site)?;
        let air = Air {
            seed: site.seed,
            propagation,
            range_limit: self.range_limit,
            noise_floor: self.noise_floor,
            walls: self.walls,
        };
        match self.medium.part.make {
            Make::Medium(make) => make(&self.medium.params, &air),
            _ => Ok(MadeAir {
                medium: None,
                aside: Vec::new(),
            }),
        }
    }

    /// What the propagation finds odd beside the radios whose paths these are.
    pub(super) fn remarks(
        &self,
        at: Span,
        site: &Site<'_>,
        radios: &mut dyn Iterator<Item = String>,
    ) -> Vec<Fault> {
        let Ok(propagation) = self.propagation(site) else {
            return Vec::new();
        };
        let params = self.propagation.as_ref().and_then(|c| c.params.as_table());
        let fault = |remark: Remark| {
            let span = params
                .and_then(|table| table.get(remark.key))
                .map_or(at, |node| node.span);
            let message = format!("`{}` {}", remark.key, remark.message);
            match remark.fatal {
                true => Fault::error(span, message),
                false => Fault::warning(span, message),
            }
        };
        let remarks = propagation.remarks(radios).into_iter();
        remarks.map(fault).collect()
    }

    fn propagation(&self, site: &Site<'_>) -> Result<Arc<dyn Propagation>, Vec<Fault>> {
        let path: Arc<dyn Propagation> = match self.propagation.as_ref() {
            Some(Choice { part, params }) => match part.make {
                Make::Propagation(make) => make(params, site)?,
                _ => Arc::new(FreeSpace),
            },
            None => Arc::new(FreeSpace),
        };
        let shadowing = self
            .shadowing
            .as_ref()
            .map(|params| params.shadowing(site.seed));
        let fading = match self.fading.as_ref() {
            Some(Choice { part, params }) => match part.make {
                Make::Fading(make) => Some(make(params)?),
                _ => None,
            },
            None => None,
        };
        if shadowing.is_none() && fading.is_none() {
            return Ok(path);
        }
        Ok(Arc::new(Composite {
            path,
            shadowing,
            fading,
        }))
    }
}

/// `noise_floor`, as it is written.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Noise {
    mean: PowerLevel,
    sigma: Decibels,
}

impl Default for Noise {
    /// The original's.
    fn default() -> Self {
        Self {
            mean: PowerLevel::from_dbm(-100.0),
            sigma: Decibels::from_db(10.0),
        }
    }
}

pub(super) fn channel(node: &Node, cx: &mut Context<'_>) -> Option<Channel> {
    let faults = &mut cx.faults;
    let before = faults.len();
    let mut section =
        Section::open_part(node, "`[channel]`", ("channel", Kind::Propagation), faults)?;
    let propagation = section
        .get("use")
        .map(|node| named(node, Kind::Propagation, faults));
    let medium = match section.get("medium") {
        Some(node) => choice(node, Kind::Medium, faults),
        None => find(Kind::Medium, DEFAULT_MEDIUM).map(|part| Choice {
            part,
            params: empty(node.span),
        }),
    };
    let noise_floor = noise_floor(&mut section, faults);
    let range_limit = range_limit(&mut section, faults);
    let walls = section.read("walls", faults).unwrap_or_default();
    let shadowing = section.get("shadowing").and_then(|node| {
        let read = ShadowingParams::read(node);
        read.map_err(|found| faults.extend(found)).ok()
    });
    let fading = section
        .get("fading")
        .and_then(|node| choice(node, Kind::Fading, faults));
    let propagation = match propagation {
        Some(part) => {
            let part = part?;
            let params = section.rest(part, faults);
            Some(Choice { part, params })
        }
        None => {
            section.finish(faults);
            None
        }
    };
    let channel = Channel {
        medium: medium?,
        propagation,
        shadowing,
        fading,
        range_limit,
        noise_floor,
        walls,
    };
    if faults.len() == before {
        // Whether it can be made does not hang on chance.
        let site = Site {
            seed: 0,
            folder: &cx.folder,
        };
        let made = channel
            .air(&site)
            .map_err(|found| faults.extend(found))
            .ok()?;
        for aside in made.aside {
            let key = node.as_table().and_then(|t| t.entry(aside.key));
            if let Some((key, value)) = key
                && !matches!(value.value, Value::Bool(false))
            {
                let message = format!("`{}` {}", aside.key, aside.message);
                faults.push(Fault::warning(key.span, message));
            }
        }
    }
    Some(channel)
}

fn noise_floor(section: &mut Section<'_>, faults: &mut Vec<Fault>) -> Option<NoiseFloor> {
    let Noise { mean, sigma } = section.read("noise_floor", faults)?;
    let span = section.get("noise_floor")?.span;
    if !(-200.0..30.0).contains(&mean.dbm()) {
        let message = format!("noise floor of {mean}: expected from -200 dBm to 30 dBm");
        faults.push(Fault::error(span, message));
    }
    if !(0.0..=100.0).contains(&sigma.db()) {
        let message = format!("noise sigma of {sigma}: expected from 0 dB to 100 dB");
        faults.push(Fault::error(span, message));
    }
    Some(NoiseFloor { mean, sigma })
}

fn range_limit(section: &mut Section<'_>, faults: &mut Vec<Fault>) -> Option<Length> {
    let range: Length = section.read("range_limit", faults)?;
    if range.metres().is_nan() || range <= Length::ZERO {
        let span = section.get("range_limit")?.span;
        let message = format!("range limit of {range}: expected more than 0 m");
        faults.push(Fault::error(span, message));
    }
    Some(range)
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

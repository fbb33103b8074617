//! `[[model]]`: the models, entry by entry, and each of them with its path and its start.

use super::gear::{gear, good_name};
use super::section::{Section, read};
use super::shared::{choice, empty};
use super::start::Start;
use super::{Choice, Context, default_vehicle, part};
use crate::limit::{MODEL_BYTES, MODELS_MANY, MODELS_MAX};
use simbeeotic_model::config::{Fault, Node, Sources, Span, Value};
use simbeeotic_model::instance::GearPlan;
use simbeeotic_model::registry::{Kind, Make, ModelFactory, Part, VehicleFactory};
use simbeeotic_model::{ModelPlan, PlannedPart};
use simbeeotic_units::Pose;
use std::collections::BTreeMap;
use std::sync::Arc;

/// One `[[model]]` entry: any number of models of one kind, each with the models nested in it.
pub struct Group {
    /// What they are called: `bee`, or `bee-0`, `bee-1`, ... if there are several.
    pub name: String,
    /// How many there are.
    pub count: u64,
    /// The part they are made from.
    pub part: &'static Part,
    /// The entries nested in each of them.
    pub nested: Vec<Group>,
    numbered: bool,
    factory: Arc<dyn ModelFactory>,
    vehicle: Option<Arc<dyn VehicleFactory>>,
    gear: Arc<GearPlan>,
    start: Option<Start>,
    /// Where the name comes from.
    span: Span,
}

/// Reads the entries of a list `[[model]]`.
pub(super) fn groups(node: &Node, cx: &mut Context<'_>) -> Vec<Group> {
    let Some(items) = node.as_array() else {
        let fault = Fault::error(node.span, "a model stands in double brackets: `[[model]]`");
        cx.faults.push(fault);
        return Vec::new();
    };
    items.iter().filter_map(|node| group(node, cx)).collect()
}

fn group(node: &Node, cx: &mut Context<'_>) -> Option<Group> {
    let mut section = Section::open(node, "a model", &mut cx.faults)?;
    let part = part(&mut section, Kind::Model, &mut cx.faults);
    let use_span = section.get("use").map_or(node.span, |n| n.span);
    // What it is like was put into it already.
    section.get(crate::like::KEY);
    let name = section.get("name");
    let text = name.and_then(|node| read::<String>(node, &mut cx.faults));
    if let (Some(node), Some(text)) = (name, &text)
        && !good_name(text)
    {
        let fault = Fault::error(node.span, format!("`{text}` is no name for a model"));
        cx.faults
            .push(fault.help("paths are made of names with `/` between them"));
    }
    let start = section
        .get("start")
        .map(|node| (node.span, Start::read(node, cx)));
    let count = count(&mut section, start.as_ref(), cx);
    let params = section
        .get("params")
        .cloned()
        .unwrap_or_else(|| empty(use_span));
    let factory = part.and_then(|part| model_factory(part, &params, &mut cx.faults));
    let vehicle = section.entry("vehicle").map(|(key, node)| {
        let choice = vehicle_choice(node, &mut cx.faults);
        (
            key.span,
            choice.and_then(|c| vehicle_factory(c, &mut cx.faults)),
        )
    });
    let mut gear = gear(&mut section, cx);
    let nested = section
        .get("model")
        .map(|node| groups(node, cx))
        .unwrap_or_default();
    section.finish(&mut cx.faults);
    let (part, factory) = (part?, factory?);
    let vehicle = flying(part, factory.as_ref(), vehicle, use_span, &mut cx.faults)?;
    let (count, numbered) = count?;
    let mut parts = vec![PlannedPart::new("model", part, &params)];
    let vehicle = vehicle.map(|(choice, factory)| {
        parts.push(PlannedPart::new("vehicle", choice.part, &choice.params));
        factory
    });
    parts.append(&mut gear.parts);
    gear.parts = parts;
    Some(Group {
        name: text.unwrap_or_else(|| part.label.name.to_owned()),
        count,
        part,
        nested,
        numbered,
        factory,
        vehicle,
        gear: Arc::new(gear),
        start: start.and_then(|(_, start)| start),
        span: name.map_or(use_span, |n| n.span),
    })
}

/// How many models there are, and whether their names carry numbers.
fn count(
    section: &mut Section<'_>,
    start: Option<&(Span, Option<Start>)>,
    cx: &mut Context<'_>,
) -> Option<(u64, bool)> {
    let places = start.and_then(|(_, start)| start.as_ref()?.places());
    let Some(node) = section.get("count") else {
        let count = places.unwrap_or(1);
        return Some((count, count != 1));
    };
    let count: u64 = match node.value {
        Value::Integer(number) if number < 0 => {
            cx.faults
                .push(Fault::error(node.span, "a count is not negative"));
            return None;
        }
        _ => read(node, &mut cx.faults)?,
    };
    if count > MODELS_MAX {
        cx.faults.push(too_many(count, node.span));
        return None;
    }
    if let (Some(places), Some((span, _))) = (places, start)
        && count > places
    {
        let message = format!("there are {places} places to start from for {count} models");
        cx.faults.push(Fault::error(*span, message));
        return None;
    }
    Some((count, count != 1))
}

fn model_factory(
    part: &Part,
    params: &Node,
    faults: &mut Vec<Fault>,
) -> Option<Arc<dyn ModelFactory>> {
    let Make::Model(make) = part.make else {
        return None;
    };
    if params.as_table().is_none() {
        let message = format!(
            "{} where a table `[model.params]` is wanted",
            params.value.kind()
        );
        faults.push(Fault::error(params.span, message));
        return None;
    }
    make(params).map_err(|found| faults.extend(found)).ok()
}

/// A vehicle by its name or as a table; without `use`, the parameters are those of the usual one.
fn vehicle_choice(node: &Node, faults: &mut Vec<Fault>) -> Option<Choice> {
    let nameless = node
        .as_table()
        .is_some_and(|table| table.get("use").is_none());
    match (nameless, default_vehicle()) {
        (true, Some(part)) => {
            let section = Section::open(node, "a vehicle", faults)?;
            let params = section.rest(part, faults);
            Some(Choice { part, params })
        }
        _ => choice(node, Kind::Vehicle, faults),
    }
}

/// A vehicle that was chosen, and what makes it.
type Flown = (Choice, Arc<dyn VehicleFactory>);

fn vehicle_factory(choice: Choice, faults: &mut Vec<Fault>) -> Option<Flown> {
    let Make::Vehicle(make) = choice.part.make else {
        return None;
    };
    let factory = make(&choice.params)
        .map_err(|found| faults.extend(found))
        .ok()?;
    Some((choice, factory))
}

/// The vehicle that the model flies, if it flies: the one named, or the usual one.
fn flying(
    part: &Part,
    factory: &dyn ModelFactory,
    named: Option<(Span, Option<Flown>)>,
    at: Span,
    faults: &mut Vec<Fault>,
) -> Option<Option<Flown>> {
    match (factory.flies(), named) {
        (true, Some((_, flown))) => flown.map(Some),
        (false, None) => Some(None),
        (false, Some((span, _))) => {
            let message = format!(
                "`{}` does not fly and has no use for a vehicle",
                part.label.name
            );
            faults.push(Fault::error(span, message));
            None
        }
        (true, None) => {
            let Some(usual) = default_vehicle() else {
                let message = format!("`{}` flies, and needs a `vehicle`", part.label.name);
                faults.push(Fault::error(at, message));
                return None;
            };
            let choice = Choice {
                part: usual,
                params: empty(at),
            };
            vehicle_factory(choice, faults).map(Some)
        }
    }
}

/// Checks what concerns several entries: names that occur twice, too many models, radios without a
/// channel.
pub(super) fn check_all(groups: &[Group], root: &Node, has_channel: bool, cx: &mut Context<'_>) {
    let total = total(groups);
    let span = root
        .as_table()
        .and_then(|t| t.get("model"))
        .map_or(root.span, |n| n.span);
    if total > MODELS_MAX {
        cx.faults.push(too_many(total, span));
        return;
    }
    if total > MODELS_MANY {
        let message = format!("{total} models take about {} of memory", memory(total));
        cx.faults.push(Fault::warning(span, message));
    }
    check_names(groups, cx);
    if !has_channel && let Some(group) = with_radio(groups) {
        let message = "its radio is heard by nobody: there is no `[channel]`";
        let fault = Fault::warning(group.span, message);
        cx.faults
            .push(fault.help("add: [channel]  use = \"free-space\""));
    }
}

fn too_many(count: u64, span: Span) -> Fault {
    let message = format!("{count} models, nested ones counted, are more than {MODELS_MAX}");
    let help = format!(
        "a model takes about {:.1} kB: these would take {}",
        MODEL_BYTES as f64 / 1e3,
        memory(count)
    );
    Fault::error(span, message).help(help)
}

/// How much memory so many models take.
fn memory(count: u64) -> String {
    let gigabytes = count as f64 * MODEL_BYTES as f64 / 1e9;
    format!("{gigabytes:.1} GB")
}

/// How many models the entries make, nested ones included.
fn total(groups: &[Group]) -> u64 {
    let each = |g: &Group| g.count.saturating_mul(total(&g.nested).saturating_add(1));
    groups.iter().map(each).fold(0, u64::saturating_add)
}

fn with_radio(groups: &[Group]) -> Option<&Group> {
    groups.iter().find_map(|g| {
        if g.gear.radios.is_empty() {
            with_radio(&g.nested)
        } else {
            Some(g)
        }
    })
}

/// Finds entries whose models would have the same path. Works on entries, not on models: there may be
/// millions of those.
fn check_names(groups: &[Group], cx: &mut Context<'_>) {
    let mut plain: BTreeMap<&str, &Group> = BTreeMap::new();
    let mut numbered: BTreeMap<&str, &Group> = BTreeMap::new();
    let mut by_stem: BTreeMap<&str, Vec<(u64, &Group)>> = BTreeMap::new();
    for group in groups {
        check_names(&group.nested, cx);
        let name = group.name.as_str();
        let clash = if group.numbered {
            let singles = by_stem.get(name).into_iter().flatten();
            let single = singles
                .filter(|(number, _)| *number < group.count)
                .min_by_key(|s| s.0);
            match numbered.get(name) {
                Some(other) if other.count > 0 && group.count > 0 => Some((0, *other)),
                _ => single.copied(),
            }
            .map(|(number, other)| (format!("{name}-{number}"), other))
        } else {
            let series = stem(name)
                .and_then(|(stem, number)| numbered.get(stem).filter(|other| number < other.count));
            plain
                .get(name)
                .or(series)
                .map(|other| (name.to_owned(), *other))
        };
        if let Some((name, other)) = clash {
            cx.faults
                .push(second(&name, group.span, other.span, cx.sources));
        }
        if group.numbered {
            numbered.insert(name, group);
        } else {
            plain.insert(name, group);
            if let Some((stem, number)) = stem(name) {
                by_stem.entry(stem).or_default().push((number, group));
            }
        }
    }
}

/// `bee` and 17 of `bee-17`, if a numbered model may be called so.
fn stem(name: &str) -> Option<(&str, u64)> {
    let (stem, digits) = name.rsplit_once('-')?;
    let number: u64 = digits.parse().ok()?;
    (number.to_string() == digits).then_some((stem, number))
}

fn second(name: &str, here: Span, there: Span, sources: &Sources) -> Fault {
    let place = match sources.get(there.source) {
        Some(source) => {
            let (line, column) = source.line_column(there.start);
            format!("at {}:{line}:{column}", source.name)
        }
        None => "elsewhere".to_owned(),
    };
    let help = format!("the other one is {place}; give one of them another `name`");
    Fault::error(here, format!("a second model called `{name}`")).help(help)
}

impl Group {
    /// What model number `index` is called.
    fn name_of(&self, index: u64) -> String {
        if self.numbered {
            format!("{}-{index}", self.name)
        } else {
            self.name.clone()
        }
    }
}

/// Every model of the entries, parents before the models nested in them.
pub(crate) fn models(groups: &[Group], seed: u64) -> Vec<ModelPlan> {
    let mut all = Vec::with_capacity(usize::try_from(total(groups)).unwrap_or(0));
    add(groups, seed, None, &mut all);
    all
}

/// The path of every radio: that of its model and its own name.
pub(super) fn radio_paths(groups: &[Group]) -> Vec<String> {
    fn add(groups: &[Group], parent: &str, all: &mut Vec<String>) {
        for group in groups {
            for index in 0..group.count {
                let path = format!("{parent}{}/", group.name_of(index));
                let radios = group.gear.radios.iter();
                all.extend(radios.map(|radio| format!("{path}{}", radio.name)));
                add(&group.nested, &path, all);
            }
        }
    }
    let mut all = Vec::new();
    add(groups, "", &mut all);
    all
}

fn add(groups: &[Group], seed: u64, parent: Option<usize>, all: &mut Vec<ModelPlan>) {
    for group in groups {
        for index in 0..group.count {
            let name = group.name_of(index);
            let (path, inherited) = match parent.and_then(|at| all.get(at)) {
                Some(parent) => (format!("{}/{name}", parent.path), parent.start),
                None => (name, Pose::IDENTITY),
            };
            let start = match &group.start {
                Some(start) => start.pose(seed, &path, index),
                None => inherited,
            };
            let at = all.len();
            all.push(ModelPlan {
                path,
                kind: group.part.label.name,
                factory: Arc::clone(&group.factory),
                vehicle: group.vehicle.clone(),
                gear: Arc::clone(&group.gear),
                start,
                parent,
            });
            add(&group.nested, seed, Some(at), all);
        }
    }
}

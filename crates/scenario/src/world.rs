//! World files, TOML or the original's XML, to a checked [`World`].

use crate::plan::folder_of;
use crate::variables::Variables;
use crate::xml::{self, Document};
use serde::de::DeserializeOwned;
use simbeeotic_model::config::{
    Fault, Key, Level, Node, SourceId, Sources, Span, Table, Value, read_params,
};
use simbeeotic_model::objects;
use simbeeotic_units::did_you_mean;
use simbeeotic_world::{
    Light, Material, Obstacle, ObstacleShape, Patch, Person, Place, Solid, Source, Spawn,
    Structure, World, WorldError,
};
use std::path::Path;

/// Reads a world file. `asked` is where a scenario names it.
pub(crate) fn load(
    path: &Path,
    asked: Option<Span>,
    given: &Variables,
    sources: &mut Sources,
    faults: &mut Vec<Fault>,
) -> Option<World> {
    let (source, text) = crate::load::read_text(path, asked, sources, faults)?;
    let node = tree(&text, source, given, faults)?;
    check(&node, &folder_of(path), faults)
}

/// The tree of a world file, in the shape of its TOML, its placeholders replaced.
pub(crate) fn tree(
    text: &str,
    source: SourceId,
    given: &Variables,
    faults: &mut Vec<Fault>,
) -> Option<Node> {
    if let Some(fault) = crate::load::empty(text, source) {
        faults.push(fault);
        return None;
    }
    let read = if xml::looks_like_xml(text) {
        xml::parse(text, source, Document::World, &mut given.clone())
    } else {
        crate::toml::parse(text, source).map(|mut node| {
            let mut found = Vec::new();
            given.apply(&mut node, &mut found);
            (node, found)
        })
    };
    match read {
        Ok((node, warnings)) => {
            faults.extend(warnings);
            Some(node)
        }
        Err(found) => {
            faults.extend(found);
            None
        }
    }
}

/// Whether a tree is that of a world, not of a scenario: it has keys of a world, and neither a run nor
/// a model.
pub(crate) fn is_world(root: &Node) -> bool {
    let known = keys();
    let has = |key: &str| known.iter().any(|known| known == key);
    root.as_table().is_some_and(|table| {
        table.keys().any(has) && ["run", "model"].iter().all(|key| table.get(key).is_none())
    })
}

/// The keys of a world file.
fn keys() -> Vec<String> {
    let schema = schemars::schema_for!(World);
    let known = schema.get("properties").and_then(|p| p.as_object());
    let known = known.into_iter().flat_map(|known| known.keys().cloned());
    known
        .chain([crate::generate::GENERATE.to_owned()])
        .collect()
}

/// The faults of a tree that is neither a world nor a scenario: no key of it is one of either.
pub(crate) fn neither(root: &Node) -> Vec<Fault> {
    // Most files are a scenario; then there is no need of all its keys.
    let is_scenario = |table: &Table| table.get("run").is_some() || table.get("model").is_some();
    let Some(table) = root.as_table().filter(|table| !is_scenario(table)) else {
        return Vec::new();
    };
    let schema = crate::schema::schema();
    let of_scenario = schema.get("properties").and_then(|p| p.as_object());
    let of_scenario = of_scenario.into_iter().flat_map(|known| known.keys());
    let of_scenario: Vec<&str> = of_scenario.map(String::as_str).collect();
    let of_world = keys();
    let of_world: Vec<&str> = of_world.iter().map(String::as_str).collect();
    let known = |key: &str| of_world.contains(&key) || of_scenario.contains(&key);
    if table.keys().any(known) {
        return Vec::new();
    }
    let fault = |(key, _): &(Key, Node)| {
        let guess =
            |known: &[&str]| did_you_mean(&key.text, known.iter().copied()).map(str::to_owned);
        let said = |of: &str, known: &[&str]| match guess(known) {
            Some(guess) => format!("in a {of}, did you mean `{guess}`?"),
            None => format!("a {of} has `{}`", known.join("`, `")),
        };
        let message = format!(
            "unknown key `{}`: neither a world nor a scenario has it",
            key.text
        );
        let (world, scenario) = (said("world", &of_world), said("scenario", &of_scenario));
        let help = match (guess(&of_world), guess(&of_scenario)) {
            (Some(_), None) => world,
            (None, Some(_)) => scenario,
            _ => format!("{world}; {scenario}"),
        };
        Fault::error(key.span, message).help(help)
    };
    table.entries.iter().map(fault).collect()
}

/// The world in a tree, if everything in it can be. Files that it names are looked for in `folder`.
pub(crate) fn check(node: &Node, folder: &Path, faults: &mut Vec<Fault>) -> Option<World> {
    let node = &*crate::generate::expand(node, faults)?;
    let mut world: World = match read_params(node) {
        Ok(world) => world,
        Err(_) => {
            faults.extend(all_faults(node).into_iter().map(in_short_too));
            return None;
        }
    };
    let files = crate::files::fill(&mut world, folder);
    let errors = files.errors.into_iter().chain(world.check());
    let errors: Vec<Fault> = errors.map(|e| fault(node, Level::Error, e)).collect();
    let sound = errors.is_empty();
    faults.extend(errors);
    let warnings = files.warnings.into_iter();
    faults.extend(warnings.map(|e| fault(node, Level::Warning, e)));
    if !sound {
        return None;
    }
    let before = faults.len();
    faults.extend(not_solid(&world, node));
    (faults.len() == before).then_some(world)
}

/// What is wrong with a world, at its place in the file.
fn fault(node: &Node, level: Level, error: WorldError) -> Fault {
    Fault {
        level,
        span: Some(place(node, &error.path)),
        message: error.message,
        help: error.help,
    }
}

/// What physics refuses of shapes that are made of points: a hull without volume, a mesh without
/// area.
fn not_solid(world: &World, node: &Node) -> Vec<Fault> {
    let refused = |path: String, solid: &Solid| {
        let error = objects::check(solid).err()?;
        Some(Fault::error(place(node, &path), error.to_string()))
    };
    let mut faults = Vec::new();
    for (i, obstacle) in world.obstacles.iter().enumerate() {
        let several = matches!(obstacle.shape, ObstacleShape::Parts(_));
        for (part, solid) in obstacle.solids().iter().enumerate() {
            let path = match several {
                true => format!("obstacle.{i}.shape.parts.{part}.shape"),
                false => format!("obstacle.{i}.shape"),
            };
            faults.extend(refused(path, solid));
        }
    }
    if let Some(terrain) = &world.terrain {
        faults.extend(refused("terrain.height_field".into(), &terrain.solid()));
    }
    faults
}

/// Finds the faults of one object.
type Look = fn(&Node) -> Vec<Fault>;

/// Every fault of a world that cannot be read: those of each object, and those of the rest.
fn all_faults(node: &Node) -> Vec<Fault> {
    let mut faults = Vec::new();
    let mut rest = node.clone();
    if let Some(table) = rest.as_table_mut() {
        let lists: [(&str, Look); 9] = [
            ("obstacle", faults_of::<Obstacle>),
            ("structure", faults_of::<Structure>),
            ("patch", faults_of::<Patch>),
            ("person", faults_of::<Person>),
            ("material", faults_of::<Material>),
            ("spawn", faults_of::<Spawn>),
            ("place", faults_of::<Place>),
            ("light", faults_of::<Light>),
            ("source", faults_of::<Source>),
        ];
        for (key, look) in lists {
            if table.get(key).and_then(Node::as_array).is_some()
                && let Some(list) = table.remove(key)
            {
                faults.extend(list.as_array().into_iter().flatten().flat_map(look));
            }
        }
    }
    faults.extend(faults_of::<World>(&rest));
    faults
}

/// A list of one may be written in short. Whoever writes both is told so.
fn in_short_too(mut fault: Fault) -> Fault {
    for (one, many) in [("door", "doors"), ("window", "windows"), ("trap", "traps")] {
        if fault.message == format!("duplicate field `{many}`") {
            fault.message = format!("`{one}` and `{many}` say the same: one will do");
        }
    }
    fault
}

fn faults_of<T: DeserializeOwned>(node: &Node) -> Vec<Fault> {
    read_params::<T>(node).err().unwrap_or_default()
}

/// The place of a path of keys and indices: of the deepest part of it that was written.
///
/// A list of one may have been written in short: `door = { ... }` for `doors = [{ ... }]`.
fn place(node: &Node, path: &str) -> Span {
    let mut here = node;
    let mut in_short = false;
    for key in path.split('.') {
        if std::mem::take(&mut in_short) {
            continue;
        }
        let next = match &here.value {
            Value::Table(table) => table.get(key).or_else(|| {
                let one = table.get(key.strip_suffix('s')?)?;
                in_short = one.as_table().is_some();
                Some(one)
            }),
            Value::Array(items) => key.parse().ok().and_then(|at: usize| items.get(at)),
            _ => None,
        };
        match next {
            Some(next) => here = next,
            None => break,
        }
    }
    here.span
}

//! World files, TOML or the original's XML, to a checked [`World`].

use crate::xml::{self, Document};
use simbeeotic_model::config::{Fault, Node, SourceId, Sources, Span, Value, read_params};
use simbeeotic_world::World;
use std::path::Path;

/// Reads a world file. `asked` is where a scenario names it.
pub(crate) fn load(
    path: &Path,
    asked: Option<Span>,
    sources: &mut Sources,
    faults: &mut Vec<Fault>,
) -> Option<World> {
    let (source, text) = crate::load::read_text(path, asked, sources, faults)?;
    let node = tree(&text, source, faults)?;
    check(&node, faults)
}

/// The tree of a world file, in the shape of its TOML.
pub(crate) fn tree(text: &str, source: SourceId, faults: &mut Vec<Fault>) -> Option<Node> {
    let read = if xml::looks_like_xml(text) {
        xml::parse(text, source, Document::World)
    } else {
        crate::toml::parse(text, source).map(|node| (node, Vec::new()))
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

/// The world in a tree, if everything in it can be.
pub(crate) fn check(node: &Node, faults: &mut Vec<Fault>) -> Option<World> {
    let world: World = match read_params(node) {
        Ok(world) => world,
        Err(found) => {
            faults.extend(found);
            return None;
        }
    };
    let errors = world.check();
    let sound = errors.is_empty();
    faults.extend(
        errors
            .into_iter()
            .map(|e| Fault::error(place(node, &e.path), e.message)),
    );
    sound.then_some(world)
}

/// The place of a path of keys and indices: of the deepest part of it that was written.
fn place(node: &Node, path: &str) -> Span {
    let mut here = node;
    for key in path.split('.') {
        let next = match &here.value {
            Value::Table(table) => table.get(key),
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

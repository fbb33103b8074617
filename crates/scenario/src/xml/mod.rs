//! The original's XML files, scenario and world, as the trees that TOML files of the same meaning
//! have.
//!
//! Every node of the tree points at the XML that it came from, so that a fault found late shows
//! the user's own line. What the original ignored in silence (a misspelt property, say) is a
//! warning with a guess; a wrong value is an error. Where the original did something wrong that is
//! right here, a note says so, once a file.
//!
//! Reading order: `tree` (elements and their places), `read` (what each translation does),
//! `variables` and `java` (placeholders), `classes` (the table of classes and properties), `part` (a
//! class as a part), `scenario`, `world`.

mod classes;
mod java;
mod part;
mod read;
mod scenario;
mod tree;
mod variables;
mod world;

use crate::variables::Variables;
use simbeeotic_model::config::{Fault, Node, SourceId};

/// What an XML document is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Document {
    /// A scenario: `<scenario>`.
    Scenario,
    /// A world: `<world>`.
    World,
}

/// Whether a text looks like XML: its first letter is `<`.
pub fn looks_like_xml(text: &str) -> bool {
    text.trim_start_matches('\u{feff}')
        .trim_start()
        .starts_with('<')
}

/// What the outermost element is called, if the text is well-formed.
pub fn root_name(text: &str, source: SourceId) -> Option<String> {
    tree::parse(text, source).ok().map(|root| root.name.text)
}

/// Reads a document as a tree like that of a TOML file of the same meaning. Warnings and notes come
/// with it. A scenario fills in the `variables` that a world is read with.
///
/// # Errors
/// Everything that is wrong with it.
pub fn parse(
    text: &str,
    source: SourceId,
    wanted: Document,
    given: &mut Variables,
) -> Result<(Node, Vec<Fault>), Vec<Fault>> {
    let root = tree::parse(text, source)?;
    let (node, mut faults) = match (root.name.text.as_str(), wanted) {
        ("scenario", Document::Scenario) => scenario::scenario(&root, given),
        ("world", Document::World) => world::world(&root, given),
        ("world", Document::Scenario) => {
            return Err(vec![crate::load::world_where_scenario(root.name.span)]);
        }
        (other, Document::Scenario) => {
            let message = format!("a scenario begins with `<scenario>`, not with `<{other}>`");
            return Err(vec![Fault::error(root.name.span, message)]);
        }
        (other, Document::World) => {
            let message = format!("a world begins with `<world>`, not with `<{other}>`");
            return Err(vec![Fault::error(root.name.span, message)]);
        }
    };
    faults.sort_by_key(|f| f.span);
    if faults.iter().any(Fault::is_error) {
        Err(faults)
    } else {
        Ok((node, faults))
    }
}

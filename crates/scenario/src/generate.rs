//! A world made by rule, where a world stands: `generate = { use = "maze", seed = 3 }`.
//!
//! What stands beside the key `generate` comes on top: lists (`[[obstacle]]`) follow those of the
//! generated world, other keys (`radius`, `[ground]`) replace them.

use crate::plan::{Choice, choice};
use simbeeotic_model::config::{Fault, Node, Sources, Span, Table, Value, to_node};
use simbeeotic_model::registry::{Kind, Make, Part, find_node};
use simbeeotic_world::World;
use std::borrow::Cow;

/// The key of a world that is made by rule.
pub(crate) const GENERATE: &str = "generate";

/// The tree of a world without the key `generate`: what that key makes, and what stands beside it.
/// `None` if it makes nothing; the faults say why.
pub(crate) fn expand<'n>(node: &'n Node, faults: &mut Vec<Fault>) -> Option<Cow<'n, Node>> {
    let Some((table, rule)) = node
        .as_table()
        .and_then(|table| Some((table, table.get(GENERATE)?)))
    else {
        return Some(Cow::Borrowed(node));
    };
    let before = faults.len();
    let Choice { part, params } = choice(rule, Kind::Generator, faults)?;
    if faults[before..].iter().any(Fault::is_error) {
        return None;
    }
    let world = made(part, &params)
        .map_err(|found| faults.extend(found))
        .ok()?;
    let mut tree = sparse(&world);
    tree.span = node.span;
    if let Some(whole) = tree.as_table_mut() {
        for (key, value) in &table.entries {
            match (whole.get_mut(&key.text), &value.value) {
                _ if key.text == GENERATE => {}
                (
                    Some(Node {
                        value: Value::Array(all),
                        ..
                    }),
                    Value::Array(more),
                ) => all.extend(more.iter().cloned()),
                _ => whole.insert(key.clone(), value.clone()),
            }
        }
    }
    Some(Cow::Owned(tree))
}

fn made(part: &Part, params: &Node) -> Result<World, Vec<Fault>> {
    match part.make {
        Make::Generator(make) => make(params),
        _ => Err(vec![Fault::error(
            params.span,
            format!("`{}` makes no worlds", part.label.name),
        )]),
    }
}

/// What the command line asks of a generator.
pub struct Order {
    /// The generator.
    pub part: &'static Part,
    /// Its parameters, as they were given.
    pub params: Node,
}

impl Order {
    /// The generator called `kind` with parameters set by `sets`: `columns=12`, `cell=2 m`.
    ///
    /// # Errors
    /// There is no such generator, or an argument has another form.
    pub fn new(kind: &str, sets: &[String], sources: &mut Sources) -> Result<Self, Vec<Fault>> {
        let part = find_node(Kind::Generator, &Node::string(Span::default(), kind)).map_err(
            // It was written nowhere that can be shown.
            |fault| {
                vec![Fault {
                    span: None,
                    ..fault
                }]
            },
        )?;
        let mut params = Node::table(Span::default());
        let mut faults = Vec::new();
        for argument in sets {
            if let Err(found) = crate::set::apply(&mut params, argument, sources) {
                faults.extend(found);
            }
        }
        if faults.is_empty() {
            Ok(Self { part, params })
        } else {
            Err(faults)
        }
    }

    /// The world, as the text of a world file that reads as the same world.
    ///
    /// # Errors
    /// Parameters that the generator does not have, or out of their range.
    pub fn toml(&self) -> Result<String, Vec<Fault>> {
        Ok(to_toml(&made(self.part, &self.params)?))
    }
}

/// A world as the text of a world file, without what is as it is when left out. Reading the text
/// gives the same world, to the last bit.
pub fn to_toml(world: &World) -> String {
    crate::print::to_toml(&sparse(world))
}

/// A world as a tree, without what is as it is when left out.
fn sparse(world: &World) -> Node {
    let usual = to_node(&World::default());
    let mut node = to_node(world);
    if let Some(table) = node.as_table_mut() {
        drop_usual(table, &usual);
        for (key, value) in &mut table.entries {
            let usual = match key.text.as_str() {
                "obstacle" => to_node(&simbeeotic_world::Obstacle::default()),
                "structure" => to_node(&simbeeotic_world::Structure::default()),
                "person" => to_node(&simbeeotic_world::Person::default()),
                _ => continue,
            };
            if let Value::Array(items) = &mut value.value {
                for item in items.iter_mut().filter_map(Node::as_table_mut) {
                    drop_usual(item, &usual);
                    if let Some(shape) = item.get_mut("shape") {
                        drop_rotations(shape);
                    }
                }
            }
        }
    }
    node
}

/// Takes out entries that are as `usual` has them. Their places are compared too: both have none.
fn drop_usual(table: &mut Table, usual: &Node) {
    let same = |key: &str, node: &Node| usual.as_table().and_then(|u| u.get(key)) == Some(node);
    // A shape is a choice: all of it is written or nothing.
    table.entries.retain(|(key, node)| !same(&key.text, node));
}

/// Takes out the turns of shapes that are not turned.
fn drop_rotations(node: &mut Node) {
    match &mut node.value {
        Value::Table(table) => {
            let none = |node: &Node| node.as_str() == Some("0 rad");
            table
                .entries
                .retain(|(key, node)| key.text != "rotation" || !none(node));
            for (_, node) in &mut table.entries {
                drop_rotations(node);
            }
        }
        Value::Array(items) => items.iter_mut().for_each(drop_rotations),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render;

    fn read(text: &str) -> Result<World, String> {
        let mut sources = Sources::new();
        let id = sources.add("x.toml", text);
        let mut faults = Vec::new();
        let node = crate::toml::parse(text, id).expect("TOML");
        let world = crate::world::check(&node, std::path::Path::new(""), &mut faults);
        world.ok_or_else(|| render::faults(&faults, &sources, false))
    }

    #[test]
    fn a_world_is_generated_where_it_stands_and_more_comes_on_top() {
        let plain = read("generate = { use = \"maze\", columns = 4, seed = 3 }").expect("a maze");
        let more = read(
            "radius = \"1 km\"\ngenerate = { use = \"maze\", columns = 4, seed = 3 }\n\
             [[obstacle]]\nlabel = \"tower\"\n[[person]]\nlabel = \"guard\"\n",
        )
        .expect("a maze with a tower");
        assert!(plain.structures.len() > 10);
        assert!(more.structures == plain.structures);
        assert_eq!(more.obstacles.len(), plain.obstacles.len() + 1);
        assert_eq!(more.obstacles[plain.obstacles.len()].label, "tower");
        assert_eq!(more.people[0].label, "guard");
        assert_eq!(more.radius.get(), 1000.0);
    }

    #[test]
    fn faults_of_a_rule_and_of_what_stands_beside_it_have_their_places() {
        for (text, words) in [
            ("generate = { use = \"maz\" }", "did you mean `maze`?"),
            ("generate = { use = \"compass\" }", "`compass` is a sensor"),
            ("generate = {}", "`use` is missing"),
            ("generate = 3", "a whole number"),
            ("generate = { use = \"maze\", colums = 3 }", "x.toml:1:28"),
            ("generate = { use = \"maze\", columns = 0 }", "x.toml:1:38"),
            ("generate = { use = \"maze\", cell = 2 }", "a bare number"),
            (
                "generate = { use = \"maze\" }\n[[obstacle]]\nlable = \"x\"",
                "x.toml:3:1",
            ),
            (
                "generate = { use = \"maze\" }\n[[obstacle]]\nshape = { sphere = { radius = \"-1 m\" } }",
                "x.toml:3:",
            ),
        ] {
            let error = read(text).map(|_| ()).expect_err(text);
            assert!(error.contains(words), "{text}: {error}");
        }
    }

    #[test]
    fn the_text_of_every_generated_world_reads_as_the_same_world() {
        for part in simbeeotic_model::registry::of_kind(Kind::Generator) {
            let params = Node::table(Span::default());
            let world = made(part, &params).expect("defaults are fine");
            let text = to_toml(&world);
            let again = read(&text).unwrap_or_else(|e| panic!("{}: {e}", part.label.name));
            assert!(again == world, "{}", part.label.name);
            let hash = simbeeotic_world::generate::fingerprint;
            assert_eq!(hash(&again), hash(&world));
            let named = format!("generate = {{ use = \"{}\" }}", part.label.name);
            assert!(read(&named).expect("defaults are fine") == world);
        }
    }
}

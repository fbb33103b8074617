//! The original's world file, element by element.
//!
//! ```text
//! world
//!   radius? properties? (prop @name @value)*
//!   obstacles?  obstacle+   box | cylinder | sphere | cone, color? texture? label? meta?
//!   flowers?    patch+      center, radius, density, color? meta?
//!   people?     person+     color? label? meta? man
//!   structures? structure+  color? texture? meta? wall | surface
//! ```

use super::read::{Translation, put};
use super::tree::{Element, Text};
use super::variables::Variables;
use crate::variables::Variables as Given;
use simbeeotic_model::config::{Fault, Key, Node, Table, Value};
use simbeeotic_world::{Color, Texture};

const HEIGHT: &str = "the original put every obstacle on the ground; here its `z` counts";
const SQUARE: &str = "the original strewed the flowers of a patch over a square; here they stand \
                      inside the circle";
const TRAP: &str = "the original was right for square traps at rotation 0 only; here all are right";

/// Properties of the world map: their names, our keys, whether they are lengths.
const PROPERTIES: [(&str, &str, bool); 5] = [
    ("approximate-patches", "approximate_patches", false),
    ("flower-stem-height", "flower.stem_height", true),
    ("flower-stem-radius", "flower.stem_radius", true),
    ("flower-flora-height", "flower.head_height", true),
    ("flower-flora-radius", "flower.head_radius", true),
];

/// Attributes that are lengths, and our keys for them.
type Sizes = &'static [(&'static str, &'static str)];

const BOX: Sizes = &[
    ("length", "length"),
    ("width", "width"),
    ("height", "height"),
];
const CYLINDER: Sizes = &[("width", "diameter"), ("height", "height")];
const SPHERE: Sizes = &[("radius", "radius")];
const CONE: Sizes = &[("radius", "radius"), ("height", "height")];
const MAN: Sizes = &[("width", "width"), ("height", "height")];
const DOOR: Sizes = &[
    ("doorwidth", "width"),
    ("doorheight", "height"),
    ("doorposition", "position"),
];
const TRAP_SIZES: Sizes = &[
    ("trapX", "x"),
    ("trapY", "y"),
    ("trapLength", "length"),
    ("trapWidth", "width"),
];

/// The tree that a TOML file of the same meaning has.
pub(super) fn world(root: &Element, given: &Given) -> (Node, Vec<Fault>) {
    let mut world = World {
        t: Translation::new(Variables::given(given)),
    };
    let node = world.read(root);
    (node, world.t.faults)
}

struct World {
    t: Translation,
}

impl World {
    fn read(&mut self, root: &Element) -> Node {
        let known = [
            "radius",
            "properties",
            "obstacles",
            "flowers",
            "people",
            "structures",
        ];
        self.t.check(root, &[], &known, &[]);
        let mut table = Table::default();
        if let Some(radius) = root
            .child("radius")
            .filter(|r| !r.text.text.trim().is_empty())
            && let Some(text) = self.t.content(radius)
            && let Some(node) = self.t.quantity(&text, "m")
        {
            put(&mut table, "radius", radius.name.span, node);
        }
        if let Some(properties) = root.child("properties") {
            self.properties(properties, &mut table);
        }
        type Read = fn(&mut World, &Element) -> Option<Node>;
        let groups: [(&str, &str, &str, Read); 4] = [
            ("obstacles", "obstacle", "obstacle", Self::obstacle),
            ("structures", "structure", "structure", Self::structure),
            ("flowers", "patch", "patch", Self::patch),
            ("people", "person", "person", Self::person),
        ];
        for (group, one, key, read) in groups {
            let Some(element) = root.child(group) else {
                continue;
            };
            self.t.check(element, &[], &[], &[one]);
            let all: Vec<Node> = element
                .children(one)
                .filter_map(|e| read(self, e))
                .collect();
            let list = Node::new(element.span, Value::Array(all));
            put(&mut table, key, element.name.span, list);
        }
        Node::new(root.span, Value::Table(table))
    }

    fn properties(&mut self, element: &Element, table: &mut Table) {
        self.t.check(element, &[], &[], &["prop"]);
        for prop in element.children("prop") {
            self.t.check(prop, &["name", "value"], &[], &[]);
            let (name, value) = (
                self.t.required(prop, "name"),
                self.t.required(prop, "value"),
            );
            let (Some(name), Some(value)) = (name, value) else {
                continue;
            };
            match PROPERTIES.iter().find(|p| p.0 == name.text) {
                Some((_, key, true)) => {
                    if let Some(node) = self.t.quantity(&value, "m") {
                        put(table, key, name.span, node);
                    }
                }
                Some((_, key, false)) => {
                    if let Some(flag) = self.t.flag(&value) {
                        put(
                            table,
                            key,
                            name.span,
                            Node::new(value.span, Value::Bool(flag)),
                        );
                    }
                }
                None => {
                    let known: Vec<&str> = PROPERTIES.iter().map(|p| p.0).collect();
                    self.t.unknown(&name, "property", "world", &known);
                }
            }
        }
    }

    /// The one shape in an element, or an error that there is none.
    fn shape<'e>(&mut self, element: &'e Element, shapes: &[&str]) -> Option<&'e Element> {
        let mut all = element
            .children
            .iter()
            .filter(|c| shapes.contains(&c.name.text.as_str()));
        let (first, second) = (all.next(), all.next());
        if let Some(second) = second {
            let message = format!("a second shape: `{}` has one", element.name.text);
            self.t.error(second.name.span, message);
        }
        if first.is_none() {
            let message = format!(
                "`{}` has no shape: one of `{}`",
                element.name.text,
                shapes.join("`, `")
            );
            self.t.error(element.name.span, message);
        }
        first
    }

    fn obstacle(&mut self, element: &Element) -> Option<Node> {
        let shapes = ["box", "cylinder", "sphere", "cone"];
        let known = [
            "box", "cylinder", "sphere", "cone", "color", "texture", "label", "meta",
        ];
        self.t.check(element, &[], &known, &[]);
        let shape = self.shape(element, &shapes)?;
        let (sizes, turns) = match shape.name.text.as_str() {
            "box" => (BOX, true),
            "cylinder" => (CYLINDER, false),
            "sphere" => (SPHERE, false),
            _ => (CONE, false),
        };
        let mut extra: Vec<&str> = Vec::new();
        if turns {
            extra.push("rotation");
        }
        let mut inner = self.sizes(shape, sizes, &extra);
        if turns {
            self.rotation(shape, &mut inner);
        }
        let position = self.position(shape)?;
        if height(&position).is_some_and(|z| z != 0.0) {
            self.t.note_once(position.span, HEIGHT);
        }
        let mut table = Table::default();
        put(&mut table, "position", position.span, position);
        self.put_shape(&mut table, shape, inner);
        self.look(element, &mut table);
        Some(Node::new(element.span, Value::Table(table)))
    }

    fn structure(&mut self, element: &Element) -> Option<Node> {
        self.t.check(
            element,
            &[],
            &["color", "texture", "meta", "wall", "surface"],
            &[],
        );
        let shape = self.shape(element, &["wall", "surface"])?;
        let (flag, hole, sizes) = if shape.name.text == "wall" {
            (
                "door",
                ["doorwidth", "doorheight", "doorposition"].as_slice(),
                DOOR,
            )
        } else {
            (
                "trap",
                ["trapX", "trapY", "trapLength", "trapWidth"].as_slice(),
                TRAP_SIZES,
            )
        };
        let extra: Vec<&str> = ["rotation", flag].iter().chain(hole).copied().collect();
        let mut inner = self.sizes(shape, BOX, &extra);
        self.rotation(shape, &mut inner);
        let open = match self.t.optional(shape, flag) {
            Some(text) => self.t.flag(&text).map(|open| (open, text.span)),
            None => None,
        };
        if let Some((true, span)) = open {
            let opening = self.opening(shape, sizes);
            if flag == "trap" {
                self.t.note_once(span, TRAP);
            }
            put(&mut inner, flag, span, opening);
        }
        let position = self.position(shape)?;
        let mut table = Table::default();
        put(&mut table, "position", position.span, position);
        self.put_shape(&mut table, shape, inner);
        self.look(element, &mut table);
        Some(Node::new(element.span, Value::Table(table)))
    }

    fn opening(&mut self, shape: &Element, sizes: Sizes) -> Node {
        let mut table = Table::default();
        for (name, key) in sizes {
            if let Some(text) = self.t.optional(shape, name)
                && let Some(node) = self.t.quantity(&text, "m")
            {
                put(&mut table, key, text.span, node);
            }
        }
        Node::new(shape.span, Value::Table(table))
    }

    fn patch(&mut self, element: &Element) -> Option<Node> {
        let once = ["center", "radius", "density", "color", "meta"];
        self.t.check(element, &[], &once, &[]);
        let mut table = Table::default();
        match element.child("center") {
            Some(center) => {
                if let Some(node) = self.t.vector(center, "m", false) {
                    put(&mut table, "center", center.name.span, node);
                }
            }
            None => self.t.error(element.name.span, "`patch` has no `center`"),
        }
        for (word, key, unit) in [("radius", "radius", "m"), ("density", "flowers_per_m2", "")] {
            let Some(child) = element.child(word) else {
                self.t
                    .error(element.name.span, format!("`patch` has no `{word}`"));
                continue;
            };
            let Some(text) = self.t.content(child) else {
                continue;
            };
            let node = match unit {
                "" => self
                    .t
                    .number(&text)
                    .map(|n| Node::new(text.span, Value::Float(n))),
                unit => self.t.quantity(&text, unit),
            };
            if let Some(node) = node {
                put(&mut table, key, child.name.span, node);
            }
        }
        self.t.note_once(element.name.span, SQUARE);
        self.look(element, &mut table);
        Some(Node::new(element.span, Value::Table(table)))
    }

    fn person(&mut self, element: &Element) -> Option<Node> {
        self.t
            .check(element, &[], &["color", "label", "meta", "man"], &[]);
        let shape = self.shape(element, &["man"])?;
        let inner = self.sizes_and(shape, MAN, &[], &["position", "meta"]);
        let position = self.position(shape)?;
        let mut table = Table::default();
        put(&mut table, "position", position.span, position);
        self.put_shape(&mut table, shape, inner);
        self.look(element, &mut table);
        // The original's own generator of mines put it there, against its own schema.
        if let Some(meta) = shape.child("meta") {
            let message = "`meta` stands in `person`, not in `man`; it is read here too";
            self.t.warn(meta.name.span, message);
            if table.get("meta").is_none() {
                let words = self.meta(meta);
                put(&mut table, "meta", meta.name.span, words);
            }
        }
        Some(Node::new(element.span, Value::Table(table)))
    }

    /// The attributes of a shape that are lengths.
    fn sizes(&mut self, shape: &Element, sizes: Sizes, extra: &[&str]) -> Table {
        self.sizes_and(shape, sizes, extra, &["position"])
    }

    /// The same for a shape with elements in it, each of them once at most.
    fn sizes_and(&mut self, shape: &Element, sizes: Sizes, extra: &[&str], once: &[&str]) -> Table {
        let known: Vec<&str> = sizes
            .iter()
            .map(|s| s.0)
            .chain(extra.iter().copied())
            .collect();
        self.t.check(shape, &known, once, &[]);
        let mut table = Table::default();
        for (name, key) in sizes {
            if let Some(text) = self.t.optional(shape, name)
                && let Some(node) = self.t.quantity(&text, "m")
            {
                put(&mut table, key, text.span, node);
            }
        }
        table
    }

    fn rotation(&mut self, shape: &Element, table: &mut Table) {
        if let Some(text) = self.t.optional(shape, "rotation")
            && let Some(node) = self.t.quantity(&text, "rad")
        {
            put(table, "rotation", text.span, node);
        }
    }

    fn put_shape(&mut self, table: &mut Table, shape: &Element, inner: Table) {
        let mut outer = Table::default();
        let key = Key {
            text: shape.name.text.clone(),
            span: shape.name.span,
        };
        outer.insert(key, Node::new(shape.span, Value::Table(inner)));
        let node = Node::new(shape.span, Value::Table(outer));
        put(table, "shape", shape.name.span, node);
    }

    fn position(&mut self, shape: &Element) -> Option<Node> {
        match shape.child("position") {
            Some(position) => self.t.vector(position, "m", false),
            None => {
                let message = format!("`{}` has no `position`", shape.name.text);
                self.t.error(shape.name.span, message);
                None
            }
        }
    }

    /// Colour, texture, label and metadata.
    fn look(&mut self, element: &Element, table: &mut Table) {
        if let Some(color) = element.child("color")
            && let Some(node) = self.color(color)
        {
            put(table, "color", color.name.span, node);
        }
        if let Some(texture) = element.child("texture")
            && let Some(node) = self.texture(texture)
        {
            put(table, "texture", texture.name.span, node);
        }
        if let Some(label) = element.child("label") {
            self.t.check(label, &[], &[], &[]);
            let node = Node::string(label.text.span, label.text.text.trim());
            put(table, "label", label.name.span, node);
        }
        if let Some(meta) = element.child("meta") {
            let words = self.meta(meta);
            put(table, "meta", meta.name.span, words);
        }
    }

    /// Names and values.
    fn meta(&mut self, meta: &Element) -> Node {
        self.t.check(meta, &[], &[], &["prop"]);
        let mut names = Table::default();
        for prop in meta.children("prop") {
            self.t.check(prop, &["name", "value"], &[], &[]);
            let pair = (
                self.t.required(prop, "name"),
                self.t.required(prop, "value"),
            );
            if let (Some(name), Some(value)) = pair {
                let key = Key {
                    text: name.text,
                    span: name.span,
                };
                names.insert(key, Node::string(value.span, value.text));
            }
        }
        Node::new(meta.span, Value::Table(names))
    }

    fn color(&mut self, element: &Element) -> Option<Node> {
        let names = ["red", "green", "blue", "alpha"];
        self.t.check(element, &names, &[], &[]);
        let mut parts = [0, 0, 0, 255];
        for (name, part) in names.into_iter().zip(&mut parts) {
            let Some(text) = self.t.optional(element, name) else {
                continue;
            };
            *part = self.byte(&text)?;
        }
        let [red, green, blue, alpha] = parts;
        Some(Node::string(
            element.span,
            Color::rgba(red, green, blue, alpha).to_string(),
        ))
    }

    fn byte(&mut self, text: &Text) -> Option<u8> {
        let whole = self.t.whole(text)?;
        let byte = u8::try_from(whole).ok();
        if byte.is_none() {
            self.t
                .error(text.span, format!("{whole} does not lie between 0 and 255"));
        }
        byte
    }

    fn texture(&mut self, element: &Element) -> Option<Node> {
        self.t
            .check(element, &[], &["classpath", "filesystem"], &[]);
        let Some(place) = element.children.first() else {
            self.t.error(
                element.name.span,
                "`texture` has neither `classpath` nor `filesystem`",
            );
            return None;
        };
        self.t.check(place, &["path"], &[], &[]);
        let path = self.t.required(place, "path")?;
        let (key, text) = match place.name.text.as_str() {
            // "/textures/brick_2.jpg" came with the program: "brick_2".
            "classpath" => {
                let file = path.text.rsplit('/').next().unwrap_or_default();
                let name = file.split('.').next().unwrap_or_default();
                if !Texture::is_builtin(name) {
                    let message = format!("unknown texture `{name}`, which is left out");
                    self.t.warn(path.span, message);
                    return None;
                }
                ("builtin", name.to_owned())
            }
            "filesystem" => ("file", path.text),
            _ => return None,
        };
        let mut table = Table::default();
        put(
            &mut table,
            key,
            place.name.span,
            Node::string(path.span, text),
        );
        Some(Node::new(element.span, Value::Table(table)))
    }
}

/// The third component of a vector of quantities, as written.
fn height(position: &Node) -> Option<f64> {
    let z = position.as_array()?.get(2)?.as_str()?;
    z.split(' ').next()?.parse().ok()
}

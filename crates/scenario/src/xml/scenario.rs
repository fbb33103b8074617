//! The original's scenario file, element by element.
//!
//! ```text
//! scenario
//!   name? description?
//!   master-seed?  (constant @value | variable (uniform-random | normal-random | for | each))
//!   simulation    end-time, epoch?
//!   models        model+            @name @count: class, model*, sensor*, radio?, start-position?
//!   components?   variation+        class
//!   looping?      variables variable+
//! class = java-class, properties? (prop @name @value)*, custom-config?
//! ```

use super::part::{Found, Settings};
use super::read::{Translation, put, widen};
use super::tree::{Element, Text};
use super::variables::Variables;
use crate::sweep::KEY as SWEEP;
use crate::variables::{KEY as VARIABLES, Variables as Given};
use simbeeotic_model::config::{Fault, Key, Node, Span, Table, Value};
use simbeeotic_model::registry::Kind;

const END_TIME: &str = "the original cut `end-time` to whole seconds; here its fraction counts";
const CUBE: &str = "a random start is drawn from a cube with one corner at the start position, as in \
                    the original; the paper says \"within 20 m of the origin\", which would be \
                    start = { ball = \"20 m\" }";
/// What the original's propagation models did unless told otherwise.
const CHANNEL_DEFAULTS: [(&str, &str); 3] = [
    ("noise_floor.mean", "-100 dBm"),
    ("noise_floor.sigma", "10 dB"),
    ("range_limit", "10 m"),
];
/// The form of the original's two-ray model, which is not the usual one: part, key and value.
const TWO_RAY_FORM: (&str, &str, &str) = ("two-ray", "form", "original");
/// How far a random start reached unless told otherwise, in metres.
const RANDOM_START_BOUND_M: f64 = 10.0;

/// The tree that a TOML file of the same meaning has.
pub(super) fn scenario(root: &Element, given: &mut Given) -> (Node, Vec<Fault>) {
    let mut faults = Vec::new();
    let variables = Variables::of(root, &mut faults);
    let mut translation = Translation::new(variables);
    translation.faults = faults;
    let mut scenario = Scenario {
        t: translation,
        channel: None,
        weather: None,
    };
    let node = scenario.read(root);
    scenario.t.variables.give(given);
    (node, scenario.t.faults)
}

struct Scenario {
    t: Translation,
    channel: Option<(Key, Node)>,
    weather: Option<(Key, Node)>,
}

impl Scenario {
    fn read(&mut self, root: &Element) -> Node {
        let known = [
            "name",
            "description",
            "master-seed",
            "simulation",
            "models",
            "components",
            "looping",
        ];
        self.t.check(root, &[], &known, &[]);
        let seed = self.seed(root);
        let mut table = Table::default();
        for word in ["name", "description"] {
            if let Some(text) = root.child(word).filter(|e| !e.text.text.trim().is_empty()) {
                let text = self.t.content(text);
                if let Some(text) = text {
                    put(
                        &mut table,
                        word,
                        text.span,
                        Node::string(text.span, text.text),
                    );
                }
            }
        }
        let run = self.run(root, seed);
        put(&mut table, "run", run.span, run);
        let models = match root.child("models") {
            Some(models) => {
                self.t.check(models, &[], &[], &["model"]);
                self.models(models, false)
            }
            None => {
                self.t.error(root.name.span, "`scenario` has no `models`");
                None
            }
        };
        let components = root.child("components").and_then(|c| self.components(c));
        table.entries.extend(self.channel.take());
        table.entries.extend(self.weather.take());
        for (word, list) in [("model", models), ("component", components)] {
            if let Some(list) = list {
                put(&mut table, word, list.span, list);
            }
        }
        self.looping(root);
        let (variables, sweep) = self.t.variables.sweep();
        for (word, part) in [(VARIABLES, variables), (SWEEP, sweep)] {
            if let Some(part) = part {
                let place = root.child("looping").or_else(|| root.child("master-seed"));
                let span = place.unwrap_or(root).name.span;
                put(&mut table, word, span, whole_table(part, span));
            }
        }
        Node::new(root.span, Value::Table(table))
    }

    fn seed(&mut self, root: &Element) -> Option<Node> {
        let node = self.seed_node(root);
        let seed = match &node {
            Some(Node {
                value: Value::Integer(seed),
                ..
            }) => *seed,
            _ => 1,
        };
        let mut faults = std::mem::take(&mut self.t.faults);
        self.t.variables.evaluate(seed, &mut faults);
        self.t.faults = faults;
        node
    }

    fn seed_node(&mut self, root: &Element) -> Option<Node> {
        let Some(master) = root.child("master-seed") else {
            let message = "there is no `master-seed`; the original refused this, here it is 1";
            self.t.warn(root.name.span, message);
            return None;
        };
        self.t.check(master, &[], &["constant", "variable"], &[]);
        if let Some(constant) = master.child("constant") {
            self.t.check(constant, &["value"], &[], &[]);
            let text = self.t.required(constant, "value")?;
            let seed = self.t.whole(&text)?;
            return Some(Node::new(text.span, Value::Integer(seed)));
        }
        let Some(definition) = master.child("variable").and_then(|v| v.children.first()) else {
            self.t.error(
                master.name.span,
                "`master-seed` has neither constant nor variable",
            );
            return None;
        };
        let mut faults = std::mem::take(&mut self.t.faults);
        let values = self.t.variables.values(definition, 0, &mut faults);
        self.t.faults = faults;
        if self.t.variables.hangs(definition) {
            let message = "these seeds hang on a variable that varies; here they are those of its first value";
            self.t.warn(definition.name.span, message);
        }
        let mut seeds = Vec::new();
        for text in values? {
            let span = definition.name.span;
            let seed = self.t.number(&Text { text, span })?.floor();
            seeds.push(Node::new(span, Value::Integer(seed as i64)));
        }
        let first = seeds.first().cloned();
        if seeds.len() > 1 {
            self.t.variables.seeds = seeds;
        }
        first
    }

    fn run(&mut self, root: &Element, seed: Option<Node>) -> Node {
        let mut run = Table::default();
        if let Some(seed) = seed {
            put(&mut run, "seed", seed.span, seed);
        }
        let Some(simulation) = root.child("simulation") else {
            self.t
                .error(root.name.span, "`scenario` has no `simulation`");
            return Node::new(root.name.span, Value::Table(run));
        };
        self.t.check(simulation, &[], &["end-time", "epoch"], &[]);
        match simulation.child("end-time") {
            // An empty element takes its default from the schema.
            Some(end) if end.text.text.trim().is_empty() => {
                put(
                    &mut run,
                    "end_time",
                    end.name.span,
                    Node::string(end.span, "1200 s"),
                );
            }
            Some(end) => {
                self.t.check(end, &[], &[], &[]);
                let text = self.t.replace(&end.text);
                if let Some(seconds) = self.t.number(&text) {
                    if seconds.fract() != 0.0 {
                        self.t.note_once(text.span, END_TIME);
                    }
                    let node = Node::string(text.span, format!("{seconds} s"));
                    let node = self.t.varied(&end.text, node, "s");
                    put(&mut run, "end_time", end.name.span, node);
                }
            }
            None => self
                .t
                .error(simulation.name.span, "`simulation` has no `end-time`"),
        }
        if let Some(epoch) = simulation.child("epoch")
            && let Some(text) = self.t.content(epoch)
            && let Some(node) = self.t.quantity(&text, "ms")
        {
            put(&mut run, "epoch", epoch.name.span, node);
        }
        Node::new(simulation.span, Value::Table(run))
    }

    /// The models in an element, or `None` if none of them is simulated.
    fn models(&mut self, element: &Element, nested: bool) -> Option<Node> {
        let mut names = Names::default();
        let mut all = Vec::new();
        for model in element.children("model") {
            all.extend(self.model(model, nested, &mut names));
        }
        list(all)
    }

    fn model(&mut self, element: &Element, nested: bool, names: &mut Names) -> Option<Node> {
        let once = [
            "java-class",
            "properties",
            "custom-config",
            "radio",
            "start-position",
        ];
        self.t
            .check(element, &["name", "count"], &once, &["model", "sensor"]);
        let kinds = [Kind::Model, Kind::Propagation, Kind::Weather];
        let found = self.t.class(element, &kinds)?;
        let settings = self.t.properties(element, &found);
        if found.kind != Kind::Model {
            self.shared(element, &found, settings);
            return None;
        }
        let mut table = uses(found.part.label.name, found.span);
        if let Some(name) = names.unique(&mut self.t, element, found.part.label.name, found.span) {
            put(&mut table, "name", name.span, name);
        }
        if let Some(text) = element.attribute("count") {
            let value = self.t.replace(text);
            if let Some(count) = self.t.whole(&value) {
                let node = Node::new(text.span, Value::Integer(count));
                let node = self.t.varied(text, node, "");
                put(&mut table, "count", text.span, node);
            }
        }
        if let Some(start) = self.start(element, nested, &settings) {
            put(&mut table, "start", start.span, start);
        }
        if !settings.params.is_empty() {
            put(
                &mut table,
                "params",
                found.span,
                whole_table(settings.params, found.span),
            );
        }
        if !settings.vehicle.is_empty() {
            let part = found.class.and_then(|c| c.vehicle).unwrap_or_default();
            let mut vehicle = uses(part, found.span);
            vehicle.entries.extend(settings.vehicle.entries);
            put(
                &mut table,
                "vehicle",
                found.span,
                whole_table(vehicle, found.span),
            );
        }
        if let Some(sensors) = self.sensors(element) {
            put(&mut table, "sensor", sensors.span, sensors);
        }
        if let Some(radio) = element.child("radio").and_then(|r| self.radio(r)) {
            put(&mut table, "radio", radio.span, radio);
        }
        if let Some(models) = self.models(element, true) {
            put(&mut table, "model", models.span, models);
        }
        Some(Node::new(element.span, Value::Table(table)))
    }

    /// Channel or weather: what stood among the models and is one for all of them.
    fn shared(&mut self, element: &Element, found: &Found, mut settings: Settings) {
        let word = if found.kind == Kind::Propagation {
            "channel"
        } else {
            "weather"
        };
        let mut table = uses(found.part.label.name, found.span);
        if found.kind == Kind::Propagation {
            for (path, default) in CHANNEL_DEFAULTS {
                let (first, last) = path.split_once('.').unwrap_or((path, path));
                let there = match settings.params.get(first) {
                    Some(node) => node.as_table().is_none_or(|t| t.get(last).is_some()),
                    None => false,
                };
                if !there {
                    let node = Node::string(found.span, default);
                    put(&mut settings.params, path, found.span, node);
                }
            }
            let (part, key, value) = TWO_RAY_FORM;
            if found.part.label.name == part && found.class.is_some() {
                let node = Node::string(found.span, value);
                put(&mut settings.params, key, found.span, node);
            }
        }
        table.entries.append(&mut settings.params.entries);
        for gear in ["model", "sensor", "radio", "start-position"] {
            if let Some(child) = element.child(gear) {
                let message = format!("a {} carries no `{gear}`", found.kind.name());
                self.t.warn(child.name.span, message);
            }
        }
        let node = Node::new(element.span, Value::Table(table));
        let place = if word == "channel" {
            &mut self.channel
        } else {
            &mut self.weather
        };
        if place.is_some() {
            let message = format!("a second {}: there is one at most", found.kind.name());
            self.t.error(found.span, message);
        } else {
            *place = Some((
                Key {
                    text: word.to_owned(),
                    span: found.span,
                },
                node,
            ));
        }
    }

    fn start(&mut self, element: &Element, nested: bool, settings: &Settings) -> Option<Node> {
        let mut point = element
            .child("start-position")
            .and_then(|p| self.t.vector(p, "m", true).map(|node| (node, p.name.span)));
        if nested && let Some((_, span)) = point.take() {
            let message =
                "a nested model starts where its parent starts; this position is left out";
            self.t.warn(span, message);
        }
        let (random, span) = settings.random_start.unwrap_or_default();
        if !random {
            return point.map(|(node, _)| node);
        }
        self.t.note_once(span, CUBE);
        let (bound, bound_span) = settings
            .random_start_bound
            .unwrap_or((RANDOM_START_BOUND_M, span));
        let mut table = Table::default();
        let size = || Node::string(bound_span, format!("{bound} m"));
        let size = Node::new(bound_span, Value::Array(vec![size(), size(), size()]));
        put(&mut table, "box", span, size);
        if let Some((from, _)) = point {
            put(&mut table, "from", from.span, from);
        }
        Some(whole_table(table, span))
    }

    fn sensors(&mut self, model: &Element) -> Option<Node> {
        let mut sensors = Table::default();
        let mut whole: Option<Span> = None;
        for element in model.children("sensor") {
            let once = [
                "java-class",
                "properties",
                "custom-config",
                "offset",
                "pointing",
            ];
            self.t.check(element, &["name"], &once, &[]);
            let Some(found) = self.t.class(element, &[Kind::Sensor]) else {
                continue;
            };
            let settings = self.t.properties(element, &found);
            let mut table = uses(found.part.label.name, found.span);
            if let Some(offset) = element.child("offset")
                && let Some(node) = self.t.vector(offset, "m", true)
            {
                put(&mut table, "mount.position", offset.name.span, node);
            }
            if let Some(pointing) = element.child("pointing")
                && let Some(node) = self.direction(pointing)
            {
                put(&mut table, "mount.pointing", pointing.name.span, node);
            }
            table.entries.extend(settings.params.entries);
            let name = element.attribute("name").filter(|n| !n.text.is_empty());
            let name = name.cloned().unwrap_or_else(|| Text {
                text: found.part.label.name.to_owned(),
                span: found.span,
            });
            if sensors.get(&name.text).is_some() {
                let message = format!("a second sensor called `{}`", name.text);
                self.t.error(name.span, message);
                continue;
            }
            let key = Key {
                text: name.text,
                span: name.span,
            };
            sensors.insert(key, Node::new(element.span, Value::Table(table)));
            widen(whole.get_or_insert(element.span), element.span);
        }
        whole.map(|span| Node::new(span, Value::Table(sensors)))
    }

    /// A direction as three plain numbers; `None` for the zero vector, which is none.
    fn direction(&mut self, element: &Element) -> Option<Node> {
        self.t.check(element, &["x", "y", "z"], &[], &[]);
        let mut parts = Vec::new();
        for axis in ["x", "y", "z"] {
            let text = self.t.required(element, axis)?;
            parts.push(Node::new(text.span, Value::Float(self.t.number(&text)?)));
        }
        let none = parts.iter().all(|p| p.value == Value::Float(0.0));
        (!none).then(|| Node::new(element.span, Value::Array(parts)))
    }

    fn radio(&mut self, element: &Element) -> Option<Node> {
        let once = [
            "java-class",
            "properties",
            "custom-config",
            "antenna-pattern",
        ];
        self.t.check(element, &["name"], &once, &[]);
        let found = self.t.class(element, &[Kind::Radio])?;
        let settings = self.t.properties(element, &found);
        let mut table = uses(found.part.label.name, found.span);
        table.entries.extend(settings.params.entries);
        if let Some(antenna) = element.child("antenna-pattern") {
            self.t.check(
                antenna,
                &["name"],
                &["java-class", "properties", "custom-config"],
                &[],
            );
            if let Some(found) = self.t.class(antenna, &[Kind::Antenna]) {
                let settings = self.t.properties(antenna, &found);
                let name = Node::string(found.span, found.part.label.name);
                let node = if settings.params.is_empty() {
                    name
                } else {
                    let mut inner = Table::default();
                    put(&mut inner, "use", found.span, name);
                    inner.entries.extend(settings.params.entries);
                    Node::new(antenna.span, Value::Table(inner))
                };
                put(&mut table, "antenna", antenna.name.span, node);
            }
        }
        Some(Node::new(element.span, Value::Table(table)))
    }

    fn components(&mut self, element: &Element) -> Option<Node> {
        self.t.check(element, &[], &[], &["variation"]);
        let mut all = Vec::new();
        for variation in element.children("variation") {
            let once = ["java-class", "properties", "custom-config"];
            self.t.check(variation, &["name"], &once, &[]);
            let Some(found) = self.t.class(variation, &[Kind::Component]) else {
                continue;
            };
            let settings = self.t.properties(variation, &found);
            let mut table = uses(found.part.label.name, found.span);
            table.entries.extend(settings.params.entries);
            all.push(Node::new(variation.span, Value::Table(table)));
        }
        list(all)
    }

    fn looping(&mut self, root: &Element) {
        if let Some(looping) = root.child("looping") {
            self.t.check(looping, &[], &["variables"], &[]);
            if let Some(variables) = looping.child("variables") {
                self.t.check(variables, &[], &[], &["variable"]);
            }
        }
    }
}

/// A section that begins by naming its part: `use = "..."`.
fn uses(part: &str, span: Span) -> Table {
    let mut table = Table::default();
    put(&mut table, "use", span, Node::string(span, part));
    table
}

fn list(all: Vec<Node>) -> Option<Node> {
    let mut span = all.first()?.span;
    for node in &all {
        widen(&mut span, node.span);
    }
    Some(Node::new(span, Value::Array(all)))
}

/// A table whose span holds all its entries.
fn whole_table(table: Table, span: Span) -> Node {
    let mut whole = span;
    for (key, node) in &table.entries {
        widen(&mut whole, key.span);
        widen(&mut whole, node.span);
    }
    Node::new(whole, Value::Table(table))
}

/// The names of the models in one place. The original did not mind two models of one name.
#[derive(Default)]
struct Names(Vec<String>);

impl Names {
    /// The name to write, if it is another than the part's own.
    fn unique(
        &mut self,
        t: &mut Translation,
        model: &Element,
        part: &str,
        class: Span,
    ) -> Option<Node> {
        let given = model.attribute("name").filter(|n| !n.text.is_empty());
        let (wanted, span) = match given {
            Some(name) => (name.text.as_str(), name.span),
            None => (part, class),
        };
        let mut name = wanted.to_owned();
        let mut letters = 'b'..='z';
        let mut number = 27;
        while self.0.contains(&name) {
            name = match letters.next() {
                Some(letter) => format!("{wanted}-{letter}"),
                None => format!("{wanted}-x{number}"),
            };
            number += 1;
        }
        if given.is_some() && name != wanted {
            t.warn(
                span,
                format!("a second model called `{wanted}`; it is called `{name}` here"),
            );
        }
        self.0.push(name.clone());
        (name != part).then(|| Node::string(span, name))
    }
}

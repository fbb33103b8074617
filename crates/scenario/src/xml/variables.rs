//! Variables of a scenario: what a placeholder `${name}` stands for.
//!
//! A variable has one or more values; the original ran the scenario once for each combination of
//! all variables' values, for each value of the master seed. One with a single value is put in its
//! places at once. One with several, and what hangs on it, becomes a variable of the tree that
//! `[sweep]` varies ([`Variables::sweep`]); meanwhile it has the value of the first variation.

mod definition;

use super::read::{number, whole};
use super::tree::{Element, Text};
use crate::variables::{
    KEY as VARIABLES, NAME_HELP, Variables as Given, is_name, placeholder, typed,
};
use definition::Definition;
use simbeeotic_model::config::{Fault, Key, Node, Span, Table, Value};

/// All variables, in the order of the file.
#[derive(Debug, Default)]
pub(crate) struct Variables {
    all: Vec<Variable>,
    /// Variables that another document, the scenario, has given; `Some` for a world.
    given: Option<Given>,
    master_seed: i64,
    /// The values of the master seed, if it has several.
    pub(crate) seeds: Vec<Node>,
}

/// What varies, as a part of a tree.
#[derive(Clone, Debug, PartialEq)]
enum Several {
    /// What stands behind its key in `[sweep.vary]`.
    Values(Node),
    /// A text with the placeholder of another.
    Made(Node),
}

#[derive(Debug)]
struct Variable {
    name: Text,
    definition: Element,
    state: State,
    /// What it becomes if it has several values, or hangs on one that has.
    several: Option<Several>,
    /// How many variables before it take their seed from the master's stream.
    streams_before: usize,
}

#[derive(Clone, Debug, PartialEq)]
enum State {
    New,
    Open,
    Known(String),
    Broken,
}

impl Variables {
    /// The variables that a scenario gives to its world.
    pub(crate) fn given(given: &Given) -> Self {
        Self {
            given: Some(given.clone()),
            ..Self::default()
        }
    }

    /// Whether a text is the value of a variable that was given: it may have a unit of its own.
    pub(crate) fn is_given(&self, text: &str) -> bool {
        let given = self.given.iter();
        let mut values = given.flat_map(|g| g.names().filter_map(|name| g.text(name)));
        values.any(|value| value == text)
    }

    /// Tells the values that were found.
    pub(crate) fn give(&self, given: &mut Given) {
        for variable in &self.all {
            if let State::Known(value) = &variable.state {
                given.set(&variable.name.text, value);
            }
        }
    }

    /// Collects the variables of a scenario and finds the first value of each.
    pub(crate) fn of(scenario: &Element, faults: &mut Vec<Fault>) -> Self {
        let mut variables = Self::default();
        let definitions = scenario
            .child("looping")
            .and_then(|l| l.child("variables"))
            .into_iter()
            .flat_map(|v| v.children("variable"));
        let mut streams = 0;
        for element in definitions {
            let Some(name) = element.attribute("name") else {
                faults.push(Fault::error(element.name.span, "a variable needs a `name`"));
                continue;
            };
            if !is_name(&name.text) {
                let message = format!("`{}` is no name for a variable", name.text);
                faults.push(Fault::error(name.span, message).help(NAME_HELP));
                continue;
            }
            if variables.all.iter().any(|v| v.name.text == name.text) {
                let message = format!("a second variable called `{}`", name.text);
                faults.push(Fault::error(name.span, message));
                continue;
            }
            let Some(definition) = element.children.first() else {
                faults.push(Fault::error(name.span, "this variable has no definition"));
                continue;
            };
            let streams_before = streams;
            streams += usize::from(takes_stream(definition));
            variables.all.push(Variable {
                name: name.clone(),
                definition: definition.clone(),
                state: State::New,
                several: None,
                streams_before,
            });
        }
        variables
    }

    /// Finds the first value of each variable, given the first master seed.
    pub(crate) fn evaluate(&mut self, master_seed: i64, faults: &mut Vec<Fault>) {
        self.master_seed = master_seed;
        for at in 0..self.all.len() {
            self.value_of(at, self.all[at].name.span, faults);
        }
    }

    /// The name of the variable that a text stands for, if it has several values.
    pub(crate) fn varying(&self, text: &str) -> Option<&str> {
        let (name, _) = placeholder(text)?;
        let variable = self.all.iter().find(|v| v.name.text == name)?;
        variable
            .several
            .as_ref()
            .map(|_| variable.name.text.as_str())
    }

    /// The tables `[variables]` and `[sweep]` of what varies, if something does.
    pub(crate) fn sweep(&self) -> (Option<Table>, Option<Table>) {
        let mut first = Table::default();
        let mut vary = Table::default();
        for variable in &self.all {
            let Some(several) = &variable.several else {
                continue;
            };
            let (name, span) = (&variable.name.text, variable.name.span);
            let key = |text: String| Key { text, span };
            match (several, &variable.state) {
                (Several::Values(values), State::Known(value)) => {
                    first.insert(key(name.clone()), Node::new(span, plain(value)));
                    vary.insert(key(format!("{VARIABLES}.{name}")), values.clone());
                }
                (Several::Made(text), _) => first.insert(key(name.clone()), text.clone()),
                _ => {}
            }
        }
        let mut sweep = Table::default();
        if let Some(seed) = self.seeds.first() {
            sweep.set(
                "seeds",
                Node::new(seed.span, Value::Array(self.seeds.clone())),
            );
        }
        if let Some((key, _)) = vary.entries.first() {
            sweep.set("vary", Node::new(key.span, Value::Table(vary)));
        }
        let there = |table: Table| (!table.is_empty()).then_some(table);
        (there(first), there(sweep))
    }

    /// What a text stands for: itself (`None`) if it is no placeholder.
    pub(crate) fn resolve(&mut self, text: &Text, faults: &mut Vec<Fault>) -> Option<String> {
        let (name, default) = placeholder(&text.text)?;
        if let Some(at) = self.all.iter().position(|v| v.name.text == name) {
            return Some(
                self.value_of(at, text.span, faults)
                    .unwrap_or_else(|| "0".to_owned()),
            );
        }
        if let Some(value) = self.given.as_ref().and_then(|given| given.text(name)) {
            return Some(value);
        }
        let given = self.given.iter().flat_map(Given::names);
        let known = self.all.iter().map(|v| v.name.text.as_str()).chain(given);
        let fault = Fault::unknown(text.span, "variable", name, known);
        match default {
            // A world may serve scenarios that do not set it.
            Some(default) if self.given.is_some() => Some(default.to_owned()),
            Some(default) => {
                let message = format!("{}; its default `{default}` is used", fault.message);
                faults.push(Fault::warning(text.span, message));
                Some(default.to_owned())
            }
            None => {
                faults.push(fault);
                Some("0".to_owned())
            }
        }
    }

    fn value_of(&mut self, at: usize, asked: Span, faults: &mut Vec<Fault>) -> Option<String> {
        match &self.all[at].state {
            State::Known(value) => return Some(value.clone()),
            State::Broken => return None,
            State::Open => {
                let message = format!("variable `{}` depends on itself", self.all[at].name.text);
                faults.push(Fault::error(asked, message));
                return None;
            }
            State::New => {}
        }
        self.all[at].state = State::Open;
        let definition = self.all[at].definition.clone();
        let stream = self.all[at].streams_before;
        let values = self.values(&definition, stream, faults);
        let value = values.as_ref().and_then(|values| values.first().cloned());
        self.all[at].several = values.and_then(|values| self.several(&definition, &values, faults));
        self.all[at].state = value.clone().map_or(State::Broken, State::Known);
        value
    }

    /// What a definition becomes that has these values in the first variation, if it varies.
    fn several(
        &self,
        definition: &Element,
        values: &[String],
        faults: &mut Vec<Fault>,
    ) -> Option<Several> {
        let span = definition.span;
        let hangs = self.hangs(definition);
        if values.len() < 2 && !hangs {
            return None;
        }
        // A placeholder of what varies stays one.
        let node = |text: &Text| match self.varying(&text.text) {
            Some(name) => Node::string(text.span, format!("${{{name}}}")),
            None => Node::new(text.span, plain(&self.known(text))),
        };
        let listed = || {
            let node = |value: &String| Node::new(span, plain(value));
            Several::Values(Node::new(
                span,
                Value::Array(values.iter().map(node).collect()),
            ))
        };
        Some(match definition.name.text.as_str() {
            "constant" => Several::Made(node(definition.attribute("value")?)),
            "for" => {
                let mut table = Table::default();
                for key in ["from", "to", "step"] {
                    if let Some(text) = definition.attribute(key) {
                        table.set(key, node(text));
                    }
                }
                Several::Values(Node::new(span, Value::Table(table)))
            }
            "each" if hangs && definition.attributes.is_empty() => {
                let values = definition.children("value").map(|v| node(&v.text));
                Several::Values(Node::new(span, Value::Array(values.collect())))
            }
            _ if hangs => {
                let message = "these values hang on a variable that varies; here they are those of its first \
                               value";
                faults.push(Fault::warning(definition.name.span, message));
                match values {
                    [_] => return None,
                    _ => listed(),
                }
            }
            _ => listed(),
        })
    }

    /// Whether a definition names a variable that varies.
    pub(crate) fn hangs(&self, definition: &Element) -> bool {
        let texts = definition.attributes.iter().map(|a| &a.value);
        let inner = definition.children("value").map(|v| &v.text);
        texts
            .chain(inner)
            .any(|text| self.varying(&text.text).is_some())
    }

    /// What a text stands for, if all its variables are known.
    fn known(&self, text: &Text) -> String {
        let known = placeholder(&text.text).and_then(|(name, default)| {
            let variable = self.all.iter().find(|v| v.name.text == name);
            match variable.map(|v| &v.state) {
                Some(State::Known(value)) => Some(value.clone()),
                _ => default.map(str::to_owned),
            }
        });
        known.unwrap_or_else(|| text.text.clone())
    }

    /// The values of a definition: of a variable, or of the master seed. At least one.
    pub(crate) fn values(
        &mut self,
        definition: &Element,
        stream: usize,
        faults: &mut Vec<Fault>,
    ) -> Option<Vec<String>> {
        let mut definition = Definition {
            variables: self,
            element: definition,
            faults,
        };
        definition.values(stream)
    }
}

/// A variable's value for a tree: a number that only Java writes so (`2.5f`) as a plain one.
fn plain(text: &str) -> Value {
    match (typed(text), whole(text), number(text)) {
        (Value::String(_), Some(whole), _) => Value::Integer(whole),
        (Value::String(_), None, Some(number)) => Value::Float(number),
        (value, _, _) => value,
    }
}

fn takes_stream(definition: &Element) -> bool {
    definition
        .attribute("seed-source")
        .is_some_and(|s| s.text == "RANDOM_STREAM")
}

#[cfg(test)]
mod tests {
    use super::super::tree::parse;
    use super::*;
    use simbeeotic_model::config::SourceId;

    fn variables(definitions: &str) -> (Variables, Vec<Fault>) {
        let text = format!("<s><looping><variables>{definitions}</variables></looping></s>");
        let scenario = parse(&text, SourceId(0)).expect("well-formed");
        let mut faults = Vec::new();
        let mut variables = Variables::of(&scenario, &mut faults);
        variables.evaluate(7, &mut faults);
        (variables, faults)
    }

    fn value(variables: &mut Variables, text: &str) -> (Option<String>, Vec<Fault>) {
        let mut faults = Vec::new();
        let span = Span::default();
        let value = variables.resolve(
            &Text {
                text: text.to_owned(),
                span,
            },
            &mut faults,
        );
        (value, faults)
    }

    #[test]
    fn the_first_combination_counts_and_the_others_are_counted() {
        let (mut all, faults) = variables(
            r#"<variable name="bee.len"><for from="0.2" to="0.3" step="0.01"/></variable>
               <variable name="m"><constant value="${bee.len}"/></variable>
               <variable name="e"><each><value>5</value><value>6</value><value>7</value></each></variable>
               <variable name="u"><uniform-random from="1" to="2" num-draws="4"/></variable>"#,
        );
        assert_eq!(value(&mut all, "${m}").0.as_deref(), Some("0.2"));
        assert_eq!(value(&mut all, "${e}").0.as_deref(), Some("5"));
        let (first, sweep) = all.sweep();
        assert_eq!(
            crate::print::to_toml(&Node::new(
                Span::default(),
                Value::Table(sweep.expect("varies"))
            )),
            "[vary]\n\"variables.bee.len\" = { from = 0.2, to = 0.3, step = 0.01 }\n\
             \"variables.e\" = [5, 6, 7]\n\"variables.u\" = [1.7308781907032909, 1.4100808114922017, \
             1.2077148413097172, 1.3327170559595112]\n",
            "both ends of `for`, and what java.util.Random(1) draws"
        );
        let first = first.expect("varies");
        assert_eq!(
            first.get("m").and_then(Node::as_str),
            Some("${bee.len}"),
            "it hangs on another"
        );
        assert_eq!(faults.len(), 1, "{faults:?}");
        let u: f64 = value(&mut all, "${u}")
            .0
            .expect("a value")
            .parse()
            .expect("a number");
        // new Random(1).nextDouble()
        assert!((u - 1.730_878_190_703_290_9).abs() < 1e-15, "{u}");
    }

    #[test]
    fn counting_down_is_counting_too() {
        let (mut all, faults) =
            variables(r#"<variable name="d"><for from="3" to="1" step="-1"/></variable>"#);
        assert_eq!(faults.len(), 1);
        assert_eq!(all.varying("${d}"), Some("d"));
        assert_eq!(value(&mut all, "${d}").0.as_deref(), Some("3"));
    }

    #[test]
    fn a_list_obeys_its_first_and_its_number_of_draws() {
        let (mut all, _) = variables(
            r#"<variable name="e"><each first-draw="2" num-draws="2">
               <value>5</value><value>6</value><value>7</value><value>8</value></each></variable>"#,
        );
        assert_eq!(value(&mut all, "${e}").0.as_deref(), Some("6"));
        let (_, sweep) = all.sweep();
        let sweep = Node::new(Span::default(), Value::Table(sweep.expect("varies")));
        assert!(crate::print::to_toml(&sweep).contains("\"variables.e\" = [6, 7]"));
    }

    #[test]
    fn a_value_that_stands_in_a_list_twice_runs_once_and_says_so() {
        let (all, faults) = variables(
            r#"<variable name="e"><each><value>5</value><value>6</value><value>5.0f</value></each></variable>"#,
        );
        let (_, sweep) = all.sweep();
        let sweep = Node::new(Span::default(), Value::Table(sweep.expect("varies")));
        assert!(crate::print::to_toml(&sweep).contains("\"variables.e\" = [5, 6]"));
        assert_eq!(faults.len(), 1, "{faults:?}");
        assert!(faults[0].message.contains("5.0f stands here twice"));
    }

    #[test]
    fn a_normal_variable_stays_within_its_bounds() {
        let (mut all, faults) = variables(
            r#"<variable name="n"><normal-random mean="0" std-dev="1" from="2" to="3"
               seed="5" seed-source="USER"/></variable>
               <variable name="s"><normal-random mean="0.1" std-dev="0.02"
               seed-source="RANDOM_STREAM"/></variable>"#,
        );
        assert!(faults.is_empty(), "{faults:?}");
        let n: f64 = value(&mut all, "${n}")
            .0
            .expect("a value")
            .parse()
            .expect("a number");
        assert!((2.0..=3.0).contains(&n));
    }

    #[test]
    fn a_missing_variable_is_an_error_unless_it_has_a_default() {
        let (mut all, _) = variables(r#"<variable name="speed"><constant value="1"/></variable>"#);
        let (got, faults) = value(&mut all, "${sped}:0.1");
        assert_eq!((got.as_deref(), faults[0].is_error()), (Some("0.1"), false));
        let (_, faults) = value(&mut all, "${sped}");
        assert_eq!(faults[0].help.as_deref(), Some("did you mean `speed`?"));
    }

    #[test]
    fn only_a_whole_text_is_a_placeholder() {
        let (mut all, _) = variables(r#"<variable name="a"><constant value="1"/></variable>"#);
        for text in [
            "a", "$a", "x${a}", "${a}x", "${}", "${-a}", "${a..b}", "${a",
        ] {
            assert_eq!(value(&mut all, text).0, None, "{text}");
        }
    }

    #[test]
    fn nonsense_is_an_error() {
        for definition in [
            r#"<variable><constant value="1"/></variable>"#,
            r#"<variable name="a"/>"#,
            r#"<variable name="a b"><constant value="1"/></variable>"#,
            r#"<variable name="a"><constant/></variable>"#,
            r#"<variable name="a"><konstant value="1"/></variable>"#,
            r#"<variable name="a"><constant value="1"/></variable><variable name="a"><constant value="1"/></variable>"#,
            r#"<variable name="a"><constant value="${b}"/></variable><variable name="b"><constant value="${a}"/></variable>"#,
            r#"<variable name="a"><constant value="${b}"/></variable>"#,
            r#"<variable name="a"><for from="1" to="x"/></variable>"#,
            r#"<variable name="a"><for from="1" to="2" step="0"/></variable>"#,
            r#"<variable name="a"><for from="1" to="2" step="-1"/></variable>"#,
            r#"<variable name="a"><for from="1" to="1e300"/></variable>"#,
            r#"<variable name="a"><each/></variable>"#,
            r#"<variable name="a"><each first-draw="3"><value>1</value></each></variable>"#,
            r#"<variable name="a"><uniform-random from="1" to="2" seed-source="USER"/></variable>"#,
            r#"<variable name="a"><uniform-random from="1" to="2" seed-source="MINE"/></variable>"#,
            r#"<variable name="a"><uniform-random from="1" to="2" num-draws="0"/></variable>"#,
            r#"<variable name="a"><uniform-random from="1" to="2" first-draw="0"/></variable>"#,
            r#"<variable name="a"><normal-random mean="0" std-dev="1" from="90" to="91"/></variable>"#,
        ] {
            let (_, faults) = variables(definition);
            assert!(faults.iter().any(Fault::is_error), "{definition}");
        }
    }
}

//! Variables of a scenario: what a placeholder `${name}` stands for in the first variation.
//!
//! A variable has one or more values; the original ran the scenario once for each combination of
//! all variables' values, for each value of the master seed. Here the first combination counts,
//! and the number of the others is told.

use super::java::JavaRandom;
use super::read::{number, whole};
use super::tree::{Element, Text};
use crate::variables::{NAME_HELP, Variables as Given, is_name, placeholder};
use simbeeotic_model::config::{Fault, Span};

/// Values of one `for` that are counted at most.
const VALUES_MAX: f64 = 1e9;
/// Draws that a random variable skips at most.
const DRAWS_MAX: i64 = 1_000_000;
/// Redraws of a normal variable within bounds.
const REDRAWS_MAX: usize = 100_000;

/// All variables, in the order of the file.
#[derive(Debug, Default)]
pub(crate) struct Variables {
    all: Vec<Variable>,
    /// Variables that another document, the scenario, has given; `Some` for a world.
    given: Option<Given>,
    master_seed: i64,
    pub(crate) variations: f64,
}

#[derive(Debug)]
struct Variable {
    name: Text,
    definition: Element,
    state: State,
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
        let mut variables = Self {
            variations: 1.0,
            ..Self::default()
        };
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
        let value = self.first_value(&definition, stream, faults);
        self.all[at].state = value.clone().map_or(State::Broken, State::Known);
        value
    }

    /// The first value of a definition: of a variable, or of the master seed.
    pub(crate) fn first_value(
        &mut self,
        definition: &Element,
        stream: usize,
        faults: &mut Vec<Fault>,
    ) -> Option<String> {
        let mut reader = Definition {
            variables: self,
            element: definition,
            faults,
        };
        let (value, count) = match definition.name.text.as_str() {
            "constant" => (reader.text("value")?, 1.0),
            "for" => reader.counted()?,
            "each" => reader.listed()?,
            "uniform-random" => reader.uniform(stream)?,
            "normal-random" => reader.normal(stream)?,
            other => {
                let known = ["constant", "for", "each", "uniform-random", "normal-random"];
                let span = definition.name.span;
                faults.push(Fault::unknown(span, "kind of variable", other, known));
                return None;
            }
        };
        self.variations *= count;
        Some(value)
    }
}

fn takes_stream(definition: &Element) -> bool {
    definition
        .attribute("seed-source")
        .is_some_and(|s| s.text == "RANDOM_STREAM")
}

/// One definition being read.
struct Definition<'a> {
    variables: &'a mut Variables,
    element: &'a Element,
    faults: &'a mut Vec<Fault>,
}

impl Definition<'_> {
    fn error<T>(&mut self, span: Span, message: impl Into<String>) -> Option<T> {
        self.faults.push(Fault::error(span, message));
        None
    }

    fn resolved(&mut self, text: &Text) -> String {
        self.variables
            .resolve(text, self.faults)
            .unwrap_or_else(|| text.text.clone())
    }

    fn text(&mut self, name: &str) -> Option<String> {
        match self.element.attribute(name).cloned() {
            Some(text) => Some(self.resolved(&text)),
            None => {
                let message = format!("`{}` has no `{name}`", self.element.name.text);
                self.error(self.element.name.span, message)
            }
        }
    }

    fn span(&self, name: &str) -> Span {
        self.element
            .attribute(name)
            .map_or(self.element.name.span, |text| text.span)
    }

    fn number(&mut self, name: &str) -> Option<f64> {
        let text = self.text(name)?;
        match number(&text) {
            Some(number) => Some(number),
            None => self.error(self.span(name), format!("`{text}` is not a number")),
        }
    }

    fn number_or(&mut self, name: &str, default: f64) -> Option<f64> {
        if self.element.attribute(name).is_some() {
            self.number(name)
        } else {
            Some(default)
        }
    }

    fn whole_or(&mut self, name: &str, default: i64) -> Option<i64> {
        if self.element.attribute(name).is_none() {
            return Some(default);
        }
        let text = self.text(name)?;
        match whole(&text) {
            Some(whole) => Some(whole),
            None => self.error(self.span(name), format!("`{text}` is not a whole number")),
        }
    }

    /// `for`: from, to, step; both ends count.
    fn counted(&mut self) -> Option<(String, f64)> {
        let (from, to) = (self.number("from")?, self.number("to")?);
        let step = self.number_or("step", 1.0)?;
        let steps = (to - from) / step;
        if step == 0.0 || steps < 0.0 {
            let message = format!("steps of {step} never lead from {from} to {to}");
            return self.error(self.element.name.span, message);
        }
        // A hair of slack: ten steps of 0.01 lead from 0.2 to 0.3, whatever their sum.
        let count = (steps + 1e-9).floor() + 1.0;
        if count.is_nan() || count > VALUES_MAX {
            return self.error(self.element.name.span, "this counts too many values");
        }
        if count > 1.0 && count != original_count(from, to, step) {
            let message = "the original lost the last value of this `for`, or all that count down; \
                           here both ends count";
            self.faults
                .push(Fault::note(self.element.name.span, message));
        }
        Some((from.to_string(), count))
    }

    /// `each`: a list of values, of which `num-draws` from number `first-draw` on count.
    fn listed(&mut self) -> Option<(String, f64)> {
        let values: Vec<Text> = self
            .element
            .children("value")
            .map(|v| v.text.clone())
            .collect();
        let first = self.whole_or("first-draw", 1)?;
        let draws = self.whole_or("num-draws", -1)?;
        let first = usize::try_from(first - 1)
            .ok()
            .filter(|first| *first < values.len());
        let Some(first) = first else {
            let message = format!(
                "this list has {} values, and none of them counts",
                values.len()
            );
            return self.error(self.element.name.span, message);
        };
        if self.element.attribute("first-draw").is_some()
            || self.element.attribute("num-draws").is_some()
        {
            let message =
                "the original did not obey `first-draw` and `num-draws` here; they count now";
            self.faults
                .push(Fault::note(self.element.name.span, message));
        }
        let left = values.len() - first;
        let count = usize::try_from(draws).map_or(left, |draws| draws.min(left));
        if count == 0 {
            return self.error(self.span("num-draws"), "no value of this list counts");
        }
        Some((self.resolved(&values[first]), count as f64))
    }

    fn uniform(&mut self, stream: usize) -> Option<(String, f64)> {
        let (from, to) = (self.number("from")?, self.number("to")?);
        let (mut random, skip, draws) = self.random(stream)?;
        let (low, high) = (from.min(to), from.max(to));
        let mut draw = || low + random.double() * (high - low);
        for _ in 0..skip {
            draw();
        }
        Some((draw().to_string(), draws))
    }

    fn normal(&mut self, stream: usize) -> Option<(String, f64)> {
        let (mean, sigma) = (self.number("mean")?, self.number("std-dev")?);
        let low = self.number_or("from", f64::NEG_INFINITY)?;
        let high = self.number_or("to", f64::INFINITY)?;
        let (mut random, skip, draws) = self.random(stream)?;
        let mut left = skip;
        for _ in 0..REDRAWS_MAX.saturating_add(skip) {
            let value = mean + random.gaussian() * sigma;
            if (low.min(high)..=low.max(high)).contains(&value) {
                if left == 0 {
                    return Some((value.to_string(), draws));
                }
                left -= 1;
            }
        }
        let message = format!("no draw lies between {low} and {high}");
        self.error(self.element.name.span, message)
    }

    /// The stream of a random variable, how many draws it skips, and how many it takes.
    fn random(&mut self, stream: usize) -> Option<(JavaRandom, usize, f64)> {
        let source = match self.element.attribute("seed-source").is_some() {
            true => self.text("seed-source")?,
            false => "DEFAULT".to_owned(),
        };
        let seed = match source.as_str() {
            "DEFAULT" => 1,
            "USER" => {
                self.text("seed")?;
                self.whole_or("seed", 1)?
            }
            "RANDOM_STREAM" => {
                let mut master = JavaRandom::new(self.variables.master_seed);
                (0..=stream).map(|_| master.long()).last().unwrap_or(1)
            }
            other => {
                let known = ["DEFAULT", "USER", "RANDOM_STREAM"];
                let span = self.span("seed-source");
                self.faults
                    .push(Fault::unknown(span, "source of seeds", other, known));
                return None;
            }
        };
        let first = self.whole_or("first-draw", 1)?;
        if !(1..=DRAWS_MAX).contains(&first) {
            let message = format!("`first-draw` lies between 1 and {DRAWS_MAX}");
            return self.error(self.span("first-draw"), message);
        }
        let draws = self.whole_or("num-draws", 1)?;
        if draws < 1 {
            return self.error(self.span("num-draws"), "a variable has at least one value");
        }
        Some((JavaRandom::new(seed), (first - 1) as usize, draws as f64))
    }
}

/// How many values the original's loop had: it added up steps, upwards only.
fn original_count(from: f64, to: f64, step: f64) -> f64 {
    let (mut value, mut count) = (from, 0.0);
    while value <= to && step > 0.0 && count < 1e6 {
        value += step;
        count += 1.0;
    }
    if count >= 1e6 {
        ((to - from) / step + 1e-9).floor() + 1.0
    } else {
        count
    }
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
        assert_eq!(
            all.variations,
            11.0 * 3.0 * 4.0,
            "the end point of `for` is kept"
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
        assert_eq!((all.variations, faults.len()), (3.0, 1));
        assert_eq!(value(&mut all, "${d}").0.as_deref(), Some("3"));
    }

    #[test]
    fn a_list_obeys_its_first_and_its_number_of_draws() {
        let (mut all, _) = variables(
            r#"<variable name="e"><each first-draw="2" num-draws="2">
               <value>5</value><value>6</value><value>7</value><value>8</value></each></variable>"#,
        );
        assert_eq!(value(&mut all, "${e}").0.as_deref(), Some("6"));
        assert_eq!(all.variations, 2.0);
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

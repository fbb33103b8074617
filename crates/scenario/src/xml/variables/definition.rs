//! What a variable is defined by: a constant, a count, a list, or draws.

use super::{Variables, plain};
use crate::sweep::{RUNS_MAX, said};
use crate::xml::java::JavaRandom;
use crate::xml::read::{number, whole};
use crate::xml::tree::{Element, Text};
use simbeeotic_model::config::{Fault, Node, Span};
use std::collections::BTreeSet;

/// Draws that a random variable skips at most.
const DRAWS_MAX: i64 = 1_000_000;
/// Redraws of one value of a normal variable within bounds.
const REDRAWS_MAX: usize = 100_000;

/// One definition being read.
pub(super) struct Definition<'a> {
    pub(super) variables: &'a mut Variables,
    pub(super) element: &'a Element,
    pub(super) faults: &'a mut Vec<Fault>,
}

impl Definition<'_> {
    /// Its values, at least one; `stream` is how many variables before it take their seed from the master's
    /// stream.
    pub(super) fn values(&mut self, stream: usize) -> Option<Vec<String>> {
        match self.element.name.text.as_str() {
            "constant" => Some(vec![self.text("value")?]),
            "for" => self.counted(),
            "each" => self.listed(),
            "uniform-random" => self.uniform(stream),
            "normal-random" => self.normal(stream),
            other => {
                let known = ["constant", "for", "each", "uniform-random", "normal-random"];
                let span = self.element.name.span;
                let fault = Fault::unknown(span, "kind of variable", other, known);
                self.faults.push(fault);
                None
            }
        }
    }

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
    fn counted(&mut self) -> Option<Vec<String>> {
        let (from, to) = (self.number("from")?, self.number("to")?);
        let step = self.number_or("step", 1.0)?;
        let steps = (to - from) / step;
        if step == 0.0 || steps < 0.0 {
            let message = format!("steps of {step} never lead from {from} to {to}");
            return self.error(self.element.name.span, message);
        }
        // A hair of slack: ten steps of 0.01 lead from 0.2 to 0.3, whatever their sum.
        let count = (steps + 1e-9).floor() + 1.0;
        if count.is_nan() || count > RUNS_MAX as f64 {
            let message = format!("these are {count} values, and {RUNS_MAX} runs are the most");
            return self.error(self.element.name.span, message);
        }
        if count > 1.0 && count != original_count(from, to, step) {
            let message = "the original lost the last value of this `for`, or all that count down; \
                           here both ends count";
            self.faults
                .push(Fault::note(self.element.name.span, message));
        }
        let value = |at: u32| (from + f64::from(at) * step).to_string();
        Some((0..count as u32).map(value).collect())
    }

    /// `each`: a list of values, of which `num-draws` from number `first-draw` on count.
    fn listed(&mut self) -> Option<Vec<String>> {
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
        let mut once: Vec<String> = Vec::new();
        let mut seen = BTreeSet::new();
        for text in &values[first..first + count] {
            let value = self.resolved(text);
            if seen.insert(said(&Node::new(text.span, plain(&value)))) {
                once.push(value);
            } else {
                let message = format!("{value} stands here twice, and runs once");
                self.faults.push(Fault::warning(text.span, message));
            }
        }
        Some(once)
    }

    fn uniform(&mut self, stream: usize) -> Option<Vec<String>> {
        let (from, to) = (self.number("from")?, self.number("to")?);
        let (mut random, skip, draws) = self.random(stream)?;
        let (low, high) = (from.min(to), from.max(to));
        let mut draw = || low + random.double() * (high - low);
        for _ in 0..skip {
            draw();
        }
        Some((0..draws).map(|_| draw().to_string()).collect())
    }

    fn normal(&mut self, stream: usize) -> Option<Vec<String>> {
        let (mean, sigma) = (self.number("mean")?, self.number("std-dev")?);
        let low = self.number_or("from", f64::NEG_INFINITY)?;
        let high = self.number_or("to", f64::INFINITY)?;
        let (mut random, skip, draws) = self.random(stream)?;
        let mut values = Vec::new();
        let mut misses = 0;
        let mut left = skip;
        while misses < REDRAWS_MAX {
            let value = mean + random.gaussian() * sigma;
            if !(low.min(high)..=low.max(high)).contains(&value) {
                misses += 1;
                continue;
            }
            misses = 0;
            if left > 0 {
                left -= 1;
                continue;
            }
            values.push(value.to_string());
            if values.len() == draws {
                return Some(values);
            }
        }
        let message = format!("no draw lies between {low} and {high}");
        self.error(self.element.name.span, message)
    }

    /// The stream of a random variable, how many draws it skips, and how many it takes.
    fn random(&mut self, stream: usize) -> Option<(JavaRandom, usize, usize)> {
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
                if self.variables.seeds.len() > 1 {
                    let message = "the original drew these anew for each master seed; here they are those of the \
                                   first one";
                    let span = self.span("seed-source");
                    self.faults.push(Fault::warning(span, message));
                }
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
        if draws > RUNS_MAX as i64 {
            let message = format!("these are {draws} values, and {RUNS_MAX} runs are the most");
            return self.error(self.span("num-draws"), message);
        }
        Some((JavaRandom::new(seed), (first - 1) as usize, draws as usize))
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

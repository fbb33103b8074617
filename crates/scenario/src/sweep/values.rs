//! What may stand behind a key that varies: a list, a range, or draws.

use simbeeotic_model::config::{Fault, Node, Span, Table, Value};
use simbeeotic_model::kernel::Stream;
use std::collections::BTreeSet;

use super::RUNS_MAX;

/// Words of a range and of draws.
pub(super) const WORDS: [&str; 7] = ["from", "to", "step", "uniform", "normal", "draws", "seed"];
const RANGE: [&str; 3] = ["from", "to", "step"];
const UNIFORM: [&str; 3] = ["uniform", "draws", "seed"];
const NORMAL: [&str; 3] = ["normal", "draws", "seed"];
const HELP: &str = "for example: [1, 2, 5], { from = 1, to = 5, step = 2 }, { uniform = [1, 5], draws = 3 }, \
                    { normal = { mean = 1.5, sigma = 0.2 }, draws = 3 }";

/// All values that stand behind a key; the key's name names the stream of draws. At least one, unless
/// there are faults.
pub(super) fn values(name: &str, node: &Node, faults: &mut Vec<Fault>) -> Vec<Node> {
    let found = match &node.value {
        Value::Array(items) if items.is_empty() => {
            faults
                .push(Fault::error(node.span, "this list is empty: nothing would run").help(HELP));
            return Vec::new();
        }
        Value::Array(items) => each_once(items),
        Value::Table(table) if table.get("uniform").is_some() => {
            uniform(name, node.span, table).map(|nodes| drawn(node.span, nodes, faults))
        }
        Value::Table(table) if table.get("normal").is_some() => {
            normal(name, node.span, table).map(|nodes| drawn(node.span, nodes, faults))
        }
        Value::Table(table) => range(node.span, table),
        other => {
            let message = format!("{} where the values of a sweep are wanted", other.kind());
            Err(vec![Fault::error(node.span, message).help(HELP)])
        }
    };
    found.unwrap_or_else(|found| {
        faults.extend(found);
        Vec::new()
    })
}

/// The values of a list. One that stands there twice is an error: its runs would be the same, and count twice.
fn each_once(items: &[Node]) -> Result<Vec<Node>, Vec<Fault>> {
    let mut seen = BTreeSet::new();
    let twice = items.iter().filter(|node| !seen.insert(said(node)));
    let faults: Vec<Fault> = twice
        .map(|node| {
            let message = format!(
                "{} stands here twice: both runs would be the same",
                super::written(node)
            );
            Fault::error(node.span, message)
        })
        .collect();
    match faults.is_empty() {
        true => Ok(items.to_vec()),
        false => Err(faults),
    }
}

/// Keeps the first of what says the same, in a list whose placeholders were replaced.
pub(super) fn keep_once(node: &mut Node) {
    if let Value::Array(items) = &mut node.value {
        let mut seen = BTreeSet::new();
        items.retain(|node| seen.insert(said(node)));
    }
}

/// What a value says: `10 m` is `10.0 m`.
pub(crate) fn said(node: &Node) -> String {
    match Number::read(node) {
        Ok(number) => format!("{:?} {}", number.value + 0.0, number.unit),
        Err(_) => super::written(node),
    }
}

/// Drawn values, each once; a note if one was drawn twice.
fn drawn(span: Span, nodes: Vec<Node>, faults: &mut Vec<Fault>) -> Vec<Node> {
    let mut seen = BTreeSet::new();
    let (mut once, mut draws) = (Vec::new(), 0);
    for node in nodes {
        draws += 1;
        if seen.insert(said(&node)) {
            once.push(node);
        }
    }
    if once.len() < draws {
        let message = format!(
            "of these {draws} draws {} are different, and each runs once",
            once.len()
        );
        faults.push(Fault::note(span, message));
    }
    once
}

/// A number, and the unit that stands behind it.
#[derive(Clone, Debug, PartialEq)]
struct Number {
    value: f64,
    /// Digits behind the point, if it was written in plain digits.
    decimals: Option<usize>,
    /// Empty: a bare number.
    unit: String,
    whole: Option<i64>,
    span: Span,
}

impl Number {
    fn read(node: &Node) -> Result<Self, Fault> {
        let bare = |value: f64, whole| Self {
            value,
            decimals: decimals(&value.to_string()),
            unit: String::new(),
            whole,
            span: node.span,
        };
        match &node.value {
            Value::Integer(whole) => Ok(bare(*whole as f64, Some(*whole))),
            Value::Float(value) => Ok(bare(*value, None)),
            Value::String(text) => match split(text) {
                Some((digits, value, unit)) => Ok(Self {
                    value,
                    decimals: decimals(digits),
                    unit: unit.to_owned(),
                    whole: None,
                    span: node.span,
                }),
                None => {
                    let message = format!("`{text}` is neither a number nor a number with a unit");
                    Err(Fault::error(node.span, message))
                }
            },
            other => {
                let message = format!("{} where a number or a quantity is wanted", other.kind());
                Err(Fault::error(node.span, message))
            }
        }
    }

    /// An error if it has not the unit of another.
    fn same_unit(&self, other: &Self) -> Result<(), Fault> {
        if self.unit == other.unit {
            return Ok(());
        }
        let word = |number: &Self| match number.unit.as_str() {
            "" => "without a unit".to_owned(),
            unit => format!("in `{unit}`"),
        };
        let (own, other) = (word(self), word(other));
        let message = format!("{own}, and the first number is {other}: the units must be the same");
        Err(Fault::error(self.span, message))
    }
}

/// Digits, number and unit of a quantity.
pub(crate) fn split(text: &str) -> Option<(&str, f64, &str)> {
    let text = text.trim();
    let number = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E');
    let mut end = text.find(|c| !number(c)).unwrap_or(text.len());
    // Of `5 eV` and `3em` the letter belongs to the unit.
    while end > 0 {
        let digits = &text[..end];
        match digits.parse::<f64>() {
            Ok(value) if value.is_finite() => return Some((digits, value, text[end..].trim())),
            _ => end -= 1,
        }
    }
    None
}

fn decimals(digits: &str) -> Option<usize> {
    if digits.contains(['e', 'E']) {
        return None;
    }
    Some(digits.split_once('.').map_or(0, |(_, behind)| behind.len()))
}

/// `{ from, to, step }`, both ends included.
fn range(span: Span, table: &Table) -> Result<Vec<Node>, Vec<Fault>> {
    let mut faults = unknown(table, &RANGE);
    let mut read = |key: &str| -> Option<Result<Number, ()>> {
        let number = Number::read(table.get(key)?);
        Some(number.map_err(|fault| faults.push(fault)))
    };
    let (from, to, step) = (read("from"), read("to"), read("step"));
    for (key, there) in [("from", &from), ("to", &to)] {
        if there.is_none() {
            let message = format!("this range has no `{key}`");
            faults.push(Fault::error(span, message).help(HELP));
        }
    }
    let (Some(Ok(from)), Some(Ok(to))) = (from, to) else {
        return Err(faults);
    };
    let step = match step {
        Some(Ok(step)) => step,
        Some(Err(())) => return Err(faults),
        None => Number {
            value: if to.value < from.value { -1.0 } else { 1.0 },
            decimals: Some(0),
            whole: Some(if to.value < from.value { -1 } else { 1 }),
            ..from.clone()
        },
    };
    faults.extend(to.same_unit(&from).err());
    faults.extend(step.same_unit(&from).err());
    if step.value == 0.0 {
        faults.push(Fault::error(step.span, "a step of zero leads nowhere"));
    } else if (to.value - from.value) / step.value < 0.0 {
        let message = format!(
            "steps of {} never lead from {} to {}",
            step.value, from.value, to.value
        );
        let fault = Fault::error(step.span, message);
        faults.push(fault.help(format!("step = {} does", -step.value)));
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    // A hair of slack: ten steps of 0.01 lead from 0.2 to 0.3, whatever their sum.
    let steps = ((to.value - from.value) / step.value + 1e-9).floor();
    if steps.is_nan() || steps >= RUNS_MAX as f64 {
        return Err(vec![too_many(span, steps + 1.0)]);
    }
    let node = |at: i32| {
        let value = from.value + f64::from(at) * step.value;
        let value = match (from.whole, step.whole) {
            (Some(from), Some(step)) => {
                return Node::new(
                    span,
                    Value::Integer(from.wrapping_add(step.wrapping_mul(i64::from(at)))),
                );
            }
            _ => rounded(value, from.decimals.zip(step.decimals)),
        };
        match from.unit.as_str() {
            "" => Node::new(span, Value::Float(value)),
            unit => Node::string(span, format!("{value} {unit}")),
        }
    };
    Ok((0..=steps as i32).map(node).collect())
}

/// With no more decimals than its summands: 0.2 and ten times 0.01 are 0.3.
fn rounded(value: f64, decimals: Option<(usize, usize)>) -> f64 {
    let Some((a, b)) = decimals else { return value };
    let text = format!("{value:.*}", a.max(b).min(17));
    text.parse().unwrap_or(value)
}

fn too_many(span: Span, count: f64) -> Fault {
    let message = format!("these are {count} values, and {RUNS_MAX} runs are the most");
    Fault::error(span, message)
}

fn unknown(table: &Table, known: &[&str]) -> Vec<Fault> {
    let strange = table.entries.iter().map(|(key, _)| key);
    let strange = strange.filter(|key| !known.contains(&key.text.as_str()));
    strange
        .map(|key| Fault::unknown(key.span, "key", &key.text, known.iter().copied()))
        .collect()
}

/// How many draws, and the stream that they come from.
fn draws(
    name: &str,
    span: Span,
    table: &Table,
    purpose: &str,
    faults: &mut Vec<Fault>,
) -> (usize, Stream) {
    let mut whole = |key: &str, default: i64| match table.get(key) {
        None => default,
        Some(node) => match node.value {
            Value::Integer(whole) => whole,
            _ => {
                let message = format!("`{key}` is a whole number");
                faults.push(Fault::error(node.span, message));
                default
            }
        },
    };
    let (count, seed) = (whole("draws", 1), whole("seed", 1));
    let place = table.get("draws").map_or(span, |node| node.span);
    if count < 1 {
        faults.push(Fault::error(place, "there is one draw or more"));
    }
    if count > RUNS_MAX as i64 {
        faults.push(too_many(place, count as f64));
    }
    let stream = Stream::new(seed.cast_unsigned(), &format!("sweep/{name}"), purpose);
    (usize::try_from(count).unwrap_or(0).min(RUNS_MAX), stream)
}

/// `{ uniform = [low, high], draws, seed }`.
fn uniform(name: &str, span: Span, table: &Table) -> Result<Vec<Node>, Vec<Fault>> {
    let mut faults = unknown(table, &UNIFORM);
    let (count, mut stream) = draws(name, span, table, "uniform", &mut faults);
    let ends = table.get("uniform").map(|node| (node, node.as_array()));
    let Some((_, Some([low, high]))) = ends else {
        let place = ends.map_or(span, |(node, _)| node.span);
        let fault = Fault::error(place, "`uniform` is a list of two ends");
        faults.push(fault.help("for example: { uniform = [\"1 m\", \"3 m\"], draws = 5 }"));
        return Err(faults);
    };
    let (low, high) = pair(low, high, &mut faults).ok_or_else(|| faults.clone())?;
    if high.value < low.value {
        let message = format!("{} is more than {}", low.value, high.value);
        faults.push(Fault::error(low.span, message).help("the lower end comes first"));
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    let node = |_| match (low.whole, high.whole) {
        (Some(first), Some(last)) => {
            let more = match last.abs_diff(first).checked_add(1) {
                Some(values) => stream.below(values),
                None => stream.next_u64(),
            };
            Node::new(span, Value::Integer(first.wrapping_add_unsigned(more)))
        }
        _ => {
            let value = low.value + stream.uniform() * (high.value - low.value);
            quantity(span, value, &low.unit)
        }
    };
    Ok((0..count).map(node).collect())
}

/// `{ normal = { mean, sigma }, draws, seed }`.
fn normal(name: &str, span: Span, table: &Table) -> Result<Vec<Node>, Vec<Fault>> {
    let mut faults = unknown(table, &NORMAL);
    let (count, mut stream) = draws(name, span, table, "normal", &mut faults);
    let inner = table.get("normal");
    let parts = inner.and_then(Node::as_table);
    faults.extend(
        parts
            .map(|t| unknown(t, &["mean", "sigma"]))
            .unwrap_or_default(),
    );
    let (Some(mean), Some(sigma)) = (
        parts.and_then(|t| t.get("mean")),
        parts.and_then(|t| t.get("sigma")),
    ) else {
        let place = inner.map_or(span, |node| node.span);
        let fault = Fault::error(place, "`normal` is a table with `mean` and `sigma`");
        faults.push(fault.help("for example: { normal = { mean = 1.5, sigma = 0.2 }, draws = 3 }"));
        return Err(faults);
    };
    let (mean, sigma) = pair(mean, sigma, &mut faults).ok_or_else(|| faults.clone())?;
    if sigma.value < 0.0 {
        let message = "a standard deviation is not negative";
        faults.push(Fault::error(sigma.span, message));
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    let node = |_| quantity(span, mean.value + stream.normal() * sigma.value, &mean.unit);
    Ok((0..count).map(node).collect())
}

fn pair(first: &Node, second: &Node, faults: &mut Vec<Fault>) -> Option<(Number, Number)> {
    let mut read = |node| Number::read(node).map_err(|fault| faults.push(fault)).ok();
    let (first, second) = (read(first), read(second));
    let (first, second) = (first?, second?);
    faults.extend(second.same_unit(&first).err());
    Some((first, second))
}

/// A drawn value, with six digits: it stands in tables and is what runs.
fn quantity(span: Span, value: f64, unit: &str) -> Node {
    let value = format!("{value:.5e}").parse().unwrap_or(value);
    match unit {
        "" => Node::new(span, Value::Float(value)),
        unit => Node::string(span, format!("{value} {unit}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_model::config::SourceId;

    fn read(text: &str) -> Result<Vec<String>, Vec<Fault>> {
        let node = crate::toml::parse_value(text, SourceId(0)).expect("a value");
        let mut faults = Vec::new();
        let values = values("key", &node, &mut faults);
        match faults.iter().any(Fault::is_error) {
            false => Ok(values.iter().map(super::super::written).collect()),
            true => Err(faults),
        }
    }

    #[test]
    fn both_ends_of_a_range_count_upwards_and_downwards() {
        for (text, values) in [
            ("{ from = 10, to = 50, step = 20 }", "10 30 50"),
            ("{ from = 3, to = 1, step = -1 }", "3 2 1"),
            ("{ from = 3, to = 1 }", "3 2 1"),
            ("{ from = 1, to = 3 }", "1 2 3"),
            ("{ from = 5, to = 5 }", "5"),
            ("{ from = 1, to = 2, step = 0.5 }", "1.0 1.5 2.0"),
            ("{ from = 0, to = 7, step = 3 }", "0 3 6"),
        ] {
            assert_eq!(read(text).expect(text).join(" "), values, "{text}");
        }
        let fine = read("{ from = 0.2, to = 0.3, step = 0.01 }").expect("a range");
        assert_eq!(fine.len(), 11);
        assert_eq!((fine[1].as_str(), fine[10].as_str()), ("0.21", "0.3"));
        let quantities = read("{ from = \"10 m\", to = \"20 m\", step = \"2.5 m\" }");
        let wanted = ["10 m", "12.5 m", "15 m", "17.5 m", "20 m"];
        assert_eq!(quantities.expect("a range"), wanted);
    }

    #[test]
    fn draws_are_within_their_ends_and_the_same_each_time() {
        let text = "{ uniform = [\"1 m\", \"3 m\"], draws = 200 }";
        let drawn = read(text).expect("draws");
        assert_eq!(drawn, read(text).expect("the same"));
        let numbers: Vec<f64> = drawn
            .iter()
            .map(|t| split(t).expect("a quantity").1)
            .collect();
        assert!(numbers.iter().all(|x| (1.0..3.0).contains(x)));
        let mean = numbers.iter().sum::<f64>() / 200.0;
        // The deviation of the mean is 2 / sqrt(12 * 200) = 0.041.
        assert!((mean - 2.0).abs() < 0.17, "{mean}");
        let other = read("{ uniform = [\"1 m\", \"3 m\"], draws = 200, seed = 2 }");
        assert_ne!(drawn, other.expect("draws"));
        let longer = read("{ uniform = [\"1 m\", \"3 m\"], draws = 201 }").expect("draws");
        assert_eq!(drawn, longer[..200], "more draws leave the first ones");
        let mut whole = read("{ uniform = [1, 3], draws = 50 }").expect("draws");
        whole.sort();
        assert_eq!(whole, ["1", "2", "3"], "each runs once");
    }

    #[test]
    fn normal_draws_have_their_mean_and_deviation() {
        let drawn = read("{ normal = { mean = 8, sigma = 2.0 }, draws = 1000 }").expect("draws");
        let numbers: Vec<f64> = drawn.iter().map(|t| t.parse().expect("a number")).collect();
        let mean = numbers.iter().sum::<f64>() / 1000.0;
        let square = numbers.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 999.0;
        // Four standard deviations of the two estimates: 0.063 and 0.045.
        assert!((mean - 8.0).abs() < 0.26, "{mean}");
        assert!((square.sqrt() - 2.0).abs() < 0.18, "{square}");
    }

    #[test]
    fn what_leads_nowhere_is_refused_where_it_stands() {
        for (text, word) in [
            ("[]", "this list is empty"),
            ("[2, 5, 2]", "2 stands here twice"),
            ("[2, 5, 2.0]", "2.0 stands here twice"),
            ("[\"10 m\", \"10.0 m\"]", "10.0 m stands here twice"),
            ("[\"a.toml\", \"a.toml\"]", "a.toml stands here twice"),
            ("[[1, 2], [1, 2]]", "[1, 2] stands here twice"),
            ("5", "a whole number where the values of a sweep are wanted"),
            (
                "{ from = 1, to = 5, step = 0 }",
                "a step of zero leads nowhere",
            ),
            ("{ from = 1, to = 5, step = -1 }", "never lead from 1 to 5"),
            ("{ from = 5, to = 1, step = 2 }", "never lead from 5 to 1"),
            (
                "{ from = \"1 m\", to = \"5 km\" }",
                "the units must be the same",
            ),
            (
                "{ from = \"1 m\", to = \"5 m\", step = 1 }",
                "the units must be the same",
            ),
            ("{ from = 1 }", "this range has no `to`"),
            ("{ from = 1, too = 2 }", "unknown key `too`"),
            ("{ from = \"near\", to = 2 }", "`near` is neither a number"),
            ("{ from = [1], to = 2 }", "a list where a number"),
            ("{ from = 0, to = 1e300 }", "1000000 runs are the most"),
            ("{ from = 0, to = 1000000 }", "these are 1000001 values"),
            (
                "{ uniform = [1], draws = 2 }",
                "`uniform` is a list of two ends",
            ),
            ("{ uniform = [3, 1] }", "3 is more than 1"),
            ("{ uniform = [1, 3], draws = 0 }", "one draw or more"),
            (
                "{ uniform = [1, 3], draws = 2000000 }",
                "1000000 runs are the most",
            ),
            (
                "{ uniform = [1, 3], draws = 1.5 }",
                "`draws` is a whole number",
            ),
            (
                "{ uniform = [\"1 m\", \"3 s\"] }",
                "the units must be the same",
            ),
            (
                "{ normal = 3 }",
                "`normal` is a table with `mean` and `sigma`",
            ),
            (
                "{ normal = { mean = 1 } }",
                "`normal` is a table with `mean` and `sigma`",
            ),
            ("{ normal = { mean = 1, sigma = -1 } }", "is not negative"),
            (
                "{ normal = { mean = 1, sigma = 1, min = 0 } }",
                "unknown key `min`",
            ),
        ] {
            let faults = read(text).expect_err(text);
            assert!(
                faults.iter().any(|f| f.message.contains(word)),
                "{text}: {faults:?}"
            );
        }
    }

    #[test]
    fn a_quantity_is_a_number_and_its_unit() {
        assert_eq!(split("10 m").map(|(_, n, u)| (n, u)), Some((10.0, "m")));
        assert_eq!(
            split("-1e3m/s").map(|(_, n, u)| (n, u)),
            Some((-1000.0, "m/s"))
        );
        assert_eq!(split("5 eV").map(|(_, n, u)| (n, u)), Some((5.0, "eV")));
        assert_eq!(split("3em").map(|(_, n, u)| (n, u)), Some((3.0, "em")));
        assert_eq!(split("m"), None);
        assert_eq!(split("ä"), None);
        assert_eq!(split(""), None);
    }
}

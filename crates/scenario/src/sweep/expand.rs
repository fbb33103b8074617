//! Keys and what stands behind them, to combinations of values.

use super::read::{self, Draft, Entry};
use super::{Axis, RUNS_MAX, Sweep, values};
use crate::load::Base;
use crate::variables::{KEY as VARIABLES, Variables, named};
use simbeeotic_model::config::{Fault, Node, Span, Table, Value};
use std::collections::BTreeMap;

/// The runs that a draft asks for, or, if there is an error in it, a scenario with the first value of each
/// key that has one: what is wrong with that is told, too.
pub(crate) fn expand(draft: Draft, base: Base, faults: &mut Vec<Fault>) -> Result<Sweep, Node> {
    let before = faults.iter().filter(|fault| fault.is_error()).count();
    let own = base.tree.as_table().and_then(|table| table.get(VARIABLES));
    let own = own.and_then(Node::as_table).cloned().unwrap_or_default();
    let keys = ordered(draft.keys, &own, faults);
    let mut expander = Expander {
        own,
        given: &base.given,
        axes: keys.iter().map(axis).collect(),
        keys: &keys,
        known: vec![BTreeMap::new(); keys.len()],
        combinations: Vec::new(),
        faults: Vec::new(),
    };
    let product = expander.product();
    expander.descend(&mut Vec::new());
    let Expander {
        axes,
        combinations,
        faults: found,
        ..
    } = expander;
    faults.extend(found);
    let mut sweep = Sweep {
        base,
        seeds: None,
        axes,
        combinations,
    };
    if let Some(node) = &draft.seeds {
        let first = own_seed(&sweep, 0);
        sweep.seeds = Some(read::seeds(node, first, faults));
    }
    if faults.iter().filter(|fault| fault.is_error()).count() > before {
        return Err(sweep.first_values(faults));
    }
    let each = sweep.seeds.as_ref().map_or(1, Vec::len);
    let combinations = product.unwrap_or(sweep.combinations.len() as f64);
    let runs = combinations * each as f64;
    if runs > RUNS_MAX as f64 {
        let of = match each {
            1 => String::new(),
            each => format!(" ({combinations} combinations with {each} seeds each)"),
        };
        let message = format!("these are {runs} runs{of}, and {RUNS_MAX} are the most");
        faults.push(Fault::error(draft.span, message));
        return Err(sweep.first_values(faults));
    }
    Ok(sweep)
}

fn axis(entry: &Entry) -> Axis {
    Axis {
        name: entry.name.clone(),
        path: entry.path.clone(),
        span: entry.span,
        values: Vec::new(),
    }
}

/// The seed of a run as its scenario has it.
pub(super) fn own_seed(sweep: &Sweep, run: usize) -> i64 {
    let mut faults = Vec::new();
    let mut tree = match sweep.combinations.is_empty() {
        true => sweep.base.tree.clone(),
        false => sweep.tree(run, &mut faults),
    };
    let mut variables = sweep.base.given.clone();
    variables.extend(Variables::of(&tree, &mut faults));
    variables.apply(&mut tree, &mut faults);
    let run = tree.as_table().and_then(|table| table.get("run"));
    let seed = run.and_then(Node::as_table).and_then(|t| t.get("seed"));
    match seed.map(|node| &node.value) {
        Some(Value::Integer(seed)) => *seed,
        _ => 1,
    }
}

/// The name of the variable that a key sets.
fn variable(entry: &Entry) -> Option<&str> {
    match entry.path.as_slice() {
        [table, name] if table.text == VARIABLES => Some(&name.text),
        _ => None,
    }
}

/// Keys in the order of the file, but each behind the variables that its values name.
fn ordered(keys: Vec<Entry>, own: &Table, faults: &mut Vec<Fault>) -> Vec<Entry> {
    let needs: Vec<Vec<usize>> = keys
        .iter()
        .map(|entry| {
            let mut names = Vec::new();
            collect(&entry.node, own, &mut names);
            let of_key = |name: &String| keys.iter().position(|k| variable(k) == Some(name));
            names.iter().filter_map(of_key).collect()
        })
        .collect();
    let mut order: Vec<usize> = Vec::new();
    loop {
        let ready =
            |at: &usize| !order.contains(at) && needs[*at].iter().all(|need| order.contains(need));
        match (0..keys.len()).find(ready) {
            Some(at) => order.push(at),
            None => break,
        }
    }
    for (at, entry) in keys.iter().enumerate() {
        if !order.contains(&at) {
            let message = format!("the values of `{}` depend on themselves", entry.name);
            faults.push(Fault::error(entry.span, message));
        }
    }
    order.into_iter().map(|at| keys[at].clone()).collect()
}

/// The variables that a tree names, and those that their values in `[variables]` name.
fn collect(node: &Node, own: &Table, names: &mut Vec<String>) {
    match &node.value {
        Value::Table(table) => table
            .entries
            .iter()
            .for_each(|(_, n)| collect(n, own, names)),
        Value::Array(items) => items.iter().for_each(|n| collect(n, own, names)),
        Value::String(text) => {
            for name in named(text) {
                if !names.iter().any(|known| known == name) {
                    names.push(name.to_owned());
                    if let Some(node) = own.get(name) {
                        collect(node, own, names);
                    }
                }
            }
        }
        _ => {}
    }
}

struct Expander<'a> {
    /// The scenario's own variables.
    own: Table,
    given: &'a Variables,
    keys: &'a [Entry],
    axes: Vec<Axis>,
    /// For each key, the values of what stood behind it once placeholders were replaced.
    known: Vec<BTreeMap<String, Vec<u32>>>,
    combinations: Vec<Box<[u32]>>,
    faults: Vec<Fault>,
}

impl Expander<'_> {
    /// Finds the values of all keys that name no variable. If that is all, tells how many combinations
    /// there are.
    fn product(&mut self) -> Option<f64> {
        let mut product = Some(1.0);
        for at in 0..self.keys.len() {
            let mut names = Vec::new();
            collect(&self.keys[at].node, &Table::default(), &mut names);
            if names.is_empty() {
                let count = self.values(at, &[]).len();
                product = product.map(|product| product * count as f64);
            } else {
                product = None;
            }
        }
        product
    }

    /// Adds all combinations that begin with these places.
    fn descend(&mut self, places: &mut Vec<u32>) {
        let at = places.len();
        if at == self.keys.len() {
            self.combinations.push(places.as_slice().into());
            return;
        }
        for place in self.values(at, places) {
            // One more than may be: told by the caller.
            if self.combinations.len() > RUNS_MAX {
                return;
            }
            places.push(place);
            self.descend(places);
            places.pop();
        }
    }

    /// The places of a key's values, given those of the keys before it.
    fn values(&mut self, at: usize, places: &[u32]) -> Vec<u32> {
        let entry = &self.keys[at];
        let mut names = Vec::new();
        collect(&entry.node, &Table::default(), &mut names);
        let node = match names.is_empty() {
            true => entry.node.clone(),
            false => {
                let mut node = self.resolved(&entry.node, places);
                values::keep_once(&mut node);
                node
            }
        };
        let text = crate::print::value(&node);
        if let Some(known) = self.known[at].get(&text) {
            return known.clone();
        }
        let found = values::values(&entry.name, &node, &mut self.faults);
        let all = &mut self.axes[at].values;
        let first = all.len();
        all.extend(found);
        let known: Vec<u32> = (first..all.len()).map(|place| place as u32).collect();
        self.known[at].insert(text, known.clone());
        known
    }

    /// What stands behind a key, its placeholders replaced by what the keys before it say.
    fn resolved(&mut self, node: &Node, places: &[u32]) -> Node {
        let mut own = self.own.clone();
        for ((entry, axis), place) in self.keys.iter().zip(&self.axes).zip(places) {
            if variable(entry).is_some() {
                own.insert(entry.path[1].clone(), axis.values[*place as usize].clone());
            }
        }
        let mut root = Table::default();
        root.set(VARIABLES, Node::new(Span::default(), Value::Table(own)));
        let root = Node::new(Span::default(), Value::Table(root));
        let mut faults = Vec::new();
        let mut variables = self.given.clone();
        variables.extend(Variables::of(&root, &mut faults));
        let mut node = node.clone();
        variables.apply(&mut node, &mut faults);
        for fault in faults {
            if !self.faults.contains(&fault) {
                self.faults.push(fault);
            }
        }
        node
    }
}

//! `[sweep]`: one scenario, run many times with other values.
//!
//! ```toml
//! [sweep]
//! seeds = 10                                  # run.seed and the nine that follow; or [1, 5, 9]
//!
//! [sweep.vary]                                # keys are paths, as for `--set`
//! "model.bee.params.spacing" = ["10 m", "20 m", "30 m"]
//! "model.bee.count" = { from = 10, to = 50, step = 20 }
//! "variables.wall" = { uniform = ["1 m", "3 m"], draws = 5 }
//! "channel.noise_floor.sigma" = { normal = { mean = "8 dB", sigma = "1 dB" }, draws = 5, seed = 7 }
//! ```
//! There is a run for each combination of values, for each seed. The values of the last key change
//! first, the seeds change last: the runs of the first seed are complete before those of the second
//! begin. Values may have placeholders, `{ from = "${low}", to = 9 }`; a key whose values name a
//! variable that varies comes after that variable.
//!
//! Without its sweep a scenario is what stands in it.
//!
//! An XML scenario's `looping` and a master seed with several values are the same thing.
//!
//! Reading order: [`Sweep`], `read` (the tree to keys), `values` (what stands behind a key), `expand`
//! (keys to combinations), `made_of` (what the runs hang on).

mod expand;
mod made_of;
mod read;
mod values;

pub use made_of::hash_of;

pub(crate) use expand::expand;
pub(crate) use read::{Fixed, SEEDS, VARY, read};
pub(crate) use values::{said, split as split_quantity};

/// Number and unit of a quantity in a text, `10 m`; the unit of a bare number is empty.
pub fn quantity(text: &str) -> Option<(f64, &str)> {
    values::split(text).map(|(_, number, unit)| (number, unit))
}

use crate::load::{Base, Loaded, Rejected};
use crate::print;
use simbeeotic_model::config::{Fault, Key, Node, Span, Value};
use std::collections::BTreeSet;

/// The key of the table.
pub(crate) const KEY: &str = "sweep";

/// Most runs of one sweep.
pub const RUNS_MAX: usize = 1_000_000;

/// Most combinations that [`Sweep::check`] puts together.
pub const CHECKED_MAX: usize = 2_000;

/// A key that varies, with all values that it takes.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    /// The path, as text.
    name: String,
    path: Vec<Key>,
    /// Where it was written.
    span: Span,
    values: Vec<Node>,
}

/// The runs that a scenario asks for.
#[derive(Clone, Debug)]
pub struct Sweep {
    base: Base,
    /// `None`: each run has the seed that its scenario says.
    seeds: Option<Vec<i64>>,
    axes: Vec<Axis>,
    /// For each combination the place of each key's value among those that the key takes.
    combinations: Vec<Box<[u32]>>,
}

impl Sweep {
    /// How many runs there are, one or more.
    #[allow(clippy::len_without_is_empty, reason = "there is at least one run")]
    pub fn len(&self) -> usize {
        self.combinations.len() * self.seeds.as_ref().map_or(1, Vec::len)
    }

    /// How many combinations of values there are, each run with each seed.
    pub fn combinations(&self) -> usize {
        self.combinations.len()
    }

    /// The paths that vary, in the order of [`values`](Self::values).
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.axes.iter().map(|axis| axis.name.as_str())
    }

    /// The seeds, if the sweep says which; the same 64 bits as those of a run.
    pub fn seeds(&self) -> Option<&[i64]> {
        self.seeds.as_deref()
    }

    /// The seed of a run, counted from 0: what the sweep says, else what its scenario does. `None` if there
    /// is no such run.
    pub fn seed(&self, run: usize) -> Option<i64> {
        if run >= self.len() {
            return None;
        }
        match &self.seeds {
            Some(seeds) => seeds.get(run / self.combinations.len()).copied(),
            None => Some(expand::own_seed(self, run)),
        }
    }

    /// The values of a run, counted from 0, as text; none for a run that there is not.
    pub fn values(&self, run: usize) -> Vec<String> {
        self.nodes(run).map(|(_, node)| written(node)).collect()
    }

    fn nodes(&self, run: usize) -> impl Iterator<Item = (&Axis, &Node)> {
        let places = match run < self.len() {
            true => &*self.combinations[run % self.combinations.len()],
            false => &[],
        };
        let places = places.iter().map(|place| *place as usize);
        let pairs = self.axes.iter().zip(places);
        pairs.map(|(axis, place)| (axis, &axis.values[place]))
    }

    /// The scenario of a run, counted from 0, checked.
    ///
    /// # Errors
    /// Everything that is wrong with it; that there is no such run.
    pub fn load(&self, run: usize) -> Result<Loaded, Rejected> {
        let mut faults = Vec::new();
        if run >= self.len() {
            let message = format!("there is no run {run}: there are {}, from 0", self.len());
            faults.push(Fault::error(None, message));
        }
        let tree = self.tree(run, &mut faults);
        self.base.plan(tree, faults)
    }

    /// The tree of a run.
    pub(crate) fn tree(&self, run: usize, faults: &mut Vec<Fault>) -> Node {
        let mut tree = self.base.tree.clone();
        let mut nodes: Vec<(&Axis, &Node)> = self.nodes(run).collect();
        // A table before what is in it.
        nodes.sort_by_key(|(axis, _)| axis.path.len());
        for (axis, node) in nodes {
            faults.extend(crate::set::place(&mut tree, &axis.path, node.clone()).err());
        }
        let seeds = self.seeds.as_ref().filter(|_| run < self.len());
        if let Some(seed) = seeds.and_then(|seeds| seeds.get(run / self.combinations.len())) {
            read::put_seed(&mut tree, *seed);
        }
        tree
    }

    /// The scenario with the first value of each key that has one.
    fn first_values(&self, faults: &mut Vec<Fault>) -> Node {
        let mut tree = self.base.tree.clone();
        for axis in &self.axes {
            let value = axis.values.first().cloned();
            let place = |node| crate::set::place(&mut tree, &axis.path, node).err();
            faults.extend(value.and_then(place));
        }
        tree
    }

    /// Puts together combinations until each value of each key has been in one of them, and tells what
    /// is wrong with them, each fault once. No more than [`CHECKED_MAX`] combinations are looked at.
    ///
    /// # Errors
    /// Everything that is wrong with one of them.
    pub fn check(&self) -> Result<(), Rejected> {
        self.check_but(&[])
    }

    /// The same, without faults that are known already.
    pub(crate) fn check_but(&self, known: &[Fault]) -> Result<(), Rejected> {
        let mut seen: Vec<Vec<bool>> = (self.axes.iter())
            .map(|axis| vec![false; axis.values.len()])
            .collect();
        let told = known
            .iter()
            .map(|fault| (fault.span, fault.message.clone()));
        let mut told: BTreeSet<_> = told.collect();
        let mut found: Option<Rejected> = None;
        let mut checked = 0;
        for (run, places) in self.combinations.iter().enumerate() {
            let mut new = false;
            for (seen, place) in seen.iter_mut().zip(places) {
                new |= !std::mem::replace(&mut seen[*place as usize], true);
            }
            if !new || checked == CHECKED_MAX {
                continue;
            }
            checked += 1;
            let Err(rejected) = self.load(run) else {
                continue;
            };
            for mut fault in rejected.faults.into_iter().filter(Fault::is_error) {
                if !told.insert((fault.span, fault.message.clone())) {
                    continue;
                }
                if !self.is_own(&fault) {
                    fault.message = format!("{} ({})", fault.message, self.said(run));
                }
                let all = found.get_or_insert_with(|| Rejected {
                    faults: Vec::new(),
                    sources: rejected.sources.clone(),
                });
                all.faults.push(fault);
            }
        }
        match found {
            None => Ok(()),
            Some(mut all) => {
                all.faults.sort_by_key(|fault| fault.span);
                Err(all)
            }
        }
    }

    /// Whether a fault points at a key that varies, or at one of its values.
    fn is_own(&self, fault: &Fault) -> bool {
        let Some(span) = fault.span else { return false };
        let spans = |axis: &Axis| {
            axis.span.contains(span) || axis.values.iter().any(|node| node.span.contains(span))
        };
        self.axes.iter().any(spans)
    }

    /// What sets a run apart, for a message: `with a = 1, b = 2`.
    fn said(&self, run: usize) -> String {
        let pairs = self.nodes(run);
        let pairs = pairs.map(|(axis, node)| format!("{} = {}", axis.name, written(node)));
        format!("with {}", pairs.collect::<Vec<_>>().join(", "))
    }
}

/// A value as it was given: text without its quotes.
fn written(node: &Node) -> String {
    match &node.value {
        Value::String(text) => text.clone(),
        _ => print::value(node),
    }
}

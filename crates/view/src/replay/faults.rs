//! What of a recording cannot be read.

use simbeeotic_record::ReadError;
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Faults of a recording that a page is told.
const MAX: usize = 5;

/// What could not be read, each once.
#[derive(Default)]
pub(super) struct Faults(RefCell<BTreeSet<String>>);

impl Faults {
    /// Those that are read; of the others is kept why not.
    pub(super) fn good<'a, T: 'a>(
        &'a self,
        items: impl Iterator<Item = Result<T, ReadError>> + 'a,
    ) -> impl Iterator<Item = T> + 'a {
        items.filter_map(|item| item.map_err(|e| self.add(e.to_string())).ok())
    }

    fn add(&self, text: String) {
        let mut known = self.0.borrow_mut();
        if known.len() < MAX {
            known.insert(text);
        }
    }

    /// For people.
    pub(super) fn into_list(self) -> Vec<String> {
        self.0.into_inner().into_iter().collect()
    }
}

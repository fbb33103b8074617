//! Tables that a part's parameter `file` names: read, and what is said of one that cannot be used.

use simbeeotic_model::radio::TableFault;
use simbeeotic_model::{BuildError, Site};
use std::fmt::Display;

/// Faults shown of one file.
const SHOWN: usize = 20;

/// A file that holds a table.
pub(crate) struct TableFile {
    /// Its name, for messages.
    pub(crate) name: String,
    pub(crate) text: String,
}

impl TableFile {
    /// Reads the file of a part; `columns` says what it holds.
    ///
    /// # Errors
    /// No file is named, or it cannot be read.
    pub(crate) fn read(site: &Site<'_>, file: &str, columns: &str) -> Result<Self, BuildError> {
        let wrong = |message: String| BuildError::parameter("file", message);
        if file.is_empty() {
            return Err(wrong(format!(
                "must name a file with the columns {columns}"
            )));
        }
        let path = site.file(file);
        let name = path.display().to_string();
        match std::fs::read_to_string(&path) {
            Ok(text) => Ok(Self { name, text }),
            Err(error) => Err(wrong(format!("cannot be read: {name}: {error}"))),
        }
    }

    /// What is said of it because of these faults.
    pub(crate) fn refused(&self, faults: &[TableFault]) -> BuildError {
        let faults = placed(&self.name, faults);
        BuildError::parameter("file", format!("cannot be used: {faults}"))
    }
}

/// Faults of a file one after the other, each with its place.
pub(crate) fn placed(file: &str, faults: &[TableFault]) -> String {
    listed(faults.iter().map(|fault| format!("{file}:{fault}")), SHOWN)
}

/// Faults one after the other, `most` of them at most, and how many more there are.
pub(crate) fn listed(faults: impl ExactSizeIterator<Item = impl Display>, most: usize) -> String {
    let more = faults.len().saturating_sub(most);
    let mut lines: Vec<String> = faults.take(most).map(|fault| fault.to_string()).collect();
    if more > 0 {
        lines.push(format!("and {more} more"));
    }
    lines.join("; ")
}

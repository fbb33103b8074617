//! What a check has to say: a summary, notes, faults.

/// The outcome of one check. Without faults it held.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Report {
    /// One short sentence about what was looked at; empty if there is nothing to add to "ok".
    pub(crate) summary: String,
    /// Worth reading, but no reason to fail.
    pub(crate) notes: Vec<String>,
    /// Each one a reason to fail, with its place (`file:line: what`) where it has one.
    pub(crate) faults: Vec<String>,
    /// The check could not be made on this machine (a tool is not installed). Told loudly, no failure.
    pub(crate) skipped: bool,
}

impl Report {
    /// A report that only says what was looked at.
    pub(crate) fn of(summary: impl Into<String>) -> Self {
        Self {
            summary: summary.into(),
            ..Self::default()
        }
    }

    /// A report of one fault.
    pub(crate) fn fault(fault: impl Into<String>) -> Self {
        Self {
            faults: vec![fault.into()],
            ..Self::default()
        }
    }

    /// A report of a check that could not be made here.
    pub(crate) fn skipped(reason: impl Into<String>) -> Self {
        Self {
            summary: reason.into(),
            skipped: true,
            ..Self::default()
        }
    }

    /// True if nothing is wrong.
    pub(crate) fn holds(&self) -> bool {
        self.faults.is_empty()
    }

    /// The word for the summary's first column.
    pub(crate) fn verdict(&self) -> &'static str {
        match (self.holds(), self.skipped) {
            (false, _) => "FAILED",
            (true, true) => "SKIPPED",
            (true, false) => "ok",
        }
    }
}

//! What is wrong with an input, and where.

use super::node::Span;
use std::collections::BTreeSet;

/// How bad a [`Fault`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// The scenario does not run.
    Error,
    /// It runs, but perhaps not as meant.
    Warning,
    /// Something to know: what the original did wrong and we do right, say.
    Note,
}

/// One fault in an input. Faults are collected, and shown together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct Fault {
    /// How bad it is.
    pub level: Level,
    /// Where it was written, if it was.
    pub span: Option<Span>,
    /// What is wrong: one sentence, no full stop.
    pub message: String,
    /// What is allowed, or what was probably meant.
    pub help: Option<String>,
}

impl Fault {
    /// An error at `span`.
    pub fn error(span: impl Into<Option<Span>>, message: impl Into<String>) -> Self {
        Self {
            level: Level::Error,
            span: span.into(),
            message: message.into(),
            help: None,
        }
    }

    /// A warning at `span`.
    pub fn warning(span: impl Into<Option<Span>>, message: impl Into<String>) -> Self {
        Self {
            level: Level::Warning,
            ..Self::error(span, message)
        }
    }

    /// A note at `span`.
    pub fn note(span: impl Into<Option<Span>>, message: impl Into<String>) -> Self {
        Self {
            level: Level::Note,
            ..Self::error(span, message)
        }
    }

    /// The same fault with a hint.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// An error about `word` at `span` that lists what is known and guesses what was meant.
    pub fn unknown<'a>(
        span: impl Into<Option<Span>>,
        what: &str,
        word: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let mut known: Vec<&str> = known.into_iter().collect();
        // A key with an old name is said to be known twice.
        let mut seen = BTreeSet::new();
        known.retain(|key| seen.insert(*key));
        let help = match simbeeotic_units::did_you_mean(word, known.iter().copied()) {
            Some(guess) => format!("did you mean `{guess}`?"),
            None if known.is_empty() => "there is none to choose from".to_owned(),
            None => format!("known: {}", list(&known)),
        };
        Self::error(span, format!("unknown {what} `{word}`")).help(help)
    }

    /// Whether the scenario must not run.
    pub fn is_error(&self) -> bool {
        self.level == Level::Error
    }
}

/// Words as `` `a`, `b`, `c` ``.
pub fn list<S: AsRef<str>>(words: &[S]) -> String {
    words
        .iter()
        .map(|w| format!("`{}`", w.as_ref()))
        .collect::<Vec<_>>()
        .join(", ")
}

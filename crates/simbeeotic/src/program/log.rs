//! `run --log`: what models write to the log, on standard error as it happens.

use super::remark;
use simbeeotic_model::{Component, ComponentError, Mark, Note, Summary, View};
use simbeeotic_units::Time;

/// Prints the log lines of all models.
pub(super) struct LogPrinter;

impl LogPrinter {
    fn print(view: &View<'_>) {
        for mark in view.marks() {
            if let Mark::Log { time, model, text } = mark {
                remark(format!(
                    "{time}  {}: {text}",
                    view.population().path(*model)
                ));
            }
        }
    }
}

impl Component for LogPrinter {
    fn period(&self) -> Option<Time> {
        Some(Time::from_millis(100.0))
    }

    fn start(&mut self, _view: &View<'_>) -> Result<(), ComponentError> {
        Ok(())
    }

    fn observe(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        Self::print(view);
        Ok(())
    }

    fn finish(&mut self, view: &View<'_>, _: &Summary) -> Result<Vec<Note>, ComponentError> {
        Self::print(view);
        Ok(Vec::new())
    }
}

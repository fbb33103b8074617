//! When two forms first touch.

use crate::motion::Motion;
use crate::shape::form::Form;
use simbeeotic_kernel::SimTime;

/// One of the two in a search.
#[derive(Clone, Copy)]
pub(crate) struct Side<'a> {
    pub(crate) motion: &'a Motion,
    pub(crate) form: &'a Form,
}

/// The first touch in the span.
pub(crate) fn meets(
    _a: Side<'_>,
    _b: Option<Side<'_>>,
    _from: SimTime,
    _to: SimTime,
) -> Option<SimTime> {
    None
}

//! No air at all.

use simbeeotic_model::radio::Medium;
use simbeeotic_model::{Air, BuildError, Fidelity, medium, params};

/// No packet goes anywhere, and radios draw nothing: to see what a swarm does without them.
#[medium("off")]
pub struct Off;

/// Nothing to set.
#[params]
#[derive(Default)]
pub struct OffParams {}

impl Fidelity for Off {
    type Params = OffParams;

    fn medium(_params: OffParams, _air: &Air) -> Result<Option<Box<dyn Medium>>, BuildError> {
        Ok(None)
    }
}

//! A bee that does nothing.

use simbeeotic_model::{Bee, Behavior, BuildError, Kit, behavior, params};

/// A bee that does nothing but fall: for drops, and for wind.
#[behavior("inert-bee", java = "harvard.robobees.simbeeotic.example.InertBee")]
pub struct InertBee {
    hover: bool,
}

/// Parameters of [`InertBee`].
#[params]
#[derive(Default)]
pub struct InertBeeParams {
    /// Whether it carries its own weight.
    pub hover: bool,
}

impl Behavior for InertBee {
    type Params = InertBeeParams;

    fn build(params: InertBeeParams, _kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        Ok(Self {
            hover: params.hover,
        })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        bee.hover(self.hover);
    }
}

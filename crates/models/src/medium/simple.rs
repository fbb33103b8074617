//! The medium of the paper.

use simbeeotic_model::radio::{Medium, SimpleConfig, SimpleMedium};
use simbeeotic_model::{Air, BuildError, Fidelity, medium, params};
use std::sync::Arc;

/// The paper's air: no air time, no interference; noise is drawn for each reception.
///
/// A frame reaches everybody in range at once. Lost are frames below the receiver's sensitivity, and
/// those that its error model gives up at the ratio of signal to noise. `range_limit` (10 m unless
/// said) and `noise_floor` (-100 dBm, sigma 10 dB unless said) stand in `[channel]`.
#[medium("simple")]
pub struct Simple;

/// Nothing to set beyond `[channel]`.
#[params]
#[derive(Default)]
pub struct SimpleParams {}

impl Fidelity for Simple {
    type Params = SimpleParams;

    fn medium(_params: SimpleParams, air: &Air) -> Result<Option<Box<dyn Medium>>, BuildError> {
        Ok(Some(Box::new(SimpleMedium::new(config(air))?)))
    }
}

/// What `[channel]` says of a medium without air time.
pub(super) fn config(air: &Air) -> SimpleConfig {
    let mut config = SimpleConfig {
        seed: air.seed,
        propagation: Arc::clone(&air.propagation),
        walls: air.walls,
        ..SimpleConfig::default()
    };
    if let Some(range) = air.range_limit {
        config.range_limit = range;
    }
    if let Some(noise) = air.noise_floor {
        (config.noise_floor, config.noise_sigma) = (noise.mean, noise.sigma);
    }
    config
}

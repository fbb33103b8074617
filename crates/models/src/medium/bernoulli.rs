//! Loss by chance, for each frame and receiver by itself.

use super::chance;
use simbeeotic_model::radio::{Delivery, Medium};
use simbeeotic_model::units::Length;
use simbeeotic_model::{Air, Aside, BuildError, Fidelity, medium, params};

/// An air that delivers by chance: no air time, no interference, no noise.
///
/// Each frame reaches each radio within `range_limit` of `[channel]` (10 m unless said) with the chance
/// `delivery`, or with that of `curve` at its distance, independently of all others. Receivers'
/// sensitivities and error models play no part; the RSSI is that of the propagation. What is not
/// delivered counts as lost by noise.
///
/// For when the ratio of packets that get through is known, from a measurement say, and how they are
/// lost does not matter. Independent losses are kinder than real ones, which come in bursts: a
/// retry helps more than it would. See `gilbert-elliott`.
#[medium("bernoulli")]
pub struct Bernoulli;

/// Parameters of [`Bernoulli`].
#[params]
#[derive(Default)]
pub struct BernoulliParams {
    /// Chance of delivery at any distance, 0 to 1. Without it, and without a curve, all is delivered.
    pub delivery: Option<f64>,
    /// Chance of delivery over distance, instead of `delivery`: `[["0 m", 1.0], ["20 m", 0.9], ...]`. Linear
    /// between points, to half a percent of the distance; level before the first and after the last.
    pub curve: Option<Vec<(Length, f64)>>,
}

impl Fidelity for Bernoulli {
    type Params = BernoulliParams;

    fn medium(params: BernoulliParams, air: &Air) -> Result<Option<Box<dyn Medium>>, BuildError> {
        let points = params.curve.as_deref();
        let curve = chance::curve(("delivery", params.delivery), ("curve", points))?;
        chance::medium(Delivery::Chance(curve), air)
    }

    fn leaves_aside(_air: &Air) -> Vec<Aside> {
        chance::aside()
    }
}

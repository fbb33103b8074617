//! Looping: one scenario, run over and over with other values.
//!
//! The bees are `random-walk-bee`, which comes with Simbeeotic: ten times a second each turns by a normal angle
//! of standard deviation `sigma`, and changes its velocity at random, up to `max_speed`. After `n` turns its
//! heading is like its first one by the mean cosine `c^n`, `c = exp(-sigma^2 / 2)`: it remembers where it
//! went for about `1 / (1 - c)` turns, some `2 / sigma^2`, and the farther it goes in that time, the farther
//! the swarm spreads. (The sum over many steps is in the example of the random walk.)
//!
//! What is varied stands in the scenario's `[sweep]`; [`SwarmRuler`] measures what comes of it.

use simbeeotic::prelude::*;

/// A referee that publishes how wide the swarm is, as `spread`: the root of the mean squared distance of its
/// bees from their middle, seen from above. It knows the truth, and nobody hears of it.
#[behavior("swarm-ruler", host = Bodiless)]
pub struct SwarmRuler;

/// Parameters of [`SwarmRuler`].
#[params]
pub struct SwarmRulerParams {
    /// Time between two measurements.
    pub period: Time,
}

impl Default for SwarmRulerParams {
    fn default() -> Self {
        Self {
            period: Time::si(1.0),
        }
    }
}

impl Behavior<Bodiless> for SwarmRuler {
    type Params = SwarmRulerParams;

    fn build(params: SwarmRulerParams, kit: &mut Kit<Self, Bodiless>) -> Result<Self, BuildError> {
        kit.every(params.period, Self::measure);
        Ok(Self)
    }
}

impl SwarmRuler {
    fn measure(&mut self, cx: &mut Cx<'_>) {
        let bees = cx.population().of_kind("random-walk-bee").iter();
        let places: Vec<[f64; 3]> = bees
            .filter_map(|id| Some(cx.pose_of(*id)?.position.si().to_array()))
            .collect();
        cx.metric("spread", spread_m(&places), "m"); // NaN, of fewer than two bees, is no value
    }
}

/// The root of the mean squared distance of places from their middle, seen from above. The middle is of the
/// same places, so the squares are divided by one less than there are: their mean is then that of any number.
fn spread_m(places: &[[f64; 3]]) -> f64 {
    let count = places.len() as f64;
    let variance = |axis: usize| {
        let middle = places.iter().map(|place| place[axis]).sum::<f64>() / count;
        let squares = places
            .iter()
            .map(|place| (place[axis] - middle) * (place[axis] - middle));
        squares.sum::<f64>() / (count - 1.0).max(0.0)
    };
    (variance(0) + variance(1)).sqrt()
}

#[cfg(test)]
mod test;

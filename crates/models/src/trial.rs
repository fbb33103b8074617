//! What the tests of the shelf share.

#[path = "../tests/it/swarm.rs"]
#[allow(
    dead_code,
    unused_imports,
    reason = "the tests beside this crate use the rest"
)]
mod swarm;

pub(crate) use swarm::{bee, run, vehicle, with_sensor_of};

use simbeeotic_model::params;

/// A test's behaviour has none.
#[params]
#[derive(Default)]
pub(crate) struct NoParams {}

/// Holds draws against a normal distribution: mean and variance within four standard errors.
pub(crate) fn assert_normal(draws: &[f64], mean: f64, sigma: f64) {
    let n = draws.len() as f64;
    let found = draws.iter().sum::<f64>() / n;
    let error = 4.0 * sigma / n.sqrt();
    assert!(
        (found - mean).abs() < error,
        "a mean of {found}, not {mean}"
    );

    let squares = draws.iter().map(|draw| (draw - found) * (draw - found));
    let variance = squares.sum::<f64>() / (n - 1.0) / (sigma * sigma);
    let error = 4.0 * (2.0 / n).sqrt();
    assert!(
        (variance - 1.0).abs() < error,
        "a variance of {variance} sigma^2, where sigma is {sigma}"
    );
}

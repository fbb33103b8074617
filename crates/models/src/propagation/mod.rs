//! Propagation: what is lost between two antennas.

pub mod free_space;
pub mod link_table;
pub mod log_distance;
pub mod two_ray;
pub mod two_ray_exact;

use simbeeotic_model::BuildError;
use simbeeotic_model::check::in_range;
use simbeeotic_model::units::Length;

/// How high an antenna at `up = 0` is above the ground.
fn height(height: Length) -> Result<Length, BuildError> {
    let most = Length::from_metres(1e3);
    in_range("height", height, -most..=most)?;
    Ok(height)
}

//! `[channel] shadowing = { ... }`: what is in the way and nobody drew into the map, as chance.

use crate::behavior::BuildError;
use crate::check::in_range;
use crate::config::{Fault, Node, read_params};
use simbeeotic_macros::{choice, params};
use simbeeotic_radio::Shadowing;
use simbeeotic_units::{Decibels, Length};

/// Log-normal shadowing: each link loses more or less than the path loss says, normal in decibels, the same
/// in both directions. The theory is in `simbeeotic_radio::shadowing`.
#[params]
pub struct ShadowingParams {
    /// Standard deviation, 0 dB to 40 dB: 2 to 4 outdoors with a line of sight, 4 to 8 without, 3 to 7 in
    /// buildings.
    pub sigma: Decibels,
    /// Correlation distance of the kind `field`, 1 m to 100 km: 10 m unless said. Of two readings of one
    /// link, between which one end moved by `s`, the correlation is `exp(-s / distance)`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance: Option<Length>,
    /// What it hangs on.
    pub kind: ShadowingKind,
}

/// What the shadowing of a link hangs on.
#[choice]
pub enum ShadowingKind {
    /// Where its ends are: it changes as they move.
    Field,
    /// Who its ends are: it stays through the run.
    Links,
}

/// The correlation distance of a field that says none.
const DISTANCE: Length = Length::si(10.0);

impl Default for ShadowingParams {
    fn default() -> Self {
        Self {
            sigma: Decibels::from_db(4.0),
            distance: None,
            kind: ShadowingKind::Field,
        }
    }
}

impl ShadowingParams {
    /// The table `shadowing` of `[channel]`.
    ///
    /// # Errors
    /// All unknown keys and numbers that make no sense, with their places.
    pub fn read(node: &Node) -> Result<Self, Vec<Fault>> {
        let params: Self = read_params(node)?;
        match params.check() {
            Ok(()) => Ok(params),
            Err(error) => Err(vec![crate::registry::place(node, error)]),
        }
    }

    fn check(&self) -> Result<(), BuildError> {
        in_range(
            "sigma",
            self.sigma,
            Decibels::ZERO..=Decibels::from_db(40.0),
        )?;
        if let Some(distance) = self.distance {
            if self.kind == ShadowingKind::Links {
                let message = "goes with the kind `field`: `links` does not hang on places";
                return Err(BuildError::parameter("distance", message));
            }
            let (least, most) = (Length::from_metres(1.0), Length::from_metres(1e5));
            in_range("distance", distance, least..=most)?;
        }
        Ok(())
    }

    /// The shadowing of a run with this seed.
    pub fn shadowing(&self, seed: u64) -> Shadowing {
        match self.kind {
            ShadowingKind::Field => {
                Shadowing::field(seed, self.sigma, self.distance.unwrap_or(DISTANCE))
            }
            ShadowingKind::Links => Shadowing::links(seed, self.sigma),
        }
    }
}

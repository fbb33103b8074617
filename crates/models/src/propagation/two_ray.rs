//! Two rays by crossover: free space near by, the fourth power of the distance far away.

use super::height;
use simbeeotic_model::check::in_range;
use simbeeotic_model::radio::{Link, Links, Propagation, TwoRay, TwoRayForm};
use simbeeotic_model::units::{Decibels, Length};
use simbeeotic_model::{BuildError, FromParams, choice, params, propagation};

/// Two rays by crossover, as packet simulators have it: up to the distance `4 pi h1 h2 / lambda` free space,
/// beyond it `40 log10(d) - 20 log10(h1 h2)` of path loss, never below 0 dB.
///
/// `h1` and `h2` are the antennas' heights above `up = 0`, at least 1 cm. Made for masts far apart; for
/// vehicles that fly as high as they are apart take `two-ray-exact`. Formulas and sources:
/// `simbeeotic_radio::TwoRay`.
#[propagation(
    "two-ray",
    java = "harvard.robobees.simbeeotic.model.comms.TwoRayPropagationModel"
)]
#[derive(Debug)]
pub struct TwoRayPropagation(TwoRay);

/// What is lost up to the crossover.
#[choice]
pub enum NearForm {
    /// As in free space: ns-2 and ns-3.
    Ns3,
    /// Free space with the interference of a perfect mirror, `4 sin^2(2 pi h1 h2 / (lambda d))`: the original.
    Original,
}

/// Parameters of [`TwoRayPropagation`].
#[params]
pub struct TwoRayParams {
    /// What is lost up to the crossover.
    pub form: NearForm,
    /// Up to this distance nothing is lost. 0 m to 1 km; ns-3 has 0.5 m.
    pub minimum_distance: Length,
    /// How high an antenna at `up = 0` is above the ground. -1 km to 1 km; ns-3's `HeightAboveZ`.
    pub height: Length,
}

impl Default for TwoRayParams {
    fn default() -> Self {
        Self {
            form: NearForm::Ns3,
            minimum_distance: Length::ZERO,
            height: Length::ZERO,
        }
    }
}

impl FromParams for TwoRayPropagation {
    type Params = TwoRayParams;

    fn from_params(params: TwoRayParams) -> Result<Self, BuildError> {
        let most = Length::from_metres(1e3);
        in_range(
            "minimum_distance",
            params.minimum_distance,
            Length::ZERO..=most,
        )?;
        Ok(Self(TwoRay {
            form: match params.form {
                NearForm::Ns3 => TwoRayForm::Ns3,
                NearForm::Original => TwoRayForm::Original,
            },
            minimum_distance: params.minimum_distance,
            height: height(params.height)?,
        }))
    }
}

impl Propagation for TwoRayPropagation {
    fn loss(&self, link: &Link) -> Decibels {
        self.0.loss(link)
    }

    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        self.0.gains(links, gains);
    }
}

//! Log-distance: a power law with an exponent from measurements.

use simbeeotic_model::check::in_range;
use simbeeotic_model::radio::{Link, Links, LogDistance, Propagation};
use simbeeotic_model::units::{Decibels, Length};
use simbeeotic_model::{BuildError, FromParams, params, propagation};

/// A power law: `L0 + 10 n log10(d / d0)` of path loss, `L0` up to the distance `d0`, never below 0 dB.
///
/// The exponent sums up what a place does: 2 is free space, 2.7 to 3.5 a town, 3 to 5 the way through
/// buildings or close to the ground. Formula and sources: `simbeeotic_radio::LogDistance`.
#[propagation("log-distance")]
#[derive(Debug)]
pub struct LogDistancePropagation(LogDistance);

/// Parameters of [`LogDistancePropagation`].
#[params]
pub struct LogDistanceParams {
    /// Path loss exponent `n`. 0 to 20.
    pub exponent: f64,
    /// The distance `d0` at which the reference loss is lost. 1 mm to 100 km.
    pub reference_distance: Length,
    /// The loss `L0` at the reference distance. 0 dB to 300 dB; unless said, that of free space at the
    /// frequency of the channel. ns-3's default is 46.6777 dB, which is free space at 5.15 GHz.
    pub reference_loss: Option<Decibels>,
}

impl Default for LogDistanceParams {
    fn default() -> Self {
        let model = LogDistance::default();
        Self {
            exponent: model.exponent,
            reference_distance: model.reference_distance,
            reference_loss: model.reference_loss,
        }
    }
}

impl FromParams for LogDistancePropagation {
    type Params = LogDistanceParams;

    fn from_params(params: LogDistanceParams) -> Result<Self, BuildError> {
        in_range("exponent", params.exponent, 0.0..=20.0)?;
        let (least, most) = (Length::from_metres(1e-3), Length::from_metres(1e5));
        in_range(
            "reference_distance",
            params.reference_distance,
            least..=most,
        )?;
        if let Some(loss) = params.reference_loss {
            in_range(
                "reference_loss",
                loss,
                Decibels::ZERO..=Decibels::from_db(300.0),
            )?;
        }
        Ok(Self(LogDistance {
            exponent: params.exponent,
            reference_distance: params.reference_distance,
            reference_loss: params.reference_loss,
        }))
    }
}

impl Propagation for LogDistancePropagation {
    fn loss(&self, link: &Link) -> Decibels {
        self.0.loss(link)
    }

    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        self.0.gains(links, gains);
    }
}

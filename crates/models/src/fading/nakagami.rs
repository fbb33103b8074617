//! Nakagami's distribution: a fit to measured fading.

use simbeeotic_model::check::in_range;
use simbeeotic_model::radio::{Fading, Nakagami};
use simbeeotic_model::units::Length;
use simbeeotic_model::{BuildError, FromParams, fading, params};

/// Nakagami-m: the power gain has a gamma distribution of shape `m` and mean 1, for each frame and receiver
/// anew.
///
/// `m = 1` is Rayleigh's, more is milder, less is worse. Without parameters `m` goes by distance as in
/// ns-3: 1.5 up to 80 m, 0.75 beyond.
#[fading("nakagami")]
#[derive(Debug)]
pub struct NakagamiFading(Nakagami);

/// Parameters of [`NakagamiFading`].
#[params]
#[derive(Default)]
pub struct NakagamiParams {
    /// One `m` for all distances, 0.5 to 100.
    pub m: Option<f64>,
    /// An `m` for each range of distances, instead: `[["80 m", 1.5], ["200 m", 0.75]]`. Distances rise; the
    /// last goes on beyond its own.
    pub steps: Vec<(Length, f64)>,
}

impl FromParams for NakagamiFading {
    type Params = NakagamiParams;

    fn from_params(params: NakagamiParams) -> Result<Self, BuildError> {
        let range = 0.5..=100.0;
        if let Some(m) = params.m {
            if !params.steps.is_empty() {
                let message = "and `steps` say the same: one will do";
                return Err(BuildError::parameter("m", message));
            }
            in_range("m", m, range)?;
            return Ok(Self(Nakagami::new(m)));
        }
        for &(_, m) in &params.steps {
            in_range("steps", m, range.clone())?;
        }
        let distances = || params.steps.iter().map(|step| step.0.metres());
        if !distances().all(|d| d > 0.0) || !distances().is_sorted_by(|a, b| a < b) {
            let message = "must have distances above 0 m that rise";
            return Err(BuildError::parameter("steps", message));
        }
        Ok(Self(match params.steps.is_empty() {
            true => Nakagami::ns3(),
            false => Nakagami::with_steps(&params.steps),
        }))
    }
}

impl Fading for NakagamiFading {
    fn gain(&self, draw: u64, distance_m: f64) -> f64 {
        self.0.gain(draw, distance_m)
    }

    fn fade(&self, draws: &[u64], distances_squared_m2: &[f32], gains: &mut [f32]) {
        self.0.fade(draws, distances_squared_m2, gains);
    }
}

//! The cosine pattern of ns-3.

use glam::{DVec3, Vec3};
use simbeeotic_model::radio::{Antenna, Cosine};
use simbeeotic_model::units::{Angle, Decibels};
use simbeeotic_model::{BuildError, FromParams, antenna, params};

/// A main lobe along the mount's x axis by two beamwidths, as ns-3's `CosineAntennaModel`.
///
/// Azimuth is counted around z, elevation from the xy plane. With ns-3's 120 and 360 degrees and
/// `max_gain = "0 dB"` it is ns-3's.
#[antenna("cosine")]
#[derive(Debug)]
pub struct CosineAntenna(Cosine);

/// Parameters of [`CosineAntenna`].
#[params]
pub struct CosineAntennaParams {
    /// Angle between the half-power points in azimuth, 1 to 360 degrees; 360: the same all round.
    pub azimuth: Angle,
    /// The same in elevation.
    pub elevation: Angle,
    /// Gain at boresight, -60 dB to 60 dB over isotropic; unless given, that of a lossless antenna of
    /// this shape.
    pub max_gain: Option<Decibels>,
    /// What cable, matching and the antenna itself take, 0 dB to 60 dB.
    pub loss: Decibels,
}

impl Default for CosineAntennaParams {
    fn default() -> Self {
        Self {
            azimuth: Angle::from_degrees(120.0),
            elevation: Angle::from_degrees(360.0),
            max_gain: None,
            loss: Decibels::ZERO,
        }
    }
}

impl FromParams for CosineAntenna {
    type Params = CosineAntennaParams;

    fn from_params(params: CosineAntennaParams) -> Result<Self, BuildError> {
        let CosineAntennaParams {
            azimuth,
            elevation,
            max_gain,
            loss,
        } = params;
        let lossless = Cosine::new(azimuth, elevation, loss)?;
        Ok(Self(match max_gain {
            Some(peak) => Cosine::with_peak(azimuth, elevation, peak - loss)?,
            None => lossless,
        }))
    }
}

impl Antenna for CosineAntenna {
    fn gain(&self, direction: DVec3) -> Decibels {
        self.0.gain(direction)
    }

    fn gain_linear(&self, direction: Vec3) -> f32 {
        self.0.gain_linear(direction)
    }
}

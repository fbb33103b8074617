//! Two rays as they are: the direct one and the one by the ground, added with their phases.

use super::height;
use simbeeotic_model::check::in_range;
use simbeeotic_model::radio::{Ground, Link, Links, Polarisation, Propagation, TwoRayExact};
use simbeeotic_model::units::{Conductivity, Decibels, Length};
use simbeeotic_model::{BuildError, FromParams, choice, params, propagation};

/// The direct ray and the one that flat ground reflects, added with their phases: what vehicles over open
/// ground see, with nulls and gains that move by wavelengths.
///
/// Heights are those above `up = 0`, at least 1 cm; obstacles and terrain do not count. Formulas and sources:
/// `simbeeotic_radio::TwoRayExact`.
#[propagation("two-ray-exact")]
#[derive(Debug)]
pub struct TwoRayExactPropagation(TwoRayExact);

/// Which way the electric field swings.
#[choice]
pub enum WavePolarisation {
    /// Upright, as from upright antennas.
    Vertical,
    /// Along the ground, across the rays.
    Horizontal,
}

/// What the ground is: ITU-R P.2040 for grounds and concrete, Debye's formula for water.
#[choice]
pub enum GroundKind {
    /// Sand, rock: at 2.4 GHz permittivity 3 and 1.4 mS/m.
    VeryDry,
    /// A field: 13.7 and 0.15 S/m.
    MediumDry,
    /// Wet ground: 21 and 0.47 S/m.
    Wet,
    /// A floor or yard: 5.2 and 92 mS/m.
    Concrete,
    /// A lake: 79 and 1.4 S/m.
    FreshWater,
    /// The sea: 69 and 6 S/m.
    SeaWater,
    /// What mirrors all.
    Perfect,
}

/// Parameters of [`TwoRayExactPropagation`].
#[params]
pub struct TwoRayExactParams {
    /// Which way the electric field swings.
    pub polarisation: WavePolarisation,
    /// What the ground is.
    pub ground: GroundKind,
    /// Relative permittivity instead of that of `ground`. 1 to 1000.
    pub permittivity: Option<f64>,
    /// Conductivity instead of that of `ground`. 0 S/m to 1e9 S/m.
    pub conductivity: Option<Conductivity>,
    /// How high an antenna at `up = 0` is above the ground. -1 km to 1 km.
    pub height: Length,
}

impl Default for TwoRayExactParams {
    fn default() -> Self {
        Self {
            polarisation: WavePolarisation::Vertical,
            ground: GroundKind::MediumDry,
            permittivity: None,
            conductivity: None,
            height: Length::ZERO,
        }
    }
}

impl GroundKind {
    fn ground(self) -> Ground {
        match self {
            Self::VeryDry => Ground::VERY_DRY,
            Self::MediumDry => Ground::MEDIUM_DRY,
            Self::Wet => Ground::WET,
            Self::Concrete => Ground::CONCRETE,
            Self::FreshWater => Ground::FRESH_WATER,
            Self::SeaWater => Ground::SEA_WATER,
            Self::Perfect => Ground::PERFECT,
        }
    }
}

impl FromParams for TwoRayExactPropagation {
    type Params = TwoRayExactParams;

    fn from_params(params: TwoRayExactParams) -> Result<Self, BuildError> {
        let mut ground = params.ground.ground();
        if let Some(permittivity) = params.permittivity {
            in_range("permittivity", permittivity, 1.0..=1000.0)?;
            (ground.a, ground.b) = (permittivity, 0.0);
        }
        if let Some(conductivity) = params.conductivity {
            let most = Conductivity::si(1e9);
            in_range("conductivity", conductivity, Conductivity::ZERO..=most)?;
            (ground.c, ground.d) = (conductivity.get(), 0.0);
        }
        Ok(Self(TwoRayExact {
            polarisation: match params.polarisation {
                WavePolarisation::Vertical => Polarisation::Vertical,
                WavePolarisation::Horizontal => Polarisation::Horizontal,
            },
            ground,
            height: height(params.height)?,
        }))
    }
}

impl Propagation for TwoRayExactPropagation {
    fn loss(&self, link: &Link) -> Decibels {
        self.0.loss(link)
    }

    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        self.0.gains(links, gains);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_model::units::Frequency;

    #[test]
    fn the_numbers_beside_the_names_are_those_at_2_4_ghz() {
        let at = |kind: GroundKind| {
            let (ground, channel) = (kind.ground(), Frequency::from_gigahertz(2.4));
            (
                ground.permittivity(channel),
                ground.conductivity_s_m(channel),
            )
        };
        for (kind, permittivity, conductivity) in [
            (GroundKind::VeryDry, 3.0, 0.0014),
            (GroundKind::MediumDry, 13.7, 0.146),
            (GroundKind::Wet, 21.1, 0.468),
            (GroundKind::Concrete, 5.24, 0.0916),
            (GroundKind::FreshWater, 78.6, 1.38),
            (GroundKind::SeaWater, 68.8, 6.06),
        ] {
            let (e, s) = at(kind);
            assert!(
                (e / permittivity - 1.0).abs() < 0.01,
                "{e}, not {permittivity}"
            );
            assert!(
                (s / conductivity - 1.0).abs() < 0.03,
                "{s}, not {conductivity}"
            );
        }
    }

    #[test]
    fn a_ground_of_numbers_is_that_at_every_frequency() {
        let params = TwoRayExactParams {
            permittivity: Some(7.0),
            conductivity: Some(Conductivity::si(0.02)),
            ..TwoRayExactParams::default()
        };
        let made = TwoRayExactPropagation::from_params(params).expect("good");
        assert_eq!(made.0.ground, Ground::constant(7.0, 0.02));
    }
}

//! The mean wind and how it grows with height.
//!
//! ```text
//! log law           U(h) = U_ref ln((h - d) / z0) / ln((h_ref - d) / z0)      (1)
//! power law         U(h) = U_ref (h / h_ref)^a                                (2)
//! MIL-F-8785C       U(h) = U_20 ln(h / z0) / ln(20 ft / z0),  h <= 1000 ft    (3)
//! ```
//! `z0` is the roughness length (sea 0.2 mm, grass 3 cm, crops 10 cm, forest and town 1 m), `d` the
//! displacement height (two thirds of the height of a dense forest or a town), `a` about 1/7 over open
//! land. Equation 1 is the surface layer's with neutral stability (J. Garratt, *The Atmospheric
//! Boundary Layer*, 1992, ch. 3); equation 3 is wind shear by MIL-F-8785C (1980), sec. 3.7.3.2, with
//! z0 = 2 ft, or 0.15 ft near an airfield (flight phase category C); it is held above 1000 ft.
//!
//! Height is that above the plane `z = 0`; terrain and obstacles do not bend the wind.

use glam::DVec3;
use simbeeotic_model::BuildError;
use simbeeotic_model::schemars::JsonSchema;
use simbeeotic_model::serde::{Deserialize, Serialize};
use simbeeotic_model::units::{Enu, Length, Velocity, math};

/// A foot in metres.
pub(super) const FOOT_M: f64 = 0.304_8;

/// How the mean wind grows with height. Without a profile it is the same at all heights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    crate = "simbeeotic_model::serde",
    rename_all = "snake_case",
    deny_unknown_fields
)]
#[schemars(crate = "simbeeotic_model::schemars")]
pub enum Profile {
    /// The logarithm of the height. No wind below displacement and roughness.
    Log {
        /// Roughness length, above 0.
        #[serde(default = "grass")]
        roughness: Length,
        /// Height by which dense obstacles lift the wind.
        #[serde(default)]
        displacement: Length,
        /// Where the wind is as strong as the scenario says, above displacement and roughness.
        #[serde(default = "ten_metres")]
        reference_height: Length,
    },
    /// A power of the height. No wind below the ground.
    Power {
        /// The exponent, 0 to 1.
        #[serde(default = "one_seventh")]
        exponent: f64,
        /// Where the wind is as strong as the scenario says, above 0.
        #[serde(default = "ten_metres")]
        reference_height: Length,
    },
    /// Wind shear by MIL-F-8785C. The wind is as strong as the scenario says at 20 ft, 6.096 m.
    MilF8785c {
        /// Whether it is that of take-off and landing (category C), over smooth ground.
        #[serde(default)]
        category_c: bool,
    },
}

fn grass() -> Length {
    Length::from_centimetres(3.0)
}

fn ten_metres() -> Length {
    Length::si(10.0)
}

fn one_seventh() -> f64 {
    1.0 / 7.0
}

/// Mean wind and profile, checked.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeanWind {
    reference: DVec3,
    law: Law,
}

#[derive(Clone, Copy, Debug)]
enum Law {
    Flat,
    Log { z0: f64, d: f64, per_log: f64 },
    Power { exponent: f64, href: f64 },
    Shear { z0: f64, per_log: f64 },
}

impl MeanWind {
    pub(super) fn new(wind: Velocity<Enu>, profile: Option<&Profile>) -> Result<Self, BuildError> {
        let wrong = |message: String| Err(BuildError::parameter("profile", message));
        let positive = |length: Length| length > Length::ZERO && length.is_finite();
        let law = match profile {
            None => Law::Flat,
            Some(Profile::Log {
                roughness,
                displacement,
                reference_height,
            }) => {
                if !positive(*roughness) {
                    return wrong(format!("has a roughness of {roughness}; it is above 0 m"));
                }
                if !(*displacement >= Length::ZERO && displacement.is_finite()) {
                    return wrong(format!(
                        "has a displacement of {displacement}; it is 0 m or more"
                    ));
                }
                let lowest = *roughness + *displacement;
                if !(*reference_height > lowest && reference_height.is_finite()) {
                    return wrong(format!(
                        "has a reference height of {reference_height}; it lies above roughness and displacement, {lowest}"
                    ));
                }
                let (z0, d) = (roughness.get(), displacement.get());
                let per_log = 1.0 / math::ln((reference_height.get() - d) / z0);
                Law::Log { z0, d, per_log }
            }
            Some(Profile::Power {
                exponent,
                reference_height,
            }) => {
                if !(0.0..=1.0).contains(exponent) {
                    return wrong(format!(
                        "has an exponent of {exponent}; it lies between 0 and 1"
                    ));
                }
                if !positive(*reference_height) {
                    return wrong(format!(
                        "has a reference height of {reference_height}; it is above 0 m"
                    ));
                }
                Law::Power {
                    exponent: *exponent,
                    href: reference_height.get(),
                }
            }
            Some(Profile::MilF8785c { category_c }) => {
                let z0 = FOOT_M * if *category_c { 0.15 } else { 2.0 };
                let per_log = 1.0 / math::ln(20.0 * FOOT_M / z0);
                Law::Shear { z0, per_log }
            }
        };
        Ok(Self {
            reference: wind.si(),
            law,
        })
    }

    /// The mean wind at a height, m/s.
    pub(super) fn at(&self, height_m: f64) -> DVec3 {
        match self.law {
            Law::Flat => self.reference,
            _ if self.reference == DVec3::ZERO => DVec3::ZERO,
            Law::Log { z0, d, per_log } => {
                self.reference * (math::ln(((height_m - d) / z0).max(1.0)) * per_log)
            }
            Law::Power { exponent, href } => {
                self.reference * math::pow((height_m / href).max(0.0), exponent)
            }
            Law::Shear { z0, per_log } => {
                let h = height_m.min(1_000.0 * FOOT_M);
                self.reference * (math::ln((h / z0).max(1.0)) * per_log)
            }
        }
    }

    /// The mean wind at the height that the scenario names, m/s.
    pub(super) fn reference(&self) -> DVec3 {
        self.reference
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn speed(profile: Option<Profile>, height_m: f64) -> f64 {
        let wind = Velocity::from_xyz(6.0, 8.0, 0.0);
        let mean = MeanWind::new(wind, profile.as_ref()).expect("good numbers");
        let at = mean.at(height_m);
        assert!(
            (at.x * 8.0 - at.y * 6.0).abs() < 1e-12,
            "it keeps its direction"
        );
        at.length()
    }

    #[test]
    fn the_wind_is_as_said_at_the_reference_height_and_follows_its_law() {
        let log = Profile::Log {
            roughness: Length::si(0.1),
            displacement: Length::si(2.0),
            reference_height: Length::si(12.0),
        };
        assert!((speed(Some(log.clone()), 12.0) - 10.0).abs() < 1e-12);
        // Ten times higher above the displacement: ln 10 more of ln 100.
        assert!((speed(Some(log.clone()), 102.0) - 15.0).abs() < 1e-12);
        assert_eq!(speed(Some(log.clone()), 2.05), 0.0);
        assert_eq!(speed(Some(log), -5.0), 0.0);
        let power = Profile::Power {
            exponent: 0.5,
            reference_height: Length::si(10.0),
        };
        assert!((speed(Some(power.clone()), 40.0) - 20.0).abs() < 1e-12);
        assert_eq!(speed(Some(power), -1.0), 0.0);
        assert_eq!(speed(None, -1.0), 10.0);
    }

    /// MIL-F-8785C, sec. 3.7.3.2: 1 at 20 ft; at 200 ft ln(100)/ln(10) = 2 for z0 = 2 ft.
    #[test]
    fn the_shear_of_the_specification_has_its_numbers() {
        let shear = |category_c| Some(Profile::MilF8785c { category_c });
        assert!((speed(shear(false), 6.096) - 10.0).abs() < 1e-12);
        assert!((speed(shear(false), 60.96) - 20.0).abs() < 1e-12);
        assert!((speed(shear(false), 304.8) - speed(shear(false), 500.0)).abs() < 1e-12);
        // ln(20 / 0.15) = 4.892852, ln(3 / 0.15) = 2.995732: at 3 ft 61 % of the wind at 20 ft.
        assert!((speed(shear(true), 0.914_4) - 6.122_67).abs() < 1e-4);
        assert_eq!(speed(shear(true), 0.0), 0.0);
    }

    #[test]
    fn nonsense_is_refused() {
        let m = Length::si;
        let log = |roughness, displacement, reference_height| Profile::Log {
            roughness,
            displacement,
            reference_height,
        };
        let power = |exponent, reference_height| Profile::Power {
            exponent,
            reference_height,
        };
        for bad in [
            log(m(0.0), m(0.0), m(10.0)),
            log(m(f64::NAN), m(0.0), m(10.0)),
            log(m(0.1), m(-1.0), m(10.0)),
            log(m(0.1), m(10.0), m(10.0)),
            power(-0.1, m(10.0)),
            power(1.5, m(10.0)),
            power(0.2, m(0.0)),
        ] {
            assert!(
                MeanWind::new(Velocity::ZERO, Some(&bad)).is_err(),
                "{bad:?}"
            );
        }
    }
}

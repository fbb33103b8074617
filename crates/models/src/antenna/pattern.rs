//! An antenna from a table in a file.

use crate::table::TableFile;
use glam::{DVec3, Vec3};
use simbeeotic_model::check::in_range;
use simbeeotic_model::radio::{Antenna, Pattern};
use simbeeotic_model::units::Decibels;
use simbeeotic_model::{BuildError, FromParams, Site, antenna, params};

/// An antenna from a file: gains in dBi over azimuth and elevation, as a chamber or a field solver gives them.
///
/// The file is text with a header: `azimuth, elevation, gain`, or `phi, theta, gain`; degrees, dBi.
/// Azimuth and phi are counted from the mount's x axis to its y axis (left), elevation from the xy
/// plane up, theta from the z axis down. All combinations of some azimuths and some elevations must be there, each once,
/// in any order. Between them the gain is interpolated in dB, around the azimuth without a seam; beyond the
/// last elevations it stays. Lines that start with `#` are skipped.
#[antenna("pattern")]
#[derive(Debug)]
pub struct PatternAntenna(Pattern);

/// Parameters of [`PatternAntenna`].
#[params]
pub struct PatternAntennaParams {
    /// The file, beside the scenario.
    pub file: String,
    /// What the table leaves out: cable, matching; 0 dB to 60 dB.
    pub loss: Decibels,
}

impl Default for PatternAntennaParams {
    fn default() -> Self {
        Self {
            file: String::new(),
            loss: Decibels::ZERO,
        }
    }
}

impl FromParams for PatternAntenna {
    type Params = PatternAntennaParams;

    fn from_params(params: PatternAntennaParams) -> Result<Self, BuildError> {
        Self::for_run(params, &Site::default())
    }

    fn for_run(params: PatternAntennaParams, site: &Site<'_>) -> Result<Self, BuildError> {
        in_range(
            "loss",
            params.loss,
            Decibels::ZERO..=Decibels::from_db(60.0),
        )?;
        let file = TableFile::read(site, &params.file, "azimuth, elevation and gain")?;
        let pattern = Pattern::read(&file.text, params.loss);
        pattern.map(Self).map_err(|faults| file.refused(&faults))
    }
}

impl Antenna for PatternAntenna {
    fn gain(&self, direction: DVec3) -> Decibels {
        self.0.gain(direction)
    }

    fn gain_linear(&self, direction: Vec3) -> f32 {
        self.0.gain_linear(direction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn read(name: &str, text: &str) -> Result<PatternAntenna, BuildError> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(name), text).unwrap();
        let site = Site {
            folder: folder.path(),
            ..Site::default()
        };
        let params = PatternAntennaParams {
            file: name.to_owned(),
            ..PatternAntennaParams::default()
        };
        PatternAntenna::for_run(params, &site)
    }

    #[test]
    fn a_table_beside_the_scenario_is_read() {
        let antenna = read("good.csv", "azimuth,elevation,gain\n0,0,2\n180,0,-4\n").unwrap();
        assert!((antenna.gain(DVec3::Y).db() + 1.0).abs() < 1e-9);
        assert!((f64::from(antenna.gain_linear(-Vec3::X)) - 0.398_107).abs() < 1e-5);
    }

    #[test]
    fn faults_of_the_file_have_their_places() {
        let fault = read("bad.csv", "azimuth,elevation,gain\n0,x,2\n180,0,none\n").unwrap_err();
        let text = fault.to_string();
        assert!(text.contains("bad.csv:2:3: `x` is no number"), "{text}");
        assert!(text.contains("bad.csv:3:7: `none` is no number"), "{text}");
    }

    #[test]
    fn a_file_that_is_not_there_is_named() {
        let site = Site {
            folder: Path::new("no-such-folder"),
            ..Site::default()
        };
        let params = |file: &str| PatternAntennaParams {
            file: file.to_owned(),
            ..PatternAntennaParams::default()
        };
        let fault = PatternAntenna::for_run(params("none.csv"), &site).unwrap_err();
        assert!(fault.to_string().contains("none.csv"), "{fault}");
        assert!(PatternAntenna::for_run(params(""), &site).is_err());
    }
}

//! Which vehicles are meant: by a path, or by patterns of paths.

use super::RenderError;
use simbeeotic_record::{Recording, Selection};
use simbeeotic_units::did_you_mean;

/// The place of a vehicle by its path.
pub(super) fn vehicle(recording: &Recording, path: &str) -> Result<usize, RenderError> {
    let vehicles = recording.vehicles();
    let found = vehicles.iter().position(|vehicle| vehicle.path == path);
    found.ok_or_else(|| match path.contains(['*', ',']) {
        true => RenderError::UnknownVehicle {
            path: path.to_owned(),
            help: "it is the path of one vehicle, not a pattern of several".to_owned(),
        },
        false => unknown(recording, path),
    })
}

/// What is said of a path, or of a pattern, that nobody has.
fn unknown(recording: &Recording, path: &str) -> RenderError {
    let vehicles = recording.vehicles();
    let all = vehicles.iter().map(|vehicle| vehicle.path.as_str());
    let help = match (did_you_mean(path, all), vehicles) {
        (Some(guess), _) => format!("did you mean `{guess}`?"),
        (None, []) => "there are none".to_owned(),
        (None, [one]) => format!("there is only `{}`", one.path),
        (None, [first, .., last]) => format!(
            "there are {}, from `{}` to `{}`",
            vehicles.len(),
            first.path,
            last.path
        ),
    };
    RenderError::UnknownVehicle {
        path: path.to_owned(),
        help,
    }
}

/// Which vehicles' paths match one of the patterns; all, if there is none.
pub(super) fn matching(
    recording: &Recording,
    patterns: &[String],
) -> Result<Vec<bool>, RenderError> {
    let vehicles = recording.vehicles();
    let takes = |patterns: &[String]| {
        let selection = Selection {
            models: patterns.to_vec(),
            ..Selection::default()
        };
        let shown = vehicles
            .iter()
            .map(|vehicle| selection.takes(&vehicle.path));
        shown.collect::<Vec<bool>>()
    };
    for pattern in patterns {
        if !takes(std::slice::from_ref(pattern)).contains(&true) {
            return Err(unknown(recording, pattern));
        }
    }
    Ok(takes(patterns))
}

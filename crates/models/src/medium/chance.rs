//! What the media that deliver by chance have in common.

use simbeeotic_model::radio::{
    Delivery, DeliveryCurve, Medium, RadioError, SimpleConfig, SimpleMedium,
};
use simbeeotic_model::units::Length;
use simbeeotic_model::{Air, Aside, BuildError};

/// The curve of a level chance or of points, whichever is given, each with its key; all is delivered if
/// neither is.
pub(super) fn curve(
    (level_key, level): (&'static str, Option<f64>),
    (points_key, points): (&'static str, Option<&[(Length, f64)]>),
) -> Result<DeliveryCurve, BuildError> {
    let (key, curve) = match (level, points) {
        (Some(_), Some(_)) => {
            let message = format!("cannot stand beside `{points_key}`: it is one or the other");
            return Err(BuildError::parameter(level_key, message));
        }
        (_, Some(points)) => (points_key, DeliveryCurve::new(points)),
        (level, None) => (level_key, DeliveryCurve::level(level.unwrap_or(1.0))),
    };
    let verb = if points.is_some() { "has" } else { "is" };
    curve.map_err(|fault| match fault {
        RadioError::OutOfRange { got, expected, .. } => {
            BuildError::parameter(key, format!("{verb} {got}: expected {expected}"))
        }
        other => other.into(),
    })
}

/// The medium that delivers so.
pub(super) fn medium(delivery: Delivery, air: &Air) -> Result<Option<Box<dyn Medium>>, BuildError> {
    let config = SimpleConfig {
        delivery,
        ..super::simple::config(air)
    };
    Ok(Some(Box::new(SimpleMedium::new(config)?)))
}

/// What power decides elsewhere, and here nothing.
pub(super) fn aside() -> Vec<Aside> {
    let message =
        "plays no part in who hears, which is a matter of chance here: it shows in the RSSI alone";
    ["shadowing", "fading", "walls"]
        .map(|key| Aside { key, message })
        .into()
}

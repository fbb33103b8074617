//! Where bees come from.

use glam::DVec3;
use simbeeotic_model::check::positive;
use simbeeotic_model::host::Station;
use simbeeotic_model::physics::{BodySpec, Contacts, Mobility, Shape, group};
use simbeeotic_model::units::Length;
use simbeeotic_model::{Behavior, BuildError, Kit, behavior, params};

/// A box that marks the bees' home. It can carry sensors and radios; it has no logic of its own.
#[behavior("simple-hive", host = Station, java = "harvard.robobees.simbeeotic.model.SimpleHive")]
pub struct SimpleHive;

/// Parameters of [`SimpleHive`].
#[params]
pub struct SimpleHiveParams {
    /// Edge of the box, which stands on its start position.
    pub size: Length,
}

impl Default for SimpleHiveParams {
    fn default() -> Self {
        Self {
            size: Length::si(1.0),
        }
    }
}

impl Behavior<Station> for SimpleHive {
    type Params = SimpleHiveParams;

    fn build(params: SimpleHiveParams, _kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        positive("size", params.size)?;
        Ok(Self)
    }

    fn body(params: &SimpleHiveParams) -> Option<BodySpec> {
        let half = 0.5 * params.size.metres();
        Some(BodySpec {
            p_enu: DVec3::new(0.0, 0.0, half),
            mobility: Mobility::Fixed,
            group: group::HIVE,
            contacts: Contacts::None,
            ..BodySpec::new(
                Shape::Box {
                    half_m: DVec3::splat(half),
                },
                1.0,
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_stands_on_its_start_and_stays_there() {
        let size = Length::si(0.6);
        let body = SimpleHive::body(&SimpleHiveParams { size }).expect("a body");
        assert_eq!(body.p_enu, DVec3::new(0.0, 0.0, 0.3));
        assert_eq!(body.mobility, Mobility::Fixed);
        assert!(body.check().is_ok());
    }
}

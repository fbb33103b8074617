//! A beacon on the ground.

use super::packet::{Mark, Value};
use super::paths::Paths;
use simbeeotic::prelude::*;

/// A beacon on the ground that broadcasts its value: where it lies beside the nearest of the paths.
///
/// The value is what was written into it by whoever laid it down and surveyed its place, without an error: the
/// place does not change. It needs a
/// radio, which sleeps between its packets. Beacons send at the same period, each at a phase of its own.
#[behavior("gradient-beacon", host = Station)]
pub struct GradientBeacon {
    radio: RadioHandle,
    paths: Paths,
    params: GradientBeaconParams,
}

/// Parameters of [`GradientBeacon`].
#[params]
pub struct GradientBeaconParams {
    /// The preferred paths, each by its bends from the hive to the edge of the field, east and north:
    /// `"0 m, 0 m; 20 m, 5 m"`.
    pub paths: Vec<String>,
    /// Whether it stands in the hive.
    pub hive: bool,
    /// It marks the field's edge if no more than this is left of its path. 0 m or more.
    pub edge: Length,
    /// Time between two packets. 10 ms to 1 h.
    pub period: Time,
}

impl Default for GradientBeaconParams {
    fn default() -> Self {
        Self {
            paths: vec!["0 m, 0 m; 50 m, 0 m".to_owned()],
            hive: false,
            edge: Length::si(5.0),
            period: Time::from_millis(500.0),
        }
    }
}

impl Behavior<Station> for GradientBeacon {
    type Params = GradientBeaconParams;

    fn build(
        params: GradientBeaconParams,
        kit: &mut Kit<Self, Station>,
    ) -> Result<Self, BuildError> {
        in_range(
            "period",
            params.period,
            Time::from_millis(10.0)..=Time::si(3600.0),
        )?;
        at_least_zero("edge", params.edge)?;
        let phase = kit.stream("phase").uniform();
        kit.every_from(params.period * phase, params.period, Self::tell);
        kit.on_sent(|me, _, beacon| beacon.sleep_radio(me.radio));
        Ok(Self {
            radio: kit.radio()?,
            paths: Paths::read("paths", &params.paths)?,
            params,
        })
    }

    fn body(params: &GradientBeaconParams) -> Option<BodySpec> {
        let radius_m = if params.hive { 0.3 } else { 0.05 };
        let ball = BodySpec::new(Shape::Sphere { radius_m }, 1.0);
        let p_enu = [0.0, 0.0, 0.05].into();
        Some(BodySpec {
            p_enu,
            mobility: Mobility::Fixed,
            ..ball
        })
    }
}

impl GradientBeacon {
    fn tell(&mut self, beacon: &mut Platform<'_>) {
        let beside = self.paths.beside(beacon.position());
        let mark = match self.params.hive {
            true => Mark::Hive,
            false if beside.left <= self.params.edge => Mark::Edge,
            false => Mark::Field,
        };
        let value = Value {
            mark,
            along: beside.along,
            across: beside.across,
        };
        beacon.wake_radio(self.radio);
        beacon.send(self.radio, &value.to_packet());
    }
}

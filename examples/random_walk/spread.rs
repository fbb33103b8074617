//! The measure: how far bees have come from where they began.

use simbeeotic::prelude::*;

/// A referee that publishes the mean squared displacement of all roaming bees, seen from above, as `msd`.
/// It knows the truth, and nobody hears of it.
#[behavior("spread-meter", host = Bodiless)]
pub struct SpreadMeter {
    starts: Vec<(ModelId, Position)>,
}

/// Parameters of [`SpreadMeter`].
#[params]
pub struct SpreadMeterParams {
    /// Time between two measurements.
    pub period: Time,
}

impl Default for SpreadMeterParams {
    fn default() -> Self {
        Self {
            period: Time::si(1.0),
        }
    }
}

impl Behavior<Bodiless> for SpreadMeter {
    type Params = SpreadMeterParams;

    fn build(params: SpreadMeterParams, kit: &mut Kit<Self, Bodiless>) -> Result<Self, BuildError> {
        kit.every(params.period, Self::measure);
        Ok(Self { starts: Vec::new() })
    }
}

impl SpreadMeter {
    fn measure(&mut self, cx: &mut Cx<'_>) {
        if self.starts.is_empty() {
            let bees = cx.population().of_kind("roaming-bee").iter();
            let places = bees.filter_map(|id| Some((*id, cx.pose_of(*id)?.position)));
            self.starts = places.collect();
        }
        let squares = self.starts.iter().filter_map(|(id, start)| {
            let way = (cx.pose_of(*id)?.position - *start).si();
            Some(way.x * way.x + way.y * way.y)
        });
        let msd = squares.sum::<f64>() / self.starts.len() as f64;
        cx.metric("msd", msd, "m^2"); // NaN, if there are no bees, is no value
    }
}

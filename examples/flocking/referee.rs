//! Who measures the flock. It sees the truth, and tells nobody.

use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec3;

/// Measures a flock of `flock-bee`s, from the truth.
///
/// It publishes `order` (1: all fly the same way), `nearest` (distance between the two that are nearest to
/// each other) and `spacing` (distance of each to its nearest, in the mean); and, from the time `settled` on,
/// `mean_order` and `least_distance`.
#[behavior("flock-referee", host = Bodiless)]
pub struct FlockReferee {
    settled: Time,
    orders: (f64, u32),
    least: Length,
}

/// Parameters of [`FlockReferee`].
#[params]
pub struct FlockRefereeParams {
    /// Time between two looks. Above 0.
    pub period: Time,
    /// When a flock should have formed. 0 or more.
    pub settled: Time,
}

impl Default for FlockRefereeParams {
    fn default() -> Self {
        Self {
            period: Time::from_millis(500.0),
            settled: Time::from_secs(60.0),
        }
    }
}

impl Behavior<Bodiless> for FlockReferee {
    type Params = FlockRefereeParams;

    fn build(
        params: FlockRefereeParams,
        kit: &mut Kit<Self, Bodiless>,
    ) -> Result<Self, BuildError> {
        positive("period", params.period)?;
        at_least_zero("settled", params.settled)?;
        kit.every(params.period, Self::look);
        Ok(Self {
            settled: params.settled,
            orders: (0.0, 0),
            least: Length::si(f64::INFINITY),
        })
    }
}

impl FlockReferee {
    fn look(&mut self, cx: &mut Cx<'_>) {
        let flock = cx.population().of_kind("flock-bee");
        let places = flock.iter().filter_map(|id| cx.pose_of(*id));
        let places: Vec<DVec3> = places.map(|pose| pose.position.si()).collect();
        let twists = flock.iter().filter_map(|id| cx.twist_of(*id));
        let sum: DVec3 = twists.map(|t| t.linear.si().normalize_or_zero()).sum();
        if places.len() < 2 {
            return;
        }
        let order = sum.length() / places.len() as f64;
        let (nearest, spacing) = distances(&places);
        cx.metric("order", order, "1");
        cx.metric("nearest", nearest.get(), "m");
        cx.metric("spacing", spacing.get(), "m");
        if cx.now().time() >= self.settled {
            self.orders = (self.orders.0 + order, self.orders.1 + 1);
            self.least = self.least.min(nearest);
            let mean = self.orders.0 / f64::from(self.orders.1);
            cx.metric("mean_order", mean, "1");
            cx.metric("least_distance", self.least.get(), "m");
        }
    }
}

/// The least distance between any two, and that of each to its nearest, in the mean.
fn distances(places: &[DVec3]) -> (Length, Length) {
    let nearest = |i: usize| {
        let others = places.iter().enumerate().filter(|(j, _)| *j != i);
        let squares = others.map(|(_, place)| place.distance_squared(places[i]));
        squares.fold(f64::INFINITY, f64::min).sqrt()
    };
    let all: Vec<f64> = (0..places.len()).map(nearest).collect();
    let least = all.iter().copied().fold(f64::INFINITY, f64::min);
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    (Length::si(least), Length::si(mean))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_has_a_nearest_and_one_pair_is_the_nearest_of_all() {
        let places = [0.0, 3.0, 10.0].map(|x| DVec3::X * x);
        let (least, mean) = distances(&places);
        assert_eq!(least, Length::si(3.0));
        assert!((mean.get() - (3.0 + 3.0 + 7.0) / 3.0).abs() < 1e-12);
    }
}

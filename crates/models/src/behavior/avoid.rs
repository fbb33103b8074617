//! A bee that keeps off what it has around it.

use crate::sensor::scan::Scan;
use simbeeotic_model::check::at_least_zero;
use simbeeotic_model::units::{Angle, Length, Speed, Velocity, math};
use simbeeotic_model::{Bee, Behavior, BuildError, Handle, Kit, behavior, params};
use std::f64::consts::FRAC_PI_2;

/// Slower than this part of its speed it does not become.
const SLOWEST: f64 = 0.2;

/// A bee that wanders at one height and turns away from what is near: it needs a scanning sensor called
/// `ring` with a rate, a `ring` or a `lidar`.
///
/// At each scan it looks for the nearest echo in its forward half. Is there none within `margin`, it turns
/// at random. Else it turns to the other side, the more the nearer the echo is, up to `turn`, and slows down
/// as much.
#[behavior("avoid-bee")]
pub struct AvoidBee {
    params: AvoidBeeParams,
    ring: Handle<Scan>,
}

/// Parameters of [`AvoidBee`].
#[params]
pub struct AvoidBeeParams {
    /// How fast it flies where nothing is near.
    pub speed: Speed,
    /// What is farther does not matter. Zero: nothing does, and it only wanders.
    pub margin: Length,
    /// The most that it turns away at one scan.
    pub turn: Angle,
    /// Standard deviation of each random turn.
    pub heading_sigma: Angle,
}

impl Default for AvoidBeeParams {
    fn default() -> Self {
        Self {
            speed: Speed::si(1.0),
            margin: Length::si(2.0),
            turn: Angle::from_degrees(45.0),
            heading_sigma: Angle::from_degrees(5.0),
        }
    }
}

impl Behavior for AvoidBee {
    type Params = AvoidBeeParams;

    fn build(params: AvoidBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        at_least_zero("speed", params.speed)?;
        at_least_zero("margin", params.margin)?;
        at_least_zero("turn", params.turn)?;
        at_least_zero("heading_sigma", params.heading_sigma)?;
        let ring = kit.on_sample("ring", Self::steer)?;
        Ok(Self { params, ring })
    }
}

impl AvoidBee {
    fn steer(&mut self, bee: &mut Bee<'_>) {
        let Self { params, ring } = self;
        let scan = bee.read(*ring);
        let mut nearest = (params.margin, 0.0);
        for echo in scan.echoes() {
            let azimuth = math::wrap_signed(echo.azimuth.get());
            if echo.distance < nearest.0 && azimuth.abs() < FRAC_PI_2 {
                nearest = (echo.distance, azimuth);
            }
        }
        let (distance, azimuth) = nearest;
        let (turn, speed) = if distance < params.margin {
            let clear = distance / params.margin;
            // What is straight ahead is passed on its left.
            let side = if azimuth > 0.0 { -1.0 } else { 1.0 };
            (
                params.turn * (side * (1.0 - clear)),
                params.speed * clear.max(SLOWEST),
            )
        } else {
            (params.heading_sigma * bee.gauss(), params.speed)
        };
        bee.turn(turn);
        bee.fly(Velocity::new(speed, Speed::ZERO, Speed::ZERO));
    }
}

#[cfg(test)]
mod tests {
    use crate::trial::{bee, mounted, run_among, with_sensor_of};
    use simbeeotic_model::units::{Angle, Length, Mount, Position, Time};
    use simbeeotic_model::world::{Obstacle, ObstacleShape, World};
    use simbeeotic_model::{ModelPlan, Sampling};

    fn wanderer(margin: &str) -> ModelPlan {
        let plan = bee("bee", "avoid-bee", &[("margin", margin)], [0.0, 0.0, 2.0]);
        let plan = with_sensor_of(plan, "ring", "ring", &[]);
        let sampling = Sampling {
            period: Some(Time::from_millis(100.0)),
            ..Sampling::default()
        };
        mounted(plan, Mount::IDENTITY, sampling)
    }

    /// A court of 10 m by 10 m with a pillar in each quarter.
    fn court() -> World {
        let block = |x: f64, y: f64, length: f64, width: f64| Obstacle {
            position: Position::from_xyz(x, y, 0.0),
            shape: ObstacleShape::Box {
                length: Length::si(length),
                width: Length::si(width),
                height: Length::si(5.0),
                rotation: Angle::ZERO,
            },
            ..Obstacle::default()
        };
        let mut obstacles = vec![
            block(5.1, 0.0, 0.2, 10.4),
            block(-5.1, 0.0, 0.2, 10.4),
            block(0.0, 5.1, 10.4, 0.2),
            block(0.0, -5.1, 10.4, 0.2),
        ];
        for (x, y) in [(2.5, 2.5), (-2.5, 2.5), (2.5, -2.5), (-2.5, -2.5)] {
            obstacles.push(block(x, y, 0.5, 0.5));
        }
        World {
            obstacles,
            ..World::default()
        }
    }

    fn touches(margin: &str) -> u64 {
        let outcome = run_among(court(), vec![wanderer(margin)], 120).run();
        assert!(outcome.error.is_none(), "{:?}", outcome.error);
        outcome.summary.touches
    }

    #[test]
    fn it_touches_nothing_in_a_court_with_pillars_and_would_without_its_ring() {
        assert_eq!(touches("2 m"), 0);
        assert!(touches("0 m") > 0);
    }
}

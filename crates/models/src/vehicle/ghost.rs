//! A body that goes where it is told, and that nothing pushes.
//!
//! A ghost stands for a vehicle that flies elsewhere: its body is [`Mobility::Driven`], others see it, hear
//! it and bounce off it, and it bounces off nobody. As long as no testbed tells where the real one is, it
//! follows its behaviour's set points itself, as a perfect autopilot would: every control period
//!
//! ```text
//! v <- v + d min(1, max_acceleration T / |d|),    d = v_wanted - v          (1)
//! ```
//! It has no weight to carry and no wind to fight, lies still when it is told not to hover, and goes
//! through what stands in its way: whoever flies one keeps it off things, and lands it by its sensors.

use glam::DVec3;
use simbeeotic_model::check::{at_least_zero, positive};
use simbeeotic_model::physics::{BodySpec, Mobility, Shape, group};
use simbeeotic_model::units::{
    Acceleration, Angle, Attitude, Current, Enu, Length, Position, Rate, Time, Twist, Velocity,
    Yaw, math,
};
use simbeeotic_model::{
    BuildError, Consumer, Platform, Setpoint, Vehicle, VehicleKit, params, vehicle,
};
use std::sync::Arc;

/// A body driven from outside: it follows its set points exactly, whatever the wind, and nothing stops it.
#[vehicle("ghost")]
pub struct Ghost {
    params: Arc<GhostParams>,
}

/// Parameters of [`Ghost`].
#[params]
pub struct GhostParams {
    /// Diameter of the body, a sphere.
    pub length: Length,
    /// The most by which it changes its velocity.
    pub max_acceleration: Acceleration,
    /// Time between two steps.
    pub control_period: Time,
    /// Current that flying draws: while it hovers, or moves.
    pub hover_current: Current,
}

impl Default for GhostParams {
    fn default() -> Self {
        Self {
            length: Length::si(0.1),
            max_acceleration: Acceleration::si(1.0),
            control_period: Time::si(0.1),
            hover_current: Current::si(0.5),
        }
    }
}

impl Vehicle for Ghost {
    type Params = GhostParams;

    fn build(params: Arc<GhostParams>, _kit: &VehicleKit<'_>) -> Result<Self, BuildError> {
        positive("length", params.length)?;
        positive("max_acceleration", params.max_acceleration)?;
        positive("control_period", params.control_period)?;
        at_least_zero("hover_current", params.hover_current)?;
        Ok(Self { params })
    }

    fn body(&self) -> BodySpec {
        let radius_m = 0.5 * self.params.length.metres();
        BodySpec {
            p_enu: DVec3::new(0.0, 0.0, radius_m),
            mobility: Mobility::Driven,
            group: group::BEE,
            // Its mass is never asked for.
            ..BodySpec::new(Shape::Sphere { radius_m }, 1.0)
        }
    }

    fn control_period(&self) -> Option<Time> {
        Some(self.params.control_period)
    }

    fn control(&mut self, setpoint: &Setpoint, platform: &mut Platform<'_>) {
        let wanted: Velocity<Enu> = if setpoint.hovering {
            platform.attitude().rotate(setpoint.velocity)
        } else {
            Velocity::ZERO
        };
        let now = platform.velocity();
        let most = self.params.max_acceleration * self.params.control_period;
        let linear = now + (wanted - now).limit(most);
        if linear != now {
            platform.set_twist(Twist {
                linear,
                angular: Rate::ZERO,
            });
        }
        let flies = setpoint.hovering || linear != Velocity::ZERO;
        let current = if flies {
            self.params.hover_current
        } else {
            Current::ZERO
        };
        platform.set_load(Consumer::Hover, current);
    }

    fn turn(&mut self, angle: Angle, platform: &mut Platform<'_>) {
        let yaw = platform.attitude().yaw() + angle;
        platform.set_attitude(Attitude::from_yaw(yaw));
    }

    fn turn_toward(&mut self, point: Position, platform: &mut Platform<'_>) {
        let way = (point - platform.position()).si();
        if way.truncate().length_squared() > 0.0 {
            let yaw = Yaw::new(Angle::si(math::atan2(way.y, way.x)));
            platform.set_attitude(Attitude::from_yaw(yaw));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::trial::{NoParams, run, vehicle};
    use simbeeotic_model::config::{Node, Span};
    use simbeeotic_model::registry::{self, Kind, Make};
    use simbeeotic_model::units::{Angle, Time, Velocity};
    use simbeeotic_model::{Bee, Behavior, BuildError, Kit, behavior};

    /// Turns to the left, flies there for ten seconds, and switches its motors off.
    #[behavior("test-ghost-flight")]
    struct Leftward;

    impl Behavior for Leftward {
        type Params = NoParams;

        fn build(_params: NoParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
            kit.once(Time::ZERO, |_, bee: &mut Bee<'_>| {
                bee.turn(Angle::from_degrees(90.0));
                bee.fly(Velocity::from_xyz(2.0, 0.0, 0.0));
            });
            kit.once(Time::from_secs(10.0), |_, bee: &mut Bee<'_>| {
                bee.hover(false);
            });
            Ok(Self)
        }
    }

    /// 1 m/s² in steps of 0.1 s: 0.1 m/s more at each of twenty steps, then 2 m/s; and back.
    #[test]
    fn it_flies_its_set_points_exactly_and_lies_still_without_falling() {
        let mut plan = vehicle("ghost", "test-ghost-flight", &[], &[], [0.0, 0.0, 5.0]);
        let Some(Make::Vehicle(make)) = registry::find(Kind::Vehicle, "ghost").map(|p| p.make)
        else {
            panic!("it is on the shelf");
        };
        let defaults = Node::table(Span::default());
        plan.vehicle = Some(make(&defaults).expect("they are right"));
        let mut run = run(vec![plan], 20);
        let end = run.run();
        assert!(end.error.is_none(), "{:?}", end.error);
        let north = run.pose("ghost").expect("a body").position.si();
        // From the second step on, 0.1 (0.1 (1 + ... + 20) + 79 x 2) m; to rest, 0.1 (1.9 + ... + 0.1) m.
        assert!((north.y - (17.9 + 1.9)).abs() < 1e-9, "{north}");
        assert!(north.x.abs() < 1e-9, "{north}");
        assert_eq!(run.twist("ghost").expect("a body").linear, Velocity::ZERO);
        let up = north.z - 5.0;
        assert!(up.abs() < 0.051, "it neither falls nor climbs: {up} m");
    }
}

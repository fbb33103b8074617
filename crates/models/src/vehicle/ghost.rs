//! A body that goes where it is told, and that nothing pushes.
//!
//! A ghost stands for a vehicle that flies elsewhere: its body is [`Mobility::Driven`], others see it, hear
//! it and bounce off it, and it bounces off nobody. As long as no testbed tells where the real one is, it
//! follows its behaviour's set points itself, as a perfect autopilot would: every control period
//!
//! ```text
//! v <- v + d min(1, max_acceleration T / |d|),    d = v_wanted - v          (1)
//! ```
//! It has no weight to carry and no wind to fight, and goes through what stands in its way: whoever flies
//! one keeps it off things, and lands it by its sensors. Told not to hover it stops where it is, at once. So
//! does one whose battery is empty: what the scenario says of `fall` and `stop` comes to the same, and one that
//! is to `land` sinks until its reserve is spent, or until the ground.

use glam::DVec3;
use simbeeotic_model::check::{at_least_zero, positive};
use simbeeotic_model::physics::{BodySpec, Mobility, Shape, group};
use simbeeotic_model::units::{Acceleration, Current, Enu, Length, Rate, Time, Twist, Velocity};
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
        let now = platform.velocity();
        let linear: Velocity<Enu> = if setpoint.hovering {
            let wanted = platform.attitude().rotate(setpoint.velocity);
            let most = self.params.max_acceleration * self.params.control_period;
            now + (wanted - now).limit(most)
        } else {
            // At once: nobody may call it again.
            Velocity::ZERO
        };
        let lowest_m = 0.5 * self.params.length.metres();
        let linear = match platform.position().si().z <= lowest_m {
            true => Velocity::from_si(linear.si().with_z(linear.si().z.max(0.0))),
            false => linear,
        };
        if linear != now {
            platform.set_twist(Twist {
                linear,
                angular: Rate::ZERO,
            });
        }
        let current = if setpoint.hovering {
            self.params.hover_current
        } else {
            Current::ZERO
        };
        platform.set_load(Consumer::Hover, current);
    }
}

#[cfg(test)]
mod tests {
    use crate::trial::{NoParams, run, vehicle, with_battery};
    use simbeeotic_model::config::{Node, Span};
    use simbeeotic_model::registry::{self, Kind, Make};
    use simbeeotic_model::units::{Angle, Position, Time, Velocity};
    use simbeeotic_model::{Bee, Behavior, BuildError, Kit, ModelPlan, behavior};

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

    /// A ghost with this part for its behaviour.
    fn ghost(behavior: &str) -> ModelPlan {
        let mut plan = vehicle("ghost", behavior, &[], &[], [0.0, 0.0, 5.0]);
        let Some(Make::Vehicle(make)) = registry::find(Kind::Vehicle, "ghost").map(|p| p.make)
        else {
            panic!("it is on the shelf");
        };
        let defaults = Node::table(Span::default());
        plan.vehicle = Some(make(&defaults).expect("they are right"));
        plan
    }

    /// 1 m/s² in steps of 0.1 s: 0.1 m/s more at each of twenty steps, then 2 m/s; and a stop at once.
    #[test]
    fn it_flies_its_set_points_exactly_and_lies_still_without_falling() {
        let mut run = run(vec![ghost("test-ghost-flight")], 20);
        let end = run.run();
        assert!(end.error.is_none(), "{:?}", end.error);
        let north = run.pose("ghost").expect("a body").position.si();
        // From the second step on, 0.1 (0.1 (1 + ... + 20) + 79 x 2) m.
        assert!((north.y - 17.9).abs() < 1e-9, "{north}");
        assert!(north.x.abs() < 1e-9, "{north}");
        assert_eq!(run.twist("ghost").expect("a body").linear, Velocity::ZERO);
        let up = north.z - 5.0;
        assert!(up.abs() < 0.051, "it neither falls nor climbs: {up} m");
    }

    /// Wants to go down, and on, for ever.
    #[behavior("test-ghost-dive")]
    struct Downward;

    impl Behavior for Downward {
        type Params = NoParams;

        fn build(_params: NoParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
            kit.once(Time::ZERO, |_, bee: &mut Bee<'_>| {
                bee.fly(Velocity::from_xyz(0.0, 0.0, -1.0));
            });
            Ok(Self)
        }
    }

    #[test]
    fn the_ground_ends_its_way_down() {
        let mut run = run(vec![ghost("test-ghost-dive")], 20);
        assert!(run.run().error.is_none());
        let place = run.pose("ghost").expect("a body").position.si();
        // A step of 0.1 s at 1 m/s is the most that it can be late.
        assert!((-0.05..0.05 + 1e-9).contains(&place.z), "{place}");
    }

    /// Looks around, and checks where it looks then.
    #[behavior("test-ghost-look")]
    struct Looking;

    impl Behavior for Looking {
        type Params = NoParams;

        fn build(_params: NoParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
            kit.once(Time::ZERO, |_, bee: &mut Bee<'_>| {
                for (way, yaw_deg) in [
                    ([0.0, 5.0, 5.0], 90.0),
                    ([-5.0, 0.0, -5.0], 180.0),
                    ([0.0, 0.0, 5.0], 180.0),
                    ([0.0, 0.0, 0.0], 180.0),
                ] {
                    let [east, north, up] = way;
                    bee.turn_toward(bee.position() + Position::from_xyz(east, north, up));
                    let off = bee.attitude().yaw().angle() - Angle::from_degrees(yaw_deg);
                    assert!(off.sin().abs() < 1e-9 && off.cos() > 0.0, "{way:?}");
                    assert!(bee.attitude().pitch().degrees().abs() < 1e-9, "{way:?}");
                }
            });
            Ok(Self)
        }
    }

    #[test]
    fn it_faces_a_place_upright_and_stays_as_it_is_below_one() {
        let end = run(vec![ghost("test-ghost-look")], 1).run();
        assert!(end.error.is_none(), "{:?}", end.error);
    }

    #[test]
    fn without_power_it_stops_whatever_it_was_to_do_then() {
        for on_empty in ["stop", "fall", "land"] {
            let battery = [
                ("preset", "ideal"),
                ("capacity", "1 mAh"),
                ("on_empty", on_empty),
            ];
            let plan = with_battery(ghost("test-ghost-flight"), &battery);
            let mut run = run(vec![plan], 120);
            assert!(run.run().error.is_none());
            let end = run.twist("ghost").expect("a body").linear;
            assert_eq!(end, Velocity::ZERO, "{on_empty}");
            let up = run.pose("ghost").expect("a body").position.si().z;
            assert!((-0.05..5.1).contains(&up), "{on_empty}: {up} m");
        }
    }
}

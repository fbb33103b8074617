//! A body, a sphere unless said otherwise, that flies velocity set points: the vehicle of the paper's
//! experiments.
//!
//! Every control period the bee compares the velocity it was asked for with the one it has and
//! pushes itself by the difference:
//!
//! ```text
//! a = (v_wanted - v) / response_time - F_wind / m,      |a| <= max_acceleration      (1)
//! F = m a  (+ m g upwards while hovering)                                            (2)
//! ```
//! The force holds until the next step. With the defaults (10 Hz, 1 s) a step of the set point is
//! answered by `v(n) = v_wanted (1 - 0.9^n)` after n steps, as long as (1) stays below its cap.
//! Turns are instantaneous: the bee has no attitude dynamics. A bee that neither hovers nor is asked
//! for a velocity lets itself fall.
//!
//! Source: the original's `SimpleBee`, whose law this is; masses are kilograms here, and the wind
//! acts by its velocity relative to the bee and a drag coefficient, which the original forgot.

use glam::DVec3;
use simbeeotic_model::check::{at_least_zero, in_range, positive};
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::physics::{BodySpec, Contacts, Material, Shape, group, limits};
use simbeeotic_model::units::{
    Accel, Acceleration, Angle, Attitude, Current, Enu, Flu, Force, ForceVec, Length, Mass,
    Position, Rate, Time, V3, Velocity, Yaw, math,
};
use simbeeotic_model::{
    BuildError, Consumer, Effort, Platform, Setpoint, Vehicle, VehicleKit, choice, params, vehicle,
};

use super::outline::{Outline, depth_m};
use crate::aerodynamics::Drag;
use crate::phase::Phase;
use std::sync::Arc;

/// A body that turns at once and follows velocity set points with a lag: cheap enough for a hundred
/// thousand. It is a sphere, or what `shape` says.
#[vehicle("simple-bee")]
pub struct SimpleBee {
    params: Arc<SimpleBeeParams>,
    first_control: Time,
    errors: Stream,
}

/// Parameters of [`SimpleBee`].
#[params]
pub struct SimpleBeeParams {
    /// Diameter of the body, a sphere. With another `shape`: of the disc that the wind meets.
    pub length: Length,
    /// Outline of the body, if it is not a sphere: `{ box = { length = "10 cm", width = "10 cm",
    /// height = "3 cm" } }`, or `cylinder`, `capsule`, `cone`, `hull`, `mesh`, `parts`. Its density is
    /// even; its moments of inertia follow from that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<Outline>,
    /// Whether a sphere rolls on what it touches. If not it slides, upright, as on landing gear. Other
    /// shapes turn as contacts turn them.
    pub rolls: bool,
    /// Mass of the body.
    pub mass: Mass,
    /// The most that the actuators accelerate the body, besides carrying its weight.
    pub max_acceleration: Acceleration,
    /// Time between two steps of the control law.
    pub control_period: Time,
    /// When the control law first runs: at the start, or at a random time of the first period.
    pub phase: Phase,
    /// Time constant of the velocity's answer to a set point.
    pub response_time: Time,
    /// Current that hovering draws.
    pub hover_current: Current,
    /// Current that the greatest acceleration draws; less draws in proportion.
    pub actuation_current: Current,
    /// Standard deviation of each turn's error.
    pub turn_sigma: Angle,
    /// Standard deviation of the flown direction's error, about each axis.
    pub direction_sigma: Angle,
    /// Standard deviation of the flown speed's error, as a fraction of the speed.
    pub speed_sigma: f64,
    /// Whether wind pushes the body.
    pub use_wind: bool,
    /// Drag coefficient of the body in the wind; 0.47 is a smooth sphere's at Reynolds numbers of
    /// 1e4 (Hoerner, Fluid-Dynamic Drag, 1965, ch. 3).
    pub drag_coefficient: f64,
    /// What happens at a touch: `none` (it is not noticed), `detect` (the behaviour is told),
    /// `respond` (and the body bounces).
    pub contacts: ContactMode,
    /// Whether bees touch each other too, and not only the ground.
    pub bee_collisions: bool,
    /// Restitution of the surface, 0 to 1. The fraction of the approach speed that is left after a
    /// bounce is the geometric mean of this and the other surface's: on a ground without
    /// restitution of its own (0 unless the scenario says otherwise) nothing bounces.
    pub restitution: f64,
    /// Coulomb friction of the surface; at a touch the geometric mean of this and the other
    /// surface's (the ground's is 0.5 unless the scenario says otherwise).
    pub friction: f64,
}

impl Default for SimpleBeeParams {
    fn default() -> Self {
        Self {
            length: Length::si(0.1),
            shape: None,
            rolls: false,
            mass: Mass::si(0.128),
            max_acceleration: Acceleration::si(1.0),
            control_period: Time::si(0.1),
            phase: Phase::Aligned,
            response_time: Time::si(1.0),
            hover_current: Current::si(0.5),
            actuation_current: Current::si(0.25),
            turn_sigma: Angle::ZERO,
            direction_sigma: Angle::ZERO,
            speed_sigma: 0.0,
            use_wind: false,
            drag_coefficient: 0.47,
            contacts: ContactMode::Respond,
            bee_collisions: false,
            restitution: 0.0,
            friction: 0.5,
        }
    }
}

/// What happens when a body touches something.
#[choice]
pub enum ContactMode {
    /// Nothing.
    None,
    /// Its behaviour is told.
    Detect,
    /// Its behaviour is told and it bounces.
    Respond,
}

/// Everything that physics would refuse later is refused where it is written.
fn check(p: &SimpleBeeParams) -> Result<(), BuildError> {
    let (lightest, heaviest) = limits::MASS_KG_RANGE;
    in_range("mass", p.mass, Mass::si(lightest)..=Mass::si(heaviest))?;
    positive("length", p.length)?;
    let longest = Length::si(2.0 * limits::EXTENT_M_MAX);
    in_range("length", p.length, Length::ZERO..=longest)?;
    positive("max_acceleration", p.max_acceleration)?;
    let hardest = Acceleration::si(limits::ACCELERATION_M_S2_MAX);
    in_range(
        "max_acceleration",
        p.max_acceleration,
        Acceleration::ZERO..=hardest,
    )?;
    positive("control_period", p.control_period)?;
    positive("response_time", p.response_time)?;
    at_least_zero("hover_current", p.hover_current)?;
    at_least_zero("actuation_current", p.actuation_current)?;
    at_least_zero("turn_sigma", p.turn_sigma)?;
    at_least_zero("direction_sigma", p.direction_sigma)?;
    at_least_zero("speed_sigma", p.speed_sigma)?;
    at_least_zero("drag_coefficient", p.drag_coefficient)?;
    in_range("friction", p.friction, 0.0..=limits::FRICTION_MAX)?;
    in_range("restitution", p.restitution, 0.0..=1.0)?;
    // What is left is the shape and its moments of inertia.
    body(p).check().map_err(|error| match p.shape {
        Some(_) => BuildError::parameter("shape", format!("cannot fly: {error}")),
        None => BuildError::parameter("length", format!("does not go with the mass: {error}")),
    })
}

/// The body of a bee with these parameters.
fn body(p: &SimpleBeeParams) -> BodySpec {
    let shape = match &p.shape {
        Some(outline) => outline.shape(),
        None => Shape::Sphere {
            radius_m: 0.5 * p.length.metres(),
        },
    };
    let mask = if p.bee_collisions {
        group::ALL
    } else {
        group::ALL & !group::BEE
    };
    BodySpec {
        p_enu: DVec3::new(0.0, 0.0, depth_m(&shape)),
        rolls: p.rolls,
        contacts: match p.contacts {
            ContactMode::None => Contacts::None,
            ContactMode::Detect => Contacts::Detect,
            ContactMode::Respond => Contacts::Respond,
        },
        material: Material {
            friction: p.friction,
            restitution: p.restitution,
        },
        group: group::BEE,
        mask,
        ..BodySpec::new(shape, p.mass.kilograms())
    }
}

impl Vehicle for SimpleBee {
    type Params = SimpleBeeParams;

    fn build(params: Arc<SimpleBeeParams>, kit: &VehicleKit<'_>) -> Result<Self, BuildError> {
        check(&params)?;
        let clock = kit.stream(Phase::PURPOSE);
        Ok(Self {
            first_control: params.phase.first(params.control_period, clock),
            errors: kit.stream("actuation"),
            params,
        })
    }

    fn body(&self) -> BodySpec {
        body(&self.params)
    }

    fn control_period(&self) -> Option<Time> {
        Some(self.params.control_period)
    }

    fn control_offset(&mut self) -> Time {
        self.first_control
    }

    fn control(&mut self, setpoint: &Setpoint, platform: &mut Platform<'_>) {
        let mass = self.params.mass;
        let wind = if self.params.use_wind {
            self.wind_force(platform)
        } else {
            ForceVec::ZERO
        };
        let asked = if !setpoint.hovering && setpoint.velocity == Velocity::ZERO {
            Accel::<Enu>::ZERO // it lets itself fall
        } else {
            let wanted = platform
                .attitude()
                .rotate(self.with_errors(setpoint.velocity));
            let lag = (wanted - platform.velocity()) / self.params.response_time;
            if self.params.use_wind {
                lag - wind / mass
            } else {
                lag
            }
        };

        // Half of all steps are above the cap: no branch that is guessed wrong then.
        let (most, size) = (self.params.max_acceleration, asked.length());
        let effort = if size.is_finite() {
            asked * (most / size).min(1.0)
        } else {
            asked.limit(most)
        };
        let gravity = platform.gravity();
        let (hover, weight) = if setpoint.hovering {
            (self.params.hover_current, mass * gravity)
        } else {
            (Current::ZERO, Force::ZERO)
        };
        let weight = ForceVec::<Enu>::new(Force::ZERO, Force::ZERO, weight);
        let thrust = effort * mass + weight;
        platform.set_force(thrust + wind);

        platform.set_load(Consumer::Hover, hover);
        let share = size.min(most) / most;
        platform.set_load(Consumer::Actuation, self.params.actuation_current * share);
        platform.set_effort(|| {
            let (most, thrust) = (mass * (most + gravity), thrust.length());
            Effort {
                thrust,
                fraction: thrust / most,
            }
        });
    }

    fn turn(&mut self, angle: Angle, platform: &mut Platform<'_>) {
        let error = self.params.turn_sigma * self.noise(self.params.turn_sigma);
        let turn = angle + error;
        let before = platform.attitude();
        let q = before.quat();
        let after = if q.x == 0.0 && q.y == 0.0 {
            // Upright, as nearly always: a product of quaternions instead of an arc tangent (60 ns).
            before * Attitude::about(DVec3::Z, turn)
        } else {
            Attitude::from_yaw(before.yaw() + turn)
        };
        platform.set_attitude(after);
        if platform.rate() != Rate::ZERO {
            platform.set_rate(Rate::ZERO);
        }
    }

    fn turn_toward(&mut self, point: Position, platform: &mut Platform<'_>) {
        let way = (point - platform.position()).si();
        if way.length_squared() > 0.0 {
            let level = (way.x * way.x + way.y * way.y).sqrt();
            // Pitch turns about the left axis: nose up is negative.
            let pitch = Angle::si(-math::atan2(way.z, level));
            let yaw = Yaw::new(Angle::si(math::atan2(way.y, way.x)));
            platform.set_attitude(Attitude::from_rpy(Angle::ZERO, pitch, yaw));
            platform.set_rate(Rate::ZERO);
        }
    }
}

impl SimpleBee {
    /// Drag of the air that moves past the body, `½ ρ C_d A |u| u` with u relative to the body; of a
    /// body so light that this would turn it back within a step, no more than what stops it.
    fn wind_force(&self, platform: &Platform<'_>) -> ForceVec<Enu> {
        let p = &self.params;
        let past = platform.wind() - platform.velocity();
        let drag = Drag::of_disc(p.drag_coefficient, p.length);
        let force = drag.force(past, platform.air_density());
        let stops = past.si().length() * p.mass.get() / p.control_period.get();
        let size = force.si().length();
        if size > stops {
            force * (stops / size)
        } else {
            force
        }
    }

    /// What is really flown when `wanted` is asked for.
    fn with_errors(&mut self, wanted: Velocity<Flu>) -> Velocity<Flu> {
        let (direction, speed) = (
            self.params.direction_sigma.radians(),
            self.params.speed_sigma,
        );
        let mut flown = wanted;
        if direction > 0.0 {
            let turn = DVec3::new(
                self.errors.normal(),
                self.errors.normal(),
                self.errors.normal(),
            );
            let turned = Attitude::exp(V3::from_si(turn * direction)).rotate(flown);
            flown = Velocity::from_si(turned.si());
        }
        if speed > 0.0 {
            flown *= 1.0 + speed * self.errors.normal();
        }
        flown
    }

    /// A normal draw, or nothing (and no draw) when sigma is zero.
    fn noise(&mut self, sigma: Angle) -> f64 {
        if sigma > Angle::ZERO {
            self.errors.normal()
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{NoParams, assert_normal, bee, run, vehicle};
    use simbeeotic_model::kernel::SimTime;
    use simbeeotic_model::{Bee, Behavior, Kit, behavior};

    const DRAWS: usize = 10_000;

    fn inaccurate(direction_sigma: Angle, speed_sigma: f64) -> SimpleBee {
        SimpleBee {
            params: Arc::new(SimpleBeeParams {
                direction_sigma,
                speed_sigma,
                ..SimpleBeeParams::default()
            }),
            first_control: Time::ZERO,
            errors: Stream::new(1, "bee", "actuation"),
        }
    }

    /// Speed of a bee that lets itself go, after some seconds.
    fn let_go(gear: &[(&str, &str)], up: f64, wind: [f64; 3], seconds: u64) -> DVec3 {
        use crate::weather::constant::{ConstantWeather, ConstantWeatherParams};
        use simbeeotic_model::{FromParams, Setup, Simulation};
        let wind = Velocity::from_xyz(wind[0], wind[1], wind[2]);
        let weather = ConstantWeather::from_params(ConstantWeatherParams { wind });
        let plan = vehicle("bee", "inert-bee", &[], gear, [0.0, 0.0, up]);
        let setup = Setup {
            weather: Arc::new(weather.expect("good numbers")),
            ..crate::trial::setup(vec![plan], seconds)
        };
        let mut run = Simulation::new(setup).expect("it can be put together");
        run.run_until(SimTime::from_secs(seconds)).expect("it runs");
        run.twist("bee").expect("a body").linear.si()
    }

    /// `v = sqrt(2 m g / (rho C_d A))`, rho of the standard atmosphere where it is then.
    #[test]
    fn what_falls_through_still_air_ends_at_its_terminal_speed_for_the_density_there() {
        let gear = [
            ("use_wind", "true"),
            ("drag_coefficient", "1.2"),
            ("mass", "20 g"),
        ];
        for (up, density) in [(1_080.0, 1.112), (3_080.0, 0.909)] {
            let v = let_go(&gear, up, [0.0; 3], 12);
            let area = std::f64::consts::PI * 0.05 * 0.05;
            let terminal = (2.0 * 0.02 * 9.81 / (density * 1.2 * area)).sqrt();
            assert!((v.z / -terminal - 1.0).abs() < 0.01, "{v}, {terminal}");
            // With wind it falls as fast through the air that moves.
            let blown = let_go(&gear, up, [6.0, 0.0, 0.0], 12);
            assert!(
                (blown.x - 6.0).abs() < 0.02 && (blown.z / v.z - 1.0).abs() < 0.01,
                "{blown}"
            );
        }
    }

    #[test]
    fn a_bee_as_light_as_a_feather_is_carried_and_not_thrown_about() {
        let gear = [
            ("use_wind", "true"),
            ("mass", "0.1 g"),
            ("drag_coefficient", "1"),
        ];
        let v = let_go(&gear, 500.0, [15.0, 0.0, 0.0], 20);
        assert!((v.x - 15.0).abs() < 0.1 && v.z > -1.5 && v.z < 0.0, "{v}");
    }

    #[test]
    fn the_speed_flown_has_the_error_it_says() {
        let mut bee = inaccurate(Angle::ZERO, 0.05);
        let wanted = Velocity::<Flu>::from_xyz(2.0, 0.0, 0.0);
        let flown: Vec<Velocity<Flu>> = (0..DRAWS).map(|_| bee.with_errors(wanted)).collect();
        assert!(flown.iter().all(|v| v.si().y == 0.0 && v.si().z == 0.0));
        let speeds: Vec<f64> = flown.iter().map(|v| v.si().x).collect();
        assert_normal(&speeds, 2.0, 2.0 * 0.05);
    }

    #[test]
    fn the_direction_flown_has_the_error_it_says_about_each_axis() {
        let sigma = 0.01;
        let mut bee = inaccurate(Angle::si(sigma), 0.0);
        let wanted = Velocity::<Flu>::from_xyz(1.0, 0.0, 0.0);
        let flown: Vec<Velocity<Flu>> = (0..DRAWS).map(|_| bee.with_errors(wanted)).collect();
        assert!(flown.iter().all(|v| (v.si().length() - 1.0).abs() < 1e-12));
        let aside: Vec<f64> = flown.iter().map(|v| v.si().y).collect();
        assert_normal(&aside, 0.0, sigma);
        let above: Vec<f64> = flown.iter().map(|v| v.si().z).collect();
        assert_normal(&above, 0.0, sigma);
    }

    #[test]
    fn without_errors_nothing_is_drawn() {
        let mut bee = inaccurate(Angle::ZERO, 0.0);
        let wanted = Velocity::<Flu>::from_xyz(1.0, 2.0, 3.0);
        assert_eq!(bee.with_errors(wanted), wanted);
        let mut fresh = Stream::new(1, "bee", "actuation");
        assert_eq!(bee.errors.next_u64(), fresh.next_u64());
    }

    /// Turns on the spot, over and over, then toward places above and below.
    #[behavior("test-simple-bee-turns")]
    struct Turner;

    impl Behavior for Turner {
        type Params = NoParams;

        fn build(_params: NoParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
            kit.once(Time::from_secs(1.0), Self::turn);
            kit.once(Time::from_secs(2.0), Self::look);
            Ok(Self)
        }
    }

    impl Turner {
        fn turn(&mut self, bee: &mut Bee<'_>) {
            let errors: Vec<f64> = (0..DRAWS)
                .map(|_| {
                    let before = bee.attitude().yaw().angle();
                    bee.turn(Angle::from_degrees(40.0));
                    let turned = bee.attitude().yaw().angle() - before;
                    turned.wrapped_positive().degrees()
                })
                .collect();
            assert_normal(&errors, 40.0, 2.0);
        }

        fn look(&mut self, bee: &mut Bee<'_>) {
            for (way, pitch, yaw) in [
                ([0.0, 5.0, 5.0], -45.0, 90.0),
                ([-5.0, 0.0, -5.0], 45.0, 180.0),
                ([0.0, 0.0, 5.0], -90.0, 0.0),
                ([0.0, 0.0, -5.0], 90.0, 0.0),
            ] {
                let [east, north, up] = way;
                bee.turn_toward(bee.position() + Position::from_xyz(east, north, up));
                let nose = bee
                    .attitude()
                    .rotate(Velocity::<Flu>::from_xyz(1.0, 0.0, 0.0));
                let wanted = DVec3::from_array(way).normalize();
                assert!(nose.si().abs_diff_eq(wanted, 1e-9), "{nose} for {way:?}");
                assert!(
                    (bee.attitude().pitch().degrees() - pitch).abs() < 1e-5,
                    "{way:?}"
                );
                if pitch.abs() < 89.0 {
                    let off = bee.attitude().yaw().angle() - Angle::from_degrees(yaw);
                    assert!(off.sin().abs() < 1e-9 && off.cos() > 0.0, "{way:?}");
                }
            }
            let before = bee.attitude();
            bee.turn_toward(bee.position());
            assert_eq!(bee.attitude(), before, "where it is, there is no direction");
        }
    }

    #[test]
    fn turns_have_the_error_they_say_and_noses_point_where_they_should() {
        let gear = [("turn_sigma", "2 deg")];
        let plan = vehicle("bee", "test-simple-bee-turns", &[], &gear, [0.0, 0.0, 50.0]);
        let outcome = run(vec![plan], 3).run();
        assert!(outcome.error.is_none(), "{:?}", outcome.error);
    }

    /// Wants to be much faster than it can.
    #[behavior("test-simple-bee-hurry")]
    struct Hurry;

    impl Behavior for Hurry {
        type Params = NoParams;

        fn build(_params: NoParams, _kit: &mut Kit<Self>) -> Result<Self, BuildError> {
            Ok(Self)
        }

        fn on_control(&mut self, bee: &mut Bee<'_>) {
            bee.fly(Velocity::from_xyz(100.0, 0.0, 0.0));
        }
    }

    #[test]
    fn acceleration_is_capped_and_both_currents_are_booked() {
        let mut run = run(
            vec![bee("bee", "test-simple-bee-hurry", &[], [0.0, 0.0, 50.0])],
            10,
        );
        for second in 1..=10 {
            run.run_until(SimTime::from_secs(second)).expect("it runs");
            let velocity = run.twist("bee").expect("a body").linear;
            let expected = second as f64; // 1 m/s^2
            assert!(
                (velocity.length().metres_per_second() - expected).abs() < 1e-9,
                "{velocity}"
            );
        }
        run.run();
        let accounts = run.accounts("bee").expect("it draws");
        let drawn = |consumer| accounts.drawn(consumer).coulombs();
        assert!((drawn(Consumer::Hover) - 0.5 * 10.0).abs() < 1e-9);
        assert!((drawn(Consumer::Actuation) - 0.25 * 10.0).abs() < 1e-9);
    }

    #[test]
    fn bodies_that_physics_would_refuse_are_refused_here() {
        let fault = |change: fn(&mut SimpleBeeParams)| {
            let mut params = SimpleBeeParams::default();
            change(&mut params);
            check(&params).err().map(|fault| fault.to_string())
        };
        assert_eq!(fault(|_| {}), None);
        let wrong: [fn(&mut SimpleBeeParams); 10] = [
            |p| p.mass = Mass::si(1e-10),
            |p| p.mass = Mass::si(1e10),
            |p| p.length = Length::ZERO,
            |p| p.length = Length::si(3e5),
            |p| (p.length, p.mass) = (Length::si(1e-7), Mass::si(1e-9)),
            |p| p.max_acceleration = Acceleration::si(1e7),
            |p| p.control_period = Time::ZERO,
            |p| p.friction = 1e4,
            |p| p.restitution = 1.1,
            |p| p.turn_sigma = Angle::si(f64::NAN),
        ];
        for (place, change) in wrong.into_iter().enumerate() {
            assert!(fault(change).is_some(), "case {place}");
        }
        let message = fault(|p| p.mass = Mass::si(1e-10)).expect("too light");
        assert!(message.contains("is 1e-10 kg"), "{message}");
    }
}

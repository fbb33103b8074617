//! A sphere that flies velocity set points: the vehicle of the paper's experiments.
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
use simbeeotic_model::kernel::{SimTime, Stream};
use simbeeotic_model::physics::{BodySpec, Contacts, Material, Shape, group, limits};
use simbeeotic_model::units::{
    Accel, Acceleration, Angle, Attitude, Current, Enu, Flu, Force, ForceVec, Length, Mass,
    Position, Rate, Time, V3, Velocity, Yaw, math,
};
use simbeeotic_model::{
    BuildError, Consumer, Platform, Setpoint, Vehicle, VehicleKit, choice, params, vehicle,
};

use crate::phase::Phase;

/// A sphere that turns at once and follows velocity set points with a lag: cheap enough for a
/// hundred thousand.
#[vehicle("simple-bee")]
pub struct SimpleBee {
    params: SimpleBeeParams,
    errors: Stream,
    /// Since when the current force has been drawing charge.
    since: SimTime,
    /// Acceleration asked of the actuators at the last step, m/s².
    effort_m_s2: f64,
    hovering: bool,
}

/// Parameters of [`SimpleBee`].
#[params]
pub struct SimpleBeeParams {
    /// Diameter of the body.
    pub length: Length,
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

impl Vehicle for SimpleBee {
    type Params = SimpleBeeParams;

    fn build(params: SimpleBeeParams, kit: &VehicleKit<'_>) -> Result<Self, BuildError> {
        let p = &params;
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
        let errors = kit.stream("actuation");
        let bee = Self {
            params,
            errors,
            since: SimTime::ZERO,
            effort_m_s2: 0.0,
            hovering: false,
        };
        // What is left is their moment of inertia.
        match bee.body().check() {
            Ok(()) => Ok(bee),
            Err(error) => Err(BuildError::parameter(
                "length",
                format!("does not go with the mass: {error}"),
            )),
        }
    }

    fn body(&self) -> BodySpec {
        let p = &self.params;
        let radius = 0.5 * p.length.metres();
        let mask = if p.bee_collisions {
            group::ALL
        } else {
            group::ALL & !group::BEE
        };
        BodySpec {
            p_enu: DVec3::new(0.0, 0.0, radius),
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
            ..BodySpec::new(Shape::Sphere { radius_m: radius }, p.mass.kilograms())
        }
    }

    fn control_period(&self) -> Option<Time> {
        Some(self.params.control_period)
    }

    fn control_offset(&mut self) -> Time {
        self.params
            .phase
            .first(self.params.control_period, &mut self.errors)
    }

    fn control(&mut self, setpoint: &Setpoint, platform: &mut Platform<'_>) {
        self.settle(platform);

        let mass = self.params.mass;
        let wind = if self.params.use_wind {
            self.wind_force(platform)
        } else {
            ForceVec::ZERO
        };
        let effort = if !setpoint.hovering && setpoint.velocity == Velocity::ZERO {
            Accel::<Enu>::ZERO // it lets itself fall
        } else {
            let wanted = platform
                .attitude()
                .rotate(self.with_errors(setpoint.velocity));
            let lag = (wanted - platform.velocity()) / self.params.response_time;
            let wind = wind / mass;
            (lag - wind).limit(self.params.max_acceleration)
        };

        self.effort_m_s2 = effort.si().length();
        self.hovering = setpoint.hovering;
        let weight = if setpoint.hovering {
            mass * platform.gravity()
        } else {
            Force::ZERO
        };
        let weight = ForceVec::<Enu>::new(Force::ZERO, Force::ZERO, weight);
        platform.set_force(effort * mass + weight + wind);
    }

    fn turn(&mut self, angle: Angle, platform: &mut Platform<'_>) {
        let error = self.params.turn_sigma * self.noise(self.params.turn_sigma);
        let yaw = platform.attitude().yaw().angle() + angle + error;
        platform.set_attitude(Attitude::from_yaw(Yaw::new(yaw)));
        platform.set_rate(Rate::ZERO);
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

    fn finish(&mut self, _setpoint: &Setpoint, platform: &mut Platform<'_>) {
        self.settle(platform);
    }
}

impl SimpleBee {
    /// Books the charge drawn since the last step.
    fn settle(&mut self, platform: &mut Platform<'_>) {
        let now = platform.now();
        let span = Time::from_nanos(now.nanos_since(self.since) as f64);
        self.since = now;
        if self.hovering {
            platform.draw(Consumer::Hover, self.params.hover_current * span);
        }
        let share = self.effort_m_s2 / self.params.max_acceleration.metres_per_second_squared();
        platform.draw(
            Consumer::Actuation,
            self.params.actuation_current * span * share,
        );
    }

    /// Drag of the air that moves past the body: `½ ρ C_d A |u| u`, u relative to the body.
    fn wind_force(&self, platform: &Platform<'_>) -> ForceVec<Enu> {
        let u = (platform.wind() - platform.velocity()).si();
        let radius = 0.5 * self.params.length.metres();
        let area = std::f64::consts::PI * radius * radius;
        let density = platform.air_density().get();
        ForceVec::from_si(u * (0.5 * density * self.params.drag_coefficient * area * u.length()))
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

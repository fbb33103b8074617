//! A MAV of the flock: what it tells, what it hears, how it flies.

use super::law::Law;
use super::table::{State, Table};
use simbeeotic::models::sensor::gnss::Fix;
use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec3;
use simbeeotic::units::math;
use std::f64::consts::TAU;

/// A MAV that flies with those whom it hears. It needs a radio, and a sensor called `gnss` with a rate.
///
/// It publishes, once a second, `neighbours` (how many it knows) and `age` (how old what it knows of them is,
/// in the mean); and with each touch of another vehicle `collisions`.
#[behavior("flock-bee")]
pub struct FlockBee {
    params: FlockBeeParams,
    gnss: Handle<Option<Fix>>,
    radio: RadioHandle,
    chance: Stream,
    tell: TimerHandle,
    /// What is older is forgotten.
    memory: Time,
    table: Table,
    /// The newest fix.
    own: Option<State>,
    /// Where it flies on its own.
    ahead: DVec3,
    collisions: u32,
}

/// Parameters of [`FlockBee`].
#[params]
pub struct FlockBeeParams {
    /// Side of the square, about the origin, that the flock stays in. Above 0.
    pub arena: Length,
    /// How high it flies.
    pub height: Length,
    /// Time between two broadcasts; each comes up to a tenth of it earlier or later. Above 0.
    pub period: Time,
    /// Who was not heard for so many periods is forgotten. Together at most a minute, since packets say
    /// their time in 16 bits of milliseconds.
    pub expiry: u16,
    /// Whether what was heard is carried on to now by its velocity.
    pub dead_reckoning: bool,
    /// The flocking law.
    pub law: Law,
}

impl Default for FlockBeeParams {
    fn default() -> Self {
        Self {
            arena: Length::si(150.0),
            height: Length::si(20.0),
            period: Time::from_millis(250.0),
            expiry: 5,
            dead_reckoning: true,
            law: Law::default(),
        }
    }
}

/// Slower than this it has no direction of its own, m/s.
const SLOW_M_S: f64 = 0.3;
/// A fix that is older than this is none, s.
const LOST_S: f64 = 2.0;
/// It climbs by this part of what is missing in each second, 1/s.
const CLIMB_HZ: f64 = 0.5;

impl Behavior for FlockBee {
    type Params = FlockBeeParams;

    fn build(params: FlockBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        positive("arena", params.arena)?;
        positive("height", params.height)?;
        positive("period", params.period)?;
        let memory = params.period * f64::from(params.expiry);
        if memory > Time::from_secs(60.0) {
            let message = format!("must be at most a minute with the `period`; it is {memory}");
            return Err(BuildError::parameter("expiry", message));
        }
        params.law.check()?;
        let mut chance = kit.stream("flock");
        let (sin, cos) = math::sin_cos(TAU * chance.uniform());
        let tell = kit.once(params.period * chance.uniform(), Self::tell);
        kit.every(Time::from_secs(1.0), Self::publish);
        Ok(Self {
            gnss: kit.on_sample("gnss", Self::fix)?,
            radio: kit.radio()?,
            chance,
            tell,
            table: Table::default(),
            own: None,
            ahead: DVec3::new(cos, sin, 0.0),
            collisions: 0,
            memory,
            params,
        })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        let now = bee.now();
        let fresh = |own: &State| now - own.time < Time::from_secs(LOST_S);
        let Some(own) = self.own.filter(fresh) else {
            // Nobody knows where it is, and it does not either: it stays.
            return bee.fly(Velocity::default());
        };
        self.table.forget(now, self.memory);
        if own.v_enu.with_z(0.0).length() > SLOW_M_S {
            self.ahead = own.v_enu.with_z(0.0).normalize();
        }
        let reckons = self.params.dead_reckoning;
        let others = self.table.neighbours();
        let others = others.map(|other| match reckons {
            true => (other.at(now), other.v_enu),
            false => (other.p_enu, other.v_enu),
        });
        let (here, arena_m) = (own.at(now), self.params.arena.get());
        let wanted = self
            .params
            .law
            .velocity(here, own.v_enu, self.ahead, others, arena_m);
        let climb = (self.params.height.get() - here.z) * CLIMB_HZ;
        let wanted = Velocity::<Enu>::from_si(wanted + DVec3::Z * climb.clamp(-1.0, 1.0));
        // It looks where it flies.
        let wanted_flu = bee.attitude().unrotate(wanted);
        bee.turn(Angle::atan2(wanted_flu.left(), wanted_flu.forward()));
        let wanted_flu = bee.attitude().unrotate(wanted);
        bee.fly(wanted_flu);
    }

    fn on_packet(&mut self, packet: &Packet<'_>, _bee: &mut Bee<'_>) {
        self.table.hear(packet);
    }

    fn on_contact(&mut self, touch: &Touch, bee: &mut Bee<'_>) {
        if touch.other.model().is_some() {
            self.collisions += 1;
            bee.metric("collisions", f64::from(self.collisions), "1");
        }
    }
}

impl FlockBee {
    /// A fix has arrived. It is as old as the receiver takes.
    fn fix(&mut self, bee: &mut Bee<'_>) {
        let sample = bee.sample(self.gnss);
        if let Some(fix) = sample.reading {
            self.own = Some(State {
                time: sample.taken,
                p_enu: fix.position.si(),
                v_enu: fix.velocity.si(),
            });
        }
    }

    fn tell(&mut self, bee: &mut Bee<'_>) {
        if let Some(own) = self.own {
            bee.send(self.radio, &own.encode());
        }
        let jitter = 0.9 + 0.2 * self.chance.uniform();
        bee.arm(self.tell, self.params.period * jitter);
    }

    fn publish(&mut self, bee: &mut Bee<'_>) {
        self.table.forget(bee.now(), self.memory);
        bee.metric("neighbours", self.table.neighbours().len() as f64, "1");
        if let Some(age) = self.table.age(bee.now()) {
            bee.metric("age", age.secs(), "s");
        }
    }
}

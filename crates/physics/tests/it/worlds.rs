//! What the tests build their worlds from.

use simbeeotic_kernel::{SimTime, rng::Stream};
use simbeeotic_physics::{BodyId, BodySpec, Config, Contact, Material, Physics, Shape};
use simbeeotic_units::{Acceleration, Time, glam::DVec3};

pub(crate) const G: f64 = 9.80665;

/// A ball of 0.1 m and 0.1 kg at `p`.
pub(crate) fn ball(p: DVec3) -> BodySpec {
    BodySpec {
        p_enu: p,
        ..BodySpec::new(Shape::Sphere { radius_m: 0.1 }, 0.1)
    }
}

/// The same without weight, with velocity `v`.
pub(crate) fn floating(p: DVec3, v: DVec3) -> BodySpec {
    BodySpec {
        v_enu: v,
        gravity: false,
        ..ball(p)
    }
}

pub(crate) fn surface(friction: f64, restitution: f64) -> Material {
    Material {
        friction,
        restitution,
    }
}

/// A world with ground, and one without weight and ground.
pub(crate) fn on_ground(ground: Material) -> Physics {
    Physics::new(Config {
        ground: Some(ground),
        ..Config::default()
    })
}

pub(crate) fn in_space() -> Physics {
    let gravity = Acceleration::si(0.0);
    Physics::new(Config {
        ground: None,
        gravity,
        ..Config::default()
    })
}

pub(crate) fn listed_every(ground: Option<Material>, period: f64) -> Physics {
    Physics::new(Config {
        ground,
        list_period: Time::from_secs(period),
        ..Config::default()
    })
}

/// Runs as an engine does that has no events of its own.
pub(crate) fn run(physics: &mut Physics, until: SimTime) -> Vec<Contact> {
    let mut contacts = Vec::new();
    while let Some(next) = physics.next_time().filter(|next| *next <= until) {
        physics.advance(next, &mut contacts);
        physics.settle(next);
    }
    physics.advance(until, &mut contacts);
    physics.settle(until);
    contacts
}

pub(crate) fn seconds(s: f64) -> SimTime {
    SimTime::from_nanos((s * 1e9).round() as u64)
}

pub(crate) fn as_seconds(t: SimTime) -> f64 {
    t.nanos() as f64 / 1e9
}

pub(crate) fn stream(purpose: &str) -> Stream {
    Stream::new(1982, "physics", purpose)
}

pub(crate) fn direction(stream: &mut Stream) -> DVec3 {
    stream.unit_vector()
}

/// Kinetic energy of all bodies at `t`, spin included.
pub(crate) fn kinetic_energy(physics: &Physics, t: SimTime) -> f64 {
    let of = |id: u32| {
        let motion = physics.motion(BodyId(id));
        let state = motion.at(t);
        0.5 * motion.mass_kg() * state.v_enu.length_squared()
            + 0.5 * (motion.inertia_kg_m2() * state.w_flu * state.w_flu).element_sum()
    };
    (0..physics.len() as u32).map(of).sum()
}

/// A word that depends on every bit of every body's state at `t`.
pub(crate) fn fingerprint(physics: &Physics, bodies: std::ops::Range<u32>, t: SimTime) -> u64 {
    let mut word = 0xcbf2_9ce4_8422_2325_u64;
    for id in bodies {
        let s = physics.motion(BodyId(id)).at(t);
        let q = s.world_from_body;
        let numbers = [s.p_enu, s.v_enu, s.w_flu, DVec3::new(q.x, q.y, q.z)];
        for number in numbers.iter().flat_map(|v| v.to_array()).chain([q.w]) {
            word = (word ^ number.to_bits())
                .wrapping_mul(0x0000_0100_0000_01b3)
                .rotate_left(29);
        }
    }
    word
}

//! Radios at given places, and what they heard.

use simbeeotic_kernel::rng::path_key;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{
    Medium, Poses, RadioId, RadioSpec, Request, Scratch, SimpleConfig, SimpleMedium, cc2420,
};
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::{Attitude, Decibels, Frequency, Length, Pose, Position, PowerLevel};
use std::sync::Arc;

/// Platforms at fixed poses.
pub(crate) struct Still(pub(crate) Vec<Pose>);

impl Still {
    pub(crate) fn at<P: Into<DVec3>>(places: impl IntoIterator<Item = P>) -> Self {
        let pose = |p: P| Pose::new(Position::from_si(p.into()), Attitude::IDENTITY);
        Self(places.into_iter().map(pose).collect())
    }
}

impl Poses for Still {
    fn pose(&self, owner: ModelId) -> Pose {
        self.0[owner.index()]
    }

    /// A wall at north = 0 that takes 6 dB; leaves take a little everywhere.
    fn obstruction(&self, ends: [(ModelId, Position); 2], _: Frequency) -> Decibels {
        let norths = ends.map(|(owner, position)| {
            assert_eq!(position.si().is_finite(), owner.index() < self.0.len());
            position.si().y
        });
        let through = norths[0].signum() != norths[1].signum();
        Decibels::from_db(if through { 6.0 } else { 0.25 })
    }
}

/// The paper's medium with a range of 30 m.
pub(crate) fn config() -> SimpleConfig {
    SimpleConfig {
        seed: 5,
        range_limit: Length::from_metres(30.0),
        ..SimpleConfig::default()
    }
}

/// No noise to speak of: all above the sensitivity is received.
pub(crate) fn quiet() -> SimpleConfig {
    SimpleConfig {
        noise_floor: PowerLevel::from_dbm(-120.0),
        noise_sigma: Decibels::ZERO,
        ..config()
    }
}

/// Bee number `bee` with a CC2420 on channel 11 at full power.
pub(crate) fn bee(bee: usize) -> RadioSpec {
    let key = path_key(&format!("bee-{bee}/radio"));
    RadioSpec {
        owner: ModelId(bee as u32),
        key,
        ..cc2420::spec(11, 31).unwrap()
    }
}

pub(crate) fn medium(
    config: SimpleConfig,
    specs: impl IntoIterator<Item = RadioSpec>,
) -> SimpleMedium {
    let mut medium = SimpleMedium::new(config).unwrap();
    for spec in specs {
        medium.add(spec).unwrap();
    }
    medium
}

pub(crate) fn broadcast(radio: u32, payload: &[u8]) -> Request {
    Request::broadcast(RadioId(radio), Arc::from(payload))
}

pub(crate) fn secs(secs: u64) -> SimTime {
    SimTime::from_secs(secs)
}

/// One reception: receiver, sender, first byte, bits of the received power.
pub(crate) type Reception = (u32, u32, Option<u8>, u64);

/// Opens a round and collects everything, as the engine does. Checks that exactly those listed find
/// something.
pub(crate) fn round(medium: &mut SimpleMedium, now: SimTime, poses: &dyn Poses) -> Vec<Reception> {
    let mut owners = vec![ModelId(77)];
    medium.open(now, poses, &mut owners);
    assert!(
        owners.is_sorted_by(|a, b| a < b),
        "sorted, each once: {owners:?}"
    );

    let mut scratch = Scratch::new();
    let mut receptions = Vec::new();
    let mut with_mail = Vec::new();
    for radio in 0..medium.radios() as u32 {
        let owner = medium.spec(RadioId(radio)).owner;
        if !owners.contains(&owner) {
            continue;
        }
        let inbox = medium.collect(RadioId(radio), poses, &mut scratch);
        if !inbox.is_empty() || !inbox.outcomes().is_empty() {
            with_mail.push(owner);
        }
        receptions.extend(inbox.iter().map(|packet| {
            let first = packet.payload().first().copied();
            (
                radio,
                packet.sender().0,
                first,
                packet.rssi().dbm().to_bits(),
            )
        }));
        let digest = inbox.digest();
        assert_eq!(
            digest,
            medium.collect(RadioId(radio), poses, &mut scratch).digest()
        );
    }
    with_mail.sort_unstable();
    with_mail.dedup();
    assert_eq!(owners, with_mail, "those listed are those with mail");
    receptions
}

/// (receiver, sender) of each reception.
pub(crate) fn pairs(receptions: &[Reception]) -> Vec<(u32, u32)> {
    receptions.iter().map(|&(rx, tx, ..)| (rx, tx)).collect()
}

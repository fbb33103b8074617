//! Antennas on bodies in any attitude, through the medium, against closed forms.

use crate::support::{Still, bee, broadcast, config, medium, quiet, round, secs};
use proptest::prelude::*;
use simbeeotic_kernel::Stream;
use simbeeotic_radio::{
    Antenna, Arithmetic, Cosine, HalfWaveDipole, Ieee802154Config, Ieee802154Medium, Isotropic,
    Medium, Patch, RadioId, RadioSpec, Scratch, ShortDipole, SimpleConfig, SimpleMedium,
};
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::{
    Angle, Attitude, Decibels, Mount, Offset, Pose, Position, PowerLevel, Yaw, math,
};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// Received power between two radios with these antennas, mounts and poses, dBm; `None` if it is lost.
fn rssi(ends: [(Arc<dyn Antenna>, Mount, Pose); 2]) -> Option<f64> {
    let poses = Still(ends.iter().map(|(.., pose)| *pose).collect());
    let specs = ends
        .into_iter()
        .enumerate()
        .map(|(i, (antenna, mount, _))| RadioSpec {
            antenna,
            mount,
            sensitivity: PowerLevel::from_dbm(-140.0),
            ..bee(i)
        });
    let mut quiet = quiet();
    quiet.noise_floor = PowerLevel::from_dbm(-170.0);
    let mut air = medium(quiet, specs);
    simbeeotic_radio::Medium::submit(&mut air, secs(1), broadcast(0, b"x"));
    let heard = round(&mut air, secs(1), &poses);
    heard.first().map(|&(.., bits)| f64::from_bits(bits))
}

fn turned(roll: f64, pitch: f64, yaw: f64) -> Attitude {
    Attitude::from_rpy(Angle::si(roll), Angle::si(pitch), Yaw::si(yaw))
}

fn at(x: f64, y: f64, z: f64, attitude: Attitude) -> Pose {
    Pose::new(Position::from_xyz(x, y, z), attitude)
}

/// What free space takes at 2405 MHz over a distance.
fn friis_db(distance_m: f64) -> f64 {
    let wavelength_m = 299_792_458.0 / 2.405e9;
    20.0 * math::log10(4.0 * PI * distance_m / wavelength_m)
}

/// The textbook's half-wave dipole, by the angle between rod and direction.
fn half_wave_db(rod: DVec3, direction: DVec3) -> f64 {
    let cos = rod.dot(direction).clamp(-1.0, 1.0);
    let sin = (1.0 - cos * cos).sqrt();
    let factor = math::cos(FRAC_PI_2 * cos) / sin;
    (10.0 * math::log10(1.640_922 * factor * factor)).max(-30.0)
}

#[test]
fn a_rod_that_points_at_its_partner_is_in_its_null() {
    let dipole = || Arc::new(HalfWaveDipole::default()) as Arc<dyn Antenna>;
    let level = at(0.0, 0.0, 5.0, Attitude::IDENTITY);
    let partner = at(10.0, 0.0, 5.0, Attitude::IDENTITY);
    let broadside = rssi([
        (dipole(), Mount::IDENTITY, level),
        (dipole(), Mount::IDENTITY, partner),
    ]);
    assert!((broadside.unwrap() - (4.302 - friis_db(10.0))).abs() < 0.01);
    // Pitched up or down by a right angle the rod lies along the link: 32.15 dB less.
    for pitch in [FRAC_PI_2, -FRAC_PI_2] {
        let nosing = at(0.0, 0.0, 5.0, turned(0.0, pitch, 0.0));
        let null = rssi([
            (dipole(), Mount::IDENTITY, nosing),
            (dipole(), Mount::IDENTITY, partner),
        ]);
        assert!((null.unwrap() - (2.151 - 30.0 - friis_db(10.0))).abs() < 0.01);
    }
    // Rolled about the link, or yawed about its rod, it stays broadside.
    for attitude in [turned(1.0, 0.0, 0.0), turned(0.0, 0.0, 2.0)] {
        let rolled = at(0.0, 0.0, 5.0, attitude);
        let same = rssi([
            (dipole(), Mount::IDENTITY, rolled),
            (dipole(), Mount::IDENTITY, partner),
        ]);
        assert!((same.unwrap() - broadside.unwrap()).abs() < 1e-3);
    }
}

#[test]
fn a_boresight_looks_where_the_body_and_its_mount_look() {
    // The original never turned a pattern: its antennas' `rotation` had no effect.
    let patch = || Arc::new(Patch::default()) as Arc<dyn Antenna>;
    let rod = || Arc::new(Isotropic::default()) as Arc<dyn Antenna>;
    let gain = |mount: Mount, attitude: Attitude, partner: DVec3| {
        let there = Pose::new(Position::from_si(partner * 10.0), Attitude::IDENTITY);
        let here = at(0.0, 0.0, 0.0, attitude);
        let power = rssi([(patch(), mount, here), (rod(), Mount::IDENTITY, there)]);
        power.unwrap() + friis_db(10.0)
    };
    let facing = |attitude| Mount::new(Offset::ZERO, attitude);
    let (front, back) = (
        Patch::default().gain(DVec3::X).db(),
        Patch::default().gain(-DVec3::X).db(),
    );
    let quarter = FRAC_PI_2;
    for (mount, attitude, direction) in [
        (turned(0.0, 0.0, 0.0), turned(0.0, 0.0, 0.0), DVec3::X),
        // The body yaws left: it faces north.
        (turned(0.0, 0.0, 0.0), turned(0.0, 0.0, quarter), DVec3::Y),
        // The mount looks left on the body.
        (turned(0.0, 0.0, quarter), turned(0.0, 0.0, 0.0), DVec3::Y),
        (
            turned(0.0, 0.0, quarter),
            turned(0.0, 0.0, quarter),
            -DVec3::X,
        ),
        // Nose down, and a mount that looks down.
        (turned(0.0, 0.0, 0.0), turned(0.0, quarter, 0.0), -DVec3::Z),
        (turned(0.0, quarter, 0.0), turned(0.0, 0.0, 1.0), -DVec3::Z),
        // Looks left on a body that has rolled by a right angle to its right: left is up.
        (
            turned(0.0, 0.0, quarter),
            turned(quarter, 0.0, 0.0),
            DVec3::Z,
        ),
    ] {
        let mount = facing(mount);
        let ahead = gain(mount, attitude, direction);
        assert!((ahead - front).abs() < 0.01, "{direction}: {ahead}");
        let behind = gain(mount, attitude, -direction);
        assert!((behind - back).abs() < 0.01, "{direction}: {behind}");
    }
}

#[test]
fn antennas_in_one_place_have_no_direction_to_each_other() {
    // The original gave no gain at all at distance zero; nothing here depends on a direction that is
    // not there, and nothing is NaN.
    let antenna = || Arc::new(HalfWaveDipole::default()) as Arc<dyn Antenna>;
    let here = at(1.0, 2.0, 3.0, turned(0.3, 0.2, 0.1));
    let power = rssi([
        (antenna(), Mount::IDENTITY, here),
        (antenna(), Mount::IDENTITY, here),
    ]);
    assert!(power.unwrap().abs() < 1e-6, "{power:?}");
}

#[test]
fn both_ways_of_working_a_round_hear_the_same() {
    // Frame by frame and receiver by receiver.
    let specs = || {
        (0..40).map(|i| {
            let antenna: Arc<dyn Antenna> = match i % 4 {
                0 => Arc::new(HalfWaveDipole::default()),
                1 => Arc::new(Patch::default()),
                2 => Arc::new(ShortDipole::default()),
                _ => Arc::new(Isotropic::default()),
            };
            RadioSpec { antenna, ..bee(i) }
        })
    };
    let poses = Still(
        (0..40)
            .map(|i| {
                let i = f64::from(i);
                at(
                    (i * 7.3) % 11.0,
                    (i * 3.1) % 13.0,
                    (i * 1.7) % 5.0,
                    turned(i, i * 0.3, i * 2.0),
                )
            })
            .collect(),
    );
    let heard = [0, usize::MAX].map(|by_receiver_from| {
        let mut config = config();
        config.by_receiver_from = by_receiver_from;
        let mut air = medium(config, specs());
        for radio in 0..40 {
            simbeeotic_radio::Medium::submit(&mut air, secs(1), broadcast(radio, &[radio as u8]));
        }
        let mut heard = round(&mut air, secs(1), &poses);
        heard.sort_unstable();
        heard
    });
    assert!(heard[0].len() > 500);
    assert_eq!(heard[0], heard[1]);
}

fn attitude() -> impl Strategy<Value = Attitude> {
    (-PI..PI, -1.5..1.5, -PI..PI).prop_map(|(roll, pitch, yaw)| turned(roll, pitch, yaw))
}

fn pose() -> impl Strategy<Value = Pose> {
    let place = prop::array::uniform3(-8.0..8.0);
    (place, attitude()).prop_map(|([x, y, z], attitude)| at(x, y, z, attitude))
}

fn mount() -> impl Strategy<Value = Mount> {
    let place = prop::array::uniform3(-0.2..0.2);
    (place, attitude())
        .prop_map(|([x, y, z], attitude)| Mount::new(Offset::from_xyz(x, y, z), attitude))
}

proptest! {
    #[test]
    fn gains_are_right_in_any_attitude_of_both_ends(
        tx in pose(), rx in pose(), tx_mount in mount(), rx_mount in mount(), kind in 0..3,
    ) {
        // The rod and the axes in the world by themselves: rotate the body's axes, then those of the
        // mount in it.
        let world = |pose: Pose, mount: Mount, axis: DVec3| {
            pose.attitude.quat() * (mount.attitude.quat() * axis)
        };
        let place = |pose: Pose, mount: Mount| {
            pose.position.si() + pose.attitude.quat() * mount.position.si()
        };
        let way = place(rx, rx_mount) - place(tx, tx_mount);
        prop_assume!(way.length() > 1.0);
        let direction = way.normalize();
        let [antenna, expected]: [Arc<dyn Antenna>; 2] = match kind {
            0 => [Arc::new(HalfWaveDipole::default()), Arc::new(HalfWaveDipole::default())],
            1 => [Arc::new(Patch::default()), Arc::new(Patch::default())],
            _ => {
                let [az, el] = [120.0, 60.0].map(Angle::from_degrees);
                let cosine = Cosine::new(az, el, Decibels::ZERO).unwrap();
                [Arc::new(cosine), Arc::new(cosine)]
            }
        };
        let gain = |pose, mount, direction: DVec3| {
            let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| world(pose, mount, axis));
            if kind == 0 {
                half_wave_db(z, direction)
            } else {
                let seen = DVec3::new(x.dot(direction), y.dot(direction), z.dot(direction));
                expected.gain(seen).db()
            }
        };
        let expected_dbm = gain(tx, tx_mount, direction) + gain(rx, rx_mount, -direction)
            - friis_db(way.length());
        let power = rssi([(Arc::clone(&antenna), tx_mount, tx), (antenna, rx_mount, rx)]);
        if expected_dbm > -139.0 {
            let power = power.expect("it is heard");
            prop_assert!((power - expected_dbm).abs() < 0.02, "{power} for {expected_dbm}");
        }
    }
}

/// Bits of the RSSI at each of `specs` of a frame that the first sends; 0 where it is not received.
fn rssi_bits(mut air: impl Medium, specs: &[RadioSpec], poses: &Still) -> Vec<u64> {
    for spec in specs {
        air.add(spec.clone()).unwrap();
    }
    air.submit(secs(1), broadcast(0, b"x"));
    let mut bits = vec![0; specs.len()];
    let (mut owners, mut scratch) = (Vec::new(), Scratch::new());
    while let Some(now) = air.next_time() {
        air.open(now, poses, &mut owners);
        for owner in &owners {
            let inbox = air.collect(RadioId(owner.0), poses, &mut scratch);
            for packet in &inbox {
                bits[owner.index()] = packet.rssi().dbm().to_bits();
            }
        }
    }
    bits
}

#[test]
fn a_link_has_the_same_rssi_on_all_media_to_the_bit() {
    let mut rng = Stream::new(11, "links", "test");
    let mut received = 0;
    for _ in 0..100 {
        let mut turn = || turned(rng.uniform_in(-3.0..3.0), rng.uniform_in(-1.5..1.5), 0.0);
        let (body, mounted) = (turn(), turn());
        let poses = Still(
            (0..8)
                .map(|_| Pose::new(Position::from_si(rng.in_ball(15.0)), body))
                .collect(),
        );
        let specs: Vec<RadioSpec> = (0..8)
            .map(|i| {
                let antenna: Arc<dyn Antenna> = match rng.below(5) {
                    0 => Arc::new(HalfWaveDipole::default()),
                    1 => Arc::new(Patch::default()),
                    2 => Arc::new(ShortDipole::default()),
                    3 => Arc::new(Lobe),
                    _ => Arc::new(Isotropic {
                        gain: Decibels::from_db(1.7),
                    }),
                };
                let mount = Mount::new(Offset::from_si(rng.in_ball(0.2)), mounted);
                RadioSpec {
                    antenna,
                    mount,
                    ..bee(i)
                }
            })
            .collect();
        for walls in [false, true] {
            let simple = SimpleMedium::new(SimpleConfig { walls, ..quiet() }).unwrap();
            let simple = rssi_bits(simple, &specs, &poses);
            let ieee802154 = |arithmetic| {
                let config = Ieee802154Config {
                    walls,
                    arithmetic,
                    range_limit: Some(quiet().range_limit),
                    ..Ieee802154Config::default()
                };
                rssi_bits(Ieee802154Medium::new(config).unwrap(), &specs, &poses)
            };
            for other in [ieee802154(Arithmetic::Fast), ieee802154(Arithmetic::Exact)] {
                for (receiver, (a, b)) in simple.iter().zip(&other).enumerate() {
                    if *a != 0 && *b != 0 {
                        received += 1;
                        let [x, y] = [a, b].map(|bits| f64::from_bits(*bits));
                        assert_eq!(a, b, "{x} and {y} dBm, {:?}", specs[receiver].antenna);
                    }
                }
            }
        }
    }
    assert!(received > 2000, "{received} links");
}

/// A user's antenna, with one method.
#[derive(Debug)]
struct Lobe;

impl Antenna for Lobe {
    fn gain(&self, direction: DVec3) -> Decibels {
        Decibels::from_db(6.0 * direction.x - 2.0)
    }
}

//! What the tests of all models need.

use super::{End, FrameKeys, Link, Links, Propagation, Role};
use glam::DVec3;
use simbeeotic_kernel::SimTime;
use simbeeotic_kernel::rng::{Stream, mix};
use simbeeotic_units::{Decibels, Frequency, Position};

pub(crate) const CHANNEL: Frequency = Frequency::si(2.405e9);

/// A link between two antennas at these heights, so long in space.
pub(crate) fn link(distance_m: f64, tx_up_m: f64, rx_up_m: f64) -> Link {
    let rise = tx_up_m - rx_up_m;
    let level = (distance_m * distance_m - rise * rise).max(0.0).sqrt();
    between(
        DVec3::new(0.0, 0.0, tx_up_m),
        DVec3::new(level, 0.0, rx_up_m),
    )
}

/// A link between two places.
pub(crate) fn between(tx: DVec3, rx: DVec3) -> Link {
    let end = |place: DVec3, key| End {
        position: Position::from_si(place),
        key,
    };
    Link {
        tx: end(tx, 11),
        rx: end(rx, 12),
        distance_m: tx.distance(rx),
        frequency: CHANNEL,
        frame: 99,
        time: SimTime::ZERO,
    }
}

/// Places near and far from the origin, up to `reach_m * n`, at heights from 0 to 20 m.
pub(crate) fn along(n: usize, reach_m: f64) -> Vec<DVec3> {
    let mut stream = Stream::new(7, "tests", "along");
    let reach = |i: usize| 0.01 + reach_m * i as f64 * i as f64 / n as f64;
    (0..n)
        .map(|i| {
            let level = stream.unit_vector() * reach(i);
            DVec3::new(level.x, level.y, stream.uniform_in(0.0..20.0))
        })
        .collect()
}

/// Runs a row of links from 1.5 m above the origin to these places.
pub(crate) fn with_row<T>(places: &[DVec3], near_is: Role, run: impl FnOnce(&Links<'_>) -> T) -> T {
    let near = [0.25f32, -0.5, 1.5];
    let axis = |i: usize| -> Vec<f32> { places.iter().map(|p| p[i] as f32).collect() };
    let far = [axis(0), axis(1), axis(2)];
    let squares: Vec<f32> = (0..places.len())
        .map(|j| {
            (0..3)
                .map(|i| (far[i][j] - near[i]) * (far[i][j] - near[i]))
                .sum()
        })
        .collect();
    let keys: Vec<u64> = (0..places.len() as u64).map(|j| mix(j + 100)).collect();
    let frames: Vec<u64> = keys.iter().map(|key| mix(key ^ 5)).collect();
    run(&Links {
        frequency: CHANNEL,
        time: SimTime::ZERO,
        near_is,
        near_enu_m: near,
        near_key: 5,
        far_enu_m: [&far[0], &far[1], &far[2]],
        far_keys: &keys,
        distances_squared_m2: &squares,
        frames: match near_is {
            Role::Transmitter => FrameKeys::One(77),
            Role::Receiver => FrameKeys::Each(&frames),
        },
    })
}

/// The fast way and the exact one agree within `tolerance_db`, whichever end is near.
pub(crate) fn assert_rows_agree(model: &dyn Propagation, places: &[DVec3], tolerance_db: f64) {
    for near_is in [Role::Receiver, Role::Transmitter] {
        with_row(places, near_is, |links| {
            let mut gains = vec![0.0; links.len()];
            model.gains(links, &mut gains);
            for (j, &gain) in gains.iter().enumerate() {
                let link = links.link(j);
                let exact = model.loss(&link).db();
                let fast = -Decibels::from_ratio(f64::from(gain)).db();
                assert!(
                    (exact - fast).abs() < tolerance_db,
                    "{} m, heights {} and {}: {exact} and {fast} dB of {model:?}",
                    link.distance_m,
                    link.tx.position.si().z,
                    link.rx.position.si().z,
                );
            }
        });
    }
}

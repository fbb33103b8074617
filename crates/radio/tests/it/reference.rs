//! The medium as one would write it down: f64, pair by pair, noise drawn, then survival drawn. The
//! table-driven one must give the same powers, and the same receptions in distribution.

use crate::support::{Still, bee, broadcast, config, medium, round, secs};
use simbeeotic_kernel::{SimTime, Stream};
use simbeeotic_radio::{
    Cc2420Curve, End, ErrorModel, FreeSpace, Link, Medium, Poses, Propagation, RadioSpec,
    SimpleConfig,
};
use simbeeotic_units::math::normal_cdf;
use simbeeotic_units::{Decibels, Length, PowerLevel};
use std::collections::BTreeMap;

struct Reference {
    config: SimpleConfig,
    noise: Stream,
    survival: Stream,
}

impl Reference {
    fn new(config: SimpleConfig) -> Self {
        let stream = |purpose| Stream::new(config.seed, "reference", purpose);
        Self {
            noise: stream("noise"),
            survival: stream("survival"),
            config,
        }
    }

    /// Received power, if it is within range and not below the sensitivity.
    fn power(&self, poses: &Still, tx: &RadioSpec, rx: &RadioSpec) -> Option<PowerLevel> {
        let end = |spec: &RadioSpec| End {
            position: poses.pose(spec.owner).position,
            key: spec.key,
        };
        let distance = end(tx).position.distance(end(rx).position);
        let link = Link {
            tx: end(tx),
            rx: end(rx),
            distance_m: distance.metres(),
            frequency: tx.channel.centre,
            frame: 0,
            time: SimTime::ZERO,
        };
        let gains = tx.antenna.uniform_gain()? + rx.antenna.uniform_gain()?;
        let power = tx.tx_power + gains - FreeSpace.loss(&link);
        let heard = distance <= self.config.range_limit && power >= rx.sensitivity;
        heard.then_some(power)
    }

    /// Whether a frame of this power gets through.
    fn survives(&mut self, power: PowerLevel, rx: &RadioSpec) -> bool {
        let noise = self.config.noise_floor + self.config.noise_sigma * self.noise.normal();
        self.survival
            .bernoulli(rx.error.packet_success(power - noise, 21))
    }
}

/// The chance that a frame of this power gets through, by a fine sum over the noise.
fn chance(config: &SimpleConfig, power: PowerLevel) -> f64 {
    let sigma_db = config.noise_sigma.db();
    let snr_db = (power - config.noise_floor).db();
    // The curve is 0 below 2 dB and 1 above 9 dB: between, sum over what it gains in each step.
    let curve = |snr_db: f64| Cc2420Curve.packet_success(Decibels::from_db(snr_db), 21);
    let steps = (0..700).map(|i| 2.0 + f64::from(i) * 0.01);
    steps
        .map(|at| (curve(at + 0.01) - curve(at)) * normal_cdf((snr_db - at - 0.005) / sigma_db))
        .sum()
}

fn swarm(n: usize, radius_m: f64) -> (Vec<RadioSpec>, Still) {
    let mut rng = Stream::new(11, "swarm", "reference");
    (
        (0..n).map(bee).collect(),
        Still::at((0..n).map(|_| rng.in_ball(radius_m))),
    )
}

/// Far and weak, so that the chances are anything between 0 and 1.
fn far() -> SimpleConfig {
    SimpleConfig {
        range_limit: Length::from_metres(290.0),
        ..config()
    }
}

/// Standard deviations by which a count misses its expectation.
fn z_score(count: f64, expected: f64, variance: f64) -> f64 {
    (count - expected) / variance.sqrt()
}

/// Rounds in which all send. Calls `each(tx, rx, power if received)` for each pair.
fn run(
    config: &SimpleConfig,
    specs: &[RadioSpec],
    poses: &Still,
    rounds: u64,
    mut each: impl FnMut(u32, u32, Option<f64>),
) {
    let n = specs.len() as u32;
    let mut m = medium(config.clone(), specs.to_vec());
    for second in 1..=rounds {
        (0..n).for_each(|radio| m.submit(secs(second), broadcast(radio, &[0; 4])));
        let heard = round(&mut m, secs(second), poses);
        let mut heard = heard.iter().peekable();
        for rx in 0..n {
            for tx in (0..n).filter(|&tx| tx != rx) {
                let hit = heard.next_if(|h| (h.0, h.1) == (rx, tx));
                each(tx, rx, hit.map(|h| f64::from_bits(h.3)));
            }
        }
        assert!(heard.next().is_none());
    }
    assert_eq!(m.totals().sent, u64::from(n) * rounds);
}

#[test]
fn powers_agree_with_the_reference() {
    for radius_m in [0.5, 20.0, 150.0] {
        let (specs, poses) = swarm(60, radius_m);
        let config = far();
        let reference = Reference::new(config.clone());
        let mut worst: f64 = 0.0;
        run(&config, &specs, &poses, 3, |tx, rx, heard_dbm| {
            let power = reference.power(&poses, &specs[tx as usize], &specs[rx as usize]);
            if let Some(heard_dbm) = heard_dbm {
                worst = worst.max((heard_dbm - power.unwrap().dbm()).abs());
            }
        });
        assert!(
            worst < 0.001,
            "{worst} dB at {radius_m} m; 0.03 dB are allowed"
        );
    }
}

#[test]
fn receptions_agree_with_the_reference_in_distribution() {
    let (specs, poses) = swarm(60, 130.0);
    let config = far();
    let mut reference = Reference::new(config.clone());
    // By received power in steps of 1 dB: pairs, expected and its variance, ours, the reference's.
    let mut bins = [[0.0; 5]; 40];
    let mut chances = BTreeMap::new();
    run(&config, &specs, &poses, 60, |tx, rx, heard_dbm| {
        let pair = (tx, rx);
        let (tx, rx) = (&specs[tx as usize], &specs[rx as usize]);
        let Some(power) = reference.power(&poses, tx, rx) else {
            return assert!(heard_dbm.is_none(), "out of reach, and heard");
        };
        let p = *chances
            .entry(pair)
            .or_insert_with(|| chance(&config, power));
        let bin = ((power.dbm() + 90.0) as usize).min(39);
        let survives = reference.survives(power, rx);
        let more = [
            1.0,
            p,
            p * (1.0 - p),
            f64::from(heard_dbm.is_some()),
            f64::from(survives),
        ];
        (0..5).for_each(|i| bins[bin][i] += more[i]);
    });
    let mut compared = 0;
    for (bin, [pairs, expected, variance, ours, theirs]) in bins.into_iter().enumerate() {
        if variance < 10.0 {
            continue;
        }
        compared += 1;
        for (who, count) in [("table", ours), ("reference", theirs)] {
            let z = z_score(count, expected, variance);
            assert!(
                z.abs() < 4.0,
                "{who} at {} dBm: {count} of {pairs}, z = {z}",
                bin as f64 - 90.0
            );
        }
        let z = z_score(ours - theirs, 0.0, 2.0 * variance);
        assert!(
            z.abs() < 4.0,
            "{} dBm: {ours} and {theirs}, z = {z}",
            bin as f64 - 90.0
        );
    }
    assert!(compared > 15, "{compared} bins");
}

#[test]
fn without_noise_sigma_the_curve_itself_decides() {
    // One receiver at each of the ratios at which the original's curve is known.
    let config = SimpleConfig {
        noise_sigma: Decibels::ZERO,
        noise_floor: PowerLevel::from_dbm(-80.0),
        range_limit: Length::from_metres(1000.0),
        ..config()
    };
    let distance_m =
        |snr_db: f64| 10.0 * Decibels::from_db((80.0 - 60.070_084_836 - snr_db) / 2.0).ratio();
    let rounds = 4000;
    for (snr_db, prr) in [
        (3.0, 0.0),
        (4.0, 0.068),
        (5.0, 0.786),
        (6.0, 0.991),
        (7.0, 0.9999),
    ] {
        let poses = Still::at([[0.0; 3], [distance_m(snr_db), 0.0, 0.0]]);
        let mut received = 0.0;
        run(
            &config,
            &[bee(0), bee(1)],
            &poses,
            rounds,
            |tx, _, heard_dbm| {
                received += f64::from(tx == 0 && heard_dbm.is_some());
            },
        );
        let ratio = received / rounds as f64;
        // Three standard deviations, and half a slot of the table: 0.017 dB at 0.8 per dB.
        let allowed = 3.0 * (prr * (1.0 - prr) / rounds as f64).sqrt() + 0.014;
        assert!((ratio - prr).abs() < allowed, "{snr_db} dB: {ratio}");
    }
}

#[test]
fn luck_is_independent_between_receivers_and_between_frames() {
    // All pairs about as likely as not: then the sums over rows and over columns of the table of
    // (frame, receiver) must scatter as those of a fair coin.
    let n = 120usize;
    let config = SimpleConfig {
        noise_floor: PowerLevel::from_dbm(-66.0),
        ..config()
    };
    let poses = Still::at((0..n).map(|_| [0.0; 3]));
    // Everybody in one spot: the power is that sent.
    let weak = |i| RadioSpec {
        tx_power: PowerLevel::from_dbm(-61.0),
        ..bee(i)
    };
    let specs: Vec<RadioSpec> = (0..n).map(weak).collect();

    let (mut by_frame, mut by_receiver) = (vec![0.0; n], vec![0.0; n]);
    let (mut total, mut both, mut previous) = (0.0, 0.0, false);
    run(&config, &specs, &poses, 1, |tx, rx, heard_dbm| {
        let heard = heard_dbm.is_some();
        by_frame[tx as usize] += f64::from(heard);
        by_receiver[rx as usize] += f64::from(heard);
        total += f64::from(heard);
        both += f64::from(heard && previous);
        previous = heard;
    });
    let pairs = (n * (n - 1)) as f64;
    let p = total / pairs;
    assert!((0.2..0.8).contains(&p), "about as likely as not: {p}");
    let per_line = (n - 1) as f64;
    for (what, lines) in [("frame", &by_frame), ("receiver", &by_receiver)] {
        let chi: f64 = lines
            .iter()
            .map(|&count| (count - per_line * p) * (count - per_line * p))
            .sum::<f64>()
            / (per_line * p * (1.0 - p));
        // Chi-squared with 119 degrees of freedom: 119 ± 15.4.
        assert!(
            (65.0..185.0).contains(&chi),
            "sums by {what}: chi squared {chi}"
        );
    }
    let z = z_score(both, pairs * p * p, pairs * p * p * (1.0 - p * p));
    assert!(z.abs() < 5.0, "neighbours: z = {z}");
}

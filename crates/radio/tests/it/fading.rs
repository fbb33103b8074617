//! Nakagami fading as ns-3 3.37 has it: `tests/ns3/fading_nakagami.csv`, a million draws for each `m`.

use simbeeotic_kernel::rng::mix;
use simbeeotic_radio::{Fading, Nakagami};
use simbeeotic_units::math;

const SHARES: [f64; 9] = [0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99];

/// `m`, mean of the gain, mean and deviation in decibels, quantiles.
fn table() -> Vec<Vec<f64>> {
    let text = include_str!("../ns3/fading_nakagami.csv");
    let numbers = |line: &str| line.split(',').map(|n| n.parse().ok()).collect();
    text.lines().filter_map(numbers).collect()
}

#[test]
fn quantiles_are_those_of_ns3() {
    let table = table();
    assert_eq!(table.len(), 7, "rows");
    for row in table {
        let fading = Nakagami::new(row[0]);
        let n = 200_000;
        let draws: Vec<u64> = (0..n).map(|i| mix(i + 3)).collect();
        let mut gains = vec![1.0; draws.len()];
        fading.fade(&draws, &vec![1.0; draws.len()], &mut gains);
        let mut decibels: Vec<f64> = gains
            .iter()
            .map(|&g| 10.0 * math::log10(f64::from(g)))
            .collect();
        decibels.sort_by(f64::total_cmp);
        for (share, want) in SHARES.into_iter().zip(&row[4..]) {
            let got = decibels[(share * n as f64) as usize];
            // The scatter of both samples, at most 4 sigma of each: sqrt(u (1 - u) / n) over the slope.
            let step = 4.0 * (share * (1.0 - share) / n as f64).sqrt() * 1.1;
            let at = |share: f64| decibels[((share * n as f64) as usize).min(decibels.len() - 1)];
            let room = (at((share + step).min(1.0)) - at((share - step).max(0.0))).abs();
            assert!(
                (got - want).abs() < room + 0.01,
                "m = {}, {share}: {got}, not {want}",
                row[0]
            );
        }
        let mean = decibels.iter().sum::<f64>() / n as f64;
        assert!(
            (mean - row[2]).abs() < 5.0 * row[3] / (n as f64).sqrt(),
            "m = {}",
            row[0]
        );
    }
}

#[test]
fn exact_quantiles_are_those_of_ns3_within_its_million_draws() {
    for row in table() {
        let fading = Nakagami::new(row[0]);
        for (share, want) in SHARES.into_iter().zip(&row[4..]) {
            // The draw whose first share is this: its upper 32 bits.
            let draw = ((share * 4_294_967_296.0) as u64) << 32;
            let got = 10.0 * math::log10(fading.gain(draw, 1.0));
            let tolerance = 0.01 + 0.006 * want.abs();
            assert!(
                (got - want).abs() < tolerance,
                "m = {}, {share}: {got}, not {want}",
                row[0]
            );
        }
    }
}

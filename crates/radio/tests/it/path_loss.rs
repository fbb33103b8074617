//! Path losses as ns-3 3.37 has them: `tests/ns3/pathloss.csv`, made with the real program.

use simbeeotic_kernel::SimTime;
use simbeeotic_radio::{End, FreeSpace, Link, LogDistance, Propagation, TwoRay};
use simbeeotic_units::{Decibels, Frequency, Length, Position};

/// The losses of one model in the table, with the links they are of.
fn table(model: &str) -> Vec<(Link, f64)> {
    let text = include_str!("../ns3/pathloss.csv");
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let rows = lines.filter_map(|line| {
        let (name, numbers) = line.split_once(',')?;
        let numbers: Vec<f64> = numbers
            .split(',')
            .map(str::parse)
            .collect::<Result<_, _>>()
            .ok()?;
        let [f_hz, tx_dbm, h_tx_m, h_rx_m, d_m, rx_dbm] = numbers[..] else {
            return None;
        };
        let level_m = (d_m * d_m - (h_tx_m - h_rx_m) * (h_tx_m - h_rx_m))
            .max(0.0)
            .sqrt();
        let end = |east, up, key| End {
            position: Position::from_xyz(east, 0.0, up),
            key,
        };
        let link = Link {
            tx: end(0.0, h_tx_m, 1),
            rx: end(level_m, h_rx_m, 2),
            distance_m: d_m,
            frequency: Frequency::si(if f_hz > 0.0 { f_hz } else { 2.4e9 }),
            frame: 0,
            time: SimTime::ZERO,
        };
        (name == model).then_some((link, tx_dbm - rx_dbm))
    });
    rows.collect()
}

fn assert_agrees(name: &str, rows: usize, model: &dyn Propagation) {
    let table = table(name);
    assert_eq!(table.len(), rows, "rows of {name}");
    for (link, want) in table {
        let got = model.loss(&link).db();
        let error = (got - want).abs();
        assert!(error < 1e-6, "{name}, {link:?}: {got}, not {want} dB");
    }
}

#[test]
fn free_space_is_that_of_ns3() {
    assert_agrees("friis", 148, &FreeSpace);
}

#[test]
fn two_rays_by_crossover_are_those_of_ns3() {
    let model = TwoRay {
        minimum_distance: Length::from_metres(0.5),
        ..TwoRay::default()
    };
    assert_agrees("tworay", 656, &model);
}

#[test]
fn log_distance_is_that_of_ns3() {
    for (name, reference_db) in [("logdist", 46.6777), ("logdist_46.6776", 46.6776)] {
        let reference_loss = Some(Decibels::from_db(reference_db));
        assert_agrees(
            name,
            37,
            &LogDistance {
                reference_loss,
                ..LogDistance::default()
            },
        );
    }
}

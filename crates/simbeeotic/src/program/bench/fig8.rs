//! Figure 8: ever more bees that all talk and listen. A broadcast of four bytes once a second, range
//! 30 m, a listener called for each packet; no contacts.

use super::alone::Case;
use super::arguments::{Common, Swarms};
use super::files::Facts;
use super::measure::{self, Experiment, Row as Measurement};
use super::report::Report;
use super::workload::{self, Cost, Most, PAPER_EDGE_M, Workload};
use super::{Failure, paper, remark, show, table};
use clap::Args;
use serde::Serialize;
use simbeeotic_scenario::Loaded;

/// Arguments of `bench fig8`.
#[derive(Args)]
pub(in crate::program) struct Options {
    /// The air: simple (the paper's: no air time, no interference) or ieee802154 (one channel, shared)
    #[arg(long, default_value = "simple", value_parser = ["simple", "ieee802154"])]
    medium: String,
    /// Bees collide
    #[arg(long)]
    contacts: bool,
    #[command(flatten)]
    swarms: Swarms,
}

/// What is below the options in the help.
pub(super) const HELP: &str = "\
Sizes: 550,1000,3000,8192, each for 5 s; with --full 100,200,550,1000,2000,4000,8192,16384, each for 100 s, as
far as they keep real time; the search of the limit goes on from there. About a minute; with --full 15.

Examples:
  simbeeotic bench fig8
  simbeeotic bench fig8 --full -o out/fig8-full
  simbeeotic bench fig8 --medium ieee802154 --phase random";

/// Swarms of the quick and of the whole experiment.
const SIZES: [&[u32]; 2] = [
    &[550, 1_000, 3_000, 8_192],
    &[100, 200, 550, 1_000, 2_000, 4_000, 8_192, 16_384],
];

/// The experiment, its arguments read.
struct Fig8<'a> {
    options: &'a Options,
    duration_s: f64,
    sizes: Vec<u32>,
    threads: Vec<usize>,
}

impl Fig8<'_> {
    fn load(&self, n: u32, duration_s: f64) -> Result<Loaded, Failure> {
        let swarms = &self.options.swarms;
        let channel = channel(&self.options.medium);
        let workload = Workload {
            bees: n,
            duration_s,
            edges_m: edges_m(n, &swarms.start),
            phase: &swarms.common.phase,
            contacts: self.options.contacts,
            channel: Some(&channel),
        };
        workload.load()
    }

    fn facts(&self, case: Case) -> Facts {
        let swarms = &self.options.swarms;
        Facts {
            n: Some(case.size),
            threads: Some(self.threads[case.line]),
            start: swarms.start.clone(),
            phase: swarms.common.phase.clone(),
            contacts: contacts(self.options).to_owned(),
            medium: self.options.medium.clone(),
            range_m: (self.options.medium == "simple").then_some(RANGE_M),
            ..Facts::default()
        }
    }
}

impl Experiment for Fig8<'_> {
    fn name(&self) -> &'static str {
        "fig8"
    }

    fn common(&self) -> &Common {
        &self.options.swarms.common
    }

    fn setup(&self) -> Vec<(&'static str, String)> {
        let swarms = &self.options.swarms;
        vec![
            ("duration", format!("{} s", self.duration_s)),
            ("start", swarms.start.clone()),
            ("phase", swarms.common.phase.clone()),
            ("medium", self.options.medium.clone()),
            ("contacts", contacts(self.options).to_owned()),
        ]
    }

    fn duration_s(&self) -> f64 {
        self.duration_s
    }

    fn sizes(&self) -> &[u32] {
        &self.sizes
    }

    fn is_ladder(&self) -> bool {
        self.options.swarms.is_ladder()
    }

    fn lines(&self) -> Vec<String> {
        let threads = self.threads.iter();
        threads.map(|threads| show::threads(*threads)).collect()
    }

    fn ceiling(&self) -> u32 {
        1_000_000
    }

    fn repeats(&self) -> u32 {
        3
    }

    fn warm_up(&self) -> Result<(), Failure> {
        workload::run(&self.load(50, 1.0)?, 1, None, Most::default()).map(drop)
    }

    fn run(&self, case: Case, most: Most) -> Result<Cost, Failure> {
        let loaded = self.load(case.size, self.duration_s)?;
        workload::run(&loaded, self.threads[case.line], None, most)
    }
}

fn contacts(options: &Options) -> &'static str {
    if options.contacts { "on" } else { "off" }
}

/// One row of the table: a swarm on some threads.
#[derive(Serialize)]
struct Row {
    n: u32,
    threads: usize,
    medium: String,
    #[serde(flatten)]
    cost: Cost,
    /// Processor time for each virtual second, s.
    cpu_s_per_s: Option<f64>,
    /// The radio's wall time for each virtual second, s.
    radio_s_per_s: f64,
    /// Packets put on the air.
    sent: u64,
    /// Packets received: calls of a listener.
    received: u64,
    /// The same in a virtual second.
    received_per_s: f64,
    /// Processor time of the whole program for each packet received, ns.
    cpu_ns_per_reception: Option<f64>,
    /// The radio's wall time for each packet sent and each of the others, in range or not, ns.
    radio_ns_per_pair: Option<f64>,
    /// Packets received over packets sent times the number of the others.
    delivered: Option<f64>,
    /// Wall time with the first number of threads over that with this one.
    gain: f64,
}

pub(super) fn fig8(options: &Options) -> Result<(), Failure> {
    let swarms = &options.swarms;
    let common = &swarms.common;
    let experiment = Fig8 {
        options,
        duration_s: common.duration_s(if common.full { "100 s" } else { "5 s" })?,
        sizes: swarms.sizes(SIZES[0], SIZES[1]),
        threads: swarms.threads(),
    };
    let setup = format!(
        "{} s virtual, {} start, {} timers, medium {}, contacts {}",
        experiment.duration_s,
        swarms.start,
        common.phase,
        options.medium,
        contacts(options),
    );
    if !common.json && common.alone.is_none() {
        remark(format!("figure 8: {setup}"));
    }
    let report = Report {
        name: "fig8",
        title: "Figure 8: ever more bees that all talk and listen",
        setup,
        x: "bees",
        all_shares: false,
        paper: paper::FIG8,
        facts: &|case| experiment.facts(case),
        searched: |facts, n| facts.n = n,
    };
    let so_far = |rows: &[Measurement], probes: &[Measurement]| {
        report.so_far(&experiment, rows, probes);
    };
    let Some(measured) = measure::measure(&experiment, &so_far)? else {
        return Ok(());
    };
    let rows = rows(&experiment, &measured.rows);
    table::agree(rows.iter().map(|row| (row.n, row.threads, &row.cost)))?;
    if !common.json {
        print(&rows)?;
        table::method(&measured.rows);
        remark(
            "cpu/s: processor seconds for each virtual second; ns/rx: of them for each packet received; \
             ns/pair: of the radio's wall time, for each packet sent and each of the others",
        );
        if experiment.threads.len() > 1 {
            table::same_for(&experiment.threads);
        }
        peers(options, &rows);
    }
    report.finish(&experiment, measured, &rows)
}

fn rows(experiment: &Fig8<'_>, measured: &[Measurement]) -> Vec<Row> {
    let row = |row: &Measurement| {
        let cost = &row.least;
        let n = row.case.size;
        let [sent, received] = cost.packets;
        let pairs = sent as f64 * (f64::from(n) - 1.0);
        let each = |x: f64, of: f64| (of > 0.0).then(|| x / of);
        Row {
            n,
            threads: experiment.threads[row.case.line],
            medium: experiment.options.medium.clone(),
            cpu_s_per_s: cost.cpu_s.map(|cpu_s| cpu_s / cost.virtual_s),
            radio_s_per_s: cost.radio_s / cost.virtual_s,
            sent,
            received,
            received_per_s: received as f64 / cost.virtual_s,
            cpu_ns_per_reception: cost
                .cpu_s
                .and_then(|cpu_s| each(cpu_s * 1e9, received as f64)),
            radio_ns_per_pair: each(cost.radio_s * 1e9, pairs),
            delivered: each(received as f64, pairs),
            gain: measure::gain(measured, row),
            cost: cost.clone(),
        }
    };
    measured.iter().map(row).collect()
}

/// Edges of the box that they start in, m.
fn edges_m(n: u32, start: &str) -> [f64; 3] {
    if start == "density" {
        let edge = 10.0 * f64::from(n).sqrt();
        [edge, edge, 1.0]
    } else {
        [PAPER_EDGE_M; 3]
    }
}

/// As far as the simple medium reaches, m.
const RANGE_M: f64 = 30.0;

/// The section `[channel]`.
fn channel(medium: &str) -> String {
    match medium {
        "ieee802154" => r#"medium = "ieee802154""#.to_owned(),
        _ => format!("medium = \"simple\"\nrange_limit = \"{RANGE_M} m\""),
    }
}

fn print(rows: &[Row]) -> Result<(), Failure> {
    let head = ["n", "threads"].into_iter().chain(table::SHARES);
    table::line(head.chain(["gain", "cpu/s", "rx/s", "ns/rx", "ns/pair", "delivered"]))?;
    for row in rows {
        let mut columns = vec![row.n.to_string(), row.threads.to_string()];
        columns.extend(table::shares(&row.cost));
        columns.push(format!("{:.2}x", row.gain));
        columns.push(table::figure(row.cpu_s_per_s, 4));
        columns.push(format!("{:.3e}", row.received_per_s));
        columns.push(table::figure(row.cpu_ns_per_reception, 2));
        columns.push(table::figure(row.radio_ns_per_pair, 2));
        columns.push(table::figure(row.delivered, 4));
        table::line(columns.iter().map(String::as_str))?;
    }
    Ok(())
}

/// ARGoS3's processor seconds for each virtual second of 1,000 robots.
const ARGOS: (u32, f64) = (1_000, 0.39);

/// What others need for the like.
fn peers(options: &Options, rows: &[Row]) {
    if options.medium == "ieee802154" {
        return remark(
            "the paper's air has no air time and no interference: on one IEEE 802.15.4 channel most of \
             these packets collide, or are never sent",
        );
    }
    if options.swarms.start == "paper" {
        let of_theirs = rows.iter().filter(|row| row.n == ARGOS.0);
        let ours: Vec<String> = of_theirs
            .filter_map(|row| {
                let threads = show::threads(row.threads);
                Some(format!("{:.4} on {threads}", row.cpu_s_per_s?))
            })
            .collect();
        if !ours.is_empty() {
            remark(format!(
                "processor seconds for each virtual second of {} robots: ARGoS3 {:.2} (measured by us; \
                 its radio is a lossless disc), here {}",
                ARGOS.0,
                ARGOS.1,
                ours.join(", ")
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_constant_density_each_bee_has_a_hundred_square_metres() {
        let [east, north, _] = edges_m(2_500, "density");
        assert!((east * north / 2_500.0 - 100.0).abs() < 1e-9);
        assert_eq!(edges_m(1_000_000, "paper"), [20.0; 3]);
    }
}

//! Figure 7: the swarm grows. Soft real time ends where the speed falls below 1.

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
use simbeeotic_units::math;

/// Arguments of `bench fig7`.
#[derive(Args)]
pub(in crate::program) struct Options {
    /// Bees do not collide
    #[arg(long)]
    no_contacts: bool,
    #[command(flatten)]
    swarms: Swarms,
}

/// What is below the options in the help.
pub(super) const HELP: &str = "\
Sizes: 1000,3000,10000,30000, each for 5 s; with --full 1000,2000,3074,5000,10000,20000,50000,100000, each
for 100 s, as far as they keep real time; the search of the limit goes on from there. About a minute; with
--full 15.

Examples:
  simbeeotic bench fig7
  simbeeotic bench fig7 --full --threads 1,2 -o out/fig7-full
  simbeeotic bench fig7 --n 100000 --start density --no-limit";

/// Swarms of the quick and of the whole experiment.
const SIZES: [&[u32]; 2] = [
    &[1_000, 3_000, 10_000, 30_000],
    &[1_000, 2_000, 3_074, 5_000, 10_000, 20_000, 50_000, 100_000],
];

/// The experiment, its arguments read.
struct Fig7<'a> {
    options: &'a Options,
    duration_s: f64,
    sizes: Vec<u32>,
    threads: Vec<usize>,
}

impl Fig7<'_> {
    fn load(&self, n: u32, duration_s: f64) -> Result<Loaded, Failure> {
        let swarms = &self.options.swarms;
        let workload = Workload {
            bees: n,
            duration_s,
            edges_m: [edge_m(n, &swarms.start); 3],
            phase: &swarms.common.phase,
            contacts: !self.options.no_contacts,
            channel: None,
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
            ..Facts::default()
        }
    }
}

impl Experiment for Fig7<'_> {
    fn name(&self) -> &'static str {
        "fig7"
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
        workload::run(&self.load(100, 1.0)?, 1, None, Most::default()).map(drop)
    }

    fn run(&self, case: Case, most: Most) -> Result<Cost, Failure> {
        let loaded = self.load(case.size, self.duration_s)?;
        workload::run(&loaded, self.threads[case.line], None, most)
    }
}

fn contacts(options: &Options) -> &'static str {
    if options.no_contacts { "off" } else { "on" }
}

/// One row of the table: a swarm on some threads.
#[derive(Serialize)]
struct Row {
    n: u32,
    threads: usize,
    #[serde(flatten)]
    cost: Cost,
    /// Processor time for each bee and virtual second, us.
    cpu_us_per_bee_s: Option<f64>,
    /// Growth of the process's greatest memory by this swarm, for each bee, KiB; the most of all runs, each
    /// in a process of its own.
    memory_kib_per_bee: Option<f64>,
    /// Wall time with the first number of threads over that with this one.
    gain: f64,
}

pub(super) fn fig7(options: &Options) -> Result<(), Failure> {
    let swarms = &options.swarms;
    let common = &swarms.common;
    let experiment = Fig7 {
        options,
        duration_s: common.duration_s(if common.full { "100 s" } else { "5 s" })?,
        sizes: swarms.sizes(SIZES[0], SIZES[1]),
        threads: swarms.threads(),
    };
    let setup = format!(
        "{} s virtual, {} start, {} timers, contacts {}",
        experiment.duration_s,
        swarms.start,
        common.phase,
        contacts(options),
    );
    if !common.json && common.alone.is_none() {
        remark(format!("figure 7: {setup}"));
    }
    let report = Report {
        name: "fig7",
        title: "Figure 7: ever more bees on a random walk",
        setup,
        x: "bees",
        all_shares: false,
        paper: paper::FIG7,
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
        if experiment.threads.len() > 1 {
            remark(
                "gain: of wall time; busiest: processor seconds of the busiest thread, less than which no \
                 number of free processors can make it",
            );
            table::same_for(&experiment.threads);
        }
        peers(&rows);
    }
    report.finish(&experiment, measured, &rows)
}

fn rows(experiment: &Fig7<'_>, measured: &[Measurement]) -> Vec<Row> {
    let row = |row: &Measurement| {
        let (n, cost) = (row.case.size, &row.least);
        let memory = row.runs.iter().filter_map(|run| run.memory_bytes);
        Row {
            n,
            threads: experiment.threads[row.case.line],
            cpu_us_per_bee_s: cost
                .cpu_s
                .map(|cpu_s| cpu_s * 1e6 / cost.virtual_s / f64::from(n)),
            memory_kib_per_bee: memory
                .max_by(f64::total_cmp)
                .map(|bytes| bytes / 1024.0 / f64::from(n)),
            gain: measure::gain(measured, row),
            cost: cost.clone(),
        }
    };
    measured.iter().map(row).collect()
}

/// Edge of the cube that they start in, m.
fn edge_m(n: u32, start: &str) -> f64 {
    if start == "density" {
        2.0 * math::pow(f64::from(n), 1.0 / 3.0)
    } else {
        PAPER_EDGE_M
    }
}

fn print(rows: &[Row]) -> Result<(), Failure> {
    let head = ["n", "threads"].into_iter().chain(table::SHARES);
    table::line(head.chain(["gain", "cpu s", "busiest", "us/bee/s", "KiB/bee"]))?;
    for row in rows {
        let mut columns = vec![row.n.to_string(), row.threads.to_string()];
        columns.extend(table::shares(&row.cost));
        columns.push(format!("{:.2}x", row.gain));
        columns.push(table::figure(row.cost.cpu_s, 3));
        columns.push(table::figure(row.cost.busiest_thread_s, 3));
        columns.push(table::figure(row.cpu_us_per_bee_s, 2));
        columns.push(table::figure(row.memory_kib_per_bee, 2));
        table::line(columns.iter().map(String::as_str))?;
    }
    Ok(())
}

/// ARGoS3's processor seconds for each virtual second of so many robots.
const ARGOS: [(u32, f64); 4] = [
    (1_000, 0.006),
    (3_000, 0.029),
    (10_000, 0.2),
    (30_000, 0.38),
];

/// What others need for the like.
fn peers(rows: &[Row]) {
    let beside: Vec<String> = rows
        .iter()
        .filter_map(|row| {
            let (_, theirs) = ARGOS.iter().find(|(n, _)| *n == row.n)?;
            let ours = row.cost.cpu_s? / row.cost.virtual_s;
            Some(format!(
                "  n {:>6}: ARGoS3 {theirs:.3}, here {ours:.4} on {}",
                row.n,
                show::threads(row.threads)
            ))
        })
        .collect();
    if !beside.is_empty() {
        remark(format!(
            "processor seconds for each virtual second, beside ARGoS3 (measured by us with ARGoS3, \
             kinematic flying robots, 10 Hz, 20 m start, 30,000 in a larger arena; on two cores of \
             an AMD EPYC):\n{}",
            beside.join("\n")
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_constant_density_each_bee_has_eight_cubic_metres() {
        let edge = edge_m(1_000, "density");
        assert!((edge - 20.0).abs() < 1e-9);
        assert_eq!(edge_m(1_000_000, "paper"), 20.0);
    }
}

//! Figure 7: the swarm grows. Soft real time ends where the speed falls below 1.

use super::workload::{self, Cost, PAPER_EDGE_M, Workload};
use super::{Common, Failure, arguments, input, process, remark, show, table};
use clap::Args;
use serde::Serialize;
use simbeeotic_units::math;

/// Arguments of `bench fig7`.
#[derive(Args)]
pub(in crate::program) struct Options {
    /// Swarm sizes
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "1000,3000,10000,30000",
        value_parser = arguments::swarm_size,
        allow_negative_numbers = true
    )]
    n: Vec<u32>,
    /// Virtual time of each run; the paper's is "100 s"
    #[arg(
        long,
        default_value = "10 s",
        value_name = "TIME",
        allow_hyphen_values = true
    )]
    duration: String,
    /// Threads that run models; of several, as 1,2, each swarm is run with each, and compared
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "1",
        value_parser = arguments::threads,
        allow_negative_numbers = true
    )]
    threads: Vec<usize>,
    /// Start: paper (random in a 20 m cube) or density (one bee per 8 cubic metres)
    #[arg(long, default_value = "paper", value_parser = ["paper", "density"])]
    start: String,
    /// Bees do not collide
    #[arg(long)]
    no_contacts: bool,
    #[command(flatten)]
    common: Common,
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
    /// Growth of the process's greatest memory by this swarm, for each bee, KiB; of the first run, and
    /// with the first number of threads. What smaller swarms have left behind counts too: for a figure
    /// to hold a limit against, ask for one swarm alone.
    memory_kib_per_bee: Option<f64>,
    /// Wall time with the first number of threads over that with this one.
    gain: f64,
}

pub(super) fn fig7(options: &Options) -> Result<(), Failure> {
    let common = &options.common;
    let duration = input::time("--duration", &options.duration)?;
    if !common.json {
        remark(format!(
            "figure 7: {} s virtual, {} start, {} timers, contacts {}",
            duration.secs(),
            options.start,
            common.phase,
            if options.no_contacts { "off" } else { "on" },
        ));
    }
    let rows = measure(options)?;
    table::agree(rows.iter().map(|row| (row.n, row.threads, &row.cost)))?;
    if common.json {
        return table::json(&rows);
    }
    print(&rows)?;
    table::method(common.repeat);
    if options.threads.len() > 1 {
        remark(
            "gain: of wall time; busiest: processor seconds of the busiest thread, less than which no \
             number of free processors can make it",
        );
        table::same_for(&options.threads);
    }
    peers(&rows);
    Ok(())
}

fn measure(options: &Options) -> Result<Vec<Row>, Failure> {
    // From small to large, so that what the process holds at most is each swarm's own.
    let mut sizes = options.n.clone();
    sizes.sort_unstable();
    sizes.dedup();
    let load = |n| {
        let workload = Workload {
            bees: n,
            duration: &options.duration,
            edges_m: [edge_m(n, &options.start); 3],
            phase: &options.common.phase,
            contacts: !options.no_contacts,
            channel: None,
        };
        workload.load()
    };

    // Whatever the program needs once, it has from here on.
    workload::run(&load(1)?, 1, None)?;
    let before = process::peak_bytes();

    let mut cases = Vec::new();
    for &n in &sizes {
        cases.extend(options.threads.iter().map(|&threads| (n, threads)));
    }
    let mut peaks = Vec::with_capacity(cases.len());
    let costs = table::rounds(cases.len(), options.common.repeat, |case| {
        let (n, threads) = cases[case];
        let cost = workload::run(&load(n)?, threads, None)?;
        if peaks.len() == case {
            peaks.push(process::peak_bytes());
        }
        Ok(cost)
    })?;

    let several = options.threads.len();
    let row = |case: usize| {
        let ((n, threads), cost, first) = (cases[case], &costs[case], case - case % several);
        let grown = peaks[first].zip(before).map(|(peak, before)| peak - before);
        Row {
            n,
            threads,
            cpu_us_per_bee_s: cost
                .cpu_s
                .map(|cpu_s| cpu_s * 1e6 / cost.virtual_s / f64::from(n)),
            memory_kib_per_bee: grown.map(|bytes| bytes / 1024.0 / f64::from(n)),
            gain: costs[first].wall_s / cost.wall_s,
            cost: cost.clone(),
        }
    };
    Ok((0..cases.len()).map(row).collect())
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
    remark(
        "the paper's soft real-time limit for this workload: 3,074 MAVs (2.2 GHz quad-core, 2011)",
    );
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

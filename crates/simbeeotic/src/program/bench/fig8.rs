//! Figure 8: ever more bees that all talk and listen. A broadcast of four bytes once a second, range
//! 30 m, a listener called for each packet; no contacts.

use super::workload::{self, Cost, PAPER_EDGE_M, Workload};
use super::{Common, Failure, arguments, input, remark, show, table};
use clap::Args;
use serde::Serialize;

/// Arguments of `bench fig8`.
#[derive(Args)]
pub(in crate::program) struct Options {
    /// Swarm sizes
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "550,1000,3000,10000",
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
    /// The air: simple (the paper's: no air time, no interference) or ieee802154 (one channel, shared)
    #[arg(long, default_value = "simple", value_parser = ["simple", "ieee802154"])]
    medium: String,
    /// Start: paper (random in a 20 m cube) or density (on a plane, one bee per 100 square metres)
    #[arg(long, default_value = "paper", value_parser = ["paper", "density"])]
    start: String,
    /// Bees collide
    #[arg(long)]
    contacts: bool,
    #[command(flatten)]
    common: Common,
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
    let common = &options.common;
    let duration = input::time("--duration", &options.duration)?;
    if !common.json {
        remark(format!(
            "figure 8: {} s virtual, {} start, {} timers, medium {}, contacts {}",
            duration.secs(),
            options.start,
            common.phase,
            options.medium,
            if options.contacts { "on" } else { "off" },
        ));
    }
    let rows = measure(options)?;
    table::agree(rows.iter().map(|row| (row.n, row.threads, &row.cost)))?;
    if common.json {
        return table::json(&rows);
    }
    print(&rows)?;
    table::method(common.repeat);
    remark(
        "cpu/s: processor seconds for each virtual second; ns/rx: of them for each packet received; \
         ns/pair: of the radio's wall time, for each packet sent and each of the others",
    );
    if options.threads.len() > 1 {
        table::same_for(&options.threads);
    }
    peers(options, &rows);
    Ok(())
}

fn measure(options: &Options) -> Result<Vec<Row>, Failure> {
    let mut sizes = options.n.clone();
    sizes.sort_unstable();
    sizes.dedup();
    let load = |n| {
        let workload = Workload {
            bees: n,
            duration: &options.duration,
            edges_m: edges_m(n, &options.start),
            phase: &options.common.phase,
            contacts: options.contacts,
            channel: Some(channel(&options.medium)),
        };
        workload.load()
    };
    workload::run(&load(2)?, 1, None)?; // to warm up

    let mut cases = Vec::new();
    for &n in &sizes {
        cases.extend(options.threads.iter().map(|&threads| (n, threads)));
    }
    let costs = table::rounds(cases.len(), options.common.repeat, |case| {
        let (n, threads) = cases[case];
        workload::run(&load(n)?, threads, None)
    })?;
    let several = options.threads.len();
    let row = |case: usize| {
        let (n, threads) = cases[case];
        row(
            n,
            threads,
            options,
            &costs[case],
            &costs[case - case % several],
        )
    };
    Ok((0..cases.len()).map(row).collect())
}

fn row(n: u32, threads: usize, options: &Options, cost: &Cost, first: &Cost) -> Row {
    let [sent, received] = cost.packets;
    let pairs = sent as f64 * (f64::from(n) - 1.0);
    let each = |x: f64, of: f64| (of > 0.0).then(|| x / of);
    Row {
        n,
        threads,
        medium: options.medium.clone(),
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
        gain: first.wall_s / cost.wall_s,
        cost: cost.clone(),
    }
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

/// The section `[channel]`.
fn channel(medium: &str) -> &'static str {
    match medium {
        "ieee802154" => r#"medium = "ieee802154""#,
        _ => "medium = \"simple\"\nrange_limit = \"30 m\"",
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
    if options.start == "paper" {
        remark(
            "the paper's soft real-time limit for this workload: 550 MAVs (2.2 GHz quad-core, 2011)",
        );
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

//! What it costs to be looked at: figure 7's swarm without a viewer, with one that nobody looks at, and with
//! a page that takes every frame.

use super::workload::{PAPER_EDGE_M, Workload};
use super::{Failure, input, process, remark, say};
use clap::Args;
use serde::Serialize;
use simbeeotic_model::{FromParams, Simulation};
use simbeeotic_scenario::Loaded;
use simbeeotic_view::live::{Viewer, ViewerParams};
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

/// Arguments of `bench view`.
#[derive(Args)]
pub(in crate::program) struct Options {
    /// Size of the swarm
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..))]
    n: u32,
    /// Virtual time of each run
    #[arg(
        long,
        default_value = "30 s",
        value_name = "TIME",
        allow_hyphen_values = true
    )]
    duration: String,
    /// Rounds of the three runs; the least of each figure is told
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=1000))]
    repeat: u32,
    /// Print the rows as JSON
    #[arg(long)]
    json: bool,
}

/// How a run is looked at.
#[derive(Clone, Copy, PartialEq)]
enum Watched {
    Not,
    Alone,
    Page,
}

const CASES: [(Watched, &str); 3] = [
    (Watched::Not, "no viewer"),
    (Watched::Alone, "viewer, no page"),
    (Watched::Page, "viewer, one page"),
];

/// One way to be looked at.
#[derive(Clone, Serialize)]
struct Row {
    watched: &'static str,
    /// Processor time of the thread that runs the swarm, s.
    run_thread_s: Option<f64>,
    /// The same over that of the run without a viewer.
    ratio: Option<f64>,
    /// Processor time of the whole process, client included, s.
    cpu_s: Option<f64>,
    wall_s: f64,
    /// Frames that the page got in a second of wall time.
    frames_per_s: f64,
    trace_hash: String,
}

pub(super) fn view(options: &Options) -> Result<(), Failure> {
    let duration = input::time("--duration", &options.duration)?;
    if !options.json {
        remark(format!(
            "being looked at: {} bees of figure 7, {} s virtual, as fast as they can, one thread",
            options.n,
            duration.secs()
        ));
    }
    let workload = Workload {
        bees: options.n,
        duration_s: duration.secs(),
        edges_m: [PAPER_EDGE_M; 3],
        phase: "aligned",
        contacts: true,
        channel: None,
    };
    let loaded = workload.load()?;
    let mut rows: Vec<Row> = Vec::new();
    for _ in 0..options.repeat {
        for (at, case) in CASES.into_iter().enumerate() {
            let row = run(&loaded, case)?;
            match rows.get_mut(at) {
                None => rows.push(row),
                Some(least) => least.least(&row),
            }
        }
    }
    let first = rows[0].clone();
    for row in &mut rows {
        if row.trace_hash != first.trace_hash {
            return Err(Failure::run(format!(
                "viewing changes the run: trace hashes {} and {}",
                first.trace_hash, row.trace_hash
            )));
        }
        row.ratio = row.run_thread_s.zip(first.run_thread_s).map(|(a, b)| a / b);
    }
    if options.json {
        return say(serde_json::to_string_pretty(&rows).map_err(Failure::run)?);
    }
    say(format!(
        "{:<18} {:>12} {:>8} {:>9} {:>9} {:>9}",
        "", "run thread s", "ratio", "all cpu s", "wall s", "frames/s"
    ))?;
    for row in &rows {
        let figure = |value: Option<f64>| value.map_or("-".to_owned(), |v| format!("{v:.3}"));
        say(format!(
            "{:<18} {:>12} {:>8} {:>9} {:>9.3} {:>9.1}",
            row.watched,
            figure(row.run_thread_s),
            figure(row.ratio),
            figure(row.cpu_s),
            row.wall_s,
            row.frames_per_s
        ))?;
    }
    remark(format!(
        "trace hashes are equal; each figure is the least of {} interleaved rounds",
        options.repeat
    ));
    Ok(())
}

impl Row {
    /// The least of each figure of the two; of frames the most.
    fn least(&mut self, other: &Self) {
        let least = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a.min(b));
        self.run_thread_s = least(self.run_thread_s, other.run_thread_s);
        self.cpu_s = least(self.cpu_s, other.cpu_s);
        self.wall_s = self.wall_s.min(other.wall_s);
        self.frames_per_s = self.frames_per_s.max(other.frames_per_s);
        if self.trace_hash != other.trace_hash {
            self.trace_hash.push_str(" and ");
            self.trace_hash.push_str(&other.trace_hash);
        }
    }
}

fn run(loaded: &Loaded, (watched, name): (Watched, &'static str)) -> Result<Row, Failure> {
    let mut setup = input::setup(loaded)?;
    setup.threads = 1;
    let frames = Arc::new(AtomicU64::new(0));
    let mut client = None;
    if watched != Watched::Not {
        let params = ViewerParams {
            port: Some(0),
            ..ViewerParams::default()
        };
        let mut viewer = Viewer::from_params(params).map_err(Failure::run)?;
        let url = viewer.bind().map_err(Failure::run)?;
        setup
            .components
            .push(("viewer".to_owned(), Box::new(viewer)));
        if watched == Watched::Page {
            let frames = Arc::clone(&frames);
            client = Some(std::thread::spawn(move || look(&url, &frames)));
        }
    }
    let mut simulation = Simulation::new(setup).map_err(|e| input::setup_failure(loaded, e))?;
    let before = (process::cpu_s(), process::thread_cpu_s());
    let outcome = simulation.run();
    let since = |now: Option<f64>, before: Option<f64>| now.zip(before).map(|(a, b)| a - b);
    let (cpu_s, run_thread_s) = (
        since(process::cpu_s(), before.0),
        since(process::thread_cpu_s(), before.1),
    );
    let seen = frames.load(Ordering::Relaxed) as f64;
    // The viewer closes its page.
    drop(simulation);
    if let Some(client) = client {
        let ended = client.join().map_err(|_| Failure::run("the page failed"))?;
        ended.map_err(|why| Failure::run(format!("the page could not look: {why}")))?;
    }
    if let Some(error) = outcome.error {
        return Err(Failure::run(error));
    }
    let summary = outcome.summary;
    Ok(Row {
        watched: name,
        run_thread_s,
        ratio: None,
        cpu_s,
        wall_s: summary.wall_s,
        frames_per_s: seen / summary.wall_s.max(1e-9),
        trace_hash: summary.trace_hash,
    })
}

/// A page that takes frames and drops them, until it is closed.
fn look(url: &str, frames: &AtomicU64) -> Result<(), String> {
    let said = |e: &dyn std::fmt::Display| e.to_string();
    let place = url.trim_start_matches("http://").trim_end_matches('/');
    let mut request = format!("ws://{place}/stream")
        .into_client_request()
        .map_err(|e| said(&e))?;
    let origin = format!("http://{place}").parse().map_err(|_| "no origin")?;
    request.headers_mut().insert("Origin", origin);
    let stream = TcpStream::connect(place).map_err(|e| said(&e))?;
    let (mut socket, _): (WebSocket<TcpStream>, _) =
        tungstenite::client(request, stream).map_err(|e| said(&e))?;
    while let Ok(message) = socket.read() {
        let Message::Binary(bytes) = message else {
            continue;
        };
        let time = bytes.get(8..16).and_then(|time| time.try_into().ok());
        if let (Some(1), Some(time)) = (bytes.first(), time.map(f64::from_le_bytes)) {
            frames.fetch_add(1, Ordering::Relaxed);
            let got = format!("{{\"type\":\"got\",\"time_s\":{time}}}");
            if socket.send(Message::text(got)).is_err() {
                break;
            }
        }
    }
    Ok(())
}

//! What it costs to be looked at: figure 7's swarm without a viewer, with one that nobody looks at, and with
//! a page that takes every frame.
//!
//! Two measures of one thing. The *share* is the processor time that the viewer itself used on the run's thread, over all
//! that this thread used in the same run: exact, and hardly disturbed by what else the machine does; but it leaves out what
//! the viewer costs beyond its own code (marks that are noted for it, caches). On a busy machine the run gets less than
//! a second of processor time in each second, and as many frames; *at 30/s* corrects for that. The *ratio* is the processor time of the
//! run's thread over that of the run without a viewer: it has all, with the noise of two runs. Wall time is told beside
//! both: where the page's threads find no free processor, they take theirs from the run.

use super::workload::{PAPER_EDGE_M, Workload};
use super::{Failure, input, process, remark, say};
use clap::Args;
use serde::Serialize;
use simbeeotic_model::kernel::pace::Control;
use simbeeotic_model::kernel::{Progress, SimTime};
use simbeeotic_model::units::Time;
use simbeeotic_model::{Component, ComponentError, FromParams, Note, Simulation, Summary, View};
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
    /// Rounds of the three runs
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
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
    /// Processor time of that which the viewer used itself, s.
    viewer_s: Option<f64>,
    /// The one over the other.
    share: Option<f64>,
    /// The share of its looks if there had been 30 frames in each second of the run's own processor time, rather than of
    /// wall time: what the share comes to where the run has a processor for itself.
    share_at_30: Option<f64>,
    /// What the viewer used before the first event: once, however long the run.
    start_s: Option<f64>,
    /// `run_thread_s` over that of the run without a viewer: the median of the rounds.
    ratio: Option<f64>,
    /// Processor time of the whole process, client included, s.
    cpu_s: Option<f64>,
    wall_s: f64,
    /// The same over that of the run without a viewer: the median of the rounds.
    wall_ratio: f64,
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
    let (mut ratios, mut wall_ratios) = ([const { Vec::new() }; 3], [const { Vec::new() }; 3]);
    for _ in 0..options.repeat {
        let round = CASES.map(|case| run(&loaded, case));
        let round: Vec<Row> = round.into_iter().collect::<Result<_, _>>()?;
        for (at, row) in round.iter().enumerate() {
            if row.trace_hash != round[0].trace_hash {
                return Err(Failure::run(format!(
                    "viewing changes the run: trace hashes {} and {}",
                    round[0].trace_hash, row.trace_hash
                )));
            }
            let threads = row.run_thread_s.zip(round[0].run_thread_s);
            ratios[at].extend(threads.map(|(a, b)| a / b));
            wall_ratios[at].push(row.wall_s / round[0].wall_s);
            match rows.get_mut(at) {
                None => rows.push(row.clone()),
                Some(least) => least.least(row),
            }
        }
    }
    for (at, row) in rows.iter_mut().enumerate() {
        row.ratio = median(&mut ratios[at]);
        row.wall_ratio = median(&mut wall_ratios[at]).unwrap_or(f64::NAN);
    }
    if options.json {
        return say(serde_json::to_string_pretty(&rows).map_err(Failure::run)?);
    }
    say(format!(
        "{:<16} {:>12} {:>9} {:>7} {:>8} {:>9} {:>6} {:>9} {:>8} {:>6} {:>8}",
        "",
        "run thread s",
        "viewer s",
        "share",
        "at 30/s",
        "(start s)",
        "ratio",
        "all cpu s",
        "wall s",
        "ratio",
        "frames/s"
    ))?;
    for row in &rows {
        let figure = |value: Option<f64>| value.map_or("-".to_owned(), |v| format!("{v:.3}"));
        let percent = |share: f64| format!("{:.2} %", share * 100.0);
        say(format!(
            "{:<16} {:>12} {:>9} {:>7} {:>8} {:>9} {:>6} {:>9} {:>8.3} {:>6.3} {:>8.1}",
            row.watched,
            figure(row.run_thread_s),
            figure(row.viewer_s),
            row.share.map_or("-".to_owned(), percent),
            row.share_at_30.map_or("-".to_owned(), percent),
            figure(row.start_s),
            figure(row.ratio),
            figure(row.cpu_s),
            row.wall_s,
            row.wall_ratio,
            row.frames_per_s
        ))?;
    }
    remark(format!(
        "trace hashes are equal; seconds and shares are the least of {} interleaved rounds, ratios their medians",
        options.repeat
    ));
    remark(format!(
        "{} threads can run at once here: with less than three free, pages take time from the run (see the wall ratio)",
        std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
    ));
    Ok(())
}

impl Row {
    /// The least of each figure of the two; of frames the most.
    fn least(&mut self, other: &Self) {
        let least = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a.min(b));
        self.run_thread_s = least(self.run_thread_s, other.run_thread_s);
        self.viewer_s = least(self.viewer_s, other.viewer_s);
        self.share = least(self.share, other.share);
        self.share_at_30 = least(self.share_at_30, other.share_at_30);
        self.start_s = least(self.start_s, other.start_s);
        self.cpu_s = least(self.cpu_s, other.cpu_s);
        self.wall_s = self.wall_s.min(other.wall_s);
        self.frames_per_s = self.frames_per_s.max(other.frames_per_s);
    }
}

/// The middle one of some numbers, or the mean of the two in the middle.
fn median(numbers: &mut [f64]) -> Option<f64> {
    numbers.sort_by(f64::total_cmp);
    let middle = numbers.len() / 2;
    match numbers.len() {
        0 => None,
        count if count % 2 == 1 => Some(numbers[middle]),
        _ => Some((numbers[middle - 1] + numbers[middle]) / 2.0),
    }
}

fn run(loaded: &Loaded, (watched, name): (Watched, &'static str)) -> Result<Row, Failure> {
    let mut setup = input::setup(loaded)?;
    setup.threads = 1;
    let frames = Arc::new(AtomicU64::new(0));
    let spent = Arc::new(Spent::default());
    let mut client = None;
    if watched != Watched::Not {
        let params = ViewerParams {
            port: Some(0),
            ..ViewerParams::default()
        };
        let mut viewer = Viewer::from_params(params).map_err(Failure::run)?;
        let url = viewer.bind().map_err(Failure::run)?;
        let timed = Timed {
            viewer,
            spent: Arc::clone(&spent),
        };
        setup
            .components
            .push(("viewer".to_owned(), Box::new(timed)));
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
        viewer_s: run_thread_s.map(|_| spent.all_s()),
        share: run_thread_s.map(|all_s| spent.all_s() / all_s),
        share_at_30: (run_thread_s.filter(|_| seen > 0.0))
            .map(|_| seconds(&spent.looks_ns) / seen * 30.0),
        start_s: run_thread_s.map(|_| seconds(&spent.start_ns)),
        ratio: None,
        cpu_s,
        wall_s: summary.wall_s,
        wall_ratio: f64::NAN,
        frames_per_s: seen / summary.wall_s.max(1e-9),
        trace_hash: summary.trace_hash,
    })
}

/// Processor time that a viewer used on the run's thread, ns.
#[derive(Default)]
struct Spent {
    start_ns: AtomicU64,
    /// At all looks, and at the end.
    looks_ns: AtomicU64,
}

impl Spent {
    fn all_s(&self) -> f64 {
        seconds(&self.start_ns) + seconds(&self.looks_ns)
    }
}

fn seconds(nanos: &AtomicU64) -> f64 {
    nanos.load(Ordering::Relaxed) as f64 * 1e-9
}

/// A viewer that is timed.
struct Timed {
    viewer: Viewer,
    spent: Arc<Spent>,
}

impl Timed {
    fn timed<T>(
        &mut self,
        count: fn(&Spent) -> &AtomicU64,
        work: impl FnOnce(&mut Viewer) -> T,
    ) -> T {
        let before = process::thread_cpu_s();
        let done = work(&mut self.viewer);
        if let Some((after, before)) = process::thread_cpu_s().zip(before) {
            let nanos = ((after - before) * 1e9).max(0.0) as u64;
            count(&self.spent).fetch_add(nanos, Ordering::Relaxed);
        }
        done
    }
}

impl Component for Timed {
    fn period(&self) -> Option<Time> {
        self.viewer.period()
    }

    fn wants_reading(&self, sensor: &str) -> bool {
        self.viewer.wants_reading(sensor)
    }

    fn wants_packets(&self, radio: &str, among: usize) -> bool {
        self.viewer.wants_packets(radio, among)
    }

    fn interest(&self) -> u64 {
        self.viewer.interest()
    }

    fn attach(&mut self, control: &Arc<Control>, progress: &Arc<Progress>) {
        self.viewer.attach(control, progress);
    }

    fn held(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        self.viewer.held(view)
    }

    fn next_observation(&self, now: SimTime) -> Option<SimTime> {
        self.viewer.next_observation(now)
    }

    fn start(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        self.timed(|spent| &spent.start_ns, |viewer| viewer.start(view))
    }

    fn observe(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        self.timed(|spent| &spent.looks_ns, |viewer| viewer.observe(view))
    }

    fn finish(&mut self, view: &View<'_>, summary: &Summary) -> Result<Vec<Note>, ComponentError> {
        self.timed(
            |spent| &spent.looks_ns,
            |viewer| viewer.finish(view, summary),
        )
    }
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

//! How a run looks in a terminal: the progress bar and the summary.

use indicatif::{HumanCount, ProgressBar, ProgressDrawTarget, ProgressStyle};
use simbeeotic_kernel::{Progress, SimTime};
use simbeeotic_model::{Consumer, Summary};
use simbeeotic_units::math;
use std::fmt::Write as _;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// A bar on standard error that follows a run from a thread of its own.
pub(super) struct Bar {
    done: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Bar {
    /// Follows `progress` until it is dropped. Draws nothing if standard error is no terminal.
    #[allow(
        clippy::disallowed_methods,
        reason = "shows wall-clock speed to the user"
    )]
    pub(super) fn start(progress: Arc<Progress>, end: SimTime) -> Self {
        let done = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&done);
        let thread = std::thread::spawn(move || {
            let bar = ProgressBar::with_draw_target(
                Some(end.nanos()),
                ProgressDrawTarget::stderr_with_hz(10),
            );
            let template = "{bar:32} {percent:>3}%  {msg}";
            if let Ok(style) = ProgressStyle::with_template(template) {
                bar.set_style(style.progress_chars("=> "));
            }
            let start = Instant::now();
            let mut last = (start, progress.events());
            while !flag.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(100));
                let (now, virtual_s) = (Instant::now(), progress.now().as_secs_f64());
                let wall_s = (now - start).as_secs_f64();
                let speed = virtual_s / wall_s.max(1e-9);
                let events = progress.events();
                let rate = (events - last.1) as f64 / (now - last.0).as_secs_f64().max(1e-9);
                last = (now, events);
                let left_s = (end.as_secs_f64() - virtual_s) / speed.max(1e-9);
                bar.set_position(progress.now().nanos().min(end.nanos()));
                bar.set_message(format!(
                    "{virtual_s:.1} s of {:.1} s   {speed:.2} x real time   {} events/s   {} left",
                    end.as_secs_f64(),
                    HumanCount(rate as u64),
                    span(left_s),
                ));
            }
            bar.finish_and_clear();
        });
        Self {
            done,
            thread: Some(thread),
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.done.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// A bar on standard error that counts what is done. Draws nothing if standard error is no terminal.
pub(super) struct Steps(ProgressBar);

impl Steps {
    /// A bar of so many steps; `what` they are.
    pub(super) fn start(total: u64, what: &str) -> Self {
        let bar =
            ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr_with_hz(10));
        let template = format!(
            "{{bar:32}} {{percent:>3}}%  {{pos}} of {{len}} {what}   {{per_sec}}   {{eta}} left"
        );
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style.progress_chars("=> "));
        }
        Self(bar)
    }

    pub(super) fn at(&self, done: u64) {
        self.0.set_position(done);
    }
}

impl Drop for Steps {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// Seconds as people say them.
pub(super) fn span(seconds: f64) -> String {
    match seconds {
        s if !s.is_finite() || s > 359_999.0 => "?".to_owned(),
        s if s < 60.0 => format!("{s:.0} s"),
        s if s < 3600.0 => format!("{:.0} min {:02.0} s", (s / 60.0).floor(), s % 60.0),
        s => format!(
            "{:.0} h {:02.0} min",
            (s / 3600.0).floor(),
            (s % 3600.0) / 60.0
        ),
    }
}

/// Threads as people say them.
pub(super) fn threads(threads: usize) -> String {
    match threads {
        1 => "1 thread".to_owned(),
        n => format!("{n} threads"),
    }
}

/// The metrics that stand in a printed summary.
const METRICS_SHOWN: usize = 24;

/// Any number with about three digits that count.
pub(super) fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        usual if (1e-3..1e9).contains(&usual) && value < 0.0 => format!("-{}", plain(usual)),
        usual if (1e-3..1e9).contains(&usual) => plain(usual),
        _ => format!("{value:.2e}"),
    }
}

/// Three digits that count, and no zeros behind the point.
fn plain(number: f64) -> String {
    let digits = three_digits(number);
    match digits.contains('.') {
        true => digits
            .trim_end_matches('0')
            .trim_end_matches('.')
            .to_owned(),
        false => digits,
    }
}

/// A positive number with three digits that count, or all of its whole ones.
fn three_digits(number: f64) -> String {
    let decimals = (2.0 - math::log10(number).floor()).clamp(0.0, 14.0);
    format!("{number:.*}", decimals as usize)
}

/// The summary of a run, as a page of text; `ended` says why it did.
pub(super) fn summary(summary: &Summary, ended: &str) -> String {
    let mut page = String::new();
    let mut line = |key: &str, value: String| {
        let _ = writeln!(page, "  {key:<10} {value}");
    };
    let s = summary;
    // Seeds are signed in files and arguments.
    let seed = s.seed.cast_signed();
    line("scenario", format!("{}, seed {seed}", s.scenario));
    line(
        "models",
        format!(
            "{}, {} bodies, {} radios",
            HumanCount(s.models as u64),
            HumanCount(s.bodies as u64),
            HumanCount(s.radios as u64)
        ),
    );
    line(
        "time",
        format!(
            "{:.3} s virtual in {:.2} s: {:.2} x real time, {} ({ended})",
            s.virtual_s,
            s.wall_s,
            s.speed,
            threads(s.threads)
        ),
    );
    let t = &s.time;
    line(
        "spent on",
        format!(
            "init {:.2} s, events {:.2} s, physics {:.2} s, radio {:.2} s, other {:.2} s",
            t.init_s, t.events_s, t.physics_s, t.radio_s, t.other_s
        ),
    );
    line(
        "events",
        format!(
            "{} in {} instants",
            HumanCount(s.events),
            HumanCount(s.instants)
        ),
    );
    line("touches", HumanCount(s.touches).to_string());
    if s.radios > 0 {
        let lost: Vec<_> = s
            .packets
            .lost
            .iter()
            .map(|(why, n)| format!("{} {why}", HumanCount(*n)))
            .collect();
        let lost = if lost.is_empty() {
            String::new()
        } else {
            format!("; lost: {}", lost.join(", "))
        };
        let text = format!(
            "{} sent, {} received{lost}",
            HumanCount(s.packets.sent),
            HumanCount(s.packets.received)
        );
        line("packets", text);
    }
    let drawn = |consumer: Consumer| {
        let line = s.charge.get(consumer.name());
        line.map_or(0.0, |line| line.milliampere_seconds / 3600.0)
    };
    let shares: Vec<_> = Consumer::ALL
        .into_iter()
        .filter(|consumer| drawn(*consumer) > 0.0)
        .map(|consumer| format!("{} {}", consumer.name(), three_digits(drawn(consumer))))
        .collect();
    if !shares.is_empty() {
        let total = three_digits(Consumer::ALL.into_iter().map(drawn).sum());
        line("charge", format!("{total} mAh: {}", shares.join(", ")));
    }
    if let Some(all) = &s.batteries {
        let joules = |consumer: &Consumer| s.charge.get(consumer.name()).and_then(|l| l.joules);
        let shares = Consumer::ALL.iter().filter_map(|consumer| {
            let joules = joules(consumer).filter(|joules| *joules > 0.0)?;
            Some(format!("{} {}", consumer.name(), three_digits(joules)))
        });
        let mut shares: Vec<_> = shares.collect();
        if all.heat_j > 0.0 {
            shares.push(format!("heat {}", three_digits(all.heat_j)));
        }
        let used: f64 = Consumer::ALL.iter().filter_map(joules).sum();
        let total = three_digits(used + all.heat_j);
        if !shares.is_empty() {
            line("energy", format!("{total} J: {}", shares.join(", ")));
        }
        line(
            "batteries",
            format!(
                "{}, {:.0} % full, the lowest {:.0} %; empty {} times, charged {} times, {} out of power",
                HumanCount(all.count as u64),
                100.0 * all.soc_mean,
                100.0 * all.soc_min,
                all.emptied,
                all.charged,
                all.out_of_power,
            ),
        );
    }
    for metric in s.metrics.iter().take(METRICS_SHOWN) {
        let [sum, mean, min, max] = [metric.sum, metric.mean, metric.min, metric.max].map(number);
        let unit = match metric.unit.as_str() {
            "1" => String::new(),
            unit => format!(" {unit}"),
        };
        let text = match metric.models {
            1 => format!("{sum}{unit} (1 model)"),
            models => format!(
                "{mean}{unit} on average, {min} to {max}, {sum} in all ({} models)",
                HumanCount(models as u64)
            ),
        };
        line(&metric.name, text);
    }
    if s.metrics.len() > METRICS_SHOWN {
        let more = s.metrics.len() - METRICS_SHOWN;
        line("metrics", format!("{more} more: --summary FILE has them"));
    }
    if let Some(late) = &s.lateness {
        line(
            "late",
            format!(
                "{} instants, at most {:.1} ms",
                HumanCount(late.late),
                late.max_ms
            ),
        );
    }
    for note in &s.notes {
        line(&note.key, note.text.clone());
    }
    line("trace", s.trace_hash.clone());
    page
}

/// Bytes as people say them, and as the recorder does: `123 kB`, `12.3 MB`.
pub(super) fn bytes(bytes: u64) -> String {
    match bytes {
        bytes if bytes < 1_000_000 => format!("{:.0} kB", bytes as f64 * 1e-3),
        bytes => format!("{:.1} MB", bytes as f64 * 1e-6),
    }
}

#[cfg(test)]
mod tests {
    use super::{number, three_digits};

    #[test]
    fn small_shares_are_not_zero() {
        let shown = [1106.97, 273.7, 83.33, 8.333, 0.8333, 0.000_412_6].map(three_digits);
        assert_eq!(shown, ["1107", "274", "83.3", "8.33", "0.833", "0.000413"]);
    }

    #[test]
    fn metrics_of_any_size_are_short() {
        let all = [0.0, 7.0, -7.25, 1234.0, 0.5, 1e-9, -3e12, f64::INFINITY];
        let shown = all.map(number);
        assert_eq!(
            shown,
            [
                "0", "7", "-7.25", "1234", "0.5", "1.00e-9", "-3.00e12", "inf"
            ]
        );
    }
}

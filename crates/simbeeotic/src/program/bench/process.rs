//! What the operating system counts: processor time and memory of this process.

use std::collections::BTreeMap;
use std::fs::DirEntry;
use std::thread::ThreadId;

/// Processor time that all threads of this process have used, in user and in system mode, s. `None`
/// where there is no such clock.
pub(super) fn cpu_s() -> Option<f64> {
    #[cfg(unix)]
    {
        use rustix::time::{ClockId, clock_gettime};
        let time = clock_gettime(ClockId::ProcessCPUTime);
        Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
    }
    #[cfg(not(unix))]
    None
}

/// Processor time that this thread has used, s. `None` where there is no such clock.
pub(super) fn thread_cpu_s() -> Option<f64> {
    #[cfg(unix)]
    {
        use rustix::time::{ClockId, clock_gettime};
        let time = clock_gettime(ClockId::ThreadCPUTime);
        Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
    }
    #[cfg(not(unix))]
    None
}

/// Processor time of each living thread at one instant.
pub(super) struct Threads {
    /// s, by the thread's number; empty where there is no `/proc`. The kernel brings it up to date every few
    /// milliseconds.
    each_s: BTreeMap<String, f64>,
    /// Of the thread that looks, to the nanosecond, s.
    own_s: Option<f64>,
    own: ThreadId,
}

impl Threads {
    /// Now.
    pub(super) fn now() -> Self {
        Self {
            each_s: threads_cpu_s(),
            own_s: thread_cpu_s(),
            own: std::thread::current().id(),
        }
    }

    /// Of the threads that live now, what the busiest has used since then, s. However free the processors are, the
    /// work between the two cannot have taken less.
    pub(super) fn busiest_s(&self) -> Option<f64> {
        let since = |(thread, now)| now - self.each_s.get(&thread).copied().unwrap_or(0.0);
        let busiest = threads_cpu_s().into_iter().map(since);
        let here = self.own == std::thread::current().id();
        let own = thread_cpu_s().zip(self.own_s).filter(|_| here);
        let own = own.map(|(now, then)| now - then);
        busiest.chain(own).max_by(f64::total_cmp)
    }
}

fn threads_cpu_s() -> BTreeMap<String, f64> {
    let Ok(tasks) = std::fs::read_dir("/proc/self/task") else {
        return BTreeMap::new();
    };
    let used = |task: DirEntry| {
        let nanos = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        let nanos: f64 = nanos.split(' ').next()?.parse().ok()?;
        Some((
            task.file_name().to_string_lossy().into_owned(),
            nanos * 1e-9,
        ))
    };
    tasks.flatten().filter_map(used).collect()
}

/// How many threads of the machine wanted a processor in the last minute, in the mean. `None` where there is no
/// `/proc`.
pub(super) fn load() -> Option<f64> {
    let said = std::fs::read_to_string("/proc/loadavg").ok()?;
    said.split(' ').next()?.parse().ok()
}

/// The most memory that this process ever held at once (`VmHWM`), bytes. `None` where there is no
/// `/proc`.
pub(super) fn peak_bytes() -> Option<f64> {
    peak_of(&std::fs::read_to_string("/proc/self/status").ok()?)
}

/// Memory that can still be had without swapping (`MemAvailable`), and within the limit of a process (`ulimit -v`),
/// bytes. `None` where there is no `/proc`.
pub(super) fn free_bytes() -> Option<f64> {
    let said = std::fs::read_to_string("/proc/meminfo").ok()?;
    let free = kib_of(&said, "MemAvailable:")? * 1024.0;
    let limits = std::fs::read_to_string("/proc/self/limits").unwrap_or_default();
    Some(limit_of(&limits).unwrap_or(free).min(free))
}

fn limit_of(limits: &str) -> Option<f64> {
    let mut lines = limits.lines();
    let soft = lines.find_map(|line| line.strip_prefix("Max address space"))?;
    soft.split_whitespace().next()?.parse().ok()
}

fn peak_of(status: &str) -> Option<f64> {
    kib_of(status, "VmHWM:").map(|kib| kib * 1024.0)
}

/// The number of a line that begins so.
fn kib_of(text: &str, name: &str) -> Option<f64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.trim().strip_suffix(" kB")?.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_peak_is_read_from_its_line() {
        let status = "Name:\tx\nVmPeak:\t  900 kB\nVmHWM:\t   12 kB\nVmRSS:\t 8 kB\n";
        assert_eq!(peak_of(status), Some(12_288.0));
        assert_eq!(peak_of("VmHWM:\t12 pages\n"), None);
        assert_eq!(peak_of(""), None);
    }

    #[test]
    fn the_limit_of_memory_is_read_from_its_line() {
        let limits = |soft| {
            format!(
                "Limit  Soft Limit\nMax cpu time  9\nMax address space    {soft}    unlimited    bytes\n"
            )
        };
        assert_eq!(limit_of(&limits("8192")), Some(8192.0));
        assert_eq!(limit_of(&limits("unlimited")), None);
        assert_eq!(limit_of(""), None);
    }

    #[test]
    fn one_thread_cannot_use_more_than_all() {
        let (all, each) = (cpu_s(), Threads::now());
        std::hint::black_box((0..1_000_000).fold(0_u64, |a, b| a.rotate_left(7) ^ b));
        if let (Some(before), Some(busiest)) = (all, each.busiest_s()) {
            let used = cpu_s().expect("it was there") - before;
            assert!(
                (0.0..=used + 0.05).contains(&busiest),
                "{busiest} of {used}"
            );
        }
    }

    #[test]
    fn processor_time_grows() {
        if let (Some(before), Some(after)) = (cpu_s(), cpu_s()) {
            assert!(0.0 < before && before <= after);
        }
    }
}

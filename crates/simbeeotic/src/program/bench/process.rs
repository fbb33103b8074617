//! What the operating system counts: processor time and memory of this process.

use std::collections::BTreeMap;
use std::fs::DirEntry;

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

/// Processor time of each living thread of this process, s, by its number; empty where there is no
/// `/proc`. The kernel brings it up to date every few milliseconds.
pub(super) fn threads_cpu_s() -> BTreeMap<String, f64> {
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

/// Of the threads that live now, what the busiest has used since `before`, s. However free the
/// processors are, the work between the two cannot have taken less.
pub(super) fn busiest_since(before: &BTreeMap<String, f64>) -> Option<f64> {
    let since = |(thread, now)| now - before.get(&thread).copied().unwrap_or(0.0);
    threads_cpu_s()
        .into_iter()
        .map(since)
        .max_by(f64::total_cmp)
}

/// The most memory that this process ever held at once (`VmHWM`), bytes. `None` where there is no
/// `/proc`.
pub(super) fn peak_bytes() -> Option<f64> {
    peak_of(&std::fs::read_to_string("/proc/self/status").ok()?)
}

/// Memory that can still be had without swapping (`MemAvailable`), bytes. `None` where there is no `/proc`.
pub(super) fn free_bytes() -> Option<f64> {
    let said = std::fs::read_to_string("/proc/meminfo").ok()?;
    kib_of(&said, "MemAvailable:").map(|kib| kib * 1024.0)
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
    fn one_thread_cannot_use_more_than_all() {
        let (all, each) = (cpu_s(), threads_cpu_s());
        std::hint::black_box((0..1_000_000).fold(0_u64, |a, b| a.rotate_left(7) ^ b));
        if let (Some(before), Some(busiest)) = (all, busiest_since(&each)) {
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

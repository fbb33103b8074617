//! What the operating system counts: processor time and memory of this process.

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

/// The most memory that this process ever held at once (`VmHWM`), bytes. `None` where there is no
/// `/proc`.
pub(super) fn peak_bytes() -> Option<f64> {
    peak_of(&std::fs::read_to_string("/proc/self/status").ok()?)
}

fn peak_of(status: &str) -> Option<f64> {
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix(" kB")?.trim().parse().ok()?;
    Some(kib * 1024.0)
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
    fn processor_time_grows() {
        if let (Some(before), Some(after)) = (cpu_s(), cpu_s()) {
            assert!(0.0 < before && before <= after);
        }
    }
}

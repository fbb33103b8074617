//! Which machine this is: figures of speed mean nothing without it.

use serde::Serialize;

/// A machine, and the program on it.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Machine {
    /// Processors that this process may use.
    pub(super) cores: usize,
    /// What the processor calls itself; empty if it does not say.
    pub(super) cpu: String,
    /// The operating system, with its version if it tells.
    pub(super) os: String,
    /// The program, its version, and how it was built.
    pub(super) version: String,
}

impl Machine {
    /// This one.
    pub(super) fn this() -> Self {
        let read = |path: &str| std::fs::read_to_string(path).unwrap_or_default();
        let os = value(&read("/etc/os-release"), "PRETTY_NAME", '=');
        Self {
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            cpu: value(&read("/proc/cpuinfo"), "model name", ':').unwrap_or_default(),
            os: os.unwrap_or_else(|| std::env::consts::OS.to_owned()),
            version: format!(
                "simbeeotic {} ({})",
                env!("CARGO_PKG_VERSION"),
                match cfg!(debug_assertions) {
                    true => "debug",
                    false => "release",
                }
            ),
        }
    }

    /// In a line.
    pub(super) fn line(&self) -> String {
        let cpu = match self.cpu.as_str() {
            "" => "a processor that does not say its name",
            cpu => cpu,
        };
        let cores = match self.cores {
            1 => "1 core".to_owned(),
            n => format!("{n} cores"),
        };
        format!("{cores} of {cpu}, {}, {}", self.os, self.version)
    }
}

/// The value of the first line `key`, separator, value; without quotes.
fn value(text: &str, key: &str, separator: char) -> Option<String> {
    let mut pairs = text.lines().filter_map(|line| line.split_once(separator));
    let (_, value) = pairs.find(|(name, _)| name.trim() == key)?;
    let value = value.trim().trim_matches('"');
    (!value.is_empty()).then(|| value.split_whitespace().collect::<Vec<_>>().join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_from_their_lines() {
        let cpus = "processor\t: 0\nmodel name\t: A  CPU @ 2 GHz\nmodel name\t: B\n";
        assert_eq!(
            value(cpus, "model name", ':').as_deref(),
            Some("A CPU @ 2 GHz")
        );
        let os = "NAME=x\nPRETTY_NAME=\"Some OS 12\"\n";
        assert_eq!(value(os, "PRETTY_NAME", '=').as_deref(), Some("Some OS 12"));
        assert_eq!(value("", "model name", ':'), None);
        assert_eq!(value("model name\t:\n", "model name", ':'), None);
    }

    #[test]
    fn a_machine_has_cores_and_a_version() {
        let machine = Machine::this();
        assert!(machine.cores > 0);
        assert!(machine.line().contains(env!("CARGO_PKG_VERSION")));
    }
}

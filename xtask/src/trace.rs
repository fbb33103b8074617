//! Golden traces: a run's hash at the end of each virtual second, as text in the repository.
//!
//! ```text
//! # Golden trace. After a wanted change: `cargo xtask golden --accept`, the reason in the commit.
//! scenario fig12.toml
//! seed 111982
//! 1 8c1f0a77b2d9e340
//! 2 03d4c5a1907be612
//! total 5b77e01fd26a9c44
//! ```
//!
//! Line `n` holds the hash of everything that happened up to and including the virtual time `n` s; `total`
//! that of the whole run, which may end within a second. Because each hash contains all that went before,
//! the first line that differs names the second in which two runs part, and that is where to look.
//!
//! A test compares a run that it made in process like this:
//!
//! ```
//! use xtask::trace::Trace;
//!
//! let golden: Trace = "scenario two.toml\nseed 7\n1 00aa\n2 00bb\ntotal 00bb\n".parse()?;
//! let run = Trace::new("two.toml", 7, vec![0xaa, 0xcc], 0xcc);
//! let parted = golden.difference(&run).unwrap();
//! assert!(parted.to_string().contains("virtual second 2"), "{parted}");
//! # Ok::<(), xtask::trace::TraceError>(())
//! ```

use std::fmt;
use std::str::FromStr;

const HEADER: &str = "# Golden trace. After a wanted change: `cargo xtask golden --accept`, the reason in the commit.";

/// The hashes of one run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trace {
    scenario: String,
    seed: u64,
    seconds: Vec<u64>,
    total: u64,
}

impl Trace {
    /// A trace of `scenario` (its file name), run with `seed`.
    ///
    /// `seconds[n]` is the hash at the virtual time n + 1 seconds, `total` the hash at the end of the run.
    pub fn new(scenario: impl Into<String>, seed: u64, seconds: Vec<u64>, total: u64) -> Self {
        Self {
            scenario: scenario.into(),
            seed,
            seconds,
            total,
        }
    }

    /// The file name of the scenario that was run.
    pub fn scenario(&self) -> &str {
        &self.scenario
    }

    /// The master seed of the run.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The number of whole virtual seconds.
    pub fn whole_seconds(&self) -> usize {
        self.seconds.len()
    }

    /// Where `run` first parts from this golden trace; `None` if it does not.
    pub fn difference(&self, run: &Trace) -> Option<Difference> {
        if self.seed != run.seed {
            return Some(Difference::Seed {
                golden: self.seed,
                run: run.seed,
            });
        }
        for (index, (&golden, &hash)) in self.seconds.iter().zip(&run.seconds).enumerate() {
            if golden != hash {
                return Some(Difference::Second {
                    second: index + 1,
                    golden,
                    run: hash,
                });
            }
        }
        if self.seconds.len() != run.seconds.len() {
            return Some(Difference::Length {
                golden: self.seconds.len(),
                run: run.seconds.len(),
            });
        }
        (self.total != run.total).then_some(Difference::Total {
            after: self.seconds.len(),
            golden: self.total,
            run: run.total,
        })
    }
}

/// How a run first parts from its golden trace. `Display` is a sentence for people.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Difference {
    /// The runs had different seeds: there is nothing to compare.
    Seed {
        /// Seed of the golden trace.
        golden: u64,
        /// Seed of the run.
        run: u64,
    },
    /// The hashes part in this virtual second; all before are equal.
    Second {
        /// Counted from 1: second n lies between the virtual times n - 1 s and n s.
        second: usize,
        /// Hash of the golden trace.
        golden: u64,
        /// Hash of the run.
        run: u64,
    },
    /// All common seconds are equal, but one run is longer.
    Length {
        /// Whole seconds in the golden trace.
        golden: usize,
        /// Whole seconds in the run.
        run: usize,
    },
    /// All whole seconds are equal; the runs part after the last.
    Total {
        /// The last whole second.
        after: usize,
        /// Hash of the golden trace.
        golden: u64,
        /// Hash of the run.
        run: u64,
    },
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Seed { golden, run } => {
                write!(f, "the golden trace has seed {golden}, this run had {run}")
            }
            Self::Second {
                second,
                golden,
                run,
            } => {
                let before = second - 1;
                write!(
                    f,
                    "first differs in virtual second {second} ({before} s to {second} s): \
                     golden {golden:016x}, this run {run:016x}"
                )
            }
            Self::Length { golden, run } => {
                let common = golden.min(run);
                write!(
                    f,
                    "equal up to {common} s, but the golden trace has {golden} whole seconds and this run {run}"
                )
            }
            Self::Total { after, golden, run } => write!(
                f,
                "equal up to {after} s, differs between there and the end: \
                 golden {golden:016x}, this run {run:016x}"
            ),
        }
    }
}

impl fmt::Display for Trace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{HEADER}")?;
        writeln!(f, "scenario {}", self.scenario)?;
        writeln!(f, "seed {}", self.seed)?;
        for (index, hash) in self.seconds.iter().enumerate() {
            writeln!(f, "{} {hash:016x}", index + 1)?;
        }
        writeln!(f, "total {:016x}", self.total)
    }
}

/// A golden trace that cannot be read: the line, counted from 1, and what is wrong with it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceError {
    line: usize,
    message: String,
}

impl fmt::Display for TraceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.message)
    }
}

impl std::error::Error for TraceError {}

impl FromStr for Trace {
    type Err = TraceError;

    fn from_str(text: &str) -> Result<Self, TraceError> {
        let mut scenario = None;
        let mut seed = None;
        let mut seconds = Vec::new();
        let mut total = None;
        let mut last = 0;

        for (index, line) in text.lines().enumerate() {
            last = index + 1;
            let fail = |message: String| TraceError {
                line: index + 1,
                message,
            };
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            if total.is_some() {
                return Err(fail("nothing may follow the total".to_owned()));
            }
            let (key, value) = line
                .split_once(' ')
                .ok_or_else(|| fail(format!("`{line}` is not a key and a value")))?;
            match key {
                "scenario" => scenario = Some(value.to_owned()),
                "seed" => {
                    let value = value
                        .parse::<u64>()
                        .map_err(|_| fail(format!("`{value}` is not a seed")))?;
                    seed = Some(value);
                }
                "total" => total = Some(parse_hash(value).map_err(fail)?),
                _ => {
                    if key.parse() != Ok(seconds.len() + 1) {
                        let due = seconds.len() + 1;
                        return Err(fail(format!("second {due} should come here, not `{key}`")));
                    }
                    seconds.push(parse_hash(value).map_err(fail)?);
                }
            }
        }

        let missing = |what: &str| TraceError {
            line: last,
            message: format!("the trace ends without its {what}"),
        };
        Ok(Self {
            scenario: scenario.ok_or_else(|| missing("scenario"))?,
            seed: seed.ok_or_else(|| missing("seed"))?,
            seconds,
            total: total.ok_or_else(|| missing("total"))?,
        })
    }
}

/// Reads a hash as it is written in traces and in the program's summary: 1 to 16 hexadecimal digits.
pub fn parse_hash(text: &str) -> Result<u64, String> {
    let digits = text.strip_prefix("0x").unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return Err(format!("`{text}` is not a hash in hexadecimal digits"));
    }
    u64::from_str_radix(digits, 16).map_err(|_| format!("`{text}` is longer than 16 digits"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn golden() -> Trace {
        Trace::new("three.toml", 11, vec![1, 2, 3], 4)
    }

    #[test]
    fn the_first_differing_second_is_named() {
        let run = Trace::new("three.toml", 11, vec![1, 20, 30], 40);
        let difference = golden().difference(&run);
        assert_eq!(
            difference,
            Some(Difference::Second {
                second: 2,
                golden: 2,
                run: 20
            })
        );
        assert_eq!(
            difference.unwrap().to_string(),
            "first differs in virtual second 2 (1 s to 2 s): \
             golden 0000000000000002, this run 0000000000000014"
        );
    }

    #[test]
    fn a_run_equals_itself() {
        assert_eq!(golden().difference(&golden()), None);
    }

    #[test]
    fn a_difference_after_the_last_whole_second_is_told_from_one_before() {
        let run = Trace::new("three.toml", 11, vec![1, 2, 3], 5);
        assert!(matches!(
            golden().difference(&run),
            Some(Difference::Total { after: 3, .. })
        ));
    }

    #[test]
    fn a_shorter_run_is_no_match() {
        let run = Trace::new("three.toml", 11, vec![1, 2], 2);
        assert_eq!(
            golden().difference(&run),
            Some(Difference::Length { golden: 3, run: 2 })
        );
    }

    #[test]
    fn another_seed_is_told_before_any_hash() {
        let run = Trace::new("three.toml", 12, vec![7, 8, 9], 9);
        assert!(matches!(
            golden().difference(&run),
            Some(Difference::Seed {
                golden: 11,
                run: 12
            })
        ));
    }

    #[test]
    fn writing_and_reading_is_the_identity() {
        let text = golden().to_string();
        assert_eq!(text.parse::<Trace>(), Ok(golden()));
        assert!(text.ends_with("total 0000000000000004\n"), "{text}");
    }

    #[test]
    fn a_trace_with_a_hole_is_refused_with_its_line() {
        let error = "scenario a.toml\nseed 1\n1 aa\n3 bb\ntotal bb\n"
            .parse::<Trace>()
            .unwrap_err();
        assert_eq!(
            error.to_string(),
            "line 4: second 2 should come here, not `3`"
        );
    }

    #[test]
    fn a_trace_cut_short_is_refused() {
        let error = "scenario a.toml\nseed 1\n1 aa\n"
            .parse::<Trace>()
            .unwrap_err();
        assert_eq!(
            error.to_string(),
            "line 3: the trace ends without its total"
        );
    }

    #[test]
    fn hashes_are_hexadecimal_and_64_bits() {
        assert_eq!(parse_hash("00ff"), Ok(255));
        assert_eq!(parse_hash("0xff"), Ok(255));
        assert!(parse_hash("").is_err());
        assert!(parse_hash("+ff").is_err());
        assert!(parse_hash("10000000000000000").is_err());
    }
}

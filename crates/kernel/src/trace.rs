//! The trace hash: one word that says what happened.
//!
//! Every visit, every event key and every committed effect is folded, in order, into 64 bits. Two runs
//! with the same hash did the same; two runs with different hashes are told apart by the first second
//! whose hash differs. It costs a multiply a word.
//!
//! Fold integers and bits (`f64::to_bits`), never formatted text. What is folded is named by path keys,
//! not by model ids, so that an agent's own trace survives a change of the population around it.

use crate::SimTime;
use std::{fmt, str::FromStr};

/// A 64-bit hash that words are folded into, in order.
///
/// One fold is a bijection of the hash for each word and of the word for each hash: a single word that
/// differs always shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Trace(u64);

impl Trace {
    /// The hash of nothing.
    pub const START: Self = Self(0x9216_d5d9_8979_fb1b);

    /// Takes one word in.
    #[inline(always)]
    pub const fn fold(&mut self, word: u64) {
        let x = (self.0 ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = x ^ (x >> 32);
    }

    /// The hash of all words so far.
    #[inline]
    #[must_use]
    pub const fn hash(self) -> u64 {
        self.0
    }
}

impl Default for Trace {
    fn default() -> Self {
        Self::START
    }
}

/// The hash at the end of one simulated second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mark {
    /// The second: 3 is the span from 3 s up to, but without, 4 s.
    pub second: u64,
    /// The hash of everything up to its end.
    pub hash: u64,
}

/// The trace of a run, with a mark for each second in which something happened.
///
/// Its text form, one line a second and a last line with the total, is what golden files hold:
///
/// ```
/// use simbeeotic_kernel::TraceLog;
///
/// let golden: TraceLog = "0 0123456789abcdef\n2 00000000000000ff\ntotal 00000000000000ff\n".parse()?;
/// let run: TraceLog = "0 0123456789abcdef\n1 1111111111111111\ntotal 1111111111111111\n".parse()?;
/// assert_eq!(golden.first_difference(&run), Some(1));
/// assert_eq!(golden.first_difference(&golden), None);
/// # Ok::<(), simbeeotic_kernel::TraceParseError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TraceLog {
    trace: Trace,
    /// Seconds that are over.
    marks: Vec<Mark>,
    /// The second being written, if anything has happened.
    current: Option<u64>,
    /// Start of the second after it, ns.
    boundary: u64,
}

impl TraceLog {
    /// Takes one word in, as part of what happened at the latest instant begun.
    #[inline]
    pub(crate) fn fold(&mut self, word: u64) {
        self.trace.fold(word);
    }

    /// Begins an instant: closes the mark of the second before, if this is another second.
    #[inline]
    pub(crate) fn begin(&mut self, now: SimTime) {
        if now.nanos() >= self.boundary {
            self.turn(now);
        }
    }

    #[cold]
    fn turn(&mut self, now: SimTime) {
        self.marks.extend(self.open_mark());
        self.current = Some(now.whole_secs());
        self.boundary = SimTime::from_secs(now.whole_secs().saturating_add(1)).nanos();
    }

    fn open_mark(&self) -> Option<Mark> {
        self.current.map(|second| Mark {
            second,
            hash: self.trace.hash(),
        })
    }

    /// The hash of the whole run so far.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.trace.hash()
    }

    /// One mark for each second in which something happened, the one under way last.
    pub fn marks(&self) -> impl Iterator<Item = Mark> {
        self.marks.iter().copied().chain(self.open_mark())
    }

    /// The first second in which two runs differ: by its hash, or because something happened in one of
    /// them only. `None` if they are the same.
    #[must_use]
    pub fn first_difference(&self, other: &Self) -> Option<u64> {
        let (mut ours, mut theirs) = (self.marks(), other.marks());
        loop {
            match (ours.next(), theirs.next()) {
                (None, None) => return None,
                (Some(a), Some(b)) if a == b => {}
                (Some(a), Some(b)) => return Some(a.second.min(b.second)),
                (Some(a), None) | (None, Some(a)) => return Some(a.second),
            }
        }
    }
}

impl fmt::Display for TraceLog {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for mark in self.marks() {
            writeln!(f, "{} {:016x}", mark.second, mark.hash)?;
        }
        writeln!(f, "total {:016x}", self.total())
    }
}

/// A text that is not a trace, with the line (from 1) that is wrong.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "line {line} of the trace is not a second and a hash of 16 hex digits, later than the line before"
)]
pub struct TraceParseError {
    /// The line, counted from 1.
    pub line: usize,
}

/// Reads what `Display` writes. Empty lines and lines that begin with `#` are passed over.
impl FromStr for TraceLog {
    type Err = TraceParseError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let mut log = Self::default();
        let mut lines = 0;
        let mut total = None;
        for (index, line) in text.lines().enumerate() {
            lines = index + 1;
            let wrong = TraceParseError { line: lines };
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let (name, hash) = line.split_once(' ').ok_or(wrong.clone())?;
            let hash = u64::from_str_radix(hash, 16).map_err(|_| wrong.clone())?;
            if total.is_some() {
                return Err(wrong);
            } else if name == "total" {
                total = Some(hash);
            } else {
                let second = name.parse().map_err(|_| wrong.clone())?;
                if log.current.is_some_and(|last| last >= second) {
                    return Err(wrong);
                }
                log.turn(SimTime::from_secs(second));
                log.current = Some(second);
                log.trace = Trace(hash);
            }
        }
        // The last mark is the total, or the file was cut.
        match total {
            Some(hash) if log.current.is_none() || hash == log.trace.hash() => {
                log.trace = Trace(hash);
                Ok(log)
            }
            _ => Err(TraceParseError { line: lines }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn log(words: &[(u64, u64)]) -> TraceLog {
        let mut log = TraceLog::default();
        for &(millis, word) in words {
            log.begin(SimTime::from_millis(millis));
            log.fold(word);
        }
        log
    }

    #[test]
    fn order_counts_and_zero_counts() {
        let hash = |words: &[u64]| {
            let mut trace = Trace::START;
            words.iter().for_each(|&w| trace.fold(w));
            trace.hash()
        };
        assert_ne!(hash(&[1, 2]), hash(&[2, 1]));
        assert_ne!(hash(&[]), hash(&[0]));
        assert_ne!(hash(&[0]), hash(&[0, 0]));
    }

    #[test]
    fn an_instant_on_the_second_belongs_to_the_second_it_begins() {
        let log = log(&[(0, 1), (999, 2), (1000, 3)]);
        let seconds: Vec<u64> = log.marks().map(|m| m.second).collect();
        assert_eq!(seconds, [0, 1]);
        assert_eq!(log.marks().last().unwrap().hash, log.total());
    }

    #[test]
    fn silent_seconds_take_no_room() {
        let log = log(&[(0, 1), (1_000_000_000_000, 2)]);
        assert_eq!(log.marks().count(), 2);
        let mut far = TraceLog::default();
        far.begin(SimTime::MAX);
        far.fold(1);
        far.begin(SimTime::MAX);
        assert!(far.marks().all(|m| m.second == SimTime::MAX.whole_secs()));
    }

    #[test]
    fn the_first_differing_second_is_named() {
        let one = log(&[(0, 1), (1500, 2), (2500, 3), (3500, 4)]);
        assert_eq!(
            one.first_difference(&log(&[(0, 1), (1500, 2), (2500, 9), (3500, 4)])),
            Some(2)
        );
        assert_eq!(one.first_difference(&log(&[(0, 1), (2500, 3)])), Some(1));
        assert_eq!(
            one.first_difference(&log(&[(0, 1), (1500, 2), (2500, 3)])),
            Some(3)
        );
        assert_eq!(one.first_difference(&one), None);
    }

    #[test]
    fn text_and_back() {
        for one in [TraceLog::default(), log(&[(0, 1), (1500, 2), (9500, 3)])] {
            let back: TraceLog = one.to_string().parse().unwrap();
            assert_eq!(back.to_string(), one.to_string());
            assert_eq!(one.first_difference(&back), None);
        }
    }

    #[test]
    fn a_cut_or_wrong_text_is_refused_with_its_line() {
        let line = |text: &str| text.parse::<TraceLog>().unwrap_err().line;
        assert_eq!(line("0 00"), 1);
        assert_eq!(line("# golden\n0 00\n1 xx\ntotal 00"), 3);
        assert_eq!(line("1 00\n0 00\ntotal 00"), 2);
        assert_eq!(line("0 01\ntotal 00"), 2);
        assert_eq!(line("0"), 1);
    }
}

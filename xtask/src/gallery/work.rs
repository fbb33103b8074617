//! The work of a gallery, piece by piece: what takes how long, what failed, what is left.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};

use super::{Piece, REST};
use crate::report::Report;

/// How much is known of earlier galleries: files in a folder of their own, below `target`.
pub(super) struct Work {
    /// Names of pictures that are to be made yet, a line each.
    left: PathBuf,
    /// How long pieces took, `seconds name` a line.
    times: PathBuf,
}

impl Work {
    pub(super) fn at(room: &Path) -> Self {
        Self {
            left: room.join("left.txt"),
            times: room.join("times.txt"),
        }
    }

    /// The pictures that the last gallery did not make.
    pub(super) fn rest(&self) -> Result<Vec<String>> {
        let text = std::fs::read_to_string(&self.left).unwrap_or_default();
        let names: Vec<String> = text.lines().map(str::to_owned).collect();
        ensure!(
            !names.is_empty(),
            "nothing is left of the last gallery: it is whole, or there was none"
        );
        Ok(names)
    }

    /// Makes all pieces, one after the other, whatever becomes of the others; tells of each how long it took.
    /// `make` says whether a piece could be made here.
    pub(super) fn through(
        &self,
        pieces: &[Piece<'_>],
        make: impl Fn(&Piece<'_>) -> Result<bool>,
    ) -> Result<Report> {
        let mut times = self.times();
        let known = |piece: &Piece<'_>| {
            let name = piece.names.first()?;
            Some(times.iter().find(|(other, _)| other == name)?.1)
        };
        let of_last: Vec<f64> = pieces.iter().filter_map(known).collect();
        if !of_last.is_empty() {
            let sum: f64 = of_last.iter().sum();
            println!(
                "   {} of {} pieces took {} the last time",
                of_last.len(),
                pieces.len(),
                spoken(sum)
            );
        }
        let mut left: Vec<&str> = pieces
            .iter()
            .flat_map(|p| &p.names)
            .map(String::as_str)
            .collect();
        self.keep(&left)?;
        let mut report = Report::default();
        let (mut failed, mut made, mut sum_s) = (Vec::new(), 0, 0.0);
        for (at, piece) in pieces.iter().enumerate() {
            let name = piece.names.join(", ");
            println!("   {} of {}: {name}", at + 1, pieces.len());
            #[expect(
                clippy::disallowed_methods,
                reason = "how long a picture takes is told, and is in no picture"
            )]
            let start = std::time::Instant::now();
            let done = make(piece);
            let took_s = start.elapsed().as_secs_f64();
            sum_s += took_s;
            match done {
                Ok(true) => {
                    println!(
                        "   {} of {}: done in {}",
                        at + 1,
                        pieces.len(),
                        spoken(took_s)
                    );
                    made += piece.names.len();
                    left.retain(|name| !piece.names.iter().any(|other| other == name));
                    self.keep(&left)?;
                    times.retain(|(name, _)| Some(name) != piece.names.first());
                    times.extend(piece.names.first().map(|name| (name.clone(), took_s)));
                    self.note(&times)?;
                }
                Ok(false) => println!("   {} of {}: not here", at + 1, pieces.len()),
                Err(error) => {
                    println!("   {} of {}: failed: {error:#}", at + 1, pieces.len());
                    report.faults.push(format!("{name}: {error:#}"));
                    failed.extend(piece.names.iter().map(String::as_str));
                }
            }
        }
        report.summary = format!("{made} pictures in {}, and their pages", spoken(sum_s));
        if !failed.is_empty() {
            let again = match failed.len() {
                1..=6 => failed.join(" "),
                _ => REST.to_owned(),
            };
            report.notes.push(format!(
                "{made} other pictures are made; when this is mended: cargo xtask gallery {again}"
            ));
        }
        Ok(report)
    }

    fn keep(&self, left: &[&str]) -> Result<()> {
        let mut text = left.join("\n");
        text.push('\n');
        std::fs::write(&self.left, text).with_context(|| self.left.display().to_string())
    }

    fn times(&self) -> Vec<(String, f64)> {
        let text = std::fs::read_to_string(&self.times).unwrap_or_default();
        let time = |line: &str| {
            let (seconds, name) = line.split_once(' ')?;
            Some((name.to_owned(), seconds.parse().ok()?))
        };
        text.lines().filter_map(time).collect()
    }

    fn note(&self, times: &[(String, f64)]) -> Result<()> {
        let mut text = String::new();
        for (name, seconds) in times {
            let _ = writeln!(text, "{seconds:.1} {name}");
        }
        std::fs::write(&self.times, text).with_context(|| self.times.display().to_string())
    }
}

/// A time as one says it.
fn spoken(seconds: f64) -> String {
    match seconds {
        s if s < 99.5 => format!("{s:.1} s"),
        s => format!("{:.1} min", s / 60.0),
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use anyhow::bail;

    use super::super::What;
    use super::*;

    fn piece(names: &[&str]) -> Piece<'static> {
        Piece {
            what: What::Plot,
            names: names.iter().map(|name| (*name).to_owned()).collect(),
        }
    }

    #[test]
    fn what_fails_is_told_and_left_and_costs_no_other_picture() {
        let room = tempfile::tempdir().expect("a folder");
        let work = Work::at(room.path());
        assert!(work.rest().is_err(), "there was none");
        let tried = RefCell::new(Vec::new());
        let make = |piece: &Piece<'_>| {
            tried.borrow_mut().push(piece.names[0].clone());
            match piece.names[0].as_str() {
                "bad" => bail!("it broke"),
                name => Ok(name != "page"),
            }
        };
        let pieces = [
            piece(&["one", "two"]),
            piece(&["bad"]),
            piece(&["page"]),
            piece(&["last"]),
        ];
        let report = work.through(&pieces, make).expect("it goes on");
        assert_eq!(*tried.borrow(), ["one", "bad", "page", "last"]);
        assert_eq!(report.faults, ["bad: it broke"]);
        assert!(report.summary.starts_with("3 pictures in "), "{report:?}");
        assert!(
            report.notes[0].ends_with("cargo xtask gallery bad"),
            "{report:?}"
        );
        assert_eq!(work.rest().expect("two"), ["bad", "page"]);
        let times: Vec<String> = work.times().into_iter().map(|(name, _)| name).collect();
        assert_eq!(times, ["one", "last"]);
    }

    #[test]
    fn a_gallery_that_is_broken_off_leaves_what_was_not_made() {
        let room = tempfile::tempdir().expect("a folder");
        let work = Work::at(room.path());
        let pieces = [piece(&["one"]), piece(&["two", "three"])];
        let broken = std::panic::catch_unwind(|| {
            work.through(&pieces, |piece| match piece.names[0].as_str() {
                "two" => panic!("the machine is switched off"),
                _ => Ok(true),
            })
        });
        assert!(broken.is_err());
        assert_eq!(work.rest().expect("two pictures"), ["two", "three"]);
    }

    #[test]
    fn times_are_spoken() {
        assert_eq!(
            [1.23, 99.0, 240.0].map(spoken),
            ["1.2 s", "99.0 s", "4.0 min"]
        );
    }
}

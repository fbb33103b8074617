//! The checks of this repository, behind `cargo xtask`.
//!
//! Each check is a small function that looks at the tree (or runs a program) and returns a
//! `report::Report`: one sentence of summary, notes worth reading, and faults. No check prints its own
//! verdict and none ends the program; `steps` decides what is run, in which order, and how it is told.
//! This crate depends on none of the workspace's crates, so that it builds while those do not.
//!
//! Reading order:
//!
//! 1. `steps`: the table of subcommands, `check`, the help text.
//! 2. `repo`: the tree as the checks see it.
//! 3. `arrows`: which crate may depend on which, with the reasons.
//! 4. `tidy`: habits that a machine can hold.
//! 5. [`trace`]: golden traces as text, and the comparison that names the first differing second. It is
//!    public and knows nothing of the rest: a test can use it with a run that it made in process.
//! 6. `golden`, `schema`, `new_project`: checks that run the `simbeeotic` program (`program`).
//! 7. `tools`: cargo's own: fmt, clippy, doc, test.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for people at a terminal"
)]

mod arrows;
mod figure;
mod gallery;
mod golden;
mod new_project;
mod page;
mod plots;
mod program;
mod repo;
mod report;
mod schema;
mod steps;
mod tidy;
mod tools;
pub mod trace;

pub use golden::from_summary;

/// Runs `cargo xtask` with the arguments after the program's name.
///
/// Success means that every check that was asked for held.
pub fn run(args: &[String]) -> std::process::ExitCode {
    steps::run(args)
}

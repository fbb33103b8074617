//! Cargo's own checks: format, lints, documentation, tests. Their output goes straight to the terminal.

use std::process::{Command, Stdio};

use anyhow::{Context, Result};

use crate::repo::Repo;
use crate::report::Report;

/// Every file is formatted.
pub(crate) fn fmt(repo: &Repo) -> Result<Report> {
    if let Some(missing) = missing(repo, "fmt", "rustfmt") {
        return Ok(missing);
    }
    let mut command = repo.cargo();
    command.args(["fmt", "--all", "--", "--check", "-l"]);
    run(
        &mut command,
        "the files above are not formatted: `cargo fmt --all`",
    )
}

/// Clippy has nothing to say, in any target.
pub(crate) fn clippy(repo: &Repo) -> Result<Report> {
    if let Some(missing) = missing(repo, "clippy", "clippy") {
        return Ok(missing);
    }
    let mut command = repo.cargo();
    command.args(["clippy", "--workspace", "--all-targets", "--quiet"]);
    command.args(["--", "-D", "warnings"]);
    run(&mut command, "clippy objects")
}

/// The documentation builds without a warning.
pub(crate) fn doc(repo: &Repo) -> Result<Report> {
    let mut flags = std::env::var("RUSTDOCFLAGS").unwrap_or_default();
    flags.push_str(" -D warnings");
    let mut command = repo.cargo();
    command.args(["doc", "--workspace", "--no-deps", "--quiet"]);
    command.env("RUSTDOCFLAGS", flags.trim());
    run(&mut command, "the documentation has faults")
}

/// All tests pass. `args` go to `cargo test --workspace`.
pub(crate) fn test(repo: &Repo, args: &[String]) -> Result<Report> {
    let mut command = repo.cargo();
    command.args(["test", "--workspace"]).args(args);
    run(&mut command, "tests fail")
}

fn run(command: &mut Command, fault: &str) -> Result<Report> {
    let status = command
        .stdin(Stdio::null())
        .status()
        .with_context(|| format!("cannot run {}", command.get_program().display()))?;
    Ok(if status.success() {
        Report::default()
    } else {
        Report::fault(fault)
    })
}

/// A report of a cargo command that is not installed; a bare toolchain has neither fmt nor clippy.
fn missing(repo: &Repo, subcommand: &str, component: &str) -> Option<Report> {
    let installed = repo
        .cargo()
        .args([subcommand, "--version"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success());
    (!installed).then(|| {
        Report::skipped(format!(
            "NOT CHECKED: cargo {subcommand} is not installed (`rustup component add {component}`)"
        ))
    })
}

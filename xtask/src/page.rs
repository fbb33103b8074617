//! The page: what is checked in is what its sources build, and it passes its tests in a real browser.
//!
//! Needs Node.js, npm and a Chromium; what it lacks is a fault here, not in `check`, which people without them run.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

use crate::program::{Profile, Program};
use crate::repo::Repo;
use crate::report::Report;

/// The page's own folder.
pub(crate) const FOLDER: &str = "crates/view/page";
/// What the program embeds, and the build writes.
const BUILT: [&str; 3] = ["dist/index.html", "dist/page.js", "dist/page.css"];
/// Where a Chromium is looked for, if `CHROMIUM` does not say.
const BROWSERS: [&str; 4] = [
    "/usr/bin/chromium",
    "/usr/bin/chromium-browser",
    "/usr/bin/google-chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
];

/// Installs what the page is built with, builds it, compares, and runs its tests.
pub(crate) fn check(repo: &Repo) -> Result<Report> {
    let browser = browser().context(
        "no Chromium found; install one (Debian: apt-get install chromium), or name it by CHROMIUM=PATH",
    )?;
    let read = || -> Result<Vec<Vec<u8>>> {
        let files = BUILT.iter().map(|file| repo.path(FOLDER).join(file));
        files
            .map(|file| std::fs::read(&file).with_context(|| file.display().to_string()))
            .collect()
    };
    install(repo)?;
    let before = read()?;
    npm(repo, &["run", "--silent", "check"], &[])?;
    npm(repo, &["run", "--silent", "build"], &[])?;
    let mut report = Report::of(format!(
        "{} files, and tests in {}",
        BUILT.len(),
        browser.display()
    ));
    for ((file, old), new) in BUILT.iter().zip(before).zip(read()?) {
        if old != new {
            report.faults.push(format!(
                "{FOLDER}/{file} is not what its sources build; it is now: look at it and commit it"
            ));
        }
    }
    let program = Program::build(repo, Profile::Dev)?;
    let variables = [("SIMBEEOTIC", program.binary()), ("CHROMIUM", &browser)];
    npm(repo, &["test", "--silent"], &variables)?;
    Ok(report)
}

/// The packages of the lock file.
pub(crate) fn install(repo: &Repo) -> Result<()> {
    npm(
        repo,
        &["ci", "--no-audit", "--no-fund", "--loglevel=error"],
        &[],
    )
}

/// The browser that tests and the gallery use.
pub(crate) fn browser() -> Option<PathBuf> {
    let named = std::env::var_os("CHROMIUM").map(PathBuf::from);
    let usual = BROWSERS.iter().map(PathBuf::from);
    named.into_iter().chain(usual).find(|path| path.is_file())
}

fn npm(repo: &Repo, args: &[&str], variables: &[(&str, &Path)]) -> Result<()> {
    run(
        Command::new("npm")
            .args(args)
            .envs(variables.iter().copied()),
        repo,
    )
}

/// Runs a command in the page's folder.
pub(crate) fn run(command: &mut Command, repo: &Repo) -> Result<()> {
    let status = command
        .current_dir(repo.path(FOLDER))
        .stdin(Stdio::null())
        .status()
        .with_context(|| {
            let name = command.get_program().to_string_lossy().into_owned();
            format!("cannot run {name}; the page needs Node.js 20 or newer and npm")
        })?;
    let words: Vec<_> = std::iter::once(command.get_program())
        .chain(command.get_args())
        .map(|word| word.to_string_lossy())
        .collect();
    ensure!(status.success(), "`{}` in {FOLDER} failed", words.join(" "));
    Ok(())
}

//! The `simbeeotic` program as the checks run it: started at the root.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail, ensure};

use crate::repo::Repo;

/// The built program.
pub(crate) struct Program<'a> {
    repo: &'a Repo,
    binary: PathBuf,
}

/// How the program is built.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Profile {
    /// As the tests build it: for what takes no time to run.
    Dev,
    /// For runs.
    Release,
}

impl Profile {
    fn name(self) -> &'static str {
        match self {
            Self::Dev => "dev",
            Self::Release => "release",
        }
    }

    fn folder(self) -> &'static str {
        match self {
            Self::Dev => "debug",
            Self::Release => "release",
        }
    }
}

impl<'a> Program<'a> {
    /// Builds the program. Costs nothing when it is fresh, and a stale program would compare
    /// yesterday's traces.
    pub(crate) fn build(repo: &'a Repo, profile: Profile) -> Result<Self> {
        Self::of(repo, profile, "simbeeotic")
    }

    /// Builds the program with the examples' parts on its shelf: the one of `cargo run`.
    pub(crate) fn with_examples(repo: &'a Repo, profile: Profile) -> Result<Self> {
        Self::of(repo, profile, "simbeeotic-examples")
    }

    /// Builds the program of a package, which is called as the package is.
    fn of(repo: &'a Repo, profile: Profile, name: &str) -> Result<Self> {
        println!("   building {name} ({})", profile.name());
        let status = repo
            .cargo()
            .args(["build", "--quiet", "--profile", profile.name()])
            .args(["--package", name, "--bin", name])
            .status()
            .context("cannot run cargo build")?;
        ensure!(status.success(), "the program does not build");

        let name = format!("{name}{}", std::env::consts::EXE_SUFFIX);
        let binary = repo.target_dir()?.join(profile.folder()).join(name);
        ensure!(binary.is_file(), "{} was not built", binary.display());
        Ok(Self { repo, binary })
    }

    /// Another program in its place, for the tests of checks that run it.
    #[cfg(test)]
    pub(crate) fn at(repo: &'a Repo, binary: PathBuf) -> Self {
        Self { repo, binary }
    }

    /// The file.
    pub(crate) fn binary(&self) -> &Path {
        &self.binary
    }

    /// The program with these arguments, to be started at the root.
    pub(crate) fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(&self.binary);
        command.args(args).current_dir(self.repo.root());
        command
    }

    /// Runs the program and returns what it printed; its complaint if it fails.
    pub(crate) fn stdout(&self, args: &[&str]) -> Result<String> {
        let output = self
            .command(args)
            .stdin(Stdio::null())
            .output()
            .with_context(|| format!("cannot run {}", self.binary.display()))?;
        if !output.status.success() {
            bail!(
                "`simbeeotic {}` failed ({}): {}",
                args.join(" "),
                output.status,
                String::from_utf8_lossy(&output.stderr).trim()
            );
        }
        String::from_utf8(output.stdout).context("the program printed something that is not UTF-8")
    }
}

//! The tree as the checks see it: the files that git knows or would add, and cargo's manifests.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};

/// A checkout of this repository.
#[derive(Clone, Debug)]
pub(crate) struct Repo {
    root: PathBuf,
}

/// One file of the tree.
#[derive(Clone, Debug)]
pub(crate) struct File {
    /// Path from the root, with `/` between its parts.
    pub(crate) path: String,
    /// Size in bytes.
    pub(crate) bytes: u64,
    /// Its text, if it is UTF-8 and small enough to be written by a person.
    pub(crate) text: Option<String>,
}

/// Files beyond this size are not read: they are blobs, and [`crate::tidy`] says so.
pub(crate) const BYTES_MAX: u64 = 1 << 20;

impl Repo {
    /// The checkout around the current directory.
    pub(crate) fn find() -> Result<Self> {
        let here = std::env::current_dir()?;
        let root = here
            .ancestors()
            .find(|dir| dir.join("Cargo.toml").is_file() && dir.join("xtask").is_dir())
            .context("run this inside a checkout of the repository")?;

        Ok(Self {
            root: root.to_path_buf(),
        })
    }

    /// A tree elsewhere, for tests.
    #[cfg(test)]
    pub(crate) fn at(root: &Path) -> Self {
        Self {
            root: root.to_path_buf(),
        }
    }

    /// Absolute path of the root.
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// Absolute path of a file or folder named from the root.
    pub(crate) fn path(&self, relative: &str) -> PathBuf {
        self.root.join(relative)
    }

    /// The text of a file named from the root.
    pub(crate) fn read(&self, relative: &str) -> Result<String> {
        std::fs::read_to_string(self.path(relative))
            .with_context(|| format!("cannot read {relative}"))
    }

    /// Every file that is tracked, or would be by `git add`, sorted by path.
    pub(crate) fn files(&self) -> Result<Vec<File>> {
        let listing = Command::new("git")
            .args([
                "ls-files",
                "-z",
                "--cached",
                "--others",
                "--exclude-standard",
            ])
            .current_dir(&self.root)
            .output()
            .context("cannot run git, which lists the files to check")?;
        ensure!(
            listing.status.success(),
            "git ls-files failed: {}",
            String::from_utf8_lossy(&listing.stderr).trim()
        );

        let names = String::from_utf8(listing.stdout).context("a file name is not UTF-8")?;
        let mut paths: Vec<&str> = names.split('\0').filter(|name| !name.is_empty()).collect();
        paths.sort_unstable();
        paths.dedup();

        let mut files = Vec::with_capacity(paths.len());
        for path in paths {
            // A tracked file may be deleted in the work tree; a link is checked where it points to.
            let Ok(meta) = std::fs::symlink_metadata(self.path(path)) else {
                continue;
            };
            if !meta.is_file() {
                continue;
            }
            let text = if meta.len() <= BYTES_MAX {
                String::from_utf8(std::fs::read(self.path(path))?).ok()
            } else {
                None
            };
            files.push(File {
                path: path.to_owned(),
                bytes: meta.len(),
                text,
            });
        }
        Ok(files)
    }

    /// The cargo that runs us, to be started at the root.
    pub(crate) fn cargo(&self) -> Command {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo"));
        let mut command = Command::new(cargo);
        command.current_dir(&self.root);
        // Set by the cargo that started us, for us: not for the crates we are going to build.
        for name in [
            "CARGO_MANIFEST_DIR",
            "CARGO_MANIFEST_PATH",
            "CARGO_PKG_NAME",
        ] {
            command.env_remove(name);
        }
        command
    }

    /// The folder that cargo builds into.
    pub(crate) fn target_dir(&self) -> Result<PathBuf> {
        let output = self
            .cargo()
            .args(["metadata", "--format-version", "1", "--no-deps", "--quiet"])
            .output()
            .context("cannot run cargo metadata")?;
        if !output.status.success() {
            bail!("{}", String::from_utf8_lossy(&output.stderr).trim());
        }
        let metadata: serde_json::Value = serde_json::from_slice(&output.stdout)?;
        let dir = metadata["target_directory"]
            .as_str()
            .context("cargo metadata names no target_directory")?;
        Ok(PathBuf::from(dir))
    }
}

//! Runs the real program in a folder of its own.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// The program with a folder to work in.
pub(crate) struct Program {
    folder: TempDir,
}

/// What one call came to.
pub(crate) struct Call {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Program {
    pub(crate) fn new() -> Self {
        Self {
            folder: tempfile::tempdir().expect("a folder for the test"),
        }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) -> &Self {
        std::fs::write(self.path(name), text).expect("the test's folder can be written");
        self
    }

    pub(crate) fn command(&self) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_simbeeotic"));
        command
            .current_dir(self.folder.path())
            .env("NO_COLOR", "1")
            .env_remove("RUST_BACKTRACE");
        command
    }

    pub(crate) fn call(&self, arguments: &[&str]) -> Call {
        Call::from(
            self.command()
                .args(arguments)
                .output()
                .expect("the program starts"),
        )
    }

    /// Starts the program, and sends Ctrl-C when a file has so many lines; no machine is so slow that it does not come
    /// to that.
    #[cfg(unix)]
    pub(crate) fn interrupted(&self, arguments: &[&str], file: &str, lines: usize) -> Call {
        use std::process::Stdio;
        use std::time::Duration;

        let mut command = self.command();
        command.args(arguments).stdout(Stdio::piped());
        let child = command.stderr(Stdio::piped()).spawn().expect("it starts");
        for _ in 0..6000 {
            let text = std::fs::read_to_string(self.path(file)).unwrap_or_default();
            if text.lines().count() >= lines {
                break;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        let id = child.id().to_string();
        let kill = Command::new("kill").args(["-INT", &id]).status();
        assert!(kill.expect("kill is there").success());
        Call::from(child.wait_with_output().expect("it ends"))
    }

    /// Runs a scenario and returns its summary.
    pub(crate) fn summary(&self, arguments: &[&str]) -> serde_json::Value {
        let call = self.call(&[&["run", "--quiet", "--json"], arguments].concat());
        assert_eq!(call.code, Some(0), "{}", call.err);
        serde_json::from_str(&call.out).expect("--json prints JSON and nothing else")
    }

    /// The trace hash of a run.
    pub(crate) fn trace(&self, arguments: &[&str]) -> String {
        self.summary(arguments)["trace_hash"]
            .as_str()
            .expect("a hash")
            .to_owned()
    }
}

impl From<Output> for Call {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            out: String::from_utf8_lossy(&output.stdout).into_owned(),
            err: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }
}

/// A file of the repository.
pub(crate) fn shipped(path: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
        .display()
        .to_string()
}

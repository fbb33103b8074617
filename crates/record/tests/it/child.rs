//! This test program, started once more, to be killed or starved.

use std::path::Path;
use std::process::{Child, Command, Stdio};

const FILE: &str = "SIMBEEOTIC_RECORD_TEST_FILE";

/// The file that a child shall write, if this is one.
pub(crate) fn file() -> Option<std::ffi::OsString> {
    std::env::var_os(FILE)
}

/// Starts `test` of this program alone in a process of its own, by a shell that runs `before`
/// first. Its output can be read from the child's pipe.
pub(crate) fn start(test: &str, path: &Path, before: &str) -> Child {
    let program = std::env::current_exe().expect("this program");
    Command::new("sh")
        .args(["-c", &format!("{before} exec \"$0\" \"$@\"")])
        .arg(program)
        .args(["--exact", test, "--nocapture"])
        .env(FILE, path)
        .stdout(Stdio::piped())
        .spawn()
        .expect("a child")
}

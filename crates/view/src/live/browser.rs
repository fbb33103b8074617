//! Starting the user's browser.

use std::process::{Command, Stdio};

/// Shows an address in the user's browser.
///
/// # Errors
/// Why it cannot, for people: no such program.
pub fn open_browser(url: &str) -> Result<(), String> {
    let (program, arguments): (&str, &[&str]) = match std::env::consts::OS {
        "macos" => ("open", &[]),
        "windows" => ("cmd", &["/C", "start", ""]),
        _ => ("xdg-open", &[]),
    };
    let child = Command::new(program)
        .args(arguments)
        .arg(url)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    match child {
        Ok(mut child) => {
            // Somebody must hear of its end.
            std::thread::spawn(move || child.wait());
            Ok(())
        }
        Err(e) => Err(format!("cannot start a browser by {program}: {e}")),
    }
}

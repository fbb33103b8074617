//! The program: `simbeeotic run`, `check`, `list`, `describe`, `schema`, `new`, `convert`,
//! `sweep`, `view`, `export`, `plot`, `render`, `world`, `bench`.
//!
//! A crate with parts of its own gets all of it by a `main` of one line:
//!
//! ```no_run
//! // use my_swarm as _;   // so that its parts are linked, and on the shelf
//! fn main() -> std::process::ExitCode {
//!     simbeeotic::program::main()
//! }
//! ```

mod arguments;
mod bench;
mod convert;
mod export;
mod help;
mod input;
mod journal;
mod log;
mod new;
mod outputs;
mod picture;
mod plot;
mod render;
mod render_arguments;
mod render_words;
mod run;
mod shelf;
mod show;
mod summary;
mod sweep;
mod table;
mod view;
mod world;

use arguments::{Arguments, Command};
use clap::FromArgMatches;
use std::fmt::Display;
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;

// A crate that nobody mentions is not linked, and its parts would be missing from the shelf.
use simbeeotic_models as _;

/// Runs the program on the process's arguments.
///
/// Exit codes: 0, all went well; 1, a run failed or output could not be written; 2, the input or
/// the arguments are wrong; 130, the run was interrupted.
pub fn main() -> ExitCode {
    let matches = help::command().get_matches();
    let arguments = Arguments::from_arg_matches(&matches)
        .unwrap_or_else(|e| e.format(&mut help::command()).exit());
    let result = match arguments.command {
        Command::Run(options) => run::run(options),
        Command::Check(options) => run::check(&options),
        Command::Sweep(options) => sweep::sweep(&options),
        Command::List { kind, json } => shelf::list(kind.as_deref(), json),
        Command::Describe { name, json } => shelf::describe(&name, json),
        Command::Schema => shelf::schema(),
        Command::New {
            name,
            path,
            library,
        } => new::new(&name, path.as_deref(), library.as_deref()),
        Command::Convert(options) => convert::convert(&options),
        Command::View(options) => view::view(&options),
        Command::Export(options) => export::export(&options),
        Command::Picture(options) => picture::picture(&options),
        Command::Plot(what) => plot::plot(&what),
        Command::Render(options) => render::render(&options),
        Command::World(options) => world::world(&options),
        Command::Bench(experiment) => bench::bench(&experiment),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            complain(&failure.message);
            ExitCode::from(failure.code)
        }
    }
}

/// Why the program ends with an error.
pub(crate) struct Failure {
    /// What the user sees; empty if it has been shown.
    message: String,
    code: u8,
}

impl Failure {
    /// The input or the arguments are wrong.
    fn input(message: impl Display) -> Self {
        Self {
            message: message.to_string(),
            code: 2,
        }
    }

    /// Something failed that was right to ask for.
    fn run(message: impl Display) -> Self {
        Self {
            message: message.to_string(),
            code: 1,
        }
    }

    /// The user ended the run, and has seen what came of it: 128 and the number of SIGINT.
    fn interrupted() -> Self {
        Self {
            message: String::new(),
            code: 130,
        }
    }

    /// Whether the user ended the run.
    fn is_interrupt(&self) -> bool {
        self.code == 130
    }
}

/// Prints on standard output. A reader that has gone away (`| head`) is no error.
fn say(text: impl Display) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(Failure::run(format!(
            "cannot write to standard output: {e}"
        ))),
        _ => Ok(()),
    }
}

/// Whether two paths lead to one file that is there, whatever they are called.
fn same_file(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// Prints on standard error, as an error unless it says already what it is.
fn complain(message: &str) {
    if message.is_empty() {
        return;
    }
    let mut out = std::io::stderr().lock();
    let _ = if message.starts_with("error") || message.contains("\nerror") {
        writeln!(out, "{message}")
    } else {
        writeln!(out, "error: {message}")
    };
}

/// Prints on standard error: what is worth knowing, and no result.
fn remark(text: impl Display) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Whether messages may be coloured.
fn colour() -> bool {
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none()
}

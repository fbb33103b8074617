//! The program: `simbeeotic run scenario.toml`.

use std::process::ExitCode;

fn main() -> ExitCode {
    simbeeotic::program::main()
}

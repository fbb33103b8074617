//! The whole Simbeeotic program, with the examples' parts on its shelf.

use std::process::ExitCode;
// A crate that nobody mentions is not linked, and its parts would be missing.
use simbeeotic_examples as _;

fn main() -> ExitCode {
    simbeeotic::program::main()
}

//! The shipped scenarios still do what they did: their traces are golden.
//!
//! `cargo xtask golden` compares a release build; this compares the build that is tested. So a
//! difference between debug and release shows too.

use crate::program::{Program, shipped};
use xtask::trace::Trace;

#[test]
fn golden_scenarios_do_what_they_did() {
    let mut compared = 0;
    for entry in std::fs::read_dir(shipped("scenarios")).expect("scenarios are shipped") {
        let path = entry.expect("it can be listed").path();
        if path.extension().is_none_or(|e| e != "trace") {
            continue;
        }
        let golden: Trace = std::fs::read_to_string(&path)
            .expect("it can be read")
            .parse()
            .expect("a trace");
        let scenario = path.with_extension("toml").display().to_string();
        let call = Program::new().call(&["run", &scenario, "--quiet", "--json", "--no-record"]);
        assert_eq!(call.code, Some(0), "{}", call.err);
        let run = xtask::from_summary(&scenario, &call.out).expect("a summary has a trace");
        if let Some(difference) = golden.difference(&run) {
            panic!("{scenario}: {difference}");
        }
        compared += 1;
    }
    assert!(
        compared >= 5,
        "five scenarios have golden traces, and {compared} were compared"
    );
}

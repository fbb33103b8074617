//! `simbeeotic sweep`: the same runs as one by one, in one table.

use crate::program::{Call, Program, shipped};

pub(crate) const BEES: &str = r#"
[run]
end_time = "2 s"
seed = 4

[[model]]
use = "random-walk-bee"
name = "bee"
count = 3
start = { box = ["4 m", "4 m", "2 m"] }

[sweep]
seeds = 2

[sweep.vary]
"model.bee.count" = [2, 5]
"model.bee.params.heading_sigma" = ["0.1 rad", "0.8 rad"]
"#;

pub(crate) fn program() -> Program {
    let program = Program::new();
    program.write("bees.toml", BEES);
    program
}

pub(crate) fn good(call: Call) -> Call {
    assert_eq!(call.code, Some(0), "{}", call.err);
    call
}

pub(crate) fn table(program: &Program, name: &str) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(program.path(name)).expect("a table");
    let row = |line: &str| line.split(',').map(str::to_owned).collect();
    text.lines().map(row).collect()
}

#[test]
fn each_row_is_the_run_that_its_values_give_alone() {
    let program = program();
    let call = good(program.call(&["sweep", "bees.toml"]));
    let rows = table(&program, "bees-runs.csv");
    assert_eq!(rows.len(), 9);
    assert_eq!(
        rows[0][..8],
        [
            "run",
            "seed",
            "model.bee.count",
            "model.bee.params.heading_sigma",
            "trace_hash",
            "ended",
            "error",
            "virtual_s"
        ]
    );
    let order: Vec<String> = rows[1..].iter().map(|row| row[..4].join(" ")).collect();
    assert_eq!(order[0], "1 4 2 0.1 rad");
    assert_eq!(order[1], "2 4 2 0.8 rad");
    assert_eq!(order[7], "8 5 5 0.8 rad");
    let alone = program.trace(&[
        "bees.toml",
        "--no-record",
        "--seed",
        "5",
        "--set",
        "model.bee.count=5",
        "--set",
        "model.bee.params.heading_sigma=0.8 rad",
    ]);
    assert_eq!(rows[8][4], alone);
    let mut hashes: Vec<&String> = rows[1..].iter().map(|row| &row[4]).collect();
    hashes.sort();
    hashes.dedup();
    assert_eq!(hashes.len(), 8, "no run is another");
    assert!(call.out.contains("model.bee.count"), "{}", call.out);
    assert!(call.out.contains("0.8 rad"), "{}", call.out);
}

#[test]
fn the_table_is_the_same_for_any_number_of_jobs() {
    let program = program();
    for jobs in ["1", "2"] {
        let name = format!("jobs-{jobs}.csv");
        good(program.call(&["sweep", "bees.toml", "--jobs", jobs, "-o", &name, "-q"]));
    }
    let read = |name| std::fs::read(program.path(name)).expect("a table");
    assert!(read("jobs-1.csv") == read("jobs-2.csv"));
}

#[test]
fn options_vary_what_the_file_does_not_and_replace_what_it_does() {
    let program = program();
    let call = good(program.call(&[
        "sweep",
        "bees.toml",
        "--seeds",
        "1..3",
        "--vary",
        "model.bee.count=1",
        "--vary",
        "run.end_time=1 s..2 s step 0.5 s",
        "--dry-run",
    ]));
    let lines: Vec<&str> = call.out.lines().collect();
    assert_eq!(lines.len(), 1 + 3 * 2 * 3);
    assert!(
        lines[0].starts_with("run  seed  model.bee.count"),
        "{}",
        call.out
    );
    assert!(
        lines[2].ends_with("0.1 rad                         1.5 s"),
        "{}",
        call.out
    );
    assert!(!program.path("bees-runs.csv").exists(), "nothing ran");
    let call = program.call(&["sweep", "bees.toml", "--vary", "model.bee.cuont=1"]);
    assert_eq!(call.code, Some(2));
    assert!(call.err.contains("did you mean `count`?"), "{}", call.err);
    let still = "[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"inert-bee\"\n";
    let call = program
        .write("still.toml", still)
        .call(&["sweep", "still.toml"]);
    assert_eq!(call.code, Some(2));
    assert!(
        call.err.contains("does not say what varies"),
        "{}",
        call.err
    );
}

#[test]
fn a_run_that_fails_has_a_row_and_the_others_go_on() {
    let program = program();
    // More events at one time than are allowed end a run; two bees need fewer than five do.
    let call = program.call(&["sweep", "bees.toml", "--set", "run.pending_events=4"]);
    assert_eq!(call.code, Some(1), "{}", call.err);
    assert!(
        call.err.contains("(seed 4, model.bee.count = 5, "),
        "{}",
        call.err
    );
    assert!(call.err.contains("4 of 8 runs failed"), "{}", call.err);
    let rows = table(&program, "bees-runs.csv");
    assert_eq!(rows.len(), 9);
    for row in &rows[1..] {
        assert_eq!(row[5] == "failed", row[2] == "5", "{row:?}");
        assert_eq!(row[6].is_empty(), row[2] == "2", "{row:?}");
    }
}

#[test]
fn recordings_are_made_for_each_run_and_change_nothing() {
    let program = program();
    good(program.call(&["sweep", "bees.toml", "-o", "a.csv", "-q"]));
    good(program.call(&[
        "sweep",
        "bees.toml",
        "-o",
        "b.csv",
        "-q",
        "--record",
        "runs",
    ]));
    let read = |name| std::fs::read(program.path(name)).expect("a table");
    assert!(read("a.csv") == read("b.csv"));
    for run in 1..=8 {
        assert!(
            program.path(&format!("runs/run-000{run}.mcap")).exists(),
            "{run}"
        );
    }
    let call = good(program.call(&["export", "runs/run-0008.mcap", "--csv"]));
    assert!(call.out.contains("bee-4"), "five bees in the last run");
}

#[test]
fn only_a_table_of_runs_is_written_over() {
    let program = program();
    program.write("mine.csv", "run,seed,of,my,own\n1,2,3,4,5\n");
    let call = program.call(&["sweep", "bees.toml", "-o", "mine.csv"]);
    assert_eq!(call.code, Some(2));
    assert!(call.err.contains("no table of runs"), "{}", call.err);
    let call = program.call(&["sweep", "bees.toml", "-o", "bees.toml"]);
    assert_eq!(call.code, Some(2));
    for name in ["a.csv", "a.json", "a.parquet"] {
        for _ in 0..2 {
            good(program.call(&["sweep", "bees.toml", "-o", name, "-q"]));
        }
    }
    let json = std::fs::read_to_string(program.path("a.json")).expect("a table");
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json[7]["model.bee.params.heading_sigma"], "0.8 rad");
    assert_eq!(json[7]["run"], 8);
}

#[test]
fn run_flies_what_stands_in_the_scenario_and_says_that_there_are_more() {
    let program = program();
    let call = good(program.call(&["run", "bees.toml", "--no-record"]));
    let line = "this scenario has a [sweep] of 8 runs, and flies here as it stands; all of them: simbeeotic sweep \
                bees.toml";
    assert!(call.err.lines().any(|l| l == line), "{}", call.err);
    // Three bees, and not two as in the first of the runs.
    let plain = &BEES[..BEES.find("[sweep]").expect("it has one")];
    program.write("plain.toml", plain);
    let plain = program.trace(&["plain.toml"]);
    assert_eq!(program.trace(&["bees.toml"]), plain);
    assert_ne!(
        program.trace(&["bees.toml", "--set", "model.bee.count=2"]),
        plain
    );
    // What stands nowhere else comes from the first run.
    let lacking = BEES.replace("end_time = \"2 s\"\n", "").replace(
        "[sweep.vary]",
        "[sweep.vary]\n\"run.end_time\" = [\"1 s\", \"2 s\"]",
    );
    program.write("lacking.toml", &lacking);
    let call = good(program.call(&["run", "lacking.toml", "--no-record"]));
    let line = "the first of 16 runs (seed 4, run.end_time = 1 s, model.bee.count = 2, \
                model.bee.params.heading_sigma = 0.1 rad); all of them: simbeeotic sweep lacking.toml";
    assert!(call.err.lines().any(|l| l == line), "{}", call.err);
}

#[test]
fn check_looks_at_all_values_of_a_sweep() {
    let program = program();
    let call = good(program.call(&["check", "bees.toml"]));
    let said = "8 runs in its sweep (4 combinations, 2 seeds)";
    assert!(call.out.contains(said), "{}", call.out);
    program.write("wrong.toml", &BEES.replace("\"0.8 rad\"", "\"0.8 m\""));
    let call = program.call(&["check", "wrong.toml"]);
    assert_eq!(call.code, Some(2));
    assert!(call.err.contains("wrong.toml:17:48"), "{}", call.err);
    good(program.call(&["run", "wrong.toml", "--no-record", "-q"]));
}

#[test]
fn a_table_is_named_after_its_scenario() {
    let program = Program::new();
    program.write("scenario.toml", &format!("name = \"two bees\"\n{BEES}"));
    let call = good(program.call(&["sweep", "scenario.toml", "--seeds", "1"]));
    assert!(call.err.contains("wrote two-bees-runs.csv"), "{}", call.err);
    assert_eq!(table(&program, "two-bees-runs.csv").len(), 5);
}

#[test]
fn a_table_that_cannot_be_written_is_found_before_the_first_run() {
    let program = program();
    std::fs::create_dir(program.path("a.csv")).expect("a folder");
    let call = program.call(&["sweep", "bees.toml", "-o", "a.csv", "--record", "runs"]);
    assert_eq!(call.code, Some(2), "{}", call.err);
    assert!(call.err.contains("this is a folder"), "{}", call.err);
    assert!(!program.path("runs").exists(), "nothing ran");
}

#[cfg(target_os = "linux")]
#[test]
fn a_table_that_could_not_be_written_in_the_end_is_not_lost() {
    let program = program();
    // A device that takes no byte, like a disk that is full by now.
    std::os::unix::fs::symlink("/dev/full", program.path("a.csv")).expect("a link");
    good(program.call(&["sweep", "bees.toml", "-o", "b.csv", "-q"]));
    let whole = std::fs::read_to_string(program.path("b.csv")).expect("a table");
    let sweep = |folder: &str| {
        let mut command = program.command();
        command.env("TMPDIR", program.path(folder));
        let output = command.args(["sweep", "bees.toml", "-o", "a.csv"]).output();
        Call::from(output.expect("it starts"))
    };
    std::fs::create_dir(program.path("kept")).expect("a folder");
    let call = sweep("kept");
    assert_eq!(call.code, Some(1), "{}", call.err);
    assert!(call.out.contains("mean ± half"), "{}", call.out);
    assert!(call.err.contains("the table is in"), "{}", call.err);
    let kept = std::fs::read_dir(program.path("kept")).expect("a folder");
    let kept: Vec<_> = kept.map(|file| file.expect("a file").path()).collect();
    assert_eq!(kept.len(), 1);
    assert!(std::fs::read_to_string(&kept[0]).expect("a table") == whole);

    let call = sweep("not-there");
    assert_eq!(call.code, Some(1), "{}", call.err);
    assert!(call.out.ends_with(&whole), "{}", call.out);
    assert!(
        call.err.contains("stands on standard output"),
        "{}",
        call.err
    );
}

#[test]
fn an_old_scenario_sweeps_as_it_looped() {
    let program = Program::new();
    let xml = std::fs::read_to_string(shipped("scenarios/figure12.xml")).expect("shipped");
    let looping = "<looping><variables><variable name=\"a\"><each><value>1</value><value>2</value></each>\
                   </variable></variables></looping></scenario>";
    program.write("old.xml", &xml.replace("</scenario>", looping));
    let call = good(program.call(&["sweep", "old.xml", "--dry-run"]));
    assert_eq!(call.out.lines().count(), 3, "{}", call.out);
    let call = good(program.call(&["convert", "old.xml"]));
    assert!(
        call.out.contains("[sweep.vary]\n\"variables.a\" = [1, 2]"),
        "{}",
        call.out
    );
}

#[test]
fn the_means_that_are_printed_are_those_asked_for() {
    let program = program();
    let arguments = [
        "sweep",
        "bees.toml",
        "--metric",
        "virtual_s",
        "--metric",
        "contact",
    ];
    let call = good(program.call(&arguments));
    let head = call.out.lines().next().expect("a table");
    assert!(
        head.contains("virtual_s") && !head.contains("contacts"),
        "{head}"
    );
    assert!(
        call.err.contains("did you mean `contacts`?"),
        "{}",
        call.err
    );
    // It is said while the other runs can still be stopped, too.
    let early = "note: --metric contact: the first run that is done does not have it";
    assert!(call.err.contains(early), "{}", call.err);
}

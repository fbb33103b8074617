//! The subcommands: one table, from which `check`, the help text and the dispatch all follow.

use std::process::ExitCode;
use std::time::Duration;

use anyhow::{Result, bail};

use crate::repo::Repo;
use crate::report::Report;
use crate::{arrows, figure, gallery, golden, new_project, page, schema, tidy, tools};

/// One check that can be asked for by name.
struct Step {
    name: &'static str,
    /// One line for the help text: what holds when it passes.
    holds: &'static str,
    /// When `check` runs it.
    order: Order,
    run: fn(&Repo, &Options) -> Result<Report>,
}

/// When `check` runs a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Order {
    /// All of these, whatever they find.
    First,
    /// One after the other, until one fails.
    Then,
    /// Only by name.
    Asked,
}

/// The checks in the order of `check`: the tests last, since their own summary is what one looks for.
const STEPS: &[Step] = &[
    Step {
        name: "arrows",
        holds: "each crate depends only on crates that it may see; ARCHITECTURE.md lists them all",
        order: Order::First,
        run: |repo, _| arrows::check(repo),
    },
    Step {
        name: "tidy",
        holds: "paths in the docs exist, files open with `//!`, no ignored tests, no blobs, ...",
        order: Order::First,
        run: |repo, _| tidy::check(repo),
    },
    Step {
        name: "fmt",
        holds: "every file is formatted",
        order: Order::First,
        run: |repo, _| tools::fmt(repo),
    },
    Step {
        name: "clippy",
        holds: "no warnings, in any target",
        order: Order::Then,
        run: |repo, _| tools::clippy(repo),
    },
    Step {
        name: "doc",
        holds: "the documentation builds without a warning",
        order: Order::Then,
        run: |repo, _| tools::doc(repo),
    },
    Step {
        name: "golden",
        holds: "each scenarios/*.trace equals a fresh run [--accept] [NAME ...]",
        order: Order::Then,
        run: |repo, options| golden::check(repo, &options.words, options.accept),
    },
    Step {
        name: "schema",
        holds: "scenarios/ and examples/scenario.schema.json are what the programs write [--accept]",
        order: Order::Then,
        run: |repo, options| schema::check(repo, options.accept),
    },
    Step {
        name: "gallery",
        holds: "the book's gallery is drawn anew: its page and its pictures [NAME ...] [rest]",
        order: Order::Asked,
        run: |repo, options| gallery::draw(repo, &options.words),
    },
    Step {
        name: "figure",
        holds: "the paper's Figures 9 and 10 are made anew, each with all its runs [9] [10]",
        order: Order::Asked,
        run: |repo, options| figure::draw(repo, &options.words),
    },
    Step {
        name: "page",
        holds: "the page is what its sources build, and passes its tests in a browser",
        order: Order::Asked,
        run: |repo, _| page::check(repo),
    },
    Step {
        name: "new-project",
        holds: "what `simbeeotic new` makes builds, passes its test and runs",
        order: Order::Asked,
        run: |repo, _| new_project::check(repo),
    },
    Step {
        name: "test",
        holds: "cargo test --workspace [arguments for cargo test]",
        order: Order::Then,
        run: |repo, options| tools::test(repo, &options.words),
    },
];

/// What follows the subcommand.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Options {
    /// `--accept`: rewrite what is stored instead of comparing with it.
    accept: bool,
    /// `--skip NAME`: steps that `check` leaves out.
    skip: Vec<String>,
    /// All else.
    words: Vec<String>,
}

/// The whole of `cargo xtask`.
pub(crate) fn run(args: &[String]) -> ExitCode {
    let Some((command, rest)) = args.split_first() else {
        print!("{}", help());
        return ExitCode::SUCCESS;
    };
    if ["--help", "-h", "help"].contains(&command.as_str())
        || rest
            .first()
            .is_some_and(|arg| arg == "--help" || arg == "-h")
    {
        print!("{}", help());
        return ExitCode::SUCCESS;
    }

    let outcome = parse(command, rest).and_then(|options| {
        let repo = Repo::find()?;
        if command == "check" {
            return Ok(check(&repo, &options));
        }
        let step = STEPS
            .iter()
            .find(|step| step.name == command)
            .expect("parse refuses unknown commands");
        let done = perform(step, &repo, &options);
        println!("{}", done.line());
        Ok(done.report.holds())
    });
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}

/// Sorts the arguments, and refuses those that the command does not take.
fn parse(command: &str, rest: &[String]) -> Result<Options> {
    let known = command == "check" || STEPS.iter().any(|step| step.name == command);
    if !known {
        bail!("there is no `{command}`; `cargo xtask --help` lists what there is");
    }
    let mut options = Options::default();
    let mut rest = rest.iter();
    while let Some(arg) = rest.next() {
        match arg.as_str() {
            "--accept" if ["golden", "schema"].contains(&command) => options.accept = true,
            "--skip" if command == "check" => {
                let Some(name) = rest.next() else {
                    bail!("--skip needs the name of a check");
                };
                if !STEPS.iter().any(|step| step.name == name) {
                    bail!("--skip: there is no `{name}`");
                }
                options.skip.push(name.clone());
            }
            _ if command == "test" => options.words.push(arg.clone()),
            word if ["golden", "gallery", "figure"].contains(&command)
                && !word.starts_with('-') =>
            {
                options.words.push(arg.clone())
            }
            _ => bail!("`{command}` does not take `{arg}`; see `cargo xtask --help`"),
        }
    }
    Ok(options)
}

/// A step that was run.
struct Done {
    name: &'static str,
    took: Duration,
    report: Report,
}

impl Done {
    /// Its line in the summary.
    fn line(&self) -> String {
        let verdict = self.report.verdict();
        let seconds = self.took.as_secs_f64();
        let summary = match (self.report.faults.len(), self.report.summary.as_str()) {
            (0, summary) => summary.to_owned(),
            (1, _) => "1 fault".to_owned(),
            (n, _) => format!("{n} faults"),
        };
        let line = format!("{verdict:<8}{:<12}{seconds:>7.1} s  {summary}", self.name);
        line.trim_end().to_owned()
    }
}

/// Runs one step and tells what it found.
fn perform(step: &Step, repo: &Repo, options: &Options) -> Done {
    println!("== {}", step.name);
    #[expect(
        clippy::disallowed_methods,
        reason = "how long a check takes is told, never compared"
    )]
    let start = std::time::Instant::now();
    let report =
        (step.run)(repo, options).unwrap_or_else(|error| Report::fault(format!("{error:#}")));
    let took = start.elapsed();

    for note in &report.notes {
        println!("   note: {note}");
    }
    for fault in &report.faults {
        println!("   fault: {fault}");
    }
    Done {
        name: step.name,
        took,
        report,
    }
}

/// Runs the cheap steps all, then the others until one fails, and prints the summary.
fn check(repo: &Repo, options: &Options) -> bool {
    let mut done: Vec<Done> = Vec::new();
    let mut not_run: Vec<&str> = Vec::new();
    for step in STEPS.iter().filter(|step| step.order != Order::Asked) {
        let failed = done.iter().any(|done| !done.report.holds());
        let stop = failed && step.order == Order::Then;
        if stop || options.skip.iter().any(|name| name == step.name) {
            not_run.push(step.name);
        } else {
            done.push(perform(step, repo, options));
        }
    }

    println!("== summary");
    for done in &done {
        println!("{}", done.line());
    }
    for name in not_run {
        println!("{:<8}{name}", "not run");
    }
    done.iter().all(|done| done.report.holds())
}

fn help() -> String {
    let mut text = String::from(
        "The checks of this repository.\n\
         \n\
         Usage: cargo xtask check [--skip NAME]...   all checks below but new-project\n\
         \x20      cargo xtask NAME [arguments]         one of them\n\
         \n\
         `check` reports all of arrows, tidy and fmt, then goes on until the first that fails.\n\
         The exit code is 0 if everything held, 1 if not, 2 if the command was not understood.\n\
         \n",
    );
    for step in STEPS {
        text.push_str(&format!("  {:<12} {}\n", step.name, step.holds));
    }
    text.push_str(
        "\n\
         After a wanted change of results:  cargo xtask golden --accept   and say why in the commit\n\
         For a scenario's first trace:      cargo xtask golden --accept NAME\n\
         After a change of parameters:      cargo xtask schema --accept\n\
         Everything, in a clean clone:      .ci/run\n",
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<String> {
        text.split_whitespace().map(str::to_owned).collect()
    }

    #[test]
    fn the_help_names_every_step() {
        let help = help();
        for step in STEPS {
            assert!(
                help.contains(&format!("\n  {:<12} ", step.name)),
                "{}",
                step.name
            );
        }
    }

    #[test]
    fn cheap_steps_come_before_the_others_and_tests_last() {
        let first = STEPS.iter().rposition(|step| step.order == Order::First);
        let then = STEPS.iter().position(|step| step.order == Order::Then);
        assert!(first < then);
        assert_eq!(STEPS.last().map(|step| step.name), Some("test"));
    }

    #[test]
    fn arguments_that_a_step_does_not_take_are_refused() {
        assert!(parse("golden", &words("--accept fig12")).unwrap().accept);
        assert_eq!(parse("figure", &words("10")).unwrap().words, ["10"]);
        assert_eq!(
            parse("check", &words("--skip test")).unwrap().skip,
            ["test"]
        );
        assert_eq!(
            parse("test", &words("-p xtask -- --nocapture"))
                .unwrap()
                .words
                .len(),
            4
        );
        for (command, rest) in [
            ("chekc", ""),
            ("arrows", "--accept"),
            ("check", "--skip"),
            ("check", "--skip nothing"),
            ("golden", "--acept"),
        ] {
            assert!(parse(command, &words(rest)).is_err(), "{command} {rest}");
        }
    }

    #[test]
    fn a_step_that_could_not_run_is_told_loudly() {
        let done = Done {
            name: "fmt",
            took: Duration::ZERO,
            report: Report::skipped("not installed"),
        };
        assert_eq!(done.line(), "SKIPPED fmt             0.0 s  not installed");
    }
}

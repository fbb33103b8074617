//! `simbeeotic plot sweep`: pictures of a table of runs.

use crate::program::Program;
use crate::sweep::good;

/// Four runs at each place, of two sizes; a fifth that failed.
const RUNS: &str = "\
run,seed,n,far,trace_hash,ended,error,virtual_s,spread [m],near [m],loss
1,1,5,10 m,a,end time,,1,1.0,0.5,0.1
2,1,5,20 m,b,end time,,1,2.0,0.5,0.2
3,2,5,10 m,c,end time,,1,3.0,0.6,0.1
4,2,5,20 m,d,end time,,1,4.0,0.6,0.3
5,1,9,10 m,e,end time,,1,6.0,0.7,0.1
6,1,9,20 m,f,end time,,1,7.0,0.7,0.2
7,2,9,10 m,g,end time,,1,8.0,0.8,0.1
8,2,9,20 m,h,failed,it fell,0,,,
";

#[test]
fn a_picture_of_a_sweep_has_its_axes_its_keys_and_says_what_it_is_of() {
    let program = Program::new();
    program.write("runs.csv", RUNS);
    let plot = [
        "plot", "sweep", "runs.csv", "-o", "a.svg", "--x", "far", "--metric", "spread",
    ];
    let svg = |more: &[&str]| {
        good(program.call(&[&plot, more].concat()));
        std::fs::read_to_string(program.path("a.svg")).expect("a picture")
    };
    let alone = svg(&[]);
    for words in [
        ">far, m</text>",
        ">spread, m</text>",
        // No spread is below zero.
        "7 runs; 2 seeds at each place, averaged over n: mean, and where it is with 95 % confidence, cut at 0; dots: the runs; 1 failed and are left out",
    ] {
        assert!(alone.contains(words), "{words} in {alone}");
    }
    assert!(!alone.contains("n = 5"));
    let split = svg(&["--by", "n"]);
    assert!(split.contains(">n = 5</text>") && split.contains(">n = 9</text>"));
    let two = svg(&["--metric", "near", "--metric", "loss"]);
    for words in [
        ">spread, near, m</text>",
        ">loss</text>",
        ">near</text>",
        ">spread</text>",
    ] {
        assert!(two.contains(words), "{words} in {two}");
    }
    // Words: bars.
    program.write("runs.csv", &RUNS.replace("20 m", "open field"));
    let words = svg(&[]);
    assert!(words.contains(">open field</text>") && words.contains(">10 m</text>"));
    let png = [
        "plot", "sweep", "runs.csv", "-o", "a.png", "--x", "seed", "--metric", "loss",
    ];
    good(program.call(&png));
}

#[test]
fn what_a_table_does_not_have_is_guessed() {
    let program = Program::new();
    program.write("runs.csv", RUNS);
    for (arguments, word) in [
        (["--x", "fra", "--metric", "spread"], "did you mean `far`?"),
        (
            ["--x", "far", "--metric", "spreed"],
            "did you mean `spread`?",
        ),
        (
            ["--x", "trace_hash", "--metric", "loss"],
            "it has seed, n, far",
        ),
        (["--x", "far", "--metric", "error"], "has no such number"),
    ] {
        let plot = ["plot", "sweep", "runs.csv", "-o", "a.svg"];
        let call = program.call(&[plot.as_slice(), arguments.as_slice()].concat());
        assert_eq!(call.code, Some(2), "{}", call.err);
        assert!(call.err.contains(word), "{word}: {}", call.err);
    }
    let plot = [
        "plot",
        "sweep",
        "nothing.csv",
        "-o",
        "a.svg",
        "--x",
        "n",
        "--metric",
        "loss",
    ];
    assert_eq!(program.call(&plot).code, Some(2));
}

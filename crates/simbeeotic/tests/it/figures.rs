//! The paper's experiments: tables, limits, files, and what they say to arguments that are wrong. How fast
//! anything is, no test asks.

use crate::program::{Call, Program};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use serde_json::Value;
use std::fs::File;

/// Where the time of a row goes.
const SHARES: [&str; 7] = [
    "start_s",
    "events_s",
    "physics_s",
    "radio_s",
    "other_s",
    "wall_s",
    "speed",
];

fn bench(program: &Program, arguments: &[&str]) -> Call {
    let call = program.call(&[&["bench"], arguments].concat());
    assert_eq!(call.code, Some(0), "{arguments:?}: {}", call.err);
    call
}

/// The answer in JSON, without limits and files.
fn answer(program: &Program, arguments: &[&str]) -> Value {
    let rest = ["--no-limit", "--no-files", "--json"];
    let call = bench(program, &[arguments, &rest].concat());
    serde_json::from_str(&call.out).expect("JSON")
}

fn rows(answer: &Value) -> &[Value] {
    answer["rows"].as_array().expect("rows")
}

#[test]
fn figure_7_is_told_by_swarm_and_threads() {
    let program = Program::new();
    let sizes = ["fig7", "--n", "100,50", "--duration", "1 s"];
    let answer = answer(
        &program,
        &[&sizes[..], &["--threads", "1,2", "--repeat", "2"]].concat(),
    );
    assert_eq!(
        (&answer["figure"], &answer["paper"]["limit"]),
        (&"fig7".into(), &3_074.into())
    );
    let rows = rows(&answer);
    assert_eq!(rows.len(), 4);
    for (row, (n, threads)) in rows.iter().zip([(50, 1), (50, 2), (100, 1), (100, 2)]) {
        assert_eq!((&row["n"], &row["threads"]), (&n.into(), &threads.into()));
        for key in SHARES {
            assert!(row[key].as_f64().is_some_and(|x| x >= 0.0), "{key}: {row}");
        }
        // 11 control steps, 2 readings, a start and an end.
        assert_eq!(row["events"], n * 15, "{row}");
        let walls = row["wall_s_of_runs"].as_array().expect("all runs");
        assert_eq!((walls.len(), &row["repeats"]), (2, &2.into()));
        assert!(walls.contains(&row["wall_s"]), "{row}");
    }
    assert_eq!(rows[0]["trace_hash"], rows[1]["trace_hash"]);
    assert_ne!(rows[0]["trace_hash"], rows[2]["trace_hash"]);
    assert!(!program.path("out").exists(), "no files are asked for");
}

#[test]
fn figure_8_is_told_by_swarm_and_threads() {
    let program = Program::new();
    for (start, least) in [("paper", 0.95), ("density", 0.1)] {
        let swarm = ["fig8", "--n", "60", "--duration", "2 s", "--threads", "1,2"];
        let rest = ["--start", start, "--repeat", "1"];
        let answer = answer(&program, &[&swarm[..], &rest].concat());
        let rows = rows(&answer);
        assert_eq!(rows.len(), 2);
        for row in rows {
            assert!(SHARES.iter().all(|key| row[key].is_number()), "{row}");
            // At 0 s, 1 s and 2 s.
            assert_eq!(row["sent"], 3 * 60, "{row}");
            let number = |key: &str| row[key].as_f64().expect(key);
            let pairs = number("sent") * 59.0;
            assert!((number("delivered") - number("received") / pairs).abs() < 1e-12);
            assert!((least..1.0).contains(&number("delivered")), "{row}");
            assert!((number("received_per_s") - 0.5 * number("received")).abs() < 1e-9);
        }
        assert_eq!(rows[0]["trace_hash"], rows[1]["trace_hash"]);
        assert_eq!(rows[0]["received"], rows[1]["received"]);
    }
    let shared = [
        "fig8",
        "--n",
        "60",
        "--duration",
        "2 s",
        "--medium",
        "ieee802154",
    ];
    let answer = answer(&program, &[&shared[..], &["--repeat", "1"]].concat());
    assert_eq!(rows(&answer)[0]["medium"], "ieee802154");
}

#[test]
fn figure_6_is_told_by_obstacles_in_and_out_of_reach() {
    let program = Program::new();
    let field = [
        "fig6",
        "--obstacles",
        "10,300",
        "--duration",
        "1 s",
        "--repeat",
        "1",
    ];
    for (reach, lines) in [
        ("out", &["out"][..]),
        ("in", &["in"]),
        ("in,out", &["in", "out"]),
    ] {
        let answer = answer(&program, &[&field[..], &["--reach", reach]].concat());
        let rows = rows(&answer);
        let told: Vec<_> = rows
            .iter()
            .map(|row| (row["obstacles"].as_u64(), row["reach"].as_str()))
            .collect();
        let expected: Vec<_> = [0, 10, 300]
            .into_iter()
            .flat_map(|n| lines.iter().map(move |line| (Some(n), Some(*line))))
            .collect();
        assert_eq!(told, expected);
        for row in rows {
            assert!(SHARES.iter().all(|key| row[key].is_number()), "{row}");
            assert_eq!(row["events"], 32 * 15, "{row}");
            if row["obstacles"] == 0 {
                assert_eq!(row["physics_ratio"], 1.0);
            }
        }
    }
}

/// The lines of a CSV file, their fields by the names of the first line.
fn table(text: &str) -> Vec<Vec<(String, String)>> {
    let split = |line: &str| -> Vec<String> {
        let (mut fields, mut quoted) = (vec![String::new()], false);
        for letter in line.chars() {
            match letter {
                '"' => quoted = !quoted,
                ',' if !quoted => fields.push(String::new()),
                letter => fields.last_mut().expect("a field").push(letter),
            }
        }
        fields
    };
    let mut lines = text.lines();
    let names = split(lines.next().expect("a head"));
    let row = |line| names.iter().cloned().zip(split(line)).collect();
    lines.map(row).collect()
}

/// A field as the CSV has it.
fn words(field: &Field) -> String {
    match field {
        Field::Double(x) if x.is_nan() => String::new(),
        Field::Double(x) => x.to_string(),
        Field::Str(text) => text.clone(),
        other => panic!("a column of {other:?}"),
    }
}

#[test]
fn the_table_is_the_same_as_csv_and_as_parquet_with_the_paper_in_rows_of_its_own() {
    let program = Program::new();
    let swarms = [
        "fig7",
        "--n",
        "10,20",
        "--duration",
        "0.5 s",
        "--repeat",
        "2",
    ];
    // No time for any probe: the limit says what the table knows.
    let rest = [
        "--within",
        "1 ms",
        "--clock",
        "processor",
        "-o",
        "figures/seven",
    ];
    let call = bench(&program, &[&swarms[..], &rest].concat());
    assert!(call.out.contains("\nlimit: "), "{}", call.out);

    let text = std::fs::read_to_string(program.path("figures/seven/fig7.csv")).expect("CSV");
    let rows = table(&text);
    let get = |row: &[(String, String)], name: &str| {
        let found = row.iter().find(|(column, _)| column == name);
        found
            .unwrap_or_else(|| panic!("{name} in {row:?}"))
            .1
            .clone()
    };
    let kinds: Vec<_> = rows
        .iter()
        .map(|row| {
            ["source", "kind", "bees", "repeat"]
                .map(|name| get(row, name))
                .join(" ")
        })
        .collect();
    let [first, .., limit, paper, goal] = &kinds[..] else {
        panic!("{kinds:?}")
    };
    assert_eq!(kinds.len(), 7, "{kinds:?}");
    assert_eq!(goal, "paper goal 1000 ");
    assert_eq!(
        (first.as_str(), paper.as_str()),
        ("measured row 10 1", "paper limit 3074 ")
    );
    assert!(limit.starts_with("measured limit"), "{limit}");
    assert_eq!(get(&rows[4], "clock"), "processor time");
    // No time for a probe: a bound is known, and the note says that it is one.
    let [n, low] = ["bees", "limit_low"].map(|name| get(&rows[4], name));
    assert_eq!((n.as_str(), low.as_str()), ("20", "20"));
    assert!(get(&rows[4], "note").contains("above 20"));
    for row in &rows[..4] {
        let number = |name: &str| get(row, name).parse::<f64>().expect(name);
        // The start once, and the rest as often as it fits.
        let rest_s = number("wall_s") - number("start_s");
        let stretched_s = number("start_s") + rest_s * 100.0 / number("virtual_s");
        assert!(number("start_s") > 0.0 && rest_s > 0.0);
        assert!((number("wall_s_per_100s") / stretched_s - 1.0).abs() < 1e-9);
        assert!((number("ratio") / stretched_s * 100.0 - 1.0).abs() < 1e-9);
        assert_eq!((number("seed"), number("duration_s")), (111_982.0, 0.5));
        assert!(
            get(row, "command").contains("bench fig7 --n 10,20 --duration '0.5 s'"),
            "{}",
            get(row, "command")
        );
        assert!(number("cores") >= 1.0 && get(row, "version").contains("simbeeotic"));
        assert_eq!(
            get(row, "trace_hash").len(),
            get(&rows[0], "trace_hash").len()
        );
    }
    let paper = &rows[5];
    assert_eq!(
        ["virtual_s", "wall_s", "ratio"].map(|name| get(paper, name)),
        ["100", "100", "1"]
    );
    assert!(get(paper, "cpu").contains("2.2 GHz"));
    assert!(get(paper, "note").contains("section 5.1"));

    let file = File::open(program.path("figures/seven/fig7.parquet")).expect("Parquet");
    let reader = SerializedFileReader::new(file).expect("Parquet");
    let others: Vec<Vec<(String, String)>> = reader
        .get_row_iter(None)
        .expect("rows")
        .map(|row| {
            let row = row.expect("readable");
            let fields = row.get_column_iter();
            fields
                .map(|(name, field)| (name.clone(), words(field)))
                .collect()
        })
        .collect();
    assert_eq!(rows, others);
}

#[test]
fn the_plot_has_dashed_limits_and_both_sources() {
    let program = Program::new();
    let tiny = ["--duration", "0.2 s", "--repeat", "1", "--within", "1 ms"];
    for (figure, sizes, paper) in [
        (
            "fig6",
            ["--obstacles", "10"],
            "Paper (IPSN 2012, section 5.1",
        ),
        ("fig7", ["--n", "5,20"], "paper: 3,074"),
        ("fig8", ["--n", "5,20"], "paper: 550"),
    ] {
        let call = bench(&program, &[&[figure], &sizes[..], &tiny].concat());
        for ending in [".csv", ".parquet", ".svg", ".png", "-log.svg", "-log.png"] {
            let file = format!("out/{figure}/{figure}{ending}");
            assert!(call.err.contains(&format!("wrote {file}")), "{}", call.err);
            assert!(program.path(&file).exists(), "{file}");
        }
        // Logarithmic axes have the level of real time in any case.
        let picture = format!("out/{figure}/{figure}-log.svg");
        let svg = std::fs::read_to_string(program.path(&picture)).expect("SVG");
        assert!(svg.contains("stroke-dasharray"), "{figure}");
        for words in [
            paper,
            "soft real time ends",
            ">all",
            "wall time for 100 virtual seconds",
        ] {
            assert!(svg.contains(words), "{figure}: {words}");
        }
        let png = std::fs::read(program.path(&format!("out/{figure}/{figure}.png")));
        assert!(png.expect("PNG").starts_with(b"\x89PNG"));
    }
}

#[test]
fn arguments_that_make_no_sense_are_refused_in_our_own_words() {
    let program = Program::new();
    program.write("file", "");
    for (arguments, words) in [
        (&["fig6", "--spacing", "0 m"][..], "--spacing"),
        (&["fig6", "--obstacles", "-1"], "between 0 and 10000000"),
        (&["fig6", "--reach", "near"], "out, in"),
        (&["fig7", "--n", "0"], "one bee or more"),
        (&["fig7", "--repeat", "0"], "between 1 and 1000 times"),
        (
            &["fig7", "--within", "0 s"],
            "--within 0 s: it must be more than zero",
        ),
        (&["fig7", "--duration", "5"], "--duration"),
        (&["fig7", "--threads", "0"], "between 1 and 4096"),
        (
            &["fig7", "--clock", "sun"],
            "[possible values: wall, processor]",
        ),
        (&["fig8", "--medium", "ether"], "simple, ieee802154"),
        (&["fig8", "--no-files", "-o", "here"], "cannot be used with"),
        (&["fig8", "--alone", "1:5"], "there are 1 lines"),
        (&["fig8", "--alone", "x"], "LINE:SIZE"),
        (
            &["fig7", "-o", "file"],
            "--output file: this is a file, and a folder is wanted",
        ),
        (&["fig7", "--resume", "--restart"], "cannot be used with"),
        (&["fig7", "--resume", "--no-files"], "cannot be used with"),
    ] {
        let call = program.call(&[&["bench"], arguments].concat());
        assert_eq!(call.code, Some(2), "{arguments:?}: {}", call.err);
        assert!(call.err.contains(words), "{arguments:?}: {}", call.err);
    }
    let quick = [
        "fig7",
        "--n",
        "1",
        "--duration",
        "1 ms",
        "--no-limit",
        "--repeat",
        "1",
    ];
    let call = program.call(&[&["bench"], &quick[..], &["-o", "file/here"]].concat());
    assert_eq!(call.code, Some(1), "{}", call.err);
    assert!(call.err.contains("cannot make file/here"), "{}", call.err);
}

#[test]
fn a_run_by_itself_is_the_run_of_the_table() {
    let program = Program::new();
    let swarm = ["fig7", "--n", "7", "--duration", "1 s", "--repeat", "1"];
    let told = answer(&program, &swarm);
    let call = bench(&program, &[&swarm[..], &["--alone", "0:7"]].concat());
    let run: Value = serde_json::from_str(&call.out).expect("JSON");
    assert_eq!(run["cost"]["trace_hash"], rows(&told)[0]["trace_hash"]);
    assert_eq!(run["cost"]["virtual_s"], 1.0);
    // A run that may take no time at all ends before its end.
    let call = bench(&program, &[&swarm[..], &["--alone", "0:7:0"]].concat());
    let run: Value = serde_json::from_str(&call.out).expect("JSON");
    assert!(
        run["cost"]["virtual_s"].as_f64().is_some_and(|t| t < 1.0),
        "{run}"
    );
}

#[test]
fn what_is_asked_for_twice_is_measured_once() {
    let program = Program::new();
    let tiny = ["--duration", "0.2 s", "--repeat", "1"];
    let swarm = ["fig7", "--n", "5,5", "--threads", "2,1,2"];
    let answer = |arguments: &[&str]| answer(&program, &[arguments, &tiny].concat());
    let threads = |answer: &Value| -> Vec<Value> {
        let rows = rows(answer).iter();
        rows.map(|row| row["threads"].clone()).collect()
    };
    assert_eq!(threads(&answer(&swarm)), [2, 1]);
    let field = ["fig6", "--obstacles", "3", "--reach", "in,in"];
    assert_eq!(rows(&answer(&field)).len(), 2);
}

#[cfg(unix)]
#[test]
fn a_bench_that_was_interrupted_keeps_what_it_measured_and_goes_on() {
    let program = Program::new();
    let tiny = [
        "bench",
        "fig7",
        "--n",
        "3,4",
        "--duration",
        "0.2 s",
        "--no-limit",
    ];
    let call = |more: &[&str]| program.call(&[&tiny, more].concat());
    // Bees and wall time of each run, to six digits.
    let measured = || -> Vec<(String, String)> {
        let text = std::fs::read_to_string(program.path("out/fig7/fig7.csv")).expect("CSV");
        let rows = table(&text).into_iter();
        let get = |row: &[(String, String)], name: &str| {
            let found = row.iter().find(|(column, _)| column == name);
            found.expect(name).1.clone()
        };
        let runs = rows.filter(|row| get(row, "kind") == "row" && get(row, "source") == "measured");
        let told = |row: Vec<_>| {
            let wall_s: f64 = get(&row, "wall_s").parse().expect("a time");
            (get(&row, "bees"), format!("{wall_s:.6e}"))
        };
        runs.map(told).collect()
    };
    let unfinished = "out/fig7/fig7.csv.unfinished";
    // A thousand rounds: nobody waits for their end.
    let all = [&tiny[..], &["--repeat", "1000"]].concat();
    let broken = program.interrupted(&all, unfinished, 4);
    assert_eq!(broken.code, Some(130), "{}", broken.err);
    assert!(
        broken
            .err
            .contains("; the same command with --resume goes on"),
        "{}",
        broken.err
    );
    for ending in [".csv", ".parquet", ".svg", "-log.png"] {
        let file = program.path(&format!("out/fig7/fig7{ending}"));
        assert!(file.exists(), "{ending}");
    }
    let svg = std::fs::read_to_string(program.path("out/fig7/fig7.svg")).expect("SVG");
    assert!(svg.contains("Broken off before its end"));
    let before = measured();
    assert!(before.len() >= 3, "{before:?}");
    assert!(
        broken
            .err
            .contains(&format!("interrupted after {} runs", before.len())),
        "{}",
        broken.err
    );

    // What took its time is not thrown away by a command that forgets it, nor mixed with what is something else.
    let forgets = call(&["--repeat", "1"]);
    assert_eq!(forgets.code, Some(2), "{}", forgets.err);
    assert!(
        forgets.err.contains("of a bench that is not whole"),
        "{}",
        forgets.err
    );
    let other = call(&["--no-contacts", "--resume"]);
    assert_eq!(other.code, Some(2), "{}", other.err);
    assert!(
        other.err.contains("--contacts was on, and is off"),
        "{}",
        other.err
    );
    let without = call(&["--threads", "2", "--resume"]);
    assert!(
        without.err.contains("has runs of `1 thread`"),
        "{}",
        without.err
    );

    // With two runs of each row, and one size more.
    let resumed = call(&["--n", "5", "--repeat", "2", "--resume"]);
    assert_eq!(resumed.code, Some(0), "{}", resumed.err);
    let after = measured();
    assert!(before.iter().all(|run| after.contains(run)), "{after:?}");
    assert_eq!(after.iter().filter(|(bees, _)| bees == "5").count(), 2);
    assert!(!program.path(unfinished).exists(), "it is whole");
    let again = call(&["--repeat", "1", "--resume"]);
    assert_eq!(again.code, Some(0), "{}", again.err);
    assert!(
        again.err.contains("there is nothing to go on with"),
        "{}",
        again.err
    );
}

//! Maps of a whole sweep, and what is said of recordings that do not fit each other.

use crate::plot_runs::{drawn, lines, record};
use crate::program::Program;

/// Three runs in a folder: the bees of the later ones publish more, and fly longer.
fn folder(program: &Program) {
    std::fs::create_dir(program.path("runs")).expect("a folder");
    for seed in 1..=3 {
        record(program, &format!("runs/{seed}.mcap"), seed, 8 + seed, 1.0);
    }
    program.write("runs/notes.txt", "no recording");
}

fn words(program: &Program, arguments: &[&str]) -> Vec<String> {
    crate::plot::words(&drawn(program, arguments))
}

fn refused(program: &Program, arguments: &[&str], told: &str) {
    let call = program.call(&[&["plot"], arguments].concat());
    assert_eq!(call.code, Some(2), "{arguments:?}: {}", call.err);
    assert!(call.err.contains(told), "{told} is not in:\n{}", call.err);
    assert!(!call.err.contains("panicked"), "{}", call.err);
}

#[test]
fn a_folder_stands_for_its_recordings() {
    let program = Program::new();
    folder(&program);
    let metric = ["series", "runs", "-o", "x.svg", "--metric", "load"];
    let words = words(&program, &metric);
    assert!(words[1].contains("3 runs, seeds 1 to 3"), "{}", words[1]);
    std::fs::create_dir(program.path("none")).expect("a folder");
    let none = ["series", "none", "-o", "x.svg", "--metric", "load"];
    refused(&program, &none, "there is no recording in this folder");
}

#[test]
fn flights_of_several_runs_lie_on_one_map_or_on_one_each() {
    let program = Program::new();
    folder(&program);
    let all = ["traces", "runs", "-o", "x.svg"];
    let one = words(&program, &all);
    assert!(
        one[1].contains("6 flights, 1 at rest"),
        "the hive is one: {}",
        one[1]
    );
    for seed in 1..=3 {
        assert!(one.contains(&format!("seed {seed}")), "{one:?}");
    }
    assert_eq!(one.iter().filter(|word| *word == "east, m").count(), 1);
    let svg = drawn(&program, &[&all[..], &["--by", "seed"]].concat());
    // The block of the world stands on each map; the colours are vehicles again.
    assert_eq!(svg.matches("fill=\"#d94d4d\"").count(), 3);
    let apart = crate::plot::words(&svg);
    assert!(apart.contains(&"bee-1".to_owned()), "{apart:?}");
    assert_eq!(
        apart
            .iter()
            .filter(|word| word.starts_with("seed "))
            .count(),
        3
    );
    drawn(&program, &[&all[..], &["--3d"]].concat());
    let solid = [&all[..], &["--3d", "--by", "seed"]].concat();
    refused(
        &program,
        &solid,
        "--3d draws one picture, and --by sets 3 apart",
    );
}

#[test]
fn coverage_of_several_runs_has_a_mean_and_where_it_is() {
    let program = Program::new();
    folder(&program);
    let all = [
        "coverage",
        "runs",
        "-o",
        "x.svg",
        "--cell",
        "1 m",
        "--reach",
        "0.6 m",
        "--area=0,-1,11,5",
    ];
    let mean = words(&program, &all);
    // Each bee sees two rows of nine, ten or eleven cells: 36, 40 and 44 of 66; t(2) 4 / sqrt(3) = 9.94.
    assert!(mean[1].contains(": 60.6 ± 15.1 % of 66 m²"), "{}", mean[1]);
    assert!(mean[1].contains("without hive"), "{}", mean[1]);
    assert!(mean.contains(&"visits in each run".to_owned()), "{mean:?}");
    let svg = drawn(&program, &[&all[..], &["--confidence"]].concat());
    let pictures = |svg: &str| svg.matches("data:image/png;base64,").count();
    assert_eq!(pictures(&svg), 4, "two maps, and the colours of each");
    let svg = drawn(
        &program,
        &[&all[..], &["--by", "seed", "--show", "runs"]].concat(),
    );
    assert_eq!(pictures(&svg), 4, "three maps of the same colours");
    drawn(
        &program,
        &[&all[..], &["--over-time", "--by", "seed"]].concat(),
    );
    let alone = ["coverage", "runs/1.mcap", "-o", "x.svg", "--confidence"];
    refused(&program, &alone, "of one run alone nothing is known");
    let hive = [&all[..], &["--models", "*"]].concat();
    assert!(
        !words(&program, &hive)[1].contains("without"),
        "it is asked for"
    );
}

#[test]
fn one_run_in_two_files_is_refused() {
    let program = Program::new();
    record(&program, "a.mcap", 7, 5, 1.0);
    std::fs::copy(program.path("a.mcap"), program.path("b.mcap")).expect("a copy");
    let twice = [
        "series", "a.mcap", "b.mcap", "-o", "x.svg", "--metric", "load",
    ];
    refused(
        &program,
        &twice,
        "a.mcap and b.mcap are one and the same run",
    );
    refused(&program, &twice, "seed 7");
    let same = [
        "series", "a.mcap", "a.mcap", "-o", "x.svg", "--metric", "load",
    ];
    refused(&program, &same, "given twice");
}

/// Bees on a channel with noise, as many as it says, in a row.
fn talk(program: &Program, name: &str, seed: u32, count: u32) {
    let text = format!(
        "[run]\nseed = {seed}\nend_time = \"5 s\"\n\
         [channel]\nuse = \"free-space\"\nmedium = \"simple\"\nrange_limit = \"100 m\"\n\
         noise_floor = {{ mean = \"-85 dBm\", sigma = \"5 dB\" }}\n\
         [[model]]\nuse = \"broadcast-bee\"\nname = \"bee\"\ncount = {count}\n\
         start = {{ grid = [{count}, 1, 1], spacing = \"15 m\", from = [\"0 m\", \"0 m\", \"5 m\"] }}\n\
         radio = {{ use = \"cc2420\" }}\n\
         [[component]]\nuse = \"recorder\"\npath = \"{name}\"\n"
    );
    program.write("talk.toml", &text);
    program.summary(&["talk.toml"]);
}

#[test]
fn links_of_several_runs_are_means_and_the_unsure_ones_are_dashed() {
    let program = Program::new();
    for seed in 1..=3 {
        talk(&program, &format!("{seed}.mcap"), seed, 4);
    }
    talk(&program, "five.mcap", 1, 5);
    let runs = ["links", "1.mcap", "2.mcap", "3.mcap", "-o", "x.svg"];
    let svg = drawn(&program, &runs);
    let words = crate::plot::words(&svg);
    assert!(
        words[1].ends_with("4 radios, 6 links, mean over runs"),
        "{}",
        words[1]
    );
    assert!(words.contains(&"± more than 0.1".to_owned()), "{words:?}");
    // Six pairs have room for their numbers, one for each way that anything is heard on.
    let numbers = words
        .iter()
        .filter(|word| word.starts_with("0.") || word.starts_with("1."));
    let numbers: Vec<_> = numbers.filter(|word| word.contains(" ± ")).collect();
    assert!(numbers.len() >= 6, "{words:?}");
    let unsure = numbers.iter().filter(|word| {
        let half: f64 = word
            .rsplit(' ')
            .next()
            .and_then(|n| n.parse().ok())
            .expect("a number");
        half > 0.105
    });
    let dashed = svg.matches("stroke-dasharray=\"7 5\"").count();
    assert!(dashed >= unsure.count(), "{dashed} {numbers:?}");
    let others = ["links", "1.mcap", "five.mcap", "-o", "x.svg"];
    refused(
        &program,
        &others,
        "links of 4 radios and five.mcap of 5; bee-4/radio is in five.mcap only",
    );
    let by = [&others[..], &["--by", "model.bee.count"]].concat();
    let words = crate::plot::words(&drawn(&program, &by));
    assert!(
        words.iter().any(|word| word == "count = 4: 6 links"),
        "{words:?}"
    );
}

#[test]
fn losses_of_several_runs_are_their_means_with_where_these_are() {
    let program = Program::new();
    for seed in 1..=3 {
        talk(&program, &format!("{seed}.mcap"), seed, 4);
    }
    talk(&program, "five.mcap", 1, 5);
    // What the key says of a reason: "noise: 12".
    let number = |words: &[String], reason: &str| -> Option<f64> {
        let said = words.iter().find_map(|word| word.strip_prefix(reason))?;
        said.split(' ').next()?.replace(',', "").parse().ok()
    };
    let alone = (1..=3).map(|seed| {
        let file = format!("{seed}.mcap");
        let said = words(&program, &["losses", &file, "-o", "x.svg"]);
        assert!(!said.iter().any(|word| word.contains('±')), "{said:?}");
        number(&said, "noise: ").expect("noise takes some")
    });
    let mean = alone.sum::<f64>() / 3.0;
    let all = ["losses", "1.mcap", "2.mcap", "3.mcap", "-o", "x.svg"];
    let said = words(&program, &all);
    let drawn = number(&said, "noise: ").expect("noise takes some");
    assert!(mean > 1.0 && (drawn - mean).abs() < 0.051, "{drawn} {mean}");
    assert!(
        said.iter().any(|word| word.contains("95 % confidence")),
        "{said:?}"
    );
    let by = ["losses", "1.mcap", "five.mcap", "-o", "x.svg", "--by"];
    let said = words(&program, &[&by[..], &["model.bee.count"]].concat());
    for word in ["count = 4", "count = 5", "noise"] {
        assert!(said.contains(&word.to_owned()), "{word}: {said:?}");
    }
    refused(
        &program,
        &["losses", "1.mcap", "-o", "x.svg", "--radio", "bee-0"],
        "1.mcap has no counters of",
    );
}

/// What can be drawn of one recording, and of several, and what of the latter says that it is a mean.
const KINDS: [(&[&str], &str); 10] = [
    (&["traces"], "seed 2"),
    (&["traces", "--3d"], "seed 2"),
    (&["series", "--metric", "speed"], "band: 95 % confidence"),
    (&["histogram", "--metric", "speed"], "95 % confidence"),
    (&["links"], "mean over runs"),
    (&["delivery"], "mean over runs, and where it is with 95 %"),
    (&["coverage", "--confidence"], "±, with 95 % confidence"),
    (&["coverage", "--over-time"], " ± "),
    (&["losses"], "with 95 % confidence"),
    (&["rssi"], "median"),
];

/// A sweep of three seeds, as a folder of recordings.
fn swept(program: &Program) {
    program.write(
        "talk.toml",
        "[run]\nseed = 1\nend_time = \"4 s\"\n\
         [channel]\nuse = \"free-space\"\nmedium = \"simple\"\nrange_limit = \"100 m\"\n\
         noise_floor = { mean = \"-85 dBm\", sigma = \"5 dB\" }\n\
         [[model]]\nuse = \"broadcast-bee\"\nname = \"talker\"\ncount = 3\n\
         start = { grid = [3, 1, 1], spacing = \"15 m\", from = [\"0 m\", \"0 m\", \"5 m\"] }\n\
         radio = { use = \"cc2420\" }\n\
         [[model]]\nuse = \"random-walk-bee\"\nname = \"bee\"\ncount = 3\n\
         start = { box = [\"4 m\", \"4 m\", \"2 m\"] }\n",
    );
    let sweep = ["sweep", "talk.toml", "--seeds", "3", "--record", "runs"];
    let call = program.call(&sweep);
    assert_eq!(call.code, Some(0), "{}", call.err);
}

#[test]
fn every_kind_is_drawn_of_one_run_and_of_a_whole_sweep_as_svg_and_as_png() {
    let program = Program::new();
    swept(&program);
    for (kind, mean) in KINDS {
        for (input, runs) in [("runs/run-0001.mcap", ", seed 1"), ("runs", "3 runs")] {
            if kind.contains(&"--confidence") && input != "runs" {
                continue;
            }
            let said = words(&program, &[kind, &[input, "-o", "x.svg"]].concat());
            assert!(said[1].contains(runs), "{kind:?}: {said:?}");
            if input == "runs" {
                let caption = [said[1].as_str(), &said[2]].join(" ");
                let told = said.iter().any(|word| word.contains(mean));
                assert!(told || caption.contains(mean), "{kind:?}: {said:?}");
            }
            let call = program.call(&[&["plot"], kind, &[input, "-o", "x.png"]].concat());
            assert_eq!(call.code, Some(0), "{kind:?} of {input}: {}", call.err);
            let png = std::fs::read(program.path("x.png")).expect("it is there");
            assert!(png.starts_with(b"\x89PNG\r\n\x1a\n") && png.len() > 4_000);
        }
    }
}

#[test]
fn for_a_column_of_a_paper_no_word_leaves_the_picture_or_is_too_small() {
    let program = Program::new();
    swept(&program);
    for (kind, _) in KINDS {
        for input in ["runs/run-0001.mcap", "runs"] {
            if kind.contains(&"--confidence") && input != "runs" {
                continue;
            }
            let narrow = [input, "-o", "x.svg", "--width", "480", "--plain"];
            let svg = drawn(&program, &[kind, &narrow].concat());
            let attribute = |line: &str, name: &str| -> Option<String> {
                let at = line.find(&format!(" {name}=\""))? + name.len() + 3;
                Some(line[at..].split('"').next()?.to_owned())
            };
            let texts = svg.lines().filter(|line| line.starts_with("<text "));
            let mut count = 0;
            for text in texts.filter(|text| !text.contains("rotate")) {
                let number = |name: &str| -> f64 {
                    let value = attribute(text, name).expect("it has one");
                    value.parse().expect("a number")
                };
                let said = crate::plot::words(text).remove(0);
                let (x, size) = (number("x"), number("font-size"));
                let wide = simbeeotic_view::render::words::width(&said, size);
                let left = match attribute(text, "text-anchor").as_deref() {
                    Some("middle") => x - 0.5 * wide,
                    Some("end") => x - wide,
                    _ => x,
                };
                assert!(
                    left >= 0.0 && left + wide <= 480.0,
                    "{kind:?} of {input}: {said:?} from {left} to {}",
                    left + wide
                );
                // 480 pixels in a column of 88 mm: 12 pixels are six points.
                assert!(size >= 12.0, "{kind:?} of {input}: {said:?}: {size}");
                count += 1;
            }
            assert!(count > 5, "{kind:?}");
        }
    }
}

#[test]
fn delivery_of_several_runs_is_their_mean_or_a_curve_each() {
    let program = Program::new();
    for seed in 1..=3 {
        talk(&program, &format!("{seed}.mcap"), seed, 4);
    }
    let runs = ["1.mcap", "2.mcap", "3.mcap", "-o", "x.svg"];
    let all = [&["delivery"], &runs[..]].concat();
    let said = words(&program, &all);
    let mean = "mean over runs, and where it is with 95 % confidence";
    assert!(said.contains(&mean.to_owned()), "{said:?}");
    let by = words(&program, &[&all[..], &["--by", "seed"]].concat());
    assert!(
        by.contains(&"seed 3".to_owned()) && !by.contains(&mean.to_owned()),
        "{by:?}"
    );
    let rssi = words(
        &program,
        &[&["rssi"], &runs[..], &["--by", "seed"]].concat(),
    );
    assert!(rssi.contains(&"seed 3".to_owned()), "{rssi:?}");
}

#[test]
fn the_three_files_of_a_table_are_one_picture() {
    let program = Program::new();
    let csv = "run,seed,n,trace_hash,ended,error,trips\n\
               1,1,10,0a,end time,,4\n2,2,10,0b,end time,,6\n3,1,20,0c,end time,,\n4,2,20,0d,end time,,\n\
               5,1,30,0e,end time,,8\n6,2,30,0f,end time,,8\n";
    program.write("t.csv", csv);
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    let objects = rows[1..].iter().map(|row| {
        let pairs = rows[0]
            .iter()
            .zip(row)
            .map(|(name, value)| match value.parse::<f64>() {
                Ok(number) if !["trace_hash"].contains(name) => format!("{name:?}: {number}"),
                _ => format!("{name:?}: {value:?}"),
            });
        format!("{{{}}}", pairs.collect::<Vec<_>>().join(", "))
    });
    let json = format!("[{}]", objects.collect::<Vec<_>>().join(",\n"));
    program.write("t.json", &json);
    let column = |at: usize| {
        rows[1..]
            .iter()
            .map(move |row| row[at].to_owned())
            .collect()
    };
    let columns: Vec<_> = (0..rows[0].len())
        .map(|at| simbeeotic_record::Column::texts(rows[0][at], column(at)))
        .collect();
    simbeeotic_record::write_table(program.path("t.parquet"), &columns).expect("written");
    let draw = |file: &str| {
        let arguments = [
            "sweep", file, "-o", "x.svg", "--x", "n", "--metric", "trips",
        ];
        drawn(&program, &arguments)
    };
    let svg = draw("t.csv");
    assert_eq!(draw("t.json"), svg);
    assert_eq!(draw("t.parquet"), svg);
    let words = crate::plot::words(&svg);
    // A long caption has two lines.
    let caption = [words[1].as_str(), words[2].as_str()].join(" ");
    assert!(
        caption.contains("6 runs; 2 seeds at each place"),
        "{}",
        caption
    );
    assert!(
        caption.contains("2 of them have no number and are left out"),
        "{}",
        caption
    );
    assert!(caption.contains("cut at 0"), "5 ± 12.7: {}", caption);
    // No line goes through 20, where no run has a number: blue are whiskers alone.
    for line in lines(&svg, "#0072b2") {
        let places = line.iter().map(|point| point[0]);
        let wide = places.clone().fold(0.0, f64::max) - places.fold(f64::INFINITY, f64::min);
        assert!(wide < 20.0, "{line:?}");
    }
    program.write("t.json", "[]");
    let none = [
        "sweep", "t.json", "-o", "x.svg", "--x", "n", "--metric", "trips",
    ];
    refused(&program, &none, "this is no table of runs");
}

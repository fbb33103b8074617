//! What is printed of a sweep: its runs before they run, and means over seeds behind them.

use super::rows::{Row, Rows};
use crate::program::plot::{BandKind, band};
use crate::program::remark;
use crate::program::show::number;
use simbeeotic_scenario::Sweep;

/// Most lines that are printed of means.
const LINES_MAX: usize = 60;
/// Most columns of numbers that are printed unless somebody says which.
const COLUMNS_MAX: usize = 8;

/// All runs, one a line.
pub(super) fn listed(sweep: &Sweep) -> String {
    let head = ["run", "seed"].map(str::to_owned);
    let head: Vec<String> = head
        .into_iter()
        .chain(sweep.keys().map(str::to_owned))
        .collect();
    let mut lines = vec![head];
    lines.extend((0..sweep.len()).map(|run| {
        let seed = sweep
            .seed(run)
            .map_or("-".to_owned(), |seed| seed.to_string());
        let head = [(run + 1).to_string(), seed];
        head.into_iter().chain(sweep.values(run)).collect()
    }));
    aligned(&lines)
}

/// The numbers that are printed: those that were asked for, else those that say something.
pub(super) fn columns(rows: &Rows, wanted: &[String]) -> Vec<String> {
    match wanted {
        [] => shown(rows),
        wanted => asked_for(rows, wanted),
    }
}

/// Mean and 95 % interval of each number over the runs of a combination.
pub(super) fn means(sweep: &Sweep, rows: &Rows, names: &[String]) -> String {
    let mut groups: Vec<Group<'_>> = Vec::new();
    for (values, row) in rows.good() {
        let at = match groups
            .iter()
            .position(|group| group.values == values.as_slice())
        {
            Some(at) => at,
            None => {
                groups.push(Group {
                    values,
                    runs: 0,
                    numbers: vec![Vec::new(); names.len()],
                });
                groups.len() - 1
            }
        };
        groups[at].runs += 1;
        for (name, numbers) in names.iter().zip(&mut groups[at].numbers) {
            numbers.extend(row.number(name).filter(|number| number.is_finite()));
        }
    }
    let keys = rows.keys().iter().cloned();
    let head = keys.chain(["runs".to_owned()]).chain(names.iter().cloned());
    let mut lines = vec![head.collect::<Vec<_>>()];
    let mut lacking = false;
    for group in groups.iter_mut().take(LINES_MAX) {
        let mut line: Vec<String> = group.values.to_vec();
        line.push(group.runs.to_string());
        for numbers in &mut group.numbers {
            let mut cell = estimate(numbers);
            // A mean of those that have a number at all is another than that of all.
            if (1..group.runs).contains(&numbers.len()) {
                cell.push_str(&format!(" ({})", numbers.len()));
                lacking = true;
            }
            line.push(cell);
        }
        lines.push(line);
    }
    let mut text = aligned(&lines);
    if lacking {
        text.push_str("(n): only so many of the runs have this number\n");
    }
    if groups.len() > LINES_MAX {
        text.push_str(&format!(
            "... and {} combinations more\n",
            groups.len() - LINES_MAX
        ));
    }
    let hidden = rows.names().len() - names.len();
    if hidden > 0 {
        text.push_str(&format!("{hidden} numbers more are in the table\n"));
    }
    if sweep.seeds().is_some_and(|seeds| seeds.len() > 1) {
        text.push_str("mean ± half of the 95 % interval of the mean over seeds, after Student\n");
    }
    text
}

/// The runs of a combination.
struct Group<'a> {
    values: &'a [String],
    /// Those that came to their end.
    runs: usize,
    /// For each column, what they came to; runs without the number are not in it.
    numbers: Vec<Vec<f64>>,
}

/// `mean ± half of its 95 % interval`; of one run its number alone.
pub(super) fn estimate(numbers: &mut [f64]) -> String {
    let Some(mean) = band::mean(numbers) else {
        return "-".to_owned();
    };
    match band::band(numbers, BandKind::Confidence) {
        Some([low, high]) => format!("{} ± {}", number(mean), number(0.5 * (high - low))),
        None => number(mean),
    }
}

/// The name of a number without its unit.
fn base(name: &str) -> &str {
    name.split(" [").next().unwrap_or(name)
}

/// What was probably meant, of the numbers that there are.
fn meant<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.map(base).collect();
    match simbeeotic_units::did_you_mean(name, known.iter().copied()) {
        Some(guess) => format!("did you mean `{guess}`?"),
        None => format!("there is {}", known.join(", ")),
    }
}

/// What is said of numbers that were asked for, and that a run does not have: while there are more runs to come, it may
/// be a slip that can be mended yet.
pub(super) fn missing(row: &Row, wanted: &[String]) -> Vec<String> {
    let known = || row.numbers().map(|(name, _)| name);
    let is_missing = |name: &&String| !known().any(|n| n == *name || base(n) == name.as_str());
    let absent = wanted.iter().filter(is_missing);
    let said = absent.map(|name| {
        let help = meant(name, known());
        format!("note: --metric {name}: the first run that is done does not have it; {help}")
    });
    said.collect()
}

/// The numbers that were asked for, with or without their units; a remark of each that there is not.
fn asked_for(rows: &Rows, wanted: &[String]) -> Vec<String> {
    let mut names = Vec::new();
    for name in wanted {
        match rows.names().iter().find(|n| *n == name || base(n) == *name) {
            Some(found) => names.push(found.clone()),
            None => {
                let known = rows.names().iter().map(String::as_str);
                let help = meant(name, known);
                remark(format!("warning: --metric {name}: no run has it; {help}"));
            }
        }
    }
    names
}

/// The numbers that are worth a column: what models publish, on average, and the run's own, if they are not the same
/// in all runs. If nothing differs, the first that there are.
fn shown(rows: &Rows) -> Vec<String> {
    let is_mean = |name: &str| {
        name.split(" [")
            .next()
            .is_some_and(|n| n.ends_with("/mean"))
    };
    let differs = |name: &String| {
        let mut numbers = rows.good().map(|(_, row)| row.number(name));
        let first = numbers.next();
        numbers.any(|other| Some(other) != first)
    };
    let own = [
        "contacts",
        "packets/sent",
        "packets/received",
        "energy/spent [J]",
    ];
    let published = rows.names().iter().filter(|name| is_mean(name));
    let own = rows.names().iter().filter(|n| own.contains(&n.as_str()));
    let all: Vec<String> = published.chain(own).cloned().collect();
    let differing: Vec<String> = all.iter().filter(|name| differs(name)).cloned().collect();
    let mut shown = match differing.is_empty() {
        true => all,
        false => differing,
    };
    shown.truncate(COLUMNS_MAX);
    if shown.is_empty() {
        shown.push("virtual_s".to_owned());
    }
    shown
}

/// Lines of words in columns, the words to the left.
pub(super) fn aligned(lines: &[Vec<String>]) -> String {
    let count = lines.iter().map(Vec::len).max().unwrap_or(0);
    let width = |at: usize| {
        let words = lines.iter().filter_map(|line| line.get(at));
        words.map(|word| word.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..count).map(width).collect();
    let mut text = String::new();
    for line in lines {
        let words = line
            .iter()
            .zip(&widths)
            .map(|(word, width)| format!("{word:<width$}"));
        text.push_str(words.collect::<Vec<_>>().join("  ").trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::rows::Row;
    use super::*;

    #[test]
    fn an_estimate_has_students_interval() {
        // s = 1, t(2) = 4.3027, over the root of three.
        assert_eq!(estimate(&mut [1.0, 2.0, 3.0]), "2 ± 2.48");
        assert_eq!(estimate(&mut [4.5]), "4.5");
        assert_eq!(estimate(&mut []), "-");
    }

    #[test]
    fn a_mean_of_those_that_have_the_number_says_how_many_and_what_never_differs_is_not_shown() {
        let text = "[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"inert-bee\"\n[sweep]\nseeds = 3\n\
                    [sweep.vary]\nmodel.inert-bee.count = [1, 2]\n";
        let loaded = simbeeotic_scenario::load_text("x", text, &Default::default());
        let loaded = loaded.unwrap_or_else(|rejected| panic!("{:?}", rejected.faults));
        let sweep = loaded.sweep().expect("it varies");
        let row = |run: usize, found: Option<f64>| {
            let numbers = [("contacts", run as f64), ("docked/mean", 0.0)];
            let mut numbers = numbers.map(|(name, x)| (name.to_owned(), x)).to_vec();
            numbers.extend(found.map(|s| ("found/mean [s]".to_owned(), s)));
            Row::again(run, 1, "0f", "end time", numbers)
        };
        // Runs 0, 2 and 4 are of one bee.
        let found = [Some(3.0), Some(4.0), None, Some(4.0), None, Some(4.0)];
        let rows = found
            .iter()
            .enumerate()
            .map(|(run, found)| row(run, *found));
        let rows = Rows::of(sweep, rows.collect());
        let text = means(sweep, &rows, &columns(&rows, &[]));
        let lines: Vec<Vec<&str>> = text.lines().map(|l| l.split("  ").collect()).collect();
        let words = |at: usize| -> Vec<&str> {
            let words = lines[at].iter().map(|word| word.trim());
            words.filter(|word| !word.is_empty()).collect()
        };
        assert_eq!(
            words(0),
            [
                "model.inert-bee.count",
                "runs",
                "found/mean [s]",
                "contacts"
            ],
            "{text}"
        );
        assert_eq!(words(1), ["1", "3", "3 (1)", "2 ± 4.97"], "{text}");
        assert_eq!(words(2), ["2", "3", "4 ± 0", "3 ± 4.97"], "{text}");
        assert!(text.contains("(n): only so many"), "{text}");
    }

    #[test]
    fn words_stand_in_columns() {
        let lines = [
            vec!["a".to_owned(), "±±".to_owned(), "b".to_owned()],
            vec!["long".to_owned(), "x".to_owned(), "c".to_owned()],
        ];
        assert_eq!(aligned(&lines), "a     ±±  b\nlong  x   c\n");
    }
}

//! What is printed of a sweep: its runs before they run, and means over seeds behind them.

use super::rows::Rows;
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

/// Mean and 95 % interval of each number over the runs of a combination.
pub(super) fn means(sweep: &Sweep, rows: &Rows, wanted: &[String]) -> String {
    let names = match wanted {
        [] => shown(rows),
        wanted => asked_for(rows, wanted),
    };
    let mut groups: Vec<(&[String], Vec<Vec<f64>>)> = Vec::new();
    for (values, row) in rows.good() {
        let at = match groups
            .iter()
            .position(|(other, _)| *other == values.as_slice())
        {
            Some(at) => at,
            None => {
                groups.push((values, vec![Vec::new(); names.len()]));
                groups.len() - 1
            }
        };
        for (name, numbers) in names.iter().zip(&mut groups[at].1) {
            numbers.extend(row.number(name));
        }
    }
    let keys = rows.keys().iter().cloned();
    let head = keys.chain(["runs".to_owned()]).chain(names.iter().cloned());
    let mut lines = vec![head.collect::<Vec<_>>()];
    for (values, numbers) in groups.iter_mut().take(LINES_MAX) {
        let runs = numbers.iter().map(Vec::len).max().unwrap_or(0);
        let mut line: Vec<String> = values.to_vec();
        line.push(runs.to_string());
        line.extend(numbers.iter_mut().map(|numbers| estimate(numbers)));
        lines.push(line);
    }
    let mut text = aligned(&lines);
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

/// `mean ± half of its 95 % interval`; of one run its number alone.
fn estimate(numbers: &mut [f64]) -> String {
    let Some(mean) = band::mean(numbers) else {
        return "-".to_owned();
    };
    match band::band(numbers, BandKind::Confidence) {
        Some([low, high]) => format!("{} ± {}", number(mean), number(0.5 * (high - low))),
        None => number(mean),
    }
}

/// The numbers that were asked for, with or without their units; a remark of each that there is not.
fn asked_for(rows: &Rows, wanted: &[String]) -> Vec<String> {
    let base = |name: &str| name.split(" [").next().unwrap_or(name).to_owned();
    let mut names = Vec::new();
    for name in wanted {
        match rows.names().iter().find(|n| *n == name || base(n) == *name) {
            Some(found) => names.push(found.clone()),
            None => {
                let known: Vec<String> = rows.names().iter().map(|n| base(n)).collect();
                let guess = simbeeotic_units::did_you_mean(name, known.iter().map(String::as_str));
                let help = match guess {
                    Some(guess) => format!("did you mean `{guess}`?"),
                    None => format!("they have: {}", known.join(", ")),
                };
                remark(format!("warning: --metric {name}: no run has it; {help}"));
            }
        }
    }
    names
}

/// The numbers that are worth a column: what models publish, on average; else what differs from zero.
fn shown(rows: &Rows) -> Vec<String> {
    let is_mean = |name: &str| {
        name.split(" [")
            .next()
            .is_some_and(|n| n.ends_with("/mean"))
    };
    let says = |name: &str| {
        rows.good()
            .any(|(_, row)| row.number(name).is_some_and(|x| x != 0.0))
    };
    let names = rows.names().iter();
    let published = names.clone().filter(|name| is_mean(name));
    let own = [
        "contacts",
        "packets/sent",
        "packets/received",
        "energy/spent [J]",
    ];
    let own = own.into_iter().filter(|name| says(name));
    let all = published.cloned().chain(own.map(str::to_owned));
    let mut shown: Vec<String> = all.take(COLUMNS_MAX).collect();
    if shown.is_empty() {
        shown.push("virtual_s".to_owned());
    }
    shown
}

/// Lines of words in columns, the words to the left.
fn aligned(lines: &[Vec<String>]) -> String {
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
    use super::*;

    #[test]
    fn an_estimate_has_students_interval() {
        // s = 1, t(2) = 4.3027, over the root of three.
        assert_eq!(estimate(&mut [1.0, 2.0, 3.0]), "2 ± 2.48");
        assert_eq!(estimate(&mut [4.5]), "4.5");
        assert_eq!(estimate(&mut []), "-");
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

//! What stands below the title of `plot sweep`: of how many runs it is, and what its bands are.

use super::super::runs::{Column, Runs};
use super::Part;

/// Where bands were cut, for all parts: each has its own limits.
fn cut(parts: &[Part]) -> String {
    let mut ends: Vec<f64> = Vec::new();
    for part in parts {
        let limits = [part.limits.least, part.limits.most];
        for numbers in part.numbers() {
            let (_, _, cut) = numbers.estimate(part.limits);
            let cut = limits.into_iter().zip(cut).filter(|(_, cut)| *cut);
            ends.extend(cut.map(|(end, _)| end));
        }
    }
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    let ends: Vec<String> = ends.iter().map(f64::to_string).collect();
    match ends.split_last() {
        None => String::new(),
        Some((last, [])) => format!(", cut at {last}"),
        Some((last, more)) => format!(", cut at {} and {last}", more.join(", ")),
    }
}

/// How many runs there are, and what the band is.
pub(super) fn caption(
    runs: &Runs,
    x: &Column,
    by: &Option<Column>,
    parts: &[Part],
    missing: usize,
) -> String {
    let counts = || {
        parts
            .iter()
            .flat_map(Part::numbers)
            .map(|numbers| numbers.units.len())
    };
    let (least, most) = (counts().min().unwrap_or(0), counts().max().unwrap_or(0));
    let good = runs.good().count();
    let mut text = match good {
        1 => "1 run".to_owned(),
        n => format!("{n} runs"),
    };
    let each = match least == most {
        true => most.to_string(),
        false => format!("{least} to {most}"),
    };
    match most {
        0 | 1 if good == 1 => {}
        0 | 1 => text.push_str("; one at each place, so nothing is known of their spread"),
        _ => {
            let mut pooled = runs.pooled(x, by.as_ref());
            let seeds = pooled.iter().position(|key| *key == "seed");
            let of = match seeds {
                Some(at) => {
                    pooled.remove(at);
                    "seeds"
                }
                None => "runs",
            };
            let over = match (pooled.as_slice(), seeds) {
                ([], _) => String::new(),
                (keys, Some(_)) => format!(", averaged over {}", keys.join(", ")),
                (keys, None) => format!(", over {}", keys.join(", ")),
            };
            let band = "mean, and where it is with 95 % confidence";
            let said = cut(parts);
            let alone = match least {
                1 => ", if there are two or more",
                _ => "",
            };
            text.push_str(&format!(
                "; {each} {of} at each place{over}: {band}{alone}{said}; dots: the runs"
            ));
        }
    }
    let metrics = parts
        .iter()
        .map(|part| part.lines.len())
        .sum::<usize>()
        .max(1);
    match missing {
        0 => {}
        1 => text.push_str("; a number is missing and left out"),
        n if metrics > 1 && n > good => {
            text.push_str(&format!("; {n} numbers are missing and left out"));
        }
        n => text.push_str(&format!("; {n} of them have no number and are left out")),
    }
    if runs.failed() > 0 {
        text.push_str(&format!("; {} failed and are left out", runs.failed()));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::super::limits::Limits;
    use super::super::{Line, Numbers};
    use super::*;

    #[test]
    fn where_bands_are_cut_is_said_of_each_part_by_its_own_limits() {
        let part = |name: &str, unit: &str, numbers: &[f64]| {
            let runs = numbers.iter().zip(["1", "2", "3"]);
            let runs: Vec<(&str, f64)> = runs.map(|(n, seed)| (seed, *n)).collect();
            Part {
                label: String::new(),
                limits: Limits::of(name, unit, numbers.iter().copied()),
                lines: vec![Line {
                    name: String::new(),
                    colour: 0,
                    marker: 0,
                    points: vec![(1.0, Numbers::of(&runs))],
                }],
            }
        };
        let ratio = || part("ratio", "", &[0.8, 0.9, 1.0]);
        let far = || part("far", "m", &[0.1, 0.2, 9.0]);
        let climb = || part("climb", "m/s", &[0.1, 0.2, 9.0]);
        assert_eq!(cut(&[ratio(), far()]), ", cut at 0 and 1");
        assert_eq!(cut(&[far(), ratio()]), ", cut at 0 and 1");
        assert_eq!(cut(&[ratio(), climb()]), ", cut at 1");
        assert_eq!(
            cut(&[far(), ratio(), part("lost", "%", &[2.0, 90.0, 99.0])]),
            ", cut at 0, 1 and 100"
        );
        assert_eq!(cut(&[climb()]), "");
    }
}

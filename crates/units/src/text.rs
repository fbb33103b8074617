//! Help for people who mistype.

/// The candidate that `word` was probably meant to be, if one is close enough.
///
/// A candidate that differs only in case, spaces, `-` and `_` is taken at once; else the one
/// with the smallest Damerau-Levenshtein distance (insert, delete, replace, swap of neighbours),
/// if that distance is at most a third of the word's length. Of equally close ones the first wins.
///
/// ```
/// use simbeeotic_units::did_you_mean;
///
/// let keys = ["max_speed", "heading_sigma", "radio_period"];
/// assert_eq!(did_you_mean("heading_sgima", keys), Some("heading_sigma"));
/// assert_eq!(did_you_mean("MaxSpeed", keys), Some("max_speed"));
/// assert_eq!(did_you_mean("colour", keys), None);
/// ```
pub fn did_you_mean<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let letters: Vec<char> = word.chars().collect();
    let bare = bare(word);
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let distance = if self::bare(candidate) == bare {
            0
        } else {
            let other: Vec<char> = candidate.chars().collect();
            distance(&letters, &other)
        };
        let near = distance <= letters.len() / 3;
        if near && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// A word without what people vary: case and the joints between its parts.
fn bare(word: &str) -> String {
    word.chars()
        .filter(|c| !c.is_whitespace() && !matches!(c, '-' | '_'))
        .flat_map(char::to_lowercase)
        .collect()
}

/// Damerau-Levenshtein distance in its "optimal string alignment" form: no letter takes part in two
/// edits.
fn distance(a: &[char], b: &[char]) -> usize {
    let mut before_last: Vec<usize> = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    let mut row = vec![0; b.len() + 1];
    for i in 0..a.len() {
        row[0] = i + 1;
        for j in 0..b.len() {
            let replace = last[j] + usize::from(a[i] != b[j]);
            let mut least = replace.min(last[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                least = least.min(before_last[j - 1] + 1);
            }
            row[j + 1] = least;
        }
        std::mem::swap(&mut before_last, &mut last);
        std::mem::swap(&mut last, &mut row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn between(a: &str, b: &str) -> usize {
        let letters = |word: &str| word.chars().collect::<Vec<_>>();
        distance(&letters(a), &letters(b))
    }

    #[test]
    fn distance_counts_inserts_deletes_replaces_and_swaps() {
        assert_eq!(between("", ""), 0);
        assert_eq!(between("", "abc"), 3);
        assert_eq!(between("abc", ""), 3);
        assert_eq!(between("kitten", "sitting"), 3);
        assert_eq!(between("sgima", "sigma"), 1);
        assert_eq!(between("ca", "abc"), 3); // 2 in the unrestricted distance
        assert_eq!(between("grün", "grun"), 1);
    }

    #[test]
    fn a_third_of_the_word_may_be_wrong() {
        assert_eq!(did_you_mean("copmass", ["compass"]), Some("compass"));
        assert_eq!(did_you_mean("cmpas", ["compass"]), None);
        assert_eq!(did_you_mean("ab", ["abc"]), None);
        assert_eq!(did_you_mean("", ["abc"]), None);
    }

    #[test]
    fn case_and_joints_do_not_count() {
        assert_eq!(did_you_mean("mhz", ["Hz", "kHz", "MHz"]), Some("MHz"));
        assert_eq!(did_you_mean("Nm", ["N m", "mN m"]), Some("N m"));
        assert_eq!(
            did_you_mean("instrument_bee", ["hive", "instrument-bee"]),
            Some("instrument-bee")
        );
    }

    #[test]
    fn the_closest_wins_and_then_the_first() {
        assert_eq!(did_you_mean("speeds", ["spends", "speed"]), Some("spends"));
        assert_eq!(did_you_mean("speed", ["spend", "speed"]), Some("speed"));
    }
}

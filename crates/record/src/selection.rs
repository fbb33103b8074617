//! Which part of a recording is exported.

use crate::data::Vehicle;
use std::num::NonZeroU64;
use std::ops::RangeInclusive;

/// Which ticks and which models are exported; all of them by default.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selection {
    /// Of the ticks in time, every n-th, beginning with the first.
    pub every: NonZeroU64,
    /// Patterns for paths of models; a model is exported if one of them matches. Empty: all.
    ///
    /// `*` stands for any characters, `?` for one. A pattern also matches everything below what
    /// it matches: `hive` takes `hive/door` along.
    pub models: Vec<String>,
    /// Virtual times, ns since the start of the run; both ends are included.
    pub times_ns: RangeInclusive<u64>,
}

impl Default for Selection {
    fn default() -> Self {
        Selection {
            every: NonZeroU64::MIN,
            models: Vec::new(),
            times_ns: 0..=u64::MAX,
        }
    }
}

impl Selection {
    /// Places of the selected vehicles, or the first pattern that matches none.
    pub(crate) fn vehicles(&self, vehicles: &[Vehicle]) -> Result<Vec<usize>, &str> {
        let useless = |pattern: &&String| !vehicles.iter().any(|v| selects(pattern, &v.path));
        if let Some(pattern) = self.models.iter().find(useless) {
            return Err(pattern);
        }
        let selected = |place: &usize| {
            let path = &vehicles[*place].path;
            self.models.is_empty() || self.models.iter().any(|pattern| selects(pattern, path))
        };
        Ok((0..vehicles.len()).filter(selected).collect())
    }
}

impl Selection {
    /// Whether a path, or one above it, is selected.
    pub fn takes(&self, path: &str) -> bool {
        self.models.is_empty() || self.models.iter().any(|pattern| selects(pattern, path))
    }

    /// Places of the patterns that match a path.
    pub(crate) fn matching(&self, path: &str) -> Vec<usize> {
        let patterns = self.models.iter().enumerate();
        let matching = patterns.filter(|(_, pattern)| selects(pattern, path));
        matching.map(|(place, _)| place).collect()
    }
}

/// Whether a pattern matches a path or one of the paths above it.
pub(crate) fn selects(pattern: &str, path: &str) -> bool {
    let above = path.match_indices('/').map(|(slash, _)| &path[..slash]);
    std::iter::once(path)
        .chain(above)
        .any(|path| matches(pattern, path))
}

/// Whether a pattern with `*` and `?` matches a whole text. Takes at most the product of both
/// lengths: a star that turned out too short grows by one character, and only the last one.
fn matches(pattern: &str, text: &str) -> bool {
    let pattern: Vec<char> = pattern.chars().collect();
    let text: Vec<char> = text.chars().collect();
    let (mut p, mut t) = (0, 0);
    // Behind the last star, and where in the text it was tried to end.
    let mut star: Option<(usize, usize)> = None;

    while t < text.len() {
        match pattern.get(p) {
            Some('*') => {
                p += 1;
                star = Some((p, t));
            }
            Some(c) if *c == '?' || *c == text[t] => {
                p += 1;
                t += 1;
            }
            _ => {
                let Some((behind, end)) = star else {
                    return false;
                };
                p = behind;
                t = end + 1;
                star = Some((behind, t));
            }
        }
    }
    pattern[p..].iter().all(|c| *c == '*')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_stand_for_anything() {
        assert!(matches("bee-*", "bee-17"));
        assert!(matches("*-17", "bee-17"));
        assert!(matches("b*e*7", "bee-17"));
        assert!(matches("*", ""));
        assert!(!matches("bee-*", "hive"));
        assert!(!matches("bee-?", "bee-17"));
        assert!(matches("bee-??", "bee-17"));
        assert!(!matches("", "bee"));
    }

    #[test]
    fn a_pattern_takes_along_what_is_below() {
        assert!(selects("hive", "hive/door"));
        assert!(selects("hive-*", "hive-2/door/hinge"));
        assert!(!selects("hive", "hive-2"));
        assert!(selects("hive/*", "hive/door"));
        assert!(!selects("hive/*", "hive"));
    }

    #[test]
    fn many_stars_take_no_time() {
        assert!(!matches(&"*a".repeat(200), &"a".repeat(199)));
    }

    #[test]
    fn a_pattern_that_matches_nothing_is_named() {
        let vehicles = [Vehicle {
            path: "bee-0".into(),
            ..Vehicle::default()
        }];
        let selection = Selection {
            models: vec!["bee-*".into(), "bea-*".into()],
            ..Selection::default()
        };
        assert_eq!(selection.vehicles(&vehicles), Err("bea-*"));
        assert_eq!(Selection::default().vehicles(&vehicles), Ok(vec![0]));
    }
}

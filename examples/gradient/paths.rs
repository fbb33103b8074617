//! Paths on the ground, and where a place lies beside them.

use simbeeotic::prelude::*;

/// Lines of straight legs, each from the hive to the edge of the field.
#[derive(Clone, Debug, PartialEq)]
pub struct Paths(Vec<Vec<[f64; 2]>>);

/// Where a place lies beside the nearest path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beside {
    /// Which path, from 0.
    pub path: usize,
    /// From the hive to the nearest point of the path, along the path.
    pub along: Length,
    /// From that point on to the path's end.
    pub left: Length,
    /// From the place to that point, on the map.
    pub across: Length,
}

impl Paths {
    /// Reads one path a text: its bends, from the hive on, as `"0 m, 0 m; 20 m, 5 m; 50 m, 0 m"`, east
    /// and north of the world's origin, to 10 km. All begin at one place, the hive.
    ///
    /// # Errors
    /// No path, a path of less than two bends, a bend that is no pair of lengths or lies too far
    /// away, a leg of no length, paths that begin at different places.
    pub fn read(key: &'static str, texts: &[String]) -> Result<Self, BuildError> {
        if texts.is_empty() {
            return Err(BuildError::parameter(key, "must have a path or more"));
        }
        let paths: Result<_, BuildError> = texts.iter().map(|text| bends(key, text)).collect();
        let paths: Vec<Vec<[f64; 2]>> = paths?;
        if let Some(other) = paths.iter().find(|path| path[0] != paths[0][0]) {
            let place = |[east, north]: [f64; 2]| format!("{east} m, {north} m");
            let message = format!(
                "begin at different places, `{}` and `{}`; all must begin at the hive",
                place(paths[0][0]),
                place(other[0])
            );
            return Err(BuildError::parameter(key, message));
        }
        Ok(Self(paths))
    }

    /// Where `place` lies beside the nearest path; of equals, the first.
    pub fn beside(&self, place: Position) -> Beside {
        let place = place.si();
        let mut best = [f64::INFINITY, 0.0, 0.0, 0.0];
        for (number, bends) in self.0.iter().enumerate() {
            let mut along_m = 0.0;
            let mut found = [f64::INFINITY, 0.0];
            for leg in bends.windows(2) {
                let length_m = distance_m(leg[0], leg[1]);
                let [east, north] = [0, 1].map(|i| (leg[1][i] - leg[0][i]) / length_m);
                let ahead_m = (place.x - leg[0][0]) * east + (place.y - leg[0][1]) * north;
                let ahead_m = ahead_m.clamp(0.0, length_m);
                let foot = [leg[0][0] + ahead_m * east, leg[0][1] + ahead_m * north];
                let across_m = distance_m(foot, [place.x, place.y]);
                if across_m < found[0] {
                    found = [across_m, along_m + ahead_m];
                }
                along_m += length_m;
            }
            if found[0] < best[0] {
                best = [found[0], found[1], along_m - found[1], number as f64];
            }
        }
        Beside {
            path: best[3] as usize,
            along: Length::si(best[1]),
            left: Length::si(best[2]),
            across: Length::si(best[0]),
        }
    }

    /// Where each path ends.
    pub fn ends(&self) -> impl Iterator<Item = Position> {
        let ends = self.0.iter().filter_map(|bends| bends.last());
        ends.map(|[east, north]| Position::from_xyz(*east, *north, 0.0))
    }

    /// Where the paths begin.
    pub fn hive(&self) -> Position {
        let [east, north] = self.0[0][0];
        Position::from_xyz(east, north, 0.0)
    }
}

/// How far from the origin a bend may lie, along an axis.
const HIGHEST_M: f64 = 10_000.0;

/// The bends of one path.
fn bends(key: &'static str, text: &str) -> Result<Vec<[f64; 2]>, BuildError> {
    let wrong = |what: String| {
        let help =
            "a path is written as \"0 m, 0 m; 20 m, 5 m\": the bends east and north, from the hive";
        BuildError::parameter(key, format!("has {what}; {help}"))
    };
    let mut bends: Vec<[f64; 2]> = Vec::new();
    for bend in text.split(';') {
        let parts = bend.split(',').map(|part| part.trim().parse::<Length>());
        let lengths: Result<Vec<Length>, _> = parts.collect();
        let lengths = lengths.map_err(|error| wrong(format!("the bend `{bend}`: {error}")))?;
        let [east, north] = lengths[..] else {
            return Err(wrong(format!(
                "the bend `{bend}`, which is not two lengths"
            )));
        };
        if east.metres().abs().max(north.metres().abs()) > HIGHEST_M {
            let what =
                format!("the bend `{bend}`, which is more than 10 km from the world's origin");
            return Err(wrong(what));
        }
        let bend = [east.metres(), north.metres()];
        if bends
            .last()
            .is_some_and(|last| distance_m(*last, bend) < 1e-3)
        {
            return Err(wrong(format!("a leg of no length in `{text}`")));
        }
        bends.push(bend);
    }
    if bends.len() < 2 {
        return Err(wrong(format!("`{text}`, which is less than two bends")));
    }
    Ok(bends)
}

fn distance_m(a: [f64; 2], b: [f64; 2]) -> f64 {
    let [east, north] = [0, 1].map(|i| a[i] - b[i]);
    (east * east + north * north).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paths(texts: &[&str]) -> Result<Paths, BuildError> {
        let texts: Vec<String> = texts.iter().map(|text| (*text).to_owned()).collect();
        Paths::read("paths", &texts)
    }

    #[test]
    fn a_place_knows_how_far_along_and_across_it_lies() {
        let bent = paths(&["0 m, 0 m; 10 m, 0 m; 10 m, 20 m", "0 m, 0 m; -5 m, 0 m"]).expect("two");
        let beside = |x, y| {
            let Beside {
                path,
                along,
                left,
                across,
            } = bent.beside(Position::from_xyz(x, y, 3.0));
            [path as f64, along.metres(), left.metres(), across.metres()]
        };
        assert_eq!(beside(4.0, -3.0), [0.0, 4.0, 26.0, 3.0]);
        assert_eq!(beside(12.0, 5.0), [0.0, 15.0, 15.0, 2.0]);
        assert_eq!(beside(13.0, 24.0), [0.0, 30.0, 0.0, 5.0]);
        assert_eq!(beside(-4.0, 1.0), [1.0, 4.0, 1.0, 1.0]);
    }

    #[test]
    fn what_is_no_path_is_refused_by_name() {
        for (texts, word) in [
            (&[][..], "a path or more"),
            (&["0 m, 0 m"], "less than two bends"),
            (&["0 m, 0 m; 3 m"], "not two lengths"),
            (&["0 m, 0 m; 3 s, 1 m"], "3 s"),
            (&["0 m, 0 m; 0 m, 0 m"], "no length"),
            (&[""], "bend"),
            (&["0 m, 0 m; 1e300 m, 3 m"], "10 km"),
            (
                &["0 m, 0 m; 3 m, 0 m", "1 m, 0 m; 3 m, 0 m"],
                "different places",
            ),
        ] {
            let error = paths(texts).expect_err("no path").to_string();
            assert!(error.contains("`paths`") && error.contains(word), "{error}");
        }
    }
}

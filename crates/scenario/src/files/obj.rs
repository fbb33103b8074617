//! Wavefront OBJ: of all that it can say, points (`v x y z`) and faces (`f a b c ...`).
//!
//! A corner of a face is the number of a point, from 1, or from -1 backwards from the last one so far;
//! what follows behind a `/` (texture, normal) is not used. A face of more than three corners is cut
//! into a fan, which is right for convex ones.

use super::Triangles;
use super::stl::finite;

pub(super) fn parse(text: &str) -> Result<Triangles, String> {
    let mut read = Triangles::default();
    let mut lines = text.lines().enumerate();
    while let Some((at, line)) = lines.next() {
        let wrong = |what: String| format!("line {}: {what}", at + 1);
        let line = line.split('#').next().unwrap_or_default();
        let mut whole = line.trim_end().to_owned();
        while whole.ends_with('\\') {
            whole.pop();
            whole.push_str(lines.next().map_or("", |(_, next)| next).trim_end());
        }
        let mut words = whole.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let numbers: Vec<Option<f64>> = words.map(finite).collect();
                let [Some(x), Some(y), Some(z), ..] = numbers[..] else {
                    return Err(wrong("a point has three numbers".into()));
                };
                read.points.push([x, y, z]);
            }
            Some("f") => {
                let corners: Result<Vec<u32>, String> =
                    words.map(|word| corner(word, read.points.len())).collect();
                let corners = corners.map_err(wrong)?;
                let [first, rest @ ..] = corners.as_slice() else {
                    return Err(wrong("a face has three corners or more".into()));
                };
                if rest.len() < 2 {
                    return Err(wrong("a face has three corners or more".into()));
                }
                for pair in rest.windows(2) {
                    read.push([*first, pair[0], pair[1]])?;
                }
            }
            _ => {}
        }
    }
    Ok(read)
}

fn corner(word: &str, points: usize) -> Result<u32, String> {
    let number = word.split('/').next().unwrap_or_default();
    let number: i64 = number
        .parse()
        .map_err(|_| format!("`{word}` is no corner of a face"))?;
    let index = match number {
        1.. => usize::try_from(number - 1).ok(),
        _ => usize::try_from(number.unsigned_abs())
            .ok()
            .filter(|back| *back > 0)
            .and_then(|back| points.checked_sub(back)),
    };
    let index = index.filter(|index| *index < points);
    index
        .and_then(|index| u32::try_from(index).ok())
        .ok_or_else(|| format!("there is no point {number}: there are {points} before it"))
}

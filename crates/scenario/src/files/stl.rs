//! STL: triangles, in text or in binary, `z` up by custom.
//!
//! Binary: 80 bytes of anything, the number of triangles as 32 bits, then 50 bytes for each: a normal,
//! three corners (12 numbers of 32 bits), two bytes of anything, all little endian. Text:
//! `solid NAME`, `facet normal ..`, `outer loop`, three `vertex x y z`, `endloop`, `endfacet`,
//! `endsolid`. A binary file may begin with `solid` too: its length tells, and if that is wrong, that it
//! has no `facet`. Normals are not used.

use super::{Corners, Triangles};

const HEADER: usize = 84;
const RECORD: usize = 50;

pub(super) fn parse(bytes: &[u8]) -> Result<Triangles, String> {
    let count = bytes.get(80..HEADER).and_then(|b| b.try_into().ok());
    let count = count.map(u32::from_le_bytes);
    let length = count.map(|n| HEADER as u64 + RECORD as u64 * u64::from(n));
    let facet = |word: &[u8]| word.eq_ignore_ascii_case(b"facet");
    let is_text = bytes.trim_ascii_start().starts_with(b"solid") && bytes.windows(5).any(facet);
    match length {
        Some(length) if length == bytes.len() as u64 => binary(&bytes[HEADER..]),
        _ if is_text && std::str::from_utf8(bytes).is_ok() => ascii(super::text(bytes)?),
        Some(length) => Err(format!(
            "a binary STL file of {} triangles has {length} bytes, not {}",
            count.unwrap_or_default(),
            bytes.len()
        )),
        None => Err("this is no STL file: it is too short".into()),
    }
}

fn binary(records: &[u8]) -> Result<Triangles, String> {
    let mut read = Triangles::default();
    let mut corners = Corners::default();
    for (at, record) in records.chunks_exact(RECORD).enumerate() {
        let number = |i: usize| {
            let bytes = record.get(4 * i..4 * i + 4)?.try_into().ok()?;
            let number = f32::from_le_bytes(bytes);
            number.is_finite().then_some(f64::from(number))
        };
        let corner = |i: usize| Some([number(i)?, number(i + 1)?, number(i + 2)?]);
        // The first three numbers are the normal.
        let (Some(a), Some(b), Some(c)) = (corner(3), corner(6), corner(9)) else {
            return Err(format!("triangle {at} has a corner that is no number"));
        };
        let triangle = [a, b, c].map(|point| corners.number(point, &mut read.points));
        read.push(triangle)?;
    }
    Ok(read)
}

fn ascii(text: &str) -> Result<Triangles, String> {
    let mut read = Triangles::default();
    let mut corners = Corners::default();
    let mut open: Option<Vec<u32>> = None;
    for (at, line) in text.lines().enumerate() {
        let wrong = |what: &str| Err(format!("line {}: {what}", at + 1));
        let mut words = line.split_ascii_whitespace();
        let word = words.next().unwrap_or_default().to_ascii_lowercase();
        match (word.as_str(), &mut open) {
            ("outer", None) => open = Some(Vec::new()),
            ("outer", Some(_)) => return wrong("a loop begins inside another one"),
            ("vertex", Some(triangle)) => {
                let numbers: Vec<Option<f64>> = words.map(finite).collect();
                let [Some(x), Some(y), Some(z)] = numbers[..] else {
                    return wrong("a vertex has three numbers");
                };
                triangle.push(corners.number([x, y, z], &mut read.points));
            }
            ("vertex", None) => return wrong("a vertex stands outside of a loop"),
            ("endloop", Some(triangle)) => {
                let Ok(triangle) = <[u32; 3]>::try_from(triangle.as_slice()) else {
                    return wrong("a loop has three vertices");
                };
                read.push(triangle)?;
                open = None;
            }
            ("endloop", None) => return wrong("a loop ends that did not begin"),
            ("solid" | "endsolid" | "facet" | "endfacet" | "", _) => {}
            (other, _) => return wrong(&format!("`{other}` means nothing in an STL file")),
        }
    }
    match open {
        Some(_) => Err("the file ends inside a triangle".into()),
        None => Ok(read),
    }
}

/// A number that is one.
pub(super) fn finite(word: &str) -> Option<f64> {
    word.parse().ok().filter(|n: &f64| n.is_finite())
}

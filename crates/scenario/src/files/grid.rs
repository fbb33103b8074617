//! Grids of heights in text: Esri ASCII grids and plain lines of numbers.
//!
//! An Esri grid begins with lines of a name and a number: `ncols`, `nrows`, `cellsize`, the place of its
//! lower left corner (which does not count here: terrain stands where the world says), and
//! `nodata_value`. Then follow the heights in metres, from the north-west, row by row. They are taken
//! for the heights of the cells' middles: the grid is one cell shorter than its cells are.

use super::Grid;
use super::stl::finite;

/// More heights than this are refused.
pub(super) const HEIGHTS_MAX: usize = 16_777_216;

pub(super) fn parse_asc(text: &str) -> Result<Grid, String> {
    let mut header = Header::default();
    let mut lines = text.lines().enumerate().peekable();
    while let Some((at, line)) = lines.peek() {
        let mut words = line.split_ascii_whitespace();
        let Some(word) = words.next() else {
            lines.next();
            continue;
        };
        if !word.starts_with(|c: char| c.is_ascii_alphabetic()) {
            break;
        }
        let (word, value) = (word.to_ascii_lowercase(), words.next().and_then(finite));
        let known = value.is_some_and(|value| header.set(&word, value));
        if !known {
            return Err(format!("line {}: this is no line of an Esri grid", at + 1));
        }
        lines.next();
    }
    let (columns, count) = (
        header.size("ncols", header.columns)?,
        header.size("nrows", header.rows)?,
    );
    if columns.checked_mul(count).is_none_or(|n| n > HEIGHTS_MAX) {
        return Err(format!("it has more than {HEIGHTS_MAX} heights"));
    }
    let cell_m = header.cell_m.filter(|cell| *cell > 0.0);
    let cell_m = cell_m.ok_or("`cellsize` is missing, or not above 0")?;
    let mut heights = Vec::new();
    for (at, line) in lines {
        for word in line.split_ascii_whitespace() {
            let wrong = |what: &str| Err(format!("line {}: {what}", at + 1));
            match finite(word) {
                Some(height) if header.nodata == Some(height) => {
                    return wrong("a cell without data: fill the grid's gaps first");
                }
                Some(height) => heights.push(height),
                None => return wrong(&format!("`{word}` is no height")),
            }
        }
    }
    if heights.len() != columns * count {
        let found = heights.len();
        return Err(format!(
            "{columns} times {count} heights are announced, {found} are there"
        ));
    }
    Ok(Grid {
        rows: heights.chunks(columns).map(<[f64]>::to_vec).collect(),
        length_m: Some(cell_m * (columns - 1) as f64),
        width_m: Some(cell_m * (count - 1) as f64),
    })
}

#[derive(Default)]
struct Header {
    columns: Option<f64>,
    rows: Option<f64>,
    cell_m: Option<f64>,
    nodata: Option<f64>,
}

impl Header {
    fn set(&mut self, word: &str, value: f64) -> bool {
        match word {
            "ncols" => self.columns = Some(value),
            "nrows" => self.rows = Some(value),
            "cellsize" => self.cell_m = Some(value),
            "nodata_value" => self.nodata = Some(value),
            "xllcorner" | "yllcorner" | "xllcenter" | "yllcenter" => {}
            _ => return false,
        }
        true
    }

    fn size(&self, word: &str, value: Option<f64>) -> Result<usize, String> {
        let whole = value.filter(|n| n.fract() == 0.0 && (2.0..=1e7).contains(n));
        let whole =
            whole.ok_or_else(|| format!("`{word}` is missing, or no whole number from 2 on"))?;
        Ok(whole as usize)
    }
}

/// Lines of numbers in metres with commas, the first in the north. Empty lines and lines that begin
/// with `#` do not count.
pub(super) fn parse_csv(text: &str) -> Result<Grid, String> {
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut all = 0;
    for (at, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let bare = line.trim();
        if bare.is_empty() || bare.starts_with('#') {
            continue;
        }
        let mut row = Vec::new();
        for cell in bare.split(',') {
            let cell = cell.trim();
            let height = finite(cell);
            row.push(height.ok_or_else(|| format!("line {}: `{cell}` is no height", at + 1))?);
        }
        if let Some(first) = rows.first().filter(|first| first.len() != row.len()) {
            let (found, wanted) = (row.len(), first.len());
            return Err(format!(
                "line {}: {found} heights, in the first {wanted}",
                at + 1
            ));
        }
        all += row.len();
        if all > HEIGHTS_MAX {
            return Err(format!("it has more than {HEIGHTS_MAX} heights"));
        }
        rows.push(row);
    }
    if rows.len() < 2 {
        return Err("a grid has two lines of heights or more".into());
    }
    Ok(Grid {
        rows,
        length_m: None,
        width_m: None,
    })
}

/// The same grid between other heights, if both are given.
pub(super) fn stretch(
    mut grid: Grid,
    (low, high): (Option<f64>, Option<f64>),
) -> Result<Grid, String> {
    let (Some(low), Some(high)) = (low, high) else {
        return match low.or(high) {
            Some(_) => Err("`min_height` and `max_height` stand together".into()),
            None => Ok(grid),
        };
    };
    let all = || grid.rows.iter().flatten().copied();
    let least = all().fold(f64::INFINITY, f64::min);
    let most = all().fold(f64::NEG_INFINITY, f64::max);
    if most <= least {
        return Err("all heights are the same: nothing lies between two of them".into());
    }
    let scale = (high - low) / (most - least);
    for height in grid.rows.iter_mut().flatten() {
        *height = low + (*height - least) * scale;
    }
    Ok(grid)
}

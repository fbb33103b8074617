//! Tables in text: lines of cells between commas below a header. Empty lines, and lines that start with `#`, do
//! not count.

use std::fmt;

/// What is wrong with a table, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct TableFault {
    /// The line, from 1.
    pub line: usize,
    /// The character in the line, from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
}

impl TableFault {
    pub(crate) fn new(line: usize, column: usize, message: impl Into<String>) -> Self {
        Self {
            line,
            column,
            message: message.into(),
        }
    }
}

impl fmt::Display for TableFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)
    }
}

/// The lines that count, each with its number, from 1.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = (1..).zip(text.trim_start_matches('\u{feff}').lines());
    lines.filter(|(_, line)| !line.trim().is_empty() && !line.trim_start().starts_with('#'))
}

/// The cells of a line, trimmed, each with the character that it begins at, from 1.
pub(crate) fn cells(line: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut column = 1;
    line.split(',').map(move |cell| {
        let blank = cell.len() - cell.trim_start().len();
        let place = column + cell[..blank].chars().count();
        column += cell.chars().count() + 1;
        (place, cell.trim())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_know_their_place_in_characters_and_comments_do_not_count() {
        let text = "\u{feff}# gains\n\n  # of links\na, b\n é ,  ü,,x\n";
        let numbers: Vec<usize> = lines(text).map(|(number, _)| number).collect();
        assert_eq!(numbers, [4, 5]);
        let (_, last) = lines(text).last().expect("two lines");
        let found: Vec<_> = cells(last).collect();
        assert_eq!(found, [(2, "é"), (7, "ü"), (9, ""), (10, "x")]);
    }
}

//! A table of named columns as a file: Parquet, CSV or JSON, by the ending of its name.

use super::Failure;
use simbeeotic_record::{Column, Values, publish, publishable, write_table};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// What a table can be written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Parquet,
    Csv,
    Json,
}

/// A file that a table will be written to.
#[derive(Debug)]
pub(super) struct TableFile {
    /// The option that asks for it.
    flag: &'static str,
    pub(super) path: PathBuf,
    pub(super) format: Format,
}

impl TableFile {
    /// Looks at the path before the run, so that no run is in vain.
    pub(super) fn new(flag: &'static str, path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().and_then(|ending| ending.to_str());
        let format = match ending {
            Some("parquet") => Format::Parquet,
            Some("csv") => Format::Csv,
            Some("json") => Format::Json,
            _ => {
                let message = "its name must end in .parquet, .csv or .json";
                return Err(failed(flag, path, message));
            }
        };
        let folder = path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        match folder {
            Some(folder) if !folder.is_dir() => {
                let message = format!("there is no folder {}", folder.display());
                Err(failed(flag, path, message))
            }
            _ => Ok(Self {
                flag,
                path: path.to_path_buf(),
                format,
            }),
        }
    }

    /// Writes it, whole or not at all.
    pub(super) fn write(&self, columns: &[Column]) -> Result<(), Failure> {
        let path = &self.path;
        match self.format {
            Format::Parquet => write_table(path, columns).map_err(Failure::run),
            Format::Csv => publish(path, |file| csv(BufWriter::new(file), columns))
                .map_err(|e| self.unwritten(e)),
            Format::Json => publish(path, |file| json(BufWriter::new(file), columns))
                .map_err(|e| self.unwritten(e)),
        }
    }

    /// An error if it cannot be written as things are now.
    pub(super) fn probe(&self) -> Result<(), Failure> {
        publishable(&self.path).map_err(|e| failed(self.flag, &self.path, e))
    }

    /// Writes it; if that fails, keeps it in the folder of temporary files, or prints it. The error says
    /// which.
    pub(super) fn write_or_keep(&self, columns: &[Column]) -> Result<(), Failure> {
        let Err(why) = self.write(columns) else {
            return Ok(());
        };
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy();
        let elsewhere = Self {
            flag: self.flag,
            path: std::env::temp_dir().join(format!("{stem}-{}.csv", std::process::id())),
            format: Format::Csv,
        };
        let place = match elsewhere.write(columns) {
            Ok(()) => format!("is in {}", elsewhere.path.display()),
            Err(_) => {
                csv(io::stdout().lock(), columns).map_err(|e| self.unwritten(e))?;
                "stands on standard output".to_owned()
            }
        };
        Err(Failure::run(format!(
            "{}; the table {place}",
            why.message.trim_end()
        )))
    }

    fn unwritten(&self, why: io::Error) -> Failure {
        Failure::run(format!("{} {}: {why}", self.flag, self.path.display()))
    }
}

fn failed(flag: &str, path: &Path, what: impl std::fmt::Display) -> Failure {
    Failure::input(format!("{flag} {}: {what}", path.display()))
}

fn rows(columns: &[Column]) -> usize {
    let count = |column: &Column| match &column.values {
        Values::Float(values) => values.len(),
        Values::Integer(values) => values.len(),
        Values::Bool(values) => values.len(),
        Values::Text(values) => values.len(),
        _ => 0,
    };
    columns.iter().map(count).max().unwrap_or(0)
}

/// Comma-separated values (RFC 4180). A number that there is not is an empty field.
pub(super) fn csv(mut to: impl Write, columns: &[Column]) -> io::Result<()> {
    let names: Vec<String> = columns.iter().map(|column| quoted(&column.name)).collect();
    writeln!(to, "{}", names.join(","))?;
    for row in 0..rows(columns) {
        let fields: Vec<String> = columns.iter().map(|column| field(column, row)).collect();
        writeln!(to, "{}", fields.join(","))?;
    }
    to.flush()
}

fn field(column: &Column, row: usize) -> String {
    match &column.values {
        Values::Float(values) => match values.get(row) {
            Some(value) if !value.is_nan() => value.to_string(),
            _ => String::new(),
        },
        Values::Integer(values) => values.get(row).map_or(String::new(), i64::to_string),
        Values::Bool(values) => values.get(row).map_or(String::new(), bool::to_string),
        Values::Text(values) => values.get(row).map_or(String::new(), |text| quoted(text)),
        _ => String::new(),
    }
}

fn quoted(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

/// A list of objects, one a row. What is no finite number is `null`.
fn json(mut to: impl Write, columns: &[Column]) -> io::Result<()> {
    let objects = (0..rows(columns)).map(|row| {
        let pairs = columns.iter().map(|column| {
            let value = match &column.values {
                Values::Float(values) => serde_json::json!(values.get(row)),
                Values::Integer(values) => serde_json::json!(values.get(row)),
                Values::Bool(values) => serde_json::json!(values.get(row)),
                Values::Text(values) => serde_json::json!(values.get(row)),
                _ => serde_json::Value::Null,
            };
            (column.name.clone(), value)
        });
        serde_json::Value::Object(pairs.collect())
    });
    serde_json::to_writer_pretty(&mut to, &objects.collect::<Vec<_>>())?;
    writeln!(to)?;
    to.flush()
}

/// The rows of a text of comma-separated values (RFC 4180), the line of names first. `None` if a quote is
/// never closed.
pub(super) fn read_csv(text: &str) -> Option<Vec<Vec<String>>> {
    let text = text.trim_start_matches('\u{feff}');
    let mut rows = Vec::new();
    let mut row = Vec::new();
    let mut field = String::new();
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if field.is_empty() => loop {
                match letters.next()? {
                    '"' if letters.peek() == Some(&'"') => {
                        letters.next();
                        field.push('"');
                    }
                    '"' => break,
                    other => field.push(other),
                }
            },
            ',' => row.push(std::mem::take(&mut field)),
            '\r' if letters.peek() == Some(&'\n') => {}
            '\n' => {
                row.push(std::mem::take(&mut field));
                rows.push(std::mem::take(&mut row));
            }
            other => field.push(other),
        }
    }
    if !field.is_empty() || !row.is_empty() {
        row.push(field);
        rows.push(row);
    }
    Some(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_says_by_its_ending_what_it_is() {
        for (name, format) in [
            ("a.parquet", Format::Parquet),
            ("a.b.csv", Format::Csv),
            ("a.json", Format::Json),
        ] {
            let file = TableFile::new("--summary", Path::new(name)).ok();
            assert_eq!(file.map(|file| file.format), Some(format));
        }
        for name in ["a", "a.txt", ".csv", "there/is/no/such/folder/a.csv"] {
            assert!(TableFile::new("-o", Path::new(name)).is_err(), "{name}");
        }
    }

    #[test]
    fn what_is_written_as_csv_reads_as_it_was() {
        let texts = [
            "a,b",
            "say \"bee\"",
            "two\nlines",
            "",
            "plain",
            "\"",
            "ends in\r\n",
        ];
        let columns = [
            Column::texts("a text", texts.map(str::to_owned).to_vec()),
            Column::integers("n", (0..7).collect()),
            Column::floats(
                "x, y",
                vec![0.1, f64::NAN, f64::INFINITY, -0.0, 1e300, 1e-300, 3.0],
            ),
        ];
        let mut text = Vec::new();
        csv(&mut text, &columns).expect("memory");
        let rows = read_csv(&String::from_utf8(text).expect("text")).expect("rows");
        assert_eq!(rows.len(), 8);
        assert_eq!(rows[0], ["a text", "n", "x, y"]);
        for (row, text) in rows[1..].iter().zip(texts) {
            assert_eq!(row[0], text);
        }
        assert_eq!(rows[2][2], "", "there is no number");
        assert_eq!(rows[5][2].parse(), Ok(1e300));
        assert_eq!(read_csv("a,\"b\n"), None);
        assert_eq!(read_csv("").map(|rows| rows.len()), Some(0));
    }
}

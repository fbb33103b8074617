//! Tables of named columns, read back from Parquet files.

use crate::table::{Column, Values};
use parquet::basic::Type as Physical;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use std::fs::File;
use std::path::{Path, PathBuf};

/// Why a file is no table that can be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableReadError {
    /// The file cannot be opened.
    #[error("cannot read {path}: {source}", path = .path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// It is no Parquet file, or a damaged one.
    #[error("{path} is no Parquet file, or a damaged one: {source}", path = .path.display())]
    Parquet {
        /// The file.
        path: PathBuf,
        /// Why.
        source: ParquetError,
    },
    /// A column holds something else than numbers and texts.
    #[error("{path}: column {column:?} holds neither numbers nor texts", path = .path.display())]
    Column {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
    },
}

/// Reads a flat table of numbers and texts, such as [`write_table`](crate::write_table) makes, as columns of
/// equal length. A number that is missing is NaN, a text empty; whole numbers of a column that misses one are
/// floats.
///
/// # Errors
/// When the file cannot be read, is no Parquet file, or has columns of other types.
pub fn read_table(path: impl AsRef<Path>) -> Result<Vec<Column>, TableReadError> {
    let path = path.as_ref();
    let file = File::open(path).map_err(|source| TableReadError::Open {
        path: path.to_path_buf(),
        source,
    })?;
    let damaged = |source| TableReadError::Parquet {
        path: path.to_path_buf(),
        source,
    };
    let reader = SerializedFileReader::new(file).map_err(damaged)?;
    let schema = reader.metadata().file_metadata().schema_descr();
    let mut columns: Vec<(String, Physical, Vec<Field>)> = (schema.columns().iter())
        .map(|column| {
            let name = column.path().string();
            (name, column.physical_type(), Vec::new())
        })
        .collect();
    for row in reader.get_row_iter(None).map_err(damaged)? {
        let row = row.map_err(damaged)?;
        for ((_, field), (.., fields)) in row.get_column_iter().zip(&mut columns) {
            fields.push(field.clone());
        }
    }
    let columns = columns.into_iter().map(|(name, kind, fields)| {
        let refused = || TableReadError::Column {
            path: path.to_path_buf(),
            column: name.clone(),
        };
        let values = values(kind, &fields).ok_or_else(refused)?;
        Ok(Column { name, values })
    });
    columns.collect()
}

/// The values of a column of a type; `None` if they are neither numbers nor texts.
fn values(kind: Physical, fields: &[Field]) -> Option<Values> {
    Some(match kind {
        Physical::DOUBLE | Physical::FLOAT => Values::Float(all(fields, number)?),
        Physical::INT64 | Physical::INT32 => match all(fields, whole) {
            Some(whole) => Values::Integer(whole),
            None => Values::Float(all(fields, number)?),
        },
        Physical::BOOLEAN => Values::Bool(all(fields, |field| match field {
            Field::Bool(yes) => Some(*yes),
            _ => None,
        })?),
        Physical::BYTE_ARRAY => Values::Text(all(fields, |field| match field {
            Field::Str(text) => Some(text.clone()),
            Field::Null => Some(String::new()),
            _ => None,
        })?),
        _ => return None,
    })
}

fn all<T>(fields: &[Field], value: impl Fn(&Field) -> Option<T>) -> Option<Vec<T>> {
    fields.iter().map(value).collect()
}

fn whole(field: &Field) -> Option<i64> {
    match field {
        Field::Long(n) => Some(*n),
        Field::Int(n) => Some(i64::from(*n)),
        _ => None,
    }
}

fn number(field: &Field) -> Option<f64> {
    match field {
        Field::Double(x) => Some(*x),
        Field::Float(x) => Some(f64::from(*x)),
        Field::Null => Some(f64::NAN),
        field => whole(field).map(|n| n as f64),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::write_table;

    #[test]
    fn what_is_written_is_read_as_it_was() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.parquet");
        let columns = vec![
            Column::integers("run", vec![1, -2]),
            Column::texts("key.with.dots", vec!["10 m".into(), String::new()]),
            Column::floats("spread [m]", vec![0.1, -1e300]),
        ];
        write_table(&path, &columns).expect("written");
        assert_eq!(read_table(&path).expect("read"), columns);
    }

    #[test]
    fn what_is_no_table_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.parquet");
        assert!(matches!(
            read_table(&path),
            Err(TableReadError::Open { .. })
        ));
        for bytes in [&b""[..], b"run,seed\n", b"PAR1", b"PAR1\0\0\0\0PAR1"] {
            std::fs::write(&path, bytes).expect("written");
            let read = read_table(&path);
            assert!(matches!(read, Err(TableReadError::Parquet { .. })));
        }
    }
}

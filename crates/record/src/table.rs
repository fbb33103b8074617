//! Tables of named columns as Parquet files.

use crate::export::ExportError;
use crate::publish::publish;
use parquet::basic::{
    Compression, ConvertedType, Encoding, LogicalType, Repetition, Type as Physical, ZstdLevel,
};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DoubleType, FloatType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{WriterProperties, WriterVersion};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{ColumnPath, Type, TypePtr};
use std::fs::File;
use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

/// One column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name, unique in its table, with the unit last: `range_m`.
    pub name: String,
    /// The values, one a row.
    pub values: Values,
}

impl Column {
    /// A column of numbers.
    pub fn floats(name: impl Into<String>, values: Vec<f64>) -> Self {
        Column {
            name: name.into(),
            values: Values::Float(values),
        }
    }

    /// A column of whole numbers.
    pub fn integers(name: impl Into<String>, values: Vec<i64>) -> Self {
        Column {
            name: name.into(),
            values: Values::Integer(values),
        }
    }

    /// A column of texts.
    pub fn texts(name: impl Into<String>, values: Vec<String>) -> Self {
        Column {
            name: name.into(),
            values: Values::Text(values),
        }
    }
}

/// The values of a [`Column`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Values {
    /// `DOUBLE`. NaN where there is no value.
    Float(Vec<f64>),
    /// `INT64`.
    Integer(Vec<i64>),
    /// `BOOLEAN`.
    Bool(Vec<bool>),
    /// `BYTE_ARRAY (UTF8)`.
    Text(Vec<String>),
}

impl Values {
    fn len(&self) -> usize {
        match self {
            Values::Float(values) => values.len(),
            Values::Integer(values) => values.len(),
            Values::Bool(values) => values.len(),
            Values::Text(values) => values.len(),
        }
    }

    fn kind(&self) -> Kind {
        match self {
            Values::Float(_) => Kind::Double,
            Values::Integer(_) => Kind::Int64,
            Values::Bool(_) => Kind::Bool,
            Values::Text(_) => Kind::Text,
        }
    }
}

/// Writes columns of equal length as one Parquet file (zstd), published by
/// [`publish`]: never torn.
///
/// # Errors
/// When columns differ in length or share a name, when there is none, or when the file cannot be
/// written.
pub fn write_table(path: impl AsRef<Path>, columns: &[Column]) -> Result<(), ExportError> {
    let path = path.as_ref();
    check(columns).map_err(|what| ExportError::Table {
        path: path.to_path_buf(),
        what,
    })?;

    let shape: Vec<_> = columns
        .iter()
        .map(|column| (column.name.as_str(), column.values.kind()))
        .collect();
    let written = publish(path, |file| {
        let mut writer = TableWriter::new(file, &shape, &[])?;
        let mut group = writer.group()?;
        for column in columns {
            match &column.values {
                Values::Float(values) => group.doubles(values)?,
                Values::Integer(values) => group.integers(values)?,
                Values::Bool(values) => group.bools(values)?,
                Values::Text(values) => {
                    let texts: Vec<_> = values.iter().map(|text| text.as_str().into()).collect();
                    group.texts(&texts)?;
                }
            }
        }
        group.close()?;
        writer.close()
    });
    written.map_err(|error| error.at(path))
}

fn check(columns: &[Column]) -> Result<(), String> {
    let Some(first) = columns.first() else {
        return Err("a table needs a column".into());
    };
    for (place, column) in columns.iter().enumerate() {
        let (rows, found) = (first.values.len(), column.values.len());
        if found != rows {
            return Err(format!(
                "column {:?} has {found} rows, {:?} has {rows}",
                column.name, first.name
            ));
        }
        if columns[..place]
            .iter()
            .any(|other| other.name == column.name)
        {
            return Err(format!("two columns are named {:?}", column.name));
        }
    }
    Ok(())
}

/// The Parquet types in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Double,
    Float,
    Int64,
    Bool,
    Text,
}

/// What went wrong while a table was written.
#[derive(Debug)]
pub(crate) enum TableError {
    Io(io::Error),
    Parquet(ParquetError),
}

impl TableError {
    pub(crate) fn at(self, path: &Path) -> ExportError {
        let path = path.to_path_buf();
        match self {
            TableError::Io(source) => ExportError::Write { path, source },
            TableError::Parquet(error) => ExportError::Write {
                path,
                source: match error {
                    // The errors of the file, wrapped.
                    ParquetError::External(source) => io::Error::other(source),
                    error => io::Error::other(error),
                },
            },
        }
    }
}

impl From<io::Error> for TableError {
    fn from(error: io::Error) -> Self {
        TableError::Io(error)
    }
}

impl From<ParquetError> for TableError {
    fn from(error: ParquetError) -> Self {
        TableError::Parquet(error)
    }
}

/// Writes a Parquet file of flat, required columns, a group of rows at a time.
pub(crate) struct TableWriter<W: Write + Send> {
    writer: SerializedFileWriter<W>,
}

impl<'a> TableWriter<&'a File> {
    pub(crate) fn new(
        file: &'a File,
        columns: &[(&str, Kind)],
        notes: &[(&str, &str)],
    ) -> Result<Self, ParquetError> {
        let fields = columns.iter().map(|(name, kind)| field(name, *kind));
        let schema = Type::group_type_builder("table")
            .with_fields(fields.collect::<Result<_, _>>()?)
            .build()?;
        let notes = notes.iter();
        let notes = notes.map(|(key, value)| KeyValue::new((*key).into(), value.to_string()));

        // Level 3 takes a tenth more time for 2 % less.
        let mut properties = WriterProperties::builder()
            .set_writer_version(WriterVersion::PARQUET_1_0)
            .set_created_by(concat!("simbeeotic ", env!("CARGO_PKG_VERSION")).into())
            .set_compression(Compression::ZSTD(ZstdLevel::try_new(1)?))
            .set_key_value_metadata(Some(notes.collect()));
        for (name, kind) in columns {
            // Bytes of equal weight side by side compress better: poses take 41 B a row
            // instead of 46, in two thirds of the time.
            if matches!(kind, Kind::Double | Kind::Float) {
                let path = ColumnPath::from(*name);
                properties = properties
                    .set_column_dictionary_enabled(path.clone(), false)
                    .set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT);
            }
        }

        let writer =
            SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties.build()))?;
        Ok(TableWriter { writer })
    }
}

impl<W: Write + Send> TableWriter<W> {
    /// Begins a group of rows; its columns follow in order.
    pub(crate) fn group(&mut self) -> Result<Group<'_, W>, ParquetError> {
        Ok(Group(self.writer.next_row_group()?))
    }

    pub(crate) fn close(self) -> Result<(), TableError> {
        self.writer.close()?;
        Ok(())
    }
}

/// A group of rows, written column by column.
pub(crate) struct Group<'a, W: Write + Send>(SerializedRowGroupWriter<'a, W>);

macro_rules! column {
    ($(#[$doc:meta])* $method:ident, $ty:ty, $value:ty) => {
        $(#[$doc])*
        pub(crate) fn $method(&mut self, values: &[$value]) -> Result<(), ParquetError> {
            let Some(mut column) = self.0.next_column()? else {
                return Err(ParquetError::General("more columns than the schema has".into()));
            };
            column.typed::<$ty>().write_batch(values, None, None)?;
            column.close()
        }
    };
}

impl<W: Write + Send> Group<'_, W> {
    column!(doubles, DoubleType, f64);
    column!(floats, FloatType, f32);
    column!(integers, Int64Type, i64);
    column!(bools, BoolType, bool);
    column!(texts, ByteArrayType, ByteArray);

    pub(crate) fn close(self) -> Result<(), ParquetError> {
        self.0.close()?;
        Ok(())
    }
}

fn field(name: &str, kind: Kind) -> Result<TypePtr, ParquetError> {
    let physical = match kind {
        Kind::Double => Physical::DOUBLE,
        Kind::Float => Physical::FLOAT,
        Kind::Int64 => Physical::INT64,
        Kind::Bool => Physical::BOOLEAN,
        Kind::Text => Physical::BYTE_ARRAY,
    };
    let mut field =
        Type::primitive_type_builder(name, physical).with_repetition(Repetition::REQUIRED);
    if kind == Kind::Text {
        field = field
            .with_logical_type(Some(LogicalType::String))
            .with_converted_type(ConvertedType::UTF8);
    }
    Ok(Arc::new(field.build()?))
}

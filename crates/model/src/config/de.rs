//! Serde over [`Node`]s: from text with spans to typed values.

use super::fault::{Fault, list};
use super::node::{Key, Node, Span, Table, Value};
use serde::de::{
    self, DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer, MapAccess, SeqAccess,
    VariantAccess, Visitor,
};
use std::fmt;

/// Why a node could not be read, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// The value, or the key, that is wrong. `None` until a node adds its own.
    pub span: Option<Span>,
    /// What is wrong.
    pub message: String,
    /// What is allowed.
    pub help: Option<String>,
}

impl ReadError {
    pub(super) fn or_at(mut self, span: Span) -> Self {
        self.span.get_or_insert(span);
        self
    }
}

impl From<ReadError> for Fault {
    fn from(e: ReadError) -> Self {
        let fault = Fault::error(e.span, e.message);
        match e.help {
            Some(help) => fault.help(help),
            None => fault,
        }
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for ReadError {}

impl de::Error for ReadError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self {
            span: None,
            message: message.to_string(),
            help: None,
        }
    }

    fn unknown_field(field: &str, expected: &'static [&'static str]) -> Self {
        let fault = Fault::unknown(None, "key", field, expected.iter().copied());
        Self {
            span: None,
            message: fault.message,
            help: fault.help,
        }
    }

    fn unknown_variant(variant: &str, expected: &'static [&'static str]) -> Self {
        let fault = Fault::unknown(None, "choice", variant, expected.iter().copied());
        let help = match fault.help {
            Some(guess) if guess.starts_with("did") => {
                Some(format!("{guess} allowed: {}", list(expected)))
            }
            other => other,
        };
        Self {
            span: None,
            message: fault.message,
            help,
        }
    }

    fn invalid_type(found: de::Unexpected<'_>, expected: &dyn de::Expected) -> Self {
        de::Error::custom(format!(
            "{} where {} is wanted",
            kind(&found),
            wanted(expected)
        ))
    }

    fn invalid_value(found: de::Unexpected<'_>, expected: &dyn de::Expected) -> Self {
        let found = match found {
            de::Unexpected::Signed(number) => number.to_string(),
            de::Unexpected::Unsigned(number) => number.to_string(),
            other => kind(&other).to_owned(),
        };
        de::Error::custom(format!("{found} where {} is wanted", wanted(expected)))
    }

    fn invalid_length(length: usize, expected: &dyn de::Expected) -> Self {
        let has = match length {
            0 => "is empty".to_owned(),
            1 => "has 1 entry".to_owned(),
            n => format!("has {n} entries"),
        };
        de::Error::custom(format!("this list {has}; wanted: {}", wanted(expected)))
    }

    fn missing_field(field: &'static str) -> Self {
        Self {
            span: None,
            message: format!("`{field}` is missing here"),
            help: None,
        }
    }
}

/// What was found, in the words of a user.
fn kind(found: &de::Unexpected<'_>) -> &'static str {
    match found {
        de::Unexpected::Bool(_) => "a boolean",
        de::Unexpected::Signed(_) | de::Unexpected::Unsigned(_) => "a whole number",
        de::Unexpected::Float(_) => "a number",
        de::Unexpected::Str(_) | de::Unexpected::Char(_) => "text",
        de::Unexpected::Seq => "a list",
        de::Unexpected::Map => "a table",
        _ => "something else",
    }
}

/// What was expected: serde names Rust's types.
fn wanted(expected: &dyn de::Expected) -> String {
    let words = expected.to_string();
    match words.as_str() {
        "u8" => "a whole number from 0 to 255".to_owned(),
        "u16" => "a whole number from 0 to 65535".to_owned(),
        "u32" | "u64" | "u128" | "usize" => "a whole number, not negative,".to_owned(),
        "i8" | "i16" | "i32" | "i64" | "i128" | "isize" => "a whole number".to_owned(),
        "f32" | "f64" => "a number".to_owned(),
        "a string" => "text".to_owned(),
        "a sequence" => "a list".to_owned(),
        "a map" => "a table".to_owned(),
        other if other.starts_with("struct ") => "a table".to_owned(),
        other if other.starts_with("enum ") => "one choice".to_owned(),
        _ => words.replace("an array of length", "a list of length"),
    }
}

impl<'de> IntoDeserializer<'de, ReadError> for &'de Node {
    type Deserializer = Self;
    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> Deserializer<'de> for &'de Node {
    type Error = ReadError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match &self.value {
            Value::Table(table) => visitor.visit_map(Entries::new(table)),
            Value::Array(items) => {
                let mut elements = Elements(items.iter());
                let value = visitor.visit_seq(&mut elements);
                value.and_then(|value| match elements.0.len() {
                    0 => Ok(value),
                    1 => Err(de::Error::custom("this list has 1 entry too many")),
                    n => Err(de::Error::custom(format!(
                        "this list has {n} entries too many"
                    ))),
                })
            }
            Value::String(text) => visitor.visit_borrowed_str(text),
            Value::Integer(number) => visitor.visit_i64(*number),
            Value::Float(number) => visitor.visit_f64(*number),
            Value::Bool(flag) => visitor.visit_bool(*flag),
        }
        .map_err(|e: ReadError| e.or_at(self.span))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        match &self.value {
            Value::String(text) => visitor.visit_enum(text.as_str().into_deserializer()),
            Value::Table(Table { entries }) if entries.len() == 1 => {
                visitor.visit_enum(Tagged(&entries[0].0, &entries[0].1))
            }
            other => Err(de::Error::custom(format!(
                "{} where one choice is wanted",
                other.kind()
            ))),
        }
        .map_err(|e: ReadError| e.or_at(self.span))
    }

    /// A table. Serde's own structures would take a list too, field by field.
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        if self.as_array().is_some() {
            let error: ReadError = de::Error::custom("a list where a table is wanted");
            return Err(error.or_at(self.span));
        }
        self.deserialize_any(visitor)
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf
        unit unit_struct seq tuple tuple_struct map identifier ignored_any
    }
}

struct Entries<'de> {
    rest: std::slice::Iter<'de, (Key, Node)>,
    value: Option<&'de Node>,
}

impl<'de> Entries<'de> {
    fn new(table: &'de Table) -> Self {
        Self {
            rest: table.entries.iter(),
            value: None,
        }
    }
}

impl<'de> MapAccess<'de> for Entries<'de> {
    type Error = ReadError;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, ReadError> {
        let Some((key, node)) = self.rest.next() else {
            return Ok(None);
        };
        self.value = Some(node);
        let text: de::value::BorrowedStrDeserializer<'de, ReadError> =
            de::value::BorrowedStrDeserializer::new(&key.text);
        seed.deserialize(text)
            .map(Some)
            .map_err(|e| e.or_at(key.span))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, ReadError> {
        match self.value.take() {
            Some(node) => seed.deserialize(node).map_err(|e| e.or_at(node.span)),
            None => Err(de::Error::custom("a value was asked for before its key")),
        }
    }
}

struct Elements<'de>(std::slice::Iter<'de, Node>);

impl<'de> SeqAccess<'de> for &mut Elements<'de> {
    type Error = ReadError;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, ReadError> {
        self.0
            .next()
            .map(|n| seed.deserialize(n).map_err(|e| e.or_at(n.span)))
            .transpose()
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.0.len())
    }
}

/// `{ variant = content }`
struct Tagged<'de>(&'de Key, &'de Node);

impl<'de> EnumAccess<'de> for Tagged<'de> {
    type Error = ReadError;
    type Variant = &'de Node;

    fn variant_seed<V: DeserializeSeed<'de>>(
        self,
        seed: V,
    ) -> Result<(V::Value, &'de Node), ReadError> {
        let text: de::value::BorrowedStrDeserializer<'de, ReadError> =
            de::value::BorrowedStrDeserializer::new(&self.0.text);
        let variant = seed
            .deserialize(text)
            .map_err(|e: ReadError| e.or_at(self.0.span))?;
        Ok((variant, self.1))
    }
}

impl<'de> VariantAccess<'de> for &'de Node {
    type Error = ReadError;

    fn unit_variant(self) -> Result<(), ReadError> {
        Err(ReadError {
            span: Some(self.span),
            message: "this choice has no value".into(),
            help: None,
        })
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, ReadError> {
        seed.deserialize(self)
    }

    fn tuple_variant<V: Visitor<'de>>(
        self,
        _len: usize,
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        self.deserialize_any(visitor)
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        self.deserialize_struct("", fields, visitor)
    }
}

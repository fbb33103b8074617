//! Spellings that files may choose: one table for a list of one; a radius or a diameter.

use schemars::JsonSchema;
use serde::de::{DeserializeOwned, MapAccess, SeqAccess, Visitor, value};
use serde::{Deserialize, Deserializer};
use simbeeotic_units::Length;
use std::fmt;
use std::marker::PhantomData;

/// Reads a list, or one table in its place.
pub(crate) fn one_or_more<'de, D, T>(deserializer: D) -> Result<Vec<T>, D::Error>
where
    D: Deserializer<'de>,
    T: DeserializeOwned,
{
    deserializer.deserialize_any(OneOrMore(PhantomData))
}

struct OneOrMore<T>(PhantomData<T>);

impl<'de, T: DeserializeOwned> Visitor<'de> for OneOrMore<T> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table, or a list of tables,")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Vec<T>, A::Error> {
        T::deserialize(value::MapAccessDeserializer::new(map)).map(|one| vec![one])
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Vec<T>, A::Error> {
        Vec::deserialize(value::SeqAccessDeserializer::new(seq))
    }
}

/// How wide a round thing is, as files say it: `diameter`, or `radius`, but not both; and how high.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Round {
    /// Across.
    pub diameter: Option<Length>,
    /// Half of that, instead of `diameter`.
    pub radius: Option<Length>,
    /// From its lowest to its highest point.
    pub height: Option<Length>,
}

/// How wide a ball is, as files say it: `diameter`, or `radius`, but not both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Ball {
    /// Across.
    pub diameter: Option<Length>,
    /// Half of that, instead of `diameter`.
    pub radius: Option<Length>,
}

impl Round {
    /// The radius that was said, if one was.
    ///
    /// # Errors
    /// Radius and diameter were both said.
    pub fn radius(self) -> Result<Option<Length>, String> {
        let Self {
            diameter, radius, ..
        } = self;
        Ball { diameter, radius }.radius()
    }
}

impl Ball {
    /// The radius that was said, if one was.
    ///
    /// # Errors
    /// Radius and diameter were both said.
    pub fn radius(self) -> Result<Option<Length>, String> {
        match (self.radius, self.diameter) {
            (Some(_), Some(_)) => Err("`radius` and `diameter` say the same: one will do".into()),
            (radius, diameter) => Ok(radius.or(diameter.map(|across| across * 0.5))),
        }
    }
}

/// A diameter that must be there.
///
/// # Errors
/// It is not.
pub fn needed(radius: Option<Length>) -> Result<Length, String> {
    radius.ok_or_else(|| "`diameter` is missing here".into())
}

/// A height that must be there.
///
/// # Errors
/// It is not.
pub fn needed_height(height: Option<Length>) -> Result<Length, String> {
    height.ok_or_else(|| "`height` is missing here".into())
}

//! Quantities in serde and in JSON schema: strings with units, never bare numbers.

use super::print::{Number, in_shortest_unit};
use super::{Quantity, QuantityError};
use schemars::{Schema, json_schema};
use serde::{Deserializer, Serializer, de, ser::Error as _};
use std::fmt;
use std::marker::PhantomData;

/// The body of every `Serialize`: the text, in the unit in which it is short. A number that is not finite
/// is refused, since it could not be read back.
pub(crate) fn serialize<Q: Quantity, S: Serializer>(q: Q, s: S) -> Result<S::Ok, S::Error> {
    if q.to_si().is_finite() {
        s.serialize_str(&in_shortest_unit(q))
    } else {
        Err(S::Error::custom(format_args!("{q} is not finite")))
    }
}

/// The body of every `Deserialize`.
pub(crate) fn deserialize<'de, Q: Quantity, D: Deserializer<'de>>(d: D) -> Result<Q, D::Error> {
    let visitor = QuantityVisitor(PhantomData);
    if d.is_human_readable() {
        d.deserialize_any(visitor) // so that a number reaches us and gets our message
    } else {
        d.deserialize_str(visitor)
    }
}

struct QuantityVisitor<Q>(PhantomData<Q>);

impl<Q: Quantity> QuantityVisitor<Q> {
    fn bare<E: de::Error>(number: impl fmt::Display) -> Result<Q, E> {
        let (number, si_unit) = (number.to_string(), Q::UNITS[0].name);
        Err(E::custom(QuantityError::BareNumber { number, si_unit }))
    }
}

impl<Q: Quantity> de::Visitor<'_> for QuantityVisitor<Q> {
    type Value = Q;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} with a unit, for example \"1.5 {}\"",
            Q::NOUN,
            Q::UNITS[0].name
        )
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Q, E> {
        text.parse().map_err(E::custom)
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Q, E> {
        Self::bare(number)
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<Q, E> {
        Self::bare(number)
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<Q, E> {
        if number.is_finite() {
            return Self::bare(Number(number));
        }
        let (text, noun) = (number.to_string(), Q::NOUN);
        Err(E::custom(QuantityError::NotFinite { text, noun }))
    }
}

/// The schema of a quantity: a string, with the units for editors and for `describe`.
pub(crate) fn schema<Q: Quantity>() -> Schema {
    let units: Vec<&str> = Q::UNITS.iter().map(|unit| unit.name).collect();
    json_schema!({
        "type": "string",
        "description": format!("{} with a unit: {}", Q::NOUN, units.join(", ")),
        "x-si-unit": units[0],
        "x-units": units,
    })
}

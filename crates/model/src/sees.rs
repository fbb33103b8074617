//! What rays take notice of, as a scenario writes it.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use simbeeotic_physics::{Kind, Kinds};
use std::borrow::Cow;
use std::fmt;

const EVERYTHING: &str = "everything";

/// All that can be said: each kind of thing, and all of them.
const WORDS: [&str; 1 + Kind::PLURALS.len()] = {
    let mut words = [EVERYTHING; 1 + Kind::PLURALS.len()];
    let mut at = 0;
    while at < Kind::PLURALS.len() {
        words[at + 1] = Kind::PLURALS[at];
        at += 1;
    }
    words
};

/// Which kinds of things a sensor that looks takes notice of; its rays pass through the rest.
///
/// In a scenario a list of `"ground"`, `"terrain"`, `"obstacles"`, `"structures"`, `"flowers"`,
/// `"people"`, `"vehicles"`, `"stations"` (hives and what else does not fly), `"ghosts"` (what is moved
/// from outside), or `"everything"`, which is the default. A single word may stand without the list.
/// An empty list is an error, as a sensor that sees nothing is none.
///
/// ```
/// use simbeeotic_model::{SeesWhat, physics::Kind};
///
/// let sees = SeesWhat::only(&[Kind::Ground, Kind::Person]);
/// assert!(sees.sees(Kind::Person) && !sees.sees(Kind::Vehicle));
/// assert!(SeesWhat::default().sees(Kind::Station));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SeesWhat(Kinds);

impl SeesWhat {
    /// Every kind.
    pub const EVERYTHING: Self = Self(Kinds::ALL);

    /// These kinds, and no others.
    pub fn only(kinds: &[Kind]) -> Self {
        Self(Kinds::of(kinds))
    }

    /// Whether things of `kind` are among them.
    pub const fn sees(self, kind: Kind) -> bool {
        self.0.contains(kind)
    }

    /// The same for physics.
    pub const fn kinds(self) -> Kinds {
        self.0
    }
}

fn kinds_of<E: de::Error>(word: &str) -> Result<Kinds, E> {
    if word == EVERYTHING {
        return Ok(Kinds::ALL);
    }
    let kind = Kind::ALL.into_iter().find(|kind| kind.plural() == word);
    kind.map(|kind| Kinds::NONE.with(kind))
        .ok_or_else(|| E::unknown_variant(word, &WORDS))
}

/// One word, read where it stands, so that a wrong one has its place.
struct Word(Kinds);

impl<'de> Deserialize<'de> for Word {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;
        impl Visitor<'_> for Reader {
            type Value = Word;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a kind of thing, as \"people\"")
            }

            fn visit_str<E: de::Error>(self, word: &str) -> Result<Word, E> {
                kinds_of(word).map(Word)
            }
        }
        deserializer.deserialize_str(Reader)
    }
}

impl<'de> Deserialize<'de> for SeesWhat {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = SeesWhat;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "\"everything\" or a list of kinds of things, as [\"ground\", \"people\"]",
                )
            }

            fn visit_str<E: de::Error>(self, word: &str) -> Result<SeesWhat, E> {
                kinds_of(word).map(SeesWhat)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<SeesWhat, A::Error> {
                let mut kinds = Kinds::NONE;
                while let Some(Word(more)) = list.next_element()? {
                    kinds = more.iter().fold(kinds, Kinds::with);
                }
                if kinds == Kinds::NONE {
                    return Err(de::Error::invalid_length(0, &self));
                }
                Ok(SeesWhat(kinds))
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

impl Serialize for SeesWhat {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0 == Kinds::ALL {
            serializer.serialize_str(EVERYTHING)
        } else {
            serializer.collect_seq(self.0.iter().map(Kind::plural))
        }
    }
}

impl JsonSchema for SeesWhat {
    fn schema_name() -> Cow<'static, str> {
        "SeesWhat".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Which kinds of things a sensor that looks takes notice of; its rays pass through the rest.",
            "anyOf": [
                { "enum": WORDS },
                { "type": "array", "items": { "enum": WORDS }, "minItems": 1 },
            ],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Node, Span, Value, read};

    fn sees(value: Value) -> Result<SeesWhat, crate::config::Fault> {
        read(&Node::new(Span::default(), value))
    }

    fn text(word: &str) -> Value {
        Value::String(word.into())
    }

    fn list(words: &[&str]) -> Value {
        let words = words
            .iter()
            .map(|word| Node::new(Span::default(), text(word)));
        Value::Array(words.collect())
    }

    #[test]
    fn it_reads_words_and_lists_of_words() {
        assert_eq!(sees(text("everything")), Ok(SeesWhat::EVERYTHING));
        assert_eq!(sees(text("people")), Ok(SeesWhat::only(&[Kind::Person])));
        assert_eq!(sees(list(&Kind::PLURALS)), Ok(SeesWhat::EVERYTHING));
        let two = SeesWhat::only(&[Kind::Ground, Kind::Vehicle]);
        assert_eq!(sees(list(&["vehicles", "ground"])), Ok(two));
    }

    #[test]
    fn an_unknown_word_is_an_error_that_says_what_was_meant() {
        for value in [text("poeple"), list(&["ground", "poeple"])] {
            let fault = sees(value).expect_err("no word");
            assert_eq!(fault.message, "unknown choice `poeple`");
            let help = fault.help.expect("a guess");
            assert!(
                help.starts_with("did you mean `people`? allowed: `everything`, `ground`"),
                "{help}"
            );
        }
    }

    #[test]
    fn a_sensor_that_sees_nothing_is_an_error() {
        let fault = sees(list(&[])).expect_err("nothing");
        assert!(
            fault
                .message
                .starts_with("this list is empty; wanted: \"everything\""),
            "{fault}"
        );
        assert!(sees(Value::Integer(3)).is_err());
    }
}

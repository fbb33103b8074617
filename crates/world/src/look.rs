//! How a thing looks and what is written on it: colour, texture, metadata.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use simbeeotic_units::did_you_mean;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

/// Names and values attached to an object, visible to contacts and sensors.
pub type Meta = BTreeMap<String, String>;

/// A colour with opacity; in files `"#rrggbb"` or `"#rrggbbaa"`, hexadecimal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color {
    /// Red, 0 to 255.
    pub red: u8,
    /// Green, 0 to 255.
    pub green: u8,
    /// Blue, 0 to 255.
    pub blue: u8,
    /// Opacity: 0 is clear, 255 is solid.
    pub alpha: u8,
}

impl Color {
    /// A solid colour.
    pub const fn rgb(red: u8, green: u8, blue: u8) -> Self {
        Self {
            red,
            green,
            blue,
            alpha: 255,
        }
    }

    /// A colour with opacity.
    pub const fn rgba(red: u8, green: u8, blue: u8, alpha: u8) -> Self {
        Self {
            red,
            green,
            blue,
            alpha,
        }
    }
}

/// A text that is no colour.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not a colour: write \"#rrggbb\" or \"#rrggbbaa\", for example \"#8c8c8c\"")]
pub struct ColorError(String);

impl FromStr for Color {
    type Err = ColorError;

    fn from_str(text: &str) -> Result<Self, ColorError> {
        let wrong = || ColorError(text.to_owned());
        let digits = text.strip_prefix('#').ok_or_else(wrong)?;
        if !matches!(digits.len(), 6 | 8) || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
            return Err(wrong());
        }
        let byte = |at: usize| u8::from_str_radix(&digits[at..at + 2], 16).map_err(|_| wrong());
        let alpha = if digits.len() == 8 { byte(6)? } else { 255 };
        Ok(Self::rgba(byte(0)?, byte(2)?, byte(4)?, alpha))
    }
}

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            red,
            green,
            blue,
            alpha,
        } = self;
        write!(f, "#{red:02x}{green:02x}{blue:02x}")?;
        if *alpha == 255 {
            Ok(())
        } else {
            write!(f, "{alpha:02x}")
        }
    }
}

impl Serialize for Color {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Color {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(serde::de::Error::custom)
    }
}

impl JsonSchema for Color {
    fn schema_name() -> Cow<'static, str> {
        "Color".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "string",
            "description": "A colour with opacity: \"#rrggbb\" or \"#rrggbbaa\", hexadecimal.",
            "pattern": "^#[0-9a-fA-F]{6}([0-9a-fA-F]{2})?$",
        })
    }
}

/// A picture on a surface. Views may use it; the simulation does not.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Texture {
    /// A picture that comes with the program: `"brick"`, `"grass"`, `"metal"`, `"sky"`, `"stone"`,
    /// `"tree"`, `"wood"`, or one of several of a kind by its number, `"grass_1"`.
    Builtin(String),
    /// A picture file, PNG or JPEG, relative to the world file.
    File(String),
}

/// Why a texture is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TextureError {
    pub(crate) message: String,
    pub(crate) help: String,
}

impl Texture {
    /// The kinds of pictures that come with the program.
    pub const BUILTIN: [&str; 7] = ["brick", "grass", "metal", "sky", "stone", "tree", "wood"];

    /// Whether a name is that of a picture that comes with the program.
    pub fn is_builtin(name: &str) -> bool {
        let kind = match name.rsplit_once('_') {
            Some((kind, number)) if number.parse::<u8>().is_ok() => kind,
            _ => name,
        };
        Self::BUILTIN.contains(&kind)
    }

    pub(crate) fn check(&self) -> Result<(), TextureError> {
        match self {
            Self::Builtin(name) if !Self::is_builtin(name) => {
                let kind = name.split('_').next().unwrap_or_default();
                let help = match did_you_mean(kind, Self::BUILTIN) {
                    Some(guess) => format!("did you mean `{guess}`?"),
                    None => format!("known: `{}`", Self::BUILTIN.join("`, `")),
                };
                let message = format!("unknown texture `{name}`");
                Err(TextureError { message, help })
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_is_written_as_it_is_read() {
        for text in ["#8c8c8c", "#cdaf9580", "#000000", "#ffffff00"] {
            let color: Color = text.parse().expect("a colour");
            assert_eq!(color.to_string(), text);
        }
        assert_eq!("#FF6697".parse(), Ok(Color::rgb(255, 102, 151)));
    }

    #[test]
    fn what_is_no_colour_is_refused() {
        for text in [
            "", "#", "8c8c8c", "#8c8c8", "#8c8c8c8", "#8c8c8g", "#+1+1+1", "#ééé", "red",
        ] {
            assert!(text.parse::<Color>().is_err(), "{text}");
        }
    }
}

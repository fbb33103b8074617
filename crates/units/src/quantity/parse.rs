//! Text into quantities, and what is wrong with text that is none.

use super::{Quantity, Unit};
use crate::text::did_you_mean;

/// Why a text is not the quantity that was asked for.
///
/// The messages are written for the person who typed the text: they say what to type instead.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum QuantityError {
    /// There is a number but no unit: `"12"`.
    #[error("{number} needs a unit, for example \"{number} {si_unit}\"")]
    NoUnit {
        /// The number, as it was written.
        number: String,
        /// The unit to propose.
        si_unit: &'static str,
    },

    /// A number stands where a string with a unit belongs, in a format that tells them apart.
    #[error("{number} is a bare number; give a unit, for example \"{number} {si_unit}\"")]
    BareNumber {
        /// The number.
        number: String,
        /// The unit to propose.
        si_unit: &'static str,
    },

    /// There is a unit, but not one of this quantity: `"12 m"` for an angle.
    #[error("unknown unit {unit:?} for {noun}; {}", advice(.suggestion, .units))]
    UnknownUnit {
        /// The unit, as it was written.
        unit: String,
        /// The quantity, with its article: `"an angle"`.
        noun: &'static str,
        /// The spellings that are known.
        units: Vec<&'static str>,
        /// The known spelling that is close to the one written, if one is.
        suggestion: Option<&'static str>,
    },

    /// The text does not begin with a number: `"fast"`, `"1,5 m"`.
    #[error("{text:?} is not a number with a unit; write for example \"1.5 {si_unit}\"")]
    NotANumber {
        /// The whole text.
        text: String,
        /// The unit to propose.
        si_unit: &'static str,
    },

    /// Infinity, NaN, or a number too large for an `f64`.
    #[error("{text:?} is not finite; {noun} must be a finite number")]
    NotFinite {
        /// The whole text.
        text: String,
        /// The quantity, with its article.
        noun: &'static str,
    },
}

/// The second half of the message for an unknown unit.
fn advice(suggestion: &Option<&'static str>, units: &[&'static str]) -> String {
    let list = match units {
        [only] => format!("use {only}"),
        _ => format!("use one of {}", units.join(", ")),
    };
    match suggestion {
        Some(unit) if units.len() > 1 => format!("did you mean {unit:?}? ({list})"),
        _ => list,
    }
}

/// Reads a quantity; the body of every `FromStr`.
pub(super) fn parse<Q: Quantity>(text: &str) -> Result<Q, QuantityError> {
    parse_si(text, Q::NOUN, Q::UNITS).map(Q::from_si)
}

/// [`parse`] without the type, so that it is compiled once.
fn parse_si(text: &str, noun: &'static str, units: &[Unit]) -> Result<f64, QuantityError> {
    let si_unit = units[0].name;
    let whole = text.trim();
    let (number, unit) = whole.split_at(number_length(whole));
    let unit = unit.trim();

    let not_a_number = || {
        let text = whole.to_owned();
        if names_no_finite_number(whole) {
            QuantityError::NotFinite { text, noun }
        } else {
            QuantityError::NotANumber { text, si_unit }
        }
    };
    let value: f64 = number.parse().map_err(|_| not_a_number())?;
    // "1,5 m", "1.2.3 m", "1_000 m": the number goes on in a way we do not read.
    if unit.starts_with(|c: char| {
        c.is_ascii_digit() || matches!(c, ',' | '.' | '_' | '\'' | '+' | '-')
    }) {
        return Err(not_a_number());
    }
    if unit.is_empty() {
        return Err(QuantityError::NoUnit {
            number: number.to_owned(),
            si_unit,
        });
    }

    let spelling = plain_spelling(unit);
    let Some(known) = units.iter().find(|known| known.name == spelling) else {
        return Err(QuantityError::UnknownUnit {
            unit: unit.to_owned(),
            noun,
            units: units.iter().map(|known| known.name).collect(),
            suggestion: did_you_mean(&spelling, units.iter().map(|known| known.name)),
        });
    };

    let si = known.scale.to_si(value);
    if si.is_finite() {
        Ok(si)
    } else {
        Err(QuantityError::NotFinite {
            text: whole.to_owned(),
            noun,
        })
    }
}

/// The length of the decimal number that `text` begins with, in bytes; 0 if it begins with none.
///
/// The `e` of an exponent counts only if digits follow, so that a unit may begin with one.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits_from = |start: usize| {
        let run = bytes[start..]
            .iter()
            .take_while(|byte| byte.is_ascii_digit());
        start + run.count()
    };
    let sign_at = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));

    let start = sign_at(0);
    let mut end = digits_from(start);
    let mut digits = end - start;
    if bytes.get(end) == Some(&b'.') {
        let fraction = digits_from(end + 1);
        digits += fraction - (end + 1);
        end = fraction;
    }
    if digits == 0 {
        return 0;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let exponent = end + 1 + sign_at(end + 1);
        let exponent_end = digits_from(exponent);
        if exponent_end > exponent {
            end = exponent_end;
        }
    }
    end
}

/// Whether the text begins with a spelling of infinity or of NaN.
fn names_no_finite_number(text: &str) -> bool {
    let word: String = text
        .trim_start_matches(['+', '-'])
        .chars()
        .take_while(|c| c.is_ascii_alphabetic())
        .collect::<String>()
        .to_ascii_lowercase();
    matches!(word.as_str(), "inf" | "infinity" | "nan")
}

/// A unit in the spelling of the tables: plain letters for signs that keyboards lack, one space
/// between factors.
fn plain_spelling(unit: &str) -> String {
    let mut plain = String::with_capacity(unit.len());
    for c in unit.chars() {
        match c {
            'µ' | 'μ' => plain.push('u'), // micro sign, Greek mu
            '²' => plain.push_str("^2"),
            '³' => plain.push_str("^3"),
            '°' => plain.push_str("deg"),
            '·' | '⋅' | '*' => plain.push(' '),
            c if c.is_whitespace() => plain.push(' '),
            c => plain.push(c),
        }
    }
    plain
        .split(' ')
        .filter(|word| !word.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

#[cfg(test)]
mod tests {
    use crate::{Acceleration, Angle, Current, Frequency, Length, Quantity, Temperature, Torque};
    use proptest::prelude::*;

    fn fault<Q: Quantity>(text: &str) -> String {
        text.parse::<Q>().unwrap_err().to_string()
    }

    #[test]
    fn numbers_are_read_in_every_usual_form() {
        for (text, metres) in [
            ("2 m", 2.0),
            ("2m", 2.0),
            ("  2 \t m ", 2.0),
            ("+2 m", 2.0),
            ("-2 m", -2.0),
            ("2. m", 2.0),
            (".5 m", 0.5),
            ("-.5 m", -0.5),
            ("2e3 m", 2e3),
            ("2E-3m", 2e-3),
            ("1.5e+2 m", 150.0),
            ("0.1 km", 100.0),
        ] {
            assert_eq!(text.parse(), Ok(Length::si(metres)), "{text}");
        }
    }

    #[test]
    fn signs_that_keyboards_lack_are_read_too() {
        assert_eq!("3 µA".parse(), Ok(Current::from_microamperes(3.0))); // micro sign
        assert_eq!("3 μA".parse(), Ok(Current::from_microamperes(3.0))); // Greek mu
        assert_eq!("9.81 m/s²".parse(), Ok(Acceleration::si(9.81)));
        assert_eq!("180°".parse(), Ok(Angle::HALF_TURN));
        assert_eq!("20 °C".parse(), Ok(Temperature::from_celsius(20.0)));
        for text in ["2 N m", "2 N·m", "2 N*m", "2 N  m"] {
            assert_eq!(text.parse(), Ok(Torque::si(2.0)), "{text}");
        }
    }

    #[test]
    fn a_missing_unit_is_named_and_shown() {
        assert_eq!(
            fault::<Angle>("12"),
            r#"12 needs a unit, for example "12 rad""#
        );
        assert_eq!(
            fault::<Angle>(" -1.5e3 "),
            r#"-1.5e3 needs a unit, for example "-1.5e3 rad""#
        );
    }

    #[test]
    fn an_unknown_unit_lists_the_known_ones() {
        assert_eq!(
            fault::<Angle>("12 m"),
            r#"unknown unit "m" for an angle; use one of rad, deg, turn"#
        );
    }

    #[test]
    fn a_misspelt_unit_is_recognised() {
        assert_eq!(
            fault::<Angle>("12 degs"),
            r#"unknown unit "degs" for an angle; did you mean "deg"? (use one of rad, deg, turn)"#
        );
        assert_eq!(
            fault::<Frequency>("2.4 ghz"),
            r#"unknown unit "ghz" for a frequency; did you mean "GHz"? (use one of Hz, kHz, MHz, GHz)"#
        );
        assert!(fault::<Acceleration>("1 m/s2").contains(r#"did you mean "m/s^2"?"#));
        assert!(fault::<Torque>("1 Nm").contains(r#"did you mean "N m"?"#));
    }

    #[test]
    fn what_is_no_number_says_what_to_write() {
        for text in [
            "", "fast", "m", "1,5 m", "1.2.3 m", "1_000 m", "--1 m", "- 1 m", "1+1 m",
        ] {
            assert_eq!(
                fault::<Length>(text),
                format!("{text:?} is not a number with a unit; write for example \"1.5 m\"")
            );
        }
    }

    #[test]
    fn only_finite_numbers_are_quantities() {
        for text in [
            "inf m", "-inf m", "NaN m", "infinity", "1e999 m", "1e308 km",
        ] {
            assert_eq!(
                fault::<Length>(text),
                format!("{text:?} is not finite; a length must be a finite number")
            );
        }
    }

    proptest! {
        #[test]
        fn any_text_is_read_or_refused(text in ".*") {
            let _ = text.parse::<Length>();
        }

        #[test]
        fn near_misses_are_read_or_refused(text in "[+-]?[0-9.eE+-]{0,6} ?[a-zµ°²·/^ ]{0,4}") {
            if let Ok(length) = text.parse::<Length>() {
                prop_assert!(length.is_finite());
            }
        }
    }
}

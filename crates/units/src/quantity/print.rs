//! Numbers as people write them.

use super::Quantity;
use std::fmt;

/// A number printed plainly in everyday magnitudes and with an exponent outside, so that it reads
/// back as the same bits. A precision of the format is kept to; the width is not looked at.
pub(crate) struct Number(pub(crate) f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = *self;
        let everyday = value == 0.0 || !value.is_finite() || (1e-5..1e16).contains(&value.abs());
        match f.precision() {
            Some(digits) => write!(f, "{value:.digits$}"),
            None if everyday => write!(f, "{value}"),
            None => write!(f, "{value:e}"),
        }
    }
}

/// A number and its unit, in the precision and the width of the format, to the right by default.
pub(crate) fn write_quantity(f: &mut fmt::Formatter<'_>, value: f64, unit: &str) -> fmt::Result {
    let number = Number(value);
    let Some(width) = f.width() else {
        fmt::Display::fmt(&number, f)?;
        return write!(f, " {unit}");
    };
    let text = match f.precision() {
        Some(digits) => format!("{number:.digits$} {unit}"),
        None => format!("{number} {unit}"),
    };
    match f.align() {
        Some(fmt::Alignment::Left) => write!(f, "{text:<width$}"),
        Some(fmt::Alignment::Center) => write!(f, "{text:^width$}"),
        _ => write!(f, "{text:>width$}"),
    }
}

/// A quantity as a person would write it: in the SI unit, or in another one if the number is long in
/// the SI unit and shorter there: `45 deg`, `2442.5 MHz`. It reads back as the same bits.
pub(crate) fn in_shortest_unit<Q: Quantity>(q: Q) -> String {
    let si = q.to_si();
    let same = |text: &String| {
        text.parse::<Q>()
            .is_ok_and(|q| q.to_si().to_bits() == si.to_bits())
    };
    let plain = q.to_string();
    if Number(si).to_string().len() <= LONG {
        return plain;
    }
    let elsewhere = Q::UNITS.iter().filter_map(|unit| {
        let value = unit.scale.of_si(si);
        (0..DIGITS).find_map(|digits| {
            let rounded: f64 = format!("{value:.digits$e}").parse().ok()?;
            Some(format!("{} {}", Number(rounded), unit.name)).filter(same)
        })
    });
    // The first of the shortest; the SI unit, if none is shorter.
    std::iter::once(plain)
        .chain(elsewhere)
        .min_by_key(String::len)
        .unwrap_or_default()
}

/// How many characters a number may have before another unit is tried.
const LONG: usize = 7;
/// How many digits a number in another unit may have.
const DIGITS: usize = 9;

#[cfg(test)]
mod tests {
    use super::in_shortest_unit;
    use crate::{Angle, Enu, Frequency, Length, Quantity, Speed, Temperature, Time, Velocity};

    #[test]
    fn a_long_number_is_written_in_the_unit_that_makes_it_short() {
        for (degrees, text) in [
            (45.0, "45 deg"),
            (5.0, "5 deg"),
            (0.0016, "0.0016 deg"),
            (270.0, "270 deg"),
        ] {
            assert_eq!(in_shortest_unit(Angle::from_degrees(degrees)), text);
        }
        let hertz = |value| in_shortest_unit(Frequency::si(value));
        assert_eq!(hertz(2_442_500_000.0), "2442.5 MHz");
        assert_eq!(hertz(50.0), "50 Hz");
        assert_eq!(in_shortest_unit(Speed::si(50.0 / 3.6)), "50 km/h");
        assert_eq!(in_shortest_unit(Angle::si(0.25)), "0.25 rad");
        assert_eq!(
            in_shortest_unit(Length::si(0.1 + 0.2)),
            "0.30000000000000004 m"
        );
        assert_eq!(in_shortest_unit(Length::si(f64::NAN)), "NaN m");
    }

    fn reads_back<Q: Quantity>(value: f64) {
        let text = in_shortest_unit(Q::from_si(value));
        let read: Q = text.parse().unwrap();
        assert_eq!(read.to_si().to_bits(), value.to_bits(), "{text}");
        assert!(text.len() <= Q::from_si(value).to_string().len(), "{text}");
    }

    proptest::proptest! {
        #[test]
        fn the_shortest_text_reads_back_as_the_same_bits(value in -1e12..1e12_f64, whole in -1000..1000_i32) {
            for value in [value, f64::from(whole), f64::from(whole) / 3.6, f64::from(whole).to_radians()] {
                reads_back::<Angle>(value);
                reads_back::<Length>(value);
                reads_back::<Speed>(value);
                reads_back::<Time>(value);
                reads_back::<Temperature>(value);
            }
        }
    }

    #[test]
    fn everyday_numbers_are_plain_and_others_have_an_exponent() {
        for (value, text) in [
            (0.0, "0 m"),
            (-0.0, "-0 m"),
            (2.0, "2 m"),
            (-0.2, "-0.2 m"),
            (1e-5, "0.00001 m"),
            (1e-6, "1e-6 m"),
            (299_792_458.0, "299792458 m"),
            (1e16, "1e16 m"),
            (f64::INFINITY, "inf m"),
        ] {
            assert_eq!(Length::si(value).to_string(), text);
            assert_eq!(format!("{:?}", Length::si(value)), text);
        }
    }

    #[test]
    fn precision_and_width_are_honoured() {
        let length = Length::si(1.26);
        assert_eq!(format!("{length:.1}"), "1.3 m");
        assert_eq!(format!("{length:9}|"), "   1.26 m|");
        assert_eq!(format!("{length:<9.1}|"), "1.3 m    |");
        assert_eq!(format!("{length:^9.1}|"), "  1.3 m  |");
        let wind = Velocity::<Enu>::from_xyz(1.0, -2.5, 1e-9);
        assert_eq!(wind.to_string(), "(1, -2.5, 1e-9) m/s ENU");
        assert_eq!(format!("{wind:.1}"), "(1.0, -2.5, 0.0) m/s ENU");
    }
}

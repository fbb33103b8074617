//! Numbers as people write them.

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

#[cfg(test)]
mod tests {
    use crate::{Enu, Length, Velocity};

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

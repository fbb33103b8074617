//! Every quantity: text and number are the same thing.

use proptest::prelude::*;
use simbeeotic_units::*;

/// Printed and read again, a quantity has the same bits, and the same text.
fn survives<Q: Quantity>(value: f64) -> Result<(), TestCaseError> {
    let quantity = Q::from_si(value);
    let text = quantity.to_string();
    let back: Q = text
        .parse()
        .map_err(|error| TestCaseError::fail(format!("{text}: {error}")))?;
    prop_assert_eq!(back.to_si().to_bits(), value.to_bits(), "{}", text);
    prop_assert_eq!(back.to_string(), text);
    Ok(())
}

/// One number of each unit is read as what the unit is worth, and the spelling is unique.
fn units_are_sound<Q: Quantity>() {
    assert!(
        Q::NOUN.starts_with("a ") || Q::NOUN.starts_with("an "),
        "{}",
        Q::NOUN
    );
    assert_eq!(
        Q::UNITS[0].scale,
        Scale::ONE,
        "the first unit of {} is SI",
        Q::NOUN
    );
    for (index, unit) in Q::UNITS.iter().enumerate() {
        let one: Q = format!("1 {}", unit.name).parse().unwrap();
        assert_eq!(one.to_si(), unit.scale.to_si(1.0), "{}", unit.name);
        assert!(
            Q::UNITS[..index]
                .iter()
                .all(|other| other.name != unit.name),
            "{}",
            unit.name
        );
    }
    let error = "12".parse::<Q>().unwrap_err().to_string();
    assert_eq!(
        error,
        format!("12 needs a unit, for example \"12 {}\"", Q::UNITS[0].name)
    );
}

/// The same for every quantity.
macro_rules! each_quantity {
    ($($Name:ident)*) => {
        proptest! {
            #[test]
            fn text_to_quantity_to_text_is_the_identity(value in any::<f64>()) {
                // `any` draws no infinity and no NaN unless asked.
                $(survives::<$Name>(value)?;)*
            }
        }

        #[test]
        fn all_units_are_read_and_each_only_once() {
            $(units_are_sound::<$Name>();)*
        }

        #[test]
        fn extreme_numbers_survive() {
            for value in [0.0, -0.0, f64::MIN_POSITIVE, f64::from_bits(1), f64::MAX, f64::MIN, 1e16] {
                $(survives::<$Name>(value).unwrap();)*
            }
        }
    };
}

each_quantity! {
    Acceleration Angle AngularRate Area Charge Conductivity Current DataRate Decibels Density Energy Force
    Circulation Concentration Illuminance LuminousIntensity MassRate RainRate
    Frequency Impulse Length Mass Power PowerLevel Pressure Resistance Speed Temperature Time Torque Voltage
}

proptest! {
    #[test]
    fn headings_and_yaws_survive_text(radians in -100.0..100.0_f64) {
        let heading = Heading::si(radians);
        prop_assert_eq!(heading.to_string().parse(), Ok(heading));
        let yaw = Yaw::si(radians);
        prop_assert_eq!(yaw.to_string().parse(), Ok(yaw));
    }

    #[test]
    fn heading_to_yaw_to_heading_is_the_identity(radians in -100.0..100.0_f64) {
        let heading = Heading::si(radians);
        let back = Heading::from(Yaw::from(heading));
        prop_assert!((back - heading).abs() < Angle::si(2e-15));
        let yaw = Yaw::si(radians);
        let back = Yaw::from(Heading::from(yaw));
        prop_assert!((back - yaw).abs() < Angle::si(2e-15));
        prop_assert!((0.0..std::f64::consts::TAU).contains(&heading.get()));
        prop_assert!(yaw.get() > -std::f64::consts::PI && yaw.get() <= std::f64::consts::PI);
    }

    #[test]
    fn heading_and_yaw_point_to_the_same_side(radians in -10.0..10.0_f64) {
        let heading = Heading::si(radians);
        let (one, other) = (heading.along(Speed::si(1.0)), Yaw::from(heading).along(Speed::si(1.0)));
        prop_assert!(one.distance(other) < Speed::si(1e-14));
        prop_assert!((Attitude::from_heading(heading).heading() - heading).abs() < Angle::si(1e-14));
    }
}

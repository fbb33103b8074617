//! Readings: what sensors give, in a form that can be recorded.

use crate::image::Image;
use crate::message::Thing;
use simbeeotic_units::{
    Acceleration, Angle, AngularRate, Attitude, Charge, Concentration, Current, Decibels, Density,
    Energy, Force, Frame, Frequency, Heading, Illuminance, Length, MagneticField, Pose, Power,
    PowerLevel, Pressure, Quantity, RainRate, Resistance, Speed, Temperature, Time, Torque, Twist,
    V3, VectorQuantity, Voltage,
};
use simbeeotic_world::ObjectKind;

/// One column of a recorded reading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// What it is: `x`, `distance`. Empty if the reading is this one number.
    pub name: &'static str,
    /// What it is counted in, as in scenarios: `m/s^2`; `1` for counts and truths.
    pub unit: &'static str,
}

impl Column {
    /// A column.
    pub const fn new(name: &'static str, unit: &'static str) -> Self {
        Self { name, unit }
    }
}

/// What one reading of a sensor is. Recorders see it as a row of numbers, and as pictures.
///
/// ```
/// use simbeeotic_model::units::Length;
/// use simbeeotic_model::{Column, Reading};
///
/// /// Two gaps at once.
/// #[derive(Clone)]
/// struct Gaps {
///     ahead: Length,
///     below: Length,
/// }
///
/// impl Reading for Gaps {
///     const COLUMNS: &'static [Column] = &[Column::new("ahead", "m"), Column::new("below", "m")];
///
///     fn numbers(&self, to: &mut Vec<f64>) {
///         to.extend([self.ahead.metres(), self.below.metres()]);
///     }
/// }
/// ```
pub trait Reading: Clone + Send + Sync + 'static {
    /// What the numbers are. A reading of varying length (the points of a scan) repeats them.
    const COLUMNS: &'static [Column];

    /// Whether a row of it stands for the same as this row of the true one: the same beam of a scan. If
    /// not, as for things that were found, recorders keep the two lists apart.
    const PAIRED: bool = true;

    /// Appends its numbers, a multiple of as many as there are columns. What is not there (nothing
    /// in range) is NaN.
    fn numbers(&self, to: &mut Vec<f64>);

    /// Its pictures, by name; empty for most. A picture alone is called the empty text.
    fn images(&self) -> Vec<(&'static str, &Image)> {
        Vec::new()
    }
}

macro_rules! one_number {
    ($($Q:ty),* $(,)?) => { $(
        impl Reading for $Q {
            const COLUMNS: &'static [Column] = &[Column::new("", <$Q as Quantity>::UNITS[0].name)];

            fn numbers(&self, to: &mut Vec<f64>) {
                to.push(self.get());
            }
        }
    )* };
}

one_number!(
    Acceleration,
    Angle,
    AngularRate,
    Charge,
    Concentration,
    Current,
    Decibels,
    Density,
    Energy,
    Force,
    Frequency,
    Illuminance,
    Length,
    MagneticField,
    Power,
    PowerLevel,
    Pressure,
    RainRate,
    Resistance,
    Speed,
    Temperature,
    Time,
    Torque,
    Voltage,
);

impl Reading for Heading {
    const COLUMNS: &'static [Column] = &[Column::new("", "rad")];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.push(self.angle().get());
    }
}

impl Reading for f64 {
    const COLUMNS: &'static [Column] = &[Column::new("", "1")];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.push(*self);
    }
}

impl Reading for bool {
    const COLUMNS: &'static [Column] = &[Column::new("", "1")];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.push(f64::from(u8::from(*self)));
    }
}

/// Who or what it is.
///
/// | `kind` | what | `index` |
/// |---|---|---|
/// | 0 | the flat ground | 0 |
/// | 1 | a model | its number |
/// | 2, 3, 4, 5, 6 | an obstacle, structure, flower, person, the terrain | which one of the world's file |
///
/// `item` is the flower of a patch, 0 for all else. All count from 0.
impl Reading for Thing {
    const COLUMNS: &'static [Column] = &[
        Column::new("kind", "1"),
        Column::new("index", "1"),
        Column::new("item", "1"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.extend(match self {
            Self::Ground => [0.0; 3],
            Self::Model(id) => [1.0, f64::from(id.0), 0.0],
            Self::Object(object) => [
                match object.kind {
                    ObjectKind::Obstacle => 2.0,
                    ObjectKind::Structure => 3.0,
                    ObjectKind::Flower => 4.0,
                    ObjectKind::Person => 5.0,
                    ObjectKind::Terrain => 6.0,
                    _ => f64::NAN,
                },
                f64::from(object.index),
                f64::from(object.item),
            ],
        });
    }
}

/// What is not there (nothing in range) is NaN in each column.
impl<R: Reading> Reading for Option<R> {
    const COLUMNS: &'static [Column] = R::COLUMNS;
    const PAIRED: bool = R::PAIRED;

    fn numbers(&self, to: &mut Vec<f64>) {
        match self {
            Some(reading) => reading.numbers(to),
            None => to.extend(R::COLUMNS.iter().map(|_| f64::NAN)),
        }
    }

    fn images(&self) -> Vec<(&'static str, &Image)> {
        self.as_ref().map(Reading::images).unwrap_or_default()
    }
}

/// One after the other: the neighbours in sight. A reading may miss some of the true ones, so the two are
/// not [paired](Reading::PAIRED); a scan is a type of its own.
impl<R: Reading> Reading for Vec<R> {
    const COLUMNS: &'static [Column] = R::COLUMNS;
    const PAIRED: bool = false;

    fn numbers(&self, to: &mut Vec<f64>) {
        for reading in self {
            reading.numbers(to);
        }
    }
}

impl<Q: VectorQuantity, F: Frame> Reading for V3<Q, F> {
    const COLUMNS: &'static [Column] = &[
        Column::new(F::AXES[0], Q::UNITS[0].name),
        Column::new(F::AXES[1], Q::UNITS[0].name),
        Column::new(F::AXES[2], Q::UNITS[0].name),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.extend(self.si().to_array());
    }
}

impl Reading for Attitude {
    const COLUMNS: &'static [Column] = &[
        Column::new("qw", "1"),
        Column::new("qx", "1"),
        Column::new("qy", "1"),
        Column::new("qz", "1"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        let q = self.quat();
        to.extend([q.w, q.x, q.y, q.z]);
    }
}

impl Reading for Pose {
    const COLUMNS: &'static [Column] = &[
        Column::new("x", "m"),
        Column::new("y", "m"),
        Column::new("z", "m"),
        Column::new("qw", "1"),
        Column::new("qx", "1"),
        Column::new("qy", "1"),
        Column::new("qz", "1"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        self.position.numbers(to);
        self.attitude.numbers(to);
    }
}

impl Reading for Twist {
    const COLUMNS: &'static [Column] = &[
        Column::new("vx", "m/s"),
        Column::new("vy", "m/s"),
        Column::new("vz", "m/s"),
        Column::new("wx", "rad/s"),
        Column::new("wy", "rad/s"),
        Column::new("wz", "rad/s"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        self.linear.numbers(to);
        self.angular.numbers(to);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_units::{Accel, Flu};

    fn row<R: Reading>(reading: &R) -> (Vec<f64>, Vec<&'static str>) {
        let mut numbers = Vec::new();
        reading.numbers(&mut numbers);
        (numbers, R::COLUMNS.iter().map(|c| c.unit).collect())
    }

    #[test]
    fn quantities_are_recorded_in_the_unit_they_say() {
        assert_eq!(
            row(&Length::from_millimetres(250.0)),
            (vec![0.25], vec!["m"])
        );
        let pull = Accel::<Flu>::from_xyz(1.0, 2.0, 3.0);
        assert_eq!(row(&pull), (vec![1.0, 2.0, 3.0], vec!["m/s^2"; 3]));
    }

    #[test]
    fn what_is_not_there_is_no_number() {
        let (numbers, units) = row(&None::<Length>);
        assert!(numbers.len() == 1 && numbers[0].is_nan() && units == ["m"]);
        let scan = vec![Some(Length::si(1.0)), None];
        let (numbers, _) = row(&scan);
        assert!(numbers[0] == 1.0 && numbers[1].is_nan());
    }

    #[test]
    fn a_thing_is_told_from_all_others() {
        use simbeeotic_kernel::ModelId;
        use simbeeotic_world::ObjectId;
        let kinds = [
            ObjectKind::Obstacle,
            ObjectKind::Structure,
            ObjectKind::Flower,
            ObjectKind::Person,
            ObjectKind::Terrain,
        ];
        let objects = kinds.map(|kind| Thing::Object(ObjectId::new(kind, 3)));
        let mut rows: Vec<_> = [Thing::Ground, Thing::Model(ModelId(3))]
            .iter()
            .chain(&objects)
            .map(|thing| row(thing).0)
            .collect();
        assert_eq!(rows[1], [1.0, 3.0, 0.0]);
        rows.dedup();
        assert_eq!(rows.len(), 7);
        let nobody = row(&None::<Thing>).0;
        assert!(nobody.len() == 3 && nobody.iter().all(|n| n.is_nan()));
    }

    #[test]
    fn lists_of_what_was_found_are_not_paired_with_the_truth() {
        let paired = [
            <Vec<Length>>::PAIRED,
            <Option<Length>>::PAIRED,
            <Option<Vec<Length>>>::PAIRED,
        ];
        assert_eq!(paired, [false, true, false]);
    }
}

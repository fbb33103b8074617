//! The macros that define a quantity: one line of units, the same face for all.

/// Defines a quantity without arithmetic: number, text, serde, schema, comparison.
///
/// ```text
/// quantity! {
///     /// Documentation.
///     Length = "a length" {
///         "m": Scale::ONE => from_metres, metres;     // the first is SI
///         "mm": Scale::over(1e3);                     // text only
///     }
/// }
/// ```
macro_rules! quantity {
    ($(#[$doc:meta])* $Name:ident = $noun:literal {
        $si:literal : $si_scale:expr $(=> $si_from:ident, $si_get:ident)? ;
        $($unit:literal : $scale:expr $(=> $from:ident, $get:ident)? ;)*
    }) => {
        $(#[$doc])*
        #[doc = ""]
        #[doc = concat!("Units in text: `", $si, "`" $(, ", `", $unit, "`")*, ".")]
        #[derive(Clone, Copy, Default, PartialEq, PartialOrd)]
        pub struct $Name(f64);

        impl $Name {
            #[doc = concat!("From a number of `", $si, "`.")]
            #[inline]
            pub const fn si(value: f64) -> Self {
                Self(value)
            }

            #[doc = concat!("As a number of `", $si, "`.")]
            #[inline]
            pub const fn get(self) -> f64 {
                self.0
            }

            quantity!(@unit $si, $si_scale $(, $si_from, $si_get)?);
            $(quantity!(@unit $unit, $scale $(, $from, $get)?);)*

            /// Whether the number is neither infinite nor NaN.
            #[inline]
            pub const fn is_finite(self) -> bool {
                self.0.is_finite()
            }

            /// The smaller of two; `self` if they do not compare (NaN).
            #[inline]
            #[must_use]
            pub const fn min(self, other: Self) -> Self {
                if other.0 < self.0 { other } else { self }
            }

            /// The larger of two; `self` if they do not compare (NaN).
            #[inline]
            #[must_use]
            pub const fn max(self, other: Self) -> Self {
                if other.0 > self.0 { other } else { self }
            }

            /// Held between two bounds; with the bounds in the wrong order the upper one wins.
            #[inline]
            #[must_use]
            pub const fn clamp(self, low: Self, high: Self) -> Self {
                self.max(low).min(high)
            }

            /// The order of all numbers, NaN included, as [`f64::total_cmp`]: for sorting.
            #[inline]
            pub fn total_cmp(&self, other: &Self) -> std::cmp::Ordering {
                self.0.total_cmp(&other.0)
            }
        }

        /// As the vector times the quantity.
        impl<Q, F> std::ops::Mul<$crate::V3<Q, F>> for $Name
        where
            Q: std::ops::Mul<Self>,
            Q::Output: $crate::VectorQuantity,
        {
            type Output = $crate::V3<Q::Output, F>;
            #[inline]
            fn mul(self, vector: $crate::V3<Q, F>) -> Self::Output {
                vector * self
            }
        }

        impl $crate::Quantity for $Name {
            const NOUN: &'static str = $noun;
            const UNITS: &'static [$crate::Unit] = &[
                $crate::Unit { name: $si, scale: $si_scale },
                $($crate::Unit { name: $unit, scale: $scale },)*
            ];

            #[inline]
            fn from_si(value: f64) -> Self {
                Self(value)
            }

            #[inline]
            fn to_si(self) -> f64 {
                self.0
            }
        }

        impl std::fmt::Display for $Name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                $crate::quantity::print::write_quantity(f, self.0, $si)
            }
        }

        /// As [`Display`](std::fmt::Display).
        impl std::fmt::Debug for $Name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                std::fmt::Display::fmt(self, f)
            }
        }

        impl std::str::FromStr for $Name {
            type Err = $crate::QuantityError;

            fn from_str(text: &str) -> Result<Self, Self::Err> {
                $crate::quantity::parse::parse(text)
            }
        }

        impl serde::Serialize for $Name {
            fn serialize<S: serde::Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
                $crate::quantity::serial::serialize(*self, s)
            }
        }

        impl<'de> serde::Deserialize<'de> for $Name {
            fn deserialize<D: serde::Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
                $crate::quantity::serial::deserialize(d)
            }
        }

        impl schemars::JsonSchema for $Name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($Name).into()
            }

            fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
                $crate::quantity::serial::schema::<Self>()
            }
        }
    };

    (@unit $unit:literal, $scale:expr) => {};
    (@unit $unit:literal, $scale:expr, $from:ident, $get:ident) => {
        #[doc = concat!("From a number of `", $unit, "`.")]
        #[inline]
        pub const fn $from(value: f64) -> Self {
            Self($scale.to_si(value))
        }

        #[doc = concat!("As a number of `", $unit, "`.")]
        #[inline]
        pub const fn $get(self) -> f64 {
            $scale.of_si(self.0)
        }
    };
}

/// Defines a quantity that can be added and scaled: [`quantity!`] with arithmetic.
macro_rules! linear_quantity {
    ($(#[$doc:meta])* $Name:ident = $($rest:tt)*) => {
        quantity! { $(#[$doc])* $Name = $($rest)* }

        impl $Name {
            /// Nothing of it.
            pub const ZERO: Self = Self(0.0);

            /// Without its sign.
            #[inline]
            #[must_use]
            pub const fn abs(self) -> Self {
                Self(self.0.abs())
            }
        }

        impl std::ops::Add for $Name {
            type Output = Self;
            #[inline]
            fn add(self, other: Self) -> Self {
                Self(self.0 + other.0)
            }
        }

        impl std::ops::Sub for $Name {
            type Output = Self;
            #[inline]
            fn sub(self, other: Self) -> Self {
                Self(self.0 - other.0)
            }
        }

        impl std::ops::Neg for $Name {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl std::ops::Mul<f64> for $Name {
            type Output = Self;
            #[inline]
            fn mul(self, factor: f64) -> Self {
                Self(self.0 * factor)
            }
        }

        impl std::ops::Mul<$Name> for f64 {
            type Output = $Name;
            #[inline]
            fn mul(self, quantity: $Name) -> $Name {
                $Name(self * quantity.0)
            }
        }

        impl std::ops::Div<f64> for $Name {
            type Output = Self;
            #[inline]
            fn div(self, divisor: f64) -> Self {
                Self(self.0 / divisor)
            }
        }

        /// The ratio of two, a bare number.
        impl std::ops::Div for $Name {
            type Output = f64;
            #[inline]
            fn div(self, other: Self) -> f64 {
                self.0 / other.0
            }
        }

        impl std::ops::AddAssign for $Name {
            #[inline]
            fn add_assign(&mut self, other: Self) {
                self.0 += other.0;
            }
        }

        impl std::ops::SubAssign for $Name {
            #[inline]
            fn sub_assign(&mut self, other: Self) {
                self.0 -= other.0;
            }
        }

        impl std::ops::MulAssign<f64> for $Name {
            #[inline]
            fn mul_assign(&mut self, factor: f64) {
                self.0 *= factor;
            }
        }

        impl std::ops::DivAssign<f64> for $Name {
            #[inline]
            fn div_assign(&mut self, divisor: f64) {
                self.0 /= divisor;
            }
        }

        impl std::iter::Sum for $Name {
            fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
                all.fold(Self::ZERO, |sum, one| sum + one)
            }
        }

        impl<'a> std::iter::Sum<&'a $Name> for $Name {
            fn sum<I: Iterator<Item = &'a Self>>(all: I) -> Self {
                all.copied().sum()
            }
        }
    };
}

/// Defines a quantity of which vectors are made: [`linear_quantity!`] with [`VectorQuantity`](crate::VectorQuantity).
macro_rules! vector_quantity {
    ($(#[$doc:meta])* $Name:ident = $($rest:tt)*) => {
        linear_quantity! { $(#[$doc])* $Name = $($rest)* }

        impl $crate::VectorQuantity for $Name {}
    };
}

pub(super) use {linear_quantity, quantity, vector_quantity};

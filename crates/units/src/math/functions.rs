//! The functions of `libm` under their usual names, and what angles need besides.

use std::f64::consts::{PI, TAU};

/// The sine of an angle in radians.
#[inline]
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// The cosine of an angle in radians.
#[inline]
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// The tangent of an angle in radians.
#[inline]
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// The angle in radians, -π/2 to π/2, whose sine is `x`; NaN outside [-1, 1].
#[inline]
pub fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// The angle in radians, 0 to π, whose cosine is `x`; NaN outside [-1, 1].
#[inline]
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}

/// The angle in radians, -π/2 to π/2, whose tangent is `x`.
#[inline]
pub fn atan(x: f64) -> f64 {
    libm::atan(x)
}

/// The hyperbolic tangent.
#[inline]
pub fn tanh(x: f64) -> f64 {
    libm::tanh(x)
}

/// e to the power of `x`.
#[inline]
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// `exp(x) - 1` without loss of digits near 0.
#[inline]
pub fn exp_m1(x: f64) -> f64 {
    libm::expm1(x)
}

/// The natural logarithm; minus infinity at 0, NaN below.
#[inline]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// `ln(1 + x)` without loss of digits near 0.
#[inline]
pub fn ln_1p(x: f64) -> f64 {
    libm::log1p(x)
}

/// The logarithm to base 2; minus infinity at 0, NaN below.
#[inline]
pub fn log2(x: f64) -> f64 {
    libm::log2(x)
}

/// The logarithm to base 10; minus infinity at 0, NaN below.
#[inline]
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}

/// The error function, `2/√π ∫₀ˣ exp(-t²) dt`.
#[inline]
pub fn erf(x: f64) -> f64 {
    libm::erf(x)
}

/// The complement of the error function, `1 - erf(x)`, without loss of digits for large `x`.
#[inline]
pub fn erfc(x: f64) -> f64 {
    libm::erfc(x)
}

/// Sine and cosine of an angle in radians; the bits of [`sin`] and of [`cos`].
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// The angle in radians, -π to π, of the point (`x`, `y`), counter-clockwise from the x axis;
/// 0 at the origin.
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// `base` to the power of `exponent`.
#[inline]
pub fn pow(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// `√(x² + y²)` without overflow on the way.
#[inline]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// `sin(x) / x`, and 1 at 0: what rotation by a small angle needs.
pub fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-4 {
        // The series; the next term, x⁶/5040, is below half a bit of 1.
        let square = x * x;
        1.0 - square / 6.0 * (1.0 - square / 20.0)
    } else {
        sin(x) / x
    }
}

/// The angle, in radians, of the same direction in (-π, π]. What lies there already keeps its
/// bits; infinity and NaN become NaN.
pub fn wrap_signed(angle: f64) -> f64 {
    if angle > -PI && angle <= PI {
        return angle;
    }
    let positive = wrap_positive(angle);
    if positive > PI {
        positive - TAU
    } else {
        positive
    }
}

/// The angle, in radians, of the same direction in [0, 2π). What lies there already keeps its
/// bits; infinity and NaN become NaN.
pub fn wrap_positive(angle: f64) -> f64 {
    let rest = angle % TAU; // exact, with the sign of `angle`
    let positive = if rest < 0.0 { rest + TAU } else { rest };
    // A tiny negative angle rounds up to a whole turn. Adding 0 turns -0 into 0.
    if positive >= TAU { 0.0 } else { positive + 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::normal_quantile;
    use proptest::prelude::*;

    #[test]
    fn every_machine_computes_these_bits() {
        // A fold over ten thousand results; another number here means that a run on this machine
        // differs from the same run elsewhere.
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        let mut fold = |x: f64| hash = (hash ^ x.to_bits()).wrapping_mul(0x0100_0000_01b3);
        for n in 1..1000 {
            let x = f64::from(n) * 0.01;
            [
                sin(x),
                cos(x),
                tan(x),
                atan2(x, 3.0),
                exp(-x),
                ln(x),
                log10(x),
                pow(10.0, -x),
            ]
            .into_iter()
            .chain([
                erfc(x),
                acos(x * 0.1),
                hypot(x, 2.0),
                normal_quantile(x * 0.1),
            ])
            .for_each(&mut fold);
        }
        assert_eq!(hash, 0x0760_5481_1cea_02cf, "found {hash:#018x}");
    }

    #[test]
    fn wrapping_keeps_to_its_range() {
        for (angle, signed, positive) in [
            (0.0, 0.0, 0.0),
            (PI, PI, PI),
            (-PI, PI, PI),
            (TAU, 0.0, 0.0),
            (-TAU, 0.0, 0.0),
            (-1e-300, -1e-300, 0.0),
            (3.0, 3.0, 3.0),
            (4.0, 4.0 - TAU, 4.0),
            (-3.0, -3.0, TAU - 3.0),
        ] {
            assert_eq!(wrap_signed(angle), signed, "{angle}");
            assert_eq!(wrap_positive(angle), positive, "{angle}");
        }
        assert!(wrap_positive(-0.0).is_sign_positive());
        assert!(wrap_signed(f64::INFINITY).is_nan() && wrap_positive(f64::NAN).is_nan());
    }

    proptest! {
        #[test]
        fn wrapping_keeps_the_direction(angle in -1e4..1e4_f64) {
            for wrapped in [wrap_signed(angle), wrap_positive(angle)] {
                prop_assert!((sin(wrapped) - sin(angle)).abs() < 1e-11);
                prop_assert!((cos(wrapped) - cos(angle)).abs() < 1e-11);
            }
            prop_assert!(wrap_signed(angle) > -PI && wrap_signed(angle) <= PI);
            prop_assert!((0.0..TAU).contains(&wrap_positive(angle)));
        }

        #[test]
        fn sinc_is_smooth_where_the_series_takes_over(x in -2e-4..2e-4_f64) {
            let exact = if x == 0.0 { 1.0 } else { sin(x) / x };
            prop_assert!((sinc(x) - exact).abs() <= 2.0 * f64::EPSILON);
        }
    }
}

//! Logarithm, exponential and arc tangent for media: f32 polynomials.
//!
//! Made of the four operations, comparisons and bits alone, so the same on every machine. Near-minimax
//! fits at Chebyshev nodes.

use std::f32::consts::{FRAC_PI_2, LN_2, LOG2_E, PI, SQRT_2};

/// Base 2 logarithm of a normal positive number, to 1e-7 plus the rounding of the result.
#[inline]
pub(super) fn log2(x: f32) -> f32 {
    // x = 2^e m with m from 1/sqrt 2 to sqrt 2.
    let bits = x.to_bits();
    let mut e = (bits >> 23) as i32 - 127;
    let mut m = f32::from_bits(bits & 0x007f_ffff | 0x3f80_0000);
    if m > SQRT_2 {
        m *= 0.5;
        e += 1;
    }
    let y = m - 1.0;
    let p = polynomial(
        y,
        &[
            LOG2_E,
            -0.721_347_36,
            0.480_898_2,
            -0.360_696_64,
            0.288_568_9,
            -0.239_619_05,
            0.204_575_3,
            -0.191_024_99,
            0.186_312_07,
            -0.110_201_55,
        ],
    );
    e as f32 + y * p
}

/// 2 to the power of `x`, to 2e-7 of its value; 0 below the range of f32, its greatest number above.
#[inline]
pub(super) fn exp2(x: f32) -> f32 {
    if x < -125.5 {
        return 0.0;
    }
    let x = x.min(127.0);
    let whole = (x + 0.5).floor();
    let p = polynomial(
        x - whole,
        &[
            1.0,
            LN_2,
            0.240_226_5,
            0.055_503_27,
            0.009_618_026,
            0.001_340_043_2,
            0.000_154_697_3,
        ],
    );
    p * f32::from_bits(((whole as i32 + 127) as u32) << 23)
}

/// `base` to the power of `exponent`; 0 for a base of 0 or less.
#[inline]
pub(super) fn pow(base: f32, exponent: f32) -> f32 {
    if base < f32::MIN_POSITIVE {
        return 0.0;
    }
    exp2(exponent * log2(base))
}

/// A ratio of decibels as a factor.
#[inline]
pub(super) fn ratio(db: f32) -> f32 {
    // log2(10) / 10
    exp2(db * 0.332_192_8)
}

/// The angle of (x, y), -pi to pi, to 4e-7; 0 for the zero vector.
#[inline]
pub(super) fn atan2(y: f32, x: f32) -> f32 {
    let (ax, ay) = (x.abs(), y.abs());
    let (low, high) = if ax < ay { (ax, ay) } else { (ay, ax) };
    if high < f32::MIN_POSITIVE {
        return 0.0;
    }
    let r = low / high;
    let mut angle = r * polynomial(
        r * r,
        &[
            1.0,
            -0.333_330_67,
            0.199_924_84,
            -0.142_025_7,
            0.106_367_54,
            -0.074_954_45,
            0.042_587_61,
            -0.016_005_03,
            0.002_834_064_3,
        ],
    );
    if ax < ay {
        angle = FRAC_PI_2 - angle;
    }
    if x < 0.0 {
        angle = PI - angle;
    }
    if y < 0.0 { -angle } else { angle }
}

/// Horner's rule, coefficients from the constant on.
#[inline(always)]
fn polynomial(x: f32, coefficients: &[f32]) -> f32 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_units::math;

    #[test]
    fn they_agree_with_the_exact_functions() {
        for step in 1..20_000 {
            let x = step as f32 * 0.01;
            let off = f64::from(log2(x)) - math::log2(f64::from(x));
            assert!(off.abs() < 6e-7, "log2 {x}: {off}");

            let x = step as f32 * 0.01 - 100.0;
            let exact = math::pow(2.0, f64::from(x));
            let off = f64::from(exp2(x)) / exact - 1.0;
            assert!(off.abs() < 3e-7, "2^{x}: {off}");

            let turn = f64::from(step) * 1e-3;
            let (sin, cos) = math::sin_cos(turn);
            let (y, x) = (sin as f32 * 3.0, cos as f32 * 3.0);
            let off = f64::from(atan2(y, x)) - math::atan2(f64::from(y), f64::from(x));
            assert!(off.abs() < 5e-7, "atan2 {y} {x}: {off}");
        }
    }

    #[test]
    fn the_ends_are_right() {
        assert_eq!((exp2(0.0), exp2(-200.0), pow(0.0, 2.0)), (1.0, 0.0, 0.0));
        assert_eq!((log2(1.0), log2(0.5), log2(8.0)), (0.0, -1.0, 3.0));
        assert!(exp2(500.0).is_finite());
        assert_eq!(atan2(0.0, 0.0), 0.0);
        assert_eq!(atan2(0.0, -2.0), PI);
        assert_eq!(atan2(-2.0, 0.0), -FRAC_PI_2);
        assert!((ratio(3.0) - 1.995_262_3).abs() < 1e-6);
    }
}

//! Logarithm, power, and the waves of a circle for rows of `f32` and `f64`: no table, no branch, no call, so
//! that loops over them become vector code; and what antennas ask, one direction at a time. Only the four
//! operations, comparisons and bits: the same on every machine.
//!
//! Errors hold for what radio asks: powers and gains between 1e-37 and 1e37.

use std::f32::consts::{FRAC_PI_2, LN_2, PI};

/// The base-2 logarithm of a normal number above 0: off by at most 1e-6, and by rounding.
///
/// With `x = 2^e m` and `m` from `sqrt(1/2)` to `sqrt(2)`: `log2 m = 2 atanh(s) / ln 2` with
/// `s = (m - 1) / (m + 1)`, `|s| < 0.172`, and four terms of the series of `atanh`.
#[inline(always)]
pub(crate) fn log2(x: f32) -> f32 {
    const SQRT_HALF_BITS: u32 = 0x3f35_04f3;
    let shifted = x.to_bits().wrapping_sub(SQRT_HALF_BITS);
    let exponent = (shifted as i32) >> 23;
    let mantissa = f32::from_bits((shifted & 0x007f_ffff).wrapping_add(SQRT_HALF_BITS));
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let s2 = s * s;
    let series = 1.0 + s2 * (1.0 / 3.0 + s2 * (0.2 + s2 * (1.0 / 7.0)));
    exponent as f32 + (2.0 / LN_2) * s * series
}

/// The natural logarithm of a normal number above 0.
#[inline(always)]
pub(crate) fn ln(x: f32) -> f32 {
    log2(x) * LN_2
}

/// `2^x`, off by at most 4e-7 of itself. Held at `2^-126` and `2^126` outside.
#[inline(always)]
pub(crate) fn exp2(x: f32) -> f32 {
    // Adding this rounds to a whole number, which then stands in the low bits.
    const ROUND: f32 = 12_582_912.0;
    let low = if x > -126.0 { x } else { -126.0 };
    let held = if low < 126.0 { low } else { 126.0 };
    let whole = (held + ROUND) - ROUND;
    let bits = (held + ROUND).to_bits().wrapping_sub(ROUND.to_bits());
    // e^t with |t| <= ln(2) / 2: seven terms.
    let t = (held - whole) * LN_2;
    let power = 1.0
        + t * (1.0
            + t * (0.5
                + t * (1.0 / 6.0 + t * (1.0 / 24.0 + t * (1.0 / 120.0 + t * (1.0 / 720.0))))));
    f32::from_bits(power.to_bits().wrapping_add(bits << 23))
}

/// `base` to the power of `exponent`; 0 for a base of 0 or less.
#[inline]
pub(crate) fn pow(base: f32, exponent: f32) -> f32 {
    if base < f32::MIN_POSITIVE {
        return 0.0;
    }
    exp2(exponent * log2(base))
}

/// A ratio of decibels as a factor. Held at `2^-126` and `2^126`, 379 dB, outside.
#[inline]
pub(crate) fn ratio(db: f32) -> f32 {
    // log2(10) / 10
    exp2(db * 0.332_192_8)
}

/// `cos(2 pi t)` for `t` in turns, `|t| < 2^21`: off by at most 2e-4, and from `t`'s rounding. What a
/// random field is made of: there it is the wave that matters, not its exact form.
#[inline(always)]
pub(crate) fn wave(turns: f32) -> f32 {
    const ROUND: f32 = 12_582_912.0;
    let rest = turns - ((turns + ROUND) - ROUND);
    // cos(2 pi t) = sin(2 pi (1/4 - |t|)): the least squares odd polynomial of degree 5 over [-1/4, 1/4].
    let y = 0.25 - rest.abs();
    let y2 = y * y;
    y * (6.281_747 + y2 * (-41.133_23 + y2 * 74.168_24))
}

/// Sine and cosine of `2 pi t`, `t` in turns, `|t| < 2^50`: off by at most 1e-8.
#[inline(always)]
pub(crate) fn sin_cos_turns(turns: f64) -> (f64, f64) {
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let rest = turns - ((turns + ROUND) - ROUND);
    let cos = sine_of_quarter(0.25 - rest.abs());
    // sin(2 pi t): t beyond a quarter is folded back.
    let folded = if rest.abs() > 0.25 {
        0.5 - rest.abs()
    } else {
        rest.abs()
    };
    (sine_of_quarter(folded).copysign(rest), cos)
}

/// Sine and cosine of `2 pi t` for `t` from 0 to 1, in `f32`: off by at most 5e-7.
#[inline(always)]
pub(crate) fn sin_cos_turns_f32(turns: f32) -> [f32; 2] {
    // From -1/2 to 1/2, where -sin(2 pi (t - 1/2)) is sin(2 pi t).
    let rest = turns - 0.5;
    let fold = 0.25 - (rest.abs() - 0.25).abs();
    let sin = sine_of_quarter_f32(fold).copysign(-rest);
    [sin, -sine_of_quarter_f32(0.25 - rest.abs())]
}

/// `sin(2 pi t)` for `|t| <= 1/4`: the series up to the 11th power.
#[inline(always)]
fn sine_of_quarter_f32(turns: f32) -> f32 {
    let x = turns * std::f32::consts::TAU;
    let z = x * x;
    let mut sum = -1.0 / 39_916_800.0;
    for factorial in [362_880.0, -5040.0, 120.0, -6.0, 1.0] {
        sum = sum * z + 1.0 / factorial;
    }
    x * sum
}

/// The angle of (x, y), -pi to pi, to 4e-7; 0 for the zero vector. A near-minimax fit at Chebyshev nodes.
#[inline]
pub(crate) fn atan2(y: f32, x: f32) -> f32 {
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

/// Two even draws in (0, 1) from one of 64 bits: odd multiples of `2^-24`, which `f32` holds exactly.
#[inline(always)]
pub(crate) fn shares(draw: u64) -> [f32; 2] {
    let share = |half: u32| (2 * (half >> 9) + 1) as f32 * (1.0 / 16_777_216.0);
    [share((draw >> 32) as u32), share(draw as u32)]
}

/// `sin(2 pi t)` for `|t| <= 1/4`: the series up to the 15th power.
#[inline(always)]
fn sine_of_quarter(turns: f64) -> f64 {
    let x = turns * std::f64::consts::TAU;
    let z = x * x;
    let mut sum = -1.0 / 1_307_674_368_000.0;
    for factorial in [
        6_227_020_800.0,
        -39_916_800.0,
        362_880.0,
        -5040.0,
        120.0,
        -6.0,
        1.0,
    ] {
        sum = sum * z + 1.0 / factorial;
    }
    x * sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_units::math;

    #[test]
    fn logarithms_and_powers_are_right_to_six_digits() {
        for i in 0..200_000 {
            let x = (f64::from(i) * 0.00125 - 125.0) as f32;
            let power = f64::from(exp2(x));
            let exact = math::pow(2.0, f64::from(x));
            assert!(
                (power / exact - 1.0).abs() < 4e-7,
                "2^{x} is {exact}, not {power}"
            );
            let back = f64::from(log2(exact as f32));
            let error = (back - math::log2(f64::from(exact as f32))).abs();
            assert!(
                error < 1e-6 + 6e-8 * back.abs(),
                "log2 {exact}: off by {error}"
            );
        }
        assert_eq!((log2(1.0), exp2(0.0)), (0.0, 1.0));
        assert!(exp2(-1000.0) < 1.2e-38 && exp2(1000.0).is_finite());
    }

    #[test]
    fn waves_are_cosines() {
        let mut square = 0.0;
        for i in 0..100_000 {
            let turns = (f64::from(i) - 50_000.0) * 1e-4;
            let (sin, cos) = math::sin_cos(std::f64::consts::TAU * turns);
            let rough = f64::from(wave(turns as f32));
            assert!((rough - cos).abs() < 3e-4, "{turns}: {rough} for {cos}");
            let (s, c) = sin_cos_turns(turns);
            assert!((s - sin).abs() < 1e-8 && (c - cos).abs() < 1e-8, "{turns}");
            square += rough * rough;
            if (0.0..1.0).contains(&turns) {
                let [s, c] = sin_cos_turns_f32(turns as f32).map(f64::from);
                assert!((s - sin).abs() < 1e-6 && (c - cos).abs() < 1e-6, "{turns}");
            }
        }
        assert!(
            (square / 100_000.0 - 0.5).abs() < 2e-5,
            "mean square {square}"
        );
    }

    #[test]
    fn angles_are_right_to_six_digits() {
        for step in 1..20_000 {
            let (sin, cos) = math::sin_cos(f64::from(step) * 1e-3);
            let (y, x) = (sin as f32 * 3.0, cos as f32 * 3.0);
            let off = f64::from(atan2(y, x)) - math::atan2(f64::from(y), f64::from(x));
            assert!(off.abs() < 5e-7, "atan2 {y} {x}: {off}");
        }
        assert_eq!(atan2(0.0, 0.0), 0.0);
        assert_eq!(atan2(0.0, -2.0), PI);
        assert_eq!(atan2(-2.0, 0.0), -FRAC_PI_2);
    }

    #[test]
    fn powers_of_gains_and_ratios_of_decibels_are_right_to_five_digits() {
        for (base, exponent) in [(0.5, 1.0), (0.25, 3.5), (1.0, 40.0), (0.9, 12.0)] {
            let exact = math::pow(f64::from(base), f64::from(exponent));
            let off = f64::from(pow(base, exponent)) / exact - 1.0;
            assert!(off.abs() < 1e-5, "{base}^{exponent}: {off}");
        }
        assert_eq!((pow(0.0, 2.0), pow(-1.0, 2.0)), (0.0, 0.0));
        assert_eq!((log2(0.5), log2(8.0)), (-1.0, 3.0));
        assert!((ratio(3.0) - 1.995_262_3).abs() < 1e-6);
        assert!(ratio(f32::NEG_INFINITY) < 1.2e-38);
    }
}

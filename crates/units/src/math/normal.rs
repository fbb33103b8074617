//! The normal distribution.

use super::{erfc, ln};
use std::f64::consts::FRAC_1_SQRT_2;

/// The probability that a standard normal variable is at most `x`: `erfc(-x/√2) / 2`.
///
/// Keeps its relative accuracy in the lower tail, down to `x = -37`.
pub fn normal_cdf(x: f64) -> f64 {
    0.5 * erfc(-x * FRAC_1_SQRT_2)
}

/// The value below which a standard normal variable lies with probability `p`.
///
/// Minus infinity at 0, infinity at 1, NaN outside [0, 1]. Relative accuracy about 1e-16 in exact
/// arithmetic for `min(p, 1 - p)` of at least 1e-316. One division and one polynomial of degree 7
/// above and below for the middle 85 %; a logarithm and a square root besides for the tails.
/// Monotone to within rounding, odd about 1/2 as far as `p` and `1 - p` are both exact.
///
/// Source: M. J. Wichura, "Algorithm AS 241: The Percentage Points of the Normal Distribution",
/// Applied Statistics 37(3), 1988, pp. 477-484, routine PPND16.
pub fn normal_quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180_625 - q * q; // 0.425² - q²
        return q * ratio(r, &CENTRE);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    if tail <= 0.0 {
        return if tail < 0.0 {
            f64::NAN
        } else {
            f64::INFINITY.copysign(q)
        };
    }
    let r = (-ln(tail)).sqrt();
    let size = if r <= 5.0 {
        ratio(r - 1.6, &MIDDLE)
    } else {
        ratio(r - 5.0, &FAR)
    };
    size.copysign(q)
}

// The coefficients below have more digits than an `f64` holds: they are printed here as they are in
// the paper, to be compared with it.

/// Numerator and denominator, lowest power first.
type Rational = ([f64; 8], [f64; 8]);

/// `|p - 1/2| ≤ 0.425`: coefficients a and b of the paper.
#[expect(clippy::excessive_precision, reason = "as printed in the paper")]
const CENTRE: Rational = (
    [
        3.387_132_872_796_366_608_0,
        1.331_416_678_917_843_774_5e2,
        1.971_590_950_306_551_442_7e3,
        1.373_169_376_550_946_112_5e4,
        4.592_195_393_154_987_145_7e4,
        6.726_577_092_700_870_085_3e4,
        3.343_057_558_358_812_810_5e4,
        2.509_080_928_730_122_672_7e3,
    ],
    [
        1.0,
        4.231_333_070_160_091_125_2e1,
        6.871_870_074_920_579_083_0e2,
        5.394_196_021_424_751_107_7e3,
        2.121_379_430_158_659_586_7e4,
        3.930_789_580_009_271_061_0e4,
        2.872_908_573_572_194_267_4e4,
        5.226_495_278_852_854_561_0e3,
    ],
);

/// Tails with `√(-ln p) ≤ 5`: coefficients c and d of the paper.
#[expect(clippy::excessive_precision, reason = "as printed in the paper")]
const MIDDLE: Rational = (
    [
        1.423_437_110_749_683_577_34,
        4.630_337_846_156_545_295_90,
        5.769_497_221_460_691_405_50,
        3.647_848_324_763_204_605_04,
        1.270_458_252_452_368_382_58,
        2.417_807_251_774_506_117_70e-1,
        2.272_384_498_926_918_458_33e-2,
        7.745_450_142_783_414_076_40e-4,
    ],
    [
        1.0,
        2.053_191_626_637_758_821_87,
        1.676_384_830_183_803_849_40,
        6.897_673_349_851_000_045_50e-1,
        1.481_039_764_274_800_745_90e-1,
        1.519_866_656_361_645_719_66e-2,
        5.475_938_084_995_344_946_00e-4,
        1.050_750_071_644_416_843_24e-9,
    ],
);

/// Tails beyond: coefficients e and f of the paper.
#[expect(clippy::excessive_precision, reason = "as printed in the paper")]
const FAR: Rational = (
    [
        6.657_904_643_501_103_777_20,
        5.463_784_911_164_114_369_90,
        1.784_826_539_917_291_335_80,
        2.965_605_718_285_048_912_30e-1,
        2.653_218_952_657_612_309_30e-2,
        1.242_660_947_388_078_438_60e-3,
        2.711_555_568_743_487_578_15e-5,
        2.010_334_399_292_288_132_65e-7,
    ],
    [
        1.0,
        5.998_322_065_558_879_376_90e-1,
        1.369_298_809_227_358_053_10e-1,
        1.487_536_129_085_061_485_25e-2,
        7.868_691_311_456_132_591_00e-4,
        1.846_318_317_510_054_681_80e-5,
        1.421_511_758_316_445_888_70e-7,
        2.044_263_103_389_939_785_64e-15,
    ],
);

/// The quotient of two polynomials of degree 7.
///
/// Estrin's scheme: three steps that wait for each other instead of Horner's seven, and so half the
/// time (15 ns instead of 30 for a quantile), with the same number of roundings to within one.
#[inline]
fn ratio(r: f64, (above, below): &Rational) -> f64 {
    let (r2, r4) = (r * r, (r * r) * (r * r));
    let estrin = |c: &[f64; 8]| {
        let low = (c[0] + c[1] * r) + (c[2] + c[3] * r) * r2;
        let high = (c[4] + c[5] * r) + (c[6] + c[7] * r) * r2;
        low + high * r4
    };
    estrin(above) / estrin(below)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Quantiles computed with 60 decimal digits (Newton's method on `erfc`), rounded to 20. The
    /// probability is the `f64` nearest to what is written, hence 0.9 and 0.1 differ in digit 15.
    #[expect(
        clippy::excessive_precision,
        reason = "one digit more than an f64 holds, to be sure"
    )]
    const KNOWN: [(f64, f64); 21] = [
        (1e-300, -37.047_096_299_361_199_24),
        (1e-100, -21.273_453_560_965_324_29),
        (1e-20, -9.262_340_089_798_407_58),
        (1.110_223_024_625_156_5e-16, -8.209_536_151_601_386_856),
        (1e-10, -6.361_340_902_404_056_199),
        (1.388_794_386_496_402_1e-11, -6.657_904_643_501_103_584), // where the pieces meet
        (1e-5, -4.264_890_793_922_824_610),
        (0.001, -3.090_232_306_167_813_535),
        (0.01, -2.326_347_874_040_841_093),
        (0.025, -1.959_963_984_540_054_212),
        (0.075, -1.439_531_470_938_455_935), // where the pieces meet
        (0.1, -1.281_551_565_544_600_435),
        (0.25, -0.674_489_750_196_081_743_2),
        (0.4, -0.253_347_103_135_799_741_3),
        (0.499_99, -2.506_628_274_896_000_853e-5),
        (0.51, 0.025_068_908_258_711_058_03),
        (0.75, 0.674_489_750_196_081_743_2),
        (0.9, 1.281_551_565_544_600_594),
        (0.975, 1.959_963_984_540_053_856),
        (0.999, 3.090_232_306_167_813_278),
        (0.999_999_999_999_999_9, 8.209_536_151_601_386_856),
    ];

    #[test]
    fn quantile_agrees_with_sixty_digit_values() {
        for (p, expected) in KNOWN {
            let found = normal_quantile(p);
            let error = ((found - expected) / expected).abs();
            assert!(error < 1e-15, "p = {p}: {found}, not {expected}: {error:e}");
        }
    }

    #[test]
    fn the_test_values_of_the_paper_come_out() {
        assert!((normal_quantile(0.25) + 0.674_489_750_196_081_7).abs() < 1e-15);
        assert!((normal_quantile(0.001) + 3.090_232_306_167_814).abs() < 4e-15);
        assert!((normal_quantile(1e-20) + 9.262_340_089_798_408).abs() < 1e-14);
    }

    #[test]
    fn the_ends_are_infinite_and_beyond_is_nothing() {
        assert_eq!(normal_quantile(0.0), f64::NEG_INFINITY);
        assert_eq!(normal_quantile(1.0), f64::INFINITY);
        assert_eq!(normal_quantile(0.5), 0.0);
        for p in [
            -1e-300,
            -1.0,
            1.0 + f64::EPSILON,
            2.0,
            f64::INFINITY,
            f64::NAN,
        ] {
            assert!(normal_quantile(p).is_nan(), "p = {p}");
        }
        let smallest = f64::from_bits(1);
        assert!(normal_quantile(smallest) < -38.0 && normal_quantile(smallest).is_finite());
    }

    proptest! {
        #[test]
        fn the_distribution_of_the_quantile_is_the_probability(
            exponent in -300.0..0.0_f64, upper in any::<bool>(),
        ) {
            let tail = 0.5 * super::super::pow(10.0, exponent);
            let p = if upper { 1.0 - tail } else { tail };
            let x = normal_quantile(p);
            if x.is_finite() {
                // In the tail dp/p is about -x² dx/x: an error of one bit in x counts x² times.
                let bits = 4.0 + x * x;
                let error = (normal_cdf(x) / p - 1.0).abs();
                prop_assert!(error < bits * 4.0 * f64::EPSILON, "p = {p}, x = {x}: {error:e}");
            }
        }

        #[test]
        fn the_quantile_is_odd(k in 1..(1_u64 << 52)) {
            let p = k as f64 / (1_u64 << 53) as f64; // p and 1 - p are exact
            prop_assert_eq!(normal_quantile(1.0 - p), -normal_quantile(p));
        }

        #[test]
        fn the_quantile_does_not_fall(p in 0.0..1.0_f64, step in 1e-12..0.5_f64) {
            let above = (p + step).min(1.0);
            prop_assert!(normal_quantile(p) <= normal_quantile(above));
        }
    }
}

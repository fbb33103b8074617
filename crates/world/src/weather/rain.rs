//! What rain does to light and to range sensors.
//!
//! ```text
//! loss     = 1.076 R^0.67 dB/km                   (1)    R in mm/h
//! sigma    = 0.02 r (1 - exp(-R))^2               (2)    R in mm/h, sigma and r in metres
//! P(r, R)  ~ r^-2 10^(-2 loss r / 10)             (3)
//! ```
//! Equation 1 is Recommendation ITU-R P.1814 (2007), rain, coefficients of France, for optical links
//! between 0.8 and 1.5 um; the text itself was not at hand, the coefficients are those quoted from
//! it. Equation 2 is the error that rain adds to each range of a lidar: C. Goodin, D. Carruth, M.
//! Doude and C. Hudson, *Predicting the Influence of Rain on LIDAR in ADAS*, Electronics 8(1), 89
//! (2019). Equation 3 is their lidar equation for a target wider than the beam, with the loss of
//! equation 1: the light goes there and back.

use simbeeotic_units::{Decibels, Length, RainRate, math};

/// Loss of light on a straight way through rain, one way: equation 1. None without rain.
///
/// A rate or a way that is negative counts as none.
pub fn loss(rate: RainRate, way: Length) -> Decibels {
    Decibels::si(loss_db_per_km(rate.get()) * way.max(Length::ZERO).kilometres())
}

/// The share of the light that is left after a straight way through rain: 1 without rain.
pub fn transmitted(rate: RainRate, way: Length) -> f64 {
    math::pow(10.0, -0.1 * loss(rate, way).get())
}

/// Standard deviation of the normal error that rain adds to a range: equation 2. Zero without rain,
/// 2 % of the range in any rain above 5 mm/h.
pub fn range_sigma(rate: RainRate, range: Length) -> Length {
    let wet = -math::exp_m1(-rate.get().max(0.0));
    range.max(Length::ZERO) * (0.02 * wet * wet)
}

/// How far a sensor sees in rain that sees as far as `clear` in clear air: where equation 3 gives
/// the power that it gives at `clear` without rain.
///
/// `clear` that is not above zero is returned as it is.
pub fn visible_range(rate: RainRate, clear: Length) -> Length {
    let far = clear.get();
    // The loss there and back as an exponent: P ~ r^-2 exp(-2 a r), so r exp(a r) = clear.
    let a = loss_db_per_km(rate.get()) * 1e-4 * std::f64::consts::LN_10;
    if far <= 0.0 || a <= 0.0 || !far.is_finite() {
        return clear;
    }
    // ln r + a r is concave and rises: Newton's steps from the left never overshoot.
    let wanted = math::ln(far);
    let mut r = math::exp(-1.0) * far.min(1.0 / a);
    for _ in 0..60 {
        let miss = wanted - math::ln(r) - a * r;
        let step = miss / (1.0 / r + a);
        r += step;
        if step.abs() <= 1e-12 * r {
            break;
        }
    }
    Length::si(r.min(far))
}

/// Equation 1, dB/km.
fn loss_db_per_km(rate_mm_h: f64) -> f64 {
    1.076 * math::pow(rate_mm_h.max(0.0), 0.67)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rain(mm_h: f64) -> RainRate {
        RainRate::si(mm_h)
    }

    #[test]
    fn the_loss_is_that_of_the_recommendation() {
        let km = Length::from_kilometres(1.0);
        for (rate, db) in [(1.0, 1.076), (10.0, 5.033), (50.0, 14.795), (0.0, 0.0)] {
            let found = loss(rain(rate), km).get();
            assert!((found - db).abs() < 1e-3, "{rate} mm/h: {found} dB");
        }
        // Twice the way is twice the loss; half of the light is left after 3.01 dB.
        assert_eq!(loss(rain(10.0), km * 2.0), loss(rain(10.0), km) * 2.0);
        let half = km * (10.0 * math::log10(2.0) / loss(rain(10.0), km).get());
        assert!((transmitted(rain(10.0), half) - 0.5).abs() < 1e-12);
        assert_eq!(transmitted(rain(0.0), km), 1.0);
    }

    #[test]
    fn the_range_error_is_that_of_goodin() {
        let sigma = |rate, r| range_sigma(rain(rate), Length::si(r)).get();
        assert_eq!(sigma(0.0, 50.0), 0.0);
        // (1 - e^-1)^2 = 0.399576
        assert!((sigma(1.0, 10.0) - 0.2 * 0.399_576).abs() < 1e-6);
        assert!((sigma(45.0, 100.0) - 2.0).abs() < 1e-12);
        assert_eq!(sigma(45.0, -1.0), 0.0);
        assert_eq!(sigma(-3.0, 10.0), 0.0);
    }

    #[test]
    fn at_the_visible_range_the_echo_is_as_weak_as_at_the_clear_range() {
        for (rate, clear) in [(1.0, 4.0), (10.0, 100.0), (100.0, 2_000.0), (300.0, 1e6)] {
            let clear = Length::si(clear);
            let r = visible_range(rain(rate), clear);
            assert!(r > Length::ZERO && r < clear, "{r}");
            let there_and_back = transmitted(rain(rate), r * 2.0);
            let power = there_and_back * (clear / r) * (clear / r);
            assert!((power - 1.0).abs() < 1e-9, "{rate} mm/h: {power}");
        }
        let clear = Length::si(100.0);
        assert_eq!(visible_range(rain(0.0), clear), clear);
        assert_eq!(visible_range(rain(5.0), Length::ZERO), Length::ZERO);
    }

    #[test]
    fn nonsense_makes_no_light_and_no_panic() {
        let km = Length::from_kilometres(1.0);
        assert_eq!(loss(rain(-1.0), km).get(), 0.0);
        assert_eq!(loss(rain(1.0), km * -1.0).get(), 0.0);
        assert!(visible_range(rain(f64::NAN), km).get() > 0.0);
        assert!(
            visible_range(rain(1.0), Length::si(f64::NAN))
                .get()
                .is_nan()
        );
    }
}

//! The first time at which a distance polynomial falls through zero.
//!
//! Two balls whose relative motion has constant acceleration touch when `f(s) = |p + v s + a s^2/2|^2 -
//! R^2`, a quartic, falls to zero; a ball and a plane when a quadratic does. The search steps to the
//! first root of a quadratic that lies below `f` on the rest of the span,
//!
//! ```text
//! q(s + h) = f(s) + f'(s) h + m h^2 / 2,    m = least f'' on the rest of the span           (1)
//! ```
//!
//! so it never steps over a root of `f`, converges quadratically, and is done at once when `f` is a
//! quadratic itself. A span without a root of `q` has no contact: pairs that part cost one step.

/// The least step, s: half of the resolution of simulated time.
const STEP_S_MIN: f64 = 0.5e-9;
/// Steps after which the least step doubles with each step: a graze whose two roots lie closer than
/// that step may go unseen. At 12 steps this is a matter of 0.1 us and, at 300 m/s, of nanometres.
const STEPS_EXACT: u32 = 12;
/// Steps after which the search has passed the end of any span (2^52 times the least step).
const STEPS_MAX: u32 = 64;
/// A minorant that stays above this [m^2] has no root, rounding included.
const CLEARANCE: f64 = 1e-12;

/// `c0 + c1 s + c2 s^2 + c3 s^3 + c4 s^4`, with `s` in seconds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quartic(pub(crate) [f64; 5]);

impl Quartic {
    /// The value at `s`.
    #[inline]
    pub(crate) fn value(&self, s: f64) -> f64 {
        let [c0, c1, c2, c3, c4] = self.0;
        c0 + s * (c1 + s * (c2 + s * (c3 + s * c4)))
    }

    #[inline]
    fn slope(&self, s: f64) -> f64 {
        let [_, c1, c2, c3, c4] = self.0;
        c1 + s * (2.0 * c2 + s * (3.0 * c3 + s * (4.0 * c4)))
    }

    #[inline]
    fn curvature(&self, s: f64) -> f64 {
        let [_, _, c2, c3, c4] = self.0;
        2.0 * c2 + s * (6.0 * c3 + s * (12.0 * c4))
    }

    /// The least curvature between `from` and `to`.
    #[inline]
    fn curvature_min(&self, from: f64, to: f64) -> f64 {
        let [_, _, _, c3, c4] = self.0;
        let ends = self.curvature(from).min(self.curvature(to));
        if c4 <= 0.0 {
            return ends;
        }
        let lowest = -c3 / (4.0 * c4);
        if from < lowest && lowest < to {
            self.curvature(lowest)
        } else {
            ends
        }
    }

    /// The polynomial with the opposite sign.
    pub(crate) fn negated(&self) -> Self {
        Self(self.0.map(|c| -c))
    }

    /// Whether it may fall through zero between 0 and `to`. False is certain.
    #[inline]
    pub(crate) fn may_fall(&self, to: f64) -> bool {
        let (value, slope) = (self.0[0], self.0[1]);
        let m = self.curvature_min(0.0, to);
        if value <= 0.0 {
            // Already inside: it falls (again) once the slope is negative.
            return slope + m.min(0.0) * to <= 0.0;
        }
        let s = if m > 0.0 {
            (-slope / m).clamp(0.0, to)
        } else {
            to
        };
        value + s * (slope + 0.5 * m * s) <= CLEARANCE
    }

    /// The first `s` in `0..=to` at which it is not positive and falls.
    pub(crate) fn first_fall(&self, to: f64) -> Option<f64> {
        let mut s = 0.0;
        let mut outside = None;
        for count in 0..STEPS_MAX {
            let (value, slope) = (self.value(s), self.slope(s));
            if value <= 0.0 && (slope < 0.0 || slope == 0.0 && self.curvature(s) < 0.0) {
                return Some(outside.map_or(s, |before| self.bisect(before, s)));
            }
            let rest = to - s;
            let m = self.curvature_min(s, to);
            let step = if value > 0.0 {
                let step = first_root(value, slope, m)?;
                if step < 0.5 * STEP_S_MIN && slope < 0.0 {
                    return (step <= rest).then_some(s + step);
                }
                outside = Some(s);
                step
            } else {
                // Inside and rising, or still: the next fall begins where the slope passes zero.
                if m >= 0.0 {
                    return None;
                }
                outside = None;
                slope / -m
            };
            if step > rest {
                return None;
            }
            let least = STEP_S_MIN * (1_u64 << count.saturating_sub(STEPS_EXACT)) as f64;
            s += step.max(least);
            if s > to {
                return None;
            }
        }
        None
    }

    /// The root between `outside`, where it is positive, and `inside`, where it is not.
    fn bisect(&self, mut outside: f64, mut inside: f64) -> f64 {
        while inside - outside > 0.5 * STEP_S_MIN {
            let middle = 0.5 * (outside + inside);
            if middle <= outside || middle >= inside {
                break;
            }
            if self.value(middle) > 0.0 {
                outside = middle
            } else {
                inside = middle
            }
        }
        inside
    }
}

/// The first root of `value + slope h + m h^2 / 2` with `h > 0`, for a positive value.
#[inline]
pub(crate) fn first_root(value: f64, slope: f64, m: f64) -> Option<f64> {
    let discriminant = slope * slope - 2.0 * m * value;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    if slope < 0.0 {
        Some(2.0 * value / (root - slope))
    } else if m < 0.0 {
        Some((slope + root) / -m)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::Quartic;

    fn expand(roots: [f64; 4]) -> Quartic {
        let mut c = [1.0, 0.0, 0.0, 0.0, 0.0];
        for (degree, root) in roots.into_iter().enumerate() {
            for k in (0..=degree + 1).rev() {
                let below = if k > 0 { c[k - 1] } else { 0.0 };
                c[k] = below - root * c[k];
            }
        }
        Quartic(c)
    }

    #[test]
    fn a_quadratic_is_solved_at_once() {
        let falls = Quartic([10.0, 0.0, -4.903_325, 0.0, 0.0])
            .first_fall(10.0)
            .unwrap();
        assert!((falls - (10.0_f64 / 4.903_325).sqrt()).abs() < 1e-9);
    }

    #[test]
    fn the_first_of_several_falls_is_found() {
        let quartic = expand([0.25, 0.5, 0.75, 1.0]);
        assert!((quartic.first_fall(2.0).unwrap() - 0.25).abs() < 1e-9);
        assert_eq!(quartic.first_fall(0.2), None);
        assert!(!quartic.may_fall(0.1));
    }

    #[test]
    fn rising_out_is_no_fall_but_the_return_is() {
        // Inside until 0.5, outside until 0.75.
        let up = expand([-1.0, 0.5, 0.75, 2.0]).negated().negated();
        assert!(up.value(0.0) < 0.0);
        assert!((up.first_fall(1.0).unwrap() - 0.75).abs() < 1e-9);
    }

    #[test]
    fn inside_and_turning_back_falls_where_the_slope_is_zero() {
        // Below zero for all s, highest at 0.5.
        let quartic = Quartic([-1.0, 1.0, -1.0, 0.0, 0.0]);
        assert!((quartic.first_fall(1.0).unwrap() - 0.5).abs() < 1e-8);
    }

    #[test]
    fn a_graze_from_above_is_no_fall() {
        let graze = Quartic([0.25 + 1e-6, -1.0, 1.0, 0.0, 0.0]);
        assert_eq!(graze.first_fall(1.0), None);
        let touch = Quartic([0.25 - 1e-6, -1.0, 1.0, 0.0, 0.0]);
        assert!((touch.first_fall(1.0).unwrap() - (0.5 - 1e-3)).abs() < 1e-9);
    }

    #[test]
    fn rest_in_touch_is_no_fall() {
        assert_eq!(Quartic([0.0; 5]).first_fall(1.0), None);
        assert_eq!(
            Quartic([0.0, 0.0, -1.0, 0.0, 0.0]).first_fall(1.0),
            Some(0.0)
        );
    }
}

//! The open-circuit voltage of a cell over its state of charge.

use crate::behavior::BuildError;

/// A piecewise linear curve: voltage over state of charge, 0 to 1. Beyond its ends it is level.
///
/// ```text
/// V(s)   linear between the points                                  (1)
/// W(s) = integral of V from 0 to s: quadratic between the points    (2)
/// ```
/// `W` times the charge of a full cell is the energy that the charge below `s` carries. It is exact,
/// so a battery's energy does not depend on how often one looks.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// State of charge, volts, and W up to there.
    points: Box<[[f64; 3]]>,
}

/// Points of a lithium polymer cell: those that the Crazyflie's firmware holds its battery against
/// (`bat671723HS25C` in `src/hal/src/pm_stm32f4.c`, 0 to 90 %), and the 4.20 V at which its protection
/// circuit takes it for full (Bitcraze wiki, "Hardware explained").
const LIPO: [[f64; 2]; 11] = [
    [0.0, 3.00],
    [0.1, 3.78],
    [0.2, 3.83],
    [0.3, 3.87],
    [0.4, 3.89],
    [0.5, 3.92],
    [0.6, 3.96],
    [0.7, 4.00],
    [0.8, 4.04],
    [0.9, 4.10],
    [1.0, 4.20],
];

impl Curve {
    /// A lithium polymer cell, 3.00 V to 4.20 V.
    pub fn lipo() -> Self {
        Self::through(&LIPO)
    }

    /// The same voltage at any state of charge.
    pub fn level(volts: f64) -> Self {
        Self::through(&[[0.0, volts], [1.0, volts]])
    }

    /// A curve through `points`: state of charge and volts.
    ///
    /// # Errors
    /// Fewer than two points, not from 0 to 1, states of charge that do not rise, voltages of zero or
    /// less, or that fall as the cell fills. The error names the key `curve`.
    pub fn new(points: &[[f64; 2]]) -> Result<Self, BuildError> {
        let refuse = |message: String| Err(BuildError::parameter("curve", message));
        let (Some(first), Some(last)) = (points.first(), points.last()) else {
            return refuse("needs two points or more".to_owned());
        };
        if first[0] != 0.0 || last[0] != 1.0 {
            let message = format!(
                "must go from a state of charge of 0 to 1, and goes from {} to {}",
                first[0], last[0]
            );
            return refuse(message);
        }
        if let Some(bad) = points.iter().find(|p| !(p[1] > 0.0 && p[1].is_finite())) {
            return refuse(format!(
                "must have voltages above zero, and has {} V",
                bad[1]
            ));
        }
        for pair in points.windows(2) {
            let ([s0, v0], [s1, v1]) = (pair[0], pair[1]);
            if s0.partial_cmp(&s1) != Some(std::cmp::Ordering::Less) {
                return refuse(format!(
                    "must rise in its states of charge: {s1} follows {s0}"
                ));
            }
            if v1 < v0 {
                return refuse(format!(
                    "must not fall as the cell fills: {v1} V at {s1} follows {v0} V"
                ));
            }
        }
        Ok(Self::through(points))
    }

    fn through(points: &[[f64; 2]]) -> Self {
        let mut work = 0.0;
        let mut before: Option<[f64; 2]> = None;
        let points = points.iter().map(|&[s, v]| {
            if let Some([s0, v0]) = before {
                work += 0.5 * (v0 + v) * (s - s0);
            }
            before = Some([s, v]);
            [s, v, work]
        });
        Self {
            points: points.collect(),
        }
    }

    /// Volts of the full cell.
    pub fn full_v(&self) -> f64 {
        self.points.last().map_or(0.0, |p| p[1])
    }

    /// Equation 1.
    pub fn volts(&self, soc: f64) -> f64 {
        let [[s0, v0, _], [s1, v1, _]] = self.piece(soc);
        v0 + (v1 - v0) * ((soc.clamp(0.0, 1.0) - s0) / (s1 - s0))
    }

    /// Equation 2, V.
    pub(crate) fn work(&self, soc: f64) -> f64 {
        let [[s0, v0, w0], _] = self.piece(soc);
        let inside = soc.clamp(0.0, 1.0);
        let beyond = (soc - inside) * self.volts(inside);
        w0 + 0.5 * (v0 + self.volts(inside)) * (inside - s0) + beyond
    }

    /// The lowest state of charge at which the cell has `volts`; 0 below the curve, 1 above it.
    pub fn soc_at(&self, volts: f64) -> f64 {
        let above = self.points.iter().position(|p| p[1] >= volts);
        match above {
            None => 1.0,
            Some(0) => 0.0,
            Some(at) => {
                let ([s0, v0, _], [s1, v1, _]) = (self.points[at - 1], self.points[at]);
                s0 + (s1 - s0) * ((volts - v0) / (v1 - v0))
            }
        }
    }

    /// The two points around a state of charge; upwards of it if it is one.
    pub(crate) fn piece(&self, soc: f64) -> [[f64; 3]; 2] {
        let above = self.points.partition_point(|p| p[0] <= soc);
        let at = above.clamp(1, self.points.len() - 1);
        [self.points[at - 1], self.points[at]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lipo_cell_has_the_voltages_of_its_source() {
        let curve = Curve::lipo();
        for [soc, volts] in LIPO {
            assert!((curve.volts(soc) - volts).abs() < 1e-12, "{soc}");
            assert!((curve.soc_at(volts) - soc).abs() < 1e-12, "{volts}");
        }
        assert!((curve.volts(0.95) - 4.15).abs() < 1e-12);
        assert_eq!((curve.volts(-1.0), curve.volts(2.0)), (3.0, 4.2));
        assert_eq!((curve.soc_at(2.0), curve.soc_at(5.0)), (0.0, 1.0));
    }

    #[test]
    fn work_is_the_integral_of_the_voltage() {
        let curve = Curve::lipo();
        // The midpoint rule is exact for pieces of a line, and steps of 1e-4 end on the points.
        let mut sum = 0.0;
        for step in 0..10_000 {
            sum += curve.volts((f64::from(step) + 0.5) * 1e-4) * 1e-4;
            let soc = f64::from(step + 1) * 1e-4;
            assert!((curve.work(soc) - sum).abs() < 1e-9, "{soc}");
        }
        assert!((curve.work(1.1) - curve.work(1.0) - 0.1 * 4.2).abs() < 1e-12);
        assert!((curve.work(-0.1) + 0.1 * 3.0).abs() < 1e-12);
        assert_eq!(Curve::level(3.7).work(0.5), 1.85);
    }

    #[test]
    fn curves_that_are_none_are_refused() {
        let bad: [(&[[f64; 2]], &str); 7] = [
            (&[], "two points"),
            (&[[0.0, 3.0]], "from 0 to 0"),
            (&[[0.1, 3.0], [1.0, 4.0]], "from 0.1 to 1"),
            (
                &[[0.0, 3.0], [0.5, 3.5], [0.5, 3.6], [1.0, 4.0]],
                "0.5 follows 0.5",
            ),
            (&[[0.0, 3.0], [f64::NAN, 3.5], [1.0, 4.0]], "must rise"),
            (&[[0.0, 0.0], [1.0, 4.0]], "above zero"),
            (&[[0.0, 4.0], [1.0, 3.0]], "must not fall"),
        ];
        for (points, words) in bad {
            let fault = Curve::new(points).expect_err(words).to_string();
            assert!(
                fault.contains("`curve`") && fault.contains(words),
                "{fault}"
            );
        }
        assert_eq!(Curve::new(&LIPO).expect("good"), Curve::lipo());
    }
}

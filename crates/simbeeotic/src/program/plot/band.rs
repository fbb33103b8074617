//! Means with what is around them: of many vehicles, of several runs.

use super::arguments::BandKind;
use super::quantity::Curve;
use simbeeotic_units::math;

/// Times at which curves are compared: no more than a picture shows.
const TIMES_MAX: usize = 600;

/// A mean at a time, with the ends of its band; no ends if one value alone says nothing about them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mean {
    pub(crate) time_s: f64,
    pub(crate) mean: f64,
    pub(crate) band: Option<[f64; 2]>,
}

/// The times of curves, put together; evenly spread if there are too many.
pub(super) fn times<'a>(curves: impl Iterator<Item = &'a Curve>) -> Vec<f64> {
    let mut times: Vec<f64> = curves.flat_map(|c| c.points.iter().map(|p| p[0])).collect();
    times.sort_by(f64::total_cmp);
    times.dedup_by(|a, b| (*a - *b).abs() <= 1e-9);
    let (Some(first), Some(last)) = (times.first().copied(), times.last().copied()) else {
        return times;
    };
    if times.len() > TIMES_MAX {
        let step = (last - first) / (TIMES_MAX - 1) as f64;
        times = (0..TIMES_MAX).map(|k| first + k as f64 * step).collect();
        times[TIMES_MAX - 1] = last;
    }
    times
}

/// The mean of curves at each time at which there are any, and a band around it.
pub(super) fn means(curves: &[Curve], times: &[f64], kind: BandKind) -> Vec<Mean> {
    let at = times.iter().filter_map(|time_s| {
        let mut values: Vec<f64> = curves.iter().filter_map(|c| c.at(*time_s)).collect();
        Some(Mean {
            time_s: *time_s,
            mean: mean(&values)?,
            band: band(&mut values, kind),
        })
    });
    at.collect()
}

/// The mean of all curves as one.
pub(super) fn averaged(curves: &[Curve], times: &[f64]) -> Curve {
    let means = means(curves, times, BandKind::None);
    Curve {
        who: String::new(),
        points: means.iter().map(|m| [m.time_s, m.mean]).collect(),
        holds: false,
    }
}

/// What the mean over some runs is of: the mean of each seed, since runs of one seed have their chance in common;
/// of one seed its runs.
pub(super) fn units<S: PartialEq + Copy>(runs: &[(S, f64)]) -> Vec<f64> {
    let mut seeds: Vec<(S, f64, f64)> = Vec::new();
    for (seed, number) in runs {
        match seeds.iter_mut().find(|(other, ..)| other == seed) {
            Some((_, sum, count)) => (*sum, *count) = (*sum + number, *count + 1.0),
            None => seeds.push((*seed, *number, 1.0)),
        }
    }
    match seeds.len() {
        0 | 1 => runs.iter().map(|(_, number)| *number).collect(),
        _ => seeds.iter().map(|(_, sum, count)| sum / count).collect(),
    }
}

/// The same of curves.
pub(super) fn of_seeds(runs: Vec<(Option<u64>, Curve)>) -> Vec<Curve> {
    let mut seeds: Vec<(Option<u64>, Vec<Curve>)> = Vec::new();
    for (seed, curve) in runs {
        match seeds.iter_mut().find(|(other, _)| *other == seed) {
            Some((_, curves)) => curves.push(curve),
            None => seeds.push((seed, vec![curve])),
        }
    }
    match seeds.len() {
        0 | 1 => seeds.into_iter().flat_map(|(_, curves)| curves).collect(),
        _ => (seeds.into_iter())
            .map(|(_, mut curves)| match curves.len() {
                1 => curves.remove(0),
                _ => averaged(&curves, &times(curves.iter())),
            })
            .collect(),
    }
}

/// Half of the 95 % interval of the mean of some values, after Student; `None` of less than two.
pub(super) fn half_width(values: &[f64]) -> Option<f64> {
    let [low, high] = band(&mut values.to_vec(), BandKind::Confidence)?;
    Some(0.5 * (high - low))
}

pub(crate) fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The ends of a band around the mean of some values.
pub(crate) fn band(values: &mut [f64], kind: BandKind) -> Option<[f64; 2]> {
    values.sort_by(f64::total_cmp);
    let count = values.len();
    if count < 2 {
        return None;
    }
    match kind {
        BandKind::None => None,
        BandKind::MinMax => Some([values[0], values[count - 1]]),
        BandKind::Quantile => Some([0.05, 0.95].map(|share| quantile(values, share))),
        BandKind::Confidence => {
            let middle = mean(values)?;
            let squares = values.iter().map(|x| (x - middle) * (x - middle));
            let deviation = (squares.sum::<f64>() / (count - 1) as f64).sqrt();
            let half = student_975(count - 1) * deviation / (count as f64).sqrt();
            Some([middle - half, middle + half])
        }
    }
}

/// The quantile of sorted values, straight between them (type 7 of Hyndman and Fan, 1996).
pub(super) fn quantile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return f64::NAN;
    };
    let at = share.clamp(0.0, 1.0) * last as f64;
    let below = (at.floor() as usize).min(last);
    let above = (below + 1).min(last);
    sorted[below] + (at - below as f64) * (sorted[above] - sorted[below])
}

/// The 97.5 % quantile of Student's t with so many degrees of freedom: exact for one and two, within 1e-3 for
/// more. With none it is infinite.
///
/// G. W. Hill, *Algorithm 396: Student's t-quantiles*, Communications of the ACM 13 (1970).
pub(crate) fn student_975(freedom: usize) -> f64 {
    /// The 2.5 % quantile of the normal distribution.
    const NORMAL: f64 = -1.959_963_984_540_054;
    let p = 0.05;
    let n = freedom as f64;
    match freedom {
        0 => return f64::INFINITY,
        1 => {
            let (sin, cos) = math::sin_cos(p * std::f64::consts::FRAC_PI_2);
            return cos / sin;
        }
        2 => return (2.0 / (p * (2.0 - p)) - 2.0).sqrt(),
        _ => {}
    }
    let a = 1.0 / (n - 0.5);
    let b = 48.0 / (a * a);
    let mut c = ((20_700.0 * a / b - 98.0) * a - 16.0) * a + 96.36;
    let d = ((94.5 / (b + c) - 3.0) / b + 1.0) * (a * std::f64::consts::FRAC_PI_2).sqrt() * n;
    let y = math::exp(2.0 / n * math::ln(d * p));
    let y = if y > 0.05 + a {
        let x = NORMAL;
        let y = x * x;
        if freedom < 5 {
            c += 0.3 * (n - 4.5) * (x + 0.6);
        }
        c += (((0.05 * d * x - 5.0) * x - 7.0) * x - 2.0) * x + b;
        let y = (((((0.4 * y + 6.3) * y + 36.0) * y + 94.5) / c - y - 3.0) / b + 1.0) * x;
        let y = a * y * y;
        math::exp_m1(y)
    } else {
        let tail = (n + 6.0) / (n * y) - 0.089 * d - 0.822;
        ((1.0 / (tail * (n + 2.0) * 3.0) + 0.5 / (n + 4.0)) * y - 1.0) * (n + 1.0) / (n + 2.0)
            + 1.0 / y
    };
    (n * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The chance that |t| is below a value: the finite sums of Abramowitz and Stegun, 26.7.3 and 26.7.4.
    fn within(t: f64, freedom: usize) -> f64 {
        let angle = math::atan2(t, (freedom as f64).sqrt());
        let (sin, cos) = math::sin_cos(angle);
        if freedom.is_multiple_of(2) {
            let (mut term, mut sum) = (1.0, 1.0);
            for k in (2..freedom).step_by(2) {
                term *= cos * cos * (k - 1) as f64 / k as f64;
                sum += term;
            }
            return sin * sum;
        }
        let (mut term, mut sum) = (cos, if freedom > 1 { cos } else { 0.0 });
        for k in (3..freedom).step_by(2) {
            term *= cos * cos * (k - 1) as f64 / k as f64;
            sum += term;
        }
        (angle + sin * sum) / std::f64::consts::FRAC_PI_2
    }

    #[test]
    fn students_quantile_leaves_five_percent_outside() {
        for freedom in (1..200).chain([1_000, 10_001]) {
            let share = within(student_975(freedom), freedom);
            assert!((share - 0.95).abs() < 1e-5, "{freedom}: {share}");
        }
    }

    #[test]
    fn students_quantile_has_its_known_values() {
        for (freedom, t) in [
            (1, 12.7062),
            (2, 4.3027),
            (3, 3.1824),
            (4, 2.7764),
            (5, 2.5706),
            (9, 2.2622),
            (19, 2.0930),
            (29, 2.0452),
            (100, 1.9840),
        ] {
            let found = student_975(freedom);
            assert!((found - t).abs() < 1e-3, "{freedom}: {found}");
        }
    }

    #[test]
    fn bands_of_known_values() {
        let mut values = [4.0, 1.0, 3.0, 2.0, 5.0];
        assert_eq!(band(&mut values, BandKind::MinMax), Some([1.0, 5.0]));
        assert_eq!(band(&mut values, BandKind::Quantile), Some([1.2, 4.8]));
        // s = sqrt(2.5), t(4) = 2.7764.
        let [low, high] = band(&mut values, BandKind::Confidence).expect("five values");
        let half = 2.7764 * (2.5_f64 / 5.0).sqrt();
        assert!((low - (3.0 - half)).abs() < 1e-3 && (high - (3.0 + half)).abs() < 1e-3);
        assert_eq!(band(&mut [1.0], BandKind::MinMax), None);
    }

    #[test]
    fn runs_of_one_seed_count_once() {
        let four = units(&[("1", 1.0), ("2", 5.0), ("1", 3.0), ("2", 7.0)]);
        assert_eq!(four, [2.0, 6.0]);
        let one = units(&[("1", 1.0), ("1", 3.0)]);
        assert_eq!(one, [1.0, 3.0], "nothing else is known of their chance");
        // s = 2.828, t(1) = 12.706, over the root of two.
        let half = half_width(&four).expect("two seeds");
        assert!((half - 25.41).abs() < 0.01, "{half}");
        assert_eq!(half_width(&[1.0]), None);
    }

    #[test]
    fn means_are_of_those_who_are_there() {
        let curve = |points: &[[f64; 2]]| Curve {
            points: points.to_vec(),
            ..Curve::default()
        };
        let curves = [
            curve(&[[0.0, 0.0], [10.0, 10.0]]),
            curve(&[[5.0, 15.0], [10.0, 20.0]]),
        ];
        let times = times(curves.iter());
        assert_eq!(times, [0.0, 5.0, 10.0]);
        let means = means(&curves, &times, BandKind::MinMax);
        let plain: Vec<_> = means.iter().map(|m| (m.mean, m.band)).collect();
        assert_eq!(
            plain,
            [
                (0.0, None),
                (10.0, Some([5.0, 15.0])),
                (15.0, Some([10.0, 20.0]))
            ]
        );
    }
}

//! Dryden turbulence against its closed forms.

use super::*;

const WAVES: usize = 128;

fn field(seed: u64) -> Field {
    Field::new(Stream::new(seed, "test", "field"), WAVES)
}

/// Fields over which means are taken.
const FIELDS: u64 = 100;

/// Mean of `value` over fields of many seeds, and the standard error of that mean.
fn over_seeds(value: impl Fn(&Field) -> DVec3) -> (DVec3, DVec3) {
    let values: Vec<DVec3> = (0..FIELDS).map(|seed| value(&field(seed))).collect();
    let n = FIELDS as f64;
    let mean = values.iter().sum::<DVec3>() / n;
    let squares = values.iter().map(|v| (v - mean) * (v - mean));
    let variance = squares.sum::<DVec3>() / (n - 1.0);
    let error = |axis: usize| (variance[axis] / n).sqrt();
    (mean, DVec3::new(error(0), error(1), error(2)))
}

/// Mean of each component's product at places a distance apart, over places of one field.
fn correlation(field: &Field, apart: DVec3) -> DVec3 {
    let mut rng = Stream::new(99, "test", "places");
    let places = 200;
    let sum: DVec3 = (0..places)
        .map(|_| {
            let place = DVec3::new(rng.uniform(), rng.uniform(), rng.uniform()) * 200.0;
            field.at(place) * field.at(place + apart)
        })
        .sum();
    sum / f64::from(places)
}

#[test]
fn the_energy_below_a_wave_number_is_the_integral_of_the_spectrum() {
    // Simpson's rule over equation 2, divided by 3/2.
    for share in [0.01, 0.2, 0.5, 0.9, 0.99] {
        let k = wave_number(share);
        let steps = 20_000;
        let energy = |x: f64| {
            let q = 1.0 + x * x;
            16.0 / (3.0 * PI) * x * x * x * x / (q * q * q)
        };
        let h = k / f64::from(steps);
        let sum: f64 = (0..steps)
            .map(|i| {
                let x = h * f64::from(i);
                h / 6.0 * (energy(x) + 4.0 * energy(x + 0.5 * h) + energy(x + h))
            })
            .sum();
        assert!((sum - share).abs() < 1e-6, "{share}: {sum}");
    }
}

/// Each component has its sigma, in each single field up to how evenly the directions lie: 1 %.
#[test]
fn each_component_of_one_field_has_the_intensity_it_says() {
    for seed in 0..5 {
        let field = field(seed);
        for axis in 0..3 {
            let half = |v: &DVec3| 0.5 * v[axis] * v[axis];
            let energy: f64 = field
                .waves
                .iter()
                .map(|w| half(&w.cos) + half(&w.sin))
                .sum();
            assert!((energy - 1.0).abs() < 0.01, "component {axis}: {energy}");
        }
    }
    // And over 20,000 places of a hundred fields, within four standard errors.
    let (variance, error) = over_seeds(|field| correlation(field, DVec3::ZERO));
    for axis in 0..3 {
        let off = (variance[axis] - 1.0).abs();
        assert!(off < 4.0 * error[axis], "{variance} +- {error}");
        assert!(error[axis] < 0.03, "the test can tell: {error}");
    }
}

#[test]
fn the_two_correlations_are_those_of_dryden() {
    for r in [0.25, 0.5, 1.0, 2.0, 3.0] {
        let decay = math::exp(-r);
        let across = (1.0 - 0.5 * r) * decay;
        let wanted = DVec3::new(decay, across, across);
        let (found, error) = over_seeds(|field| correlation(field, DVec3::X * r));
        for axis in 0..3 {
            assert!(
                (found[axis] - wanted[axis]).abs() < 4.0 * error[axis],
                "component {axis} at {r} L: {found} +- {error}, not {wanted}"
            );
            assert!(error[axis] < 0.03, "the test can tell: {error}");
        }
    }
    // A slanted way has the same along itself: the field knows no direction.
    let way = DVec3::new(1.0, -2.0, 2.0) / 3.0;
    let (found, error) = over_seeds(|field| {
        let mut rng = Stream::new(5, "test", "places");
        let sum: f64 = (0..200)
            .map(|_| {
                let place = DVec3::new(rng.uniform(), rng.uniform(), rng.uniform()) * 200.0;
                field.at(place).dot(way) * field.at(place + way).dot(way)
            })
            .sum();
        DVec3::X * (sum / 200.0)
    });
    let off = (found.x - math::exp(-1.0)).abs();
    assert!(off < 4.0 * error.x, "{found} +- {error}");
}

#[test]
fn no_wave_has_divergence() {
    let field = field(3);
    for wave in &field.waves {
        let size = wave.k.length();
        assert!(
            wave.k.dot(wave.cos).abs() < 1e-13 * size && wave.k.dot(wave.sin).abs() < 1e-13 * size
        );
    }
    // Nor has the sum, by central differences; its single terms are not small.
    let (here, h) = (DVec3::new(3.0, -7.0, 2.0), 1e-6);
    let slope = |axis: usize| {
        let step = DVec3::AXES[axis] * h;
        (field.at(here + step)[axis] - field.at(here - step)[axis]) / (2.0 * h)
    };
    let slopes = [slope(0), slope(1), slope(2)];
    let size: f64 = slopes.iter().map(|s| s.abs()).sum();
    let divergence: f64 = slopes.iter().sum();
    assert!(
        size > 0.1 && divergence.abs() < 1e-6 * size.max(1.0),
        "{divergence}, {slopes:?}"
    );
}

/// The spectrum along a line is sigma^2 (2 L / pi) / (1 + (L k)^2): it falls with the square.
///
/// The share of each wave's energy along `x` is counted by its own wave number along `x`: the
/// spectrum of equation 3 consists of lines, so that counting in bands is exact.
#[test]
fn the_longitudinal_spectrum_is_drydens_and_falls_with_the_square() {
    let share = |low: f64, high: f64| {
        over_seeds(|field| {
            let inside = |w: &&Wave| (low..high).contains(&w.k.x.abs());
            let energy = |w: &Wave| 0.5 * (w.cos.x * w.cos.x + w.sin.x * w.sin.x);
            DVec3::X * field.waves.iter().filter(inside).map(energy).sum::<f64>()
        })
    };
    // Its integral: 2/pi atan(k), both sides added up.
    for pair in [0.0, 0.3, 1.0, 3.0, 10.0].windows(2) {
        let wanted = (math::atan(pair[1]) - math::atan(pair[0])) / FRAC_PI_2;
        let (found, error) = share(pair[0], pair[1]);
        let (found, error) = (found.x, error.x);
        assert!(
            (found - wanted).abs() < 4.0 * error,
            "{pair:?}: {found} +- {error}, not {wanted}"
        );
    }
    let density = |low: f64, high: f64| share(low, high).0.x / (high - low);
    let slope = math::ln(density(8.0, 12.5) / density(4.0, 6.25)) / math::ln(2.0);
    assert!((slope + 2.0).abs() < 0.25, "a slope of {slope}");
}

#[test]
fn the_numbers_of_the_low_altitude_model_are_those_of_the_specification() {
    // At 1000 ft: 0.177 + 0.823 = 1, all scales are the height and all sigmas 0.1 W20.
    let (across, up) = lengths_m(304.8);
    assert!((across - 304.8).abs() < 1e-9 && (up - 304.8).abs() < 1e-9);
    assert!((sigmas(10.0, 304.8).0 - 1.0).abs() < 1e-12);
    // At 20 ft: 0.19346^-1.2 = 7.1794, 0.19346^-0.4 = 1.9291.
    let (across, up) = lengths_m(6.096);
    assert!((across / up - 7.179_4).abs() < 1e-3, "{}", across / up);
    let (level, upright) = sigmas(7.7, 6.096);
    assert!((upright - 0.77).abs() < 1e-12 && (level / upright - 1.929_1).abs() < 1e-3);
    // Held outside 10 ft to 1000 ft.
    assert_eq!(lengths_m(0.0), lengths_m(3.048));
    assert_eq!(sigmas(5.0, 1e4), sigmas(5.0, 304.8));
}

#[test]
fn turbulence_that_follows_the_height_has_the_intensity_of_each_height() {
    let params = |seed| TurbulenceParams {
        scale: TurbulenceScale::LowAltitude {
            wind_at_20ft: Speed::si(10.0),
            height: None,
        },
        modes: 32,
        seed: Some(seed),
    };
    let fields: Vec<Turbulence> = (0..40)
        .map(|seed| Turbulence::new(&params(seed), &Site::default()).expect("good numbers"))
        .collect();
    for height in [1.0, 5.0, 17.0, 80.0, 400.0] {
        let (level, up) = sigmas(10.0, height);
        let mut sums = DVec3::ZERO;
        let places = 100;
        for field in &fields {
            let mut rng = Stream::new(1, "test", "places");
            for _ in 0..places {
                let place = DVec3::new(rng.uniform(), rng.uniform(), 0.0) * 1e5;
                let u = field.at(place + DVec3::Z * height, height);
                sums += u * u;
            }
        }
        let found = sums / (f64::from(places) * fields.len() as f64);
        let wanted = DVec3::new(level * level, level * level, up * up);
        // 4000 draws, hardly correlated: a standard error of 2.2 %.
        for axis in 0..3 {
            let ratio = found[axis] / wanted[axis];
            assert!(
                (ratio - 1.0).abs() < 0.09,
                "{height} m, component {axis}: {ratio}"
            );
        }
    }
}

#[test]
fn a_field_hangs_on_the_seed_of_the_run_unless_it_has_its_own() {
    let build = |seed, run| {
        let params = TurbulenceParams {
            scale: TurbulenceScale::Isotropic {
                sigma: Speed::si(1.0),
                length: Length::si(10.0),
            },
            modes: 16,
            seed,
        };
        let site = Site {
            seed: run,
            ..Site::default()
        };
        let turbulence = Turbulence::new(&params, &site).expect("good numbers");
        turbulence.at(DVec3::new(1.0, 2.0, 3.0), 3.0)
    };
    assert_eq!(build(None, 1), build(None, 1));
    assert_ne!(build(None, 1), build(None, 2));
    assert_eq!(build(Some(5), 1), build(Some(5), 2));
}

#[test]
fn nonsense_is_refused() {
    let low = |wind, height: Option<f64>| TurbulenceScale::LowAltitude {
        wind_at_20ft: Speed::si(wind),
        height: height.map(Length::si),
    };
    let isotropic = |sigma, length| TurbulenceScale::Isotropic {
        sigma: Speed::si(sigma),
        length: Length::si(length),
    };
    for (scale, modes) in [
        (low(-1.0, None), 64),
        (low(f64::NAN, None), 64),
        (low(5.0, Some(1.0)), 64),
        (low(5.0, Some(400.0)), 64),
        (isotropic(1.0, 0.0), 64),
        (isotropic(-1.0, 10.0), 64),
        (isotropic(1.0, f64::INFINITY), 64),
        (isotropic(1.0, 10.0), 15),
        (isotropic(1.0, 10.0), 1_000_000),
    ] {
        let params = TurbulenceParams {
            scale,
            modes,
            seed: None,
        };
        assert!(
            Turbulence::new(&params, &Site::default()).is_err(),
            "{params:?}"
        );
    }
}

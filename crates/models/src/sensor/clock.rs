//! What time a vehicle thinks it is.

use super::bounds::{at_least_zero, step};
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::{SimTime, Stream};
use simbeeotic_model::units::Time;
use simbeeotic_model::{BuildError, Sensor, Truth, params, sensor};

/// Tells the time since the start of the run, as a clock with a quartz of its own has it.
///
/// ```text
/// t' = offset + (1 + drift) t + jitter n,      cut to whole ticks of the resolution
/// ```
/// `offset` is uniform in plus or minus `offset`, `drift` uniform in plus or minus `drift`, both drawn at the
/// first reading and kept; `n` is N(0, 1), new at each. The defaults are those of a usual crystal, cut at
/// 20 ppm, that ticks in microseconds.
#[sensor("clock")]
pub struct Clock {
    params: ClockParams,
    /// Offset in seconds, drift as a fraction.
    own: Option<[f64; 2]>,
}

/// Parameters of [`Clock`].
#[params]
pub struct ClockParams {
    /// Greatest offset at the start, both ways.
    pub offset: Time,
    /// Greatest drift, both ways, in parts per million: 0 to 10,000.
    pub drift_ppm: f64,
    /// Standard deviation of each reading.
    pub jitter: Time,
    /// What it counts in; 0: all digits.
    pub resolution: Time,
}

impl Default for ClockParams {
    fn default() -> Self {
        Self {
            offset: Time::ZERO,
            drift_ppm: 20.0,
            jitter: Time::ZERO,
            resolution: Time::si(1e-6),
        }
    }
}

impl Sensor for Clock {
    type Params = ClockParams;
    type Reading = Time;

    fn build(params: ClockParams) -> Result<Self, BuildError> {
        at_least_zero("offset", params.offset)?;
        in_range("drift_ppm", params.drift_ppm, 0.0..=1e4)?;
        at_least_zero("jitter", params.jitter)?;
        step("resolution", params.resolution)?;
        Ok(Self { params, own: None })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Time {
        truth.now().time()
    }

    fn measure(&mut self, ideal: Time, truth: &Truth<'_>, rng: &mut Stream) -> Time {
        let p = &self.params;
        let [offset_s, drift] = *self.own.get_or_insert_with(|| own(p, rng));
        let mut read_s = offset_s + (1.0 + drift) * ideal.get();
        if p.jitter > Time::ZERO {
            read_s += p.jitter.get() * rng.normal();
        }
        let tick_s = p.resolution.get();
        if tick_s <= 0.0 {
            return Time::si(read_s);
        }
        let tick_ns = (tick_s * 1e9).round();
        let is_whole = tick_ns >= 1.0 && (tick_s * 1e9 - tick_ns).abs() <= 1e-9 * tick_ns;
        if is_whole && offset_s == 0.0 && drift == 0.0 && p.jitter == Time::ZERO {
            let (now_ns, tick_ns) = (truth.now().nanos(), tick_ns as u64);
            return SimTime::from_nanos(now_ns - now_ns % tick_ns).time();
        }
        // A tick that is over but for rounding is over.
        let ticks = read_s / tick_s;
        let hair = 1e-9 + 4.0 * f64::EPSILON * ticks.abs();
        Time::si((ticks + hair).floor() * tick_s)
    }
}

/// The offset, s, and the drift, a fraction, of one clock.
fn own(params: &ClockParams, rng: &mut Stream) -> [f64; 2] {
    let mut within = |most: f64| most * (2.0 * rng.uniform() - 1.0);
    [within(params.offset.get()), within(params.drift_ppm * 1e-6)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;

    #[test]
    fn it_runs_off_at_a_steady_rate_within_its_bounds() {
        let params = [("offset", "10 ms"), ("resolution", "0 s")];
        let mut trial = Trial::of("clock", &params);
        (trial.every, trial.seconds) = (Time::si(1.0), 100);
        let mut first: Option<[f64; 2]> = None;
        trial.run(move |bee, sensor: Handle<Time>| {
            let now_s = bee.now().as_secs_f64();
            let error_s = bee.read(sensor).get() - now_s;
            assert!(error_s.abs() <= 10e-3 + 20e-6 * now_s, "{error_s}");
            match first {
                None => first = Some([now_s, error_s]),
                Some([then_s, before_s]) => {
                    let drift = (error_s - before_s) / (now_s - then_s);
                    assert!(drift.abs() <= 20e-6 + 1e-12 && drift != 0.0, "{drift}");
                }
            }
        });
    }

    #[test]
    fn it_counts_in_whole_ticks_that_are_over() {
        let mut trial = Trial::of("clock", &[("drift_ppm", "0"), ("resolution", "10 ms")]);
        trial.first = Time::si(1.2345);
        trial.seconds = 2;
        trial.run(|bee, sensor: Handle<Time>| {
            let want = (bee.now().nanos() / 10_000_000) as f64 * 0.01;
            assert!((bee.read(sensor).get() - want).abs() < 1e-12);
        });
    }

    #[test]
    fn no_tick_is_lost_to_rounding() {
        for (tick, tick_ns) in [
            ("1 us", 1000),
            ("10 ms", 10_000_000),
            ("0.1 s", 100_000_000),
        ] {
            for offset in ["0 s", "1e-30 s"] {
                let params = [("drift_ppm", "0"), ("resolution", tick), ("offset", offset)];
                let mut trial = Trial::of("clock", &params);
                (trial.first, trial.every) = (Time::si(1.001), Time::si(0.1001));
                trial.seconds = 200;
                trial.run(move |bee, sensor: Handle<Time>| {
                    let now_ns = bee.now().nanos();
                    let read_ns = (bee.read(sensor).get() * 1e9).round() as u64;
                    assert_eq!(read_ns, now_ns - now_ns % tick_ns, "{tick}, {now_ns}");
                });
            }
        }
    }

    #[test]
    fn offsets_and_drifts_are_spread_evenly_over_their_bounds() {
        let params = ClockParams {
            offset: Time::si(0.3),
            ..ClockParams::default()
        };
        let mut rng = Stream::new(2, "bee/clock", "noise");
        let clocks: Vec<[f64; 2]> = (0..100_000).map(|_| own(&params, &mut rng)).collect();
        for (part, most) in [(0, 0.3), (1, 20e-6)] {
            let mut tenths = [0.0; 10];
            for clock in &clocks {
                let share = 0.5 * (clock[part] / most + 1.0);
                assert!((0.0..=1.0).contains(&share), "{share}");
                tenths[((share * 10.0) as usize).min(9)] += 1.0;
            }
            // Four standard errors of a binomial count.
            let error = 4.0 * (1e5_f64 * 0.1 * 0.9).sqrt();
            assert!(
                tenths.iter().all(|n: &f64| (n - 1e4).abs() < error),
                "{tenths:?}"
            );
        }
        let product: f64 = clocks.iter().map(|[a, b]| a / 0.3 * b / 20e-6).sum();
        // Of two independent numbers of variance 1/3.
        assert!(
            (product / 1e5).abs() < 4.0 / 3.0 / 1e5_f64.sqrt(),
            "{product}"
        );
    }

    #[test]
    fn its_jitter_is_the_one_it_says() {
        let params = [
            ("drift_ppm", "0"),
            ("resolution", "0 s"),
            ("jitter", "3 us"),
        ];
        Trial::of("clock", &params).run(|bee, sensor: Handle<Time>| {
            let now_s = bee.now().as_secs_f64();
            let errors: Vec<f64> = (0..100_000)
                .map(|_| bee.read(sensor).get() - now_s)
                .collect();
            assert_normal(&errors, 0.0, 3e-6);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, value) in [
            ("offset", "-1 s"),
            ("drift_ppm", "-1"),
            ("drift_ppm", "20000"),
            ("jitter", "-1 s"),
            ("resolution", "-1 s"),
        ] {
            let refusal = refusal("clock", &[(key, value)]).expect(key);
            assert!(refusal.contains(key), "{refusal}");
        }
    }
}

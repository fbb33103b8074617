//! When a sensor is read: on demand, or at a rate of its own, late, and with gaps.

use crate::behavior::BuildError;
use crate::timer::Call;
use simbeeotic_kernel::{SimTime, Stream};
use simbeeotic_units::Time;
use std::collections::VecDeque;

/// When a sensor is read.
///
/// Without a period it is read on demand: [`Platform::read`](crate::Platform::read) measures at
/// that instant. With one it measures by itself every `period`, and `read` gives the newest sample
/// that has arrived, `delay` after it was taken.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sampling {
    /// Time between two samples; `None`: on demand.
    pub period: Option<Time>,
    /// When the first sample is taken.
    pub phase: SamplePhase,
    /// From the measurement to the arrival of a sample. 0 or more.
    pub delay: Time,
    /// Probability that a sample is lost, 0 to 1. One read on demand is then the last one again. The
    /// first is never lost.
    pub dropout: f64,
}

/// When the first sample of a sensor with a rate is taken.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum SamplePhase {
    /// At the start of the run.
    #[default]
    Aligned,
    /// At a random time of the first period, each sensor its own.
    Random,
    /// At this time.
    At(Time),
}

impl Sampling {
    /// What the stream for [`SamplePhase::Random`] is for.
    pub(crate) const PURPOSE: &str = "phase";

    /// Whether all numbers make sense.
    ///
    /// # Errors
    /// A period of zero, a delay below zero or without a period, a probability out of 0 to 1.
    pub fn check(&self) -> Result<(), BuildError> {
        let nanos = |time: Time| SimTime::from_time(time).ok().map(SimTime::nanos);
        if let Some(period) = self.period {
            if period.get().is_nan() || period < Time::ZERO {
                return Err(BuildError::parameter("rate", "must be above 0"));
            }
            if nanos(period).is_none_or(|n| n == 0) {
                let message = "must give a time between two samples of a nanosecond to 584 years";
                return Err(BuildError::parameter("rate", message));
            }
        }
        if nanos(self.delay).is_none() {
            let message = format!("must lie between 0 and 584 years, and is {}", self.delay);
            return Err(BuildError::parameter("delay", message));
        }
        if self.delay > Time::ZERO && self.period.is_none() {
            let message = "needs a `rate`: what is read on demand is read at once";
            return Err(BuildError::parameter("delay", message));
        }
        if self.phase != SamplePhase::Aligned && self.period.is_none() {
            let message = "needs a `rate`: what is read on demand has no phase";
            return Err(BuildError::parameter("phase", message));
        }
        if let SamplePhase::At(at) = self.phase
            && nanos(at).is_none()
        {
            let message = format!("must lie between 0 and 584 years, and is {at}");
            return Err(BuildError::parameter("phase", message));
        }
        if !(0.0..=1.0).contains(&self.dropout) {
            let message = format!("must lie between 0 and 1, and is {}", self.dropout);
            return Err(BuildError::parameter("dropout", message));
        }
        Ok(())
    }
}

/// A random time of the first `period`, in nanoseconds: the first draw modulo the period. Periods that
/// are multiples of each other so have phases that are, too, from equal streams. 0 for a period of 0.
pub fn random_phase(period: u64, mut rng: Stream) -> u64 {
    rng.next_u64().checked_rem(period).unwrap_or(0)
}

/// A reading, and when it was taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<R> {
    /// When it was taken. It arrived after the sensor's delay.
    pub taken: SimTime,
    /// What was read.
    pub reading: R,
}

/// The samples of one sensor: those that have arrived, those on their way, and the next one's time.
pub(crate) struct Sampler<R> {
    /// Nanoseconds; `None`: on demand.
    period: Option<u64>,
    delay: u64,
    dropout: f64,
    next: SimTime,
    newest: Option<Sample<R>>,
    under_way: VecDeque<Sample<R>>,
    /// The behaviour's method that hears of each arrival.
    pub(crate) call: Option<Call>,
}

impl<R: Clone> Sampler<R> {
    /// `None` for a sensor that is read on demand and never loses anything: it needs none.
    pub(crate) fn new(sampling: &Sampling, phase: impl FnOnce() -> Stream) -> Option<Self> {
        if sampling.period.is_none() && sampling.dropout == 0.0 {
            return None;
        }
        let nanos = |time| SimTime::from_time(time).map_or(0, SimTime::nanos);
        let period = sampling.period.map(nanos);
        let first = match sampling.phase {
            SamplePhase::Aligned => 0,
            SamplePhase::At(at) => nanos(at),
            SamplePhase::Random => random_phase(period.unwrap_or(0), phase()),
        };
        Some(Self {
            period,
            delay: nanos(sampling.delay),
            dropout: sampling.dropout,
            next: SimTime::from_nanos(first),
            newest: None,
            under_way: VecDeque::new(),
            call: None,
        })
    }

    /// First sample and period, if it has a rate.
    pub(crate) fn timing(&self) -> Option<(Time, Time)> {
        let period = self.period?;
        let time = |nanos: u64| Time::from_nanos(nanos as f64);
        Some((time(self.next.nanos()), time(period)))
    }

    pub(crate) fn delay(&self) -> Time {
        Time::from_nanos(self.delay as f64)
    }

    /// Takes the sample that is due at `now`, if one is. Whether it is lost.
    pub(crate) fn sample(
        &mut self,
        now: SimTime,
        rng: &mut Stream,
        measure: impl FnOnce(&mut Stream) -> R,
    ) -> bool {
        let Some(period) = self.period else {
            return false;
        };
        if self.next > now {
            return false;
        }
        // Its host may have been off for some periods.
        let periods = (now.nanos() - self.next.nanos()) / period + 1;
        let later = period.checked_mul(periods);
        let next = later.and_then(|span| self.next.checked_add_nanos(span));
        self.next = next.unwrap_or(SimTime::MAX);
        let first = self.newest.is_none() && self.under_way.is_empty();
        let reading = measure(rng);
        let lost = self.lost(first, rng);
        if !lost {
            let taken = now;
            self.under_way.push_back(Sample { taken, reading });
        }
        self.arrive(now);
        lost
    }

    fn lost(&self, first: bool, rng: &mut Stream) -> bool {
        self.dropout > 0.0 && rng.uniform() < self.dropout && !first
    }

    fn arrive(&mut self, now: SimTime) {
        let arrived = |sample: &Sample<R>| {
            let at = sample.taken.checked_add_nanos(self.delay);
            at.is_some_and(|at| at <= now)
        };
        let count = self.under_way.iter().take_while(|s| arrived(s)).count();
        if let Some(last) = self.under_way.drain(..count).next_back() {
            self.newest = Some(last);
        }
    }

    /// Whether a sample arrives just at `now`.
    pub(crate) fn arrives(&mut self, now: SimTime) -> bool {
        self.arrive(now);
        let at = |s: &Sample<R>| s.taken.checked_add_nanos(self.delay);
        self.newest.as_ref().and_then(at) == Some(now)
    }

    /// What a behaviour reads at `now`: of a sensor with a rate the newest sample that has arrived;
    /// before the first has arrived, that one; before it is taken, a reading of its own. And whether
    /// what was measured for this is lost: it is then the last one again.
    pub(crate) fn read(
        &mut self,
        now: SimTime,
        rng: &mut Stream,
        measure: impl FnOnce(&mut Stream) -> R,
    ) -> (Sample<R>, bool) {
        if self.period.is_some() {
            self.arrive(now);
            let newest = self.newest.as_ref().or_else(|| self.under_way.front());
            let sample = match newest {
                Some(sample) => sample.clone(),
                None => Sample {
                    taken: now,
                    reading: measure(rng),
                },
            };
            return (sample, false);
        }
        let reading = measure(rng);
        match &self.newest {
            Some(last) if self.lost(false, rng) => (last.clone(), true),
            _ => {
                let sample = Sample {
                    taken: now,
                    reading,
                };
                self.newest = Some(sample.clone());
                (sample, false)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampler(sampling: Sampling) -> Sampler<u64> {
        sampling.check().expect("good numbers");
        Sampler::new(&sampling, || Stream::new(1, "bee/imu", Sampling::PURPOSE)).expect("needed")
    }

    fn ms(ms: f64) -> Time {
        Time::from_millis(ms)
    }

    #[test]
    fn a_late_sample_is_read_when_it_has_arrived() {
        let mut sampler = sampler(Sampling {
            period: Some(ms(10.0)),
            delay: ms(25.0),
            ..Sampling::default()
        });
        let mut rng = Stream::new(1, "bee/imu", "noise");
        let mut read = Vec::new();
        for step in 0..8 {
            let now = SimTime::from_millis(10 * step);
            sampler.sample(now, &mut rng, |_| step);
            read.push(sampler.read(now, &mut rng, |_| 99).0.reading);
        }
        // Before the first has arrived at 25 ms it is the first all the same.
        assert_eq!(read, [0, 0, 0, 0, 1, 2, 3, 4]);
        let now = SimTime::from_millis(95);
        assert!(sampler.arrives(now) && !sampler.arrives(SimTime::from_millis(96)));
        let (sample, _) = sampler.read(now, &mut rng, |_| 99);
        assert_eq!(sample.taken, SimTime::from_millis(70));
    }

    #[test]
    fn lost_samples_are_as_many_as_it_says_and_the_first_is_none() {
        for period in [None, Some(ms(1.0))] {
            let mut sampler = sampler(Sampling {
                period,
                dropout: 0.3,
                ..Sampling::default()
            });
            let mut rng = Stream::new(2, "bee/imu", "noise");
            let (mut fresh, n) = (0, 100_000);
            for step in 0..n {
                let now = SimTime::from_millis(step);
                let lost = sampler.sample(now, &mut rng, |_| step);
                let (sample, again) = sampler.read(now, &mut rng, |_| step);
                assert_eq!(sample.reading == step, !(lost || again));
                fresh += u64::from(sample.reading == step);
                assert!(step > 0 || fresh == 1, "the first is lost");
            }
            let share = fresh as f64 / n as f64;
            let error = 4.0 * (0.3_f64 * 0.7 / n as f64).sqrt();
            assert!((share - 0.7).abs() < error, "{share}");
        }
    }

    #[test]
    fn a_rate_below_zero_is_called_that_and_a_limit_has_two_ends() {
        let said = |period: f64| {
            let sampling = Sampling {
                period: Some(Time::from_secs(period)),
                ..Sampling::default()
            };
            sampling.check().expect_err("nonsense").to_string()
        };
        assert!(said(-1.0).contains("above 0"), "{}", said(-1.0));
        assert!(said(f64::NAN).contains("above 0"), "{}", said(f64::NAN));
        for period in [1e-12, 1e12] {
            assert!(said(period).contains("584 years"), "{}", said(period));
        }
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        let good = Sampling {
            period: Some(ms(1.0)),
            ..Sampling::default()
        };
        let bad = [
            (
                "rate",
                Sampling {
                    period: Some(Time::ZERO),
                    ..good
                },
            ),
            (
                "delay",
                Sampling {
                    delay: ms(-1.0),
                    ..good
                },
            ),
            (
                "delay",
                Sampling {
                    period: None,
                    delay: ms(1.0),
                    ..good
                },
            ),
            (
                "phase",
                Sampling {
                    period: None,
                    phase: SamplePhase::Random,
                    ..good
                },
            ),
            (
                "phase",
                Sampling {
                    phase: SamplePhase::At(ms(-1.0)),
                    ..good
                },
            ),
            (
                "dropout",
                Sampling {
                    dropout: 1.5,
                    ..good
                },
            ),
            (
                "dropout",
                Sampling {
                    dropout: f64::NAN,
                    ..good
                },
            ),
        ];
        for (key, sampling) in bad {
            let fault = sampling.check().expect_err(key).to_string();
            assert!(fault.contains(key), "{fault}");
        }
    }
}

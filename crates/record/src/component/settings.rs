//! What users say about a recording, and when the recorder looks at what.

use simbeeotic_model::check::positive;
use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::units::Time;
use simbeeotic_model::{BuildError, choice, params};
use std::path::PathBuf;

/// Virtual time between two records of the wind, unless said.
const WIND_PERIOD_NS: u64 = 1_000_000_000;

/// Parameters of [`RecorderComponent`](super::RecorderComponent).
#[params]
pub struct RecorderParams {
    /// The file to write. An older one is replaced.
    pub path: PathBuf,
    /// Virtual time between two records of all bodies. A body takes about 60 bytes each time (50
    /// without points, 30 without twists), so 10,000 bodies once a second are 35 MB a virtual minute.
    pub period: Time,
    /// Whether velocities and body rates are recorded too.
    pub twists: bool,
    /// Whether positions are recorded once more, to 1 mm, as points in the vehicles' colours: Rerun and
    /// Foxglove draw these as they are. Takes 9 bytes a body each time.
    pub points: bool,
    /// How many digits are kept: `fine` (1 um) or `full` (every bit).
    pub precision: PrecisionChoice,
    /// Whether touches, log lines and metrics are recorded.
    pub events: bool,
    /// Sensors whose readings are recorded, with the truth beside them: patterns for their paths,
    /// such as `"bee-0/*"`, `"*/camera"`, `"*"` for all. None unless said. A reading of three numbers
    /// takes about 40 bytes.
    pub readings: Vec<String>,
    /// Virtual time between two records of how many frames were sent, received and lost, and of how
    /// well radios heard each other.
    pub radio_period: Time,
    /// Radios whose counters are recorded besides those of all together: patterns for their paths, such
    /// as `"bee-0/*"`.
    pub radios: Vec<String>,
    /// Radios whose packets are recorded, and the links among them: patterns for their paths, `["*"]`
    /// for all, `[]` for none. Unless said: all if there are at most 256 radios, else none. A packet
    /// takes about 80 bytes, and 20 more for each radio that received it. Links are recorded for at most
    /// 256 radios.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub packets: Option<Vec<String>>,
    /// Virtual time between two records of the wind around the swarm, on a grid of 8 by 8 by 3 points, some
    /// 4 kB each. Unless said: 1 s. 0 s: the wind is not recorded. In calm weather there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wind_period: Option<Time>,
}

impl Default for RecorderParams {
    fn default() -> Self {
        Self {
            path: PathBuf::from("run.mcap"),
            period: Time::from_secs(1.0),
            twists: true,
            points: true,
            precision: PrecisionChoice::Fine,
            events: true,
            readings: Vec::new(),
            radio_period: Time::from_secs(1.0),
            radios: Vec::new(),
            packets: None,
            wind_period: None,
        }
    }
}

/// How many digits a recording keeps.
#[choice]
pub enum PrecisionChoice {
    /// Positions to 1 um, attitudes to 0.1 urad.
    Fine,
    /// Every bit of positions and attitudes.
    Full,
}

/// When the recorder looks at what.
pub(super) struct Clocks {
    pub(super) period_ns: u64,
    pub(super) radio_period_ns: u64,
    /// `None`: the wind is not recorded.
    pub(super) wind_period_ns: Option<u64>,
}

impl Clocks {
    /// # Errors
    /// A period that is none.
    pub(super) fn new(params: &RecorderParams) -> Result<Self, BuildError> {
        Ok(Self {
            period_ns: nanos("period", params.period)?,
            radio_period_ns: nanos("radio_period", params.radio_period)?,
            wind_period_ns: match params.wind_period {
                None => Some(WIND_PERIOD_NS),
                Some(off) if off == Time::ZERO => None,
                Some(period) => Some(nanos("wind_period", period)?),
            },
        })
    }

    /// The next time at which something is recorded: all clocks tick at whole multiples of their periods.
    pub(super) fn next(&self, now: SimTime, radios: bool) -> Option<SimTime> {
        let after = |period_ns: u64| {
            let ticks = now.nanos() / period_ns + 1;
            ticks.checked_mul(period_ns).map(SimTime::from_nanos)
        };
        let radio = Some(self.radio_period_ns).filter(|_| radios);
        let periods = [Some(self.period_ns), radio, self.wind_period_ns];
        periods.into_iter().flatten().filter_map(after).min()
    }
}

/// A period in whole nanoseconds, one at least.
fn nanos(parameter: &'static str, period: Time) -> Result<u64, BuildError> {
    positive(parameter, period)?;
    match SimTime::from_time(period).map(SimTime::nanos) {
        Ok(nanos) if nanos > 0 => Ok(nanos),
        _ => Err(BuildError::parameter(
            parameter,
            "must be a nanosecond or more, and less than 584 years",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clocks(wind: Option<f64>) -> Result<Clocks, BuildError> {
        Clocks::new(&RecorderParams {
            period: Time::from_secs(0.3),
            wind_period: wind.map(Time::from_secs),
            ..RecorderParams::default()
        })
    }

    #[test]
    fn each_clock_ticks_by_itself() {
        let clocks = clocks(Some(0.7)).expect("good");
        let next = |now_ms: u64, radios| {
            let next = clocks.next(SimTime::from_nanos(now_ms * 1_000_000), radios);
            next.map(|next| next.nanos() / 1_000_000)
        };
        assert_eq!(next(0, true), Some(300));
        assert_eq!(next(600, true), Some(700));
        assert_eq!(next(900, true), Some(1000));
        assert_eq!(next(900, false), Some(1200));
    }

    #[test]
    fn no_time_between_two_winds_is_no_wind() {
        assert_eq!(clocks(Some(0.0)).expect("good").wind_period_ns, None);
        assert_eq!(
            clocks(None).expect("good").wind_period_ns,
            Some(1_000_000_000)
        );
        assert!(clocks(Some(-1.0)).is_err() && clocks(Some(f64::NAN)).is_err());
    }
}

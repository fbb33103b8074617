//! What a vehicle knows of its battery.

use super::bounds::{at_least_zero, positive, step};
use super::noise::{Channel, Errors};
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::{SimTime, Stream};
use simbeeotic_model::units::{Current, Voltage};
use simbeeotic_model::{BuildError, Column, Needs, Reading, Sensor, Truth, choice, params, sensor};

/// Measures the voltage and the current of its host's battery, and estimates its state of charge.
///
/// Voltage and current have the errors of [`noise`](super::noise): a scale error of each sensor, white noise,
/// steps of the converter, and limits. The state of charge follows from them, by the battery's own curve
/// (`voltage`: open-circuit voltage = voltage + resistance x current), or by counting what flowed since the
/// first reading (`count`), current times the time between two readings.
#[sensor("battery")]
pub struct BatterySensor {
    voltage: Channel,
    current: Channel,
    estimate: Estimate,
    supply: Current,
    counted: Option<Counted>,
}

/// One reading of a [`BatterySensor`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BatteryReading {
    /// Voltage at the battery's terminals.
    pub voltage: Voltage,
    /// Current that it gives; below zero while it is charged.
    pub current: Current,
    /// State of charge, 0 to 1.
    pub soc: f64,
}

impl Reading for BatteryReading {
    const COLUMNS: &'static [Column] = &[
        Column::new("voltage", "V"),
        Column::new("current", "A"),
        Column::new("soc", "1"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.extend([self.voltage.get(), self.current.get(), self.soc]);
    }
}

/// Parameters of [`BatterySensor`]. Those left out are the preset's.
#[params]
pub struct BatterySensorParams {
    /// Which device it is.
    pub preset: BatteryMonitor,
    /// Standard deviation of a voltage reading.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub voltage_sigma: Option<Voltage>,
    /// Voltage readings are multiples of this; 0: they are not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub voltage_step: Option<Voltage>,
    /// Voltage readings end here.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub voltage_limit: Option<Voltage>,
    /// Standard deviation of a current reading.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub current_sigma: Option<Current>,
    /// Current readings are multiples of this; 0: they are not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub current_step: Option<Current>,
    /// Current readings end here, in both directions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub current_limit: Option<Current>,
    /// Standard deviation of both scales' errors, a fraction: each sensor has its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale_sigma: Option<f64>,
    /// How the state of charge is estimated.
    pub estimate: Estimate,
}

impl Default for BatterySensorParams {
    fn default() -> Self {
        Self {
            preset: BatteryMonitor::Ina219,
            voltage_sigma: None,
            voltage_step: None,
            voltage_limit: None,
            current_sigma: None,
            current_step: None,
            current_limit: None,
            scale_sigma: None,
            estimate: Estimate::Voltage,
        }
    }
}

/// Devices that measure batteries.
#[choice]
pub enum BatteryMonitor {
    /// Texas Instruments INA219B on a shunt of 0.1 ohm (data sheet SBOS448G): bus voltage in steps of 4 mV up
    /// to 26 V; shunt voltage in steps of 10 uV up to 320 mV, that is 0.1 mA up to 3.2 A; 0.5 % at most over
    /// temperature, taken for three sigma; it draws 1 mA at most.
    Ina219,
    /// No errors.
    Ideal,
}

/// How a state of charge is estimated.
#[choice]
pub enum Estimate {
    /// From voltage and current, by the battery's curve.
    Voltage,
    /// By counting the charge that flows, from the voltage's estimate at the first reading on.
    Count,
}

/// A count of charge.
#[derive(Clone, Copy, Debug)]
struct Counted {
    at: SimTime,
    soc: f64,
}

impl Sensor for BatterySensor {
    type Params = BatterySensorParams;
    type Reading = BatteryReading;

    fn build(p: BatterySensorParams) -> Result<Self, BuildError> {
        // Voltage step and limit, current step and limit, scale, supply current.
        let [v_step, v_limit, i_step, i_limit, scale, supply] = match p.preset {
            BatteryMonitor::Ina219 => [4e-3, 26.0, 1e-4, 3.2, 0.005 / 3.0, 1e-3],
            BatteryMonitor::Ideal => [0.0, f64::INFINITY, 0.0, f64::INFINITY, 0.0, 0.0],
        };
        let volts = |given: Option<Voltage>, usual: f64| given.unwrap_or(Voltage::si(usual));
        let amperes = |given: Option<Current>, usual: f64| given.unwrap_or(Current::si(usual));
        let (v_sigma, i_sigma) = (volts(p.voltage_sigma, 0.0), amperes(p.current_sigma, 0.0));
        let (v_step, i_step) = (
            volts(p.voltage_step, v_step),
            amperes(p.current_step, i_step),
        );
        let v_limit = volts(p.voltage_limit, v_limit);
        let i_limit = amperes(p.current_limit, i_limit);
        let scale_sigma = p.scale_sigma.unwrap_or(scale);
        at_least_zero("voltage_sigma", v_sigma)?;
        step("voltage_step", v_step)?;
        if let Some(limit) = p.voltage_limit {
            positive("voltage_limit", limit)?;
        }
        at_least_zero("current_sigma", i_sigma)?;
        step("current_step", i_step)?;
        if let Some(limit) = p.current_limit {
            positive("current_limit", limit)?;
        }
        in_range("scale_sigma", scale_sigma, 0.0..=1.0)?;
        let channel = |sigma, step, limit| {
            Channel::new(Errors {
                sigma,
                scale_sigma,
                step,
                limit,
                ..Errors::default()
            })
        };
        Ok(Self {
            voltage: channel(v_sigma.get(), v_step.get(), v_limit.get()),
            current: channel(i_sigma.get(), i_step.get(), i_limit.get()),
            estimate: p.estimate,
            supply: Current::si(supply),
            counted: None,
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> BatteryReading {
        // There is a battery: `needs` says so.
        let state = truth.battery();
        BatteryReading {
            voltage: state.map_or(Voltage::ZERO, |state| state.voltage),
            current: state.map_or(Current::ZERO, |state| state.current),
            soc: state.map_or(0.0, |state| state.soc),
        }
    }

    fn measure(
        &mut self,
        ideal: BatteryReading,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> BatteryReading {
        let now = truth.now();
        let voltage = Voltage::si(self.voltage.read(ideal.voltage.get(), now, rng));
        let current = Current::si(self.current.read(ideal.current.get(), now, rng));
        let Some(kind) = truth.battery_kind() else {
            return ideal;
        };
        let soc = match (self.estimate, self.counted) {
            (Estimate::Count, Some(last)) => {
                let flowed = current * (now - last.at);
                (last.soc - flowed / kind.capacity()).clamp(0.0, 1.0)
            }
            _ => kind.soc_at(voltage, current),
        };
        self.counted = Some(Counted { at: now, soc });
        BatteryReading {
            voltage,
            current,
            soc,
        }
    }

    fn current(&self) -> Current {
        self.supply
    }

    fn needs(&self) -> Needs {
        Needs::Battery
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::units::{Charge, Time};
    use simbeeotic_model::{Consumer, Handle};

    /// A full battery of 250 mAh that gives what the test says.
    fn trial(params: &[(&'static str, &str)]) -> Trial {
        let mut trial = Trial::of("battery", params);
        trial.battery = vec![("cutoff", "0 V"), ("charge", "0.5")];
        trial
    }

    #[test]
    fn an_ideal_one_reads_the_sagging_voltage_and_sees_through_it() {
        trial(&[("preset", "ideal")]).run(|bee, sensor: Handle<BatteryReading>| {
            for amperes in [0.0, 1.0, 2.5] {
                bee.set_load(Consumer::Hover, Current::si(amperes));
                let (read, truth) = (bee.read(sensor), bee.battery().expect("a battery"));
                let open_v = 3.89 + 0.03 * (truth.soc - 0.4) / 0.1;
                let want_v = open_v - 0.06 * amperes;
                assert!((read.voltage.get() - want_v).abs() < 1e-9, "{read:?}");
                assert_eq!(read.current, Current::si(amperes));
                assert!((read.soc - truth.soc).abs() < 1e-9, "{read:?} {truth:?}");
            }
        });
    }

    #[test]
    fn noise_steps_and_limits_are_those_it_says() {
        let noisy = [
            ("preset", "ideal"),
            ("voltage_sigma", "20 mV"),
            ("current_sigma", "5 mA"),
        ];
        trial(&noisy).run(|bee, sensor: Handle<BatteryReading>| {
            bee.set_load(Consumer::Hover, Current::si(1.0));
            let truth = bee.battery().expect("a battery");
            let (mut volts, mut amperes) = (Vec::new(), Vec::new());
            for _ in 0..100_000 {
                let read = bee.read(sensor);
                volts.push(read.voltage.get());
                amperes.push(read.current.get());
            }
            assert_normal(&volts, truth.voltage.get(), 0.02);
            assert_normal(&amperes, 1.0, 0.005);
        });
        trial(&[]).run(|bee, sensor: Handle<BatteryReading>| {
            bee.set_load(Consumer::Hover, Current::si(0.123_456));
            let (read, truth) = (bee.read(sensor), bee.battery().expect("a battery"));
            for (read, truth, step) in [
                (read.voltage.get(), truth.voltage.get(), 4e-3),
                (read.current.get(), truth.current.get(), 1e-4),
            ] {
                assert!((read / step - (read / step).round()).abs() < 1e-9, "{read}");
                // Five sigma of the scale, and half a step.
                assert!((read - truth).abs() <= truth * 0.025 / 3.0 + 0.5 * step);
            }
            // Beyond 320 mV on the shunt.
            bee.set_load(Consumer::Hover, Current::si(5.0));
            assert_eq!(bee.read(sensor).current, Current::si(3.2));
        });
    }

    #[test]
    fn counting_follows_the_charge() {
        let mut trial = trial(&[("preset", "ideal"), ("estimate", "count")]);
        (trial.first, trial.every, trial.seconds) = (Time::ZERO, Time::si(1.0), 60);
        trial.run(|bee, sensor: Handle<BatteryReading>| {
            bee.set_load(Consumer::Hover, Current::si(1.0));
            let (read, truth) = (bee.read(sensor), bee.battery().expect("a battery"));
            assert!((read.soc - truth.soc).abs() < 1e-6, "{read:?} {truth:?}");
            let used = Charge::si(bee.now().as_secs_f64());
            assert!((truth.soc - 0.5 + used / Charge::si(900.0)).abs() < 2e-3);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, value) in [
            ("voltage_sigma", "-1 V"),
            ("voltage_step", "-1 V"),
            ("voltage_limit", "0 V"),
            ("current_sigma", "-1 A"),
            ("current_step", "-1 A"),
            ("current_limit", "0 A"),
            ("scale_sigma", "-0.1"),
            ("preset", "ina220"),
            ("estimate", "guess"),
        ] {
            let refusal = refusal("battery", &[(key, value)]).expect(key);
            assert!(
                refusal.contains(key) || refusal.contains(value),
                "{refusal}"
            );
        }
    }
}

//! How well a radio hears.

use super::bounds::{at_least_zero, positive, step};
use super::noise::{Channel, Errors};
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::{SimTime, Stream};
use simbeeotic_model::radio::Inbox;
use simbeeotic_model::units::{Decibels, Frequency, PowerLevel, Time};
use simbeeotic_model::{BuildError, Column, Needs, Reading, Sensor, Truth, params, sensor};
use std::collections::VecDeque;

/// Tells how well a radio of its host has heard lately: strength and quality of the last packet, its age, and
/// how many packets a second there were.
///
/// Of packets that arrive at the same instant the last counts, in the order of the inbox. The strength has
/// the errors of a radio's own RSSI: a bias of each sensor, and steps. The defaults are the CC2420's: steps
/// of 1 dB; accurate to 6 dB either way, taken for three sigma (data sheet SWRS041, "RSSI / Energy Detection").
#[sensor("link")]
pub struct LinkSensor {
    radio: Option<String>,
    window: Time,
    rssi: Channel,
    last: Option<Heard>,
    /// When packets came, those within the window.
    times: VecDeque<SimTime>,
}

/// The last packet.
#[derive(Clone, Copy, Debug)]
struct Heard {
    at: SimTime,
    rssi: PowerLevel,
    snr: Decibels,
    lqi: u8,
}

/// One reading of a [`LinkSensor`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkReading {
    /// The last packet; `None` if there has been none.
    pub last: Option<LastPacket>,
    /// Packets a second, in the mean over the window.
    pub rate: Frequency,
}

/// The last packet that a radio heard.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LastPacket {
    /// Received signal strength.
    pub rssi: PowerLevel,
    /// Signal over noise.
    pub snr: Decibels,
    /// Link quality, 0 to 255: the chance that a frame like it survives, times 255.
    pub lqi: u8,
    /// Time since.
    pub age: Time,
}

impl Reading for LinkReading {
    const COLUMNS: &'static [Column] = &[
        Column::new("rssi", "dBm"),
        Column::new("snr", "dB"),
        Column::new("lqi", "1"),
        Column::new("age", "s"),
        Column::new("rate", "Hz"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        match self.last {
            Some(last) => to.extend([
                last.rssi.dbm(),
                last.snr.get(),
                f64::from(last.lqi),
                last.age.get(),
            ]),
            None => to.extend([f64::NAN; 4]),
        }
        to.push(self.rate.get());
    }
}

/// Parameters of [`LinkSensor`].
#[params]
pub struct LinkSensorParams {
    /// The name of the radio; all radios on board if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radio: Option<String>,
    /// Packets are counted over this time. Above 0, to 3,600 s.
    pub window: Time,
    /// Standard deviation of the strength's bias.
    pub rssi_bias_sigma: Decibels,
    /// The strength comes in multiples of this; 0: it does not.
    pub rssi_step: Decibels,
}

impl Default for LinkSensorParams {
    fn default() -> Self {
        Self {
            radio: None,
            window: Time::si(1.0),
            rssi_bias_sigma: Decibels::si(2.0),
            rssi_step: Decibels::si(1.0),
        }
    }
}

impl Sensor for LinkSensor {
    type Params = LinkSensorParams;
    type Reading = LinkReading;

    fn build(params: LinkSensorParams) -> Result<Self, BuildError> {
        positive("window", params.window)?;
        in_range("window", params.window, Time::ZERO..=Time::si(3600.0))?;
        at_least_zero("rssi_bias_sigma", params.rssi_bias_sigma)?;
        step("rssi_step", params.rssi_step)?;
        Ok(Self {
            radio: params.radio,
            window: params.window,
            rssi: Channel::new(Errors {
                bias_sigma: params.rssi_bias_sigma.get(),
                step: params.rssi_step.get(),
                ..Errors::default()
            }),
            last: None,
            times: VecDeque::new(),
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> LinkReading {
        let now = truth.now();
        while self
            .times
            .front()
            .is_some_and(|at| now - *at >= self.window)
        {
            self.times.pop_front();
        }
        LinkReading {
            last: self.last.map(|heard| LastPacket {
                rssi: heard.rssi,
                snr: heard.snr,
                lqi: heard.lqi,
                age: now - heard.at,
            }),
            rate: self.times.len() as f64 / self.window,
        }
    }

    fn measure(&mut self, ideal: LinkReading, truth: &Truth<'_>, rng: &mut Stream) -> LinkReading {
        let last = ideal.last.map(|last| LastPacket {
            rssi: PowerLevel::from_dbm(self.rssi.read(last.rssi.dbm(), truth.now(), rng)),
            ..last
        });
        LinkReading { last, ..ideal }
    }

    fn heard(&mut self, radio: &str, inbox: Inbox<'_>) {
        if self.radio.as_deref().is_some_and(|own| own != radio) {
            return;
        }
        let at = inbox.time();
        while self
            .times
            .front()
            .is_some_and(|then| at - *then >= self.window)
        {
            self.times.pop_front();
        }
        self.times.extend(std::iter::repeat_n(at, inbox.len()));
        if let Some(packet) = inbox.iter().last() {
            self.last = Some(Heard {
                at,
                rssi: packet.rssi(),
                snr: packet.snr(),
                lqi: packet.lqi(),
            });
        }
    }

    fn needs(&self) -> Needs {
        Needs::Radio(self.radio.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, bee, refusal, with_radio};
    use simbeeotic_model::Handle;

    /// Another bee 5 m away broadcasts once a second.
    fn trial(params: &[(&'static str, &str)]) -> Trial {
        let mut trial = Trial::of("link", params);
        trial.radio = true;
        let drift = [("drift_sigma", "0 m/s")];
        let other = bee("other", "broadcast-bee", &drift, [5.0, 0.0, 10.0]);
        trial.others = vec![with_radio(other)];
        (trial.first, trial.seconds) = (Time::si(3.25), 3);
        trial.seconds = 4;
        trial
    }

    #[test]
    fn it_tells_the_strength_of_free_space_the_age_and_the_rate() {
        let exact = [
            ("rssi_bias_sigma", "0 dB"),
            ("rssi_step", "0 dB"),
            ("window", "2 s"),
        ];
        trial(&exact).run(|bee, sensor: Handle<LinkReading>| {
            let read = bee.read(sensor);
            let last = read.last.expect("it has heard something");
            // Friis at 2405 MHz and 5 m, 0 dBm: 54.05 dB of loss.
            assert!((last.rssi.dbm() + 54.05).abs() < 0.05, "{:?}", last.rssi);
            assert!((last.age.get() - 0.25).abs() < 1e-9, "{:?}", last.age);
            assert!(last.lqi == 255 && last.snr.get() > 30.0, "{last:?}");
            // At 2 s and 3 s, within the last two.
            assert_eq!(read.rate, Frequency::si(1.0));
        });
    }

    #[test]
    fn the_biases_of_many_have_the_sigma_that_they_say() {
        let mut rng = Stream::new(2, "bee/link", "noise");
        let read: Vec<f64> = (0..100_000)
            .map(|_| {
                let params = LinkSensorParams {
                    rssi_bias_sigma: Decibels::si(3.0),
                    rssi_step: Decibels::ZERO,
                    ..LinkSensorParams::default()
                };
                let mut sensor = LinkSensor::build(params).expect("good");
                sensor.rssi.read(-54.0, SimTime::ZERO, &mut rng)
            })
            .collect();
        assert_normal(&read, -54.0, 3.0);
    }

    #[test]
    fn strength_comes_in_steps() {
        trial(&[]).run(|bee, sensor: Handle<LinkReading>| {
            let rssi = bee.read(sensor).last.expect("a packet").rssi.dbm();
            assert!((rssi - rssi.round()).abs() < 1e-9, "{rssi}");
            assert!((rssi + 54.05).abs() < 10.5, "{rssi}");
        });
    }

    #[test]
    fn before_the_first_packet_there_is_nothing() {
        let mut trial = trial(&[]);
        trial.others.clear();
        trial.run(|bee, sensor: Handle<LinkReading>| {
            let read = bee.read(sensor);
            assert_eq!((read.last, read.rate), (None, Frequency::ZERO));
            let mut numbers = Vec::new();
            read.numbers(&mut numbers);
            assert!(numbers[..4].iter().all(|n| n.is_nan()) && numbers[4] == 0.0);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, value) in [
            ("window", "0 s"),
            ("rssi_bias_sigma", "-1 dB"),
            ("rssi_step", "-1 dB"),
        ] {
            let refusal = refusal("link", &[(key, value)]).expect(key);
            assert!(refusal.contains(key), "{refusal}");
        }
    }
}

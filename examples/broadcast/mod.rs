//! Broadcast: bees that tell their names, and know their neighbours by what they hear.
//!
//! A frame of the power `P_t` is heard over the distance `d` in free space with
//!
//! ```text
//! P = P_t - 20 log10(4 pi d f / c)                                                 (1)
//! ```
//! (H. T. Friis, *A note on a simple transmission formula*, Proc. IRE 34, 1946). A receiver that needs the
//! ratio `m` above a noise that is normal in dB, `N(mu, sigma)`, drawn for each reception, hears the share
//!
//! ```text
//! PRR = Phi((P - m - mu) / sigma)                                                  (2)
//! ```
//! of the frames, `Phi` the distribution function of the normal distribution. Half of them come through where
//! `P = mu + m`: 78 m away with the numbers of the scenario. Each 6 dB halve or double that.
//!
//! A bee knows none of this. It keeps a table of whom it hears: how loud, when last, and what share of the calls
//! since the first one, all bees calling once a period.

use simbeeotic::prelude::*;
use std::collections::BTreeMap;

/// A bee that drifts, calls its name once a period, and keeps a table of whom it hears.
#[behavior("calling-bee")]
pub struct CallingBee {
    params: CallingBeeParams,
    radio: RadioHandle,
    name: String,
    drift: Velocity<Flu>,
    heard: u32,
    neighbours: BTreeMap<String, Neighbour>,
}

/// What a bee knows of another.
struct Neighbour {
    /// How loud its last frame was.
    rssi: PowerLevel,
    first: SimTime,
    last: SimTime,
    frames: u32,
}

impl Neighbour {
    /// The share of its calls since the first one that came through. NaN if there was none.
    fn delivery(&self, now: SimTime, period: Time) -> f64 {
        let calls = ((now - self.first) / period).round();
        f64::from(self.frames - 1) / calls
    }
}

/// Parameters of [`CallingBee`].
#[params]
pub struct CallingBeeParams {
    /// Time between two calls. The first comes at a random time of the first period.
    pub period: Time,
    /// Standard deviation of its drift's velocity, along each axis.
    pub drift_sigma: Speed,
    /// Who has not been heard for so long is no neighbour any more.
    pub memory: Time,
}

impl Default for CallingBeeParams {
    fn default() -> Self {
        Self {
            period: Time::si(1.0),
            drift_sigma: Speed::si(0.1),
            memory: Time::si(5.0),
        }
    }
}

impl Behavior for CallingBee {
    type Params = CallingBeeParams;

    fn build(params: CallingBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        positive("period", params.period)?;
        at_least_zero("drift_sigma", params.drift_sigma)?;
        positive("memory", params.memory)?;
        let mut chance = kit.stream("start");
        let phase = params.period * chance.uniform();
        let mut speed = || params.drift_sigma * chance.normal();
        let drift = Velocity::new(speed(), speed(), Speed::ZERO);
        kit.every_from(phase, params.period, Self::call);
        Ok(Self {
            radio: kit.radio()?,
            name: kit.path().to_owned(),
            params,
            drift,
            heard: 0,
            neighbours: BTreeMap::new(),
        })
    }

    fn on_packet(&mut self, packet: &Packet<'_>, bee: &mut Bee<'_>) {
        let Ok(name) = str::from_utf8(packet.payload()) else {
            return; // somebody else's protocol
        };
        self.heard += 1;
        bee.metric("packets-heard", self.heard.into(), "1");
        let (rssi, now) = (packet.rssi(), bee.now());
        let known = self.neighbours.entry(name.to_owned());
        let neighbour = known.or_insert(Neighbour {
            rssi,
            first: now,
            last: now,
            frames: 0,
        });
        (neighbour.rssi, neighbour.last) = (rssi, now);
        neighbour.frames += 1;
    }

    fn on_finish(&mut self, bee: &mut Bee<'_>) {
        let power = |n: &Neighbour| n.rssi.dbm();
        let all = self.neighbours.iter();
        let loudest = all.max_by(|a, b| power(a.1).total_cmp(&power(b.1)));
        if let Some((name, n)) = loudest {
            let (count, age) = (self.neighbours.len(), bee.now() - n.last);
            let loud = format!("{name}, {:.0}, {age:.1} ago", n.rssi);
            bee.log(format!("has {count} neighbours; loudest is {loud}"));
        }
    }
}

impl CallingBee {
    fn call(&mut self, bee: &mut Bee<'_>) {
        bee.fly(self.drift);
        bee.send(self.radio, self.name.as_bytes());

        let (now, p) = (bee.now(), &self.params);
        self.neighbours.retain(|_, n| now - n.last < p.memory);
        let shares = self.neighbours.values().map(|n| n.delivery(now, p.period));
        let known: Vec<f64> = shares.filter(|share| share.is_finite()).collect();
        bee.metric("neighbours", self.neighbours.len() as f64, "1");
        if !known.is_empty() {
            let mean = known.iter().sum::<f64>() / known.len() as f64;
            bee.metric("delivery", mean, "1");
        }
    }
}

#[cfg(test)]
mod test;

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
    drift: Velocity<Flu>,
    heard: u32,
    neighbours: BTreeMap<String, Neighbour>,
}

/// What a bee knows of another.
struct Neighbour {
    rssi: PowerLevel,
    last: SimTime,
    first: SimTime,
    /// Frames after the first.
    frames: u32,
}

impl Neighbour {
    /// The share of its calls since the first one that came through. NaN if there was none.
    fn delivery(&self, now: SimTime, period: Time) -> f64 {
        let calls = ((now - self.first) / period).round();
        f64::from(self.frames) / calls
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
        let news = |known: &mut Neighbour| {
            (known.rssi, known.last) = (rssi, now);
            known.frames += 1;
        };
        let first = Neighbour {
            rssi,
            last: now,
            first: now,
            frames: 0,
        };
        let entry = self.neighbours.entry(name.to_owned());
        entry.and_modify(news).or_insert(first);
    }

    fn on_finish(&mut self, bee: &mut Bee<'_>) {
        let loudest = self.neighbours.iter().max_by(|a, b| {
            let (a, b) = (a.1.rssi.dbm(), b.1.rssi.dbm());
            a.total_cmp(&b)
        });
        if let Some((name, n)) = loudest {
            let (rssi, age, count) = (n.rssi, bee.now() - n.last, self.neighbours.len());
            bee.log(format!("has {count} neighbours; loudest is {name}, {rssi:.0}, {age:.1} ago"));
        }
    }
}

impl CallingBee {
    fn call(&mut self, bee: &mut Bee<'_>) {
        bee.fly(self.drift);
        let name = bee.path().to_owned();
        bee.send(self.radio, name.as_bytes());

        let (now, p) = (bee.now(), &self.params);
        self.neighbours.retain(|_, n| now - n.last < p.memory);
        let shares = self.neighbours.values().map(|n| n.delivery(now, p.period));
        let (mut sum, mut known) = (0.0, 0.0);
        for share in shares.filter(|share| share.is_finite()) {
            sum += share;
            known += 1.0;
        }
        bee.metric("neighbours", self.neighbours.len() as f64, "1");
        bee.metric("delivery", sum / known, "1"); // of nobody: NaN, which does not count
    }
}

#[cfg(test)]
mod test;

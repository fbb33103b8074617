//! A bee that is led by beacons.

use super::chemotaxis::{Chemotaxis, ChemotaxisParams};
use super::nose::{Nose, Smell};
use super::packet::{Mark, Value};
use simbeeotic::prelude::*;

/// A bee that travels between the hive and the edge of a gradient field by the packets of beacons: run and
/// tumble on their values, weighed by their signal strength.
///
/// Outbound it climbs `along - stay across`, homeward `-along - stay across`. It turns back when the loudest
/// beacon, for `sure` without a break, is one that marks the edge, or the hive. It needs a radio, and an
/// altimeter called `altimeter`; it has no position and no compass, and knows no bearing.
///
/// Metrics: `claimed` trips, and at each of them `claimed/time`; `beacons` heard.
#[behavior("gradient-bee")]
pub struct GradientBee {
    params: GradientBeeParams,
    altimeter: Handle<Option<Length>>,
    walk: Chemotaxis,
    nose: Nose,
    homeward: bool,
    /// How long the goal has been the loudest.
    near: Time,
    /// Whether it heard nothing the last time.
    deaf: bool,
    left: SimTime,
    trips: u32,
    /// Whether it has said yet that it begins with no trip.
    counts: bool,
}

/// Parameters of [`GradientBee`].
#[params]
pub struct GradientBeeParams {
    /// How fast it flies. Above 0 m/s.
    pub speed: Speed,
    /// How high it flies. Above 0 m, to 1 km.
    pub height: Length,
    /// Time between two decisions.
    pub period: Time,
    /// How long a packet counts. Above 0 s; more than the beacons' period, or it is deaf at times.
    pub window: Time,
    /// A beacon weighs its received power to the power of this. 0: all alike; 1: by power; large: the
    /// loudest alone. 0 to 10.
    pub sharpness: f64,
    /// What a metre across the path counts, against a metre along it. 0 or more.
    pub stay: f64,
    /// Below this a beacon is quiet. While the loudest is, each decibel counts as a metre down: it is about
    /// to leave the field.
    pub quiet: PowerLevel,
    /// How long the goal's beacon must be the loudest before it is believed.
    pub sure: Time,
    /// How it walks.
    pub walk: ChemotaxisParams,
}

impl Default for GradientBeeParams {
    fn default() -> Self {
        Self {
            speed: Speed::si(1.5),
            height: Length::si(3.0),
            period: Time::from_millis(250.0),
            window: Time::si(1.0),
            sharpness: 1.0,
            stay: 1.5,
            quiet: PowerLevel::from_dbm(-81.0),
            sure: Time::si(1.0),
            walk: ChemotaxisParams::default(),
        }
    }
}

impl Behavior for GradientBee {
    type Params = GradientBeeParams;

    fn build(params: GradientBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        positive("speed", params.speed)?;
        positive("height", params.height)?;
        in_range("height", params.height, Length::ZERO..=Length::si(1000.0))?;
        positive("window", params.window)?;
        in_range("sharpness", params.sharpness, 0.0..=10.0)?;
        at_least_zero("stay", params.stay)?;
        at_least_zero("sure", params.sure)?;
        kit.radio()?; // without one it would never hear a beacon
        kit.every(params.period, Self::decide);
        Ok(Self {
            altimeter: kit.sensor("altimeter")?,
            walk: Chemotaxis::new(params.walk.clone())?,
            nose: Nose::new(params.window, params.sharpness),
            homeward: false,
            near: Time::ZERO,
            deaf: false,
            left: SimTime::ZERO,
            trips: 0,
            counts: false,
            params,
        })
    }

    fn on_packet(&mut self, packet: &Packet<'_>, bee: &mut Bee<'_>) {
        if let Some(value) = Value::from_packet(packet.payload()) {
            self.nose
                .hear(bee.now(), packet.sender(), value, packet.rssi());
        }
    }
}

impl GradientBee {
    fn decide(&mut self, bee: &mut Bee<'_>) {
        if !self.counts {
            self.counts = true;
            bee.metric("claimed", 0.0, "1");
        }
        match self.nose.smell(bee.now()) {
            Some(smell) => {
                if self.deaf {
                    self.deaf = false;
                    self.walk.forget();
                }
                self.arrive(&smell, bee);
                self.follow(&smell, bee);
            }
            None => self.search(bee),
        }
        let low = bee
            .read(self.altimeter)
            .map_or(Length::ZERO, |h| self.params.height - h);
        let climb = (low / Time::si(1.0)).clamp(Speed::si(-1.0), Speed::si(1.0));
        bee.fly(Velocity::new(self.params.speed, Speed::ZERO, climb));
    }

    /// Turns to the other goal if this one is reached, as far as it can tell.
    fn arrive(&mut self, smell: &Smell, bee: &mut Bee<'_>) {
        let goal = if self.homeward {
            Mark::Hive
        } else {
            Mark::Edge
        };
        if smell.loudest != goal {
            self.near = Time::ZERO;
            return;
        }
        self.near += self.params.period;
        if self.near < self.params.sure {
            return;
        }
        self.near = Time::ZERO;
        self.homeward = !self.homeward;
        self.walk.forget();
        if goal == Mark::Hive {
            self.trips += 1;
            let now = bee.now();
            bee.metric("claimed", f64::from(self.trips), "1");
            bee.metric("claimed/time", (now - self.left).secs(), "s");
            self.left = now;
        }
    }

    /// Runs on or tumbles.
    fn follow(&mut self, smell: &Smell, bee: &mut Bee<'_>) {
        bee.metric("beacons", smell.beacons as f64, "1");
        let along_m = if self.homeward {
            -smell.along_m
        } else {
            smell.along_m
        };
        let quiet_db = (self.params.quiet.dbm() - smell.rssi_dbm).max(0.0);
        let level_m = along_m - self.params.stay * smell.across_m - quiet_db;
        let (draw, gauss) = (bee.uniform(), bee.gauss());
        if let Some(turn) = self.walk.step(level_m, self.params.period, draw, gauss) {
            bee.turn(turn);
        }
    }

    /// Nothing is heard: it turns round, and walks without a gradient until it hears something.
    fn search(&mut self, bee: &mut Bee<'_>) {
        if !self.deaf {
            self.deaf = true;
            self.walk.forget();
            bee.turn(Angle::from_degrees(180.0));
        }
        let (draw, gauss) = (bee.uniform(), bee.gauss());
        if let Some(turn) = self.walk.step(0.0, self.params.period, draw, gauss) {
            bee.turn(turn);
        }
    }
}

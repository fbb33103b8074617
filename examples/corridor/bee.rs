//! The bee that flies by optical flow.

use simbeeotic::models::sensor::flow::OpticalFlow;
use simbeeotic::prelude::*;
use std::cmp::Ordering;

/// A bee that flies through corridors by optical flow alone.
///
/// Its eyes are sensors of the kind `optical-flow` that look out level: `left` and `right` it must have.
/// With `front-left`, `front-right`, `back-left` and `back-right` (45 and 135 degrees aside) it keeps
/// along the walls, with `front` it sees what is ahead. A `gyroscope` called `gyro` takes what its own
/// turns do out of the picture. It publishes `flow`, `saccades`, `touches`, and `out` when it has left
/// the corridor: there is no wall on either side any more, and it stops.
#[behavior("corridor-bee")]
pub struct CorridorBee {
    params: CorridorBeeParams,
    sides: [Handle<OpticalFlow>; 2],
    slants: Option<[Handle<OpticalFlow>; 4]>,
    front: Option<Handle<OpticalFlow>>,
    gyro: Option<Handle<Rate<Flu>>>,
    /// The speed that it wants.
    speed: Speed,
    /// Smoothed spread of the picture ahead: one over the time to contact, 1/s.
    spread: f64,
    /// Until then it makes no other saccade.
    calm_from: Time,
    /// How long it has seen no wall.
    alone: Time,
    saccades: u32,
    touches: u32,
    out: bool,
}

/// Parameters of [`CorridorBee`].
#[params]
pub struct CorridorBeeParams {
    /// The flow that it holds to the left and right: its speed is this times half of the width.
    pub flow: AngularRate,
    /// How fast it regulates the flow: a part of its error in each second. 0: it keeps its first speed.
    pub speed_gain: f64,
    /// How fast it sets out.
    pub first_speed: Speed,
    /// The most that it flies.
    pub max_speed: Speed,
    /// Sidestep, in parts of its speed, at the flow of a wall that it touches: the centring response.
    /// 0: it does not care for the middle.
    pub balance: f64,
    /// Turn along the walls in a second, in parts of what it is turned away.
    pub align: f64,
    /// It turns away from what it would meet within this time.
    pub contact_time: Time,
    /// By how much it turns in a saccade.
    pub saccade: Angle,
    /// So long after a saccade it makes no other.
    pub calm: Time,
}

impl Default for CorridorBeeParams {
    fn default() -> Self {
        Self {
            flow: AngularRate::si(1.0),
            speed_gain: 1.5,
            first_speed: Speed::si(0.5),
            max_speed: Speed::si(3.0),
            balance: 1.2,
            align: 1.5,
            contact_time: Time::si(1.2),
            saccade: Angle::from_degrees(25.0),
            calm: Time::si(0.6),
        }
    }
}

/// Slower than this it sees nothing move, m/s.
const SLOWEST_M_S: f64 = 0.2;
/// After so long without a wall it is out, s.
const OUT_S: f64 = 0.5;
/// One side grows clearly more than the other if it does so by this part of the whole.
const CLEARLY: f64 = 0.2;
/// Memory of the spread, s.
const SPREAD_S: f64 = 0.15;

impl Behavior for CorridorBee {
    type Params = CorridorBeeParams;

    fn build(params: CorridorBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        positive("flow", params.flow)?;
        at_least_zero("speed_gain", params.speed_gain)?;
        positive("first_speed", params.first_speed)?;
        positive("max_speed", params.max_speed)?;
        at_least_zero("balance", params.balance)?;
        at_least_zero("align", params.align)?;
        positive("contact_time", params.contact_time)?;
        positive("calm", params.calm)?;
        let slants = ["front-left", "back-left", "front-right", "back-right"];
        let slants = slants.map(|name| kit.optional_sensor(name));
        let [front_left, back_left, front_right, back_right] = slants;
        let slants = match (front_left?, back_left?, front_right?, back_right?) {
            (Some(a), Some(b), Some(c), Some(d)) => Some([a, b, c, d]),
            (None, None, None, None) => None,
            _ => {
                return Err(BuildError::other(
                    "of `front-left`, `back-left`, `front-right`, `back-right` it has all or none",
                ));
            }
        };
        kit.every(PERIOD, Self::look);
        Ok(Self {
            sides: [kit.sensor("left")?, kit.sensor("right")?],
            slants,
            front: kit.optional_sensor("front")?,
            gyro: kit.optional_sensor("gyro")?,
            speed: params.first_speed,
            params,
            spread: 0.0,
            calm_from: Time::ZERO,
            alone: Time::ZERO,
            saccades: 0,
            touches: 0,
            out: false,
        })
    }

    fn on_contact(&mut self, _: &Touch, bee: &mut Bee<'_>) {
        self.touches += 1;
        bee.metric("touches", f64::from(self.touches), "1");
    }
}

/// Between two looks.
const PERIOD: Time = Time::si(0.05);

impl CorridorBee {
    fn look(&mut self, bee: &mut Bee<'_>) {
        if self.out {
            return;
        }
        let rate = self.gyro.map_or(Rate::ZERO, |gyro| bee.read(gyro));
        // To the back is to the left in the picture of a left eye, to the right in that of a right one.
        let left = passing(&bee.read(self.sides[0]), rate).map(|flow| -flow);
        let right = passing(&bee.read(self.sides[1]), rate);
        if left.is_none() && right.is_none() {
            return self.lost_sight(bee);
        }
        self.alone = Time::ZERO;
        // Where there is no wall, none goes by.
        let (left, right) = (left.unwrap_or(0.0), right.unwrap_or(0.0));
        let both = (left + right).max(1e-3);
        bee.metric("flow", 0.5 * both, "rad/s");
        let slants = self.slants.map(|eyes| {
            let [a, b, c, d] = eyes.map(|eye| passing(&bee.read(eye), rate).unwrap_or(0.0));
            [-a, -b, c, d]
        });
        self.regulate(0.5 * both);
        // Equation 3: away from the nearer wall.
        let [fl, bl, fr, br] = slants.unwrap_or_default();
        let (lefts, rights) = (left + fl + bl, right + fr + br);
        let offset = (lefts - rights) / (lefts + rights).max(1e-3);
        let aside = self.speed * (-self.params.balance * offset.clamp(-1.0, 1.0));
        // Equation 4: along the walls, unless something is ahead.
        let turned = ((fl - bl - fr + br) / both).clamp(-1.0, 1.0);
        let turn = match self.saccade(rate, fl - fr, bee) {
            Some(turn) => turn,
            None if Self::now(bee) < self.calm_from => Angle::ZERO,
            None => Angle::si(-self.params.align * PERIOD.get() * turned),
        };
        bee.turn(turn);
        bee.fly(Velocity::new(self.speed, aside, Speed::ZERO));
    }

    /// Equation 2: faster where little goes by, slower where walls are near.
    fn regulate(&mut self, flow: f64) {
        let error = (1.0 - flow / self.params.flow.get()).clamp(-1.0, 1.0);
        let change = 1.0 + self.params.speed_gain * PERIOD.get() * error;
        let least = Speed::si(SLOWEST_M_S);
        let most = self.params.max_speed.max(least);
        self.speed = (self.speed * change).clamp(least, most);
    }

    /// The turn away from what it would soon meet, if there is something. `leftness` is how much more
    /// goes by on the left: it decides where what is ahead is as near on both sides.
    fn saccade(&mut self, rate: Rate<Flu>, leftness: f64, bee: &mut Bee<'_>) -> Option<Angle> {
        let [left, middle, right] = spreading(&bee.read(self.front?), rate);
        let spread = left.max(middle).max(right);
        self.spread += (spread - self.spread) * (PERIOD.get() / SPREAD_S);
        let now = Self::now(bee);
        if now < self.calm_from || self.spread * self.params.contact_time.get() < 1.0 {
            return None;
        }
        self.saccades += 1;
        bee.metric("saccades", f64::from(self.saccades), "1");
        self.calm_from = now + self.params.calm;
        self.spread = 0.0;
        let clear = (left - right).abs() > CLEARLY * spread;
        let nearer = if clear { left - right } else { leftness };
        let side = if nearer > 0.0 { -1.0 } else { 1.0 };
        Some(self.params.saccade * side)
    }

    fn now(bee: &Bee<'_>) -> Time {
        Time::si(bee.now().as_secs_f64())
    }

    fn lost_sight(&mut self, bee: &mut Bee<'_>) {
        self.alone += PERIOD;
        if self.alone.get() >= OUT_S {
            self.out = true;
            bee.fly(Velocity::ZERO);
            bee.metric("out", 1.0, "1");
            bee.log("no walls any more: stops");
        }
    }
}

/// The part of a turn that moves the picture of an eye that looks out level: about the vertical axis.
fn level(rate: Rate<Flu>) -> Rate<Flu> {
    Rate::from_xyz(0.0, 0.0, rate.si().z)
}

/// How fast what an eye sees goes by to its right, rad/s: the mean over its picture, without its own
/// turn. `None` if it sees nothing.
fn passing(seen: &OpticalFlow, rate: Rate<Flu>) -> Option<f64> {
    let flows = seen.derotated(level(rate));
    let known: Vec<f64> = flows.iter().flatten().map(|[x, _]| x.get()).collect();
    (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
}

/// How fast what is ahead grows, 1/s: the greatest over the columns of the picture to the left, in the
/// middle, to the right; of each column the least squares of its vertical flow, which a sidestep does
/// not change.
fn spreading(seen: &OpticalFlow, rate: Rate<Flu>) -> [f64; 3] {
    let flows = seen.derotated(level(rate));
    let columns = seen.points.len().isqrt().max(1);
    let mut sides = [0.0_f64; 3];
    for column in 0..columns {
        let (mut along, mut squares) = (0.0, 0.0);
        for (point, flow) in seen.points.iter().zip(&flows).skip(column).step_by(columns) {
            if let Some([_, down]) = flow {
                along += point.at[1] * down.get();
                squares += point.at[1] * point.at[1];
            }
        }
        let side = match (2 * column + 1).cmp(&columns) {
            Ordering::Less => 0,
            Ordering::Equal => 1,
            Ordering::Greater => 2,
        };
        if squares > 0.0 {
            sides[side] = sides[side].max(along / squares);
        }
    }
    sides
}

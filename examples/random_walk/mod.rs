//! Random walk: a bee that wanders, keeps its height, and leaves what it meets.
//!
//! On open ground its flight is a correlated random walk: each step of the time `tau` it turns by a normal
//! angle of standard deviation `sigma` and flies on at the speed `v`. Where it goes next is like where it
//! went before, by the mean cosine of the turn
//!
//! ```text
//! c = exp(-sigma^2 / 2)                                                            (1)
//! ```
//! and after `n` steps of the length `L = v tau` the mean squared displacement is
//!
//! ```text
//! R^2(n) = L^2 [n (1 + c) / (1 - c) - 2 c (1 - c^n) / (1 - c)^2]                   (2)
//! ```
//! At first that is `(n L)^2`, a straight flight. After some `1 / (1 - c)` steps the direction is forgotten,
//! and it grows with the time, as of a gas: `R^2 = 4 D t` with the diffusion constant
//!
//! ```text
//! D = L^2 / (4 tau) (1 + c) / (1 - c)                                              (3)
//! ```
//! Source: P. M. Kareiva and N. Shigesada, Oecologia 56, 234 (1983), as reviewed by E. A. Codling, M. J.
//! Plank and S. Benhamou, *Random walk models in biology*, J. R. Soc. Interface 5, 813 (2008), section 3.
//!
//! [`RoamingBee`] is the walk. [`spread`] measures it.

pub mod spread;

use simbeeotic::prelude::*;

/// A bee on a random walk that keeps between `floor` and `ceiling` by a range finder that looks down,
/// turns away from what is ahead of it, and takes off again from whatever it has come down on.
///
/// Its sensors are called `range-bottom`, `range-front` and `contact-bottom`.
#[behavior("roaming-bee")]
pub struct RoamingBee {
    params: RoamingBeeParams,
    below: Handle<Option<Length>>,
    ahead: Handle<Option<Length>>,
    foot: Handle<Bump>,
    climb: Speed,
    /// Counter-clockwise or clockwise, from when something is ahead until nothing is.
    away: Option<Angle>,
    rises_until: SimTime,
    bumps: u32,
}

/// Parameters of [`RoamingBee`].
#[params]
pub struct RoamingBeeParams {
    /// How fast it flies: `v`.
    pub speed: Speed,
    /// Time between two turns: `tau`.
    pub step: Time,
    /// Standard deviation of each turn: `sigma`.
    pub turn_sigma: Angle,
    /// How fast it climbs and sinks, at most.
    pub climb: Speed,
    /// Lower above what is below it than this, it climbs. 0 to `ceiling`.
    pub floor: Length,
    /// Higher than this, it sinks.
    pub ceiling: Length,
    /// From what is nearer ahead than this it turns away. 0 or more.
    pub margin: Length,
    /// How long it climbs after a touch from below.
    pub rise: Time,
}

impl Default for RoamingBeeParams {
    fn default() -> Self {
        Self {
            speed: Speed::si(1.0),
            step: Time::si(1.0),
            turn_sigma: Angle::from_degrees(45.0),
            climb: Speed::si(0.5),
            floor: Length::si(1.0),
            ceiling: Length::si(2.0),
            margin: Length::si(1.2),
            rise: Time::si(1.0),
        }
    }
}

impl Behavior for RoamingBee {
    type Params = RoamingBeeParams;

    fn build(params: RoamingBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        at_least_zero("speed", params.speed)?;
        at_least_zero("turn_sigma", params.turn_sigma)?;
        at_least_zero("climb", params.climb)?;
        at_least_zero("rise", params.rise)?;
        at_least_zero("margin", params.margin)?;
        at_least_zero("floor", params.floor)?;
        if params.floor > params.ceiling {
            let message = format!("must be at most the `ceiling`, {}", params.ceiling);
            return Err(BuildError::parameter("floor", message));
        }
        kit.every(params.step, Self::step);
        Ok(Self {
            below: kit.sensor("range-bottom")?,
            ahead: kit.sensor("range-front")?,
            foot: kit.sensor("contact-bottom")?,
            params,
            climb: Speed::ZERO,
            away: None,
            rises_until: SimTime::ZERO,
            bumps: 0,
        })
    }

    /// Ten times a second: what must be done at once.
    fn on_control(&mut self, bee: &mut Bee<'_>) {
        let forward = self.avoid(bee);
        let upward = self.keep_height(bee);
        bee.fly(Velocity::new(forward, Speed::ZERO, upward));
    }
}

impl RoamingBee {
    /// One step of the walk.
    fn step(&mut self, bee: &mut Bee<'_>) {
        let turn = self.params.turn_sigma * bee.gauss();
        bee.turn(turn);
        self.climb = self.params.climb * (2.0 * bee.uniform() - 1.0);
    }

    /// Turns away from what is ahead, always to the same side until it is out of sight: whoever chooses
    /// anew each time stays in a corner. The speed to fly at.
    fn avoid(&mut self, bee: &mut Bee<'_>) -> Speed {
        let near = bee.read(self.ahead).is_some_and(|d| d < self.params.margin);
        if !near {
            self.away = None;
            return self.params.speed;
        }
        let side = if bee.uniform() < 0.5 { 15.0 } else { -15.0 };
        let turn = *self.away.get_or_insert(Angle::from_degrees(side));
        bee.turn(turn);
        Speed::ZERO
    }

    /// How fast to climb. What is below may be a table: then that is what it keeps its height above.
    fn keep_height(&mut self, bee: &mut Bee<'_>) -> Speed {
        if bee.read(self.foot).tripped() {
            self.rises_until = bee.now() + self.params.rise;
            self.bumps += 1;
            bee.metric("bumps", self.bumps.into(), "1");
        }
        let height = bee.read(self.below);
        if bee.now() < self.rises_until {
            return self.params.climb;
        }
        match height {
            Some(height) if height < self.params.floor => self.params.climb,
            Some(height) if height < self.params.ceiling => self.climb,
            // Beyond its range the sensor sees nothing.
            _ => -self.params.climb,
        }
    }
}

#[cfg(test)]
mod test;

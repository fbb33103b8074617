//! Run and tumble: a walk that climbs what it cannot see, by comparing now with a moment ago.
//!
//! The walker flies straight (a run), and now and then turns by chance (a tumble). It senses one number,
//! the level `u`, and keeps a fading memory `m` of it:
//!
//! ```text
//! slope = (u - m) / memory                                                (1)
//! rate  = up + (down - up) / (1 + exp(bias slope / sense))                (2)
//! chance to tumble within dt = 1 - exp(-rate dt)                          (3)
//! m <- m + (u - m) (1 - exp(-dt / memory)); after a tumble m <- u         (4)
//! ```
//! On a steady climb `m` lags behind `u` by `memory` times the rate of climb, so (1) is the rate of climb.
//! A run that climbs is long (`up` is small), one that descends is short, and that alone makes the walk
//! drift upwards. With `bias = 0` the rate is halfway between `up` and `down` wherever it flies: the
//! same angles, blind, and runs of less than a second; smaller `down` makes them longer.
//!
//! Source: H. C. Berg and D. A. Brown, *Chemotaxis in Escherichia coli analysed by three-dimensional
//! tracking*, Nature 239, 500-504, 1972: runs of about a second, longer up the gradient; turns of
//! 68 degrees in the mean with a standard deviation of 36 (as commonly quoted; the paper itself was not
//! at hand). There, runs down the gradient are as long as without one; here `down` is larger, since
//! a flight costs more than a swim. That cells compare the last second with the three before: J. E. Segall,
//! S. M. Block and H. C. Berg, PNAS 83, 8987-8991, 1986; (4) is the simplest such memory.

use simbeeotic::prelude::*;
use simbeeotic::units::math;

/// Parameters of [`Chemotaxis`].
#[params]
pub struct ChemotaxisParams {
    /// Tumbles in a second while the level rises fast.
    pub up: Frequency,
    /// Tumbles in a second while it falls fast.
    pub down: Frequency,
    /// A level that rises as fast as this counts as rising, by three to one (2). Above 0 m/s.
    pub sense: Speed,
    /// How long the past is remembered. Above 0 s.
    pub memory: Time,
    /// What the slope counts: 1; 0 is a walk without bias, below 0 it descends.
    pub bias: f64,
    /// Mean angle of a tumble, to the left or to the right.
    pub turn: Angle,
    /// Standard deviation of that angle. 0 deg or more.
    pub turn_sigma: Angle,
}

impl Default for ChemotaxisParams {
    fn default() -> Self {
        Self {
            up: Frequency::from_hertz(0.03),
            down: Frequency::from_hertz(3.0),
            sense: Speed::si(0.1),
            memory: Time::si(1.0),
            bias: 1.0,
            turn: Angle::from_degrees(68.0),
            turn_sigma: Angle::from_degrees(36.0),
        }
    }
}

/// The walk's state: what it remembers.
#[derive(Clone, Debug)]
pub struct Chemotaxis {
    params: ChemotaxisParams,
    memory_m: Option<f64>,
}

impl Chemotaxis {
    /// A walk that remembers nothing yet.
    ///
    /// # Errors
    /// Parameters out of their ranges.
    pub fn new(params: ChemotaxisParams) -> Result<Self, BuildError> {
        at_least_zero("up", params.up)?;
        at_least_zero("down", params.down)?;
        positive("sense", params.sense)?;
        positive("memory", params.memory)?;
        at_least_zero("turn_sigma", params.turn_sigma)?;
        if !params.bias.is_finite() {
            return Err(BuildError::parameter("bias", "must be finite"));
        }
        Ok(Self {
            params,
            memory_m: None,
        })
    }

    /// Forgets the past: what is looked for has changed.
    pub fn forget(&mut self) {
        self.memory_m = None;
    }

    /// Takes in the level after `dt`, and decides by `draw`, even over [0, 1), whether to tumble: by how much
    /// to turn, with `gauss` from N(0, 1).
    pub fn step(&mut self, level_m: f64, dt: Time, draw: f64, gauss: f64) -> Option<Angle> {
        let memory_s = self.params.memory.secs();
        let memory_m = self.memory_m.unwrap_or(level_m);
        let slope_m_s = (level_m - memory_m) / memory_s;
        let forgotten = 1.0 - math::exp(-dt.secs() / memory_s);
        self.memory_m = Some(memory_m + (level_m - memory_m) * forgotten);
        let chance = 1.0 - math::exp(-self.rate_hz(slope_m_s) * dt.secs());
        // What is left of the draw is as even as the draw was, and chooses the side.
        (draw < chance).then(|| {
            self.memory_m = Some(level_m);
            let side = if draw < 0.5 * chance { -1.0 } else { 1.0 };
            (self.params.turn + self.params.turn_sigma * gauss) * side
        })
    }

    /// Tumbles in a second, equation (2).
    fn rate_hz(&self, slope_m_s: f64) -> f64 {
        let (up, down) = (self.params.up.hertz(), self.params.down.hertz());
        let x = self.params.bias * slope_m_s / self.params.sense.get();
        // Far beyond 1 and -1 it is `up` and `down`, before the exponential leaves the numbers.
        up + (down - up) / (1.0 + math::exp(x.clamp(-50.0, 50.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walk(change: impl FnOnce(&mut ChemotaxisParams)) -> Chemotaxis {
        let mut params = ChemotaxisParams::default();
        change(&mut params);
        Chemotaxis::new(params).expect("good numbers")
    }

    /// Tumbles in a second, of a level that rises at this speed for 200 s.
    fn tumbles_hz(mut walk: Chemotaxis, slope_m_s: f64) -> f64 {
        let mut chance = Stream::new(1, "walk", "test");
        let dt = Time::from_millis(100.0);
        let tumbles = (0..20_000).filter(|step| {
            let level_m = slope_m_s * 0.1 * f64::from(*step);
            walk.step(level_m, dt, chance.uniform(), 0.0).is_some()
        });
        tumbles.count() as f64 / 2000.0
    }

    /// How often it tumbles that does so at a rate, decided ten times a second.
    fn decided_hz(rate_hz: f64) -> f64 {
        (1.0 - math::exp(-0.1 * rate_hz)) / 0.1
    }

    #[test]
    fn runs_up_the_gradient_are_long_and_runs_down_are_short() {
        for (slope_m_s, rate_hz) in [(2.0, 0.03), (0.0, 1.515), (-2.0, 3.0)] {
            let hz = tumbles_hz(walk(|_| ()), slope_m_s);
            let wanted = decided_hz(rate_hz);
            assert!(
                (hz - wanted).abs() < 0.01 + 0.07 * wanted,
                "{slope_m_s} m/s: {hz}, {wanted}"
            );
        }
    }

    #[test]
    fn without_bias_it_tumbles_as_often_everywhere() {
        for slope_m_s in [2.0, 0.0, -2.0] {
            let hz = tumbles_hz(walk(|params| params.bias = 0.0), slope_m_s);
            assert!((hz - decided_hz(1.515)).abs() < 0.1, "{hz}");
        }
    }

    #[test]
    fn a_climb_that_ends_is_noticed_within_the_memory() {
        let mut walk = walk(|params| params.down = Frequency::from_hertz(2.0));
        let dt = Time::from_millis(100.0);
        let mut level_m = 0.0;
        for _ in 0..100 {
            level_m += 0.2;
            assert_eq!(walk.step(level_m, dt, 0.9, 0.0), None);
        }
        let chance_of_never = (0..40).map(|_| {
            level_m -= 0.2;
            let slope_m_s = (level_m - walk.memory_m.expect("a past")) / 2.0;
            let kept = math::exp(-walk.rate_hz(slope_m_s) * 0.1);
            walk.step(level_m, dt, 0.9999, 0.0);
            kept
        });
        let never: f64 = chance_of_never.product();
        assert!(never < 0.05, "{never}");
    }

    #[test]
    fn turns_go_to_both_sides_by_the_angle_asked_for() {
        let mut walk = walk(|params| {
            params.up = Frequency::from_hertz(1e3);
            params.down = Frequency::from_hertz(1e3);
        });
        let mut turn = |draw, gauss| {
            let angle = walk
                .step(0.0, Time::si(1.0), draw, gauss)
                .expect("a tumble");
            angle.degrees().round()
        };
        assert_eq!(
            [turn(0.1, 0.0), turn(0.9, 0.0), turn(0.9, 1.0)],
            [-68.0, 68.0, 104.0]
        );
    }

    #[test]
    fn it_climbs_a_cone_and_without_bias_it_does_not() {
        let distance_m = |bias| {
            let mut sum = 0.0;
            for seed in 0..20 {
                let mut walk = walk(|params| params.bias = bias);
                let mut chance = Stream::new(seed, "walk", "cone");
                let (mut x, mut y, mut yaw) = (60.0_f64, 0.0_f64, Angle::ZERO);
                for _ in 0..1200 {
                    let level_m = -(x * x + y * y).sqrt();
                    let (draw, gauss) = (chance.uniform(), chance.normal());
                    if let Some(turn) = walk.step(level_m, Time::from_millis(100.0), draw, gauss) {
                        yaw += turn;
                    }
                    let (sin, cos) = math::sin_cos(yaw.radians());
                    (x, y) = (x + 0.2 * cos, y + 0.2 * sin);
                }
                sum += (x * x + y * y).sqrt() / 20.0;
            }
            sum
        };
        let (led, blind) = (distance_m(1.0), distance_m(0.0));
        assert!(led < 10.0 && blind > 40.0, "{led} m, {blind} m");
    }

    #[test]
    fn numbers_that_make_no_sense_are_refused_by_name() {
        let refused = |change: fn(&mut ChemotaxisParams)| {
            let mut params = ChemotaxisParams::default();
            change(&mut params);
            Chemotaxis::new(params).expect_err("refused").to_string()
        };
        assert!(refused(|p| p.memory = Time::ZERO).contains("`memory`"));
        assert!(refused(|p| p.sense = Speed::ZERO).contains("`sense`"));
        assert!(refused(|p| p.bias = f64::NAN).contains("`bias`"));
        assert!(refused(|p| p.up = Frequency::from_hertz(-1.0)).contains("`up`"));
    }
}

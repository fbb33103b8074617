//! Drop: what is let go falls, hits, and bounces, by closed formulas.
//!
//! A bee that does not fly is a body in the air. From the height `h`, without drag,
//!
//! ```text
//! t = sqrt(2 h / g),    v = sqrt(2 g h),    h' = e^2 h                              (1)
//! ```
//! are the time and the speed of its impact and the height of its bounce, `e` the restitution of the two
//! surfaces that meet. With quadratic drag it tends to its terminal speed `v_t`:
//!
//! ```text
//! v_t = sqrt(2 m g / (rho C_d A)),    v = v_t sqrt(1 - exp(-2 g h / v_t^2))         (2)
//! ```
//! A bee needs no altimeter to know how high it bounced. Between two touches it flies for the time `t'`, half
//! of it upwards, so that
//!
//! ```text
//! h' = g t'^2 / 8                                                                  (3)
//! ```
//! as in the classroom, where the ball bounces beside a microphone: A. D. Bernstein, *Listening to the
//! coefficient of restitution*, American Journal of Physics 45, 41 (1977).

use simbeeotic::prelude::*;

/// A bee that lets itself fall and tells of its impacts: when, how fast, and how high it bounced.
#[behavior("dropped-bee")]
pub struct DroppedBee {
    params: DroppedBeeParams,
    /// The last touch: when, and with what.
    before: Option<(SimTime, Thing)>,
    impacts: u32,
}

/// Parameters of [`DroppedBee`].
#[params]
pub struct DroppedBeeParams {
    /// When it lets itself go, at the vehicle's next control step; until then it hovers.
    pub release: Time,
    /// A touch at less than this is no impact: whatever lies still touches too.
    pub least_speed: Speed,
}

impl Default for DroppedBeeParams {
    fn default() -> Self {
        Self {
            release: Time::ZERO,
            least_speed: Speed::si(0.1),
        }
    }
}

impl Behavior for DroppedBee {
    type Params = DroppedBeeParams;

    fn build(params: DroppedBeeParams, _kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        at_least_zero("release", params.release)?;
        positive("least_speed", params.least_speed)?;
        Ok(Self {
            params,
            before: None,
            impacts: 0,
        })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        bee.hover(bee.now().time() < self.params.release);
    }

    /// A touch comes at its own instant, between two steps of whatever else has a clock.
    fn on_contact(&mut self, touch: &Touch, bee: &mut Bee<'_>) {
        let speed = touch.relative_velocity.length();
        let before = self.before.replace((touch.time, touch.other));
        if speed < self.params.least_speed {
            return;
        }
        self.impacts += 1;
        bee.metric("impacts", self.impacts.into(), "1");
        match (self.impacts, before) {
            (1, _) => {
                let fallen = touch.time.time() - self.params.release;
                bee.metric("impact-time", fallen.secs(), "s");
                bee.metric("impact-speed", speed.get(), "m/s");
                bee.log(format!("hit after {fallen:.3}, at {speed:.2}"));
            }
            // Only what comes down where it went up flew upwards for half of the time.
            (2, Some((start, what))) if what == touch.other => {
                let aloft = touch.time - start;
                let height = 0.125 * bee.gravity() * aloft * aloft; // equation 3
                bee.metric("bounce-height", height.get(), "m");
                bee.log(format!("had bounced up to {height:.2}"));
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod test;

//! Wind: who does nothing drifts, who pushes against it leans, and who learns it stays.
//!
//! A flyer pushes against the air, not against the ground. With drag that goes with the square of the
//! airspeed, and motors that push as hard as the drag at the airspeed `s` that is asked for,
//!
//! ```text
//! dv/dt = k (|s| s - |v - w| (v - w)),    k = rho C_d A / 2 m                       (1)
//! ```
//! `v` is the velocity over ground, `w` the wind. Asked for nothing, it drifts, and takes up the wind by
//!
//! ```text
//! v(t) = w (1 - 1 / (1 + t / T)),    T = 1 / (k w)                                 (2)
//! ```
//! To stay where it began it measures how far it has been carried, `e`, and answers by
//!
//! ```text
//! s = (e + integral of e dt / T_i) / T_p                                           (3)
//! ```
//! a PI law with the response time `T_p` and the reset time `T_i`: K. J. Åström and R. M. Murray, *Feedback
//! Systems* (2008), chapter 10. It stands still where `s = -w`. Without the integral that takes an error of
//! `w T_p` that never goes away; with it the error goes to zero, and the integral is the wind, as far as this
//! bee can know it. Near the wind's speed the drag answers within `1 / (2 k w)`; a reset time below that makes
//! it swing (Routh's criterion for the three roots of equations 1 and 3). So in calm air, `w` near 0, it swings
//! with any reset time, as far as the drag at the speed of its swing is too little to stop it.
//!
//! [`air_bee`] is the vehicle, equation 1. The law is [`HoldBee`].

pub mod air_bee;

use simbeeotic::prelude::*;

/// A bee that keeps the place where it began, by a sensor called `position`: equation 3.
#[behavior("hold-bee")]
pub struct HoldBee {
    params: HoldBeeParams,
    position: Handle<Position>,
    home: Option<Position>,
    learned: Velocity<Enu>,
}

/// Parameters of [`HoldBee`].
#[params]
pub struct HoldBeeParams {
    /// What it does against the wind.
    pub law: Law,
    /// `T_p`: in this time it would fly back, were there no wind.
    pub response_time: Time,
    /// `T_i`: in this time the integral does as much as the error itself.
    pub reset_time: Time,
    /// The greatest airspeed that it asks for. While it does, it learns nothing.
    pub top_speed: Speed,
    /// Time between two looks at its position.
    pub period: Time,
}

impl Default for HoldBeeParams {
    fn default() -> Self {
        Self {
            law: Law::Pi,
            response_time: Time::si(2.0),
            reset_time: Time::si(5.0),
            top_speed: Speed::si(8.0),
            period: Time::si(0.1),
        }
    }
}

/// What is done against the wind.
#[choice]
pub enum Law {
    /// Nothing: it drifts.
    None,
    /// It pushes in proportion to its error.
    P,
    /// And by the integral of its error.
    Pi,
}

impl Behavior for HoldBee {
    type Params = HoldBeeParams;

    fn build(params: HoldBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        positive("response_time", params.response_time)?;
        positive("reset_time", params.reset_time)?;
        positive("top_speed", params.top_speed)?;
        kit.every(params.period, Self::hold);
        Ok(Self {
            position: kit.sensor("position")?,
            params,
            home: None,
            learned: Velocity::ZERO,
        })
    }
}

impl HoldBee {
    fn hold(&mut self, bee: &mut Bee<'_>) {
        let p = &self.params;
        let here = bee.read(self.position);
        let error = *self.home.get_or_insert(here) - here;
        let proportional = error / p.response_time;
        let wanted = match p.law {
            Law::None => Velocity::ZERO,
            Law::P => proportional,
            Law::Pi => {
                if (proportional + self.learned).length() < p.top_speed {
                    self.learned += proportional * (p.period / p.reset_time);
                }
                proportional + self.learned
            }
        };
        let airspeed = wanted.limit(p.top_speed);
        bee.fly(bee.attitude().unrotate(airspeed));
        bee.metric("drift", error.length().metres(), "m");
        bee.metric("effort", airspeed.length().get(), "m/s");
        if matches!(p.law, Law::Pi) {
            bee.metric("wind", self.learned.length().get(), "m/s");
        }
    }
}

#[cfg(test)]
mod test;

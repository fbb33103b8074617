//! How a MAV flies: where it believes itself to be, and the legs of its way.
//!
//! Its position sensor errs by some decimetres, each time anew. The pilot believes what it commanded and
//! corrects it by what it reads,
//!
//! ```text
//! v <- v + (v_told - v) dt / tau          what the vehicle makes of the command
//! x <- x + v dt + k (z - x)               z: the reading                            (1)
//! ```
//! and flies toward the end of a leg with a speed in proportion to what is left of it.

use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec3;
use std::collections::VecDeque;

/// What a leg is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Act {
    /// To get there.
    Pass,
    /// To look down on the way.
    Look,
    /// To measure where this flower is, by its number in the map.
    Sample(usize),
    /// To pollinate this flower.
    Serve(usize),
}

/// A straight way, and how long to stay at its end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg {
    pub(crate) to: DVec3,
    pub(crate) act: Act,
    pub(crate) speed_m_s: f64,
    /// So near is there.
    pub(crate) near_m: f64,
    pub(crate) stay_s: f64,
    /// Whether it is flown however long it takes.
    pub(crate) firm: bool,
}

impl Leg {
    /// A way in the open.
    pub(crate) fn pass(to: DVec3, speed_m_s: f64) -> Self {
        Self {
            to,
            act: Act::Pass,
            speed_m_s,
            near_m: 0.8,
            stay_s: 0.0,
            firm: false,
        }
    }
}

/// What came of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step {
    Flies,
    /// A leg is over: its purpose, and whether its end was reached.
    Over(Act, bool),
    /// There is no leg left.
    Idle,
}

/// The pilot.
#[derive(Debug, Default)]
pub(crate) struct Pilot {
    /// Where it believes to be.
    pub(crate) here: DVec3,
    told: DVec3,
    moves: DVec3,
    updated: SimTime,
    legs: VecDeque<Leg>,
    begun: SimTime,
    stays: Option<SimTime>,
}

/// `tau` of (1), s.
const LAG_S: f64 = 0.5;
/// `k` of (1).
const TRUST: f64 = 0.3;
/// It brakes over this time, s.
const BRAKE_S: f64 = 1.2;
/// The fastest climb and descent, m/s.
const CLIMB_M_S: f64 = 2.0;
/// A leg may take this much longer than in still air, and so many seconds more.
const PATIENCE: f64 = 3.0;
const PATIENCE_S: f64 = 12.0;

impl Pilot {
    /// Starts anew at a place that is known.
    pub(crate) fn at(&mut self, place: DVec3, now: SimTime) {
        (self.here, self.told, self.moves, self.updated) = (place, DVec3::ZERO, DVec3::ZERO, now);
    }

    /// Equation (1).
    pub(crate) fn sense(&mut self, reading: DVec3, now: SimTime) {
        let dt_s = (now - self.updated).secs();
        self.updated = now;
        self.moves += (self.told - self.moves) * (dt_s / LAG_S).min(1.0);
        self.here += self.moves * dt_s;
        self.here += (reading - self.here) * TRUST;
    }

    /// What it tells the vehicle from now on, world frame, m/s.
    pub(crate) fn tell(&mut self, velocity: DVec3) -> DVec3 {
        self.told = velocity;
        velocity
    }

    pub(crate) fn clear(&mut self, now: SimTime) {
        self.legs.clear();
        (self.begun, self.stays) = (now, None);
    }

    pub(crate) fn add(&mut self, leg: Leg) {
        self.legs.push_back(leg);
    }

    /// The leg that is flown.
    pub(crate) fn leg(&mut self) -> Option<&mut Leg> {
        self.legs.front_mut()
    }

    /// Something is in the way: first up by this, then on; what was to be seen from lower down, from there.
    pub(crate) fn over(&mut self, up_m: f64, now: SimTime) {
        let speed_m_s = 2.0;
        let up = Leg::pass(self.here + DVec3::Z * up_m, speed_m_s);
        let looks = self.legs.iter_mut().filter(|leg| leg.act == Act::Look);
        looks.for_each(|leg| leg.to.z = leg.to.z.max(up.to.z));
        self.legs.push_front(up);
        (self.begun, self.stays) = (now, None);
    }

    /// The velocity for this step, m/s in the world frame, and what came of the last one.
    pub(crate) fn steer(&mut self, now: SimTime) -> (DVec3, Step) {
        let Some(leg) = self.legs.front().copied() else {
            return (DVec3::ZERO, Step::Idle);
        };
        let way = leg.to - self.here;
        let flown_s = (now - self.begun).secs();
        if self.stays.is_none() && way.length() < leg.near_m {
            self.stays = Some(now);
        }
        let over = match self.stays {
            Some(since) => (now - since).secs() >= leg.stay_s,
            None => false,
        };
        let limit_s = PATIENCE * (way.length() / leg.speed_m_s) + PATIENCE_S + leg.stay_s;
        let late = !leg.firm && flown_s > limit_s;
        if over || late {
            self.legs.pop_front();
            (self.begun, self.stays) = (now, None);
            return (toward(way, leg.speed_m_s), Step::Over(leg.act, over));
        }
        (toward(way, leg.speed_m_s), Step::Flies)
    }
}

/// The velocity that brings it along `way`.
pub(crate) fn toward(way: DVec3, speed_m_s: f64) -> DVec3 {
    let wanted = (way / BRAKE_S).clamp_length_max(speed_m_s);
    DVec3::new(wanted.x, wanted.y, wanted.z.clamp(-CLIMB_M_S, CLIMB_M_S))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(tenths: u64) -> SimTime {
        SimTime::from_nanos(tenths * 100_000_000)
    }

    /// Flies `legs` by (1) with readings that are right, until idle; where, when and how.
    fn fly(legs: &[Leg], blocked: bool) -> (DVec3, u64, Vec<Step>) {
        let (mut pilot, mut steps) = (Pilot::default(), Vec::new());
        legs.iter().for_each(|leg| pilot.add(*leg));
        let (mut place, mut moves) = (DVec3::ZERO, DVec3::ZERO);
        for tenths in 1..10_000 {
            pilot.sense(place, at(tenths));
            let (wanted, step) = pilot.steer(at(tenths));
            match step {
                Step::Idle => return (place, tenths, steps),
                Step::Flies => {}
                over @ Step::Over(..) => steps.push(over),
            }
            moves += (pilot.tell(wanted) - moves) * 0.2;
            if !blocked {
                place += moves * 0.1;
            }
        }
        panic!("it never arrives");
    }

    #[test]
    fn legs_are_flown_in_order_and_it_stays_where_it_should() {
        let there = DVec3::new(20.0, 0.0, 5.0);
        let stay = Leg {
            act: Act::Serve(3),
            near_m: 0.2,
            stay_s: 4.0,
            ..Leg::pass(there, 4.0)
        };
        let (place, tenths, steps) = fly(&[Leg::pass(there * 0.5, 4.0), stay], false);
        assert_eq!(
            steps,
            [Step::Over(Act::Pass, true), Step::Over(Act::Serve(3), true)]
        );
        assert!((place - there).length() < 0.3, "{place}");
        assert!((90..200).contains(&tenths), "{tenths}");
    }

    #[test]
    fn a_leg_that_cannot_be_flown_is_given_up() {
        let (_, tenths, steps) = fly(&[Leg::pass(DVec3::X * 10.0, 2.0)], true);
        assert_eq!(steps, [Step::Over(Act::Pass, false)]);
        assert!((260..280).contains(&tenths), "{tenths}");
    }
}

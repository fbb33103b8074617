//! What a tumbling body has come to: the steps of [`Motion::rotation`] where no formula is exact.
//!
//! They are counted from the start of the segment. A search for a touch asks for the same segment many times, so
//! each thread keeps the steps that it took of the segments it was asked for last, and takes none of them twice.
//! What is kept is what would be computed again: it shows in the time that it takes, and in nothing else.

use crate::motion::Motion;
use crate::rotation::Euler;
use glam::{DQuat, DVec3};
use std::cell::RefCell;

/// A segment that nobody begins anew is evaluated in at most this many, longer, steps.
const STEPS_MAX: u64 = 1 << 16;
/// Steps of one segment that are kept: it begins anew after so many, if all is as usual.
const KEPT: usize = 256;
/// Places for segments that are kept.
const PLACES: usize = 256;

thread_local! {
    static TAKEN: RefCell<Vec<Taken>> = const { RefCell::new(Vec::new()) };
}

/// Bits of all that the steps of a segment follow from: attitude, rate, torque, moments and step.
type Key = [u64; 11];

/// The steps of one segment.
#[derive(Clone, Default)]
struct Taken {
    of: Key,
    /// Attitude and body rate after one step, two steps, ...
    after: Vec<(DQuat, DVec3)>,
}

impl Taken {
    /// Attitude and body rate after `steps` steps of `step_s` from the start of the segment.
    fn after(&mut self, steps: u64, motion: &Motion, euler: &Euler, step_s: f64) -> (DQuat, DVec3) {
        let known = self.after.len().min(steps as usize);
        let mut state = match known {
            0 => (motion.q, motion.w),
            _ => self.after[known - 1],
        };
        for step in known as u64..steps {
            state = euler.advance(state.0, state.1, step_s);
            if step < KEPT as u64 {
                self.after.push(state);
            }
        }
        state
    }
}

fn key(motion: &Motion, log2: u32) -> Key {
    let [a, b, c, d] = motion.q.to_array().map(f64::to_bits);
    let [x, y, z] = motion.w.to_array().map(f64::to_bits);
    let [tx, ty, tz] = motion.torque.map(|t| u64::from(t.to_bits()) << 32);
    let [ix, iy, iz] = motion.inverse_inertia.map(|i| u64::from(i.to_bits()));
    [
        a,
        b,
        c,
        d,
        x,
        y,
        z,
        tx | ix,
        ty | iy,
        tz | iz,
        u64::from(log2),
    ]
}

fn place(key: &Key) -> usize {
    let mixed = key.iter().fold(0_u64, |sum, bits| {
        (sum.rotate_left(5) ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15)
    });
    (mixed >> 40) as usize % PLACES
}

/// Attitude and body rate of a tumbling body `span` nanoseconds after the start of its segment.
pub(crate) fn rotation(motion: &Motion, span: u64) -> (DQuat, DVec3) {
    let mut log2 = u32::from(motion.step_log2);
    while span >> log2 > STEPS_MAX {
        log2 += 1;
    }
    let step = 1_u64 << log2;
    let euler = motion.euler();
    let steps = span >> log2;
    let (q, w) = match steps {
        0 => (motion.q, motion.w),
        _ => TAKEN.with_borrow_mut(|taken| {
            taken.resize_with(PLACES, Taken::default);
            let key = key(motion, log2);
            let taken = &mut taken[place(&key)];
            if taken.of != key {
                taken.of = key;
                taken.after.clear();
            }
            taken.after(steps, motion, &euler, step as f64 / 1e9)
        }),
    };
    match span & (step - 1) {
        0 => (q, w),
        rest => euler.advance(q, w, rest as f64 / 1e9),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BodySpec, Shape};
    use simbeeotic_kernel::rng::Stream;

    /// A brick that tumbles, one of many.
    fn brick(stream: &mut Stream) -> Motion {
        let shape = Shape::Box {
            half_m: DVec3::new(0.1, 0.2, 0.3),
        };
        let mut motion = Motion::new(&BodySpec::new(shape, 1.0), 9.8, 0.5);
        motion.w = stream.in_ball(20.0);
        motion.torque = [0.01, 0.0, 0.02];
        motion.respin();
        assert_eq!(motion.spin, crate::motion::Spin::Tumbling);
        motion
    }

    /// The same by steps from the start, with nothing kept.
    fn anew(motion: &Motion, span: u64) -> (DQuat, DVec3) {
        let step = 1_u64 << motion.step_log2;
        let euler = motion.euler();
        let start = (motion.q, motion.w);
        let advance = |(q, w), nanos: u64| euler.advance(q, w, nanos as f64 / 1e9);
        let whole = (0..span / step).fold(start, |state, _| advance(state, step));
        match span % step {
            0 => whole,
            rest => advance(whole, rest),
        }
    }

    #[test]
    fn what_was_asked_before_does_not_show_in_any_bit() {
        let mut stream = Stream::new(1, "tumbling", "test");
        // More than there are places, so that some drive out others.
        let bricks: Vec<Motion> = (0..2 * PLACES).map(|_| brick(&mut stream)).collect();
        for _ in 0..4000 {
            let motion = &bricks[stream.below(bricks.len() as u64) as usize];
            let step = 1_u64 << motion.step_log2;
            // Beyond what is kept, too; every fourth at the end of a step.
            let span = stream.below(KEPT as u64 * 5 / 4 * step);
            let span = if span.is_multiple_of(4) {
                span / step * step
            } else {
                span
            };
            let (found, expected) = (rotation(motion, span), anew(motion, span));
            assert_eq!(
                found.0.to_array().map(f64::to_bits),
                expected.0.to_array().map(f64::to_bits)
            );
            assert_eq!(
                found.1.to_array().map(f64::to_bits),
                expected.1.to_array().map(f64::to_bits)
            );
        }
    }

    #[test]
    fn steps_that_were_taken_are_not_taken_again() {
        let mut stream = Stream::new(2, "tumbling", "test");
        let motion = brick(&mut stream);
        let span = 100 << motion.step_log2;
        let first = rotation(&motion, span);
        let kept = |motion: &Motion| {
            let key = key(motion, u32::from(motion.step_log2));
            TAKEN.with_borrow(|taken| {
                let taken = &taken[place(&key)];
                (taken.of == key).then_some(taken.after.len())
            })
        };
        assert_eq!(kept(&motion), Some(100));
        assert_eq!(rotation(&motion, span / 2), anew(&motion, span / 2));
        assert_eq!(rotation(&motion, span), first);
        assert_eq!(kept(&motion), Some(100));
    }
}

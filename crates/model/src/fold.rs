//! What happens, as words for the trace.

use simbeeotic_kernel::Committing;
use simbeeotic_physics::Motion;
use simbeeotic_radio::Command;
use simbeeotic_units::glam::DVec3;

/// Bytes, eight a word, and how many there were.
pub(crate) fn bytes(bytes: &[u8], cx: &mut Committing<'_>) {
    cx.fold(bytes.len() as u64);
    for chunk in bytes.chunks(8) {
        let mut word = [0; 8];
        word[..chunk.len()].copy_from_slice(chunk);
        cx.fold(u64::from_le_bytes(word));
    }
}

/// A radio command.
pub(crate) fn command(command: &Command) -> u64 {
    match command {
        Command::Sleep => 1,
        Command::Wake => 2,
        Command::Tune(channel) => {
            vector(DVec3::new(channel.centre.get(), channel.width.get(), 3.0))
        }
        Command::Power { level, current } => vector(DVec3::new(level.get(), current.get(), 4.0)),
        _ => 5,
    }
}

/// A motion: where the body is, how it moves, what pushes it, how it points and turns, and since when.
pub(crate) fn motion(motion: &Motion) -> u64 {
    floats(motion.numbers()) ^ motion.start().nanos()
}

/// A vector.
pub(crate) fn vector(v: DVec3) -> u64 {
    floats(v.to_array())
}

/// Floats as one word: the sum of their bits, each times an odd number of its own.
///
/// A float that differs always shows. The products do not wait for each other as folds do: 20 floats
/// take 8 ns instead of 30.
#[inline]
fn floats<const N: usize>(floats: [f64; N]) -> u64 {
    let mut sum = 0_u64;
    for (at, float) in floats.into_iter().enumerate() {
        let odd = 0x9e37_79b9_7f4a_7c15_u64
            .wrapping_add(0xbf58_476d_1ce4_e5b8_u64.wrapping_mul(at as u64));
        // Signs are the highest bits, and two of them would cancel: the sum forgets what overflows.
        let bits = float.to_bits();
        sum = sum.wrapping_add((bits ^ (bits >> 32)).wrapping_mul(odd));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_float_and_each_sign_counts() {
        let base = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        for at in 0..base.len() {
            for factor in [0.0, -1.0, 1.0 + f64::EPSILON] {
                let mut changed = base;
                changed[at] *= factor;
                assert_ne!(floats(changed), floats(base), "float {at} times {factor}");
            }
            for other in 0..at {
                let mut changed = base;
                changed[at] *= -1.0;
                changed[other] *= -1.0;
                assert_ne!(floats(changed), floats(base), "signs of {at} and {other}");
                let mut changed = base;
                changed.swap(at, other);
                assert_ne!(floats(changed), floats(base), "{at} and {other} swapped");
            }
        }
    }
}

//! What happens, as words for the trace.

use simbeeotic_kernel::{Committing, SimTime};
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

/// A motion as it is at `now`: where the body is, how it moves, what pushes it, how it points and
/// turns.
pub(crate) fn motion(motion: &Motion, now: SimTime) -> u64 {
    let state = motion.at(now);
    let q = state.world_from_body;
    floats([
        state.p_enu.to_array(),
        state.v_enu.to_array(),
        state.a_enu.to_array(),
        [q.x, q.y, q.z],
        [q.w, state.w_flu.x, state.w_flu.y],
        motion.torque().to_array(),
        [state.w_flu.z, 0.0, 0.0],
    ])
}

/// A vector.
pub(crate) fn vector(v: DVec3) -> u64 {
    floats([v.to_array()])
}

/// Floats as one word: the sum of their bits, each times an odd number of its own.
///
/// A float that differs always shows. The products do not wait for each other as folds do: 20 floats
/// take 8 ns instead of 30.
fn floats<const N: usize>(rows: [[f64; 3]; N]) -> u64 {
    let mut sum = 0_u64;
    let mut odd = 0x9e37_79b9_7f4a_7c15_u64;
    for float in rows.into_iter().flatten() {
        // Signs are the highest bits, and two of them would cancel: the sum forgets what overflows.
        let bits = float.to_bits();
        sum = sum.wrapping_add((bits ^ (bits >> 32)).wrapping_mul(odd));
        odd = odd.wrapping_add(0xbf58_476d_1ce4_e5b8);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_float_and_each_sign_counts() {
        let row = [1.0, 2.0, 3.0];
        let base = floats([row, row]);
        for at in 0..6 {
            for change in [0.0, -1.0, 1.0 + f64::EPSILON] {
                let mut rows = [row, row];
                rows[at / 3][at % 3] *= change;
                assert_ne!(floats(rows), base, "float {at} times {change}");
            }
        }
        let mirrored = row.map(|x: f64| -x);
        assert_ne!(floats([mirrored, row]), base);
        assert_ne!(floats([mirrored, mirrored]), base);
        assert_ne!(floats([[2.0, 1.0, 3.0], row]), base);
    }
}

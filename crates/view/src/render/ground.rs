//! Soft patches on a plain, so that it is not one flat colour: the same as on the page.

use std::sync::OnceLock;

/// Cells of the pattern each way, and how large it is on the ground, m: once small and once large.
const SIDE: usize = 64;
const TILE_M: f64 = 61.0;
const WIDE_M: f64 = 407.0;
/// How strong it is.
const STRONG: f32 = 0.045;

/// What the colour of the ground is multiplied by at a place, m, for a pixel so wide there, m: about 1.
pub(super) fn uneven([x_m, y_m]: [f64; 2], pixel_m: f64) -> f32 {
    let near = patch([x_m / TILE_M, y_m / TILE_M]);
    let far = patch([y_m / WIDE_M, x_m / WIDE_M]);
    // From far away the patches run together.
    let clear = (1.5 - 1.5 * pixel_m / 10.0).clamp(0.0, 1.0) as f32;
    1.0 + STRONG * clear * (near + far - 1.0)
}

/// The pattern at a place, in its widths; 0 to 1.
fn patch([x, y]: [f64; 2]) -> f32 {
    static PATTERN: OnceLock<Vec<f32>> = OnceLock::new();
    let pattern = PATTERN.get_or_init(pattern);
    let along = |at: f64| {
        let at = (at - at.floor()) * SIDE as f64 - 0.5;
        let low = at.floor();
        let place = |k: f64| (k as i64).rem_euclid(SIDE as i64) as usize;
        (place(low), place(low + 1.0), (at - low) as f32)
    };
    let ((left, right, x), (below, above, y)) = (along(x), along(y));
    let row = |row: usize| {
        let (a, b) = (pattern[row * SIDE + left], pattern[row * SIDE + right]);
        a + x * (b - a)
    };
    row(below) + y * (row(above) - row(below))
}

/// Three grids of chance over each other, the finer the fainter; 0 to 1.
fn pattern() -> Vec<f32> {
    let mut state = 12_345_u32;
    let mut chance = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / 4_294_967_296.0
    };
    let octaves = [(5, 0.5), (11, 0.3), (29, 0.2)].map(|(cells, weight)| {
        let values: Vec<f64> = (0..cells * cells).map(|_| chance()).collect();
        (cells, weight, values)
    });
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let mut pattern = Vec::with_capacity(SIDE * SIDE);
    for (y, x) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (y, x))) {
        let mut sum = 0.0;
        for (cells, weight, values) in &octaves {
            let along = |at: usize| at as f64 / SIDE as f64 * *cells as f64;
            let (u, v) = (along(x), along(y));
            let (i, j) = (u as usize, v as usize);
            let (f, g) = (smooth(u.fract()), smooth(v.fract()));
            let value = |i: usize, j: usize| values[i % cells + (j % cells) * cells];
            let row = |j: usize| value(i, j) * (1.0 - f) + value(i + 1, j) * f;
            sum += weight * (row(j) * (1.0 - g) + row(j + 1) * g);
        }
        pattern.push(sum as f32);
    }
    pattern
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_are_soft_repeat_and_are_gone_from_far_away() {
        let near = |x: f64| uneven([x, 7.0], 0.01);
        let values: Vec<f32> = (0..610).map(|k| near(0.1 * f64::from(k))).collect();
        let most = values.iter().copied().fold(0.0, f32::max);
        let least = values.iter().copied().fold(2.0, f32::min);
        assert!(
            most - least > 0.02 && most < 1.05 && least > 0.95,
            "{least} {most}"
        );
        assert!(
            values
                .windows(2)
                .all(|pair| (pair[0] - pair[1]).abs() < 0.02)
        );
        assert!((patch([0.3, 0.7]) - patch([1.3, -0.3])).abs() < 1e-4);
        assert_eq!(uneven([3.0, 7.0], 100.0), 1.0);
    }
}

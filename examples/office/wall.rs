//! Following a wall that is kept on one side.

use simbeeotic::prelude::*;
use simbeeotic::units::math;
use std::f64::consts::FRAC_PI_2;

/// On which side the wall is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// The wall is on the left.
    Left,
    /// The wall is on the right.
    Right,
}

impl Side {
    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }

    pub(super) fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// Echoes count from this much behind the nose on the open side to this far back on the wall's, rad.
const SECTOR: [f64; 2] = [-0.6, 2.6];
/// How much it turns to the wall for a metre too far away, rad/m.
const GAIN: f64 = 1.0;
/// The most that it turns in one step, rad.
const TURN_MAX: f64 = 0.4;
/// A wall that is farther than this is lost, and it turns to where the wall was, m.
const LOST_M: f64 = 1.5;
/// So it turns then, in one step, rad.
const TURN_LOST: f64 = 0.15;

/// The turn of one step, counter-clockwise, that brings the nearest echo of the wall's side abeam, and to
/// the distance `wanted_m`. Around an edge it goes in an arc, so through a door; in a corner it turns away.
pub(super) fn follow(scan: &Scan, side: Side, wanted_m: f64) -> f64 {
    let sign = side.sign();
    let mut nearest: Option<(f64, f64)> = None;
    for echo in scan.echoes() {
        let azimuth = sign * math::wrap_signed(echo.azimuth.get());
        let distance = echo.distance.get();
        let counts = (SECTOR[0]..=SECTOR[1]).contains(&azimuth) && distance < LOST_M;
        if counts && nearest.is_none_or(|(least, _)| distance < least) {
            nearest = Some((distance, azimuth));
        }
    }
    let Some((distance, azimuth)) = nearest else {
        return sign * TURN_LOST;
    };
    let turn = azimuth - FRAC_PI_2 + GAIN * (distance - wanted_m);
    sign * turn.clamp(-TURN_MAX, TURN_MAX)
}

/// The least distance within `half_rad` of a direction in the body frame; infinite if nothing is seen.
pub(super) fn clear_m(scan: &Scan, direction: f64, half_rad: f64) -> f64 {
    let off = |echo: &ScanEcho| math::wrap_signed(echo.azimuth.get() - direction).abs();
    let echoes = scan.echoes().filter(|echo| off(echo) <= half_rad);
    echoes
        .map(|echo| echo.distance.get())
        .fold(f64::INFINITY, f64::min)
}

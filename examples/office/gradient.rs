//! Where a beacon is, from how its strength changes along the way.

use simbeeotic::units::math;
use std::f64::consts::{FRAC_PI_4, TAU};

/// Points for each of eight directions: one for the direction of each metre that made the beacon louder,
/// or for the opposite of one that made it fainter; one less for the direction against it. When a
/// direction has more than `most`, all lose one: what was long ago is forgotten.
#[derive(Clone, Debug)]
pub(super) struct Gradient {
    most: f64,
    points: [f64; 8],
}

impl Gradient {
    pub(super) fn new(most: u32) -> Self {
        Self {
            most: f64::from(most),
            points: [0.0; 8],
        }
    }

    /// A metre was flown along `yaw`, and the beacon became louder by `louder_db`.
    pub(super) fn flown(&mut self, yaw: f64, louder_db: f64) {
        let sector = ((yaw / FRAC_PI_4).round() as i64).rem_euclid(8) as usize;
        let (ahead, behind) = (sector, (sector + 4) % 8);
        let (up, down) = match louder_db {
            db if db > 0.0 => (ahead, behind),
            db if db < 0.0 => (behind, ahead),
            _ => return,
        };
        self.points[up] += 1.0;
        self.points[down] = (self.points[down] - 1.0).max(0.0);
        if self.points[up] > self.most {
            for points in &mut self.points {
                *points = (*points - 1.0).max(0.0);
            }
        }
    }

    /// Where the beacon is, as a yaw; `None` while nothing speaks for any direction.
    pub(super) fn yaw(&self) -> Option<f64> {
        let mut sum = [0.0, 0.0];
        for (sector, points) in self.points.iter().enumerate() {
            let (sin, cos) = math::sin_cos(TAU * sector as f64 / 8.0);
            sum = [sum[0] + points * cos, sum[1] + points * sin];
        }
        (math::hypot(sum[0], sum[1]) > 1e-9).then(|| math::atan2(sum[1], sum[0]))
    }
}

#[cfg(test)]
mod test {
    use super::*;

    /// A square of four sides, each a few metres, before a beacon far in the north.
    #[test]
    fn louder_northwards_and_fainter_southwards_says_north() {
        let mut gradient = Gradient::new(5);
        assert_eq!(gradient.yaw(), None);
        for _ in 0..3 {
            for (degrees, louder) in [(0.0_f64, 0.0), (90.0, 1.0), (180.0, 0.0), (270.0, -1.0)] {
                gradient.flown(degrees.to_radians(), louder);
            }
        }
        let yaw = gradient.yaw().map(f64::to_degrees);
        assert!(yaw.is_some_and(|yaw| (yaw - 90.0).abs() < 1e-6), "{yaw:?}");
    }
}

//! The wind around the swarm, as pictures show it: arrows on a coarse grid.

use crate::message::{self, Timestamp};
use crate::recorder::Precision;
use crate::recording::{ReadError, Recording};
use crate::topic::Topic;
use simbeeotic_model::View;
use simbeeotic_model::units::Position;
use std::ops::RangeInclusive;

/// Arrows along each side of the grid, and upwards: 192 in all.
const ACROSS: u32 = 8;
const UPWARDS: u32 = 3;

/// How far the grid reaches to each side at least, m.
const LEAST_M: f32 = 5.0;

/// The wind at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wind {
    /// Virtual time, ns since the start of the run.
    pub time_ns: u64,
    /// Position (m) and velocity of the air (m/s), ENU, at the points of a grid. Points where the air is still
    /// are left out.
    pub arrows: Vec<[f32; 6]>,
}

impl Wind {
    /// The wind now, on a grid around these positions (ENU, m): 8 by 8 points over a box somewhat larger than
    /// theirs, in three layers, none of them below 0.5 m.
    pub fn around(view: &View<'_>, positions: impl IntoIterator<Item = [f32; 3]>) -> Self {
        let mut arrows = Vec::new();
        if !view.is_calm() {
            for [x, y, z] in grid(positions) {
                let position = Position::from_si([x, y, z].map(f64::from).into());
                let wind = view.wind(position).si().as_vec3().to_array();
                if wind != [0.0; 3] && wind.iter().all(|part| part.is_finite()) {
                    arrows.push([x, y, z, wind[0], wind[1], wind[2]]);
                }
            }
        }
        Self {
            time_ns: view.now().nanos(),
            arrows,
        }
    }

    pub(crate) fn pack(&self, precision: Precision) -> message::Wind {
        let part = |from: usize| -> Vec<f32> {
            let arrows = self.arrows.iter();
            arrows
                .flat_map(|arrow| arrow[from..from + 3].iter())
                .map(|number| precision.motion(f64::from(*number)))
                .collect()
        };
        message::Wind {
            timestamp: Some(Timestamp::from_ns(self.time_ns)),
            position_enu_m: part(0),
            velocity_enu_m_s: part(3),
        }
    }

    fn unpack(time_ns: u64, packed: message::Wind) -> Option<Self> {
        let (at, blows) = (&packed.position_enu_m, &packed.velocity_enu_m_s);
        if at.len() != blows.len() || !at.len().is_multiple_of(3) {
            return None;
        }
        let arrows = at.chunks_exact(3).zip(blows.chunks_exact(3));
        Some(Self {
            time_ns,
            arrows: arrows
                .map(|(a, b)| [a[0], a[1], a[2], b[0], b[1], b[2]])
                .collect(),
        })
    }
}

impl Recording {
    /// The wind at these virtual times, ns, in the order recorded: each holds until the next one.
    pub fn wind_in(
        &self,
        times_ns: RangeInclusive<u64>,
    ) -> impl Iterator<Item = Result<Wind, ReadError>> + '_ {
        self.unpacked(Topic::Wind, times_ns, Wind::unpack)
    }
}

/// The points of the grid: from low to high, then from south to north, then from west to east.
fn grid(positions: impl IntoIterator<Item = [f32; 3]>) -> Vec<[f32; 3]> {
    let (low, high) = bounds(positions);
    let place = |axis: usize, at: u32, of: u32| {
        low[axis] + (high[axis] - low[axis]) * at as f32 / (of - 1) as f32
    };
    let mut points = Vec::with_capacity((ACROSS * ACROSS * UPWARDS) as usize);
    for up in 0..UPWARDS {
        for north in 0..ACROSS {
            for east in 0..ACROSS {
                points.push([
                    place(0, east, ACROSS),
                    place(1, north, ACROSS),
                    place(2, up, UPWARDS),
                ]);
            }
        }
    }
    points
}

/// The box that holds everybody, somewhat widened.
fn bounds(positions: impl IntoIterator<Item = [f32; 3]>) -> ([f32; 3], [f32; 3]) {
    let mut low = [f32::INFINITY; 3];
    let mut high = [f32::NEG_INFINITY; 3];
    for position in positions {
        for axis in 0..3 {
            low[axis] = low[axis].min(position[axis]);
            high[axis] = high[axis].max(position[axis]);
        }
    }
    for axis in 0..3 {
        if !(low[axis].is_finite() && high[axis].is_finite()) {
            (low[axis], high[axis]) = (0.0, 0.0);
        }
        let middle = (low[axis] + high[axis]) / 2.0;
        let half = ((high[axis] - low[axis]) * 0.6).max(LEAST_M);
        (low[axis], high[axis]) = (middle - half, middle + half);
    }
    // The wind blows above the ground.
    low[2] = low[2].max(0.5);
    high[2] = high[2].max(low[2] + 1.0);
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_holds_everybody_and_stays_above_the_ground() {
        let (low, high) = bounds([[0.0, 0.0, 1.0], [100.0, 1.0, 2.0]]);
        assert!(low[0] < 0.0 && high[0] > 100.0);
        assert!(low[1] <= -4.0 && high[1] >= 5.0);
        assert!(low[2] >= 0.5 && high[2] > low[2]);
        let (low, high) = bounds([[f32::NAN; 3]]);
        assert!((0..3).all(|axis| low[axis] < high[axis]));
        assert_eq!(grid([]).len(), 192);
    }

    #[test]
    fn arrows_survive_being_written_and_a_list_in_disorder_is_refused() {
        let wind = Wind {
            time_ns: 5,
            arrows: vec![[1.0, 2.0, 3.0, 0.5, -0.25, 0.0], [4.0; 6]],
        };
        let packed = wind.pack(Precision::Fine);
        assert_eq!(Wind::unpack(5, packed.clone()), Some(wind));
        let mut uneven = packed;
        uneven.velocity_enu_m_s.pop();
        assert_eq!(Wind::unpack(5, uneven), None);
    }
}

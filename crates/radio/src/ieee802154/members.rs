//! The radios on one channel, a row each, and the power that a frame has at each of them.

use crate::aim::{self, End, antenna_from_world};
use crate::antenna::Antenna;
use crate::medium::Poses;
use crate::propagation::{FrameKeys, Links, Propagation, Role};
use crate::radio::RadioSpec;
use crate::scratch::ROW;
use glam::Mat3;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::{Frequency, Mount, Position};
use std::ops::Range;
use std::sync::Arc;

/// The radios on a channel, in columns. A row stays where it is while its radio does; rows that were
/// left are vacant, and are nowhere.
#[derive(Debug, Default)]
pub(super) struct Members {
    /// The radio in each row; `None` where it left.
    pub(super) radios: Vec<Option<u32>>,
    owners: Vec<ModelId>,
    keys: Vec<u64>,
    /// East, north, up of the antennas, metres; NaN for the vacant.
    enu_m: [Vec<f32>; 3],
    /// Gain of an antenna without direction, linear; 1 for those with one.
    gains: Vec<f32>,
    /// Walls and bodies are looked up for powers above this, milliwatts: 20 dB below the receiver's own
    /// noise a frame does no harm, with or without a wall.
    walls_above_mw: Vec<f32>,
    mounts: Vec<Mount>,
    directed: Vec<Option<Arc<dyn Antenna>>>,
    /// Rotations of directions from the world's frame to the antenna's, where it matters.
    antenna_from_world: Vec<Mat3>,
    any_mounted: bool,
    any_directed: bool,
    /// Who is listening, and the frames that passed beyond the range limit meanwhile.
    pub(super) listening: Vec<bool>,
    pub(super) beyond: Vec<u64>,
    vacant: Vec<u32>,
    posed: Option<(SimTime, u64)>,
    positions: Vec<Position>,
}

/// Where a frame comes from.
#[derive(Clone, Debug)]
pub(super) struct Source {
    pub(super) owner: ModelId,
    pub(super) radio_key: u64,
    pub(super) frame_key: u64,
    pub(super) time: SimTime,
    enu_m: [f32; 3],
    /// Power sent times the gain of an antenna without direction, milliwatts.
    eirp_mw: f32,
    directed: Option<Arc<dyn Antenna>>,
    antenna_from_world: Mat3,
    /// The sender's own row, where it hears nothing.
    row: usize,
}

/// What is the same for all pairs on a channel.
#[derive(Clone, Copy)]
pub(super) struct Space<'a> {
    pub(super) propagation: &'a dyn Propagation,
    pub(super) frequency: Frequency,
    pub(super) range_squared_m2: f32,
    /// Whether walls and bodies take their share.
    pub(super) walls: bool,
}

impl Members {
    /// Gives a radio a row.
    pub(super) fn join(&mut self, radio: u32, spec: &RadioSpec) -> usize {
        let uniform = spec.antenna.uniform_gain();
        let row = match self.vacant.pop() {
            Some(row) => row as usize,
            None => {
                self.grow();
                self.radios.len() - 1
            }
        };
        self.radios[row] = Some(radio);
        self.owners[row] = spec.owner;
        self.keys[row] = spec.key;
        self.gains[row] = uniform.map_or(1.0, |gain| gain.ratio() as f32);
        self.walls_above_mw[row] = (0.01 * spec.phy.noise.milliwatts()) as f32;
        self.mounts[row] = spec.mount;
        self.directed[row] = uniform.is_none().then(|| Arc::clone(&spec.antenna));
        self.beyond[row] = 0;
        self.listening[row] = false;
        self.any_directed |= uniform.is_none();
        self.any_mounted |= uniform.is_none() || spec.mount.position != Mount::IDENTITY.position;
        self.posed = None;
        row
    }

    fn grow(&mut self) {
        self.radios.push(None);
        self.owners.push(ModelId::default());
        self.keys.push(0);
        self.enu_m.iter_mut().for_each(|axis| axis.push(f32::NAN));
        self.gains.push(1.0);
        self.walls_above_mw.push(f32::INFINITY);
        self.mounts.push(Mount::default());
        self.directed.push(None);
        self.antenna_from_world.push(Mat3::IDENTITY);
        self.beyond.push(0);
        self.listening.push(false);
    }

    /// Takes a radio's row away.
    pub(super) fn leave(&mut self, row: usize) {
        self.radios[row] = None;
        self.listening[row] = false;
        self.enu_m.iter_mut().for_each(|axis| axis[row] = f32::NAN);
        self.vacant.push(row as u32);
    }

    /// Brings all antennas to where they are at `now`.
    pub(super) fn place(&mut self, now: SimTime, poses: &dyn Poses) {
        let at = Some((now, poses.generation()));
        if self.posed == at {
            return;
        }
        self.posed = at;
        self.positions.clear();
        poses.positions(&self.owners, &mut self.positions);
        let [east, north, up] = &mut self.enu_m;
        let columns = east.iter_mut().zip(north).zip(up);
        for (((east, north), up), position) in columns.zip(&self.positions) {
            [*east, *north, *up] = position.si().as_vec3().to_array();
        }
        if self.any_mounted {
            for row in 0..self.radios.len() {
                self.place_mounted(row, poses);
            }
        }
        for &row in &self.vacant {
            for axis in &mut self.enu_m {
                axis[row as usize] = f32::NAN;
            }
        }
    }

    fn place_mounted(&mut self, row: usize, poses: &dyn Poses) {
        let mount = self.mounts[row];
        if self.directed[row].is_some() || mount.position != Mount::IDENTITY.position {
            let antenna = poses.pose(self.owners[row]) * mount;
            self.antenna_from_world[row] = antenna_from_world(antenna.attitude);
            let place = antenna.position.si().as_vec3().to_array();
            (0..3).for_each(|axis| self.enu_m[axis][row] = place[axis]);
        }
    }

    /// The radio in `row` as the source of a frame. Placed before.
    pub(super) fn source(
        &self,
        row: usize,
        frame_key: u64,
        power_mw: f32,
        time: SimTime,
    ) -> Source {
        Source {
            owner: self.owners[row],
            radio_key: self.keys[row],
            frame_key,
            time,
            enu_m: self.at(row),
            eirp_mw: power_mw * self.gains[row],
            directed: self.directed[row].clone(),
            antenna_from_world: self.antenna_from_world[row],
            row,
        }
    }

    fn at(&self, row: usize) -> [f32; 3] {
        [self.enu_m[0][row], self.enu_m[1][row], self.enu_m[2][row]]
    }

    /// The power of a frame at each row of `rows`, milliwatts; 0 out of range, for the vacant, and for
    /// the sender. `powers` has the length of `rows`. Counts who was beyond the range if `count`.
    pub(super) fn powers(
        &mut self,
        source: &Source,
        rows: Range<usize>,
        space: &Space<'_>,
        poses: &dyn Poses,
        count: bool,
        powers: &mut [f32],
    ) {
        let first = rows.start;
        for (block, powers) in powers.chunks_mut(ROW).enumerate() {
            let start = first + block * ROW;
            self.block(source, start, space, poses, count, powers);
        }
        if rows.contains(&source.row) {
            powers[source.row - first] = 0.0;
        }
    }

    fn block(
        &mut self,
        source: &Source,
        start: usize,
        space: &Space<'_>,
        poses: &dyn Poses,
        count: bool,
        powers: &mut [f32],
    ) {
        let n = powers.len();
        let rows = start..start + n;
        let (mut squares, mut gains) = ([0.0f32; ROW], [0.0f32; ROW]);
        let (squares, gains) = (&mut squares[..n], &mut gains[..n]);
        let [x, y, z] = [0, 1, 2].map(|axis: usize| &self.enu_m[axis][rows.clone()][..n]);
        let [x0, y0, z0] = source.enu_m;
        for j in 0..n {
            let (dx, dy, dz) = (x[j] - x0, y[j] - y0, z[j] - z0);
            squares[j] = dx * dx + dy * dy + dz * dz;
        }
        if rows.contains(&source.row) {
            squares[source.row - start] = f32::NAN;
        }
        let links = Links {
            frequency: space.frequency,
            time: source.time,
            near_is: Role::Transmitter,
            near_enu_m: source.enu_m,
            near_key: source.radio_key,
            far_enu_m: [x, y, z],
            far_keys: &self.keys[rows.clone()],
            distances_squared_m2: squares,
            frames: FrameKeys::One(source.frame_key),
        };
        space.propagation.gains(&links, gains);
        let antennas = &self.gains[rows.clone()][..n];
        for j in 0..n {
            let power = source.eirp_mw * gains[j] * antennas[j];
            // No square that is not a number is within range.
            powers[j] = if squares[j] <= space.range_squared_m2 {
                power
            } else {
                0.0
            };
        }
        if self.any_directed {
            for (j, power) in powers.iter_mut().enumerate() {
                if *power > 0.0 {
                    *power *= self.directed_gain(source, start + j);
                }
            }
        }
        if space.walls {
            for (j, power) in powers.iter_mut().enumerate() {
                if *power > self.walls_above_mw[start + j] {
                    *power *= self.wall_gain(source, start + j, space.frequency, poses);
                }
            }
        }
        if count && space.range_squared_m2.is_finite() {
            let listening = &self.listening[rows.clone()][..n];
            let beyond = &mut self.beyond[rows][..n];
            for j in 0..n {
                beyond[j] += u64::from(listening[j] & (squares[j] > space.range_squared_m2));
            }
        }
    }

    /// Gains of the antennas with a direction at both ends of a link.
    fn directed_gain(&self, source: &Source, row: usize) -> f32 {
        let tx = End {
            enu_m: source.enu_m,
            antenna: source.directed.as_deref(),
            antenna_from_world: source.antenna_from_world,
        };
        let rx = End {
            enu_m: self.at(row),
            antenna: self.directed[row].as_deref(),
            antenna_from_world: self.antenna_from_world[row],
        };
        aim::directed_gain(&tx, &rx)
    }

    fn wall_gain(
        &self,
        source: &Source,
        row: usize,
        frequency: Frequency,
        poses: &dyn Poses,
    ) -> f32 {
        let ends = [
            (source.owner, source.enu_m),
            (self.owners[row], self.at(row)),
        ];
        aim::walls_gain(poses, ends, frequency)
    }
}

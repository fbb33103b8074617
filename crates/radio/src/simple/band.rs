//! One channel: the radios tuned to it, and the frames on it in this round. All in columns.

use super::pair::Listeners;
use crate::antenna::Antenna;
use crate::channel::Channel;
use crate::frame::Frame;
use crate::inbox::Hit;
use crate::medium::Poses;
use crate::radio::RadioSpec;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::{Attitude, Mount, Position};
use std::sync::Arc;

/// The radios on one channel and the frames among them.
#[derive(Debug)]
pub(super) struct Band {
    pub(super) channel: Channel,
    pub(super) members: Members,
    /// Frames ever sent here.
    pub(super) sent: u64,
    pub(super) air: Air,
    /// How this round is worked.
    pub(super) mode: Mode,
    pub(super) delivered: Delivered,
    /// Instant and generation of the positions in `members`.
    posed: Option<(SimTime, u64)>,
    positions: Vec<Position>,
}

/// How the receptions of a round are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    /// No frames.
    Quiet,
    /// Few frames: frame by frame when the round opens.
    ByFrame,
    /// Many frames: by each receiver for itself, in parallel.
    ByReceiver,
}

/// The radios on a channel, a row each.
#[derive(Debug, Default)]
pub(super) struct Members {
    pub(super) columns: Listeners,
    pub(super) owners: Vec<ModelId>,
    pub(super) awake: Vec<bool>,
    /// Which receiver each is, an index into the medium's curves.
    pub(super) curves: Vec<u32>,
    mounts: Vec<Mount>,
    /// Where the antennas are: east, north, up, metres. In `columns` only as long as they listen.
    pub(super) places: Vec<[f32; 3]>,
    /// The antenna, if its gain depends on the direction.
    pub(super) directed: Vec<Option<Arc<dyn Antenna>>>,
    /// world_from_antenna, where it matters.
    pub(super) attitudes: Vec<Attitude>,
    /// Whether `directed` may hold an antenna.
    pub(super) any_directed: bool,
    /// Whether all have the curve of the first.
    pub(super) one_curve: bool,
    /// Frames that came within range, and those above the sensitivity, in rounds by frame.
    pub(super) in_range: Vec<u64>,
    pub(super) audible: Vec<u64>,
}

/// The frames of this round, in columns and one by one.
#[derive(Debug, Default)]
pub(super) struct Air {
    pub(super) frames: Vec<Frame>,
    /// East, north, up of the senders, metres.
    pub(super) enu_m: [Vec<f32>; 3],
    /// Power of the sender times the gain of an antenna without direction, milliwatts.
    pub(super) eirp_mw: Vec<f32>,
    pub(super) keys: Vec<u64>,
    pub(super) radios: Vec<u32>,
    pub(super) radio_keys: Vec<u64>,
    /// Rows of the senders.
    pub(super) rows: Vec<u32>,
    /// Indices of the frames' lengths.
    pub(super) lengths: Vec<u32>,
    /// Whether all frames are of one length, and of one air time.
    pub(super) alike: bool,
    /// Whether a frame is for somebody in particular.
    pub(super) addressed: bool,
}

/// Receptions of a round by frame, sorted by row.
#[derive(Debug, Default)]
pub(super) struct Delivered {
    pub(super) hits: Vec<Hit>,
    /// First and number of the hits of each row.
    pub(super) spans: Vec<(u32, u32)>,
    /// Rows with hits, ascending.
    pub(super) rows: Vec<u32>,
    /// Row of each hit as it was found, frame by frame.
    found: Vec<(u32, Hit)>,
}

impl Band {
    pub(super) fn new(channel: Channel) -> Self {
        Self {
            channel,
            members: Members::default(),
            sent: 0,
            air: Air::default(),
            mode: Mode::Quiet,
            delivered: Delivered::default(),
            posed: None,
            positions: Vec::new(),
        }
    }

    /// Adds a radio; returns its row.
    pub(super) fn join(
        &mut self,
        radio: u32,
        spec: &RadioSpec,
        curve: u32,
        salt: u32,
        awake: bool,
    ) -> u32 {
        self.posed = None;
        self.delivered.spans.push((0, 0));
        self.members.push(radio, spec, curve, salt, awake)
    }

    /// Removes a row; returns the radio that now has this row, if any. In range and audible frames
    /// of the removed one come back.
    pub(super) fn leave(&mut self, row: u32) -> (Option<u32>, [u64; 2]) {
        self.clear();
        self.posed = None;
        self.delivered.spans.pop();
        self.members.remove(row as usize)
    }

    pub(super) fn set_awake(&mut self, row: u32, awake: bool) {
        self.posed = None;
        self.members.awake[row as usize] = awake;
    }

    /// Forgets the frames of the last round.
    pub(super) fn clear(&mut self) {
        if self.mode != Mode::Quiet {
            self.mode = Mode::Quiet;
            self.air.clear();
            self.delivered.clear();
        }
    }

    /// Brings members and frames to where they are at `now`. Sleepers are nowhere: no distance to
    /// NaN is within range.
    pub(super) fn place(&mut self, now: SimTime, poses: &dyn Poses) {
        let at = Some((now, poses.generation()));
        if self.posed != at {
            self.posed = at;
            self.positions.clear();
            poses.positions(&self.members.owners, &mut self.positions);
            self.members.place(&self.positions, poses);
        }
        self.locate_frames();
    }

    /// Puts a frame of the radio in `row` on the air.
    pub(super) fn send(&mut self, frame: Frame, row: u32, radio_key: u64, length: u32) {
        self.sent += 1;
        let air = &mut self.air;
        if let Some(first) = air.frames.first() {
            air.alike &= air.lengths[0] == length && first.airtime_ns == frame.airtime_ns;
        } else {
            air.alike = true;
        }
        air.addressed |= frame.destination.is_some();
        air.eirp_mw
            .push(frame.power_mw * self.members.columns.gains[row as usize]);
        air.keys.push(frame.key);
        air.radios.push(frame.radio.0);
        air.radio_keys.push(radio_key);
        air.rows.push(row);
        air.lengths.push(length);
        air.frames.push(frame);
    }

    /// Fills in where the frames come from.
    fn locate_frames(&mut self) {
        for (axis, column) in self.air.enu_m.iter_mut().enumerate() {
            column.clear();
            column.extend(
                self.air
                    .rows
                    .iter()
                    .map(|&row| self.members.places[row as usize][axis]),
            );
        }
    }
}

impl Members {
    fn push(&mut self, radio: u32, spec: &RadioSpec, curve: u32, salt: u32, awake: bool) -> u32 {
        let row = self.owners.len() as u32;
        let uniform = spec.antenna.uniform_gain();
        let c = &mut self.columns;
        c.enu_m.iter_mut().for_each(|axis| axis.push(f32::NAN));
        c.radios.push(radio);
        c.radio_keys.push(spec.key);
        c.gains
            .push(uniform.map_or(1.0, |gain| gain.ratio() as f32));
        c.sensitivities_mw
            .push(spec.sensitivity.milliwatts() as f32);
        c.salts.push(salt);
        self.owners.push(spec.owner);
        self.awake.push(awake);
        self.curves.push(curve);
        self.mounts.push(spec.mount);
        self.places.push([f32::NAN; 3]);
        self.directed
            .push(uniform.is_none().then(|| Arc::clone(&spec.antenna)));
        self.any_directed |= uniform.is_none();
        self.one_curve = self.curves[0] == curve && (self.one_curve || row == 0);
        self.attitudes.push(Attitude::IDENTITY);
        self.in_range.push(0);
        self.audible.push(0);
        row
    }

    fn remove(&mut self, row: usize) -> (Option<u32>, [u64; 2]) {
        let c = &mut self.columns;
        for axis in &mut c.enu_m {
            axis.swap_remove(row);
        }
        c.radios.swap_remove(row);
        c.radio_keys.swap_remove(row);
        c.gains.swap_remove(row);
        c.sensitivities_mw.swap_remove(row);
        c.salts.swap_remove(row);
        self.owners.swap_remove(row);
        self.awake.swap_remove(row);
        self.curves.swap_remove(row);
        self.mounts.swap_remove(row);
        self.places.swap_remove(row);
        self.directed.swap_remove(row);
        self.attitudes.swap_remove(row);
        let counts = [
            self.in_range.swap_remove(row),
            self.audible.swap_remove(row),
        ];
        (self.columns.radios.get(row).copied(), counts)
    }

    fn place(&mut self, positions: &[Position], poses: &dyn Poses) {
        for (row, &centre) in positions.iter().enumerate().take(self.owners.len()) {
            let mount = self.mounts[row];
            let mut position = centre;
            if self.directed[row].is_some() || mount.position != Mount::IDENTITY.position {
                let antenna = poses.pose(self.owners[row]) * mount;
                position = antenna.position;
                self.attitudes[row] = antenna.attitude;
            }
            let place = position.si().as_vec3().to_array();
            self.places[row] = place;
            for (column, place) in self.columns.enu_m.iter_mut().zip(place) {
                column[row] = if self.awake[row] { place } else { f32::NAN };
            }
        }
    }
}

impl Air {
    fn clear(&mut self) {
        self.frames.clear();
        self.eirp_mw.clear();
        self.keys.clear();
        self.radios.clear();
        self.radio_keys.clear();
        self.rows.clear();
        self.lengths.clear();
        self.addressed = false;
    }
}

impl Delivered {
    fn clear(&mut self) {
        for &row in &self.rows {
            self.spans[row as usize] = (0, 0);
        }
        self.rows.clear();
        self.hits.clear();
        self.found.clear();
    }

    /// Notes a reception. Frame by frame, rows ascending within a frame.
    pub(super) fn note(&mut self, row: u32, frame: u32, power_mw: f32) {
        self.found.push((row, Hit { frame, power_mw }));
        self.spans[row as usize].1 += 1;
    }

    /// Sorts what was noted by row; within a row by frame.
    pub(super) fn sort(&mut self) {
        if self.found.is_sorted_by_key(|&(row, _)| row) {
            self.rows.extend(self.found.iter().map(|&(row, _)| row));
            self.rows.dedup();
        } else {
            self.rows
                .extend((0..self.spans.len() as u32).filter(|&row| self.spans[row as usize].1 > 0));
        }
        let mut first = 0;
        for &row in &self.rows {
            let span = &mut self.spans[row as usize];
            span.0 = first;
            first += span.1;
            span.1 = 0;
        }
        self.hits.resize(self.found.len(), Hit::default());
        for &(row, hit) in &self.found {
            let span = &mut self.spans[row as usize];
            self.hits[(span.0 + span.1) as usize] = hit;
            span.1 += 1;
        }
    }

    /// Keeps only these of a row's hits.
    pub(super) fn keep(&mut self, row: u32, hits: &[Hit]) {
        let span = &mut self.spans[row as usize];
        span.1 = hits.len() as u32;
        self.hits[span.0 as usize..][..hits.len()].copy_from_slice(hits);
    }

    pub(super) fn hits(&self, row: u32) -> &[Hit] {
        let (first, count) = self.spans[row as usize];
        &self.hits[first as usize..(first + count) as usize]
    }
}

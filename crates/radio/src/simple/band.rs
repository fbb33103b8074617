//! One channel: the radios tuned to it, and the frames on it in this round. All in columns.

use super::near::{self, Near};
use super::pair::{Listeners, Reach};
use crate::aim::antenna_from_world;
use crate::antenna::Antenna;
use crate::channel::Channel;
use crate::frame::Frame;
use crate::grid::{Grid, share_within, widths_m};
use crate::inbox::Hit;
use crate::medium::Poses;
use crate::radio::RadioSpec;
use glam::Mat3;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::{Mount, Position};
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
    /// The members by place, in rounds by frame.
    pub(super) near: Near,
    /// Whether rounds by frame go by it.
    pub(super) by_grid: bool,
}

/// How the receptions of a round are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    /// No frames.
    Quiet,
    /// When the round opens: frame by frame if they are few, else with a grid.
    Delivered,
    /// Many frames in a narrow band: by each receiver for itself, in parallel.
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
    pub(super) places: [Vec<f32>; 3],
    /// The antenna, if its gain depends on the direction.
    pub(super) directed: Vec<Option<Arc<dyn Antenna>>>,
    /// Rotations of directions from the world's frame to the antenna's, where it matters.
    pub(super) antenna_from_world: Vec<Mat3>,
    /// How far an antenna may be off its platform's centre, m.
    pub(super) offset_m: f64,
    /// Whether some antenna may be off its platform's centre, or have a direction.
    any_mounted: bool,
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
    /// The halves of the keys.
    pub(super) keys_low: Vec<u32>,
    pub(super) keys_high: Vec<u32>,
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
    /// If the columns are sorted into a grid: which frame each entry is.
    pub(super) order: Vec<u32>,
    pub(super) grid: Grid,
    /// How far to look in it, m.
    pub(super) reach_m: f64,
}

/// Receptions of a round by frame, sorted by row.
#[derive(Debug, Default)]
pub(super) struct Delivered {
    pub(super) hits: Vec<Hit>,
    /// First and number of the hits of each row.
    pub(super) spans: Vec<(u32, u32)>,
    /// The row of each hit until they are sorted; then the rows with hits, ascending.
    pub(super) rows: Vec<u32>,
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
            near: Near::default(),
            by_grid: false,
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
        self.near.forget();
        self.delivered.spans.push((0, 0));
        self.members.push(radio, spec, curve, salt, awake)
    }

    /// Removes a row; returns the radio that now has this row, if any. In range and audible frames
    /// of the removed one come back.
    pub(super) fn leave(&mut self, row: u32) -> (Option<u32>, Reach) {
        self.clear();
        self.posed = None;
        self.near.forget();
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

    /// From how many frames on each receiver looks for itself, if it is `few` in a narrow band.
    pub(super) fn by_receiver_from(&self, few: usize) -> usize {
        if self.near.wide() {
            // A frame costs no pass over all members then, but looking for oneself does.
            few.saturating_mul((self.members.owners.len() / 128).max(1))
        } else {
            few
        }
    }

    /// Brings frames, and those members that they may reach, to where they are at `now`: by grid if the
    /// band is so wide that a frame reaches less than `share` of it.
    pub(super) fn place_by_frame(
        &mut self,
        now: SimTime,
        poses: &dyn Poses,
        range_m: f64,
        share: f64,
    ) {
        let count = self.members.owners.len();
        if self.near.wide() && self.near.holds(now, poses, count) {
            self.by_grid = true;
            // Some members will be placed, others not.
            self.posed = None;
            self.locate_frames_of(poses);
            return;
        }
        self.place(now, poses, range_m, share);
        self.by_grid = self.near.wide();
        if self.by_grid && !self.near.holds(now, poses, count) {
            self.near.build(now, poses, &self.members, range_m);
        }
    }

    /// Brings members and frames to where they are at `now`, the frames sorted into a grid if the band
    /// is so wide that each member is reached by less than `share` of them.
    pub(super) fn place_by_receiver(
        &mut self,
        now: SimTime,
        poses: &dyn Poses,
        range_m: f64,
        share: f64,
    ) {
        self.place(now, poses, range_m, share);
        let widths = widths_m(&self.air.enu_m);
        if range_m.is_finite() && share_within(range_m, widths) < share {
            self.air.sort(widths, range_m);
        }
    }

    /// Brings the senders to where they are now, and the frames with them.
    fn locate_frames_of(&mut self, poses: &dyn Poses) {
        for &row in &self.air.rows {
            let position = poses.position(self.members.owners[row as usize]);
            let place = self.members.place_row(row as usize, position, poses);
            (0..3).for_each(|axis| self.members.places[axis][row as usize] = place[axis]);
        }
        self.locate_frames();
    }

    /// Brings members and frames to where they are at `now`. Sleepers are nowhere: no distance to
    /// NaN is within range.
    fn place(&mut self, now: SimTime, poses: &dyn Poses, range_m: f64, share: f64) {
        let at = Some((now, poses.generation()));
        if self.posed != at {
            self.posed = at;
            self.positions.clear();
            poses.positions(&self.members.owners, &mut self.positions);
            self.members.place(&self.positions, poses);
        }
        if self.near.review_due(now) {
            self.near.review(now, &self.members.places, range_m, share);
        }
        self.locate_frames();
    }

    /// Puts a frame of the radio in `row` on the air.
    pub(super) fn send(&mut self, frame: Frame, row: u32, length: u32) {
        self.sent += 1;
        let (air, columns) = (&mut self.air, &self.members.columns);
        if let Some(first) = air.frames.first() {
            air.alike &= air.lengths[0] == length && first.airtime_ns == frame.airtime_ns;
        } else {
            air.alike = true;
        }
        air.addressed |= frame.destination.is_some();
        air.eirp_mw
            .push(frame.power_mw * columns.gains[row as usize]);
        air.keys.push(frame.key);
        air.keys_low.push(frame.key as u32);
        air.keys_high.push((frame.key >> 32) as u32);
        air.radios.push(frame.radio.0);
        air.radio_keys.push(columns.radio_keys[row as usize]);
        air.rows.push(row);
        air.lengths.push(length);
        air.frames.push(frame);
    }

    /// Fills in where the frames come from.
    fn locate_frames(&mut self) {
        for (column, places) in self.air.enu_m.iter_mut().zip(&self.members.places) {
            column.clear();
            column.extend(self.air.rows.iter().map(|&row| places[row as usize]));
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
        self.places.iter_mut().for_each(|axis| axis.push(f32::NAN));
        self.any_mounted |= uniform.is_none() || spec.mount.position != Mount::IDENTITY.position;
        self.offset_m = self.offset_m.max(spec.mount.position.si().length());
        self.directed
            .push(uniform.is_none().then(|| Arc::clone(&spec.antenna)));
        self.any_directed |= uniform.is_none();
        self.one_curve = self.curves[0] == curve && (self.one_curve || row == 0);
        self.antenna_from_world.push(Mat3::IDENTITY);
        self.in_range.push(0);
        self.audible.push(0);
        row
    }

    fn remove(&mut self, row: usize) -> (Option<u32>, Reach) {
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
        for axis in &mut self.places {
            axis.swap_remove(row);
        }
        self.directed.swap_remove(row);
        self.antenna_from_world.swap_remove(row);
        let reach = Reach {
            in_range: self.in_range.swap_remove(row),
            audible: self.audible.swap_remove(row),
        };
        (self.columns.radios.get(row).copied(), reach)
    }

    /// Where the antenna in `row` is, if its platform is at `position`; turns it, if that matters.
    pub(super) fn place_row(
        &mut self,
        row: usize,
        position: Position,
        poses: &dyn Poses,
    ) -> [f32; 3] {
        if !self.any_mounted {
            return position.si().as_vec3().to_array();
        }
        let mount = self.mounts[row];
        let mut place = position;
        if self.directed[row].is_some() || mount.position != Mount::IDENTITY.position {
            let antenna = poses.pose(self.owners[row]) * mount;
            self.antenna_from_world[row] = antenna_from_world(antenna.attitude);
            place = antenna.position;
        }
        let place = place.si().as_vec3().to_array();
        (0..3).for_each(|axis| self.places[axis][row] = place[axis]);
        place
    }

    fn place(&mut self, positions: &[Position], poses: &dyn Poses) {
        let [east, north, up] = &mut self.places;
        for (row, position) in positions.iter().enumerate().take(self.owners.len()) {
            [east[row], north[row], up[row]] = position.si().as_vec3().to_array();
        }
        if self.any_mounted {
            for (row, position) in positions.iter().enumerate() {
                self.place_row(row, *position, poses);
            }
        }
        for (column, places) in self.columns.enu_m.iter_mut().zip(&self.places) {
            column.copy_from_slice(places);
            for (place, _) in column
                .iter_mut()
                .zip(&self.awake)
                .filter(|(_, awake)| !**awake)
            {
                *place = f32::NAN;
            }
        }
    }
}

impl Air {
    pub(super) fn clear(&mut self) {
        self.frames.clear();
        self.eirp_mw.clear();
        self.keys.clear();
        self.keys_low.clear();
        self.keys_high.clear();
        self.radios.clear();
        self.radio_keys.clear();
        self.rows.clear();
        self.lengths.clear();
        self.addressed = false;
        self.order.clear();
    }

    /// Sorts the columns into a grid; the frames themselves stay as they are.
    fn sort(&mut self, widths_m: [f64; 3], range_m: f64) {
        fn sorted<T: Copy>(column: &mut Vec<T>, order: &[u32]) {
            *column = order.iter().map(|&frame| column[frame as usize]).collect();
        }
        self.reach_m = near::with_rounding(range_m, near::most_m(&self.enu_m));
        self.grid
            .build(&self.enu_m, widths_m, near::cell_m(range_m));
        self.order.extend_from_slice(self.grid.order());
        let order = &self.order[..];
        self.enu_m.iter_mut().for_each(|axis| sorted(axis, order));
        sorted(&mut self.eirp_mw, order);
        sorted(&mut self.keys, order);
        sorted(&mut self.keys_low, order);
        sorted(&mut self.keys_high, order);
        sorted(&mut self.radios, order);
        sorted(&mut self.radio_keys, order);
        sorted(&mut self.rows, order);
        sorted(&mut self.lengths, order);
    }
}

impl Delivered {
    pub(super) fn clear(&mut self) {
        for &row in &self.rows {
            self.spans[row as usize] = (0, 0);
        }
        self.rows.clear();
        self.hits.clear();
    }

    /// Notes who received a frame; in `receptions`, `Hit::frame` is the row of the receiver. Frame by
    /// frame, rows ascending within a frame.
    pub(super) fn note(&mut self, frame: u32, receptions: &[Hit]) {
        self.rows.extend(receptions.iter().map(|hit| hit.frame));
        self.hits
            .extend(receptions.iter().map(|&hit| Hit { frame, ..hit }));
    }

    /// Keeps what the receiver in `row` heard, in the order of the frames.
    pub(super) fn give(&mut self, row: u32, receptions: &[Hit]) {
        if !receptions.is_empty() {
            self.spans[row as usize] = (self.hits.len() as u32, receptions.len() as u32);
            self.hits.extend_from_slice(receptions);
            self.rows.push(row);
        }
    }

    /// Brings the rows with hits into their order.
    pub(super) fn list_rows(&mut self) {
        self.rows.clear();
        let rows = (0..).zip(&self.spans).filter(|(_, span)| span.1 > 0);
        self.rows.extend(rows.map(|(row, _)| row));
    }

    /// Sorts what was noted by row; within a row by frame.
    pub(super) fn sort(&mut self) {
        // One frame: already sorted, one hit a row.
        if self.rows.is_sorted_by(|a, b| a < b) {
            for (first, &row) in (0..).zip(&self.rows) {
                self.spans[row as usize] = (first, 1);
            }
            return;
        }
        // Few: not worth a look at all rows.
        if self.hits.len() < self.spans.len() / 8 {
            return self.sort_few();
        }
        for &row in &self.rows {
            self.spans[row as usize].1 += 1;
        }
        let mut first = 0;
        for span in self.spans.iter_mut().filter(|span| span.1 > 0) {
            let count = span.1;
            *span = (first, 0);
            first += count;
        }
        let mut sorted = vec![Hit::default(); self.hits.len()];
        for (&row, &hit) in self.rows.iter().zip(&self.hits) {
            let span = &mut self.spans[row as usize];
            sorted[(span.0 + span.1) as usize] = hit;
            span.1 += 1;
        }
        self.hits = sorted;
        self.list_rows();
    }

    fn sort_few(&mut self) {
        let mut noted: Vec<(u32, Hit)> = self
            .rows
            .iter()
            .copied()
            .zip(self.hits.iter().copied())
            .collect();
        noted.sort_unstable_by_key(|(row, hit)| (*row, hit.frame));
        self.rows.clear();
        for (place, (row, hit)) in noted.into_iter().enumerate() {
            self.hits[place] = hit;
            let span = &mut self.spans[row as usize];
            if span.1 == 0 {
                span.0 = place as u32;
                self.rows.push(row);
            }
            span.1 += 1;
        }
    }

    pub(super) fn hits(&self, row: u32) -> &[Hit] {
        let (first, count) = self.spans[row as usize];
        &self.hits[first as usize..(first + count) as usize]
    }

    pub(super) fn hits_mut(&mut self, row: u32) -> &mut [Hit] {
        let (first, count) = self.spans[row as usize];
        &mut self.hits[first as usize..(first + count) as usize]
    }

    /// Keeps only the first hits of a row.
    pub(super) fn truncate(&mut self, row: u32, count: usize) {
        self.spans[row as usize].1 = count as u32;
    }
}

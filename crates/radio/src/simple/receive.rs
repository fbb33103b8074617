//! Who receives what in a round: by frame or by receiver, with a grid or without.

use super::band::{Air, Band, Members};
use super::chance::Chances;
use super::medium::SimpleMedium;
use super::pair::{Between, Reach, count, count_scattered, listen, pick, tell};
use super::radio::{Heard, Radio};
use crate::medium::Poses;
use crate::propagation::Propagation;
use crate::scratch::{ROW, Scratch};
use simbeeotic_kernel::{ModelId, SimTime};
use std::ops::Range;
use std::sync::Arc;

/// So many receptions are kept at most, of 8 bytes each; of more, each receiver finds its own again.
const KEPT: usize = 1 << 23;

/// So many receivers at most have their books brought into the cache before they collect: side by side
/// that takes a fraction of the time that it takes one by one. Those of more would not stay there.
const WARMED: usize = 1024;

impl SimpleMedium {
    /// What is the same for all pairs of a band in this round.
    fn between<'a>(
        &self,
        band: &Band,
        propagation: &'a dyn Propagation,
        poses: &'a dyn Poses,
    ) -> Between<'a> {
        let range_m = self.config.range_limit.metres() as f32;
        Between {
            walls: self.config.walls.then_some(poses),
            per_m2: self.chances.as_ref().map(|chances| chances.per_m2),
            propagation,
            frequency: band.channel.centre,
            time: self.now,
            range_squared_m2: range_m * range_m,
            directed: band.members.any_directed,
        }
    }

    /// What a radio hears of the frames in its band, with the hits in `scratch`. Stops after the
    /// first row with a packet for the owner if `first_only`.
    pub(super) fn hear(
        &self,
        radio: &Radio,
        poses: &dyn Poses,
        scratch: &mut Scratch,
        first_only: bool,
    ) -> Heard {
        let band = &self.bands[radio.band as usize];
        let between = self.between(band, self.config.propagation.as_ref(), poses);
        let (members, air, me) = (&band.members, &band.air, radio.row as usize);
        let step = if first_only { ROW / 4 } else { ROW };

        scratch.hits.clear();
        let mut heard = Heard::default();
        let mut done = false;
        let mut look = |range: Range<usize>| {
            let mut first = range.start;
            while first < range.end && !done {
                let end = range.end.min(first + step);
                let from = scratch.hits.len();
                self.hear_row(
                    members,
                    air,
                    me,
                    first..end,
                    &between,
                    scratch,
                    &mut heard.reach,
                );
                let kept = heard.sort_out(air, members.owners[me], &mut scratch.hits[from..]);
                scratch.hits.truncate(from + kept);
                done = first_only && !scratch.hits.is_empty();
                first = end;
            }
        };
        if air.order.is_empty() {
            look(0..air.frames.len());
        } else if members.awake[me] {
            let here = [0, 1, 2].map(|axis| members.places[axis][me]);
            air.grid.around(here, air.reach_m, &mut look);
            // In the order in which they were submitted.
            scratch.hits.sort_unstable_by_key(|hit| hit.frame);
        }
        heard
    }

    /// What one receiver hears of a row of frames.
    #[inline]
    #[expect(
        clippy::too_many_arguments,
        reason = "called in two places, inlined in both"
    )]
    fn hear_row(
        &self,
        members: &Members,
        air: &Air,
        me: usize,
        range: Range<usize>,
        between: &Between<'_>,
        scratch: &mut Scratch,
        total: &mut Reach,
    ) {
        let curve = &self.curves[members.curves[me] as usize];
        let from = scratch.hits.len();
        let (first, count) = (range.start, range.len());
        let reach = listen(&mut scratch.row, members, me, air, range.clone(), between);
        total.in_range += reach.in_range;
        total.audible += reach.audible;
        if let Some(chances) = &self.chances {
            let keys = |j| [air.radio_keys[first + j], members.columns.radio_keys[me]];
            pick_by_chance(chances, scratch, first..range.end, self.now, keys);
        } else if air.alike {
            let table = curve.table(air.lengths[0]);
            pick(scratch, count, first, |_, slot| table[slot]);
        } else {
            let lengths = &air.lengths[range];
            pick(scratch, count, first, |j, slot| {
                curve.table(lengths[j])[slot]
            });
        }
        if !air.order.is_empty() {
            for hit in &mut scratch.hits[from..] {
                hit.frame = air.order[hit.frame as usize];
            }
        }
    }

    /// Finds all receptions of a band, frame by frame.
    pub(super) fn deliver_by_frame(
        &mut self,
        index: usize,
        poses: &dyn Poses,
        owners: &mut Vec<ModelId>,
    ) {
        let propagation = Arc::clone(&self.config.propagation);
        let between = self.between(&self.bands[index], propagation.as_ref(), poses);
        let band = &mut self.bands[index];
        let (members, air, scratch) = (&mut band.members, &band.air, &mut self.scratch);
        let range_m = self.config.range_limit.metres();
        for frame in 0..air.frames.len() {
            if band.by_grid {
                let from = [0, 1, 2].map(|axis| air.enu_m[axis][frame]);
                band.near.pick(self.now, poses, members, from, range_m);
            }
            let rows = band.by_grid.then_some(&band.near.rows[..]);
            let receivers = rows.map_or(members.owners.len(), <[u32]>::len);
            let length = air.lengths[frame];
            let mut first = 0;
            while first < receivers {
                let end = receivers.min(first + ROW);
                scratch.hits.clear();
                if let Some(rows) = rows {
                    let who = |at: usize| rows[at] as usize;
                    let picked = &band.near.picked;
                    let row = &mut scratch.row;
                    tell(
                        row,
                        members,
                        picked,
                        first..end,
                        who,
                        (air, frame),
                        &between,
                    );
                    count_scattered(row, members, end - first, |j| who(first + j), &between);
                } else {
                    let (row, columns) = (&mut scratch.row, &members.columns);
                    tell(
                        row,
                        members,
                        columns,
                        first..end,
                        |at| at,
                        (air, frame),
                        &between,
                    );
                    count(row, members, first..end, &between);
                }
                if let Some(chances) = &self.chances {
                    let columns = rows.map_or(&members.columns, |_| &band.near.picked);
                    let keys = |j| [air.radio_keys[frame], columns.radio_keys[first + j]];
                    pick_by_chance(chances, scratch, first..end, self.now, keys);
                } else if members.one_curve {
                    let table = self.curves[members.curves[0] as usize].table(length);
                    pick(scratch, end - first, first, |_, slot| table[slot]);
                } else {
                    let (curves, all) = (&members.curves, &self.curves);
                    pick(scratch, end - first, first, |j, slot| {
                        let row = rows.map_or(first + j, |rows| rows[first + j] as usize);
                        all[curves[row] as usize].table(length)[slot]
                    });
                }
                if let Some(rows) = rows {
                    for hit in &mut scratch.hits {
                        hit.frame = rows[hit.frame as usize];
                    }
                }
                band.delivered.note(frame as u32, &scratch.hits);
                first = end;
            }
        }
        band.delivered.sort();

        self.announce(index, owners);
    }

    /// Lists who has something delivered; books what is for others.
    fn announce(&mut self, band: usize, owners: &mut Vec<ModelId>) {
        let band = &mut self.bands[band];
        let (members, air) = (&band.members, &band.air);
        if !air.addressed {
            let rows = &band.delivered.rows;
            owners.extend(rows.iter().map(|&row| members.owners[row as usize]));
            if rows.len() <= WARMED {
                let words = rows.iter().map(|&row| {
                    let radio = members.columns.radios[row as usize] as usize;
                    self.radios[radio].touch() ^ u64::from(members.curves[row as usize])
                });
                std::hint::black_box(words.fold(0, |all, word| all ^ word));
            }
            return;
        }
        // Whoever hears nothing but what is for others will not collect: it is booked here.
        for index in 0..band.delivered.rows.len() {
            let row = band.delivered.rows[index];
            let owner = members.owners[row as usize];
            let mut heard = Heard::default();
            let kept = heard.sort_out(air, owner, band.delivered.hits_mut(row));
            band.delivered.truncate(row, kept);
            let radio = members.columns.radios[row as usize];
            self.radios[radio as usize].book(self.round, self.now, &heard);
            if kept > 0 {
                owners.push(owner);
            }
        }
    }

    /// Finds all receptions of a band whose frames are sorted into a grid. Receivers that are neighbours
    /// look at much the same frames: these are gathered once for all receivers of a cube, side by side and
    /// in the order in which they were submitted. `false` if there are too many receptions to keep; then
    /// nothing has been booked.
    pub(super) fn deliver_by_grid(
        &mut self,
        index: usize,
        poses: &dyn Poses,
        owners: &mut Vec<ModelId>,
    ) -> bool {
        let mut scratch = std::mem::take(&mut self.scratch);
        let mut delivered = std::mem::take(&mut self.bands[index].delivered);
        let mut party = std::mem::take(&mut self.party);
        let band = &self.bands[index];
        let (members, air) = (&band.members, &band.air);
        let between = self.between(band, self.config.propagation.as_ref(), poses);
        party.gather_receivers(members, self.config.range_limit.metres());
        party.near.senders_matter = between.directed || between.walls.is_some();
        let mut reaches = Vec::with_capacity(members.owners.len());
        for run in party.grid.buckets() {
            let mut rows = &party.grid.order()[run];
            while !rows.is_empty() {
                let count = party.near.gather_frames(air, members, rows, party.width_m);
                let (group, rest) = rows.split_at(count);
                rows = rest;
                let near = &party.near.air;
                for row in group
                    .iter()
                    .copied()
                    .filter(|&row| members.awake[row as usize])
                {
                    scratch.hits.clear();
                    let mut reach = Reach::default();
                    let mut first = 0;
                    while first < near.order.len() {
                        let end = near.order.len().min(first + ROW);
                        let me = row as usize;
                        self.hear_row(
                            members,
                            near,
                            me,
                            first..end,
                            &between,
                            &mut scratch,
                            &mut reach,
                        );
                        first = end;
                    }
                    delivered.give(row, &scratch.hits);
                    reaches.push((row, reach));
                }
            }
            if delivered.hits.len() > KEPT {
                break;
            }
        }
        self.scratch = scratch;
        self.party = party;
        let keeps = delivered.hits.len() <= KEPT;
        if keeps {
            delivered.list_rows();
        } else {
            delivered.clear();
        }
        let band = &mut self.bands[index];
        band.delivered = delivered;
        if keeps {
            for (row, reach) in reaches {
                band.members.in_range[row as usize] += reach.in_range;
                band.members.audible[row as usize] += reach.audible;
            }
            self.announce(index, owners);
        }
        keeps
    }

    /// Finds who of a band will receive anything; they look for themselves later. Who will not is
    /// booked here.
    pub(super) fn find_receivers(
        &mut self,
        band: usize,
        poses: &dyn Poses,
        owners: &mut Vec<ModelId>,
    ) {
        let mut scratch = std::mem::take(&mut self.scratch);
        let members = &self.bands[band].members;
        for row in (0..members.owners.len()).filter(|&row| members.awake[row]) {
            let radio = &self.radios[members.columns.radios[row] as usize];
            let heard = self.hear(radio, poses, &mut scratch, true);
            if scratch.hits.is_empty() {
                radio.book(self.round, self.now, &heard);
            } else {
                owners.push(members.owners[row]);
            }
        }
        self.scratch = scratch;
    }
}

/// Picks by distance, and by the states of the links if they have any.
fn pick_by_chance(
    chances: &Chances,
    scratch: &mut Scratch,
    range: Range<usize>,
    now: SimTime,
    keys: impl Fn(usize) -> [u64; 2],
) {
    let (first, n) = (range.start, range.len());
    let row = &mut *scratch.row;
    if chances.sieve((&row.slots[..n], &mut row.draws[..n]), now, keys) {
        pick(scratch, n, first, |_, _| u32::MAX);
    } else {
        pick(scratch, n, first, |_, slot| chances.good[slot]);
    }
}

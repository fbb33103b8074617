//! The air in columns: one pass over the receivers when a frame begins, and one when it ends.
//!
//! While a single frame is on the air, the passes are plain loops, and all that is known of the
//! receivers follows from the frame. Only when frames overlap, each receiver gets books of its own:
//! power on the channel, power of its frame, and logarithm of its frame's chance so far. An interval of a
//! receiver ends where a frame begins or ends that reaches it: frames that do not reach it change no bit
//! of what becomes of its own. As ns-3 has it, intervals end for all at once.
//!
//! The power on the channel is a sum that frames come to and leave again. It is kept in f64, of
//! powers rounded to multiples of 2^-50 mW (-150 dBm): such sums are exact up to 8 mW, so that nothing
//! remains of a frame that is gone, however strong, and the order of frames does not matter.
//!
//! The logarithm of a bit's chance comes from a `table` with straight lines between its steps. Who came through
//! is decided block by block, in a `room` of columns.

mod room;
mod table;

use super::Quirks;
use super::air::{Air, Modulation, OnAir, Receiver, Reception, Taking, Tally};
use crate::scratch::ROW;
use room::{Room, chance, luck_24};
use table::Table;

/// The air in columns.
#[derive(Debug)]
pub(super) struct FastAir {
    quirks: Quirks,
    tables: Vec<Table>,
    frames: Vec<OnAir>,
    /// Whether the only frame on the air began in silence: the columns of overlap are stale then.
    single: bool,
    /// As ns-3 has it: frames that ended at `ended_ns`, and still interfere with others that end then.
    ended: Vec<OnAir>,
    ended_ns: u64,

    receivers: Vec<Receiver>,
    noise_mw: Vec<f32>,
    /// The weakest frame that a row takes up in silence; infinite if it does not listen.
    thresholds_mw: Vec<f32>,
    one_modulation: bool,
    /// The frame that a row is taking in; 0 is none.
    locks: Vec<u32>,
    /// What the luck of a row hangs on.
    salts: Vec<u32>,
    /// Time spent in frames, ns.
    rx_ns: Vec<u64>,
    /// Frames heard, got and spoilt by noise since the books were last brought up to date.
    heard: Vec<u32>,
    got: Vec<u32>,
    spoilt: Vec<u32>,
    started: u32,
    books: Vec<Tally>,

    /// As ns-3 has it: when the present interval began, for all.
    since_ns: u64,
    /// The columns of overlap. When the row's present interval began: whole ns, which an f64 holds for
    /// 104 days, and which costs less to subtract and round than integers do.
    since: Vec<f64>,
    totals_mw: Vec<f64>,
    /// Where receivers weigh interference: the power of noise that would do as much harm.
    harms_mw: Vec<f64>,
    weighted: bool,
    powers_mw: Vec<f32>,
    /// Logarithm of the chance of what is over of the row's frame.
    ln_success: Vec<f32>,
    /// Interference times time, mW ns.
    energies: Vec<f32>,
}

/// Frames of no more power than this leave a sum of [`rounded`] powers as it is: 2^-51 mW, -153.5 dBm.
const UNFELT_MW: f32 = 1.0 / (1u64 << 51) as f32;

impl FastAir {
    pub(super) fn new(quirks: Quirks) -> Self {
        Self {
            quirks,
            tables: Vec::new(),
            frames: Vec::new(),
            single: false,
            ended: Vec::new(),
            ended_ns: 0,
            receivers: Vec::new(),
            noise_mw: Vec::new(),
            thresholds_mw: Vec::new(),
            one_modulation: true,
            locks: Vec::new(),
            salts: Vec::new(),
            rx_ns: Vec::new(),
            heard: Vec::new(),
            got: Vec::new(),
            spoilt: Vec::new(),
            started: 0,
            books: Vec::new(),
            since_ns: 0,
            since: Vec::new(),
            totals_mw: Vec::new(),
            harms_mw: Vec::new(),
            weighted: false,
            powers_mw: Vec::new(),
            ln_success: Vec::new(),
            energies: Vec::new(),
        }
    }

    /// Before a column of 32 bits overflows.
    fn settle(&mut self) {
        self.started = 0;
        for row in 0..self.books.len() {
            self.books[row] = self.tally(row);
            (self.heard[row], self.got[row], self.spoilt[row]) = (0, 0, 0);
            self.rx_ns[row] = 0;
        }
    }

    /// Fills the columns of overlap before a second frame begins.
    fn open_books(&mut self) {
        let Some(frame) = self.frames.first().filter(|_| self.single) else {
            return;
        };
        self.single = false;
        self.since_ns = frame.start_ns;
        self.since.fill(frame.start_ns as f64);
        self.powers_mw
            .copy_from_slice(&frame.powers_mw[..self.receivers.len()]);
        for (total, &power_mw) in self.totals_mw.iter_mut().zip(&self.powers_mw) {
            *total = rounded(power_mw);
        }
        if self.weighted {
            for (row, harm) in self.harms_mw.iter_mut().enumerate() {
                *harm = self.receivers[row].harm_mw(frame, row);
            }
        }
        self.ln_success.fill(0.0);
        self.energies.fill(0.0);
    }

    fn start_in_silence(&mut self, frame: &OnAir) {
        self.single = true;
        let n = self.receivers.len();
        let (powers, thresholds) = (&frame.powers_mw[..n], &self.thresholds_mw[..n]);
        let (locks, heard) = (&mut self.locks[..n], &mut self.heard[..n]);
        let counted = u32::from(frame.counted);
        for j in 0..n {
            let takes = powers[j] >= thresholds[j];
            locks[j] = if takes { frame.id } else { 0 };
            heard[j] += u32::from(takes) & counted;
        }
        if !self.one_modulation {
            for j in 0..n {
                if self.receivers[j].modulation != frame.modulation && locks[j] != 0 {
                    locks[j] = 0;
                    heard[j] -= counted;
                }
            }
        }
    }

    fn start_among_others<const WEIGHTED: bool>(&mut self, frame: &OnAir) {
        match self.quirks {
            Quirks::Ns3 => self.close_interval::<true>(frame, frame.start_ns),
            Quirks::None => self.close_interval::<false>(frame, frame.start_ns),
        }
        let n = self.receivers.len();
        // Frames that began at this very instant have numbers from here on.
        let together = self.frames.iter().filter(|f| f.start_ns == frame.start_ns);
        let fresh = together.map(|f| frame.id.wrapping_sub(f.id)).max();
        let fresh_span = fresh.unwrap_or(0);
        let fresh_from = frame.id.wrapping_sub(fresh_span);

        let counted = u32::from(frame.counted);
        let powers = &frame.powers_mw[..n];
        let receivers = &self.receivers[..n];
        let thresholds = &self.thresholds_mw[..n];
        let noise = &self.noise_mw[..n];
        let totals = &mut self.totals_mw[..n];
        let harms = &mut self.harms_mw[..n];
        let (locks, heard) = (&mut self.locks[..n], &mut self.heard[..n]);
        let own = &mut self.powers_mw[..n];
        let ln_success = &mut self.ln_success[..n];
        let energies = &mut self.energies[..n];
        let since = &mut self.since[..n];
        let now = frame.start_ns as f64;
        let one_modulation = self.one_modulation;
        for j in 0..n {
            let (power_mw, before_mw) = (powers[j], totals[j]);
            totals[j] = before_mw + rounded(power_mw);
            let known = one_modulation || receivers[j].modulation == frame.modulation;
            let strong = (power_mw >= thresholds[j]) & known;
            heard[j] += u32::from(strong) & counted;
            // Of signals that begin together, the strongest is taken up.
            let free = locks[j] == 0;
            let fresh = locks[j].wrapping_sub(fresh_from) < fresh_span;
            let harm_mw = if WEIGHTED { harms[j] } else { before_mw };
            if WEIGHTED {
                harms[j] += receivers[j].harm_mw(frame, j);
            }
            let over = power_mw >= receivers[j].lock * (noise[j] + harm_mw as f32);
            let takes = strong & ((free & over) | (!free & fresh & (power_mw > own[j])));
            locks[j] = if takes { frame.id } else { locks[j] };
            own[j] = if takes { power_mw } else { own[j] };
            ln_success[j] = if takes { 0.0 } else { ln_success[j] };
            energies[j] = if takes { 0.0 } else { energies[j] };
            since[j] = if takes { now } else { since[j] };
        }
    }

    /// Ends the present interval of the rows that `frame` reaches, or of `ALL`: what it did to the frame
    /// in each row. Rows without a frame are reckoned as well, which costs less than asking.
    fn close_interval<const ALL: bool>(&mut self, frame: &OnAir, now_ns: u64) {
        let all_ns = (now_ns - self.since_ns) as f32;
        self.since_ns = now_ns;
        if ALL && all_ns == 0.0 {
            return;
        }
        let now = now_ns as f64;
        let n = self.receivers.len();
        let (mut steps, mut rests) = ([0u32; ROW], [0.0f32; ROW]);
        let (mut others, mut ns) = ([0.0f32; ROW], [all_ns; ROW]);
        for first in (0..n).step_by(ROW) {
            let rows = first..n.min(first + ROW);
            let m = rows.len();
            let totals = &self.totals_mw[rows.clone()][..m];
            let own = &self.powers_mw[rows.clone()][..m];
            let noise = &self.noise_mw[rows.clone()][..m];
            let energies = &mut self.energies[rows.clone()][..m];
            let ln_success = &mut self.ln_success[rows.clone()][..m];
            if !ALL {
                let powers = &frame.powers_mw[rows.clone()][..m];
                let since = &mut self.since[rows.clone()][..m];
                for j in 0..m {
                    let felt = powers[j] > UNFELT_MW;
                    // Nothing comes of an interval that has no length.
                    ns[j] = if felt { (now - since[j]) as f32 } else { 0.0 };
                    since[j] = if felt { now } else { since[j] };
                }
            }
            let receivers = &self.receivers[rows][..m];
            for j in 0..m {
                others[j] = others_mw(totals[j], own[j]);
                energies[j] += others[j] * ns[j];
            }
            if self.weighted {
                let harms = &self.harms_mw[first..][..m];
                for j in 0..m {
                    others[j] = others_mw(harms[j], own[j] * receivers[j].co_channel);
                }
            }
            if self.one_modulation {
                let table = &self.tables[receivers[0].modulation as usize];
                for j in 0..m {
                    (steps[j], rests[j]) = table.place(own[j] / (noise[j] + others[j]));
                }
                for j in 0..m {
                    let bits = table.bits(ns[j], self.quirks);
                    ln_success[j] += bits * table.between(steps[j], rests[j]);
                }
            } else {
                for j in 0..m {
                    let table = &self.tables[receivers[j].modulation as usize];
                    let sinr = own[j] / (noise[j] + others[j]);
                    ln_success[j] += table.bits(ns[j], self.quirks) * table.ln_bit(sinr);
                }
            }
        }
    }

    /// Ends a frame that was alone on the air.
    fn end_single(&mut self, frame: &OnAir, now_ns: u64, receptions: &mut Vec<Reception>) {
        self.single = false;
        self.conclude::<true>(frame, now_ns, receptions);
    }

    fn end_among_others(&mut self, frame: &OnAir, now_ns: u64, receptions: &mut Vec<Reception>) {
        // ns-3 does not look at interference that ends: it counts as if it had not been.
        if self.quirks == Quirks::None {
            self.close_interval::<false>(frame, now_ns);
        }
        self.conclude::<false>(frame, now_ns, receptions);
    }

    /// Decides for each row that was taking in `frame` whether it came through, block by block.
    fn conclude<const SINGLE: bool>(
        &mut self,
        frame: &OnAir,
        now_ns: u64,
        receptions: &mut Vec<Reception>,
    ) {
        let n = self.receivers.len();
        let airtime_ns = now_ns - frame.start_ns;
        let table = &self.tables[frame.modulation as usize];
        let rest_ns = match SINGLE {
            true => airtime_ns as f32,
            false => (now_ns - self.since_ns) as f32,
        };
        let (all_rows, now) = (SINGLE || self.quirks == Quirks::Ns3, now_ns as f64);
        let all_bits = table.bits(airtime_ns as f32, self.quirks);
        let length_ns = (airtime_ns as f32).max(1.0);
        let counted = u32::from(frame.counted);
        let mut room = Room::default();
        for first in (0..n).step_by(ROW) {
            let rows = first..n.min(first + ROW);
            let mine = room.list(&self.locks[rows.clone()], frame.id);
            let own = match SINGLE {
                true => &frame.powers_mw[rows.clone()],
                false => &self.powers_mw[rows.clone()],
            };
            let noise = &self.noise_mw[rows.clone()];
            let salts = &self.salts[rows.clone()];
            for k in 0..mine {
                let j = usize::from(room.mine[k]);
                (room.own[k], room.noise[k], room.salts[k]) = (own[j], noise[j], salts[j]);
            }
            if all_rows {
                room.ns[..mine].fill(rest_ns);
            } else {
                let since = &self.since[rows.clone()];
                for k in 0..mine {
                    room.ns[k] = (now - since[usize::from(room.mine[k])]) as f32;
                }
            }
            if SINGLE {
                room.ln_success[..mine].fill(0.0);
            } else {
                let totals = &self.totals_mw[rows.clone()];
                let before = &self.ln_success[rows];
                for k in 0..mine {
                    let j = usize::from(room.mine[k]);
                    room.others[k] = others_mw(totals[j], own[j]);
                    room.ln_success[k] = before[j];
                }
                room.harms[..mine].copy_from_slice(&room.others[..mine]);
                if self.weighted {
                    for k in 0..mine {
                        let row = first + usize::from(room.mine[k]);
                        let own_mw = room.own[k] * self.receivers[row].co_channel;
                        room.harms[k] = others_mw(self.harms_mw[row], own_mw);
                    }
                }
            }
            room.reckon(table, self.quirks, frame.key, mine);
            for k in 0..mine {
                let row = first + usize::from(room.mine[k]);
                let through = room.over[k] < 0.0;
                self.locks[row] = 0;
                self.rx_ns[row] += airtime_ns;
                self.got[row] += u32::from(through) & counted;
            }
            let (lucky, lost) = room.sort(mine);
            receptions.extend(room.lucky[..lucky].iter().map(|&at| {
                let k = usize::from(at);
                let row = first + usize::from(room.mine[k]);
                let energy = match SINGLE {
                    true => 0.0,
                    false => self.energies[row] + room.others[k] * room.ns[k],
                };
                Reception {
                    row: row as u32,
                    power_mw: room.own[k],
                    ln_success: room.ln_success[k],
                    sinr: room.own[k] / (room.noise[k] + energy / length_ns),
                }
            }));
            for &at in &room.lost[..lost] {
                let k = usize::from(at);
                let row = first + usize::from(room.mine[k]);
                let spoilt = SINGLE || {
                    let alone = table.ln_bit(room.own[k] / room.noise[k]);
                    alone < 0.0 && luck_24(frame.key, room.salts[k]) >= chance(all_bits * alone)
                };
                self.spoilt[row] += u32::from(spoilt) & counted;
            }
        }
    }

    /// Takes the power of a frame off the channel.
    fn leave(&mut self, frame: &OnAir) {
        for (total, &power_mw) in self.totals_mw.iter_mut().zip(&frame.powers_mw) {
            *total -= rounded(power_mw);
        }
        if self.weighted {
            for (row, harm) in self.harms_mw.iter_mut().enumerate() {
                *harm -= self.receivers[row].harm_mw(frame, row);
            }
        }
    }

    /// Takes off the channel what ended before.
    fn clear_ended(&mut self) {
        for frame in std::mem::take(&mut self.ended) {
            self.leave(&frame);
        }
    }
}

/// What others add to a frame's own power on the channel.
#[inline(always)]
fn others_mw(total_mw: f64, own_mw: f32) -> f32 {
    let others_mw = (total_mw - rounded(own_mw)) as f32;
    if others_mw > 0.0 { others_mw } else { 0.0 }
}

impl Receiver {
    /// The power of noise that would do as much harm as a frame in `row`, the receiver's own.
    #[inline(always)]
    fn harm_mw(&self, frame: &OnAir, row: usize) -> f64 {
        rounded(frame.powers_mw[row] * self.weight(frame.modulation))
    }
}

impl Air for FastAir {
    fn learn(&mut self, modulation: &Modulation) {
        self.tables.push(Table::new(modulation));
    }

    fn join(&mut self, row: usize, receiver: Receiver) {
        self.clear_ended();
        if row >= self.receivers.len() {
            let n = row + 1;
            self.receivers.resize(n, Receiver::default());
            self.noise_mw.resize(n, 1.0);
            self.thresholds_mw.resize(n, f32::INFINITY);
            self.locks.resize(n, 0);
            self.salts.resize(n, 0);
            self.rx_ns.resize(n, 0);
            self.heard.resize(n, 0);
            self.got.resize(n, 0);
            self.spoilt.resize(n, 0);
            self.books.resize(n, Tally::default());
            self.since.resize(n, 0.0);
            self.totals_mw.resize(n, 0.0);
            self.harms_mw.resize(n, 0.0);
            self.powers_mw.resize(n, 0.0);
            self.ln_success.resize(n, 0.0);
            self.energies.resize(n, 0.0);
        }
        for frame in &mut self.frames {
            frame.powers_mw.resize(self.receivers.len(), 0.0);
            frame.powers_mw[row] = 0.0;
        }
        self.open_books();
        self.receivers[row] = receiver;
        self.noise_mw[row] = receiver.noise_mw;
        self.thresholds_mw[row] = f32::INFINITY;
        let first = self.receivers[0].modulation;
        self.one_modulation = self.receivers.iter().all(|r| r.modulation == first);
        self.harms_mw[row] = 0.0;
        if !self.weighted && receiver.co_channel != 1.0 {
            self.weighted = true;
            // From here on also for what is on the air.
            for (row, harm) in self.harms_mw.iter_mut().enumerate() {
                let harms = self
                    .frames
                    .iter()
                    .map(|f| self.receivers[row].harm_mw(f, row));
                *harm = harms.sum();
            }
        }
        self.locks[row] = 0;
        self.salts[row] = receiver.salt;
        (self.heard[row], self.got[row], self.spoilt[row]) = (0, 0, 0);
        self.rx_ns[row] = 0;
        self.books[row] = Tally::default();
        self.totals_mw[row] = 0.0;
        self.powers_mw[row] = 0.0;
    }

    fn reveal(&mut self, row: usize, frame: usize, power_mw: f32) {
        self.frames[frame].powers_mw[row] = power_mw;
        self.totals_mw[row] += rounded(power_mw);
        if self.weighted {
            self.harms_mw[row] += self.receivers[row].harm_mw(&self.frames[frame], row);
        }
    }

    fn listen(&mut self, row: usize, now_ns: u64, listening: bool) -> Option<Taking> {
        let receiver = &self.receivers[row];
        let silent_mw = receiver.lock * receiver.noise_mw;
        self.thresholds_mw[row] = match listening {
            true => silent_mw.max(receiver.sensitivity_mw),
            false => f32::INFINITY,
        };
        let taking = self.taking(row)?;
        self.locks[row] = 0;
        self.rx_ns[row] += now_ns - taking.since_ns;
        self.books[row].dropped += u64::from(taking.counted);
        Some(taking)
    }

    fn start(&mut self, frame: OnAir) {
        if self.started == u32::MAX {
            self.settle();
        }
        self.started += 1;
        self.clear_ended();
        if self.frames.is_empty() {
            self.start_in_silence(&frame);
        } else {
            self.open_books();
            match self.weighted {
                true => self.start_among_others::<true>(&frame),
                false => self.start_among_others::<false>(&frame),
            }
        }
        self.frames.push(frame);
    }

    fn end(&mut self, id: u32, now_ns: u64, receptions: &mut Vec<Reception>) -> Vec<f32> {
        let Some(at) = self.frames.iter().position(|frame| frame.id == id) else {
            return Vec::new();
        };
        if self.ended_ns != now_ns {
            self.clear_ended();
        }
        let frame = self.frames.swap_remove(at);
        if self.single {
            self.end_single(&frame, now_ns, receptions);
        } else {
            self.end_among_others(&frame, now_ns, receptions);
        }
        if self.frames.is_empty() {
            self.ended.clear();
            // Exactly so already, unless there were more than 8 mW.
            self.totals_mw.fill(0.0);
            self.harms_mw.fill(0.0);
        } else if self.quirks == Quirks::Ns3 {
            self.ended_ns = now_ns;
            self.ended.push(frame);
            return Vec::new();
        } else {
            self.leave(&frame);
        }
        frame.powers_mw
    }

    fn frames(&self) -> &[OnAir] {
        &self.frames
    }

    fn total_mw(&self, row: usize) -> f64 {
        match self.frames.first() {
            None => 0.0,
            Some(frame) if self.single => rounded(frame.powers_mw[row]),
            Some(_) => {
                let ended = self.ended.iter().map(|frame| rounded(frame.powers_mw[row]));
                self.totals_mw[row] - ended.sum::<f64>()
            }
        }
    }

    fn taking(&self, row: usize) -> Option<Taking> {
        let id = self.locks[row];
        let frame = self.frames.iter().find(|frame| frame.id == id)?;
        Some(Taking {
            since_ns: frame.start_ns,
            counted: frame.counted,
        })
    }

    fn tally(&self, row: usize) -> Tally {
        let book = self.books[row];
        Tally {
            heard: book.heard + u64::from(self.heard[row]),
            got: book.got + u64::from(self.got[row]),
            noise: book.noise + u64::from(self.spoilt[row]),
            dropped: book.dropped,
            rx_ns: book.rx_ns + self.rx_ns[row],
        }
    }
}

/// The nearest multiple of 2^-50 mW, up to 2 mW; above, of what an f64 holds beside 6.
#[inline(always)]
fn rounded(power_mw: f32) -> f64 {
    const ANCHOR_MW: f64 = 6.0;
    (f64::from(power_mw) + ANCHOR_MW) - ANCHOR_MW
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn nothing_remains_of_a_strong_frame_that_is_gone() {
        let weak = 1.3e-11f32;
        let sum = rounded(weak) + rounded(0.7) + rounded(0.01) - rounded(0.7) - rounded(0.01);
        assert_eq!(sum, rounded(weak));
        assert!((sum - f64::from(weak)).abs() < 1e-15);
    }
}

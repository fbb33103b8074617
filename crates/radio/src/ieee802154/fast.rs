//! The air in columns: one pass over the receivers when a frame begins, and one when it ends.
//!
//! While a single frame is on the air, the passes are plain loops, and all that is known of the
//! receivers follows from the frame. Only when frames overlap, each receiver gets books of its own:
//! power on the channel, power of its frame, and logarithm of its frame's chance so far. The present
//! interval began for all at one time, when the last frame began or ended.
//!
//! The power on the channel is a sum that frames come to and leave again. It is kept in f64, of
//! powers rounded to multiples of 2^-50 mW (-150 dBm): such sums are exact up to 8 mW, so that nothing
//! remains of a frame that is gone, however strong, and the order of frames does not matter.
//!
//! The logarithm of a bit's chance comes from a table with straight lines between its steps.

use super::Quirks;
use super::air::{Air, Modulation, OnAir, Receiver, Reception, Taking, Tally, luck, survives};
use crate::scratch::ROW;
use simbeeotic_units::math;

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
    /// Frames heard since the books were last brought up to date.
    heard: Vec<u32>,
    started: u32,
    books: Vec<Tally>,

    /// The columns of overlap. Time of the last change on the air, low bits of the ns.
    since_ns: u32,
    totals_mw: Vec<f64>,
    powers_mw: Vec<f32>,
    /// Logarithm of the chance of what is over of the row's frame.
    ln_success: Vec<f32>,
    /// Interference times time, mW ns.
    energies: Vec<f32>,
}

/// The longest frame: times within it are told by 32 bits.
pub(super) const AIRTIME_NS_MAX: u64 = u32::MAX as u64 / 2;

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
            heard: Vec::new(),
            started: 0,
            books: Vec::new(),
            since_ns: 0,
            totals_mw: Vec::new(),
            powers_mw: Vec::new(),
            ln_success: Vec::new(),
            energies: Vec::new(),
        }
    }

    /// Before a column of 32 bits overflows.
    fn settle(&mut self) {
        self.started = 0;
        for (book, heard) in self.books.iter_mut().zip(&mut self.heard) {
            book.heard += u64::from(std::mem::take(heard));
        }
    }

    /// Fills the columns of overlap before a second frame begins.
    fn open_books(&mut self) {
        let Some(frame) = self.frames.first().filter(|_| self.single) else {
            return;
        };
        self.single = false;
        self.since_ns = frame.start_ns as u32;
        self.powers_mw
            .copy_from_slice(&frame.powers_mw[..self.receivers.len()]);
        for (total, &power_mw) in self.totals_mw.iter_mut().zip(&self.powers_mw) {
            *total = rounded(power_mw);
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

    fn start_among_others(&mut self, frame: &OnAir) {
        self.close_interval(frame.start_ns as u32);
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
        let (locks, heard) = (&mut self.locks[..n], &mut self.heard[..n]);
        let own = &mut self.powers_mw[..n];
        let ln_success = &mut self.ln_success[..n];
        let energies = &mut self.energies[..n];
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
            let over = power_mw > receivers[j].lock * (noise[j] + before_mw as f32);
            let takes = strong & ((free & over) | (!free & fresh & (power_mw > own[j])));
            locks[j] = if takes { frame.id } else { locks[j] };
            own[j] = if takes { power_mw } else { own[j] };
            ln_success[j] = if takes { 0.0 } else { ln_success[j] };
            energies[j] = if takes { 0.0 } else { energies[j] };
        }
    }

    /// Ends the present interval for all: what it did to the frame in each row. Rows without a frame
    /// are reckoned as well, which costs less than asking.
    fn close_interval(&mut self, now_ns: u32) {
        let ns = now_ns.wrapping_sub(self.since_ns) as f32;
        self.since_ns = now_ns;
        if ns == 0.0 {
            return;
        }
        let n = self.receivers.len();
        let (mut steps, mut rests, mut others) = ([0u32; ROW], [0.0f32; ROW], [0.0f32; ROW]);
        for first in (0..n).step_by(ROW) {
            let rows = first..n.min(first + ROW);
            let m = rows.len();
            let totals = &self.totals_mw[rows.clone()][..m];
            let own = &self.powers_mw[rows.clone()][..m];
            let noise = &self.noise_mw[rows.clone()][..m];
            let energies = &mut self.energies[rows.clone()][..m];
            let ln_success = &mut self.ln_success[rows.clone()][..m];
            let receivers = &self.receivers[rows][..m];
            for j in 0..m {
                others[j] = others_mw(totals[j], own[j]);
                energies[j] += others[j] * ns;
            }
            if self.one_modulation {
                let table = &self.tables[receivers[0].modulation as usize];
                let bits = table.bits(ns, self.quirks);
                for j in 0..m {
                    (steps[j], rests[j]) = table.place(own[j] / (noise[j] + others[j]));
                }
                for j in 0..m {
                    ln_success[j] += bits * table.between(steps[j], rests[j]);
                }
            } else {
                for j in 0..m {
                    let table = &self.tables[receivers[j].modulation as usize];
                    let sinr = own[j] / (noise[j] + others[j]);
                    ln_success[j] += table.bits(ns, self.quirks) * table.ln_bit(sinr);
                }
            }
        }
    }

    fn end_single(&mut self, frame: &OnAir, now_ns: u64, receptions: &mut Vec<Reception>) {
        let n = self.receivers.len();
        let airtime_ns = now_ns - frame.start_ns;
        let table = &self.tables[frame.modulation as usize];
        let bits = table.bits(airtime_ns as f32, self.quirks);
        let counted = u64::from(frame.counted);
        let powers = &frame.powers_mw[..n];
        let receivers = &self.receivers[..n];
        let (locks, books) = (&mut self.locks[..n], &mut self.books[..n]);
        for j in 0..n {
            if locks[j] != frame.id {
                continue;
            }
            locks[j] = 0;
            let sinr = powers[j] / receivers[j].noise_mw;
            let ln_success = bits * table.ln_bit(sinr);
            let luck = luck(frame.key, receivers[j].salt);
            books[j].rx_ns += airtime_ns;
            if survives(luck, ln_success.into()) {
                books[j].got += counted;
                receptions.push(Reception {
                    row: j as u32,
                    power_mw: powers[j],
                    ln_success,
                    sinr,
                });
            } else {
                books[j].noise += counted;
            }
        }
        self.single = false;
    }

    fn end_among_others(&mut self, frame: &OnAir, now_ns: u64, receptions: &mut Vec<Reception>) {
        // ns-3 does not look at interference that ends: it counts as if it had not been.
        let closed = self.quirks == Quirks::None;
        if closed {
            self.close_interval(now_ns as u32);
        }
        let n = self.receivers.len();
        let airtime_ns = now_ns - frame.start_ns;
        let length_ns = (airtime_ns as f32).max(1.0);
        let rest_ns = (now_ns as u32).wrapping_sub(self.since_ns) as f32;
        let table = &self.tables[frame.modulation as usize];
        let rest_bits = table.bits(rest_ns, self.quirks);
        let all_bits = table.bits(airtime_ns as f32, self.quirks);
        let counted = u64::from(frame.counted);
        let receivers = &self.receivers[..n];
        let (locks, books) = (&mut self.locks[..n], &mut self.books[..n]);
        let (totals, own) = (&self.totals_mw[..n], &self.powers_mw[..n]);
        let (ln_success, energies) = (&self.ln_success[..n], &self.energies[..n]);
        for j in 0..n {
            if locks[j] != frame.id {
                continue;
            }
            locks[j] = 0;
            let (power_mw, noise_mw) = (own[j], receivers[j].noise_mw);
            let (mut ln_success, mut energy) = (ln_success[j], energies[j]);
            if !closed {
                let others_mw = others_mw(totals[j], power_mw);
                ln_success += rest_bits * table.ln_bit(power_mw / (noise_mw + others_mw));
                energy += others_mw * rest_ns;
            }
            let luck = luck(frame.key, receivers[j].salt);
            books[j].rx_ns += airtime_ns;
            if survives(luck, ln_success.into()) {
                books[j].got += counted;
                receptions.push(Reception {
                    row: j as u32,
                    power_mw,
                    ln_success,
                    sinr: power_mw / (noise_mw + energy / length_ns),
                });
            } else {
                let alone = all_bits * table.ln_bit(power_mw / noise_mw);
                books[j].noise += counted & u64::from(!survives(luck, alone.into()));
            }
        }
    }

    /// Takes the power of a frame off the channel.
    fn leave(&mut self, frame: &OnAir) {
        for (total, &power_mw) in self.totals_mw.iter_mut().zip(&frame.powers_mw) {
            *total -= rounded(power_mw);
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
            self.heard.resize(n, 0);
            self.books.resize(n, Tally::default());
            self.totals_mw.resize(n, 0.0);
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
        self.locks[row] = 0;
        self.heard[row] = 0;
        self.books[row] = Tally::default();
        self.totals_mw[row] = 0.0;
        self.powers_mw[row] = 0.0;
    }

    fn reveal(&mut self, row: usize, frame: usize, power_mw: f32) {
        self.frames[frame].powers_mw[row] = power_mw;
        self.totals_mw[row] += rounded(power_mw);
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
        self.books[row].rx_ns += now_ns - taking.since_ns;
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
            self.start_among_others(&frame);
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
            ..book
        }
    }
}

/// The nearest multiple of 2^-50 mW, up to 2 mW; above, of what an f64 holds beside 6.
#[inline(always)]
fn rounded(power_mw: f32) -> f64 {
    const ANCHOR_MW: f64 = 6.0;
    (f64::from(power_mw) + ANCHOR_MW) - ANCHOR_MW
}

/// The logarithm of the chance of one bit, over the linear SINR.
///
/// Steps are told by the top bits of `SINR + offset`, with an offset a few times smaller than the
/// ratios where bits begin to survive: so steps are even below, and 256 an octave above. The table ends
/// where no bit is lost any more. All that is looked up lies in some 10 KiB.
#[derive(Debug)]
struct Table {
    ns_per_bit: f32,
    /// A power of two.
    offset: f32,
    /// The last ratio, offset included.
    most: f32,
    /// Value at the start of each step, and what it grows by over the step.
    steps: Vec<[f32; 2]>,
}

const STEP_BITS: u32 = 8;
const REST_BITS: u32 = f32::MANTISSA_DIGITS - 1 - STEP_BITS;

/// No table is longer than so many octaves.
const OCTAVES_MAX: usize = 24;

/// Fewer errors than this in a bit are none in any frame.
const NO_ERROR: f64 = 1e-19;

impl Table {
    fn new(modulation: &Modulation) -> Self {
        let errors = modulation.errors.as_ref();
        // The octave in which one bit of a thousand is lost.
        let octave = (-40..40).find(|&octave| errors.bit_error(two_to(octave)) < 1e-3);
        let offset = two_to(octave.unwrap_or(0) - 3);
        let first = (offset as f32).to_bits() >> REST_BITS;
        let at = |step: u32| f64::from(f32::from_bits((first + step) << REST_BITS)) - offset;
        let ln_bit = |sinr: f64| {
            let error = errors.bit_error(sinr).min(1.0 - 1e-9);
            if error < NO_ERROR {
                0.0
            } else {
                math::ln_1p(-error)
            }
        };
        let mut steps = Vec::new();
        for step in 0..(OCTAVES_MAX << STEP_BITS) as u32 {
            let (from, to) = (ln_bit(at(step)), ln_bit(at(step + 1)));
            steps.push([from as f32, (to - from) as f32]);
            if from == 0.0 {
                break;
            }
        }
        let last = (first + steps.len() as u32) << REST_BITS;
        Self {
            ns_per_bit: modulation.ns_per_bit as f32,
            offset: offset as f32,
            most: f32::from_bits(last - 1),
            steps,
        }
    }

    #[inline(always)]
    fn bits(&self, ns: f32, quirks: Quirks) -> f32 {
        let bits = ns / self.ns_per_bit;
        if quirks == Quirks::Ns3 {
            // `ceil` would be a call.
            let whole = bits as i32 as f32;
            whole + f32::from(u8::from(whole < bits))
        } else {
            bits
        }
    }

    /// The step of a ratio (0 or more), and how far into it, 0 to 1.
    #[inline(always)]
    fn place(&self, sinr: f32) -> (u32, f32) {
        let shifted = sinr + self.offset;
        let held = if shifted < self.most {
            shifted
        } else {
            self.most
        };
        let bits = held.to_bits().wrapping_sub(self.offset.to_bits());
        let rest = (bits & ((1 << REST_BITS) - 1)) as i32 as f32;
        (bits >> REST_BITS, rest * (1.0 / (1 << REST_BITS) as f32))
    }

    #[inline(always)]
    fn between(&self, step: u32, rest: f32) -> f32 {
        let [from, by] = self.steps[step as usize];
        from + rest * by
    }

    #[inline(always)]
    fn ln_bit(&self, sinr: f32) -> f32 {
        let (step, rest) = self.place(sinr);
        self.between(step, rest)
    }
}

/// `2^exponent`, exactly.
fn two_to(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phy::{BitErrors, OqpskDsss};
    use std::sync::Arc;

    #[test]
    fn the_table_keeps_to_the_formula() {
        let modulation = Modulation {
            errors: Arc::new(OqpskDsss),
            ns_per_bit: 4000.0,
        };
        let table = Table::new(&modulation);
        for i in 0..6000 {
            let sinr = math::pow(10.0, (f64::from(i) * 0.01 - 30.0) / 10.0);
            for bits in [1.0, 64.0, 1064.0] {
                let exact = OqpskDsss.success(sinr, bits);
                let ln_success = bits * f64::from(table.ln_bit(sinr as f32));
                let error = (math::exp(ln_success) - exact).abs();
                assert!(error < 6e-5, "{sinr} {bits}: off by {error}");
            }
        }
    }

    #[test]
    fn nothing_remains_of_a_strong_frame_that_is_gone() {
        let weak = 1.3e-11f32;
        let sum = rounded(weak) + rounded(0.7) + rounded(0.01) - rounded(0.7) - rounded(0.01);
        assert_eq!(sum, rounded(weak));
        assert!((sum - f64::from(weak)).abs() < 1e-15);
    }
}

//! The air in columns: one pass over the receivers when a frame begins, and one when it ends.
//!
//! While a single frame is on the air, the passes are plain loops, and all that is known of the
//! receivers follows from the frame. Only when frames overlap, each receiver gets books of its own:
//! power on the channel, logarithm of its frame's chance so far, and since when.
//!
//! The power on the channel is a sum that frames come to and leave again. It is kept in f64, of
//! powers rounded to multiples of 2^-50 mW (-150 dBm): such sums are exact up to 8 mW, so that nothing
//! remains of a frame that is gone, however strong, and the order of frames does not matter.
//!
//! The logarithm of a bit's chance comes from a table over the top bits of the ratio's f32, 256 steps
//! an octave with straight lines between.

use super::Quirks;
use super::air::{Air, Modulation, OnAir, Receiver, Reception, Taking, Tally, luck, survives};
use simbeeotic_units::math;

/// The air in columns.
#[derive(Debug)]
pub(super) struct FastAir {
    quirks: Quirks,
    tables: Vec<Table>,
    frames: Vec<OnAir>,
    /// Whether the only frame on the air began in silence: the columns of `overlap` are stale then.
    single: bool,

    receivers: Vec<Receiver>,
    /// The weakest frame that a row takes up in silence; infinite if it does not listen.
    thresholds_mw: Vec<f32>,
    silent_thresholds_mw: Vec<f32>,
    modulations: Vec<u32>,
    one_modulation: bool,
    /// The frame that a row is taking in; 0 is none.
    locks: Vec<u32>,
    heard: Vec<u64>,
    books: Vec<Books>,
    overlap: Vec<Overlap>,
    totals_mw: Vec<f64>,
}

/// What is booked when a frame ends.
#[derive(Clone, Copy, Debug, Default)]
struct Books {
    rx_ns: u64,
    got: u64,
    noise: u64,
    dropped: u64,
}

/// What a receiver must know of its frame when others interfere.
#[derive(Clone, Copy, Debug, Default)]
struct Overlap {
    power_mw: f32,
    /// Logarithm of the chance of what is over.
    ln_success: f32,
    /// Interference times time, mW ns.
    energy: f32,
    /// When the present interval, and the frame, began: the low bits of the time in ns.
    since_ns: u32,
    locked_ns: u32,
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
            receivers: Vec::new(),
            thresholds_mw: Vec::new(),
            silent_thresholds_mw: Vec::new(),
            modulations: Vec::new(),
            one_modulation: true,
            locks: Vec::new(),
            heard: Vec::new(),
            books: Vec::new(),
            overlap: Vec::new(),
            totals_mw: Vec::new(),
        }
    }

    /// Brings the columns up to date before a second frame begins.
    fn open_books(&mut self) {
        let Some(frame) = self.frames.first().filter(|_| self.single) else {
            return;
        };
        self.single = false;
        let n = self.receivers.len();
        let since_ns = frame.start_ns as u32;
        let powers = &frame.powers_mw[..n];
        for ((total, overlap), &power_mw) in
            self.totals_mw.iter_mut().zip(&mut self.overlap).zip(powers)
        {
            *total = rounded(power_mw);
            *overlap = Overlap {
                power_mw,
                since_ns,
                locked_ns: since_ns,
                ..Overlap::default()
            };
        }
    }

    fn start_in_silence(&mut self, frame: &OnAir) {
        self.single = true;
        let n = self.receivers.len();
        let (powers, thresholds) = (&frame.powers_mw[..n], &self.thresholds_mw[..n]);
        let (locks, heard) = (&mut self.locks[..n], &mut self.heard[..n]);
        let counted = u64::from(frame.counted);
        for j in 0..n {
            let takes = powers[j] >= thresholds[j];
            locks[j] = if takes { frame.id } else { 0 };
            heard[j] += u64::from(takes) & counted;
        }
        if !self.one_modulation {
            for j in 0..n {
                if self.modulations[j] != frame.modulation && locks[j] != 0 {
                    locks[j] = 0;
                    heard[j] -= counted;
                }
            }
        }
    }

    fn start_among_others(&mut self, frame: &OnAir) {
        let n = self.receivers.len();
        let now_ns = frame.start_ns as u32;
        let counted = u64::from(frame.counted);
        let powers = &frame.powers_mw[..n];
        let receivers = &self.receivers[..n];
        let thresholds = &self.thresholds_mw[..n];
        let totals = &mut self.totals_mw[..n];
        let (locks, heard) = (&mut self.locks[..n], &mut self.heard[..n]);
        let overlap = &mut self.overlap[..n];
        let modulations = &self.modulations[..n];
        for j in 0..n {
            let (power_mw, before_mw) = (powers[j], totals[j]);
            totals[j] = before_mw + rounded(power_mw);
            let strong = power_mw >= thresholds[j] && modulations[j] == frame.modulation;
            heard[j] += u64::from(strong) & counted;
            let (o, r) = (&mut overlap[j], &receivers[j]);
            let takes = if locks[j] != 0 {
                // Of signals that begin together, the strongest is taken up.
                strong && o.locked_ns == now_ns && power_mw > o.power_mw
            } else {
                strong && power_mw > r.lock * (r.noise_mw + before_mw as f32)
            };
            if takes {
                locks[j] = frame.id;
                *o = Overlap {
                    power_mw,
                    since_ns: now_ns,
                    locked_ns: now_ns,
                    ..Overlap::default()
                };
            } else if locks[j] != 0 {
                o.close(now_ns, before_mw, r, &self.tables, self.quirks);
            }
        }
    }

    fn end_single(&mut self, frame: &OnAir, now_ns: u64, receptions: &mut Vec<Reception>) {
        let n = self.receivers.len();
        let airtime_ns = (now_ns - frame.start_ns) as f32;
        let table = &self.tables[frame.modulation as usize];
        let bits = table.bits(airtime_ns, self.quirks);
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
            books[j].rx_ns += now_ns - frame.start_ns;
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
        let n = self.receivers.len();
        let now = now_ns as u32;
        let airtime_ns = (now_ns - frame.start_ns) as f32;
        let counted = u64::from(frame.counted);
        let powers = &frame.powers_mw[..n];
        let receivers = &self.receivers[..n];
        let totals = &mut self.totals_mw[..n];
        let (locks, overlap) = (&mut self.locks[..n], &mut self.overlap[..n]);
        let (books, tables) = (&mut self.books[..n], &self.tables);
        for j in 0..n {
            let total_mw = totals[j];
            totals[j] = total_mw - rounded(powers[j]);
            let (o, r) = (&mut overlap[j], &receivers[j]);
            if locks[j] == frame.id {
                locks[j] = 0;
                o.close(now, total_mw, r, tables, self.quirks);
                let luck = luck(frame.key, r.salt);
                books[j].rx_ns += now_ns - frame.start_ns;
                if survives(luck, o.ln_success.into()) {
                    books[j].got += counted;
                    receptions.push(Reception {
                        row: j as u32,
                        power_mw: o.power_mw,
                        ln_success: o.ln_success,
                        sinr: o.power_mw / (r.noise_mw + o.energy / airtime_ns.max(1.0)),
                    });
                } else {
                    let table = &tables[r.modulation as usize];
                    let bits = table.bits(airtime_ns, self.quirks);
                    let alone = bits * table.ln_bit(o.power_mw / r.noise_mw);
                    books[j].noise += counted & u64::from(!survives(luck, alone.into()));
                }
            } else if locks[j] != 0 && self.quirks == Quirks::None {
                // ns-3 does not look at interference that ends: it counts as if it had not been.
                o.close(now, total_mw, r, tables, self.quirks);
            }
        }
    }
}

impl Overlap {
    /// Ends the present interval, with `total_mw` on the channel in it.
    #[inline(always)]
    fn close(
        &mut self,
        now_ns: u32,
        total_mw: f64,
        receiver: &Receiver,
        tables: &[Table],
        quirks: Quirks,
    ) {
        let table = &tables[receiver.modulation as usize];
        let ns = now_ns.wrapping_sub(self.since_ns) as f32;
        let interference_mw = (total_mw - rounded(self.power_mw)).max(0.0) as f32;
        let sinr = self.power_mw / (receiver.noise_mw + interference_mw);
        self.ln_success += table.bits(ns, quirks) * table.ln_bit(sinr);
        self.energy += interference_mw * ns;
        self.since_ns = now_ns;
    }
}

impl Air for FastAir {
    fn learn(&mut self, modulation: &Modulation) {
        self.tables.push(Table::new(modulation));
    }

    fn join(&mut self, row: usize, receiver: Receiver) {
        self.open_books();
        if row >= self.receivers.len() {
            let n = row + 1;
            self.receivers.resize(n, Receiver::default());
            self.thresholds_mw.resize(n, f32::INFINITY);
            self.silent_thresholds_mw.resize(n, f32::INFINITY);
            self.modulations.resize(n, 0);
            self.locks.resize(n, 0);
            self.heard.resize(n, 0);
            self.books.resize(n, Books::default());
            self.overlap.resize(n, Overlap::default());
            self.totals_mw.resize(n, 0.0);
        }
        for frame in &mut self.frames {
            frame.powers_mw.resize(self.receivers.len(), 0.0);
            frame.powers_mw[row] = 0.0;
        }
        self.receivers[row] = receiver;
        self.thresholds_mw[row] = f32::INFINITY;
        self.silent_thresholds_mw[row] = receiver
            .sensitivity_mw
            .max(receiver.lock * receiver.noise_mw);
        self.modulations[row] = receiver.modulation;
        self.one_modulation &= receiver.modulation == self.modulations[0];
        self.locks[row] = 0;
        self.heard[row] = 0;
        self.books[row] = Books::default();
        self.totals_mw[row] = 0.0;
    }

    fn reveal(&mut self, row: usize, frame: usize, power_mw: f32) {
        self.frames[frame].powers_mw[row] = power_mw;
        self.totals_mw[row] += rounded(power_mw);
    }

    fn listen(&mut self, row: usize, now_ns: u64, listening: bool) -> Option<Taking> {
        self.thresholds_mw[row] = if listening {
            self.silent_thresholds_mw[row]
        } else {
            f32::INFINITY
        };
        let taking = self.taking(row)?;
        self.locks[row] = 0;
        self.books[row].rx_ns += now_ns - taking.since_ns;
        self.books[row].dropped += u64::from(taking.counted);
        Some(taking)
    }

    fn start(&mut self, frame: OnAir) {
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
        let frame = self.frames.swap_remove(at);
        if self.single {
            self.end_single(&frame, now_ns, receptions);
        } else {
            self.end_among_others(&frame, now_ns, receptions);
        }
        if self.frames.is_empty() {
            // Exactly so already, unless there were more than 8 mW.
            self.totals_mw.fill(0.0);
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
            Some(_) => self.totals_mw[row],
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
        let Books {
            rx_ns,
            got,
            noise,
            dropped,
        } = self.books[row];
        Tally {
            heard: self.heard[row],
            got,
            noise,
            dropped,
            rx_ns,
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
#[derive(Debug)]
struct Table {
    ns_per_bit: f32,
    /// Value at the start of each step, and what it grows by over the step.
    steps: Box<[[f32; 2]; STEPS]>,
}

const STEP_BITS: u32 = 8;
const REST_BITS: u32 = f32::MANTISSA_DIGITS - 1 - STEP_BITS;

/// From 2^-18 (-54 dB) to 2^10 (30 dB). Only the few steps around the threshold are ever warm.
const FIRST: u32 = (127 - 18) << STEP_BITS;
const STEPS: usize = 28 << STEP_BITS;

impl Table {
    fn new(modulation: &Modulation) -> Self {
        let at = |step: u32| f64::from(f32::from_bits((FIRST + step) << REST_BITS));
        let ln_bit = |sinr: f64| math::ln_1p(-modulation.errors.bit_error(sinr).min(1.0 - 1e-9));
        let steps: Vec<[f32; 2]> = (0..STEPS as u32)
            .map(|step| {
                let (from, to) = (ln_bit(at(step)), ln_bit(at(step + 1)));
                [from as f32, (to - from) as f32]
            })
            .collect();
        Self {
            ns_per_bit: modulation.ns_per_bit as f32,
            steps: steps
                .into_boxed_slice()
                .try_into()
                .expect("a table has STEPS steps"),
        }
    }

    #[inline(always)]
    fn bits(&self, ns: f32, quirks: Quirks) -> f32 {
        let bits = ns / self.ns_per_bit;
        if quirks == Quirks::Ns3 {
            bits.ceil()
        } else {
            bits
        }
    }

    /// Below -54 dB as there; above 30 dB as there.
    #[inline(always)]
    fn ln_bit(&self, sinr: f32) -> f32 {
        const LEAST: u32 = FIRST << REST_BITS;
        const MOST: u32 = ((FIRST + STEPS as u32) << REST_BITS) - 1;
        let bits = sinr.to_bits().clamp(LEAST, MOST) - LEAST;
        let rest = (bits & ((1 << REST_BITS) - 1)) as f32 * (1.0 / (1 << REST_BITS) as f32);
        let [from, by] = self.steps[(bits >> REST_BITS) as usize % STEPS];
        from + rest * by
    }
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
                assert!(error < 3e-5, "{sinr} {bits}: off by {error}");
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

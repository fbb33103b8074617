//! The air by definition: slow, and the measure of the fast one.
//!
//! Each receiver keeps a list of the intervals in which the interference to its frame stayed the same.
//! The chance of the frame is the product over them, in f64, from the bit errors themselves.

use super::Quirks;
use super::air::{Air, Modulation, OnAir, Receiver, Reception, Taking, Tally, bits, luck};
use simbeeotic_units::math;

/// The air, interval by interval.
#[derive(Debug)]
pub(super) struct ExactAir {
    quirks: Quirks,
    modulations: Vec<Modulation>,
    frames: Vec<OnAir>,
    /// As ns-3 has it: frames that ended at `ended_ns`, and still interfere with others that end then.
    ended: Vec<OnAir>,
    ended_ns: u64,
    rows: Vec<Row>,
}

#[derive(Debug, Default)]
struct Row {
    receiver: Receiver,
    listening: bool,
    lock: Option<Lock>,
    tally: Tally,
}

/// A frame that is being taken in.
#[derive(Debug)]
struct Lock {
    id: u32,
    taking: Taking,
    power_mw: f64,
    /// End of the last interval.
    closed_ns: u64,
    /// Length, ns, and interference, milliwatts: as it is, and as much noise as does its harm.
    intervals: Vec<(u64, f64, f64)>,
}

impl ExactAir {
    pub(super) fn new(quirks: Quirks) -> Self {
        Self {
            quirks,
            modulations: Vec::new(),
            frames: Vec::new(),
            ended: Vec::new(),
            ended_ns: 0,
            rows: Vec::new(),
        }
    }

    /// The power of all frames but one at a row, and the power of noise that would do as much harm.
    fn others_mw(&self, row: usize, but: u32) -> (f64, f64) {
        let receiver = &self.rows[row].receiver;
        let all = self.frames.iter().chain(&self.ended);
        let (mut power_mw, mut harm_mw) = (0.0, 0.0);
        for frame in all.filter(|frame| frame.id != but) {
            let one_mw = f64::from(frame.powers_mw[row]);
            power_mw += one_mw;
            harm_mw += one_mw * f64::from(receiver.weight(frame.modulation));
        }
        (power_mw, harm_mw)
    }

    /// Ends the present interval of a row's frame.
    fn close(&mut self, row: usize, now_ns: u64) {
        let Some(id) = self.rows[row].lock.as_ref().map(|lock| lock.id) else {
            return;
        };
        let (power_mw, harm_mw) = self.others_mw(row, id);
        if let Some(lock) = &mut self.rows[row].lock {
            let ns = now_ns - lock.closed_ns;
            lock.intervals.push((ns, power_mw, harm_mw));
            lock.closed_ns = now_ns;
        }
    }

    /// A frame begins: whether a row takes it up.
    fn meet(&mut self, row: usize, frame: &OnAir) {
        let power_mw = f64::from(frame.powers_mw[row]);
        let (_, others_mw) = self.others_mw(row, 0);
        let Row {
            receiver,
            listening,
            lock,
            tally,
        } = &mut self.rows[row];
        let (noise_mw, least) = (f64::from(receiver.noise_mw), f64::from(receiver.lock));
        let strong = *listening
            && receiver.modulation == frame.modulation
            && frame.powers_mw[row] >= receiver.sensitivity_mw
            && power_mw >= least * noise_mw;
        tally.heard += u64::from(strong && frame.counted);
        let takes = match lock {
            // Of signals that begin together, the strongest is taken up.
            Some(lock) => lock.taking.since_ns == frame.start_ns && power_mw > lock.power_mw,
            None => power_mw >= least * (noise_mw + others_mw),
        };
        if strong && takes {
            *lock = Some(Lock {
                id: frame.id,
                taking: Taking {
                    since_ns: frame.start_ns,
                    counted: frame.counted,
                },
                power_mw,
                closed_ns: frame.start_ns,
                intervals: Vec::new(),
            });
        }
    }

    /// What becomes of a frame that has been taken in to its end.
    fn judge(&mut self, row: usize, lock: &Lock, key: u64) -> Option<Reception> {
        let Row {
            receiver, tally, ..
        } = &mut self.rows[row];
        let modulation = &self.modulations[receiver.modulation as usize];
        let noise_mw = f64::from(receiver.noise_mw);
        let chance = |interfered: bool| -> f64 {
            let parts = lock.intervals.iter().map(|&(ns, _, harm_mw)| {
                let others_mw = if interfered { harm_mw } else { 0.0 };
                let bits = bits(ns as f64, modulation.ns_per_bit, self.quirks);
                let sinr = lock.power_mw / (noise_mw + others_mw);
                modulation.errors.success(sinr, bits)
            });
            parts.product()
        };
        let (success, luck) = (chance(true), luck(key, receiver.salt));
        if lock.taking.counted {
            tally.got += u64::from(luck < success);
            tally.noise += u64::from(luck >= success && luck >= chance(false));
        }
        let length_ns: u64 = lock.intervals.iter().map(|i| i.0).sum();
        let energy = lock.intervals.iter().map(|&(ns, mw, _)| ns as f64 * mw);
        let mean_mw = energy.sum::<f64>() / (length_ns.max(1) as f64);
        (luck < success).then(|| Reception {
            row: row as u32,
            power_mw: lock.power_mw as f32,
            ln_success: math::ln(success) as f32,
            sinr: (lock.power_mw / (noise_mw + mean_mw)) as f32,
        })
    }
}

impl Air for ExactAir {
    fn learn(&mut self, modulation: &Modulation) {
        self.modulations.push(modulation.clone());
    }

    fn join(&mut self, row: usize, receiver: Receiver) {
        if row >= self.rows.len() {
            self.rows.resize_with(row + 1, Row::default);
        }
        self.ended.clear();
        for frame in &mut self.frames {
            frame.powers_mw.resize(self.rows.len(), 0.0);
            frame.powers_mw[row] = 0.0;
        }
        self.rows[row] = Row {
            receiver,
            ..Row::default()
        };
    }

    fn reveal(&mut self, row: usize, frame: usize, power_mw: f32) {
        self.frames[frame].powers_mw[row] = power_mw;
    }

    fn listen(&mut self, row: usize, now_ns: u64, listening: bool) -> Option<Taking> {
        let row = &mut self.rows[row];
        row.listening = listening;
        let taking = row.lock.take()?.taking;
        row.tally.rx_ns += now_ns - taking.since_ns;
        row.tally.dropped += u64::from(taking.counted);
        Some(taking)
    }

    fn start(&mut self, frame: OnAir) {
        self.ended.clear();
        for row in 0..self.rows.len() {
            // As ns-3 has it, frames that do not reach a row split its intervals too.
            if self.quirks == Quirks::Ns3 || frame.powers_mw[row] > 0.0 {
                self.close(row, frame.start_ns);
            }
            self.meet(row, &frame);
        }
        self.frames.push(frame);
    }

    fn end(&mut self, id: u32, now_ns: u64, receptions: &mut Vec<Reception>) -> Vec<f32> {
        let Some(at) = self.frames.iter().position(|frame| frame.id == id) else {
            return Vec::new();
        };
        if self.ended_ns != now_ns {
            self.ended.clear();
        }
        for row in 0..self.rows.len() {
            let mine = self.rows[row].lock.as_ref().is_some_and(|l| l.id == id);
            let felt = self.frames[at].powers_mw[row] > 0.0;
            // ns-3 does not look at interference that ends: it counts as if it had not been.
            if mine || (felt && self.quirks == Quirks::None) {
                self.close(row, now_ns);
            }
            if let Some(lock) = self.rows[row].lock.take_if(|_| mine) {
                self.rows[row].tally.rx_ns += now_ns - lock.taking.since_ns;
                let key = self.frames[at].key;
                receptions.extend(self.judge(row, &lock, key));
            }
        }
        // In the order of their beginnings, in which powers are added up.
        let frame = self.frames.remove(at);
        if self.quirks == Quirks::Ns3 {
            self.ended_ns = now_ns;
            self.ended.push(frame.clone());
        }
        frame.powers_mw
    }

    fn frames(&self) -> &[OnAir] {
        &self.frames
    }

    fn total_mw(&self, row: usize) -> f64 {
        let powers = self.frames.iter().map(|frame| frame.powers_mw[row]);
        powers.map(f64::from).sum()
    }

    fn taking(&self, row: usize) -> Option<Taking> {
        self.rows[row].lock.as_ref().map(|lock| lock.taking)
    }

    fn tally(&self, row: usize) -> Tally {
        self.rows[row].tally
    }
}

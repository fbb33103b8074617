//! What is on a channel, and what becomes of it at each receiver: the face of two implementations.

use super::Quirks;
use super::members::Source;
use crate::phy::BitErrors;
use simbeeotic_kernel::rng::draw_u32;
use std::fmt;
use std::sync::Arc;

/// The receiver in one row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Receiver {
    pub(super) noise_mw: f32,
    /// The weakest frame that is taken up.
    pub(super) sensitivity_mw: f32,
    /// The least linear SINR at which a frame is taken up.
    pub(super) lock: f32,
    /// The modulation it understands: an index.
    pub(super) modulation: u32,
    /// How much more than noise frames of its own modulation disturb, linear.
    pub(super) co_channel: f32,
    /// What the receiver's luck hangs on.
    pub(super) salt: u32,
}

/// A way to send bits: two radios understand each other if theirs are equal.
#[derive(Clone, Debug)]
pub(super) struct Modulation {
    pub(super) errors: Arc<dyn BitErrors>,
    pub(super) ns_per_bit: f64,
}

impl Modulation {
    pub(super) fn is(&self, other: &Self) -> bool {
        let same = || self.errors.key() == other.errors.key();
        self.ns_per_bit == other.ns_per_bit && (Arc::ptr_eq(&self.errors, &other.errors) || same())
    }
}

impl Receiver {
    /// By how much the power of a frame counts as interference.
    #[inline(always)]
    pub(super) fn weight(&self, modulation: u32) -> f32 {
        match self.modulation == modulation {
            true => self.co_channel,
            false => 1.0,
        }
    }
}

/// One frame on the air.
#[derive(Clone, Debug)]
pub(super) struct OnAir {
    /// Not 0, and no other frame on the air has it.
    pub(super) id: u32,
    pub(super) key: u64,
    pub(super) modulation: u32,
    pub(super) start_ns: u64,
    /// Whether receivers count it; acknowledgements are not counted.
    pub(super) counted: bool,
    pub(super) source: Source,
    /// Received power by row, milliwatts.
    pub(super) powers_mw: Vec<f32>,
}

/// A frame that came through at one receiver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reception {
    pub(super) row: u32,
    pub(super) power_mw: f32,
    /// Logarithm of the chance that it came through.
    pub(super) ln_success: f32,
    /// Mean linear ratio of signal to noise plus interference.
    pub(super) sinr: f32,
}

/// The books of one row.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Tally {
    /// Frames that began while it listened and were strong enough, but for interference.
    pub(super) heard: u64,
    /// Of these, frames that came through.
    pub(super) got: u64,
    /// Of these, frames spoilt by noise.
    pub(super) noise: u64,
    /// Of these, frames given up when it stopped listening.
    pub(super) dropped: u64,
    /// Time spent in frames, ns.
    pub(super) rx_ns: u64,
}

/// The frame that a receiver is taking in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Taking {
    pub(super) since_ns: u64,
    pub(super) counted: bool,
}

/// The power on a channel and the receivers in it.
///
/// Calls come in the order of time. Rows that never joined are not asked about.
pub(super) trait Air: Send + Sync + fmt::Debug {
    /// Gives the next modulation its index.
    fn learn(&mut self, modulation: &Modulation);

    /// Puts a receiver into a row, with empty books, not listening.
    fn join(&mut self, row: usize, receiver: Receiver);

    /// A frame that was on the air when `row` joined reaches it with this power.
    fn reveal(&mut self, row: usize, frame: usize, power_mw: f32);

    /// Starts or stops listening. What it was taking in is given up, and returned.
    fn listen(&mut self, row: usize, now_ns: u64, listening: bool) -> Option<Taking>;

    /// A frame begins.
    fn start(&mut self, frame: OnAir);

    /// A frame ends: appends who received it, by row. Returns the room of its powers.
    fn end(&mut self, id: u32, now_ns: u64, receptions: &mut Vec<Reception>) -> Vec<f32>;

    /// The frames on the air.
    fn frames(&self) -> &[OnAir];

    /// The power on the channel, noise not included, milliwatts.
    fn total_mw(&self, row: usize) -> f64;

    /// What a receiver is taking in.
    fn taking(&self, row: usize) -> Option<Taking>;

    fn tally(&self, row: usize) -> Tally;
}

/// How both count bits: ns-3 rounds up in each part of a frame.
pub(super) fn bits(ns: f64, ns_per_bit: f64, quirks: Quirks) -> f64 {
    match quirks {
        Quirks::None => ns / ns_per_bit,
        Quirks::Ns3 => (ns / ns_per_bit).ceil(),
    }
}

/// The luck of a frame at a receiver, 0 to 1: it comes through if this is below its chance.
#[inline]
pub(super) fn luck(key: u64, salt: u32) -> f64 {
    (f64::from(draw_u32(key, salt)) + 0.5) * (1.0 / 4_294_967_296.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ns3_rounds_bits_up() {
        assert_eq!(bits(1_184_000.0, 4000.0, Quirks::Ns3), 296.0);
        assert_eq!(bits(1001.0, 4000.0, Quirks::Ns3), 1.0);
        assert_eq!(bits(1000.0, 4000.0, Quirks::None), 0.25);
    }
}

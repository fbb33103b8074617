//! What a radio hands to its owner: packets, and what became of requests.

use crate::error_model::ErrorModel;
use crate::frame::{Frame, Outcome};
use crate::phy::LinkQuality;
use crate::radio::RadioId;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::{Decibels, PowerLevel, math};
use std::fmt;
use std::sync::Arc;

/// One reception, 8 bytes: which frame of the round, and how strong.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Hit {
    /// Index into the frames of the inbox.
    pub(crate) frame: u32,
    /// Received power, milliwatts.
    pub(crate) power_mw: f32,
}

/// Everything one radio received at one instant, and what became of its owner's requests.
///
/// Packets come in the order in which their frames were submitted. Cheap to copy: it only borrows.
#[derive(Clone, Copy)]
pub struct Inbox<'a> {
    pub(crate) radio: RadioId,
    pub(crate) time: SimTime,
    pub(crate) hits: &'a [Hit],
    pub(crate) frames: &'a [Frame],
    pub(crate) outcomes: &'a [Outcome],
    pub(crate) receiver: Receiver<'a>,
    pub(crate) qualities: Qualities<'a>,
}

/// What a medium with interference knows of a reception besides.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Quality {
    /// Logarithm of the chance that the frame came through.
    pub(crate) ln_success: f32,
    /// Mean linear ratio of signal to noise plus interference.
    pub(crate) sinr: f32,
}

/// The qualities of all packets of an inbox, in their order; none where the medium has none.
#[derive(Clone, Copy, Default)]
pub(crate) struct Qualities<'a> {
    pub(crate) list: &'a [Quality],
    pub(crate) meaning: LinkQuality,
}

/// What the numbers of a packet are measured against.
#[derive(Clone, Copy)]
pub(crate) struct Receiver<'a> {
    pub(crate) noise: PowerLevel,
    pub(crate) error: &'a dyn ErrorModel,
}

impl<'a> Inbox<'a> {
    /// How many packets it holds.
    #[must_use]
    pub fn len(&self) -> usize {
        self.hits.len()
    }

    /// Whether it holds no packets (there may be outcomes).
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.hits.is_empty()
    }

    /// The packets.
    #[must_use]
    pub fn iter(&self) -> Packets<'a> {
        Packets {
            hits: self.hits.iter(),
            frames: self.frames,
            radio: self.radio,
            time: self.time,
            receiver: self.receiver,
            qualities: self.qualities.list.iter(),
            meaning: self.qualities.meaning,
        }
    }

    /// What became of requests with a ticket, in the order of the requests.
    #[must_use]
    pub fn outcomes(&self) -> &'a [Outcome] {
        self.outcomes
    }

    /// Which of the platform's radios this is about.
    #[must_use]
    pub fn radio(&self) -> RadioId {
        self.radio
    }

    /// When the packets came in.
    #[must_use]
    pub fn time(&self) -> SimTime {
        self.time
    }

    /// A hash of who was received and how strongly, to the last bit, in order; and of the outcomes.
    ///
    /// Independent of numbering and of frames that were not received: a word for a run's trace.
    #[must_use]
    pub fn digest(&self) -> u64 {
        const K: u64 = 0x9fb2_1c65_1e98_df25;
        // Four chains side by side, since one multiply waits for the one before.
        let mut lanes = [K, K << 1, K << 2, K << 3];
        let mut fold = |index: usize, word: u64| {
            let lane = &mut lanes[index & 3];
            *lane = (*lane ^ word).wrapping_mul(K);
            *lane ^= *lane >> 32;
        };
        for (index, hit) in self.hits.iter().enumerate() {
            let power = u64::from(hit.power_mw.to_bits());
            fold(
                index,
                self.frames[hit.frame as usize].key ^ power.rotate_left(32) ^ power,
            );
        }
        for (index, outcome) in self.outcomes.iter().enumerate() {
            let result = outcome.result.map_or_else(|loss| 1 + loss as u64, |()| 0);
            fold(index, result << 32 | u64::from(outcome.ticket.0));
        }
        let counts = (self.hits.len() as u64) << 32 | self.outcomes.len() as u64;
        lanes.into_iter().fold(counts, |hash, lane| {
            let hash = (hash ^ lane).wrapping_mul(K);
            hash ^ (hash >> 29)
        })
    }
}

impl<'a> IntoIterator for Inbox<'a> {
    type Item = Packet<'a>;
    type IntoIter = Packets<'a>;

    fn into_iter(self) -> Packets<'a> {
        self.iter()
    }
}

impl<'a> IntoIterator for &Inbox<'a> {
    type Item = Packet<'a>;
    type IntoIter = Packets<'a>;

    fn into_iter(self) -> Packets<'a> {
        self.iter()
    }
}

impl fmt::Debug for Inbox<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Inbox")
            .field("radio", &self.radio)
            .field("time", &self.time)
            .field("packets", &self.iter().collect::<Vec<_>>())
            .field("outcomes", &self.outcomes)
            .finish()
    }
}

/// The packets of an [`Inbox`], one after the other.
#[derive(Clone)]
pub struct Packets<'a> {
    hits: std::slice::Iter<'a, Hit>,
    frames: &'a [Frame],
    radio: RadioId,
    time: SimTime,
    receiver: Receiver<'a>,
    qualities: std::slice::Iter<'a, Quality>,
    meaning: LinkQuality,
}

impl<'a> Iterator for Packets<'a> {
    type Item = Packet<'a>;

    #[inline]
    fn next(&mut self) -> Option<Packet<'a>> {
        let hit = self.hits.next()?;
        Some(Packet {
            frame: &self.frames[hit.frame as usize],
            power_mw: hit.power_mw,
            radio: self.radio,
            time: self.time,
            receiver: self.receiver,
            quality: self.qualities.next().map(|q| (*q, self.meaning)),
        })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.hits.size_hint()
    }
}

impl ExactSizeIterator for Packets<'_> {}

/// One packet as one radio received it.
#[derive(Clone, Copy)]
pub struct Packet<'a> {
    frame: &'a Frame,
    power_mw: f32,
    radio: RadioId,
    time: SimTime,
    receiver: Receiver<'a>,
    quality: Option<(Quality, LinkQuality)>,
}

impl<'a> Packet<'a> {
    /// The bytes.
    #[must_use]
    pub fn payload(&self) -> &'a [u8] {
        self.frame.payload()
    }

    /// The bytes, to be kept without copying.
    #[must_use]
    pub fn shared_payload(&self) -> Arc<[u8]> {
        self.frame.shared_payload()
    }

    /// The platform that sent it: its address.
    #[must_use]
    pub fn sender(&self) -> ModelId {
        self.frame.sender
    }

    /// The platform it is for; `None` is everybody.
    #[must_use]
    pub fn destination(&self) -> Option<ModelId> {
        self.frame.destination
    }

    /// Which of the receiver's radios heard it.
    #[must_use]
    pub fn radio(&self) -> RadioId {
        self.radio
    }

    /// When it was received: the end of its reception.
    #[must_use]
    pub fn time(&self) -> SimTime {
        self.time
    }

    /// Received signal strength: the power of this frame at the radio's input, antenna gain included.
    #[must_use]
    pub fn rssi(&self) -> PowerLevel {
        PowerLevel::from_milliwatts(f64::from(self.power_mw))
    }

    /// Signal over noise: [`rssi`](Self::rssi) above the mean noise level of the radio; in a medium with
    /// interference, above noise and the mean interference during the frame.
    ///
    /// Where noise is drawn for each packet (the simple medium with a noise sigma), this is still
    /// the ratio to its mean: the draw is folded into the chance of reception.
    #[must_use]
    pub fn snr(&self) -> Decibels {
        match self.quality {
            Some((quality, _)) => Decibels::from_ratio(f64::from(quality.sinr)),
            None => self.rssi() - self.receiver.noise,
        }
    }

    /// Link quality, 0 to 255: the chance that a frame of this length survives at [`snr`](Self::snr),
    /// by the radio's own error model, times 255. ns-3 defines it so. In a medium with interference,
    /// what the radio says ([`LinkQuality`]).
    #[must_use]
    pub fn lqi(&self) -> u8 {
        if let Some((quality, meaning)) = self.quality {
            let success = math::exp(f64::from(quality.ln_success));
            return meaning.of(success, quality.sinr.into());
        }
        let success = self
            .receiver
            .error
            .packet_success(self.snr(), self.frame.bytes);
        (success * 255.0).round() as u8
    }

    /// The transmission it comes from.
    #[must_use]
    pub fn frame(&self) -> &'a Frame {
        self.frame
    }
}

impl fmt::Debug for Packet<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:?}, received with {:.2} dBm",
            self.frame,
            self.rssi().dbm()
        )
    }
}

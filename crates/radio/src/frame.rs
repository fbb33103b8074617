//! What goes over the air.

use crate::counters::Loss;
use crate::radio::RadioId;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::PowerLevel;
use std::fmt;
use std::sync::Arc;

/// What a platform asks of its radio: send this.
#[derive(Clone, Debug)]
pub struct Request {
    /// The radio that shall send.
    pub radio: RadioId,
    /// The bytes. Shared by all who receive them, never copied.
    pub payload: Arc<[u8]>,
    /// The platform that the packet is for; `None` is everybody. Others hear it too: it takes their
    /// time and power, but is not handed to them.
    pub destination: Option<ModelId>,
    /// If given, an [`Outcome`] with this ticket comes back to the sender.
    pub ticket: Option<Ticket>,
}

impl Request {
    /// A broadcast without a receipt.
    #[must_use]
    pub fn broadcast(radio: RadioId, payload: Arc<[u8]>) -> Self {
        Self {
            radio,
            payload,
            destination: None,
            ticket: None,
        }
    }
}

/// The sender's own number for a request it wants to hear about again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Ticket(pub u32);

/// What became of a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Which request.
    pub ticket: Ticket,
    /// `Ok` if the frame was sent (and acknowledged, where the medium knows acknowledgements).
    pub result: Result<(), Loss>,
}

/// One transmission.
#[derive(Clone)]
pub struct Frame {
    pub(crate) payload: Arc<[u8]>,
    pub(crate) sender: ModelId,
    pub(crate) radio: RadioId,
    pub(crate) destination: Option<ModelId>,
    pub(crate) key: u64,
    pub(crate) sent: SimTime,
    pub(crate) bytes: usize,
    pub(crate) airtime_ns: u64,
    /// Power at the antenna's input, milliwatts.
    pub(crate) power_mw: f32,
}

impl Frame {
    /// The bytes.
    #[must_use]
    pub fn payload(&self) -> &[u8] {
        &self.payload
    }

    /// The bytes, to be kept without copying.
    #[must_use]
    pub fn shared_payload(&self) -> Arc<[u8]> {
        Arc::clone(&self.payload)
    }

    /// The platform that sent it.
    #[must_use]
    pub fn sender(&self) -> ModelId {
        self.sender
    }

    /// The radio that sent it.
    #[must_use]
    pub fn radio(&self) -> RadioId {
        self.radio
    }

    /// The platform it is for; `None` is everybody.
    #[must_use]
    pub fn destination(&self) -> Option<ModelId> {
        self.destination
    }

    /// Its identity, independent of numbering: a hash of the seed, the sending radio's key and how
    /// many frames that radio had sent before.
    #[must_use]
    pub fn key(&self) -> u64 {
        self.key
    }

    /// When its transmission began.
    #[must_use]
    pub fn sent(&self) -> SimTime {
        self.sent
    }

    /// Its length on the air, bytes: payload, headers, preamble and all.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// How long it is on the air, ns.
    #[must_use]
    pub fn airtime_nanos(&self) -> u64 {
        self.airtime_ns
    }

    /// The power that its sender feeds into the antenna.
    #[must_use]
    pub fn power(&self) -> PowerLevel {
        PowerLevel::from_milliwatts(f64::from(self.power_mw))
    }
}

impl fmt::Debug for Frame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "frame of {} bytes from {} at {}",
            self.bytes, self.sender, self.sent
        )
    }
}

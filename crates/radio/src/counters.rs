//! What became of the frames.

use std::ops::AddAssign;

/// Why a frame was not sent, or not received by one radio.
///
/// Which of these can happen depends on the medium: the simple one knows no collisions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Loss {
    /// Not received: beyond the medium's range limit.
    OutOfRange,
    /// Not received: weaker than the radio's sensitivity.
    BelowSensitivity,
    /// Not received: spoilt by noise; or by mere chance, where the medium knows no noise.
    Noise,
    /// Not received: spoilt by another frame.
    Collision,
    /// Not received: the radio was sending.
    HalfDuplex,
    /// Not received: the radio was asleep.
    Asleep,
    /// Not sent: the radio was asleep.
    SenderAsleep,
    /// Not sent: the channel stayed busy.
    ChannelBusy,
    /// Not sent: too many frames were waiting.
    QueueFull,
    /// Not sent: the payload does not fit into a frame, or its frame would last more than 73 minutes.
    TooLong,
    /// Sent, and not acknowledged: as often as the radio repeats frames, or until it went to sleep.
    NoAcknowledgement,
    /// Not sent: the scenario has no channel, or it is off.
    NoChannel,
}

impl Loss {
    /// All reasons, in the order of summaries.
    pub const ALL: [Self; 12] = [
        Self::OutOfRange,
        Self::BelowSensitivity,
        Self::Noise,
        Self::Collision,
        Self::HalfDuplex,
        Self::Asleep,
        Self::SenderAsleep,
        Self::ChannelBusy,
        Self::QueueFull,
        Self::TooLong,
        Self::NoAcknowledgement,
        Self::NoChannel,
    ];

    /// Whether the frame was sent, and passed a radio by on its channel.
    #[must_use]
    pub const fn is_at_receiver(self) -> bool {
        use Loss::{Asleep, BelowSensitivity, Collision, HalfDuplex, Noise, OutOfRange};
        matches!(
            self,
            OutOfRange | BelowSensitivity | Noise | Collision | HalfDuplex | Asleep
        )
    }

    /// Its name in summaries and recordings.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::OutOfRange => "out-of-range",
            Self::BelowSensitivity => "below-sensitivity",
            Self::Noise => "noise",
            Self::Collision => "collision",
            Self::HalfDuplex => "half-duplex",
            Self::Asleep => "asleep",
            Self::SenderAsleep => "sender-asleep",
            Self::ChannelBusy => "channel-busy",
            Self::QueueFull => "queue-full",
            Self::TooLong => "too-long",
            Self::NoAcknowledgement => "no-acknowledgement",
            Self::NoChannel => "no-channel",
        }
    }
}

/// What became of the frames of one radio, or of all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Frames put on the air.
    pub sent: u64,
    /// Frames received and handed to the owner.
    pub received: u64,
    /// Frames received that were addressed to somebody else.
    pub overheard: u64,
    /// Frames received once more, since their acknowledgement was lost; not handed to the owner again.
    pub repeated: u64,
    lost: [u64; Loss::ALL.len()],
}

impl Counters {
    /// Frames lost for this reason.
    #[must_use]
    pub fn lost(&self, reason: Loss) -> u64 {
        self.lost[reason as usize]
    }

    /// Frames that passed this radio by on its channel, for any reason; frames it could not send
    /// are not among them.
    #[must_use]
    pub fn missed(&self) -> u64 {
        let reasons = Loss::ALL.into_iter().filter(|it| it.is_at_receiver());
        reasons.map(|reason| self.lost(reason)).sum()
    }

    pub(crate) fn lose(&mut self, reason: Loss, frames: u64) {
        self.lost[reason as usize] += frames;
    }
}

impl AddAssign for Counters {
    fn add_assign(&mut self, other: Self) {
        self.sent += other.sent;
        self.received += other.received;
        self.overheard += other.overheard;
        self.repeated += other.repeated;
        for (mine, theirs) in self.lost.iter_mut().zip(other.lost) {
            *mine += theirs;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_stand_at_their_own_place() {
        for (index, reason) in Loss::ALL.into_iter().enumerate() {
            assert_eq!(reason as usize, index, "{}", reason.name());
        }
    }

    #[test]
    fn sums_add_reason_by_reason() {
        let mut a = Counters {
            sent: 1,
            ..Counters::default()
        };
        a.lose(Loss::Noise, 3);
        a += a;
        assert_eq!((a.sent, a.lost(Loss::Noise), a.missed()), (2, 6, 6));
    }
}

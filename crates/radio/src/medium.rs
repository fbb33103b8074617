//! The medium: what all radios share, at some level of fidelity.

use crate::channel::Channel;
use crate::counters::Counters;
use crate::frame::{Frame, Request};
use crate::inbox::Inbox;
use crate::ledger::Usage;
use crate::radio::{RadioError, RadioId, RadioSpec, RadioState};
use crate::scratch::Scratch;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::{Current, Decibels, Frequency, Length, Pose, Position, PowerLevel};

/// Where platforms are at the instant that is being run.
///
/// Asked only when there is a frame on the air, at most once per platform and instant (see
/// [`generation`](Self::generation)). `pose` is asked only of platforms whose radio needs an
/// attitude: antennas off centre or with a direction.
pub trait Poses {
    /// Position and attitude of a platform.
    fn pose(&self, owner: ModelId) -> Pose;

    /// Position of a platform.
    fn position(&self, owner: ModelId) -> Position {
        self.pose(owner).position
    }

    /// Positions of many platforms, in their order: fills `positions`, which comes in empty.
    fn positions(&self, owners: &[ModelId], positions: &mut Vec<Position>) {
        positions.extend(owners.iter().map(|&owner| self.position(owner)));
    }

    /// What walls, things and bodies take of the power on the straight way between two antennas; the
    /// platforms that carry them do not count. Asked only where the channel says so, and must not
    /// depend on which end is which.
    fn obstruction(&self, _ends: [(ModelId, Position); 2], _frequency: Frequency) -> Decibels {
        Decibels::ZERO
    }

    /// A count that grows at least as fast as any platform moves: between two instants nobody came
    /// farther, on a straight line, than the difference of the readings; jumps count with their width.
    /// `None`: not known, now or ever; then nothing is taken over from one instant to the next.
    fn odometer(&self) -> Option<Length> {
        None
    }

    /// A number that changes whenever a pose jumps within one instant (a teleport). While it stays
    /// the same, a medium may use the positions of an earlier round of the same instant.
    fn generation(&self) -> u64 {
        0
    }
}

/// What a platform asks of its radio besides sending.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Command {
    /// Switch off: hear and send nothing.
    Sleep,
    /// Switch on again.
    Wake,
    /// Change the channel. What the radio was asked to send before goes out on the old one; where such
    /// frames wait, it changes when they are done with. Else it hears on the new one from the next round
    /// on, the round of this instant if there is one: all that is sent there, also by those who
    /// asked before.
    Tune(Channel),
    /// Change the power level, and with it what sending draws.
    Power {
        /// New power at the antenna's input.
        level: PowerLevel,
        /// New current while sending.
        current: Current,
    },
}

/// What all radios share, at some level of fidelity.
///
/// # The life of a round
///
/// ```text
/// commit of a round     submit, command             sequential, in the order of the agents
/// between rounds        next_time                   when it wants the next round
/// opening of a round    open                        sequential; lists who will find something
/// the round             collect, ambient, state     in parallel, one thread per platform
/// ```
///
/// `open` must be called in every round of a run, `collect` once for each radio of each owner that
/// `open` lists, whether the owner wants to listen or not: receiving takes a radio's time and
/// charge. Asking again in the same round gives the same inbox and counts nothing twice.
///
/// Radio ids come from `add`; asking about others panics.
///
/// # What implementations promise
///
/// Results depend on seeds, keys and poses only: not on threads, not on the order of adding or
/// numbering (beyond the order of packets in an inbox), not on radios that are out of reach.
pub trait Medium: Send + Sync {
    /// Puts a radio on the air, on since the start of the run. Before the run.
    ///
    /// # Errors
    /// Numbers that make no sense ([`RadioSpec::check`]); a key that is taken.
    fn add(&mut self, spec: RadioSpec) -> Result<RadioId, RadioError>;

    /// How many radios there are; their ids are 0 to here.
    fn radios(&self) -> usize;

    /// What a radio is, as it stands after all commands. A new channel shows from the next round on at
    /// the latest.
    fn spec(&self, radio: RadioId) -> &RadioSpec;

    /// Takes a request to send. What becomes of it is in the counters, and in an outcome if it
    /// has a ticket.
    fn submit(&mut self, now: SimTime, request: Request);

    /// Changes a radio's state.
    ///
    /// # Errors
    /// A channel or level that makes no sense; the radio stays as it was.
    fn command(&mut self, now: SimTime, radio: RadioId, command: Command)
    -> Result<(), RadioError>;

    /// When the medium wants the next round: the instant of the submission for frames that take no
    /// time, else its own next event. `None` if nothing is under way.
    fn next_time(&self) -> Option<SimTime>;

    /// Opens a round: does what is due at `now`, and fills `owners` (sorted, each once) with exactly
    /// those who will find a packet or an outcome in an inbox.
    fn open(&mut self, now: SimTime, poses: &dyn Poses, owners: &mut Vec<ModelId>);

    /// What a radio received in this round. `poses` are those that the round was opened with;
    /// `scratch` is the thread's own, and holds the packets until the next call.
    fn collect<'a>(
        &'a self,
        radio: RadioId,
        poses: &dyn Poses,
        scratch: &'a mut Scratch,
    ) -> Inbox<'a>;

    /// Shows the frames whose transmission began in this round and their channels, in an order that
    /// repeats. For who watches the air; a medium that shows none cannot be recorded packet by packet.
    fn begun(&self, _visit: &mut dyn FnMut(&Frame, Channel)) {}

    /// The power that a radio finds on its channel when it listens between frames: what clear
    /// channel assessment measures.
    fn ambient(&self, radio: RadioId) -> PowerLevel;

    /// What a radio is doing at `now`.
    fn state(&self, radio: RadioId, now: SimTime) -> RadioState;

    /// What became of the frames of one radio, up to the last round.
    fn counters(&self, radio: RadioId) -> Counters;

    /// The counters of all radios together.
    fn totals(&self) -> Counters {
        let mut totals = Counters::default();
        for radio in 0..self.radios() as u32 {
            totals += self.counters(RadioId(radio));
        }
        totals
    }

    /// How long a radio was in each state from the start of the run to `until`, and what that drew.
    /// `until` must not lie before the last round.
    fn usage(&self, radio: RadioId, until: SimTime) -> Usage;
}

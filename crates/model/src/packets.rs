//! What goes over the air, for those who watch a run: frames as they begin, and who received them.
//!
//! Nothing is noted unless a component asks for it
//! ([`Component::wants_packets`]), and nothing of it reaches the trace.

use crate::component::Component;
use crate::population::Population;
use crate::swarm::{Mark, Swarm};
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{Channel, Counters, Frame, Inbox, Medium, RadioId, RadioState};
use simbeeotic_units::{Decibels, Position, PowerLevel};
use std::collections::BTreeMap;

/// Who could listen is noted for a component that watches at most this many radios: for more it would
/// be more than all else.
pub const LINKED_RADIOS_MAX: usize = 256;

/// Frames that began at one instant, and who could listen to them.
#[derive(Clone, Debug)]
pub struct OnAir {
    /// The frames, those of watched radios only.
    pub frames: Vec<Transmission>,
    /// Radios that are awake, by id: where they are, and what they are tuned to. All those that are
    /// watched by a component which watches at most [`LINKED_RADIOS_MAX`].
    pub listeners: Vec<Listener>,
}

/// One frame, as it begins.
#[derive(Clone, Debug)]
pub struct Transmission {
    /// The frame.
    pub frame: Frame,
    /// The channel it goes out on.
    pub channel: Channel,
    /// Where its sender's platform is.
    pub position: Position,
}

/// A radio that is awake while a frame begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Listener {
    /// Which.
    pub radio: RadioId,
    /// The channel it is tuned to.
    pub channel: Channel,
    /// Where its platform is.
    pub position: Position,
}

/// One frame as one radio received it, and as it was handed to its owner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reception {
    /// The frame's identity ([`Frame::key`]).
    pub frame: u64,
    /// Who sent it.
    pub sender: RadioId,
    /// Who received it.
    pub radio: RadioId,
    /// Received signal strength.
    pub rssi: PowerLevel,
    /// The same above the mean noise of the radio.
    pub snr: Decibels,
    /// Link quality, 0 to 255.
    pub lqi: u8,
}

/// The radios whose frames somebody looks at.
#[derive(Default)]
pub(crate) struct PacketWatch {
    /// By id: whether this radio is one.
    watched: Vec<bool>,
    /// Those of which it is noted whether they could listen.
    listeners: Vec<RadioId>,
}

/// The path of each radio, by id: its owner's, and its name there.
pub(crate) fn radio_paths(swarm: &Swarm) -> Vec<String> {
    let Some(medium) = &swarm.medium else {
        return Vec::new();
    };
    let mut seen: BTreeMap<ModelId, usize> = BTreeMap::new();
    let radios = (0..medium.radios() as u32).map(RadioId);
    let path = |radio: RadioId| {
        let owner = medium.spec(radio).owner;
        let count = seen.entry(owner).or_default();
        let plan = swarm
            .gear
            .get(owner.index())
            .and_then(|gear| gear.radios.get(*count));
        *count += 1;
        let name = plan.map_or("radio", |plan| plan.name.as_str());
        format!("{}/{name}", owner_path(&swarm.population, owner))
    };
    radios.map(path).collect()
}

fn owner_path(population: &Population, owner: ModelId) -> &str {
    population.get(owner).map_or("", |member| member.path)
}

impl PacketWatch {
    /// The radios that one of the components wants; who could listen is noted for those among the
    /// radios of a component that wants few. So what one component sees does not hang on how many
    /// another one wants.
    fn choose(swarm: &Swarm, components: &[&dyn Component]) -> Option<Box<Self>> {
        if components.is_empty() {
            return None;
        }
        let paths = radio_paths(swarm);
        let mut watched = vec![false; paths.len()];
        let mut linked = vec![false; paths.len()];
        for component in components {
            let wants = |path: &String| component.wants_packets(path, paths.len());
            let wanted: Vec<usize> = (0..paths.len()).filter(|at| wants(&paths[*at])).collect();
            for at in &wanted {
                watched[*at] = true;
                linked[*at] |= wanted.len() <= LINKED_RADIOS_MAX;
            }
        }
        let radios = (0..linked.len() as u32).map(RadioId);
        let listeners = radios.filter(|radio| linked[radio.index()]).collect();
        let any = watched.contains(&true);
        any.then(|| Box::new(Self { watched, listeners }))
    }

    fn watches(&self, radio: RadioId) -> bool {
        self.watched.get(radio.index()).copied().unwrap_or(false)
    }

    /// The frames of a round that began in it; `None` if there are none of these radios.
    pub(crate) fn look(
        &self,
        medium: &dyn Medium,
        position: impl Fn(ModelId) -> Position,
        now: SimTime,
    ) -> Option<Mark> {
        let mut frames = Vec::new();
        medium.begun(&mut |frame, channel| {
            if self.watches(frame.radio()) {
                frames.push(Transmission {
                    frame: frame.clone(),
                    channel,
                    position: position(frame.sender()),
                });
            }
        });
        if frames.is_empty() {
            return None;
        }
        let awake = self.listeners.iter().copied();
        let awake = awake.filter(|radio| medium.state(*radio, now) != RadioState::Sleep);
        let listeners = awake.map(|radio| {
            let spec = medium.spec(radio);
            Listener {
                radio,
                channel: spec.channel,
                position: position(spec.owner),
            }
        });
        let air = Box::new(OnAir {
            frames,
            listeners: listeners.collect(),
        });
        Some(Mark::OnAir { time: now, air })
    }

    /// What of an inbox is noted.
    pub(crate) fn receptions(&self, inbox: &Inbox<'_>) -> Box<[Reception]> {
        let packets = inbox.iter();
        let packets = packets.filter(|packet| self.watches(packet.frame().radio()));
        packets
            .map(|packet| Reception {
                frame: packet.frame().key(),
                sender: packet.frame().radio(),
                radio: inbox.radio(),
                rssi: packet.rssi(),
                snr: packet.snr(),
                lqi: packet.lqi(),
            })
            .collect()
    }
}

impl Swarm {
    /// Notes which radios' frames are kept: those that one of the components wants.
    pub(crate) fn choose_packets(&mut self, components: &[&dyn Component]) {
        self.packet_watch = PacketWatch::choose(self, components);
    }

    /// What became of all frames, or of those of one radio.
    pub(crate) fn radio_counters(&self, radio: Option<RadioId>) -> Counters {
        let medium = self.medium.as_ref();
        let counters = medium.map(|medium| match radio {
            Some(radio) => medium.counters(radio),
            None => medium.totals(),
        });
        counters.unwrap_or_default()
    }
}

//! Small layers on top of the packet interface: neighbour discovery, flooding, time slots.
//!
//! A layer here is a value that a behaviour owns. It never touches a radio or a timer itself: it says
//! which bytes to send and when it wants to be asked again, and is told what was heard. So it can be
//! tested without a run, works with any radio of any platform, and two of them can share one radio:
//! the first byte of a packet says whose it is, and packets of others are left alone.
//!
//! | layer | what it does | used by |
//! |---|---|---|
//! | [`Beacons`] | who is around, and how good is the link there and back | [`beacon_bee`](crate::behavior::beacon_bee) |
//! | [`Flood`] | brings a message to everybody, hop by hop, once | [`flood_bee`](crate::behavior::flood_bee) |
//! | [`Slots`] | sends only in a time slot of one's own | [`slot_bee`](crate::behavior::slot_bee) |
//!
//! A behaviour that knows its neighbours:
//!
//! ```
//! use simbeeotic_model::prelude::*;
//! use simbeeotic_models::net::{Beacons, BeaconsParams, Heard};
//!
//! /// A bee that knows who is around.
//! #[behavior("social-bee")]
//! pub struct SocialBee {
//!     radio: RadioHandle,
//!     beacons: Beacons,
//!     timer: TimerHandle,
//! }
//!
//! impl Behavior for SocialBee {
//!     type Params = BeaconsParams;
//!
//!     fn build(params: BeaconsParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
//!         let mut beacons = Beacons::new(params, kit.stream("beacons"))?;
//!         let timer = kit.once(beacons.first(), Self::beat);
//!         Ok(Self { radio: kit.radio()?, beacons, timer })
//!     }
//!
//!     fn on_packet(&mut self, packet: &Packet<'_>, bee: &mut Bee<'_>) {
//!         self.beacons.hear(bee.id(), Heard::from(packet));
//!     }
//! }
//!
//! impl SocialBee {
//!     fn beat(&mut self, bee: &mut Bee<'_>) {
//!         let beacon = self.beacons.beacon(bee.now());
//!         bee.send(self.radio, &beacon);
//!         bee.arm(self.timer, self.beacons.pause());
//!         bee.metric("neighbors", self.beacons.neighbors().len() as f64, "1");
//!     }
//! }
//! ```
//!
//! # On the air
//!
//! Numbers are little-endian. Whoever hears bytes that are none of these takes them for somebody
//! else's; nothing that comes in by radio can end a run.
//!
//! | layer | bytes |
//! |---|---|
//! | [`Beacons`] | `0xb1`, sequence number 2, neighbours known 1, then for each one listed: address 4, quality 1 |
//! | [`Flood`] | `0xf1`, origin 4, sequence number 2, hops so far 1, most hops 1, then the message |
//! | [`Slots`] | nothing of its own |

mod beacons;
mod flood;
mod slots;
mod wire;

pub use beacons::{Beacons, BeaconsParams, Neighbor};
pub use flood::{Delivery, Flood, FloodCounters, FloodParams};
pub use slots::{Assignment, Slots, SlotsCounters, SlotsParams};

use simbeeotic_model::kernel::{ModelId, SimTime};
use simbeeotic_model::radio::Packet;
use simbeeotic_model::units::PowerLevel;

/// What a layer must know of a packet that was heard.
#[derive(Clone, Copy, Debug)]
pub struct Heard<'a> {
    /// The platform that sent it.
    pub sender: ModelId,
    /// Its bytes.
    pub payload: &'a [u8],
    /// How strong it was.
    pub rssi: PowerLevel,
    /// When it was received.
    pub time: SimTime,
}

impl<'a> From<&Packet<'a>> for Heard<'a> {
    fn from(packet: &Packet<'a>) -> Self {
        Self {
            sender: packet.sender(),
            payload: packet.payload(),
            rssi: packet.rssi(),
            time: packet.time(),
        }
    }
}

//! Radio: antennas, propagation, error models, radios, and the medium they share.
//!
//! **One event per transmission.** A frame is one payload, shared by all who receive it. When it is
//! due, one pass over columns finds out who hears it; each of those is woken once and gets an
//! [`Inbox`], a batch of [`Packet`]s. An event for each potential receiver, as the original had it,
//! costs more than everything else a radio does: 73 to 90 ns a pair against less than 4 ns.
//!
//! ```
//! use simbeeotic_kernel::{ModelId, SimTime, rng::path_key};
//! use simbeeotic_radio::{
//!     Medium, Poses, RadioSpec, Request, Scratch, SimpleConfig, SimpleMedium, cc2420,
//! };
//! use simbeeotic_units::{Attitude, Length, Pose, Position};
//!
//! /// Bees on a line, 5 m apart.
//! struct Line;
//!
//! impl Poses for Line {
//!     fn pose(&self, owner: ModelId) -> Pose {
//!         let east = Length::from_metres(5.0) * f64::from(owner.0);
//!         Pose::new(Position::new(east, Length::ZERO, Length::ZERO), Attitude::IDENTITY)
//!     }
//! }
//!
//! let config = SimpleConfig { range_limit: Length::from_metres(12.0), ..SimpleConfig::default() };
//! let mut medium = SimpleMedium::new(config)?;
//! let mut radios = Vec::new();
//! for bee in 0..4 {
//!     let spec = RadioSpec {
//!         owner: ModelId(bee),
//!         key: path_key(&format!("bee-{bee}/radio")),
//!         ..cc2420::spec(11, 31).expect("channel 11 and level 31 exist")
//!     };
//!     radios.push(medium.add(spec)?);
//! }
//!
//! // Bee 0 speaks; the bees 5 and 10 m away hear it, the one at 15 m does not.
//! let now = SimTime::from_secs(1);
//! medium.submit(now, Request::broadcast(radios[0], Arc::from(*b"buzz")));
//! let mut owners = Vec::new();
//! medium.open(now, &Line, &mut owners);
//! assert_eq!(owners, [ModelId(1), ModelId(2)]);
//!
//! let mut scratch = Scratch::new();
//! for packet in medium.collect(radios[2], &Line, &mut scratch) {
//!     assert_eq!(packet.payload(), b"buzz");
//!     assert!((packet.rssi().dbm() + 60.07).abs() < 0.01);
//! }
//! # use std::sync::Arc;
//! # Ok::<(), simbeeotic_radio::RadioError>(())
//! ```
//!
//! # Layers
//!
//! Each is a trait, chosen by name in a scenario, and may be replaced by itself:
//!
//! | layer | trait | here |
//! |---|---|---|
//! | which way the power goes | [`Antenna`] | [`Isotropic`], [`ShortDipole`], [`HalfWaveDipole`], [`Patch`], [`Cosine`], [`Pattern`] |
//! | what is left of it | [`Propagation`] | [`FreeSpace`], [`LogDistance`], [`TwoRay`], [`TwoRayExact`], [`LinkTable`], [`Composite`] |
//! | what chance adds to that | [`Shadowing`]; [`Fading`] | [`Rayleigh`], [`Rician`], [`Nakagami`] |
//! | whether that is enough | [`ErrorModel`] | [`Cc2420Curve`], [`Threshold`] |
//! | what the radio is | [`RadioSpec`], a record | [`cc2420`], [`at86rf23x`], [`nrf`], [`sx127x`] |
//! | how well it tells bits apart | [`BitErrors`] | [`OqpskDsss`] |
//! | who may speak, and what collides | [`Medium`] | [`SimpleMedium`], [`Ieee802154Medium`] |
//!
//! # Reading order
//!
//! 1. [`medium`]: the face towards the engine, and the life of a round;
//! 2. [`frame`] and [`inbox`]: what goes in and what comes out;
//! 3. [`radio`], [`channel`], [`antenna`], [`propagation`], [`error_model`]: the layers;
//! 4. [`simple`]: the medium of the paper, and how it is made fast;
//! 5. [`phy`] and [`mod@ieee802154`]: air time, medium access and interference;
//! 6. [`ledger`] and [`counters`]: time, charge and losses;
//! 7. [`mod@drive`]: a medium by itself, without an engine;
//! 8. [`table`]: patterns of antennas and gains of links as text, and what is wrong with it.

mod aim;
pub mod antenna;
pub mod at86rf23x;
pub mod bit_errors;
pub mod cc2420;
pub mod channel;
pub mod counters;
pub mod drive;
pub mod error_model;
pub mod fading;
mod fast;
pub mod frame;
mod grid;
pub mod ieee802154;
pub mod inbox;
pub mod ledger;
pub mod medium;
pub mod nrf;
pub mod phy;
pub mod propagation;
pub mod radio;
mod scratch;
pub mod shadowing;
pub mod simple;
pub mod sx127x;
pub mod table;

pub use antenna::{Antenna, Cosine, HalfWaveDipole, Isotropic, Patch, Pattern, ShortDipole};
pub use bit_errors::{Bitwise, Bpsk, Gfsk, Step};
pub use channel::Channel;
pub use counters::{Counters, Loss};
pub use error_model::{Cc2420Curve, ErrorModel, Logistic, Threshold, TossimCurve};
pub use fading::{Fading, Nakagami, Rayleigh, Rician};
pub use frame::{Frame, Outcome, Request, Ticket};
pub use ieee802154::{AccessStatistics, Arithmetic, Ieee802154Config, Ieee802154Medium, Quirks};
pub use inbox::{Inbox, Packet, Packets};
pub use ledger::Usage;
pub use medium::{Command, Medium, Poses};
pub use phy::{Access, Acks, BitErrors, Cca, CcaMode, Csma, LinkQuality, OqpskDsss, Phy, Spacing};
pub use propagation::{
    Composite, End, FrameKeys, FreeSpace, Ground, Link, LinkTable, Links, LogDistance, MissingLink,
    Polarisation, Propagation, Remark, Role, TwoRay, TwoRayExact, TwoRayForm,
};
pub use radio::{Currents, Framing, RadioError, RadioId, RadioSpec, RadioState};
pub use scratch::Scratch;
pub use shadowing::Shadowing;
pub use simple::{Delivery, DeliveryCurve, GilbertElliott, SimpleConfig, SimpleMedium};
pub use table::TableFault;

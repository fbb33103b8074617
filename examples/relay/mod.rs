//! A chain of relays that keeps an explorer in touch with its base, around the corners of a city.
//!
//! An explorer flies along streets, away from its base, and reports twice a second. Houses stop its radio
//! after the first corner. Relays follow and place themselves so that reports get through, from hop to hop.
//!
//! # Where a relay stands
//!
//! Everybody keeps to the explorer's **trail**: a crumb each five metres, told on from neighbour to neighbour.
//! So a place is one number, `s`, the way along the trail from the base. Who is next on either side, a relay
//! knows by radio: of those whom it hears, the one with the greatest smaller `s` is behind it, the one with the
//! least greater `s` ahead. It moves along the trail with
//!
//! ```text
//! ds/dt = g (R_behind - R_ahead)      both are heard: towards the weaker link
//! ds/dt = g (R_behind - R_floor)      the chain is torn ahead: on, as far as the link behind stays good
//! ds/dt = -v_max                      nobody is behind: back to where somebody is
//! ```
//!
//! and |ds/dt| <= `v_max`; `R` is the mean strength of the beacons heard, in dBm. The first line is the descent of
//! a potential: the loss of the worse of the two links. The chain is **torn** ahead of a relay that hears nobody
//! there although the trail goes on, and of whoever hears from the next one that it is: so the whole chain
//! stretches to where the explorer was lost. Behind a corner a link loses tens of decibels within some metres,
//! and a relay that feels its way by strength alone would step over that **edge** again and again. So it
//! remembers how long a link was when it broke, and does not let it become as long again until the other end
//! is somewhere else. When a relay falls silent, its neighbours find themselves next to each other, or alone,
//! and the same three lines close the gap: there is no plan, no leader and no number of relays in it.
//!
//! Relays that keep a link by its strength, with the trail as crumbs: H. G. Nguyen, N. Pezeshkian, A. Gupta and
//! N. Farrington, "Maintaining communications link for a robot operating in a hazardous environment", ANS 10th
//! Int. Conf. on Robotics and Remote Systems for Hazardous Environments, 2004; robots that even out their links:
//! C. Dixon and E. W. Frew, "Maintaining optimal communication chains in robotic sensor networks using mobility
//! control", Mobile Networks and Applications 14(3), 2009. (Both cited from memory, not at hand.)
//!
//! # How a report gets to the base
//!
//! By unicast with acknowledgement, to the neighbour with less `s` over which the expected number of
//! transmissions to the base is least (ETX, D. De Couto et al., MobiCom 2003), as the `Beacons` of
//! `simbeeotic::models::net` estimate it for each link. Since `s` falls from hop to hop, no report goes round
//! in circles. What nobody acknowledges is sent to another neighbour; what nobody can take waits. The base
//! answers each report, and its words go back the way that the last report came. An explorer on a leash flies
//! on only while it hears them.

mod base;
mod explorer;
mod guide;
mod node;
#[expect(clippy::module_inception, reason = "the relays of a relay chain")]
mod relay;
#[cfg(test)]
mod test;
mod trail;
mod wire;

pub use base::{RelayBase, RelayBaseParams};
pub use explorer::{RelayExplorer, RelayExplorerParams};
pub use relay::{RelayBee, RelayBeeParams};

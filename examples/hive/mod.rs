//! The hive: a swarm that searches a field for flowers, and works where they are. The paper's Figure 9.
//!
//! B. Kate, J. Waterman, K. Dantu and M. Welsh, *Simbeeotic: A Simulator and Testbed for Micro-Aerial
//! Vehicle Swarm Experiments*, IPSN 2012, section 5.2: "We discretize the world into cells and dispatch MAVs
//! from the hive to perform a specific task until they are low on energy, at which point they return to
//! recharge. A planner at the hive analyzes the results of the trip (the information collected) and
//! determines which cells require more attention." Its code was never published;
//! the planner here is our own ([`planner`]). The same group's K. Dantu et al., *Programming Micro-Aerial
//! Vehicle Swarms With Karma*, SenSys 2011, is about such a hive; its text was not at hand.
//!
//! ```text
//!            pads: briefing, order                       radio: next task
//!     hive ------------------------> MAV   out there  <------------------ hive
//!          <------------------------                  ------------------>
//!            pads: report, ready                    radio: done, going home, status
//! ```
//!
//! Nothing else passes. What is said on the pads (`landing.rs`) goes by the plug that charges: the hive hears
//! those alone who rest on its pads. What is said by radio has bytes (`wire.rs`), takes air time, collides and
//! fades. A result by radio is a count; where the flowers are is handed in at landing.
//!
//! | file | what is in it |
//! |---|---|
//! | [`mav`] | a MAV: pad, way out, work, way home; when to go home |
//! | `flight.rs`, `finds.rs` | where it believes to be, and its legs; the flowers it has seen |
//! | [`station`], [`planner`], `cells.rs` | pads and charger; which cell needs somebody most; the field in cells |
//! | [`scheme`], [`beacon`] | the three ways to coordinate; the beacons that remember for the emergent one |
//! | `landing.rs`, `wire.rs` | what is said on the pads, and by radio |
//! | [`referee`] | coverage, flowers, energy, losses, idleness: measured from outside |

pub mod beacon;
mod cells;
mod finds;
mod flight;
mod landing;
pub mod mav;
pub mod planner;
pub mod referee;
pub mod scheme;
pub mod station;
mod wire;

#[cfg(test)]
mod test;

//! A swarm through an office building that it does not know.
//!
//! The swarm gradient bug algorithm: no map, no place on it, little memory. Each bee has a direction of
//! its own (`goal`), flies along it until there is a wall, follows the wall, and leaves it where it ends
//! and the direction is free again:
//!
//! ```text
//!   enter -> rotate ----------> forward --- wall ahead ---> wall (on the left or the right)
//!              ^   to its own      ^                          |       |
//!              |   direction       |                          |       +- came back behind where it met
//!              +-- goes round an edge, its direction is free -+          the wall: next time the other side
//! ```
//! **Apart**: directions fan out by the bees' addresses. Each says its own by radio; who hears another of
//! lower address near by (by RSSI), with a direction to the same side, mirrors its own; who hears it very
//! near waits until it is past.
//!
//! **Home**: after a while the direction is where the beacon at the entrance becomes louder, from its
//! RSSI after each metre (`gradient.rs`); all else stays the same. Walls make that gradient crooked.
//!
//! **Walls** are followed by the nearest echo on the wall's side: it is kept abeam and at a distance
//! (`wall.rs`); so an edge is rounded, a door entered, a corner left.
//!
//! Source: K. N. McGuire, C. De Wagter, K. Tuyls, H. J. Kappen and G. C. H. E. de Croon, *Minimal
//! navigation solution for a swarm of tiny flying robots to explore an unknown environment*, Science
//! Robotics 4 (2019) eaaw9710; the paper was not at hand, the authors' code was (`tudelft/gradient_bug` on
//! GitHub). From there: the states and what leads from one to the next, the check for loops, priorities
//! and mirrored directions, the points for eight directions. Other than there: a ring of 24 range finders
//! in place of four; the gradient is taken along the whole way and not along walls only, and is kept when
//! a wall is met; who comes out of the entrance turns round. All numbers are this example's.

mod explorer;
mod gradient;
mod home;
mod wall;
mod words;

#[cfg(test)]
mod test;

pub use explorer::{Explorer, ExplorerParams, Homing};
pub use home::{Beacon, BeaconParams, Referee, RefereeParams};

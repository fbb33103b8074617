//! Plume search: a swarm finds a leak in a turning, turbulent wind.
//!
//! Gas in a wind has no slope to climb: it comes in shreds, and the mean that would show the way takes
//! minutes. Moths go another way, and so do these bees. While there is a smell, fly against the wind
//! (*surge*); when it is gone, fly to and fro across the wind until it is there again (*cast*):
//!
//! ```text
//!            smell                        no smell for `patience`
//!   seek ------------> surge: v = -V w/|w| ------------------> cast: p = p* +- c 2^k n - b_k w_up
//!     ^                  ^                                       |           |
//!     |                  +-------------------- smell ------------+           |
//!     +------------------------------------ `casts` pairs flown -------------+
//! ```
//! with the wind `w` (the mean of late of what the [`Anemometer`] says, plus the velocity over ground),
//! `w_up = -w/|w|`, `n` across it, `p*` where it smelled something last, `c` the first cast, and `b_k` how
//! much farther downwind each wider pair begins. A bee that seeks flies to and fro at 75 degrees to the
//! wind, between the edges of the area.
//!
//! **The nose adapts**: a smell counts while it is a fifth of the strongest of the last seconds. Near the
//! leak it is a thousand times that of far away, and a slow sensor would go on smelling for long after
//! the plume's end.
//!
//! **The leak** is where the plume ends upwind: each loss leaves a point `p*` (a last detection point),
//! and when `points` of them lie together within `zone` of the one farthest upwind, their mean is
//! declared (`trail.rs`). The base calls all home when declarations of three bees agree (`base.rs`).
//!
//! **Together**: who smells something says where, and who seeks comes (`attract` of Hayes et al.).
//!
//! Sources. Surge and cast, with the last detection points: W. Li, J. A. Farrell and R. T. Cardé,
//! *Tracking of Fluid-Advected Odor Plumes: Strategies Inspired by Insect Orientation to Pheromone*,
//! Adaptive Behavior 9 (2001) 143-170. The zone of last detection points: W. Li, *Identifying an Odour
//! Source in Fluid-advected Environments, Algorithms Abstracted from Moth-inspired Plume Tracing
//! Strategies*, Applied Bionics and Biomechanics 7 (2010) 3-17. Calls: A. T. Hayes, A. Martinoli and
//! R. M. Goodman, *Distributed Odor Source Localization*, IEEE Sensors Journal 2 (2002) 260-271. Of these
//! the second's abstract was at hand, the others not: the algorithm is theirs in kind; its numbers, and
//! the shape of the casts, are this example's.

mod anemometer;
mod base;
mod tracer;
mod trail;
mod words;

#[cfg(test)]
mod test;

pub use anemometer::{Anemometer, AnemometerParams};
pub use base::{Base, BaseParams, Referee, RefereeParams};
pub use tracer::{Tracer, TracerParams};

//! A flock whose members know each other by radio only.
//!
//! Each MAV broadcasts where it believes it is and how it moves, and keeps a table of what it has heard of
//! others. Nobody sees anybody: positions are a satellite receiver's, quantised to a packet of twelve bytes,
//! late by what the receiver and the channel take, and lost when the channel says so. What an entry of the
//! table says is carried on to now by its velocity (dead reckoning), and forgotten when it is too old.
//!
//! # The law
//!
//! G. Vásárhelyi, C. Virágh, G. Somorjai, T. Nepusz, A. E. Eiben and T. Vicsek, "Optimized flocking of
//! autonomous drones in confined environments", Science Robotics 3(20), eaat3536, 2018, equations 1 to 8. In
//! the plane, the velocity that `i` wants is
//!
//! ```text
//! v = v_flock v_i / |v_i|  +  sum rep_ij  +  sum frict_ij  +  sum wall_is,        |v| <= v_max
//!
//! D(r, a, p)  =  0                       for r <= 0
//!                r p                     for r p < a / p
//!                sqrt(2 a r - a^2/p^2)   beyond                        the fastest that still stops in r
//!
//! rep_ij      =  p_rep (r0_rep - r_ij) away from j                     for r_ij < r0_rep
//! frict_ij    =  C_frict (v_ij - m) towards the velocity of j          for v_ij > m,
//!                m = max(v_frict, D(r_ij - r0_frict, a_frict, p_frict))
//! wall_is     =  (v_is - m) towards the velocity of s                  for v_is > m,
//!                m = D(r_is - r0_shill, a_shill, p_shill)
//! ```
//!
//! `r_ij` is how far `j` is, `v_ij` how much its velocity differs. Repulsion keeps neighbours apart; friction
//! makes them fly alike, the more the nearer they are. A wall is a flock of one, `s` ("shill agent"): it sits
//! where the wall is nearest, and flies away from it with `v_shill`. There is no attraction: the walls keep
//! the flock together, and friction gives it one direction. The rules (keep off, fly alike, stay together)
//! are those of C. Reynolds, "Flocks, herds, and schools: a distributed behavioral model", SIGGRAPH 1987.
//!
//! # Order
//!
//! The referee measures, from the truth, `order = |sum v_i / |v_i|| / n`: 1 if all fly the same way, about
//! `1 / sqrt(n)` by chance (T. Vicsek et al., "Novel type of phase transition in a system of self-driven
//! particles", Physical Review Letters 75, 1995, equation 2).

mod bee;
mod law;
mod referee;
mod table;
#[cfg(test)]
mod test;

pub use bee::{FlockBee, FlockBeeParams};
pub use law::Law;
pub use referee::{FlockReferee, FlockRefereeParams};

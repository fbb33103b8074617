//! Weather: wind, air, light and rain over space and time.
//!
//! [`constant`] is one wind in the standard atmosphere. [`atmosphere`] is everything else: [`mean`]
//! wind with a profile over height, Dryden turbulence ([`dryden`]), gusts ([`gust`]), vortices
//! ([`vortex`]), a recorded wind ([`grid`]), the state of the air ([`air`]), daylight ([`sky`]) and
//! rain ([`showers`]). All are functions of place and time: nothing is stepped, and nobody's question
//! changes another's answer.

pub mod air;
pub mod atmosphere;
pub mod constant;
pub mod dryden;
pub mod grid;
pub mod gust;
pub mod mean;
pub mod showers;
pub mod sky;
pub mod vortex;

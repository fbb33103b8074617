//! Fading: what echoes do to the power of one frame at one receiver.

pub mod nakagami;
pub mod rayleigh;
pub mod rician;

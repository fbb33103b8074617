//! Levels of fidelity of the air that radios share.

pub mod bernoulli;
mod chance;
pub mod gilbert_elliott;
pub mod ieee802154;
pub mod off;
pub mod simple;

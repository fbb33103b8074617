//! Levels of fidelity of the air that radios share.

pub mod ieee802154;
pub mod off;
pub mod simple;

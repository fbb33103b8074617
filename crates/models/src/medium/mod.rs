//! Levels of fidelity of the air that radios share.

pub mod off;
pub mod simple;

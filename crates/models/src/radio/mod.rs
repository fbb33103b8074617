//! Radios, each from its datasheet.

pub mod cc2420;

//! Weather: wind over space and time.

pub mod constant;

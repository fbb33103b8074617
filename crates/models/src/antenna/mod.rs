//! Antenna patterns.

pub mod isotropic;

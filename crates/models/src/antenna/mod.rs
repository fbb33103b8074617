//! Antennas: how much of the power goes which way.

pub mod cosine;
pub mod half_wave_dipole;
pub mod isotropic;
pub mod patch;
pub mod pattern;
pub mod short_dipole;

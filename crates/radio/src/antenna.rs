//! Antennas: how much of the power goes which way.

use glam::DVec3;
use simbeeotic_units::Decibels;
use std::fmt;

/// An antenna pattern. The same for sending and receiving (reciprocity).
pub trait Antenna: Send + Sync + fmt::Debug {
    /// Gain over an isotropic antenna towards `direction`.
    ///
    /// `direction` has length one and is given in the antenna's own frame: x is the boresight, y
    /// points left and z up as seen along it (FLU). A rod antenna stands along z.
    fn gain(&self, direction: DVec3) -> Decibels;

    /// The gain if it is the same in every direction, else `None`.
    ///
    /// A medium asks once and then spares itself the direction of every single link.
    fn uniform_gain(&self) -> Option<Decibels> {
        None
    }
}

/// An antenna that radiates alike in every direction. No real antenna does; many come near enough.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Isotropic {
    /// Gain in every direction. 0 dB is the lossless one; negative for matching and cable losses.
    pub gain: Decibels,
}

impl Antenna for Isotropic {
    fn gain(&self, _direction: DVec3) -> Decibels {
        self.gain
    }

    fn uniform_gain(&self) -> Option<Decibels> {
        Some(self.gain)
    }
}

//! What antennas with a direction and walls do to a link: the one rule of all media.

use crate::antenna::Antenna;
use crate::medium::Poses;
use glam::{DVec3, Mat3, Vec3};
use simbeeotic_kernel::ModelId;
use simbeeotic_units::{Attitude, Frequency, Position};

/// One end of a link.
pub(crate) struct End<'a> {
    /// East, north, up of the antenna, metres.
    pub(crate) enu_m: [f32; 3],
    /// The antenna, if its gain depends on the direction.
    pub(crate) antenna: Option<&'a dyn Antenna>,
    /// See [`antenna_from_world`].
    pub(crate) antenna_from_world: Mat3,
}

/// The rotation of directions from the world's frame to that of an antenna, whose attitude in the world is
/// given.
pub(crate) fn antenna_from_world(antenna: Attitude) -> Mat3 {
    antenna.matrix().transpose().as_mat3()
}

/// Gains of the antennas with a direction at both ends of a link, linear; 1 for those without.
#[inline]
pub(crate) fn directed_gain(tx: &End<'_>, rx: &End<'_>) -> f32 {
    let way = Vec3::from_array(rx.enu_m) - Vec3::from_array(tx.enu_m);
    // Two antennas in one place have no direction to each other.
    let Some(tx_to_rx) = way.try_normalize() else {
        return 1.0;
    };
    tx.gain(tx_to_rx) * rx.gain(-tx_to_rx)
}

/// What walls and bodies leave of the power between two antennas, linear. Of each end: who carries it, and
/// where it is, east, north, up, metres.
pub(crate) fn walls_gain(
    poses: &dyn Poses,
    ends: [(ModelId, [f32; 3]); 2],
    frequency: Frequency,
) -> f32 {
    let ends = ends.map(|(owner, [x, y, z])| {
        let place = DVec3::new(x.into(), y.into(), z.into());
        (owner, Position::from_si(place))
    });
    (-poses.obstruction(ends, frequency)).ratio() as f32
}

impl End<'_> {
    /// The gain towards a direction in the world.
    #[inline]
    fn gain(&self, direction: Vec3) -> f32 {
        self.antenna.map_or(1.0, |antenna| {
            antenna.gain_linear(self.antenna_from_world * direction)
        })
    }
}

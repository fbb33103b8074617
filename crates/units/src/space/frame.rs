//! The two frames, as types.

/// A right-handed frame of reference: a tag on vectors, without a value.
pub trait Frame: Copy + Send + Sync + 'static {
    /// The frame's name: `"ENU"`.
    const NAME: &'static str;
    /// The names of its axes: `["east", "north", "up"]`.
    const AXES: [&'static str; 3];
}

/// The world: x east, y north, z up. Fixed to the ground, which is flat; inertial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Enu;

/// A body: x forward, y left, z up, fixed to the body, with its centre of mass as the origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flu;

impl Frame for Enu {
    const NAME: &'static str = "ENU";
    const AXES: [&'static str; 3] = ["east", "north", "up"];
}

impl Frame for Flu {
    const NAME: &'static str = "FLU";
    const AXES: [&'static str; 3] = ["forward", "left", "up"];
}

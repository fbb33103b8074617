//! How a thing feels to what touches it: friction and restitution.

/// How a thing feels to what touches it. In files its two numbers stand among the others of the
/// thing: `friction = 0.8`. Of two surfaces that meet the geometric mean counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Coulomb coefficient of friction, 0 to [`FRICTION_MAX`].
    pub friction: f64,
    /// Normal speed after an impact over that before it: 0 (dead) to 1 (elastic).
    pub restitution: f64,
}

/// Greatest coefficient of friction.
pub const FRICTION_MAX: f64 = 1e3;

impl Surface {
    /// The surface of everything that says nothing about it: friction 0.5 and no bounce, as in the
    /// original.
    pub const USUAL: Self = Self {
        friction: 0.5,
        restitution: 0.0,
    };
}

impl Default for Surface {
    fn default() -> Self {
        Self::USUAL
    }
}

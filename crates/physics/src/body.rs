//! What a body is: mass, surface, and whom it may touch.

use crate::error::{self, BodyError};
use crate::kind::Kind;
use crate::limits;
use crate::shape::Shape;
use glam::DVec3;
use simbeeotic_units::Attitude;

/// A body's place in [`Physics`](crate::Physics): its index in the order of
/// [`Physics::add`](crate::Physics::add).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(transparent)]
pub struct BodyId(pub u32);

impl BodyId {
    /// This id as an index into the bodies.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// What happens when a body touches something.
///
/// Of two bodies the weaker wish counts: a pair bounces only if both respond, and passes unseen if
/// either says none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Contacts {
    /// Nothing: it passes through, and costs nothing.
    #[default]
    None,
    /// It passes through; a [`Contact`](crate::Contact) is reported when the touch begins, and again
    /// only after the two have parted.
    Detect,
    /// It bounces, slides and rests; every impact is reported.
    Respond,
}

/// Who moves a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Mobility {
    /// Forces and contacts do.
    #[default]
    Free,
    /// Someone outside does, by setting pose and velocities (a ghost): between two settings it moves
    /// on at constant velocities. Others bounce off it; nothing pushes it.
    Driven,
    /// Nobody: it stays where it is.
    Fixed,
}

/// How a surface meets another.
///
/// Of two surfaces the geometric mean counts, so that two alike behave as the tables say, and two
/// of which one is smooth (or dead) are smooth (or dead).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Coulomb coefficient of friction, 0 to 1000. Sliding over the ground keeps it to 24 bits.
    pub friction: f64,
    /// Normal speed after an impact over that before it, 0 (dead) to 1 (elastic).
    pub restitution: f64,
}

impl Material {
    /// What counts between this surface and another.
    #[must_use]
    pub fn against(&self, other: &Self) -> Self {
        Self {
            friction: (self.friction * other.friction).sqrt(),
            restitution: (self.restitution * other.restitution).sqrt(),
        }
    }

    pub(crate) fn check(&self) -> Result<(), BodyError> {
        error::ranged("friction", self.friction, 0.0, limits::FRICTION_MAX)?;
        error::ranged("restitution", self.restitution, 0.0, 1.0)
    }
}

impl Default for Material {
    /// Friction 0.5 and no bounce, as in the original.
    fn default() -> Self {
        Self {
            friction: 0.5,
            restitution: 0.0,
        }
    }
}

/// Collision groups, numbered as in the original. A body is in some groups and collides with some:
/// two bodies collide if each is in a group that the other collides with.
pub mod group {
    /// No group.
    pub const NONE: u16 = 0;
    /// Vehicles.
    pub const BEE: u16 = 1;
    /// Flowers.
    pub const FLOWER: u16 = 2;
    /// Hives.
    pub const HIVE: u16 = 4;
    /// The ground and what stands on it.
    pub const TERRAIN: u16 = 8;
    /// Every group.
    pub const ALL: u16 = u16::MAX;
}

/// Everything that [`Physics::add`](crate::Physics::add) needs to know about a body.
///
/// ```
/// use simbeeotic_physics::{BodySpec, Shape};
/// use simbeeotic_units::glam::DVec3;
///
/// let spec = BodySpec {
///     p_enu: DVec3::new(0.0, 0.0, 10.0),
///     ..BodySpec::new(Shape::Sphere { radius_m: 0.1 }, 0.128)
/// };
/// assert!(spec.check().is_ok());
/// assert!(BodySpec { mass_kg: 0.0, ..spec.clone() }.check().is_err());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BodySpec {
    /// Outline.
    pub shape: Shape,
    /// Mass in kilograms, 1e-9 to 1e9.
    pub mass_kg: f64,
    /// Principal moments of inertia about the body axes, kg m^2, each positive and at most the sum of
    /// the others. Kept to 24 bits (7 digits).
    pub inertia_kg_m2: DVec3,
    /// Position of the centre of mass at the start, ENU, m.
    pub p_enu: DVec3,
    /// Attitude at the start.
    pub attitude: Attitude,
    /// Velocity at the start, ENU, m/s.
    pub v_enu: DVec3,
    /// Body rate at the start, FLU, rad/s.
    pub w_flu: DVec3,
    /// What happens when it touches something.
    pub contacts: Contacts,
    /// Its surface.
    pub material: Material,
    /// The groups it is in, see [`group`]; the ground is in [`group::TERRAIN`].
    pub group: u16,
    /// The groups it collides with.
    pub mask: u16,
    /// What it counts as for those who look, whatever its groups. `None`: a [`Kind::Ghost`] if it is
    /// [`Mobility::Driven`], or else a [`Kind::Vehicle`].
    pub kind: Option<Kind>,
    /// Whether it has weight.
    pub gravity: bool,
    /// Who moves it.
    pub mobility: Mobility,
    /// Whether a ball rolls where it lies; otherwise it slides, upright, as on landing gear. Other shapes
    /// turn as contact turns them.
    pub rolls: bool,
}

impl BodySpec {
    /// A solid body of even density at rest in the origin, subject to gravity; it bounces off
    /// everything.
    #[must_use]
    pub fn new(shape: Shape, mass_kg: f64) -> Self {
        Self {
            mass_kg,
            inertia_kg_m2: shape.inertia_kg_m2(mass_kg),
            shape,
            p_enu: DVec3::ZERO,
            attitude: Attitude::default(),
            v_enu: DVec3::ZERO,
            w_flu: DVec3::ZERO,
            contacts: Contacts::Respond,
            material: Material::default(),
            group: group::BEE,
            mask: group::ALL,
            kind: None,
            gravity: true,
            mobility: Mobility::Free,
            rolls: false,
        }
    }

    /// What it counts as for those who look.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.kind.unwrap_or(match self.mobility {
            Mobility::Driven => Kind::Ghost,
            _ => Kind::Vehicle,
        })
    }

    /// Whether this can be a body.
    ///
    /// # Errors
    /// A value that is not finite or out of its range, moments of inertia that no body can have, a
    /// shape that may not move like this, or that is free and not [`centred`](Shape::centred).
    pub fn check(&self) -> Result<(), BodyError> {
        self.shape.check()?;
        let (least, most) = limits::MASS_KG_RANGE;
        error::ranged("mass [kg]", self.mass_kg, least, most)?;
        self.check_inertia()?;
        error::bounded("position [m]", self.p_enu, limits::POSITION_M_MAX)?;
        error::attitude(self.attitude)?;
        error::bounded("velocity [m/s]", self.v_enu, limits::SPEED_M_S_MAX)?;
        error::bounded("body rate [rad/s]", self.w_flu, limits::RATE_RAD_S_MAX)?;
        self.material.check()?;
        self.shape.suits(self.mobility)
    }

    fn check_inertia(&self) -> Result<(), BodyError> {
        let moments = self.inertia_kg_m2;
        for moment in moments.to_array() {
            error::ranged("moment of inertia [kg m^2]", moment, 1e-20, 1e20)?;
        }
        let sum = moments.x + moments.y + moments.z;
        let rounding = 1e-9 * sum;
        if moments
            .to_array()
            .into_iter()
            .all(|moment| 2.0 * moment <= sum + rounding)
        {
            Ok(())
        } else {
            Err(BodyError::Inertia {
                moments: moments.to_array(),
            })
        }
    }
}

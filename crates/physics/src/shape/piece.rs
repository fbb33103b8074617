//! One convex part of a form: a solid, grown by a margin, at its place in the body.
//!
//! Balls are points and capsules segments with a margin: their distances need no search, and are known
//! as well when they overlap a little.

use super::convex::{Convex, Nearest};
use super::form::{Gap, Place};
use glam::{DMat3, DQuat, DVec3};

/// One convex part of a form.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    core: Convex,
    margin: f64,
    /// Where it stands in the body, if not at its origin.
    place: Option<Place>,
    reach: f64,
    extent: f64,
}

impl Place {
    /// The origin, upright.
    pub(crate) const IDENTITY: Self = Self {
        p: DVec3::ZERO,
        q: DQuat::IDENTITY,
    };

    /// The place in the world of what stands at `inner` in this frame.
    #[inline]
    pub(crate) fn then(self, inner: Self) -> Self {
        Self {
            p: self.p + self.q * inner.p,
            q: self.q * inner.q,
        }
    }

    /// The place in this frame of what stands at `outer` in the world.
    #[inline]
    pub(crate) fn of(self, outer: Self) -> Self {
        let back = self.q.conjugate();
        Self {
            p: back * (outer.p - self.p),
            q: back * outer.q,
        }
    }
}

impl Piece {
    /// `core` grown by `margin`, standing at `place` in the body.
    pub(crate) fn new(core: Convex, margin: f64, place: Place) -> Self {
        let moved = place.p != DVec3::ZERO || place.q != DQuat::IDENTITY;
        let reach = match &core {
            Convex::Hull(hull) => hull
                .points
                .iter()
                .map(|p| (place.p + place.q * *p).length())
                .fold(0.0, f64::max),
            core => place.p.length() + core.reach(),
        };
        Self {
            extent: core.extent() + margin,
            core,
            margin,
            place: moved.then_some(place),
            reach,
        }
    }

    /// A triangle of a surface.
    pub(crate) fn triangle(corners: [DVec3; 3]) -> Self {
        let core = Convex::Triangle(corners);
        Self {
            reach: core.reach(),
            extent: core.extent(),
            core,
            margin: 0.0,
            place: None,
        }
    }

    /// The radius, of a ball about the body's origin.
    pub(crate) fn ball(&self) -> Option<f64> {
        let ball = matches!(self.core, Convex::Point) && self.place.is_none();
        ball.then_some(self.margin)
    }

    /// Distance from the body's origin to the farthest point, without the margin, m.
    #[inline]
    pub(crate) fn reach(&self) -> f64 {
        self.reach
    }

    /// How far all points lie outside of the core, m.
    #[inline]
    pub(crate) fn margin(&self) -> f64 {
        self.margin
    }

    /// About half of its size, wherever it stands, m.
    #[inline]
    pub(crate) fn extent(&self) -> f64 {
        self.extent
    }

    #[inline]
    fn stands(&self, at: Place) -> Place {
        self.place.map_or(at, |place| at.then(place))
    }

    /// The point of the core that lies farthest along a direction, from the body's origin, world axes.
    #[inline]
    pub(crate) fn support(&self, q: DQuat, direction: DVec3) -> DVec3 {
        match self.place {
            None => q * self.core.support(q.conjugate() * direction),
            Some(place) => {
                let turn = q * place.q;
                q * place.p + turn * self.core.support(turn.conjugate() * direction)
            }
        }
    }

    /// Least and greatest corner of the box about it, ENU, m.
    pub(crate) fn bounds(&self, at: Place) -> [DVec3; 2] {
        if let Convex::Block { half } = self.core {
            let Place { p, q } = self.stands(at);
            let axes = DMat3::from_quat(q);
            let reach = axes.x_axis.abs() * half.x
                + axes.y_axis.abs() * half.y
                + axes.z_axis.abs() * half.z
                + self.margin;
            return [p - reach, p + reach];
        }
        let reach = |axis: DVec3| axis.dot(self.support(at.q, axis)) + self.margin;
        let most = DVec3::new(reach(DVec3::X), reach(DVec3::Y), reach(DVec3::Z));
        let least = DVec3::new(
            reach(DVec3::NEG_X),
            reach(DVec3::NEG_Y),
            reach(DVec3::NEG_Z),
        );
        [at.p - least, at.p + most]
    }

    /// What lies between this piece and another.
    pub(crate) fn gap(&self, at: Place, other: &Self, other_at: Place) -> Gap {
        // All relative to this body: far from the world's origin nothing is lost.
        let here = self.stands(Place {
            p: DVec3::ZERO,
            q: at.q,
        });
        let there = other.stands(Place {
            p: other_at.p - at.p,
            q: other_at.q,
        });
        let (near, from) = match (&self.core, &other.core) {
            (_, Convex::Point) => {
                let p = here.q.conjugate() * (there.p - here.p);
                (self.core.nearest(p), here)
            }
            (Convex::Point, _) => {
                let p = there.q.conjugate() * (here.p - there.p);
                (other.core.nearest(p).flipped(), there)
            }
            _ => (self.core.between(&other.core, here.of(there)), here),
        };
        let normal = from.q * near.normal;
        Gap {
            distance: near.distance - self.margin - other.margin,
            normal,
            here: at.p + (from.p + from.q * near.here + normal * self.margin),
            there: at.p + (from.p + from.q * near.there - normal * other.margin),
        }
    }

    /// What lies between this piece and all below a plane through `foot` with the unit normal `up`.
    #[inline]
    pub(crate) fn gap_to_plane(&self, at: Place, foot: DVec3, up: DVec3) -> Gap {
        let arm = self.support(at.q, -up) - up * self.margin;
        let here = at.p + arm;
        let distance = (here - foot).dot(up);
        Gap {
            distance,
            normal: -up,
            here,
            there: here - up * distance,
        }
    }

    /// Where a ray of unit direction first meets it: distance and outward normal.
    pub(crate) fn cast_ray(
        &self,
        at: Place,
        from: DVec3,
        direction: DVec3,
    ) -> Option<(f64, DVec3)> {
        let ray = self.ray_from(at, from);
        let (distance, normal) = ray.cast(direction)?;
        Some((distance, ray.world(normal)))
    }

    /// Rays that begin at `from`, made ready once for many directions.
    #[inline]
    pub(crate) fn ray_from(&self, at: Place, from: DVec3) -> LocalRay<'_> {
        let stands = self.stands(Place {
            p: DVec3::ZERO,
            q: at.q,
        });
        LocalRay {
            piece: self,
            turn: stands.q,
            origin: stands.q.conjugate() * ((from - at.p) - stands.p),
        }
    }
}

/// Rays from one point, in the frame of one piece.
#[derive(Clone, Copy)]
pub(crate) struct LocalRay<'a> {
    piece: &'a Piece,
    /// From the piece's axes to the world's.
    turn: DQuat,
    origin: DVec3,
}

impl LocalRay<'_> {
    /// Where a ray of unit direction, ENU, first meets the piece: distance, and outward normal in its
    /// frame.
    #[inline]
    pub(crate) fn cast(&self, direction: DVec3) -> Option<(f64, DVec3)> {
        let Self {
            piece,
            turn,
            origin,
        } = *self;
        let direction = turn.conjugate() * direction;
        piece.core.cast_ray(piece.margin, origin, direction)
    }

    /// A direction of the piece's frame in the world, ENU.
    #[inline]
    pub(crate) fn world(&self, normal: DVec3) -> DVec3 {
        self.turn * normal
    }
}

impl Nearest {
    /// The same, seen from the other.
    fn flipped(self) -> Self {
        Self {
            distance: self.distance,
            normal: -self.normal,
            here: self.there,
            there: self.here,
        }
    }
}

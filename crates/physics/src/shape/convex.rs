//! The convex solids of which every form consists: where they reach farthest, and where they are nearest
//! to a point.

use super::convert::{from_parry, to_parry};
use super::form::Place;
use super::hull::Polytope;
use glam::{DVec2, DVec3};
use parry3d_f64::math::Vector;
use parry3d_f64::shape::SupportMap;
use std::sync::Arc;

/// A convex solid about its own origin.
#[derive(Clone, Debug)]
pub(crate) enum Convex {
    /// The origin.
    Point,
    /// From -z to +z.
    Segment { half: f64 },
    /// A block along the axes.
    Block { half: DVec3 },
    /// A cylinder along z.
    Cylinder { radius: f64, half: f64 },
    /// A cone along z, tip up, the origin half way between base and tip.
    Cone { radius: f64, half: f64 },
    /// All that lies between its corners.
    Hull(Arc<Polytope>),
    /// Three corners.
    Triangle([DVec3; 3]),
}

/// What lies between a solid and a point, or another solid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    /// Least distance; negative, the depth, inside.
    pub(crate) distance: f64,
    /// From the solid to the other, unit.
    pub(crate) normal: DVec3,
    /// The point of the solid's surface.
    pub(crate) here: DVec3,
    /// The point of the other.
    pub(crate) there: DVec3,
}

/// The farthest of some points along a direction; the origin if there are none.
fn farthest(points: &[DVec3], direction: DVec3) -> DVec3 {
    let mut best = DVec3::ZERO;
    let mut reach = f64::NEG_INFINITY;
    for point in points {
        let along = point.dot(direction);
        if along > reach {
            (best, reach) = (*point, along);
        }
    }
    best
}

/// The point of a circle about the origin that is farthest along a direction.
fn rim(direction: DVec3, radius: f64) -> DVec2 {
    let level = direction.truncate();
    let length = level.length();
    if length > 0.0 {
        level * (radius / length)
    } else {
        DVec2::ZERO
    }
}

impl Convex {
    /// The point that lies farthest along a direction of any length.
    #[inline]
    pub(crate) fn support(&self, direction: DVec3) -> DVec3 {
        match self {
            Self::Point => DVec3::ZERO,
            Self::Segment { half } => DVec3::new(0.0, 0.0, half.copysign(direction.z)),
            Self::Block { half } => DVec3::new(
                half.x.copysign(direction.x),
                half.y.copysign(direction.y),
                half.z.copysign(direction.z),
            ),
            Self::Cylinder { radius, half } => {
                rim(direction, *radius).extend(half.copysign(direction.z))
            }
            Self::Cone { radius, half } => {
                let base = rim(direction, *radius).extend(-half);
                let tip = DVec3::new(0.0, 0.0, *half);
                if base.dot(direction) > tip.dot(direction) {
                    base
                } else {
                    tip
                }
            }
            Self::Hull(hull) => farthest(&hull.points, direction),
            Self::Triangle(corners) => farthest(corners, direction),
        }
    }

    /// Distance from the origin to the farthest point.
    pub(crate) fn reach(&self) -> f64 {
        let farthest = |points: &[DVec3]| points.iter().map(|p| p.length()).fold(0.0, f64::max);
        match self {
            Self::Point => 0.0,
            Self::Segment { half } => *half,
            Self::Block { half } => half.length(),
            Self::Cylinder { radius, half } | Self::Cone { radius, half } => {
                DVec2::new(*radius, *half).length()
            }
            Self::Hull(hull) => hull.reach,
            Self::Triangle(corners) => farthest(corners),
        }
    }

    /// About half of the size.
    pub(crate) fn extent(&self) -> f64 {
        match self {
            Self::Triangle([a, b, c]) => 0.5 * (*b - *a).length().max((*c - *a).length()),
            solid => solid.reach(),
        }
    }

    /// What lies between this solid and a point.
    #[inline]
    pub(crate) fn nearest(&self, p: DVec3) -> Nearest {
        match self {
            Self::Point => outside(DVec3::ZERO, p, DVec3::Z),
            Self::Segment { half } => {
                let here = DVec3::new(0.0, 0.0, p.z.clamp(-half, *half));
                outside(here, p, DVec3::X)
            }
            Self::Block { half } => nearest_of_block(*half, p),
            Self::Cylinder { radius, half } => {
                lathe(p, |q| nearest_of_rectangle(DVec2::new(*radius, *half), q))
            }
            Self::Cone { radius, half } => lathe(p, |q| nearest_of_cone(*radius, *half, q)),
            Self::Hull(hull) => nearest_of_hull(self, hull, p),
            Self::Triangle(corners) => {
                let [a, b, c] = *corners;
                let normal = (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::Z);
                outside(nearest_of_triangle(a, b, c, p), p, normal)
            }
        }
    }
}

impl SupportMap for Convex {
    #[inline]
    fn local_support_point(&self, direction: Vector) -> Vector {
        to_parry(self.support(from_parry(direction)))
    }
}

/// From a point of a surface to a point outside; `normal` if they coincide.
#[inline]
fn outside(here: DVec3, there: DVec3, normal: DVec3) -> Nearest {
    let way = there - here;
    let distance = way.length();
    let normal = if distance > 0.0 {
        way / distance
    } else {
        normal
    };
    Nearest {
        distance,
        normal,
        here,
        there,
    }
}

#[inline]
fn nearest_of_block(half: DVec3, p: DVec3) -> Nearest {
    let here = p.clamp(-half, half);
    if here != p {
        return outside(here, p, DVec3::Z);
    }
    let depth = half - p.abs();
    let least = depth.min_element();
    let side = if depth.x == least {
        DVec3::X * p.x.signum()
    } else if depth.y == least {
        DVec3::Y * p.y.signum()
    } else {
        DVec3::Z * p.z.signum()
    };
    Nearest {
        distance: -least,
        normal: side,
        here: p + side * least,
        there: p,
    }
}

/// The nearest point of a solid of revolution about z, from that of its profile: a function of
/// (distance from the axis, z) that gives the surface point and, for a point inside, the outward
/// normal and the depth.
#[inline]
fn lathe(p: DVec3, profile: impl Fn(DVec2) -> (DVec2, DVec2, f64)) -> Nearest {
    let across = p.truncate().length();
    let radial = if across > 0.0 {
        p.truncate() / across
    } else {
        DVec2::X
    };
    let lift = |q: DVec2| (radial * q.x).extend(q.y);
    let (here, normal, depth) = profile(DVec2::new(across, p.z));
    if depth > 0.0 {
        Nearest {
            distance: -depth,
            normal: lift(normal),
            here: lift(here),
            there: p,
        }
    } else {
        outside(lift(here), p, lift(normal))
    }
}

/// The half of a rectangle right of its axis.
fn nearest_of_rectangle(half: DVec2, q: DVec2) -> (DVec2, DVec2, f64) {
    let here = q.clamp(-half, half);
    let depth = half - q.abs();
    let up = DVec2::new(0.0, 1.0_f64.copysign(q.y));
    if here != q {
        (here, up, 0.0)
    } else if depth.x < depth.y {
        (DVec2::new(half.x, q.y), DVec2::X, depth.x)
    } else {
        (DVec2::new(q.x, half.y.copysign(q.y)), up, depth.y)
    }
}

/// The half of a cone's profile right of its axis.
fn nearest_of_cone(radius: f64, half: f64, q: DVec2) -> (DVec2, DVec2, f64) {
    let rim = DVec2::new(radius, -half);
    let tip = DVec2::new(0.0, half);
    let slant = tip - rim;
    let length = slant.length();
    let normal = DVec2::new(slant.y, -slant.x) / length;
    let on_slant = rim + slant * ((q - rim).dot(slant) / (length * length)).clamp(0.0, 1.0);
    let on_base = DVec2::new(q.x.min(radius), -half);
    let (above_base, inside_slant) = (q.y + half, -(q - rim).dot(normal));
    if above_base > 0.0 && inside_slant > 0.0 {
        return if above_base < inside_slant {
            (on_base, DVec2::NEG_Y, above_base)
        } else {
            (on_slant, normal, inside_slant)
        };
    }
    if q.distance_squared(on_slant) < q.distance_squared(on_base) {
        (on_slant, normal, 0.0)
    } else {
        (on_base, DVec2::NEG_Y, 0.0)
    }
}

fn nearest_of_hull(solid: &Convex, hull: &Polytope, p: DVec3) -> Nearest {
    let mut depth = f64::NEG_INFINITY;
    let mut normal = DVec3::Z;
    for (side, offset) in &hull.planes {
        let height = side.dot(p) - offset;
        if height > depth {
            (depth, normal) = (height, *side);
        }
    }
    if depth > 0.0 {
        let there = Place {
            p,
            q: glam::DQuat::IDENTITY,
        };
        let found = solid.between(&Convex::Point, there);
        if found.distance > 0.0 {
            return found;
        }
    }
    Nearest {
        distance: depth,
        normal,
        here: p - normal * depth,
        there: p,
    }
}

/// The point of a triangle that is nearest to `p` (Ericson, Real-Time Collision Detection, 5.1.5).
pub(crate) fn nearest_of_triangle(a: DVec3, b: DVec3, c: DVec3, p: DVec3) -> DVec3 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    let (along, back) = (d4 - d3, d5 - d6);
    if va <= 0.0 && along >= 0.0 && back >= 0.0 {
        return b + (c - b) * (along / (along + back));
    }
    let sum = va + vb + vc;
    a + ab * (vb / sum) + ac * (vc / sum)
}

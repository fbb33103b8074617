//! What lies between two convex solids: the direction in which they are farthest apart.
//!
//! Along a unit direction `n` two solids are apart by
//!
//! ```text
//! s(n) = min over B of n.y - max over A of n.x                                            (1)
//! ```
//!
//! If they are apart, the greatest `s` is their distance; if they overlap, it is negative, and the least
//! way along which one can be moved out of the other. Every `s(n)` is a bound from below, whatever
//! search found `n`, and that is what is returned.
//!
//! The search by Gilbert, Johnson and Keerthi (parry's) finds `n` to full precision if the distance is
//! not small against the solids. If it is, or they overlap, one of the two is moved away by a known way
//! along the best direction so far, and the search repeated: that is a proximal step for the greatest
//! `s`, which climbs to it from either side of touch, and in a step or two if the solids have faces.

use super::convert::{from_parry, to_parry, to_pose};
use super::convex::{Convex, Nearest};
use super::form::Place;
use glam::{DQuat, DVec3};
use parry3d_f64::query::details::closest_points_support_map_support_map_with_params as search;
use parry3d_f64::query::gjk::{GJKResult, VoronoiSimplex};

/// How far the solids are moved apart for the search, over their size.
const SHIFT: f64 = 0.05;
/// The same, at the end.
const SHIFT_MIN: f64 = 1e-3;
/// Difference of bounds, over the size, below which a distance is good.
const PRECISION: f64 = 1e-10;
/// The same, over the distance.
const PRECISION_RELATIVE: f64 = 1e-7;
/// Most repetitions of the search.
const STEPS_MAX: usize = 16;

/// Two solids, the second at a place in the first's frame.
struct Pair<'a> {
    a: &'a Convex,
    b: &'a Convex,
    place: Place,
    back: DQuat,
}

impl Pair<'_> {
    /// Equation (1), with the two points.
    #[inline]
    fn along(&self, normal: DVec3) -> Nearest {
        let here = self.a.support(normal);
        let there = self.place.p + self.place.q * self.b.support(self.back * -normal);
        Nearest {
            distance: normal.dot(there - here),
            normal,
            here,
            there,
        }
    }

    /// The nearest points when the second is moved by `shift`, and their distance; none if it overlaps
    /// the first there.
    fn search(&self, shift: DVec3, towards: DVec3) -> Option<Nearest> {
        let pose = to_pose(Place {
            p: self.place.p + shift,
            q: self.place.q,
        });
        let mut simplex = VoronoiSimplex::new();
        let start = Some(to_parry(towards));
        let found = search(&pose, self.a, self.b, f64::MAX, &mut simplex, start);
        let GJKResult::ClosestPoints(here, there, _) = found else {
            return None;
        };
        let (here, there) = (from_parry(here), from_parry(there));
        let way = there - here;
        let distance = way.length();
        (distance > 0.0).then(|| Nearest {
            distance,
            normal: way / distance,
            here,
            there,
        })
    }

    /// The best of some directions to begin with when the solids overlap: those of their faces, and
    /// that between their origins.
    fn first(&self) -> Nearest {
        let mut best = self.along(self.place.p.try_normalize().unwrap_or(DVec3::Z));
        let mut keep = |normal: DVec3| {
            let found = self.along(normal);
            if found.distance > best.distance {
                best = found;
            }
        };
        let towards_b = self.place.p;
        let towards_a = self.back * -self.place.p;
        self.a.faces(towards_b, &mut keep);
        self.b
            .faces(towards_a, &mut |normal| keep(self.place.q * -normal));
        best
    }

    /// Climbs from a direction to the greatest separation nearby.
    fn climb(&self, mut best: Nearest, size: f64) -> Nearest {
        let mut factor = SHIFT;
        for _ in 0..STEPS_MAX {
            let shift = best.normal * (factor * size - best.distance.min(0.0));
            let Some(found) = self.search(shift, best.normal) else {
                factor *= 4.0;
                continue;
            };
            let along = self.along(found.normal);
            let gain = along.distance - best.distance;
            if gain > 0.0 {
                best = Nearest {
                    distance: along.distance,
                    normal: found.normal,
                    here: found.here,
                    there: found.there - shift,
                };
            } else if gain > -PRECISION * size {
                // The direction of a face is known from the start; the points are not.
                (best.here, best.there) = (found.here, found.there - shift);
            }
            if gain <= PRECISION * size {
                if factor <= SHIFT_MIN {
                    break;
                }
                // A nearer start for the search: less precise, but a longer step.
                factor *= 0.1;
            }
        }
        best
    }
}

impl Convex {
    /// Directions in which this solid is flat or nearly so, as candidates for contact with something
    /// at `other`.
    fn faces(&self, other: DVec3, keep: &mut dyn FnMut(DVec3)) {
        let side = other.with_z(0.0).try_normalize().unwrap_or(DVec3::X);
        match self {
            Self::Point => {}
            Self::Segment { .. } => keep(side),
            Self::Block { .. } => [DVec3::X, DVec3::Y, DVec3::Z]
                .into_iter()
                .for_each(|axis| keep(axis * other.dot(axis).signum())),
            Self::Cylinder { .. } => {
                keep(side);
                keep(DVec3::Z * other.z.signum());
            }
            Self::Cone { radius, half } => {
                keep(DVec3::NEG_Z);
                keep((side * (2.0 * half) + DVec3::Z * *radius).normalize());
            }
            Self::Hull(hull) => hull.planes.iter().for_each(|(normal, _)| keep(*normal)),
            Self::Triangle([a, b, c]) => {
                if let Some(normal) = (*b - *a).cross(*c - *a).try_normalize() {
                    keep(normal);
                    keep(-normal);
                }
            }
        }
    }

    /// What lies between this solid and `other`, which stands at `place` in this one's frame.
    pub(crate) fn between(&self, other: &Self, place: Place) -> Nearest {
        let pair = Pair {
            a: self,
            b: other,
            place,
            back: place.q.conjugate(),
        };
        let size = self.reach() + other.reach();
        let towards = place.p.try_normalize().unwrap_or(DVec3::Z);
        let start = match pair.search(DVec3::ZERO, towards) {
            Some(found) => {
                let low = pair.along(found.normal).distance;
                let doubt = found.distance - low;
                if doubt <= PRECISION * size || doubt <= PRECISION_RELATIVE * found.distance {
                    return Nearest {
                        distance: low,
                        ..found
                    };
                }
                Nearest {
                    distance: low,
                    ..found
                }
            }
            None => pair.first(),
        };
        pair.climb(start, size)
    }
}

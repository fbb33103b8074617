//! A shape made ready for queries.

use super::collider::collider;
use super::convex::Convex;
use super::hull::hull;
use super::piece::Piece;
use super::soup::{Bounds, Soup, Source, turned};
use super::{Part, Shape};
use crate::approach::reaches;
use crate::error::BodyError;
use glam::{DQuat, DVec3};
use parry3d_f64::math::Pose as ParryPose;
use parry3d_f64::shape::SharedShape;
use std::fmt;
use std::sync::{Arc, OnceLock};

/// Where a body stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Its origin, ENU, m.
    pub(crate) p: DVec3,
    /// `world_from_body`.
    pub(crate) q: DQuat,
}

/// What lies between two forms.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    /// Least distance, m; where they overlap, the depth, negative.
    pub(crate) distance: f64,
    /// From the first to the second, unit, ENU: the normal of a plane between them.
    pub(crate) normal: DVec3,
    /// The point of the first that is nearest to the second, ENU, m.
    pub(crate) here: DVec3,
    /// The point of the second that is nearest to the first, ENU, m.
    pub(crate) there: DVec3,
}

impl Gap {
    /// The same, seen from the second.
    pub(crate) fn flipped(self) -> Self {
        Self {
            distance: self.distance,
            normal: -self.normal,
            here: self.there,
            there: self.here,
        }
    }
}

/// What a form consists of.
#[derive(Debug)]
pub(crate) enum Solid {
    /// All below the body's xy plane.
    Plane,
    /// One convex piece.
    One(Piece),
    /// Several; the gap to them is that to the nearest.
    Many(Soup),
}

/// A shape made ready for queries: made once, shared by all bodies of that shape.
pub(crate) struct Form {
    solid: Solid,
    radius: f64,
    shape: Shape,
    free: bool,
    collider: OnceLock<(SharedShape, ParryPose)>,
}

impl fmt::Debug for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Form").field(&self.shape).finish()
    }
}

/// The one piece of a simple shape; none for a shape of many, or a plane.
fn piece(shape: &Shape, free: bool, place: Place) -> Result<Option<Piece>, BodyError> {
    let solid = |points: &[DVec3]| {
        hull(points)
            .map(|hull| Convex::Hull(Arc::new(hull)))
            .ok_or(BodyError::Flat {
                shape: shape.name(),
            })
    };
    let (core, margin) = match shape {
        Shape::Sphere { radius_m } => (Convex::Point, *radius_m),
        Shape::Box { half_m } => (Convex::Block { half: *half_m }, 0.0),
        Shape::Cylinder {
            radius_m: radius,
            half_height_m: half,
        } => {
            let (radius, half) = (*radius, *half);
            (Convex::Cylinder { radius, half }, 0.0)
        }
        Shape::Cone {
            radius_m: radius,
            half_height_m: half,
        } => {
            let (radius, half) = (*radius, *half);
            (Convex::Cone { radius, half }, 0.0)
        }
        Shape::Capsule {
            radius_m,
            half_height_m: half,
        } => (Convex::Segment { half: *half }, *radius_m),
        Shape::Hull(hull) => (solid(&hull.points_m)?, 0.0),
        Shape::Mesh(mesh) if free => (solid(&mesh.points_m)?, 0.0),
        _ => return Ok(None),
    };
    Ok(Some(Piece::new(core, margin, place)))
}

/// Appends the pieces of all parts.
fn pieces(parts: &[Part], at: Place, free: bool, found: &mut Vec<Piece>) -> Result<(), BodyError> {
    for part in parts {
        let place = at.then(part.place());
        let mut triangle = |corners: [DVec3; 3]| {
            let corners = corners.map(|corner| place.p + place.q * corner);
            found.push(Piece::triangle(corners));
        };
        match &part.shape {
            Shape::Compound(parts) => pieces(parts, place, free, found)?,
            Shape::Mesh(mesh) if !free => {
                for corners in &mesh.triangles {
                    triangle(mesh.corners(*corners));
                }
            }
            Shape::HeightField(field) => field.cells().flatten().for_each(triangle),
            shape => found.extend(piece(shape, free, place)?),
        }
    }
    Ok(())
}

impl Form {
    /// The form of a checked shape. `free`: it belongs to a body that moves freely, so that a mesh
    /// counts as its convex hull.
    pub(crate) fn new(shape: &Shape, free: bool) -> Result<Self, BodyError> {
        let solid = match shape {
            Shape::Plane => Solid::Plane,
            Shape::Mesh(mesh) if !free => Solid::Many(Soup::new(Source::Mesh(mesh.clone()))),
            Shape::HeightField(field) => Solid::Many(Soup::new(Source::Field(field.clone()))),
            Shape::Compound(parts) => {
                let mut found = Vec::new();
                pieces(parts, Place::IDENTITY, free, &mut found)?;
                match <[Piece; 1]>::try_from(found) {
                    Ok([one]) => Solid::One(one),
                    Err(several) => Solid::Many(Soup::new(Source::Pieces(several))),
                }
            }
            shape => match piece(shape, free, Place::IDENTITY)? {
                Some(one) => Solid::One(one),
                None => Solid::Plane,
            },
        };
        Ok(Self {
            solid,
            radius: shape.bounding_radius_m(),
            shape: shape.clone(),
            free,
            collider: OnceLock::new(),
        })
    }

    /// The radius, of a ball about the origin.
    #[inline]
    pub(crate) fn ball(&self) -> Option<f64> {
        match &self.solid {
            Solid::One(piece) => piece.ball(),
            _ => None,
        }
    }

    /// Radius of the bounding ball about the origin, m.
    #[inline]
    pub(crate) fn radius(&self) -> f64 {
        self.radius
    }

    /// What it consists of.
    #[inline]
    pub(crate) fn solid(&self) -> &Solid {
        &self.solid
    }

    /// A box along the world's axes that holds the form: least and greatest corner, ENU, m. The least
    /// such box, of a convex form.
    pub(crate) fn bounds(&self, at: Place) -> Bounds {
        match &self.solid {
            Solid::Plane => [DVec3::NEG_INFINITY, DVec3::INFINITY],
            Solid::One(piece) => piece.bounds(at),
            Solid::Many(soup) => turned(at, soup.bounds()),
        }
    }

    /// What lies between this form and another.
    pub(crate) fn gap(&self, at: Place, other: &Self, other_at: Place) -> Gap {
        match (&self.solid, &other.solid) {
            (Solid::One(here), Solid::One(there)) => here.gap(at, there, other_at),
            (_, Solid::One(there)) => self.gap_to_piece(at, there, other_at),
            (_, Solid::Plane) => self.gap_to_plane(at, other_at.p, other_at.q * DVec3::Z),
            (Solid::Plane, _) => other
                .gap_to_plane(other_at, at.p, at.q * DVec3::Z)
                .flipped(),
            (_, Solid::Many(soup)) => {
                let bounds = self.bounds(other_at.of(at));
                let gap = |there: &Piece| self.gap_to_piece(at, there, other_at).flipped();
                let least = soup.least(bounds, gap);
                least.map_or_else(|| nothing(at, other_at), Gap::flipped)
            }
        }
    }

    /// What lies between this form and one piece of another.
    fn gap_to_piece(&self, at: Place, there: &Piece, there_at: Place) -> Gap {
        match &self.solid {
            Solid::Plane => there
                .gap_to_plane(there_at, at.p, at.q * DVec3::Z)
                .flipped(),
            Solid::One(here) => here.gap(at, there, there_at),
            Solid::Many(soup) => {
                let bounds = there.bounds(at.of(there_at));
                let gap = |here: &Piece| here.gap(at, there, there_at);
                soup.least(bounds, gap)
                    .unwrap_or_else(|| nothing(at, there_at))
            }
        }
    }

    /// What lies between this form and all below a plane through `foot` with the unit normal `up`.
    pub(crate) fn gap_to_plane(&self, at: Place, foot: DVec3, up: DVec3) -> Gap {
        match &self.solid {
            Solid::Plane => nothing(at, Place { p: foot, ..at }),
            Solid::One(piece) => piece.gap_to_plane(at, foot, up),
            Solid::Many(soup) => {
                let mut least: Option<Gap> = None;
                soup.each(&mut |piece| {
                    let gap = piece.gap_to_plane(at, foot, up);
                    if least.is_none_or(|least| gap.distance < least.distance) {
                        least = Some(gap);
                    }
                });
                least.unwrap_or_else(|| nothing(at, Place { p: foot, ..at }))
            }
        }
    }

    /// What lies between this form and the ground, the plane at up = 0.
    #[inline]
    pub(crate) fn gap_to_ground(&self, at: Place) -> Gap {
        self.gap_to_plane(at, DVec3::ZERO, DVec3::Z)
    }

    /// Where a ray of unit direction first meets the form within `max_m`: distance, and the surface's
    /// outward normal, ENU. A ray that begins inside meets it at once, head on.
    pub(crate) fn cast_ray(
        &self,
        at: Place,
        from: DVec3,
        direction: DVec3,
        max_m: f64,
    ) -> Option<(f64, DVec3)> {
        let hit = match &self.solid {
            Solid::Plane => {
                let up = at.q * DVec3::Z;
                let height = (from - at.p).dot(up);
                let sink = -direction.dot(up);
                if height <= 0.0 {
                    Some((0.0, -direction))
                } else {
                    (sink > 0.0).then(|| (height / sink, up))
                }
            }
            Solid::One(piece) => piece.cast_ray(at, from, direction),
            Solid::Many(soup) => {
                let back = at.q.conjugate();
                soup.cast_ray(back * (from - at.p), back * direction, max_m)
                    .map(|(distance, normal)| (distance, at.q * normal))
            }
        };
        hit.filter(|(distance, _)| *distance <= max_m)
    }

    /// Where `other`, moved from `other_at` along a unit direction, first meets this form within `max_m`:
    /// the distance, and the gap at that place. If they overlap from the start, they meet there.
    pub(crate) fn cast_form(
        &self,
        at: Place,
        other: &Self,
        other_at: Place,
        direction: DVec3,
        max_m: f64,
    ) -> Option<(f64, Gap)> {
        let begin = self.gap(at, other, other_at);
        if begin.distance <= 0.0 {
            return Some((0.0, begin));
        }
        let way = reaches(self, at, other, other_at, direction, max_m)?;
        let p = other_at.p + direction * way;
        Some((way, self.gap(at, other, Place { p, ..other_at })))
    }

    /// The collider for rapier, and its pose in the body; made at the first call.
    pub(crate) fn shared(&self) -> (&SharedShape, ParryPose) {
        let (shape, pose) = self
            .collider
            .get_or_init(|| collider(&self.shape, self.free));
        (shape, *pose)
    }
}

/// The gap between forms of which one has no points.
fn nothing(at: Place, other_at: Place) -> Gap {
    Gap {
        distance: f64::INFINITY,
        normal: DVec3::Z,
        here: at.p,
        there: other_at.p,
    }
}

#[cfg(test)]
mod tests {
    use super::{Form, Place, Solid};
    use crate::shape::convert::to_parry;
    use crate::shape::{HeightField, Hull, Part, Shape};
    use glam::{DQuat, DVec2, DVec3};
    use parry3d_f64::query::Ray;
    use simbeeotic_kernel::Stream;
    use simbeeotic_units::Attitude;
    use std::sync::Arc;

    fn turn(stream: &mut Stream) -> DQuat {
        crate::rotation::turn_by(stream.in_ball(3.0))
    }

    /// One of the convex shapes, of a size about 1 m.
    fn convex(stream: &mut Stream) -> Shape {
        let mut size = || 0.1 + stream.uniform();
        let (radius_m, half_height_m) = (size(), size());
        let half_m = DVec3::new(size(), size(), size());
        match stream.below(6) {
            0 => Shape::Sphere { radius_m },
            1 => Shape::Box { half_m },
            2 => Shape::Cylinder {
                radius_m,
                half_height_m,
            },
            3 => Shape::Cone {
                radius_m,
                half_height_m,
            },
            4 => Shape::Capsule {
                radius_m,
                half_height_m,
            },
            _ => Shape::Hull(Arc::new(Hull {
                points_m: (0..12).map(|_| stream.in_ball(1.0)).collect(),
            })),
        }
    }

    /// Two places for two convex shapes, the second straight out of the first's reach, and how far it can
    /// come back before they touch.
    fn pair(stream: &mut Stream) -> Option<(Form, Form, Place, Place, DVec3, f64)> {
        let [a, b] = [convex(stream), convex(stream)].map(|s| Form::new(&s, true).unwrap());
        let at = Place {
            p: stream.in_ball(1.0),
            q: turn(stream),
        };
        let out = stream.unit_vector();
        let far = Place {
            p: at.p + out * 5.0,
            q: turn(stream),
        };
        let (way, _) = a.cast_form(at, &b, far, -out, 10.0)?;
        Some((a, b, at, far, -out, way))
    }

    #[test]
    fn a_gap_is_what_lies_between_two_planes_across_its_normal() {
        let mut stream = Stream::new(1, "gaps", "test");
        for _ in 0..3000 {
            let Some((a, b, at, far, back, way)) = pair(&mut stream) else {
                continue;
            };
            let (Solid::One(here), Solid::One(there)) = (a.solid(), b.solid()) else {
                panic!("convex shapes are one piece");
            };
            for left in [1.0, 1e-2, 1e-4, 1e-6, 1e-8, 0.0] {
                let place = Place {
                    p: far.p + back * (way - left),
                    q: far.q,
                };
                let gap = a.gap(at, &b, place);
                let n = gap.normal;
                let low = at.p + here.support(at.q, n) + n * here.margin();
                let high = place.p + there.support(place.q, -n) - n * there.margin();
                assert!((n.length() - 1.0).abs() < 1e-12);
                assert!((n.dot(high - low) - gap.distance).abs() < 1e-12);
                // As far as the one may still come along any direction, and no farther.
                assert!(
                    gap.distance <= left + 1e-7 && gap.distance > -1e-6,
                    "{left} {gap:?} {a:?} {b:?}"
                );
                let same = b.gap(place, &a, at);
                assert!(
                    (same.distance - gap.distance).abs() < 1e-6 * (1.0 + left),
                    "{gap:?} {same:?}"
                );
            }
        }
    }

    #[test]
    fn a_compound_is_as_near_as_the_nearest_of_its_parts() {
        let mut stream = Stream::new(1, "compounds", "test");
        for _ in 0..300 {
            let parts: Vec<_> = (0..5)
                .map(|_| Part {
                    offset_m: stream.in_ball(2.0),
                    attitude: Attitude::from_unit_quat(turn(&mut stream)),
                    shape: convex(&mut stream),
                })
                .collect();
            let other = Form::new(&convex(&mut stream), true).unwrap();
            let at = Place {
                p: stream.in_ball(3.0),
                q: turn(&mut stream),
            };
            let other_at = Place {
                p: stream.in_ball(6.0),
                q: turn(&mut stream),
            };
            let part = |part: &Part| {
                let form = Form::new(&part.shape, true).unwrap();
                form.gap(at.then(part.place()), &other, other_at).distance
            };
            let least = parts.iter().map(part).fold(f64::INFINITY, f64::min);
            let compound = Form::new(&Shape::Compound(parts.into()), true).unwrap();
            for gap in [
                compound.gap(at, &other, other_at),
                other.gap(other_at, &compound, at).flipped(),
            ] {
                assert!((gap.distance - least).abs() < 1e-6, "{gap:?} {least}");
            }
        }
    }

    #[test]
    fn colliders_have_the_same_outline() {
        let mut stream = Stream::new(1, "colliders", "test");
        let heights_m = (0..30).map(|_| stream.uniform()).collect();
        let field = Shape::HeightField(Arc::new(HeightField {
            size_m: DVec2::new(3.0, 2.0),
            columns: 6,
            heights_m,
        }));
        let mut forms: Vec<_> = (0..200)
            .map(|_| Form::new(&convex(&mut stream), true).unwrap())
            .collect();
        forms.push(Form::new(&field, false).unwrap());
        for form in &forms {
            for _ in 0..50 {
                let from = stream.unit_vector() * 4.0;
                let direction = (stream.in_ball(1.0) - from).normalize();
                let ours = form.cast_ray(Place::IDENTITY, from, direction, 20.0);
                let (shape, pose) = form.shared();
                let ray = Ray::new(to_parry(from), to_parry(direction));
                let theirs = shape.cast_ray(&pose, &ray, 20.0, true);
                if let (Some((ours, _)), Some(theirs)) = (ours, theirs) {
                    assert!((ours - theirs).abs() < 1e-3, "{form:?} {ours} {theirs}");
                }
            }
        }
    }
}

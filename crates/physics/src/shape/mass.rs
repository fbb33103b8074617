//! Centre of mass and moments of inertia of solids of even density.
//!
//! Closed forms for the simple shapes. A closed surface of triangles is the sum of the tetrahedra between
//! each triangle and the origin, with the signs of their volumes; a compound is the sum of its parts,
//! each moved by Steiner's theorem, where overlaps count twice.

use super::form::Place;
use super::hull::hull;
use super::{Part, Shape};
use crate::shape::convert::{from_parry, from_rotation};
use glam::{DMat3, DQuat, DVec3};
use parry3d_f64::math::{Matrix, Rotation, SymmetricEigen, Vector};
use simbeeotic_units::{Attitude, Pose, Position};
use std::sync::Arc;

/// How the mass of a body is distributed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// The centre of mass, in the shape's frame, m.
    pub centre_m: DVec3,
    /// Moments of inertia about the principal axes through the centre of mass, kg m^2.
    pub moments_kg_m2: DVec3,
    /// How the principal axes lie: from them to the shape's axes.
    pub axes: Attitude,
}

/// Off-diagonal terms below this, over the trace, are rounding: the axes are principal already.
const DIAGONAL: f64 = 1e-9;

/// A solid of density 1.
#[derive(Clone, Copy)]
struct Bulk {
    volume: f64,
    centre: DVec3,
    /// Tensor of inertia about the centre.
    inertia: DMat3,
}

/// The tensor of inertia of a unit mass at `r`, about the origin.
fn steiner(r: DVec3) -> DMat3 {
    DMat3::from_diagonal(DVec3::splat(r.length_squared())) - outer(r, r)
}

fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

fn square(x: f64) -> f64 {
    x * x
}

impl Bulk {
    /// One whose centre is at `centre` and whose axes are principal; moments over the volume.
    fn even(volume: f64, centre: DVec3, moments: DVec3) -> Self {
        Self {
            volume,
            centre,
            inertia: DMat3::from_diagonal(moments * volume),
        }
    }

    fn at(self, place: Place) -> Self {
        let turn = DMat3::from_quat(place.q);
        Self {
            volume: self.volume,
            centre: place.p + place.q * self.centre,
            inertia: turn * self.inertia * turn.transpose(),
        }
    }

    fn sum(parts: &[Self]) -> Option<Self> {
        let volume: f64 = parts.iter().map(|part| part.volume).sum();
        let weigh = |part: &Self| part.centre * (part.volume / volume);
        let centre: DVec3 = parts.iter().map(weigh).sum();
        let about = |part: &Self| part.inertia + steiner(part.centre - centre) * part.volume;
        let inertia = parts
            .iter()
            .map(about)
            .fold(DMat3::ZERO, |sum, inertia| sum + inertia);
        (volume > 0.0).then_some(Self {
            volume,
            centre,
            inertia,
        })
    }

    /// What lies between triangles that form a closed surface.
    fn within(triangles: impl Iterator<Item = [DVec3; 3]> + Clone) -> Option<Self> {
        let (mut sixfold, mut moment) = (0.0, DVec3::ZERO);
        // About a point of the surface, so that nothing is lost far from the origin.
        let origin = triangles.clone().next()?[0];
        let relative = || triangles.clone().map(|corners| corners.map(|c| c - origin));
        for [a, b, c] in relative() {
            let volume = a.dot(b.cross(c));
            sixfold += volume;
            moment += (a + b + c) * volume;
        }
        let volume = sixfold / 6.0;
        let centre = moment / (4.0 * sixfold);
        let mut second = DMat3::ZERO;
        for corners in relative() {
            let [a, b, c] = corners.map(|corner| corner - centre);
            let own = a.dot(b.cross(c));
            let sum = a + b + c;
            second += (outer(a, a) + outer(b, b) + outer(c, c) + outer(sum, sum)) * (own / 120.0);
        }
        // The tetrahedra about the centre have the same sum as those about the origin.
        let trace = second.x_axis.x + second.y_axis.y + second.z_axis.z;
        let inertia = DMat3::from_diagonal(DVec3::splat(trace)) - second;
        (volume > 0.0 && centre.is_finite()).then_some(Self {
            volume,
            centre: origin + centre,
            inertia,
        })
    }
}

/// Whether every edge of some triangles belongs to just two, which pass it in opposite directions.
fn is_closed(triangles: &[[u32; 3]]) -> bool {
    let mut edges: Vec<(u32, u32)> = triangles
        .iter()
        .flat_map(|[a, b, c]| [(*a, *b), (*b, *c), (*c, *a)])
        .collect();
    edges.sort_unstable();
    let unique = edges.windows(2).all(|pair| pair[0] != pair[1]);
    let paired = |(from, to): &(u32, u32)| edges.binary_search(&(*to, *from)).is_ok();
    !edges.is_empty() && unique && edges.iter().all(paired)
}

fn bulk_of_hull(points: &[DVec3]) -> Option<Bulk> {
    let hull = hull(points)?;
    let corners = |triangle: &[u32; 3]| triangle.map(|k| hull.points[k as usize]);
    Bulk::within(hull.triangles.iter().map(corners))
}

fn bulk(shape: &Shape) -> Option<Bulk> {
    use std::f64::consts::PI;
    match shape {
        Shape::Sphere { radius_m: r } => Some(Bulk::even(
            4.0 / 3.0 * PI * r * r * r,
            DVec3::ZERO,
            DVec3::splat(0.4 * r * r),
        )),
        Shape::Box { half_m } => {
            let s = *half_m * *half_m;
            let moments = DVec3::new(s.y + s.z, s.z + s.x, s.x + s.y) / 3.0;
            let volume = 8.0 * half_m.x * half_m.y * half_m.z;
            Some(Bulk::even(volume, DVec3::ZERO, moments))
        }
        Shape::Cylinder {
            radius_m: r,
            half_height_m: h,
        } => {
            let across = r * r / 4.0 + h * h / 3.0;
            let moments = DVec3::new(across, across, r * r / 2.0);
            Some(Bulk::even(2.0 * PI * r * r * h, DVec3::ZERO, moments))
        }
        Shape::Cone {
            radius_m: r,
            half_height_m: h,
        } => {
            let across = 3.0 / 20.0 * (r * r + h * h);
            let moments = DVec3::new(across, across, 0.3 * r * r);
            let volume = 2.0 / 3.0 * PI * r * r * h;
            Some(Bulk::even(volume, DVec3::NEG_Z * (0.5 * h), moments))
        }
        Shape::Capsule {
            radius_m: r,
            half_height_m: h,
        } => {
            let (pipe, caps) = (2.0 * PI * r * r * h, 4.0 / 3.0 * PI * r * r * r);
            // A half ball's centre of mass lies 3/8 r above its base.
            let cap_across = 0.4 * r * r - square(3.0 / 8.0 * r) + square(h + 3.0 / 8.0 * r);
            let across = pipe * (r * r / 4.0 + h * h / 3.0) + caps * cap_across;
            let along = pipe * r * r / 2.0 + caps * 0.4 * r * r;
            let volume = pipe + caps;
            let moments = DVec3::new(across, across, along) / volume;
            Some(Bulk::even(volume, DVec3::ZERO, moments))
        }
        Shape::Hull(hull) => bulk_of_hull(&hull.points_m),
        Shape::Mesh(mesh) => {
            let corners = |triangle: &[u32; 3]| mesh.corners(*triangle);
            is_closed(&mesh.triangles)
                .then(|| Bulk::within(mesh.triangles.iter().map(corners)))
                .flatten()
        }
        Shape::Compound(parts) => {
            let part = |part: &Part| bulk(&part.shape).map(|bulk| bulk.at(part.place()));
            Bulk::sum(&parts.iter().map(part).collect::<Option<Vec<_>>>()?)
        }
        Shape::Plane | Shape::HeightField(_) => None,
    }
}

/// Principal moments of a tensor, and the rotation from the principal axes.
fn principal(inertia: DMat3) -> (DVec3, DQuat) {
    let (x, y, z) = (inertia.x_axis, inertia.y_axis, inertia.z_axis);
    let diagonal = DVec3::new(x.x, y.y, z.z);
    let off = x.y.abs().max(x.z.abs()).max(y.z.abs());
    if off <= DIAGONAL * diagonal.element_sum() {
        return (diagonal, DQuat::IDENTITY);
    }
    let column = |v: DVec3| Vector::new(v.x, v.y, v.z);
    let scale = diagonal.element_sum();
    let matrix = Matrix::from_cols(column(x / scale), column(y / scale), column(z / scale));
    let eigen = SymmetricEigen::new(matrix);
    let mut axes = eigen.eigenvectors;
    if axes.determinant() < 0.0 {
        axes.z_axis = -axes.z_axis;
    }
    let turn = from_rotation(Rotation::from_mat3(&axes)).normalize();
    (from_parry(eigen.eigenvalues) * scale, turn)
}

impl Shape {
    /// Centre of mass and moments of inertia of a solid of even density; none for what has no inside: a
    /// plane, a height field, a mesh that is not closed. Where parts of a compound overlap, both count.
    #[must_use]
    pub fn mass_properties(&self, mass_kg: f64) -> Option<MassProperties> {
        let bulk = bulk(self)?;
        let (moments, turn) = principal(bulk.inertia * (mass_kg / bulk.volume));
        Some(MassProperties {
            centre_m: bulk.centre,
            moments_kg_m2: moments,
            axes: Attitude::from_unit_quat(turn),
        })
    }

    /// Moments of inertia about the body axes through the origin, of a solid of even density, kg m^2. For
    /// what has no inside, those of its convex hull or, if it has none, of a ball as large as its bounding
    /// ball (of 1 m, for a plane).
    #[must_use]
    pub fn inertia_kg_m2(&self, mass_kg: f64) -> DVec3 {
        let solid = bulk(self).or_else(|| match self {
            Self::Mesh(mesh) => bulk_of_hull(&mesh.points_m),
            _ => None,
        });
        let radius = self.bounding_radius_m();
        match solid {
            Some(bulk) => {
                let about = bulk.inertia * (1.0 / bulk.volume) + steiner(bulk.centre);
                DVec3::new(about.x_axis.x, about.y_axis.y, about.z_axis.z) * mass_kg
            }
            None if radius.is_finite() => DVec3::splat(0.4 * mass_kg * radius * radius),
            None => DVec3::splat(0.4 * mass_kg),
        }
    }

    /// The same solid with its centre of mass at the origin and its principal axes along x, y and z, and
    /// where that frame lies in the old one. What has no inside stays as it is.
    ///
    /// ```
    /// use simbeeotic_physics::{BodySpec, Shape};
    ///
    /// let cone = Shape::Cone { radius_m: 0.1, half_height_m: 0.2 };
    /// assert!(BodySpec::new(cone.clone(), 1.0).check().is_err());
    /// let (cone, pose) = cone.centred();
    /// assert!(BodySpec::new(cone, 1.0).check().is_ok());
    /// assert!((pose.position.si().z + 0.1).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn centred(self) -> (Self, Pose) {
        let solid = match &self {
            Self::Mesh(mesh) => bulk(&self).or_else(|| bulk_of_hull(&mesh.points_m)),
            shape => bulk(shape),
        };
        let Some(bulk) = solid else {
            return (self, Pose::IDENTITY);
        };
        let (_, turn) = principal(bulk.inertia * (1.0 / bulk.volume));
        let attitude = Attitude::from_unit_quat(turn);
        let pose = Pose::new(Position::from_si(bulk.centre), attitude);
        if bulk.centre == DVec3::ZERO && turn == DQuat::IDENTITY {
            return (self, pose);
        }
        let back = turn.conjugate();
        let move_all = |points: &mut Vec<DVec3>| {
            for point in points {
                *point = back * (*point - bulk.centre);
            }
        };
        let moved = match self {
            Self::Hull(mut hull) => {
                move_all(&mut Arc::make_mut(&mut hull).points_m);
                Self::Hull(hull)
            }
            Self::Mesh(mut mesh) => {
                move_all(&mut Arc::make_mut(&mut mesh).points_m);
                Self::Mesh(mesh)
            }
            shape => {
                let offset_m = back * -bulk.centre;
                let moved = |part: &Part| Part {
                    offset_m: offset_m + back * part.offset_m,
                    attitude: Attitude::from_unit_quat(back * part.attitude.quat()),
                    shape: part.shape.clone(),
                };
                let whole = || Part {
                    offset_m,
                    attitude: Attitude::from_unit_quat(back),
                    shape: shape.clone(),
                };
                match &shape {
                    Self::Compound(parts) => Self::Compound(parts.iter().map(moved).collect()),
                    _ => Self::Compound([whole()].into()),
                }
            }
        };
        (moved, pose)
    }
}

#[cfg(test)]
mod tests {
    use crate::shape::{Hull, Mesh, Part, Shape};
    use glam::DVec3;
    use simbeeotic_units::Attitude;
    use std::sync::Arc;

    fn corners(h: DVec3, at: DVec3) -> Vec<DVec3> {
        let side = |k: i32, bit: i32| if k & bit == 0 { -1.0 } else { 1.0 };
        (0..8)
            .map(|k| at + h * DVec3::new(side(k, 1), side(k, 2), side(k, 4)))
            .collect()
    }

    fn assert_near(a: DVec3, b: DVec3) {
        assert!(
            a.distance(b) < 1e-12 * (1.0 + b.length()),
            "{a} instead of {b}"
        );
    }

    #[test]
    fn closed_forms() {
        let (radius_m, half_height_m) = (0.3, 0.5);
        let of = |shape: Shape| shape.mass_properties(2.0).unwrap();
        let sphere = of(Shape::Sphere { radius_m });
        assert_near(sphere.moments_kg_m2, DVec3::splat(0.4 * 2.0 * 0.09));
        let cylinder = of(Shape::Cylinder {
            radius_m,
            half_height_m,
        });
        let across = 2.0 * (3.0 * 0.09 + 1.0) / 12.0;
        assert_near(cylinder.moments_kg_m2, DVec3::new(across, across, 0.09));
        let cone = of(Shape::Cone {
            radius_m,
            half_height_m,
        });
        assert_near(cone.centre_m, DVec3::new(0.0, 0.0, -0.25));
        let across = 2.0 * 3.0 / 80.0 * (4.0 * 0.09 + 1.0);
        assert_near(cone.moments_kg_m2, DVec3::new(across, across, 0.6 * 0.09));
        // A capsule without a straight part is a ball; one without a radius is a rod.
        let round = of(Shape::Capsule {
            radius_m,
            half_height_m: 1e-15,
        });
        assert_near(round.moments_kg_m2, sphere.moments_kg_m2);
        let rod = of(Shape::Capsule {
            radius_m: 1e-9,
            half_height_m,
        });
        let across = 2.0 / 12.0;
        assert!((rod.moments_kg_m2.x - across).abs() < 1e-8);
    }

    #[test]
    fn a_box_is_a_box_however_it_is_given() {
        let half_m = DVec3::new(0.1, 0.2, 0.3);
        let at = DVec3::new(5.0, -7.0, 11.0);
        let exact = Shape::Box { half_m }.mass_properties(3.0).unwrap();
        let points_m = corners(half_m, at);
        let hull = Shape::Hull(Arc::new(Hull {
            points_m: points_m.clone(),
        }));
        let triangles = vec![
            [0, 2, 1],
            [1, 2, 3],
            [4, 5, 6],
            [5, 7, 6],
            [0, 1, 4],
            [1, 5, 4],
            [2, 6, 3],
            [3, 6, 7],
            [0, 4, 2],
            [2, 4, 6],
            [1, 3, 5],
            [3, 7, 5],
        ];
        let open = Mesh {
            points_m: points_m.clone(),
            triangles: triangles[1..].to_vec(),
        };
        let mesh = Shape::Mesh(Arc::new(Mesh {
            points_m,
            triangles,
        }));
        let halves: [f64; 2] = [-0.15, 0.15];
        let half = |z: f64| Part {
            offset_m: at + DVec3::new(0.0, 0.0, z),
            attitude: Attitude::IDENTITY,
            shape: Shape::Box {
                half_m: DVec3::new(0.1, 0.2, 0.15),
            },
        };
        let compound = Shape::Compound(halves.map(half).into());
        for shape in [hull, mesh, compound] {
            let mass = shape.mass_properties(3.0).unwrap();
            assert_near(mass.centre_m, at);
            assert_near(mass.moments_kg_m2, exact.moments_kg_m2);
            let (centred, pose) = shape.centred();
            assert_near(pose.position.si(), at);
            let mass = centred.mass_properties(3.0).unwrap();
            assert!(mass.centre_m.length() < 1e-12);
            assert_near(mass.moments_kg_m2, exact.moments_kg_m2);
            assert_near(centred.inertia_kg_m2(3.0), exact.moments_kg_m2);
        }
        assert!(Shape::Mesh(Arc::new(open)).mass_properties(3.0).is_none());
    }

    #[test]
    fn a_turned_solid_comes_back_upright() {
        let half_m = DVec3::new(0.1, 0.2, 0.3);
        let turn = crate::rotation::turn_by(DVec3::new(0.3, -0.5, 0.7));
        let points_m = corners(half_m, DVec3::X)
            .into_iter()
            .map(|p| turn * p)
            .collect();
        let (centred, _) = Shape::Hull(Arc::new(Hull { points_m })).centred();
        let mass = centred.mass_properties(1.0).unwrap();
        assert!(
            mass.axes.quat().abs_diff_eq(glam::DQuat::IDENTITY, 1e-9),
            "{mass:?}"
        );
        let mut found = mass.moments_kg_m2.to_array();
        found.sort_by(f64::total_cmp);
        let exact = Shape::Box { half_m }.inertia_kg_m2(1.0);
        assert_near(
            DVec3::from_array(found),
            DVec3::new(exact.z, exact.y, exact.x),
        );
    }
}

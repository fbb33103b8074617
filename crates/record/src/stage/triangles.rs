//! Forms as triangles, for whoever draws or samples them.
//!
//! All but boxes and meshes are solids of revolution: a profile from the foot to the top, turned about `z`. With
//! `n` corners around, a profile is closed exactly, and its volume is that of the true solid times
//! `n / 2 pi sin(2 pi / n)`, and for round ends a little less.

use super::Form;
use simbeeotic_model::units::math;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

/// A surface of triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangles {
    /// Corners in the frame of the form, m.
    pub points_m: Arc<[[f32; 3]]>,
    /// Three corners each, counter-clockwise seen from outside, as places in `points_m`.
    pub triangles: Arc<[[u32; 3]]>,
}

/// The least and the greatest number of corners around.
const CORNERS: (u32, u32) = (3, 256);

impl Form {
    /// Its surface as triangles, closed for all but meshes that are open. `corners` is how many corners a
    /// circle has, 3 to 256; what lies outside counts as the nearest. 12 is a sketch, 32 looks round.
    pub fn triangles(&self, corners: u32) -> Triangles {
        let corners = corners.clamp(CORNERS.0, CORNERS.1);
        match self {
            Form::Box { half_m } => block(*half_m),
            Form::Sphere { radius_m } => {
                revolve(&arc(*radius_m, 0.0, corners, true, true), corners)
            }
            Form::Cylinder {
                radius_m,
                top_m,
                half_height_m: h,
            } => revolve(
                &[[0.0, -h], [*radius_m, -h], [*top_m, *h], [0.0, *h]],
                corners,
            ),
            Form::Capsule {
                radius_m,
                half_height_m: h,
            } => {
                let mut profile = arc(*radius_m, -h, corners, true, false);
                profile.extend(arc(*radius_m, *h, corners, false, true));
                revolve(&profile, corners)
            }
            Form::Mesh {
                points_m,
                triangles,
            } => Triangles {
                points_m: points_m.clone(),
                triangles: triangles.clone(),
            },
        }
    }
}

/// The profile of a ball around `z`, from its foot (or its equator) to its top (or its equator).
fn arc(radius_m: f64, z: f64, corners: u32, foot: bool, top: bool) -> Vec<[f64; 2]> {
    let steps = i64::from(corners.div_ceil(4).max(2));
    let from = if foot { -steps } else { 0 };
    let to = if top { steps } else { 0 };
    let point = |step: i64| {
        if step.abs() == steps {
            return [0.0, z + radius_m * step.signum() as f64];
        }
        let (sin, cos) = math::sin_cos(FRAC_PI_2 * step as f64 / steps as f64);
        [radius_m * cos, z + radius_m * sin]
    };
    (from..=to).map(point).collect()
}

/// A profile of radii and heights, upwards, that begins and ends on the axis, turned about it.
fn revolve(profile: &[[f64; 2]], corners: u32) -> Triangles {
    let directions: Vec<(f64, f64)> = (0..corners)
        .map(|k| math::sin_cos(TAU * f64::from(k) / f64::from(corners)))
        .collect();
    let mut points_m = Vec::new();
    let mut triangles = Vec::new();
    // The first point of the last ring, and whether it is a ring at all.
    let mut last: Option<(u32, bool)> = None;
    for [radius, z] in profile {
        let first = points_m.len() as u32;
        let ring = *radius > 0.0;
        if ring {
            let point = |(sin, cos): &(f64, f64)| [radius * cos, radius * sin, *z];
            points_m.extend(directions.iter().map(point).map(|p| p.map(|x| x as f32)));
        } else {
            points_m.push([0.0, 0.0, *z as f32]);
        }
        if let Some((below, was_ring)) = last {
            for k in 0..corners {
                let next = (k + 1) % corners;
                match (was_ring, ring) {
                    (true, true) => {
                        triangles.push([below + k, below + next, first + next]);
                        triangles.push([below + k, first + next, first + k]);
                    }
                    (true, false) => triangles.push([below + k, below + next, first]),
                    (false, true) => triangles.push([below, first + next, first + k]),
                    (false, false) => {}
                }
            }
        }
        last = Some((first, ring));
    }
    Triangles {
        points_m: points_m.into(),
        triangles: triangles.into(),
    }
}

fn block(half_m: [f64; 3]) -> Triangles {
    let corner = |k: u32| {
        let sign = |axis: u32| if k >> axis & 1 == 1 { 1.0 } else { -1.0 };
        [0, 1, 2].map(|axis| (sign(axis) * half_m[axis as usize]) as f32)
    };
    // Corners by bits: 1 is +x, 2 is +y, 4 is +z.
    let faces: [[u32; 4]; 6] = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    Triangles {
        points_m: (0..8).map(corner).collect(),
        triangles: faces
            .into_iter()
            .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
    }
}

impl Triangles {
    /// The corners of all triangles, three by three. Triangles with corners that do not exist are left out.
    pub fn corners(&self) -> impl Iterator<Item = [[f32; 3]; 3]> + '_ {
        self.triangles.iter().filter_map(|[a, b, c]| {
            let point = |k: &u32| self.points_m.get(*k as usize).copied();
            Some([point(a)?, point(b)?, point(c)?])
        })
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use simbeeotic_model::units::glam::DVec3;
    use std::f64::consts::PI;

    /// Volume by the divergence theorem: the sum of the tetrahedra with the origin.
    pub(in crate::stage) fn volume(surface: &Triangles) -> f64 {
        let tetrahedron = |corners: [[f32; 3]; 3]| {
            let [a, b, c] = corners.map(|p| DVec3::from_array(p.map(f64::from)));
            a.dot(b.cross(c)) / 6.0
        };
        surface.corners().map(tetrahedron).sum()
    }

    fn all(corners: u32) -> Vec<(Form, f64)> {
        let n = f64::from(corners);
        // The area of the circle's polygon, over the square of its radius.
        let area = 0.5 * n * math::sin_cos(TAU / n).0;
        let frustum = |a: f64, b: f64, h: f64| area * h / 3.0 * (a * a + a * b + b * b);
        let slices = |profile: &[[f64; 2]]| -> f64 {
            (profile.windows(2))
                .map(|pair| frustum(pair[0][0], pair[1][0], pair[1][1] - pair[0][1]))
                .sum()
        };
        let ball = arc(0.7, 0.0, corners, true, true);
        vec![
            (
                Form::Box {
                    half_m: [0.5, 1.0, 0.25],
                },
                1.0,
            ),
            (Form::Sphere { radius_m: 0.7 }, slices(&ball)),
            (
                Form::Cylinder {
                    radius_m: 0.5,
                    top_m: 0.5,
                    half_height_m: 1.5,
                },
                area * 0.25 * 3.0,
            ),
            (
                Form::Cylinder {
                    radius_m: 0.5,
                    top_m: 0.0,
                    half_height_m: 1.5,
                },
                area * 0.25,
            ),
            (
                Form::Cylinder {
                    radius_m: 0.0,
                    top_m: 0.4,
                    half_height_m: 1.5,
                },
                area * 0.16,
            ),
            (
                Form::Capsule {
                    radius_m: 0.7,
                    half_height_m: 2.0,
                },
                slices(&ball) + area * 0.49 * 4.0,
            ),
        ]
    }

    #[test]
    fn the_volume_is_that_of_the_solid_with_corners() {
        for corners in [3, 8, 32, 256] {
            for (form, expected) in all(corners) {
                let found = volume(&form.triangles(corners));
                assert!(
                    (found - expected).abs() < 1e-5 * expected,
                    "{form:?} with {corners}: {found}, not {expected}"
                );
            }
        }
        let ball = volume(&Form::Sphere { radius_m: 1.0 }.triangles(256));
        assert!((ball / (4.0 / 3.0 * PI) - 1.0).abs() < 1e-3, "{ball}");
    }

    #[test]
    fn every_triangle_faces_outwards() {
        for (form, _) in all(16) {
            // Each is convex and holds the origin: seen from there, all faces turn away.
            for corners in form.triangles(16).corners() {
                let [a, b, c] = corners.map(|p| DVec3::from_array(p.map(f64::from)));
                let normal = (b - a).cross(c - a);
                assert!(normal.dot(a) > 0.0, "{form:?}: {corners:?}");
            }
        }
    }

    #[test]
    fn every_edge_belongs_to_two_triangles_that_agree() {
        for (form, _) in all(7) {
            let surface = form.triangles(7);
            let edges = |t: &[u32; 3]| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])];
            let mut all: Vec<_> = surface.triangles.iter().flat_map(edges).collect();
            all.sort_unstable();
            let count = all.len();
            all.dedup();
            assert_eq!(all.len(), count, "{form:?}");
            for (a, b) in &all {
                assert!(all.binary_search(&(*b, *a)).is_ok(), "{form:?}");
            }
        }
    }

    #[test]
    fn any_number_of_corners_is_taken() {
        for corners in [0, 1, u32::MAX] {
            let cone = Form::Cylinder {
                radius_m: 1.0,
                top_m: 0.0,
                half_height_m: 1.0,
            };
            assert!(cone.triangles(corners).triangles.len() <= 2 * 256);
        }
        let bad = Triangles {
            points_m: [[0.0; 3]].into(),
            triangles: [[0, 0, 7]].into(),
        };
        assert_eq!(bad.corners().count(), 0);
    }
}

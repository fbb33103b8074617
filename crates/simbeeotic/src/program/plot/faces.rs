//! The faces of what stands in the world, as they are seen in 3-D.

use super::ground::{placed, triangles};
use simbeeotic_record::stage::{Form, Piece};
use simbeeotic_units::math;

/// Corners of what is round.
const ROUND: usize = 20;

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn middle(face: &[[f64; 3]]) -> [f64; 3] {
    let count = face.len() as f64;
    [0, 1, 2].map(|k| face.iter().map(|point| point[k]).sum::<f64>() / count)
}

pub(super) fn normal(face: &[[f64; 3]]) -> [f64; 3] {
    let side = |at: usize| [0, 1, 2].map(|k| face[at][k] - face[0][k]);
    let [a, b] = [side(1), side(2)];
    let cross = [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ];
    let long = dot(cross, cross).sqrt().max(1e-300);
    cross.map(|x| x / long)
}

/// The faces of a piece, counter-clockwise seen from outside, in the world, m.
pub(super) fn faces(piece: &Piece) -> Vec<Vec<[f64; 3]>> {
    let turn = |k: usize| math::sin_cos(k as f64 * std::f64::consts::TAU / ROUND as f64);
    // A body of revolution from its profile (radius, height), from below.
    let revolved = |profile: &[[f64; 2]]| {
        let mut faces: Vec<Vec<[f64; 3]>> = Vec::new();
        let point = |[radius, z]: [f64; 2], k: usize| {
            let (sin, cos) = turn(k);
            [radius * cos, radius * sin, z]
        };
        for two in profile.windows(2) {
            for k in 0..ROUND {
                let mut face = vec![point(two[0], k), point(two[0], k + 1)];
                face.push(point(two[1], k + 1));
                face.push(point(two[1], k));
                if two[0][0] == 0.0 {
                    face.remove(1);
                } else if two[1][0] == 0.0 {
                    face.remove(3);
                }
                faces.push(face);
            }
        }
        for (end, upper) in [(profile[0], false), (profile[profile.len() - 1], true)] {
            if end[0] > 0.0 {
                let mut ring: Vec<_> = (0..ROUND).map(|k| point(end, k)).collect();
                if !upper {
                    ring.reverse();
                }
                faces.push(ring);
            }
        }
        faces
    };
    let arc = |radius: f64, from: f64, to: f64, lift: f64| {
        (0..=5).map(move |k| {
            let (sin, cos) = math::sin_cos(from + (to - from) * f64::from(k) / 5.0);
            [
                if cos < 1e-12 { 0.0 } else { radius * cos },
                radius * sin + lift,
            ]
        })
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    let local = match &piece.form {
        Form::Box { half_m: [x, y, z] } => {
            let corner = |signs: [f64; 3]| [signs[0] * x, signs[1] * y, signs[2] * z];
            let mut faces = Vec::new();
            for axis in 0..3 {
                for sign in [-1.0, 1.0] {
                    let around = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
                    let mut face: Vec<_> = (around.into_iter())
                        .map(|[a, b]| {
                            let mut signs = [0.0; 3];
                            signs[axis] = sign;
                            signs[(axis + 1) % 3] = a;
                            signs[(axis + 2) % 3] = b;
                            corner(signs)
                        })
                        .collect();
                    if sign < 0.0 {
                        face.reverse();
                    }
                    faces.push(face);
                }
            }
            faces
        }
        Form::Sphere { radius_m } => {
            let profile: Vec<_> = arc(*radius_m, -quarter, quarter, 0.0).collect();
            revolved(&profile)
        }
        Form::Cylinder {
            radius_m,
            top_m,
            half_height_m: half,
        } => revolved(&[[*radius_m, -half], [*top_m, *half]]),
        Form::Capsule {
            radius_m,
            half_height_m: half,
        } => {
            let lower = arc(*radius_m, -quarter, 0.0, -half);
            let profile: Vec<_> = lower.chain(arc(*radius_m, 0.0, quarter, *half)).collect();
            revolved(&profile)
        }
        Form::Mesh { .. } => {
            return triangles(piece).into_iter().map(|t| t.to_vec()).collect();
        }
    };
    let place = |face: Vec<[f64; 3]>| face.into_iter().map(|p| placed(piece, p)).collect();
    local.into_iter().map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_faces_of_every_form_look_outwards() {
        let round = |top_m: f64| Form::Cylinder {
            radius_m: 1.0,
            top_m,
            half_height_m: 1.0,
        };
        let half_m = [1.0, 2.0, 3.0];
        let (radius_m, half_height_m) = (0.5, 1.0);
        for form in [
            Form::Box { half_m },
            Form::Sphere { radius_m },
            round(0.0),
            round(1.0),
            Form::Capsule {
                radius_m,
                half_height_m,
            },
        ] {
            let piece = Piece::at_origin(form);
            for face in faces(&piece) {
                let out = dot(normal(&face), middle(&face));
                assert!(out > 0.0, "{:?}: {face:?}", piece.form);
            }
        }
    }
}

//! How far things reach along the axes.

use super::{Form, Piece, Stage};
use simbeeotic_model::units::glam::{DMat3, DVec3};

impl Stage {
    /// The least and the greatest corner of the box along the axes that holds all props, m; `None` if there
    /// are none. The plane of the ground does not count.
    pub fn bounds(&self) -> Option<[[f64; 3]; 2]> {
        let pieces = self.props.iter().flat_map(|prop| &prop.pieces);
        let corners = pieces.filter_map(Piece::bounds);
        corners.reduce(|[a, b], [c, d]| {
            let pick = |p: [f64; 3], q: [f64; 3], best: fn(f64, f64) -> f64| {
                [0, 1, 2].map(|axis| best(p[axis], q[axis]))
            };
            [pick(a, c, f64::min), pick(b, d, f64::max)]
        })
    }
}

impl Piece {
    /// The least and the greatest corner of the box along the axes of world or body that holds it, m;
    /// `None` for a mesh without corners.
    pub fn bounds(&self) -> Option<[[f64; 3]; 2]> {
        let middle = self.origin();
        let turn = DMat3::from_quat(self.turn());
        // How far each axis of the outer frame looks along z, and across it.
        let up = turn.z_axis;
        let across = (DVec3::ONE - up * up).max(DVec3::ZERO);
        let across = DVec3::from_array(across.to_array().map(f64::sqrt));
        let even = |reach: DVec3| [middle - reach, middle + reach];
        let [least, most] = match &self.form {
            Form::Box { half_m: [x, y, z] } => {
                even(turn.x_axis.abs() * *x + turn.y_axis.abs() * *y + up.abs() * *z)
            }
            Form::Sphere { radius_m } => even(DVec3::splat(*radius_m)),
            Form::Capsule {
                radius_m,
                half_height_m,
            } => even(up.abs() * *half_height_m + DVec3::splat(*radius_m)),
            Form::Cylinder {
                radius_m,
                top_m,
                half_height_m,
            } => {
                let (foot, top) = (middle - up * *half_height_m, middle + up * *half_height_m);
                let (wide, narrow) = (across * *radius_m, across * *top_m);
                [
                    (foot - wide).min(top - narrow),
                    (foot + wide).max(top + narrow),
                ]
            }
            Form::Mesh { points_m, .. } => {
                let corners = points_m.iter().map(|p| {
                    let p = middle + turn * DVec3::from_array(p.map(f64::from));
                    [p, p]
                });
                corners.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])?
            }
        };
        Some([least.to_array(), most.to_array()])
    }
}

#[cfg(test)]
mod tests {
    use super::super::Prop;
    use super::*;
    use simbeeotic_model::units::glam::DQuat;

    #[test]
    fn the_box_holds_the_surface_and_touches_it() {
        let turn = DQuat::from_xyzw(0.3, -0.5, 0.2, 0.7).normalize();
        let cylinder = |top_m| Form::Cylinder {
            radius_m: 0.5,
            top_m,
            half_height_m: 2.0,
        };
        for form in [
            Form::Box {
                half_m: [1.0, 2.0, 0.5],
            },
            Form::Sphere { radius_m: 0.8 },
            cylinder(0.5),
            cylinder(0.0),
            cylinder(1.5),
            Form::Capsule {
                radius_m: 0.3,
                half_height_m: 1.0,
            },
            Form::Sphere { radius_m: 1.0 }.triangles(9).into(),
        ] {
            let piece = Piece::new(form, [3.0, -1.0, 0.5], turn);
            let [least, most] = piece.bounds().expect("it has corners");
            let surface = piece.form.triangles(256);
            let points = (surface.points_m.iter())
                .map(|p| piece.origin() + turn * DVec3::from_array(p.map(f64::from)));
            let (mut a, mut b) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            for p in points {
                (a, b) = (a.min(p), b.max(p));
            }
            for (found, is) in [(least, a), (most, b)] {
                let apart = (DVec3::from_array(found) - is).abs().max_element();
                assert!(apart < 1e-3, "{:?}: {found:?}, not {is}", piece.form);
            }
        }
    }

    #[test]
    fn an_empty_stage_has_no_bounds() {
        assert_eq!(Stage::default().bounds(), None);
        let ball = |x| Prop {
            pieces: vec![Piece::new(
                Form::Sphere { radius_m: 1.0 },
                [x, 0.0, 0.0],
                DQuat::IDENTITY,
            )],
            ..Prop::default()
        };
        let stage = Stage {
            props: vec![ball(0.0), Prop::default(), ball(10.0)],
            ..Stage::default()
        };
        assert_eq!(stage.bounds(), Some([[-1.0, -1.0, -1.0], [11.0, 1.0, 1.0]]));
    }
}

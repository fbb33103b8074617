//! What stands in the world, as triangles in their light.

use super::flower::{self, Tint};
use simbeeotic_record::stage::{Form, Piece, Prop, Stage};
use simbeeotic_units::glam::{DQuat, DVec3, Vec3};
use simbeeotic_units::math;

/// A triangle with the directions that its surface faces at the corners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    pub(super) corners: [Vec3; 3],
    pub(super) normals: [Vec3; 3],
}

/// A triangle of the world.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub(super) corners: [Vec3; 3],
    /// The directions that its surface faces at the corners; unit vectors.
    pub(super) normals: [Vec3; 3],
    /// Where the corners are on the picture that lies on it, m.
    pub(super) at_m: [[f32; 2]; 3],
    pub(super) rgba: [[u8; 4]; 3],
    /// Its picture, by its place among the skins.
    pub(super) skin: Option<u16>,
    /// Whether it throws a shadow, and whether shadows fall on it.
    pub(super) shadow: bool,
    pub(super) shaded: bool,
    /// Whether it is ground, with the lines of the grid on it.
    pub(super) terrain: bool,
}

/// The stage, around a point of the world; `skin` knows the places of textures.
pub(super) fn stage(
    stage: &Stage,
    origin_m: DVec3,
    mut skin: impl FnMut(&str) -> Option<u16>,
) -> Vec<Face> {
    let flowers = stage.props.iter().filter(|prop| prop.kind == "flower");
    let fine = flowers.count() < flower::MANY;
    let mut known = Known::default();
    let mut faces = Vec::new();
    for (number, prop) in stage.props.iter().enumerate() {
        let skin = skin(&prop.texture);
        match flower::parts(prop, number, fine) {
            Some(parts) => {
                for part in parts {
                    let own = |tint: Tint| tint.over(part.rgba);
                    let lit = part.facets.iter().map(|(facet, tints)| Face {
                        corners: facet.corners.map(|c| part.moved(c, origin_m)),
                        normals: facet.normals.map(|n| part.turned(n)),
                        at_m: [[0.0; 2]; 3],
                        rgba: tints.map(own),
                        skin: None,
                        shadow: true,
                        // Petals are smaller than the pixels of shadows.
                        shaded: false,
                        terrain: false,
                    });
                    faces.extend(lit);
                }
            }
            None => self::prop(prop, origin_m, skin, &mut known, &mut faces),
        }
    }
    faces
}

/// The surfaces of forms, each made once.
#[derive(Default)]
struct Known(Vec<(Form, Vec<Facet>)>);

impl Known {
    fn facets(&mut self, form: &Form) -> &[Facet] {
        // Worlds have few forms, many times; a mesh is mostly there once.
        let last = self.0.iter().rposition(|(known, _)| known == form);
        let place = last.unwrap_or_else(|| {
            if self.0.len() >= 16 {
                self.0.remove(0);
            }
            self.0.push((form.clone(), facets(form, 24)));
            self.0.len() - 1
        });
        &self.0[place].1
    }
}

fn prop(prop: &Prop, origin_m: DVec3, skin: Option<u16>, known: &mut Known, faces: &mut Vec<Face>) {
    let terrain = prop.kind == "terrain";
    let shadow = !matches!(prop.kind.as_str(), "light" | "source");
    for piece in &prop.pieces {
        let turn = turn_of(piece);
        let place = DVec3::from(piece.position_m) - origin_m;
        for facet in known.facets(&piece.form) {
            faces.push(Face {
                corners: facet
                    .corners
                    .map(|corner| (turn * corner.as_dvec3() + place).as_vec3()),
                normals: facet.normals.map(|n| (turn * n.as_dvec3()).as_vec3()),
                at_m: on_picture(facet),
                rgba: [prop.color; 3],
                skin,
                shadow,
                shaded: true,
                terrain,
            });
        }
    }
}

/// Where the corners of a facet are on a picture that is laid on its form along the axis that it faces most, m.
fn on_picture(facet: &Facet) -> [[f32; 2]; 3] {
    let faces: Vec3 = facet.normals.iter().sum::<Vec3>().abs();
    facet.corners.map(|c| {
        if faces.z > faces.x && faces.z > faces.y {
            [c.x, c.y]
        } else if faces.x > faces.y {
            [c.y, c.z]
        } else {
            [c.x, c.z]
        }
    })
}

/// How a piece is turned; as it stands if that is no turn.
pub(super) fn turn_of(piece: &Piece) -> DQuat {
    let [w, x, y, z] = piece.attitude;
    let turn = DQuat::from_xyzw(x, y, z, w);
    match turn.length() {
        length if length.is_finite() && length > 1e-9 => turn / length,
        _ => DQuat::IDENTITY,
    }
}

/// The corners of the box that holds a stage.
pub(super) fn bounds(stage: &Stage) -> Option<[DVec3; 2]> {
    stage.bounds().map(|corners| corners.map(DVec3::from))
}

/// The surface of a form, `around` corners to a circle, smooth where it is round.
pub(super) fn facets(form: &Form, around: u32) -> Vec<Facet> {
    let surface = form.triangles(around);
    meshed(&surface.points_m, &surface.triangles)
}

/// An outline in the plane of `x` and `z`, from below to above, turned about `z`.
pub(super) fn revolved(outline: &[(Vec3, Vec3)], around: usize) -> Vec<Facet> {
    let turns: Vec<(f32, f32)> = (0..=around)
        .map(|step| {
            let share = (step % around) as f64 / around as f64;
            let (sin, cos) = math::sin_cos(std::f64::consts::TAU * share);
            (sin as f32, cos as f32)
        })
        .collect();
    let turned = |v: Vec3, (sin, cos): (f32, f32)| {
        Vec3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z)
    };
    let mut facets = Vec::new();
    for pair in outline.windows(2) {
        let [(below, below_n), (above, above_n)] = [pair[0], pair[1]];
        for step in turns.windows(2) {
            let corner = |point: Vec3, normal: Vec3, k: usize| {
                (turned(point, step[k]), turned(normal, step[k]))
            };
            let quad = [
                corner(below, below_n, 0),
                corner(below, below_n, 1),
                corner(above, above_n, 1),
                corner(above, above_n, 0),
            ];
            for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                let facet = [quad[a], quad[b], quad[c]];
                let corners = facet.map(|(point, _)| point);
                if (corners[1] - corners[0]).cross(corners[2] - corners[0]) != Vec3::ZERO {
                    facets.push(Facet {
                        corners,
                        normals: facet.map(|(_, normal)| normal),
                    });
                }
            }
        }
    }
    facets
}

/// Faces whose directions differ by less than this look like one round surface.
const CREASE_COS: f32 = 0.8;

/// Triangles, smooth where their surface is nearly so. Places that are not there are left out.
fn meshed(points: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<Facet> {
    let corner = |at: u32| points.get(at as usize).copied().map(Vec3::from);
    let mut faces = Vec::with_capacity(triangles.len());
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); points.len()];
    for places in triangles {
        let [Some(a), Some(b), Some(c)] = places.map(corner) else {
            continue;
        };
        let cross = (b - a).cross(c - a);
        if cross.length_squared() > 0.0 && cross.is_finite() {
            for place in places {
                around[*place as usize].push(faces.len() as u32);
            }
            faces.push((*places, [a, b, c], cross, cross.normalize()));
        }
    }
    let facet = |(places, corners, _, own): &([u32; 3], [Vec3; 3], Vec3, Vec3)| {
        let normals = places.map(|place| {
            let near = around[place as usize]
                .iter()
                .map(|face| &faces[*face as usize]);
            let alike = near.filter(|(_, _, _, normal)| normal.dot(*own) > CREASE_COS);
            // Larger faces count more.
            let sum: Vec3 = alike.map(|(_, _, cross, _)| *cross).sum();
            sum.normalize_or(*own)
        });
        Facet {
            corners: *corners,
            normals,
        }
    };
    faces.iter().map(facet).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume_and_area(form: &Form) -> (f64, f64) {
        let mut sums = (0.0, 0.0);
        for facet in facets(form, 96) {
            let [a, b, c] = facet.corners.map(|corner| corner.as_dvec3());
            let cross = (b - a).cross(c - a);
            sums.0 += a.dot(b.cross(c)) / 6.0;
            sums.1 += 0.5 * cross.length();
            for normal in facet.normals {
                assert!(normal.as_dvec3().dot(cross) > 0.0, "{form:?} {facet:?}");
            }
        }
        sums
    }

    #[test]
    fn surfaces_are_closed_face_outwards_and_have_their_size() {
        use std::f64::consts::PI;
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let tetra = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        for (form, volume) in [
            (
                Form::Box {
                    half_m: [1.0, 2.0, 3.0],
                },
                48.0,
            ),
            (Form::Sphere { radius_m: 2.0 }, 4.0 / 3.0 * PI * 8.0),
            (
                Form::Cylinder {
                    radius_m: 1.0,
                    top_m: 1.0,
                    half_height_m: 2.0,
                },
                4.0 * PI,
            ),
            (
                Form::Cylinder {
                    radius_m: 1.0,
                    top_m: 0.0,
                    half_height_m: 1.5,
                },
                PI,
            ),
            (
                Form::Capsule {
                    radius_m: 1.0,
                    half_height_m: 1.0,
                },
                PI * (2.0 + 4.0 / 3.0),
            ),
            (
                Form::Mesh {
                    points_m: points.into(),
                    triangles: tetra.into(),
                },
                1.0 / 6.0,
            ),
        ] {
            let (found, area) = volume_and_area(&form);
            assert!((found - volume).abs() < 4e-3 * volume, "{form:?}: {found}");
            assert!(area > 0.0);
        }
    }

    #[test]
    fn a_mesh_that_names_corners_it_has_not_is_drawn_without_them() {
        let form = Form::Mesh {
            points_m: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [f32::NAN; 3]].into(),
            triangles: vec![[0, 1, 2], [0, 1, 9], [0, 1, 3], [1, 1, 1]].into(),
        };
        assert_eq!(facets(&form, 8).len(), 1);
    }

    #[test]
    fn a_flat_roof_stays_sharp_and_a_gentle_bend_becomes_round() {
        let bend = |height: f32| Form::Mesh {
            points_m: vec![
                [-1.0, 0.0, 0.0],
                [-1.0, 1.0, 0.0],
                [0.0, 0.0, height],
                [0.0, 1.0, height],
                [1.0, 0.0, 0.0],
                [1.0, 1.0, 0.0],
            ]
            .into(),
            triangles: vec![[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]].into(),
        };
        let at_ridge = |form: &Form| facets(form, 8)[0].normals[1];
        assert!(at_ridge(&bend(0.1)).x.abs() < 0.04);
        assert!(at_ridge(&bend(2.0)).x < -0.5);
    }
}

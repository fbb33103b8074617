//! From a stage to a scene.

use super::Layout;
use crate::encoder::WORLD_FRAME;
use crate::message::{
    Color, Cube, Cylinder, KeyValue, Pose, Quaternion, SceneEntity, SceneUpdate, TriangleList,
    Vector3,
};
use crate::recorder::Precision;
use crate::stage::{Form, Piece, Prop, Stage};
use simbeeotic_model::units::glam::DVec3;

/// Triangles that are written at most; a mesh that would make them more is a box.
const TRIANGLES_MAX: usize = 2_000_000;

/// The ground is drawn at least so far to each side, m, and so thick.
const GROUND_M: f64 = 50.0;
const GROUND_THICK_M: f64 = 0.02;

/// The scene of a stage.
pub(crate) fn scene_of(stage: &Stage, precision: Precision) -> SceneUpdate {
    let mut packer = Packer {
        precision,
        triangles_left: TRIANGLES_MAX,
    };
    let mut entities = vec![packer.ground(stage)];
    let mut rest = stage.props.as_slice();
    while let Some(first) = rest.first() {
        let layout = Layout::of(&first.pieces);
        let count = rest
            .iter()
            .take_while(|prop| alike(first, layout, prop))
            .count();
        let (group, others) = rest.split_at(count);
        entities.push(packer.group(entities.len(), first, layout, group));
        rest = others;
    }
    SceneUpdate { entities }
}

/// Whether two props, the first of this layout, can be one entity.
fn alike(a: &Prop, layout: Layout, b: &Prop) -> bool {
    (&a.kind, &a.label, a.color, &a.texture, &a.meta)
        == (&b.kind, &b.label, b.color, &b.texture, &b.meta)
        && layout == Layout::of(&b.pieces)
}

/// What vehicles look like, as an entity in their body frame.
pub(crate) fn look_of(pieces: &[Piece], precision: Precision) -> SceneEntity {
    let mut packer = Packer {
        precision,
        triangles_left: TRIANGLES_MAX,
    };
    let layout = Layout::of(pieces);
    let mut entity = SceneEntity {
        metadata: vec![pair("pieces", &layout.write(1))],
        ..SceneEntity::default()
    };
    packer.add(&mut entity, pieces, [0xff; 4]);
    entity
}

pub(super) fn pair(key: &str, value: &str) -> KeyValue {
    KeyValue {
        key: key.to_owned(),
        value: value.to_owned(),
    }
}

pub(super) fn hex([r, g, b, a]: [u8; 4]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}{a:02x}")
}

fn color_of(rgba: [u8; 4]) -> Color {
    let [r, g, b, a] = rgba.map(|x| f64::from(x) / 255.0);
    Color { r, g, b, a }
}

fn vector(v: DVec3) -> Vector3 {
    Vector3 {
        x: v.x,
        y: v.y,
        z: v.z,
    }
}

/// Half of what is left of a box.
fn whole(half: DVec3) -> Option<Vector3> {
    Some(vector(half * 2.0))
}

/// Half the size of the slab below `z = 0` that the flat ground is drawn as, m; `None` if there is none.
pub(super) fn ground_of(stage: &Stage) -> Option<DVec3> {
    let [least, most] = stage.bounds().unwrap_or_default();
    let reach = [least[0], least[1], most[0], most[1]];
    let reach = reach.into_iter().map(f64::abs).fold(0.0, f64::max);
    let half = (1.5 * reach).min(stage.radius_m).max(GROUND_M);
    (stage.plane).then_some(DVec3::new(half, half, 0.5 * GROUND_THICK_M))
}

struct Packer {
    precision: Precision,
    triangles_left: usize,
}

impl Packer {
    fn ground(&self, stage: &Stage) -> SceneEntity {
        let slab = ground_of(stage).map(|half| Cube {
            pose: Some(self.pose_at(DVec3::new(0.0, 0.0, -half.z), [1.0, 0.0, 0.0, 0.0])),
            size: whole(half),
            color: Some(color_of(stage.ground)),
        });
        let mut metadata = vec![
            pair("kind", "ground"),
            pair("color", &hex(stage.ground)),
            pair("plane", &stage.plane.to_string()),
            pair("radius_m", &stage.radius_m.to_string()),
        ];
        if !stage.texture.is_empty() {
            metadata.push(pair("texture", &stage.texture));
        }
        SceneEntity {
            frame_id: WORLD_FRAME.to_owned(),
            id: "ground".to_owned(),
            metadata,
            cubes: slab.into_iter().collect(),
            ..SceneEntity::default()
        }
    }

    fn group(
        &mut self,
        number: usize,
        first: &Prop,
        layout: Layout,
        props: &[Prop],
    ) -> SceneEntity {
        let own = [
            ("kind", first.kind.as_str()),
            ("label", &first.label),
            ("color", &hex(first.color)),
            ("texture", &first.texture),
            ("pieces", &layout.write(props.len())),
        ];
        let meta = first
            .meta
            .iter()
            .map(|(key, value)| (key.as_str(), value.as_str()));
        let mut entity = SceneEntity {
            frame_id: WORLD_FRAME.to_owned(),
            id: format!("{} {number} {}", first.kind, first.label)
                .trim_end()
                .to_owned(),
            metadata: own
                .into_iter()
                .chain(meta)
                .map(|(k, v)| pair(k, v))
                .collect(),
            ..SceneEntity::default()
        };
        for prop in props {
            self.add(&mut entity, &prop.pieces, prop.color);
        }
        entity
    }

    fn add(&mut self, entity: &mut SceneEntity, pieces: &[Piece], rgba: [u8; 4]) {
        let color = Some(color_of(rgba));
        let capsule = |piece: &&Piece| matches!(piece.form, Form::Capsule { .. });
        let (plain, capsules): (Vec<&Piece>, Vec<&Piece>) =
            pieces.iter().partition(|piece| !capsule(piece));
        for piece in plain.into_iter().chain(capsules) {
            let pose = Some(self.pose(piece));
            match &piece.form {
                Form::Box { half_m } => entity.cubes.push(Cube {
                    pose,
                    size: whole(DVec3::from_array(*half_m)),
                    color,
                }),
                Form::Sphere { radius_m } => entity.spheres.push(Cube {
                    pose,
                    size: whole(DVec3::splat(*radius_m)),
                    color,
                }),
                Form::Cylinder {
                    radius_m,
                    top_m,
                    half_height_m,
                } => {
                    let wide = radius_m.max(*top_m);
                    let scale = |radius: f64| if wide > 0.0 { radius / wide } else { 0.0 };
                    entity.cylinders.push(Cylinder {
                        pose,
                        size: whole(DVec3::new(wide, wide, *half_height_m)),
                        bottom_scale: scale(*radius_m),
                        top_scale: scale(*top_m),
                        color,
                    });
                }
                Form::Capsule {
                    radius_m,
                    half_height_m,
                } => {
                    entity.cylinders.push(Cylinder {
                        pose,
                        size: whole(DVec3::new(*radius_m, *radius_m, *half_height_m)),
                        bottom_scale: 1.0,
                        top_scale: 1.0,
                        color,
                    });
                    for end in [-half_height_m, *half_height_m] {
                        let at = piece.origin() + piece.turn() * DVec3::new(0.0, 0.0, end);
                        entity.spheres.push(Cube {
                            pose: Some(self.pose_at(at, piece.attitude)),
                            size: whole(DVec3::splat(*radius_m)),
                            color,
                        });
                    }
                }
                Form::Mesh {
                    points_m,
                    triangles,
                } => {
                    let fits = triangles.len() <= self.triangles_left;
                    let list = match fits {
                        true => (points_m.clone(), triangles.clone()),
                        false => around(points_m),
                    };
                    self.triangles_left = self.triangles_left.saturating_sub(list.1.len());
                    entity.triangles.push(TriangleList {
                        pose,
                        points: (list.0.iter())
                            .map(|p| vector(DVec3::from_array(p.map(f64::from))))
                            .collect(),
                        color,
                        indices: list.1.as_flattened().to_vec(),
                    });
                }
            }
        }
    }

    fn pose(&self, piece: &Piece) -> Pose {
        self.pose_at(piece.origin(), piece.attitude)
    }

    fn pose_at(&self, at: DVec3, attitude: [f64; 4]) -> Pose {
        let [x, y, z] = at.to_array().map(|p| self.precision.position(p));
        let [qw, qx, qy, qz] = attitude.map(|q| self.precision.attitude(q));
        Pose {
            position: Some(Vector3 { x, y, z }),
            orientation: Some(Quaternion {
                x: qx,
                y: qy,
                z: qz,
                w: qw,
            }),
        }
    }
}

type Mesh = (std::sync::Arc<[[f32; 3]]>, std::sync::Arc<[[u32; 3]]>);

/// The box around some points, as triangles.
fn around(points: &[[f32; 3]]) -> Mesh {
    let least = points
        .iter()
        .fold([f32::INFINITY; 3], |a, p| pick(a, *p, f32::min));
    let most = points
        .iter()
        .fold([f32::NEG_INFINITY; 3], |a, p| pick(a, *p, f32::max));
    let block = Form::Box { half_m: [1.0; 3] }.triangles(4);
    let corner = |p: &[f32; 3]| {
        [0, 1, 2].map(|axis| {
            if p[axis] > 0.0 {
                most[axis]
            } else {
                least[axis]
            }
        })
    };
    (block.points_m.iter().map(corner).collect(), block.triangles)
}

fn pick(a: [f32; 3], b: [f32; 3], best: fn(f32, f32) -> f32) -> [f32; 3] {
    [0, 1, 2].map(|axis| best(a[axis], b[axis]))
}

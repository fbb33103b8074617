//! From a scene back to a stage. Nothing is trusted: what has numbers that are none, or corners that do not
//! exist, is left out.

use super::Layout;
use crate::message::{
    Cube, Cylinder, KeyValue, Pose, SceneEntity, SceneUpdate, TriangleList, Vector3,
};
use crate::stage::{Form, Piece, Prop, Stage};
use std::sync::Arc;

/// The stage of a scene.
pub(crate) fn stage_of(scene: &SceneUpdate) -> Stage {
    let mut stage = Stage::default();
    let mut meshes = Meshes::default();
    for entity in &scene.entities {
        let meta = &entity.metadata;
        if entity.id == "ground" && value(meta, 0, "kind") == Some("ground") {
            stage.ground = value(meta, 1, "color").and_then(rgba).unwrap_or_default();
            stage.plane = value(meta, 2, "plane") == Some("true");
            let radius = value(meta, 3, "radius_m").and_then(|text| text.parse().ok());
            stage.radius_m = radius.filter(|r: &f64| r.is_finite()).unwrap_or_default();
            stage.texture = value(meta, 4, "texture").unwrap_or_default().to_owned();
            continue;
        }
        props(entity, &mut meshes, &mut stage.props);
    }
    stage
}

/// The pieces of a look.
pub(crate) fn pieces_of_look(entity: &SceneEntity) -> Arc<[Piece]> {
    let (props, layout) = value(&entity.metadata, 0, "pieces")
        .and_then(Layout::read)
        .unwrap_or_else(|| (1, whole(entity)));
    let mut lists = Lists::new(entity);
    let mut meshes = Meshes::default();
    match props {
        1 => lists.take(&layout, &mut meshes).into(),
        _ => Arc::new([]),
    }
}

/// Adds the props of an entity.
fn props(entity: &SceneEntity, meshes: &mut Meshes, all: &mut Vec<Prop>) {
    let meta = &entity.metadata;
    let text = |at, key| value(meta, at, key).unwrap_or_default().to_owned();
    let layout = value(meta, 4, "pieces").and_then(Layout::read);
    let layout = layout.filter(|(props, each)| fits(entity, *props, each));
    // An entity of somebody else is one thing, called by its id.
    let (count, each, own, label) = match layout {
        Some((count, each)) => (count, each, 5, text(1, "label")),
        None => (1, whole(entity), 0, entity.id.clone()),
    };
    let first = Prop {
        kind: text(0, "kind"),
        label,
        color: value(meta, 2, "color")
            .and_then(rgba)
            .unwrap_or([128, 128, 128, 255]),
        texture: text(3, "texture"),
        pieces: Vec::new(),
        meta: (meta.iter().skip(own))
            .map(|pair| (pair.key.clone(), pair.value.clone()))
            .collect(),
    };
    let mut lists = Lists::new(entity);
    all.extend((0..count).map(|_| Prop {
        pieces: lists.take(&each, meshes),
        ..first.clone()
    }));
}

/// The value at a place, if its key is this one.
fn value<'a>(meta: &'a [KeyValue], at: usize, key: &str) -> Option<&'a str> {
    let pair = meta.get(at).filter(|pair| pair.key == key)?;
    Some(&pair.value)
}

/// All that an entity has, as of one prop without capsules.
fn whole(entity: &SceneEntity) -> Layout {
    Layout {
        cubes: entity.cubes.len(),
        spheres: entity.spheres.len(),
        cylinders: entity.cylinders.len(),
        capsules: 0,
        triangles: entity.triangles.len(),
    }
}

/// Whether the lists of an entity are as long as its layout says. Of props without pieces there are a
/// million at most.
fn fits(entity: &SceneEntity, props: usize, each: &Layout) -> bool {
    let is =
        |each: Option<usize>, of: usize| each.and_then(|each| each.checked_mul(props)) == Some(of);
    let spheres = each.capsules.checked_mul(2);
    is(Some(each.cubes), entity.cubes.len())
        && is(
            spheres.and_then(|two| two.checked_add(each.spheres)),
            entity.spheres.len(),
        )
        && is(
            each.cylinders.checked_add(each.capsules),
            entity.cylinders.len(),
        )
        && is(Some(each.triangles), entity.triangles.len())
        && (*each != Layout::default() || props <= 1_000_000)
}

fn rgba(text: &str) -> Option<[u8; 4]> {
    let digits = text.strip_prefix('#')?;
    if digits.len() != 8 {
        return None;
    }
    Some(u32::from_str_radix(digits, 16).ok()?.to_be_bytes())
}

/// What is left of the lists of an entity.
struct Lists<'a> {
    cubes: &'a [Cube],
    spheres: &'a [Cube],
    cylinders: &'a [Cylinder],
    triangles: &'a [TriangleList],
}

fn take<'a, T>(list: &mut &'a [T], count: usize) -> &'a [T] {
    let (head, tail) = list.split_at(count.min(list.len()));
    *list = tail;
    head
}

impl<'a> Lists<'a> {
    fn new(entity: &'a SceneEntity) -> Self {
        Self {
            cubes: &entity.cubes,
            spheres: &entity.spheres,
            cylinders: &entity.cylinders,
            triangles: &entity.triangles,
        }
    }

    /// The pieces of the next prop.
    fn take(&mut self, each: &Layout, meshes: &mut Meshes) -> Vec<Piece> {
        let mut pieces = Vec::new();
        let mut add = |form: Option<Form>, pose: Option<Pose>| {
            pieces.extend(form.and_then(|form| piece(form, pose)));
        };
        for cube in take(&mut self.cubes, each.cubes) {
            let half_m = half(cube.size);
            add(half_m.map(|half_m| Form::Box { half_m }), cube.pose);
        }
        for sphere in take(&mut self.spheres, each.spheres) {
            let form = half(sphere.size).map(|[radius_m, ..]| Form::Sphere { radius_m });
            add(form, sphere.pose);
        }
        for cylinder in take(&mut self.cylinders, each.cylinders) {
            let scales = [cylinder.bottom_scale, cylinder.top_scale];
            let sound = scales.iter().all(|scale| (0.0..=1.0).contains(scale));
            let form = half(cylinder.size).map(|[wide, _, half_height_m]| Form::Cylinder {
                radius_m: wide * scales[0],
                top_m: wide * scales[1],
                half_height_m,
            });
            add(form.filter(|_| sound), cylinder.pose);
        }
        for list in take(&mut self.triangles, each.triangles) {
            add(meshes.form(list), list.pose);
        }
        take(&mut self.spheres, each.capsules.saturating_mul(2));
        for capsule in take(&mut self.cylinders, each.capsules) {
            let form = half(capsule.size).map(|[radius_m, _, half_height_m]| Form::Capsule {
                radius_m,
                half_height_m,
            });
            add(form, capsule.pose);
        }
        pieces
    }
}

/// Half a size, if there can be such a one.
fn half(size: Option<Vector3>) -> Option<[f64; 3]> {
    let size = size.unwrap_or_default();
    let half = [size.x, size.y, size.z].map(|x| 0.5 * x);
    let sound = half.iter().all(|x| x.is_finite() && *x >= 0.0);
    sound.then_some(half)
}

fn piece(form: Form, pose: Option<Pose>) -> Option<Piece> {
    let pose = pose.unwrap_or_default();
    let at = pose.position.unwrap_or_default();
    let position_m = [at.x, at.y, at.z];
    let attitude = match pose.orientation {
        Some(q) => [q.w, q.x, q.y, q.z],
        None => [1.0, 0.0, 0.0, 0.0],
    };
    let sound = position_m.iter().chain(&attitude).all(|x| x.is_finite());
    sound.then_some(Piece {
        form,
        position_m,
        attitude,
    })
}

/// The last few meshes, so that equal ones are shared.
#[derive(Default)]
struct Meshes(Vec<Form>);

impl Meshes {
    fn form(&mut self, list: &TriangleList) -> Option<Form> {
        let points_m: Arc<[[f32; 3]]> = (list.points.iter())
            .map(|p| [p.x, p.y, p.z].map(|x| x as f32))
            .collect();
        if !points_m.as_flattened().iter().all(|x| x.is_finite()) {
            return None;
        }
        let (corners, _) = list.indices.as_chunks::<3>();
        let real = |corners: &&[u32; 3]| corners.iter().all(|k| (*k as usize) < points_m.len());
        let triangles = corners.iter().filter(real).copied().collect();
        let form = Form::Mesh {
            points_m,
            triangles,
        };
        if let Some(known) = self.0.iter().find(|known| **known == form) {
            return Some(known.clone());
        }
        if self.0.len() >= 32 {
            self.0.remove(0);
        }
        self.0.push(form.clone());
        Some(form)
    }
}

//! From worlds and bodies to what they look like.

use super::thin::{self, TRIANGLES_MAX};
use super::{Form, Piece, Prop, Stage, textures};
use simbeeotic_model::objects;
use simbeeotic_model::physics::Shape;
use simbeeotic_model::units::glam::{DQuat, DVec3};
use simbeeotic_model::world::{Color, Light, Object, Solid, SolidShape, Source, Texture, World};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Triangles of all meshes of a world together that are drawn at most, where none needs them for itself.
const WORLD_TRIANGLES_MAX: usize = 1_000_000;

/// However many meshes there are, each may have so many triangles.
const MESH_TRIANGLES_LEAST: usize = 500;

/// Half the side of the square that stands for a plane without end, m.
const PLANE_HALF_M: f32 = 50.0;

/// How many compounds may stand within each other.
const NESTED_MAX: usize = 16;

/// The colour of a source of gas.
const GAS: [u8; 4] = [176, 205, 70, 110];

/// Lamps and sources are drawn at least so large, m.
const LAMP_M: f64 = 0.05;
const SOURCE_M: f64 = 0.1;

impl Stage {
    /// What a world looks like. `seed` decides where flowers stand, as in a run.
    ///
    /// Of large surfaces of triangles a part is left out: of height fields all but 257 samples a side, of
    /// meshes what is finer than can be drawn with 200,000 triangles, or 1,000,000 for all meshes.
    pub fn of(world: &World, seed: u64) -> Self {
        let objects = world.objects(seed);
        let mut meshes = Meshes::new(&objects);
        let things = objects.iter().map(|object| Prop {
            kind: object.id.kind.name().to_owned(),
            label: object.label.to_owned(),
            color: rgba(object.color),
            texture: name(object.texture),
            pieces: (object.solids.iter())
                .flat_map(|solid| meshes.pieces(solid))
                .collect(),
            meta: object.meta.clone().into_iter().collect(),
        });
        let mut props: Vec<Prop> = things.collect();
        props.extend(world.lights.iter().map(lamp));
        props.extend(world.sources.iter().map(source));
        Self {
            ground: rgba(world.ground.color),
            texture: name(world.ground.texture.as_ref()),
            radius_m: world.radius.get(),
            plane: world.terrain.is_none(),
            props,
        }
    }
}

/// The name of a texture; empty for none.
fn name(texture: Option<&Texture>) -> String {
    texture.map(textures::name_of).unwrap_or_default()
}

/// What a body looks like, in its own frame (FLU). A plane without end is a square of 100 m.
pub fn pieces_of(shape: &Shape) -> Vec<Piece> {
    let mut pieces = Vec::new();
    collect(
        shape,
        (DVec3::ZERO, DQuat::IDENTITY),
        NESTED_MAX,
        &mut pieces,
    );
    pieces
}

/// Adds the pieces of a shape that stands somewhere and is turned.
fn collect(shape: &Shape, (at, turn): (DVec3, DQuat), depth: usize, pieces: &mut Vec<Piece>) {
    if let Shape::Compound(parts) = shape {
        if depth > 0 {
            for part in parts.iter() {
                let within = turn * part.attitude.quat();
                let place = (at + turn * part.offset_m, within.normalize());
                collect(&part.shape, place, depth - 1, pieces);
            }
        }
        return;
    }
    pieces.extend(form_of(shape).map(|form| Piece::new(form, at.to_array(), turn)));
}

/// What one shape looks like; `None` for what has no outline of its own.
fn form_of(shape: &Shape) -> Option<Form> {
    Some(match shape {
        Shape::Sphere { radius_m } => Form::Sphere {
            radius_m: *radius_m,
        },
        Shape::Box { half_m } => Form::Box {
            half_m: half_m.to_array(),
        },
        Shape::Cylinder {
            radius_m,
            half_height_m,
        } => Form::Cylinder {
            radius_m: *radius_m,
            top_m: *radius_m,
            half_height_m: *half_height_m,
        },
        Shape::Cone {
            radius_m,
            half_height_m,
        } => Form::Cylinder {
            radius_m: *radius_m,
            top_m: 0.0,
            half_height_m: *half_height_m,
        },
        Shape::Capsule {
            radius_m,
            half_height_m,
        } => Form::Capsule {
            radius_m: *radius_m,
            half_height_m: *half_height_m,
        },
        Shape::Plane => {
            let p = PLANE_HALF_M;
            Form::Mesh {
                points_m: [[-p, -p, 0.0], [p, -p, 0.0], [p, p, 0.0], [-p, p, 0.0]].into(),
                triangles: [[0, 1, 2], [0, 2, 3]].into(),
            }
        }
        Shape::Hull(hull) => thin::of_mesh(&hull.surface()?, TRIANGLES_MAX),
        Shape::Mesh(mesh) => thin::of_mesh(mesh, TRIANGLES_MAX),
        Shape::HeightField(field) => thin::of_field(field),
        _ => return None,
    })
}

/// The meshes of a world, each made once for all that share it.
struct Meshes {
    made: BTreeMap<(usize, usize), Option<Form>>,
    /// How many triangles each may have.
    triangles_max: usize,
}

impl Meshes {
    fn new(objects: &[Object<'_>]) -> Self {
        let solids = objects.iter().flat_map(|object| &object.solids);
        let mut sizes = BTreeMap::new();
        for solid in solids {
            if let SolidShape::Mesh { triangles, .. } = &solid.shape {
                sizes.insert(
                    Arc::as_ptr(triangles).cast::<u8>() as usize,
                    triangles.len(),
                );
            }
        }
        let all: usize = sizes.values().sum();
        let each = match all > WORLD_TRIANGLES_MAX {
            true => WORLD_TRIANGLES_MAX / sizes.len(),
            false => TRIANGLES_MAX,
        };
        Self {
            made: BTreeMap::new(),
            triangles_max: each.clamp(MESH_TRIANGLES_LEAST, TRIANGLES_MAX),
        }
    }

    fn pieces(&mut self, solid: &Solid) -> Option<Piece> {
        let triangles_max = self.triangles_max;
        let make = || match objects::shape(solid) {
            Shape::Mesh(mesh) => Some(thin::of_mesh(&mesh, triangles_max)),
            other => form_of(&other),
        };
        // Shared lists are told apart by where they lie: the world outlives this.
        let key = match &solid.shape {
            SolidShape::Hull { points } => Some((address(points), 0)),
            SolidShape::Mesh { points, triangles } => Some((address(points), address(triangles))),
            _ => None,
        };
        let form = match key {
            Some(key) => match self.made.get(&key) {
                Some(form) => form.clone(),
                None => {
                    let form = make();
                    self.made.insert(key, form.clone());
                    form
                }
            },
            None => make(),
        };
        let center = solid.center.si().to_array();
        form.map(|form| Piece::new(form, center, solid.attitude.quat()))
    }
}

fn address<T>(list: &Arc<[T]>) -> usize {
    list.as_ptr().addr()
}

fn lamp(light: &Light) -> Prop {
    let mut meta = vec![("intensity".to_owned(), light.intensity.to_string())];
    if let Some(beam) = &light.beam {
        meta.push(("half_angle".to_owned(), beam.half_angle.to_string()));
    }
    Prop {
        kind: "light".to_owned(),
        label: light.label.clone(),
        color: rgba(light.color),
        pieces: vec![ball(
            light.radius.get().max(LAMP_M),
            light.position.si().to_array(),
        )],
        meta,
        ..Prop::default()
    }
}

fn source(source: &Source) -> Prop {
    let label = match source.label.as_str() {
        "" => source.gas.clone(),
        label => format!("{label} ({})", source.gas),
    };
    let meta = [
        ("gas", source.gas.clone()),
        ("rate", source.rate.to_string()),
    ];
    Prop {
        kind: "source".to_owned(),
        label,
        color: GAS,
        pieces: vec![ball(
            source.radius.get().max(SOURCE_M),
            source.position.si().to_array(),
        )],
        meta: meta.map(|(key, value)| (key.to_owned(), value)).into(),
        ..Prop::default()
    }
}

fn ball(radius_m: f64, position_m: [f64; 3]) -> Piece {
    Piece::new(Form::Sphere { radius_m }, position_m, DQuat::IDENTITY)
}

fn rgba(color: Color) -> [u8; 4] {
    [color.red, color.green, color.blue, color.alpha]
}

#[cfg(test)]
mod tests {
    use super::super::triangles::tests::volume;
    use super::*;
    use simbeeotic_model::physics::{Hull, Part};
    use simbeeotic_model::units::{Angle, Attitude, Length, Offset, Position, Yaw};
    use simbeeotic_model::world::{HeightField, Mesh, Obstacle, ObstacleShape, Terrain};

    fn cube() -> Vec<DVec3> {
        let at = |bit: u32| if bit == 0 { -0.5 } else { 0.5 };
        (0..8)
            .map(|k| DVec3::new(at(k & 1), at(k & 2), at(k & 4)))
            .collect()
    }

    #[test]
    fn a_hull_becomes_its_faces() {
        let mut points_m = cube();
        points_m.push(DVec3::new(0.1, 0.2, 0.1));
        let pieces = pieces_of(&Shape::Hull(Arc::new(Hull { points_m })));
        assert_eq!(pieces.len(), 1);
        let surface = pieces[0].form.triangles(8);
        assert_eq!((surface.points_m.len(), surface.triangles.len()), (8, 12));
        assert!((volume(&surface) - 1.0).abs() < 1e-6);
        let flat = Hull {
            points_m: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        };
        assert_eq!(pieces_of(&Shape::Hull(Arc::new(flat))), []);
    }

    #[test]
    fn parts_within_parts_stand_where_their_compounds_put_them() {
        let quarter = Attitude::from_yaw(Yaw::new(Angle::from_turns(0.25)));
        let part = |offset_m, attitude, shape| Part {
            offset_m,
            attitude,
            shape,
        };
        let bar = Shape::Box {
            half_m: DVec3::new(1.0, 0.1, 0.1),
        };
        let inner = Shape::Compound([part(DVec3::X, quarter, bar)].into());
        let outer = Shape::Compound(
            [
                part(DVec3::Z, quarter, inner),
                part(
                    DVec3::ZERO,
                    Attitude::IDENTITY,
                    Shape::Sphere { radius_m: 0.2 },
                ),
            ]
            .into(),
        );
        let pieces = pieces_of(&outer);
        assert_eq!(pieces.len(), 2);
        // A quarter turn takes x to y; two take the bar's x to -x.
        let at = DVec3::from_array(pieces[0].position_m);
        assert!((at - DVec3::new(0.0, 1.0, 1.0)).length() < 1e-12, "{at}");
        assert!((pieces[0].turn() * DVec3::X + DVec3::X).length() < 1e-12);
        assert_eq!(pieces[1], Piece::at_origin(Form::Sphere { radius_m: 0.2 }));
    }

    #[test]
    fn a_compound_without_end_is_no_endless_loop() {
        let mut shape = Shape::Sphere { radius_m: 1.0 };
        for _ in 0..100 {
            shape = Shape::Compound(
                [Part {
                    offset_m: DVec3::ZERO,
                    attitude: Attitude::IDENTITY,
                    shape,
                }]
                .into(),
            );
        }
        assert_eq!(pieces_of(&shape), []);
    }

    #[test]
    fn everything_in_a_world_can_be_seen() {
        let offsets: Arc<[Offset]> = cube().into_iter().map(Offset::from_si).collect();
        let mesh = Mesh {
            points: offsets.clone(),
            triangles: [[0, 1, 2], [1, 3, 2]].into(),
            ..Mesh::default()
        };
        let hull = simbeeotic_model::world::Hull {
            points: offsets,
            ..Default::default()
        };
        let obstacle = |shape| Obstacle {
            shape,
            ..Obstacle::default()
        };
        let heights = vec![vec![Length::si(1.0); 3]; 4];
        let world = World {
            obstacles: vec![
                obstacle(ObstacleShape::Mesh(mesh.clone())),
                obstacle(ObstacleShape::Mesh(mesh)),
                obstacle(ObstacleShape::Hull(hull)),
            ],
            terrain: Some(Terrain::new(simbeeotic_model::world::HeightField {
                length: Length::si(8.0),
                width: Length::si(9.0),
                heights,
                ..HeightField::default()
            })),
            lights: vec![Light {
                position: Position::from_xyz(1.0, 2.0, 3.0),
                color: Color::rgb(1, 2, 3),
                ..Light::default()
            }],
            sources: vec![Source {
                gas: "linalool".to_owned(),
                ..Source::default()
            }],
            ..World::default()
        };
        let stage = Stage::of(&world, 1);
        let kinds: Vec<&str> = stage.props.iter().map(|prop| prop.kind.as_str()).collect();
        assert_eq!(
            kinds,
            [
                "obstacle", "obstacle", "obstacle", "terrain", "light", "source"
            ]
        );
        assert!(!stage.plane);
        assert!(stage.props.iter().all(|prop| prop.pieces.len() == 1));
        assert_eq!(stage.props[4].color, [1, 2, 3, 255]);
        assert_eq!(stage.props[5].label, "linalool");
        let shared = |k: usize| match &stage.props[k].pieces[0].form {
            Form::Mesh { points_m, .. } => Arc::as_ptr(points_m),
            other => panic!("{other:?}"),
        };
        assert_eq!(shared(0), shared(1), "one mesh, made once");
    }
}

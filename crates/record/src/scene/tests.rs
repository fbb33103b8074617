//! Stages come back as they were, and bent ones harm nobody.

use super::*;
use crate::message::{KeyValue, SceneEntity, SceneUpdate};
use crate::recorder::Precision;
use crate::stage::{Prop, Stage};
use proptest::prelude::*;
use prost::Message as _;
use simbeeotic_model as model;
use simbeeotic_model::units::glam::DQuat;
use simbeeotic_model::units::{Angle, Attitude, Mount, Offset, Yaw};

/// The order in which pieces come back.
fn rank(piece: &Piece) -> u8 {
    match piece.form {
        Form::Box { .. } => 0,
        Form::Sphere { .. } => 1,
        Form::Cylinder { .. } => 2,
        Form::Mesh { .. } => 3,
        Form::Capsule { .. } => 4,
    }
}

fn form() -> impl Strategy<Value = Form> {
    // Multiples of a power of two: half and double, and ratios of two of them, are exact.
    let metres = || (1..64_u32).prop_map(|n| f64::from(n) / 16.0);
    let power = || (0..6_u32).prop_map(|n| f64::from(1_u32 << n) / 8.0);
    prop_oneof![
        [metres(), metres(), metres()].prop_map(|half_m| Form::Box { half_m }),
        metres().prop_map(|radius_m| Form::Sphere { radius_m }),
        (power(), prop_oneof![Just(0.0), power()], metres()).prop_map(|(radius_m, top_m, h)| {
            Form::Cylinder {
                radius_m,
                top_m,
                half_height_m: h,
            }
        }),
        (metres(), metres()).prop_map(|(radius_m, half_height_m)| Form::Capsule {
            radius_m,
            half_height_m,
        }),
        metres().prop_map(|radius_m| Form::Sphere { radius_m }.triangles(5).into()),
    ]
}

fn any_piece() -> impl Strategy<Value = Piece> {
    (
        form(),
        [-1e3..1e3, -1e3..1e3, -1e3..1e3],
        [-1.0..1.0, -1.0..1.0, 0.1..1.0],
    )
        .prop_map(|(form, at, [x, y, w])| {
            Piece::new(form, at, DQuat::from_xyzw(x, y, 0.0, w).normalize())
        })
}

fn any_stage() -> impl Strategy<Value = Stage> {
    let prop =
        (0..3_u8, prop::collection::vec(any_piece(), 0..4)).prop_map(|(what, mut pieces)| {
            pieces.sort_by_key(rank);
            Prop {
                kind: ["obstacle", "flower", "kind"][usize::from(what)].to_owned(),
                label: ["", "a tower", "pieces"][usize::from(what)].to_owned(),
                color: [what, 255, 17, 128],
                texture: ["", "brick", "./wood"][usize::from(what)].to_owned(),
                pieces,
                meta: vec![("kind".to_owned(), "of its own".to_owned()); usize::from(what)],
            }
        });
    (
        any::<[u8; 4]>(),
        prop_oneof![Just(""), Just("grass"), Just("./wood")],
        0.0..1e5,
        any::<bool>(),
        prop::collection::vec(prop, 0..12),
    )
        .prop_map(|(ground, texture, radius_m, plane, props)| Stage {
            ground,
            texture: texture.to_owned(),
            radius_m,
            plane,
            props,
        })
}

proptest! {
    #[test]
    fn a_stage_comes_back_as_it_was(stage in any_stage()) {
        let bytes = scene_of(&stage, Precision::Full).encode_to_vec();
        let scene = SceneUpdate::decode(&bytes[..]).expect("as written");
        prop_assert_eq!(stage_of(&scene), stage);
    }

    #[test]
    fn fine_is_within_a_micrometre(stage in any_stage()) {
        let back = stage_of(&scene_of(&stage, Precision::Fine));
        let pieces = |stage: &Stage| -> Vec<Piece> {
            stage.props.iter().flat_map(|prop| prop.pieces.clone()).collect()
        };
        for (a, b) in pieces(&stage).iter().zip(&pieces(&back)) {
            prop_assert!((a.origin() - b.origin()).length() < 1e-6);
            prop_assert_eq!(&a.form, &b.form);
        }
        prop_assert_eq!(back.props.len(), stage.props.len());
    }

    #[test]
    fn a_look_comes_back_as_it_was(mut pieces in prop::collection::vec(any_piece(), 0..5)) {
        pieces.sort_by_key(rank);
        let back = pieces_of_look(&look_of(&pieces, Precision::Full));
        prop_assert_eq!(&back[..], &pieces[..]);
    }

    #[test]
    fn bent_scenes_never_panic(
        stage in any_stage(),
        text in "[a-z]{5,6}=[0-9]{1,20}( [a-z]{5,9}=[0-9]{1,20}){0,5}",
        flip in any::<(prop::sample::Index, u8)>(),
        drop in any::<prop::sample::Index>(),
    ) {
        let mut scene = scene_of(&stage, Precision::Full);
        let which = drop.index(scene.entities.len());
        let entity = &mut scene.entities[which];
        entity.spheres.pop();
        if let Some(list) = entity.triangles.first_mut() {
            list.points.pop();
        }
        if let Some(pair) = entity.metadata.get_mut(4) {
            pair.value = text;
        }
        stage_of(&scene);
        pieces_of_look(&scene.entities[which]);
        let mut bytes = scene.encode_to_vec();
        *flip.0.get_mut(&mut bytes) ^= flip.1;
        if let Ok(scene) = SceneUpdate::decode(&bytes[..]) {
            let stage = stage_of(&scene);
            let _ = stage.bounds();
        }
    }
}

#[test]
fn flowers_of_a_patch_are_one_entity() {
    let flower = |x: f64| Prop {
        kind: "flower".to_owned(),
        pieces: vec![Piece::new(
            Form::Sphere { radius_m: 0.5 },
            [x, 0.0, 0.0],
            DQuat::IDENTITY,
        )],
        ..Prop::default()
    };
    let mut other = flower(0.5);
    other.label = "rose".to_owned();
    let mut props: Vec<Prop> = (0..1000).map(|k| flower(f64::from(k))).collect();
    props.extend([other, flower(7.0)]);
    let stage = Stage {
        props,
        ..Stage::default()
    };
    let scene = scene_of(&stage, Precision::Full);
    let ids: Vec<&str> = scene.entities.iter().map(|e| e.id.as_str()).collect();
    assert_eq!(ids, ["ground", "flower 1", "flower 2 rose", "flower 3"]);
    assert_eq!(scene.entities[1].spheres.len(), 1000);
    assert_eq!(stage_of(&scene), stage);
}

#[test]
fn meshes_beyond_all_measure_are_boxes() {
    let ball: Form = Form::Sphere { radius_m: 2.0 }.triangles(256).into();
    let Form::Mesh { triangles, .. } = &ball else {
        panic!("a mesh")
    };
    let count = 2_000_000 / triangles.len();
    let prop = Prop {
        pieces: vec![Piece::at_origin(ball.clone()); count + 2],
        ..Prop::default()
    };
    let stage = Stage {
        props: vec![prop],
        ..Stage::default()
    };
    let back = stage_of(&scene_of(&stage, Precision::Full));
    let pieces = &back.props[0].pieces;
    assert_eq!(pieces.len(), count + 2);
    assert_eq!(pieces[count - 1].form, ball);
    let surface = pieces[count].form.triangles(8);
    assert_eq!(surface.triangles.len(), 12);
    assert_eq!(pieces[count].bounds(), pieces[0].bounds());
}

#[test]
fn scenes_of_somebody_else_are_shown_as_far_as_they_are_understood() {
    let mut scene = scene_of(&Stage::default(), Precision::Full);
    let look = look_of(
        &[Piece::at_origin(Form::Sphere { radius_m: 1.0 })],
        Precision::Full,
    );
    scene.entities = vec![SceneEntity {
        id: "a thing".to_owned(),
        metadata: vec![KeyValue {
            key: "from".to_owned(),
            value: "elsewhere".to_owned(),
        }],
        ..look
    }];
    let stage = stage_of(&scene);
    assert_eq!(stage.props.len(), 1);
    assert_eq!(stage.props[0].label, "a thing");
    assert_eq!(stage.props[0].pieces.len(), 1);
    assert_eq!(
        stage.props[0].meta,
        [("from".to_owned(), "elsewhere".to_owned())]
    );
}

#[test]
fn what_a_model_is_comes_back_but_for_the_numbers_of_radios() {
    let mount = Mount {
        position: Offset::from_xyz(0.1, 0.0, -0.02),
        attitude: Attitude::from_yaw(Yaw::new(Angle::from_degrees(33.0))),
    };
    let sensor = |name: &str, beams| model::AboutSensor {
        name: name.to_owned(),
        mount,
        beams,
    };
    let range_m = 4.0;
    let about = model::About {
        parts: vec![model::AboutPart {
            place: "model".to_owned(),
            name: "random-walk-bee".to_owned(),
            parameters: vec![("max_speed".to_owned(), "2 m/s".to_owned())],
        }],
        sensors: vec![
            sensor("compass", None),
            sensor(
                "lidar",
                Some(model::Beams::Rays {
                    directions: vec![[1.0, 0.0, 0.0], [0.0, 0.6, 0.8]],
                    range_m,
                }),
            ),
            sensor(
                "camera",
                Some(model::Beams::Frustum {
                    horizontal_rad: 1.0,
                    vertical_rad: 0.5,
                    range_m,
                }),
            ),
            sensor(
                "range",
                Some(model::Beams::Cone {
                    half_angle_rad: 0.2,
                    range_m,
                }),
            ),
            sensor("neighbors", Some(model::Beams::Ball { range_m })),
        ],
        radios: vec![model::AboutRadio {
            name: "radio".to_owned(),
            id: None,
        }],
    };
    let models = vec!["bee-0".to_owned(), "bee-1".to_owned()];
    let mut numbered = about.clone();
    numbered.radios[0].id = Some(model::radio::RadioId(7));
    assert_eq!(
        unpack_about(pack_about(&models, &numbered)),
        (models, about)
    );
}

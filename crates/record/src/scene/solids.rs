//! A stage as a URDF, in the one message that Rerun builds solids from.
//!
//! Rerun reads no scenes, but the description of a robot, which ROS 2 sends as text: a link `world` that stands
//! still, with a visual for each piece. A URDF knows boxes, cylinders and balls. A cone is a stack of cylinders;
//! meshes would be files of their own, and are left to the points of the world. Each visual is something of its
//! own to the viewer, which slows down beyond some thousands, so of many the largest are said.

use super::pack::{ground_of, hex};
use crate::stage::{Form, Piece, Stage};
use simbeeotic_model::units::glam::{DMat3, DQuat, DVec3};
use simbeeotic_model::units::math;
use std::fmt::Write;

/// The name of the message, and what is in it.
pub(crate) const STRING: &str = "std_msgs/msg/String";
pub(crate) const STRING_FIELDS: &[u8] = b"string data\n";

/// Visuals that are said at most.
const VISUALS_MAX: usize = 1_000;

/// Cylinders of a cone.
const STEPS: u32 = 6;

/// One visual: what it is, where, and its colour.
struct Visual {
    shape: Shape,
    at: DVec3,
    turn: DQuat,
    rgba: [u8; 4],
}

/// What a URDF knows, in m.
enum Shape {
    Box(DVec3),
    Cylinder { radius: f64, length: f64 },
    Sphere { radius: f64 },
}

/// The message of a stage, as ROS 2 writes text (CDR, least byte first); `None` if nothing stands on it that
/// a URDF can say.
pub(crate) fn solids_of(stage: &Stage) -> Option<Vec<u8>> {
    let mut pieces: Vec<(&Piece, [u8; 4])> = (stage.props.iter())
        .flat_map(|prop| prop.pieces.iter().map(|piece| (piece, prop.color)))
        .filter(|(piece, _)| !matches!(piece.form, Form::Mesh { .. }))
        .collect();
    // The largest first; of equals the first of the stage.
    pieces.sort_by(|(a, _), (b, _)| size(b).total_cmp(&size(a)));
    let ground = ground_of(stage).map(|half| Visual {
        shape: Shape::Box(half * 2.0),
        at: DVec3::new(0.0, 0.0, -half.z),
        turn: DQuat::IDENTITY,
        rgba: stage.ground,
    });
    let mut visuals: Vec<Visual> = ground.into_iter().collect();
    for (piece, rgba) in pieces {
        let before = visuals.len();
        add(&mut visuals, piece, rgba);
        if visuals.len() > VISUALS_MAX {
            visuals.truncate(before);
            break;
        }
    }
    (!visuals.is_empty()).then(|| message(&urdf(&visuals)))
}

/// The diagonal of the box around a piece, m.
fn size(piece: &Piece) -> f64 {
    let bounds = piece.bounds().unwrap_or_default();
    let [least, most] = bounds.map(DVec3::from_array);
    (most - least).length()
}

fn add(visuals: &mut Vec<Visual>, piece: &Piece, rgba: [u8; 4]) {
    let (origin, turn) = (piece.origin(), piece.turn());
    let mut push = |shape, along: f64| {
        visuals.push(Visual {
            shape,
            at: origin + turn * DVec3::new(0.0, 0.0, along),
            turn,
            rgba,
        });
    };
    match &piece.form {
        Form::Box { half_m } => push(Shape::Box(DVec3::from_array(*half_m) * 2.0), 0.0),
        Form::Sphere { radius_m } => push(Shape::Sphere { radius: *radius_m }, 0.0),
        Form::Capsule {
            radius_m,
            half_height_m,
        } => {
            let (radius, length) = (*radius_m, 2.0 * half_height_m);
            push(Shape::Cylinder { radius, length }, 0.0);
            push(Shape::Sphere { radius }, -half_height_m);
            push(Shape::Sphere { radius }, *half_height_m);
        }
        Form::Cylinder {
            radius_m,
            top_m,
            half_height_m,
        } if radius_m == top_m => {
            let length = 2.0 * half_height_m;
            push(
                Shape::Cylinder {
                    radius: *radius_m,
                    length,
                },
                0.0,
            );
        }
        Form::Cylinder {
            radius_m,
            top_m,
            half_height_m,
        } => {
            let length = 2.0 * half_height_m / f64::from(STEPS);
            for step in 0..STEPS {
                // As wide as the cone is in the middle of the step.
                let up = (f64::from(step) + 0.5) / f64::from(STEPS);
                let radius = radius_m + (top_m - radius_m) * up;
                let along = (2.0 * up - 1.0) * half_height_m;
                push(Shape::Cylinder { radius, length }, along);
            }
        }
        Form::Mesh { .. } => {}
    }
}

fn urdf(visuals: &[Visual]) -> String {
    let mut text =
        String::from("<?xml version=\"1.0\"?>\n<robot name=\"world\"><link name=\"world\">\n");
    for visual in visuals {
        let [x, y, z] = visual.at.to_array().map(short);
        let [roll, pitch, yaw] = roll_pitch_yaw(visual.turn).map(short);
        let shape = match &visual.shape {
            Shape::Box(size) => {
                let [x, y, z] = size.to_array().map(short);
                format!("<box size=\"{x} {y} {z}\"/>")
            }
            Shape::Cylinder { radius, length } => format!(
                "<cylinder radius=\"{}\" length=\"{}\"/>",
                short(*radius),
                short(*length)
            ),
            Shape::Sphere { radius } => format!("<sphere radius=\"{}\"/>", short(*radius)),
        };
        let [r, g, b, a] = visual.rgba.map(|c| short(f64::from(c) / 255.0));
        let name = hex(visual.rgba);
        // Writing to text cannot fail.
        let _ = writeln!(
            text,
            "<visual><origin xyz=\"{x} {y} {z}\" rpy=\"{roll} {pitch} {yaw}\"/><geometry>{shape}</geometry>\
             <material name=\"{name}\"><color rgba=\"{r} {g} {b} {a}\"/></material></visual>"
        );
    }
    text.push_str("</link></robot>\n");
    text
}

/// How far it turns about the world's x, then y, then z, rad.
fn roll_pitch_yaw(turn: DQuat) -> [f64; 3] {
    let axes = DMat3::from_quat(turn);
    let (forward, left, up) = (axes.x_axis, axes.y_axis, axes.z_axis);
    let level = forward.truncate().length();
    let pitch = math::atan2(-forward.z, level);
    if level < 1e-6 {
        // Nose straight up or down: roll and yaw turn about one axis, and yaw does it all.
        return [0.0, pitch, math::atan2(-left.x, left.y)];
    }
    [
        math::atan2(left.z, up.z),
        pitch,
        math::atan2(forward.y, forward.x),
    ]
}

/// To four digits behind the point: 0.1 mm, and 0.1 mrad. Nothing that is not finite, and no -0.
fn short(x: f64) -> f64 {
    let rounded = (x * 1e4).round() / 1e4;
    if rounded.is_finite() {
        rounded + 0.0
    } else {
        0.0
    }
}

/// `std_msgs/msg/String` in CDR: four bytes that say so, the length with the zero at the end, the text.
fn message(text: &str) -> Vec<u8> {
    let length = u32::try_from(text.len() + 1).unwrap_or(u32::MAX);
    let mut bytes = vec![0, 1, 0, 0];
    bytes.extend(length.to_le_bytes());
    bytes.extend(text.bytes());
    bytes.push(0);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::Prop;

    fn prop(forms: Vec<Form>) -> Prop {
        let at = |(number, form)| Piece::new(form, [number as f64, 2.0, 3.0], DQuat::IDENTITY);
        Prop {
            color: [255, 0, 51, 255],
            pieces: forms.into_iter().enumerate().map(at).collect(),
            ..Prop::default()
        }
    }

    fn text_of(stage: &Stage) -> String {
        let bytes = solids_of(stage).expect("it has solids");
        let (head, text) = bytes.split_at(8);
        assert_eq!(head[..4], [0, 1, 0, 0]);
        let length = u32::from_le_bytes([head[4], head[5], head[6], head[7]]);
        assert_eq!(length as usize, text.len());
        let (end, text) = text.split_last().expect("text");
        assert_eq!(*end, 0);
        String::from_utf8(text.to_vec()).expect("text")
    }

    #[test]
    fn each_form_is_said_by_what_a_urdf_knows() {
        let cone = Form::Cylinder {
            radius_m: 1.2,
            top_m: 0.0,
            half_height_m: 3.0,
        };
        let stage = Stage {
            plane: true,
            radius_m: 100.0,
            props: vec![prop(vec![
                Form::Box {
                    half_m: [1.0, 2.0, 0.5],
                },
                Form::Sphere { radius_m: 0.8 },
                Form::Cylinder {
                    radius_m: 0.5,
                    top_m: 0.5,
                    half_height_m: 2.0,
                },
                Form::Capsule {
                    radius_m: 0.3,
                    half_height_m: 1.0,
                },
                cone,
                Form::Sphere { radius_m: 1.0 }.triangles(9).into(),
            ])],
            ..Stage::default()
        };
        let text = text_of(&stage);
        let count = |what: &str| text.matches(what).count();
        assert_eq!(count("<visual>"), 1 + 1 + 1 + 1 + 3 + 6, "{text}");
        assert_eq!(count("<box size=\"2 4 1\"/>"), 1);
        assert_eq!(count("<box size=\"100 100 0.02\"/>"), 1);
        assert_eq!(count("<sphere radius=\"0.8\"/>"), 1);
        assert_eq!(count("<sphere radius=\"0.3\"/>"), 2);
        assert_eq!(count("<cylinder radius=\"0.5\" length=\"4\"/>"), 1);
        // The lowest step of the cone: 1/12 up, 2.5 m below its middle.
        assert_eq!(count("xyz=\"4 2 0.5\""), 1, "{text}");
        assert_eq!(count("<cylinder radius=\"1.1\" length=\"1\"/>"), 1);
        assert_eq!(count("rgba=\"1 0 0.2 1\""), 12);
    }

    #[test]
    fn roll_pitch_and_yaw_turn_as_the_quaternion_does() {
        let about = |axis: DVec3, angle: f64| {
            let (sin, cos) = (math::sin(0.5 * angle), math::cos(0.5 * angle));
            DQuat::from_xyzw(axis.x * sin, axis.y * sin, axis.z * sin, cos)
        };
        let straight_up = about(DVec3::Y, -std::f64::consts::FRAC_PI_2);
        for turn in [
            DQuat::IDENTITY,
            about(DVec3::Z, 2.5),
            DQuat::from_xyzw(0.3, -0.5, 0.2, 0.7).normalize(),
            DQuat::from_xyzw(-0.9, 0.1, 0.4, -0.2).normalize(),
            straight_up,
            about(DVec3::Z, 0.7) * straight_up * about(DVec3::X, 0.4),
        ] {
            let [roll, pitch, yaw] = roll_pitch_yaw(turn);
            let again = about(DVec3::Z, yaw) * about(DVec3::Y, pitch) * about(DVec3::X, roll);
            assert!(again.dot(turn).abs() > 1.0 - 1e-9, "{turn} is not {again}");
        }
    }

    #[test]
    fn of_more_pieces_than_viewers_bear_the_largest_are_said() {
        let balls = (0..3_000).map(|number| Form::Sphere {
            radius_m: 1.0 + f64::from(number % 7) + f64::from(number) * 1e-3,
        });
        let stage = Stage {
            props: vec![prop(balls.collect())],
            ..Stage::default()
        };
        let text = text_of(&stage);
        assert_eq!(text.matches("<visual>").count(), VISUALS_MAX);
        assert!(text.contains("radius=\"9.995\""), "the largest");
        assert!(!text.contains("radius=\"1\""), "the smallest");
    }

    #[test]
    fn a_stage_of_meshes_alone_says_nothing() {
        let mesh = Form::Sphere { radius_m: 1.0 }.triangles(9).into();
        let stage = Stage {
            props: vec![prop(vec![mesh])],
            ..Stage::default()
        };
        assert_eq!(solids_of(&stage), None);
        assert_eq!(solids_of(&Stage::default()), None);
    }
}

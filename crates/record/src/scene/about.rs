//! What is known about models, as messages and back.

use super::pack::pair;
use crate::message::{About, AboutBeams, AboutPart, AboutSensor, Pose, Quaternion, Vector3};
use simbeeotic_model as model;
use simbeeotic_model::Beams;
use simbeeotic_model::units::{Attitude, Mount, Offset};

/// What all these models are.
pub(crate) fn pack_about(models: &[String], about: &model::About) -> About {
    About {
        models: models.to_vec(),
        parts: about.parts.iter().map(part).collect(),
        sensors: about.sensors.iter().map(sensor).collect(),
        radios: about
            .radios
            .iter()
            .map(|radio| radio.name.clone())
            .collect(),
    }
}

fn part(part: &model::AboutPart) -> AboutPart {
    AboutPart {
        place: part.place.clone(),
        name: part.name.clone(),
        parameters: (part.parameters.iter())
            .map(|(key, value)| pair(key, value))
            .collect(),
    }
}

fn sensor(sensor: &model::AboutSensor) -> AboutSensor {
    let (at, turn) = (sensor.mount.position.si(), sensor.mount.attitude.quat());
    AboutSensor {
        name: sensor.name.clone(),
        mount: Some(Pose {
            position: Some(Vector3 {
                x: at.x,
                y: at.y,
                z: at.z,
            }),
            orientation: Some(Quaternion {
                x: turn.x,
                y: turn.y,
                z: turn.z,
                w: turn.w,
            }),
        }),
        beams: sensor.beams.as_ref().map(beams),
    }
}

fn beams(beams: &Beams) -> AboutBeams {
    let of = |kind: &str, range_m: &f64| AboutBeams {
        kind: kind.to_owned(),
        range_m: *range_m,
        ..AboutBeams::default()
    };
    match beams {
        Beams::Rays {
            directions,
            range_m,
        } => AboutBeams {
            directions: directions.as_flattened().to_vec(),
            ..of("rays", range_m)
        },
        Beams::Cone {
            half_angle_rad,
            range_m,
        } => AboutBeams {
            half_angle_rad: *half_angle_rad,
            ..of("cone", range_m)
        },
        Beams::Frustum {
            horizontal_rad,
            vertical_rad,
            range_m,
        } => AboutBeams {
            horizontal_rad: *horizontal_rad,
            vertical_rad: *vertical_rad,
            ..of("frustum", range_m)
        },
        Beams::Ball { range_m } => of("ball", range_m),
    }
}

/// The models, and what they are. Radios have no numbers.
pub(crate) fn unpack_about(about: About) -> (Vec<String>, model::About) {
    let parts = about.parts.into_iter().map(|part| model::AboutPart {
        place: part.place,
        name: part.name,
        parameters: (part.parameters.into_iter())
            .map(|pair| (pair.key, pair.value))
            .collect(),
    });
    let sensors = about.sensors.into_iter().map(|sensor| model::AboutSensor {
        name: sensor.name,
        mount: mount(sensor.mount.unwrap_or_default()),
        beams: sensor.beams.and_then(beams_of),
    });
    let radios = (about.radios.into_iter()).map(|name| model::AboutRadio { name, id: None });
    let back = model::About {
        parts: parts.collect(),
        sensors: sensors.collect(),
        radios: radios.collect(),
    };
    (about.models, back)
}

fn mount(pose: Pose) -> Mount {
    let at = pose.position.unwrap_or_default();
    let q = pose.orientation.unwrap_or_default();
    let attitude = match [q.w, q.x, q.y, q.z] {
        [w, x, y, z] if (w * w + x * x + y * y + z * z - 1.0).abs() < 1e-9 => {
            // As it was: normalizing again could change the last bit.
            Attitude::from_unit_quat(model::units::glam::DQuat::from_xyzw(x, y, z, w))
        }
        [w, x, y, z] => Attitude::from_wxyz(w, x, y, z).unwrap_or_default(),
    };
    Mount {
        position: Offset::from_xyz(at.x, at.y, at.z),
        attitude,
    }
}

/// `None` for beams of a kind that this version does not know.
fn beams_of(beams: AboutBeams) -> Option<Beams> {
    let range_m = beams.range_m;
    Some(match beams.kind.as_str() {
        "rays" => Beams::Rays {
            directions: beams.directions.as_chunks::<3>().0.to_vec(),
            range_m,
        },
        "cone" => Beams::Cone {
            half_angle_rad: beams.half_angle_rad,
            range_m,
        },
        "frustum" => Beams::Frustum {
            horizontal_rad: beams.horizontal_rad,
            vertical_rad: beams.vertical_rad,
            range_m,
        },
        "ball" => Beams::Ball { range_m },
        _ => return None,
    })
}

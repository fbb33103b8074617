//! What Foxglove's scenes and point clouds mean, and those of our messages that use them. Fields that we never
//! write are described too: readers of these well-known types may ask for them.

use super::known::{POSE, TIME, VECTOR3};
use super::{Enum, Kind, Type, many, one};

static DURATION: Type = Type {
    package: "google.protobuf",
    name: "Duration",
    fields: &[one("seconds", 1, Kind::Int64), one("nanos", 2, Kind::Int32)],
};

static COLOR: Type = Type {
    package: "foxglove",
    name: "Color",
    fields: &[
        one("r", 1, Kind::Double),
        one("g", 2, Kind::Double),
        one("b", 3, Kind::Double),
        one("a", 4, Kind::Double),
    ],
};

static KEY_VALUE: Type = Type {
    package: "foxglove",
    name: "KeyValuePair",
    fields: &[one("key", 1, Kind::Text), one("value", 2, Kind::Text)],
};

static POINT3: Type = Type {
    package: "foxglove",
    name: "Point3",
    fields: &[
        one("x", 1, Kind::Double),
        one("y", 2, Kind::Double),
        one("z", 3, Kind::Double),
    ],
};

static ARROW: Type = Type {
    package: "foxglove",
    name: "ArrowPrimitive",
    fields: &[
        one("pose", 1, Kind::Message(&POSE)),
        one("shaft_length", 2, Kind::Double),
        one("shaft_diameter", 3, Kind::Double),
        one("head_length", 4, Kind::Double),
        one("head_diameter", 5, Kind::Double),
        one("color", 6, Kind::Message(&COLOR)),
    ],
};

static CUBE: Type = Type {
    package: "foxglove",
    name: "CubePrimitive",
    fields: &[
        one("pose", 1, Kind::Message(&POSE)),
        one("size", 2, Kind::Message(&VECTOR3)),
        one("color", 3, Kind::Message(&COLOR)),
    ],
};

static SPHERE: Type = Type {
    package: "foxglove",
    name: "SpherePrimitive",
    fields: &[
        one("pose", 1, Kind::Message(&POSE)),
        one("size", 2, Kind::Message(&VECTOR3)),
        one("color", 3, Kind::Message(&COLOR)),
    ],
};

static CYLINDER: Type = Type {
    package: "foxglove",
    name: "CylinderPrimitive",
    fields: &[
        one("pose", 1, Kind::Message(&POSE)),
        one("size", 2, Kind::Message(&VECTOR3)),
        one("bottom_scale", 3, Kind::Double),
        one("top_scale", 4, Kind::Double),
        one("color", 5, Kind::Message(&COLOR)),
    ],
};

static LINE: Type = Type {
    package: "foxglove",
    name: "LinePrimitive",
    fields: &[
        one(
            "type",
            1,
            Kind::Enum(&Enum {
                name: "Type",
                values: &["LINE_STRIP", "LINE_LOOP", "LINE_LIST"],
            }),
        ),
        one("pose", 2, Kind::Message(&POSE)),
        one("thickness", 3, Kind::Double),
        one("scale_invariant", 4, Kind::Bool),
        many("points", 5, Kind::Message(&POINT3)),
        one("color", 6, Kind::Message(&COLOR)),
        many("colors", 7, Kind::Message(&COLOR)),
        many("indices", 8, Kind::Fixed32),
    ],
};

static TRIANGLES: Type = Type {
    package: "foxglove",
    name: "TriangleListPrimitive",
    fields: &[
        one("pose", 1, Kind::Message(&POSE)),
        many("points", 2, Kind::Message(&POINT3)),
        one("color", 3, Kind::Message(&COLOR)),
        many("colors", 4, Kind::Message(&COLOR)),
        many("indices", 5, Kind::Fixed32),
    ],
};

static TEXT: Type = Type {
    package: "foxglove",
    name: "TextPrimitive",
    fields: &[
        one("pose", 1, Kind::Message(&POSE)),
        one("billboard", 2, Kind::Bool),
        one("font_size", 3, Kind::Double),
        one("scale_invariant", 4, Kind::Bool),
        one("color", 5, Kind::Message(&COLOR)),
        one("text", 6, Kind::Text),
    ],
};

static MODEL: Type = Type {
    package: "foxglove",
    name: "ModelPrimitive",
    fields: &[
        one("pose", 1, Kind::Message(&POSE)),
        one("scale", 2, Kind::Message(&VECTOR3)),
        one("color", 3, Kind::Message(&COLOR)),
        one("override_color", 4, Kind::Bool),
        one("url", 5, Kind::Text),
        one("media_type", 6, Kind::Text),
        one("data", 7, Kind::Bytes),
    ],
};

static SCENE_ENTITY: Type = Type {
    package: "foxglove",
    name: "SceneEntity",
    fields: &[
        one("timestamp", 1, TIME),
        one("frame_id", 2, Kind::Text),
        one("id", 3, Kind::Text),
        one("lifetime", 4, Kind::Message(&DURATION)),
        one("frame_locked", 5, Kind::Bool),
        many("metadata", 6, Kind::Message(&KEY_VALUE)),
        many("arrows", 7, Kind::Message(&ARROW)),
        many("cubes", 8, Kind::Message(&CUBE)),
        many("spheres", 9, Kind::Message(&SPHERE)),
        many("cylinders", 10, Kind::Message(&CYLINDER)),
        many("lines", 11, Kind::Message(&LINE)),
        many("triangles", 12, Kind::Message(&TRIANGLES)),
        many("texts", 13, Kind::Message(&TEXT)),
        many("models", 14, Kind::Message(&MODEL)),
    ],
};

static DELETION: Type = Type {
    package: "foxglove",
    name: "SceneEntityDeletion",
    fields: &[
        one("timestamp", 1, TIME),
        one(
            "type",
            2,
            Kind::Enum(&Enum {
                name: "Type",
                values: &["MATCHING_ID", "ALL"],
            }),
        ),
        one("id", 3, Kind::Text),
    ],
};

pub(crate) static SCENE_UPDATE: Type = Type {
    package: "foxglove",
    name: "SceneUpdate",
    fields: &[
        many("deletions", 1, Kind::Message(&DELETION)),
        many("entities", 2, Kind::Message(&SCENE_ENTITY)),
    ],
};

static PACKED_FIELD: Type = Type {
    package: "foxglove",
    name: "PackedElementField",
    fields: &[
        one("name", 1, Kind::Text),
        one("offset", 2, Kind::Fixed32),
        one(
            "type",
            3,
            Kind::Enum(&Enum {
                name: "NumericType",
                values: &[
                    "UNKNOWN", "UINT8", "INT8", "UINT16", "INT16", "UINT32", "INT32", "FLOAT32",
                    "FLOAT64",
                ],
            }),
        ),
    ],
};

pub(crate) static POINT_CLOUD: Type = Type {
    package: "foxglove",
    name: "PointCloud",
    fields: &[
        one("timestamp", 1, TIME),
        one("frame_id", 2, Kind::Text),
        one("pose", 3, Kind::Message(&POSE)),
        one("point_stride", 4, Kind::Fixed32),
        many("fields", 5, Kind::Message(&PACKED_FIELD)),
        one("data", 6, Kind::Bytes),
    ],
};

pub(crate) static VEHICLES: Type = Type {
    package: "simbeeotic",
    name: "Vehicles",
    fields: &[
        many("paths", 1, Kind::Text),
        many("kinds", 2, Kind::Text),
        many("radius_m", 3, Kind::Double),
        many("roles", 4, Kind::Text),
        many("colors_rgba", 5, Kind::Fixed32),
        many("look", 6, Kind::Int32),
        many("looks", 7, Kind::Message(&SCENE_ENTITY)),
    ],
};

static ABOUT_PART: Type = Type {
    package: "simbeeotic",
    name: "AboutPart",
    fields: &[
        one("place", 1, Kind::Text),
        one("name", 2, Kind::Text),
        many("parameters", 3, Kind::Message(&KEY_VALUE)),
    ],
};

static ABOUT_BEAMS: Type = Type {
    package: "simbeeotic",
    name: "AboutBeams",
    fields: &[
        one("kind", 1, Kind::Text),
        one("range_m", 2, Kind::Double),
        many("directions", 3, Kind::Double),
        one("half_angle_rad", 4, Kind::Double),
        one("horizontal_rad", 5, Kind::Double),
        one("vertical_rad", 6, Kind::Double),
    ],
};

static ABOUT_SENSOR: Type = Type {
    package: "simbeeotic",
    name: "AboutSensor",
    fields: &[
        one("name", 1, Kind::Text),
        one("mount", 2, Kind::Message(&POSE)),
        one("beams", 3, Kind::Message(&ABOUT_BEAMS)),
    ],
};

pub(crate) static ABOUT: Type = Type {
    package: "simbeeotic",
    name: "About",
    fields: &[
        many("models", 1, Kind::Text),
        many("parts", 2, Kind::Message(&ABOUT_PART)),
        many("sensors", 3, Kind::Message(&ABOUT_SENSOR)),
        many("radios", 4, Kind::Text),
    ],
};

#[cfg(test)]
mod tests {
    use super::super::tests::{declared, keys};
    use super::*;
    use crate::message;
    use prost::Message;

    /// All numbers that a message can carry are written if they are not zero.
    #[test]
    fn the_schemas_describe_the_scenes_that_are_written() {
        let text = || "a".to_owned();
        let vector = message::Vector3 {
            x: 1.0,
            y: 2.0,
            z: 3.0,
        };
        let pose = Some(message::Pose {
            position: Some(vector),
            orientation: None,
        });
        let size = Some(vector);
        let timestamp = Some(message::Timestamp {
            seconds: 1,
            nanos: 1,
        });
        let all = message::Color {
            r: 0.1,
            g: 0.2,
            b: 0.3,
            a: 0.4,
        };
        let color = Some(all);
        let pair = message::KeyValue {
            key: text(),
            value: text(),
        };
        let cube = message::Cube { pose, size, color };
        let cylinder = message::Cylinder {
            pose,
            size,
            bottom_scale: 1.0,
            top_scale: 1.0,
            color,
        };
        let triangles = message::TriangleList {
            pose,
            points: vec![vector],
            color,
            indices: vec![1],
        };
        let entity = message::SceneEntity {
            timestamp,
            frame_id: text(),
            id: text(),
            metadata: vec![pair.clone()],
            cubes: vec![cube.clone()],
            spheres: vec![cube.clone()],
            cylinders: vec![cylinder.clone()],
            triangles: vec![triangles.clone()],
        };
        let update = message::SceneUpdate {
            entities: vec![entity.clone()],
        };
        let field = message::PackedField {
            name: text(),
            offset: 1,
            r#type: 1,
        };
        let cloud = message::PointCloud {
            timestamp,
            frame_id: text(),
            pose,
            point_stride: 1,
            fields: vec![field.clone()],
            data: vec![1],
        };
        let vehicles = message::Vehicles {
            paths: vec![text()],
            kinds: vec![text()],
            radius_m: vec![1.0],
            roles: vec![text()],
            colors_rgba: vec![1],
            look: vec![1],
            looks: vec![entity.clone()],
        };
        let part = message::AboutPart {
            place: text(),
            name: text(),
            parameters: vec![pair.clone()],
        };
        let beams = message::AboutBeams {
            kind: text(),
            range_m: 1.0,
            directions: vec![1.0],
            half_angle_rad: 1.0,
            horizontal_rad: 1.0,
            vertical_rad: 1.0,
        };
        let sensor = message::AboutSensor {
            name: text(),
            mount: pose,
            beams: Some(beams.clone()),
        };
        let about = message::About {
            models: vec![text()],
            parts: vec![part.clone()],
            sensors: vec![sensor.clone()],
            radios: vec![text()],
        };
        for (ty, bytes) in [
            (&COLOR, all.encode_to_vec()),
            (&POINT3, vector.encode_to_vec()),
            (&KEY_VALUE, pair.encode_to_vec()),
            (&CUBE, cube.encode_to_vec()),
            (&SPHERE, cube.encode_to_vec()),
            (&CYLINDER, cylinder.encode_to_vec()),
            (&TRIANGLES, triangles.encode_to_vec()),
            (&SCENE_ENTITY, entity.encode_to_vec()),
            (&SCENE_UPDATE, update.encode_to_vec()),
            (&PACKED_FIELD, field.encode_to_vec()),
            (&POINT_CLOUD, cloud.encode_to_vec()),
            (&VEHICLES, vehicles.encode_to_vec()),
            (&ABOUT_PART, part.encode_to_vec()),
            (&ABOUT_BEAMS, beams.encode_to_vec()),
            (&ABOUT_SENSOR, sensor.encode_to_vec()),
            (&ABOUT, about.encode_to_vec()),
        ] {
            let declared = declared(ty);
            let written = keys(&bytes);
            let unknown = written.iter().find(|key| !declared.contains(key));
            assert_eq!(unknown, None, "{}", ty.full_name());
            if ty.package == "simbeeotic" {
                assert_eq!(written, declared, "{}", ty.full_name());
            }
        }
    }

    /// Names, numbers and kinds of fields as Foxglove has them, from the descriptors of its SDK 0.30.3.
    #[test]
    fn fields_of_foxglove_have_its_numbers() {
        let number = |ty: &Type, name: &str| {
            let field = ty.fields.iter().find(|field| field.name == name);
            field.map(|field| field.number)
        };
        assert_eq!(number(&SCENE_ENTITY, "metadata"), Some(6));
        assert_eq!(number(&SCENE_ENTITY, "triangles"), Some(12));
        assert_eq!(number(&SCENE_ENTITY, "models"), Some(14));
        assert_eq!(number(&TRIANGLES, "indices"), Some(5));
        assert_eq!(number(&CYLINDER, "top_scale"), Some(4));
        assert_eq!(number(&POINT_CLOUD, "data"), Some(6));
        assert_eq!(number(&SCENE_UPDATE, "entities"), Some(2));
    }
}

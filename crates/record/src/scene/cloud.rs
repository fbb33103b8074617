//! Points on the surfaces of a stage, for viewers that show no scenes.

use crate::encoder::WORLD_FRAME;
use crate::message::{PackedField, PointCloud, Pose, Quaternion, Vector3};
use crate::stage::Stage;

/// How many points there are at most, and for each piece of few.
const POINTS_MAX: usize = 20_000;
const POINTS_LEAST: usize = 1_000;
const POINTS_A_PIECE: usize = 50;

/// Points lie on a grid of 1/256 m: noise below that would be most of their bytes.
const GRID: f32 = 256.0;

/// Bytes of a point: three floats, four bytes.
const STRIDE: u32 = 16;

/// `foxglove.PackedElementField.NumericType`
const UINT8: i32 = 1;
const FLOAT32: i32 = 7;

/// The cloud of a stage: 50 points for each piece, 1,000 at least and 20,000 at most; `None` if nothing stands on it.
pub(crate) fn cloud_of(stage: &Stage) -> Option<PointCloud> {
    let pieces: usize = stage.props.iter().map(|prop| prop.pieces.len()).sum();
    let wanted = pieces.saturating_mul(POINTS_A_PIECE);
    let points = stage.points(wanted.clamp(POINTS_LEAST, POINTS_MAX));
    if points.is_empty() {
        return None;
    }
    let mut data = Vec::with_capacity(points.len() * STRIDE as usize);
    for (point, rgba) in points {
        let rounded = point.map(|x| (x * GRID).round() / GRID);
        data.extend(rounded.iter().flat_map(|x| x.to_le_bytes()));
        data.extend(rgba);
    }
    let field = |name: &str, offset, r#type| PackedField {
        name: name.to_owned(),
        offset,
        r#type,
    };
    Some(PointCloud {
        timestamp: Some(Default::default()),
        frame_id: WORLD_FRAME.to_owned(),
        pose: Some(Pose {
            position: Some(Vector3::default()),
            orientation: Some(Quaternion {
                w: 1.0,
                ..Quaternion::default()
            }),
        }),
        point_stride: STRIDE,
        fields: vec![
            field("x", 0, FLOAT32),
            field("y", 4, FLOAT32),
            field("z", 8, FLOAT32),
            field("red", 12, UINT8),
            field("green", 13, UINT8),
            field("blue", 14, UINT8),
            field("alpha", 15, UINT8),
        ],
        data,
    })
}

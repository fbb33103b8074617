//! Points for viewers that show no scenes and draw nothing at poses: on the surfaces of a stage, and where
//! vehicles are.

use crate::data::{Sample, Vehicle};
use crate::encoder::WORLD_FRAME;
use crate::message::{PackedField, PointCloud, Pose, Quaternion, Vector3};
use crate::stage::Stage;

/// How many points there are at most, and for each piece of few.
const POINTS_MAX: usize = 20_000;
const POINTS_LEAST: usize = 1_000;
const POINTS_A_PIECE: usize = 50;

/// Points of a stage lie on a grid of 1/256 m: noise below that would be most of their bytes.
const GRID: f64 = 256.0;

/// And those of vehicles on one of 1/1024 m.
const GRID_OF_VEHICLES: f64 = 1024.0;

/// The colour of a vehicle that has none: red, green, blue, opacity.
const NO_COLOR: [u8; 4] = [0xf0, 0xb2, 0x1e, 0xff];

/// Bytes of a point: three floats, four bytes.
const STRIDE: usize = 16;

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
    let mut data = Vec::with_capacity(points.len() * STRIDE);
    for (point, rgba) in points {
        data.extend(place(point.map(f64::from), GRID));
        data.extend(rgba);
    }
    Some(cloud(data))
}

/// The cloud of vehicles, in their order and colours, all in the origin.
pub(crate) fn cloud_of_vehicles(vehicles: &[Vehicle]) -> PointCloud {
    let mut data = Vec::with_capacity(vehicles.len() * STRIDE);
    for vehicle in vehicles {
        data.extend(place([0.0; 3], GRID_OF_VEHICLES));
        data.extend(match vehicle.color {
            [.., 0] => NO_COLOR,
            color => color,
        });
    }
    cloud(data)
}

/// Moves the points of a cloud of vehicles to where these are now.
pub(crate) fn move_cloud(cloud: &mut PointCloud, samples: &[Sample]) {
    let (points, _) = cloud.data.as_chunks_mut::<STRIDE>();
    for (point, sample) in points.iter_mut().zip(samples) {
        let (at, _color) = point.split_at_mut(STRIDE - 4);
        at.copy_from_slice(&place(sample.position_m, GRID_OF_VEHICLES));
    }
}

/// A position on a grid, as its bytes in a cloud. What is not finite stays so.
fn place(position_m: [f64; 3], grid: f64) -> [u8; STRIDE - 4] {
    let [x, y, z] = position_m.map(|m| (((m * grid).round() / grid) as f32).to_le_bytes());
    let mut bytes = [0; STRIDE - 4];
    for (place, from) in bytes.as_chunks_mut::<4>().0.iter_mut().zip([x, y, z]) {
        *place = from;
    }
    bytes
}

fn cloud(data: Vec<u8>) -> PointCloud {
    let field = |name: &str, offset, r#type| PackedField {
        name: name.to_owned(),
        offset,
        r#type,
    };
    PointCloud {
        timestamp: Some(Default::default()),
        frame_id: WORLD_FRAME.to_owned(),
        pose: Some(Pose {
            position: Some(Vector3::default()),
            orientation: Some(Quaternion {
                w: 1.0,
                ..Quaternion::default()
            }),
        }),
        point_stride: STRIDE as u32,
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
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vehicles_are_points_in_their_colours_where_they_are() {
        let painted = Vehicle {
            color: [1, 2, 3, 200],
            ..Vehicle::default()
        };
        let mut cloud = cloud_of_vehicles(&[painted, Vehicle::default()]);
        let at = |position_m| Sample {
            position_m,
            ..Sample::default()
        };
        // On the grid, and off it by less than half of it.
        move_cloud(
            &mut cloud,
            &[at([1.5, -2.25, 100.0]), at([0.0004, f64::NAN, -1e6])],
        );
        let number = |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        let points: Vec<([f32; 3], &[u8])> = (cloud.data.chunks(STRIDE))
            .map(|p| {
                (
                    [number(&p[..4]), number(&p[4..]), number(&p[8..])],
                    &p[12..],
                )
            })
            .collect();
        assert_eq!(cloud.point_stride, 16);
        assert_eq!(points[0], ([1.5, -2.25, 100.0], &[1, 2, 3, 200][..]));
        assert_eq!((points[1].0[0], points[1].0[2]), (0.0, -1e6));
        assert!(points[1].0[1].is_nan());
        assert_eq!(points[1].1, NO_COLOR);
        assert_eq!(points.len(), 2);
    }
}

//! Where the beacons lie: a world made by rule, with an area to start in.

use simbeeotic::model::{Generator, generator};
use simbeeotic::prelude::*;
use simbeeotic::world::{Spawn, SpawnPose, SpawnShape, World};

/// A field with places for beacons: a square grid around the origin, which is left free for the hive.
///
/// The places are the area `beacons`, one for each beacon: `start = { area = "beacons" }` makes as many
/// models as there are places. So one number, `spacing`, says how many beacons there are.
#[generator("beacon-field")]
pub struct BeaconField;

/// Parameters of [`BeaconField`].
#[params]
pub struct BeaconFieldParams {
    /// Side of the field, above 0 m, to 10 km.
    pub side: Length,
    /// From one beacon to the next, above 0 m. There are at most 100,000 beacons.
    pub spacing: Length,
    /// Standard deviation of each coordinate of a place around its point of the grid: beacons that were
    /// dropped, not laid. 0 m to 10 km.
    pub scatter: Length,
    /// Which scatter.
    pub seed: u64,
}

impl Default for BeaconFieldParams {
    fn default() -> Self {
        Self {
            side: Length::si(120.0),
            spacing: Length::si(10.0),
            scatter: Length::ZERO,
            seed: 1,
        }
    }
}

impl Generator for BeaconField {
    type Params = BeaconFieldParams;

    fn generate(params: &BeaconFieldParams) -> Result<World, BuildError> {
        let highest = Length::si(10_000.0);
        positive("side", params.side)?;
        in_range("side", params.side, Length::ZERO..=highest)?;
        positive("spacing", params.spacing)?;
        in_range("scatter", params.scatter, Length::ZERO..=highest)?;
        let half = (0.5 * params.side.metres() / params.spacing.metres() + 1e-9).floor();
        if half > 150.0 {
            let message = "is so small that there are more than 301 beacons to a side";
            return Err(BuildError::parameter("spacing", message));
        }
        let half = half as i32;
        let mut stream = Stream::new(params.seed, "beacon-field", "scatter");
        let mut poses = Vec::new();
        for north in -half..=half {
            for east in -half..=half {
                let mut along = |cells: i32| {
                    params.spacing.metres() * f64::from(cells)
                        + params.scatter.metres() * stream.normal()
                };
                let position = Position::from_xyz(along(east), along(north), 0.0);
                if (east, north) != (0, 0) {
                    poses.push(SpawnPose {
                        position,
                        yaw: None,
                    });
                }
            }
        }
        if poses.is_empty() {
            let message = "is more than half of `side`: there is no place for a beacon";
            return Err(BuildError::parameter("spacing", message));
        }
        Ok(World {
            spawns: vec![Spawn {
                name: "beacons".to_owned(),
                shape: SpawnShape::Poses(poses),
                meta: Default::default(),
            }],
            ..World::default()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(spacing_m: f64, scatter_m: f64) -> Vec<Position> {
        let params = BeaconFieldParams {
            spacing: Length::si(spacing_m),
            scatter: Length::si(scatter_m),
            ..BeaconFieldParams::default()
        };
        let world = BeaconField::generate(&params).expect("a field");
        match &world.spawns[0].shape {
            SpawnShape::Poses(poses) => poses.iter().map(|pose| pose.position).collect(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn the_spacing_says_how_many_beacons_there_are() {
        for (spacing, side) in [(10.0, 13), (20.0, 7), (25.0, 5), (60.0, 3)] {
            assert_eq!(places(spacing, 0.0).len(), side * side - 1, "{spacing}");
        }
    }

    #[test]
    fn scatter_moves_them_and_the_hive_keeps_its_place() {
        let (laid, dropped) = (places(10.0, 0.0), places(10.0, 2.0));
        assert!(laid.iter().all(|place| place.length() > Length::si(9.0)));
        let moved: f64 = laid
            .iter()
            .zip(&dropped)
            .map(|(a, b)| (*a - *b).length().metres())
            .sum();
        assert!((1.5..4.0).contains(&(moved / laid.len() as f64)), "{moved}");
    }

    #[test]
    fn a_spacing_that_leaves_no_beacon_is_refused() {
        for spacing in [0.0, 0.01, 61.0] {
            let params = BeaconFieldParams {
                spacing: Length::si(spacing),
                ..Default::default()
            };
            let error = BeaconField::generate(&params)
                .expect_err("no field")
                .to_string();
            assert!(error.contains("`spacing`"), "{error}");
        }
    }
}

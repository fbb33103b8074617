//! What the picture has to show, and the camera that shows it.

use super::RenderError;
use super::camera::{Camera, Lens, Side, focal, from_bearing};
use super::choices::{Choices, Fit, View};
use super::colours::Extremes;
use super::swarm::Figure;
use simbeeotic_record::{Recording, Stage};
use simbeeotic_units::glam::DVec3;
use std::ops::RangeInclusive;

/// How much of the picture what there is may fill.
const FILL: f64 = 0.86;
/// Nothing is framed more closely than this, m.
pub(super) const CLOSE_M: f64 = 1.0;
/// Around one that is followed, so many of its radii are shown to each side.
const FOLLOWED: f64 = 14.0;
/// From the side: the share of the height left over that is ground.
const BELOW: f64 = 0.12;

/// From a point to the farthest corner of boxes, m.
pub(super) fn reach_m(from: DVec3, boxes: [Option<Box3>; 2]) -> f64 {
    let far = |[low, high]: Box3| (from - low).abs().max((from - high).abs()).length();
    boxes.into_iter().flatten().map(far).fold(0.0, f64::max)
}

pub(super) type Box3 = [DVec3; 2];

/// Where some vehicles were at one instant.
pub(super) struct Moment {
    pub(super) places_m: Vec<DVec3>,
    /// Of the one that is followed.
    pub(super) followed_m: Option<DVec3>,
}

impl Moment {
    /// Some of the places: enough to judge what is seen.
    pub(super) fn some(&self) -> impl Iterator<Item = DVec3> + '_ {
        let step = self.places_m.len().div_ceil(JUDGED).max(1);
        self.places_m.iter().step_by(step).copied()
    }
}

/// Instants that tell what the world hides, and vehicles at each; of these some are looked for.
const MOMENTS: usize = 8;
const POLLED: usize = 400;
const JUDGED: usize = 20;

/// What a range of time was found to be.
pub(super) struct Survey {
    /// The corners of the box in which all moves, m.
    pub(super) moving: Option<Box3>,
    pub(super) extremes: Extremes,
    /// Some instants of it, the earliest first.
    pub(super) moments: Vec<Moment>,
}

/// Where flyers (or, if there are none, all vehicles) are in a range of time, and how fast.
pub(super) fn survey(
    recording: &Recording,
    figures: &[Figure],
    followed: Option<usize>,
    times_ns: RangeInclusive<u64>,
) -> Result<Survey, RenderError> {
    let mut bounds: Option<Box3> = None;
    let mut extremes = Extremes {
        speed_m_s: 0.0,
        height_m: [f64::INFINITY, f64::NEG_INFINITY],
    };
    let any_flies = (figures.iter()).any(|figure| figure.shown && figure.flies());
    let counts = |figure: &Figure| figure.shown && (!any_flies || figure.flies());
    let each = figures.iter().filter(|figure| counts(figure)).count();
    let each = each.div_ceil(POLLED).max(1);
    let (mut moments, mut stride): (Vec<Moment>, usize) = (Vec::new(), 1);
    for (number, tick) in recording.ticks_in(*times_ns.start()..=u64::MAX).enumerate() {
        let tick = tick?;
        let mut places_m = Vec::new();
        let polled = number % stride == 0;
        let drawn = tick.samples.iter().zip(figures);
        for (place_of, (sample, _)) in drawn.filter(|(_, figure)| counts(figure)).enumerate() {
            let place = DVec3::from(sample.position_m);
            if !place.is_finite() {
                continue;
            }
            if polled && place_of % each == 0 {
                places_m.push(place);
            }
            let [low, high] = bounds.get_or_insert([place; 2]);
            (*low, *high) = (low.min(place), high.max(place));
            let [lowest, highest] = extremes.height_m;
            extremes.height_m = [lowest.min(place.z), highest.max(place.z)];
            let speed = DVec3::from(sample.velocity_m_s).length();
            extremes.speed_m_s = extremes.speed_m_s.max(speed);
        }
        if polled {
            // When there are too many, every other one goes.
            if moments.len() == MOMENTS {
                let mut places = 0..;
                moments.retain(|_| places.next().is_some_and(|at: usize| at.is_multiple_of(2)));
                stride *= 2;
            }
            if number % stride == 0 {
                let followed = followed.and_then(|at| tick.samples.get(at));
                let place = followed.map(|sample| DVec3::from(sample.position_m));
                moments.push(Moment {
                    places_m,
                    followed_m: place.filter(|place| place.is_finite()),
                });
            }
        }
        if tick.time_ns >= *times_ns.end() {
            break;
        }
    }
    if extremes.height_m[0] > extremes.height_m[1] {
        extremes.height_m = [0.0, 1.0];
    }
    Ok(Survey {
        moving: bounds,
        extremes,
        moments,
    })
}

/// The part of the world that the picture shows.
pub(super) struct Frame {
    /// Its corners, m.
    pub(super) box_m: Box3,
    /// Whether its lowest side is the ground.
    grounded: bool,
}

impl Frame {
    /// `moving`: where vehicles are; `all`: the whole world; `followed_radius_m`: of the one that stays in the middle.
    pub(super) fn new(
        choices: &Choices,
        stage: &Stage,
        moving: Option<Box3>,
        all: Option<Box3>,
        followed_radius_m: Option<f64>,
    ) -> Self {
        let wanted = match choices.fit {
            Fit::Swarm => moving.or(all),
            Fit::World => match (moving, all) {
                (Some(a), Some(b)) => Some([a[0].min(b[0]), a[1].max(b[1])]),
                (a, b) => a.or(b),
            },
        };
        let [mut low, high] = wanted.unwrap_or([DVec3::splat(-5.0), DVec3::splat(5.0)]);
        let around = |half: DVec3| {
            let middle = 0.5 * (low + high);
            [middle - half, middle + half]
        };
        if let Some(radius) = followed_radius_m {
            return Self {
                box_m: around(DVec3::splat((FOLLOWED * radius).max(CLOSE_M))),
                grounded: false,
            };
        }
        // The ground belongs to the picture where it is not far below.
        let across = (high - low).truncate().max_element();
        if stage.plane && low.z > 0.0 && low.z < across.max(2.0) {
            low.z = 0.0;
        }
        let middle = 0.5 * (low + high);
        let half = (0.5 * (high - low)).max(DVec3::new(CLOSE_M, CLOSE_M, 0.25 * CLOSE_M));
        Self {
            box_m: [middle - half, middle + half],
            grounded: stage.plane && low.z <= 0.0,
        }
    }

    /// The camera, so many seconds after the film's beginning. `followed_m`: where the vehicle is that stays in the
    /// middle.
    pub(super) fn camera(
        &self,
        choices: &Choices,
        followed_m: Option<DVec3>,
        film_s: f64,
    ) -> Camera {
        let size = choices.size;
        let [low, high] = self.box_m;
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let middle = followed_m.unwrap_or(middle);
        let half = half / choices.zoom.max(1e-6);
        let bounds = [middle - half, middle + half];
        let focal = focal(size[0], choices.field_of_view_rad);
        match choices.view {
            View::Side(side) => {
                let camera = Camera::flat(side, bounds, size, FILL);
                match followed_m {
                    None if side != Side::Top => self.lowered(camera, size[1]),
                    _ => camera,
                }
            }
            View::Orbit {
                bearing_rad,
                elevation_rad,
                turn_rad_s,
            } => {
                let bearing = bearing_rad + turn_rad_s * film_s;
                let elevation_rad = elevation_rad.unwrap_or(std::f64::consts::FRAC_PI_6);
                let forward = from_bearing(bearing, elevation_rad);
                if turn_rad_s == 0.0 && followed_m.is_none() {
                    return Camera::framing(forward, bounds, size, focal, FILL);
                }
                // As far as it takes from every side, so that it neither comes nor goes.
                let far = (0..8)
                    .map(|k| {
                        let bearing = f64::from(k) * std::f64::consts::FRAC_PI_4;
                        let forward = from_bearing(bearing, elevation_rad);
                        let camera = Camera::framing(forward, bounds, size, focal, FILL);
                        (camera.eye_m - middle).dot(-forward)
                    })
                    .fold(0.0, f64::max);
                Camera::along(middle - forward * far, forward, Lens::Perspective { focal })
            }
            View::From { eye_m, at_m } => {
                let at = followed_m.or(at_m).unwrap_or(middle);
                let focal = focal * choices.zoom;
                Camera::along(eye_m, at - eye_m, Lens::Perspective { focal })
            }
        }
    }

    /// From the side: what stands on the ground stands low in the picture, with the sky above it and not bare ground
    /// below.
    fn lowered(&self, camera: Camera, height: u32) -> Camera {
        let Lens::Flat { scale } = camera.lens else {
            return camera;
        };
        let [low, high] = self.box_m;
        let height_m = f64::from(height) / scale;
        let slack_m = FILL * height_m - (high.z - low.z);
        if !self.grounded || slack_m <= 0.0 {
            return camera;
        }
        let below_m = 0.5 * (1.0 - FILL) * height_m + BELOW * slack_m;
        let middle = low.z - below_m + 0.5 * height_m;
        Camera {
            eye_m: camera.eye_m.with_z(middle),
            ..camera
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where the lowest and the highest point of a box come to lie on a picture of a hundred pixels, seen from the
    /// south.
    fn heights(low_m: [f64; 3], high_m: [f64; 3], zoom: f64) -> [f64; 2] {
        let choices = Choices {
            size: [200, 100],
            view: View::Side(Side::South),
            zoom,
            ..Choices::default()
        };
        let stage = Stage {
            plane: true,
            ..Stage::default()
        };
        let moving = [DVec3::from(low_m), DVec3::from(high_m)];
        let frame = Frame::new(&choices, &stage, Some(moving), None, None);
        let camera = frame.camera(&choices, None, 0.0);
        [low_m, high_m].map(|point| {
            let at = camera.project(choices.size, DVec3::from(point));
            at.expect("seen")[1]
        })
    }

    #[test]
    fn from_the_side_little_ground_is_seen_below_what_stands_on_it() {
        // 172 of 200 pixels for 172 m: a metre is a pixel; 86 m would fit, 10 m are there.
        let [foot, top] = heights([-86.0, 0.0, 0.0], [86.0, 0.0, 10.0], 1.0);
        let below = 7.0 + 0.12 * 76.0;
        assert!((foot - (100.0 - below)).abs() < 1e-9, "{foot}");
        assert!((foot - top - 10.0).abs() < 1e-9, "{top}");
        // What fills the height stands where it always did.
        let [foot, top] = heights([-1.0, 0.0, 0.0], [1.0, 0.0, 86.0], 1.0);
        assert!((foot - 93.0).abs() < 1e-9 && (top - 7.0).abs() < 1e-9);
    }

    #[test]
    fn what_flies_far_above_the_ground_and_what_is_looked_at_closely_stays_in_the_middle() {
        let [foot, top] = heights([-86.0, 0.0, 500.0], [86.0, 0.0, 510.0], 1.0);
        assert!((foot + top - 100.0).abs() < 1e-9, "{foot} {top}");
        let [foot, top] = heights([-86.0, 0.0, 0.0], [86.0, 0.0, 40.0], 8.0);
        assert!((foot + top - 100.0).abs() < 1e-9, "{foot} {top}");
    }
}

//! What sensors look along: rays as far as they were measured, and the edges of what a cone or a camera sees.

use super::RenderError;
use super::motion::Instant;
use simbeeotic_model::Beams as Looks;
use simbeeotic_record::{Reading, Recording};
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::math;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::ops::RangeInclusive;

/// A reading is shown for so long, ns.
const FRESH_NS: u64 = 10_000_000_000;
/// Lines that a picture shows at most.
const LINES_MAX: usize = 200_000;
/// The edges of a cone.
const EDGES: u32 = 12;
/// How strong a ray is that met something, and one that did not, or of which nothing is known.
const MET: u8 = 220;
const FREE: u8 = 80;

/// Sensors by their place on board, in these colours.
const COLOURS: [[u8; 3]; 6] = [
    [0xff, 0x4d, 0x6d],
    [0x00, 0xb4, 0xd8],
    [0xff, 0xb7, 0x03],
    [0x9b, 0x5d, 0xe5],
    [0x43, 0xaa, 0x8b],
    [0xf1, 0x5b, 0xb5],
];

/// A line in the world, m; with a dot at its end, if something is there.
pub(super) struct Line {
    pub(super) ends_m: [DVec3; 2],
    pub(super) rgba: [u8; 4],
    pub(super) dot: bool,
}

/// A sensor that looks somewhere.
struct Eye {
    vehicle: usize,
    rgb: [u8; 3],
    /// In the body frame: where it is, m.
    place_m: DVec3,
    /// In the body frame: from where to where, as shares of the range. Rays begin at zero.
    lines: Vec<[DVec3; 2]>,
    range_m: f64,
    /// Lengths of its rays, with the time from which on they hold, ns; the earliest first. NaN: it met nothing.
    lengths_m: Vec<(u64, Vec<f64>)>,
}

/// The sensors of some vehicles.
#[derive(Default)]
pub(super) struct Beams(Vec<Eye>);

impl Beams {
    /// Of the vehicles that are `wanted`, for a range of time.
    pub(super) fn read(
        recording: &Recording,
        wanted: &[bool],
        times_ns: &RangeInclusive<u64>,
    ) -> Result<Self, RenderError> {
        let mut eyes = Vec::new();
        let mut places: BTreeMap<String, usize> = BTreeMap::new();
        let vehicles = recording.vehicles().iter().zip(wanted).enumerate();
        for (at, (vehicle, _)) in vehicles.filter(|(_, (_, wanted))| **wanted) {
            let Some(about) = recording.about(at)? else {
                continue;
            };
            for (place, sensor) in about.sensors.iter().enumerate() {
                let Some(looks) = &sensor.beams else { continue };
                let turn = sensor.mount.attitude.quat();
                let (lines, range_m) = lines(looks);
                let turned = lines.into_iter().map(|ends| ends.map(|end| turn * end));
                places.insert(format!("{}/{}", vehicle.path, sensor.name), eyes.len());
                eyes.push(Eye {
                    vehicle: at,
                    rgb: COLOURS[place % COLOURS.len()],
                    place_m: sensor.mount.position.si(),
                    lines: turned.collect(),
                    range_m,
                    lengths_m: Vec::new(),
                });
            }
        }
        if eyes.is_empty() {
            return Err(RenderError::Form(
                "no vehicle of those that --beams takes has a sensor that looks somewhere, such as `ring`, `range` or \
                 `camera`, or the recording does not say what is on board"
                    .to_owned(),
            ));
        }
        let from = times_ns.start().saturating_sub(FRESH_NS);
        for reading in recording.readings_in(from..=*times_ns.end()) {
            let reading = reading?;
            if let Some(place) = places.get(&reading.sensor) {
                let eye = &mut eyes[*place];
                if let Some(lengths) = lengths(&reading, eye.lines.len()) {
                    eye.lengths_m.push((reading.time_ns, lengths));
                }
            }
        }
        for eye in &mut eyes {
            eye.lengths_m.sort_by_key(|(time_ns, _)| *time_ns);
        }
        Ok(Self(eyes))
    }

    /// All lines at one instant.
    pub(super) fn at(&self, instant: &Instant, time_ns: u64) -> Vec<Line> {
        let mut out = Vec::new();
        for eye in &self.0 {
            let place = instant.places_m.get(eye.vehicle);
            let Some(place) = place.filter(|place| place.is_finite()) else {
                continue;
            };
            let turn = instant.turns[eye.vehicle];
            let known = eye.lengths_m.partition_point(|(t, _)| *t <= time_ns);
            let known = known.checked_sub(1).map(|last| &eye.lengths_m[last]);
            let known = known.filter(|(t, _)| time_ns - t <= FRESH_NS);
            let [r, g, b] = eye.rgb;
            for (ray, ends) in eye.lines.iter().enumerate() {
                let length = known.and_then(|(_, lengths)| lengths.get(ray)).copied();
                let met = length.filter(|m| m.is_finite() && *m < eye.range_m * (1.0 - 1e-6));
                let reach = met.unwrap_or(eye.range_m);
                let world = |end: DVec3| *place + turn * (eye.place_m + end * reach);
                if out.len() < LINES_MAX {
                    out.push(Line {
                        ends_m: ends.map(world),
                        rgba: [r, g, b, if met.is_some() { MET } else { FREE }],
                        dot: met.is_some(),
                    });
                }
            }
        }
        out
    }
}

/// What is drawn of what a sensor looks along, in its own frame, for a range of 1; and its range, m.
fn lines(looks: &Looks) -> (Vec<[DVec3; 2]>, f64) {
    let around = |corners: Vec<DVec3>| {
        let rim = corners.iter().zip(corners.iter().cycle().skip(1));
        let rim: Vec<[DVec3; 2]> = rim.map(|(a, b)| [*a, *b]).collect();
        let edges = corners.iter().map(|corner| [DVec3::ZERO, *corner]);
        edges.chain(rim).collect::<Vec<_>>()
    };
    let circle = |x: f64, radius: f64, upright: bool| {
        let corner = |step: u32| {
            let (sin, cos) = math::sin_cos(TAU * f64::from(step) / f64::from(EDGES));
            match upright {
                true => DVec3::new(x, radius * cos, radius * sin),
                false => DVec3::new(radius * cos, radius * sin, 0.0),
            }
        };
        (0..EDGES).map(corner).collect::<Vec<_>>()
    };
    match looks {
        Looks::Rays {
            directions,
            range_m,
        } => {
            let rays = directions.iter();
            let rays = rays.map(|ray| [DVec3::ZERO, DVec3::from(*ray)]);
            (rays.collect(), *range_m)
        }
        Looks::Cone {
            half_angle_rad,
            range_m,
        } => {
            let (sin, cos) = math::sin_cos(*half_angle_rad);
            (around(circle(cos, sin, true)), *range_m)
        }
        Looks::Frustum {
            horizontal_rad,
            vertical_rad,
            range_m,
        } => {
            let half = |angle: f64| math::tan(0.5 * angle.clamp(0.0, 3.0));
            let (wide, tall) = (half(*horizontal_rad), half(*vertical_rad));
            let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
            let corner = |(left, up): (f64, f64)| DVec3::new(1.0, left * wide, up * tall);
            let corners = corners.map(|c| corner(c).normalize());
            (around(corners.to_vec()), *range_m)
        }
        Looks::Ball { range_m } => {
            let circle = circle(0.0, 1.0, false);
            let rim = circle.iter().zip(circle.iter().cycle().skip(1));
            (rim.map(|(a, b)| [*a, *b]).collect(), *range_m)
        }
    }
}

/// The lengths of rays from a reading: its first column of metres, if it has as many rows as there are rays.
fn lengths(reading: &Reading, rays: usize) -> Option<Vec<f64>> {
    let wide = reading.units.len().max(1);
    let column = reading.units.iter().position(|unit| unit == "m")?;
    if reading.lost || reading.reading.len() != rays * wide {
        return None;
    }
    let rows = reading.reading.chunks_exact(wide);
    Some(rows.map(|row| row[column]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_units::glam::DQuat;

    fn eye(looks: &Looks) -> Eye {
        let (lines, range_m) = lines(looks);
        Eye {
            vehicle: 0,
            rgb: [1, 2, 3],
            place_m: DVec3::Z,
            lines,
            range_m,
            lengths_m: Vec::new(),
        }
    }

    fn instant() -> Instant {
        Instant {
            places_m: vec![DVec3::new(10.0, 0.0, 5.0)],
            turns: vec![DQuat::IDENTITY],
            ..Instant::default()
        }
    }

    #[test]
    fn a_ray_ends_where_it_was_measured_and_else_at_its_range() {
        let looks = Looks::Rays {
            directions: vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            range_m: 4.0,
        };
        let mut eye = eye(&looks);
        let reading = Reading {
            time_ns: 1_000,
            units: vec!["m".to_owned()],
            reading: vec![2.5, f64::NAN],
            ..Reading::default()
        };
        eye.lengths_m
            .push((1_000, lengths(&reading, 2).expect("two rays")));
        assert!(lengths(&reading, 3).is_none());
        let beams = Beams(vec![eye]);
        let ends = |time_ns: u64| {
            let lines = beams.at(&instant(), time_ns);
            lines
                .iter()
                .map(|line| (line.ends_m[1], line.dot))
                .collect::<Vec<_>>()
        };
        let free = DVec3::new(10.0, 4.0, 6.0);
        assert_eq!(
            ends(2_000),
            [(DVec3::new(12.5, 0.0, 6.0), true), (free, false)]
        );
        // Before the reading, and long after it.
        for time_ns in [0, 2 * FRESH_NS] {
            assert_eq!(ends(time_ns)[0], (DVec3::new(14.0, 0.0, 6.0), false));
        }
    }

    #[test]
    fn edges_reach_as_far_as_the_sensor() {
        for looks in [
            Looks::Cone {
                half_angle_rad: 0.4,
                range_m: 3.0,
            },
            Looks::Frustum {
                horizontal_rad: 1.0,
                vertical_rad: 0.7,
                range_m: 3.0,
            },
            Looks::Ball { range_m: 3.0 },
        ] {
            let lines = Beams(vec![eye(&looks)]).at(&instant(), 0);
            assert!(!lines.is_empty());
            let from = DVec3::new(10.0, 0.0, 6.0);
            for line in lines {
                assert!(
                    (line.ends_m[1].distance(from) - 3.0).abs() < 1e-9,
                    "{looks:?}"
                );
            }
        }
    }
}

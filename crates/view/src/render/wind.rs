//! The wind that was recorded: an arrow at each place where it is known, as on the page.

use super::painter::Stand;
use super::triangle::Triangle;
use simbeeotic_record::{ReadError, Recording, Wind};
use simbeeotic_units::glam::{DVec3, Vec2};

/// Arrows that a picture shows at most.
const MOST: usize = 4000;
/// How long the fastest arrow is, in distances between two arrows; the others are shorter by the root of their speed.
const LONG: f64 = 0.62;
/// Slower than this share of the fastest, there is no arrow.
const CALM: f64 = 0.01;
/// How far arrows are apart, if there is one only, m.
const ALONE_M: f64 = 5.0;
/// Half the width of shaft and head, and how long the head is, in lengths of the arrow.
const SHAFT: f32 = 0.017;
const HEAD: f32 = 0.065;
const HEAD_LONG: f32 = 0.24;
/// They are at least so wide, half, pixels.
const SHAFT_LEAST_PX: f32 = 0.55;
const HEAD_LEAST_PX: f32 = 2.6;
/// How strong they are, 0 to 255.
const ALPHA: u8 = 148;

type Read<'a> = Box<dyn Iterator<Item = Result<Wind, ReadError>> + Send + 'a>;

/// Plays the recorded wind forwards: each holds until the next one.
pub(super) struct Winds<'a> {
    rest: Read<'a>,
    now: Option<Wind>,
    next: Option<Wind>,
}

impl<'a> Winds<'a> {
    /// From a time on.
    pub(super) fn open(recording: &'a Recording, from_ns: u64) -> Result<Self, ReadError> {
        // Winds may be far apart, as one is only recorded if it is another: look back until there is one.
        let mut back_ns = 4_000_000_000_u64;
        loop {
            let start_ns = from_ns.saturating_sub(back_ns);
            let mut rest: Read<'a> = Box::new(recording.wind_in(start_ns..=u64::MAX));
            let next = rest.next().transpose()?;
            let known = next.as_ref().is_some_and(|wind| wind.time_ns <= from_ns);
            if known || start_ns == 0 {
                let mut winds = Self {
                    rest,
                    now: None,
                    next,
                };
                winds.play(from_ns)?;
                return Ok(winds);
            }
            back_ns = back_ns.saturating_mul(8);
        }
    }

    /// Goes to a time.
    pub(super) fn advance(
        &mut self,
        recording: &'a Recording,
        time_ns: u64,
    ) -> Result<(), ReadError> {
        if self.now.as_ref().is_some_and(|now| now.time_ns > time_ns) {
            *self = Self::open(recording, time_ns)?;
        }
        self.play(time_ns)
    }

    fn play(&mut self, time_ns: u64) -> Result<(), ReadError> {
        while self
            .next
            .as_ref()
            .is_some_and(|next| next.time_ns <= time_ns)
        {
            self.now = self.next.take();
            self.next = self.rest.next().transpose()?;
        }
        Ok(())
    }

    /// The wind at that time; none, if it was not recorded, or not yet.
    pub(super) fn now(&self) -> Option<&Wind> {
        self.now.as_ref()
    }

    /// How fast it is where it is fastest, in words; none, if there is no arrow.
    pub(super) fn said(&self) -> Option<String> {
        let fastest = fastest_m_s(&self.now()?.arrows);
        (fastest > 0.0).then(|| format!("wind up to {fastest:.1} m/s"))
    }
}

/// Draws the arrows: positions (ENU, m) and velocities (m/s), as [`Wind`] has them.
pub(super) fn draw(arrows: &[[f32; 6]], stand: &Stand<'_>, out: &mut Vec<Triangle>) {
    let arrows = &arrows[..arrows.len().min(MOST)];
    let (fastest, apart_m) = (fastest_m_s(arrows), apart_m(arrows));
    let [r, g, b] = stand.theme.wind;
    for arrow in arrows {
        let (place, wind) = (place_m(arrow), wind_m_s(arrow));
        let speed = wind.length();
        if !(place.is_finite() && speed.is_finite() && speed > CALM * fastest) {
            continue;
        }
        let long_m = LONG * apart_m * (speed / fastest).sqrt();
        let tip = place + wind / speed * long_m;
        let ends = [place, tip].map(|end| stand.projector.place(stand.projector.local(end)));
        if let [Some(from), Some(to)] = ends {
            one(
                [from, to],
                long_m as f32,
                stand.fineness,
                [r, g, b, ALPHA],
                out,
            );
        }
    }
}

/// A place on the picture, pixels a metre there, and how near it is.
type End = ([f32; 2], f32, f32);

/// One arrow, in the plane of the picture.
fn one([from, to]: [End; 2], long_m: f32, fineness: f32, rgba: [u8; 4], out: &mut Vec<Triangle>) {
    let (a, b) = (Vec2::from(from.0), Vec2::from(to.0));
    let length = (b - a).length();
    // As it would be if it lay across the line of sight: one that flies at the eye keeps its width.
    let whole = long_m * to.1;
    let head = (HEAD * whole).max(HEAD_LEAST_PX * fineness);
    let shaft = (SHAFT * whole).max(SHAFT_LEAST_PX * fineness);
    let head_long = (HEAD_LONG * length).max((1.9 * head).min(length));
    if length < 0.3 * fineness {
        return;
    }
    let ahead = (b - a) / length;
    let aside = ahead.perp();
    let neck_share = 1.0 - head_long / length;
    let neck = a + ahead * (length - head_long);
    let near_neck = from.2 + neck_share * (to.2 - from.2);
    let mut put = |corners: [(Vec2, f32); 3]| {
        out.push(Triangle::on_screen(
            corners.map(|(at, near)| (at.to_array(), near, rgba)),
        ));
    };
    let (tail_aside, head_aside) = (aside * shaft, aside * head);
    if neck_share > 0.0 {
        put([
            (a + tail_aside, from.2),
            (a - tail_aside, from.2),
            (neck - tail_aside, near_neck),
        ]);
        put([
            (a + tail_aside, from.2),
            (neck - tail_aside, near_neck),
            (neck + tail_aside, near_neck),
        ]);
    }
    put([
        (neck + head_aside, near_neck),
        (neck - head_aside, near_neck),
        (b, to.2),
    ]);
}

fn place_m([x, y, z, ..]: &[f32; 6]) -> DVec3 {
    DVec3::new((*x).into(), (*y).into(), (*z).into())
}

fn wind_m_s([.., x, y, z]: &[f32; 6]) -> DVec3 {
    DVec3::new((*x).into(), (*y).into(), (*z).into())
}

fn fastest_m_s(arrows: &[[f32; 6]]) -> f64 {
    let speeds = arrows.iter().map(|arrow| wind_m_s(arrow).length());
    speeds.filter(|speed| speed.is_finite()).fold(0.0, f64::max)
}

/// How far the arrows are apart: the first and the one nearest to it, m.
fn apart_m(arrows: &[[f32; 6]]) -> f64 {
    let Some((first, others)) = arrows.split_first() else {
        return ALONE_M;
    };
    let away = |other: &[f32; 6]| (place_m(other) - place_m(first)).length();
    let near = others.iter().map(away).filter(|m| *m > 1e-6);
    match near.fold(f64::INFINITY, f64::min) {
        m if m.is_finite() => m,
        _ => ALONE_M,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::camera::{Camera, Projector, Side};
    use crate::render::light::Theme;
    use crate::render::triangle::GRID;

    /// The triangles of arrows from above, ten pixels a metre, the origin at (200, 200).
    fn drawn(arrows: &[[f32; 6]]) -> Vec<Triangle> {
        let lens = crate::render::Lens::Flat { scale: 10.0 };
        let camera = Camera::along(DVec3::ZERO, Side::Top.forward(), lens);
        let theme = Theme::new(false, [0; 4]);
        let stand = Stand {
            projector: Projector::new(&camera, [400, 400], DVec3::ZERO, 0.1, None),
            theme: &theme,
            fineness: 1.0,
        };
        let mut out = Vec::new();
        draw(arrows, &stand, &mut out);
        out
    }

    /// From where to where an arrow reaches to the right and down, pixels.
    fn reach(triangles: &[Triangle]) -> [[f32; 2]; 2] {
        let of = |parts: fn(&Triangle) -> [i32; 3]| {
            let all = triangles
                .iter()
                .flat_map(parts)
                .map(|x| x as f32 / GRID as f32);
            [
                all.clone().fold(f32::MAX, f32::min),
                all.fold(f32::MIN, f32::max),
            ]
        };
        [of(|t| t.x), of(|t| t.y)]
    }

    #[test]
    fn an_arrow_begins_where_the_air_is_known_and_points_where_it_goes() {
        // Ten metres apart: the fastest is 6.2 m long, one a quarter as fast half of that.
        let arrows = [
            [0.0, 0.0, 1.0, 4.0, 0.0, 0.0],
            [0.0, 10.0, 1.0, 0.0, 1.0, 0.0],
        ];
        let triangles = drawn(&arrows);
        assert_eq!(triangles.len(), 6);
        let [[left, right], [top, foot]] = reach(&triangles[..3]);
        assert!(
            (left - 200.0).abs() < 0.1 && (right - 262.0).abs() < 0.1,
            "{left} {right}"
        );
        assert!(
            (foot + top - 400.0).abs() < 0.1 && foot - top < 10.0,
            "{top} {foot}"
        );
        // To the north: up.
        let [[left, right], [top, foot]] = reach(&triangles[3..]);
        assert!(
            (foot - 100.0).abs() < 0.1 && (top - 69.0).abs() < 0.1,
            "{top} {foot}"
        );
        assert!((left + right - 400.0).abs() < 0.1, "{left} {right}");
        // The tip is the head's: half as wide as the head, the arrow would end in a point.
        let head = &triangles[2];
        assert_eq!(head.x[2], 262 * GRID);
    }

    #[test]
    fn still_air_and_what_is_no_number_has_no_arrow() {
        let wind = [0.0, 0.0, 1.0, 4.0, 0.0, 0.0];
        let still = [5.0, 0.0, 1.0, 0.01, 0.0, 0.0];
        let unknown = [5.0, 5.0, 1.0, f32::NAN, 0.0, 0.0];
        assert_eq!(drawn(&[wind, still, unknown]).len(), 3);
        assert!(drawn(&[]).is_empty() && drawn(&[[0.0; 6]]).is_empty());
    }
}

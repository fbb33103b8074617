//! Points on surfaces, evenly by area.
//!
//! All triangles are laid end to end by their areas, and a point is taken each so many square metres along
//! them; where in its triangle it lies is the next of a sequence that fills a square evenly (M. Roberts, *The
//! Unreasonable Effectiveness of Quasirandom Sequences*, 2018). The same stage has the same points.

use super::Stage;
use simbeeotic_model::units::glam::DVec3;

/// Corners around, of forms that are round.
const CORNERS: u32 = 12;

impl Stage {
    /// Points on the surfaces of all props, with their colours: as many for each square metre everywhere, but
    /// one at least for each piece, if there are not more pieces than half of `most`. Never more than `most`.
    pub fn points(&self, most: usize) -> Vec<([f32; 3], [u8; 4])> {
        let pieces: usize = self.props.iter().map(|prop| prop.pieces.len()).sum();
        let each = pieces <= most / 2;
        let by_area = if each { most - pieces } else { most };
        let area: f64 = self.faces().map(|face| face.area_m2).sum();
        let per_m2 = by_area as f64 / area;
        if by_area == 0 || !(per_m2 > 0.0 && per_m2.is_finite()) {
            return Vec::new();
        }
        let mut points = Vec::new();
        // Points owed so far; the first comes after half of its share.
        let mut owed = 0.5;
        let mut sequence = 0_u32;
        let mut bare = None;
        for face in self.faces() {
            if bare != Some(face.piece) && each {
                // The first face of a piece: one more point is due, here.
                bare = Some(face.piece);
                points.push((face.at(sequence), face.color));
                sequence = sequence.wrapping_add(1);
            }
            owed += face.area_m2 * per_m2;
            while owed >= 1.0 && points.len() < most {
                owed -= 1.0;
                points.push((face.at(sequence), face.color));
                sequence = sequence.wrapping_add(1);
            }
        }
        points.truncate(most);
        points
    }

    /// All triangles in the world.
    fn faces(&self) -> impl Iterator<Item = Face> + '_ {
        let pieces = self
            .props
            .iter()
            .flat_map(|prop| prop.pieces.iter().map(|piece| (piece, prop.color)));
        pieces.enumerate().flat_map(|(number, (piece, color))| {
            let (origin, turn) = (piece.origin(), piece.turn());
            let surface = piece.form.triangles(CORNERS);
            let corners: Vec<_> = surface.corners().collect();
            corners.into_iter().map(move |corners| {
                let place = |p: [f32; 3]| origin + turn * DVec3::from_array(p.map(f64::from));
                let [a, b, c] = corners.map(place);
                Face {
                    piece: number,
                    color,
                    area_m2: 0.5 * (b - a).cross(c - a).length(),
                    corners: [a, b, c],
                }
            })
        })
    }
}

struct Face {
    piece: usize,
    color: [u8; 4],
    area_m2: f64,
    corners: [DVec3; 3],
}

impl Face {
    /// The point of this number.
    fn at(&self, number: u32) -> [f32; 3] {
        /// Of the plastic number: its inverse, and the square of that.
        const STEP: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
        let [mut u, mut v] = STEP.map(|step| (0.5 + step * f64::from(number)).fract());
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        let [a, b, c] = self.corners;
        (a + (b - a) * u + (c - a) * v).as_vec3().to_array()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Form, Piece, Prop};
    use super::*;
    use simbeeotic_model::units::glam::DQuat;

    fn stage(boxes: &[([f64; 3], f64)]) -> Stage {
        let prop = |(half_m, x): &([f64; 3], f64)| Prop {
            color: [*x as u8, 2, 3, 255],
            pieces: vec![Piece::new(
                Form::Box { half_m: *half_m },
                [*x, 0.0, 0.0],
                DQuat::IDENTITY,
            )],
            ..Prop::default()
        };
        Stage {
            props: boxes.iter().map(prop).collect(),
            ..Stage::default()
        }
    }

    #[test]
    fn points_lie_on_the_surface_in_proportion_to_its_area() {
        let stage = stage(&[([1.0; 3], 0.0), ([2.0; 3], 100.0)]);
        let points = stage.points(10_000);
        assert!((9_990..=10_000).contains(&points.len()), "{}", points.len());
        let small = points.iter().filter(|(_, color)| color[0] == 0).count();
        assert!(
            (small as f64 / points.len() as f64 - 0.2).abs() < 2e-3,
            "{small}"
        );
        for ([x, y, z], _) in &points {
            let (middle, half) = if *x > 50.0 { (100.0, 2.0) } else { (0.0, 1.0) };
            let far = (x - middle).abs().max(y.abs()).max(z.abs());
            assert!((far - half).abs() < 1e-4, "{x} {y} {z}");
        }
        // Each of the six faces has its sixth.
        let top = points
            .iter()
            .filter(|([x, _, z], _)| *x > 50.0 && *z > 1.999)
            .count();
        let share = top as f64 / (points.len() - small) as f64;
        assert!((share - 1.0 / 6.0).abs() < 0.01, "{share}");
        assert_eq!(points, stage.points(10_000), "the same each time");
    }

    #[test]
    fn what_is_small_has_a_point_too_and_there_are_never_too_many() {
        let mut boxes = vec![([0.001; 3], 1.0), ([50.0; 3], 0.0), ([0.001; 3], 2.0)];
        let points = stage(&boxes).points(100);
        assert!(points.len() <= 100);
        for color in [1, 2] {
            assert_eq!(points.iter().filter(|(_, c)| c[0] == color).count(), 1);
        }
        boxes = vec![([1.0; 3], 0.0); 500];
        assert_eq!(stage(&boxes).points(100).len(), 100);
        assert!(stage(&[]).points(100).is_empty());
        assert!(stage(&boxes).points(0).is_empty());
        assert!(stage(&[([f64::NAN; 3], 0.0)]).points(10).is_empty());
    }
}

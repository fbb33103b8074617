//! What of the world hides the swarm: the world cut open below its roofs, and the height from which an orbit looks on.
//! The rules are those of the page.

use super::choices::CutOpen;
use super::framing::Moment;
use super::solid;
use simbeeotic_record::Stage;
use simbeeotic_record::stage::Piece;
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::math;

/// From these elevations is judged whether the world hides the swarm, rad.
const ELEVATIONS: [f64; 6] = [0.36, 0.6, 0.85, 1.1, 1.35, 1.5];
/// An orbit of which nobody has said how high it is stands at the first of these from which enough is seen, rad.
const ORBITS: [f64; 5] = [std::f64::consts::FRAC_PI_6, 0.85, 1.1, 1.35, 1.5];
/// Such a share of the vehicles must be seen.
const CLEAR: f64 = 0.8;
/// Where fewer are seen from every elevation, the world hides the swarm.
const DIM: f64 = 0.5;
/// The ceiling of a world that is cut open is above such a share of the vehicles.
const HIGH: f64 = 0.9;

/// Something that stands in the way of looks.
struct Block {
    /// The box that holds it, m.
    box_m: [DVec3; 2],
    /// Its lowest point, m; that of terrain is never above anything.
    foot_m: f64,
    triangles_m: Vec<[DVec3; 3]>,
}

/// All that stands in the way of looks.
pub(super) struct Blocks(Vec<Block>);

impl Blocks {
    pub(super) fn of(stage: &Stage) -> Self {
        let hides = |kind: &str| !matches!(kind, "flower" | "light" | "source");
        let props = stage.props.iter();
        let props = props.filter(|prop| hides(&prop.kind) && prop.color[3] == 255);
        let block = |(piece, terrain): (&Piece, bool)| {
            let box_m = piece.bounds()?.map(DVec3::from);
            let (turn, place) = (solid::turn_of(piece), DVec3::from(piece.position_m));
            let facets = solid::facets(&piece.form, 12).into_iter();
            Some(Block {
                box_m,
                foot_m: if terrain {
                    f64::NEG_INFINITY
                } else {
                    box_m[0].z
                },
                triangles_m: facets
                    .map(|facet| facet.corners.map(|c| turn * c.as_dvec3() + place))
                    .collect(),
            })
        };
        let pieces = props.flat_map(|prop| {
            let terrain = prop.kind == "terrain";
            prop.pieces.iter().map(move |piece| (piece, terrain))
        });
        Self(pieces.filter_map(block).collect())
    }

    /// Whether nothing stands between a point and what is so many of `along` away; without what begins above a
    /// ceiling.
    fn free(&self, from_m: DVec3, along: DVec3, ceiling_m: f64) -> bool {
        let there = |block: &&Block| block.foot_m < ceiling_m;
        !(self.0.iter().filter(there)).any(|block| block.meets(from_m, along))
    }

    /// The ceiling below which a swarm is seen that a roof hides from wherever one looks; none, if it is not hidden, or
    /// if that does not help. `bearing_rad`: where the camera stands.
    pub(super) fn ceiling_m(
        &self,
        cut: CutOpen,
        moments: &[Moment],
        bearing_rad: f64,
    ) -> Option<f64> {
        let heights = moments.iter().filter_map(Moment::ceiling_m);
        let ceiling_m = heights.reduce(f64::max)?;
        if !self.0.iter().any(|block| block.foot_m >= ceiling_m) {
            return None;
        }
        let (sin, cos) = math::sin_cos(bearing_rad);
        // Whether enough are seen from one of the elevations.
        let clear = |ceiling_m: f64| {
            ELEVATIONS.into_iter().any(|elevation| {
                let (up, level) = math::sin_cos(elevation);
                let along = DVec3::new(level * sin, level * cos, up) * 1e6;
                share(moments, |_, place| self.free(place, along, ceiling_m)) >= DIM
            })
        };
        let wanted = match cut {
            CutOpen::Never => false,
            CutOpen::Always => true,
            CutOpen::Auto => !clear(f64::INFINITY) && clear(ceiling_m),
        };
        wanted.then_some(ceiling_m)
    }

    /// How high an orbit stands, rad: the lowest from which the world hides little of the swarm. `eye_m`: where the
    /// camera is at a moment, by its elevation.
    pub(super) fn elevation_rad(
        &self,
        moments: &[Moment],
        eye_m: impl Fn(&Moment, f64) -> DVec3,
    ) -> f64 {
        let mut best = (ORBITS[0], 0.0);
        for elevation in ORBITS {
            let seen = share(moments, |moment, place| {
                let eye = eye_m(moment, elevation);
                // Not quite up to where it is: it may lie on something.
                self.free(eye, (place - eye) * (1.0 - 1e-3), f64::INFINITY)
            });
            if seen >= CLEAR {
                return elevation;
            }
            if seen > best.1 {
                best = (elevation, seen);
            }
        }
        best.0
    }
}

/// The share of the places of which something is true; 1 if there are none.
fn share(moments: &[Moment], is: impl Fn(&Moment, DVec3) -> bool) -> f64 {
    let all = moments
        .iter()
        .flat_map(|moment| moment.some().map(move |place| (moment, place)));
    let (mut count, mut found) = (0_u32, 0_u32);
    for (moment, place) in all {
        count += 1;
        found += u32::from(is(moment, place));
    }
    match count {
        0 => 1.0,
        count => f64::from(found) / f64::from(count),
    }
}

impl Block {
    /// Whether a line from a point, so far, meets it.
    fn meets(&self, from: DVec3, along: DVec3) -> bool {
        // Where the line is inside the box, in shares of it.
        let [low, high] = self.box_m.map(|corner| (corner - from) / along);
        let enter = low.min(high).max_element().max(0.0);
        let leave = low.max(high).min_element().min(1.0);
        enter <= leave
            && (self.triangles_m)
                .iter()
                .any(|corners| crossed(corners, from, along))
    }
}

/// Whether a line from a point, so far, goes through a triangle. After T. Möller and B. Trumbore, *Fast, minimum storage
/// ray/triangle intersection* (1997).
fn crossed([a, b, c]: &[DVec3; 3], from: DVec3, along: DVec3) -> bool {
    let (ab, ac) = (*b - *a, *c - *a);
    let across = along.cross(ac);
    let volume = ab.dot(across);
    if volume.abs() < 1e-12 {
        return false;
    }
    let to = from - *a;
    let u = to.dot(across) / volume;
    let turned = to.cross(ab);
    let v = along.dot(turned) / volume;
    let far = ac.dot(turned) / volume;
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (1e-9..=1.0).contains(&far)
}

/// The stage without what begins above a ceiling.
pub(super) fn below(stage: &Stage, ceiling_m: f64) -> Stage {
    let mut stage = stage.clone();
    let solid = |kind: &str| !matches!(kind, "flower" | "terrain");
    for prop in stage.props.iter_mut().filter(|prop| solid(&prop.kind)) {
        let stays = |piece: &Piece| piece.bounds().is_none_or(|[low, _]| low[2] < ceiling_m);
        prop.pieces.retain(stays);
    }
    stage
}

impl Moment {
    /// Above nearly all of the swarm, m.
    fn ceiling_m(&self) -> Option<f64> {
        let mut heights: Vec<f64> = self.places_m.iter().map(|place| place.z).collect();
        heights.sort_by(f64::total_cmp);
        let last = heights.len().checked_sub(1)?;
        heights.get((HIGH * last as f64) as usize).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_record::stage::{Form, Prop};

    /// A room of ten metres with walls of three, and a roof of that height.
    fn house() -> Stage {
        let slab = |position_m, half_m, label: &str| Prop {
            kind: "structure".to_owned(),
            label: label.to_owned(),
            color: [200, 200, 200, 255],
            pieces: vec![Piece {
                position_m,
                ..Piece::at_origin(Form::Box { half_m })
            }],
            ..Prop::default()
        };
        Stage {
            plane: true,
            props: vec![
                slab([0.0, -5.0, 1.5], [5.0, 0.1, 1.5], "wall"),
                slab([0.0, 5.0, 1.5], [5.0, 0.1, 1.5], "wall"),
                slab([-5.0, 0.0, 1.5], [0.1, 5.0, 1.5], "wall"),
                slab([5.0, 0.0, 1.5], [0.1, 5.0, 1.5], "wall"),
                slab([0.0, 0.0, 3.1], [5.1, 5.1, 0.1], "roof"),
            ],
            ..Stage::default()
        }
    }

    fn moment(places: &[[f64; 3]]) -> Moment {
        Moment {
            places_m: places.iter().map(|place| DVec3::from(*place)).collect(),
            followed_m: None,
        }
    }

    #[test]
    fn what_hides_the_swarm_from_everywhere_is_cut_away_and_nothing_else() {
        let blocks = Blocks::of(&house());
        let inside = [moment(&[
            [0.0, 0.0, 1.0],
            [2.0, 1.0, 1.2],
            [-1.0, -2.0, 1.1],
        ])];
        let ceiling = |cut, moments: &[Moment]| blocks.ceiling_m(cut, moments, 3.8);
        let auto = ceiling(CutOpen::Auto, &inside).expect("hidden");
        assert_eq!(auto, 1.1);
        assert_eq!(ceiling(CutOpen::Never, &inside), None);
        let open = below(&house(), auto);
        let left: Vec<bool> = (open.props.iter())
            .map(|prop| !prop.pieces.is_empty())
            .collect();
        assert_eq!(left, [true, true, true, true, false]);
        // Outside nothing hides it, and above the roof there is nothing to cut.
        let outside = [moment(&[[0.0, -20.0, 1.0], [3.0, -20.0, 1.0]])];
        assert_eq!(ceiling(CutOpen::Auto, &outside), None);
        assert_eq!(ceiling(CutOpen::Always, &outside), Some(1.0));
        let over = [moment(&[[0.0, 0.0, 5.0]])];
        assert_eq!(ceiling(CutOpen::Always, &over), None);
        assert_eq!(ceiling(CutOpen::Auto, &[]), None);
    }

    #[test]
    fn an_orbit_rises_until_it_looks_over_the_wall() {
        let blocks = Blocks::of(&below(&house(), 1.1));
        let eye = |moment: &Moment, elevation: f64| {
            let (up, level) = math::sin_cos(elevation);
            moment.places_m[0] + DVec3::new(0.0, -level, up) * 30.0
        };
        // A metre behind the wall and two below its top: 63 degrees, from the middle less.
        let behind = [moment(&[[0.0, -4.0, 1.0]])];
        assert_eq!(blocks.elevation_rad(&behind, eye), 1.35);
        let middle = [moment(&[[0.0, 0.0, 1.0]])];
        assert_eq!(blocks.elevation_rad(&middle, eye), ORBITS[0]);
        assert_eq!(blocks.elevation_rad(&[], eye), ORBITS[0]);
    }
}

//! Many rays from one point that go nearly the same way: the pixels of a camera, the beams of a lidar.
//!
//! Rays are cut into bundles, of eight by eight pixels, say. The directions of a bundle lie in a box along
//! the axes, `d` in `[a, b]`, and what the bundle may meet is found in one go through the trees: a box of
//! which some `s >= 0` brings all of `s [a, b]` to overlap it. Each body that is found is made ready once
//! (where it stands, where the rays begin in its own frame), and each ray asks them in the order in
//! which they can be met, until no nearer one is left. What a ray then finds is, to the last bit, what it
//! would have found alone: a bundle only leaves out what it cannot meet.

use crate::error::BodyError;
use crate::physics::Physics;
use crate::queries::{BALL, Hit, Line, Nearest, Ray, Sees};
use crate::shape::form::{Form, Place, Solid};
use crate::shape::piece::LocalRay;
use crate::sight::Sight;
use crate::tree::Beam;
use glam::DVec3;
use simbeeotic_kernel::SimTime;

/// Edge of a bundle of a grid, in rays.
const EDGE: usize = 8;
/// Rays of a bundle of those that follow each other in a list.
const RUN: usize = 16;
/// A bundle is not worth the trouble if its rays go farther from its middle than this, as a cosine, or
/// if there are fewer.
const COSINE_MIN: f64 = 0.9;
const FEW: usize = 4;

/// Rays from one point through the cells of a grid.
#[derive(Clone, Copy, Debug)]
pub struct Fan<'a> {
    /// Where all begin, ENU, m, no farther than 1e9 m from the origin.
    pub origin_enu: DVec3,
    /// Where each goes, ENU, row by row; of any length but 0, which does not matter.
    pub directions_enu: &'a [DVec3],
    /// How many stand in one row, above 0. The last row may be shorter.
    pub columns: usize,
    /// How far they go, m, above 0 and at most 1e9.
    pub range_m: f64,
}

/// What holds all rays of a bundle: about which axis, and how wide, as a cosine.
#[derive(Clone, Copy)]
struct Cone {
    axis: DVec3,
    cosine: f64,
}

/// A body made ready for many rays from one point.
struct Target<'a> {
    /// No ray meets it nearer, m.
    begins: f64,
    id: u32,
    /// From the rays' beginning to its origin, and the square of the distance.
    offset: DVec3,
    square: f64,
    /// The radius of its bounding ball, m.
    radius: f64,
    form: Look<'a>,
}

/// What a ray has to ask of a body.
enum Look<'a> {
    /// A ball of this radius, m, and its square.
    Ball(f64, f64),
    Piece(LocalRay<'a>),
    Other(&'a Form, Place),
}

/// Room for one bundle after another.
#[derive(Default)]
struct Room<'a> {
    directions: Vec<DVec3>,
    places: Vec<usize>,
    found: Vec<(f64, u32)>,
    targets: Vec<Target<'a>>,
}

/// The question that all rays of a call ask.
#[derive(Clone, Copy)]
struct Question<'a> {
    physics: &'a Physics,
    sight: &'a Sight<'a>,
    t: SimTime,
    sees: &'a Sees,
}

impl Physics {
    /// [`cast_ray`](Self::cast_ray) for all rays of a fan: appends what each meets, row by row. The same,
    /// to the last bit, as ray by ray, and several times as fast if neighbours in the grid go nearly the
    /// same way.
    ///
    /// # Errors
    /// As [`cast_ray`](Self::cast_ray), of any ray, or no columns; then nothing is appended.
    pub fn cast_fan(
        &self,
        fan: &Fan<'_>,
        t: SimTime,
        sees: &Sees,
        hits: &mut Vec<Option<Hit>>,
    ) -> Result<(), BodyError> {
        if fan.columns == 0 {
            return Err(BodyError::NotPositive {
                what: "columns",
                value: 0.0,
            });
        }
        let count = fan.directions_enu.len();
        let mut directions = Vec::with_capacity(count);
        for direction in fan.directions_enu {
            directions.push(Line::new(fan.origin_enu, *direction, fan.range_m)?.direction);
        }
        let (sight, first) = (self.sight(t), hits.len());
        hits.resize(first + count, None);
        let hits = &mut hits[first..];
        let question = Question {
            physics: self,
            sight: &sight,
            t,
            sees,
        };
        let mut room = Room::default();
        let rows = count.div_ceil(fan.columns);
        for top in (0..rows).step_by(EDGE) {
            for left in (0..fan.columns).step_by(EDGE) {
                room.clear();
                for row in top..(top + EDGE).min(rows) {
                    for column in left..(left + EDGE).min(fan.columns) {
                        let place = row * fan.columns + column;
                        if let Some(direction) = directions.get(place) {
                            room.directions.push(*direction);
                            room.places.push(place);
                        }
                    }
                }
                question.cast(fan.origin_enu, fan.range_m, &mut room, hits);
            }
        }
        Ok(())
    }

    /// [`cast_ray`](Self::cast_ray) for many rays of one instant: appends what each meets, in their order.
    /// Rays from one point that follow each other and go nearly the same way are cheaper than others.
    ///
    /// # Errors
    /// As [`cast_ray`](Self::cast_ray), of any ray; then nothing is appended.
    pub fn cast_rays(
        &self,
        rays: &[Ray],
        t: SimTime,
        sees: &Sees,
        hits: &mut Vec<Option<Hit>>,
    ) -> Result<(), BodyError> {
        let (sight, first) = (self.sight(t), hits.len());
        hits.resize(first + rays.len(), None);
        let question = Question {
            physics: self,
            sight: &sight,
            t,
            sees,
        };
        let mut room = Room::default();
        let mut begin = 0;
        let belongs = |a: &Ray, b: &Ray| a.origin_enu == b.origin_enu && a.range_m == b.range_m;
        while let Some(ray) = rays.get(begin) {
            let rest = rays[begin..].iter().take(RUN);
            // One that is no number is not even like itself; it is refused.
            let run = rest.take_while(|other| belongs(ray, other)).count().max(1);
            room.clear();
            for (place, ray) in (begin..).zip(&rays[begin..begin + run]) {
                let Ray {
                    origin_enu,
                    direction_enu,
                    range_m,
                } = *ray;
                match Line::new(origin_enu, direction_enu, range_m) {
                    // Too few to be worth a bundle.
                    Ok(line) if run < RUN => {
                        hits[first + place] = self.first_seen(&sight, &line, t, sees);
                    }
                    Ok(line) => {
                        room.directions.push(line.direction);
                        room.places.push(place);
                    }
                    Err(error) => {
                        hits.truncate(first);
                        return Err(error);
                    }
                }
            }
            if run == RUN {
                question.cast(ray.origin_enu, ray.range_m, &mut room, &mut hits[first..]);
            }
            begin += run;
        }
        Ok(())
    }
}

impl Room<'_> {
    fn clear(&mut self) {
        self.directions.clear();
        self.places.clear();
    }
}

impl<'a> Question<'a> {
    /// Casts the rays of a bundle: from `room`'s directions to `hits` at its places.
    fn cast(&self, from: DVec3, range: f64, room: &mut Room<'a>, hits: &mut [Option<Hit>]) {
        let axis = room.directions.iter().sum::<DVec3>().normalize_or_zero();
        let cosines = room.directions.iter().map(|d| axis.dot(*d));
        let cosine = cosines.fold(1.0, f64::min);
        if room.directions.len() < FEW || cosine < COSINE_MIN {
            for (direction, place) in room.directions.iter().zip(&room.places) {
                let line = Line {
                    from,
                    direction: *direction,
                    range,
                };
                let Self { sight, t, sees, .. } = *self;
                hits[*place] = self.physics.first_seen(sight, &line, t, sees);
            }
            return;
        }
        self.gather(from, range, Cone { axis, cosine }, room);
        for (direction, place) in room.directions.iter().zip(&room.places) {
            let line = Line {
                from,
                direction: *direction,
                range,
            };
            hits[*place] = self.first_of(&room.targets, &line);
        }
    }

    /// Makes ready whatever the bundle may meet, the nearest first.
    fn gather(&self, from: DVec3, range: f64, cone: Cone, room: &mut Room<'a>) {
        room.found.clear();
        room.targets.clear();
        let beam = Beam::new(from, &room.directions);
        let found = &mut room.found;
        self.sight
            .across(&beam, range, |id, begins| found.push((begins, id)));
        let Cone { axis, cosine } = cone;
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        for &(begins, id) in &room.found {
            if !self.physics.visible(id, self.sees) {
                continue;
            }
            let motion = &self.physics.motions[id as usize];
            let p = motion.position(self.t);
            let offset = p - from;
            let square = offset.length_squared();
            let radius = motion.radius_m() * BALL;
            let along = offset.dot(axis);
            let aside = (square - along * along).max(0.0).sqrt();
            let far = square.sqrt();
            // More than what rounding does.
            let slack = radius + 1e-7 * far;
            if aside * cosine - along * sine > slack || far - slack > range {
                continue;
            }
            let form = self.physics.form(id);
            let form = match (form.ball(), form.solid()) {
                (Some(radius), _) => Look::Ball(radius, radius * radius),
                (None, Solid::One(piece)) => {
                    Look::Piece(piece.ray_from(motion.place(self.t), from))
                }
                _ => Look::Other(form, motion.place(self.t)),
            };
            room.targets.push(Target {
                begins: begins.max(far - slack),
                id,
                offset,
                square,
                radius,
                form,
            });
        }
        room.targets
            .sort_unstable_by(|a, b| a.begins.total_cmp(&b.begins));
    }

    /// As [`Physics::first_seen`], among these alone.
    #[inline]
    fn first_of(&self, targets: &[Target<'_>], line: &Line) -> Option<Hit> {
        let mut nearest = self.physics.ground_seen(line, self.sees);
        let mut met: Option<&Target<'_>> = None;
        for target in targets {
            if target.begins > nearest.distance {
                break;
            }
            let Some((distance, normal)) = target.seen(line, nearest.distance) else {
                continue;
            };
            let offered = Nearest {
                distance,
                id: target.id,
                normal,
                point: DVec3::ZERO,
            };
            if nearest.offer(offered) {
                met = Some(target);
            }
        }
        if let Some(target) = met {
            nearest.point = line.from + line.direction * nearest.distance;
            if let Look::Piece(piece) = &target.form {
                nearest.normal = piece.world(nearest.normal);
            }
        }
        nearest.hit()
    }
}

impl Target<'_> {
    /// Where the line first meets it within `range`: distance and normal, of a piece in its own frame.
    #[inline]
    fn seen(&self, line: &Line, range: f64) -> Option<(f64, DVec3)> {
        let along = self.offset.dot(line.direction);
        let aside_squared = (self.offset - line.direction * along).length_squared();
        let meets = aside_squared <= self.radius * self.radius && along + self.radius >= 0.0;
        if !meets || along - self.radius > range {
            return None;
        }
        let (distance, normal) = match &self.form {
            Look::Ball(radius, square) => {
                if aside_squared > *square || self.square <= *square {
                    return None;
                }
                let distance = along - (square - aside_squared).sqrt();
                (
                    distance,
                    (line.direction * distance - self.offset) / *radius,
                )
            }
            Look::Piece(piece) => piece.cast(line.direction)?,
            Look::Other(form, at) => form.cast_ray(*at, line.from, line.direction, range)?,
        };
        (distance > 0.0 && distance <= range).then_some((distance, normal))
    }
}

//! Who is near, and what a ray or a moving shape meets.
//!
//! Queries are answered exactly as of the instant asked for, from the bodies' own trajectories, and
//! change nothing: many threads may ask at once. An answer is the same as if all bodies were looked at
//! one by one; [`sight`](crate::sight) finds those few that have to be.
//!
//! The tree of `sight` costs about 0.2 us a body once each `list_period` in which there is a query; in
//! return a query costs what there is along its way, for bodies of any sizes and any distances between.

use crate::body::BodyId;
use crate::error::{self, BodyError};
use crate::kind::{Kind, Kinds};
use crate::limits;
use crate::physics::Physics;
use crate::queue::GROUND;
use crate::shape::Shape;
use crate::shape::form::{Form, Place};
use crate::sight::Sight;
use crate::tree::Way;
use glam::DVec3;
use simbeeotic_kernel::SimTime;
use simbeeotic_units::Pose;

/// More than rounding does to a bounding ball, relative.
pub(crate) const BALL: f64 = 1.0 + 1e-6;

/// A straight line of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins, ENU, m, no farther than 1e9 m from the origin.
    pub origin_enu: DVec3,
    /// Where it goes, ENU; of any length but 0, which does not matter.
    pub direction_enu: DVec3,
    /// How far it goes, m, above 0 and at most 1e9.
    pub range_m: f64,
}

/// What a ray or a moving shape meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The body; `None` is the ground.
    pub body: Option<BodyId>,
    /// How far the ray or the shape goes until then, m.
    pub distance_m: f64,
    /// Where on the surface, ENU, m.
    pub point_enu: DVec3,
    /// The surface's outward normal there, unit, ENU.
    pub normal_enu: DVec3,
}

/// What a query takes notice of; everything by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sees {
    /// Bodies of these kinds, whomever they collide with; of [`Kind::Ground`] is the ground itself.
    pub kinds: Kinds,
    /// All but this body: as a rule, the one that looks.
    pub but: Option<BodyId>,
}

impl Sees {
    fn ground(&self) -> bool {
        self.kinds.contains(Kind::Ground)
    }
}

/// A checked ray.
pub(crate) struct Line {
    pub(crate) from: DVec3,
    pub(crate) direction: DVec3,
    pub(crate) range: f64,
}

impl Line {
    pub(crate) fn new(from: DVec3, direction: DVec3, range: f64) -> Result<Self, BodyError> {
        error::bounded("origin [m]", from, limits::POSITION_M_MAX)?;
        error::finite("direction", direction)?;
        let greatest = direction.abs().max_element();
        if greatest == 0.0 {
            return Err(BodyError::NotPositive {
                what: "length of the direction",
                value: 0.0,
            });
        }
        error::positive("range [m]", range, limits::POSITION_M_MAX)?;
        Ok(Self {
            from,
            // Dividing twice avoids overflow and underflow of the length.
            direction: (direction / greatest).normalize(),
            range,
        })
    }

    /// The part of a ball of `radius` about `centre` that comes nearest before all else; `None` if the
    /// line passes it by, or ends before it.
    fn passes(&self, centre: DVec3, radius: f64, range: f64) -> Option<Passing> {
        let offset = centre - self.from;
        let along = offset.dot(self.direction);
        let aside_squared = (offset - self.direction * along).length_squared();
        let meets = aside_squared <= radius * radius && along + radius >= 0.0;
        (meets && along - radius <= range).then_some(Passing {
            offset,
            along,
            aside_squared,
        })
    }
}

/// How a line passes the centre of a ball.
struct Passing {
    /// From the line's beginning to the centre.
    offset: DVec3,
    /// Of this, along the line, and the square of what is across it.
    along: f64,
    aside_squared: f64,
}

/// The nearest so far: distance, body or [`GROUND`], normal.
#[derive(Clone, Copy)]
pub(crate) struct Nearest {
    pub(crate) distance: f64,
    pub(crate) id: u32,
    pub(crate) normal: DVec3,
    pub(crate) point: DVec3,
}

impl Nearest {
    fn none(range: f64) -> Self {
        Self {
            distance: range,
            id: NOBODY,
            normal: DVec3::ZERO,
            point: DVec3::ZERO,
        }
    }

    /// Of two at the same distance the lower id counts; the ground comes after all bodies. Tells whether it
    /// is the nearest now.
    #[inline]
    pub(crate) fn offer(&mut self, other: Self) -> bool {
        let nearer = other.distance < self.distance;
        let tie = other.distance == self.distance;
        let counts = nearer || tie && (self.id == NOBODY || other.id < self.id);
        if counts {
            *self = other;
        }
        counts
    }

    #[inline]
    pub(crate) fn hit(self) -> Option<Hit> {
        (self.id != NOBODY).then_some(Hit {
            body: (self.id != GROUND).then_some(BodyId(self.id)),
            distance_m: self.distance,
            point_enu: self.point,
            normal_enu: self.normal,
        })
    }
}

/// No body has this id, as there are fewer than 2^32 - 1.
const NOBODY: u32 = GROUND - 1;

/// A checked shape and where it begins.
struct Moving {
    form: Form,
    at: Place,
}

impl Moving {
    fn new(shape: &Shape, at: Pose) -> Result<Self, BodyError> {
        shape.check()?;
        let at = Place {
            p: at.position.si(),
            q: at.attitude.quat(),
        };
        error::bounded("position [m]", at.p, limits::POSITION_M_MAX)?;
        error::attitude(simbeeotic_units::Attitude::from_unit_quat(at.q))?;
        match shape {
            Shape::Plane | Shape::HeightField(_) => Err(BodyError::ShapeMoves {
                shape: shape.name(),
            }),
            _ => Ok(Self {
                form: Form::new(shape, true)?,
                at,
            }),
        }
    }
}

impl Physics {
    /// Appends every body whose centre of mass lies within `radius_m` of `p_enu` at `t`, by id.
    ///
    /// `t` is the present, or any instant until the next of [`next_time`](Self::next_time); asking for
    /// another time is right, too, but slow.
    pub fn near(&self, p_enu: DVec3, radius_m: f64, t: SimTime, found: &mut Vec<BodyId>) {
        self.ask();
        let mut candidates = Vec::new();
        if self.lists_hold(t) {
            self.lists.around(p_enu, radius_m, &mut candidates);
            candidates.extend(self.loose());
            self.statics
                .near([p_enu - radius_m, p_enu + radius_m], &mut candidates);
        } else {
            candidates.extend(0..self.motions.len() as u32);
        }
        let within = |id: &u32| self.motions[*id as usize].position(t).distance(p_enu) <= radius_m;
        candidates.retain(within);
        candidates.sort_unstable();
        candidates.dedup();
        found.extend(candidates.into_iter().map(BodyId));
    }

    /// What `ray` meets first at `t`.
    ///
    /// A ray that begins in a body, or below the ground, does not see it; so a sensor within its own body
    /// looks out of it, and `sees.but` spares even the look. The triangles of a mesh and of a height field
    /// that does not move freely are seen from either side. Of two things at the same distance the body
    /// with the lower id counts, and the ground last. `t` is as for [`near`](Self::near).
    ///
    /// # Errors
    /// Not finite, farther than 1e9 m, a direction of length 0.
    pub fn cast_ray(&self, ray: &Ray, t: SimTime, sees: &Sees) -> Result<Option<Hit>, BodyError> {
        let line = Line::new(ray.origin_enu, ray.direction_enu, ray.range_m)?;
        Ok(self.first_seen(&self.sight(t), &line, t, sees))
    }

    /// What `shape` meets first at `t` if it moves from `at` along `direction_enu` for `range_m`, without
    /// turning, while all else stands still as it is at `t`. What it overlaps at its start, it meets at
    /// distance 0. The point and the normal are those of what it meets, to 1e-9 m.
    ///
    /// A mesh counts as its convex hull, as for a body that moves freely. The shape is made ready at each
    /// call, which takes long for one of many points. Ties and `t` are as for
    /// [`cast_ray`](Self::cast_ray).
    ///
    /// # Errors
    /// As [`cast_ray`](Self::cast_ray), a shape that cannot be, a plane, a height field.
    pub fn cast_shape(
        &self,
        shape: &Shape,
        at: Pose,
        direction_enu: DVec3,
        range_m: f64,
        t: SimTime,
        sees: &Sees,
    ) -> Result<Option<Hit>, BodyError> {
        let moving = Moving::new(shape, at)?;
        let line = Line::new(moving.at.p, direction_enu, range_m)?;
        let mut nearest = Nearest::none(line.range);
        if sees.ground() && self.ground.is_some() {
            let gap = moving.form.gap_to_ground(moving.at);
            let sinks = -line.direction.z;
            let distance = if gap.distance <= 0.0 {
                Some(0.0)
            } else {
                (sinks > 0.0).then(|| gap.distance / sinks)
            };
            if let Some(distance) = distance.filter(|distance| *distance <= line.range) {
                let point = gap.here + line.direction * distance;
                nearest.offer(Nearest {
                    distance,
                    id: GROUND,
                    normal: DVec3::Z,
                    point: point.truncate().extend(0.0),
                });
            }
        }
        let [low, high] = moving.form.bounds(moving.at);
        let way = Way::new(0.5 * (low + high), line.direction, 0.5 * (high - low));
        self.sight(t).along(&way, nearest.distance, |id, _| {
            if let Some(other) = self.first_touch(id, &moving, &line, nearest.distance, t, sees) {
                nearest.offer(other);
            }
            nearest.distance
        });
        Ok(nearest.hit())
    }

    /// Appends every body that `shape` at `at` overlaps or touches at `t`, by id; never the ground.
    ///
    /// A mesh counts as its convex hull; one that is fixed in the world, as its triangles. `t` is as for
    /// [`near`](Self::near).
    ///
    /// # Errors
    /// As [`cast_shape`](Self::cast_shape).
    pub fn overlaps(
        &self,
        shape: &Shape,
        at: Pose,
        t: SimTime,
        sees: &Sees,
        found: &mut Vec<BodyId>,
    ) -> Result<(), BodyError> {
        let moving = Moving::new(shape, at)?;
        let first = found.len();
        self.sight(t)
            .overlapping(moving.form.bounds(moving.at), |id| {
                let motion = &self.motions[id as usize];
                let radii = (motion.radius_m() + moving.form.radius()) * BALL;
                if self.visible(id, sees)
                    && motion.position(t).distance(moving.at.p) <= radii
                    && self
                        .form(id)
                        .gap(motion.place(t), &moving.form, moving.at)
                        .distance
                        <= 0.0
                {
                    found.push(BodyId(id));
                }
            });
        found[first..].sort_unstable();
        let mut last = None;
        let mut place = 0;
        found.retain(|id| {
            place += 1;
            place <= first || last.replace(*id) != Some(*id)
        });
        Ok(())
    }

    #[inline]
    pub(crate) fn visible(&self, id: u32, sees: &Sees) -> bool {
        sees.kinds.contains(self.kinds[id as usize]) && sees.but != Some(BodyId(id))
    }

    /// The ground, if the line meets it and somebody looks for it; nothing within its range, if not.
    #[inline]
    pub(crate) fn ground_seen(&self, line: &Line, sees: &Sees) -> Nearest {
        let mut nearest = Nearest::none(line.range);
        if sees.ground() && self.ground.is_some() && line.from.z > 0.0 && line.direction.z < 0.0 {
            let distance = line.from.z / -line.direction.z;
            if distance <= line.range {
                let point = line.from + line.direction * distance;
                nearest.offer(Nearest {
                    distance,
                    id: GROUND,
                    normal: DVec3::Z,
                    point: point.truncate().extend(0.0),
                });
            }
        }
        nearest
    }

    pub(crate) fn first_seen(
        &self,
        sight: &Sight<'_>,
        line: &Line,
        t: SimTime,
        sees: &Sees,
    ) -> Option<Hit> {
        let mut nearest = self.ground_seen(line, sees);
        let way = Way::new(line.from, line.direction, DVec3::ZERO);
        sight.along(&way, nearest.distance, |id, _| {
            if let Some((distance, normal)) = self.seen(id, line, nearest.distance, t, sees) {
                nearest.offer(Nearest {
                    distance,
                    id,
                    normal,
                    point: line.from + line.direction * distance,
                });
            }
            nearest.distance
        });
        nearest.hit()
    }

    /// Where the line first meets a body within `range`: distance and normal.
    #[inline]
    fn seen(
        &self,
        id: u32,
        line: &Line,
        range: f64,
        t: SimTime,
        sees: &Sees,
    ) -> Option<(f64, DVec3)> {
        let motion = &self.motions[id as usize];
        let p = motion.position(t);
        let passing = line.passes(p, motion.radius_m() * BALL, range)?;
        if !self.visible(id, sees) {
            return None;
        }
        let form = self.form(id);
        let (distance, normal) = if let Some(radius) = form.ball() {
            let square = radius * radius;
            if passing.aside_squared > square || passing.offset.length_squared() <= square {
                return None;
            }
            let distance = passing.along - (square - passing.aside_squared).sqrt();
            let normal = (line.direction * distance - passing.offset) / radius;
            (distance, normal)
        } else {
            form.cast_ray(motion.place(t), line.from, line.direction, range)?
        };
        (distance > 0.0 && distance <= range).then_some((distance, normal))
    }

    /// Where the moving shape first touches a body within `range`.
    fn first_touch(
        &self,
        id: u32,
        moving: &Moving,
        line: &Line,
        range: f64,
        t: SimTime,
        sees: &Sees,
    ) -> Option<Nearest> {
        let motion = &self.motions[id as usize];
        let p = motion.position(t);
        line.passes(p, (motion.radius_m() + moving.form.radius()) * BALL, range)?;
        if !self.visible(id, sees) {
            return None;
        }
        let (distance, gap) = self.form(id).cast_form(
            motion.place(t),
            &moving.form,
            moving.at,
            line.direction,
            range,
        )?;
        (distance <= range).then_some(Nearest {
            distance,
            id,
            normal: gap.normal,
            point: gap.here,
        })
    }
}

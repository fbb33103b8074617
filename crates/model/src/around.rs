//! What a sensor finds around itself: by rays from where it sits, and by what is near.

use crate::message::Thing;
use crate::sees::SeesWhat;
use crate::view::Truth;
use simbeeotic_physics::{BodyId, Hit, Kind, Ray, Sees, Shape};
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::{Length, Position};
use std::cell::RefCell;

/// What one ray of a sensor meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Echo {
    /// What it is.
    pub thing: Thing,
    /// What it counts as.
    pub kind: Kind,
    /// How far it is.
    pub distance: Length,
    /// Cosine of the angle between the ray and the surface's normal, 0 to 1: a surface that is met
    /// squarely has 1.
    pub facing: f64,
    /// The surface's outward normal, of unit length, world frame.
    pub normal: [f64; 3],
}

/// One body near a sensor. An object of the world may be made of several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearby {
    /// Whose body it is.
    pub thing: Thing,
    /// What it counts as.
    pub kind: Kind,
    /// Where its centre is.
    pub position: Position,
}

/// Room for the rays of one reading after another.
#[derive(Default)]
struct Room {
    rays: Vec<Ray>,
    hits: Vec<Option<Hit>>,
}

thread_local! {
    static ROOM: RefCell<Room> = RefCell::default();
}

/// A sphere that overlaps something touches it already: how far it has to move to find out, m.
const NO_WAY_M: f64 = 1e-9;

impl Truth<'_> {
    /// Casts a ray from the sensor along each of some directions, given in the sensor's own frame and of
    /// unit length, and hands over what it meets first of `what` within `range`: its place among the
    /// directions, and the echo. Rays pass through the host itself.
    ///
    /// A `range` that is not above 0 and at most 1e9 m, or a direction that is none, meets nothing, as
    /// does all else in the call. Nothing is allocated.
    pub fn look(
        &self,
        directions: impl IntoIterator<Item = DVec3>,
        range: Length,
        what: SeesWhat,
        mut each: impl FnMut(usize, Option<Echo>),
    ) {
        let pose = self.sensor_pose();
        let (origin_enu, turn) = (pose.position.si(), pose.attitude.matrix());
        // Taken out, as `each` may look again.
        let mut room = ROOM.take();
        let Room { rays, hits } = &mut room;
        rays.clear();
        hits.clear();
        rays.extend(directions.into_iter().map(|direction| Ray {
            origin_enu,
            direction_enu: turn * direction,
            range_m: range.get(),
        }));
        let physics = &self.swarm.physics;
        let answer = physics.cast_rays(rays, self.now, &self.sees(what), hits);
        for (at, ray) in rays.iter().enumerate() {
            let hit = answer.as_ref().ok().and_then(|()| hits[at]);
            each(at, hit.map(|hit| self.echo(ray, &hit)));
        }
        ROOM.set(room);
    }

    fn echo(&self, ray: &Ray, hit: &Hit) -> Echo {
        let (thing, kind) = self.thing(hit.body);
        Echo {
            thing,
            kind,
            distance: Length::si(hit.distance_m),
            facing: hit.normal_enu.dot(ray.direction_enu).abs().min(1.0),
            normal: hit.normal_enu.to_array(),
        }
    }

    /// All bodies of `what` that reach into a ball of `radius` about the sensor, but for the host's own:
    /// those of models first, then those of the world, each in a fixed order. Never the ground.
    ///
    /// It costs what there is within the box around the ball. A radius that is not above 0 and at most
    /// 1e5 m finds nothing.
    pub fn nearby(&self, radius: Length, what: SeesWhat) -> Vec<Nearby> {
        let ball = Shape::Sphere {
            radius_m: radius.get(),
        };
        let mut bodies = Vec::new();
        let physics = &self.swarm.physics;
        let place = self.sensor_pose();
        let answer = physics.overlaps(&ball, place, self.now, &self.sees(what), &mut bodies);
        if answer.is_err() {
            bodies.clear();
        }
        let nearby = bodies.into_iter().map(|body| {
            let (thing, kind) = self.thing(Some(body));
            let position = Position::from_si(physics.motion(body).position(self.now));
            Nearby {
                thing,
                kind,
                position,
            }
        });
        nearby.collect()
    }

    /// What a ball of `radius` about the sensor overlaps or touches of `what`, the ground included and the
    /// host's own body not: one thing if there are several. `None` as well for a radius that is not above
    /// 0 and at most 1e5 m.
    pub fn touching(&self, radius: Length, what: SeesWhat) -> Option<(Thing, Kind)> {
        let ball = Shape::Sphere {
            radius_m: radius.get(),
        };
        let (physics, place) = (&self.swarm.physics, self.sensor_pose());
        let sees = self.sees(what);
        let met = physics.cast_shape(&ball, place, DVec3::NEG_Z, NO_WAY_M, self.now, &sees);
        Some(self.thing(met.ok()??.body))
    }

    fn sees(&self, what: SeesWhat) -> Sees {
        Sees {
            kinds: what.kinds(),
            but: self.swarm.body_of(self.host),
        }
    }

    /// What a body is; none is the ground.
    fn thing(&self, body: Option<BodyId>) -> (Thing, Kind) {
        let swarm = self.swarm;
        body.map_or((Thing::Ground, Kind::Ground), |body| {
            (swarm.owners[body.index()], swarm.physics.kind(body))
        })
    }
}

//! What a model can ask of everything that has a body: the truth about where it is and moves, and
//! what a ray meets.

use super::Cx;
use crate::message::Thing;
use crate::sees::SeesWhat;
use crate::swarm::Swarm;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_physics::{BodyError, BodyId, Hit, Kind, Sees, Shape, State};
use simbeeotic_units::{Accel, Enu, Length, Pose, Position, Twist, glam};
use simbeeotic_world::World;

/// A straight line of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins.
    pub origin: Position,
    /// Where it goes, world frame; of any length but 0, which does not matter.
    pub direction: [f64; 3],
    /// How far it goes. Above 0.
    pub range: Length,
}

/// What a ray, or a shape on its way, meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// What it is.
    pub thing: Thing,
    /// What it counts as: a person, say.
    pub kind: Kind,
    /// How far the ray or the shape goes until then.
    pub distance: Length,
    /// Where on its surface.
    pub point: Position,
    /// The surface's outward normal there, of unit length, world frame.
    pub normal: [f64; 3],
}

impl Swarm {
    /// What each ray meets first of `what`, whoever looks being `but`.
    pub(crate) fn cast_rays(
        &self,
        rays: &[Ray],
        now: SimTime,
        what: SeesWhat,
        but: Option<BodyId>,
    ) -> Result<Vec<Option<Seen>>, BodyError> {
        let rays: Vec<_> = rays
            .iter()
            .map(|ray| simbeeotic_physics::Ray {
                origin_enu: ray.origin.si(),
                direction_enu: glam::DVec3::from_array(ray.direction),
                range_m: ray.range.get(),
            })
            .collect();
        let mut hits = Vec::with_capacity(rays.len());
        self.physics
            .cast_rays(&rays, now, &sees(what, but), &mut hits)?;
        Ok(hits
            .into_iter()
            .map(|hit| hit.map(|h| self.seen(h)))
            .collect())
    }

    fn seen(&self, hit: Hit) -> Seen {
        Seen {
            thing: hit
                .body
                .map_or(Thing::Ground, |body| self.owners[body.index()]),
            kind: hit
                .body
                .map_or(Kind::Ground, |body| self.physics.kind(body)),
            distance: Length::si(hit.distance_m),
            point: Position::from_si(hit.point_enu),
            normal: hit.normal_enu.to_array(),
        }
    }
}

fn sees(what: SeesWhat, but: Option<BodyId>) -> Sees {
    Sees {
        kinds: what.kinds(),
        but,
    }
}

impl Cx<'_> {
    /// What stands in the world.
    pub fn world(&self) -> &World {
        &self.swarm.world
    }

    /// The true pose of a model's body, as it was when this round began. `None` if it has none.
    pub fn pose_of(&self, id: ModelId) -> Option<Pose> {
        self.swarm.pose_of(id, self.now)
    }

    /// The radius of the sphere around a model's body. `None` if it has none.
    pub fn radius_of(&self, id: ModelId) -> Option<Length> {
        self.swarm.radius_of(id)
    }

    /// The true twist of a model's body, as it was when this round began. `None` if it has none.
    pub fn twist_of(&self, id: ModelId) -> Option<Twist> {
        self.swarm.twist_of(id, self.now)
    }

    /// The true acceleration of a model's body, world frame, gravity included, as it was when this
    /// round began. `None` if it has none.
    pub fn acceleration_of(&self, id: ModelId) -> Option<Accel<Enu>> {
        Some(self.state_of(id, self.now)?.accel())
    }

    /// Pose, twist and acceleration of a model's body at another time: exactly where it was at any
    /// time since its last change, and where it will be if nothing changes. `None` if it has no
    /// body, or if that changed its course after `at`.
    pub fn state_of(&self, id: ModelId, at: SimTime) -> Option<State> {
        let motion = self.swarm.physics.motion(self.swarm.body_of(id)?);
        (motion.start() <= at).then(|| motion.at(at))
    }

    /// All models with a body whose centre is within `radius` of `place`, as the instant began, but
    /// for this one. In the order of their ids.
    pub fn neighbors_of(&self, place: Position, radius: Length) -> Vec<ModelId> {
        self.swarm.neighbors(place, radius, self.now, self.core.id)
    }

    /// What a ray meets first, as the instant began: a model, an object of the world, the ground;
    /// `None` if nothing within its range. The own body is transparent.
    ///
    /// A ray that is none (a number that is not finite, no direction, no range) ends the run with an
    /// error that names this model.
    pub fn cast_ray(&mut self, ray: &Ray) -> Option<Seen> {
        self.cast_rays(std::slice::from_ref(ray))
            .into_iter()
            .next()
            .flatten()
    }

    /// The same for many rays: one answer each, in their order. None at all if one of them is no ray.
    pub fn cast_rays(&mut self, rays: &[Ray]) -> Vec<Option<Seen>> {
        self.cast_rays_seeing(rays, SeesWhat::default())
    }

    /// The same for rays that pass through all but `what`.
    pub fn cast_rays_seeing(&mut self, rays: &[Ray], what: SeesWhat) -> Vec<Option<Seen>> {
        let seen = self.swarm.cast_rays(rays, self.now, what, self.core.body);
        self.unless_refused(seen).unwrap_or_default()
    }

    /// What a shape at a pose meets first on a straight way, without turning; where it starts to
    /// overlap something, after no distance. The own body is transparent.
    ///
    /// What physics refuses ends the run with an error that names this model.
    pub fn cast_shape(
        &mut self,
        shape: &Shape,
        at: Pose,
        direction: [f64; 3],
        range: Length,
    ) -> Option<Seen> {
        let (way, sees) = (
            glam::DVec3::from_array(direction),
            sees(SeesWhat::default(), self.core.body),
        );
        let (physics, now) = (&self.swarm.physics, self.now);
        let hit = physics.cast_shape(shape, at, way, range.get(), now, &sees);
        let hit = self.unless_refused(hit)??;
        Some(self.swarm.seen(hit))
    }

    /// All models and objects whose body overlaps a shape at a pose, those of models first, by id.
    /// The own body is not among them.
    ///
    /// What physics refuses ends the run with an error that names this model.
    pub fn overlapping(&mut self, shape: &Shape, at: Pose) -> Vec<Thing> {
        let (sees, mut bodies) = (sees(SeesWhat::default(), self.core.body), Vec::new());
        let physics = &self.swarm.physics;
        let found = physics.overlaps(shape, at, self.now, &sees, &mut bodies);
        self.unless_refused(found);
        let owners = bodies.into_iter().map(|b| self.swarm.owners[b.index()]);
        owners.collect()
    }

    fn unless_refused<T>(&mut self, answer: Result<T, BodyError>) -> Option<T> {
        answer.map_err(|error| self.fault(error)).ok()
    }
}

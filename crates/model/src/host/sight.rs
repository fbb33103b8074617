//! What a model can ask of everything that has a body: the truth about where it is and moves.

use super::Cx;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_physics::State;
use simbeeotic_units::{Accel, Enu, Length, Pose, Position, Twist};
use simbeeotic_world::World;

impl Cx<'_> {
    /// What stands in the world.
    pub fn world(&self) -> &World {
        &self.swarm.world
    }

    /// The true pose of a model's body, as it was when this round began. `None` if it has none.
    pub fn pose_of(&self, id: ModelId) -> Option<Pose> {
        self.swarm.pose_of(id, self.now)
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
}

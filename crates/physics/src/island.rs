//! The world of one contact island: its bodies and what they touch, stepped by Rapier.
//!
//! A world holds one island and nothing else, so what happens in it depends on its own history only. It
//! counts from an origin of its own near its bodies, so that contact is as exact far from the world's
//! origin as close to it.
//!
//! Rapier's own sleep is off (an island is put to rest as a whole, see `islands`), and so is its gravity
//! (weight is part of the wrench that a body carries).

use crate::body::Material;
use crate::queue::GROUND;
use crate::shape::convert::{from_parry, from_pose, to_parry, to_pose};
use crate::shape::form::{Form, Place};
use glam::DVec3;
use rapier3d_f64::dynamics::{
    CCDSolver, CoefficientCombineRule, FrictionModel, ImpulseJointSet, IntegrationParameters,
    IslandManager, LockedAxes, MassProperties, MultibodyJointSet, RigidBodyBuilder,
    RigidBodyHandle, RigidBodySet, SoftBodySet, SpringCoefficients,
};
use rapier3d_f64::geometry::{
    BroadPhaseBvh, ColliderBuilder, ColliderHandle, ColliderSet, ContactManifold, ContactPair,
    Group, InteractionGroups, InteractionTestMode, NEW_CONTACT_BIT, NarrowPhase, SharedShape,
};
use rapier3d_f64::math::{Pose, Vector};
use rapier3d_f64::pipeline::PhysicsPipeline;

/// Half of the ground's breadth about the origin of a world, and its depth, m.
const GROUND_HALF_M: f64 = 1e4;
/// A body that has gone farther than this from the origin of its world calls for a new origin, m.
pub(crate) const REACH_M: f64 = 0.5 * GROUND_HALF_M;
/// Contact is foreseen from this distance on, at least, m.
const PREDICTION_M: f64 = 0.01;
/// and from this many times as far on as the fastest body goes in a step: whoever is hit by it may go as far.
const PREDICTION_WAYS: f64 = 2.0;
/// Two in contact whose places relative to one another have changed by less keep their points of
/// contact, m.
const RECYCLE_M: f64 = 1e-4;
/// Depth that is left uncorrected, m.
const SLOP_M: f64 = 1e-4;
/// The fastest way out of a solid, m/s.
const RECOVERY_M_S: f64 = 1.0;

/// Natural frequency of a contact between two that move, over that of the substeps; and of one with
/// something fixed. As Rapier has them at its own default step.
const PAIR_STIFFNESS: f64 = 0.125;
const FIXED_STIFFNESS: f64 = 0.25;
/// Damping of a contact over the critical one.
const CONTACT_DAMPING: f64 = 10.0;

/// Linear velocity and rate of turn, both ENU.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sweep {
    /// m/s.
    pub(crate) v: DVec3,
    /// rad/s.
    pub(crate) w: DVec3,
}

/// What of a body matters where it touches another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface {
    pub(crate) id: u32,
    pub(crate) material: Material,
    /// Groups it is in, and those it collides with.
    pub(crate) groups: [u16; 2],
}

/// How a body takes part.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Role {
    /// Contacts push it.
    Free {
        mass: f64,
        inertia: DVec3,
        /// It does not turn.
        upright: bool,
    },
    /// It pushes others.
    Driven,
}

/// Two that press upon one another, as of the last step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    /// The lower id first; the ground is [`GROUND`].
    pub(crate) pair: (u32, u32),
    /// Where the impulse was strongest, ENU, m.
    pub(crate) point: DVec3,
    /// From the first to the second, unit.
    pub(crate) normal: DVec3,
    /// On the first, over the step, N s.
    pub(crate) impulse: DVec3,
}

/// A point that bore a load in the last step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadedPoint {
    pub(crate) pair: (u32, u32),
    /// ENU, m.
    pub(crate) point: DVec3,
    /// From the first to the second, unit.
    pub(crate) normal: DVec3,
    pub(crate) friction: f64,
    /// Force along the normal, N.
    pub(crate) along: f64,
}

/// A Rapier world.
pub(crate) struct World {
    origin: DVec3,
    parameters: IntegrationParameters,
    pipeline: PhysicsPipeline,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
    bodies: RigidBodySet,
    colliders: ColliderSet,
    joints: ImpulseJointSet,
    multibodies: MultibodyJointSet,
    soft_bodies: SoftBodySet,
    ccd: CCDSolver,
}

impl std::fmt::Debug for World {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("World")
            .field("origin", &self.origin)
            .field("bodies", &self.bodies.len())
            .field("colliders", &self.colliders.len())
            .finish_non_exhaustive()
    }
}

/// The bit that says "may meet the ground": bodies in no group do.
const ANYONE: u32 = 1 << 16;

fn interaction(groups: [u16; 2]) -> InteractionGroups {
    let [memberships, filter] = groups.map(u32::from);
    InteractionGroups::new(
        Group::from_bits_truncate(memberships | ANYONE),
        Group::from_bits_truncate(filter),
        InteractionTestMode::And,
    )
}

fn collider(shape: SharedShape, surface: &Surface) -> ColliderBuilder {
    ColliderBuilder::new(shape)
        .density(0.0)
        .friction(surface.material.friction)
        .friction_combine_rule(CoefficientCombineRule::GeometricMean)
        .restitution(surface.material.restitution)
        .restitution_combine_rule(CoefficientCombineRule::GeometricMean)
        .collision_groups(interaction(surface.groups))
        .user_data(u128::from(surface.id))
}

impl World {
    /// An empty world about `origin`, for steps of `dt_s`.
    pub(crate) fn new(origin: DVec3, solver_iterations: usize, dt_s: f64) -> Self {
        let substeps_hz = solver_iterations as f64 / dt_s;
        let softness = |share: f64| SpringCoefficients {
            natural_frequency: share * substeps_hz,
            damping_ratio: CONTACT_DAMPING,
        };
        let parameters = IntegrationParameters {
            num_solver_iterations: solver_iterations,
            normalized_allowed_linear_error: SLOP_M,
            normalized_max_corrective_velocity: RECOVERY_M_S,
            normalized_prediction_distance: PREDICTION_M,
            normalized_max_linear_velocity: f64::MAX,
            normalized_contact_recycle_distance: RECYCLE_M,
            contact_softness: softness(PAIR_STIFFNESS),
            static_contact_softness: softness(FIXED_STIFFNESS),
            // Rapier's other model, one constraint a point, falls 6 % short of Coulomb's friction.
            friction_model: FrictionModel::Simplified,
            ..IntegrationParameters::default()
        };
        Self {
            origin,
            parameters,
            pipeline: PhysicsPipeline::new(),
            islands: IslandManager::new(),
            broad_phase: BroadPhaseBvh::new(),
            narrow_phase: NarrowPhase::new(),
            bodies: RigidBodySet::new(),
            colliders: ColliderSet::new(),
            joints: ImpulseJointSet::new(),
            multibodies: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
            ccd: CCDSolver::new(),
        }
    }

    pub(crate) fn origin(&self) -> DVec3 {
        self.origin
    }

    fn local(&self, place: Place) -> Pose {
        to_pose(Place {
            p: place.p - self.origin,
            q: place.q,
        })
    }

    /// Puts in the ground, the solid below up = 0.
    pub(crate) fn add_ground(&mut self, material: Material, group: u16) {
        let half = GROUND_HALF_M;
        let surface = Surface {
            id: GROUND,
            material,
            groups: [group, u16::MAX],
        };
        let top = -self.origin.z;
        let ground = collider(SharedShape::cuboid(half, half, half), &surface)
            .translation(Vector::new(0.0, 0.0, top - half))
            .collision_groups(InteractionGroups::new(
                Group::from_bits_truncate(u32::from(group)),
                Group::ALL,
                InteractionTestMode::And,
            ));
        self.colliders.insert(ground);
    }

    /// Puts in something that never moves.
    pub(crate) fn add_fixed(&mut self, surface: &Surface, form: &Form, at: Place) {
        let (shape, offset) = form.shared();
        let collider = collider(shape.clone(), surface).position(self.local(at) * offset);
        self.colliders.insert(collider);
    }

    /// Puts in a body that moves.
    pub(crate) fn add(
        &mut self,
        surface: &Surface,
        form: &Form,
        role: Role,
        at: Place,
        sweep: Sweep,
    ) -> RigidBodyHandle {
        let builder = match role {
            Role::Free {
                mass,
                inertia,
                upright,
            } => {
                let locked = if upright {
                    LockedAxes::ROTATION_LOCKED
                } else {
                    LockedAxes::empty()
                };
                RigidBodyBuilder::dynamic()
                    .additional_mass_properties(MassProperties::new(
                        Vector::ZERO,
                        mass,
                        to_parry(inertia),
                    ))
                    .locked_axes(locked)
                    .gyroscopic_forces_enabled(true)
            }
            Role::Driven => RigidBodyBuilder::kinematic_position_based(),
        };
        let body = builder
            .pose(self.local(at))
            .linvel(to_parry(sweep.v))
            .angvel(to_parry(sweep.w))
            .can_sleep(false)
            .allow_fast_rotation(true);
        let handle = self.bodies.insert(body);
        let (shape, offset) = form.shared();
        self.colliders.insert_with_parent(
            collider(shape.clone(), surface).position(offset),
            handle,
            &mut self.bodies,
        );
        handle
    }

    pub(crate) fn remove(&mut self, body: RigidBodyHandle) {
        self.bodies.remove(
            body,
            &mut self.islands,
            &mut self.colliders,
            &mut self.joints,
            &mut self.multibodies,
            &mut self.soft_bodies,
            true,
        );
    }

    /// Where a body stands.
    pub(crate) fn place(&self, body: RigidBodyHandle) -> Place {
        let place = from_pose(*self.bodies[body].position());
        Place {
            p: self.origin + place.p,
            q: place.q,
        }
    }

    /// How a body moves.
    pub(crate) fn sweep(&self, body: RigidBodyHandle) -> Sweep {
        let body = &self.bodies[body];
        Sweep {
            v: from_parry(body.linvel()),
            w: from_parry(body.angvel()),
        }
    }

    pub(crate) fn set_place(&mut self, body: RigidBodyHandle, at: Place) {
        let pose = self.local(at);
        self.bodies[body].set_position(pose, true);
    }

    pub(crate) fn set_sweep(&mut self, body: RigidBodyHandle, sweep: Sweep) {
        let body = &mut self.bodies[body];
        body.set_linvel(to_parry(sweep.v), true);
        body.set_angvel(to_parry(sweep.w), true);
    }

    /// Lets `force` and `torque`, both ENU, act until they are set again.
    pub(crate) fn set_wrench(&mut self, body: RigidBodyHandle, force: DVec3, torque: DVec3) {
        let body = &mut self.bodies[body];
        body.reset_forces(true);
        body.add_force(to_parry(force), true);
        body.reset_torques(true);
        body.add_torque(to_parry(torque), true);
    }

    /// Lets a driven body arrive at `to` with the next step.
    pub(crate) fn drive(&mut self, body: RigidBodyHandle, to: Place) {
        let pose = self.local(to);
        self.bodies[body].set_next_kinematic_position(pose);
    }

    /// One step of `dt_s`, in which the fastest body goes `way` as it now moves, m.
    pub(crate) fn step(&mut self, dt_s: f64, way: f64) {
        self.parameters.dt = dt_s;
        self.foresee(way);
        self.pipeline.step(
            Vector::ZERO,
            &self.parameters,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut self.joints,
            &mut self.multibodies,
            &mut self.soft_bodies,
            &mut self.ccd,
            &(),
            &(),
        );
    }

    /// Sets from how far on contact is foreseen.
    ///
    /// A body that lies a hair's breadth from another may be driven into it by a third within one step. So
    /// how far is a matter of the fastest of all, not of the two (as it is in Rapier's own soft continuous
    /// detection, which looks at no pair that is apart and does not close in). The distance is doubled and
    /// halved as needed, so that it changes seldom.
    fn foresee(&mut self, way: f64) {
        let mut distance = PREDICTION_M;
        while distance < PREDICTION_WAYS * way {
            distance *= 2.0;
        }
        let before = self.parameters.normalized_prediction_distance;
        self.parameters.normalized_prediction_distance = distance;
        let farther = distance > before;
        // What was known of pairs that hardly moved held for the shorter distance.
        self.parameters.normalized_contact_recycle_distance = if farther { 0.0 } else { RECYCLE_M };
        if farther {
            // Their boxes in the broad phase were grown by the shorter distance.
            for (_, collider) in self.colliders.iter_mut() {
                let pose = *collider.position();
                collider.set_position(pose);
            }
        }
    }

    /// Appends who pressed upon whom in the last step, in ascending order.
    pub(crate) fn touches(&self, touches: &mut Vec<Touch>) {
        let first = touches.len();
        touches.extend(
            self.narrow_phase
                .contact_pairs()
                .filter_map(|pair| self.touch(pair)),
        );
        touches[first..].sort_by_key(|touch| touch.pair);
    }

    /// The points that bore a load in the last step, but for those of bodies that have been removed since.
    pub(crate) fn loaded_points(&self) -> Vec<LoadedPoint> {
        let mut loaded = Vec::new();
        let stays = |pair: &&ContactPair| {
            [pair.collider1, pair.collider2]
                .iter()
                .all(|collider| self.colliders.contains(*collider))
        };
        for pair in self.narrow_phase.contact_pairs().filter(stays) {
            let ids = (self.id(pair.collider1), self.id(pair.collider2));
            for manifold in pair.solver_manifolds() {
                for (impulse, point, _) in self.points(pair, manifold) {
                    loaded.push(LoadedPoint {
                        pair: ids,
                        point,
                        normal: from_parry(manifold.data.normal),
                        friction: manifold.data.friction,
                        along: impulse / self.parameters.dt,
                    });
                }
            }
        }
        loaded
    }

    fn id(&self, collider: ColliderHandle) -> u32 {
        self.colliders[collider].user_data as u32
    }

    fn touch(&self, pair: &ContactPair) -> Option<Touch> {
        let mut most = 0.0;
        let mut point = DVec3::ZERO;
        let mut normal = DVec3::Z;
        let mut impulse = DVec3::ZERO;
        for manifold in pair.solver_manifolds() {
            for (along, at, across) in self.points(pair, manifold) {
                impulse -= from_parry(manifold.data.normal) * along - across;
                if along > most {
                    most = along;
                    point = at;
                    normal = from_parry(manifold.data.normal);
                }
            }
        }
        if most == 0.0 {
            return None;
        }
        let (a, b) = (self.id(pair.collider1), self.id(pair.collider2));
        let turned = if a < b { 1.0 } else { -1.0 };
        Some(Touch {
            pair: (a.min(b), a.max(b)),
            point,
            normal: normal * turned,
            impulse: impulse * turned,
        })
    }

    /// Impulse along the normal, place, and friction of the points that bore a load.
    fn points<'a>(
        &'a self,
        pair: &ContactPair,
        manifold: &'a ContactManifold,
    ) -> impl Iterator<Item = (f64, DVec3, DVec3)> + 'a {
        let first = self.colliders[pair.collider1].position();
        manifold
            .data
            .solver_contacts
            .iter()
            .filter_map(move |contact| {
                let point = &manifold.points[(contact.contact_id[0] & !NEW_CONTACT_BIT) as usize];
                (point.data.impulse > 0.0).then(|| {
                    let at = manifold
                        .subshape_pos1()
                        .map_or(*first, |offset| *first * *offset)
                        * point.local_p1;
                    let across = from_parry(point.data.warmstart_tangent_world);
                    let share = point.data.tangent_impulse.norm();
                    let across = across.try_normalize().unwrap_or(DVec3::ZERO) * share;
                    (point.data.impulse, self.origin + from_parry(at), across)
                })
            })
    }
}

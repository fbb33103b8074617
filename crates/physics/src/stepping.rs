//! One step of an island: what acts on its members, and where they go.

use crate::body::{BodyId, Material, Mobility, group};
use crate::contact::Contact;
use crate::duties::duty;
use crate::island::{REACH_M, Role, Surface, Sweep, Touch, World};
use crate::islands::{Island, Led, Member};
use crate::limits::NEWS_SPEED_M_S;
use crate::motion::{Motion, seconds_between};
use crate::physics::Physics;
use crate::queue::GROUND;
use crate::rotation;
use crate::shape::form::Place;
use glam::DVec3;
use simbeeotic_kernel::SimTime;

/// A member that has been still for so long rests, s.
pub(crate) const STILL_S: f64 = 0.5;
/// Still is what moves slower than this, m/s,
pub(crate) const STILL_SPEED_M_S: f64 = 1e-3;
/// and turns slower than this, rad/s.
pub(crate) const STILL_RATE_RAD_S: f64 = 1e-2;
/// A member at rest that its world has moved farther than this, m and rad, moves again.
const STIR: f64 = 1e-3;
/// Fixed bodies are looked for this far around a member, m,
const SCOPE_M: f64 = 0.5;
/// and as far as it gets in this time, s.
const SCOPE_S: f64 = 0.25;
/// Radius of the patch on which a ball stands, over that of the ball.
const PATCH: f64 = 0.01;
/// A place that differs by less is the same, m and rad: rounding.
const SAME: f64 = 1e-9;

/// Whether two places differ by more than rounding.
fn displaced(a: Place, b: Place) -> bool {
    let rounding = SAME + 1e-15 * a.p.abs().max_element();
    a.p.distance(b.p) > rounding || rotation::turn_between(a.q, b.q).length() > SAME
}

/// Whether a driven body stands.
pub(crate) fn stands(motion: &Motion) -> bool {
    motion.v == DVec3::ZERO && motion.w == DVec3::ZERO
}

/// Whether a body is driven from outside.
pub(crate) fn driven(motion: &Motion) -> bool {
    motion.mobility() == Mobility::Driven
}

impl Physics {
    /// Steps an island from `t` on.
    pub(crate) fn advance_island(
        &mut self,
        island: &mut Island,
        t: SimTime,
        contacts: &mut Vec<Contact>,
        changed: &mut Vec<u32>,
    ) {
        let end = t.saturating_add_nanos(self.islands.step_ns);
        let dt_s = seconds_between(t, end);
        let mut world = self.world_of(island);
        let before = self.take_in(island, &mut world, t);
        self.take_fixed_in(island, &mut world);
        for member in &island.members {
            let motion = &self.motions[member.id as usize];
            if let (true, Some(body)) = (driven(motion), member.body) {
                world.drive(body, motion.place(end));
            }
        }
        let pace = self.pace(island, &before, dt_s);
        world.step(dt_s, pace * dt_s);

        let mut touches = Vec::new();
        world.touches(&mut touches);
        report(island, &before, &touches, t, contacts);
        self.drill(island, &mut world, &touches);
        for (member, before) in island.members.iter_mut().zip(&before) {
            let motion = &mut self.motions[member.id as usize];
            let from = motion.position(t);
            let led = Step {
                world: &world,
                span: [t, end],
                dt_s,
                before: *before,
            }
            .lead(member, motion);
            if led {
                self.odometer.changed(from, motion, t);
                changed.push(member.id);
            }
            island.settling |= member.stays();
        }
        island.world = Some(world);
        island.cut = false;
        island.next = Some(end);
    }

    /// How fast a point of the fastest member moves, m/s; no member counts as faster than would take it its
    /// own radius in a step.
    fn pace(&self, island: &Island, sweeps: &[Sweep], dt_s: f64) -> f64 {
        let paces = island.members.iter().zip(sweeps).map(|(member, sweep)| {
            let radius = self.motions[member.id as usize].radius_m();
            let turning = if self.form(member.id).ball().is_some() {
                0.0
            } else {
                sweep.w.length() * radius
            };
            (sweep.v.length() + turning).min(radius / dt_s)
        });
        paces.fold(0.0, f64::max)
    }

    /// Friction against the spin of a ball about the normal of its contact, which a point would not have:
    /// that of an evenly loaded patch of radius `a`, a torque of `2/3 mu N a` at most.
    fn drill(&self, island: &Island, world: &mut World, touches: &[Touch]) {
        for touch in touches {
            let (a, b) = touch.pair;
            for (id, other) in [(a, b), (b, a)] {
                let Some(place) = island.position(id) else {
                    continue;
                };
                let Some(radius) = self.form(id).ball() else {
                    continue;
                };
                let motion = &self.motions[id as usize];
                let (true, Some(body)) = (
                    self.duties[id as usize] & duty::ROLLS != 0 && motion.inverse_mass > 0.0,
                    island.members[place].body,
                ) else {
                    continue;
                };
                let mut sweep = world.sweep(body);
                let spin = sweep.w.dot(touch.normal);
                if spin == 0.0 {
                    continue;
                }
                let friction = self.material(other).against(&self.material(id)).friction;
                let load = touch.impulse.dot(touch.normal).abs();
                let most = 2.0 / 3.0 * friction * load * PATCH * radius;
                let slower = most * motion.inverse_inertia().x;
                sweep.w -= touch.normal * spin.clamp(-slower, slower);
                world.set_sweep(body, sweep);
            }
        }
    }

    /// The surface of a body, or of the ground.
    pub(crate) fn material(&self, id: u32) -> Material {
        if id == GROUND {
            self.ground.unwrap_or_default()
        } else {
            self.outline(id).material
        }
    }

    /// The world of an island: a new one, if it has none, or has come far from its origin.
    fn world_of(&self, island: &mut Island) -> Box<World> {
        let motions = &self.motions;
        let far = |world: &World| {
            island
                .members
                .iter()
                .any(|member| member.at.p.distance(world.origin()) > REACH_M)
        };
        match island.world.take() {
            Some(world) if !far(&world) => world,
            _ => {
                island.detach();
                let ids = island.members.iter().map(|member| member.id);
                let first = ids.min_by_key(|id| self.rank(*id)).unwrap_or_default();
                let first = &motions[first as usize];
                let mut world = Box::new(World::new(
                    first.p.round(),
                    self.islands.solver_iterations,
                    self.islands.step_ns as f64 / 1e9,
                ));
                if let Some(material) = self.ground {
                    world.add_ground(material, group::TERRAIN);
                }
                world
            }
        }
    }

    /// Brings the world up to what has been changed from outside, newcomers included. Tells how each
    /// member moves.
    fn take_in(&self, island: &mut Island, world: &mut World, t: SimTime) -> Vec<Sweep> {
        let cut = island.cut;
        let mut sweeps = Vec::with_capacity(island.members.len());
        let mut newcomers = Vec::new();
        for (place, member) in island.members.iter_mut().enumerate() {
            let motion = &self.motions[member.id as usize];
            let mut sweep = member.sweep(motion, t);
            if self.upright(member.id) {
                // It came spinning, and cannot be stopped by a torque.
                sweep.w = DVec3::ZERO;
            }
            sweeps.push(sweep);
            let at = motion.place(t);
            let Some(body) = member.body else {
                newcomers.push(place);
                member.at = at;
                continue;
            };
            let changed = member.changed(motion);
            if driven(motion) {
                if displaced(member.at, at) {
                    world.set_place(body, at);
                    member.at = at;
                }
                continue;
            }
            if cut || changed {
                if cut || displaced(member.at, at) {
                    world.set_place(body, at);
                    member.at = at;
                }
                world.set_sweep(body, sweep);
            }
            let moved = member.moved(motion);
            if moved {
                member.stay_s = 0.0;
            }
            if moved || member.pushed(motion) {
                member.still_s = 0.0;
                member.resting = false;
            }
            if changed || motion.torque != [0.0; 3] {
                push(world, body, motion, at);
            }
        }
        newcomers.sort_unstable_by_key(|place| self.rank(island.members[*place].id));
        for place in newcomers {
            let member = &mut island.members[place];
            let (role, surface) = (self.role(member.id), self.surface(member.id));
            let form = self.form(member.id);
            let body = world.add(&surface, form, role, member.at, sweeps[place]);
            push(world, body, &self.motions[member.id as usize], member.at);
            member.body = Some(body);
        }
        sweeps
    }

    /// Puts in fixed bodies that members have come near to.
    fn take_fixed_in(&self, island: &mut Island, world: &mut World) {
        let mut near = Vec::new();
        for member in &mut island.members {
            let motion = &self.motions[member.id as usize];
            let radius = DVec3::splat(motion.radius_m());
            let [least, most] = member.scope;
            let inside = (member.at.p - radius).cmpge(least).all()
                && (member.at.p + radius).cmple(most).all();
            if inside || driven(motion) {
                continue;
            }
            let around = radius + SCOPE_M + SCOPE_S * motion.v.length();
            member.scope = [member.at.p - around, member.at.p + around];
            self.statics.near(member.scope, &mut near);
        }
        near.sort_unstable();
        near.dedup();
        near.retain(|id| {
            let responds = self.duties[*id as usize] & duty::RESPONDS != 0;
            responds && island.fixed.binary_search(id).is_err()
        });
        near.sort_unstable_by_key(|id| self.rank(*id));
        for &id in &near {
            let at = self.motions[id as usize].place(SimTime::ZERO);
            world.add_fixed(&self.surface(id), self.form(id), at);
        }
        island.fixed.append(&mut near);
        island.fixed.sort_unstable();
    }

    fn surface(&self, id: u32) -> Surface {
        Surface {
            id,
            material: self.material(id),
            groups: self.filters[id as usize].groups(),
        }
    }

    /// Whether a body stands on whatever it touches, as on landing gear, and does not turn.
    pub(crate) fn upright(&self, id: u32) -> bool {
        self.form(id).ball().is_some() && self.duties[id as usize] & duty::ROLLS == 0
    }

    fn role(&self, id: u32) -> Role {
        let motion = &self.motions[id as usize];
        if driven(motion) {
            return Role::Driven;
        }
        Role::Free {
            mass: motion.mass_kg(),
            inertia: motion.inertia_kg_m2(),
            upright: self.upright(id),
        }
    }
}

/// Lets the wrench of a body's segment act on it in its world.
fn push(
    world: &mut World,
    body: rapier3d_f64::dynamics::RigidBodyHandle,
    motion: &Motion,
    at: Place,
) {
    world.set_wrench(body, motion.a * motion.mass_kg(), at.q * motion.torque());
}

/// A step that a world has made.
struct Step<'a> {
    world: &'a World,
    span: [SimTime; 2],
    dt_s: f64,
    before: Sweep,
}

impl Step<'_> {
    /// Lets a member's segment follow the step; tells whether that is a new one.
    fn lead(&self, member: &mut Member, motion: &mut Motion) -> bool {
        let Some(body) = member.body else {
            return false;
        };
        let [t, _] = self.span;
        if driven(motion) {
            member.at = self.world.place(body);
            self.age(member, stands(motion));
            member.resting = member.still_s >= STILL_S;
            self.note(member, motion, self.before);
            return false;
        }
        let from = std::mem::replace(&mut member.at, self.world.place(body));
        let still = member.at.p.distance(from.p) < STILL_SPEED_M_S * self.dt_s
            && rotation::turn_between(from.q, member.at.q).length() < STILL_RATE_RAD_S * self.dt_s;
        self.age(member, still);

        let here = motion.place(t);
        let way = member.at.p - here.p;
        let turn = rotation::turn_between(here.q, member.at.q);
        if member.resting && (way.length() > STIR || turn.length() > STIR) {
            member.still_s = 0.0;
        }
        let rests = member.still_s >= STILL_S;
        let led = !(member.resting && rests);
        if led {
            if rests {
                motion.lead(t, DVec3::ZERO, DVec3::ZERO);
            } else {
                motion.lead(t, way / self.dt_s, turn / self.dt_s);
            }
            motion.stamp = motion.stamp.wrapping_add(1);
        }
        member.resting = rests;
        self.note(member, motion, self.world.sweep(body));
        led
    }

    fn age(&self, member: &mut Member, still: bool) {
        let (at, anchor) = (member.at, member.anchor);
        let near = at.p.distance(anchor.p) < STILL_SPEED_M_S * STILL_S
            && rotation::turn_between(anchor.q, at.q).length() < STILL_RATE_RAD_S * STILL_S;
        if near {
            member.stay_s += self.dt_s;
        } else {
            (member.anchor, member.stay_s) = (at, 0.0);
        }
        member.still_s = if still {
            member.still_s + self.dt_s
        } else {
            0.0
        };
    }

    fn note(&self, member: &mut Member, motion: &Motion, after: Sweep) {
        member.led = Some(Led {
            motion: *motion,
            span: self.span,
            sweeps: [self.before, after],
        });
    }
}

/// Reports touches that begin in a step from `t` on, and keeps in mind which there are.
fn report(
    island: &mut Island,
    sweeps: &[Sweep],
    touches: &[Touch],
    t: SimTime,
    contacts: &mut Vec<Contact>,
) {
    for member in &mut island.members {
        member.alone += 1;
    }
    for touch in touches {
        let (a, b) = touch.pair;
        let speed = |id: u32| {
            island.position(id).map_or(DVec3::ZERO, |place| {
                let (member, sweep) = (&island.members[place], sweeps[place]);
                sweep.v + sweep.w.cross(touch.point - member.at.p)
            })
        };
        let relative_velocity = speed(a) - speed(b);
        let begins = island.touches.binary_search(&touch.pair).is_err();
        if begins && relative_velocity.dot(touch.normal) > NEWS_SPEED_M_S {
            contacts.push(Contact {
                time: t,
                a: BodyId(a),
                b: (b != GROUND).then_some(BodyId(b)),
                point_enu: touch.point,
                normal_enu: touch.normal,
                relative_velocity_enu: relative_velocity,
                impulse_enu: touch.impulse,
            });
        }
        for id in [a, b] {
            if let Some(place) = island.position(id) {
                island.members[place].alone = 0;
            }
        }
    }
    island.touches.clear();
    island
        .touches
        .extend(touches.iter().map(|touch| touch.pair));
}

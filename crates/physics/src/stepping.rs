//! One step of an island: who leaves, who comes to rest, and where the others go.

use crate::body::{BodyId, Material, Mobility, group};
use crate::contact::Contact;
use crate::island::{REACH_M, Role, Surface, Sweep, Touch, World};
use crate::islands::{Island, Led, Member};
use crate::limits::NEWS_SPEED_M_S;
use crate::motion::{Motion, seconds_between};
use crate::physics::{Physics, duty};
use crate::queue::GROUND;
use crate::rest;
use crate::rotation;
use crate::shape::form::Place;
use glam::DVec3;
use simbeeotic_kernel::SimTime;

/// A member that has touched nothing for so many steps leaves.
const ALONE_STEPS: u32 = 4;
/// A member that has been still for so long rests, s.
pub(crate) const STILL_S: f64 = 0.5;
/// Who could not be shown to rest under what acts on it is not looked at again for so long.
const DOUBT_NS: u64 = 500_000_000;
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
fn stands(motion: &Motion) -> bool {
    motion.v == DVec3::ZERO && motion.w == DVec3::ZERO
}

fn driven(motion: &Motion) -> bool {
    motion.mobility() == Mobility::Driven
}

impl Physics {
    /// Lets members go that touch nothing any more; tells whom. An island that nothing free is left in
    /// lets all go.
    pub(crate) fn let_go(&mut self, island: &mut Island, t: SimTime) -> Vec<u32> {
        let motions = &mut self.motions;
        let deserted = island
            .members
            .iter()
            .all(|member| driven(&motions[member.id as usize]) || member.alone >= ALONE_STEPS);
        let mut gone = Vec::new();
        let world = &mut island.world;
        island.members.retain(|member| {
            if !deserted && member.alone < ALONE_STEPS {
                return true;
            }
            let motion = &mut motions[member.id as usize];
            if !driven(motion) {
                let sweep = member.sweep(motion, t);
                let from = motion.position(t);
                motion.release(t, sweep.v, sweep.w);
                self.odometer.changed(from, motion, t);
                motion.stamp = motion.stamp.wrapping_add(1);
            }
            if let (Some(world), Some(body)) = (world.as_mut(), member.body) {
                world.remove(body);
            }
            gone.push(member.id);
            false
        });
        if !gone.is_empty() {
            let stays = |id: u32| gone.binary_search(&id).is_err();
            island.touches.retain(|(a, b)| stays(*a) && stays(*b));
        }
        gone
    }

    /// Takes groups out of an island that touch one another and all rest: islands of their own, asleep.
    pub(crate) fn settled(&mut self, island: &mut Island, t: SimTime) -> Vec<Island> {
        if !std::mem::take(&mut island.settling) || island.cut {
            return Vec::new();
        }
        let mut groups = Groups::new(island.members.len());
        for &(a, b) in &island.touches {
            if let (Some(a), Some(b)) = (island.position(a), island.position(b)) {
                groups.unite(a, b);
            }
        }
        let stays = |member: &Member| {
            let motion = &self.motions[member.id as usize];
            member.stays()
                && if driven(motion) {
                    stands(motion)
                } else {
                    !member.moved(motion)
                }
        };
        // Who has been still while the same acted on it rests, who has not gone anywhere if that is borne.
        let even = |member: &Member| {
            let motion = &self.motions[member.id as usize];
            member.resting && (driven(motion) || !member.pushed(motion))
        };
        let mut rests = vec![true; island.members.len()];
        let mut evens = vec![true; island.members.len()];
        for (place, member) in island.members.iter().enumerate() {
            let root = groups.root(place);
            rests[root] &= stays(member);
            evens[root] &= even(member);
        }
        let mut resters = std::collections::BTreeMap::<usize, Vec<usize>>::new();
        for place in 0..island.members.len() {
            let root = groups.root(place);
            if rests[root] && (evens[root] || t >= island.doubtful_until) {
                resters.entry(root).or_default().push(place);
            }
        }
        if resters.is_empty() {
            return Vec::new();
        }
        let points = island
            .world
            .as_ref()
            .map_or_else(Vec::new, |world| world.loaded_points());
        let mut sleepers = std::collections::BTreeMap::<usize, Island>::new();
        for (root, places) in resters {
            let bearings = rest::bearings(island, &points, &places);
            let mut sleeper = Island::of(places.iter().map(|place| island.members[*place].clone()));
            sleeper.bearings = bearings;
            if evens[root] || sleeper.bears(&self.motions, |id| self.upright(id)) {
                sleeper.members.clear();
                sleepers.insert(root, sleeper);
            } else {
                island.doubtful_until = t.saturating_add_nanos(DOUBT_NS);
            }
        }
        let members = std::mem::take(&mut island.members);
        for (place, mut member) in members.into_iter().enumerate() {
            let Some(sleeper) = sleepers.get_mut(&groups.root(place)) else {
                island.members.push(member);
                continue;
            };
            if let (Some(world), Some(body)) = (&mut island.world, member.body) {
                world.remove(body);
            }
            let motion = &mut self.motions[member.id as usize];
            if !member.resting && !driven(motion) {
                let from = motion.position(t);
                motion.lead(t, DVec3::ZERO, DVec3::ZERO);
                motion.stamp = motion.stamp.wrapping_add(1);
                self.odometer.changed(from, motion, t);
            }
            member.detach();
            member.led = Some(Led {
                motion: *motion,
                span: [t; 2],
                sweeps: [Sweep::default(); 2],
            });
            sleeper.members.push(member);
        }
        if !sleepers.is_empty() {
            let island = &mut *island;
            let awake = |id: u32| island.members.binary_search_by_key(&id, |m| m.id).is_ok();
            island.touches.retain(|(a, b)| awake(*a) || awake(*b));
        }
        sleepers.into_values().collect()
    }

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

/// Members that hang together: a forest of places.
struct Groups {
    parents: Vec<usize>,
}

impl Groups {
    fn new(count: usize) -> Self {
        Self {
            parents: (0..count).collect(),
        }
    }

    fn root(&mut self, mut place: usize) -> usize {
        while self.parents[place] != place {
            self.parents[place] = self.parents[self.parents[place]];
            place = self.parents[place];
        }
        place
    }

    /// The lower root stays.
    fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b)] = a.min(b);
    }
}

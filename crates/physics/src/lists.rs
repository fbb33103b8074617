//! Who might meet whom until the next listing.
//!
//! At a listing each body gets a ball about its place, as large as it can be expected to stay in until
//! the next one; two bodies are on each other's lists if their balls, and the bodies at their edges, can
//! touch. So bodies that are not listed cannot meet while both stay in their balls; one that may leave
//! its ball is listed anew at that time, alone. Lists change what is searched, never what is found.

use crate::grid::{Grid, Item};
use crate::motion::{Motion, seconds_between};
use crate::tree::{Bounds, Tree};
use glam::DVec3;
use rayon::ThreadPool;
use rayon::prelude::*;
use simbeeotic_kernel::SimTime;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// A ball holds what a body's speed takes it, times this,
const SPEED_MARGIN: f64 = 1.1;
/// what twice its acceleration takes it (commands change both),
const ACCELERATION_MARGIN: f64 = 1.0;
/// and this, m.
const FLOOR_M: f64 = 0.03;
/// A reach of more than this times the mean makes a body big: it is looked at by everyone.
const BIG: f64 = 4.0;
/// Edge of a cube of the grid over the mean reach.
const CELL: f64 = 5.0;
/// Shortest and longest edge of a cube, m.
const CELL_M_RANGE: (f64, f64) = (0.25, 1000.0);

/// Fewer bodies than this are listed by one thread.
const PARALLEL_MIN: usize = 4096;
/// Bodies that one thread takes at a time.
const CHUNK: usize = 1024;

/// Where a body stays until the next listing, and where its list begins.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
struct Ball {
    centre: DVec3,
    allowance: f32,
    first: u32,
}

impl Ball {
    const NONE: Self = Self {
        centre: DVec3::ZERO,
        allowance: 0.0,
        first: 0,
    };
}

/// Neighbour lists of all bodies.
#[derive(Debug, Default)]
pub(crate) struct Lists {
    grid: Grid,
    balls: Vec<Ball>,
    /// How many neighbours each body has.
    counts: Vec<u32>,
    neighbours: Vec<u32>,
    pairs: Vec<(u32, u32)>,
    /// Neighbours found since the listing.
    extra: BTreeMap<u32, Vec<u32>>,
    /// Bodies listed anew since the listing; their entry in the grid is out of date.
    relisted: Vec<u32>,
    big: Vec<u32>,
    /// The greatest reach of a body that is not big.
    common_reach: f64,
    /// When a body was last listed.
    since: SimTime,
    /// Bodies that have left their ball and are not listed anew yet.
    strays: Vec<u32>,
    /// The balls in a tree, from the first question since the listing on.
    sight: OnceLock<Tree>,
}

/// How far a body may go from where it is at `t` until `horizon`.
fn allowance(speed: f64, acceleration: f64, span_s: f64) -> f32 {
    let way = SPEED_MARGIN * speed * span_s + ACCELERATION_MARGIN * acceleration * span_s * span_s;
    (way + FLOOR_M) as f32
}

/// Radius and allowance together, rounded up.
fn reach(motion: &Motion, allowance: f32) -> f32 {
    ((motion.radius_m() + f64::from(allowance)) * (1.0 + 1e-6)) as f32
}

impl Lists {
    /// Lists the bodies `listed`, from `t` until `horizon`. `agree` says of which pairs it matters whether
    /// they meet.
    pub(crate) fn build(
        &mut self,
        motions: &[Motion],
        listed: &[u32],
        agree: impl Fn(u32, u32) -> bool + Sync,
        (t, horizon): (SimTime, SimTime),
        pool: Option<&ThreadPool>,
    ) {
        let pool = pool.filter(|_| listed.len() >= PARALLEL_MIN);
        let span_s = seconds_between(t, horizon);
        self.since = t;
        self.strays.clear();
        self.sight.take();
        self.extra.clear();
        self.relisted.clear();
        self.balls.resize(motions.len(), Ball::NONE);
        self.counts.resize(motions.len(), 0);

        let ball = |id: &u32| {
            let motion = &motions[*id as usize];
            let (centre, v, a) = motion.kinematics(t);
            let allowance = allowance(v.length(), a.length(), span_s);
            let item = Item {
                centre,
                reach: reach(motion, allowance),
                id: *id,
            };
            (item, allowance)
        };
        let items = self.grid.collect();
        let mut total_reach = 0.0;
        let mut take = |(item, allowance): (Item, f32)| {
            total_reach += item.reach();
            self.balls[item.id as usize] = Ball {
                centre: item.centre,
                allowance,
                first: 0,
            };
            items.push(item);
        };
        if let Some(pool) = pool {
            let mut balls = Vec::new();
            let chunks = listed.par_iter().with_min_len(CHUNK);
            pool.install(|| chunks.map(ball).collect_into_vec(&mut balls));
            balls.into_iter().for_each(take);
        } else {
            listed.iter().map(ball).for_each(&mut take);
        }
        let mean_reach = total_reach / listed.len().max(1) as f64;
        self.sort_out(mean_reach);
        let (least, most) = CELL_M_RANGE;
        self.grid.build((CELL * mean_reach).clamp(least, most));
        self.find_pairs(agree, pool);
        self.fill(listed);
    }

    /// Tells the big bodies from the others.
    fn sort_out(&mut self, mean_reach: f64) {
        self.big.clear();
        self.common_reach = 0.0;
        for item in self.grid.collected() {
            if item.reach() > BIG * mean_reach {
                self.big.push(item.id);
            } else {
                self.common_reach = self.common_reach.max(item.reach());
            }
        }
    }

    /// Finds each pair once, from the one that reaches farther: so a big body asks far, and the others
    /// need not.
    fn find_pairs(&mut self, agree: impl Fn(u32, u32) -> bool + Sync, pool: Option<&ThreadPool>) {
        self.pairs.clear();
        let grid = &self.grid;
        let find = |items: &[Item], pairs: &mut Vec<(u32, u32)>| {
            for item in items {
                grid.around(item.centre, 2.0 * item.reach(), |other| {
                    let touch = item.reach() + other.reach();
                    if item.centre.distance_squared(other.centre) <= touch * touch
                        && (other.reach, other.id) < (item.reach, item.id)
                        && agree(item.id, other.id)
                    {
                        pairs.push((item.id, other.id));
                    }
                });
            }
        };
        let Some(pool) = pool else {
            return find(grid.items(), &mut self.pairs);
        };
        let chunk = |items: &[Item]| {
            let mut pairs = Vec::new();
            find(items, &mut pairs);
            pairs
        };
        let chunks: Vec<_> = pool.install(|| grid.items().par_chunks(CHUNK).map(chunk).collect());
        self.pairs.extend(chunks.into_iter().flatten());
    }

    /// Writes each pair into the lists of both.
    fn fill(&mut self, listed: &[u32]) {
        for id in listed {
            self.counts[*id as usize] = 0;
        }
        for &(a, b) in &self.pairs {
            self.counts[a as usize] += 1;
            self.counts[b as usize] += 1;
        }
        let mut end = 0;
        for id in listed {
            end += self.counts[*id as usize];
            self.balls[*id as usize].first = end;
        }
        self.neighbours.clear();
        self.neighbours.resize(end as usize, 0);
        for &(a, b) in self.pairs.iter().rev() {
            for (of, neighbour) in [(a, b), (b, a)] {
                let first = &mut self.balls[of as usize].first;
                *first -= 1;
                self.neighbours[*first as usize] = neighbour;
            }
        }
    }

    /// The pairs found at the listing, each once; to be given back.
    pub(crate) fn take_pairs(&mut self) -> Vec<(u32, u32)> {
        std::mem::take(&mut self.pairs)
    }

    /// Gives back what [`take_pairs`](Self::take_pairs) took.
    pub(crate) fn give_pairs(&mut self, pairs: Vec<(u32, u32)>) {
        self.pairs = pairs;
    }

    /// Where a listed body stays until the next listing: the centre of the ball, and how far it may go
    /// from there, m.
    pub(crate) fn ball(&self, id: u32) -> (DVec3, f64) {
        let ball = &self.balls[id as usize];
        (ball.centre, f64::from(ball.allowance))
    }

    /// Where in [`neighbour`](Self::neighbour) the list of a body lies.
    #[inline]
    pub(crate) fn range(&self, id: u32) -> std::ops::Range<u32> {
        let first = self.balls[id as usize].first;
        first..first + self.counts[id as usize]
    }

    /// One entry of the lists.
    #[inline]
    pub(crate) fn neighbour(&self, place: u32) -> u32 {
        self.neighbours[place as usize]
    }

    /// Neighbours of a body that were found since the listing.
    pub(crate) fn extra(&self, id: u32) -> &[u32] {
        if self.extra.is_empty() {
            &[]
        } else {
            self.extra.get(&id).map_or(&[], Vec::as_slice)
        }
    }

    /// The earliest time from `now` on at which a body may leave its ball on its present segment.
    #[inline]
    pub(crate) fn leaves(&self, id: u32, motion: &Motion, now: SimTime) -> SimTime {
        let ball = &self.balls[id as usize];
        let (p, v, a) = motion.kinematics(now);
        let room = f64::from(ball.allowance) - p.distance(ball.centre);
        if room <= 0.0 {
            return now;
        }
        // Whatever their directions, room = v s + a s^2 / 2 comes first.
        let speed = v.length();
        let s = 2.0 * room / (speed + (speed * speed + 2.0 * a.length() * room).sqrt());
        // The cast holds infinity at the greatest integer. One nanosecond is for its rounding.
        now.saturating_add_nanos(((s * 1e9) as u64).saturating_sub(1))
    }

    /// Touches what is known of a body; see [`Physics::warm`](crate::Physics::warm).
    #[inline]
    pub(crate) fn warm(&self, id: u32) -> u64 {
        let ball = self.balls.get(id as usize).map_or(0, |ball| ball.first);
        let count = self.counts.get(id as usize).map_or(0, |count| *count);
        u64::from(ball ^ count)
    }

    /// Whether a body is elsewhere than when it was listed.
    pub(crate) fn displaced(&self, id: u32, motion: &Motion) -> bool {
        self.balls
            .get(id as usize)
            .is_none_or(|ball| ball.centre != motion.p)
    }

    /// Whether so many bodies were listed anew that listing all is cheaper.
    pub(crate) fn crowded(&self) -> bool {
        self.relisted.len() >= 8 + self.grid.items().len() / 16
    }

    /// Lists one body anew, from `t` until `horizon`.
    pub(crate) fn relist(
        &mut self,
        id: u32,
        motions: &[Motion],
        agree: impl Fn(u32, u32) -> bool,
        t: SimTime,
        horizon: SimTime,
    ) {
        let motion = &motions[id as usize];
        let (p, v, a) = motion.kinematics(t);
        let allowance = allowance(v.length(), a.length(), seconds_between(t, horizon));
        let ball = &mut self.balls[id as usize];
        (ball.centre, ball.allowance) = (p, allowance);
        self.since = t;
        self.strays.retain(|stray| *stray != id);
        let bounds = self.bounds(id, motions);
        if let Some(tree) = self.sight.get_mut() {
            tree.update(id, bounds);
        }
        if !self.relisted.contains(&id) {
            self.relisted.push(id);
        }

        let own = f64::from(reach(motion, allowance));
        let mut found = Vec::new();
        self.grid
            .around(p, own + self.common_reach, |item| found.push(item.id));
        found.extend_from_slice(&self.big);
        found.extend_from_slice(&self.relisted);
        found.sort_unstable();
        found.dedup();
        for other in found {
            let ball = &self.balls[other as usize];
            let touch = own + f64::from(reach(&motions[other as usize], ball.allowance));
            let meets = other != id && ball.centre.distance_squared(p) <= touch * touch;
            if meets && agree(id, other) && !self.knows(id, other) {
                self.extra.entry(id).or_default().push(other);
                self.extra.entry(other).or_default().push(id);
            }
        }
    }

    fn knows(&self, id: u32, other: u32) -> bool {
        self.range(id).any(|place| self.neighbour(place) == other)
            || self.extra(id).contains(&other)
    }

    /// Appends every listed body that can be within `radius` of `p`, some twice.
    pub(crate) fn around(&self, p: DVec3, radius: f64, found: &mut Vec<u32>) {
        self.grid.around(p, radius + self.common_reach, |item| {
            let touch = radius + item.reach();
            if item.centre.distance_squared(p) <= touch * touch {
                found.push(item.id);
            }
        });
        found.extend_from_slice(&self.big);
        found.extend_from_slice(&self.relisted);
    }

    /// From when on every listed body is in its ball, but for [`strays`](Self::strays).
    pub(crate) fn since(&self) -> SimTime {
        self.since
    }

    /// A body has left its ball, and will be listed anew.
    pub(crate) fn strays_from_now(&mut self, id: u32) {
        self.strays.push(id);
    }

    /// Bodies that have left their ball and are not listed anew yet.
    pub(crate) fn strays(&self) -> &[u32] {
        &self.strays
    }

    /// All that a listed body may fill until the next listing.
    fn bounds(&self, id: u32, motions: &[Motion]) -> Bounds {
        let ball = &self.balls[id as usize];
        let reach = f64::from(reach(&motions[id as usize], ball.allowance));
        [ball.centre - reach, ball.centre + reach]
    }

    /// The balls of the listed bodies, in a tree.
    pub(crate) fn sight(&self, motions: &[Motion]) -> &Tree {
        self.sight.get_or_init(|| {
            let bodies = self.grid.items().iter().map(|item| item.id);
            Tree::new(bodies.map(|id| (id, self.bounds(id, motions))))
        })
    }
}

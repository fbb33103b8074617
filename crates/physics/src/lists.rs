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

/// Where a body stays until the next listing.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
struct Ball {
    centre: DVec3,
    /// How far it may go from there, m.
    allowance: f32,
    /// Its own radius and its allowance, m, rounded up.
    reach: f32,
}

impl Ball {
    const NONE: Self = Self {
        centre: DVec3::ZERO,
        allowance: 0.0,
        reach: 0.0,
    };

    /// Where a body stays that is at `t` where its motion says, for `span_s`.
    fn new(motion: &Motion, t: SimTime, span_s: f64) -> Self {
        let (centre, v, a) = motion.kinematics(t);
        let allowance = allowance(v.length(), a.length(), span_s);
        let reach = (motion.radius_m() + f64::from(allowance)) * (1.0 + 1e-6);
        Self {
            centre,
            allowance,
            reach: reach as f32,
        }
    }

    fn reach(&self) -> f64 {
        f64::from(self.reach)
    }
}

/// Where the list of a body lies.
#[derive(Clone, Copy, Debug, Default)]
struct Span {
    first: u32,
    count: u32,
}

/// Neighbour lists of all bodies.
#[derive(Debug, Default)]
pub(crate) struct Lists {
    grid: Grid,
    balls: Vec<Ball>,
    spans: Vec<Span>,
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
        self.spans.resize(motions.len(), Span::default());

        let ball = |id: u32| Ball::new(&motions[id as usize], t, span_s);
        let total_reach = self.place(listed, ball, pool);
        let mean_reach = total_reach / listed.len().max(1) as f64;
        self.sort_out(listed, mean_reach);
        let (least, most) = CELL_M_RANGE;
        let edge_m = (CELL * mean_reach).clamp(least, most);
        let balls = &self.balls;
        let item = |id: u32| Item {
            centre: balls[id as usize].centre,
            reach: balls[id as usize].reach,
            id,
        };
        self.grid.build(edge_m, listed, item, pool);
        self.find_pairs(agree, pool);
        self.fill(listed);
    }

    /// Gives each listed body its ball; returns the sum of their reaches, m. `listed` is sorted.
    fn place(
        &mut self,
        listed: &[u32],
        ball: impl Fn(u32) -> Ball + Sync,
        pool: Option<&ThreadPool>,
    ) -> f64 {
        let place = |(chunk, balls): (usize, &mut [Ball])| {
            let base = chunk * CHUNK;
            let place_of = |end: usize| listed.partition_point(|id| (*id as usize) < end);
            let mut reach = 0.0;
            for id in &listed[place_of(base)..place_of(base + balls.len())] {
                let ball = ball(*id);
                reach += ball.reach();
                balls[*id as usize - base] = ball;
            }
            reach
        };
        // Summed chunk by chunk on any number of threads: sums of other orders differ in the last digit.
        match pool {
            Some(pool) => {
                let chunks = self.balls.par_chunks_mut(CHUNK).enumerate();
                let reaches: Vec<f64> = pool.install(|| chunks.map(place).collect());
                reaches.into_iter().sum()
            }
            None => self.balls.chunks_mut(CHUNK).enumerate().map(place).sum(),
        }
    }

    /// Tells the big bodies from the others.
    fn sort_out(&mut self, listed: &[u32], mean_reach: f64) {
        self.big.clear();
        self.common_reach = 0.0;
        for id in listed {
            let reach = self.balls[*id as usize].reach();
            if reach > BIG * mean_reach {
                self.big.push(*id);
            } else {
                self.common_reach = self.common_reach.max(reach);
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
            self.spans[*id as usize] = Span::default();
        }
        for &(a, b) in &self.pairs {
            self.spans[a as usize].count += 1;
            self.spans[b as usize].count += 1;
        }
        let mut end = 0;
        for id in listed {
            let span = &mut self.spans[*id as usize];
            end += span.count;
            span.first = end;
        }
        self.neighbours.clear();
        self.neighbours.resize(end as usize, 0);
        for &(a, b) in self.pairs.iter().rev() {
            for (of, neighbour) in [(a, b), (b, a)] {
                let first = &mut self.spans[of as usize].first;
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
        let span = self.spans[id as usize];
        span.first..span.first + span.count
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
        let ball = self.balls.get(id as usize).map_or(0, |b| b.reach.to_bits());
        let count = self.spans.get(id as usize).map_or(0, |span| span.count);
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
        let ball = Ball::new(&motions[id as usize], t, seconds_between(t, horizon));
        self.balls[id as usize] = ball;
        self.since = t;
        self.strays.retain(|stray| *stray != id);
        let bounds = self.bounds(id);
        if let Some(tree) = self.sight.get_mut() {
            tree.update(id, bounds);
        }
        if !self.relisted.contains(&id) {
            self.relisted.push(id);
        }

        let (p, own) = (ball.centre, ball.reach());
        let mut found = Vec::new();
        self.grid
            .around(p, own + self.common_reach, |item| found.push(item.id));
        found.extend_from_slice(&self.big);
        found.extend_from_slice(&self.relisted);
        found.sort_unstable();
        found.dedup();
        for other in found {
            let ball = &self.balls[other as usize];
            let touch = own + ball.reach();
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
    fn bounds(&self, id: u32) -> Bounds {
        let ball = &self.balls[id as usize];
        [ball.centre - ball.reach(), ball.centre + ball.reach()]
    }

    /// The balls of the listed bodies, in a tree.
    pub(crate) fn sight(&self) -> &Tree {
        self.sight.get_or_init(|| {
            let bodies = self.grid.items().iter().map(|item| item.id);
            Tree::new(bodies.map(|id| (id, self.bounds(id))))
        })
    }
}

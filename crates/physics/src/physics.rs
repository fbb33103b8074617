//! The table of all bodies: what its users see of it. How it works through time is in `events`.

use crate::body::{BodyId, BodySpec, Contacts, Material, Mobility};
use crate::config::{Config, ContactModel};
use crate::contact::Contact;
use crate::duties::{Filter, duty};
use crate::encounters::Encounters;
use crate::error::{BodyError, ThreadsError};
use crate::foresee::Foreseen;
use crate::islands::Islands;
use crate::kind::Kind;
use crate::lists::Lists;
use crate::motion::Motion;
use crate::odometer::Odometer;
use crate::queue::{GROUND, Queue};
use crate::shape::Shape;
use crate::shape::form::Form;
use crate::statics::Statics;
use crate::support::Support;
use crate::walls::Walls;
use glam::DVec3;
use rayon::{ThreadPool, ThreadPoolBuilder};
use simbeeotic_kernel::SimTime;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// So many of the last outlines are compared with a new one: swarms are made body by body, worlds of
/// many kinds of things are not worth a search.
const OUTLINES_COMPARED: usize = 16;

/// A shape and its surface, for bodies that move freely or for others, and what is made of it.
#[derive(Debug)]
pub(crate) struct Outline {
    pub(crate) shape: Shape,
    pub(crate) material: Material,
    pub(crate) free: bool,
    pub(crate) form: Form,
}

/// Where a body begins, and how it moves there, as one word.
fn origin_of(spec: &BodySpec) -> u64 {
    let numbers = [
        spec.p_enu.to_array(),
        spec.v_enu.to_array(),
        spec.w_flu.to_array(),
    ];
    numbers.as_flattened().iter().fold(0, |word, number| {
        (word ^ number.to_bits())
            .wrapping_mul(0x9e37_79b9_7f4a_7c15)
            .rotate_left(29)
    })
}

/// All bodies, and the contacts between them.
///
/// # How an engine uses it
///
/// ```text
/// loop:
///   now = the earlier of its own next event and next_time()
///   advance(now, &mut contacts)      bodies that meet at now have bounced
///   ... agents read motion(id), change copies ...
///   commit(id, now, motion)          for each body that an agent has changed
///   settle(now)                      what was changed is predicted anew
/// ```
///
/// [`next_time`](Self::next_time) may name an instant at which nothing is seen to happen (lists are made
/// anew). Between two calls nobody has to be told that time passes: [`motion`](Self::motion) holds good
/// until the next instant that `next_time` names.
///
/// # Cost
///
/// A world in which nothing can touch anything costs nothing but the copies of `commit`. Otherwise each
/// change costs a look at the body's neighbours, and each `list_period` one pass over those bodies that
/// can touch something, as long as one of them moves.
#[derive(Debug)]
pub struct Physics {
    pub(crate) gravity: f64,
    pub(crate) ground: Option<Material>,
    pub(crate) list_period_ns: u64,
    pub(crate) list_all: bool,
    /// Somebody looked for bodies that are not listed: all are to be, see `sight`.
    pub(crate) asked: AtomicBool,

    pub(crate) motions: Vec<Motion>,
    pub(crate) duties: Vec<u8>,
    pub(crate) filters: Vec<Filter>,
    /// What each body counts as for those who look.
    pub(crate) kinds: Vec<Kind>,
    /// Every shape with its surface there is, once; and which of them each body has.
    pub(crate) outlines: Vec<Outline>,
    pub(crate) outline_of: Vec<u32>,
    /// Where each body began, as one word.
    pub(crate) origins: Vec<u64>,
    /// When a review of each body is in the queue; [`SimTime::MAX`] if none is.
    pub(crate) reviews: Vec<SimTime>,

    pub(crate) statics: Statics,
    pub(crate) lists: Lists,
    pub(crate) queue: Queue,
    pub(crate) encounters: Encounters,
    pub(crate) islands: Islands,
    pub(crate) dirty: Vec<u32>,
    /// Bodies that may move and have no place in the lists.
    pub(crate) unlisted: Vec<u32>,
    /// Bodies that are not fixed.
    pub(crate) movers: Vec<u32>,
    /// Those of them that have a place in the lists.
    pub(crate) listed: Vec<u32>,
    /// What stands near each body; empty if nothing that matters stands anywhere.
    pub(crate) walls: Vec<Walls>,
    pub(crate) has_walls: bool,
    /// Whether balls in lasting contact are handed to islands, too.
    pub(crate) uses_islands: bool,
    /// Threads that foresee; `None`: the caller's alone.
    pub(crate) pool: Option<Arc<ThreadPool>>,
    /// Room for who follows a new segment after a step.
    pub(crate) stepped: Vec<u32>,
    /// How far anybody may have come.
    pub(crate) odometer: Odometer,
    /// Room for what is foreseen.
    pub(crate) foreseen: Foreseen,
    /// Until when lists and predictions are complete; [`SimTime::MAX`] while nothing moves that could
    /// touch something.
    pub(crate) horizon: SimTime,
    /// Nothing happens before; known since the last call of `next_time`, if nothing changed since.
    pub(crate) quiet_until: SimTime,
    /// The latest time anybody named.
    pub(crate) clock: SimTime,
    /// Bodies were added since who meets whom was worked out.
    pub(crate) grown: bool,
    /// Number of contacts resolved and of pairs searched, for measurements.
    pub(crate) tally: Tally,
}

/// What physics has done so far: for measurements, never for results.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Impacts, and touches detected.
    pub contacts: u64,
    /// Searches for the time at which two bodies meet.
    pub searches: u64,
    /// Listings of all bodies.
    pub listings: u64,
    /// Listings of one body.
    pub relistings: u64,
    /// Steps of islands.
    pub steps: u64,
    /// Segments begun anew because a body slid or tumbled.
    pub reviews: u64,
}

impl Physics {
    /// A world without bodies. A `config` that does not pass [`Config::check`] is replaced by the
    /// default.
    #[must_use]
    pub fn new(config: Config) -> Self {
        let config = if config.check().is_ok() {
            config
        } else {
            Config::default()
        };
        Self {
            gravity: config.gravity.get(),
            ground: config.ground,
            list_period_ns: (config.list_period.get() * 1e9) as u64,
            list_all: config.list_all,
            asked: AtomicBool::new(false),
            motions: Vec::new(),
            duties: Vec::new(),
            filters: Vec::new(),
            kinds: Vec::new(),
            outlines: Vec::new(),
            outline_of: Vec::new(),
            origins: Vec::new(),
            reviews: Vec::new(),
            lists: Lists::default(),
            queue: Queue::default(),
            encounters: Encounters::default(),
            islands: Islands::new(
                (config.island_step.get() * 1e9).round() as u64,
                config.solver_iterations,
            ),
            dirty: Vec::new(),
            unlisted: Vec::new(),
            movers: Vec::new(),
            listed: Vec::new(),
            walls: Vec::new(),
            has_walls: false,
            statics: Statics::default(),
            uses_islands: config.contact_model == ContactModel::Islands,
            pool: None,
            stepped: Vec::new(),
            odometer: Odometer::default(),
            foreseen: Foreseen::default(),
            horizon: SimTime::MAX,
            quiet_until: SimTime::ZERO,
            clock: SimTime::ZERO,
            grown: false,
            tally: Tally::default(),
        }
    }

    /// Makes room for so many more bodies: tables that grow hold half as much again while they move.
    pub fn reserve(&mut self, bodies: usize) {
        self.motions.reserve_exact(bodies);
        self.duties.reserve_exact(bodies);
        self.filters.reserve_exact(bodies);
        self.kinds.reserve_exact(bodies);
        self.outline_of.reserve_exact(bodies);
        self.reviews.reserve_exact(bodies);
        for list in [&mut self.dirty, &mut self.movers, &mut self.listed] {
            list.reserve_exact(bodies);
        }
    }

    /// Adds a body, as it is at the start of the run. Bodies are added before the first call of
    /// [`settle`](Self::settle) or [`advance`](Self::advance); one that is added later has been there,
    /// unseen, since the start.
    ///
    /// # Errors
    /// As [`BodySpec::check`], or more than 2^32 - 2 bodies.
    pub fn add(&mut self, spec: BodySpec) -> Result<BodyId, BodyError> {
        spec.check()?;
        let id = u32::try_from(self.motions.len())
            .ok()
            .filter(|id| *id < GROUND);
        let id = id.ok_or(BodyError::TooMany)?;
        let outline = self.outline_for(&spec)?;
        let friction = self
            .ground
            .map_or(0.0, |ground| ground.against(&spec.material).friction);
        let bit = |holds: bool, bit: u8| if holds { bit } else { 0 };
        let duties = duty::DIRTY
            | bit(spec.contacts == Contacts::Respond, duty::RESPONDS)
            | bit(spec.mobility == Mobility::Fixed, duty::FIXED)
            | bit(spec.rolls, duty::ROLLS);
        self.motions
            .push(Motion::new(&spec, self.gravity, friction));
        self.duties.push(duties);
        self.filters.push(Filter::new(&spec));
        self.kinds.push(spec.kind());
        self.outline_of.push(outline);
        self.origins.push(origin_of(&spec));
        self.reviews.push(SimTime::MAX);
        self.dirty.push(id);
        self.grown = true;
        self.quiet_until = SimTime::ZERO;
        Ok(BodyId(id))
    }

    /// The outline of a body: that of an earlier one, if it has the same.
    fn outline_for(&mut self, spec: &BodySpec) -> Result<u32, BodyError> {
        let free = spec.mobility == Mobility::Free;
        let same = |known: &Outline| {
            known.free == free && known.material == spec.material && known.shape == spec.shape
        };
        let recent = self.outlines.len().saturating_sub(OUTLINES_COMPARED);
        let at = match self.outlines[recent..].iter().position(same) {
            Some(at) => recent + at,
            None => {
                self.outlines.push(Outline {
                    shape: spec.shape.clone(),
                    material: spec.material,
                    free,
                    form: Form::new(&spec.shape, free)?,
                });
                self.outlines.len() - 1
            }
        };
        Ok(at as u32)
    }

    /// What a body has in common with those that are like it.
    #[inline]
    pub(crate) fn outline(&self, id: u32) -> &Outline {
        &self.outlines[self.outline_of[id as usize] as usize]
    }

    /// The form of a body.
    #[inline]
    pub(crate) fn form(&self, id: u32) -> &Form {
        &self.outline(id).form
    }

    /// What a body counts as for those who look.
    ///
    /// # Panics
    /// If `id` is not one of [`add`](Self::add) of this world.
    #[must_use]
    pub fn kind(&self, id: BodyId) -> Kind {
        self.kinds[id.index()]
    }

    /// A box along the axes that holds a body at `t`: its least and its greatest corner, ENU, m; infinite for a
    /// plane.
    ///
    /// # Panics
    /// If `id` is not one of [`add`](Self::add) of this world.
    #[must_use]
    pub fn bounds(&self, id: BodyId, t: SimTime) -> [DVec3; 2] {
        self.form(id.0).bounds(self.motions[id.index()].place(t))
    }

    /// Number of bodies.
    #[must_use]
    pub fn len(&self) -> usize {
        self.motions.len()
    }

    /// Whether there is no body.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.motions.is_empty()
    }

    /// The trajectory segment of a body.
    ///
    /// # Panics
    /// If `id` is not one of [`add`](Self::add) of this world.
    #[inline]
    #[must_use]
    pub fn motion(&self, id: BodyId) -> &Motion {
        &self.motions[id.index()]
    }

    /// How the velocity of a body's centre [ENU, m/s^2] and its body rate [FLU, rad/s^2] change at `t`.
    ///
    /// That is what its segment says, but for a body in an island, whose segments are straight: there it
    /// is the mean over the island's last step.
    ///
    /// # Panics
    /// If `id` is not one of [`add`](Self::add) of this world.
    #[must_use]
    pub fn accelerations(&self, id: BodyId, t: SimTime) -> (glam::DVec3, glam::DVec3) {
        let motion = self.motion(id);
        if motion.support() == Support::Island {
            let change = self.islands.change(id.0);
            return (change.v, motion.attitude(t).conjugate() * change.w);
        }
        (motion.acceleration(), motion.angular_acceleration(t))
    }

    /// The outline of a body.
    ///
    /// # Panics
    /// If `id` is not one of [`add`](Self::add) of this world.
    #[must_use]
    pub fn shape(&self, id: BodyId) -> &Shape {
        &self.outline(id.0).shape
    }

    /// Lets `motion` replace the body's segment from `now` on.
    ///
    /// `motion` is a changed copy of what [`motion`](Self::motion) showed at `now`, begun anew no later.
    ///
    /// # Panics
    /// If `id` is not one of [`add`](Self::add) of this world.
    #[inline]
    pub fn commit(&mut self, id: BodyId, now: SimTime, motion: Motion) {
        let place = &mut self.motions[id.index()];
        debug_assert!(
            motion.t0 <= now,
            "a segment begins in the future: {motion:?} at {now}"
        );
        debug_assert!(
            motion.radius == place.radius,
            "a segment of another body: {motion:?}"
        );
        self.odometer.replaced(place, &motion, now);
        let stamp = place.stamp.wrapping_add(1);
        *place = motion;
        place.stamp = stamp;
        self.clock = self.clock.max(now);
        self.quiet_until = SimTime::ZERO;
        let duty = &mut self.duties[id.index()];
        if *duty & duty::DIRTY == 0 {
            *duty |= duty::DIRTY;
            self.dirty.push(id.0);
        }
    }

    /// Touches all that a change of the body will read. What it returns means nothing; who has several
    /// bodies to change soon touches them together, so that their cache misses overlap.
    ///
    /// # Panics
    /// If `id` is not one of [`add`](Self::add) of this world.
    #[inline]
    #[must_use]
    pub fn warm(&self, id: BodyId) -> u64 {
        let motion = &self.motions[id.index()];
        let lines = motion.t0.nanos() ^ motion.a.x.to_bits() ^ motion.w.x.to_bits();
        let tables = u64::from(self.duties[id.index()]) ^ self.reviews[id.index()].nanos();
        lines ^ tables ^ u64::from(self.outline_of[id.index()]) ^ self.lists.warm(id.0)
    }

    /// What has been done so far.
    #[must_use]
    pub fn tally(&self) -> Tally {
        self.tally
    }

    /// Lets `threads` threads foresee what happens to many bodies at once. The result is the same for any
    /// number.
    ///
    /// # Errors
    /// The threads cannot be started.
    pub fn set_threads(&mut self, threads: usize) -> Result<(), ThreadsError> {
        let build = || ThreadPoolBuilder::new().num_threads(threads).build();
        self.pool = if threads > 1 {
            Some(Arc::new(build()?))
        } else {
            None
        };
        Ok(())
    }

    /// The same on threads that are there already, as those of an engine.
    pub fn share_threads(&mut self, pool: Arc<ThreadPool>) {
        self.pool = Some(pool);
    }

    /// Resolves everything that is due up to and including `now`; appends the contacts to `contacts`, in
    /// their order.
    pub fn advance(&mut self, now: SimTime, contacts: &mut Vec<Contact>) {
        self.settle_if_dirty();
        let first = contacts.len();
        self.quiet_until = SimTime::ZERO;
        self.run_until(now, contacts);
        self.clock = self.clock.max(now);
        contacts[first..].sort_by_key(|c| (c.time, c.a, c.b.map_or(GROUND, |b| b.0)));
    }
}

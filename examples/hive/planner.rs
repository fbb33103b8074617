//! The planner: which cell needs somebody most, by what is known of it.
//!
//! Of each cell the planner has a belief `p` that flowers are in it that nobody has seen. A search that
//! finds nothing, by somebody who would have found some with probability `d`, lowers it by Bayes' rule,
//!
//! ```text
//! p' = p (1 - d) / (1 - p d)                                                        (1)
//! ```
//! and flowers that are found raise it in the cells around to `p_near`, since patches are larger than
//! cells. A cell with flowers is sampled, then pollinated. What a dispatch is worth is what it may bring
//! over what it takes,
//!
//! ```text
//! w = gain / ((way there + way home) / speed + work)                                (2)
//! ```
//! with the gain in flowers: their known number for the last two, `p n / 3` for a search, after which two
//! thirds of the work are still to do (with the number that a broken-off search has seen for `p n` if that
//! is more). Open cells stand in an ordered set by (2), so that a dispatch costs O(log n) for n cells.
//!
//! Nothing here knows a radio or a clock: results come in as calls.

use super::cells::Cells;
use super::wire::{Job, Task};
use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec2;
use std::collections::{BTreeMap, BTreeSet};

/// What the planner believes before it has seen anything, and what it reckons with.
#[params]
pub struct PlannerParams {
    /// Belief that an unknown cell has flowers: `p` at the start, 0 to 1.
    pub belief: f64,
    /// The same beside a cell where flowers were found: `p_near`, 0 to 1. No belief is lowered to it.
    pub belief_beside: f64,
    /// Belief that a search of a cell with flowers finds any: `d`, 0 to 1. It has several, and each is looked
    /// at more than once.
    pub detection: f64,
    /// A cell that has flowers with less than this belief is not searched again, 0 to 1.
    pub least_belief: f64,
    /// How many flowers it expects in a cell that has some: `n`.
    pub flowers: f64,
    /// How fast it takes a MAV to fly.
    pub speed: Speed,
    /// How long it takes a search to last.
    pub search: Time,
    /// How long it takes one flower to be sampled, or pollinated.
    pub flower: Time,
    /// After this without a result a cell is given to another.
    pub patience: Time,
}

impl Default for PlannerParams {
    fn default() -> Self {
        Self {
            belief: 0.15,
            belief_beside: 0.2,
            detection: 0.98,
            least_belief: 0.02,
            flowers: 6.0,
            speed: Speed::si(4.0),
            search: Time::si(15.0),
            flower: Time::si(7.0),
            patience: Time::si(300.0),
        }
    }
}

impl PlannerParams {
    /// # Errors
    /// A belief that is none, a speed or time that is not above 0.
    pub(crate) fn check(&self) -> Result<(), BuildError> {
        in_range("belief", self.belief, 0.0..=1.0)?;
        in_range("belief_beside", self.belief_beside, 0.0..=1.0)?;
        in_range("detection", self.detection, 0.0..=1.0)?;
        in_range("least_belief", self.least_belief, 0.0..=1.0)?;
        at_least_zero("flowers", self.flowers)?;
        positive("speed", self.speed)?;
        positive("search", self.search)?;
        positive("flower", self.flower)?;
        positive("patience", self.patience)
    }
}

/// What came of a dispatch.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Finding {
    pub(crate) ticket: u16,
    pub(crate) task: Task,
    pub(crate) cell: u16,
    /// Whether it was brought to its end.
    pub(crate) complete: bool,
    /// Flowers found; of a pollination those left.
    pub(crate) count: u16,
    /// Where they are, if that is told.
    pub(crate) places: Vec<DVec2>,
}

/// What is known of a cell.
#[derive(Clone, Debug)]
struct Known {
    belief: f64,
    next: Task,
    searches: u32,
    count: u16,
    places: Vec<DVec2>,
    /// What has told `places`: each task knows them better than the one before.
    placed_by: Task,
    taken: Option<u16>,
    /// Who left it unfinished last and has not handed in yet what it found.
    left_by: Option<u16>,
    /// The key under which it stands in the ordered set.
    rank: Option<u64>,
}

pub(crate) struct Planner {
    params: PlannerParams,
    cells: Cells,
    hive: DVec2,
    known: Vec<Known>,
    /// Open cells, the most worthy first.
    open: BTreeSet<(u64, u16)>,
    /// Who went where: cell and deadline by ticket.
    out: BTreeMap<u16, (u16, SimTime)>,
    deadlines: BTreeSet<(SimTime, u16)>,
    ticket: u16,
}

/// So many of the best are looked at for somebody who is out already.
const LOOKED_AT: usize = 12;

impl Planner {
    pub(crate) fn new(params: PlannerParams, cells: Cells, hive: DVec2) -> Self {
        let unknown = Known {
            belief: params.belief,
            next: Task::Search,
            searches: 0,
            count: 0,
            places: Vec::new(),
            placed_by: Task::Search,
            taken: None,
            left_by: None,
            rank: None,
        };
        let mut planner = Self {
            params,
            cells,
            hive,
            known: vec![unknown; usize::from(cells.len())],
            open: BTreeSet::new(),
            out: BTreeMap::new(),
            deadlines: BTreeSet::new(),
            ticket: 0,
        };
        (0..cells.len()).for_each(|cell| planner.place(cell));
        planner
    }

    /// The next dispatch for somebody who is at the hive, or, with `from`, in that cell. `None` if
    /// nothing is worth it.
    pub(crate) fn dispatch(&mut self, from: Option<u16>, now: SimTime) -> Option<Job> {
        self.give_up(now);
        let cell = match from {
            None => self.open.first()?.1,
            Some(from) => self.best_from(from)?,
        };
        self.ticket = self.ticket.wrapping_add(1);
        let ticket = self.ticket;
        let until = now.after(self.params.patience).unwrap_or(now);
        self.out.insert(ticket, (cell, until));
        self.deadlines.insert((until, ticket));
        let known = &mut self.known[usize::from(cell)];
        known.taken = Some(ticket);
        let job = Job {
            ticket,
            task: known.next,
            cell,
            places: known.places.clone(),
        };
        self.place(cell);
        Some(job)
    }

    /// Takes in what came of a dispatch. What is told twice, by radio and at landing, counts once. Places,
    /// which are told at landing alone, are taken if they are known better than before. What a broken-off
    /// task found counts too, if nobody has brought news of the cell since.
    pub(crate) fn result(&mut self, finding: &Finding) {
        let Some(known) = self.known.get_mut(usize::from(finding.cell)) else {
            return;
        };
        let better = finding.task > known.placed_by
            || finding.task == known.placed_by && known.places.is_empty();
        if finding.complete && !finding.places.is_empty() && known.next != Task::Search && better {
            known.places.clone_from(&finding.places);
            known.placed_by = finding.task;
        }
        let Some((cell, until)) = self.out.remove(&finding.ticket) else {
            if !finding.complete && known.left_by == Some(finding.ticket) {
                self.weigh_part(finding);
                self.place(finding.cell);
            }
            return;
        };
        self.deadlines.remove(&(until, finding.ticket));
        if cell != finding.cell {
            return self.free(cell, finding.ticket);
        }
        if finding.complete {
            self.weigh(finding);
        } else {
            self.weigh_part(finding);
        }
        self.free(cell, finding.ticket);
    }

    /// A dispatch that is broken off: its cell is open again for others. What was found there until then may
    /// still be told, by [`Planner::result`].
    pub(crate) fn returned(&mut self, ticket: u16) {
        if let Some((cell, until)) = self.out.remove(&ticket) {
            self.deadlines.remove(&(until, ticket));
            self.known[usize::from(cell)].left_by = Some(ticket);
            self.free(cell, ticket);
        }
    }

    /// The share of cells that it knows to have been searched.
    pub(crate) fn searched(&self) -> f64 {
        let searched = self.known.iter().filter(|known| known.searches > 0).count();
        searched as f64 / self.known.len() as f64
    }

    /// How many dispatches are out.
    pub(crate) fn out(&self) -> usize {
        self.out.len()
    }

    fn weigh(&mut self, finding: &Finding) {
        let params = &self.params;
        let known = &mut self.known[usize::from(finding.cell)];
        let found = finding.count > 0;
        known.count = finding.count;
        known.left_by = None;
        // A sample told by radio has no places: rough ones are better than none until it is handed in.
        if finding.task != Task::Sample || !finding.places.is_empty() {
            known.places.clone_from(&finding.places);
            known.placed_by = finding.task;
        }
        let next = match (finding.task, found) {
            (Task::Search, true) => Task::Sample,
            (Task::Sample | Task::Pollinate, true) => Task::Pollinate,
            (_, false) => Task::Search,
        };
        known.next = next;
        match finding.task {
            Task::Search => known.searches += 1,
            Task::Sample => {}
            // Flowers that were visited look like those that were not: it is not searched again.
            Task::Pollinate => known.belief = 0.0,
        }
        if found && finding.task == Task::Search {
            let beside: Vec<u16> = self.cells.neighbors(finding.cell).collect();
            for cell in beside {
                let known = &mut self.known[usize::from(cell)];
                if known.searches == 0 && known.belief < self.params.belief_beside {
                    known.belief = self.params.belief_beside;
                    self.place(cell);
                }
            }
        } else if finding.task != Task::Pollinate && !found {
            let (p, d) = (known.belief, params.detection);
            known.belief = p * (1.0 - d) / (1.0 - p * d).max(f64::MIN_POSITIVE);
        }
    }

    /// Takes in what a broken-off task found: a search, that there are flowers at all; a pollination, which
    /// are left; a sample, where they are, if it is of all.
    fn weigh_part(&mut self, finding: &Finding) {
        let known = &mut self.known[usize::from(finding.cell)];
        known.left_by = None;
        let taken = match finding.task {
            Task::Search => known.next == Task::Search && finding.count > known.count,
            Task::Sample => known.next != Task::Search && finding.count >= known.count,
            Task::Pollinate => known.next == Task::Pollinate && finding.count > 0,
        };
        if taken {
            known.count = finding.count;
            if !finding.places.is_empty() {
                known.places.clone_from(&finding.places);
                known.placed_by = finding.task;
            }
        }
    }

    /// Those that nobody has come back from in time are open again.
    fn give_up(&mut self, now: SimTime) {
        while let Some((until, ticket)) = self.deadlines.first().copied()
            && until < now
        {
            if let Some((cell, until)) = self.out.remove(&ticket) {
                self.deadlines.remove(&(until, ticket));
                self.free(cell, ticket);
            }
        }
    }

    fn free(&mut self, cell: u16, ticket: u16) {
        let known = &mut self.known[usize::from(cell)];
        if known.taken == Some(ticket) {
            known.taken = None;
        }
        self.place(cell);
    }

    /// Puts a cell where it belongs in the ordered set.
    fn place(&mut self, cell: u16) {
        let worth = self.worth(cell, self.hive);
        let known = &mut self.known[usize::from(cell)];
        if let Some(rank) = known.rank.take() {
            self.open.remove(&(rank, cell));
        }
        if let Some(worth) = worth {
            // The bits of positive floats are in their order; the largest comes first.
            let rank = !worth.to_bits();
            known.rank = Some(rank);
            self.open.insert((rank, cell));
        }
    }

    /// Equation (2) for somebody at `from`; `None` if the cell is taken or not worth a visit.
    fn worth(&self, cell: u16, from: DVec2) -> Option<f64> {
        let (p, known) = (&self.params, &self.known[usize::from(cell)]);
        if known.taken.is_some() {
            return None;
        }
        let count = f64::from(known.count);
        let (gain, work_s) = match known.next {
            Task::Search if known.belief < p.least_belief && known.count == 0 => return None,
            Task::Search => {
                let expected = (known.belief * p.flowers).max(count);
                (expected / 3.0, p.search.get())
            }
            Task::Sample | Task::Pollinate => (count, p.search.get() + count * p.flower.get()),
        };
        let middle = self.cells.middle(cell);
        let way_m = middle.distance(from) + middle.distance(self.hive);
        Some(gain / (way_m / p.speed.get() + work_s))
    }

    /// The best of the cell itself, those around, and those that are best from the hive.
    fn best_from(&self, from: u16) -> Option<u16> {
        let at = self.cells.middle(from.min(self.cells.len() - 1));
        let near = std::iter::once(from).chain(self.cells.neighbors(from));
        let near = near.filter(|cell| *cell < self.cells.len());
        let best = self.open.iter().take(LOOKED_AT).map(|(_, cell)| *cell);
        let rated = near
            .chain(best)
            .filter_map(|cell| Some((self.worth(cell, at)?, cell)));
        let best = rated.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        best.map(|(_, cell)| cell)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn planner() -> Planner {
        let cells = Cells::around(DVec2::ZERO, 50.0, 10.0);
        Planner::new(PlannerParams::default(), cells, DVec2::ZERO)
    }

    fn at(seconds: u64) -> SimTime {
        SimTime::from_secs(seconds)
    }

    fn done(job: &Job, count: u16) -> Finding {
        Finding {
            ticket: job.ticket,
            task: job.task,
            cell: job.cell,
            complete: true,
            count,
            places: Vec::new(),
        }
    }

    #[test]
    fn all_cells_are_searched_the_nearest_first_and_each_by_one() {
        let mut planner = planner();
        let jobs: Vec<Job> = std::iter::from_fn(|| planner.dispatch(None, at(0))).collect();
        assert_eq!((jobs.len(), jobs[0].cell), (25, 12));
        assert!(jobs.iter().all(|job| job.task == Task::Search));
        let mut seen: Vec<u16> = jobs.iter().map(|job| job.cell).collect();
        let far = |cell: u16| planner.cells.middle(cell).length();
        assert!(seen.windows(2).all(|two| far(two[0]) <= far(two[1]) + 1e-9));
        seen.sort_unstable();
        assert_eq!(seen, (0..25).collect::<Vec<_>>());
    }

    #[test]
    fn a_cell_with_flowers_is_sampled_then_pollinated_then_left() {
        let mut planner = planner();
        let search = planner.dispatch(None, at(0)).expect("work");
        planner.result(&done(&search, 5));
        let sample = planner.dispatch(Some(search.cell), at(20)).expect("work");
        assert_eq!((sample.task, sample.cell), (Task::Sample, search.cell));
        let places = vec![DVec2::ONE; 4];
        planner.result(&Finding {
            places: places.clone(),
            ..done(&sample, 4)
        });
        let serve = planner.dispatch(None, at(60)).expect("work");
        assert_eq!((serve.task, serve.cell), (Task::Pollinate, search.cell));
        assert_eq!(serve.places, places);
        planner.result(&done(&serve, 0));
        while let Some(job) = planner.dispatch(None, at(80)) {
            assert_ne!(job.cell, search.cell);
        }
    }

    #[test]
    fn beside_a_find_is_searched_before_what_is_as_far() {
        let mut planner = planner();
        let corner = std::iter::from_fn(|| planner.dispatch(None, at(0)))
            .find(|job| job.cell == 24)
            .expect("the corner too");
        // All others come back with nothing done.
        for ticket in 1..=24 {
            planner.returned(ticket);
        }
        planner.result(&done(&corner, 3));
        let next: Vec<u16> = std::iter::from_fn(|| planner.dispatch(None, at(9)))
            .map(|job| job.cell)
            .collect();
        let turn = |cell: u16| next.iter().position(|other| *other == cell);
        for (beside, opposite) in [(18, 6), (19, 5), (23, 1)] {
            assert!(turn(beside) < turn(opposite), "{next:?}");
        }
    }

    #[test]
    fn a_cell_beside_a_find_that_was_empty_is_not_searched_before_one_that_never_was() {
        let params = PlannerParams::default();
        let (p, d) = (params.belief_beside.max(params.belief), params.detection);
        let empty = p * (1.0 - d) / (1.0 - p * d);
        assert!(empty < 0.5 * params.belief, "{empty}");
    }

    #[test]
    fn empty_cells_are_searched_again_until_nothing_is_believed_of_them() {
        let params = PlannerParams {
            detection: 0.8,
            ..PlannerParams::default()
        };
        let cells = Cells::around(DVec2::ZERO, 50.0, 10.0);
        let mut planner = Planner::new(params, cells, DVec2::ZERO);
        let mut searches = 0;
        while let Some(job) = planner.dispatch(None, at(0)) {
            searches += 1;
            planner.result(&done(&job, 0));
        }
        // 0.15, then 0.034, then 0.007 by (1).
        assert_eq!(searches, 50);
        assert_eq!(planner.searched(), 1.0);
    }

    #[test]
    fn what_nobody_comes_back_from_is_given_to_another_and_a_late_result_is_not_counted_twice() {
        let mut planner = planner();
        let first = planner.dispatch(None, at(0)).expect("work");
        let others = std::iter::from_fn(|| planner.dispatch(None, at(1))).count();
        assert_eq!(others, 24);
        assert_eq!(planner.dispatch(None, at(299)), None);
        let again = planner.dispatch(None, at(301)).expect("it was given up");
        assert_eq!((again.cell, again.task), (first.cell, Task::Search));
        planner.result(&done(&first, 7));
        assert_eq!(
            (planner.known[12].searches, planner.known[12].next),
            (0, Task::Search)
        );
        planner.result(&done(&again, 2));
        assert_eq!(
            (planner.known[12].searches, planner.known[12].count),
            (1, 2)
        );
        planner.result(&done(&again, 2));
        assert_eq!(planner.known[12].searches, 1);
    }

    #[test]
    fn what_a_broken_off_task_found_counts_at_landing_and_its_cell_is_open_before() {
        let mut planner = planner();
        let search = planner.dispatch(None, at(0)).expect("work");
        planner.result(&done(&search, 5));
        let sample = planner.dispatch(None, at(20)).expect("work");
        planner.result(&done(&sample, 5));
        let serve = planner.dispatch(None, at(60)).expect("work");
        planner.returned(serve.ticket);
        let places = vec![DVec2::ONE, DVec2::NEG_ONE];
        let part = Finding {
            complete: false,
            places: places.clone(),
            ..done(&serve, 2)
        };
        planner.result(&part);
        let again = planner.dispatch(None, at(70)).expect("it is open");
        assert_eq!((again.cell, again.task), (serve.cell, Task::Pollinate));
        assert_eq!((planner.known[12].count, again.places.clone()), (2, places));
        // Somebody was there since: what the first says is old.
        planner.result(&done(&again, 0));
        planner.result(&part);
        assert_eq!(planner.known[12].count, 0);
    }

    #[test]
    fn a_broken_off_search_that_saw_flowers_is_gone_on_with_first() {
        let mut planner = planner();
        let jobs: Vec<Job> = std::iter::from_fn(|| planner.dispatch(None, at(0))).collect();
        jobs.iter().for_each(|job| planner.returned(job.ticket));
        let corner = jobs.iter().find(|job| job.cell == 24).expect("the corner");
        planner.result(&Finding {
            complete: false,
            ..done(corner, 4)
        });
        let next = planner.dispatch(None, at(9)).expect("all are open");
        assert_eq!((next.cell, next.task), (24, Task::Search));
        // Nothing there: a phantom is not looked for without end.
        planner.result(&done(&next, 0));
        assert_eq!(planner.known[24].count, 0);
    }

    #[test]
    fn places_that_were_sampled_replace_those_that_were_seen_from_high() {
        let mut planner = planner();
        let search = planner.dispatch(None, at(0)).expect("work");
        planner.result(&done(&search, 2));
        let sample = planner.dispatch(Some(search.cell), at(9)).expect("work");
        planner.result(&done(&sample, 2));
        let tell = |planner: &mut Planner, job: &Job, x: f64| {
            planner.result(&Finding {
                places: vec![DVec2::new(x, 0.0); 2],
                ..done(job, 2)
            });
        };
        // It has landed, and hands in both.
        tell(&mut planner, &search, 0.5);
        tell(&mut planner, &sample, 0.1);
        tell(&mut planner, &search, 0.7);
        let serve = planner.dispatch(None, at(60)).expect("work");
        assert_eq!(serve.places, [DVec2::new(0.1, 0.0); 2]);
    }

    #[test]
    fn nonsense_from_the_air_changes_nothing() {
        let mut planner = planner();
        let job = planner.dispatch(None, at(0)).expect("work");
        planner.result(&Finding {
            cell: 60_000,
            ..done(&job, 9)
        });
        planner.result(&Finding {
            ticket: 999,
            ..done(&job, 9)
        });
        assert_eq!(planner.known[12].searches, 0);
        assert!(planner.dispatch(Some(60_000), at(0)).is_some());
    }
}

//! The three ways to coordinate the swarm, as far as a MAV's own mind goes.
//!
//! | scheme | who decides where a MAV goes next | what it needs |
//! |---|---|---|
//! | `central` | the hive's planner, on the pads and by radio | talk on the pads, radio |
//! | `static` | nobody: its share of the cells is fixed, it works through it | a briefing |
//! | `emergent` | the MAV, by the trails that beacons on the ground keep | beacons within earshot |
//!
//! The trails are stigmergy: traces that work leaves in the environment and that stimulate more work, as
//! Grassé named it for termites (*La reconstruction du nid...*, Insectes Sociaux 6, 1959). A MAV marks the
//! beacon of a cell when it goes there and when it leaves; marks evaporate. It goes where flowers were
//! left, else where the fewest have been lately.

use super::cells::Cells;
use super::planner::Finding;
use super::wire::{Job, Task};
use simbeeotic::prelude::*;
use simbeeotic::units::glam::DVec2;
use simbeeotic::units::math;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Who decides.
#[choice]
pub enum Scheme {
    /// A planner at the hive.
    Central,
    /// Each MAV has a fixed share of the cells.
    Static,
    /// Each MAV follows the trails that beacons keep.
    Emergent,
}

/// What a MAV does next.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Next {
    /// It asks the hive.
    Ask,
    /// It asks the beacons around.
    Listen,
    Work(Job),
    /// It flies there and decides again.
    Walk(DVec2),
    /// There is nothing to do for it.
    Rest,
}

/// A trail as it was heard last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trail {
    visits: f64,
    left: u8,
    taken: bool,
    heard: SimTime,
}

/// What a MAV decides by.
#[derive(Debug)]
pub(crate) enum Mind {
    Central,
    Static {
        share: Vec<u16>,
        /// How many of its searches it has done, over all passes.
        done: usize,
        passes: usize,
        /// What it had to leave.
        unfinished: Option<Job>,
    },
    Emergent {
        trails: BTreeMap<u16, Trail>,
    },
}

/// Trails are forgotten after this, s.
const MEMORY_S: f64 = 10.0;
/// A random walk's step in the field, m.
const STEP_M: f64 = 25.0;
/// So many metres of way are worth as much as one visit.
const VISIT_M: f64 = 15.0;

impl Mind {
    pub(crate) fn new(scheme: Scheme, share: Vec<u16>, passes: u32) -> Self {
        match scheme {
            Scheme::Central => Self::Central,
            Scheme::Static => Self::Static {
                share,
                done: 0,
                passes: passes as usize,
                unfinished: None,
            },
            Scheme::Emergent => Self::Emergent {
                trails: BTreeMap::new(),
            },
        }
    }

    /// Whether a search that finds flowers goes over into sampling and pollinating them, unasked.
    pub(crate) fn carries_on(&self) -> bool {
        !matches!(self, Self::Central)
    }

    /// What to do on its pad, charged.
    pub(crate) fn set_out(&mut self, cells: &Cells, chance: &mut Stream) -> Next {
        match self {
            Self::Central => Next::Ask,
            Self::Static { .. } => self.own_share(),
            // Somewhere in the field, each place as likely.
            Self::Emergent { trails } => {
                trails.clear();
                let any = (chance.uniform() * f64::from(cells.len())) as u16;
                Next::Walk(cells.middle(any.min(cells.len() - 1)))
            }
        }
    }

    /// What to do out there, free for something new.
    pub(crate) fn go_on(&mut self) -> Next {
        match self {
            Self::Central => Next::Ask,
            Self::Static { .. } => self.own_share(),
            Self::Emergent { .. } => Next::Listen,
        }
    }

    /// What to do at `here`, once the beacons have answered.
    pub(crate) fn choose(
        &mut self,
        cells: &Cells,
        here: DVec2,
        now: SimTime,
        chance: &mut Stream,
    ) -> Next {
        match self {
            Self::Central | Self::Static { .. } => Next::Rest,
            Self::Emergent { trails } => {
                trails.retain(|_, trail| (now - trail.heard).secs() < MEMORY_S);
                match follow(trails, cells, here, chance) {
                    Some(cell) => Next::Work(search(cell)),
                    None => Next::Walk(wander(cells, here, chance)),
                }
            }
        }
    }

    /// Takes note of what came of its work.
    pub(crate) fn done(&mut self, finding: &Finding) {
        let Self::Static {
            done, unfinished, ..
        } = self
        else {
            return;
        };
        if finding.complete {
            *done += usize::from(unfinished.take().is_none());
        } else {
            let job = Job {
                places: finding.places.clone(),
                ..search(finding.cell)
            };
            let known = finding.task == Task::Pollinate && !job.places.is_empty();
            // Next time it begins with the flowers that it knows, if it knew them all.
            *unfinished = known.then_some(Job {
                task: Task::Pollinate,
                ..job
            });
            if known {
                *done += 1;
            }
        }
    }

    /// Hears a beacon, or another MAV that tells where it goes.
    pub(crate) fn hear(&mut self, cell: u16, news: (f64, u8, bool), now: SimTime) {
        if let Self::Emergent { trails } = self {
            let (visits, left, taken) = news;
            trails.insert(
                cell,
                Trail {
                    visits,
                    left,
                    taken,
                    heard: now,
                },
            );
        }
    }

    /// Hears that a cell is taken from now on.
    pub(crate) fn hear_claim(&mut self, cell: u16) {
        if let Self::Emergent { trails } = self
            && let Some(trail) = trails.get_mut(&cell)
        {
            trail.taken = true;
        }
    }

    fn own_share(&mut self) -> Next {
        let Self::Static {
            share,
            done,
            passes,
            unfinished,
        } = self
        else {
            return Next::Rest;
        };
        if let Some(job) = unfinished {
            return Next::Work(job.clone());
        }
        if share.is_empty() || *done >= share.len() * *passes {
            return Next::Rest;
        }
        Next::Work(search(share[*done % share.len()]))
    }
}

fn search(cell: u16) -> Job {
    Job {
        ticket: 0,
        task: Task::Search,
        cell,
        places: Vec::new(),
    }
}

/// The cell that the trails lead to: with the most flowers left for the way, else the least visited for
/// it; a little chance keeps two apart.
fn follow(
    trails: &BTreeMap<u16, Trail>,
    cells: &Cells,
    here: DVec2,
    chance: &mut Stream,
) -> Option<u16> {
    let free = trails.iter().filter(|(_, trail)| !trail.taken);
    let rated = free.map(|(cell, trail)| {
        let way = cells.middle(*cell).distance(here) / VISIT_M;
        let rich = f64::from(trail.left);
        let pull = if rich > 0.0 {
            10.0 + rich
        } else {
            -trail.visits
        };
        (pull - way + 0.5 * chance.uniform(), *cell)
    });
    let best = rated.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
    best.map(|(_, cell)| cell)
}

/// A step to somewhere in the field.
fn wander(cells: &Cells, here: DVec2, chance: &mut Stream) -> DVec2 {
    for _ in 0..16 {
        let (sin, cos) = math::sin_cos(TAU * chance.uniform());
        let there = here + DVec2::new(cos, sin) * STEP_M;
        if cells.at(there).is_some() {
            return there;
        }
    }
    cells.middle(cells.len() / 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells() -> Cells {
        Cells::around(DVec2::ZERO, 100.0, 10.0)
    }

    fn chance() -> Stream {
        Stream::new(1, "mav", "mind")
    }

    fn finding(cell: u16, complete: bool, places: usize) -> Finding {
        Finding {
            ticket: 0,
            task: Task::Pollinate,
            cell,
            complete,
            count: places as u16,
            places: vec![DVec2::ONE; places],
        }
    }

    #[test]
    fn a_share_is_worked_off_pass_by_pass_and_what_was_left_comes_first() {
        let mut mind = Mind::new(Scheme::Static, vec![7, 8], 2);
        let mut seen = Vec::new();
        while let Next::Work(job) = mind.set_out(&cells(), &mut chance()) {
            // The second is left once, with two flowers.
            let left = seen == [7];
            mind.done(&finding(job.cell, !left, if left { 2 } else { 0 }));
            seen.push(job.cell);
            assert!(seen.len() < 9, "{seen:?}");
        }
        assert_eq!(seen, [7, 8, 8, 7, 8]);
    }

    #[test]
    fn trails_lead_to_what_is_left_then_to_where_nobody_was_and_never_to_a_cell_that_is_taken() {
        let mut mind = Mind::new(Scheme::Emergent, Vec::new(), 1);
        let (now, here) = (SimTime::from_secs(5), cells().middle(44));
        let next = |mind: &mut Mind| match mind.choose(&cells(), here, now, &mut chance()) {
            Next::Work(job) => Some(job.cell),
            _ => None,
        };
        assert_eq!(next(&mut mind), None);
        mind.hear(43, (3.0, 0, false), now);
        mind.hear(45, (0.0, 0, false), now);
        assert_eq!(next(&mut mind), Some(45));
        mind.hear(54, (9.0, 6, false), now);
        assert_eq!(next(&mut mind), Some(54));
        mind.hear_claim(54);
        assert_eq!(next(&mut mind), Some(45));
        let later = SimTime::from_secs(60);
        let next = mind.choose(&cells(), here, later, &mut chance());
        assert!(matches!(next, Next::Walk(_)), "{next:?}");
    }

    #[test]
    fn nobody_wanders_out_of_the_field() {
        let (cells, mut chance) = (cells(), chance());
        let mut here = DVec2::ZERO;
        for _ in 0..1000 {
            here = wander(&cells, here, &mut chance);
            assert!(cells.at(here).is_some(), "{here}");
        }
    }
}

//! A chart of the mine: which cells there are, where they are open, how often somebody was there.

use simbeeotic::kernel::Stream;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// A cell: storey above the base, and steps to the east and north of the shaft.
pub type Place = [i8; 3];

/// East, north, west, south, up, down.
pub const WAYS: [Place; 6] = [
    [0, 1, 0],
    [0, 0, 1],
    [0, -1, 0],
    [0, 0, -1],
    [1, 0, 0],
    [-1, 0, 0],
];

/// Where the base is.
pub const HOME: Place = [0, 0, 0];

/// The cell that lies one step on.
pub fn step(from: Place, way: usize) -> Place {
    let mut to = from;
    for (at, by) in to.iter_mut().zip(WAYS[way % 6]) {
        *at = at.saturating_add(by);
    }
    to
}

/// The way back.
fn back(way: usize) -> usize {
    match way {
        0..4 => (way + 2) % 4,
        4 => 5,
        _ => 4,
    }
}

/// What is known of one cell. A bit for each way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Cell {
    open: u8,
    shut: u8,
    /// Somebody went there: open, whatever somebody else makes of it.
    passed: u8,
    visits: u8,
}

impl Cell {
    fn exits(self) -> u8 {
        self.passed | self.open & !self.shut
    }
}

/// A chart.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    cells: BTreeMap<Place, Cell>,
    /// The first cell of the next packet.
    next: Place,
}

/// What a packet with cells begins with.
const KIND: u8 = 0xa1;
/// Bytes of a cell in a packet, and how many one packet holds: it fits into a frame of IEEE 802.15.4.
const ENTRY: usize = 7;
const ENTRIES: usize = 16;

impl Chart {
    /// Notes somebody's visit.
    pub fn visit(&mut self, at: Place) {
        let cell = self.cells.entry(at).or_default();
        cell.visits = cell.visits.saturating_add(1);
    }

    /// Notes whether one can see from a cell into the next, and so come back from there. What somebody
    /// found shut stays shut, unless somebody went there.
    pub fn note(&mut self, at: Place, way: usize, open: bool) {
        for (at, way) in [(at, way), (step(at, way), back(way))] {
            let cell = self.cells.entry(at).or_default();
            if open {
                cell.open |= 1 << way;
            } else {
                cell.shut |= 1 << way;
            }
        }
    }

    /// Notes that somebody went from a cell to the next.
    pub fn pass(&mut self, at: Place, way: usize) {
        for (at, way) in [(at, way), (step(at, way), back(way))] {
            self.cells.entry(at).or_default().passed |= 1 << way;
        }
    }

    /// Cells that somebody has visited.
    pub fn visited(&self) -> usize {
        self.cells.values().filter(|cell| cell.visits > 0).count()
    }

    fn visits(&self, at: Place) -> u8 {
        self.cells.get(&at).map_or(0, |cell| cell.visits)
    }

    fn exits(&self, at: Place) -> impl Iterator<Item = (usize, Place)> {
        let open = self.cells.get(&at).map_or(0, |cell| cell.exits());
        (0..6)
            .filter(move |way| open >> way & 1 == 1)
            .map(move |way| (way, step(at, way)))
    }

    /// Which way to explore: to a neighbour where nobody was, any of them; else towards the nearest cell
    /// where nobody was. `None`: there is none.
    pub fn explore(&self, from: Place, chance: &mut Stream) -> Option<usize> {
        let fresh: Vec<usize> = self
            .exits(from)
            .filter(|(_, to)| self.visits(*to) == 0)
            .map(|(way, _)| way)
            .collect();
        match fresh.len() {
            0 => self.toward(from, chance, |chart, at| chart.visits(at) == 0),
            n => Some(fresh[chance.below(n as u64) as usize]),
        }
    }

    /// The first step of a shortest known way to `to`. `None`: it is there, or no way is known.
    pub fn way_to(&self, from: Place, to: Place, chance: &mut Stream) -> Option<usize> {
        self.toward(from, chance, |_, at| at == to)
    }

    /// Breadth first; of first steps that are as good any.
    fn toward(
        &self,
        from: Place,
        chance: &mut Stream,
        goal: impl Fn(&Self, Place) -> bool,
    ) -> Option<usize> {
        let mut first: Vec<(usize, Place)> = self.exits(from).collect();
        for last in (1..first.len()).rev() {
            first.swap(last, chance.below(last as u64 + 1) as usize);
        }
        let mut seen: BTreeSet<Place> = [from].into();
        let mut queue: VecDeque<(usize, Place)> = first.into();
        while let Some((way, at)) = queue.pop_front() {
            if !seen.insert(at) {
                continue;
            }
            if goal(self, at) {
                return Some(way);
            }
            queue.extend(self.exits(at).map(|(_, to)| (way, to)));
        }
        None
    }

    /// Some cells as a packet; each call the next ones, from the beginning again after the last.
    pub fn packet(&mut self) -> Vec<u8> {
        let mut bytes = vec![KIND];
        let known = self.cells.iter().filter(|(_, cell)| cell.visits > 0);
        let (before, after): (Vec<_>, Vec<_>) = known.partition(|(at, _)| **at < self.next);
        let mut all = after.into_iter().chain(before);
        for ([storey, x, y], cell) in all.by_ref().take(ENTRIES) {
            let [storey, x, y] = [storey, x, y].map(|n| n.cast_unsigned());
            bytes.extend([storey, x, y, cell.open, cell.shut, cell.passed, cell.visits]);
        }
        self.next = all.next().map_or([i8::MIN; 3], |(at, _)| *at);
        bytes
    }

    /// Takes over what somebody else knows. Bytes that are no packet of cells are left alone.
    pub fn hear(&mut self, bytes: &[u8]) {
        let Some((&KIND, entries)) = bytes.split_first() else {
            return;
        };
        for entry in entries.as_chunks::<ENTRY>().0 {
            let [storey, x, y, open, shut, passed, visits] = *entry;
            let at = [storey, x, y].map(u8::cast_signed);
            let cell = self.cells.entry(at).or_default();
            cell.visits = cell.visits.max(visits);
            cell.open |= open;
            cell.shut |= shut;
            cell.passed |= passed;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chance() -> Stream {
        Stream::new(1, "bee", "way")
    }

    /// A tunnel of five cells to the east, the first three of them visited.
    fn tunnel() -> Chart {
        let mut chart = Chart::default();
        for x in 0..3 {
            chart.visit([0, x, 0]);
            chart.note([0, x, 0], 0, true);
            chart.note([0, x, 0], 1, false);
        }
        chart
    }

    #[test]
    fn it_leads_to_what_nobody_has_seen_and_home_again() {
        let mut chart = tunnel();
        assert_eq!(chart.explore([0, 0, 0], &mut chance()), Some(0));
        assert_eq!(chart.explore([0, 2, 0], &mut chance()), Some(0));
        assert_eq!(chart.way_to([0, 2, 0], HOME, &mut chance()), Some(2));
        assert_eq!(chart.way_to(HOME, HOME, &mut chance()), None);
        chart.visit([0, 3, 0]);
        assert_eq!(
            chart.explore([0, 1, 0], &mut chance()),
            None,
            "all is known"
        );
    }

    #[test]
    fn what_turns_out_to_be_shut_is_not_tried_again() {
        let mut chart = tunnel();
        chart.note([0, 2, 0], 0, false);
        chart.note([0, 2, 0], 0, true);
        assert_eq!(chart.explore([0, 2, 0], &mut chance()), None);
        chart.pass([0, 2, 0], 0);
        assert_eq!(
            chart.explore([0, 2, 0], &mut chance()),
            Some(0),
            "somebody was there"
        );
    }

    #[test]
    fn packets_bring_all_cells_over_and_noise_changes_nothing() {
        let mut large = Chart::default();
        for x in 0..50 {
            large.visit([1, x, -3]);
            large.note([1, x, -3], 0, true);
        }
        let mut other = Chart::default();
        for _ in 0..4 {
            let packet = large.packet();
            assert!(packet.len() <= 116);
            other.hear(&packet);
        }
        assert_eq!(other.visited(), 50);
        let before = other.cells.clone();
        for noise in [&[][..], &[KIND], &[KIND, 1, 2], &[0xff; 40]] {
            other.hear(noise);
        }
        assert_eq!(other.cells, before);
    }
}

//! What the run's thread and the pages' threads share. Each lock is held for a copy, never for a socket; and while it
//! runs, the run's thread waits for none of them: what it finds locked it leaves for its next look.

use super::look::Look;
use super::marks::Event;
use crate::series::Series;
use crate::server::Bell;
use crate::wire::{Message, Packet, Said};
use simbeeotic_model::kernel::Progress;
use simbeeotic_model::kernel::pace::Control;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError, TryLockError};

/// Marks that a page which comes late is told.
pub(super) const MARKS_KEPT: usize = 5000;

/// Packets that wait for slow pages.
pub(super) const PACKETS_KEPT: usize = 1000;

/// The newest of a list without end.
#[derive(Debug)]
pub(super) struct Ring<T> {
    kept: VecDeque<T>,
    most: usize,
    /// How many there ever were.
    end: u64,
}

impl<T: Clone> Ring<T> {
    fn new(most: usize) -> Self {
        Self {
            kept: VecDeque::new(),
            most,
            end: 0,
        }
    }

    pub(super) fn push(&mut self, item: T) {
        if self.kept.len() >= self.most {
            self.kept.pop_front();
        }
        self.kept.push_back(item);
        self.end += 1;
    }

    /// There were so many more, and they are not kept.
    pub(super) fn skip(&mut self, count: u64) {
        self.end += count;
    }

    pub(super) fn end(&self) -> u64 {
        self.end
    }

    /// The newest of those that came after `seen`, at most so many, and how many are left out.
    pub(super) fn since(&self, seen: u64, most: usize) -> (Vec<T>, u64) {
        let new = self.end.saturating_sub(seen);
        let count = usize::try_from(new)
            .unwrap_or(usize::MAX)
            .min(most)
            .min(self.kept.len());
        let list = self.kept.range(self.kept.len() - count..).cloned();
        (list.collect(), new - count as u64)
    }

    pub(super) fn iter(&self) -> impl DoubleEndedIterator<Item = &T> + Clone {
        self.kept.iter()
    }
}

/// A message that is replaced now and then. Pages encode it.
#[derive(Debug, Default)]
pub(super) struct Latest {
    number: u64,
    said: Option<Arc<Said>>,
}

impl Latest {
    pub(super) fn set(&mut self, said: Said) {
        self.number += 1;
        self.said = Some(Arc::new(said));
    }

    /// The message, if it is newer than the one that was seen.
    pub(super) fn since(&self, seen: &mut u64) -> Option<Arc<Said>> {
        if *seen == self.number {
            return None;
        }
        *seen = self.number;
        self.said.clone()
    }
}

/// The newest state of the run.
#[derive(Debug)]
pub(super) struct Now {
    pub(super) look: Arc<Look>,
    /// Counts looks.
    pub(super) number: u64,
    pub(super) marks: Ring<Event>,
    pub(super) packets: Ring<Arc<Packet>>,
    pub(super) links: Latest,
    pub(super) wind: Latest,
    pub(super) details: BTreeMap<u32, Latest>,
    pub(super) ended: Option<String>,
}

/// What one page wants.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Want {
    pub(super) vehicle: Option<u32>,
    pub(super) colour: Option<String>,
}

/// What all pages want.
#[derive(Debug, Default)]
pub(super) struct Wants {
    pages: BTreeMap<u64, Want>,
    next: u64,
}

impl Wants {
    pub(super) fn vehicles(&self) -> BTreeSet<u32> {
        self.pages
            .values()
            .filter_map(|want| want.vehicle)
            .collect()
    }

    pub(super) fn colours(&self) -> BTreeSet<String> {
        let colours = self.pages.values().filter_map(|want| want.colour.clone());
        colours.collect()
    }
}

/// All of it.
pub(super) struct Shared {
    /// The first message, once the run is known.
    pub(super) hello: OnceLock<Message>,
    pub(super) vehicles: OnceLock<u32>,
    pub(super) control: OnceLock<Arc<Control>>,
    pub(super) progress: OnceLock<Arc<Progress>>,
    /// Pages that look.
    pub(super) pages: AtomicUsize,
    /// Changes whenever a page wants something else.
    pub(super) version: AtomicU64,
    /// Whether a page waits for a frame.
    pub(super) hungry: AtomicBool,
    now: Mutex<Now>,
    series: Mutex<Series>,
    wants: Mutex<Wants>,
    bells: Mutex<BTreeMap<u64, Arc<Bell>>>,
}

impl Shared {
    pub(super) fn new() -> Self {
        Self {
            hello: OnceLock::new(),
            vehicles: OnceLock::new(),
            control: OnceLock::new(),
            progress: OnceLock::new(),
            pages: AtomicUsize::new(0),
            version: AtomicU64::new(0),
            hungry: AtomicBool::new(false),
            now: Mutex::new(Now {
                look: Arc::default(),
                number: 0,
                marks: Ring::new(MARKS_KEPT),
                packets: Ring::new(PACKETS_KEPT),
                links: Latest::default(),
                wind: Latest::default(),
                details: BTreeMap::new(),
                ended: None,
            }),
            series: Mutex::default(),
            wants: Mutex::default(),
            bells: Mutex::default(),
        }
    }

    pub(super) fn now(&self) -> MutexGuard<'_, Now> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn series(&self) -> MutexGuard<'_, Series> {
        self.series.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn wants(&self) -> MutexGuard<'_, Wants> {
        self.wants.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// [`now`](Self::now), if nobody is at it.
    pub(super) fn try_now(&self) -> Option<MutexGuard<'_, Now>> {
        free(&self.now)
    }

    /// [`series`](Self::series), if nobody is at them.
    pub(super) fn try_series(&self) -> Option<MutexGuard<'_, Series>> {
        free(&self.series)
    }

    /// [`wants`](Self::wants), if nobody is at them.
    pub(super) fn try_wants(&self) -> Option<MutexGuard<'_, Wants>> {
        free(&self.wants)
    }

    fn bells(&self) -> MutexGuard<'_, BTreeMap<u64, Arc<Bell>>> {
        self.bells.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A page has come; its number.
    pub(super) fn enter(&self, bell: Arc<Bell>) -> u64 {
        let number = {
            let mut wants = self.wants();
            wants.next += 1;
            let number = wants.next;
            wants.pages.insert(number, Want::default());
            number
        };
        self.bells().insert(number, bell);
        self.pages.fetch_add(1, Ordering::AcqRel);
        self.version.fetch_add(1, Ordering::AcqRel);
        self.hungry.store(true, Ordering::Release);
        number
    }

    /// A page has gone.
    pub(super) fn leave(&self, page: u64) {
        self.bells().remove(&page);
        self.wants().pages.remove(&page);
        self.pages.fetch_sub(1, Ordering::AcqRel);
        self.version.fetch_add(1, Ordering::AcqRel);
    }

    /// A page wants something else.
    pub(super) fn want(&self, page: u64, change: impl FnOnce(&mut Want)) {
        if let Some(want) = self.wants().pages.get_mut(&page) {
            change(want);
        }
        self.version.fetch_add(1, Ordering::AcqRel);
        self.hungry.store(true, Ordering::Release);
    }

    /// There is something new for all pages. Who comes or goes just now finds out by itself.
    pub(super) fn ring(&self) {
        if let Some(bells) = free(&self.bells) {
            bells.values().for_each(|bell| bell.ring());
        }
    }
}

/// A lock that nobody holds.
fn free<T>(lock: &Mutex<T>) -> Option<MutexGuard<'_, T>> {
    match lock.try_lock() {
        Ok(guard) => Some(guard),
        Err(TryLockError::Poisoned(poisoned)) => Some(poisoned.into_inner()),
        Err(TryLockError::WouldBlock) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_are_kept_and_the_rest_is_counted() {
        let mut ring = Ring::new(3);
        assert_eq!(ring.since(0, 10), (Vec::new(), 0));
        for item in 0..5 {
            ring.push(item);
        }
        assert_eq!(ring.since(0, 10), (vec![2, 3, 4], 2));
        assert_eq!(ring.since(3, 10), (vec![3, 4], 0));
        assert_eq!(ring.since(0, 1), (vec![4], 4));
        ring.skip(7);
        ring.push(12);
        assert_eq!(ring.end(), 13);
        assert_eq!(ring.since(13, 10), (Vec::new(), 0));
        assert_eq!(ring.since(5, 1), (vec![12], 7));
    }
}

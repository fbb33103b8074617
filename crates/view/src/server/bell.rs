//! What wakes the thread that writes to a page.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::Thread;
use std::time::{Duration, Instant};

/// Rung when there is something new; heard once, however often it was rung. There is no lock in it: who rings
/// never waits, whatever becomes of who listens.
#[derive(Debug, Default)]
pub struct Bell {
    rung: AtomicBool,
    /// Who listens: the first thread that waited.
    listener: OnceLock<Thread>,
}

impl Bell {
    /// Rings.
    pub fn ring(&self) {
        let silent = !self.rung.swap(true, Ordering::AcqRel);
        if let Some(listener) = self.listener.get().filter(|_| silent) {
            listener.unpark();
        }
    }

    /// Waits until it is rung, or for so long. One thread alone may wait.
    #[allow(
        clippy::disallowed_methods,
        reason = "how long a page has nothing to hear is wall time"
    )]
    pub fn wait(&self, at_most: Duration) {
        self.listener.get_or_init(std::thread::current);
        let begun = Instant::now();
        while !self.rung.swap(false, Ordering::AcqRel) {
            let left = at_most.saturating_sub(begun.elapsed());
            if left.is_zero() {
                return;
            }
            // Returns at once if it was rung since, and now and then without a reason.
            std::thread::park_timeout(left);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    #[test]
    fn a_ring_before_the_wait_is_heard_once() {
        let bell = Bell::default();
        bell.ring();
        bell.ring();
        bell.wait(Duration::from_secs(3600));
        assert!(!bell.rung.load(Ordering::Relaxed));
    }

    #[test]
    fn who_waits_is_woken() {
        let bell = Arc::new(Bell::default());
        let waits = {
            let bell = Arc::clone(&bell);
            std::thread::spawn(move || {
                for _ in 0..100 {
                    bell.wait(Duration::from_secs(3600));
                }
            })
        };
        while !waits.is_finished() {
            bell.ring();
            std::thread::yield_now();
        }
        assert!(waits.join().is_ok());
    }

    #[test]
    fn a_bell_that_nobody_rings_is_waited_for_no_longer_than_asked() {
        Bell::default().wait(Duration::from_millis(1));
    }
}

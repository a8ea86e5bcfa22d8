//! The run's clock: the only place in the driver that reads the computer's.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use crate::time::Time;

/// What [`Clock::frozen`] holds while the clock runs.
const RUNNING: u64 = u64::MAX;

/// A clock that can be paused. Reading it takes no lock, since nodes at full speed read it twice an atom.
#[derive(Debug)]
pub(super) struct Clock {
    start: Instant,
    /// Nanoseconds spent in pauses that are over.
    lost: AtomicU64,
    /// The time at which the clock stands still, or [`RUNNING`].
    frozen: AtomicU64,
    /// The run is over: nobody may be made to wait any more.
    ended: AtomicBool,
    /// Held while a pause begins or ends.
    change: Mutex<()>,
    resumed: Condvar,
}

impl Clock {
    /// A clock that starts now, at [`Time::ZERO`].
    #[expect(clippy::disallowed_methods, reason = "the run's clock")]
    pub fn start() -> Self {
        Self {
            start: Instant::now(),
            lost: AtomicU64::new(0),
            frozen: AtomicU64::new(RUNNING),
            ended: AtomicBool::new(false),
            change: Mutex::new(()),
            resumed: Condvar::new(),
        }
    }

    /// The time since the start, without the pauses.
    pub fn now(&self) -> Time {
        loop {
            let frozen = self.frozen.load(Ordering::SeqCst);
            if frozen != RUNNING {
                return Time(frozen);
            }
            let lost = self.lost.load(Ordering::SeqCst);
            let now = self.elapsed() - lost;
            // A pause that began meanwhile would have this reading lie beyond it.
            if self.frozen.load(Ordering::SeqCst) == RUNNING && self.lost.load(Ordering::SeqCst) == lost {
                return Time(now);
            }
        }
    }

    /// Makes the clock stand still, unless it does or the run is over.
    pub fn pause(&self) {
        let _change = self.lock();
        if !self.is_paused() && !self.has_ended() {
            self.frozen.store(self.now().0, Ordering::SeqCst);
        }
    }

    /// Lets the clock go on.
    pub fn resume(&self) {
        let _change = self.lock();
        if self.is_paused() {
            // The frozen time is left last: whoever sees the clock run again also sees what the pause took.
            let frozen = self.frozen.load(Ordering::SeqCst);
            self.lost.store(self.elapsed() - frozen, Ordering::SeqCst);
            self.frozen.store(RUNNING, Ordering::SeqCst);
        }
        self.resumed.notify_all();
    }

    /// Lets the clock go on for good: the run is over, and it cannot be paused any more.
    pub fn end(&self) {
        self.ended.store(true, Ordering::SeqCst);
        self.resume();
    }

    /// Whether the clock stands still.
    pub fn is_paused(&self) -> bool {
        self.frozen.load(Ordering::SeqCst) != RUNNING
    }

    /// Whether the run is over: [`Clock::end`] was called.
    pub fn has_ended(&self) -> bool {
        self.ended.load(Ordering::SeqCst)
    }

    /// Blocks until the clock runs.
    pub fn wait_until_resumed(&self) {
        let _running = self.resumed.wait_while(self.lock(), |()| self.is_paused());
    }

    /// The lock has nothing to protect but the waiting, so that a panic elsewhere does no harm to it.
    fn lock(&self) -> MutexGuard<'_, ()> {
        self.change.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Nanoseconds since the start, pauses included: enough for 584 years.
    fn elapsed(&self) -> u64 {
        self.start.elapsed().as_nanos() as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn stands_still_while_paused_and_goes_on_from_there() {
        let clock = Clock::start();
        clock.pause();
        let paused = clock.now();
        std::thread::sleep(Duration::from_millis(30));
        clock.pause();
        assert_eq!(clock.now(), paused);
        clock.resume();
        let resumed = clock.now();
        assert!(paused <= resumed);
        // The 30 ms of the pause have passed on the computer's clock only.
        let both = Time(clock.elapsed());
        assert!(both.since(resumed) >= Duration::from_millis(30));
    }

    #[test]
    fn a_run_that_is_over_cannot_be_paused() {
        let clock = Clock::start();
        clock.pause();
        clock.end();
        clock.pause();
        assert!(!clock.is_paused());
        // Would not return otherwise.
        clock.wait_until_resumed();
    }
}

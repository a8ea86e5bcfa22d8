//! The run's clock: the only place in the driver that reads the computer's clock.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use crate::cancel::CancelToken;
use crate::time::Time;

/// Value of [`Clock::frozen`] while the clock runs.
const RUNNING: u64 = u64::MAX;

/// A clock that can be paused. Reading it takes no lock, since nodes at full speed read it twice for each atom.
#[derive(Debug)]
pub(super) struct Clock {
    start: Instant,
    /// Nanoseconds spent in past pauses.
    lost: AtomicU64,
    /// The time at which the clock is paused, or [`RUNNING`].
    frozen: AtomicU64,
    /// Cancelled when the run is over: the clock cannot be paused any more, and all threads end.
    ended: CancelToken,
    /// Held while a pause begins or ends.
    change: Mutex<()>,
    resumed: Condvar,
}

impl Clock {
    /// Starts a clock at [`Time::ZERO`].
    #[expect(clippy::disallowed_methods, reason = "the run's clock")]
    pub fn start() -> Self {
        Self {
            start: Instant::now(),
            lost: AtomicU64::new(0),
            frozen: AtomicU64::new(RUNNING),
            ended: CancelToken::default(),
            change: Mutex::new(()),
            resumed: Condvar::new(),
        }
    }

    /// Returns the time since the start, without the pauses.
    pub fn now(&self) -> Time {
        loop {
            let frozen = self.frozen.load(Ordering::SeqCst);
            if frozen != RUNNING {
                return Time(frozen);
            }
            let lost = self.lost.load(Ordering::SeqCst);
            let now = self.elapsed() - lost;
            // Read again if a pause has begun meanwhile: this time would be later than the pause.
            if self.frozen.load(Ordering::SeqCst) == RUNNING && self.lost.load(Ordering::SeqCst) == lost {
                return Time(now);
            }
        }
    }

    /// Pauses the clock, unless it is paused or the run is over.
    pub fn pause(&self) {
        let _change = self.lock();
        if !self.is_paused() && !self.has_ended() {
            self.frozen.store(self.now().0, Ordering::SeqCst);
        }
    }

    /// Lets the clock continue.
    pub fn resume(&self) {
        let _change = self.lock();
        if self.is_paused() {
            // `frozen` is stored last: a reader that sees the clock run also sees the length of the pause.
            let frozen = self.frozen.load(Ordering::SeqCst);
            self.lost.store(self.elapsed() - frozen, Ordering::SeqCst);
            self.frozen.store(RUNNING, Ordering::SeqCst);
        }
        self.resumed.notify_all();
    }

    /// Ends the run: the clock continues and cannot be paused any more.
    pub fn end(&self) {
        self.ended.cancel();
        self.resume();
    }

    /// Returns whether the clock is paused.
    pub fn is_paused(&self) -> bool {
        self.frozen.load(Ordering::SeqCst) != RUNNING
    }

    /// Returns whether [`Clock::end`] was called.
    pub fn has_ended(&self) -> bool {
        self.ended.is_cancelled()
    }

    /// Returns the token that [`Clock::end`] cancels.
    pub fn ended(&self) -> &CancelToken {
        &self.ended
    }

    /// Blocks until the clock runs.
    pub fn wait_until_resumed(&self) {
        let _running = self.resumed.wait_while(self.lock(), |()| self.is_paused());
    }

    /// Takes the lock, also after a panic of another thread: the lock protects no data.
    fn lock(&self) -> MutexGuard<'_, ()> {
        self.change.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the nanoseconds since the start, pauses included: enough for 584 years.
    fn elapsed(&self) -> u64 {
        self.start.elapsed().as_nanos() as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn paused_clock_stands_still_and_continues_from_there() {
        let clock = Clock::start();
        clock.pause();
        let paused = clock.now();
        std::thread::sleep(Duration::from_millis(30));
        clock.pause();
        assert_eq!(clock.now(), paused);
        clock.resume();
        let resumed = clock.now();
        assert!(paused <= resumed);
        // The 30 ms of the pause have passed only on the computer's clock.
        let both = Time(clock.elapsed());
        assert!(both.since(resumed) >= Duration::from_millis(30));
    }

    #[test]
    fn ended_clock_cannot_be_paused() {
        let clock = Clock::start();
        clock.pause();
        clock.end();
        clock.pause();
        assert!(!clock.is_paused());
        // Would not return otherwise.
        clock.wait_until_resumed();
    }
}

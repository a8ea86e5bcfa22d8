//! The sleep notice: a sleeping node announces at growing intervals that it sleeps, since notices may be lost.

use std::time::Duration;

use crate::time::Time;

/// Schedule of a sleeping node's notices.
#[derive(Debug)]
pub(super) struct SleepNotice {
    next: Time,
    pause: Duration,
}

impl SleepNotice {
    /// Creates the schedule of a node that falls asleep at `now` and announces that at once: the second notice is due
    /// after `pause`.
    pub fn new(now: Time, pause: Duration) -> Self {
        Self { next: now + pause, pause }
    }

    /// Returns when the next notice is due.
    pub fn expiry(&self) -> Time {
        self.next
    }

    /// Returns whether a notice is due at `now`; if so, the next one is due after twice the last pause.
    pub fn take_due(&mut self, now: Time) -> bool {
        let is_due = self.next <= now;
        if is_due {
            self.pause *= 2;
            self.next = now + self.pause;
        }
        is_due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pauses_double() {
        let mut notice = SleepNotice::new(Time(100), Duration::from_nanos(10));
        assert!(!notice.take_due(Time(109)));
        let mut expiries = vec![notice.expiry()];
        for _ in 0..3 {
            assert!(notice.take_due(notice.expiry()));
            expiries.push(notice.expiry());
        }
        assert_eq!(expiries, [110, 130, 170, 250].map(Time));
    }
}

//! Heartbeat: the node tells the parent at regular intervals which atoms it holds.

use std::time::Duration;

use crate::time::Time;

/// Schedule of the node's beats.
#[derive(Debug)]
pub(super) struct Heartbeat {
    interval: Duration,
    /// When the next beat is due; `None` before the band arrives, and always without leases.
    next: Option<Time>,
}

impl Heartbeat {
    /// Creates a schedule that has not started.
    pub fn new(interval: Duration) -> Self {
        Self { interval, next: None }
    }

    /// Returns the time from one beat to the next.
    pub fn interval(&self) -> Duration {
        self.interval
    }

    /// Starts the schedule: the first beat is due one interval after `now`. Has no effect once started.
    pub fn start(&mut self, now: Time) {
        self.next.get_or_insert(now + self.interval);
    }

    /// Returns when the next beat is due.
    pub fn expiry(&self) -> Option<Time> {
        self.next
    }

    /// Returns whether a beat is due at `now`; if so, the next one is due one interval later.
    pub fn take_due(&mut self, now: Time) -> bool {
        let is_due = self.next.is_some_and(|next| next <= now);
        if is_due {
            self.next = Some(now + self.interval);
        }
        is_due
    }

    /// Moves the next beat up to `now`, but leaves at least 1/16 of an interval after the last beat.
    pub fn hasten(&mut self, now: Time) {
        self.next = self.next.map(|next| next.min(now.max(next - self.interval * 15 / 16)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beats_follow_the_start_at_intervals() {
        let mut heartbeat = Heartbeat::new(Duration::from_nanos(16));
        assert!(heartbeat.expiry().is_none() && !heartbeat.take_due(Time(100)));
        heartbeat.hasten(Time(100));
        assert_eq!(heartbeat.expiry(), None, "a schedule that has not started cannot be hastened");
        heartbeat.start(Time(100));
        heartbeat.start(Time(110));
        assert_eq!(heartbeat.expiry(), Some(Time(116)));
        assert!(!heartbeat.take_due(Time(115)) && heartbeat.take_due(Time(120)));
        assert_eq!(heartbeat.expiry(), Some(Time(136)), "a late beat delays the next one");
    }

    #[test]
    fn hastened_beat_is_due_now_but_not_right_after_the_last() {
        let hastened = |now| {
            let mut heartbeat = Heartbeat::new(Duration::from_nanos(16));
            heartbeat.start(Time(100));
            heartbeat.hasten(Time(now));
            heartbeat.expiry()
        };
        assert_eq!([100, 101, 110, 120].map(hastened), [101, 101, 110, 116].map(|at| Some(Time(at))));
    }
}

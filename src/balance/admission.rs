//! Admission: a node that has started afresh asks the parent to let it in.

use std::time::Duration;

use crate::time::Time;

/// Request to the parent to let the node in, repeated until the parent answers with a band.
#[derive(Debug, Default)]
pub(super) struct Admission {
    /// When the next request is due; `None` while the node needs none.
    next: Option<Time>,
}

impl Admission {
    /// Makes the first request due at `now`.
    pub fn start(&mut self, now: Time) {
        self.next = Some(now);
    }

    /// Ends the requests: the parent has answered.
    pub fn grant(&mut self) {
        self.next = None;
    }

    /// Returns when the next request is due.
    pub fn expiry(&self) -> Option<Time> {
        self.next
    }

    /// Returns whether a request is due at `now`; if so, the next one is due after `pause`.
    pub fn take_due(&mut self, now: Time, pause: Duration) -> bool {
        let is_due = self.next.is_some_and(|next| next <= now);
        if is_due {
            self.next = Some(now + pause);
        }
        is_due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn request_repeats_until_granted() {
        let (mut admission, pause) = (Admission::default(), Duration::from_nanos(10));
        assert!(!admission.take_due(Time(5), pause), "a node of the first hour needs no admission");
        admission.start(Time(5));
        assert_eq!(admission.expiry(), Some(Time(5)));
        assert!(admission.take_due(Time(5), pause) && !admission.take_due(Time(14), pause));
        assert!(admission.take_due(Time(16), pause));
        assert_eq!(admission.expiry(), Some(Time(26)));
        admission.grant();
        assert!(admission.expiry().is_none() && !admission.take_due(Time(30), pause));
    }
}

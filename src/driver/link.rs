//! The network: what a message's way costs.

use std::time::Duration;

use crate::time::Time;

/// A message takes at least this long, so that in the run log every cause lies before its effects.
const LEAST: Duration = Duration::from_nanos(1);

/// A link from one party to another. It is FIFO: no message overtakes an earlier one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Link {
    /// When the last byte sent so far has left the sender.
    free: Time,
    /// When the last message sent so far arrives.
    last: Time,
}

impl Link {
    /// When a message of `bytes`, sent at `at`, arrives: its bytes leave one after the other, after those of earlier
    /// messages, at `bandwidth` bytes a second (`None`: all at once), and the last travels for `latency`.
    pub fn arrival(&mut self, at: Time, bytes: u64, latency: Duration, bandwidth: Option<f64>) -> Time {
        let sending = bandwidth.map_or(0.0, |bandwidth| bytes as f64 / bandwidth);
        self.free = self.free.max(at) + Duration::from_nanos(Time::from_secs(sending).0);
        self.last = (self.free + latency.max(LEAST)).max(self.last);
        self.last
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const MS: Duration = Duration::from_millis(1);

    #[test]
    fn bytes_queue_and_then_travel() {
        let mut link = Link::default();
        let arrivals = [100, 100, 0].map(|bytes| link.arrival(Time::ZERO, bytes, MS, Some(1e5)));
        assert_eq!(arrivals, [2, 3, 3].map(|ms| Time::ZERO + ms * MS));
    }

    proptest! {
        #[test]
        fn no_message_overtakes(
            messages in prop::collection::vec((0u32..1000, 0u64..10_000, 0u64..100), 1..20),
            bandwidth in prop::option::of(1e3..1e9),
        ) {
            let (mut link, mut at, mut last) = (Link::default(), Time::ZERO, Time::ZERO);
            for (later, bytes, latency) in messages {
                at += later * MS;
                let arrival = link.arrival(at, bytes, Duration::from_millis(latency), bandwidth);
                prop_assert!(arrival > at && arrival >= last);
                last = arrival;
            }
        }
    }
}

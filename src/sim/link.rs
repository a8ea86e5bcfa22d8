//! The network: what a message's way costs.

use std::time::Duration;

use crate::time::Time;

/// A message takes at least this long, so that in the run log every cause lies before its effects.
const LEAST: Duration = Duration::from_nanos(1);

/// What bytes queue for: they leave one after the other.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wire {
    /// When the last byte so far has left.
    free: Time,
}

impl Wire {
    /// When the last of `bytes` has left that are there at `at`, after those of earlier messages, at `bandwidth` bytes a
    /// second (`None`: all at once).
    pub fn send(&mut self, at: Time, bytes: u64, bandwidth: Option<f64>) -> Time {
        let sending = bandwidth.map_or(0.0, |bandwidth| bytes as f64 / bandwidth);
        self.free = self.free.max(at) + Duration::from_nanos(Time::from_secs(sending).0);
        self.free
    }
}

/// The way from one party to another. It is FIFO: no message overtakes an earlier one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Link {
    wire: Wire,
    /// When the last message sent so far arrives.
    last: Time,
}

impl Link {
    /// When a message of `bytes` arrives that is sent at `at`: its last byte leaves by the `shared` wire, or by the link's
    /// own, and then travels for `latency`.
    pub fn arrival(
        &mut self,
        at: Time,
        bytes: u64,
        latency: Duration,
        bandwidth: Option<f64>,
        shared: Option<&mut Wire>,
    ) -> Time {
        let left = shared.unwrap_or(&mut self.wire).send(at, bytes, bandwidth);
        self.last = (left + latency.max(LEAST)).max(self.last);
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
        let arrivals = [100, 100, 0].map(|bytes| link.arrival(Time::ZERO, bytes, MS, Some(1e5), None));
        assert_eq!(arrivals, [2, 3, 3].map(|ms| Time::ZERO + ms * MS));
    }

    #[test]
    fn on_a_shared_wire_bytes_queue_behind_those_of_others() {
        let (mut one, mut other, mut wire) = (Link::default(), Link::default(), Wire::default());
        let mut arrival = |link: &mut Link| link.arrival(Time::ZERO, 100, MS, Some(1e5), Some(&mut wire));
        assert_eq!([arrival(&mut one), arrival(&mut other)], [2, 3].map(|ms| Time::ZERO + ms * MS));
    }

    proptest! {
        #[test]
        fn no_message_overtakes(
            messages in prop::collection::vec((0u32..1000, 0u64..10_000, 0u64..100), 1..20),
            bandwidth in prop::option::of(1e3..1e9), shared in any::<bool>(),
        ) {
            let (mut link, mut wire) = (Link::default(), Wire::default());
            let (mut at, mut last) = (Time::ZERO, Time::ZERO);
            for (later, bytes, latency) in messages {
                at += later * MS;
                let latency = Duration::from_millis(latency);
                let arrival = link.arrival(at, bytes, latency, bandwidth, shared.then_some(&mut wire));
                prop_assert!(arrival > at && arrival >= last);
                last = arrival;
            }
        }
    }
}

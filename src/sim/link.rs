//! The network model: when a message arrives that is sent over a link.

use std::collections::VecDeque;
use std::time::Duration;

use crate::time::Time;

/// Shortest travel time of a message, so that in the run log every cause lies before its effects.
const MIN_TRAVEL_TIME: Duration = Duration::from_nanos(1);

/// A wire that all parties share, which carries one message at a time.
///
/// On threads a party may wake late and date its message back to a time after which another party has already used the
/// wire. So the wire keeps its busy times, and an earlier message takes a gap between them.
#[derive(Clone, Debug, Default)]
pub struct Wire {
    /// Start and end of each busy time, in the order of time; no two touch each other.
    busy: VecDeque<(Time, Time)>,
    /// No message may start before this time, since the busy times before it are forgotten.
    closed: Time,
}

/// Busy times that a wire keeps: they last longer than threads are late.
const MAX_BUSY_TIMES: usize = 1024;

impl Wire {
    /// Returns when the wire has sent a message that is ready at `at` and takes `sending` to send.
    fn transmit(&mut self, at: Time, sending: Duration) -> Time {
        let mut start = at.max(self.closed);
        let mut place = self.busy.partition_point(|&(_, end)| end <= start);
        while let Some(&(_, ends)) = self.busy.get(place).filter(|(begins, _)| start + sending > *begins) {
            start = ends;
            place += 1;
        }
        let end = start + sending;
        let follows = place > 0 && self.busy[place - 1].1 == start;
        let precedes = self.busy.get(place).is_some_and(|&(begins, _)| begins == end);
        match (follows, precedes) {
            (true, true) => {
                self.busy[place - 1].1 = self.busy[place].1;
                self.busy.remove(place);
            }
            (true, false) => self.busy[place - 1].1 = end,
            (false, true) => self.busy[place].0 = start,
            (false, false) => self.busy.insert(place, (start, end)),
        }
        if self.busy.len() > MAX_BUSY_TIMES
            && let Some((_, ends)) = self.busy.pop_front()
        {
            self.closed = ends;
        }
        end
    }
}

/// The link from one party to another. It is FIFO: no message overtakes an earlier one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Link {
    /// When the last byte so far has left, if the link has its own wire.
    free: Time,
    /// Arrival of the last message so far.
    last: Time,
}

impl Link {
    /// Sends a message of `bytes` bytes at `at`. Returns its arrival: it leaves over the `shared` wire, or over the
    /// link's own, at `bandwidth` bytes per second (`None`: unlimited), and its last byte travels for `latency`.
    pub fn arrival(
        &mut self,
        at: Time,
        bytes: u64,
        latency: Duration,
        bandwidth: Option<f64>,
        shared: Option<&mut Wire>,
    ) -> Time {
        let sending =
            Duration::from_nanos(bandwidth.map_or(0, |bandwidth| Time::from_secs(bytes as f64 / bandwidth).0));
        let left = match shared {
            Some(wire) => wire.transmit(at, sending),
            None => {
                self.free = self.free.max(at) + sending;
                self.free
            }
        };
        self.last = (left + latency.max(MIN_TRAVEL_TIME)).max(self.last);
        self.last
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const MS: Duration = Duration::from_millis(1);

    #[test]
    fn messages_queue_for_the_bandwidth_and_then_travel() {
        let mut link = Link::default();
        let arrivals = [100, 100, 0].map(|bytes| link.arrival(Time::ZERO, bytes, MS, Some(1e5), None));
        assert_eq!(arrivals, [2, 3, 3].map(|ms| Time::ZERO + ms * MS));
    }

    #[test]
    fn on_a_shared_wire_messages_queue_behind_those_of_others() {
        let (mut one, mut other, mut wire) = (Link::default(), Link::default(), Wire::default());
        let mut arrival = |link: &mut Link| link.arrival(Time::ZERO, 100, MS, Some(1e5), Some(&mut wire));
        assert_eq!([arrival(&mut one), arrival(&mut other)], [2, 3].map(|ms| Time::ZERO + ms * MS));
    }

    #[test]
    fn late_message_takes_a_gap_of_the_wire() {
        let mut wire = Wire::default();
        let mut left = |at: u32, ms: u32| wire.transmit(Time::ZERO + at * MS, ms * MS).0 / 1_000_000;
        assert_eq!([left(10, 2), left(4, 3), left(5, 4), left(8, 2), left(0, 4)], [12, 7, 16, 10, 4]);
        assert_eq!(left(11, 1), 17);
    }

    proptest! {
        /// In any order of sending, no two messages overlap; messages sent in order leave no gaps.
        #[test]
        fn wire_carries_one_message_at_a_time(
            sent in prop::collection::vec((0u32..200, 0u32..10), 1..60), in_order in any::<bool>(),
        ) {
            let mut sent = sent;
            if in_order {
                sent.sort_unstable();
            }
            let (mut wire, mut free) = (Wire::default(), Time::ZERO);
            let mut times = Vec::new();
            for (at, ms) in sent {
                let (at, sending) = (Time::ZERO + at * MS, ms * MS);
                let left = wire.transmit(at, sending);
                prop_assert!(left >= at + sending);
                times.push((left - sending, left));
                free = free.max(at) + sending;
                prop_assert!(!in_order || left == free);
            }
            times.retain(|(start, end)| start < end);
            times.sort_unstable();
            prop_assert!(times.windows(2).all(|pair| pair[0].1 <= pair[1].0));
        }

        #[test]
        fn no_message_overtakes_another(
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

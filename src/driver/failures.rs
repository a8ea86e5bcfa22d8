//! What fails in a run on threads, as far as all parties have to know of it: links that are cut, ways that are held up,
//! and machines that are cut off.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::balance::{NodeId, Party};
use crate::sim::Faults;
use crate::time::Time;

/// What is wrong, until the run is over: nothing fails after that, or is mended.
#[derive(Debug, Default)]
pub(super) struct Failures {
    faults: Mutex<Faults>,
    over: AtomicBool,
}

impl Failures {
    /// Cuts the link between two parties, or mends it. Whether that changes anything.
    pub fn cut_link(&self, one: Party, other: Party, is_cut: bool) -> bool {
        self.change(|faults| faults.cut_link(one, other, is_cut))
    }

    /// Cuts a node off from all others, or no longer. Whether that is still possible.
    pub fn cut_off(&self, node: NodeId, is_cut_off: bool) -> bool {
        self.change(|faults| {
            faults.cut_off(node, is_cut_off);
            true
        })
    }

    /// Whether nothing travels between the two. What a party sends to itself goes no way.
    pub fn is_cut(&self, one: Party, other: Party) -> bool {
        self.lock().is_cut(one, other)
    }

    /// Holds up the way from one party to another from `now` on. Whether that is still possible.
    pub fn delay(&self, from: Party, to: Party, now: Time, by: Duration) -> bool {
        self.change(|faults| {
            faults.delay(from, to, now, now + by);
            true
        })
    }

    /// When a message arrives that would do so at `at`.
    pub fn arrival(&self, from: Party, to: Party, at: Time) -> Time {
        self.lock().arrival(from, to, at)
    }

    /// The parent has nothing more to do: what it says last reaches whoever it reaches now.
    pub fn end(&self) {
        let _faults = self.lock();
        self.over.store(true, Ordering::SeqCst);
    }

    /// Whether [`Failures::end`] was called.
    pub fn is_over(&self) -> bool {
        self.over.load(Ordering::SeqCst)
    }

    fn change(&self, change: impl FnOnce(&mut Faults) -> bool) -> bool {
        let mut faults = self.lock();
        !self.is_over() && change(&mut faults)
    }

    /// No panic leaves it half changed.
    fn lock(&self) -> MutexGuard<'_, Faults> {
        self.faults.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Update;
    use super::super::endpoint::{Endpoint, Incoming};
    use super::super::shared::{Inboxes, Shared};
    use super::*;
    use crate::balance::{Condition, Event, Message, Transition};
    use crate::record::RecordKind;
    use crate::runlog::examples;
    use crossbeam_channel::Receiver;
    use std::sync::Arc;

    const PARENT: Party = Party::Parent;
    const ONE: Party = Party::Node(1);
    const TWO: Party = Party::Node(2);

    #[test]
    fn a_link_is_cut_both_ways_and_a_node_from_all() {
        let losses = Failures::default();
        assert!(losses.cut_link(TWO, PARENT, true) && !losses.cut_link(PARENT, TWO, true), "it is one link");
        let are_cut =
            || [(PARENT, TWO), (TWO, PARENT), (ONE, TWO), (TWO, TWO)].map(|(one, two)| losses.is_cut(one, two));
        assert_eq!(are_cut(), [true, true, false, false]);
        assert!(losses.cut_off(2, true));
        assert_eq!(are_cut(), [true, true, true, false], "nobody is cut off from itself");
        assert!(losses.cut_off(2, false) && losses.cut_link(PARENT, TWO, false));
        assert_eq!(are_cut(), [false; 4]);
    }

    #[test]
    fn what_is_cut_at_the_end_remains_so() {
        let losses = Failures::default();
        losses.cut_off(1, true);
        losses.end();
        assert!(!losses.cut_off(1, false) && !losses.cut_off(2, true) && !losses.cut_link(PARENT, TWO, true));
        assert!(losses.is_over() && losses.is_cut(PARENT, ONE) && !losses.is_cut(PARENT, TWO));
    }
    /// A node's port, and another's that sends it what it is to hear; and what the first tells.
    struct Pair {
        shared: Arc<Shared>,
        hearer: Endpoint,
        sender: Endpoint,
        told: Receiver<Update>,
    }

    impl Pair {
        fn new() -> Self {
            let header = examples::header(&[0.5, 0.5, 0.5]);
            let (shared, Inboxes { mut nodes, .. }) = Shared::new(&header);
            let (updates, told) = crossbeam_channel::unbounded();
            let (unheard, _) = crossbeam_channel::unbounded();
            let sender = Endpoint::new(TWO, &header, &shared, nodes.remove(2), unheard);
            let hearer = Endpoint::new(ONE, &header, &shared, nodes.remove(1), updates);
            Self { shared, hearer, sender, told }
        }

        /// Sends something that is there soon after `at`.
        fn send(&mut self, at: u64) {
            self.sender.advance(Time(at));
            self.sender.send(ONE, Message::Wake, Vec::new());
        }

        /// What happens until `horizon`: messages and the timer, and in the records what was received, and lost.
        fn hear(&mut self, horizon: u64) -> String {
            let mut heard = String::new();
            while let Some(incoming) = self.hearer.next(Time(horizon)) {
                heard.push(match incoming {
                    Incoming::Event(Event::Message { .. }, _) => 'm',
                    Incoming::Event(Event::Timer, _) => 't',
                    _ => '?',
                });
            }
            self.hearer.flush();
            let records = self.told.try_iter().flat_map(|update| match update {
                Update::Records(records) => records,
                _ => Vec::new(),
            });
            heard.extend(records.filter_map(|record| match record.what {
                RecordKind::Received { .. } => Some('R'),
                RecordKind::Lost { .. } => Some('L'),
                _ => None,
            }));
            heard
        }
    }

    #[test]
    fn who_hangs_hears_later() {
        let mut pair = Pair::new();
        pair.hearer.set_timer(Time(150));
        [100, 200].into_iter().for_each(|at| pair.send(at));
        assert_eq!(pair.hearer.set_condition(Condition::Hung), Some(Transition::MemoryKept));
        assert_eq!(pair.hearer.set_condition(Condition::Hung), None);
        assert_eq!(pair.hear(300), "");
        pair.send(400);
        assert_eq!(pair.hearer.set_condition(Condition::Well), Some(Transition::Resumed));
        assert_eq!(pair.hear(500), "mmtmRRR");
    }

    #[test]
    fn who_is_off_never_hears_not_even_of_what_was_there() {
        let mut pair = Pair::new();
        pair.hearer.set_timer(Time(150));
        pair.hearer.set_condition(Condition::Hung);
        pair.send(100);
        assert_eq!(pair.hear(110), "");
        pair.hearer.set_condition(Condition::Off);
        assert_eq!(pair.hear(120), "L");
        pair.send(200);
        assert_eq!(pair.hear(300), "L");
        pair.hearer.set_condition(Condition::Well);
        pair.send(400);
        assert_eq!(pair.hear(500), "mR");
    }

    #[test]
    fn what_is_sent_or_arrives_while_the_way_is_cut_is_lost() {
        let mut pair = Pair::new();
        pair.send(100);
        pair.shared.losses.cut_link(ONE, TWO, true);
        assert_eq!(pair.hear(200), "L", "on its way");
        pair.send(300);
        pair.shared.losses.cut_link(ONE, TWO, false);
        assert_eq!(pair.hear(300), "", "it would not have arrived yet");
        assert_eq!(pair.hear(400), "L", "though the link is whole again");
        pair.hearer.set_condition(Condition::CutOff);
        pair.send(500);
        assert_eq!(pair.hear(600), "L");
        pair.hearer.set_condition(Condition::Well);
        pair.send(700);
        assert_eq!(pair.hear(800), "mR");
    }

    #[test]
    fn what_is_held_up_arrives_later_in_its_order_and_with_what_is_sent_meanwhile() {
        let mut pair = Pair::new();
        pair.send(100);
        pair.shared.losses.delay(TWO, ONE, Time(90), Duration::from_nanos(400));
        pair.send(200);
        assert_eq!(pair.hear(489), "");
        pair.send(480);
        pair.hearer.set_timer(Time(470));
        assert_eq!(pair.hear(600), "tmmmRRR");
        pair.send(700);
        assert_eq!(pair.hear(800), "mR");
    }

    #[test]
    fn whoever_cannot_hear_of_the_end_ends_with_the_run() {
        let ends = |condition: Condition, link: Option<(Party, Party)>| {
            let mut pair = Pair::new();
            pair.hearer.set_condition(condition);
            link.into_iter().for_each(|(one, other)| _ = pair.shared.losses.cut_link(one, other, true));
            let before = pair.hearer.step(|_| {}).is_err();
            pair.shared.finish();
            // It is too late for that.
            pair.hearer.set_condition(Condition::Well);
            (before, pair.hearer.step(|_| {}).is_err())
        };
        assert_eq!(ends(Condition::Well, None), (false, false));
        assert_eq!(ends(Condition::Well, Some((ONE, TWO))), (false, false));
        assert_eq!(ends(Condition::Well, Some((ONE, PARENT))), (false, true));
        for condition in [Condition::Hung, Condition::CutOff, Condition::Off] {
            assert_eq!(ends(condition, None), (false, true), "{condition:?}");
        }
    }
}

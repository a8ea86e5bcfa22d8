//! The network faults of a run on threads, which all parties share: cut links, delays, and machines that are cut off.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::balance::{NodeId, Party};
use crate::sim::Faults;
use crate::time::Time;

/// The present network faults. They stay as they are once the run is over.
#[derive(Debug, Default)]
pub(super) struct Failures {
    faults: Mutex<Faults>,
    over: AtomicBool,
}

impl Failures {
    /// Cuts or restores the link between two parties. Returns whether that changes anything.
    pub fn cut_link(&self, one: Party, other: Party, is_cut: bool) -> bool {
        self.change(|faults| faults.cut_link(one, other, is_cut))
    }

    /// Cuts a node off from all others, or reconnects it. Returns whether the run was still going on.
    pub fn cut_off(&self, node: NodeId, is_cut_off: bool) -> bool {
        self.change(|faults| {
            faults.cut_off(node, is_cut_off);
            true
        })
    }

    /// Returns whether no message can pass between two parties. A party's messages to itself always pass.
    pub fn is_cut(&self, one: Party, other: Party) -> bool {
        self.lock().is_cut(one, other)
    }

    /// Delays the messages from one party to another from `now` on. Returns whether the run was still going on.
    pub fn delay(&self, from: Party, to: Party, now: Time, by: Duration) -> bool {
        self.change(|faults| {
            faults.delay(from, to, now, now + by);
            true
        })
    }

    /// Returns when a message arrives that would arrive at `at` without delays.
    pub fn arrival(&self, from: Party, to: Party, at: Time) -> Time {
        self.lock().arrival(from, to, at)
    }

    /// Marks the run as over: the shutdown reaches the nodes that the parent can reach now.
    pub fn end(&self) {
        let _faults = self.lock();
        self.over.store(true, Ordering::SeqCst);
    }

    /// Returns whether [`Failures::end`] was called.
    pub fn is_over(&self) -> bool {
        self.over.load(Ordering::SeqCst)
    }

    fn change(&self, change: impl FnOnce(&mut Faults) -> bool) -> bool {
        let mut faults = self.lock();
        !self.is_over() && change(&mut faults)
    }

    /// Takes the lock, also after a panic of another thread: no panic leaves the faults half changed.
    fn lock(&self) -> MutexGuard<'_, Faults> {
        self.faults.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Update;
    use super::super::endpoint::{Endpoint, Incoming};
    use super::super::shared::{Inboxes, SharedRun};
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
    fn link_is_cut_in_both_directions_and_node_from_all() {
        let failures = Failures::default();
        assert!(failures.cut_link(TWO, PARENT, true) && !failures.cut_link(PARENT, TWO, true), "it is one link");
        let are_cut =
            || [(PARENT, TWO), (TWO, PARENT), (ONE, TWO), (TWO, TWO)].map(|(one, two)| failures.is_cut(one, two));
        assert_eq!(are_cut(), [true, true, false, false]);
        assert!(failures.cut_off(2, true));
        assert_eq!(are_cut(), [true, true, true, false], "no party is cut off from itself");
        assert!(failures.cut_off(2, false) && failures.cut_link(PARENT, TWO, false));
        assert_eq!(are_cut(), [false; 4]);
    }

    #[test]
    fn faults_at_the_end_of_the_run_stay() {
        let failures = Failures::default();
        failures.cut_off(1, true);
        failures.end();
        assert!(!failures.cut_off(1, false) && !failures.cut_off(2, true) && !failures.cut_link(PARENT, TWO, true));
        assert!(failures.is_over() && failures.is_cut(PARENT, ONE) && !failures.is_cut(PARENT, TWO));
    }

    /// Endpoints of two nodes, one of which sends messages to the other, and the updates of the receiver.
    struct Pair {
        shared: Arc<SharedRun>,
        receiver: Endpoint,
        sender: Endpoint,
        updates_of_receiver: Receiver<Update>,
    }

    impl Pair {
        fn new() -> Self {
            let header = examples::header(&[0.5, 0.5, 0.5]);
            let (shared, Inboxes { mut nodes, .. }) = SharedRun::new(&header);
            let (updates, updates_of_receiver) = crossbeam_channel::unbounded();
            let (ignored, _) = crossbeam_channel::unbounded();
            let sender = Endpoint::new(TWO, &header, &shared, nodes.remove(2), ignored);
            let receiver = Endpoint::new(ONE, &header, &shared, nodes.remove(1), updates);
            Self { shared, receiver, sender, updates_of_receiver }
        }

        /// Sends a message that arrives soon after `at`.
        fn send(&mut self, at: u64) {
            self.sender.advance(Time(at));
            self.sender.send(ONE, Message::Wake, Vec::new());
        }

        /// Returns what happens to the receiver by `horizon`, as letters: `m` for a message, `t` for the timer, then
        /// from the records `R` for received and `L` for lost.
        fn hear(&mut self, horizon: u64) -> String {
            let mut heard = String::new();
            while let Some(incoming) = self.receiver.next(Time(horizon)) {
                heard.push(match incoming {
                    Incoming::Event(Event::Message { .. }, _) => 'm',
                    Incoming::Event(Event::Timer, _) => 't',
                    _ => '?',
                });
            }
            self.receiver.flush();
            let records = self.updates_of_receiver.try_iter().flat_map(|update| match update {
                Update::Records(records) => records,
                _ => Vec::new(),
            });
            heard.extend(records.filter_map(|record| match record.kind {
                RecordKind::Received { .. } => Some('R'),
                RecordKind::Lost { .. } => Some('L'),
                _ => None,
            }));
            heard
        }
    }

    #[test]
    fn hung_machine_gets_its_messages_later() {
        let mut pair = Pair::new();
        pair.receiver.set_timer(Time(150));
        [100, 200].into_iter().for_each(|at| pair.send(at));
        assert_eq!(pair.receiver.set_condition(Condition::Hung), Some(Transition::MemoryKept));
        assert_eq!(pair.receiver.set_condition(Condition::Hung), None);
        assert_eq!(pair.hear(300), "");
        pair.send(400);
        assert_eq!(pair.receiver.set_condition(Condition::Well), Some(Transition::Resumed));
        assert_eq!(pair.hear(500), "mmtmRRR");
    }

    #[test]
    fn machine_that_is_off_loses_all_messages() {
        let mut pair = Pair::new();
        pair.receiver.set_timer(Time(150));
        pair.receiver.set_condition(Condition::Hung);
        pair.send(100);
        assert_eq!(pair.hear(110), "");
        pair.receiver.set_condition(Condition::Off);
        assert_eq!(pair.hear(120), "L");
        pair.send(200);
        assert_eq!(pair.hear(300), "L");
        pair.receiver.set_condition(Condition::Well);
        pair.send(400);
        assert_eq!(pair.hear(500), "mR");
    }

    #[test]
    fn messages_sent_or_arriving_over_a_cut_link_are_lost() {
        let mut pair = Pair::new();
        pair.send(100);
        pair.shared.failures.cut_link(ONE, TWO, true);
        assert_eq!(pair.hear(200), "L", "on its way");
        pair.send(300);
        pair.shared.failures.cut_link(ONE, TWO, false);
        assert_eq!(pair.hear(300), "", "it would not have arrived yet");
        assert_eq!(pair.hear(400), "L", "though the link is whole again");
        pair.receiver.set_condition(Condition::CutOff);
        pair.send(500);
        assert_eq!(pair.hear(600), "L");
        pair.receiver.set_condition(Condition::Well);
        pair.send(700);
        assert_eq!(pair.hear(800), "mR");
    }

    #[test]
    fn delayed_messages_arrive_later_in_order_with_those_sent_meanwhile() {
        let mut pair = Pair::new();
        pair.send(100);
        pair.shared.failures.delay(TWO, ONE, Time(90), Duration::from_nanos(400));
        pair.send(200);
        assert_eq!(pair.hear(489), "");
        pair.send(480);
        pair.receiver.set_timer(Time(470));
        assert_eq!(pair.hear(600), "tmmmRRR");
        pair.send(700);
        assert_eq!(pair.hear(800), "mR");
    }

    #[test]
    fn unreachable_node_ends_with_the_run() {
        let ends = |condition: Condition, link: Option<(Party, Party)>| {
            let mut pair = Pair::new();
            pair.receiver.set_condition(condition);
            link.into_iter().for_each(|(one, other)| _ = pair.shared.failures.cut_link(one, other, true));
            let before = pair.receiver.step(|_| {}).is_err();
            pair.shared.finish();
            // Has no effect: the run is over.
            pair.receiver.set_condition(Condition::Well);
            (before, pair.receiver.step(|_| {}).is_err())
        };
        assert_eq!(ends(Condition::Well, None), (false, false));
        assert_eq!(ends(Condition::Well, Some((ONE, TWO))), (false, false));
        assert_eq!(ends(Condition::Well, Some((ONE, PARENT))), (false, true));
        for condition in [Condition::Hung, Condition::CutOff, Condition::Off] {
            assert_eq!(ends(condition, None), (false, true), "{condition:?}");
        }
    }
}

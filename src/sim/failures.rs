//! Failures in virtual time: machines that hang, are cut off or are off, delayed messages, and the end of a run in
//! which nothing happens any more.

use std::mem;
use std::time::Duration;

use super::event_queue::SimEvent;
use super::simulation::{RecordSink, Sim};
use crate::balance::{Condition, Event, NodeId, Party, Transition};
use crate::cancel::CancelToken;
use crate::record::{Record, RecordKind};

/// Beats without work after which a run counts as stuck, unless an event in the queue may change that.
const STANDSTILL_BEATS: u32 = 400;

impl Sim {
    /// Processes all events. Ends without finishing the picture if the last node with atoms stands still, even if other
    /// nodes keep sending messages.
    pub fn run(&mut self, sink: &mut dyn FnMut(Record)) {
        self.run_unless_cancelled(&CancelToken::default(), sink);
    }

    /// Does the same as [`Sim::run`], but ends early once cancelled.
    pub fn run_unless_cancelled(&mut self, cancel: &CancelToken, sink: &mut dyn FnMut(Record)) {
        // In all other strategies no events are left at a standstill.
        let can_stand_still = self.rules.strategy.survives_losses();
        let mut last_work = self.now;
        while let Some(next) = self.next().filter(|_| !cancel.is_cancelled()) {
            let mut works = false;
            self.advance(next, &mut |record| {
                works |= matches!(record.kind, RecordKind::AtomStarted { .. } | RecordKind::AtomDone { .. });
                sink(record);
            });
            if works {
                last_work = self.now;
            } else if can_stand_still && self.now.since(last_work) > self.rules.beat * STANDSTILL_BEATS {
                let may_change = |event: &SimEvent| match event {
                    SimEvent::Command(_) => true,
                    SimEvent::AtomDone { node, version } => self.nodes[usize::from(*node)].due_version == *version,
                    SimEvent::Arrival { mail, .. } | SimEvent::Handled(mail) => {
                        mail.message.ranges().iter().any(|range| !range.is_empty())
                    }
                    _ => false,
                };
                if !self.events.any(may_change) {
                    return;
                }
                last_work = self.now;
            }
        }
    }

    /// Sets the condition of a node's machine, with the effects of the [`Transition`].
    pub(super) fn set_condition(&mut self, node: NodeId, condition: Condition, sink: RecordSink<'_>) {
        let Some(index) = self.machine(node).filter(|_| !self.finished) else { return };
        let nodes = self.nodes.len() as NodeId;
        let party = &mut self.nodes[index];
        let Some(transition) = party.condition.transition(condition) else { return };
        party.condition = condition;
        party.machine.set_paused(party.paused || condition == Condition::Hung, self.now);
        self.faults.cut_off(node, condition == Condition::CutOff);
        self.record(RecordKind::Condition { node, condition }, sink);
        let party = &mut self.nodes[index];
        match transition {
            Transition::MemoryLost => {
                let lost = mem::take(&mut party.mailbox);
                party.lose_memory(&self.rules, node, nodes, self.now);
                lost.into_iter().for_each(|mail| self.record(RecordKind::Lost { id: mail.id }, sink));
            }
            Transition::FreshStart => self.handle_event(Party::Node(node), Event::Started, sink),
            Transition::Resumed => {
                let mailbox = mem::take(&mut party.mailbox);
                self.resume_worker(node, sink);
                mailbox.into_iter().for_each(|mail| self.receive(Party::Node(node), mail, sink));
                self.fire_timer(node, sink);
            }
            Transition::MemoryKept => self.resume_worker(node, sink),
        }
    }

    /// Delays all messages from one party to another, also those in transit.
    pub(super) fn delay(&mut self, from: Party, to: Party, by: Duration, sink: RecordSink<'_>) {
        let is_missing = |party| matches!(party, Party::Node(node) if self.machine(node).is_none());
        if self.finished || from == to || is_missing(from) || is_missing(to) {
            return;
        }
        let until = self.faults.delay(from, to, self.now, self.now + by);
        let is_on_this_way = |event: &SimEvent| match event {
            SimEvent::Arrival { to: other, mail } => (mail.from, *other) == (from, to),
            _ => false,
        };
        let faults = &self.faults;
        self.events.reschedule(|at| faults.arrival(from, to, at), is_on_this_way);
        self.record(RecordKind::Delayed { from, to, until }, sink);
    }

    /// Ends the parent. Nodes that the shutdown cannot reach end as well: in reality their owners would have to stop
    /// them.
    pub(super) fn end(&mut self) {
        self.finished = true;
        for node in 0..self.nodes.len() as NodeId {
            let is_unreachable = self.faults.is_cut(Party::Parent, Party::Node(node));
            let party = &mut self.nodes[usize::from(node)];
            if is_unreachable || !party.condition.is_running() {
                party.finished = true;
                party.pipe.clear();
                party.due_version = party.due_version.wrapping_add(1);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::Strategy;
    use crate::runlog::{Driver, Header, examples};
    use crate::scenario::Command;
    use crate::time::Time;

    #[test]
    fn delayed_messages_arrive_late_and_in_order_and_those_on_a_cut_link_never() {
        let header = Header { driver: Driver::Sim, ..examples::header(&[1.0, 1.0, 1.0]) };
        let (from, to, at) = (Party::Node(1), Party::Parent, Time(3_000));
        let until = Time::from_secs(0.01);
        let held = vec![(at, Command::Delay { from, to, by: until.since(at) })];
        let cut = vec![(at, Command::Link { one: from, other: to, cut: true })];
        for (script, is_cut) in [(held, false), (cut, true)] {
            let (mut sent, mut came, mut lost) = (Vec::new(), Vec::new(), 0);
            Sim::new(&header, &script, |_| Duration::from_micros(1)).run(&mut |record| match record.kind {
                RecordKind::Sent { id, from: Party::Node(1), to: Party::Parent, arrives, .. } => {
                    assert!(
                        is_cut || record.at <= at || arrives >= until,
                        "the delay is known when the message is sent"
                    );
                    sent.push(id);
                }
                RecordKind::Received { id, by: Party::Parent } if sent.contains(&id) => came.push((record.at, id)),
                RecordKind::Lost { .. } => lost += 1,
                _ => {}
            });
            let late = came.iter().filter(|(when, _)| *when > at).collect::<Vec<_>>();
            if is_cut {
                assert!(late.is_empty() && lost > 0 && lost + came.len() == sent.len(), "{late:?}, {lost} lost");
            } else {
                assert!(!late.is_empty() && late.iter().all(|(when, _)| *when >= until), "{late:?}");
                assert!(came.is_sorted_by_key(|(_, id)| *id) && came.len() == sent.len());
            }
        }
    }

    #[test]
    fn run_ends_when_no_node_will_ever_work_again() {
        let plain = examples::header(&[1.0, 1.0]);
        let mut header = Header { driver: Driver::Sim, ..plain };
        let off = |node| (Time(2_000), Command::Condition { node, condition: Condition::Off });
        let back = (Time::from_secs(100.0), Command::Condition { node: 1, condition: Condition::Well });
        let scripts = [(vec![off(0), off(1)], false), (vec![off(0), off(1), back], true)];
        let strategies = [Strategy::FarmLeases, Strategy::Adaptive];
        for (strategy, (script, ends)) in strategies.iter().flat_map(|of| scripts.iter().map(move |it| (of, it))) {
            header.rules.strategy = strategy.clone();
            let mut sim = Sim::new(&header, script, |_| Duration::from_micros(100));
            sim.run(&mut |_| {});
            assert_eq!(sim.is_finished(), *ends, "{strategy} {script:?}");
        }
    }
}

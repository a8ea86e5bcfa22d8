//! What is lost in a run in virtual time: machines that hang, are cut off or off, links that are cut, and what was on them.

use std::mem;
use std::time::Duration;

use super::event_queue::SimEvent;
use super::simulation::{RecordSink, Sim};
use crate::balance::{Condition, Event, NodeId, Party, Strategy, Transition};
use crate::record::{Record, RecordKind};
use crate::time::Time;

/// After so many beats in which nobody has worked nobody will, unless something is planned that may change it.
const STANDSTILL: u32 = 400;

impl Sim {
    /// Lets everything happen. A run in which the last node that has atoms stands still then is not finished, even where
    /// others go on telling each other so.
    pub fn run(&mut self, tell: &mut dyn FnMut(Record)) {
        // In all other strategies nobody says anything then.
        if self.rules.strategy != Strategy::Adaptive {
            return self.advance(Time(u64::MAX), tell);
        }
        let mut worked = self.now;
        while let Some(next) = self.next() {
            let mut works = false;
            self.advance(next, &mut |record| {
                works |= matches!(record.what, RecordKind::AtomStarted { .. } | RecordKind::AtomDone { .. });
                tell(record);
            });
            if works {
                worked = self.now;
            } else if self.now.since(worked) > self.rules.beat * STANDSTILL {
                let may_change = |happening: &SimEvent| match happening {
                    SimEvent::Command(_) => true,
                    SimEvent::AtomDone { node, plan } => self.nodes[usize::from(*node)].plan == *plan,
                    SimEvent::Arrival { mail, .. } | SimEvent::Handled(mail) => {
                        mail.message.ranges().iter().any(|range| !range.is_empty())
                    }
                    _ => false,
                };
                if !self.future.has(may_change) {
                    return;
                }
                worked = self.now;
            }
        }
    }

    /// Something becomes of a node's machine.
    pub(super) fn set_condition(&mut self, node: NodeId, condition: Condition, tell: RecordSink<'_>) {
        let Some(index) = self.machine(node).filter(|_| !self.finished) else { return };
        let nodes = self.nodes.len() as NodeId;
        let party = &mut self.nodes[index];
        let Some(transition) = party.condition.transition(condition) else { return };
        party.condition = condition;
        party.machine.set_paused(party.paused || condition == Condition::Hung, self.now);
        self.faults.cut_off(node, condition == Condition::CutOff);
        self.note(RecordKind::Condition { node, condition }, tell);
        let party = &mut self.nodes[index];
        match transition {
            Transition::MemoryLost => {
                let unheard = mem::take(&mut party.mailbox);
                party.lose_all(&self.rules, node, nodes, self.now);
                unheard.into_iter().for_each(|mail| self.note(RecordKind::Lost { id: mail.id }, tell));
            }
            Transition::FreshStart => self.hand_over(Party::Node(node), Event::Started, tell),
            Transition::Resumed => {
                let mailbox = mem::take(&mut party.mailbox);
                self.go_on(node, tell);
                mailbox.into_iter().for_each(|mail| self.receive(Party::Node(node), mail, tell));
                self.timer(node, tell);
            }
            Transition::MemoryKept => self.go_on(node, tell),
        }
    }

    /// Holds up the way from one party to another.
    pub(super) fn delay(&mut self, from: Party, to: Party, by: Duration, tell: RecordSink<'_>) {
        let is_missing = |party| matches!(party, Party::Node(node) if self.machine(node).is_none());
        if self.finished || from == to || is_missing(from) || is_missing(to) {
            return;
        }
        let until = self.faults.delay(from, to, self.now, self.now + by);
        let on_this_way = |happening: &SimEvent| match happening {
            SimEvent::Arrival { to: other, mail } => (mail.from, *other) == (from, to),
            _ => false,
        };
        let faults = &self.faults;
        self.future.move_to(|at| faults.arrival(from, to, at), on_this_way);
        self.note(RecordKind::Delayed { from, to, until }, tell);
    }

    /// The parent has nothing more to do. Nodes that its last message cannot reach are abandoned: whoever owns their machines
    /// has to look after them.
    pub(super) fn end(&mut self) {
        self.finished = true;
        for node in 0..self.nodes.len() as NodeId {
            let unheard = self.faults.is_cut(Party::Parent, Party::Node(node));
            let party = &mut self.nodes[usize::from(node)];
            if unheard || !party.condition.is_running() {
                party.finished = true;
                party.pipe.clear();
                party.plan = party.plan.wrapping_add(1);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::runlog::{Driver, Header, examples};
    use crate::scenario::Command;

    #[test]
    fn what_is_held_up_arrives_then_in_its_order_and_what_is_on_a_cut_link_never() {
        let header = Header { driver: Driver::Sim, ..examples::header(&[1.0, 1.0, 1.0]) };
        let (from, to, at) = (Party::Node(1), Party::Parent, Time(3_000));
        let until = Time::from_secs(0.01);
        let held = vec![(at, Command::Delay { from, to, by: until.since(at) })];
        let cut = vec![(at, Command::Link { one: from, other: to, cut: true })];
        for (script, is_cut) in [(held, false), (cut, true)] {
            let (mut sent, mut came, mut lost) = (Vec::new(), Vec::new(), 0);
            Sim::new(&header, &script, |_| Duration::from_micros(1)).run(&mut |record| match record.what {
                RecordKind::Sent { id, from: Party::Node(1), to: Party::Parent, arrives, .. } => {
                    assert!(is_cut || record.at <= at || arrives >= until, "it is known when it is sent");
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
    fn a_run_in_which_nobody_will_ever_work_comes_to_its_end() {
        let plain = examples::header(&[1.0, 1.0]);
        let mut header = Header { driver: Driver::Sim, ..plain };
        header.rules.strategy = Strategy::Adaptive;
        let off = |node| (Time(2_000), Command::Condition { node, condition: Condition::Off });
        let back = (Time::from_secs(100.0), Command::Condition { node: 1, condition: Condition::Well });
        for (script, ends) in [(vec![off(0), off(1)], false), (vec![off(0), off(1), back], true)] {
            let mut sim = Sim::new(&header, &script, |_| Duration::from_micros(100));
            sim.run(&mut |_| {});
            assert_eq!(sim.is_finished(), ends, "{script:?}");
        }
    }
}

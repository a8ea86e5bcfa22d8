//! What is lost in a run in virtual time: machines that hang, are cut off or off, links that are cut, and what was on them.

use std::mem;

use super::event::Happening;
use super::simulation::{Sim, Tell};
use crate::balance::{Condition, Event, NodeId, Party, Strategy};
use crate::record::{Record, What};
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
                works |= matches!(record.what, What::AtomStarted { .. } | What::AtomDone { .. });
                tell(record);
            });
            if works {
                worked = self.now;
            } else if self.now.since(worked) > self.rules.beat * STANDSTILL {
                let may_change = |happening: &Happening| match happening {
                    Happening::Command(_) | Happening::AtomDone { .. } => true,
                    Happening::Arrival { mail, .. } | Happening::Handled(mail) => !mail.message.ranges().is_empty(),
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
    pub(super) fn put(&mut self, node: NodeId, condition: Condition, tell: Tell<'_>) {
        let Some(index) = self.machine(node).filter(|_| !self.finished) else { return };
        let nodes = self.nodes.len() as NodeId;
        let party = &mut self.nodes[index];
        let before = mem::replace(&mut party.condition, condition);
        if before == condition {
            return;
        }
        party.machine.set_paused(party.paused || condition == Condition::Hung, self.now);
        self.cuts.cut_off(node, condition == Condition::CutOff);
        self.note(What::Condition { node, condition }, tell);
        let party = &mut self.nodes[index];
        match (before, condition) {
            (_, Condition::Off) => {
                let unheard = mem::take(&mut party.mailbox);
                party.lose_all(&self.rules, node, nodes, self.now);
                unheard.into_iter().for_each(|mail| self.note(What::Lost { id: mail.id }, tell));
            }
            (Condition::Off, _) => self.hand_over(Party::Node(node), Event::Started, tell),
            (Condition::Hung, _) => {
                let mailbox = mem::take(&mut party.mailbox);
                self.go_on(node, tell);
                mailbox.into_iter().for_each(|mail| self.receive(Party::Node(node), mail, tell));
                self.timer(node, tell);
            }
            _ => self.go_on(node, tell),
        }
    }

    /// The parent has nothing more to do. Nodes that its last message cannot reach are abandoned: whoever owns their machines
    /// has to look after them.
    pub(super) fn end(&mut self) {
        self.finished = true;
        for node in 0..self.nodes.len() as NodeId {
            let unheard = self.cuts.is_cut(Party::Parent, Party::Node(node));
            let party = &mut self.nodes[usize::from(node)];
            if unheard || matches!(party.condition, Condition::Hung | Condition::Off) {
                party.finished = true;
                party.pipe.clear();
                party.plan = party.plan.wrapping_add(1);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::runlog::{Driver, Header, examples};
    use crate::scenario::Command;

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

//! Machines that are made to fail, or well again, or to join, while a run goes on.

use std::time::Duration;

use super::{Phase, Session};
use crate::balance::{Condition, NodeId, Party, Remedy};
use crate::scenario::Command;
use crate::view::{NodeState, Sharing};

impl Session {
    /// How a node's machine is: of a recorded run at the shown moment, else now.
    pub fn condition(&self, node: NodeId) -> Condition {
        self.machine(node).map_or(Condition::Well, |machine| machine.condition)
    }

    /// Whether a node's seat is empty, so that its machine may join.
    pub fn is_spare(&self, node: NodeId) -> bool {
        self.machine(node).is_some_and(|machine| machine.spare)
    }

    /// Whether anything can become of machines: the run goes on, and is no recorded one.
    pub fn can_fail(&self) -> bool {
        !self.is_recorded() && self.stage.phase == Phase::Running && self.sharing() != Sharing::Stealing
    }

    /// Whether losses are mended.
    pub fn mends_losses(&self) -> bool {
        self.header().remedies().has(Remedy::Leases)
    }

    /// Something becomes of a machine.
    pub fn set_condition(&mut self, node: NodeId, condition: Condition) {
        if self.can_fail() {
            self.return_to_present();
            self.stage.performer.command(Command::Condition { node, condition });
        }
    }

    /// What is on its way from one party to another is held up.
    pub fn delay(&mut self, (from, to): (Party, Party), by: Duration) {
        if self.can_fail() {
            self.return_to_present();
            self.stage.performer.command(Command::Delay { from, to, by });
        }
    }

    /// A machine becomes so, or well again if it is so already.
    pub fn toggle_condition(&mut self, node: NodeId, condition: Condition) {
        let is_so = self.condition(node) == condition || self.is_spare(node);
        self.set_condition(node, if is_so { Condition::Well } else { condition });
    }

    fn machine(&self, node: NodeId) -> Option<&NodeState> {
        let state = if self.is_recorded() { self.stage.state() } else { self.stage.latest() };
        state.nodes().get(usize::from(node))
    }

    fn sharing(&self) -> Sharing {
        Sharing::of(self.header())
    }
}

//! Commands that let machines fail, recover or join, and that delay messages.

use std::time::Duration;

use super::{Phase, Session};
use crate::balance::{Condition, NodeId, Party, Remedy, Scheduler};
use crate::scenario::Command;
use crate::view::NodeState;

impl Session {
    /// Returns the condition of a machine: of a recorded run at the shown moment, else now.
    pub fn condition(&self, node: NodeId) -> Condition {
        self.machine(node).map_or(Condition::Well, |machine| machine.condition)
    }

    /// Whether this is a spare machine that has not joined yet.
    pub fn is_spare(&self, node: NodeId) -> bool {
        self.machine(node).is_some_and(|machine| machine.spare)
    }

    /// Whether conditions can be set: in a live run that has not ended, unless rayon shares the work.
    pub fn can_fail(&self) -> bool {
        !self.is_recorded() && self.stage.phase == Phase::Running && self.scheduler() != Scheduler::WorkStealing
    }

    /// Whether the run recovers lost atoms: the adaptive ring with leases, or the farm with leases.
    pub fn mends_losses(&self) -> bool {
        self.header().remedies().has(Remedy::Leases)
    }

    /// Sets a machine's condition, in a run that allows it.
    pub fn set_condition(&mut self, node: NodeId, condition: Condition) {
        if self.can_fail() {
            self.return_to_present();
            self.stage.source.command(Command::Condition { node, condition });
        }
    }

    /// Delays the messages that are on their way between two parties.
    pub fn delay(&mut self, (from, to): (Party, Party), by: Duration) {
        if self.can_fail() {
            self.return_to_present();
            self.stage.source.command(Command::Delay { from, to, by });
        }
    }

    /// Sets a machine's condition, or sets it to well if it has that condition already or is spare.
    pub fn toggle_condition(&mut self, node: NodeId, condition: Condition) {
        let is_so = self.condition(node) == condition || self.is_spare(node);
        self.set_condition(node, if is_so { Condition::Well } else { condition });
    }

    fn machine(&self, node: NodeId) -> Option<&NodeState> {
        let state = if self.is_recorded() { self.stage.state() } else { self.stage.latest() };
        state.nodes().get(usize::from(node))
    }

    fn scheduler(&self) -> Scheduler {
        self.header().scheduler()
    }
}

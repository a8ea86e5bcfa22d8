//! Commands that let machines fail, recover or join, and that delay messages.

use std::time::Duration;

use super::{Phase, Session};
use crate::balance::{Condition, NodeId, Party, Remedy, Scheduler};
use crate::gui::settings::undo::Gesture;
use crate::language::{Language, word};
use crate::scenario::Command;
use crate::view::{NodeState, recovering_scheduler};

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

    /// Sets a machine's condition, in a run that allows it; in another run says why not.
    pub fn set_condition(&mut self, node: NodeId, condition: Condition) {
        if self.can_fail() {
            self.return_to_present();
            self.stage.source.command(Command::Condition { node, condition });
        } else {
            self.note(only_live_words(self.language));
        }
    }

    /// Returns the scheduler that would have recovered, if the live run on the stage hangs for ever after a failure.
    pub fn recovering_scheduler(&self) -> Option<Scheduler> {
        let is_live = !self.is_recorded() && self.stage.phase == Phase::Running;
        is_live.then(|| recovering_scheduler(self.stage.state())).flatten()
    }

    /// Starts the run again with the scheduler that would have recovered.
    pub fn restart_recovering(&mut self) {
        let Some(scheduler) = self.recovering_scheduler() else { return };
        self.change(Gesture::Once, |settings| {
            settings.remedies = settings.remedies.with(Remedy::Leases);
            settings.set_scheduler(scheduler);
        });
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

/// Says in which runs machines can fail.
pub fn only_live_words(language: Language) -> &'static str {
    word!(
        language,
        "Only in a live run that has not ended. Press Restart",
        "Só numa execução ao vivo que não terminou. Pressione Reiniciar"
    )
}

//! A node that traces what it is given and neither asks for more nor takes help: serial and static bands (§6.1).

use super::message::{Action, Event, Message};
use super::work::Work;
use crate::time::Time;

/// A node on its own.
#[derive(Debug)]
pub(super) struct StaticNode {
    pub work: Work,
}

impl StaticNode {
    /// A node with this work, which is none yet.
    pub fn new(work: Work) -> Self {
        Self { work }
    }

    /// Answers `event`, which happens at `now`, by appending to `actions`.
    pub fn handle(&mut self, now: Time, event: Event, actions: &mut Vec<Action>) {
        match event {
            Event::Message { message: Message::Band(band), .. } => self.work.add([band], actions),
            Event::Message { message: Message::Shutdown, .. } => actions.push(Action::Finish),
            Event::AtomDone { atom, .. } => {
                self.work.atom_done(now, atom, actions);
                if self.work.is_idle() {
                    self.work.send_results(actions);
                }
            }
            Event::Timer => self.work.send_results(actions),
            other => unreachable!("a node on its own is never handed {other:?}"),
        }
    }
}

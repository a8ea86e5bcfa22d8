//! A node that traces its band and neither offers nor takes help: serial and static strategies (§6.1).

use super::message::{Action, Event, Message};
use super::work::Work;
use crate::time::Time;

/// A node that works alone.
#[derive(Debug)]
pub(super) struct StaticNode {
    pub work: Work,
}

impl StaticNode {
    /// Creates a node with this work, which has no atoms yet.
    pub fn new(work: Work) -> Self {
        Self { work }
    }

    /// Handles `event` at the time `now` and appends its answer to `actions`.
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
            other => unreachable!("a static node is never handed {other:?}"),
        }
    }
}

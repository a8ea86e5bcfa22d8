//! A node that traces what it is given and neither offers nor takes help.

use super::message::{Action, Event, Message};
use super::work::Work;
use crate::time::Time;

/// A node on its own.
#[derive(Debug, Default)]
pub(super) struct Node {
    work: Work,
}

impl Node {
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
            other => unreachable!("a serial node is never handed {other:?}"),
        }
    }
}

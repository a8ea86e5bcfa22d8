//! What the pointer is on and what is selected, the same in every view.

use crate::balance::NodeId;
use crate::view::Subject;

/// What stands out: a machine, an atom or a message. Views tell what the pointer is on, and show what it was on in the
/// frame before, wherever that was.
#[derive(Clone, Copy, Debug, Default)]
pub struct Selection {
    /// What was clicked.
    pub selected: Option<Subject>,
    hovered: Option<Subject>,
    next: Option<Subject>,
}

impl Selection {
    /// A new frame begins.
    pub fn begin(&mut self) {
        self.hovered = self.next.take();
    }

    /// The pointer is on this.
    pub fn hover(&mut self, about: Subject) {
        self.next = Some(about);
    }

    /// Selects it, or nothing if it was selected.
    pub fn toggle(&mut self, about: Subject) {
        self.selected = if self.selected == Some(about) { None } else { Some(about) };
    }

    /// The selected machine.
    pub fn node(&self) -> Option<NodeId> {
        match self.selected {
            Some(Subject::Node(node)) => Some(node),
            _ => None,
        }
    }

    /// What the pointer was on.
    pub fn hovered(&self) -> Option<Subject> {
        self.hovered
    }
}

//! What the pointer is on and what is selected, the same in every view.

use crate::balance::NodeId;
use crate::view::About;

/// What stands out: a machine, an atom or a message. Views tell what the pointer is on, and show what it was on in the
/// frame before, wherever that was.
#[derive(Clone, Copy, Debug, Default)]
pub struct Focus {
    /// What was clicked.
    pub selected: Option<About>,
    hovered: Option<About>,
    next: Option<About>,
}

impl Focus {
    /// A new frame begins.
    pub fn begin(&mut self) {
        self.hovered = self.next.take();
    }

    /// The pointer is on this.
    pub fn hover(&mut self, about: About) {
        self.next = Some(about);
    }

    /// Selects it, or nothing if it was selected.
    pub fn toggle(&mut self, about: About) {
        self.selected = if self.selected == Some(about) { None } else { Some(about) };
    }

    /// The selected machine.
    pub fn node(&self) -> Option<NodeId> {
        match self.selected {
            Some(About::Node(node)) => Some(node),
            _ => None,
        }
    }

    /// What the pointer was on.
    pub fn hovered(&self) -> Option<About> {
        self.hovered
    }
}

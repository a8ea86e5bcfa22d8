//! The hovered and the selected subject, shared by all views.

use crate::balance::NodeId;
use crate::view::Subject;

/// The hovered and the selected machine, atom or message. Views report what the pointer hovers; all views show it in
/// the next frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct Selection {
    /// The clicked subject.
    pub selected: Option<Subject>,
    hovered: Option<Subject>,
    next: Option<Subject>,
}

impl Selection {
    /// Begins a frame: what was reported in the last frame becomes the hovered subject.
    pub fn begin_frame(&mut self) {
        self.hovered = self.next.take();
    }

    /// Reports that the pointer hovers `subject`.
    pub fn hover(&mut self, subject: Subject) {
        self.next = Some(subject);
    }

    /// Selects `subject`, or deselects it if it was selected.
    pub fn toggle(&mut self, subject: Subject) {
        self.selected = if self.selected == Some(subject) { None } else { Some(subject) };
    }

    /// Returns the selected machine.
    pub fn node(&self) -> Option<NodeId> {
        match self.selected {
            Some(Subject::Node(node)) => Some(node),
            _ => None,
        }
    }

    /// Returns the hovered subject.
    pub fn hovered(&self) -> Option<Subject> {
        self.hovered
    }
}

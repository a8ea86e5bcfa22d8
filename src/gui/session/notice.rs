//! Notices to the user: what was done, or an error with the next step.

/// A notice to the user.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    /// One sentence.
    pub text: String,
    /// Determines how long it stays and its buttons.
    pub kind: NoticeKind,
    /// egui's clock when it appeared, in seconds.
    shown_at: f64,
}

/// Kind of a notice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoticeKind {
    /// Something was done; disappears by itself.
    Note,
    /// An error; stays until it is closed.
    Trouble,
    /// The file of the scene has changed; offers to reload it.
    Changed,
}

impl Notice {
    /// Seconds for which a note is shown.
    const NOTE_S: f64 = 8.0;

    /// Creates a note about something that was done.
    pub fn note(text: impl Into<String>, now: f64) -> Self {
        Self { text: text.into(), kind: NoticeKind::Note, shown_at: now }
    }

    /// Creates an error.
    pub fn trouble(text: impl Into<String>, now: f64) -> Self {
        Self { text: text.into(), kind: NoticeKind::Trouble, shown_at: now }
    }

    /// Creates a notice that the file of the scene has changed.
    pub fn changed(text: impl Into<String>, now: f64) -> Self {
        Self { text: text.into(), kind: NoticeKind::Changed, shown_at: now }
    }

    /// Returns the seconds until it disappears; `None` if it stays until it is closed.
    pub fn remains(&self, now: f64) -> Option<f64> {
        (self.kind == NoticeKind::Note).then(|| (self.shown_at + Self::NOTE_S - now).max(0.0))
    }

    /// Whether it is about the present run only, so that a new run closes it.
    pub fn is_of_the_run(&self) -> bool {
        self.kind != NoticeKind::Changed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_disappear_and_errors_stay() {
        let note = Notice::note("Saved", 10.0);
        assert_eq!([note.remains(10.0), note.remains(15.0), note.remains(99.0)], [Some(8.0), Some(3.0), Some(0.0)]);
        assert_eq!(Notice::trouble("No", 10.0).remains(99.0), None);
    }
}

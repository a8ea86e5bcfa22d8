//! Messages to the user: what was done, what went wrong, what can be done about it.

/// A message to the user.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    /// One sentence.
    pub text: String,
    /// When it goes away, and what can be done about it.
    pub kind: NoticeKind,
    /// When it came, by egui's clock in seconds.
    since: f64,
}

/// What a notice is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoticeKind {
    /// It goes away by itself.
    Note,
    /// It stays until it is closed.
    Trouble,
    /// The scene's file has changed: it can be read again.
    Changed,
}

impl Notice {
    /// For how long a note can be read, in seconds.
    const READ: f64 = 8.0;

    /// Something was done.
    pub fn note(text: impl Into<String>, since: f64) -> Self {
        Self { text: text.into(), kind: NoticeKind::Note, since }
    }

    /// Something cannot be done.
    pub fn trouble(text: impl Into<String>, since: f64) -> Self {
        Self { text: text.into(), kind: NoticeKind::Trouble, since }
    }

    /// The file of the scene has changed.
    pub fn changed(text: impl Into<String>, since: f64) -> Self {
        Self { text: text.into(), kind: NoticeKind::Changed, since }
    }

    /// For how many more seconds it is to be shown; `None` if until it is closed.
    pub fn remains(&self, now: f64) -> Option<f64> {
        (self.kind == NoticeKind::Note).then(|| (self.since + Self::READ - now).max(0.0))
    }

    /// Whether it is about a run that is over when another one begins.
    pub fn is_of_the_run(&self) -> bool {
        self.kind != NoticeKind::Changed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_go_away_and_troubles_stay() {
        let note = Notice::note("Saved", 10.0);
        assert_eq!([note.remains(10.0), note.remains(15.0), note.remains(99.0)], [Some(8.0), Some(3.0), Some(0.0)]);
        assert_eq!(Notice::trouble("No", 10.0).remains(99.0), None);
    }
}

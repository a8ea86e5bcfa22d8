//! Notices to the user: what was done, or an error with the next step.

/// A notice to the user.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    /// One sentence.
    pub text: String,
    /// Determines how long it stays and its buttons.
    pub kind: NoticeKind,
    cause: NoticeCause,
    /// egui's clock when it appeared, in seconds.
    shown_at: f64,
}

/// Kind of a notice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoticeKind {
    /// Something was done; disappears by itself.
    Note,
    /// An error; stays until it is closed or its cause ends.
    Trouble,
    /// A file could not be opened; offers to read it again.
    Unopened,
    /// The file of the scene, or one that could not be opened, has changed; offers to reload it.
    Changed,
}

/// What a notice is about. When that ends, the notice ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoticeCause {
    /// The present run.
    Run,
    /// The open file, or one that could not be opened: ends when a file is opened.
    File,
}

impl Notice {
    /// Seconds for which a note is shown.
    const NOTE_S: f64 = 8.0;

    /// Creates a notice of something that happened at `now` (egui's clock, in seconds).
    pub fn new(text: impl Into<String>, kind: NoticeKind, cause: NoticeCause, now: f64) -> Self {
        Self { text: text.into(), kind, cause, shown_at: now }
    }

    /// Returns the seconds until it disappears; `None` if it stays until it is closed.
    pub fn remains(&self, now: f64) -> Option<f64> {
        (self.kind == NoticeKind::Note).then(|| (self.shown_at + Self::NOTE_S - now).max(0.0))
    }
}

/// The notices that are to be read, one at a time: the last note while it lasts, then the errors in their order.
#[derive(Debug, Default)]
pub struct Notices {
    note: Option<Notice>,
    errors: Vec<Notice>,
}

impl Notices {
    /// Adds a notice. A note takes the place of the one before; an error that is waiting already is not repeated.
    pub fn add(&mut self, notice: Notice) {
        match notice.kind {
            NoticeKind::Note => self.note = Some(notice),
            NoticeKind::Trouble | NoticeKind::Unopened | NoticeKind::Changed => {
                self.errors.retain(|other| other.text != notice.text);
                self.errors.push(notice);
                // What was done before it is old news.
                self.note = None;
            }
        }
    }

    /// Returns the notice to be read now.
    pub fn shown(&self) -> Option<&Notice> {
        self.note.as_ref().or(self.errors.first())
    }

    /// Returns the number of notices that wait behind the shown one.
    pub fn waiting(&self) -> usize {
        (usize::from(self.note.is_some()) + self.errors.len()).saturating_sub(1)
    }

    /// Closes the shown notice.
    pub fn close(&mut self) {
        if self.note.take().is_none() && !self.errors.is_empty() {
            self.errors.remove(0);
        }
    }

    /// Whether a notice of this cause is to be read.
    pub fn has(&self, cause: NoticeCause) -> bool {
        self.note.iter().chain(&self.errors).any(|notice| notice.cause == cause)
    }

    /// Removes the notices whose cause has ended.
    pub fn end(&mut self, cause: NoticeCause) {
        self.note.take_if(|note| note.cause == cause);
        self.errors.retain(|error| error.cause != cause);
    }

    /// Removes the note when its time is over.
    pub fn expire(&mut self, now: f64) {
        self.note.take_if(|note| note.remains(now) == Some(0.0));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn notice(text: &str, kind: NoticeKind, cause: NoticeCause) -> Notice {
        Notice::new(text, kind, cause, 10.0)
    }

    fn shown(notices: &Notices) -> &str {
        notices.shown().map_or("", |notice| &notice.text)
    }

    #[test]
    fn notes_disappear_and_errors_stay() {
        let note = notice("Saved", NoticeKind::Note, NoticeCause::Run);
        assert_eq!([note.remains(10.0), note.remains(15.0), note.remains(99.0)], [Some(8.0), Some(3.0), Some(0.0)]);
        assert_eq!(notice("No", NoticeKind::Trouble, NoticeCause::Run).remains(99.0), None);
    }

    #[test]
    fn errors_wait_for_a_note_and_for_each_other() {
        let mut notices = Notices::default();
        notices.add(notice("full", NoticeKind::Trouble, NoticeCause::Run));
        notices.add(notice("changed", NoticeKind::Changed, NoticeCause::File));
        notices.add(notice("full", NoticeKind::Trouble, NoticeCause::Run));
        notices.add(notice("undone", NoticeKind::Note, NoticeCause::Run));
        assert_eq!((shown(&notices), notices.waiting()), ("undone", 2));
        notices.expire(30.0);
        assert_eq!((shown(&notices), notices.waiting()), ("changed", 1));
        notices.close();
        assert_eq!((shown(&notices), notices.waiting()), ("full", 0));
    }

    #[test]
    fn notice_ends_with_its_cause() {
        let mut notices = Notices::default();
        notices.add(notice("not opened", NoticeKind::Trouble, NoticeCause::File));
        notices.add(notice("no such machine", NoticeKind::Trouble, NoticeCause::Run));
        notices.end(NoticeCause::File);
        assert_eq!((shown(&notices), notices.waiting()), ("no such machine", 0));
        notices.end(NoticeCause::Run);
        assert_eq!(notices.shown(), None);
    }
}

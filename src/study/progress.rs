//! How far a study is.

/// Whoever wants to know how far a study is: steps done, steps in all, and what comes next.
pub type ProgressSink<'a> = &'a mut dyn FnMut(usize, usize, &str);

/// Counts the steps of a study.
pub(super) struct Progress<'a> {
    done: usize,
    steps: usize,
    tell: ProgressSink<'a>,
}

impl<'a> Progress<'a> {
    /// A study of so many steps.
    pub fn new(steps: usize, tell: ProgressSink<'a>) -> Self {
        Self { done: 0, steps, tell }
    }

    /// The next step begins.
    pub fn next(&mut self, what: &str) {
        (self.tell)(self.done, self.steps, what);
        self.done += 1;
    }
}

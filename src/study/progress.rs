//! Progress of a study.

/// Callback for a study's progress: steps done, steps in all, and the name of the next step.
pub type ProgressSink<'a> = &'a mut dyn FnMut(usize, usize, &str);

/// Counts a study's steps and reports them.
pub(super) struct Progress<'a> {
    done: usize,
    steps: usize,
    tell: ProgressSink<'a>,
}

impl<'a> Progress<'a> {
    /// Starts a study of `steps` steps.
    pub fn new(steps: usize, tell: ProgressSink<'a>) -> Self {
        Self { done: 0, steps, tell }
    }

    /// Reports that the next step begins.
    pub fn next(&mut self, what: &str) {
        (self.tell)(self.done, self.steps, what);
        self.done += 1;
    }
}

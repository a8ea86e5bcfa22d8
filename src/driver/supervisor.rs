//! The supervisor of background threads: it waits for their end and reports the outcome.

use std::any::Any;
use std::thread::{self, JoinHandle, Scope, ScopedJoinHandle};

use crossbeam_channel::{Receiver, Sender};

use super::Update;
use super::error::{RunError, ThreadError};

/// A thread that starts other threads, waits for their end, and sends the outcome as the last update.
pub(super) struct Supervisor {
    updates: Receiver<Update>,
    /// `None` if it could not be started.
    thread: Option<JoinHandle<()>>,
}

impl Supervisor {
    /// Runs `work` on a thread of this name. All threads that `work` starts must end before it returns. Its result, or
    /// the failure to start the thread, is the last update.
    pub fn start(name: &str, work: impl FnOnce(&Sender<Update>) -> Result<(), RunError> + Send + 'static) -> Self {
        let (sender, updates) = crossbeam_channel::unbounded();
        let its_sender = sender.clone();
        let supervise = move || {
            let last = work(&its_sender).map_or_else(Update::Failed, |()| Update::Finished);
            // The receiver may be gone.
            let _ = its_sender.send(last);
        };
        let thread = match thread::Builder::new().name(name.into()).spawn(supervise) {
            Ok(thread) => Some(thread),
            Err(source) => {
                let error = ThreadError::NotStarted { name: name.into(), source };
                let _ = sender.send(Update::Failed(error.into()));
                None
            }
        };
        Self { updates, thread }
    }

    /// Returns the updates, oldest first.
    pub fn updates(&self) -> &Receiver<Update> {
        &self.updates
    }

    /// Returns whether all threads have ended, or were never started.
    pub fn has_ended(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// Blocks until all threads have ended. They must have been told to end before.
    pub fn join(&mut self) {
        if let Some(thread) = self.thread.take() {
            // The thread reports the panics of others and does not panic itself.
            let _ = thread.join();
        }
    }
}

/// The threads of a scope. If one panics, or cannot be started, all are stopped.
pub(super) struct Threads<'scope, 'env, Stop> {
    scope: &'scope Scope<'scope, 'env>,
    stop: Stop,
    running: Vec<ScopedJoinHandle<'scope, ()>>,
    outcome: Result<(), ThreadError>,
}

impl<'scope, 'env, Stop: Fn() + Copy + Send + 'scope> Threads<'scope, 'env, Stop> {
    /// Creates an empty group; `stop` tells all threads to end.
    pub fn new(scope: &'scope Scope<'scope, 'env>, stop: Stop) -> Self {
        Self { scope, stop, running: Vec::new(), outcome: Ok(()) }
    }

    /// Starts `work` on a thread of this name, unless an earlier thread could not be started. Returns whether all
    /// could.
    pub fn start(&mut self, name: &str, work: impl FnOnce() + Send + 'scope) -> bool {
        if self.outcome.is_err() {
            return false;
        }
        let guard = StopOnPanic(self.stop);
        let guarded = move || {
            let _guard = guard;
            work();
        };
        match thread::Builder::new().name(name.into()).spawn_scoped(self.scope, guarded) {
            Ok(thread) => self.running.push(thread),
            Err(source) => {
                (self.stop)();
                self.outcome = Err(ThreadError::NotStarted { name: name.into(), source });
            }
        }
        self.outcome.is_ok()
    }

    /// Blocks until all threads have ended.
    ///
    /// # Errors
    /// If a thread could not be started, or else for the first thread that has panicked.
    pub fn join(self) -> Result<(), ThreadError> {
        let mut outcome = self.outcome;
        for thread in self.running {
            let name = thread.thread().name().unwrap_or_default().to_owned();
            if let Err(panic) = thread.join() {
                let message = panic_message(&*panic).to_owned();
                outcome = outcome.and(Err(ThreadError::Panicked { name, message }));
            }
        }
        outcome
    }
}

/// Stops all threads if this one panics, so that none waits for it for ever.
struct StopOnPanic<Stop: Fn()>(Stop);

impl<Stop: Fn()> Drop for StopOnPanic<Stop> {
    fn drop(&mut self) {
        if thread::panicking() {
            (self.0)();
        }
    }
}

/// Returns the message of a panic.
fn panic_message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no reason given")
}

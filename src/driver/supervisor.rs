//! Threads in the background, and one that waits for their end and says how it went.

use std::any::Any;
use std::thread::{self, JoinHandle, Scope, ScopedJoinHandle};

use crossbeam_channel::{Receiver, Sender};

use super::Update;

/// The thread that stands between whoever started a run, or a picture that is traced again, and the threads that do it.
pub(super) struct Supervisor {
    updates: Receiver<Update>,
    /// `None` if it could not be started.
    thread: Option<JoinHandle<()>>,
}

impl Supervisor {
    /// Starts `work` on a thread of this name. All threads that it starts must end before it does. What it returns,
    /// or that it could not be started, is the last update.
    pub fn start(name: &str, work: impl FnOnce(&Sender<Update>) -> Result<(), String> + Send + 'static) -> Self {
        let (sender, updates) = crossbeam_channel::unbounded();
        let teller = sender.clone();
        let supervise = move || {
            let last = work(&teller).map_or_else(Update::Failed, |()| Update::Finished);
            // Nobody may be left to listen.
            let _ = teller.send(last);
        };
        let thread = thread::Builder::new().name(name.into()).spawn(supervise);
        if let Err(error) = &thread {
            let _ = sender.send(Update::Failed(format!("no thread could be started: {error}")));
        }
        Self { updates, thread: thread.ok() }
    }

    /// What has happened since, oldest first.
    pub fn updates(&self) -> &Receiver<Update> {
        &self.updates
    }

    /// Whether all threads have ended, or never began.
    pub fn has_ended(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// Blocks until all threads have ended, which they must have been told to.
    pub fn join(&mut self) {
        if let Some(thread) = self.thread.take() {
            // It reports the panics of the others and has none of its own.
            let _ = thread.join();
        }
    }
}

/// The threads of a scope: if one panics, or cannot be started, all are stopped.
pub(super) struct Threads<'scope, 'env, Stop> {
    scope: &'scope Scope<'scope, 'env>,
    stop: Stop,
    running: Vec<ScopedJoinHandle<'scope, ()>>,
    outcome: Result<(), String>,
}

impl<'scope, 'env, Stop: Fn() + Copy + Send + 'scope> Threads<'scope, 'env, Stop> {
    /// No threads yet; `stop` makes them end.
    pub fn new(scope: &'scope Scope<'scope, 'env>, stop: Stop) -> Self {
        Self { scope, stop, running: Vec::new(), outcome: Ok(()) }
    }

    /// Starts `work` on a thread of this name, unless an earlier one could not be started. Returns whether all could.
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
            Err(error) => {
                (self.stop)();
                self.outcome = Err(format!("the thread of {name} could not be started: {error}"));
            }
        }
        self.outcome.is_ok()
    }

    /// Blocks until all have ended.
    ///
    /// # Errors
    /// A sentence: that a thread could not be started, or what the first that panicked has said.
    pub fn join(self) -> Result<(), String> {
        let mut outcome = self.outcome;
        for thread in self.running {
            let name = thread.thread().name().unwrap_or_default().to_owned();
            if let Err(panic) = thread.join() {
                outcome = outcome.and(Err(format!("{name} failed: {}", said(&*panic))));
            }
        }
        outcome
    }
}

/// So that nobody waits for ever for a thread that has panicked.
struct StopOnPanic<Stop: Fn()>(Stop);

impl<Stop: Fn()> Drop for StopOnPanic<Stop> {
    fn drop(&mut self) {
        if thread::panicking() {
            (self.0)();
        }
    }
}

/// What a panic said.
fn said(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no reason given")
}

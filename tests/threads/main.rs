//! Tests that count the threads of their process. They share a program with each other only, and run one at a time.

#[path = "../common/watched.rs"]
mod watched;

mod ends;
mod many_lives;
mod many_runs;

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Held by the test that runs.
static TURN: Mutex<()> = Mutex::new(());

/// Waits until no other test of this program runs, and keeps the others waiting until the guard is dropped.
fn turn() -> MutexGuard<'static, ()> {
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The names of the threads of this process, without the test harness's own; none where the system does not tell them.
fn threads() -> Vec<String> {
    let tasks = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let main_thread = std::process::id().to_string();
    let others = tasks.filter(|task| task.file_name() != *main_thread);
    let names = others.filter_map(|task| std::fs::read_to_string(task.path().join("comm")).ok());
    let is_test = |name: &str| name.starts_with("ends::") || name.starts_with("many_");
    names.map(|name| name.trim().to_owned()).filter(|name| !is_test(name)).collect()
}

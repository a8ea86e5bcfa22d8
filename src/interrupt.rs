//! Signals that end the process (SIGINT, SIGTERM, SIGHUP): none of them leaves a temporary file behind, and work that
//! can end early keeps its results so far.

use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What the first signal does instead of ending the process.
static REACTION: Mutex<Option<Box<dyn FnOnce() + Send>>> = Mutex::new(None);

/// The exit code of the first signal; 0 until one is caught.
static EXIT_CODE: AtomicU8 = AtomicU8::new(0);

/// Work that ends early on a signal. Once dropped, a signal ends the process at once.
#[derive(Debug)]
pub struct EndsEarly(());

impl EndsEarly {
    /// Calls `react` on the first signal, on a thread of its own; the caller must then come to an end and exit with
    /// [`exit_code`]. A second signal ends the process at once.
    pub fn new(react: impl FnOnce() + Send + 'static) -> Self {
        *reaction() = Some(Box::new(react));
        Self(())
    }
}

impl Drop for EndsEarly {
    fn drop(&mut self) {
        *reaction() = None;
    }
}

/// Returns the exit code of the first signal, 128 plus its number; `None` if none has come.
pub fn exit_code() -> Option<u8> {
    Some(EXIT_CODE.load(Ordering::SeqCst)).filter(|&code| code != 0)
}

/// Begins to handle signals. Call it once, at the start of the process.
#[cfg(unix)]
pub fn handle_signals() {
    use std::thread;

    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level;

    use crate::output::remove_temporary_files;

    let mut handled = vec![SIGINT, SIGTERM];
    // `nohup` lets a process ignore the end of its terminal.
    if !is_ignored(SIGHUP) {
        handled.push(SIGHUP);
    }
    // Without the handler or its thread, a signal ends the process as usual; only a temporary file may stay.
    let Ok(mut signals) = Signals::new(handled) else { return };
    let handle = move || {
        for signal in signals.forever() {
            let code = u8::try_from(128 + signal).unwrap_or(u8::MAX);
            let _ = EXIT_CODE.compare_exchange(0, code, Ordering::SeqCst, Ordering::SeqCst);
            let react = reaction().take();
            match react {
                Some(react) => react(),
                None => {
                    remove_temporary_files();
                    low_level::exit(code.into());
                }
            }
        }
    };
    let _ = thread::Builder::new().name("signals".into()).spawn(handle);
}

/// Begins to handle signals. This system has none.
#[cfg(not(unix))]
pub fn handle_signals() {}

/// Whether the process was started with this signal ignored. Where the system does not tell, it counts as ignored.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_none_or(|mask| mask >> (signal - 1) & 1 == 1)
}

fn reaction() -> MutexGuard<'static, Option<Box<dyn FnOnce() + Send>>> {
    // The value is valid even if a thread has panicked.
    REACTION.lock().unwrap_or_else(PoisonError::into_inner)
}

//! Executes a run to its end and returns its log.

use std::sync::Arc;
use std::time::Duration;

use crossbeam_channel::RecvTimeoutError;

use super::{Run, RunError, Update};
use crate::runlog::{Header, RunLog};
use crate::scenario::Command;
use crate::time::Time;
use crate::tracer::Tracer;

/// Executes the run that `header` describes, with the commands of the script at their times, and returns its log.
///
/// # Errors
/// If the run fails.
pub fn run_to_end(tracer: &Arc<Tracer>, header: &Header, script: &[(Time, Command)]) -> Result<RunLog, RunError> {
    let run = Run::start(Arc::clone(tracer), header);
    // One batch for the log, so that it sorts its end only once.
    let mut records = Vec::new();
    let mut script = script.iter().peekable();
    loop {
        while let Some((_, command)) = script.next_if(|(at, _)| *at <= run.now()) {
            run.command(*command);
        }
        // Without a next command any long time will do.
        let next = script.peek().map_or(Duration::from_secs(3600), |(at, _)| at.since(run.now()));
        match run.updates().recv_timeout(next) {
            Ok(Update::Records(more)) => records.extend(more),
            Ok(Update::Placed { .. } | Update::Rays(_)) | Err(RecvTimeoutError::Timeout) => {}
            Ok(Update::Finished) => break,
            Ok(Update::Failed(why)) => return Err(why),
            Err(RecvTimeoutError::Disconnected) => return Err(RunError::NoResult),
        }
    }
    let mut log = RunLog::new(header.clone());
    log.add(records);
    Ok(log)
}

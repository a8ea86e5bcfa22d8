//! A run from its beginning to its end, for those who want nothing but its log.

use std::sync::Arc;
use std::time::Duration;

use crossbeam_channel::RecvTimeoutError;

use super::{Run, Update};
use crate::runlog::{Header, RunLog};
use crate::scenario::Command;
use crate::time::Time;
use crate::tracer::Tracer;

/// Runs what `header` describes, and does to it what the script says when its times come.
///
/// # Errors
/// A sentence, if the run failed.
pub fn run_to_end(tracer: &Arc<Tracer>, header: &Header, script: &[(Time, Command)]) -> Result<RunLog, String> {
    let run = Run::start(Arc::clone(tracer), header);
    // One batch for the log, which would else sort its end for each party's.
    let mut records = Vec::new();
    let mut script = script.iter().peekable();
    loop {
        while let Some((_, command)) = script.next_if(|(at, _)| *at <= run.now()) {
            run.command(*command);
        }
        // Without a command there is nothing to wake for; an hour is as good as ever.
        let next = script.peek().map_or(Duration::from_secs(3600), |(at, _)| at.since(run.now()));
        match run.updates().recv_timeout(next) {
            Ok(Update::Records(more)) => records.extend(more),
            Ok(Update::Placed { .. } | Update::Rays(_)) | Err(RecvTimeoutError::Timeout) => {}
            Ok(Update::Finished) => break,
            Ok(Update::Failed(why)) => return Err(why),
            Err(RecvTimeoutError::Disconnected) => return Err("the run ended without a result".into()),
        }
    }
    let mut log = RunLog::new(header.clone());
    log.add(records);
    Ok(log)
}

//! Status of a run between events, by strategy: who computes, who is slow, and why the ring cannot help.

mod adaptive_ring;
pub mod deadlock;
mod farm_leases;
pub mod incomplete;
mod phrases;
mod ring;
mod stopped;
mod without_ring;

use crate::balance::{Scheduler, Strategy};
use crate::language::Language;
use crate::view::state::run_state::RunState;
use adaptive_ring::adaptive_ring_status;
use deadlock::deadlock_words;
use farm_leases::farm_leases_status;
use ring::ring_status;
use without_ring::status_without_ring;

/// Describes the status of a run in one sentence.
pub(crate) fn status_sentence(state: &RunState, language: Language) -> String {
    match state.scheduler {
        Scheduler::Protocol(Strategy::Adaptive) => return adaptive_ring_status(state, language),
        Scheduler::Protocol(Strategy::FarmLeases) => return farm_leases_status(state, language),
        _ => {}
    }
    if let Some(words) = deadlock_words(state, language) {
        return words;
    }
    if state.scheduler.is_ring() { ring_status(state, language) } else { status_without_ring(state, language) }
}

#[cfg(test)]
mod tests;

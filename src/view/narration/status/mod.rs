//! How things stand while nothing happens, by strategy.

mod adaptive_ring;
mod deadlock;
pub mod incomplete;
mod phrases;
mod ring;
mod stopped;
mod without_ring;

use crate::language::Language;
use crate::view::state::run_state::RunState;
use adaptive_ring::standing_adaptive;
use deadlock::hangs;
use ring::ring;
use without_ring::without_ring;

/// How things stand.
pub(crate) fn standing(state: &RunState, language: Language) -> String {
    if state.sharing.is_adaptive() {
        return standing_adaptive(state, language);
    }
    if let Some(words) = hangs(state, language) {
        return words;
    }
    if state.sharing.is_ring() { ring(state, language) } else { without_ring(state, language) }
}

#[cfg(test)]
mod tests;

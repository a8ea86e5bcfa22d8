//! How strongly messages are drawn.

use crate::time::Time;
use crate::view::state::flight::Flight;
use crate::view::state::run_state::RunState;

/// Messages of a kind that are drawn with details. People can follow four to six things at a time.
pub(crate) const MAX_DETAILED: usize = 4;
/// Opacity of the other messages.
pub(crate) const HINT_ALPHA: f32 = 0.3;
/// Width of the border of a highlighted message.
pub(crate) const HIGHLIGHT_BORDER_PX: f32 = 3.0;

/// Returns the opacity of a message and its trail, 0 to 1.
pub(crate) fn visibility(state: &RunState, flight: &Flight, now: Time) -> f32 {
    flight.opacity(now) * state.opacity(now)
}

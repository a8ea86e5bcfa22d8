//! Pure functions from records to drawings and texts: no egui, no driver, no clock.
//!
//! The modules in the order of their layers: a module imports only from lower layers (`tests/tidy` checks this).
//!
//! [`RunState`] is a fold over records; everything else looks at it at some time of the run's own clock, so a live
//! run and a loaded one are shown by the same code, forwards and backwards.

// Layer 0: folds over records.
mod state;

// Layer 1: display lists and polylines.
mod draw;

// Layer 2: numbers, names and tooltips.
mod text;

// Layer 3: the time budget of a run, its summary, two runs compared.
mod analysis;

// Layer 4: charts of measurements.
mod charts;

// Layer 5: the picture's pixels and overlays.
mod picture;

// Layer 6: events and the present status in sentences.
mod narration;

// Layer 7: the ring as a display list.
mod ring;

// Layer 8: lanes of machines over time.
mod timeline;

// Layer 9: the shown time and its state.
mod playback;

// Layer 10: the rays and terms of one pixel.
mod inspect;

// Layer 11: drawings on paper.
mod print;

#[cfg(test)]
mod tests;

pub use analysis::compare_runs::{NamedBudget, compare_runs};
pub use analysis::disturbance::{disturbance, disturbance_words};
pub use analysis::summary::{Summary, result_words, summary_figures, work_split_words};
pub use analysis::time_budget::{LastMachine, MachineSeconds, TimeBudget};
pub use charts::axis::{Axis, Scale};
pub use charts::bar_chart::{Bar, BarChart};
pub use charts::line_chart::{CHART_SIZE, LineChart, MIN_CHART_HEIGHT, Series, Style, series_hue};
pub use charts::time_budget_chart::{
    part_names, time_budget_height, time_budget_legend, time_budget_marks, time_budget_words,
};
pub use charts::tradeoff::{Tradeoff, TradeoffDrawing};
pub use draw::display_list::{Anchor, Hue, Ink, Mark, Point, TextSize};
pub use inspect::{ChosenRay, Inspected, RaySpot, RayTree, SpanPlot, Term, Terms};
pub use narration::event_sentences::before_virtual_time;
pub use narration::happening::Happening;
pub use narration::narrator::Narrator;
pub use narration::record_sentences::{record_words, share_words};
pub use narration::status::deadlock::recovering_scheduler;
pub use narration::status::incomplete::unfinished_words;
pub use picture::bands_cost::cheapest_and_costliest;
pub use picture::canvas::Canvas;
pub use picture::false_colour::{RAMP_ERRORS, false_colours, ramp, ramp_position};
pub use picture::outlines::outlines;
pub use picture::overlay::{Layer, picture_pixels};
pub use playback::clock::{Playback, RATES, rate_of_time_words, short_rate_words};
pub use playback::compared_run::{ComparedRun, length_of_all};
pub use playback::details::{Details, Highlight};
pub use playback::run_view::RunView;
pub use playback::snapshots::{Snapshot, SnapshotCache};
pub use print::PrintedDrawing;
pub use ring::corners::{ring_corner_at, ring_corners};
pub use ring::layout::RingLayout;
pub use ring::{RingOverlay, RingSpot, message_at, ring, ring_at};
pub use state::atom_state::AtomState;
pub use state::flight::{Cargo, Flight};
pub use state::lane::{Lane, LanePhase, Traced};
pub use state::lanes::{Lanes, Load, Trip, Usage};
pub use state::node_rows::{NodeRow, NodeShare, node_rows, node_shares};
pub use state::node_state::{Activity, NodeState, Parcels, Slot};
pub use state::run_state::{Arrived, RunState};
pub use text::format::{
    TimeScale, activity_word, bytes_words, count, duration, fraction, node_name, percent, rate_number, rate_words,
    row_words, time_words, two_digits,
};
pub use text::glossary::{Definition, DefinitionGroup};
pub use text::media::note_on_media;
pub use text::quality::{measured_lines, quality_lines, quality_words, times_words};
pub use text::remedies::{remedies_words, remedy_hint, remedy_name, without};
pub use text::scene_stats::{needs_lines, needs_warnings};
pub use text::tooltips::{atom_words, drawing_notes, flight_words, node_words, parent_words};
pub use text::trial_names::{change_words, trial_name};
pub use timeline::conditions::condition_strokes;
pub use timeline::landmarks::{Landmark, StepUnit, Subject, landmarks, step};
pub use timeline::layout::TimelineLayout;
pub use timeline::markers::{Marker, MarkerKind, Markers};
pub use timeline::quads::{Quad, Timeline};
pub use timeline::time_window::TimeWindow;
pub use timeline::{axis, timeline, timeline_at};

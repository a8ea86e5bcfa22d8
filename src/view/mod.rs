//! Pure functions from records to what is drawn: no egui, no driver, no clock.
//!
//! [`RunState`] is a fold over records; everything else looks at it at some time of the run's own clock, so a live
//! run and a loaded one are shown by the same code, forwards and backwards.

mod asking;
mod bars;
mod canvas;
mod chart;
mod display;
mod events;
mod false_colour;
mod flight;
mod flights;
mod hover;
mod inspect;
mod labels;
mod machine;
mod narrator;
mod needs;
mod node;
mod nodes;
mod outcome;
mod place;
mod plan;
mod quality;
mod rate;
mod ring;
#[cfg(test)]
mod sample;
mod scale;
mod seen;
mod sentences;
mod sharing;
mod sheet;
mod standing;
mod state;
mod stroke;
mod tones;
mod tradeoff;
mod traffic;
mod without_ring;
mod words;

pub use bars::{Bar, Bars};
pub use canvas::Canvas;
pub use chart::{CHART_SIZE, Chart, Series, Style, series_hue};
pub use display::{Anchor, Hue, Ink, Mark, Point, TextSize};
pub use false_colour::{ERRORS, false_colours, place_of_error, ramp};
pub use flight::{Cargo, Flight};
pub use hover::{atom_words, flight_words, node_words, parent_words, small_print};
pub use inspect::{Chosen, Inspected, RaySpot, RayTree, Spans, Term, Terms};
pub use narrator::Narrator;
pub use needs::{needs_lines, needs_warnings};
pub use node::{Activity, NodeState, Parcels, Slot};
pub use nodes::{Row, Share, rows, shares};
pub use outcome::{Outcome, figures, parts_words, result_words};
pub use place::Place;
pub use quality::{error_words, measured_lines, quality_lines, quality_words, times_words};
pub use ring::{Overlay, Spot, parcel_at, ring, ring_at};
pub use scale::{Axis, Scale};
pub use sharing::Sharing;
pub use state::{Arrived, RunState};
pub use tones::picture_pixels;
pub use tradeoff::{Drawn, Tradeoff};
pub use words::{activity_word, count, duration, fraction, node_name, percent, rate_words};

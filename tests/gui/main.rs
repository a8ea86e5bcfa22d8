//! The app of the window without a window: drives it by the accessible names of its widgets, and checks the state and
//! the records of the run.

mod accuracy;
mod compare;
mod driving;
mod escape;
mod failing;
mod files;
mod glossary;
mod inspector;
mod layout;
mod learn;
mod legible;
mod nodes;
mod portuguese;
mod quitting;
mod remembering;
mod run;
mod save_sheet;
mod saving;
mod setup;
mod sharing;
mod time;
mod waiting;

//! `anel`: a ring of emulated machines ray-traces one picture together and shares the work; a window shows how.
//!
//! The modules in the order of their layers: a module names only modules on lower layers, and modules on one layer do
//! not know each other (`tests/tidy` checks this). ARCHITECTURE.md describes the flow of data through them.

// Layer 0: terms that all modules use.
pub mod cancel; // a token that cancels work in the background
pub mod font; // the typeface of the window and of drawings
pub mod geometry; // rays, boxes, rotations in degrees
pub mod language; // texts in English and Portuguese
pub mod output; // writes a file as a whole or not at all
pub mod palette; // the colours of nodes, and neutral colours
pub mod parallel; // independent work on several cores
pub mod sentence; // quotes from files in error messages
pub mod time; // nanoseconds since the start of the run

// Layer 1: signals, the picture, and text files.
pub mod interrupt; // what a signal does: no temporary file stays, and work may end early
pub mod picture; // size, division into atoms and bands, frame, PNG
pub mod ron_file; // text files in RON, with errors that name the place

// Layer 2: the protocol and the geometry, independent of each other.
pub mod balance; // the protocol: messages, parent, nodes; no thread, clock, channel or colour
pub mod csg; // primitives, boolean spans along a ray, bounds

// Layer 3: inputs and records of a run.
pub mod record; // the events of a run
pub mod scenario; // commands to a run: speeds, pauses, failures
pub mod scene; // scene, camera, light, material, the scene file, the built-in scenes

// Layer 4: recorded runs, and scenes ready to trace.
pub mod runlog; // a run's header, its file, its metrics
pub mod tracer; // the compiled scene, and the article's equation

// Layer 5: emulated machines and links.
pub mod sim; // machines, links, and whole runs in virtual time

// Layer 6: executing, counting and showing, independent of each other.
pub mod driver; // executes the protocol on threads, as emulated machines on links
pub mod space; // counts the messages if the scene were shared instead of the picture (§5)
pub mod view; // pure functions from records to drawings and texts; no egui

// Layer 7: exported files, and lessons.
pub mod export; // scenes for POV-Ray, drawings, animations, tables of records
pub mod lesson; // text files with runs, steps, questions and claims

// Layer 8: results of many runs.
pub mod study; // many runs, for example the article's figures: tables, charts, reports

// Layer 9: the window.
pub mod gui; // paints what `view` returns, and turns clicks into commands

// Layer 10: the command line.
pub mod cli; // arguments, and commands without a window

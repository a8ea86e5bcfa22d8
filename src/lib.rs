//! `anel`: a ring of machines ray-traces one picture together, and everyone sees why the work balances itself.
//!
//! The map, in floor order: a module names only modules on lower floors, and modules on one floor do not
//! know each other (`tests/tidy.rs` holds this). ARCHITECTURE.md tells the way of the data through them.

// Floor 0: words that everything else is made of.
pub mod cancel; // a flag that tells work in the background to end
pub mod font; // the typeface of the window and of drawings
pub mod geometry; // rays, boxes, rotations in degrees
pub mod language; // English or Portuguese, beside each other
pub mod output; // files that are either whole or not there
pub mod palette; // the nodes' colours, and what is not coloured
pub mod sentence; // a file's words, where a sentence repeats them
pub mod time; // nanoseconds since the run began

// Floor 1: what is shared out.
pub mod picture; // size, division into atoms and bands, frame, PNG
pub mod ron_file; // text files that people write, and errors that say where

// Floor 2: the two hard problems, each without knowledge of the other.
pub mod balance; // how atoms are shared: messages, parent, ring, serial; no thread, clock, channel or colour
pub mod csg; // primitives, boolean spans along a ray, bounds

// Floor 3: what goes in, and what comes out.
pub mod record; // what can happen in a run
pub mod scenario; // what is done to a run while it goes on
pub mod scene; // scene, camera, light, material, the scene file, the built-in scenes

// Floor 4: made of what lies below.
pub mod runlog; // a run's header, its file, its metrics
pub mod tracer; // a scene compiled to what it needs, and the article's equation

// Floor 5: machines and links as they are emulated.
pub mod sim; // machines, links, and whole runs in virtual time

// Floor 6: ends that never name each other.
pub mod driver; // executes the protocol on threads, as emulated machines on links
pub mod space; // the scene shared instead of the picture (§5): counted, not built
pub mod view; // pure functions from records to what is drawn; no egui

// Floor 7: what leaves the program, and what is taught with it.
pub mod export; // scenes for POV-Ray, drawings, films, tables of records
pub mod lesson; // what is taught: text files with runs, steps, questions and claims

// Floor 8: what many runs say.
pub mod study; // the article's figures and claims, scaling: CSV, charts, reports

// Floor 9: what the user sees.
pub mod gui; // the window: paints what `view` returns

// Floor 10: what the user types.
pub mod cli; // arguments, the headless commands

//! The program without a window: studies, lessons, and runs where no window can be opened.

mod headless;
#[cfg(unix)]
mod interrupts;
mod lessons;
mod studies;

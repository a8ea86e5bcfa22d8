//! The program without a window: studies, lessons, and runs where no window can be opened.

mod headless;
mod lessons;
mod studies;

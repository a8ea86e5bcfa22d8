//! The window: paints what `view` returns, and hands clicks to the run.
//!
//! The modules in the order of their layers: a module imports only from lower layers (`tests/tidy` checks this).

// Layer 0: what the user sets.
mod settings;

// Layer 1: runs and background jobs.
mod session;

// Layer 2: buttons, sliders, icons, colours.
mod widgets;

// Layer 3: keys, menus, selection.
mod input;

// Layer 4: the panels around a run.
mod panels;

// Layer 5: the pages that take the place of the run.
mod pages;

// Layer 6: the arrangement of panels and pages.
mod app;

use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

pub use app::App;
pub use session::opening::Opening;
pub use session::{Phase, Session, Stage};
pub use settings::Settings;
pub use settings::pace::Pace;
pub use settings::speed_preset::SpeedPreset;

use crate::language::Language;

/// What the window opens with.
#[derive(Clone, Debug, Default)]
pub struct Launch {
    /// The scene or the recorded run; what was open last if `None`.
    pub opening: Option<Opening>,
    /// Where each run's records are written when it ends or the window closes.
    pub log: Option<PathBuf>,
    /// What is spoken until the user chooses otherwise.
    pub language: Language,
}

/// The smallest window in which everything has its place, in points.
const LEAST: [f32; 2] = [800.0, 500.0];

/// Opens the window and returns when it is closed.
///
/// # Errors
/// A sentence that says why no window could be opened; the caller may then go on without one.
pub fn open(launch: Launch) -> Result<(), String> {
    let viewport = egui::ViewportBuilder::default()
        .with_title("anel")
        .with_app_id("anel")
        .with_inner_size([1280.0, 800.0])
        .with_min_inner_size(LEAST);
    let window_builder: Option<eframe::WindowBuilderHook> = Some(Box::new(not_too_small));
    let options = eframe::NativeOptions { viewport, renderer: RENDERER, window_builder, ..Default::default() };
    // A missing library makes the windowing crates panic. That is no fault of this program: it is told in one
    // sentence. Once the window is there, panics are reported as usual.
    let usual = Arc::new(Mutex::new(Some(panic::take_hook())));
    let restore = {
        let usual = Arc::clone(&usual);
        move || {
            let hook = usual.lock().unwrap_or_else(PoisonError::into_inner).take();
            hook.into_iter().for_each(panic::set_hook);
        }
    };
    panic::set_hook(Box::new(|_| {}));
    let (created, restore_once_created) = (Arc::new(AtomicBool::new(false)), restore.clone());
    let is_created = Arc::clone(&created);
    let ended = panic::catch_unwind(AssertUnwindSafe(|| {
        let create: eframe::AppCreator<'_> = Box::new(move |creation| {
            created.store(true, Ordering::Relaxed);
            restore_once_created();
            Ok(Box::new(App::new(&creation.egui_ctx, creation.storage, launch)))
        });
        eframe::run_native("anel", options, create)
    }));
    restore();
    match ended {
        Ok(Ok(())) => Ok(()),
        Ok(Err(error)) => Err(reason(&error)),
        Err(panic) if is_created.load(Ordering::Relaxed) => panic::resume_unwind(panic),
        Err(panic) => {
            let said = panic.downcast_ref::<&str>().map(|said| (*said).to_owned());
            let said = said.or_else(|| panic.downcast_ref::<String>().cloned());
            Err(without_place(&said.unwrap_or_else(|| "no reason given".into())))
        }
    }
}

/// A window opens with the size that it had last; a size in which nothing could be seen must not come back.
fn not_too_small(viewport: egui::ViewportBuilder) -> egui::ViewportBuilder {
    match viewport.inner_size {
        Some(size) => viewport.with_inner_size(size.max(LEAST.into())),
        None => viewport,
    }
}

/// Why there is no window, in a few words.
fn reason(error: &eframe::Error) -> String {
    let said = error.to_string();
    // What follows are the properties that were asked for, a screenful.
    match said.split_once("matching the template") {
        Some(_) => "OpenGL is missing or does not work".into(),
        None => without_place(&said),
    }
}

/// What an error says without the place in some crate's source where it arose: `… at FILE.rs:LINE: WHAT`.
fn without_place(said: &str) -> String {
    let after = said.rsplit_once(".rs:").and_then(|(_, rest)| rest.split_once(": "));
    let what = after.map_or(said, |(_, what)| what);
    what.lines().map(str::trim).collect::<Vec<_>>().join(" ").trim_end_matches('.').to_owned()
}

#[cfg(feature = "glow")]
const RENDERER: eframe::Renderer = eframe::Renderer::Glow;
#[cfg(not(feature = "glow"))]
const RENDERER: eframe::Renderer = eframe::Renderer::Wgpu;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_absurd_size_does_not_come_back() {
        let opened = |size: [f32; 2]| not_too_small(egui::ViewportBuilder::default().with_inner_size(size)).inner_size;
        assert_eq!(opened([64.0, 64.0]), Some(LEAST.into()));
        assert_eq!(opened([64.0, 700.0]), Some(egui::vec2(LEAST[0], 700.0)));
        assert_eq!(opened([1300.0, 900.0]), Some(egui::vec2(1300.0, 900.0)));
    }

    #[test]
    fn errors_are_told_without_their_place_in_a_crate() {
        let said = "winit EventLoopError: os error at /a/b-0.1/src/mod.rs:788: Failed to open connection to X server";
        assert_eq!(without_place(said), "Failed to open connection to X server");
        assert_eq!(
            without_place("library libxkbcommon-x11.so could not be loaded."),
            "library libxkbcommon-x11.so could not be loaded"
        );
    }
}

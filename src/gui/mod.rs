//! The window: paints what `view` returns, and hands clicks to the run.

mod app;
mod demonstration;
mod nodes_panel;
mod paint;
mod picture_panel;
mod places;
mod ring_panel;
mod save_bar;
mod session;
mod theme;
mod top_bar;
mod widgets;
mod words_panel;

use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use crate::scene::Opened;

pub use app::App;
pub use demonstration::demonstration;
pub use session::{Phase, Session};

/// What the window opens with.
#[derive(Clone, Debug)]
pub struct Launch {
    /// The scene.
    pub scene: Opened,
    /// Where each run's records are written when it ends or the window closes.
    pub log: Option<PathBuf>,
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// A sentence that says why no window could be opened; the caller may then go on without one.
pub fn open(launch: Launch) -> Result<(), String> {
    let viewport = egui::ViewportBuilder::default()
        .with_title("anel")
        .with_app_id("anel")
        .with_inner_size([1280.0, 800.0])
        .with_min_inner_size([640.0, 400.0]);
    let options = eframe::NativeOptions { viewport, renderer: RENDERER, ..Default::default() };
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
    let created = restore.clone();
    let ended = panic::catch_unwind(AssertUnwindSafe(|| {
        let create: eframe::AppCreator<'_> = Box::new(move |creation| {
            created();
            Ok(Box::new(App::new(&creation.egui_ctx, &launch)))
        });
        eframe::run_native("anel", options, create)
    }));
    restore();
    let why = match ended {
        Ok(Ok(())) => return Ok(()),
        Ok(Err(error)) => error.to_string(),
        Err(reason) => {
            let said = reason.downcast_ref::<&str>().map(|said| (*said).to_owned());
            said.or_else(|| reason.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no reason given".into())
        }
    };
    Err(without_place(&why))
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
    fn errors_are_told_without_their_place_in_a_crate() {
        let said = "winit EventLoopError: os error at /a/b-0.1/src/mod.rs:788: Failed to open connection to X server";
        assert_eq!(without_place(said), "Failed to open connection to X server");
        assert_eq!(
            without_place("library libxkbcommon-x11.so could not be loaded."),
            "library libxkbcommon-x11.so could not be loaded"
        );
    }
}

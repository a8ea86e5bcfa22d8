//! The window: paints the drawings of `view` and sends the user's commands to the run.
//!
//! The modules in the order of their layers: a module imports only from lower layers (`tests/tidy` checks this).

// Layer 0: the settings, their history, and the header of a run made from them.
mod settings;

// Layer 1: the run on the stage and the background jobs; the only module with threads and clocks.
mod session;

// Layer 2: buttons, sliders, fonts, colours, and the painter of display lists.
mod widgets;

// Layer 3: keys, context menus, selection.
mod input;

// Layer 4: the parts of the main page: picture, ring, machines, timeline, bars.
mod panels;

// Layer 5: the pages that replace the main page.
mod pages;

// Layer 6: the arrangement of panels and pages, and the state kept between two windows.
mod app;

use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

pub use app::{App, Closable, Launch};
pub use session::opening::Opening;
pub use session::{Phase, Session, Stage};
pub use settings::Settings;
pub use settings::pace::Pace;
pub use settings::speed_preset::SpeedPreset;

/// Smallest size of the window in which the layout works, in points.
const MIN_WINDOW_SIZE_PT: [f32; 2] = [800.0, 500.0];

/// Opens the window and returns when it is closed.
///
/// # Errors
/// A sentence with the reason why no window could be opened. The caller can go on without a window.
pub fn open(launch: Launch) -> Result<(), String> {
    let viewport = egui::ViewportBuilder::default()
        .with_title("anel")
        .with_app_id("anel")
        .with_inner_size([1280.0, 800.0])
        .with_min_inner_size(MIN_WINDOW_SIZE_PT)
        .with_icon(icon());
    let window_builder: Option<eframe::WindowBuilderHook> = Some(Box::new(with_min_size));
    let options = eframe::NativeOptions { viewport, renderer: RENDERER, window_builder, ..Default::default() };
    // The windowing crates panic if a library is missing. That is no bug of this program, so it becomes an error of one
    // sentence. As soon as the window exists, the usual panic hook is restored.
    let usual_hook = Arc::new(Mutex::new(Some(panic::take_hook())));
    let restore = {
        let usual_hook = Arc::clone(&usual_hook);
        move || {
            let hook = usual_hook.lock().unwrap_or_else(PoisonError::into_inner).take();
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
            let mut app = App::new(&creation.egui_ctx, creation.storage, launch);
            app.close_on_signal(&creation.egui_ctx);
            Ok(Box::new(app))
        });
        eframe::run_native("anel", options, create)
    }));
    restore();
    match ended {
        Ok(Ok(())) => Ok(()),
        Ok(Err(error)) => Err(reason(&error)),
        Err(panic) if is_created.load(Ordering::Relaxed) => panic::resume_unwind(panic),
        Err(panic) => {
            let message = panic.downcast_ref::<&str>().map(|message| (*message).to_owned());
            let message = message.or_else(|| panic.downcast_ref::<String>().cloned());
            Err(without_location(&message.unwrap_or_else(|| "no reason given".into())))
        }
    }
}

/// Raises the remembered size of the window to the minimum, so that a tiny window does not come back at the next start.
fn with_min_size(viewport: egui::ViewportBuilder) -> egui::ViewportBuilder {
    match viewport.inner_size {
        Some(size) => viewport.with_inner_size(size.max(MIN_WINDOW_SIZE_PT.into())),
        None => viewport,
    }
}

/// Decodes the window's icon; an icon without pixels, which windowing systems ignore, if it is not PNG.
fn icon() -> egui::IconData {
    eframe::icon_data::from_png_bytes(include_bytes!("../../assets/icon.png")).unwrap_or_default()
}

/// Shortens eframe's error to a few words.
fn reason(error: &eframe::Error) -> String {
    let message = error.to_string();
    // The rest of this message lists the requested properties, a whole screen of them.
    match message.split_once("matching the template") {
        Some(_) => "OpenGL is missing or does not work".into(),
        None => without_location(&message),
    }
}

/// Drops the source location from an error message of the form `… at FILE.rs:LINE: MESSAGE`.
fn without_location(message: &str) -> String {
    let after = message.rsplit_once(".rs:").and_then(|(_, rest)| rest.split_once(": "));
    let message = after.map_or(message, |(_, message)| message);
    message.lines().map(str::trim).collect::<Vec<_>>().join(" ").trim_end_matches('.').to_owned()
}

#[cfg(feature = "glow")]
const RENDERER: eframe::Renderer = eframe::Renderer::Glow;
#[cfg(not(feature = "glow"))]
const RENDERER: eframe::Renderer = eframe::Renderer::Wgpu;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn window_has_icon() {
        assert_eq!((icon().width, icon().height), (256, 256));
    }

    #[test]
    fn remembered_size_below_minimum_is_raised() {
        let opened = |size: [f32; 2]| with_min_size(egui::ViewportBuilder::default().with_inner_size(size)).inner_size;
        assert_eq!(opened([64.0, 64.0]), Some(MIN_WINDOW_SIZE_PT.into()));
        assert_eq!(opened([64.0, 700.0]), Some(egui::vec2(MIN_WINDOW_SIZE_PT[0], 700.0)));
        assert_eq!(opened([1300.0, 900.0]), Some(egui::vec2(1300.0, 900.0)));
    }

    #[test]
    fn error_message_loses_its_source_location() {
        let message =
            "winit EventLoopError: os error at /a/b-0.1/src/mod.rs:788: Failed to open connection to X server";
        assert_eq!(without_location(message), "Failed to open connection to X server");
        assert_eq!(
            without_location("library libxkbcommon-x11.so could not be loaded."),
            "library libxkbcommon-x11.so could not be loaded"
        );
    }
}

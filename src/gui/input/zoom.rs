//! Zoom of the whole window with the keys of browsers, within limits that keep the window usable.

use egui::Context;
use egui::gui_zoom::kb_shortcuts::{ZOOM_IN, ZOOM_IN_SECONDARY, ZOOM_OUT, ZOOM_RESET};

const MIN_ZOOM: f32 = 0.6;
const MAX_ZOOM: f32 = 2.0;

/// Disables egui's own zoom keys, which have wider limits, and clamps a restored zoom.
pub fn install(ctx: &Context) {
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
    let zoom = ctx.zoom_factor();
    ctx.set_zoom_factor(if zoom.is_finite() { zoom.clamp(MIN_ZOOM, MAX_ZOOM) } else { 1.0 });
}

/// Handles the zoom keys.
pub fn keys(ctx: &Context) {
    let pressed = |shortcut| ctx.input_mut(|input| input.consume_shortcut(&shortcut));
    let zoom = ctx.zoom_factor();
    let wanted = if pressed(ZOOM_RESET) {
        1.0
    } else if pressed(ZOOM_IN) || pressed(ZOOM_IN_SECONDARY) {
        zoom + 0.1
    } else if pressed(ZOOM_OUT) {
        zoom - 0.1
    } else {
        return;
    };
    // Rounded to tenths, so that the steps lead back to 1.
    ctx.set_zoom_factor(((wanted * 10.0).round() / 10.0).clamp(MIN_ZOOM, MAX_ZOOM));
}

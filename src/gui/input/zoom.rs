//! Larger and smaller with the keys that browsers have for it, within limits that leave the window usable.

use egui::Context;
use egui::gui_zoom::kb_shortcuts::{ZOOM_IN, ZOOM_IN_SECONDARY, ZOOM_OUT, ZOOM_RESET};

const LEAST: f32 = 0.6;
const MOST: f32 = 2.0;

/// Takes the keys from egui, which goes further, and brings a remembered factor within the limits.
pub fn install(ctx: &Context) {
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
    let zoom = ctx.zoom_factor();
    ctx.set_zoom_factor(if zoom.is_finite() { zoom.clamp(LEAST, MOST) } else { 1.0 });
}

/// Obeys the keys.
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
    // Whole tenths, or the steps would not lead back to 1.
    ctx.set_zoom_factor(((wanted * 10.0).round() / 10.0).clamp(LEAST, MOST));
}

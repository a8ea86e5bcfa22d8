//! Zoom of the whole window: chosen with the keys of browsers, and on top of that larger in a large window and on a
//! projector.

use egui::gui_zoom::kb_shortcuts::{ZOOM_IN, ZOOM_IN_SECONDARY, ZOOM_OUT, ZOOM_RESET};
use egui::{Context, Id, Vec2, vec2};

const MIN_ZOOM: f32 = 0.6;
const MAX_ZOOM: f32 = 2.0;

/// Up to this size of the window its content has its usual size.
const USUAL_SIZE_PT: Vec2 = vec2(1280.0, 800.0);
/// Most that the content grows with the window.
const MAX_GROWTH: f32 = 1.5;
/// Zoom of presentation mode.
const PROJECTOR_ZOOM: f32 = 1.5;

/// Disables egui's own zoom keys, which have wider limits.
pub fn install(ctx: &Context) {
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
}

/// Handles the zoom keys, and sets the zoom that follows from the user's choice, the window's size and presentation
/// mode.
pub fn update(ctx: &Context, is_projector: bool) {
    let pressed = |shortcut| ctx.input_mut(|input| input.consume_shortcut(&shortcut));
    let before = chosen(ctx);
    let wanted = if pressed(ZOOM_RESET) {
        1.0
    } else if pressed(ZOOM_IN) || pressed(ZOOM_IN_SECONDARY) {
        before + 0.1
    } else if pressed(ZOOM_OUT) {
        before - 0.1
    } else {
        before
    };
    // Rounded to tenths, so that the steps lead back to 1.
    let chosen = ((wanted * 10.0).round() / 10.0).clamp(MIN_ZOOM, MAX_ZOOM);
    if chosen != before {
        ctx.data_mut(|data| data.insert_persisted(chosen_id(), chosen));
    }
    let zoom = chosen * growth(ctx) * if is_projector { PROJECTOR_ZOOM } else { 1.0 };
    if (zoom - ctx.zoom_factor()).abs() > 1e-3 {
        ctx.set_zoom_factor(zoom);
    }
}

/// Returns how far the content grows with the window, in steps of a tenth: each size of a text takes room in the font
/// atlas.
fn growth(ctx: &Context) -> f32 {
    // `Context::zoom_factor` may be that of the next frame already; these two are of this frame.
    let scale = ctx.pixels_per_point() / ctx.native_pixels_per_point().unwrap_or(1.0);
    let share = (ctx.content_rect().size() * scale / USUAL_SIZE_PT).min_elem();
    ((share * 10.0 + 0.01).floor() / 10.0).clamp(1.0, MAX_GROWTH)
}

/// Returns the zoom that the user has chosen.
fn chosen(ctx: &Context) -> f32 {
    let chosen = ctx.data_mut(|data| data.get_persisted(chosen_id()));
    chosen.filter(|chosen| (MIN_ZOOM..=MAX_ZOOM).contains(chosen)).unwrap_or(1.0)
}

fn chosen_id() -> Id {
    Id::unique("zoom of the user")
}

//! Zoom of the whole window: it grows with a large window, and with the keys of browsers, within limits that keep the
//! window usable.

use egui::gui_zoom::kb_shortcuts::{ZOOM_IN, ZOOM_IN_SECONDARY, ZOOM_OUT, ZOOM_RESET};
use egui::{Context, Id, Vec2, vec2};

const MIN_ZOOM: f32 = 0.6;
const MAX_ZOOM: f32 = 2.0;

/// Up to this size of the window its content has its usual size.
const USUAL_SIZE_PT: Vec2 = vec2(1280.0, 800.0);
/// Most that the content grows with the window.
const MAX_GROWTH: f32 = 1.5;

/// Disables egui's own zoom keys, which have wider limits, and clamps a restored zoom.
pub fn install(ctx: &Context) {
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
    let zoom = ctx.zoom_factor();
    ctx.set_zoom_factor(if zoom.is_finite() { zoom.clamp(MIN_ZOOM, MAX_ZOOM) } else { 1.0 });
}

/// Lets the content grow with the window, in steps of a tenth: each size of a text takes room in the font atlas. A
/// projector's window has its own zoom.
pub fn follow_window(ctx: &Context, is_projector: bool) {
    let zoom = ctx.zoom_factor();
    let size = ctx.content_rect().size() * zoom;
    let share = (size / USUAL_SIZE_PT).min_elem();
    let growth = if is_projector { 1.0 } else { ((share * 10.0 + 0.01).floor() / 10.0).clamp(1.0, MAX_GROWTH) };
    let before = growth_so_far(ctx);
    if growth != before {
        ctx.data_mut(|data| data.insert_persisted(growth_id(), growth));
        ctx.set_zoom_factor((zoom / before * growth).clamp(MIN_ZOOM, MAX_ZOOM));
    }
}

/// Returns how far the content has grown with the window.
fn growth_so_far(ctx: &Context) -> f32 {
    let growth = ctx.data_mut(|data| data.get_persisted(growth_id()));
    growth.filter(|growth| (1.0..=MAX_GROWTH).contains(growth)).unwrap_or(1.0)
}

fn growth_id() -> Id {
    Id::unique("growth of the content")
}

/// Handles the zoom keys.
pub fn keys(ctx: &Context) {
    let pressed = |shortcut| ctx.input_mut(|input| input.consume_shortcut(&shortcut));
    let zoom = ctx.zoom_factor();
    let wanted = if pressed(ZOOM_RESET) {
        growth_so_far(ctx)
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

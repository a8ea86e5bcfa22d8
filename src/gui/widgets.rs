//! The few widgets of the window: a button with an icon, a slim slider.

use egui::{
    Color32, Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke, TextStyle, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::theme::{GRID, Look};

/// What a button shows before its words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    /// Go on.
    Play,
    /// Stand still.
    Pause,
    /// From the beginning.
    Restart,
    /// Into a file.
    Save,
    /// Dark or light.
    Contrast,
}

/// What a painted view is called, and what there is to be seen in it, for those who cannot see it.
pub fn describe(response: &Response, name: &str, seen: impl Fn() -> String) {
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(Role::Image, true, name);
        info.current_text_value = Some(seen());
        info
    });
}

/// A quiet button; `primary` for the one to press first. `name` is its accessible name, and its words if `words`.
pub fn button(ui: &mut Ui, icon: Option<Icon>, name: &str, words: bool, primary: bool) -> Response {
    let look = Look::of(ui.ctx());
    let text_font = TextStyle::Button.resolve(ui.style());
    let galley = words.then(|| ui.painter().layout_no_wrap(name.to_owned(), text_font, Color32::PLACEHOLDER));
    let icon_side = 2.0 * GRID;
    let text_width = galley.as_ref().map_or(0.0, |galley| galley.size().x);
    let icon_width = if icon.is_some() { icon_side } else { 0.0 };
    let gap = if words && icon.is_some() { GRID } else { 0.0 };
    let size = vec2(icon_width + gap + text_width + 3.0 * GRID, 4.0 * GRID);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), name));
    if ui.is_rect_visible(rect) {
        let (fill, text) = match (primary, response.hovered() || response.is_pointer_button_down_on()) {
            (true, false) => (look.accent, look.on_accent),
            (true, true) => (look.accent.gamma_multiply(0.85), look.on_accent),
            (false, false) => (look.raised, look.text),
            (false, true) => (look.hairline, look.text),
        };
        ui.painter().rect_filled(rect, 6.0, fill);
        focus_ring(ui, &response, rect, look);
        let mut left = rect.left() + 1.5 * GRID;
        if let Some(icon) = icon {
            let place = Rect::from_center_size(pos2(left + icon_side / 2.0, rect.center().y), Vec2::splat(icon_side));
            paint_icon(ui.painter(), icon, place, text);
            left = place.right() + GRID;
        }
        if let Some(galley) = galley {
            ui.painter().galley(pos2(left, rect.center().y - galley.size().y / 2.0), galley, text);
        }
    }
    response
}

/// A slim slider from 0 to 100 in steps of 1, its filled part in `colour`. `name` is its accessible name.
pub fn slider(ui: &mut Ui, percent: &mut f64, width: f32, colour: Color32, name: &str) -> Response {
    ui.scope(|ui| {
        let look = Look::of(ui.ctx());
        ui.spacing_mut().slider_width = width;
        ui.spacing_mut().interact_size.y = 2.5 * GRID;
        let visuals = ui.visuals_mut();
        visuals.selection.bg_fill = colour;
        for state in [&mut visuals.widgets.inactive, &mut visuals.widgets.hovered, &mut visuals.widgets.active] {
            state.bg_fill = look.hairline;
            state.fg_stroke = Stroke::NONE;
        }
        let slider = egui::Slider::new(percent, 0.0..=100.0).step_by(1.0).show_value(false);
        let response = ui.add(slider);
        // Without words beside it the slider has no name of its own.
        response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), *percent, name));
        // Over egui's handle, which has the rail's colour while nobody touches it.
        let radius = response.rect.height() / 2.5;
        let left = response.rect.left() + radius;
        let x = left + (response.rect.width() - 2.0 * radius) * (*percent as f32 / 100.0);
        let handle = pos2(x, response.rect.center().y);
        let grown = if response.hovered() || response.dragged() { 9.0 } else { 8.0 };
        ui.painter().circle(handle, grown, colour, Stroke::new(2.0, look.text));
        if response.has_focus() {
            ui.painter().circle_stroke(handle, grown + 3.0, Stroke::new(1.5, look.accent));
        }
        response
    })
    .inner
}

fn focus_ring(ui: &Ui, response: &Response, rect: Rect, look: Look) {
    if response.has_focus() {
        let stroke = Stroke::new(1.5, look.accent);
        ui.painter().rect_stroke(rect.expand(2.0), 8.0, stroke, egui::StrokeKind::Outside);
    }
}

fn paint_icon(painter: &Painter, icon: Icon, rect: Rect, colour: Color32) {
    let at = |x: f32, y: f32| -> Pos2 { rect.lerp_inside(vec2(x, y)) };
    let stroke = Stroke::new(1.75, colour);
    match icon {
        Icon::Play => {
            let corners = vec![at(0.22, 0.1), at(0.9, 0.5), at(0.22, 0.9)];
            painter.add(Shape::convex_polygon(corners, colour, Stroke::NONE));
        }
        Icon::Pause => {
            for left in [0.18, 0.6] {
                painter.rect_filled(Rect::from_min_max(at(left, 0.12), at(left + 0.22, 0.88)), 1.0, colour);
            }
        }
        Icon::Restart => {
            let turn = |i: i32| {
                let angle = 0.4 + i as f32 * 0.27;
                at(0.5 + 0.38 * angle.cos(), 0.5 + 0.38 * angle.sin())
            };
            painter.line((0..=19).map(turn).collect(), stroke);
            let tip = turn(19);
            let corners = vec![tip + vec2(-5.0, -1.0), tip + vec2(2.5, -5.0), tip + vec2(2.5, 3.0)];
            painter.add(Shape::convex_polygon(corners, colour, Stroke::NONE));
        }
        Icon::Save => {
            painter.line(vec![at(0.5, 0.08), at(0.5, 0.62)], stroke);
            painter.line(vec![at(0.25, 0.4), at(0.5, 0.66), at(0.75, 0.4)], stroke);
            painter.line(vec![at(0.1, 0.66), at(0.1, 0.92), at(0.9, 0.92), at(0.9, 0.66)], stroke);
        }
        Icon::Contrast => {
            painter.circle_stroke(rect.center(), rect.width() * 0.4, stroke);
            let half = |i: i32| {
                let angle = std::f32::consts::PI * (i as f32 / 12.0 - 0.5);
                at(0.5 + 0.4 * angle.cos(), 0.5 + 0.4 * angle.sin())
            };
            painter.add(Shape::convex_polygon((0..=12).map(half).collect(), colour, Stroke::NONE));
        }
    }
}

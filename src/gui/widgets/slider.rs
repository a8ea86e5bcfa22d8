//! A slim slider.

use egui::{Color32, Event, MouseWheelUnit, Response, Stroke, Ui, UiBuilder, WidgetInfo, pos2};

use super::steady::steady_id;
use super::theme::{GRID, Look};

/// Scale of a slider.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// Any number from a minimum to a maximum.
    Linear(f64, f64),
    /// Whole numbers from a minimum to a maximum.
    Whole(f64, f64),
    /// Whole per cents from 0 to 100, logarithmic: 1, 2, 5, 10, 20, 50 and 100 are about as far apart. The left end
    /// is 0.
    Percent,
}

impl Scale {
    /// Value of the logarithmic scale just right of its left end, which is 0.
    const LEAST_PERCENT: f64 = 0.4;

    /// Values that the logarithmic scale marks with ticks.
    const TICKS_PERCENT: [f64; 3] = [1.0, 10.0, 100.0];

    fn ends(self) -> (f64, f64) {
        match self {
            Self::Linear(min, max) | Self::Whole(min, max) => (min, max),
            Self::Percent => (0.0, 100.0),
        }
    }

    /// Returns the position of a value, from 0 at the left to 1.
    fn position(self, value: f64) -> f32 {
        let (min, max) = self.ends();
        let share = match self {
            Self::Percent if value <= 0.0 => 0.0,
            Self::Percent => (value / Self::LEAST_PERCENT).ln() / (max / Self::LEAST_PERCENT).ln(),
            Self::Linear(..) | Self::Whole(..) => (value - min) / (max - min),
        };
        share.clamp(0.0, 1.0) as f32
    }
}

/// Returns by how many notches the wheel was turned up over a widget; negative if it was turned down.
pub fn wheel_steps(ui: &Ui, widget: &Response) -> i32 {
    let notches = |event: &Event| match event {
        Event::MouseWheel { unit: MouseWheelUnit::Line, delta, modifiers, .. } if !modifiers.any() => {
            delta.y.round() as i32
        }
        _ => 0,
    };
    if widget.hovered() { ui.input(|input| input.events.iter().map(notches).sum()) } else { 0 }
}

/// Shows a slider with its filled part in `colour`. `name` is its accessible name.
pub fn slider(ui: &mut Ui, value: &mut f64, scale: Scale, width: f32, colour: Color32, name: &str) -> Response {
    let steady = UiBuilder::new().scope_id(steady_id(ui, name));
    ui.scope_builder(steady, |ui| {
        let look = Look::of(ui.ctx());
        ui.spacing_mut().slider_width = width;
        ui.spacing_mut().interact_size.y = ui.available_height().min(2.5 * GRID);
        let visuals = ui.visuals_mut();
        visuals.selection.bg_fill = colour;
        for state in [&mut visuals.widgets.inactive, &mut visuals.widgets.hovered, &mut visuals.widgets.active] {
            state.bg_fill = look.hairline;
            state.fg_stroke = Stroke::NONE;
        }
        let (min, max) = scale.ends();
        let step = if matches!(scale, Scale::Linear(..)) { 0.0 } else { 1.0 };
        let slider = egui::Slider::new(value, min..=max).step_by(step).show_value(false);
        let slider = slider.logarithmic(scale == Scale::Percent).smallest_positive(Scale::LEAST_PERCENT);
        let response = ui.add(slider);
        // egui names a slider only by a text beside it.
        response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), *value, name));
        // Covers egui's handle, which has the colour of the rail.
        let radius = response.rect.height() / 2.5;
        let left = response.rect.left() + radius;
        let x = left + (response.rect.width() - 2.0 * radius) * scale.position(*value);
        let handle = pos2(x, response.rect.center().y);
        if scale == Scale::Percent {
            for tick in Scale::TICKS_PERCENT {
                let x = left + (response.rect.width() - 2.0 * radius) * scale.position(tick);
                let below = handle.y + 4.0..=handle.y + 7.0;
                ui.painter().vline(x, below, Stroke::new(1.0, look.quiet));
            }
        }
        let handle_radius = if response.hovered() || response.dragged() { radius + 1.0 } else { radius };
        let line = if ui.is_enabled() { look.text } else { look.quiet };
        ui.painter().circle(handle, handle_radius, colour, Stroke::new(2.0, line));
        if response.has_focus() {
            ui.painter().circle_stroke(handle, handle_radius + 3.0, Stroke::new(1.5, look.accent));
        }
        response
    })
    .inner
}

//! Playback rate: slower, a menu of all rates, faster.

use egui::{Popup, PopupCloseBehavior, Response, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::keys::UserCommand;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::steady;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, hint_above, popup_frame};
use crate::language::{Language, say, word};
use crate::view::{RATES, rate_of_time_words, short_rate_words};

/// Shows the three buttons. Returns the command of the pressed one.
pub fn show(ui: &mut Ui, rate: f64, language: Language) -> Option<UserCommand> {
    let (mut pressed, look) = (None, Look::of(ui.ctx()));
    let slower = button(ui, Some(Icon::Slower), word!(language, "Slower", "Mais lento"), false, Emphasis::Quiet);
    if hint_above(slower, word!(language, "Slower time (,)", "Tempo mais lento (,)")).clicked() {
        pressed = Some(UserCommand::Rate(false));
    }
    let (rect, response) = steady::allocate_size(ui, vec2(11.5 * GRID, 4.0 * GRID), "rate", Sense::click());
    let rate_text = rate_of_time_words(rate, language);
    let name = say!(language, "Time goes {rate_text}", "O tempo passa {rate_text}");
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    let colour = look.text;
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 6.0, look.raised);
    }
    let galley = ui.painter().layout_no_wrap(short_rate_words(rate, language), theme::regular(theme::SMALL), colour);
    ui.painter().galley(rect.center() - galley.size() / 2.0, galley, colour);
    pressed = pressed.or(rates(&response, rate, look, language));
    let hint = say!(language, "{name}. Press to choose another rate", "{name}. Pressione para escolher outro ritmo");
    hint_above(response, &hint);
    let faster = button(ui, Some(Icon::Faster), word!(language, "Faster", "Mais rápido"), false, Emphasis::Quiet);
    if hint_above(faster, word!(language, "Faster time (.)", "Tempo mais rápido (.)")).clicked() {
        pressed = Some(UserCommand::Rate(true));
    }
    pressed
}

/// Shows the menu of all rates, from the slowest to the fastest.
fn rates(opener: &Response, current: f64, look: Look, language: Language) -> Option<UserCommand> {
    let popup = Popup::from_toggle_button_response(opener).frame(popup_frame(&opener.ctx));
    let shown = popup.close_behavior(PopupCloseBehavior::CloseOnClick).show(|ui| {
        ui.set_width(20.0 * GRID);
        ui.spacing_mut().item_spacing.y = GRID / 4.0;
        let mut chosen = None;
        for (index, rate) in RATES.into_iter().enumerate() {
            let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 2.75 * GRID), Sense::click());
            response.widget_info(|| {
                WidgetInfo::selected(Role::Button, true, rate == current, rate_of_time_words(rate, language))
            });
            if response.hovered() || response.has_focus() || rate == current {
                ui.painter().rect_filled(rect, 6.0, look.raised);
            }
            let galley = ui.painter().layout_no_wrap(
                rate_of_time_words(rate, language),
                theme::regular(theme::SMALL),
                look.text,
            );
            ui.painter().galley(pos2(rect.left() + GRID, rect.center().y - galley.size().y / 2.0), galley, look.text);
            if response.clicked() {
                chosen = Some(UserCommand::SetRate(index));
            }
        }
        chosen
    });
    shown.and_then(|shown| shown.inner)
}

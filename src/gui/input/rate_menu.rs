//! How fast time goes, wherever that can be chosen.

use egui::{Popup, PopupCloseBehavior, Response, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::keys::UserCommand;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, popup_frame};
use crate::language::{Language, say, word};
use crate::view::{RATES, rate_of_time_words, short_rate_words};

/// Shows it: slower, the rate with a list of all, faster. Returns what was pressed.
pub fn show(ui: &mut Ui, rate: f64, language: Language) -> Option<UserCommand> {
    let (mut pressed, look) = (None, Look::of(ui.ctx()));
    let slower = button(ui, Some(Icon::Slower), word!(language, "Slower", "Mais devagar"), false, Emphasis::Quiet);
    if slower.on_hover_text(word!(language, "Time goes slower (,)", "O tempo passa mais devagar (,)")).clicked() {
        pressed = Some(UserCommand::Rate(false));
    }
    let (rect, response) = ui.allocate_exact_size(vec2(11.5 * GRID, 4.0 * GRID), Sense::click());
    let how = rate_of_time_words(rate, language);
    let goes = say!(language, "Time goes {how}", "O tempo passa {how}");
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &goes));
    let colour = look.text;
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 6.0, look.raised);
    }
    let words = ui.painter().layout_no_wrap(short_rate_words(rate, language), theme::regular(theme::SMALL), colour);
    ui.painter().galley(rect.center() - words.size() / 2.0, words, colour);
    pressed = pressed.or(rates(&response, rate, look, language));
    response.on_hover_text(say!(language, "{goes}; press for others", "{goes}; pressionar para outros ritmos"));
    let faster = button(ui, Some(Icon::Faster), word!(language, "Faster", "Mais depressa"), false, Emphasis::Quiet);
    if faster.on_hover_text(word!(language, "Time goes faster (.)", "O tempo passa mais depressa (.)")).clicked() {
        pressed = Some(UserCommand::Rate(true));
    }
    pressed
}

/// All rates, from the slowest to the fastest.
fn rates(opener: &Response, now: f64, look: Look, language: Language) -> Option<UserCommand> {
    let popup = Popup::from_toggle_button_response(opener).frame(popup_frame(&opener.ctx));
    let shown = popup.close_behavior(PopupCloseBehavior::CloseOnClick).show(|ui| {
        ui.set_width(20.0 * GRID);
        ui.spacing_mut().item_spacing.y = GRID / 4.0;
        let mut chosen = None;
        for (index, rate) in RATES.into_iter().enumerate() {
            let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 2.75 * GRID), Sense::click());
            response.widget_info(|| {
                WidgetInfo::selected(Role::Button, true, rate == now, rate_of_time_words(rate, language))
            });
            if response.hovered() || response.has_focus() || rate == now {
                ui.painter().rect_filled(rect, 6.0, look.raised);
            }
            let words = ui.painter().layout_no_wrap(
                rate_of_time_words(rate, language),
                theme::regular(theme::SMALL),
                look.text,
            );
            ui.painter().galley(pos2(rect.left() + GRID, rect.center().y - words.size().y / 2.0), words, look.text);
            if response.clicked() {
                chosen = Some(UserCommand::SetRate(index));
            }
        }
        chosen
    });
    shown.and_then(|shown| shown.inner)
}

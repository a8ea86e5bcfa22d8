//! Captions that explain themselves: a tooltip above or beside them shows the definition of the glossary.

use egui::{Rect, RectAlign, Response, RichText, Role, Sense, Tooltip, Ui, WidgetInfo};

use super::theme::{self, GRID, Look};
use crate::language::Language;
use crate::view::Definition;

/// Shows a definition when the pointer rests on a widget, and does not cover the widget.
pub fn explained(response: Response, definition: Definition, language: Language) -> Response {
    // egui keeps a tooltip open while the pointer is in its widget's rectangle, even if a page covers the widget.
    if response.contains_pointer() {
        let mut tooltip = Tooltip::for_enabled(&response).width(44.0 * GRID);
        tooltip.popup = tooltip.popup.align(RectAlign::TOP_START);
        tooltip.show(|ui| show(ui, definition, language));
    }
    response
}

/// Makes a painted caption in `rect` explain itself. `salt` tells it from others with this definition.
pub fn explain_at(ui: &Ui, (rect, salt): (Rect, i32), definition: Definition, language: Language) {
    let name = definition.name(language);
    let id = ui.scope_id().with(("caption", definition.name(Language::English), salt));
    let response = ui.interact(rect, id, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, name));
    explained(response, definition, language);
}

/// Shows the word in bold and its meaning below.
fn show(ui: &mut Ui, definition: Definition, language: Language) {
    let look = Look::of(ui.ctx());
    ui.set_max_width(44.0 * GRID);
    ui.spacing_mut().item_spacing.y = 2.0;
    ui.label(RichText::new(definition.name(language)).font(theme::strong(theme::SMALL)).color(look.text));
    ui.label(RichText::new(definition.text(language)).font(theme::regular(theme::SMALL)).color(look.text));
}

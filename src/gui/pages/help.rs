//! The Keys page.

use egui::{Align2, Color32, Frame, Id, Modal, Pos2, Rect, RichText, Sense, StrokeKind, Ui, vec2};

use crate::gui::input::keys::KEY_TABLE;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button};
use crate::language::{Language, word};

/// Shows the page over everything else. Returns whether it is closed.
pub fn show(ctx: &egui::Context, language: Language) -> bool {
    let look = Look::of(ctx);
    let frame = Frame::NONE.fill(look.ground).inner_margin(3.0 * GRID).corner_radius(10.0);
    let frame = frame.stroke(egui::Stroke::new(1.0, look.hairline));
    let modal = Modal::new(Id::unique("keys")).frame(frame).backdrop_color(Color32::from_black_alpha(150));
    let shown = modal.show(ctx, |ui| {
        let closed = ui
            .horizontal(|ui| {
                let title = word!(language, "Keys", "Teclas");
                ui.label(RichText::new(title).font(theme::strong(theme::LARGE)).color(look.text));
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    button(ui, Some(Icon::Close), word!(language, "Close help", "Fechar ajuda"), false, Emphasis::Quiet)
                        .clicked()
                })
                .inner
            })
            .inner;
        ui.add_space(GRID);
        let columns = if ctx.content_rect().width() > 960.0 { 2 } else { 1 };
        let lines = KEY_TABLE.len().div_ceil(columns);
        let height = (ctx.content_rect().height() - 20.0 * GRID).max(10.0 * GRID);
        egui::ScrollArea::vertical()
            .max_height(height)
            .min_scrolled_height(height)
            .show(ui, |ui| table(ui, columns, lines, look, language));
        closed
    });
    shown.should_close() || shown.inner
}

/// Paints the table of keys in columns.
fn table(ui: &mut Ui, columns: usize, lines: usize, look: Look, language: Language) {
    const COLUMN_WIDTH_PT: f32 = 58.0 * GRID;
    const LINE_HEIGHT_PT: f32 = 3.5 * GRID;
    let size = vec2(COLUMN_WIDTH_PT * columns as f32, LINE_HEIGHT_PT * lines as f32);
    let (area, response) = ui.allocate_exact_size(size, Sense::hover());
    let name = word!(language, "What the keys do", "O que fazem as teclas");
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, name));
    for (i, row) in KEY_TABLE.iter().enumerate() {
        let corner = area.min + vec2((i / lines) as f32 * COLUMN_WIDTH_PT, (i % lines) as f32 * LINE_HEIGHT_PT);
        let middle = corner.y + LINE_HEIGHT_PT / 2.0;
        let font = theme::strong(theme::SMALL);
        let galley = ui.painter().layout_no_wrap(row.keys_text(language).to_owned(), font, look.text);
        let cap = Rect::from_min_size(
            Pos2::new(corner.x, middle - 1.5 * GRID),
            vec2(galley.size().x + 2.0 * GRID, 3.0 * GRID),
        );
        ui.painter().rect(cap, 5.0, look.raised, egui::Stroke::new(1.0, look.hairline), StrokeKind::Inside);
        ui.painter().galley(cap.center() - galley.size() / 2.0, galley, look.text);
        let left = Pos2::new(corner.x + 12.0 * GRID, middle);
        ui.painter().text(left, Align2::LEFT_CENTER, row.effect(language), theme::regular(theme::BODY), look.text);
    }
}

//! The Help page: the list of keys, and the list of words.

use egui::text::{LayoutJob, TextFormat};
use egui::{
    Align, Align2, Color32, Frame, Id, Label, Layout, Modal, Pos2, Rect, RichText, ScrollArea, Sense, StrokeKind, Ui,
    vec2,
};

use crate::gui::input::keys::KEY_TABLE;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, choice_buttons};
use crate::language::{Language, word};
use crate::view::{Definition, DefinitionGroup};

/// Width of a column, in points.
const COLUMN_WIDTH_PT: f32 = 58.0 * GRID;

/// A tab of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HelpTab {
    /// What the keys do.
    Keys,
    /// What the words of the window mean.
    Words,
}

/// Shows the page over everything else. Returns whether it is closed.
pub fn show(ctx: &egui::Context, tab: &mut HelpTab, language: Language) -> bool {
    let look = Look::of(ctx);
    let frame = Frame::NONE.fill(look.ground).inner_margin(3.0 * GRID).corner_radius(10.0);
    let frame = frame.stroke(egui::Stroke::new(1.0, look.hairline));
    let modal = Modal::new(Id::unique("help")).frame(frame).backdrop_color(Color32::from_black_alpha(150));
    let shown = modal.show(ctx, |ui| {
        let closed = ui
            .horizontal(|ui| {
                let tabs = [
                    (HelpTab::Keys, word!(language, "Keys", "Teclas"), "F1"),
                    (HelpTab::Words, word!(language, "Words", "Palavras"), "W"),
                ];
                *tab = choice_buttons(ui, *tab, &tabs).unwrap_or(*tab);
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    button(ui, Some(Icon::Close), word!(language, "Close help", "Fechar ajuda"), false, Emphasis::Quiet)
                        .clicked()
                })
                .inner
            })
            .inner;
        ui.add_space(GRID);
        let columns = match ctx.content_rect().width() {
            ..=960.0 => 1,
            960.0..1500.0 => 2,
            _ => 3,
        };
        let height = (ctx.content_rect().height() - 20.0 * GRID).max(10.0 * GRID);
        let scroll = ScrollArea::vertical().id_salt(*tab).max_height(height).min_scrolled_height(height);
        scroll.show(ui, |ui| match tab {
            HelpTab::Keys => table(ui, columns, KEY_TABLE.len().div_ceil(columns), look, language),
            HelpTab::Words => words(ui, columns, look, language),
        });
        closed
    });
    shown.should_close() || shown.inner
}

/// Shows the definitions of all words in columns of about the same height.
fn words(ui: &mut Ui, columns: usize, look: Look, language: Language) {
    ui.set_width(COLUMN_WIDTH_PT * columns as f32);
    ui.spacing_mut().item_spacing = vec2(4.0 * GRID, 0.75 * GRID);
    let letters = |definition: &Definition| definition.text(language).len() + 60;
    let length = |group: &DefinitionGroup| group.definitions.iter().map(letters).sum::<usize>();
    let all: usize = DefinitionGroup::ALL.iter().map(length).sum();
    ui.columns(columns, |columns| {
        let mut before = 0;
        for group in &DefinitionGroup::ALL {
            // A group stays in one column.
            let ui = &mut columns[(before + length(group) / 2) * columns.len() / all.max(1)];
            before += length(group);
            let title = RichText::new(group.title(language)).font(theme::strong(theme::BODY));
            // The layout of columns would stretch the lines.
            ui.with_layout(Layout::top_down(Align::Min), |ui| {
                ui.label(title.color(look.accent));
                for definition in group.definitions {
                    ui.add(Label::new(entry(definition, look, language)).wrap());
                }
            });
            ui.add_space(2.0 * GRID);
        }
    });
}

/// Returns a word in bold, and its meaning.
fn entry(definition: &Definition, look: Look, language: Language) -> LayoutJob {
    let mut job = LayoutJob::default();
    let name = format!("{}  ", definition.name(language));
    job.append(&name, 0.0, TextFormat::simple(theme::strong(theme::SMALL), look.text));
    job.append(definition.text(language), 0.0, TextFormat::simple(theme::regular(theme::SMALL), look.quiet));
    job
}

/// Paints the table of keys in columns.
fn table(ui: &mut Ui, columns: usize, lines: usize, look: Look, language: Language) {
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

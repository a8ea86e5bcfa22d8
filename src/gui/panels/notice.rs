//! Notices that float over the panels: messages, errors, and the progress of loading and exporting.

use egui::{Align2, Area, Context, Frame, Id, Label, LayerId, Order, Pos2, RichText, Stroke, Ui};

use crate::gui::session::{ExportProgress, LoadingProgress, Notice, NoticeKind, TracedShare};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, progress};
use crate::language::{Language, say, word};

/// Action of a notice's button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoticeAction {
    /// Closes the notice.
    Close,
    /// Reads the file of the scene again.
    Reload,
}

/// Shows a notice with its lower right corner at `at`, and how many others are `waiting` behind it. Returns the action
/// of the pressed button.
pub fn show(notice: &Notice, waiting: usize, ctx: &Context, at: Pos2, language: Language) -> Option<NoticeAction> {
    let look = Look::of(ctx);
    floating(ctx, "notice", at, |ui| {
        let colour = if notice.kind == NoticeKind::Trouble { look.trouble } else { look.text };
        let text = RichText::new(&notice.text).font(theme::regular(theme::BODY)).color(colour);
        ui.scope(|ui| {
            let buttons = if notice.kind == NoticeKind::Changed { 17.0 } else { 6.0 };
            let others = if waiting > 0 { 12.0 } else { 0.0 };
            ui.set_max_width(max_width(ui) - (buttons + others) * GRID);
            ui.add(Label::new(text).wrap());
        });
        if waiting > 0 {
            let text = say!(language, "and {waiting} more", "e mais {waiting}");
            ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet));
        }
        let name = word!(language, "Reload", "Recarregar");
        let reload = notice.kind == NoticeKind::Changed && button(ui, None, name, true, Emphasis::Primary).clicked();
        let close = word!(language, "Close notice", "Fechar aviso");
        let close = button(ui, Some(Icon::Close), close, false, Emphasis::Quiet).clicked();
        if reload { Some(NoticeAction::Reload) } else { close.then_some(NoticeAction::Close) }
    })
}

/// Shows that a file is being read and compiled, or its picture traced. Returns its upper edge, and whether Cancel was
/// pressed.
pub fn loading(ctx: &Context, at: Pos2, loading: &LoadingProgress<'_>, language: Language) -> (f32, bool) {
    let look = Look::of(ctx);
    let LoadingProgress { name, traced: TracedShare { share, elapsed_s }, can_cancel } = loading;
    floating(ctx, "loading", at, |ui| {
        let text = |text: String, colour| RichText::new(text).font(theme::regular(theme::BODY)).color(colour);
        if *share > 0.0 {
            let about = word!(language, "Tracing the picture", "Calculando a imagem");
            ui.label(text(about.into(), look.text));
            progress::bar(ui, *share, about);
            ui.label(text(progress::words(*share, *elapsed_s, language), look.quiet));
        } else {
            ui.label(text(say!(language, "Reading and compiling {name} …", "Lendo e compilando {name} …"), look.text));
        }
        let is_cancelled = *can_cancel && cancel(ui, language);
        (ui.max_rect().top() - GRID, is_cancelled)
    })
}

/// Shows the progress of an export. Returns its upper edge, and whether Cancel was pressed.
pub fn export_progress(ctx: &Context, at: Pos2, export: ExportProgress<'_>, language: Language) -> (f32, bool) {
    let ExportProgress { name, elapsed_s, share, waiting } = export;
    let look = Look::of(ctx);
    floating(ctx, "export", at, |ui| {
        let text = say!(language, "Writing {name}", "Gravando {name}");
        ui.label(RichText::new(&text).font(theme::regular(theme::BODY)).color(look.text));
        progress::bar(ui, share, &text);
        let done = progress::words(share, elapsed_s, language);
        let others = if waiting > 0 {
            say!(language, " · then {waiting} more", " · depois mais {waiting}")
        } else {
            String::new()
        };
        ui.label(RichText::new(done + &others).font(theme::regular(theme::BODY)).color(look.quiet));
        (ui.max_rect().top() - GRID, cancel(ui, language))
    })
}

/// Shows the button Cancel. Returns whether it was pressed.
fn cancel(ui: &mut Ui, language: Language) -> bool {
    button(ui, None, word!(language, "Cancel", "Cancelar"), true, Emphasis::Quiet).clicked()
}

/// Shows content in a frame over all panels, with its lower right corner at `at`. It floats so that its appearance
/// moves no widget under the pointer.
fn floating<T>(ctx: &Context, id: &str, at: Pos2, content: impl FnOnce(&mut Ui) -> T) -> T {
    let look = Look::of(ctx);
    let frame = Frame::NONE.fill(look.raised).stroke(Stroke::new(1.0, look.hairline)).corner_radius(8.0);
    let area = Area::new(Id::unique(id)).order(Order::Foreground).pivot(Align2::RIGHT_BOTTOM).fixed_pos(at);
    let shown = area.show(ctx, |ui| {
        frame.inner_margin(egui::vec2(1.5 * GRID, GRID)).show(ui, |ui| ui.horizontal(content).inner).inner
    });
    shown.inner
}

/// Returns the greatest width of a notice.
fn max_width(ui: &Ui) -> f32 {
    (ui.ctx().content_rect().width() - 8.0 * GRID).min(72.0 * GRID)
}

/// Covers the window with the text that a file can be dropped.
pub fn drop_here(ui: &Ui, language: Language) {
    let look = Look::of(ui.ctx());
    let painter = ui.ctx().layer_painter(LayerId::new(Order::Foreground, Id::unique("drop")));
    let area = ui.ctx().content_rect();
    painter.rect_filled(area, 0.0, look.ground.gamma_multiply(0.85));
    let frame = area.shrink(3.0 * GRID);
    painter.rect_stroke(frame, 12.0, Stroke::new(2.0, look.accent), egui::StrokeKind::Inside);
    let text = word!(language, "Drop a scene, a lesson or a recorded run", "Solte uma cena, lição ou execução gravada");
    painter.text(area.center(), Align2::CENTER_CENTER, text, theme::strong(theme::LARGE), look.text);
}

//! Notices that float over the panels: messages, errors, and the progress of loading and exporting.

use egui::{Align2, Area, Context, Frame, Id, Label, LayerId, Order, Pos2, ProgressBar, RichText, Stroke, Ui};

use crate::gui::session::{ExportProgress, Notice, NoticeKind};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button};
use crate::language::{Language, say, word};
use crate::view::fraction;

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

/// Shows that the file `name` is being read and compiled.
pub fn loading(ctx: &Context, at: Pos2, name: &str, language: Language) {
    let look = Look::of(ctx);
    floating(ctx, "notice", at, |ui| {
        ui.add(egui::Spinner::new().size(2.0 * GRID).color(look.accent));
        let text = say!(language, "Reading and compiling {name} …", "Lendo e compilando {name} …");
        ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.text));
    });
}

/// Shows the progress of an export. Returns its upper edge, and whether Cancel was pressed.
pub fn export_progress(ctx: &Context, at: Pos2, progress: ExportProgress<'_>, language: Language) -> (f32, bool) {
    let ExportProgress { name, elapsed_s, share, waiting } = progress;
    let look = Look::of(ctx);
    floating(ctx, "export", at, |ui| {
        let text = say!(language, "Writing {name}", "Gravando {name}");
        ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.text));
        let done = fraction(share);
        let done =
            time_left(elapsed_s, share, language).map_or_else(|| done.clone(), |left| format!("{done} · {left}"));
        ui.visuals_mut().extreme_bg_color = look.hairline;
        let bar = ProgressBar::new(share as f32).desired_width(16.0 * GRID).desired_height(GRID).fill(look.accent);
        ui.add(bar);
        let others = if waiting > 0 {
            say!(language, " · then {waiting} more", " · depois mais {waiting}")
        } else {
            String::new()
        };
        ui.label(RichText::new(done + &others).font(theme::regular(theme::BODY)).color(look.quiet));
        let is_cancelled = button(ui, None, word!(language, "Cancel", "Cancelar"), true, Emphasis::Quiet).clicked();
        (ui.max_rect().top() - GRID, is_cancelled)
    })
}

/// Returns a text of the time that is left; `None` while there is too little to estimate it from.
fn time_left(secs: f64, share: f64, language: Language) -> Option<String> {
    let left = (secs / share - secs).ceil();
    if secs < 1.5 || share < 0.01 || left < 1.0 {
        return None;
    }
    let minutes = (left / 60.0).round();
    Some(if left < 90.0 {
        say!(language, "about {left} s left", "faltam cerca de {left} s")
    } else {
        say!(language, "about {minutes} min left", "faltam cerca de {minutes} min")
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_left_is_estimated_from_the_share() {
        let language = Language::English;
        assert_eq!(time_left(10.0, 0.25, language).as_deref(), Some("about 30 s left"));
        assert_eq!(time_left(60.0, 0.25, language).as_deref(), Some("about 3 min left"));
        assert_eq!(
            [time_left(1.0, 0.25, language), time_left(10.0, 0.0, language), time_left(10.0, 1.0, language)],
            [None, None, None]
        );
    }
}

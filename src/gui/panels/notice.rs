//! Messages in a place of their own: notices, errors, and the progress of loading and of saving.

use egui::{Align2, Frame, Id, Label, LayerId, Order, ProgressBar, Rect, RichText, Stroke, Ui, UiBuilder, vec2};

use crate::gui::session::{ExportProgress, Notice, NoticeKind, Session};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button};
use crate::language::{Language, say, word};
use crate::view::fraction;

/// Action of a button beside a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoticeAction {
    /// Closes the notice.
    Close,
    /// Reads the file of the scene again.
    Reload,
    /// Cancels the file of this job.
    CancelExport(u64),
}

/// Least height of a message, in points.
const ROW_HEIGHT_PT: f32 = 4.0 * GRID;
/// Space between two messages, in points.
const GAP_PT: f32 = GRID / 2.0;
/// Margin at the left and at the right of a message, in points.
const MARGIN_PT: f32 = 1.5 * GRID;
/// Greatest width of a message, in points: longer lines are hard to read.
const MAX_WIDTH_PT: f32 = 110.0 * GRID;
/// Seconds after which loading and saving say what they do.
const SHORT_S: f64 = 0.4;

/// What there is to say.
struct Messages<'a> {
    /// The file that is being written, unless another panel shows it, and the number of those that wait.
    export: Option<(ExportProgress<'a>, usize)>,
    /// The notice to be read now, and the number of those that wait behind it.
    notice: Option<(&'a Notice, usize)>,
    /// Name of what is being read and compiled.
    loading: Option<&'a str>,
}

impl<'a> Messages<'a> {
    fn of(session: &'a Session, lists_exports: bool) -> Self {
        let is_long = |export: &ExportProgress<'_>| export.done.is_some_and(|(elapsed_s, _)| elapsed_s > SHORT_S);
        let waiting = session.exports().filter(|export| export.done.is_none()).count();
        let export = session.exports().find(is_long).filter(|_| lists_exports).map(|export| (export, waiting));
        let notice = session.notice().map(|notice| (notice, session.notices_waiting()));
        let loading = session.loading().filter(|(_, secs)| *secs > SHORT_S).map(|(name, _)| name);
        Self { export, notice, loading: loading.filter(|_| notice.is_none()) }
    }
}

/// Returns the height of all messages in this width; 0 if there is none. If it `lists_exports`, the progress of saving
/// is one of them.
pub fn height(ui: &Ui, width: f32, session: &Session, lists_exports: bool) -> f32 {
    let Messages { export, notice, loading } = Messages::of(session, lists_exports);
    let notice = notice.map(|(notice, waiting)| {
        let font = theme::regular(theme::BODY);
        let room = text_width(width, notice, waiting);
        let text = ui.painter().layout(notice.text.clone(), font, Look::of(ui.ctx()).text, room);
        (text.size().y + GRID).max(ROW_HEIGHT_PT)
    });
    let rows = [export.map(|_| ROW_HEIGHT_PT), notice, loading.map(|_| ROW_HEIGHT_PT)];
    let heights = rows.into_iter().flatten().map(|height| height + GAP_PT);
    (heights.sum::<f32>() - GAP_PT).max(0.0)
}

/// Shows the messages in an area of the returned [`height`]. Returns the action of the pressed button.
pub fn show(ui: &mut Ui, area: Rect, session: &Session, lists_exports: bool) -> Option<NoticeAction> {
    let language = session.language();
    let Messages { export, notice, loading } = Messages::of(session, lists_exports);
    let mut action = None;
    ui.scope_builder(UiBuilder::new().max_rect(area), |ui| {
        ui.spacing_mut().item_spacing.y = GAP_PT;
        if let Some(export) = export {
            action = message(ui, |ui| export_row(ui, export, language));
        }
        if let Some((notice, waiting)) = notice {
            let width = text_width(area.width(), notice, waiting);
            action = message(ui, |ui| notice_row(ui, notice, waiting, width, language)).or(action);
        }
        if let Some(name) = loading {
            message(ui, |ui| loading_row(ui, name, language));
        }
    });
    action
}

/// Shows a message in its frame.
fn message<T>(ui: &mut Ui, content: impl FnOnce(&mut Ui) -> T) -> T {
    let frame = Frame::NONE.fill(Look::of(ui.ctx()).raised).corner_radius(6.0);
    frame.inner_margin(vec2(MARGIN_PT, 0.0)).show(ui, |ui| ui.horizontal(content).inner).inner
}

/// Returns the width of a notice's text beside its buttons.
fn text_width(width: f32, notice: &Notice, waiting: usize) -> f32 {
    let buttons = if notice.kind == NoticeKind::Changed { 17.0 } else { 5.0 };
    let others = if waiting > 0 { 12.0 } else { 0.0 };
    width.min(MAX_WIDTH_PT) - (buttons + others) * GRID - 2.0 * MARGIN_PT
}

fn notice_row(ui: &mut Ui, notice: &Notice, waiting: usize, width: f32, language: Language) -> Option<NoticeAction> {
    let look = Look::of(ui.ctx());
    let colour = if notice.kind == NoticeKind::Trouble { look.trouble } else { look.text };
    let text = RichText::new(&notice.text).font(theme::regular(theme::BODY)).color(colour);
    ui.scope(|ui| {
        ui.set_max_width(width);
        ui.add(Label::new(text).wrap());
    });
    if waiting > 0 {
        quiet(ui, say!(language, "and {waiting} more", "e mais {waiting}"));
    }
    let name = word!(language, "Reload", "Recarregar");
    let reload = notice.kind == NoticeKind::Changed && button(ui, None, name, true, Emphasis::Primary).clicked();
    let close = word!(language, "Close notice", "Fechar aviso");
    let close = button(ui, Some(Icon::Close), close, false, Emphasis::Quiet).clicked();
    if reload { Some(NoticeAction::Reload) } else { close.then_some(NoticeAction::Close) }
}

/// Shows that a file is being read and compiled.
fn loading_row(ui: &mut Ui, name: &str, language: Language) {
    let look = Look::of(ui.ctx());
    ui.add(egui::Spinner::new().size(2.0 * GRID).color(look.accent));
    let text = say!(language, "Reading and compiling {name} …", "Lendo e compilando {name} …");
    ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.text));
}

/// Shows the progress of an export, with a button that cancels it.
fn export_row(ui: &mut Ui, (export, waiting): (ExportProgress<'_>, usize), language: Language) -> Option<NoticeAction> {
    let ExportProgress { job, name, done, .. } = export;
    let (elapsed_s, share) = done.unwrap_or_default();
    let look = Look::of(ui.ctx());
    let text = say!(language, "Writing {name}", "Gravando {name}");
    ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.text));
    // A narrow window has room for the percentage only.
    if ui.ctx().content_rect().width() > 100.0 * GRID {
        ui.visuals_mut().extreme_bg_color = look.hairline;
        let bar = ProgressBar::new(share as f32).desired_width(16.0 * GRID).desired_height(GRID).fill(look.accent);
        ui.add(bar);
    }
    let done = [Some(fraction(share)), time_left(elapsed_s, share, language)];
    let others = (waiting > 0).then(|| say!(language, "then {waiting} more", "depois mais {waiting}"));
    quiet(ui, done.into_iter().chain([others]).flatten().collect::<Vec<_>>().join(" · "));
    let cancel = button(ui, None, word!(language, "Cancel", "Cancelar"), true, Emphasis::Quiet);
    cancel.clicked().then_some(NoticeAction::CancelExport(job))
}

fn quiet(ui: &mut Ui, text: String) {
    let colour = Look::of(ui.ctx()).quiet;
    ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(colour));
}

/// Returns a text of the time that is left; `None` while there is too little to estimate it from.
pub fn time_left(secs: f64, share: f64, language: Language) -> Option<String> {
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

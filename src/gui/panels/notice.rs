//! Messages in a place of their own: notices, errors, and the progress of loading and of saving.

use egui::{Align2, Frame, Id, Label, LayerId, Order, Rect, RichText, Stroke, Ui, UiBuilder, vec2};

use crate::gui::session::{ExportProgress, LoadingProgress, Notice, NoticeKind, Session, TracedShare};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, progress};
use crate::language::{Language, say, word};

/// Action of a button beside a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoticeAction {
    /// Closes the notice.
    Close,
    /// Reads the file of the scene again.
    Reload,
    /// Reads the file of the scene again, now and whenever it changes.
    AlwaysReload,
    /// Cancels the file of this job.
    CancelExport(u64),
    /// Cancels what is being loaded.
    CancelLoading,
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
    /// What is being read, compiled and traced.
    loading: Option<LoadingProgress<'a>>,
}

impl<'a> Messages<'a> {
    fn of(session: &'a Session, lists_exports: bool) -> Self {
        let is_long = |export: &ExportProgress<'_>| export.done.is_some_and(|(elapsed_s, _)| elapsed_s > SHORT_S);
        let waiting = session.exports().filter(|export| export.done.is_none()).count();
        let export = session.exports().find(is_long).filter(|_| lists_exports).map(|export| (export, waiting));
        let loading = session.loading().filter(|loading| loading.traced.elapsed_s > SHORT_S);
        // A note that something was done waits for the run that is being loaded.
        let notice = session.notice().filter(|notice| loading.is_none() || notice.kind != NoticeKind::Note);
        Self { export, notice: notice.map(|notice| (notice, session.notices_waiting())), loading }
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
        if let Some(loading) = loading {
            action = message(ui, |ui| loading_row(ui, &loading, language)).or(action);
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
    let buttons = match notice.kind {
        NoticeKind::Changed => 27.0,
        NoticeKind::Unopened => 17.0,
        NoticeKind::Note | NoticeKind::Trouble => 5.0,
    };
    let others = if waiting > 0 { 12.0 } else { 0.0 };
    width.min(MAX_WIDTH_PT) - (buttons + others) * GRID - 2.0 * MARGIN_PT
}

fn notice_row(ui: &mut Ui, notice: &Notice, waiting: usize, width: f32, language: Language) -> Option<NoticeAction> {
    let look = Look::of(ui.ctx());
    let is_error = matches!(notice.kind, NoticeKind::Trouble | NoticeKind::Unopened);
    let colour = if is_error { look.trouble } else { look.text };
    let text = RichText::new(&notice.text).font(theme::regular(theme::BODY)).color(colour);
    ui.scope(|ui| {
        ui.set_max_width(width);
        ui.add(Label::new(text).wrap());
    });
    if waiting > 0 {
        quiet(ui, say!(language, "and {waiting} more", "e mais {waiting}"));
    }
    let name = word!(language, "Reload", "Recarregar");
    let is_change = notice.kind == NoticeKind::Changed;
    let (can_reload, hint) = (
        is_change || notice.kind == NoticeKind::Unopened,
        word!(language, "Read the file again (F5)", "Ler o arquivo de novo (F5)"),
    );
    let reload = can_reload && button(ui, None, name, true, Emphasis::Primary).on_hover_text(hint).clicked();
    let name = word!(language, "Always", "Sempre");
    let hint = word!(
        language,
        "Reload now and whenever the file changes. Set up takes it back",
        "Recarregar agora e sempre que o arquivo mudar. Ajustar desfaz isso"
    );
    let always = is_change && button(ui, None, name, true, Emphasis::Quiet).on_hover_text(hint).clicked();
    let close = word!(language, "Close notice", "Fechar aviso");
    let close = button(ui, Some(Icon::Close), close, false, Emphasis::Quiet).clicked();
    let actions = [(reload, NoticeAction::Reload), (always, NoticeAction::AlwaysReload), (close, NoticeAction::Close)];
    actions.into_iter().find_map(|(is_pressed, action)| is_pressed.then_some(action))
}

/// Shows that a file is being read and compiled, or its picture traced, with a button that cancels it.
fn loading_row(ui: &mut Ui, loading: &LoadingProgress<'_>, language: Language) -> Option<NoticeAction> {
    let LoadingProgress { name, traced: TracedShare { share, elapsed_s }, can_cancel } = loading;
    let text = |ui: &mut Ui, text: &str| {
        ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(Look::of(ui.ctx()).text));
    };
    if *share > 0.0 {
        let about = word!(language, "Tracing the picture", "Calculando a imagem");
        text(ui, about);
        progress_bar(ui, *share, about);
        quiet(ui, progress::words(*share, *elapsed_s, language));
    } else {
        text(ui, &say!(language, "Reading and compiling {name} …", "Lendo e compilando {name} …"));
    }
    (*can_cancel && is_cancelled(ui, language)).then_some(NoticeAction::CancelLoading)
}

/// Shows the progress of an export, with a button that cancels it.
fn export_row(ui: &mut Ui, (export, waiting): (ExportProgress<'_>, usize), language: Language) -> Option<NoticeAction> {
    let ExportProgress { job, name, done, .. } = export;
    let (elapsed_s, share) = done.unwrap_or_default();
    let text = say!(language, "Writing {name}", "Gravando {name}");
    ui.label(RichText::new(&text).font(theme::regular(theme::BODY)).color(Look::of(ui.ctx()).text));
    progress_bar(ui, share, &text);
    let others = (waiting > 0).then(|| say!(language, "then {waiting} more", "depois mais {waiting}"));
    let words = [Some(progress::words(share, elapsed_s, language)), others];
    quiet(ui, words.into_iter().flatten().collect::<Vec<_>>().join(" · "));
    is_cancelled(ui, language).then_some(NoticeAction::CancelExport(job))
}

/// Shows a bar; a narrow window has room for the percentage only.
fn progress_bar(ui: &mut Ui, share: f64, name: &str) {
    if ui.ctx().content_rect().width() > 100.0 * GRID {
        progress::bar(ui, share, name);
    }
}

/// Shows the button Cancel. Returns whether it was pressed.
fn is_cancelled(ui: &mut Ui, language: Language) -> bool {
    button(ui, None, word!(language, "Cancel", "Cancelar"), true, Emphasis::Quiet).clicked()
}

fn quiet(ui: &mut Ui, text: String) {
    let colour = Look::of(ui.ctx()).quiet;
    ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(colour));
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

//! The files that are being written, and those that wait for that, each with its Cancel.

use egui::{Align, Label, Layout, RichText, ScrollArea, Ui};

use crate::gui::session::{ExportProgress, Session};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, named_button, progress};
use crate::language::{Language, say, word};

/// Seconds after which the progress of a file is shown that usually takes less.
const SHORT_S: f64 = 0.4;
/// Greatest height of the list, in points; then it scrolls.
const MAX_HEIGHT_PT: f32 = 19.0 * GRID;

/// Shows the files, if there are any.
pub(super) fn show(ui: &mut Ui, session: &mut Session) {
    let language = session.language();
    let is_shown =
        |export: &ExportProgress<'_>| export.takes_long || export.done.is_none_or(|(elapsed_s, _)| elapsed_s > SHORT_S);
    let mut cancelled = None;
    let list = ScrollArea::vertical().id_salt("queue").max_height(MAX_HEIGHT_PT).min_scrolled_height(MAX_HEIGHT_PT);
    list.show(ui, |ui| {
        for export in session.exports().filter(is_shown) {
            if ui.push_id(export.job, |ui| row(ui, export, language)).inner {
                cancelled = Some(export.job);
            }
        }
    });
    if let Some(job) = cancelled {
        session.cancel_export(job);
    }
}

/// Shows a file. Returns whether its Cancel was pressed.
fn row(ui: &mut Ui, export: ExportProgress<'_>, language: Language) -> bool {
    let ExportProgress { name, done, .. } = export;
    let look = Look::of(ui.ctx());
    let quiet = |text: String| RichText::new(text).font(theme::regular(theme::SMALL)).color(look.quiet);
    let row = Layout::right_to_left(Align::Center);
    let is_cancelled = ui.allocate_ui_with_layout(egui::vec2(ui.available_width(), 4.0 * GRID), row, |ui| {
        let cancel = word!(language, "Cancel", "Cancelar");
        // Only one of them is being written, so its button needs no name.
        let own = if done.is_some() { cancel.to_owned() } else { format!("{cancel} {name}") };
        let is_cancelled = named_button(ui, None, &own, Some(cancel), Emphasis::Quiet).clicked();
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let text = if done.is_some() {
                say!(language, "Writing {name}", "Gravando {name}")
            } else {
                say!(language, "{name} waits", "{name} espera")
            };
            let text = RichText::new(text).font(theme::regular(theme::BODY)).color(look.text);
            ui.add(Label::new(text).truncate());
        });
        is_cancelled
    });
    if let Some((elapsed_s, share)) = done {
        ui.horizontal(|ui| {
            progress::bar(ui, share, name);
            ui.label(quiet(progress::words(share, elapsed_s, language)));
        });
    }
    is_cancelled.inner
}

//! Choice of a quality by a limit of the error or of the time.

use egui::{Label, RichText, Ui, vec2};

use super::findings::{AccuracyFindings, Choice};
use crate::gui::widgets::slider::{Scale, slider};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button};
use crate::language::{Language, say, word};
use crate::picture::Quality;
use crate::study::accuracy::Point;
use crate::view::{duration, quality_words, times_words, two_digits};

/// Action of the controls.
pub enum ChoiceAction {
    /// Chooses another point.
    Choose(Choice),
    /// Restarts the run with this quality.
    Take(Quality),
}

/// Height of the controls, in points.
pub const HEIGHT_PT: f32 = 24.0 * GRID;

/// Shows the sliders of both limits, the chosen quality, and the button that takes it.
pub fn show(
    ui: &mut Ui,
    findings: &AccuracyFindings,
    choice: Choice,
    index: Option<usize>,
    look: Look,
    language: Language,
) -> Option<ChoiceAction> {
    let front = findings.front();
    let (Some(fastest), Some(best)) = (front.first(), front.last()) else { return None };
    let chosen = index.and_then(|index| findings.point(index));
    let shown = chosen.unwrap_or(*fastest);
    let (error, time) = match choice {
        Choice::Point(_) => (shown.rmse(), shown.cpu_s),
        Choice::Error(error) => (error, shown.cpu_s),
        Choice::Time(time) => (shown.rmse(), time),
    };
    let mut action = None;
    ui.spacing_mut().item_spacing.y = 0.5 * GRID;
    let value_text = two_digits(error, language);
    let limits = (best.rmse(), fastest.rmse());
    let (caption, name) = word!(
        language,
        ("Fastest quality with an error up to", "Largest error"),
        ("Qualidade mais rápida com erro até", "Maior erro")
    );
    if let Some(error) = limit_slider(ui, (caption, &value_text, name), error, limits, look) {
        action = Some(ChoiceAction::Choose(Choice::Error(error)));
    }
    let value_text = duration(std::time::Duration::try_from_secs_f64(time).unwrap_or_default(), language);
    let limits = (fastest.cpu_s, best.cpu_s);
    let (caption, name) = word!(
        language,
        ("Best quality with a time up to", "Longest time"),
        ("Melhor qualidade com tempo até", "Maior tempo")
    );
    if let Some(time) = limit_slider(ui, (caption, &value_text, name), time, limits, look) {
        action = Some(ChoiceAction::Choose(Choice::Time(time)));
    }
    ui.add_space(0.5 * GRID);
    let Some((index, point)) = index.zip(chosen) else { return action };
    ui.add(
        Label::new(
            RichText::new(sentence(findings, index, &point, language))
                .font(theme::regular(theme::BODY))
                .color(look.text),
        )
        .wrap(),
    );
    ui.add_space(0.5 * GRID);
    let is_set = index == AccuracyFindings::PRESENT;
    let emphasis = if is_set { Emphasis::Quiet } else { Emphasis::Primary };
    ui.add_enabled_ui(!is_set, |ui| {
        let take = button(ui, None, word!(language, "Take these settings", "Usar estes ajustes"), true, emphasis);
        let hint = word!(
            language,
            "Restarts the run with this quality. Ctrl Z undoes it",
            "Reinicia a execução com esta qualidade. Ctrl Z desfaz"
        );
        if take.on_hover_text(hint).clicked() {
            action = Some(ChoiceAction::Take(point.quality));
        }
    });
    action
}

/// Describes the chosen quality, its time and its error, and compares it with the present one.
fn sentence(findings: &AccuracyFindings, index: usize, point: &Point, language: Language) -> String {
    let (size, quality) = (findings.whole, quality_words(&point.quality, language));
    let (time, error) = (duration(findings.time(index), language), two_digits(point.rmse(), language));
    let (width, height) = (size.width(), size.height());
    let costs = say!(
        language,
        "{time} of one core for {width} × {height} pixels, with an error of {error}",
        "{time} de um núcleo para {width} × {height} pixels, com erro de {error}"
    );
    let present = findings.point(AccuracyFindings::PRESENT).filter(|_| index != AccuracyFindings::PRESENT);
    match present {
        Some(present) => {
            let times = times_words(point.cpu_s, present.cpu_s, language);
            say!(language, "{quality}. This takes {costs}: {times}.", "{quality}. Isso leva {costs}: {times}.")
        }
        None => say!(language, "Set now: {quality}. This takes {costs}.", "Atual: {quality}. Isso leva {costs}."),
    }
}

/// Shows a logarithmic slider of a limit, between its caption and its value. Returns the new value after a drag.
fn limit_slider(
    ui: &mut Ui,
    (caption, value_text, name): (&str, &str, &str),
    value: f64,
    (min, max): (f64, f64),
    look: Look,
) -> Option<f64> {
    const CAPTION_WIDTH_PT: f32 = 32.0 * GRID;
    const VALUE_WIDTH_PT: f32 = 9.0 * GRID;
    /// Replaces 0, which has no logarithm.
    const MIN_VALUE: f64 = 1e-9;
    let [from, to] = [min, max].map(|end| end.max(MIN_VALUE).log10());
    let mut dragged = None;
    ui.horizontal(|ui| {
        ui.set_min_height(3.0 * GRID);
        let (row, _) = ui.allocate_exact_size(vec2(CAPTION_WIDTH_PT, 3.0 * GRID), egui::Sense::hover());
        let font = theme::regular(theme::BODY);
        ui.painter().text(row.left_center(), egui::Align2::LEFT_CENTER, caption, font, look.quiet);
        let width = (ui.available_width() - VALUE_WIDTH_PT - GRID).max(8.0 * GRID);
        ui.add_enabled_ui(from < to, |ui| {
            let mut exponent = value.max(MIN_VALUE).log10().clamp(from, to.max(from));
            let range = Scale::Linear(from, to.max(from + 1e-3));
            let response = slider(ui, &mut exponent, range, width, look.accent, name);
            if response.changed() {
                // At the ends the exact limits, without rounding.
                let exact = if exponent >= to { max } else { 10f64.powf(exponent) };
                dragged = Some(exact.max(min));
            }
        });
        let text = RichText::new(value_text).font(theme::strong(theme::BODY)).color(look.text);
        ui.label(text);
    });
    dragged
}

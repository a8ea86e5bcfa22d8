//! How to choose among what was measured: by a limit of the error or of the time.

use egui::{Label, RichText, Ui, vec2};

use super::findings::{AccuracyFindings, Choice};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, slider};
use crate::language::{Language, say, word};
use crate::picture::Quality;
use crate::study::accuracy::Point;
use crate::view::{duration, quality_words, times_words, two_digits};

/// What was done.
pub enum QualityChoice {
    /// Another point is to be shown.
    Choice(Choice),
    /// This is to be set.
    Take(Quality),
}

/// What all of it needs, in points.
pub const HEIGHT: f32 = 24.0 * GRID;

/// Shows both limits and what is chosen.
pub fn show(
    ui: &mut Ui,
    findings: &AccuracyFindings,
    choice: Choice,
    place: Option<usize>,
    look: Look,
    language: Language,
) -> Option<QualityChoice> {
    let front = findings.front();
    let (Some(fastest), Some(best)) = (front.first(), front.last()) else { return None };
    let chosen = place.and_then(|place| findings.point(place));
    let shown = chosen.unwrap_or(*fastest);
    let (error, time) = match choice {
        Choice::Place(_) => (shown.rmse(), shown.cpu_s),
        Choice::Error(error) => (error, shown.cpu_s),
        Choice::Time(time) => (shown.rmse(), time),
    };
    let mut done = None;
    ui.spacing_mut().item_spacing.y = 0.5 * GRID;
    let said = two_digits(error, language);
    let limits = (best.rmse(), fastest.rmse());
    let (words, name) = word!(
        language,
        ("The fastest within an error of", "Largest error"),
        ("A mais rápida com erro até", "Maior erro")
    );
    if let Some(error) = limit(ui, (words, &said, name), error, limits, look) {
        done = Some(QualityChoice::Choice(Choice::Error(error)));
    }
    let said = duration(std::time::Duration::try_from_secs_f64(time).unwrap_or_default(), language);
    let limits = (fastest.cpu_s, best.cpu_s);
    let (words, name) =
        word!(language, ("The best within a time of", "Longest time"), ("A melhor em tempo até", "Maior tempo"));
    if let Some(time) = limit(ui, (words, &said, name), time, limits, look) {
        done = Some(QualityChoice::Choice(Choice::Time(time)));
    }
    ui.add_space(0.5 * GRID);
    let Some((place, point)) = place.zip(chosen) else { return done };
    ui.add(
        Label::new(
            RichText::new(sentence(findings, place, &point, language))
                .font(theme::regular(theme::BODY))
                .color(look.text),
        )
        .wrap(),
    );
    ui.add_space(0.5 * GRID);
    let is_set = place == AccuracyFindings::PRESENT;
    let weight = if is_set { Emphasis::Quiet } else { Emphasis::Primary };
    ui.add_enabled_ui(!is_set, |ui| {
        let take = button(ui, None, word!(language, "Take these settings", "Usar estes ajustes"), true, weight);
        let hint = word!(
            language,
            "Starts the run anew with this quality; Ctrl Z takes it back",
            "Reinicia a execução com esta qualidade; Ctrl Z desfaz"
        );
        if take.on_hover_text(hint).clicked() {
            done = Some(QualityChoice::Take(point.quality));
        }
    });
    done
}

/// What is chosen, and what it costs.
fn sentence(findings: &AccuracyFindings, place: usize, point: &Point, language: Language) -> String {
    let (size, quality) = (findings.whole, quality_words(&point.quality, language));
    let (time, error) = (duration(findings.time(place), language), two_digits(point.rmse(), language));
    let (width, height) = (size.width(), size.height());
    let costs = say!(
        language,
        "{time} of one core for {width} × {height} pixels, with an error of {error}",
        "{time} de um núcleo para {width} × {height} pixels, com erro de {error}"
    );
    let present = findings.point(AccuracyFindings::PRESENT).filter(|_| place != AccuracyFindings::PRESENT);
    match present {
        Some(present) => {
            let times = times_words(point.cpu_s, present.cpu_s, language);
            say!(language, "{quality}. That takes {costs}: {times}.", "{quality}. Isso leva {costs}: {times}.")
        }
        None => say!(language, "Set now: {quality}. That takes {costs}.", "Atual: {quality}. Isso leva {costs}."),
    }
}

/// A slider of what is wanted at most, on a logarithmic scale; returns what it was dragged to.
fn limit(
    ui: &mut Ui,
    (words, said, name): (&str, &str, &str),
    value: f64,
    (least, most): (f64, f64),
    look: Look,
) -> Option<f64> {
    const WORDS: f32 = 28.0 * GRID;
    const VALUE: f32 = 9.0 * GRID;
    /// A logarithm knows no 0.
    const LEAST: f64 = 1e-9;
    let [from, to] = [least, most].map(|end| end.max(LEAST).log10());
    let mut dragged = None;
    ui.horizontal(|ui| {
        ui.set_min_height(3.0 * GRID);
        let (row, _) = ui.allocate_exact_size(vec2(WORDS, 3.0 * GRID), egui::Sense::hover());
        let font = theme::regular(theme::BODY);
        ui.painter().text(row.left_center(), egui::Align2::LEFT_CENTER, words, font, look.quiet);
        let width = (ui.available_width() - VALUE - GRID).max(8.0 * GRID);
        ui.add_enabled_ui(from < to, |ui| {
            let mut place = value.max(LEAST).log10().clamp(from, to.max(from));
            let range = (from..=to.max(from + 1e-3), false);
            let response = slider(ui, &mut place, range, width, look.accent, name);
            if response.changed() {
                // The ends themselves, not what rounding makes of them.
                let exact = if place >= to { most } else { 10f64.powf(place) };
                dragged = Some(exact.max(least));
            }
        });
        let text = RichText::new(said).font(theme::strong(theme::BODY)).color(look.text);
        ui.label(text);
    });
    dragged
}

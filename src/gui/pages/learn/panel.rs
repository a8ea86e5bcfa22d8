//! Panel of a lesson's step: text, question, answers, and buttons.

use std::ops::Range;

use egui::{Align, Color32, FontId, Label, Layout, RichText, TextStyle, Ui, UiBuilder, Vec2, vec2};

use super::course::LessonProgress;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, named_button};
use crate::language::{Language, say, word};
use crate::lesson::Question;

/// Action of a button of the panel.
pub enum LessonAction {
    /// Goes to the previous step.
    Back,
    /// Goes to the next step.
    Next,
    /// Chooses the answer at this index.
    Answer(usize),
    /// Leaves the lesson.
    Leave,
}

/// Least height of the panel, in points.
const MIN_HEIGHT_PT: f32 = 11.0 * GRID;
/// Distance between answers and between their rows, in points.
const ANSWER_GAP_PT: Vec2 = vec2(GRID, GRID / 2.0);

/// Returns the height of the panel at this width. In a high window it includes the explanation of the answer, so that
/// the answer moves nothing.
pub fn height(ui: &Ui, width: f32, progress: &LessonProgress, language: Language) -> f32 {
    let (width, gap) = (width - buttons(ui, progress, language), ui.spacing().item_spacing.y);
    let high = |text: &str, font: FontId| {
        ui.painter().layout(text.to_owned(), font, Color32::PLACEHOLDER, width).size().y + gap
    };
    let said = progress.say(language);
    let mut all = high(&heading(progress, language), theme::regular(theme::SMALL))
        + high(said, theme::strong(font_size(said, width, ui)));
    if let Some((question, answer)) = progress.question() {
        let is_high = ui.ctx().content_rect().height() > 700.0;
        all += GRID / 2.0 + high(question.question.in_language(language), theme::strong(theme::BODY));
        if is_high || answer.is_some() {
            all += high(question.because.in_language(language), theme::regular(theme::BODY));
            all += checked(ui, progress, language).map_or(0.0, |checked| high(&checked, theme::regular(theme::SMALL)));
        }
        all += rows(ui, width, question, language).len() as f32 * (4.0 * GRID + ANSWER_GAP_PT.y) + gap;
    }
    all.max(MIN_HEIGHT_PT)
}

/// Returns the width of the buttons and of the gap before them.
fn buttons(ui: &Ui, progress: &LessonProgress, language: Language) -> f32 {
    // Gap, two icon buttons, the button with icon and text, and the distances between them.
    2.0 * GRID
        + 4.0 * GRID
        + 4.0 * GRID
        + (6.0 * GRID + text_width(ui, next_text(progress, language)))
        + 2.0 * ui.spacing().item_spacing.x
}

/// Returns the width of a text on a button.
fn text_width(ui: &Ui, text: &str) -> f32 {
    let font = TextStyle::Button.resolve(ui.style());
    ui.painter().layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER).size().x
}

/// Distributes the answers to rows, with room for their marks.
fn rows(ui: &Ui, width: f32, question: &Question, language: Language) -> Vec<Range<usize>> {
    let mut rows: Vec<Range<usize>> = Vec::new();
    let mut x = 0.0;
    for (index, answer) in question.answers.iter().enumerate() {
        let text = answer.in_language(language);
        let forms = [format!("{} {text}", index + 1), marked(text, true, language), marked(text, false, language)];
        let wide = forms.iter().map(|form| text_width(ui, form)).fold(0.0, f32::max) + 3.0 * GRID;
        match rows.last_mut() {
            Some(row) if x + wide <= width => row.end = index + 1,
            _ => {
                rows.push(index..index + 1);
                x = 0.0;
            }
        }
        x += wide + ANSWER_GAP_PT.x;
    }
    rows
}

/// Returns the text of an answer with its mark.
fn marked(answer: &str, is_right: bool, language: Language) -> String {
    if is_right {
        say!(language, "Right: {answer}", "Certo: {answer}")
    } else {
        say!(language, "Wrong: {answer}", "Errado: {answer}")
    }
}

/// Returns the text of the checked claims, unless the window is low.
fn checked(ui: &Ui, progress: &LessonProgress, language: Language) -> Option<String> {
    progress.checked(language).filter(|_| ui.ctx().content_rect().height() > 560.0)
}

/// Returns the text of the button that goes on.
fn next_text(progress: &LessonProgress, language: Language) -> &'static str {
    if progress.is_over() {
        word!(language, "Other lessons", "Outras lições")
    } else {
        word!(language, "Next", "Avançar")
    }
}

/// Returns the title of the lesson and the number of the step, and while a question waits, the keys that answer it:
/// they select no machine then.
fn heading(progress: &LessonProgress, language: Language) -> String {
    let (title, number, all) = (progress.title(language), progress.step() + 1, progress.steps());
    let heading = say!(language, "{title} · step {number} of {all}", "{title} · passo {number} de {all}");
    match progress.question() {
        Some((question, None)) => {
            let answers = question.answers.len();
            heading + &say!(language, " · the keys 1 to {answers} answer", " · as teclas 1 a {answers} respondem")
        }
        _ => heading,
    }
}

/// Shows the step. Returns the action of the pressed button.
pub fn show(ui: &mut Ui, progress: &LessonProgress, language: Language) -> Option<LessonAction> {
    let look = Look::of(ui.ctx());
    let mut action = None;
    let area = ui.available_rect_before_wrap();
    let left = area.with_max_x(area.right() - buttons(ui, progress, language));
    let right = area.with_min_x(left.right() + 2.0 * GRID);
    ui.scope_builder(UiBuilder::new().max_rect(left), |ui| {
        ui.label(RichText::new(heading(progress, language)).font(theme::regular(theme::SMALL)).color(look.quiet));
        let said = RichText::new(progress.say(language)).font(theme::strong(font_size(
            progress.say(language),
            left.width(),
            ui,
        )));
        ui.add(Label::new(said.color(look.text)).wrap());
        if let Some((question, answer)) = progress.question() {
            ui.add_space(GRID / 2.0);
            let text = RichText::new(question.question.in_language(language))
                .font(theme::strong(theme::BODY))
                .color(look.text);
            ui.add(Label::new(text).wrap());
            action = answers(ui, progress, language);
            if answer.is_some() {
                let because = RichText::new(question.because.in_language(language));
                ui.add(Label::new(because.font(theme::regular(theme::BODY)).color(look.text)).wrap());
                if let Some(checked) = checked(ui, progress, language) {
                    let checked = RichText::new(checked).font(theme::regular(theme::SMALL)).color(look.quiet);
                    ui.add(Label::new(checked).wrap());
                }
            }
        }
    });
    ui.scope_builder(UiBuilder::new().max_rect(right), |ui| {
        ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
            let leave = word!(language, "Leave the lesson", "Sair da lição");
            if button(ui, Some(Icon::Close), leave, false, Emphasis::Quiet).clicked() {
                action = Some(LessonAction::Leave);
            }
            ui.add_enabled_ui(!progress.waits(), |ui| {
                let next = button(ui, Some(Icon::Next), next_text(progress, language), true, Emphasis::Primary);
                if next.on_hover_text("Page ↓").clicked() {
                    action = Some(LessonAction::Next);
                }
            });
            ui.add_enabled_ui(progress.step() > 0, |ui| {
                let back = button(ui, Some(Icon::Back), word!(language, "Back", "Voltar"), false, Emphasis::Quiet);
                if back.on_hover_text(word!(language, "Back (Page ↑)", "Voltar (Page ↑)")).clicked() {
                    action = Some(LessonAction::Back);
                }
            });
        });
    });
    action
}

/// Shows the answers, marked as right or wrong once one is chosen.
fn answers(ui: &mut Ui, progress: &LessonProgress, language: Language) -> Option<LessonAction> {
    let (question, answer) = progress.question()?;
    let mut action = None;
    let mut show_answer = |ui: &mut Ui, index: usize| {
        let text = question.answers[index].in_language(language);
        let (shown, emphasis) = match answer {
            Some(_) if index == question.right => (marked(text, true, language), Emphasis::On),
            Some(chosen) if index == chosen => (marked(text, false, language), Emphasis::Quiet),
            _ => (format!("{} {text}", index + 1), Emphasis::Quiet),
        };
        ui.add_enabled_ui(answer.is_none() || index == question.right, |ui| {
            if named_button(ui, None, text, Some(&shown), emphasis).clicked() {
                action = Some(LessonAction::Answer(index));
            }
        });
    };
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing = ANSWER_GAP_PT;
        for row in rows(ui, ui.available_width(), question, language) {
            ui.horizontal(|ui| row.for_each(|index| show_answer(ui, index)));
        }
    });
    action
}

/// Returns the font size of the step's text: the largest at which it has at most two lines, else the usual one.
fn font_size(text: &str, width: f32, ui: &Ui) -> f32 {
    let lines = |size: f32| {
        let galley = ui.painter().layout(text.to_owned(), theme::strong(size), Color32::PLACEHOLDER, width);
        galley.rows.len()
    };
    [20.0, 18.0].into_iter().find(|&size| lines(size) <= 2).unwrap_or(theme::BODY)
}

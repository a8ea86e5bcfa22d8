//! The step of a lesson: what is said, what is asked, and the way on.

use std::ops::Range;

use egui::{Align, Color32, FontId, Label, Layout, RichText, TextStyle, Ui, UiBuilder, Vec2, vec2};

use super::course::LessonProgress;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, named_button};
use crate::language::{Language, say, word};
use crate::lesson::Question;

/// What is to be done.
pub enum LessonAction {
    /// The step before.
    Back,
    /// The next step.
    Next,
    /// The question's answer.
    Answer(usize),
    /// The lesson is over.
    Leave,
}

/// Whatever is said, it is not lower.
const LEAST: f32 = 11.0 * GRID;
/// Between two answers, and between two rows of them.
const GAP: Vec2 = vec2(GRID, GRID / 2.0);

/// How high the panel is, of this width. Where there is room enough, it has room for what is said once a question is
/// answered, so that nothing moves then.
pub fn height(ui: &Ui, width: f32, course: &LessonProgress, language: Language) -> f32 {
    let (width, gap) = (width - buttons(ui, course, language), ui.spacing().item_spacing.y);
    let high = |text: &str, font: FontId| {
        ui.painter().layout(text.to_owned(), font, Color32::PLACEHOLDER, width).size().y + gap
    };
    let said = course.say(language);
    let mut all = high(&heading(course, language), theme::regular(theme::SMALL))
        + high(said, theme::strong(size(said, width, ui)));
    if let Some((question, answer)) = course.question() {
        let is_high = ui.ctx().content_rect().height() > 700.0;
        all += GRID / 2.0 + high(question.question.in_language(language), theme::strong(theme::BODY));
        if is_high || answer.is_some() {
            all += high(question.because.in_language(language), theme::regular(theme::BODY));
            all += checked(ui, course, language).map_or(0.0, |checked| high(&checked, theme::regular(theme::SMALL)));
        }
        all += rows(ui, width, question, language).len() as f32 * (4.0 * GRID + GAP.y) + gap;
    }
    all.max(LEAST)
}

/// How wide the part is in which the buttons stand, and what is before it.
fn buttons(ui: &Ui, course: &LessonProgress, language: Language) -> f32 {
    // Two icons, the way on with its icon, and what is between them.
    2.0 * GRID
        + 4.0 * GRID
        + 4.0 * GRID
        + (6.0 * GRID + wide(ui, next(course, language)))
        + 2.0 * ui.spacing().item_spacing.x
}

/// How wide these words are on a button.
fn wide(ui: &Ui, words: &str) -> f32 {
    let font = TextStyle::Button.resolve(ui.style());
    ui.painter().layout_no_wrap(words.to_owned(), font, Color32::PLACEHOLDER).size().x
}

/// Which answers stand in each row, also once they are marked.
fn rows(ui: &Ui, width: f32, question: &Question, language: Language) -> Vec<Range<usize>> {
    let mut rows: Vec<Range<usize>> = Vec::new();
    let mut x = 0.0;
    for (place, answer) in question.answers.iter().enumerate() {
        let words = answer.in_language(language);
        let forms = [format!("{} {words}", place + 1), marked(words, true, language), marked(words, false, language)];
        let wide = forms.iter().map(|form| wide(ui, form)).fold(0.0, f32::max) + 3.0 * GRID;
        match rows.last_mut() {
            Some(row) if x + wide <= width => row.end = place + 1,
            _ => {
                rows.push(place..place + 1);
                x = 0.0;
            }
        }
        x += wide + GAP.x;
    }
    rows
}

/// An answer once one is given.
fn marked(answer: &str, is_right: bool, language: Language) -> String {
    if is_right {
        say!(language, "Right: {answer}", "Certo: {answer}")
    } else {
        say!(language, "Not so: {answer}", "Não: {answer}")
    }
}

/// What the step's claims came to, unless the picture needs the room more.
fn checked(ui: &Ui, course: &LessonProgress, language: Language) -> Option<String> {
    course.checked(language).filter(|_| ui.ctx().content_rect().height() > 560.0)
}

/// What leads on.
fn next(course: &LessonProgress, language: Language) -> &'static str {
    if course.is_over() {
        word!(language, "Other lessons", "Outras lições")
    } else {
        word!(language, "Next", "Avançar")
    }
}

fn heading(course: &LessonProgress, language: Language) -> String {
    let (title, number, all) = (course.title(language), course.step() + 1, course.steps());
    say!(language, "{title} · step {number} of {all}", "{title} · passo {number} de {all}")
}

/// Shows the step.
pub fn show(ui: &mut Ui, course: &LessonProgress, language: Language) -> Option<LessonAction> {
    let look = Look::of(ui.ctx());
    let mut asked = None;
    let area = ui.available_rect_before_wrap();
    let left = area.with_max_x(area.right() - buttons(ui, course, language));
    let right = area.with_min_x(left.right() + 2.0 * GRID);
    ui.scope_builder(UiBuilder::new().max_rect(left), |ui| {
        ui.label(RichText::new(heading(course, language)).font(theme::regular(theme::SMALL)).color(look.quiet));
        let said =
            RichText::new(course.say(language)).font(theme::strong(size(course.say(language), left.width(), ui)));
        ui.add(Label::new(said.color(look.text)).wrap());
        if let Some((question, answer)) = course.question() {
            ui.add_space(GRID / 2.0);
            let words = RichText::new(question.question.in_language(language))
                .font(theme::strong(theme::BODY))
                .color(look.text);
            ui.add(Label::new(words).wrap());
            asked = answers(ui, course, language);
            if answer.is_some() {
                let because = RichText::new(question.because.in_language(language));
                ui.add(Label::new(because.font(theme::regular(theme::BODY)).color(look.text)).wrap());
                if let Some(checked) = checked(ui, course, language) {
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
                asked = Some(LessonAction::Leave);
            }
            ui.add_enabled_ui(!course.waits(), |ui| {
                let next = button(ui, Some(Icon::Next), next(course, language), true, Emphasis::Primary);
                if next.on_hover_text("Page ↓").clicked() {
                    asked = Some(LessonAction::Next);
                }
            });
            ui.add_enabled_ui(course.step() > 0, |ui| {
                let back = button(ui, Some(Icon::Back), word!(language, "Back", "Voltar"), false, Emphasis::Quiet);
                if back.on_hover_text(word!(language, "Back (Page ↑)", "Voltar (Page ↑)")).clicked() {
                    asked = Some(LessonAction::Back);
                }
            });
        });
    });
    asked
}

/// The answers; once one is given, which is right.
fn answers(ui: &mut Ui, course: &LessonProgress, language: Language) -> Option<LessonAction> {
    let (question, answer) = course.question()?;
    let mut asked = None;
    let mut one = |ui: &mut Ui, place: usize| {
        let words = question.answers[place].in_language(language);
        let (shown, weight) = match answer {
            Some(_) if place == question.right => (marked(words, true, language), Emphasis::On),
            Some(given) if place == given => (marked(words, false, language), Emphasis::Quiet),
            _ => (format!("{} {words}", place + 1), Emphasis::Quiet),
        };
        ui.add_enabled_ui(answer.is_none() || place == question.right, |ui| {
            if named_button(ui, None, words, Some(&shown), weight).clicked() {
                asked = Some(LessonAction::Answer(place));
            }
        });
    };
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing = GAP;
        for row in rows(ui, ui.available_width(), question, language) {
            ui.horizontal(|ui| row.for_each(|place| one(ui, place)));
        }
    });
    asked
}

/// How large what is said is written: in two lines, if it can be.
fn size(said: &str, width: f32, ui: &Ui) -> f32 {
    let lines = |size: f32| {
        let galley = ui.painter().layout(said.to_owned(), theme::strong(size), Color32::PLACEHOLDER, width);
        galley.rows.len()
    };
    [20.0, 18.0].into_iter().find(|&size| lines(size) <= 2).unwrap_or(theme::BODY)
}

//! The step of a lesson: what is said, what is asked, and the way on.

use egui::{Align, Label, Layout, RichText, Ui, UiBuilder, vec2};

use super::super::icons::Icon;
use super::super::theme::{self, GRID, Look};
use super::super::widgets::{Weight, button, named_button};
use super::course::Course;
use crate::language::{say, word};

/// What is to be done.
pub enum Asked {
    /// The step before.
    Back,
    /// The next step.
    Next,
    /// The question's answer.
    Answer(usize),
    /// The lesson is over.
    Leave,
}

/// How high the panel is: a question needs more room.
pub fn height(ui: &Ui, course: &Course) -> f32 {
    let is_low = ui.ctx().content_rect().height() < 700.0;
    match (course.question().is_some(), is_low) {
        (true, true) => 17.0 * GRID,
        (true, false) => 19.0 * GRID,
        (false, _) => 11.0 * GRID,
    }
}

/// Shows the step.
pub fn show(ui: &mut Ui, course: &Course) -> Option<Asked> {
    let look = Look::of(ui.ctx());
    let mut asked = None;
    let area = ui.available_rect_before_wrap();
    let right = area.with_min_x(area.right() - 19.0 * GRID);
    let left = area.with_max_x(right.left() - 2.0 * GRID);
    ui.scope_builder(UiBuilder::new().max_rect(left), |ui| {
        let (title, number, all) = (course.title(), course.step() + 1, course.steps());
        let heading = say!("{title} · step {number} of {all}", "{title} · passo {number} de {all}");
        ui.label(RichText::new(heading).font(theme::regular(theme::SMALL)).color(look.quiet));
        ui.add(Label::new(text(course.say(), ui, look)).wrap());
        if let Some((question, answer)) = course.question() {
            ui.add_space(GRID / 2.0);
            let words = RichText::new(question.question.spoken()).font(theme::strong(theme::BODY)).color(look.text);
            ui.add(Label::new(words).wrap());
            asked = answers(ui, course);
            if answer.is_some() {
                let because = RichText::new(question.because.spoken());
                ui.add(Label::new(because.font(theme::regular(theme::BODY)).color(look.text)).wrap());
            }
        }
    });
    ui.scope_builder(UiBuilder::new().max_rect(right), |ui| {
        ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
            let leave = word!("Leave the lesson", "Sair da lição");
            if button(ui, Some(Icon::Close), leave, false, Weight::Quiet).clicked() {
                asked = Some(Asked::Leave);
            }
            ui.add_enabled_ui(!course.waits(), |ui| {
                let name = if course.is_last() {
                    word!("Other lessons", "Outras lições")
                } else {
                    word!("Next", "Avançar")
                };
                let next = named_button(ui, Some(Icon::StepOn), name, Some(name), Weight::Primary);
                if next.on_hover_text("Page ↓").clicked() {
                    asked = Some(Asked::Next);
                }
            });
            ui.add_enabled_ui(course.step() > 0, |ui| {
                let back = button(ui, Some(Icon::StepBack), word!("Back", "Voltar"), false, Weight::Quiet);
                if back.on_hover_text(word!("Back (Page ↑)", "Voltar (Page ↑)")).clicked() {
                    asked = Some(Asked::Back);
                }
            });
        });
    });
    asked
}

/// The answers; once one is given, which is right.
fn answers(ui: &mut Ui, course: &Course) -> Option<Asked> {
    let (question, answer) = course.question()?;
    let mut asked = None;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(GRID, GRID / 2.0);
        for (place, words) in question.answers.iter().enumerate() {
            let words = words.spoken();
            let (shown, weight) = match answer {
                Some(_) if place == question.right => (say!("Right: {words}", "Certo: {words}"), Weight::On),
                Some(given) if place == given => (say!("Not so: {words}", "Não: {words}"), Weight::Quiet),
                _ => (words.to_owned(), Weight::Quiet),
            };
            ui.add_enabled_ui(answer.is_none() || place == question.right, |ui| {
                if named_button(ui, None, words, Some(&shown), weight).clicked() {
                    asked = Some(Asked::Answer(place));
                }
            });
        }
    });
    asked
}

/// What is said, rather small than cut.
fn text(said: &str, ui: &Ui, look: Look) -> RichText {
    let lines = |size: f32| {
        let galley = ui.painter().layout(said.to_owned(), theme::strong(size), look.text, ui.available_width());
        galley.rows.len()
    };
    let size = [20.0, 18.0].into_iter().find(|&size| lines(size) <= 2).unwrap_or(theme::BODY);
    RichText::new(said).font(theme::strong(size)).color(look.text)
}

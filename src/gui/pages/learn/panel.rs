//! Panel of a lesson's step: text, question, answers, and buttons.

use egui::{Align, Color32, FontId, Label, Layout, RichText, ScrollArea, Sense, Ui, UiBuilder, vec2};

use super::answers;
use super::course::LessonProgress;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, button_with_room, text_width};
use crate::language::{Language, say, word};

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
/// Greatest height of the panel, as a share of the window's.
const MAX_SHARE: f32 = 0.6;
/// Height of the line with the lesson's title and the buttons, in points.
const HEAD_HEIGHT_PT: f32 = 4.0 * GRID;

/// Returns the height of the panel at this width: that of the lesson's highest step, so that neither a step nor an
/// answer changes the size of the picture. In a very low window the texts scroll.
pub fn height(ui: &Ui, width: f32, progress: &LessonProgress, language: Language) -> f32 {
    let steps = (0..progress.steps()).map(|step| step_height(ui, width, progress, step, language));
    steps.fold(MIN_HEIGHT_PT, f32::max).min(MAX_SHARE * ui.ctx().content_rect().height())
}

/// Returns the height of a step at this width, whether its question has an answer or not.
fn step_height(ui: &Ui, width: f32, progress: &LessonProgress, step: usize, language: Language) -> f32 {
    let gap = ui.spacing().item_spacing.y;
    let high = |text: &str, font: FontId| {
        ui.painter().layout(text.to_owned(), font, Color32::PLACEHOLDER, width).size().y + gap
    };
    let said = progress.at(step).say.in_language(language);
    let mut all = HEAD_HEIGHT_PT + gap + high(said, theme::strong(font_size(said, width, ui)));
    if let Some(question) = &progress.at(step).ask {
        let reason = high(question.because.in_language(language), theme::regular(theme::BODY))
            + checked(ui, progress, step, language).map_or(0.0, |checked| high(&checked, theme::regular(theme::SMALL)));
        let [open, answered] = answers::heights(ui, width, question, language);
        all += GRID / 2.0 + high(question.question.in_language(language), theme::strong(theme::BODY));
        all += open.max(answered + gap + reason);
    }
    if step + 1 == progress.steps() {
        all += score(progress, language).map_or(0.0, |score| high(&score, theme::strong(theme::BODY)));
    }
    all
}

/// Returns the text of the checked claims, unless the window is low.
fn checked(ui: &Ui, progress: &LessonProgress, step: usize, language: Language) -> Option<String> {
    progress.checked(step, language).filter(|_| ui.ctx().content_rect().height() > 560.0)
}

/// Returns the text of the button that goes on.
fn next_text(is_over: bool, language: Language) -> &'static str {
    if is_over { word!(language, "Other lessons", "Outras lições") } else { word!(language, "Next", "Avançar") }
}

/// Returns the title of the lesson, the number of the step, and the right answers so far; or while a question waits,
/// the keys that answer it: they select no machine then.
fn heading(progress: &LessonProgress, language: Language) -> String {
    let (title, number, all) = (progress.title(language), progress.step() + 1, progress.steps());
    let heading = say!(language, "{title} · step {number} of {all}", "{title} · passo {number} de {all}");
    let [right, answered, _] = progress.score();
    let answers = progress.at(progress.step()).ask.as_ref().map_or(0, |question| question.answers.len());
    heading
        + &match answered {
            _ if progress.waits() => {
                say!(language, " · the keys 1 to {answers} answer", " · as teclas 1 a {answers} respondem")
            }
            0 => String::new(),
            _ => {
                say!(language, " · right answers: {right} of {answered}", " · respostas certas: {right} de {answered}")
            }
        }
}

/// Returns the result of the lesson's questions, if it has any.
fn score(progress: &LessonProgress, language: Language) -> Option<String> {
    let [right, _, questions] = progress.score();
    match questions {
        0 => None,
        1 if right == 1 => Some(word!(language, "Your answer was right.", "Sua resposta estava certa.").to_owned()),
        1 => Some(word!(language, "Your answer was wrong.", "Sua resposta estava errada.").to_owned()),
        _ => Some(say!(
            language,
            "Result: {right} of {questions} answers were right.",
            "Resultado: {right} de {questions} respostas estavam certas."
        )),
    }
}

/// Shows the step. Returns the action of the pressed button.
pub fn show(ui: &mut Ui, progress: &LessonProgress, language: Language) -> Option<LessonAction> {
    let (head, _) = ui.allocate_exact_size(vec2(ui.available_width(), HEAD_HEIGHT_PT), Sense::hover());
    let right_to_left = Layout::right_to_left(Align::Center);
    let pressed = ui.scope_builder(UiBuilder::new().max_rect(head).layout(right_to_left), |ui| {
        let pressed = buttons(ui, progress, language);
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let heading = RichText::new(heading(progress, language)).font(theme::regular(theme::SMALL));
            ui.add(Label::new(heading.color(Look::of(ui.ctx()).quiet)).truncate());
        });
        pressed
    });
    let scroll = ScrollArea::vertical().id_salt("step").auto_shrink(false);
    let answer = scroll.show(ui, |ui| texts(ui, progress, language)).inner;
    pressed.inner.or(answer.map(LessonAction::Answer))
}

/// Shows the texts, the question and its answers. Returns the index of the pressed answer.
fn texts(ui: &mut Ui, progress: &LessonProgress, language: Language) -> Option<usize> {
    let look = Look::of(ui.ctx());
    let wrapped = |ui: &mut Ui, text: &str, font: FontId, colour: Color32| {
        ui.add(Label::new(RichText::new(text).font(font).color(colour)).wrap());
    };
    let mut pressed = None;
    let step = progress.step();
    let said = progress.at(step).say.in_language(language);
    let size = font_size(said, ui.available_width(), ui);
    wrapped(ui, said, theme::strong(size), look.text);
    if let Some(question) = &progress.at(step).ask {
        ui.add_space(GRID / 2.0);
        wrapped(ui, question.question.in_language(language), theme::strong(theme::BODY), look.text);
        match progress.answer_of(step) {
            None => pressed = answers::show(ui, question, language),
            Some(chosen) => {
                answers::verdict(ui, question, chosen, language);
                wrapped(ui, question.because.in_language(language), theme::regular(theme::BODY), look.text);
                if let Some(checked) = checked(ui, progress, step, language) {
                    wrapped(ui, &checked, theme::regular(theme::SMALL), look.quiet);
                }
            }
        }
    }
    if let Some(score) = score(progress, language).filter(|_| progress.is_over()) {
        wrapped(ui, &score, theme::strong(theme::BODY), look.accent);
    }
    pressed
}

/// Shows the buttons that leave, go on and go back, from right to left.
fn buttons(ui: &mut Ui, progress: &LessonProgress, language: Language) -> Option<LessonAction> {
    let mut action = None;
    let leave = word!(language, "Leave the lesson", "Sair da lição");
    if button(ui, Some(Icon::Close), leave, false, Emphasis::Quiet).clicked() {
        action = Some(LessonAction::Leave);
    }
    // The button has one width in all steps, so that no button moves.
    let width =
        [false, true].map(|is_over| text_width(ui, next_text(is_over, language))).into_iter().fold(0.0, f32::max);
    let next = next_text(progress.is_over(), language);
    // While a question waits its answers are the main thing.
    let emphasis = if progress.waits() { Emphasis::Quiet } else { Emphasis::Primary };
    ui.add_enabled_ui(!progress.waits(), |ui| {
        let next = button_with_room(ui, Icon::Next, next, width, emphasis);
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

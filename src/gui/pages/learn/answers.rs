//! The answers of a question: buttons until one is chosen, then which is right and which was wrong.

use std::ops::Range;
use std::sync::Arc;

use egui::{Color32, Galley, Rect, Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, pos2, vec2};

use crate::gui::widgets::icons::{self, Icon};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, named_button, text_width};
use crate::language::{Language, say};
use crate::lesson::Question;

/// Distance between answers and between their rows, in points.
const GAP_PT: Vec2 = vec2(GRID, GRID / 2.0);
/// Height of an answer, in points.
const HEIGHT_PT: f32 = 4.0 * GRID;
/// Width of a mark beside its text, in points: margins, the sign and the gap after it.
const MARK_WIDTH_PT: f32 = 6.0 * GRID;

/// Returns the heights of the answers before one is chosen, and of the verdict on any of them.
pub fn heights(ui: &Ui, width: f32, question: &Question, language: Language) -> [f32; 2] {
    let high = |rows: usize| rows as f32 * (HEIGHT_PT + GAP_PT.y);
    let open = button_rows(ui, &numbered(question, language), width).len();
    let verdicts =
        (0..question.answers.len()).map(|chosen| mark_rows(ui, &marks(question, chosen, language), width).len());
    [high(open), high(verdicts.max().unwrap_or_default())]
}

/// Shows the answers with their numbers. Returns the index of the pressed one.
pub fn show(ui: &mut Ui, question: &Question, language: Language) -> Option<usize> {
    let mut pressed = None;
    let numbered = numbered(question, language);
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing = GAP_PT;
        for row in button_rows(ui, &numbered, ui.available_width()) {
            ui.horizontal(|ui| {
                for index in row {
                    let name = question.answers[index].in_language(language);
                    if named_button(ui, None, name, Some(&numbered[index]), Emphasis::Quiet).clicked() {
                        pressed = Some(index);
                    }
                }
            });
        }
    });
    pressed
}

/// Shows the right answer, after the chosen one if that is wrong.
pub fn verdict(ui: &mut Ui, question: &Question, chosen: usize, language: Language) {
    let marks = marks(question, chosen, language);
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing = GAP_PT;
        for row in mark_rows(ui, &marks, ui.available_width()) {
            ui.horizontal(|ui| marks[row].iter().for_each(|mark| mark.show(ui)));
        }
    });
}

/// An answer that is marked as right or wrong.
struct Mark {
    is_right: bool,
    text: String,
}

impl Mark {
    /// Shows the answer: a right one is filled and has a tick; a wrong one has an outline in the colour of errors and a
    /// cross. So the two differ without colours, too.
    fn show(&self, ui: &mut Ui) {
        let look = Look::of(ui.ctx());
        let (icon, ink) = if self.is_right { (Icon::Tick, look.on_accent) } else { (Icon::Close, look.trouble) };
        let galley = self.galley(ui);
        let size = vec2(galley.size().x + MARK_WIDTH_PT, HEIGHT_PT);
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &self.text));
        if self.is_right {
            ui.painter().rect_filled(rect, 6.0, look.accent);
        } else {
            ui.painter().rect_stroke(rect, 6.0, Stroke::new(2.0, look.trouble), StrokeKind::Inside);
        }
        let sign = Rect::from_center_size(pos2(rect.left() + 2.5 * GRID, rect.center().y), Vec2::splat(2.0 * GRID));
        icons::paint(ui.painter(), icon, sign, ink);
        let corner = pos2(sign.right() + GRID, rect.center().y - galley.size().y / 2.0);
        ui.painter().galley(corner, galley, ink);
    }

    fn galley(&self, ui: &Ui) -> Arc<Galley> {
        ui.painter().layout_no_wrap(self.text.clone(), theme::strong(theme::BODY), Color32::PLACEHOLDER)
    }
}

/// Returns what is marked after an answer is chosen.
fn marks(question: &Question, chosen: usize, language: Language) -> Vec<Mark> {
    let answer = |index: usize| question.answers[index].in_language(language);
    let (wrong, right) = (answer(chosen), answer(question.right));
    let mut marks = vec![Mark { is_right: true, text: say!(language, "{right}: right", "{right}: certo") }];
    if chosen != question.right {
        marks.insert(0, Mark { is_right: false, text: say!(language, "{wrong}: wrong", "{wrong}: errado") });
    }
    marks
}

/// Returns the answers' texts with their numbers.
fn numbered(question: &Question, language: Language) -> Vec<String> {
    let answers = question.answers.iter().zip(1..);
    answers.map(|(answer, number)| format!("{number} {}", answer.in_language(language))).collect()
}

fn button_rows(ui: &Ui, texts: &[String], width: f32) -> Vec<Range<usize>> {
    rows(texts.iter().map(|text| text_width(ui, text) + 3.0 * GRID), width)
}

fn mark_rows(ui: &Ui, marks: &[Mark], width: f32) -> Vec<Range<usize>> {
    rows(marks.iter().map(|mark| mark.galley(ui).size().x + MARK_WIDTH_PT), width)
}

/// Distributes items of these widths to rows.
fn rows(items: impl Iterator<Item = f32>, width: f32) -> Vec<Range<usize>> {
    let mut rows: Vec<Range<usize>> = Vec::new();
    let mut x = 0.0;
    for (index, wide) in items.enumerate() {
        match rows.last_mut() {
            Some(row) if x + wide <= width => row.end = index + 1,
            _ => {
                rows.push(index..index + 1);
                x = 0.0;
            }
        }
        x += wide + GAP_PT.x;
    }
    rows
}

//! Inspector of a pixel, in place of the ring: why it has its colour, and why it took so long.

use egui::{
    Label, Layout, Rect, RichText, ScrollArea, Sense, Stroke, StrokeKind, Ui, UiBuilder, Vec2, WidgetInfo, vec2,
};

use crate::gui::session::Session;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::paint::{Inks, paint};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{self, Emphasis, button};
use crate::language::{Language, say, word};
use crate::picture::srgb8;
use crate::view::{ChosenRay, Inspected, Mark, RaySpot};

/// Action of a button of the inspector.
enum InspectorAction {
    Choose(ChosenRay),
    Copy,
    Close,
}

/// Least width for two columns; in less the chosen ray stands below the tree of rays.
const MIN_TWO_COLUMNS_PT: f32 = 560.0;
/// Most solids in the plot of spans.
const MAX_SPAN_ROWS: usize = 16;

/// Shows the inspector of a pixel.
pub fn show(ui: &mut Ui, pixel: [u32; 2], session: &mut Session) {
    let language = session.language();
    let mut action = heading(ui, pixel, session.inspected(), language);
    match session.inspected() {
        Some(inspected) => {
            let inks = Inks { look: Look::of(ui.ctx()), nodes: &session.stage().colours };
            let scrolled = ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                // Room for the scroll bar.
                ui.set_width(ui.available_width() - GRID);
                body(ui, inspected, &inks, language)
            });
            action = action.or(scrolled.inner);
        }
        None => {
            quiet(ui, word!(language, "The pixel is being traced again …", "O pixel está sendo calculado de novo …"))
        }
    }
    match action {
        Some(InspectorAction::Choose(chosen)) => session.choose_ray(chosen),
        Some(InspectorAction::Copy) => {
            let text = session.inspected().map(|pixel| pixel.text(language)).unwrap_or_default();
            ui.ctx().copy_text(text);
            session.note(word!(language, "Copied as text", "Copiado como texto"));
        }
        Some(InspectorAction::Close) => session.stop_inspecting(),
        None => {}
    }
}

fn heading(
    ui: &mut Ui,
    [x, y]: [u32; 2],
    inspected: Option<&Inspected>,
    language: Language,
) -> Option<InspectorAction> {
    let look = Look::of(ui.ctx());
    let mut action = None;
    ui.horizontal(|ui| {
        if let Some(inspected) = inspected {
            let (rect, _) = ui.allocate_exact_size(Vec2::splat(3.5 * GRID), Sense::hover());
            let colour = theme::colour(srgb8(inspected.colour().as_vec3().to_array()));
            ui.painter().rect(rect, 4.0, colour, Stroke::new(1.0, look.quiet), StrokeKind::Inside);
        }
        let title = RichText::new(format!("Pixel {x}, {y}")).font(theme::strong(theme::LARGE)).color(look.text);
        ui.label(title);
        ui.with_layout(Layout::right_to_left(egui::Align::Center), |ui| {
            if button(
                ui,
                Some(Icon::Close),
                word!(language, "Close inspector", "Fechar inspetor"),
                false,
                Emphasis::Quiet,
            )
            .on_hover_text(word!(language, "Close (Esc)", "Fechar (Esc)"))
            .clicked()
            {
                action = Some(InspectorAction::Close);
            }
            ui.add_enabled_ui(inspected.is_some(), |ui| {
                let name = word!(language, "Copy as text", "Copiar como texto");
                let has_room = ui.available_width() > 20.0 * GRID;
                let icon = (!has_room).then_some(Icon::Copy);
                if button(ui, icon, name, has_room, Emphasis::Quiet).on_hover_text(name).clicked() {
                    action = Some(InspectorAction::Copy);
                }
            });
        });
    });
    action
}

/// Shows the sentences, the tree of rays and the chosen ray.
fn body(ui: &mut Ui, inspected: &Inspected, inks: &Inks<'_>, language: Language) -> Option<InspectorAction> {
    let look = inks.look;
    ui.spacing_mut().item_spacing.y = GRID / 2.0;
    let sentences = inspected.sentences(language);
    if let Some((first, others)) = sentences.split_first() {
        sentence(ui, RichText::new(first).font(theme::regular(theme::BODY)).color(look.text));
        if !others.is_empty() {
            quiet(ui, &others.join(" "));
        }
    }
    ui.add_space(GRID);
    if ui.available_width() < MIN_TWO_COLUMNS_PT {
        let action = rays(ui, inspected, inks, language);
        ui.add_space(GRID);
        ray(ui, inspected, inks, language);
        return action;
    }
    let whole = ui.available_rect_before_wrap();
    let split = whole.left() + (0.4 * whole.width()).round();
    let [left, right] = [whole.with_max_x(split), whole.with_min_x(split + 3.0 * GRID)];
    let left = ui.scope_builder(UiBuilder::new().max_rect(left), |ui| rays(ui, inspected, inks, language));
    let right = ui.scope_builder(UiBuilder::new().max_rect(right), |ui| ray(ui, inspected, inks, language));
    ui.advance_cursor_after_rect(left.response.rect.union(right.response.rect));
    left.inner
}

/// Shows the tree of rays; a click chooses a ray.
fn rays(ui: &mut Ui, inspected: &Inspected, inks: &Inks<'_>, language: Language) -> Option<InspectorAction> {
    let mut action = None;
    let (chosen, samples) = (inspected.chosen, inspected.samples.len());
    ui.horizontal(|ui| {
        title(ui, word!(language, "Its rays", "Seus raios"), inks.look);
        if samples > 1 {
            action = sample_buttons(ui, chosen.sample, samples, inks.look, language);
        }
    });
    // Above the tree, where a deep one does not push it out of sight.
    if inspected.sample().rays.len() > 1 {
        quiet(
            ui,
            word!(
                language,
                "P: from the eye; R: reflected (dashed); T: transmitted. A broad line counts more. Click a ray.",
                "P: do observador; R: refletido (tracejado); T: transmitido. Uma linha larga conta mais. \
                Clique num raio."
            ),
        );
    }
    let tree = inspected.ray_tree(ui.available_width(), language);
    let names: Vec<_> = tree.spots.iter().map(|spot| spot.name.clone()).collect();
    let name = word!(language, "Tree of rays", "Árvore de raios");
    let rect = drawing(ui, name, &names.join("; "), (&tree.marks, tree.height), inks);
    for spot in tree.spots {
        let at = rect.min + Vec2::from(spot.at);
        let rect = Rect::from_center_size(at, Vec2::splat(2.0 * RaySpot::REACH));
        let response = ui.interact(rect, ui.scope_id().with(("ray", spot.ray)), Sense::click());
        let is_chosen = spot.ray == chosen.ray;
        response.widget_info(|| WidgetInfo::selected(egui::Role::Button, true, is_chosen, &spot.name));
        if response.hovered() || response.has_focus() {
            ui.painter().circle_stroke(at, RaySpot::REACH + 2.0, Stroke::new(1.5, inks.look.accent));
        }
        if response.on_hover_text(&spot.name).clicked() {
            action = Some(InspectorAction::Choose(ChosenRay { ray: spot.ray, ..chosen }));
        }
    }
    action
}

/// Shows the buttons for the previous and the next sample.
fn sample_buttons(
    ui: &mut Ui,
    sample: usize,
    samples: usize,
    look: Look,
    language: Language,
) -> Option<InspectorAction> {
    let mut action = None;
    let mut step = |ui: &mut Ui, name, words, to: Option<usize>| {
        ui.add_enabled_ui(to.is_some(), |ui| {
            if widgets::named_button(ui, None, name, Some(words), Emphasis::Quiet).clicked() {
                action = to.map(|sample| InspectorAction::Choose(ChosenRay { sample, ray: 0 }));
            }
        });
    };
    step(ui, word!(language, "Previous sample", "Amostra anterior"), "<", sample.checked_sub(1));
    let which = sample + 1;
    let text = say!(language, "sample {which} of {samples}", "amostra {which} de {samples}");
    ui.label(RichText::new(text).font(theme::regular(theme::SMALL)).color(look.quiet));
    step(ui, word!(language, "Next sample", "Próxima amostra"), ">", Some(which).filter(|next| *next < samples));
    action
}

/// Shows the chosen ray: the terms of its equation, and its spans through the solids.
fn ray(ui: &mut Ui, inspected: &Inspected, inks: &Inks<'_>, language: Language) {
    let which = inspected.chosen.ray + 1;
    ui.horizontal(|ui| title(ui, &say!(language, "Ray {which}", "Raio {which}"), inks.look));
    quiet(ui, &inspected.ray_sentences(language).join(" "));
    let terms = inspected.draw_terms(ui.available_width(), language);
    let name = word!(language, "Terms of the equation", "Termos da equação");
    let area = drawing(ui, name, &inspected.term_words(language), (&terms.marks, terms.height), inks);
    // In a narrow panel only the formulas have room.
    for (index, (heights, name)) in terms.rows.iter().enumerate() {
        let row = area.with_min_y(area.top() + heights.start).with_max_y(area.top() + heights.end);
        ui.interact(row, ui.scope_id().with(("term", index)), Sense::hover()).on_hover_text(name);
    }
    ui.add_space(GRID);
    let spans = inspected.spans(ui.available_width(), MAX_SPAN_ROWS, language);
    let name = word!(language, "Spans along the ray", "Trechos ao longo do raio");
    drawing(ui, name, &inspected.span_words(language), (&spans.marks, spans.height), inks);
}

/// Paints a display list of this height; returns its rectangle. `text` is its content for screen readers.
fn drawing(ui: &mut Ui, name: &str, text: &str, (marks, height): (&[Mark], f32), inks: &Inks<'_>) -> Rect {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    widgets::describe(&response, name, || text.to_owned());
    paint(&ui.painter_at(rect.expand(4.0)), rect.min, marks, inks);
    rect
}

fn title(ui: &mut Ui, text: &str, look: Look) {
    ui.label(RichText::new(text).font(theme::strong(theme::BODY)).color(look.text));
}

fn quiet(ui: &mut Ui, text: &str) {
    let colour = Look::of(ui.ctx()).quiet;
    sentence(ui, RichText::new(text).font(theme::regular(theme::SMALL)).color(colour));
}

fn sentence(ui: &mut Ui, text: RichText) {
    ui.add(Label::new(text).wrap());
}

//! A pixel in the place of the ring: why it has its colour, and why it took so long.

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

/// What is asked for in the panel.
enum InspectorAction {
    Choose(ChosenRay),
    Copy,
    Close,
}

/// In less width the chosen ray stands below the tree of rays.
const WIDE: f32 = 560.0;
/// Of longer lists of solids only the beginning is shown.
const MOST_ROWS: usize = 16;

/// Shows what is known of the pixel at `place`.
pub fn show(ui: &mut Ui, place: [u32; 2], session: &mut Session) {
    let language = session.language();
    let mut asked = heading(ui, place, session.inspected(), language);
    match session.inspected() {
        Some(inspected) => {
            let inks = Inks { look: Look::of(ui.ctx()), nodes: &session.stage().colours };
            let scrolled = ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                // Beside the bar that scrolls.
                ui.set_width(ui.available_width() - GRID);
                body(ui, inspected, &inks, language)
            });
            asked = asked.or(scrolled.inner);
        }
        None => quiet(ui, word!(language, "Tracing it once more …", "Calculando-o mais uma vez …")),
    }
    match asked {
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
    let mut asked = None;
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
                asked = Some(InspectorAction::Close);
            }
            ui.add_enabled_ui(inspected.is_some(), |ui| {
                let name = word!(language, "Copy as text", "Copiar como texto");
                let has_room = ui.available_width() > 20.0 * GRID;
                let icon = (!has_room).then_some(Icon::Copy);
                if button(ui, icon, name, has_room, Emphasis::Quiet).on_hover_text(name).clicked() {
                    asked = Some(InspectorAction::Copy);
                }
            });
        });
    });
    asked
}

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
    if ui.available_width() < WIDE {
        let asked = rays(ui, inspected, inks, language);
        ui.add_space(GRID);
        ray(ui, inspected, inks, language);
        return asked;
    }
    let whole = ui.available_rect_before_wrap();
    let split = whole.left() + (0.4 * whole.width()).round();
    let [left, right] = [whole.with_max_x(split), whole.with_min_x(split + 3.0 * GRID)];
    let left = ui.scope_builder(UiBuilder::new().max_rect(left), |ui| rays(ui, inspected, inks, language));
    let right = ui.scope_builder(UiBuilder::new().max_rect(right), |ui| ray(ui, inspected, inks, language));
    ui.advance_cursor_after_rect(left.response.rect.union(right.response.rect));
    left.inner
}

/// The tree of rays, of which one can be chosen.
fn rays(ui: &mut Ui, inspected: &Inspected, inks: &Inks<'_>, language: Language) -> Option<InspectorAction> {
    let mut asked = None;
    let (chosen, samples) = (inspected.chosen, inspected.samples.len());
    ui.horizontal(|ui| {
        title(ui, word!(language, "Its rays", "Seus raios"), inks.look);
        if samples > 1 {
            asked = sample_buttons(ui, chosen.sample, samples, inks.look, language);
        }
    });
    let tree = inspected.ray_tree(ui.available_width(), language);
    let names: Vec<_> = tree.spots.iter().map(|spot| spot.name.clone()).collect();
    let name = word!(language, "Tree of rays", "Árvore de raios");
    let rect = drawing(ui, name, &names.join("; "), (&tree.marks, tree.height), inks);
    for spot in tree.spots {
        let at = rect.min + Vec2::from(spot.at);
        let place = Rect::from_center_size(at, Vec2::splat(2.0 * RaySpot::REACH));
        let response = ui.interact(place, ui.scope_id().with(("ray", spot.ray)), Sense::click());
        let is_chosen = spot.ray == chosen.ray;
        response.widget_info(|| WidgetInfo::selected(egui::Role::Button, true, is_chosen, &spot.name));
        if response.hovered() || response.has_focus() {
            ui.painter().circle_stroke(at, RaySpot::REACH + 2.0, Stroke::new(1.5, inks.look.accent));
        }
        if response.on_hover_text(&spot.name).clicked() {
            asked = Some(InspectorAction::Choose(ChosenRay { ray: spot.ray, ..chosen }));
        }
    }
    if inspected.sample().rays.len() > 1 {
        quiet(
            ui,
            word!(
                language,
                "P from the eye, R reflected (dashed), T through a surface; the broader, the more it counts. Click one.",
                "P do observador, R refletido (tracejado), T através de superfície; quanto mais largo, mais conta. \
                 Clique num."
            ),
        );
    }
    asked
}

/// From one sample to the next.
fn sample_buttons(
    ui: &mut Ui,
    sample: usize,
    samples: usize,
    look: Look,
    language: Language,
) -> Option<InspectorAction> {
    let mut asked = None;
    let mut step = |ui: &mut Ui, name, words, to: Option<usize>| {
        ui.add_enabled_ui(to.is_some(), |ui| {
            if widgets::named_button(ui, None, name, Some(words), Emphasis::Quiet).clicked() {
                asked = to.map(|sample| InspectorAction::Choose(ChosenRay { sample, ray: 0 }));
            }
        });
    };
    step(ui, word!(language, "Sample before", "Amostra anterior"), "<", sample.checked_sub(1));
    let which = sample + 1;
    let text = say!(language, "sample {which} of {samples}", "amostra {which} de {samples}");
    ui.label(RichText::new(text).font(theme::regular(theme::SMALL)).color(look.quiet));
    step(ui, word!(language, "Next sample", "Próxima amostra"), ">", Some(which).filter(|next| *next < samples));
    asked
}

/// The chosen ray: the terms of its equation, and what it passes.
fn ray(ui: &mut Ui, inspected: &Inspected, inks: &Inks<'_>, language: Language) {
    let which = inspected.chosen.ray + 1;
    ui.horizontal(|ui| title(ui, &say!(language, "Ray {which}", "Raio {which}"), inks.look));
    quiet(ui, &inspected.ray_sentences(language).join(" "));
    let terms = inspected.draw_terms(ui.available_width(), language);
    let name = word!(language, "Terms of the equation", "Termos da equação");
    drawing(ui, name, &inspected.term_words(language), (&terms.marks, terms.height), inks);
    ui.add_space(GRID);
    let spans = inspected.spans(ui.available_width(), MOST_ROWS, language);
    let name = word!(language, "Spans along the ray", "Trechos ao longo do raio");
    drawing(ui, name, &inspected.span_words(language), (&spans.marks, spans.height), inks);
}

/// A display list as high as it is; returns its place.
fn drawing(ui: &mut Ui, name: &str, words: &str, (marks, height): (&[Mark], f32), inks: &Inks<'_>) -> Rect {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    widgets::describe(&response, name, || words.to_owned());
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

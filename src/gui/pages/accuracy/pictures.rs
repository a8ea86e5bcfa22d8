//! A picture beside the reference, or their difference in false colours.

use egui::{Align2, Color32, ColorImage, Event, Key, Rect, Sense, Stroke, TextureHandle, TextureOptions, Ui};
use egui::{EventFilter, WidgetInfo, pos2, vec2};

use crate::gui::widgets::steady;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{self, choice_buttons};
use crate::language::{Language, comma, say, word};
use crate::palette::Rgb;
use crate::picture::{Frame, srgb8};
use crate::view::{RAMP_ERRORS, false_colours, ramp, ramp_position};

/// The pictures of the chosen point.
pub struct PointPictures {
    view: PictureMode,
    /// Position of the line between picture and reference, as a share of the width.
    divider: f32,
    textures: Option<Textures>,
}

/// What is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PictureMode {
    /// The picture at the left, the reference at the right.
    Both,
    /// Their difference in false colours.
    Difference,
}

/// Textures of one point.
struct Textures {
    /// Job number and index of the point.
    of: (u64, usize),
    picture: TextureHandle,
    reference: TextureHandle,
    difference: TextureHandle,
}

impl Default for PointPictures {
    fn default() -> Self {
        Self { view: PictureMode::Both, divider: 0.5, textures: None }
    }
}

/// Height of the buttons above and the legend below the picture, in points.
const CONTROLS_HEIGHT_PT: f32 = 10.0 * GRID;

impl PointPictures {
    /// Shows the picture of a point, at most `height` points high with its controls. `of` is job number and index of
    /// the point.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        of: (u64, usize),
        picture: &Frame,
        reference: &Frame,
        height: f32,
        language: Language,
    ) {
        let look = Look::of(ui.ctx());
        let all = [
            (
                PictureMode::Both,
                word!(language, "Beside the reference", "Com a referência"),
                word!(
                    language,
                    "Chosen quality at the left, reference at the right. Drag the line",
                    "Qualidade escolhida à esquerda, referência à direita. Arraste a linha"
                ),
            ),
            (
                PictureMode::Difference,
                word!(language, "Difference", "Diferença"),
                word!(
                    language,
                    "How much each pixel differs from the reference",
                    "Quanto cada pixel difere da referência"
                ),
            ),
        ];
        if let Some(view) = choice_buttons(ui, self.view, &all) {
            self.view = view;
        }
        let size = vec2(picture.size().width() as f32, picture.size().height() as f32);
        let room = vec2(ui.available_width(), (height - CONTROLS_HEIGHT_PT).max(8.0 * GRID));
        let shown = size * (room.x / size.x).min(room.y / size.y);
        let (rect, response) = steady::allocate_size(ui, shown, "pictures", Sense::click_and_drag());
        let textures = match self.textures.take().filter(|textures| textures.of == of) {
            Some(textures) => textures,
            None => Textures::new(ui, of, picture, reference),
        };
        match self.view {
            PictureMode::Both => {
                self.move_divider(ui, &response, rect);
                self.both(ui, &textures, rect, look, language);
                let value = f64::from(100.0 * self.divider);
                let name = word!(language, "Divider of the pictures", "Divisória das imagens");
                response.widget_info(|| WidgetInfo::slider(true, value, name));
                response.on_hover_cursor(egui::CursorIcon::ResizeHorizontal);
                ui.add_space(LEGEND_HEIGHT_PT);
            }
            PictureMode::Difference => {
                paint_part(ui, &textures.difference, rect, 0.0..1.0);
                let name = word!(language, "Difference from the reference", "Diferença da referência");
                widgets::describe(&response, name, || word!(language, "in false colour", "em cores falsas").into());
                legend(ui, rect.width(), look, language);
            }
        }
        self.textures = Some(textures);
    }

    fn move_divider(&mut self, ui: &Ui, response: &egui::Response, rect: Rect) {
        if let Some(at) = response.interact_pointer_pos() {
            self.divider = (at.x - rect.left()) / rect.width();
        }
        if response.has_focus() {
            let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
            let pressed = |wanted| {
                let is_it = |event: &Event| matches!(event, Event::Key { key, pressed: true, .. } if *key == wanted);
                ui.input(|input| input.events.iter().filter(|event| is_it(event)).count()) as f32
            };
            self.divider += 0.05 * (pressed(Key::ArrowRight) - pressed(Key::ArrowLeft));
        }
        self.divider = self.divider.clamp(0.0, 1.0);
    }

    fn both(&self, ui: &Ui, textures: &Textures, rect: Rect, look: Look, language: Language) {
        paint_part(ui, &textures.reference, rect, 0.0..1.0);
        paint_part(ui, &textures.picture, rect, 0.0..self.divider);
        let x = rect.left() + rect.width() * self.divider;
        let painter = ui.painter_at(rect);
        // White on black is visible on every picture.
        painter.vline(x, rect.y_range(), Stroke::new(4.0, Color32::from_black_alpha(160)));
        painter.vline(x, rect.y_range(), Stroke::new(2.0, Color32::WHITE));
        painter.circle(pos2(x, rect.center().y), 9.0, look.accent, Stroke::new(2.0, Color32::WHITE));
        let top = rect.top() + GRID;
        let [left, right] = [rect.with_max_x(x), rect.with_min_x(x)].map(|side| painter.with_clip_rect(side));
        let [chosen, reference] = word!(language, ["chosen", "reference"], ["escolhida", "referência"]);
        label(&left, pos2(rect.left() + GRID, top), Align2::LEFT_TOP, chosen);
        label(&right, pos2(rect.right() - GRID, top), Align2::RIGHT_TOP, reference);
    }
}

impl Textures {
    fn new(ui: &Ui, of: (u64, usize), picture: &Frame, reference: &Frame) -> Self {
        let size = [picture.size().width() as usize, picture.size().height() as usize];
        // No interpolation, so that single pixels can be compared.
        let load = |name: &str, pixels: Vec<Rgb>| {
            let image = ColorImage::new(size, pixels.into_iter().map(theme::colour).collect());
            ui.ctx().load_texture(name, image, TextureOptions::NEAREST)
        };
        let shown = |frame: &Frame| frame.pixels().iter().map(|&pixel| srgb8(pixel)).collect();
        Self {
            of,
            picture: load("chosen", shown(picture)),
            reference: load("reference", shown(reference)),
            difference: load("difference", false_colours(picture, reference)),
        }
    }
}

/// Paints a part of a texture, in shares of its width; `rect` is the rectangle of the whole texture.
fn paint_part(ui: &Ui, texture: &TextureHandle, rect: Rect, part: std::ops::Range<f32>) {
    let x = |share: f32| rect.left() + rect.width() * share;
    let shown = Rect::from_x_y_ranges(x(part.start)..=x(part.end), rect.y_range());
    let uv = Rect::from_min_max(pos2(part.start, 0.0), pos2(part.end, 1.0));
    ui.painter().image(texture.id(), shown, uv, Color32::WHITE);
}

/// Paints a caption on a picture.
fn label(painter: &egui::Painter, at: egui::Pos2, anchor: Align2, text: &str) {
    let galley = painter.layout_no_wrap(text.into(), theme::regular(theme::SMALL), Color32::WHITE);
    let rect = anchor.anchor_size(at, galley.size());
    painter.rect_filled(rect.expand2(vec2(6.0, 3.0)), 4.0, Color32::from_black_alpha(150));
    painter.galley(rect.min, galley, Color32::WHITE);
}

/// Height of the legend, in points.
const LEGEND_HEIGHT_PT: f32 = 4.0 * GRID;

/// Shows the colours of errors with some of their values.
fn legend(ui: &mut Ui, width: f32, look: Look, language: Language) {
    const STEPS: usize = 64;
    let (rect, response) = ui.allocate_exact_size(vec2(width, LEGEND_HEIGHT_PT), Sense::hover());
    widgets::describe(&response, word!(language, "Colours of errors", "Cores dos erros"), || {
        word!(language, "from 0.001 to 1, on a logarithmic scale", "de 0,001 a 1, em escala logarítmica").into()
    });
    let bar = rect.with_max_y(rect.top() + GRID);
    let at = |share: f64| bar.left() + bar.width() * share as f32;
    for i in 0..STEPS {
        let [from, to] = [i, i + 1].map(|i| i as f64 / STEPS as f64);
        let step = Rect::from_x_y_ranges(at(from)..=at(to) + 0.5, bar.y_range());
        ui.painter().rect_filled(step, 0.0, theme::colour(ramp((from + to) / 2.0)));
    }
    let font = theme::regular(theme::SMALL);
    for (i, error) in RAMP_ERRORS.into_iter().enumerate() {
        let number = comma(language, error.to_string());
        let (text, anchor) = match i {
            0 => (say!(language, "error {number}", "erro {number}"), Align2::LEFT_TOP),
            _ if i + 1 == RAMP_ERRORS.len() => {
                (say!(language, "{number} (linear light)", "{number} (luz linear)"), Align2::RIGHT_TOP)
            }
            _ => (number, Align2::CENTER_TOP),
        };
        ui.painter().text(pos2(at(ramp_position(error)), bar.bottom() + 3.0), anchor, text, font.clone(), look.quiet);
    }
}

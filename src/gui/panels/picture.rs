//! The picture with its layers, zoom, camera control and pixel selection.

use std::ops::Range;
use std::sync::Arc;

use egui::{
    Align2, Color32, ColorImage, Painter, PointerButton, Pos2, Rect, Response, Role, Sense, Stroke, StrokeKind,
    TextureHandle, TextureOptions, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::picture_captions;
use crate::gui::input::selection::Selection;
use crate::gui::session::{CameraPreview, Session};
use crate::gui::widgets;
use crate::gui::widgets::canvas_texture::CanvasTexture;
use crate::gui::widgets::icons::{self, Icon};
use crate::gui::widgets::picture_view::PictureView;
use crate::gui::widgets::slider::{Scale, slider};
use crate::gui::widgets::steady;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, say, word};
use crate::picture::Atom;
use crate::view::{Highlight, Layer, Subject, atom_words, outlines, percent};

/// Height of the controls below the picture, in points.
pub const CONTROLS_HEIGHT_PT: f32 = 5.0 * GRID;

/// The picture panel.
pub struct PicturePanel {
    texture: CanvasTexture,
    view: PictureView,
    /// Layer over the render.
    pub layer: Layer,
    /// Share of the layer in percent; 0 is the render alone.
    pub blend: f64,
    /// Whether lines separate the bands and, when zoomed in, the atoms.
    pub outlines: bool,
    /// Whether a drag moves the camera.
    pub moves_camera: bool,
    /// Whether a drag that moves nothing has been answered by how to move the camera.
    has_told_of_camera: bool,
    /// Preview of the moving camera, and its texture.
    preview: Option<(Arc<CameraPreview>, TextureHandle)>,
}

impl Default for PicturePanel {
    fn default() -> Self {
        Self {
            texture: CanvasTexture::default(),
            view: PictureView::default(),
            layer: Layer::Owners,
            blend: 70.0,
            outlines: false,
            moves_camera: false,
            has_told_of_camera: false,
            preview: None,
        }
    }
}

/// Side of a pixel from which pixels are drawn as squares, in points.
const MIN_SQUARE_PIXEL_PT: f32 = 3.0;
/// Side of a pixel, which is the height of an atom, from which lines separate the atoms, in points.
const MIN_OUTLINED_ATOM_PT: f32 = 5.0;

impl PicturePanel {
    /// Shows the picture as large as possible, and its controls below.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session, selection: &mut Selection, highlight: &Highlight) {
        let language = session.language();
        let look = Look::of(ui.ctx());
        let shown = self.shown();
        if self.moves_camera && session.is_recorded() {
            self.moves_camera = false;
            session.refuse_camera();
        }
        let canvas = session.stage_mut().canvas(shown, theme::rgb(look.ground));
        let size = vec2(canvas.size().width() as f32, canvas.size().height() as f32);
        let room = vec2(ui.available_width(), (ui.available_height() - CONTROLS_HEIGHT_PT).max(GRID));
        let fit = (room.x / size.x).min(room.y / size.y);
        let slack = (room - size * fit).max(Vec2::ZERO);
        let frame = Rect::from_min_size(ui.cursor().min + slack / 2.0, size * fit);
        let response = steady::allocate_rect(ui, frame, "picture", Sense::click_and_drag());
        let moves = self.moves_camera || response.dragged_by(PointerButton::Secondary);
        if !moves {
            self.zoom_and_pan(ui, &response, size, frame);
        }
        let (picture, scale) = self.view.picture_rect(size, frame);
        let texture = self.texture.upload(ui.ctx(), canvas, scale >= MIN_SQUARE_PIXEL_PT);
        self.move_camera(ui, &response, frame, session);
        let state = session.stage().state();
        widgets::describe(&response, word!(language, "Picture", "Imagem"), || {
            let done = percent(state.done(), state.atoms());
            say!(language, "{done} done", "{done} pronta")
        });
        let painter = ui.painter_at(frame);
        if let Some(texture) = texture {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(texture, picture, whole, Color32::WHITE);
        }
        if state.done() == 0 {
            // Where nothing is traced yet, the frame says where the picture will be.
            painter.rect_stroke(frame, 0.0, Stroke::new(1.0, look.hairline), StrokeKind::Inside);
        }
        if let Some((preview, texture)) = &self.preview {
            painter.image(texture.id(), frame, place_in_texture(preview), Color32::WHITE);
        }
        self.tell_of_camera(&response, session);
        if self.moves_camera || session.is_camera_moved() {
            self.camera_strip(ui, frame, session, look);
        }
        if self.preview.is_some() {
            // The preview shows no pixel of the present run.
        } else if response.double_clicked() && !self.view.shows_all() {
            self.show_all();
            session.stop_inspecting();
        } else if response.clicked() {
            // A click by keyboard has no position: it inspects the centre, from which arrows lead on.
            let at = response.interact_pointer_pos().unwrap_or(frame.center());
            let [x, y] = pixel_at(session, (at - picture.min) / scale);
            session.inspect([x, y]);
            selection.selected = Some(Subject::Atom(atom_at(session, [x, y])));
            response.surrender_focus();
        }
        if self.outlines {
            outline_all(&painter, (picture, scale), frame, session);
        }
        outline(&painter, (picture, scale), session, &highlight.atoms, 1.25);
        // Over the outlines, which would strike through their texts.
        if self.preview.is_none() && self.view.shows_all() && !self.moves_camera {
            picture_captions::paint(&painter, picture, scale, session);
        }
        if let Some([x, y]) = session.inspected_pixel() {
            // The selected atom follows the inspected pixel.
            if let Some(Subject::Atom(atom)) = &mut selection.selected {
                *atom = atom_at(session, [x, y]);
            }
            cross_hair(&painter, picture.min + (vec2(x as f32, y as f32) + Vec2::splat(0.5)) * scale, scale);
        }
        if let Some(at) = response.hover_pos() {
            let [x, y] = pixel_at(session, (at - picture.min) / scale);
            let atom = atom_at(session, [x, y]);
            selection.hover(Subject::Atom(atom));
            if !self.moves_camera && !response.dragged() {
                let words = atom_words(session.stage().state(), atom, session.now(), language);
                response.on_hover_text_at_pointer(say!(
                    language,
                    "{words}\nClick to inspect pixel {x}, {y}",
                    "{words}\nClique para inspecionar o pixel {x}, {y}"
                ));
            }
        }
        let below = Rect::from_min_size(frame.left_bottom(), vec2(frame.width(), CONTROLS_HEIGHT_PT));
        self.blend_slider(ui, below, look, language);
    }

    /// Returns the layer over the render and its share, 0 to 1.
    pub fn shown(&self) -> (Layer, f32) {
        (self.layer, (self.blend / 100.0) as f32)
    }

    /// Shows the whole picture again.
    pub fn show_all(&mut self) {
        self.view = PictureView::default();
    }

    /// Whether only a part of the picture is visible.
    pub fn is_zoomed(&self) -> bool {
        !self.view.shows_all()
    }

    /// Says once how to move the camera, when a drag of the whole picture with the left button moves nothing.
    fn tell_of_camera(&mut self, response: &Response, session: &mut Session) {
        let moves_nothing = !self.moves_camera && self.view.shows_all() && !session.is_recorded();
        if moves_nothing && response.drag_started_by(PointerButton::Primary) && !self.has_told_of_camera {
            self.has_told_of_camera = true;
            session.note(word!(
                session.language(),
                "A drag with the right button turns the camera; C lets the left one do it too",
                "Arrastar com o botão direito gira a câmera; C faz isso também com o esquerdo"
            ));
        }
    }

    /// Moves the camera: a drag orbits round the point it looks at, Shift or the middle button pans, the wheel dollies.
    fn move_camera(&mut self, ui: &Ui, response: &Response, frame: Rect, session: &mut Session) {
        let by = response.drag_delta() / frame.height();
        let [primary, secondary, middle] = [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle]
            .map(|which| response.dragged_by(which));
        let shift = ui.input(|input| input.modifiers.shift);
        let [right, down] = [by.x, by.y].map(f64::from);
        let drags = secondary || middle || primary && self.moves_camera;
        if drags && by != Vec2::ZERO {
            match middle || shift {
                true => session.move_camera(|camera| camera.pan(-right, down)),
                false => session.move_camera(|camera| camera.orbit(-180.0 * right, 180.0 * down)),
            }
        }
        if response.hovered() && self.moves_camera {
            let scroll = ui.input(|input| input.smooth_scroll_delta.y);
            if scroll != 0.0 {
                session.move_camera(|camera| camera.dolly((f64::from(-scroll) * 0.003).exp()));
            }
        }
        session.settle_camera(drags);
        let preview = session.camera_preview();
        if self.preview.as_ref().map(|(shown, _)| Arc::as_ptr(shown)) != preview.map(Arc::as_ptr) {
            self.preview = preview.and_then(|preview| Some((Arc::clone(preview), texture_of(ui, preview)?)));
        }
    }

    /// Shows a strip with the controls of the camera and the button that moves it back.
    fn camera_strip(&self, ui: &mut Ui, frame: Rect, session: &mut Session, look: Look) {
        let language = session.language();
        let height = 4.0 * GRID;
        let strip = Rect::from_min_max(pos2(frame.left(), frame.bottom() - height), frame.max);
        ui.painter().rect_filled(strip, 0.0, look.ground.gamma_multiply(0.75));
        let inner = strip.shrink2(vec2(GRID, 0.0));
        ui.scope_builder(egui::UiBuilder::new().max_rect(inner), |ui| {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if session.is_camera_moved()
                    && widgets::button(
                        ui,
                        Some(Icon::Undo),
                        word!(language, "Camera back", "Câmera de volta"),
                        frame.width() > 300.0,
                        widgets::Emphasis::Quiet,
                    )
                    .on_hover_text(word!(
                        language,
                        "Back to the camera of the scene (Shift C)",
                        "Voltar à câmera da cena (Shift C)"
                    ))
                    .clicked()
                {
                    session.reset_camera();
                }
                if self.moves_camera {
                    let text = word!(
                        language,
                        "Drag: turn. Shift and drag: move. Wheel: nearer",
                        "Arrastar: girar. Com Shift: mover. Roda: aproximar"
                    );
                    let text = egui::RichText::new(text).font(theme::regular(theme::SMALL)).color(look.text);
                    ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                        ui.add(egui::Label::new(text).truncate());
                    });
                }
            });
        });
    }

    /// Zooms with the wheel and pans with a drag.
    fn zoom_and_pan(&mut self, ui: &Ui, response: &Response, size: Vec2, frame: Rect) {
        if let Some(at) = response.hover_pos() {
            let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta, input.zoom_delta()));
            let factor = (scroll.y * 0.005).exp() * pinch;
            if factor != 1.0 {
                self.view.zoom(factor, at, size, frame);
            }
        }
        if response.dragged() && !self.view.shows_all() {
            self.view.pan(response.drag_delta(), size, frame);
        }
    }

    /// Shows the camera button, the blend slider and the name of the layer.
    fn blend_slider(&mut self, ui: &mut Ui, row: Rect, look: Look, language: Language) {
        let (middle, font) = (row.center().y + GRID / 2.0, theme::regular(theme::SMALL));
        // A small picture has room for only one of both texts.
        let fits = row.width() > 30.0 * GRID;
        let mut left = row.left();
        if fits {
            let rect = Rect::from_min_size(pos2(left - 4.0, middle - 1.5 * GRID), Vec2::splat(3.0 * GRID));
            let response = ui.interact(rect, ui.scope_id().with("camera"), Sense::click());
            let name = word!(language, "Move the camera", "Mover a câmera");
            response.widget_info(|| WidgetInfo::selected(Role::Button, true, self.moves_camera, name));
            let ink = match (self.moves_camera, response.hovered() || response.has_focus()) {
                (true, _) => look.accent,
                (false, true) => look.text,
                (false, false) => look.quiet,
            };
            icons::paint(ui.painter(), Icon::Camera, rect.shrink(3.0), ink);
            let hint = word!(
                language,
                "Move the camera (C). A drag with the right button always moves it",
                "Mover a câmera (C). Arrastar com o botão direito sempre a move"
            );
            if response.on_hover_text(hint).clicked() {
                self.moves_camera = !self.moves_camera;
            }
            left += 3.5 * GRID;
        }
        if fits {
            let colour = look.quiet.lerp_to_gamma(look.text, 1.0 - self.blend as f32 / 100.0);
            let start = pos2(left, middle);
            let text = word!(language, "Render", "Imagem");
            left += ui.painter().text(start, Align2::LEFT_CENTER, text, font.clone(), colour).width() + 1.5 * GRID;
        }
        let colour = look.quiet.lerp_to_gamma(look.text, self.blend as f32 / 100.0);
        let right = self.choose_layer(
            ui,
            (pos2(row.right().max(row.left() + 13.0 * GRID), middle), fits),
            colour,
            look,
            language,
        ) - 1.5 * GRID;
        // A tiny picture has room for the name of the layer only.
        let width = right - left;
        if width < 5.0 * GRID {
            return;
        }
        let rect = Rect::from_min_size(pos2(left, middle - 1.25 * GRID), vec2(width, 2.5 * GRID));
        ui.scope_builder(egui::UiBuilder::new().max_rect(rect), |ui| {
            let name = word!(language, "Render or layer", "Imagem ou camada");
            slider(ui, &mut self.blend, Scale::Whole(0.0, 100.0), width, look.accent, name).on_hover_text(word!(
                language,
                "Blend the render with the layer over it",
                "Misturar a imagem com a camada sobre ela"
            ));
        });
    }

    /// Shows the name of the layer, a button for the next one, and the legend of its colours. Returns its left end.
    fn choose_layer(
        &mut self,
        ui: &Ui,
        (right, has_legend): (Pos2, bool),
        colour: Color32,
        look: Look,
        language: Language,
    ) -> f32 {
        let font = theme::regular(theme::SMALL);
        let mut x = right.x;
        if let Some([dark, light]) = self.layer.ends(language).filter(|_| self.blend > 0.0 && has_legend) {
            let draw = |x: f32, text: &str| {
                ui.painter().text(pos2(x, right.y), Align2::RIGHT_CENTER, text, font.clone(), look.quiet).left()
            };
            x = draw(x, light) - 4.0;
            for step in (0..24).rev() {
                let bar = Rect::from_min_max(pos2(x - 2.0, right.y - 5.0), pos2(x, right.y + 5.0));
                let rgb = Layer::ramp(f64::from(step) / 23.0);
                ui.painter().rect_filled(bar, 0.0, theme::colour(rgb));
                x -= 2.0;
            }
            x = draw(x - 4.0, dark) - GRID;
        }
        let galley = ui.painter().layout_no_wrap(self.layer.name(language).to_owned(), font, colour);
        let size = galley.size() + vec2(2.0 * GRID, 0.0);
        let rect = Rect::from_min_size(pos2(x - size.x, right.y - 1.5 * GRID), vec2(size.x, 3.0 * GRID));
        let response = ui.interact(rect, ui.scope_id().with("layer"), Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, self.layer.name(language)));
        if response.hovered() || response.has_focus() {
            ui.painter().rect_filled(rect, 4.0, look.raised);
        }
        ui.painter().galley(pos2(rect.left() + GRID, right.y - galley.size().y / 2.0), galley, colour);
        let hint = word!(
            language,
            "The layer over the render. Press for the next one (V)",
            "A camada sobre a imagem. Pressione para a próxima (V)"
        );
        if response.on_hover_text(hint).clicked() {
            self.next_layer();
        }
        rect.left()
    }

    /// Chooses the next layer, or shows the present one if it is invisible.
    pub fn next_layer(&mut self) {
        if self.blend > 0.0 {
            self.layer = widgets::cycle(&Layer::ALL, self.layer);
        } else {
            self.blend = 70.0;
        }
    }
}

/// Uploads a camera preview; `None` if it exceeds the largest texture.
fn texture_of(ui: &Ui, preview: &CameraPreview) -> Option<TextureHandle> {
    let (width, height) = (preview.shape.0 as usize, preview.shape.1 as usize);
    let max_side = ui.input(|input| input.max_texture_side);
    let image = || ColorImage::new([width, height], preview.pixels.iter().map(|&pixel| theme::colour(pixel)).collect());
    (width.max(height) <= max_side).then(|| ui.ctx().load_texture("moved", image(), TextureOptions::LINEAR))
}

/// The part of a camera preview's texture that fills the picture: the middle of its first texel is that of the first
/// pixel, and the next texel's middle is `step` pixels further.
fn place_in_texture(preview: &CameraPreview) -> Rect {
    let CameraPreview { size, step, shape, .. } = preview;
    let place = |pixel: f32, texels: u32| ((pixel - 0.5) / *step as f32 + 0.5) / texels as f32;
    let end = |side: u32, texels: u32| place(side as f32, texels);
    Rect::from_min_max(
        pos2(place(0.0, shape.0), place(0.0, shape.1)),
        pos2(end(size.width(), shape.0), end(size.height(), shape.1)),
    )
}

/// Returns column and row of the pixel at a position in the picture, in its pixels; the nearest one if it is outside.
fn pixel_at(session: &Session, at: Vec2) -> [u32; 2] {
    let size = session.header().size;
    [(at.x.max(0.0) as u32).min(size.width() - 1), (at.y.max(0.0) as u32).min(size.height() - 1)]
}

/// Paints outlines round atoms. `picture` is the rectangle of the whole picture, `scale` the side of a pixel.
fn outline(painter: &Painter, (picture, scale): (Rect, f32), session: &Session, atoms: &[Range<Atom>], line: f32) {
    let division = session.header().division;
    let width = session.header().size.width();
    for [x0, y0, x1, y1] in outlines(atoms.iter().map(|atoms| division.pixels_of(atoms)), width) {
        let [from, to] = [vec2(x0 as f32, y0 as f32), vec2(x1 as f32, y1 as f32)].map(|at| picture.min + at * scale);
        // White on black is visible on every picture.
        painter.line_segment([from, to], Stroke::new(line + 1.75, Color32::from_black_alpha(150)));
        painter.line_segment([from, to], Stroke::new(line, Color32::WHITE));
    }
}

/// Paints lines between the bands and, when zoomed in, between the atoms.
fn outline_all(painter: &Painter, (picture, scale): (Rect, f32), frame: Rect, session: &Session) {
    let (header, width) = (session.header(), session.header().size.width());
    if scale >= MIN_OUTLINED_ATOM_PT {
        let row = |y: f32| ((y - picture.top()) / scale).max(0.0) as u32;
        let rows = row(frame.top())..(row(frame.bottom()) + 1).min(header.size.height());
        let pixels = header.division.atom_pixels();
        for atom in rows.start * width / pixels..(rows.end * width).div_ceil(pixels).min(header.division.atoms()) {
            outline(painter, (picture, scale), session, std::slice::from_ref(&(atom..atom + 1)), 0.5);
        }
    }
    for band in header.division.bands(header.speeds.len()) {
        outline(painter, (picture, scale), session, std::slice::from_ref(&band), 1.0);
    }
}

/// Returns the atom of a pixel.
fn atom_at(session: &Session, [x, y]: [u32; 2]) -> Atom {
    (y * session.header().size.width() + x) / session.header().division.atom_pixels()
}

/// Paints a cross round a pixel of this side in points; the pixel itself stays visible.
fn cross_hair(painter: &Painter, centre: Pos2, side: f32) {
    let (inner, outer) = (side / 2.0 + 3.0, side / 2.0 + 12.0);
    // White on black is visible on every picture.
    for stroke in [Stroke::new(4.0, Color32::BLACK), Stroke::new(1.75, Color32::WHITE)] {
        for way in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
            painter.line_segment([centre + way * inner, centre + way * outer], stroke);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Size;

    #[test]
    fn traced_pixels_lie_in_the_middle_of_their_texels() {
        for step in [1, 2, 4, 16] {
            let size = Size::new(37, 20).expect("a small picture");
            let shape = (37_u32.div_ceil(step), 20_u32.div_ceil(step));
            let place = place_in_texture(&CameraPreview { size, step, shape, pixels: Vec::new() });
            for column in 0..shape.0 {
                let middle = ((column * step) as f32 + 0.5) / 37.0;
                let texel = (column as f32 + 0.5) / shape.0 as f32;
                assert!((place.left() + place.width() * middle - texel).abs() < 1e-6, "{column} at step {step}");
            }
            for row in 0..shape.1 {
                let middle = ((row * step) as f32 + 0.5) / 20.0;
                let texel = (row as f32 + 0.5) / shape.1 as f32;
                assert!((place.top() + place.height() * middle - texel).abs() < 1e-6, "{row} at step {step}");
            }
        }
    }
}

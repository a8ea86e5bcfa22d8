//! The picture, and how much of it is render and how much owners.

use std::ops::Range;
use std::sync::Arc;

use egui::{
    Align2, Color32, ColorImage, Painter, PointerButton, Pos2, Rect, Response, Role, Sense, Stroke, TextureHandle,
    TextureOptions, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use crate::gui::input::selection::Selection;
use crate::gui::session::{CameraPreview, Session};
use crate::gui::widgets;
use crate::gui::widgets::canvas_texture::CanvasTexture;
use crate::gui::widgets::icons::{self, Icon};
use crate::gui::widgets::picture_view::PictureView;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, say, word};
use crate::picture::Atom;
use crate::view::{Highlight, Layer, Subject, atom_words, outlines, percent};

/// What the panel needs below the picture, in points.
pub const BELOW: f32 = 5.0 * GRID;

/// The picture's texture, which lives as long as the window, and how the picture is looked at.
pub struct PicturePanel {
    texture: CanvasTexture,
    view: PictureView,
    /// What lies over the render.
    pub layer: Layer,
    /// 0 is the render, 100 the layer.
    pub blend: f64,
    /// Whether lines part the bands, and from near the atoms.
    pub outlines: bool,
    /// Whether a drag moves the camera.
    pub moves_camera: bool,
    /// What is about seen by a camera that moves.
    moved: Option<(Arc<CameraPreview>, TextureHandle)>,
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
            moved: None,
        }
    }
}

/// From this size on pixels are squares, in points.
const SQUARE: f32 = 3.0;
/// From this height on atoms, a pixel high, are parted by lines, in points.
const APART: f32 = 5.0;

impl PicturePanel {
    /// Shows the picture as large as it gets, and the slider below it.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session, focus: &mut Selection, lit: &Highlight) {
        let language = session.language();
        let look = Look::of(ui.ctx());
        let shown = self.shown();
        if self.moves_camera && session.is_recorded() {
            self.moves_camera = false;
            session.refuse_camera();
        }
        let canvas = session.stage_mut().canvas(shown, theme::rgb(look.ground));
        let size = vec2(canvas.size().width() as f32, canvas.size().height() as f32);
        let room = vec2(ui.available_width(), (ui.available_height() - BELOW).max(GRID));
        let fit = (room.x / size.x).min(room.y / size.y);
        let slack = (room - size * fit).max(Vec2::ZERO);
        let frame = Rect::from_min_size(ui.cursor().min + slack / 2.0, size * fit);
        let response = ui.allocate_rect(frame, Sense::click_and_drag());
        let moves = self.moves_camera || response.dragged_by(PointerButton::Secondary);
        if !moves {
            self.look_about(ui, &response, size, frame);
        }
        let (place, scale) = self.view.place(size, frame);
        let texture = self.texture.upload(ui.ctx(), canvas, scale >= SQUARE);
        self.move_camera(ui, &response, frame, session);
        let state = session.stage().state();
        widgets::describe(&response, word!(language, "Picture", "Imagem"), || {
            let done = percent(state.done(), state.atoms());
            say!(language, "{done} done", "{done} pronta")
        });
        let painter = ui.painter_at(frame);
        if let Some(texture) = texture {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(texture, place, whole, Color32::WHITE);
        }
        if let Some((_, texture)) = &self.moved {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(texture.id(), frame, whole, Color32::WHITE);
        }
        if self.moves_camera || session.is_camera_away() {
            self.camera_words(ui, frame, session, look);
        }
        if self.moved.is_some() {
            // Nothing of the run before is to be seen in it.
        } else if response.double_clicked() && !self.view.shows_all() {
            self.show_all();
            session.stop_inspecting();
        } else if response.clicked() {
            // Whoever has no pointer begins in the middle, and goes on with the arrows.
            let at = response.interact_pointer_pos().unwrap_or(frame.center());
            let [x, y] = pixel_at(session, (at - place.min) / scale);
            session.inspect([x, y]);
            focus.selected = Some(Subject::Atom(atom_at(session, [x, y])));
            response.surrender_focus();
        }
        if self.outlines {
            outlines_of_all(&painter, (place, scale), frame, session);
        }
        outline(&painter, (place, scale), session, &lit.atoms, 1.25);
        if let Some([x, y]) = session.inspected_place() {
            // Who traced it, and when, goes along from pixel to pixel.
            if let Some(Subject::Atom(atom)) = &mut focus.selected {
                *atom = atom_at(session, [x, y]);
            }
            cross_hair(&painter, place.min + (vec2(x as f32, y as f32) + Vec2::splat(0.5)) * scale, scale);
        }
        if let Some(at) = response.hover_pos() {
            let [x, y] = pixel_at(session, (at - place.min) / scale);
            let atom = atom_at(session, [x, y]);
            focus.hover(Subject::Atom(atom));
            if !self.moves_camera && !response.dragged() {
                let words = atom_words(session.stage().state(), atom, session.now(), language);
                response.on_hover_text_at_pointer(say!(
                    language,
                    "{words}\nClick to inspect pixel {x}, {y}",
                    "{words}\nClique para inspecionar o pixel {x}, {y}"
                ));
            }
        }
        let below = Rect::from_min_size(frame.left_bottom(), vec2(frame.width(), BELOW));
        self.blend_slider(ui, below, look, language);
    }

    /// What lies over the render, and how much of it is seen, 0 to 1.
    pub fn shown(&self) -> (Layer, f32) {
        (self.layer, (self.blend / 100.0) as f32)
    }

    /// All of the picture is seen again.
    pub fn show_all(&mut self) {
        self.view = PictureView::default();
    }

    /// Whether only a part of the picture is seen.
    pub fn is_zoomed(&self) -> bool {
        !self.view.shows_all()
    }

    /// A drag goes round what the camera looks at, or with Shift to and fro; the wheel comes nearer.
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
        let moved = session.moved();
        if self.moved.as_ref().map(|(shown, _)| Arc::as_ptr(shown)) != moved.map(Arc::as_ptr) {
            self.moved = moved.and_then(|moved| Some((Arc::clone(moved), texture_of(ui, moved)?)));
        }
    }

    /// What a hand does to the camera, and the way back.
    fn camera_words(&self, ui: &mut Ui, frame: Rect, session: &mut Session, look: Look) {
        let language = session.language();
        let height = 4.0 * GRID;
        let place = Rect::from_min_max(pos2(frame.left(), frame.bottom() - height), frame.max);
        ui.painter().rect_filled(place, 0.0, look.ground.gamma_multiply(0.75));
        let inner = place.shrink2(vec2(GRID, 0.0));
        ui.scope_builder(egui::UiBuilder::new().max_rect(inner), |ui| {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if session.is_camera_away()
                    && widgets::button(
                        ui,
                        Some(Icon::Undo),
                        word!(language, "Camera back", "Câmera de volta"),
                        frame.width() > 300.0,
                        widgets::Emphasis::Quiet,
                    )
                    .on_hover_text(word!(
                        language,
                        "The scene's own camera (Shift C)",
                        "A câmera da própria cena (Shift C)"
                    ))
                    .clicked()
                {
                    session.camera_home();
                }
                if self.moves_camera {
                    let text = word!(
                        language,
                        "Drag to turn, Shift to move, wheel: nearer",
                        "Arrastar gira, com Shift move; roda: mais perto"
                    );
                    let text = egui::RichText::new(text).font(theme::regular(theme::SMALL)).color(look.text);
                    ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                        ui.add(egui::Label::new(text).truncate());
                    });
                }
            });
        });
    }

    /// Nearer (more than 1) and further away, to and fro.
    fn look_about(&mut self, ui: &Ui, response: &Response, size: Vec2, frame: Rect) {
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

    fn blend_slider(&mut self, ui: &mut Ui, row: Rect, look: Look, language: Language) {
        let (middle, font) = (row.center().y + GRID / 2.0, theme::regular(theme::SMALL));
        // Under a small picture there is room for one of both words.
        let fits = row.width() > 30.0 * GRID;
        let mut left = row.left();
        if fits {
            let place = Rect::from_min_size(pos2(left - 4.0, middle - 1.5 * GRID), Vec2::splat(3.0 * GRID));
            let response = ui.interact(place, ui.scope_id().with("camera"), Sense::click());
            let name = word!(language, "Move the camera", "Mover a câmera");
            response.widget_info(|| WidgetInfo::selected(Role::Button, true, self.moves_camera, name));
            let ink = match (self.moves_camera, response.hovered() || response.has_focus()) {
                (true, _) => look.accent,
                (false, true) => look.text,
                (false, false) => look.quiet,
            };
            icons::paint(ui.painter(), Icon::Camera, place.shrink(3.0), ink);
            let hint = word!(
                language,
                "Move the camera (C), or drag with the right button at any time",
                "Mover a câmera (C), ou arrastar com o botão direito a qualquer momento"
            );
            if response.on_hover_text(hint).clicked() {
                self.moves_camera = !self.moves_camera;
            }
            left += 3.5 * GRID;
        }
        if fits {
            let colour = look.quiet.lerp_to_gamma(look.text, 1.0 - self.blend as f32 / 100.0);
            let place = pos2(left, middle);
            let text = word!(language, "Render", "Imagem");
            left += ui.painter().text(place, Align2::LEFT_CENTER, text, font.clone(), colour).width() + 1.5 * GRID;
        }
        let colour = look.quiet.lerp_to_gamma(look.text, self.blend as f32 / 100.0);
        let right = self.choose_layer(
            ui,
            (pos2(row.right().max(row.left() + 13.0 * GRID), middle), fits),
            colour,
            look,
            language,
        ) - 1.5 * GRID;
        // Under a tiny picture there is room for the layer's name only.
        let width = right - left;
        if width < 5.0 * GRID {
            return;
        }
        let place = Rect::from_min_size(pos2(left, middle - 1.25 * GRID), vec2(width, 2.5 * GRID));
        ui.scope_builder(egui::UiBuilder::new().max_rect(place), |ui| {
            let name = word!(language, "Render or layer", "Imagem ou camada");
            widgets::slider(ui, &mut self.blend, (0.0..=100.0, true), width, look.accent, name).on_hover_text(word!(
                language,
                "From the render to what lies over it",
                "Da imagem ao que está sobre ela"
            ));
        });
    }

    /// What lies over the render, and what its colours mean; a click goes on to the next. Returns where it begins.
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
            let word = |x: f32, text: &str| {
                ui.painter().text(pos2(x, right.y), Align2::RIGHT_CENTER, text, font.clone(), look.quiet).left()
            };
            x = word(x, light) - 4.0;
            for step in (0..24).rev() {
                let bar = Rect::from_min_max(pos2(x - 2.0, right.y - 5.0), pos2(x, right.y + 5.0));
                let rgb = Layer::ramp(f64::from(step) / 23.0);
                ui.painter().rect_filled(bar, 0.0, theme::colour(rgb));
                x -= 2.0;
            }
            x = word(x - 4.0, dark) - GRID;
        }
        let galley = ui.painter().layout_no_wrap(self.layer.name(language).to_owned(), font, colour);
        let size = galley.size() + vec2(2.0 * GRID, 0.0);
        let place = Rect::from_min_size(pos2(x - size.x, right.y - 1.5 * GRID), vec2(size.x, 3.0 * GRID));
        let response = ui.interact(place, ui.scope_id().with("layer"), Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, self.layer.name(language)));
        if response.hovered() || response.has_focus() {
            ui.painter().rect_filled(place, 4.0, look.raised);
        }
        ui.painter().galley(pos2(place.left() + GRID, right.y - galley.size().y / 2.0), galley, colour);
        let hint = word!(
            language,
            "What lies over the render: press for the next (V)",
            "A camada sobre a imagem: pressionar muda (V)"
        );
        if response.on_hover_text(hint).clicked() {
            self.next_layer();
        }
        place.left()
    }

    /// Goes on to the next layer; one that is not seen is.
    pub fn next_layer(&mut self) {
        if self.blend > 0.0 {
            self.layer = widgets::next_of(&Layer::ALL, self.layer);
        } else {
            self.blend = 70.0;
        }
    }
}

/// What is about seen by a camera that moves, for the graphics card; nothing if that is too large for it.
fn texture_of(ui: &Ui, moved: &CameraPreview) -> Option<TextureHandle> {
    let [width, height] = [moved.size.width(), moved.size.height()].map(|side| side as usize);
    let most = ui.input(|input| input.max_texture_side);
    let image = || ColorImage::new([width, height], moved.pixels.iter().map(|&pixel| theme::colour(pixel)).collect());
    (width.max(height) <= most).then(|| ui.ctx().load_texture("moved", image(), TextureOptions::LINEAR))
}

/// The pixel at a place in the picture, in pixels.
fn pixel_at(session: &Session, place: Vec2) -> [u32; 2] {
    let size = session.header().size;
    [(place.x.max(0.0) as u32).min(size.width() - 1), (place.y.max(0.0) as u32).min(size.height() - 1)]
}

/// Marks atoms by a line round them.
fn outline(painter: &Painter, (place, scale): (Rect, f32), session: &Session, atoms: &[Range<Atom>], line: f32) {
    let division = session.header().division;
    let width = session.header().size.width();
    for [x0, y0, x1, y1] in outlines(atoms.iter().map(|atoms| division.pixels_of(atoms)), width) {
        let [from, to] = [vec2(x0 as f32, y0 as f32), vec2(x1 as f32, y1 as f32)].map(|at| place.min + at * scale);
        // Seen on every picture.
        painter.line_segment([from, to], Stroke::new(line + 1.75, Color32::from_black_alpha(150)));
        painter.line_segment([from, to], Stroke::new(line, Color32::WHITE));
    }
}

/// Lines between the bands, and from near between the atoms.
fn outlines_of_all(painter: &Painter, (place, scale): (Rect, f32), frame: Rect, session: &Session) {
    let (header, width) = (session.header(), session.header().size.width());
    if scale >= APART {
        let row = |y: f32| ((y - place.top()) / scale).max(0.0) as u32;
        let rows = row(frame.top())..(row(frame.bottom()) + 1).min(header.size.height());
        let pixels = header.division.atom_pixels();
        for atom in rows.start * width / pixels..(rows.end * width).div_ceil(pixels).min(header.division.atoms()) {
            outline(painter, (place, scale), session, std::slice::from_ref(&(atom..atom + 1)), 0.5);
        }
    }
    for band in header.division.bands(header.speeds.len()) {
        outline(painter, (place, scale), session, std::slice::from_ref(&band), 1.0);
    }
}

/// The atom that a pixel is in.
fn atom_at(session: &Session, [x, y]: [u32; 2]) -> Atom {
    (y * session.header().size.width() + x) / session.header().division.atom_pixels()
}

/// Marks a pixel of so many points, and leaves it free.
fn cross_hair(painter: &Painter, centre: Pos2, side: f32) {
    let (inner, outer) = (side / 2.0 + 3.0, side / 2.0 + 12.0);
    // Seen on every picture.
    for stroke in [Stroke::new(4.0, Color32::BLACK), Stroke::new(1.75, Color32::WHITE)] {
        for way in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
            painter.line_segment([centre + way * inner, centre + way * outer], stroke);
        }
    }
}

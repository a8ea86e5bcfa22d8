//! The Scenes page: thumbnails of scenes, a path field and the file dialog.

use std::path::{Path, PathBuf};

use egui::{Align2, Color32, ColorImage, Label, Rect, RichText, ScrollArea, Sense, StrokeKind};
use egui::{TextureHandle, TextureOptions, Ui, WidgetInfo, pos2, vec2};

use crate::cancel::CancelOnDrop;
use crate::gui::session::Thumbnail;
use crate::gui::session::{Purpose, Session};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::path_input::{TypedPath, no_file_chosen, open_field};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button};
use crate::language::{say, word};
use crate::scene::BUILT_IN;

/// The Scenes page.
#[derive(Default)]
pub struct Gallery {
    open: bool,
    wants_focus: bool,
    path: TypedPath,
    trouble: Option<String>,
    tiles: Vec<Tile>,
    /// Dropping it ends the tracing of thumbnails, which would take a core from the run.
    tracing: Option<CancelOnDrop>,
}

/// A scene of the page.
struct Tile {
    /// Name or path of the scene.
    scene: PathBuf,
    thumbnail: TileThumbnail,
}

/// Thumbnail of a tile.
enum TileThumbnail {
    /// The picture is being traced.
    Pending,
    /// The picture is traced.
    Ready(TextureHandle),
    /// The scene cannot be traced, for this reason.
    Failed(String),
}

impl Gallery {
    /// Opens the page and starts the missing thumbnails, or closes it.
    pub fn toggle(&mut self, session: &Session) {
        let language = session.language();
        (self.wants_focus, self.trouble) = (!self.open, None);
        if self.open {
            return self.close();
        }
        self.open = true;
        let built_in = BUILT_IN.iter().map(|(name, _)| PathBuf::from(name));
        let recent = session.recent().iter().filter(|path| has_ending(path, "ron")).cloned();
        let mut scenes: Vec<_> = built_in.chain(recent).collect();
        for old in std::mem::take(&mut self.tiles) {
            // Only thumbnails of built-in scenes are kept, because a file may have changed.
            let is_built_in = BUILT_IN.iter().any(|(name, _)| old.scene.as_os_str() == *name);
            if is_built_in && matches!(old.thumbnail, TileThumbnail::Ready(_)) {
                scenes.retain(|scene| *scene != old.scene);
                self.tiles.push(old);
            }
        }
        self.tiles.extend(scenes.iter().map(|scene| Tile { scene: scene.clone(), thumbnail: TileThumbnail::Pending }));
        if !scenes.is_empty() {
            self.tracing = Some(session.jobs().thumbnails(scenes, language));
        }
    }

    /// Whether the page is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Closes the page.
    pub fn close(&mut self) {
        self.open = false;
        self.tracing = None;
    }

    /// Takes the thumbnail of a scene.
    pub fn take_thumbnail(&mut self, ctx: &egui::Context, scene: &Path, result: Result<Thumbnail, String>) {
        if let Some(tile) = self.tiles.iter_mut().find(|tile| tile.scene == scene) {
            tile.thumbnail = match result {
                Ok(Thumbnail { size, rgb }) => {
                    let image = ColorImage::from_rgb([size.width() as usize, size.height() as usize], &rgb);
                    TileThumbnail::Ready(ctx.load_texture(scene.to_string_lossy(), image, TextureOptions::LINEAR))
                }
                Err(why) => TileThumbnail::Failed(why),
            };
        }
    }

    /// Takes the result of the file dialog.
    pub fn take_chosen(&mut self, chosen: Option<PathBuf>, session: &mut Session) {
        let language = session.language();
        match chosen {
            Some(path) => {
                self.close();
                session.open(path);
            }
            None => self.trouble = Some(no_file_chosen(language).into()),
        }
    }

    /// Shows the page.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let look = Look::of(ui.ctx());
        self.path_row(ui, session, look);
        if let Some(trouble) = &self.trouble {
            let text = RichText::new(trouble).font(theme::regular(theme::BODY)).color(look.trouble);
            ui.add(Label::new(text).wrap());
        }
        ui.add_space(GRID);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| self.tiles(ui, session, look));
    }

    fn path_row(&mut self, ui: &mut Ui, session: &mut Session, look: Look) {
        let language = session.language();
        ui.horizontal(|ui| {
            ui.label(
                RichText::new(word!(language, "Scenes", "Cenas")).font(theme::strong(theme::LARGE)).color(look.text),
            );
            ui.add_space(GRID);
            let width = (ui.available_width() - 26.0 * GRID).max(16.0 * GRID);
            let hint = word!(
                language,
                "path of a scene or lesson (.ron), or of a run (.anel)",
                "caminho de uma cena ou lição (.ron), ou execução (.anel)"
            );
            let name = word!(language, "Path of the file to open", "Caminho do arquivo a abrir");
            let field = open_field(ui, (self.path.text_mut(), hint), width, name, &mut self.wants_focus);
            if field.changed {
                self.trouble = None;
            }
            if button(ui, None, word!(language, "Open", "Abrir"), true, Emphasis::Primary).clicked() || field.entered {
                match self.path.resolve(std::env::home_dir(), language) {
                    Ok(path) => {
                        self.close();
                        // Next time a full path that is typed behind its directory is told from it.
                        self.path.set(path.clone());
                        session.open(path);
                    }
                    Err(why) => self.trouble = Some(why),
                }
            }
            if button(ui, None, word!(language, "Browse…", "Procurar…"), true, Emphasis::Quiet).clicked() {
                let directory = std::env::current_dir().unwrap_or_default();
                session.jobs().choose_file(Purpose::Open, directory.join("scene"), language);
            }
            if button(ui, Some(Icon::Close), word!(language, "Close scenes", "Fechar cenas"), false, Emphasis::Quiet)
                .clicked()
            {
                self.close();
            }
        });
        ui.horizontal(|ui| {
            let text = word!(
                language,
                "You can also drop a file on the window.",
                "Você também pode soltar um arquivo na janela."
            );
            ui.label(RichText::new(text).font(theme::regular(theme::SMALL)).color(look.quiet));
            let last = session.recent().iter().find(|path| has_ending(path, "anel") && path.is_file()).cloned();
            if let Some(last) = last {
                let file = last.file_name().unwrap_or(last.as_os_str()).to_string_lossy();
                let name = say!(language, "Open the last saved run: {file}", "Abrir a última execução salva: {file}");
                if button(ui, None, &name, true, Emphasis::Quiet).on_hover_text(last.to_string_lossy()).clicked() {
                    self.close();
                    session.open(last);
                }
            }
        });
    }

    /// Shows the tiles. A click opens the scene.
    fn tiles(&mut self, ui: &mut Ui, session: &mut Session, look: Look) {
        let language = session.language();
        const MIN_TILE_WIDTH_PT: f32 = 34.0 * GRID;
        const GAP_PT: f32 = 2.0 * GRID;
        let room = ui.available_width() - GRID;
        let columns = (((room + GAP_PT) / (MIN_TILE_WIDTH_PT + GAP_PT)) as usize).clamp(1, 5);
        let width = (room + GAP_PT) / columns as f32 - GAP_PT;
        let (height, caption) = (width * 0.75, 4.0 * GRID);
        let lines = self.tiles.len().div_ceil(columns);
        let (area, _) = ui.allocate_exact_size(vec2(room, lines as f32 * (height + caption + GAP_PT)), Sense::hover());
        let mut opened = None;
        for (i, tile) in self.tiles.iter().enumerate() {
            let corner = area.min
                + vec2((i % columns) as f32 * (width + GAP_PT), (i / columns) as f32 * (height + caption + GAP_PT));
            let rect = Rect::from_min_size(corner, vec2(width, height + caption));
            let response = ui.interact(rect, ui.scope_id().with(("tile", &tile.scene)), Sense::click());
            let name = name_of(&tile.scene);
            let open = say!(language, "Open {name}", "Abrir {name}");
            response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, &open));
            let picture = rect.with_max_y(rect.top() + height);
            let painter = ui.painter();
            painter.rect_filled(picture, 6.0, look.raised);
            match &tile.thumbnail {
                TileThumbnail::Ready(texture) => {
                    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                    painter.image(texture.id(), picture, whole, Color32::WHITE);
                }
                TileThumbnail::Pending => {
                    let (at, font) = (picture.center(), theme::regular(theme::SMALL));
                    let text = word!(language, "is being traced …", "está sendo calculada …");
                    painter.text(at, Align2::CENTER_CENTER, text, font, look.quiet);
                }
                TileThumbnail::Failed(why) => {
                    let font = theme::regular(theme::SMALL);
                    let colour = look.trouble;
                    let galley = painter.layout(why.clone(), font, colour, width - 2.0 * GRID);
                    painter.with_clip_rect(picture).galley(picture.min + vec2(GRID, GRID), galley, colour);
                }
            }
            let is_open = session.header().scene == name;
            let line = match (is_open, response.hovered() || response.has_focus()) {
                (_, true) => Some((2.0, look.accent)),
                (true, false) => Some((2.0, look.text)),
                _ => None,
            };
            if let Some((width, colour)) = line {
                painter.rect_stroke(picture, 6.0, egui::Stroke::new(width, colour), StrokeKind::Outside);
            }
            let at = pos2(rect.left(), rect.bottom() - caption / 2.0);
            painter.text(at, Align2::LEFT_CENTER, &name, theme::strong(theme::BODY), look.text);
            if response.on_hover_text(tile.scene.to_string_lossy()).clicked() {
                opened = Some(tile.scene.clone());
            }
        }
        if let Some(scene) = opened {
            self.close();
            session.open(scene);
        }
    }
}

/// Returns the name of a scene: its file name without the extension.
fn name_of(scene: &Path) -> String {
    scene.file_stem().unwrap_or(scene.as_os_str()).to_string_lossy().into_owned()
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|extension| extension == ending)
}

//! The preview of the file that the save sheet would write.

use std::mem::discriminant;
use std::time::Duration;

use egui::{
    Color32, ColorImage, Label, Rect, RichText, Sense, TextureHandle, TextureOptions, Ui, UiBuilder, pos2, vec2,
};

use crate::cancel::CancelOnDrop;
use crate::export::Drawing;
use crate::gui::session::{Export, ExportPreview, Phase, Session};
use crate::gui::widgets;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, word};

/// Seconds between two previews of one file.
const INTERVAL_S: f64 = 0.25;
/// The same while the run needs the cores.
const RUNNING_INTERVAL_S: f64 = 1.5;

/// The preview, kept between frames.
#[derive(Default)]
pub(super) struct Preview {
    shown: Option<(PreviewKey, Result<Option<PreviewPicture>, String>)>,
    job: Option<(u64, PreviewKey, CancelOnDrop)>,
    /// egui's clock when the last job was started, in seconds.
    started: f64,
}

/// All that a preview depends on.
#[derive(Clone, PartialEq)]
struct PreviewKey {
    export: Export,
    run: usize,
    records: usize,
}

/// A preview on the screen.
struct PreviewPicture {
    texture: TextureHandle,
    /// Width and height of the file: in pixels, or in the units of a drawing.
    whole: [u32; 2],
}

impl PreviewKey {
    fn new(export: Export, session: &Session) -> Self {
        let changes = matches!(export, Export::Shown(_) | Export::Drawing(_) | Export::Film(_));
        let records = if changes { session.stage().log.records().len() } else { 0 };
        Self { export, run: session.runs_begun(), records }
    }

    fn is_of_same_kind(&self, other: &Self) -> bool {
        let kind = |key: &Self| match &key.export {
            Export::Drawing(drawing) => (discriminant(&key.export), Some(discriminant(drawing))),
            export => (discriminant(export), None),
        };
        kind(self) == kind(other) && self.run == other.run
    }
}

impl Preview {
    /// Takes the result of a job.
    pub fn take(&mut self, ctx: &egui::Context, job: u64, made: Result<Option<ExportPreview>, String>) {
        let Some((_, key, _)) = self.job.take_if(|(number, ..)| *number == job) else { return };
        let picture = made.map(|made| {
            made.map(|ExportPreview { size, rgb, whole }| {
                let image = ColorImage::from_rgb([size.width() as usize, size.height() as usize], &rgb);
                PreviewPicture { texture: ctx.load_texture("preview", image, TextureOptions::LINEAR), whole }
            })
        });
        self.shown = Some((key, picture));
    }

    /// Returns width and height of the file; `None` until they are known.
    pub fn whole(&self) -> Option<[u32; 2]> {
        let (_, picture) = self.shown.as_ref()?;
        picture.as_ref().ok()?.as_ref().map(|picture| picture.whole)
    }

    /// Starts the job of a new preview where one is due.
    fn update(&mut self, ui: &Ui, export: &Export, max_side: u32, session: &mut Session) {
        let key = PreviewKey::new(export.clone(), session);
        self.shown.take_if(|(shown, _)| !shown.is_of_same_kind(&key));
        let last = self.job.as_ref().map(|(_, key, _)| key).or(self.shown.as_ref().map(|(key, _)| key));
        let is_same_kind = last.is_some_and(|last| last.is_of_same_kind(&key));
        if last == Some(&key) || is_same_kind && self.job.is_some() {
            return;
        }
        let runs = session.stage().phase == Phase::Running && !session.stage().paused;
        let interval = if runs { RUNNING_INTERVAL_S } else { INTERVAL_S };
        let now = ui.input(|input| input.time);
        let wait = self.started + interval - now;
        if is_same_kind && wait > 0.0 {
            return ui.ctx().request_repaint_after(Duration::from_secs_f64(wait));
        }
        let (job, owner) = session.preview_export(export.clone(), max_side);
        (self.job, self.started) = (Some((job, key, owner)), now);
    }

    /// Shows the preview of `export` in an area of this height: a picture, or what is `said` of a file without one.
    pub fn show(&mut self, ui: &mut Ui, export: Result<&Export, &str>, said: &str, height: f32, session: &mut Session) {
        let language = session.language();
        let look = Look::of(ui.ctx());
        let (area, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
        if export.is_ok_and(has_no_picture) {
            (self.shown, self.job) = (None, None);
        }
        widgets::describe(&response, word!(language, "Preview", "Prévia"), || match self.whole() {
            Some([width, height]) => format!("{width} × {height}"),
            None => said.to_owned(),
        });
        ui.painter().rect_filled(area, 6.0, look.raised);
        let export = match export {
            Ok(export) => export,
            Err(why) => return words(ui, area, why, look.trouble),
        };
        if has_no_picture(export) {
            return words(ui, area, said, look.text);
        }
        self.update(ui, export, (area.width() * ui.ctx().pixels_per_point()) as u32, session);
        match &self.shown {
            Some((_, Ok(Some(picture)))) => paint(ui, area, picture),
            Some((_, Err(why))) => words(ui, area, why, look.trouble),
            _ => words(ui, area, drawing_words(language), look.quiet),
        }
    }
}

/// Whether a file holds no picture.
fn has_no_picture(export: &Export) -> bool {
    matches!(export, Export::Run | Export::Table | Export::Chrome | Export::Rows(_))
}

fn drawing_words(language: Language) -> &'static str {
    word!(language, "The preview is being drawn …", "A prévia está sendo desenhada …")
}

/// Paints the picture as large as it fits.
fn paint(ui: &Ui, area: Rect, picture: &PreviewPicture) {
    let inner = area.shrink(GRID / 2.0);
    let size = picture.texture.size_vec2();
    let scale = (inner.width() / size.x).min(inner.height() / size.y);
    let rect = Rect::from_center_size(inner.center(), size * scale);
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    ui.painter().image(picture.texture.id(), rect, whole, Color32::WHITE);
}

/// Shows a text in the middle of the area.
fn words(ui: &mut Ui, area: Rect, text: &str, colour: Color32) {
    let inner = area.shrink(1.5 * GRID);
    let font = theme::regular(theme::BODY);
    let height = ui.painter().layout(text.to_owned(), font.clone(), colour, inner.width()).size().y;
    let rect = inner.with_min_y((inner.center().y - height / 2.0).max(inner.top()));
    // A scope would move what follows into the area.
    let mut within = ui.new_child(UiBuilder::new().max_rect(rect));
    within.vertical_centered(|ui| ui.add(Label::new(RichText::new(text).font(font).color(colour)).wrap()));
}

/// Returns width and height of a drawing's file in pixels, if it becomes a PNG.
pub(super) fn png_size(whole: [u32; 2]) -> [u32; 2] {
    whole.map(|side| (side as f32 * Drawing::PNG_SCALE).round() as u32)
}

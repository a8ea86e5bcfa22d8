//! The picture that is traced again to be saved: its size, its samples, its region, its background.

use egui::{Label, RichText, Ui};

use super::kinds::{FOUR_K, FULL_HD, MAX_SIDE_PX, has_same_shape, large};
use crate::gui::session::{PictureExport, Session};
use crate::gui::widgets::path_input::path_field;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, live_number_field};
use crate::language::{Language, word};
use crate::picture::{Quality, Region};

/// Width of a field for a side, in points.
const FIELD_WIDTH_PT: f32 = 8.0 * GRID;

/// The user's choices.
#[derive(Clone)]
pub(super) struct RetracedPicture {
    /// The size, once the user has chosen one.
    size: Option<[u32; 2]>,
    /// The samples, n of n × n a pixel.
    samples: u32,
    /// The region as it is typed; empty for the whole picture.
    region: String,
    /// Whether the background is left out.
    transparent: bool,
}

impl Default for RetracedPicture {
    fn default() -> Self {
        Self { size: None, samples: 2, region: String::new(), transparent: false }
    }
}

impl RetracedPicture {
    /// Shows the fields.
    pub fn show(&mut self, ui: &mut Ui, session: &Session) {
        let language = session.language();
        let own = own_size(session);
        let mut size = self.size(session);
        ui.horizontal(|ui| self.sizes(ui, own, &mut size, language));
        ui.horizontal(|ui| {
            let [across, down] =
                word!(language, ["Pixels across", "Pixels down"], ["Pixels na horizontal", "Pixels na vertical"]);
            let [width, height] = &mut size;
            live_number_field(ui, width, 1..=MAX_SIDE_PX, "", FIELD_WIDTH_PT, (across, language));
            ui.label(quiet(ui, "×"));
            live_number_field(ui, height, 1..=MAX_SIDE_PX, "", FIELD_WIDTH_PT, (down, language));
            ui.label(quiet(ui, word!(language, "samples n × n:", "amostras n × n:")));
            let samples = word!(language, "Samples a pixel", "Amostras por pixel");
            live_number_field(ui, &mut self.samples, 1..=16, "", 5.0 * GRID, (samples, language));
        });
        if size != self.size(session) {
            self.size = Some(size);
        }
        ui.horizontal(|ui| self.extent(ui, language));
        if !has_same_shape(own, size) {
            let words = word!(
                language,
                "The shape differs from the picture's: the sides show more or less",
                "O formato difere do da imagem: os lados mostram mais ou menos"
            );
            let words = RichText::new(words).font(theme::regular(theme::SMALL)).color(Look::of(ui.ctx()).quiet);
            ui.add(Label::new(words).wrap());
        }
    }

    /// Shows a button for each usual size.
    fn sizes(&self, ui: &mut Ui, own: [u32; 2], size: &mut [u32; 2], language: Language) {
        let own_size = word!(language, "Own size", "Seu tamanho");
        let usual = [(own_size, own), ("× 2", own.map(|side| 2 * side)), ("1080p", FULL_HD), ("4K", FOUR_K)];
        for (name, other) in usual {
            let emphasis = if *size == other { Emphasis::On } else { Emphasis::Quiet };
            let [width, height] = other;
            if button(ui, None, name, true, emphasis).on_hover_text(format!("{width} × {height}")).clicked() {
                *size = other;
            }
        }
    }

    /// Shows the button that leaves out the background, and the field for the region.
    fn extent(&mut self, ui: &mut Ui, language: Language) {
        let emphasis = if self.transparent { Emphasis::On } else { Emphasis::Quiet };
        let hint = word!(
            language,
            "Leave out the background: the picture is transparent where no solid is",
            "Sem o fundo: a imagem é transparente onde não há sólido"
        );
        let name = word!(language, "Transparent", "Transparente");
        if button(ui, None, name, true, emphasis).on_hover_text(hint).clicked() {
            self.transparent = !self.transparent;
        }
        ui.label(quiet(ui, word!(language, "region:", "região:")));
        let name = word!(
            language,
            "Region: column, row, width, height; empty for the whole picture",
            "Região: coluna, linha, largura, altura; vazio para a imagem inteira"
        );
        let width = (ui.available_width() - 2.0 * GRID).min(20.0 * GRID);
        path_field(ui, (&mut self.region, "X,Y,W,H"), width, name, &mut false);
    }

    /// Returns what is to be traced.
    ///
    /// # Errors
    /// A sentence, if the size is impossible, or if the region is not inside the picture.
    pub fn export(&self, session: &Session) -> Result<PictureExport, String> {
        let size = large(self.size(session))?;
        let region = match self.region.trim() {
            "" => None,
            typed => Some(typed.parse::<Region>()?),
        };
        region.map_or(Ok(()), |region| region.check_inside(size))?;
        let quality = Quality { samples: self.samples, ..session.header().quality };
        Ok(PictureExport { size, quality, region, transparent: self.transparent })
    }

    /// Returns the part of a file name that tells this picture from others.
    pub fn name(&self, session: &Session) -> String {
        let [width, height] = self.size(session);
        let region = if self.region.trim().is_empty() { "" } else { "-region" };
        let transparent = if self.transparent { "-transparent" } else { "" };
        format!("{width}x{height}{region}{transparent}")
    }

    /// Returns the size: the chosen one, else twice the picture's own.
    fn size(&self, session: &Session) -> [u32; 2] {
        self.size.unwrap_or_else(|| own_size(session).map(|side| 2 * side))
    }
}

/// Returns the size of the shown picture.
fn own_size(session: &Session) -> [u32; 2] {
    let size = session.header().size;
    [size.width(), size.height()]
}

fn quiet(ui: &Ui, text: &str) -> RichText {
    RichText::new(text).font(theme::regular(theme::BODY)).color(Look::of(ui.ctx()).quiet)
}

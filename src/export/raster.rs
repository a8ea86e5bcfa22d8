//! Renders SVG to pixels.

use std::collections::BTreeSet;

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};
use skrifa::{FontRef, MetadataProvider};

use super::ExportError;
use crate::font::{PLEX, PLEX_NAME, missing_letters, system_font};
use crate::picture::Size;

/// Renders SVG in the program's own typeface. The computer's fonts serve only for letters that it lacks.
pub struct Raster {
    options: Options<'static>,
    missing: BTreeSet<char>,
}

impl Raster {
    /// Loads the font, and the computer's fonts for all letters of `text` that it lacks.
    pub fn new(text: &str) -> Self {
        let mut fonts = fontdb::Database::new();
        fonts.load_font_source(fontdb::Source::Binary(Arc::new(PLEX)));
        fonts.set_sans_serif_family(PLEX_NAME);
        let mut missing = BTreeSet::new();
        for letter in missing_letters(text) {
            if has_letter(&fonts, letter) {
                continue;
            }
            match system_font(letter) {
                Some(font) => _ = fonts.load_font_source(fontdb::Source::Binary(Arc::new(font.data))),
                None => _ = missing.insert(letter),
            }
        }
        let options = Options { font_family: PLEX_NAME.into(), fontdb: Arc::new(fonts), ..Options::default() };
        Self { options, missing }
    }

    /// Returns the letters that no font has; they are drawn as boxes.
    pub fn missing(&self) -> &BTreeSet<char> {
        &self.missing
    }

    /// Renders an SVG text, scaled by `scale`, and returns size and pixels: three bytes each, sRGB, in scan order.
    ///
    /// # Errors
    /// An [`ExportError`], if the text is not SVG or the drawing is too large.
    pub fn draw(&self, svg: &str, scale: f32) -> Result<(Size, Vec<u8>), ExportError> {
        let tree = Tree::from_str(svg, &self.options)?;
        let side = |length: f32| (length * scale).round() as u32;
        let size = Size::new(side(tree.size().width()), side(tree.size().height()));
        let size = size.map_err(|error| ExportError::Size(error.into()))?;
        let mut pixels = Pixmap::new(size.width(), size.height()).ok_or(ExportError::TooLarge(size))?;
        // Unpainted areas are white paper.
        pixels.fill(resvg::tiny_skia::Color::WHITE);
        resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
        // On white no pixel is transparent.
        let rgb = pixels.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect();
        Ok((size, rgb))
    }
}

fn has_letter(fonts: &fontdb::Database, letter: char) -> bool {
    let has =
        |data: &[u8], index| FontRef::from_index(data, index).is_ok_and(|font| font.charmap().map(letter).is_some());
    fonts.faces().any(|face| fonts.with_face_data(face.id, has).unwrap_or(false))
}

#[cfg(test)]
mod tests {
    use super::super::to_svg;
    use super::*;
    use crate::palette::PRINT;
    use crate::view::{Anchor, Hue, Mark, TextSize};

    #[test]
    fn marks_are_drawn_at_their_places() {
        let disc = Mark::Disc { centre: [30.0, 20.0], radius: 10.0, ink: Hue::Text.full() };
        let (size, rgb) = Raster::new("").draw(&to_svg(&[disc], [60.0, 40.0]), 2.0).expect("a drawing");
        assert_eq!((size.width(), size.height()), (120, 80));
        let at = |x: usize, y: usize| [0, 1, 2].map(|channel| rgb[3 * (120 * y + x) + channel]);
        assert_eq!([at(60, 40), at(75, 40)], [PRINT.text; 2]);
        assert_eq!([at(5, 5), at(85, 40), at(60, 65)], [PRINT.ground; 3]);
    }

    /// Counts the pixels of a text that are not white.
    fn ink(text: &str, size: TextSize) -> usize {
        let (at, anchor, ink) = ([5.0, 20.0], Anchor::Left, Hue::Text.full());
        let label = Mark::Label { at, anchor, text: text.into(), size, ink };
        let (_, rgb) = Raster::new("").draw(&to_svg(&[label], [200.0, 40.0]), 1.0).expect("a drawing");
        rgb.chunks(3).filter(|pixel| *pixel != [0xff; 3]).count()
    }

    #[test]
    fn text_is_drawn_without_system_fonts() {
        assert!(ink("ring", TextSize::Body(1.0)) > 100);
        assert_eq!(ink("", TextSize::Body(1.0)), 0);
        assert!(ink("ring", TextSize::Fit(13.0)) > ink("ring", TextSize::Small(1.0)), "bold is wider");
        // The font has these characters and draws no replacement boxes.
        assert_ne!(
            ink("→ × … µ", TextSize::Body(1.0)),
            ink("\u{10fffe} \u{10fffe} \u{10fffe} \u{10fffe}", TextSize::Body(1.0))
        );
    }

    /// Which letters the computer's fonts have is unknown; each letter is either drawn or reported.
    #[test]
    fn letter_that_the_font_lacks_is_drawn_or_reported() {
        for letter in ['日', 'ก', 'א', '\u{10fffe}'] {
            let (at, anchor, ink) = ([5.0, 20.0], Anchor::Left, Hue::Text.full());
            let label = Mark::Label { at, anchor, text: letter.into(), size: TextSize::Body(1.0), ink };
            let (raster, plain) = (Raster::new(&letter.to_string()), Raster::new(""));
            let svg = to_svg(&[label], [60.0, 40.0]);
            let is_as_without_fonts = raster.draw(&svg, 1.0).unwrap() == plain.draw(&svg, 1.0).unwrap();
            assert_eq!(is_as_without_fonts, raster.missing().contains(&letter), "{letter:?}");
        }
    }

    #[test]
    fn text_that_is_not_svg_is_refused() {
        assert!(Raster::new("").draw("no svg", 1.0).is_err_and(|error| error.to_string().contains("not SVG")));
    }
}

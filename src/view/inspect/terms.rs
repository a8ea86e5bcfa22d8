//! The terms of the illumination equation with their numbers.
//!
//! Cp = Ka Ia + Kd Σ Il (N·L) + Ks Σ Il (S·R)ⁿ + Ks Is + Kt It (§3).

use std::ops::Range;

use glam::DVec3;

use super::{Inspected, brightness, label, line, shown, swatch};
use crate::language::{Language, decimal, word};
use crate::tracer::RayKind;
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point};
use crate::view::text::format::fine_fraction;

/// A term of the equation for one ray.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// The term as the article writes it.
    pub formula: &'static str,
    /// Name of the term.
    pub meaning: &'static str,
    /// Its contribution to the ray's colour, in linear light.
    pub colour: DVec3,
    /// Part of the pixel's luminance that comes by it; `None` if the pixel is black.
    pub part: Option<f64>,
}

/// A drawn table of terms.
#[derive(Clone, Debug, PartialEq)]
pub struct Terms {
    /// Marks of the drawing.
    pub marks: Vec<Mark>,
    /// The height at which each term begins and ends, and its formula with its name.
    pub rows: Vec<(Range<f32>, String)>,
    /// Height of the drawing.
    pub height: f32,
}

impl Inspected {
    /// Returns the terms of the chosen ray and their sum at the end; for a ray that met nothing, only the background.
    pub fn terms(&self, language: Language) -> Vec<Term> {
        let (sample, ray) = (self.sample(), self.ray());
        let whole = brightness(self.colour());
        let term = |formula, meaning, colour: DVec3| {
            let counts = brightness(colour * ray.path.factor) * sample.share(&self.samples);
            Term { formula, meaning, colour, part: (whole > 0.0).then(|| counts / whole) }
        };
        if ray.met.is_none() {
            return vec![term("Cp", word!(language, "background", "fundo"), ray.ambient)];
        }
        let follows = |kind| {
            let own = |place: &usize| {
                let path = &sample.rays[*place].path;
                path.kind == kind && path.from == Some(self.chosen.ray as u64)
            };
            let brings = (0..sample.rays.len()).filter(own).map(|place| sample.contribution_of(place));
            let factor = ray.path.factor;
            // What does not reach the eye at all brings nothing.
            DVec3::select(factor.cmpgt(DVec3::ZERO), brings.sum::<DVec3>() / factor, DVec3::ZERO)
        };
        let diffuse = ray.lights.iter().map(|lit| lit.diffuse()).sum();
        let specular = ray.lights.iter().map(|lit| lit.specular()).sum();
        let [reflected, refracted] = [RayKind::Reflected, RayKind::Refracted].map(follows);
        vec![
            term("Ka Ia", word!(language, "ambient", "ambiente"), ray.ambient),
            term("Kd Σ Il (N·L)", word!(language, "diffuse", "difusa"), diffuse),
            term("Ks Σ Il (S·R)^n", word!(language, "highlights", "especular"), specular),
            term("Ks Is", word!(language, "reflected", "refletida"), reflected),
            term("Kt It", word!(language, "transmitted", "refratada"), refracted),
            term("Cp", word!(language, "the sum", "a soma"), ray.ambient + diffuse + specular + reflected + refracted),
        ]
    }

    /// Draws the terms as a table: formula, colour, red, green, blue, and part of the pixel.
    pub fn draw_terms(&self, width: f32, language: Language) -> Terms {
        const ROW_HEIGHT: f32 = 24.0;
        let terms = self.terms(language);
        // From right to left: part of the pixel, three numbers, colour.
        let column = ((width - FORMULA_WIDTH - SWATCH_WIDTH - PART_WIDTH) / 3.0).clamp(32.0, 56.0);
        let decimals = if column < 46.0 { 2 } else { 3 };
        let blue = width - PART_WIDTH;
        let places = [blue - 2.0 * column, blue - column, blue];
        let swatch_at = places[0] - column - SWATCH_WIDTH / 2.0 + 6.0;
        let (mut marks, mut rows) = (Vec::new(), Vec::new());
        let colours = word!(language, ["red", "green", "blue"], ["verm.", "verde", "azul"]);
        for (name, x) in colours.into_iter().zip(places).chain([(word!(language, "of pixel", "do pixel"), width)]) {
            marks.push(label([x, ROW_HEIGHT / 2.0], Anchor::Right, name, Hue::Quiet));
        }
        for (index, term) in terms.iter().enumerate() {
            let y = ROW_HEIGHT * (index as f32 + 1.5);
            rows.push((y - ROW_HEIGHT / 2.0..y + ROW_HEIGHT / 2.0, format!("{}: {}", term.formula, term.meaning)));
            let is_sum = index + 1 == terms.len();
            let hue = if is_sum || term.colour != DVec3::ZERO { Hue::Text } else { Hue::Quiet };
            if is_sum {
                let y = y - ROW_HEIGHT / 2.0;
                marks.push(line([[0.0, y], [width, y]], 1.0, Hue::Hairline.full()));
            }
            marks.push(label([0.0, y], Anchor::Left, term.formula, hue));
            if swatch_at - FORMULA_WIDTH > MEANING_WIDTH {
                marks.push(label([FORMULA_WIDTH, y], Anchor::Left, term.meaning, Hue::Quiet));
            }
            let middle: Point = [swatch_at, y];
            marks.extend(swatch(middle, [8.0, 7.0], shown(term.colour)));
            for (value, x) in term.colour.to_array().into_iter().zip(places) {
                marks.push(label([x, y], Anchor::Right, decimal(language, value, decimals), hue));
            }
            let part = term.part.map_or_else(|| "–".to_owned(), |part| fine_fraction(part, language));
            marks.push(label([width, y], Anchor::Right, part, hue));
        }
        Terms { marks, rows, height: ROW_HEIGHT * (terms.len() as f32 + 1.0) }
    }
}

/// Least width of the column of formulas.
const FORMULA_WIDTH: f32 = 116.0;
/// Least width of the column of names.
const MEANING_WIDTH: f32 = 90.0;
/// Width of the column of colours.
const SWATCH_WIDTH: f32 = 28.0;
/// Width of the column of parts.
const PART_WIDTH: f32 = 66.0;

#[cfg(test)]
mod tests {
    use super::super::ChosenRay;
    use super::super::tests::{assert_within, each};
    use super::*;
    use crate::picture::Quality;

    #[test]
    fn terms_add_up_to_the_light_of_each_ray() {
        let language = Language::English;
        each(Quality::default(), |tracer, inspected| {
            for ray in 0..inspected.sample().rays.len().min(5) {
                let one = inspected.choose(tracer, ChosenRay { sample: 0, ray }).expect("a ray of it");
                let terms = one.terms(language);
                let (sum, others) = terms.split_last().expect("at least the sum");
                let brings = one.sample().contribution_of(ray);
                let scale = 1e-12 * (1.0 + brings.length());
                assert!((sum.colour * one.ray().path.weight).abs_diff_eq(brings, scale), "{terms:?}");
                if one.ray().met.is_some() {
                    let added: DVec3 = others.iter().map(|term| term.colour).sum();
                    assert!(added.abs_diff_eq(sum.colour, 1e-12 * (1.0 + added.length())), "{terms:?}");
                    assert_eq!(others.len(), 5);
                }
            }
        });
    }

    #[test]
    fn primary_rays_of_all_samples_add_up_to_the_pixel() {
        let language = Language::English;
        let quality = Quality { samples: 4, threshold: 0.02, ..Quality::default() };
        each(quality, |tracer, inspected| {
            let part = |sample| {
                let one = inspected.choose(tracer, ChosenRay { sample, ray: 0 }).expect("a primary ray");
                one.terms(language).last().and_then(|term| term.part).unwrap_or_default()
            };
            let all: f64 = (0..inspected.samples.len()).map(part).sum();
            assert!((all - 1.0).abs() < 1e-9, "{all}");
        });
    }

    #[test]
    fn table_is_within_its_width() {
        let language = Language::English;
        each(Quality::default(), |_, inspected| {
            for width in [310.0, 380.0, 620.0] {
                let drawn = inspected.draw_terms(width, language);
                assert_within(&drawn.marks, [width, drawn.height]);
            }
        });
    }
}

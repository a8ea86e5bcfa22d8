//! An inspected pixel in sentences, and as a text.

use std::fmt::Write;

use glam::DVec3;

use super::phrases::{kind_word, passes_nothing};
use super::{Inspected, shown};
use crate::language::{Language, decimal, say, word};
use crate::tracer::{ExplainedRay, RayKind};
use crate::view::text::format::{count, counted, distance_words, fine_fraction};

impl Inspected {
    /// Explains the pixel's time: its rays, its samples, and rays left out.
    pub fn sentences(&self, language: Language) -> Vec<String> {
        let rays = &self.rays;
        let kinds = [
            (rays.primary, word!(language, ["primary"; 2], ["primário", "primários"])),
            (rays.shadow, word!(language, ["to lights"; 2], ["às luzes"; 2])),
            (rays.reflected, word!(language, ["reflected"; 2], ["refletido", "refletidos"])),
            (rays.refracted, word!(language, ["through surfaces"; 2], ["através de superfícies"; 2])),
        ];
        let kinds: Vec<_> = kinds
            .iter()
            .filter(|(many, _)| *many > 0)
            .map(|(many, what)| format!("{} {}", count(*many), what[usize::from(*many > 1)]))
            .collect();
        let (took, kinds) = (several_rays(rays.total(), language), kinds.join(", "));
        let mut sentences =
            vec![say!(language, "This pixel needed {took}: {kinds}.", "Este pixel precisou de {took}: {kinds}.")];
        let (all, counting) = (self.samples.len(), self.samples.iter().filter(|sample| sample.counts).count());
        let others = count((all - counting) as u64);
        if all > counting {
            let all = count(all as u64);
            sentences.push(say!(
                language,
                "It has {all} samples. {others} at its corners only showed that more were needed.",
                "Tem {all} amostras. {others} nos cantos só mostraram que eram necessárias mais."
            ));
        } else if all > 1 {
            let all = count(all as u64);
            sentences.push(say!(language, "It is the mean of {all} samples.", "É a média de {all} amostras."));
        }
        let left_out: u64 = self.samples.iter().map(|sample| sample.rays_left_out).sum();
        if left_out > 0 {
            let weight = self.samples.iter().map(|sample| sample.left_out * sample.share(&self.samples)).sum();
            let (rays, part) = (several_rays(left_out, language), fine_fraction(weight, language));
            sentences.push(if left_out == 1 {
                say!(
                    language,
                    "{rays} was left out. Its weight was {part}.",
                    "{rays} foi omitido. Seu peso era {part}."
                )
            } else {
                say!(
                    language,
                    "{rays} were left out. The sum of their weights was {part}.",
                    "{rays} foram omitidos. A soma de seus pesos era {part}."
                )
            });
        }
        let too_deep = |ray: &ExplainedRay| ray.too_deep;
        let deep: f64 = self
            .samples
            .iter()
            .map(|sample| sample.share(&self.samples) * sample.rays.iter().map(too_deep).sum::<f64>())
            .sum();
        if deep > 0.0 {
            let part = fine_fraction(deep, language);
            sentences.push(say!(
                language,
                "The limit of the tree of rays cut off rays with a weight of {part}.",
                "O limite da árvore de raios cortou raios com peso de {part}."
            ));
        }
        sentences
    }

    /// Describes the chosen ray, the solid that it met, and the light that arrives there.
    pub fn ray_sentences(&self, language: Language) -> Vec<String> {
        let ray = self.ray();
        let path = &ray.path;
        let kind = match path.kind {
            RayKind::Primary => word!(language, "From the eye", "Do observador"),
            RayKind::Shadow => word!(language, "To a light", "A uma luz"),
            RayKind::Reflected => word!(language, "Reflected", "Refletido"),
            RayKind::Refracted => word!(language, "Through a surface", "Através de uma superfície"),
        };
        let (level, weight) = (path.level, fine_fraction(path.weight, language));
        let ray_words = say!(
            language,
            "{kind}, on level {level}. Its weight in the sample is {weight}.",
            "{kind}, no nível {level}. Seu peso na amostra é {weight}."
        );
        let Some(met) = ray.met else {
            return vec![say!(language, "{ray_words} It meets nothing.", "{ray_words} Não encontra nada.")];
        };
        let verb = if met.enters {
            word!(language, "It enters", "Entra em")
        } else {
            word!(language, "It meets, from the inside,", "Atinge por dentro")
        };
        let (material, distance) = (self.met_name(ray, language), distance_words(path.to, language));
        let mut sentences = vec![say!(
            language,
            "{ray_words} {verb} {material} at a distance of {distance}.",
            "{ray_words} {verb} {material} à distância de {distance}."
        )];
        if self.lights > 0 {
            let lights: Vec<_> = (0..self.lights).map(|light| self.light_words(ray, light, language)).collect();
            let lights = lights.join(", ");
            sentences.push(say!(
                language,
                "Of the lights at this point: {lights}.",
                "Das luzes neste ponto: {lights}."
            ));
        }
        sentences
    }

    /// Says how much of a light arrives where a ray ended.
    fn light_words(&self, ray: &ExplainedRay, light: usize, language: Language) -> String {
        let name = light + 1;
        match ray.lights.iter().find(|lit| lit.light == light).map(|lit| lit.arriving) {
            None => say!(language, "light {name} is behind the surface", "a luz {name} está atrás da superfície"),
            Some(DVec3::ZERO) => say!(language, "light {name} is hidden", "a luz {name} está encoberta"),
            Some(DVec3::ONE) => say!(language, "light {name} arrives fully", "a luz {name} chega inteira"),
            Some(part) if part == DVec3::splat(part.x) => {
                let part = fine_fraction(part.x, language);
                say!(language, "{part} of light {name} arrives", "da luz {name} chega {part}")
            }
            Some(part) => {
                let [red, green, blue] = part.to_array().map(|part| fine_fraction(part, language));
                say!(
                    language,
                    "{red} of the red, {green} of the green and {blue} of the blue of light {name} arrive",
                    "da luz {name} chegam {red} do vermelho, {green} do verde e {blue} do azul"
                )
            }
        }
    }

    /// Returns everything as a text of several lines.
    pub fn text(&self, language: Language) -> String {
        let [x, y] = self.pixel;
        let colour = self.colour();
        let [red, green, blue] = shown(colour);
        let linear = colour.to_array().map(|value| decimal(language, value, 4)).join("; ");
        let mut text = say!(
            language,
            "Pixel {x}, {y}: {linear} in linear light, #{red:02x}{green:02x}{blue:02x} as shown\n",
            "Pixel {x}, {y}: {linear} em luz linear, #{red:02x}{green:02x}{blue:02x} como se mostra\n"
        );
        self.sentences(language).iter().for_each(|sentence| put(&mut text, 0, sentence));
        text.push_str(word!(language, "\nThe tree of rays", "\nA árvore de raios"));
        let (sample, samples) = (self.chosen.sample + 1, self.samples.len());
        if samples > 1 {
            text.push_str(&say!(language, " of sample {sample} of {samples}", " da amostra {sample} de {samples}"));
        }
        text.push('\n');
        self.put_rays(&mut text, language);
        let chosen = self.chosen.ray + 1;
        put(&mut text, 0, &say!(language, "\nRay {chosen}", "\nRaio {chosen}"));
        self.ray_sentences(language).iter().for_each(|sentence| put(&mut text, 0, sentence));
        put(
            &mut text,
            0,
            word!(
                language,
                "\nIts colour: term, red, green, blue, part of the pixel",
                "\nSua cor: termo, vermelho, verde, azul, parte do pixel"
            ),
        );
        self.term_words(language).lines().for_each(|line| put(&mut text, 1, line));
        put(
            &mut text,
            0,
            word!(language, "\nIts spans in the solids that it enters", "\nSeus trechos nos sólidos em que entra"),
        );
        self.span_words(language).lines().for_each(|line| put(&mut text, 1, line));
        text
    }

    /// Returns the terms of the chosen ray, one on each line.
    pub fn term_words(&self, language: Language) -> String {
        let mut text = String::new();
        for term in self.terms(language) {
            let name = format!("{} ({})", term.formula, term.meaning);
            let [red, green, blue] = term.colour.to_array().map(|value| decimal(language, value, 4));
            let part = term.part.map_or_else(|| "–".to_owned(), |part| fine_fraction(part, language));
            put(&mut text, 0, &format!("{name:28} {red:>8} {green:>8} {blue:>8}   {part}"));
        }
        text
    }

    /// Returns the solids that the chosen ray enters, with its spans in them, one on each line.
    pub fn span_words(&self, language: Language) -> String {
        let (rows, mut text) = (self.rows(), String::new());
        for row in rows.iter().take(MAX_LINES) {
            let span = |span: &[f64; 2]| {
                let [enter, leave] = span.map(|distance| distance_words(distance, language));
                say!(language, "{enter} to {leave}", "{enter} a {leave}")
            };
            let spans: Vec<_> = row.diagram.spans.iter().map(span).collect();
            put(&mut text, row.depth, &format!("{}: {}", self.row_name(row.diagram, language), spans.join(", ")));
        }
        put_more(&mut text, rows.len(), language);
        if rows.is_empty() {
            put(&mut text, 0, passes_nothing(language));
        }
        text
    }

    /// Writes the tree of rays, each ray below the one from whose end it starts.
    fn put_rays(&self, text: &mut String, language: Language) {
        let rays = &self.sample().rays;
        let shown = rays.len().min(MAX_LINES);
        let mut followers: Vec<Vec<usize>> = vec![Vec::new(); shown];
        for (number, ray) in rays[..shown].iter().enumerate() {
            ray.path.from.into_iter().for_each(|from| followers[from as usize].push(number));
        }
        let mut waiting = vec![0];
        while let Some(number) = waiting.pop() {
            let ray = &rays[number];
            let (kind, what, weight) = (
                kind_word(ray.path.kind, language),
                self.met_name(ray, language),
                fine_fraction(ray.path.weight, language),
            );
            let rays = several_rays(ray.lights.len() as u64, language);
            let shadows = match ray.lights.len() {
                0 => String::new(),
                _ => say!(language, ", {rays} to lights", ", {rays} às luzes"),
            };
            let (name, depth) = (number + 1, ray.path.level as usize);
            let line = say!(
                language,
                "{name} {kind}: {what}, weight {weight}{shadows}",
                "{name} {kind}: {what}, peso {weight}{shadows}"
            );
            put(text, depth, &line);
            waiting.extend(followers[number].iter().rev());
        }
        put_more(text, rays.len(), language);
    }
}

/// Most lines of a list.
const MAX_LINES: usize = 60;

/// Writes an indented line.
fn put(text: &mut String, depth: usize, line: &str) {
    let _ = writeln!(text, "{:1$}{line}", "", 2 * depth);
}

/// Writes how many lines a list has beyond [`MAX_LINES`].
fn put_more(text: &mut String, all: usize, language: Language) {
    if all > MAX_LINES {
        let more = count((all - MAX_LINES) as u64);
        put(text, 1, &say!(language, "and {more} more", "e mais {more}"));
    }
}

/// Writes a number of rays.
fn several_rays(number: u64, language: Language) -> String {
    counted(number, word!(language, "ray", "raio"), language)
}

#[cfg(test)]
mod tests {
    use super::super::tests::each;
    use super::*;
    use crate::picture::Quality;

    #[test]
    fn sentences_count_rays_and_rays_left_out() {
        let language = Language::English;
        let mut seen = [false; 3];
        let quality = Quality { max_depth: 4, samples: 2, ..Quality::default() };
        each(quality, |_, inspected| {
            let sentences = inspected.sentences(language);
            let begins = format!("This pixel needed {} ray", count(inspected.rays.total()));
            assert!(sentences[0].starts_with(&begins), "{sentences:?}");
            let left_out = inspected.samples.iter().any(|sample| sample.rays_left_out > 0);
            let too_deep = inspected.samples.iter().any(|sample| sample.rays.iter().any(|ray| ray.too_deep > 0.0));
            let says = |words: &str| sentences.iter().any(|sentence| sentence.contains(words));
            assert_eq!([says("left out"), says("limit of the tree")], [left_out, too_deep], "{sentences:?}");
            assert!(says("the mean of 4 samples"));
            seen = [seen[0] || left_out, seen[1] || too_deep, true];
        });
        assert_eq!(seen, [true; 3], "some pixels have each");
    }

    #[test]
    fn text_has_every_ray_term_and_row() {
        let language = Language::English;
        each(Quality::default(), |_, inspected| {
            let text = inspected.text(language);
            let [x, y] = inspected.pixel;
            assert!(text.starts_with(&format!("Pixel {x}, {y}: ")), "{text}");
            for number in 1..=inspected.sample().rays.len().min(MAX_LINES) {
                assert!(
                    text.lines().any(|line| line.trim_start().starts_with(&format!("{number} "))),
                    "{number}: {text}"
                );
            }
            assert!(inspected.terms(language).iter().all(|term| text.contains(term.formula)), "{text}");
        });
    }
}

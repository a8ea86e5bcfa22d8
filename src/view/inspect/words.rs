//! What there is to say of a pixel, in sentences and as a text.

use std::fmt::Write;

use super::super::words::{count, counted};
use super::{Inspected, shown};
use crate::tracer::{RayKind, RayNotes};

impl Inspected {
    /// Why the pixel took as long as it did: its rays, its samples, and what was left out.
    pub fn sentences(&self) -> Vec<String> {
        let rays = &self.rays;
        let kinds = [
            (rays.primary, "primary"),
            (rays.shadow, "to lights"),
            (rays.reflected, "reflected"),
            (rays.refracted, "through surfaces"),
        ];
        let kinds: Vec<_> =
            kinds.iter().filter(|(many, _)| *many > 0).map(|(many, what)| format!("{} {what}", big(*many))).collect();
        let total = rays.total();
        let mut said = vec![format!("This pixel took {} ray{}: {}.", big(total), plural(total), kinds.join(", "))];
        let (all, counting) = (self.samples.len(), self.samples.iter().filter(|sample| sample.counts).count());
        if all > counting {
            let (all, others) = (big(all as u64), big((all - counting) as u64));
            said.push(format!("It has {all} samples; {others} at its corners only told that more were needed."));
        } else if all > 1 {
            said.push(format!("It is the mean of {} samples.", big(all as u64)));
        }
        let left_out: u64 = self.samples.iter().map(|sample| sample.rays_left_out).sum();
        if left_out > 0 {
            let weight = self.samples.iter().map(|sample| sample.left_out * sample.share(&self.samples)).sum();
            let (was, they) = if left_out == 1 { ("was", "it") } else { ("were", "they") };
            let together = if left_out == 1 { "" } else { " together" };
            let (many, part) = (big(left_out), share_words(weight));
            said.push(format!(
                "{many} ray{} {was} left out; {they} would have counted {part}{together}.",
                plural(left_out)
            ));
        }
        let too_deep = |ray: &RayNotes| ray.too_deep;
        let deep: f64 = self
            .samples
            .iter()
            .map(|sample| sample.share(&self.samples) * sample.rays.iter().map(too_deep).sum::<f64>())
            .sum();
        if deep > 0.0 {
            said.push(format!("The limit of the tree of rays cut off what would have counted {}.", share_words(deep)));
        }
        said
    }

    /// What the chosen ray is, what it met, and which light arrives there.
    pub fn ray_sentences(&self) -> Vec<String> {
        let ray = self.ray();
        let path = &ray.path;
        let kind = match path.kind {
            RayKind::Primary => "From the eye",
            RayKind::Shadow => "To a light",
            RayKind::Reflected => "Reflected",
            RayKind::Refracted => "Through a surface",
        };
        let which = format!("{kind}, on level {}, it counts {} of its sample", path.level, share_words(path.weight));
        let Some(met) = ray.met else { return vec![format!("{which} and meets nothing.")] };
        let does = if met.enters { "enters" } else { "meets from within" };
        let what = self.what(ray);
        let mut said = vec![format!("{which} and {does} {what} at a distance of {}.", number(path.to))];
        if self.lights > 0 {
            let lights: Vec<_> = (0..self.lights).map(|light| self.light_words(ray, light)).collect();
            said.push(format!("Lights: {}.", lights.join(", ")));
        }
        said
    }

    fn light_words(&self, ray: &RayNotes, light: usize) -> String {
        let name = light + 1;
        match ray.lights.iter().find(|lit| lit.light == light).map(|lit| lit.arriving) {
            None => format!("{name} is behind the surface"),
            Some(0.0) => format!("{name} is hidden"),
            Some(1.0) => format!("{name} arrives"),
            Some(part) => format!("of {name} {} arrives", share_words(part)),
        }
    }

    /// Everything as a text of several lines.
    pub fn text(&self) -> String {
        let [x, y] = self.place;
        let colour = self.colour();
        let [red, green, blue] = shown(colour);
        let mut text = format!(
            "Pixel {x}, {y}: {:.4} {:.4} {:.4} in linear light, #{red:02x}{green:02x}{blue:02x} as shown\n",
            colour.x, colour.y, colour.z
        );
        self.sentences().iter().for_each(|sentence| put(&mut text, 0, sentence));
        text.push_str("\nThe tree of rays");
        if self.samples.len() > 1 {
            let _ = write!(text, " of sample {} of {}", self.chosen.sample + 1, self.samples.len());
        }
        text.push('\n');
        self.put_rays(&mut text);
        let _ = writeln!(text, "\nRay {}", self.chosen.ray + 1);
        self.ray_sentences().iter().for_each(|sentence| put(&mut text, 0, sentence));
        put(&mut text, 0, "\nIts colour: term, red, green, blue, part of the pixel");
        self.term_words().lines().for_each(|line| put(&mut text, 1, line));
        put(&mut text, 0, "\nIts stays in what it passes");
        self.span_words().lines().for_each(|line| put(&mut text, 1, line));
        text
    }

    /// The terms of the chosen ray, a line each.
    pub fn term_words(&self) -> String {
        let mut text = String::new();
        for term in self.terms() {
            let (name, colour) = (format!("{} ({})", term.formula, term.meaning), term.colour);
            let part = term.part.map_or_else(|| "–".to_owned(), share_words);
            let line = format!("{name:28} {:8.4} {:8.4} {:8.4}   {part}", colour.x, colour.y, colour.z);
            put(&mut text, 0, &line);
        }
        text
    }

    /// What the chosen ray passes and its stays in there, a line each.
    pub fn span_words(&self) -> String {
        let (rows, mut text) = (self.rows(), String::new());
        for row in rows.iter().take(MOST_LINES) {
            let stay = |[enter, leave]: &[f64; 2]| format!("{} to {}", number(*enter), number(*leave));
            let stays: Vec<_> = row.figure.stays.iter().map(stay).collect();
            put(&mut text, row.depth, &format!("{}: {}", self.row_name(row.figure), stays.join(", ")));
        }
        put_more(&mut text, rows.len());
        if rows.is_empty() {
            put(&mut text, 0, "It passes no solid.");
        }
        text
    }

    /// The tree of rays, each below that from whose end it starts.
    fn put_rays(&self, text: &mut String) {
        let rays = &self.sample().rays;
        let shown = rays.len().min(MOST_LINES);
        let mut followers: Vec<Vec<usize>> = vec![Vec::new(); shown];
        for (number, ray) in rays[..shown].iter().enumerate() {
            ray.path.from.into_iter().for_each(|from| followers[from as usize].push(number));
        }
        let mut waiting = vec![0];
        while let Some(number) = waiting.pop() {
            let ray = &rays[number];
            let (kind, what, counts) = (kind_word(ray.path.kind), self.what(ray), share_words(ray.path.weight));
            let shadows = match ray.lights.len() as u32 {
                0 => String::new(),
                many => format!(", {} to lights", counted(many, "ray")),
            };
            put(text, ray.path.level as usize, &format!("{} {kind}: {what}, counts {counts}{shadows}", number + 1));
            waiting.extend(followers[number].iter().rev());
        }
        put_more(text, rays.len());
    }
}

/// Of longer lists only the beginning is told.
const MOST_LINES: usize = 60;

fn put(text: &mut String, depth: usize, line: &str) {
    let _ = writeln!(text, "{:1$}{line}", "", 2 * depth);
}

/// That there are more lines than are told.
fn put_more(text: &mut String, all: usize) {
    if all > MOST_LINES {
        put(text, 1, &format!("and {} more", big((all - MOST_LINES) as u64)));
    }
}

fn big(number: u64) -> String {
    count(u32::try_from(number).unwrap_or(u32::MAX))
}

fn plural(number: u64) -> &'static str {
    if number == 1 { "" } else { "s" }
}

/// How a ray came.
pub(super) fn kind_word(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Primary => "primary",
        RayKind::Shadow => "to a light",
        RayKind::Reflected => "reflected",
        RayKind::Refracted => "through a surface",
    }
}

/// A part of a whole, as exactly as it matters: `88 %`, `2.1 %`, `0.03 %`.
pub(super) fn share_words(part: f64) -> String {
    let percent = 100.0 * part;
    match percent.abs() {
        0.0 => "0 %".into(),
        0.0..0.005 => "< 0.01 %".into(),
        0.005..0.095 => format!("{percent:.2} %"),
        0.095..9.95 => format!("{percent:.1} %"),
        _ => format!("{percent:.0} %"),
    }
}

/// A distance to four digits or so.
pub(super) fn number(value: f64) -> String {
    match value.abs() {
        f64::INFINITY if value < 0.0 => "−∞".into(),
        f64::INFINITY => "∞".into(),
        0.0 => "0".into(),
        0.001..10.0 => format!("{value:.3}"),
        10.0..100.0 => format!("{value:.2}"),
        100.0..100_000.0 => format!("{value:.1}"),
        _ => format!("{value:.2e}"),
    }
    .replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::super::tests::each;
    use super::*;
    use crate::picture::Quality;

    #[test]
    fn parts_and_distances_are_short() {
        let said = [0.0, 1e-6, 0.0003, 0.0213, 0.0996, 0.88, 1.0].map(share_words);
        assert_eq!(said, ["0 %", "< 0.01 %", "0.03 %", "2.1 %", "10 %", "88 %", "100 %"]);
        let said = [0.0, 1.0, 12.345, -3.5, 1e9, 1e-7, f64::NEG_INFINITY].map(number);
        assert_eq!(said, ["0", "1.000", "12.35", "−3.500", "1.00e9", "1.00e−7", "−∞"]);
    }

    #[test]
    fn the_sentences_count_the_rays_and_what_was_left_out() {
        let mut seen = [false; 3];
        let quality = Quality { max_depth: 4, samples: 2, ..Quality::default() };
        each(quality, |_, inspected| {
            let said = inspected.sentences();
            let begins = format!("This pixel took {} ray", big(inspected.rays.total()));
            assert!(said[0].starts_with(&begins), "{said:?}");
            let left_out = inspected.samples.iter().any(|sample| sample.rays_left_out > 0);
            let too_deep = inspected.samples.iter().any(|sample| sample.rays.iter().any(|ray| ray.too_deep > 0.0));
            let says = |words: &str| said.iter().any(|sentence| sentence.contains(words));
            assert_eq!([says("left out"), says("limit of the tree")], [left_out, too_deep], "{said:?}");
            assert!(says("the mean of 4 samples"));
            seen = [seen[0] || left_out, seen[1] || too_deep, true];
        });
        assert_eq!(seen, [true; 3], "some pixels have each");
    }

    #[test]
    fn the_text_has_every_ray_term_and_row() {
        each(Quality::default(), |_, inspected| {
            let text = inspected.text();
            let [x, y] = inspected.place;
            assert!(text.starts_with(&format!("Pixel {x}, {y}: ")), "{text}");
            for number in 1..=inspected.sample().rays.len().min(MOST_LINES) {
                assert!(
                    text.lines().any(|line| line.trim_start().starts_with(&format!("{number} "))),
                    "{number}: {text}"
                );
            }
            assert!(inspected.terms().iter().all(|term| text.contains(term.formula)), "{text}");
        });
    }
}

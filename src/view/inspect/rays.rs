//! The tree of rays (Figure 3): the eye at the top, and below each ray's end the rays that start there.

use super::phrases::kind_word;
use super::{Inspected, cut, edge, label, line};
use crate::language::{Language, say, word};
use crate::palette::text_on;
use crate::tracer::{ExplainedRay, RayKind};
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use crate::view::draw::polyline::dashes;
use crate::view::text::format::{count, fine_fraction};

/// A drawn tree of rays.
#[derive(Clone, Debug, PartialEq)]
pub struct RayTree {
    /// Marks of the drawing.
    pub marks: Vec<Mark>,
    /// Rays that can be chosen.
    pub spots: Vec<RaySpot>,
    /// Height of the drawing.
    pub height: f32,
}

/// The place where a ray can be chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct RaySpot {
    /// Index among the sample's rays.
    pub ray: usize,
    /// End of the ray in the drawing.
    pub at: Point,
    /// Description of the ray.
    pub name: String,
}

impl RaySpot {
    /// Greatest distance from `at` at which the ray is chosen.
    pub const REACH: f32 = END_RADIUS + 2.0;
}

/// Radius of a ray's end.
const END_RADIUS: f32 = 8.0;
/// Least distance of the centres of two ends.
const MIN_END_DISTANCE: f32 = 22.0;
/// Greatest distance of the centres of two ends.
const MAX_END_DISTANCE: f32 = 58.0;
/// Height of a level in a tree of few levels.
const LEVEL_HEIGHT: f32 = 40.0;
/// Height of a level in a tree of many levels.
const LOW_LEVEL_HEIGHT: f32 = 27.0;
/// Most levels of a tree of few levels.
const FEW_LEVELS: u32 = 5;
/// Deepest level that is drawn.
const MAX_LEVEL: u32 = 12;

impl Inspected {
    /// Draws the tree of rays of the chosen sample. Rays were traced in the order of their weights, so that the
    /// strongest are drawn if not all fit.
    pub fn ray_tree(&self, width: f32, language: Language) -> RayTree {
        let rays = &self.sample().rays;
        let fitting = fitting(rays, width);
        let places = places(&rays[..fitting], width);
        let deepest = rays[..fitting].iter().map(|ray| ray.path.level).max().unwrap_or(1);
        let level_height = if deepest > FEW_LEVELS { LOW_LEVEL_HEIGHT } else { LEVEL_HEIGHT };
        let top = TEXT_HEIGHT;
        let at = |ray: usize| -> Point { [places[ray], top + rays[ray].path.level as f32 * level_height] };
        let eye = [places[0], top];
        let mut marks =
            vec![label([eye[0], top / 2.0], Anchor::Centre, word!(language, "the eye", "observador"), Hue::Quiet)];
        for (number, ray) in rays[..fitting].iter().enumerate() {
            let from = ray.path.from.map_or(eye, |from| at(from as usize));
            marks.extend(draw_ray(ray, from, at(number)));
        }
        let spots: Vec<RaySpot> = rays[..fitting]
            .iter()
            .enumerate()
            .map(|(number, ray)| {
                let (kind, what, weight) = (
                    kind_word(ray.path.kind, language),
                    self.met_name(ray, language),
                    fine_fraction(ray.path.weight, language),
                );
                let which = number + 1;
                let name =
                    say!(language, "Ray {which}, {kind}: {what}, {weight}", "Raio {which}, {kind}: {what}, {weight}");
                RaySpot { ray: number, at: at(number), name }
            })
            .collect();
        for spot in &spots {
            marks.extend(self.draw_end(&rays[spot.ray], spot.at, spot.ray == self.chosen.ray));
        }
        let mut height = top + deepest as f32 * level_height + END_RADIUS + 5.0;
        if fitting < rays.len() {
            let weight = rays[fitting..].iter().map(|ray| ray.path.weight).fold(0.0, f64::max);
            let more = count((rays.len() - fitting) as u64);
            let weight = fine_fraction(weight, language);
            let text =
                say!(language, "and {more} more, none above {weight}", "e mais {more}, nenhum acima de {weight}");
            marks.push(label([width / 2.0, height + TEXT_HEIGHT / 2.0], Anchor::Centre, cut(&text, width), Hue::Quiet));
            height += TEXT_HEIGHT;
        }
        RayTree { marks, spots, height }
    }

    /// Draws a ray's end: round if it met a solid, else square, with the letter of its kind.
    fn draw_end(&self, ray: &ExplainedRay, at: Point, is_chosen: bool) -> Vec<Mark> {
        let colour = self.met_colour(ray);
        let shape = |radius: f32, hue: Hue| match ray.met {
            Some(_) => Mark::Disc { centre: at, radius, ink: hue.full() },
            None => Mark::Box { centre: at, half: [radius - 0.5; 2], round: 1.5, ink: hue.full() },
        };
        let mut marks = Vec::new();
        if is_chosen {
            marks.extend([shape(END_RADIUS + 4.5, Hue::Text), shape(END_RADIUS + 2.0, Hue::Ground)]);
        }
        marks.extend([shape(END_RADIUS, Hue::Fixed(edge(colour))), shape(END_RADIUS - 1.0, Hue::Fixed(colour))]);
        let (size, ink) = (TextSize::Small(0.85), Hue::Fixed(text_on(colour)).full());
        marks.push(Mark::Label { at, anchor: Anchor::Centre, text: letter(ray.path.kind).into(), size, ink });
        marks
    }
}

/// Height of a line of text.
const TEXT_HEIGHT: f32 = 18.0;

/// Returns the letter of a kind of ray, since colours do not tell them apart.
fn letter(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Primary => "P",
        RayKind::Shadow => "S",
        RayKind::Reflected => "R",
        RayKind::Refracted => "T",
    }
}

/// Draws a ray: its width is its weight, and it is dashed if it is reflected.
fn draw_ray(ray: &ExplainedRay, from: Point, to: Point) -> Vec<Mark> {
    let (width, ink) = (1.0 + 6.0 * ray.path.weight as f32, Hue::Quiet.full());
    match ray.path.kind {
        RayKind::Reflected => {
            let pieces = dashes(&[from, to], 5.0, 3.5);
            pieces
                .into_iter()
                .filter(|points| points.len() > 1)
                .map(|points| Mark::Line { points, width, ink })
                .collect()
        }
        _ => vec![line([from, to], width, ink)],
    }
}

/// Returns how many of the first rays fit into a width.
fn fitting(rays: &[ExplainedRay], width: f32) -> usize {
    let most = ((width / MIN_END_DISTANCE) as usize).max(2);
    let mut has_followers = vec![false; rays.len()];
    let mut ends = 0;
    let fits = |ray: &ExplainedRay| {
        // The first follower takes the place of the ray from whose end it starts.
        match ray.path.from.map(|from| std::mem::replace(&mut has_followers[from as usize], true)) {
            Some(false) => {}
            _ => ends += 1,
        }
        ends <= most && ray.path.level <= MAX_LEVEL
    };
    rays.iter().map(fits).take_while(|fits| *fits).count()
}

/// Returns the horizontal position of each ray's end: ends without followers side by side, each other end above the
/// middle of its followers.
fn places(rays: &[ExplainedRay], width: f32) -> Vec<f32> {
    let mut followers: Vec<Vec<usize>> = vec![Vec::new(); rays.len()];
    for (number, ray) in rays.iter().enumerate() {
        ray.path.from.into_iter().for_each(|from| followers[from as usize].push(number));
    }
    // The reflected ray is on the left.
    followers.iter_mut().for_each(|all| all.sort_by_key(|&number| rays[number].path.kind != RayKind::Reflected));
    let (mut places, mut waiting, mut ends) = (vec![0.0; rays.len()], vec![0], 0.0);
    while let Some(number) = waiting.pop() {
        if followers[number].is_empty() {
            places[number] = ends;
            ends += 1.0;
        }
        waiting.extend(followers[number].iter().rev());
    }
    for number in (0..rays.len()).rev().filter(|&number| !followers[number].is_empty()) {
        let sum: f32 = followers[number].iter().map(|&follower| places[follower]).sum();
        places[number] = sum / followers[number].len() as f32;
    }
    let apart = (width / ends.max(1.0)).min(MAX_END_DISTANCE);
    let left = (width - apart * ends) / 2.0;
    places.into_iter().map(|place| left + apart * (place + 0.5)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::ChosenRay;
    use super::super::tests::{assert_within, each};
    use super::*;
    use crate::picture::Quality;

    #[test]
    fn ends_do_not_touch_and_are_below_their_parents() {
        let language = Language::English;
        let quality = Quality { cutoff: 1e-4, max_depth: 30, ..Quality::default() };
        each(quality, |_, inspected| {
            for width in [120.0, 300.0, 700.0] {
                let tree = inspected.ray_tree(width, language);
                assert_within(&tree.marks, [width, tree.height]);
                let rays = &inspected.sample().rays;
                for (i, spot) in tree.spots.iter().enumerate() {
                    assert_eq!(spot.ray, i, "rays are drawn in their order");
                    for other in &tree.spots[..i] {
                        let away = (spot.at[0] - other.at[0]).hypot(spot.at[1] - other.at[1]);
                        assert!(away >= 2.0 * RaySpot::REACH, "{spot:?} {other:?} at {width}");
                    }
                    if let Some(from) = rays[i].path.from {
                        assert!(tree.spots[from as usize].at[1] < spot.at[1]);
                    }
                }
                let says_more =
                    tree.marks.iter().any(|mark| matches!(mark, Mark::Label { text, .. } if text.contains("more")));
                assert_eq!(says_more, tree.spots.len() < rays.len());
            }
        });
    }

    #[test]
    fn only_the_chosen_ray_is_marked() {
        let language = Language::English;
        each(Quality::default(), |tracer, inspected| {
            for ray in 0..inspected.sample().rays.len().min(3) {
                let one = inspected.choose(tracer, ChosenRay { sample: 0, ray }).expect("a ray of it");
                let tree = one.ray_tree(500.0, language);
                let rings = |mark: &&Mark| match mark {
                    Mark::Disc { ink, .. } | Mark::Box { ink, .. } => ink.hue == Hue::Text,
                    _ => false,
                };
                let marked: Vec<&Mark> = tree.marks.iter().filter(rings).collect();
                let [Mark::Disc { centre, .. } | Mark::Box { centre, .. }] = marked[..] else { panic!("{marked:?}") };
                assert_eq!(*centre, tree.spots[ray].at);
            }
        });
    }
}

//! The tree of rays (Figure 3): the eye above, and below each ray's end the rays that start there.

use super::phrases::kind_word;
use super::{Inspected, cut, edge, label, line};
use crate::language::{Language, say, word};
use crate::palette::text_on;
use crate::tracer::{RayKind, RayNotes};
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use crate::view::draw::polyline::dashes;
use crate::view::text::format::{count, fine_fraction};

/// The tree as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct RayTree {
    /// What is to be drawn.
    pub marks: Vec<Mark>,
    /// Its rays, to be chosen from.
    pub spots: Vec<RaySpot>,
    /// How high it is.
    pub height: f32,
}

/// Where a ray can be pointed at.
#[derive(Clone, Debug, PartialEq)]
pub struct RaySpot {
    /// Its number among the sample's rays.
    pub ray: usize,
    /// Where it ends in the drawing.
    pub at: Point,
    /// What it is, in words.
    pub name: String,
}

impl RaySpot {
    /// So far round its place it can be pointed at.
    pub const REACH: f32 = RADIUS + 2.0;
}

/// So large a ray's end is.
const RADIUS: f32 = 8.0;
/// Between the ends of two rays, from middle to middle.
const LEAST_APART: f32 = 22.0;
const MOST_APART: f32 = 58.0;
/// From one level to the next, while they are few and when they are many.
const STEP: f32 = 40.0;
const LOW_STEP: f32 = 27.0;
const FEW: u32 = 5;
/// No deeper level is drawn.
const DEEPEST: u32 = 12;

impl Inspected {
    /// The tree of rays of the chosen sample. Rays were traced in the order of their weights, the strongest first: of so many
    /// that they do not fit, the strongest are drawn.
    pub fn ray_tree(&self, width: f32, language: Language) -> RayTree {
        let rays = &self.sample().rays;
        let fitting = fitting(rays, width);
        let places = places(&rays[..fitting], width);
        let deepest = rays[..fitting].iter().map(|ray| ray.path.level).max().unwrap_or(1);
        let step = if deepest > FEW { LOW_STEP } else { STEP };
        let top = SMALL_LINE;
        let at = |ray: usize| -> Point { [places[ray], top + rays[ray].path.level as f32 * step] };
        let eye = [places[0], top];
        let mut marks =
            vec![label([eye[0], top / 2.0], Anchor::Centre, word!(language, "the eye", "observador"), Hue::Quiet)];
        for (number, ray) in rays[..fitting].iter().enumerate() {
            let from = ray.path.from.map_or(eye, |from| at(from as usize));
            marks.extend(way(ray, from, at(number)));
        }
        let spots: Vec<RaySpot> = rays[..fitting]
            .iter()
            .enumerate()
            .map(|(number, ray)| {
                let (kind, what, weight) = (
                    kind_word(ray.path.kind, language),
                    self.what(ray, language),
                    fine_fraction(ray.path.weight, language),
                );
                let which = number + 1;
                let name =
                    say!(language, "Ray {which}, {kind}: {what}, {weight}", "Raio {which}, {kind}: {what}, {weight}");
                RaySpot { ray: number, at: at(number), name }
            })
            .collect();
        for spot in &spots {
            marks.extend(self.end(&rays[spot.ray], spot.at, spot.ray == self.chosen.ray));
        }
        let mut height = top + deepest as f32 * step + RADIUS + 5.0;
        if fitting < rays.len() {
            let weight = rays[fitting..].iter().map(|ray| ray.path.weight).fold(0.0, f64::max);
            let more = count((rays.len() - fitting) as u64);
            let weight = fine_fraction(weight, language);
            let text =
                say!(language, "and {more} more, none above {weight}", "e mais {more}, nenhum acima de {weight}");
            marks.push(label([width / 2.0, height + SMALL_LINE / 2.0], Anchor::Centre, cut(&text, width), Hue::Quiet));
            height += SMALL_LINE;
        }
        RayTree { marks, spots, height }
    }

    /// A ray's end: round on a solid, square where there is none. Its letter says how the ray came.
    fn end(&self, ray: &RayNotes, at: Point, is_chosen: bool) -> Vec<Mark> {
        let colour = self.colour_of(ray);
        let shape = |radius: f32, hue: Hue| match ray.met {
            Some(_) => Mark::Disc { centre: at, radius, ink: hue.full() },
            None => Mark::Box { centre: at, half: [radius - 0.5; 2], round: 1.5, ink: hue.full() },
        };
        let mut marks = Vec::new();
        if is_chosen {
            marks.extend([shape(RADIUS + 4.5, Hue::Text), shape(RADIUS + 2.0, Hue::Ground)]);
        }
        marks.extend([shape(RADIUS, Hue::Told(edge(colour))), shape(RADIUS - 1.0, Hue::Told(colour))]);
        let (size, ink) = (TextSize::Small(0.85), Hue::Told(text_on(colour)).full());
        marks.push(Mark::Label { at, anchor: Anchor::Centre, text: letter(ray.path.kind).into(), size, ink });
        marks
    }
}

const SMALL_LINE: f32 = 18.0;

/// What tells rays apart without colours.
fn letter(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Primary => "P",
        RayKind::Shadow => "S",
        RayKind::Reflected => "R",
        RayKind::Refracted => "T",
    }
}

/// A ray's way, as broad as its weight; dashed if it is reflected.
fn way(ray: &RayNotes, from: Point, to: Point) -> Vec<Mark> {
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

/// How many of the first rays can be drawn.
fn fitting(rays: &[RayNotes], width: f32) -> usize {
    let most = ((width / LEAST_APART) as usize).max(2);
    let mut has_followers = vec![false; rays.len()];
    let mut ends = 0;
    let fits = |ray: &RayNotes| {
        // The first that follows takes the place of the ray at whose end it starts.
        match ray.path.from.map(|from| std::mem::replace(&mut has_followers[from as usize], true)) {
            Some(false) => {}
            _ => ends += 1,
        }
        ends <= most && ray.path.level <= DEEPEST
    };
    rays.iter().map(fits).take_while(|fits| *fits).count()
}

/// Where each ray's end is from left to right: those that have no followers side by side, the others above the middle of
/// theirs.
fn places(rays: &[RayNotes], width: f32) -> Vec<f32> {
    let mut followers: Vec<Vec<usize>> = vec![Vec::new(); rays.len()];
    for (number, ray) in rays.iter().enumerate() {
        ray.path.from.into_iter().for_each(|from| followers[from as usize].push(number));
    }
    // Reflected to the left, whichever was traced first.
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
    let apart = (width / ends.max(1.0)).min(MOST_APART);
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
    fn ends_stand_apart_below_the_rays_they_come_from() {
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
    fn the_chosen_ray_and_only_that_is_marked() {
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

//! Pixels that are wrong because a ray met boundaries in the wrong order, or lost one.

use serde::Serialize;

use super::plain::{Comparison, Wide, compare, random_scene};
use crate::picture::Size;
use crate::scene::{Opened, SMALL_BUILT_IN, Scene};
use crate::study::StudyError;
use crate::study::markdown::Report;

/// Size of the pictures of built-in scenes.
const SIZE: &str = "80x60";
/// Size of the pictures of random scenes.
const RANDOM_SIZE: &str = "16x12";
/// Number of random scenes.
const RANDOM_SCENES: u64 = 400;

/// Wrong pixels of a scene, or of all random ones.
#[derive(Clone, Debug, Serialize)]
pub(super) struct WrongRow {
    scene: &'static str,
    pixels: u64,
    wrong: u64,
    wrong_per_million: f64,
    at_edges: u64,
}

impl WrongRow {
    fn new(scene: &'static str, comparisons: &[Comparison]) -> Self {
        let sum = |count: fn(&Comparison) -> u64| comparisons.iter().map(count).sum::<u64>();
        let (pixels, wrong) = (sum(|of| of.pixels), sum(|of| of.wrong));
        let wrong_per_million = wrong as f64 / pixels as f64 * 1e6;
        Self { scene, pixels, wrong, wrong_per_million, at_edges: sum(|of| of.at_edges) }
    }
}

/// Counts the wrong pixels of every built-in scene, and of random scenes in which boundaries coincide.
pub(super) fn rows() -> Result<Vec<WrongRow>, StudyError> {
    let mut rows = Vec::new();
    for &(name, _) in SMALL_BUILT_IN {
        rows.push(WrongRow::new(name, &[compare::<Wide>(&Opened::new(name)?.scene, size(SIZE))]));
    }
    let random = |seed| compare::<Wide>(&Scene::parse(&random_scene(seed)).expect("a valid scene"), size(RANDOM_SIZE));
    rows.push(WrongRow::new("random", &(0..RANDOM_SCENES).map(random).collect::<Vec<_>>()));
    Ok(rows)
}

fn size(text: &str) -> Size {
    text.parse().expect("a valid size")
}

/// Adds the table.
pub(super) fn report(report: &mut Report, rows: &[WrongRow]) {
    report.line(format!(
        "\n## Wrong pixels\n\nA ray that meets boundaries in the wrong order gives its pixel a wrong colour. The truth is \
         a plain tracer in numbers of 31 digits, without hierarchy, bounds or pruning: it knows where a ray is from \
         the membership of points. The built-in scenes at {SIZE}, and {RANDOM_SCENES} random ones at {RANDOM_SIZE}, \
         *random*, in which faces coincide, glass is in glass, the eye lies in faces, solids are turned by right \
         angles, and lengths are from 10⁻⁶ to 10⁷. *Wrong* are pixels that differ though all pixels around them show \
         the same face; *at edges* the others.\n"
    ));
    report.line("| scene | pixels | wrong | per million | at edges |");
    report.line("|---|---:|---:|---:|---:|");
    for WrongRow { scene, pixels, wrong, wrong_per_million, at_edges } in rows {
        report.line(format!("| {scene} | {pixels} | {wrong} | {wrong_per_million:.2} | {at_edges} |"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_pixel_of_a_built_in_scene_is_wrong() {
        for &(name, _) in SMALL_BUILT_IN {
            let scene = Opened::new(name).expect("built-in scenes are valid").scene;
            let found = compare::<Wide>(&scene, size("24x18"));
            assert!(found.pixels == 432 && found.wrong == 0, "{name}: {found:?}");
        }
    }
}

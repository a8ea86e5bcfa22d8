//! Lost rays, as codes of particle transport count them: rays whose history of boundaries does not close.

use serde::Serialize;

use crate::picture::{Quality, Size};
use crate::scene::{Opened, SMALL_BUILT_IN};
use crate::study::StudyError;
use crate::study::markdown::Report;
use crate::tracer::{LostRays, Tracer};

/// Size of the pictures whose rays are counted.
const SIZE: &str = "160x120";

/// Lost rays of a scene.
#[derive(Clone, Debug, Serialize)]
pub(super) struct LostRow {
    scene: &'static str,
    rays: u64,
    lost: u64,
    lost_per_million: f64,
}

/// Counts the lost rays of every built-in scene; no ray is left out for being weak.
pub(super) fn rows() -> Result<Vec<LostRow>, StudyError> {
    let quality = Quality { cutoff: 0.0, ..Quality::default() };
    let row = |scene: &'static str| {
        let size: Size = SIZE.parse().expect("a valid size");
        let LostRays { rays, lost } = Tracer::new(&Opened::new(scene)?.scene, size, quality).count_lost();
        Ok(LostRow { scene, rays, lost, lost_per_million: lost as f64 / rays as f64 * 1e6 })
    };
    SMALL_BUILT_IN.iter().map(|(scene, _)| row(scene)).collect()
}

/// Adds the table.
pub(super) fn report(report: &mut Report, rows: &[LostRow]) {
    report.line(format!(
        "\n## Lost rays\n\nA ray is lost if it is in a solid that it has not entered, or not in one that it has not left: \
         rounding has led it past a boundary. All rays of the scenes at {SIZE}, without a cutoff.\n"
    ));
    report.line("| scene | rays | lost | per million |");
    report.line("|---|---:|---:|---:|");
    for LostRow { scene, rays, lost, lost_per_million } in rows {
        report.line(format!("| {scene} | {rays} | {lost} | {lost_per_million:.2} |"));
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn no_ray_of_a_built_in_scene_is_lost() {
        let rows = super::rows().expect("the built-in scenes are valid");
        assert!(rows.iter().all(|row| row.rays > 19_200 && row.lost == 0), "{rows:#?}");
    }
}

//! The effect of each compile pass: CPU time of a scene's picture with all passes, and without each.

use serde::Serialize;

use super::markdown::Report;
use super::preview_time::{PreviewTimes, trace_timed};
use super::progress::Progress;
use super::{ProgressSink, Study, StudyError, median};
use crate::csg::{Pass, Passes};
use crate::picture::{Quality, Size, srgb8};
use crate::scene::Opened;
use crate::tracer::Tracer;

/// Pairs of pictures, with and without each pass.
const TURNS: usize = 5;

/// The effect of one pass on a scene's picture.
#[derive(Debug, Serialize)]
struct PassRow {
    scene: String,
    reduction: String,
    /// CPU time without the pass over that with it: the median of the turns.
    ratio: f64,
    /// CPU time with all passes, in seconds.
    cpu_s: f64,
    /// Pixels whose 8-bit colours differ.
    differing_pixels: usize,
}

/// Measures the effect of each compile pass on each scene's picture.
///
/// # Errors
/// A [`StudyError`], if a table cannot be made.
pub fn needs(scenes: &[Opened], tell: ProgressSink<'_>) -> Result<Study, StudyError> {
    let size = Size::new(240, 180).map_err(StudyError::size)?;
    let mut progress = Progress::new(scenes.len() * (TURNS + 1), tell);
    let (mut rows, mut previews) = (Vec::new(), Vec::new());
    for scene in scenes {
        progress.next(&format!("{}, preview", scene.name));
        previews.push(time_preview(scene)?);
        let tracer = |passes| Tracer::with_passes(&scene.scene, size, Quality::default(), passes);
        let all = tracer(Passes::default());
        let without = Pass::ALL.map(|reduction| tracer(Passes::default().without(reduction)));
        let mut ratios = Pass::ALL.map(|_| Vec::new());
        let mut differing = Pass::ALL.map(|_| 0);
        let mut seconds = Vec::new();
        for turn in 0..TURNS {
            progress.next(&format!("{}, turn {} of {TURNS}", scene.name, turn + 1));
            for (index, without) in without.iter().enumerate() {
                // Side by side, so that a disturbance of the computer affects both.
                let [with, without] = [&all, without].map(trace_timed);
                ratios[index].push(without.cpu.as_secs_f64() / with.cpu.as_secs_f64());
                seconds.push(with.cpu.as_secs_f64());
                let pairs = with.frame.pixels().iter().zip(without.frame.pixels());
                differing[index] = pairs.filter(|(a, b)| srgb8(**a) != srgb8(**b)).count();
            }
        }
        let cpu_s = median(&mut seconds);
        for (index, reduction) in Pass::ALL.into_iter().enumerate() {
            rows.push(PassRow {
                scene: scene.name.clone(),
                reduction: format!("{reduction:?}").to_lowercase(),
                ratio: median(&mut ratios[index]),
                cpu_s,
                differing_pixels: differing[index],
            });
        }
    }
    let mut study = Study::new("needs");
    study.add_rows(&rows)?;
    let mut report = report(scenes, &rows, size);
    preview_report(&mut report, scenes, &previews);
    study.add_report(report);
    Ok(study)
}

/// Returns the median turn by total time.
fn time_preview(scene: &Opened) -> Result<PreviewTimes, StudyError> {
    let size = Size::new(640, 480).map_err(StudyError::size)?;
    let preview = |_| PreviewTimes::new(|| Tracer::new(&scene.scene, size, Quality::default()));
    let mut previews: Vec<PreviewTimes> = (0..TURNS).map(preview).collect();
    previews.sort_by(|a, b| a.exact.total_cmp(&b.exact));
    Ok(previews[TURNS / 2])
}

fn preview_report(report: &mut Report, scenes: &[Opened], previews: &[PreviewTimes]) {
    report.line(
        "\nA preview traces every 16th pixel of every 16th row; these pixels are not traced again. Times from the \
         parsed scene to the compiled scene, the preview, and the picture of 640 × 480 pixels, in milliseconds on one \
         thread; medians as above:\n\n| scene | compiled | preview | exact picture | without a preview | with / \
         without | same picture |\n|---|---:|---:|---:|---:|---:|---|",
    );
    for (scene, PreviewTimes { compiled, first, exact, plain, same }) in scenes.iter().zip(previews) {
        let same = if *same { "yes" } else { "no" };
        let [compiled, first, whole, alone] = [compiled, first, exact, plain].map(|seconds| 1e3 * seconds);
        report.line(format!(
            "| {} | {compiled:.2} | {first:.1} | {whole:.0} | {alone:.0} | {:.3} | {same} |",
            scene.name,
            exact / plain
        ));
    }
}

fn report(scenes: &[Opened], rows: &[PassRow], size: Size) -> Report {
    let mut report = Report::titled("What scenes need");
    report.line(
        "A scene is compiled to what it needs. The table shows how much of each scene file was kept, and how many \
         rays of a sample of the pixels end on each level of the tree of rays, from the primary rays on:\n",
    );
    report.line(
        "| scene | primitives | operations | solids | no bounds | empty | out of reach | reflects | transmits | rays \
         by level |",
    );
    report.line("|---|---|---:|---:|---:|---:|---:|---|---|---|");
    for scene in scenes {
        let tracer = Tracer::new(&scene.scene, size, Quality::default());
        let kept = tracer.scene_stats();
        let primitives: Vec<_> = kept.primitives.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        let levels: Vec<_> = tracer.levels().iter().map(u64::to_string).collect();
        let yes = |is: bool| if is { "yes" } else { "no" };
        report.line(format!(
            "| {} | {} of {}: {} | {} of {} | {} | {} | {} | {} | {} | {} | {} |",
            scene.name,
            kept.primitives.values().sum::<usize>(),
            kept.source.primitives,
            primitives.join(", "),
            kept.operations,
            kept.source.operations,
            kept.solids,
            kept.unbounded,
            kept.dropped + kept.parts_dropped.empty,
            kept.parts_dropped.out_of_reach,
            yes(kept.reflects),
            yes(kept.transmits),
            levels.join(" ")
        ));
    }
    report.line(format!(
        "\nThe effect of each compile pass: CPU time of the picture of {size} pixels without the pass over that with \
         it, medians of {TURNS} turns side by side. In brackets: the number of pixels that differ, by rounding.\n"
    ));
    report
        .line(format!("| pass | {} |", scenes.iter().map(|scene| scene.name.as_str()).collect::<Vec<_>>().join(" | ")));
    report.line(format!("|---|{}", "---:|".repeat(scenes.len())));
    for (index, reduction) in Pass::ALL.into_iter().enumerate() {
        let of_each = rows.iter().skip(index).step_by(Pass::ALL.len());
        let cells: Vec<_> = of_each
            .map(|row| match row.differing_pixels {
                0 => format!("{:.3}", row.ratio),
                differing => format!("{:.3} ({differing})", row.ratio),
            })
            .collect();
        report.line(format!("| {} | {} |", reduction.description(), cells.join(" | ")));
    }
    report
}

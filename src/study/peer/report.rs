//! The report of the comparison with POV-Ray.

use super::povray::PovRay;
use super::step::Step;
use super::{DIFFERENCE, OURS, PeerRow, THEIRS, picture_name};
use crate::picture::{Difference, Size};
use crate::study::format::or_dash;
use crate::study::markdown::Report;

/// Writes the report. `rows` are ordered by scene, then by step; the last scene is the bored cylinder.
pub(super) fn report(povray: &PovRay, size: Size, rows: &[PeerRow]) -> Report {
    let mut report = Report::titled("Every pixel compared with POV-Ray's");
    let scenes: Vec<&[PeerRow]> = rows.chunks_exact(Step::ALL.len()).collect();
    head(&mut report, povray, size);
    table(&mut report, &scenes);
    causes(&mut report);
    if let Some((bored, others)) = scenes.split_last() {
        through_the_bore(&mut report, povray, &bored[0]);
        report.line("\n## Side by side");
        for steps in others {
            side_by_side(&mut report, steps);
        }
    }
    report
}

fn head(report: &mut Report, povray: &PovRay, size: Size) {
    report.line(format!(
        "{} and anel trace the same scenes, as `anel export` writes them: {size} pixels, one ray a pixel through its \
         middle, the same limit of the tree of rays, pictures in 8-bit sRGB. A pixel *differs* if a channel differs \
         by more than {}/255. No pixel is excluded, not even at edges, since both programs send their rays through \
         the same points.\n",
        povray.version,
        Difference::TOLERANCE
    ));
    report.line(
        "The causes are found by removing them. From column to column each scene is changed for both programs alike; \
         pixels that agree after a change had differed for its cause. *Faces apart*: every primitive moves by a \
         hundred-thousandth of the scene, so that faces no longer coincide. *Lossless*: for transparent materials \
         Ks + Kt = 1. *No cutoff*: no cutoff ends a branch of the tree of rays. Differences in the last column are not \
         explained. POV-Ray ignores hits nearer than 10⁻⁴ to the start of a ray, whatever the scene's unit; `anel \
         export` makes every scene so large that this is negligible.\n",
    );
}

fn table(report: &mut Report, scenes: &[&[PeerRow]]) {
    let columns = Step::ALL.map(Step::name).join(" | ");
    report.line(format!(
        "## Pixels that differ\n\n| scene | of | {columns} | share, as it is | greatest difference, as it is |"
    ));
    report.line(format!("|---|---:|{}", "---:|".repeat(Step::ALL.len() + 2)));
    for steps in scenes {
        let [as_it_is, ..] = steps else { continue };
        let counts: Vec<String> = steps.iter().map(|row| row.differing.to_string()).collect();
        report.line(format!(
            "| {} | {} | {} | {:.3} % | {}/255 |",
            as_it_is.scene,
            as_it_is.pixels,
            counts.join(" | "),
            100.0 * as_it_is.share,
            as_it_is.greatest
        ));
    }
}

fn causes(report: &mut Report) {
    report.line("\n## Causes, and which program is right\n");
    for step in Step::ALL {
        if let Some([cause, verdict]) = step.cause() {
            report.line(format!("- **{cause}** (removed by *{}*): {verdict}", step.name()));
        }
    }
}

fn through_the_bore(report: &mut Report, povray: &PovRay, bored: &PeerRow) {
    report.line(format!(
        "\n## A cylinder whose ends coincide with those of its bore\n\nThe bore is open, so the background is visible \
         through it. Of {} pixels whose rays touch nothing, anel gets {} wrong and {} {}: there the bore keeps a skin \
         at its ends. POV-Ray's manual describes this, and advises to make the cutter longer than the solid that it \
         cuts.",
        or_dash(bored.through_bore),
        or_dash(bored.anel_wrong),
        povray.version,
        or_dash(bored.povray_wrong)
    ));
    pictures(report, bored);
}

fn side_by_side(report: &mut Report, steps: &[PeerRow]) {
    let [as_it_is, ..] = steps else { return };
    let counts: Vec<u32> = steps.iter().map(|row| row.differing).collect();
    let gone = counts.windows(2).zip(&Step::ALL[1..]).filter(|(pair, _)| pair[1] < pair[0]);
    let causes: Vec<&str> = gone.filter_map(|(_, step)| Some(step.cause()?[0])).collect();
    let [differing, .., unexplained] = counts[..] else { return };
    report.line(format!("\n### {}\n", as_it_is.scene));
    match differing {
        0 => report.line("No pixel differs."),
        _ => report.line(format!(
            "Pixels that differ: {differing}. Causes: {}. Not explained: {unexplained}.",
            causes.join(", ")
        )),
    }
    pictures(report, as_it_is);
}

fn pictures(report: &mut Report, row: &PeerRow) {
    let shown = |which| format!("![]({})", picture_name(&row.scene, which));
    report.line("\n| anel | POV-Ray | where they differ |\n|---|---|---|");
    report.line(format!("| {} | {} | {} |", shown(OURS), shown(THEIRS), shown(DIFFERENCE)));
}

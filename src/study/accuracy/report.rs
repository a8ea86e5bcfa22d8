//! The report of the study of accuracy.

use super::check::ChoiceCheck;
use super::choice::front;
use super::fit::{log_crossing, log_slope};
use super::knobs::{Knob, MAX_SAMPLES_PER_SIDE};
use super::ring::RingAccuracy;
use super::ring_report;
use super::scene::{MeasuredPoint, SceneAccuracy};
use super::{Point, Reference};
use crate::output::as_file_name;
use crate::picture::{Difference, Quality};
use crate::study::format::{optional, significant};
use crate::study::markdown::Report;
use crate::study::median;

/// Writes the report.
pub(super) fn report(found: &[SceneAccuracy], ring: &RingAccuracy) -> Report {
    let mut report = Report::titled("Speed against accuracy");
    head(&mut report, found);
    slopes(&mut report, found);
    which_pays(&mut report, found);
    choice(&mut report, found);
    for found in found {
        scene(&mut report, found);
    }
    ring_report::ring(&mut report, ring);
    report.line("\nAll that was measured is in `accuracy.csv`, all runs of rings in `accuracy-ring.csv`.");
    report
}

fn head(report: &mut Report, found: &[SceneAccuracy]) {
    let default = Quality::default();
    report.line(format!(
        "Each knob of quality is turned alone, and all are combined. *Seconds* are CPU time on one core, the median \
         of three turns if they are few. The *error* is the root mean square error in linear light (RMSE). A pixel is \
         *wrong* if a channel differs by more than {}/255 in 8-bit sRGB. *SSIM* is the worst of all blocks of 8 × 8 \
         pixels; SPEC CPU asks for more than {REQUIRED_SSIM} of each block of POV-Ray's pictures. A mean hides \
         speckle; wrong pixels and the worst SSIM do not.\n",
        Difference::TOLERANCE
    ));
    report.line(format!(
        "While depth or cutoff is turned, there are 4 × 4 samples a pixel and the other limit is at its default ({} \
         levels, {:.4}); while samples or threshold is turned, both are. At the reference's limits the cost of these \
         would hide the time that the turned knob saves. A threshold is tried with {MAX_SAMPLES_PER_SIDE} × \
         {MAX_SAMPLES_PER_SIDE} samples at most.\n",
        default.max_depth, default.cutoff
    ));
    report.line(format!(
        "The *reference* has two patterns of samples: {} × {} samples a pixel at the default depth and cutoff, plus \
         the light beyond these limits from {few} × {few} samples, down to {} levels and a cutoff of {:e}. A cutoff \
         bounds what all rays left out count together, so the reference leaves out less than is visible here; without \
         a cutoff a tree of 50 levels may have 2⁵⁰ rays. The reference's own error is half of the difference of its \
         two patterns. Scenes with large trees of rays have smaller pictures.\n",
        3 * MAX_SAMPLES_PER_SIDE,
        3 * MAX_SAMPLES_PER_SIDE,
        Reference::DEPTH,
        Reference::CUTOFF,
        few = MAX_SAMPLES_PER_SIDE / 2
    ));
    report.line("| scene | picture | the reference's error | beyond the default limits | least error measured |");
    report.line("|---|---:|---:|---:|---:|");
    for found in found {
        let least = found.points().iter().map(Point::rmse).fold(f64::INFINITY, f64::min);
        report.line(format!(
            "| {} | {} | {:.5} | {:.5} | {least:.5} |",
            found.scene, found.size, found.floor, found.beyond_limits
        ));
    }
}

/// Least SSIM of each block that SPEC asks for.
const REQUIRED_SSIM: f64 = 0.996;

/// Returns the slope of the error of samples alone, by samples a pixel. A single sample is excluded: it is in the
/// middle of its pixel and has no pattern.
fn slope(found: &SceneAccuracy) -> Option<f64> {
    let points = found.of_knob(Some(Knob::Samples)).filter(|entry| entry.point.quality.samples > 1);
    let point = |entry: &MeasuredPoint| Some((f64::from(entry.point.quality.samples).powi(2), entry.alone?));
    log_slope(&points.filter_map(point).collect::<Vec<_>>())
}

fn slopes(report: &mut Report, found: &[SceneAccuracy]) {
    report.line(format!(
        "\n## How fast samples help\n\nThe slope p of error ~ samplesᵖ, by least squares on logarithmic axes, from 2 \
         × 2 to {MAX_SAMPLES_PER_SIDE} × {MAX_SAMPLES_PER_SIDE} samples a pixel, against a picture of very many \
         samples at the same depth and cutoff. Theory for one sample in each cell of a pixel (stratified sampling): \
         −0.5 where there is no structure, −0.75 where edges cross pixels, −1 where all is smooth (D. P. Mitchell, \
         *Consequences of stratified sampling in graphics*, 1996).\n"
    ));
    report.line("| scene | slope |\n|---|---:|");
    for found in found {
        report.line(format!("| {} | {} |", found.scene, optional(slope(found), 2)));
    }
}

/// Error over the best error up to which a value counts as equally good.
const ERROR_TOLERANCE: f64 = 1.1;

/// Returns the coarsest value of a knob whose error is nearly the best value's, and its share of the best value's time.
fn coarsest_value(found: &SceneAccuracy, knob: Knob) -> Option<(&MeasuredPoint, f64)> {
    let best = found.of_knob(Some(knob)).last()?;
    let coarsest_value =
        found.of_knob(Some(knob)).find(|entry| entry.point.rmse() <= ERROR_TOLERANCE * best.point.rmse())?;
    Some((coarsest_value, coarsest_value.point.cpu_s / best.point.cpu_s))
}

/// Returns the threshold that saves most, and its share of the time that samples alone need for the same error.
fn best_threshold(found: &SceneAccuracy) -> Option<(&MeasuredPoint, f64)> {
    let point = |entry: &MeasuredPoint| (entry.point.cpu_s, entry.point.rmse());
    let samples: Vec<(f64, f64)> = found.of_knob(Some(Knob::Samples)).map(point).collect();
    let part = |entry: &MeasuredPoint| Some(entry.point.cpu_s / log_crossing(&samples, entry.point.rmse())?);
    let savings = found.of_knob(Some(Knob::Threshold)).filter_map(|entry| Some((entry, part(entry)?)));
    savings.min_by(|(_, this), (_, other)| this.total_cmp(other))
}

fn which_pays(report: &mut Report, found: &[SceneAccuracy]) {
    report.line(
        "\n## Which knob pays where\n\nThreshold: the value that saves most, and its share of the time that samples \
         alone need for the same error. Depth and cutoff: the coarsest value with at most a tenth more error than \
         without a limit, and its share of the time without one.\n",
    );
    report.line(
        "| scene | threshold | time share | depth | time share | cutoff | time share \
         |\n|---|---:|---:|---:|---:|---:|---:|",
    );
    for found in found {
        let knobs = [best_threshold(found), coarsest_value(found, Knob::Depth), coarsest_value(found, Knob::Cutoff)];
        let cells = knobs.map(|found| {
            let value = |(entry, part): (&MeasuredPoint, f64)| {
                format!("{} | {part:.2}", entry.value.map_or(String::new(), three_digits))
            };
            found.map_or("– | –".into(), value)
        });
        report.line(format!("| {} | {} |", found.scene, cells.join(" | ")));
    }
}

fn choice(report: &mut Report, found: &[SceneAccuracy]) {
    report.line(
        "\n## Does the automatic choice keep its limit?\n\nThe choice is the fastest of all points within a limit of \
         the error, for limits from the fastest point's error to the best one's. The chosen quality is measured again \
         with other samples. The choice is also made from every other point, and compared with the choice from all.\n",
    );
    report.line(
        "| scene | limits | worst error / limit | kept within 10 % | second time / first time | from half: time / \
         time from all, median | worst |",
    );
    report.line("|---|---:|---:|---:|---:|---:|---:|");
    for found in found {
        let choices = &found.choices;
        let worst = choices.iter().map(ChoiceCheck::overshoot).fold(0.0, f64::max);
        let kept = choices.iter().filter(|choice| choice.overshoot() <= ERROR_TOLERANCE).count();
        let mut times: Vec<f64> = choices.iter().map(|choice| choice.remeasured.cpu_s / choice.chosen.cpu_s).collect();
        let mut halves: Vec<f64> = choices.iter().filter_map(|choice| choice.half_over_all).collect();
        report.line(format!(
            "| {} | {} | {worst:.3} | {kept} | {:.3} | {:.3} | {:.3} |",
            found.scene,
            choices.len(),
            median(&mut times),
            median(&mut halves),
            halves.last().copied().unwrap_or_default()
        ));
    }
}

fn scene(report: &mut Report, found: &SceneAccuracy) {
    let name = as_file_name(&found.scene);
    report.line(format!("\n## {}\n\n![](accuracy-{name}-front.svg)\n\n![](accuracy-{name}-alone.svg)\n", found.scene));
    let points = found.points();
    let similar = points.iter().filter(|point| point.difference.worst_ssim > REQUIRED_SSIM);
    match similar.min_by(|a, b| a.cpu_s.total_cmp(&b.cpu_s)) {
        Some(Point { quality, cpu_s, .. }) => {
            report.line(format!("All blocks are similar enough after {cpu_s:.3} s, with {}.\n", knobs(quality)));
        }
        None => report.line("At no measured quality are all blocks similar enough.\n"),
    }
    report.line(
        "The Pareto front, where the error is at least a twentieth below that of the line above:\n\n| seconds | error \
         | wrong pixels | worst SSIM | samples | threshold | depth | cutoff |",
    );
    report.line("|---:|---:|---:|---:|---:|---:|---:|---:|");
    let mut last = f64::INFINITY;
    for Point { quality, cpu_s, difference, .. } in front(&points) {
        let Difference { rmse, wrong_pixels, worst_ssim } = *difference;
        if rmse > 0.95 * last {
            continue;
        }
        last = rmse;
        report.line(format!(
            "| {cpu_s:.4} | {rmse:.5} | {wrong_pixels} | {worst_ssim:.4} | {samples} × {samples} | {} | {} | {} |",
            three_digits(quality.threshold),
            quality.max_depth,
            three_digits(quality.cutoff),
            samples = quality.samples
        ));
    }
}

/// Describes a quality.
fn knobs(quality: &Quality) -> String {
    let Quality { samples, threshold, max_depth, cutoff, .. } = *quality;
    let threshold =
        if threshold > 0.0 { format!(" at most, a threshold of {}", three_digits(threshold)) } else { String::new() };
    format!("{samples} × {samples} samples{threshold}, a depth of {max_depth} and a cutoff of {}", three_digits(cutoff))
}

/// Formats a number with at most three significant digits.
fn three_digits(value: f64) -> String {
    significant(value, 3).to_string()
}

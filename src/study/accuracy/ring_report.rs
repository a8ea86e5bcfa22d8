//! The chapter on the ring in the report of the study of accuracy.

use super::charts::MIN_WAITING_ATOMS;
use super::fit::log_correlation;
use super::ring::{LATENCIES_MS, RingAccuracy};
use super::transfers::{NODES, PICTURE_TIME};
use crate::study::format::optional;
use crate::study::markdown::Report;
use crate::study::median;

/// Adds the chapter on the ring.
pub(super) fn ring(report: &mut Report, ring: &RingAccuracy) {
    report.line(format!(
        "\n## Accuracy of the ring\n\nHow good are the ring's estimates, and what would better ones gain? Runs in \
         virtual time: {NODES} machines of random speeds from 0.1 to 1, and pictures of {} that take the reference \
         machine {} s, with costs in proportion to their rays.\n",
        ring.size,
        PICTURE_TIME.as_secs()
    ));
    estimates(report, ring);
    atoms(report, ring);
}

fn estimates(report: &mut Report, ring: &RingAccuracy) {
    report.line(
        "### Estimates of speeds\n\nAn offer says how many atoms its node has traced, and the owner gives by counts: \
         offerer / (offerer + own). The *true* share makes both finish together, given their speeds, the cost of each \
         waiting atom, and the owner's atoms in its pipe. A run's error is the mean distance of both shares at its \
         transfers, weighted by the waiting work. Correlations are of the logarithms. Within a scene only speeds \
         differ, so the correlation shows the cost of a wrong share; over all scenes it also shows that uneven costs \
         make both figures worse.\n",
    );
    report.line(
        "| scene | runs | transfers per run | error of the share, median | makespan / ideal − 1, median | correlation \
         of both |",
    );
    report.line("|---|---:|---:|---:|---:|---:|");
    for runs in &ring.runs_by_scene {
        let Some(first) = runs.first() else { continue };
        let transfers: u64 = runs.iter().map(|run| run.row.transfers).sum();
        let mut errors: Vec<f64> = runs.iter().filter_map(|run| run.row.estimate_error).collect();
        let mut late: Vec<f64> = runs.iter().map(|run| run.row.lateness).collect();
        report.line(format!(
            "| {} | {} | {:.1} | {:.3} | {:.4} | {} |",
            first.row.scene,
            runs.len(),
            transfers as f64 / runs.len() as f64,
            median(&mut errors),
            median(&mut late),
            optional(log_correlation(&RingAccuracy::points(runs)), 2)
        ));
    }
    let large: Vec<f64> = ring
        .transfers()
        .filter(|transfer| transfer.waiting >= MIN_WAITING_ATOMS)
        .map(|transfer| transfer.estimate - transfer.truth)
        .collect();
    let bias = large.iter().sum::<f64>() / large.len().max(1) as f64;
    report.line(format!(
        "\nOver all runs the correlation is {}. Where at least {MIN_WAITING_ATOMS} atoms wait, the estimated share \
         differs from the true one by {bias:+.3} on \
         average.\n\n![](accuracy-estimate.svg)\n\n![](accuracy-lateness.svg)",
        optional(log_correlation(&ring.all_points()), 2)
    ));
}

fn atoms(report: &mut Report, ring: &RingAccuracy) {
    report.line(
        "\n### Finer atoms\n\nNobody can share or take back the last atom that is traced, so all machines wait for \
         it, the longer the coarser atoms are. Finer atoms cost messages. The figures are means over rings of random \
         speeds; *late* is makespan / ideal − 1. An atom has no cost of its own here, and a node sends its results \
         when it has no atoms left.\n",
    );
    report
        .line(format!("| pixels per atom |{}", LATENCIES_MS.map(|ms| format!(" {ms} ms: messages | late |")).concat()));
    report.line(format!("|---:|{}", "---:|---:|".repeat(LATENCIES_MS.len())));
    let sizes: Vec<u32> = ring
        .atom_sizes
        .iter()
        .filter(|group| group.latency_ms == LATENCIES_MS[0])
        .map(|group| group.atom_pixels)
        .collect();
    for atom_pixels in sizes {
        let cells: Vec<String> = ring
            .atom_sizes
            .iter()
            .filter(|group| group.atom_pixels == atom_pixels)
            .map(|group| {
                format!(" {:.0} | {:.4} |", group.mean(|run| run.messages as f64), group.mean(|run| run.lateness))
            })
            .collect();
        report.line(format!("| {atom_pixels} |{}", cells.concat()));
    }
    report.line("\n![](accuracy-atoms.svg)");
}

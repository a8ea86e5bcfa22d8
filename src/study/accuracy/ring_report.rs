//! What the study of accuracy says of the ring.

use super::charts::MANY;
use super::fit::log_correlation;
use super::ring::{LATENCIES, RingAccuracy};
use super::sharing::{NODES, WHOLE};
use crate::study::markdown::Report;
use crate::study::{median, optional};

/// The chapter on the ring.
pub(super) fn ring(report: &mut Report, ring: &RingAccuracy) {
    report.line(format!(
        "\n## The same question of the ring\n\nHow good is what the ring knows, and what does it gain by knowing \
         better? Runs in virtual time: {NODES} machines of random speeds from 0.1 to 1, pictures of {} that take the \
         reference machine {} s, as dear from place to place as their rays make them.\n",
        ring.size,
        WHOLE.as_secs()
    ));
    estimates(report, ring);
    atoms(report, ring);
}

fn estimates(report: &mut Report, ring: &RingAccuracy) {
    report.line(
        "### Its estimate of speeds\n\nAn offer says how many atoms its node has traced, and the owner gives by \
         counts: offerer / (offerer + own). *True* is the share with which both would end together, knowing their \
         speeds, what each atom that waits costs, and what the owner has in hand. The error of a run is the mean \
         distance of both shares at its transfers, weighted by the work that waits there. Correlations are of the \
         logarithms: within a scene, where only speeds differ, they say what a wrong share costs; over all scenes \
         also that what is dear in one place makes both worse.\n",
    );
    report.line(
        "| scene | runs | transfers a run | error of the share, median | makespan / ideal − 1, median | correlation \
         of both |",
    );
    report.line("|---|---:|---:|---:|---:|---:|");
    for runs in &ring.shared {
        let Some(first) = runs.first() else { continue };
        let transfers: u64 = runs.iter().map(|shared| shared.run.transfers).sum();
        let mut errors: Vec<f64> = runs.iter().filter_map(|shared| shared.run.estimate_error).collect();
        let mut late: Vec<f64> = runs.iter().map(|shared| shared.run.lateness).collect();
        report.line(format!(
            "| {} | {} | {:.1} | {:.3} | {:.4} | {} |",
            first.run.scene,
            runs.len(),
            transfers as f64 / runs.len() as f64,
            median(&mut errors),
            median(&mut late),
            optional(log_correlation(&RingAccuracy::points(runs)), 2)
        ));
    }
    let large: Vec<f64> = ring
        .transfers()
        .filter(|transfer| transfer.waiting >= MANY)
        .map(|transfer| transfer.estimate - transfer.truth)
        .collect();
    let bias = large.iter().sum::<f64>() / large.len().max(1) as f64;
    report.line(format!(
        "\nOver all runs the correlation is {}. Where at least {MANY} atoms wait, the estimated share is {bias:+.3} \
         from the true one on average.\n\n![](accuracy-estimate.svg)\n\n![](accuracy-lateness.svg)",
        optional(log_correlation(&ring.all_points()), 2)
    ));
}

fn atoms(report: &mut Report, ring: &RingAccuracy) {
    report.line(
        "\n### Finer atoms\n\nThe last atom that is traced can be neither shared nor taken back, so that coarse atoms \
         keep all waiting for it; fine ones cost messages. Means over rings of random speeds; an atom itself costs \
         nothing here, and results travel when a node's atoms have run out.\n",
    );
    report.line(format!("| pixels an atom |{}", LATENCIES.map(|ms| format!(" {ms} ms: messages | late |")).concat()));
    report.line(format!("|---:|{}", "---:|---:|".repeat(LATENCIES.len())));
    let sizes: Vec<u32> =
        ring.grained.iter().filter(|grain| grain.latency_ms == LATENCIES[0]).map(|grain| grain.atom_pixels).collect();
    for atom_pixels in sizes {
        let cells: Vec<String> = ring
            .grained
            .iter()
            .filter(|grain| grain.atom_pixels == atom_pixels)
            .map(|grain| {
                format!(" {:.0} | {:.4} |", grain.mean(|run| run.messages as f64), grain.mean(|run| run.lateness))
            })
            .collect();
        report.line(format!("| {atom_pixels} |{}", cells.concat()));
    }
    report.line("\n![](accuracy-atoms.svg)");
}

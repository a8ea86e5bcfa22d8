//! The report of the study of the article.

use super::super::rivals::RivalRow;
use super::PaperFindings;
use super::article::{self, ATOM_PX, NETWORK, Network, SERIAL_TIME, SLOW_SERIAL_TIME};
use super::charts::select;
use super::claims;
use super::division::SpaceDivision;
use super::measure::RUNS;
use super::rows::PaperRow;
use crate::balance::Strategy;
use crate::study::fixture::STRATEGIES;
use crate::study::format::optional;
use crate::study::markdown::Report;
use std::collections::BTreeSet;

/// Writes the report.
pub(super) fn report(found: &PaperFindings<'_>) -> Report {
    let PaperFindings { rows, competing, divisions, handling, .. } = found;
    let mut report = Report::titled("The article's comparison, repeated");
    head(&mut report, found);
    verdicts(&mut report, rows, competing);
    figures(&mut report, rows);
    agreement(&mut report, rows);
    places(&mut report, rows);
    choking(&mut report, handling);
    swings(&mut report, rows);
    space(&mut report, divisions);
    packets(&mut report, rows);
    report.line("\nAll runs are in `paper.csv`.");
    report
}

/// Adds the chapter on sizes, with Figure 9: does the makespan rise as packets shrink?
fn packets(report: &mut Report, rows: &[PaperRow]) {
    report.line("\n## Sizes\n\n![](paper-atoms.svg)\n\n![](paper-parts.svg)\n\n![](paper-figure9.svg)");
    report.line("\nMean atoms in a packet: makespan / ideal, by the least number of atoms that a node sends:\n");
    report.line("| at least | ring | ring, network | adaptive | adaptive, network |\n|---:|---:|---:|---:|---:|");
    let parts: BTreeSet<u32> = select(rows, "part", "none", "sim").map(|row| row.part).collect();
    for part in parts {
        let cell = |strategy: &Strategy, network| {
            let mut of = select(rows, "part", network, "sim");
            let row = of.find(|row| row.strategy == strategy.name() && !row.slow && row.part == part);
            row.map_or(String::new(), |row| match row.transfers {
                0 => format!("none: {:.4}", row.over_ideal),
                transfers => format!("{:.1}: {:.4}", row.atoms_moved as f64 / transfers as f64, row.over_ideal),
            })
        };
        let cells =
            [Strategy::Ring, Strategy::Adaptive].map(|of| ["none", "modelled"].map(|on| cell(&of, on)).join(" | "));
        report.line(format!("| {part} | {} |", cells.join(" | ")));
    }
}

fn head(report: &mut Report, PaperFindings { fixture, pace, .. }: &PaperFindings<'_>) {
    report.line(format!(
        "The scene is {}, {} pixels in atoms of {ATOM_PX}. *Threads*: real runs of emulated machines with {} samples a \
         pixel (n × n), each machine at {:.0} % of a core of this computer; the median of {RUNS} runs. *Virtual \
         time*: the same protocol in a simulator, with machines as fast as the article's ({} s for the picture on one \
         machine, {} s on the slow one) and costs of atoms in proportion to their rays. As in the article, a machine \
         sends its results when it has no atoms left. The figure is makespan / ideal, where the ideal is the work \
         divided by the sum of speeds.\n",
        fixture.scene.name,
        fixture.size,
        fixture.samples,
        100.0 * pace,
        SERIAL_TIME.as_secs(),
        SLOW_SERIAL_TIME.as_secs()
    ));
    report.line(format!(
        "*The modelled network* is one wire shared by all, of {} MB/s, with {} ms a message, and a parent that is \
         busy for {} ms with each message; its farm hands out parts of {} atom. On threads, which are faster than the \
         article's machines, its times are shorter in proportion. Under these conditions the article's order comes \
         out: ring before static bands before farm. Without them, or with larger parts, the farm is about as good as \
         the ring (see *When is a farm worse*).\n",
        NETWORK.bandwidth / 1e6,
        1e3 * NETWORK.latency,
        1e3 * NETWORK.handling,
        Network::PART
    ));
}

fn verdicts(report: &mut Report, rows: &[PaperRow], competing: &[RivalRow; 3]) {
    report.line("## Verdicts\n");
    for verdict in claims::judge_all(rows, competing) {
        report
            .line(format!("- **{}** ({}): **{}**. {}", verdict.claim, verdict.place, verdict.verdict, verdict.figures));
    }
}

fn figures(report: &mut Report, rows: &[PaperRow]) {
    for (driver, network, name) in [
        ("threads", "none", "threads, no network"),
        ("sim", "none", "virtual time, no network"),
        ("threads", "modelled", "threads, modelled network"),
        ("sim", "modelled", "virtual time, modelled network"),
    ] {
        report.line(format!("\n## Figures 5 to 7: {name}\n"));
        report.line("Makespan / ideal; the article's value in brackets.\n");
        let names = STRATEGIES.map(|strategy| strategy.name()).join(" | ");
        report.line(format!("| machines | {names} | rayon |\n|---|{}---:|", "---:|".repeat(STRATEGIES.len())));
        for (nodes, label) in [(2, "2"), (3, "3"), (4, "4"), (5, "4 and a slow one")] {
            let figure = if nodes == 5 { "7" } else { "6" };
            let cell = |strategy: &str, driver: &str, article: Option<f64>| {
                let row =
                    select(rows, figure, network, driver).find(|row| row.nodes == nodes && row.strategy == strategy);
                let ours = optional(row.map(|row| row.over_ideal), 3);
                article.map_or(ours.clone(), |article| format!("{ours} ({article:.3})"))
            };
            let cells = STRATEGIES
                .map(|strategy| cell(strategy.name(), driver, article::over_ideal(&strategy, nodes, nodes == 5)))
                .join(" | ");
            let rayon = if driver == "threads" { cell("rayon", "rayon", None) } else { "–".into() };
            report.line(format!("| {label} | {cells} | {rayon} |"));
        }
        let chart = match (driver, network) {
            ("threads", "none") => "figure5-threads",
            ("sim", "none") => "figure5-sim",
            ("threads", _) => "figure5-threads-network",
            _ => "figure5-sim-network",
        };
        report.line(format!("\n![](paper-{chart}.svg)"));
    }
}

/// Adds the chapter that compares threads with virtual time.
fn agreement(report: &mut Report, rows: &[PaperRow]) {
    report.line("\n## Do threads and virtual time agree?\n");
    report.line(
        "The makespan on threads over that of the same run in virtual time, with the costs measured on threads.\n",
    );
    report.line("| strategy | runs | least | median | greatest |\n|---|---:|---:|---:|---:|");
    for strategy in STRATEGIES.into_iter().chain([Strategy::Serial]) {
        let of = rows.iter().filter(|row| row.strategy == strategy.name());
        let mut ratios: Vec<f64> = of.filter_map(|row| Some(row.makespan_s / row.twin_s?)).collect();
        ratios.sort_by(f64::total_cmp);
        let (Some(least), Some(most)) = (ratios.first(), ratios.last()) else { continue };
        report.line(format!(
            "| {strategy} | {} | {least:.4} | {:.4} | {most:.4} |",
            ratios.len(),
            ratios[ratios.len() / 2]
        ));
    }
}

/// Adds the chapter on the place of the slow machine.
fn places(report: &mut Report, rows: &[PaperRow]) {
    report.line("\n## The slow machine at every place of the ring\n");
    report.line(
        "Makespan / ideal:\n\n| place | threads | virtual time | virtual time, modelled network \
         |\n|---:|---:|---:|---:|",
    );
    let at = |network: &str, driver: &str, place: usize| {
        // The slow machine at the last place is the run of Figure 7.
        let figures = ["place", "7"].into_iter();
        let mut found = figures.flat_map(|figure| select(rows, figure, network, driver).collect::<Vec<_>>());
        found
            .find(|row| row.place == Some(place) && row.strategy == Strategy::Ring.name())
            .map_or(f64::NAN, |row| row.over_ideal)
    };
    for place in 1..=5 {
        report.line(format!(
            "| {place} | {:.4} | {:.4} | {:.4} |",
            at("none", "threads", place),
            at("none", "sim", place),
            at("modelled", "sim", place)
        ));
    }
    report.line(format!(
        "\nThe runs differ in the place of the last atoms when the machines run out of work. An atom in the slow \
         machine's pipe takes {:.1} times as long as on another machine. Two atoms wait there, and nobody can take \
         them back. Whether that shows depends on the cost of its band and on when the last offer passes, and both \
         depend on its place.",
        1.0 / article::slow_speed()
    ));
}

fn choking(report: &mut Report, handling: &[(f64, [f64; 4])]) {
    report.line("\n## When is a farm worse?\n");
    report.line(format!(
        "Makespan / ideal:\n\n| ms a message | farm, parts of {} atom | farm, 16 parts a machine | ring | static \
         |\n|---:|---:|---:|---:|---:|",
        Network::PART
    ));
    for (ms, [small, usual, ring, bands]) in handling {
        report.line(format!("| {ms} | {small:.3} | {usual:.3} | {ring:.3} | {bands:.3} |"));
    }
    report.line("\n![](paper-handling.svg)");
}

/// Adds the chapter on the division of space (§5).
fn space(report: &mut Report, divisions: &[SpaceDivision]) {
    report.line("\n## The third way: division of space (§5)\n");
    report.line(format!(
        "The cells of the scene's octree are dealt to owners, and a ray that leaves an owner's cells is sent to the \
         next owner. The counts are of one render with one sample a pixel, in favour of this method: empty cells cost \
         nothing, and solids without bounds are everywhere. *Wire* is the time for which the modelled network's wire \
         would be busy with the messages; *travel* is the time of all messages one after the other. One machine needs \
         {} s for the picture itself.\n",
        SERIAL_TIME.as_secs()
    ));
    report.line(
        "| owners | cells dealt | rays | rays sent on | messages | results sent back | wire, s | travel, s | busiest \
         owner / mean |",
    );
    report.line("|---:|---|---:|---:|---:|---:|---:|---:|---:|");
    for division in divisions {
        let traffic = &division.traffic;
        report.line(format!(
            "| {} | {} | {} | {:.1} % | {} | {} | {:.0} | {:.0} | {:.2} |",
            traffic.owners,
            if division.runs { "in runs" } else { "one by one" },
            traffic.rays,
            100.0 * (1.0 - traffic.staying as f64 / traffic.rays.max(1) as f64),
            traffic.messages,
            traffic.answers,
            division.wire_s(),
            division.travel_s(),
            traffic.imbalance()
        ));
    }
    report.line(
        "\nThe ring sends fewer than a hundred messages for the same picture. The article's concern is borne out: \
         *exige muita comunicação entre os nós*.",
    );
}

fn swings(report: &mut Report, rows: &[PaperRow]) {
    report.line("\n## A machine whose speed swings\n");
    report.line(
        "A ring of four on the modelled network; one machine swings between full speed and a tenth. Makespan / ideal, \
         where the ideal accounts for the swings:\n",
    );
    report.line("| | period, s | makespan / ideal | atoms moved | transfers |\n|---|---:|---:|---:|---:|");
    let steady = "steady at the mean";
    for (driver, name, of) in [
        ("sim", "virtual time", &[steady, "an offer's lap", "an atom", "a tenth of the run", "the run"][..]),
        ("threads", "threads", &[steady, "an atom", "a tenth of the run", "the run"]),
    ] {
        for (of, row) in of.iter().zip(select(rows, "swing", "modelled", driver)) {
            let period = optional(row.period_s, 4);
            report.line(format!(
                "| {name}: {of} | {period} | {:.4} | {} | {} |",
                row.over_ideal, row.atoms_moved, row.transfers
            ));
        }
    }
}

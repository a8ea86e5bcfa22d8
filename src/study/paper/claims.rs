//! The article's claims, each with a verdict from the measured figures.

use super::super::rivals::RivalRow;
use super::article::{PACKETS, slow_speed};
use super::charts::select;
use super::rows::PaperRow;
use crate::balance::Strategy;

/// A claim and the verdict on it.
pub(super) struct ClaimVerdict {
    /// Where the article makes the claim.
    pub place: &'static str,
    /// The claim.
    pub claim: &'static str,
    /// The verdict: `borne out`, `not borne out`, or `it depends`.
    pub verdict: &'static str,
    /// The figures behind the verdict.
    pub figures: String,
}

const BORNE_OUT: &str = "borne out";
const NOT_BORNE_OUT: &str = "not borne out";
const DEPENDS: &str = "it depends";

/// Judges all testable claims of §7, §10 and §11. `competing` holds the ring with one thread a node, with two, and
/// rayon.
pub(super) fn judge_all(rows: &[PaperRow], competing: &[RivalRow; 3]) -> Vec<ClaimVerdict> {
    let rows = FigureRows(rows);
    vec![
        near_ideal(&rows),
        network_use(&rows),
        finish_together(&rows),
        easier_to_size(&rows),
        slow_machine_helps(&rows),
        small_packets(&rows),
        threads_compete(competing),
    ]
}

struct FigureRows<'a>(&'a [PaperRow]);

impl<'a> FigureRows<'a> {
    fn get(&self, driver: &str, network: &str, strategy: Strategy, nodes: usize) -> Option<&'a PaperRow> {
        let figure = if nodes == 5 { "7" } else { "6" };
        self.0.iter().find(|row| {
            (row.figure, row.driver, row.network, row.strategy, row.nodes)
                == (figure, driver, network, strategy.name(), nodes)
        })
    }

    fn figure(&self, key: (&str, &str, Strategy, usize), value: impl Fn(&PaperRow) -> f64) -> f64 {
        self.get(key.0, key.1, key.2, key.3).map_or(f64::NAN, value)
    }
}

fn near_ideal(rows: &FigureRows<'_>) -> ClaimVerdict {
    let over = |driver, network| {
        [2, 3, 4, 5].map(|nodes| rows.figure((driver, network, Strategy::Ring, nodes), |row| row.over_ideal))
    };
    let words = |times: [f64; 4]| times.map(|time| format!("{time:.3}")).join(", ");
    let all = [over("threads", "none"), over("sim", "none"), over("sim", "modelled")];
    ClaimVerdict {
        place: "§11",
        claim: "The ring comes close to the ideal.",
        verdict: if all.iter().flatten().all(|&over| over < 1.1) { BORNE_OUT } else { DEPENDS },
        figures: format!(
            "Makespan / ideal at 2, 3, 4 machines and at 4 with the slow one: threads {}; virtual time {}; on the \
             modelled network {}. The article's own: 1.034, 1.138, 1.131, 1.109.",
            words(all[0]),
            words(all[1]),
            words(all[2])
        ),
    }
}

fn network_use(rows: &FigureRows<'_>) -> ClaimVerdict {
    let used = |value: fn(&PaperRow) -> u64| {
        [Strategy::Static, Strategy::Ring, Strategy::Farm]
            .map(|strategy| rows.figure(("sim", "modelled", strategy, 4), |row| value(row) as f64))
    };
    let (messages, bytes) = (used(|row| row.messages), used(|row| row.bytes));
    let usual = rows.figure(("sim", "none", Strategy::Farm, 4), |row| row.messages as f64);
    let holds = messages.is_sorted() && bytes.is_sorted();
    ClaimVerdict {
        place: "§7",
        claim: "The ring uses the network more than static bands, and less than the farm.",
        verdict: if holds && usual > messages[1] { BORNE_OUT } else { DEPENDS },
        figures: format!(
            "Messages of static bands, ring and farm at four machines: {:.0}, {:.0}, {:.0}; kilobytes: {:.0}, {:.0}, \
             {:.0}, nearly all of them pixels. The farm's number depends on the size of its parts: here a part is one \
             atom; with 16 parts a machine the farm sends {usual:.0} messages.",
            messages[0],
            messages[1],
            messages[2],
            bytes[0] / 1e3,
            bytes[1] / 1e3,
            bytes[2] / 1e3
        ),
    }
}

fn finish_together(rows: &FigureRows<'_>) -> ClaimVerdict {
    let spread = |driver, strategy, nodes| {
        rows.figure((driver, "none", strategy, nodes), |row| 100.0 * row.finish_spread_s / row.makespan_s)
    };
    let ring =
        [spread("threads", Strategy::Ring, 4), spread("sim", Strategy::Ring, 4), spread("threads", Strategy::Ring, 5)];
    let others = [Strategy::Static, Strategy::Farm].map(|strategy| spread("threads", strategy, 4));
    ClaimVerdict {
        place: "§7, §11",
        claim: "All computers finish practically together.",
        verdict: if ring.iter().all(|&spread| spread < 5.0) { BORNE_OUT } else { DEPENDS },
        figures: format!(
            "Spread, from the first machine's last atom to the last machine's last atom, as a share of the makespan: \
             {:.2} % on threads and {:.2} % in virtual time at four machines, {:.2} % with the slow one; static bands \
             {:.0} %, farm {:.1} %.",
            ring[0], ring[1], ring[2], others[0], others[1]
        ),
    }
}

/// A size is good if its makespan is within this factor of the best.
const GOOD_FACTOR: f64 = 1.05;

fn easier_to_size(rows: &FigureRows<'_>) -> ClaimVerdict {
    let range = |figure, strategy: Strategy, network, slow| {
        let of =
            || select(rows.0, figure, network, "sim").filter(|row| row.slow == slow && row.strategy == strategy.name());
        let best = of().map(|row| row.over_ideal).fold(f64::INFINITY, f64::min);
        let size = |row: &PaperRow| f64::from(if figure == "atom" { row.atom } else { row.atom * row.part });
        let good = || of().filter(move |row| row.over_ideal <= GOOD_FACTOR * best).map(size);
        (good().fold(f64::INFINITY, f64::min), good().fold(0.0, f64::max))
    };
    let atoms = [("none", false), ("none", true), ("modelled", false), ("modelled", true)]
        .map(|(network, slow)| range("atom", Strategy::Ring, network, slow));
    let parts = [("none", false), ("none", true), ("modelled", false), ("modelled", true)]
        .map(|(network, slow)| range("part", Strategy::Farm, network, slow));
    let wider = atoms.iter().zip(&parts).filter(|(atom, part)| atom.1 / atom.0 > part.1 / part.0).count();
    let words = |ranges: [(f64, f64); 4]| ranges.map(|(from, to)| format!("{from:.0} to {to:.0}")).join(", ");
    ClaimVerdict {
        place: "§7",
        claim: "It is easier to find a good size for atoms than for a farm's parts.",
        verdict: match wider {
            4 => BORNE_OUT,
            0 => NOT_BORNE_OUT,
            _ => DEPENDS,
        },
        figures: format!(
            "Sizes in pixels whose makespan is within {:.0} % of the best of those tried, at four machines, at four \
             with the slow one, and both on the modelled network: the ring's atoms {}; the farm's parts {}.",
            100.0 * (GOOD_FACTOR - 1.0),
            words(atoms),
            words(parts)
        ),
    }
}

fn slow_machine_helps(rows: &FigureRows<'_>) -> ClaimVerdict {
    let gain = |driver, network, strategy: Strategy| {
        let time = |nodes| rows.figure((driver, network, strategy.clone(), nodes), |row| row.makespan_s);
        100.0 * (1.0 - time(5) / time(4))
    };
    let best = 100.0 * (1.0 - 4.0 / (4.0 + slow_speed()));
    let ring = [
        gain("threads", "none", Strategy::Ring),
        gain("sim", "none", Strategy::Ring),
        gain("sim", "modelled", Strategy::Ring),
    ];
    let others = [Strategy::Farm, Strategy::Static].map(|strategy| gain("sim", "none", strategy));
    ClaimVerdict {
        place: "§7, §9",
        claim: "Even the slowest machine still helps.",
        verdict: if ring.iter().all(|&gain| gain > 0.0) { BORNE_OUT } else { DEPENDS },
        figures: format!(
            "A fifth machine of {:.1} % makes the ring {:.2} % faster on threads, {:.2} % in virtual time, {:.2} % on \
             the modelled network; {best:.2} % is possible. A farm of 16 parts a machine becomes {} (the slow machine \
             may hold the last part), static bands {}. The article: 4.3 % for the ring.",
            100.0 * slow_speed(),
            ring[0],
            ring[1],
            ring[2],
            speedup(others[0]),
            speedup(others[1])
        ),
    }
}

/// Formats a gain in per cent: `4.3 % faster`.
fn speedup(gain: f64) -> String {
    format!("{:.1} % {}", gain.abs(), if gain < 0.0 { "slower" } else { "faster" })
}

fn small_packets(rows: &FigureRows<'_>) -> ClaimVerdict {
    let points = |network| {
        let of = select(rows.0, "part", network, "sim")
            .filter(|row| row.strategy == "ring" && !row.slow && row.transfers > 0);
        of.map(|row| (row.atoms_moved as f64 / row.transfers as f64, row.over_ideal)).collect::<Vec<_>>()
    };
    let ends = |points: &[(f64, f64)]| {
        let smallest = points.iter().copied().min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default();
        let largest = points.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default();
        (smallest, largest)
    };
    let (none, modelled) = (points("none"), points("modelled"));
    let ((small, time_small), (large, time_large)) = ends(&modelled);
    let ((_, free_small), (_, free_large)) = ends(&none);
    let moved = PACKETS.map(|(_, packets, atoms)| format!("{:.0}", packets * atoms)).join(", ");
    ClaimVerdict {
        place: "§10, Figures 8 and 9",
        claim: "The smaller the packets, the longer it takes.",
        verdict: match (time_small > time_large, free_small > free_large) {
            (true, true) => BORNE_OUT,
            (false, false) => NOT_BORNE_OUT,
            _ => DEPENDS,
        },
        figures: format!(
            "On the modelled network, makespan / ideal is {time_small:.3} with packets of {small:.1} atoms on \
             average, and {time_large:.3} with packets of {large:.1} atoms; without a network {free_small:.3} and \
             {free_large:.3}. Small last packets let all machines finish together, and a lap of the ring costs far \
             less than the atoms it moves. The article's five runs moved {moved} atoms. The fifth run, on which its \
             curve depends, moved a third of the others' atoms: it had little to share, or shared it badly. Four \
             points between 160 and 168 s show no trend."
        ),
    }
}

fn threads_compete([one, two, _]: &[RivalRow; 3]) -> ClaimVerdict {
    let switches = |row: &RivalRow| row.context_switches.map_or("uncounted".into(), |count| count.to_string());
    ClaimVerdict {
        place: "§10",
        claim: "Child and grandchild compete for the processor.",
        verdict: if two.wall_over_ring > 1.02 { BORNE_OUT } else { NOT_BORNE_OUT },
        figures: format!(
            "At full speed, with a machine per core: {:.0} ms with one thread a node, {:.0} ms with two, a factor of \
             {:.2}; {} context switches become {}. A single thread that traces, and handles messages between two \
             pieces of an atom, avoids this.",
            1e3 * one.wall_s,
            1e3 * two.wall_s,
            two.wall_over_ring,
            switches(one),
            switches(two)
        ),
    }
}

//! The result of a finished run, in figures and in words.

use std::cmp::Reverse;
use std::time::Duration;

use crate::balance::{NodeId, Scheduler, Strategy};
use crate::language::{Language, say, word};
use crate::runlog::{Metrics, RunLog};
use crate::time::Time;
use crate::view::analysis::disturbance::{disturbance, disturbance_words};
use crate::view::state::atom_state::AtomState;
use crate::view::state::node_state::NodeState;
use crate::view::state::run_state::RunState;
use crate::view::text::format::{TimeScale, atoms_words, count, counted, duration, fraction, node_name, time_words};
use crate::view::text::glossary::Definition;

/// Result of a finished run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// From the first band sent, or from the beginning of the estimate that it needs, to the last atom placed.
    pub makespan: Duration,
    /// Makespan if the work had been shared perfectly ([`Metrics::ideal`]).
    pub ideal: Duration,
    /// Ideal makespan / makespan, 0 to 1.
    pub efficiency: f64,
    /// From the last atom of the machine that finished first to the last atom of the machine that finished last.
    pub spread: Duration,
    /// Share of the machines' time that was lost to other work of this computer ([`disturbance`]).
    pub disturbance: f64,
}

impl Summary {
    /// Computes the result of a run; `None` unless its picture was completed. It reads all records, so not for every
    /// frame.
    pub fn of(log: &RunLog) -> Option<Self> {
        let metrics = Metrics::of(log);
        let (makespan, ideal, efficiency) = (metrics.makespan()?, metrics.ideal()?, metrics.efficiency()?);
        Some(Self { makespan, ideal, efficiency, spread: metrics.finish_spread(), disturbance: disturbance(log) })
    }
}

/// Returns the figures of the result with their definitions.
pub fn summary_figures(summary: &Summary, language: Language) -> [(String, Definition); 4] {
    [
        (duration(summary.makespan, language), Definition::MAKESPAN),
        (duration(summary.ideal, language), Definition::IDEAL),
        (fraction(summary.efficiency), Definition::EFFICIENCY),
        (beside(summary.makespan, summary.spread, language), Definition::SPREAD),
    ]
}

/// Says how well the work was shared, which machines did most and least of it, and why.
pub fn result_words(state: &RunState, summary: &Summary, language: Language) -> String {
    let [takes, ideal] = [summary.makespan, summary.ideal].map(|length| duration(length, language));
    let spread = beside(summary.makespan, summary.spread, language);
    let efficiency = fraction(summary.efficiency);
    let mut words = say!(
        language,
        "Done in {takes}; shared perfectly it takes {ideal}: efficiency {efficiency}",
        "Pronta em {takes}; com divisão perfeita, {ideal}: eficiência {efficiency}"
    );
    if let Some(disturbed) = disturbance_words(summary.disturbance, language) {
        words += &format!(". {disturbed}");
    }
    let machines = state.nodes().len();
    if machines == 1 {
        return words;
    }
    let workers = if *state.scheduler() == Scheduler::WorkStealing {
        "threads"
    } else {
        word!(language, "machines", "máquinas")
    };
    if *state.scheduler() != Scheduler::Protocol(Strategy::Serial) {
        words += &say!(
            language,
            ". {machines} {workers} were done within {spread}",
            ". {machines} {workers} terminaram com {spread} de diferença"
        );
    }
    if let Some(parts) = work_split_words(state, language) {
        words += &format!(". {parts}");
    }
    words
}

/// Writes a length of time beside that of its run: in the same unit, unless it is too short for that.
fn beside(makespan: Duration, length: Duration, language: Language) -> String {
    if length < makespan.min(Duration::from_secs(1)).mul_f64(0.095) {
        return duration(length, language);
    }
    let scale = TimeScale::of_length(Time::ZERO + makespan);
    // A run of seconds has one decimal.
    let scale = if makespan >= Duration::from_secs(1) { scale.with_decimals(1) } else { scale };
    time_words(Time::ZERO + length, scale, language)
}

/// Says which machine cost most time, and which machines did most and least of the work, and why. `None` if there is
/// only one machine.
pub fn work_split_words(state: &RunState, language: Language) -> Option<String> {
    let parts = match state.scheduler() {
        _ if state.nodes().len() == 1 => return None,
        Scheduler::Protocol(Strategy::Serial) => {
            let most = most_and_least(state).map(|[(most, _), _]| node_name(most))?;
            return Some(say!(language, "{most} traced all of it alone", "{most} calculou tudo sozinha"));
        }
        Scheduler::Protocol(Strategy::Static | Strategy::StaticEstimate) => {
            let alone = word!(language, "no machine took over atoms", "nenhuma assumiu átomos");
            match Costliest::of(state).filter(|costliest| costliest.is_long(state)) {
                Some(costliest) => [Some(format!("{}; {alone}", costliest.words(state, language))), None],
                None => [None, uneven(state, language)],
            }
        }
        scheduler => {
            let costliest = Costliest::of(state).map(|costliest| costliest.words(state, language));
            let costliest = costliest.or_else(|| message_wait_words(state, Duration::ZERO, language));
            let parts = counted(state.handed_out.count, word!(language, "part", "parte"), language);
            let handed_out = scheduler
                .is_farm()
                .then(|| say!(language, "Machines asked the parent for {parts}", "As máquinas pediram {parts} ao pai"));
            let rest: Vec<String> = uneven(state, language).into_iter().chain(handed_out).collect();
            [costliest, (!rest.is_empty()).then(|| rest.join(". "))]
        }
    };
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| parts.join(". "))
}

/// The machine that cost most time: the one that finished last, since all others waited for it.
struct Costliest<'a> {
    node: NodeId,
    machine: &'a NodeState,
    /// Mean time from the last atom of each other machine to its last atom.
    waited: Duration,
}

impl<'a> Costliest<'a> {
    /// Finds it; `None` unless another machine waited for it.
    fn of(state: &'a RunState) -> Option<Self> {
        // A machine that traced nothing does not count.
        let ends = || (0..).zip(state.nodes()).filter_map(|(node, of)| Some((node, of, of.last_atom?)));
        // Of equals the first is named.
        let (node, machine, last) = ends().min_by_key(|&(_, _, at)| Reverse(at))?;
        let waits: Vec<Duration> =
            ends().filter(|&(other, ..)| other != node).map(|(_, _, at)| last.since(at)).collect();
        let waited = waits.iter().sum::<Duration>().checked_div(u32::try_from(waits.len()).ok()?)?;
        (!waited.is_zero()).then_some(Self { node, machine, waited })
    }

    /// Whether the others waited for more than a twentieth of the run.
    fn is_long(&self, state: &RunState) -> bool {
        self.waited.as_secs_f64() > 0.05 * end(state).secs()
    }

    /// Says how long the others waited for it.
    fn words(&self, state: &RunState, language: Language) -> String {
        /// A shorter stop is no reason.
        const MIN_STOP: Duration = Duration::from_millis(50);
        let (name, waited) = (node_name(self.node), beside(end(state).since(Time::ZERO), self.waited, language));
        let stopped = self.machine.stopped(end(state));
        let how = if stopped >= MIN_STOP {
            let stopped = beside(end(state).since(Time::ZERO), stopped, language);
            say!(language, "stopped for {stopped}", "parada por {stopped}")
        } else {
            at_speed(state, self.machine, language)
        };
        if self.is_long(state) || stopped >= MIN_STOP {
            say!(
                language,
                "{name} ({how}) cost most: the others waited {waited} for it on average",
                "{name} ({how}) custou mais: as outras esperaram {waited} por ela em média"
            )
        } else if let Some(words) = message_wait_words(state, self.waited, language) {
            say!(
                language,
                "{words}. The others waited {waited} for {name}, the last",
                "{words}. As outras esperaram {waited} por {name}, a última"
            )
        } else {
            say!(
                language,
                "No machine cost much: the others waited {waited} for {name}, the last",
                "Nenhuma custou muito: as outras esperaram {waited} por {name}, a última"
            )
        }
    }
}

/// Says how long machines waited for messages on average, if that cost more than the wait for the last machine
/// (`waited`) and more than a twentieth of the run.
fn message_wait_words(state: &RunState, waited: Duration, language: Language) -> Option<String> {
    let latency = state.latency();
    if latency.is_zero() || *state.scheduler() == Scheduler::WorkStealing {
        return None;
    }
    let whole = end(state).since(Time::ZERO);
    // After its last atom a machine waits for others, not for messages.
    let waits: Vec<Duration> = state
        .nodes()
        .iter()
        .filter_map(|of| of.last_atom.map(|at| of.idle(end(state)).saturating_sub(end(state).since(at))))
        .collect();
    let mean = waits.iter().sum::<Duration>().checked_div(u32::try_from(waits.len()).ok()?)?;
    (mean > waited && mean > whole.mul_f64(0.05)).then(|| {
        let (mean, latency) = (beside(whole, mean, language), duration(latency, language));
        say!(
            language,
            "Waiting for messages cost most, {mean} of each machine on average: one takes {latency}",
            "Esperar mensagens custou mais, {mean} de cada máquina em média: uma leva {latency}"
        )
    })
}

/// Returns when the picture was complete.
fn end(state: &RunState) -> Time {
    state.finished().unwrap_or(state.head())
}

/// Finds the nodes that did most and least of the work, without spare ones.
fn most_and_least(state: &RunState) -> Option<[(NodeId, &NodeState); 2]> {
    let nodes = || (0..).zip(state.nodes()).filter(|(_, node)| !node.spare);
    // Of equals the first is named.
    Some([nodes().min_by_key(|(_, node)| Reverse(node.done))?, nodes().min_by_key(|(_, node)| node.done)?])
}

/// Says which machines did most and least of the work, and why; `None` if all did about the same.
fn uneven(state: &RunState, language: Language) -> Option<String> {
    let [(most, fast), (least, slow)] = most_and_least(state)?;
    if f64::from(fast.done) < 1.05 * f64::from(slow.done) {
        return None;
    }
    let (first, last) = (node_name(most), node_name(least));
    let [more, less] = [atoms_words(fast.done, language), count(slow.done)];
    let [at_most, at_least] = [fast, slow].map(|node| at_speed(state, node, language));
    let words = say!(
        language,
        "{first} traced most: {more} {at_most}; {last} least: {less} {at_least}",
        "{first} calculou mais: {more} {at_most}; {last}, menos: {less} {at_least}"
    );
    let alike = fast.mean_speed(end(state)) < 1.05 * slow.mean_speed(end(state));
    let dearer = || mean_cost(state, least) > 1.05 * mean_cost(state, most);
    Some(if alike && dearer() {
        say!(language, "{words} (its atoms took longer)", "{words} (seus átomos demoraram mais)")
    } else {
        words
    })
}

/// Describes a node's speed, or its mean speed if it changed.
fn at_speed(state: &RunState, node: &NodeState, language: Language) -> String {
    let mean = fraction(node.mean_speed(end(state)));
    if mean == fraction(node.speed) {
        say!(language, "at {mean}", "a {mean}")
    } else {
        say!(language, "at {mean} on average", "a {mean} em média")
    }
}

/// Mean cost of the atoms that `node` has traced, in seconds of CPU time; 0 if it has traced none.
fn mean_cost(state: &RunState, node: NodeId) -> f64 {
    let cost = |place: &AtomState| match *place {
        AtomState::Traced { by, cost, .. } if by == node => Some(f64::from(cost)),
        _ => None,
    };
    let (sum, atoms) =
        state.atom_states().iter().filter_map(cost).fold((0.0, 0_u32), |(sum, n), cost| (sum + cost, n + 1));
    sum / f64::from(atoms.max(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::Rules;
    use crate::record::{Record, RecordKind};
    use crate::runlog::Header;
    use crate::time::Time;
    use crate::view::tests::sample_runs;

    const SUMMARY: Summary = Summary {
        makespan: Duration::from_millis(20_440),
        ideal: Duration::from_millis(19_800),
        efficiency: 0.9687,
        spread: Duration::from_millis(300),
        disturbance: 0.0,
    };

    /// Describes a run in which each machine, given as (speed, atoms, cost in ms), traces its atoms.
    fn ended(machines: &[(f64, u32, u64)], language: Language) -> String {
        let speeds: Vec<_> = machines.iter().map(|&(speed, ..)| speed).collect();
        let header = sample_runs::header(&speeds, machines.iter().map(|&(_, atoms, _)| atoms).sum());
        let mut state = RunState::new(&header);
        let mut atoms = 0..;
        for (node, &(_, count, cost)) in (0..).zip(machines) {
            for atom in atoms.by_ref().take(count as usize) {
                let kind = RecordKind::AtomDone { node, atom, cost: Duration::from_millis(cost) };
                state.apply(&Record { at: Time::from_secs(1.0), kind });
            }
        }
        state.apply(&Record { at: Time::from_secs(20.44), kind: RecordKind::Finished });
        result_words(&state, &SUMMARY, language)
    }

    #[test]
    fn figures_have_captions() {
        let language = Language::English;
        assert_eq!(
            summary_figures(&SUMMARY, language).map(|(value, caption)| format!("{value} {}", caption.name(language))),
            ["20.4 s start to finish", "19.8 s shared perfectly", "97 % efficiency", "0.3 s first to last done"]
        );
    }

    #[test]
    fn most_and_least_work_has_a_reason() {
        let language = Language::English;
        let all = "Done in 20.4 s; shared perfectly it takes 19.8 s: efficiency 97 %";
        assert_eq!(ended(&[(1.0, 5, 1)], language), all);
        let two = format!("{all}. 2 machines were done within 0.3 s");
        assert_eq!(ended(&[(1.0, 50, 1), (1.0, 51, 1)], language), two);
        assert_eq!(
            ended(&[(0.1, 5, 1), (1.0, 50, 1)], language),
            format!("{two}. 2 traced most: 50 atoms at 100 %; 1 least: 5 at 10 %")
        );
        let dearer = ended(&[(1.0, 50, 1), (1.0, 25, 2)], language);
        assert!(dearer.ends_with("2 least: 25 at 100 % (its atoms took longer)"), "{dearer}");
    }

    /// Describes a run by a strategy, with three machines of which the last one is slow.
    fn shared(strategy: Strategy, language: Language) -> String {
        let mut header = sample_runs::header(&[1.0, 1.0, 0.1], 300);
        header.rules = Rules { strategy, part: 10, ..header.rules };
        let mut state = RunState::new(&header);
        sample_runs::records(&header).iter().for_each(|record| state.apply(record));
        result_words(&state, &SUMMARY, language)
    }

    #[test]
    fn each_strategy_has_its_own_sentence() {
        let language = Language::English;
        let all = "Done in 20.4 s; shared perfectly it takes 19.8 s: efficiency 97 %";
        assert_eq!(shared(Strategy::Serial, language), format!("{all}. 1 traced all of it alone"));
        let three = format!("{all}. 3 machines were done within 0.3 s");
        assert_eq!(
            shared(Strategy::Static, language),
            format!(
                "{three}. 3 (at 10 %) cost most: the others waited 9.0 s for it on average; no machine took over atoms"
            )
        );
        let farm = shared(Strategy::Farm, language);
        assert!(farm.starts_with(&format!("{three}. 3 (at 10 %) cost most: the others waited ")), "{farm}");
        assert!(farm.contains(" for it on average. 1 traced most: "), "{farm}");
        assert!(farm.ends_with(" at 10 %. Machines asked the parent for 27 parts"), "{farm}");
    }

    #[test]
    fn latency_that_cost_most_is_named() {
        let language = Language::English;
        let words = |latency| {
            let mut header = sample_runs::header(&[1.0; 4], 400);
            header.rules.strategy = Strategy::Farm;
            header.link.latency = Duration::from_millis(latency);
            let mut state = RunState::new(&header);
            sample_runs::records(&header).iter().for_each(|record| state.apply(record));
            work_split_words(&state, language).unwrap_or_default()
        };
        let (slow, fast) = (words(500), words(0));
        assert!(slow.starts_with("Waiting for messages cost most, "), "{slow}");
        assert!(slow.contains(" of each machine on average: one takes 500 ms"), "{slow}");
        assert!(!fast.contains("messages"), "{fast}");
    }

    #[test]
    fn state_and_metrics_agree_on_last_atoms() {
        for strategy in Strategy::ALL {
            let mut header = sample_runs::header(&[1.0, 0.5, 0.1], 300);
            header.rules = Rules { strategy: strategy.clone(), part: 10, ..header.rules };
            let (mut state, mut metrics) = (RunState::new(&header), Metrics::new(&header));
            for record in sample_runs::records(&header) {
                state.apply(&record);
                metrics.add(&record);
            }
            let ends: Vec<_> = state.nodes().iter().map(|node| node.last_atom).collect();
            assert_eq!(ends, metrics.last_atoms(), "{strategy:?}");
        }
    }

    #[test]
    fn changed_speed_is_described_as_a_mean() {
        let language = Language::English;
        let mut state = RunState::new(&sample_runs::header(&[1.0, 1.0], 3));
        for (at, kind) in [
            (0.0, RecordKind::SpeedSet { node: 1, speed: 0.0 }),
            (5.0, RecordKind::SpeedSet { node: 1, speed: 1.0 }),
            (6.0, RecordKind::AtomDone { node: 0, atom: 0, cost: Duration::ZERO }),
            (10.0, RecordKind::Finished),
        ] {
            state.apply(&Record { at: Time::from_secs(at), kind });
        }
        let words = result_words(&state, &SUMMARY, language);
        assert!(words.ends_with("1 traced most: 1 atom at 100 %; 2 least: 0 at 50 % on average"), "{words}");
    }

    #[test]
    fn spare_machine_did_not_do_least() {
        let language = Language::English;
        let header = Header { spares: 1, ..sample_runs::header(&[1.0, 0.5, 1.0], 3) };
        let mut state = RunState::new(&header);
        for (node, atom) in [(0, 0), (0, 1), (1, 2)] {
            state.apply(&Record { at: Time::ZERO, kind: RecordKind::AtomDone { node, atom, cost: Duration::ZERO } });
        }
        let words = uneven(&state, language).unwrap_or_default();
        assert!(words.contains("1 traced most: 2 atoms at 100 %; 2 least: 1 at 50 %"), "{words}");
    }
}

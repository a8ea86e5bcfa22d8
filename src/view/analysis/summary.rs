//! What a finished run amounts to, in figures and in words.

use std::cmp::Reverse;
use std::time::Duration;

use crate::balance::{NodeId, Strategy};
use crate::language::{Language, say, word};
use crate::runlog::{Metrics, RunLog};
use crate::view::state::atom_state::AtomState;
use crate::view::state::node_state::NodeState;
use crate::view::state::run_state::RunState;
use crate::view::state::scheduler::Sharing;
use crate::view::text::format::{atoms_words, count, counted, duration, fraction, node_name, seconds_words};

/// What a finished run amounts to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// From the first band sent to the last atom placed.
    pub makespan: Duration,
    /// What the makespan would have been, had the work been shared perfectly.
    pub ideal: Duration,
    /// The ideal makespan divided by the real one, 0 to 1.
    pub efficiency: f64,
    /// From the first node that was done with its last atom to the last one.
    pub spread: Duration,
}

impl Summary {
    /// What the run of a log amounts to, if it came to its end. Sums over all records, so not for every frame.
    pub fn of(log: &RunLog) -> Option<Self> {
        let tally = Metrics::of(log);
        let (makespan, ideal, efficiency) = (tally.makespan()?, tally.ideal()?, tally.efficiency()?);
        Some(Self { makespan, ideal, efficiency, spread: tally.finish_spread() })
    }
}

/// The figures of the result, each with what it is, to be shown large.
pub fn figures(outcome: &Summary, language: Language) -> [(String, &'static str); 4] {
    [
        (seconds(outcome.makespan, language), word!(language, "start to finish", "início ao fim")),
        (seconds(outcome.ideal, language), word!(language, "shared perfectly", "divisão perfeita")),
        (fraction(outcome.efficiency), word!(language, "efficiency", "eficiência")),
        (seconds(outcome.spread, language), word!(language, "first to last done", "da 1ª à última")),
    ]
}

/// The result in a sentence or two: how well the work was shared, and who did most and least of it, and why.
pub fn result_words(state: &RunState, outcome: &Summary, language: Language) -> String {
    let [takes, ideal, spread] =
        [outcome.makespan, outcome.ideal, outcome.spread].map(|length| seconds(length, language));
    let efficiency = fraction(outcome.efficiency);
    let mut words = say!(
        language,
        "Done in {takes}; shared perfectly it takes {ideal}: efficiency {efficiency}",
        "Pronta em {takes}; com divisão perfeita, {ideal}: eficiência {efficiency}"
    );
    let machines = state.nodes().len();
    if machines == 1 {
        return words;
    }
    let what = if state.sharing() == Sharing::Stealing { "threads" } else { word!(language, "machines", "máquinas") };
    if state.sharing() != Sharing::By(Strategy::Serial) {
        words += &say!(
            language,
            ". {machines} {what} were done within {spread}",
            ". {machines} {what} terminaram com {spread} de diferença"
        );
    }
    if let Some(parts) = parts_words(state, language) {
        words += &format!(". {parts}");
    }
    words
}

/// Writes a length in seconds with a decimal, or in a smaller unit if it is shorter than 0.1 s.
fn seconds(length: Duration, language: Language) -> String {
    if length < Duration::from_millis(95) {
        duration(length, language)
    } else {
        seconds_words(length.as_secs_f64(), language)
    }
}

/// Who did most and least of the work, and why, or who was waited for; `None` if all did about the same.
pub fn parts_words(state: &RunState, language: Language) -> Option<String> {
    match state.sharing() {
        _ if state.nodes().len() == 1 => None,
        Sharing::By(Strategy::Serial) => {
            let most = most_and_least(state).map(|[(most, _), _]| node_name(most))?;
            Some(say!(language, "{most} traced all of it alone", "{most} calculou tudo sozinha"))
        }
        Sharing::By(Strategy::Static | Strategy::StaticEstimate) => {
            waited_for(state, language).or_else(|| uneven(state, language))
        }
        sharing if sharing.is_farm() => {
            let parts = counted(state.handed_out.count, word!(language, "part", "parte"), language);
            let handed_out = say!(language, "The parent was asked for {parts}", "Pediram ao pai {parts}");
            Some(uneven(state, language).map_or_else(|| handed_out.clone(), |uneven| format!("{uneven}. {handed_out}")))
        }
        Sharing::By(_) | Sharing::Stealing => uneven(state, language),
    }
}

/// The machine that all others waited for, if they waited long.
fn waited_for(state: &RunState, language: Language) -> Option<String> {
    let end = state.finished()?.secs();
    // A machine that traced nothing does not count.
    let ends = || (0..).zip(state.nodes()).filter_map(|(node, of)| Some((node, of.last_atom?)));
    // Of equals the first is named.
    let (last, latest) = ends().min_by_key(|&(_, at)| Reverse(at))?;
    let (first, earliest) = ends().min_by_key(|&(_, at)| at)?;
    let waited = latest.since(earliest);
    let worth_a_word = waited.as_secs_f64() > 0.05 * end;
    let slow = state.nodes().get(usize::from(last)).map(|node| at_speed(state, node, language)).unwrap_or_default();
    worth_a_word.then(|| {
        let (last, first, waited) = (node_name(last), node_name(first), seconds(waited, language));
        say!(
            language,
            "All waited for {last}, {slow}: {first} was done {waited} before it, and nobody shared",
            "Todas esperaram por {last}, {slow}: {first} terminou {waited} antes dela, e ninguém dividiu"
        )
    })
}

/// The nodes that did most and least of the work, of those that were there.
fn most_and_least(state: &RunState) -> Option<[(NodeId, &NodeState); 2]> {
    let nodes = || (0..).zip(state.nodes()).filter(|(_, node)| !node.spare);
    // Of equals the first is named.
    Some([nodes().min_by_key(|(_, node)| Reverse(node.done))?, nodes().min_by_key(|(_, node)| node.done)?])
}

/// Who did most and least of the work, and why; `None` if all did about the same.
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
    let end = state.finished().unwrap_or(state.head());
    let alike = fast.mean_speed(end) < 1.05 * slow.mean_speed(end);
    let dearer = || mean_cost(state, least) > 1.05 * mean_cost(state, most);
    Some(if alike && dearer() {
        say!(language, "{words} (its atoms took longer)", "{words} (seus átomos demoraram mais)")
    } else {
        words
    })
}

/// A node's speed in words, as far as one number can tell it.
fn at_speed(state: &RunState, node: &NodeState, language: Language) -> String {
    let mean = fraction(node.mean_speed(state.finished().unwrap_or(state.head())));
    if mean == fraction(node.speed) {
        say!(language, "at {mean}", "a {mean}")
    } else {
        say!(language, "at {mean} on average", "a {mean} em média")
    }
}

/// What an atom that `node` has traced cost on average, in seconds of CPU time; 0 if it has traced none.
fn mean_cost(state: &RunState, node: NodeId) -> f64 {
    let cost = |place: &AtomState| match *place {
        AtomState::Traced { by, cost, .. } if by == node => Some(f64::from(cost)),
        _ => None,
    };
    let (sum, atoms) = state.places().iter().filter_map(cost).fold((0.0, 0_u32), |(sum, n), cost| (sum + cost, n + 1));
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

    const OUTCOME: Summary = Summary {
        makespan: Duration::from_millis(20_440),
        ideal: Duration::from_millis(19_800),
        efficiency: 0.9687,
        spread: Duration::from_millis(300),
    };

    /// How a run ends in which each node traces so many atoms at its speed and a cost in milliseconds.
    fn ended(machines: &[(f64, u32, u64)], language: Language) -> String {
        let speeds: Vec<_> = machines.iter().map(|&(speed, ..)| speed).collect();
        let header = sample_runs::header(&speeds, machines.iter().map(|&(_, atoms, _)| atoms).sum());
        let mut state = RunState::new(&header);
        let mut atoms = 0..;
        for (node, &(_, count, cost)) in (0..).zip(machines) {
            for atom in atoms.by_ref().take(count as usize) {
                let what = RecordKind::AtomDone { node, atom, cost: Duration::from_millis(cost) };
                state.apply(&Record { at: Time::from_secs(1.0), what });
            }
        }
        state.apply(&Record { at: Time::from_secs(20.44), what: RecordKind::Finished });
        result_words(&state, &OUTCOME, language)
    }

    #[test]
    fn the_figures_say_what_they_are() {
        let language = Language::English;
        assert_eq!(
            figures(&OUTCOME, language).map(|(value, caption)| format!("{value} {caption}")),
            ["20.4 s start to finish", "19.8 s shared perfectly", "97 % efficiency", "0.3 s first to last done"]
        );
    }

    #[test]
    fn who_did_most_and_least_is_told_with_the_reason() {
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

    /// What is said of a whole run by this strategy whose last machine is slow.
    fn shared(strategy: Strategy, language: Language) -> String {
        let mut header = sample_runs::header(&[1.0, 1.0, 0.1], 300);
        header.rules = Rules { strategy, part: 10, ..header.rules };
        let mut state = RunState::new(&header);
        sample_runs::records(&header).iter().for_each(|record| state.apply(record));
        result_words(&state, &OUTCOME, language)
    }

    #[test]
    fn what_came_of_other_strategies_is_told_in_their_words() {
        let language = Language::English;
        let all = "Done in 20.4 s; shared perfectly it takes 19.8 s: efficiency 97 %";
        assert_eq!(shared(Strategy::Serial, language), format!("{all}. 1 traced all of it alone"));
        let three = format!("{all}. 3 machines were done within 0.3 s");
        assert_eq!(
            shared(Strategy::Static, language),
            format!("{three}. All waited for 3, at 10 %: 1 was done 9.0 s before it, and nobody shared")
        );
        let farm = shared(Strategy::Farm, language);
        assert!(farm.starts_with(&format!("{three}. 1 traced most: ")), "{farm}");
        assert!(farm.ends_with(" at 10 %. The parent was asked for 27 parts"), "{farm}");
    }

    #[test]
    fn state_and_metrics_agree_on_last_atoms() {
        for strategy in Strategy::ALL {
            let mut header = sample_runs::header(&[1.0, 0.5, 0.1], 300);
            header.rules = Rules { strategy, part: 10, ..header.rules };
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
    fn a_speed_that_changed_is_told_as_a_mean() {
        let language = Language::English;
        let mut state = RunState::new(&sample_runs::header(&[1.0, 1.0], 3));
        for (at, what) in [
            (0.0, RecordKind::SpeedSet { node: 1, speed: 0.0 }),
            (5.0, RecordKind::SpeedSet { node: 1, speed: 1.0 }),
            (6.0, RecordKind::AtomDone { node: 0, atom: 0, cost: Duration::ZERO }),
            (10.0, RecordKind::Finished),
        ] {
            state.apply(&Record { at: Time::from_secs(at), what });
        }
        let words = result_words(&state, &OUTCOME, language);
        assert!(words.ends_with("1 traced most: 1 atom at 100 %; 2 least: 0 at 50 % on average"), "{words}");
    }

    #[test]
    fn who_was_not_there_did_not_do_least() {
        let language = Language::English;
        let header = Header { spares: 1, ..sample_runs::header(&[1.0, 0.5, 1.0], 3) };
        let mut state = RunState::new(&header);
        for (node, atom) in [(0, 0), (0, 1), (1, 2)] {
            state.apply(&Record { at: Time::ZERO, what: RecordKind::AtomDone { node, atom, cost: Duration::ZERO } });
        }
        let words = uneven(&state, language).unwrap_or_default();
        assert!(words.contains("1 traced most: 2 atoms at 100 %; 2 least: 1 at 50 %"), "{words}");
    }
}

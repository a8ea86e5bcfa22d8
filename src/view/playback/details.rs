//! Details of a machine, an atom or a message: its words and its highlight.

use std::ops::Range;

use super::snapshots::{Snapshot, SnapshotCache};
use crate::balance::{NodeId, Party};
use crate::language::{Language, say, word};
use crate::picture::{Atom, push_atom};
use crate::record::RecordKind;
use crate::runlog::RunLog;
use crate::time::Time;
use crate::view::narration::record_sentences::share_words;
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::lane::Traced;
use crate::view::state::lanes::Lanes;
use crate::view::state::node_rows::node_rows;
use crate::view::state::run_state::RunState;
use crate::view::text::format::{TimeScale, count, duration, node_name, time_words};
use crate::view::text::tooltips::{Fact, atom_words, flight_words, node_facts};
use crate::view::timeline::landmarks::Subject;

/// Details of a subject that do not depend on the shown time. Found by a search through the run, so not in every frame.
#[derive(Clone, Debug)]
pub struct Details {
    /// The machine, atom or message.
    pub subject: Subject,
    /// The message itself.
    flight: Option<Flight>,
    /// Why the message carries this number of atoms.
    why: Option<String>,
    /// Who traced the atom, and when.
    bar: Option<(NodeId, Traced)>,
}

/// Machines, atoms and a message that are highlighted in all views.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Highlight {
    /// Machines.
    pub nodes: Vec<NodeId>,
    /// Atoms.
    pub atoms: Vec<Range<Atom>>,
    /// A message, by its id in the run.
    pub message: Option<u64>,
    /// The bar of an atom.
    pub bar: Option<(NodeId, Traced)>,
}

impl Details {
    /// Searches the run for the details of `subject`.
    pub fn of(subject: Subject, log: &RunLog, lanes: &Lanes, cache: &mut SnapshotCache, language: Language) -> Self {
        let mut details = Self { subject, flight: None, why: None, bar: None };
        match subject {
            Subject::Node(_) => {}
            Subject::Atom(atom) => details.bar = lanes.bar_of(atom),
            Subject::Message(id) => {
                let is_it = |kind: &RecordKind| matches!(kind, RecordKind::Sent { id: other, .. } if *other == id);
                let Some(index) = log.records().iter().rposition(|record| is_it(&record.kind)) else { return details };
                let record = &log.records()[index];
                let RecordKind::Sent { from, to, message, arrives, .. } = &record.kind else { return details };
                let flight = Flight::new(id, (*from, *to), message, record.at, *arrives);
                if let (Party::Node(from), Party::Node(to), Cargo::Transfer(_)) = (*from, *to, &flight.cargo) {
                    let mut snapshot = Snapshot::new(&log.header);
                    cache.seek(log, index + 1, &mut snapshot);
                    details.why = share_words(&snapshot.state, from, to, flight.cargo.atoms(), language);
                }
                details.flight = Some(flight);
            }
        }
        details
    }

    /// Whether nothing more can become known of it.
    pub fn is_complete(&self) -> bool {
        match self.subject {
            Subject::Node(_) => true,
            Subject::Atom(_) => self.bar.is_some(),
            Subject::Message(_) => self.flight.is_some(),
        }
    }

    /// Returns the highlight of the subject while `state` is shown.
    pub fn highlight(&self, state: &RunState) -> Highlight {
        match self.subject {
            Subject::Node(node) => {
                let mut atoms = Vec::new();
                for (atom, place) in (0..).zip(state.atom_states()) {
                    if place.holder() == Some(node) {
                        push_atom(&mut atoms, atom);
                    }
                }
                Highlight { nodes: vec![node], atoms, ..Highlight::default() }
            }
            Subject::Atom(atom) => {
                let holder = state.atom_states().get(atom as usize).and_then(|place| place.holder());
                let atoms = std::iter::once(atom..atom.saturating_add(1)).collect();
                Highlight { nodes: holder.into_iter().collect(), atoms, bar: self.bar, ..Highlight::default() }
            }
            Subject::Message(id) => {
                let parties = self.flight.iter().flat_map(|flight| [flight.from, flight.to]);
                let nodes = parties.filter_map(|party| match party {
                    Party::Node(node) => Some(node),
                    Party::Parent => None,
                });
                let atoms = self.flight.as_ref().map_or_else(Vec::new, |flight| flight.cargo.ranges().to_vec());
                Highlight { nodes: nodes.collect(), atoms, message: Some(id), ..Highlight::default() }
            }
        }
    }

    /// Returns a title and a line of details at `now`. Times have two decimals more than `scale`.
    pub fn words(&self, state: &RunState, now: Time, scale: TimeScale, language: Language) -> (String, String) {
        match self.subject {
            Subject::Node(node) => {
                let facts = node_facts(state, node, now, language);
                let of = |fact: Fact| facts.iter().find(|(other, _)| *other == fact)?.1.as_deref();
                let said = [Fact::Stopped, Fact::Offers, Fact::Gave, Fact::Got, Fact::Asked, Fact::Stole, Fact::Lost];
                let shared = said.iter().filter_map(|fact| Some((fact.name(language), of(*fact)?)));
                let shared: String = shared.map(|(what, value)| format!(", {what}: {value}")).collect();
                let value = |fact| of(fact).unwrap_or(word!(language, "unknown", "desconhecido"));
                let (name, does, speed) = (node_name(node), value(Fact::State), value(Fact::Speed));
                let [done, left, idle] = [Fact::Done, Fact::Left, Fact::Idle].map(value);
                let title = say!(
                    language,
                    "Machine {name}, at a speed of {speed}: {does}",
                    "Máquina {name}, à velocidade de {speed}: {does}"
                );
                let is_lost = node_rows(state, now).get(usize::from(node)).is_some_and(|row| row.lost > 0);
                let left = if is_lost { left.to_owned() } else { say!(language, "{left} left", "ainda tem {left}") };
                let more = say!(
                    language,
                    "{done} done, {left}, idle {idle} of its time{shared}",
                    "calculou {done}, {left}, ociosa {idle} do tempo{shared}"
                );
                (title, more)
            }
            Subject::Atom(atom) => {
                let pixels = state.division().pixels(atom);
                let [first, last] = [pixels.start, pixels.end.saturating_sub(1)].map(count);
                let place = say!(
                    language,
                    "pixels {first} to {last} in scan order",
                    "pixels {first} a {last} na ordem de varredura"
                );
                let traced = self.bar.map(|(node, bar)| {
                    let (name, took) = (node_name(node), duration(bar.to.since(bar.from), language));
                    let [from, to] = [bar.from, bar.to].map(|time| time_words(time, scale.finer(2), language));
                    let traces = if bar.to <= now {
                        word!(language, "traced", "o calculou")
                    } else {
                        word!(language, "will trace", "o calculará")
                    };
                    say!(
                        language,
                        " · machine {name} {traces} it from {from} to {to}: {took} at its speed",
                        " · a máquina {name} {traces} de {from} a {to}: {took} à sua velocidade"
                    )
                });
                (atom_words(state, atom, now, language), format!("{place}{}", traced.unwrap_or_default()))
            }
            Subject::Message(_) => match &self.flight {
                None => {
                    let title =
                        word!(language, "This message is no longer known", "Esta mensagem não é mais conhecida");
                    (title.into(), String::new())
                }
                Some(flight) => {
                    let [sent, arrives] =
                        [flight.sent, flight.arrives].map(|time| time_words(time, scale.finer(2), language));
                    let took = duration(flight.arrives.since(flight.sent), language);
                    let why = self.why.as_ref().map(|why| format!("{why} · ")).unwrap_or_default();
                    let arrived = if flight.arrives <= now {
                        word!(language, "arrived", "chegou")
                    } else {
                        word!(language, "arrives", "chega")
                    };
                    let more = say!(
                        language,
                        "{why}sent at {sent}, {arrived} at {arrives}, {took} later",
                        "{why}enviada em {sent}, {arrived} em {arrives}, {took} depois"
                    );
                    (flight_words(flight, language), more)
                }
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::run_view::RunView;
    use super::*;
    use crate::view::tests::sample_runs;
    use crate::view::timeline::landmarks::landmarks;

    #[test]
    fn biggest_transfer_has_a_reason_and_its_atoms() {
        let language = Language::English;
        let log = sample_runs::log(&[1.0, 1.0, 0.1], 900);
        let RunView { latest: snapshot, lanes, .. } = RunView::of(&log);
        let found = landmarks(&log, language);
        let biggest = found.iter().find(|mark| mark.words.starts_with("The biggest")).unwrap();
        let mut cache = SnapshotCache::default();
        let details = Details::of(biggest.subject, &log, &lanes, &mut cache, language);
        let highlight = details.highlight(&snapshot.state);
        let (title, more) =
            details.words(&snapshot.state, snapshot.state.head(), TimeScale::of_length(log.end()), language);
        let atoms: usize = highlight.atoms.iter().map(Range::len).sum();
        assert!(highlight.nodes.len() == 2 && title.starts_with(&format!("{atoms} atoms from ")), "{title}");
        assert!(
            more.contains(" that waited with machine ")
                && more.contains(" in proportion to atoms traced, ")
                && more.contains("sent at "),
            "{more}"
        );
    }

    #[test]
    fn atom_highlights_its_bar_and_its_machine() {
        let language = Language::English;
        let log = sample_runs::log(&[1.0, 0.5], 40);
        let RunView { latest: snapshot, lanes, .. } = RunView::of(&log);
        let details = Details::of(Subject::Atom(7), &log, &lanes, &mut SnapshotCache::default(), language);
        let highlight = details.highlight(&snapshot.state);
        assert_eq!(
            (highlight.atoms.len(), highlight.bar.map(|(node, _)| vec![node])),
            (1, Some(highlight.nodes.clone()))
        );
        let whole = Details::of(Subject::Node(0), &log, &lanes, &mut SnapshotCache::default(), language)
            .highlight(&snapshot.state);
        let atoms: usize = whole.atoms.iter().map(Range::len).sum();
        assert_eq!(atoms as u32, snapshot.state.nodes()[0].done);
    }
}

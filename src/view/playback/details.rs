//! What there is to know of a machine, an atom or a message: what lights up with it, and what is said of it.

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
use crate::view::state::run_state::RunState;
use crate::view::text::format::{count, duration, node_name, time_words};
use crate::view::text::tooltips::{Fact, atom_words, flight_words, node_facts};
use crate::view::timeline::landmarks::Subject;

/// What is known of it whatever moment is shown; found by looking through the run, so not for every frame.
#[derive(Clone, Debug)]
pub struct Details {
    /// What it is of.
    pub about: Subject,
    /// The message itself.
    flight: Option<Flight>,
    /// Why it carries so much.
    why: Option<String>,
    /// Who traced the atom, and when.
    bar: Option<(NodeId, Traced)>,
}

/// What lights up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Highlight {
    /// Machines.
    pub nodes: Vec<NodeId>,
    /// Atoms.
    pub atoms: Vec<Range<Atom>>,
    /// A message, by its name in the run.
    pub message: Option<u64>,
    /// The bar of an atom.
    pub bar: Option<(NodeId, Traced)>,
}

impl Details {
    /// Looks through the run for what is known of `about`.
    pub fn of(about: Subject, log: &RunLog, lanes: &Lanes, past: &mut SnapshotCache, language: Language) -> Self {
        let mut dossier = Self { about, flight: None, why: None, bar: None };
        match about {
            Subject::Node(_) => {}
            Subject::Atom(atom) => dossier.bar = lanes.bar_of(atom),
            Subject::Message(id) => {
                let is_it = |what: &RecordKind| matches!(what, RecordKind::Sent { id: other, .. } if *other == id);
                let Some(index) = log.records().iter().rposition(|record| is_it(&record.what)) else { return dossier };
                let record = &log.records()[index];
                let RecordKind::Sent { from, to, message, arrives, .. } = &record.what else { return dossier };
                let flight = Flight::new(id, (*from, *to), message, record.at, *arrives);
                if let (Party::Node(from), Party::Node(to), Cargo::Transfer(_)) = (*from, *to, &flight.cargo) {
                    let mut moment = Snapshot::new(&log.header);
                    past.go(log, index + 1, &mut moment);
                    dossier.why = share_words(&moment.state, from, to, flight.cargo.atoms(), language);
                }
                dossier.flight = Some(flight);
            }
        }
        dossier
    }

    /// Whether nothing more can become known of it.
    pub fn is_complete(&self) -> bool {
        match self.about {
            Subject::Node(_) => true,
            Subject::Atom(_) => self.bar.is_some(),
            Subject::Message(_) => self.flight.is_some(),
        }
    }

    /// What lights up with it, where `state` is shown.
    pub fn lit(&self, state: &RunState) -> Highlight {
        match self.about {
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

    /// What is said of it at `now`: a title, and a line of what else there is. Times are told as exactly as
    /// [`time_words`] does at the rate `grain`.
    pub fn words(&self, state: &RunState, now: Time, grain: f64, language: Language) -> (String, String) {
        match self.about {
            Subject::Node(node) => {
                let facts = node_facts(state, node, now, language);
                let of = |fact: Fact| facts.iter().find(|(other, _)| *other == fact)?.1.as_deref();
                let said = [Fact::Offers, Fact::Gave, Fact::Got, Fact::Asked, Fact::Stole, Fact::Lost];
                let shared = said.iter().filter_map(|fact| Some((fact.name(language), of(*fact)?)));
                let shared: String = shared.map(|(what, value)| format!(", {what}: {value}")).collect();
                let value = |fact| of(fact).unwrap_or(word!(language, "unknown", "desconhecido"));
                let (name, does, speed) = (node_name(node), value(Fact::State), value(Fact::Speed));
                let [done, left, idle] = [Fact::Done, Fact::Left, Fact::Idle].map(value);
                let title = say!(
                    language,
                    "Machine {name} is {does}, at a speed of {speed}",
                    "A máquina {name} está {does}, à velocidade de {speed}"
                );
                let more = say!(
                    language,
                    "{done} done, {left} left, idle {idle} of its time{shared}",
                    "calculou {done}, ainda tem {left}, ociosa {idle} do tempo{shared}"
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
                    let [from, to] = [bar.from, bar.to].map(|time| time_words(time, grain * 0.01, language));
                    let is = if bar.to <= now {
                        word!(language, "was", "o calculou")
                    } else {
                        word!(language, "will be", "o calculará")
                    };
                    say!(
                        language,
                        " · machine {name} {is} at it from {from} to {to}, for {took} at its speed",
                        " · a máquina {name} {is} de {from} a {to}, {took} à sua velocidade"
                    )
                });
                (atom_words(state, atom, now, language), format!("{place}{}", traced.unwrap_or_default()))
            }
            Subject::Message(_) => match &self.flight {
                None => {
                    let title =
                        word!(language, "A message that is not known any more", "Uma mensagem que não se conhece mais");
                    (title.into(), String::new())
                }
                Some(flight) => {
                    let [sent, arrives] =
                        [flight.sent, flight.arrives].map(|time| time_words(time, grain * 0.01, language));
                    let took = duration(flight.arrives.since(flight.sent), language);
                    let why = self.why.as_ref().map(|why| format!("{why} · ")).unwrap_or_default();
                    let arrived = if flight.arrives <= now {
                        word!(language, "arrived", "chegou")
                    } else {
                        word!(language, "arrives", "chega")
                    };
                    let more = say!(
                        language,
                        "{why}left at {sent}, {arrived} at {arrives}, {took} later",
                        "{why}saiu em {sent}, {arrived} em {arrives}, {took} depois"
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
    fn the_biggest_transfer_says_why_it_is_that_big_and_which_atoms_it_has() {
        let language = Language::English;
        let log = sample_runs::log(&[1.0, 1.0, 0.1], 900);
        let RunView { latest: moment, lanes, .. } = RunView::of(&log);
        let found = landmarks(&log, language);
        let biggest = found.iter().find(|mark| mark.words.starts_with("The biggest")).unwrap();
        let mut past = SnapshotCache::default();
        let dossier = Details::of(biggest.about, &log, &lanes, &mut past, language);
        let lit = dossier.lit(&moment.state);
        let (title, more) = dossier.words(&moment.state, moment.state.head(), 1.0, language);
        let atoms: usize = lit.atoms.iter().map(Range::len).sum();
        assert!(lit.nodes.len() == 2 && title.starts_with(&format!("{atoms} atoms from ")), "{title}");
        assert!(
            more.contains(" that waited with machine ") && more.contains(" had traced ") && more.contains("left at "),
            "{more}"
        );
    }

    #[test]
    fn an_atom_lights_up_its_bar_and_its_machine() {
        let language = Language::English;
        let log = sample_runs::log(&[1.0, 0.5], 40);
        let RunView { latest: moment, lanes, .. } = RunView::of(&log);
        let dossier = Details::of(Subject::Atom(7), &log, &lanes, &mut SnapshotCache::default(), language);
        let lit = dossier.lit(&moment.state);
        assert_eq!((lit.atoms.len(), lit.bar.map(|(node, _)| vec![node])), (1, Some(lit.nodes.clone())));
        let whole =
            Details::of(Subject::Node(0), &log, &lanes, &mut SnapshotCache::default(), language).lit(&moment.state);
        let atoms: usize = whole.atoms.iter().map(Range::len).sum();
        assert_eq!(atoms as u32, moment.state.nodes()[0].done);
    }
}

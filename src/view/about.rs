//! What there is to know of a machine, an atom or a message: what lights up with it, and what is said of it.

use std::ops::Range;

use super::flight::{Cargo, Flight};
use super::hover::{atom_words, flight_words, node_words};
use super::lanes::{Lanes, Traced};
use super::moment::{Moment, Past};
use super::state::RunState;
use super::steps::About;
use super::why::share_words;
use super::words::{count, duration, node_name, time_words};
use crate::balance::{NodeId, Party};
use crate::picture::{Atom, push_atom};
use crate::record::What;
use crate::runlog::RunLog;
use crate::time::Time;

/// What is known of it whatever moment is shown; found by looking through the run, so not for every frame.
#[derive(Clone, Debug)]
pub struct Dossier {
    /// What it is of.
    pub about: About,
    /// The message itself.
    flight: Option<Flight>,
    /// Why it carries so much.
    why: Option<String>,
    /// Who traced the atom, and when.
    bar: Option<(NodeId, Traced)>,
}

/// What lights up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lit {
    /// Machines.
    pub nodes: Vec<NodeId>,
    /// Atoms.
    pub atoms: Vec<Range<Atom>>,
    /// A message, by its name in the run.
    pub message: Option<u64>,
    /// The bar of an atom.
    pub bar: Option<(NodeId, Traced)>,
}

impl Dossier {
    /// Looks through the run for what is known of `about`.
    pub fn of(about: About, log: &RunLog, lanes: &Lanes, past: &mut Past) -> Self {
        let mut dossier = Self { about, flight: None, why: None, bar: None };
        match about {
            About::Node(_) => {}
            About::Atom(atom) => dossier.bar = lanes.bar_of(atom),
            About::Message(id) => {
                let is_it = |what: &What| matches!(what, What::Sent { id: other, .. } if *other == id);
                let Some(index) = log.records().iter().rposition(|record| is_it(&record.what)) else { return dossier };
                let record = &log.records()[index];
                let What::Sent { from, to, message, arrives, .. } = &record.what else { return dossier };
                let flight = Flight::new(id, (*from, *to), message, record.at, *arrives);
                if let (Party::Node(from), Party::Node(to), Cargo::Transfer(_)) = (*from, *to, &flight.cargo) {
                    let mut moment = Moment::new(&log.header);
                    past.go(log, index + 1, &mut moment);
                    dossier.why = share_words(&moment.state, from, to, flight.cargo.atoms());
                }
                dossier.flight = Some(flight);
            }
        }
        dossier
    }

    /// Whether nothing more can become known of it.
    pub fn is_complete(&self) -> bool {
        match self.about {
            About::Node(_) => true,
            About::Atom(_) => self.bar.is_some(),
            About::Message(_) => self.flight.is_some(),
        }
    }

    /// What lights up with it, where `state` is shown.
    pub fn lit(&self, state: &RunState) -> Lit {
        match self.about {
            About::Node(node) => {
                let mut atoms = Vec::new();
                for (atom, place) in (0..).zip(state.places()) {
                    if place.holder() == Some(node) {
                        push_atom(&mut atoms, atom);
                    }
                }
                Lit { nodes: vec![node], atoms, ..Lit::default() }
            }
            About::Atom(atom) => {
                let holder = state.places().get(atom as usize).and_then(|place| place.holder());
                let atoms = std::iter::once(atom..atom.saturating_add(1)).collect();
                Lit { nodes: holder.into_iter().collect(), atoms, bar: self.bar, ..Lit::default() }
            }
            About::Message(id) => {
                let parties = self.flight.iter().flat_map(|flight| [flight.from, flight.to]);
                let nodes = parties.filter_map(|party| match party {
                    Party::Node(node) => Some(node),
                    Party::Parent => None,
                });
                let atoms = self.flight.as_ref().map_or_else(Vec::new, |flight| flight.cargo.ranges().to_vec());
                Lit { nodes: nodes.collect(), atoms, message: Some(id), ..Lit::default() }
            }
        }
    }

    /// What is said of it at `now`: a title, and a line of what else there is. Times are told as exactly as
    /// [`time_words`] does at the rate `grain`.
    pub fn words(&self, state: &RunState, now: Time, grain: f64) -> (String, String) {
        match self.about {
            About::Node(node) => {
                let words = node_words(state, node, now);
                let of = |what: &str| words.iter().find(|(other, _)| *other == what).map(|(_, value)| value.as_str());
                let said = ["offers", "gave", "got", "asked", "stole", "lost"];
                let shared = said.iter().filter_map(|what| Some((what, of(what).filter(|value| *value != "nothing")?)));
                let shared: String = shared.map(|(what, value)| format!(", {what}: {value}")).collect();
                let value = |what: &str| of(what).unwrap_or("unknown").to_owned();
                let title =
                    format!("Machine {} is {}, at a speed of {}", node_name(node), value("state"), value("speed"));
                (
                    title,
                    format!(
                        "{} done, {} left, idle {} of its time{shared}",
                        value("done"),
                        value("left"),
                        value("idle")
                    ),
                )
            }
            About::Atom(atom) => {
                let pixels = state.division().pixels(atom);
                let place =
                    format!("pixels {} to {} in scan order", count(pixels.start), count(pixels.end.saturating_sub(1)));
                let traced = self.bar.map(|(node, bar)| {
                    let took = duration(bar.to.since(bar.from));
                    let [from, to] = [bar.from, bar.to].map(|time| time_words(time, grain * 0.01));
                    let is = if bar.to <= now { "was" } else { "will be" };
                    format!(" · machine {} {is} at it from {from} to {to}, for {took} at its speed", node_name(node))
                });
                (atom_words(state, atom, now), format!("{place}{}", traced.unwrap_or_default()))
            }
            About::Message(_) => match &self.flight {
                None => ("A message that is not known any more".into(), String::new()),
                Some(flight) => {
                    let [sent, arrives] = [flight.sent, flight.arrives].map(|time| time_words(time, grain * 0.01));
                    let took = duration(flight.arrives.since(flight.sent));
                    let why = self.why.as_ref().map(|why| format!("{why} · ")).unwrap_or_default();
                    let arrived = if flight.arrives <= now { "arrived" } else { "arrives" };
                    (flight_words(flight), format!("{why}left at {sent}, {arrived} at {arrives}, {took} later"))
                }
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::known::Known;
    use super::super::sample;
    use super::super::steps::landmarks;
    use super::*;

    #[test]
    fn the_biggest_transfer_says_why_it_is_that_big_and_which_atoms_it_has() {
        let log = sample::log(&[1.0, 1.0, 0.1], 900);
        let Known { latest: moment, lanes, .. } = Known::of(&log);
        let found = landmarks(&log);
        let biggest = found.iter().find(|mark| mark.words.starts_with("The biggest")).unwrap();
        let mut past = Past::default();
        let dossier = Dossier::of(biggest.about, &log, &lanes, &mut past);
        let lit = dossier.lit(&moment.state);
        let (title, more) = dossier.words(&moment.state, moment.state.head(), 1.0);
        let atoms: usize = lit.atoms.iter().map(Range::len).sum();
        assert!(lit.nodes.len() == 2 && title.starts_with(&format!("{atoms} atoms from ")), "{title}");
        assert!(
            more.contains(" that waited with machine ") && more.contains(" had traced ") && more.contains("left at "),
            "{more}"
        );
    }

    #[test]
    fn an_atom_lights_up_its_bar_and_its_machine() {
        let log = sample::log(&[1.0, 0.5], 40);
        let Known { latest: moment, lanes, .. } = Known::of(&log);
        let dossier = Dossier::of(About::Atom(7), &log, &lanes, &mut Past::default());
        let lit = dossier.lit(&moment.state);
        assert_eq!((lit.atoms.len(), lit.bar.map(|(node, _)| vec![node])), (1, Some(lit.nodes.clone())));
        let whole = Dossier::of(About::Node(0), &log, &lanes, &mut Past::default()).lit(&moment.state);
        let atoms: usize = whole.atoms.iter().map(Range::len).sum();
        assert_eq!(atoms as u32, moment.state.nodes()[0].done);
    }
}

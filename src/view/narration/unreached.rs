//! A machine that stands still with atoms, while a neighbour answers all offers before they reach it.

use crate::balance::{Condition, NodeId, Remedy};
use crate::language::{Language, say, word};
use crate::time::Time;
use crate::view::narration::share::atoms_in_queue;
use crate::view::state::run_state::RunState;
use crate::view::text::format::{atoms_words, duration, node_name};

/// A machine that no offer of help reaches at present.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unreached {
    /// The machine.
    pub node: NodeId,
    /// Whether it is paused; else its speed is 0.
    pub is_paused: bool,
    /// When it was stopped.
    pub since: Time,
    /// Its atoms.
    pub atoms: u32,
    /// The machine that answers offers first.
    pub answers: NodeId,
}

impl Unreached {
    /// Finds the machine with the most atoms of those that stand still and that no offer reaches; `None` if there is
    /// none with a hundredth of the picture: few atoms are soon taken over.
    pub(crate) fn of(state: &RunState) -> Option<Self> {
        let is_large = |unreached: &Self| 100 * u64::from(unreached.atoms) >= u64::from(state.atoms());
        let all = (0..state.nodes().len() as NodeId).filter_map(|node| Self::at(state, node).filter(is_large));
        // Among equals, the first.
        all.rev().max_by_key(|unreached| unreached.atoms)
    }

    /// Describes `node`, if it stands still and no offer reaches it.
    pub(crate) fn at(state: &RunState, node: NodeId) -> Option<Self> {
        let machine = state.nodes().get(usize::from(node))?;
        let stands_still = machine.condition == Condition::Well && !machine.runs();
        // In a large adaptive ring an offer does not go from neighbour to neighbour.
        if !state.scheduler.is_ring() || state.has(Remedy::Shortcuts) || !stands_still {
            return None;
        }
        let (atoms, since) = (machine.left(), machine.stopped_since?);
        let answers = first_to_answer(state, node).filter(|_| atoms_in_queue(atoms) > 0)?;
        Some(Self { node, is_paused: machine.paused, since, atoms, answers })
    }

    /// Says since when it is stopped, and with how many atoms: `paused since 8.2 s with 567 atoms`.
    pub(crate) fn is_stopped_words(&self, language: Language) -> String {
        let since = match self.since {
            Time::ZERO => word!(language, "the beginning", "o início").into(),
            since => duration(since.since(Time::ZERO), language),
        };
        let atoms = atoms_words(self.atoms, language);
        let is =
            if self.is_paused { word!(language, "paused", "em pausa") } else { word!(language, "stopped", "parada") };
        say!(language, "{is} since {since} with {atoms}", "{is} desde {since} com {atoms}")
    }

    /// Says that no offer reaches it, and why.
    pub(crate) fn sentence(&self, language: Language) -> String {
        let (name, is, first) = (node_name(self.node), self.is_stopped_words(language), node_name(self.answers));
        say!(
            language,
            "{name} has been {is}: no offer reaches it, because {first} answers first",
            "{name} está {is}: nenhuma oferta chega a ela, pois {first} responde antes"
        )
    }
}

/// Finds the machine that answers all offers before they reach `node`: they come from its right neighbour. `None` if
/// an offer of a machine in between reaches it.
fn first_to_answer(state: &RunState, node: NodeId) -> Option<NodeId> {
    let nodes = state.nodes().len();
    let before = (1..nodes).map(|hops| (usize::from(node) + hops) % nodes);
    let mut awake = before.filter(|&other| !state.nodes()[other].retired);
    let next = awake.next()?;
    (atoms_in_queue(state.nodes()[next].left()) > 0).then_some(next as NodeId)
}

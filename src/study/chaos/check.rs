//! Checks the invariants of a run on its records, as they come.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use thiserror::Error;

use super::plan::ChaosPlan;
use crate::balance::adaptive::RingMembers;
use crate::balance::{Action, Condition, Message, NodeId, OfferDetails, Party, Remedy, Strategy};
use crate::picture::{Atom, atoms_in};
use crate::record::{Record, RecordKind};
use crate::runlog::ResultsInFlight;
use crate::sim::Sim;
use crate::time::Time;

/// A run with more records counts as endless.
const MAX_RECORDS: u64 = 1_000_000;

/// A run that lasts longer counts as endless.
const MAX_TIME: Time = Time(100_000 * 1_000_000_000);

/// Changes a party's actions: returns how often an action is carried out.
pub(super) type Tamper = Box<dyn FnMut(Party, &Action) -> usize + Send>;

/// A property that a run violates.
#[derive(Clone, Debug, Error)]
pub(super) enum Violation {
    #[error("the run does not end")]
    Endless,
    #[error("node {node} sends atom {atom}, which it has not traced")]
    SentUntraced { node: NodeId, atom: Atom },
    #[error("the offer that node {offerer} made at {} s is in two places", made.secs())]
    OfferInTwoPlaces { offerer: NodeId, made: Time },
    #[error("the parent hands out {0:?} again, but nothing was lost")]
    AgainWithoutLoss(Vec<Range<Atom>>),
    #[error("the run is deadlocked, and {missing} atoms are missing")]
    Deadlock { missing: usize },
    #[error("the run ended without atom {0}")]
    EndedWithoutAtom(usize),
    #[error("{messages} messages are more than the bound of {bound}")]
    TooManyMessages { messages: u64, bound: f64 },
    #[error("a machine or the parent panicked: {0}")]
    Panic(String),
}

/// Totals of a run.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RunTotals {
    pub records: u64,
    /// Atoms that the parent handed out again.
    pub again: u64,
    /// Number of messages divided by their bound, [`Check::bound`].
    pub share_of_bound: f64,
}

/// Runs a plan in virtual time and checks every record.
///
/// # Errors
/// The first [`Violation`].
pub(super) fn run(plan: &ChaosPlan, tamper: Option<Tamper>) -> Result<RunTotals, Violation> {
    let costs = plan.costs.clone();
    let mut sim = Sim::new(&plan.header, &plan.script, move |atom| costs[atom as usize]);
    if let Some(tamper) = tamper {
        sim.tamper(tamper);
    }
    let mut check = Check::new(plan);
    while let Some(next) = sim.next() {
        sim.advance(next, &mut |record| check.record(&record));
        if let Some(violation) = check.violation.take() {
            return Err(violation);
        }
        if check.totals.records > MAX_RECORDS || next > MAX_TIME {
            return Err(Violation::Endless);
        }
    }
    check.end(sim.is_finished())
}

/// State of the checks of a run.
struct Check<'a> {
    plan: &'a ChaosPlan,
    totals: RunTotals,
    violation: Option<Violation>,
    /// By node: atoms traced and not yet sent.
    traced: Vec<BTreeSet<Atom>>,
    /// By atom: how often its result has reached the parent.
    placed: Vec<u32>,
    /// Results in flight to the parent.
    results: ResultsInFlight,
    /// Offers by offerer and time, with the stops left when last sent.
    offers: BTreeMap<(NodeId, Time), u16>,
    messages: u64,
    atoms_done: u64,
    gone: u64,
    /// Times that a machine was switched off; at most so many fresh starts follow.
    switched_off: u64,
    last: Time,
}

impl<'a> Check<'a> {
    fn new(plan: &'a ChaosPlan) -> Self {
        let nodes = plan.header.speeds.len();
        Self {
            plan,
            totals: RunTotals::default(),
            violation: None,
            traced: vec![BTreeSet::new(); nodes],
            placed: vec![0; plan.costs.len()],
            results: ResultsInFlight::default(),
            offers: BTreeMap::new(),
            messages: 0,
            atoms_done: 0,
            gone: 0,
            switched_off: 0,
            last: Time::ZERO,
        }
    }

    fn record(&mut self, record: &Record) {
        self.totals.records += 1;
        self.last = record.at;
        for atom in self.results.apply(&record.kind).into_iter().flatten() {
            self.placed[atom as usize] += 1;
        }
        match &record.kind {
            RecordKind::Sent { from, message, .. } => self.sent(*from, message),
            RecordKind::AtomDone { node, atom, .. } => {
                self.atoms_done += 1;
                self.traced[usize::from(*node)].insert(*atom);
            }
            RecordKind::Condition { node, condition: Condition::Off } => {
                self.traced[usize::from(*node)].clear();
                self.switched_off += 1;
            }
            _ => {}
        }
    }

    fn sent(&mut self, from: Party, message: &Message) {
        self.messages += 1;
        match (from, message) {
            (Party::Node(node), Message::Results(ranges)) => {
                for atom in ranges.iter().cloned().flatten() {
                    if !self.traced[usize::from(node)].remove(&atom) {
                        self.fail(Violation::SentUntraced { node, atom });
                    }
                }
            }
            (_, Message::Offer { who, help: Some(OfferDetails { sent, left: Some(left), .. }), .. }) => {
                let before = self.offers.insert((*who, *sent), *left);
                if before.is_some_and(|before| before <= *left && before > 0) {
                    self.fail(Violation::OfferInTwoPlaces { offerer: *who, made: *sent });
                }
            }
            (Party::Parent, Message::Again(ranges)) => {
                self.totals.again += u64::from(atoms_in(ranges));
                if self.plan.faultless {
                    self.fail(Violation::AgainWithoutLoss(ranges.clone()));
                }
            }
            (Party::Parent, Message::Gone(_)) => self.gone += 1,
            _ => {}
        }
    }

    fn end(mut self, finished: bool) -> Result<RunTotals, Violation> {
        if !finished {
            let missing = self.placed.iter().filter(|&&times| times == 0).count();
            return Err(Violation::Deadlock { missing });
        }
        if let Some(atom) = self.placed.iter().position(|&times| times == 0) {
            return Err(Violation::EndedWithoutAtom(atom));
        }
        self.totals.share_of_bound = self.messages as f64 / self.bound();
        if self.totals.share_of_bound > 1.0 {
            return Err(Violation::TooManyMessages { messages: self.messages, bound: self.bound() });
        }
        Ok(self.totals)
    }

    /// The most messages that the run may need (see the READMEs of `balance::adaptive` and `balance::farm_leases`).
    fn bound(&self) -> f64 {
        let nodes = self.plan.header.speeds.len();
        let rules = &self.plan.header.rules;
        let beats = self.last.secs() / rules.beat.as_secs_f64();
        if rules.strategy == Strategy::FarmLeases {
            let moments = nodes as f64 * (beats + 4.0) + 2.0 * self.switched_off as f64;
            return 4.0 * (self.atoms_done as f64 + moments);
        }
        let stops = RingMembers::new(nodes as NodeId, rules.remedies.has(Remedy::Shortcuts)).stops();
        let moments = self.atoms_done as f64 + nodes as f64 * (beats + 2.0) + self.gone as f64;
        3.0 * f64::from(stops + 2) * moments
    }

    fn fail(&mut self, violation: Violation) {
        self.violation.get_or_insert(violation);
    }
}

//! What has to be true of every run, whatever befalls it: looked for in its records, as they come.

use std::collections::{BTreeMap, BTreeSet};

use super::plan::ChaosPlan;
use crate::balance::adaptive::RingMembers;
use crate::balance::{Action, Condition, Message, NodeId, OfferDetails, Party, Remedy};
use crate::picture::{Atom, atoms_in};
use crate::record::{Record, RecordKind};
use crate::runlog::ResultsInFlight;
use crate::sim::Sim;
use crate::time::Time;

/// A run that takes more records than this does not end.
const MOST_RECORDS: u64 = 1_000_000;

/// Nor one that takes so long.
const LONGEST: Time = Time(100_000 * 1_000_000_000);

/// Changes what a party does: how often an action of it is carried out.
pub(super) type Tamper = Box<dyn FnMut(Party, &Action) -> usize + Send>;

/// What a run amounted to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RunTotals {
    pub records: u64,
    /// Atoms that the parent gave out again.
    pub again: u64,
    /// Messages over the bound that is stated.
    pub of_bound: f64,
}

/// Lets a run happen.
///
/// # Errors
/// A sentence that says what is wrong with it.
pub(super) fn run(plan: &ChaosPlan, tamper: Option<Tamper>) -> Result<RunTotals, String> {
    let costs = plan.costs.clone();
    let mut sim = Sim::new(&plan.header, &plan.script, move |atom| costs[atom as usize]);
    if let Some(tamper) = tamper {
        sim.tamper(tamper);
    }
    let mut check = Check::new(plan);
    while let Some(next) = sim.next() {
        sim.advance(next, &mut |record| check.record(&record));
        if let Some(wrong) = check.wrong.take() {
            return Err(wrong);
        }
        if check.outcome.records > MOST_RECORDS || next > LONGEST {
            return Err("it does not end".into());
        }
    }
    check.end(sim.is_finished())
}

/// What has been seen of a run.
struct Check<'a> {
    plan: &'a ChaosPlan,
    outcome: RunTotals,
    wrong: Option<String>,
    /// By node: the atoms that it has traced and not sent.
    traced: Vec<BTreeSet<Atom>>,
    stopped: Vec<bool>,
    /// By atom: how often it has reached the parent.
    placed: Vec<u32>,
    /// Results on their way to the parent.
    results: ResultsInFlight,
    /// Offers, and how many stops they had left when they were last sent.
    offers: BTreeMap<(NodeId, Time), u16>,
    messages: u64,
    atoms_done: u64,
    gone: u64,
    last: Time,
}

impl<'a> Check<'a> {
    fn new(plan: &'a ChaosPlan) -> Self {
        let nodes = plan.header.speeds.len();
        Self {
            plan,
            outcome: RunTotals::default(),
            wrong: None,
            traced: vec![BTreeSet::new(); nodes],
            stopped: vec![false; nodes],
            placed: vec![0; plan.costs.len()],
            results: ResultsInFlight::default(),
            offers: BTreeMap::new(),
            messages: 0,
            atoms_done: 0,
            gone: 0,
            last: Time::ZERO,
        }
    }

    fn record(&mut self, record: &Record) {
        self.outcome.records += 1;
        self.last = record.at;
        for atom in self.results.apply(&record.what).into_iter().flatten() {
            self.placed[atom as usize] += 1;
        }
        match &record.what {
            RecordKind::Sent { from, message, .. } => self.sent(*from, message),
            RecordKind::AtomStarted { node, atom } if self.stopped[usize::from(*node)] => {
                self.fail(format!("node {node} begins atom {atom} after its shutdown"));
            }
            RecordKind::AtomDone { node, atom, .. } => {
                self.atoms_done += 1;
                self.traced[usize::from(*node)].insert(*atom);
            }
            RecordKind::Condition { node, condition: Condition::Off } => self.traced[usize::from(*node)].clear(),
            _ => {}
        }
    }

    fn sent(&mut self, from: Party, message: &Message) {
        self.messages += 1;
        match (from, message) {
            (Party::Node(node), Message::Results(ranges)) => {
                for atom in ranges.iter().cloned().flatten() {
                    if !self.traced[usize::from(node)].remove(&atom) {
                        self.fail(format!("node {node} sends atom {atom}, which it has not traced"));
                    }
                }
            }
            (_, Message::Offer { who, help: Some(OfferDetails { sent, left: Some(left), .. }), .. }) => {
                let before = self.offers.insert((*who, *sent), *left);
                if before.is_some_and(|before| before <= *left && before > 0) {
                    self.fail(format!("the offer of node {who} made at {} s is in two places", sent.secs()));
                }
            }
            (Party::Parent, Message::Again(ranges)) => {
                self.outcome.again += u64::from(atoms_in(ranges));
                if self.plan.calm {
                    self.fail(format!("{ranges:?} are given out again, and nothing was lost"));
                }
            }
            (Party::Parent, Message::Gone(_)) => self.gone += 1,
            _ => {}
        }
    }

    fn end(mut self, finished: bool) -> Result<RunTotals, String> {
        if !finished {
            let missing = self.placed.iter().filter(|&&times| times == 0).count();
            return Err(format!("it has come to a standstill, and {missing} atoms are missing"));
        }
        if let Some(atom) = self.placed.iter().position(|&times| times == 0) {
            return Err(format!("it ended without atom {atom}"));
        }
        self.outcome.of_bound = self.messages as f64 / self.bound();
        if self.outcome.of_bound > 1.0 {
            return Err(format!("{} messages are more than the bound of {}", self.messages, self.bound()));
        }
        Ok(self.outcome)
    }

    /// The most messages that such a run may need (see the ring's README).
    fn bound(&self) -> f64 {
        let nodes = self.plan.header.speeds.len();
        let rules = self.plan.header.rules;
        let stops = RingMembers::new(nodes as NodeId, rules.remedies.has(Remedy::Shortcuts)).stops();
        let beats = self.last.secs() / rules.beat.as_secs_f64();
        let moments = self.atoms_done as f64 + nodes as f64 * (beats + 2.0) + self.gone as f64;
        3.0 * f64::from(stops + 2) * moments
    }

    fn fail(&mut self, why: String) {
        self.wrong.get_or_insert(why);
    }
}

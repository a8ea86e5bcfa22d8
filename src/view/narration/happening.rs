//! Events of a run, with the facts that their sentences need. The sentences are made where they are drawn.

use std::cmp::Ordering;
use std::ops::Range;
use std::time::Duration;

use super::failure::Failure;
use super::share::{Share, atoms_in_queue};
use super::unreached::Unreached;
use crate::balance::{NodeId, PIPE_ATOMS, Party, Remedy, Scheduler};
use crate::picture::Atom;
use crate::record::{Record, RecordKind};
use crate::view::state::node_state::NodeState;
use crate::view::state::run_state::RunState;

/// An event of a run, without a language.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the comment on a variant covers its fields")]
pub enum Happening {
    /// The last atom is placed.
    Complete,
    /// The parent samples the picture for an estimate.
    Estimating,
    /// The parent hands out the bands.
    Bands {
        machines: usize,
        /// Atoms in the first band.
        first: u32,
        /// The first band is the whole picture.
        is_whole: bool,
        scheduler: Scheduler,
    },
    /// A node of a farm asked for atoms and got this many.
    Part { to: NodeId, atoms: u32 },
    /// The parent of a farm has handed out this many parts so far.
    PartsSoFar(u32),
    /// Messages wait at the parent, which needs `handling` for each.
    Queue { waiting: usize, handling: Duration },
    /// Nodes have finished their fixed bands; others have not.
    BandsDone(Vec<NodeId>),
    /// Nodes retire.
    Retired { nodes: Vec<NodeId>, reason: Retirement },
    /// A node offers help.
    Offer { node: NodeId, reason: OfferReason },
    /// A thread stole atoms.
    Theft { thief: NodeId, from: NodeId, atoms: u32 },
    /// A node that made an offer takes over atoms.
    Takeover {
        from: NodeId,
        to: NodeId,
        atoms: u32,
        giver: Giver,
        share: Option<Share>,
        /// The node offered help while it still had atoms.
        is_early: bool,
        /// A machine that the offer did not reach, because `from` answered it.
        unreached: Option<Unreached>,
    },
    /// A node that made an offer was given `atoms` of the `waiting` ones; `slow_at` is the giver's speed if it is slow.
    Gift { from: NodeId, to: NodeId, atoms: u32, waiting: u32, slow_at: Option<f64> },
    /// Small transfers of one giver, joined.
    SmallTransfers { from: NodeId, to: Vec<NodeId>, transfers: u32, atoms: u32, is_theft: bool },
    /// A machine's speed is changed.
    Speed { node: NodeId, speed: f64, effect: SpeedEffect },
    /// A machine is paused while it has `atoms`.
    Paused { node: NodeId, atoms: u32, effect: PauseEffect },
    /// A machine's pause is over; its speed may still be 0.
    Resumed { node: NodeId, is_stopped: bool },
    /// The latency of all nodes that have none of their own is changed.
    Latency { latency: Duration, is_hop: bool },
    /// A party's own latency is changed.
    OwnLatency { party: Party, latency: Option<Duration> },
    /// A machine or a link fails, or the ring recovers.
    Failure(Failure),
}

/// Why a node retires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Retirement {
    /// The parent of a farm has no atoms left.
    NothingLeft,
    /// The node sleeps until another one wakes it.
    Sleeps,
    /// The node's own offer came back.
    OfferCameBack,
}

/// Why a node offers help.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfferReason {
    /// The node has nearly finished its atoms.
    Early,
    /// The node never had an atom.
    NothingToTrace,
    /// The node has traced its whole band itself.
    BandDone,
    /// The node's atoms are traced or given away.
    NoAtomsLeft,
}

/// State of a node that gives atoms away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Giver {
    /// Paused.
    Paused,
    /// At speed 0.
    Stopped,
    /// Slow, at this speed.
    Slow(f64),
    /// Busy, at a usual speed.
    Busy,
}

/// Effect of a new speed on the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedEffect {
    /// No effect.
    None,
    /// The new speed has an effect only after the machine's pause.
    AfterPause,
    /// No other machine takes over atoms of the machine's band.
    NobodyHelps,
    /// The machine finishes its band sooner.
    BandSooner,
    /// The machine asks the parent less often.
    AsksLess,
    /// The machine asks the parent more often.
    AsksMore,
    /// The machine keeps its atoms.
    KeepsPart,
    /// The parent will give the machine's atoms out again, after a long time.
    PartReturns,
    /// The other machines take over the machine's work.
    OthersHelp,
    /// The other machines take over the machine's work, but this one answers offers before.
    AnswersFirst(NodeId),
    /// The machine can take more work.
    TakesMore,
    /// The machine traces its last atoms sooner; too few wait with others.
    AtomsSooner,
    /// The machine has retired and takes no more work.
    Retired,
}

/// Effect of a pause on the atoms of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PauseEffect {
    /// No effect.
    None,
    /// The machine keeps its atoms: they are its part of a farm.
    KeepsPart,
    /// The parent will give the machine's part out again, after a long time.
    PartReturns,
    /// The atoms wait: no machine takes over atoms of a band.
    NobodyHelps,
    /// The atoms are in the machine's pipe and stay there.
    KeepsPipe,
    /// The other machines take the atoms over.
    OthersHelp,
    /// The other machines take the atoms over, but this one answers offers before.
    AnswersFirst(NodeId),
}

impl Happening {
    /// Describes a record that needs no context; `None` for messages and atoms. `state` already knows the record.
    pub(crate) fn of(record: &Record, state: &RunState) -> Option<Self> {
        Some(match &record.kind {
            RecordKind::Estimating => Self::Estimating,
            RecordKind::SpeedSet { node, speed } => {
                let before = machine(state, *node).map_or(*speed, |node| node.previous_speed);
                Self::speed(state, *node, before, *speed)
            }
            RecordKind::Paused { node } => Self::paused(state, *node),
            RecordKind::Resumed { node } => Self::resumed(state, *node),
            RecordKind::LatencySet { latency } => Self::latency(state, *latency),
            RecordKind::OwnLatencySet { party, latency } => Self::OwnLatency { party: *party, latency: *latency },
            RecordKind::Condition { node, .. } => Self::Failure(Failure::condition(state, *node)?),
            RecordKind::Delayed { from, to, until } => {
                Self::Failure(Failure::Delayed { from: *from, to: *to, by: until.since(record.at) })
            }
            RecordKind::Retired { node } => Self::retired(state, vec![*node]),
            RecordKind::Finished => Self::Complete,
            _ => return None,
        })
    }

    /// Whether it tells of the same as `listed`, an event of the list with the same time.
    pub(crate) fn tells_of(&self, listed: &Self) -> bool {
        match (self, listed) {
            (Self::Takeover { from, to, atoms, .. }, Self::Gift { from: giver, to: taker, atoms: given, .. }) => {
                (from, to, atoms) == (giver, taker, given)
            }
            (
                Self::Takeover { from, to, .. } | Self::Theft { from, thief: to, .. },
                Self::SmallTransfers { from: giver, to: takers, .. },
            ) => from == giver && takers.contains(to),
            _ => std::mem::discriminant(self) == std::mem::discriminant(listed),
        }
    }

    /// Describes the parent's bands; `first` is the first of them.
    pub(crate) fn bands(state: &RunState, first: &Range<Atom>) -> Self {
        let first = first.len() as u32;
        let machines = state.nodes().iter().filter(|node| !node.spare).count();
        Self::Bands { machines, first, is_whole: first == state.atoms(), scheduler: state.scheduler.clone() }
    }

    /// Describes `waiting` messages at the parent.
    pub(crate) fn queue(state: &RunState, waiting: usize) -> Self {
        Self::Queue { waiting, handling: state.handling }
    }

    /// Describes why nodes retire.
    pub(crate) fn retired(state: &RunState, nodes: Vec<NodeId>) -> Self {
        let reason = match () {
            () if state.scheduler.is_farm() => Retirement::NothingLeft,
            () if state.has(Remedy::Wake) => Retirement::Sleeps,
            () => Retirement::OfferCameBack,
        };
        Self::Retired { nodes, reason }
    }

    /// Describes an offer by a node that has traced `done` atoms; `whole` if these are its whole band.
    pub(crate) fn offer(state: &RunState, node: NodeId, whole: bool, done: u32) -> Self {
        let is_early = state.has(Remedy::Early) && machine(state, node).is_some_and(|of| of.left() > 0);
        let reason = match (whole, done) {
            _ if is_early => OfferReason::Early,
            (_, 0) => OfferReason::NothingToTrace,
            (true, _) => OfferReason::BandDone,
            (false, _) => OfferReason::NoAtomsLeft,
        };
        Self::Offer { node, reason }
    }

    /// Describes a transfer while it happens.
    pub(crate) fn transfer(state: &RunState, from: NodeId, to: NodeId, atoms: u32) -> Self {
        if state.scheduler == Scheduler::WorkStealing {
            return Self::Theft { thief: to, from, atoms };
        }
        let giver = match machine(state, from) {
            Some(node) if node.paused => Giver::Paused,
            Some(node) if node.speed == 0.0 => Giver::Stopped,
            Some(node) if is_slow(node) => Giver::Slow(node.speed),
            _ => Giver::Busy,
        };
        let share = Share::of(state, from, to, atoms);
        let is_early = state.has(Remedy::Early) && machine(state, to).is_some_and(|of| of.left() > 0);
        let unreached = Unreached::of(state).filter(|unreached| unreached.answers == from);
        Self::Takeover { from, to, atoms, giver, share, is_early, unreached }
    }

    /// Describes a transfer for the list of events.
    pub(crate) fn gift(state: &RunState, from: NodeId, to: NodeId, atoms: u32) -> Self {
        if state.scheduler == Scheduler::WorkStealing {
            return Self::Theft { thief: to, from, atoms };
        }
        let slow_at = machine(state, from).filter(|node| node.runs() && is_slow(node)).map(|node| node.speed);
        let waiting = Share::of(state, from, to, atoms).map_or(atoms, |share| share.waiting);
        Self::Gift { from, to, atoms, waiting, slow_at }
    }

    /// Describes a new speed; `before` is the speed before the user began to change it.
    pub(crate) fn speed(state: &RunState, node: NodeId, before: f64, speed: f64) -> Self {
        let change = speed.total_cmp(&before);
        let effect = match change {
            _ if machine(state, node).is_some_and(|node| node.paused) => SpeedEffect::AfterPause,
            Ordering::Equal => SpeedEffect::None,
            _ if state.scheduler.is_fixed() && machine(state, node).is_none_or(|machine| machine.left() == 0) => {
                SpeedEffect::None
            }
            Ordering::Less if state.scheduler.is_fixed() => SpeedEffect::NobodyHelps,
            Ordering::Greater if state.scheduler.is_fixed() => SpeedEffect::BandSooner,
            _ if state.scheduler.is_farm() && speed == 0.0 && state.has(Remedy::Leases) => SpeedEffect::PartReturns,
            _ if state.scheduler.is_farm() && speed == 0.0 => SpeedEffect::KeepsPart,
            Ordering::Less if state.scheduler.is_farm() => SpeedEffect::AsksLess,
            Ordering::Greater if state.scheduler.is_farm() => SpeedEffect::AsksMore,
            Ordering::Less if can_be_helped(state, node) => match Unreached::at(state, node) {
                Some(unreached) => SpeedEffect::AnswersFirst(unreached.answers),
                None => SpeedEffect::OthersHelp,
            },
            Ordering::Less => SpeedEffect::None,
            Ordering::Greater => faster(state, node),
        };
        Self::Speed { node, speed, effect }
    }

    /// Describes a pause.
    pub(crate) fn paused(state: &RunState, node: NodeId) -> Self {
        let Some(machine) = machine(state, node) else {
            return Self::Paused { node, atoms: 0, effect: PauseEffect::None };
        };
        let atoms = machine.left();
        let effect = match atoms {
            0 if !state.scheduler.is_ring() && state.scheduler != Scheduler::WorkStealing => PauseEffect::None,
            _ if state.scheduler.is_farm() && state.has(Remedy::Leases) => PauseEffect::PartReturns,
            _ if state.scheduler.is_farm() => PauseEffect::KeepsPart,
            _ if state.scheduler.is_fixed() => PauseEffect::NobodyHelps,
            1..=PIPE_ATOMS if !state.has(Remedy::Copies) => PauseEffect::KeepsPipe,
            _ if can_be_helped(state, node) => match Unreached::at(state, node) {
                Some(unreached) => PauseEffect::AnswersFirst(unreached.answers),
                None => PauseEffect::OthersHelp,
            },
            _ => PauseEffect::None,
        };
        Self::Paused { node, atoms, effect }
    }

    /// Describes the end of a pause.
    pub(crate) fn resumed(state: &RunState, node: NodeId) -> Self {
        Self::Resumed { node, is_stopped: machine(state, node).is_some_and(|machine| machine.speed == 0.0) }
    }

    /// Describes a new latency of all nodes.
    pub(crate) fn latency(state: &RunState, latency: Duration) -> Self {
        Self::Latency { latency, is_hop: state.scheduler.is_ring() }
    }
}

/// Whether a machine is slow: slower than half of the usual speed.
pub(crate) fn is_slow(node: &NodeState) -> bool {
    node.speed < 0.5
}

fn machine(state: &RunState, node: NodeId) -> Option<&NodeState> {
    state.nodes().get(usize::from(node))
}

/// Whether others can take over atoms of a machine in a ring, or of a thread: atoms that it has, or soon gets.
fn can_be_helped(state: &RunState, node: NodeId) -> bool {
    let has_atoms = |machine: &NodeState| {
        let can_be_given = match state.has(Remedy::Copies) || state.scheduler == Scheduler::WorkStealing {
            true => machine.left(),
            false => atoms_in_queue(machine.left()),
        };
        can_be_given > 0 || machine.band_at.is_none()
    };
    let helps = |machine: &NodeState| machine.runs() && (!machine.retired || state.has(Remedy::Wake));
    machine(state, node).is_none_or(has_atoms)
        && (0..).zip(state.nodes()).any(|(other, machine)| other != node && helps(machine))
}

/// Tells the effect of a higher speed in a ring, or of a thread.
fn faster(state: &RunState, node: NodeId) -> SpeedEffect {
    /// Below this part of the picture, the atoms that wait with others are not worth a promise.
    const LEAST_PART: f64 = 0.02;
    let has_begun = state.nodes().iter().any(|machine| machine.band_at.is_some());
    let others = (0..).zip(state.nodes()).filter(|(other, _)| *other != node);
    let waiting: u32 = others.map(|(_, machine)| atoms_in_queue(machine.left())).sum();
    match machine(state, node) {
        Some(machine) if machine.retired && !state.has(Remedy::Wake) => SpeedEffect::Retired,
        _ if !has_begun || f64::from(waiting) >= LEAST_PART * f64::from(state.atoms()) => SpeedEffect::TakesMore,
        Some(machine) if machine.left() > 0 => SpeedEffect::AtomsSooner,
        _ => SpeedEffect::None,
    }
}

//! A node of the adaptive ring: its state, and its answers to events.

use std::ops::Range;
use std::time::Duration;

use super::copies::Copies;
use super::own_offer::OwnOffer;
use super::route::RingMembers;
use super::sleep_notice::SleepNotice;
use super::sleepers::Sleepers;
use crate::balance::admission::Admission;
use crate::balance::heartbeat::Heartbeat;
use crate::balance::message::{Action, Event, Message, NodeId, OfferDetails, Party};
use crate::balance::remedy::{Remedies, Remedy};
use crate::balance::speed_estimate::SpeedEstimate;
use crate::balance::strategy::Rules;
use crate::balance::work::Work;
use crate::picture::Atom;
use crate::time::Time;

/// A node of the adaptive ring. It composes small machines, each with a file of its own. This file answers events,
/// `offering` makes offers and puts the node to sleep, `helping` answers the offers of others, and `timers` does what
/// is due.
#[derive(Debug)]
pub struct AdaptiveNode {
    pub(super) id: NodeId,
    /// Least number of atoms worth a transfer.
    pub(super) part: u32,
    pub(super) remedies: Remedies,
    pub(super) ring: RingMembers,
    pub(super) work: Work,
    pub(super) speed_estimate: SpeedEstimate,
    pub(super) sleepers: Sleepers,
    pub(super) own_offer: OwnOffer,
    pub(super) copies: Copies,
    pub(super) admission: Admission,
    pub(super) heartbeat: Heartbeat,
    pub(super) state: State,
    /// Average time of a hop, by the offers that arrived; 0 until the first.
    pub(super) hop: Duration,
    /// The timer that is set.
    pub(super) timer: Option<Time>,
}

/// Atoms take long if this many of them would take longer than a beat.
const LONG_ATOMS_PER_BEAT: u32 = 16;

/// An offer of help: the token.
#[derive(Clone, Copy, Debug)]
pub(super) struct Offer {
    pub who: NodeId,
    pub done: u32,
    pub help: OfferDetails,
}

/// State of a node; the README shows the transitions.
#[derive(Debug)]
pub(super) enum State {
    /// The band has not come yet; offers that come before it are kept.
    Waiting { early: Vec<Offer> },
    /// The node has atoms.
    Busy,
    /// The node's own offer is under way, and it has no atoms, or one that is nearly done.
    Offering,
    /// The node's own offer came back before its last atom was traced.
    Unneeded,
    /// No node needs this one, as far as it knows. It repeats its notice after growing pauses.
    Asleep(SleepNotice),
}

impl AdaptiveNode {
    /// Creates node `id` of `nodes`, without atoms.
    pub(in crate::balance) fn new(id: NodeId, nodes: NodeId, rules: &Rules) -> Self {
        assert!(id < nodes, "node {id} is not in a ring of {nodes}");
        let has = |remedy| rules.remedies.has(remedy);
        // Results that are not sent would be lost with their node, so they do not wait for the last atom.
        let batch = if has(Remedy::Leases) { Some(rules.batch.unwrap_or(rules.beat)) } else { rules.batch };
        let work = Work::new(batch);
        Self {
            id,
            part: rules.part.max(1),
            remedies: rules.remedies,
            ring: RingMembers::new(nodes, has(Remedy::Shortcuts)),
            work,
            speed_estimate: SpeedEstimate::default(),
            sleepers: Sleepers::default(),
            own_offer: OwnOffer::default(),
            copies: Copies::default(),
            admission: Admission::default(),
            heartbeat: Heartbeat::new(rules.beat),
            state: State::Waiting { early: Vec::new() },
            hop: Duration::ZERO,
            timer: None,
        }
    }

    /// Handles `event` at the time `now` and appends its answer to `actions`.
    ///
    /// # Panics
    /// If the event is impossible: no parent or node of the same ring can have sent it.
    pub fn handle(&mut self, now: Time, event: Event, actions: &mut Vec<Action>) {
        match event {
            Event::Started => self.admission.start(now),
            Event::Message { from, message } => self.receive(now, from, message, actions),
            Event::AtomDone { atom, cost } => {
                self.speed_estimate.atom_done(now, cost);
                self.work.atom_done(now, atom, actions);
                // `Work` may have replaced the timer with a later one.
                self.timer = None;
                self.atom_left_pipe(now, atom, actions);
            }
            Event::AtomFailed { atom } => {
                self.speed_estimate.begin(now);
                self.work.atom_failed(atom, actions);
                send(Party::Parent, Message::Failed(atom), actions);
                self.atom_left_pipe(now, atom, actions);
            }
            Event::Timer => {
                self.timer = None;
                self.sleepers.allow_waking();
                self.wake_sleepers(now, actions);
            }
            Event::Estimated(_) => unreachable!("a node is never handed an estimate"),
        }
        self.run_due_timers(now, actions);
    }

    /// Continues after an atom has left the pipe, or offers help if it was the last.
    fn atom_left_pipe(&mut self, now: Time, atom: Atom, actions: &mut Vec<Action>) {
        self.copies.note_left_pipe(atom);
        if !self.work.is_idle() {
            // These results may be the only ones missing from the picture, and the next atom may take long.
            let beat = self.heartbeat.interval();
            let takes_long = self.speed_estimate.usual_time().is_some_and(|usual| usual * LONG_ATOMS_PER_BEAT > beat);
            if self.has(Remedy::Copies) && self.work.waiting() == 0 && takes_long {
                self.work.send_results(actions);
            }
            self.wake_sleepers(now, actions);
            return;
        }
        match self.state {
            State::Unneeded => self.sleep(now, actions),
            State::Offering => {}
            _ => self.offer(now, None, actions),
        }
        self.work.send_results(actions);
    }

    fn receive(&mut self, now: Time, from: Party, message: Message, actions: &mut Vec<Action>) {
        match message {
            Message::Band(band) => {
                // The band admits the node, even if atoms have come before it.
                self.admission.grant();
                if self.has(Remedy::Leases) {
                    self.heartbeat.start(now);
                }
                let State::Waiting { early } = &mut self.state else {
                    // The parent sends an empty band to a node that it counts as gone.
                    assert!(band.is_empty(), "node {} was given a second band", self.id);
                    return;
                };
                let early = std::mem::take(early);
                self.state = State::Busy;
                self.add_atoms(now, [band], actions);
                if self.work.is_idle() {
                    self.offer(now, None, actions);
                }
                early.into_iter().for_each(|offer| self.answer_offer(now, offer, actions));
            }
            Message::Transfer(ranges) | Message::Again(ranges) => {
                if !matches!(self.state, State::Waiting { .. }) {
                    self.state = State::Busy;
                }
                self.add_atoms(now, ranges, actions);
                self.wake_sleepers(now, actions);
            }
            Message::Offer { who, help: Some(help), .. } if who == self.id => {
                // An offer that was given up and comes back after all means nothing any more.
                if matches!(self.state, State::Offering) && self.own_offer.is_last(help.sent) {
                    self.become_unneeded(now, actions);
                }
            }
            Message::Offer { who, done, help: Some(help) } => {
                let offer = Offer { who, done, help };
                self.note_hop(now, &offer);
                match &mut self.state {
                    State::Waiting { early } => early.push(offer),
                    _ => self.answer_offer(now, offer, actions),
                }
            }
            // A node with atoms, or with an offer under way, does not sleep.
            Message::Wake => {
                if let (State::Asleep(_), Party::Node(waker)) = (&self.state, from) {
                    self.offer(now, Some(waker), actions);
                }
            }
            Message::Gone(gone) => self.close_ring(now, gone, actions),
            Message::Placed(ranges) => ranges.iter().for_each(|range| self.work.forget(range)),
            Message::Shutdown => actions.push(Action::Finish),
            other => unreachable!("a node of the adaptive ring is never sent {other:?}"),
        }
    }

    /// Returns whether the node uses this remedy.
    pub(super) fn has(&self, remedy: Remedy) -> bool {
        self.remedies.has(remedy)
    }

    fn add_atoms(&mut self, now: Time, ranges: impl IntoIterator<Item = Range<Atom>>, actions: &mut Vec<Action>) {
        if self.work.is_idle() {
            self.speed_estimate.begin(now);
        }
        self.work.add_new(ranges, actions);
    }
}

/// Appends the action that sends `message`.
pub(super) fn send(to: Party, message: Message, actions: &mut Vec<Action>) {
    actions.push(Action::Send { to, message });
}

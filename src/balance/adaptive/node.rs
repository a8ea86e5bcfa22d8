//! A node of the ring that adapts.

use std::ops::Range;
use std::time::Duration;

use super::route::RingMembers;
use super::sleepers::Sleepers;
use super::speed_estimate::SpeedEstimate;
use crate::balance::message::{Action, Event, Helper, Message, NodeId, Party};
use crate::balance::remedy::{Remedies, Remedy};
use crate::balance::strategy::Rules;
use crate::balance::work::Work;
use crate::picture::Atom;
use crate::time::Time;

/// A node of the ring that adapts. Its files: this one says what it does about what happens, `offering` what it does without
/// atoms, `helping` whom it gives some, and `duties` what it does when it is time.
#[derive(Debug)]
pub struct AdaptiveNode {
    pub(super) id: NodeId,
    pub(super) part: u32,
    pub(super) remedies: Remedies,
    pub(super) beat: Duration,
    pub(super) ring: RingMembers,
    pub(super) work: Work,
    pub(super) gauge: SpeedEstimate,
    pub(super) sleepers: Sleepers,
    pub(super) state: State,
    /// How long a message travels, by the last offers.
    pub(super) hop: Duration,
    /// Offers so far that were lost: the next begins its way at another stop.
    pub(super) lost: u16,
    /// When it has offered last.
    pub(super) offered: Option<Time>,
    /// The atom during which the node has offered early: it does so once.
    pub(super) offered_during: Option<Atom>,
    /// How many atoms it had traced when it last had no use for one that it had woken: it wakes nobody more until it has
    /// traced another, or its timer says that it is late.
    pub(super) refused: Option<u32>,
    /// The atoms in the pipe of which a copy was given away.
    pub(super) copied: Vec<Atom>,
    /// When it will ask the parent to be let in (again), having begun anew and not heard of it.
    pub(super) asks: Option<Time>,
    /// When the parent is to hear what the node has; `None` before the band, and without leases.
    pub(super) next_beat: Option<Time>,
    /// The timer that is set.
    pub(super) timer: Option<Time>,
}

/// An atom takes long if so many of them would take longer than a beat.
const AT_LENGTH: u32 = 16;

/// An offer of help: the token.
#[derive(Clone, Copy, Debug)]
pub(super) struct Offer {
    pub who: NodeId,
    pub done: u32,
    pub help: Helper,
}

/// Where a node stands; the README tells how one state follows another.
#[derive(Debug)]
pub(super) enum State {
    /// Its band has not come yet; offers that have are kept until then.
    Waiting { early: Vec<Offer> },
    /// It has atoms.
    Busy,
    /// Its own offer is under way since then, and it has no atoms, or hardly any.
    Offering { since: Time },
    /// Its own offer came back before its last atom was traced.
    Unneeded,
    /// Nobody needs it, as far as it knows. It says so again after a while, and then after twice as long.
    Asleep { again: Time, pause: Duration },
}

impl AdaptiveNode {
    /// Node `id` of `nodes`, which has no work yet.
    pub(in crate::balance) fn new(id: NodeId, nodes: NodeId, rules: &Rules) -> Self {
        assert!(id < nodes, "node {id} is not in a ring of {nodes}");
        let has = |remedy| rules.remedies.has(remedy);
        // What is traced and not sent would be lost with its node.
        let batch = if has(Remedy::Leases) { Some(rules.batch.unwrap_or(rules.beat)) } else { rules.batch };
        let work = Work::new(batch);
        Self {
            id,
            part: rules.part.max(1),
            remedies: rules.remedies,
            beat: rules.beat,
            ring: RingMembers::new(nodes, rules.remedies.has(Remedy::Shortcuts)),
            work,
            gauge: SpeedEstimate::default(),
            sleepers: Sleepers::default(),
            state: State::Waiting { early: Vec::new() },
            hop: Duration::ZERO,
            lost: 0,
            offered: None,
            offered_during: None,
            refused: None,
            copied: Vec::new(),
            asks: None,
            next_beat: None,
            timer: None,
        }
    }

    /// Answers `event`, which happens at `now`, by appending to `actions`.
    ///
    /// # Panics
    /// If the event is impossible: something that no parent or node of the same ring can have sent.
    pub fn handle(&mut self, now: Time, event: Event, actions: &mut Vec<Action>) {
        match event {
            Event::Started => self.asks = Some(now),
            Event::Message { from, message } => self.receive(now, from, message, actions),
            Event::AtomDone { atom, cost } => {
                self.gauge.done(now, cost);
                self.work.atom_done(now, atom, actions);
                // Work may have set a timer that is later than ours.
                self.timer = None;
                self.left_pipe(now, atom, actions);
            }
            Event::AtomFailed { atom } => {
                self.gauge.begin(now);
                self.work.atom_failed(atom, actions);
                send(Party::Parent, Message::Failed(atom), actions);
                self.left_pipe(now, atom, actions);
            }
            Event::Timer => {
                self.timer = None;
                self.refused = None;
                self.wake_sleepers(now, actions);
            }
            Event::Estimated(_) => unreachable!("a node is never handed an estimate"),
        }
        self.run_due_timers(now, actions);
    }

    /// An atom has left the pipe: the node goes on, or offers help.
    fn left_pipe(&mut self, now: Time, atom: Atom, actions: &mut Vec<Action>) {
        self.copied.retain(|&copied| copied != atom);
        if !self.work.is_idle() {
            // The picture may wait for nothing but these, and the next may take long.
            let takes_long = self.gauge.atom().is_some_and(|usual| usual * AT_LENGTH > self.beat);
            if self.has(Remedy::Copies) && self.work.waiting() == 0 && takes_long {
                self.work.send_results(actions);
            }
            self.wake_sleepers(now, actions);
            return;
        }
        match self.state {
            State::Unneeded => self.sleep(now, actions),
            State::Offering { .. } => {}
            _ => self.offer(now, None, actions),
        }
        self.work.send_results(actions);
    }

    fn receive(&mut self, now: Time, from: Party, message: Message, actions: &mut Vec<Action>) {
        match message {
            Message::Band(band) => {
                // It is let in, even if it was given atoms before it heard so.
                self.asks = None;
                if self.has(Remedy::Leases) && self.next_beat.is_none() {
                    self.next_beat = Some(now + self.beat);
                }
                let State::Waiting { early } = &mut self.state else {
                    // The parent asks those back that it thinks gone.
                    assert!(band.is_empty(), "node {} was given a second band", self.id);
                    return;
                };
                let early = std::mem::take(early);
                self.state = State::Busy;
                self.add(now, [band], actions);
                if self.work.is_idle() {
                    self.offer(now, None, actions);
                }
                early.into_iter().for_each(|offer| self.answer_offer(now, offer, actions));
            }
            Message::Transfer(ranges) | Message::Again(ranges) => {
                if !matches!(self.state, State::Waiting { .. }) {
                    self.state = State::Busy;
                }
                self.add(now, ranges, actions);
                self.wake_sleepers(now, actions);
            }
            Message::Offer { who, help: Some(help), .. } if who == self.id => {
                // One that was given up, and came back after all, says nothing any more.
                if matches!(self.state, State::Offering { since } if since == help.sent) {
                    self.be_unneeded(now, actions);
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
            // Whoever has atoms, or an offer under way, does not sleep.
            Message::Wake => {
                if let (State::Asleep { .. }, Party::Node(waker)) = (&self.state, from) {
                    self.offer(now, Some(waker), actions);
                }
            }
            Message::Gone(gone) => self.close_ring(now, gone, actions),
            Message::Placed(ranges) => ranges.iter().for_each(|range| self.work.forget(range)),
            Message::Shutdown => actions.push(Action::Finish),
            other => unreachable!("a node of the ring that adapts is never sent {other:?}"),
        }
    }

    pub(super) fn has(&self, remedy: Remedy) -> bool {
        self.remedies.has(remedy)
    }

    fn add(&mut self, now: Time, ranges: impl IntoIterator<Item = Range<Atom>>, actions: &mut Vec<Action>) {
        if self.work.is_idle() {
            self.gauge.begin(now);
        }
        self.work.add_new(ranges, actions);
    }
}

/// Asks for a message to be sent.
pub(super) fn send(to: Party, message: Message, actions: &mut Vec<Action>) {
    actions.push(Action::Send { to, message });
}

//! A node of the article's ring: the child of §8, with its worker's pipe.

use crate::balance::message::{Action, Event, Message, NodeId, Party};
use crate::balance::work::Work;
use crate::time::Time;

use super::share;

/// A node of the article's ring.
#[derive(Debug)]
pub struct RingNode {
    id: NodeId,
    left: NodeId,
    part: u32,
    work: Work,
    state: State,
}

/// An offer of help: the token.
#[derive(Clone, Copy, Debug)]
struct Offer {
    who: NodeId,
    done: u32,
}

/// State of a node; the README shows the transitions.
#[derive(Debug)]
enum State {
    /// The band has not come yet; offers that come before it are kept.
    Waiting { early: Vec<Offer> },
    /// The node has atoms.
    Busy,
    /// The node has no atoms, and its own offer is under way.
    Offering,
    /// The node's own offer came back.
    Retired,
}

impl RingNode {
    /// Creates node `id` of `nodes` with this work, which has no atoms yet. A transfer is worth while from `part` atoms
    /// on (0 counts as 1).
    pub(in crate::balance) fn new(id: NodeId, nodes: NodeId, part: u32, work: Work) -> Self {
        assert!(id < nodes, "node {id} is not in a ring of {nodes}");
        let left = if id == 0 { nodes - 1 } else { id - 1 };
        Self { id, left, part: part.max(1), work, state: State::Waiting { early: Vec::new() } }
    }

    /// Handles `event` at the time `now` and appends its answer to `actions`.
    ///
    /// # Panics
    /// If the event is impossible: no parent or node of the same ring can have sent it.
    pub fn handle(&mut self, now: Time, event: Event, actions: &mut Vec<Action>) {
        match event {
            Event::Message { message, .. } => self.receive(message, actions),
            Event::AtomDone { atom, .. } => {
                self.work.atom_done(now, atom, actions);
                if self.work.is_idle() {
                    self.offer(actions);
                    self.work.send_results(actions);
                }
            }
            Event::Timer => self.work.send_results(actions),
            other => unreachable!("a node of the ring is never handed {other:?}"),
        }
    }

    fn receive(&mut self, message: Message, actions: &mut Vec<Action>) {
        match message {
            Message::Band(band) => {
                let State::Waiting { early } = std::mem::replace(&mut self.state, State::Busy) else {
                    unreachable!("node {} was given a second band", self.id);
                };
                self.work.add([band], actions);
                if self.work.is_idle() {
                    self.offer(actions);
                }
                early.into_iter().for_each(|offer| self.answer_offer(offer, actions));
            }
            Message::Transfer(ranges) => {
                assert!(matches!(self.state, State::Offering), "node {} was sent atoms it did not ask for", self.id);
                self.state = State::Busy;
                self.work.add(ranges, actions);
            }
            Message::Offer { who, done, .. } if who == self.id => {
                assert!(matches!(self.state, State::Offering), "node {}'s offer of {done} came back twice", self.id);
                self.state = State::Retired;
                actions.push(Action::Retire);
            }
            Message::Offer { who, done, .. } => {
                let offer = Offer { who, done };
                match &mut self.state {
                    State::Waiting { early } => early.push(offer),
                    _ => self.answer_offer(offer, actions),
                }
            }
            Message::Shutdown => actions.push(Action::Finish),
            other => unreachable!("a node of the ring is never sent {other:?}"),
        }
    }

    /// Answers another node's offer with a transfer if that is worth while, else passes it on.
    fn answer_offer(&mut self, offer: Offer, actions: &mut Vec<Action>) {
        let count = share(self.work.waiting(), self.work.traced(), offer.done, self.part);
        if count > 0 {
            let message = Message::Transfer(self.work.give(count));
            actions.push(Action::Send { to: Party::Node(offer.who), message });
        } else {
            self.send_left(offer, actions);
        }
    }

    fn offer(&mut self, actions: &mut Vec<Action>) {
        self.state = State::Offering;
        self.send_left(Offer { who: self.id, done: self.work.traced() }, actions);
    }

    fn send_left(&self, Offer { who, done }: Offer, actions: &mut Vec<Action>) {
        actions.push(Action::Send { to: Party::Node(self.left), message: Message::offer(who, done) });
    }
}

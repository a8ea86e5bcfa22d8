//! What a node does that has no atoms: it offers help, and sleeps if nobody needs it.

use std::time::Duration;

use super::node::{AdaptiveNode, Offer, State, send};
use crate::balance::message::{Action, Helper, Message, NodeId, Party};
use crate::balance::remedy::Remedy;
use crate::time::Time;

impl AdaptiveNode {
    /// Offers help: to whoever has woken this node, if somebody has, and then along the ring.
    pub(super) fn offer(&mut self, now: Time, waker: Option<NodeId>, actions: &mut Vec<Action>) {
        // No two of a node's offers bear the same time.
        let since = self.offered.map_or(now, |last| now.max(last + Duration::from_nanos(1)));
        self.offered = Some(since);
        self.state = State::Offering { since };
        let stops = self.ring.stops();
        let stop = self.lost.checked_rem(stops).unwrap_or(0);
        let offer = self.own_offer(since, stop, Some(stops));
        match waker {
            Some(waker) => send(Party::Node(waker), offer.message(), actions),
            None => self.pass_on(offer, actions),
        }
    }

    /// Passes an offer on to its next stop, or back to its node after the last.
    pub(super) fn pass_on(&self, mut offer: Offer, actions: &mut Vec<Action>) {
        let mut to = offer.who;
        while let Some(left) = offer.help.left.and_then(|left| left.checked_sub(1)) {
            to = self.ring.stop(offer.who, offer.help.stop);
            offer.help.left = Some(left);
            offer.help.stop = (offer.help.stop + 1).checked_rem(self.ring.stops()).unwrap_or(0);
            // A stop that is gone is another's too: nobody passes an offer on to itself.
            if to != self.id {
                break;
            }
            to = offer.who;
        }
        send(Party::Node(to), offer.message(), actions);
    }

    /// Offers while there are atoms still, if an answer would come no earlier than they are traced.
    pub(super) fn offer_early(&mut self, now: Time, actions: &mut Vec<Action>) {
        if self.early_at().is_some_and(|at| at <= now) {
            self.offered_during = self.work.pipe().front().copied();
            self.offer(now, None, actions);
        }
    }

    /// When the node is to offer before its atoms run out: a way to and fro before it has but one left, since an offer may pass
    /// some who have nothing to give.
    pub(super) fn early_at(&self) -> Option<Time> {
        let usual = self.gauge.atom()?;
        let in_hand = self.work.pipe().front().copied();
        let may = matches!(self.state, State::Busy) && in_hand.is_some() && in_hand != self.offered_during;
        if !self.has(Remedy::Early) || self.hop.is_zero() || !may {
            return None;
        }
        Some(self.gauge.since() + usual * (1 + self.work.waiting()) - self.hop * 2)
    }

    /// This node's own offer is back.
    pub(super) fn be_unneeded(&mut self, now: Time, actions: &mut Vec<Action>) {
        if self.work.is_idle() {
            self.sleep(now, actions);
        } else {
            self.state = State::Unneeded;
        }
    }

    /// Nobody needs this node for now.
    pub(super) fn sleep(&mut self, now: Time, actions: &mut Vec<Action>) {
        let pause = self.lease();
        self.state = State::Asleep { again: now + pause, pause };
        actions.push(Action::Retire);
        self.announce_sleep(now, actions);
        // The parent may know of atoms that nobody has: not before a lease, and one that has just heard of this node is left in
        // peace for a little.
        if now.since(Time::ZERO) >= pause {
            self.next_beat = self.next_beat.map(|next| next.min(now.max(next - self.beat * 15 / 16)));
        }
    }

    /// Leaves an offer with all who would be asked, for when they come to need help.
    pub(super) fn announce_sleep(&self, now: Time, actions: &mut Vec<Action>) {
        if self.has(Remedy::Wake) {
            let mut told = Vec::new();
            for stop in 0..self.ring.stops() {
                let to = self.ring.stop(self.id, stop);
                if to != self.id && !told.contains(&to) {
                    told.push(to);
                    send(Party::Node(to), self.own_offer(now, stop, None).message(), actions);
                }
            }
        }
    }

    /// The ring is another now: an offer under way may be lost with a node that is gone.
    pub(super) fn close_ring(&mut self, now: Time, gone: Vec<NodeId>, actions: &mut Vec<Action>) {
        self.ring.set_gone(gone);
        let ring = &self.ring;
        self.sleepers.retain(|node| !ring.is_gone(node));
        match self.state {
            State::Offering { .. } => self.offer(now, None, actions),
            // Whoever has come back does not know that this node sleeps.
            State::Asleep { .. } => self.announce_sleep(now, actions),
            State::Waiting { .. } | State::Busy | State::Unneeded => {}
        }
    }

    fn own_offer(&self, now: Time, stop: u16, left: Option<u16>) -> Offer {
        let speed = self.gauge.known().map_or(0.0, |(speed, _)| speed);
        let help = Helper { speed: Helper::millionths(speed), sent: now, stop, left };
        Offer { who: self.id, done: self.work.traced(), help }
    }
}

impl Offer {
    fn message(self) -> Message {
        Message::Offer { who: self.who, done: self.done, help: Some(self.help) }
    }
}

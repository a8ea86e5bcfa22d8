//! The node's own offers: it offers help when its atoms run out, and sleeps if no node takes the offer.

use super::node::{AdaptiveNode, Offer, State, send};
use super::sleep_notice::SleepNotice;
use crate::balance::message::{Action, Message, NodeId, OfferDetails, Party};
use crate::balance::remedy::Remedy;
use crate::time::Time;

impl AdaptiveNode {
    /// Offers help: first to the node that has woken this one, if there is one, and then along the ring.
    pub(super) fn offer(&mut self, now: Time, waker: Option<NodeId>, actions: &mut Vec<Action>) {
        let made = self.own_offer.make(now);
        self.state = State::Offering;
        let stops = self.ring.stops();
        let offer = self.offer_at(made, self.own_offer.first_stop(stops), Some(stops));
        match waker {
            Some(waker) => send(Party::Node(waker), offer.message(), actions),
            None => self.pass_on(offer, actions),
        }
    }

    /// Passes an offer on to its next stop, or back to its node after the last stop.
    pub(super) fn pass_on(&self, mut offer: Offer, actions: &mut Vec<Action>) {
        let mut to = offer.who;
        while let Some(left) = offer.help.left.and_then(|left| left.checked_sub(1)) {
            to = self.ring.stop(offer.who, offer.help.stop);
            offer.help.left = Some(left);
            offer.help.stop = (offer.help.stop + 1).checked_rem(self.ring.stops()).unwrap_or(0);
            // The next node takes over the stop of one that is gone. So two stops may be the same node, and a node may
            // be its own next stop: it skips that one.
            if to != self.id {
                break;
            }
            to = offer.who;
        }
        send(Party::Node(to), offer.message(), actions);
    }

    /// Offers help early if that is due: an answer should come when the atoms run out.
    pub(super) fn offer_early(&mut self, now: Time, actions: &mut Vec<Action>) {
        if self.early_expiry().is_some_and(|at| at <= now) {
            self.own_offer.note_early(self.work.pipe().front().copied());
            self.offer(now, None, actions);
        }
    }

    /// Returns when the node should offer before its atoms run out: a round trip before it has only one left, since the
    /// offer may pass some nodes that have nothing to give.
    pub(super) fn early_expiry(&self) -> Option<Time> {
        let usual = self.speed_estimate.usual_time()?;
        let in_hand = *self.work.pipe().front()?;
        if !self.has(Remedy::Early) || !matches!(self.state, State::Busy) {
            return None;
        }
        let runs_out = self.speed_estimate.since() + usual * (1 + self.work.waiting());
        self.own_offer.early_expiry(in_hand, runs_out, self.hop)
    }

    /// Reacts to the return of the node's own offer: no node needs it for now.
    pub(super) fn become_unneeded(&mut self, now: Time, actions: &mut Vec<Action>) {
        if self.work.is_idle() {
            self.sleep(now, actions);
        } else {
            self.state = State::Unneeded;
        }
    }

    /// Falls asleep and announces it.
    pub(super) fn sleep(&mut self, now: Time, actions: &mut Vec<Action>) {
        let lease = self.lease();
        self.state = State::Asleep(SleepNotice::new(now, lease));
        actions.push(Action::Retire);
        self.announce_sleep(now, actions);
        // The parent may know atoms that no node holds. It can know none before the first lease has passed.
        if now.since(Time::ZERO) >= lease {
            self.heartbeat.hasten(now);
        }
    }

    /// Leaves a notice with each of the node's stops, so that they can wake it when they need help.
    pub(super) fn announce_sleep(&self, now: Time, actions: &mut Vec<Action>) {
        if self.has(Remedy::Wake) {
            let mut told = Vec::new();
            for stop in 0..self.ring.stops() {
                let to = self.ring.stop(self.id, stop);
                if to != self.id && !told.contains(&to) {
                    told.push(to);
                    send(Party::Node(to), self.offer_at(now, stop, None).message(), actions);
                }
            }
        }
    }

    /// Closes the ring around the nodes that are `gone`. An offer under way may be lost with one of them: the node
    /// makes another.
    pub(super) fn close_ring(&mut self, now: Time, gone: Vec<NodeId>, actions: &mut Vec<Action>) {
        self.ring.set_gone(gone);
        let ring = &self.ring;
        self.sleepers.retain(|node| !ring.is_gone(node));
        match self.state {
            State::Offering => self.offer(now, None, actions),
            // A node that has come back does not know that this one sleeps.
            State::Asleep(_) => self.announce_sleep(now, actions),
            State::Waiting { .. } | State::Busy | State::Unneeded => {}
        }
    }

    /// Returns this node's offer made at `made`, on its way to `stop` with `left` more stops after it; `left` = `None`
    /// makes it a notice that the node sleeps.
    fn offer_at(&self, made: Time, stop: u16, left: Option<u16>) -> Offer {
        let speed = self.speed_estimate.averages().map_or(0.0, |(speed, _)| speed);
        let help = OfferDetails { speed: OfferDetails::millionths(speed), sent: made, stop, left };
        Offer { who: self.id, done: self.work.traced(), help }
    }
}

impl Offer {
    fn message(self) -> Message {
        Message::Offer { who: self.who, done: self.done, help: Some(self.help) }
    }
}

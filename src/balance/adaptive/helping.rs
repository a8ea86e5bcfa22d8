//! Answers to the offers of other nodes: transfers, copies, and wake-ups.

use std::time::Duration;

use super::copies::Copies;
use super::node::{AdaptiveNode, Offer, send};
use super::share::share_by_speed;
use super::sleepers::Offerer;
use crate::balance::message::{Action, Message, Party};
use crate::balance::remedy::Remedy;
use crate::balance::ring::share;
use crate::picture::Atom;
use crate::time::Time;

impl AdaptiveNode {
    /// Answers another node's offer: sends it atoms, or a copy of a late atom, or passes the offer on. Keeps a notice
    /// that the other node sleeps.
    pub(super) fn answer_offer(&mut self, now: Time, offer: Offer, actions: &mut Vec<Action>) {
        let was_woken = self.sleepers.remove(offer.who);
        let offerer = Offerer { speed: offer.help.speed(), done: offer.done };
        if offer.help.left.is_none() {
            self.sleepers.add(offer.who, offerer);
            self.wake_sleepers(now, actions);
            return;
        }
        let expected = self.expected_speed(now);
        let count = self.share_for(now, offerer, expected);
        if count > 0 {
            let message = Message::Transfer(self.work.give(count));
            send(Party::Node(offer.who), message, actions);
        } else if let Some(atom) = self.late_atom(now, offerer.speed).filter(|_| was_woken) {
            // Only for a node that was woken: one that has not slept yet may find atoms that no other node traces.
            self.copies.note_given(atom);
            send(Party::Node(offer.who), Message::Again(std::iter::once(atom..atom + 1).collect()), actions);
        } else {
            if was_woken {
                self.sleepers.turn_away(self.work.traced());
            }
            self.pass_on(offer, actions);
        }
    }

    /// Wakes sleeping nodes, the fastest first, as long as there are atoms to share with them or a late atom to copy.
    pub(super) fn wake_sleepers(&mut self, now: Time, actions: &mut Vec<Action>) {
        while let Some((node, offerer)) = self.sleepers.next_to_wake(self.work.traced()) {
            let expected = self.expected_speed(now);
            if self.share_for(now, offerer, expected) == 0
                && (expected > 0.0 || self.late_atom(now, offerer.speed).is_none())
            {
                return;
            }
            self.sleepers.wake(node, now);
            send(Party::Node(node), Message::Wake, actions);
        }
    }

    /// Returns the summed speed of the woken nodes whose offers are expected. A node of unknown speed counts as fast as
    /// this one.
    fn expected_speed(&mut self, now: Time) -> f64 {
        let own = self.speed_estimate.averages().map_or(1.0, |(speed, _)| speed);
        self.sleepers.expected_speed(now, self.lease(), own)
    }

    /// Updates the time of a hop by an offer that has just arrived.
    pub(super) fn note_hop(&mut self, now: Time, offer: &Offer) {
        let stops = self.ring.stops();
        let hops = offer.help.left.map_or(1, |left| stops.saturating_sub(left).max(1));
        let hop = now.since(offer.help.sent) / u32::from(hops);
        self.hop = if self.hop.is_zero() { hop } else { (self.hop + hop) / 2 };
    }

    /// Returns when an atom in the pipe will be late enough for a sleeping node to trace a copy of it.
    pub(super) fn copy_expiry(&self, now: Time) -> Option<Time> {
        let (_, Offerer { speed, .. }) = self.sleepers.fastest()?;
        if self.work.is_idle() {
            return None;
        }
        let usual = self.speed_estimate.usual_time().unwrap_or(self.heartbeat.interval());
        Some(Copies::expiry(now, self.speed_estimate.since(), usual, self.atom_time_at(speed) + self.hop))
    }

    /// Returns how many atoms an offerer gets while offers of nodes with the summed speed `expected` are still to come.
    fn share_for(&self, now: Time, Offerer { speed, done }: Offerer, expected: f64) -> u32 {
        if !self.has(Remedy::Speed) {
            return share(self.work.waiting(), self.work.traced(), done, self.part);
        }
        // If only one of the two speeds is known, both count as equal.
        let (own, usual, cost) = match (self.speed_estimate.speed(now), self.speed_estimate.averages()) {
            (Some(own), Some((usual, cost))) => (own, usual, cost),
            _ if speed > 0.0 => (speed, speed, 0.0),
            _ => (1.0, 1.0, 0.0),
        };
        let offerer = if speed > 0.0 { speed } else { usual };
        let latency = if self.has(Remedy::Floor) && cost > 0.0 { self.hop.as_secs_f64() } else { 0.0 };
        let ahead = (self.work.pipe().len() as f64 - 0.5).max(0.0);
        let cost = if cost > 0.0 { cost } else { 1.0 };
        let count = share_by_speed(self.work.waiting(), ahead, own, offerer, expected, latency, cost);
        if count < self.part { 0 } else { count }
    }

    /// Returns the atom in the pipe that an idle node of this speed would finish earlier than this one.
    fn late_atom(&self, now: Time, speed: f64) -> Option<Atom> {
        if !self.has(Remedy::Copies) || self.work.waiting() > 0 {
            return None;
        }
        let needs = self.atom_time_at(speed) + self.hop;
        let usual = self.speed_estimate.usual_time().unwrap_or_default();
        self.copies.late_atom(self.work.pipe(), self.speed_estimate.time_left(now), usual, needs)
    }

    /// Returns how long a node of this speed takes for an atom.
    fn atom_time_at(&self, speed: f64) -> Duration {
        match self.speed_estimate.averages() {
            Some((own, cost)) => Duration::from_secs_f64(cost / if speed > 0.0 { speed } else { own }),
            // Longer than any atom should take.
            None => self.heartbeat.interval(),
        }
    }
}

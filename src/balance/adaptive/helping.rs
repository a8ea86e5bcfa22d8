//! Whom a node that has atoms gives some.

use std::time::Duration;

use super::node::{AdaptiveNode, Offer, send};
use super::share::share_by_speed;
use super::sleepers::Helper;
use crate::balance::message::{Action, Message, Party};
use crate::balance::remedy::Remedy;
use crate::balance::ring::share;
use crate::picture::Atom;
use crate::time::Time;

impl AdaptiveNode {
    /// Takes another's offer if that is worth it, else passes it on; or keeps it, if its node sleeps.
    pub(super) fn answer_offer(&mut self, now: Time, offer: Offer, actions: &mut Vec<Action>) {
        let woken = self.sleepers.remove(offer.who);
        let helper = Helper { speed: offer.help.speed(), done: offer.done };
        if offer.help.left.is_none() {
            self.sleepers.add(offer.who, helper);
            self.wake_sleepers(now, actions);
            return;
        }
        let expected = self.expected(now);
        let count = self.share_for(now, helper, expected);
        if count > 0 {
            let message = Message::Transfer(self.work.give(count));
            send(Party::Node(offer.who), message, actions);
        } else if let Some(atom) = self.late_atom(now, helper.speed).filter(|_| woken) {
            // Whoever has not slept yet may find atoms that nobody has.
            self.copied.push(atom);
            send(Party::Node(offer.who), Message::Again(std::iter::once(atom..atom + 1).collect()), actions);
        } else {
            if woken {
                self.refused = Some(self.work.traced());
            }
            self.pass_on(offer, actions);
        }
    }

    /// Wakes those who sleep, as many as there is something for.
    pub(super) fn wake_sleepers(&mut self, now: Time, actions: &mut Vec<Action>) {
        while let Some((node, helper)) = self.sleepers.fastest().filter(|_| self.refused != Some(self.work.traced())) {
            let expected = self.expected(now);
            if self.share_for(now, helper, expected) == 0
                && (expected > 0.0 || self.late_atom(now, helper.speed).is_none())
            {
                return;
            }
            self.sleepers.wake(node, now);
            send(Party::Node(node), Message::Wake, actions);
        }
    }

    /// How fast those are together that were woken and are expected to offer; one of whom nothing is known is taken to be as fast
    /// as this node.
    fn expected(&mut self, now: Time) -> f64 {
        let own = self.gauge.known().map_or(1.0, |(speed, _)| speed);
        self.sleepers.expected(now, self.lease(), own)
    }

    /// How long an offer has travelled to the last stop.
    pub(super) fn note_hop(&mut self, now: Time, offer: &Offer) {
        let stops = self.ring.stops();
        let hops = offer.help.left.map_or(1, |left| stops.saturating_sub(left).max(1));
        let hop = now.since(offer.help.sent) / u32::from(hops);
        self.hop = if self.hop.is_zero() { hop } else { (self.hop + hop) / 2 };
    }

    /// When an atom in the pipe will be late for those who sleep, if none is so now.
    pub(super) fn late_at(&self, now: Time) -> Option<Time> {
        let (_, Helper { speed, .. }) = self.sleepers.fastest()?;
        if self.work.is_idle() {
            return None;
        }
        let usual = self.gauge.atom().unwrap_or(self.beat);
        let at = self.gauge.since() + usual / 2 + self.time_of(speed) + self.hop;
        // One that is late already is looked after again when it has taken twice as long.
        Some(if at > now { at } else { now + now.since(self.gauge.since()).max(Duration::from_micros(1)) })
    }

    /// How many atoms go to an offerer, if others who are so fast together are expected to offer too.
    fn share_for(&self, now: Time, Helper { speed, done }: Helper, expected: f64) -> u32 {
        if !self.has(Remedy::Speed) {
            return share(self.work.waiting(), self.work.traced(), done, self.part);
        }
        // Of whom nothing is known is taken to be as fast as the other.
        let (own, usual, cost) = match (self.gauge.speed(now), self.gauge.known()) {
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

    /// The atom in the pipe of which an idle node of this speed should trace a copy, since it would be done earlier.
    fn late_atom(&self, now: Time, speed: f64) -> Option<Atom> {
        if !self.has(Remedy::Copies) || self.work.waiting() > 0 {
            return None;
        }
        let needs = self.time_of(speed) + self.hop;
        let usual = self.gauge.atom().unwrap_or_default();
        let left = self.gauge.left(now);
        let late = |(place, atom): &(u32, &Atom)| left + usual * *place > needs && !self.copied.contains(atom);
        (0..).zip(self.work.pipe()).filter(late).last().map(|(_, &atom)| atom)
    }

    /// How long a node of this speed takes for an atom.
    fn time_of(&self, speed: f64) -> Duration {
        match self.gauge.known() {
            Some((own, cost)) => Duration::from_secs_f64(cost / if speed > 0.0 { speed } else { own }),
            // Longer than any atom should take.
            None => self.beat,
        }
    }
}

//! The node's timers: each small machine says when it is due, and the node sets its one timer to the earliest.

use std::time::Duration;

use super::node::{AdaptiveNode, State, send};
use crate::balance::message::{Action, Message, Party};
use crate::balance::remedy::Remedy;
use crate::balance::strategy::LEASE_BEATS;
use crate::time::Time;

impl AdaptiveNode {
    /// Returns how long a node may be silent, and an offer under way, before it counts as lost.
    pub(super) fn lease(&self) -> Duration {
        self.heartbeat.interval() * LEASE_BEATS
    }

    /// Does everything that is due at `now`, and sets the timer for what is due next.
    pub(super) fn run_due_timers(&mut self, now: Time, actions: &mut Vec<Action>) {
        if self.work.due().is_some_and(|due| due <= now) {
            self.work.send_results(actions);
        }
        if self.offer_expiry().is_some_and(|expiry| expiry <= now) {
            match &mut self.state {
                State::Asleep(notice) => {
                    notice.take_due(now);
                    self.announce_sleep(now, actions);
                }
                _ => {
                    self.own_offer.give_up();
                    self.become_unneeded(now, actions);
                }
            }
        }
        if self.admission.take_due(now, self.lease()) {
            send(Party::Parent, Message::Request, actions);
        }
        self.offer_early(now, actions);
        if self.heartbeat.take_due(now) {
            let idle = self.work.is_idle();
            // Copies and the ring have helped a stuck worker long before, if the node can be reached at all.
            let is_stuck = !idle && self.speed_estimate.is_stuck(now, self.lease());
            let holds = if is_stuck { Vec::new() } else { self.work.held() };
            send(Party::Parent, Message::Beat { holds, idle, sent: now }, actions);
        }
        let expiries = [
            self.work.due(),
            self.heartbeat.expiry(),
            self.offer_expiry(),
            self.copy_expiry(now),
            self.early_expiry(),
            self.admission.expiry(),
        ];
        let next = expiries.into_iter().flatten().min();
        if let Some(next) = next.filter(|&next| self.timer.is_none_or(|timer| next < timer)) {
            self.timer = Some(next);
            actions.push(Action::SetTimer(next));
        }
    }

    /// Returns when the own offer counts as lost, or when the next sleep notice is due. Without leases nothing counts
    /// as lost.
    fn offer_expiry(&self) -> Option<Time> {
        match &self.state {
            _ if !self.has(Remedy::Leases) => None,
            State::Offering => self.own_offer.expiry(self.lease()),
            State::Asleep(notice) => Some(notice.expiry()),
            State::Waiting { .. } | State::Busy | State::Unneeded => None,
        }
    }
}

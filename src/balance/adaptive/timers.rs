//! What a node does when it is time: results, what it tells the parent, offers that were lost.

use std::time::Duration;

use super::node::{AdaptiveNode, State, send};
use crate::balance::message::{Action, Message, Party};
use crate::balance::remedy::Remedy;
use crate::balance::strategy::LEASE;
use crate::time::Time;

/// How many leases an atom may take, or times four usual atoms, before its worker counts as stuck.
const PATIENCE: u32 = 16;

impl AdaptiveNode {
    /// How long a node may be silent, and an offer under way, before it counts as lost.
    pub(super) fn lease(&self) -> Duration {
        self.beat * LEASE
    }

    /// Does what is due, and sets the timer for what will be.
    pub(super) fn run_due_timers(&mut self, now: Time, actions: &mut Vec<Action>) {
        let is_due = |at: Option<Time>| at.is_some_and(|at| at <= now);
        if is_due(self.work.due()) {
            self.work.send_results(actions);
        }
        if self.has(Remedy::Leases) {
            match self.state {
                State::Offering { since } if since + self.lease() <= now => {
                    self.lost = self.lost.wrapping_add(1);
                    self.be_unneeded(now, actions);
                }
                State::Asleep { again, pause } if again <= now => {
                    self.state = State::Asleep { again: now + pause * 2, pause: pause * 2 };
                    self.announce_sleep(now, actions);
                }
                _ => {}
            }
        }
        if is_due(self.asks) {
            self.asks = Some(now + self.lease());
            send(Party::Parent, Message::Request, actions);
        }
        self.offer_early(now, actions);
        if is_due(self.next_beat) {
            self.next_beat = Some(now + self.beat);
            let idle = self.work.is_idle();
            let holds = if self.is_stuck(now) { Vec::new() } else { self.work.held() };
            send(Party::Parent, Message::Beat { holds, idle, sent: now }, actions);
        }
        let next = [self.work.due(), self.next_beat, self.offer_due(), self.late_at(now), self.early_at(), self.asks];
        let next = next.into_iter().flatten().min();
        if let Some(next) = next.filter(|&next| self.timer.is_none_or(|timer| next < timer)) {
            self.timer = Some(next);
            actions.push(Action::SetTimer(next));
        }
    }

    /// Whether the worker has had its atom for so long that the node does not vouch for anything it has. Copies and the ring have
    /// seen to it long before, if somebody can be reached; an atom that is only dear is not to be traced by all.
    fn is_stuck(&self, now: Time) -> bool {
        let age = now.since(self.gauge.since());
        let usual = self.gauge.atom().unwrap_or_default();
        !self.work.is_idle() && age > self.lease().max(usual * LEASE) * PATIENCE
    }

    fn offer_due(&self) -> Option<Time> {
        match self.state {
            _ if !self.has(Remedy::Leases) => None,
            State::Offering { since } => Some(since + self.lease()),
            State::Asleep { again, .. } => Some(again),
            State::Waiting { .. } | State::Busy | State::Unneeded => None,
        }
    }
}

//! A node of the farm with leases: it asks the parent for parts, and tells it at regular intervals what it holds.

use std::ops::Range;
use std::time::Duration;

use crate::balance::admission::Admission;
use crate::balance::heartbeat::Heartbeat;
use crate::balance::message::{Action, Event, Message, Party};
use crate::balance::speed_estimate::SpeedEstimate;
use crate::balance::strategy::{LEASE_BEATS, Rules};
use crate::balance::work::Work;
use crate::picture::Atom;
use crate::time::Time;

/// A node of the farm with leases.
#[derive(Debug)]
pub(in crate::balance) struct LeasedFarmNode {
    work: Work,
    heartbeat: Heartbeat,
    admission: Admission,
    /// Measures the worker, to find out that it is stuck.
    speed_estimate: SpeedEstimate,
    /// Whether the band has come, and the scene with it.
    has_scene: bool,
    /// The timer that is set.
    timer: Option<Time>,
}

impl LeasedFarmNode {
    /// Creates a node without atoms.
    pub fn new(rules: &Rules) -> Self {
        Self {
            // Results that are not sent would be lost with their node, so they do not wait for the last atom.
            work: Work::new(Some(rules.batch.unwrap_or(rules.beat))),
            heartbeat: Heartbeat::new(rules.beat),
            admission: Admission::default(),
            speed_estimate: SpeedEstimate::default(),
            has_scene: false,
            timer: None,
        }
    }

    /// Handles `event` at the time `now` and appends its answer to `actions`.
    pub fn handle(&mut self, now: Time, event: Event, actions: &mut Vec<Action>) {
        match event {
            Event::Started => self.admission.start(now),
            Event::Message { message, .. } => self.receive(now, message, actions),
            Event::AtomDone { atom, cost } => {
                self.speed_estimate.atom_done(now, cost);
                self.work.atom_done(now, atom, actions);
                // `Work` may have replaced the timer with a later one.
                self.timer = None;
                self.ask_if_idle(actions);
            }
            Event::AtomFailed { atom } => {
                self.speed_estimate.begin(now);
                self.work.atom_failed(atom, actions);
                send(Message::Failed(atom), actions);
                self.ask_if_idle(actions);
            }
            Event::Timer => self.timer = None,
            Event::Estimated(_) => unreachable!("a node is never handed an estimate"),
        }
        self.run_due_timers(now, actions);
    }

    fn receive(&mut self, now: Time, message: Message, actions: &mut Vec<Action>) {
        match message {
            Message::Band(band) => {
                self.admission.grant();
                self.heartbeat.start(now);
                self.add_atoms(now, [band], actions);
                // The parent repeats a band that may be lost; only the first one is answered.
                if !std::mem::replace(&mut self.has_scene, true) {
                    self.ask_if_idle(actions);
                }
            }
            Message::Part(part) if part.is_empty() => actions.push(Action::Retire),
            Message::Part(part) => self.add_atoms(now, [part], actions),
            Message::Again(ranges) => self.add_atoms(now, ranges, actions),
            Message::Placed(ranges) => ranges.iter().for_each(|range| self.work.forget(range)),
            Message::Shutdown => actions.push(Action::Finish),
            other => unreachable!("a node of the farm with leases is never sent {other:?}"),
        }
    }

    fn add_atoms(&mut self, now: Time, ranges: impl IntoIterator<Item = Range<Atom>>, actions: &mut Vec<Action>) {
        if self.work.is_idle() {
            self.speed_estimate.begin(now);
        }
        self.work.add_new(ranges, actions);
    }

    /// Sends the results and asks for more atoms, if the last one is traced.
    fn ask_if_idle(&mut self, actions: &mut Vec<Action>) {
        if self.work.is_idle() {
            self.work.send_results(actions);
            send(Message::Request, actions);
        }
    }

    /// Does everything that is due at `now`, and sets the timer for what is due next.
    fn run_due_timers(&mut self, now: Time, actions: &mut Vec<Action>) {
        if self.work.due().is_some_and(|due| due <= now) {
            self.work.send_results(actions);
        }
        if self.admission.take_due(now, self.lease()) {
            send(Message::Join, actions);
        }
        if self.heartbeat.take_due(now) {
            let idle = self.work.is_idle();
            let is_stuck = !idle && self.speed_estimate.is_stuck(now, self.lease());
            let holds = if is_stuck { Vec::new() } else { self.work.held() };
            send(Message::Beat { holds, idle, sent: now }, actions);
        }
        let next = [self.work.due(), self.heartbeat.expiry(), self.admission.expiry()].into_iter().flatten().min();
        if let Some(next) = next.filter(|&next| self.timer.is_none_or(|timer| next < timer)) {
            self.timer = Some(next);
            actions.push(Action::SetTimer(next));
        }
    }

    fn lease(&self) -> Duration {
        self.heartbeat.interval() * LEASE_BEATS
    }
}

/// Appends the action that sends `message` to the parent.
fn send(message: Message, actions: &mut Vec<Action>) {
    actions.push(Action::Send { to: Party::Parent, message });
}

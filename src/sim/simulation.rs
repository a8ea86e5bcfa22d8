//! The discrete event simulator of a run.

use std::collections::BTreeMap;
use std::mem;
use std::time::Duration;

use super::event_queue::{EventQueue, InTransit, SimEvent};
use super::faults::Faults;
use super::link::{Link, Wire};
use super::measured_error::MeasuredError;
use super::sim_node::SimNode;
use crate::balance::{Action, Condition, Event, Message, NodeId, Parent, Party, Rules, estimate};
use crate::picture::{Atom, Division};
use crate::record::{Record, RecordKind};
use crate::runlog::{Header, LinkSettings, OwnLink, RunLog};
use crate::scenario::Command;
use crate::time::Time;

/// A run in virtual time. It processes events as far as the caller asks, and passes on its records in the order of
/// time.
pub struct Sim {
    pub(super) now: Time,
    pub(super) events: EventQueue,
    parent: Parent,
    parent_links: BTreeMap<usize, Link>,
    /// When the parent will have handled all messages that have arrived so far.
    parent_busy: Time,
    pub(super) finished: bool,
    pub(super) nodes: Vec<SimNode>,
    /// The wire that all parties share, if they do.
    wire: Option<Wire>,
    pub(super) faults: Faults,
    parent_timer: Option<Time>,
    pub(super) rules: Rules,
    link: LinkSettings,
    handling: Duration,
    pace: f64,
    division: Division,
    scene_bytes: u64,
    cost: Box<Cost>,
    /// Costs of an estimate's samples, if they were measured.
    sample: Option<Vec<Duration>>,
    sent: u64,
    /// Number of events processed so far.
    processed: u64,
    actions: Vec<Action>,
    /// Number of times that an action is executed, if not once.
    tamper: Option<Box<Tamper>>,
}

/// Returns how often an action of a party is executed.
type Tamper = dyn FnMut(Party, &Action) -> usize + Send;

/// Returns the cost of an atom in CPU time of the reference machine at full pace.
type Cost = dyn Fn(Atom) -> Duration + Send;

/// The receiver of a run's records.
pub(super) type RecordSink<'a> = &'a mut dyn FnMut(Record);

impl Sim {
    /// Creates the run that `header` describes, with the commands of `script`. No event is processed yet.
    ///
    /// # Panics
    /// If the header has no speeds, or more than 65,535.
    pub fn new(header: &Header, script: &[(Time, Command)], cost: impl Fn(Atom) -> Duration + Send + 'static) -> Self {
        let nodes = header.speeds.len();
        assert!((1..=usize::from(NodeId::MAX)).contains(&nodes), "a run of {nodes} nodes is impossible");
        let mut events = EventQueue::default();
        for &(at, command) in script {
            events.schedule(at, SimEvent::Command(command));
        }
        let mut sim = Self {
            now: Time::ZERO,
            events,
            parent: Parent::with_spares(&header.rules, header.division, nodes as NodeId, header.spares),
            parent_links: BTreeMap::new(),
            parent_busy: Time::ZERO,
            finished: false,
            nodes: (0..nodes as NodeId).map(|id| SimNode::new(header, id)).collect(),
            wire: header.link.shared.then(Wire::default),
            faults: Faults::default(),
            parent_timer: None,
            rules: header.rules.clone(),
            link: header.link.clone(),
            handling: header.handling,
            pace: header.pace,
            division: header.division,
            scene_bytes: header.scene_text.len() as u64,
            cost: Box::new(cost),
            sample: None,
            sent: 0,
            processed: 0,
            actions: Vec::new(),
            tamper: None,
        };
        sim.events.schedule(Time::ZERO, SimEvent::Started);
        sim
    }

    /// Creates the run that `header` describes, with the costs that were measured in a run of the same picture: without
    /// a change the two should last the same time.
    ///
    /// # Errors
    /// [`MeasuredError`], if `measured` is of another division of the picture, or was not finished.
    ///
    /// # Panics
    /// As [`Sim::new`].
    pub fn measured(header: &Header, measured: &RunLog) -> Result<Self, MeasuredError> {
        let its = &measured.header;
        if its.division != header.division {
            return Err(MeasuredError::OtherDivision {
                measured: (its.size, its.division.atom_pixels()),
                asked: (header.size, header.division.atom_pixels()),
            });
        }
        let costs: Option<Vec<Duration>> = measured.costs().into_iter().collect();
        let costs = costs.ok_or(MeasuredError::NotAllTraced)?;
        let mut sim = Self::new(header, &[], move |atom| costs[atom as usize]);
        sim.sample = measured.records().iter().find_map(|record| match &record.kind {
            RecordKind::Estimated { costs } => Some(costs.clone()),
            _ => None,
        });
        Ok(sim)
    }

    /// Executes each action of a party as often as `tamper` returns, from now on. Tests inject bugs in this way, to see
    /// whether they are found.
    pub fn tamper(&mut self, tamper: impl FnMut(Party, &Action) -> usize + Send + 'static) {
        self.tamper = Some(Box::new(tamper));
    }

    /// Returns the time up to which all events are processed.
    pub fn now(&self) -> Time {
        self.now
    }

    /// Returns the time of the next event; `None` if there is none.
    pub fn next(&self) -> Option<Time> {
        self.events.next()
    }

    /// Returns whether the picture is complete; the shutdown may still be on its way to the nodes.
    pub fn is_finished(&self) -> bool {
        self.finished
    }

    /// Returns the number of events processed so far.
    pub fn processed(&self) -> u64 {
        self.processed
    }

    /// Processes all events up to and including the time `until`.
    pub fn advance(&mut self, until: Time, sink: &mut dyn FnMut(Record)) {
        while let Some((at, event)) = self.events.pop(until) {
            self.now = at;
            self.processed += 1;
            self.process(event, sink);
        }
        // `Time(u64::MAX)` means all events; it does not become the present time.
        if until < Time(u64::MAX) {
            self.now = self.now.max(until);
        }
    }

    /// Executes a command now.
    pub fn command(&mut self, command: Command, sink: &mut dyn FnMut(Record)) {
        match command.clamped() {
            Command::Speed { node, speed } => {
                let Some(index) = self.machine(node) else { return };
                self.nodes[index].machine.set_speed(speed, self.now);
                self.record(RecordKind::SpeedSet { node, speed }, sink);
                self.resume_worker(node, sink);
            }
            Command::Pause { node, paused } => {
                let Some(index) = self.machine(node) else { return };
                let party = &mut self.nodes[index];
                if mem::replace(&mut party.paused, paused) == paused {
                    return;
                }
                party.machine.set_paused(paused || party.condition == Condition::Hung, self.now);
                self.record(if paused { RecordKind::Paused { node } } else { RecordKind::Resumed { node } }, sink);
                self.resume_worker(node, sink);
            }
            Command::Condition { node, condition } => self.set_condition(node, condition, sink),
            Command::Link { one, other, cut } => {
                if !self.finished && self.faults.cut_link(one, other, cut) {
                    self.record(RecordKind::Link { one, other, cut }, sink);
                }
            }
            Command::Delay { from, to, by } => self.delay(from, to, by, sink),
            Command::Latency(latency) if self.finished || latency == self.link.latency => {}
            Command::Latency(latency) => {
                self.link.latency = latency;
                self.record(RecordKind::LatencySet { latency }, sink);
            }
            Command::OwnLatency { party, latency } => {
                let own = OwnLink { latency, ..self.link.own(party) };
                if !self.finished && self.has(party) && own != self.link.own(party) {
                    self.link.set_own(party, own);
                    self.record(RecordKind::OwnLatencySet { party, latency }, sink);
                }
            }
        }
    }

    /// Returns whether the run has this party.
    fn has(&self, party: Party) -> bool {
        matches!(party, Party::Node(node) if usize::from(node) < self.nodes.len()) || party == Party::Parent
    }

    /// Returns the index of a node that has not ended.
    pub(super) fn machine(&self, node: NodeId) -> Option<usize> {
        let index = usize::from(node);
        self.nodes.get(index).filter(|party| !party.finished).map(|_| index)
    }

    fn process(&mut self, event: SimEvent, sink: RecordSink<'_>) {
        match event {
            SimEvent::Started => self.handle_event(Party::Parent, Event::Started, sink),
            SimEvent::Lost(id) => self.record(RecordKind::Lost { id }, sink),
            SimEvent::Arrival { to, mail } if self.faults.is_cut(mail.from, to) => {
                self.record(RecordKind::Lost { id: mail.id }, sink);
            }
            SimEvent::Arrival { to: Party::Parent, mail } if !self.handling.is_zero() => {
                self.parent_busy = self.parent_busy.max(self.now) + self.handling;
                self.events.schedule(self.parent_busy, SimEvent::Handled(mail));
            }
            SimEvent::Arrival { to, mail } => self.receive(to, mail, sink),
            SimEvent::Handled(mail) => self.receive(Party::Parent, mail, sink),
            SimEvent::Estimated(costs) => {
                self.record(RecordKind::Estimated { costs: costs.clone() }, sink);
                self.handle_event(Party::Parent, Event::Estimated(costs), sink);
            }
            SimEvent::Timer(Party::Node(node)) => self.fire_timer(node, sink),
            SimEvent::Timer(Party::Parent) => {
                let now = self.now;
                if self.parent_timer.take_if(|at| *at <= now).is_some() {
                    self.handle_event(Party::Parent, Event::Timer, sink);
                }
            }
            SimEvent::AtomDone { node, version } => self.atom_done(node, version, sink),
            SimEvent::Command(command) => self.command(command, sink),
        }
    }

    /// Fires a node's timer if it is due. A machine that hangs does so later.
    pub(super) fn fire_timer(&mut self, node: NodeId, sink: RecordSink<'_>) {
        let now = self.now;
        let party = &mut self.nodes[usize::from(node)];
        if party.condition != Condition::Hung && party.timer.take_if(|at| *at <= now).is_some() {
            self.handle_event(Party::Node(node), Event::Timer, sink);
        }
    }

    /// Hands a message to its receiver, or to the mailbox of a machine that hangs. A party that has ended drops it.
    pub(super) fn receive(&mut self, to: Party, mail: InTransit, sink: RecordSink<'_>) {
        if let Party::Node(node) = to {
            let party = &mut self.nodes[usize::from(node)];
            match party.condition {
                Condition::Off => return self.record(RecordKind::Lost { id: mail.id }, sink),
                Condition::Hung if !party.finished => return party.mailbox.push(mail),
                _ => {}
            }
        }
        let InTransit { id, from, message } = mail;
        if !self.has_ended(to) {
            self.record(RecordKind::Received { id, by: to }, sink);
            self.handle_event(to, Event::Message { from, message }, sink);
        }
    }

    fn has_ended(&self, party: Party) -> bool {
        match party {
            Party::Parent => self.finished,
            Party::Node(node) => self.nodes[usize::from(node)].finished,
        }
    }

    fn atom_done(&mut self, node: NodeId, version: u32, sink: RecordSink<'_>) {
        let party = &mut self.nodes[usize::from(node)];
        if version != party.due_version {
            return;
        }
        let Some(atom) = party.pipe.pop_front() else { return };
        party.machine.finish(self.now);
        party.in_hand = false;
        let cost = (self.cost)(atom);
        self.record(RecordKind::AtomDone { node, atom, cost }, sink);
        self.resume_worker(node, sink);
        self.handle_event(Party::Node(node), Event::AtomDone { atom, cost }, sink);
    }

    /// Hands an event to a party that has not ended, and executes its actions.
    pub(super) fn handle_event(&mut self, to: Party, event: Event, sink: RecordSink<'_>) {
        if self.has_ended(to) {
            return;
        }
        let mut actions = mem::take(&mut self.actions);
        match to {
            Party::Parent => self.parent.handle(self.now, event, &mut actions),
            Party::Node(node) => self.nodes[usize::from(node)].node.handle(self.now, event, &mut actions),
        }
        for action in actions.drain(..) {
            for _ in 0..self.tamper.as_mut().map_or(1, |tamper| tamper(to, &action)) {
                self.execute(to, action.clone(), sink);
            }
        }
        self.actions = actions;
    }

    fn execute(&mut self, party: Party, action: Action, sink: RecordSink<'_>) {
        match (party, action) {
            (from, Action::Send { to, message }) => self.send(from, to, message, sink),
            (Party::Node(node), Action::Trace(atom)) => {
                let party = &mut self.nodes[usize::from(node)];
                party.pipe.push_back(atom);
                if !party.in_hand {
                    self.resume_worker(node, sink);
                }
            }
            (party, Action::SetTimer(at)) => {
                match party {
                    Party::Parent => self.parent_timer = Some(at),
                    Party::Node(node) => self.nodes[usize::from(node)].timer = Some(at),
                }
                self.events.schedule(at, SimEvent::Timer(party));
            }
            (Party::Node(node), Action::Retire) => self.record(RecordKind::Retired { node }, sink),
            (Party::Node(node), Action::Finish) => self.nodes[usize::from(node)].finished = true,
            (Party::Parent, Action::Estimate) => self.estimate(sink),
            (Party::Parent, Action::Finish) => {
                self.record(RecordKind::Finished, sink);
                self.end();
            }
            (Party::Parent, Action::Fail(atom)) => {
                self.record(RecordKind::GivenUp { atom }, sink);
                self.end();
            }
            (party, other) => unreachable!("{party:?} never asks for {other:?}"),
        }
    }

    fn send(&mut self, from: Party, to: Party, message: Message, sink: RecordSink<'_>) {
        let bytes = message.bytes(self.division, self.scene_bytes);
        let links = match from {
            Party::Parent => &mut self.parent_links,
            Party::Node(node) => &mut self.nodes[usize::from(node)].links,
        };
        let place = if let Party::Node(node) = to { usize::from(node) } else { usize::MAX };
        let link = links.entry(place).or_default();
        let (latency, bandwidth) = self.link.between(from, to);
        let arrives = link.arrival(self.now, bytes, latency, bandwidth, self.wire.as_mut());
        let arrives = self.faults.arrival(from, to, arrives);
        let id = self.sent;
        self.sent += 1;
        self.record(RecordKind::Sent { id, from, to, message: message.clone(), bytes, arrives }, sink);
        let cut = self.faults.is_cut(from, to);
        let arrival = SimEvent::Arrival { to, mail: InTransit { id, from, message } };
        self.events.schedule(arrives, if cut { SimEvent::Lost(id) } else { arrival });
    }

    /// Starts the parent's estimate, which takes as long as on the reference machine. Unless the costs were measured, a
    /// pixel costs an equal part of its atom's cost.
    fn estimate(&mut self, sink: RecordSink<'_>) {
        self.record(RecordKind::Estimating, sink);
        let cost_of = |pixel: u32| {
            let atom = pixel / self.division.atom_pixels();
            (self.cost)(atom) / self.division.pixels_in(&(atom..atom + 1))
        };
        let costs = self
            .sample
            .clone()
            .unwrap_or_else(|| estimate::samples(self.division).map(|pixels| pixels.map(cost_of).sum()).collect());
        let all: Duration = costs.iter().sum();
        self.events.schedule(self.now + all.div_f64(self.pace), SimEvent::Estimated(costs));
    }

    /// Lets a node's worker continue: it begins the first atom in its pipe if it can, and the atom in hand gets a new
    /// due time.
    pub(super) fn resume_worker(&mut self, node: NodeId, sink: RecordSink<'_>) {
        let party = &mut self.nodes[usize::from(node)];
        if let Some(&atom) = party.pipe.front()
            && !party.in_hand
            && !party.machine.is_stopped()
        {
            party.in_hand = true;
            party.machine.begin(self.now, (self.cost)(atom));
            sink(Record { at: self.now, kind: RecordKind::AtomStarted { node, atom } });
        }
        // Invalidates the due time that the atom in hand had before.
        party.due_version = party.due_version.wrapping_add(1);
        if party.in_hand
            && let Some(due) = party.machine.due()
        {
            self.events.schedule(due, SimEvent::AtomDone { node, version: party.due_version });
        }
    }

    /// Makes a record of the present time.
    pub(super) fn record(&self, kind: RecordKind, sink: RecordSink<'_>) {
        sink(Record { at: self.now, kind });
    }
}

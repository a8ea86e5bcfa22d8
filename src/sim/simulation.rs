//! A run in virtual time.

use std::collections::BTreeMap;
use std::mem;
use std::time::Duration;

use super::event_queue::{EventQueue, InTransit, SimEvent};
use super::faults::Faults;
use super::link::{Link, Wire};
use super::sim_node::SimNode;
use crate::balance::{Action, Condition, Event, Message, NodeId, Parent, Party, Rules, estimate};
use crate::picture::{Atom, Division};
use crate::record::{Record, RecordKind};
use crate::runlog::{Header, RunLog};
use crate::scenario::Command;
use crate::time::Time;

/// A run in virtual time. It happens as far as it is asked to, and tells its records in the order of time.
pub struct Sim {
    pub(super) now: Time,
    pub(super) future: EventQueue,
    parent: Parent,
    parent_links: BTreeMap<usize, Link>,
    /// Until when the parent is busy with what has arrived so far.
    parent_busy: Time,
    pub(super) finished: bool,
    pub(super) nodes: Vec<SimNode>,
    /// What all share, if they do.
    wire: Option<Wire>,
    pub(super) faults: Faults,
    parent_timer: Option<Time>,
    pub(super) rules: Rules,
    latency: Duration,
    bandwidth: Option<f64>,
    handling: Duration,
    pace: f64,
    division: Division,
    scene_bytes: u64,
    cost: Box<Cost>,
    /// What an estimate's samples cost, if that was measured.
    sample: Option<Vec<Duration>>,
    sent: u64,
    happened: u64,
    actions: Vec<Action>,
    /// How often an action is carried out, if not once.
    tamper: Option<Box<Tamper>>,
}

/// How often an action of a party is carried out.
type Tamper = dyn FnMut(Party, &Action) -> usize + Send;

/// What an atom costs, in CPU time of the reference machine at full pace.
type Cost = dyn Fn(Atom) -> Duration + Send;

/// Whoever is told of records.
pub(super) type RecordSink<'a> = &'a mut dyn FnMut(Record);

impl Sim {
    /// The run that `header` describes, to which `script` is done; nothing has happened yet.
    ///
    /// # Panics
    /// If the header has no speeds, or more than 65,535.
    pub fn new(header: &Header, script: &[(Time, Command)], cost: impl Fn(Atom) -> Duration + Send + 'static) -> Self {
        let nodes = header.speeds.len();
        assert!((1..=usize::from(NodeId::MAX)).contains(&nodes), "a run of {nodes} nodes is impossible");
        let mut future = EventQueue::default();
        for &(at, command) in script {
            future.plan(at, SimEvent::Command(command));
        }
        let mut sim = Self {
            now: Time::ZERO,
            future,
            parent: Parent::with_spares(&header.rules, header.division, nodes as NodeId, header.spares),
            parent_links: BTreeMap::new(),
            parent_busy: Time::ZERO,
            finished: false,
            nodes: (0..nodes as NodeId).map(|id| SimNode::new(header, id)).collect(),
            wire: header.link.shared.then(Wire::default),
            faults: Faults::default(),
            parent_timer: None,
            rules: header.rules,
            latency: header.link.latency,
            bandwidth: header.link.bandwidth,
            handling: header.handling,
            pace: header.pace,
            division: header.division,
            scene_bytes: header.scene_text.len() as u64,
            cost: Box::new(cost),
            sample: None,
            sent: 0,
            happened: 0,
            actions: Vec::new(),
            tamper: None,
        };
        sim.future.plan(Time::ZERO, SimEvent::Started);
        sim
    }

    /// The run that `header` describes, with the costs that were measured in a run of the same picture: without a change
    /// the two should last the same time.
    ///
    /// # Errors
    /// A sentence, if `measured` is of another division of the picture, or was not finished.
    ///
    /// # Panics
    /// As [`Sim::new`].
    pub fn measured(header: &Header, measured: &RunLog) -> Result<Self, String> {
        let its = &measured.header;
        if its.division != header.division {
            return Err(format!(
                "it is of a picture of {} in atoms of {} pixels, not of {} in atoms of {}",
                its.size,
                its.division.atom_pixels(),
                header.size,
                header.division.atom_pixels()
            ));
        }
        let costs: Vec<Duration> =
            measured.costs().into_iter().collect::<Option<_>>().ok_or("not all atoms were traced")?;
        let mut sim = Self::new(header, &[], move |atom| costs[atom as usize]);
        sim.sample = measured.records().iter().find_map(|record| match &record.what {
            RecordKind::Estimated { costs } => Some(costs.clone()),
            _ => None,
        });
        Ok(sim)
    }

    /// From now on each action of a party is carried out as often as `tamper` says: bugs that are put in on purpose, to see
    /// whether they are found.
    pub fn tamper(&mut self, tamper: impl FnMut(Party, &Action) -> usize + Send + 'static) {
        self.tamper = Some(Box::new(tamper));
    }

    /// The time up to which everything has happened.
    pub fn now(&self) -> Time {
        self.now
    }

    /// When the next thing happens; `None` if nothing ever will.
    pub fn next(&self) -> Option<Time> {
        self.future.next()
    }

    /// Whether the picture is complete; the nodes may still have to hear of it.
    pub fn is_finished(&self) -> bool {
        self.finished
    }

    /// How many things have happened.
    pub fn happened(&self) -> u64 {
        self.happened
    }

    /// Lets happen what does until `until`, that time included.
    pub fn advance(&mut self, until: Time, tell: &mut dyn FnMut(Record)) {
        while let Some((at, happening)) = self.future.pop(until) {
            self.now = at;
            self.happened += 1;
            self.happen(happening, tell);
        }
        // The end of time is no time to go on from.
        if until < Time(u64::MAX) {
            self.now = self.now.max(until);
        }
    }

    /// Does something to the run now.
    pub fn command(&mut self, command: Command, tell: &mut dyn FnMut(Record)) {
        match command.possible() {
            Command::Speed { node, speed } => {
                let Some(index) = self.machine(node) else { return };
                self.nodes[index].machine.set_speed(speed, self.now);
                self.note(RecordKind::SpeedSet { node, speed }, tell);
                self.go_on(node, tell);
            }
            Command::Pause { node, paused } => {
                let Some(index) = self.machine(node) else { return };
                let party = &mut self.nodes[index];
                if mem::replace(&mut party.paused, paused) == paused {
                    return;
                }
                party.machine.set_paused(paused || party.condition == Condition::Hung, self.now);
                self.note(if paused { RecordKind::Paused { node } } else { RecordKind::Resumed { node } }, tell);
                self.go_on(node, tell);
            }
            Command::Condition { node, condition } => self.set_condition(node, condition, tell),
            Command::Link { one, other, cut } => {
                if !self.finished && self.faults.cut_link(one, other, cut) {
                    self.note(RecordKind::Link { one, other, cut }, tell);
                }
            }
            Command::Delay { from, to, by } => self.delay(from, to, by, tell),
            Command::Latency(latency) if self.finished || latency == self.latency => {}
            Command::Latency(latency) => {
                self.latency = latency;
                self.note(RecordKind::LatencySet { latency }, tell);
            }
        }
    }

    /// The place of a node that has not ended.
    pub(super) fn machine(&self, node: NodeId) -> Option<usize> {
        let index = usize::from(node);
        self.nodes.get(index).filter(|party| !party.finished).map(|_| index)
    }

    fn happen(&mut self, happening: SimEvent, tell: RecordSink<'_>) {
        match happening {
            SimEvent::Started => self.hand_over(Party::Parent, Event::Started, tell),
            SimEvent::Lost(id) => self.note(RecordKind::Lost { id }, tell),
            SimEvent::Arrival { to, mail } if self.faults.is_cut(mail.from, to) => {
                self.note(RecordKind::Lost { id: mail.id }, tell);
            }
            SimEvent::Arrival { to: Party::Parent, mail } if !self.handling.is_zero() => {
                self.parent_busy = self.parent_busy.max(self.now) + self.handling;
                self.future.plan(self.parent_busy, SimEvent::Handled(mail));
            }
            SimEvent::Arrival { to, mail } => self.receive(to, mail, tell),
            SimEvent::Handled(mail) => self.receive(Party::Parent, mail, tell),
            SimEvent::Estimated(costs) => {
                self.note(RecordKind::Estimated { costs: costs.clone() }, tell);
                self.hand_over(Party::Parent, Event::Estimated(costs), tell);
            }
            SimEvent::Timer(Party::Node(node)) => self.timer(node, tell),
            SimEvent::Timer(Party::Parent) => {
                let now = self.now;
                if self.parent_timer.take_if(|at| *at <= now).is_some() {
                    self.hand_over(Party::Parent, Event::Timer, tell);
                }
            }
            SimEvent::AtomDone { node, plan } => self.atom_done(node, plan, tell),
            SimEvent::Command(command) => self.command(command, tell),
        }
    }

    /// A node's timer, unless it has been set anew since; who hangs looks at it later.
    pub(super) fn timer(&mut self, node: NodeId, tell: RecordSink<'_>) {
        let now = self.now;
        let party = &mut self.nodes[usize::from(node)];
        if party.condition != Condition::Hung && party.timer.take_if(|at| *at <= now).is_some() {
            self.hand_over(Party::Node(node), Event::Timer, tell);
        }
    }

    /// Who has ended no longer listens.
    pub(super) fn receive(&mut self, to: Party, mail: InTransit, tell: RecordSink<'_>) {
        if let Party::Node(node) = to {
            let party = &mut self.nodes[usize::from(node)];
            match party.condition {
                Condition::Off => return self.note(RecordKind::Lost { id: mail.id }, tell),
                Condition::Hung if !party.finished => return party.mailbox.push(mail),
                _ => {}
            }
        }
        let InTransit { id, from, message } = mail;
        if !self.has_ended(to) {
            self.note(RecordKind::Received { id, by: to }, tell);
            self.hand_over(to, Event::Message { from, message }, tell);
        }
    }

    fn has_ended(&self, party: Party) -> bool {
        match party {
            Party::Parent => self.finished,
            Party::Node(node) => self.nodes[usize::from(node)].finished,
        }
    }

    fn atom_done(&mut self, node: NodeId, plan: u32, tell: RecordSink<'_>) {
        let party = &mut self.nodes[usize::from(node)];
        if plan != party.plan {
            return;
        }
        let Some(atom) = party.pipe.pop_front() else { return };
        party.machine.finish(self.now);
        party.in_hand = false;
        let cost = (self.cost)(atom);
        self.note(RecordKind::AtomDone { node, atom, cost }, tell);
        self.go_on(node, tell);
        self.hand_over(Party::Node(node), Event::AtomDone { atom, cost }, tell);
    }

    /// Hands a party that has not ended an event, and does what it asks for.
    pub(super) fn hand_over(&mut self, to: Party, event: Event, tell: RecordSink<'_>) {
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
                self.carry_out(to, action.clone(), tell);
            }
        }
        self.actions = actions;
    }

    fn carry_out(&mut self, party: Party, action: Action, tell: RecordSink<'_>) {
        match (party, action) {
            (from, Action::Send { to, message }) => self.send(from, to, message, tell),
            (Party::Node(node), Action::Trace(atom)) => {
                let party = &mut self.nodes[usize::from(node)];
                party.pipe.push_back(atom);
                if !party.in_hand {
                    self.go_on(node, tell);
                }
            }
            (party, Action::SetTimer(at)) => {
                match party {
                    Party::Parent => self.parent_timer = Some(at),
                    Party::Node(node) => self.nodes[usize::from(node)].timer = Some(at),
                }
                self.future.plan(at, SimEvent::Timer(party));
            }
            (Party::Node(node), Action::Retire) => self.note(RecordKind::Retired { node }, tell),
            (Party::Node(node), Action::Finish) => self.nodes[usize::from(node)].finished = true,
            (Party::Parent, Action::Estimate) => self.estimate(tell),
            (Party::Parent, Action::Finish) => {
                self.note(RecordKind::Finished, tell);
                self.end();
            }
            (Party::Parent, Action::Fail(atom)) => {
                self.note(RecordKind::GivenUp { atom }, tell);
                self.end();
            }
            (party, other) => unreachable!("{party:?} never asks for {other:?}"),
        }
    }

    fn send(&mut self, from: Party, to: Party, message: Message, tell: RecordSink<'_>) {
        let bytes = message.bytes(self.division, self.scene_bytes);
        let links = match from {
            Party::Parent => &mut self.parent_links,
            Party::Node(node) => &mut self.nodes[usize::from(node)].links,
        };
        let place = if let Party::Node(node) = to { usize::from(node) } else { usize::MAX };
        let link = links.entry(place).or_default();
        let arrives = link.arrival(self.now, bytes, self.latency, self.bandwidth, self.wire.as_mut());
        let arrives = self.faults.arrival(from, to, arrives);
        let id = self.sent;
        self.sent += 1;
        self.note(RecordKind::Sent { id, from, to, message: message.clone(), bytes, arrives }, tell);
        let cut = self.faults.is_cut(from, to);
        let arrival = SimEvent::Arrival { to, mail: InTransit { id, from, message } };
        self.future.plan(arrives, if cut { SimEvent::Lost(id) } else { arrival });
    }

    /// The parent samples the picture as fast as the reference machine would; if it was not measured, a pixel costs what is
    /// its atom's share.
    fn estimate(&mut self, tell: RecordSink<'_>) {
        self.note(RecordKind::Estimating, tell);
        let cost_of = |pixel: u32| {
            let atom = pixel / self.division.atom_pixels();
            (self.cost)(atom) / self.division.pixels_in(&(atom..atom + 1))
        };
        let costs = self
            .sample
            .clone()
            .unwrap_or_else(|| estimate::samples(self.division).map(|pixels| pixels.map(cost_of).sum()).collect());
        let all: Duration = costs.iter().sum();
        self.future.plan(self.now + all.div_f64(self.pace), SimEvent::Estimated(costs));
    }

    /// The worker begins the next atom, unless it has one in hand, stands still, or has none; its speed is a new one.
    pub(super) fn go_on(&mut self, node: NodeId, tell: RecordSink<'_>) {
        let party = &mut self.nodes[usize::from(node)];
        if let Some(&atom) = party.pipe.front()
            && !party.in_hand
            && !party.machine.is_stopped()
        {
            party.in_hand = true;
            party.machine.begin(self.now, (self.cost)(atom));
            tell(Record { at: self.now, what: RecordKind::AtomStarted { node, atom } });
        }
        // What was planned for the atom in hand is void now.
        party.plan = party.plan.wrapping_add(1);
        if party.in_hand
            && let Some(due) = party.machine.due()
        {
            self.future.plan(due, SimEvent::AtomDone { node, plan: party.plan });
        }
    }

    pub(super) fn note(&self, what: RecordKind, tell: RecordSink<'_>) {
        tell(Record { at: self.now, what });
    }
}

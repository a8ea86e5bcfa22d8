//! A parent and its nodes in virtual time: one thread, no clock, the same run every time.

use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

use anel::balance::{Action, Event, Message, Node, NodeId, Parent, Party, Strategy};
use anel::picture::{Atom, Division};
use anel::time::Time;

/// What is to be run.
pub struct Setup {
    pub division: Division,
    /// By node: how many CPU seconds it does in a second.
    pub speeds: Vec<f64>,
    /// When a node's speed changes, in seconds.
    pub swings: Vec<(f64, NodeId, f64)>,
    /// What an atom costs, in CPU seconds.
    pub cost: fn(Atom) -> f64,
    pub latency: Duration,
    pub part: u32,
}

/// What came of it.
pub struct Outcome {
    /// What each party did when.
    pub log: Vec<(Time, Party, Action)>,
    /// By node: when its worker was done with its last atom.
    pub ends: Vec<Time>,
}

struct Machine {
    node: Node,
    speed: f64,
    pipe: VecDeque<Atom>,
    /// CPU seconds that the first atom in the pipe still needs at `since`.
    left: f64,
    since: Time,
    /// Counts the plans made for the atom in hand: only the latest holds.
    plan: u64,
    timer: Option<Time>,
    finished: bool,
}

enum Happening {
    Message { from: Party, to: Party, message: Message },
    AtomDone { node: NodeId, plan: u64 },
    Timer { node: NodeId },
    Swing { node: NodeId, speed: f64 },
}

struct World<'a> {
    setup: &'a Setup,
    now: Time,
    parent: Parent,
    machines: Vec<Machine>,
    /// By time, and at one time in the order in which they were made.
    future: BTreeMap<(Time, u64), Happening>,
    made: u64,
    /// When the last message from one party to another arrives.
    arrivals: BTreeMap<(Party, Party), Time>,
    offers_in_flight: usize,
    finished: bool,
    outcome: Outcome,
}

/// Runs `setup` to its end.
///
/// # Panics
/// If the run gets stuck, if anything is left running, or if more is in flight than the ring's README allows.
pub fn run(setup: &Setup) -> Outcome {
    let nodes = setup.speeds.len() as NodeId;
    let machine = |(id, &speed): (NodeId, &f64)| Machine {
        node: Node::new(Strategy::Ring, id, nodes, setup.part),
        speed,
        pipe: VecDeque::new(),
        left: 0.0,
        since: Time::ZERO,
        plan: 0,
        timer: None,
        finished: false,
    };
    let mut world = World {
        setup,
        now: Time::ZERO,
        parent: Parent::new(Strategy::Ring, setup.division, nodes),
        machines: (0..nodes).zip(&setup.speeds).map(machine).collect(),
        future: BTreeMap::new(),
        made: 0,
        arrivals: BTreeMap::new(),
        offers_in_flight: 0,
        finished: false,
        outcome: Outcome { log: Vec::new(), ends: vec![Time::ZERO; usize::from(nodes)] },
    };
    for &(at, node, speed) in &setup.swings {
        world.plan(Time::from_secs(at), Happening::Swing { node, speed });
    }
    world.tell(Party::Parent, Event::Started);
    while let Some(((at, _), happening)) = world.future.pop_first() {
        world.now = at;
        world.happen(happening);
    }
    assert!(world.finished, "the run is stuck: nothing will happen any more");
    assert!(world.machines.iter().all(|machine| machine.finished), "a node was left running");
    world.outcome
}

impl World<'_> {
    fn plan(&mut self, at: Time, happening: Happening) {
        self.made += 1;
        self.future.insert((at, self.made), happening);
    }

    fn happen(&mut self, happening: Happening) {
        match happening {
            Happening::Message { from, to, message } => {
                self.offers_in_flight -= usize::from(matches!(message, Message::Offer { .. }));
                self.tell(to, Event::Message { from, message });
            }
            Happening::Timer { node } => {
                let due = self.machines[usize::from(node)].timer.take_if(|at| *at <= self.now);
                if due.is_some() {
                    self.tell(Party::Node(node), Event::Timer);
                }
            }
            Happening::AtomDone { node, plan } if plan == self.machines[usize::from(node)].plan => {
                let machine = &mut self.machines[usize::from(node)];
                let atom = machine.pipe.pop_front().expect("an atom in hand");
                self.outcome.ends[usize::from(node)] = self.now;
                self.take_in_hand(node);
                let cost = Duration::from_secs_f64((self.setup.cost)(atom));
                self.tell(Party::Node(node), Event::AtomDone { atom, cost });
            }
            Happening::AtomDone { .. } => {}
            Happening::Swing { node, speed } => {
                let machine = &mut self.machines[usize::from(node)];
                machine.left -= self.now.since(machine.since).as_secs_f64() * machine.speed;
                machine.speed = speed;
                self.plan_atom_done(node);
            }
        }
    }

    /// Hands a party that has not ended an event, and does what it asks for.
    fn tell(&mut self, party: Party, event: Event) {
        let mut actions = Vec::new();
        match party {
            Party::Parent if self.finished => {}
            Party::Parent => self.parent.handle(self.now, event, &mut actions),
            Party::Node(id) => {
                let machine = &mut self.machines[usize::from(id)];
                if !machine.finished {
                    machine.node.handle(self.now, event, &mut actions);
                }
            }
        }
        for action in actions {
            self.outcome.log.push((self.now, party, action.clone()));
            match (party, action) {
                (from, Action::Send { to, message }) => self.send(from, to, message),
                (Party::Node(id), Action::Trace(atom)) => {
                    let pipe = &mut self.machines[usize::from(id)].pipe;
                    pipe.push_back(atom);
                    match pipe.len() {
                        1 => self.take_in_hand(id),
                        length => assert!(length <= 2, "the pipe holds two atoms"),
                    }
                }
                (Party::Node(node), Action::SetTimer(at)) => {
                    self.machines[usize::from(node)].timer = Some(at);
                    self.plan(at, Happening::Timer { node });
                }
                (Party::Node(id), Action::Finish) => self.machines[usize::from(id)].finished = true,
                (Party::Parent, Action::Finish) => self.finished = true,
                (Party::Node(_), Action::Retire) => {}
                (Party::Parent, other) => panic!("the parent asks for {other:?}"),
            }
        }
    }

    /// No message overtakes an earlier one of the same sender and receiver.
    fn send(&mut self, from: Party, to: Party, message: Message) {
        if matches!(message, Message::Offer { .. }) {
            self.offers_in_flight += 1;
            assert!(self.offers_in_flight <= self.machines.len(), "a node has two offers under way");
        }
        let arrives = self.now + self.setup.latency;
        let last = self.arrivals.entry((from, to)).or_default();
        *last = arrives.max(*last);
        let arrives = *last;
        self.plan(arrives, Happening::Message { from, to, message });
    }

    fn take_in_hand(&mut self, node: NodeId) {
        let machine = &mut self.machines[usize::from(node)];
        machine.left = machine.pipe.front().map_or(0.0, |&atom| (self.setup.cost)(atom));
        self.plan_atom_done(node);
    }

    fn plan_atom_done(&mut self, node: NodeId) {
        let machine = &mut self.machines[usize::from(node)];
        machine.since = self.now;
        machine.plan += 1;
        if !machine.pipe.is_empty() && machine.speed > 0.0 {
            let due = self.now + Duration::from_secs_f64(machine.left.max(0.0) / machine.speed);
            let plan = machine.plan;
            self.plan(due, Happening::AtomDone { node, plan });
        }
    }
}

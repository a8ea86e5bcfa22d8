//! Runs for tests: the ring's own parent and nodes in virtual time, every atom as dear as the others.

use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

use crate::balance::{Action, Event, Message, Node, NodeId, Parent, Party, Strategy};
use crate::picture::{Atom, Division, Size};
use crate::record::{Record, What};
use crate::runlog::{Header, Link};
use crate::time::Time;

/// What a run with these speeds on a picture of `atoms` atoms was asked to do.
pub fn header(speeds: &[f64], atoms: u32) -> Header {
    let size = Size::new(50, atoms).expect("a small picture");
    Header {
        scene: "sample".into(),
        scene_text: String::new(),
        size,
        samples: 1,
        division: Division::new(size.pixels(), 50),
        strategy: Strategy::Ring,
        speeds: speeds.to_vec(),
        pace: 0.1,
        link: Link { latency: Duration::from_millis(40), bandwidth: None },
        handling: Duration::ZERO,
        part: 1,
        cores: 2,
    }
}

/// The records of a whole run, in the order of their times.
pub fn records(header: &Header) -> Vec<Record> {
    Sample::new(header).run()
}

/// What an atom costs on this computer; a node of speed 1 at pace 0.1 needs ten times as long.
pub const COST: Duration = Duration::from_millis(1);

struct Machine {
    node: Node,
    /// The first is being traced.
    pipe: VecDeque<Atom>,
    needs: Duration,
    timer: Option<Time>,
    finished: bool,
}

enum Happening {
    Message { id: u64, from: Party, to: Party, message: Message },
    Done(NodeId),
    Timer(NodeId),
}

struct Sample<'a> {
    header: &'a Header,
    now: Time,
    parent: Parent,
    machines: Vec<Machine>,
    /// By time, and at one time in the order in which they were made.
    future: BTreeMap<(Time, u64), Happening>,
    made: u64,
    finished: bool,
    records: Vec<Record>,
}

impl<'a> Sample<'a> {
    fn new(header: &'a Header) -> Self {
        let nodes = header.speeds.len() as NodeId;
        let machine = |(id, speed): (NodeId, &f64)| Machine {
            node: Node::new(header.strategy, id, nodes, header.part),
            pipe: VecDeque::new(),
            needs: COST.div_f64(speed * header.pace),
            timer: None,
            finished: false,
        };
        Self {
            header,
            now: Time::ZERO,
            parent: Parent::new(header.strategy, header.division, nodes),
            machines: (0..).zip(&header.speeds).map(machine).collect(),
            future: BTreeMap::new(),
            made: 0,
            finished: false,
            records: Vec::new(),
        }
    }

    fn run(mut self) -> Vec<Record> {
        self.tell(Party::Parent, Event::Started);
        while let Some(((at, _), happening)) = self.future.pop_first() {
            self.now = at;
            self.happen(happening);
        }
        self.records
    }

    fn happen(&mut self, happening: Happening) {
        match happening {
            Happening::Message { id, from, to, message } => {
                if !self.has_ended(to) {
                    self.note(What::Received { id, by: to });
                    self.tell(to, Event::Message { from, message });
                }
            }
            Happening::Timer(node) => {
                let now = self.now;
                if self.machines[usize::from(node)].timer.take_if(|at| *at <= now).is_some() {
                    self.tell(Party::Node(node), Event::Timer);
                }
            }
            Happening::Done(node) => {
                let pipe = &mut self.machines[usize::from(node)].pipe;
                let atom = pipe.pop_front().expect("an atom in hand");
                let is_empty = pipe.is_empty();
                self.note(What::AtomDone { node, atom, cost: COST });
                if !is_empty {
                    self.take_in_hand(node);
                }
                self.tell(Party::Node(node), Event::AtomDone { atom, cost: COST });
            }
        }
    }

    fn has_ended(&self, party: Party) -> bool {
        match party {
            Party::Parent => self.finished,
            Party::Node(node) => self.machines[usize::from(node)].finished,
        }
    }

    /// Hands a party that has not ended an event, and does what it asks for.
    fn tell(&mut self, party: Party, event: Event) {
        if self.has_ended(party) {
            return;
        }
        let mut actions = Vec::new();
        match party {
            Party::Parent => self.parent.handle(self.now, event, &mut actions),
            Party::Node(id) => self.machines[usize::from(id)].node.handle(self.now, event, &mut actions),
        }
        for action in actions {
            match (party, action) {
                (from, Action::Send { to, message }) => self.send(from, to, message),
                (Party::Node(node), Action::Trace(atom)) => {
                    let pipe = &mut self.machines[usize::from(node)].pipe;
                    pipe.push_back(atom);
                    if pipe.len() == 1 {
                        self.take_in_hand(node);
                    }
                }
                (Party::Node(node), Action::SetTimer(at)) => {
                    self.machines[usize::from(node)].timer = Some(at);
                    self.plan(at, Happening::Timer(node));
                }
                (Party::Node(node), Action::Retire) => self.note(What::Retired { node }),
                (Party::Node(node), Action::Finish) => self.machines[usize::from(node)].finished = true,
                (Party::Parent, Action::Finish) => {
                    self.note(What::Finished);
                    self.finished = true;
                }
                (Party::Parent, other) => panic!("the parent asks for {other:?}"),
            }
        }
    }

    fn take_in_hand(&mut self, node: NodeId) {
        let Machine { pipe, needs, .. } = &self.machines[usize::from(node)];
        let (atom, due) = (pipe[0], self.now + *needs);
        self.note(What::AtomStarted { node, atom });
        self.plan(due, Happening::Done(node));
    }

    fn send(&mut self, from: Party, to: Party, message: Message) {
        let (id, arrives) = (self.made, self.now + self.header.link.latency);
        let bytes = message.bytes(self.header.division, self.header.scene_text.len() as u64);
        self.note(What::Sent { id, from, to, message: message.clone(), bytes, arrives });
        self.plan(arrives, Happening::Message { id, from, to, message });
    }

    fn plan(&mut self, at: Time, happening: Happening) {
        self.future.insert((at, self.made), happening);
        self.made += 1;
    }

    fn note(&mut self, what: What) {
        self.records.push(Record { at: self.now, what });
    }
}

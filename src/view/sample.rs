//! Hand-made runs for tests: a small ring in virtual time, every atom as dear as the others.

use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

use crate::balance::{Message, NodeId, Party, Strategy};
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
    let mut sample = Sample::new(header);
    while sample.step() {}
    sample.records
}

/// What an atom costs on this computer; a node of speed 1 at pace 0.1 needs ten times as long.
pub const COST: Duration = Duration::from_millis(1);

enum Event {
    Arrival { id: u64, to: Party, message: Message },
    Done(NodeId, Atom),
}

struct Sample<'a> {
    header: &'a Header,
    records: Vec<Record>,
    events: BTreeMap<(Time, u64), Event>,
    queues: Vec<VecDeque<Atom>>,
    done: Vec<u32>,
    ids: u64,
    placed: u32,
}

impl<'a> Sample<'a> {
    fn new(header: &'a Header) -> Self {
        let nodes = header.speeds.len();
        let mut sample = Self {
            header,
            records: Vec::new(),
            events: BTreeMap::new(),
            queues: vec![VecDeque::new(); nodes],
            done: vec![0; nodes],
            ids: 0,
            placed: 0,
        };
        for (node, band) in header.division.bands(nodes).enumerate() {
            sample.send(Time::ZERO, Party::Parent, Party::Node(node as NodeId), Message::Band(band));
        }
        sample
    }

    fn step(&mut self) -> bool {
        let Some(((at, _), event)) = self.events.pop_first() else { return false };
        match event {
            Event::Arrival { id, to, message } => {
                self.note(at, What::Received { id, by: to });
                self.arrived(at, to, message);
            }
            Event::Done(node, atom) => {
                self.note(at, What::AtomDone { node, atom, cost: COST });
                self.done[usize::from(node)] += 1;
                self.queues[usize::from(node)].pop_front();
                self.send(
                    at,
                    Party::Node(node),
                    Party::Parent,
                    Message::Results(std::iter::once(atom..atom + 1).collect()),
                );
                self.go_on(at, node);
            }
        }
        true
    }

    fn arrived(&mut self, at: Time, to: Party, message: Message) {
        match (to, message) {
            (Party::Node(node), Message::Band(band)) => {
                self.queues[usize::from(node)].extend(band);
                self.go_on(at, node);
            }
            (Party::Node(node), Message::Transfer(ranges)) => {
                self.queues[usize::from(node)].extend(ranges.into_iter().flatten());
                self.go_on(at, node);
            }
            (Party::Node(node), Message::Offer { who, done }) => self.weigh(at, node, who, done),
            (Party::Parent, Message::Results(ranges)) => {
                self.placed += ranges.into_iter().flatten().count() as u32;
                if self.placed == self.header.division.atoms() {
                    self.note(at, What::Finished);
                }
            }
            _ => {}
        }
    }

    fn weigh(&mut self, at: Time, node: NodeId, who: NodeId, done: u32) {
        if node == who {
            return self.note(at, What::Retired { node });
        }
        let queue = &mut self.queues[usize::from(node)];
        let own = self.done[usize::from(node)];
        let spare = queue.len().saturating_sub(2) as f64;
        let share = (spare * f64::from(done) / f64::from((done + own).max(1))).round() as usize;
        if share == 0 {
            return self.send(at, Party::Node(node), self.left(node), Message::Offer { who, done });
        }
        let given = queue.split_off(queue.len() - share);
        let ranges = given.into_iter().map(|atom| atom..atom + 1).collect();
        self.send(at, Party::Node(node), Party::Node(who), Message::Transfer(ranges));
    }

    fn go_on(&mut self, at: Time, node: NodeId) {
        let place = usize::from(node);
        if let Some(&atom) = self.queues[place].front() {
            self.note(at, What::AtomStarted { node, atom });
            let needs = COST.div_f64(self.header.speeds[place] * self.header.pace);
            self.schedule(at + needs, Event::Done(node, atom));
        } else {
            let done = self.done[place];
            self.send(at, Party::Node(node), self.left(node), Message::Offer { who: node, done });
        }
    }

    fn left(&self, node: NodeId) -> Party {
        let nodes = self.queues.len() as NodeId;
        Party::Node((node + nodes - 1) % nodes)
    }

    fn send(&mut self, at: Time, from: Party, to: Party, message: Message) {
        let (id, arrives) = (self.ids, at + self.header.link.latency);
        let bytes = message.bytes(self.header.division, self.header.scene_text.len() as u64);
        self.note(at, What::Sent { id, from, to, message: message.clone(), bytes, arrives });
        self.schedule(arrives, Event::Arrival { id, to, message });
    }

    fn schedule(&mut self, at: Time, event: Event) {
        self.events.insert((at, self.ids), event);
        self.ids += 1;
    }

    fn note(&mut self, at: Time, what: What) {
        self.records.push(Record { at, what });
    }
}

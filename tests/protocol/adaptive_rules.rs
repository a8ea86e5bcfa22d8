//! The remedies of the adaptive ring, one by one: its nodes and its parent by themselves, and whole runs in virtual
//! time.

#![expect(clippy::single_range_in_vec_init, reason = "messages hold ranges")]

use std::ops::Range;
use std::time::Duration;

use anel::balance::{
    Action, Event, Message, Node, NodeId, OfferDetails, Parent, Party, Remedies, Remedy, Rules, Strategy,
};
use anel::picture::{Atom, Division, Size};
use anel::record::RecordKind;
use anel::runlog::{Header, LinkSettings, RunLog};
use anel::time::Time;

use crate::virtual_time;

const MS: Duration = Duration::from_millis(1);
const NODES: NodeId = 4;

fn rules(remedies: Remedies) -> Rules {
    Rules { remedies, ..Rules::usual(Strategy::Adaptive, Division::new(100, 1), NODES.into()) }
}

fn with(some: &[Remedy]) -> Remedies {
    some.iter().fold(Remedies::NONE, |all, &remedy| all.with(remedy))
}

fn at(ms: u32) -> Time {
    Time::ZERO + ms * MS
}

/// Node 1 of four, driven by hand, with its clock.
struct TestNode {
    node: Node,
    now: Time,
}

impl TestNode {
    /// The node with a band at time 0, and its actions.
    fn with_band(remedies: &[Remedy], band: Range<Atom>) -> (Self, Vec<Action>) {
        let mut test = Self { node: Node::new(&rules(with(remedies)), 1, NODES), now: Time::ZERO };
        let actions = test.message(Party::Parent, Message::Band(band));
        (test, actions)
    }

    fn event(&mut self, event: Event) -> Vec<Action> {
        let mut actions = Vec::new();
        self.node.handle(self.now, event, &mut actions);
        actions.retain(|action| !matches!(action, Action::SetTimer(_)));
        actions
    }

    fn message(&mut self, from: Party, message: Message) -> Vec<Action> {
        self.event(Event::Message { from, message })
    }

    /// Reports these atoms as traced, each at a cost of 1 ms after `took`. Returns the actions after the last.
    fn trace(&mut self, atoms: Range<Atom>, took: Duration) -> Vec<Action> {
        let mut actions = Vec::new();
        for atom in atoms {
            self.now += took;
            actions = self.event(Event::AtomDone { atom, cost: MS });
        }
        actions
    }

    /// Delivers an offer of node 2, which has this speed and sent it `ago`. Returns the actions.
    fn offer(&mut self, speed: f64, ago: Duration, left: Option<u16>) -> Vec<Action> {
        let help = OfferDetails { speed: OfferDetails::millionths(speed), sent: self.now - ago, stop: 1, left };
        self.message(Party::Node(2), Message::Offer { who: 2, done: 50, help: Some(help) })
    }
}

fn send(to: Party, message: Message) -> Action {
    Action::Send { to, message }
}

/// The number of atoms sent to node 2.
fn atoms_sent(actions: &[Action]) -> u32 {
    let ranges = actions.iter().find_map(|action| match action {
        Action::Send { to: Party::Node(2), message: Message::Transfer(ranges) } => Some(ranges),
        _ => None,
    });
    ranges.map_or(0, |ranges| ranges.iter().map(|range| range.len() as u32).sum())
}

/// The receivers of the offers sent.
fn offers(actions: &[Action]) -> Vec<Party> {
    let to = |action: &Action| match action {
        Action::Send { to, message: Message::Offer { .. } } => Some(*to),
        _ => None,
    };
    actions.iter().filter_map(to).collect()
}

/// Without remedies the adaptive ring is the article's ring: the same records at the same times.
#[test]
fn without_remedies_the_adaptive_ring_is_the_articles_ring() {
    let size = Size::new(40, 20).expect("a picture");
    let header = |strategy, latency| {
        let plain = Header::plain(size, 5, strategy, vec![1.0, 0.1, 0.6, 1.0]);
        Header {
            rules: Rules { remedies: Remedies::NONE, ..plain.rules },
            link: LinkSettings { latency, ..plain.link },
            ..plain
        }
    };
    let records = |strategy, latency| -> Vec<(Time, RecordKind)> {
        let log: RunLog = virtual_time::run(&header(strategy, latency), &[], |atom| f64::from(1 + atom % 7) * 1e-3);
        let plain = |kind: &RecordKind| match kind.clone() {
            RecordKind::Sent { id, from, to, message: Message::Offer { who, done, .. }, arrives, .. } => {
                RecordKind::Sent { id, from, to, message: Message::offer(who, done), bytes: 0, arrives }
            }
            other => other,
        };
        log.records().iter().map(|record| (record.at, plain(&record.kind))).collect()
    };
    for latency in [Duration::ZERO, MS, 20 * MS] {
        let (adaptive, ring) = (records(Strategy::Adaptive, latency), records(Strategy::Ring, latency));
        let ring: Vec<_> = ring
            .into_iter()
            .map(|(at, kind)| match kind {
                RecordKind::Sent { id, from, to, message: message @ Message::Offer { .. }, arrives, .. } => {
                    (at, RecordKind::Sent { id, from, to, message, bytes: 0, arrives })
                }
                other => (at, other),
            })
            .collect();
        assert_eq!(adaptive, ring, "{latency:?}");
    }
}

/// Speed: shares follow the present speeds of both nodes, not the atoms they have traced since the start.
#[test]
fn shares_follow_the_speeds_of_the_last_atoms() {
    let (mut node, _) = TestNode::with_band(&[Remedy::Speed], 0..100);
    node.trace(0..10, MS);
    assert_eq!(
        atoms_sent(&node.offer(0.25, Duration::ZERO, Some(3))),
        18,
        "a fifth of the 88 atoms in the queue and the two in the pipe"
    );
    let (mut node, _) = TestNode::with_band(&[], 0..100);
    node.trace(0..10, MS);
    assert_eq!(
        atoms_sent(&node.offer(0.25, Duration::ZERO, Some(3))),
        73,
        "without the remedy, by counts: 50 / 60 of 88"
    );
}

/// Floor: an atom is not sent if it would be finished later there than here.
#[test]
fn floor_keeps_atoms_that_would_travel_longer_than_they_wait() {
    for (remedies, expected) in [(&[Remedy::Speed, Remedy::Floor][..], 0), (&[Remedy::Speed], 5)] {
        let (mut node, _) = TestNode::with_band(remedies, 0..20);
        node.trace(0..10, MS);
        // Eight atoms wait; the node itself traces them in 8 ms.
        assert_eq!(atoms_sent(&node.offer(1.0, 30 * MS, Some(2))), expected);
    }
}

/// Early: an offer leaves one round trip before the atoms run out.
#[test]
fn early_offer_leaves_one_round_trip_before_the_last_atom() {
    let (mut node, _) = TestNode::with_band(&[Remedy::Speed, Remedy::Early], 0..20);
    node.trace(0..5, MS);
    // The offer has travelled 2 ms to its first stop; its sender is too slow for a share.
    assert_eq!(offers(&node.offer(1e-6, 2 * MS, Some(2))), [Party::Node(0)], "the offer is passed on");
    assert_eq!(offers(&node.trace(5..14, MS)), []);
    assert_eq!(
        offers(&node.trace(14..15, MS)),
        [Party::Node(0)],
        "four atoms before the last; a round trip takes 4 ms"
    );
    assert_eq!(offers(&node.trace(15..19, MS)), [], "only one offer");
}

/// Wake: a node that needs help wakes a sleeper, and the sleeper offers to that node first.
#[test]
fn wake_node_in_need_wakes_a_sleeper() {
    let remedies = [Remedy::Speed, Remedy::Wake];
    let (mut busy, _) = TestNode::with_band(&remedies, 0..2);
    busy.trace(0..1, MS);
    assert_eq!(busy.offer(1.0, Duration::ZERO, None), [], "the node remembers the sleeper");
    let actions = busy.message(Party::Node(3), Message::Transfer(vec![50..90]));
    assert!(actions.contains(&send(Party::Node(2), Message::Wake)), "{actions:?}");
    assert!(atoms_sent(&busy.offer(1.0, Duration::ZERO, Some(3))) > 15);

    let (mut sleeper, _) = TestNode::with_band(&remedies, 0..1);
    let actions = sleeper.trace(0..1, MS);
    let Some(Action::Send { message: back @ Message::Offer { .. }, .. }) = actions.first() else {
        panic!("{actions:?} has no offer")
    };
    let actions = sleeper.message(Party::Node(2), back.clone());
    assert!(actions.contains(&Action::Retire));
    assert_eq!(offers(&actions).len(), 3, "it announces its sleep to all");
    assert_eq!(offers(&sleeper.message(Party::Node(3), Message::Wake)), [Party::Node(3)]);
    assert_eq!(sleeper.message(Party::Node(0), Message::Wake), [], "its offer is already under way");
}

/// Copies: a sleeper traces an atom too that has been in the pipe for too long, once.
#[test]
fn copies_sleeper_traces_a_late_atom_too() {
    let (mut late, _) = TestNode::with_band(&[Remedy::Speed, Remedy::Wake, Remedy::Copies], 0..4);
    late.trace(0..3, MS);
    assert_eq!(late.offer(1.0, Duration::ZERO, None), [], "the atom is not late yet");
    late.now += 3 * MS;
    assert_eq!(late.event(Event::Timer), [send(Party::Node(2), Message::Wake)]);
    let again = send(Party::Node(2), Message::Again(vec![3..4]));
    assert_eq!(late.offer(1.0, Duration::ZERO, Some(3)), [again]);
    late.now += 30 * MS;
    assert_eq!(late.event(Event::Timer), [send(Party::Parent, Message::Results(vec![0..3]))], "only one copy");
}

/// Leases: a node lists its atoms at every beat. A silent node counts as gone, and its atoms go to an idle node.
#[test]
fn leases_atoms_of_a_silent_node_are_given_out_again() {
    let division = Division::new(100, 1);
    let rules = rules(with(&[Remedy::Leases]));
    let mut parent = Parent::new(&rules, division, NODES);
    let mut deliver = |ms: u32, event: Event| {
        let mut actions = Vec::new();
        parent.handle(at(ms), event, &mut actions);
        actions.retain(|action| !matches!(action, Action::SetTimer(_)));
        actions
    };
    let beat = |node: NodeId, holds: Vec<Range<Atom>>, ms: u32| {
        let message = Message::Beat { idle: holds.is_empty(), holds, sent: at(ms) };
        Event::Message { from: Party::Node(node), message }
    };
    assert_eq!(deliver(0, Event::Started).len(), 4);
    (0..4).for_each(|node| {
        assert_eq!(deliver(0, beat(node, vec![u32::from(node) * 25..u32::from(node) * 25 + 25], 0)), [])
    });
    assert_eq!(deliver(50, Event::Message { from: Party::Node(0), message: Message::Results(vec![0..25]) }), []);
    // Node 0 is idle, and node 3 is silent.
    for ms in [60, 120, 180, 240] {
        assert_eq!(deliver(ms, beat(0, Vec::new(), ms)), []);
        assert_eq!(deliver(ms, beat(1, vec![25..50], ms)), []);
        assert_eq!(deliver(ms, beat(2, vec![50..75], ms)), []);
        assert_eq!(deliver(ms, Event::Timer), [], "a lease is four beats");
    }
    let gone = |node| send(Party::Node(node), Message::Gone(vec![3]));
    let again = send(Party::Node(0), Message::Again(vec![75..100]));
    assert_eq!(deliver(300, Event::Timer), [gone(0), gone(1), gone(2), again]);
    assert_eq!(deliver(310, beat(0, vec![75..100], 310)), [], "now node 0 has them");
    let back = |node| send(Party::Node(node), Message::Gone(Vec::new()));
    assert_eq!(deliver(320, beat(3, vec![75..100], 320)), [0, 1, 2, 3].map(back));
}

/// Leases: the first result counts, and a node that still has the atom drops it.
#[test]
fn leases_first_result_counts() {
    let mut parent = Parent::new(&rules(with(&[Remedy::Leases])), Division::new(100, 1), NODES);
    let mut deliver = |message| {
        let mut actions = Vec::new();
        parent.handle(at(1), Event::Message { from: Party::Node(2), message }, &mut actions);
        actions
    };
    assert_eq!(deliver(Message::Results(vec![7..9])), []);
    assert_eq!(deliver(Message::Results(vec![7..9])), [], "the same results again");
    let beat = Message::Beat { holds: vec![5..10], idle: false, sent: at(0) };
    assert_eq!(deliver(beat), [send(Party::Node(2), Message::Placed(vec![7..9]))]);
    let (mut node, _) = TestNode::with_band(&[], 5..10);
    assert_eq!(node.message(Party::Parent, Message::Placed(vec![7..9])), []);
    assert_eq!(node.trace(5..6, MS), [Action::Trace(9)]);
    assert_eq!(node.trace(6..7, MS), []);
}

/// Leases: an atom that a worker cannot trace is tried on another node; the third failure ends the run.
#[test]
fn leases_atom_that_fails_three_times_fails_the_run() {
    let (mut node, _) = TestNode::with_band(&[Remedy::Leases], 0..4);
    let actions = node.event(Event::AtomFailed { atom: 0 });
    assert!(actions.contains(&send(Party::Parent, Message::Failed(0))) && actions.contains(&Action::Trace(2)));

    let mut parent = Parent::new(&rules(with(&[Remedy::Leases])), Division::new(100, 1), NODES);
    parent.handle(at(0), Event::Started, &mut Vec::new());
    let mut deliver = |node: NodeId, message| {
        let mut actions = Vec::new();
        parent.handle(at(1), Event::Message { from: Party::Node(node), message }, &mut actions);
        actions
    };
    let idle = || Message::Beat { holds: Vec::new(), idle: true, sent: at(1) };
    assert_eq!(deliver(3, idle()), []);
    assert_eq!(deliver(1, Message::Failed(40)), [send(Party::Node(3), Message::Again(vec![40..41]))]);
    assert_eq!(deliver(3, Message::Failed(40)), []);
    assert_eq!(deliver(2, idle()), [send(Party::Node(2), Message::Again(vec![40..41]))]);
    assert_eq!(deliver(2, Message::Failed(40)), [Action::Fail(40)]);
}

/// Leases: a restarted machine asks to be let in, and offers help.
#[test]
fn leases_restarted_machine_is_let_in() {
    let mut node = TestNode { node: Node::new(&rules(Remedies::ALL), 1, NODES), now: at(500) };
    assert_eq!(node.event(Event::Started), [send(Party::Parent, Message::Request)]);
    node.now = at(500 + 4 * 60);
    assert_eq!(node.event(Event::Timer), [send(Party::Parent, Message::Request)], "the first request may be lost");
    assert_eq!(offers(&node.message(Party::Parent, Message::Band(0..0))), [Party::Node(0)]);
    assert_eq!(node.message(Party::Parent, Message::Band(0..0)), [], "the second answer changes nothing");
}

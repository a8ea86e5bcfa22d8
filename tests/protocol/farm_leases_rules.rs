//! The rules of the farm with leases, one by one, by the numbers of its README: its nodes and its parent by themselves.

#![expect(clippy::single_range_in_vec_init, reason = "messages hold ranges")]

use std::ops::Range;
use std::time::Duration;

use anel::balance::{Action, Event, Message, Node, NodeId, Parent, Party, Rules, Strategy};
use anel::picture::{Atom, Division};
use anel::time::Time;

const MS: Duration = Duration::from_millis(1);
/// Atoms in a part.
const PART: u32 = 10;

fn rules() -> Rules {
    Rules { part: PART, ..Rules::usual(Strategy::FarmLeases, Division::new(100, 1), 3) }
}

fn at(ms: u32) -> Time {
    Time::ZERO + ms * MS
}

fn to(node: NodeId, message: Message) -> Action {
    Action::Send { to: Party::Node(node), message }
}

fn to_parent(message: Message) -> Action {
    Action::Send { to: Party::Parent, message }
}

fn again(atoms: Range<Atom>) -> Message {
    Message::Again(vec![atoms])
}

/// The parent of three nodes, driven by hand.
struct TestParent(Parent);

impl TestParent {
    /// The parent of a picture of `atoms` atoms that has given the bands away.
    fn started(atoms: Atom) -> Self {
        let mut parent = Self(Parent::new(&rules(), Division::new(atoms, 1), 3));
        parent.event(0, Event::Started);
        parent
    }

    fn event(&mut self, ms: u32, event: Event) -> Vec<Action> {
        let mut actions = Vec::new();
        self.0.handle(at(ms), event, &mut actions);
        actions.retain(|action| !matches!(action, Action::SetTimer(_)));
        actions
    }

    fn message(&mut self, ms: u32, node: NodeId, message: Message) -> Vec<Action> {
        self.event(ms, Event::Message { from: Party::Node(node), message })
    }

    fn request(&mut self, ms: u32, node: NodeId) -> Vec<Action> {
        self.message(ms, node, Message::Request)
    }

    fn beat(&mut self, ms: u32, node: NodeId, holds: &[Range<Atom>]) -> Vec<Action> {
        let message = Message::Beat { holds: holds.to_vec(), idle: holds.is_empty(), sent: at(ms) };
        self.message(ms, node, message)
    }

    fn timer(&mut self, ms: u32) -> Vec<Action> {
        self.event(ms, Event::Timer)
    }
}

/// A node, driven by hand.
struct TestNode(Node);

impl TestNode {
    fn new() -> Self {
        Self(Node::new(&rules(), 1, 3))
    }

    fn event(&mut self, ms: u32, event: Event) -> Vec<Action> {
        let mut actions = Vec::new();
        self.0.handle(at(ms), event, &mut actions);
        actions.retain(|action| !matches!(action, Action::SetTimer(_)));
        actions
    }

    fn message(&mut self, ms: u32, message: Message) -> Vec<Action> {
        self.event(ms, Event::Message { from: Party::Parent, message })
    }

    fn done(&mut self, ms: u32, atom: Atom) -> Vec<Action> {
        self.event(ms, Event::AtomDone { atom, cost: MS })
    }
}

#[test]
fn rule_1_each_node_begins_with_a_part_and_a_spare_with_none() {
    let mut parent = TestParent(Parent::with_spares(&rules(), Division::new(100, 1), 3, 1));
    let bands = [to(0, Message::Band(0..10)), to(1, Message::Band(10..20))];
    assert_eq!(parent.event(0, Event::Started), bands);
}

#[test]
fn rule_2_a_node_without_atoms_sends_its_results_and_asks() {
    let mut node = TestNode::new();
    assert_eq!(node.message(0, Message::Band(0..1)), [Action::Trace(0)]);
    let expected = [to_parent(Message::Results(vec![0..1])), to_parent(Message::Request)];
    assert_eq!(node.done(1, 0), expected);
    assert_eq!(node.message(2, Message::Part(0..0)), [Action::Retire]);
    assert_eq!(node.message(3, again(7..8)), [Action::Trace(7)], "it is called back");
}

#[test]
fn rule_2_the_answer_is_a_fresh_part_or_else_nothing() {
    let mut parent = TestParent::started(35);
    assert_eq!(parent.request(1, 0), [to(0, Message::Part(30..35))]);
    assert_eq!(parent.request(2, 1), [to(1, Message::Part(0..0))]);
}

#[test]
fn rule_3_lost_atoms_are_given_out_after_the_fresh_ones() {
    let mut parent = TestParent::started(40);
    // Nodes 1 and 2 are silent for a lease, four beats of 60 ms.
    assert_eq!(parent.request(300, 0), [to(0, Message::Part(30..40))]);
    assert_eq!(parent.request(301, 0), [to(0, again(0..10))], "its first results were lost too");
    assert_eq!(parent.request(302, 0), [to(0, again(10..20))]);
}

#[test]
fn rule_3_a_beat_renews_the_leases_on_the_atoms_that_it_lists() {
    let mut parent = TestParent::started(30);
    parent.message(1, 0, Message::Results(vec![0..10]));
    for ms in [200, 400, 600] {
        assert_eq!(parent.beat(ms, 1, &[10..20]), []);
    }
    assert_eq!(parent.request(601, 0), [to(0, again(20..30))], "node 2 has never said that it holds its atoms");
    parent.message(700, 0, Message::Results(vec![20..30]));
    assert_eq!(parent.request(840, 0), [to(0, Message::Part(0..0))]);
    assert_eq!(parent.timer(841), [to(0, again(10..20))], "a lease is four beats");
}

#[test]
fn rule_4_waiting_nodes_get_equal_numbers_of_lost_atoms() {
    let mut parent = TestParent::started(30);
    (0..2).for_each(|node| {
        let first = u32::from(node) * 10;
        parent.message(1, node, Message::Results(vec![first..first + 10]));
        assert_eq!(parent.request(2, node), [to(node, Message::Part(0..0))]);
    });
    parent.message(3, 2, Message::Results(vec![20..23]));
    assert_eq!(parent.timer(240), []);
    assert_eq!(parent.timer(300), [to(0, again(23..27)), to(1, again(27..30))]);
    assert_eq!(parent.timer(360), [], "they have been given out");
}

#[test]
fn rule_5_an_idle_beat_is_a_request_unless_atoms_may_be_on_their_way() {
    let mut parent = TestParent::started(60);
    assert_eq!(parent.beat(100, 0, &[]), [], "its band may be on its way");
    assert_eq!(parent.beat(241, 0, &[]), [to(0, Message::Part(30..40))], "the band must be lost");
    assert_eq!(parent.beat(301, 0, &[]), []);
    assert_eq!(parent.beat(302, 0, &[30..40]), [], "the part has come");
    assert_eq!(parent.beat(362, 0, &[]), [to(0, Message::Part(40..50))], "so this one is true");
}

#[test]
fn rule_6_the_first_result_counts_and_others_drop_the_atom() {
    let mut parent = TestParent::started(20);
    parent.request(300, 1);
    assert_eq!(parent.message(301, 0, Message::Results(vec![0..10])), [], "it is late, but the first");
    assert_eq!(parent.message(302, 1, Message::Results(vec![0..4])), [], "these are too late");
    assert_eq!(parent.beat(303, 1, &[4..10]), [to(1, Message::Placed(vec![4..10]))]);
    let mut node = TestNode::new();
    node.message(0, Message::Band(4..10));
    assert_eq!(node.message(1, Message::Placed(vec![4..9])), []);
    assert_eq!(node.done(2, 4), [Action::Trace(9)], "two atoms were in the pipe, and one is left");
}

#[test]
fn rule_7_a_node_that_starts_afresh_asks_for_the_scene_until_it_comes() {
    let mut node = TestNode::new();
    assert_eq!(node.event(500, Event::Started), [to_parent(Message::Join)]);
    assert_eq!(node.event(739, Event::Timer), []);
    assert_eq!(node.event(740, Event::Timer), [to_parent(Message::Join)]);
    assert_eq!(node.message(750, Message::Band(30..31)), [Action::Trace(30)]);
    assert_eq!(node.message(751, Message::Band(0..0)), [], "a repeated band is not answered");
    let mut parent = TestParent::started(50);
    assert_eq!(parent.message(300, 2, Message::Join), [to(2, Message::Band(30..40))]);
    assert_eq!(parent.message(301, 2, Message::Join), [to(2, Message::Band(0..0))], "one part is on its way");
}

#[test]
fn rule_7_a_band_is_repeated_to_a_silent_node_after_growing_pauses() {
    let mut parent = TestParent::started(30);
    parent.beat(60, 0, &[0..10]);
    parent.beat(60, 1, &[10..20]);
    let band = [to(2, Message::Band(0..0))];
    let repeated: Vec<u32> = (1..200).map(|beat| beat * 60).filter(|&ms| parent.timer(ms) == band).collect();
    assert_eq!(repeated, [960, 2880, 6720], "pauses of 16, 32 and 64 beats");
}

#[test]
fn rule_8_a_stuck_worker_vouches_for_nothing() {
    let mut node = TestNode::new();
    node.message(0, Message::Band(0..3));
    let holds = |actions: Vec<Action>| match &actions[..] {
        [Action::Send { message: Message::Beat { holds, idle: false, .. }, .. }] => holds.clone(),
        other => panic!("{other:?} is no beat"),
    };
    assert_eq!(holds(node.event(60, Event::Timer)), [0..3]);
    assert_eq!(holds(node.event(16 * 240, Event::Timer)), [0..3]);
    assert_eq!(holds(node.event(16 * 240 + 60, Event::Timer)), []);
}

#[test]
fn rule_9_an_atom_that_fails_three_times_fails_the_run() {
    let mut node = TestNode::new();
    node.message(0, Message::Band(0..1));
    let failed = node.event(1, Event::AtomFailed { atom: 0 });
    assert_eq!(failed, [to_parent(Message::Failed(0)), to_parent(Message::Request)]);
    let mut parent = TestParent::started(30);
    assert_eq!(parent.request(1, 2), [to(2, Message::Part(0..0))]);
    assert_eq!(parent.message(2, 0, Message::Failed(4)), [to(2, again(4..5))]);
    assert_eq!(parent.message(3, 2, Message::Failed(4)), []);
    assert_eq!(parent.request(3, 2), [to(2, again(4..5))]);
    assert_eq!(parent.message(4, 2, Message::Failed(4)), [Action::Fail(4)]);
}

//! The rules of the ring's rivals (§6), one by one: parent and nodes by themselves, and whole runs in virtual time.

#![expect(clippy::single_range_in_vec_init, reason = "messages hold ranges")]

use std::ops::Range;
use std::time::Duration;

use anel::balance::{Action, Event, Message, Node, NodeId, Parent, Party, Rules, Strategy, estimate};
use anel::picture::{Atom, Division, Size};
use anel::record::RecordKind;
use anel::runlog::{Header, Metrics, RunLog};
use anel::time::Time;
use proptest::prelude::*;

use crate::virtual_time;

const MS: Duration = Duration::from_millis(1);

fn rules(strategy: Strategy, part: u32) -> Rules {
    Rules { part, batch: None, ..Rules::usual(strategy, Division::new(100, 1), 4) }
}

/// A parent, driven by hand.
struct TestParent(Parent);

impl TestParent {
    fn started(strategy: Strategy, part: u32, atoms: u32, nodes: NodeId) -> (Self, Vec<Action>) {
        let mut parent = Self(Parent::new(&rules(strategy, part), Division::new(atoms, 1), nodes));
        let actions = parent.event(Time::ZERO, Event::Started);
        (parent, actions)
    }

    fn event(&mut self, now: Time, event: Event) -> Vec<Action> {
        let mut actions = Vec::new();
        self.0.handle(now, event, &mut actions);
        actions
    }

    /// Delivers a request of this node. Returns the part in the answer.
    fn request(&mut self, node: NodeId) -> Range<Atom> {
        let event = Event::Message { from: Party::Node(node), message: Message::Request };
        match &self.event(Time::ZERO, event)[..] {
            [Action::Send { to, message: Message::Part(part) }] if *to == Party::Node(node) => part.clone(),
            other => panic!("{other:?} is not a part for node {node}"),
        }
    }
}

fn bands(actions: &[Action]) -> Vec<Range<Atom>> {
    let band = |action: &Action| match action {
        Action::Send { message: Message::Band(band), .. } => band.clone(),
        other => panic!("{other:?} is not a band"),
    };
    actions.iter().map(band).collect()
}

fn to_parent(message: Message) -> Action {
    Action::Send { to: Party::Parent, message }
}

/// Delivers a message to a node. Returns its actions.
fn deliver(node: &mut Node, message: Message) -> Vec<Action> {
    let mut actions = Vec::new();
    node.handle(Time::ZERO, Event::Message { from: Party::Parent, message }, &mut actions);
    actions
}

/// Reports these atoms as traced. Returns the actions after the last.
fn traced(node: &mut Node, atoms: Range<Atom>) -> Vec<Action> {
    let mut actions = Vec::new();
    for atom in atoms {
        actions.clear();
        node.handle(Time::ZERO, Event::AtomDone { atom, cost: MS }, &mut actions);
    }
    actions
}

/// §6.2: the picture has more parts than there are nodes; each node gets one part with the scene.
#[test]
fn farm_every_node_begins_with_one_part() {
    let (_, actions) = TestParent::started(Strategy::Farm, 7, 30, 3);
    assert_eq!(bands(&actions), [0..7, 7..14, 14..21]);
}

/// §6.2: a node that has finished its part sends its results and asks for another part.
#[test]
fn farm_a_free_node_sends_its_results_and_asks() {
    let mut node = Node::new(&rules(Strategy::Farm, 3), 1, 4);
    assert_eq!(deliver(&mut node, Message::Band(3..6)), [Action::Trace(3), Action::Trace(4)]);
    assert_eq!(traced(&mut node, 3..5), [], "one atom is left");
    let expected = [to_parent(Message::Results(vec![3..6])), to_parent(Message::Request)];
    assert_eq!(traced(&mut node, 5..6), expected);
    assert_eq!(deliver(&mut node, Message::Part(20..21)), [Action::Trace(20)]);
}

/// §6.2: the node gets another part, or a message that it is no longer needed.
#[test]
fn farm_the_parent_answers_with_the_next_part_or_with_an_empty_one() {
    let (mut parent, _) = TestParent::started(Strategy::Farm, 4, 13, 2);
    let parts = [0, 1, 0, 0].map(|node| parent.request(node));
    assert_eq!(parts, [8..12, 12..13, 13..13, 13..13]);
    let mut node = Node::new(&rules(Strategy::Farm, 4), 0, 2);
    assert_eq!(deliver(&mut node, Message::Part(13..13)), [Action::Retire]);
    assert_eq!(deliver(&mut node, Message::Shutdown), [Action::Finish]);
}

/// *Ours:* with fewer parts than nodes some nodes start without one, and ask at once.
#[test]
fn farm_a_node_without_a_first_part_asks_at_once() {
    let (_, actions) = TestParent::started(Strategy::Farm, 4, 5, 3);
    assert_eq!(bands(&actions), [0..4, 4..5, 5..5]);
    let mut node = Node::new(&rules(Strategy::Farm, 4), 2, 3);
    assert_eq!(deliver(&mut node, Message::Band(5..5)), [to_parent(Message::Request)]);
}

/// §6.2: the requests show which machines are slow; those get smaller parts.
#[test]
fn farm_by_speed_gives_slow_nodes_smaller_parts() {
    let (mut parent, actions) = TestParent::started(Strategy::FarmBySpeed, 40, 100_000, 2);
    assert_eq!(bands(&actions), [0..40, 40..80], "no speed is known yet");
    for _ in 0..4 {
        assert_eq!(parent.request(0).len(), 40);
    }
    assert_eq!(parent.request(1).len(), 10, "it has traced one part, the other node four");
    (0..400).for_each(|_| _ = parent.request(0));
    assert_eq!(parent.request(1).len(), 1, "at least one atom");
}

/// *Ours:* waiting for a busy parent does not make a node slow: where all nodes wait alike, parts do not shrink.
#[test]
fn farm_by_speed_does_not_mistake_a_busy_parent_for_slow_nodes() {
    let plain = Header::plain(Size::new(400, 10).unwrap(), 1, Strategy::FarmBySpeed, vec![1.0; 4]);
    let header = Header { handling: 100 * MS, ..plain };
    let log = virtual_time::run(&header, &[], |_| 0.001);
    let requests = Metrics::of(&log).messages().requests;
    assert!(requests <= 4000 / u64::from(header.rules.part) + 8, "{requests}");
}

/// §6.1: the picture is divided by the number of nodes; there is no balancing.
#[test]
fn static_bands_are_equal_and_no_node_asks_or_offers() {
    let (_, actions) = TestParent::started(Strategy::Static, 1, 10, 3);
    assert_eq!(bands(&actions), [0..4, 4..7, 7..10]);
    let mut node = Node::new(&rules(Strategy::Static, 1), 0, 3);
    deliver(&mut node, Message::Band(0..4));
    assert_eq!(traced(&mut node, 0..4), [to_parent(Message::Results(vec![0..4]))]);
}

/// §6.1: an estimate of the picture's cost, which itself takes time, makes bands of equal cost.
#[test]
fn estimate_comes_before_the_bands_and_makes_costly_ones_narrow() {
    let division = Division::new(20_000, 10);
    let mut parent = TestParent(Parent::new(&rules(Strategy::StaticEstimate, 1), division, 2));
    assert_eq!(parent.event(Time::ZERO, Event::Started), [Action::Estimate]);
    let stretches = estimate::samples(division).len();
    // The upper half of the picture costs three times as much.
    let costs = (0..stretches).map(|stretch| MS * if stretch < stretches / 2 { 3 } else { 1 }).collect();
    let bands = bands(&parent.event(Time::from_secs(1.0), Event::Estimated(costs)));
    assert_eq!((bands[0].start, bands[1].end), (0, 2000));
    assert!(bands[0].end.abs_diff(667) < 40, "{bands:?}");
}

/// Executes a run of 4,000 atoms on nodes of these speeds; the atoms of the first quarter cost four times as much.
fn run(strategy: Strategy, speeds: &[f64]) -> RunLog {
    let header = Header::plain(Size::new(400, 10).unwrap(), 1, strategy, speeds.to_vec());
    virtual_time::run(&header, &[], |atom| if atom < 1000 { 0.004 } else { 0.001 })
}

fn makespan(log: &RunLog) -> f64 {
    Metrics::of(log).makespan().unwrap().as_secs_f64()
}

/// §6.1: "the time of the algorithm is that of the slowest machine".
#[test]
fn static_bands_wait_for_the_slowest_machine() {
    let slow = makespan(&run(Strategy::Static, &[1.0, 1.0, 1.0, 0.1]));
    // The last band's thousand atoms of 1 ms at a tenth of the speed.
    assert!((slow - 10.0).abs() < 0.01, "{slow}");
    assert!(makespan(&run(Strategy::Ring, &[1.0, 1.0, 1.0, 0.1])) < 0.3 * slow);
}

/// §6.1: a good estimate is better than none, and its own time counts.
#[test]
fn estimate_helps_where_costs_are_uneven_and_its_time_counts() {
    let speeds = [1.0; 4];
    let (plain, estimated) = (run(Strategy::Static, &speeds), run(Strategy::StaticEstimate, &speeds));
    assert!(makespan(&estimated) < 0.6 * makespan(&plain));
    let at = |kind: fn(&RecordKind) -> bool| estimated.records().iter().find(|record| kind(&record.kind)).unwrap().at;
    let begun = at(|kind| *kind == RecordKind::Estimating);
    let bands = at(|kind| matches!(kind, RecordKind::Sent { message: Message::Band(_), .. }));
    let sampled = estimate::samples(estimated.header.division).flatten();
    let costs: f64 = sampled.map(|pixel| if pixel < 1000 { 0.004 } else { 0.001 }).sum();
    assert!((bands.since(begun).as_secs_f64() - costs).abs() < 1e-6);
    assert!(Metrics::of(&estimated).ideal().unwrap().as_secs_f64() < 1.751, "the estimate is not counted as work");
}

proptest! {
    /// §6.2: a request is answered with atoms while there are any, in order, and each atom is given once.
    #[test]
    fn farm_parts_are_consecutive_and_end(
        atoms in 1u32..2000, part in 0u32..300, by_speed in any::<bool>(),
        requests in prop::collection::vec(0u16..5, 1..60),
    ) {
        let strategy = if by_speed { Strategy::FarmBySpeed } else { Strategy::Farm };
        let (mut parent, actions) = TestParent::started(strategy, part, atoms, 5);
        let mut next = 0;
        let mut check = |given: &Range<Atom>| {
            assert_eq!(given.start, next);
            assert!(given.len() as u32 <= part.max(1) && (given.end == atoms || !given.is_empty()));
            next = given.end;
        };
        bands(&actions).iter().for_each(&mut check);
        for node in requests {
            check(&parent.request(node));
        }
    }
}

//! The article's rules, one by one, on the parent and the nodes by themselves: no threads, no clock.

#![expect(clippy::single_range_in_vec_init, reason = "messages hold ranges")]

use std::ops::Range;
use std::time::Duration;

use anel::balance::{Action, Event, Message, Node, NodeId, Parent, Party, Rules, Strategy};
use anel::picture::{Atom, Division, Size};
use anel::record::RecordKind;
use anel::runlog::{Header, LinkSettings, Metrics, RunLog};
use anel::time::Time;
use proptest::prelude::*;

use crate::virtual_time;

const MS: Duration = Duration::from_millis(1);

/// The ring's rules, with transfers of at least `part` atoms.
fn rules(part: u32) -> Rules {
    Rules { part, ..Rules::usual(Strategy::Ring, Division::new(100, 1), 4) }
}

fn started(nodes: NodeId, division: Division) -> (Parent, Vec<Range<Atom>>) {
    let mut parent = Parent::new(&rules(1), division, nodes);
    let mut actions = Vec::new();
    parent.handle(Time::ZERO, Event::Started, &mut actions);
    let bands = actions.into_iter().enumerate().map(|(node, action)| match action {
        Action::Send { to, message: Message::Band(band) } if to == Party::Node(node as NodeId) => band,
        other => panic!("{other:?} is not a band for node {node}"),
    });
    (parent, bands.collect())
}

/// A node of the ring, driven by hand at time 0.
struct TestNode(Node);

impl TestNode {
    /// Node `id` of `nodes` with this band, and its actions.
    fn with_band(id: NodeId, nodes: NodeId, band: Range<Atom>) -> (Self, Vec<Action>) {
        let mut node = Self(Node::new(&rules(1), id, nodes));
        let actions = node.message(Message::Band(band));
        (node, actions)
    }

    fn event(&mut self, event: Event) -> Vec<Action> {
        let mut actions = Vec::new();
        self.0.handle(Time::ZERO, event, &mut actions);
        actions
    }

    fn message(&mut self, message: Message) -> Vec<Action> {
        self.event(Event::Message { from: Party::Parent, message })
    }

    fn offer(&mut self, who: NodeId, done: u32) -> Vec<Action> {
        self.message(Message::offer(who, done))
    }

    /// Reports these atoms as traced. Returns the actions after the last.
    fn traced(&mut self, atoms: Range<Atom>) -> Vec<Action> {
        atoms.map(|atom| self.event(Event::AtomDone { atom, cost: MS })).last().unwrap_or_default()
    }
}

fn send(to: NodeId, message: Message) -> Action {
    Action::Send { to: Party::Node(to), message }
}

fn send_offer(to: NodeId, who: NodeId, done: u32) -> Action {
    send(to, Message::offer(who, done))
}

fn results(ranges: &[Range<Atom>]) -> Action {
    Action::Send { to: Party::Parent, message: Message::Results(ranges.to_vec()) }
}

proptest! {
    /// §7: the picture is divided exactly among the machines. *Ours:* with too few atoms some bands are empty.
    #[test]
    fn r1_bands_are_consecutive_and_differ_by_at_most_one_atom(
        nodes in 1..50u16, pixels in 1..5000u32, atom in 1..100u32,
    ) {
        let division = Division::new(pixels, atom);
        let (_, bands) = started(nodes, division);
        prop_assert_eq!(bands.len(), usize::from(nodes));
        let (shortest, longest) = (bands.iter().map(Range::len).min(), bands.iter().map(Range::len).max());
        prop_assert!(longest <= shortest.map(|shortest| shortest + 1));
        prop_assert!(bands.into_iter().flatten().eq(0..division.atoms()));
    }

    /// §7: a band consists of equal atoms; only the picture's last one may be shorter.
    #[test]
    fn r2_atoms_are_equal_and_hold_each_pixel_once(pixels in 1..5000u32, size in 1..100u32) {
        let division = Division::new(pixels, size);
        let atoms: Vec<_> = (0..division.atoms()).map(|atom| division.pixels(atom)).collect();
        let (last, others) = atoms.split_last().unwrap();
        prop_assert!(others.iter().all(|atom| atom.len() == size as usize));
        prop_assert!((1..=size as usize).contains(&last.len()));
        prop_assert!(atoms.into_iter().flatten().eq(0..pixels));
    }
}

/// §7. *Ours:* a node with an empty band offers at once.
#[test]
fn r1_a_node_with_an_empty_band_offers_with_none_done() {
    let (_, actions) = TestNode::with_band(3, 5, 2..2);
    assert_eq!(actions, [send_offer(2, 3, 0)]);
}

/// §8: the pipe holds some atoms, at least two so that the worker never waits.
#[test]
fn r3_the_pipe_holds_two_atoms_while_there_are_any() {
    let (mut node, actions) = TestNode::with_band(0, 2, 0..5);
    assert_eq!(actions, [Action::Trace(0), Action::Trace(1)]);
    let mut in_pipe = 2;
    for atom in 0..5 {
        let actions = node.traced(atom..atom + 1);
        in_pipe += actions.iter().filter(|action| matches!(action, Action::Trace(_))).count();
        in_pipe -= 1;
        assert_eq!(in_pipe, 2.min(4 - atom as usize));
    }
    let (_, actions) = TestNode::with_band(0, 2, 0..1);
    assert_eq!(actions, [Action::Trace(0)]);
}

/// §7: after each atom the node counts it, keeps its pixels and queues one more.
#[test]
fn r4_an_atom_done_is_counted_kept_and_replaced() {
    let (mut node, _) = TestNode::with_band(1, 2, 10..13);
    assert!(node.traced(10..11).contains(&Action::Trace(12)));
    // The offer counts three atoms, and the results hold them in order.
    assert_eq!(node.traced(11..13), [send_offer(0, 1, 3), results(&[10..13])]);
}

/// §8: at its last atom the node offers help to its left and sends the parent its results, and does so again after
/// the atoms of a transfer.
#[test]
fn r5_node_without_atoms_offers_first_and_then_sends_results() {
    let (mut node, _) = TestNode::with_band(0, 4, 0..2);
    assert_eq!(node.traced(0..2), [send_offer(3, 0, 2), results(&[0..2])]);
    let actions = node.message(Message::Transfer(vec![7..9]));
    assert_eq!(actions, [Action::Trace(7), Action::Trace(8)]);
    assert_eq!(node.traced(7..9), [send_offer(3, 0, 4), results(&[7..9])]);
}

/// §8. *Ours:* results also stream in small batches, and each atom is in one of them.
#[test]
fn r5_results_stream_while_the_node_works() {
    let (mut node, _) = TestNode::with_band(0, 2, 0..9);
    assert!(node.traced(0..1).contains(&Action::SetTimer(Time::ZERO + 15 * MS)));
    let second = node.traced(1..2);
    assert!(!second.iter().any(|action| matches!(action, Action::SetTimer(_))), "the batch has its timer");
    assert_eq!(node.event(Event::Timer), [results(&[0..2])]);
    assert_eq!(node.event(Event::Timer), [], "nothing is sent twice");
    assert!(node.traced(2..3).iter().any(|action| matches!(action, Action::SetTimer(_))));
}

/// §8: between two offers of a node lies a transfer to it. (`virtual_time` checks in every run that a node never has
/// two offers under way.)
#[test]
fn r5_node_offers_again_only_after_a_transfer() {
    let log = run_of_1000_atoms(&[1.0, 0.05, 0.3, 0.6], Duration::ZERO);
    for node in 0..4 {
        let sequence = log.records().iter().filter_map(|record| match &record.kind {
            RecordKind::Sent { from, message: Message::Offer { who, .. }, .. }
                if *who == node && *from == Party::Node(node) =>
            {
                Some("offer")
            }
            RecordKind::Received { .. } | RecordKind::AtomStarted { .. } => None,
            RecordKind::Sent { to, message: Message::Transfer(_), .. } if *to == Party::Node(node) => Some("transfer"),
            _ => None,
        });
        let sequence: Vec<_> = sequence.collect();
        assert!(sequence.len() > 1 && sequence.iter().step_by(2).all(|what| *what == "offer"), "{sequence:?}");
        assert!(sequence.iter().skip(1).step_by(2).all(|what| *what == "transfer"), "{sequence:?}");
    }
}

/// §8: the node that takes a worthwhile offer does not pass it on, and sends its atoms straight to the offerer.
#[test]
fn r6_a_worthwhile_offer_is_taken_and_not_passed_on() {
    let (mut node, _) = TestNode::with_band(1, 5, 0..12);
    // Ten atoms wait behind the pipe, and neither node has traced any: the share is half.
    assert_eq!(node.offer(4, 0), [send(4, Message::Transfer(vec![7..12]))]);
    // The five atoms have left the queue: the node runs out after the other seven.
    assert_eq!(node.traced(0..7), [send_offer(0, 1, 7), results(&[0..7])]);
}

/// §8: an offer that is not worth a share is passed on unchanged.
#[test]
fn r6_an_offer_not_worth_a_share_is_passed_on_unchanged() {
    let (mut node, _) = TestNode::with_band(1, 5, 0..2);
    assert_eq!(node.offer(4, 99), [send_offer(0, 4, 99)], "both atoms are already in the pipe");
    let mut strict = TestNode(Node::new(&rules(6), 1, 5));
    strict.message(Message::Band(0..12));
    assert_eq!(strict.offer(4, 0), [send_offer(0, 4, 0)], "a share of five atoms is less than the least part, six");
}

/// §8: the article's child first waits for its part. *Ours:* offers that arrive earlier are answered after it.
#[test]
fn r6_offers_before_the_band_are_answered_after_it() {
    let mut node = TestNode(Node::new(&rules(1), 0, 3));
    assert_eq!((node.offer(1, 4), node.offer(2, 0)), (vec![], vec![]));
    let actions = node.message(Message::Band(0..8));
    assert_eq!(actions[2..], [send(1, Message::Transfer(vec![2..8])), send_offer(2, 2, 0)]);
}

/// §7: the share is proportional to the atoms that both nodes have traced, from the back of the queue.
#[test]
fn r7_a_fast_offerer_gets_many_and_a_slow_one_few() {
    let shared = |done| {
        let (mut node, _) = TestNode::with_band(0, 3, 0..110);
        node.traced(0..8);
        // A hundred atoms wait.
        node.offer(2, done)
    };
    assert_eq!(shared(72), [send(2, Message::Transfer(vec![20..110]))]);
    assert_eq!(shared(8), [send(2, Message::Transfer(vec![60..110]))]);
    assert_eq!(shared(2), [send(2, Message::Transfer(vec![90..110]))]);
    assert_eq!(shared(0), [send(2, Message::Transfer(vec![109..110]))]);
}

/// §7: shares let all nodes end at the same time, within a few atoms of the slowest.
#[test]
fn r7_nodes_of_any_speed_end_together() {
    for speeds in [&[1.0, 1.0][..], &[1.0, 0.1], &[0.1, 1.0, 1.0, 1.0, 1.0], &[0.7, 0.01, 0.3, 1.0]] {
        let slowest = speeds.iter().copied().fold(1.0, f64::min);
        let spread = Metrics::of(&run_of_1000_atoms(speeds, Duration::ZERO)).finish_spread();
        assert!(spread <= 3 * COST.div_f64(slowest), "{speeds:?}: {spread:?}");
    }
}

/// §7: a node whose own offer returns is no longer needed. §8: it passes on messages until the shutdown.
#[test]
fn r8_offer_returns_to_sender_retires_node_which_still_passes_on_others() {
    let (mut node, _) = TestNode::with_band(2, 3, 0..1);
    node.traced(0..1);
    assert_eq!(node.offer(2, 1), [Action::Retire]);
    assert_eq!(node.offer(0, 5), [send_offer(1, 0, 5)]);
    assert_eq!(node.message(Message::Shutdown), [Action::Finish]);
}

/// §7. *Ours:* a node alone in the ring is its own left neighbour.
#[test]
fn r8_offer_of_a_single_node_returns_at_once() {
    let (mut node, _) = TestNode::with_band(0, 1, 0..1);
    assert_eq!(node.traced(0..1), [send_offer(0, 0, 1), results(&[0..1])]);
    assert_eq!(node.offer(0, 1), [Action::Retire]);
}

/// §8: the parent sends each node the scene and its band, assembles the results, and sends the shutdown when the
/// picture is complete.
#[test]
fn r9_the_parent_assembles_and_shuts_down() {
    let division = Division::new(40, 10);
    let (mut parent, bands) = started(2, division);
    assert_eq!(bands, [0..2, 2..4]);
    assert_eq!(Message::Band(0..2).bytes(division, 1000) - Message::Band(0..2).bytes(division, 0), 1000);
    let mut deliver = |node, ranges: &[Range<Atom>]| {
        let mut actions = Vec::new();
        let message = Message::Results(ranges.to_vec());
        parent.handle(Time::ZERO, Event::Message { from: Party::Node(node), message }, &mut actions);
        actions
    };
    assert_eq!(deliver(1, &[2..3]), []);
    assert_eq!(deliver(0, &[0..1, 3..4]), []);
    assert_eq!(deliver(0, &[1..2]), [send(0, Message::Shutdown), send(1, Message::Shutdown), Action::Finish]);
}

/// §8: every node is sent the shutdown and receives it.
#[test]
fn r9_every_node_receives_the_shutdown() {
    for nodes in [1, 2, 7, 40] {
        let log = run_of_1000_atoms(&vec![1.0; nodes], 40 * MS);
        let mut shutdowns: Vec<_> = log
            .records()
            .iter()
            .filter_map(|record| match &record.kind {
                RecordKind::Sent { id, message: Message::Shutdown, .. } => Some(*id),
                _ => None,
            })
            .collect();
        assert_eq!(shutdowns.len(), nodes);
        for record in log.records() {
            if let RecordKind::Received { id, .. } = record.kind {
                shutdowns.retain(|shutdown| *shutdown != id);
            }
        }
        assert!(shutdowns.is_empty());
    }
}

const COST: Duration = Duration::from_millis(10);

/// Executes a run of 1,000 atoms of [`COST`] on nodes of these speeds.
fn run_of_1000_atoms(speeds: &[f64], latency: Duration) -> RunLog {
    let size = Size::new(100, 10).unwrap();
    let plain = Header::plain(size, 1, Strategy::Ring, speeds.to_vec());
    let header = Header { link: LinkSettings { latency, ..plain.link }, ..plain };
    virtual_time::run(&header, &[], |_| COST.as_secs_f64())
}

//! The remedies of the ring that adapts, one by one, on its nodes and its parent themselves, and on whole runs in virtual time.

#![expect(clippy::single_range_in_vec_init, reason = "messages hold ranges")]

mod virtual_time;

use std::ops::Range;
use std::time::Duration;

use anel::balance::{
    Action, Event, Message, Node, NodeId, OfferDetails, Parent, Party, Remedies, Remedy, Rules, Strategy,
};
use anel::picture::{Atom, Division, Size};
use anel::record::RecordKind;
use anel::runlog::{Header, LinkSettings, RunLog};
use anel::time::Time;

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

/// Node 1 of four, and what is said to it at what time.
struct Told {
    node: Node,
    now: Time,
}

impl Told {
    /// It has a band, at time 0.
    fn with_band(remedies: &[Remedy], band: Range<Atom>) -> (Self, Vec<Action>) {
        let mut told = Self { node: Node::new(&rules(with(remedies)), 1, NODES), now: Time::ZERO };
        let actions = told.message(Party::Parent, Message::Band(band));
        (told, actions)
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

    /// Its worker traces these atoms, each of which costs 1 ms and takes `took`; what it does after the last.
    fn trace(&mut self, atoms: Range<Atom>, took: Duration) -> Vec<Action> {
        let mut actions = Vec::new();
        for atom in atoms {
            self.now += took;
            actions = self.event(Event::AtomDone { atom, cost: MS });
        }
        actions
    }

    /// The offer of node 2, made `ago`, as fast as that; what the node does about it.
    fn offered(&mut self, speed: f64, ago: Duration, left: Option<u16>) -> Vec<Action> {
        let help = OfferDetails { speed: OfferDetails::millionths(speed), sent: self.now - ago, stop: 1, left };
        self.message(Party::Node(2), Message::Offer { who: 2, done: 50, help: Some(help) })
    }
}

fn send(to: Party, message: Message) -> Action {
    Action::Send { to, message }
}

/// How many atoms are sent to node 2.
fn given(actions: &[Action]) -> u32 {
    let ranges = actions.iter().find_map(|action| match action {
        Action::Send { to: Party::Node(2), message: Message::Transfer(ranges) } => Some(ranges),
        _ => None,
    });
    ranges.map_or(0, |ranges| ranges.iter().map(|range| range.len() as u32).sum())
}

/// Whom an offer is sent to.
fn offers(actions: &[Action]) -> Vec<Party> {
    let to = |action: &Action| match action {
        Action::Send { to, message: Message::Offer { .. } } => Some(*to),
        _ => None,
    };
    actions.iter().filter_map(to).collect()
}

/// Without any remedy it is the article's ring: the same happens at the same times.
#[test]
fn without_remedies_it_is_the_articles_ring() {
    let size = Size::new(40, 20).expect("a picture");
    let header = |strategy, latency| {
        let plain = Header::plain(size, 5, strategy, vec![1.0, 0.1, 0.6, 1.0]);
        Header {
            rules: Rules { remedies: Remedies::NONE, ..plain.rules },
            link: LinkSettings { latency, ..plain.link },
            ..plain
        }
    };
    let told = |strategy, latency| -> Vec<(Time, RecordKind)> {
        let log: RunLog = virtual_time::run(&header(strategy, latency), &[], |atom| f64::from(1 + atom % 7) * 1e-3);
        let plain = |what: &RecordKind| match what.clone() {
            RecordKind::Sent { id, from, to, message: Message::Offer { who, done, .. }, arrives, .. } => {
                RecordKind::Sent { id, from, to, message: Message::offer(who, done), bytes: 0, arrives }
            }
            other => other,
        };
        log.records().iter().map(|record| (record.at, plain(&record.what))).collect()
    };
    for latency in [Duration::ZERO, MS, 20 * MS] {
        let (adaptive, ring) = (told(Strategy::Adaptive, latency), told(Strategy::Ring, latency));
        let ring: Vec<_> = ring
            .into_iter()
            .map(|(at, what)| match what {
                RecordKind::Sent { id, from, to, message: message @ Message::Offer { .. }, arrives, .. } => {
                    (at, RecordKind::Sent { id, from, to, message, bytes: 0, arrives })
                }
                other => (at, other),
            })
            .collect();
        assert_eq!(adaptive, ring, "{latency:?}");
    }
}

/// Speed: what counts is how fast both are now, not what they have traced since the start.
#[test]
fn shares_follow_the_speeds_of_the_last_atoms() {
    let (mut told, _) = Told::with_band(&[Remedy::Speed], 0..100);
    told.trace(0..10, MS);
    assert_eq!(
        given(&told.offered(0.25, Duration::ZERO, Some(3))),
        18,
        "a fifth of 88 that wait and the two in the pipe"
    );
    let (mut told, _) = Told::with_band(&[], 0..100);
    told.trace(0..10, MS);
    assert_eq!(given(&told.offered(0.25, Duration::ZERO, Some(3))), 73, "by counts: 50 of 60 of the 88");
}

/// Floor: nothing is sent that would be done later there than here.
#[test]
fn what_would_take_longer_to_travel_stays() {
    for (remedies, expected) in [(&[Remedy::Speed, Remedy::Floor][..], 0), (&[Remedy::Speed], 5)] {
        let (mut told, _) = Told::with_band(remedies, 0..20);
        told.trace(0..10, MS);
        // Eight wait, which the node traces in 8 ms itself.
        assert_eq!(given(&told.offered(1.0, 30 * MS, Some(2))), expected);
    }
}

/// Early: an offer leaves a round trip before the atoms run out.
#[test]
fn an_offer_leaves_so_early_that_its_answer_comes_in_time() {
    let (mut told, _) = Told::with_band(&[Remedy::Speed, Remedy::Early], 0..20);
    told.trace(0..5, MS);
    // An offer that has travelled for 2 ms to its first stop, of a node that is not worth an atom.
    assert_eq!(offers(&told.offered(1e-6, 2 * MS, Some(2))), [Party::Node(0)], "it is passed on");
    assert_eq!(offers(&told.trace(5..14, MS)), []);
    assert_eq!(
        offers(&told.trace(14..15, MS)),
        [Party::Node(0)],
        "four atoms before the last, and a round trip takes 4 ms"
    );
    assert_eq!(offers(&told.trace(15..19, MS)), [], "once is enough");
}

/// Wake: who sleeps is woken by whoever comes to need help, and offers to it first.
#[test]
fn whoever_needs_help_wakes_a_sleeper() {
    let remedies = [Remedy::Speed, Remedy::Wake];
    let (mut needy, _) = Told::with_band(&remedies, 0..2);
    needy.trace(0..1, MS);
    assert_eq!(needy.offered(1.0, Duration::ZERO, None), [], "it is remembered");
    let actions = needy.message(Party::Node(3), Message::Transfer(vec![50..90]));
    assert!(actions.contains(&send(Party::Node(2), Message::Wake)), "{actions:?}");
    assert!(given(&needy.offered(1.0, Duration::ZERO, Some(3))) > 15);

    let (mut sleeper, _) = Told::with_band(&remedies, 0..1);
    let actions = sleeper.trace(0..1, MS);
    let Some(Action::Send { message: back @ Message::Offer { .. }, .. }) = actions.first() else {
        panic!("{actions:?} has no offer")
    };
    let actions = sleeper.message(Party::Node(2), back.clone());
    assert!(actions.contains(&Action::Retire));
    assert_eq!(offers(&actions).len(), 3, "it leaves word with all");
    assert_eq!(offers(&sleeper.message(Party::Node(3), Message::Wake)), [Party::Node(3)]);
    assert_eq!(sleeper.message(Party::Node(0), Message::Wake), [], "its offer is under way");
}

/// Copies: what has been in the pipe for too long is traced by a sleeper as well, once.
#[test]
fn a_sleeper_traces_a_late_atom_as_well() {
    let (mut late, _) = Told::with_band(&[Remedy::Speed, Remedy::Wake, Remedy::Copies], 0..4);
    late.trace(0..3, MS);
    assert_eq!(late.offered(1.0, Duration::ZERO, None), [], "it is not late yet");
    late.now += 3 * MS;
    assert_eq!(late.event(Event::Timer), [send(Party::Node(2), Message::Wake)]);
    let again = send(Party::Node(2), Message::Again(vec![3..4]));
    assert_eq!(late.offered(1.0, Duration::ZERO, Some(3)), [again]);
    late.now += 30 * MS;
    assert_eq!(late.event(Event::Timer), [send(Party::Parent, Message::Results(vec![0..3]))], "one copy is enough");
}

/// Leases: a node says at every beat what it has; who is silent is gone, and what nobody has is given to who is idle.
#[test]
fn what_nobody_vouches_for_is_given_out_again() {
    let division = Division::new(100, 1);
    let rules = rules(with(&[Remedy::Leases]));
    let mut parent = Parent::new(&rules, division, NODES);
    let mut tell = |ms: u32, event: Event| {
        let mut actions = Vec::new();
        parent.handle(at(ms), event, &mut actions);
        actions.retain(|action| !matches!(action, Action::SetTimer(_)));
        actions
    };
    let beat = |node: NodeId, holds: Vec<Range<Atom>>, ms: u32| {
        let message = Message::Beat { idle: holds.is_empty(), holds, sent: at(ms) };
        Event::Message { from: Party::Node(node), message }
    };
    assert_eq!(tell(0, Event::Started).len(), 4);
    (0..4)
        .for_each(|node| assert_eq!(tell(0, beat(node, vec![u32::from(node) * 25..u32::from(node) * 25 + 25], 0)), []));
    assert_eq!(tell(50, Event::Message { from: Party::Node(0), message: Message::Results(vec![0..25]) }), []);
    // Node 0 has nothing left, and node 3 is silent.
    for ms in [60, 120, 180, 240] {
        assert_eq!(tell(ms, beat(0, Vec::new(), ms)), []);
        assert_eq!(tell(ms, beat(1, vec![25..50], ms)), []);
        assert_eq!(tell(ms, beat(2, vec![50..75], ms)), []);
        assert_eq!(tell(ms, Event::Timer), [], "a lease is four beats");
    }
    let gone = |node| send(Party::Node(node), Message::Gone(vec![3]));
    let again = send(Party::Node(0), Message::Again(vec![75..100]));
    assert_eq!(tell(300, Event::Timer), [gone(0), gone(1), gone(2), again]);
    assert_eq!(tell(310, beat(0, vec![75..100], 310)), [], "now node 0 has them");
    let back = |node| send(Party::Node(node), Message::Gone(Vec::new()));
    assert_eq!(tell(320, beat(3, vec![75..100], 320)), [0, 1, 2, 3].map(back));
}

/// Leases: the first result counts, and who still has the atom may forget it.
#[test]
fn the_first_result_counts() {
    let mut parent = Parent::new(&rules(with(&[Remedy::Leases])), Division::new(100, 1), NODES);
    let mut tell = |message| {
        let mut actions = Vec::new();
        parent.handle(at(1), Event::Message { from: Party::Node(2), message }, &mut actions);
        actions
    };
    assert_eq!(tell(Message::Results(vec![7..9])), []);
    assert_eq!(tell(Message::Results(vec![7..9])), [], "again");
    let beat = Message::Beat { holds: vec![5..10], idle: false, sent: at(0) };
    assert_eq!(tell(beat), [send(Party::Node(2), Message::Placed(vec![7..9]))]);
    let (mut node, _) = Told::with_band(&[], 5..10);
    assert_eq!(node.message(Party::Parent, Message::Placed(vec![7..9])), []);
    assert_eq!(node.trace(5..6, MS), [Action::Trace(9)]);
    assert_eq!(node.trace(6..7, MS), []);
}

/// Leases: an atom that a worker fails to trace is tried elsewhere; after the third time the run fails with it.
#[test]
fn an_atom_that_fails_three_times_fails_the_run() {
    let (mut node, _) = Told::with_band(&[Remedy::Leases], 0..4);
    let actions = node.event(Event::AtomFailed { atom: 0 });
    assert!(actions.contains(&send(Party::Parent, Message::Failed(0))) && actions.contains(&Action::Trace(2)));

    let mut parent = Parent::new(&rules(with(&[Remedy::Leases])), Division::new(100, 1), NODES);
    parent.handle(at(0), Event::Started, &mut Vec::new());
    let mut tell = |node: NodeId, message| {
        let mut actions = Vec::new();
        parent.handle(at(1), Event::Message { from: Party::Node(node), message }, &mut actions);
        actions
    };
    let idle = || Message::Beat { holds: Vec::new(), idle: true, sent: at(1) };
    assert_eq!(tell(3, idle()), []);
    assert_eq!(tell(1, Message::Failed(40)), [send(Party::Node(3), Message::Again(vec![40..41]))]);
    assert_eq!(tell(3, Message::Failed(40)), []);
    assert_eq!(tell(2, idle()), [send(Party::Node(2), Message::Again(vec![40..41]))]);
    assert_eq!(tell(2, Message::Failed(40)), [Action::Fail(40)]);
}

/// Leases: a machine that begins anew asks to be let in, and offers help.
#[test]
fn a_machine_that_begins_anew_is_let_in() {
    let mut told = Told { node: Node::new(&rules(Remedies::ALL), 1, NODES), now: at(500) };
    assert_eq!(told.event(Event::Started), [send(Party::Parent, Message::Request)]);
    told.now = at(500 + 4 * 60);
    assert_eq!(told.event(Event::Timer), [send(Party::Parent, Message::Request)], "it may not have been heard");
    assert_eq!(offers(&told.message(Party::Parent, Message::Band(0..0))), [Party::Node(0)]);
    assert_eq!(told.message(Party::Parent, Message::Band(0..0)), [], "it was asked as well");
}

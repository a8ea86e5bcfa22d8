//! The last events of a run as sentences. What belongs together is one event, so that no kind drowns the others.

mod recovery;

use std::collections::VecDeque;
use std::time::Duration;

use super::failure::Failure;
use super::happening::Happening;
use crate::balance::{Message, NodeId, Party};
use crate::picture::atoms_in;
use crate::record::{Record, RecordKind};
use crate::time::Time;
use crate::view::state::run_state::RunState;
use crate::view::state::scheduler::Sharing;
use recovery::Recovery;

/// The last events, the newest last.
#[derive(Clone, Debug, Default)]
pub(crate) struct EventLog {
    told: VecDeque<Told>,
}

#[derive(Clone, Debug)]
struct Told {
    at: Time,
    event: RunEvent,
    happening: Happening,
}

/// What events are told by, as far as a later one may join an earlier one.
#[derive(Clone, Debug, PartialEq)]
enum RunEvent {
    Bands,
    Offer(NodeId),
    Transfer,
    /// Transfers of few atoms.
    Trickle {
        from: NodeId,
        to: Vec<NodeId>,
        transfers: u32,
        atoms: u32,
    },
    Retired(Vec<NodeId>),
    /// Machines that are done with what was theirs.
    Done(Vec<NodeId>),
    Estimating,
    /// What the parent of a farm has handed out so far.
    Parts,
    /// At most so many messages waited at the parent.
    Jam(usize),
    /// Whose, and the speed before somebody began to change it.
    Speed {
        node: NodeId,
        before: f64,
    },
    Paused,
    Latency,
    Condition,
    Recovery(Recovery),
    End,
}

/// How many events are kept.
const KEPT: usize = 64;
/// A transfer of up to so many atoms is small.
const SMALL: u32 = 5;
/// Events that are alike and no further apart than this are one.
const TOGETHER: Duration = Duration::from_secs(3);

impl EventLog {
    /// Takes in a record; `state` already knows it.
    pub(crate) fn apply(&mut self, record: &Record, state: &RunState) {
        let at = record.at;
        match &record.what {
            RecordKind::Sent { from: Party::Parent, message: Message::Band(band), .. } => {
                if !self.has(&RunEvent::Bands) {
                    self.tell(at, RunEvent::Bands, Happening::bands(state, band));
                }
            }
            RecordKind::Sent { from: Party::Node(from), message, .. } if message.own_offer(*from).is_some() => {
                let (who, done) = (from, message.own_offer(*from).unwrap_or_default());
                // Later offers are told by what comes of them.
                if let Some(node) = state.nodes().get(usize::from(*who)).filter(|node| node.offers == 1) {
                    let whole = node.given.atoms == 0;
                    self.tell(at, RunEvent::Offer(*who), Happening::offer(state, *who, whole, done));
                }
            }
            RecordKind::Sent {
                from: Party::Node(from),
                to: Party::Node(to),
                message: Message::Transfer(ranges),
                ..
            } => {
                self.transfer(at, *from, *to, atoms_in(ranges), state);
            }
            RecordKind::Sent { message: Message::Part(part), .. } if !part.is_empty() => {
                // A part for each node is one more round.
                let parts = state.handed_out.count;
                if parts.is_multiple_of(state.nodes().len() as u32) {
                    self.told.retain(|told| told.event != RunEvent::Parts);
                    self.tell(at, RunEvent::Parts, Happening::PartsSoFar(parts));
                }
            }
            RecordKind::Received { by: Party::Parent, .. } => {
                if let Some(waiting) = waiting_messages(state, at).filter(|&waiting| !self.had_as_many(at, waiting)) {
                    self.take(at, |event| matches!(event, RunEvent::Jam(_)));
                    self.tell(at, RunEvent::Jam(waiting), Happening::queue(state, waiting));
                }
            }
            RecordKind::AtomDone { node, .. } if is_done(state, *node) => {
                let nodes = self.together(at, *node, |event| match event {
                    RunEvent::Done(nodes) => Some(nodes),
                    _ => None,
                });
                self.tell(at, RunEvent::Done(nodes.clone()), Happening::BandsDone(nodes));
            }
            RecordKind::Estimating => self.tell(at, RunEvent::Estimating, Happening::Estimating),
            RecordKind::SpeedSet { node, speed } => {
                let Some(machine) = state.nodes().get(usize::from(*node)) else { return };
                let same = |event: &RunEvent| matches!(event, RunEvent::Speed { node: other, .. } if other == node);
                let before = match self.take(at, same) {
                    Some(RunEvent::Speed { before, .. }) => before,
                    _ => machine.previous_speed,
                };
                let happening = Happening::speed(state, *node, before, *speed);
                self.tell(at, RunEvent::Speed { node: *node, before }, happening);
            }
            RecordKind::Paused { node } => self.tell(at, RunEvent::Paused, Happening::paused(state, *node)),
            RecordKind::Resumed { node } => self.tell(at, RunEvent::Paused, Happening::resumed(state, *node)),
            RecordKind::LatencySet { latency } => {
                self.take(at, |event| *event == RunEvent::Latency);
                self.tell(at, RunEvent::Latency, Happening::latency(state, *latency));
            }
            RecordKind::Retired { node } => {
                let nodes = self.together(at, *node, |event| match event {
                    RunEvent::Retired(nodes) => Some(nodes),
                    _ => None,
                });
                let happening = Happening::retired(state, nodes.clone());
                self.tell(at, RunEvent::Retired(nodes), happening);
            }
            RecordKind::Finished => self.tell(at, RunEvent::End, Happening::Complete),
            RecordKind::Condition { node, .. } => {
                if let Some(failure) = Failure::condition(state, *node) {
                    self.tell(at, RunEvent::Condition, Happening::Failure(failure));
                }
            }
            RecordKind::Sent { from, to: Party::Node(to), message, .. } => self.mend(at, (*from, *to), message, state),
            RecordKind::Delayed { from, to, until } => {
                let failure = Failure::Delayed { from: *from, to: *to, by: until.since(at) };
                self.tell(at, RunEvent::Condition, Happening::Failure(failure));
            }
            RecordKind::Sent { .. }
            | RecordKind::Link { .. }
            | RecordKind::Lost { .. }
            | RecordKind::AtomFailed { .. }
            | RecordKind::GivenUp { .. }
            | RecordKind::Received { .. }
            | RecordKind::AtomStarted { .. }
            | RecordKind::AtomDone { .. }
            | RecordKind::Estimated { .. } => {}
        }
    }

    /// The events and their times, the newest last.
    pub(crate) fn iter(&self) -> impl DoubleEndedIterator<Item = (Time, &Happening)> {
        self.told.iter().map(|told| (told.at, &told.happening))
    }

    /// What somebody did to the run last.
    pub(crate) fn latest_by_hand(&self) -> Option<&Happening> {
        let by_hand = |told: &&Told| {
            matches!(told.event, RunEvent::Speed { .. } | RunEvent::Paused | RunEvent::Latency | RunEvent::Condition)
        };
        self.told.iter().rev().find(by_hand).map(|told| &told.happening)
    }

    fn has(&self, event: &RunEvent) -> bool {
        self.told.iter().any(|told| told.event == *event)
    }

    /// Whether so many messages have waited at the parent of late.
    fn had_as_many(&self, now: Time, waiting: usize) -> bool {
        self.told
            .iter()
            .any(|told| matches!(told.event, RunEvent::Jam(most) if most >= waiting) && now <= told.at + TOGETHER)
    }

    fn transfer(&mut self, at: Time, from: NodeId, to: NodeId, atoms: u32, state: &RunState) {
        let is_theft = state.sharing == Sharing::Stealing;
        if atoms > SMALL {
            return self.tell(at, RunEvent::Transfer, Happening::gift(state, from, to, atoms));
        }
        let same = |event: &RunEvent| matches!(event, RunEvent::Trickle { from: other, .. } if *other == from);
        let (mut receivers, mut transfers, mut all) = match self.take(at, same) {
            Some(RunEvent::Trickle { to, transfers, atoms, .. }) => (to, transfers, atoms),
            _ => (Vec::new(), 0, 0),
        };
        (transfers, all) = (transfers + 1, all + atoms);
        if let Err(place) = receivers.binary_search(&to) {
            receivers.insert(place, to);
        }
        let to = receivers.clone();
        let happening = Happening::SmallTransfers { from, to, transfers, atoms: all, is_theft };
        self.tell(at, RunEvent::Trickle { from, to: receivers, transfers, atoms: all }, happening);
    }

    /// The nodes of the latest event of a kind, if `node` comes soon after them, and `node`.
    fn together(&mut self, at: Time, node: NodeId, of: impl Fn(RunEvent) -> Option<Vec<NodeId>>) -> Vec<NodeId> {
        let before = self.take(at, |event| of(event.clone()).is_some());
        let mut nodes = before.and_then(of).unwrap_or_default();
        if let Err(place) = nodes.binary_search(&node) {
            nodes.insert(place, node);
        }
        nodes
    }

    /// Takes out the latest event of a kind, if it is so fresh that what comes now belongs to it.
    fn take(&mut self, now: Time, kind: impl Fn(&RunEvent) -> bool) -> Option<RunEvent> {
        let place = self.told.iter().rposition(|told| kind(&told.event) && now <= told.at + TOGETHER)?;
        self.told.remove(place).map(|told| told.event)
    }

    /// Records of different parties may come a little out of order: events do not.
    fn tell(&mut self, at: Time, event: RunEvent, happening: Happening) {
        let place = self.told.iter().rposition(|told| told.at <= at).map_or(0, |before| before + 1);
        self.told.insert(place, Told { at, event, happening });
        if self.told.len() > KEPT {
            self.told.pop_front();
        }
    }
}

/// How many messages wait at the parent at `now`, if they are worth a word.
pub(crate) fn waiting_messages(state: &RunState, now: Time) -> Option<usize> {
    /// Fewer are soon handled.
    const MANY: usize = 4;
    if state.handling.is_zero() {
        return None;
    }
    Some(state.line_length(now)).filter(|&waiting| waiting >= MANY)
}

/// Whether `node` has just traced its last atom, gets no other, and others go on.
pub(crate) fn is_done(state: &RunState, node: NodeId) -> bool {
    let is_last = state.nodes().get(usize::from(node)).is_some_and(|of| of.band_at.is_some() && of.left() == 0);
    is_last && state.sharing.is_fixed() && state.nodes().iter().any(|other| other.left() > 0)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::language::Language;
    use crate::view::tests::sample_runs;

    fn sentences(events: &EventLog) -> Vec<String> {
        events.iter().map(|(_, event)| event.sentence(Language::English)).collect()
    }

    /// The events of these records, at their times in ms.
    fn told(nodes: usize, records: impl IntoIterator<Item = (u64, RecordKind)>) -> EventLog {
        let (mut state, mut events) =
            (RunState::new(&sample_runs::header(&vec![1.0; nodes], 900)), EventLog::default());
        for (ms, what) in records {
            let record = Record { at: Time(ms * 1_000_000), what };
            state.apply(&record);
            events.apply(&record, &state);
        }
        events
    }

    fn transfer(from: NodeId, to: NodeId, atoms: u32) -> RecordKind {
        let (from, to) = (Party::Node(from), Party::Node(to));
        let message = Message::Transfer(std::iter::once(0..atoms).collect());
        RecordKind::Sent { id: 0, from, to, message, bytes: 0, arrives: Time::ZERO }
    }

    proptest! {
        #[test]
        fn events_of_a_whole_run_are_few_and_in_order(
            speeds in prop::collection::vec(0.02..1.0f64, 1..9), atoms in 1..400u32,
        ) {
            let header = sample_runs::header(&speeds, atoms);
            let (mut state, mut events) = (RunState::new(&header), EventLog::default());
            for record in sample_runs::records(&header) {
                state.apply(&record);
                events.apply(&record, &state);
                prop_assert!(events.told.len() <= KEPT);
            }
            prop_assert!(events.told.iter().is_sorted_by_key(|told| told.at));
            for sentence in sentences(&events) {
                prop_assert!(sentence.chars().count() <= 95, "{sentence}");
            }
            prop_assert!(sentences(&events).contains(&Happening::Complete.sentence(Language::English)));
            // Every node offers at last, and says so once.
            for node in 0..speeds.len() as NodeId {
                let offers = events.told.iter().filter(|told| told.event == RunEvent::Offer(node)).count();
                prop_assert!(offers == 1 || events.told.len() == KEPT);
            }
        }
    }

    #[test]
    fn the_list_tells_who_is_slow_and_what_moved_where() {
        let header = sample_runs::header(&[1.0, 1.0, 0.1], 600);
        let (mut state, mut events) = (RunState::new(&header), EventLog::default());
        for record in sample_runs::records(&header) {
            state.apply(&record);
            events.apply(&record, &state);
        }
        let told = sentences(&events);
        assert_eq!(told[0], "The parent gives each of 3 machines an equal band of the picture");
        assert_eq!(told[1], "1 has finished its band and offers help round the ring");
        assert!(told.iter().any(|told| told.starts_with("3, slow at 10 %, gave ")), "{told:#?}");
    }

    #[test]
    fn small_transfers_of_a_machine_are_one_event() {
        let [one, two, more] = [1, 2, 40].map(|atoms| move |from, to| transfer(from, to, atoms));
        let events = told(8, [(0, one(6, 1)), (10, one(6, 7)), (20, one(4, 2)), (30, more(6, 3)), (40, one(6, 2))]);
        assert_eq!(
            sentences(&events),
            ["5 gave 1 atom to 3", "7 gave 40 atoms to 4, which had finished", "7 gave 1 atom to 2, 3 and 8"]
        );
        let events = told(8, [(0, one(6, 1)), (10, two(6, 1)), (20, two(6, 3)), (9000, one(6, 1))]);
        assert_eq!(sentences(&events), ["7 gave few atoms at a time to 2 and 4: 5 in 3 parcels", "7 gave 1 atom to 2"]);
    }

    #[test]
    fn many_small_transfers_do_not_drown_the_rest() {
        let small = (0..500).map(|i: u16| (u64::from(i), transfer(i % 7, i % 3 + 7, 1)));
        let events = told(12, std::iter::once((0, transfer(0, 1, 99))).chain(small));
        assert_eq!(events.told.len(), 8);
        assert_eq!(sentences(&events)[0], "1 gave 99 atoms to 2, which had finished");
    }

    #[test]
    fn machines_that_retire_together_are_one_event() {
        let events = told(4, [2, 0, 3].map(|node| (10 * u64::from(node), RecordKind::Retired { node })));
        assert_eq!(sentences(&events), ["1, 3 and 4 retire: their offers came back, nobody needs their help"]);
    }

    #[test]
    fn a_dragged_slider_is_one_event() {
        let speed = |node, percent: u64| RecordKind::SpeedSet { node, speed: percent as f64 / 100.0 };
        let ms = Duration::from_millis;
        let events = told(
            3,
            [
                (0, speed(1, 80)),
                (100, transfer(0, 2, 50)),
                (200, speed(1, 30)),
                (300, RecordKind::LatencySet { latency: ms(90) }),
                (400, RecordKind::LatencySet { latency: ms(200) }),
                (500, speed(2, 60)),
                (6000, speed(1, 40)),
                (6100, RecordKind::Paused { node: 2 }),
                (6200, RecordKind::Resumed { node: 2 }),
            ],
        );
        assert_eq!(
            sentences(&events),
            [
                "1 gave 50 atoms to 3, which had finished",
                "Machine 2 now runs at 30 %: the others will make up for it",
                "A hop takes 200 ms now",
                "Machine 3 now runs at 60 %: the others will make up for it",
                "Machine 2 now runs at 40 %: it can take more work",
                "Machine 3 is paused: the others will make up for it",
                "Machine 3 goes on",
            ]
        );
    }

    #[test]
    fn only_the_last_are_kept() {
        let records = (0..200).map(|i| (i, transfer(0, 1, 100 + i as u32)));
        let events = told(2, records);
        assert_eq!(events.told.len(), KEPT);
        assert_eq!(sentences(&events)[KEPT - 1], "1 gave 299 atoms to 2, which had finished");
    }
}

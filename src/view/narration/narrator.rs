//! The run in sentences: one large at a time, and the last ones in a list.

use std::collections::VecDeque;
use std::time::Duration;

use super::event_sentences::before_virtual_time;
use super::events::{EventLog, is_done, waiting_messages};
use super::failure::Failure;
use super::happening::{Happening, Retirement};
use super::status::standing;
use crate::balance::{Message, Party};
use crate::language::Language;
use crate::picture::atoms_in;
use crate::record::{Record, RecordKind};
use crate::time::Time;
use crate::view::state::run_state::RunState;

/// Says what happens, one sentence at a time: each stays long enough to be read, unless something weightier
/// happens. Keeps the last events too.
#[derive(Clone, Debug, Default)]
pub struct Narrator {
    /// What is told where time goes as it does.
    told: Option<Told>,
    /// The last that were passed over since, for want of time to read them: where time goes slower there is some.
    passed_over: VecDeque<Told>,
    events: EventLog,
}

#[derive(Clone, Debug)]
struct Told {
    at: Time,
    weight: Weight,
    happening: Happening,
}

/// What kind of event it is and, of transfers, how large: one of twice the atoms weighs more.
type Weight = (u8, u32);

/// Of what somebody does to the run: it follows the hand.
const BY_HAND: Weight = (4, 0);

/// Of machines that are missed: it follows what was done to them.
const MISSED: Weight = (4, 1);

/// Of the end, which nothing follows.
const END: Weight = (5, 0);

/// How long an event is fresh for whoever looks on.
const FRESH: Duration = Duration::from_secs(3);

/// How long a sentence stays when others like it follow.
const READ: Duration = Duration::from_millis(1600);

impl Narrator {
    /// Takes in a record; `state` already knows it.
    pub fn apply(&mut self, record: &Record, state: &RunState) {
        self.events.apply(record, state);
        let by_hand = matches!(
            record.what,
            RecordKind::SpeedSet { .. }
                | RecordKind::Paused { .. }
                | RecordKind::Resumed { .. }
                | RecordKind::LatencySet { .. }
                | RecordKind::Condition { .. }
        );
        let told = if by_hand {
            // The list knows where a slider was before the hand took hold of it.
            self.events.latest_by_hand().map(|happening| (BY_HAND, happening.clone()))
        } else {
            tell(record, state)
        };
        let Some((weight, happening)) = told else { return };
        let next = Told { at: record.at, weight, happening };
        if self.told.as_ref().is_none_or(|told| told.gives_way_to(&next, READ)) {
            self.told = Some(next);
            self.passed_over.clear();
        } else {
            self.passed_over.truncate(MOST_PASSED_OVER - 1);
            self.passed_over.push_front(next);
        }
    }

    /// What is to be read at `now`: the last event while it is fresh, else how things stand.
    pub fn sentence(&self, state: &RunState, now: Time, language: Language) -> String {
        match self.told_at(now, state.rate()) {
            Some(told) => told.happening.sentence(language),
            None if state.finished().is_some() => Happening::Complete.sentence(language),
            // Nothing has been heard of it: its records begin when all costs are known.
            _ if state.is_virtual && state.head() == Time::ZERO => before_virtual_time(language).into(),
            _ => standing(state, language),
        }
    }

    /// The last events and their times, the newest last. What belongs together is one event: a slider that is
    /// dragged, small transfers of one machine, machines that retire.
    pub fn events(&self) -> impl DoubleEndedIterator<Item = (Time, &Happening)> {
        self.events.iter()
    }

    /// Those before what is to be read at `now`.
    pub fn earlier(&self, state: &RunState, now: Time) -> impl DoubleEndedIterator<Item = (Time, &Happening)> {
        let told = self.told_at(now, state.rate()).map(|told| told.at);
        self.events().filter(move |(at, _)| told.is_none_or(|told| *at < told))
    }

    /// The event that is to be read at `now`, while it is fresh; `rate` of the run's seconds go by in one of whoever
    /// looks on.
    fn told_at(&self, now: Time, rate: f64) -> Option<&Told> {
        let (read, fresh) = (READ.mul_f64(rate), FRESH.mul_f64(rate));
        let mut told = self.told.as_ref()?;
        for next in self.passed_over.iter().rev() {
            if told.gives_way_to(next, read) {
                told = next;
            }
        }
        (now < told.at + fresh).then_some(told)
    }
}

impl Told {
    /// Whether it has been there so long, or weighs so little, that `next` is told in its stead. What is done by hand is
    /// told at once, or the first of a slider's many speeds would stand there.
    fn gives_way_to(&self, next: &Self, read: Duration) -> bool {
        next.weight > self.weight
            || next.weight == self.weight && next.weight == BY_HAND
            || self.weight < END && next.at >= self.at + read
    }
}

/// More of them nobody could follow.
const MOST_PASSED_OVER: usize = 64;

fn tell(record: &Record, state: &RunState) -> Option<(Weight, Happening)> {
    let told = match &record.what {
        RecordKind::Sent {
            from: Party::Node(from), to: Party::Node(to), message: Message::Transfer(ranges), ..
        } => {
            let atoms = atoms_in(ranges);
            ((3, atoms.checked_ilog2().unwrap_or(0)), Happening::transfer(state, *from, *to, atoms))
        }
        RecordKind::Sent { from: Party::Parent, message: Message::Gone(_), .. } => {
            (MISSED, Happening::Failure(Failure::ring_changed(state, record.at)?))
        }
        RecordKind::Sent { from, to: Party::Node(to), message: Message::Again(ranges), .. } => {
            let atoms = atoms_in(ranges);
            let to = vec![*to];
            match *from {
                Party::Parent => {
                    ((3, atoms.checked_ilog2().unwrap_or(0)), Happening::Failure(Failure::HandedOutAgain { to, atoms }))
                }
                Party::Node(from) => ((2, 0), Happening::Failure(Failure::Copies { from, to, atoms })),
            }
        }
        RecordKind::Sent { from: Party::Node(from), to: Party::Node(to), message: Message::Wake, .. } => {
            ((1, 1), Happening::Failure(Failure::Wakes { from: *from, to: vec![*to] }))
        }
        RecordKind::Sent { from: Party::Node(from), message: message @ Message::Offer { .. }, .. } => {
            ((1, 0), Happening::offer(state, *from, false, message.own_offer(*from)?))
        }
        // One that is asked back, or let in, gets no band.
        RecordKind::Sent { message: Message::Band(band), .. } if band.is_empty() && state.sharing.is_adaptive() => {
            return None;
        }
        RecordKind::Sent { from: Party::Parent, message: Message::Band(band), .. } => {
            ((2, 0), Happening::bands(state, band))
        }
        RecordKind::Retired { .. } if state.sharing.is_farm() => return None,
        RecordKind::Retired { node } => {
            let happening = Happening::retired(state, vec![*node]);
            let sleeps = matches!(happening, Happening::Retired { reason: Retirement::Sleeps, .. });
            ((if sleeps { 1 } else { 2 }, 0), happening)
        }
        // The bands follow, perhaps soon.
        RecordKind::Estimating => ((1, 0), Happening::Estimating),
        RecordKind::Sent { to: Party::Node(to), message: Message::Part(part), .. } => {
            let weight = if part.is_empty() { 2 } else { 1 };
            ((weight, 0), Happening::Part { to: *to, atoms: part.len() as u32 })
        }
        RecordKind::Received { by: Party::Parent, .. } => {
            let waiting = waiting_messages(state, record.at)?;
            ((2, waiting.ilog2()), Happening::queue(state, waiting))
        }
        RecordKind::AtomDone { node, .. } if is_done(state, *node) => ((2, 0), Happening::BandsDone(vec![*node])),
        RecordKind::Finished => (END, Happening::Complete),
        _ => return None,
    };
    Some(told)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::balance::{Rules, Strategy};
    use crate::runlog::{Driver, Header};
    use crate::view::tests::sample_runs;

    #[test]
    fn the_story_of_a_slow_machine() {
        let language = Language::English;
        let header = sample_runs::header(&[1.0, 1.0, 0.1], 2400);
        let (mut state, mut narrator, mut heard) = (RunState::new(&header), Narrator::default(), Vec::new());
        for record in sample_runs::records(&header) {
            state.apply(&record);
            narrator.apply(&record, &state);
            heard.push(narrator.sentence(&state, record.at, language));
        }
        heard.dedup();
        let says = |part: &str| heard.iter().any(|sentence| sentence.contains(part));
        assert!(says("The parent gives each of 3 machines an equal band"), "{heard:#?}");
        assert!(says("3 machines compute; 3 is slow (10 %)"), "{heard:#?}");
        assert!(says("from 3, which is slow (10 %)"), "{heard:#?}");
        assert_eq!(heard.last().map(String::as_str), Some("The picture is complete"));
        assert!(heard.iter().all(|sentence| sentence.chars().count() <= 95), "{heard:#?}");
    }

    #[test]
    fn a_sentence_stays_until_it_is_read_or_outweighed() {
        let language = Language::English;
        let mut state = RunState::new(&sample_runs::header(&[1.0, 1.0], 9));
        let mut narrator = Narrator::default();
        let at = |ms: u64| Time(ms * 1_000_000);
        let mut say = |ms, what| {
            let record = Record { at: at(ms), what };
            state.apply(&record);
            narrator.apply(&record, &state);
            narrator.sentence(&state, record.at, language)
        };
        assert!(say(0, RecordKind::Retired { node: 0 }).starts_with("1's offer"));
        assert!(say(100, RecordKind::Retired { node: 1 }).starts_with("1's offer"));
        assert!(say(200, RecordKind::SpeedSet { node: 1, speed: 0.25 }).starts_with("Machine 2 now runs at 25 %"));
        assert!(say(300, RecordKind::Retired { node: 1 }).starts_with("Machine 2"));
        assert!(
            say(400, RecordKind::LatencySet { latency: Duration::from_millis(200) }).starts_with("A hop takes 200 ms")
        );
        assert!(say(2100, RecordKind::Retired { node: 1 }).starts_with("2's offer"));
        assert!(say(2200, RecordKind::Finished).starts_with("The picture"));
        assert!(say(9000, RecordKind::SpeedSet { node: 1, speed: 0.5 }).starts_with("The picture"));
    }

    #[test]
    fn where_time_goes_slowly_there_is_time_to_read_what_would_be_passed_over() {
        let language = Language::English;
        let mut state = RunState::new(&sample_runs::header(&[1.0, 1.0, 1.0], 9));
        let mut narrator = Narrator::default();
        let at = |ms: u64| Time(ms * 1_000_000);
        for (ms, node) in [(0, 0), (100, 1), (200, 2)] {
            let record = Record { at: at(ms), what: RecordKind::Retired { node } };
            state.apply(&record);
            narrator.apply(&record, &state);
        }
        let mut says = |rate, ms| {
            state.set_rate(rate);
            narrator.sentence(&state, at(ms), language)
        };
        assert!(says(1.0, 250).starts_with("1's offer"));
        assert!(says(0.01, 210).starts_with("3's offer"));
        assert!(says(0.1, 250).starts_with("3's offer"), "the second is being read for 160 ms");
        assert_eq!(says(0.01, 250), "Waiting for the parent", "what was fresh for 30 ms");
    }

    #[test]
    fn a_transfer_of_twice_the_atoms_outweighs_another() {
        let language = Language::English;
        let state = RunState::new(&sample_runs::header(&[1.0, 1.0, 0.1], 900));
        let mut narrator = Narrator::default();
        let mut say = |ms: u64, from, atoms| {
            let (from, to, at) = (Party::Node(from), Party::Node(0), Time(ms * 1_000_000));
            let message = Message::Transfer(std::iter::once(0..atoms).collect());
            let what = RecordKind::Sent { id: ms, from, to, message, bytes: 0, arrives: at };
            narrator.apply(&Record { at, what }, &state);
            narrator.sentence(&state, at, language)
        };
        assert!(say(0, 1, 20).ends_with("takes over 20 atoms from 2, which is still busy"));
        assert!(say(100, 1, 30).contains("takes over 20 atoms"));
        assert!(say(200, 2, 200).ends_with("takes over 200 atoms from 3, which is slow (10 %)"));
        assert!(say(300, 1, 20).contains("takes over 200 atoms"));
    }

    #[test]
    fn a_sentence_on_a_speed_follows_the_hand() {
        let language = Language::English;
        let mut state = RunState::new(&sample_runs::header(&[1.0, 1.0, 0.1], 9));
        let mut narrator = Narrator::default();
        let mut set = |ms: u64, node, speed| {
            let record = Record { at: Time(ms * 1_000_000), what: RecordKind::SpeedSet { node, speed } };
            state.apply(&record);
            narrator.apply(&record, &state);
            narrator.sentence(&state, record.at, language)
        };
        for (ms, speed) in [(0, 0.86), (50, 0.4), (100, 0.01)] {
            let expected = format!("Machine 2 now runs at {:.0} %: the others will make up for it", speed * 100.0);
            assert_eq!(set(ms, 1, speed), expected);
        }
        assert_eq!(set(150, 1, 0.0), "Machine 2 is stopped: the others will make up for it");
        assert_eq!(set(200, 1, 0.7), "Machine 2 now runs at 70 %: the others will make up for it");
        assert_eq!(set(250, 1, 1.0), "Machine 2 now runs at 100 %");
        assert_eq!(set(300, 2, 0.6), "Machine 3 now runs at 60 %: it can take more work");
        assert_eq!(set(350, 2, 1.0), "Machine 3 now runs at 100 %: it can take more work");
        assert_eq!(set(9000, 2, 0.9), "Machine 3 now runs at 90 %: the others will make up for it");
    }

    /// What is heard of a run by this strategy whose last machine is slow, and what is left in the list at its end.
    fn story(strategy: Strategy, handling: u64, language: Language) -> (BTreeSet<String>, Vec<String>) {
        let plain = sample_runs::header(&[1.0, 1.0, 1.0, 1.0, 0.1], 2000);
        let rules = Rules { strategy, part: strategy.usual_part(plain.division, 5), ..plain.rules };
        let header = Header { rules, handling: Duration::from_millis(handling), ..plain };
        let (mut state, mut narrator, mut heard) = (RunState::new(&header), Narrator::default(), BTreeSet::new());
        for record in sample_runs::records(&header) {
            // How things stood before it.
            heard.insert(narrator.sentence(&state, record.at, language));
            state.apply(&record);
            narrator.apply(&record, &state);
            heard.insert(narrator.sentence(&state, record.at, language));
        }
        assert!(heard.iter().all(|sentence| sentence.chars().count() <= 105), "{heard:#?}");
        let listed: Vec<_> = narrator.events().map(|(_, event)| event.sentence(language)).collect();
        assert!(listed.iter().all(|sentence| sentence.chars().count() <= 95), "{listed:#?}");
        (heard, listed)
    }

    /// Each of these is somewhere in what is heard.
    fn assert_heard(heard: &BTreeSet<String>, parts: &[&str]) {
        for part in parts {
            assert!(heard.iter().any(|sentence| sentence.contains(part)), "{part}: {heard:#?}");
        }
        let of_the_ring = |sentence: &&String| sentence.contains("offer") || sentence.contains("retire");
        assert_eq!(heard.iter().find(of_the_ring), None);
    }

    #[test]
    fn in_a_farm_nodes_ask_and_their_parts_are_one_event() {
        let language = Language::English;
        let (heard, listed) = story(Strategy::Farm, 0, language);
        assert_heard(
            &heard,
            &[
                "The parent gives each of 5 machines a first part: 25 atoms",
                " asks the parent for more and gets 25 atoms",
                " asks the parent for more, but all is given away: it is no longer needed",
            ],
        );
        let parts = listed.iter().filter(|event| event.starts_with("The parent has handed out")).count();
        assert!(parts == 1 && listed.len() < 12, "{listed:#?}");
        assert!(listed.iter().any(|event| event.ends_with(" asked for more, but all is given away")), "{listed:#?}");
    }

    #[test]
    fn a_slow_parent_is_told_of() {
        let language = Language::English;
        let (heard, listed) = story(Strategy::Farm, 40, language);
        assert_heard(&heard, &[" messages wait at the parent, which needs 40 ms for each"]);
        let jams = listed.iter().filter(|event| event.contains("messages wait")).count();
        assert!((1..40).contains(&jams), "{listed:#?}");
    }

    #[test]
    fn with_fixed_bands_all_wait_for_the_slow_one() {
        let language = Language::English;
        let (heard, listed) = story(Strategy::Static, 0, language);
        assert_heard(
            &heard,
            &[
                "The parent gives each of 5 machines an equal band",
                "1 is done and waits: nobody shares with it",
                "All wait for 5, which is slow (10 %): ",
            ],
        );
        assert!(listed.iter().any(|event| event == "1, 2, 3 and 4 are done and wait: nobody shares with them"));
        let (heard, _) = story(Strategy::StaticEstimate, 0, language);
        assert_heard(
            &heard,
            &[&Happening::Estimating.sentence(Language::English), "a band that should cost the same", "All wait for 5"],
        );
        let (heard, _) = story(Strategy::Serial, 0, language);
        assert_heard(&heard, &["one machine the whole picture", "1 computes alone: "]);
    }

    #[test]
    fn threads_steal() {
        let language = Language::English;
        let header = Header { driver: Driver::WorkStealing, ..sample_runs::header(&[1.0, 1.0, 0.1], 600) };
        let mut state = RunState::new(&header);
        let mut narrator = Narrator::default();
        let mut say = |ms: u64, from, atoms| {
            let (from, to, at) = (Party::Node(from), Party::Node(2), Time(ms * 1_000_000));
            let message = Message::Transfer(std::iter::once(0..atoms).collect());
            let record = Record { at, what: RecordKind::Sent { id: ms, from, to, message, bytes: 0, arrives: at } };
            state.apply(&record);
            narrator.apply(&record, &state);
            narrator.sentence(&state, at, language)
        };
        assert_eq!(say(0, 0, 96), "3 steals 96 atoms from 1");
        assert_eq!(say(9000, 1, 1), "3 steals 1 atom from 2");
        let listed: Vec<_> = narrator.events().map(|(_, event)| event.sentence(Language::English)).collect();
        assert_eq!(listed, ["3 steals 96 atoms from 1", "3 steals few atoms at a time from 2: 1 atom"]);
    }

    #[test]
    fn before_virtual_time_begins_something_is_said() {
        let language = Language::English;
        let state = RunState::new(&sample_runs::header(&[1.0, 1.0], 9));
        assert_eq!(Narrator::default().sentence(&state, Time::ZERO, language), before_virtual_time(language));
    }
}

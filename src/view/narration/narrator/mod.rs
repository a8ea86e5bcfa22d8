//! The run in sentences: one large at a time, and the last ones in a list.

use std::collections::VecDeque;
use std::time::Duration;

use crate::balance::{Message, Party};
use crate::language::Language;
use crate::picture::atoms_in;
use crate::record::{Record, RecordKind};
use crate::time::Time;
use crate::view::narration::event_sentences::before_virtual_time;
use crate::view::narration::events::{EventLog, is_band_done, waiting_messages};
use crate::view::narration::failure::Failure;
use crate::view::narration::happening::{Happening, Retirement};
use crate::view::narration::status::status_sentence;
use crate::view::state::run_state::RunState;

/// Says what happens, one sentence at a time: each stays long enough to be read, unless something weightier
/// happens. Keeps the last events too.
#[derive(Clone, Debug, Default)]
pub struct Narrator {
    /// What is told where time goes as it does.
    shown: Option<WeightedEvent>,
    /// The last that were passed over since, for want of time to read them: where time goes slower there is some.
    skipped: VecDeque<WeightedEvent>,
    events: EventLog,
}

#[derive(Clone, Debug)]
struct WeightedEvent {
    at: Time,
    weight: Weight,
    happening: Happening,
}

/// What kind of event it is and, of transfers, how large: one of twice the atoms weighs more.
type Weight = (u8, u32);

/// Of what somebody does to the run: it follows the hand.
const USER_CHANGE: Weight = (4, 0);

/// Of machines that are missed: it follows what was done to them.
const MISSED: Weight = (4, 1);

/// Of the end, which nothing follows.
const COMPLETE: Weight = (5, 0);

/// How long an event is fresh for whoever looks on.
const FRESH_TIME: Duration = Duration::from_secs(3);

/// How long a sentence stays when others like it follow.
const MIN_READING_TIME: Duration = Duration::from_millis(1600);

impl Narrator {
    /// Takes in a record; `state` already knows it.
    pub fn apply(&mut self, record: &Record, state: &RunState) {
        self.events.apply(record, state);
        let is_user_change = matches!(
            record.what,
            RecordKind::SpeedSet { .. }
                | RecordKind::Paused { .. }
                | RecordKind::Resumed { .. }
                | RecordKind::LatencySet { .. }
                | RecordKind::Condition { .. }
        );
        let event = if is_user_change {
            // The list knows where a slider was before the hand took hold of it.
            self.events.latest_user_change().map(|happening| (USER_CHANGE, happening.clone()))
        } else {
            weigh(record, state)
        };
        let Some((weight, happening)) = event else { return };
        let next = WeightedEvent { at: record.at, weight, happening };
        if self.shown.as_ref().is_none_or(|event| event.yields_to(&next, MIN_READING_TIME)) {
            self.shown = Some(next);
            self.skipped.clear();
        } else {
            self.skipped.truncate(MAX_SKIPPED_EVENTS - 1);
            self.skipped.push_front(next);
        }
    }

    /// What is to be read at `now`: the last event while it is fresh, else how things stand.
    pub fn sentence(&self, state: &RunState, now: Time, language: Language) -> String {
        match self.shown_at(now, state.rate()) {
            Some(event) => event.happening.sentence(language),
            None if state.finished().is_some() => Happening::Complete.sentence(language),
            // Nothing has been heard of it: its records begin when all costs are known.
            _ if state.is_virtual && state.head() == Time::ZERO => before_virtual_time(language).into(),
            _ => status_sentence(state, language),
        }
    }

    /// The last events and their times, the newest last. What belongs together is one event: a slider that is
    /// dragged, small transfers of one machine, machines that retire.
    pub fn events(&self) -> impl DoubleEndedIterator<Item = (Time, &Happening)> {
        self.events.iter()
    }

    /// Those before what is to be read at `now`.
    pub fn earlier(&self, state: &RunState, now: Time) -> impl DoubleEndedIterator<Item = (Time, &Happening)> {
        let event = self.shown_at(now, state.rate()).map(|event| event.at);
        self.events().filter(move |(at, _)| event.is_none_or(|event| *at < event))
    }

    /// The event that is to be read at `now`, while it is fresh; `rate` of the run's seconds go by in one of whoever
    /// looks on.
    fn shown_at(&self, now: Time, rate: f64) -> Option<&WeightedEvent> {
        let (read, fresh) = (MIN_READING_TIME.mul_f64(rate), FRESH_TIME.mul_f64(rate));
        let mut event = self.shown.as_ref()?;
        for next in self.skipped.iter().rev() {
            if event.yields_to(next, read) {
                event = next;
            }
        }
        (now < event.at + fresh).then_some(event)
    }
}

impl WeightedEvent {
    /// Whether it has been there so long, or weighs so little, that `next` is told in its stead. What is done by hand is
    /// told at once, or the first of a slider's many speeds would stand there.
    fn yields_to(&self, next: &Self, read: Duration) -> bool {
        next.weight > self.weight
            || next.weight == self.weight && next.weight == USER_CHANGE
            || self.weight < COMPLETE && next.at >= self.at + read
    }
}

/// More of them nobody could follow.
const MAX_SKIPPED_EVENTS: usize = 64;

fn weigh(record: &Record, state: &RunState) -> Option<(Weight, Happening)> {
    let event = match &record.what {
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
        RecordKind::AtomDone { node, .. } if is_band_done(state, *node) => ((2, 0), Happening::BandsDone(vec![*node])),
        RecordKind::Finished => (COMPLETE, Happening::Complete),
        _ => return None,
    };
    Some(event)
}

#[cfg(test)]
mod tests;

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
use crate::view::narration::status::standing;
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
        RecordKind::AtomDone { node, .. } if is_band_done(state, *node) => ((2, 0), Happening::BandsDone(vec![*node])),
        RecordKind::Finished => (END, Happening::Complete),
        _ => return None,
    };
    Some(told)
}

#[cfg(test)]
mod tests;

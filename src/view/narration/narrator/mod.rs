//! The large sentence that is read while a run goes on, and the list of the last events.

use std::collections::VecDeque;
use std::time::Duration;

use crate::balance::{Message, Party};
use crate::language::Language;
use crate::picture::atoms_in;
use crate::record::{Record, RecordKind};
use crate::time::Time;
use crate::view::narration::events::{EventLog, is_band_done, waiting_messages};
use crate::view::narration::failure::Failure;
use crate::view::narration::happening::{Happening, Retirement};
use crate::view::narration::status::status_sentence;
use crate::view::state::run_state::RunState;

/// Chooses the event whose sentence is shown, and keeps the last events. A sentence stays long enough to be read,
/// unless an event of more weight follows.
#[derive(Clone, Debug, Default)]
pub struct Narrator {
    /// The event that is shown in real time.
    shown: Option<WeightedEvent>,
    /// The last events that were skipped because there was no time to read them, the newest first. Slower playback
    /// shows them.
    skipped: VecDeque<WeightedEvent>,
    events: EventLog,
}

#[derive(Clone, Debug)]
struct WeightedEvent {
    at: Time,
    weight: Weight,
    happening: Happening,
}

/// Weight of an event: its kind, then its size. A transfer of twice the atoms has more weight.
type Weight = (u8, u32);

/// Weight of a change by the user: its sentence appears at once.
const USER_CHANGE: Weight = (4, 0);

/// Importance of missing machines: more than the change that made them fail.
const MISSED: Weight = (4, 1);

/// Importance of the end of the run.
const COMPLETE: Weight = (5, 0);

/// How long the sentence of an event is shown at most.
const FRESH_TIME: Duration = Duration::from_secs(3);

/// How long a sentence stays at least when events of no more weight follow.
const MIN_READING_TIME: Duration = Duration::from_millis(1600);

impl Narrator {
    /// Takes in a record; `state` already knows it.
    pub fn apply(&mut self, record: &Record, state: &RunState) {
        self.events.apply(record, state);
        let is_user_change = matches!(
            record.kind,
            RecordKind::SpeedSet { .. }
                | RecordKind::Paused { .. }
                | RecordKind::Resumed { .. }
                | RecordKind::LatencySet { .. }
                | RecordKind::OwnLatencySet { .. }
                | RecordKind::Condition { .. }
        );
        let event = if is_user_change {
            // The list knows the speed before the slider was dragged.
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

    /// Returns the sentence at `now`: the last event while it is fresh, else the status of the run.
    pub fn sentence(&self, state: &RunState, now: Time, language: Language) -> String {
        match self.shown_at(now, state.rate()) {
            Some(event) => event.happening.sentence(language),
            None if state.finished().is_some() => Happening::Complete.sentence(language),
            None => status_sentence(state, language),
        }
    }

    /// Returns the time of the event whose sentence is shown at `now`; `None` while the status of the run is shown.
    pub fn event_time(&self, state: &RunState, now: Time) -> Option<Time> {
        self.shown_at(now, state.rate()).map(|event| event.at)
    }

    /// The last events and their times, the newest last. Records that belong together are one event: a dragged slider,
    /// small transfers of one machine, machines that retire.
    pub fn events(&self) -> impl DoubleEndedIterator<Item = (Time, &Happening)> + ExactSizeIterator {
        self.events.iter()
    }

    /// The last events but the one whose sentence is shown at `now`: the events before it, and those after it that
    /// have to wait because it is still read.
    pub fn other_events(&self, state: &RunState, now: Time) -> impl DoubleEndedIterator<Item = (Time, &Happening)> {
        let shown = self.shown_at(now, state.rate());
        let is_shown = |(at, listed): &(Time, &Happening)| {
            shown.is_some_and(|event| event.at == *at && event.happening.tells_of(listed))
        };
        let shown = self.events().rposition(|event| is_shown(&event));
        self.events().enumerate().filter(move |(index, _)| Some(*index) != shown).map(|(_, event)| event)
    }

    /// Number of events so far, with those that are no longer kept.
    pub fn events_so_far(&self) -> usize {
        self.events.so_far()
    }

    /// Returns the event that is shown at `now`, if it is fresh, at a playback rate of `rate` run seconds per wall
    /// second.
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
    /// Whether `next` replaces it: after the reading time, or because of its weight. A change by the user replaces the
    /// one before at once; else the first of a dragged slider's speeds would stay.
    fn yields_to(&self, next: &Self, read: Duration) -> bool {
        next.weight > self.weight
            || next.weight == self.weight && next.weight == USER_CHANGE
            || self.weight < COMPLETE && next.at >= self.at + read
    }
}

/// Skipped events that are kept: nobody could follow more.
const MAX_SKIPPED_EVENTS: usize = 64;

/// Returns the event of a record and its weight; `None` if the record is not worth a sentence.
fn weigh(record: &Record, state: &RunState) -> Option<(Weight, Happening)> {
    let event = match &record.kind {
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
        // A node that is called back or let in gets an empty band.
        RecordKind::Sent { message: Message::Band(band), .. }
            if band.is_empty() && state.scheduler.survives_losses() =>
        {
            return None;
        }
        // A machine that has started afresh gets a part of the farm with the scene.
        RecordKind::Sent { to: Party::Node(to), message: Message::Band(band), .. }
            if state.scheduler.is_farm() && state.done() > 0 =>
        {
            ((1, 0), Happening::Part { to: *to, atoms: band.len() as u32 })
        }
        RecordKind::Sent { from: Party::Parent, message: Message::Band(band), .. } => {
            ((2, 0), Happening::bands(state, band))
        }
        RecordKind::Retired { .. } if state.scheduler.is_farm() => return None,
        RecordKind::Retired { node } => {
            let happening = Happening::retired(state, vec![*node]);
            let sleeps = matches!(happening, Happening::Retired { reason: Retirement::Sleeps, .. });
            ((if sleeps { 1 } else { 2 }, 0), happening)
        }
        // The bands may follow soon, with more weight.
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

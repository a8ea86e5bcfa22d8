//! What one machine did and when.

use std::time::Duration;

use crate::balance::Condition;
use crate::picture::Atom;
use crate::time::Time;

/// What one machine did and when.
#[derive(Clone, Debug, Default)]
pub struct Lane {
    /// What it traced, by time.
    pub(crate) bars: Vec<Traced>,
    /// The atom that it is tracing, and since when.
    pub(crate) open: Option<(Atom, Time)>,
    /// From when on it is in which state, by time.
    pub(crate) stays: Vec<(Time, LanePhase)>,
    /// When its worker was made to stand still, and how long.
    pub(crate) pauses: Vec<(Time, Option<Time>)>,
    /// How its machine was from when on.
    pub(crate) conditions: Vec<(Time, Condition)>,
}

/// An atom that was traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traced {
    /// When its worker began it.
    pub from: Time,
    /// When it was done.
    pub to: Time,
    /// Which.
    pub atom: Atom,
}

/// What a machine is about while it traces nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LanePhase {
    /// It waits for its band.
    #[default]
    Waits,
    /// It has atoms.
    Works,
    /// Its offer, or its request, is on its way.
    Offers,
    /// Atoms are on their way to it.
    Receives,
    /// Nobody needs it.
    Retired,
    /// Nobody needs it now: it can be woken.
    Asleep,
}

impl Lane {
    /// What it traced, by time; the atom that it is tracing is not there yet.
    pub fn bars(&self) -> &[Traced] {
        &self.bars
    }

    /// The atom that it is tracing, and since when.
    pub fn open(&self) -> Option<(Atom, Time)> {
        self.open
    }

    /// From when on it is in which state, by time.
    pub fn stays(&self) -> &[(Time, LanePhase)] {
        &self.stays
    }

    /// From when to when its worker was made to stand still; the last may go on.
    pub fn pauses(&self) -> &[(Time, Option<Time>)] {
        &self.pauses
    }

    /// How its machine was from when on; before that it was well.
    pub fn conditions(&self) -> &[(Time, Condition)] {
        &self.conditions
    }

    /// The bars that reach into a stretch of time.
    pub fn bars_in(&self, from: Time, to: Time) -> &[Traced] {
        let first = self.bars.partition_point(|bar| bar.to < from);
        let last = self.bars.partition_point(|bar| bar.from <= to);
        &self.bars[first..last.max(first)]
    }

    /// The bar at a time.
    pub fn bar_at(&self, time: Time) -> Option<Traced> {
        self.bars_in(time, time).last().copied()
    }

    /// What it is about at a time, apart from atoms that it traces.
    pub fn stay_at(&self, time: Time) -> LanePhase {
        let before = self.stays.partition_point(|(from, _)| *from <= time);
        before.checked_sub(1).map_or(LanePhase::Waits, |last| self.stays[last].1)
    }

    /// Seconds in which it traced atoms.
    pub(crate) fn busy(&self, from: Time, to: Time) -> f64 {
        let within = |start: Time, end: Time| end.min(to).since(start.max(from)).as_secs_f64();
        let open = self.open.map_or(0.0, |(_, since)| within(since, to));
        self.bars_in(from, to).iter().map(|bar| within(bar.from, bar.to)).sum::<f64>() + open
    }

    /// Seconds until `now` in which it offered help, asked, or waited for atoms on their way.
    pub(crate) fn asking(&self, now: Time) -> f64 {
        let ends = self.stays.iter().skip(1).map(|(at, _)| *at).chain([now]);
        let length = |((from, stay), end): (&(Time, LanePhase), Time)| match stay {
            LanePhase::Offers | LanePhase::Receives => end.min(now).since(*from),
            LanePhase::Waits | LanePhase::Works | LanePhase::Retired | LanePhase::Asleep => Duration::ZERO,
        };
        self.stays.iter().zip(ends).map(length).sum::<Duration>().as_secs_f64()
    }

    pub(crate) fn stay(&mut self, at: Time, stay: LanePhase) {
        // What another party told may come before what this one did earlier.
        let place = self.stays.partition_point(|(other, _)| *other <= at);
        let before = place.checked_sub(1).map(|last| self.stays[last].1);
        // Atoms on their way to a machine that has some make no difference, and what is over stays over.
        let says_nothing = before == Some(stay)
            || before == Some(LanePhase::Retired)
            || before == Some(LanePhase::Works) && stay == LanePhase::Receives;
        if !says_nothing {
            self.stays.insert(place, (at, stay));
        }
    }

    pub(crate) fn condition(&mut self, at: Time, condition: Condition) {
        self.conditions.push((at, condition));
        self.stands(at, !condition.is_running());
        if condition == Condition::Off {
            // What it had begun is lost, and it begins anew.
            self.open = None;
            self.stay(at, LanePhase::Waits);
        }
    }

    pub(crate) fn stands(&mut self, at: Time, stands: bool) {
        match (self.pauses.last_mut(), stands) {
            (Some((_, end @ None)), false) => *end = Some(at),
            (Some((_, None)), true) | (_, false) => {}
            (_, true) => self.pauses.push((at, None)),
        }
    }
}

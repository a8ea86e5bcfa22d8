//! The lane of one machine: what it did, and when.

use std::time::Duration;

use crate::balance::Condition;
use crate::picture::Atom;
use crate::time::Time;

/// What one machine did, and when.
#[derive(Clone, Debug)]
pub struct Lane {
    /// Traced atoms, by time.
    pub(crate) bars: Vec<Traced>,
    /// The atom that the machine is tracing, and when it began.
    pub(crate) open: Option<(Atom, Time)>,
    /// Phases and their beginnings, by time.
    phases: Vec<(Time, LanePhase)>,
    /// Beginning and end of each stop, by time; the last stop may have no end yet.
    stops: Vec<(Time, Option<Time>)>,
    /// Conditions and their beginnings, by time.
    conditions: Vec<(Time, Condition)>,
    speed: f64,
    is_paused: bool,
}

/// A traced atom: a bar of a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traced {
    /// When the worker began it.
    pub from: Time,
    /// When the worker had traced it.
    pub to: Time,
    /// The atom.
    pub atom: Atom,
}

/// State of a machine apart from the atoms that it traces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LanePhase {
    /// The machine has no band yet.
    NoBand,
    /// The machine has atoms.
    HasAtoms,
    /// The machine's offer, or its request, is on the way.
    Offers,
    /// Atoms for the machine are on the way.
    Receives,
    /// The machine is not needed any more.
    Retired,
    /// The machine is not needed now, and can be woken.
    Asleep,
}

impl Lane {
    /// The lane of a machine with this speed before the run begins; a spare machine is off.
    pub(crate) fn new(speed: f64, is_spare: bool) -> Self {
        let mut lane = Self {
            bars: Vec::new(),
            open: None,
            phases: Vec::new(),
            stops: Vec::new(),
            conditions: if is_spare { vec![(Time::ZERO, Condition::Off)] } else { Vec::new() },
            speed,
            is_paused: false,
        };
        lane.update_stops(Time::ZERO);
        lane
    }

    /// Traced atoms, by time, without the one that the machine is tracing.
    pub fn bars(&self) -> &[Traced] {
        &self.bars
    }

    /// The atom that the machine is tracing, and when it began.
    pub fn open(&self) -> Option<(Atom, Time)> {
        self.open
    }

    /// Phases and their beginnings, by time; before the first one the machine has no band.
    pub fn phases(&self) -> &[(Time, LanePhase)] {
        &self.phases
    }

    /// Beginning and end of each stop, by time; the last stop may have no end yet. A machine is stopped while it is
    /// paused, hung, off or at speed 0.
    pub fn stops(&self) -> &[(Time, Option<Time>)] {
        &self.stops
    }

    /// Conditions and their beginnings, by time; before the first one the machine is well.
    pub fn conditions(&self) -> &[(Time, Condition)] {
        &self.conditions
    }

    /// The bars that overlap a stretch of time.
    pub fn bars_in(&self, from: Time, to: Time) -> &[Traced] {
        let first = self.bars.partition_point(|bar| bar.to < from);
        let last = self.bars.partition_point(|bar| bar.from <= to);
        &self.bars[first..last.max(first)]
    }

    /// The bar at a time.
    pub fn bar_at(&self, time: Time) -> Option<Traced> {
        self.bars_in(time, time).last().copied()
    }

    /// The phase at a time.
    pub fn phase_at(&self, time: Time) -> LanePhase {
        let before = self.phases.partition_point(|(from, _)| *from <= time);
        before.checked_sub(1).map_or(LanePhase::NoBand, |last| self.phases[last].1)
    }

    /// Seconds until `now` in which the machine traced atoms and was not stopped; the atom that it is tracing counts.
    pub(crate) fn tracing_seconds(&self, now: Time) -> f64 {
        let open = self.open.map_or(0.0, |(_, since)| self.running_seconds(since, now));
        let bars = self.bars_in(Time::ZERO, now).iter();
        bars.map(|bar| self.running_seconds(bar.from, bar.to.min(now))).sum::<f64>() + open
    }

    /// Seconds of a stretch of time in which the machine was not stopped.
    pub(crate) fn running_seconds(&self, from: Time, to: Time) -> f64 {
        to.since(from).as_secs_f64() - self.stopped_seconds(from, to)
    }

    /// Seconds of a stretch of time in which the machine was stopped.
    pub(crate) fn stopped_seconds(&self, from: Time, to: Time) -> f64 {
        let first = self.stops.partition_point(|(_, end)| end.is_some_and(|end| end <= from));
        let overlap = |(start, end): &(Time, Option<Time>)| end.unwrap_or(to).min(to).since((*start).max(from));
        let stops = self.stops[first..].iter().take_while(|(start, _)| *start < to);
        stops.map(overlap).sum::<Duration>().as_secs_f64()
    }

    /// Seconds until `now` in which the machine's offer or request, or atoms for it, were on the way.
    pub(crate) fn on_the_way_seconds(&self, now: Time) -> f64 {
        let ends = self.phases.iter().skip(1).map(|(at, _)| *at).chain([now]);
        let length = |((from, phase), end): (&(Time, LanePhase), Time)| match phase {
            LanePhase::Offers | LanePhase::Receives => end.min(now).since(*from),
            LanePhase::NoBand | LanePhase::HasAtoms | LanePhase::Retired | LanePhase::Asleep => Duration::ZERO,
        };
        self.phases.iter().zip(ends).map(length).sum::<Duration>().as_secs_f64()
    }

    /// Notes a phase that begins at `at`.
    pub(crate) fn begin_phase(&mut self, at: Time, phase: LanePhase) {
        // A record of another party may come before an earlier one of this machine.
        let place = self.phases.partition_point(|(other, _)| *other <= at);
        let before = place.checked_sub(1).map(|last| self.phases[last].1);
        // Atoms on their way to a machine that has some make no difference, and `Retired` is final.
        let is_redundant = before == Some(phase)
            || before == Some(LanePhase::Retired)
            || before == Some(LanePhase::HasAtoms) && phase == LanePhase::Receives;
        if !is_redundant {
            self.phases.insert(place, (at, phase));
        }
    }

    /// Notes a speed, as a fraction of the reference machine.
    pub(crate) fn set_speed(&mut self, at: Time, speed: f64) {
        self.speed = speed;
        self.update_stops(at);
    }

    /// Notes a pause, or its end.
    pub(crate) fn set_paused(&mut self, at: Time, is_paused: bool) {
        self.is_paused = is_paused;
        self.update_stops(at);
    }

    /// Notes a condition. A machine that is switched off loses its atom, and begins without a band.
    pub(crate) fn set_condition(&mut self, at: Time, condition: Condition) {
        self.conditions.push((at, condition));
        self.update_stops(at);
        if condition == Condition::Off {
            self.open = None;
            self.begin_phase(at, LanePhase::NoBand);
        }
    }

    /// Begins or ends a stop if the machine's state at `at` asks for it.
    fn update_stops(&mut self, at: Time) {
        let condition = self.conditions.last().map_or(Condition::Well, |(_, condition)| *condition);
        let is_stopped = self.is_paused || self.speed == 0.0 || matches!(condition, Condition::Hung | Condition::Off);
        match (self.stops.last_mut(), is_stopped) {
            (Some((_, end @ None)), false) => *end = Some(at),
            (Some((_, None)), true) | (_, false) => {}
            (_, true) => self.stops.push((at, None)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Change = fn(&mut Lane, Time);

    fn lane(changes: &[(u64, Change)]) -> Lane {
        let mut lane = Lane::new(1.0, false);
        changes.iter().for_each(|(at, change)| change(&mut lane, Time(*at)));
        lane
    }

    #[test]
    fn stop_lasts_until_no_cause_is_left() {
        let lane = lane(&[
            (1, |lane, at| lane.set_paused(at, true)),
            (2, |lane, at| lane.set_speed(at, 0.5)),
            (3, |lane, at| lane.set_condition(at, Condition::CutOff)),
            (4, |lane, at| lane.set_speed(at, 0.0)),
            (5, |lane, at| lane.set_paused(at, false)),
            (6, |lane, at| lane.set_condition(at, Condition::Hung)),
            (7, |lane, at| lane.set_speed(at, 1.0)),
            (8, |lane, at| lane.set_condition(at, Condition::Well)),
            (9, |lane, at| lane.set_condition(at, Condition::Off)),
        ]);
        assert_eq!(lane.stops(), [(Time(1), Some(Time(8))), (Time(9), None)]);
    }

    #[test]
    fn machine_off_or_at_speed_0_is_stopped_from_the_beginning() {
        assert_eq!(Lane::new(1.0, false).stops(), []);
        assert_eq!(Lane::new(0.0, false).stops(), [(Time::ZERO, None)]);
        assert_eq!(Lane::new(1.0, true).stops(), [(Time::ZERO, None)]);
    }

    #[test]
    fn stopped_time_within_an_atom_is_not_tracing_time() {
        let at = Time::from_secs;
        let mut lane = Lane::new(1.0, false);
        lane.open = Some((3, at(1.0)));
        lane.set_paused(at(2.0), true);
        assert_eq!([3.0, 9.0].map(|now| lane.tracing_seconds(at(now))), [1.0, 1.0]);
        lane.set_paused(at(4.0), false);
        lane.open = None;
        lane.bars.push(Traced { from: at(1.0), to: at(5.0), atom: 3 });
        assert_eq!([1.5, 3.0, 4.5, 9.0].map(|now| lane.tracing_seconds(at(now))), [0.5, 1.0, 1.5, 2.0]);
        assert_eq!((lane.stopped_seconds(at(0.0), at(3.0)), lane.stopped_seconds(at(3.0), at(9.0))), (1.0, 1.0));
    }
}

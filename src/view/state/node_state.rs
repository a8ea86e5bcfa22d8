//! The state of one node.

use std::time::Duration;

use super::throughput::Throughput;
use crate::balance::Condition;
use crate::picture::Atom;
use crate::time::Time;

/// State of one node.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeState {
    /// Its speed as a fraction of the reference machine.
    pub speed: f64,
    /// Whether its worker is paused; `speed` is the speed at which it will go on.
    pub paused: bool,
    /// Condition of its machine.
    pub condition: Condition,
    /// Whether it has not joined the run yet.
    pub spare: bool,
    /// Atoms that it has traced and that count: an atom counts for one node only, also if several traced it.
    pub done: u32,
    /// The atom that its worker is tracing.
    pub atom: Option<Atom>,
    /// Whether its own offer came back, or, in a farm, the parent has no more atoms for it. In the adaptive ring it
    /// sleeps.
    pub retired: bool,
    /// Offers that it has made.
    pub offers: u32,
    /// Number of traced atoms in its last offer.
    pub offered: u32,
    /// Offers of others that it has passed on.
    pub hops: u32,
    /// Atoms that it has given to nodes that offered help.
    pub given: Parcels,
    /// Atoms that it has got for its own offers or requests.
    pub got: Parcels,
    /// Requests that it has sent to the parent.
    pub requests: u32,
    /// Its speed before the last change.
    pub(crate) previous_speed: f64,
    /// Condition of its machine before the last change.
    pub(crate) previous_condition: Condition,
    /// Atoms that were lost when it was last switched off.
    pub(crate) lost_atoms: u32,
    /// When the parent last received a message from it.
    pub(crate) last_heard: Option<Time>,
    // Signed, since the record of an atom may come before that of its band.
    pub(crate) left: i64,
    /// When its band arrived.
    pub(crate) band_at: Option<Time>,
    /// Whether its offer, or its request, is not answered yet.
    pub(crate) awaits_answer: bool,
    /// When it was done with its last atom so far.
    pub(crate) last_atom: Option<Time>,
    /// When the last of its drawn results, requests and parts were sent.
    pub(crate) last_drawn: [Option<Time>; 3],
    idle: Duration,
    idle_since: Option<Time>,
    throughput: Throughput,
    /// ∫ speed dt from time 0 to `speed_since`, in seconds of the reference machine.
    speed_seconds: f64,
    speed_since: Time,
    /// Since when it does not run; `None` while it runs.
    pub(crate) stopped_since: Option<Time>,
    /// Time in which it did not run, until `stopped_since`.
    stopped: Duration,
}

/// Number of transfers, and of the atoms in them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Parcels {
    /// Number of transfers.
    pub count: u32,
    /// Number of atoms in all of them.
    pub atoms: u32,
}

/// What a node does, as it is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Activity {
    /// The node's band has not arrived yet.
    NoBand,
    /// The node's worker traces atoms.
    Tracing,
    /// The node has atoms, but its speed is 0.
    SpeedZero,
    /// The node has atoms, but is paused.
    Paused,
    /// The node's offer of help is on its way.
    Offering,
    /// The node's request for atoms is on its way to the parent.
    Asking,
    /// The node's request has arrived, and waits at the parent.
    InLine,
    /// Atoms are on their way to the node.
    Receiving,
    /// The node has nothing to do.
    Idle,
    /// The node's own offer came back: it is not needed any more.
    Retired,
    /// Its own offer came back in the adaptive ring: it can be woken.
    Asleep,
    /// The parent has no more atoms for it.
    NoMore,
    /// Its machine hangs.
    Hung,
    /// No message reaches its machine, or comes from it.
    CutOff,
    /// Its machine is switched off.
    Off,
    /// Its machine has not joined yet.
    Spare,
    /// The picture is complete.
    Done,
}

impl Activity {
    /// Whether the node takes no part in the run, for now or for good, although the picture is not complete.
    pub fn is_out(self) -> bool {
        matches!(self, Self::Retired | Self::Asleep | Self::NoMore | Self::Off | Self::Spare)
    }
}

/// Content of one of the two places in a worker's pipe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// No atom.
    Empty,
    /// An atom that waits.
    Filled,
    /// The atom that the worker traces.
    Traced,
}

impl NodeState {
    /// Number of atoms in its queue and its pipe, with the one being traced.
    pub fn left(&self) -> u32 {
        self.left.max(0) as u32
    }

    /// Whether it has atoms and a speed to trace them at.
    pub fn computes(&self) -> bool {
        self.left() > 0 && self.runs()
    }

    /// Whether its worker would trace atoms if it had any.
    pub fn runs(&self) -> bool {
        self.speed > 0.0 && !self.is_held()
    }

    /// Whether its worker is stopped by a pause or by its machine's condition.
    fn is_held(&self) -> bool {
        self.paused || !self.condition.is_running()
    }

    /// Content of its pipe of two atoms, the traced one first.
    pub fn pipe(&self) -> [Slot; 2] {
        let first = if self.atom.is_some() && self.runs() { Slot::Traced } else { Slot::Filled };
        match self.left() {
            0 => [Slot::Empty; 2],
            1 => [first, Slot::Empty],
            _ => [first, Slot::Filled],
        }
    }

    /// Atoms a second that it has traced in the 3 s before `now`, or since its band arrived if that is later.
    pub fn rate(&self, now: Time) -> f64 {
        self.throughput.per_second(self.band_at.unwrap_or_default(), now)
    }

    /// Time from the arrival of its band to `now` in which it had no atom.
    pub fn idle(&self, now: Time) -> Duration {
        self.idle + self.idle_since.map_or(Duration::ZERO, |since| now.since(since))
    }

    /// Time until `now` in which it was paused, hung, off or at speed 0. A spare machine is not stopped.
    pub fn stopped(&self, now: Time) -> Duration {
        self.stopped + self.stopped_since.map_or(Duration::ZERO, |since| now.since(since))
    }

    /// Mean speed from time 0 to `now`; while the machine is paused, hung or off it counts 0.
    pub fn mean_speed(&self, now: Time) -> f64 {
        let now = now.max(self.speed_since);
        if now == Time::ZERO { self.effective_speed() } else { self.speed_seconds_until(now) / now.secs() }
    }

    pub(crate) fn new(speed: f64, spare: bool) -> Self {
        let condition = if spare { Condition::Off } else { Condition::Well };
        Self {
            speed,
            paused: false,
            condition,
            spare,
            done: 0,
            atom: None,
            retired: false,
            offers: 0,
            offered: 0,
            hops: 0,
            given: Parcels::default(),
            got: Parcels::default(),
            requests: 0,
            previous_speed: speed,
            previous_condition: condition,
            lost_atoms: 0,
            last_heard: None,
            left: 0,
            band_at: None,
            awaits_answer: false,
            last_atom: None,
            last_drawn: [None; 3],
            idle: Duration::ZERO,
            idle_since: None,
            throughput: Throughput::default(),
            speed_seconds: 0.0,
            speed_since: Time::ZERO,
            stopped_since: (speed == 0.0 && !spare).then_some(Time::ZERO),
            stopped: Duration::ZERO,
        }
    }

    /// Returns the node without `atoms` of its atoms.
    pub(crate) fn without(&self, atoms: u32) -> Self {
        Self { left: (self.left - i64::from(atoms)).max(0), ..self.clone() }
    }

    /// Adds atoms to its queue.
    pub(crate) fn give(&mut self, atoms: u32, at: Time) {
        self.change_left(i64::from(atoms), at);
    }

    /// Adds a number of atoms, which may be negative, and keeps account of the idle time.
    fn change_left(&mut self, atoms: i64, at: Time) {
        self.left += atoms;
        if self.left <= 0 {
            self.idle_since.get_or_insert(at);
        } else if let Some(since) = self.idle_since.take() {
            self.idle += at.since(since);
        }
    }

    /// Notes a traced atom; `counts` is false if another node's tracing of it counts.
    pub(crate) fn atom_done(&mut self, counts: bool, at: Time) {
        self.done += u32::from(counts);
        self.left -= 1;
        (self.atom, self.last_atom) = (None, Some(at));
        self.throughput.count(at);
        if self.left <= 0 && self.idle_since.is_none() {
            self.idle_since = Some(at);
        }
    }

    /// Notes that its worker could not trace its atom.
    pub(crate) fn atom_failed(&mut self) {
        (self.left, self.atom) = (self.left - 1, None);
    }

    pub(crate) fn set_speed(&mut self, speed: f64, at: Time) {
        self.add_speed_seconds(at);
        (self.previous_speed, self.speed) = (self.speed, speed);
        self.note_stop(at);
    }

    pub(crate) fn set_paused(&mut self, paused: bool, at: Time) {
        self.add_speed_seconds(at);
        self.paused = paused;
        self.note_stop(at);
    }

    pub(crate) fn set_condition(&mut self, condition: Condition, at: Time) {
        self.add_speed_seconds(at);
        self.previous_condition = std::mem::replace(&mut self.condition, condition);
        self.note_stop(at);
    }

    /// Sets the number of its atoms.
    pub(crate) fn set_left(&mut self, atoms: u32, at: Time) {
        self.change_left(i64::from(atoms) - self.left, at);
    }

    /// Keeps account of the time in which it does not run, after a change at `at`.
    fn note_stop(&mut self, at: Time) {
        if !self.runs() {
            self.stopped_since.get_or_insert(at);
        } else if let Some(since) = self.stopped_since.take() {
            self.stopped += at.since(since);
        }
    }

    fn effective_speed(&self) -> f64 {
        if self.is_held() { 0.0 } else { self.speed }
    }

    fn speed_seconds_until(&self, now: Time) -> f64 {
        self.speed_seconds + self.effective_speed() * now.since(self.speed_since).as_secs_f64()
    }

    fn add_speed_seconds(&mut self, at: Time) {
        (self.speed_seconds, self.speed_since) = (self.speed_seconds_until(at), self.speed_since.max(at));
    }
}

impl Parcels {
    pub(crate) fn add(&mut self, atoms: u32) {
        self.count += 1;
        self.atoms += atoms;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paused_node_has_atoms_and_does_not_trace_them() {
        let mut node = NodeState::new(0.5, false);
        assert_eq!((node.pipe(), node.computes()), ([Slot::Empty; 2], false));
        node.give(9, Time::ZERO);
        node.atom = Some(3);
        assert_eq!((node.pipe(), node.computes()), ([Slot::Traced, Slot::Filled], true));
        node.set_paused(true, Time::from_secs(1.0));
        assert_eq!((node.pipe(), node.computes(), node.speed), ([Slot::Filled, Slot::Filled], false, 0.5));
        node.set_paused(false, Time::from_secs(2.0));
        assert!(node.computes());
        (0..8).for_each(|_| node.atom_done(true, Time::from_secs(3.0)));
        assert_eq!(node.pipe(), [Slot::Filled, Slot::Empty]);
    }

    #[test]
    fn mean_speed_follows_changes_and_pauses() {
        let mut node = NodeState::new(1.0, false);
        let at = Time::from_secs;
        assert_eq!((node.mean_speed(Time::ZERO), node.mean_speed(at(3.0))), (1.0, 1.0));
        node.set_speed(0.5, at(2.0));
        assert_eq!(node.mean_speed(at(4.0)), 0.75);
        node.set_paused(true, at(4.0));
        node.set_speed(0.25, at(5.0));
        node.set_paused(false, at(6.0));
        assert_eq!(node.mean_speed(at(6.0)), 0.5);
        assert_eq!((node.stopped(at(6.0)), node.stopped_since), (Duration::from_secs(2), None));
        assert_eq!(node.mean_speed(at(10.0)), 0.4);
    }
}

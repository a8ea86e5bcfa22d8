//! What is known of one node.

use std::time::Duration;

use super::throughput::Rate;
use crate::balance::Condition;
use crate::picture::Atom;
use crate::time::Time;

/// What is known of one node.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeState {
    /// Its speed as a fraction of the reference machine.
    pub speed: f64,
    /// Its worker was made to stand still; the speed is the one at which it will go on.
    pub paused: bool,
    /// How its machine is.
    pub condition: Condition,
    /// It has not joined the run yet: its seat is empty.
    pub spare: bool,
    /// Atoms that it has traced, and that count: of one that is traced twice, or lost, the others' or the next result may.
    pub done: u32,
    /// The atom that its worker is tracing.
    pub atom: Option<Atom>,
    /// Its own offer came back; in a farm, the parent has no more for it. In a ring that adapts it sleeps.
    pub retired: bool,
    /// Offers that it has made.
    pub offers: u32,
    /// What its last offer says that it has traced.
    pub offered: u32,
    /// Offers of others that it has passed on.
    pub hops: u32,
    /// What it has given to nodes that offered help.
    pub given: Parcels,
    /// What it has got for its own offers, or when it asked for it.
    pub got: Parcels,
    /// How often it has asked the parent for atoms.
    pub requests: u32,
    /// Its speed before that was last set.
    pub(crate) speed_before: f64,
    /// How its machine was before that changed.
    pub(crate) condition_before: Condition,
    /// Atoms that were lost when it was last switched off.
    pub(crate) took: u32,
    /// When the parent last heard of it.
    pub(crate) heard: Option<Time>,
    // Signed, since the record of an atom may come before that of the band it belongs to.
    pub(crate) left: i64,
    /// When its band arrived.
    pub(crate) band_at: Option<Time>,
    /// Its offer, or its request, is not answered yet.
    pub(crate) offer_out: bool,
    /// When it was done with its last atom so far.
    pub(crate) last_atom: Option<Time>,
    /// When the last of its results, its requests and its parts left that are drawn.
    pub(crate) last_drawn: [Option<Time>; 3],
    idle: Duration,
    idle_since: Option<Time>,
    rate: Rate,
    /// The integral of its speed over time in seconds, from the beginning to `speed_since`.
    ran: f64,
    speed_since: Time,
}

/// Transfers, and the atoms in them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Parcels {
    /// How many transfers.
    pub count: u32,
    /// How many atoms in all of them.
    pub atoms: u32,
}

/// What a node is seen doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Activity {
    /// Its band has not arrived yet.
    NoBand,
    /// Its worker traces atoms.
    Tracing,
    /// It has atoms, but its speed is 0.
    SpeedZero,
    /// It has atoms, but it is paused.
    Paused,
    /// Its offer of help is on its way.
    Offering,
    /// Its request for atoms is on its way to the parent.
    Asking,
    /// Its request has arrived, and the parent has not answered it yet.
    InLine,
    /// Atoms are on their way to it.
    Receiving,
    /// It has nothing to do.
    Idle,
    /// Its own offer came back: nobody needs it.
    Retired,
    /// The same in a ring that adapts: it can be woken.
    Asleep,
    /// The parent has no more atoms for it.
    NoMore,
    /// Its machine hangs.
    Hung,
    /// Nothing comes from its machine, or to it.
    CutOff,
    /// Its machine is switched off.
    Off,
    /// Its seat is empty: its machine may join.
    Spare,
    /// The picture is complete.
    Done,
}

impl Activity {
    /// Whether it has no part in the run, for now or for good, although the picture is not complete.
    pub fn is_out(self) -> bool {
        matches!(self, Self::Retired | Self::Asleep | Self::NoMore | Self::Off | Self::Spare)
    }
}

/// One of the two places in a worker's pipe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// Nothing is in it.
    Empty,
    /// An atom waits in it.
    Filled,
    /// The worker traces the atom in it.
    Traced,
}

impl NodeState {
    /// Atoms in its queue and its pipe, the one being traced included.
    pub fn left(&self) -> u32 {
        self.left.max(0) as u32
    }

    /// Whether it has atoms and a speed to trace them at.
    pub fn computes(&self) -> bool {
        self.left() > 0 && self.runs()
    }

    /// Whether its worker would trace atoms if it had any.
    pub fn runs(&self) -> bool {
        self.speed > 0.0 && !self.stands()
    }

    /// Whether its worker stands still, whatever its speed.
    fn stands(&self) -> bool {
        self.paused || matches!(self.condition, Condition::Hung | Condition::Off)
    }

    /// What its pipe holds, the atom that is traced first: two atoms, while it has as many.
    pub fn pipe(&self) -> [Slot; 2] {
        let first = if self.atom.is_some() && self.runs() { Slot::Traced } else { Slot::Filled };
        match self.left() {
            0 => [Slot::Empty; 2],
            1 => [first, Slot::Empty],
            _ => [first, Slot::Filled],
        }
    }

    /// Atoms a second that it has traced in the 3 s before `now`, or since its band came if that is less long ago.
    pub fn rate(&self, now: Time) -> f64 {
        self.rate.per_second(self.band_at.unwrap_or_default(), now)
    }

    /// How long it has had nothing to trace, since its band came until `now`.
    pub fn idle(&self, now: Time) -> Duration {
        self.idle + self.idle_since.map_or(Duration::ZERO, |since| now.since(since))
    }

    /// The mean of its speed from the run's beginning until `now`; paused it has none.
    pub fn mean_speed(&self, now: Time) -> f64 {
        let now = now.max(self.speed_since);
        if now == Time::ZERO { self.speed_now() } else { self.ran_until(now) / now.secs() }
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
            speed_before: speed,
            condition_before: condition,
            took: 0,
            heard: None,
            left: 0,
            band_at: None,
            offer_out: false,
            last_atom: None,
            last_drawn: [None; 3],
            idle: Duration::ZERO,
            idle_since: None,
            rate: Rate::default(),
            ran: 0.0,
            speed_since: Time::ZERO,
        }
    }

    /// The same node before it got so many atoms.
    pub(crate) fn without(&self, atoms: u32) -> Self {
        Self { left: (self.left - i64::from(atoms)).max(0), ..self.clone() }
    }

    pub(crate) fn give(&mut self, atoms: u32, at: Time) {
        self.give_signed(i64::from(atoms), at);
    }

    fn give_signed(&mut self, atoms: i64, at: Time) {
        self.left += atoms;
        if self.left <= 0 {
            self.idle_since.get_or_insert(at);
        } else if let Some(since) = self.idle_since.take() {
            self.idle += at.since(since);
        }
    }

    /// It has traced an atom, which may count or not.
    pub(crate) fn atom_done(&mut self, counts: bool, at: Time) {
        self.done += u32::from(counts);
        self.left -= 1;
        (self.atom, self.last_atom) = (None, Some(at));
        self.rate.count(at);
        if self.left <= 0 && self.idle_since.is_none() {
            self.idle_since = Some(at);
        }
    }

    /// Its worker could not trace its atom.
    pub(crate) fn atom_failed(&mut self) {
        (self.left, self.atom) = (self.left - 1, None);
    }

    pub(crate) fn set_speed(&mut self, speed: f64, at: Time) {
        self.keep_ran(at);
        (self.speed_before, self.speed) = (self.speed, speed);
    }

    pub(crate) fn set_paused(&mut self, paused: bool, at: Time) {
        self.keep_ran(at);
        self.paused = paused;
    }

    pub(crate) fn set_condition(&mut self, condition: Condition, at: Time) {
        self.keep_ran(at);
        self.condition_before = std::mem::replace(&mut self.condition, condition);
    }

    /// It knows of so many atoms that it has.
    pub(crate) fn holds(&mut self, atoms: u32, at: Time) {
        self.give_signed(i64::from(atoms) - self.left, at);
    }

    fn speed_now(&self) -> f64 {
        if self.stands() { 0.0 } else { self.speed }
    }

    fn ran_until(&self, now: Time) -> f64 {
        self.ran + self.speed_now() * now.since(self.speed_since).as_secs_f64()
    }

    fn keep_ran(&mut self, at: Time) {
        (self.ran, self.speed_since) = (self.ran_until(at), self.speed_since.max(at));
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
    fn a_paused_node_has_atoms_but_does_not_trace_them() {
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
    fn the_mean_speed_knows_of_changes_and_pauses() {
        let mut node = NodeState::new(1.0, false);
        let at = Time::from_secs;
        assert_eq!((node.mean_speed(Time::ZERO), node.mean_speed(at(3.0))), (1.0, 1.0));
        node.set_speed(0.5, at(2.0));
        assert_eq!(node.mean_speed(at(4.0)), 0.75);
        node.set_paused(true, at(4.0));
        node.set_speed(0.25, at(5.0));
        node.set_paused(false, at(6.0));
        assert_eq!(node.mean_speed(at(6.0)), 0.5);
        assert_eq!(node.mean_speed(at(10.0)), 0.4);
    }
}

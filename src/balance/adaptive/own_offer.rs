//! The node's own offer of help: at most one is under way, and a lost one is given up after a lease.

use std::time::Duration;

use crate::picture::Atom;
use crate::time::Time;

/// The last offer that the node has made, and the count of lost ones.
#[derive(Debug, Default)]
pub(super) struct OwnOffer {
    /// Time that the last offer bears, which identifies it.
    made: Option<Time>,
    /// Offers lost so far; each makes the next offer start at another stop.
    lost: u16,
    /// Atom during which the node offered early; it does so once for each atom.
    early_during: Option<Atom>,
}

impl OwnOffer {
    /// Makes an offer. Returns the time that it bears: `now`, or 1 ns after the last offer, since no two offers of a
    /// node bear the same time.
    pub fn make(&mut self, now: Time) -> Time {
        let made = self.made.map_or(now, |last| now.max(last + Duration::from_nanos(1)));
        self.made = Some(made);
        made
    }

    /// Returns whether the offer that bears the time `made` is the last one, and was not given up for another.
    pub fn is_last(&self, made: Time) -> bool {
        self.made == Some(made)
    }

    /// Returns when the last offer counts as lost, if it is still under way then.
    pub fn expiry(&self, lease: Duration) -> Option<Time> {
        self.made.map(|made| made + lease)
    }

    /// Counts the last offer as lost.
    pub fn give_up(&mut self) {
        self.lost = self.lost.wrapping_add(1);
    }

    /// Returns the first of the `stops` stops for the next offer.
    pub fn first_stop(&self, stops: u16) -> u16 {
        self.lost.checked_rem(stops).unwrap_or(0)
    }

    /// Returns when to offer early while `in_hand` is traced: a round trip of two `hop`s before the atoms run out at
    /// `runs_out`. `None` if the node has offered during this atom, or does not know yet how long a hop takes.
    pub fn early_expiry(&self, in_hand: Atom, runs_out: Time, hop: Duration) -> Option<Time> {
        (self.early_during != Some(in_hand) && !hop.is_zero()).then(|| runs_out - hop * 2)
    }

    /// Notes that the node offers early during the atom in hand.
    pub fn note_early(&mut self, in_hand: Option<Atom>) {
        self.early_during = in_hand;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NS: Duration = Duration::from_nanos(1);

    #[test]
    fn offers_bear_different_times_and_only_the_last_counts() {
        let mut offer = OwnOffer::default();
        assert_eq!(offer.expiry(10 * NS), None);
        assert_eq!([7, 7, 3, 20].map(|now| offer.make(Time(now))), [7, 8, 9, 20].map(Time));
        assert!(offer.is_last(Time(20)) && !offer.is_last(Time(9)));
        assert_eq!(offer.expiry(10 * NS), Some(Time(30)));
    }

    #[test]
    fn lost_offers_change_the_first_stop() {
        let mut offer = OwnOffer::default();
        let mut stops = Vec::new();
        for _ in 0..4 {
            stops.push(offer.first_stop(3));
            offer.give_up();
        }
        assert_eq!(stops, [0, 1, 2, 0]);
        assert_eq!(offer.first_stop(0), 0, "a node alone has no stops");
    }

    #[test]
    fn early_offer_leaves_a_round_trip_before_and_comes_once_for_each_atom() {
        let mut offer = OwnOffer::default();
        assert_eq!(offer.early_expiry(5, Time(100), Duration::ZERO), None);
        assert_eq!(offer.early_expiry(5, Time(100), 10 * NS), Some(Time(80)));
        offer.note_early(Some(5));
        assert_eq!(offer.early_expiry(5, Time(100), 10 * NS), None);
        assert_eq!(offer.early_expiry(6, Time(120), 10 * NS), Some(Time(100)));
    }
}

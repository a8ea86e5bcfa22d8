//! The messages that are still drawn.

use std::ops::Deref;

use super::flight::{Cargo, Flight};
use crate::balance::Party;
use crate::time::Time;

/// Messages in the order in which they were sent. Messages that are not drawn any more are removed now and then.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flights {
    flights: Vec<Flight>,
    /// Number of messages after the last sweep.
    swept: usize,
    /// Playback rate for all messages, at most 1; `None` before it is set.
    rate: Option<f64>,
}

impl Flights {
    /// Adds a message that is sent now.
    pub fn push(&mut self, flight: Flight) {
        // A sweep visits all messages, so it waits until their number has doubled.
        if self.flights.len() > 2 * self.swept + 16 {
            // What is kept does not depend on the playback rate.
            self.flights.retain(|earlier| earlier.latest_gone() > flight.sent);
            self.swept = self.flights.len();
        }
        self.flights.push(Flight { rate: self.rate(), ..flight });
        self.join(self.flights.len() - 1);
    }

    /// Lets the parcels from `first` on join earlier parcels of their pairs: many small ones could not be told apart.
    fn join(&mut self, first: usize) {
        for i in first..self.flights.len() {
            let (earlier, later) = self.flights.split_at_mut(i);
            if matches!(later[0].cargo, Cargo::Transfer(_) | Cargo::Again(_)) {
                later[0].carrier = None;
                later[0].carrier = earlier.iter().rev().find_map(|flight| flight.carrier_of(&later[0]));
            }
        }
    }

    /// Marks a message as lost ([`Flight::lose`]).
    pub fn lose(&mut self, id: u64, at: Time, at_end: bool) {
        if let Some(flight) = self.flights.iter_mut().rfind(|flight| flight.id == id) {
            flight.lose(at, at_end);
        }
        self.join(0);
    }

    /// Delays the messages that are on a link at `at` until `until`.
    pub fn hold(&mut self, (from, to): (Party, Party), at: Time, until: Time) {
        let is_there = |flight: &&mut Flight| (flight.from, flight.to) == (from, to) && flight.arrives > at;
        self.flights.iter_mut().filter(is_there).for_each(|flight| flight.hold(at, until));
        self.join(0);
    }

    /// Playback rate: run seconds per wall second, at most 1.
    pub fn rate(&self) -> f64 {
        self.rate.unwrap_or(1.0)
    }

    /// Sets the playback rate, in run seconds per wall second. A rate above 1 counts as 1.
    pub fn set_rate(&mut self, rate: f64) {
        let rate = rate.min(1.0);
        if self.rate.replace(rate) != Some(rate) {
            self.flights.iter_mut().for_each(|flight| flight.rate = rate);
            self.join(0);
        }
    }
}

impl Deref for Flights {
    type Target = [Flight];

    fn deref(&self) -> &[Flight] {
        &self.flights
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::Message;

    #[test]
    fn sweep_removes_messages_that_are_not_drawn_any_more() {
        let mut flights = Flights::default();
        let offer = Message::offer(0, 0);
        for second in 0..1000 {
            let at = Time::from_secs(f64::from(second));
            let arrives = if second % 100 == 0 { Time(u64::MAX) } else { at };
            flights.push(Flight::new(0, (Party::Node(0), Party::Node(1)), &offer, at, arrives));
        }
        assert!(flights.len() < 50, "{}", flights.len());
        assert_eq!(flights.iter().filter(|flight| flight.arrives == Time(u64::MAX)).count(), 10);
        assert!(flights.is_sorted_by_key(|flight| flight.sent));
    }
}

//! The messages that can still be seen.

use std::ops::Deref;

use super::flight::Flight;
use crate::balance::Party;
use crate::time::Time;

/// Messages in the order in which they left. Those that can be seen no more are swept out now and then.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flights {
    flights: Vec<Flight>,
    /// How many the last sweep left.
    swept: usize,
    /// How fast time goes for those to come; `None`: as it does.
    rate: Option<f64>,
}

impl Flights {
    /// One more has left.
    pub fn push(&mut self, flight: Flight) {
        // A sweep looks at all of them, and so waits until they are twice as many.
        if self.flights.len() > 2 * self.swept + 16 {
            // What is kept does not depend on how fast time just goes.
            self.flights.retain(|earlier| earlier.gone_at_last() > flight.sent);
            self.swept = self.flights.len();
        }
        self.flights.push(Flight { rate: self.rate(), ..flight });
    }

    /// A message is lost now.
    pub fn lose(&mut self, id: u64, at: Time, at_its_end: bool) {
        if let Some(flight) = self.flights.iter_mut().rfind(|flight| flight.id == id) {
            flight.lose(at, at_its_end);
        }
    }

    /// What is still on this way at `at` arrives at `until`.
    pub fn hold(&mut self, (from, to): (Party, Party), at: Time, until: Time) {
        let is_there = |flight: &&mut Flight| (flight.from, flight.to) == (from, to) && flight.arrives > at;
        self.flights.iter_mut().filter(is_there).for_each(|flight| flight.hold(at, until));
    }

    /// How many of the run's seconds go by in a second, at most one.
    pub fn rate(&self) -> f64 {
        self.rate.unwrap_or(1.0)
    }

    /// From now on so many of the run's seconds go by in a second; where that is more than one, flights are as long as
    /// at one.
    pub fn set_rate(&mut self, rate: f64) {
        let rate = rate.min(1.0);
        if self.rate.replace(rate) != Some(rate) {
            self.flights.iter_mut().for_each(|flight| flight.rate = rate);
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
    fn those_that_are_gone_are_swept_out_and_others_stay() {
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

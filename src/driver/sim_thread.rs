//! A run in virtual time, played as fast as a clock goes, so that one can watch it and take a hand in it.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crossbeam_channel::{Receiver, Sender};

use super::clock::Clock;
use super::dedup::PlacedOnce;
use super::endpoint::FLUSH;
use super::render_all::TracedPicture;
use super::{TracePixels, Update};
use crate::balance::{Message, Party};
use crate::picture::{Atom, Division};
use crate::record::{Record, RecordKind};
use crate::runlog::Header;
use crate::scenario::Command;
use crate::sim::Sim;
use crate::time::Time;

/// What a simulation's thread shares with whoever started it.
pub(super) struct SharedSim {
    pub clock: Clock,
    going: Mutex<Going>,
    orders: Sender<SimOrder>,
}

/// How the run's time follows from the clock's.
#[derive(Clone, Copy)]
struct Going {
    /// The clock's time at which the run's was `at`; `None` until all costs are known.
    since: Option<Time>,
    at: Time,
    rate: f64,
}

/// What counts as infinitely fast, so that no time is infinite.
const FASTEST: f64 = 1e6;

impl Going {
    fn at(&self, clock: Time) -> Time {
        let nanos = |since: Time| (clock.since(since).as_nanos() as f64 * self.rate) as u64;
        Time(self.at.0.saturating_add(self.since.map_or(0, nanos)))
    }
}

/// What a simulation's thread is told.
pub(super) enum SimOrder {
    Do(Command),
    /// The clock goes on, or has ended.
    Wake,
}

impl SharedSim {
    /// What they share, and the orders as they come.
    pub fn new() -> (Self, Receiver<SimOrder>) {
        // Unbounded, but with one order for each thing that the user does.
        let (orders, receiver) = crossbeam_channel::unbounded();
        let going = Mutex::new(Going { since: None, at: Time::ZERO, rate: 1.0 });
        (Self { clock: Clock::start(), going, orders }, receiver)
    }

    /// The run's time: it begins once all costs are known.
    pub fn now(&self) -> Time {
        self.going().at(self.clock.now())
    }

    /// Lets the run's time go so many times as fast as the clock's.
    pub fn set_rate(&self, rate: f64) {
        let mut going = self.going();
        let now = self.clock.now();
        *going = Going { since: going.since.map(|_| now), at: going.at(now), rate: rate.clamp(0.0, FASTEST) };
        drop(going);
        self.order(SimOrder::Wake);
    }

    /// The run begins.
    fn begin(&self) {
        self.going().since = Some(self.clock.now());
    }

    /// How long the clock takes until the run's time is `next`.
    fn until(&self, next: Time) -> Duration {
        let going = self.going();
        let left = next.since(going.at(self.clock.now())).as_secs_f64();
        // Rounded up: who wakes too early would only wait again.
        Duration::try_from_secs_f64(left / going.rate).unwrap_or(Duration::MAX).saturating_add(Duration::from_nanos(1))
    }

    /// No panic leaves it half changed.
    fn going(&self) -> MutexGuard<'_, Going> {
        self.going.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn command(&self, command: Command) {
        self.order(SimOrder::Do(command));
    }

    pub fn resume(&self) {
        self.clock.resume();
        self.order(SimOrder::Wake);
    }

    pub fn stop(&self) {
        self.clock.end();
        self.order(SimOrder::Wake);
    }

    /// A thread that has ended needs no orders.
    fn order(&self, order: SimOrder) {
        let _ = self.orders.send(order);
    }
}

/// Traces the picture to learn what it costs, then plays the run to its end.
///
/// # Errors
/// A sentence, if it was stopped or could not trace.
pub(super) fn play(
    header: &Header,
    shared: &SharedSim,
    orders: &Receiver<SimOrder>,
    trace: &TracePixels,
    updates: &Sender<Update>,
) -> Result<(), String> {
    const STOPPED: &str = "the run was stopped";
    let is_over = || shared.clock.has_ended();
    let whole = TracedPicture::trace(header.division, trace, &|_| {}, &is_over)?.ok_or(STOPPED)?;
    let costs = whole.costs();
    let mut sim = Sim::new(header, &[], move |atom| costs[atom as usize]);
    let mut news = Updates {
        division: header.division,
        whole,
        on_their_way: BTreeMap::new(),
        firsts: PlacedOnce::new(header.division),
        updates,
    };
    shared.begin();
    loop {
        if is_over() {
            return Err(STOPPED.into());
        }
        let (paused, now) = (shared.clock.is_paused(), shared.now());
        let mut records = Vec::new();
        sim.advance(now, &mut |record| records.push(record));
        let next = match sim.next() {
            None if sim.is_finished() => {
                news.tell(records);
                let _ = updates.send(Update::Rays(news.whole.counts));
                return Ok(());
            }
            next => next.filter(|_| !paused),
        };
        let order = if records.is_empty() {
            match next {
                Some(next) => orders.recv_timeout(shared.until(next)).ok(),
                // Never disconnected: whoever started this thread holds what is shared until it ends.
                None => orders.recv().ok(),
            }
        } else {
            news.tell(std::mem::take(&mut records));
            // A batch, as the threads of other runs send them.
            orders.recv_timeout(FLUSH).ok()
        };
        for order in order.into_iter().chain(orders.try_iter()) {
            if let SimOrder::Do(command) = order {
                sim.advance(shared.now(), &mut |record| records.push(record));
                sim.command(command, &mut |record| records.push(record));
            }
        }
        news.tell(records);
    }
}

/// Tells whoever watches.
struct Updates<'a> {
    division: Division,
    whole: TracedPicture,
    on_their_way: BTreeMap<u64, Vec<Range<Atom>>>,
    firsts: PlacedOnce,
    updates: &'a Sender<Update>,
}

impl Updates<'_> {
    /// Tells these records, and the pixels that the parent has received by them. That nobody listens any more does no harm.
    fn tell(&mut self, records: Vec<Record>) {
        let mut atoms = Vec::new();
        for record in &records {
            match &record.what {
                RecordKind::Sent { id, message: Message::Results(ranges), .. } => {
                    self.on_their_way.insert(*id, ranges.clone());
                }
                RecordKind::Received { id, by: Party::Parent } => {
                    let ranges = self.on_their_way.remove(id).into_iter().flatten();
                    atoms.extend(ranges.flat_map(|range| self.firsts.take(range)));
                }
                _ => {}
            }
        }
        if !records.is_empty() {
            let _ = self.updates.send(Update::Records(records));
        }
        if !atoms.is_empty() {
            let places = atoms.iter().map(|range| self.division.pixels_of(range));
            let of = |place: Range<u32>| &self.whole.pixels[place.start as usize..place.end as usize];
            let pixels = places.flat_map(of).copied().collect();
            let _ = self.updates.send(Update::Placed { atoms, pixels });
        }
    }
}

//! A run in virtual time, played at the speed of a clock, so that the user can watch it and give it commands.

use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crossbeam_channel::{Receiver, Sender};

use super::clock::Clock;
use super::dedup::PlacedOnce;
use super::endpoint::FLUSH;
use super::error::RunError;
use super::render_all::{CostedPicture, TracedPicture};
use super::{TracePixels, Update};
use crate::picture::{Colour, Division};
use crate::record::Record;
use crate::runlog::{Header, ResultsInFlight};
use crate::scenario::Command;
use crate::sim::Sim;
use crate::time::Time;

/// The state that the simulation's thread shares with the run's owner.
pub(super) struct SharedSim {
    pub clock: Clock,
    time_scale: Mutex<TimeScale>,
    orders: Sender<SimOrder>,
}

/// The map from the clock's time to the run's time.
#[derive(Clone, Copy)]
struct TimeScale {
    /// The clock's time at which the run's time was `run_time`; `None` until all costs are known.
    clock_time: Option<Time>,
    run_time: Time,
    /// Run seconds per second of the clock.
    rate: f64,
}

/// Largest rate, so that no time is infinite.
const MAX_RATE: f64 = 1e6;

impl TimeScale {
    /// Returns the run's time at a time of the clock.
    fn at(&self, clock: Time) -> Time {
        let nanos = |since: Time| (clock.since(since).as_nanos() as f64 * self.rate) as u64;
        Time(self.run_time.0.saturating_add(self.clock_time.map_or(0, nanos)))
    }
}

/// An order to the simulation's thread.
pub(super) enum SimOrder {
    Execute(Command),
    /// The clock has changed: continue, or end.
    Wake,
}

impl SharedSim {
    /// Creates the shared state, and the receiver of the orders.
    pub fn new() -> (Self, Receiver<SimOrder>) {
        // Unbounded, but there is only one order for each command of the user.
        let (orders, receiver) = crossbeam_channel::unbounded();
        let time_scale = Mutex::new(TimeScale { clock_time: None, run_time: Time::ZERO, rate: 1.0 });
        (Self { clock: Clock::start(), time_scale, orders }, receiver)
    }

    /// Returns the run's time, which starts when all costs are known.
    pub fn now(&self) -> Time {
        self.time_scale().at(self.clock.now())
    }

    /// Sets the rate, in run seconds per second of the clock.
    pub fn set_rate(&self, rate: f64) {
        let mut scale = self.time_scale();
        let now = self.clock.now();
        let clock_time = scale.clock_time.map(|_| now);
        *scale = TimeScale { clock_time, run_time: scale.at(now), rate: rate.clamp(0.0, MAX_RATE) };
        drop(scale);
        self.order(SimOrder::Wake);
    }

    /// Starts the run's time.
    fn begin(&self) {
        self.time_scale().clock_time = Some(self.clock.now());
    }

    /// Returns how long the clock takes until the run's time is `next`.
    fn until(&self, next: Time) -> Duration {
        let scale = self.time_scale();
        let left = next.since(scale.at(self.clock.now())).as_secs_f64();
        // Rounded up: a thread that wakes too early would only wait again.
        Duration::try_from_secs_f64(left / scale.rate).unwrap_or(Duration::MAX).saturating_add(Duration::from_nanos(1))
    }

    /// Takes the lock, also after a panic of another thread: no panic leaves the map half changed.
    fn time_scale(&self) -> MutexGuard<'_, TimeScale> {
        self.time_scale.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Executes a command at the run's present time.
    pub fn command(&self, command: Command) {
        self.order(SimOrder::Execute(command));
    }

    /// Lets the clock continue.
    pub fn resume(&self) {
        self.clock.resume();
        self.order(SimOrder::Wake);
    }

    /// Ends the run.
    pub fn stop(&self) {
        self.clock.end();
        self.order(SimOrder::Wake);
    }

    /// Sends an order to the thread, if it has not ended.
    fn order(&self, order: SimOrder) {
        let _ = self.orders.send(order);
    }
}

/// The picture of a run in virtual time.
pub(super) enum SimPicture {
    /// It has to be traced, with this function.
    Untraced(Box<TracePixels>),
    /// It is traced already.
    Traced(Arc<CostedPicture>),
}

/// Traces the picture to get the costs of its atoms, unless it is traced, then plays the run to its end.
///
/// # Errors
/// If the run was stopped, or the picture could not be traced.
pub(super) fn play(
    header: &Header,
    shared: &SharedSim,
    orders: &Receiver<SimOrder>,
    picture: &SimPicture,
    updates: &Sender<Update>,
) -> Result<(), RunError> {
    let cancel = shared.clock.ended();
    let traced;
    let (pixels, costs, counts) = match picture {
        SimPicture::Untraced(trace) => {
            traced = TracedPicture::trace(header.division, trace, &|_| {}, cancel)?.ok_or(RunError::Stopped)?;
            (&traced.pixels, traced.costs(), traced.counts)
        }
        SimPicture::Traced(picture) => (&picture.pixels, picture.costs.of_atoms(header.division), picture.counts),
    };
    let mut sim = Sim::new(header, &[], move |atom| costs[atom as usize]);
    let mut updater = Updater {
        division: header.division,
        pixels,
        in_flight: ResultsInFlight::default(),
        placed_once: PlacedOnce::new(header.division),
        updates,
    };
    shared.begin();
    loop {
        if cancel.is_cancelled() {
            return Err(RunError::Stopped);
        }
        let (paused, now) = (shared.clock.is_paused(), shared.now());
        let mut records = Vec::new();
        sim.advance(now, &mut |record| records.push(record));
        let next = match sim.next() {
            None if sim.is_finished() => {
                updater.send(records);
                let _ = updates.send(Update::Rays(counts));
                return Ok(());
            }
            next => next.filter(|_| !paused),
        };
        let order = if records.is_empty() {
            match next {
                Some(next) => orders.recv_timeout(shared.until(next)).ok(),
                // Never disconnected: the run's owner holds the sender until this thread ends.
                None => orders.recv().ok(),
            }
        } else {
            updater.send(std::mem::take(&mut records));
            // Wait, so that the next records form a batch, as in other runs.
            orders.recv_timeout(FLUSH).ok()
        };
        for order in order.into_iter().chain(orders.try_iter()) {
            if let SimOrder::Execute(command) = order {
                sim.advance(shared.now(), &mut |record| records.push(record));
                sim.command(command, &mut |record| records.push(record));
            }
        }
        updater.send(records);
    }
}

/// Sends the updates to the run's owner.
struct Updater<'a> {
    division: Division,
    /// All pixels in scan order.
    pixels: &'a [Colour],
    in_flight: ResultsInFlight,
    placed_once: PlacedOnce,
    updates: &'a Sender<Update>,
}

impl Updater<'_> {
    /// Sends these records, and the pixels that the parent receives with them, if the owner still listens.
    fn send(&mut self, records: Vec<Record>) {
        let mut atoms = Vec::new();
        for record in &records {
            let received = self.in_flight.apply(&record.kind);
            atoms.extend(received.into_iter().flat_map(|range| self.placed_once.take(range)));
        }
        if !records.is_empty() {
            let _ = self.updates.send(Update::Records(records));
        }
        if !atoms.is_empty() {
            let places = atoms.iter().map(|range| self.division.pixels_of(range));
            let of = |place: Range<u32>| &self.pixels[place.start as usize..place.end as usize];
            let pixels = places.flat_map(of).copied().collect();
            let _ = self.updates.send(Update::Placed { atoms, pixels });
        }
    }
}

//! A run in virtual time, played as fast as a clock goes, so that one can watch it and take a hand in it.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use crossbeam_channel::{Receiver, Sender};

use super::clock::Clock;
use super::port::FLUSH;
use super::whole::Whole;
use super::{TracePixels, Update};
use crate::balance::{Message, Party};
use crate::picture::{Atom, Division};
use crate::record::{Record, What};
use crate::runlog::Header;
use crate::scenario::Command;
use crate::sim::Sim;
use crate::time::Time;

/// What a simulation's thread shares with whoever started it.
pub(super) struct Shared {
    pub clock: Clock,
    /// The clock's time at which the run began, in nanoseconds.
    begun: AtomicU64,
    orders: Sender<Order>,
}

/// What a simulation's thread is told.
pub(super) enum Order {
    Do(Command),
    /// The clock goes on, or has ended.
    Wake,
}

impl Shared {
    /// What they share, and the orders as they come.
    pub fn new() -> (Self, Receiver<Order>) {
        // Unbounded, but with one order for each thing that the user does.
        let (orders, receiver) = crossbeam_channel::unbounded();
        (Self { clock: Clock::start(), begun: AtomicU64::new(u64::MAX), orders }, receiver)
    }

    /// The run's time: it begins once all costs are known.
    pub fn now(&self) -> Time {
        Time(self.clock.now().0.saturating_sub(self.begun.load(Ordering::SeqCst)))
    }

    pub fn command(&self, command: Command) {
        self.order(Order::Do(command));
    }

    pub fn resume(&self) {
        self.clock.resume();
        self.order(Order::Wake);
    }

    pub fn stop(&self) {
        self.clock.end();
        self.order(Order::Wake);
    }

    /// A thread that has ended needs no orders.
    fn order(&self, order: Order) {
        let _ = self.orders.send(order);
    }
}

/// Traces the picture to learn what it costs, then plays the run to its end.
///
/// # Errors
/// A sentence, if it was stopped or could not trace.
pub(super) fn play(
    header: &Header,
    shared: &Shared,
    orders: &Receiver<Order>,
    trace: &TracePixels,
    updates: &Sender<Update>,
) -> Result<(), String> {
    const STOPPED: &str = "the run was stopped";
    let is_over = || shared.clock.has_ended();
    let whole = Whole::trace(header.division, trace, &|_| {}, &is_over)?.ok_or(STOPPED)?;
    let costs = whole.costs();
    let mut sim = Sim::new(header, &[], move |atom| costs[atom as usize]);
    let mut news = News { division: header.division, whole, on_their_way: BTreeMap::new(), updates };
    shared.begun.store(shared.clock.now().0, Ordering::SeqCst);
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
                Some(next) => orders.recv_timeout(next.since(now)).ok(),
                // Never disconnected: whoever started this thread holds what is shared until it ends.
                None => orders.recv().ok(),
            }
        } else {
            news.tell(std::mem::take(&mut records));
            // A batch, as the threads of other runs send them.
            orders.recv_timeout(FLUSH).ok()
        };
        for order in order.into_iter().chain(orders.try_iter()) {
            if let Order::Do(command) = order {
                sim.advance(shared.now(), &mut |record| records.push(record));
                sim.command(command, &mut |record| records.push(record));
            }
        }
        news.tell(records);
    }
}

/// Tells whoever watches.
struct News<'a> {
    division: Division,
    whole: Whole,
    on_their_way: BTreeMap<u64, Vec<Range<Atom>>>,
    updates: &'a Sender<Update>,
}

impl News<'_> {
    /// Tells these records, and the pixels that the parent has received by them. That nobody listens any more does no harm.
    fn tell(&mut self, records: Vec<Record>) {
        let mut atoms = Vec::new();
        for record in &records {
            match &record.what {
                What::Sent { id, message: Message::Results(ranges), .. } => {
                    self.on_their_way.insert(*id, ranges.clone());
                }
                What::Received { id, by: Party::Parent } => {
                    atoms.extend(self.on_their_way.remove(id).into_iter().flatten());
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

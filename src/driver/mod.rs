//! Executes the protocol: each party a thread, each node an emulated machine, each message on a link.
//!
//! The threads of a run: one a node (its handler and its worker), one for the parent, and one that started them, waits
//! for their end, and says how it went. Parties share nothing but the clock and each other's inboxes.
//!
//! Each party has a time of its own, at which it acts and which its records bear. It is that of the emulated machine: a
//! thread may wake a little late, or work a little ahead of the clock, but what it does is dated to when the machine
//! would have done it, and what comes of it is due accordingly. Machines at full speed are not emulated: their times
//! are the clock's.

mod clock;
mod link;
mod machine;
mod meter;
mod node_thread;
mod parent_thread;
mod port;
mod probe;
mod shared;

pub use machine::{auto_pace, cores};
pub use probe::{Probe, probe};

use std::any::Any;
use std::ops::Range;
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use crossbeam_channel::{Receiver, Sender};

use crate::balance::{NodeId, Party};
use crate::picture::{Atom, Colour};
use crate::record::Record;
use crate::runlog::Header;
use crate::time::Time;
use crate::tracer::{RayCounts, Scratch, Tracer};
use node_thread::NodeThread;
use parent_thread::ParentThread;
use port::Port;
use shared::{Command, Parcel, Shared};

/// What a run tells whoever started it, in merged batches; the channel is unbounded, but each atom crosses it once.
#[derive(Debug)]
pub enum Update {
    /// Records of one party, in the order of their times; those of different parties may interleave.
    Records(Vec<Record>),
    /// Pixels that the parent has placed.
    Placed {
        /// The atoms, in the order of `pixels`.
        atoms: Vec<Range<Atom>>,
        /// Their pixels, one atom after the other.
        pixels: Vec<Colour>,
    },
    /// How many rays a node's worker has traced; its thread has ended.
    Rays(RayCounts),
    /// All threads have ended and the picture is complete; the last update.
    Finished,
    /// The run cannot go on (a sentence says why); the last update.
    Failed(String),
}

/// Appends the colours of pixels (positions in scan order) to a vector, as [`Tracer::trace`] does.
pub type TracePixels = dyn Fn(Range<u32>, &mut Scratch, &mut Vec<Colour>) + Send + Sync;

/// A run that goes on in its own threads. Dropping it stops them and waits for them.
pub struct Run {
    shared: Arc<Shared>,
    updates: Receiver<Update>,
    /// The thread that waits for the others; `None` if it could not be started.
    supervisor: Option<JoinHandle<()>>,
}

impl Run {
    /// Starts the run that `header` describes. Its own options are all in the header, so that a saved run can be
    /// started again.
    ///
    /// # Panics
    /// If the header has no speeds, or more than 65,535.
    pub fn start(tracer: Arc<Tracer>, header: &Header) -> Self {
        Self::start_with(move |pixels, scratch, out| tracer.trace(pixels, scratch, out), header)
    }

    /// [`Run::start`] with anything in the tracer's place: work of a known cost, or one that fails.
    pub fn start_with(
        trace: impl Fn(Range<u32>, &mut Scratch, &mut Vec<Colour>) + Send + Sync + 'static,
        header: &Header,
    ) -> Self {
        let nodes = header.speeds.len();
        assert!((1..=usize::from(NodeId::MAX)).contains(&nodes), "a run of {nodes} nodes is impossible");
        let (shared, inboxes) = Shared::new(header);
        let shared = Arc::new(shared);
        let (sender, updates) = crossbeam_channel::unbounded();
        let supervisor = {
            let (shared, header, sender) = (shared.clone(), header.clone(), sender.clone());
            let supervise = move || supervise(&header, &shared, inboxes, &trace, &sender);
            thread::Builder::new().name("run".into()).spawn(supervise)
        };
        if let Err(error) = &supervisor {
            let _ = sender.send(Update::Failed(format!("no thread could be started: {error}")));
        }
        Self { shared, updates, supervisor: supervisor.ok() }
    }

    /// What has happened since, oldest first.
    pub fn updates(&self) -> &Receiver<Update> {
        &self.updates
    }

    /// The run's clock; it stands still while the run is paused.
    pub fn now(&self) -> Time {
        self.shared.clock.now()
    }

    /// Changes a node's speed (0 to 1) at once, in the middle of an atom too. At 0 its worker stands still, but the
    /// node still answers messages. A node that has ended does not mind.
    pub fn set_speed(&self, node: NodeId, speed: f64) {
        // NaN is not above 0 either.
        let speed = if speed > 0.0 { speed.min(1.0) } else { 0.0 };
        self.shared.command(node, Command::Speed(speed));
    }

    /// Makes a node's worker stand still at once, in the middle of an atom too, or go on at the node's speed; the node
    /// still answers messages. A speed that is set meanwhile counts when the worker goes on. A node that has ended does
    /// not mind.
    pub fn set_paused(&self, node: NodeId, paused: bool) {
        self.shared.command(node, Command::Pause(paused));
    }

    /// Changes the latency of all links for the messages that leave from now on; none overtakes an earlier one. The
    /// parent records a change, unless it has ended.
    pub fn set_latency(&self, latency: Duration) {
        self.shared.set_latency(latency);
    }

    /// Stops the run's clock, and with it all machines and all messages.
    pub fn pause(&self) {
        self.shared.clock.pause();
    }

    /// Lets the run go on after [`Run::pause`].
    pub fn resume(&self) {
        self.shared.clock.resume();
    }
}

impl Drop for Run {
    fn drop(&mut self) {
        self.shared.stop();
        if let Some(supervisor) = self.supervisor.take() {
            // It reports the panics of the others and has none of its own.
            let _ = supervisor.join();
        }
    }
}

/// Runs all parties on threads of their own and tells, once all have ended, how it went.
fn supervise(
    header: &Header,
    shared: &Shared,
    inboxes: Vec<Receiver<Parcel>>,
    trace: &TracePixels,
    updates: &Sender<Update>,
) {
    let nodes = header.speeds.len();
    let outcome = thread::scope(|scope| {
        let mut threads = Vec::new();
        let mut outcome = Ok(());
        for (index, inbox) in inboxes.into_iter().enumerate() {
            let updates = updates.clone();
            // The parent's inbox is the last, and so the nodes are there before it starts them.
            let (me, name) = if index < nodes {
                (Party::Node(index as NodeId), format!("node {index}"))
            } else {
                (Party::Parent, "parent".to_owned())
            };
            let party = move || {
                let _guard = StopOnPanic(shared);
                let port = Port::new(me, header, shared, inbox, updates);
                match me {
                    Party::Node(id) => NodeThread::new(id, header, port, trace).run(),
                    Party::Parent => ParentThread::new(header, port).run(),
                }
            };
            match thread::Builder::new().name(name.clone()).spawn_scoped(scope, party) {
                Ok(thread) => threads.push((name, thread)),
                Err(error) => {
                    shared.stop();
                    outcome = Err(format!("the thread of {name} could not be started: {error}"));
                    break;
                }
            }
        }
        for (name, thread) in threads {
            if let Err(panic) = thread.join() {
                outcome = outcome.and(Err(format!("{name} failed: {}", said(&*panic))));
            }
        }
        outcome
    });
    let last = match outcome {
        Err(why) => Update::Failed(why),
        Ok(()) if shared.is_stopped() => Update::Failed("the run was stopped".into()),
        Ok(()) => Update::Finished,
    };
    // Whoever dropped the run no longer listens.
    let _ = updates.send(last);
}

/// Stops the run if the thread that holds it panics, so that nobody waits for it for ever.
struct StopOnPanic<'run>(&'run Shared);

impl Drop for StopOnPanic<'_> {
    fn drop(&mut self) {
        if thread::panicking() {
            self.0.stop();
        }
    }
}

/// What a panic said.
fn said(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no reason given")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::What;
    use crate::runlog::examples::header;

    /// The emulation does not depend on how busy this computer is: in the machine's own time an atom takes exactly what
    /// it cost, at the machine's rate.
    #[test]
    fn an_emulated_machine_takes_as_long_as_its_speed_and_pace_say() {
        let header = Header { pace: 0.5, ..header(&[0.5, 0.1]) };
        let trace = |pixels: Range<u32>, _: &mut Scratch, out: &mut Vec<Colour>| {
            let spin = |pixel| (0..1000).fold(pixel as f32, |x: f32, _| (x + 1.3).sin());
            out.extend(pixels.map(|pixel| [spin(pixel); 3]));
        };
        let run = Run::start_with(trace, &header);
        let updates: Vec<Update> =
            run.updates().iter().take_while(|update| !matches!(update, Update::Finished)).collect();
        let mut started = [Time::ZERO; 2];
        let mut atoms = 0;
        for record in
            updates.iter().flat_map(|update| if let Update::Records(records) = update { &records[..] } else { &[] })
        {
            match record.what {
                What::AtomStarted { node, .. } => started[usize::from(node)] = record.at,
                What::AtomDone { node, cost, .. } => {
                    let rate = header.speeds[usize::from(node)] * header.pace;
                    let took = record.at.since(started[usize::from(node)]);
                    assert!(took.abs_diff(cost.div_f64(rate)) <= Duration::from_nanos(1), "{took:?} for {cost:?}");
                    atoms += 1;
                }
                _ => {}
            }
        }
        assert_eq!(atoms, header.division.atoms());
    }
}

//! A run on its own threads, and its control: commands, pauses, the end.

use std::ops::Range;
use std::sync::Arc;
use std::thread;

use crossbeam_channel::{Receiver, Sender};

use super::error::RunError;
use super::render_all::CostedPicture;
use super::run_context::RunContext;
use super::shared::{Inboxes, SharedRun};
use super::sim_thread::SimPicture;
use super::supervisor::{Supervisor, Threads};
use super::{TracePixels, Update};
use super::{node_thread, pair_threads, sim_thread, stealing};
use crate::balance::NodeId;
use crate::picture::Colour;
use crate::runlog::{Driver, Header};
use crate::scenario::Command;
use crate::time::Time;
use crate::tracer::{Scratch, Tracer};

/// A run on its own threads. Dropping it stops them and waits for them.
pub struct Run {
    control: Control,
    supervisor: Supervisor,
}

/// The state that the run's owner shares with its threads, by driver.
enum Control {
    Parties(Arc<SharedRun>),
    Sim(Arc<sim_thread::SharedSim>),
}

impl Run {
    /// Starts the run that `header` describes. The header has all settings, so that a saved run can be started again.
    ///
    /// # Panics
    /// If the header has no speeds, or more than 65,535.
    pub fn start(tracer: Arc<Tracer>, header: &Header) -> Self {
        Self::start_with(move |pixels, scratch, out| tracer.trace(pixels, scratch, out), header)
    }

    /// Does the same as [`Run::start`] with any function in place of the tracer: work of a known cost, or one that
    /// panics.
    pub fn start_with(
        trace: impl Fn(Range<u32>, &mut Scratch, &mut Vec<Colour>) + Send + Sync + 'static,
        header: &Header,
    ) -> Self {
        let nodes = header.speeds.len();
        assert!((1..=usize::from(NodeId::MAX)).contains(&nodes), "a run of {nodes} nodes is impossible");
        let its_header = header.clone();
        match header.driver {
            Driver::Sim => Self::start_sim(its_header, SimPicture::Untraced(Box::new(trace))),
            Driver::Threads | Driver::Pairs | Driver::WorkStealing => {
                let header = if header.driver == Driver::WorkStealing { stealing::header(header) } else { its_header };
                let (shared, inboxes) = SharedRun::new(&header);
                let (its, trace): (_, Arc<TracePixels>) = (Arc::clone(&shared), Arc::new(trace));
                let supervise = move |updates: &Sender<Update>| {
                    supervise(RunContext { header: &header, shared: &its, trace: &trace, updates }, inboxes)
                };
                Self { control: Control::Parties(shared), supervisor: Supervisor::start("run", supervise) }
            }
        }
    }

    /// Starts the run that `header` describes in virtual time, with a picture that is traced already.
    ///
    /// # Panics
    /// If the picture is of another size.
    pub fn start_traced(picture: Arc<CostedPicture>, header: &Header) -> Self {
        assert_eq!(picture.pixels.len(), header.size.pixels() as usize, "the picture of the run");
        Self::start_sim(header.clone(), SimPicture::Traced(picture))
    }

    fn start_sim(header: Header, picture: SimPicture) -> Self {
        let (shared, orders) = sim_thread::SharedSim::new();
        let shared = Arc::new(shared);
        let its = Arc::clone(&shared);
        let play = move |updates: &Sender<Update>| sim_thread::play(&header, &its, &orders, &picture, updates);
        Self { control: Control::Sim(shared), supervisor: Supervisor::start("run", play) }
    }

    /// Returns the updates, oldest first.
    pub fn updates(&self) -> &Receiver<Update> {
        self.supervisor.updates()
    }

    /// Returns the time of the run's clock, which stands still while the run is paused.
    pub fn now(&self) -> Time {
        match &self.control {
            Control::Parties(shared) => shared.clock.now(),
            Control::Sim(shared) => shared.now(),
        }
    }

    /// Executes a command at once, even in the middle of an atom. A command to a node or a parent that has ended has no
    /// effect. Machines and links fail only where a node is one thread, and in virtual time.
    pub fn command(&self, command: Command) {
        let command = command.clamped();
        match &self.control {
            Control::Parties(shared) => shared.command(command),
            Control::Sim(shared) => shared.command(command),
        }
    }

    /// Sets the speed of a run in virtual time, in run seconds per second; infinite means as fast as possible. Has no
    /// effect on other runs: the pace of their header is fixed.
    pub fn set_rate(&self, rate: f64) {
        if let Control::Sim(shared) = &self.control {
            shared.set_rate(rate);
        }
    }

    /// Pauses the run's clock, and with it all machines and all messages.
    pub fn pause(&self) {
        match &self.control {
            Control::Parties(shared) => shared.clock.pause(),
            Control::Sim(shared) => shared.clock.pause(),
        }
    }

    /// Lets the run continue after [`Run::pause`].
    pub fn resume(&self) {
        match &self.control {
            Control::Parties(shared) => shared.clock.resume(),
            Control::Sim(shared) => shared.resume(),
        }
    }

    /// Tells all threads to end and returns at once. The last update is then [`Update::Failed`], unless the run was
    /// over already.
    pub fn stop(&self) {
        match &self.control {
            Control::Parties(shared) => shared.stop(),
            Control::Sim(shared) => shared.stop(),
        }
    }

    /// Returns whether all threads of the run have ended.
    pub fn has_ended(&self) -> bool {
        self.supervisor.has_ended()
    }
}

impl Drop for Run {
    fn drop(&mut self) {
        self.stop();
        self.supervisor.join();
    }
}

/// Runs all parties on their own threads until all have ended.
fn supervise(context: RunContext<'_>, inboxes: Inboxes) -> Result<(), RunError> {
    thread::scope(|scope| {
        let mut threads = Threads::new(scope, || context.shared.stop());
        match context.header.driver {
            Driver::Pairs => pair_threads::start(context, inboxes, &mut threads),
            Driver::WorkStealing => stealing::run(context, inboxes, &mut threads),
            Driver::Threads | Driver::Sim => node_thread::start(context, inboxes, &mut threads),
        }
        threads.join()
    })?;
    if let Some(failure) = context.shared.failure() {
        return Err(failure.into());
    }
    if context.shared.is_stopped() { Err(RunError::Stopped) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::balance::Condition;
    use crate::record::RecordKind;
    use crate::runlog::examples::header;

    /// The emulation does not depend on the load of this computer: in the machine's own time an atom takes exactly its
    /// cost at the machine's rate.
    #[test]
    fn emulated_machine_takes_as_long_as_speed_and_pace_say() {
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
            match record.kind {
                RecordKind::AtomStarted { node, .. } => started[usize::from(node)] = record.at,
                RecordKind::AtomDone { node, cost, .. } => {
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

    /// A machine that hangs continues where it stopped.
    #[test]
    fn hang_prolongs_an_atom_by_its_length() {
        let header = Header { pace: 0.02, ..header(&[0.5]) };
        let trace = |pixels: Range<u32>, _: &mut Scratch, out: &mut Vec<Colour>| {
            let spin = |pixel| (0..1000).fold(pixel as f32, |x: f32, _| (x + 1.3).sin());
            out.extend(pixels.map(|pixel| [spin(pixel); 3]));
        };
        let run = Run::start_with(trace, &header);
        for condition in [Condition::Hung, Condition::Well].into_iter().cycle().take(8) {
            thread::sleep(Duration::from_millis(3));
            run.command(Command::Condition { node: 0, condition });
        }
        let updates = run.updates().iter().take_while(|update| !matches!(update, Update::Finished));
        let records: Vec<_> = updates
            .flat_map(|update| if let Update::Records(records) = update { records } else { Vec::new() })
            .collect();
        let (mut since, mut hung, mut atoms) = (Time::ZERO, None, 0);
        for record in records.iter() {
            match record.kind {
                RecordKind::AtomStarted { .. } => since = record.at,
                RecordKind::Condition { condition: Condition::Hung, .. } => hung = Some(record.at),
                // The part of the hang that fell into this atom does not count.
                RecordKind::Condition { condition: Condition::Well, .. } => {
                    since += record.at.since(hung.take().expect("it hung").max(since));
                }
                RecordKind::AtomDone { cost, .. } => {
                    assert_eq!(hung, None, "a machine that hangs has finished an atom");
                    let (took, takes) = (record.at.since(since), cost.div_f64(0.01));
                    assert!(took.abs_diff(takes) <= Duration::from_nanos(10), "{took:?} for {cost:?}");
                    atoms += 1;
                }
                _ => {}
            }
        }
        assert_eq!(atoms, header.division.atoms());
    }
}

//! What the threads of a run are given.

use std::sync::Arc;

use crossbeam_channel::{Receiver, Sender};

use super::endpoint::Endpoint;
use super::parent_thread::ParentThread;
use super::shared::{Parcel, Shared};
use super::supervisor::Threads;
use super::worker::Worker;
use super::{TracePixels, Update};
use crate::balance::{NodeId, Party};
use crate::runlog::Header;

/// What all threads of a run are given.
#[derive(Clone, Copy)]
pub(super) struct RunContext<'run> {
    pub header: &'run Header,
    pub shared: &'run Arc<Shared>,
    pub trace: &'run Arc<TracePixels>,
    pub updates: &'run Sender<Update>,
}

impl<'run> RunContext<'run> {
    /// The port of `me`, to be made on its own thread.
    pub fn port(self, me: Party, inbox: Receiver<Parcel>) -> Endpoint {
        Endpoint::new(me, self.header, self.shared, inbox, self.updates.clone())
    }

    /// The worker of node `id`, to be made on its own thread.
    pub fn worker(self, id: NodeId, inbox: Receiver<Parcel>) -> Worker {
        Worker::new(id, self.header, self.port(Party::Node(id), inbox), Arc::clone(self.trace))
    }

    /// Starts the parent, which starts the nodes: they should be there.
    pub fn start_parent<'scope, Stop>(self, inbox: Receiver<Parcel>, threads: &mut Threads<'scope, '_, Stop>)
    where
        'run: 'scope,
        Stop: Fn() + Copy + Send + 'scope,
    {
        let parent = move || {
            ParentThread::new(self.header, self.port(Party::Parent, inbox), Arc::clone(self.trace)).run();
        };
        threads.start("parent", parent);
    }
}

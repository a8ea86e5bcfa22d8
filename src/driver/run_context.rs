//! The context of a run's threads.

use std::sync::Arc;

use crossbeam_channel::{Receiver, Sender};

use super::endpoint::Endpoint;
use super::parent_thread::ParentThread;
use super::shared::{Envelope, SharedRun};
use super::supervisor::Threads;
use super::worker::Worker;
use super::{TracePixels, Update};
use crate::balance::{NodeId, Party};
use crate::runlog::Header;

/// The context that all threads of a run get.
#[derive(Clone, Copy)]
pub(super) struct RunContext<'run> {
    pub header: &'run Header,
    pub shared: &'run Arc<SharedRun>,
    pub trace: &'run Arc<TracePixels>,
    pub updates: &'run Sender<Update>,
}

impl<'run> RunContext<'run> {
    /// Creates the endpoint of `me`; call it on the party's own thread.
    pub fn endpoint(self, me: Party, inbox: Receiver<Envelope>) -> Endpoint {
        Endpoint::new(me, self.header, self.shared, inbox, self.updates.clone())
    }

    /// Creates the worker of node `id`; call it on the worker's own thread.
    pub fn worker(self, id: NodeId, inbox: Receiver<Envelope>) -> Worker {
        Worker::new(id, self.header, self.endpoint(Party::Node(id), inbox), Arc::clone(self.trace))
    }

    /// Starts the parent's thread, after those of the nodes: the parent sends their bands.
    pub fn start_parent<'scope, Stop>(self, inbox: Receiver<Envelope>, threads: &mut Threads<'scope, '_, Stop>)
    where
        'run: 'scope,
        Stop: Fn() + Copy + Send + 'scope,
    {
        let parent = move || {
            ParentThread::new(self.header, self.endpoint(Party::Parent, inbox), Arc::clone(self.trace)).run();
        };
        threads.start("parent", parent);
    }
}

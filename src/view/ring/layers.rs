//! The layers of the ring's drawing.

use crate::view::draw::display_list::Mark;

/// A layer of the ring's drawing. A later one covers an earlier one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum RingLayer {
    /// The rail and the spokes.
    Tracks,
    /// Traced atoms on their way to the parent.
    Results,
    /// Offers and their trails.
    Offers,
    /// Machines and their labels.
    Machines,
    /// The centre: the parent, or the result of the run.
    Centre,
    /// Requests of a farm, their answers, and the queue at the parent.
    FarmMessages,
    /// Messages that wake a machine.
    Wakes,
    /// Atoms on their way to a machine.
    Parcels,
    /// Crosses where messages were lost.
    Losses,
}

const LAYERS: usize = RingLayer::Losses as usize + 1;

/// The marks of the ring's drawing, a list for each layer.
#[derive(Default)]
pub(crate) struct RingMarks([Vec<Mark>; LAYERS]);

impl RingMarks {
    /// The marks of a layer, in the order in which they are drawn.
    pub(crate) fn layer(&mut self, layer: RingLayer) -> &mut Vec<Mark> {
        &mut self.0[layer as usize]
    }

    /// Joins the layers, the lowest first.
    pub(crate) fn joined(self) -> Vec<Mark> {
        self.0.into_iter().flatten().collect()
    }
}

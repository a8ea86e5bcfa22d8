//! Positions in a timeline.

use super::time_window::TimeWindow;
use crate::balance::NodeId;
use crate::time::Time;

/// Positions in a timeline of some size. Lengths are in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimelineLayout {
    /// Width of the timeline.
    pub width: f32,
    /// Height of the words and the strip above the lanes.
    pub header_height: f32,
    /// Height of the axis below the lanes.
    pub axis_height: f32,
    /// Height of a lane, including the gap below it.
    pub lane_height: f32,
    /// Number of lanes.
    pub lanes: usize,
}

/// Top of the strip above the lanes that shows how many machines trace; the words stand above it.
pub(super) const STRIP_TOP_PX: f32 = 20.0;
const STRIP_HEIGHT_PX: f32 = 20.0;

impl TimelineLayout {
    /// Lays out a number of lanes in a width and a height. A low timeline has no header and no axis.
    pub fn new(lanes: usize, width: f32, height: f32) -> Self {
        let (header_height, axis_height) =
            if height > 120.0 { (STRIP_TOP_PX + STRIP_HEIGHT_PX, 18.0) } else { (0.0, 0.0) };
        let lane_height = ((height - header_height - axis_height) / lanes.max(1) as f32).min(26.0);
        Self { width, header_height, axis_height, lane_height, lanes }
    }

    /// Returns the top and the bottom of a lane.
    pub fn lane(&self, node: NodeId) -> [f32; 2] {
        let top = self.header_height + f32::from(node) * self.lane_height;
        [top, top + self.lane_height - if self.lane_height > 8.0 { 2.0 } else { 1.0 }]
    }

    /// Returns the node whose lane is at `y`.
    pub fn node_at(&self, y: f32) -> Option<NodeId> {
        let lane = ((y - self.header_height) / self.lane_height).floor();
        (lane >= 0.0 && lane < self.lanes as f32).then_some(lane as NodeId)
    }

    /// Returns the bottom of the last lane.
    pub fn bottom(&self) -> f32 {
        self.header_height + self.lane_height * self.lanes as f32
    }

    /// Returns the x of a time; a time far outside the window is clamped.
    pub(super) fn x(&self, window: &TimeWindow, time: Time) -> f32 {
        (window.share(time).clamp(-1.0, 2.0) * f64::from(self.width)) as f32
    }

    /// Returns the left and the right of a span of time, clipped to the timeline.
    pub(super) fn span(&self, window: &TimeWindow, from: Time, to: Time) -> [f32; 2] {
        [self.x(window, from).max(0.0), self.x(window, to).min(self.width)]
    }

    /// Returns the y of the middle of a lane.
    pub(super) fn middle(&self, node: NodeId) -> f32 {
        let [top, bottom] = self.lane(node);
        (top + bottom) / 2.0
    }
}

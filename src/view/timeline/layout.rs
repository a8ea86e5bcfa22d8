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

/// Greatest height of a lane.
const MAX_LANE_HEIGHT_PX: f32 = 44.0;

/// Distances between the numbers of lanes.
const LABEL_STEPS: [u16; 15] = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10_000, 20_000, 50_000];

impl TimelineLayout {
    /// Lays out a number of lanes in a width and a height. A low timeline has no header and no axis.
    pub fn new(lanes: usize, width: f32, height: f32) -> Self {
        let (header_height, axis_height) =
            if height > 120.0 { (STRIP_TOP_PX + STRIP_HEIGHT_PX, 18.0) } else { (0.0, 0.0) };
        let lane_height = ((height - header_height - axis_height) / lanes.max(1) as f32).min(MAX_LANE_HEIGHT_PX);
        Self { width, header_height, axis_height, lane_height, lanes }
    }

    /// Returns the top and the bottom of a lane.
    pub fn lane(&self, node: NodeId) -> [f32; 2] {
        let top = self.header_height + f32::from(node) * self.lane_height;
        // Lanes of less than a few pixels have no room for a whole pixel between them.
        let gap = if self.lane_height > 8.0 { 2.0 } else { (0.25 * self.lane_height).min(1.0) };
        [top, top + self.lane_height - gap]
    }

    /// Returns the lanes whose numbers have room if each number is this high: all of them, or those with round numbers.
    pub fn numbered(&self, text_height: f32) -> impl Iterator<Item = NodeId> + use<> {
        let step = LABEL_STEPS.into_iter().find(|&step| f32::from(step) * self.lane_height >= text_height);
        let step = step.unwrap_or(u16::MAX);
        // Every second lane, and more, begins with lane 2, 5, 10 …
        (1..)
            .map(move |number: u16| number.saturating_mul(step))
            .take(self.lanes / usize::from(step))
            .map(|name| name - 1)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_many_lanes_are_round_and_do_not_touch() {
        let numbered = |lanes, height| {
            let layout = TimelineLayout::new(lanes, 800.0, height);
            let nodes: Vec<NodeId> = layout.numbered(13.0).collect();
            let middles = nodes.iter().map(|&node| layout.middle(node)).collect::<Vec<_>>();
            assert!(middles.windows(2).all(|pair| pair[1] - pair[0] >= 12.9), "{middles:?}");
            assert!(nodes.iter().all(|&node| layout.lane(node)[0] < layout.lane(node)[1]));
            nodes.iter().map(|node| node + 1).collect::<Vec<_>>()
        };
        assert_eq!(numbered(4, 200.0), [1, 2, 3, 4]);
        assert_eq!(numbered(32, 280.0)[..3], [2, 4, 6]);
        assert_eq!(numbered(1000, 280.0), [100, 200, 300, 400, 500, 600, 700, 800, 900, 1000]);
        assert!(numbered(65_535, 280.0).len() > 3);
        // One lane always has its number.
        assert_eq!(numbered(1, 30.0), [1]);
    }
}

//! Markers on the time line: changes by the user, retired machines, and the end.

use crate::balance::{Condition, NodeId};
use crate::record::{Record, RecordKind};
use crate::time::Time;
use crate::view::narration::happening::Happening;
use crate::view::state::run_state::RunState;

/// A marker on the time line.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Its time.
    pub at: Time,
    /// Its kind.
    pub kind: MarkerKind,
    /// Its event, for a sentence.
    pub happening: Happening,
}

/// Kind of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkerKind {
    /// A machine's speed was changed.
    Speed(NodeId),
    /// A machine was paused, or continues.
    Pause(NodeId),
    /// A machine failed, or is well again.
    Condition(NodeId, Condition),
    /// A latency was changed.
    Latency,
    /// A machine retired.
    Retired(NodeId),
    /// The picture is complete.
    Complete,
}

/// The markers of a run, in the order of time.
#[derive(Clone, Debug, Default)]
pub struct Markers(Vec<Marker>);

impl Markers {
    /// Takes in a record; `state` already knows it. Records of different parties may come a little out of order.
    pub fn apply(&mut self, record: &Record, state: &RunState) {
        let kind = match &record.kind {
            RecordKind::SpeedSet { node, .. } => MarkerKind::Speed(*node),
            RecordKind::Paused { node } | RecordKind::Resumed { node } => MarkerKind::Pause(*node),
            RecordKind::Condition { node, condition } => MarkerKind::Condition(*node, *condition),
            RecordKind::LatencySet { .. } | RecordKind::OwnLatencySet { .. } => MarkerKind::Latency,
            RecordKind::Retired { node } => MarkerKind::Retired(*node),
            RecordKind::Finished => MarkerKind::Complete,
            _ => return,
        };
        let Some(happening) = Happening::of(record, state) else { return };
        let marker = Marker { at: record.at, kind, happening };
        // A dragged slider makes many records: only the last has a marker.
        let drags = |last: &Marker| last.kind == kind && matches!(kind, MarkerKind::Speed(_) | MarkerKind::Latency);
        match self.0.last_mut() {
            Some(last) if drags(last) && marker.at.since(last.at) < DRAG_TIME => *last = marker,
            _ => {
                let place = self.0.partition_point(|other| other.at <= marker.at);
                self.0.insert(place, marker);
            }
        }
    }

    /// Returns all markers, in the order of time.
    pub fn all(&self) -> &[Marker] {
        &self.0
    }

    /// Returns the markers within `reach` of `time`, the nearest first.
    pub fn near(&self, time: Time, reach: std::time::Duration) -> Vec<&Marker> {
        let away = |marker: &Marker| marker.at.since(time).max(time.since(marker.at));
        let mut near: Vec<_> = self.0.iter().filter(|marker| away(marker) <= reach).collect();
        near.sort_by_key(|marker| away(marker));
        near
    }
}

/// Changes by one slider within this time share a marker.
const DRAG_TIME: std::time::Duration = std::time::Duration::from_secs(1);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::Language;
    use crate::view::tests::sample_runs;

    #[test]
    fn dragged_slider_is_one_marker_and_every_retirement_its_own() {
        let header = sample_runs::header(&[1.0, 1.0, 0.1], 300);
        let (mut state, mut markers) = (RunState::new(&header), Markers::default());
        let mut records = sample_runs::records(&header);
        let half = records.len() / 2;
        let at = records[half].at;
        for (i, speed) in [0.9, 0.6, 0.2].into_iter().enumerate() {
            let kind = RecordKind::SpeedSet { node: 1, speed };
            records.insert(half + 1 + i, Record { at: Time(at.0 + i as u64), kind });
        }
        for record in &records {
            state.apply(record);
            markers.apply(record, &state);
        }
        let speeds: Vec<_> = markers.all().iter().filter(|marker| marker.kind == MarkerKind::Speed(1)).collect();
        assert_eq!((speeds.len(), speeds[0].at), (1, Time(at.0 + 2)));
        let sentence = speeds[0].happening.sentence(Language::English);
        assert!(sentence.starts_with("Machine 2 now runs at 20 %"), "{sentence}");
        let retired = markers.all().iter().filter(|marker| matches!(marker.kind, MarkerKind::Retired(_))).count();
        assert_eq!(retired, state.nodes().iter().filter(|node| node.retired).count());
        assert_eq!(markers.all().last().map(|marker| marker.kind), Some(MarkerKind::Complete));
        assert!(markers.all().is_sorted_by_key(|marker| marker.at));
        let near = markers.near(Time(at.0 + 5), std::time::Duration::from_nanos(10));
        assert!(near.first().is_some_and(|marker| marker.kind == MarkerKind::Speed(1)));
    }
}

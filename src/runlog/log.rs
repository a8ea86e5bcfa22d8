//! The run log: a header and the records of the run, in the order of time.

use std::time::Duration;

use super::Header;
use crate::record::{Record, RecordKind};
use crate::time::Time;

/// The header and the records of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunLog {
    /// Settings of the run.
    pub header: Header,
    records: Vec<Record>,
    /// The line at which its file is cut off, from 1.
    pub(super) cut_off_at: Option<usize>,
}

impl RunLog {
    /// Creates a log without records.
    pub fn new(header: Header) -> Self {
        Self { header, records: Vec::new(), cut_off_at: None }
    }

    /// Returns all records in the order of time. Records of one party at the same time stay in the order in which the
    /// party made them.
    pub fn records(&self) -> &[Record] {
        &self.records
    }

    /// Returns the line, from 1, in the middle of which the log's file is cut off; `None` if its file is whole.
    pub fn cut_off_at(&self) -> Option<usize> {
        self.cut_off_at
    }

    /// Returns the time of the last record; 0 if there is none.
    pub fn end(&self) -> Time {
        self.records.last().map_or(Time::ZERO, |last| last.at)
    }

    /// Returns the number of records that are not later than `time`.
    pub fn until(&self, time: Time) -> usize {
        self.records.partition_point(|record| record.at <= time)
    }

    /// Returns the cost of each atom in CPU time; `None` for atoms that are not traced.
    pub fn costs(&self) -> Vec<Option<Duration>> {
        let mut costs = vec![None; self.header.division.atoms() as usize];
        for record in &self.records {
            if let RecordKind::AtomDone { atom, cost, .. } = record.kind
                && let Some(known) = costs.get_mut(atom as usize)
            {
                *known = Some(cost);
            }
        }
        costs
    }

    /// Sorts records into the log: a batch of one party in the order of time, or several batches one after the other.
    /// Returns how many of the first records are unchanged.
    ///
    /// Parties deliver their records a little late, so only the end of the log changes, and sorting concatenated sorted
    /// batches takes nearly linear time. With many parties that end is long: add several batches with one call.
    pub fn add(&mut self, batch: Vec<Record>) -> usize {
        let Some(first) = batch.iter().map(|record| record.at).min() else { return self.records.len() };
        let untouched = self.until(first);
        self.records.extend(batch);
        self.records[untouched..].sort_by_key(|record| record.at);
        untouched
    }
}

#[cfg(test)]
mod tests {
    use super::super::examples::header;
    use super::*;
    use crate::balance::Party;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn batches_of_several_parties_are_sorted_by_time(
            // By party: the batches' times, made to ascend by adding them up.
            parties in prop::collection::vec(prop::collection::vec(prop::collection::vec(0u64..4, 0..5), 0..5), 1..4),
            together in any::<bool>(),
        ) {
            let mut log = RunLog::new(header(&[1.0; 4]));
            let mut made: Vec<Vec<Record>> = vec![Vec::new(); parties.len()];
            for round in 0..5 {
                let mut several = Vec::new();
                for (node, batches) in parties.iter().enumerate() {
                    let Some(batch) = batches.get(round) else { continue };
                    let mut at = made[node].last().map_or(0, |record: &Record| record.at.0);
                    let mut records = Vec::new();
                    for later in batch {
                        at += later;
                        // The id tells those made at the same time apart.
                        let id = (made[node].len() + records.len()) as u64;
                        let kind = RecordKind::Received { id, by: Party::Node(node as u16) };
                        records.push(Record { at: Time(at), kind });
                    }
                    made[node].extend(records.clone());
                    if together { several.extend(records) } else { _ = log.add(records) }
                }
                log.add(several);
            }
            prop_assert!(log.records().is_sorted_by_key(|record| record.at));
            for (node, made) in made.into_iter().enumerate() {
                let by_node = |record: &&Record| {
                    matches!(record.kind, RecordKind::Received { by: Party::Node(by), .. } if usize::from(by) == node)
                };
                let of_node: Vec<_> = log.records().iter().filter(by_node).cloned().collect();
                prop_assert_eq!(of_node, made);
            }
        }
    }
}

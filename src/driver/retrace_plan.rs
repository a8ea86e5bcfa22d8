//! The plan of a retrace: the atoms of a recorded run that are traced again, and their order.

use std::mem;
use std::ops::Range;

use crate::cancel::CancelToken;
use crate::picture::Atom;
use crate::runlog::{ResultsInFlight, RunLog};

/// Most pixels in a job of more than one atom. Larger jobs do not end together; smaller ones make threads wait for each
/// other.
const MAX_JOB_PIXELS: u32 = 1024;

/// Returns the atoms of each job, in the order in which the parent received them; no more jobs once cancelled. No atom
/// is in two jobs, though a damaged log may have it in two messages; an atom that the parent never received is in none.
pub(super) fn plan(log: &RunLog, cancel: &CancelToken) -> Vec<Range<Atom>> {
    let division = log.header.division;
    let most = (MAX_JOB_PIXELS / division.atom_pixels()).max(1) as usize;
    let mut planned = vec![false; division.atoms() as usize];
    let mut in_flight = ResultsInFlight::default();
    let mut jobs: Vec<Range<Atom>> = Vec::new();
    for record in log.records() {
        let received = in_flight.apply(&record.kind);
        for range in received.into_iter().take_while(|_| !cancel.is_cancelled()) {
            for atom in range {
                if planned.get_mut(atom as usize).is_none_or(|planned| mem::replace(planned, true)) {
                    continue;
                }
                match jobs.last_mut() {
                    Some(job) if job.end == atom && job.len() < most => job.end += 1,
                    _ => jobs.push(atom..atom + 1),
                }
            }
        }
    }
    jobs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::{Message, Party};
    use crate::picture::Division;
    use crate::record::{Record, RecordKind};
    use crate::runlog::Header;
    use crate::runlog::examples::{at, header};
    use crate::time::Time;
    use proptest::prelude::*;
    use std::iter::once;

    fn sent(id: u64, ranges: impl IntoIterator<Item = Range<Atom>>) -> Record {
        let (from, to, message) = (Party::Node(0), Party::Parent, Message::Results(ranges.into_iter().collect()));
        at(0, RecordKind::Sent { id, from, to, message, bytes: 0, arrives: Time::ZERO })
    }

    fn received(id: u64, by: Party) -> Record {
        at(0, RecordKind::Received { id, by })
    }

    /// Returns the jobs of a log with these records and 20 atoms of `pixels` pixels.
    fn jobs(pixels: u32, records: Vec<Record>) -> Vec<Range<Atom>> {
        let mut log = RunLog::new(Header { division: Division::new(20 * pixels, pixels), ..header(&[1.0]) });
        log.add(records);
        plan(&log, &CancelToken::default())
    }

    #[test]
    fn atoms_are_planned_once_in_the_order_of_receipt() {
        let parent = Party::Parent;
        let records = vec![
            sent(1, once(5..8)),
            sent(2, [0..3, 10..11]),
            sent(3, [2..6, 30..40]),
            received(2, parent),
            received(1, Party::Node(0)),
            received(3, parent),
            received(3, parent),
            received(9, parent),
            sent(4, once(19..20)),
        ];
        assert_eq!(jobs(5, records), [0..3, 10..11, 3..6]);
    }

    #[test]
    fn job_size_is_bounded_by_pixels() {
        let sizes = |pixels| {
            let records = vec![sent(0, once(0..20)), received(0, Party::Parent)];
            jobs(pixels, records).iter().map(Range::len).collect::<Vec<_>>()
        };
        assert_eq!([sizes(50), sizes(300)], [vec![20], vec![3, 3, 3, 3, 3, 3, 2]]);
        assert_eq!(sizes(5000), [1; 20]);
    }

    proptest! {
        /// Holds for any log, even a damaged one.
        #[test]
        fn no_atom_is_in_two_jobs(
            records in prop::collection::vec(
                (0u64..4, any::<bool>(), prop::collection::vec((0u32..25, 0u32..25), 0..4)),
                0..30,
            ),
        ) {
            let record = |(id, is_sent, ranges): (u64, bool, Vec<(Atom, Atom)>)| {
                let ranges = ranges.into_iter().map(|(start, end)| start..end);
                if is_sent { sent(id, ranges) } else { received(id, Party::Parent) }
            };
            let jobs = jobs(5, records.into_iter().map(record).collect());
            let mut atoms: Vec<Atom> = jobs.into_iter().flatten().collect();
            let count = atoms.len();
            atoms.sort_unstable();
            atoms.dedup();
            prop_assert_eq!(atoms.len(), count);
            prop_assert!(atoms.iter().all(|&atom| atom < 20));
        }
    }
}

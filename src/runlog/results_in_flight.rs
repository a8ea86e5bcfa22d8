//! Results in flight: joins the record that a node has sent results with the record that the parent has received them.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::balance::{Message, Party};
use crate::picture::Atom;
use crate::record::RecordKind;

/// Results that have been sent and have neither arrived nor been lost, by the id of their message.
#[derive(Clone, Debug, Default)]
pub struct ResultsInFlight {
    sent: BTreeMap<u64, Vec<Range<Atom>>>,
}

impl ResultsInFlight {
    /// Takes in the next record. Returns the atoms of the results that the parent receives with it, in their order;
    /// nothing for every other record.
    pub fn apply(&mut self, record: &RecordKind) -> Vec<Range<Atom>> {
        match record {
            RecordKind::Sent { id, to: Party::Parent, message: Message::Results(ranges), .. } => {
                self.sent.insert(*id, ranges.clone());
            }
            RecordKind::Received { id, by: Party::Parent } => return self.sent.remove(id).unwrap_or_default(),
            RecordKind::Lost { id } => _ = self.sent.remove(id),
            _ => {}
        }
        Vec::new()
    }
}

#[cfg(test)]
#[expect(clippy::single_range_in_vec_init, reason = "results are ranges")]
mod tests {
    use super::*;
    use crate::time::Time;

    fn sent(id: u64, to: Party, message: Message) -> RecordKind {
        RecordKind::Sent { id, from: Party::Node(0), to, message, bytes: 0, arrives: Time::ZERO }
    }

    #[test]
    fn results_are_returned_once_when_the_parent_receives_them() {
        let (parent, node) = (Party::Parent, Party::Node(1));
        let mut in_flight = ResultsInFlight::default();
        for record in [
            sent(1, parent, Message::Results(vec![2..4, 7..8])),
            sent(2, parent, Message::Results(vec![0..1])),
            sent(3, parent, Message::Request),
            sent(4, node, Message::Transfer(vec![5..6])),
            RecordKind::Lost { id: 2 },
            RecordKind::Received { id: 4, by: node },
        ] {
            assert_eq!(in_flight.apply(&record), []);
        }
        let mut received = |id| in_flight.apply(&RecordKind::Received { id, by: parent });
        assert_eq!([3, 2, 1, 1].map(&mut received), [vec![], vec![], vec![2..4, 7..8], vec![]]);
    }
}

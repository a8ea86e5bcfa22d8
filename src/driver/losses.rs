//! What fails in a run on threads, as far as all parties have to know of it: links that are cut, and machines that are cut off.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::balance::{NodeId, Party};

/// What is cut, until the run is over: nothing fails after that, or is mended.
#[derive(Debug, Default)]
pub(super) struct Losses {
    cut: Mutex<Cut>,
    over: AtomicBool,
}

#[derive(Debug, Default)]
struct Cut {
    /// The lesser party first.
    links: BTreeSet<(Party, Party)>,
    nodes: BTreeSet<NodeId>,
}

impl Losses {
    /// Cuts the link between two parties, or mends it. Whether that changes anything.
    pub fn cut_link(&self, one: Party, other: Party, is_cut: bool) -> bool {
        self.change(|cut| {
            let link = (one.min(other), one.max(other));
            if is_cut { cut.links.insert(link) } else { cut.links.remove(&link) }
        })
    }

    /// Cuts a node off from all others, or no longer. Whether that is still possible.
    pub fn cut_off(&self, node: NodeId, is_cut_off: bool) -> bool {
        self.change(|cut| {
            if is_cut_off { cut.nodes.insert(node) } else { cut.nodes.remove(&node) };
            true
        })
    }

    /// Whether nothing travels between the two. What a party sends to itself goes no way.
    pub fn is_cut(&self, one: Party, other: Party) -> bool {
        let cut = self.lock();
        let is_cut_off = |party| matches!(party, Party::Node(node) if cut.nodes.contains(&node));
        one != other && (cut.links.contains(&(one.min(other), one.max(other))) || is_cut_off(one) || is_cut_off(other))
    }

    /// The parent has nothing more to do: what it says last reaches whoever it reaches now.
    pub fn end(&self) {
        let _cut = self.lock();
        self.over.store(true, Ordering::SeqCst);
    }

    /// Whether [`Losses::end`] was called.
    pub fn is_over(&self) -> bool {
        self.over.load(Ordering::SeqCst)
    }

    fn change(&self, change: impl FnOnce(&mut Cut) -> bool) -> bool {
        let mut cut = self.lock();
        !self.is_over() && change(&mut cut)
    }

    /// No panic leaves it half changed.
    fn lock(&self) -> MutexGuard<'_, Cut> {
        self.cut.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PARENT: Party = Party::Parent;
    const ONE: Party = Party::Node(1);
    const TWO: Party = Party::Node(2);

    #[test]
    fn a_link_is_cut_both_ways_and_a_node_from_all() {
        let losses = Losses::default();
        assert!(losses.cut_link(TWO, PARENT, true) && !losses.cut_link(PARENT, TWO, true), "it is one link");
        let are_cut = || [(PARENT, TWO), (TWO, PARENT), (ONE, TWO), (TWO, TWO)].map(|(one, two)| losses.is_cut(one, two));
        assert_eq!(are_cut(), [true, true, false, false]);
        assert!(losses.cut_off(2, true));
        assert_eq!(are_cut(), [true, true, true, false], "nobody is cut off from itself");
        assert!(losses.cut_off(2, false) && losses.cut_link(PARENT, TWO, false));
        assert_eq!(are_cut(), [false; 4]);
    }

    #[test]
    fn what_is_cut_at_the_end_remains_so() {
        let losses = Losses::default();
        losses.cut_off(1, true);
        losses.end();
        assert!(!losses.cut_off(1, false) && !losses.cut_off(2, true) && !losses.cut_link(PARENT, TWO, true));
        assert!(losses.is_over() && losses.is_cut(PARENT, ONE) && !losses.is_cut(PARENT, TWO));
    }
}

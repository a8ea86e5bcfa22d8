//! Copies: an atom that waits too long in a slow node's pipe is traced by an idle node as well.

use std::collections::VecDeque;
use std::time::Duration;

use crate::picture::Atom;
use crate::time::Time;

/// The atoms in the pipe of which the node has given a copy away.
#[derive(Debug, Default)]
pub(super) struct Copies {
    given: Vec<Atom>,
}

impl Copies {
    /// Notes that a copy of `atom` was given away.
    pub fn note_given(&mut self, atom: Atom) {
        self.given.push(atom);
    }

    /// Notes that `atom` has left the pipe.
    pub fn note_left_pipe(&mut self, atom: Atom) {
        self.given.retain(|&given| given != atom);
    }

    /// Returns the last atom in the pipe that an idle node would finish earlier than this one and of which no copy was
    /// given: the idle node needs `needs`, this node needs `left` for the atom in hand and `usual` for each one behind
    /// it.
    pub fn late_atom(&self, pipe: &VecDeque<Atom>, left: Duration, usual: Duration, needs: Duration) -> Option<Atom> {
        let is_late = |(place, atom): &(u32, &Atom)| left + usual * *place > needs && !self.given.contains(atom);
        (0..).zip(pipe).filter(is_late).last().map(|(_, &atom)| atom)
    }

    /// Returns when the atom that has been in hand since `since` will be late: an idle node that needs `needs` would
    /// then finish it earlier. An atom that is late already is due again when it has taken twice as long.
    pub fn expiry(now: Time, since: Time, usual: Duration, needs: Duration) -> Time {
        let late = since + usual / 2 + needs;
        if late > now { late } else { now + now.since(since).max(Duration::from_micros(1)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);

    #[test]
    fn last_late_atom_is_copied_once() {
        let (pipe, mut copies) = (VecDeque::from([4, 9]), Copies::default());
        let late = |copies: &Copies, needs| copies.late_atom(&pipe, 3 * MS, 2 * MS, needs);
        assert_eq!([6 * MS, 4 * MS, 2 * MS].map(|needs| late(&copies, needs)), [None, Some(9), Some(9)]);
        copies.note_given(9);
        assert_eq!([4 * MS, 2 * MS].map(|needs| late(&copies, needs)), [None, Some(4)]);
        copies.note_left_pipe(9);
        assert_eq!(late(&copies, 4 * MS), Some(9), "the atom has come into the pipe again");
    }

    #[test]
    fn late_atom_is_due_again_after_twice_its_age() {
        let at = |ms| Time::ZERO + ms * MS;
        let expiry = |now| Copies::expiry(at(now), at(10), 4 * MS, 3 * MS);
        assert_eq!([12, 15, 18].map(expiry), [15, 20, 26].map(at));
    }
}

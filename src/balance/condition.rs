//! The condition of a node's machine, and the effects of a change: the table that the simulator and the threads follow.

use serde::{Deserialize, Serialize};

/// Condition of a node's machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Condition {
    /// The machine works and answers.
    #[default]
    Well,
    /// The machine does nothing until it is well again; it then continues where it stopped. Messages to it wait.
    Hung,
    /// The machine works, but no message from it or to it arrives.
    CutOff,
    /// The machine is switched off. Its memory and all messages to it are lost. When it is well again, it starts
    /// afresh.
    Off,
}

/// Effect of a change of [`Condition`] on the machine's memory: its node's state, queued messages, timer, atoms and
/// pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transition {
    /// The memory is lost: the messages that wait there, the timer, the atoms in queue, pipe and hand, the results that
    /// are not sent, and the node's state.
    MemoryLost,
    /// A new node starts and is handed [`Event::Started`](super::Event::Started).
    FreshStart,
    /// The machine continues after a hang: it handles the messages that have arrived meanwhile, then an overdue timer.
    Resumed,
    /// The memory stays as it is; only the worker or the network is affected.
    MemoryKept,
}

impl Condition {
    /// Returns the effect of a change from this condition to `to`; `None` if nothing changes, since a machine that is
    /// off cannot hang.
    pub fn transition(self, to: Self) -> Option<Transition> {
        match (self, to) {
            _ if self == to => None,
            (Self::Off, Self::Hung) => None,
            (_, Self::Off) => Some(Transition::MemoryLost),
            (Self::Off, _) => Some(Transition::FreshStart),
            (Self::Hung, _) => Some(Transition::Resumed),
            (Self::Well | Self::CutOff, _) => Some(Transition::MemoryKept),
        }
    }

    /// Returns whether the machine works: it traces, and it handles the messages that reach it.
    pub fn is_running(self) -> bool {
        matches!(self, Self::Well | Self::CutOff)
    }
}

#[cfg(test)]
mod tests {
    use super::Condition::{CutOff, Hung, Off, Well};
    use super::Transition::{FreshStart, MemoryKept, MemoryLost, Resumed};
    use super::*;

    const ALL: [Condition; 4] = [Well, Hung, CutOff, Off];

    /// The effects of the changes from `from` to each condition, in the order of [`ALL`].
    fn row(from: Condition) -> [Option<Transition>; 4] {
        ALL.map(|to| from.transition(to))
    }

    #[test]
    fn off_loses_the_memory_of_every_other_condition() {
        for from in [Well, Hung, CutOff] {
            assert_eq!(from.transition(Off), Some(MemoryLost));
        }
    }

    #[test]
    fn off_starts_afresh_or_stays_off_but_cannot_hang() {
        assert_eq!(row(Off), [Some(FreshStart), None, Some(FreshStart), None]);
    }

    #[test]
    fn hung_resumes_whether_or_not_the_network_reaches_it() {
        assert_eq!(row(Hung), [Some(Resumed), None, Some(Resumed), Some(MemoryLost)]);
    }

    #[test]
    fn hanging_and_cutting_off_keep_the_memory() {
        assert_eq!(row(Well), [None, Some(MemoryKept), Some(MemoryKept), Some(MemoryLost)]);
        assert_eq!(row(CutOff), [Some(MemoryKept), Some(MemoryKept), None, Some(MemoryLost)]);
    }

    #[test]
    fn only_well_and_cut_off_machines_run() {
        assert_eq!(ALL.map(Condition::is_running), [true, false, true, false]);
    }
}

//! How the number of atoms in a transfer follows from what both machines have traced (§7).

use crate::balance::{NodeId, PIPE_ATOMS, Remedy, Scheduler};
use crate::language::{Language, say, word};
use crate::view::state::run_state::RunState;
use crate::view::text::format::{count, node_name};

/// The part of a giver's waiting atoms that a machine gets for its offer of help.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    /// Atoms that waited with the giver, outside its pipe, before the transfer.
    pub waiting: u32,
    /// Reason for the share.
    pub basis: ShareBasis,
}

/// Reason for a share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShareBasis {
    /// By their estimated speeds both machines finish together.
    Speeds,
    /// Half, because neither machine has traced an atom.
    Half,
    /// One atom, because the machine that offers help has traced none.
    Trial,
    /// offerer / (offerer + giver), by the atoms that each has traced.
    Traced {
        /// Atoms that the machine that offers help has traced.
        offerer: u32,
        /// Atoms that the giver has traced.
        giver: u32,
    },
}

impl Share {
    /// Finds the share in a transfer of `atoms`, the latest record of `state`; `None` for work stealing, which does not
    /// compute a share.
    pub(crate) fn of(state: &RunState, from: NodeId, to: NodeId, atoms: u32) -> Option<Self> {
        if !matches!(state.scheduler(), Scheduler::Protocol(_)) {
            return None;
        }
        let [giver, offerer] = [from, to].map(|node| state.nodes().get(usize::from(node)));
        let (giver, offerer) = (giver?, offerer?.offered);
        let basis = match (giver.done, offerer) {
            _ if state.has(Remedy::Speed) => ShareBasis::Speeds,
            (0, 0) => ShareBasis::Half,
            (_, 0) => ShareBasis::Trial,
            (giver, offerer) => ShareBasis::Traced { offerer, giver },
        };
        Some(Self { waiting: atoms_in_queue(giver.left()) + atoms, basis })
    }

    /// Gives the reason for the share of `to`.
    pub(crate) fn reason(self, to: NodeId, language: Language) -> String {
        let to = node_name(to);
        match self.basis {
            ShareBasis::Speeds => word!(language, "so both finish together", "assim terminam juntas").into(),
            ShareBasis::Half => {
                word!(language, "half, as neither had traced any", "a metade, pois nenhuma calculou nada").into()
            }
            ShareBasis::Trial => {
                say!(language, "a trial, as {to} had traced none", "um teste, pois {to} não calculou nenhum")
            }
            ShareBasis::Traced { offerer, giver } => {
                let [offerer, giver] = [offerer, giver].map(count);
                say!(
                    language,
                    "in proportion to atoms traced, {offerer} to {giver}",
                    "na proporção dos átomos calculados, {offerer} para {giver}"
                )
            }
        }
    }
}

/// Returns how many of a node's `left` atoms wait in its queue, outside its pipe.
pub(crate) fn atoms_in_queue(left: u32) -> u32 {
    left.saturating_sub(PIPE_ATOMS)
}

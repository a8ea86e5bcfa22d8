//! Bugs that are put in on purpose: a check that finds none of them would find no others.

use super::check::Tamper;
use crate::balance::{Action, Message, Party};

/// A bug.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bug {
    /// A node takes atoms off its queue for whoever offered, and does not send them: the second time it would.
    LostTransfer,
    /// A node passes an offer on twice: the second that is passed on.
    ForwardedTwice,
    /// The parent never gives out again what nobody has.
    LeaseNotReturned,
}

impl Bug {
    pub const ALL: [Self; 3] = [Self::LostTransfer, Self::ForwardedTwice, Self::LeaseNotReturned];

    /// What it is called in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::LostTransfer => "a transfer is lost",
            Self::ForwardedTwice => "an offer is passed on twice",
            Self::LeaseNotReturned => "a lease is never returned",
        }
    }

    /// What it does to a run.
    pub fn tamper(self) -> Tamper {
        let mut seen = 0;
        let mut is_second = move || {
            seen += 1;
            seen == 2
        };
        Box::new(move |party, action| {
            let Action::Send { message, .. } = action else { return 1 };
            match (self, message) {
                (Self::LostTransfer, Message::Transfer(_)) if is_second() => 0,
                (Self::ForwardedTwice, Message::Offer { who, help: Some(help), .. })
                    if help.left.is_some() && party != Party::Node(*who) && is_second() =>
                {
                    2
                }
                (Self::LeaseNotReturned, Message::Again(_)) if party == Party::Parent => 0,
                _ => 1,
            }
        })
    }
}

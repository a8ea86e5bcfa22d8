//! Bugs injected on purpose, to show that the checks find bugs.

use super::check::Tamper;
use crate::balance::{Action, Message, Party, Strategy};

/// An injected bug.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bug {
    /// A node takes atoms from its queue for an offer but does not send them: its second transfer is lost.
    LostTransfer,
    /// A node forwards an offer twice: the second offer that it forwards.
    ForwardedTwice,
    /// The parent of the adaptive ring never hands lost atoms out again.
    LeaseNotReturned,
    /// The parent of the farm with leases never gives lost atoms out again.
    PartNotReturned,
}

impl Bug {
    pub const ALL: [Self; 4] =
        [Self::LostTransfer, Self::ForwardedTwice, Self::LeaseNotReturned, Self::PartNotReturned];

    /// Returns the bug's name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::LostTransfer => "a transfer is lost",
            Self::ForwardedTwice => "an offer is forwarded twice",
            Self::LeaseNotReturned => "lost atoms are never handed out again",
            Self::PartNotReturned => "in the farm, lost atoms are never given out again",
        }
    }

    /// Returns the strategy that gets the bug.
    pub fn strategy(self) -> Strategy {
        match self {
            Self::LostTransfer | Self::ForwardedTwice | Self::LeaseNotReturned => Strategy::Adaptive,
            Self::PartNotReturned => Strategy::FarmLeases,
        }
    }

    /// Returns the function that injects the bug into a run.
    pub fn tamper(self) -> Tamper {
        let mut totals = 0;
        let mut is_second = move || {
            totals += 1;
            totals == 2
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
                (Self::LeaseNotReturned | Self::PartNotReturned, Message::Again(_)) if party == Party::Parent => 0,
                _ => 1,
            }
        })
    }
}

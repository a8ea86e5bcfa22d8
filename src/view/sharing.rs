//! How a run's atoms are shared, in plain words.

use crate::balance::Strategy;
use crate::runlog::{Driver, Header};

/// How a run's atoms are shared: by a strategy of ours, or by a library of today.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// By this strategy.
    By(Strategy),
    /// By rayon's work stealing.
    Stealing,
}

impl Sharing {
    /// All of them, in the order in which they are offered: from no sharing to the article's, and what came after it.
    pub const ALL: [Self; 7] = [
        Self::By(Strategy::Serial),
        Self::By(Strategy::Static),
        Self::By(Strategy::StaticEstimate),
        Self::By(Strategy::Farm),
        Self::By(Strategy::FarmBySpeed),
        Self::By(Strategy::Ring),
        Self::Stealing,
    ];

    /// How the run is shared that `header` describes.
    pub fn of(header: &Header) -> Self {
        if header.driver == Driver::WorkStealing { Self::Stealing } else { Self::By(header.rules.strategy) }
    }

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::By(Strategy::Serial) => "Serial",
            Self::By(Strategy::Static) => "Equal bands",
            Self::By(Strategy::StaticEstimate) => "Estimated bands",
            Self::By(Strategy::Farm) => "Farm",
            Self::By(Strategy::FarmBySpeed) => "Farm by speed",
            Self::By(Strategy::Ring) => "Ring",
            Self::Stealing => "Work stealing (rayon)",
        }
    }

    /// What happens, in one short line.
    pub fn hint(self) -> &'static str {
        match self {
            Self::By(Strategy::Serial) => "The first machine does everything",
            Self::By(Strategy::Static) => "A band each; all wait for the slowest",
            Self::By(Strategy::StaticEstimate) => "Bands by what they seem to cost",
            Self::By(Strategy::Farm) => "Whoever is done asks the parent",
            Self::By(Strategy::FarmBySpeed) => "The same; the slow get smaller parts",
            Self::By(Strategy::Ring) => "Whoever is done offers help round the ring",
            Self::Stealing => "Threads take atoms from each other",
        }
    }

    /// What those are called that do the work, beside what they are organised in.
    pub fn machines(self, machines: usize) -> String {
        let are = match self {
            _ if machines == 1 => return "1 machine".into(),
            Self::By(Strategy::Serial) => "machines, one of which works",
            Self::By(Strategy::Static) => "machines with equal bands",
            Self::By(Strategy::StaticEstimate) => "machines with estimated bands",
            Self::By(Strategy::Farm | Strategy::FarmBySpeed) => "machines in a farm",
            Self::By(Strategy::Ring) => "machines in a ring",
            Self::Stealing => "threads of rayon",
        };
        format!("{machines} {are}")
    }

    /// Whether whoever is done offers help round the ring.
    pub(super) fn is_ring(self) -> bool {
        self == Self::By(Strategy::Ring)
    }

    /// Whether whoever is done asks the parent for more.
    pub(super) fn is_farm(self) -> bool {
        matches!(self, Self::By(strategy) if strategy.is_farm())
    }

    /// Whether everyone keeps what they are given at first.
    pub(super) fn is_fixed(self) -> bool {
        matches!(self, Self::By(Strategy::Serial | Strategy::Static | Strategy::StaticEstimate))
    }
}

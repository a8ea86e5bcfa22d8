//! The scheduler of a run: what decides which node traces which atom.

use std::str::FromStr;

use thiserror::Error;

use super::strategy::Strategy;

/// Decides which node traces which atom. Not `Copy`, so that a strategy can hold more than its name one day.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Scheduler {
    /// A protocol of this module: the parent and the nodes send messages.
    Protocol(Strategy),
    /// Work stealing by rayon: the threads share their memory and send no messages.
    WorkStealing,
}

impl Scheduler {
    /// All schedulers, in the order in which the user sees them.
    pub const ALL: [Self; 9] = [
        Self::Protocol(Strategy::Serial),
        Self::Protocol(Strategy::Static),
        Self::Protocol(Strategy::StaticEstimate),
        Self::Protocol(Strategy::Farm),
        Self::Protocol(Strategy::FarmBySpeed),
        Self::Protocol(Strategy::FarmLeases),
        Self::Protocol(Strategy::Ring),
        Self::Protocol(Strategy::Adaptive),
        Self::WorkStealing,
    ];

    /// Returns the name on the command line and in reports.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Protocol(strategy) => strategy.name(),
            Self::WorkStealing => "rayon",
        }
    }

    /// Returns whether nodes offer help along a ring.
    pub fn is_ring(&self) -> bool {
        matches!(self, Self::Protocol(strategy) if strategy.is_ring())
    }

    /// Returns whether it is the adaptive ring.
    pub fn is_adaptive(&self) -> bool {
        *self == Self::Protocol(Strategy::Adaptive)
    }

    /// Returns whether a machine that starts afresh is let in ([`Strategy::survives_losses`]).
    pub fn survives_losses(&self) -> bool {
        matches!(self, Self::Protocol(strategy) if strategy.survives_losses())
    }

    /// Returns whether nodes ask the parent for parts.
    pub fn is_farm(&self) -> bool {
        matches!(self, Self::Protocol(strategy) if strategy.is_farm())
    }

    /// Returns whether each node keeps its first atoms.
    pub fn is_fixed(&self) -> bool {
        matches!(self, Self::Protocol(Strategy::Serial | Strategy::Static | Strategy::StaticEstimate))
    }
}

/// A name that is not the name of a scheduler.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no strategy `{0}`; there are: {known}", known = Scheduler::ALL.map(|scheduler| scheduler.name()).join(", "))]
pub struct UnknownScheduler(String);

impl FromStr for Scheduler {
    type Err = UnknownScheduler;

    fn from_str(text: &str) -> Result<Self, UnknownScheduler> {
        Self::ALL
            .into_iter()
            .find(|scheduler| scheduler.name() == text)
            .ok_or_else(|| UnknownScheduler(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back_and_unknown_names_are_listed() {
        for scheduler in Scheduler::ALL {
            assert_eq!(scheduler.name().parse(), Ok(scheduler));
        }
        let error = "tree".parse::<Scheduler>().expect_err("no such scheduler").to_string();
        assert!(error.contains("`tree`") && error.ends_with("adaptive, rayon"), "{error}");
    }
}

//! The remedies: the differences of the adaptive ring from the article's, each with its own switch.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A remedy for one weakness of the article's ring.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Remedy {
    /// Shares follow the present speed of nodes, by the work in their last atoms, instead of the atoms since the start.
    Speed,
    /// A node gives no transfer that would take longer to travel than it saves.
    Floor,
    /// A node offers help before its atoms run out, so that the answer comes in time.
    Early,
    /// A node that no other node needs sleeps, and a node that needs help later wakes it.
    Wake,
    /// An atom that waits too long in a node's pipe is traced by an idle node as well; the first result counts.
    Copies,
    /// An offer stops at a few nodes, near and far, instead of at all nodes.
    Shortcuts,
    /// Every node tells the parent which atoms it holds. The parent hands out again the atoms that no node has held for
    /// a lease, and a node that is silent for a lease leaves the ring.
    Leases,
}

impl Remedy {
    /// All remedies, in the order in which the user sees them.
    pub const ALL: [Self; 7] =
        [Self::Speed, Self::Floor, Self::Early, Self::Wake, Self::Copies, Self::Shortcuts, Self::Leases];

    /// Returns the name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::Floor => "floor",
            Self::Early => "early",
            Self::Wake => "wake",
            Self::Copies => "copies",
            Self::Shortcuts => "shortcuts",
            Self::Leases => "leases",
        }
    }
}

/// A name that is not the name of a remedy.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no remedy `{0}`; there are: {known}", known = Remedy::ALL.map(Remedy::name).join(", "))]
pub struct UnknownRemedy(String);

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Remedy {
    type Err = UnknownRemedy;

    fn from_str(text: &str) -> Result<Self, UnknownRemedy> {
        Self::ALL.into_iter().find(|remedy| remedy.name() == text).ok_or_else(|| UnknownRemedy(text.to_owned()))
    }
}

/// A set of remedies; all of them by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Vec<String>", into = "Vec<String>")]
pub struct Remedies(u8);

impl Remedies {
    /// All remedies.
    pub const ALL: Self = Self(u8::MAX >> (8 - Remedy::ALL.len()));
    /// No remedy: the article's ring.
    pub const NONE: Self = Self(0);

    /// Returns whether the set contains this remedy.
    pub fn has(self, remedy: Remedy) -> bool {
        self.0 & (1 << remedy as u8) != 0
    }

    /// Returns the set with one more remedy.
    pub fn with(self, remedy: Remedy) -> Self {
        Self(self.0 | 1 << remedy as u8)
    }

    /// Returns the set without one remedy.
    pub const fn without(self, remedy: Remedy) -> Self {
        Self(self.0 & !(1 << remedy as u8))
    }

    /// Iterates over the remedies of the set, in the order of [`Remedy::ALL`].
    pub fn iter(self) -> impl Iterator<Item = Remedy> {
        Remedy::ALL.into_iter().filter(move |&remedy| self.has(remedy))
    }
}

impl Default for Remedies {
    fn default() -> Self {
        Self::ALL
    }
}

impl FromIterator<Remedy> for Remedies {
    fn from_iter<I: IntoIterator<Item = Remedy>>(remedies: I) -> Self {
        remedies.into_iter().fold(Self::NONE, Self::with)
    }
}

impl From<Vec<String>> for Remedies {
    /// Ignores unknown names: a recorded run may name remedies that no longer exist.
    fn from(names: Vec<String>) -> Self {
        names.iter().filter_map(|name| name.parse().ok()).collect()
    }
}

impl From<Remedies> for Vec<String> {
    fn from(remedies: Remedies) -> Self {
        remedies.iter().map(|remedy| remedy.to_string()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_remedy_is_switched_alone_and_unknown_names_are_ignored() {
        for remedy in Remedy::ALL {
            assert_eq!(remedy.name().parse(), Ok(remedy));
            assert!(Remedies::ALL.has(remedy) && !Remedies::NONE.has(remedy));
            let without: Vec<_> = Remedies::ALL.without(remedy).iter().collect();
            assert_eq!(without, Remedy::ALL.into_iter().filter(|&other| other != remedy).collect::<Vec<_>>());
            assert_eq!(without.into_iter().collect::<Remedies>().with(remedy), Remedies::ALL);
        }
        let named = ["wake", "pipe"].map(str::to_owned).to_vec();
        assert_eq!(Remedies::from(named), Remedies::NONE.with(Remedy::Wake), "`pipe` no longer exists");
    }
}

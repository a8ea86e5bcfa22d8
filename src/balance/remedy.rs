//! What the ring that adapts does otherwise than the article's, each a switch of its own.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// One weakness of the article's ring, mended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Remedy {
    /// Shares follow how fast nodes are now, by the work in their last atoms, not by the atoms since the start.
    Speed,
    /// No transfer that would take longer to travel than it saves.
    Floor,
    /// A node offers help so early that an answer comes when it is needed.
    Early,
    /// A node that nobody needs sleeps, and whoever comes to need help wakes it.
    Wake,
    /// What waits too long in a node's pipe is traced by an idle node as well; the first result counts.
    Copies,
    /// An offer stops at a few nodes, near and far, and not at all.
    Shortcuts,
    /// The parent hears of every node what it has; what nobody has had for a while is given out again, and whoever is silent
    /// leaves the ring.
    Leases,
}

impl Remedy {
    /// Every remedy, in the order in which they are named to the user.
    pub const ALL: [Self; 7] =
        [Self::Speed, Self::Floor, Self::Early, Self::Wake, Self::Copies, Self::Shortcuts, Self::Leases];

    /// The name on the command line and in files.
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

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Remedy {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|remedy| remedy.name() == text).ok_or_else(|| {
            let known = Self::ALL.map(Self::name).join(", ");
            format!("there is no remedy `{text}`; there are: {known}")
        })
    }
}

/// Some of the remedies: all, unless somebody wants otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Vec<String>", into = "Vec<String>")]
pub struct Remedies(u8);

impl Remedies {
    /// All of them.
    pub const ALL: Self = Self(u8::MAX >> (8 - Remedy::ALL.len()));
    /// None: the article's ring.
    pub const NONE: Self = Self(0);

    /// Whether this one is among them.
    pub fn has(self, remedy: Remedy) -> bool {
        self.0 & (1 << remedy as u8) != 0
    }

    /// These and one more.
    pub fn with(self, remedy: Remedy) -> Self {
        Self(self.0 | 1 << remedy as u8)
    }

    /// These but one.
    pub const fn without(self, remedy: Remedy) -> Self {
        Self(self.0 & !(1 << remedy as u8))
    }

    /// One after the other.
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
    /// A recorded run may name remedies that were taken out since.
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
    fn each_is_a_switch_of_its_own() {
        for remedy in Remedy::ALL {
            assert_eq!(remedy.name().parse(), Ok(remedy));
            assert!(Remedies::ALL.has(remedy) && !Remedies::NONE.has(remedy));
            let without: Vec<_> = Remedies::ALL.without(remedy).iter().collect();
            assert_eq!(without, Remedy::ALL.into_iter().filter(|&other| other != remedy).collect::<Vec<_>>());
            assert_eq!(without.into_iter().collect::<Remedies>().with(remedy), Remedies::ALL);
        }
        let named = ["wake", "pipe"].map(str::to_owned).to_vec();
        assert_eq!(Remedies::from(named), Remedies::NONE.with(Remedy::Wake), "one was taken out since");
    }
}

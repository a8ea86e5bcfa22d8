//! What becomes of a party's machine: a protocol that is to lose nobody has to cope with it.

use serde::{Deserialize, Serialize};

/// What state a node's machine is in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Condition {
    /// It works and answers.
    #[default]
    Well,
    /// It does neither, and will go on where it was: what is sent to it waits.
    Hung,
    /// It works, but nothing that is sent to it or by it arrives.
    CutOff,
    /// It is switched off: what it had is lost, and what is sent to it. If it is well again, it begins anew.
    Off,
}

//! How fast the reference machine is emulated.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::language::{Language, say, word};

/// How fast the reference machine is emulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Pace {
    /// So that the run takes about this many seconds.
    Lasts(u32),
    /// As fast as this computer can: a machine at full speed never waits.
    Full,
}

impl Pace {
    /// How fast that is, in a few words.
    pub fn words(self, language: Language) -> String {
        match self {
            Self::Lasts(seconds) => say!(language, "a run of about {seconds} s", "uma execução de uns {seconds} s"),
            Self::Full => word!(language, "full speed", "velocidade total").into(),
        }
    }

    /// The pace of machines whose speeds have this `sum`, for a picture that takes the reference machine so much `work`;
    /// `most` is what this computer can do.
    pub fn pace(self, work: Duration, sum: f64, most: f64) -> f64 {
        /// Not all machines are busy to the end, and those in a run find their caches colder than a probe does.
        const BUSY: f64 = 0.85;
        match self {
            Self::Full => 1.0,
            // A computer that is too slow for this makes the run longer instead of late; 0 is not a pace.
            Self::Lasts(seconds) => {
                let wanted = work.as_secs_f64() / (BUSY * f64::from(seconds) * sum.max(1e-3));
                wanted.min(most).clamp(1e-6, 0.999)
            }
        }
    }
}

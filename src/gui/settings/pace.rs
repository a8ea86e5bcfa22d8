//! Emulated speed of the reference machine.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::language::{Language, comma, say, word};

/// Emulated speed of the reference machine.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Pace {
    /// Slowed down so that the run lasts about this many seconds.
    Lasts(f64),
    /// As fast as this computer: a machine at 100 % never waits.
    Full,
}

impl Pace {
    /// Names the pace in a few words.
    pub fn text(self, language: Language) -> String {
        match self {
            Self::Lasts(seconds) => {
                let seconds = comma(language, seconds.to_string());
                say!(language, "a run of about {seconds} s", "uma execução de cerca de {seconds} s")
            }
            Self::Full => word!(language, "full speed", "velocidade total").into(),
        }
    }

    /// Returns the fraction of a real core that the reference machine gets, above 0 and at most 1. `work` is the time
    /// of the picture on the reference machine, `speed_sum` the sum of all machines' speeds, `max` the limit of this
    /// computer.
    pub fn fraction(self, work: Duration, speed_sum: f64, max: f64) -> f64 {
        /// Share of the machines' time that is tracing at the probe's speed: some machines are idle near the end, and
        /// caches are colder in a run than in the probe.
        const BUSY_SHARE: f64 = 0.85;
        match self {
            Self::Full => 1.0,
            // On a computer that is too slow the run lasts longer. The pace must stay above 0.
            Self::Lasts(seconds) => {
                let wanted = work.as_secs_f64() / (BUSY_SHARE * seconds * speed_sum.max(1e-3));
                wanted.min(max).clamp(1e-6, 0.999)
            }
        }
    }
}

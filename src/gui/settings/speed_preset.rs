//! Presets for the speeds of all machines.

use crate::language::{Language, word};

/// Preset for the speeds of all machines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedPreset {
    /// All machines at full speed.
    Equal,
    /// The last machine at 10 %, the others at full speed.
    OneSlow,
    /// Random speeds from 10 to 100 %, by the seed.
    Random,
    /// Machines of a laboratory of about 1997.
    Laboratory,
}

/// Machines of a laboratory of about 1997 and their speeds. The fastest and the slowest are the article's (§9, Figures
/// 6 and 7: 580 s and 6,099 s for the same picture); the others are estimates from their clock rates.
const LABORATORY: [(&str, f64); 8] = [
    ("Pentium 75", 1.0),
    ("486 DX4 100", 0.62),
    ("Pentium 75", 1.0),
    ("486 DX2 66", 0.41),
    ("HP 9000/710, busy as a file server", 580.0 / 6099.0),
    ("Pentium 60", 0.8),
    ("486 DX 33", 0.21),
    ("Pentium 75", 1.0),
];

impl SpeedPreset {
    /// All presets, in the order of their buttons.
    pub const ALL: [Self; 4] = [Self::Equal, Self::OneSlow, Self::Random, Self::Laboratory];

    /// Returns the text of its button.
    pub fn name(self, language: Language) -> &'static str {
        match self {
            Self::Equal => word!(language, "All equal", "Iguais"),
            Self::OneSlow => word!(language, "One slow", "Uma lenta"),
            Self::Random => word!(language, "Random", "Aleatórias"),
            Self::Laboratory => word!(language, "Old laboratory", "Laboratório antigo"),
        }
    }

    /// Returns its description.
    pub fn hint(self, language: Language) -> &'static str {
        match self {
            Self::Equal => word!(language, "Every machine at full speed", "Todas as máquinas a 100 %"),
            Self::OneSlow => {
                word!(
                    language,
                    "One machine at 10 %, the others at full speed",
                    "Uma máquina a 10 %, as outras a 100 %"
                )
            }
            Self::Random => {
                word!(
                    language,
                    "Each machine at a random speed from 10 to 100 %, by the seed",
                    "Cada máquina a uma velocidade aleatória de 10 a 100 %, pela semente"
                )
            }
            Self::Laboratory => word!(
                language,
                "Machines of a laboratory of 1997: Pentiums, 486s, and a busy HP 9000/710",
                "Máquinas de um laboratório de 1997: Pentiums, 486s e uma HP 9000/710 sobrecarregada"
            ),
        }
    }

    /// Returns the speeds of `nodes` machines; random ones depend on `seed`.
    pub fn speeds(self, nodes: usize, seed: u64) -> Vec<f64> {
        match self {
            Self::Equal => vec![1.0; nodes],
            Self::OneSlow => (0..nodes).map(|node| if node + 1 == nodes { 0.1 } else { 1.0 }).collect(),
            Self::Random => {
                let mut random = fastrand::Rng::with_seed(seed);
                (0..nodes).map(|_| f64::from(random.u8(10..=100)) / 100.0).collect()
            }
            Self::Laboratory => LABORATORY.iter().cycle().take(nodes).map(|(_, speed)| *speed).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_give_valid_and_repeatable_speeds() {
        for preset in SpeedPreset::ALL {
            for nodes in 1..=32 {
                let speeds = preset.speeds(nodes, 1);
                assert!(speeds.len() == nodes && speeds.iter().all(|speed| (0.0..=1.0).contains(speed)));
                assert_eq!(speeds, preset.speeds(nodes, 1));
                assert!(nodes < 3 || preset != SpeedPreset::Random || speeds != preset.speeds(nodes, 2));
            }
        }
    }
}

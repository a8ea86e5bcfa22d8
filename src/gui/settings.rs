//! What the user has set: what a run is made from, and what acts on the run that goes on.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::balance::{Rules, Strategy};
use crate::driver::auto_pace;
use crate::picture::{Division, Size};
use crate::runlog::{Driver, Header, Link};

/// What the user has set. Speeds and latency act at once, everything else when a run starts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Width and height of the picture.
    pub size: Size,
    /// The picture is made of n × n samples a pixel, at most [`Settings::MOST_SAMPLES`].
    pub samples: u32,
    /// Pixels in an atom.
    pub atom: u32,
    /// How the atoms are shared.
    pub strategy: Strategy,
    /// An offer is worth taking if it moves at least this many atoms.
    pub part: u32,
    /// How fast the reference machine is emulated.
    pub tempo: Tempo,
    /// A machine a speed, as fractions of the reference machine.
    pub speeds: Vec<f64>,
    /// What random speeds are made from.
    pub seed: u32,
    /// How long a message travels, in milliseconds, at most [`Settings::MOST_LATENCY`].
    pub latency: u32,
}

/// How fast the reference machine is emulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Tempo {
    /// So that the run takes about this many seconds.
    Lasts(u32),
    /// As fast as this computer can: a machine at full speed never waits.
    Full,
}

/// Speeds for all machines at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preset {
    /// All as fast as the reference machine.
    Equal,
    /// The last one at a tenth.
    OneSlow,
    /// Anything from a tenth to full speed, by the seed.
    Random,
    /// What stood in a laboratory of about 1997.
    Laboratory,
}

/// The machines of such a laboratory, by how fast they were. The first and the last are the article's (§9, Figures 6
/// and 7: 580 s and 6,099 s for the same picture); those between are guessed from their clocks.
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

impl Settings {
    /// What the window can draw and tell apart.
    pub const MOST_NODES: usize = 32;
    /// Beyond it nobody sees a difference.
    pub const MOST_SAMPLES: u32 = 8;
    /// In milliseconds.
    pub const MOST_LATENCY: u32 = 2000;
    /// Of a side of the picture, in pixels.
    pub const LONGEST_SIDE: u32 = 4096;
    /// Of a run in the window, which keeps every record.
    pub const MOST_ATOMS: u32 = 1 << 18;
    /// Seconds that a run may be asked to last.
    pub const LONGEST_RUN: u32 = 600;

    /// How the picture is cut.
    pub fn division(&self) -> Division {
        Division::new(self.size.pixels(), self.atom)
    }

    /// # Errors
    /// A sentence that says which setting is impossible, and what would be possible.
    pub fn check(&self) -> Result<(), String> {
        let within = |what: &str, value: u32, least: u32, most: u32| {
            let possible = (least..=most).contains(&value);
            if possible { Ok(()) } else { Err(format!("{what} can be {least} to {most}, not {value}")) }
        };
        Size::new(self.size.width(), self.size.height())?;
        within("The width", self.size.width(), 16, Self::LONGEST_SIDE)?;
        within("The height", self.size.height(), 16, Self::LONGEST_SIDE)?;
        within("Samples", self.samples, 1, Self::MOST_SAMPLES)?;
        within("The number of machines", self.speeds.len() as u32, 1, Self::MOST_NODES as u32)?;
        within("An atom's pixels", self.atom, 1, self.size.pixels())?;
        within("A part", self.part, 1, Self::MOST_ATOMS)?;
        within("The latency", self.latency, 0, Self::MOST_LATENCY)?;
        if let Tempo::Lasts(seconds) = self.tempo {
            within("A run's seconds", seconds, 1, Self::LONGEST_RUN)?;
        }
        if !self.speeds.iter().all(|speed| (0.0..=1.0).contains(speed)) {
            return Err("A speed can be 0 to 100 %".into());
        }
        let atoms = self.division().atoms();
        if atoms > Self::MOST_ATOMS {
            return Err(format!(
                "{} pixels in atoms of {} are {atoms} atoms; the window shows up to {}: larger atoms, or a smaller picture",
                self.size,
                self.atom,
                Self::MOST_ATOMS
            ));
        }
        Ok(())
    }

    /// Whether a run with the `other` settings would have to start anew to have these.
    pub fn needs_restart(&self, other: &Self) -> bool {
        let unlike = |a: &Self| {
            let mut bare = a.clone();
            bare.speeds = vec![0.0; a.speeds.len()];
            (bare.latency, bare.seed) = (0, 0);
            bare
        };
        unlike(self) != unlike(other)
    }

    /// As many machines, at the speeds that they have; new ones run at full speed.
    pub fn set_nodes(&mut self, nodes: usize) {
        self.speeds.resize(nodes.clamp(1, Self::MOST_NODES), 1.0);
    }

    /// Gives every machine a speed.
    pub fn set_preset(&mut self, preset: Preset) {
        self.speeds = self.preset(preset);
    }

    /// Whether the machines have these speeds.
    pub fn has_preset(&self, preset: Preset) -> bool {
        self.speeds == self.preset(preset)
    }

    fn preset(&self, preset: Preset) -> Vec<f64> {
        let nodes = self.speeds.len();
        match preset {
            Preset::Equal => vec![1.0; nodes],
            Preset::OneSlow => (0..nodes).map(|node| if node + 1 == nodes { 0.1 } else { 1.0 }).collect(),
            Preset::Random => {
                let mut random = fastrand::Rng::with_seed(self.seed.into());
                (0..nodes).map(|_| f64::from(random.u8(10..=100)) / 100.0).collect()
            }
            Preset::Laboratory => LABORATORY.iter().cycle().take(nodes).map(|(_, speed)| *speed).collect(),
        }
    }

    /// What a run with these settings is asked to do. The scene has a `name` and its file's `text`, `work` is the CPU time
    /// of the whole picture, `cores` are those of this computer.
    pub fn header(&self, name: &str, text: &str, work: Duration, cores: usize) -> Header {
        Header {
            scene: name.to_owned(),
            scene_text: text.to_owned(),
            size: self.size,
            samples: self.samples,
            division: self.division(),
            driver: Driver::Threads,
            rules: Rules { strategy: self.strategy, part: self.part, batch: Some(Rules::BATCH) },
            speeds: self.speeds.clone(),
            pace: self.pace(work, cores),
            link: Link { latency: self.latency_time(), bandwidth: None, shared: false },
            handling: Duration::ZERO,
            cores,
        }
    }

    /// The settings that a run with this header may have had.
    pub fn of(header: &Header, tempo: Tempo) -> Self {
        Self {
            size: header.size,
            samples: header.samples,
            atom: header.division.atom_pixels(),
            strategy: header.rules.strategy,
            part: header.rules.part,
            tempo: if header.pace < 1.0 { tempo } else { Tempo::Full },
            speeds: header.speeds.clone(),
            latency: u32::try_from(header.link.latency.as_millis()).unwrap_or(u32::MAX),
            ..Self::default()
        }
    }

    /// What these settings have that those `before` had not, in a few words.
    pub fn difference(&self, before: &Self) -> String {
        let mut words = Vec::new();
        let mut say = |differs: bool, text: String| words.extend(differs.then_some(text));
        let nodes = self.speeds.len();
        if nodes == before.speeds.len() {
            let changed: Vec<_> = (0..nodes).filter(|&node| self.speeds[node] != before.speeds[node]).collect();
            match changed[..] {
                [] => {}
                [node] => say(true, format!("machine {} at {:.0} %", node + 1, 100.0 * self.speeds[node])),
                _ => say(true, format!("other speeds for {} machines", changed.len())),
            }
        } else {
            say(true, if nodes == 1 { "1 machine".into() } else { format!("{nodes} machines") });
        }
        say(self.size != before.size, format!("{} pixels", self.size));
        say(self.samples != before.samples, format!("{0} × {0} samples a pixel", self.samples));
        say(self.atom != before.atom, format!("atoms of {} pixels", self.atom));
        say(self.strategy != before.strategy, format!("strategy {}", self.strategy));
        say(self.part != before.part, format!("at least {} atoms in a transfer", self.part));
        say(self.tempo != before.tempo, self.tempo.words());
        say(self.latency != before.latency, format!("{} ms a hop", self.latency));
        words.join(", ")
    }

    /// How long a message travels.
    pub fn latency_time(&self) -> Duration {
        Duration::from_millis(self.latency.into())
    }

    fn pace(&self, work: Duration, cores: usize) -> f64 {
        /// Not all machines are busy to the end, and those in a run find their caches colder than a probe does.
        const BUSY: f64 = 0.85;
        let sum: f64 = match self.strategy {
            Strategy::Serial => self.speeds[0],
            _ => self.speeds.iter().sum(),
        };
        match self.tempo {
            Tempo::Full => 1.0,
            // A computer that is too slow for this makes the run longer instead of late; 0 is not a pace.
            Tempo::Lasts(seconds) => {
                let wanted = work.as_secs_f64() / (BUSY * f64::from(seconds) * sum.max(1e-3));
                wanted.min(auto_pace(&self.speeds, cores)).clamp(1e-6, 0.999)
            }
        }
    }
}

impl Default for Settings {
    /// A run that a class can follow: eight machines of which the last is slow, 40 ms a hop, about 20 seconds. The sky
    /// is the first machine's, and so it is soon done and asks its left neighbour, the slow one, first.
    fn default() -> Self {
        let mut settings = Self {
            // Neither side is 0, and there are few pixels.
            size: Size::new(640, 480).expect("a possible size"),
            samples: 1,
            atom: 50,
            strategy: Strategy::Ring,
            part: 1,
            tempo: Tempo::Lasts(20),
            speeds: vec![1.0; 8],
            seed: 1,
            latency: 40,
        };
        settings.set_preset(Preset::OneSlow);
        settings
    }
}

impl Tempo {
    /// How fast that is, in a few words.
    pub fn words(self) -> String {
        match self {
            Self::Lasts(seconds) => format!("a run of about {seconds} s"),
            Self::Full => "full speed".into(),
        }
    }
}

impl Preset {
    /// All of them, in the order in which they are offered.
    pub const ALL: [Self; 4] = [Self::Equal, Self::OneSlow, Self::Random, Self::Laboratory];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Equal => "All equal",
            Self::OneSlow => "One slow",
            Self::Random => "Random",
            Self::Laboratory => "Old laboratory",
        }
    }

    /// What it does, in a sentence.
    pub fn hint(self) -> &'static str {
        match self {
            Self::Equal => "Every machine at full speed",
            Self::OneSlow => "One machine at 10 %, the others at full speed",
            Self::Random => "Each machine anywhere from 10 to 100 %, by the seed",
            Self::Laboratory => "Machines of a laboratory of 1997: Pentiums, 486s, and a busy HP 9000/710",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(change: impl FnOnce(&mut Settings)) -> Settings {
        let mut settings = Settings::default();
        change(&mut settings);
        settings
    }

    #[test]
    fn speeds_and_latency_act_at_once_and_the_rest_needs_a_restart() {
        let default = Settings::default();
        let at_once: [fn(&mut Settings); 3] = [|s| s.speeds[3] = 0.2, |s| s.latency = 7, |s| s.seed = 9];
        for change in at_once {
            assert!(!with(change).needs_restart(&default));
        }
        let anew: [fn(&mut Settings); 4] =
            [|s| s.set_nodes(3), |s| s.atom = 7, |s| s.tempo = Tempo::Full, |s| s.part = 9];
        for change in anew {
            assert!(with(change).needs_restart(&default));
        }
    }

    #[test]
    fn impossible_settings_are_told_in_words() {
        assert_eq!(Settings::default().check(), Ok(()));
        let complaint = |change: fn(&mut Settings)| with(change).check().unwrap_err();
        assert_eq!(complaint(|s| s.speeds.clear()), "The number of machines can be 1 to 32, not 0");
        assert_eq!(complaint(|s| s.speeds = vec![f64::NAN]), "A speed can be 0 to 100 %");
        assert!(complaint(|s| s.atom = 1).contains("307200 atoms; the window shows up to 262144"));
        assert!(complaint(|s| s.tempo = Tempo::Lasts(0)).starts_with("A run's seconds"));
    }

    #[test]
    fn presets_are_possible_and_repeatable() {
        for preset in Preset::ALL {
            for nodes in 1..=Settings::MOST_NODES {
                let made = |seed| {
                    with(|s| {
                        s.set_nodes(nodes);
                        s.seed = seed;
                        s.set_preset(preset);
                    })
                };
                assert_eq!(made(1).check(), Ok(()));
                assert!(made(1).has_preset(preset) && made(1) == made(1));
                assert!(nodes < 3 || preset != Preset::Random || made(1).speeds != made(2).speeds);
            }
        }
    }

    #[test]
    fn differences_are_told_in_a_few_words() {
        let told = |change: fn(&mut Settings)| with(change).difference(&Settings::default());
        assert_eq!(told(|_| {}), "");
        assert_eq!(told(|s| s.speeds[2] = 0.3), "machine 3 at 30 %");
        assert_eq!(told(|s| s.set_preset(Preset::Random)), "other speeds for 8 machines");
        assert_eq!(told(|s| (s.latency, s.atom) = (200, 10)), "atoms of 10 pixels, 200 ms a hop");
        assert_eq!(told(|s| s.set_nodes(1)), "1 machine");
    }

    #[test]
    fn a_run_lasts_as_long_as_it_is_asked_to() {
        let work = Duration::from_millis(300);
        for seconds in [10, 20, 60] {
            let pace = with(|s| s.tempo = Tempo::Lasts(seconds)).pace(work, 2);
            let lasts = work.as_secs_f64() / (pace * 7.1);
            assert!((lasts / f64::from(seconds) - 0.85).abs() < 0.01, "{lasts}");
        }
        assert_eq!(with(|s| s.tempo = Tempo::Full).pace(work, 2), 1.0);
        let slow = with(|s| s.speeds = vec![0.0; 2]).pace(work, 2);
        assert!(slow > 0.0 && slow < 1.0);
    }
}

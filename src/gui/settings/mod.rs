//! What the user has set: what a run is made from, and what acts on the run that goes on.

pub mod pace;
pub mod speed_preset;
pub mod undo;

mod difference;
mod header;

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::balance::{NodeId, Remedies, Strategy};
use crate::language::{Language, say, word};
use crate::picture::{Division, Quality, Size};
use crate::runlog::Driver;
use crate::view::Sharing;
use pace::Pace;
use speed_preset::SpeedPreset;

/// What the user has set. Speeds and latency act at once, everything else when a run starts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Width and height of the picture.
    pub size: Size,
    /// How good the picture is, with at most [`Settings::MOST_SAMPLES`].
    pub quality: Quality,
    /// Pixels in an atom.
    pub atom: u32,
    /// Who executes the run: in real time, in virtual time, or rayon by its own rules.
    pub driver: Driver,
    /// How the atoms are shared, unless rayon shares them.
    pub strategy: Strategy,
    /// In a ring, an offer is worth taking if it moves at least this many atoms. In a farm, the atoms of a part.
    pub part: u32,
    /// How fast the reference machine is emulated.
    pub tempo: Pace,
    /// A machine a speed, as fractions of the reference machine.
    pub speeds: Vec<f64>,
    /// Machines that are off at first and may join, in a ring that adapts: a speed each, at most [`Settings::MOST_SPARES`].
    pub spares: Vec<f64>,
    /// What a ring that adapts does otherwise than the article's.
    pub remedies: Remedies,
    /// What random speeds are made from.
    pub seed: u32,
    /// How long a message travels, in milliseconds, at most [`Settings::MOST_LATENCY`].
    pub latency: u32,
    /// How long the parent is busy with each message, in milliseconds, at most [`Settings::MOST_HANDLING`].
    pub handling: u32,
    /// What a link carries, in kB a second, at most [`Settings::MOST_BANDWIDTH`]; 0 is unlimited.
    pub bandwidth: u32,
    /// Whether all share one wire; else each pair has one of its own.
    pub shared_wire: bool,
}

impl Settings {
    /// What the window can draw and tell apart.
    pub const MOST_NODES: usize = 32;
    /// More of them would leave little room for the others.
    pub const MOST_SPARES: usize = 4;
    /// Beyond it nobody sees a difference.
    pub const MOST_SAMPLES: u32 = 8;
    /// In milliseconds.
    pub const MOST_LATENCY: u32 = 2000;
    /// In milliseconds.
    pub const MOST_HANDLING: u32 = 1000;
    /// In kB a second: a gigabit, beside which no limit is the same.
    pub const MOST_BANDWIDTH: u32 = 125_000;
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
    pub fn check(&self, language: Language) -> Result<(), String> {
        let within = |what: &str, value: u32, least: u32, most: u32| {
            let possible = (least..=most).contains(&value);
            let why = || {
                say!(
                    language,
                    "{what} can be {least} to {most}, not {value}",
                    "{what}: pode ser de {least} a {most}, não {value}"
                )
            };
            if possible { Ok(()) } else { Err(why()) }
        };
        Size::new(self.size.width(), self.size.height())?;
        within(word!(language, "The width", "Largura"), self.size.width(), 16, Self::LONGEST_SIDE)?;
        within(word!(language, "The height", "Altura"), self.size.height(), 16, Self::LONGEST_SIDE)?;
        within(word!(language, "Samples", "Amostras"), self.quality.samples, 1, Self::MOST_SAMPLES)?;
        self.quality.check()?;
        let machines = word!(language, "The number of machines", "Número de máquinas");
        within(
            machines,
            self.speeds.len() as u32,
            1,
            (Self::MOST_NODES - self.spares.len().min(Self::MOST_SPARES)) as u32,
        )?;
        let spares = word!(language, "The number of spare machines", "Número de máquinas de reserva");
        within(spares, self.spares.len() as u32, 0, Self::MOST_SPARES as u32)?;
        within(word!(language, "An atom's pixels", "Pixels de um átomo"), self.atom, 1, self.size.pixels())?;
        within(word!(language, "A part", "Uma parte"), self.part, 1, Self::MOST_ATOMS)?;
        within(word!(language, "The latency", "Latência"), self.latency, 0, Self::MOST_LATENCY)?;
        let handling = word!(language, "The parent's time for a message", "Tempo do pai por mensagem");
        within(handling, self.handling, 0, Self::MOST_HANDLING)?;
        let bandwidth = word!(language, "A link's kB a second", "kB por segundo de um enlace");
        within(bandwidth, self.bandwidth, 0, Self::MOST_BANDWIDTH)?;
        if let Pace::Lasts(seconds) = self.tempo {
            within(word!(language, "A run's seconds", "Segundos de uma execução"), seconds, 1, Self::LONGEST_RUN)?;
        }
        if !self.all_speeds().all(|speed| (0.0..=1.0).contains(&speed)) {
            return Err(word!(language, "A speed can be 0 to 100 %", "Uma velocidade pode ser de 0 a 100 %").into());
        }
        let (atoms, most) = (self.division().atoms(), Self::MOST_ATOMS);
        if atoms > most {
            let (size, atom) = (self.size, self.atom);
            return Err(say!(
                language,
                "{size} pixels in atoms of {atom} are {atoms} atoms; the window shows up to {most}: larger atoms, or a \
                 smaller picture",
                "{size} pixels em átomos de {atom} são {atoms} átomos; a janela mostra até {most}: átomos maiores, ou \
                 imagem menor"
            ));
        }
        Ok(())
    }

    /// Whether a run with the `other` settings would have to start anew to have these.
    pub fn needs_restart(&self, other: &Self) -> bool {
        let unlike = |a: &Self| {
            let mut bare = a.clone();
            bare.speeds = vec![0.0; a.speeds.len()];
            bare.spares = vec![0.0; a.spares.len()];
            (bare.latency, bare.seed) = (0, 0);
            bare
        };
        unlike(self) != unlike(other)
    }

    /// As many machines, at the speeds that they have; new ones run at full speed.
    pub fn set_nodes(&mut self, nodes: usize) {
        self.speeds.resize(nodes.clamp(1, Self::MOST_NODES - self.spares.len()), 1.0);
    }

    /// As many spare machines, if there is room for them.
    pub fn set_spares(&mut self, spares: usize) {
        self.spares.resize(spares.min(Self::MOST_SPARES).min(Self::MOST_NODES - self.speeds.len()), 1.0);
    }

    /// The speeds of all machines, the spare ones last.
    pub fn all_speeds(&self) -> impl Iterator<Item = f64> {
        self.speeds.iter().chain(&self.spares).copied()
    }

    /// Gives a machine a speed; it may be a spare one.
    pub fn set_speed(&mut self, node: NodeId, speed: f64) {
        if let Some(known) = self.speeds.iter_mut().chain(&mut self.spares).nth(node.into()) {
            *known = speed;
        }
    }

    /// Gives every machine a speed.
    pub fn set_preset(&mut self, preset: SpeedPreset) {
        self.speeds = preset.speeds(self.speeds.len(), self.seed.into());
    }

    /// Whether the machines have these speeds.
    pub fn has_preset(&self, preset: SpeedPreset) -> bool {
        self.speeds == preset.speeds(self.speeds.len(), self.seed.into())
    }

    /// How the atoms are shared.
    pub fn sharing(&self) -> Sharing {
        if self.driver == Driver::WorkStealing { Sharing::Stealing } else { Sharing::By(self.strategy) }
    }

    /// Shares the atoms so, with what is usual then: virtual time stays, unless rayon is to share them.
    pub fn set_sharing(&mut self, sharing: Sharing) {
        match sharing {
            Sharing::Stealing => {
                self.driver = Driver::WorkStealing;
                self.spares.clear();
            }
            Sharing::By(strategy) => {
                if self.driver == Driver::WorkStealing {
                    self.driver = Driver::Threads;
                }
                self.strategy = strategy;
                self.part = strategy.usual_part(self.division(), self.speeds.len());
                self.set_spares(if strategy == Strategy::Adaptive { 1 } else { 0 });
            }
        }
    }

    /// How long a message travels.
    pub fn latency_time(&self) -> Duration {
        Duration::from_millis(self.latency.into())
    }
}

impl Default for Settings {
    /// A run that a class can follow: eight machines of which the last is slow, 40 ms a hop, about 20 seconds. The sky
    /// is the first machine's, and so it is soon done and asks its left neighbour, the slow one, first.
    fn default() -> Self {
        let mut settings = Self {
            // Neither side is 0, and there are few pixels.
            size: Size::new(640, 480).expect("a possible size"),
            quality: Quality::default(),
            atom: 50,
            driver: Driver::Threads,
            strategy: Strategy::Ring,
            part: 1,
            tempo: Pace::Lasts(20),
            speeds: vec![1.0; 8],
            spares: Vec::new(),
            remedies: Remedies::ALL,
            seed: 1,
            latency: 40,
            handling: 0,
            bandwidth: 0,
            shared_wire: false,
        };
        settings.set_preset(SpeedPreset::OneSlow);
        settings
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::Rules;

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
        let anew: [fn(&mut Settings); 8] = [
            |s| s.set_nodes(3),
            |s| s.atom = 7,
            |s| s.tempo = Pace::Full,
            |s| s.part = 9,
            |s| s.driver = Driver::Sim,
            |s| s.handling = 20,
            |s| s.bandwidth = 100,
            |s| s.shared_wire = true,
        ];
        for change in anew {
            assert!(with(change).needs_restart(&default));
        }
    }

    #[test]
    fn impossible_settings_are_told_in_words() {
        let language = Language::English;
        assert_eq!(Settings::default().check(language), Ok(()));
        let complaint = |change: fn(&mut Settings)| with(change).check(language).unwrap_err();
        assert_eq!(complaint(|s| s.speeds.clear()), "The number of machines can be 1 to 32, not 0");
        assert_eq!(complaint(|s| s.speeds = vec![f64::NAN]), "A speed can be 0 to 100 %");
        assert!(complaint(|s| s.atom = 1).contains("307200 atoms; the window shows up to 262144"));
        assert!(complaint(|s| s.tempo = Pace::Lasts(0)).starts_with("A run's seconds"));
    }

    #[test]
    fn differences_are_told_in_a_few_words() {
        let language = Language::English;
        let told = |change: fn(&mut Settings)| with(change).difference(&Settings::default(), language);
        assert_eq!(told(|_| {}), "");
        assert_eq!(told(|s| s.speeds[2] = 0.3), "machine 3 at 30 %");
        assert_eq!(told(|s| s.set_preset(SpeedPreset::Random)), "other speeds for 8 machines");
        assert_eq!(told(|s| (s.latency, s.atom) = (200, 10)), "atoms of 10 pixels, 200 ms a hop");
        assert_eq!(told(|s| s.set_nodes(1)), "1 machine");
        let farm = Sharing::By(Strategy::Farm);
        assert_eq!(with(|s| s.set_sharing(farm)).difference(&Settings::default(), language), "farm");
        assert_eq!(told(|s| s.set_sharing(Sharing::Stealing)), "work stealing (rayon)");
        assert_eq!(told(|s| (s.driver, s.part) = (Driver::Sim, 5)), "virtual time, 5 atoms in a transfer at least");
        assert_eq!(
            told(|s| (s.handling, s.bandwidth, s.shared_wire) = (20, 100, true)),
            "20 ms a message for the parent, links of 100 kB/s, one wire for all"
        );
    }

    #[test]
    fn a_strategy_brings_what_is_usual_and_rayon_knows_no_virtual_time() {
        let farm = with(|s| s.set_sharing(Sharing::By(Strategy::Farm)));
        assert_eq!((farm.part, farm.sharing()), (6144 / 128, Sharing::By(Strategy::Farm)));
        let mut settings = with(|s| s.driver = Driver::Sim);
        settings.set_sharing(Sharing::By(Strategy::Static));
        assert_eq!((settings.driver, settings.part), (Driver::Sim, 1));
        settings.set_sharing(Sharing::Stealing);
        assert_eq!((settings.driver, settings.sharing()), (Driver::WorkStealing, Sharing::Stealing));
        settings.set_sharing(Sharing::By(Strategy::Ring));
        assert_eq!(settings, Settings::default());
    }

    #[test]
    fn spare_machines_come_with_the_ring_that_adapts() {
        let language = Language::English;
        let mut settings = with(|s| s.set_sharing(Sharing::By(Strategy::Adaptive)));
        assert_eq!((settings.spares.len(), settings.speeds.len()), (1, 8));
        settings.set_speed(8, 0.5);
        let header = settings.header("", "", Duration::from_millis(300), 2);
        assert_eq!((header.spares, header.speeds.len(), header.speeds[8]), (1, 9, 0.5));
        assert!(header.is_spare(8) && !header.is_spare(7));
        assert_eq!(Settings::of(&header, settings.tempo), settings);
        let more = Settings { spares: vec![1.0; 2], ..settings.clone() };
        assert!(more.needs_restart(&settings));
        assert_eq!(more.difference(&settings, language), "2 spare machines");
        settings.set_nodes(32);
        assert_eq!((settings.speeds.len(), settings.check(language)), (31, Ok(())));
        settings.set_sharing(Sharing::By(Strategy::Ring));
        assert!(settings.spares.is_empty());
    }

    #[test]
    fn a_run_keeps_what_it_was_asked_to_do() {
        let settings = with(|s| {
            s.set_sharing(Sharing::By(Strategy::FarmBySpeed));
            (s.driver, s.handling, s.bandwidth, s.shared_wire, s.part) = (Driver::Sim, 20, 100, true, 7);
        });
        let header = settings.header("", "", Duration::from_millis(300), 2);
        assert_eq!((header.cores, header.link.bandwidth), (8, Some(1e5)));
        assert_eq!(header.rules.batch, Some(Duration::from_millis(320)));
        assert_eq!(Settings::of(&header, settings.tempo), settings);
        assert_eq!(
            with(|s| s.tempo = Pace::Lasts(5)).header("", "", Duration::ZERO, 2).rules.batch,
            Some(Rules::BATCH)
        );
    }

    #[test]
    fn a_run_lasts_as_long_as_it_is_asked_to() {
        let work = Duration::from_millis(300);
        for seconds in [10, 20, 60] {
            let pace = with(|s| s.tempo = Pace::Lasts(seconds)).pace(work, 2);
            let lasts = work.as_secs_f64() / (pace * 7.1);
            assert!((lasts / f64::from(seconds) - 0.85).abs() < 0.01, "{lasts}");
        }
        assert_eq!(with(|s| s.tempo = Pace::Full).pace(work, 2), 1.0);
        let slow = with(|s| s.speeds = vec![0.0; 2]).pace(work, 2);
        assert!(slow > 0.0 && slow < 1.0);
    }
}

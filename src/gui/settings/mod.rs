//! The user's settings: the input of the next run, and what changes the present run at once.

pub mod latency_steps;
pub mod pace;
pub mod speed_preset;
pub mod speed_steps;
pub mod undo;

mod difference;
mod header;
mod own_links;

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::balance::{NodeId, Remedies, Scheduler, Strategy};
use crate::language::{Language, say, word};
use crate::picture::{Division, Quality, Size};
use crate::runlog::Driver;
pub use own_links::OwnLinkSetting;
use pace::Pace;
use speed_preset::SpeedPreset;

/// The user's settings. Speeds and latency take effect at once, all other values when a run starts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Width and height of the picture.
    pub size: Size,
    /// Quality of the picture, with at most [`Settings::MAX_SAMPLES`].
    pub quality: Quality,
    /// Pixels in an atom.
    pub atom: u32,
    /// Driver of the run: real time, virtual time, or rayon.
    pub driver: Driver,
    /// Strategy by which the atoms are shared; unused with rayon.
    pub strategy: Strategy,
    /// In a ring the fewest atoms of a transfer; in a farm the atoms of a part.
    pub part: u32,
    /// Emulated speed of the reference machine.
    #[serde(rename = "tempo")]
    pub pace: Pace,
    /// Speed of each machine, as a fraction of the reference machine, 0 to 1.
    pub speeds: Vec<f64>,
    /// Speed of each spare machine, at most [`Settings::MAX_SPARES`]. Spare machines are off at first and may join the
    /// adaptive ring or the farm with leases.
    pub spares: Vec<f64>,
    /// Remedies of the adaptive ring.
    pub remedies: Remedies,
    /// Seed of random speeds.
    pub seed: u32,
    /// Travel time of a message in milliseconds, at most [`Settings::MAX_LATENCY_MS`].
    pub latency: f64,
    /// Time that the parent takes for each message in milliseconds, at most [`Settings::MAX_HANDLING_MS`].
    pub handling: f64,
    /// Bandwidth of a link in kB/s, at most [`Settings::MAX_BANDWIDTH_KB_S`]; 0 is unlimited.
    pub bandwidth: u32,
    /// Whether all machines share one wire; else each pair has its own.
    pub shared_wire: bool,
    /// What each machine has of its own, spare ones last; machines after the last one have nothing.
    pub own_links: Vec<OwnLinkSetting>,
    /// What the parent has of its own.
    pub parent_link: OwnLinkSetting,
}

impl Settings {
    /// Most machines that the window can show distinctly, spare ones included.
    pub const MAX_NODES: usize = 32;
    /// Most spare machines; they take room from the others.
    pub const MAX_SPARES: usize = 4;
    /// Most samples n of n × n a pixel; more make no visible difference.
    pub const MAX_SAMPLES: u32 = 8;
    /// Longest travel time of a message, in milliseconds.
    pub const MAX_LATENCY_MS: f64 = 2000.0;
    /// Longest time of the parent for a message, in milliseconds.
    pub const MAX_HANDLING_MS: f64 = 1000.0;
    /// Highest limit of a link, in kB/s: 1 Gbit/s, which acts like no limit.
    pub const MAX_BANDWIDTH_KB_S: u32 = 125_000;
    /// Longest side of the picture, in pixels.
    pub const MAX_SIDE_PX: u32 = 4096;
    /// Most atoms of a run; the window keeps all records in memory.
    pub const MAX_ATOMS: u32 = 1 << 18;
    /// Longest run that can be set, in seconds.
    pub const MAX_RUN_S: f64 = 600.0;

    /// Returns the division of the picture into atoms.
    pub fn division(&self) -> Division {
        Division::new(self.size.pixels(), self.atom)
    }

    /// Checks all values against their limits.
    ///
    /// # Errors
    /// A sentence with the wrong setting and its possible values.
    pub fn check(&self, language: Language) -> Result<(), String> {
        let within_reals = |name: &str, value: f64, min: f64, max: f64| {
            if (min..=max).contains(&value) {
                return Ok(());
            }
            Err(say!(
                language,
                "{name}: choose a value from {min} to {max} instead of {value}",
                "{name}: escolha um valor de {min} a {max} em vez de {value}"
            ))
        };
        let within =
            |name: &str, value: u32, min: u32, max: u32| within_reals(name, value.into(), min.into(), max.into());
        Size::new(self.size.width(), self.size.height())?;
        within(word!(language, "Width", "Largura"), self.size.width(), 16, Self::MAX_SIDE_PX)?;
        within(word!(language, "Height", "Altura"), self.size.height(), 16, Self::MAX_SIDE_PX)?;
        within(word!(language, "Samples", "Amostras"), self.quality.samples, 1, Self::MAX_SAMPLES)?;
        self.quality.check()?;
        let machines = word!(language, "Number of machines", "Número de máquinas");
        within(
            machines,
            self.speeds.len() as u32,
            1,
            (Self::MAX_NODES - self.spares.len().min(Self::MAX_SPARES)) as u32,
        )?;
        let spares = word!(language, "Number of spare machines", "Número de máquinas de reserva");
        within(spares, self.spares.len() as u32, 0, Self::MAX_SPARES as u32)?;
        within(word!(language, "Pixels in an atom", "Pixels num átomo"), self.atom, 1, self.size.pixels())?;
        within(word!(language, "Atoms in a part", "Átomos numa parte"), self.part, 1, Self::MAX_ATOMS)?;
        within_reals(word!(language, "Latency in ms", "Latência em ms"), self.latency, 0.0, Self::MAX_LATENCY_MS)?;
        let handling = word!(language, "Parent's time for a message in ms", "Tempo do pai por mensagem em ms");
        within_reals(handling, self.handling, 0.0, Self::MAX_HANDLING_MS)?;
        let bandwidth = word!(language, "Bandwidth of a link in kB/s", "Banda de um enlace em kB/s");
        within(bandwidth, self.bandwidth, 0, Self::MAX_BANDWIDTH_KB_S)?;
        for own in self.own_links.iter().chain([&self.parent_link]) {
            let latency = word!(language, "A machine's latency in ms", "Latência de uma máquina em ms");
            within_reals(latency, own.latency.unwrap_or_default(), 0.0, Self::MAX_LATENCY_MS)?;
            let bandwidth = word!(language, "A machine's bandwidth in kB/s", "Banda de uma máquina em kB/s");
            within(bandwidth, own.bandwidth.unwrap_or(1), 1, Self::MAX_BANDWIDTH_KB_S)?;
        }
        if let Pace::Lasts(seconds) = self.pace {
            let name = word!(language, "Seconds of the run", "Segundos da execução");
            within_reals(name, seconds, 1.0, Self::MAX_RUN_S)?;
        }
        if !self.all_speeds().all(|speed| (0.0..=1.0).contains(&speed)) {
            return Err(word!(
                language,
                "Speed: choose a value from 0 to 100 %",
                "Velocidade: escolha um valor de 0 a 100 %"
            )
            .into());
        }
        let (atoms, max) = (self.division().atoms(), Self::MAX_ATOMS);
        if atoms > max {
            let (size, atom) = (self.size, self.atom);
            return Err(say!(
                language,
                "{size} pixels in atoms of {atom} are {atoms} atoms; the window shows up to {max}. Choose larger atoms or a \
                smaller picture",
                "{size} pixels em átomos de {atom} são {atoms} átomos; a janela mostra até {max}. Escolha átomos maiores ou \
                uma imagem menor"
            ));
        }
        Ok(())
    }

    /// Whether a run with the `other` settings must restart to get these.
    pub fn needs_restart(&self, other: &Self) -> bool {
        // Without the values that take effect at once.
        let fixed = |settings: &Self| {
            let mut fixed = settings.clone();
            fixed.speeds = vec![0.0; settings.speeds.len()];
            fixed.spares = vec![0.0; settings.spares.len()];
            (fixed.latency, fixed.seed) = (0.0, 0);
            fixed.clear_own_latencies();
            fixed
        };
        fixed(self) != fixed(other)
    }

    /// Sets the number of machines. A preset of speeds stays; else machines that stay keep their speeds, and new ones
    /// run at full speed.
    pub fn set_nodes(&mut self, nodes: usize) {
        let before = self.speeds.len();
        let preset = SpeedPreset::ALL.into_iter().find(|preset| self.has_preset(*preset));
        self.speeds.resize(nodes.clamp(1, Self::MAX_NODES - self.spares.len()), 1.0);
        if let Some(preset) = preset {
            self.set_preset(preset);
        }
        self.move_spare_links(before);
    }

    /// Sets the number of spare machines, within the limits.
    pub fn set_spares(&mut self, spares: usize) {
        self.spares.resize(spares.min(Self::MAX_SPARES).min(Self::MAX_NODES - self.speeds.len()), 1.0);
        self.trim_links();
    }

    /// Iterates over the speeds of all machines, spare ones last.
    pub fn all_speeds(&self) -> impl Iterator<Item = f64> {
        self.speeds.iter().chain(&self.spares).copied()
    }

    /// Sets the speed of a machine, which may be a spare one.
    pub fn set_speed(&mut self, node: NodeId, speed: f64) {
        if let Some(old) = self.speeds.iter_mut().chain(&mut self.spares).nth(node.into()) {
            *old = speed;
        }
    }

    /// Sets the speeds of all machines but the spare ones.
    pub fn set_preset(&mut self, preset: SpeedPreset) {
        self.speeds = preset.speeds(self.speeds.len(), self.seed.into());
    }

    /// Whether the machines have the speeds of the preset.
    pub fn has_preset(&self, preset: SpeedPreset) -> bool {
        self.speeds == preset.speeds(self.speeds.len(), self.seed.into())
    }

    /// Returns who shares the atoms: rayon, or a protocol with its strategy.
    pub fn scheduler(&self) -> Scheduler {
        if self.driver == Driver::WorkStealing {
            Scheduler::WorkStealing
        } else {
            Scheduler::Protocol(self.strategy.clone())
        }
    }

    /// Sets who shares the atoms, with the usual part and spare machines. Virtual time stays, except with rayon.
    pub fn set_scheduler(&mut self, scheduler: Scheduler) {
        match scheduler {
            Scheduler::WorkStealing => {
                self.driver = Driver::WorkStealing;
                self.set_spares(0);
            }
            Scheduler::Protocol(strategy) => {
                if self.driver == Driver::WorkStealing {
                    self.driver = Driver::Threads;
                }
                self.part = strategy.usual_part(self.division(), self.speeds.len());
                self.strategy = strategy;
                self.set_spares(if self.strategy.survives_losses() { 1 } else { 0 });
            }
        }
    }

    /// Returns the travel time of a message.
    pub fn latency_time(&self) -> Duration {
        milliseconds(self.latency)
    }
}

/// Returns the length of time of a setting in milliseconds.
pub(super) fn milliseconds(ms: f64) -> Duration {
    // A stored setting may be no number; it is checked, but not before this.
    Duration::try_from_secs_f64(ms / 1e3).unwrap_or_default()
}

impl Default for Settings {
    /// Returns a run that a class can follow: eight machines of which the last is slow, 40 ms a hop, about 20 seconds.
    /// Machine 1 has the sky, so it finishes early, and its offer goes first to its left neighbour, the slow machine.
    fn default() -> Self {
        let mut settings = Self {
            // Size::new fails only for an empty or a huge picture.
            size: Size::new(640, 480).expect("a possible size"),
            quality: Quality::default(),
            atom: 50,
            driver: Driver::Threads,
            strategy: Strategy::Ring,
            part: 1,
            pace: Pace::Lasts(20.0),
            speeds: vec![1.0; 8],
            spares: Vec::new(),
            remedies: Remedies::ALL,
            seed: 1,
            latency: 40.0,
            handling: 0.0,
            bandwidth: 0,
            shared_wire: false,
            own_links: Vec::new(),
            parent_link: OwnLinkSetting::default(),
        };
        settings.set_preset(SpeedPreset::OneSlow);
        settings
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::{Party, Rules};

    fn with(change: impl FnOnce(&mut Settings)) -> Settings {
        let mut settings = Settings::default();
        change(&mut settings);
        settings
    }

    #[test]
    fn speeds_and_latency_need_no_restart_and_the_rest_does() {
        let default = Settings::default();
        let at_once: [fn(&mut Settings); 4] = [
            |s| s.speeds[3] = 0.2,
            |s| s.latency = 7.5,
            |s| s.seed = 9,
            |s| s.set_own_link(Party::Node(3), OwnLinkSetting { latency: Some(7.5), bandwidth: None }),
        ];
        for change in at_once {
            assert!(!with(change).needs_restart(&default));
        }
        let with_restart: [fn(&mut Settings); 9] = [
            |s| s.set_nodes(3),
            |s| s.atom = 7,
            |s| s.pace = Pace::Full,
            |s| s.part = 9,
            |s| s.driver = Driver::Sim,
            |s| s.handling = 2.5,
            |s| s.bandwidth = 100,
            |s| s.set_own_link(Party::Node(3), OwnLinkSetting { latency: None, bandwidth: Some(7) }),
            |s| s.shared_wire = true,
        ];
        for change in with_restart {
            assert!(with(change).needs_restart(&default));
        }
    }

    #[test]
    fn preset_of_speeds_stays_with_another_number_of_machines() {
        for preset in SpeedPreset::ALL {
            let settings = with(|s| {
                s.set_preset(preset);
                s.set_nodes(16);
                s.set_nodes(5);
            });
            assert!(settings.has_preset(preset), "{preset:?}: {:?}", settings.speeds);
        }
        let own = with(|s| {
            s.speeds[2] = 0.3;
            s.set_nodes(10);
        });
        assert_eq!(own.speeds, [1.0, 1.0, 0.3, 1.0, 1.0, 1.0, 1.0, 0.1, 1.0, 1.0]);
    }

    #[test]
    fn check_names_the_setting_and_its_limits() {
        let language = Language::English;
        assert_eq!(Settings::default().check(language), Ok(()));
        let complaint = |change: fn(&mut Settings)| with(change).check(language).unwrap_err();
        assert_eq!(complaint(|s| s.speeds.clear()), "Number of machines: choose a value from 1 to 32 instead of 0");
        assert_eq!(complaint(|s| s.speeds = vec![f64::NAN]), "Speed: choose a value from 0 to 100 %");
        assert!(complaint(|s| s.atom = 1).contains("307200 atoms; the window shows up to 262144"));
        assert!(complaint(|s| s.pace = Pace::Lasts(0.0)).starts_with("Seconds of the run"));
    }

    #[test]
    fn difference_lists_changed_values() {
        let language = Language::English;
        let told = |change: fn(&mut Settings)| with(change).difference(&Settings::default(), language);
        assert_eq!(told(|_| {}), "");
        assert_eq!(told(|s| s.speeds[2] = 0.3), "machine 3 at 30 %");
        assert_eq!(told(|s| s.set_preset(SpeedPreset::Random)), "new speeds for 8 machines");
        assert_eq!(told(|s| (s.latency, s.atom) = (12.5, 10)), "atoms of 10 pixels, 12.5 ms a hop");
        assert_eq!(told(|s| s.set_nodes(1)), "1 machine");
        let farm = Scheduler::Protocol(Strategy::Farm);
        assert_eq!(with(|s| s.set_scheduler(farm)).difference(&Settings::default(), language), "farm");
        assert_eq!(told(|s| s.set_scheduler(Scheduler::WorkStealing)), "work stealing (rayon)");
        assert_eq!(told(|s| (s.driver, s.part) = (Driver::Sim, 5)), "virtual time, at least 5 atoms in a transfer");
        assert_eq!(
            told(|s| (s.handling, s.bandwidth, s.shared_wire) = (20.0, 100, true)),
            "the parent takes 20 ms for a message, links of 100 kB/s, one wire for all machines"
        );
    }

    #[test]
    fn strategy_sets_its_usual_part_and_rayon_leaves_virtual_time() {
        let farm = with(|s| s.set_scheduler(Scheduler::Protocol(Strategy::Farm)));
        assert_eq!((farm.part, farm.scheduler()), (6144 / 128, Scheduler::Protocol(Strategy::Farm)));
        let mut settings = with(|s| s.driver = Driver::Sim);
        settings.set_scheduler(Scheduler::Protocol(Strategy::Static));
        assert_eq!((settings.driver, settings.part), (Driver::Sim, 1));
        settings.set_scheduler(Scheduler::WorkStealing);
        assert_eq!((settings.driver, settings.scheduler()), (Driver::WorkStealing, Scheduler::WorkStealing));
        settings.set_scheduler(Scheduler::Protocol(Strategy::Ring));
        assert_eq!(settings, Settings::default());
    }

    #[test]
    fn adaptive_ring_has_a_spare_machine() {
        let language = Language::English;
        let mut settings = with(|s| s.set_scheduler(Scheduler::Protocol(Strategy::Adaptive)));
        assert_eq!((settings.spares.len(), settings.speeds.len()), (1, 8));
        settings.set_speed(8, 0.5);
        let header = settings.header("", "", Duration::from_millis(300), 2);
        assert_eq!((header.spares, header.speeds.len(), header.speeds[8]), (1, 9, 0.5));
        assert!(header.is_spare(8) && !header.is_spare(7));
        assert_eq!(Settings::of(&header, settings.pace), settings);
        let more = Settings { spares: vec![1.0; 2], ..settings.clone() };
        assert!(more.needs_restart(&settings));
        assert_eq!(more.difference(&settings, language), "2 spare machines");
        settings.set_nodes(32);
        assert_eq!((settings.speeds.len(), settings.check(language)), (31, Ok(())));
        settings.set_scheduler(Scheduler::Protocol(Strategy::Ring));
        assert!(settings.spares.is_empty());
    }

    #[test]
    fn header_keeps_the_settings() {
        let settings = with(|s| {
            s.set_scheduler(Scheduler::Protocol(Strategy::FarmBySpeed));
            (s.driver, s.handling, s.bandwidth, s.shared_wire, s.part) = (Driver::Sim, 20.0, 100, true, 7);
            s.set_own_link(Party::Node(6), OwnLinkSetting { latency: Some(3.0), bandwidth: Some(2) });
            s.parent_link.latency = Some(1.0);
        });
        let header = settings.header("", "", Duration::from_millis(300), 2);
        assert_eq!((header.cores, header.link.bandwidth), (8, Some(1e5)));
        assert_eq!(header.rules.batch, Some(Duration::from_millis(320)));
        assert_eq!(Settings::of(&header, settings.pace), settings);
        assert_eq!(
            with(|s| s.pace = Pace::Lasts(5.0)).header("", "", Duration::ZERO, 2).rules.batch,
            Some(Rules::BATCH)
        );
    }

    #[test]
    fn pace_makes_the_run_last_the_set_seconds() {
        let work = Duration::from_millis(300);
        for seconds in [10.0, 20.0, 60.0] {
            let pace = with(|s| s.pace = Pace::Lasts(seconds)).pace_fraction(work, 2);
            let lasts = work.as_secs_f64() / (pace * 7.1);
            assert!((lasts / seconds - 0.85).abs() < 0.01, "{lasts}");
        }
        assert_eq!(with(|s| s.pace = Pace::Full).pace_fraction(work, 2), 1.0);
        let slow = with(|s| s.speeds = vec![0.0; 2]).pace_fraction(work, 2);
        assert!(slow > 0.0 && slow < 1.0);
    }
}

//! The header of a run: all its settings, enough to start it again.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::{LinkSettings, Metadata};
use crate::balance::{NodeId, Remedies, Remedy, Rules, Scheduler, Strategy};
use crate::picture::{Division, Quality, Size};

/// The settings of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// Name of the scene, for display.
    pub scene: String,
    /// Text of the scene file, which each band carries.
    pub scene_text: String,
    /// Width and height of the picture.
    pub size: Size,
    /// Quality of the picture.
    #[serde(flatten)]
    pub quality: Quality,
    /// Division of the picture into atoms.
    pub division: Division,
    /// Driver that executes the run.
    pub driver: Driver,
    /// Strategy and its parameters; [`Driver::WorkStealing`] ignores them.
    pub rules: Rules,
    /// By node: speed as a fraction of the reference machine's (1 = 100 %).
    pub speeds: Vec<f64>,
    /// Number of spare nodes: the last ones, which are off at first and may join the run. Only strategies that let
    /// machines in can have some ([`Strategy::survives_losses`]).
    #[serde(default, skip_serializing_if = "is_zero")]
    pub spares: NodeId,
    /// Fraction of a real core that the reference machine gets, above 0 and at most 1. At pace 1 a node of speed 1
    /// never waits.
    pub pace: f64,
    /// The network.
    pub link: LinkSettings,
    /// Time that the parent is busy with each message.
    pub handling: Duration,
    /// Number of cores of the computer that emulates the machines; in virtual time the number of machines.
    pub cores: usize,
    /// Title, notes and computer of the run; empty in older files.
    #[serde(default, skip_serializing_if = "Metadata::is_empty")]
    pub caption: Metadata,
}

/// A driver: it executes runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Driver {
    /// Real time: one thread for each node, which is both its handler and its worker.
    Threads,
    /// Real time: one thread for each node's handler and one for its worker, as in the article (§8). At full speed
    /// only.
    Pairs,
    /// Virtual time.
    Sim,
    /// Real time: rayon's work stealing over the atoms, one thread for each node; no strategy of ours. The threads
    /// share their memory, so messages do not travel, and [`Header::link`] and [`Header::handling`] do not apply.
    WorkStealing,
}

impl Driver {
    /// Returns the name in reports and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Threads => "threads",
            Self::Pairs => "pairs",
            Self::Sim => "sim",
            Self::WorkStealing => "rayon",
        }
    }
}

impl Header {
    /// Creates a header with defaults: atoms of `atom_pixels` pixels, nodes of these speeds, threads at full pace,
    /// links that take no time, one core for each machine, and the strategy's default rules.
    pub fn plain(size: Size, atom_pixels: u32, strategy: Strategy, speeds: Vec<f64>) -> Self {
        let division = Division::new(size.pixels(), atom_pixels);
        Self {
            scene: String::new(),
            scene_text: String::new(),
            size,
            quality: Quality::default(),
            division,
            driver: Driver::Threads,
            rules: Rules::usual(strategy, division, speeds.len()),
            pace: 1.0,
            link: LinkSettings::default(),
            handling: Duration::ZERO,
            cores: speeds.len(),
            speeds,
            spares: 0,
            caption: Metadata::default(),
        }
    }

    /// Returns the scheduler: [`Driver::WorkStealing`] ignores the strategy of the rules.
    pub fn scheduler(&self) -> Scheduler {
        match self.driver {
            Driver::WorkStealing => Scheduler::WorkStealing,
            Driver::Threads | Driver::Pairs | Driver::Sim => Scheduler::Protocol(self.rules.strategy.clone()),
        }
    }

    /// Returns the title of the run, or the name of its scene if it has none.
    pub fn title(&self) -> &str {
        if self.caption.title.is_empty() { &self.scene } else { &self.caption.title }
    }

    /// Returns the remedies that the run uses: those of the adaptive ring, or the leases of the farm with leases.
    pub fn remedies(&self) -> Remedies {
        match self.scheduler() {
            Scheduler::Protocol(Strategy::Adaptive) => self.rules.remedies,
            Scheduler::Protocol(Strategy::FarmLeases) => Remedies::NONE.with(Remedy::Leases),
            Scheduler::Protocol(_) | Scheduler::WorkStealing => Remedies::NONE,
        }
    }

    /// Returns whether this node is a spare, which is off at first.
    pub fn is_spare(&self, node: NodeId) -> bool {
        usize::from(node) + usize::from(self.spares) >= self.speeds.len()
    }

    /// Returns whether all machines are as fast as this computer, so that none has to wait.
    pub fn is_full_speed(&self) -> bool {
        self.pace >= 1.0 && self.speeds.iter().all(|&speed| speed >= 1.0)
    }
}

fn is_zero(count: &NodeId) -> bool {
    *count == 0
}

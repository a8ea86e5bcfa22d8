//! What a run was asked to do: enough to start it again.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::Metadata;
use crate::balance::{NodeId, Remedies, Rules, Strategy};
use crate::picture::{Division, Quality, Size};

/// What a run was asked to do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// The scene's name, for people.
    pub scene: String,
    /// The text of the scene's file, which each band carries along.
    pub scene_text: String,
    /// Width and height of the picture.
    pub size: Size,
    /// How good the picture is.
    #[serde(flatten)]
    pub quality: Quality,
    /// How the picture is cut into atoms.
    pub division: Division,
    /// Who executes the run.
    pub driver: Driver,
    /// How the atoms are shared; [`Driver::WorkStealing`] has rules of its own.
    pub rules: Rules,
    /// A node a speed, as fractions of the reference machine (1 = 100 %).
    pub speeds: Vec<f64>,
    /// So many of the nodes, the last ones, are off at first, and may join the run: only a ring that adapts can have some.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub spares: NodeId,
    /// What fraction of one real core the reference machine gets, above 0 and at most 1. At pace 1 a node of
    /// speed 1 never waits.
    pub pace: f64,
    /// The network.
    pub link: LinkSettings,
    /// How long the parent is busy with each message.
    pub handling: Duration,
    /// Cores of the computer that emulates the machines; in virtual time as many as there are machines.
    pub cores: usize,
    /// What is said of the run; nothing in older files.
    #[serde(default, skip_serializing_if = "Metadata::is_empty")]
    pub caption: Metadata,
}

/// Who executes a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Driver {
    /// Real time: a thread for each node, which is both its handler and its worker.
    Threads,
    /// Real time: a thread for each node's handler and one for its worker, as the article has it (§8). At full speed only.
    Pairs,
    /// Virtual time.
    Sim,
    /// Real time: rayon's work stealing over the atoms, a thread for each node; no strategy of ours. The threads share
    /// their memory: nothing travels, so that [`Header::link`] and [`Header::handling`] do not apply.
    WorkStealing,
}

impl Driver {
    /// The name in reports and on the command line.
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
    /// A run of a picture in atoms of `atom_pixels`, on nodes of these speeds, as plain as can be: threads at full pace, on
    /// links that take no time and a core for each machine, with the strategy's usual rules.
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
            link: LinkSettings { latency: Duration::ZERO, bandwidth: None, shared: false },
            handling: Duration::ZERO,
            cores: speeds.len(),
            speeds,
            spares: 0,
            caption: Metadata::default(),
        }
    }

    /// What shares the atoms, by its name on the command line.
    pub fn strategy_name(&self) -> &'static str {
        if self.driver == Driver::WorkStealing { self.driver.name() } else { self.rules.strategy.name() }
    }

    /// What the run is called: its title, else its scene.
    pub fn title(&self) -> &str {
        if self.caption.title.is_empty() { &self.scene } else { &self.caption.title }
    }

    /// What the ring does otherwise than the article's; nothing where atoms are shared in another way.
    pub fn remedies(&self) -> Remedies {
        let adapts = self.driver != Driver::WorkStealing && self.rules.strategy == Strategy::Adaptive;
        if adapts { self.rules.remedies } else { Remedies::NONE }
    }

    /// Whether this node is off at first.
    pub fn is_spare(&self, node: NodeId) -> bool {
        usize::from(node) + usize::from(self.spares) >= self.speeds.len()
    }

    /// Whether no machine is slower than this computer, and so none has to wait.
    pub fn is_full_speed(&self) -> bool {
        self.pace >= 1.0 && self.speeds.iter().all(|&speed| speed >= 1.0)
    }
}

fn is_zero(count: &NodeId) -> bool {
    *count == 0
}

/// Latency and bandwidth between any two parties, the parent included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinkSettings {
    /// How long the last byte travels once it has left.
    pub latency: Duration,
    /// Bytes a second; `None` is unlimited.
    pub bandwidth: Option<f64>,
    /// Whether all share one wire, as an Ethernet of 1997 was; else each pair has one of its own.
    pub shared: bool,
}

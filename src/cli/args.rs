//! The arguments, and the sentences that say what is wrong with them.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Parser, Subcommand};

use crate::balance::Strategy;
use crate::driver::auto_pace;
use crate::picture::Size;

#[derive(Debug, Parser)]
#[command(version, about, args_conflicts_with_subcommands = true)]
pub(super) struct Args {
    /// A scene file, the name of a built-in scene, or a run file [default: what was open last]
    pub scene: Option<String>,
    /// Write the run's records here when it ends
    #[arg(long, value_name = "FILE")]
    pub log: Option<PathBuf>,
    #[command(subcommand)]
    pub command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Trace a scene without a window and save the picture
    Render(RenderArgs),
    /// Write a scene for another renderer
    Export {
        /// A scene file, or the name of a built-in scene
        scene: String,
        /// Where to write it for POV-Ray 3.7
        #[arg(long, value_name = "FILE.pov")]
        pov: PathBuf,
        /// The proportions of the picture
        #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "640x480")]
        size: Size,
    },
    /// Show a recorded run again
    Replay {
        /// What `--log`, or Save in the window, has written
        #[arg(value_name = "LOG")]
        log: PathBuf,
    },
}

#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub(super) struct RenderArgs {
    /// A scene file, or the name of a built-in scene
    pub scene: String,
    /// Where to save the picture
    #[arg(long, value_name = "FILE.png")]
    pub out: PathBuf,
    /// Pixels across and down
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "640x480", allow_hyphen_values = true)]
    pub size: Size,
    /// Samples a pixel, n × n
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub samples: u32,
    /// Nodes of the ring [default: as many as speeds, else 4; 1 for serial]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub nodes: Option<u16>,
    /// How the atoms are shared: serial or ring
    #[arg(long, default_value = "ring")]
    pub strategy: Strategy,
    /// A speed for each node, 1 being the reference machine [default: all 1]
    #[arg(long, value_name = "1,1,0.1", value_delimiter = ',', value_parser = speed, allow_hyphen_values = true)]
    pub speeds: Vec<f64>,
    /// What part of a core the reference machine gets: auto, full, or a number up to 1
    #[arg(long, default_value = "auto", value_parser = pace)]
    pub pace: Pace,
    /// Pixels in an atom
    #[arg(long, value_name = "PIXELS", default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..))]
    pub atom: u32,
    /// The least number of atoms worth sending to a node that offers help
    #[arg(long, value_name = "ATOMS", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub part: u32,
    /// How long a message travels, in milliseconds
    #[arg(long, value_name = "MS", default_value = "0", value_parser = milliseconds)]
    pub latency: Duration,
    /// How fast a message is put on its link, in bytes a second [default: unlimited]
    #[arg(long, value_name = "BYTES_PER_S", value_parser = bandwidth)]
    pub bandwidth: Option<f64>,
    /// How long the parent is busy with each message, in milliseconds
    #[arg(long, value_name = "MS", default_value = "0", value_parser = milliseconds)]
    pub handling: Duration,
    /// Write the run's records here
    #[arg(long, value_name = "FILE")]
    pub log: Option<PathBuf>,
    /// Print one JSON object about the run on standard output
    #[arg(long)]
    pub json: bool,
}

/// What part of a core the reference machine gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pace {
    Auto,
    Of(f64),
}

impl RenderArgs {
    /// A speed for each node.
    pub fn node_speeds(&self) -> Result<Vec<f64>, String> {
        let usual = match (self.strategy, self.speeds.len()) {
            (Strategy::Serial, 0) => 1,
            (_, 0) => 4,
            (_, speeds) => speeds,
        };
        let nodes = self.nodes.map_or(usual, usize::from);
        if self.strategy == Strategy::Serial && nodes != 1 {
            return Err(format!("serial is one node that traces all; it cannot have {nodes} nodes"));
        }
        match self.speeds.len() {
            0 => Ok(vec![1.0; nodes]),
            speeds if speeds != nodes => {
                Err(format!("there are {nodes} nodes but {speeds} speeds; give each node one speed, or none at all"))
            }
            _ if nodes > 1024 => Err(format!("{nodes} nodes are too many; at most 1024 are possible")),
            _ => Ok(self.speeds.clone()),
        }
    }

    /// The pace for these speeds on a computer with so many cores.
    pub fn pace_of(&self, speeds: &[f64], cores: usize) -> f64 {
        match self.pace {
            Pace::Auto => auto_pace(speeds, cores),
            Pace::Of(pace) => pace,
        }
    }
}

fn speed(text: &str) -> Result<f64, String> {
    number(text, is_rate, "a speed is from 0.0001 to 1")
}

fn pace(text: &str) -> Result<Pace, String> {
    match text {
        "auto" => Ok(Pace::Auto),
        "full" => Ok(Pace::Of(1.0)),
        _ => number(text, is_rate, "a pace is `auto`, `full`, or a number from 0.0001 to 1").map(Pace::Of),
    }
}

/// A slower machine would seem to stand still for ever.
fn is_rate(rate: f64) -> bool {
    (1e-4..=1.0).contains(&rate)
}

fn bandwidth(text: &str) -> Result<f64, String> {
    number(text, |bytes| bytes >= 1.0, "a bandwidth is at least 1 byte a second")
}

fn milliseconds(text: &str) -> Result<Duration, String> {
    let within = |ms| (0.0..=3_600_000.0).contains(&ms);
    let ms = number(text, within, "it is a number of milliseconds from 0 to 3600000 (an hour)")?;
    Ok(Duration::from_secs_f64(ms / 1e3))
}

fn number(text: &str, valid: impl Fn(f64) -> bool, what: &str) -> Result<f64, String> {
    text.parse().ok().filter(|&number: &f64| number.is_finite() && valid(number)).ok_or_else(|| what.into())
}

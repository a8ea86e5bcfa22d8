//! What a run was asked to do: enough to start it again.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::balance::Strategy;
use crate::picture::{Division, Size};

/// What a run was asked to do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// The scene's name, for people.
    pub scene: String,
    /// The text of the scene's file, which each band carries along.
    pub scene_text: String,
    /// Width and height of the picture.
    pub size: Size,
    /// The picture is made of n × n samples a pixel.
    pub samples: u32,
    /// How the picture is cut into atoms.
    pub division: Division,
    /// How the atoms are shared.
    pub strategy: Strategy,
    /// A node a speed, as fractions of the reference machine (1 = 100 %).
    pub speeds: Vec<f64>,
    /// What fraction of one real core the reference machine gets, above 0 and at most 1. At pace 1 a node of
    /// speed 1 never waits.
    pub pace: f64,
    /// The link between any two parties.
    pub link: Link,
    /// How long the parent is busy with each message.
    pub handling: Duration,
    /// An offer is worth taking if it moves at least this many atoms.
    pub part: u32,
    /// Cores of the computer that emulates the machines.
    pub cores: usize,
}

/// Latency and bandwidth between any two parties, the parent included; each pair has a link of its own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Link {
    /// How long the first byte travels.
    pub latency: Duration,
    /// Bytes a second; `None` is unlimited.
    pub bandwidth: Option<f64>,
}

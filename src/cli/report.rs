//! The report of a run without a window, as text or as JSON.

use std::fmt;
use std::time::Duration;

use serde::Serialize;

use crate::language::Language;
use crate::picture::{Quality, Region, Size};
use crate::runlog::{MessageCounts, Metrics, RunLog};
use crate::time::Time;
use crate::tracer::{RayCounts, SceneStats, Tracer};
use crate::view::{TimeScale, disturbance, disturbance_words, time_words};

/// The figures of a run; times are in seconds.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    scene: String,
    /// Of the whole picture, in pixels.
    width: u32,
    height: u32,
    /// The part of the picture that was traced: X, Y, width and height; null if it was the whole picture.
    region: Option<[u32; 4]>,
    #[serde(flatten)]
    quality: Quality,
    strategy: &'static str,
    driver: &'static str,
    nodes: usize,
    speeds: Vec<f64>,
    pace: f64,
    /// Wall time of the whole run, from the start of its threads to their end.
    wall_s: f64,
    /// From the first band sent to the last atom placed.
    makespan_s: f64,
    /// CPU time in the tracer.
    work_s: f64,
    /// The shortest possible makespan for this work on these machines.
    ideal_s: f64,
    efficiency: f64,
    /// The cost of atoms in the run / their cost on one thread; null if there was too little to measure.
    overhead: Option<f64>,
    finish_spread_s: f64,
    /// Share of the machines' time that was lost to other work of this computer.
    disturbance: f64,
    rays: RayCounts,
    atoms: u32,
    atoms_by_node: Vec<u32>,
    messages: MessageCounts,
    compiled: SceneStats,
    /// Whether a signal has ended the run early.
    pub interrupted: bool,
    /// Primary, reflected and refracted rays on each level of the tree of rays, for a sample of the pixels.
    pub levels: Vec<u64>,
}

impl Report {
    pub fn new(log: &RunLog, rays: RayCounts, wall: Duration, overhead: Option<f64>, tracer: &Tracer) -> Self {
        let (header, metrics) = (&log.header, Metrics::of(log));
        let seconds = |time: Option<Duration>| time.unwrap_or_default().as_secs_f64();
        Self {
            scene: header.scene.clone(),
            width: header.size.width(),
            height: header.size.height(),
            region: None,
            quality: header.quality,
            strategy: header.scheduler().name(),
            driver: header.driver.name(),
            nodes: header.speeds.len(),
            speeds: header.speeds.clone(),
            pace: header.pace,
            wall_s: wall.as_secs_f64(),
            makespan_s: seconds(metrics.makespan()),
            work_s: metrics.work().as_secs_f64(),
            ideal_s: seconds(metrics.ideal()),
            efficiency: metrics.efficiency().unwrap_or_default(),
            overhead,
            finish_spread_s: metrics.finish_spread().as_secs_f64(),
            disturbance: disturbance(log),
            rays,
            atoms: header.division.atoms(),
            atoms_by_node: metrics.atoms_by_node(),
            messages: metrics.messages(),
            compiled: tracer.scene_stats(),
            interrupted: false,
            levels: Vec::new(),
        }
    }

    /// Says that only a region of a picture of this size was traced, if there is one.
    pub fn set_region(&mut self, region: Option<(Size, Region)>) {
        if let Some((whole, Region { x, y, size })) = region {
            (self.width, self.height) = (whole.width(), whole.height());
            self.region = Some([x, y, size.width(), size.height()]);
        }
    }

    /// Formats the report as one JSON object on one line.
    pub fn json(&self) -> String {
        serde_json::to_string(self).expect("numbers, texts and lists have a JSON form")
    }
}

/// The most nodes whose atoms are listed.
const MAX_NODES_NAMED: usize = 32;

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { scene, width, height, strategy, nodes, .. } = self;
        let plural = |count: u64, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
        let region = self.region.map_or(String::new(), |[x, y, w, h]| format!(", region {x},{y},{w},{h}"));
        writeln!(f, "{scene}, {width}x{height}{region}, {strategy}, {}", plural(*nodes as u64, "node"))?;
        // Short runs have smaller units.
        let scale = TimeScale::of_length(Time::from_secs(self.makespan_s)).with_decimals(3);
        let times = [self.makespan_s, self.ideal_s, self.finish_spread_s, self.work_s];
        let words = |seconds| time_words(Time::from_secs(seconds), scale, Language::English);
        let [makespan, ideal, spread, work] = times.map(words);
        writeln!(
            f,
            "  makespan {makespan}, ideal {ideal}: efficiency {:.3}; the nodes ended within {spread}",
            self.efficiency
        )?;
        if let Some(disturbed) = disturbance_words(self.disturbance, Language::English) {
            writeln!(f, "  {disturbed}")?;
        }
        if let Some(overhead) = self.overhead {
            writeln!(f, "  tracing took {work} of CPU time, {overhead:.3} times that of one thread")?;
        }
        let MessageCounts { requests, parts, offers, hops, transfers, atoms_moved, .. } = self.messages;
        if requests > 0 {
            writeln!(f, "  {}, {}", plural(requests, "request"), plural(parts, "answer"))?;
        }
        if offers > 0 {
            let (offers, hops) = (plural(offers, "offer"), plural(hops, "hop"));
            let (transfers, moved) = (plural(transfers, "transfer"), plural(atoms_moved, "atom"));
            writeln!(f, "  {offers}, {hops}, {transfers} of {moved}")?;
        }
        let atoms = &self.atoms_by_node;
        match (atoms.iter().min(), atoms.iter().max()) {
            (Some(least), Some(most)) if atoms.len() > MAX_NODES_NAMED => {
                let mean = f64::from(atoms.iter().sum::<u32>()) / atoms.len() as f64;
                writeln!(f, "  atoms by node: from {least} to {most}, {mean:.1} on average")
            }
            _ => {
                let shares: Vec<_> = atoms.iter().map(u32::to_string).collect();
                writeln!(f, "  atoms by node: {}", shares.join(" "))
            }
        }
    }
}

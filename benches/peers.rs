//! The time of one thread beside POV-Ray's, on the same pictures: `cargo bench --bench peers`, or with names of scenes
//! or scene files behind `--`. `svg FILE` also draws the ratios.
//!
//! Each program traces each scene several times in turn, one thread, no antialiasing; a figure is the median. Both
//! count CPU seconds of tracing alone. The figures depend on the computer, which must be otherwise idle.

mod common;

use std::path::Path;
use std::process::Command;

use anel::language::Language;
use anel::view::{Axis, Bar, BarChart, CHART_SIZE, Scale};
use common::{median, take_svg, write_svg};
use tempfile::TempDir;

/// Runs of each program and scene.
const RUNS: usize = 3;

/// A picture is larger where we are so fast that the clock would count, and smaller where POV-Ray is slow.
const SIZES: [[u32; 2]; 4] = [[80, 60], [320, 240], [640, 480], [1280, 960]];
/// Below this many seconds of ours the picture is larger.
const TOO_FAST: f64 = 0.1;
/// Above this many seconds of theirs it is smaller.
const TOO_SLOW: f64 = 20.0;

fn main() {
    let directory = TempDir::new().expect("a temporary directory");
    let mut named: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let svg = take_svg(&mut named);
    let built_in = || anel::scene::BUILT_IN.iter().map(|(name, _)| (*name).to_owned()).collect();
    println!("| scene | size | our CPU s | POV-Ray's | ratio | pixels that differ by more than 2 of 255 |");
    println!("|---|---|---:|---:|---:|---:|");
    let mut ratios = Vec::new();
    for scene in if named.is_empty() { built_in() } else { named } {
        let bench = Bench { scene, directory: directory.path() };
        match bench.size() {
            Some(size) => ratios.push((bench.scene.clone(), bench.compare(size))),
            None => println!("| {} | 640×480 | {:.3} | not installed | | |", bench.scene, bench.ours(SIZES[2])),
        }
    }
    if let Some(file) = svg {
        write_svg(&file, &chart(&ratios).marks(CHART_SIZE, Language::English));
    }
}

/// Charts how many times as long POV-Ray takes.
fn chart(ratios: &[(String, f64)]) -> BarChart {
    let group = |(scene, ratio): &(String, f64)| {
        (scene.clone(), vec![Bar { name: "POV-Ray's time over ours".into(), value: *ratio, other: None }])
    };
    BarChart {
        title: "POV-Ray 3.7 beside anel".into(),
        note: "CPU seconds of tracing, one thread, no antialiasing; the line is the same time".into(),
        y: Axis { label: "times as long".into(), scale: Scale::Log10, range: None },
        groups: ratios.iter().map(group).collect(),
        reference: Some(1.0),
    }
}

struct Bench<'a> {
    scene: String,
    directory: &'a Path,
}

impl Bench<'_> {
    /// The size of picture at which both programs can be measured; nothing without POV-Ray.
    fn size(&self) -> Option<[u32; 2]> {
        let [tiny, small, usual, large] = SIZES;
        // Time grows with the number of pixels.
        if self.theirs(tiny)? > TOO_SLOW {
            return Some(tiny);
        }
        if self.theirs(small)? > TOO_SLOW / 4.0 {
            return Some(small);
        }
        Some(if self.ours(usual) < TOO_FAST { large } else { usual })
    }

    /// Prints the times of both programs. Returns POV-Ray's over ours.
    fn compare(&self, size: [u32; 2]) -> f64 {
        let turns: Vec<(f64, f64)> = (0..RUNS).filter_map(|_| Some((self.ours(size), self.theirs(size)?))).collect();
        let ours = median(turns.iter().map(|(ours, _)| *ours));
        let theirs = median(turns.iter().map(|(_, theirs)| *theirs));
        let ratio = median(turns.iter().map(|(ours, theirs)| theirs / ours));
        let [width, height] = size;
        let differing = self.differing();
        println!("| {} | {width}×{height} | {ours:.3} | {theirs:.3} | {ratio:.2} | {differing} |", self.scene);
        ratio
    }

    /// Traces the scene with one thread. Returns the CPU seconds of tracing.
    fn ours(&self, [width, height]: [u32; 2]) -> f64 {
        let (size, out) = (format!("{width}x{height}"), self.directory.join("ours.png"));
        let run = common::render(&self.scene, &size, &out, &["--strategy", "serial"]);
        run["work_s"].as_f64().unwrap_or(f64::NAN)
    }

    /// Does the same with POV-Ray; nothing if it is not installed.
    fn theirs(&self, [width, height]: [u32; 2]) -> Option<f64> {
        let pov = self.directory.join("scene.pov");
        let size = format!("{width}x{height}");
        let exported = Command::new(env!("CARGO_BIN_EXE_anel"))
            .args(["export", &self.scene, "--size", &size, "--pov"])
            .arg(&pov)
            .output();
        assert!(exported.is_ok_and(|output| output.status.success()), "{} can be exported", self.scene);
        let output = Command::new("povray")
            .args([&format!("+I{}", pov.display()), &format!("+W{width}"), &format!("+H{height}")])
            .args(["+WT1", "-D", "-A", &format!("+O{}", self.directory.join("theirs.png").display())])
            .output()
            .ok()?;
        trace_seconds(&String::from_utf8_lossy(&output.stderr))
    }

    /// The number of pixels of the last two pictures that differ visibly.
    fn differing(&self) -> usize {
        let [ours, theirs] = ["ours.png", "theirs.png"].map(|name| {
            let picture = image::open(self.directory.join(name)).expect("both programs have written a picture");
            picture.to_rgb8()
        });
        let differs = |(a, b): (&image::Rgb<u8>, &image::Rgb<u8>)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 2);
        ours.pixels().zip(theirs.pixels()).filter(|&pair| differs(pair)).count()
    }
}

/// The CPU seconds of tracing, from POV-Ray's last output.
fn trace_seconds(said: &str) -> Option<f64> {
    let (_, trace_time) = said.split_once("Trace Time:")?;
    let (_, seconds) = trace_time.split_once("thread(s) with ")?;
    seconds.split(' ').next()?.parse().ok()
}

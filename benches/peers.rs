//! The time of one thread beside POV-Ray's, on the same pictures: `cargo bench --bench peers`, or with names of scenes
//! or scene files behind `--`.
//!
//! Each program traces each scene several times in turn, one thread, no antialiasing; a figure is the median. Both
//! count CPU seconds of tracing alone. The figures depend on the computer, which must be otherwise idle.

use std::path::Path;
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

/// Runs of each program and scene.
const RUNS: usize = 3;

/// A picture is larger where we are so fast that the clock would count, and smaller where POV-Ray is slow.
const SIZES: [[u32; 2]; 3] = [[320, 240], [640, 480], [1280, 960]];
/// Below this many seconds of ours the picture is larger.
const TOO_FAST: f64 = 0.1;
/// Above this many seconds of theirs it is smaller.
const TOO_SLOW: f64 = 20.0;

fn main() {
    let directory = TempDir::new().expect("a temporary directory");
    let named: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let built_in = || anel::scene::BUILT_IN.iter().map(|(name, _)| (*name).to_owned()).collect();
    println!("seconds of one thread, POV-Ray's over ours, and pixels that differ by more than 2 of 255:");
    for scene in if named.is_empty() { built_in() } else { named } {
        let bench = Bench { scene, directory: directory.path() };
        match bench.size() {
            Some(size) => bench.compare(size),
            None => println!("  {:<16} {:8.3}; povray is not installed", bench.scene, bench.ours(SIZES[1])),
        }
    }
}

struct Bench<'a> {
    scene: String,
    directory: &'a Path,
}

impl Bench<'_> {
    /// The size of picture at which both programs can be measured; nothing without POV-Ray.
    fn size(&self) -> Option<[u32; 2]> {
        let [small, usual, large] = SIZES;
        // Time grows with the number of pixels.
        if self.theirs(small)? > TOO_SLOW / 4.0 {
            return Some(small);
        }
        Some(if self.ours(usual) < TOO_FAST { large } else { usual })
    }

    fn compare(&self, size: [u32; 2]) {
        let turns: Vec<(f64, f64)> = (0..RUNS).filter_map(|_| Some((self.ours(size), self.theirs(size)?))).collect();
        let ours = median(turns.iter().map(|(ours, _)| *ours));
        let theirs = median(turns.iter().map(|(_, theirs)| *theirs));
        let ratio = median(turns.iter().map(|(ours, theirs)| theirs / ours));
        let [width, height] = size;
        let differing = self.differing();
        println!(
            "  {:<16} {width:4}×{height:<4} {ours:8.3} {theirs:8.3}  {ratio:6.2} times; {differing} pixels differ",
            self.scene
        );
    }

    /// Traces the scene with one thread. Returns the CPU seconds of tracing.
    fn ours(&self, [width, height]: [u32; 2]) -> f64 {
        let size = format!("{width}x{height}");
        let output = Command::new(env!("CARGO_BIN_EXE_anel"))
            .args(["render", &self.scene, "--strategy", "serial", "--json", "--size", &size, "--out"])
            .arg(self.directory.join("ours.png"))
            .output()
            .expect("the program can be started");
        let run: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|_| {
            panic!("no figures of {}: {}", self.scene, String::from_utf8_lossy(&output.stderr));
        });
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

fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}

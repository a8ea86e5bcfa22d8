//! The arguments of the command line, their help texts and the errors of their values.

use std::path::PathBuf;
use std::time::Duration;

use clap::{ArgGroup, Parser, Subcommand};

use super::layers::LayerArgs;
use crate::balance::{Remedy, Scheduler};
use crate::export::Film;
use crate::picture::{Quality, Region, Size};
use crate::runlog::Driver;
use crate::time::Time;

#[derive(Debug, Parser)]
#[command(version, about, args_conflicts_with_subcommands = true)]
pub(super) struct Args {
    /// A scene file, a built-in scene, a run file, or a lesson file [default: the last one that was open]
    pub scene: Option<PathBuf>,
    /// Write the records of the run to this file when the run ends
    #[arg(long, value_name = "FILE")]
    pub log: Option<PathBuf>,
    #[command(subcommand)]
    pub command: Option<CliCommand>,
}

#[derive(Debug, Subcommand)]
pub(super) enum CliCommand {
    /// Trace a scene without a window and save the picture
    ///
    /// Ctrl C, or another signal that ends programs, ends the run early: the picture so far and its records are
    /// written, and the exit code is 128 plus the number of the signal. A second signal ends the program at once.
    Render(RenderArgs),
    /// Explain the colour and the cost of a pixel
    Inspect(InspectArgs),
    /// Export a recorded run or a scene for other programs
    Export(ExportArgs),
    /// Make many runs and write a report with tables and charts
    Study {
        /// The study
        #[arg(value_enum)]
        kind: StudyKind,
        /// A scene file or a built-in scene [default: ten-objects; rivals, peer, needs and accuracy take the six
        /// small built-in scenes; stability takes none]
        #[arg(long)]
        scene: Option<PathBuf>,
        /// chaos: the number of runs [default: 10000; with --seed 1]
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
        seeds: Option<u64>,
        /// chaos: the first seed; the run of a single seed is kept in a file
        #[arg(long, value_name = "S")]
        seed: Option<u64>,
        /// The directory for the files
        #[arg(long, value_name = "DIR", default_value = "study")]
        out: PathBuf,
        /// Print one JSON object on standard output
        #[arg(long)]
        json: bool,
    },
    /// Play the runs of a lesson and check its claims
    Lesson {
        /// A lesson file or a built-in lesson [default: list the built-in lessons]
        #[arg(value_name = "LESSON")]
        lesson: Option<PathBuf>,
    },
    /// Open the window with a recorded run
    Replay {
        /// A run file, as --log or Save in the window writes it
        #[arg(value_name = "LOG")]
        log: PathBuf,
    },
}

/// The source and the files to write; at least one file, and several at once are possible.
#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true, group = ArgGroup::new("files").required(true).multiple(true)
    .args(["pov", "csv", "trace", "gif", "ring", "timeline", "png", "owners_png", "costs_png"]))]
pub(super) struct ExportArgs {
    /// A recorded run; for --pov a scene file or a built-in scene
    #[arg(value_name = "RUN")]
    pub source: PathBuf,
    /// Write the scene for POV-Ray 3.7
    #[arg(long, value_name = "FILE.pov")]
    pub pov: Option<PathBuf>,
    /// Write a table with a row for each record
    #[arg(long, value_name = "FILE.csv")]
    pub csv: Option<PathBuf>,
    /// Write the tasks of the machines and the messages for Perfetto (ui.perfetto.dev) and Chrome
    #[arg(long, value_name = "FILE.json")]
    pub trace: Option<PathBuf>,
    /// Write the whole run as an animation
    #[arg(long, value_name = "FILE.gif")]
    pub gif: Option<PathBuf>,
    /// The width of the picture in the animation
    #[arg(long, value_name = "PIXELS", default_value_t = Film::default().width, requires = "gif",
        value_parser = clap::value_parser!(u32)
            .range(i64::from(*Film::WIDTHS.start())..=i64::from(*Film::WIDTHS.end())))]
    pub width: u32,
    /// The duration of the run in the animation
    #[arg(long, value_name = "SECONDS", default_value = "10", requires = "gif", value_parser = film_seconds)]
    pub seconds: Duration,
    /// Draw the ring at one moment
    #[arg(long, value_name = "FILE.svg|png")]
    pub ring: Option<PathBuf>,
    /// The moment for --ring, in seconds after the beginning [default: the end]
    #[arg(long, value_name = "SECONDS", requires = "ring", value_parser = moment)]
    pub at: Option<Time>,
    /// Draw the timeline of all machines
    #[arg(long, value_name = "FILE.svg|png")]
    pub timeline: Option<PathBuf>,
    /// Trace the picture again and save it
    #[arg(long, value_name = "FILE.png")]
    pub png: Option<PathBuf>,
    /// The size for --png [default: that of the run], or the one that the comment in --pov names [default: 640x480];
    /// POV-Ray takes the size from its own options +W and +H, and any is right
    #[arg(long, value_name = "WIDTHxHEIGHT")]
    pub size: Option<Size>,
    /// Leave out the background in --png: the picture is transparent where no solid is
    #[arg(long, requires = "png")]
    pub transparent: bool,
    #[command(flatten)]
    pub layers: LayerArgs,
}

/// The studies; `--help` shows their descriptions.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(super) enum StudyKind {
    /// The article's Figures 5 to 9, and its claims
    Paper,
    /// 1 to 1,024 machines
    Scale,
    /// The cost of sharing at full speed: the ring and rayon
    Rivals,
    /// Cases that grow harder until each method fails
    Stability,
    /// The time and the wrong rays of each method that was tried
    Methods,
    /// Every pixel compared with POV-Ray's
    Peer,
    /// The parts of a scene that compiling keeps, and the time that this saves
    Needs,
    /// The cost and the error of each option of quality
    Accuracy,
    /// The adaptive ring compared with the article's, and the gain of each remedy
    Remedies,
    /// The adaptive ring in random runs in which machines and links fail
    Chaos,
}

#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub(super) struct RenderArgs {
    /// A scene file or a built-in scene
    pub scene: PathBuf,
    /// Save the picture in this file
    #[arg(long, value_name = "FILE.png")]
    pub out: PathBuf,
    /// The width and the height of the picture in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "640x480", allow_hyphen_values = true)]
    pub size: Size,
    /// Trace and save only a part of the picture: the column and the row of its first pixel, its width and its height
    #[arg(long, value_name = "X,Y,WIDTH,HEIGHT", allow_hyphen_values = true)]
    pub region: Option<Region>,
    /// Leave out the background: the picture is transparent where no solid is
    #[arg(long)]
    pub transparent: bool,
    #[command(flatten)]
    pub layers: LayerArgs,
    #[command(flatten)]
    pub quality: QualityArgs,
    /// The number of nodes [default: one for each speed, else 4; 1 for serial]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub nodes: Option<u16>,
    /// How the atoms are shared: serial, static, static-estimate, farm, farm-by-speed, farm-leases, ring, adaptive, or
    /// rayon
    #[arg(long, default_value = "ring")]
    pub strategy: Scheduler,
    /// What executes the run: threads (real time), pairs (two threads for each node, at full speed), or sim (virtual
    /// time)
    #[arg(long, default_value = "threads", value_parser = driver)]
    pub driver: Driver,
    /// The speed of each node; 1 is the reference machine [default: all 1]
    #[arg(long, value_name = "1,1,0.1", value_delimiter = ',', value_parser = speed, allow_hyphen_values = true)]
    pub speeds: Vec<f64>,
    /// Random speeds from 0.1 to 1; the same seed gives the same speeds
    #[arg(long, value_name = "S", conflicts_with = "speeds")]
    pub seed: Option<u64>,
    /// The fraction of a core that the reference machine gets: auto, full, or a number from 0.0001 to 1
    #[arg(long, default_value = "auto", value_parser = pace)]
    pub pace: PaceArg,
    /// The number of pixels in an atom
    #[arg(long, value_name = "PIXELS", default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..))]
    pub atom: u32,
    /// Ring: the fewest atoms in a transfer [default: 1]; farm: the number of atoms in a part [default: about 16 parts
    /// for each node]
    #[arg(long, value_name = "ATOMS", value_parser = clap::value_parser!(u32).range(1..))]
    pub part: Option<u32>,
    /// Adaptive ring: the remedies to leave out: speed, floor, early, wake, copies, shortcuts, leases [default: none]
    #[arg(long, value_name = "REMEDY,REMEDY", value_delimiter = ',')]
    pub without: Vec<Remedy>,
    /// The latency of each node in milliseconds, or one number for all; a message takes the larger one of its two ends
    #[arg(long, value_name = "MS,MS", default_value = "0", value_delimiter = ',', value_parser = milliseconds)]
    pub latency: Vec<Duration>,
    /// The bandwidth of each node in bytes per second, or one number for all; a message takes the smaller one of its
    /// two ends [default: unlimited]
    #[arg(long, value_name = "BYTES_PER_S,BYTES_PER_S", value_delimiter = ',', value_parser = bandwidth)]
    pub bandwidth: Vec<f64>,
    /// The parent's own latency in milliseconds [default: none; the node at the other end decides]
    #[arg(long, value_name = "MS", value_parser = milliseconds)]
    pub parent_latency: Option<Duration>,
    /// The parent's own bandwidth in bytes per second [default: none; the node at the other end decides]
    #[arg(long, value_name = "BYTES_PER_S", value_parser = bandwidth)]
    pub parent_bandwidth: Option<f64>,
    /// Send all messages over one shared wire, as on an old Ethernet, instead of one link for each pair
    #[arg(long)]
    pub shared_wire: bool,
    /// The time for which each message keeps the parent busy, in milliseconds
    #[arg(long, value_name = "MS", default_value = "0", value_parser = milliseconds)]
    pub handling: Duration,
    /// With --driver sim: take the costs of atoms from this recorded run [default: 0.1 µs for each ray]
    #[arg(long, value_name = "LOG")]
    pub costs: Option<PathBuf>,
    /// Write the records of the run to this file
    #[arg(long, value_name = "FILE")]
    pub log: Option<PathBuf>,
    /// The title of the run in the file of --log
    #[arg(long, value_name = "TEXT", default_value = "", hide_default_value = true, requires = "log")]
    pub title: String,
    /// A note about the run in the file of --log
    #[arg(long, value_name = "TEXT", default_value = "", hide_default_value = true, requires = "log")]
    pub memo: String,
    /// Print one JSON object about the run on standard output
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub(super) struct InspectArgs {
    /// A scene file or a built-in scene
    pub scene: PathBuf,
    /// The column and the row of the pixel; 0,0 is the upper left corner
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pub pixel: [u32; 2],
    /// The width and the height of the picture in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "640x480", allow_hyphen_values = true)]
    pub size: Size,
    #[command(flatten)]
    pub quality: QualityArgs,
    /// Print one JSON object on standard output
    #[arg(long)]
    pub json: bool,
}

/// The quality of the picture.
#[derive(Debug, clap::Args)]
pub(super) struct QualityArgs {
    /// Take N × N samples of each pixel
    #[arg(long, value_name = "N", default_value_t = 1,
        value_parser = clap::value_parser!(u32).range(1..=i64::from(Quality::MAX_SAMPLES)))]
    pub samples: u32,
    /// Take no more samples of a pixel once the estimated error of its colour is at most this, for example 0.01
    /// [default: take all samples]
    #[arg(long, value_name = "ERROR", default_value = "0", value_parser = fraction, hide_default_value = true)]
    pub threshold: f64,
    /// The number of levels in the tree of rays; with 1 no rays are reflected or refracted
    #[arg(long, value_name = "LEVELS", default_value_t = Quality::default().max_depth,
        value_parser = clap::value_parser!(u32).range(1..=i64::from(Quality::MAX_DEPTH)))]
    pub depth: u32,
    /// Leave out the weakest rays of the tree, as long as their weights add up to at most this [default: 1/255]
    #[arg(long, value_name = "WEIGHT", default_value_t = Quality::default().cutoff, value_parser = fraction,
        hide_default_value = true)]
    pub cutoff: f64,
}

impl QualityArgs {
    /// Converts the options into the tracer's quality.
    pub fn quality(&self) -> Quality {
        let Self { samples, threshold, depth, cutoff, .. } = *self;
        Quality { samples, threshold, max_depth: depth, cutoff, ..Quality::default() }
    }
}

/// The value of `--pace`: the fraction of a core that the reference machine gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PaceArg {
    /// The fastest pace at which this computer can emulate all machines.
    Auto,
    Of(f64),
}

fn driver(text: &str) -> Result<Driver, String> {
    let known = [Driver::Threads, Driver::Pairs, Driver::Sim];
    known.into_iter().find(|driver| driver.name() == text).ok_or_else(|| {
        let known = known.map(Driver::name).join(", ");
        format!("there is no driver `{text}`; choose one of {known}")
    })
}

fn pixel(text: &str) -> Result<[u32; 2], String> {
    let places = text.split_once(',').map(|(x, y)| (x.trim().parse(), y.trim().parse()));
    match places {
        Some((Ok(x), Ok(y))) => Ok([x, y]),
        _ => Err("write the column and the row of the pixel, for example 320,240".into()),
    }
}

fn speed(text: &str) -> Result<f64, String> {
    number(text, is_rate, "a speed is a number from 0.0001 to 1")
}

fn pace(text: &str) -> Result<PaceArg, String> {
    match text {
        "auto" => Ok(PaceArg::Auto),
        "full" => Ok(PaceArg::Of(1.0)),
        _ => number(text, is_rate, "a pace is `auto`, `full`, or a number from 0.0001 to 1").map(PaceArg::Of),
    }
}

/// Checks the range of speeds and paces. A slower machine would seem to be stopped.
fn is_rate(rate: f64) -> bool {
    (1e-4..=1.0).contains(&rate)
}

fn fraction(text: &str) -> Result<f64, String> {
    number(text, |fraction| (0.0..1.0).contains(&fraction), "write a number from 0 up to, but not including, 1")
}

fn bandwidth(text: &str) -> Result<f64, String> {
    number(text, |bytes| bytes >= 1.0, "a bandwidth is at least 1 byte per second")
}

fn film_seconds(text: &str) -> Result<Duration, String> {
    let seconds = number(text, |seconds| Film::SECONDS.contains(&seconds), "write a number of seconds from 1 to 120")?;
    Ok(Duration::from_secs_f64(seconds))
}

fn moment(text: &str) -> Result<Time, String> {
    number(text, |seconds| seconds >= 0.0, "write a number of seconds, 0 or more").map(Time::from_secs)
}

fn milliseconds(text: &str) -> Result<Duration, String> {
    let within = |ms| (0.0..=3_600_000.0).contains(&ms);
    let ms = number(text, within, "write a number of milliseconds from 0 to 3600000 (an hour)")?;
    Ok(Duration::from_secs_f64(ms / 1e3))
}

/// Parses a finite number that satisfies `is_valid`; else returns `error`.
fn number(text: &str, is_valid: impl Fn(f64) -> bool, error: &str) -> Result<f64, String> {
    text.parse().ok().filter(|&number: &f64| number.is_finite() && is_valid(number)).ok_or_else(|| error.into())
}

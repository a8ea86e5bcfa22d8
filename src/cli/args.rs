//! The arguments, and the sentences that say what is wrong with them.

use std::path::PathBuf;
use std::str::FromStr;
use std::time::Duration;

use clap::{ArgGroup, Parser, Subcommand};

use crate::balance::{Remedy, Strategy, UnknownStrategy};
use crate::export::Film;
use crate::picture::{Quality, Size};
use crate::runlog::Driver;
use crate::time::Time;

#[derive(Debug, Parser)]
#[command(version, about, args_conflicts_with_subcommands = true)]
pub(super) struct Args {
    /// A scene file, the name of a built-in scene, a run file, or a lesson's file [default: what was open last]
    pub scene: Option<String>,
    /// Write the run's records here when it ends
    #[arg(long, value_name = "FILE")]
    pub log: Option<PathBuf>,
    #[command(subcommand)]
    pub command: Option<CliCommand>,
}

#[derive(Debug, Subcommand)]
pub(super) enum CliCommand {
    /// Trace a scene without a window and save the picture
    Render(RenderArgs),
    /// Tell why a pixel has its colour, and why it takes so long
    Inspect(InspectArgs),
    /// Write a recorded run, or a scene, for other programs
    Export(ExportArgs),
    /// Make many runs and say what they show: CSV, charts, and a report
    Study {
        /// paper: the article's Figures 5 to 9, and its claims; scale: from 1 to 1,024 machines; rivals: what sharing costs
        /// at full speed; stability: where methods fail; peer: every pixel beside POV-Ray's; needs: what compiling a scene
        /// keeps, and what that saves; accuracy: what each knob of quality costs, and how far its picture is from the truth;
        /// remedies: the ring that adapts beside the article's, and what each of its remedies gains; chaos: random runs in
        /// which machines and links are lost
        #[arg(value_enum)]
        kind: StudyKind,
        /// A scene file, or the name of a built-in scene [default: ten-objects; for rivals, peer, needs and accuracy all that
        /// are built in; for stability none]
        #[arg(long)]
        scene: Option<String>,
        /// chaos: how many runs to try [default: 10000; with --seed 1]
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
        seeds: Option<u64>,
        /// chaos: the first seed; of one that is tried alone the run is kept
        #[arg(long, value_name = "S")]
        seed: Option<u64>,
        /// The directory for the files
        #[arg(long, value_name = "DIR", default_value = "study")]
        out: PathBuf,
        /// Print one JSON object on standard output
        #[arg(long)]
        json: bool,
    },
    /// Play a lesson's runs and check what it claims
    Lesson {
        /// A lesson's file, or the name of a built-in lesson [default: lists these]
        #[arg(value_name = "LESSON")]
        lesson: Option<String>,
    },
    /// Show a recorded run again
    Replay {
        /// What `--log`, or Save in the window, has written
        #[arg(value_name = "LOG")]
        log: PathBuf,
    },
}

/// What is written of what; several at once are possible.
#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true, group = ArgGroup::new("files").required(true).multiple(true)
    .args(["pov", "csv", "trace", "gif", "ring", "timeline", "png"]))]
pub(super) struct ExportArgs {
    /// A recorded run; for --pov a scene file, or the name of a built-in scene
    #[arg(value_name = "RUN")]
    pub source: String,
    /// Of a scene: for POV-Ray 3.7
    #[arg(long, value_name = "FILE.pov")]
    pub pov: Option<PathBuf>,
    /// The records as a table, a row each
    #[arg(long, value_name = "FILE.csv")]
    pub csv: Option<PathBuf>,
    /// What each machine did, for Perfetto (ui.perfetto.dev) and Chrome
    #[arg(long, value_name = "FILE.json")]
    pub trace: Option<PathBuf>,
    /// The whole run as an animation
    #[arg(long, value_name = "FILE.gif")]
    pub gif: Option<PathBuf>,
    /// How broad the picture is in the animation
    #[arg(long, value_name = "PIXELS", default_value_t = Film::default().width, requires = "gif",
        value_parser = clap::value_parser!(u32).range(i64::from(*Film::WIDTHS.start())..=i64::from(*Film::WIDTHS.end())))]
    pub width: u32,
    /// How long the run takes in the animation
    #[arg(long, value_name = "SECONDS", default_value = "10", requires = "gif", value_parser = film_seconds)]
    pub seconds: Duration,
    /// The ring at a moment
    #[arg(long, value_name = "FILE.svg|png")]
    pub ring: Option<PathBuf>,
    /// Which moment: so many seconds after the beginning [default: the end]
    #[arg(long, value_name = "SECONDS", requires = "ring", value_parser = moment)]
    pub at: Option<Time>,
    /// The timeline of all machines
    #[arg(long, value_name = "FILE.svg|png")]
    pub timeline: Option<PathBuf>,
    /// The picture, traced anew
    #[arg(long, value_name = "FILE.png")]
    pub png: Option<PathBuf>,
    /// Of --png [default: as it was traced], or the proportions for --pov [default: 640x480]
    #[arg(long, value_name = "WIDTHxHEIGHT")]
    pub size: Option<Size>,
}

/// What is to be studied.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(super) enum StudyKind {
    Paper,
    Scale,
    Rivals,
    Stability,
    Peer,
    Needs,
    Accuracy,
    Remedies,
    Chaos,
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
    #[command(flatten)]
    pub quality: QualityArgs,
    /// Nodes [default: as many as speeds, else 4; 1 for serial]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub nodes: Option<u16>,
    /// How the atoms are shared: serial, static, static-estimate, farm, farm-by-speed, ring, adaptive, or
    /// rayon
    #[arg(long, default_value = "ring")]
    pub strategy: SchedulerArg,
    /// Who executes it: threads (real time), pairs (two threads a node, at full speed), or sim (virtual time)
    #[arg(long, default_value = "threads", value_parser = driver)]
    pub driver: Driver,
    /// A speed for each node, 1 being the reference machine [default: all 1]
    #[arg(long, value_name = "1,1,0.1", value_delimiter = ',', value_parser = speed, allow_hyphen_values = true)]
    pub speeds: Vec<f64>,
    /// Random speeds from 0.1 to 1, the same for the same number
    #[arg(long, value_name = "S", conflicts_with = "speeds")]
    pub seed: Option<u64>,
    /// What part of a core the reference machine gets: auto, full, or a number up to 1
    #[arg(long, default_value = "auto", value_parser = pace)]
    pub pace: PaceArg,
    /// Pixels in an atom
    #[arg(long, value_name = "PIXELS", default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..))]
    pub atom: u32,
    /// Ring: the least atoms worth sending to a node that offers help [default: 1]; farm: the atoms of a part [default:
    /// for about 16 parts a node]
    #[arg(long, value_name = "ATOMS", value_parser = clap::value_parser!(u32).range(1..))]
    pub part: Option<u32>,
    /// Adaptive: leave these remedies out: speed, floor, early, wake, copies, shortcuts, leases [default: none]
    #[arg(long, value_name = "REMEDY,REMEDY", value_delimiter = ',')]
    pub without: Vec<Remedy>,
    /// How long a message travels, in milliseconds
    #[arg(long, value_name = "MS", default_value = "0", value_parser = milliseconds)]
    pub latency: Duration,
    /// How fast a message is put on its link, in bytes a second [default: unlimited]
    #[arg(long, value_name = "BYTES_PER_S", value_parser = bandwidth)]
    pub bandwidth: Option<f64>,
    /// All messages share one wire, as on an old Ethernet, instead of a link for each pair
    #[arg(long)]
    pub shared_wire: bool,
    /// How long the parent is busy with each message, in milliseconds
    #[arg(long, value_name = "MS", default_value = "0", value_parser = milliseconds)]
    pub handling: Duration,
    /// With --driver sim: what atoms cost, as measured in this recorded run [default: 0.1 µs a ray]
    #[arg(long, value_name = "LOG")]
    pub costs: Option<PathBuf>,
    /// Write the run's records here
    #[arg(long, value_name = "FILE")]
    pub log: Option<PathBuf>,
    /// What the run is called, for whoever opens its records
    #[arg(long, value_name = "TEXT", default_value = "", hide_default_value = true, requires = "log")]
    pub title: String,
    /// What is to be known of the run, beside its title
    #[arg(long, value_name = "TEXT", default_value = "", hide_default_value = true, requires = "log")]
    pub memo: String,
    /// Print one JSON object about the run on standard output
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub(super) struct InspectArgs {
    /// A scene file, or the name of a built-in scene
    pub scene: String,
    /// The pixel's column and row, from 0,0 in the upper left corner
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pub pixel: [u32; 2],
    /// Pixels across and down
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "640x480", allow_hyphen_values = true)]
    pub size: Size,
    #[command(flatten)]
    pub quality: QualityArgs,
    /// Print one JSON object on standard output
    #[arg(long)]
    pub json: bool,
}

/// How good the picture is to be.
#[derive(Debug, clap::Args)]
pub(super) struct QualityArgs {
    /// Samples a pixel, n × n
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=i64::from(Quality::MAX_SAMPLES)))]
    pub samples: u32,
    /// Take no more samples of a pixel once the error of its colour is estimated as no more than this: for example 0.01
    /// [default: take them all]
    #[arg(long, value_name = "ERROR", default_value = "0", value_parser = part_of_1, hide_default_value = true)]
    pub threshold: f64,
    /// Levels of the tree of rays: 1 shows neither reflections nor what is behind glass
    #[arg(long, value_name = "LEVELS", default_value_t = Quality::default().max_depth,
        value_parser = clap::value_parser!(u32).range(1..=i64::from(Quality::MAX_DEPTH)))]
    pub depth: u32,
    /// Leave out the weakest rays of the tree, as many as count no more than this together [default: 1/255]
    #[arg(long, value_name = "WEIGHT", default_value_t = Quality::default().cutoff, value_parser = part_of_1, hide_default_value = true)]
    pub cutoff: f64,
}

impl QualityArgs {
    /// The same as the tracer takes it.
    pub fn quality(&self) -> Quality {
        let Self { samples, threshold, depth, cutoff, .. } = *self;
        Quality { samples, threshold, max_depth: depth, cutoff, ..Quality::default() }
    }
}

/// What shares the atoms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SchedulerArg {
    By(Strategy),
    /// Rayon's work stealing.
    Rayon,
}

impl FromStr for SchedulerArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == Driver::WorkStealing.name() {
            return Ok(Self::Rayon);
        }
        text.parse().map(Self::By).map_err(|error: UnknownStrategy| format!("{error}, rayon"))
    }
}

/// What part of a core the reference machine gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PaceArg {
    Auto,
    Of(f64),
}

fn driver(text: &str) -> Result<Driver, String> {
    let known = [Driver::Threads, Driver::Pairs, Driver::Sim];
    known.into_iter().find(|driver| driver.name() == text).ok_or_else(|| {
        let known = known.map(Driver::name).join(", ");
        format!("there is no driver `{text}`; there are: {known}")
    })
}

fn pixel(text: &str) -> Result<[u32; 2], String> {
    let places = text.split_once(',').map(|(x, y)| (x.trim().parse(), y.trim().parse()));
    match places {
        Some((Ok(x), Ok(y))) => Ok([x, y]),
        _ => Err("a pixel is its column and its row, for example 320,240".into()),
    }
}

fn speed(text: &str) -> Result<f64, String> {
    number(text, is_rate, "a speed is from 0.0001 to 1")
}

fn pace(text: &str) -> Result<PaceArg, String> {
    match text {
        "auto" => Ok(PaceArg::Auto),
        "full" => Ok(PaceArg::Of(1.0)),
        _ => number(text, is_rate, "a pace is `auto`, `full`, or a number from 0.0001 to 1").map(PaceArg::Of),
    }
}

/// A slower machine would seem to stand still for ever.
fn is_rate(rate: f64) -> bool {
    (1e-4..=1.0).contains(&rate)
}

fn part_of_1(text: &str) -> Result<f64, String> {
    number(text, |part| (0.0..1.0).contains(&part), "it is a number from 0 to less than 1")
}

fn bandwidth(text: &str) -> Result<f64, String> {
    number(text, |bytes| bytes >= 1.0, "a bandwidth is at least 1 byte a second")
}

fn film_seconds(text: &str) -> Result<Duration, String> {
    let seconds = number(text, |seconds| (1.0..=120.0).contains(&seconds), "it is a number of seconds from 1 to 120")?;
    Ok(Duration::from_secs_f64(seconds))
}

fn moment(text: &str) -> Result<Time, String> {
    number(text, |seconds| seconds >= 0.0, "a moment is a number of seconds from 0").map(Time::from_secs)
}

fn milliseconds(text: &str) -> Result<Duration, String> {
    let within = |ms| (0.0..=3_600_000.0).contains(&ms);
    let ms = number(text, within, "it is a number of milliseconds from 0 to 3600000 (an hour)")?;
    Ok(Duration::from_secs_f64(ms / 1e3))
}

fn number(text: &str, valid: impl Fn(f64) -> bool, what: &str) -> Result<f64, String> {
    text.parse().ok().filter(|&number: &f64| number.is_finite() && valid(number)).ok_or_else(|| what.into())
}

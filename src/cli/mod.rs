//! The command line: a window, or a headless command.

mod args;
mod render;
mod report;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;

use crate::driver::auto_pace;
use crate::export::to_pov;
use crate::gui;
use crate::picture::{Size, check_writable};
use crate::scene::Opened;
use crate::tracer::Quality;
use args::{Args, Command};

/// Why a command ended without doing its work: one sentence.
#[derive(Debug)]
enum Failure {
    /// The arguments, the scene or an output path are wrong; nothing was traced. Exit code 2.
    Refused(String),
    /// The run itself failed. Exit code 1.
    Failed(String),
}

/// Runs the program with the arguments of the process. Exit codes: 0 done, 1 the run failed, 2 the arguments, the
/// scene or an output path are wrong.
pub fn main() -> ExitCode {
    let done = Args::try_parse().map_err(usage).and_then(|args| match args.command {
        Some(Command::Render(render)) => render::render(&render),
        Some(Command::Export { scene, pov, size }) => export(&scene, &pov, size),
        None => window(args.scene.as_deref().unwrap_or("ten-objects"), args.log),
    });
    let (code, sentence) = match done {
        Ok(()) => return ExitCode::SUCCESS,
        Err(Failure::Refused(sentence)) => (2, sentence),
        Err(Failure::Failed(sentence)) => (1, sentence),
    };
    eprintln!("anel: {sentence}");
    ExitCode::from(code)
}

/// What is wrong with the arguments, in one sentence; help and version are printed as they are.
fn usage(error: clap::Error) -> Failure {
    if !error.use_stderr() {
        error.exit();
    }
    let text = error.to_string();
    let paragraph: Vec<_> = text.lines().map(str::trim).take_while(|line| !line.is_empty()).collect();
    let sentence = paragraph.join(" ");
    Failure::Refused(format!("{} (`anel --help` tells more)", sentence.trim_start_matches("error: ")))
}

/// Opens the viewer; where that is not possible, does the same run without it.
fn window(argument: &str, log: Option<PathBuf>) -> Result<(), Failure> {
    let scene = open(argument)?;
    if let Some(log) = &log {
        check_writable(log).map_err(|error| Failure::Refused(error.to_string()))?;
    }
    let out = free_name(&scene.name);
    let Err(why) = gui::open(gui::Launch { scene: scene.clone(), log: log.clone() }) else { return Ok(()) };
    eprintln!("anel: no window can be opened ({why}); the same run goes on without one.");
    let (tracer, mut header) = gui::demonstration(&scene);
    // Nobody watches: no need to go slowly.
    header.pace = auto_pace(&header.speeds, header.cores);
    render::run_and_save(&tracer, &header, &render::Outputs { out: &out, log: log.as_deref(), json: false })
}

fn export(argument: &str, pov: &Path, size: Size) -> Result<(), Failure> {
    let opened = open(argument)?;
    check_writable(pov).map_err(|error| Failure::Refused(error.to_string()))?;
    fs::write(pov, to_pov(&opened.scene, size, &Quality::default())).map_err(|error| {
        // What was written is of no use; that it cannot be removed either would change nothing.
        let _ = fs::remove_file(pov);
        Failure::Failed(format!("writing {} failed, nothing was kept: {error}", pov.display()))
    })
}

fn open(argument: &str) -> Result<Opened, Failure> {
    Opened::new(argument).map_err(|error| Failure::Refused(error.to_string()))
}

/// `name`.png in the current directory, or the first of `name`-2.png, `name`-3.png … that does not exist yet.
fn free_name(name: &str) -> PathBuf {
    let numbered = (2..).map(|number| PathBuf::from(format!("{name}-{number}.png")));
    std::iter::once(PathBuf::from(format!("{name}.png")))
        .chain(numbered)
        .find(|path| !path.exists())
        .unwrap_or_else(|| unreachable!("a directory does not hold infinitely many files"))
}

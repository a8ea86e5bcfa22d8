//! The command line: opens the window, or executes a command without it.

mod args;
mod export;
mod inspect;
mod layers;
mod lesson;
mod render;
mod report;
mod run_header;
mod study;

use std::env;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};

use crate::driver::auto_pace;
use crate::gui::{self, Opening, Settings};
use crate::interrupt;
use crate::language::Language;
use crate::output::{as_file_name, check_ending, check_writable, is_same_file, remove_temporary_files};
use crate::parallel::cores;
use crate::runlog::{Header, RunLog, is_run_file};
use crate::scene::{Opened, Scene};
use crate::tracer::Tracer;
use crate::view::note_on_media;
use args::{Args, CliCommand};

/// Why a command failed, in one sentence.
#[derive(Debug)]
enum Failure {
    /// An argument, the scene or an output path is invalid; nothing was traced. Exit code 2.
    Refused(String),
    /// The run itself failed. Exit code 1.
    Failed(String),
}

/// Runs the program with the arguments of the process. Exit codes: 0 success, 1 the run failed, 2 an argument, the
/// scene or an output path is invalid, 128 + n signal n has ended it.
pub fn main() -> ExitCode {
    interrupt::handle_signals();
    let code = execute();
    // Threads that still write end with the process.
    remove_temporary_files();
    code
}

fn execute() -> ExitCode {
    let done = Args::try_parse().map_err(usage).and_then(|args| match args.command {
        Some(CliCommand::Render(render)) => render::render(&render),
        Some(CliCommand::Inspect(inspect)) => inspect::inspect(&inspect),
        Some(CliCommand::Export(args)) => export::export(&args),
        Some(CliCommand::Study { kind, scene, seeds, seed, out, json }) => {
            study::study(kind, scene.as_deref(), (seed, seeds), &out, json)
        }
        Some(CliCommand::Lesson { lesson }) => lesson::lesson(lesson.as_deref()),
        Some(CliCommand::Replay { log }) => replay(&log),
        None => window(args.scene.as_deref(), args.log),
    });
    let (code, sentence) = match done {
        Ok(()) => return interrupt::exit_code().map_or(ExitCode::SUCCESS, ExitCode::from),
        Err(Failure::Refused(sentence)) => (2, sentence),
        Err(Failure::Failed(sentence)) => (1, sentence),
    };
    tell(&sentence);
    ExitCode::from(code)
}

/// Prints a sentence on standard error; ignores errors, since standard error may be closed.
fn tell(sentence: &str) {
    let _ = writeln!(io::stderr(), "anel: {sentence}");
}

/// Prints a result on standard output.
fn print(result: &str) -> Result<(), Failure> {
    print_bytes(result.as_bytes())
}

/// Prints the path of a file on standard output. It need not be UTF-8.
fn print_path(path: &Path) -> Result<(), Failure> {
    print_bytes(path.as_os_str().as_encoded_bytes())
}

fn print_bytes(line: &[u8]) -> Result<(), Failure> {
    match io::stdout().write_all(&[line, b"\n"].concat()) {
        // The reader has closed the pipe; this is not an error.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(Failure::Failed(format!("standard output cannot be written: {error}"))),
        Ok(()) => Ok(()),
    }
}

/// Creates a progress bar; `template` is the text beside it, in indicatif's syntax.
fn progress(steps: u64, template: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(&format!("{{bar:32}} {template}"));
    ProgressBar::new(steps).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Refuses output files that cannot be written, or that would replace the scene or each other.
fn check_outputs(scene: &Path, outputs: &[&Path]) -> Result<(), Failure> {
    for (index, output) in outputs.iter().enumerate() {
        check_writable(output).map_err(|error| Failure::Refused(error.to_string()))?;
        let taken = [scene].into_iter().chain(outputs[..index].iter().copied());
        if let Some(other) = taken.into_iter().find(|other| is_same_file(output, other)) {
            return Err(Failure::Refused(format!(
                "{} would be replaced by {}; choose another name",
                other.display(),
                output.display()
            )));
        }
    }
    Ok(())
}

/// Refuses a name whose ending stands for another format than the one that is written.
fn check_format(path: Option<&Path>, format: &'static str, endings: &[&'static str]) -> Result<(), Failure> {
    path.map_or(Ok(()), |path| check_ending(path, format, endings)).map_err(|error| Failure::Refused(error.to_string()))
}

/// Checks the endings of a picture and of a run file.
fn check_picture_and_log(picture: Option<&Path>, log: Option<&Path>) -> Result<(), Failure> {
    check_format(picture, "a PNG picture", &["png"])?;
    check_format(log, "a run file", &["anel", "json", "jsonl"])
}

/// Reads a run file. If it is cut off, says so.
fn load_run(path: &Path) -> Result<RunLog, Failure> {
    let log = RunLog::load(path).map_err(|error| Failure::Refused(error.to_string()))?;
    if let Some(line) = log.cut_off_at() {
        tell(&format!("{} is cut off in line {line}; the records before that line are used", path.display()));
    }
    Ok(log)
}

/// Turns an error of the arguments into one sentence. If help or the version is asked for, prints it and exits.
fn usage(error: clap::Error) -> Failure {
    if !error.use_stderr() {
        error.exit();
    }
    let text = error.to_string();
    let paragraph: Vec<_> = text.lines().map(str::trim).take_while(|line| !line.is_empty()).collect();
    let sentence = paragraph.join(" ");
    let command = env::args_os().nth(1).and_then(|first| first.into_string().ok());
    let command =
        command.filter(|first| ["render", "inspect", "export", "study", "lesson", "replay"].contains(&&**first));
    let command = command.map(|command| format!("{command} ")).unwrap_or_default();
    Failure::Refused(format!("{} (see `anel {command}--help`)", sentence.trim_start_matches("error: ")))
}

/// Opens the window with a scene, a recorded run, a lesson, or the last one that was open. If no window can be opened,
/// does the run without it.
fn window(argument: Option<&Path>, log: Option<PathBuf>) -> Result<(), Failure> {
    let opening = match argument {
        Some(path) if is_run_file(path) => Some(Opening::Run(Arc::new(load_run(path)?))),
        Some(path) => Some(Opening::read(path).map_err(Failure::Refused)?),
        None => None,
    };
    check_outputs(argument.unwrap_or(Path::new("")), log.as_deref().as_slice())?;
    check_picture_and_log(None, log.as_deref())?;
    show(opening, log)
}

fn replay(path: &Path) -> Result<(), Failure> {
    show(Some(Opening::Run(Arc::new(load_run(path)?))), None)
}

fn show(opening: Option<Opening>, log: Option<PathBuf>) -> Result<(), Failure> {
    // The order of POSIX: the first variable that is set counts.
    let locale = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter().filter_map(|name| env::var(name).ok());
    let language = locale.map(|locale| Language::of_locale(&locale)).next().unwrap_or_default();
    let launch = gui::Launch { opening: opening.clone(), log: log.clone(), language };
    let Err(why) = gui::open(launch) else { return Ok(()) };
    tell(&format!("no window can be opened ({why}); the run is done without one."));
    let opening = opening.map_or_else(|| Opening::read("ten-objects"), Ok).map_err(Failure::Refused)?;
    let (scene, mut header) = match opening {
        Opening::Scene(scene) => {
            let header = Settings::default().header(&scene.name, &scene.text, Duration::ZERO, cores());
            (scene.scene.clone(), header)
        }
        // A speed of 0 could not be raised here, so all speeds are 1; only the picture is that of the recorded run.
        Opening::Run(run) => {
            let scene = Scene::parse(&run.header.scene_text).map_err(|error| Failure::Refused(error.to_string()))?;
            (scene, Header { speeds: vec![1.0; run.header.speeds.len()], ..run.header.clone() })
        }
        Opening::Lesson(taught) => return lesson::play(&taught),
    };
    // Without a viewer the run may go at the full pace.
    header.pace = auto_pace(&header.speeds, header.cores);
    let out = free_name(&as_file_name(&header.scene));
    check_outputs(Path::new(""), &[&out])?;
    let tracer = Arc::new(Tracer::new(&scene, header.size, header.quality));
    render::run_and_save(&tracer, &header, None, &render::Outputs::of_run(&out, log.as_deref()))
}

/// Opens a scene, and says on stderr what its author may not have meant.
fn open(argument: impl AsRef<Path>) -> Result<Opened, Failure> {
    let opened = Opened::new(argument).map_err(|error| Failure::Refused(error.to_string()))?;
    if let Some(note) = note_on_media(&opened.scene, Language::English) {
        eprintln!("note: {note}");
    }
    Ok(opened)
}

/// `name`.png in the current directory, or the first of `name`-2.png, `name`-3.png … that does not exist yet.
fn free_name(name: &str) -> PathBuf {
    let numbered = (2..).map(|number| PathBuf::from(format!("{name}-{number}.png")));
    std::iter::once(PathBuf::from(format!("{name}.png")))
        .chain(numbered)
        .find(|path| !path.exists())
        .unwrap_or_else(|| unreachable!("a directory does not hold infinitely many files"))
}

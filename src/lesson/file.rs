//! A lesson's file: RON, and errors that say where.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::de::Error;
use serde::{Deserialize, Deserializer};

use super::{BUILT_IN, Claim, Lesson, Look, Moment, Plan, Question, Step, Words};
use crate::balance::{NodeId, Strategy};
use crate::picture::Size;
use crate::ron_file::{self, FileError, find_name, skipped};
use crate::scenario::Command;
use crate::time::Time;

/// What a window can show of a run.
const MOST_MACHINES: usize = 32;
const MOST_ATOMS: u32 = 1 << 18;
const LONGEST_SIDE: u32 = 2048;

impl Lesson {
    /// Reads a lesson's file, or the built-in lesson of that name if there is no such file.
    ///
    /// # Errors
    /// A [`FileError`] that names the file.
    pub fn open(argument: &str) -> Result<Self, FileError> {
        let path = Path::new(argument);
        let built_in = BUILT_IN.iter().find(|(name, _)| *name == argument).filter(|_| !path.exists());
        if let Some((name, text)) = built_in {
            return Self::parse(name, text);
        }
        let none = || {
            let names: Vec<_> = BUILT_IN.iter().map(|(name, _)| *name).collect();
            format!("there is no such file, and no built-in lesson of that name (they are {})", names.join(", "))
        };
        let name = path.file_stem().map_or_else(|| argument.into(), |stem| stem.to_string_lossy().into_owned());
        let text = ron_file::read(path, "lesson", none).map_err(|message| FileError::new(None, &message));
        let directory = path.parent().map(Path::to_path_buf).unwrap_or_default();
        text.and_then(|text| Self::parse(&name, &text))
            .map(|lesson| Self { directory, ..lesson })
            .map_err(|error| error.of(argument))
    }

    /// Reads the text of a lesson's file.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line, its column and its field.
    pub fn parse(name: &str, text: &str) -> Result<Self, FileError> {
        const DEEP: &str = "a lesson has no such depths";
        let file: LessonFile = ron_file::parse(text, "lesson", "a title, runs and steps", DEEP)?;
        file.resolve(name)
            .map_err(|(what, message)| FileError::new(what.and_then(|what| find_name(text, &what)), &message))
    }
}

/// Whether this is a file that begins like a lesson, after comments: then its mistakes are a lesson's.
pub fn is_lesson_file(path: &Path) -> bool {
    let text = ron_file::read(path, "lesson", String::new).unwrap_or_default();
    let mut rest = text.trim_start_matches(|c: char| c == '\u{feff}' || c.is_whitespace());
    while let Some(comment) = skipped(rest).filter(|_| rest.starts_with('/')) {
        rest = rest[comment..].trim_start();
    }
    rest.starts_with("Lesson")
}

/// The file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "Lesson")]
struct LessonFile {
    title: Words,
    about: Words,
    runs: BTreeMap<String, PlanFile>,
    steps: Vec<StepFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
struct PlanFile {
    scene: String,
    size: (u32, u32),
    atom: u32,
    #[serde(deserialize_with = "strategy")]
    strategy: Strategy,
    part: Option<u32>,
    speeds: Vec<f64>,
    latency_ms: f64,
    handling_ms: f64,
    seconds: f64,
    script: Vec<Deed>,
}

/// At some second a machine gets another speed.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Deed {
    at: f64,
    machine: usize,
    speed: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StepFile {
    say: Words,
    #[serde(default)]
    run: Option<String>,
    #[serde(default)]
    until: Option<Moment>,
    #[serde(default)]
    machine: Option<usize>,
    #[serde(default)]
    look: Look,
    #[serde(default)]
    ask: Option<QuestionFile>,
    #[serde(default)]
    holds: Vec<Claim>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct QuestionFile {
    question: Words,
    answers: Vec<Words>,
    right: usize,
    because: Words,
}

impl Default for PlanFile {
    /// The article's scene on eight equal machines in a ring, in some twenty seconds.
    fn default() -> Self {
        Self {
            scene: "ten-objects".into(),
            size: (640, 480),
            atom: 50,
            strategy: Strategy::Ring,
            part: None,
            speeds: vec![1.0; 8],
            latency_ms: 40.0,
            handling_ms: 0.0,
            seconds: 20.0,
            script: Vec::new(),
        }
    }
}

/// What is wrong, and a text of the file that tells where, if there is one.
type Wrong = (Option<String>, String);

impl LessonFile {
    fn resolve(self, name: &str) -> Result<Lesson, Wrong> {
        if self.runs.is_empty() {
            return Err((None, "a lesson needs at least one run".into()));
        }
        let mut runs = BTreeMap::new();
        for (name, plan) in self.runs {
            let plan =
                plan.resolve().map_err(|message| (Some(name.clone()), format!("the run `{name}`: {message}")))?;
            runs.insert(name, plan);
        }
        let mut steps: Vec<Step> = Vec::new();
        for (number, step) in (1..).zip(self.steps) {
            let only = runs.keys().next().filter(|_| runs.len() == 1);
            let run = step.run.clone().or_else(|| steps.last().map(|step| step.run.clone())).or_else(|| only.cloned());
            let Some(run) = run else {
                return Err((None, format!("step {number}: which run does it show? The first step has to say `run:`")));
            };
            steps.push(step.resolve(&runs, run).map_err(|(what, why)| (what, format!("step {number}: {why}")))?);
        }
        if steps.is_empty() {
            return Err((None, "a lesson needs at least one step".into()));
        }
        Ok(Lesson { name: name.into(), directory: PathBuf::new(), title: self.title, about: self.about, runs, steps })
    }
}

impl PlanFile {
    fn resolve(self) -> Result<Plan, String> {
        let size = Size::new(self.size.0, self.size.1)?;
        if size.width().max(size.height()) > LONGEST_SIDE {
            return Err(format!("a side of the picture can be up to {LONGEST_SIDE} pixels"));
        }
        if self.atom == 0 || size.pixels().div_ceil(self.atom.max(1)) > MOST_ATOMS {
            return Err(format!("atoms of {} pixels: there can be up to {MOST_ATOMS} of at least one", self.atom));
        }
        if !(1..=MOST_MACHINES).contains(&self.speeds.len()) {
            return Err(format!("there can be 1 to {MOST_MACHINES} machines, not {}", self.speeds.len()));
        }
        if !self.speeds.iter().all(|speed| (0.0..=1.0).contains(speed)) {
            return Err("a speed can be 0 to 1".into());
        }
        let time = |what: &str, value: f64, least: f64, most: f64| {
            let is_possible = (least..=most).contains(&value);
            if is_possible { Ok(value) } else { Err(format!("{what} can be {least} to {most}, not {value}")) }
        };
        let ms = |what, value| time(what, value, 0.0, 60_000.0).map(|value| Duration::from_secs_f64(value * 1e-3));
        let part = self.part.filter(|part| !(1..=MOST_ATOMS).contains(part));
        if let Some(part) = part {
            return Err(format!("a part can be 1 to {MOST_ATOMS} atoms, not {part}"));
        }
        let mut script = Vec::new();
        for Deed { at, machine, speed } in self.script {
            let node = node(machine, self.speeds.len())?;
            let speed = time("a speed", speed, 0.0, 1.0)?;
            let at = Time::from_secs(time("the second at which a machine changes", at, 0.0, 3600.0)?);
            script.push((at, Command::Speed { node, speed }));
        }
        script.sort_by_key(|(at, _)| *at);
        Ok(Plan {
            scene: self.scene,
            size,
            atom: self.atom,
            strategy: self.strategy,
            part: self.part,
            latency: ms("`latency_ms`", self.latency_ms)?,
            handling: ms("`handling_ms`", self.handling_ms)?,
            lasts: Duration::from_secs_f64(time("`seconds`", self.seconds, 0.1, 3600.0)?),
            speeds: self.speeds,
            script,
        })
    }
}

impl StepFile {
    fn resolve(self, runs: &BTreeMap<String, Plan>, run: String) -> Result<Step, Wrong> {
        let known = |name: &String| {
            let all: Vec<_> = runs.keys().map(|name| format!("`{name}`")).collect();
            let wrong = || (Some(name.clone()), format!("there is no run `{name}`; there are {}", all.join(", ")));
            runs.get(name).ok_or_else(wrong)
        };
        let machines = known(&run)?.speeds.len();
        for name in self.holds.iter().flat_map(|claim| claim.of.iter().chain(&claim.over)) {
            known(name)?;
        }
        if self.holds.iter().any(|claim| claim.at_least.is_none() && claim.at_most.is_none()) {
            return Err((None, "a claim needs `at_least` or `at_most`".into()));
        }
        let machine = self.machine.map(|machine| node(machine, machines)).transpose().map_err(|why| (None, why))?;
        let ask = self.ask.map(QuestionFile::resolve).transpose().map_err(|why| (None, why))?;
        Ok(Step { say: self.say, run, until: self.until, machine, look: self.look, ask, holds: self.holds })
    }
}

impl QuestionFile {
    fn resolve(self) -> Result<Question, String> {
        let answers = self.answers.len();
        if !(2..=5).contains(&answers) {
            return Err(format!("a question can have 2 to 5 answers, not {answers}"));
        }
        if !(1..=answers).contains(&self.right) {
            return Err(format!("`right` is the number of the right answer, 1 to {answers}, not {}", self.right));
        }
        let Self { question, answers, right, because } = self;
        Ok(Question { question, answers, right: right - 1, because })
    }
}

/// By its name on the command line.
fn strategy<'de, D: Deserializer<'de>>(from: D) -> Result<Strategy, D::Error> {
    String::deserialize(from)?.parse().map_err(D::Error::custom)
}

/// People count machines from 1.
fn node(machine: usize, machines: usize) -> Result<NodeId, String> {
    let is_there = (1..=machines).contains(&machine);
    // No more than 32.
    if is_there {
        Ok((machine - 1) as NodeId)
    } else {
        Err(format!("there are machines 1 to {machines}, not {machine}"))
    }
}

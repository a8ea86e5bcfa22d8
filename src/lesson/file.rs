//! The lesson file: its RON grammar, its limits, and its errors with their places.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::de::Error;
use serde::{Deserialize, Deserializer};

use super::error::{InvalidLesson, Part, Problem};
use super::{
    BUILT_IN, Claim, Lesson, MAX_ATOMS, MAX_MACHINES, MAX_SIDE_PX, Moment, Question, RunPlan, Step, StepView, Words,
};
use crate::balance::{Condition, NodeId, Remedies, Remedy, Strategy};
use crate::picture::Size;
use crate::ron_file::{self, FileError, comment_or_string_length, find_path};
use crate::scenario::Command;
use crate::scene;
use crate::time::Time;

impl Lesson {
    /// Reads the lesson file at the path `argument`, or the built-in lesson of that name if there is no such file.
    ///
    /// # Errors
    /// A [`FileError`] that names the file.
    pub fn open(argument: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = argument.as_ref();
        let built_in = BUILT_IN.iter().find(|(name, _)| path.as_os_str() == *name).filter(|_| !path.exists());
        if let Some((name, text)) = built_in {
            return Self::parse(name, text);
        }
        let name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        let text = ron_file::read(path, "lesson", BUILT_IN.iter().map(|(name, _)| *name));
        let directory = path.parent().map(Path::to_path_buf).unwrap_or_default();
        text.map_err(FileError::from)
            .and_then(|text| Self::parse_in(directory, &name, &text))
            .map_err(|error| error.in_file(path))
    }

    /// Reads the text of a lesson file without a directory; its runs can use only built-in scenes.
    ///
    /// # Errors
    /// The first mistake, with its line, column and field.
    pub fn parse(name: &str, text: &str) -> Result<Self, FileError> {
        Self::parse_in(PathBuf::new(), name, text)
    }

    fn parse_in(directory: PathBuf, name: &str, text: &str) -> Result<Self, FileError> {
        const DEEP: &str = "the file is nested too deeply for a lesson";
        let file: LessonFile = ron_file::parse(text, "lesson", "a title, runs and steps", DEEP)?;
        file.resolve(name, directory).map_err(|error| FileError::new(find_path(text, &error.path), &error.to_string()))
    }
}

/// Whether the file begins with `Lesson`, after comments; its errors are then reported as those of a lesson.
pub fn is_lesson_file(path: &Path) -> bool {
    let text = ron_file::read(path, "lesson", []).unwrap_or_default();
    let mut rest = text.trim_start_matches(|c: char| c == '\u{feff}' || c.is_whitespace());
    while let Some(comment) = comment_or_string_length(rest).filter(|_| rest.starts_with('/')) {
        rest = rest[comment..].trim_start();
    }
    rest.starts_with("Lesson")
}

/// The fields of a lesson file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "Lesson")]
struct LessonFile {
    title: Words,
    about: Words,
    runs: BTreeMap<String, PlanFile>,
    steps: Vec<StepFile>,
}

/// The fields of a run.
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
    latencies_ms: Vec<f64>,
    handling_ms: f64,
    seconds: f64,
    spares: usize,
    #[serde(deserialize_with = "remedies")]
    without: Vec<Remedy>,
    script: Vec<ScriptEntry>,
}

/// An entry of `script`: at this second a machine gets another speed or another condition.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ScriptEntry {
    at: f64,
    machine: usize,
    #[serde(default)]
    speed: Option<f64>,
    #[serde(default)]
    becomes: Option<ConditionFile>,
}

/// The condition of a machine, as `becomes` names it.
#[derive(Clone, Copy, Deserialize)]
enum ConditionFile {
    Well,
    Hung,
    CutOff,
    Off,
}

/// The fields of a step.
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
    look: StepView,
    #[serde(default)]
    ask: Option<QuestionFile>,
    #[serde(default)]
    holds: Vec<Claim>,
}

/// The fields of a question.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct QuestionFile {
    question: Words,
    answers: Vec<Words>,
    right: usize,
    because: Words,
}

impl Default for PlanFile {
    /// The article's scene on eight equal machines in a ring; the run lasts about twenty seconds.
    fn default() -> Self {
        Self {
            scene: "ten-objects".into(),
            size: (640, 480),
            atom: 50,
            strategy: Strategy::Ring,
            part: None,
            speeds: vec![1.0; 8],
            latency_ms: 40.0,
            latencies_ms: Vec::new(),
            handling_ms: 0.0,
            seconds: 20.0,
            spares: 0,
            without: Vec::new(),
            script: Vec::new(),
        }
    }
}

impl LessonFile {
    fn resolve(self, name: &str, directory: PathBuf) -> Result<Lesson, InvalidLesson> {
        if self.runs.is_empty() {
            return Err(InvalidLesson::new(&["runs"], Problem::NoRuns));
        }
        let mut runs = BTreeMap::new();
        for (name, plan) in self.runs {
            let plan = plan.resolve(&directory).map_err(|error| error.within(Part::Run(name.clone())))?;
            runs.insert(name, plan);
        }
        let mut steps: Vec<Step> = Vec::new();
        for (index, step) in self.steps.into_iter().enumerate() {
            let only = runs.keys().next().filter(|_| runs.len() == 1);
            let run = step.run.clone().or_else(|| steps.last().map(|step| step.run.clone())).or_else(|| only.cloned());
            let run = run.ok_or_else(|| InvalidLesson::new(&[], Problem::NoRunNamed));
            let step = run.and_then(|run| step.resolve(&runs, run));
            steps.push(step.map_err(|error| error.within(Part::Step(index)))?);
        }
        if steps.is_empty() {
            return Err(InvalidLesson::new(&["steps"], Problem::NoSteps));
        }
        Ok(Lesson { name: name.into(), directory, title: self.title, about: self.about, runs, steps })
    }
}

impl PlanFile {
    fn resolve(self, directory: &Path) -> Result<RunPlan, InvalidLesson> {
        if scene::built_in(&self.scene).is_none() && !directory.join(&self.scene).is_file() {
            let known: Vec<_> = scene::BUILT_IN.iter().map(|(name, _)| *name).collect();
            let problem = Problem::NoScene { scene: self.scene, known: known.join(", ") };
            return Err(InvalidLesson::new(&["scene"], problem));
        }
        let size = Size::new(self.size.0, self.size.1).map_err(|error| InvalidLesson::new(&["size"], error.into()))?;
        if size.width().max(size.height()) > MAX_SIDE_PX {
            return Err(InvalidLesson::new(&["size"], Problem::LongSide));
        }
        if self.atom == 0 {
            return Err(InvalidLesson::new(&["atom"], Problem::EmptyAtom));
        }
        if size.pixels().div_ceil(self.atom) > MAX_ATOMS {
            return Err(InvalidLesson::new(&["atom"], Problem::TooManyAtoms(self.atom)));
        }
        if !(1..=MAX_MACHINES).contains(&self.speeds.len()) {
            return Err(InvalidLesson::new(&["speeds"], Problem::MachineCount(self.speeds.len())));
        }
        if !self.speeds.iter().all(|speed| (0.0..=1.0).contains(speed)) {
            return Err(InvalidLesson::new(&["speeds"], Problem::Speed));
        }
        if self.spares >= self.speeds.len() || self.spares > 0 && !self.strategy.survives_losses() {
            return Err(InvalidLesson::new(&["spares"], Problem::Spares));
        }
        if !self.without.is_empty() && self.strategy != Strategy::Adaptive {
            return Err(InvalidLesson::new(&["without"], Problem::NoRemedies));
        }
        let duration = |field, what, milliseconds| {
            in_range(what, milliseconds, 0.0, 60_000.0)
                .map(|value| Duration::from_secs_f64(value * 1e-3))
                .map_err(|problem| InvalidLesson::new(&[field], problem))
        };
        if let Some(part) = self.part.filter(|part| !(1..=MAX_ATOMS).contains(part)) {
            return Err(InvalidLesson::new(&["part"], Problem::Part(part)));
        }
        if ![0, self.speeds.len()].contains(&self.latencies_ms.len()) {
            let problem = Problem::LatencyCount { latencies: self.latencies_ms.len(), machines: self.speeds.len() };
            return Err(InvalidLesson::new(&["latencies_ms"], problem));
        }
        let latencies = match &self.latencies_ms[..] {
            [] => vec![duration("latency_ms", "`latency_ms`", self.latency_ms)?],
            each => {
                let latency = |&ms: &f64| duration("latencies_ms", "each of `latencies_ms`", ms);
                each.iter().map(latency).collect::<Result<_, _>>()?
            }
        };
        let mut script = Vec::new();
        for (index, entry) in self.script.into_iter().enumerate() {
            let entry = entry.resolve(self.speeds.len());
            script.push(entry.map_err(|problem| InvalidLesson::new(&["script", &index.to_string()], problem))?);
        }
        script.sort_by_key(|(at, _)| *at);
        let lasts = in_range("`seconds`", self.seconds, 0.1, 3600.0)
            .map_err(|problem| InvalidLesson::new(&["seconds"], problem))?;
        Ok(RunPlan {
            scene: self.scene,
            size,
            atom: self.atom,
            strategy: self.strategy,
            part: self.part,
            latencies,
            handling: duration("handling_ms", "`handling_ms`", self.handling_ms)?,
            lasts: Duration::from_secs_f64(lasts),
            speeds: self.speeds,
            // Fewer than the machines, of which there are at most 32.
            spares: self.spares as NodeId,
            remedies: self.without.into_iter().fold(Remedies::ALL, Remedies::without),
            script,
        })
    }
}

impl ScriptEntry {
    fn resolve(self, machines: usize) -> Result<(Time, Command), Problem> {
        let node = node(self.machine, machines)?;
        let at = in_range("`at`, in seconds,", self.at, 0.0, 3600.0)?;
        let command = match (self.speed, self.becomes) {
            (Some(speed), None) => Command::Speed { node, speed: in_range("a speed", speed, 0.0, 1.0)? },
            (None, Some(becomes)) => Command::Condition { node, condition: becomes.condition() },
            _ => return Err(Problem::ScriptEntry),
        };
        Ok((Time::from_secs(at), command))
    }
}

impl ConditionFile {
    fn condition(self) -> Condition {
        match self {
            Self::Well => Condition::Well,
            Self::Hung => Condition::Hung,
            Self::CutOff => Condition::CutOff,
            Self::Off => Condition::Off,
        }
    }
}

impl StepFile {
    fn resolve(self, runs: &BTreeMap<String, RunPlan>, run: String) -> Result<Step, InvalidLesson> {
        let find = |name: &String, path: &[&str]| {
            let known: Vec<_> = runs.keys().map(|name| format!("`{name}`")).collect();
            let problem = || Problem::NoRun { name: name.clone(), known: known.join(", ") };
            runs.get(name).ok_or_else(|| InvalidLesson::new(path, problem()))
        };
        let machines = find(&run, &["run"])?.speeds.len();
        for (index, claim) in self.holds.iter().enumerate() {
            let index = index.to_string();
            for (field, name) in [("of", &claim.of), ("over", &claim.over)] {
                name.iter().try_for_each(|name| find(name, &["holds", &index, field]).map(|_| ()))?;
            }
            if claim.at_least.is_none() && claim.at_most.is_none() {
                return Err(InvalidLesson::new(&["holds", &index], Problem::Unbounded));
            }
        }
        let machine = self.machine.map(|machine| node(machine, machines)).transpose();
        let machine = machine.map_err(|problem| InvalidLesson::new(&["machine"], problem))?;
        let ask = self.ask.map(QuestionFile::resolve).transpose()?;
        Ok(Step { say: self.say, run, until: self.until, machine, look: self.look, ask, holds: self.holds })
    }
}

impl QuestionFile {
    fn resolve(self) -> Result<Question, InvalidLesson> {
        let answers = self.answers.len();
        if !(2..=5).contains(&answers) {
            return Err(InvalidLesson::new(&["ask", "answers"], Problem::AnswerCount(answers)));
        }
        if !(1..=answers).contains(&self.right) {
            let problem = Problem::RightAnswer { right: self.right, answers };
            return Err(InvalidLesson::new(&["ask", "right"], problem));
        }
        let Self { question, answers, right, because } = self;
        Ok(Question { question, answers, right: right - 1, because })
    }
}

/// Reads a strategy by its name on the command line.
fn strategy<'de, D: Deserializer<'de>>(from: D) -> Result<Strategy, D::Error> {
    String::deserialize(from)?.parse().map_err(D::Error::custom)
}

/// Reads remedies by their names on the command line.
fn remedies<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Remedy>, D::Error> {
    let names = Vec::<String>::deserialize(from)?;
    names.iter().map(|name| name.parse().map_err(D::Error::custom)).collect()
}

/// Converts a machine's number, from 1, into its node.
fn node(machine: usize, machines: usize) -> Result<NodeId, Problem> {
    let exists = (1..=machines).contains(&machine);
    // At most 32.
    if exists { Ok((machine - 1) as NodeId) } else { Err(Problem::NoMachine { machine, machines }) }
}

/// Returns `value` if it lies from `least` to `most`.
fn in_range(what: &'static str, value: f64, least: f64, most: f64) -> Result<f64, Problem> {
    let is_valid = (least..=most).contains(&value);
    if is_valid { Ok(value) } else { Err(Problem::OutOfRange { what, least, most, value }) }
}

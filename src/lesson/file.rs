//! A lesson's file: RON, and errors that say where.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::de::Error;
use serde::{Deserialize, Deserializer};

use super::{BUILT_IN, Claim, Lesson, LowerView, Moment, Question, RunPlan, Step, Words};
use crate::balance::{Condition, NodeId, Remedies, Remedy, Strategy};
use crate::picture::Size;
use crate::ron_file::{self, FileError, comment_or_string_length, find_path};
use crate::scenario::Command;
use crate::scene;
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
        let name = path.file_stem().map_or_else(|| argument.into(), |stem| stem.to_string_lossy().into_owned());
        let text = ron_file::read(path, "lesson", BUILT_IN.iter().map(|(name, _)| *name));
        let directory = path.parent().map(Path::to_path_buf).unwrap_or_default();
        text.map_err(FileError::from)
            .and_then(|text| Self::parse_in(directory, &name, &text))
            .map_err(|error| error.in_file(argument))
    }

    /// Reads the text of a lesson's file, beside which there are no scenes.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line, its column and its field.
    pub fn parse(name: &str, text: &str) -> Result<Self, FileError> {
        Self::parse_in(PathBuf::new(), name, text)
    }

    fn parse_in(directory: PathBuf, name: &str, text: &str) -> Result<Self, FileError> {
        const DEEP: &str = "a lesson has no such depths";
        let file: LessonFile = ron_file::parse(text, "lesson", "a title, runs and steps", DEEP)?;
        file.resolve(name, directory).map_err(|Wrong { path, why }| FileError::new(find_path(text, &path), &why))
    }
}

/// Whether this is a file that begins like a lesson, after comments: then its mistakes are a lesson's.
pub fn is_lesson_file(path: &Path) -> bool {
    let text = ron_file::read(path, "lesson", []).unwrap_or_default();
    let mut rest = text.trim_start_matches(|c: char| c == '\u{feff}' || c.is_whitespace());
    while let Some(comment) = comment_or_string_length(rest).filter(|_| rest.starts_with('/')) {
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
    spares: usize,
    #[serde(deserialize_with = "remedies")]
    without: Vec<Remedy>,
    script: Vec<ScriptStep>,
}

/// At some second a machine gets another speed, or something else becomes of it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ScriptStep {
    at: f64,
    machine: usize,
    #[serde(default)]
    speed: Option<f64>,
    #[serde(default)]
    becomes: Option<ConditionFile>,
}

/// What becomes of a machine.
#[derive(Clone, Copy, Deserialize)]
enum ConditionFile {
    Well,
    Hung,
    CutOff,
    Off,
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
    look: LowerView,
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
            spares: 0,
            without: Vec::new(),
            script: Vec::new(),
        }
    }
}

/// What is wrong, and where in the file.
struct Wrong {
    path: Vec<String>,
    why: String,
}

impl Wrong {
    fn new(path: &[&str], why: impl Into<String>) -> Self {
        Self { path: path.iter().map(|&step| step.to_owned()).collect(), why: why.into() }
    }

    /// The same within something else, which is called so.
    fn within(mut self, path: &[&str], called: &str) -> Self {
        self.path.splice(0..0, path.iter().map(|&step| step.to_owned()));
        Self { path: self.path, why: format!("{called}: {}", self.why) }
    }
}

impl LessonFile {
    fn resolve(self, name: &str, directory: PathBuf) -> Result<Lesson, Wrong> {
        if self.runs.is_empty() {
            return Err(Wrong::new(&["runs"], "a lesson needs at least one run"));
        }
        let mut runs = BTreeMap::new();
        for (name, plan) in self.runs {
            let plan = plan.resolve(&directory);
            let plan = plan.map_err(|wrong| wrong.within(&["runs", &name], &format!("the run `{name}`")))?;
            runs.insert(name, plan);
        }
        let mut steps: Vec<Step> = Vec::new();
        for (index, step) in self.steps.into_iter().enumerate() {
            let only = runs.keys().next().filter(|_| runs.len() == 1);
            let run = step.run.clone().or_else(|| steps.last().map(|step| step.run.clone())).or_else(|| only.cloned());
            let unknown = || Wrong::new(&[], "which run does it show? The first step has to say `run:`");
            let step = run.ok_or_else(unknown).and_then(|run| step.resolve(&runs, run));
            let within = |wrong: Wrong| wrong.within(&["steps", &index.to_string()], &format!("step {}", index + 1));
            steps.push(step.map_err(within)?);
        }
        if steps.is_empty() {
            return Err(Wrong::new(&["steps"], "a lesson needs at least one step"));
        }
        Ok(Lesson { name: name.into(), directory, title: self.title, about: self.about, runs, steps })
    }
}

impl PlanFile {
    fn resolve(self, directory: &Path) -> Result<RunPlan, Wrong> {
        if scene::built_in(&self.scene).is_none() && !directory.join(&self.scene).is_file() {
            let names: Vec<_> = scene::BUILT_IN.iter().map(|(name, _)| *name).collect();
            let (scene, names) = (&self.scene, names.join(", "));
            let why = format!("there is no scene `{scene}` beside the lesson, and no built-in one (they are {names})");
            return Err(Wrong::new(&["scene"], why));
        }
        let size = Size::new(self.size.0, self.size.1).map_err(|why| Wrong::new(&["size"], why))?;
        if size.width().max(size.height()) > LONGEST_SIDE {
            return Err(Wrong::new(&["size"], format!("a side of the picture can be up to {LONGEST_SIDE} pixels")));
        }
        if self.atom == 0 || size.pixels().div_ceil(self.atom.max(1)) > MOST_ATOMS {
            let why = format!("atoms of {} pixels: there can be up to {MOST_ATOMS} of at least one", self.atom);
            return Err(Wrong::new(&["atom"], why));
        }
        if !(1..=MOST_MACHINES).contains(&self.speeds.len()) {
            let why = format!("there can be 1 to {MOST_MACHINES} machines, not {}", self.speeds.len());
            return Err(Wrong::new(&["speeds"], why));
        }
        if !self.speeds.iter().all(|speed| (0.0..=1.0).contains(speed)) {
            return Err(Wrong::new(&["speeds"], "a speed can be 0 to 1"));
        }
        if self.spares >= self.speeds.len() || self.spares > 0 && self.strategy != Strategy::Adaptive {
            let why = "only an `adaptive` run has spare machines, the last of its `speeds`, and not all can be spare";
            return Err(Wrong::new(&["spares"], why));
        }
        if !self.without.is_empty() && self.strategy != Strategy::Adaptive {
            return Err(Wrong::new(&["without"], "only an `adaptive` run has remedies that it could be without"));
        }
        let ms = |field, value| {
            within(&format!("`{field}`"), value, 0.0, 60_000.0)
                .map(|value| Duration::from_secs_f64(value * 1e-3))
                .map_err(|why| Wrong::new(&[field], why))
        };
        let part = self.part.filter(|part| !(1..=MOST_ATOMS).contains(part));
        if let Some(part) = part {
            return Err(Wrong::new(&["part"], format!("a part can be 1 to {MOST_ATOMS} atoms, not {part}")));
        }
        let mut script = Vec::new();
        for (index, deed) in self.script.into_iter().enumerate() {
            let deed = deed.resolve(self.speeds.len());
            script.push(deed.map_err(|why| Wrong::new(&["script", &index.to_string()], why))?);
        }
        script.sort_by_key(|(at, _)| *at);
        let lasts = within("`seconds`", self.seconds, 0.1, 3600.0).map_err(|why| Wrong::new(&["seconds"], why))?;
        Ok(RunPlan {
            scene: self.scene,
            size,
            atom: self.atom,
            strategy: self.strategy,
            part: self.part,
            latency: ms("latency_ms", self.latency_ms)?,
            handling: ms("handling_ms", self.handling_ms)?,
            lasts: Duration::from_secs_f64(lasts),
            speeds: self.speeds,
            // Fewer than machines, of which there are few.
            spares: self.spares as NodeId,
            remedies: self.without.into_iter().fold(Remedies::ALL, Remedies::without),
            script,
        })
    }
}

impl ScriptStep {
    fn resolve(self, machines: usize) -> Result<(Time, Command), String> {
        let node = node(self.machine, machines)?;
        let at = within("the second at which a machine changes", self.at, 0.0, 3600.0)?;
        let command = match (self.speed, self.becomes) {
            (Some(speed), None) => Command::Speed { node, speed: within("a speed", speed, 0.0, 1.0)? },
            (None, Some(becomes)) => Command::Condition { node, condition: becomes.condition() },
            _ => return Err("a machine gets another `speed`, or `becomes` something: one of both".into()),
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
    fn resolve(self, runs: &BTreeMap<String, RunPlan>, run: String) -> Result<Step, Wrong> {
        let known = |name: &String, path: &[&str]| {
            let all: Vec<_> = runs.keys().map(|name| format!("`{name}`")).collect();
            let wrong = || Wrong::new(path, format!("there is no run `{name}`; there are {}", all.join(", ")));
            runs.get(name).ok_or_else(wrong)
        };
        let machines = known(&run, &["run"])?.speeds.len();
        for (index, claim) in self.holds.iter().enumerate() {
            let index = index.to_string();
            for (field, name) in [("of", &claim.of), ("over", &claim.over)] {
                name.iter().try_for_each(|name| known(name, &["holds", &index, field]).map(|_| ()))?;
            }
            if claim.at_least.is_none() && claim.at_most.is_none() {
                return Err(Wrong::new(&["holds", &index], "a claim needs `at_least` or `at_most`"));
            }
        }
        let machine = self.machine.map(|machine| node(machine, machines)).transpose();
        let machine = machine.map_err(|why| Wrong::new(&["machine"], why))?;
        let ask = self.ask.map(QuestionFile::resolve).transpose()?;
        Ok(Step { say: self.say, run, until: self.until, machine, look: self.look, ask, holds: self.holds })
    }
}

impl QuestionFile {
    fn resolve(self) -> Result<Question, Wrong> {
        let answers = self.answers.len();
        if !(2..=5).contains(&answers) {
            let why = format!("a question can have 2 to 5 answers, not {answers}");
            return Err(Wrong::new(&["ask", "answers"], why));
        }
        if !(1..=answers).contains(&self.right) {
            let why = format!("`right` is the number of the right answer, 1 to {answers}, not {}", self.right);
            return Err(Wrong::new(&["ask", "right"], why));
        }
        let Self { question, answers, right, because } = self;
        Ok(Question { question, answers, right: right - 1, because })
    }
}

/// By its name on the command line.
fn strategy<'de, D: Deserializer<'de>>(from: D) -> Result<Strategy, D::Error> {
    String::deserialize(from)?.parse().map_err(D::Error::custom)
}

/// By their names on the command line.
fn remedies<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Remedy>, D::Error> {
    let names = Vec::<String>::deserialize(from)?;
    names.iter().map(|name| name.parse().map_err(D::Error::custom)).collect()
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

/// A number within bounds.
fn within(what: &str, value: f64, least: f64, most: f64) -> Result<f64, String> {
    let is_possible = (least..=most).contains(&value);
    if is_possible { Ok(value) } else { Err(format!("{what} can be {least} to {most}, not {value}")) }
}

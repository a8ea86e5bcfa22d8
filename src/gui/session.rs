//! One run after the other, as the window sees them: the only place in `gui` with threads, channels and clocks.

use std::path::PathBuf;
use std::sync::Arc;
use std::thread;

use crossbeam_channel::{Receiver, Sender, unbounded};

use super::{Launch, demonstration};
use crate::balance::NodeId;
use crate::driver::{Run, Update};
use crate::palette::{Rgb, node_colour};
use crate::picture::{Frame, write_png};
use crate::runlog::{Header, RunLog, metrics};
use crate::time::Time;
use crate::tracer::Tracer;
use crate::view::{Canvas, Narrator, Outcome, RunState};

/// What the window shows: a run, and everything that is known of it.
pub struct Session {
    tracer: Arc<Tracer>,
    log_path: Option<PathBuf>,
    colours: Vec<Rgb>,
    /// As the user wants them; the records follow when the run goes on.
    speeds: Vec<f64>,
    run: Run,
    phase: Phase,
    paused: bool,
    log: RunLog,
    state: RunState,
    narrator: Narrator,
    frame: Frame,
    canvas: Canvas,
    outcome: Option<Outcome>,
    jobs: (Sender<Done>, Receiver<Done>),
}

/// How far a run is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Phase {
    /// It goes on, or could.
    Running,
    /// The picture is complete.
    Finished,
    /// It cannot go on; a sentence says why.
    Failed(String),
}

/// What a job in the background has come to.
pub enum Done {
    /// A picture is saved: a sentence says where, or why not.
    Saved(Result<String, String>),
    /// The user has chosen where to save; `None` if not.
    Chosen(Option<PathBuf>),
}

impl Session {
    /// Starts the first run: [`demonstration()`].
    pub fn start(launch: &Launch, ground: Rgb) -> Self {
        let (tracer, header) = demonstration(&launch.scene);
        Self::begin(tracer, header, launch.log.clone(), ground)
    }

    /// Ends the run and starts it anew with the speeds as they are now.
    pub fn restart(&mut self) {
        self.keep_log();
        let mut header = self.log.header.clone();
        header.speeds.clone_from(&self.speeds);
        let fresh = Self::begin(Arc::clone(&self.tracer), header, self.log_path.clone(), self.canvas.ground());
        let jobs = std::mem::replace(self, fresh).jobs;
        // What still goes on in the background may finish.
        self.jobs = jobs;
    }

    /// Takes in what has happened since the last call; returns what jobs in the background have come to.
    pub fn tick(&mut self) -> Vec<Done> {
        let division = self.log.header.division;
        while let Ok(update) = self.run.updates().try_recv() {
            match update {
                Update::Records(records) => {
                    for record in &records {
                        self.state.apply(record);
                        self.narrator.apply(record, &self.state);
                    }
                    self.log.add(records);
                }
                Update::Placed { atoms, pixels } => {
                    for (range, (place, colours)) in atoms.iter().zip(division.placed(&atoms, &pixels)) {
                        self.frame.place(place, colours);
                        self.canvas.place(range.clone(), colours);
                        self.canvas.paint(range.clone(), &self.state);
                    }
                }
                Update::Rays(_) => {}
                Update::Finished => {
                    self.phase = Phase::Finished;
                    self.outcome = outcome(&self.log);
                    self.keep_log();
                }
                Update::Failed(why) => self.phase = Phase::Failed(why),
            }
        }
        for atoms in self.state.take_touched() {
            self.canvas.paint(atoms, &self.state);
        }
        self.jobs.1.try_iter().collect()
    }

    /// Writes the run's records to where the user asked for them, if so. A failure is told on standard error: a
    /// window that closes has no other place for it.
    pub fn keep_log(&self) {
        if let Some(path) = &self.log_path
            && let Err(error) = self.log.save(path)
        {
            eprintln!("anel: {error}");
        }
    }

    /// The run's clock.
    pub fn now(&self) -> Time {
        self.run.now()
    }

    /// How long the run has lasted: its clock, until the picture is complete.
    pub fn lasted(&self) -> Time {
        self.state.finished().unwrap_or_else(|| self.now())
    }

    /// Changes a node's speed (0 to 1) at once; while the run stands still, as soon as it goes on.
    pub fn set_speed(&mut self, node: NodeId, speed: f64) {
        self.speeds[usize::from(node)] = speed;
        self.run.set_speed(node, speed);
    }

    /// The speed that a node has or is about to have.
    pub fn speed(&self, node: NodeId) -> f64 {
        self.speeds[usize::from(node)]
    }

    /// Lets the run go on or stand still.
    pub fn toggle_pause(&mut self) {
        if self.phase != Phase::Running {
            return;
        }
        self.paused = !self.paused;
        if self.paused { self.run.pause() } else { self.run.resume() }
    }

    /// Writes the render, as far as it is, to `path` in the background.
    pub fn save(&self, path: PathBuf, ctx: &egui::Context) {
        let (frame, done) = (self.frame.clone(), self.jobs.0.clone());
        let ctx = ctx.clone();
        let job = move || {
            let shown = std::path::absolute(&path).unwrap_or_else(|_| path.clone());
            let saved = write_png(&path, frame.size(), &frame.to_srgb8());
            let said = saved.map(|()| format!("Saved to {}", shown.display())).map_err(|error| error.to_string());
            // The window may have closed meanwhile.
            let _ = done.send(Done::Saved(said));
            ctx.request_repaint();
        };
        self.in_background("save", job);
    }

    /// Asks with the system's own dialog where to save. Without such a dialog the answer is the same as cancelling.
    pub fn choose(&self, path: PathBuf, ctx: &egui::Context) {
        let (done, ctx) = (self.jobs.0.clone(), ctx.clone());
        let job = move || {
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            let mut dialog = rfd::FileDialog::new().set_file_name(name).add_filter("PNG", &["png"]);
            if let Some(directory) = path.parent().filter(|directory| directory.is_dir()) {
                dialog = dialog.set_directory(directory);
            }
            let _ = done.send(Done::Chosen(dialog.save_file()));
            ctx.request_repaint();
        };
        self.in_background("file dialog", job);
    }

    /// What the run was asked to do.
    pub fn header(&self) -> &Header {
        &self.log.header
    }

    /// The nodes' colours.
    pub fn colours(&self) -> &[Rgb] {
        &self.colours
    }

    /// What is known of the run.
    pub fn state(&self) -> &RunState {
        &self.state
    }

    /// The run's records so far.
    pub fn log(&self) -> &RunLog {
        &self.log
    }

    /// The sentences.
    pub fn narrator(&self) -> &Narrator {
        &self.narrator
    }

    /// The picture as it is shown, after what it is to look like.
    pub fn canvas(&mut self, blend: f32, ground: Rgb) -> &mut Canvas {
        self.canvas.set_look(blend, ground, &self.state);
        &mut self.canvas
    }

    /// How far the run is.
    pub fn phase(&self) -> &Phase {
        &self.phase
    }

    /// Whether the run's clock stands still because it was asked to.
    pub fn is_paused(&self) -> bool {
        self.paused
    }

    /// What the finished run amounts to.
    pub fn outcome(&self) -> Option<Outcome> {
        self.outcome
    }

    fn begin(tracer: Arc<Tracer>, header: Header, log_path: Option<PathBuf>, ground: Rgb) -> Self {
        let nodes = header.speeds.len();
        let colours: Vec<_> = (0..nodes).map(|node| node_colour(node, nodes)).collect();
        Self {
            run: Run::start(Arc::clone(&tracer), &header),
            speeds: header.speeds.clone(),
            phase: Phase::Running,
            paused: false,
            state: RunState::new(&header),
            narrator: Narrator::default(),
            frame: Frame::new(header.size),
            canvas: Canvas::new(header.size, header.division, colours.clone(), ground),
            outcome: None,
            jobs: unbounded(),
            tracer,
            log: RunLog::new(header),
            log_path,
            colours,
        }
    }

    fn in_background(&self, name: &str, job: impl FnOnce() + Send + 'static) {
        if let Err(error) = thread::Builder::new().name(name.into()).spawn(job) {
            let _ = self.jobs.0.send(Done::Saved(Err(format!("no thread could be started: {error}"))));
        }
    }
}

/// What the run amounts to, if it came to its end.
fn outcome(log: &RunLog) -> Option<Outcome> {
    let makespan = metrics::makespan(log.records())?;
    let ideal = metrics::ideal(&log.header, log.records())?;
    let efficiency = metrics::efficiency(&log.header, log.records())?;
    Some(Outcome { makespan, ideal, efficiency, spread: metrics::finish_spread(log.records()) })
}

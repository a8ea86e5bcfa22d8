//! What is done in the background, so that nothing ever blocks the window. Each job is a thread of its own, with a name,
//! and ends by itself.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, bounded, unbounded};

use super::super::opening::Opening;
use super::super::settings::Settings;
use super::comparing::Compared;
use super::measuring::Finding;
use super::moving::Moved;
use super::teaching::Taught;
use crate::driver::{RAY, probe};
use crate::language::{Language, say, word};
use crate::lesson::Lesson;
use crate::output::OutputError;
use crate::palette::Rgb;
use crate::picture::{Frame, Quality, Size, srgb8, write_png};
use crate::runlog::{Driver, RunLog};
use crate::scene::{Opened, Scene};
use crate::tracer::{Scratch, Tracer};
use crate::view::{Inspected, Known};

/// What a job has come to.
pub enum Done {
    /// The job of this number has read and compiled what was asked for, or says why not.
    Ready(u64, Result<Ready, String>),
    /// A file is written: a sentence says where, or why not.
    Saved(Result<String, String>),
    /// What the job of this number makes is done to this part, 0 to 1.
    Progress(u64, f64),
    /// What the job of this number makes is made: a sentence says where, or why not.
    Made(u64, Result<String, String>),
    /// The user has chosen a file in the system's dialog; `None` if not.
    Chosen(Purpose, Option<PathBuf>),
    /// A small picture of a scene, by the scene's name or path; or why there is none.
    Thumbnail(String, Result<Thumbnail, String>),
    /// The job of this number has found out something about speed and accuracy.
    Found(u64, Finding),
    /// What has come of a comparison, and the number of its job.
    Compared(u64, Compared),
    /// A lesson that was opened, to be prepared.
    ToTeach(Arc<Lesson>),
    /// A lesson, or a sentence that says why it cannot be shown, and the number of its job.
    Lesson(u64, Result<Taught, String>),
    /// A pixel, with all that is known of it; nothing if there is no such pixel.
    Inspected(Option<Box<Inspected>>),
    /// What is about seen by a camera that was moved.
    Moved(Moved),
    /// The file that is open has changed, or is gone.
    FileChanged(PathBuf, FileChange),
}

/// What a path is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// To be opened.
    Open,
    /// A lesson, to be taken.
    Learn,
    /// To be written.
    Save,
}

/// What happened to a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileChange {
    /// Somebody has written to it.
    Written,
    /// It is not there any more.
    Gone,
}

/// What can be shown at once.
pub enum Ready {
    /// A scene, compiled.
    Scene(Prepared),
    /// A recorded run, and what traces its picture again.
    Run(Recorded),
    /// A lesson, to be prepared.
    Lesson(Arc<Lesson>),
}

/// A scene, compiled for a picture.
#[derive(Clone)]
pub struct Prepared {
    /// The scene.
    pub opened: Arc<Opened>,
    /// What traces it.
    pub tracer: Arc<Tracer>,
    /// What its picture will about look like.
    pub preview: Arc<[Rgb]>,
    /// Of the picture that it is compiled for.
    pub size: Size,
    /// Of the picture that it is compiled for.
    pub quality: Quality,
    /// The estimated CPU time of the whole picture, traced by threads that rest after each atom.
    cpu: Duration,
    /// The estimated time of the whole picture in virtual time.
    virtual_time: Duration,
}

/// A recorded run.
#[derive(Clone)]
pub struct Recorded {
    /// Its records.
    pub log: Arc<RunLog>,
    /// Its scene.
    pub opened: Arc<Opened>,
    /// What traces its picture again.
    pub tracer: Arc<Tracer>,
    /// What its picture will about look like.
    pub preview: Arc<[Rgb]>,
    /// What is known of all of it.
    pub known: Arc<Known>,
}

impl Prepared {
    /// Whether it is compiled for the picture that is set.
    pub fn is_for(&self, settings: &Settings) -> bool {
        (self.size, self.quality) == (settings.size, settings.quality)
    }

    /// The estimated time of the whole picture on the reference machine at full pace.
    pub fn work(&self, driver: Driver) -> Duration {
        if driver == Driver::Sim { self.virtual_time } else { self.cpu }
    }
}

/// A small picture.
pub struct Thumbnail {
    /// Its size.
    pub size: Size,
    /// Its pixels, three bytes each.
    pub rgb: Vec<u8>,
}

/// Starts jobs and gets what they come to.
pub struct Jobs {
    ctx: egui::Context,
    sender: Sender<Done>,
    receiver: Receiver<Done>,
    next: u64,
    /// Dropping it ends the watch.
    watch: Option<Sender<()>>,
    /// Dropping it ends the measurement.
    pub(super) measuring: Option<Sender<()>>,
}

impl Jobs {
    /// No job yet; `ctx` is woken by those that end.
    pub fn new(ctx: egui::Context) -> Self {
        let (sender, receiver) = unbounded();
        Self { ctx, sender, receiver, next: 0, watch: None, measuring: None }
    }

    /// What jobs have come to since.
    pub fn done(&self) -> Vec<Done> {
        self.receiver.try_iter().collect()
    }

    /// Reads and compiles what `read` gives; returns the job's number.
    pub fn prepare(
        &mut self,
        read: impl FnOnce() -> Result<Opening, String> + Send + 'static,
        settings: &Settings,
    ) -> u64 {
        let number = self.number();
        let (size, quality, division) = (settings.size, settings.quality, settings.division());
        let language = Language::spoken();
        self.start("prepare", move || {
            language.speak();
            let ready = read().and_then(|opening| match opening {
                Opening::Scene(opened) => {
                    let tracer = Arc::new(with_preview(Tracer::new(&opened.scene, size, quality), FINEST, PREVIEW));
                    let found = probe(&tracer, division, PROBE);
                    let cpu = found.whole_with_rests(&tracer, division);
                    let virtual_time = RAY.mul_f64(found.rays as f64);
                    let preview = guess(&tracer);
                    Ok(Ready::Scene(Prepared { opened, tracer, preview, size, quality, cpu, virtual_time }))
                }
                Opening::Run(log) => {
                    check_size(log.header.size)?;
                    let opened = Opened::from_text(&log.header.scene, &log.header.scene_text);
                    let unread = |error| {
                        say!(
                            "The run's own scene cannot be read: {error}",
                            "A cena da própria execução não pode ser lida: {error}"
                        )
                    };
                    let opened = opened.map_err(unread)?;
                    let tracer = Tracer::new(&opened.scene, log.header.size, log.header.quality);
                    let tracer = Arc::new(with_preview(tracer, FINEST, PREVIEW));
                    let known = Arc::new(Known::of(&log));
                    let preview = guess(&tracer);
                    Ok(Ready::Run(Recorded { log, opened: Arc::new(opened), tracer, preview, known }))
                }
                Opening::Lesson(lesson) => Ok(Ready::Lesson(lesson)),
            });
            Done::Ready(number, ready)
        });
        number
    }

    /// Writes a picture of these pixels.
    pub fn save_picture(&self, path: PathBuf, size: Size, pixels: impl FnOnce() -> Vec<u8> + Send + 'static) {
        let language = Language::spoken();
        self.start("save", move || Done::Saved(told(&path, write_png(&path, size, &pixels()), language)));
    }

    /// Writes a run file.
    pub fn save_run(&self, path: PathBuf, log: RunLog) {
        let language = Language::spoken();
        self.start("save", move || Done::Saved(told(&path, log.save(&path), language)));
    }

    /// Asks with the system's own dialog. Without such a dialog the answer is the same as cancelling.
    pub fn choose(&self, purpose: Purpose, at: PathBuf) {
        let [scenes, lessons, all] =
            word!(["Scenes and runs", "Lessons", "All"], ["Cenas e execuções", "Lições", "Todos"]);
        self.start("file dialog", move || {
            let mut dialog = rfd::FileDialog::new();
            if let Some(directory) = at.parent().filter(|directory| directory.is_dir()) {
                dialog = dialog.set_directory(directory);
            }
            let name = at.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            let chosen = match purpose {
                Purpose::Open => dialog.add_filter(scenes, &["ron", "anel"]).add_filter(all, &["*"]).pick_file(),
                Purpose::Learn => dialog.add_filter(lessons, &["ron"]).add_filter(all, &["*"]).pick_file(),
                Purpose::Save => dialog.set_file_name(name).save_file(),
            };
            Done::Chosen(purpose, chosen)
        });
    }

    /// Makes small pictures of these scenes, one after the other.
    pub fn thumbnails(&self, scenes: Vec<String>) {
        self.start_many(
            "thumbnails",
            |why| Done::Saved(Err(why)),
            move |tell| {
                for scene in scenes {
                    let made =
                        Opened::new(&scene).map(|opened| thumbnail(&opened.scene)).map_err(|error| error.to_string());
                    tell(Done::Thumbnail(scene, made));
                }
            },
        );
    }

    /// Traces a pixel once more, to be looked at.
    pub fn inspect(&self, look: impl FnOnce() -> Option<Inspected> + Send + 'static) {
        self.start("inspect", move || Done::Inspected(look().map(Box::new)));
    }

    /// Watches this file instead of the one before.
    pub fn watch(&mut self, path: Option<PathBuf>) {
        self.watch = None;
        let Some(path) = path else { return };
        let (stop, stopped) = bounded(0);
        self.watch = Some(stop);
        self.start_many(
            "watch",
            |why| Done::Saved(Err(why)),
            move |tell| {
                let mut known = stamp(&path);
                while stopped.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
                    let now = stamp(&path);
                    if now != known {
                        known = now;
                        let change = if now.is_some() { FileChange::Written } else { FileChange::Gone };
                        tell(Done::FileChanged(path.clone(), change));
                    }
                }
            },
        );
    }

    /// A number that no job had before.
    pub(super) fn number(&mut self) -> u64 {
        self.next += 1;
        self.next
    }

    pub(super) fn start(&self, name: &str, job: impl FnOnce() -> Done + Send + 'static) {
        self.start_many(name, |why| Done::Saved(Err(why)), move |tell| tell(job()));
    }

    /// Starts a thread for a job that tells several things, or tells what it `failed` with.
    pub(super) fn start_many(
        &self,
        name: &str,
        failed: impl FnOnce(String) -> Done,
        job: impl FnOnce(&(dyn Fn(Done) + Sync)) + Send + 'static,
    ) {
        let (sender, ctx) = (self.sender.clone(), self.ctx.clone());
        let tell = move |done| {
            // The window may have closed meanwhile.
            let _ = sender.send(done);
            ctx.request_repaint();
        };
        if let Err(error) = thread::Builder::new().name(name.into()).spawn(move || job(&tell)) {
            let why = say!("No thread could be started: {error}", "Nenhuma thread pôde ser iniciada: {error}");
            let _ = self.sender.send(failed(why));
        }
    }
}

/// How much of a picture is traced to know what the whole will cost.
const PROBE: Duration = Duration::from_millis(120);

/// How often a file that is watched is looked at.
const LOOK: Duration = Duration::from_millis(700);

/// With a preview that is begun, and made finer until it has every `finest`th pixel or takes longer than `limit`.
#[expect(clippy::disallowed_methods, reason = "how long a user waits is no matter of the run's clock")]
pub(super) fn with_preview(mut tracer: Tracer, finest: u32, limit: Duration) -> Tracer {
    let begun = Instant::now();
    loop {
        tracer.refine();
        let is_fine = tracer.preview().is_none_or(|preview| preview.step() <= finest);
        // The next step takes three times as long as all before it.
        if is_fine || 4 * begun.elapsed() > limit {
            return tracer;
        }
    }
}

/// All pixels as the preview has them.
pub(super) fn guess(tracer: &Tracer) -> Arc<[Rgb]> {
    let (width, height) = (tracer.size().width(), tracer.size().height());
    let Some(preview) = tracer.preview() else { return Arc::default() };
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    places.map(|(x, y)| srgb8(preview.guess(x, y))).collect()
}

/// How long a preview may take, so that it does not keep its user waiting.
const PREVIEW: Duration = Duration::from_millis(200);

/// Where most of the picture is known beforehand, there is little for the nodes to do.
const FINEST: u32 = 4;

/// Whether a window can hold a recorded picture.
fn check_size(size: Size) -> Result<(), String> {
    let most = Settings::LONGEST_SIDE * Settings::LONGEST_SIDE;
    if size.pixels() <= most {
        return Ok(());
    }
    Err(say!(
        "This run's picture of {size} pixels is too large for the window, which shows up to {most} pixels",
        "A imagem desta execução, de {size} pixels, é grande demais para a janela, que mostra até {most} pixels"
    ))
}

/// What a file looked like; `None` if there is none.
fn stamp(path: &Path) -> Option<(Option<SystemTime>, u64)> {
    fs::metadata(path).ok().map(|data| (data.modified().ok(), data.len()))
}

/// How saving went, in a sentence of this language. What is in files is English, so that only now the thread speaks it.
pub(super) fn told(path: &Path, saved: Result<(), OutputError>, language: Language) -> Result<String, String> {
    language.speak();
    let shown = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let shown = shown.display();
    saved.map(|()| say!("Saved to {shown}", "Salvo em {shown}")).map_err(|error| error.to_string())
}

fn thumbnail(scene: &Scene) -> Thumbnail {
    // Neither side is 0, and there are few pixels.
    let size = Size::new(400, 300).expect("a possible size");
    let tracer = Tracer::new(scene, size, Quality { samples: 2, ..Quality::default() });
    let mut pixels = Vec::new();
    tracer.trace(0..size.pixels(), &mut Scratch::default(), &mut pixels);
    Thumbnail { size, rgb: Frame::of(size, &pixels).to_srgb8() }
}

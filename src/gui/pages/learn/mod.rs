//! Lessons: a list to choose from, and the one that is being taken.

mod course;
mod panel;

use std::path::PathBuf;
use std::sync::Arc;

use egui::{Align, Layout, ProgressBar, RichText, Role, ScrollArea, Sense, Ui, WidgetInfo, pos2, vec2};

use crate::balance::Strategy;
use crate::gui::input::keys::UserCommand;
use crate::gui::panels::save_bar::resolve;
use crate::gui::session::{PreparedLesson, PreparingLesson, Purpose, Recorded, Session};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, path_field};
use crate::language::{Language, word};
use crate::lesson::{BUILT_IN, Lesson};
use crate::time::Time;
use crate::view::Subject;
use course::LessonProgress;

/// The page of lessons, and the lesson that is being taken.
#[derive(Default)]
pub struct Learn {
    open: bool,
    /// The lessons that come with the program, once the list was opened.
    lessons: Vec<Arc<Lesson>>,
    path: String,
    trouble: Option<String>,
    preparing: Option<PreparingLesson>,
    course: Option<LessonProgress>,
    /// The recorded run that was on the stage before the lesson, if it was one.
    before: Option<Recorded>,
}

impl Learn {
    /// Opens the list, or closes it.
    pub fn toggle(&mut self) {
        (self.open, self.trouble) = (!self.open, None);
        if self.lessons.is_empty() {
            // Built-in lessons can be read, which a test holds.
            self.lessons =
                BUILT_IN.iter().filter_map(|(name, text)| Lesson::parse(name, text).ok().map(Arc::new)).collect();
        }
    }

    /// Takes a lesson that was opened, as soon as it is prepared.
    pub fn open(&mut self, lesson: Arc<Lesson>, session: &mut Session) {
        if !self.open {
            self.toggle();
        }
        self.prepare(lesson, session);
    }

    /// Whether the list is to be shown.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Closes the list.
    pub fn close(&mut self) {
        self.open = false;
    }

    /// Whether a lesson is being taken.
    pub fn is_on(&self) -> bool {
        self.course.is_some()
    }

    /// How high the step of the lesson is in this width, if one is being taken.
    pub fn height(&self, ui: &Ui, width: f32, language: Language) -> Option<f32> {
        self.course.as_ref().map(|course| panel::height(ui, width, course, language))
    }

    /// Whether the step of the lesson wants the timeline.
    pub fn wants_timeline(&self) -> Option<bool> {
        self.course.as_ref().map(LessonProgress::wants_timeline)
    }

    /// The lesson's name and the step's number, for tests.
    pub fn step(&self) -> Option<(&str, usize)> {
        self.course.as_ref().map(|course| (course.name(), course.step()))
    }

    /// Leaves the lesson, if one is being taken: what was on the stage before begins again.
    pub fn leave(&mut self, session: &mut Session) {
        if let Some(course) = self.course.take() {
            session.end_lesson(course.taught(), self.before.take());
        }
    }

    /// Reads a lesson's file and prepares it.
    fn start(&mut self, argument: &str, session: &mut Session) {
        match Lesson::open(argument) {
            Ok(lesson) => self.prepare(Arc::new(lesson), session),
            Err(error) => self.trouble = Some(error.to_string()),
        }
    }

    /// Takes in what was chosen in the system's dialog.
    pub fn take_chosen(&mut self, chosen: Option<PathBuf>, session: &mut Session) {
        let language = session.language();
        match chosen {
            Some(path) => {
                self.path = path.display().to_string();
                self.start(&path.to_string_lossy(), session);
            }
            None => {
                self.trouble = Some(
                    word!(
                        language,
                        "No dialog of the system answered, or nothing was chosen in it: the path can still be typed",
                        "Nenhum diálogo do sistema respondeu, ou nada foi escolhido nele: o caminho pode ser digitado"
                    )
                    .into(),
                )
            }
        }
    }

    fn prepare(&mut self, lesson: Arc<Lesson>, session: &mut Session) {
        (self.preparing, self.trouble) = (Some(session.prepare_lesson(lesson)), None);
    }

    /// Takes in a lesson that was prepared.
    pub fn take(&mut self, job: u64, taught: Result<PreparedLesson, String>, session: &mut Session) {
        if self.preparing.as_ref().is_none_or(|preparing| preparing.job != job) {
            return;
        }
        self.preparing = None;
        match taught {
            Ok(taught) => {
                if self.course.is_none() {
                    self.before = session.recorded();
                }
                self.course = Some(LessonProgress::begin(taught, session));
                self.open = false;
            }
            Err(why) => (self.open, self.trouble) = (true, Some(why)),
        }
    }

    /// Lets the lesson's time go on; returns what stands out from now on, if that is something else.
    pub fn tick(&mut self, session: &mut Session) -> Option<Option<Subject>> {
        self.course.as_mut()?.tick(session)
    }

    /// Does what a key asks for, if it is meant for the lesson.
    pub fn handle_command(&mut self, command: UserCommand, session: &mut Session) -> bool {
        let language = session.language();
        if self.open {
            let UserCommand::Select(number) = command else { return false };
            if let Some(lesson) = self.lessons.get(usize::from(number)) {
                self.prepare(Arc::clone(lesson), session);
            }
            return true;
        }
        let Some(course) = &mut self.course else { return false };
        match command {
            UserCommand::Dolly(true) => course.back(session),
            UserCommand::Dolly(false) if course.is_over() => self.other_lessons(session),
            UserCommand::Select(number) if course.waits() => course.answer(number.into(), session),
            // One is asked before one sees.
            UserCommand::Dolly(false) | UserCommand::Pause | UserCommand::Live | UserCommand::StepUnit(_, true)
                if course.waits() =>
            {
                session.note(word!(
                    language,
                    "First answer the question: press the number of an answer, or click it",
                    "Responder antes à pergunta: pressionar o número de uma resposta, ou clicar nela"
                ));
            }
            UserCommand::Dolly(false) => course.next(session),
            _ => return false,
        }
        true
    }

    /// The lesson is over: the list, and one's own run.
    fn other_lessons(&mut self, session: &mut Session) {
        self.leave(session);
        self.open = true;
    }

    /// Shows the step of the lesson that is being taken.
    pub fn show_step(&mut self, ui: &mut Ui, session: &mut Session) {
        let language = session.language();
        let Some(course) = &mut self.course else { return };
        match panel::show(ui, course, language) {
            Some(panel::LessonAction::Back) => course.back(session),
            Some(panel::LessonAction::Next) if course.is_over() => self.other_lessons(session),
            Some(panel::LessonAction::Next) => course.next(session),
            Some(panel::LessonAction::Answer(place)) => course.answer(place, session),
            Some(panel::LessonAction::Leave) => self.leave(session),
            None => {}
        }
    }

    /// Shows the list.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let language = session.language();
        let look = Look::of(ui.ctx());
        ui.horizontal(|ui| {
            ui.label(
                RichText::new(word!(language, "Learn", "Lições")).font(theme::strong(theme::LARGE)).color(look.text),
            );
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let close = word!(language, "Close the lessons", "Fechar as lições");
                if button(ui, Some(Icon::Close), close, false, Emphasis::Quiet).clicked() {
                    self.open = false;
                }
                if let Some(preparing) = &self.preparing {
                    let bar = ProgressBar::new(preparing.share()).desired_width(20.0 * GRID);
                    let bar = ui.add(bar.desired_height(0.75 * GRID).fill(look.accent));
                    let words =
                        word!(language, "The lesson's pictures are traced", "As imagens da lição são calculadas");
                    bar.widget_info(|| WidgetInfo::labeled(Role::ProgressIndicator, true, words));
                    ui.ctx().request_repaint_after(std::time::Duration::from_millis(100));
                }
            });
        });
        ui.add_space(GRID);
        ScrollArea::vertical().id_salt("lessons").auto_shrink(false).show(ui, |ui| {
            let article = self.lessons.iter().position(|lesson| adapts(lesson)).unwrap_or(self.lessons.len());
            let (first, second) = self.lessons.split_at(article);
            let rivals = word!(language, "The article's ring, and its rivals", "O anel do artigo, e seus rivais");
            let adaptive = word!(language, "The adaptive ring", "O anel adaptativo");
            let chosen = if ui.available_width() < 120.0 * GRID {
                let chosen = part(ui, rivals, (1, first), look, language);
                chosen.or(part(ui, adaptive, (1 + article, second), look, language))
            } else {
                ui.columns_const(|[left, right]| {
                    let chosen = part(left, rivals, (1, first), look, language);
                    chosen.or(part(right, adaptive, (1 + article, second), look, language))
                })
            };
            if let Some(lesson) = chosen {
                self.prepare(lesson, session);
            }
            ui.add_space(2.0 * GRID);
            self.other(ui, session, look);
        });
    }

    /// A lesson of one's own.
    fn other(&mut self, ui: &mut Ui, session: &mut Session, look: Look) {
        let language = session.language();
        let about = word!(language, "A lesson of your own, a text file:", "Uma lição sua, um arquivo de texto:");
        ui.label(RichText::new(about).font(theme::regular(theme::BODY)).color(look.quiet));
        ui.horizontal(|ui| {
            let hint = word!(language, "a lesson's file, such as mine.ron", "o arquivo de uma lição, como minha.ron");
            let name = word!(language, "Path of a lesson", "Caminho de uma lição");
            let typed = path_field(ui, (&mut self.path, hint), 40.0 * GRID, name, &mut false);
            let opens =
                button(ui, None, word!(language, "Open the lesson", "Abrir a lição"), true, Emphasis::Quiet).clicked();
            if (typed.entered || opens) && !self.path.trim().is_empty() {
                match resolve(&self.path, std::env::home_dir(), language) {
                    Ok(path) => self.start(&path.to_string_lossy(), session),
                    Err(why) => self.trouble = Some(why),
                }
            }
            if button(ui, None, word!(language, "Browse…", "Procurar…"), true, Emphasis::Quiet).clicked() {
                let directory = std::env::current_dir().unwrap_or_default();
                session.jobs().choose(Purpose::Learn, directory.join("lesson"), language);
            }
        });
        if let Some(why) = &self.trouble {
            ui.label(RichText::new(why).font(theme::regular(theme::BODY)).color(look.trouble));
        }
    }
}

/// Whether a lesson is about the ring that adapts.
fn adapts(lesson: &Lesson) -> bool {
    lesson.runs.values().any(|plan| plan.strategy == Strategy::Adaptive)
}

/// Some of the lessons, of which the first has this number; returns which was chosen.
fn part(
    ui: &mut Ui,
    heading: &str,
    (number, lessons): (usize, &[Arc<Lesson>]),
    look: Look,
    language: Language,
) -> Option<Arc<Lesson>> {
    ui.add_space(GRID);
    ui.label(RichText::new(heading).font(theme::strong(theme::BODY)).color(look.quiet));
    // All of them are in sight in a window of 1280 × 800.
    ui.spacing_mut().item_spacing.y = 2.0;
    let mut chosen = None;
    for (number, lesson) in (number..).zip(lessons) {
        if line(ui, number, lesson, look, language) {
            chosen = Some(Arc::clone(lesson));
        }
    }
    chosen
}

/// A lesson of the list; returns whether it was chosen.
fn line(ui: &mut Ui, number: usize, lesson: &Lesson, look: Look, language: Language) -> bool {
    let wide = ui.available_width() - GRID;
    let indent = 6.0 * GRID;
    let about = lesson.about.in_language(language).to_owned();
    let about = ui.painter().layout(about, theme::regular(theme::BODY), look.quiet, wide - indent - GRID);
    let (rect, response) = ui.allocate_exact_size(vec2(wide, 4.75 * GRID + about.size().y), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, lesson.title.in_language(language)));
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 6.0, look.raised);
    }
    let painter = ui.painter();
    let left = rect.left() + indent;
    let middle = pos2(rect.left() + 0.5 * indent, rect.center().y);
    painter.text(middle, egui::Align2::CENTER_CENTER, number, theme::strong(theme::LARGE), look.accent);
    let title = pos2(left, rect.top() + 2.25 * GRID);
    painter.text(title, egui::Align2::LEFT_CENTER, lesson.title.in_language(language), theme::strong(18.0), look.text);
    painter.galley(pos2(left, rect.top() + 3.75 * GRID), about, look.quiet);
    response.clicked()
}

/// So long a way through a run is shown in about so many seconds.
fn rate_for(way: Time) -> usize {
    const SECONDS: f64 = 7.0;
    let rates = crate::view::RATES;
    rates.iter().position(|&rate| rate * SECONDS >= way.secs()).unwrap_or(rates.len() - 2).min(rates.len() - 2)
}

//! Lessons: the list, and the open lesson.

mod answers;
mod course;
mod panel;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use egui::{Align, Layout, RichText, Role, ScrollArea, Sense, Ui, WidgetInfo, pos2, vec2};

use crate::balance::Strategy;
use crate::gui::input::keys::UserCommand;
use crate::gui::session::{PreparedLesson, PreparingLesson, Purpose, Recorded, Session, TracedShare};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::path_input::{TypedPath, no_file_chosen, open_field};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, progress};
use crate::language::{Language, word};
use crate::lesson::{BUILT_IN, Lesson};
use crate::time::Time;
use crate::view::Subject;
use course::LessonProgress;

/// The list of lessons and the open lesson.
#[derive(Default)]
pub struct Learn {
    open: bool,
    /// The built-in lessons; empty until the list is opened.
    lessons: Vec<Arc<Lesson>>,
    path: TypedPath,
    trouble: Option<String>,
    preparing: Option<PreparingLesson>,
    progress: Option<LessonProgress>,
    /// The recorded run that was on the stage before the lesson, if there was one.
    before: Option<Recorded>,
}

impl Learn {
    /// Opens or closes the list.
    pub fn toggle(&mut self) {
        if self.open {
            return self.close();
        }
        (self.open, self.trouble) = (true, None);
        if self.lessons.is_empty() {
            // A test ensures that all built-in lessons can be read.
            self.lessons =
                BUILT_IN.iter().filter_map(|(name, text)| Lesson::parse(name, text).ok().map(Arc::new)).collect();
        }
    }

    /// Opens a lesson: shows the list until the lesson is prepared.
    pub fn open(&mut self, lesson: Arc<Lesson>, session: &mut Session) {
        if !self.open {
            self.toggle();
        }
        self.prepare(lesson, session);
    }

    /// Whether the list is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Closes the list. A lesson that is being prepared is cancelled: it would open by itself.
    pub fn close(&mut self) {
        (self.open, self.preparing) = (false, None);
    }

    /// Whether a lesson is open.
    pub fn is_on(&self) -> bool {
        self.progress.is_some()
    }

    /// Returns the height of the lesson's panel at this width, if a lesson is open.
    pub fn height(&self, ui: &Ui, width: f32, language: Language) -> Option<f32> {
        self.progress.as_ref().map(|progress| panel::height(ui, width, progress, language))
    }

    /// Whether the step of the open lesson shows the timeline.
    pub fn wants_timeline(&self) -> Option<bool> {
        self.progress.as_ref().map(LessonProgress::wants_timeline)
    }

    /// Returns the name of the open lesson and the index of its step, for tests.
    pub fn step(&self) -> Option<(&str, usize)> {
        self.progress.as_ref().map(|progress| (progress.name(), progress.step()))
    }

    /// Leaves the lesson, if one is open; the run before it starts again.
    pub fn leave(&mut self, session: &mut Session) {
        if let Some(progress) = self.progress.take() {
            session.end_lesson(progress.lesson(), self.before.take());
        }
    }

    /// Reads the file of a lesson and prepares it.
    fn start(&mut self, argument: &Path, session: &mut Session) {
        match Lesson::open(argument) {
            Ok(lesson) => self.prepare(Arc::new(lesson), session),
            Err(error) => self.trouble = Some(error.to_string()),
        }
    }

    /// Takes the result of the file dialog.
    pub fn take_chosen(&mut self, chosen: Option<PathBuf>, session: &mut Session) {
        let language = session.language();
        match chosen {
            Some(path) => {
                self.path.set(path.clone());
                self.start(&path, session);
            }
            None => self.trouble = Some(no_file_chosen(language).into()),
        }
    }

    fn prepare(&mut self, lesson: Arc<Lesson>, session: &mut Session) {
        (self.preparing, self.trouble) = (Some(session.prepare_lesson(lesson)), None);
    }

    /// Takes a prepared lesson and begins it.
    pub fn take(&mut self, job: u64, prepared: Result<PreparedLesson, String>, session: &mut Session) {
        if self.preparing.as_ref().is_none_or(|preparing| preparing.job != job) {
            return;
        }
        self.preparing = None;
        match prepared {
            Ok(lesson) => {
                if self.progress.is_none() {
                    self.before = session.recorded();
                }
                self.progress = Some(LessonProgress::begin(lesson, session));
                self.open = false;
            }
            Err(why) => (self.open, self.trouble) = (true, Some(why)),
        }
    }

    /// Advances the lesson. Returns the new selection, if it changes.
    pub fn tick(&mut self, session: &mut Session) -> Option<Option<Subject>> {
        self.progress.as_mut()?.tick(session)
    }

    /// Executes a command for the list or the lesson. Returns whether the command is one of these.
    pub fn handle_command(&mut self, command: UserCommand, session: &mut Session) -> bool {
        let language = session.language();
        if self.open {
            let UserCommand::Select(number) = command else { return false };
            if let Some(lesson) = self.lessons.get(usize::from(number)) {
                self.prepare(Arc::clone(lesson), session);
            }
            return true;
        }
        let Some(progress) = &mut self.progress else { return false };
        match command {
            UserCommand::Dolly(true) => progress.back(session),
            UserCommand::Dolly(false) if progress.is_over() => self.other_lessons(session),
            UserCommand::Select(number) if progress.waits() => progress.answer(number.into(), session),
            // What happens next stays hidden until the question is answered.
            _ if progress.waits() && tells_more(command, session) => {
                session.note(word!(
                    language,
                    "First answer the question: press the number of an answer or click it",
                    "Primeiro responda à pergunta: pressione o número de uma resposta ou clique nela"
                ));
            }
            UserCommand::Dolly(false) => progress.next(session),
            _ => return false,
        }
        true
    }

    /// Leaves the lesson and opens the list.
    fn other_lessons(&mut self, session: &mut Session) {
        self.leave(session);
        self.open = true;
    }

    /// Shows the panel of the open lesson.
    pub fn show_step(&mut self, ui: &mut Ui, session: &mut Session) {
        let language = session.language();
        let Some(progress) = &mut self.progress else { return };
        match panel::show(ui, progress, language) {
            Some(panel::LessonAction::Back) => progress.back(session),
            Some(panel::LessonAction::Next) if progress.is_over() => self.other_lessons(session),
            Some(panel::LessonAction::Next) => progress.next(session),
            Some(panel::LessonAction::Answer(index)) => progress.answer(index, session),
            Some(panel::LessonAction::Leave) => self.leave(session),
            None => {}
        }
    }

    /// Shows the list. Returns whether presentation mode is to be switched.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session, is_projector: bool) -> bool {
        let language = session.language();
        let look = Look::of(ui.ctx());
        let mut switches = false;
        ui.horizontal(|ui| {
            ui.label(
                RichText::new(word!(language, "Learn", "Lições")).font(theme::strong(theme::LARGE)).color(look.text),
            );
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let close = word!(language, "Close the lessons", "Fechar as lições");
                if button(ui, Some(Icon::Close), close, false, Emphasis::Quiet).clicked() {
                    self.close();
                }
                let emphasis = if is_projector { Emphasis::On } else { Emphasis::Quiet };
                let name = word!(language, "For a projector", "Para o projetor");
                let hint = word!(
                    language,
                    "Large text and strong colours, without controls (F11)",
                    "Texto grande e cores fortes, sem controles (F11)"
                );
                switches = button(ui, None, name, true, emphasis).on_hover_text(hint).clicked();
                self.progress(ui, session, look);
            });
        });
        ui.add_space(GRID);
        ScrollArea::vertical().id_salt("lessons").auto_shrink(false).show(ui, |ui| {
            let split = self.lessons.iter().position(|lesson| is_adaptive(lesson)).unwrap_or(self.lessons.len());
            let (first, second) = self.lessons.split_at(split);
            let article = word!(language, "The article's ring and its rivals", "O anel do artigo e seus rivais");
            let adaptive = word!(language, "The adaptive ring", "O anel adaptativo");
            let chosen = if ui.available_width() < 120.0 * GRID {
                let chosen = group(ui, article, (1, first), look, language);
                chosen.or(group(ui, adaptive, (1 + split, second), look, language))
            } else {
                ui.columns_const(|[left, right]| {
                    let chosen = group(left, article, (1, first), look, language);
                    chosen.or(group(right, adaptive, (1 + split, second), look, language))
                })
            };
            if let Some(lesson) = chosen {
                self.prepare(lesson, session);
            }
            ui.add_space(GRID);
            self.own_lesson(ui, session, look);
        });
        switches
    }

    /// Shows the progress of the lesson that is being prepared, and the button that cancels it.
    fn progress(&mut self, ui: &mut Ui, session: &Session, look: Look) {
        let language = session.language();
        let Some(preparing) = &self.preparing else { return };
        ui.ctx().request_repaint_after(Duration::from_millis(250));
        let TracedShare { share, elapsed_s } = session.traced_share(&preparing.progress);
        let is_cancelled = button(ui, None, word!(language, "Cancel", "Cancelar"), true, Emphasis::Quiet).clicked();
        let text = RichText::new(progress::words(share, elapsed_s, language));
        ui.label(text.font(theme::regular(theme::BODY)).color(look.quiet));
        let about = word!(language, "Tracing the pictures of the lesson", "Calculando as imagens da lição");
        progress::bar(ui, share, about);
        ui.label(RichText::new(about).font(theme::regular(theme::BODY)).color(look.quiet));
        if is_cancelled {
            self.preparing = None;
        }
    }

    /// Shows the path field for the user's own lessons.
    fn own_lesson(&mut self, ui: &mut Ui, session: &mut Session, look: Look) {
        let language = session.language();
        let about = word!(language, "Your own lesson (a text file):", "Sua própria lição (um arquivo de texto):");
        ui.label(RichText::new(about).font(theme::regular(theme::BODY)).color(look.quiet));
        ui.horizontal(|ui| {
            let hint = word!(language, "path of a lesson, for example mine.ron", "uma lição, por exemplo minha.ron");
            let name = word!(language, "Path of a lesson", "Caminho de uma lição");
            let field = open_field(ui, (self.path.text_mut(), hint), 40.0 * GRID, name, &mut false);
            let opens =
                button(ui, None, word!(language, "Open the lesson", "Abrir a lição"), true, Emphasis::Quiet).clicked();
            if (field.entered || opens) && !self.path.text().trim().is_empty() {
                match self.path.resolve(std::env::home_dir(), language) {
                    Ok(path) => self.start(&path, session),
                    Err(why) => self.trouble = Some(why),
                }
            }
            if button(ui, None, word!(language, "Browse…", "Procurar…"), true, Emphasis::Quiet).clicked() {
                let directory = std::env::current_dir().unwrap_or_default();
                session.jobs().choose_file(Purpose::Learn, directory.join("lesson"), language);
            }
        });
        if let Some(why) = &self.trouble {
            ui.label(RichText::new(why).font(theme::regular(theme::BODY)).color(look.trouble));
        }
    }
}

/// Whether the command shows more of the run than the shown moment, or another run.
fn tells_more(command: UserCommand, session: &Session) -> bool {
    match command {
        UserCommand::Dolly(false)
        | UserCommand::Pause
        | UserCommand::Live
        | UserCommand::Restart
        | UserCommand::Step(_, true) => true,
        UserCommand::Arrow([1, 0]) => session.inspected_pixel().is_none(),
        UserCommand::Jump(records, _) => records > session.stage().records_shown(),
        _ => false,
    }
}

/// Whether a run of the lesson uses the adaptive ring.
fn is_adaptive(lesson: &Lesson) -> bool {
    lesson.runs.values().any(|plan| plan.strategy == Strategy::Adaptive)
}

/// Shows a group of lessons, numbered from `number`. Returns the chosen one.
fn group(
    ui: &mut Ui,
    heading: &str,
    (number, lessons): (usize, &[Arc<Lesson>]),
    look: Look,
    language: Language,
) -> Option<Arc<Lesson>> {
    ui.add_space(GRID);
    ui.label(RichText::new(heading).font(theme::strong(theme::BODY)).color(look.quiet));
    // With this distance all lessons are visible in a window of 1280 × 800.
    ui.spacing_mut().item_spacing.y = 0.0;
    let mut chosen = None;
    for (number, lesson) in (number..).zip(lessons) {
        if entry(ui, number, lesson, look, language) {
            chosen = Some(Arc::clone(lesson));
        }
    }
    chosen
}

/// Shows a lesson of the list. Returns whether it is chosen.
fn entry(ui: &mut Ui, number: usize, lesson: &Lesson, look: Look, language: Language) -> bool {
    let wide = ui.available_width() - GRID;
    let indent = 6.0 * GRID;
    let about = lesson.about.in_language(language).to_owned();
    let about = ui.painter().layout(about, theme::regular(theme::BODY), look.quiet, wide - indent - GRID);
    let (rect, response) = ui.allocate_exact_size(vec2(wide, 4.0 * GRID + about.size().y), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, lesson.title.in_language(language)));
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 6.0, look.raised);
    }
    let painter = ui.painter();
    let left = rect.left() + indent;
    let middle = pos2(rect.left() + 0.5 * indent, rect.center().y);
    painter.text(middle, egui::Align2::CENTER_CENTER, number, theme::strong(theme::LARGE), look.accent);
    let title = pos2(left, rect.top() + 1.9 * GRID);
    painter.text(title, egui::Align2::LEFT_CENTER, lesson.title.in_language(language), theme::strong(18.0), look.text);
    painter.galley(pos2(left, rect.top() + 3.4 * GRID), about, look.quiet);
    response.clicked()
}

/// Returns the index of the playback rate that shows this span of a run in about seven seconds.
fn rate_for(span: Time) -> usize {
    const WALL_TIME_S: f64 = 7.0;
    let rates = crate::view::RATES;
    rates.iter().position(|&rate| rate * WALL_TIME_S >= span.secs()).unwrap_or(rates.len() - 2).min(rates.len() - 2)
}

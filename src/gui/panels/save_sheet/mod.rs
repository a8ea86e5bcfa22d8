//! The save sheet: the kind of file, a preview, its path, the error if it cannot be saved, and the queue of files.

mod facts;
mod film_options;
mod kinds;
mod preview;
mod queue;
mod retraced;

use std::path::PathBuf;

use egui::{Align, Label, Layout, Panel, RichText, ScrollArea, Ui};

use crate::export::{Comparison, Drawing};
use crate::gui::input::keys::UserCommand;
use crate::gui::session::{Export, ExportPreview, Phase, Purpose, Session};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::path_input::{TypedPath, no_file_chosen, path_field};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button};
use crate::language::{Language, say, word};
use crate::output::{check_writable, is_same_file};
use crate::view::Layer;
pub use film_options::FilmOptions;
use kinds::{KindGroup, SaveKind};
use preview::Preview;
use retraced::RetracedPicture;

/// Subject of the save sheet.
pub enum SaveSubject {
    /// The run on the stage, and the shown layer with its share (0 to 1).
    Run((Layer, f32)),
    /// The compared runs; `None` until the first one is run.
    Comparison(Option<Comparison>),
}

/// The save sheet, at the right.
#[derive(Default)]
pub struct SaveSheet {
    open: bool,
    wants_focus: bool,
    /// Whether the path field has the focus.
    focused: bool,
    kind: SaveKind,
    path: TypedPath,
    /// The path that the sheet suggested last. The sheet updates the path until the user changes it.
    suggested: TypedPath,
    /// The existing file that a second press of Save replaces.
    warned: Option<PathBuf>,
    /// The error of the last attempt.
    trouble: Option<String>,
    /// A picture that is traced again.
    retraced: RetracedPicture,
    /// Length and width of an animation.
    film: FilmOptions,
    /// Title of a saved run.
    title: String,
    /// Memo of a saved run.
    memo: String,
    preview: Preview,
}

/// Least height of the preview, in points.
const MIN_PREVIEW_HEIGHT_PT: f32 = 12.0 * GRID;

/// Returns the width of the sheet in a window of this width, in points.
pub fn width(window: f32) -> f32 {
    (0.33 * window).clamp(48.0 * GRID, 58.0 * GRID)
}

impl SaveSheet {
    /// Creates the sheet, closed, with the options of an animation as they were stored.
    pub fn new(film: FilmOptions) -> Self {
        Self { film: film.in_range(), ..Self::default() }
    }

    /// Returns the options of an animation, to be stored.
    pub fn film(&self) -> FilmOptions {
        self.film
    }

    /// Opens or closes the sheet.
    pub fn toggle(&mut self, session: &Session) {
        if self.open { self.close() } else { self.open_for(self.kind, session) }
    }

    /// Opens the sheet for the run.
    pub fn open_for_run(&mut self, session: &Session) {
        self.open_for(SaveKind::Run, session);
    }

    /// Opens the sheet for a kind, with a suggested path; what is chosen for a picture that is traced again and for an
    /// animation stays.
    fn open_for(&mut self, kind: SaveKind, session: &Session) {
        let (retraced, film) = (self.retraced.clone(), self.film);
        let caption = &session.header().caption;
        let (title, memo) = (caption.title.clone(), caption.memo.clone());
        *self = Self { open: true, wants_focus: true, kind, retraced, film, title, memo, ..Self::default() };
        self.suggest(session);
    }

    /// Closes the sheet. Files that are being written go on.
    pub fn close(&mut self) {
        self.open = false;
        self.preview = Preview::default();
    }

    /// Whether the sheet is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Takes the result of the file dialog.
    pub fn take_chosen(&mut self, chosen: Option<PathBuf>, language: Language) {
        self.wants_focus = true;
        self.trouble = None;
        match chosen {
            Some(path) => self.path.set(path),
            None => self.trouble = Some(no_file_chosen(language).into()),
        }
    }

    /// Takes the preview of a file.
    pub fn take_preview(&mut self, ctx: &egui::Context, job: u64, made: Result<Option<ExportPreview>, String>) {
        self.preview.take(ctx, job, made);
    }

    /// Shows the sheet. Returns the command of a button that the sheet does not handle itself.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session, subject: &SaveSubject) -> Option<UserCommand> {
        let language = session.language();
        let kinds = match subject {
            SaveSubject::Run(_) => &SaveKind::OF_RUN[..],
            SaveSubject::Comparison(_) => &SaveKind::OF_COMPARISON[..],
        };
        if !kinds.iter().any(|(_, group)| group.contains(&self.kind)) {
            self.choose(kinds[0].1[0]);
        }
        self.heading(ui, language);
        self.kinds(ui, kinds, language);
        ui.add_space(GRID / 2.0);
        self.suggest(session);
        let foot = Panel::bottom("save foot").frame(egui::Frame::NONE).resizable(false).show_separator_line(false);
        let command = foot.show(ui, |ui| self.foot(ui, session, subject)).inner;
        ScrollArea::vertical().id_salt("save").auto_shrink(false).show(ui, |ui| self.content(ui, session, subject));
        if self.suggestion(session).text() != self.suggested.text() {
            // The path follows what was typed in the fields.
            ui.ctx().request_repaint();
        }
        command
    }

    fn heading(&mut self, ui: &mut Ui, language: Language) {
        let look = Look::of(ui.ctx());
        ui.horizontal(|ui| {
            let title =
                RichText::new(word!(language, "Save a file", "Salvar um arquivo")).font(theme::strong(theme::LARGE));
            ui.label(title.color(look.text));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let close = word!(language, "Close save", "Fechar salvar");
                let hint = word!(language, "Close (Esc)", "Fechar (Esc)");
                if button(ui, Some(Icon::Close), close, false, Emphasis::Quiet).on_hover_text(hint).clicked() {
                    self.close();
                }
            });
        });
    }

    /// Shows a button for each kind, group by group below its heading.
    fn kinds(&mut self, ui: &mut Ui, groups: &[KindGroup], language: Language) {
        ui.spacing_mut().item_spacing.y = GRID / 2.0;
        let look = Look::of(ui.ctx());
        for ((english, portuguese), group) in groups {
            let heading = RichText::new(word!(language, *english, *portuguese));
            ui.label(heading.font(theme::regular(theme::SMALL)).color(look.quiet));
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing = egui::vec2(GRID / 2.0, GRID / 2.0);
                for &kind in *group {
                    let emphasis = if kind == self.kind { Emphasis::On } else { Emphasis::Quiet };
                    let shown = button(ui, None, kind.name(language), true, emphasis);
                    if shown.on_hover_text(kind.hint(language)).clicked() {
                        self.choose(kind);
                    }
                }
            });
        }
    }

    /// Chooses a kind; a typed path gets its extension.
    fn choose(&mut self, kind: SaveKind) {
        (self.warned, self.trouble, self.wants_focus) = (None, None, true);
        if self.path.text() != self.suggested.text() && !self.path.text().trim().is_empty() {
            self.path.set_extension(kind.ending());
        }
        self.kind = kind;
    }

    /// Shows the preview, what is known of the file, and its options.
    fn content(&mut self, ui: &mut Ui, session: &mut Session, subject: &SaveSubject) {
        let language = session.language();
        let look = Look::of(ui.ctx());
        // Room for the scroll bar.
        ui.set_width(ui.available_width() - GRID / 2.0);
        let export = self.export(session, subject);
        let hint = self.kind.hint(language);
        let room = ui.available_height() - self.options_height() - 3.0 * GRID;
        let height = room.clamp(MIN_PREVIEW_HEIGHT_PT, (0.8 * ui.available_width()).max(MIN_PREVIEW_HEIGHT_PT));
        self.preview.show(ui, export.as_ref().map_err(|why| &**why), hint, height, session);
        let facts = export.map(|export| facts::of(&export, &self.path, self.preview.whole(), session));
        let facts = RichText::new(facts.unwrap_or_default()).font(theme::regular(theme::SMALL)).color(look.quiet);
        ui.add(Label::new(facts).wrap());
        match self.kind {
            SaveKind::Large => self.retraced.show(ui, session),
            SaveKind::Film => self.film.show(ui, language),
            SaveKind::Run => self.describe(ui, language),
            _ => {}
        }
    }

    /// Returns the height of the options below the preview, in points.
    fn options_height(&self) -> f32 {
        match self.kind {
            SaveKind::Large => 17.0 * GRID,
            SaveKind::Run => 9.0 * GRID,
            SaveKind::Film => 4.5 * GRID,
            _ => 0.0,
        }
    }

    /// Shows the fields for title and memo of a run.
    fn describe(&mut self, ui: &mut Ui, language: Language) {
        let width = ui.available_width() - 2.0 * GRID;
        let name = word!(language, "Title of the run", "Título da execução");
        path_field(ui, (&mut self.title, name), width, name, &mut false);
        let name = word!(language, "Memo", "Anotação");
        path_field(ui, (&mut self.memo, name), width, name, &mut false);
    }

    /// Shows the queue, the error, the path, and the buttons.
    fn foot(&mut self, ui: &mut Ui, session: &mut Session, subject: &SaveSubject) -> Option<UserCommand> {
        let language = session.language();
        let look = Look::of(ui.ctx());
        ui.spacing_mut().item_spacing.y = GRID / 2.0;
        ui.add_space(GRID / 2.0);
        let shown = self.trouble.clone();
        // What appears and disappears stands above the buttons, which stay where they are. In a scope of its own it
        // does not change the identity of the path field, which would lose the focus.
        ui.scope(|ui| {
            queue::show(ui, session);
            if let Some(trouble) = &self.trouble {
                let text = RichText::new(trouble).font(theme::regular(theme::BODY)).color(look.trouble);
                ui.add(Label::new(text).wrap());
            }
        });
        let name = word!(language, "Path of the file", "Caminho do arquivo");
        let width = ui.available_width() - 2.0 * GRID;
        // In the frame in which its size is measured, nothing can have the focus.
        let mut wants_focus = std::mem::take(&mut self.wants_focus);
        self.wants_focus = wants_focus && ui.is_sizing_pass();
        wants_focus &= !self.wants_focus;
        let field = path_field(ui, (self.path.text_mut(), ""), width, name, &mut wants_focus);
        self.focused = field.focused;
        if field.changed {
            (self.warned, self.trouble) = (None, None);
        }
        let mut copies = false;
        ui.horizontal(|ui| {
            if button(ui, None, word!(language, "Save", "Salvar"), true, Emphasis::Primary).clicked() || field.entered {
                self.save(session, subject);
            }
            if button(ui, None, word!(language, "Browse…", "Procurar…"), true, Emphasis::Quiet).clicked() {
                let at = [&self.path, &self.suggested].map(|path| path.resolve(std::env::home_dir(), language));
                let at = at.into_iter().flatten().next().unwrap_or_default();
                session.jobs().choose_file(Purpose::Save, at, language);
            }
            let copy = button(ui, None, word!(language, "Copy picture", "Copiar imagem"), true, Emphasis::Quiet);
            let hint =
                word!(language, "Copy the picture as it is shown (Ctrl C)", "Copiar a imagem como aparece (Ctrl C)");
            copies = copy.on_hover_text(hint).clicked();
        });
        if self.trouble != shown {
            ui.ctx().request_repaint();
        }
        copies.then_some(UserCommand::Copy)
    }

    /// Returns what is to be written.
    ///
    /// # Errors
    /// A sentence, if it cannot be made.
    fn export(&self, session: &Session, subject: &SaveSubject) -> Result<Export, String> {
        let shown = if let SaveSubject::Run(shown) = subject { *shown } else { Default::default() };
        let runs = if let SaveSubject::Comparison(runs) = subject { runs.clone() } else { None };
        let runs = || {
            let none = word!(
                session.language(),
                "No compared run is ready. Wait a moment",
                "Nenhuma execução comparada está pronta. Espere um momento"
            );
            runs.ok_or(none)
        };
        Ok(match self.kind {
            SaveKind::Render => Export::Shown((Layer::Owners, 0.0)),
            SaveKind::Owners => Export::Shown((Layer::Owners, 1.0)),
            SaveKind::Costs => Export::Shown((Layer::Costs, 1.0)),
            SaveKind::Arrival => Export::Shown((Layer::Arrival, 1.0)),
            SaveKind::Blend => Export::Shown(shown),
            SaveKind::Large => Export::Picture(self.retraced.export(session)?),
            SaveKind::Ring => Export::Drawing(Drawing::Ring(session.now())),
            SaveKind::Timeline => Export::Drawing(Drawing::Timeline),
            SaveKind::Film => Export::Film(self.film.film(shown)),
            SaveKind::Run => Export::Run,
            SaveKind::Table => Export::Table,
            SaveKind::Chrome => Export::Chrome,
            SaveKind::Bars => Export::Bars(runs()?),
            SaveKind::Rows => Export::Rows(runs()?),
        })
    }

    /// Saves the file. An existing file is replaced only at the second press.
    fn save(&mut self, session: &mut Session, subject: &SaveSubject) {
        let language = session.language();
        let path = match self.path.resolve(std::env::home_dir(), language) {
            Ok(path) => path,
            Err(why) => return self.trouble = Some(why),
        };
        if let Err(why) = self.kind.check_ending(&path, language) {
            return self.trouble = Some(why);
        }
        if let Err(error) = check_writable(&path) {
            return self.trouble = Some(error.to_string());
        }
        let opened = session.opened().and_then(|opened| opened.path.as_deref());
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if opened.is_some_and(|opened| is_same_file(opened, &path)) {
            return self.trouble = Some(say!(
                language,
                "{name} is the open scene. Choose another name",
                "{name} é a cena aberta. Escolha outro nome"
            ));
        }
        // If it cannot be made, the reason stands in the place of the preview.
        let Ok(export) = self.export(session, subject) else { return };
        let warned = self.warned.take();
        if path.is_file() && warned.as_ref() != Some(&path) {
            self.trouble = Some(say!(
                language,
                "{name} exists. Press Save again to replace it",
                "{name} já existe. Pressione Salvar outra vez para substituí-lo"
            ));
            self.warned = Some(path);
            return;
        }
        // The sheet stays open for the next file; a notice reports on this one.
        match export {
            Export::Run => session.save_run(path, &self.title, &self.memo),
            export => session.export(path, export),
        }
    }

    /// Returns the path to suggest now.
    fn suggestion(&self, session: &Session) -> TypedPath {
        let header = session.header();
        let done = session.stage().phase == Phase::Finished;
        let directory = std::env::current_dir().unwrap_or_default();
        let own = match self.kind {
            SaveKind::Film => {
                let [width, height] = self.film.film(Default::default()).size(header.size);
                format!("{width}x{height}")
            }
            _ => self.retraced.name(session),
        };
        let mut path = TypedPath::default();
        path.set(directory.join(self.kind.file_name(header, done, &own)));
        path
    }

    /// Updates the suggested path, unless the user has changed it.
    fn suggest(&mut self, session: &Session) {
        let suggested = self.suggestion(session);
        if self.path.text() == self.suggested.text() && self.path.text() != suggested.text() {
            // Selects the new name.
            self.wants_focus |= self.focused;
            self.path.clone_from(&suggested);
        }
        self.suggested = suggested;
    }
}

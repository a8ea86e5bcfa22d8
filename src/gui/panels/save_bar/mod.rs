//! The save bar: the kind of file, its path, and the error if it cannot be saved.

mod kinds;
mod retraced;

use std::path::PathBuf;

use egui::{ComboBox, Label, RichText, Ui, WidgetInfo};

use crate::export::{Comparison, Drawing, Film};
use crate::gui::input::keys::UserCommand;
use crate::gui::session::{Export, Phase, Purpose, Session};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::path_input::{TypedPath, no_file_chosen, path_field};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button};
use crate::language::{Language, say, word};
use crate::output::{check_writable, is_same_file};
use crate::view::Layer;
use kinds::SaveKind;
use retraced::RetracedPicture;

/// Subject of the save bar.
pub enum SaveSubject {
    /// The run on the stage, and the shown layer with its share (0 to 1).
    Run((Layer, f32)),
    /// The compared runs; `None` until the first one is run.
    Comparison(Option<Comparison>),
}

/// The save bar, below the top bar.
#[derive(Default)]
pub struct SaveBar {
    open: bool,
    wants_focus: bool,
    /// Whether the path field has the focus.
    focused: bool,
    kind: SaveKind,
    path: TypedPath,
    /// The path that the bar suggested last. The bar updates the path until the user changes it.
    suggested: TypedPath,
    /// The existing file that a second press of Save replaces.
    warned: Option<PathBuf>,
    /// The error of the last attempt.
    trouble: Option<String>,
    /// A picture that is traced again.
    retraced: RetracedPicture,
    /// Title of a saved run.
    title: String,
    /// Memo of a saved run.
    memo: String,
}

impl SaveBar {
    /// Opens or closes the bar.
    pub fn toggle(&mut self, session: &Session) {
        if self.open { self.open = false } else { self.open_for(self.kind, session) }
    }

    /// Opens the bar for the run.
    pub fn open_for_run(&mut self, session: &Session) {
        self.open_for(SaveKind::Run, session);
    }

    /// Opens the bar for a kind, with a suggested path; what is chosen for a picture that is traced again stays.
    fn open_for(&mut self, kind: SaveKind, session: &Session) {
        let retraced = self.retraced.clone();
        let caption = &session.header().caption;
        let (title, memo) = (caption.title.clone(), caption.memo.clone());
        *self = Self { open: true, wants_focus: true, kind, retraced, title, memo, ..Self::default() };
        self.suggest(session);
    }

    /// Closes the bar.
    pub fn close(&mut self) {
        self.open = false;
    }

    /// Whether the bar is open.
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

    /// Shows the bar. Returns the command of a button that the bar does not handle itself.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session, subject: &SaveSubject) -> Option<UserCommand> {
        let language = session.language();
        let look = Look::of(ui.ctx());
        let kinds = match subject {
            SaveSubject::Run(_) => &SaveKind::OF_RUN[..],
            SaveSubject::Comparison(_) => &SaveKind::OF_COMPARISON[..],
        };
        if !kinds.contains(&self.kind) {
            self.choose(kinds[0]);
        }
        let quiet = |text: &str| RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet);
        let mut copies = false;
        // A low window has a list instead of a row of buttons.
        let is_low = ui.ctx().content_rect().height() < 600.0;
        if !is_low {
            self.kinds(ui, kinds, language);
        }
        match self.kind {
            SaveKind::Large => self.retraced.show(ui, session),
            SaveKind::Run => self.describe(ui, language),
            _ => {}
        }
        self.suggest(session);
        ui.horizontal(|ui| {
            if is_low {
                self.list_of_kinds(ui, kinds, language);
            }
            ui.label(quiet(word!(language, "as", "como")));
            let width = (ui.available_width() - word!(language, 43.0, 47.5) * GRID).max(20.0 * GRID);
            let name = word!(language, "Path of the file", "Caminho do arquivo");
            let field = path_field(ui, (self.path.text_mut(), ""), width, name, &mut self.wants_focus);
            self.focused = field.focused;
            if field.changed {
                (self.warned, self.trouble) = (None, None);
            }
            if button(ui, None, word!(language, "Save", "Salvar"), true, Emphasis::Primary).clicked() || field.entered {
                self.save(session, subject);
            }
            if button(ui, None, word!(language, "Browse…", "Procurar…"), true, Emphasis::Quiet).clicked() {
                let at = [&self.path, &self.suggested].map(|path| path.resolve(std::env::home_dir(), language));
                session.jobs().choose_file(
                    Purpose::Save,
                    at.into_iter().flatten().next().unwrap_or_default(),
                    language,
                );
            }
            let copy = button(ui, None, word!(language, "Copy picture", "Copiar imagem"), true, Emphasis::Quiet);
            let hint =
                word!(language, "Copy the picture as it is shown (Ctrl C)", "Copiar a imagem como aparece (Ctrl C)");
            copies = copy.on_hover_text(hint).clicked();
            if button(ui, Some(Icon::Close), word!(language, "Close save", "Fechar salvar"), false, Emphasis::Quiet)
                .clicked()
            {
                self.open = false;
            }
        });
        if let Some(trouble) = &self.trouble {
            let text = RichText::new(trouble).font(theme::regular(theme::BODY)).color(look.trouble);
            ui.add(Label::new(text).truncate());
        }
        copies.then_some(UserCommand::Copy)
    }

    /// Shows a button for each kind.
    fn kinds(&mut self, ui: &mut Ui, kinds: &[SaveKind], language: Language) {
        let quiet = Look::of(ui.ctx()).quiet;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = egui::vec2(GRID / 2.0, GRID / 2.0);
            let mut format = "";
            for &kind in kinds {
                // The format stands once before consecutive kinds of that format.
                if std::mem::replace(&mut format, kind.format()) != kind.format() {
                    // It must not be separated from the first of them.
                    if ui.available_size_before_wrap().x < 16.0 * GRID {
                        ui.end_row();
                    }
                    ui.add_space(GRID / 2.0);
                    ui.label(RichText::new(kind.format()).font(theme::regular(theme::SMALL)).color(quiet));
                }
                let emphasis = if kind == self.kind { Emphasis::On } else { Emphasis::Quiet };
                if button(ui, None, kind.name(language), true, emphasis).on_hover_text(kind.hint(language)).clicked() {
                    self.choose(kind);
                }
            }
        });
    }

    /// Shows the kinds as a list.
    fn list_of_kinds(&mut self, ui: &mut Ui, kinds: &[SaveKind], language: Language) {
        let mut chosen = self.kind;
        let combo = ComboBox::from_id_salt("kind").selected_text(chosen.name(language)).width(13.0 * GRID);
        let combo = combo.show_ui(ui, |ui| {
            for &kind in kinds {
                ui.selectable_value(&mut chosen, kind, kind.name(language)).on_hover_text(kind.hint(language));
            }
        });
        let name = word!(language, "What to save", "O que salvar");
        combo.response.widget_info(|| WidgetInfo::labeled(egui::Role::ComboBox, true, name));
        if chosen != self.kind {
            self.choose(chosen);
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

    /// Shows the fields for title and memo of a run.
    fn describe(&mut self, ui: &mut Ui, language: Language) {
        let half = (ui.available_width() - 5.0 * GRID) / 2.0;
        ui.horizontal(|ui| {
            let name = word!(language, "Title of the run", "Título da execução");
            path_field(ui, (&mut self.title, name), 0.7 * half, name, &mut false);
            let name = word!(language, "Memo", "Anotação");
            path_field(ui, (&mut self.memo, name), 1.3 * half, name, &mut false);
        });
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
        let retraced = (self.kind == SaveKind::Large).then(|| self.retraced.export(session)).transpose();
        let retraced = match retraced {
            Ok(retraced) => retraced,
            Err(why) => return self.trouble = Some(why),
        };
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
        // The bar stays open for the next file; a notice reports on this one.
        match (self.kind, subject) {
            (SaveKind::Bars | SaveKind::Rows, SaveSubject::Comparison(Some(runs))) => {
                let export = if self.kind == SaveKind::Bars { Export::Bars } else { Export::Rows };
                session.export(path, export(runs.clone()));
            }
            (_, SaveSubject::Comparison(_)) => {
                session.trouble(word!(
                    language,
                    "No compared run is ready. Wait a moment",
                    "Nenhuma execução comparada está pronta. Espere um momento"
                ));
            }
            (kind, &SaveSubject::Run(shown)) => match retraced {
                Some(picture) => session.export(path, Export::Picture(picture)),
                None => self.save_run_as(kind, session, path, shown),
            },
        }
    }

    /// Starts saving a file of the run on the stage, other than a picture that is traced again.
    fn save_run_as(&self, kind: SaveKind, session: &mut Session, path: PathBuf, shown: (Layer, f32)) {
        match kind {
            SaveKind::Render => session.save_picture(path, (Layer::Owners, 0.0)),
            SaveKind::Owners => session.save_picture(path, (Layer::Owners, 1.0)),
            SaveKind::Costs => session.save_picture(path, (Layer::Costs, 1.0)),
            SaveKind::Arrival => session.save_picture(path, (Layer::Arrival, 1.0)),
            SaveKind::Blend => session.save_picture(path, shown),
            SaveKind::Run => session.save_run(path, &self.title, &self.memo),
            SaveKind::Ring => session.export(path, Export::Drawing(Drawing::Ring(session.now()))),
            SaveKind::Timeline => session.export(path, Export::Drawing(Drawing::Timeline)),
            SaveKind::Film => session.export(path, Export::Film(Film { look: shown, ..Film::default() })),
            SaveKind::Table => session.export(path, Export::Table),
            SaveKind::Chrome => session.export(path, Export::Chrome),
            SaveKind::Large | SaveKind::Bars | SaveKind::Rows => {}
        }
    }

    /// Updates the suggested path, unless the user has changed it.
    fn suggest(&mut self, session: &Session) {
        let done = session.stage().phase == Phase::Finished;
        let directory = std::env::current_dir().unwrap_or_default();
        let name = self.kind.file_name(session.header(), done, &self.retraced.name(session));
        let mut suggested = TypedPath::default();
        suggested.set(directory.join(name));
        if self.path.text() == self.suggested.text() && self.path.text() != suggested.text() {
            // Selects the new name.
            self.wants_focus |= self.focused;
            self.path.clone_from(&suggested);
        }
        self.suggested = suggested;
    }
}

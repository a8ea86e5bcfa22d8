//! What to save, and where: the kinds, a path to type, the system's own dialog beside it, and a sentence on what is in the
//! way.

mod kinds;

use std::path::{Path, PathBuf};

use egui::{ComboBox, Label, RichText, Ui, WidgetInfo};

use crate::export::{Comparison, Drawing, Film};
use crate::gui::input::keys::UserCommand;
use crate::gui::session::{Export, Phase, Purpose, Session};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button, number, path_field};
use crate::language::{Language, say, word};
use crate::output::{check_writable, is_same_file};
use crate::picture::{Quality, Size};
use crate::view::Layer;
use kinds::{LONGEST_SIDE, SaveKind, four_k, is_shape, large};

/// What the bar saves.
pub enum SaveSubject {
    /// The run on the stage; its picture is shown with this much (0 to 1) of a layer.
    Run((Layer, f32)),
    /// The compared runs; `None` until one of them is known.
    Comparison(Option<Comparison>),
}

/// The bar below the top bar, while it is open.
pub struct SaveBar {
    open: bool,
    wants_focus: bool,
    /// The path is being typed.
    focused: bool,
    kind: SaveKind,
    path: String,
    /// The name that the bar itself has put there last: it is renewed as long as nobody has changed it.
    suggested: String,
    /// What was asked for when the file was found to exist: asked for once more, it is replaced.
    warned: Option<PathBuf>,
    /// What is in the way.
    trouble: Option<String>,
    /// Of a picture that is traced anew: its sides, once they were chosen, and n × n samples a pixel.
    size: Option<[u32; 2]>,
    samples: u32,
    /// What a run is called, and what is to be known of it.
    title: String,
    memo: String,
}

impl Default for SaveBar {
    fn default() -> Self {
        Self {
            open: false,
            wants_focus: false,
            focused: false,
            kind: SaveKind::default(),
            path: String::new(),
            suggested: String::new(),
            warned: None,
            trouble: None,
            size: None,
            samples: 2,
            title: String::new(),
            memo: String::new(),
        }
    }
}

impl SaveBar {
    /// Opens the bar, with a name that says what is saved, or closes it.
    pub fn toggle(&mut self, session: &Session) {
        if self.open { self.open = false } else { self.open_for(self.kind, session) }
    }

    /// Opens the bar for the run.
    pub fn open_for_run(&mut self, session: &Session) {
        self.open_for(SaveKind::Run, session);
    }

    fn open_for(&mut self, kind: SaveKind, session: &Session) {
        let Self { size, samples, .. } = *self;
        let caption = &session.header().caption;
        let (title, memo) = (caption.title.clone(), caption.memo.clone());
        *self = Self { open: true, wants_focus: true, kind, size, samples, title, memo, ..Self::default() };
        self.suggest(session);
    }

    /// Closes it.
    pub fn close(&mut self) {
        self.open = false;
    }

    /// Whether the bar is to be shown.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Takes in what was chosen in the system's dialog.
    pub fn take_in(&mut self, chosen: Option<PathBuf>, language: Language) {
        self.wants_focus = true;
        self.trouble = None;
        match chosen {
            Some(path) => self.path = path.display().to_string(),
            None => {
                let trouble = word!(
                    language,
                    "No dialog of the system answered, or nothing was chosen in it: the path can still be typed",
                    "Nenhum diálogo do sistema respondeu, ou nada foi escolhido: o caminho ainda pode ser escrito"
                );
                self.trouble = Some(trouble.into());
            }
        }
    }

    /// Shows the bar, and returns what else was asked for.
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
        // In a low window a row more would leave nothing of the picture.
        let is_low = ui.ctx().content_rect().height() < 600.0;
        if !is_low {
            self.kinds(ui, kinds, language);
        }
        match self.kind {
            SaveKind::Large => self.choose_size(ui, session, look),
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
            let name = word!(language, "Where to save", "Onde salvar");
            let field = path_field(ui, (&mut self.path, ""), width, name, &mut self.wants_focus);
            self.focused = field.focused;
            if field.changed {
                (self.warned, self.trouble) = (None, None);
            }
            if button(ui, None, word!(language, "Save", "Salvar"), true, Emphasis::Primary).clicked() || field.entered {
                self.save(session, subject);
            }
            if button(ui, None, word!(language, "Browse…", "Procurar…"), true, Emphasis::Quiet).clicked() {
                let typed = resolve(&self.path, std::env::home_dir(), language);
                session.jobs().choose(
                    Purpose::Save,
                    typed.unwrap_or_else(|_| PathBuf::from(&self.suggested)),
                    language,
                );
            }
            let copy = button(ui, None, word!(language, "Copy picture", "Copiar imagem"), true, Emphasis::Quiet);
            let hint = word!(
                language,
                "The picture as it is shown into the clipboard (Ctrl C)",
                "A imagem como está para a área de transferência (Ctrl C)"
            );
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

    /// All kinds, to be pressed at once.
    fn kinds(&mut self, ui: &mut Ui, kinds: &[SaveKind], language: Language) {
        let quiet = Look::of(ui.ctx()).quiet;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = egui::vec2(GRID / 2.0, GRID / 2.0);
            let mut format = "";
            for &kind in kinds {
                // Said once of those that follow each other.
                if std::mem::replace(&mut format, kind.format()) != kind.format() {
                    // It stands beside the first of them.
                    if ui.available_size_before_wrap().x < 16.0 * GRID {
                        ui.end_row();
                    }
                    ui.add_space(GRID / 2.0);
                    ui.label(RichText::new(kind.format()).font(theme::regular(theme::SMALL)).color(quiet));
                }
                let weight = if kind == self.kind { Emphasis::On } else { Emphasis::Quiet };
                if button(ui, None, kind.name(language), true, weight).on_hover_text(kind.hint(language)).clicked() {
                    self.choose(kind);
                }
            }
        });
    }

    /// The same where there is no room for them.
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

    /// Another kind: a name that was typed keeps all but its ending.
    fn choose(&mut self, kind: SaveKind) {
        (self.warned, self.trouble, self.wants_focus) = (None, None, true);
        if self.path != self.suggested && !self.path.trim().is_empty() {
            self.path = Path::new(&self.path).with_extension(kind.ending()).display().to_string();
        }
        self.kind = kind;
    }

    /// Size and quality of a picture that is traced anew.
    fn choose_size(&mut self, ui: &mut Ui, session: &Session, look: Look) {
        let language = session.language();
        let quiet = |text: &str| RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet);
        let own = own_size(session);
        let mut size = self.large_size(session);
        let twice = own.map(|side| 2 * side);
        ui.horizontal(|ui| {
            for (name, other) in
                [(word!(language, "Its own size", "Seu tamanho"), own), ("× 2", twice), ("4K", four_k(own))]
            {
                let weight = if size == other { Emphasis::On } else { Emphasis::Quiet };
                let [width, height] = other;
                let hint = format!("{width} × {height}");
                if button(ui, None, name, true, weight).on_hover_text(hint).clicked() {
                    size = other;
                }
            }
            let [width, height] = &mut size;
            number(
                ui,
                width,
                1..=LONGEST_SIDE,
                "",
                9.0 * GRID,
                word!(language, "Pixels across", "Pixels na horizontal"),
            );
            ui.label(quiet("×"));
            number(ui, height, 1..=LONGEST_SIDE, "", 9.0 * GRID, word!(language, "Pixels down", "Pixels na vertical"));
            ui.label(quiet(word!(language, "samples a pixel, n × n:", "amostras por pixel, n × n:")));
            number(
                ui,
                &mut self.samples,
                1..=16,
                "",
                6.0 * GRID,
                word!(language, "Samples a pixel", "Amostras por pixel"),
            );
        });
        if size != self.large_size(session) {
            self.size = Some(size);
        }
        if !is_shape(own, size) {
            let words = word!(
                language,
                "Another shape than the picture's: at the sides more is seen, or less",
                "Outro formato que o da imagem: dos lados se vê mais, ou menos"
            );
            ui.label(quiet(words));
        }
    }

    /// Title and memo of a run.
    fn describe(&mut self, ui: &mut Ui, language: Language) {
        let half = (ui.available_width() - 5.0 * GRID) / 2.0;
        ui.horizontal(|ui| {
            let name = word!(language, "Title of the run", "Título da execução");
            path_field(ui, (&mut self.title, name), 0.7 * half, name, &mut false);
            let name = word!(language, "What is to be known of it", "O que se deve saber dela");
            path_field(ui, (&mut self.memo, name), 1.3 * half, name, &mut false);
        });
    }

    /// Saves, unless that would replace a file and has been asked for only once.
    fn save(&mut self, session: &mut Session, subject: &SaveSubject) {
        let language = session.language();
        let path = match resolve(&self.path, std::env::home_dir(), language) {
            Ok(path) => path,
            Err(why) => return self.trouble = Some(why),
        };
        if let Err(error) = check_writable(&path) {
            return self.trouble = Some(error.to_string());
        }
        let opened = session.opened().and_then(|opened| opened.path.as_deref());
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if opened.is_some_and(|opened| is_same_file(opened, &path)) {
            return self.trouble = Some(say!(
                language,
                "{name} is the scene that is open; choose another name",
                "{name} é a cena que está aberta; escolha outro nome"
            ));
        }
        let size = match large(self.large_size(session)) {
            Ok(size) => size,
            Err(why) => return self.trouble = Some(why),
        };
        let warned = self.warned.take();
        if path.is_file() && warned.as_ref() != Some(&path) {
            self.trouble = Some(say!(
                language,
                "{name} exists; press Save again to replace it",
                "{name} já existe; pressione Salvar outra vez para substituí-lo"
            ));
            self.warned = Some(path);
            return;
        }
        // Open for the next one: a notice says what becomes of this one.
        match (self.kind, subject) {
            (SaveKind::Bars | SaveKind::Rows, SaveSubject::Comparison(Some(runs))) => {
                let export = if self.kind == SaveKind::Bars { Export::Bars } else { Export::Rows };
                session.export(path, export(runs.clone()));
            }
            (_, SaveSubject::Comparison(_)) => {
                session.trouble(word!(language, "No run is known yet", "Nenhuma execução é conhecida ainda"));
            }
            (kind, &SaveSubject::Run(shown)) => self.save_run_as(kind, session, path, shown, size),
        }
    }

    fn save_run_as(&self, kind: SaveKind, session: &mut Session, path: PathBuf, shown: (Layer, f32), size: Size) {
        match kind {
            SaveKind::Render => session.save_picture(path, (Layer::Owners, 0.0)),
            SaveKind::Owners => session.save_picture(path, (Layer::Owners, 1.0)),
            SaveKind::Costs => session.save_picture(path, (Layer::Costs, 1.0)),
            SaveKind::Arrival => session.save_picture(path, (Layer::Arrival, 1.0)),
            SaveKind::Blend => session.save_picture(path, shown),
            SaveKind::Run => session.save_run(path, &self.title, &self.memo),
            SaveKind::Large => {
                let quality = Quality { samples: self.samples, ..session.header().quality };
                session.export(path, Export::Picture(size, quality));
            }
            SaveKind::Ring => session.export(path, Export::Drawing(Drawing::Ring(session.now()))),
            SaveKind::Timeline => session.export(path, Export::Drawing(Drawing::Timeline)),
            SaveKind::Film => session.export(path, Export::Film(Film { look: shown, ..Film::default() })),
            SaveKind::Table => session.export(path, Export::Table),
            SaveKind::Chrome => session.export(path, Export::Chrome),
            SaveKind::Bars | SaveKind::Rows => {}
        }
    }

    /// The size of a picture that is traced anew: of the picture's shape, unless another one was chosen.
    fn large_size(&self, session: &Session) -> [u32; 2] {
        self.size.unwrap_or_else(|| four_k(own_size(session)))
    }

    /// Puts a name there that says what is saved, unless the user has put something else there.
    fn suggest(&mut self, session: &Session) {
        let done = session.stage().phase == Phase::Finished;
        let directory = std::env::current_dir().unwrap_or_default();
        let size = self.large_size(session);
        let size = format!("{}x{}", size[0], size[1]);
        let name = self.kind.file_name(session.header(), done, &size);
        let suggested = directory.join(name).display().to_string();
        if self.path == self.suggested && self.path != suggested {
            // The name is selected anew.
            self.wants_focus |= self.focused;
            self.path.clone_from(&suggested);
        }
        self.suggested = suggested;
    }
}

/// Of the picture that is shown.
fn own_size(session: &Session) -> [u32; 2] {
    let size = session.header().size;
    [size.width(), size.height()]
}

/// The path that was typed, `~` being the home directory.
pub fn resolve(typed: &str, home: Option<PathBuf>, language: Language) -> Result<PathBuf, String> {
    let typed = typed.trim();
    if typed.is_empty() {
        return Err(word!(
            language,
            "There is no path: type one, for instance ~/picture.png",
            "Falta o caminho: escreva um, por exemplo ~/imagem.png"
        )
        .into());
    }
    let path = match Path::new(typed).strip_prefix("~") {
        Ok(rest) => {
            let unknown = word!(
                language,
                "The home directory is not known: type it instead of ~",
                "O diretório pessoal não é conhecido: escreva-o em vez de ~"
            );
            home.ok_or(unknown)?.join(rest)
        }
        Err(_) => PathBuf::from(typed),
    };
    if path.is_dir() || typed.ends_with(std::path::is_separator) {
        let path = path.display();
        return Err(say!(
            language,
            "{path} is a directory: add the name of a file in it",
            "{path} é um diretório: acrescente o nome de um arquivo"
        ));
    }
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilde_is_the_home_directory() {
        let language = Language::English;
        let home = || Some(PathBuf::from("/home/somebody"));
        assert_eq!(resolve(" ~/x.png ", home(), language), Ok(PathBuf::from("/home/somebody/x.png")));
        assert_eq!(resolve("~x.png", home(), language), Ok(PathBuf::from("~x.png")));
        assert_eq!(resolve("a b/x.png", None, language), Ok(PathBuf::from("a b/x.png")));
        assert!(resolve("~/x.png", None, language).is_err_and(|why| why.contains("home directory")));
    }

    #[test]
    fn what_is_no_file_is_refused_in_words() {
        let language = Language::English;
        assert!(resolve("  ", None, language).is_err_and(|why| why.contains("no path")));
        assert!(resolve(".", None, language).is_err_and(|why| why.contains("is a directory")));
        assert!(resolve("pictures/", None, language).is_err_and(|why| why.contains("is a directory")));
    }
}

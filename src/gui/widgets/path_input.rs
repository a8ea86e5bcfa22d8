//! Input of a path: the text field, the meaning of what was typed, and the answer of the file dialog.

use std::path::{Path, PathBuf};

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Key, Response, RichText, Role, TextEdit, Ui, WidgetInfo, vec2};

use super::keep_escape;
use super::steady::steady_id;
use super::theme::{GRID, Look};
use crate::language::{Language, say, word};

/// A path as text, to be typed. A path that is not UTF-8 is shown with replacement characters; as long as its text or
/// that of its directory is unchanged, it keeps its meaning.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TypedPath {
    text: String,
    /// The path of which the text was made last.
    path: PathBuf,
}

impl TypedPath {
    /// Replaces the text by this path.
    pub fn set(&mut self, path: PathBuf) {
        self.text = path.display().to_string();
        self.path = path;
    }

    /// Returns the text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the text, to be changed.
    pub fn text_mut(&mut self) -> &mut String {
        &mut self.text
    }

    /// Changes the extension.
    pub fn set_extension(&mut self, extension: &str) {
        self.set(self.meaning().with_extension(extension));
    }

    /// Returns the path of the file; a leading `~` is the home directory.
    ///
    /// # Errors
    /// A sentence, if the text is empty, names a directory, or the home directory is unknown.
    pub fn resolve(&self, home: Option<PathBuf>, language: Language) -> Result<PathBuf, String> {
        let path = resolve(self.full_path(), home, language)?;
        let meaning = self.meaning();
        Ok(if meaning.to_str().is_some() { path } else { meaning })
    }

    fn full_path(&self) -> &str {
        full_path(&self.text, self.path.parent().unwrap_or(Path::new("")))
    }

    /// Returns the path with the real names of the directories whose text is unchanged.
    fn meaning(&self) -> PathBuf {
        let typed = Path::new(self.full_path());
        let unchanged = |real: &Path| Some(real.join(typed.strip_prefix(real.to_string_lossy().as_ref()).ok()?));
        let without_end = |path: &Path| path.components().collect::<PathBuf>();
        self.path.ancestors().find_map(unchanged).map_or_else(|| typed.to_owned(), |path| without_end(&path))
    }
}

/// Response of a text field.
pub struct TextFieldResponse {
    /// The text changed.
    pub changed: bool,
    /// Enter was pressed.
    pub entered: bool,
    /// The field has the keyboard focus.
    pub focused: bool,
}

/// Shows the text field for the path of a file to open: all of its text is selected when it gets the focus.
pub fn open_field(
    ui: &mut Ui,
    (path, hint): (&mut String, &str),
    width: f32,
    name: &str,
    wants_focus: &mut bool,
) -> TextFieldResponse {
    let (field, _, entered) = text_field(ui, (path, hint), width, name, wants_focus);
    // A press of the mouse sets the cursor until the button is released.
    let (waits, is_down) = (field.id.with("waits for the mouse"), ui.input(|input| input.pointer.any_down()));
    if field.gained_focus() {
        ui.data_mut(|data| data.insert_temp(waits, is_down));
    }
    if field.has_focus()
        && !is_down
        && let Some(by_mouse) = ui.data_mut(|data| data.remove_temp::<bool>(waits))
    {
        let mut state = TextEditState::load(ui.ctx(), field.id).unwrap_or_default();
        // What the mouse has selected in this press stays selected.
        if !by_mouse || state.cursor.char_range().is_none_or(|range| range.is_empty()) {
            let end = CCursor::new(path.chars().count());
            state.cursor.set_char_range(Some(CCursorRange::two(CCursor::new(0), end)));
            state.store(ui.ctx(), field.id);
        }
    }
    TextFieldResponse { changed: field.changed(), entered, focused: field.has_focus() }
}

/// Shows a text field for a path, with a hint while it is empty. It gets the focus if it `wants_focus`, and keeps it on
/// Enter, so that the user can correct a mistake. `name` is its accessible name.
pub fn path_field(
    ui: &mut Ui,
    (path, hint): (&mut String, &str),
    width: f32,
    name: &str,
    wants_focus: &mut bool,
) -> TextFieldResponse {
    let (field, begins, entered) = text_field(ui, (path, hint), width, name, wants_focus);
    if begins {
        // Selects the stem of the file name: users change it more often than the directory or the extension.
        let mut state = TextEditState::load(ui.ctx(), field.id).unwrap_or_default();
        let [from, to] = stem_range(path).map(CCursor::new);
        state.cursor.set_char_range(Some(CCursorRange::two(from, to)));
        state.store(ui.ctx(), field.id);
    }
    TextFieldResponse { changed: field.changed(), entered, focused: field.has_focus() }
}

/// Shows a text field. Returns its response, whether it gets the focus, and whether Enter was pressed.
fn text_field(
    ui: &mut Ui,
    (path, hint): (&mut String, &str),
    width: f32,
    name: &str,
    wants_focus: &mut bool,
) -> (Response, bool, bool) {
    let hint = RichText::new(hint).color(Look::of(ui.ctx()).quiet);
    let field = TextEdit::singleline(path).desired_width(width).hint_text(hint).margin(vec2(GRID, 0.75 * GRID));
    let field = ui.add(field.id(steady_id(ui, name)));
    field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
    let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    keep_escape(ui, &field);
    let begins = std::mem::take(wants_focus);
    if begins || entered {
        field.request_focus();
    }
    (field, begins, entered)
}

/// Returns begin and end of the file name without its extension, in characters.
fn stem_range(path: &str) -> [usize; 2] {
    let name = path.rfind(std::path::is_separator).map_or(0, |separator| separator + 1);
    let end = path[name..].rfind('.').filter(|&dot| dot > 0).map_or(path.len(), |dot| name + dot);
    [name, end].map(|index| path[..index].chars().count())
}

/// Returns the path that the text means. A full path that was typed or pasted behind the `directory` that was there is
/// taken as it is: behind `/home/me`, the text `/home/me//tmp/a.png` means `/tmp/a.png`. If the old extension has
/// remained behind the new one, it is not repeated.
fn full_path<'a>(text: &'a str, directory: &Path) -> &'a str {
    let text = text.trim();
    let begins_full_path = |rest: &&str| {
        let is_home = rest.strip_prefix('~').is_some_and(|rest| rest.starts_with(std::path::is_separator));
        is_home || Path::new(rest).is_absolute()
    };
    let behind = text.strip_prefix(directory.to_string_lossy().as_ref());
    let full = behind.and_then(|rest| rest.strip_prefix(std::path::is_separator)).filter(begins_full_path);
    let Some(full) = full else { return text };
    let extension = Path::new(full).extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    let once = full.strip_suffix(extension).and_then(|rest| rest.strip_suffix('.')).unwrap_or(full);
    if Path::new(once).extension().is_some_and(|before| before == extension) { once } else { full }
}

/// Turns typed text into the path of a file; a leading `~` is the home directory.
///
/// # Errors
/// A sentence, if the text is empty, names a directory, or the home directory is unknown.
fn resolve(typed: &str, home: Option<PathBuf>, language: Language) -> Result<PathBuf, String> {
    let typed = typed.trim();
    if typed.is_empty() {
        return Err(word!(
            language,
            "There is no path. Type one, for example ~/picture.png",
            "Falta o caminho. Digite um, por exemplo ~/imagem.png"
        )
        .into());
    }
    let path = match Path::new(typed).strip_prefix("~") {
        Ok(rest) => {
            let unknown = word!(
                language,
                "The home directory is unknown. Type its path instead of ~",
                "O diretório pessoal é desconhecido. Digite seu caminho em vez de ~"
            );
            home.ok_or(unknown)?.join(rest)
        }
        Err(_) => PathBuf::from(typed),
    };
    if path.is_dir() || typed.ends_with(std::path::is_separator) {
        let path = path.display();
        return Err(say!(
            language,
            "{path} is a directory. Add the name of a file",
            "{path} é um diretório. Acrescente o nome de um arquivo"
        ));
    }
    Ok(path)
}

/// Says what to do after the file dialog gave no path.
pub fn no_file_chosen(language: Language) -> &'static str {
    word!(
        language,
        "The file dialog was cancelled or is not available. You can type a path.",
        "O diálogo de arquivos foi cancelado ou não está disponível. Você pode digitar um caminho."
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stem_range_selects_name_without_directory_and_extension() {
        let stem = |path: &str| {
            let [from, to] = stem_range(path);
            path.chars().skip(from).take(to - from).collect::<String>()
        };
        assert_eq!(stem("/home/é/my.picture.png"), "my.picture");
        assert_eq!(stem("picture"), "picture");
        assert_eq!(stem("/tmp/.hidden"), ".hidden");
        assert_eq!((stem("/tmp/"), stem("")), (String::new(), String::new()));
    }

    #[test]
    #[cfg(unix)]
    fn full_path_behind_a_directory_is_taken_as_it_is() {
        let mut typed = TypedPath::default();
        let mut resolved = |text: &str| {
            typed.set("/home/me/picture.png".into());
            *typed.text_mut() = text.into();
            typed.resolve(Some("/home/me".into()), Language::English).map(|path| path.display().to_string())
        };
        let cases = [
            ("/home/me/other.png", "/home/me/other.png"),
            ("/home/me//none/a.png", "/none/a.png"),
            ("/home/me//none/a.png.png", "/none/a.png"),
            ("/home/me//none/a.b.png", "/none/a.b.png"),
            ("/home/me/~/a.png", "/home/me/a.png"),
            ("~/a.png", "/home/me/a.png"),
            ("/none//a.png", "/none//a.png"),
            ("/home/me/~a.png", "/home/me/~a.png"),
        ];
        for (text, path) in cases {
            assert_eq!(resolved(text).as_deref(), Ok(path), "{text}");
        }
    }

    #[test]
    #[cfg(unix)]
    fn path_that_is_not_utf_8_keeps_its_bytes() {
        use std::ffi::OsStr;
        use std::os::unix::ffi::OsStrExt;
        let path = |bytes: &[u8]| PathBuf::from(OsStr::from_bytes(bytes));
        let mut typed = TypedPath::default();
        let resolved = |typed: &TypedPath| typed.resolve(None, Language::English);
        typed.set(path(b"/tmp/caf\xe9/x.png"));
        assert_eq!(resolved(&typed), Ok(path(b"/tmp/caf\xe9/x.png")));
        *typed.text_mut() = typed.text().replace("x.png", "inner/y.svg");
        assert_eq!(resolved(&typed), Ok(path(b"/tmp/caf\xe9/inner/y.svg")));
        typed.set_extension("gif");
        assert_eq!(resolved(&typed), Ok(path(b"/tmp/caf\xe9/inner/y.gif")));
        *typed.text_mut() = "/other/z.png".into();
        assert_eq!(resolved(&typed), Ok(path(b"/other/z.png")));
    }

    #[test]
    fn tilde_is_the_home_directory() {
        let language = Language::English;
        let home = || Some(PathBuf::from("/home/somebody"));
        assert_eq!(resolve(" ~/x.png ", home(), language), Ok(PathBuf::from("/home/somebody/x.png")));
        assert_eq!(resolve("~x.png", home(), language), Ok(PathBuf::from("~x.png")));
        assert_eq!(resolve("a b/x.png", None, language), Ok(PathBuf::from("a b/x.png")));
        assert!(resolve("~/x.png", None, language).is_err_and(|why| why.contains("home directory")));
    }

    #[test]
    fn empty_text_and_directories_are_refused() {
        let language = Language::English;
        assert!(resolve("  ", None, language).is_err_and(|why| why.contains("no path")));
        assert!(resolve(".", None, language).is_err_and(|why| why.contains("is a directory")));
        assert!(resolve("pictures/", None, language).is_err_and(|why| why.contains("is a directory")));
    }
}

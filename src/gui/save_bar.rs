//! Where to save the picture: a path to type, the system's own dialog beside it, and a sentence on how it went.

use std::path::{Path, PathBuf};

use egui::{Key, Label, RichText, TextEdit, Ui, WidgetInfo};

use super::session::{Done, Phase, Session};
use super::theme::{self, GRID, Look};
use super::widgets::button;
use crate::runlog::Header;

/// The bar below the top bar, while it is open.
#[derive(Default)]
pub struct SaveBar {
    open: bool,
    wants_focus: bool,
    path: String,
    /// The name that the bar itself has put there last: it is renewed as long as nobody has changed it.
    suggested: String,
    /// What was asked for when the file was found to exist: asked for once more, it is replaced.
    warned: Option<PathBuf>,
    said: Option<Said>,
}

/// What is to be read below the path.
enum Said {
    /// How things stand.
    Note(String),
    /// Why it did not work, or not yet.
    Trouble(String),
}

impl SaveBar {
    /// Opens the bar, with a name that says what the picture is, or closes it.
    pub fn toggle(&mut self, session: &Session) {
        *self = Self { open: !self.open, wants_focus: !self.open, ..Self::default() };
        self.suggest(session);
    }

    /// Whether the bar is to be shown.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Takes in what a job in the background has come to.
    pub fn take_in(&mut self, done: Done) {
        self.wants_focus |= matches!(done, Done::Chosen(_));
        self.said = Some(match done {
            Done::Saved(Ok(said)) => Said::Note(said),
            Done::Saved(Err(why)) => Said::Trouble(why),
            Done::Chosen(Some(path)) => {
                self.path = path.display().to_string();
                Said::Note("Press Save to write it there".into())
            }
            Done::Chosen(None) => Said::Trouble(
                "No dialog of the system answered, or nothing was chosen in it: the path above can still be typed"
                    .into(),
            ),
        });
    }

    /// Shows the bar.
    pub fn show(&mut self, ui: &mut Ui, session: &Session) {
        let look = Look::of(ui.ctx());
        self.suggest(session);
        ui.horizontal(|ui| {
            ui.label(RichText::new("Save the render as").font(theme::regular(theme::BODY)).color(look.quiet));
            let width = (ui.available_width() - 30.0 * GRID).max(20.0 * GRID);
            let field = TextEdit::singleline(&mut self.path).desired_width(width).margin(egui::vec2(GRID, 0.75 * GRID));
            let field = ui.add(field);
            field.widget_info(|| WidgetInfo::labeled(egui::Role::TextInput, true, "Path of the PNG"));
            // A field gives up the focus on Enter; but whoever has mistyped goes on typing.
            let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            if std::mem::take(&mut self.wants_focus) || entered {
                field.request_focus();
            }
            if field.changed() {
                (self.warned, self.said) = (None, None);
            }
            if button(ui, None, "Save", true, true).clicked() || entered {
                self.save(session, ui);
            }
            if button(ui, None, "Choose…", true, false).clicked() {
                self.said = Some(Said::Note("Asking the system for a place…".into()));
                let typed = resolve(&self.path, std::env::home_dir());
                session.choose(typed.unwrap_or_else(|_| PathBuf::from(&self.suggested)), ui.ctx());
            }
            let escaped = ui.input(|input| input.key_pressed(Key::Escape));
            if button(ui, None, "Close", true, false).clicked() || escaped {
                self.open = false;
            }
        });
        if let Some(said) = &self.said {
            let (text, colour) = match said {
                Said::Note(text) => (text, look.text),
                Said::Trouble(text) => (text, ui.visuals().error_fg_color),
            };
            ui.add(Label::new(RichText::new(text).font(theme::regular(theme::BODY)).color(colour)).truncate());
        }
    }

    /// Saves, unless that would replace a file and has been asked for only once.
    fn save(&mut self, session: &Session, ui: &Ui) {
        let path = match resolve(&self.path, std::env::home_dir()) {
            Ok(path) => path,
            Err(why) => return self.said = Some(Said::Trouble(why)),
        };
        let warned = self.warned.take();
        if path.is_file() && warned.as_ref() != Some(&path) {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            self.said = Some(Said::Trouble(format!("{name} exists; press Save again to replace it")));
            self.warned = Some(path);
            return;
        }
        self.said = None;
        session.save(path, ui.ctx());
    }

    /// Puts a name there that says what the picture is now, unless the user has put something else there.
    fn suggest(&mut self, session: &Session) {
        let done = *session.phase() == Phase::Finished;
        let directory = std::env::current_dir().unwrap_or_default();
        let suggested = directory.join(file_name(session.header(), done)).display().to_string();
        if self.path == self.suggested {
            self.path.clone_from(&suggested);
        }
        self.suggested = suggested;
    }
}

/// The path that was typed, `~` being the home directory.
fn resolve(typed: &str, home: Option<PathBuf>) -> Result<PathBuf, String> {
    let typed = typed.trim();
    if typed.is_empty() {
        return Err("There is no path: type where to save the picture, for instance ~/picture.png".into());
    }
    let path = match Path::new(typed).strip_prefix("~") {
        Ok(rest) => home.ok_or("The home directory is not known: type it instead of ~")?.join(rest),
        Err(_) => PathBuf::from(typed),
    };
    if path.is_dir() || typed.ends_with(std::path::is_separator) {
        return Err(format!("{} is a directory: add the name of a file in it", path.display()));
    }
    Ok(path)
}

/// A name that says what the picture is.
fn file_name(header: &Header, done: bool) -> String {
    let kind: String =
        header.scene.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '-' }).collect();
    format!("{kind}-{}{}.png", header.size, if done { "" } else { "-unfinished" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilde_is_the_home_directory() {
        let home = || Some(PathBuf::from("/home/somebody"));
        assert_eq!(resolve(" ~/x.png ", home()), Ok(PathBuf::from("/home/somebody/x.png")));
        assert_eq!(resolve("~x.png", home()), Ok(PathBuf::from("~x.png")));
        assert_eq!(resolve("a b/x.png", None), Ok(PathBuf::from("a b/x.png")));
        assert!(resolve("~/x.png", None).is_err_and(|why| why.contains("home directory")));
    }

    #[test]
    fn what_is_no_file_is_refused_in_words() {
        assert!(resolve("  ", None).is_err_and(|why| why.contains("no path")));
        assert!(resolve(".", None).is_err_and(|why| why.contains("is a directory")));
        assert!(resolve("pictures/", None).is_err_and(|why| why.contains("is a directory")));
    }
}

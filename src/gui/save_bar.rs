//! What to save, and where: a path to type, the system's own dialog beside it, and a sentence on what is in the way.

use std::path::{Path, PathBuf};

use egui::{ComboBox, Label, RichText, Ui, WidgetInfo};

use super::icons::Icon;
use super::session::{Phase, Purpose, Session};
use super::theme::{self, GRID, Look};
use super::widgets::{Weight, button, path_field};
use crate::output::{as_file_name, check_writable, is_same_file};
use crate::runlog::Header;
use crate::view::Layer;

/// The bar below the top bar, while it is open.
#[derive(Default)]
pub struct SaveBar {
    open: bool,
    wants_focus: bool,
    kind: Kind,
    path: String,
    /// The name that the bar itself has put there last: it is renewed as long as nobody has changed it.
    suggested: String,
    /// What was asked for when the file was found to exist: asked for once more, it is replaced.
    warned: Option<PathBuf>,
    /// What is in the way.
    trouble: Option<String>,
}

/// What is saved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Kind {
    /// The picture as the tracer made it.
    #[default]
    Render,
    /// The picture in the colours of who traced it.
    Owners,
    /// The picture in the colours of what its atoms cost.
    Costs,
    /// As it is shown, between the render and a layer.
    Blend,
    /// The run's records.
    Run,
}

const KINDS: [(Kind, &str, &str); 5] = [
    (Kind::Render, "render", "The picture as it was traced"),
    (Kind::Owners, "owners", "The picture in the colours of who traced it"),
    (Kind::Costs, "costs", "The picture in the colours of what it cost"),
    (Kind::Blend, "blend", "The picture as it is blended now"),
    (Kind::Run, "run", "All records of the run, to be played again"),
];

impl SaveBar {
    /// Opens the bar, with a name that says what is saved, or closes it.
    pub fn toggle(&mut self, session: &Session) {
        *self = Self { open: !self.open, wants_focus: !self.open, kind: self.kind, ..Self::default() };
        self.suggest(session);
    }

    /// Opens the bar for the run.
    pub fn open_for_run(&mut self, session: &Session) {
        *self = Self { open: true, wants_focus: true, kind: Kind::Run, ..Self::default() };
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
    pub fn take_in(&mut self, chosen: Option<PathBuf>) {
        self.wants_focus = true;
        self.trouble = None;
        match chosen {
            Some(path) => self.path = path.display().to_string(),
            None => {
                self.trouble = Some(
                    "No dialog of the system answered, or nothing was chosen in it: the path can still be typed".into(),
                );
            }
        }
    }

    /// Shows the bar; the picture is shown with so much of a layer.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session, shown: (Layer, f32)) {
        let look = Look::of(ui.ctx());
        ui.horizontal(|ui| {
            let quiet = |text: &str| RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet);
            ui.label(quiet("Save the"));
            self.choose_kind(ui);
            self.suggest(session);
            ui.label(quiet("as"));
            let width = (ui.available_width() - 27.0 * GRID).max(20.0 * GRID);
            let field = path_field(ui, (&mut self.path, ""), width, "Where to save", &mut self.wants_focus);
            if field.changed {
                (self.warned, self.trouble) = (None, None);
            }
            if button(ui, None, "Save", true, Weight::Primary).clicked() || field.entered {
                self.save(session, shown);
            }
            if button(ui, None, "Browse…", true, Weight::Quiet).clicked() {
                let typed = resolve(&self.path, std::env::home_dir());
                session.jobs().choose(Purpose::Save, typed.unwrap_or_else(|_| PathBuf::from(&self.suggested)));
            }
            if button(ui, Some(Icon::Close), "Close save", false, Weight::Quiet).clicked() {
                self.open = false;
            }
        });
        if let Some(trouble) = &self.trouble {
            let text = RichText::new(trouble).font(theme::regular(theme::BODY)).color(look.trouble);
            ui.add(Label::new(text).truncate());
        }
    }

    fn choose_kind(&mut self, ui: &mut Ui) {
        let before = self.kind;
        let named = KINDS.iter().find(|(kind, ..)| *kind == before).map_or("", |(_, name, _)| name);
        let combo = ComboBox::from_id_salt("kind").selected_text(named).width(13.0 * GRID);
        let combo = combo.show_ui(ui, |ui| {
            for (kind, name, hint) in KINDS {
                self.wants_focus |= ui.selectable_value(&mut self.kind, kind, name).on_hover_text(hint).clicked();
            }
        });
        combo.response.widget_info(|| WidgetInfo::labeled(egui::Role::ComboBox, true, "What to save"));
        if self.kind != before {
            (self.warned, self.trouble) = (None, None);
        }
    }

    /// Saves, unless that would replace a file and has been asked for only once.
    fn save(&mut self, session: &mut Session, shown: (Layer, f32)) {
        let path = match resolve(&self.path, std::env::home_dir()) {
            Ok(path) => path,
            Err(why) => return self.trouble = Some(why),
        };
        if let Err(error) = check_writable(&path) {
            return self.trouble = Some(error.to_string());
        }
        let opened = session.opened().and_then(|opened| opened.path.as_deref());
        if opened.is_some_and(|opened| is_same_file(opened, &path)) {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            return self.trouble = Some(format!("{name} is the scene that is open; choose another name"));
        }
        let warned = self.warned.take();
        if path.is_file() && warned.as_ref() != Some(&path) {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            self.trouble = Some(format!("{name} exists; press Save again to replace it"));
            self.warned = Some(path);
            return;
        }
        self.open = false;
        match self.kind {
            Kind::Render => session.save_picture(path, (Layer::Owners, 0.0)),
            Kind::Owners => session.save_picture(path, (Layer::Owners, 1.0)),
            Kind::Costs => session.save_picture(path, (Layer::Costs, 1.0)),
            Kind::Blend => session.save_picture(path, shown),
            Kind::Run => session.save_run(path),
        }
    }

    /// Puts a name there that says what is saved, unless the user has put something else there.
    fn suggest(&mut self, session: &Session) {
        let done = session.stage().phase == Phase::Finished;
        let directory = std::env::current_dir().unwrap_or_default();
        let suggested = directory.join(file_name(session.header(), self.kind, done)).display().to_string();
        if self.path == self.suggested {
            self.path.clone_from(&suggested);
        }
        self.suggested = suggested;
    }
}

/// The path that was typed, `~` being the home directory.
pub fn resolve(typed: &str, home: Option<PathBuf>) -> Result<PathBuf, String> {
    let typed = typed.trim();
    if typed.is_empty() {
        return Err("There is no path: type one, for instance ~/picture.png".into());
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

/// A name that says what is saved.
fn file_name(header: &Header, kind: Kind, done: bool) -> String {
    let scene = as_file_name(&header.scene);
    let what = match kind {
        Kind::Render => String::new(),
        Kind::Owners => "-owners".into(),
        Kind::Costs => "-costs".into(),
        Kind::Blend => "-blend".into(),
        Kind::Run => format!("-{}-{}", header.strategy_name(), header.speeds.len()),
    };
    let unfinished = if done { "" } else { "-unfinished" };
    let ending = if kind == Kind::Run { "anel" } else { "png" };
    format!("{scene}-{}{what}{unfinished}.{ending}", header.size)
}

#[cfg(test)]
mod tests {
    use super::super::settings::Settings;
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

    #[test]
    fn a_name_says_what_is_saved() {
        let header = Settings::default().header("my scene", "", Default::default(), 2);
        let named = |kind, done| file_name(&header, kind, done);
        assert_eq!(named(Kind::Render, true), "my-scene-640x480.png");
        assert_eq!(named(Kind::Owners, false), "my-scene-640x480-owners-unfinished.png");
        assert_eq!(named(Kind::Run, true), "my-scene-640x480-ring-8.anel");
    }
}

//! Where to save the picture: a path to type, the system's own dialog beside it, and a sentence on how it went.

use std::path::PathBuf;

use egui::{Key, RichText, TextEdit, Ui, WidgetInfo};

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
    said: Option<Result<String, String>>,
}

impl SaveBar {
    /// Opens the bar, with a name that says what the picture is, or closes it.
    pub fn toggle(&mut self, session: &Session) {
        self.open = !self.open;
        if self.open {
            let directory = std::env::current_dir().unwrap_or_default();
            let done = *session.phase() == Phase::Finished;
            self.path = directory.join(file_name(session.header(), done)).display().to_string();
            (self.wants_focus, self.said) = (true, None);
        }
    }

    /// Whether the bar is to be shown.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Takes in what a job in the background has come to.
    pub fn take_in(&mut self, done: Done) {
        match done {
            Done::Saved(said) => self.said = Some(said),
            Done::Chosen(Some(path)) => self.path = path.display().to_string(),
            Done::Chosen(None) => {}
        }
    }

    /// Shows the bar.
    pub fn show(&mut self, ui: &mut Ui, session: &Session) {
        let look = Look::of(ui.ctx());
        ui.horizontal(|ui| {
            ui.label(RichText::new("Save the render as").font(theme::regular(theme::BODY)).color(look.quiet));
            let width = (ui.available_width() - 40.0 * GRID).max(20.0 * GRID);
            let field = TextEdit::singleline(&mut self.path).desired_width(width).margin(egui::vec2(GRID, 0.75 * GRID));
            let field = ui.add(field);
            field.widget_info(|| WidgetInfo::labeled(egui::Role::TextInput, true, "Path of the PNG"));
            if std::mem::take(&mut self.wants_focus) {
                field.request_focus();
            }
            let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            let path = || PathBuf::from(self.path.trim());
            if button(ui, None, "Save", true, true).clicked() || entered {
                self.said = None;
                session.save(path(), ui.ctx());
            }
            if button(ui, None, "Choose…", true, false).clicked() {
                session.choose(path(), ui.ctx());
            }
            let escaped = ui.input(|input| input.key_pressed(Key::Escape));
            if button(ui, None, "Close", true, false).clicked() || escaped {
                self.open = false;
            }
        });
        if let Some(said) = &self.said {
            let (text, colour) = match said {
                Ok(text) => (text.clone(), look.text),
                Err(text) => (text.clone(), ui.visuals().error_fg_color),
            };
            ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(colour));
        }
    }
}

/// A name that says what the picture is.
fn file_name(header: &Header, done: bool) -> String {
    let kind: String =
        header.scene.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '-' }).collect();
    format!("{kind}-{}{}.png", header.size, if done { "" } else { "-unfinished" })
}

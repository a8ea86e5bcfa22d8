//! What Esc closes: all that is open, in the order of opening.

use egui::{Context, Popup};

use super::App;
use crate::gui::session::NoticeKind;
use crate::view::Subject;

/// Something that is open and that Esc closes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closable {
    /// A lesson.
    Lesson,
    /// Presentation mode.
    Projector,
    /// The panel of settings.
    Setup,
    /// The mode in which dragging moves the camera.
    CameraMode,
    /// The enlarged part of the picture.
    PictureZoom,
    /// The selected machine, atom or message.
    Selection,
    /// The explanation of a pixel.
    Inspector,
    /// The Scenes page.
    Scenes,
    /// The list of lessons.
    Lessons,
    /// The Accuracy page.
    Accuracy,
    /// The Compare page.
    Compare,
    /// The form for saving.
    Save,
    /// An error.
    Trouble,
    /// The lists of keys and words.
    Help,
}

impl Closable {
    /// All. Of those that were opened in one frame, Esc closes the later ones first.
    const ALL: [Self; 14] = [
        Self::Lesson,
        Self::Projector,
        Self::Setup,
        Self::CameraMode,
        Self::PictureZoom,
        Self::Selection,
        Self::Inspector,
        Self::Scenes,
        Self::Lessons,
        Self::Accuracy,
        Self::Compare,
        Self::Save,
        Self::Trouble,
        Self::Help,
    ];
}

/// All that is open, the innermost last.
#[derive(Debug, Default)]
pub(super) struct OpenStack {
    open: Vec<Closable>,
    /// Whether a text field had the focus at the end of the last frame. egui takes the focus away before the window
    /// learns of the key.
    was_typing: bool,
}

impl App {
    /// Returns what Esc closes, the innermost last; for tests.
    pub fn open_stack(&self) -> &[Closable] {
        &self.open_stack.open
    }

    /// Records what was opened and closed in this frame, and whether the user types.
    pub(super) fn update_open_stack(&mut self, ctx: &Context) {
        let mut open = std::mem::take(&mut self.open_stack.open);
        // The atom was selected together with its pixel.
        if open.contains(&Closable::Inspector) && !self.is_open(Closable::Inspector) {
            self.selection.selected.take_if(|selected| matches!(selected, Subject::Atom(_)));
        }
        open.retain(|&closable| self.is_open(closable));
        for closable in Closable::ALL {
            if self.is_open(closable) && !open.contains(&closable) {
                open.push(closable);
            }
        }
        self.open_stack = OpenStack { open, was_typing: ctx.text_edit_focused() };
    }

    /// Closes the innermost thing that is open. A text field with the focus comes first, then a menu: egui itself
    /// closes these.
    pub(super) fn close_innermost(&mut self, ctx: &Context) {
        if self.is_waiting_to_quit() {
            self.stay_open();
        } else if !self.open_stack.was_typing && !Popup::is_any_open(ctx) {
            let innermost = self.open_stack.open.iter().rev().copied().find(|&closable| self.is_open(closable));
            match innermost {
                Some(innermost) => self.close(innermost, ctx),
                None => self.session.close_notice(),
            }
        }
    }

    fn is_open(&self, closable: Closable) -> bool {
        match closable {
            Closable::Lesson => self.learn.is_on(),
            Closable::Projector => self.projector,
            // A page hides it.
            Closable::Setup => self.setup.open && !self.shows_page(),
            Closable::CameraMode => self.picture.moves_camera,
            Closable::PictureZoom => self.picture.is_zoomed(),
            Closable::Selection => self.selection.selected.is_some(),
            Closable::Inspector => self.session.inspected_pixel().is_some(),
            Closable::Scenes => self.gallery.is_open(),
            Closable::Lessons => self.learn.is_open(),
            Closable::Accuracy => self.accuracy.is_open(),
            Closable::Compare => self.compare.is_open(),
            Closable::Save => self.save_sheet.is_open(),
            // A note goes by itself.
            Closable::Trouble => self.session.notice().is_some_and(|notice| notice.kind != NoticeKind::Note),
            Closable::Help => self.help.is_some(),
        }
    }

    fn close(&mut self, closable: Closable, ctx: &Context) {
        match closable {
            Closable::Lesson => self.learn.leave(&mut self.session),
            Closable::Projector => self.set_projector(false, ctx),
            Closable::Setup => self.setup.open = false,
            Closable::CameraMode => self.picture.moves_camera = false,
            Closable::PictureZoom => self.picture.show_all(),
            Closable::Selection => self.selection.selected = None,
            Closable::Inspector => self.session.stop_inspecting(),
            Closable::Scenes => self.gallery.close(),
            Closable::Lessons => self.learn.close(),
            Closable::Accuracy => self.accuracy.close(&mut self.session),
            Closable::Compare => self.compare.close(&mut self.session),
            Closable::Save => self.save_sheet.close(),
            Closable::Trouble => self.session.close_notice(),
            Closable::Help => self.help = None,
        }
    }
}

//! What floats over the panels, and where.

use egui::{Context, Pos2, vec2};

use super::App;
use crate::gui::panels::notice::{self, Click};
use crate::gui::widgets::theme::GRID;

impl App {
    /// Shows what is being made or read, or the last notice.
    pub(super) fn notices(&mut self, ctx: &Context) {
        let language = self.session.language();
        let at = self.place_of_notices(ctx);
        let is_free = self.session.notice().is_none();
        let making = self.session.making().filter(|(_, secs, _)| is_free && *secs > 0.4);
        if let Some(making) = making {
            if notice::making(ctx, at, making, language) {
                self.session.stop_making();
            }
        } else if let Some(notice) = self.session.notice().cloned() {
            match notice::show(&notice, ctx, at, language) {
                Some(Click::Close) => self.session.close_notice(),
                Some(Click::Reload) => self.session.reload(),
                None => {}
            }
        } else if let Some((name, _)) = self.session.loading().filter(|(_, secs)| *secs > 0.4) {
            notice::loading(ctx, at, name, language);
        }
    }

    /// The lower right corner of the words about the run, where they are shortest: neither picture nor ring nor anything that
    /// a hand holds lies there. On a page that of the window.
    fn place_of_notices(&self, ctx: &Context) -> Pos2 {
        let words = self.words.unwrap_or(ctx.content_rect());
        words.right_bottom() - vec2(GRID, GRID / 2.0)
    }
}

//! The notice that floats over the panels, and its position.

use egui::{Context, Pos2, vec2};

use super::App;
use crate::gui::panels::notice::{self, NoticeAction};
use crate::gui::session::NoticeKind;
use crate::gui::widgets::theme::GRID;

impl App {
    /// Shows the progress of an export and of loading, and above them the notice to be read now. A note that something
    /// was done waits for the run that is being loaded.
    pub(super) fn notices(&mut self, ctx: &Context) {
        let language = self.session.language();
        let mut at = self.notice_corner(ctx);
        if let Some(progress) = self.session.export_progress().filter(|progress| progress.elapsed_s > 0.4) {
            let (top, is_cancelled) = notice::export_progress(ctx, at, progress, language);
            if is_cancelled {
                self.session.cancel_export();
            }
            at.y = top - GRID / 2.0;
        }
        let loading = self.session.loading().filter(|loading| loading.traced.elapsed_s > 0.4);
        let is_loading = loading.is_some();
        if let Some(loading) = loading {
            let (top, is_cancelled) = notice::loading(ctx, at, &loading, language);
            if is_cancelled {
                self.session.cancel_loading();
            }
            at.y = top - GRID / 2.0;
        }
        if let Some(notice) =
            self.session.notice().filter(|notice| !is_loading || notice.kind != NoticeKind::Note).cloned()
        {
            match notice::show(&notice, self.session.notices_waiting(), ctx, at, language) {
                Some(NoticeAction::Close) => self.session.close_notice(),
                Some(NoticeAction::Reload) => self.session.reload(),
                None => {}
            }
        }
    }

    /// Returns the lower right corner of a notice: that of the narration, whose lines are short, so the notice covers
    /// neither picture nor ring nor controls. On a page it is the corner of the window.
    fn notice_corner(&self, ctx: &Context) -> Pos2 {
        let rect = self.narration_rect.unwrap_or(ctx.content_rect());
        rect.right_bottom() - vec2(GRID, GRID / 2.0)
    }
}
